#include "certificate/point_tables.h"

#include <algorithm>
#include <cmath>

#include "certificate/certified_results.h"
#include "gum/quantity/unit.h"

namespace gumcert::certificate {

bool is_role_of_difference(std::string_view role) {
    return role == "error" || role == "deviation" || role == "correction";
}

std::optional<text::AnglePart> last_part_of(const std::string& unit) {
    const gum::Unit parsed = gum::Unit::parse(unit);
    if (!(parsed.dimension() == gum::Dimension::angle())) {
        return std::nullopt;
    }
    const auto is = [&](const char* name) {
        constexpr double k_rounding = 1e-12;
        return std::abs(parsed.to_si(1.0) / gum::Unit::parse(name).to_si(1.0) - 1.0) < k_rounding;
    };
    return is("arcsec")   ? std::optional(text::AnglePart::seconds)
           : is("arcmin") ? std::optional(text::AnglePart::minutes)
                          : std::nullopt;
}

std::string in_form(const std::string& printed, const std::string& form, const std::string& unit) {
    const auto last = form.empty() || printed.empty() ? std::nullopt : last_part_of(unit);
    if (!last) {
        return printed;
    }
    std::string parts = text::angle_in_parts(printed, *last);
    return parts == printed ? printed + "\u00A0" + gum::unit_for_people(unit) : parts;
}

std::string unit_in_form(const std::string& printed_unit, const std::string& form, const std::string& unit) {
    return form.empty() || !last_part_of(unit) ? printed_unit : "";
}

std::string shown_cell(const PointColumn& column, std::size_t row) {
    const bool is_number = row < column.values.size() && column.values[row].has_value();
    return is_number ? in_form(column.printed[row], column.form, column.unit) : column.printed[row];
}

std::string shown_unit(const PointColumn& column) {
    return unit_in_form(column.printed_unit, column.form, column.unit);
}

const ShownColumn* column_of_values(const CertifiedTable& table, const std::string& result) {
    if (!table.layout) {
        return nullptr;
    }
    const std::vector<ShownColumn>& shown = table.layout->shown;
    const auto found = std::find_if(shown.begin(), shown.end(),
                                    [&](const ShownColumn& c) { return c.show == "value" && c.of == result; });
    return found == shown.end() ? nullptr : &*found;
}

std::string form_of_result(const CertifiedTable& table, const std::string& result) {
    const ShownColumn* const column = column_of_values(table, result);
    return column == nullptr ? std::string() : column->form;
}

std::string value_as_shown(const CertifiedTable& table, const CertifiedColumn& column, const std::string& printed) {
    return in_form(printed, form_of_result(table, column.result), column.unit);
}

std::string unit_of_values(const CertifiedTable& table, const CertifiedColumn& column) {
    return unit_in_form(column.printed_unit, form_of_result(table, column.result), column.unit);
}

}  // namespace gumcert::certificate
