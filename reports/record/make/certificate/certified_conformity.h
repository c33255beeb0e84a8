#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "certificate/capability_inputs.h"
#include "certificate/certified_results.h"

namespace gumcert::reports {

/// Knowledge of the distribution of one value, where it is neither normal nor a t-distribution.
struct KnownDistribution {
    std::function<double(double)> function;  ///< P(Y ≤ x), x in the unit of the column; empty: normal or t
    std::function<double(double)> below;     ///< P(Y < x), where single values have a probability; empty: P(Y ≤ x)
    std::string note;                        ///< English sentence for the verdict; "" without
    std::uint64_t trials = 0;                ///< or draws, that the function counts; 0: it is not from trials
    double least_probability = 0.0;          ///< the function tells nothing of smaller ones
    /// Of the measurement model at the estimates, where the mean of the trials that is stated is another value.
    std::optional<certificate::ModelValue> at_estimates = {};
};

/// Decides on conformity of one value, twice: with the unrounded numbers, and with those that are printed.
///
/// Where the printed U is a capability in place of a smaller U, the decision rests on that larger U: it is what the
/// certificate states. The deviations of a known distribution from the value are then widened in the ratio of the two,
/// so that p, k and U that are printed together agree. Of a value with a coverage interval in place of U, rules with U
/// take the larger distance of an end from the value; probabilities are those of its distribution. A value that no U
/// can be stated for, a value of another laboratory, a rule that cannot be applied and a specification in a unit of
/// another kind give "not_applicable" with a note: a specification that was agreed on is never dropped without a word.
[[nodiscard]] certificate::Verdict verdict_of(const certificate::AgreedSpecification& specification,
                                              const certificate::CertifiedColumn& column,
                                              const certificate::CertifiedValue& value, const KnownDistribution& known);

}  // namespace gumcert::reports
