#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/rotary_table/anglewise_covariance.h"
#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/contact_point_model.h"
#include "engine/rotary_table/rotary_table_model.h"

namespace gumcert::engine {

/// What the inputs of a rotary table contribute to quantities that stand angle by angle: C V Cᵀ of the law of
/// propagation (JCGM 100:2008, 5.2.2) without its sensitivity coefficients C, whose number grows with the square of the
/// angles. Costs and size are proportional to the angles.
struct RotaryTableContributions {
    std::vector<Eigen::VectorXd> variance;     ///< one a group of inputs: the variance that it gives each quantity
    std::vector<Eigen::VectorXd> sensitivity;  ///< ∂z/∂x of a group of one input; empty for others
    AnglewiseCovariance covariance;            ///< of the quantities
};

/// Contributions to the quantities of a map, at the nominal solution of the model.
/// \param map  by the parameters of `model.solved()`, in which the dead paths are held
[[nodiscard]] RotaryTableContributions contributions_of(const RotaryTableModel& model, const AnglewiseMap& map);
/// To the reported quantities.
[[nodiscard]] RotaryTableContributions contributions_of(const RotaryTableModel& model);
/// To the displacements of a contact point.
[[nodiscard]] RotaryTableContributions contributions_of(const RotaryTableModel& model,
                                                        const ContactPointModel& contact);

}  // namespace gumcert::engine
