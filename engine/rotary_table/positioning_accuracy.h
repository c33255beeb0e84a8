#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace gumcert::engine {

/// Which deviations belong to which target position and sense of approach: indices into one vector of deviations.
///
/// A sense that was not measured at a target is an empty list; the number of runs may differ from target to target.
struct PositioningRuns {
    std::vector<std::vector<Eigen::Index>> up;    ///< one list a target, approached in the positive sense
    std::vector<std::vector<Eigen::Index>> down;  ///< the same number of targets, in the negative sense
};

/// Parameters of ISO 230-2 for an axis, in the order in which documents list them.
enum class PositioningParameter {
    mean_deviation_range,  ///< M: range of the mean bidirectional deviations
    systematic,            ///< E: range of the mean deviations of both senses together
    systematic_up,         ///< E↑
    systematic_down,       ///< E↓
    repeatability,         ///< R: bidirectional repeatability
    repeatability_up,      ///< R↑
    repeatability_down,    ///< R↓
    reversal,              ///< B: largest magnitude of the reversal
    mean_reversal,         ///< mean of the reversals, with its sign
    accuracy,              ///< A: bidirectional accuracy
    accuracy_up,           ///< A↑
    accuracy_down,         ///< A↓
};
constexpr std::size_t k_positioning_parameters = 12;

/// Short names in the order of `PositioningParameter`: M, E, E_up, E_down, R, R_up, R_down, B, B_mean, A, A_up, A_down.
[[nodiscard]] const std::array<std::string_view, k_positioning_parameters>& positioning_parameter_names();

/// What one target position shows, in the unit of the deviations.
struct PositioningTarget {
    std::optional<double> mean_up, mean_down;  ///< x̄_i↑, x̄_i↓
    std::optional<double> s_up, s_down;        ///< estimators of the repeatability, n - 1; from two runs on
    std::optional<double> reversal;            ///< B_i = x̄_i↑ - x̄_i↓
};

/// Accuracy and repeatability of positioning of one axis, in the unit of the deviations.
struct PositioningAccuracy {
    std::array<std::optional<double>, k_positioning_parameters> parameters;
    std::vector<PositioningTarget> targets;

    [[nodiscard]] const std::optional<double>& operator[](PositioningParameter parameter) const {
        return parameters[static_cast<std::size_t>(parameter)];
    }
};

/// Which parameters the runs allow. One that looks at both senses needs both at every target; one that has a standard
/// deviation in it (R, A) needs two runs or more at every target. There is no parameter over some of the targets: it
/// would look better than the axis.
[[nodiscard]] std::array<bool, k_positioning_parameters> allowed_parameters(const PositioningRuns& runs);

/// Parameters of ISO 230-2 by their definitions, bidirectional ones over both senses:
///
///   B_i = x̄_i↑ - x̄_i↓,  B = max |B_i|,  B̄ = mean B_i,  M = max x̄_i - min x̄_i with x̄_i = (x̄_i↑ + x̄_i↓)/2
///   E↑ = max x̄_i↑ - min x̄_i↑,  E = max(x̄_i↑, x̄_i↓) - min(x̄_i↑, x̄_i↓)
///   R_i↑ = 4 s_i↑,  R_i = max(2 s_i↑ + 2 s_i↓ + |B_i|, R_i↑, R_i↓),  R = max R_i
///   A↑ = max(x̄_i↑ + 2 s_i↑) - min(x̄_i↑ - 2 s_i↑),  A = the same over both senses
///
/// \param deviations  actual minus target position, in any one unit; every index of `runs` must lie in it
[[nodiscard]] PositioningAccuracy evaluate_positioning(const PositioningRuns& runs,
                                                       const Eigen::Ref<const Eigen::VectorXd>& deviations);

/// Derivatives of the parameters with respect to every deviation, 12×n, [1]; zero rows for those that are not allowed.
///
/// Taken at the active extreme: where two targets tie, or a standard deviation or the largest reversal is zero, a
/// parameter has no derivative there; the first of two that tie and zero stand in for it.
[[nodiscard]] Eigen::MatrixXd positioning_derivatives(const PositioningRuns& runs,
                                                      const Eigen::Ref<const Eigen::VectorXd>& deviations);

/// The values of which a parameter takes the largest, less the smallest of some: A↑ is the largest of x̄_i↑ + 2 s_i↑ less the
/// smallest of x̄_i↑ - 2 s_i↑, B the largest of B_i and -B_i.
struct PositioningExtremes {
    Eigen::VectorXd value;                   ///< n, in the unit of the deviations
    Eigen::MatrixXd by_deviation;            ///< n×deviations, [1]; a standard deviation that is 0 has no derivative
    std::vector<Eigen::Index> upper, lower;  ///< among the values; of R and B nothing is taken off
};

/// \param parameter  one that the runs allow, and not the mean of the reversals, which is no extreme
[[nodiscard]] PositioningExtremes positioning_extremes(const PositioningRuns& runs,
                                                       const Eigen::Ref<const Eigen::VectorXd>& deviations,
                                                       PositioningParameter parameter);

}  // namespace gumcert::engine
