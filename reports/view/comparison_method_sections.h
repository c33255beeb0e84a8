#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

#include <utility>
#include <vector>

namespace gumcert::reports {

// Sections of a comparison of a method with a reference method.

/// Result, graph and summary by direction: the first page.
/// \param facts        what stands above the graph: who organised the comparison and when
/// \param conventions  and below these, what D and U stand for
void method_answer(CertificateBuilder& builder, const Wording& words, const Comparison& comparison,
                   std::vector<std::pair<Text, Text>> facts, const std::vector<std::pair<Text, Text>>& conventions);

/// Companion numbers and how they are read, bias line, budgets of both sides, points.
void method_sections_of_comparison(CertificateBuilder& builder, const Wording& words, const Comparison& comparison);

}  // namespace gumcert::reports
