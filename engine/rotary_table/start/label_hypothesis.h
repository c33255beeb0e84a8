#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// What the file may say wrongly of the distances of one station.
struct LabelHypothesis {
    bool other_sense = false;             ///< the table turned the other way
    std::size_t first = 0, second = 0;    ///< reflectors that are interchanged; equal: none
    double lengths = 1.0;                 ///< by which the distances are multiplied
    bool scale = false;                   ///< that factor was looked for, and is none of a list
    double fixture = 1.0;                 ///< the coordinates of the fixture
    double angles = 1.0;                  ///< the angles, from the home angle on
    std::optional<RotaryAxis> axis = {};  ///< about which the table turned
    friend bool operator==(const LabelHypothesis&, const LabelHypothesis&) = default;
};

/// All that are tried: the other sense, factors of sign, unit and step, the other axes, each pair of reflectors.
[[nodiscard]] std::vector<LabelHypothesis> label_hypotheses(const RotaryTableMeasurement& measurement);

/// The measurement with the distances of one station as the hypothesis reads them. What is said of angles, fixture, axis and
/// lengths is said of all distances: the others of the result are not to be used.
[[nodiscard]] RotaryTableMeasurement relabelled(RotaryTableMeasurement measurement, std::size_t station,
                                                const LabelHypothesis& hypothesis);

/// The hypothesis as a message: GC-ADJUST-0013, or GC-GEOMETRY-0007 for another axis; severity error.
/// \param station  its name; "" for all
[[nodiscard]] gum::Diagnostic wrong_labels(const RotaryTableMeasurement& measurement, const LabelHypothesis& cause,
                                           const std::string& station);

}  // namespace gumcert::engine
