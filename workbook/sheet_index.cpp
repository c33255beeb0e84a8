#include "workbook/sheet_index.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "workbook/letters.h"

namespace gumcert::workbook {

namespace {

std::string scoped_name(std::string_view name, std::size_t sheet) {
    return std::to_string(sheet) + "!" + folded_text(name);
}

}  // namespace

SheetIndex::SheetIndex(const Sheet& sheet) : sheet_(sheet) {
    for (const Cell& cell : sheet.cells) {
        last_used_.row = std::max(last_used_.row, cell.address.row);
        last_used_.column = std::max(last_used_.column, cell.address.column);
    }
    // As many as are used, not as many as there may be: thousands of small tables are read in one run.
    std::vector<std::uint32_t> count(last_used_.column + 1, 0), next(last_used_.column + 1, 0);
    for (const Cell& cell : sheet.cells) {
        ++count[cell.address.column];
    }
    std::uint32_t begin = 0;
    for (std::uint32_t column = 1; column <= last_used_.column; ++column) {
        if (count[column] > 0) {
            columns_.push_back({column, begin, begin + count[column]});
        }
        next[column] = begin;
        begin += count[column];
    }
    places_.resize(sheet.cells.size());
    for (std::uint32_t i = 0; i < sheet.cells.size(); ++i) {
        places_[next[sheet.cells[i].address.column]++] = i;
    }
}

std::size_t SheetIndex::column_from(std::uint32_t column) const {
    const auto found = std::lower_bound(columns_.begin(), columns_.end(), column,
                                        [](const Column& one, std::uint32_t wanted) { return one.column < wanted; });
    return static_cast<std::size_t>(found - columns_.begin());
}

std::uint32_t SheetIndex::place_from(const Column& column, std::uint32_t row) const {
    const auto begin = places_.begin() + column.begin;
    const auto found = std::lower_bound(
        begin, places_.begin() + column.end, row,
        [&](std::uint32_t place, std::uint32_t wanted) { return sheet_.cells[place].address.row < wanted; });
    return static_cast<std::uint32_t>(found - places_.begin());
}

AreaCursor::AreaCursor(const SheetIndex& index, const CellRange& range)
    : index_(&index), range_(range), column_(index.column_from(range.first.column)) {}

std::uint32_t AreaCursor::next() {
    return next_of(nullptr);
}

std::uint32_t AreaCursor::next(UntakenPlaces& untaken) {
    return next_of(&untaken);
}

std::uint32_t AreaCursor::next_of(UntakenPlaces* untaken) {
    while (index_ != nullptr && column_ < index_->columns().size()) {
        const SheetIndex::Column& column = index_->columns()[column_];
        if (column.column > range_.last.column) {
            break;
        }
        ++steps_;
        if (!is_in_column_) {
            at_ = index_->place_from(column, range_.first.row);
            is_in_column_ = true;
        }
        at_ = untaken == nullptr ? at_ : untaken->first_from(at_);
        if (at_ < column.end) {
            const std::uint32_t place = index_->places()[at_];
            if (index_->sheet().cells[place].address.row <= range_.last.row) {
                ++at_;
                return place;
            }
        }
        ++column_;
        is_in_column_ = false;
    }
    return k_no_place;
}

std::size_t AreaCursor::take_steps() {
    return std::exchange(steps_, 0);
}

UntakenPlaces::UntakenPlaces(std::size_t count) : next_(count + 1) {
    std::iota(next_.begin(), next_.end(), 0U);
}

std::uint32_t UntakenPlaces::first_from(std::uint32_t at) {
    while (next_[at] != at) {
        next_[at] = next_[next_[at]];
        at = next_[at];
    }
    return at;
}

WorkbookNames::WorkbookNames(const Workbook& workbook) : everywhere_(workbook.sheets.size()) {
    for (std::uint32_t i = 0; i < workbook.sheets.size(); ++i) {
        sheets_.emplace(folded_text(workbook.sheets[i].name), i);
    }
    for (std::uint32_t i = 0; i < workbook.defined_names.size(); ++i) {
        const DefinedName& one = workbook.defined_names[i];
        names_.emplace(scoped_name(one.name, one.sheet.value_or(everywhere_)), i);
    }
}

std::uint32_t WorkbookNames::sheet(std::string_view name) const {
    const auto found = sheets_.find(folded_text(name));
    return found == sheets_.end() ? k_no_place : found->second;
}

std::uint32_t WorkbookNames::defined_name(std::string_view name, std::size_t on_sheet) const {
    const std::size_t mark = name.rfind('!');
    if (mark != std::string_view::npos) {
        std::string sheet_name(name.substr(0, mark));
        if (sheet_name.size() >= 2 && sheet_name.front() == '\'') {
            sheet_name = sheet_name.substr(1, sheet_name.size() - 2);
        }
        on_sheet = sheet(sheet_name);
        name.remove_prefix(mark + 1);
        if (on_sheet == k_no_place) {
            return k_no_place;
        }
    }
    for (const std::size_t scope : {on_sheet, everywhere_}) {
        if (const auto found = names_.find(scoped_name(name, scope)); found != names_.end()) {
            return found->second;
        }
    }
    return k_no_place;
}

}  // namespace gumcert::workbook
