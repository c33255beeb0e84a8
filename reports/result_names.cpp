#include "reports/result_names.h"

#include <array>
#include <string_view>
#include <utility>

namespace gumcert::reports {

namespace {

constexpr const char* k_group = "result_name";

/// Tables whose names begin with what they are.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> k_prefixes = {
    {{"ranges", "range_"}, {"reversal", "reversal_"}}};

std::string_view prefix_of(const std::string& table, const std::string& result) {
    for (const auto& [id, prefix] : k_prefixes) {
        if (table == id && result.starts_with(prefix) && result.size() > prefix.size()) {
            return prefix;
        }
    }
    return {};
}

/// "x" for 'x', 'X' and 'A'; "" for other letters.
std::string coordinate_of(char letter) {
    switch (letter) {
        case 'x':
        case 'X':
        case 'A':
        case 'a':
            return "x";
        case 'y':
        case 'Y':
        case 'B':
        case 'b':
            return "y";
        case 'z':
        case 'Z':
        case 'C':
        case 'c':
            return "z";
        default:
            return "";
    }
}

Text along(const char* name, const std::string& coordinate, const Wording& words) {
    return words.filled(k_group, name, {{"coordinate", coordinate}});
}

/// "O_y", "S_z"
Text set_up_meaning(const std::string& result, const Wording& words) {
    const bool offset = result.starts_with("O_");
    const std::string coordinate = result.size() == 3 ? coordinate_of(result[2]) : "";
    const bool known = (offset || result.starts_with("S_")) && !coordinate.empty();
    return known ? along(offset ? "offset" : "tilt", coordinate, words) : Text();
}

/// "axis_y", "axis_b"
Text axis_line_meaning(const std::string& result, const Wording& words) {
    if (result.size() != 6 || !result.starts_with("axis_")) {
        return {};
    }
    const std::string coordinate = coordinate_of(result[5]);
    const bool linear = result[5] >= 'x';
    return coordinate.empty() ? Text() : along(linear ? "location" : "orientation", coordinate, words);
}

/// "EY0A": E, the coordinate or the angle, 0, the axis (ISO 230-7).
Text location_meaning(const std::string& result, const Wording& words) {
    if (result.size() != 4 || result[0] != 'E' || result[2] != '0') {
        return {};
    }
    const std::string coordinate = coordinate_of(result[1]);
    const bool linear = result[1] >= 'X';
    return coordinate.empty() ? Text() : along(linear ? "location_error" : "orientation_error", coordinate, words);
}

Text positioning_meaning(const std::string& result, const Wording& words) {
    static constexpr std::array<std::string_view, 12> k_parameters = {
        "M", "E", "E_up", "E_down", "R", "R_up", "R_down", "B", "B_mean", "A", "A_up", "A_down"};
    for (const std::string_view parameter : k_parameters) {
        if (result == parameter) {
            return words(k_group, result);
        }
    }
    return {};
}

}  // namespace

Text result_meaning(const std::string& table, const std::string& result, const Text& recorded, const Wording& words) {
    Text meaning;
    if (table == "set_up") {
        meaning = set_up_meaning(result, words);
    } else if (table == "location_errors") {
        meaning = location_meaning(result, words);
    } else if (table == "axis_line") {
        meaning = axis_line_meaning(result, words);
    } else if (table == "positioning") {
        meaning = positioning_meaning(result, words);
    }
    return meaning.empty() ? recorded : meaning;
}

Text described_result(const std::string& recorded, const Wording& words) {
    return words.has("result_description", recorded) ? words("result_description", recorded) : Text(recorded);
}

Text result_meaning(const certificate::CertifiedTable& table, const certificate::CertifiedColumn& column,
                    const Wording& words) {
    const Text recorded =
        column.name.by_language.empty() ? described_result(column.name.plain, words) : words.localised(column.name);
    return result_meaning(table.id, column.result, recorded, words);
}

std::string name_in_table(const std::string& table, const std::string& result) {
    return result.substr(prefix_of(table, result).size());
}

Text name_of_result(const std::string& table, const std::string& result, const Wording& words) {
    const std::string_view prefix = prefix_of(table, result);
    return prefix.empty() ? Text(result)
                          : words.filled(k_group, prefix == "range_" ? "range" : "reversal",
                                         {{"name", result.substr(prefix.size())}});
}

Text source_name(const std::string& recorded, const Wording& words) {
    return words.has("budget_source", recorded) ? words("budget_source", recorded) : Text(recorded);
}

Text name_of_budget_row(const BudgetRow& row, const Wording& words) {
    if (row.role == "fit" || row.role == "fit_data") {
        return words.filled("label", row.role == "fit" ? "fit_of" : "data_of", {{"name", row.input}});
    }
    if (row.role == "scatter" || row.role == "extremes") {
        return words("label", row.role == "scatter" ? "scatter_of_readings" : "which_are_extreme");
    }
    return row.part.empty() ? Text(row.input)
                            : words.filled("budget_part", row.part, {{"standard", row.standard}, {"since", row.since}});
}

Text source_of_budget_row(const BudgetRow& row, const Wording& words) {
    // That readings are where their scatter comes from says nothing.
    return (row.role == "scatter" || row.role == "extremes") && row.source == row.input ? Text()
           : row.certificate.empty()
               ? Text(row.source)
               : words.filled("budget_part", "source", {{"standard", row.standard}, {"certificate", row.certificate}});
}

Text distribution_name(const std::string& recorded, const Wording& words) {
    return words.has("distribution_name", recorded) ? words("distribution_name", recorded) : Text(recorded);
}

}  // namespace gumcert::reports
