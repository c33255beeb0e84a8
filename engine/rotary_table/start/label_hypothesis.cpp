#include "engine/rotary_table/start/label_hypothesis.h"

#include <cmath>

#include "text/numbers.h"

namespace gumcert::engine {

std::vector<LabelHypothesis> label_hypotheses(const RotaryTableMeasurement& measurement) {
    std::vector<LabelHypothesis> hypotheses;
    hypotheses.push_back({.other_sense = true});
    // A sign, a path that is counted twice or halved; units of length; gon for degrees, ten steps for fifteen. Only a
    // ratio of lengths and fixture can be told: which of them is wrong the message leaves open.
    for (const double factor : {-1.0, 2.0, 0.5}) {
        hypotheses.push_back({.lengths = factor});
    }
    for (const double factor : {25.4, 1.0 / 25.4, 10.0, 0.1, 1000.0, 0.001}) {
        hypotheses.push_back({.fixture = factor});
    }
    for (const double factor : {0.9, 1.0 / 0.9, 1.5, 1.0 / 1.5, 2.0, 0.5}) {
        hypotheses.push_back({.angles = factor});
    }
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        if (axis != measurement.axis) {
            hypotheses.push_back({.axis = axis});
        }
    }
    for (std::size_t a = 0; a < measurement.reflectors.size(); ++a) {
        for (std::size_t b = a + 1; b < measurement.reflectors.size(); ++b) {
            hypotheses.push_back({.first = a, .second = b});
        }
    }
    return hypotheses;
}

RotaryTableMeasurement relabelled(RotaryTableMeasurement measurement, std::size_t station,
                                  const LabelHypothesis& hypothesis) {
    for (LengthObservation& length : measurement.lengths) {
        if (length.station != station) {
            continue;
        }
        if (length.reflector == hypothesis.first) {
            length.reflector = hypothesis.second;
        } else if (length.reflector == hypothesis.second) {
            length.reflector = hypothesis.first;
        }
    }
    if (hypothesis.other_sense) {
        const double home = measurement.angles[measurement.home];
        for (double& angle : measurement.angles) {
            // About the home angle, where the fixture stands in its frame.
            angle = 2.0 * home - angle;
        }
    }
    measurement.axis = hypothesis.axis.value_or(measurement.axis);
    if (hypothesis.angles != 1.0) {
        const double home = measurement.angles[measurement.home];
        for (double& angle : measurement.angles) {
            angle = home + hypothesis.angles * (angle - home);
        }
    }
    if (hypothesis.lengths != 1.0) {
        for (LengthObservation& length : measurement.lengths) {
            length.length *= hypothesis.lengths;
        }
    }
    measurement.fixture *= hypothesis.fixture;
    return measurement;
}

gum::Diagnostic wrong_labels(const RotaryTableMeasurement& measurement, const LabelHypothesis& cause,
                             const std::string& station) {
    const std::string where = station.empty() ? "lengths" : "lengths, station " + station;
    if (cause.other_sense) {
        return {"GC-ADJUST-0013",
                where,
                "the distances agree with a table that turns the other way than the angles say",
                "angles are positive about the axis of the table frame by the right-hand rule",
                "reverse the sign of the angles, or see whether the coordinates of the fixture are those of a "
                "right-handed frame",
                gum::Severity::error};
    }
    if (cause.axis) {
        const auto coordinate = [](RotaryAxis axis) { return std::string(1, "xyz"[axial_coordinate(axis)]); };
        return {"GC-GEOMETRY-0007",
                station.empty() ? "fixture" : "fixture, seen from station " + station,
                "the distances agree with a table that turns about " + coordinate(*cause.axis) +
                    " of the fixture coordinates, and not about " + coordinate(measurement.axis),
                "the axis lies along the coordinate of the fixture that has its letter, within 45°: error motions "
                "are named after these coordinates",
                "correct the letter of the axis, or state the coordinates in a frame with " +
                    coordinate(measurement.axis) + " along the axis",
                gum::Severity::error};
    }
    if (cause.scale) {
        return {"GC-ADJUST-0013", where,
                // A refractive index that was left out is 270 ppm.
                "the distances agree when they are multiplied by about " +
                    text::fixed(cause.lengths, std::abs(cause.lengths - 1.0) < 5e-4 ? 6 : 4),
                "a distance grows as the reflector moves away from the station, by as much as it moves",
                station.empty() ? "see in which unit distances and coordinates of the fixture were written, which "
                                  "refractive index of the air the distances were made with, and at which "
                                  "temperature the coordinates hold"
                                : "see in which unit the distances were written, and which refractive index of the "
                                  "air and which wavelength they were made with",
                gum::Severity::error};
    }
    if (cause.lengths != 1.0) {
        return {"GC-ADJUST-0013",
                where,
                cause.lengths < 0.0
                    ? std::string("the distances agree when they have the other sign")
                    : "the distances agree when they are multiplied by " + text::significant(cause.lengths, 3),
                "a distance grows as the reflector moves away from the station, by as much as it moves",
                cause.lengths < 0.0 ? "reverse the sign of the distances"
                : cause.lengths == 2.0 || cause.lengths == 0.5
                    ? "see whether the path of the beam was counted twice or halved, and correct the "
                      "distances"
                    : "see in which unit they were written, and correct the distances",
                gum::Severity::error};
    }
    if (cause.fixture != 1.0 && !station.empty()) {
        // The other stations agree with the fixture, or have a factor of their own: it is the distances.
        return wrong_labels(measurement, {.lengths = 1.0 / cause.fixture}, station);
    }
    if (cause.fixture != 1.0) {
        return {"GC-ADJUST-0013",
                where,
                "the distances agree with a fixture whose coordinates are multiplied by " +
                    text::significant(cause.fixture, 3),
                "distances and coordinates of the fixture are stated in millimetres",
                "see in which unit each of them was measured, and correct the one that is not in millimetres",
                gum::Severity::error};
    }
    if (cause.angles != 1.0) {
        return {"GC-ADJUST-0013",
                where,
                "the distances agree with a table that turned " + text::significant(cause.angles, 3) +
                    " times as far as the angles say",
                "angles are stated in degrees, as far as the table turned",
                std::abs(cause.angles - 0.9) < 0.01 ? "the angles seem to be gon: multiply them by 0.9"
                                                    : "see in which unit and in which steps the angles were written",
                gum::Severity::error};
    }
    const std::string a = measurement.reflectors[cause.first];
    const std::string b = measurement.reflectors[cause.second];
    return {"GC-ADJUST-0013",
            where,
            "the distances agree when the reflectors " + a + " and " + b + " are interchanged",
            "a reflector has the same name in the lengths and in the coordinates of the fixture",
            station.empty() ? "interchange the names in the fixture file or in the lengths"
                            : "interchange the names in the lengths of this station",
            gum::Severity::error};
}

}  // namespace gumcert::engine
