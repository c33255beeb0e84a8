#include "certificate/point_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "certificate/point_tables.h"

namespace gumcert::certificate {

namespace {

using PointIdentities = std::map<std::string, PointIdentity>;  // by number

/// The first parts of a point, as many as there are up to this. Brackets are round: those of the place stand around all of it.
std::string first_parts(const PointIdentity& point, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < std::min(count, point.parts.size()); ++i) {
        text += (i == 0 ? "" : ", ") + point.parts[i];
    }
    std::replace(text.begin(), text.end(), '[', '(');
    std::replace(text.begin(), text.end(), ']', ')');
    return text;
}

bool is_running_number(const std::string& text) {
    constexpr std::size_t k_most_digits = 9;
    return !text.empty() && text.size() <= k_most_digits && text.find_first_not_of("0123456789") == std::string::npos;
}

/// Whether what a column has is found at a point, and does not say which point it is.
bool is_found(const PointColumn& column) {
    static constexpr std::array<std::string_view, 5> k_found = {"indication", "measured_value", "error", "deviation",
                                                                "correction"};
    return std::find(k_found.begin(), k_found.end(), column.role) != k_found.end();
}

enum class Found { left_out, last };

/// Columns that say what a point is, those first that nobody measures.
std::vector<const PointColumn*> identifying_columns(const TableLayout& layout, Found found) {
    std::vector<const PointColumn*> columns;
    for (const PointColumn& column : layout.columns) {
        if (!is_found(column)) {
            columns.push_back(&column);
        }
    }
    std::stable_partition(columns.begin(), columns.end(), [](const PointColumn* column) {
        return !column->role.empty() && column->role != "reference";
    });
    for (const PointColumn& column : layout.columns) {
        if (found == Found::last && is_found(column)) {
            columns.push_back(&column);
        }
    }
    return columns;
}

PointIdentities identities_of(const std::vector<CertifiedTable>& tables, bool (*has)(const CertifiedTable&),
                              Found found) {
    PointIdentities points;
    for (const CertifiedTable& table : tables) {
        if (!has(table)) {
            continue;
        }
        const TableLayout& layout = *table.layout;
        const std::vector<const PointColumn*> columns = identifying_columns(layout, found);
        for (std::size_t row = 0; row < table.argument->printed.size(); ++row) {
            PointIdentity& point = points[table.argument->printed[row]];
            const auto add = [&](const std::string& part) {
                if (!part.empty() && std::find(point.parts.begin(), point.parts.end(), part) == point.parts.end()) {
                    point.parts.push_back(part);
                }
            };
            add(layout.group);
            for (const PointColumn* column : columns) {
                if (row < column->printed.size()) {
                    const bool is_number = row < column->values.size() && column->values[row];
                    const std::string unit = is_number ? shown_unit(*column) : "";
                    add(shown_cell(*column, row) + (unit.empty() ? "" : "\u00A0" + unit));
                }
            }
            for (const CertifiedColumn& column : table.columns) {
                point.results.insert(column.result);
            }
            if (table.columns.empty()) {
                point.results.emplace();
            }
            // The group and what follows it: a group of one point is a range, and no point.
            point.name = first_parts(point, layout.group.empty() ? 1 : 2);
        }
    }
    return points;
}

/// Names as short as they can be while no two points of one result have one; with the number where they have.
void tell_apart(PointIdentities& points) {
    const auto count_names = [&] {
        std::map<std::pair<std::string, std::string>, std::size_t> counts;
        for (const auto& [number, point] : points) {
            for (const std::string& result : point.results) {
                ++counts[{result, point.name}];
            }
        }
        return counts;
    };
    std::size_t most = 0;
    for (const auto& [number, point] : points) {
        most = std::max(most, point.parts.size());
    }
    for (std::size_t length = 1; length <= most + 1; ++length) {
        const auto counts = count_names();
        for (auto& [number, point] : points) {
            const bool is_one = std::all_of(point.results.begin(), point.results.end(), [&](const std::string& result) {
                return counts.at({result, point.name}) == 1;
            });
            if (is_one && !point.name.empty()) {
                continue;
            }
            std::string longer = first_parts(point, length);
            if (length > most) {
                longer += (longer.empty() ? "" : ", ") + number;
            }
            point.name = longer.size() > point.name.size() ? longer : point.name;
        }
    }
}

}  // namespace

bool hides_points(const CertifiedTable& table) {
    const auto shows_points = [](const ShownColumn& c) { return c.show == "point"; };
    return table.layout && table.argument && table.argument->name == "point" &&
           std::none_of(table.layout->shown.begin(), table.layout->shown.end(), shows_points);
}

bool has_unnamed_points(const CertifiedTable& table) {
    return hides_points(table) &&
           std::all_of(table.argument->printed.begin(), table.argument->printed.end(), is_running_number);
}

PointIdentities identities_of_points(const std::vector<CertifiedTable>& tables) {
    PointIdentities points = identities_of(tables, has_unnamed_points, Found::left_out);
    tell_apart(points);
    return points;
}

PointIdentities identities_of_rows(const std::vector<CertifiedTable>& tables) {
    PointIdentities points = identities_of(tables, hides_points, Found::last);
    tell_apart(points);
    return points;
}

}  // namespace gumcert::certificate
