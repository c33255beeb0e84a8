#include "evaluation/evaluate_job.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "certificate/gates/gates.h"
#include "evaluation/audit_evaluation.h"
#include "jobs/job_kind.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/record_sentences.h"
#include "reports/forms/render.h"
#include "reports/view/named_tables.h"

namespace gumcert::evaluation {

void require_comparison_job(const std::filesystem::path& job_file) {
    jobs::require_job_file(jobs::DiskFileSource::of_job(job_file), job_file.filename().string());
    const std::optional<std::string> kind = jobs::probable_job_kind(job_file);
    // The reader reports an unknown kind, and lists those that there are.
    if (kind && *kind != jobs::k_comparison_kind && find_kind(program_kinds(), *kind) != nullptr) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-COMPARE-0140",
                                              .where = job_file.string() + "#/kind",
                                              .what = "a job of kind \"" + *kind + "\" is not a comparison",
                                              .rule = "gumcert compare evaluates jobs of kind \"comparison\"",
                                              .action = "use gumcert evaluate or gumcert run for this job"});
    }
}

std::vector<std::filesystem::path> input_files(const std::filesystem::path& job_file,
                                               const reports::EvaluationRecord& record,
                                               const std::filesystem::path& laboratory) {
    std::vector<std::filesystem::path> files;
    for (const reports::InputFile& file : record.job_files) {
        const bool is_of_laboratory = !laboratory.empty() && file.name.starts_with(jobs::k_laboratory_prefix);
        files.push_back(is_of_laboratory ? laboratory / file.name.substr(jobs::k_laboratory_prefix.size())
                                         : job_file.parent_path() / file.name);
    }
    return files;
}

namespace {

/// The results before an adjustment stand in a table of the document, as certificate data say: their numbers are those of the
/// document in its own languages.
void judge_named_tables(reports::EvaluationRecord& record, const std::filesystem::path& templates) {
    if (!record.certificate || !reports::names_tables_before_adjustment(*record.certificate)) {
        return;
    }
    reports::RenderAssets assets;
    assets.templates = templates;
    const std::vector<certificate::Finding> found = reports::findings_on_named_tables(
        *record.certificate, reports::view_of_document(record, assets), record.certificate->data.languages);
    certificate::add_findings(*record.certificate, found);
}

}  // namespace

Evaluation evaluate_job(const std::filesystem::path& job_file, const CovarianceOutput& covariance, unsigned threads,
                        const std::filesystem::path& templates, const gum::Progress& progress,
                        std::span<const Kind> kinds, const std::filesystem::path& laboratory,
                        const BeforeEvaluation& before) {
    return evaluate_job(jobs::DiskFileSource::of_job(job_file, laboratory), job_file.filename().string(), covariance,
                        threads, templates, progress, kinds, before);
}

Evaluation evaluate_job(const jobs::FileSource& source, const std::string& job_file, const CovarianceOutput& covariance,
                        unsigned threads, const std::filesystem::path& templates, const gum::Progress& progress,
                        std::span<const Kind> kinds, const BeforeEvaluation& before) {
    const jobs::ReadOnceSource files(source);
    const EvaluationTask task{.files = files,
                              .job_file = job_file,
                              .covariance = covariance,
                              .threads = threads,
                              .templates = templates,
                              .progress = progress,
                              .before = before};
    const std::vector<std::string_view> words = words_of(kinds);
    const Kind* kind = nullptr;
    jobs::require_job_file(files, job_file);
    try {
        kind = find_kind(kinds, jobs::job_kind(files, job_file, words));
    } catch (const gum::InputError&) {
        // The reader of its kind reports the other problems of the job together with this one.
        kind = find_kind(kinds, jobs::probable_job_kind(files, job_file, words).value_or(""));
        if (kind != nullptr) {
            (void)kind->read(files, job_file);
        }
        throw;
    }
    const std::shared_ptr<const reports::ProgramSentences> sentences = reports::read_sentences(templates);
    Evaluation evaluation = kind->evaluate(task);
    judge_named_tables(evaluation.record, templates);
    audit_evaluation(evaluation, job_file);
    reports::identify_sentences(evaluation.record, *sentences);
    return evaluation;
}

}  // namespace gumcert::evaluation
