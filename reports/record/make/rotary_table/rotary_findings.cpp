#include "reports/record/make/rotary_table/rotary_findings.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include "engine/rotary_table/evaluation/repeatability_check.h"
#include "engine/rotary_table/group_notes.h"
#include "gum/coverage.h"
#include "gum/rounding.h"
#include "reports/record/make/remark.h"
#include "text/degrees_of_freedom.h"

namespace gumcert::reports {

namespace {

using certificate::FindingSeverity;
using reports::AdjustmentSummary;
using reports::EvaluationRecord;
using reports::RotaryTable;

constexpr const char* k_implausible_angle = "GC-ANGLE-0001";
constexpr const char* k_implausible_angles = "GC-ANGLE-0002";  // of all of them
constexpr const char* k_refuted_resolution = "GC-VARIANCE-0009";
constexpr const char* k_fixture_component = "fixture CMM";  // as a record names it
constexpr const char* k_length_noise = "length noise";
constexpr double k_deviate_of_refuting = 3.09;  // of the normal distribution, for k_refuting_probability on one side
constexpr double k_most_left_out = 0.05;        // of all distances: a twentieth is no longer single gross errors

std::string chi_square_of(const AdjustmentSummary& a) {
    return "chi-square is " + a.chi_square.text + " with " +
           text::degrees_of_freedom(std::to_string(a.degrees_of_freedom));
}

Remark refuted(const AdjustmentSummary& a) {
    return {.message = {.code = "GC-ADJUST-0010",
                        .where = "adjustment",
                        .what = chi_square_of(a) + " (p-value " + a.p_value.text +
                                "): the residuals of the distances refute the stated uncertainties",
                        .rule = "results are certified when the residuals do not refute the uncertainties that they "
                                "rest on: the p-value of the global test is at least 0.001",
                        .action = "Correct the uncertainties of the distances, or look for what the model leaves out: "
                                  "drift, a moved station, a table that does not come back. "
                                  "\"variance_components\": \"estimate\" takes the uncertainty from the residuals.",
                        .severity = gum::Severity::warning},
            .id = "G01",
            .clause = "ISO/IEC 17025:2017, 7.7.1",
            .accredited = FindingSeverity::critical};
}

Remark overstated(const AdjustmentSummary& a) {
    return {.message = {.code = "GC-ADJUST-0011",
                        .where = "adjustment",
                        .what = chi_square_of(a) +
                                ": the residuals of the distances are far smaller than the stated uncertainties",
                        .rule = "by chance alone this happens less than once in a thousand adjustments",
                        .action = "See whether the uncertainties hold what all distances have in common; such a part "
                                  "is no scatter.",
                        .severity = gum::Severity::note},
            .id = "G02",
            .clause = "ISO/IEC 17025:2017, 7.7.1",
            .severity = FindingSeverity::information,
            .accredited = FindingSeverity::information};
}

Remark left_out(std::size_t count, std::int64_t all) {
    const double share = static_cast<double>(count) / static_cast<double>(all);
    return {.message = {.code = "GC-ADJUST-0012",
                        .where = "outlying distances",
                        .what = std::to_string(count) + " of " + std::to_string(all) + " distances, " +
                                gum::percent(share) + " %, are left out as outlying",
                        .rule = "so many are no single gross errors: what is left out belongs to the measurement, and "
                                "to its uncertainty",
                        .action = "Look for the cause that they have in common, or correct the uncertainty of the "
                                  "distances that makes them outlying.",
                        .severity = gum::Severity::warning},
            .id = "G03",
            .clause = "ISO/IEC 17025:2017, 7.7.1",
            .accredited = FindingSeverity::critical};
}

/// The component of the fixture that the distances give, where it refutes the stated covariance from above. The message
/// of the adjustment itself warns of smaller doubts, and of both sides.
std::vector<Remark> refuted_fixture(const RotaryTable& rotary) {
    std::vector<Remark> remarks;
    for (const reports::VarianceComponent& c : rotary.variance_components) {
        if (c.name != k_fixture_component || c.used || !c.estimated || !c.stated.number || !c.degrees_of_freedom ||
            *c.stated.number <= 0.0) {
            continue;
        }
        const double nu = *c.degrees_of_freedom;
        const double ratio = c.value / *c.stated.number;
        if (nu <= 0.0 || gum::chi_square_upper_tail(nu * ratio * ratio, nu) >= k_refuting_probability) {
            continue;
        }
        remarks.push_back(
            {.message = {.code = "GC-VARIANCE-0003",
                         .where = "variance components, fixture CMM",
                         .what = "the distances refute the stated covariance of the fixture: they give a "
                                 "standard uncertainty of " +
                                 c.printed.value + " µm for a coordinate, and " + c.stated.text + " µm is stated",
                         .rule = {},
                         .action = "Measure the fixture again, or correct the uncertainty of its "
                                   "coordinates and evaluate anew."},
             .id = "G05",
             .clause = "ISO/IEC 17025:2017, 7.7.1",
             .accredited = FindingSeverity::critical});
    }
    return remarks;
}

Remark far_remark(const reports::VarianceComponent& c, bool is_larger_noise, FindingSeverity accredited) {
    const std::string unit = c.unit == "um" ? " µm" : "″";
    // A value of 0 is printed to its uncertainty: as many zeros say nothing more.
    const std::string given = c.value == 0.0 ? "0" : c.printed.value;
    return {.message = {.code = "GC-VARIANCE-0006",
                        .where = "variance components, " + c.name,
                        .what = "the distances give " + given + unit + ", and " + c.stated.text + unit +
                                " is stated: the result rests on what they give",
                        .rule = is_larger_noise
                                    ? "a length noise that is estimated passes a one-sided chi-square test at 0.1 % "
                                      "against what is stated"
                                    : "an estimate agrees with what is stated within a factor of two, or passes a "
                                      "one-sided chi-square test at 0.1 %",
                        .action = is_larger_noise
                                      ? "Look for what is no noise: a reflector, a station or a support that moved, a "
                                        "drift; else correct what the job states."
                                      : "Correct what the job states, or find out why this measurement was other "
                                        "than the laboratory's budget says.",
                        .severity = gum::Severity::warning},
            .id = "G06",
            .clause = "ISO/IEC 17025:2017, 7.7.1",
            .accredited = accredited};
}

/// Components that the weights take from the distances, where these are far from what the job states: the result is right
/// then, and the laboratory's own budget is not. A length noise that is larger than stated may be no noise at all, but a
/// reflector or a station that moved: then the result is not right, and every refutation is told. Where it is more than
/// twice what is stated, an accredited certificate waits for the cause; below, the first page of the certificate says so.
std::vector<Remark> far_from_stated(const RotaryTable& rotary, bool resolution_is_refuted) {
    constexpr double k_far = 2.0;      // a factor of two is what nobody takes for a choice of rounding
    constexpr double k_digits = 1.05;  // what is stated with two digits stands for as much (JCGM 100:2008, 7.2.6)
    std::vector<Remark> remarks;
    for (const reports::VarianceComponent& c : rotary.variance_components) {
        if (!c.used || !c.estimated || !c.stated.number || *c.stated.number <= 0.0) {
            continue;
        }
        const double ratio = c.value / *c.stated.number;
        const bool is_noise = c.name == k_length_noise;
        if (c.value == 0.0) {
            // At its bound an estimate has no degrees of freedom; the square of its u is the standard uncertainty of a
            // variance of 0.
            const bool refuted_by_spread = *c.stated.number * *c.stated.number > k_deviate_of_refuting * c.u * c.u;
            if (refuted_by_spread || (is_noise && resolution_is_refuted)) {
                remarks.push_back(far_remark(c, false, FindingSeverity::major));
            }
            continue;
        }
        if (!c.degrees_of_freedom || *c.degrees_of_freedom <= 0.0) {
            continue;
        }
        const double nu = *c.degrees_of_freedom;
        const double above = gum::chi_square_upper_tail(nu * ratio * ratio, nu);
        const bool is_far = (ratio > (is_noise ? k_digits : k_far) && above < k_refuting_probability) ||
                            (ratio < 1.0 / k_far && 1.0 - above < k_refuting_probability);
        if (!is_far) {
            continue;
        }
        remarks.push_back(far_remark(c, is_noise && ratio > 1.0,
                                     is_noise && ratio > k_far ? FindingSeverity::critical : FindingSeverity::major));
    }
    return remarks;
}

/// A component in the weights with more than the residuals give: chi-square is small because of it.
bool takes_plausible(const reports::VarianceComponent& component) {
    return component.used && component.residuals_give.has_value();
}

std::vector<Remark> remarks_of(const EvaluationRecord& record) {
    std::vector<Remark> remarks;
    if (!record.rotary) {
        return remarks;
    }
    const RotaryTable& rotary = *record.rotary;
    const AdjustmentSummary& a = rotary.adjustment;
    const auto degrees = static_cast<double>(a.degrees_of_freedom);
    if (a.degrees_of_freedom > 0 && a.p_value.number < k_refuting_probability) {
        remarks.push_back(refuted(a));
    } else if (a.degrees_of_freedom > 0 && std::ranges::none_of(rotary.variance_components, takes_plausible) &&
               1.0 - gum::chi_square_upper_tail(a.chi_square.number, degrees) < k_refuting_probability) {
        remarks.push_back(overstated(a));
    }
    const auto removed = static_cast<std::size_t>(std::count_if(
        rotary.flagged.begin(), rotary.flagged.end(), [](const reports::FlaggedDistance& d) { return d.removed; }));
    const std::int64_t distances = static_cast<std::int64_t>(rotary.reliability.size());
    if (distances > 0 && static_cast<double>(removed) > k_most_left_out * static_cast<double>(distances)) {
        remarks.push_back(left_out(removed, distances));
    }
    const bool resolution_is_refuted = std::ranges::any_of(
        record.diagnostics, [](const gum::Diagnostic& d) { return d.code == k_refuted_resolution; });
    std::ranges::move(far_from_stated(rotary, resolution_is_refuted), std::back_inserter(remarks));
    return remarks;
}

}  // namespace

std::vector<gum::Diagnostic> rotary_remarks(const EvaluationRecord& record) {
    return messages_of(remarks_of(record));
}

std::vector<certificate::Finding> rotary_findings(const EvaluationRecord& record) {
    std::vector<Remark> remarks = remarks_of(record);
    for (const gum::Diagnostic& message : record.diagnostics) {
        if (record.rotary && (message.code == engine::k_suspicious_group || message.code == k_implausible_angle ||
                              message.code == k_implausible_angles)) {
            remarks.push_back({.message = message,
                               .id = "G04",
                               .clause = "ISO/IEC 17025:2017, 7.7.1",
                               .accredited = FindingSeverity::critical});
        }
    }
    for (const gum::Diagnostic& message : record.diagnostics) {
        const bool is_too_small = message.code == engine::k_repeatability_too_small;
        if (record.rotary && (is_too_small || message.code == engine::k_repeatability_too_large)) {
            remarks.push_back({.message = message,
                               .id = "G07",
                               .clause = "ISO/IEC 17025:2017, 7.7.1",
                               .accredited = is_too_small ? FindingSeverity::critical : FindingSeverity::major});
        }
    }
    if (record.rotary) {
        std::ranges::move(refuted_fixture(*record.rotary), std::back_inserter(remarks));
    }
    return findings_of(std::move(remarks), record);
}

}  // namespace gumcert::reports
