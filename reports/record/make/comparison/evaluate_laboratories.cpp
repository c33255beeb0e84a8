#include <algorithm>
#include <set>
#include <utility>

#include "gum/comparison/laboratory_comparison.h"
#include "gum/expression/name_spelling.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "reports/record/make/comparison/evaluate_comparison.h"
#include "reports/record/make/comparison/laboratory_budgets.h"
#include "reports/record/make/comparison/laboratory_notes.h"
#include "reports/record/make/comparison/laboratory_record.h"

namespace gumcert::reports {

namespace {

/// The unit of all items; "" where they differ.
std::string unit_of_items(const jobs::ComparisonJob& job) {
    const std::string& unit = job.items.front().unit.text();
    const bool one = std::all_of(job.items.begin(), job.items.end(),
                                 [&](const gum::ComparisonItem& item) { return item.unit.text() == unit; });
    return one ? unit : "";
}

std::string reference_name(const jobs::ComparisonJob& job) {
    const gum::AssignedValueRequest& request = job.items.front().assigned_value;
    for (const gum::ComparisonParticipant& participant : job.participants) {
        if (request.method == gum::AssignedValueMethod::reference && participant.id == request.participant) {
            return participant.name.empty() || !job.names_released ? participant.id : participant.name;
        }
    }
    return "";
}

std::string audit_findings(const jobs::ComparisonJob& job) {
    std::vector<std::string> findings;
    for (const jobs::ComparisonResult& result : job.results) {
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

reports::ItemWithoutResult without_result(const gum::ComparisonItem& item, const std::string& round,
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
void add_refused_items(const jobs::ComparisonJob& job, const jobs::RefusedItems& refused,
                       reports::Comparison& comparison, std::vector<gum::Diagnostic>& problems) {
    for (const auto& [part, because] : refused) {
        comparison.items_without_result.push_back(
            without_result(job.items[part.first], part.second ? job.rounds[*part.second] : "", because));
        problems.push_back(because);
    }
}

/// The results of items for which nothing is refused yet.
std::vector<gum::ParticipantResult> without_refused(const jobs::RefusedItems& refused,
                                                    const std::vector<gum::ParticipantResult>& results) {
    std::vector<gum::ParticipantResult> kept;
    std::copy_if(results.begin(), results.end(), std::back_inserter(kept), [&](const gum::ParticipantResult& result) {
        return !refused.contains({result.item, std::nullopt}) && !refused.contains({result.item, result.round});
    });
    return kept;
}

/// Items of which the numbers give no result.
/// \return whether their input is to blame
bool add_items_without_result(const jobs::ComparisonJob& job, const gum::LaboratoryComparison& evaluated,
                              reports::Comparison& comparison, std::vector<gum::Diagnostic>& problems) {
    bool is_input = false;
    for (const gum::ItemWithoutResult& item : evaluated.without_result) {
        problems.insert(problems.end(), item.because.begin(), item.because.end());
        comparison.items_without_result.push_back(
            without_result(job.items[item.item], job.rounds[item.round], item.because.front()));
        is_input = is_input || item.refused_input;
    }
    return is_input;
}

/// The names of all sources that results and assigned values state.
std::set<std::string> source_names(const jobs::ComparisonJob& job, const std::vector<gum::ParticipantResult>& results) {
    std::set<std::string> names;
    const auto add = [&](const std::vector<gum::UncertaintySource>& sources) {
        for (const gum::UncertaintySource& source : sources) {
            names.insert(source.source);
        }
    };
    for (const gum::ParticipantResult& result : results) {
        add(result.sources);
    }
    for (const gum::ComparisonItem& item : job.items) {
        add(item.assigned_value.sources);
    }
    return names;
}

/// Where at least one item has a result, the problems of the others are reported beside it; else the job is refused.
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

std::vector<reports::BudgetFile> budget_files(const jobs::ComparisonJob& job) {
    std::vector<reports::BudgetFile> files;
    for (const jobs::ParticipantBudget& budget : job.participant_budgets) {
        files.push_back({job.participants[budget.participant].id, budget.file});
    }
    return files;
}

}  // namespace

reports::Comparison evaluate_laboratories(const jobs::ComparisonJob& job, const gum::Progress& progress,
                                          std::vector<gum::Diagnostic>* notes) {
    jobs::RefusedItems refused_items = job.refused_items;
    std::vector<std::string> of_budgets;
    const std::vector<gum::ParticipantResult> results = results_with_budgets(job, progress, refused_items, of_budgets);
    const std::vector<gum::ParticipantResult> kept = without_refused(refused_items, results);
    const bool all_refused = kept.empty() && !results.empty();
    const gum::LaboratoryComparison evaluated =
        all_refused ? gum::LaboratoryComparison{} : gum::evaluate_laboratories(job, kept, progress);
    reports::Comparison comparison = laboratory_record(job, kept, evaluated);
    comparison.names_released = job.names_released;
    comparison.budget_files = budget_files(job);
    comparison.form = "laboratories";
    comparison.organiser = job.organiser;
    comparison.unit = unit_of_items(job);
    comparison.reference_name = reference_name(job);
    comparison.audit_finding = audit_findings(job);
    std::vector<gum::Diagnostic> problems;
    add_refused_items(job, refused_items, comparison, problems);
    const bool is_input = add_items_without_result(job, evaluated, comparison, problems);
    tell_problems(problems, comparison, is_input, notes);
    comparison.remarks = laboratory_remarks(job, evaluated, comparison);
    comparison.remarks.insert(comparison.remarks.end(), of_budgets.begin(), of_budgets.end());
    if (notes != nullptr) {
        const std::vector<gum::Diagnostic> alike =
            gum::similar_source_names(source_names(job, results), job.different_sources);
        notes->insert(notes->end(), alike.begin(), alike.end());
        const std::vector<gum::Diagnostic> of_items = laboratory_diagnostics(job, evaluated, comparison);
        notes->insert(notes->end(), of_items.begin(), of_items.end());
    }
    return comparison;
}

}  // namespace gumcert::reports
