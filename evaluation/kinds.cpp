#include "evaluation/kinds.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/rotary_table/rotary_table_model.h"
#include "evaluation/fixture_budget_audit.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/budget/reported_covariance.h"
#include "gum/circle_closure/evaluate_circle_closure.h"
#include "gum/rotary_table/document_units.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "jobs/budget/budget_job.h"
#include "jobs/circle_closure/circle_closure_job.h"
#include "jobs/comparison/comparison_job.h"
#include "jobs/job_kind.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/make/budget/budget_record.h"
#include "reports/record/make/budget/capability_inputs.h"
#include "reports/record/make/circle_closure/circle_closure_findings.h"
#include "reports/record/make/circle_closure/circle_closure_record.h"
#include "reports/record/make/comparison/evaluate_comparison.h"
#include "reports/record/make/rotary_table/fixture_budget_record.h"
#include "reports/record/make/rotary_table/reference_comparison.h"
#include "reports/record/make/rotary_table/rotary_findings.h"
#include "reports/record/make/rotary_table/rotary_table_record.h"

namespace gumcert::evaluation {

namespace {

// Covariances of more results than this stand in a file of their own; of more than the second number, nowhere.
constexpr std::size_t k_most_results_in_record = 100;
constexpr std::size_t k_most_correlated_results = 2000;

/// Every result has a budget with a row for each input: with as many results as inputs, memory grows as the square.
/// Measured on x86-64: 118 MB and 378 MB for 400 and 800 inputs that are results, 2.9 GB for 100 000 points.
double memory_of(const gum::Budget& budget) {
    constexpr double k_a_result = 28'000.0;  // [byte]
    constexpr double k_a_row = 540.0;        // [byte]
    const std::size_t outputs = budget.model.empty()     ? budget.inputs.size()
                                : budget.outputs.empty() ? budget.model.size()
                                                         : budget.outputs.size();
    const auto results = static_cast<double>(outputs * std::max<std::size_t>(budget.points.size(), 1));
    return results * (k_a_result + k_a_row * static_cast<double>(budget.inputs.size()));
}

/// The sequential method holds two matrices of all sensitivity coefficients; the joint one goes angle by angle.
double memory_of(const engine::RotaryTableMeasurement& measurement) {
    constexpr double k_matrices = 2.0;
    return measurement.method == engine::AdjustmentMethod::joint
               ? 0.0
               : k_matrices * sizeof(double) * engine::sensitivity_coefficient_count(measurement);
}

Evaluation evaluate_budget_job(const EvaluationTask& task) {
    const jobs::BudgetJob job = jobs::read_budget_job(task.files, task.job_file);
    task.begin(job.files, memory_of(job));
    const std::optional<certificate::Profile> profile = task.profile_of(job.certificate);
    gum::BudgetResult result = gum::evaluate_budget(job, task.threads, task.progress);
    const std::size_t results = gum::budget_result_count(result);
    Eigen::MatrixXd covariance;
    if (results > 1 && results <= k_most_correlated_results) {
        covariance = gum::reported_covariance(job, result);
        gum::note_covariance(job, covariance, result);
    } else if (results > 1) {
        result.notes.push_back({.code = "GC-BUDGET-0040",
                                .where = "covariance of the results",
                                .what = std::to_string(results) + " results",
                                .rule = "it is written for up to 2000 results",
                                .action = "Split the table of points where the covariance between points is needed.",
                                .severity = gum::Severity::note});
    }
    Evaluation evaluation;
    const std::vector<reports::InputFile> files = task.held_files(job.files);
    if (results > k_most_results_in_record && covariance.size() > 0 && task.covariance.is_written()) {
        evaluation.covariance = reports::budget_covariance_csv(job, result, covariance);
        evaluation.covariance_file = task.covariance.name(reports::CovarianceForm::csv, files);
    }
    evaluation.record = reports::budget_record(job, result, files, covariance, evaluation.covariance_file);
    evaluation.negative = result.validation_failed;
    if (job.certificate && profile) {
        certify(evaluation, *job.certificate, *profile, reports::capability_inputs(job, result, task.threads),
                job.registered);
    }
    return evaluation;
}

Evaluation evaluate_rotary_table_job(const EvaluationTask& task) {
    jobs::RotaryTableJob job = jobs::read_rotary_table_job(task.files, task.job_file);
    task.begin(job.files, memory_of(job.measurement));
    const std::optional<certificate::Profile> profile = task.profile_of(job.certificate);
    const gum::RotaryTableResult result = gum::evaluate_rotary_table(job, task.threads, task.progress);
    Evaluation evaluation;
    const std::vector<reports::InputFile> files = task.held_files(job.files);
    if (task.covariance.is_written()) {
        const std::vector<gum::OutputQuantity>& quantities = result.solution.quantities.outputs;
        const reports::CovarianceForm form = reports::chosen_form(task.covariance.form, quantities.size());
        std::vector<double> units;
        for (const gum::OutputQuantity& quantity : quantities) {
            units.push_back(gum::unit_of(quantity).si);
        }
        evaluation.covariance = reports::covariance_contents(
            result.reported.covariance, reports::covariance_order(job, result.solution.quantities), units, form);
        evaluation.covariance_file = task.covariance.name(form, files);
    }
    reports::RotaryRecordParts parts{.fixture_budget = reports::fixture_budget_record(job, result.fixture),
                                     .comparison = {}};
    if (result.contact_point) {
        parts.comparison = reports::reference_comparison(job, *result.contact_point);
    }
    evaluation.record = reports::rotary_table_record(job, result, parts, files, evaluation.covariance_file);
    evaluation.negative = result.validation_failed;
    if (job.fixture_budget) {
        evaluation.add_nested_budgets = audit_of_fixture_budget(job, result.fixture, evaluation.record, task.threads);
    }
    make_certificate(task, evaluation, job.certificate, profile, {});
    return evaluation;
}

Evaluation evaluate_circle_closure_job(const EvaluationTask& task) {
    const jobs::CircleClosureJob job = jobs::read_circle_closure_job(task.files, task.job_file);
    task.begin(job.files);
    const std::optional<certificate::Profile> profile = task.profile_of(job.certificate);
    const gum::CircleClosureResult result = gum::evaluate_circle_closure(job, task.threads, task.progress);
    Evaluation evaluation;
    const std::vector<reports::InputFile> files = task.held_files(job.files);
    const bool is_large = reports::circle_closure_result_names(job).size() > k_most_results_in_record;
    if (is_large && task.covariance.is_written()) {
        evaluation.covariance = reports::circle_closure_covariance_csv(job, result);
        evaluation.covariance_file = task.covariance.name(reports::CovarianceForm::csv, files);
    }
    evaluation.record = reports::circle_closure_record(job, result, files, evaluation.covariance_file);
    evaluation.negative = result.validation_failed;
    if (job.certificate) {
        make_certificate(task, evaluation, job.certificate, profile,
                         {.values = {}, .distributions = reports::circle_closure_distributions(job, result)});
    }
    return evaluation;
}

/// Records of the jobs that are compared, for what their makers find against them.
reports::JobJudges judges_of_jobs() {
    return {.rotary_table =
                [](const jobs::RotaryTableJob& job, const gum::RotaryTableResult& result) {
                    const reports::RotaryRecordParts parts{
                        .fixture_budget = reports::fixture_budget_record(job, result.fixture), .comparison = {}};
                    const reports::EvaluationRecord record = reports::rotary_table_record(job, result, parts, {}, "");
                    return reports::JudgedJob{record.diagnostics, reports::rotary_findings(record)};
                },
            .circle_closure =
                [](const jobs::CircleClosureJob& job, const gum::CircleClosureResult& result) {
                    const reports::EvaluationRecord record = reports::circle_closure_record(job, result, {}, "");
                    return reports::JudgedJob{record.diagnostics, reports::circle_closure_findings(record)};
                }};
}

Evaluation evaluate_comparison_job(const EvaluationTask& task) {
    const jobs::ComparisonJob job = jobs::read_comparison_job(task.files, task.job_file);
    task.begin(job.files);
    Evaluation evaluation;
    evaluation.record = reports::evaluate_comparison(job, task.held_files(job.files), task.progress, judges_of_jobs());
    evaluation.negative = !evaluation.record.comparison->items_without_result.empty();
    if (job.certificate) {
        evaluation.waivers = job.certificate->waivers;
    }
    return evaluation;
}

constexpr std::array<std::string_view, 3> k_certificate_forms{"html", "pdf", "dcc"};
constexpr std::array<std::string_view, 3> k_comparison_forms{"html", "pdf", "csv"};

using jobs::FileSource;

const std::array<Kind, 4> k_kinds{{
    {.word = jobs::k_budget_kind,
     .read = [](const FileSource& files, const std::string& job) { return jobs::read_budget_job(files, job).warnings; },
     .evaluate = evaluate_budget_job,
     .document = "certificate",
     .forms = k_certificate_forms},
    {.word = jobs::k_rotary_table_kind,
     .read = [](const FileSource& files,
                const std::string& job) { return jobs::read_rotary_table_job(files, job).warnings; },
     .evaluate = evaluate_rotary_table_job,
     .document = "certificate",
     .forms = k_certificate_forms},
    {.word = jobs::k_circle_closure_kind,
     .read = [](const FileSource& files,
                const std::string& job) { return jobs::read_circle_closure_job(files, job).warnings; },
     .evaluate = evaluate_circle_closure_job,
     .document = "certificate",
     .forms = k_certificate_forms},
    {.word = jobs::k_comparison_kind,
     .read = [](const FileSource& files,
                const std::string& job) { return jobs::read_comparison_job(files, job).warnings; },
     .evaluate = evaluate_comparison_job,
     .document = "comparison",
     .forms = k_comparison_forms},
}};

}  // namespace

std::span<const Kind> program_kinds() {
    return k_kinds;
}

const Kind* find_kind(std::span<const Kind> kinds, std::string_view word) {
    const auto found = std::ranges::find(kinds, word, &Kind::word);
    return found == kinds.end() ? nullptr : &*found;
}

const Kind& kind_of(const reports::EvaluationRecord& record, std::span<const Kind> kinds) {
    const Kind* const found = find_kind(kinds, record.kind);
    return found != nullptr ? *found : kinds.front();
}

std::vector<std::string_view> words_of(std::span<const Kind> kinds) {
    std::vector<std::string_view> words;
    for (const Kind& kind : kinds) {
        words.push_back(kind.word);
    }
    return words;
}

}  // namespace gumcert::evaluation
