#include "engine/rotary_table/evaluation/stated_positions.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/start/millimetres_text.h"
#include "engine/rotary_table/start/open_places.h"

namespace gumcert::engine {

namespace {

constexpr double k_elsewhere = 0.3;  // [m]: positions are stated to some centimetres
constexpr double k_near = 0.15;      // [m]: that of another station

/// The station whose stated position is where this one is found.
std::optional<std::size_t> stated_there(const RotaryTableMeasurement& measurement, const Eigen::Vector3d& found) {
    for (std::size_t k = 0; k < measurement.stations.size(); ++k) {
        const std::optional<Eigen::Vector3d>& stated = measurement.station_start[k];
        if (stated && (found - *stated).norm() < k_near) {
            return k;
        }
    }
    return std::nullopt;
}

gum::Diagnostic found_elsewhere(const RotaryTableMeasurement& measurement, const std::vector<Eigen::Vector3d>& found,
                                const std::vector<std::size_t>& off) {
    const std::size_t j = off.front();
    const Eigen::Vector3d& stated = *measurement.station_start[j];
    const std::optional<std::size_t> other = stated_there(measurement, found[j]);
    return {"GC-GEOMETRY-0009",
            "station " + measurement.stations[j],
            "it is stated near " + in_millimetres(stated) + ", and the distances put it near " +
                in_millimetres(found[j]) + others_alike(measurement, off),
            "positions are stated in the frame of the table, within 0.3 m; the result does not rest on them",
            other ? "it stands where " + measurement.stations[*other] +
                        " is stated: see whether their names are interchanged in the stations file, or in the lengths "
                        "and with "
                        "them the temperatures"
                  : "compare the position with the set-up, and the names of the stations in all files",
            gum::Severity::warning};
}

gum::Diagnostic open_sign(const RotaryTableMeasurement& measurement) {
    const std::string axis(1, "xyz"[axial_coordinate(measurement.axis)]);
    const std::array<std::string, 6> motions = error_motion_names(measurement.axis);
    const auto along = static_cast<std::size_t>(axial_coordinate(measurement.axis));
    std::string names = motions[along];
    for (std::size_t k = 0; k < 3; ++k) {
        names += k == along ? "" : ", " + motions[3 + k];
    }
    return {"GC-GEOMETRY-0010",
            "stations",
            "no position is stated that tells the sign of " + axis +
                " along the axis: it is that of the coordinates of the fixture",
            "the mirror image of a table has the same distances, with the other sign of " + names,
            "state the positions of the stations to some centimetres, or see that the coordinates of the fixture are "
            "those of a right-handed frame",
            gum::Severity::note};
}

}  // namespace

std::vector<gum::Diagnostic> stated_position_notes(const RotaryTableMeasurement& measurement,
                                                   const std::vector<Eigen::Vector3d>& found) {
    const int axial = axial_coordinate(measurement.axis);
    std::vector<gum::Diagnostic> notes;
    std::vector<std::size_t> off;
    bool tells_sign = false;
    for (std::size_t j = 0; j < found.size(); ++j) {
        const std::optional<Eigen::Vector3d>& stated = measurement.station_start[j];
        if (stated && (found[j] - *stated).norm() > k_elsewhere) {
            off.push_back(j);
        }
        // As far from its own mirror image as what is found elsewhere.
        tells_sign = tells_sign || (stated && 2.0 * std::abs(found[j][axial]) > k_elsewhere);
    }
    if (!off.empty()) {
        notes.push_back(found_elsewhere(measurement, found, off));
    }
    if (!tells_sign) {
        notes.push_back(open_sign(measurement));
    }
    return notes;
}

}  // namespace gumcert::engine
