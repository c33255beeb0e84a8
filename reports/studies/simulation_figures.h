#pragma once

#include <optional>
#include <vector>

#include "reports/forms/study_document.h"
#include "reports/studies/simulation_texts.h"

namespace gumcert::reports::simulation {

/// Datum part and measurement part against the number of angles; nothing with one number of angles.
[[nodiscard]] std::optional<reports::StudyFigure> parts_figure(const std::vector<gum::AngleStudy>& studies,
                                                               const Scales& scales);
/// Normalised errors of the largest study beside the normal density.
[[nodiscard]] std::optional<reports::StudyFigure> histogram_figure(const std::vector<gum::AngleStudy>& studies);

}  // namespace gumcert::reports::simulation
