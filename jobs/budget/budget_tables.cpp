#include "jobs/budget/budget_tables.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "certificate/piece_roles.h"
#include "certificate/point_limits.h"
#include "certificate/point_tables.h"
#include "certificate/result_names.h"
#include "gum/rounding.h"
#include "gum/type_a.h"
#include "jobs/budget/budget_fit_statement.h"
#include "jobs/budget/budget_inputs.h"
#include "jobs/budget/budget_job_statement.h"
#include "jobs/budget/budget_results.h"
#include "jobs/budget/point_limit_checks.h"
#include "jobs/certificate/certificate_archive.h"
#include "jobs/job_limits.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/rounded_number.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using certificate::PointColumn;
using certificate::ShownColumn;
using certificate::TableRequest;
using gum::Unit;
using nlohmann::json;

constexpr std::size_t k_most_shown = 40;
constexpr std::string_view k_range = "range";
constexpr std::array<std::string_view, 7> k_of_results{"U",         "k",          "nu_eff", "limit",
                                                       "limit_low", "limit_high", "verdict"};

bool is_of_result(std::string_view word) {
    return std::find(k_of_results.begin(), k_of_results.end(), word) != k_of_results.end();
}

class TableReader {
public:
    TableReader(const JsonDocument& document, const BudgetInputs& inputs, const BudgetPoints& points, BudgetJob& job,
                ProblemList& problems)
        : document_(document), inputs_(inputs), points_(points), job_(job), problems_(problems) {
        if (job.sections.empty()) {
            results_.push_back(budget_results(job));
        }
        for (std::size_t s = 0; s < job.sections.size(); ++s) {
            results_.push_back(budget_results(gum::budget_of_section(job, s)));
        }
    }

    void read(const std::vector<JsonObject>& parts) {
        for (section_ = 0; section_ < parts.size(); ++section_) {
            const JsonObject& part = parts[section_];
            if (const json* list = part.find("tables")) {
                read_list(*list, part.pointer("tables"));
            } else if (wants_table()) {
                add_default(TableRequest(), document_.where(part.pointer("points")));
            } else if (!has_points() && !part.has("points")) {
                warn_of_roles(part);
            }
        }
        section_ = 0;  // what follows looks at each point's own section
        check_forms();
        if (problems_.refusals() == 0) {
            add_inputs();
            name_points();
            check_columns_of_limits();
            check_point_limits(document_, job_, results_, problems_);
            check_points();
            set_units();
        }
    }

private:
    const JsonDocument& document_;
    const BudgetInputs& inputs_;
    const BudgetPoints& points_;
    BudgetJob& job_;
    ProblemList& problems_;
    std::vector<std::vector<std::pair<std::string, Unit>>> results_;  ///< one a section, or one alone
    std::size_t section_ = 0;                                         ///< that is read
    std::vector<std::size_t> made_;                                   ///< tables whose columns the job leaves out

    /// The points of a section, or of the whole job.
    [[nodiscard]] std::pair<std::size_t, std::size_t> points_of(std::size_t section) const {
        if (job_.sections.empty()) {
            return {0, job_.points.size()};
        }
        const std::size_t first = gum::first_point_of(job_, section);
        return {first, first + job_.sections[section].points};
    }
    [[nodiscard]] bool has_points() const {
        const auto [first, end] = points_of(section_);
        return end > first;
    }
    [[nodiscard]] std::size_t section_of(std::size_t point) const {
        return gum::section_of_point(job_, point).value_or(0);
    }

    /// Columns that state something for people, not limits alone.
    [[nodiscard]] bool wants_table() const {
        return has_points() && (!job_.sections.empty() || !job_.point_columns.empty() || !job_.input_parts.empty() ||
                                !job_.output_parts.empty());
    }
    /// What a quantity is to the reader stands in the heading of its column: without points there is none, and neither the digital
    /// certificate nor the range of a scope knows at which nominal value an error was measured.
    void warn_of_roles(const JsonObject& part) const {
        std::vector<std::string> names;
        std::string first;
        const auto see = [&](const std::string& pointer, const std::string& name) {
            first = names.empty() ? child_pointer(pointer, name) : first;
            names.push_back(text::in_quotes(name));
        };
        for (const gum::BudgetInput& i : job_.inputs) {
            if (job_.input_parts.contains(i.name) && is_here(i) && !is_shown_elsewhere(i)) {
                see("/inputs", i.name);
            }
        }
        for (const auto& [name, unit] : results_[section_]) {
            const QuantityPart part_of = part_of_result(name);
            const bool is_plain = part_of.role == "measured_value" && part_of.stage.empty();  // what a result is anyway
            if (job_.output_parts.contains(name) && !is_plain) {
                see(part.pointer("outputs"), name);
            }
        }
        if (!names.empty()) {
            problems_.warn(
                k_warn_roles_without_points, document_.where(first),
                std::string(names.size() == 1 ? "role, stage or form of " : "roles, stages or forms of ") +
                    text::listed(names, 5) + ", and no points",
                "a role is the heading of a column, the name of its numbers in the digital certificate, and the "
                "place at which an error is held against a scope; without points there is no such table",
                "state \"points\": [{}]: one row with all of them");
        }
    }
    /// A column of points that has something at the points of this section.
    [[nodiscard]] bool is_here(const PointColumn& c) const {
        const auto [first, end] = points_of(section_);
        return job_.sections.empty() || std::any_of(c.printed.begin() + static_cast<std::ptrdiff_t>(first),
                                                    c.printed.begin() + static_cast<std::ptrdiff_t>(end),
                                                    [](const std::string& text) { return !text.empty(); });
    }
    [[nodiscard]] bool is_here(const gum::BudgetInput& i) const {
        return job_.sections.empty() || points_.is_used(i.name, section_);
    }
    /// Whether a section with points uses an input, and shows its role.
    [[nodiscard]] bool is_shown_elsewhere(const gum::BudgetInput& i) const {
        for (std::size_t s = 0; s < job_.sections.size(); ++s) {
            if (job_.sections[s].points > 0 && points_.is_used(i.name, s)) {
                return true;
            }
        }
        return false;
    }

    // ---- names ------------------------------------------------------------------------------------------------------

    [[nodiscard]] const PointColumn* column(std::string_view name) const {
        return certificate::column_named(job_.point_columns, name);
    }
    [[nodiscard]] std::optional<std::size_t> input(std::string_view name) const {
        for (std::size_t i = 0; i < job_.inputs.size(); ++i) {
            if (job_.inputs[i].name == name) {
                return i;
            }
        }
        return std::nullopt;
    }
    [[nodiscard]] const Unit* result(std::string_view name) const { return result(name, section_); }
    [[nodiscard]] const Unit* result(std::string_view name, std::size_t section) const {
        const auto& results = results_[section];
        const auto found =
            std::find_if(results.begin(), results.end(), [&](const auto& known) { return known.first == name; });
        return found == results.end() ? nullptr : &found->second;
    }
    [[nodiscard]] QuantityPart part_of_result(const std::string& name) const {
        const auto found = job_.output_parts.find(name);
        return found == job_.output_parts.end() ? QuantityPart() : found->second;
    }

    [[nodiscard]] QuantityPart part_of_input(const std::string& name) const {
        const auto found = job_.input_parts.find(name);
        return found == job_.input_parts.end() ? QuantityPart() : found->second;
    }

    /// What has a role: columns of points, inputs, results.
    [[nodiscard]] std::vector<std::string> with_role(std::string_view role) const {
        std::vector<std::string> names;
        for (const PointColumn& c : job_.point_columns) {
            if (c.role == role && is_here(c)) {
                names.push_back(c.name);
            }
        }
        for (const gum::BudgetInput& i : job_.inputs) {
            if (const auto part = job_.input_parts.find(i.name);
                part != job_.input_parts.end() && part->second.role == role && is_here(i)) {
                names.push_back(i.name);
            }
        }
        for (const auto& [name, unit] : results_[section_]) {
            if (part_of_result(name).role == role) {
                names.push_back(name);
            }
        }
        return names;
    }

    [[nodiscard]] std::vector<std::string> known_names() const {
        std::vector<std::string> names;
        for (const PointColumn& c : job_.point_columns) {
            names.push_back(c.name);
        }
        for (const auto& [name, unit] : results_[section_]) {
            names.push_back(name);
        }
        for (const gum::BudgetInput& i : job_.inputs) {
            names.push_back(i.name);
        }
        return names;
    }

    /// Columns of points and inputs that have a role.
    [[nodiscard]] std::vector<std::string> columns_with_role(std::string_view role) const {
        std::vector<std::string> names;
        for (const PointColumn& c : job_.point_columns) {
            if (c.role == role) {
                names.push_back(c.name);
            }
        }
        for (const auto& [name, part] : job_.input_parts) {
            if (part.role == role && column(name) == nullptr) {
                names.push_back(name);
            }
        }
        return names;
    }

    void refuse_name(const std::string& name, const std::string& where) const {
        const std::vector<std::string> names = known_names();
        std::vector<std::string_view> known(names.begin(), names.end());
        known.insert(known.end(), k_of_results.begin(), k_of_results.end());
        known.insert(known.end(), certificate::k_quantity_roles.begin(), certificate::k_quantity_roles.end());
        known.insert(known.end(), certificate::k_piece_roles.begin(), certificate::k_piece_roles.end());
        const auto nearest = nearest_word(name, known);
        problems_.refuse(
            k_table_column, where, text::in_quotes(name) + " is nothing that the points of this job have",
            "a table shows columns of points, inputs, s(INPUT) where it has readings, results, what has a role "
            "(\"reference\", \"error\" …), and point, U, k, nu_eff, limit, limit_low, limit_high, verdict",
            nearest ? "did you mean " + text::in_quotes(*nearest) + "?"
                    : "correct the name, or declare it in the columns of points");
    }

    /// A column of points, an input or a result as a table shows it.
    [[nodiscard]] std::optional<ShownColumn> shown(const std::string& name) const {
        if (const PointColumn* const c = column(name)) {
            return ShownColumn{.show = "column", .of = name, .heading = {}, .role = c->role, .stage = c->stage};
        }
        if (result(name) != nullptr) {
            const QuantityPart part = part_of_result(name);
            const auto described = job_.output_descriptions.find(name);
            return ShownColumn{.show = "value",
                               .of = name,
                               .heading = part.role.empty() && described != job_.output_descriptions.end()
                                              ? described->second
                                              : certificate::LocalisedText(),
                               .role = part.role,
                               .stage = part.stage,
                               .form = part.form};
        }
        if (input(name)) {
            const QuantityPart part = part_of_input(name);
            return ShownColumn{.show = "column", .of = name, .heading = {}, .role = part.role, .stage = part.stage};
        }
        if (const std::optional<std::size_t> i = input_of_scatter(name); i && has_readings(*i)) {
            return ShownColumn{.show = "column",
                               .of = name,
                               .heading = {},
                               .role = "",
                               .stage = part_of_input(job_.inputs[*i].name).stage};
        }
        return std::nullopt;
    }

    /// The input of which "s(V_x)" is the experimental standard deviation of the readings.
    [[nodiscard]] std::optional<std::size_t> input_of_scatter(std::string_view name) const {
        return name.starts_with("s(") && name.ends_with(")") ? input(name.substr(2, name.size() - 3)) : std::nullopt;
    }
    /// Its readings at a point, whatever stands beside them; none where it is stated otherwise, has one reading, or two
    /// series.
    [[nodiscard]] std::vector<double> readings_at(std::size_t i, std::size_t p) const {
        if (!job_.sections.empty() && !points_.is_used(job_.inputs[i].name, section_of(p))) {
            return {};
        }
        std::vector<double> readings;
        for (const gum::StatedQuantity& component : gum::input_at(job_, i, p).components) {
            if (component.observations.empty()) {
                continue;  // the display, the calibration
            }
            if (!readings.empty()) {
                return {};  // of which of two series?
            }
            readings = component.observations;
        }
        return readings.size() > 1 ? readings : std::vector<double>();
    }
    [[nodiscard]] bool has_readings(std::size_t i) const {
        const auto [first, end] = points_of(section_);
        for (std::size_t p = first; p < end; ++p) {
            if (!readings_at(i, p).empty()) {
                return true;
            }
        }
        return false;
    }

    // ---- what the job says ------------------------------------------------------------------------------------------

    void read_list(const json& list, const std::string& pointer) {
        if (!list.is_array() || list.empty() || list.size() > k_most_tables) {
            problems_.refuse(list.is_array() ? k_wrong_size : k_wrong_type, document_.where(pointer),
                             list.is_array() ? text::count_of(list.size(), "table") : described(list),
                             "must be an array of 1 to " + std::to_string(k_most_tables) + " tables",
                             "write [{\"columns\": [\"reference\", \"indication\", \"error\", \"U\"]}]");
            return;
        }
        if (!has_points() && document_.value.contains("points")) {
            return;  // the table of points was refused
        }
        if (!has_points()) {
            problems_.refuse(k_table_column, document_.where(pointer), "tables in a job without points",
                             "a table shows the points of a job", "state the points, or remove the tables");
            return;
        }
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::string here = child_pointer(pointer, i);
            if (!list[i].is_object()) {
                problems_.refuse(k_wrong_type, document_.where(here), described(list[i]), "must be an object",
                                 "write {\"columns\": [\"reference\", \"indication\", \"error\", \"U\"]}");
                continue;
            }
            read_table(JsonObject(document_, here, jobs::keys_of<TableStatement>(), problems_));
        }
    }

    void read_table(const JsonObject& object) {
        TableRequest table;
        if (object.has("title")) {
            read_text(*object.find("title"), object.pointer("title"), table.title);
        }
        if (const auto name = object.optional_name("group_by")) {
            table.group_by = *name;
            const PointColumn* const c = column(*name);
            if (c == nullptr || !has_words(*c)) {
                object.refuse(k_table_column, "group_by", text::in_quotes(*name) + " is no column of points with words",
                              "rows are grouped by what the points have in common in a column of words",
                              "declare it in the columns of points as \"text\"");
            }
        }
        table.plot = object.optional_choice<std::string_view>("plot", k_plot_words).value_or("");
        read_where(object, table);
        read_units(object, table);
        const json* columns = object.find("columns");
        if (columns == nullptr) {
            add_default(std::move(table), object.where());
            return;
        }
        if (!columns->is_array() || columns->empty() || columns->size() > k_most_shown) {
            object.refuse(columns->is_array() ? k_wrong_size : k_wrong_type, "columns",
                          columns->is_array() ? text::count_of(columns->size(), "column") : described(*columns),
                          "must be an array of 1 to " + std::to_string(k_most_shown) + " columns",
                          "name what the table shows");
            return;
        }
        read_columns(*columns, object.pointer("columns"), table);
        finish(std::move(table), object.where());
    }

    void read_text(const json& value, const std::string& pointer, certificate::LocalisedText& text) {
        if (value.is_object() || value.is_string()) {
            read_localised(value, text, false, {&document_, pointer, &problems_});
        } else {
            problems_.refuse(k_wrong_type, document_.where(pointer), described(value),
                             "must be a text, or an object with one in each language", "write a text in quotes");
        }
    }

    [[nodiscard]] static bool has_words(const PointColumn& c) {
        return c.unit.empty() &&
               std::none_of(c.values.begin(), c.values.end(), [](const auto& v) { return v.has_value(); });
    }

    void read_where(const JsonObject& object, TableRequest& table) {
        const json* where = object.find("where");
        if (where == nullptr) {
            return;
        }
        if (!where->is_object()) {
            object.refuse(k_wrong_type, "where", described(*where), "must be an object",
                          "write {\"function\": \"DC voltage\"}");
            return;
        }
        for (const std::string& name : keys_in_order(document_, object.pointer("where"))) {
            const std::string at = child_pointer(object.pointer("where"), name);
            const json& word = where->at(name);
            const PointColumn* const c = column(name);
            if (!word.is_string()) {
                problems_.refuse(k_wrong_type, document_.where(at), described(word), "must be a text",
                                 "write the word that the rows have there");
            } else if (c == nullptr || !has_words(*c)) {
                problems_.refuse(k_table_column, document_.where(at),
                                 text::in_quotes(name) + " is no column of points with words",
                                 "rows are chosen by what the points have in a column of words",
                                 "declare it in the columns of points as \"text\"");
            } else {
                table.where.push_back({name, word.get<std::string>()});
            }
        }
    }

    void read_units(const JsonObject& object, TableRequest& table) {
        const json* units = object.find("units");
        if (units == nullptr) {
            return;
        }
        if (!units->is_object()) {
            object.refuse(k_wrong_type, "units", described(*units), "must be an object", "write {\"100 mV\": \"mV\"}");
            return;
        }
        for (const std::string& group : keys_in_order(document_, object.pointer("units"))) {
            const std::string at = child_pointer(object.pointer("units"), group);
            const json& value = units->at(group);
            if (!value.is_object()) {
                add_unit(table, group, "", value, at);
                continue;
            }
            for (const std::string& name : keys_in_order(document_, at)) {
                const std::string here = child_pointer(at, name);
                if (!shown(name)) {
                    refuse_name(name, document_.where(here));
                    continue;
                }
                add_unit(table, group, name, value.at(name), here);
            }
        }
    }

    void add_unit(TableRequest& table, const std::string& group, const std::string& of, const json& value,
                  const std::string& pointer) {
        if (!value.is_string()) {
            problems_.refuse(k_wrong_type, document_.where(pointer), described(value), "must be a unit",
                             "write a unit in quotes, such as \"mV\"");
            return;
        }
        try {
            table.units.push_back({group, of, Unit::parse(value.get<std::string>()).text()});
        } catch (const gum::DiagnosedError& error) {
            refuse_as(error, document_.where(pointer), problems_);
        }
    }

    void read_columns(const json& columns, const std::string& pointer, TableRequest& table) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const std::string at = child_pointer(pointer, i);
            const json& entry = columns[i];
            certificate::LocalisedText heading;
            std::string name;
            if (entry.is_string()) {
                name = entry.get<std::string>();
            } else if (entry.is_object()) {
                static constexpr std::array<std::string_view, 2> k_keys{"column", "heading"};
                const JsonObject object(document_, at, k_keys, problems_);
                name = object.required_name("column").value_or("");
                if (object.has("heading")) {
                    read_text(*object.find("heading"), object.pointer("heading"), heading);
                }
                if (name.empty()) {
                    continue;
                }
            } else {
                problems_.refuse(k_wrong_type, document_.where(at), described(entry), "must be a name or an object",
                                 "name a column");
                continue;
            }
            add_column(name, heading, document_.where(at), table);
        }
        // What belongs to a result and stands before all of them belongs to the first.
        const auto first = std::find_if(table.columns.begin(), table.columns.end(),
                                        [](const ShownColumn& c) { return c.show == "value"; });
        for (ShownColumn& c : table.columns) {
            if (is_of_result(c.show) && c.of.empty() && first != table.columns.end()) {
                c.of = first->of;
                c.stage = first->stage;
            }
        }
    }

    void add_column(const std::string& name, const certificate::LocalisedText& heading, const std::string& where,
                    TableRequest& table) {
        if (name == "point" || is_of_result(name)) {
            ShownColumn entry{.show = name, .of = "", .heading = heading, .role = "", .stage = ""};
            for (const ShownColumn& c : table.columns) {
                if (c.show == "value" && name != "point") {
                    entry.of = c.of;
                    entry.stage = c.stage;
                }
            }
            table.columns.push_back(std::move(entry));
            return;
        }
        std::optional<ShownColumn> entry = shown(name);
        if (!entry) {
            const std::vector<std::string> meant = with_role(name);
            if (meant.size() > 1) {
                problems_.refuse(k_table_column, where,
                                 text::in_quotes(name) + " is the role of " + text::listed(quoted(meant), 5),
                                 "a role in a table stands for one quantity", "name the quantity");
                return;
            }
            entry = meant.empty() ? std::nullopt : shown(meant.front());
        }
        if (!entry) {
            refuse_name(name, where);
            return;
        }
        if (!heading.empty()) {
            entry->heading = heading;
        }
        table.columns.push_back(std::move(*entry));
    }

    [[nodiscard]] static std::vector<std::string> quoted(const std::vector<std::string>& names) {
        std::vector<std::string> all;
        for (const std::string& name : names) {
            all.push_back(text::in_quotes(name));
        }
        return all;
    }

    // ---- what is left out -------------------------------------------------------------------------------------------

    /// Whether a specification names a result, or a point of it that is here: "E", "E[10 mm]".
    [[nodiscard]] bool is_decided(const std::string& name) const {
        const auto [first, end] = points_of(section_);
        const auto begin_of_points = job_.points.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end_of_points = job_.points.begin() + static_cast<std::ptrdiff_t>(end);
        const auto names = [&](const certificate::AgreedSpecification& s) {
            return certificate::is_named(s.results, name) ||
                   std::any_of(begin_of_points, end_of_points, [&](const gum::BudgetPoint& point) {
                       return certificate::is_named(s.results, name + "[" + point.name + "]");
                   });
        };
        return job_.certificate &&
               std::any_of(job_.certificate->specifications.begin(), job_.certificate->specifications.end(), names);
    }

    void group_by_range(TableRequest& table) const {
        const PointColumn* const range = column(k_range);
        if (table.group_by.empty() && range != nullptr && has_words(*range) && is_here(*range)) {
            table.group_by = range->name;
        }
    }

    /// Columns of points, what has a role, and then each result with U, limit and verdict; before an adjustment first.
    void add_default(TableRequest table, const std::string& where) {
        group_by_range(table);
        const auto is_limit = [](const std::string& name) {
            return std::find(certificate::k_limit_columns.begin(), certificate::k_limit_columns.end(), name) !=
                   certificate::k_limit_columns.end();
        };
        const auto is_choice = [&](const std::string& name) {
            return std::any_of(table.where.begin(), table.where.end(), [&](const auto& w) { return w.column == name; });
        };
        for (const std::string_view stage :
             {std::string_view(), certificate::k_quantity_stages[0], certificate::k_quantity_stages[1]}) {
            const auto add = [&](const std::string& name) {
                const std::optional<ShownColumn> entry = shown(name);
                if (entry && entry->stage == stage &&
                    std::none_of(table.columns.begin(), table.columns.end(),
                                 [&](const auto& c) { return c.of == name; })) {
                    table.columns.push_back(*entry);
                }
            };
            for (const PointColumn& c : job_.point_columns) {
                if (!is_limit(c.name) && !is_choice(c.name) && c.name != table.group_by && has_words(c) && is_here(c)) {
                    add(c.name);
                }
            }
            for (const std::string_view role : certificate::k_quantity_roles) {
                for (const std::string& name : with_role(role)) {
                    if (result(name) == nullptr) {
                        add(name);
                    }
                }
            }
            for (const PointColumn& c : job_.point_columns) {
                if (!is_limit(c.name) && !has_words(c) && is_here(c)) {
                    add(c.name);
                }
            }
            for (const auto& [name, unit] : results_[section_]) {
                if (part_of_result(name).stage != stage) {
                    continue;
                }
                add(name);
                const auto of_result = [&, &name = name](const char* show) {
                    table.columns.push_back(
                        {.show = show, .of = name, .heading = {}, .role = "", .stage = std::string(stage)});
                };
                of_result("U");
                if (is_decided(name)) {
                    of_result("limit");
                    of_result("verdict");
                }
            }
        }
        const bool shows_points =
            std::any_of(table.columns.begin(), table.columns.end(), [](const auto& c) { return c.show == "column"; });
        if (!shows_points) {
            table.columns.insert(table.columns.begin(),
                                 {.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
        }
        const std::size_t before = job_.tables.size();
        finish(std::move(table), where);
        if (job_.tables.size() > before) {
            made_.push_back(before);
        }
    }

    // ---- names of points --------------------------------------------------------------------------------------------

    /// Whether the cell of a column says what the name of its point does: "10 V" beside 10 V, "10 kHz" beside 10000 Hz.
    [[nodiscard]] static bool says(const PointColumn& c, std::size_t point, const std::string& name) {
        if (point < c.printed.size() && !name.empty() && c.printed[point] == name) {
            return true;
        }
        if (point >= c.values.size() || !c.values[point]) {
            return false;
        }
        double number = 0.0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
        if (error != std::errc()) {
            return false;
        }
        std::string unit(end, name.data() + name.size());
        unit.erase(0, unit.find_first_not_of(' '));
        if (unit.empty() || unit == c.unit || unit == c.printed_unit) {
            return number == *c.values[point];
        }
        try {
            const Unit named = Unit::parse(unit), own = Unit::parse(c.unit);
            const double value = own.to_si(*c.values[point]);
            return gum::of_one_kind(named, own) && std::abs(named.to_si(number) - value) <= 1e-12 * std::abs(value);
        } catch (const gum::DiagnosedError&) {
            return false;  // "10 V, warm"
        }
    }

    /// The points whose names a cell of their row says, and the same cell of no other row: of two rows of 1 V none is "1".
    [[nodiscard]] std::set<std::size_t> points_that_are_said(const TableRequest& table) const {
        std::set<std::size_t> said;
        for (const ShownColumn& shown_column : table.columns) {
            const PointColumn* const c = shown_column.show == "column" ? column(shown_column.of) : nullptr;
            std::map<std::string, std::vector<std::size_t>> rows;  // by their cell
            for (std::size_t p = 0; c != nullptr && p < c->printed.size(); ++p) {
                if (holds(table, p)) {
                    rows[c->printed[p]].push_back(p);
                }
            }
            for (const auto& [cell, points] : rows) {
                if (points.size() == 1 && says(*c, points.front(), job_.points[points.front()].name)) {
                    said.insert(points.front());
                }
            }
        }
        return said;
    }

    /// What the row of a point shows beside its results, each text once, as certificate/point_names.h has it.
    [[nodiscard]] std::vector<std::string> cells(const TableRequest& table, std::size_t point) const {
        std::vector<std::string> texts;
        const auto add = [&](const std::string& name) {
            const PointColumn* const c = column(name);
            if (c == nullptr || point >= c->printed.size() || c->printed[point].empty()) {
                return;
            }
            std::string text = c->printed[point] + "\n" + c->printed_unit;
            if (std::find(texts.begin(), texts.end(), text) == texts.end()) {
                texts.push_back(std::move(text));
            }
        };
        add(table.group_by);
        for (const ShownColumn& c : table.columns) {
            if (c.show == "column") {
                add(c.of);
            }
        }
        return texts;
    }

    [[nodiscard]] static bool shows_points(const TableRequest& table) {
        return std::any_of(table.columns.begin(), table.columns.end(),
                           [](const ShownColumn& c) { return c.show == "point"; });
    }

    /// Points by a result and what their rows show beside the results, in tables that do not show their names.
    using RowsThatShow = std::map<std::pair<std::string, std::vector<std::string>>, std::set<std::size_t>>;
    [[nodiscard]] RowsThatShow rows_that_show() const {
        RowsThatShow rows;
        for (const TableRequest& table : job_.tables) {
            for (std::size_t p = 0; p < job_.points.size(); ++p) {
                if (shows_points(table) || !holds(table, p)) {
                    continue;
                }
                const std::vector<std::string> texts = cells(table, p);
                for (const ShownColumn& c : table.columns) {
                    if (c.show == "value") {
                        rows[{c.of, texts}].insert(p);
                    }
                }
            }
        }
        return rows;
    }

    /// Whether another row shows a result of the table beside the same cells: no sentence tells which of both it means.
    [[nodiscard]] bool is_like_another(const RowsThatShow& rows, const TableRequest& table, std::size_t point) const {
        const std::vector<std::string> texts = cells(table, point);
        return std::any_of(table.columns.begin(), table.columns.end(), [&](const ShownColumn& c) {
            const auto found = c.show == "value" ? rows.find({c.of, texts}) : rows.end();
            return found != rows.end() && found->second.size() > 1;
        });
    }

    /// Sentences name a value by its point ("E[low]"): a table that the program makes shows the names that its rows do not
    /// say anyway (ISO/IEC 17025:2017, 7.8.6.2 a). Numbers that count the rows are left out until a specification, or what
    /// another laboratory provided, needs them. Columns that the job chooses stay as they are, and what is needed is told.
    void name_points() {
        const RowsThatShow rows = job_.certificate ? rows_that_show() : RowsThatShow();
        for (std::size_t t = 0; t < job_.tables.size(); ++t) {
            TableRequest& table = job_.tables[t];
            if (shows_points(table)) {
                continue;
            }
            const bool is_made = std::find(made_.begin(), made_.end(), t) != made_.end();
            const std::set<std::size_t> said = points_that_are_said(table);
            bool needed = false;
            std::vector<std::string> alone;
            for (std::size_t p = 0; p < job_.points.size(); ++p) {
                if (!holds(table, p)) {
                    continue;
                }
                const std::string& name = job_.points[p].name;
                const bool is_said = said.contains(p);
                if ((!is_said || is_like_another(rows, table, p)) && is_named_alone(p)) {
                    alone.push_back(text::in_quotes(name));
                }
                needed = needed || !alone.empty() || (!is_said && name != std::to_string(p + 1));
            }
            if (is_made && needed) {
                table.columns.insert(table.columns.begin(),
                                     {.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
            } else if (!is_made && !alone.empty()) {
                problems_.warn(k_warn_point_not_shown, document_.where("/certificate"),
                               "the certificate names a result of the point" +
                                   std::string(alone.size() == 1 ? " " : "s ") + text::listed(alone, 5) +
                                   " alone, and the table does not say which row that is",
                               "a certificate says to which results a statement of conformity applies, and which ones "
                               "another laboratory provided (ISO/IEC 17025:2017, 7.8.6.2 a and 7.8.2.1 p)",
                               "add \"point\" to the columns of the table");
            }
        }
    }

    /// Whether a specification, or what another laboratory provided, names a result of one point, not of all of them.
    [[nodiscard]] bool is_named_alone(std::size_t point) const {
        const auto& results = results_[section_of(point)];
        const auto names = [&](const auto& statement) {
            return std::any_of(results.begin(), results.end(), [&](const auto& known) {
                return certificate::is_named(statement.results, known.first + "[" + job_.points[point].name + "]") &&
                       !certificate::is_named(statement.results, known.first);
            });
        };
        return job_.certificate &&
               (std::any_of(job_.certificate->specifications.begin(), job_.certificate->specifications.end(), names) ||
                std::any_of(job_.certificate->external_results.begin(), job_.certificate->external_results.end(),
                            names));
    }

    void finish(TableRequest table, const std::string& where) {
        group_by_range(table);
        std::erase_if(table.columns, [&](const ShownColumn& c) {
            return c.of == table.group_by && c.show == "column" && !c.of.empty();
        });
        std::set<std::string> values, uncertainties;
        for (const ShownColumn& c : table.columns) {
            if (is_of_result(c.show) && c.of.empty()) {
                problems_.refuse(k_table_incomplete, where, text::in_quotes(c.show) + " in a table without a result",
                                 "U, k, limit and verdict are those of the result that stands before them",
                                 "add the result");
                return;
            }
            if (c.show == "value") {
                values.insert(c.of);
            } else if (c.show == "U") {
                uncertainties.insert(c.of);
            }
        }
        for (const std::string& name : values) {
            if (!uncertainties.contains(name)) {
                problems_.refuse(k_table_incomplete, where, "the table shows " + text::in_quotes(name) + " without U",
                                 "a certificate states the uncertainty of every result (ISO/IEC 17025:2017, 7.8.4.1 a)",
                                 "add \"U\" behind " + text::in_quotes(name));
            }
        }
        if (values.empty()) {
            problems_.refuse(k_table_incomplete, where, "a table without a result", "a table shows one result at least",
                             "add the name of a result");
        }
        for (const TableRequest::GroupUnit& unit : table.units) {
            const PointColumn* const groups = table.group_by.empty() ? nullptr : column(table.group_by);
            if (groups == nullptr ||
                std::find(groups->printed.begin(), groups->printed.end(), unit.group) == groups->printed.end()) {
                problems_.refuse(k_table_column, where,
                                 "units of the group " + text::in_quotes(unit.group) + ", which no point has",
                                 "units are stated for the groups of the rows",
                                 groups == nullptr ? "state the column of the groups (\"group_by\")"
                                                   : "correct the name of the group");
            }
        }
        check_units(table, where);
        if (!job_.sections.empty()) {
            table.section = job_.sections[section_].name;
        }
        job_.tables.push_back(std::move(table));
    }

    /// Unit of what a table shows under a name; none of words, and of limits, which are in that of a specification.
    [[nodiscard]] std::optional<Unit> unit_of(const std::string& name) const {
        if (const PointColumn* const c = column(name)) {
            return c->unit.empty() ? std::nullopt : std::optional(Unit::parse(c->unit));
        }
        if (const Unit* const of_result = result(name)) {
            return *of_result;
        }
        if (const std::optional<std::size_t> i = input(name)) {
            return job_.inputs[*i].unit;
        }
        const std::optional<std::size_t> i = input_of_scatter(name);
        return i ? std::optional(Unit::parse(gum::unit_of_difference(job_.inputs[*i].unit.text()))) : std::nullopt;
    }

    /// A number in a unit of another kind would be another quantity: 20 °C is not 20 K, and an error of 0.1 K not 32.2 °F.
    void check_units(const TableRequest& table, const std::string& where) {
        for (const TableRequest::GroupUnit& stated : table.units) {
            const Unit unit = Unit::parse(stated.unit);
            const auto fits = [&](const std::string& name) {
                const std::optional<Unit> own = unit_of(name);
                return own && of_one_kind(*own, unit);
            };
            const bool fits_any = std::any_of(table.columns.begin(), table.columns.end(),
                                              [&](const ShownColumn& c) { return !c.of.empty() && fits(c.of); });
            if (stated.of.empty() ? fits_any : fits(stated.of)) {
                continue;
            }
            const std::optional<Unit> own = stated.of.empty() ? std::nullopt : unit_of(stated.of);
            problems_.refuse(
                k_unit_does_not_fit, where,
                "the unit " + text::in_quotes(stated.unit) + " of the group " + text::in_quotes(stated.group) +
                    (stated.of.empty() ? " fits nothing that the table shows"
                     : own             ? ", and " + text::in_quotes(stated.of) + " is in " + own->text()
                                       : ", and " + text::in_quotes(stated.of) + " has no unit"),
                "a number is stated in units of its kind: temperatures of a scale with an origin in degC or degF, "
                "differences and thermodynamic temperatures in K, differences in delta_degF too",
                "correct the unit, or state it for the columns that it fits");
        }
    }

    /// Degrees, minutes and seconds are parts of a number of seconds, or of minutes, and of no other.
    void check_forms() {
        const auto check = [&](const std::string& name, const std::string& form, const std::string& unit,
                               const std::string& pointer) {
            if (!form.empty() && !certificate::last_part_of(unit)) {
                problems_.refuse(k_angle_in_parts, document_.where(pointer),
                                 "the form \"sexagesimal\" of " + text::in_quotes(name) + ", whose unit is " + unit,
                                 "degrees, minutes and seconds are a decimal number of the last of them: it is rounded "
                                 "there, at the digit of U",
                                 "state the unit arcsec, or arcmin for degrees and minutes");
            }
        };
        for (const PointColumn& c : job_.point_columns) {
            check(c.name, c.form, c.unit.empty() ? "1" : c.unit, "/points");
        }
        for (const gum::BudgetInput& i : job_.inputs) {
            check(i.name, part_of_input(i.name).form, i.unit.text(), child_pointer("/inputs", i.name));
        }
        for (const auto& results : results_) {
            for (const auto& [name, unit] : results) {
                check(name, part_of_result(name).form, unit.text(), "/outputs");
            }
        }
    }

    // ---- what follows from it ---------------------------------------------------------------------------------------

    /// Whether nobody wrote the value down: it is a sum (as that of a standard of the register is), a mean, or the middle
    /// of two limits.
    [[nodiscard]] static bool is_computed(const gum::BudgetInput& input) {
        constexpr std::array<std::string_view, 5> k_without_value{"observations", "groups", "samples", "limits",
                                                                  "distribution"};
        const gum::StatedQuantity& first = input.components.front();
        return input.components.size() > 1 || !first.name.empty() ||
               std::find(k_without_value.begin(), k_without_value.end(), first.statement) != k_without_value.end();
    }

    /// With the decimals that were written; of a mean no more than double precision holds.
    [[nodiscard]] static std::string as_written(double value, int decimals) {
        constexpr int k_last_digit = 14;  // behind the first one
        const int most =
            value == 0.0 ? decimals : k_last_digit - static_cast<int>(std::floor(std::log10(std::abs(value))));
        return gum::round_as_written(value, std::clamp(decimals, 0, std::max(most, 0)));
    }

    /// The inputs that tables and limits name become columns of the points.
    void add_inputs() {
        std::set<std::string> wanted;
        for (const TableRequest& table : job_.tables) {
            for (const ShownColumn& c : table.columns) {
                if (c.show == "column") {
                    wanted.insert(c.of);
                }
            }
        }
        if (job_.certificate) {
            for (const certificate::AgreedSpecification& s : job_.certificate->specifications) {
                if (s.limits) {
                    for (const std::string& name : certificate::columns_of_limits(*s.limits)) {
                        wanted.insert(name);
                    }
                }
            }
        }
        for (std::size_t i = 0; i < job_.inputs.size(); ++i) {
            const gum::BudgetInput& stated = job_.inputs[i];
            if (!wanted.contains(stated.name) || column(stated.name) != nullptr) {
                continue;
            }
            PointColumn added;
            added.name = stated.name;
            const QuantityPart part = part_of_input(stated.name);
            added.role = part.role;
            added.stage = part.stage;
            added.form = part.form;
            if (const auto described = job_.input_descriptions.find(stated.name);
                added.role.empty() && described != job_.input_descriptions.end()) {
                added.heading = described->second;
            }
            added.unit = stated.unit.text();
            added.printed_unit = gum::unit_for_people(added.unit);
            for (std::size_t p = 0; p < job_.points.size(); ++p) {
                if (!job_.sections.empty() && !points_.is_used(stated.name, section_of(p))) {
                    added.values.emplace_back();
                    added.printed.emplace_back();
                    continue;
                }
                const gum::BudgetInput& here = gum::input_at(job_, i, p);
                const gum::InputTotal total = gum::input_total(here);
                const double value = stated.unit.from_si(total.value);
                added.values.emplace_back(value);
                if (const std::optional<int> decimals = points_.decimals(stated.name, p)) {
                    added.printed.push_back(as_written(value, *decimals));
                } else if (is_computed(here) && total.u > 0.0) {
                    // Digits behind the uncertainty are those of a computation (JCGM 100:2008, 7.2.6).
                    added.printed.push_back(
                        gum::round_to_uncertainty(value, stated.unit.difference_from_si(total.u)).value);
                    added.decimals = "of_uncertainty";
                } else {
                    const std::string shortest = text::shortest(text::rounded_number(value, text::k_digits_held));
                    added.printed.push_back(as_written(
                        value, inputs_.decimals_of_job(stated.name).value_or(text::most_decimals({&shortest, 1}))));
                }
            }
            job_.point_columns.push_back(std::move(added));
        }
        for (const std::string& name : wanted) {
            if (const std::optional<std::size_t> i = input_of_scatter(name); i && column(name) == nullptr) {
                add_scatter(name, *i);
            }
        }
    }

    /// s of the readings of each point (JCGM 100:2008, 4.2.2, eq. 4), with two significant digits.
    void add_scatter(const std::string& name, std::size_t i) {
        const gum::BudgetInput& stated = job_.inputs[i];
        PointColumn added;
        added.name = name;
        added.stage = part_of_input(stated.name).stage;
        added.unit = gum::unit_of_difference(stated.unit.text());
        added.printed_unit = gum::unit_for_people(added.unit);
        for (std::size_t p = 0; p < job_.points.size(); ++p) {
            const std::vector<double> readings = readings_at(i, p);
            if (readings.empty()) {
                added.values.emplace_back();
                added.printed.emplace_back();
                continue;
            }
            const double s = stated.unit.difference_from_si(gum::evaluate_type_a(readings).standard_deviation);
            added.values.emplace_back(s);
            added.printed.push_back(s > 0.0 ? gum::round_to_uncertainty(s, s).value : "0");
        }
        job_.point_columns.push_back(std::move(added));
    }

    /// Limits may stand in columns, which have to be known.
    void check_columns_of_limits() {
        if (!job_.certificate || job_.points.empty()) {
            return;
        }
        for (const certificate::AgreedSpecification& s : job_.certificate->specifications) {
            for (const std::string& needed :
                 s.limits ? certificate::columns_of_limits(*s.limits) : std::vector<std::string>()) {
                if (column(needed) != nullptr) {
                    continue;
                }
                if (std::vector<std::string> names = columns_with_role(needed); !names.empty()) {
                    std::transform(names.begin(), names.end(), names.begin(),
                                   [](const std::string& name) { return text::in_quotes(name); });
                    problems_.refuse(k_table_column, document_.where("/certificate"),
                                     text::in_quotes(needed) + " is the role of " + text::listed(names, 5) +
                                         ", and no column of the points",
                                     "limits know columns of points and inputs by their names",
                                     "write " + names.front() + " in its place");
                } else {
                    refuse_name(needed, document_.where("/certificate"));
                }
            }
        }
    }

    [[nodiscard]] bool holds(const TableRequest& table, std::size_t point) const {
        if (!table.section.empty() && table.section != job_.sections[section_of(point)].name) {
            return false;
        }
        return std::all_of(table.where.begin(), table.where.end(), [&](const TableRequest::RowChoice& choice) {
            const PointColumn* const c = column(choice.column);
            return c != nullptr && point < c->printed.size() && c->printed[point] == choice.is;
        });
    }

    void check_points() {
        std::vector<std::string> nowhere;
        for (std::size_t p = 0; p < job_.points.size() && !job_.tables.empty(); ++p) {
            if (std::none_of(job_.tables.begin(), job_.tables.end(), [&](const auto& t) { return holds(t, p); })) {
                nowhere.push_back(text::in_quotes(job_.points[p].name));
            }
        }
        if (!nowhere.empty()) {
            problems_.refuse(
                k_table_incomplete, document_.where("/tables"),
                "no table shows the point" + std::string(nowhere.size() == 1 ? " " : "s ") + text::listed(nowhere, 5),
                "what was measured stands in a table", "correct \"where\", or add a table");
        }
        for (std::size_t t = 0; t < job_.tables.size(); ++t) {
            for (std::size_t p = 0; p < job_.points.size(); ++p) {
                if (holds(job_.tables[t], p)) {
                    break;
                }
                if (p + 1 == job_.points.size()) {
                    problems_.refuse(k_table_incomplete, document_.where(child_pointer("/tables", t)),
                                     "a table without rows: no point has what \"where\" says",
                                     "a table shows one point at least", "correct \"where\"");
                }
            }
        }
        std::set<std::pair<std::string, std::size_t>> seen;
        for (const TableRequest& table : job_.tables) {
            std::set<std::string> names;
            for (const ShownColumn& c : table.columns) {
                if (c.show == "value") {
                    names.insert(c.of);
                }
            }
            for (std::size_t p = 0; p < job_.points.size(); ++p) {
                for (const std::string& name : names) {
                    if (holds(table, p) && !seen.emplace(name, p).second) {
                        problems_.refuse(k_table_incomplete, document_.where("/tables"),
                                         "two tables show " + text::in_quotes(name) + " of the same points",
                                         "a result stands in one table", "remove it from one of them");
                        return;
                    }
                }
            }
        }
    }

    /// Results are stated in the units of their groups.
    void set_units() {
        for (const TableRequest& table : job_.tables) {
            if (table.units.empty()) {
                continue;
            }
            job_.point_units.resize(job_.points.size());
            const PointColumn* const groups = column(table.group_by);
            for (std::size_t p = 0; p < job_.points.size(); ++p) {
                if (!holds(table, p)) {
                    continue;
                }
                for (const TableRequest::GroupUnit& stated : table.units) {
                    if (groups == nullptr || groups->printed[p] != stated.group) {
                        continue;
                    }
                    const Unit unit = Unit::parse(stated.unit);
                    for (const ShownColumn& c : table.columns) {
                        const Unit* const own = c.show == "value" ? result(c.of, section_of(p)) : nullptr;
                        if (own == nullptr || (!stated.of.empty() && stated.of != c.of) || !of_one_kind(*own, unit)) {
                            continue;
                        }
                        // A unit of one result goes before that of all.
                        if (!stated.of.empty()) {
                            job_.point_units[p].insert_or_assign(c.of, unit);
                        } else {
                            job_.point_units[p].emplace(c.of, unit);
                        }
                    }
                }
            }
        }
    }
};

}  // namespace

void read_tables(const std::vector<JsonObject>& parts, const JsonDocument& document, const BudgetInputs& inputs,
                 const BudgetPoints& points, BudgetJob& job, ProblemList& problems) {
    const bool has_limits =
        job.certificate && std::any_of(job.certificate->specifications.begin(), job.certificate->specifications.end(),
                                       [](const auto& s) { return s.limits.has_value(); });
    const bool is_wanted = parts.empty() || !job.sections.empty() || parts.front().has("tables") || has_limits ||
                           !job.point_columns.empty() || !job.input_parts.empty() || !job.output_parts.empty();
    if (!is_wanted || problems.refusals() > 0 || !inputs.symbols_are_whole()) {
        return;  // nothing to show; or names and units are not known, as of a standard whose file was refused
    }
    TableReader(document, inputs, points, job, problems).read(parts);
}

}  // namespace gumcert::jobs
