#include "engine/rotary_table/evaluation/stated_positions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/start/millimetres_text.h"

namespace gumcert::engine {

namespace {

constexpr double k_elsewhere = 0.3;  // [m]: positions are stated to some centimetres
constexpr double k_near = 0.15;      // [m]: that of another station, with the offset of the fixture

Eigen::Vector3d mirror_image(const RotaryTableMeasurement& measurement, Eigen::Vector3d position) {
    position[axial_coordinate(measurement.axis)] *= -1.0;
    return position;
}

/// How stated positions fit places of the stations.
struct StatedFit {
    double sum = 0.0;        ///< of the distances, [m]
    std::size_t own = 0;     ///< stations near their own stated position
    std::size_t anyone = 0;  ///< stations near a stated position, whoever it is stated of
};

StatedFit fit_to_stated(const RotaryTableMeasurement& measurement, const std::vector<Eigen::Vector3d>& places) {
    StatedFit fit;
    for (std::size_t j = 0; j < places.size(); ++j) {
        const std::optional<Eigen::Vector3d>& stated = measurement.station_start[j];
        if (!stated) {
            continue;
        }
        const double distance = (places[j] - *stated).norm();
        fit.sum += distance;
        fit.own += distance <= k_near ? 1U : 0U;
        const bool near = std::ranges::any_of(measurement.station_start, [&](const auto& other) {
            return other && (places[j] - *other).norm() <= k_near;
        });
        fit.anyone += near ? 1U : 0U;
    }
    return fit;
}

/// The station whose stated position is where this one is found. Its own must be wrong as well: two may stand at one place.
std::optional<std::size_t> stated_there(const RotaryTableMeasurement& measurement, const Eigen::Vector3d& found,
                                        const std::vector<std::size_t>& off) {
    for (const std::size_t k : off) {
        if ((found - *measurement.station_start[k]).norm() < k_near) {
            return k;
        }
    }
    return std::nullopt;
}

/// By what all stations are found elsewhere, where that is the same: the zero of the stated positions is another one.
std::optional<Eigen::Vector3d> common_offset(const RotaryTableMeasurement& measurement,
                                             const std::vector<Eigen::Vector3d>& found,
                                             const std::vector<std::size_t>& off) {
    if (off.size() < 2 || std::ranges::count_if(measurement.station_start, [](const auto& start) {
                              return start.has_value();
                          }) != std::ssize(off)) {
        return std::nullopt;
    }
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    for (const std::size_t j : off) {
        offset += (found[j] - *measurement.station_start[j]) / static_cast<double>(off.size());
    }
    for (const std::size_t j : off) {
        if ((found[j] - *measurement.station_start[j] - offset).norm() > k_near) {
            return std::nullopt;
        }
    }
    return offset;
}

/// Stations that are stated nearer to their mirror image, each by too little to be elsewhere, and all alike.
std::vector<std::size_t> nearer_to_image(const RotaryTableMeasurement& measurement,
                                         const std::vector<Eigen::Vector3d>& found) {
    std::vector<std::size_t> nearer;
    for (std::size_t j = 0; j < found.size(); ++j) {
        const std::optional<Eigen::Vector3d>& stated = measurement.station_start[j];
        if (stated && (mirror_image(measurement, found[j]) - *stated).norm() < (found[j] - *stated).norm()) {
            nearer.push_back(j);
        }
    }
    return nearer;
}

std::string axial_name(const RotaryTableMeasurement& measurement) {
    return {1, "xyz"[axial_coordinate(measurement.axis)]};
}

/// Error motions that have the other sign in the mirror image.
std::string mirrored_motions(const RotaryTableMeasurement& measurement) {
    const std::array<std::string, 6> motions = error_motion_names(measurement.axis);
    const auto along = static_cast<std::size_t>(axial_coordinate(measurement.axis));
    std::string names = motions[along];
    for (std::size_t k = 0; k < 3; ++k) {
        names += k == along ? "" : ", " + motions[3 + k];
    }
    return names;
}

/// "; found elsewhere than stated, too: P2, P3" behind what is said of the first one.
std::string others_elsewhere(const RotaryTableMeasurement& measurement, const std::vector<std::size_t>& off) {
    std::string others;
    for (std::size_t k = 1; k < off.size(); ++k) {
        others += (k == 1 ? "; found elsewhere than stated, too: " : ", ") + measurement.stations[off[k]];
    }
    return others;
}

gum::Diagnostic found_elsewhere(const RotaryTableMeasurement& measurement, const std::vector<Eigen::Vector3d>& found,
                                const std::vector<std::size_t>& off) {
    const std::size_t j = off.front();
    const std::optional<Eigen::Vector3d> offset = common_offset(measurement, found, off);
    gum::Diagnostic warning{
        "GC-GEOMETRY-0009",
        offset ? "stations" : "station " + measurement.stations[j],
        offset ? "all are found elsewhere than stated, by about the same " + in_millimetres(*offset)
               : "it is stated near " + in_millimetres(*measurement.station_start[j]) +
                     ", and the distances put it near " + in_millimetres(found[j]) + others_elsewhere(measurement, off),
        "positions are stated in the frame of the table, within 0.3 m; the result does not rest on them",
        "compare the position with the set-up, and the names of the stations in all files",
        gum::Severity::warning};
    if (fit_of_mirror_image(measurement, found) != MirrorImage::fits_worse) {
        warning.rule =
            "what is stated fits the mirror image of the table as well, which has the same distances, with the other "
            "sign of " +
            mirrored_motions(measurement);
        warning.action = "compare the positions with the set-up, above all the sign of " + axial_name(measurement) +
                         ", there and in the coordinates of the fixture, which are those of a right-handed frame";
    } else if (offset) {
        warning.action = "see where the zero of the stated positions is: it is that of the coordinates of the fixture";
    } else if (const std::optional<std::size_t> other = stated_there(measurement, found[j], off)) {
        warning.action = "it stands where " + measurement.stations[*other] +
                         " is stated: see whether their names are interchanged in the stations file, or in the lengths "
                         "and with "
                         "them the temperatures";
    }
    return warning;
}

gum::Diagnostic open_sign(const RotaryTableMeasurement& measurement) {
    return {
        "GC-GEOMETRY-0010",
        "stations",
        "no position is stated that tells the sign of " + axial_name(measurement) +
            " along the axis: it is that of the coordinates of the fixture",
        "the mirror image of a table has the same distances, with the other sign of " + mirrored_motions(measurement),
        "state the positions of the stations to some centimetres, or see that the coordinates of the fixture are "
        "those of a right-handed frame",
        gum::Severity::note};
}

}  // namespace

MirrorImage fit_of_mirror_image(const RotaryTableMeasurement& measurement, const std::vector<Eigen::Vector3d>& found) {
    std::vector<Eigen::Vector3d> images;
    for (const Eigen::Vector3d& position : found) {
        images.push_back(mirror_image(measurement, position));
    }
    const StatedFit of_found = fit_to_stated(measurement, found);
    const StatedFit of_images = fit_to_stated(measurement, images);
    const auto stated = static_cast<std::size_t>(
        std::ranges::count_if(measurement.station_start, [](const auto& start) { return start.has_value(); }));
    const auto are_most = [&](std::size_t count) { return 2 * count > stated; };
    const bool by_names = are_most(of_images.own) && of_images.own > of_found.own;
    const bool by_places = are_most(of_images.anyone) && of_images.anyone > of_found.anyone && !are_most(of_found.own);
    const bool together = of_images.sum < 0.5 * of_found.sum && of_found.sum - of_images.sum > k_elsewhere;
    if (by_names || by_places || together) {
        return MirrorImage::fits_better;
    }
    return of_images.sum > of_found.sum + k_near ? MirrorImage::fits_worse : MirrorImage::fits_as_well;
}

std::vector<gum::Diagnostic> stated_position_notes(const RotaryTableMeasurement& measurement,
                                                   const std::vector<Eigen::Vector3d>& found) {
    std::vector<gum::Diagnostic> notes;
    std::vector<std::size_t> off;
    bool tells_sign = false;
    for (std::size_t j = 0; j < found.size(); ++j) {
        if (const std::optional<Eigen::Vector3d>& stated = measurement.station_start[j]) {
            const double distance = (found[j] - *stated).norm();
            if (distance > k_elsewhere) {
                off.push_back(j);
            }
            // What is stated tells it, and not where the station is found: it may be stated in the plane of the origin.
            tells_sign = tells_sign || (mirror_image(measurement, found[j]) - *stated).norm() > distance + k_near;
        }
    }
    const bool tells_the_other = fit_of_mirror_image(measurement, found) == MirrorImage::fits_better;
    if (off.empty() && tells_the_other) {
        off = nearer_to_image(measurement, found);
    }
    // What is told is told of the first one: one whose name is interchanged, where there is such a station.
    const auto interchanged =
        std::ranges::find_if(off, [&](std::size_t j) { return stated_there(measurement, found[j], off).has_value(); });
    if (interchanged != off.end()) {
        std::rotate(off.begin(), interchanged, interchanged + 1);
    }
    if (!off.empty()) {
        notes.push_back(found_elsewhere(measurement, found, off));
    }
    if (!tells_sign && (off.empty() || !tells_the_other)) {
        notes.push_back(open_sign(measurement));
    }
    return notes;
}

}  // namespace gumcert::engine
