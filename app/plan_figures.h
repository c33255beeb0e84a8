#pragma once

#include <optional>
#include <string>

#include "app/plan_study.h"
#include "reports/study_document.h"

namespace gumcert::app::plan {

/// "A", "B" or "C".
[[nodiscard]] std::string axis_letter(const engine::RotaryTableMeasurement& layout);

/// Stations, planned and proposed, and reflectors in three views.
[[nodiscard]] reports::StudyFigure layout_figure(const Setting& setting, const Expected& now,
                                                 const std::optional<Proposal>& proposal);
/// Largest U of each error motion beside its target.
[[nodiscard]] reports::StudyFigure bars_figure(const Setting& setting, const Expected& now,
                                               const std::optional<Proposal>& proposal);

}  // namespace gumcert::app::plan
