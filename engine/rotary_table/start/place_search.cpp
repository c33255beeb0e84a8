#include "engine/rotary_table/start/place_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "engine/rotary_table/start/candidate_places.h"
#include "engine/rotary_table/start/closed_solution.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

constexpr std::size_t k_of_grid = 8;  // places from which a descent is worth its time

/// The better one of what was found, and of what is found.
class BestFit {
public:
    /// \param stated  the position that the measurement states of the station
    explicit BestFit(const std::optional<Eigen::Vector3d>& stated) : stated_(stated) {}

    [[nodiscard]] const StationFit& best() const { return best_; }

    void consider(const StationFit& fit) {
        // Few distances fit an overturned fixture as well as one that stands upright, which is what it is then.
        constexpr double k_as_well = 3.0;
        constexpr double k_alike = 5.0 * gum::k_micrometre;
        if (std::isfinite(best_.misfit) && fit.is_settled() != best_.is_settled()) {
            const StationFit& upright = fit.is_settled() ? fit : best_;
            const StationFit& other = fit.is_settled() ? best_ : fit;
            best_ = StationFit(upright.misfit < k_as_well * other.misfit + k_alike ? upright : other);
            return;
        }
        const bool nearer = stated_ && (fit.position - *stated_).norm() < (best_.position - *stated_).norm();
        // Of two that explain the distances alike, the stated position tells the sides apart.
        if (fit.misfit * (nearer ? 1.0 / k_rival_factor : (stated_ ? k_rival_factor : 1.0)) < best_.misfit) {
            best_ = fit;
        }
    }

private:
    const std::optional<Eigen::Vector3d>& stated_;
    StationFit best_;
};

}  // namespace

StationFit PlaceSearch::fit_of(std::size_t station, bool closely) const {
    const Eigen::Vector4d none = Eigen::Vector4d::Zero();
    const StationDistances& data = distances(station);
    const std::vector<Eigen::Vector3d> points = observed_.positions(station, none, false).point;
    const std::optional<Eigen::Vector3d>& stated = observed_.measurement().station_start[station];
    BestFit found(stated);
    const StationFit& best = found.best();
    const auto consider = [&](const Eigen::Vector3d& from) {
        if (from.allFinite()) {
            found.consider(refined(observed_, station, from, none, true));
        }
    };
    if (stated) {
        consider(*stated);
    }
    const ClosedSolution closed = closed_solution(data, points);
    if (closed.determined) {
        consider(closed.position);
    }
    const auto consider_while_open = [&](const std::vector<Eigen::Vector3d>& candidates) {
        for (const Eigen::Vector3d& from : candidates) {
            if (best.misfit > k_good_misfit) {
                consider(from);
            }
        }
    };
    if (best.misfit > k_good_misfit) {
        // The line that the linear form leaves open: κ and l0 are not free of each other, the misfit tells.
        constexpr std::size_t k_of_line = 4;
        consider_while_open(best_of(data, points, open_line(closed), k_of_line));
    }
    if (best.misfit > k_good_misfit || !is_hopeless(data, points, mirror_image(points, best.position), best.misfit)) {
        consider(mirror_image(points, best.position));
    }
    if (best.misfit > k_good_misfit) {
        consider_while_open(best_of(data, points, sphere_grid(closed.centre), k_of_grid));
    }
    // Seen from near the axis or from afar, reflectors on dead paths of their own have a narrow valley, in which the
    // descents above stop half way. Plain least squares goes down to its end.
    for (const Eigen::Vector3d& from : all_sides(closed.centre)) {
        if (closely && !best.is_settled()) {
            found.consider(refined(observed_, station, from, none, true, Pull::of_all));
        }
    }
    return best;
}

std::vector<StationFit> PlaceSearch::fit_each() const {
    std::vector<StationFit> fits;
    for (std::size_t j = 0; j < observed_.stations().size(); ++j) {
        fits.push_back(fit_of(j, true));
    }
    return fits;
}

StationFit PlaceSearch::fit_near(std::size_t station, const StationFit& from) const {
    return refined(observed_, station, from.position, from.set_up, true);
}

StationFit PlaceSearch::fit_from_all_sides(std::size_t station, const StationFit& found) const {
    const Eigen::Vector4d none = Eigen::Vector4d::Zero();
    StationFit best = found;
    const StationDistances& data = distances(station);
    const std::vector<Eigen::Vector3d> points = observed_.positions(station, none, false).point;
    const Eigen::Vector3d centre = closed_solution(data, points).centre;
    std::vector<Eigen::Vector3d> starts = all_sides(centre);
    std::ranges::copy(best_of(data, points, sphere_grid(centre), k_of_grid), std::back_inserter(starts));
    starts.push_back(found.position);
    for (const Eigen::Vector3d& from : starts) {
        for (const Pull pull : {Pull::of_all, Pull::of_those_that_agree}) {
            const StationFit fit = refined(observed_, station, from, none, true, pull);
            best = fit.upright_misfit() < best.upright_misfit() ? fit : best;
        }
    }
    return best;
}

std::vector<StationFit> PlaceSearch::plain_fits(std::size_t station, const StationFit& found) const {
    const Eigen::Vector4d none = Eigen::Vector4d::Zero();
    std::vector<StationFit> result;
    const std::vector<Eigen::Vector3d> points = observed_.positions(station, none, false).point;
    std::vector<Eigen::Vector3d> starts = all_sides(closed_solution(distances(station), points).centre);
    starts.push_back(found.position);
    for (const Eigen::Vector3d& from : starts) {
        std::vector<StationFit> fits(observed_.stations().size());
        fits[station].position = from;
        Eigen::Vector4d set_up = none;
        descend(observed_, {station}, set_up, fits, true, k_coarse_step, Pull::of_all);
        fits[station].set_up = set_up;
        result.push_back(fits[station]);
    }
    return result;
}

}  // namespace gumcert::engine
