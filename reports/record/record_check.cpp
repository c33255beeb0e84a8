#include "reports/record/record_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "json/json_pointer.h"
#include "reports/record/record_kinds.h"
#include "reports/record/record_rules.h"
#include "reports/record/stated_values.h"

namespace gumcert::reports {

namespace {

/// What must hold in a Monte Carlo evaluation of one quantity.
void check_monte_carlo(const MonteCarloSummary& m, const std::string& at, const RecordBreach& report) {
    for (const auto& [name, ends] :
         {std::pair("symmetric", m.symmetric.number), std::pair("shortest", m.shortest.number)}) {
        if (ends[0] > ends[1]) {
            report(at + "/" + name, record_number(ends[0]) + " to " + record_number(ends[1]),
                   "the lower end of an interval is not above the upper end");
        }
    }
    std::int64_t left = m.trials.number;
    for (const std::int64_t count : m.histogram) {
        left = count > left ? -1 : left - count;
        if (left < 0) {
            report(at + "/histogram/counts", "more than the trials",
                   "the cells hold at most all " + std::to_string(m.trials.number) + " trials");
            break;
        }
    }
    if (!m.histogram.empty() && !(m.histogram_low < m.histogram_high)) {
        report(at + "/histogram/high", record_number(m.histogram_high), "must be above the low end");
    }
}

/// What must hold between the parts of a circle closure.
void check_closure(const CircleClosure& c, const RecordBreach& report) {
    const auto length = [&](const std::string& at, std::size_t found, std::int64_t expected, const char* rule) {
        if (std::cmp_not_equal(found, expected)) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
    };
    length("/step_angles_deg", c.step_angles_deg.size(), c.steps, "one a step");
    length("/side_angles_deg", c.side_angles_deg.size(), c.steps, "one a side");
    length("/residuals", c.residuals.size(), c.readings, "one a reading");
    for (std::size_t i = 0; i < c.residuals.size(); ++i) {
        if (c.residuals[i].step > c.steps || c.residuals[i].side >= c.steps || c.residuals[i].position >= c.steps) {
            report("/residuals/" + std::to_string(i), "a step, side or position beyond the circle",
                   "they are numbered from 0; the closing reading is at the step after the last one");
        }
    }
}

/// What must hold between the parts of a rotary table.
void check_rotary(const RotaryTable& r, const RecordBreach& report) {
    static constexpr std::array<const char*, 6> k_stem = {"EX", "EY", "EZ", "EA", "EB", "EC"};
    for (std::size_t i = 0; i < k_stem.size(); ++i) {
        if (const std::string expected = k_stem[i] + r.axis; r.error_names[i] != expected) {
            report(
                "/error_names/" + std::to_string(i), '"' + r.error_names[i] + '"',
                "the error motions of axis " + r.axis + " are named and ordered as in ISO 230-7: \"" + expected + '"');
        }
    }
    const auto length = [&](const std::string& at, std::size_t found, std::size_t expected, const char* rule) {
        if (found != expected) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
    };
    if (std::set<std::string>(r.budget_sources.begin(), r.budget_sources.end()).size() != r.budget_sources.size()) {
        report("/budget_sources", "a source is named twice", "every source has a name of its own");
    }
    for (std::size_t i = 0; i < r.budget.size(); ++i) {
        length("/budget/" + std::to_string(i) + "/shares", r.budget[i].shares.size(), r.budget_sources.size(),
               "one share a source");
    }
    for (std::size_t i = 0; i < r.budget_summary.size(); ++i) {
        const std::string at = "/budget_summary/" + std::to_string(i);
        length(at + "/shares", r.budget_summary[i].shares.number.size(), r.budget_sources.size(), "one share a source");
        length(at + "/printed/shares", r.budget_summary[i].shares.text.size(), r.budget_sources.size(),
               "one share a source");
    }
    for (std::size_t i = 0; i < r.stations.size(); ++i) {
        const std::string at = "/stations/" + std::to_string(i) + "/printed/";
        length(at + "position", r.stations[i].printed_position.size(), 3, "one a coordinate");
        length(at + "U", r.stations[i].printed_U.size(), 3, "one a coordinate");
    }
    for (std::size_t i = 0; i < r.reflectors.size(); ++i) {
        const std::string at = "/reflectors/" + std::to_string(i) + "/printed/";
        length(at + "position", r.reflectors[i].printed_position.size(), 3, "one a coordinate");
        length(at + "U", r.reflectors[i].printed_U.size(), 3, "one a coordinate");
        length(at + "correction", r.reflectors[i].printed_correction.size(), 3, "one a coordinate");
        // Records of earlier releases do not hold what the CMM stated.
        for (const auto& [name, texts] :
             {std::pair("cmm", &r.reflectors[i].printed_cmm), std::pair("U_cmm", &r.reflectors[i].printed_U_cmm)}) {
            length(at + name, texts->size(), texts->empty() ? 0 : 3, "one a coordinate, or none");
        }
    }
    const auto symmetric = [&](const std::string& at, const std::array<std::array<double, 3>, 3>& m) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const double most = std::sqrt(std::abs(m[i][i]) * std::abs(m[j][j]));
                if (m[i][i] < 0.0 || !(std::abs(m[i][j] - m[j][i]) <= 1e-9 * most) ||
                    !(std::abs(m[i][j]) <= most * (1.0 + 1e-9))) {
                    report(at + "/" + std::to_string(i) + "/" + std::to_string(j), record_number(m[i][j]),
                           "a covariance matrix is symmetric, and no covariance exceeds what its variances allow");
                    return;
                }
            }
        }
    };
    for (std::size_t i = 0; i < r.stations.size(); ++i) {
        symmetric("/stations/" + std::to_string(i) + "/covariance_mm2", r.stations[i].covariance_mm2);
    }
    for (std::size_t i = 0; i < r.reflectors.size(); ++i) {
        symmetric("/reflectors/" + std::to_string(i) + "/covariance_mm2", r.reflectors[i].covariance_mm2);
    }
    if (const GlobalTest& test = r.adjustment.global_test; test.lower.number > test.upper.number) {
        report("/adjustment/global_test/lower", record_number(test.lower.number), "must not be above the upper limit");
    }
    std::set<std::pair<StatedGroup, std::string>> names;
    for (const auto& place : stated_values(r)) {
        const std::string at = pointer_of(place);
        if (place.stated.monte_carlo) {
            check_monte_carlo(*place.stated.monte_carlo, at + "/monte_carlo", report);
        }
        if (place.group >= StatedGroup::axis_line && !names.emplace(place.group, place.name).second) {
            report(at + "/name", '"' + place.name + '"', "a parameter is listed once");
        }
    }
    if (r.iso230_2) {
        const std::vector<TableParameter>& all = r.iso230_2->parameters;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (std::find(k_positioning_names.begin(), k_positioning_names.end(), all[i].name) ==
                k_positioning_names.end()) {
                report("/iso230_2/parameters/" + std::to_string(i) + "/name", '"' + all[i].name + '"',
                       "must be a parameter of ISO 230-2: M, E, R, B, A …");
            }
        }
    }
    if (r.monte_carlo && r.monte_carlo->validated > r.monte_carlo->compared) {
        report("/monte_carlo/validated", std::to_string(r.monte_carlo->validated),
               "not more than the " + std::to_string(r.monte_carlo->compared) + " that were compared");
    }
}

/// What must hold between the results of a record and what is said of them together.
void check_results(const EvaluationRecord& r, const RecordBreach& report) {
    const auto length = [&](const std::string& at, std::size_t found, std::size_t expected, const char* rule) {
        if (found != expected) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
        return found == expected;
    };
    const auto square = [&](const std::string& at, const auto& matrix, std::size_t size, const char* rule) {
        bool sound = length(at, matrix.size(), size, rule);
        for (std::size_t i = 0; i < matrix.size(); ++i) {
            sound = length(at + "/" + std::to_string(i), matrix[i].size(), size, rule) && sound;
        }
        return sound;
    };
    const auto symmetric = [&](const std::string& at, const std::vector<std::vector<double>>& matrix) {
        for (std::size_t i = 0; i < matrix.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const double noise = 1e-9 * std::sqrt(std::abs(matrix[i][i]) * std::abs(matrix[j][j]));
                if (!(std::abs(matrix[i][j] - matrix[j][i]) <= noise)) {
                    report(at + "/" + std::to_string(i) + "/" + std::to_string(j), record_number(matrix[i][j]),
                           "a covariance or correlation matrix is symmetric; the other half says " +
                               record_number(matrix[j][i]));
                    return;
                }
            }
        }
    };
    std::set<std::string> names;
    for (const Result& result : r.results) {
        const std::string at = "/results/" + json::pointer_token(result.name);
        names.insert(result.name);
        if (result.U.has_value() != (result.coverage != "none") || (result.k && !result.U)) {
            report(at + "/U", result.U ? "stated" : "not stated",
                   "an expanded uncertainty is stated unless `coverage` is \"none\", and k only beside it; `coverage` "
                   "is \"" +
                       result.coverage + '"');
        }
        if (result.monte_carlo) {
            check_monte_carlo(*result.monte_carlo, at + "/monte_carlo", report);
        }
        if (const auto& interval = result.reported.interval; interval && (*interval)[0] > (*interval)[1]) {
            report(at + "/reported/interval", record_number((*interval)[0]) + " to " + record_number((*interval)[1]),
                   "the lower end of an interval is not above the upper end");
        }
        if (result.reported.method == "monte_carlo" && !result.monte_carlo) {
            report(at + "/reported/method", "\"monte_carlo\"", "a result of Monte Carlo needs its trials beside it");
        }
    }
    if (r.covariance) {
        const ResultCovariance& c = *r.covariance;
        const std::string at = "/covariance";
        for (std::size_t i = 0; i < c.names.size(); ++i) {
            if (!names.contains(c.names[i])) {
                report(at + "/names/" + std::to_string(i), '"' + c.names[i] + '"', "must be the name of a result");
            }
        }
        length(at + "/units", c.units.size(), c.names.size(), "one a name");
        const std::size_t size = c.file.empty() ? c.names.size() : 0;
        const char* rule = c.file.empty() ? "one a name" : "because the matrix is in a file";
        if (square(at + "/matrix", c.matrix, size, rule)) {
            symmetric(at + "/matrix", c.matrix);
        }
        if (square(at + "/correlation", c.correlation.number, size, rule)) {
            symmetric(at + "/correlation", c.correlation.number);
        }
        square(at + "/printed/correlation", c.correlation.text, size, rule);
    }
    for (std::size_t i = 0; i < r.fits.size(); ++i) {
        const FitSummary& f = r.fits[i];
        const std::string at = "/fits/" + std::to_string(i);
        if (square(at + "/covariance", f.covariance, f.parameters.size(), "one a parameter")) {
            symmetric(at + "/covariance", f.covariance);
        }
        if (square(at + "/correlation", f.correlation, f.parameters.size(), "one a parameter")) {
            symmetric(at + "/correlation", f.correlation);
        }
        if (!f.x_name.empty() || !f.x.number.empty()) {
            length(at + "/data/x", f.x.number.size(), f.y.number.size(), "one a value of y");
        }
        length(at + "/data/fitted", f.fitted.size(), f.y.number.size(), "one a value of y");
        length(at + "/data/residual", f.residual.number.size(), f.y.number.size(), "one a value of y");
        const auto length_if_any = [&](const std::string& key, std::size_t found) {
            if (found != 0) {
                length(at + key, found, f.y.number.size(), "one a value of y");
            }
        };
        length_if_any("/data/u_x", f.u_x.number.size());
        length_if_any("/data/u_y", f.u_y.number.size());
        length_if_any("/printed/x", f.x.text.size());
        length_if_any("/printed/y", f.y.text.size());
        length_if_any("/printed/u_x", f.u_x.text.size());
        length_if_any("/printed/u_y", f.u_y.text.size());
        length_if_any("/printed/residual", f.residual.text.size());
        for (std::size_t q = 0; q < f.regressors.size(); ++q) {
            length_if_any("/data/regressors/" + std::to_string(q) + "/values", f.regressors[q].values.number.size());
            length_if_any("/data/regressors/" + std::to_string(q) + "/printed", f.regressors[q].values.text.size());
        }
    }
}

/// Columns of points have one value a row, numbers or words; what a table shows is there.
void check_columns(const std::string& at, const std::vector<certificate::PointColumn>& columns,
                   const std::vector<certificate::ShownColumn>& shown, std::size_t rows, const RecordBreach& report) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        for (const auto& [key, size] :
             {std::pair{"/values", columns[i].values.size()}, std::pair{"/printed", columns[i].printed.size()}}) {
            if (size != rows) {
                report(at + "/columns/" + std::to_string(i) + key, std::to_string(size) + " items",
                       "must be " + std::to_string(rows) + ", one a row");
            }
        }
    }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const bool is_there =
            shown[i].show != "column" ||
            std::any_of(columns.begin(), columns.end(), [&](const auto& c) { return c.name == shown[i].of; });
        if (!is_there) {
            report(at + "/shown/" + std::to_string(i) + "/of", '"' + shown[i].of + '"',
                   "must be the name of one of the columns");
        }
    }
}

/// What must hold between the parts of a certificate, so that a document can be made of it.
void check_certificate(const certificate::Certificate& c, const RecordBreach& report) {
    const auto length = [&](const std::string& at, std::size_t found, std::size_t expected, const char* rule) {
        if (found != expected) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
    };
    for (std::size_t t = 0; t < c.tables.size(); ++t) {
        const certificate::CertifiedTable& table = c.tables[t];
        const std::string at = "/certificate/tables/" + std::to_string(t);
        if (table.argument) {
            length(at + "/argument/values", table.argument->values.size(), table.argument->printed.size(),
                   "one a printed value");
        }
        const std::size_t rows = table.argument ? table.argument->printed.size() : 1;
        if (table.layout) {
            check_columns(at + "/layout", table.layout->columns, table.layout->shown, rows, report);
            if (!table.argument) {
                report(at + "/argument", "missing", "a table with a layout has points");
            }
        }
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
            const std::string column = at + "/columns/" + std::to_string(i) + "/values";
            length(column, table.columns[i].values.size(), rows, table.argument ? "one a row" : "one without argument");
            for (std::size_t row = 0; row < table.columns[i].values.size(); ++row) {
                const auto& interval = table.columns[i].values[row].interval;
                if (interval && interval->first > interval->second) {
                    report(column + "/" + std::to_string(row) + "/interval",
                           record_number(interval->first) + " to " + record_number(interval->second),
                           "the lower end of an interval is not above the upper end");
                }
            }
        }
    }
    if (c.data.languages.empty()) {
        report("/certificate/data/languages", "no language", "a certificate is in one language at least");
    }
    for (std::size_t i = 0; i < c.data.languages.size(); ++i) {
        if (std::find(certificate::k_languages.begin(), certificate::k_languages.end(), c.data.languages[i]) ==
            certificate::k_languages.end()) {
            report("/certificate/data/languages/" + std::to_string(i), '"' + c.data.languages[i] + '"',
                   "must be one of \"en\" \"de\" \"zh-Hant\" \"es\"");
        }
    }
}

/// Equations, unknowns and points belong to sections one after the other; tables name sections.
void check_sections(const EvaluationRecord& r, const RecordBreach& report) {
    std::set<std::string> names{""};
    const auto take = [&](const std::string& at, std::int64_t count, std::size_t& left, const char* what) {
        if (count < 0 || static_cast<std::size_t>(count) > left) {
            report(at, std::to_string(count),
                   "must be from 0 to " + std::to_string(left) + ", the " + what + " that sections before leave");
            left = 0;
        } else {
            left -= static_cast<std::size_t>(count);
        }
    };
    std::size_t equations = r.model ? r.model->equations.size() : 0;
    std::size_t unknowns = r.model ? r.model->unknowns.size() : 0;
    std::size_t points = r.points ? r.points->points.size() : 0;
    for (std::size_t i = 0; i < r.sections.size(); ++i) {
        const std::string at = "/sections/" + std::to_string(i);
        const SectionSummary& section = r.sections[i];
        if (!names.insert(section.name).second) {
            report(at + "/name", '"' + section.name + '"', "must be a name that no other section has");
        }
        take(at + "/equations", section.equations, equations, "equations");
        take(at + "/unknowns", section.unknowns, unknowns, "unknowns");
        take(at + "/points", section.points, points, "points");
    }
    const auto known = [&](const std::string& at, const std::string& section) {
        if (!names.contains(section) || (section.empty() && !r.sections.empty())) {
            report(at + "/section", '"' + section + '"', "must be the name of a section");
        }
    };
    for (std::size_t i = 0; r.points && i < r.points->tables.size(); ++i) {
        known("/points/tables/" + std::to_string(i), r.points->tables[i].section);
    }
    for (std::size_t i = 0; r.certificate && i < r.certificate->tables.size(); ++i) {
        known("/certificate/tables/" + std::to_string(i), r.certificate->tables[i].section);
    }
}

/// Pointers of a part as those of the record.
RecordBreach inside(const std::string& part, const RecordBreach& report) {
    return [part, &report](const std::string& at, std::string what, std::string rule) {
        report(part + at, std::move(what), std::move(rule));
    };
}

}  // namespace

void check_record(const EvaluationRecord& record, const RecordBreach& report) {
    if (record.rotary) {
        check_rotary(*record.rotary, inside("/rotary", report));
    }
    if (record.circle_closure) {
        check_closure(*record.circle_closure, inside("/circle_closure", report));
    }
    if (record.comparison) {
        check_comparison(*record.comparison, inside("/comparison", report));
    }
    if (record.kind == k_comparison_kind && (!record.comparison || record.comparison->form == "rotary_table")) {
        report(record.comparison ? "/comparison/form" : "/comparison",
               record.comparison ? "\"rotary_table\"" : "missing",
               "a record of kind comparison holds a comparison of the form \"laboratories\" or \"methods\"");
    }
    check_results(record, report);
    check_sections(record, report);
    if (record.points) {
        check_columns("/points", record.points->columns, {}, record.points->points.size(), report);
    }
    if (record.certificate) {
        check_certificate(*record.certificate, report);
    }
}

}  // namespace gumcert::reports
