#pragma once

#include <optional>
#include <vector>

#include "engine/rotary_table/anglewise_covariance.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/machine_frame.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rotary_table/rotary_table_request.h"

namespace gumcert::gum {

/// Location errors of the axis in the reference frame of the machine, and how well the points carry that frame.
struct LocationErrors {
    engine::MachineFrameFit fit;
    double p_value = 1.0;  ///< of chi square, that points which agree within their uncertainties are worse
    /// Nothing where the points refute the frame, or where the axis does not lie along the machine axis of its letter.
    std::optional<UncertaintyBudget> budget;
    std::vector<Diagnostic> notes;
};

/// \param budget      of the reported quantities
/// \param covariance  of them
/// \throws InputError  GC-FRAME-0001
[[nodiscard]] LocationErrors evaluate_location_errors(const RotaryTableRequest& request,
                                                      const engine::RotaryTableSolution& solution,
                                                      const UncertaintyBudget& budget,
                                                      const engine::AnglewiseCovariance& covariance);

}  // namespace gumcert::gum
