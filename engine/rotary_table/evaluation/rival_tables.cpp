#include "engine/rotary_table/evaluation/rival_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/median.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/evaluation/stated_positions.h"
#include "engine/rotary_table/start/millimetres_text.h"
#include "engine/rotary_table/start/open_places.h"
#include "engine/rotary_table/start/rival_places.h"
#include "engine/rotary_table/start/start_values.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

constexpr double k_doubtful = 10.0;    // cost for a degree of freedom
constexpr double k_no_table = 1000.0;  // the same: no table that is calibrated repeats that badly
constexpr double k_clearly = 20.0;     // of costs, where noise is as stated
constexpr double k_few = 100.0;        // degrees of freedom
constexpr int k_refinements_of_few = 100;
constexpr double k_far_larger = 5.0;  // error motions

/// How well a table fits.
struct Fit {
    std::vector<double> visits;  ///< squares of the whitened residuals, one a visit
    double known = 0.0;          ///< squares of what is known beforehand
    double unit = 1.0;  ///< variance of the noise against the stated one, by the median of the visits; 1 at least

    /// Σ s² log(1 + r²/s²) over the residuals r of the visits, and squares of what is known beforehand.
    /// \param of_noise  variance that s² is in units of: with a stated one that is far too small each visit would count as gross
    ///                  error, and hardly any table as clearly better
    [[nodiscard]] double cost(double of_noise) const {
        const double squared = k_robust_scale * k_robust_scale * of_noise;
        double sum = known;
        for (const double squares : visits) {
            sum += squared * std::log1p(squares / squared);
        }
        return sum;
    }
};

/// By how much one fits worse, in units of the smaller noise that either leaves.
double worse_by(const Fit& one, const Fit& other) {
    const double noise = std::min(one.unit, other.unit);
    return (one.cost(noise) - other.cost(noise)) / noise;
}

/// With the noise that is left and with the stated one: where these disagree neither is better.
bool is_better(const Fit& one, const Fit& other, double by) {
    return worse_by(other, one) > by && one.cost(1.0) < other.cost(1.0);
}

/// Whether an adjustment that begins there may end elsewhere.
bool begins_elsewhere(const CommonFit& one, const CommonFit& other) {
    constexpr double k_same_place = 1e-3;   // [m]
    constexpr double k_same_set_up = 1e-3;  // [m] and [rad]
    for (std::size_t j = 0; j < one.stations.size(); ++j) {
        if (!((one.stations[j].position - other.stations[j].position).norm() < k_same_place)) {
            return true;
        }
    }
    return !((one.set_up - other.set_up).norm() < k_same_set_up);
}

Fit fit_at(const JointAdjustment& adjustment, double degrees_of_freedom) {
    const NormalEquations normal = adjustment.adjustment().linearise();
    Fit fit;
    std::vector<double> of_visits;
    for (std::size_t g = 0; g < normal.groups().size(); ++g) {
        const Eigen::VectorXd& residual = normal.groups()[g].residual;
        const double squares = residual.squaredNorm();
        if (g >= adjustment.visits().size()) {
            fit.known += squares;
            continue;
        }
        fit.visits.push_back(squares);
        if (residual.size() > 0) {
            of_visits.push_back(squares / static_cast<double>(residual.size()));
        }
    }
    if (!of_visits.empty()) {
        fit.unit = std::max(
            1.0, upper_median(of_visits) * static_cast<double>(normal.observation_count()) / degrees_of_freedom);
    }
    return fit;
}

/// In the frame of the fixture at home, which they share whatever T_s is held.
std::vector<Eigen::Vector3d> stations_of(const PlacedAdjustment& placed) {
    const RigidMotion fixture_from_table = placed.set_up.inverse();
    std::vector<Eigen::Vector3d> stations = placed.adjustment.present_values().stations;
    for (Eigen::Vector3d& station : stations) {
        station = fixture_from_table * station;
    }
    return stations;
}

/// What an adjustment says of the table.
struct TableFound {
    RigidMotion set_up;  ///< of the fixture
    double inclination =
        4.0;  ///< of the fixture against the axis, [rad]; that of no table where it is beyond what is evaluated
    double errors = std::numeric_limits<
        double>::infinity();  ///< by which the table carries the fixture astray, root mean square, [m]
};

TableFound table_of(const RotaryTableMeasurement& measurement, const PlacedAdjustment& placed) {
    try {
        const JointAdjustment& adjustment = placed.adjustment;
        const DatumSolution datum =
            transform_to_datum(measurement, adjustment.poses(), adjustment.set_up(), measurement.datum);
        const RigidMotion set_up = rigid_motion(datum.set_up);
        double squares = 0.0;
        for (Eigen::Index i = 0; i < datum.errors.cols(); ++i) {
            const RigidMotion error = rigid_motion(datum.errors.col(i));
            for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
                const Eigen::Vector3d point = nominal_rotation(measurement, static_cast<std::size_t>(i)) *
                                              (set_up * measurement.fixture.row(m).transpose());
                squares += (error * point - point).squaredNorm();
            }
        }
        return {set_up, inclination(measurement.axis, set_up),
                std::sqrt(squares / static_cast<double>(datum.errors.cols() * measurement.fixture.rows()))};
    } catch (const gum::NoResultError&) {
        return {placed.start.set_up};
    }
}

/// Where positions are stated: in the frame of the table.
std::vector<Eigen::Vector3d> stations_in_table(const PlacedAdjustment& placed, const TableFound& table) {
    std::vector<Eigen::Vector3d> stations = stations_of(placed);
    for (Eigen::Vector3d& station : stations) {
        station = table.set_up * station;
    }
    return stations;
}

/// Another place of a station, or another set-up: stations near the plane of a mirror image hardly move.
bool is_elsewhere(const PlacedAdjustment& one, const TableFound& table, const PlacedAdjustment& other,
                  const TableFound& other_table) {
    constexpr double k_same_offset = 1e-3;  // [m]
    constexpr double k_same_tilt = 0.01;    // [rad]
    return stands_elsewhere(stations_in_table(one, table), stations_in_table(other, other_table)) ||
           (table.set_up.rotation - other_table.set_up.rotation).norm() > k_same_tilt ||
           (table.set_up.translation - other_table.set_up.translation).norm() > k_same_offset;
}

/// The stations that stand clearly farther from their stated positions there than here.
std::vector<std::size_t> stations_off_stated(const RotaryTableMeasurement& measurement,
                                             const std::vector<Eigen::Vector3d>& there,
                                             const std::vector<Eigen::Vector3d>& here) {
    constexpr double k_clearly_farther = 0.1;  // [m]: positions are stated to some centimetres
    std::vector<std::size_t> farther;
    for (std::size_t j = 0; j < here.size(); ++j) {
        const std::optional<Eigen::Vector3d>& stated = measurement.station_start[j];
        if (stated && (there[j] - *stated).norm() > (here[j] - *stated).norm() + k_clearly_farther) {
            farther.push_back(j);
        }
    }
    return farther;
}

/// \param stations  whose stated positions the distances refute
/// \param better    where they all stand then
[[noreturn]] void refuse_stated(const RotaryTableMeasurement& measurement, const std::vector<std::size_t>& stations,
                                const std::vector<Eigen::Vector3d>& better) {
    const std::size_t j = stations.front();
    throw gum::NoResultError(gum::Diagnostic{
        "GC-ADJUST-0016", "station " + measurement.stations[j],
        "it is stated near " + in_millimetres(measurement.station_start[j].value_or(Eigen::Vector3d::Zero())) +
            ", and the distances fit clearly better with it near " + in_millimetres(better[j]) +
            others_alike(measurement, stations),
        "stated positions decide between tables that the distances fit alike, and never against the distances",
        "compare the position with the set-up, above all its signs, and correct it in the stations file, or leave it "
        "out",
        gum::Severity::error});
}

/// Distances do not tell a fixture from the one whose coordinates along the axis have the other sign: the mirror image of the
/// whole table has the same ones, with error motions that are those of no table. Stated stations whose positions fit the mirror image
/// clearly better than where they are found have that sign, or the fixture has it.
/// \throws gum::NoResultError  GC-ADJUST-0018
void refuse_mirrored_frame(const RotaryTableMeasurement& measurement, const std::vector<Eigen::Vector3d>& found) {
    constexpr double k_far = 0.3;  // [m]: what is nearer to the plane of the origin is on no side
    const int axial = axial_coordinate(measurement.axis);
    std::vector<std::size_t> off;
    for (std::size_t j = 0; j < found.size(); ++j) {
        const std::optional<Eigen::Vector3d>& stated = measurement.station_start[j];
        Eigen::Vector3d image = found[j];
        image[axial] = -image[axial];
        if (stated && (found[j] - *stated).norm() > std::max(k_far, (image - *stated).norm())) {
            off.push_back(j);
        }
    }
    if (off.empty() || fit_of_mirror_image(measurement, found) != MirrorImage::fits_better) {
        return;
    }
    const std::size_t j = off.front();
    const std::string axis(1, "xyz"[axial]);
    throw gum::NoResultError(gum::Diagnostic{
        "GC-ADJUST-0018", "station " + measurement.stations[j],
        "it is stated near " + in_millimetres(measurement.station_start[j].value_or(Eigen::Vector3d::Zero())) +
            ", and the distances fit with it near " + in_millimetres(found[j]) + ", where " + axis +
            " has the other sign" + others_alike(measurement, off),
        "the mirror image of a table has the same distances: what is stated of the stations and of the fixture agrees "
        "on the sign along the axis",
        "compare the sign of " + axis +
            " in the coordinates of the fixture, which are those of a right-handed frame, and in the stations file, "
            "and "
            "correct the one that is wrong",
        gum::Severity::error});
}

/// The best one of the tables that were adjusted, and the others.
class Rivals {
public:
    Rivals(const ObservedStations& observed, const std::vector<bool>& active, const StochasticModel& stochastic,
           const SolverOptions& solver, double degrees_of_freedom, PlacedAdjustment& best)
        : observed_(observed),
          measurement_(observed.measurement()),
          active_(active),
          stochastic_(stochastic),
          solver_(solver),
          degrees_of_freedom_(degrees_of_freedom),
          best_(best) {}

    /// More is left than noise and a table that repeats well leave.
    [[nodiscard]] bool in_doubt() const { return !(best_.summary.chi_square <= k_doubtful * degrees_of_freedom_); }
    /// More than any table leaves.
    [[nodiscard]] bool fits_no_table() const { return !(best_.summary.chi_square <= k_no_table * degrees_of_freedom_); }

    void consider(CommonFit places, RivalTable kind) {
        consider(placed_adjustment(observed_, active_, std::move(places), stochastic_,
                                   best_.adjustment.adjustment().workers()),
                 kind);
    }

    /// \param rival  not solved
    void consider(PlacedAdjustment rival, RivalTable kind) {
        if (inclination(measurement_.axis, rival.start.set_up) > k_largest_inclination ||
            rival.adjustment.adjustment().linearise().rank(solver_.rank_tolerance).deficient) {
            return;
        }
        rival.summary = rival.adjustment.adjustment().solve(solver_);
        if (!fit_) {
            fit_ = fit_of(best_, best_table());
        }
        // Of a table that repeats badly every search finds the same places: a robust adjustment takes longer than they do.
        TableFound table = table_of(measurement_, rival);
        if (!begins_elsewhere(rival.places, best_.places) && !is_elsewhere(best_, best_table(), rival, table)) {
            return;
        }
        const Fit rival_fit = fit_of(rival, table);
        const bool is_another = is_elsewhere(best_, best_table(), rival, table) &&
                                table.inclination <= std::max(k_small_inclination, best_table().inclination);
        if (!stations_off_stated(measurement_, stations_in_table(rival, table), stations_in_table(best_, best_table()))
                 .empty()) {
            // The other side of what has the same distances may be where it is stated.
            std::optional<CommonFit> mirrored = mirrored_table(observed_, rival.places);
            if (mirrored && kind != RivalTable::nearly_mirrored) {
                consider(*std::move(mirrored), RivalTable::nearly_mirrored);
            }
            if (is_another && is_better(rival_fit, *fit_, k_clearly)) {
                against_stated_.push_back({std::move(rival), rival_fit, table, kind});
            }
            return;
        }
        if (!is_another) {
            return;
        }
        const bool better = is_better(rival_fit, *fit_, 0.0);
        others_.push_back({std::move(rival), rival_fit, table, kind});
        if (better) {
            take(others_.back());
        }
    }

    /// \throws gum::NoResultError  GC-RANK-0001 where another one fits as well, and no position is stated; GC-ADJUST-0016 where
    ///                             another one fits clearly better, and stated positions speak against it
    void decide() {
        for (const Other& other : against_stated_) {
            const std::vector<Eigen::Vector3d> there = stations_in_table(other.placed, other.table);
            const std::vector<std::size_t> stations =
                stations_off_stated(measurement_, there, stations_in_table(best_, best_table()));
            if (!stations.empty() && is_better(other.fit, *fit_, k_clearly)) {
                refuse_stated(measurement_, stations, there);
            }
        }
        // Error motions decide first: those of a false place are no matter of some centimetres, as stated positions are. Whatever
        // lies a decimetre farther from a stated position is not among the others (consider()); of two within it, and of all where
        // none is stated, the one with far smaller error motions is taken, also between mirror images, at any number of distances.
        for (Other& other : others_) {
            if (fits_alike(other) && best_table().errors > k_far_larger * other.table.errors) {
                take(other);
            }
        }
        for (Other& other : others_) {
            if (!fits_alike(other) || other.table.errors > k_far_larger * best_table().errors) {
                continue;
            }
            const std::vector<Eigen::Vector3d> here = stations_in_table(best_, best_table());
            const std::vector<Eigen::Vector3d> there = stations_in_table(other.placed, other.table);
            const std::optional<double> nearer = nearer_to_stated(measurement_, here, there);
            if (!nearer) {
                refuse_either(measurement_, here, there, fits_no_table() ? RivalTable::fitting_badly : other.kind);
            }
            if (*nearer > 0.0) {
                take(other);
            }
        }
    }

private:
    struct Other {
        PlacedAdjustment placed;
        Fit fit;
        TableFound table;
        RivalTable kind;
    };

    [[nodiscard]] TableFound& best_table() {
        if (!best_table_) {
            best_table_ = table_of(measurement_, best_);
        }
        return *best_table_;
    }

    /// Once there is another one.
    void take(Other& other) {
        (void)best_table();
        std::swap(best_, other.placed);
        std::swap(*fit_, other.fit);
        std::swap(*best_table_, other.table);
    }

    [[nodiscard]] bool fits_alike(const Other& other) {
        // What is no number fits nothing.
        return std::isfinite(other.fit.cost(1.0)) && !is_better(*fit_, other.fit, k_clearly) &&
               is_elsewhere(best_, best_table(), other.placed, other.table);
    }

    /// Of a solved adjustment; where much is left, of a robust one as well: gross errors have carried the former away, or it has
    /// left the place of its start for a worse one.
    /// \param placed, table  become what the robust one leads to, where that is better
    [[nodiscard]] Fit fit_of(PlacedAdjustment& placed, TableFound& table) const {
        const Fit fit = fit_at(placed.adjustment, degrees_of_freedom_);
        if (fit.cost(1.0) <= k_doubtful * degrees_of_freedom_) {
            return fit;
        }
        PlacedAdjustment robust = placed;
        robust.adjustment = adjustment_from_start(measurement_, active_, placed.set_up, placed.start, stochastic_);
        robust.adjustment.adjustment().set_workers(placed.adjustment.adjustment().workers());
        SolverOptions solver = solver_;
        solver.robust_scale = k_robust_scale;
        (void)robust.adjustment.adjustment().solve(solver);
        const Fit without_errors = fit_at(robust.adjustment, degrees_of_freedom_);
        if (!(worse_by(without_errors, fit) < 0.0)) {
            return fit;
        }
        if (is_elsewhere(placed, table, robust, table_of(measurement_, robust))) {
            robust.summary = robust.adjustment.adjustment().solve(solver_);
            if (robust.summary.chi_square < placed.summary.chi_square) {
                placed = std::move(robust);
                table = table_of(measurement_, placed);
                const Fit there = fit_at(placed.adjustment, degrees_of_freedom_);
                if (worse_by(there, without_errors) < 0.0) {
                    return there;
                }
            }
        }
        return without_errors;
    }

    const ObservedStations& observed_;
    const RotaryTableMeasurement& measurement_;
    const std::vector<bool>& active_;
    const StochasticModel& stochastic_;
    const SolverOptions& solver_;
    double degrees_of_freedom_;
    PlacedAdjustment& best_;
    std::optional<Fit> fit_;                // of the best one, once there is another one
    std::optional<TableFound> best_table_;  // once it was asked for
    std::vector<Other> others_;
    std::vector<Other> against_stated_;  // that fit clearly better
};

}  // namespace

JointAdjustment adjustment_from_start(const RotaryTableMeasurement& measurement, const std::vector<bool>& active,
                                      const RigidMotion& set_up, const StartValues& start,
                                      const StochasticModel& stochastic) {
    JointAdjustment adjustment(measurement, active, set_up, start, stochastic);
    adjustment.turn_about(start.set_up);
    adjustment.set_weights(stochastic);
    return adjustment;
}

PlacedAdjustment placed_adjustment(const ObservedStations& observed, const std::vector<bool>& active, CommonFit places,
                                   const StochasticModel& stochastic, const Workers& workers) {
    const RotaryTableMeasurement& measurement = observed.measurement();
    StartValues start = start_values_of(observed, places);
    // Error motions about another axis would be large turns: of an inclined fixture the adjustment starts upright.
    RigidMotion set_up;
    if (inclination(measurement.axis, start.set_up) > k_small_inclination) {
        set_up = start.set_up;
        for (Eigen::Vector3d& station : start.stations) {
            station = set_up * station;
        }
    }
    JointAdjustment adjustment = adjustment_from_start(measurement, active, set_up, start, stochastic);
    adjustment.adjustment().set_workers(workers);
    return {std::move(places), set_up, std::move(start), std::move(adjustment)};
}

void settle_rival_tables(const ObservedStations& observed, const std::vector<bool>& active,
                         const StochasticModel& stochastic, const SolverOptions& solver, double degrees_of_freedom,
                         PlacedAdjustment& placed) {
    // Few distances more than unknowns fit false places as well: what fits says little then, and each is followed to its end.
    const bool are_few = degrees_of_freedom < k_few;
    SolverOptions to_end = solver;
    if (are_few) {
        to_end.max_refinements = std::max(k_refinements_of_few, solver.max_refinements);
        if (!placed.summary.converged) {
            placed.summary = placed.adjustment.adjustment().solve(to_end);
        }
    }
    Rivals rivals(observed, active, stochastic, to_end, std::max(1.0, degrees_of_freedom), placed);
    if (are_few || rivals.in_doubt()) {
        const CommonFit found = placed.places;
        const CommonFit within = fit_within_reach(observed);
        rivals.consider(within, RivalTable::with_other_places);
        for (const CommonFit* const from : {&within, &found}) {
            if (are_few || rivals.in_doubt()) {
                rivals.consider(fit_by_turns(observed, *from), RivalTable::with_other_places);
            }
        }
        for (const CommonFit* const from : {&within, &found}) {
            for (const bool known : {true, false}) {
                if (are_few || rivals.fits_no_table()) {
                    rivals.consider(fit_by_turns(observed, fit_on_other_side(observed, *from, known)),
                                    RivalTable::with_other_places);
                }
            }
        }
    }
    if (are_few) {
        // From an axis that nobody has, error motions go a way of their own.
        PlacedAdjustment upright = placed;
        upright.adjustment = JointAdjustment(observed.measurement(), active, placed.set_up, placed.start, stochastic);
        upright.adjustment.adjustment().set_workers(placed.adjustment.adjustment().workers());
        rivals.consider(std::move(upright), RivalTable::with_other_places);
    }
    if (std::optional<CommonFit> mirrored = mirrored_table(observed, placed.places)) {
        rivals.consider(*std::move(mirrored), RivalTable::nearly_mirrored);
    }
    rivals.decide();
    refuse_mirrored_frame(observed.measurement(), stations_of(placed));
}

}  // namespace gumcert::engine
