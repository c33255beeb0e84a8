#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

// Sections of a comparison between laboratories.

/// One item in one round with the results of all laboratories, in the order of the record.
struct ComparedItem {
    const ComparisonItemEvaluation* item = nullptr;
    std::vector<const ComparisonPoint*> points = {};
    Text name = {};
};
[[nodiscard]] std::vector<ComparedItem> compared_items(const Wording& words, const Comparison& comparison);

/// Result, graph and table of scores: the first page, for organisers and participants.
/// \param facts        what stands above the graph: who organised the comparison and when
/// \param conventions  and below these, what D and U stand for
void laboratory_answer(CertificateBuilder& builder, const Wording& words, const Comparison& comparison,
                       std::vector<std::pair<Text, Text>> facts, const std::vector<std::pair<Text, Text>>& conventions);

/// Items, participants, vectors and Youden plots, and how the scores are read.
void laboratory_sections(CertificateBuilder& builder, const Wording& words, const Comparison& comparison);

/// How the assigned value of one item was found, and what was tested.
void assigned_value_section(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared,
                            const std::string& id);

/// Degrees of equivalence of pairs: as a list, as a matrix of E_n, or as a drawing only.
void pairs_of_item(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared,
                   const std::string& id);

/// Name of a method that finds a reference value.
[[nodiscard]] Text reference_value_method(const Wording& words, const std::string& method);

/// "X = 10.0021 mm, U = 0.0006 mm, k = 2"
[[nodiscard]] Text assigned_value_text(const Wording& words, const ComparisonItemEvaluation& item);

/// Name of an item; its id without one.
[[nodiscard]] std::string name_of_item(const Comparison& comparison, const std::string& id);

/// The score as tables and texts name it: "Eₙ".
[[nodiscard]] Text score_name(const Wording& words, const std::string& score);

}  // namespace gumcert::reports
