#include "jobs/budget/point_columns.h"

#include <algorithm>
#include <array>
#include <utility>

#include "certificate/piece_roles.h"
#include "certificate/point_tables.h"
#include "gum/rounding.h"
#include "jobs/budget/angle_number.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/budget/stated_point.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/job_limits.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/place.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using nlohmann::json;

/// Words that a table has for what belongs to a result.
constexpr std::array<std::string_view, 6> k_reserved{k_point_name, "U", "k", "nu_eff", "limit", "verdict"};

bool is_limit(std::string_view name) {
    return std::find(certificate::k_limit_columns.begin(), certificate::k_limit_columns.end(), name) !=
           certificate::k_limit_columns.end();
}

/// The digits of a number as they were written, without an exponent where people read it so.
std::string digits_as_written(const std::string& written, double value) {
    return gum::round_as_written(value, text::most_decimals({&written, 1}));
}

/// A column that is called as a role has that role.
std::string role_of_name(const std::string& name, bool has_words) {
    const auto is_among = [&](const auto& roles) { return std::find(roles.begin(), roles.end(), name) != roles.end(); };
    return is_among(certificate::k_quantity_roles) || (has_words && is_among(certificate::k_piece_roles)) ? name : "";
}

}  // namespace

PointColumns::PointColumns(const JsonDocument& document, const BudgetInputs& inputs, BudgetJob& job,
                           ProblemList& problems)
    : document_(document), inputs_(inputs), job_(job), problems_(problems) {}

void PointColumns::read_declared(const JsonObject& points) {
    const json* columns = points.find("columns");
    if (columns == nullptr) {
        return;
    }
    if (!columns->is_object() || columns->size() > k_most_point_columns) {
        points.refuse(k_wrong_type, "columns",
                      columns->is_object() ? text::count_of(columns->size(), "column") : described(*columns),
                      "must be an object of at most " + std::to_string(k_most_point_columns) + " columns",
                      "write {\"range\": \"text\", \"nominal\": \"V\"}");
        return;
    }
    for (const std::string& name : keys_in_order(document_, points.pointer("columns"))) {
        const std::string at = child_pointer(points.pointer("columns"), name);
        if (!has_free_name(name, document_.where(at))) {
            continue;
        }
        if (auto column = declared(name, columns->at(name), at)) {
            add(std::move(*column), document_.where(at));
        }
    }
}

bool PointColumns::has_free_name(const std::string& name, const std::string& where) const {
    if (const auto objection = name_objection(name)) {
        problems_.refuse(k_text_not_allowed, where, "the name of the column " + *objection,
                         "a name has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                         "correct the name");
        return false;
    }
    if (std::find(k_reserved.begin(), k_reserved.end(), name) != k_reserved.end()) {
        problems_.refuse(k_point_column, where, text::in_quotes(name) + " is declared as a column of points",
                         "in tables this word stands for something else", "rename the column");
        return false;
    }
    if (inputs_.is_named(name)) {
        problems_.refuse(k_point_column, where, text::in_quotes(name) + " is an input and a column of points",
                         "a name stands for one quantity; the column of an input is not declared",
                         "remove it, or rename one of the two");
        return false;
    }
    return true;
}

std::optional<PointColumns::Column> PointColumns::declared(const std::string& name, const json& value,
                                                           const std::string& at) const {
    certificate::PointColumn column;
    column.name = name;
    std::optional<std::string> unit;
    if (value.is_string()) {
        if (value.get<std::string>() != "text") {
            unit = value.get<std::string>();
        }
    } else if (value.is_object()) {
        static constexpr std::array<std::string_view, 5> k_keys{"unit", "heading", "role", "stage", "form"};
        const JsonObject object(document_, at, k_keys, problems_);
        unit = object.optional_string("unit");
        column.role = unit ? object.optional_choice<std::string_view>("role", k_role_words).value_or("")
                           : object.optional_choice<std::string_view>("role", k_word_roles).value_or("");
        column.stage = object.optional_choice<std::string_view>("stage", k_stage_words).value_or("");
        column.form = object.optional_choice<std::string_view>("form", k_form_words).value_or("");
        if (const json* heading = object.find("heading"); heading != nullptr && heading->is_object()) {
            read_localised(*heading, column.heading, false, {&document_, object.pointer("heading"), &problems_});
        } else {
            column.heading = object.optional_name("heading").value_or("");
        }
    } else {
        problems_.refuse(k_wrong_type, document_.where(at), described(value), "must be \"text\", a unit or an object",
                         "write \"text\" for words, or the unit of numbers");
        return std::nullopt;
    }
    if (unit) {
        try {
            column.unit = gum::Unit::parse(*unit).text();
        } catch (const gum::DiagnosedError& error) {
            refuse_as(error, document_.where(at), problems_);
            return std::nullopt;
        }
        column.printed_unit = gum::unit_for_people(column.unit);
    }
    const bool has_words = !unit && !is_limit(name);
    if (column.role.empty()) {
        column.role = role_of_name(name, has_words);
    }
    return Column{std::move(column), has_words};
}

void PointColumns::add(Column declared, const std::string& where) {
    auto& [column, has_words] = declared;
    const auto known = std::find_if(job_.point_columns.begin(), job_.point_columns.end(),
                                    [&](const certificate::PointColumn& c) { return c.name == column.name; });
    if (known == job_.point_columns.end()) {
        has_words_.push_back(has_words);
        job_.point_columns.push_back(std::move(column));
        return;
    }
    // Of a section before.
    const auto position = static_cast<std::size_t>(known - job_.point_columns.begin());
    if (has_words_[position] != has_words || known->unit != column.unit || known->role != column.role ||
        known->stage != column.stage || known->form != column.form || !(known->heading == column.heading)) {
        problems_.refuse(k_point_column, where,
                         text::in_quotes(column.name) + " is declared otherwise than in a section before",
                         "a name stands for one column in all sections", "declare it alike, or rename it");
    }
}

std::optional<std::size_t> PointColumns::find(const std::string& name) {
    for (std::size_t i = 0; i < job_.point_columns.size(); ++i) {
        if (job_.point_columns[i].name == name) {
            return i;
        }
    }
    if (!is_limit(name) || inputs_.find(name)) {
        return std::nullopt;
    }
    certificate::PointColumn& column = job_.point_columns.emplace_back();
    column.name = name;
    column.values.resize(job_.points.size());
    column.printed.resize(job_.points.size());
    has_words_.push_back(false);
    return job_.point_columns.size() - 1;
}

void PointColumns::read_cell(std::size_t column, const CsvTable& table, std::size_t row, std::size_t position,
                             ProblemList& problems) {
    certificate::PointColumn& into = job_.point_columns[column];
    const CsvCell& cell = table.cell(row, position);
    into.values.emplace_back();
    into.printed.emplace_back();
    if (cell.text.empty()) {
        return;
    }
    if (!has_words_[column]) {
        const bool is_limit_without_unit = into.unit.empty() && text::has_angle_sign(cell.text);
        const auto number = is_limit_without_unit
                                ? angle_number(std::string(cell.text), {}, table.where(cell), problems)
                                : number_in_cell(table, row, position, into.unit, into.name, problems);
        if (number) {
            into.values.back() = number->value;
            into.printed.back() = digits_as_written(number->written, number->value);
        }
    } else if (const auto objection = name_objection(cell.text)) {
        problems.refuse(k_text_not_allowed, table.where(cell),
                        "the text in the column " + text::in_quotes(into.name) + " " + *objection,
                        "a text has 1 to 256 bytes, no spaces around it and no control or hidden characters",
                        "correct the text", "text " + into.name);
    } else {
        into.printed.back() = cell.text;
    }
}

void PointColumns::read_value(std::size_t column, const json& value, const std::string& at) {
    const std::string where = document_.where(at);
    certificate::PointColumn& into = job_.point_columns[column];
    into.values.resize(job_.points.size() + 1);  // points before may have left it out
    into.printed.resize(job_.points.size() + 1);
    if (!has_words_[column]) {
        if (value.is_number()) {
            into.values.back() = value.get<double>();
            into.printed.back() = digits_as_written(document_.number_as_written(at), value.get<double>());
            return;
        }
        if (is_angle_text(value)) {
            if (const auto angle = angle_number(value.get_ref<const std::string&>(), into.unit, where, problems_)) {
                into.values.back() = angle->value;
                into.printed.back() = digits_as_written(angle->written, angle->value);
            }
            return;
        }
        problems_.refuse(k_wrong_type, where, described(value), "must be a number",
                         "write the number without quotes and unit");
        return;
    }
    const auto objection = value.is_string() ? name_objection(value.get<std::string>()) : std::nullopt;
    if (!value.is_string() || objection) {
        problems_.refuse(value.is_string() ? k_text_not_allowed : k_wrong_type, where,
                         objection ? "the text " + *objection : described(value),
                         "must be a text of 1 to 256 bytes without spaces around it and hidden characters",
                         "write it in quotes");
        return;
    }
    into.printed.back() = value.get<std::string>();
}

void PointColumns::fill() {
    for (certificate::PointColumn& column : job_.point_columns) {
        column.values.resize(job_.points.size());
        column.printed.resize(job_.points.size());
    }
}

}  // namespace gumcert::jobs
