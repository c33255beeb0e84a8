#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "workbook/formula.h"
#include "workbook/sheet_index.h"
#include "workbook/workbook.h"

namespace gumcert::workbook {

/// A cell of a workbook, whether it holds anything or not; its sheet as a place in Workbook::sheets.
struct CellPlace {
    std::size_t sheet = 0;
    CellAddress address;

    friend auto operator<=>(const CellPlace&, const CellPlace&) = default;
};

/// Which cells the formulas of a workbook read, and which formulas read a cell: from what stands in them, in both branches
/// of an IF, and through defined names. References to other workbooks, over several sheets, and those that depend on values
/// (OFFSET, INDIRECT) are no edges. The workbook must outlive the graph.
class CellGraph {
public:
    /// \param most_areas  references that are kept; what a workbook has beyond them is left out, see is_complete()
    explicit CellGraph(const Workbook& workbook, std::size_t most_areas = 10'000'000);

    /// Whether every formula was understood, and no reference left out.
    [[nodiscard]] bool is_complete() const { return is_complete_; }

    /// The cells of each sheet, column by column.
    [[nodiscard]] const std::vector<SheetIndex>& indexes() const { return indexes_; }

    /// The cells that the formula of a cell reads, as areas in the order of the formula, those of names behind them. Empty
    /// for a cell without a formula. An area may hold any number of cells, blank ones too.
    [[nodiscard]] std::vector<Area> areas_read(const CellPlace& cell) const;

    /// The same cell by cell, blank ones too, each once, area by area and row by row.
    /// \param most  cells that are listed; the rest is left out
    [[nodiscard]] std::vector<CellPlace> precedents(const CellPlace& cell, std::size_t most) const;

    /// The cells whose formulas read a cell themselves, in order. Takes time with the number of ranges of the workbook.
    [[nodiscard]] std::vector<CellPlace> dependents(const CellPlace& cell) const;

    /// The cells that hold anything and on which results stand: what their formulas read, what these read, and so on, the
    /// results with them; in order. Time is linear in the workbook.
    [[nodiscard]] std::vector<CellPlace> closure(std::span<const CellPlace> results) const;

    /// The cells on which each of several results stands, as closure() of it, up to the others: what they read in turn is
    /// told with them alone. So it takes no more time than what is told, however many results stand on each other.
    void each_closure(std::span<const CellPlace> results,
                      const std::function<void(std::size_t, const std::vector<CellPlace>&)>& tell) const;

    /// Cells with formulas that are not among closure(): computed, and no part of the results.
    [[nodiscard]] std::vector<CellPlace> dead_cells(std::span<const CellPlace> results) const;

    /// Cells with numbers or formulas that no formula reads, in order: results, and what was forgotten.
    [[nodiscard]] std::vector<CellPlace> unread_cells() const;

private:
    class Marks;
    /// A cell with a formula, or a defined name behind them.
    struct Node {
        std::size_t first_area = 0, areas = 0;
        std::size_t first_name = 0, names = 0;
    };
    void add_node(const std::string& formula, std::size_t sheet, const WorkbookNames& names);
    [[nodiscard]] std::optional<std::uint32_t> node_of(const CellPlace& cell) const;
    /// A node with the names that it reads, directly or through other names.
    [[nodiscard]] std::vector<std::uint32_t> with_names(std::uint32_t node) const;
    /// \param ends  nodes in order, which are marked and not followed, but for the results themselves
    void mark_closure(std::span<const CellPlace> results, std::span<const std::uint32_t> ends, Marks& marks) const;
    [[nodiscard]] std::vector<CellPlace> unmarked(const Marks& marks, bool formulas_only) const;

    const Workbook& workbook_;
    std::vector<SheetIndex> indexes_;
    std::vector<CellPlace> cells_;  ///< with formulas, in order
    std::vector<Node> nodes_;
    std::vector<Area> areas_;
    std::vector<std::uint32_t> names_read_;                                      ///< places in nodes_
    std::vector<std::pair<CellPlace, std::uint32_t>> single_reads_;              ///< sorted
    std::vector<std::vector<std::pair<CellRange, std::uint32_t>>> range_reads_;  ///< of each sheet
    std::map<std::uint32_t, std::vector<std::uint32_t>> readers_of_names_;
    bool is_complete_ = true;
};

}  // namespace gumcert::workbook
