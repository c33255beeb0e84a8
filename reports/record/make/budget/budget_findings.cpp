#include "reports/record/make/budget/budget_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "gum/analysis_of_variance.h"
#include "gum/outlying_readings.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/make/budget/budget_fit_record.h"
#include "reports/record/make/budget/budget_texts.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/remark.h"
#include "text/degrees_of_freedom.h"
#include "text/lists.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::FindingSeverity;
using reports::EvaluationRecord;
using reports::FitSummary;
using reports::OutlyingReading;
using reports::ReadingsSummary;

constexpr double k_gross_outlier = 0.001;  // p-value below which nobody takes a reading for chance
constexpr double k_refuted_pool = 0.001;   // p-value of the F test below which a pool does not hold for readings
constexpr std::size_t k_most_points = 5;

std::string with_unit(const std::string& number, const std::string& unit) {
    const std::string people = gum::unit_for_people(unit);
    return people.empty() ? number : number + " " + people;
}

/// "readings of x: drift at points A, B and 3 more"
std::string place_of(const std::string& input, const std::string& component, const std::vector<std::string>& points) {
    std::string text = "readings of " + input + (component.empty() ? "" : ": " + component);
    std::vector<std::string> named;
    for (const std::string& point : points) {
        if (!point.empty() && std::find(named.begin(), named.end(), point) == named.end()) {
            named.push_back(point);
        }
    }
    if (!named.empty()) {
        text += (named.size() == 1 ? " at point " : " at points ") + text::listed(named, k_most_points);
    }
    return text;
}

reports::Remark refuted_fit(const FitSummary& fit) {
    std::vector<std::string> scaled;
    for (const FitSummary::Parameter& parameter : fit.parameters) {
        scaled.push_back("u(" + parameter.name + ") = " + with_unit(parameter.scaled_u.text, parameter.unit) +
                         " in place of " + parameter.u.text);
    }
    return {
        .message = {.code = "GC-BUDGET-0032",
                    .where = "fit " + fit.name,
                    .what = "chi-square is " + fit.sum_of_squares.text + " with " +
                            text::degrees_of_freedom(text::shortest(fit.degrees_of_freedom)) + " (p-value " +
                            fit.p_value.text + "): the residuals are " + fit.residual_standard_deviation.text +
                            " times as large as the stated uncertainties of the data explain",
                    .rule = "a fit is used when its residuals do not refute the stated uncertainties and the curve: "
                            "chi-square is tested at 5 % (ISO/TS 28037:2010)",
                    .action = "Correct the uncertainties of the data, or the equation; or add "
                              "\"scale_by_residuals\": true to the fit, which takes the uncertainty from the "
                              "residuals: " +
                              text::listed(scaled) + ".",
                    .severity = gum::Severity::warning},
        .id = "F01",
        .clause = "ISO/TS 28037:2010",
        .severity = FindingSeverity::major,
        .accredited = FindingSeverity::critical};
}

reports::Remark overstated_fit(const FitSummary& fit) {
    return {
        .message = {.code = "GC-BUDGET-0033",
                    .where = "fit " + fit.name,
                    .what = "chi-square is " + fit.sum_of_squares.text + " with " +
                            text::degrees_of_freedom(text::shortest(fit.degrees_of_freedom)) +
                            ": the residuals are far smaller than the stated uncertainties of "
                            "the data",
                    .rule = "by chance alone this happens less than once in a hundred fits",
                    .action = "See whether the uncertainties hold what all points have in common (a standard, a "
                              "scale); such a part is no scatter, and belongs into the model as an input of its own.",
                    .severity = gum::Severity::note},
        .id = "F02",
        .clause = "ISO/TS 28037:2010",
        .severity = FindingSeverity::information,
        .accredited = FindingSeverity::information};
}

std::string place_in_set(const OutlyingReading& r) {
    const std::string number = std::to_string(r.position);
    return r.of == "group_means" ? "the mean of group " + number
           : r.of == "group"     ? "reading " + number + " of group " + std::to_string(r.group)
                                 : "reading " + number;
}

/// \param all  of one input
reports::Remark outliers(const std::vector<const OutlyingReading*>& all) {
    const OutlyingReading& first = **std::min_element(
        all.begin(), all.end(), [](const auto* a, const auto* b) { return a->p_value.number < b->p_value.number; });
    std::vector<std::string> points;
    for (const OutlyingReading* r : all) {
        points.push_back(r->point);
    }
    std::string what = place_in_set(first) +
                       (all.size() > 1 && !first.point.empty() ? " at point " + first.point : "") + ", " +
                       with_unit(first.value.text, first.unit) + ", is an outlier among " + std::to_string(first.n) +
                       (first.of == "group_means" ? " means" : " readings") + ": G = " + first.G.text + ", p-value " +
                       first.p_value.text;
    if (all.size() > 1) {
        what += "; and " + std::to_string(all.size() - 1) + " more";
    }
    const FindingSeverity severity =
        first.p_value.number < k_gross_outlier ? FindingSeverity::major : FindingSeverity::minor;
    return {
        .message = {.code = "GC-BUDGET-0031",
                    .where = place_of(first.input, first.component, points),
                    .what = std::move(what),
                    .rule = "Grubbs' test at 1 % (NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.5.17.1); for "
                            "the p-value, s of the others is at least step/√12 of their last digit or resolution",
                    .action = "Look for the cause: a slip of the pen, a disturbance. Leave a reading out only for a "
                              "cause that is on record; else it stays, and s with it.",
                    .severity = gum::Severity::warning},
        .id = "A01",
        .clause = "JCGM 100:2008, 4.2",
        .severity = severity,
        .accredited = severity};
}

/// \param all  of one input
reports::Remark dependent(const std::vector<const ReadingsSummary*>& all) {
    const ReadingsSummary& first = *all.front();
    std::vector<std::string> points;
    for (const ReadingsSummary* r : all) {
        points.push_back(r->point);
    }
    return {.message = {.code = "GC-BUDGET-0030",
                        .where = place_of(first.input, first.component, points),
                        .what = "autocorrelation coefficient of lag 1 is " + first.printed_r1 +
                                (all.size() > 1 && !first.point.empty() ? " at point " + first.point : ""),
                        .rule = "readings that are independent of each other stay within " +
                                ("±" + first.autocorrelation_limit.text) + " in 95 % of all cases",
                        .action = "Look for drift; s/√n is not the uncertainty of the mean of dependent readings.",
                        .severity = gum::Severity::warning},
            .id = "A02",
            .clause = "JCGM 100:2008, 4.2.7",
            .severity = FindingSeverity::minor,
            .accredited = FindingSeverity::minor};
}

/// Whether the scatter of readings is that of the pool that they are stated to belong to.
struct PoolTest {
    double F = 0.0, p_value = 1.0;
    double nu = 0.0;       ///< of the readings
    double nu_pool = 0.0;  ///< of the pool
    std::vector<std::string> points;
};

PoolTest tested(double F, double nu, double nu_pool, std::vector<std::string> points) {
    return {.F = F,
            .p_value = gum::f_upper_tail(F, nu, nu_pool),
            .nu = nu,
            .nu_pool = nu_pool,
            .points = std::move(points)};
}

/// The worse of two tests: of the set that scatters most, among so many, and of all sets together.
/// \param all  of one input, each with pooled_F
PoolTest pool_test(const std::vector<const ReadingsSummary*>& all) {
    const auto nu_pool = [](const ReadingsSummary& r) {
        return r.pooled_degrees_of_freedom.value_or(std::numeric_limits<double>::infinity());
    };
    const auto sets = static_cast<double>(all.size());
    double sum = 0.0;
    double nu = 0.0;
    double least_nu_pool = std::numeric_limits<double>::infinity();
    PoolTest worst;
    std::vector<std::string> points;
    for (const ReadingsSummary* r : all) {
        const auto own_nu = static_cast<double>(r->n - 1);
        PoolTest alone = tested(*r->pooled_F, own_nu, nu_pool(*r), {r->point});
        alone.p_value = std::min(1.0, sets * alone.p_value);
        if (worst.points.empty() || alone.p_value < worst.p_value) {
            worst = std::move(alone);
        }
        sum += own_nu * *r->pooled_F;
        nu += own_nu;
        least_nu_pool = std::min(least_nu_pool, nu_pool(*r));
        points.push_back(r->point);
    }
    PoolTest together = tested(sum / nu, nu, least_nu_pool, std::move(points));
    return together.p_value <= worst.p_value ? together : worst;
}

std::string printed_p(double p_value) {
    constexpr double k_least_printed = 1e-4;
    return p_value < k_least_printed ? "< 0.0001" : gum::round_significant(p_value, 2);
}

reports::Remark refuted_pool(const ReadingsSummary& of, const PoolTest& test) {
    return {.message = {.code = "GC-BUDGET-0037",
                        .where = place_of(of.input, of.component, test.points),
                        .what = "the readings scatter " + gum::round_significant(std::sqrt(test.F), 2) +
                                " times as much as their pooled standard deviation says (F = " +
                                gum::round_significant(test.F, 3) + " with " + text::shortest(test.nu) + " and " +
                                (std::isinf(test.nu_pool) ? "∞" : text::shortest(test.nu_pool)) +
                                " degrees of freedom, p-value " + printed_p(test.p_value) + ")",
                        .rule = "a pooled standard deviation holds for readings of the same procedure: by chance alone "
                                "they scatter so much less than once in a thousand times",
                        .action = "Look for what was different. Correct the pooled standard deviation, or leave "
                                  "`pooled` out: then u comes from the scatter of the readings themselves.",
                        .severity = gum::Severity::warning},
            .id = "A03",
            .clause = "JCGM 100:2008, 4.2.4",
            .severity = FindingSeverity::major,
            .accredited = FindingSeverity::critical};
}

/// Those of one input and component together, in the order of the record.
template <typename Summary, typename Wanted>
std::vector<std::vector<const Summary*>> by_input(const std::vector<Summary>& all, const Wanted& wanted) {
    std::vector<std::vector<const Summary*>> groups;
    for (const Summary& one : all) {
        if (!wanted(one)) {
            continue;
        }
        const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
            return std::tie(group.front()->input, group.front()->component) == std::tie(one.input, one.component);
        });
        (found == groups.end() ? groups.emplace_back() : *found).push_back(&one);
    }
    return groups;
}

std::vector<reports::Remark> remarks_of(const EvaluationRecord& record) {
    std::vector<reports::Remark> remarks;
    for (const FitSummary& fit : record.fits) {
        if (fit.consistency == "refuted") {
            remarks.push_back(refuted_fit(fit));
        } else if (fit.consistency == "overstated") {
            remarks.push_back(overstated_fit(fit));
        }
    }
    for (const auto& group : by_input(record.readings, [](const ReadingsSummary& r) { return r.dependent; })) {
        remarks.push_back(dependent(group));
    }
    for (const auto& group :
         by_input(record.readings, [](const ReadingsSummary& r) { return r.pooled_F.has_value(); })) {
        if (const PoolTest test = pool_test(group); test.p_value < k_refuted_pool) {
            remarks.push_back(refuted_pool(*group.front(), test));
        }
    }
    for (const auto& group : by_input(record.outliers, [](const OutlyingReading&) { return true; })) {
        remarks.push_back(outliers(group));
    }
    return remarks;
}

}  // namespace

std::vector<gum::Diagnostic> budget_remarks(const EvaluationRecord& record) {
    return reports::messages_of(remarks_of(record));
}

namespace {

/// Messages of the evaluation that an assessor would repeat.
struct MessageFinding {
    std::string_view code, id, clause;
    FindingSeverity severity;
};
constexpr std::array<MessageFinding, 6> k_message_findings{
    {{"GC-MODEL-0040", "M01", "JCGM 100:2008, 4.1", FindingSeverity::major},
     {"GC-MODEL-0041", "M01", "JCGM 100:2008, 4.1", FindingSeverity::major},
     {"GC-BUDGET-0044", "S18", "JCGM 101:2008, 7.6", FindingSeverity::major},
     {"GC-BUDGET-0045", "S18", "JCGM 101:2008, 7.6", FindingSeverity::major},
     {"GC-BUDGET-0036", "F03", "JCGM 100:2008, 4.2", FindingSeverity::critical},
     {"GC-BUDGET-0034", "M02", "JCGM 100:2008, 7.2.6", FindingSeverity::critical}}};

}  // namespace

std::vector<certificate::Finding> budget_findings(const EvaluationRecord& record) {
    std::vector<certificate::Finding> findings;
    for (const gum::Diagnostic& message : record.diagnostics) {
        for (const MessageFinding& known : k_message_findings) {
            if (message.code == known.code) {
                findings.push_back({.id = std::string{known.id},
                                    .clause = std::string{known.clause},
                                    .severity = known.severity,
                                    .where = message.where,
                                    .what = message.what,
                                    .action = message.action});
            }
        }
    }
    for (certificate::Finding& finding : reports::findings_of(remarks_of(record), record)) {
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace gumcert::reports
