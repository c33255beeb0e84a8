#include "jobs/budget/angle_number.h"

#include <algorithm>
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

/// Parts of an angle without their signs: 12:30:05, 12 30 05.
bool has_parts_without_signs(std::string_view text) {
    return text.find_first_of(": ") != std::string_view::npos &&
           text.find_first_not_of("0123456789.,+-: ") == std::string_view::npos && text.front() != ' ' &&
           text.back() != ' ';
}

std::optional<WrittenNumber> angle_in(const std::string& written, const std::string& unit, const std::string& where,
                                      ProblemList& problems, const std::string& group) {
    const std::string shown = written.size() <= 64 ? text::in_quotes(written) : "a long text";
    if (unit.empty()) {
        problems.refuse(k_angle_in_parts, where, shown + " in a column of limits whose unit is not stated",
                        "such limits are numbers in the unit of the specification",
                        "declare the column with the points: \"limit_low\": {\"unit\": \"arcsec\", \"form\": "
                        "\"sexagesimal\"}",
                        group);
        return std::nullopt;
    }
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
    if (!unit.empty() &&
        (text::has_angle_sign(cell.text) || (has_parts_without_signs(cell.text) && certificate::last_part_of(unit)))) {
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

std::optional<WrittenNumbers> numbers_in_list(const StatementKeys& keys, std::string_view key,
                                              const std::string& unit) {
    const nlohmann::json* const list = keys.value(key);
    if (list == nullptr || !list->is_array() || std::none_of(list->begin(), list->end(), is_angle_text)) {
        auto numbers = keys.numbers(key);
        return numbers ? std::optional(WrittenNumbers{std::move(*numbers), keys.decimals_as_written(key)})
                       : std::nullopt;
    }
    WrittenNumbers numbers;
    AngleNotation notation;
    const JsonDocument& document = keys.document(key);
    for (std::size_t i = 0; i < list->size(); ++i) {
        const nlohmann::json& element = (*list)[i];
        const std::string pointer = child_pointer(keys.pointer(key), i);
        notation.see(element, document, pointer);
        if (is_angle_text(element)) {
            if (const auto angle = angle_number(element.get_ref<const std::string&>(), unit, document.where(pointer),
                                                keys.problems(key))) {
                numbers.values.push_back(angle->value);
                numbers.decimals = std::max(numbers.decimals, text::most_decimals({&angle->written, 1}));
            }
        } else if (element.is_number()) {
            numbers.values.push_back(element.get<double>());
            numbers.decimals = std::max(numbers.decimals, document.decimals_as_written(pointer));
        } else {
            keys.problems(key).refuse(k_wrong_type, document.where(pointer), described(element), "must be a number",
                                      "correct the value");
        }
    }
    const std::size_t refused = keys.problems(key).refusals();
    notation.refuse_mixture(text::in_quotes(key), keys.problems(key));
    return numbers.values.size() == list->size() && keys.problems(key).refusals() == refused
               ? std::optional(std::move(numbers))
               : std::nullopt;
}

int decimals_of_angles(const nlohmann::json& list, const std::string& unit) {
    int most = 0;
    for (const nlohmann::json& element : list) {
        most = std::max(most, decimals_of_angle(&element, unit).value_or(0));
    }
    return most;
}

void AngleNotation::see(const CsvTable& table, std::size_t column) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const CsvCell& cell = table.cell(row, column);
        if (text::has_angle_sign(cell.text)) {
            has_signs_ = true;
        } else if (where_.empty() && cell.text.find_first_of("123456789") != std::string_view::npos &&
                   cell.text.find_first_not_of("0123456789.,+-eE") == std::string_view::npos) {
            bare_ = cell.text;
            where_ = table.where(cell);
        }
    }
}

void AngleNotation::see(const nlohmann::json& value, const JsonDocument& document, const std::string& pointer) {
    if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            see(value[i], document, child_pointer(pointer, i));
        }
    } else if (is_angle_text(value)) {
        has_signs_ = true;
    } else if (value.is_number() && value.get<double>() != 0.0 && where_.empty()) {
        bare_ = document.number_as_written(pointer);
        where_ = document.where(pointer);
    }
}

void AngleNotation::refuse_mixture(const std::string& of, ProblemList& problems) const {
    if (has_signs_ && !where_.empty()) {
        problems.refuse(
            k_angle_in_parts, where_,
            text::in_quotes(bare_) + " in " + of + ", which has angles with signs of degrees, minutes or seconds",
            "a number without sign would be one of the unit, and not of degrees",
            "write every angle of it with its signs, such as 30\u00B0");
    }
}

}  // namespace gumcert::jobs
