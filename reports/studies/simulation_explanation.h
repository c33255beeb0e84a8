#pragma once

#include <string>
#include <vector>

#include "reports/forms/study_document.h"
#include "reports/studies/simulation_texts.h"

namespace gumcert::reports::simulation {

/// What a reader who reads no further must know, in three sentences.
[[nodiscard]] std::string found_text(const std::vector<gum::AngleStudy>& studies, const Scales& scales);

/// Which part of a difference from the assumed values is datum and which is measurement.
[[nodiscard]] std::vector<std::string> parts_paragraphs(const std::vector<gum::AngleStudy>& studies,
                                                        const Scales& scales);

/// Numbers of angles with which the datum alone gives the figures of the source paper, by definition of the figure.
[[nodiscard]] reports::StudyTable paper_angles_table(const std::vector<gum::AngleStudy>& studies, const Scales& scales);

/// What follows from that table.
[[nodiscard]] std::vector<std::string> paper_paragraphs(const std::vector<gum::AngleStudy>& studies,
                                                        const Scales& scales);

}  // namespace gumcert::reports::simulation
