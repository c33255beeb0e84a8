#include "reports/record/certified_tables.h"

#include <algorithm>
#include <string>
#include <utility>

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "reports/record/reported_result.h"

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

/// Of a quantity of a rotary table.
template <class Quantity>
CertifiedValue value_of(const Quantity& q, const std::optional<double>& k) {
    return q.reported ? value_of(*q.reported, q.nu_eff, "student_t")
                      : value_of(q.value, q.u, q.U, k, q.nu_eff, q.printed);
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

CertifiedTable error_motions(const RotaryTable& r) {
    CertifiedTable table{.id = "error_motions",
                         .argument = CertifiedTable::Argument{.name = "angle",
                                                              .unit = "deg",
                                                              .printed_unit = gum::unit_for_people("deg"),
                                                              .values = {},
                                                              .printed = {}},
                         .columns = {}};
    for (const ErrorsAtAngle& at : r.errors) {
        table.argument->values.emplace_back(at.angle_deg);
        table.argument->printed.push_back(at.printed_angle);
    }
    for (std::size_t i = 0; i < r.error_names.size(); ++i) {
        std::vector<CertifiedValue> values;
        for (const ErrorsAtAngle& at : r.errors) {
            values.push_back(value_of(at.errors[i], at.errors[i].k));
        }
        table.columns.push_back(column(r.error_names[i], r.error_names[i], r.error_units[i], std::move(values)));
    }
    return table;
}

std::string unit_of_motion(const RotaryTable& r, const std::string& name) {
    const auto found = std::find(r.error_names.begin(), r.error_names.end(), name);
    return found == r.error_names.end() ? "1" : r.error_units[static_cast<std::size_t>(found - r.error_names.begin())];
}

CertifiedTable reversal(const RotaryTable& r) {
    CertifiedTable table{.id = "reversal", .argument = {}, .columns = {}};
    for (const Reversal& mean : r.reversal) {
        table.columns.push_back(column("reversal_" + mean.name, mean.name, unit_of_motion(r, mean.name),
                                       {value_of(mean.value, mean.value.k)}));
    }
    return table;
}

CertifiedTable ranges(const RotaryTable& r) {
    CertifiedTable table{.id = "ranges", .argument = {}, .columns = {}};
    for (const RangeRow& range : r.ranges) {
        // Records of earlier releases hold no k.
        const std::optional<double> k = range.k         ? range.k
                                        : range.u > 0.0 ? std::optional(range.U / range.u)
                                                        : std::nullopt;
        table.columns.push_back(
            column("range_" + range.name, range.name, unit_of_motion(r, range.name), {value_of(range, k)}));
    }
    return table;
}

CertifiedTable parameters(const std::string& id, const std::vector<TableParameter>& from) {
    CertifiedTable table{.id = id, .argument = {}, .columns = {}};
    for (const TableParameter& p : from) {
        table.columns.push_back(
            column(p.name, p.description.empty() ? p.name : p.description, p.unit, {value_of(p, p.k)}));
    }
    return table;
}

}  // namespace

const Result* result_of(const EvaluationRecord& record, const CertifiedTable& table, const std::string& name,
                        std::size_t row) {
    if (table.id != "results" && table.id != "set_up") {
        return nullptr;
    }
    const std::string point =
        table.argument && row < table.argument->printed.size() ? table.argument->printed[row] : "";
    const auto found = std::find_if(record.results.begin(), record.results.end(), [&](const Result& r) {
        return (r.quantity.empty() ? r.name : r.quantity) == name && r.point == point;
    });
    return found == record.results.end() ? nullptr : &*found;
}

std::vector<CertifiedTable> certified_tables(const EvaluationRecord& record) {
    if (!record.rotary) {
        std::vector<CertifiedTable> tables = tables_of_results(record.results, "results");
        if (record.circle_closure) {
            put_angles(*record.circle_closure, tables);
        }
        return tables;
    }
    const RotaryTable& r = *record.rotary;
    std::vector<CertifiedTable> tables = tables_of_results(record.results, "set_up");
    for (const CertifiedTable& table :
         {error_motions(r), reversal(r), ranges(r), parameters("axis_line", r.axis_line),
          parameters("location_errors", r.location_errors),
          parameters("positioning", r.iso230_2 ? r.iso230_2->parameters : std::vector<TableParameter>())}) {
        if (!table.columns.empty()) {
            tables.push_back(table);
        }
    }
    return tables;
}

}  // namespace gumcert::reports
