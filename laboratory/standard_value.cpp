#include "laboratory/standard_value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "certificate/dates.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "text/counts.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::laboratory {

namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse_use(const char* code, const StandardRecord& record, std::string what, std::string rule,
                             std::string action) {
    throw gum::InputError(gum::Diagnostic{.code = code,
                                          .where = "standard \"" + record.id + "\"",
                                          .what = std::move(what),
                                          .rule = std::move(rule),
                                          .action = std::move(action)});
}

/// In which the nominal value of a line stands, and its limits.
const std::string& nominal_unit_of(const CalibrationResult& line) {
    return line.nominal_unit.empty() ? line.unit : line.nominal_unit;
}

/// 10 V and 10000 mV are one nominal value, 10 V and 10 mV are two.
bool is_same_nominal(const CalibrationResult& a, const CalibrationResult& b) {
    if (!a.nominal || !b.nominal) {
        return a.nominal.has_value() == b.nominal.has_value();
    }
    if (nominal_unit_of(a) == nominal_unit_of(b)) {
        return is_same_value(*a.nominal, *b.nominal);
    }
    const gum::Unit of_a = gum::Unit::parse(nominal_unit_of(a));
    const gum::Unit of_b = gum::Unit::parse(nominal_unit_of(b));
    // °C and K count from different zeros, and to_si() does not tell them apart.
    return of_a.dimension() == of_b.dimension() && of_a.is_celsius_temperature() == of_b.is_celsius_temperature() &&
           is_same_value(of_a.to_si(*a.nominal), of_b.to_si(*b.nominal));
}

const CalibrationResult* same_line(const Calibration& calibration, const CalibrationResult& line) {
    for (const CalibrationResult& result : calibration.results) {
        if (result.quantity == line.quantity && result.range == line.range && result.mode == line.mode &&
            is_same_nominal(result, line)) {
            return &result;
        }
    }
    return nullptr;
}

/// A line less its nominal value, where the two are in one unit.
double correction(const CalibrationResult& line) {
    const bool one_unit = line.nominal_unit.empty() || line.nominal_unit == line.unit;
    return one_unit ? line.value - *line.nominal : line.value;
}

/// What is added to a correction at a value.
double base_at(const CalibrationResult& line, double at) {
    return line.nominal_unit.empty() || line.nominal_unit == line.unit ? at : 0.0;
}

double second_divided_difference(const CalibrationResult& a, const CalibrationResult& b, const CalibrationResult& c) {
    const double ab = (correction(b) - correction(a)) / (*b.nominal - *a.nominal);
    const double bc = (correction(c) - correction(b)) / (*c.nominal - *b.nominal);
    return (bc - ab) / (*c.nominal - *a.nominal);
}

StandardValue of_line(const StandardRecord& record, const Calibration& calibration, const CalibrationResult& line,
                      double days) {
    StandardValue out;
    out.calibration = &calibration;
    out.result = &line;
    out.unit = line.unit;
    out.value = line.value;
    out.U = line.U;
    out.k = line.k;
    out.p = line.p;
    out.nu = line.nu;
    out.drift = drift_of(record, calibration, line, days);
    out.days = days;
    return out;
}

/// Lines with nominal values, rising.
std::vector<const CalibrationResult*> by_nominal(std::vector<const CalibrationResult*> lines) {
    std::erase_if(lines, [](const CalibrationResult* line) { return !line->nominal; });
    std::stable_sort(lines.begin(), lines.end(),
                     [](const CalibrationResult* a, const CalibrationResult* b) { return *a->nominal < *b->nominal; });
    return lines;
}

/// An error or a correction stands beside its nominal value, and does not follow it: 0.003 V at 10 V and 0.004 V at 20 V.
bool stands_beside_nominal(const CalibrationResult& below, const CalibrationResult& above) {
    return std::abs(above.value - below.value) < std::abs(correction(above) - correction(below));
}

/// \param upper  position of the line above `at`
StandardValue nearest(const StandardRecord& record, const Calibration& calibration,
                      const std::vector<const CalibrationResult*>& lines, std::size_t upper, double at, double days) {
    const CalibrationResult& below = *lines[upper - 1];
    const CalibrationResult& above = *lines[upper];
    const CalibrationResult& near = at - *below.nominal <= *above.nominal - at ? below : above;
    StandardValue out = of_line(record, calibration, near, days);
    double change = above.value - below.value;
    if (!stands_beside_nominal(below, above)) {
        out.value = base_at(near, at) + correction(near);
        change = correction(above) - correction(below);
    }
    // What is taken from the nearer point may have changed on the way, the more the farther, up to the whole difference
    // at the other point.
    out.interpolation_half_width = std::abs(change) * std::abs(at - *near.nominal) / (*above.nominal - *below.nominal);
    return out;
}

StandardValue linear(const StandardRecord& record, const Calibration& calibration,
                     const std::vector<const CalibrationResult*>& lines, std::size_t upper, double at, double days) {
    if (lines.size() < 3) {
        refuse_use("GC-LAB-0015", record, "two calibrated values",
                   "how far a curve is from its chord is seen with a third one",
                   "state \"interpolation\": \"nearest\", or have more values calibrated");
    }
    const CalibrationResult& below = *lines[upper - 1];
    const CalibrationResult& above = *lines[upper];
    const double l = (at - *below.nominal) / (*above.nominal - *below.nominal);
    const StandardValue low = of_line(record, calibration, below, days);
    const StandardValue high = of_line(record, calibration, above, days);
    // The remainder of linear interpolation is (x − x0)(x − x1) f″(ξ)/2, and f″/2 is estimated by the second divided
    // differences of the points on both sides; the larger one counts.
    double bend = 0.0;
    if (upper >= 2) {
        bend = std::abs(second_divided_difference(*lines[upper - 2], below, above));
    }
    if (upper + 1 < lines.size()) {
        bend = std::max(bend, std::abs(second_divided_difference(below, above, *lines[upper + 1])));
    }
    StandardValue out = l <= 0.5 ? low : high;
    out.other = l <= 0.5 ? &above : &below;
    out.value = base_at(below, at) + (1.0 - l) * correction(below) + l * correction(above);
    // Added as they are and not as squares: points of one certificate share its standard, so that nothing averages out.
    out.U = (1.0 - l) * standard_uncertainty(below) + l * standard_uncertainty(above);
    out.k = 1.0;
    out.p.reset();
    // The least of them claims no more than is known.
    const double nu = std::min(below.nu.value_or(k_infinity), above.nu.value_or(k_infinity));
    out.nu = std::isinf(nu) ? std::nullopt : std::optional(nu);
    out.interpolation_half_width = std::abs((at - *below.nominal) * (at - *above.nominal)) * bend;
    out.drift.value = (1.0 - l) * low.drift.value + l * high.drift.value;
    out.drift.u = (1.0 - l) * low.drift.u + l * high.drift.u;
    out.drift.half_width = (1.0 - l) * low.drift.half_width + l * high.drift.half_width;
    out.drift.nu = std::min(low.drift.nu, high.drift.nu);
    return out;
}

/// "; the lines of its certificate have range "1 V", "10 V"", where words tell them apart.
std::string lines_there_are(const Calibration* calibration) {
    constexpr std::size_t k_most = 12;
    std::string text;
    for (const auto& [word, member] : {std::pair("quantity", &CalibrationResult::quantity),
                                       {"range", &CalibrationResult::range},
                                       {"mode", &CalibrationResult::mode}}) {
        std::vector<std::string> there;
        for (std::size_t i = 0; calibration != nullptr && i < calibration->results.size(); ++i) {
            const std::string& own = calibration->results[i].*member;
            if (std::string quoted = text::in_quotes(own);
                !own.empty() && std::find(there.begin(), there.end(), quoted) == there.end()) {
                there.push_back(std::move(quoted));
            }
        }
        if (!there.empty()) {
            text += (text.empty() ? "; the lines of its certificate have " : ", ") + std::string(word) + " " +
                    text::listed(there, k_most);
        }
    }
    return text;
}

/// What a relative limit is a share of, in the unit of the value: the nominal value. The value itself may be an error or a
/// correction, of which a share would be next to nothing.
double magnitude_of(const StandardRecord& record, const CalibrationResult& result, const StatedChange& change) {
    const auto refuse = [&](const std::string& of) {
        refuse_use("GC-LAB-0013", record, "a " + change.called + " in \"" + change.unit + "\" of " + of,
                   "a relative drift or limit is a share of the nominal value of a line, in a unit of its value",
                   "state the nominal value, or the " + change.called + " in the unit of the value");
    };
    const gum::Unit unit = gum::Unit::parse(result.unit);
    const gum::Unit of_nominal = gum::Unit::parse(nominal_unit_of(result));
    if (!result.nominal) {
        refuse("a line without a nominal value");
    }
    if (!(of_nominal.dimension() == unit.dimension())) {
        refuse("a value in \"" + result.unit + "\" with a nominal value in \"" + nominal_unit_of(result) + "\"");
    }
    if (unit.is_celsius_temperature() || of_nominal.is_celsius_temperature()) {
        refuse("a temperature in \"" + result.unit + "\"");
    }
    if (*result.nominal == 0.0) {
        refuse("a line with the nominal value 0");
    }
    return std::abs(unit.from_si(of_nominal.to_si(*result.nominal)));
}

}  // namespace

std::vector<SeriesPoint> history_of(const StandardRecord& record, const Calibration& last,
                                    const CalibrationResult& result) {
    const gum::Unit unit = gum::Unit::parse(result.unit);
    std::vector<SeriesPoint> series;
    for (const Calibration& calibration : record.calibrations) {
        const long days = certificate::days_between(last.calibrated, calibration.calibrated).value_or(0);
        const CalibrationResult* line = same_line(calibration, result);
        // Later calibrations than `last` were not known when it was the last one.
        if (days > 0 || line == nullptr) {
            continue;
        }
        SeriesPoint point{static_cast<double>(days), line->value, standard_uncertainty(*line)};
        if (line->unit != result.unit) {
            const gum::Unit other = gum::Unit::parse(line->unit);
            if (!(other.dimension() == unit.dimension()) ||
                other.is_celsius_temperature() != unit.is_celsius_temperature()) {
                refuse_use("GC-LAB-0013", record,
                           "a value in \"" + line->unit + "\" on " + calibration.calibrated + ", and in \"" +
                               result.unit + "\" on " + last.calibrated,
                           "the values of a history are of one quantity", "correct the unit");
            }
            point.value = unit.from_si(other.to_si(line->value));
            point.u = unit.difference_from_si(other.difference_to_si(point.u));
        }
        series.push_back(point);
    }
    return series;
}

double change_in_unit_of(const StandardRecord& record, const CalibrationResult& result, const StatedChange& change) {
    if (change.unit == result.unit) {
        return change.size;
    }
    const gum::Unit stated = gum::Unit::parse(change.unit);
    const gum::Unit unit = gum::Unit::parse(result.unit);
    const double size = stated.difference_to_si(change.size);
    if (stated.dimension() == unit.dimension()) {
        return unit.difference_from_si(size);
    }
    if (!stated.dimension().is_one()) {
        refuse_use("GC-LAB-0013", record,
                   "a " + change.called + " in \"" + change.unit + "\" of a value in \"" + result.unit + "\"",
                   "a drift or limit is a difference of values, or a share of the nominal value",
                   "state it in the unit of the value, or in percent or ppm of its nominal value");
    }
    return size * magnitude_of(record, result, change);
}

Drift drift_of(const StandardRecord& record, const Calibration& last, const CalibrationResult& result, double days) {
    const DriftModel& model = record.drift;
    switch (model.kind) {
        case DriftKind::none:
            return {};
        case DriftKind::limit_per_year:
            return drift_within_limit(change_in_unit_of(record, result, {model.limit, model.unit, "drift"}), days);
        case DriftKind::linear:
            return linear_drift(history_of(record, last, result), model.weighted, days);
        case DriftKind::last_difference:
            return drift_as_last_difference(history_of(record, last, result), days);
    }
    return {};
}

StandardValue value_of_standard(const StandardRecord& record, const StandardUse& use) {
    const Candidates found = candidates_for(record, use);
    if (found.calibration == nullptr || found.results.empty()) {
        refuse_use("GC-LAB-0014", record, found.verdict.because,
                   "an input takes the value of one line of a certificate",
                   "name another standard, or correct the use" + lines_there_are(found.calibration));
    }
    if (!found.is_narrowed) {
        refuse_use("GC-LAB-0014", record, found.verdict.because,
                   "an input takes the value of one line of a certificate",
                   "state \"quantity\", \"range\" or \"mode\"" + lines_there_are(found.calibration));
    }
    const Calibration& calibration = *found.calibration;
    const double days = static_cast<double>(certificate::days_between(calibration.calibrated, use.date).value_or(0));
    if (!use.at) {
        if (found.results.size() > 1) {
            refuse_use("GC-LAB-0014", record, text::count_of(found.results.size(), "line") + " of its certificate fit",
                       "an input takes the value of one line of a certificate",
                       "state \"quantity\", \"range\", \"mode\" or \"at\"");
        }
        return of_line(record, calibration, *found.results.front(), days);
    }
    const double at = *use.at;
    const CalibrationResult* exact = nullptr;
    for (const CalibrationResult* line : found.results) {
        if (!line->nominal || !is_same_value(*line->nominal, at)) {
            continue;
        }
        // "at" is a number without a unit: which of 10 V and 10 mV it means is not for the order of the lines to say.
        if (exact != nullptr && !is_same_nominal(*exact, *line)) {
            refuse_use("GC-LAB-0014", record,
                       text::shortest_plain(at) + " " + nominal_unit_of(*exact) + " and " + text::shortest_plain(at) +
                           " " + nominal_unit_of(*line) + " are lines of its certificate",
                       "an input takes the value of one line of a certificate",
                       "state \"quantity\", \"range\" or \"mode\" beside \"at\"");
        }
        exact = exact == nullptr ? line : exact;
    }
    if (exact != nullptr) {
        return of_line(record, calibration, *exact, days);
    }
    for (const CalibrationResult* line : found.results) {
        if (line->low && line->high && *line->low <= at && at <= *line->high) {
            return of_line(record, calibration, *line, days);
        }
    }
    const std::vector<const CalibrationResult*> lines = by_nominal(found.results);
    const auto above =
        std::find_if(lines.begin(), lines.end(), [&](const CalibrationResult* line) { return *line->nominal > at; });
    const bool is_between = above != lines.begin() && above != lines.end();
    if (!is_between || record.interpolation == Interpolation::none) {
        refuse_use(
            "GC-LAB-0014", record,
            "no calibrated value at " + value_in_words(at, found.results) + (is_between ? "" : ", and none beyond it"),
            is_between ? "between calibrated values the register says how to interpolate" : "nothing is extrapolated",
            is_between ? "state \"interpolation\" in the register, or use a calibrated value"
                       : "use the standard at its calibrated values");
    }
    const auto upper = static_cast<std::size_t>(above - lines.begin());
    for (const CalibrationResult* line : lines) {
        if (line->unit != lines[upper]->unit || line->nominal_unit != lines[upper]->nominal_unit) {
            refuse_use("GC-LAB-0013", record, "values in \"" + line->unit + "\" and in \"" + lines[upper]->unit + "\"",
                       "values between which is interpolated stand in one unit",
                       "write them in one unit in the register");
        }
    }
    return record.interpolation == Interpolation::nearest ? nearest(record, calibration, lines, upper, at, days)
                                                          : linear(record, calibration, lines, upper, at, days);
}

}  // namespace gumcert::laboratory
