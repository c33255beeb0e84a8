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

/// What is known of the distribution of a result, x in its unit.
struct ResultDistribution {
    std::function<double(double)> function;  ///< P(Y ≤ x)
    std::function<double(double)> below;     ///< P(Y < x), where single values have a probability; empty: P(Y ≤ x)
    double least_probability = 0.0;          ///< what is smaller is not known
    std::uint64_t draws = 0;                 ///< of correlated inputs, behind the function; 0: none
};

/// What the equations give at the estimates, where a result is stated as the mean of trials that is another value.
struct ModelValue {
    double value = 0.0;        ///< in the unit of the result
    bool is_in_doubt = false;  ///< evidence is against the mean of the trials (gum::is_mean_in_doubt())
};

/// What the evaluation knows beside its record.
struct CapabilityInputs {
    std::map<std::string, InputValues> values;  ///< by the name of the input
    /// Of each result, by Result::name: sensitivity coefficients of the inputs that its model rests on, by their names, in
    /// coherent units. Inputs that only a point states, such as a nominal value, have none.
    std::map<std::string, std::map<std::string, double>> sensitivities = {};
    /// Of results that are neither normal nor have a t-distribution, by Result::name: the convolution of all contributions,
    /// also where its k is that of t_p(ν_eff). Made where a decision needs it, one result after the other: it takes memory.
    std::map<std::string, std::function<ResultDistribution()>> distributions;
    /// Trials of results whose U comes from Monte Carlo, by Result::name. Counted where a decision needs them, one
    /// result after the other: they take memory.
    std::map<std::string, gum::TrialsOfOutput> trials = {};
    std::map<std::string, ModelValue> at_estimates = {};        ///< by Result::name
    gum::RoundingMode rounding = gum::RoundingMode::half_even;  ///< of U, as the job asks for it
};

}  // namespace gumcert::certificate
