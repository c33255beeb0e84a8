#include "app/evaluate_job.h"

#include "app/file_digest.h"
#include "app/rotary_table_record.h"
#include "engine/contact_point_model.h"
#include "engine/job/rotary_table_job.h"
#include "engine/rotary_table_evaluation.h"
#include "engine/sequential_evaluation.h"
#include "gum/coverage.h"
#include "gum/propagation.h"

namespace gumcert::app {

namespace {

constexpr double k_detection_power = 0.8;  // of the minimal detectable bias, as Baarda chose it

Evaluation evaluate_rotary_table(const std::filesystem::path& job_file, const std::string& covariance_file,
                                 const Progress& progress) {
    const engine::RotaryTableJob job = engine::read_rotary_table_job(job_file);
    std::vector<reports::InputFile> files;
    for (const std::string& name : job.files) {
        files.push_back({name, sha256(read_file(job_file.parent_path() / name))});
    }

    const engine::RotaryTableMeasurement& measurement = job.measurement;
    engine::EvaluationOptions options;
    options.critical_value = gum::two_sided_normal_critical_value(measurement.outliers.alpha);
    options.non_centrality = options.critical_value + gum::standard_normal_quantile(k_detection_power);
    const engine::RotaryTableSolution solution = measurement.method == engine::AdjustmentMethod::joint
                                                     ? engine::evaluate_jointly(measurement, options, progress)
                                                     : engine::evaluate_sequentially(measurement, options, progress);

    if (progress) {
        progress("law of propagation");
    }
    const gum::Propagation propagation = gum::propagate(*solution.model, job.coverage_probability);
    Evaluation evaluation;
    evaluation.covariance_csv = covariance_csv(job, solution.quantities, propagation.covariance);
    if (job.reference) {
        const engine::ContactPointModel contact(solution.model, measurement, solution.datum,
                                                job.reference->contact_point);
        const gum::Propagation displacement = gum::propagate(contact, job.coverage_probability);
        evaluation.record =
            rotary_table_record(job, options, solution, propagation, &displacement, files, covariance_file);
    } else {
        evaluation.record = rotary_table_record(job, options, solution, propagation, nullptr, files, covariance_file);
    }
    return evaluation;
}

}  // namespace

std::vector<std::filesystem::path> input_files(const std::filesystem::path& job_file,
                                               const reports::EvaluationRecord& record) {
    std::vector<std::filesystem::path> files;
    for (const reports::InputFile& file : record.job_files) {
        files.push_back(job_file.parent_path() / file.name);
    }
    return files;
}

Evaluation evaluate_job(const std::filesystem::path& job_file, const std::string& covariance_file,
                        const Progress& progress) {
    std::string kind;
    try {
        kind = engine::job_kind(job_file);
    } catch (const gum::InputError&) {
        (void)engine::read_rotary_table_job(job_file);  // tells the other problems of the job together with this one
        throw;
    }
    if (kind != "rotary_table") {
        throw gum::InputError(gum::Diagnostic{"GC-INPUT-0900", job_file.string() + "#/kind",
                                              "\"" + kind + "\" cannot be evaluated by this version",
                                              "this version evaluates jobs of kind \"rotary_table\"",
                                              "see CHANGELOG.md for what each version brings", gum::Severity::error});
    }
    return evaluate_rotary_table(job_file, covariance_file, progress);
}

}  // namespace gumcert::app
