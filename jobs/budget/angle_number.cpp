#include "jobs/budget/angle_number.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "certificate/point_tables.h"
#include "jobs/input_codes.h"
#include "text/angle_text.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

std::optional<WrittenNumber> read_angle(const std::string& written, text::AnglePart last) {
    std::optional<std::string> decimal = text::decimal_of_angle(written, last);
    if (!decimal) {
        return std::nullopt;
    }
    WrittenNumber number{.value = 0.0, .written = std::move(*decimal)};
    std::from_chars(number.written.data(), number.written.data() + number.written.size(), number.value);
    return number;
}

std::optional<WrittenNumber> angle_in(const std::string& written, const std::string& unit, const std::string& where,
                                      ProblemList& problems, const std::string& group) {
    const std::string shown = written.size() <= 64 ? text::in_quotes(written) : "a long text";
    const auto last = certificate::last_part_of(unit);
    if (!last) {
        problems.refuse(k_angle_in_parts, where, shown + " where the unit is " + unit,
                        "degrees, minutes and seconds are a decimal number of the last of them, and of no other unit",
                        "state the unit arcsec, or arcmin where the angles end with minutes", group);
        return std::nullopt;
    }
    std::optional<WrittenNumber> number = read_angle(written, *last);
    if (!number) {
        const bool ends_sooner = *last == text::AnglePart::minutes && read_angle(written, text::AnglePart::seconds);
        problems.refuse(k_angle_in_parts, where, shown + " where the unit is " + unit,
                        ends_sooner ? "in this unit an angle ends with minutes"
                                    : "an angle is degrees, minutes and seconds in this order, each with its sign, "
                                      "minutes and seconds below 60, and decimals of the last one only",
                        ends_sooner ? "state the unit arcsec" : "write it as 12\u00B0 30\u2032 05.0\u2033", group);
    }
    return number;
}

}  // namespace

bool is_angle_text(const nlohmann::json& value) {
    return value.is_string() && text::has_angle_sign(value.get_ref<const std::string&>());
}

std::optional<WrittenNumber> angle_number(const std::string& written, const std::string& unit, const std::string& where,
                                          ProblemList& problems) {
    return angle_in(written, unit, where, problems, {});
}

std::optional<WrittenNumber> number_in_cell(const CsvTable& table, std::size_t row, std::size_t column,
                                            const std::string& unit, const std::string& name, ProblemList& problems) {
    const CsvCell& cell = table.cell(row, column);
    if (!unit.empty() && text::has_angle_sign(cell.text)) {
        return angle_in(std::string(cell.text), unit, table.where(cell), problems, "column " + name);
    }
    const std::optional<double> value = table.number(row, column, {});
    return value ? std::optional(WrittenNumber{.value = *value, .written = table.number_text(row, column)})
                 : std::nullopt;
}

std::optional<int> decimals_of_angle(const nlohmann::json* value, const std::string& unit) {
    if (value == nullptr || !value->is_string()) {
        return std::nullopt;
    }
    const auto last = certificate::last_part_of(unit);
    const auto number = last ? read_angle(value->get<std::string>(), *last) : std::nullopt;
    return number ? std::optional(text::most_decimals({&number->written, 1})) : std::nullopt;
}

void refuse_bare_numbers(const CsvTable& table, std::size_t column, const std::string& name, ProblemList& problems) {
    const CsvCell* bare = nullptr;
    bool has_signs = false;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const CsvCell& cell = table.cell(row, column);
        if (text::has_angle_sign(cell.text)) {
            has_signs = true;
        } else if (bare == nullptr && cell.text.find_first_of("123456789") != std::string_view::npos &&
                   cell.text.find_first_not_of("0123456789.,+-eE") == std::string_view::npos) {
            bare = &cell;
        }
    }
    if (has_signs && bare != nullptr) {
        problems.refuse(k_angle_in_parts, table.where(*bare),
                        text::in_quotes(bare->text) + " in column " + text::visible(name) +
                            ", which has angles with signs of degrees, minutes or seconds",
                        "a number without sign would be one of the unit of the column, and not of degrees",
                        "write every angle of the column with its signs, such as 30\u00B0");
    }
}

}  // namespace gumcert::jobs
