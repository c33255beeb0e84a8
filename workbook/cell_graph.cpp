#include "workbook/cell_graph.h"

#include <algorithm>
#include <set>

#include "gum/quantity/diagnostic.h"

namespace gumcert::workbook {

namespace {

bool holds_cell(const CellRange& range, const CellAddress& address) {
    return address.row >= range.first.row && address.row <= range.last.row && address.column >= range.first.column &&
           address.column <= range.last.column;
}

}  // namespace

/// Which cells were met.
class CellGraph::Marks {
public:
    explicit Marks(const std::vector<SheetIndex>& indexes) : indexes_(indexes) {
        for (const SheetIndex& index : indexes) {
            unmet_.emplace_back(index.places().size());
            is_marked_.emplace_back(index.places().size(), false);
        }
    }

    /// Marks the cells of an area and tells those that were not marked before: place in Sheet::cells.
    template <typename Tell>
    void mark(const Area& area, const Tell& tell) {
        const SheetIndex& index = indexes_[area.sheet];
        UntakenPlaces& unmet = unmet_[area.sheet];
        const auto columns = index.columns();
        for (std::size_t i = index.column_from(area.range.first.column);
             i < columns.size() && columns[i].column <= area.range.last.column; ++i) {
            std::uint32_t at = unmet.first_from(index.place_from(columns[i], area.range.first.row));
            while (at < columns[i].end) {
                const std::uint32_t place = index.places()[at];
                if (index.sheet().cells[place].address.row > area.range.last.row) {
                    break;
                }
                unmet.take(at);
                is_marked_[area.sheet][place] = true;
                met_.emplace_back(area.sheet, at);
                tell(place);
                at = unmet.first_from(at + 1);
            }
        }
    }

    [[nodiscard]] bool is_marked(std::size_t sheet, std::size_t place) const { return is_marked_[sheet][place]; }

    /// All marked cells, in order; none is marked any more.
    [[nodiscard]] std::vector<CellPlace> take_all() {
        std::vector<CellPlace> cells;
        cells.reserve(met_.size());
        for (const auto& [sheet, at] : met_) {
            const std::uint32_t place = indexes_[sheet].places()[at];
            cells.push_back({sheet, indexes_[sheet].sheet().cells[place].address});
            is_marked_[sheet][place] = false;
            unmet_[sheet].give_back(at);
        }
        met_.clear();
        std::sort(cells.begin(), cells.end());
        return cells;
    }

private:
    const std::vector<SheetIndex>& indexes_;
    std::vector<UntakenPlaces> unmet_;
    std::vector<std::pair<std::size_t, std::uint32_t>> met_;  ///< sheet, and place in its index
    std::vector<std::vector<bool>> is_marked_;
};

CellGraph::CellGraph(const Workbook& workbook, std::size_t most_areas) : workbook_(workbook) {
    const WorkbookNames names(workbook);
    indexes_.reserve(workbook.sheets.size());
    range_reads_.resize(workbook.sheets.size());
    for (std::size_t sheet = 0; sheet < workbook.sheets.size(); ++sheet) {
        indexes_.emplace_back(workbook.sheets[sheet]);
        for (const Cell& cell : workbook.sheets[sheet].cells) {
            if (!cell.formula.empty()) {
                cells_.push_back({sheet, cell.address});
            }
        }
    }
    nodes_.reserve(cells_.size() + workbook.defined_names.size());
    const auto add = [&](const std::string& formula, std::size_t sheet) {
        add_node(areas_.size() < most_areas ? formula : "", sheet, names);
    };
    for (const CellPlace& cell : cells_) {
        add(find_cell(workbook.sheets[cell.sheet], cell.address)->formula, cell.sheet);
    }
    for (const DefinedName& name : workbook.defined_names) {
        add(name.formula, name.sheet.value_or(k_no_place));
    }
    std::sort(single_reads_.begin(), single_reads_.end());
}

void CellGraph::add_node(const std::string& formula, std::size_t sheet, const WorkbookNames& names) {
    const auto place = static_cast<std::uint32_t>(nodes_.size());
    Node& node = nodes_.emplace_back(Node{.first_area = areas_.size(), .first_name = names_read_.size()});
    Formula tree;
    try {
        tree = parse_formula(formula, "");
    } catch (const gum::InputError&) {
        is_complete_ = false;
        return;
    }
    for (const FormulaNode& one : tree.nodes) {
        if (one.kind == FormulaNodeKind::name) {
            const std::uint32_t name = names.defined_name(one.text, sheet);
            if (name != k_no_place) {
                names_read_.push_back(static_cast<std::uint32_t>(cells_.size() + name));
                readers_of_names_[names_read_.back()].push_back(place);
            }
        } else if (one.kind == FormulaNodeKind::reference) {
            const Reference& reference = tree.references[one.reference];
            const std::size_t on = reference.sheet.empty() ? sheet : names.sheet(reference.sheet);
            if (!reference.workbook.empty() || !reference.last_sheet.empty() || on == k_no_place) {
                continue;
            }
            const CellRange range = area(reference);
            areas_.push_back({on, range});
            if (range.first == range.last) {
                single_reads_.emplace_back(CellPlace{on, range.first}, place);
            } else {
                range_reads_[on].emplace_back(range, place);
            }
        }
    }
    node.areas = areas_.size() - node.first_area;
    node.names = names_read_.size() - node.first_name;
}

std::optional<std::uint32_t> CellGraph::node_of(const CellPlace& cell) const {
    const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell);
    return found != cells_.end() && *found == cell ? std::optional(static_cast<std::uint32_t>(found - cells_.begin()))
                                                   : std::nullopt;
}

std::vector<std::uint32_t> CellGraph::with_names(std::uint32_t node) const {
    std::vector<std::uint32_t> found{node};
    std::set<std::uint32_t> seen{node};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Node& one = nodes_[found[i]];
        for (std::size_t k = 0; k < one.names; ++k) {
            if (seen.insert(names_read_[one.first_name + k]).second) {
                found.push_back(names_read_[one.first_name + k]);
            }
        }
    }
    return found;
}

std::vector<Area> CellGraph::areas_read(const CellPlace& cell) const {
    std::vector<Area> areas;
    if (const std::optional<std::uint32_t> node = node_of(cell)) {
        for (const std::uint32_t one : with_names(*node)) {
            const auto first = areas_.begin() + static_cast<std::ptrdiff_t>(nodes_[one].first_area);
            areas.insert(areas.end(), first, first + static_cast<std::ptrdiff_t>(nodes_[one].areas));
        }
    }
    return areas;
}

std::vector<CellPlace> CellGraph::precedents(const CellPlace& cell, std::size_t most) const {
    std::vector<CellPlace> cells;
    std::set<CellPlace> seen;
    for (const Area& area : areas_read(cell)) {
        for (std::uint32_t row = area.range.first.row; row <= area.range.last.row; ++row) {
            for (std::uint32_t column = area.range.first.column; column <= area.range.last.column; ++column) {
                if (cells.size() >= most) {
                    return cells;
                }
                const CellPlace one{area.sheet, {row, column}};
                if (seen.insert(one).second) {
                    cells.push_back(one);
                }
            }
        }
    }
    return cells;
}

std::vector<CellPlace> CellGraph::dependents(const CellPlace& cell) const {
    std::vector<std::uint32_t> readers;
    for (auto one = std::lower_bound(single_reads_.begin(), single_reads_.end(), std::pair(cell, std::uint32_t{0}));
         one != single_reads_.end() && one->first == cell; ++one) {
        readers.push_back(one->second);
    }
    if (cell.sheet < range_reads_.size()) {
        for (const auto& [range, reader] : range_reads_[cell.sheet]) {
            if (holds_cell(range, cell.address)) {
                readers.push_back(reader);
            }
        }
    }
    std::set<std::uint32_t> seen(readers.begin(), readers.end());
    for (std::size_t i = 0; i < readers.size(); ++i) {
        const auto of_name = readers_of_names_.find(readers[i]);
        if (of_name == readers_of_names_.end()) {
            continue;
        }
        for (const std::uint32_t one : of_name->second) {
            if (seen.insert(one).second) {
                readers.push_back(one);
            }
        }
    }
    std::vector<CellPlace> dependents;
    for (const std::uint32_t reader : seen) {
        if (reader < cells_.size()) {
            dependents.push_back(cells_[reader]);
        }
    }
    return dependents;
}

std::vector<CellPlace> CellGraph::unmarked(const Marks& marks, bool formulas_only) const {
    std::vector<CellPlace> found;
    for (std::size_t sheet = 0; sheet < workbook_.sheets.size(); ++sheet) {
        const std::vector<Cell>& cells = workbook_.sheets[sheet].cells;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (!marks.is_marked(sheet, i) && (!formulas_only || !cells[i].formula.empty())) {
                found.push_back({sheet, cells[i].address});
            }
        }
    }
    return found;
}

std::vector<CellPlace> CellGraph::closure(std::span<const CellPlace> results) const {
    Marks marks(indexes_);
    mark_closure(results, {}, marks);
    return marks.take_all();
}

void CellGraph::each_closure(std::span<const CellPlace> results,
                             const std::function<void(std::size_t, const std::vector<CellPlace>&)>& tell) const {
    Marks marks(indexes_);
    std::vector<std::uint32_t> ends;
    for (const CellPlace& result : results) {
        if (const std::optional<std::uint32_t> node = node_of(result)) {
            ends.push_back(*node);
        }
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i < results.size(); ++i) {
        mark_closure(results.subspan(i, 1), ends, marks);
        tell(i, marks.take_all());
    }
}

std::vector<CellPlace> CellGraph::dead_cells(std::span<const CellPlace> results) const {
    Marks marks(indexes_);
    mark_closure(results, {}, marks);
    return unmarked(marks, true);
}

void CellGraph::mark_closure(std::span<const CellPlace> results, std::span<const std::uint32_t> ends,
                             Marks& marks) const {
    std::vector<std::uint32_t> open;
    std::set<std::uint32_t> names_met;
    const auto meet = [&](const Area& area, bool is_result) {
        marks.mark(area, [&](std::uint32_t place) {
            const std::optional<std::uint32_t> node =
                node_of({area.sheet, workbook_.sheets[area.sheet].cells[place].address});
            if (node && (is_result || !std::binary_search(ends.begin(), ends.end(), *node))) {
                open.push_back(*node);
            }
        });
    };
    for (const CellPlace& result : results) {
        if (result.sheet < indexes_.size()) {
            meet({result.sheet, {result.address, result.address}}, true);
        }
    }
    while (!open.empty()) {
        const Node node = nodes_[open.back()];
        open.pop_back();
        for (std::size_t i = 0; i < node.areas; ++i) {
            meet(areas_[node.first_area + i], false);
        }
        for (std::size_t i = 0; i < node.names; ++i) {
            const std::uint32_t name = names_read_[node.first_name + i];
            if (names_met.insert(name).second) {
                open.push_back(name);
            }
        }
    }
}

std::vector<CellPlace> CellGraph::unread_cells() const {
    Marks marks(indexes_);
    for (const Area& area : areas_) {
        marks.mark(area, [](std::uint32_t) {});
    }
    std::vector<CellPlace> unread;
    for (const CellPlace& cell : unmarked(marks, false)) {
        const Cell& held = *find_cell(workbook_.sheets[cell.sheet], cell.address);
        if (!held.formula.empty() || held.value.kind == CellKind::number) {
            unread.push_back(cell);
        }
    }
    return unread;
}

}  // namespace gumcert::workbook
