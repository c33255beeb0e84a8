#include "engine/rotary_table/start/start_values.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "engine/degrees_text.h"
#include "engine/median.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/geometry_check.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/golden_section.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Set-up errors are of millimetres and a degree at most; this prior only keeps what a short turn leaves open near zero.
constexpr double k_set_up_offset = 5.0 * gum::k_millimetre;
constexpr double k_set_up_tilt = gum::k_degree;
constexpr double k_typical_deviation = gum::k_micrometre;  // against which the prior is weighed
// With the set-up found, what remains is the error motions: micrometres. A station above this needs a closer search.
constexpr double k_good_misfit = 0.1 * gum::k_millimetre;
constexpr double k_trimmed_share = 0.85;  // of the deviations that the misfit looks at
constexpr double k_mad_to_deviation = 1.4826;
constexpr double k_rival_factor = 2.0;     // a rival with less than this times the misfit explains as much
constexpr double k_rival_distance = 0.01;  // [m]
// Steps at which a descent ends, [m] and [rad]: of one station, to choose among candidates, and of the start values.
constexpr double k_coarse_step = 1e-4;
constexpr double k_fine_step = 1e-6;
// A mirror image that is this far off before any refinement cannot be brought to explain the distances.
constexpr double k_hopeless_misfit = 2.0 * gum::k_millimetre;
constexpr double k_hopeless_factor = 20.0;
constexpr double k_cone_singular_ratio = 1e-6;  // that of SolverOptions::rank_tolerance, as singular values
constexpr double k_linear_eigenvalue_ratio = 1e-10;
// What a rigid body leaves of the distances of a station: error motions and set-up errors. Labels that are wrong leave
// centimetres; with the right ones next to nothing of that is left.
constexpr double k_wrong_labels = 1.0 * gum::k_millimetre;
constexpr double k_share_with_right_labels = 0.05;
// A station that fits this much worse than its neighbours is not what error motions of their table leave; and what no
// error motion of a sound one is.
constexpr double k_worse_than_others = 10.0;
constexpr double k_least_suspicious = 0.02 * gum::k_millimetre;
// And what no wrong label leaves less of: where a station fits better, a layout that determines nothing fits other labels, too.
constexpr double k_least_of_labels = 0.005 * gum::k_millimetre;
// Distances beyond the unknowns that a cause takes: fewer agree with any cause.
constexpr std::ptrdiff_t k_least_redundancy = 6;
// Position and set-up of one station.
constexpr std::ptrdiff_t k_unknowns_of_station = 7;
// Of distances that a cause explains in a part of the visits: gross errors may be among them.
constexpr double k_share_of_part = 0.85;

/// The lengths of one station, free of names.
struct StationData {
    std::vector<std::size_t> observation;  // index into the lengths
    std::vector<std::size_t> angle;
    std::vector<std::size_t> path;       // numbered within the station
    std::vector<Eigen::Vector3d> point;  // in the fixture frame, at the temperature of the station
    Eigen::VectorXd length;
    std::vector<std::size_t> path_name;              // index of each path into the dead paths of the measurement
    std::vector<std::vector<Eigen::Index>> members;  // of each path
};

/// Positions of the points of a station with a set-up, and their derivatives with respect to it.
struct Positions {
    std::vector<Eigen::Vector3d> point;
    std::vector<Matrix34> by_set_up;
};

struct StationFit {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double misfit = std::numeric_limits<double>::infinity();
    Eigen::Vector4d set_up = Eigen::Vector4d::Zero();  ///< with which the station was found

    /// Misfit with a fixture that stands as fixtures stand: a table that turns the other way looks like one whose axis
    /// is turned over.
    [[nodiscard]] double upright_misfit() const {
        constexpr double k_overturned = 0.5;  // [rad]
        constexpr double k_hopeless = 1.0;    // [m]
        return set_up.tail<2>().norm() > k_overturned ? k_hopeless : misfit;
    }
    /// Nothing better has to be looked for: it stands upright and leaves what error motions do.
    [[nodiscard]] bool is_settled() const { return upright_misfit() <= k_good_misfit; }
};

/// Which distances a descent follows.
enum class Pull {
    of_those_that_agree,  ///< weights of Cauchy's function: gross errors have none
    of_all,               ///< plain least squares, before the one with weights
};

/// All that is needed of a measurement, and the robust descent.
class StartSearch {
public:
    StartSearch(const RotaryTableMeasurement& measurement, const std::vector<bool>& active)
        : measurement_(measurement), across_(across_axis(measurement.axis)), stations_(measurement.stations.size()) {
        for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
            turn_.push_back(nominal_rotation(measurement, i));
        }
        std::vector<std::vector<double>> lengths(stations_.size());
        for (std::size_t i = 0; i < measurement.lengths.size(); ++i) {
            if (!active.empty() && !active[i]) {
                continue;
            }
            const LengthObservation& length = measurement.lengths[i];
            StationData& data = stations_[length.station];
            // Stations look at the fixture at temperatures of their own.
            const double stretch =
                1.0 +
                measurement.expansion * measurement.temperature_difference[static_cast<Eigen::Index>(length.station)];
            auto found = std::find(data.path_name.begin(), data.path_name.end(), length.dead_path);
            if (found == data.path_name.end()) {
                found = data.path_name.insert(found, length.dead_path);
                data.members.emplace_back();
            }
            const auto path = static_cast<std::size_t>(found - data.path_name.begin());
            data.members[path].push_back(static_cast<Eigen::Index>(data.observation.size()));
            data.path.push_back(path);
            data.observation.push_back(i);
            data.angle.push_back(length.angle);
            data.point.emplace_back(stretch *
                                    measurement.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose());
            lengths[length.station].push_back(length.length);
        }
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            stations_[j].length =
                Eigen::Map<const Eigen::VectorXd>(lengths[j].data(), static_cast<Eigen::Index>(lengths[j].size()));
        }
    }

    /// Set-up, stations and their misfits.
    /// \throws gum::NoResultError
    void run() {
        fit_each();
        finish();
    }

    /// All stations together, from each on its own.
    void finish() {
        std::vector<std::size_t> all(stations_.size());
        for (std::size_t j = 0; j < all.size(); ++j) {
            all[j] = j;
        }
        descend(all, set_up_, fits_, true);
        if (choose_again()) {
            descend(all, set_up_, fits_, true);
        }
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            refuse_open_direction(j);
        }
        settle_mirror_images();
    }

    [[nodiscard]] StartValues values() const {
        StartValues start;
        start.dead_paths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(measurement_.dead_paths.size()));
        // JointAdjustment starts with T_s = 1: its table frame is the fixture frame at home.
        start.set_up = set_up_motion(set_up_);
        const RigidMotion fixture_from_table = start.set_up.inverse();
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            start.stations.emplace_back(fixture_from_table * fits_[j].position);
            const Eigen::VectorXd centres = deviations(j, set_up_, fits_[j].position).second;
            for (std::size_t d = 0; d < stations_[j].path_name.size(); ++d) {
                start.dead_paths[static_cast<Eigen::Index>(stations_[j].path_name[d])] =
                    centres[static_cast<Eigen::Index>(d)];
            }
        }
        return start;
    }

    /// Each station on its own.
    /// \return their misfits, [m]
    std::vector<double> fit_each() {
        std::vector<double> misfits;
        fits_.resize(stations_.size());
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            fits_[j] = fit_alone(j, true);
            misfits.push_back(fits_[j].upright_misfit());
        }
        return misfits;
    }
    /// The station that fits its distances worst, each on its own, where it is worse than error motions let any fit.
    [[nodiscard]] std::optional<gum::Diagnostic> no_rigid_table() const {
        std::size_t worst = 0;
        for (std::size_t j = 1; j < fits_.size(); ++j) {
            worst = fits_[j].misfit > fits_[worst].misfit ? j : worst;
        }
        if (fits_.empty() || !(fits_[worst].misfit > k_wrong_labels)) {
            return std::nullopt;
        }
        return gum::Diagnostic{
            "GC-ADJUST-0015",
            "station " + measurement_.stations[worst],
            "its distances fit no rigid table that turns by the stated angles: from the place that fits best they "
            "differ by " +
                millimetres(fits_[worst].misfit, 1) + " mm (root mean square without the largest)",
            "what a place of the station leaves are error motions, far below a millimetre",
            "compare units and signs of distances, angles and fixture, and the names of reflectors and stations, with "
            "the "
            "protocol of the measurement",
            gum::Severity::error};
    }
    /// One station on its own.
    /// \param closely  down narrow valleys too
    [[nodiscard]] StationFit fit_of(std::size_t station, bool closely) const { return fit_alone(station, closely); }
    /// One station on its own, from where it was found with nearly the same distances.
    [[nodiscard]] StationFit fit_near(std::size_t station, const StationFit& from) const {
        return refined(station, from.position, from.set_up, true);
    }
    /// Whether a station has distances enough to tell one cause from another.
    [[nodiscard]] bool tells_causes(std::size_t station) const {
        return redundancy(stations_[station]) >= k_least_redundancy;
    }

    /// Deviations of a station with a fit of its own, and the medians of its dead paths.
    [[nodiscard]] std::pair<Eigen::VectorXd, Eigen::VectorXd> deviations(std::size_t j, const StationFit& fit) const {
        return deviations(j, fit.set_up, fit.position);
    }

    [[nodiscard]] const std::vector<StationData>& stations() const { return stations_; }
    /// Places of a station by plain least squares of all its distances, from all sides and from where it was found: what
    /// weights have left out is in.
    [[nodiscard]] std::vector<StationFit> plain_fits(std::size_t station, const StationFit& found) const {
        std::vector<StationFit> result;
        const Positions at = positions(station, Eigen::Vector4d::Zero(), false);
        std::vector<Eigen::Vector3d> starts = all_sides(closed_solution(stations_[station], at).centre);
        starts.push_back(found.position);
        for (const Eigen::Vector3d& from : starts) {
            std::vector<StationFit> fits(stations_.size());
            fits[station].position = from;
            Eigen::Vector4d set_up = Eigen::Vector4d::Zero();
            descend({station}, set_up, fits, true, k_coarse_step, Pull::of_all);
            fits[station].set_up = set_up;
            result.push_back(fits[station]);
        }
        return result;
    }
    /// One station on its own, the best from all sides and from where it was found.
    [[nodiscard]] StationFit fit_from_all_sides(std::size_t station, const StationFit& found) const {
        StationFit best = found;
        const Positions at = positions(station, Eigen::Vector4d::Zero(), false);
        std::vector<Eigen::Vector3d> starts = all_sides(closed_solution(stations_[station], at).centre);
        std::ranges::copy(
            best_of(stations_[station], at, sphere_grid(closed_solution(stations_[station], at).centre), 8),
            std::back_inserter(starts));
        starts.push_back(found.position);
        for (const Eigen::Vector3d& from : starts) {
            for (const Pull pull : {Pull::of_all, Pull::of_those_that_agree}) {
                const StationFit fit = refined(station, from, Eigen::Vector4d::Zero(), true, pull);
                best = fit.upright_misfit() < best.upright_misfit() ? fit : best;
            }
        }
        return best;
    }
    /// Stations as fit_each() has found them.
    [[nodiscard]] const std::vector<StationFit>& fits() const { return fits_; }
    /// Deviations from the medians of the dead paths, and these medians.
    [[nodiscard]] std::pair<Eigen::VectorXd, Eigen::VectorXd> deviations(std::size_t j) const {
        return deviations(j, set_up_, fits_[j].position);
    }

private:
    [[nodiscard]] RigidMotion set_up_motion(const Eigen::Vector4d& set_up) const {
        Vector6 parameters = Vector6::Zero();
        for (std::size_t c = 0; c < 2; ++c) {
            parameters[across_[c]] = set_up[static_cast<Eigen::Index>(c)];
            parameters[3 + across_[c]] = set_up[static_cast<Eigen::Index>(2 + c)];
        }
        return rigid_motion(parameters);
    }

    [[nodiscard]] Positions positions(std::size_t j, const Eigen::Vector4d& set_up, bool derivatives) const {
        const RigidMotion motion = set_up_motion(set_up);
        Eigen::Vector3d tilt = Eigen::Vector3d::Zero();
        tilt[across_[0]] = set_up[2];
        tilt[across_[1]] = set_up[3];
        const std::array<Eigen::Matrix3d, 3> by_tilt = rotation_zyx_derivatives(tilt);
        const StationData& data = stations_[j];
        Positions result;
        result.point.reserve(data.point.size());
        for (std::size_t i = 0; i < data.point.size(); ++i) {
            const Eigen::Matrix3d& turn = turn_[data.angle[i]];
            result.point.emplace_back(turn * (motion * data.point[i]));
            if (derivatives) {
                Matrix34 by_set_up;
                by_set_up << turn.col(across_[0]), turn.col(across_[1]),
                    turn * (by_tilt[static_cast<std::size_t>(across_[0])] * data.point[i]),
                    turn * (by_tilt[static_cast<std::size_t>(across_[1])] * data.point[i]);
                result.by_set_up.push_back(by_set_up);
            }
        }
        return result;
    }

    /// |P - q| - l less its median of every dead path, and the medians: the dead paths.
    [[nodiscard]] static std::pair<Eigen::VectorXd, Eigen::VectorXd> deviations(const StationData& data,
                                                                                const Positions& at,
                                                                                const Eigen::Vector3d& station) {
        Eigen::VectorXd deviation(data.length.size());
        for (Eigen::Index i = 0; i < deviation.size(); ++i) {
            deviation[i] = (at.point[static_cast<std::size_t>(i)] - station).norm() - data.length[i];
        }
        // The constant of a dead path moves all its lengths alike: their median takes it out, and single wrong lengths
        // do not move that.
        Eigen::VectorXd centre(static_cast<Eigen::Index>(data.members.size()));
        std::vector<double> values;
        for (std::size_t d = 0; d < data.members.size(); ++d) {
            values.clear();
            for (const Eigen::Index i : data.members[d]) {
                values.push_back(deviation[i]);
            }
            const double middle = median(values);
            centre[static_cast<Eigen::Index>(d)] = middle;
            for (const Eigen::Index i : data.members[d]) {
                deviation[i] -= middle;
            }
        }
        return {deviation, centre};
    }

    [[nodiscard]] std::pair<Eigen::VectorXd, Eigen::VectorXd> deviations(std::size_t j, const Eigen::Vector4d& set_up,
                                                                         const Eigen::Vector3d& station) const {
        return deviations(stations_[j], positions(j, set_up, false), station);
    }

    /// Absolute deviations of the dead paths that have more than one length: a single length always agrees.
    /// The deviation from the median of one length is 0 whatever the position: it would make a wrong one look good.
    static void collect(const StationData& data, const Eigen::VectorXd& deviation, std::vector<double>& values) {
        for (const std::vector<Eigen::Index>& members : data.members) {
            for (const Eigen::Index i : members) {
                if (members.size() > 1) {
                    values.push_back(std::abs(deviation[i]));
                }
            }
        }
    }

    /// Distances of a station beyond what its place, its set-up and its dead paths take.
    [[nodiscard]] static std::ptrdiff_t redundancy(const StationData& data) {
        std::ptrdiff_t result = -k_unknowns_of_station;
        for (const std::vector<Eigen::Index>& members : data.members) {
            result += std::ssize(members) - 1;  // a single length tells its dead path and nothing else
        }
        return result;
    }

    /// Root mean square of the smaller deviations.
    [[nodiscard]] static double misfit(const StationData& data, const Eigen::VectorXd& deviation) {
        std::vector<double> values;
        values.reserve(static_cast<std::size_t>(deviation.size()));
        collect(data, deviation, values);
        if (values.empty()) {
            return 0.0;
        }
        // Without the largest ones: gross errors in a few lengths say nothing against a position.
        const auto kept = static_cast<std::ptrdiff_t>(std::ceil(k_trimmed_share * static_cast<double>(values.size())));
        std::nth_element(values.begin(), values.begin() + kept - 1, values.end());
        double squares = 0.0;
        for (auto value = values.begin(); value != values.begin() + kept; ++value) {
            squares += *value * *value;
        }
        return std::sqrt(squares / static_cast<double>(kept));
    }

    /// Deviations with weights of Cauchy's function for the scale c, centred by their weighted means.
    struct Weighted {
        Eigen::VectorXd deviation;
        Eigen::VectorXd weight;
        double cost = 0.0;
    };

    [[nodiscard]] static Weighted weigh(const StationData& data, Eigen::VectorXd deviation, double c) {
        Weighted result;
        result.weight.resize(deviation.size());
        // Weights of Cauchy fall with the square of a deviation: a length that is wrong by a metre has no pull left.
        // Weights and weighted centres depend on each other, so that both are made three times.
        for (int round = 0; round < 3; ++round) {
            for (const std::vector<Eigen::Index>& members : data.members) {
                double sum = 0.0;
                double weights = 0.0;
                for (const Eigen::Index i : members) {
                    const double ratio = deviation[i] / c;
                    result.weight[i] = 1.0 / (1.0 + ratio * ratio);
                    sum += result.weight[i] * deviation[i];
                    weights += result.weight[i];
                }
                if (round < 2) {
                    for (const Eigen::Index i : members) {
                        deviation[i] -= sum / weights;
                    }
                }
            }
        }
        for (Eigen::Index i = 0; i < deviation.size(); ++i) {
            const double ratio = deviation[i] / c;
            result.cost += std::log1p(ratio * ratio);
        }
        result.deviation = std::move(deviation);
        return result;
    }

    /// Steps that a set-up and stations take before they are near, in units of which plain least squares are damped
    /// (Levenberg–Marquardt): damping in units of the distances leaves a narrow valley for another one.
    [[nodiscard]] static Eigen::VectorXd usual_steps(std::size_t stations) {
        Eigen::VectorXd steps = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(4 + 3 * stations), 0.1);  // [m]
        steps.head<4>() << 0.001, 0.001, 0.01, 0.01;  // [m], [m], [rad], [rad]
        return steps;
    }

    /// Robust Gauss-Newton descent (iterated reweighting, scale from the median absolute deviation, damped) of the
    /// positions of some stations and, with `free_set_up`, of the set-up that they share. Dead paths are eliminated.
    /// \param pull  of distances that are far off: of all alike, plain least squares, a descent finds its way from any
    ///              side of the points; with weights it ends where some of the distances agree by chance
    void descend(const std::vector<std::size_t>& of, Eigen::Vector4d& set_up, std::vector<StationFit>& fits,
                 bool free_set_up, double step_tolerance = k_fine_step, Pull pull = Pull::of_those_that_agree) const {
        constexpr int k_steps = 60;
        constexpr double k_most_usual_steps = 6.0;  // at once
        const bool plain = pull == Pull::of_all;
        const auto size = static_cast<Eigen::Index>(4 + 3 * of.size());
        double damping = 1e-6;
        std::vector<Positions> at(of.size());
        std::vector<Eigen::VectorXd> raw(of.size());
        std::vector<double> values;
        const auto evaluate = [&](const Eigen::Vector4d& with, const std::vector<StationFit>& where, bool derivatives) {
            for (std::size_t k = 0; k < of.size(); ++k) {
                if (free_set_up || derivatives) {
                    at[k] = positions(of[k], with, derivatives);
                }
                raw[k] = deviations(stations_[of[k]], at[k], where[of[k]].position).first;
            }
        };
        // The scale follows the deviations down: far from the solution all lengths pull, near it only those that agree.
        // At exact data it ends at a nanometre.
        const auto scale_of = [&] {
            values.clear();
            for (std::size_t k = 0; k < of.size(); ++k) {
                collect(stations_[of[k]], raw[k], values);
            }
            if (values.empty()) {
                return 1e-9;
            }
            if (plain) {
                constexpr double k_far_above_all = 1e3;
                return std::max(k_far_above_all * *std::ranges::max_element(values), 1e-6);
            }
            return std::max(2.5 * k_mad_to_deviation * median(values), 1e-9);
        };
        // Weak beside any distance: it only decides what they leave open (k_set_up_offset).
        const auto prior = [&](const Eigen::Vector4d& with, double c) {
            return std::pow(k_typical_deviation / c, 2) *
                   (with.head<2>().squaredNorm() / (k_set_up_offset * k_set_up_offset) +
                    with.tail<2>().squaredNorm() / (k_set_up_tilt * k_set_up_tilt));
        };
        Eigen::MatrixXd normal(size, size);
        Eigen::VectorXd right(size);
        std::vector<StationFit> trial = fits;
        for (int step = 0; step < k_steps; ++step) {
            evaluate(set_up, fits, true);
            const double c = scale_of();
            normal.setZero();
            right.setZero();
            double cost = prior(set_up, c);
            for (std::size_t k = 0; k < of.size(); ++k) {
                const StationData& data = stations_[of[k]];
                const Weighted weighted = weigh(data, raw[k], c);
                cost += weighted.cost;
                Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> rows(weighted.deviation.size(), 7);
                for (Eigen::Index i = 0; i < rows.rows(); ++i) {
                    const auto index = static_cast<std::size_t>(i);
                    const Eigen::Vector3d direction = (at[k].point[index] - fits[of[k]].position).normalized();
                    rows.row(i).head<4>() = direction.transpose() * at[k].by_set_up[index];
                    rows.row(i).tail<3>() = -direction.transpose();
                }
                // A dead path is eliminated by taking off the weighted means of its rows, as its constant was taken off
                // the deviations.
                for (const std::vector<Eigen::Index>& members : data.members) {
                    Eigen::Matrix<double, 1, 7> mean = Eigen::Matrix<double, 1, 7>::Zero();
                    double weights = 0.0;
                    for (const Eigen::Index i : members) {
                        mean += weighted.weight[i] * rows.row(i);
                        weights += weighted.weight[i];
                    }
                    mean /= weights;
                    for (const Eigen::Index i : members) {
                        rows.row(i) -= mean;
                    }
                }
                const auto from = static_cast<Eigen::Index>(4 + 3 * k);
                const Eigen::Matrix<double, 7, 7> part =
                    rows.transpose() * weighted.weight.asDiagonal() * rows / (c * c);
                const Eigen::Matrix<double, 7, 1> gradient =
                    rows.transpose() * weighted.weight.cwiseProduct(weighted.deviation) / (c * c);
                normal.topLeftCorner<4, 4>() += part.topLeftCorner<4, 4>();
                normal.block<3, 3>(from, from) = part.bottomRightCorner<3, 3>();
                normal.block<3, 4>(from, 0) = part.bottomLeftCorner<3, 4>();
                normal.block<4, 3>(0, from) = part.topRightCorner<4, 3>();
                right.head<4>() -= gradient.head<4>();
                right.segment<3>(from) = -gradient.tail<3>();
            }
            for (Eigen::Index z = 0; z < 4; ++z) {
                const double width = z < 2 ? k_set_up_offset : k_set_up_tilt;
                const double weight = std::pow(k_typical_deviation / (c * width), 2);
                normal(z, z) += weight;
                right[z] -= weight * set_up[z];
                // Rows and columns of a held set-up become those of the identity: the system keeps its size.
                if (!free_set_up) {
                    normal.row(z).setZero();
                    normal.col(z).setZero();
                    normal(z, z) = 1.0;
                    right[z] = 0.0;
                }
            }
            const Eigen::VectorXd scale =
                plain
                    ? usual_steps(of.size())
                    : normal.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse().eval();
            const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
            const double unit = plain ? scaled.trace() : 1.0;
            bool better = false;
            double largest = 0.0;
            while (damping < 1e8) {
                Eigen::MatrixXd damped = scaled;
                damped.diagonal().array() += damping * unit;
                const Eigen::VectorXd change = scale.asDiagonal() * damped.ldlt().solve(scale.asDiagonal() * right);
                const Eigen::Vector4d next = set_up + change.head<4>();
                largest = change.cwiseAbs().maxCoeff();
                for (std::size_t k = 0; k < of.size(); ++k) {
                    trial[of[k]].position =
                        fits[of[k]].position + change.segment<3>(static_cast<Eigen::Index>(4 + 3 * k));
                }
                double after = std::numeric_limits<double>::infinity();
                // A step of many metres or radians leads nowhere: it is damped before anything is evaluated.
                if (change.allFinite() && largest < 5.0 &&
                    (!plain || change.cwiseQuotient(scale).norm() < k_most_usual_steps)) {
                    evaluate(next, trial, false);
                    after = prior(next, c);
                    for (std::size_t k = 0; k < of.size(); ++k) {
                        after += weigh(stations_[of[k]], raw[k], c).cost;
                    }
                }
                // At exact data the cost is rounding, and rounding must not look like a step in the wrong direction.
                if (after <= cost * (1.0 + 1e-9)) {
                    better = true;
                    set_up = next;
                    for (const std::size_t j : of) {
                        fits[j].position = trial[j].position;
                    }
                    damping = std::max(0.1 * damping, 1e-12);
                    break;
                }
                damping = std::max(10.0 * damping, 1e-9);
            }
            if (!better || largest < step_tolerance) {
                break;
            }
        }
        for (const std::size_t j : of) {
            fits[j].misfit = misfit(stations_[j], deviations(j, set_up, fits[j].position).first);
        }
    }

    /// One station with a set-up of its own.
    [[nodiscard]] StationFit refined(std::size_t j, const Eigen::Vector3d& from, const Eigen::Vector4d& set_up,
                                     bool free_set_up, Pull pull = Pull::of_those_that_agree) const {
        std::vector<StationFit> fits(stations_.size());
        fits[j].position = from;
        Eigen::Vector4d own = set_up;
        const double tolerance = free_set_up ? k_coarse_step : k_fine_step;
        if (pull == Pull::of_all) {
            descend({j}, own, fits, free_set_up, tolerance, Pull::of_all);
        }
        descend({j}, own, fits, free_set_up, tolerance);
        fits[j].set_up = own;
        return fits[j];
    }

    /// Closed solution: |P|² - 2 P·q + |q|² = l² + 2 l l0 + l0² is linear in q, l0 and κ = |q|² - l0², one l0 and κ a
    /// dead path. Both are eliminated; q is found in the directions that are determined.
    // It needs no start and no operator, and comes within a millimetre of usual stations (design note rotary-table.md,
    // 4c).
    struct ClosedSolution {
        Eigen::Vector3d position = Eigen::Vector3d::Zero();
        Eigen::Vector3d open = Eigen::Vector3d::UnitX();   // least determined direction
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of the points
        bool determined = false;
    };

    [[nodiscard]] ClosedSolution closed_solution(const StationData& data, const Positions& at) const {
        ClosedSolution result;
        for (const Eigen::Vector3d& point : at.point) {
            result.centre += point / static_cast<double>(at.point.size());
        }
        Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
        // l0 and κ are two unknowns of each dead path: fewer than three lengths say nothing of the position.
        for (const std::vector<Eigen::Index>& members : data.members) {
            if (members.size() < 3) {
                continue;
            }
            const auto n = static_cast<Eigen::Index>(members.size());
            Eigen::MatrixXd rows(n, 5);
            for (Eigen::Index k = 0; k < n; ++k) {
                const Eigen::Index i = members[static_cast<std::size_t>(k)];
                const Eigen::Vector3d point = at.point[static_cast<std::size_t>(i)] - result.centre;
                rows.row(k) << -2.0 * point.transpose(), data.length[i] * data.length[i] - point.squaredNorm(),
                    data.length[i];
            }
            // κ is a constant of the dead path: means are taken off. l0 is the factor of l: what is proportional to l
            // is taken off. What is left is linear in q.
            rows.rowwise() -= rows.colwise().mean().eval();
            const double squares = rows.col(4).squaredNorm();
            if (squares > 0.0) {
                const Eigen::RowVector4d share = rows.col(4).transpose() * rows.leftCols<4>() / squares;
                rows.leftCols<4>() -= rows.col(4) * share;
            }
            normal += rows.leftCols<4>().transpose() * rows.leftCols<4>();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal.topLeftCorner<3, 3>());
        const Eigen::Vector3d values = eigen.eigenvalues();
        result.open = eigen.eigenvectors().col(0);
        result.determined = values[0] > k_linear_eigenvalue_ratio * values[2] && values[2] > 0.0;
        result.position = result.centre;
        // In a direction that the rows do not determine the solution stays in the middle of the points, and `open`
        // tells which one it is.
        for (int k = 0; k < 3; ++k) {
            if (values[k] > k_linear_eigenvalue_ratio * values[2]) {
                const Eigen::Vector3d direction = eigen.eigenvectors().col(k);
                result.position += direction * (direction.dot(normal.topRightCorner<3, 1>()) / values[k]);
            }
        }
        return result;
    }

    /// The side of `position` and its mirror image in the plane closest to the points.
    [[nodiscard]] static Eigen::Vector3d mirror_image(const Positions& at, const Eigen::Vector3d& position) {
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (const Eigen::Vector3d& point : at.point) {
            centre += point / static_cast<double>(at.point.size());
        }
        // The plane in which the points nearly lie: distances hardly change when a station is reflected in it.
        Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
        for (const Eigen::Vector3d& point : at.point) {
            scatter += (point - centre) * (point - centre).transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
        const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
        return position - 2.0 * normal.dot(position - centre) * normal;
    }

    /// Positions on a grid, best first, that no neighbour in the list comes close to.
    [[nodiscard]] static std::vector<Eigen::Vector3d> best_of(const StationData& data, const Positions& at,
                                                              const std::vector<Eigen::Vector3d>& grid,
                                                              std::size_t count) {
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t k = 0; k < grid.size(); ++k) {
            order.emplace_back(misfit(data, deviations(data, at, grid[k]).first), k);
        }
        std::sort(order.begin(), order.end());
        std::vector<Eigen::Vector3d> best;
        for (const auto& [value, k] : order) {
            const Eigen::Vector3d& position = grid[k];
            if (best.size() < count && std::all_of(best.begin(), best.end(), [&](const Eigen::Vector3d& other) {
                    return (other - position).norm() > 0.2;
                })) {
                best.push_back(position);
            }
        }
        return best;
    }

    [[nodiscard]] StationFit fit_alone(std::size_t j, bool closely) const {
        const StationData& data = stations_[j];
        const Eigen::Vector4d none = Eigen::Vector4d::Zero();
        const Positions at = positions(j, none, false);
        const std::optional<Eigen::Vector3d>& stated = measurement_.station_start[j];
        StationFit best;
        const auto consider_fit = [&](const StationFit& fit) {
            // Few distances fit an overturned fixture as well as one that stands upright, which is what it is then.
            constexpr double k_as_well = 3.0;
            constexpr double k_alike = 5.0 * gum::k_micrometre;
            if (std::isfinite(best.misfit) && fit.is_settled() != best.is_settled()) {
                const StationFit& upright = fit.is_settled() ? fit : best;
                const StationFit& other = fit.is_settled() ? best : fit;
                best = upright.misfit < k_as_well * other.misfit + k_alike ? upright : other;
                return;
            }
            const bool nearer = stated && (fit.position - *stated).norm() < (best.position - *stated).norm();
            // Of two that explain the distances alike, the stated position tells the sides apart.
            if (fit.misfit * (nearer ? 1.0 / k_rival_factor : (stated ? k_rival_factor : 1.0)) < best.misfit) {
                best = fit;
            }
        };
        const auto consider = [&](const Eigen::Vector3d& from) {
            if (from.allFinite()) {
                consider_fit(refined(j, from, none, true));
            }
        };
        if (stated) {
            consider(*stated);
        }
        const ClosedSolution closed = closed_solution(data, at);
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
            std::vector<Eigen::Vector3d> line;
            // Three metres to either side in steps of an eighth: a descent finds the station from a tenth of a metre
            // off (design note rotary-table.md, 4c).
            for (int k = -24; k <= 24; ++k) {
                line.emplace_back(closed.position -
                                  closed.open * (closed.open.dot(closed.position - closed.centre) - 0.125 * k));
            }
            consider_while_open(best_of(data, at, line, 4));
        }
        if (best.misfit > k_good_misfit || !is_hopeless(data, at, mirror_image(at, best.position), best.misfit)) {
            consider(mirror_image(at, best.position));
        }
        if (best.misfit > k_good_misfit) {
            consider_while_open(best_of(data, at, sphere_grid(closed.centre), 8));
        }
        // Seen from near the axis or from afar, reflectors on dead paths of their own have a narrow valley, in which the
        // descents above stop half way. Plain least squares goes down to its end.
        for (const Eigen::Vector3d& from : all_sides(closed.centre)) {
            if (closely && !best.is_settled()) {
                consider_fit(refined(j, from, none, true, Pull::of_all));
            }
        }
        return best;
    }

    /// On all six sides of the points. How far off matters little: from 0.6 m and from 1.5 m the same were found.
    [[nodiscard]] static std::vector<Eigen::Vector3d> all_sides(const Eigen::Vector3d& centre) {
        constexpr double k_distance = 1.0;  // [m]
        std::vector<Eigen::Vector3d> result;
        for (int c = 0; c < 3; ++c) {
            for (const double side : {1.0, -1.0}) {
                result.emplace_back(centre + side * k_distance * Eigen::Vector3d::Unit(c));
            }
        }
        return result;
    }

    [[nodiscard]] static bool is_hopeless(const StationData& data, const Positions& at, const Eigen::Vector3d& position,
                                          double reached) {
        return misfit(data, deviations(data, at, position).first) >
               std::max(k_hopeless_misfit, k_hopeless_factor * reached);
    }

    /// Directions all round in near equal parts (golden-angle spiral), at distances that stations have.
    [[nodiscard]] static std::vector<Eigen::Vector3d> sphere_grid(const Eigen::Vector3d& centre) {
        constexpr int k_directions = 60;
        std::vector<Eigen::Vector3d> grid;
        // From one to the next by a factor of 1.6 to 2: no station is far from one of them.
        for (const double distance : {0.3, 0.6, 1.0, 1.6, 2.6, 4.2}) {
            for (int k = 0; k < k_directions; ++k) {
                const double z = 1.0 - (2.0 * k + 1.0) / k_directions;
                const double azimuth = std::numbers::pi * (3.0 - std::sqrt(5.0)) * k;
                const double r = std::sqrt(1.0 - z * z);
                grid.emplace_back(centre + distance * Eigen::Vector3d(r * std::cos(azimuth), r * std::sin(azimuth), z));
            }
        }
        return grid;
    }

    /// With one set-up for all, a station on the wrong side stands out. True when one was changed.
    [[nodiscard]] bool choose_again() {
        bool changed = false;
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            const Positions at = positions(j, set_up_, false);
            std::vector<Eigen::Vector3d> others;
            if (const Eigen::Vector3d image = mirror_image(at, fits_[j].position);
                !is_hopeless(stations_[j], at, image, fits_[j].misfit)) {
                others.push_back(image);
            }
            if (fits_[j].misfit > k_good_misfit) {
                const ClosedSolution closed = closed_solution(stations_[j], at);
                others.push_back(closed.position);
            }
            const auto consider = [&](const StationFit& fit) {
                if (fit.misfit * k_rival_factor < fits_[j].misfit) {
                    fits_[j] = fit;
                    changed = true;
                }
            };
            for (const Eigen::Vector3d& other : others) {
                consider(refined(j, other, set_up_, false));
            }
            for (const Eigen::Vector3d& other : all_sides(closed_solution(stations_[j], at).centre)) {
                if (fits_[j].misfit > k_good_misfit) {
                    const StationFit fit = refined(j, other, set_up_, false, Pull::of_all);
                    // Another bad place is none: the set-up may be that of an inclined fixture, which they share yet.
                    if (fit.misfit <= k_good_misfit) {
                        consider(fit);
                    }
                }
            }
        }
        return changed;
    }

    /// A direction n with n·u the same for every reflector and angle of a dead path: nothing tells how far along n the
    /// station stands.
    void refuse_open_direction(std::size_t j) const {
        if (measurement_.station_start[j]) {
            return;  // the rank of the adjustment decides
        }
        const StationData& data = stations_[j];
        const Positions at = positions(j, set_up_, false);
        Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
        for (const std::vector<Eigen::Index>& members : data.members) {
            Eigen::Vector3d mean = Eigen::Vector3d::Zero();
            const auto direction = [&](Eigen::Index i) -> Eigen::Vector3d {
                return (at.point[static_cast<std::size_t>(i)] - fits_[j].position).normalized();
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
                report.parameters.push_back("station " + measurement_.stations[j] + ", " + coordinate);
            }
        }
        for (const std::size_t path : data.path_name) {
            report.parameters.push_back("dead path " + measurement_.dead_paths[path]);
        }
        // How far along the line the station stands is open, so the message cannot tell from where it sees the
        // reflectors; but its distance from a line along the axis is known.
        gum::Diagnostic diagnostic = undetermined(measurement_, report);
        const int axial = axial_coordinate(measurement_.axis);
        if (std::abs(eigen.eigenvectors().col(0)[axial]) > 0.9999) {
            const double off = std::hypot(fits_[j].position[across_[0]], fits_[j].position[across_[1]]);
            diagnostic.what = "stands " + millimetres(off, 1) + " mm off the rotary axis; " + diagnostic.what;
        }
        throw gum::NoResultError(std::move(diagnostic));
    }

    /// All reflectors in one plane across the axis: every station has a mirror image that sees the same distances.
    /// Stated positions tell the sides apart; without them there is no result.
    void settle_mirror_images() {
        std::vector<std::size_t> open;
        std::vector<Eigen::Vector3d> image(stations_.size());
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            const Positions at = positions(j, set_up_, false);
            image[j] = mirror_image(at, fits_[j].position);
            if (is_hopeless(stations_[j], at, image[j], fits_[j].misfit)) {
                continue;
            }
            const StationFit rival = refined(j, image[j], set_up_, false);
            if (!is_rival(fits_[j], rival)) {
                continue;
            }
            image[j] = rival.position;
            if (!measurement_.station_start[j]) {
                open.push_back(j);
            } else if (stated_distance(j, rival) < stated_distance(j, fits_[j])) {
                fits_[j] = rival;
            }
        }
        if (!open.empty()) {
            refuse_sides(open, image);
        }
        // All at once: a tilt of the fixture against the axis holds the stations together on one side.
        const int axial = axial_coordinate(measurement_.axis);
        double height = 0.0;
        double count = 0.0;
        for (const StationData& data : stations_) {
            for (const Eigen::Vector3d& point : data.point) {
                height += point[axial];
                count += 1.0;
            }
        }
        std::vector<StationFit> rivals = fits_;
        Eigen::Vector4d set_up = set_up_;
        // The mirror image of a tilt of the fixture is the tilt to the other side.
        set_up.tail<2>() *= -1.0;
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            rivals[j].position[axial] = 2.0 * height / count - rivals[j].position[axial];
            if (is_hopeless(stations_[j], positions(j, set_up, false), rivals[j].position, fits_[j].misfit)) {
                return;
            }
            open.push_back(j);
        }
        descend(open, set_up, rivals, true);
        bool stated = false;
        double nearer = 0.0;
        for (std::size_t j = 0; j < stations_.size(); ++j) {
            if (!is_rival(fits_[j], rivals[j])) {
                return;
            }
            image[j] = rivals[j].position;
            if (measurement_.station_start[j]) {
                stated = true;
                nearer += stated_distance(j, fits_[j]) - stated_distance(j, rivals[j]);
            }
        }
        if (!stated) {
            refuse_sides(open, image);
        }
        if (nearer > 0.0) {
            fits_ = rivals;
            set_up_ = set_up;
        }
    }

    [[nodiscard]] double stated_distance(std::size_t j, const StationFit& fit) const {
        return (fit.position - *measurement_.station_start[j]).norm();
    }

    [[nodiscard]] static bool is_rival(const StationFit& found, const StationFit& rival) {
        // Twice as large a misfit is no better explanation; and two places a centimetre apart are one.
        return rival.misfit < k_rival_factor * found.misfit + 1e-9 &&
               (rival.position - found.position).norm() > k_rival_distance;
    }

    [[nodiscard]] static std::string millimetres(double value, int decimals) {
        const double unit = std::pow(10.0, -decimals);
        value = std::round(value / gum::k_millimetre / unit) * unit;
        value = value == 0.0 ? 0.0 : value;  // no minus sign on a zero
        return text::fixed(value, decimals);
    }

    [[nodiscard]] static std::string in_millimetres(const Eigen::Vector3d& position) {
        return "(" + millimetres(position[0], 0) + ", " + millimetres(position[1], 0) + ", " +
               millimetres(position[2], 0) + ") mm";
    }

    [[noreturn]] void refuse_sides(const std::vector<std::size_t>& open,
                                   const std::vector<Eigen::Vector3d>& image) const {
        std::string others;
        for (std::size_t k = 1; k < open.size(); ++k) {
            others += (k == 1 ? "; the same holds for " : ", ") + measurement_.stations[open[k]];
        }
        const std::size_t j = open.front();
        const std::string axis(1, "xyz"[axial_coordinate(measurement_.axis)]);
        throw gum::NoResultError(gum::Diagnostic{
            "GC-RANK-0001", "station " + measurement_.stations[j],
            "its distances fit a position near " + in_millimetres(fits_[j].position) + " and one near " +
                in_millimetres(image[j]) + " alike" + others,
            "reflectors in one plane across the axis stay in it as the table turns: the mirror image of a station sees "
            "the same distances",
            "state on which side the station stands, with its position to some centimetres in the stations file, or "
            "raise alternate holders by 50 mm along " +
                axis,
            gum::Severity::error});
    }

    const RotaryTableMeasurement& measurement_;
    std::array<int, 2> across_;
    std::vector<Eigen::Matrix3d> turn_;
    std::vector<StationData> stations_;
    Eigen::Vector4d set_up_ = Eigen::Vector4d::Zero();
    std::vector<StationFit> fits_;
};

// ---- wrong labels ---------------------------------------------------------------------------------------------------

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

/// The measurement with the distances of one station as the hypothesis reads them.
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

class LabelSearch {
public:
    explicit LabelSearch(const RotaryTableMeasurement& measurement) : measurement_(measurement) {
        hypotheses_.push_back({.other_sense = true});
        // A sign, a path that is counted twice or halved; units of length; gon for degrees, ten steps for fifteen. Only a
        // ratio of lengths and fixture can be told: which of them is wrong the message leaves open.
        for (const double factor : {-1.0, 2.0, 0.5}) {
            hypotheses_.push_back({.lengths = factor});
        }
        for (const double factor : {25.4, 1.0 / 25.4, 10.0, 0.1, 1000.0, 0.001}) {
            hypotheses_.push_back({.fixture = factor});
        }
        for (const double factor : {0.9, 1.0 / 0.9, 1.5, 1.0 / 1.5, 2.0, 0.5}) {
            hypotheses_.push_back({.angles = factor});
        }
        for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
            if (axis != measurement.axis) {
                hypotheses_.push_back({.axis = axis});
            }
        }
        for (std::size_t a = 0; a < measurement.reflectors.size(); ++a) {
            for (std::size_t b = a + 1; b < measurement.reflectors.size(); ++b) {
                hypotheses_.push_back({.first = a, .second = b});
            }
        }
    }

    /// Whether a station fits its distances worse than error motions let any fit. The table is the same for all: what
    /// one of them leaves beyond ten times the median of all is no motion of it.
    /// \param limit  [m], of any table
    [[nodiscard]] static bool is_suspicious(double misfit, std::vector<double> misfits, double limit = k_good_misfit) {
        return misfit > limit || (misfit > k_least_suspicious && misfit > k_worse_than_others * median(misfits));
    }

    enum class Asked { suspicious, all };
    /// \param fits  of the stations, each on its own
    /// \param asked  all: of a measurement that has no result, for which lengths in another unit may fit a false place
    void refuse(std::vector<StationFit> fits, Asked asked) const {
        std::vector<double> misfits;
        for (const StationFit& fit : fits) {
            misfits.push_back(fit.upright_misfit());
        }
        for (std::size_t j = 0; j < misfits.size(); ++j) {
            if (fits[j].is_settled() && is_suspicious(misfits[j], misfits)) {
                // The search ended at what error motions may leave: with neighbours that leave far less it goes on.
                fits[j] = StartSearch(measurement_, of_station(j, std::nullopt)).fit_from_all_sides(j, fits[j]);
                misfits[j] = fits[j].upright_misfit();
            }
        }
        // One reflector that all stations disagree with is asked for first: it costs least.
        std::vector<std::size_t> open;
        for (std::size_t j = 0; j < misfits.size(); ++j) {
            if (is_suspicious(misfits[j], misfits)) {
                open.push_back(j);
            }
        }
        if (open.size() > 1 && 2 * open.size() > misfits.size()) {
            refuse_wrong_coordinates(open, misfits);
        }
        open.clear();
        std::vector<std::optional<LabelHypothesis>> causes(misfits.size());
        std::vector<gum::Diagnostic> problems;
        std::optional<LabelHypothesis> known;  // what one station has is likely what all have
        // All labels take a while: a rough table, whose stations are all alike, has a result and does not wait for them.
        const double limit = asked == Asked::all ? k_good_misfit : k_wrong_labels;
        for (std::size_t j = 0; j < misfits.size(); ++j) {
            const bool suspicious = is_suspicious(misfits[j], misfits, limit);
            if (suspicious || (asked == Asked::all && misfits[j] > k_least_of_labels)) {
                causes[j] = cause_of(j, misfits[j], known);
                if (!causes[j] && suspicious) {
                    causes[j] = scale_of(j, fits[j]);
                }
                // Labels of some visits are right, where they are: an interchange of two concerns few distances of the others.
                const bool of_some = causes[j] && causes[j]->first != causes[j]->second;
                if (std::optional<gum::Diagnostic> part = of_some ? cause_of_part(j, fits[j]) : std::nullopt) {
                    causes[j].reset();
                    problems.push_back(std::move(*part));
                    continue;
                }
                if (causes[j]) {
                    known = causes[j];
                    continue;
                }
            }
            // Distances that are wrong at some visits leave the station where it is, or take it along.
            if (std::optional<gum::Diagnostic> part = cause_of_part(j, fits[j])) {
                problems.push_back(std::move(*part));
            } else if (suspicious) {
                open.push_back(j);
            }
        }
        if (problems.empty() && std::ranges::none_of(causes, [](const auto& cause) { return cause.has_value(); })) {
            refuse_stray_reflector(fits, asked == Asked::all);
        }
        for (const std::size_t j : open) {
            refuse_two_places(j, misfits[j]);
        }
        const bool common =
            causes[0] && std::ranges::all_of(causes, [&](const auto& cause) { return cause == causes[0]; });
        for (std::size_t j = 0; j < causes.size() && !(common && j > 0); ++j) {
            if (causes[j]) {
                problems.push_back(diagnostic(*causes[j], common ? "" : measurement_.stations[j]));
            }
        }
        if (!problems.empty()) {
            throw gum::NoResultError(std::move(problems));
        }
    }

private:
    /// What the hypothesis leaves of the distances as they were stated: half of all lengths leaves half of any misfit.
    [[nodiscard]] double misfit_with(const LabelHypothesis& hypothesis, std::size_t station,
                                     const std::vector<bool>& active, bool closely) const {
        const RotaryTableMeasurement other = relabelled(measurement_, station, hypothesis);
        const double left =
            StartSearch(other, active).fit_of(station, closely).upright_misfit() / std::abs(hypothesis.lengths);
        if (hypothesis.fixture == 1.0) {
            return left;
        }
        // Only the ratio counts, but a place is looked for at distances that stations have: whether it is the fixture that
        // has its size or the lengths is not known.
        return std::min(left, misfit_with({.lengths = 1.0 / hypothesis.fixture}, station, active, closely));
    }

    /// The hypothesis with the smallest misfit, where that is small enough.
    /// \param known  is tried first, and is it where it leaves what a right one does
    [[nodiscard]] std::optional<LabelHypothesis> cause_of(std::size_t station, double misfit,
                                                          const std::optional<LabelHypothesis>& known) const {
        const std::vector<bool> active = of_station(station, std::nullopt);
        if (!StartSearch(measurement_, active).tells_causes(station)) {
            return std::nullopt;
        }
        // A wrong guess of labels lowers the misfit by chance, and that of a station that fits very badly a good deal. The
        // right one removes nearly all of it, and leaves what error motions do.
        double least = std::min(k_share_with_right_labels * misfit, k_good_misfit);
        if (known && misfit_with(*known, station, active, true) < least) {
            return known;
        }
        // Some visits tell the labels of all: the time does not grow with the measurement.
        const std::vector<bool> some = some_visits(active);
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
            order.emplace_back(misfit_with(hypotheses_[k], station, some, false), k);
        }
        std::ranges::sort(order);
        std::optional<LabelHypothesis> best;
        constexpr std::size_t k_looked_at_closely = 3;
        for (std::size_t k = 0; k < std::min(k_looked_at_closely, order.size()) && order[k].first < least; ++k) {
            const LabelHypothesis& hypothesis = hypotheses_[order[k].second];
            const double reached = some == active ? order[k].first : misfit_with(hypothesis, station, active, true);
            if (reached < least) {
                least = reached;
                best = hypothesis;
            }
        }
        return best;
    }

    /// The factor on the distances of a station that makes its misfit vanish.
    [[nodiscard]] std::optional<LabelHypothesis> scale_of(std::size_t station, const StationFit& fit) const {
        constexpr double k_most = 1.25;
        constexpr double k_least = 5e-4;  // below it the tests of groups tell it, and what it is beside its u
        constexpr int k_steps = 40;       // of a golden section: to 2e-9 of the factor
        const std::vector<bool> active = of_station(station, std::nullopt);
        if (!StartSearch(measurement_, active).tells_causes(station)) {
            return std::nullopt;
        }
        const double misfit = fit.upright_misfit();
        const std::vector<bool> some = some_visits(active);
        StationFit best = fit;
        const auto misfit_at = [&](double logarithm) {
            const LabelHypothesis hypothesis{.lengths = std::exp(logarithm), .scale = true};
            const RotaryTableMeasurement other = relabelled(measurement_, station, hypothesis);
            const StationFit found = StartSearch(other, some).fit_near(station, best);
            if (found.upright_misfit() < best.upright_misfit()) {
                best = found;
            }
            return found.upright_misfit();
        };
        // What is left grows with the distance of the factor from the right one, on both sides.
        const double logarithm = gum::least_by_golden_section(misfit_at, -std::log(k_most), std::log(k_most), k_steps);
        const LabelHypothesis found{.lengths = std::exp(logarithm), .scale = true};
        if (std::abs(found.lengths - 1.0) > k_least &&
            misfit_with(found, station, active, true) < std::min(k_share_with_right_labels * misfit, k_good_misfit)) {
            return found;
        }
        return std::nullopt;
    }

    // ---- in a part of the visits ----

    struct StationVisit {
        std::size_t pass = 0, angle = 0;
        std::vector<std::size_t> lengths;
    };
    [[nodiscard]] std::vector<StationVisit> visits_of(std::size_t station) const {
        std::vector<StationVisit> visits;
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;
        for (std::size_t i = 0; i < measurement_.lengths.size(); ++i) {
            const LengthObservation& length = measurement_.lengths[i];
            if (length.station == station) {
                const auto [place, is_new] = places.try_emplace({length.pass, length.angle}, visits.size());
                if (is_new) {
                    visits.push_back({length.pass, length.angle, {}});
                }
                visits[place->second].lengths.push_back(i);
            }
        }
        return visits;
    }

    /// Place, set-up and dead paths of a station from some of its visits.
    struct Reference {
        StationFit fit;
        std::map<std::size_t, double> dead_paths;
        double limit = 0.0;        ///< within which a distance agrees, [m]
        std::size_t agreeing = 0;  ///< distances of all visits
    };
    using Deviations = std::map<std::size_t, double>;  ///< by length

    /// |P - q| - l - l0 of the distances of a station whose dead path is known.
    [[nodiscard]] static Deviations deviations_at(const RotaryTableMeasurement& measurement,
                                                  const std::vector<bool>& active, std::size_t station,
                                                  const Reference& reference) {
        const StartSearch search(measurement, active);
        const auto [deviation, centre] = search.deviations(station, reference.fit);
        const StationData& data = search.stations()[station];
        Deviations result;
        for (std::size_t k = 0; k < data.observation.size(); ++k) {
            const auto known = reference.dead_paths.find(data.path_name[data.path[k]]);
            if (known != reference.dead_paths.end()) {
                result[data.observation[k]] = deviation[static_cast<Eigen::Index>(k)] +
                                              centre[static_cast<Eigen::Index>(data.path[k])] - known->second;
            }
        }
        return result;
    }

    /// The visits from which a station fits, and with whose place most of all its distances agree: all, one pass, or the
    /// first or last part of them.
    [[nodiscard]] std::optional<Reference> reference_of(std::size_t station, const std::vector<StationVisit>& visits,
                                                        const StationFit& whole) const {
        constexpr double k_times_deviation = 10.0;
        const std::vector<bool> all = of_station(station, std::nullopt);
        std::vector<std::vector<bool>> parts{all};
        for (std::size_t pass = 0; pass < measurement_.passes.size(); ++pass) {
            std::vector<bool> part = of_station(station, pass);
            if (std::ranges::find(part, true) != part.end() && part != all) {
                parts.push_back(std::move(part));
            }
        }
        for (const std::size_t share : {std::size_t{2}, std::size_t{3}}) {
            for (const bool first : {true, false}) {
                std::vector<bool> part(measurement_.lengths.size(), false);
                for (std::size_t v = 0; v < visits.size(); ++v) {
                    const std::size_t from_end = first ? v : visits.size() - 1 - v;
                    for (const std::size_t i : visits[v].lengths) {
                        part[i] = from_end * share < visits.size();
                    }
                }
                parts.push_back(std::move(part));
            }
        }
        std::optional<Reference> best;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const StartSearch search(measurement_, parts[p]);
            if (!search.tells_causes(station)) {
                continue;
            }
            Reference reference;
            reference.fit = p == 0 ? whole : search.fit_of(station, false);
            if (!reference.fit.is_settled()) {
                continue;
            }
            const auto [deviation, centre] = search.deviations(station, reference.fit);
            const StationData& data = search.stations()[station];
            for (std::size_t d = 0; d < data.path_name.size(); ++d) {
                if (data.members[d].size() > 2) {
                    reference.dead_paths[data.path_name[d]] = centre[static_cast<Eigen::Index>(d)];
                }
            }
            std::vector<double> sizes;
            for (const double one : deviation) {
                sizes.push_back(std::abs(one));
            }
            reference.limit = std::max(k_good_misfit, k_times_deviation * k_mad_to_deviation * median(sizes));
            const Deviations of_all = deviations_at(measurement_, all, station, reference);
            for (const auto& [length, one] : of_all) {
                if (std::abs(one) < reference.limit) {
                    ++reference.agreeing;
                }
            }
            if (p == 0 && reference.agreeing == of_all.size()) {
                return reference;  // nothing is wrong
            }
            if (!best || reference.agreeing > best->agreeing) {
                best = std::move(reference);
            }
        }
        return best;
    }

    /// The measurement with some distances as the hypothesis reads them. What is said of the fixture is said of them.
    [[nodiscard]] RotaryTableMeasurement relabelled_in_part(const std::vector<std::size_t>& part,
                                                            const LabelHypothesis& hypothesis) const {
        RotaryTableMeasurement other = measurement_;
        std::map<std::size_t, std::size_t> angles;  // as stated, and as read
        const double home = other.angles[other.home];
        for (const std::size_t i : part) {
            LengthObservation& length = other.lengths[i];
            length.length *= hypothesis.lengths / hypothesis.fixture;
            if (hypothesis.other_sense || hypothesis.angles != 1.0) {
                const auto [read, is_new] = angles.try_emplace(length.angle, other.angles.size());
                if (is_new) {
                    const double turned = other.angles[length.angle] - home;
                    other.angles.push_back(home + (hypothesis.other_sense ? -turned : hypothesis.angles * turned));
                }
                length.angle = read->second;
            }
        }
        return other;
    }

    /// Of each reflector of some distances which one it is, where most of them agree with another.
    [[nodiscard]] std::map<std::size_t, std::size_t> interchanges(std::size_t station, const Reference& reference,
                                                                  const std::vector<std::size_t>& part) const {
        const std::vector<bool> active = of_station(station, std::nullopt);
        std::map<std::size_t, std::size_t> path_of;  // of a reflector, where its own is known
        std::map<std::size_t, std::pair<double, std::map<std::size_t, std::size_t>>>
            counts;  // all, and by what they are
        const Deviations stated = deviations_at(measurement_, active, station, reference);
        for (const auto& [i, deviation] : stated) {
            if (std::abs(deviation) < reference.limit) {
                path_of[measurement_.lengths[i].reflector] = measurement_.lengths[i].dead_path;
            }
        }
        for (const std::size_t i : part) {
            counts[measurement_.lengths[i].reflector].first += 1.0;
        }
        for (std::size_t to = 0; to < measurement_.reflectors.size(); ++to) {
            std::vector<std::size_t> agreeing;
            for (const bool with_path : {false, true}) {
                if (with_path && !path_of.contains(to)) {
                    continue;
                }
                RotaryTableMeasurement other = measurement_;
                for (const std::size_t i : part) {
                    other.lengths[i].reflector = to;
                    // The name of a dead path may go with that of its reflector.
                    other.lengths[i].dead_path = with_path ? path_of.at(to) : other.lengths[i].dead_path;
                }
                const Deviations deviations = deviations_at(other, active, station, reference);
                for (const std::size_t i : part) {
                    const auto one = deviations.find(i);
                    if (one != deviations.end() && std::abs(one->second) < reference.limit &&
                        std::ranges::find(agreeing, i) == agreeing.end()) {
                        agreeing.push_back(i);
                    }
                }
            }
            for (const std::size_t i : agreeing) {
                ++counts[measurement_.lengths[i].reflector].second[to];
            }
        }
        std::map<std::size_t, std::size_t> result;
        for (const auto& [from, count] : counts) {
            for (const auto& [to, agreeing] : count.second) {
                if (to != from && static_cast<double>(agreeing) > k_share_of_part * count.first) {
                    result[from] = to;
                }
            }
        }
        return result;
    }

    /// What is wrong with the labels of some visits of a station: the others tell its place.
    [[nodiscard]] std::optional<gum::Diagnostic> cause_of_part(std::size_t station, const StationFit& whole) const {
        constexpr std::size_t k_fewest_visits = 2;
        constexpr std::size_t k_fewest_of_visit = 2;
        constexpr double k_times_limit = 5.0;  // a distance that is off by this much is wrong, and not a little off
        const std::vector<StationVisit> visits = visits_of(station);
        const std::optional<Reference> reference = reference_of(station, visits, whole);
        if (!reference) {
            return std::nullopt;
        }
        const std::vector<bool> active = of_station(station, std::nullopt);
        const Deviations stated = deviations_at(measurement_, active, station, *reference);
        std::vector<std::size_t> wrong_visits;
        std::vector<std::size_t> wrong;  // distances that are off
        std::vector<std::size_t> all;    // of these visits
        for (std::size_t v = 0; v < visits.size(); ++v) {
            std::vector<std::size_t> off;
            for (const std::size_t i : visits[v].lengths) {
                const auto one = stated.find(i);
                if (one != stated.end() && std::abs(one->second) > k_times_limit * reference->limit) {
                    off.push_back(i);
                }
            }
            if (off.size() >= k_fewest_of_visit) {
                wrong_visits.push_back(v);
                wrong.insert(wrong.end(), off.begin(), off.end());
                all.insert(all.end(), visits[v].lengths.begin(), visits[v].lengths.end());
            }
        }
        if (wrong_visits.size() < k_fewest_visits) {
            return std::nullopt;
        }
        const StationVisit& first = visits[wrong_visits.front()];
        const StationVisit& last = visits[wrong_visits.back()];
        const auto told = [&](gum::Diagnostic problem) {
            problem.where = "lengths, station " + measurement_.stations[station] + ", pass " +
                            measurement_.passes[first.pass] + ", " + degrees_text(measurement_.angles_deg[first.angle]);
            problem.what = "at " + std::to_string(wrong_visits.size()) + " of the " + std::to_string(visits.size()) +
                           " visits of the station, this one the first and pass " + measurement_.passes[last.pass] +
                           ", " + degrees_text(measurement_.angles_deg[last.angle]) + " the last, " + problem.what;
            problem.action += ", at these visits";
            return problem;
        };
        if (const std::map<std::size_t, std::size_t> to = interchanges(station, *reference, wrong); !to.empty()) {
            std::map<std::size_t, std::size_t> back;
            for (const auto& [from, reflector] : to) {
                back[reflector] = from;
            }
            const bool closed = back.size() == to.size() &&
                                std::ranges::all_of(back, [&](const auto& one) { return to.contains(one.first); });
            const auto explained = std::ranges::count_if(
                wrong, [&](std::size_t i) { return to.contains(measurement_.lengths[i].reflector); });
            if (closed && static_cast<double>(explained) > k_share_of_part * static_cast<double>(wrong.size())) {
                return told(interchanged(to));
            }
        }
        std::optional<LabelHypothesis> best;
        double most = k_share_of_part;
        for (const LabelHypothesis& hypothesis : hypotheses_) {
            if (hypothesis.axis || hypothesis.first != hypothesis.second) {
                continue;
            }
            const Deviations read = deviations_at(relabelled_in_part(all, hypothesis), active, station, *reference);
            const auto agreeing = std::ranges::count_if(all, [&](std::size_t i) {
                const auto one = read.find(i);
                return one != read.end() && std::abs(one->second) < reference->limit;
            });
            const double share = static_cast<double>(agreeing) / static_cast<double>(all.size());
            if (share > most) {
                most = share;
                best = hypothesis;
            }
        }
        if (!best) {
            return std::nullopt;
        }
        return told(diagnostic(*best, measurement_.stations[station]));
    }

    /// Of reflectors whose names are exchanged among each other.
    [[nodiscard]] gum::Diagnostic interchanged(const std::map<std::size_t, std::size_t>& to) const {
        std::string names;
        std::string others;
        std::size_t k = 0;
        for (const auto& [from, reflector] : to) {
            ++k;
            const std::string before = k == 1 ? "" : (k == to.size() ? " and " : ", ");
            names += before + measurement_.reflectors[from];
            others += before + measurement_.reflectors[reflector];
        }
        return {"GC-ADJUST-0013",
                "",
                "the distances agree when the reflectors " + names +
                    (to.size() == 2 ? " are interchanged" : " are " + others),
                "a reflector has the same name in the lengths and in the coordinates of the fixture",
                to.size() == 2 ? "interchange the names in the lengths of this station"
                               : "correct the names in the lengths of this station",
                gum::Severity::error};
    }

    // ---- a coordinate of the fixture ----

    /// The reflector without which the distances of all stations that fit no place fit one: its coordinates are wrong.
    void refuse_wrong_coordinates(const std::vector<std::size_t>& stations, const std::vector<double>& misfits) const {
        constexpr std::size_t k_fewest_reflectors = 4;  // three that are left make a frame
        if (measurement_.reflectors.size() < k_fewest_reflectors) {
            return;
        }
        std::optional<std::size_t> wrong;
        std::vector<StationFit> fits(measurement_.stations.size());
        double least = 1.0;
        for (std::size_t m = 0; m < measurement_.reflectors.size(); ++m) {
            std::vector<bool> others;
            for (const LengthObservation& length : measurement_.lengths) {
                others.push_back(length.reflector != m);
            }
            const StartSearch search(measurement_, others);
            std::vector<StationFit> found(measurement_.stations.size());
            double largest = 0.0;  // of all stations, as a part of what is allowed
            for (const std::size_t j : stations) {
                if (!search.tells_causes(j)) {
                    continue;
                }
                found[j] = search.fit_of(j, false);
                largest = std::max(largest, found[j].upright_misfit() /
                                                std::min(k_share_with_right_labels * misfits[j], k_good_misfit));
                if (largest > least) {
                    break;
                }
            }
            if (largest > 0.0 && largest < least) {
                least = largest;
                wrong = m;
                fits = std::move(found);
            }
        }
        // Three points and their mirror image have the same distances: of four the other sense leaves one that fits nowhere.
        if (!wrong || cause_of(stations.front(), misfits[stations.front()], std::nullopt)) {
            return;
        }
        refuse_coordinates(*wrong, place_of_reflector(*wrong, stations, fits));
    }
    /// One reflector of many, which most distances agree without: the places of the stations are right, and it strays alone.
    void refuse_stray_reflector(const std::vector<StationFit>& fits, bool has_no_result) const {
        constexpr double k_times_deviation = 20.0;
        constexpr double k_least = 0.05 * gum::k_millimetre;
        constexpr double k_least_way = 0.5 * gum::k_millimetre;  // below it the tests of groups tell it, with its u
        constexpr double k_share_of_stray = 0.3;
        constexpr double k_share_of_others = 0.1;
        const std::vector<bool> all(measurement_.lengths.size(), true);
        const StartSearch search(measurement_, all);
        std::vector<std::size_t> strays(measurement_.reflectors.size(), 0);  // stations that say so
        std::size_t asked = 0;
        for (std::size_t j = 0; j < fits.size(); ++j) {
            if (!fits[j].is_settled() || !search.tells_causes(j)) {
                continue;
            }
            ++asked;
            // Shares of the distances of each reflector that are off.
            const auto off_at = [&](const StationFit& fit) {
                const Eigen::VectorXd deviation = search.deviations(j, fit).first;
                std::vector<double> sizes;
                for (const double one : deviation) {
                    sizes.push_back(std::abs(one));
                }
                const double limit = std::max(k_least, k_times_deviation * k_mad_to_deviation * median(sizes));
                std::vector<double> off(measurement_.reflectors.size(), 0.0);
                std::vector<double> of = off;
                for (std::size_t k = 0; k < search.stations()[j].observation.size(); ++k) {
                    const std::size_t m = measurement_.lengths[search.stations()[j].observation[k]].reflector;
                    of[m] += 1.0;
                    off[m] += std::abs(deviation[static_cast<Eigen::Index>(k)]) > limit ? 1.0 : 0.0;
                }
                for (std::size_t m = 0; m < off.size(); ++m) {
                    off[m] /= std::max(of[m], 1.0);
                }
                return off;
            };
            const std::vector<double> off = off_at(fits[j]);
            for (std::size_t m = 0; m < off.size(); ++m) {
                bool alone = off[m] > k_share_of_stray;
                for (std::size_t n = 0; n < off.size(); ++n) {
                    alone = alone && (n == m || off[n] <= k_share_of_others);
                }
                // A weak layout may have left the right place for one at which most distances agree by chance.
                const auto agrees_at = [&](const StationFit& fit) {
                    return fit.is_settled() && off_at(fit)[m] <= k_share_of_others;
                };
                if (alone && std::ranges::none_of(search.plain_fits(j, fits[j]), agrees_at)) {
                    ++strays[m];
                }
            }
        }
        const auto most = std::ranges::max_element(strays);
        if (asked < 2 || most == strays.end() || 2 * *most <= asked) {
            return;
        }
        const auto m = static_cast<std::size_t>(most - strays.begin());
        std::vector<bool> others;
        for (const LengthObservation& length : measurement_.lengths) {
            others.push_back(length.reflector != m);
        }
        const StartSearch without(measurement_, others);
        std::vector<std::size_t> stations;
        std::vector<StationFit> found = fits;
        for (std::size_t j = 0; j < fits.size(); ++j) {
            found[j] = without.fit_near(j, fits[j]);
            if (found[j].is_settled() && without.tells_causes(j)) {
                stations.push_back(j);
            }
        }
        const std::optional<Eigen::Vector3d> place = place_of_reflector(m, stations, found);
        // Without one place it is no coordinate but a reflector that moves: the tests of groups name it, where there is a
        // result.
        if (place ? (*place - measurement_.fixture.row(static_cast<Eigen::Index>(m)).transpose()).norm() > k_least_way
                  : has_no_result) {
            refuse_coordinates(m, place);
        }
    }
    [[noreturn]] void refuse_coordinates(std::size_t m, const std::optional<Eigen::Vector3d>& place) const {
        std::string what = "the distances of the stations agree when this reflector is left out";
        if (place) {
            const Eigen::Vector3d way = *place - measurement_.fixture.row(static_cast<Eigen::Index>(m)).transpose();
            what = "the distances put it near (" + coordinate(place->x()) + ", " + coordinate(place->y()) + ", " +
                   coordinate(place->z()) + ") mm in the fixture, " + coordinate(way.norm()) +
                   " mm away from its stated coordinates";
        }
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0013", "fixture, reflector " + measurement_.reflectors[m], what,
            "a reflector stands in the fixture where its coordinates say",
            "compare its coordinates with the report of the CMM, digit by digit and with their signs, and see whether "
            "its name in the lengths is that of another point and whether it was moved",
            gum::Severity::error});
    }
    [[nodiscard]] static std::string coordinate(double value) {
        const double rounded = std::round(value / gum::k_millimetre * 10.0) / 10.0;
        return text::fixed(rounded == 0.0 ? 0.0 : rounded, 1);
    }

    /// Where the distances put a reflector in the fixture, from stations whose places the other reflectors tell.
    [[nodiscard]] std::optional<Eigen::Vector3d> place_of_reflector(std::size_t reflector,
                                                                    const std::vector<std::size_t>& stations,
                                                                    const std::vector<StationFit>& fits) const {
        constexpr int k_most_steps = 30;
        constexpr double k_step = 1e-5;  // [m], of the derivatives
        constexpr double k_end = 1e-6;   // [m]
        const auto row = static_cast<Eigen::Index>(reflector);
        const std::vector<bool> all(measurement_.lengths.size(), true);
        RotaryTableMeasurement moved = measurement_;
        const auto deviations_from = [&](const Eigen::Vector3d& place) {
            moved.fixture.row(row) = place.transpose();
            const StartSearch search(moved, all);
            std::vector<double> values;
            for (const std::size_t j : stations) {
                if (!std::isfinite(fits[j].misfit)) {
                    continue;
                }
                const Eigen::VectorXd deviation = search.deviations(j, fits[j]).first;
                const StationData& data = search.stations()[j];
                for (std::size_t k = 0; k < data.observation.size(); ++k) {
                    if (measurement_.lengths[data.observation[k]].reflector == reflector) {
                        values.push_back(deviation[static_cast<Eigen::Index>(k)]);
                    }
                }
            }
            return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(values.data(), std::ssize(values)));
        };
        const auto squares = [&](const Eigen::Vector3d& at) { return deviations_from(at).squaredNorm(); };
        Eigen::Vector3d place = measurement_.fixture.row(row).transpose();
        const Eigen::Vector3d stated = place;
        double least = squares(place);
        // A sign or two coordinates that are exchanged are farther off than a descent sees.
        for (int signs = 0; signs < 8; ++signs) {
            for (int turn = 0; turn < 6; ++turn) {
                Eigen::Vector3d from(stated[turn % 3], stated[(turn + (turn < 3 ? 1 : 2)) % 3],
                                     stated[(turn + (turn < 3 ? 2 : 1)) % 3]);
                for (int c = 0; c < 3; ++c) {
                    from[c] *= (signs >> c) % 2 == 0 ? 1.0 : -1.0;
                }
                if (const double left = squares(from); left < least) {
                    least = left;
                    place = from;
                }
            }
        }
        Eigen::VectorXd deviation = deviations_from(place);
        double damping = 1e-6;
        for (int step = 0; step < k_most_steps && deviation.size() > 3; ++step) {
            Eigen::MatrixXd derivatives(deviation.size(), 3);
            for (int c = 0; c < 3; ++c) {
                derivatives.col(c) = (deviations_from(place + k_step * Eigen::Vector3d::Unit(c)) - deviation) / k_step;
            }
            Eigen::Matrix3d normal = derivatives.transpose() * derivatives;
            normal.diagonal() *= 1.0 + damping;
            const Eigen::Vector3d change = normal.ldlt().solve(-derivatives.transpose() * deviation);
            const Eigen::VectorXd after = deviations_from(place + change);
            if (change.allFinite() && after.squaredNorm() < deviation.squaredNorm()) {
                place += change;
                deviation = after;
                damping = std::max(1e-12, 0.1 * damping);
                if (change.norm() < k_end) {
                    break;
                }
            } else {
                damping = std::max(1e-6, 10.0 * damping);
            }
        }
        std::vector<double> sizes;
        for (const double one : deviation) {
            sizes.push_back(std::abs(one));
        }
        if (sizes.size() > 3 && median(sizes) < k_good_misfit) {
            return place;
        }
        return std::nullopt;
    }

    /// Of the visits of one station as many as tell its labels, evenly over all of them.
    [[nodiscard]] std::vector<bool> some_visits(const std::vector<bool>& active) const {
        constexpr std::size_t k_visits = 24;
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> visits;  // numbered in their order
        for (std::size_t i = 0; i < active.size(); ++i) {
            if (active[i]) {
                visits.try_emplace({measurement_.lengths[i].pass, measurement_.lengths[i].angle}, visits.size());
            }
        }
        if (visits.size() <= k_visits) {
            return active;
        }
        std::vector<bool> kept(visits.size(), false);
        for (std::size_t k = 0; k < k_visits; ++k) {
            kept[k * visits.size() / k_visits] = true;
        }
        std::vector<bool> some = active;
        for (std::size_t i = 0; i < active.size(); ++i) {
            if (active[i]) {
                some[i] = kept[visits.at({measurement_.lengths[i].pass, measurement_.lengths[i].angle})];
            }
        }
        return some;
    }

    /// Passes of a station that each have a place of their own.
    void refuse_two_places(std::size_t station, double misfit) const {
        constexpr double k_same_place = 0.02;  // [m]
        // From one place with dead paths of each pass, as after an interruption between them: places that a weak layout
        // hardly tells apart are not two.
        RotaryTableMeasurement split = measurement_;
        for (LengthObservation& length : split.lengths) {
            length.dead_path += length.pass * measurement_.dead_paths.size();
        }
        if (StartSearch(split, of_station(station, std::nullopt)).fit_of(station, true).upright_misfit() <
            k_share_with_right_labels * misfit) {
            return;
        }
        std::optional<std::pair<std::size_t, Eigen::Vector3d>> first;
        for (std::size_t pass = 0; pass < measurement_.passes.size(); ++pass) {
            const std::vector<bool> active = of_station(station, pass);
            const StartSearch search(measurement_, active);
            if (!search.tells_causes(station)) {
                continue;
            }
            const StationFit fit = search.fit_of(station, true);
            if (!(fit.upright_misfit() < k_share_with_right_labels * misfit)) {
                return;
            }
            if (!first) {
                first = {pass, fit.position};
            } else if ((fit.position - first->second).norm() > k_same_place) {
                throw gum::NoResultError(gum::Diagnostic{
                    "GC-ADJUST-0013", "lengths, station " + measurement_.stations[station],
                    "its passes were measured from places that are " + size_text(fit.position - first->second) +
                        " apart: " + measurement_.passes[first->first] + " and " + measurement_.passes[pass],
                    "a station stands in one place",
                    "see whether stations are interchanged in one of the passes, or "
                    "give the place of its own a station name of its own",
                    gum::Severity::error});
            }
        }
    }

    [[nodiscard]] std::vector<bool> of_station(std::size_t station, std::optional<std::size_t> pass) const {
        std::vector<bool> active;
        for (const LengthObservation& length : measurement_.lengths) {
            active.push_back(length.station == station && (!pass || length.pass == *pass));
        }
        return active;
    }

    [[nodiscard]] static std::string size_text(const Eigen::Vector3d& way) {
        return std::to_string(std::llround(way.norm() / gum::k_millimetre)) + " mm";
    }

    /// \param station  "" for all
    [[nodiscard]] gum::Diagnostic diagnostic(const LabelHypothesis& cause, const std::string& station) const {
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
                        " of the fixture coordinates, and not about " + coordinate(measurement_.axis),
                    "the axis lies along the coordinate of the fixture that has its letter, within 45°: error motions "
                    "are named after these coordinates",
                    "correct the letter of the axis, or state the coordinates in a frame with " +
                        coordinate(measurement_.axis) + " along the axis",
                    gum::Severity::error};
        }
        if (cause.scale) {
            return {"GC-ADJUST-0013",
                    where,
                    "the distances agree when they are multiplied by about " + text::fixed(cause.lengths, 4),
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
            return diagnostic({.lengths = 1.0 / cause.fixture}, station);
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
                    std::abs(cause.angles - 0.9) < 0.01
                        ? "the angles seem to be gon: multiply them by 0.9"
                        : "see in which unit and in which steps the angles were written",
                    gum::Severity::error};
        }
        const std::string a = measurement_.reflectors[cause.first];
        const std::string b = measurement_.reflectors[cause.second];
        return {"GC-ADJUST-0013",
                where,
                "the distances agree when the reflectors " + a + " and " + b + " are interchanged",
                "a reflector has the same name in the lengths and in the coordinates of the fixture",
                station.empty() ? "interchange the names in the fixture file or in the lengths"
                                : "interchange the names in the lengths of this station",
                gum::Severity::error};
    }

    const RotaryTableMeasurement& measurement_;
    std::vector<LabelHypothesis> hypotheses_;
};

// ---- interrupted beams ----------------------------------------------------------------------------------------------

/// Where the beam of a station was interrupted.
struct Interruption {
    std::size_t first = 0;                                  ///< length after it, of the measurement
    double size = 0.0;                                      ///< [m]
    double left = std::numeric_limits<double>::infinity();  ///< mean absolute deviation with it, [m]
};

// Every candidate is fitted anew. Steps of the medians of visits at one set of start values were tried, and are fooled
// by start values that the step itself has moved (ADR 0031).
class InterruptionSearch {
public:
    explicit InterruptionSearch(const RotaryTableMeasurement& measurement)
        : split_(measurement), declared_(measurement.dead_paths.size()) {}

    /// The interruption of a station that leaves least of its deviations, where that is little enough.
    [[nodiscard]] std::optional<Interruption> of_station(std::size_t station) {
        constexpr double k_smallest = 0.1 * gum::k_millimetre;
        constexpr double k_share_left = 0.2;
        active_.clear();
        std::map<std::size_t, std::vector<std::vector<std::size_t>>> by_path;  // visits of each, in their order
        std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, std::size_t>> places;
        for (std::size_t i = 0; i < split_.lengths.size(); ++i) {
            const LengthObservation& length = split_.lengths[i];
            active_.push_back(length.station == station);
            if (active_.back()) {
                const auto [place, is_new] = places.try_emplace({length.pass, length.angle}, length.dead_path, 0);
                auto& visits = by_path[place->second.first];
                if (is_new) {
                    place->second.second = visits.size();
                    visits.emplace_back();
                }
                visits[place->second.second].push_back(i);
            }
        }
        const double before = deviation(station, {}).left;
        Interruption best;
        for (const auto& [path, visits] : by_path) {
            const Interruption found = best_of(station, visits);
            if (found.left < best.left) {
                best = found;
            }
        }
        // A fifth or less of what it was (ADR 0031): an additional dead path alone takes up some of any misfit. And next
        // to nothing: where distances in inch begin a jump of a metre leaves a fifth as well.
        if (best.left < std::min(k_share_left * before, k_wrong_labels) && std::abs(best.size) > k_smallest) {
            return best;
        }
        return std::nullopt;
    }

private:
    /// Every visit of a short sequence; of a long one equal steps first, and then the neighbours of the best.
    Interruption best_of(std::size_t station, const std::vector<std::vector<std::size_t>>& visits) {
        constexpr std::size_t k_steps = 24;
        constexpr std::size_t k_fewest = 2;  // on either side: of one visit it is that visit
        if (visits.size() < 2 * k_fewest) {
            return {};
        }
        std::size_t from = k_fewest;
        std::size_t to = visits.size() - k_fewest;
        Interruption best;
        for (std::size_t step = (to - from) / k_steps + 1; step > 0; step = step == 1 ? 0 : step / k_steps + 1) {
            std::size_t place = from;
            for (std::size_t k = from; k <= to; k += step) {
                const Interruption found = interrupted_at(station, visits, k);
                if (found.left < best.left) {
                    best = found;
                    place = k;
                }
            }
            from = std::max(k_fewest, place - std::min(place, step));
            to = std::min(visits.size() - k_fewest, place + step);
        }
        return best;
    }

    Interruption interrupted_at(std::size_t station, const std::vector<std::vector<std::size_t>>& visits,
                                std::size_t first) {
        std::vector<std::pair<std::size_t, std::size_t>> before;  // length and its dead path
        // Each dead path that is met goes on as one of its own: a station may have one for each reflector, and an
        // interrupted beam moves all of them.
        SplitPaths split;
        for (std::size_t k = first; k < visits.size(); ++k) {
            for (const std::size_t i : visits[k]) {
                std::size_t& path = split_.lengths[i].dead_path;
                before.emplace_back(i, path);
                const auto [own, is_new] = split.try_emplace(path, declared_ + split.size());
                if (is_new && own->second == split_.dead_paths.size()) {
                    split_.dead_paths.emplace_back();
                }
                path = own->second;
            }
        }
        Interruption found = deviation(station, split);
        found.first = visits[first].front();
        for (const auto& [i, path] : before) {
            split_.lengths[i].dead_path = path;
        }
        return found;
    }

    using SplitPaths = std::map<std::size_t, std::size_t>;  // as declared, and what it is from an interruption on

    /// What a fit of the station leaves, and by how much the dead paths that were split go on differently: the median.
    [[nodiscard]] Interruption deviation(std::size_t station, const SplitPaths& split) const {
        const StartSearch search(split_, active_);
        Interruption result;
        // What a few distances beyond the unknowns leave is next to nothing with any further dead path.
        if (!split.empty() && !search.tells_causes(station)) {
            return result;
        }
        const StationFit fit = search.fit_of(station, split.empty());
        const auto [deviations, centres] = search.deviations(station, fit);
        // The mean of all deviations. The misfit leaves out the largest ones, which are just those of an interrupted
        // beam.
        result.left = deviations.cwiseAbs().mean();
        const std::vector<std::size_t>& names = search.stations()[station].path_name;
        const auto place_of = [&](std::size_t path) {
            return static_cast<std::size_t>(std::ranges::find(names, path) - names.begin());
        };
        std::vector<double> steps;
        for (const auto& [declared, own] : split) {
            const std::size_t a = place_of(declared);
            const std::size_t b = place_of(own);
            if (a < names.size() && b < names.size()) {  // a path that begins after the interruption tells nothing
                steps.push_back(centres[static_cast<Eigen::Index>(a)] - centres[static_cast<Eigen::Index>(b)]);
            }
        }
        result.size = steps.empty() ? 0.0 : median(steps);
        return result;
    }

    RotaryTableMeasurement split_;
    std::size_t declared_;  // dead paths of the measurement; those behind are split off
    std::vector<bool> active_;
};

// ---- angles of one station ------------------------------------------------------------------------------------------

/// A station whose angles are those of the others but for an offset: no angle has distances of it and of them.
void refuse_shifted_angles(const RotaryTableMeasurement& measurement) {
    constexpr double k_alike = 1e-6 * gum::k_degree;
    constexpr double k_most_shared = 0.5;
    constexpr double k_explained = 0.8;
    const auto turns = [](double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); };
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        std::vector<bool> own(measurement.angles.size(), false);
        std::vector<bool> others = own;
        for (const LengthObservation& length : measurement.lengths) {
            (length.station == j ? own : others)[length.angle] = true;
        }
        // How many of its angles are those of the others when they are shifted.
        const auto shared = [&](double shift) {
            double count = 0.0;
            double all = 0.0;
            for (std::size_t a = 0; a < own.size(); ++a) {
                if (own[a]) {
                    all += 1.0;
                    for (std::size_t b = 0; b < own.size(); ++b) {
                        if (others[b] &&
                            std::abs(turns(measurement.angles[a] + shift - measurement.angles[b])) < k_alike) {
                            count += 1.0;
                            break;
                        }
                    }
                }
            }
            return all > 2.0 ? count / all : 1.0;
        };
        if (shared(0.0) > k_most_shared) {
            continue;
        }
        const auto first = static_cast<std::size_t>(std::ranges::find(own, true) - own.begin());
        std::optional<double> best;
        for (std::size_t b = 0; b < own.size(); ++b) {
            const double shift = turns(measurement.angles[b] - measurement.angles[first]);
            if (others[b] && (!best || std::abs(shift) < std::abs(*best)) && shared(shift) > k_explained) {
                best = shift;
            }
        }
        if (best) {
            const double degrees = std::round(std::abs(*best) / gum::k_degree * 1e6) / 1e6;
            throw gum::NoResultError(gum::Diagnostic{
                "GC-ADJUST-0013", "lengths, station " + measurement.stations[j],
                "its angles are those of the other stations when they are " + degrees_text(degrees) +
                    (*best > 0.0 ? " higher" : " lower"),
                "an angle that several stations measure is stated alike for all of them",
                "state the angles to which the table was driven, from the same origin and rounded alike",
                gum::Severity::error});
        }
    }
}

}  // namespace

void refuse_interrupted_beams(const RotaryTableMeasurement& measurement) {
    std::vector<gum::Diagnostic> problems;
    InterruptionSearch search(measurement);
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const std::optional<Interruption> found = search.of_station(j);
        if (!found) {
            continue;
        }
        const LengthObservation& length = measurement.lengths[found->first];
        problems.push_back({"GC-ADJUST-0014",
                            "station " + measurement.stations[j] + ", pass " + measurement.passes[length.pass] + ", " +
                                degrees_text(measurement.angles_deg[length.angle]),
                            "from this visit on all distances of the station are off by about " +
                                text::fixed(std::abs(found->size) / gum::k_micrometre, 0) + " µm alike",
                            "distances of one dead path have one constant",
                            "the beam was interrupted there: give the distances from there on a dead path of their own",
                            gum::Severity::error});
    }
    if (!problems.empty()) {
        throw gum::NoResultError(std::move(problems));
    }
}

StartValues find_start_values(const RotaryTableMeasurement& measurement, const std::vector<bool>& active) {
    StartSearch search(measurement, active);
    search.run();
    return search.values();
}

void refuse_no_rigid_table(const RotaryTableMeasurement& measurement) {
    StartSearch search(measurement, {});
    (void)search.fit_each();
    if (std::optional<gum::Diagnostic> none = search.no_rigid_table()) {
        throw gum::NoResultError(std::move(*none));
    }
}

void refuse_wrong_labels(const RotaryTableMeasurement& measurement) {
    refuse_shifted_angles(measurement);
    StartSearch search(measurement, {});
    (void)search.fit_each();
    LabelSearch(measurement).refuse(search.fits(), LabelSearch::Asked::all);
}

std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement) {
    // What the start values leave is error motions: even of a bad table far below this.
    constexpr double k_smallest = 0.02;  // [m]
    constexpr double k_factor = 15.0;    // times the standard deviation that the median absolute deviation stands for
    StartSearch search(measurement, {});
    (void)search.fit_each();
    LabelSearch(measurement).refuse(search.fits(), LabelSearch::Asked::suspicious);
    const std::optional<gum::Diagnostic> no_table = search.no_rigid_table();
    try {
        search.finish();
    } catch (const gum::NoResultError&) {
        // Places that fit alike badly, and a place far away where all reflectors lie on a cone, are what a search comes to
        // that has nothing to find: they say nothing of the layout.
        if (no_table) {
            throw gum::NoResultError(*no_table);
        }
        throw;
    }
    std::vector<std::pair<double, std::size_t>> found;  // negative size first, so that the largest comes first
    for (std::size_t j = 0; j < search.stations().size(); ++j) {
        const StationData& data = search.stations()[j];
        const Eigen::VectorXd deviation = search.deviations(j).first;
        std::vector<double> values;
        for (const std::vector<Eigen::Index>& members : data.members) {
            for (const Eigen::Index i : members) {
                // Which one of two lengths is wrong cannot be told: each is as far from their median.
                if (members.size() > 2) {
                    values.push_back(std::abs(deviation[i]));
                }
            }
        }
        if (values.empty()) {
            continue;
        }
        const double limit = std::max(k_smallest, k_factor * k_mad_to_deviation * median(values));
        for (const std::vector<Eigen::Index>& members : data.members) {
            for (const Eigen::Index i : members) {
                if (members.size() > 2 && std::abs(deviation[i]) > limit) {
                    found.emplace_back(-std::abs(deviation[i]), data.observation[static_cast<std::size_t>(i)]);
                }
            }
        }
    }
    std::sort(found.begin(), found.end());
    // More than one in twenty are no gross errors of single distances, but something else.
    found.resize(std::min(found.size(), measurement.lengths.size() / 20 + 1));
    std::vector<std::size_t> result;
    for (const auto& [size, i] : found) {
        result.push_back(i);
    }
    return result;
}

}  // namespace gumcert::engine
