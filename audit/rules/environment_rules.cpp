#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"
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

/// A temperature, humidity or pressure of the room, by the words of a row.
bool names_the_room(const WordLine& words) {
    return words.has_any({"room",     "ambient", "laborator", "environment", "atmospher", "barometr", "air ",  "raum",
                          "umgebung", "labor",   "luft",      "influence",   "einfluss",  "ambiente", "aire ", "sala",
                          "*室",      "*環境",   "*环境",     "*空氣",       "*空气",     "*大氣",    "*大气"});
}

/// What somebody else holds at a temperature, humidity or pressure: it does not swing with the room.
bool names_a_vessel(const WordLine& words) {
    return words.has_any({"chamber",
                          "bath",
                          "oven",
                          "furnace",
                          "dry block",
                          "block calibrator",
                          "homogen",
                          "liquid",
                          "solution",
                          "buffer",
                          "thermostat",
                          "water",
                          "ice",
                          "triple point",
                          "reference junction",
                          "cold junction",
                          "kammer",
                          "*schrank",
                          "*kammer",
                          "bad ",
                          "*bades",
                          "*ofen",
                          "wasser",
                          "*flussigkeit",
                          "losung",
                          "puffer",
                          "*thermostat",
                          "eispunkt",
                          "*vergleichsstelle",
                          "camara",
                          "bano",
                          "horno",
                          "liquido",
                          "disolucion",
                          "solucion",
                          "termostato",
                          "agua",
                          "*溶液",
                          "*水槽",
                          "*浴",
                          "*箱"});
}

/// Half-width that a row has: what it states, or that of a rectangular distribution with its u.
double half_width_of(const AuditedRow& row) {
    const bool stated = row.origin == Origin::limits && row.origin_value;
    return stated ? *row.origin_value : std::numbers::sqrt3 * row.used_u;
}

/// Whether an absolute value may be one of the room: its interval meets the observed range. What lies outside of it was
/// held there by something else: 25.02 °C ± 0.05 °C where 19.7 °C to 20.3 °C were observed.
bool is_of_observed_range(const Condition& condition, const AuditedRow& row) {
    if (!row.estimate) {
        return false;
    }
    try {
        const gum::Unit of_row = gum::Unit::parse(row.unit), observed = gum::Unit::parse(condition.unit);
        if (of_row.dimension() != observed.dimension()) {
            return false;
        }
        const double value = observed.from_si(of_row.to_si(row.estimate->value));
        const double half_width = difference_in(half_width_of(row), row.unit, condition.unit).value_or(0.0);
        return value >= condition.minimum - half_width && value <= condition.maximum + half_width;
    } catch (const gum::InputError&) {
        return false;
    }
}

/// Whether a temperature is a value on the scale of a thermometer: 0 °C; 0 K beside 20 °C is a deviation.
bool is_absolute(const std::string& unit) {
    try {
        return gum::Unit::parse(unit).is_celsius_temperature();
    } catch (const gum::InputError&) {
        return false;
    }
}

/// Whether u of a row enters the result as it is, as a part of a quantity of the same kind does: what is measured, and no
/// condition that acts on it.
bool enters_as_it_is(const AuditedRow& row, const std::string& unit_of_result) {
    constexpr double k_same = 0.02;
    const std::optional<double> one = difference_in(1.0, row.unit, unit_of_result);
    return one && is_about(std::abs(row.used_sensitivity), *one, k_same);
}

/// The rows that may stand for a condition of the room.
class RoomRows {
public:
    explicit RoomRows(const AuditSubject& subject) {
        for_each_row(subject, [this](const RowAt& at) {
            if (at.is.is_measured || enters_as_it_is(at.is, at.of.unit)) {
                measured_.insert(key(at));
            }
        });
    }

    [[nodiscard]] bool stand_for(const RowAt& at, const Condition& condition) const {
        const AuditedRow& row = at.is;
        const WordLine quantity(row.quantity), words(row.quantity + " " + row.comment);
        const bool room = names_the_room(words);
        if (row.is_measured || names_a_vessel(words) || (!room && measured_.contains(key(at)))) {
            return false;
        }
        if (condition.kind == "temperature") {
            // A difference of two temperatures, or of two coefficients, does not swing with the room.
            return row.contributor == Contributor::temperature &&
                   !words.has_any({"difference", "differenz", "unterschied", "delta"}) &&
                   (room || !is_absolute(row.unit) || !row.estimate || is_of_observed_range(condition, row));
        }
        const bool names_kind =
            (condition.kind == "humidity" &&
             quantity.has_any({"humid", "feucht", "luftfeucht", "humedad", "*濕度", "*湿度"})) ||
            (condition.kind == "pressure" &&
             quantity.has_any({"pressure", "druck", "luftdruck", "barometric", "presion", "*氣壓", "*气压"}));
        return names_kind && (room || is_of_observed_range(condition, row));
    }

private:
    std::set<std::pair<std::size_t, std::string>> measured_;  // budget and place of a row; npos and name of an input

    /// An input is one quantity in all budgets that it occurs in.
    static std::pair<std::size_t, std::string> key(const RowAt& at) {
        return at.is.input.empty() ? std::pair(at.budget, at.is.place) : std::pair(std::string::npos, at.is.input);
    }
};

/// Whether another part of the same input is wider: then the range is held against that.
bool has_wider_part(const RowAt& at) {
    const double width = half_width_of(at.is);
    for (std::size_t r = 0; r < at.of.rows.size() && !at.is.input.empty(); ++r) {
        const AuditedRow& other = at.of.rows[r];
        const double other_width = half_width_of(other);
        if (r != at.row && other.input == at.is.input &&
            (other_width > width || (other_width == width && r < at.row))) {
            return true;
        }
    }
    return false;
}

/// E02
void recorded_range_larger(const AuditSubject& subject, FindingCollector& findings) {
    const RoomRows rows(subject);
    for (const Condition& condition : subject.certificate->data.conditions) {
        for_each_row(subject, [&](const RowAt& at) {
            const std::optional<double> recorded =
                difference_in(0.5 * (condition.maximum - condition.minimum), condition.unit, at.is.unit);
            if (!recorded || !(at.is.used_u > 0.0) || !rows.stand_for(at, condition) || has_wider_part(at)) {
                return;
            }
            const bool stated = at.is.origin == Origin::limits && at.is.origin_value;
            const double budgeted = half_width_of(at.is);
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
         .detection =
             "half of the observed range against the half-width, or √3·u, of a row that stands for the room: not "
             "what is measured (an input of a standard or with a role in the results, a part of a quantity of "
             "the kind of the result), not a bath, solution or chamber; by words of air or room, as a deviation, or "
             "by a value whose half-width reaches the observed range",
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
