#pragma once

#include "engine/rotary_table/trials/trial_batch.h"
#include "engine/rotary_table/trials/trial_network.h"

namespace gumcert::engine {

/// Gradient Jᵀ V⁻¹ (observed - predicted) of lengths and prior values at the present parameters of the trials. That of
/// expansion and temperatures is not in it: what the lengths say about them is in the gradient of the stretches.
void find_gradient(const TrialNetwork& network, TrialBatch& batch);

/// Residuals of all lengths, observed - predicted, at the present parameters of the trials.
void find_residuals(const TrialNetwork& network, TrialBatch& batch);

}  // namespace gumcert::engine
