#include "certificate/point_tables.h"

#include <algorithm>
#include <cmath>

#include "gum/quantity/unit.h"

namespace gumcert::certificate {

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

std::string form_of_result(const std::optional<TableLayout>& layout, const std::string& result) {
    if (!layout) {
        return {};
    }
    const auto found = std::find_if(layout->shown.begin(), layout->shown.end(),
                                    [&](const ShownColumn& c) { return c.show == "value" && c.of == result; });
    return found == layout->shown.end() ? std::string() : found->form;
}

}  // namespace gumcert::certificate
