#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/svg_plot.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// Six panels, three rows of linear [µm] and angular [″] error motions against the table angle, with bands of U.
[[nodiscard]] Plot error_motion_plot(const RotaryTable& rotary, const Wording& words);

/// E_n numbers of the three directions against the angle, with the limits ±1.
[[nodiscard]] Plot En_plot(const Comparison& comparison, const Wording& words);

/// Displacement from the error motions and by the reference method, one panel a direction, with bars of U, [µm].
[[nodiscard]] Plot displacement_plot(const Comparison& comparison, const Wording& words);

}  // namespace gumcert::reports
