#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/worksheets/worksheet_view.h"

namespace gumcert::audit {

/// Cells of one column that hold anything, one below the other: from one place of a workbook::SheetIndex to before another.
struct CellRun {
    std::size_t sheet = 0;
    std::uint32_t begin = 0, end = 0;

    friend bool operator==(const CellRun&, const CellRun&) = default;
};

/// What formulas read, as runs of cells in place of cell by cell: a column of sums over all rows above it costs no more than
/// any other.
class ReadCells {
public:
    /// \param view  must outlive this object
    /// \param most  runs that are handed out, all together; behind them every formula reads nothing, see is_complete()
    explicit ReadCells(const WorksheetView& view, std::size_t most = 20'000'000);

    /// The cells that hold anything and that a formula reads, each once, column by column.
    [[nodiscard]] std::vector<CellRun> runs(const workbook::CellPlace& formula);
    /// Whether all runs were handed out that were asked for.
    [[nodiscard]] bool is_complete() const { return left_ > 0; }

    [[nodiscard]] std::size_t numbers(const CellRun& run) const { return count(numbers_, run); }
    [[nodiscard]] std::size_t texts(const CellRun& run) const { return count(texts_, run); }
    /// The first number of a run that was typed; nothing where there is none.
    [[nodiscard]] std::optional<std::uint32_t> typed_number(const CellRun& run) const;
    [[nodiscard]] std::optional<std::uint32_t> text(const CellRun& run) const;
    /// The cell of a place of an index.
    [[nodiscard]] workbook::CellPlace cell(std::size_t sheet, std::uint32_t at) const;
    /// The first blank cell of an area, column by column; nothing where all of them hold something.
    [[nodiscard]] std::optional<workbook::CellPlace> blank(const workbook::Area& area) const;

private:
    /// Of each sheet, how many cells of a kind stand before a place of its index.
    using Counts = std::vector<std::vector<std::uint32_t>>;
    [[nodiscard]] static std::size_t count(const Counts& counts, const CellRun& run);
    [[nodiscard]] static std::optional<std::uint32_t> first(const Counts& counts, const CellRun& run);
    void add_runs(const workbook::Area& area, std::vector<CellRun>& runs) const;

    const WorksheetView& view_;
    const std::vector<workbook::SheetIndex>& indexes_;
    std::size_t left_;
    Counts numbers_, typed_, texts_;
};

/// Which of several readers was the first to read a cell.
class FirstReaders {
public:
    struct Shared {
        std::uint32_t at = 0;    ///< place in the index of the sheet
        std::size_t reader = 0;  ///< that was there before
    };
    /// The first typed number of a run that another reader has.
    [[nodiscard]] std::optional<Shared> shared(const ReadCells& cells, const CellRun& run) const;
    /// Gives the cells of a run that nobody has to a reader.
    void add(const CellRun& run, std::size_t reader);

private:
    struct OfSheet {
        std::map<std::uint32_t, std::uint32_t> taken;  ///< begin and end, apart from each other
        std::map<std::uint32_t, std::size_t> readers;  ///< from a begin on, up to the next begin or the end of its part
    };
    std::map<std::size_t, OfSheet> sheets_;
};

}  // namespace gumcert::audit
