#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gum/monte_carlo/trial_distribution.h"
#include "gum/rounding.h"

namespace gumcert::certificate {

/// Values of an input of a budget, for the capabilities that depend on it.
struct InputValues {
    std::string unit;  ///< UDUNITS-2
    /// In `unit`, one a point of the table, or one for all; none at points whose results do not rest on it.
    std::vector<std::optional<double>> values;
    std::optional<double> without_point = {};  ///< of results that have no point, beside others that have one
};

/// What the evaluation knows beside its record.
struct CapabilityInputs {
    std::map<std::string, InputValues> values;  ///< by the name of the input
    /// Of each result, by Result::name: sensitivity coefficients of the inputs that its model rests on, by their names, in
    /// coherent units. Inputs that only a point states, such as a nominal value, have none.
    std::map<std::string, std::map<std::string, double>> sensitivities = {};
    /// P(Y ≤ x) of results whose k comes from a convolution, by Result::name; x in the unit of the result.
    std::map<std::string, std::function<double(double)>> distributions;
    /// P(Y < x) of the same results, where it differs: where single values have a probability of their own.
    std::map<std::string, std::function<double(double)>> distributions_below;
    /// Trials of results whose U comes from Monte Carlo, by Result::name. Counted where a decision needs them, one
    /// result after the other: they take memory.
    std::map<std::string, gum::TrialsOfOutput> trials = {};
    gum::RoundingMode rounding = gum::RoundingMode::half_even;  ///< of U, as the job asks for it
};

}  // namespace gumcert::certificate
