#pragma once

#include "reports/plots/svg_plot.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// Whether the angles cover the circle, so that a curve may be closed.
[[nodiscard]] bool covers_circle(const RotaryTable& rotary);

/// Six panels, three rows of linear [µm] and angular [″] error motions against the table angle, with bands of U and
/// strips of U below, closed at 360° where the angles cover the circle; with both senses of approach a curve of each.
[[nodiscard]] Plot error_motion_plot(const RotaryTable& rotary, const Wording& words);

}  // namespace gumcert::reports
