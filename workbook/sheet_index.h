#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "workbook/workbook.h"

namespace gumcert::workbook {

inline constexpr std::uint32_t k_no_place = std::numeric_limits<std::uint32_t>::max();

/// A rectangle on a sheet.
struct Area {
    std::size_t sheet = 0;
    CellRange range;
};

/// The cells of a sheet column by column, so that those of a rectangle are found without looking at the others.
class SheetIndex {
public:
    explicit SheetIndex(const Sheet& sheet);

    struct Column {
        std::uint32_t column = 1;
        std::uint32_t begin = 0, end = 0;  ///< in places
    };
    /// From left to right; only those that hold cells.
    [[nodiscard]] std::span<const Column> columns() const { return columns_; }
    /// Places of the cells in Sheet::cells, column by column, from top to bottom.
    [[nodiscard]] std::span<const std::uint32_t> places() const { return places_; }
    /// The first of columns() that is not left of `column`.
    [[nodiscard]] std::size_t column_from(std::uint32_t column) const;
    /// The first of the places of a column whose cell is not above `row`.
    [[nodiscard]] std::uint32_t place_from(const Column& column, std::uint32_t row) const;
    [[nodiscard]] const Sheet& sheet() const { return sheet_; }
    /// The last row and column that hold a cell; 1 where there is none.
    [[nodiscard]] CellAddress last_used() const { return last_used_; }

private:
    const Sheet& sheet_;
    std::vector<Column> columns_;
    std::vector<std::uint32_t> places_;
    CellAddress last_used_;
};

/// Which places of an index nobody took yet. Those that were taken are skipped, so that ranges over the same cells cost
/// no more than the cells.
class UntakenPlaces {
public:
    explicit UntakenPlaces(std::size_t count);
    /// The first place from `at` on that was not taken; `count` where there is none.
    /// \param at  up to `count`
    [[nodiscard]] std::uint32_t first_from(std::uint32_t at);
    void take(std::uint32_t place) { next_[place] = place + 1; }
    /// Gives back a place that was taken. Between the first and the last of those that are given back nothing is asked.
    void give_back(std::uint32_t place) { next_[place] = place; }

private:
    std::vector<std::uint32_t> next_;  ///< of each place: one behind which nothing is skipped
};

/// Walks over the cells of a rectangle that hold anything, column by column.
class AreaCursor {
public:
    AreaCursor() = default;
    AreaCursor(const SheetIndex& index, const CellRange& range);
    /// The place of the next cell in Sheet::cells; k_no_place behind the last one.
    [[nodiscard]] std::uint32_t next();
    /// The same without those that were taken.
    [[nodiscard]] std::uint32_t next(UntakenPlaces& untaken);
    /// How many columns and cells were looked at since it was last asked.
    [[nodiscard]] std::size_t take_steps();

private:
    [[nodiscard]] std::uint32_t next_of(UntakenPlaces* untaken);

    const SheetIndex* index_ = nullptr;
    std::size_t steps_ = 0;
    CellRange range_;
    std::size_t column_ = 0;
    std::uint32_t at_ = 0;
    bool is_in_column_ = false;
};

/// Finds sheets and defined names by what formulas call them.
class WorkbookNames {
public:
    explicit WorkbookNames(const Workbook& workbook);
    /// k_no_place where there is none.
    [[nodiscard]] std::uint32_t sheet(std::string_view name) const;
    /// The place in Workbook::defined_names of a name as a formula on a sheet reads it: one of its sheet before one of the
    /// workbook; `Sheet1!name` is one of that sheet. k_no_place where there is none.
    [[nodiscard]] std::uint32_t defined_name(std::string_view name, std::size_t on_sheet) const;

private:
    std::size_t everywhere_ = 0;  ///< in place of a sheet, for names of the whole workbook
    std::unordered_map<std::string, std::uint32_t> sheets_, names_;
};

}  // namespace gumcert::workbook
