#include "engine/rotary_table/group_notes.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

constexpr std::size_t k_most_notes = 5;

std::string size_of(double length) {
    const double size = std::abs(length) / gum::k_micrometre;
    // 999.5 is 1000 in three digits, which would be a millimetre written in µm.
    return size < 999.5 ? text::significant(size, 3) + " µm" : text::significant(size / 1000.0, 3) + " mm";
}

/// At most `digits` significant digits, written without an exponent: "1150".
std::string plain(double value, int digits) {
    if (!(value >= std::pow(10.0, digits) - 0.5)) {
        return text::significant(value, digits);
    }
    const double quantum = std::pow(10.0, std::floor(std::log10(value)) + 1.0 - digits);
    return text::fixed(std::round(value / quantum) * quantum, 0);
}

/// What is wrong with a group whose size is not told, and why it is not. Empty of kinds that have no size.
std::string what_without_size(const GroupTest& test) {
    std::string what;
    switch (test.kind) {
        case GroupKind::visit_length:
            what = "all distances of this visit are off alike";
            break;
        case GroupKind::visit_pose:
            what = "the table stood elsewhere at this visit than at the others of this angle";
            break;
        case GroupKind::dead_path_change:
            what = "from this visit on all distances of the station are off alike";
            break;
        case GroupKind::station_place:
            what = "from this pass on the station stood elsewhere than before";
            break;
        case GroupKind::pair_length:
            what = "all distances between this station and this reflector are off alike";
            break;
        case GroupKind::drift:
            what = test.degrees_of_freedom > 1 ? "the distances of the stations drift from the first visit to the last"
                                               : "the distances drift from the first visit to the last";
            break;
        case GroupKind::reflector:
            what = "the distances put it elsewhere than its stated coordinates";
            break;
        case GroupKind::reflector_at_angles:
            what = "at these angles the reflector stands elsewhere in the fixture than at all others";
            break;
        case GroupKind::reflector_from_visit:
            what = "from this visit on the reflector stood elsewhere in the fixture than before";
            break;
        case GroupKind::fixture_scale:
            what =
                "the distances put the whole fixture at another size than that of its coordinates at its temperature";
            break;
        case GroupKind::station_scale:
            what = "all distances of this station are too long or too short by one factor beside those of the others";
            break;
        case GroupKind::fixture_place:
            what = "from this visit on the fixture stood elsewhere on the table than before";
            break;
        case GroupKind::expansion:
            what = "the distances give another expansion coefficient for the fixture than the one that is stated";
            break;
        case GroupKind::angle_index:
        case GroupKind::succession:
        case GroupKind::station:
        case GroupKind::senses:
            return what;
    }
    return what + (test.is_settled ? "; by how much could not be determined beside the other suspected errors"
                                   : "; by how much is not known: no adjustment without this error confirms a size");
}

std::string chi_square_of(double value) {
    return value < 1000.0 ? text::significant(value, 3) : text::significant(std::round(value), 12);
}

/// "105°": a place is for people. The selector of exclusion_of() has 12 digits, since it must find the angle of the file.
std::string angle_of(const RotaryTableMeasurement& measurement, std::size_t angle) {
    return text::significant(measurement.angles_deg[angle], 8) + "°";
}

/// "station P1, pass P1-1+, 105°"
std::string place_of(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    if (test.kind == GroupKind::reflector) {
        return "fixture, reflector " + measurement.reflectors[test.reflector];
    }
    if (test.kind == GroupKind::reflector_at_angles) {
        return "fixture, reflector " + measurement.reflectors[test.reflector] + ", " +
               angle_of(measurement, test.angle) + "–" + angle_of(measurement, test.last_angle);
    }
    if (test.kind == GroupKind::reflector_from_visit) {
        return "fixture, reflector " + measurement.reflectors[test.reflector] + ", station " +
               measurement.stations[test.station] + ", pass " + measurement.passes[test.pass] + ", " +
               angle_of(measurement, test.angle);
    }
    if (test.kind == GroupKind::fixture_scale || test.kind == GroupKind::expansion) {
        return "fixture";
    }
    if (test.station == GroupTest::k_none) {
        return "lengths";
    }
    std::string place = "station " + measurement.stations[test.station];
    if (test.kind == GroupKind::pair_length) {
        return place + ", reflector " + measurement.reflectors[test.reflector];
    }
    if (test.kind == GroupKind::station_place) {
        return place + ", pass " + measurement.passes[test.pass];
    }
    if (test.pass != GroupTest::k_none && test.kind != GroupKind::drift) {
        place += ", pass " + measurement.passes[test.pass] + ", " + angle_of(measurement, test.angle);
    }
    return place;
}

/// The size of the fixture is the effect; the temperature that it means at the stated expansion is the likely cause.
/// The estimate is that of the stated coordinates, which are too large where the fixture is smaller.
std::string scale_of(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    const double size = std::abs(test.estimate);
    const bool is_smaller = test.estimate > 0.0;
    std::string text = "the distances put the whole fixture " + plain(size * 1e6, 3) + " ppm " +
                       (is_smaller ? "smaller" : "larger") + " than its coordinates at its temperature";
    if (measurement.expansion > 0.0) {
        // ΔT = ε/α: the likely cause, as the number that a laboratory can check.
        text += ", as if it were " + plain(size / measurement.expansion, 2) + " K " +
                (is_smaller ? "colder" : "warmer") + " than stated";
    }
    return text;
}

/// "the distances give an expansion coefficient of 11.4 · 10⁻⁶/K for the fixture, while 23.5 · 10⁻⁶/K is stated, with u = 0.5 · 10⁻⁶/K"
std::string expansion_of(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    const auto per_kelvin = [](double value, int digits) {
        return text::significant(value * 1e6, digits) + " · 10⁻⁶/K";
    };
    return "the distances give an expansion coefficient of " + per_kelvin(measurement.expansion - test.estimate, 3) +
           " for the fixture, while " + per_kelvin(measurement.expansion, 3) +
           " is stated, with u = " + per_kelvin(measurement.u_expansion, 2);
}

std::string what_of(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    if (std::string what = test.has_size() ? std::string() : what_without_size(test); !what.empty()) {
        return what;
    }
    switch (test.kind) {
        case GroupKind::visit_length:
            return "all distances of this visit are off by " + size_of(test.estimate) + " alike";
        case GroupKind::visit_pose:
            return "the table stood elsewhere at this visit than at the others of this angle: the distances differ "
                   "by " +
                   size_of(test.estimate) + " (root mean square)";
        case GroupKind::dead_path_change:
            return "from this visit on all distances of the station are off by " + size_of(test.estimate) + " alike";
        case GroupKind::station_place:
            return "from this pass on the station stood " + size_of(test.estimate) + " away from where it was before";
        case GroupKind::pair_length:
            return "all distances between this station and this reflector are off by " + size_of(test.estimate) +
                   " alike";
        case GroupKind::drift:
            return test.degrees_of_freedom > 1
                       ? "the distances of the stations drift, by " + size_of(test.estimate) +
                             " from the first visit to the last (root mean square of the stations)"
                       : "the distances drift by " + size_of(test.estimate) + " from the first visit to the last";
        case GroupKind::angle_index:
            return "the distances of this station agree with the others when its angles are " +
                   (std::abs(test.estimate) < 1.5 ? std::string("one step")
                                                  : text::significant(std::abs(test.estimate), 6) + " steps") +
                   (test.estimate > 0.0 ? " higher" : " lower");
        case GroupKind::succession:
            return "successive visits deviate alike: their autocorrelation coefficient is " +
                   text::significant(test.estimate, 2);
        case GroupKind::station:
            return "the visits of this station scatter " + text::significant(test.estimate, 2) +
                   " times as much as those of the "
                   "others";
        case GroupKind::reflector:
            return "the distances put it " + size_of(test.estimate) + " away from its stated coordinates";
        case GroupKind::reflector_at_angles:
            return "at these angles the reflector stands " + size_of(test.estimate) +
                   " away from where it stands in the fixture at all others";
        case GroupKind::reflector_from_visit:
            return "from this visit on the reflector stood " + size_of(test.estimate) +
                   " away from where it was in the fixture before";
        case GroupKind::fixture_scale:
            return scale_of(test, measurement);
        case GroupKind::station_scale:
            return "all distances of this station are " + plain(std::abs(test.estimate) * 1e6, 3) + " ppm too " +
                   (test.estimate > 0.0 ? "long" : "short") + " beside those of the others";
        case GroupKind::fixture_place:
            return "from this visit on the fixture stood " + size_of(test.estimate) +
                   " away from where it was on the table before (root mean square of its reflectors)";
        case GroupKind::expansion:
            return expansion_of(test, measurement);
        case GroupKind::senses:
            return "the distances of this station agree with the others when the senses + and - of its passes are "
                   "interchanged";
    }
    return "";
}

/// What to write into the job to leave the group out, for the kinds that can be left out.
std::string exclusion_of(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    std::string selectors;
    switch (test.kind) {
        case GroupKind::visit_length:
        case GroupKind::visit_pose:
            selectors = "\"station\": \"" + measurement.stations[test.station] + "\", \"pass\": \"" +
                        measurement.passes[test.pass] +
                        "\", \"angle_deg\": " + text::significant(measurement.angles_deg[test.angle], 12);
            break;
        case GroupKind::angle_index:
        case GroupKind::station:
        case GroupKind::station_scale:
        case GroupKind::senses:
            selectors = "\"station\": \"" + measurement.stations[test.station] + "\"";
            break;
        case GroupKind::pair_length:
            selectors = "\"station\": \"" + measurement.stations[test.station] + "\", \"reflector\": \"" +
                        measurement.reflectors[test.reflector] + "\"";
            break;
        case GroupKind::reflector:
        case GroupKind::reflector_at_angles:
        case GroupKind::reflector_from_visit:
            selectors = "\"reflector\": \"" + measurement.reflectors[test.reflector] + "\"";
            break;
        // Not one visit is wrong there, but all from some visit on, or all in their order: leaving distances out is no
        // cure.
        case GroupKind::dead_path_change:
        case GroupKind::station_place:
        case GroupKind::drift:
        case GroupKind::succession:
        case GroupKind::fixture_scale:
        case GroupKind::fixture_place:
        case GroupKind::expansion:
            return "";
    }
    return " The job leaves these distances out with \"exclude\": [{ " + selectors + ", \"reason\": \"why\" }].";
}

/// Whether a visit is the first one of a pass of its station: before it, hands were at the set-up.
bool begins_a_pass(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    const bool has_times = measurement.times.size() == measurement.lengths.size();
    std::optional<std::size_t> first;
    bool follows = false;
    for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
        const LengthObservation& length = measurement.lengths[i];
        follows = follows || (length.station == test.station && length.pass != test.pass);
        if (length.station == test.station && length.pass == test.pass &&
            (!first || (has_times && measurement.times[i] < measurement.times[*first]))) {
            first = i;
        }
    }
    return first && follows && measurement.lengths[*first].angle == test.angle;
}

/// Whether a station drives the table in the other sense from a pass on: with interchanged senses the reversal of the table
/// moves all its distances alike there.
bool begins_other_sense(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    std::optional<Approach> before;
    for (const LengthObservation& length : measurement.lengths) {
        if (length.station != test.station) {
            continue;
        }
        if (length.pass == test.pass) {
            return before && *before != length.approach;
        }
        before = length.approach;
    }
    return false;
}

std::string action_of(const GroupTest& test, const RotaryTableMeasurement& measurement) {
    switch (test.kind) {
        case GroupKind::visit_length:
            return "Look for a disturbed beam at this visit, and measure it again; without it the result rests on the "
                   "other visits of this angle.";
        case GroupKind::visit_pose:
            return "See whether the table had come to its angle, and which angle the file states; measure the visit "
                   "again.";
        case GroupKind::dead_path_change:
            if (begins_a_pass(test, measurement)) {
                return "A new pass of the station begins there: a station that was moved looks alike. Look at its "
                       "support; "
                       "if it was moved, give the lengths from this pass on a station name of their own. If the beam "
                       "was "
                       "interrupted there, give the distances from there on a dead path of their own.";
            }
            return "If the beam was interrupted there, give the distances from there on a dead path of their own.";
        case GroupKind::station_place:
            return (begins_other_sense(test, measurement)
                        ? std::string(
                              "The station drives the table in the other sense from this pass on: see whether the "
                              "senses of its passes are interchanged in the lengths file, which looks alike. ")
                        : std::string()) +
                   "Look at the support of the station; if it was moved, give the lengths from this pass on a station "
                   "name of their own, so that its new place is found with the others.";
        case GroupKind::pair_length:
            return "Look along this line of sight: something near the beam, a soiled or damaged reflector; measure "
                   "these distances again.";
        case GroupKind::drift:
            return "Look at the temperatures and at the supports of stations and table; measure in both senses, and "
                   "the "
                   "first angle again at the end of each run, or let it settle and measure again.";
        case GroupKind::angle_index:
            return "Correct the angles of this station in the lengths file.";
        case GroupKind::succession:
            return "Look for drift, of temperature or of a support; the visits are not independent of each other, and "
                   "the uncertainties are too small.";
        case GroupKind::station:
            return "Look at this station: its support, its line of sight, its angles.";
        case GroupKind::reflector:
            return "Measure the reflector again with the CMM, and check that it has not moved in its holder.";
        case GroupKind::reflector_at_angles:
            return "Look at the holder of this reflector: it gives way, or something pulls at it, at these angles; "
                   "fasten "
                   "it and measure again.";
        case GroupKind::reflector_from_visit:
            return "Look at the holder of this reflector: it was moved there, and its coordinates hold before or after "
                   "only; fasten it, measure its place with the CMM and the distances again.";
        case GroupKind::fixture_scale:
            return "Look at the temperature of the fixture, at its expansion coefficient and at the reference "
                   "temperature of its coordinates; then at the scale of the distances, as of the refractive index of "
                   "the air, which does the same.";
        case GroupKind::station_scale:
            return "Look at the unit of these distances, at the refractive index of the air that they were made with, "
                   "and at the temperature of the fixture while they were measured.";
        case GroupKind::fixture_place:
            return "Look at the clamping of the fixture: it was moved on the table there; fasten it and measure again.";
        case GroupKind::expansion:
            return "Look at the material of the fixture and at its expansion coefficient; then at the temperatures at "
                   "the "
                   "stations and at the reference temperature of the coordinates.";
        case GroupKind::senses:
            return "See in the protocol in which senses this station drove the table, and correct the directions in "
                   "the "
                   "lengths file.";
    }
    return "";
}

gum::Diagnostic note_of_rest(const ContradictionLeft& left) {
    constexpr double k_least_printed = 1e-4;
    const std::string p = left.p_value < k_least_printed ? "< 0.0001" : "= " + text::fixed(left.p_value, 4);
    return {.code = k_unexplained_rest,
            .where = "lengths",
            .what = std::string("with these errors taken off, ") +
                    (left.is_of_a_group ? "a group of distances still deviates from the others"
                                        : "the distances still contradict the stated uncertainties") +
                    " (p " + p + "): the cause is not, or not only, what is named",
            .rule = "causes that are named explain the distances when these agree without them: p is at least 0.001",
            .action =
                "Look for another cause that would look alike, or for a second one, before the data are "
                "corrected; measure again where none is found.",
            .severity = gum::Severity::warning};
}

}  // namespace

std::vector<gum::Diagnostic> group_notes(const GroupTests& groups, const RotaryTableMeasurement& measurement) {
    std::vector<gum::Diagnostic> notes;
    for (const GroupTest& test : groups.tests) {
        if (test.suspicious && notes.size() < k_most_notes) {
            notes.push_back({.code = k_suspicious_group,
                             .where = place_of(test, measurement),
                             .what = what_of(test, measurement) + " (chi-square " + chi_square_of(test.chi_square) +
                                     ", limit " + chi_square_of(test.critical_value) + ")",
                             .rule =
                                 "of a hundred sound measurements one exceeds any such limit at most; what exceeds it "
                                 "belongs to the measurement and not to the repeatability of the table",
                             .action = action_of(test, measurement) + exclusion_of(test, measurement),
                             .severity = gum::Severity::warning});
        }
    }
    if (groups.left && !notes.empty()) {
        notes.push_back(note_of_rest(*groups.left));
    }
    return notes;
}

}  // namespace gumcert::engine
