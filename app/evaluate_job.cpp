#include "app/evaluate_job.h"

#include <optional>
#include <utility>

#include "app/budget_record.h"
#include "app/certificate_inputs.h"
#include "app/certify.h"
#include "app/circle_closure_record.h"
#include "app/document_units.h"
#include "app/evaluate_circle_closure.h"
#include "app/evaluate_comparison.h"
#include "app/evaluate_rotary_table.h"
#include "app/rotary_table_record.h"
#include "encoding/sha2.h"
#include "engine/job/budget_job.h"
#include "engine/job/circle_closure_job.h"
#include "engine/job/comparison_job.h"
#include "engine/job/file_source.h"
#include "engine/job/job_kind.h"
#include "engine/job/rotary_table_job.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/budget/reported_covariance.h"
#include "reports/record_sentences.h"

namespace gumcert::app {

namespace {

// Covariances of more results than this stand in a file of their own; of more than the second number, nowhere.
constexpr std::size_t k_most_results_in_record = 100;
constexpr std::size_t k_most_correlated_results = 2000;

// A record holds the files of its job, so that it can be evaluated again: up to so many bytes of one and of all.
constexpr std::size_t k_largest_held_file = std::size_t{8} << 20U;
constexpr std::size_t k_most_held_bytes = std::size_t{16} << 20U;

/// The files as a record states and holds them: the bytes that were parsed.
std::vector<reports::InputFile> held_files(const engine::ReadOnceSource& source,
                                           const std::vector<std::string>& names) {
    std::vector<reports::InputFile> files;
    std::size_t held = 0;
    for (const std::string& name : names) {
        const std::string bytes = source.read(name);
        const bool holds = bytes.size() <= k_largest_held_file && held + bytes.size() <= k_most_held_bytes;
        held += holds ? bytes.size() : 0;
        files.push_back(reports::input_file(name, bytes, holds));
    }
    return files;
}

/// What is the same for jobs of all kinds.
struct Task {
    const engine::ReadOnceSource& files;
    const std::string& job_file;  ///< name in `files`
    const CovarianceOutput& covariance;
    unsigned threads = 0;
    const std::filesystem::path& templates;
    const gum::Progress& progress;
};

/// The name of the covariance file of a job with these files, where one is written.
std::string covariance_name(CovarianceFile place, CovarianceForm form, const std::vector<reports::InputFile>& files) {
    if (place == CovarianceFile::own_folder) {
        return "covariance" + covariance_ending(form);
    }
    std::string digests;
    for (const reports::InputFile& file : files) {
        digests += file.sha256;
    }
    return "covariance-" + encoding::sha256(digests).substr(0, 12) + covariance_ending(form);
}

/// Whether a covariance file is to be written at all.
bool is_written(const CovarianceOutput& output) {
    return output.file != CovarianceFile::none && output.form != CovarianceForm::none;
}

/// The profile that certificate data ask for: found before the evaluation, which may take long.
std::optional<certificate::Profile> profile_of(const std::optional<certificate::CertificateData>& data,
                                               const std::filesystem::path& templates) {
    return data ? std::optional(certificate_profile(*data, templates)) : std::nullopt;
}

void make_certificate(Evaluation& evaluation, const std::optional<certificate::CertificateData>& data,
                      const std::optional<certificate::Profile>& profile, const CapabilityInputs& inputs) {
    if (data && profile) {
        certify(evaluation.record, *data, *profile, inputs);
        evaluation.blocked = evaluation.record.certificate->blocked;
    }
}

Evaluation evaluate_budget_job(const Task& task) {
    const engine::BudgetJob job = engine::read_budget_job(task.files, task.job_file);
    const std::optional<certificate::Profile> profile = profile_of(job.certificate, task.templates);
    gum::BudgetResult result = gum::evaluate_budget(job, task.threads, task.progress);
    const std::size_t results = result.points.size() * result.output_names.size();
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
    const std::vector<reports::InputFile> files = held_files(task.files, job.files);
    if (results > k_most_results_in_record && covariance.size() > 0 && is_written(task.covariance)) {
        evaluation.covariance = budget_covariance_csv(job, result, covariance);
        evaluation.covariance_file = covariance_name(task.covariance.file, CovarianceForm::csv, files);
    }
    evaluation.record = budget_record(job, result, files, covariance, evaluation.covariance_file);
    evaluation.negative = result.validation_failed;
    if (job.certificate) {
        make_certificate(evaluation, job.certificate, profile, capability_inputs(job, result, task.threads));
    }
    return evaluation;
}

Evaluation evaluate_rotary_table_job(const Task& task) {
    engine::RotaryTableJob job = engine::read_rotary_table_job(task.files, task.job_file);
    const std::optional<certificate::Profile> profile = profile_of(job.certificate, task.templates);
    const RotaryTableResult result = evaluate_rotary_table(job, task.threads, task.progress);
    Evaluation evaluation;
    const std::vector<reports::InputFile> files = held_files(task.files, job.files);
    if (is_written(task.covariance)) {
        const std::vector<gum::OutputQuantity>& quantities = result.solution.quantities.outputs;
        const CovarianceForm form = chosen_form(task.covariance.form, quantities.size());
        std::vector<double> units;
        for (const gum::OutputQuantity& quantity : quantities) {
            units.push_back(unit_of(quantity).si);
        }
        evaluation.covariance = covariance_contents(result.reported.covariance,
                                                    covariance_order(job, result.solution.quantities), units, form);
        evaluation.covariance_file = covariance_name(task.covariance.file, form, files);
    }
    evaluation.record = rotary_table_record(job, result, files, evaluation.covariance_file);
    evaluation.negative = result.validation_failed;
    make_certificate(evaluation, job.certificate, profile, {});
    return evaluation;
}

Evaluation evaluate_circle_closure_job(const Task& task) {
    const engine::CircleClosureJob job = engine::read_circle_closure_job(task.files, task.job_file);
    const std::optional<certificate::Profile> profile = profile_of(job.certificate, task.templates);
    const CircleClosureResult result = evaluate_circle_closure(job, task.threads, task.progress);
    Evaluation evaluation;
    const std::vector<reports::InputFile> files = held_files(task.files, job.files);
    const bool is_large = circle_closure_result_names(job).size() > k_most_results_in_record;
    if (is_large && is_written(task.covariance)) {
        evaluation.covariance = circle_closure_covariance_csv(job, result);
        evaluation.covariance_file = covariance_name(task.covariance.file, CovarianceForm::csv, files);
    }
    evaluation.record = circle_closure_record(job, result, files, evaluation.covariance_file);
    evaluation.negative = result.validation_failed;
    if (job.certificate) {
        make_certificate(evaluation, job.certificate, profile, circle_closure_capability_inputs(job, result));
    }
    return evaluation;
}

Evaluation evaluate_comparison_job(const Task& task) {
    const engine::ComparisonJob job = engine::read_comparison_job(task.files, task.job_file);
    Evaluation evaluation;
    evaluation.record = evaluate_comparison(job, held_files(task.files, job.files), task.progress);
    evaluation.negative = !evaluation.record.comparison->items_without_result.empty();
    return evaluation;
}

}  // namespace

void require_comparison_job(const std::filesystem::path& job_file) {
    const std::optional<std::string> kind = engine::probable_job_kind(job_file);
    // A kind that no job has is told by the reader, with the kinds that there are.
    if (kind == "budget" || kind == "rotary_table" || kind == "circle_closure") {
        throw gum::InputError(gum::Diagnostic{.code = "GC-COMPARE-0140",
                                              .where = job_file.string() + "#/kind",
                                              .what = "a job of kind \"" + *kind + "\" is not a comparison",
                                              .rule = "gumcert compare evaluates jobs of kind \"comparison\"",
                                              .action = "use gumcert evaluate or gumcert run for this job"});
    }
}

std::vector<gum::Diagnostic> warnings_of_job(const std::string& kind, const engine::FileSource& source,
                                             const std::string& job_file) {
    if (kind == "budget") {
        return engine::read_budget_job(source, job_file).warnings;
    }
    if (kind == "circle_closure") {
        return engine::read_circle_closure_job(source, job_file).warnings;
    }
    return kind == "comparison" ? engine::read_comparison_job(source, job_file).warnings
                                : engine::read_rotary_table_job(source, job_file).warnings;
}

std::vector<std::filesystem::path> input_files(const std::filesystem::path& job_file,
                                               const reports::EvaluationRecord& record) {
    std::vector<std::filesystem::path> files;
    for (const reports::InputFile& file : record.job_files) {
        files.push_back(job_file.parent_path() / file.name);
    }
    return files;
}

Evaluation evaluate_job(const std::filesystem::path& job_file, const CovarianceOutput& covariance, unsigned threads,
                        const std::filesystem::path& templates, const gum::Progress& progress) {
    return evaluate_job(engine::DiskFileSource(job_file.parent_path()), job_file.filename().string(), covariance,
                        threads, templates, progress);
}

Evaluation evaluate_job(const engine::FileSource& source, const std::string& job_file,
                        const CovarianceOutput& covariance, unsigned threads, const std::filesystem::path& templates,
                        const gum::Progress& progress) {
    const engine::ReadOnceSource files(source);
    const Task task{.files = files,
                    .job_file = job_file,
                    .covariance = covariance,
                    .threads = threads,
                    .templates = templates,
                    .progress = progress};
    std::string kind;
    try {
        kind = engine::job_kind(files, job_file);
    } catch (const gum::InputError&) {
        // The reader of its kind tells the other problems of the job together with this one.
        (void)warnings_of_job(engine::probable_job_kind(files, job_file).value_or(""), files, job_file);
        throw;
    }
    Evaluation evaluation = kind == "budget"           ? evaluate_budget_job(task)
                            : kind == "comparison"     ? evaluate_comparison_job(task)
                            : kind == "circle_closure" ? evaluate_circle_closure_job(task)
                                                       : evaluate_rotary_table_job(task);
    reports::identify_sentences(evaluation.record, templates);
    return evaluation;
}

}  // namespace gumcert::app
