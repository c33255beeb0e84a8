#include "audit/worksheets/read_cells.h"

#include <algorithm>
#include <tuple>

namespace gumcert::audit {

using workbook::Area;
using workbook::CellKind;
using workbook::CellPlace;
using workbook::CellValue;
using workbook::SheetIndex;

ReadCells::ReadCells(const WorksheetView& view, std::size_t most) : view_(view), indexes_(view.indexes()), left_(most) {
    for (std::size_t sheet = 0; sheet < indexes_.size(); ++sheet) {
        const std::size_t size = indexes_[sheet].places().size();
        for (Counts* counts : {&numbers_, &typed_, &texts_}) {
            counts->emplace_back(size + 1, 0);
        }
        for (std::uint32_t at = 0; at < size; ++at) {
            const CellPlace place = cell(sheet, at);
            const CellKind kind = view_.value(place).kind;
            const bool is_number = kind == CellKind::number;
            const bool is_typed = is_number && view_.formula_at(place) == nullptr;
            numbers_[sheet][at + 1] = numbers_[sheet][at] + (is_number ? 1U : 0U);
            typed_[sheet][at + 1] = typed_[sheet][at] + (is_typed ? 1U : 0U);
            texts_[sheet][at + 1] = texts_[sheet][at] + (kind == CellKind::text ? 1U : 0U);
        }
    }
}

void ReadCells::add_runs(const Area& area, std::vector<CellRun>& runs) const {
    const SheetIndex& index = indexes_[area.sheet];
    const auto columns = index.columns();
    for (std::size_t i = index.column_from(area.range.first.column);
         i < columns.size() && columns[i].column <= area.range.last.column; ++i) {
        const std::uint32_t begin = index.place_from(columns[i], area.range.first.row);
        const std::uint32_t end = index.place_from(columns[i], area.range.last.row + 1);
        if (begin < end) {
            runs.push_back({.sheet = area.sheet, .begin = begin, .end = end});
        }
    }
}

std::vector<CellRun> ReadCells::runs(const CellPlace& formula) {
    std::vector<CellRun> all;
    if (left_ == 0) {
        return all;
    }
    for (const Area& area : view_.areas_read(formula)) {
        add_runs(area, all);
    }
    left_ -= std::min(left_, all.size());
    if (left_ == 0) {
        return {};
    }
    const auto key = [](const CellRun& run) { return std::tuple(run.sheet, run.begin, run.end); };
    std::sort(all.begin(), all.end(), [&key](const CellRun& a, const CellRun& b) { return key(a) < key(b); });
    std::vector<CellRun> apart;
    for (const CellRun& run : all) {
        if (!apart.empty() && apart.back().sheet == run.sheet && run.begin < apart.back().end) {
            apart.back().end = std::max(apart.back().end, run.end);
        } else {
            apart.push_back(run);
        }
    }
    return apart;
}

std::size_t ReadCells::count(const Counts& counts, const CellRun& run) {
    return counts[run.sheet][run.end] - counts[run.sheet][run.begin];
}

std::optional<std::uint32_t> ReadCells::first(const Counts& counts, const CellRun& run) {
    const std::vector<std::uint32_t>& before = counts[run.sheet];
    if (before[run.end] == before[run.begin]) {
        return std::nullopt;
    }
    const auto found = std::upper_bound(before.begin() + run.begin, before.begin() + run.end + 1, before[run.begin]);
    return static_cast<std::uint32_t>(found - before.begin() - 1);
}

std::optional<std::uint32_t> ReadCells::typed_number(const CellRun& run) const {
    return first(typed_, run);
}

std::optional<std::uint32_t> ReadCells::text(const CellRun& run) const {
    return first(texts_, run);
}

CellPlace ReadCells::cell(std::size_t sheet, std::uint32_t at) const {
    const SheetIndex& index = indexes_[sheet];
    return {.sheet = sheet, .address = index.sheet().cells[index.places()[at]].address};
}

std::optional<CellPlace> ReadCells::blank(const Area& area) const {
    const SheetIndex& index = indexes_[area.sheet];
    std::size_t i = index.column_from(area.range.first.column);
    for (std::uint32_t column = area.range.first.column; column <= area.range.last.column; ++column, ++i) {
        const bool is_used = i < index.columns().size() && index.columns()[i].column == column;
        if (!is_used) {
            return CellPlace{area.sheet, {area.range.first.row, column}};
        }
        // Rows grow at least by one from cell to cell: the first cell that lies too low stands behind the first gap.
        const std::uint32_t begin = index.place_from(index.columns()[i], area.range.first.row);
        const std::uint32_t end = index.place_from(index.columns()[i], area.range.last.row + 1);
        std::uint32_t low = 0, high = end - begin;
        while (low < high) {
            const std::uint32_t middle = low + (high - low) / 2;
            const bool is_too_low = cell(area.sheet, begin + middle).address.row > area.range.first.row + middle;
            (is_too_low ? high : low) = is_too_low ? middle : middle + 1;
        }
        if (area.range.first.row + low <= area.range.last.row) {
            return CellPlace{area.sheet, {area.range.first.row + low, column}};
        }
    }
    return std::nullopt;
}

std::optional<FirstReaders::Shared> FirstReaders::shared(const ReadCells& cells, const CellRun& run) const {
    const auto of = sheets_.find(run.sheet);
    if (of == sheets_.end()) {
        return std::nullopt;
    }
    const auto& [taken, readers] = of->second;
    auto part = taken.upper_bound(run.begin);
    if (part != taken.begin() && std::prev(part)->second > run.begin) {
        --part;
    }
    for (; part != taken.end() && part->first < run.end; ++part) {
        const CellRun both{
            .sheet = run.sheet, .begin = std::max(run.begin, part->first), .end = std::min(run.end, part->second)};
        if (const std::optional<std::uint32_t> at = cells.typed_number(both)) {
            return Shared{.at = *at, .reader = std::prev(readers.upper_bound(*at))->second};
        }
    }
    return std::nullopt;
}

void FirstReaders::add(const CellRun& run, std::size_t reader) {
    auto& [taken, readers] = sheets_[run.sheet];
    CellRun whole = run;
    auto part = taken.upper_bound(run.begin);
    if (part != taken.begin() && std::prev(part)->second >= run.begin) {
        --part;
    }
    std::uint32_t free_from = run.begin;
    while (part != taken.end() && part->first <= run.end) {
        if (free_from < part->first) {
            readers.emplace(free_from, reader);
        }
        free_from = std::max(free_from, part->second);
        whole.begin = std::min(whole.begin, part->first);
        whole.end = std::max(whole.end, part->second);
        part = taken.erase(part);
    }
    if (free_from < run.end) {
        readers.emplace(free_from, reader);
    }
    taken.emplace(whole.begin, whole.end);
}

}  // namespace gumcert::audit
