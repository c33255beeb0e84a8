#include "engine/rotary_table/start/rival_places.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/rotary_table/start/candidate_places.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "gum/quantity/dense_factors.h"

namespace gumcert::engine {

CommonFit fit_by_turns(const ObservedStations& observed, CommonFit from) {
    constexpr double k_clearly_less = 0.81;  // of the squares of misfits
    std::vector<std::size_t> all(from.stations.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const auto squares = [](const CommonFit& fit) {
        double sum = 0.0;
        for (const StationFit& station : fit.stations) {
            sum += station.misfit * station.misfit;
        }
        return sum;
    };
    // No more rounds than each station has turns.
    for (std::size_t round = 0; round < all.size(); ++round) {
        CommonFit best = from;
        for (const std::size_t j : all) {
            const std::vector<Eigen::Vector3d> points = observed.positions(j, from.set_up, false).point;
            CommonFit turned = from;
            turned.stations[j] =
                refined(observed, j, mirror_image(points, from.stations[j].position), from.set_up, false, Pull::of_all);
            descend(observed, all, turned.set_up, turned.stations, true);
            if (squares(turned) < k_clearly_less * squares(best)) {
                best = std::move(turned);
            }
        }
        if (!(squares(best) < squares(from))) {
            break;
        }
        from = std::move(best);
    }
    return from;
}

bool stands_elsewhere(const std::vector<Eigen::Vector3d>& one, const std::vector<Eigen::Vector3d>& other) {
    return !std::ranges::equal(one, other, [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return (a - b).norm() < k_rival_distance;
    });
}

std::optional<CommonFit> mirrored_table(const ObservedStations& observed, const CommonFit& found) {
    const RotaryTableMeasurement& measurement = observed.measurement();
    const int axial = axial_coordinate(measurement.axis);
    const Eigen::RowVector3d centroid = measurement.fixture.colwise().mean();
    const Eigen::MatrixX3d centred = measurement.fixture.rowwise() - centroid;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Eigen::Matrix3d(centred.transpose() * centred));
    // S p = p - 2 (n·p - d) n in the plane of the reflectors, M at the plane across the axis where T_s S T_s⁻¹ M keeps its
    // place along the axis.
    const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
    const double distance = normal.dot(centroid.transpose());
    const RigidMotion set_up = observed.set_up_motion(found.set_up);
    const double height = distance * (set_up.rotation * normal)[axial];
    Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
    across(axial, axial) = -1.0;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    shift[axial] = 2.0 * height;
    RigidMotion mirrored;
    mirrored.rotation = across * set_up.rotation * (Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose());
    mirrored.translation = across * (set_up.translation + 2.0 * distance * (set_up.rotation * normal)) + shift;
    // A set-up does not turn about the axis: the frame of the table does instead.
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    constexpr int k_turns = 20;
    for (int k = 0; k < k_turns; ++k) {
        const double angle = angles_zyx(turn * mirrored.rotation)[axial];
        turn = axis_rotation(axial, -angle) * turn;
    }
    const Eigen::Matrix<double, 6, 1> parameters =
        motion_parameters(RigidMotion{turn * mirrored.rotation, turn * mirrored.translation});
    CommonFit result = found;
    for (std::size_t c = 0; c < 2; ++c) {
        result.set_up[static_cast<Eigen::Index>(c)] = parameters[observed.across()[c]];
        result.set_up[static_cast<Eigen::Index>(2 + c)] = parameters[3 + observed.across()[c]];
    }
    for (std::size_t j = 0; j < result.stations.size(); ++j) {
        StationFit& fit = result.stations[j];
        fit.position = turn * (across * fit.position + shift);
        fit.misfit = misfit_of(observed.stations()[j], observed.deviations(j, result.set_up, fit.position).each);
        if (!(fit.misfit < std::max(k_wrong_labels, k_rival_factor * found.stations[j].misfit))) {
            return std::nullopt;
        }
    }
    return result;
}

}  // namespace gumcert::engine
