#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"
#include "audit/rules/row_edits.h"
#include "audit/word_line.h"
#include "certificate/text_words.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_conditions_controlled{.text = "ISO/IEC 17025:2017, 6.3.3", .verified = true};
constexpr Clause k_effects_of_conditions{.text = "ISO/IEC 17025:2017, 7.6.1", .verified = true};
constexpr Clause k_sensor_calibrated{.text = "ISO/IEC 17025:2017, 6.4.6", .verified = true};
constexpr Clause k_method_followed{.text = "ISO/IEC 17025:2017, 7.2.1", .verified = true};
constexpr Clause k_conditions_reported{.text = "ISO/IEC 17025:2017, 7.8.4.1 b", .verified = true};

using certificate::Condition;

/// Whether a row of a budget is about a condition that was observed.
bool is_about_condition(const AuditedRow& row, const Condition& condition) {
    if (condition.kind == "temperature") {
        // A difference of two temperatures, or of two coefficients, does not swing with the room.
        return row.contributor == Contributor::temperature &&
               !WordLine(row.quantity + " " + row.comment).has_any({"difference", "differenz", "unterschied", "delta"});
    }
    const WordLine words(row.quantity);
    return (condition.kind == "humidity" && words.has_any({"humid", "feucht", "luftfeucht"})) ||
           (condition.kind == "pressure" && words.has_any({"pressure", "druck", "luftdruck", "barometric"}));
}

/// A difference in another unit; nothing where the two units are of different kinds.
std::optional<double> difference_in(double difference, const std::string& from, const std::string& to) {
    try {
        const gum::Unit source = gum::Unit::parse(from), target = gum::Unit::parse(to);
        if (source.dimension() == target.dimension()) {
            return target.difference_from_si(source.difference_to_si(difference));
        }
    } catch (const gum::InputError&) {
        return std::nullopt;
    }
    return std::nullopt;
}

/// E02
void recorded_range_larger(const AuditSubject& subject, FindingCollector& findings) {
    for (const Condition& condition : subject.certificate->data.conditions) {
        for_each_row(subject, [&](const RowAt& at) {
            const std::optional<double> recorded =
                difference_in(0.5 * (condition.maximum - condition.minimum), condition.unit, at.is.unit);
            if (!is_about_condition(at.is, condition) || !recorded || !(at.is.used_u > 0.0)) {
                return;
            }
            const bool stated = at.is.origin == Origin::limits && at.is.origin_value;
            // Where the row does not say what limits it stands for, u is taken back to the half-width of a rectangular
            // distribution.
            const double budgeted = stated ? *at.is.origin_value : std::numbers::sqrt3 * at.is.used_u;
            constexpr double k_rounding = 1e-9;
            if (*recorded <= budgeted * (1.0 + k_rounding)) {
                return;
            }
            AuditFinding finding =
                finding_at(at, "",
                           stated ? say("the recorded range is ±{recorded:number} about its middle, and the budget has "
                                        "±{budgeted:number}",
                                        in_words(*recorded, at.is.unit), in_words(budgeted, at.is.unit))
                                  : say("the recorded range is ±{recorded:number} about its middle, and the budget has "
                                        "±{budgeted:number} (√3·u)",
                                        in_words(*recorded, at.is.unit), in_words(budgeted, at.is.unit)));
            finding.expected = say_number(in_words(*recorded, at.is.unit));
            finding.actual = say_number(in_words(budgeted, at.is.unit));
            finding.correct = scale_u(at.row, *recorded / budgeted);
            findings.add(std::move(finding));
        });
    }
}

/// E03
void sensor_without_calibration(const AuditSubject& subject, FindingCollector& findings) {
    const certificate::CertificateData& data = subject.certificate->data;
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        const Condition& condition = data.conditions[i];
        const std::u32string sensor = certificate::letters_of(condition.sensor);
        const auto is_sensor = [&](const certificate::StandardUsed& standard) {
            const std::u32string mark = certificate::letters_of(standard.identification);
            return !mark.empty() && sensor.find(mark) != std::u32string::npos;
        };
        const bool listed = !sensor.empty() && std::any_of(data.standards.begin(), data.standards.end(), is_sensor);
        if (listed || condition.U) {
            continue;
        }
        AuditFinding finding;
        finding.where = "/conditions/" + std::to_string(i) + "/sensor";
        finding.what = sensor.empty()
                           ? say("a condition without its sensor and without U of it")
                           : say("the sensor {sensor} has no U, and is not among the standards", condition.sensor);
        findings.add(std::move(finding));
    }
}

/// E04: the data know days. Work on the day of receipt leaves the time to acclimatise open.
void no_time_to_acclimatise(const AuditSubject& subject, FindingCollector& findings) {
    const certificate::CertificateData& data = subject.certificate->data;
    if (data.dates.received.empty() || data.dates.received != data.dates.performed_from) {
        return;
    }
    AuditFinding finding;
    finding.where = "/dates/performed_from";
    finding.what =
        say("the work began on the day of receipt, {received}: nothing shows the time that the item had to acclimatise",
            data.dates.received);
    findings.add(std::move(finding));
}

struct Trend {
    /// Slope of readings in their order over its standard deviation: Student's t with n − 2 degrees of freedom.
    double t = 0.0;
    bool without_scatter = false;  ///< no reading is off the line by more than the rounding of its number
};

Trend trend_of(const std::vector<double>& readings) {
    constexpr double k_rounding = 4.0 * std::numeric_limits<double>::epsilon();
    const double n = static_cast<double>(readings.size());
    double mean = 0.0, largest = 0.0;
    for (const double reading : readings) {
        mean += reading / n;
        largest = std::max(largest, std::abs(reading));
    }
    double sxx = 0.0, sxy = 0.0;
    // Both about their means: Σ y² − (Σ y)²/n would cancel for readings that share most of their digits.
    const auto x_at = [n](std::size_t i) { return static_cast<double>(i) - 0.5 * (n - 1.0); };
    for (std::size_t i = 0; i < readings.size(); ++i) {
        sxx += x_at(i) * x_at(i);
        sxy += x_at(i) * (readings[i] - mean);
    }
    double rest = 0.0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        // Each by itself: Σ y² − (Σ x y)²/Σ x² of readings close to a line would be all rounding.
        const double off_line = readings[i] - mean - sxy / sxx * x_at(i);
        rest += off_line * off_line;
    }
    // A scatter below the rounding of the numbers is not known to be smaller than that: equal steps have a t that is
    // large and finite, and equal readings none.
    const double least = n * (k_rounding * largest) * (k_rounding * largest);
    if (!(least > 0.0)) {
        return {};
    }
    return {.t = sxy / std::sqrt(sxx * std::max(rest, least) / (n - 2.0)), .without_scatter = rest <= least};
}

constexpr std::size_t k_least_for_trend = 6;
constexpr double k_trend_risk = 0.01;  // of the family: all rows together

/// E06
void drift_in_readings(const AuditSubject& subject, FindingCollector& findings) {
    double tests = 0.0;
    for_each_row(subject,
                 [&tests](const RowAt& at) { tests += at.is.readings.size() >= k_least_for_trend ? 1.0 : 0.0; });
    for_each_row(subject, [&](const RowAt& at) {
        if (at.is.readings.size() < k_least_for_trend) {
            return;
        }
        const double nu = static_cast<double>(at.is.readings.size() - 2);
        const Trend trend = trend_of(at.is.readings);
        const double limit = gum::coverage_factor(1.0 - k_trend_risk / tests, nu);
        if (std::abs(trend.t) <= limit) {
            return;
        }
        AuditFinding finding =
            finding_at(at, "",
                       trend.without_scatter ? say("the readings lie on one straight line in their order: a trend, and "
                                                   "no scatter about it")
                                             : say("the readings have a trend in their order: t = {t:number}, limit "
                                                   "{limit:number} (1 % over all rows with readings)",
                                                   text::significant(trend.t, 3), text::significant(limit, 3)));
        finding.contribution_missing = true;
        findings.add(std::move(finding));
    });
}

/// E07
void limits_in_place_of_observations(const AuditSubject& subject, FindingCollector& findings) {
    const std::vector<Condition>& conditions = subject.certificate->data.conditions;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const Condition& condition = conditions[i];
        // Two observed ends that equal two limits to the last digit were copied: chance does not do that.
        if (!condition.lower_limit || !condition.upper_limit || condition.minimum != *condition.lower_limit ||
            condition.maximum != *condition.upper_limit) {
            continue;
        }
        AuditFinding finding;
        finding.where = "/conditions/" + std::to_string(i);
        finding.what =
            say("the observed range is exactly the limits of the method, {minimum:number} to {maximum:number}",
                in_words(condition.minimum, condition.unit), in_words(condition.maximum, condition.unit));
        findings.add(std::move(finding));
    }
}

}  // namespace

std::vector<Rule> environment_rules() {
    return {
        {.id = "E01",
         .title = "Condition outside of the limits of the method",
         .clause = k_conditions_controlled,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "findings E01 and E05 of the gates: observed range with U of the sensor, and the file of the "
                      "environment, against the limits",
         .correction = "State the deviation, or repeat the work.",
         .question = "What was done about the time outside of the limits?",
         .examine = take_gate_findings},
        {.id = "E02",
         .title = "Recorded range larger than the budget has",
         .clause = k_effects_of_conditions,
         .severity = FindingSeverity::major,
         .needs = {Need::rows, Need::certificate},
         .detection = "half of the observed range against the half-width of the row, or √3·u of it",
         .correction = "Take the observed range into the budget.",
         .question = "Which range of the conditions is the budget made for?",
         .examine = recorded_range_larger},
        {.id = "E03",
         .title = "Sensor of a condition without calibration",
         .clause = k_sensor_calibrated,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::gates},
         .detection = "a condition without U whose sensor is not among the standards",
         .correction = "State U of the sensor, or list it with its certificate.",
         .question = "When was the sensor calibrated, and with which U?",
         .examine = sensor_without_calibration},
        {.id = "E04",
         .title = "Time to acclimatise not shown",
         .clause = k_method_followed,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::certificate},
         .detection = "work that began on the day of receipt; hours are in no data",
         .correction = "Put the time between unpacking and the first reading on record.",
         .question = "How long did the item stand in the room before the first reading?",
         .examine = no_time_to_acclimatise},
        {.id = "E05",
         .title = "Record of a condition missing or not usable",
         .clause = k_conditions_reported,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "findings E02 and E03 of the gates: conditions that nature does not have, or that tell nothing",
         .correction = "Correct number, unit or kind of the condition.",
         .question = "What was observed during the readings?",
         .examine = take_gate_findings},
        {.id = "E06",
         .title = "Drift during the run not treated",
         .clause = k_effects_of_conditions,
         .severity = FindingSeverity::major,
         .needs = {Need::readings},
         .detection =
             "a trend of six readings or more in their order (t-test of the slope, 1 % over all rows); findings "
             "A02, C04 and C05 of the evaluation",
         .correction = "Remove the drift by readings at start and end, or add its contribution.",
         .question = "Is the order of the readings that of time, and what does the zero say at start and end?",
         .examine = drift_in_readings},
        {.id = "E07",
         .title = "Limits of the room in place of observed conditions",
         .clause = k_conditions_reported,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "an observed range that is exactly the limits of the method",
         .correction = "State what was observed.",
         .question = "What did the sensor show during the work?",
         .examine = limits_in_place_of_observations},
    };
}

}  // namespace gumcert::audit
