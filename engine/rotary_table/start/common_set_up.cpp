#include "engine/rotary_table/start/common_set_up.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/rotary_table/start/candidate_places.h"
#include "engine/rotary_table/start/closed_solution.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

/// True when the place of a station was changed.
bool choose_again(const ObservedStations& observed, CommonFit& found) {
    bool changed = false;
    std::vector<StationFit>& fits = found.stations;
    for (std::size_t j = 0; j < fits.size(); ++j) {
        const StationDistances& data = observed.stations()[j];
        const std::vector<Eigen::Vector3d> points = observed.positions(j, found.set_up, false).point;
        std::vector<Eigen::Vector3d> others;
        if (const Eigen::Vector3d image = mirror_image(points, fits[j].position);
            !is_hopeless(data, points, image, fits[j].misfit)) {
            others.push_back(image);
        }
        if (fits[j].misfit > k_good_misfit) {
            const ClosedSolution closed = closed_solution(data, points);
            others.push_back(closed.position);
        }
        const auto consider = [&](const StationFit& fit) {
            if (fit.misfit * k_rival_factor < fits[j].misfit) {
                fits[j] = fit;
                changed = true;
            }
        };
        for (const Eigen::Vector3d& other : others) {
            consider(refined(observed, j, other, found.set_up, false));
        }
        for (const Eigen::Vector3d& other : all_sides(closed_solution(data, points).centre)) {
            if (fits[j].misfit > k_good_misfit) {
                const StationFit fit = refined(observed, j, other, found.set_up, false, Pull::of_all);
                // Another bad place is none: the set-up may be that of an inclined fixture, which they share yet.
                if (fit.misfit <= k_good_misfit) {
                    consider(fit);
                }
            }
        }
    }
    return changed;
}

}  // namespace

CommonFit fit_together(const ObservedStations& observed, std::vector<StationFit> alone) {
    std::vector<std::size_t> all(alone.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    CommonFit found;
    found.stations = std::move(alone);
    descend(observed, all, found.set_up, found.stations, true);
    if (choose_again(observed, found)) {
        descend(observed, all, found.set_up, found.stations, true);
    }
    return found;
}

CommonFit fit_within_reach(const ObservedStations& observed) {
    constexpr int k_most_rounds = 4;
    constexpr double k_better = 0.9;  // of a misfit: less is no other place
    std::vector<std::size_t> all(observed.stations().size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    CommonFit found;
    found.stations.resize(all.size());
    // The best place of a station from all sides and on the other side of the plane of its points.
    const auto look_from_all_sides = [&](std::size_t j, bool free_set_up) {
        const std::vector<Eigen::Vector3d> points = observed.positions(j, found.set_up, false).point;
        std::vector<Eigen::Vector3d> starts = all_sides(closed_solution(observed.stations()[j], points).centre);
        if (std::isfinite(found.stations[j].misfit)) {
            starts.push_back(mirror_image(points, found.stations[j].position));
        }
        bool changed = false;
        for (const Eigen::Vector3d& from : starts) {
            const StationFit fit = refined(observed, j, from, found.set_up, free_set_up, Pull::of_all, Prior::strong);
            if (fit.misfit < k_better * found.stations[j].misfit) {
                found.stations[j] = fit;
                changed = true;
            }
        }
        return changed;
    };
    for (const std::size_t j : all) {
        look_from_all_sides(j, true);
    }
    bool changed = true;
    for (int round = 0; round < k_most_rounds && changed; ++round) {
        descend(observed, all, found.set_up, found.stations, true, k_fine_step, Pull::of_those_that_agree,
                Prior::strong);
        changed = false;
        for (const std::size_t j : all) {
            changed = look_from_all_sides(j, false) || changed;
        }
    }
    descend(observed, all, found.set_up, found.stations, true, k_fine_step, Pull::of_those_that_agree, Prior::strong);
    return found;
}

bool has_mirrored_table(const ObservedStations& observed, const Eigen::Vector4d& set_up) {
    constexpr double k_flat = 10.0 * gum::k_micrometre;  // root mean square of what stands out of the plane
    constexpr double k_upright = 10.0 * gum::k_degree;   // beyond it GC-GEOMETRY-0006 is told
    const RotaryTableMeasurement& measurement = observed.measurement();
    const Eigen::MatrixX3d centred = measurement.fixture.rowwise() - measurement.fixture.colwise().mean();
    const Eigen::Matrix3d scatter = centred.transpose() * centred / static_cast<double>(centred.rows());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
    if (eigen.eigenvalues()[0] > k_flat * k_flat) {
        return false;
    }
    const int axial = axial_coordinate(measurement.axis);
    const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
    const Eigen::Vector3d axis = observed.set_up_motion(set_up).rotation.row(axial).transpose();
    const Eigen::Vector3d mirrored = 2.0 * normal.dot(axis) * normal - axis;  // in the fixture, as the axis
    // Of two that are both inclined more than that, the more upright one is no better known.
    return mirrored[axial] > std::min(std::cos(k_upright), axis[axial]);
}

CommonFit fit_on_other_side(const ObservedStations& observed, const CommonFit& from, bool known) {
    std::vector<std::size_t> all(from.stations.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    CommonFit other;
    other.set_up = known ? from.set_up : Eigen::Vector4d(Eigen::Vector4d::Zero());
    other.stations = from.stations;
    for (const std::size_t j : all) {
        const Eigen::Vector3d image =
            mirror_image(observed.positions(j, from.set_up, false).point, from.stations[j].position);
        other.stations[j] = refined(observed, j, image, other.set_up, !known, Pull::of_all, Prior::strong);
    }
    descend(observed, all, other.set_up, other.stations, true, k_fine_step, Pull::of_all, Prior::strong);
    descend(observed, all, other.set_up, other.stations, true, k_fine_step, Pull::of_those_that_agree, Prior::strong);
    return other;
}

bool has_other_side(const ObservedStations& observed, const CommonFit& within) {
    if (has_mirrored_table(observed, within.set_up)) {
        return true;
    }
    for (const bool known : {true, false}) {
        const CommonFit other = fit_on_other_side(observed, within, known);
        double squares = 0.0;
        double squares_of_other = 0.0;
        bool elsewhere = false;
        for (std::size_t j = 0; j < within.stations.size(); ++j) {
            squares += within.stations[j].misfit * within.stations[j].misfit;
            squares_of_other += other.stations[j].misfit * other.stations[j].misfit;
            elsewhere =
                elsewhere || (other.stations[j].position - within.stations[j].position).norm() > k_rival_distance;
        }
        if (elsewhere && squares_of_other < k_rival_factor * k_rival_factor * squares) {
            return true;
        }
    }
    return false;
}

}  // namespace gumcert::engine
