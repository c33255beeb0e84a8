#pragma once

#include <optional>
#include <vector>

#include "engine/anglewise_covariance.h"
#include "engine/job/rotary_table_job.h"
#include "engine/machine_frame.h"
#include "engine/rotary_table_evaluation.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// Location errors of the axis in the reference frame of the machine, and how well the points carry that frame.
struct LocationErrors {
    engine::MachineFrameFit fit;
    double p_value = 1.0;  ///< of chi square, that points which agree within their uncertainties are worse
    /// Nothing where the points refute the frame, or where the axis does not lie along the machine axis of its letter.
    std::optional<gum::UncertaintyBudget> budget;
    std::vector<gum::Diagnostic> notes;
};

/// \param budget      of the reported quantities
/// \param covariance  of them
/// \throws InputError  GC-FRAME-0001
[[nodiscard]] LocationErrors evaluate_location_errors(const engine::RotaryTableJob& job,
                                                      const engine::RotaryTableSolution& solution,
                                                      const gum::UncertaintyBudget& budget,
                                                      const engine::AnglewiseCovariance& covariance);

void fill_location_errors(reports::RotaryTable& rotary, const engine::RotaryTableJob& job,
                          const LocationErrors& errors);

}  // namespace gumcert::app
