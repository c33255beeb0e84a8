#include "engine/rotary_table_trials.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/datum.h"
#include "gum/quantity/diagnostic.h"

// The same instructions for wider registers where the machine has them. FMA stays out: it would round differently.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define GUMCERT_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define GUMCERT_WIDE_CLONES
#endif
// Inside a function with clones everything must be inlined, or it would be compiled for the narrow registers alone.
#define GUMCERT_INLINE __attribute__((always_inline)) inline

namespace gumcert::engine {

namespace {

using Index = Eigen::Index;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Components of a station block.
constexpr Index k_scale = 3;
constexpr Index k_temperature = 4;
constexpr Index k_station_size = 5;

constexpr int k_lanes = 16;  // trials computed side by side

/// One number of each of 16 trials. All arithmetic is lane by lane, so that no trial depends on its neighbours.
struct alignas(64) Lanes {
    std::array<double, k_lanes> at;

    GUMCERT_INLINE double& operator[](int lane) { return at[static_cast<std::size_t>(lane)]; }
    GUMCERT_INLINE const double& operator[](int lane) const { return at[static_cast<std::size_t>(lane)]; }
};

GUMCERT_INLINE void fill(Lanes& lanes, double value) {
    for (int t = 0; t < k_lanes; ++t) {
        lanes[t] = value;
    }
}

/// sum += Σ c_i x_i, N terms.
template <std::size_t... I>
GUMCERT_INLINE void add_terms(const double* coefficients, const Lanes* x, Lanes& sum,
                              std::index_sequence<I...> /*terms*/) {
    const std::array<double, sizeof...(I)> c{coefficients[I]...};
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        sum[t] += (... + (c[I] * x[I][t]));
    }
}

/// sum += Σ c_i x_i
GUMCERT_INLINE void add_combination(const double* coefficients, Index count, const Lanes* x, Lanes& sum) {
    constexpr Index k_terms = 6;
    for (; count >= k_terms; count -= k_terms, coefficients += k_terms, x += k_terms) {
        add_terms(coefficients, x, sum, std::make_index_sequence<6>());
    }
    switch (count) {
        case 5:
            add_terms(coefficients, x, sum, std::make_index_sequence<5>());
            break;
        case 4:
            add_terms(coefficients, x, sum, std::make_index_sequence<4>());
            break;
        case 3:
            add_terms(coefficients, x, sum, std::make_index_sequence<3>());
            break;
        case 2:
            add_terms(coefficients, x, sum, std::make_index_sequence<2>());
            break;
        case 1:
            add_terms(coefficients, x, sum, std::make_index_sequence<1>());
            break;
        default:
            break;
    }
}

/// y += A x, A rows×columns, row-major.
GUMCERT_INLINE void multiply_add(const double* matrix, Index rows, Index columns, const Lanes* x, Lanes* y) {
    for (Index row = 0; row < rows; ++row, matrix += columns) {
        add_combination(matrix, columns, x, y[row]);
    }
}

/// sin x and 1 - cos x. Power series up to 1/16, where the first term left out is below 2⁻⁶⁰ of the sum.
GUMCERT_INLINE void sine_and_versine(const Lanes& x, Lanes& sine, Lanes& versine) {
    constexpr double k_small = 0.0625;
    std::int64_t large = 0;
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        const double a = x[t];
        const double q = a * a;
        sine[t] = a + a * (q * (-1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * (1.0 / 362880.0)))));
        versine[t] = q * (0.5 + q * (-1.0 / 24.0 + q * (1.0 / 720.0 + q * (-1.0 / 40320.0 + q * (1.0 / 3628800.0)))));
    }
    for (int t = 0; t < k_lanes; ++t) {
        large |= x[t] > k_small || x[t] < -k_small ? 1 : 0;
    }
    for (int t = 0; t < k_lanes && large != 0; ++t) {
        if (std::abs(x[t]) > k_small) {
            const double half = std::sin(0.5 * x[t]);
            sine[t] = std::sin(x[t]);
            versine[t] = 2.0 * half * half;
        }
    }
}

/// Elements of Rz(c) Ry(b) Rx(a) - I, row by row, without loss of digits at small angles.
GUMCERT_INLINE void rotation_from_identity(const Lanes* angles, Lanes* rotation) {
    Lanes sa;
    Lanes va;
    Lanes sb;
    Lanes vb;
    Lanes sc;
    Lanes vc;
    sine_and_versine(angles[0], sa, va);
    sine_and_versine(angles[1], sb, vb);
    sine_and_versine(angles[2], sc, vc);
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        const double ca = 1.0 - va[t];
        const double cb = 1.0 - vb[t];
        const double cc = 1.0 - vc[t];
        rotation[0][t] = vc[t] * vb[t] - vc[t] - vb[t];
        rotation[1][t] = cc * sb[t] * sa[t] - sc[t] * ca;
        rotation[2][t] = cc * sb[t] * ca + sc[t] * sa[t];
        rotation[3][t] = sc[t] * cb;
        rotation[4][t] = sc[t] * sb[t] * sa[t] + (vc[t] * va[t] - vc[t] - va[t]);
        rotation[5][t] = sc[t] * sb[t] * ca - cc * sa[t];
        rotation[6][t] = -sb[t];
        rotation[7][t] = cb * sa[t];
        rotation[8][t] = vb[t] * va[t] - vb[t] - va[t];
    }
}

GUMCERT_INLINE double small_arc_tangent(double z) {
    const double q = z * z;
    return z +
           z * (q * (-1.0 / 3.0 +
                     q * (1.0 / 5.0 + q * (-1.0 / 7.0 + q * (1.0 / 9.0 + q * (-1.0 / 11.0 +
                                                                              q * (1.0 / 13.0 - q * (1.0 / 15.0))))))));
}

GUMCERT_INLINE double small_arc_sine(double z) {
    const double q = z * z;
    return z +
           z * (q * (1.0 / 6.0 +
                     q * (3.0 / 40.0 + q * (15.0 / 336.0 +
                                            q * (105.0 / 3456.0 + q * (945.0 / 42240.0 + q * (10395.0 / 599040.0)))))));
}

/// Angles a, b, c of a rotation given by its difference from the identity: power series of arc tangent and arc sine up
/// to 1/16, where the first term left out is below 2⁻⁶⁰ of the sum.
GUMCERT_INLINE void angles_from_rotation(const Lanes* rotation, Lanes* angles) {
    constexpr double k_small = 0.0625;
    std::int64_t large = 0;
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        angles[0][t] = small_arc_tangent(rotation[7][t] / (1.0 + rotation[8][t]));
        angles[1][t] = small_arc_sine(-rotation[6][t]);
        angles[2][t] = small_arc_tangent(rotation[3][t] / (1.0 + rotation[0][t]));
    }
    for (int t = 0; t < k_lanes; ++t) {
        const bool is_large =
            std::abs(angles[0][t]) > k_small || std::abs(angles[1][t]) > k_small || std::abs(angles[2][t]) > k_small;
        large |= is_large ? 1 : 0;
    }
    for (int t = 0; t < k_lanes && large != 0; ++t) {
        if (std::abs(angles[0][t]) > k_small || std::abs(angles[1][t]) > k_small || std::abs(angles[2][t]) > k_small) {
            const double r22 = 1.0 + rotation[8][t];
            angles[0][t] = std::atan2(rotation[7][t], r22);
            angles[1][t] = std::atan2(-rotation[6][t], std::hypot(rotation[7][t], r22));
            angles[2][t] = std::atan2(rotation[3][t], 1.0 + rotation[0][t]);
        }
    }
}

/// V⁻¹ from the Cholesky factor of V, exactly symmetric.
Eigen::MatrixXd weight_matrix(const Eigen::MatrixXd& cholesky) {
    const Eigen::MatrixXd half =
        cholesky.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(cholesky.rows(), cholesky.rows()));
    Eigen::MatrixXd weight = half.transpose() * half;
    weight.triangularView<Eigen::StrictlyUpper>() = weight.transpose();
    return weight;
}

constexpr double k_infinity = std::numeric_limits<double>::infinity();

}  // namespace

/// The solution and its normal equations, laid out for the trials. All parameters, free or held, have their slots in
/// one sequence: stations, dead paths, fixture, expansion, reversal, poses.
struct TrialNetwork {
    struct Length {
        std::array<double, 3> difference;  ///< P - q at the solution, [m]
        double distance;                   ///< its length, [m]
        double inverse_square;             ///< of that, [1/m²]
        Index reflector;
        Index path_slot;
    };
    struct VisitPlan {
        std::size_t number;  ///< among the visits of the adjustment
        Index first, count;  ///< lengths
        Index first_input;   ///< of the same among the input deviations
        Index station;
        Index angle;
        double half_sense;      ///< of the reversal
        std::size_t weights;    ///< where they begin, count×count
        std::size_t to_length;  ///< where -A begins, count×6 in the order of the inputs
        std::size_t gain;       ///< where it begins, count
        bool is_diagonal;       ///< weights
        bool is_determined;     ///< axial deviation
    };
    /// Visits of one angle in one sense: they share the pose.
    struct Turn {
        std::array<double, 9> to_table;  ///< R(θ) times the rotation of T_s, row by row
        std::array<double, 3> offset;    ///< R(θ) times the translation of T_s, [m]
        Index pose;                      ///< first slot
        double half_sense;
        std::size_t begin, end;  ///< visits
    };
    struct Prior {
        std::vector<Index> slots;
        RowMajorMatrix weights;
        Index first;  ///< among the prior observations
        std::size_t group;
    };
    struct Elimination {
        std::vector<Index> slots;  ///< free components of the pose
        RowMajorMatrix inverse;    ///< N_ee⁻¹
        RowMajorMatrix to_border;  ///< -N_be N_ee⁻¹
        RowMajorMatrix to_pose;    ///< -N_ee⁻¹ N_eb
    };

    TrialNetwork(const JointAdjustment& solved, const StochasticModel& stochastic, bool with_positions);

    [[nodiscard]] Index station_slot(Index station, Index component) const {
        return k_station_size * station + component;
    }
    [[nodiscard]] double nominal_at(Index slot) const { return nominal[static_cast<std::size_t>(slot)]; }

    Index stations = 0, reflectors = 0, angles = 0;
    Index paths = 0, fixture = 0, expansion = 0, reversal = 0, poses = 0, slots = 0;  ///< first slots
    std::vector<double> nominal;                                                      ///< parameters at the solution

    std::vector<Length> lengths;
    std::vector<double> length_residual;  ///< observed - predicted at the solution, [m]
    std::vector<VisitPlan> visits;        ///< in the order of the turns
    std::vector<double> weights, to_length, gains;
    std::vector<Turn> turns;
    Index largest_visit = 0;

    std::vector<Prior> priors;
    std::vector<double> prior_residual;             ///< observed - value at the solution
    Index fixture_prior = 0, expansion_prior = -1;  ///< first of the prior observations
    std::vector<Index> scale_priors, temperature_priors;

    std::vector<Index> border;  ///< slots
    RowMajorMatrix border_covariance;
    std::vector<Elimination> eliminated;
    std::vector<Index> free_slots;
    std::vector<double> inverse_u;  ///< of the same
    std::vector<FreeParameter> free_parameters;
    Adjustment least_squares;  ///< at the solution, for trials that are solved alone

    Datum datum = Datum::axis_average_line;
    Index home = 0;
    std::array<int, 3> cyclic{};  ///< coordinate along the axis, then the two across it
    std::vector<double> cosine, sine;
    std::array<double, 9> set_up_rotation{};  ///< of the solver's T_s, minus the identity
    std::array<double, 3> set_up_translation{};
    Vector6 start_world = Vector6::Zero(), start_set_up = Vector6::Zero();
    RowMajorMatrix change_map;  ///< 10×6N: (world, O, O, S, S) that takes away what the datum forbids

private:
    void take_visits(const JointAdjustment& solved, bool with_positions, const StochasticModel& stochastic);
    void take_priors(const JointAdjustment& solved);
    void take_normal_equations(const JointAdjustment& solved);
    void take_datum(const JointAdjustment& solved);
};

/// Space for 16 trials at a time.
struct TrialWork {
    explicit TrialWork(const TrialNetwork& network)
        : delta(static_cast<std::size_t>(network.slots)),
          gradient(delta.size()),
          step(delta.size()),
          last_step(delta.size()),
          last_move(delta.size()),
          residual_start(network.lengths.size()),
          residual(network.lengths.size()),
          prior_observed(network.prior_residual.size()),
          axial_deviation(network.visits.size()),
          place(3 * static_cast<std::size_t>(network.stations)),
          scale(static_cast<std::size_t>(network.stations)),
          stretch(static_cast<std::size_t>(network.stations)),
          point(3 * static_cast<std::size_t>(network.reflectors)),
          turned(point.size()),
          pull(point.size()),
          difference(3 * static_cast<std::size_t>(network.largest_visit)),
          distance(static_cast<std::size_t>(network.largest_visit)),
          weighted(distance.size()),
          misclosure(std::max<std::size_t>({distance.size(), point.size(), 6})),
          border_gradient(network.border.size()),
          border_step(network.border.size()),
          pose_rotation(9 * static_cast<std::size_t>(network.angles)),
          errors(6 * static_cast<std::size_t>(network.angles)) {}

    std::vector<Lanes> delta, gradient, step;  ///< slots; delta from the solution
    std::vector<Lanes> last_step, last_move;
    std::vector<Lanes> residual_start;         ///< observed - predicted at the solution, of the drawn lengths
    std::vector<Lanes> residual;               ///< at the present parameters
    std::vector<Lanes> prior_observed;         ///< minus the value at the solution
    std::vector<Lanes> axial_deviation;        ///< drawn, one a visit
    std::vector<Lanes> place, scale, stretch;  ///< of the stations
    std::vector<Lanes> point, turned, pull;    ///< of the reflectors, 3 each
    std::vector<Lanes> difference, distance, weighted, misclosure;
    std::vector<Lanes> border_gradient, border_step;
    std::vector<Lanes> pose_rotation;  ///< 9 an angle, minus the identity
    std::vector<Lanes> errors;         ///< 6 an angle, in the datum
    std::array<Lanes, 10> change{};
    std::array<Lanes, 6> world{}, set_up{};
    Lanes size{};    ///< of the last step, in parts of the standard uncertainty
    Lanes active{};  ///< 1: not converged yet
};

TrialNetwork::TrialNetwork(const JointAdjustment& solved, const StochasticModel& stochastic, bool with_positions) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    const Adjustment& adjustment = solved.adjustment();
    least_squares = adjustment;
    stations = static_cast<Index>(measurement.stations.size());
    reflectors = static_cast<Index>(measurement.reflectors.size());
    angles = static_cast<Index>(measurement.angles.size());
    const auto append = [&](Adjustment::BlockId block) {
        const Eigen::VectorXd& value = adjustment.parameters(block);
        nominal.insert(nominal.end(), value.begin(), value.end());
    };
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        append(solved.station_block(j));
    }
    paths = static_cast<Index>(nominal.size());
    for (std::size_t d = 0; d < measurement.dead_paths.size(); ++d) {
        append(solved.dead_path_block(d));
    }
    fixture = static_cast<Index>(nominal.size());
    append(solved.fixture_block());
    expansion = static_cast<Index>(nominal.size());
    append(solved.expansion_block());
    reversal = static_cast<Index>(nominal.size());
    append(solved.reversal_block());
    poses = static_cast<Index>(nominal.size());
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        append(solved.pose_block(i));
    }
    slots = static_cast<Index>(nominal.size());

    take_visits(solved, with_positions, stochastic);
    take_priors(solved);
    take_normal_equations(solved);
    take_datum(solved);
}

void TrialNetwork::take_visits(const JointAdjustment& solved, bool with_positions, const StochasticModel& stochastic) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    const std::vector<Visit>& of_adjustment = solved.visits();
    const NormalEquations normal = solved.adjustment().linearise();
    const VisitPositionGains positions =
        with_positions ? visit_position_gains(solved, stochastic) : VisitPositionGains{};
    const auto order = repeatability_order(measurement.axis);
    const auto half_sense = [&](const Visit& visit) {
        return !solved.has_reversal() ? 0.0 : (visit.approach == Approach::positive ? 0.5 : -0.5);
    };
    std::vector<Index> first_input;
    Index input = 0;
    std::vector<std::size_t> sequence;
    for (std::size_t v = 0; v < of_adjustment.size(); ++v) {
        first_input.push_back(input);
        input += static_cast<Index>(of_adjustment[v].observations.size());
        sequence.push_back(v);
    }
    std::stable_sort(sequence.begin(), sequence.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(of_adjustment[a].angle, half_sense(of_adjustment[a])) <
               std::pair(of_adjustment[b].angle, half_sense(of_adjustment[b]));
    });
    for (const std::size_t v : sequence) {
        const Visit& visit = of_adjustment[v];
        const double half = half_sense(visit);
        const Index pose = poses + 6 * static_cast<Index>(visit.angle);
        const Eigen::Matrix3d rotation = nominal_rotation(measurement, visit.angle);
        const Eigen::Matrix3d to_table = rotation * solved.set_up().rotation;
        const Eigen::Vector3d offset = rotation * solved.set_up().translation;
        if (turns.empty() || turns.back().pose != pose || turns.back().half_sense != half) {
            Turn turn{};
            for (int r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) {
                    turn.to_table[static_cast<std::size_t>(3 * r + c)] = to_table(r, c);
                }
                turn.offset[static_cast<std::size_t>(r)] = offset[r];
            }
            turn.pose = pose;
            turn.half_sense = half;
            turn.begin = visits.size();
            turns.push_back(turn);
        }
        turns.back().end = visits.size() + 1;

        VisitPlan plan{};
        plan.number = v;
        plan.first = static_cast<Index>(lengths.size());
        plan.count = static_cast<Index>(visit.observations.size());
        plan.first_input = first_input[v];
        plan.station = static_cast<Index>(visit.station);
        plan.angle = static_cast<Index>(visit.angle);
        plan.half_sense = half;
        plan.weights = weights.size();
        plan.to_length = to_length.size();
        plan.gain = gains.size();
        const Eigen::MatrixXd weight = weight_matrix(normal.groups()[v].cholesky);
        weights.insert(weights.end(), weight.data(), weight.data() + weight.size());  // symmetric
        plan.is_diagonal = weight.isDiagonal(0.0);
        const Eigen::MatrixXd by_pose = solved.pose_jacobian(v);
        for (Index k = 0; k < plan.count; ++k) {
            for (const int component : order) {
                to_length.push_back(-by_pose(k, component));
            }
        }
        if (with_positions && positions.determined(v)) {
            plan.is_determined = true;
            gains.insert(gains.end(), positions.gains[v].begin(), positions.gains[v].end());
        }
        largest_visit = std::max(largest_visit, plan.count);

        Vector6 motion;
        for (int c = 0; c < 6; ++c) {
            motion[c] = nominal_at(pose + c) + half * nominal_at(reversal + c);
        }
        const RigidMotion error = rigid_motion(motion);
        const double stretch = 1.0 + nominal_at(expansion) * nominal_at(station_slot(plan.station, k_temperature));
        const Eigen::Vector3d station(nominal_at(station_slot(plan.station, 0)),
                                      nominal_at(station_slot(plan.station, 1)),
                                      nominal_at(station_slot(plan.station, 2)));
        const Eigen::VectorXd residual = solved.adjustment().residual(v);
        length_residual.insert(length_residual.end(), residual.begin(), residual.end());
        for (const std::size_t observation : visit.observations) {
            const LengthObservation& observed = measurement.lengths[observation];
            const auto reflector = static_cast<Index>(observed.reflector);
            const Eigen::Vector3d point(nominal_at(fixture + 3 * reflector), nominal_at(fixture + 3 * reflector + 1),
                                        nominal_at(fixture + 3 * reflector + 2));
            const Eigen::Vector3d difference =
                stretch * (error.rotation * to_table * point) + error.rotation * offset + error.translation - station;
            Length length{};
            length.difference = {difference[0], difference[1], difference[2]};
            length.distance = difference.norm();
            length.inverse_square = 1.0 / difference.squaredNorm();
            length.reflector = reflector;
            length.path_slot = paths + static_cast<Index>(observed.dead_path);
            lengths.push_back(length);
        }
        visits.push_back(plan);
    }
}

void TrialNetwork::take_priors(const JointAdjustment& solved) {
    const NormalEquations normal = solved.adjustment().linearise();
    std::size_t taken = visits.size();
    const auto take = [&](std::size_t group, std::vector<Index> of) {
        const auto first = static_cast<Index>(prior_residual.size());
        const Eigen::VectorXd residual = solved.adjustment().residual(group);
        prior_residual.insert(prior_residual.end(), residual.begin(), residual.end());
        priors.push_back({std::move(of), weight_matrix(normal.groups()[group].cholesky), first, group});
        ++taken;
        return first;
    };
    std::vector<Index> coordinates;
    for (Index c = 0; c < 3 * reflectors; ++c) {
        coordinates.push_back(fixture + c);
    }
    fixture_prior = take(solved.fixture_prior(), std::move(coordinates));
    if (solved.expansion_prior() != JointAdjustment::k_none) {
        expansion_prior = take(solved.expansion_prior(), {expansion});
    }
    for (Index j = 0; j < stations; ++j) {
        const auto at = static_cast<std::size_t>(j);
        scale_priors.push_back(solved.scale_prior(at) == JointAdjustment::k_none
                                   ? -1
                                   : take(solved.scale_prior(at), {station_slot(j, k_scale)}));
        temperature_priors.push_back(solved.temperature_prior(at) == JointAdjustment::k_none
                                         ? -1
                                         : take(solved.temperature_prior(at), {station_slot(j, k_temperature)}));
    }
    if (taken != normal.groups().size()) {
        throw std::logic_error("rotary table trials: the adjustment has observations that are not of the measurement");
    }
}

void TrialNetwork::take_normal_equations(const JointAdjustment& solved) {
    const NormalEquations normal = solved.adjustment().linearise();
    const Index p = normal.parameter_count();
    // Where each free parameter is: slot, and angle of the pose that it belongs to or -1, and place in there.
    std::vector<Index> slot(static_cast<std::size_t>(p), -1);
    std::vector<Index> angle(slot.size(), -1);
    std::vector<Index> place(slot.size(), -1);
    const auto locate = [&](Adjustment::BlockId block, Index first, int size, Index of_angle) {
        for (int c = 0; c < size; ++c) {
            if (const Index column = normal.column(block, c); column >= 0) {
                slot[static_cast<std::size_t>(column)] = first + c;
                angle[static_cast<std::size_t>(column)] = of_angle;
            }
        }
    };
    for (Index j = 0; j < stations; ++j) {
        locate(solved.station_block(static_cast<std::size_t>(j)), station_slot(j, 0), k_station_size, -1);
    }
    for (Index d = 0; d < fixture - paths; ++d) {
        locate(solved.dead_path_block(static_cast<std::size_t>(d)), paths + d, 1, -1);
    }
    locate(solved.fixture_block(), fixture, static_cast<int>(3 * reflectors), -1);
    locate(solved.expansion_block(), expansion, 1, -1);
    locate(solved.reversal_block(), reversal, 6, -1);
    for (Index i = 0; i < angles; ++i) {
        locate(solved.pose_block(static_cast<std::size_t>(i)), poses + 6 * i, 6, i);
    }
    std::vector<Index> size(static_cast<std::size_t>(angles), 0);
    for (std::size_t column = 0; column < slot.size(); ++column) {
        if (angle[column] < 0) {
            place[column] = static_cast<Index>(border.size());
            border.push_back(slot[column]);
        } else {
            place[column] = size[static_cast<std::size_t>(angle[column])]++;
        }
    }

    const auto border_size = static_cast<Index>(border.size());
    Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(border_size, border_size);
    std::vector<Eigen::MatrixXd> own;
    std::vector<Eigen::MatrixXd> cross;
    for (const Index n : size) {
        own.emplace_back(Eigen::MatrixXd::Zero(n, n));
        cross.emplace_back(Eigen::MatrixXd::Zero(n, border_size));
    }
    for (const LinearisedGroup& group : normal.groups()) {
        const Eigen::MatrixXd product = group.jacobian.transpose() * group.jacobian;
        for (Index k = 0; k < product.cols(); ++k) {
            const auto ck = static_cast<std::size_t>(group.columns[static_cast<std::size_t>(k)]);
            for (Index i = 0; i < product.rows(); ++i) {
                const auto ci = static_cast<std::size_t>(group.columns[static_cast<std::size_t>(i)]);
                if (angle[ci] < 0 && angle[ck] < 0) {
                    reduced(place[ci], place[ck]) += product(i, k);
                } else if (angle[ci] >= 0 && angle[ck] < 0) {
                    cross[static_cast<std::size_t>(angle[ci])](place[ci], place[ck]) += product(i, k);
                } else if (angle[ci] >= 0 && angle[ck] >= 0) {
                    own[static_cast<std::size_t>(angle[ci])](place[ci], place[ck]) += product(i, k);
                }
            }
        }
    }
    const auto invert = [](const Eigen::MatrixXd& matrix) -> Eigen::MatrixXd {
        // Scaled to a unit diagonal first: metres, radians and scales differ by many powers of ten.
        const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * matrix * scale.asDiagonal());
        if (factor.info() != Eigen::Success) {
            throw gum::NoResultError(
                gum::Diagnostic{"GC-ADJUST-0002", "rotary table trials", "the normal equations are singular",
                                "trials can be solved only where the observations determine every parameter",
                                "check the rank report, add stations, reflectors or angles", gum::Severity::error});
        }
        const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.rows()));
        return scale.asDiagonal() * (0.5 * (inverse + inverse.transpose())) * scale.asDiagonal();
    };
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (size[i] == 0) {
            continue;
        }
        Elimination elimination;
        elimination.inverse = invert(own[i]);
        elimination.to_pose = -(elimination.inverse * cross[i]);
        elimination.to_border = elimination.to_pose.transpose();
        reduced += elimination.to_border * cross[i];
        eliminated.push_back(std::move(elimination));
    }
    if (border_size > 0) {
        border_covariance = invert(reduced);
    }

    for (Index b = 0; b < border_size; ++b) {
        free_slots.push_back(border[static_cast<std::size_t>(b)]);
        free_parameters.push_back(normal.parameters()[static_cast<std::size_t>(b)]);
        inverse_u.push_back(1.0 / std::sqrt(border_covariance(b, b)));
    }
    std::size_t next = 0;
    std::size_t column = border.size();  // the poses follow the border, angle by angle
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (size[i] == 0) {
            continue;
        }
        Elimination& elimination = eliminated[next++];
        const RowMajorMatrix spread = elimination.to_pose * border_covariance;
        for (Index c = 0; c < size[i]; ++c, ++column) {
            elimination.slots.push_back(slot[column]);
            free_slots.push_back(slot[column]);
            free_parameters.push_back(normal.parameters()[column]);
            inverse_u.push_back(1.0 /
                                std::sqrt(elimination.inverse(c, c) + spread.row(c).dot(elimination.to_pose.row(c))));
        }
    }
}

void TrialNetwork::take_datum(const JointAdjustment& solved) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    datum = measurement.datum;
    home = static_cast<Index>(measurement.home);
    const int axis = axial_coordinate(measurement.axis);
    cyclic = {axis, (axis + 1) % 3, (axis + 2) % 3};
    for (const double angle : measurement.angles) {
        const double turn = angle - measurement.angles[measurement.home];
        cosine.push_back(std::cos(turn));
        sine.push_back(std::sin(turn));
    }
    const DatumSolution solution = transform_to_datum(measurement, solved.poses(), solved.set_up(), datum);
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            set_up_rotation[static_cast<std::size_t>(3 * r + c)] =
                solved.set_up().rotation(r, c) - (r == c ? 1.0 : 0.0);
        }
        set_up_translation[static_cast<std::size_t>(r)] = solved.set_up().translation[r];
    }
    start_world = motion_parameters(solution.world);
    start_set_up = solution.set_up;
    change_map.resize(10, 6 * angles);
    change_map << solution.world_map, solution.set_up_map;
}

namespace {

/// The parameters of the trials where they are needed as such.
GUMCERT_WIDE_CLONES
void prepare(const TrialNetwork& network, TrialWork& work) {
    const Lanes* delta = work.delta.data();
    const Lanes& expansion = delta[network.expansion];
    const double nominal_expansion = network.nominal_at(network.expansion);
    for (Index j = 0; j < network.stations; ++j) {
        const Index first = network.station_slot(j, 0);
        for (Index c = 0; c < 3; ++c) {
            const double nominal = network.nominal_at(first + c);
            Lanes& place = work.place[static_cast<std::size_t>(3 * j + c)];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                place[t] = nominal + delta[first + c][t];
            }
        }
        const double nominal_scale = 1.0 + network.nominal_at(first + k_scale);
        const double nominal_temperature = network.nominal_at(first + k_temperature);
        Lanes& scale = work.scale[static_cast<std::size_t>(j)];
        Lanes& stretch = work.stretch[static_cast<std::size_t>(j)];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            scale[t] = nominal_scale + delta[first + k_scale][t];
            stretch[t] =
                1.0 + (nominal_expansion + expansion[t]) * (nominal_temperature + delta[first + k_temperature][t]);
        }
    }
    for (Index c = 0; c < 3 * network.reflectors; ++c) {
        const double nominal = network.nominal_at(network.fixture + c);
        Lanes& point = work.point[static_cast<std::size_t>(c)];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            point[t] = nominal + delta[network.fixture + c][t];
        }
    }
    for (Lanes& gradient : work.gradient) {
        fill(gradient, 0.0);
    }
}

/// √(1 + z) - 1, by its power series up to 2⁻⁹, where the first term left out is below 2⁻⁵⁸ of the sum.
GUMCERT_INLINE double small_root(double z) {
    return z * (0.5 + z * (-0.125 + z * (0.0625 + z * (-5.0 / 128.0 + z * (7.0 / 256.0 + z * (-21.0 / 1024.0))))));
}

/// Differences, distances and residuals of the lengths of one visit.
///
/// d - d0 comes from the change of P - q by (P - q)² - (P0 - q0)²: no digits are lost to the distance itself.
GUMCERT_INLINE void predict_visit(const TrialNetwork& network, const TrialNetwork::VisitPlan& visit, const Lanes* base,
                                  const TrialWork& work, Lanes* differences, Lanes* distances, Lanes* residuals) {
    constexpr double k_small = 0x1p-9;
    const Lanes& stretch = work.stretch[static_cast<std::size_t>(visit.station)];
    const Lanes& scale = work.scale[static_cast<std::size_t>(visit.station)];
    const Lanes& scale_change = work.delta[static_cast<std::size_t>(network.station_slot(visit.station, k_scale))];
    for (Index k = 0; k < visit.count; ++k) {
        const TrialNetwork::Length length = network.lengths[static_cast<std::size_t>(visit.first + k)];
        const Lanes* turned = &work.turned[static_cast<std::size_t>(3 * length.reflector)];
        const Lanes& path_change = work.delta[static_cast<std::size_t>(length.path_slot)];
        const Lanes& start = work.residual_start[static_cast<std::size_t>(visit.first + k)];
        Lanes* difference = differences + 3 * k;
        Lanes& distance = distances[k];
        Lanes& residual = residuals[k];
        Lanes growth;  // of the squared distance, in parts of it
        std::int64_t large = 0;
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double x = stretch[t] * turned[0][t] + base[0][t];
            const double y = stretch[t] * turned[1][t] + base[1][t];
            const double z = stretch[t] * turned[2][t] + base[2][t];
            difference[0][t] = x;
            difference[1][t] = y;
            difference[2][t] = z;
            const double square = (x - length.difference[0]) * (x + length.difference[0]) +
                                  (y - length.difference[1]) * (y + length.difference[1]) +
                                  (z - length.difference[2]) * (z + length.difference[2]);
            growth[t] = square * length.inverse_square;
            distance[t] = length.distance * small_root(growth[t]);
        }
        for (int t = 0; t < k_lanes; ++t) {
            large |= growth[t] > k_small || growth[t] < -k_small ? 1 : 0;
        }
        for (int t = 0; t < k_lanes && large != 0; ++t) {
            if (std::abs(growth[t]) > k_small) {
                distance[t] = length.distance * (growth[t] / (1.0 + std::sqrt(1.0 + growth[t])));
            }
        }
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double longer = distance[t];
            residual[t] = start[t] - (scale[t] * longer + scale_change[t] * length.distance - path_change[t]);
            distance[t] = length.distance + longer;
        }
    }
}

/// Jᵀ V⁻¹ v of the lengths of one visit: what they press on each parameter.
GUMCERT_INLINE void add_visit(const TrialNetwork& network, const TrialNetwork::VisitPlan& visit, const Lanes* pose,
                              TrialWork& work, Lanes* turn_force, Lanes* turn_torque) {
    const Index first = network.station_slot(visit.station, 0);
    const Lanes* place = &work.place[static_cast<std::size_t>(3 * visit.station)];
    const Lanes& stretch = work.stretch[static_cast<std::size_t>(visit.station)];
    const Lanes& scale = work.scale[static_cast<std::size_t>(visit.station)];
    Lanes* gradient = work.gradient.data();
    std::array<Lanes, 3> space;
    Lanes* const force = space.data();
    Lanes along;  // of the pulls in direction of the reflectors, as the expansion acts
    fill(force[0], 0.0);
    fill(force[1], 0.0);
    fill(force[2], 0.0);
    fill(along, 0.0);
    for (Index k = 0; k < visit.count; ++k) {
        const TrialNetwork::Length& length = network.lengths[static_cast<std::size_t>(visit.first + k)];
        const Lanes& weighted = work.weighted[static_cast<std::size_t>(k)];
        const Lanes& distance = work.distance[static_cast<std::size_t>(k)];
        const Lanes* difference = &work.difference[static_cast<std::size_t>(3 * k)];
        const Lanes* turned = &work.turned[static_cast<std::size_t>(3 * length.reflector)];
        Lanes* pull = &work.pull[static_cast<std::size_t>(3 * length.reflector)];
        Lanes& path = gradient[length.path_slot];
        Lanes& by_scale = gradient[first + k_scale];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double press = weighted[t] * scale[t] / distance[t];
            const double x = press * difference[0][t];
            const double y = press * difference[1][t];
            const double z = press * difference[2][t];
            force[0][t] += x;
            force[1][t] += y;
            force[2][t] += z;
            const double arm_x = difference[0][t] + (place[0][t] - pose[0][t]);
            const double arm_y = difference[1][t] + (place[1][t] - pose[1][t]);
            const double arm_z = difference[2][t] + (place[2][t] - pose[2][t]);
            turn_torque[0][t] += arm_y * z - arm_z * y;
            turn_torque[1][t] += arm_z * x - arm_x * z;
            turn_torque[2][t] += arm_x * y - arm_y * x;
            along[t] += x * turned[0][t] + y * turned[1][t] + z * turned[2][t];
            pull[0][t] += stretch[t] * x;
            pull[1][t] += stretch[t] * y;
            pull[2][t] += stretch[t] * z;
            path[t] -= weighted[t];
            by_scale[t] += weighted[t] * distance[t];
        }
    }
    const double nominal_expansion = network.nominal_at(network.expansion);
    const double nominal_temperature = network.nominal_at(first + k_temperature);
    const Lanes& expansion = work.delta[static_cast<std::size_t>(network.expansion)];
    const Lanes& temperature = work.delta[static_cast<std::size_t>(first + k_temperature)];
    Lanes& by_expansion = gradient[network.expansion];
    Lanes* by_station = gradient + first;
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        turn_force[0][t] += force[0][t];
        turn_force[1][t] += force[1][t];
        turn_force[2][t] += force[2][t];
        by_station[0][t] -= force[0][t];
        by_station[1][t] -= force[1][t];
        by_station[2][t] -= force[2][t];
        by_station[k_temperature][t] += along[t] * (nominal_expansion + expansion[t]);
        by_expansion[t] += along[t] * (nominal_temperature + temperature[t]);
    }
}

/// Lengths of all visits of one angle in one sense: residuals, or residuals and gradient.
GUMCERT_WIDE_CLONES
void add_turn(const TrialNetwork& network, const TrialNetwork::Turn& turn, bool with_gradient, TrialWork& work) {
    std::array<Lanes, 42> space;
    Lanes* const pose = space.data();
    Lanes* const rotation = pose + 6;      // of E
    Lanes* const to_world = rotation + 9;  // from the fixture
    Lanes* const shift = to_world + 9;
    Lanes* const force = shift + 3;
    Lanes* const torque = force + 3;
    Lanes* const base = torque + 3;
    Lanes* const motion = base + 3;
    const Lanes* delta = work.delta.data();
    for (int c = 0; c < 6; ++c) {
        const double nominal =
            network.nominal_at(turn.pose + c) + turn.half_sense * network.nominal_at(network.reversal + c);
        const Lanes& change = delta[turn.pose + c];
        const Lanes& reversal = delta[network.reversal + c];
        Lanes& to = pose[c];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            to[t] = nominal + (change[t] + turn.half_sense * reversal[t]);
        }
    }
    rotation_from_identity(pose + 3, rotation);
    for (const std::size_t diagonal : {std::size_t{0}, std::size_t{4}, std::size_t{8}}) {
        for (int t = 0; t < k_lanes; ++t) {
            rotation[diagonal][t] += 1.0;
        }
    }
    for (std::size_t r = 0; r < 3; ++r) {
        const Lanes* row = &rotation[3 * r];
        for (std::size_t c = 0; c < 3; ++c) {
            const double q0 = turn.to_table[c];
            const double q1 = turn.to_table[3 + c];
            const double q2 = turn.to_table[6 + c];
            Lanes& to = to_world[3 * r + c];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = row[0][t] * q0 + row[1][t] * q1 + row[2][t] * q2;
            }
        }
        const double b0 = turn.offset[0];
        const double b1 = turn.offset[1];
        const double b2 = turn.offset[2];
        const Lanes& translation = pose[r];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            shift[r][t] = row[0][t] * b0 + row[1][t] * b1 + row[2][t] * b2 + translation[t];
        }
    }
    for (std::size_t m = 0; m < work.point.size(); m += 3) {
        const Lanes* point = &work.point[m];
        for (std::size_t r = 0; r < 3; ++r) {
            const Lanes* row = &to_world[3 * r];
            Lanes& to = work.turned[m + r];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = row[0][t] * point[0][t] + row[1][t] * point[1][t] + row[2][t] * point[2][t];
            }
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        fill(force[c], 0.0);
        fill(torque[c], 0.0);
    }
    for (Lanes& pull : work.pull) {
        fill(pull, 0.0);
    }

    for (std::size_t v = turn.begin; v < turn.end; ++v) {
        const TrialNetwork::VisitPlan& visit = network.visits[v];
        const Lanes* place = &work.place[static_cast<std::size_t>(3 * visit.station)];
        for (std::size_t c = 0; c < 3; ++c) {
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                base[c][t] = shift[c][t] - place[c][t];
            }
        }
        Lanes* residual =
            with_gradient ? work.misclosure.data() : &work.residual[static_cast<std::size_t>(visit.first)];
        predict_visit(network, visit, base, work, work.difference.data(), work.distance.data(), residual);
        if (!with_gradient) {
            continue;
        }
        const double* weights = &network.weights[visit.weights];
        for (Index k = 0; k < visit.count; ++k) {
            Lanes& weighted = work.weighted[static_cast<std::size_t>(k)];
            fill(weighted, 0.0);
            if (visit.is_diagonal) {
                add_combination(weights + k * (visit.count + 1), 1, residual + k, weighted);
            } else {
                add_combination(weights + k * visit.count, visit.count, residual, weighted);
            }
        }
        add_visit(network, visit, pose, work, force, torque);
    }
    if (!with_gradient) {
        return;
    }

    // Rotations turn about the axes Rz(c) Ry(b) x, Rz(c) y and z, all through the origin of the table: the torque about
    // each is the derivative.
    Lanes sine;
    Lanes versine;
    sine_and_versine(pose[5], sine, versine);
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        motion[0][t] = force[0][t];
        motion[1][t] = force[1][t];
        motion[2][t] = force[2][t];
        motion[3][t] = rotation[0][t] * torque[0][t] + rotation[3][t] * torque[1][t] + rotation[6][t] * torque[2][t];
        motion[4][t] = (1.0 - versine[t]) * torque[1][t] - sine[t] * torque[0][t];
        motion[5][t] = torque[2][t];
    }
    for (int c = 0; c < 6; ++c) {
        Lanes& by_pose = work.gradient[static_cast<std::size_t>(turn.pose + c)];
        Lanes& by_reversal = work.gradient[static_cast<std::size_t>(network.reversal + c)];
        const Lanes& from = motion[c];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            by_pose[t] += from[t];
            by_reversal[t] += turn.half_sense * from[t];
        }
    }
    for (std::size_t m = 0; m < work.pull.size(); m += 3) {
        const Lanes* pull = &work.pull[m];
        for (std::size_t c = 0; c < 3; ++c) {
            Lanes& to = work.gradient[static_cast<std::size_t>(network.fixture) + m + c];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] +=
                    to_world[c][t] * pull[0][t] + to_world[3 + c][t] * pull[1][t] + to_world[6 + c][t] * pull[2][t];
            }
        }
    }
}

/// The same of the prior values.
GUMCERT_WIDE_CLONES
void add_priors(const TrialNetwork& network, TrialWork& work) {
    for (const TrialNetwork::Prior& prior : network.priors) {
        const std::size_t size = prior.slots.size();
        for (std::size_t i = 0; i < size; ++i) {
            const Lanes& observed = work.prior_observed[static_cast<std::size_t>(prior.first) + i];
            const Lanes& delta = work.delta[static_cast<std::size_t>(prior.slots[i])];
            Lanes& misclosure = work.misclosure[i];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                misclosure[t] = observed[t] - delta[t];
            }
        }
        for (std::size_t i = 0; i < size; ++i) {
            add_combination(prior.weights.data() + i * size, static_cast<Index>(size), work.misclosure.data(),
                            work.gradient[static_cast<std::size_t>(prior.slots[i])]);
        }
    }
}

/// N⁻¹ times the gradient, and its largest element in parts of the standard uncertainty.
GUMCERT_WIDE_CLONES
void find_step(const TrialNetwork& network, TrialWork& work) {
    const auto border = static_cast<Index>(network.border.size());
    for (std::size_t b = 0; b < network.border.size(); ++b) {
        work.border_gradient[b] = work.gradient[static_cast<std::size_t>(network.border[b])];
        fill(work.border_step[b], 0.0);
    }
    std::array<Lanes, 6> own;
    std::array<Lanes, 6> step;
    const auto gather = [&](const TrialNetwork::Elimination& pose) {
        for (std::size_t i = 0; i < pose.slots.size(); ++i) {
            own[i] = work.gradient[static_cast<std::size_t>(pose.slots[i])];
        }
        return static_cast<Index>(pose.slots.size());
    };
    for (const TrialNetwork::Elimination& pose : network.eliminated) {
        const Index size = gather(pose);
        multiply_add(pose.to_border.data(), border, size, own.data(), work.border_gradient.data());
    }
    multiply_add(network.border_covariance.data(), border, border, work.border_gradient.data(),
                 work.border_step.data());
    for (std::size_t b = 0; b < network.border.size(); ++b) {
        work.step[static_cast<std::size_t>(network.border[b])] = work.border_step[b];
    }
    for (const TrialNetwork::Elimination& pose : network.eliminated) {
        const Index size = gather(pose);
        for (Lanes& lanes : step) {
            fill(lanes, 0.0);
        }
        multiply_add(pose.inverse.data(), size, size, own.data(), step.data());
        multiply_add(pose.to_pose.data(), size, border, work.border_step.data(), step.data());
        for (std::size_t i = 0; i < pose.slots.size(); ++i) {
            work.step[static_cast<std::size_t>(pose.slots[i])] = step[i];
        }
    }
    fill(work.size, 0.0);
    for (std::size_t i = 0; i < network.free_slots.size(); ++i) {
        const Lanes& of_slot = work.step[static_cast<std::size_t>(network.free_slots[i])];
        const double inverse_u = network.inverse_u[i];
        Lanes& largest = work.size;
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double size = std::abs(of_slot[t]) * inverse_u;
            largest[t] = largest[t] >= size ? largest[t] : size;  // NaN does not pass for small
        }
    }
}

/// Moves the trials that have not converged yet.
///
/// From the second step on, what the last two steps have in common is taken away at once: x + s - γ (Δx + Δs), with γ
/// the least-squares solution of s ≈ γ Δs in parts of the standard uncertainties (Anderson 1965, one step back). It
/// helps where one combination of parameters converges slowly, as expansion times temperature does.
GUMCERT_WIDE_CLONES
void take_step(const TrialNetwork& network, bool is_first, TrialWork& work) {
    const Lanes active = work.active;
    Lanes product;
    Lanes square;
    fill(product, 0.0);
    fill(square, 0.0);
    for (std::size_t i = 0; i < network.free_slots.size() && !is_first; ++i) {
        const auto slot = static_cast<std::size_t>(network.free_slots[i]);
        const double weight = network.inverse_u[i] * network.inverse_u[i];
        const Lanes& step = work.step[slot];
        const Lanes& last = work.last_step[slot];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double change = step[t] - last[t];
            product[t] += weight * (step[t] * change);
            square[t] += weight * (change * change);
        }
    }
    Lanes share;
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        share[t] = square[t] > 0.0 ? product[t] / square[t] : 0.0;
    }
    for (const Index of : network.free_slots) {
        const auto slot = static_cast<std::size_t>(of);
        const Lanes& step = work.step[slot];
        Lanes& last_step = work.last_step[slot];
        Lanes& last_move = work.last_move[slot];
        Lanes& delta = work.delta[slot];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            const double move = step[t] - share[t] * (last_move[t] + (step[t] - last_step[t]));
            delta[t] += active[t] != 0.0 ? move : 0.0;
            last_move[t] = move;
            last_step[t] = step[t];
        }
    }
}

/// C = A B of rotations given by their differences from the identity.
GUMCERT_INLINE void multiply_rotations(const Lanes* a, const Lanes* b, Lanes* product) {
    for (int r = 0; r < 3; ++r) {
        const Lanes* row = a + 3 * r;
        for (int c = 0; c < 3; ++c) {
            const Lanes* column = b + c;
            Lanes& to = product[3 * r + c];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = row[c][t] + column[3 * r][t] +
                        (row[0][t] * column[0][t] + row[1][t] * column[3][t] + row[2][t] * column[6][t]);
            }
        }
    }
}

/// Start of the transformation: rotations of all poses, and the change of datum to first order.
GUMCERT_WIDE_CLONES
void begin_datum(const TrialNetwork& network, TrialWork& work) {
    std::array<Lanes, 3> angles;
    for (Index i = 0; i < network.angles; ++i) {
        const Index first = network.poses + 6 * i + 3;
        for (int c = 0; c < 3; ++c) {
            const double nominal = network.nominal_at(first + c);
            const Lanes& delta = work.delta[static_cast<std::size_t>(first + c)];
            Lanes& to = angles[static_cast<std::size_t>(c)];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                to[t] = nominal + delta[t];
            }
        }
        rotation_from_identity(angles.data(), &work.pose_rotation[static_cast<std::size_t>(9 * i)]);
    }
    for (Lanes& change : work.change) {
        fill(change, 0.0);
    }
    multiply_add(network.change_map.data(), 10, 6 * network.angles,
                 &work.delta[static_cast<std::size_t>(network.poses)], work.change.data());
    for (int c = 0; c < 6; ++c) {
        fill(work.world[static_cast<std::size_t>(c)], network.start_world[c]);
        fill(work.set_up[static_cast<std::size_t>(c)], network.start_set_up[c]);
    }
    fill(work.active, 1.0);
}

/// Changes world and set-up of the trials that have not converged yet.
GUMCERT_WIDE_CLONES
void change_datum(const TrialNetwork& network, TrialWork& work) {
    const Lanes active = work.active;
    const auto add = [&](const Lanes& change, Lanes& to) {
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            to[t] += active[t] != 0.0 ? change[t] : 0.0;
        }
    };
    for (std::size_t c = 0; c < 6; ++c) {
        add(work.change[c], work.world[c]);
    }
    for (std::size_t c = 0; c < 2; ++c) {
        const auto across = static_cast<std::size_t>(network.cyclic[1 + c]);
        add(work.change[6 + c], work.set_up[across]);
        add(work.change[8 + c], work.set_up[3 + across]);
    }
}

/// Error motions with respect to the present world and set-up, world E turn (set-up change)⁻¹ turn⁻¹, and the change
/// that they ask for.
GUMCERT_WIDE_CLONES
void compose_errors(const TrialNetwork& network, TrialWork& work) {
    std::array<Lanes, 81> space;
    Lanes* const world = space.data();
    Lanes* const new_set_up = world + 9;
    Lanes* const old_set_up = new_set_up + 9;
    Lanes* const inverse = old_set_up + 9;
    Lanes* const back = inverse + 9;  // old set-up times the inverse of the new one
    Lanes* const back_shift = back + 9;
    Lanes* const turned = back_shift + 3;  // `back` seen from the fixture at this angle
    Lanes* const turned_shift = turned + 9;
    Lanes* const moved = turned_shift + 3;
    Lanes* const moved_shift = moved + 9;
    Lanes* const result = moved_shift + 3;
    const Lanes* const world_motion = work.world.data();
    const Lanes* const set_up = work.set_up.data();
    rotation_from_identity(world_motion + 3, world);
    rotation_from_identity(set_up + 3, new_set_up);
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
            fill(old_set_up[3 * r + c], network.set_up_rotation[3 * r + c]);
            inverse[3 * r + c] = new_set_up[3 * c + r];
        }
    }
    multiply_rotations(old_set_up, inverse, back);
    for (std::size_t r = 0; r < 3; ++r) {
        const double old = network.set_up_translation[r];
        const Lanes* row = &back[3 * r];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            back_shift[r][t] =
                (old - set_up[r][t]) - (row[0][t] * set_up[0][t] + row[1][t] * set_up[1][t] + row[2][t] * set_up[2][t]);
        }
    }
    const auto a = static_cast<std::size_t>(network.cyclic[0]);
    const auto p = static_cast<std::size_t>(network.cyclic[1]);
    const auto q = static_cast<std::size_t>(network.cyclic[2]);
    for (Index i = 0; i < network.angles; ++i) {
        const double c = network.cosine[static_cast<std::size_t>(i)];
        const double s = network.sine[static_cast<std::size_t>(i)];
#pragma GCC ivdep
        for (int t = 0; t < k_lanes; ++t) {
            turned[3 * a + a][t] = back[3 * a + a][t];
            turned[3 * a + p][t] = c * back[3 * a + p][t] - s * back[3 * a + q][t];
            turned[3 * a + q][t] = s * back[3 * a + p][t] + c * back[3 * a + q][t];
            turned[3 * p + a][t] = c * back[3 * p + a][t] - s * back[3 * q + a][t];
            turned[3 * q + a][t] = s * back[3 * p + a][t] + c * back[3 * q + a][t];
            const double pp = c * back[3 * p + p][t] - s * back[3 * q + p][t];
            const double pq = c * back[3 * p + q][t] - s * back[3 * q + q][t];
            const double qp = s * back[3 * p + p][t] + c * back[3 * q + p][t];
            const double qq = s * back[3 * p + q][t] + c * back[3 * q + q][t];
            turned[3 * p + p][t] = c * pp - s * pq;
            turned[3 * p + q][t] = s * pp + c * pq;
            turned[3 * q + p][t] = c * qp - s * qq;
            turned[3 * q + q][t] = s * qp + c * qq;
            turned_shift[a][t] = back_shift[a][t];
            turned_shift[p][t] = c * back_shift[p][t] - s * back_shift[q][t];
            turned_shift[q][t] = s * back_shift[p][t] + c * back_shift[q][t];
        }
        const Index pose = network.poses + 6 * i;
        multiply_rotations(world, &work.pose_rotation[static_cast<std::size_t>(9 * i)], moved);
        const Lanes* delta = &work.delta[static_cast<std::size_t>(pose)];
        const double x = network.nominal_at(pose);
        const double y = network.nominal_at(pose + 1);
        const double z = network.nominal_at(pose + 2);
        for (std::size_t r = 0; r < 3; ++r) {
            const Lanes* row = &world[3 * r];
            const double own = network.nominal_at(pose + static_cast<Index>(r));
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                moved_shift[r][t] =
                    world_motion[r][t] + (own + delta[r][t]) +
                    (row[0][t] * (x + delta[0][t]) + row[1][t] * (y + delta[1][t]) + row[2][t] * (z + delta[2][t]));
            }
        }
        multiply_rotations(moved, turned, result);
        Lanes* errors = &work.errors[static_cast<std::size_t>(6 * i)];
        for (std::size_t r = 0; r < 3; ++r) {
            const Lanes* row = &moved[3 * r];
#pragma GCC ivdep
            for (int t = 0; t < k_lanes; ++t) {
                errors[r][t] =
                    moved_shift[r][t] + turned_shift[r][t] +
                    (row[0][t] * turned_shift[0][t] + row[1][t] * turned_shift[1][t] + row[2][t] * turned_shift[2][t]);
            }
        }
        angles_from_rotation(result, errors + 3);
    }
    for (Lanes& change : work.change) {
        fill(change, 0.0);
    }
    multiply_add(network.change_map.data(), 10, 6 * network.angles, work.errors.data(), work.change.data());
}

/// Drawn lengths of one visit against those of the solution: residual there + noise + resolution - A δ.
GUMCERT_WIDE_CLONES
void draw_visit(const TrialNetwork& network, const TrialNetwork::VisitPlan& visit, const Lanes* deviation,
                TrialWork& work) {
    multiply_add(&network.to_length[visit.to_length], visit.count, 6, deviation,
                 &work.residual_start[static_cast<std::size_t>(visit.first)]);
}

bool any_active(const Lanes& active) {
    return std::any_of(active.at.begin(), active.at.end(), [](double lane) { return lane != 0.0; });
}

/// How a trial was solved.
struct TrialEnd {
    int steps = 0;
    bool converged = false;
    bool alone = false;
};

/// One trial by Gauss-Newton steps with normal equations of its own.
TrialEnd solve_alone(const TrialNetwork& network, int lane, TrialWork& work) {
    Adjustment alone = network.least_squares;
    for (const TrialNetwork::VisitPlan& visit : network.visits) {
        const double scale = 1.0 + network.nominal_at(network.station_slot(visit.station, k_scale));
        Eigen::VectorXd observed(visit.count);
        for (Index k = 0; k < visit.count; ++k) {
            const auto at = static_cast<std::size_t>(visit.first + k);
            const TrialNetwork::Length& length = network.lengths[at];
            const double predicted = scale * length.distance - network.nominal_at(length.path_slot);
            observed[k] = predicted + work.residual_start[at][lane];
        }
        alone.set_observed(visit.number, std::move(observed));
    }
    for (const TrialNetwork::Prior& prior : network.priors) {
        Eigen::VectorXd observed(static_cast<Index>(prior.slots.size()));
        for (Index i = 0; i < observed.size(); ++i) {
            observed[i] = network.nominal_at(prior.slots[static_cast<std::size_t>(i)]) +
                          work.prior_observed[static_cast<std::size_t>(prior.first + i)][lane];
        }
        alone.set_observed(prior.group, std::move(observed));
    }
    const SolveSummary summary = alone.refine(SolverOptions{});
    for (std::size_t i = 0; i < network.free_slots.size(); ++i) {
        const FreeParameter& parameter = network.free_parameters[i];
        const auto slot = static_cast<std::size_t>(network.free_slots[i]);
        work.delta[slot][lane] = alone.parameters(parameter.block)[parameter.component] - network.nominal[slot];
    }
    return {summary.iterations, summary.converged, true};
}

/// Solves 16 trials, of which `count` are wanted.
std::array<TrialEnd, k_lanes> solve(const TrialNetwork& network, const TrialOptions& options, Index count,
                                    TrialWork& work) {
    std::array<TrialEnd, k_lanes> ends;
    for (std::vector<Lanes>* lanes : {&work.delta, &work.last_step, &work.last_move}) {
        std::fill(lanes->begin(), lanes->end(), Lanes{});
    }
    for (int t = 0; t < k_lanes; ++t) {
        work.active[t] = t < count ? 1.0 : 0.0;
    }
    for (int number = 1; number <= options.most_steps && any_active(work.active); ++number) {
        prepare(network, work);
        for (const TrialNetwork::Turn& turn : network.turns) {
            add_turn(network, turn, true, work);
        }
        add_priors(network, work);
        find_step(network, work);
        take_step(network, number == 1, work);
        for (int t = 0; t < k_lanes; ++t) {
            if (work.active[t] != 0.0 && work.size[t] <= options.step_tolerance) {
                work.active[t] = 0.0;
                ends[static_cast<std::size_t>(t)] = {number, true, false};
            }
        }
    }
    for (int t = 0; t < k_lanes; ++t) {
        if (work.active[t] != 0.0) {
            TrialEnd& end = ends[static_cast<std::size_t>(t)];
            end = solve_alone(network, t, work);
            end.steps += options.most_steps;
        }
    }
    return ends;
}

/// The errors in the datum, as `transform_to_datum` finds them.
void transform(const TrialNetwork& network, TrialWork& work) {
    constexpr double k_negligible = 1e-16;  // [m] and [rad]
    begin_datum(network, work);
    change_datum(network, work);
    for (int iteration = 0; iteration < 20; ++iteration) {
        compose_errors(network, work);
        for (int t = 0; t < k_lanes; ++t) {
            double largest = 0.0;
            for (const Lanes& change : work.change) {
                largest = std::max(largest, std::abs(change[t]));
            }
            work.active[t] = work.active[t] != 0.0 && largest >= k_negligible ? 1.0 : 0.0;
        }
        if (!any_active(work.active)) {
            break;
        }
        change_datum(network, work);
    }
    if (network.datum == Datum::home) {
        for (Index c = 0; c < 6; ++c) {
            fill(work.errors[static_cast<std::size_t>(6 * network.home + c)], 0.0);
        }
    }
}

/// Rows first … first + count of one input; lanes without a row repeat the last one.
void load(const Eigen::Ref<const Eigen::MatrixXd>& x, Index column, Index first, Index count, Lanes& to) {
    const double* from = x.data() + column * x.outerStride() + first;
    std::copy_n(from, count, to.at.begin());
    std::fill(to.at.begin() + count, to.at.end(), from[count - 1]);
}

Lanes variance_factor(const Eigen::Ref<const Eigen::MatrixXd>& x, Index column, Index first, Index count) {
    Lanes factor;
    fill(factor, 1.0);
    if (column >= 0) {
        load(x, column, first, count, factor);
        for (double& lane : factor.at) {
            lane = 1.0 / std::sqrt(lane);
        }
    }
    return factor;
}

/// sum += factor × deviation
GUMCERT_WIDE_CLONES
void add_product(const Lanes& factor, const Lanes& deviation, Lanes& sum) {
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        sum[t] += factor[t] * deviation[t];
    }
}

JointAdjustment with_free_dead_paths(const RotaryTableModel& model) {
    const JointAdjustment& solved = model.solved();
    JointAdjustment joint(model.measurement(), solved.active(), solved.set_up(), solved.present_values(),
                          model.stochastic());
    joint.copy_parameters_from(solved);
    joint.set_weights(model.stochastic());
    return joint;
}

SourceDegreesOfFreedom degrees_of_freedom_of(const RotaryTableModel& model) {
    SourceDegreesOfFreedom nu{k_infinity, k_infinity, k_infinity, k_infinity, k_infinity};
    const auto take = [&](const char* name, double& to) {
        for (const gum::InputGroup& group : model.inputs()) {
            if (group.name == name) {
                to = group.degrees_of_freedom;
            }
        }
    };
    take("length noise", nu.length_noise);
    take("table repeatability, linear", nu.table_linear);
    take("table repeatability, axial", nu.table_axial);
    take("table repeatability, tilt", nu.table_tilt);
    take("CMM coordinates of the fixture", nu.fixture);
    return nu;
}

}  // namespace

RotaryTableTrials::RotaryTableTrials(const RotaryTableModel& model, TrialExtras extras)
    : RotaryTableTrials(with_free_dead_paths(model), model.stochastic(), degrees_of_freedom_of(model),
                        std::move(extras)) {}

RotaryTableTrials::RotaryTableTrials(const JointAdjustment& solved, const StochasticModel& stochastic,
                                     const SourceDegreesOfFreedom& degrees_of_freedom, TrialExtras extras)
    : extras_(std::move(extras)), quantities_(reported_quantities(solved.measurement(), solved.has_reversal())) {
    // The weights stay; the parameters go to the very minimum that belongs to them.
    JointAdjustment nominal = solved;
    const SolveSummary summary = nominal.adjustment().refine(SolverOptions{});
    if (!summary.converged) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0006", "rotary table trials", "the adjustment did not converge (" + summary.message + ")",
            "trials begin at the minimum of the weighted squares", "solve the adjustment first", gum::Severity::error});
    }
    outputs_ = quantities_.outputs;
    if (extras_.derived) {
        const std::vector<gum::OutputQuantity>& derived = extras_.derived->outputs();
        outputs_.insert(outputs_.end(), derived.begin(), derived.end());
    }
    add_inputs(nominal, stochastic, degrees_of_freedom);
    network_ = std::make_unique<const TrialNetwork>(nominal, stochastic, extras_.derived != nullptr);
}

RotaryTableTrials::~RotaryTableTrials() = default;

void RotaryTableTrials::add_inputs(const JointAdjustment& solved, const StochasticModel& stochastic,
                                   const SourceDegreesOfFreedom& degrees_of_freedom) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    const auto visits = static_cast<Index>(solved.visits().size());
    Index size = 0;
    const auto add = [&](gum::InputGroup group) {
        const Index first = size;
        size += group.size();
        inputs_.push_back(std::move(group));
        return first;
    };
    const auto group_of = [](const char* name, const char* source, const char* unit, Eigen::VectorXd value,
                             Eigen::MatrixXd covariance, double nu) {
        gum::InputGroup group;
        group.name = name;
        group.source = source;
        group.unit = unit;
        group.evaluation = std::isfinite(nu) ? gum::Evaluation::type_a : gum::Evaluation::type_b;
        group.value = std::move(value);
        group.covariance = std::move(covariance);
        group.degrees_of_freedom = nu;
        return group;
    };
    const auto make_uniform = [](gum::InputGroup& group) {
        group.distribution = "uniform";
        for (Index i = 0; i < group.size(); ++i) {
            const double variance = group.covariance.cols() == 1 ? group.covariance(i, 0) : group.covariance(i, i);
            group.marginals.push_back(gum::Distribution::uniform(group.value[i], std::sqrt(3.0 * variance)));
        }
    };

    Index lengths = 0;
    for (const Visit& visit : solved.visits()) {
        lengths += static_cast<Index>(visit.observations.size());
    }
    Eigen::VectorXd variance(lengths);
    Index row = 0;
    for (std::size_t v = 0; v < solved.visits().size(); ++v) {
        const Eigen::VectorXd stated = solved.stated_variance(v);
        variance.segment(row, stated.size()) = stochastic.length_factor * stated;
        row += stated.size();
    }
    columns_.noise = add(group_of("length noise", "length noise", "m", Eigen::VectorXd::Zero(lengths), variance,
                                  degrees_of_freedom.length_noise));
    if (const double step = measurement.length_uncertainty.resolution; step > 0.0) {
        gum::InputGroup group =
            group_of("resolution of the lengths", "length noise", "m", Eigen::VectorXd::Zero(lengths),
                     Eigen::MatrixXd::Constant(lengths, 1, step * step / 12.0), k_infinity);
        make_uniform(group);
        columns_.resolution = add(std::move(group));
    }
    const auto add_table = [&](const char* name, const char* unit, Index per_visit, double of, double nu) {
        return of > 0.0 ? add(group_of(name, "table repeatability", unit, Eigen::VectorXd::Zero(per_visit * visits),
                                       Eigen::MatrixXd::Constant(per_visit * visits, 1, of), nu))
                        : -1;
    };
    columns_.linear =
        add_table("table repeatability, linear", "m", 3, stochastic.variance_linear, degrees_of_freedom.table_linear);
    columns_.axial =
        add_table("table repeatability, axial", "rad", 1, stochastic.variance_axial, degrees_of_freedom.table_axial);
    columns_.tilt =
        add_table("table repeatability, tilt", "rad", 2, stochastic.variance_tilt, degrees_of_freedom.table_tilt);

    std::vector<double> temperature;
    std::vector<double> temperature_variance;
    Index scales = 0;
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const auto at = static_cast<Index>(j);
        scales += solved.scale_prior(j) != JointAdjustment::k_none ? 1 : 0;
        if (solved.temperature_prior(j) != JointAdjustment::k_none) {
            temperature.push_back(measurement.temperature_difference[at]);
            temperature_variance.push_back(measurement.u_temperature[at] * measurement.u_temperature[at]);
        }
    }
    if (scales > 0) {
        const double u = measurement.length_uncertainty.u_scale;
        columns_.scale = add(group_of("scale of the stations", "scale", "1", Eigen::VectorXd::Zero(scales),
                                      Eigen::MatrixXd::Constant(scales, 1, u * u), k_infinity));
    }

    fixture_value_ = measurement.fixture.transpose().reshaped();
    columns_.fixture = size;
    if (extras_.fixture) {
        fixture_deviation_ = std::sqrt(stochastic.fixture_factor);
        fixture_value_ = extras_.fixture->evaluate(gum::input_estimates(*extras_.fixture));
        if (fixture_value_.size() != 3 * measurement.fixture.rows()) {
            throw std::logic_error("rotary table trials: the model of the fixture has " +
                                   std::to_string(fixture_value_.size()) + " outputs, not three a reflector");
        }
        for (const gum::InputGroup& group : extras_.fixture->inputs()) {
            fixture_inputs_ += group.size();
            add(group);
        }
    } else {
        gum::InputGroup group =
            group_of("CMM coordinates of the fixture", "fixture CMM", "m", fixture_value_,
                     stochastic.fixture_factor * measurement.fixture_covariance, degrees_of_freedom.fixture);
        if (measurement.fixture_shape == InputShape::uniform) {
            make_uniform(group);
        }
        add(std::move(group));
    }
    if (!temperature.empty()) {
        const auto n = static_cast<Index>(temperature.size());
        gum::InputGroup group = group_of("temperature of the fixture", "fixture thermal", "K",
                                         Eigen::Map<Eigen::VectorXd>(temperature.data(), n),
                                         Eigen::Map<Eigen::VectorXd>(temperature_variance.data(), n), k_infinity);
        if (measurement.temperature_shape == InputShape::uniform) {
            make_uniform(group);
        }
        temperature_ = group.value;
        columns_.temperature = add(std::move(group));
    }
    if (solved.expansion_prior() != JointAdjustment::k_none) {
        gum::InputGroup group =
            group_of("expansion coefficient of the fixture", "fixture thermal", "1/K",
                     Eigen::VectorXd::Constant(1, measurement.expansion),
                     Eigen::MatrixXd::Constant(1, 1, measurement.u_expansion * measurement.u_expansion), k_infinity);
        if (measurement.expansion_shape == InputShape::uniform) {
            make_uniform(group);
        }
        expansion_ = measurement.expansion;
        columns_.expansion = add(std::move(group));
    }

    const auto add_variance = [&](Index of, const char* name, const char* source, double nu) -> Index {
        if (of < 0 || !std::isfinite(nu)) {
            return -1;
        }
        const std::string full_name = std::string(name) + ", estimated variance";
        gum::InputGroup group = group_of(full_name.c_str(), source, "1", Eigen::VectorXd::Ones(1),
                                         Eigen::MatrixXd::Constant(1, 1, 2.0 / nu), k_infinity);
        group.evaluation = gum::Evaluation::type_a;
        group.distribution = "gamma";
        group.marginals = {gum::Distribution{
            .kind = gum::DistributionKind::gamma, .location = 0.0, .scale = 2.0 / nu, .shape = 0.5 * nu}};
        return add(std::move(group));
    };
    columns_.noise_variance =
        add_variance(columns_.noise, "length noise", "length noise", degrees_of_freedom.length_noise);
    columns_.linear_variance = add_variance(columns_.linear, "table repeatability, linear", "table repeatability",
                                            degrees_of_freedom.table_linear);
    columns_.axial_variance = add_variance(columns_.axial, "table repeatability, axial", "table repeatability",
                                           degrees_of_freedom.table_axial);
    columns_.tilt_variance =
        add_variance(columns_.tilt, "table repeatability, tilt", "table repeatability", degrees_of_freedom.table_tilt);
    columns_.fixture_variance =
        add_variance(columns_.fixture, "CMM coordinates of the fixture", "fixture CMM", degrees_of_freedom.fixture);
}

void RotaryTableTrials::draw_in(const Eigen::Ref<const Eigen::MatrixXd>& x, const Eigen::MatrixXd& coordinates,
                                Index first, Index count, TrialWork& work) const {
    const TrialNetwork& network = *network_;
    const Lanes noise_factor = variance_factor(x, columns_.noise_variance, first, count);
    const Lanes linear_factor = variance_factor(x, columns_.linear_variance, first, count);
    const Lanes axial_factor = variance_factor(x, columns_.axial_variance, first, count);
    const Lanes tilt_factor = variance_factor(x, columns_.tilt_variance, first, count);
    const Lanes fixture_factor = variance_factor(x, columns_.fixture_variance, first, count);
    const bool table_deviates = columns_.linear >= 0 || columns_.axial >= 0 || columns_.tilt >= 0;
    Lanes drawn;
    std::array<Lanes, 6> deviation;
    for (std::size_t v = 0; v < network.visits.size(); ++v) {
        const TrialNetwork::VisitPlan& visit = network.visits[v];
        for (Index k = 0; k < visit.count; ++k) {
            Lanes& start = work.residual_start[static_cast<std::size_t>(visit.first + k)];
            fill(start, network.length_residual[static_cast<std::size_t>(visit.first + k)]);
            load(x, columns_.noise + visit.first_input + k, first, count, drawn);
            add_product(noise_factor, drawn, start);
            if (columns_.resolution >= 0) {
                load(x, columns_.resolution + visit.first_input + k, first, count, drawn);
                for (int t = 0; t < k_lanes; ++t) {
                    start[t] += drawn[t];
                }
            }
        }
        for (Lanes& component : deviation) {
            fill(component, 0.0);
        }
        const auto take = [&](Index group, Index per_visit, std::size_t to, const Lanes& factor) {
            for (Index c = 0; c < per_visit && group >= 0; ++c) {
                load(x, group + per_visit * static_cast<Index>(visit.number) + c, first, count, drawn);
                add_product(factor, drawn, deviation[to + static_cast<std::size_t>(c)]);
            }
        };
        take(columns_.linear, 3, 0, linear_factor);
        take(columns_.axial, 1, 3, axial_factor);
        take(columns_.tilt, 2, 4, tilt_factor);
        if (table_deviates) {
            draw_visit(network, visit, deviation.data(), work);
        }
        work.axial_deviation[v] = deviation[3];
    }

    const auto observe = [&](Index prior, double deviation_from) {
        Lanes& observed = work.prior_observed[static_cast<std::size_t>(prior)];
        const double start = network.prior_residual[static_cast<std::size_t>(prior)];
        for (int t = 0; t < k_lanes; ++t) {
            observed[t] = start + (drawn[t] - deviation_from);
        }
    };
    for (Index c = 0; c < fixture_value_.size(); ++c) {
        if (extras_.fixture) {
            load(coordinates, c, first, count, drawn);
        } else {
            load(x, columns_.fixture + c, first, count, drawn);
        }
        for (int t = 0; t < k_lanes; ++t) {
            drawn[t] = fixture_deviation_ * fixture_factor[t] * (drawn[t] - fixture_value_[c]);
        }
        observe(network.fixture_prior + c, 0.0);
    }
    Index scale = columns_.scale;
    Index temperature = columns_.temperature;
    for (std::size_t j = 0; j < network.scale_priors.size(); ++j) {
        if (network.scale_priors[j] >= 0) {
            load(x, scale++, first, count, drawn);
            observe(network.scale_priors[j], 0.0);
        }
        if (network.temperature_priors[j] >= 0) {
            load(x, temperature, first, count, drawn);
            observe(network.temperature_priors[j],
                    temperature_[static_cast<Index>(temperature - columns_.temperature)]);
            ++temperature;
        }
    }
    if (network.expansion_prior >= 0) {
        load(x, columns_.expansion, first, count, drawn);
        observe(network.expansion_prior, expansion_);
    }
}

void RotaryTableTrials::write_derived(Index first, Index count, const TrialWork& work,
                                      Eigen::Ref<Eigen::MatrixXd> y) const {
    const TrialNetwork& network = *network_;
    const auto reported_count = static_cast<Index>(quantities_.outputs.size());
    const auto axial = static_cast<Index>(3 + network.cyclic[0]);
    Eigen::VectorXd reported(reported_count);
    Eigen::VectorXd positions(static_cast<Index>(network.visits.size()));
    Eigen::VectorXd result(static_cast<Index>(outputs_.size()) - reported_count);
    for (Index t = 0; t < count; ++t) {
        const int lane = static_cast<int>(t);
        reported = y.row(first + t).head(reported_count).transpose();
        if (!reported.allFinite()) {
            y.row(first + t).tail(result.size()).setConstant(std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        positions.setZero();
        for (std::size_t v = 0; v < network.visits.size(); ++v) {
            const TrialNetwork::VisitPlan& visit = network.visits[v];
            if (!visit.is_determined) {
                continue;
            }
            double position = reported[6 * visit.angle + axial];
            if (quantities_.has_reversal) {
                position += visit.half_sense * reported[quantities_.reversal + axial];
            }
            for (Index k = 0; k < visit.count; ++k) {
                position += network.gains[visit.gain + static_cast<std::size_t>(k)] *
                            work.residual[static_cast<std::size_t>(visit.first + k)][lane];
            }
            positions[static_cast<Index>(visit.number)] = position + work.axial_deviation[v][lane];
        }
        extras_.derived->values(reported, positions, result);
        y.row(first + t).tail(result.size()) = result.transpose();
    }
}

void RotaryTableTrials::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x,
                                        Eigen::Ref<Eigen::MatrixXd> y) const {
    const TrialNetwork& network = *network_;
    Eigen::MatrixXd coordinates;
    if (extras_.fixture) {
        coordinates.resize(x.rows(), fixture_value_.size());
        extras_.fixture->evaluate_trials(x.middleCols(columns_.fixture, fixture_inputs_), coordinates);
    }
    TrialWork work(network);
    TrialSteps sum;
    for (Index first = 0; first < x.rows(); first += k_lanes) {
        const Index count = std::min<Index>(k_lanes, x.rows() - first);
        draw_in(x, coordinates, first, count, work);
        const std::array<TrialEnd, k_lanes> ends = solve(network, extras_.options, count, work);
        transform(network, work);
        const auto write = [&](Index column, const Lanes& from) {
            std::copy_n(from.at.begin(), count, y.data() + column * y.outerStride() + first);
        };
        for (std::size_t i = 0; i < work.errors.size(); ++i) {
            write(static_cast<Index>(i), work.errors[i]);
        }
        for (std::size_t c = 0; c < 2; ++c) {
            const auto across = static_cast<std::size_t>(network.cyclic[1 + c]);
            write(quantities_.set_up + static_cast<Index>(c), work.set_up[across]);
            write(quantities_.set_up + 2 + static_cast<Index>(c), work.set_up[3 + across]);
        }
        for (Index c = 0; c < 6 && quantities_.has_reversal; ++c) {
            Lanes value = work.delta[static_cast<std::size_t>(network.reversal + c)];
            for (double& lane : value.at) {
                lane += network.nominal_at(network.reversal + c);
            }
            write(quantities_.reversal + c, value);
        }
        for (Index t = 0; t < count; ++t) {
            const TrialEnd& end = ends[static_cast<std::size_t>(t)];
            if (!end.converged) {
                y.row(first + t).setConstant(std::numeric_limits<double>::quiet_NaN());
            }
            ++sum.trials;
            sum.steps += static_cast<std::uint64_t>(end.steps);
            sum.most = std::max(sum.most, end.steps);
            sum.alone += end.alone ? 1 : 0;
            sum.not_converged += end.converged ? 0 : 1;
        }
        if (extras_.derived) {
            prepare(network, work);
            for (const TrialNetwork::Turn& turn : network.turns) {
                add_turn(network, turn, false, work);
            }
            write_derived(first, count, work, y);
        }
    }
    trials_.fetch_add(sum.trials, std::memory_order_relaxed);
    steps_.fetch_add(sum.steps, std::memory_order_relaxed);
    alone_.fetch_add(sum.alone, std::memory_order_relaxed);
    not_converged_.fetch_add(sum.not_converged, std::memory_order_relaxed);
    int most = most_steps_.load(std::memory_order_relaxed);
    while (most < sum.most && !most_steps_.compare_exchange_weak(most, sum.most, std::memory_order_relaxed)) {
    }
}

TrialSteps RotaryTableTrials::steps() const {
    return {trials_.load(), steps_.load(), most_steps_.load(), alone_.load(), not_converged_.load()};
}

Eigen::VectorXd RotaryTableTrials::evaluate(const Eigen::VectorXd& x) const {
    const Eigen::MatrixXd row = x.transpose();
    Eigen::MatrixXd y(1, static_cast<Index>(outputs_.size()));
    evaluate_trials(row, y);
    if (!y.allFinite()) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0006", "rotary table trials",
            "the adjustment did not converge in " + std::to_string(extras_.options.most_steps) + " steps",
            "a value of the model is the minimum of the weighted squares", "keep the inputs within their uncertainties",
            gum::Severity::error});
    }
    return y.row(0).transpose();
}

Eigen::MatrixXd RotaryTableTrials::jacobian(const Eigen::VectorXd& x) const {
    Eigen::VectorXd u(x.size());
    Index next = 0;
    for (const gum::InputGroup& group : inputs_) {
        for (Index i = 0; i < group.size(); ++i) {
            u[next++] = std::sqrt(group.covariance.cols() == 1 ? group.covariance(i, 0) : group.covariance(i, i));
        }
    }
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Index>(outputs_.size()), x.size());
    constexpr Index k_columns = 64;
    for (Index first = 0; first < x.size(); first += k_columns) {
        const Index count = std::min(k_columns, x.size() - first);
        Eigen::MatrixXd trials = x.transpose().replicate(2 * count, 1);
        for (Index i = 0; i < count; ++i) {
            // A quantity that must stay above 0, as an estimated variance, does so with a step of a tenth.
            const double step = 0.1 * u[first + i];
            trials(2 * i, first + i) += step;
            trials(2 * i + 1, first + i) -= step;
        }
        Eigen::MatrixXd y(trials.rows(), result.rows());
        evaluate_trials(trials, y);
        for (Index i = 0; i < count; ++i) {
            const double width = trials(2 * i, first + i) - trials(2 * i + 1, first + i);
            if (width > 0.0) {
                result.col(first + i) = (y.row(2 * i) - y.row(2 * i + 1)).transpose() / width;
            }
        }
    }
    return result;
}

}  // namespace gumcert::engine
