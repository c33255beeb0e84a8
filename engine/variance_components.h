#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "engine/joint_adjustment.h"

namespace gumcert::engine {

/// One variance component: a standard deviation and what the residuals say of it.
struct VarianceComponent {
    std::string name;
    bool angular = false;             ///< `value` in [rad], else [m]
    double value = 0.0;               ///< standard deviation of one length, translation or rotation
    double u = 0.0;                   ///< standard uncertainty of `value`; 0 when it is given
    double degrees_of_freedom = 0.0;  ///< 2 θ²/Var(θ) of the variance θ; infinite when it is given
    double redundancy = 0.0;          ///< θ tr(R V): share of the redundancy of the adjustment
    bool estimated = false;
};

/// Which components are estimated from the residuals.
struct EstimatedComponents {
    bool length = true;
    bool table = true;  ///< linear, axial and tilt
};

struct VarianceComponentStep {
    StochasticModel stochastic;                 ///< after the step
    double relative_change = 0.0;               ///< largest change of a variance against its standard uncertainty
    bool length_separable = true;               ///< false: one distance a visit, length noise kept as stated
    std::vector<VarianceComponent> components;  ///< length noise, table linear, table axial, table tilt
};

/// One step of restricted maximum likelihood (Fisher scoring; the same fixed point as the iterated estimates of Helmert
/// and Förstner, and MINQUE iterated) for the components {length noise, table linear, table axial, table tilt}.
///
/// With R = W - W J C JᵀW, q_k = vᵀ W V_k W v and S_kl = tr(R V_k R V_l): θ ← θ + S⁻¹ (q - tr(R V_k)), where a variance
/// that would turn negative is held at zero while its gradient points there. Var(θ) = 2 S⁻¹.
///
/// \param normal      linearised at the present parameters with the weights of `present`
/// \param covariance  of its parameters
/// \param unit_table  nominal variances that stand for a component when it is zero, for scaling only
[[nodiscard]] VarianceComponentStep estimate_variance_components(const JointAdjustment& adjustment,
                                                                 const NormalEquations& normal,
                                                                 const Eigen::MatrixXd& covariance,
                                                                 const StochasticModel& present,
                                                                 const EstimatedComponents& estimated);

}  // namespace gumcert::engine
