#include <algorithm>
#include <set>
#include <utility>

#include "app/evaluate_comparison.h"
#include "app/laboratory_estimates.h"
#include "app/laboratory_item.h"
#include "app/laboratory_notes.h"
#include "app/laboratory_scores.h"
#include "app/laboratory_summary.h"
#include "app/shared_sources.h"
#include "gum/comparison/scores.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"

namespace gumcert::app {

namespace {

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
            return participant.name.empty() || !job.names_released ? participant.id : participant.name;
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

reports::ItemWithoutResult without_result(const engine::ComparisonItem& item, const std::string& round,
                                          const gum::Diagnostic& because) {
    return {.id = item.id,
            .name = item.name,
            .round = round,
            .code = because.code,
            .what = because.what,
            .rule = because.rule,
            .action = because.action};
}

/// Items for which it is known before that nothing can be computed.
void add_refused_items(const engine::ComparisonJob& job, const engine::RefusedItems& refused,
                       reports::Comparison& comparison, std::vector<gum::Diagnostic>& problems) {
    for (const auto& [part, because] : refused) {
        comparison.items_without_result.push_back(
            without_result(job.items[part.first], part.second ? job.rounds[*part.second] : "", because));
        problems.push_back(because);
    }
}

bool is_refused(const engine::ComparisonJob& job, const engine::RefusedItems& refused, const LaboratoryData& data) {
    const auto item = static_cast<std::size_t>(data.item - job.items.data());
    const auto round =
        static_cast<std::size_t>(std::find(job.rounds.begin(), job.rounds.end(), data.round) - job.rounds.begin());
    return refused.contains({item, std::nullopt}) || refused.contains({item, round});
}

/// The names of all sources that results and assigned values state.
std::set<std::string> source_names(const engine::ComparisonJob& job,
                                   const std::vector<engine::ComparisonResult>& results) {
    std::set<std::string> names;
    const auto add = [&](const std::vector<engine::UncertaintySource>& sources) {
        for (const engine::UncertaintySource& source : sources) {
            names.insert(source.source);
        }
    };
    for (const engine::ComparisonResult& result : results) {
        add(result.sources);
    }
    for (const engine::ComparisonItem& item : job.items) {
        add(item.assigned_value.sources);
    }
    return names;
}

/// Where at least one item has a result the others are told beside it; else the job is refused.
void tell_problems(const std::vector<gum::Diagnostic>& problems, const reports::Comparison& comparison, bool is_input,
                   std::vector<gum::Diagnostic>* notes) {
    if (problems.empty()) {
        return;
    }
    if (comparison.items.empty()) {
        if (is_input) {
            throw gum::InputError(problems);
        }
        throw gum::NoResultError(problems);
    }
    for (gum::Diagnostic problem : problems) {
        problem.severity = gum::Severity::warning;
        if (notes != nullptr) {
            notes->push_back(std::move(problem));
        }
    }
}

}  // namespace

reports::Comparison evaluate_laboratories(const engine::ComparisonJob& job, const gum::Progress& progress,
                                          std::vector<gum::Diagnostic>* notes) {
    reports::Comparison comparison;
    comparison.names_released = job.names_released;
    comparison.score_probability = gum::en_coverage_probability(job.coverage_probability);
    comparison.form = "laboratories";
    comparison.organiser = job.organiser;
    comparison.unit = unit_of_items(job);
    comparison.reference_name = reference_name(job);
    comparison.audit_finding = audit_findings(job);
    engine::RefusedItems refused_items = job.refused_items;
    const std::vector<engine::ComparisonResult> results = results_with_budgets(job, progress, refused_items);
    std::vector<LaboratoryData> data = laboratory_data(job, results);
    if (data.empty()) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-COMPARE-0112",
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
    bool is_input = false;
    add_refused_items(job, refused_items, comparison, problems);
    for (LaboratoryData& of_item : data) {
        if (is_refused(job, refused_items, of_item)) {
            continue;
        }
        if (progress && items.size() % k_items_between_messages == 0 && data.size() > 1) {
            progress("item " + std::to_string(items.size() + 1) + " of " + std::to_string(data.size()));
        }
        EvaluatedItem item;
        item.data = &of_item;
        item.first_point = comparison.points.size();
        const auto refused = [&](const gum::DiagnosedError& error) {
            problems.insert(problems.end(), error.diagnostics().begin(), error.diagnostics().end());
            comparison.items_without_result.push_back(
                without_result(*of_item.item, of_item.round, error.diagnostics().front()));
        };
        try {
            relate_results(job, of_item, comparison.shared_sources);
            item.assigned = assigned_value(job, of_item);
            reports::ComparisonItemEvaluation evaluation = item_evaluation(job, of_item, item.assigned);
            std::vector<reports::ComparisonPoint> points = laboratory_scores(job, of_item, item.assigned, evaluation);
            if (!left_out.pairs) {
                evaluation.pairs = pair_equivalences(job, of_item);
            }
            comparison.items.push_back(std::move(evaluation));
            std::move(points.begin(), points.end(), std::back_inserter(comparison.points));
            items.push_back(std::move(item));
        } catch (const gum::InputError& error) {  // one item does not lose the others
            is_input = true;
            refused(error);
        } catch (const gum::NoResultError& error) {
            refused(error);
        }
    }
    tell_problems(problems, comparison, is_input, notes);
    if (notes != nullptr) {
        const std::vector<gum::Diagnostic> alike =
            similar_source_names(source_names(job, results), job.different_sources);
        notes->insert(notes->end(), alike.begin(), alike.end());
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
