#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

/// One variance component: a standard deviation and what the residuals say of it.
struct VarianceComponent {
    std::string name;
    bool angular = false;  ///< `value` in [rad], else [m]
    /// Standard deviation of one length (rms over the lengths where a part is proportional to them), of one
    /// translation or rotation, or of one coordinate of the fixture (rms over the coordinates). An estimate where
    /// `estimated`, else what the weights take as given.
    double value = 0.0;
    double u = 0.0;                   ///< standard uncertainty of `value`; 0 when it is given
    double degrees_of_freedom = 0.0;  ///< 2 θ²/Var(θ) of the variance θ; infinite when it is given
    double redundancy = 0.0;          ///< θ tr(R V): share of the redundancy of the adjustment
    bool estimated = false;
    std::optional<double> stated = {};  ///< what the job states, in the unit of `value`
    bool used = true;  ///< in the weights; false: estimated only as a check of the stated value, which they use
    /// Where the residuals say too little of the component to be taken at their word: what they give. `value`, `u` and ν
    /// are then those of what they leave plausible (`take_plausible_components`).
    std::optional<double> residuals_give = {};
    bool determined = true;  ///< false: what the residuals leave plausible is no table, or they say nothing of it
    bool separable = true;   ///< false: it was to be estimated, but too little of the redundancy depends on it
};

/// Which components are estimated from the residuals.
struct EstimatedComponents {
    bool length = true;
    bool table = true;     ///< linear, axial and tilt
    bool fixture = false;  ///< a factor on the stated covariance of the fixture
};

/// Rows of VarianceComponentStep::components.
enum ComponentRow : std::size_t { length_noise, table_linear, table_axial, table_tilt, fixture_cmm };

/// Redundancy of a component below which the residuals say nothing of it.
constexpr double k_least_component_redundancy = 2.0;

/// Redundancy of the length noise below which it is held as stated: single distances are tested with it.
constexpr double k_least_length_redundancy = 30.0;

/// The weights that a job asks for, before anything is estimated: what it states of the table, and where it asks for an
/// estimate without an idea of it, what a good commercial table has.
[[nodiscard]] StochasticModel start_variances(const TableRepeatability& table);

struct VarianceComponentStep {
    StochasticModel stochastic;                 ///< after the step
    double relative_change = 0.0;               ///< largest change of a variance against its standard uncertainty
    double length_redundancy = 0.0;             ///< tr(R V) of length noise and resolution, at the weights taken
    bool length_separable = true;               ///< false: one distance a visit, length noise kept as stated
    bool fixture_at_bound = false;              ///< true: the fixture's factor would fall below what is sensible
    std::vector<VarianceComponent> components;  ///< one a ComponentRow
    /// θ²/(S⁻¹)_kk of what is estimated, at the weights taken: the degrees of freedom that its estimate will have if these
    /// weights are true; infinite for what is held. One a ComponentRow.
    std::vector<double> expected_degrees_of_freedom;
    /// Standard deviation of the estimated variances if these weights are true, [m²] or [rad²]; the fixture's factor [1].
    /// Of what is estimated, else 0. One a ComponentRow.
    std::vector<double> expected_spread;
    /// (tr R V_k)²/tr(R V_k R V_k): of the quadratic form that a component is estimated from, whatever its size.
    std::vector<double> form_degrees_of_freedom;
};

/// One step of restricted maximum likelihood (Fisher scoring; the same fixed point as the iterated estimates of Helmert
/// and Förstner, and MINQUE iterated) for the components {length noise, table linear, table axial, table tilt,
/// fixture}: V = θ₁·stated + res²/12 + table for the lengths, θ₅·stated for the fixture. The resolution is known and
/// stays as it is.
///
/// With R = W - W J C JᵀW, q_k = vᵀ W V_k W v and S_kl = tr(R V_k R V_l): θ ← θ + S⁻¹ (q - tr(R V_k)), where a variance
/// that would turn negative is held at zero while its gradient points there; the factor of the fixture is held at 1e-4,
/// where its standard deviation is a hundredth of the stated one. Var(θ) = 2 S⁻¹.
///
/// \param normal      linearised at the present parameters with the weights of `present`
/// \param covariance  of its parameters
/// \param present     the weights
[[nodiscard]] VarianceComponentStep estimate_variance_components(const JointAdjustment& adjustment,
                                                                 const NormalEquations& normal,
                                                                 const BorderedCovariance& covariance,
                                                                 const StochasticModel& present,
                                                                 const EstimatedComponents& estimated);

/// Components of the table that are less than four of their standard uncertainties (of variances), and above all those
/// that are estimated as 0: they are not known to be so small. In their place comes the mean of what the estimate leaves
/// plausible of a variance θ ≥ 0, with the degrees of freedom of that, 3.5 at least (ADR 0071). Others stay as they are.
///
/// \param step  at its fixed point; its weights and its components are changed
void take_plausible_components(VarianceComponentStep& step);

/// Redundancy of the coordinates of the fixture, Σ (Q_v V⁻¹)_ii.
[[nodiscard]] double fixture_redundancy(const JointAdjustment& adjustment, const NormalEquations& normal,
                                        const BorderedCovariance& covariance);

}  // namespace gumcert::engine
