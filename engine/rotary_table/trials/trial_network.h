#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// The solution of an adjustment and its factored normal equations, laid out for the trials of RotaryTableTrials.
///
/// All parameters, free or held, have their slots in one sequence: stations (x, y, z, scale, stretch), dead paths,
/// fixture, reversal (six for all angles, or six of each), poses.
///
/// Expansion α and temperature differences ΔT act on the lengths through the stretch 1 + α ΔT_j of the fixture at each
/// station alone. The lengths are almost linear in the stretches, but not in the products that they are made of, which
/// differ from trial to trial by several times u(α)/α. So the normal equations are those with the stretches for
/// parameters, reduced to them, and every trial finds α and ΔT from the stretches itself (trial_solution.cpp).
struct TrialNetwork {
    using Index = Eigen::Index;
    using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    // Components of a station after its place.
    static constexpr Index k_scale = 3;
    static constexpr Index k_stretch = 4;  ///< in the place of the temperature difference of the adjustment
    static constexpr Index k_station_size = 5;

    struct Length {
        std::array<double, 3> difference;  ///< P - q at the solution, [m]
        double distance;                   ///< its length, [m]
        double inverse;                    ///< of that, [1/m]
        double inverse_square;             ///< [1/m²]
        Index reflector;
        Index path_slot;
    };
    struct VisitPlan {
        std::size_t number;  ///< among the visits of the adjustment
        Index first, count;  ///< lengths
        Index first_input;   ///< of the same among the input deviations
        Index station;
        Index angle;
        Index reversal;         ///< first slot
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
        Index pose, reversal;            ///< first slots
        double half_sense;
        std::size_t begin, end;  ///< visits
    };
    struct Prior {
        std::size_t group;         ///< of the adjustment
        Index first;               ///< among the prior observations
        Eigen::VectorXd value;     ///< of the same parameters at the solution
        std::vector<Index> slots;  ///< none for expansion and temperatures
        RowMajorMatrix weights;
    };
    /// A pose, eliminated from the normal equations, and its reversal where it has one of its own.
    static constexpr std::size_t k_most_of_pose = 12;
    struct Elimination {
        std::vector<Index> slots;  ///< free components of the pose
        RowMajorMatrix inverse;    ///< N_ee⁻¹
        RowMajorMatrix to_border;  ///< -N_be N_ee⁻¹
        RowMajorMatrix to_pose;    ///< -N_ee⁻¹ N_eb
    };
    /// Expansion and temperature differences; u = 0: held.
    struct Thermal {
        bool is_uncertain = false;
        double expansion = 0.0, u_expansion = 0.0;       ///< [1/K]
        std::vector<double> temperature, u_temperature;  ///< one a station, [K]
        Index expansion_prior = -1;                      ///< among the prior observations
        std::vector<Index> temperature_priors;
        RowMajorMatrix normal;       ///< of the stretches, everything else adjusted, stations×stations
        RowMajorMatrix from_border;  ///< stretches' part of the gradient of the border, stations×(border - stretches)
    };
    /// A component that the reported quantities are made of.
    struct Reported {
        Index slot;
        double inverse_u;  ///< inverse of its standard uncertainty, expansion and temperatures known
    };

    /// \param with_positions  the axial deviations of the visits are asked for
    /// \throws gum::NoResultError  if the normal equations are singular
    TrialNetwork(const JointAdjustment& solved, const StochasticModel& stochastic, bool with_positions);

    [[nodiscard]] static Index station_slot(Index station, Index component) {
        return k_station_size * station + component;
    }
    [[nodiscard]] double nominal_at(Index slot) const { return nominal[static_cast<std::size_t>(slot)]; }
    [[nodiscard]] Eigen::Vector3d nominal_point(Index slot) const {
        return {nominal_at(slot), nominal_at(slot + 1), nominal_at(slot + 2)};
    }

    /// First slot of the reversal of an angle.
    [[nodiscard]] Index reversal_of(Index angle) const { return reversal + (reversal_by_angle ? 6 * angle : 0); }

    bool reversal_by_angle = false;
    Index stations = 0, reflectors = 0, angles = 0;
    Index paths = 0, fixture = 0, reversal = 0, poses = 0;  ///< first slots
    std::vector<double> nominal;                            ///< parameters at the solution

    std::vector<Length> lengths;
    std::vector<double> length_residual;  ///< observed - predicted at the solution, [m]
    std::vector<VisitPlan> visits;        ///< in the order of the turns
    std::vector<double> weights, to_length, gains;
    std::vector<Turn> turns;
    Index largest_visit = 0;

    std::vector<Prior> priors;
    std::vector<double> prior_residual;  ///< observed - value at the solution
    Index fixture_prior = 0;             ///< first of the prior observations
    std::vector<Index> scale_priors;     ///< one a station, or -1
    Thermal thermal;

    std::vector<Index> border;         ///< slots; the stretches, where they are uncertain, last
    RowMajorMatrix border_covariance;  ///< of the border without the stretches, which are known to it
    std::vector<Elimination> eliminated;
    std::vector<Index> free_slots;               ///< border without the stretches, then the poses
    std::vector<FreeParameter> free_parameters;  ///< of the same
    std::vector<Reported> reported;
    Adjustment least_squares;  ///< at the solution, for trials that are solved alone
    std::vector<Adjustment::BlockId> station_blocks;
    Adjustment::BlockId expansion_block = 0;

private:
    void take_visits(const JointAdjustment& solved, const NormalEquations& normal, const StochasticModel& stochastic,
                     bool with_positions);
    void take_priors(const JointAdjustment& solved, const NormalEquations& normal);
    void take_normal_equations(const JointAdjustment& solved, const NormalEquations& normal);

    std::vector<double> by_stretch_;  ///< ∂length/∂stretch at the solution, [m]
};

}  // namespace gumcert::engine
