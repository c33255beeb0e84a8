#include "reports/record/certified_tables.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
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

std::vector<Series> series_of(const std::vector<Result>& results) {
    std::vector<Series> all;
    for (const Result& r : results) {
        const std::string quantity = r.quantity.empty() ? r.name : r.quantity;
        const auto found = std::find_if(all.begin(), all.end(), [&](const Series& s) {
            // A quantity without points has one result; a second one of that name is a column of its own.
            return s.quantity == quantity && s.unit == r.unit && !r.point.empty() && !s.results.front()->point.empty();
        });
        (found == all.end() ? all.emplace_back(Series{quantity, r.unit, {}}) : *found).results.push_back(&r);
    }
    return all;
}

std::vector<CertifiedTable> tables_of_results(const std::vector<Result>& results, const std::string& id) {
    std::vector<std::pair<std::vector<std::string>, CertifiedTable>> tables;  // with the points that they share
    for (const Series& series : series_of(results)) {
        const std::vector<std::string> points = series.points();
        auto at = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == points; });
        if (at == tables.end()) {
            CertifiedTable table{.id = id, .argument = {}, .columns = {}};
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
        at->second.columns.push_back(column(series.quantity,
                                            !first.description_by_language.empty() ? first.description_by_language
                                            : first.description.empty() ? certificate::LocalisedText(series.quantity)
                                                                        : certificate::LocalisedText(first.description),
                                            series.unit, std::move(values)));
    }
    std::vector<CertifiedTable> out;
    for (auto& [points, table] : tables) {
        out.push_back(std::move(table));
    }
    return out;
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
        angles.values.emplace_back(at.angle_deg);
        angles.printed.push_back(at.printed_angle);
    }
    return angles;
}

/// One table a group, one column a quantity.
void add_stated_values(const RotaryTable& r, std::vector<CertifiedTable>& tables) {
    for (const auto& place : stated_values(r, ErrorOrder::by_motion)) {
        const bool motions = place.group == StatedGroup::error_motions;
        if (const char* const id = group_name(place.group); tables.empty() || tables.back().id != id) {
            tables.push_back(
                {.id = id, .argument = motions ? std::optional(angles_of(r)) : std::nullopt, .columns = {}});
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
    if (!record.rotary) {
        std::vector<CertifiedTable> tables = tables_of_results(record.results, "results");
        if (record.circle_closure) {
            put_angles(*record.circle_closure, tables);
        }
        return tables;
    }
    std::vector<CertifiedTable> tables = tables_of_results(record.results, "set_up");
    add_stated_values(*record.rotary, tables);
    return tables;
}

}  // namespace gumcert::reports
