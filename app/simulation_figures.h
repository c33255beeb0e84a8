#pragma once

#include <optional>
#include <vector>

#include "app/simulation_texts.h"
#include "reports/study_document.h"

namespace gumcert::app::simulation {

/// Datum part and measurement part against the number of angles; nothing with one number of angles.
[[nodiscard]] std::optional<reports::StudyFigure> parts_figure(const std::vector<AngleStudy>& studies,
                                                               const Scales& scales);
/// Normalised errors of the largest study beside the normal density.
[[nodiscard]] std::optional<reports::StudyFigure> histogram_figure(const std::vector<AngleStudy>& studies);

}  // namespace gumcert::app::simulation
