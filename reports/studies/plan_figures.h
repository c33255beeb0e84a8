#pragma once

#include <optional>
#include <string>

#include "gum/rotary_table/studies/plan_study.h"
#include "reports/forms/study_document.h"

namespace gumcert::reports::plan {

/// "A", "B" or "C".
[[nodiscard]] std::string axis_letter(const engine::RotaryTableMeasurement& layout);

/// Stations, planned and proposed, and reflectors in three views.
[[nodiscard]] reports::StudyFigure layout_figure(const gum::plan::Setting& setting, const gum::plan::Expected& now,
                                                 const std::optional<gum::plan::Proposal>& proposal);
/// Largest U of each error motion beside its target.
[[nodiscard]] reports::StudyFigure bars_figure(const gum::plan::Setting& setting, const gum::plan::Expected& now,
                                               const std::optional<gum::plan::Proposal>& proposal);

}  // namespace gumcert::reports::plan
