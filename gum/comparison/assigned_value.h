#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gum/comparison/consensus_spread.h"
#include "gum/comparison/laboratory_data.h"
#include "gum/comparison/reference_value.h"

namespace gumcert::gum {

/// What the scatter of the results says of an assigned value that is made of them. Positions are those of
/// LaboratoryData.
struct ConsensusScatter {
    SpreadUncertainty of_value;             ///< U(X) = t_p(ν) u
    std::vector<SpreadUncertainty> others;  ///< n, for each result that of all others
    Eigen::VectorXd share;                  ///< n, of each result in the value; 0 outside
    Eigen::VectorXd covariance;             ///< n, of each result with the value of the others
    double factor = 1.0;                    ///< of U_D, for results that are part of the value
};

/// What trials say beside the standard uncertainties; intervals for the coverage probability of the scheme.
struct TrialIntervals {
    double low = 0.0, high = 0.0;   ///< of the value
    Eigen::VectorXd d_low, d_high;  ///< n, of x − X; NaN for results outside
};

/// Assigned value of an item as its results, a laboratory or the scheme characterise it; what homogeneity and stability of
/// the item add is not in it. Positions are those of LaboratoryData.
struct AssignedValue {
    double value = 0.0;
    double rest = 0.0;        ///< the value is value + rest: see SplitNumber
    std::optional<double> u;  ///< 0: taken as exactly known; none: cannot be stated
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    /// u is not that of the scatter, but that which the stated uncertainties and their covariance give the value.
    bool u_by_statements = false;
    bool leaves_out_degrees = false;          ///< see MedianTrials
    std::optional<ResultUncertainty> stated;  ///< where one result, or the scheme, states it
    /// n, where the value is linear in the results, y = Σ w_i x_i; empty else
    Eigen::VectorXd weights;
    /// False for a consensus that is not linear in the results: its covariance with them is taken as that of their
    /// mean.
    bool correlation_known = true;
    /// Where U(X) comes from the scatter of the results. With `others` empty only U(X) does, and the degrees of
    /// equivalence are those of the stated uncertainties.
    std::optional<ConsensusScatter> scatter;
    std::optional<TrialIntervals> intervals;
    Eigen::VectorXd covariance;               ///< n, cov(x_i, X)
    std::vector<std::size_t> not_consistent;  ///< contributing results outside the largest consistent subset
    std::optional<ConsistencyTest> subset;    ///< test of the largest consistent subset
    bool subset_unique = true;
    std::vector<std::size_t> in_another_subset = {};  ///< of them, those that another one of this size holds
    std::set<std::string> ambiguous_sources;  ///< shared with results in more than one way, see SourceCovariance
};

/// The assigned value by the method that the item asks for.
///
/// \throws InputError     GC-COMPARE-0100 no result left, -0101 a method by uncertainties and results without one,
/// -0102
///                        a method for independent results and correlated ones, -0105 results without the number and
///                        standard deviation of observations; those of gum, with the item in `where`
/// \throws NoResultError  those of gum: a singular covariance, no consistent results, no convergence
[[nodiscard]] AssignedValue assigned_value(const ComparisonScheme& scheme, const LaboratoryData& data);

/// Means and standard deviations of single observations of the contributing results, for Vangel and Rukhin; nothing
/// where one of them states none.
struct Replicates {
    Eigen::VectorXd x, s;
    std::vector<std::size_t> observations;
};
[[nodiscard]] std::optional<Replicates> replicates(const LaboratoryData& data);

}  // namespace gumcert::gum
