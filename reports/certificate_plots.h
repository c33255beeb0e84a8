#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/svg_plot.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// Six panels, three rows of linear [µm] and angular [″] error motions against the table angle, with bands of U.
[[nodiscard]] Plot error_motion_plot(const RotaryTable& rotary, const Wording& words);

}  // namespace gumcert::reports
