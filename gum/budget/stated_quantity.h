#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gum/quantity/distribution.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// Readings taken in groups (days, operators, set-ups), for the analysis of variance of JCGM 100:2008, H.5.
struct GroupedReadings {
    std::vector<std::vector<double>> readings;  ///< one list a group, coherent SI; empty when only a summary is given
    std::vector<double> means, standard_deviations;  ///< one a group, coherent SI
    std::vector<std::size_t> sizes;                  ///< one a group
};

/// One statement of what is known of a quantity. An input of a budget is one of them, or the sum of several components.
struct StatedQuantity {
    std::string name;  ///< of the component; empty where the input is one statement
    Evaluation evaluation = Evaluation::type_b;
    std::string statement;  ///< which row of the contract of jobs: "u", "U, k", "U, p", "half_width", "limits",
                            ///< "resolution", "mpe", "observations", "groups", "samples", "distribution", "relative_u",
                            ///< "relative_U, k", "relative_U, p", "specification", "covariance", "constant"; nothing is
                            ///< evaluated from it
    double stated_value =
        0.0;             ///< the estimate as it was stated, in the unit of the input; nothing is evaluated from it
    double value = 0.0;  ///< the same, coherent SI; of a second and later component without the origin of the scale, so
                         ///< that the sum of all is the value of the input
    double u = 0.0;      ///< standard uncertainty for the law of propagation, coherent SI; 0 for a constant
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  ///< for the law of propagation
    Distribution distribution;  ///< what Monte Carlo draws, coherent SI (JCGM 101:2008, 6.4)
    std::string source, note, significance;
    std::vector<double> observations;  ///< coherent SI, in the order read
    /// The most decimals with which one of them was written, in the unit of the input, where it is known: what the
    /// display had; nothing is evaluated from it
    int observation_decimals = 0;
    std::optional<double> pooled_standard_deviation;  ///< coherent SI, where it is pooled; its ν is degrees_of_freedom
    std::optional<GroupedReadings> groups;
    /// Samples from a file: its name, and the values in the order of its rows, coherent SI. Quantities with samples of
    /// one file belong together row by row.
    std::string sample_file;
    std::shared_ptr<const std::vector<double>> sample_rows;
    std::string where;  ///< place to name in messages
};

// Statements for the budgets of a program of one's own. All numbers are coherent SI.

/// An estimate with its standard uncertainty: normal, with finite degrees of freedom the scaled and shifted t
/// (JCGM 101:2008, 6.4.7 and 6.4.9).
/// \throws InputError  GC-GUM-0001 not finite, -0003 u ≤ 0, -0005 ν ≤ 0
[[nodiscard]] StatedQuantity state_uncertainty(double value, double u,
                                               double degrees_of_freedom = std::numeric_limits<double>::infinity());

/// A distribution: its expectation and its standard deviation.
/// \throws InputError  GC-GUM-0001, -0003 for one that has no finite expectation or no standard deviation above 0
[[nodiscard]] StatedQuantity state_distribution(Distribution distribution);

/// Independent observations: their mean, s/√n and ν = n − 1 (JCGM 100:2008, 4.2; JCGM 101:2008, 6.4.9).
/// \throws InputError  as evaluate_type_a(); GC-GUM-0003 where all observations are equal
[[nodiscard]] StatedQuantity state_observations(std::vector<double> observations);

/// The same quantity with its standard uncertainty multiplied: its distribution becomes wider about the estimate, degrees of
/// freedom stay. With the factor 0 it is a constant.
/// \param factor  ≥ 0, [1]
[[nodiscard]] StatedQuantity with_scaled_uncertainty(StatedQuantity quantity, double factor);

/// A number without uncertainty, on purpose.
[[nodiscard]] StatedQuantity state_constant(double value);

}  // namespace gumcert::gum
