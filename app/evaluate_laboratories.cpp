#include <algorithm>

#include "app/evaluate_comparison.h"
#include "app/laboratory_estimates.h"
#include "app/laboratory_item.h"
#include "app/laboratory_notes.h"
#include "app/laboratory_scores.h"
#include "app/laboratory_summary.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

namespace {

using Progress = std::function<void(const std::string&)>;

constexpr std::size_t k_items_between_messages = 50;

/// The unit of all items; "" where they differ.
std::string unit_of_items(const engine::ComparisonJob& job) {
    const std::string& unit = job.items.front().unit.text();
    const bool one = std::all_of(job.items.begin(), job.items.end(),
                                 [&](const engine::ComparisonItem& item) { return item.unit.text() == unit; });
    return one ? unit : "";
}

std::string reference_name(const engine::ComparisonJob& job) {
    const engine::AssignedValueRequest& request = job.items.front().assigned_value;
    for (const engine::ComparisonParticipant& participant : job.participants) {
        if (request.method == engine::AssignedValueMethod::reference && participant.id == request.participant) {
            return participant.name.empty() ? participant.id : participant.name;
        }
    }
    return "";
}

std::string audit_findings(const engine::ComparisonJob& job) {
    std::vector<std::string> findings;
    for (const engine::ComparisonResult& result : job.results) {
        if (result.audited && !result.audited->finding.empty()) {
            std::string finding = job.participants[result.participant].id + ": " + result.audited->finding;
            if (std::find(findings.begin(), findings.end(), finding) == findings.end()) {
                findings.push_back(std::move(finding));
            }
        }
    }
    std::string text;
    for (const std::string& finding : findings) {
        text += (text.empty() ? "" : "; ") + finding;
    }
    return text;
}

}  // namespace

reports::Comparison evaluate_laboratories(const engine::ComparisonJob& job, const Progress& progress) {
    reports::Comparison comparison;
    comparison.form = "laboratories";
    comparison.organiser = job.organiser;
    comparison.unit = unit_of_items(job);
    comparison.reference_name = reference_name(job);
    comparison.audit_finding = audit_findings(job);
    const std::vector<engine::ComparisonResult> results = results_with_budgets(job, progress);
    const std::vector<LaboratoryData> data = laboratory_data(job, results, comparison.shared_sources);
    if (data.empty()) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-COMPARE-0100",
                                              .where = "comparison",
                                              .what = "no result",
                                              .rule = "results of at least two laboratories are compared",
                                              .action = "State the results of the participants."});
    }
    std::size_t pairs = 0;
    for (const LaboratoryData& of_item : data) {
        pairs += count_pairs(of_item);
    }
    LeftOut left_out{.vectors = 0, .pairs = pairs > k_most_pairs_in_record};
    std::vector<EvaluatedItem> items;
    std::vector<gum::Diagnostic> problems;
    for (const LaboratoryData& of_item : data) {
        if (progress && items.size() % k_items_between_messages == 0 && data.size() > 1) {
            progress("item " + std::to_string(items.size() + 1) + " of " + std::to_string(data.size()));
        }
        EvaluatedItem item;
        item.data = &of_item;
        item.first_point = comparison.points.size();
        try {
            item.assigned = assigned_value(job, of_item);
            comparison.items.push_back(item_evaluation(job, of_item, item.assigned));
            if (!left_out.pairs) {
                comparison.items.back().pairs = pair_equivalences(job, of_item);
            }
            std::vector<reports::ComparisonPoint> points =
                laboratory_scores(job, of_item, item.assigned, comparison.items.back());
            std::move(points.begin(), points.end(), std::back_inserter(comparison.points));
            items.push_back(std::move(item));
        } catch (const gum::InputError& refused) {  // of every item, not only of the first one
            problems.insert(problems.end(), refused.diagnostics().begin(), refused.diagnostics().end());
        }
    }
    if (!problems.empty()) {
        throw gum::InputError(problems);
    }
    if (std::optional<reports::ComparisonSummary> all =
            summary_of_scores(comparison, items, job.coverage_probability)) {
        comparison.summary.push_back(std::move(*all));
    }
    comparison.participants = participant_summaries(job, comparison);
    comparison.vectors = vector_scores(job, comparison, left_out.vectors);
    comparison.youden = youden_diagrams(job, comparison);
    comparison.remarks = laboratory_remarks(job, comparison, items, left_out);
    return comparison;
}

}  // namespace gumcert::app
