#include "reports/record/certified_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/reported_result.h"
#include "reports/record/stated_values.h"

namespace gumcert::reports {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

CertifiedValue value_of(double value, double u, std::optional<double> U, std::optional<double> k,
                        std::optional<double> nu_eff, const Printed& printed) {
    CertifiedValue out;
    out.value = value;
    out.u = u;
    out.nu_eff = nu_eff;
    out.printed_value = printed.value;
    if (printed.U.empty()) {  // a value without uncertainty by definition, or one that none can be stated for
        return out;
    }
    out.U = U;
    out.k = k;
    out.printed_U = printed.U;
    out.printed_k = k ? certificate::printed_coverage_factor(*k) : "";
    out.printed_nu_eff = U ? certificate::printed_degrees_of_freedom(nu_eff) : "";
    return out;
}

/// \param coverage  of the law of propagation
CertifiedValue value_of(const ReportedResult& reported, const std::optional<double>& nu_eff,
                        const std::string& coverage) {
    CertifiedValue out =
        value_of(reported.value, reported.u.value_or(0.0), reported.U, reported.k, nu_eff, reported.printed);
    out.coverage = reported.method == "monte_carlo" ? "monte_carlo" : coverage;
    if (out.coverage == "monte_carlo" || out.coverage == "none") {
        out.nu_eff.reset();
        out.printed_nu_eff.clear();  // k does not rest on them
    }
    if (reported.interval && !reported.U) {
        out.interval = {(*reported.interval)[0], (*reported.interval)[1]};
        out.printed_u = reported.printed_u;
        out.printed_low = reported.printed_low;
        out.printed_high = reported.printed_high;
    }
    return out;
}

CertifiedValue value_of(const Result& r) {
    return value_of(reported_result(r), r.nu_eff, r.coverage);
}

CertifiedValue value_of(const StatedValue& q) {
    return q.reported ? value_of(*q.reported, q.nu_eff, "student_t")
                      : value_of(q.value, q.u, q.U, q.k, q.nu_eff, q.printed);
}

/// What a result is, for people.
certificate::LocalisedText name_of(const Result& r) {
    return !r.description_by_language.empty() ? r.description_by_language
           : r.description.empty()            ? certificate::LocalisedText(r.quantity.empty() ? r.name : r.quantity)
                                              : certificate::LocalisedText(r.description);
}

CertifiedColumn column(const std::string& result, const certificate::LocalisedText& name, const std::string& unit,
                       std::vector<CertifiedValue> values) {
    return {.result = result,
            .name = name,
            .unit = unit,
            .printed_unit = gum::unit_for_people(unit),
            .values = std::move(values)};
}

/// A quantity of a budget: its results in the order of the record.
struct Series {
    std::string quantity, unit;
    std::vector<const Result*> results;

    [[nodiscard]] std::vector<std::string> points() const {
        std::vector<std::string> names;
        for (const Result* r : results) {
            names.push_back(r->point);
        }
        return names;
    }
};

std::vector<Series> series_of(const std::vector<const Result*>& results) {
    std::vector<Series> all;
    for (const Result* const result : results) {
        const Result& r = *result;
        const std::string quantity = r.quantity.empty() ? r.name : r.quantity;
        const auto found = std::find_if(all.begin(), all.end(), [&](const Series& s) {
            // A quantity without points has one result; a second one of that name is a column of its own.
            return s.quantity == quantity && s.unit == r.unit && !r.point.empty() && !s.results.front()->point.empty();
        });
        (found == all.end() ? all.emplace_back(Series{quantity, r.unit, {}}) : *found).results.push_back(&r);
    }
    return all;
}

std::vector<CertifiedTable> tables_of_results(const std::vector<const Result*>& results, const std::string& id) {
    std::vector<std::pair<std::vector<std::string>, CertifiedTable>> tables;  // with the points that they share
    for (const Series& series : series_of(results)) {
        const std::vector<std::string> points = series.points();
        auto at = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == points; });
        if (at == tables.end()) {
            CertifiedTable table{.id = id, .argument = {}, .layout = {}, .columns = {}};
            if (!points.front().empty()) {
                table.argument = CertifiedTable::Argument{.name = "point",
                                                          .unit = "",
                                                          .printed_unit = "",
                                                          .values = std::vector<std::optional<double>>(points.size()),
                                                          .printed = points};
            }
            at = tables.insert(tables.end(), {points, std::move(table)});
        }
        const Result& first = *series.results.front();
        std::vector<CertifiedValue> values;
        for (const Result* r : series.results) {
            values.push_back(value_of(*r));
        }
        at->second.columns.push_back(column(series.quantity, name_of(first), series.unit, std::move(values)));
    }
    std::vector<CertifiedTable> out;
    for (auto& [points, table] : tables) {
        out.push_back(std::move(table));
    }
    return out;
}

/// Unit of a column or a result in a group of rows; that which it has without one.
std::string unit_in_group(const certificate::TableRequest& table, const std::string& group, const std::string& name,
                          const std::string& unit) {
    std::string found = unit;
    for (const certificate::TableRequest::GroupUnit& stated : table.units) {
        if (stated.group != group || (!stated.of.empty() && stated.of != name) ||
            !gum::of_one_kind(gum::Unit::parse(stated.unit), gum::Unit::parse(unit))) {
            continue;
        }
        if (!stated.of.empty()) {
            return stated.unit;
        }
        found = stated.unit;
    }
    return found;
}

/// A number that was converted by a factor that is no power of ten: all of its digits, where it has at most two more than
/// `decimals` (2.54 mm of 0.1 in), else one more. The step that was written is then ten steps of the last digit at least,
/// and rounding takes a twentieth of it at most.
std::string converted(double value, int decimals) {
    constexpr double k_noise = 1e-6;  // of the last digit
    for (int all = std::max(decimals, 0); all <= decimals + 2; ++all) {
        const double steps = value * std::pow(10.0, all);
        if (std::abs(steps - std::round(steps)) <=
            k_noise + 4.0 * std::numeric_limits<double>::epsilon() * std::abs(steps)) {
            return gum::round_as_written(value, all);
        }
    }
    return gum::round_as_written(value, std::max(decimals + 1, 0));
}

/// The rows of a group in the unit of the group, each with the decimals that it has: zeros up to those of another row would
/// claim digits that nobody wrote and no display showed. A value that was computed may end above the unit digit.
certificate::PointColumn in_group(const certificate::PointColumn& all, const std::vector<std::size_t>& rows,
                                  const std::string& unit) {
    certificate::PointColumn column = all;
    column.values.clear();
    column.printed.clear();
    for (const std::size_t row : rows) {
        column.values.push_back(all.values[row]);
        column.printed.push_back(all.printed[row]);
    }
    if (unit == all.unit) {
        return column;
    }
    const bool is_computed = all.decimals == "of_uncertainty";
    // "s(V_x)", as no column is called that a job declares: two significant digits in every unit (JCGM 100:2008, 7.2.6).
    const bool is_deviation = all.name.starts_with("s(");
    const gum::Unit from = gum::Unit::parse(all.unit);
    const gum::Unit to = gum::Unit::parse(unit);
    constexpr double k_noise = 1e-9;
    const double exponent = std::log10(to.difference_from_si(from.difference_to_si(1.0)));
    const int shift = static_cast<int>(std::floor(exponent + k_noise));
    const bool is_power_of_ten = std::abs(exponent - shift) < k_noise;
    column.unit = unit;
    column.printed_unit = gum::unit_for_people(unit);
    for (std::size_t i = 0; i < column.values.size(); ++i) {
        if (std::optional<double>& value = column.values[i]) {
            value = to.from_si(from.to_si(*value));
            const int own = certificate::decimals_of(column.printed[i]) - shift;
            column.printed[i] = is_computed                    ? gum::round_to_quantum(*value, own)
                                : is_deviation && *value > 0.0 ? gum::round_to_uncertainty(*value, *value).value
                                : is_power_of_ten              ? gum::round_as_written(*value, std::max(own, 0))
                                                               : converted(*value, own);
        }
    }
    return column;
}

/// One group of rows of a table that the job asks for.
CertifiedTable table_of_group(const EvaluationRecord& record, const certificate::TableRequest& request,
                              const std::vector<std::size_t>& rows, const std::string& group) {
    const certificate::PointTable& points = *record.points;
    const auto column_of = [&](const std::string& name) {
        return std::find_if(points.columns.begin(), points.columns.end(),
                            [&](const certificate::PointColumn& c) { return c.name == name; });
    };
    CertifiedTable table{.id = "results", .argument = CertifiedTable::Argument{}, .layout = {}, .columns = {}};
    table.argument->name = "point";
    for (const std::size_t row : rows) {
        table.argument->values.emplace_back();
        table.argument->printed.push_back(points.points[row]);
    }
    certificate::TableLayout& layout = table.layout.emplace();
    layout.title = request.title;
    layout.group = group;
    if (const auto groups = column_of(request.group_by); groups != points.columns.end()) {
        layout.group_heading = groups->heading.empty() ? certificate::LocalisedText(groups->name) : groups->heading;
        layout.group_role = !groups->heading.empty() ? "" : groups->role.empty() ? groups->name : groups->role;
    }
    layout.shown = request.columns;
    layout.plot = request.plot;
    for (const certificate::ShownColumn& shown : request.columns) {
        const auto from = shown.show == "column" ? column_of(shown.of) : points.columns.end();
        if (from != points.columns.end()) {
            const std::string unit = from->unit.empty() ? "" : unit_in_group(request, group, from->name, from->unit);
            layout.columns.push_back(in_group(*from, rows, unit));
        }
        const bool is_known = std::any_of(table.columns.begin(), table.columns.end(),
                                          [&](const CertifiedColumn& c) { return c.result == shown.of; });
        if (shown.show == "column" || shown.show == "point" || is_known) {
            continue;
        }
        std::vector<CertifiedValue> values;
        const Result* first = nullptr;
        for (const std::size_t row : rows) {
            const auto result = std::find_if(record.results.begin(), record.results.end(), [&](const Result& r) {
                return r.quantity == shown.of && r.point == points.points[row];
            });
            if (result != record.results.end()) {
                first = first == nullptr ? &*result : first;
                values.push_back(value_of(*result));
            }
        }
        if (first != nullptr && values.size() == rows.size()) {
            table.columns.push_back(column(shown.of, name_of(*first), first->unit, std::move(values)));
        }
    }
    return table;
}

/// Points that stand one after the other.
struct PointRange {
    std::size_t first = 0, end = 0;
};

/// \param section  whose points these are; "" without sections
std::vector<CertifiedTable> tables_of_points(const EvaluationRecord& record, const std::string& section,
                                             const PointRange& range) {
    const certificate::PointTable& points = *record.points;
    const auto word_of = [&](const std::string& name, std::size_t row) -> std::string {
        const auto found = std::find_if(points.columns.begin(), points.columns.end(),
                                        [&](const certificate::PointColumn& c) { return c.name == name; });
        return found == points.columns.end() ? "" : found->printed[row];
    };
    std::vector<CertifiedTable> tables;
    for (const certificate::TableRequest& request : points.tables) {
        if (request.section != section) {
            continue;
        }
        std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;  // in the order of the points
        for (std::size_t row = range.first; row < range.end; ++row) {
            if (!std::all_of(request.where.begin(), request.where.end(),
                             [&](const auto& choice) { return word_of(choice.column, row) == choice.is; })) {
                continue;
            }
            const std::string group = word_of(request.group_by, row);
            const auto known =
                std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == group; });
            (known == groups.end() ? groups.emplace_back(group, std::vector<std::size_t>{}) : *known)
                .second.push_back(row);
        }
        for (const auto& [group, rows] : groups) {
            tables.push_back(table_of_group(record, request, rows, group));
        }
    }
    return tables;
}

std::vector<const Result*> all_of(const std::vector<Result>& results) {
    std::vector<const Result*> all;
    for (const Result& r : results) {
        all.push_back(&r);
    }
    return all;
}

/// Section by section: the tables that the job asks for, else one of its results.
std::vector<CertifiedTable> tables_of_sections(const EvaluationRecord& record) {
    std::vector<CertifiedTable> all;
    PointRange range;
    for (const SectionSummary& section : record.sections) {
        range = {.first = range.end, .end = range.end + static_cast<std::size_t>(section.points)};
        std::vector<CertifiedTable> tables;
        if (record.points) {
            tables = tables_of_points(record, section.name, range);
        }
        if (tables.empty()) {
            std::vector<const Result*> own;
            for (const Result& r : record.results) {
                if (std::find(section.quantities.begin(), section.quantities.end(), r.quantity) !=
                    section.quantities.end()) {
                    own.push_back(&r);
                }
            }
            tables = tables_of_results(own, "results");
        }
        for (CertifiedTable& table : tables) {
            table.section = section.name;
            all.push_back(std::move(table));
        }
    }
    return all;
}

/// The points of a circle closure are angles.
void put_angles(const CircleClosure& closure, std::vector<CertifiedTable>& tables) {
    for (CertifiedTable& table : tables) {
        const bool of_artefact = table.columns.front().result == closure.artefact;
        const std::vector<double>& angles = of_artefact ? closure.side_angles_deg : closure.step_angles_deg;
        if (table.argument && table.argument->values.size() == angles.size()) {
            table.argument->name = "angle";
            table.argument->unit = "deg";
            table.argument->printed_unit = gum::unit_for_people("deg");
            for (std::size_t i = 0; i < angles.size(); ++i) {
                table.argument->values[i] = angles[i];
            }
        }
    }
}

/// The angles of a rotary table, printed.
CertifiedTable::Argument angles_of(const RotaryTable& r) {
    CertifiedTable::Argument angles{
        .name = "angle", .unit = "deg", .printed_unit = gum::unit_for_people("deg"), .values = {}, .printed = {}};
    for (const ErrorsAtAngle& at : r.errors) {
        angles.values.emplace_back(at.angle_deg.number);
        angles.printed.push_back(at.angle_deg.text);
    }
    return angles;
}

/// One table a group, one column a quantity.
void add_stated_values(const RotaryTable& r, std::vector<CertifiedTable>& tables) {
    for (const auto& place : stated_values(r, ErrorOrder::by_motion)) {
        const bool motions = place.group == StatedGroup::error_motions;
        if (const char* const id = group_name(place.group); tables.empty() || tables.back().id != id) {
            tables.push_back({.id = id,
                              .argument = motions ? std::optional(angles_of(r)) : std::nullopt,
                              .layout = {},
                              .columns = {}});
        }
        std::vector<CertifiedColumn>& columns = tables.back().columns;
        if (!motions || place.index == 0) {
            columns.push_back(column(result_name(place.group, place.name), place.meaning, place.unit, {}));
        }
        columns.back().values.push_back(value_of(place.stated));
    }
}

template <class Results>
auto* find_result(Results& results, const CertifiedTable& table, const std::string& name, std::size_t row) {
    const std::string point =
        table.argument && row < table.argument->printed.size() ? table.argument->printed[row] : "";
    const bool holds_results = table.id == "results" || table.id == "set_up";
    const auto found = std::find_if(results.begin(), results.end(), [&](const Result& r) {
        return holds_results && (r.quantity.empty() ? r.name : r.quantity) == name && r.point == point;
    });
    return found == results.end() ? nullptr : &*found;
}

}  // namespace

Result* result_of(EvaluationRecord& record, const CertifiedTable& table, const std::string& name, std::size_t row) {
    return find_result(record.results, table, name, row);
}

const Result* result_of(const EvaluationRecord& record, const CertifiedTable& table, const std::string& name,
                        std::size_t row) {
    return find_result(record.results, table, name, row);
}

std::vector<CertifiedTable> certified_tables(const EvaluationRecord& record) {
    if (!record.sections.empty()) {
        return tables_of_sections(record);
    }
    if (record.points && !record.points->tables.empty()) {
        return tables_of_points(record, "", {.first = 0, .end = record.points->points.size()});
    }
    if (!record.rotary) {
        std::vector<CertifiedTable> tables = tables_of_results(all_of(record.results), "results");
        if (record.circle_closure) {
            put_angles(*record.circle_closure, tables);
        }
        return tables;
    }
    std::vector<CertifiedTable> tables = tables_of_results(all_of(record.results), "set_up");
    add_stated_values(*record.rotary, tables);
    return tables;
}

bool shows_verdict(const CertifiedTable& table, const std::string& result) {
    const auto shows = [&](const auto& holds) {
        return table.layout &&
               std::any_of(table.layout->shown.begin(), table.layout->shown.end(),
                           [&](const certificate::ShownColumn& c) { return c.of == result && holds(c.show); });
    };
    return shows([](const std::string& show) { return show == "verdict"; }) &&
           shows([](const std::string& show) { return show.starts_with("limit"); });
}

}  // namespace gumcert::reports
