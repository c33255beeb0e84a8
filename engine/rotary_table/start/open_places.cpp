#include "engine/rotary_table/start/open_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "engine/rotary_table/geometry_check.h"
#include "engine/rotary_table/start/candidate_places.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/millimetres_text.h"
#include "engine/rotary_table/start/rival_places.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

constexpr double k_cone_singular_ratio = 1e-6;  // that of SolverOptions::rank_tolerance, as singular values

/// A direction n with n·u the same for every reflector and angle of a dead path: nothing tells how far along n the
/// station stands.
void refuse_open_direction(const ObservedStations& observed, const CommonFit& found, std::size_t j) {
    const RotaryTableMeasurement& measurement = observed.measurement();
    if (measurement.station_start[j]) {
        return;  // the rank of the adjustment decides
    }
    const StationDistances& data = observed.stations()[j];
    const std::vector<Eigen::Vector3d> points = observed.positions(j, found.set_up, false).point;
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const std::vector<Eigen::Index>& members : data.members) {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        const auto direction = [&](Eigen::Index i) -> Eigen::Vector3d {
            return (points[static_cast<std::size_t>(i)] - found.stations[j].position).normalized();
        };
        for (const Eigen::Index i : members) {
            mean += direction(i) / static_cast<double>(members.size());
        }
        for (const Eigen::Index i : members) {
            const Eigen::Vector3d centred = direction(i) - mean;
            scatter += centred * centred.transpose() / static_cast<double>(data.point.size());
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
    // Eigenvalues of a scatter are squares of singular values.
    if (eigen.eigenvalues()[0] > k_cone_singular_ratio * k_cone_singular_ratio) {
        return;
    }
    RankReport report;
    report.deficient = true;
    for (const char coordinate : {'x', 'y', 'z'}) {
        if (std::abs(eigen.eigenvectors().col(0)[coordinate - 'x']) > 0.05) {
            report.parameters.push_back("station " + measurement.stations[j] + ", " + coordinate);
        }
    }
    for (const std::size_t path : data.path_name) {
        report.parameters.push_back("dead path " + measurement.dead_paths[path]);
    }
    // How far along the line the station stands is open, so the message cannot tell from where it sees the
    // reflectors; but its distance from a line along the axis is known.
    gum::Diagnostic diagnostic = undetermined(measurement, report);
    const int axial = axial_coordinate(measurement.axis);
    if (std::abs(eigen.eigenvectors().col(0)[axial]) > 0.9999) {
        const double off = std::hypot(found.stations[j].position[observed.across()[0]],
                                      found.stations[j].position[observed.across()[1]]);
        diagnostic.what = "stands " + millimetres(off, 1) + " mm off the rotary axis; " + diagnostic.what;
    }
    throw gum::NoResultError(std::move(diagnostic));
}

double stated_distance(const RotaryTableMeasurement& measurement, std::size_t j, const StationFit& fit) {
    return (fit.position - *measurement.station_start[j]).norm();
}

bool is_rival(const StationFit& found, const StationFit& rival) {
    // Twice as large a misfit is no better explanation; and two places a centimetre apart are one.
    return rival.misfit < k_rival_factor * found.misfit + 1e-9 &&
           (rival.position - found.position).norm() > k_rival_distance;
}

std::vector<Eigen::Vector3d> places_of(const CommonFit& fit) {
    std::vector<Eigen::Vector3d> places;
    for (const StationFit& station : fit.stations) {
        places.push_back(station.position);
    }
    return places;
}

constexpr const char* k_plane_across =
    "reflectors in one plane across the axis stay in it as the table turns: the mirror image of a station sees "
    "the same distances";

[[noreturn]] void refuse_sides(const RotaryTableMeasurement& measurement, const std::vector<StationFit>& fits,
                               const std::vector<std::size_t>& open, const std::vector<Eigen::Vector3d>& image,
                               const std::string& rule) {
    const std::size_t j = open.front();
    const std::string axis(1, "xyz"[axial_coordinate(measurement.axis)]);
    throw gum::NoResultError(gum::Diagnostic{
        "GC-RANK-0001", "station " + measurement.stations[j],
        "its distances fit a position near " + in_millimetres(fits[j].position) + " and one near " +
            in_millimetres(image[j]) + " alike" + others_alike(measurement, open),
        rule,
        "state on which side the station stands, with its position to some centimetres in the stations file, or "
        "raise alternate holders by 50 mm along " +
            axis,
        gum::Severity::error});
}

/// All reflectors in one plane across the axis: every station has a mirror image that sees the same distances.
/// Stated positions tell the sides apart; without them there is no result.
void settle_mirror_images(const ObservedStations& observed, CommonFit& found) {
    const RotaryTableMeasurement& measurement = observed.measurement();
    const std::vector<StationDistances>& stations = observed.stations();
    std::vector<StationFit>& fits = found.stations;
    std::vector<std::size_t> open;
    std::vector<Eigen::Vector3d> image(stations.size());
    for (std::size_t j = 0; j < stations.size(); ++j) {
        const std::vector<Eigen::Vector3d> points = observed.positions(j, found.set_up, false).point;
        image[j] = mirror_image(points, fits[j].position);
        if (is_hopeless(stations[j], points, image[j], fits[j].misfit)) {
            continue;
        }
        const StationFit rival = refined(observed, j, image[j], found.set_up, false);
        if (!is_rival(fits[j], rival)) {
            continue;
        }
        image[j] = rival.position;
        if (!measurement.station_start[j]) {
            open.push_back(j);
        } else if (stated_distance(measurement, j, rival) < stated_distance(measurement, j, fits[j])) {
            fits[j] = rival;
        }
    }
    if (!open.empty()) {
        refuse_sides(measurement, fits, open, image, k_plane_across);
    }
    // All at once: a tilt of the fixture against the axis holds the stations together on one side.
    const int axial = axial_coordinate(measurement.axis);
    double height = 0.0;
    double count = 0.0;
    for (const StationDistances& data : stations) {
        for (const Eigen::Vector3d& point : data.point) {
            height += point[axial];
            count += 1.0;
        }
    }
    std::vector<StationFit> rivals = fits;
    Eigen::Vector4d set_up = found.set_up;
    // The mirror image of a tilt of the fixture is the tilt to the other side.
    set_up.tail<2>() *= -1.0;
    for (std::size_t j = 0; j < stations.size(); ++j) {
        rivals[j].position[axial] = 2.0 * height / count - rivals[j].position[axial];
        if (is_hopeless(stations[j], observed.positions(j, set_up, false).point, rivals[j].position, fits[j].misfit)) {
            return;
        }
        open.push_back(j);
    }
    descend(observed, open, set_up, rivals, true);
    bool stated = false;
    double nearer = 0.0;
    for (std::size_t j = 0; j < stations.size(); ++j) {
        if (!is_rival(fits[j], rivals[j])) {
            return;
        }
        image[j] = rivals[j].position;
        if (measurement.station_start[j]) {
            stated = true;
            nearer += stated_distance(measurement, j, fits[j]) - stated_distance(measurement, j, rivals[j]);
        }
    }
    if (!stated) {
        refuse_sides(measurement, fits, open, image, k_plane_across);
    }
    if (nearer > 0.0) {
        fits = rivals;
        found.set_up = set_up;
    }
}

/// Two set-ups that have the same distances, of which settle_mirror_images() sees none: its descent begins with the tilt of the
/// fixture to the other side, and not with that of the plane of the reflectors.
void settle_mirrored_table(const ObservedStations& observed, CommonFit& found) {
    if (!has_mirrored_table(observed, found.set_up)) {
        return;
    }
    std::optional<CommonFit> mirrored = mirrored_table(observed, found);
    if (!mirrored) {
        return;
    }
    const std::vector<Eigen::Vector3d> here = places_of(found);
    const std::vector<Eigen::Vector3d> there = places_of(*mirrored);
    const std::optional<double> nearer = nearer_to_stated(observed.measurement(), here, there);
    if (!nearer) {
        refuse_either(observed.measurement(), here, there, RivalTable::same_distances);
    }
    if (*nearer > 0.0) {
        found = *std::move(mirrored);
    }
}

/// \param open  places of which some seem to be open
/// \return nothing where there is no one set of places within reach that fits as well
std::optional<CommonFit> settled_within_reach(const ObservedStations& observed, const CommonFit& open) {
    CommonFit within = fit_within_reach(observed);
    for (std::size_t j = 0; j < open.stations.size(); ++j) {
        // A place that fits as error motions let it fit, or as well as the one that is open. What fits no place is no table.
        const double most = std::max(k_good_misfit, k_rival_factor * open.stations[j].misfit);
        if (within.stations[j].misfit > std::min(k_wrong_labels, most)) {
            return std::nullopt;
        }
    }
    if (has_other_side(observed, within)) {
        return std::nullopt;
    }
    try {
        settle_open_places(observed, within);
    } catch (const gum::NoResultError&) {
        return std::nullopt;
    }
    return within;
}

}  // namespace

std::optional<double> nearer_to_stated(const RotaryTableMeasurement& measurement,
                                       const std::vector<Eigen::Vector3d>& found,
                                       const std::vector<Eigen::Vector3d>& other) {
    constexpr double k_told_apart = 0.1;  // [m], by positions that are stated to some centimetres
    double nearer = 0.0;
    bool told_apart = false;
    for (std::size_t j = 0; j < found.size(); ++j) {
        if (const std::optional<Eigen::Vector3d>& stated = measurement.station_start[j]) {
            nearer += (found[j] - *stated).norm() - (other[j] - *stated).norm();
            told_apart = told_apart || (found[j] - other[j]).norm() > k_told_apart;
        }
    }
    return told_apart ? std::optional<double>(nearer) : std::nullopt;
}

std::string others_alike(const RotaryTableMeasurement& measurement, const std::vector<std::size_t>& stations) {
    std::string others;
    for (std::size_t k = 1; k < stations.size(); ++k) {
        others += (k == 1 ? "; the same holds for " : ", ") + measurement.stations[stations[k]];
    }
    return others;
}

void refuse_either(const RotaryTableMeasurement& measurement, const std::vector<Eigen::Vector3d>& found,
                   const std::vector<Eigen::Vector3d>& other, RivalTable rival) {
    std::vector<StationFit> fits(found.size());
    std::vector<std::size_t> open;
    for (std::size_t j = 0; j < found.size(); ++j) {
        fits[j].position = found[j];
        if ((found[j] - other[j]).norm() > k_rival_distance) {
            open.push_back(j);
        }
    }
    if (open.empty()) {
        open.push_back(0);  // only the set-ups differ
    }
    if (rival == RivalTable::same_distances) {
        refuse_sides(measurement, fits, open, other,
                     "reflectors in one plane near the one across the axis: with the fixture inclined to the other "
                     "side their mirror image has the same distances");
    }
    if (rival == RivalTable::nearly_mirrored) {
        refuse_sides(measurement, fits, open, other,
                     "reflectors nearly in one plane near the one across the axis: with the fixture inclined to the "
                     "other side their mirror image has nearly the same distances");
    }
    if (rival == RivalTable::fitting_badly) {
        refuse_sides(measurement, fits, open, other,
                     "of two tables that the distances fit alike badly neither is a result, and no search found one "
                     "that they fit well");
    }
    refuse_sides(measurement, fits, open, other, "of two tables that the distances fit alike neither is a result");
}

void settle_open_places(const ObservedStations& observed, CommonFit& found) {
    for (std::size_t j = 0; j < found.stations.size(); ++j) {
        refuse_open_direction(observed, found, j);
    }
    settle_mirror_images(observed, found);
    settle_mirrored_table(observed, found);
}

CommonFit settled_places(const ObservedStations& observed, const std::vector<StationFit>& alone) {
    CommonFit found = fit_together(observed, alone);
    try {
        settle_open_places(observed, found);
        return found;
    } catch (const gum::NoResultError&) {
        if (std::optional<CommonFit> within = settled_within_reach(observed, found)) {
            return *std::move(within);
        }
        throw;
    }
}

}  // namespace gumcert::engine
