#include "reports/point_headings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "certificate/piece_roles.h"
#include "certificate/point_limits.h"
#include "text/small_letters.h"

namespace gumcert::reports {

namespace {

using certificate::CertifiedTable;
using certificate::ShownColumn;

/// Names of columns that the wording knows, beside those of roles, stages and limits.
constexpr std::array<std::string_view, 3> k_usual_columns{"range", "function", "remark"};

bool shows_a_quantity(const ShownColumn& shown) {
    return shown.show == "value" || shown.show == "column";
}

const certificate::PointColumn* column_of_points(const CertifiedTable& table, const std::string& name) {
    return certificate::column_named(table.layout->columns, name);
}

/// Of a result; empty where it has its name alone.
Text description_of(const CertifiedTable& table, const std::string& result, const Wording& words) {
    const auto found =
        std::find_if(table.columns.begin(), table.columns.end(), [&](const auto& c) { return c.result == result; });
    const bool described = found != table.columns.end() && !found->name.empty() && found->name.in("en") != result;
    return described ? words.localised(found->name) : Text();
}

/// Whether a description has the word of the role: "deviation of the set torque", also where nobody translated it.
bool says(const Text& description, const Text& role, const Wording& words) {
    for (std::size_t i = 0; i < words.languages().size(); ++i) {
        const std::string text = text::in_small_letters(description.in(i));
        for (const std::string& word : {text::in_small_letters(role.in(i)), std::string("deviation")}) {
            if (text.find(word) != std::string::npos) {
                return true;
            }
        }
    }
    return false;
}

/// By what it shows alone.
Text plain_heading(const CertifiedTable& table, const ShownColumn& shown, const Wording& words) {
    if (!shown.heading.empty()) {
        return words.localised(shown.heading);
    }
    if (shown.show == "column") {
        const certificate::PointColumn* const column = column_of_points(table, shown.of);
        return column == nullptr ? Text(shown.of) : heading_of(*column, words);
    }
    if (shown.role.empty()) {
        return shown.of;
    }
    const Text role = words("point_table", shown.role);
    // "Deviation" says less than "hysteresis" or "slope of the curve"; an error and a correction say what they are.
    if (shown.show == "value" && shown.role == "deviation") {
        if (const Text description = description_of(table, shown.of, words);
            !description.empty() && !says(description, role, words)) {
            return description;
        }
    }
    return role;
}

/// By what it is called; of points, and of a result that has its name alone: role and name.
Text described_heading(const CertifiedTable& table, const ShownColumn& shown, const Wording& words) {
    const Text description = shown.show == "value" ? description_of(table, shown.of, words) : Text();
    return description.empty() ? plain_heading(table, shown, words) + " " + shown.of : description;
}

}  // namespace

Text word_of_column(const std::string& name, const Wording& words) {
    const auto is_among = [&](const auto& names) { return std::find(names.begin(), names.end(), name) != names.end(); };
    const bool is_known = is_among(certificate::k_quantity_roles) || is_among(certificate::k_piece_roles) ||
                          is_among(certificate::k_quantity_stages) || is_among(certificate::k_limit_columns) ||
                          is_among(k_usual_columns);
    return is_known ? words("point_table", name) : Text(name);
}

Text heading_of(const certificate::PointColumn& column, const Wording& words) {
    if (!column.heading.empty()) {
        return words.localised(column.heading);
    }
    return word_of_column(column.role.empty() ? column.name : column.role, words);
}

Text heading_of_shown(const CertifiedTable& table, const ShownColumn& shown, const Wording& words) {
    const auto is_told_apart = [&](const Text& heading, auto heading_of_other) {
        const auto& all = table.layout->shown;
        return std::none_of(all.begin(), all.end(), [&](const ShownColumn& other) {
            const bool same = other.show == shown.show && other.of == shown.of;
            return !same && shows_a_quantity(other) && other.stage == shown.stage &&
                   heading_of_other(table, other, words) == heading;
        });
    };
    const Text plain = plain_heading(table, shown, words);
    if (!shown.heading.empty() || is_told_apart(plain, plain_heading)) {
        return plain;
    }
    const Text described = described_heading(table, shown, words);
    const bool by_description = is_told_apart(described, described_heading) && is_told_apart(described, plain_heading);
    return by_description ? described : plain + " " + shown.of;
}

Text point_in_words(const std::string& name, const Wording& words) {
    constexpr std::string_view k_before_unit = "\u00A0";
    Text text;
    for (std::size_t begin = 0; begin < name.size();) {
        const std::size_t end = std::min(name.find(", ", begin), name.size());
        const std::string part = name.substr(begin, end - begin);
        text += begin == 0 ? "" : ", ";
        text += part.find(k_before_unit) == std::string::npos ? Text(part) : words.number(part);
        begin = end + 2;
    }
    return text;
}

}  // namespace gumcert::reports
