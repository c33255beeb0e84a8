#include "gum/rotary_table/positioning_scope.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/rotary_table/positioning_accuracy.h"

namespace gumcert::gum {

bool rests_on_scatter(const std::string& short_name) {
    return short_name.starts_with('R') || short_name.starts_with('A');
}

PositioningScope positioning_scope(const engine::TableParameterModel& model) {
    // A maximum grows with the noise of the deviations, and its uncertainty does not cover that growth (ADR 0017).
    constexpr double k_largest_ratio = 0.25;
    const engine::PositioningAccuracy positioning = model.positioning();
    PositioningScope scope;
    scope.largest_ratio = k_largest_ratio;
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
    scope.stated = scope.u_deviation <= k_largest_ratio * range;
    // Of the variance of the runs, which is that of the table and that of the measurement together.
    scope.scatter_stated = std::pow(scope.u_deviation, 2) <= k_largest_scatter_share * std::pow(scope.s_runs, 2);
    return scope;
}

}  // namespace gumcert::gum
