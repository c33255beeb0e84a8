#include "gum/rotary_table/positioning_scope.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "engine/rotary_table/positioning_accuracy.h"

namespace gumcert::gum {

bool rests_on_scatter(const std::string& short_name) {
    return short_name.starts_with('R') || short_name.starts_with('A');
}

bool holds_noise_already(const engine::TableParameters& parameters, Eigen::Index output) {
    const engine::TableParameterLayout& layout = parameters.layout();
    if (output < layout.positioning) {
        return output < layout.axis_line;  // ranges come first; the axis is a mean over all angles
    }
    return parameters.short_names()[static_cast<std::size_t>(output)] != "B_mean";
}

namespace {

/// Part of the variance of the reversals about their mean that comes from the measurement. Where it is large, the largest
/// reversal is the largest noise beside the mean; one of two targets says nothing.
double share_in_reversals(const engine::TableParameterModel& model, const engine::PositioningAccuracy& positioning,
                          double u_deviation) {
    const engine::PositioningRuns& runs = model.parameters()->runs();
    double sum = 0.0;
    double squares = 0.0;
    double noise = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < positioning.targets.size(); ++i) {
        if (const std::optional<double>& reversal = positioning.targets[i].reversal) {
            sum += *reversal;
            squares += *reversal * *reversal;
            // A reversal is the difference of two means of runs.
            noise += u_deviation * u_deviation *
                     (1.0 / static_cast<double>(runs.up[i].size()) + 1.0 / static_cast<double>(runs.down[i].size()));
            count += 1.0;
        }
    }
    const double variance = count > 2.0 ? (squares - sum * sum / count) / (count - 1.0) : 0.0;
    return variance > 0.0 ? noise / count / variance : std::numeric_limits<double>::infinity();
}

}  // namespace

PositioningScope positioning_scope(const engine::TableParameterModel& model) {
    const engine::PositioningAccuracy positioning = model.positioning();
    PositioningScope scope;
    scope.largest_ratio = k_largest_u_against_E;
    scope.u_deviation = model.rms_position_uncertainty();
    // Pooled over targets and senses: one standard deviation of a few runs says little.
    double squares = 0.0;
    double count = 0.0;
    for (const engine::PositioningTarget& target : positioning.targets) {
        for (const std::optional<double>& s : {target.s_up, target.s_down}) {
            squares += s ? *s * *s : 0.0;
            count += s ? 1.0 : 0.0;
        }
    }
    scope.s_runs = count > 0.0 ? std::sqrt(squares / count) : 0.0;
    using engine::PositioningParameter;
    double range = 0.0;
    for (const PositioningParameter parameter : {PositioningParameter::systematic, PositioningParameter::systematic_up,
                                                 PositioningParameter::systematic_down}) {
        range = std::max(range, positioning[parameter].value_or(0.0));
    }
    scope.stated = scope.u_deviation <= k_largest_u_against_E * range;
    // Of the variance of the runs, which is that of the table and that of the measurement together.
    scope.scatter_stated = std::pow(scope.u_deviation, 2) <= k_largest_scatter_share * std::pow(scope.s_runs, 2);
    scope.reversal_share = share_in_reversals(model, positioning, scope.u_deviation);
    // The scatter of the runs tells how far reversals differ that are alike at all targets, and is independent of their means; what
    // differs by far more depends on the angle.
    scope.reversal_stated = scope.scatter_stated || scope.reversal_share <= k_largest_reversal_share;
    return scope;
}

}  // namespace gumcert::gum
