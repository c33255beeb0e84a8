#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/kinds.h"
#include "gum/coverage.h"
#include "gum/type_a.h"
#include "jobs/job_files.h"
#include "jobs/job_kind.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/reported_result.h"
#include "reports/view/certificate_builder.h"
#include "reports/view/document_kinds.h"

// A kind of jobs that the program does not have, added with public headers alone: the mean of repeated readings in
// millimetres. docs/extending.md says the steps; each stands below once: reader, evaluation with maker, sections, rows.

namespace gumcert::toy {

inline constexpr std::string_view k_toy_kind = "toy";
inline constexpr std::array<std::string_view, 1> k_words{k_toy_kind};

struct ToyJob {
    std::string title;
    std::vector<double> readings_mm;
    nlohmann::json document;
    std::vector<std::string> files;
    std::vector<gum::Diagnostic> warnings;
};

/// \throws gum::InputError  with every problem of the job
inline ToyJob read_toy_job(const jobs::FileSource& source, const std::string& job_file) {
    constexpr std::array<std::string_view, 4> k_keys{"schema", "kind", "title", "readings_mm"};
    jobs::JobFiles files(source, job_file);
    const jobs::JobFiles::File file = files.job();
    ToyJob job;
    if (auto document = jobs::read_json_document(file.bytes, *file.problems)) {
        if (jobs::read_kind(*document, *file.problems, k_words)) {
            if (const auto root = jobs::JsonObject::root(*document, k_keys, *file.problems)) {
                job.title = root->required_name("title").value_or("");
                job.readings_mm = root->required_numbers("readings_mm", 5).value_or(std::vector<double>());
            }
        }
        job.document = std::move(document->value);
    }
    files.refuse_if_needed();
    job.files = files.names();
    job.warnings = files.warnings();
    return job;
}

inline evaluation::Evaluation evaluate_toy_job(const evaluation::EvaluationTask& task) {
    constexpr double k_coverage_probability = 0.9545;
    const ToyJob job = read_toy_job(task.files, task.job_file);
    const gum::ObservationSummary mean = gum::evaluate_type_a(job.readings_mm);
    const double u = mean.standard_deviation_of_mean;
    const double k = gum::coverage_factor(k_coverage_probability, mean.degrees_of_freedom);

    evaluation::Evaluation evaluation;
    evaluation.record = reports::record_head(std::string(k_toy_kind),
                                             {.title = job.title,
                                              .coverage_probability = k_coverage_probability,
                                              .document = job.document,
                                              .warnings = job.warnings,
                                              .notes = {}},
                                             nlohmann::json::object(), task.held_files(job.files));
    reports::Result result;
    result.name = "mean";
    result.description = "mean of the readings";
    result.value = mean.mean;
    result.unit = "mm";
    result.u = u;
    result.nu_eff = mean.degrees_of_freedom;
    result.k = k;
    result.U = k * u;
    result.distribution = "student_t";
    result.reported = reports::law_of_propagation_result(result.value, u, result.U, k, k_coverage_probability);
    reports::print_reported(result.reported, result.unit);
    result.printed = result.reported.printed;
    evaluation.record.results.push_back(std::move(result));
    return evaluation;
}

/// The readings as the job states them: below the sections that every record with results has.
inline void readings_section(reports::CertificateBuilder& builder, const reports::Wording& /*words*/,
                             const reports::EvaluationRecord& record) {
    builder.section("readings", "Readings of the toy");
    reports::Rows rows;
    const nlohmann::json job = nlohmann::json::parse(record.job_json);
    for (const nlohmann::json& reading : job["readings_mm"]) {
        rows.push_back({reports::plain(reading.get<double>())});
    }
    builder.table("readings", "As they were read.", {{"reading", "mm", true}}, rows);
}

inline constexpr std::array<std::string_view, 2> k_forms{"html", "text"};

/// Its row in the table of kinds …
inline constexpr evaluation::Kind k_kind{
    .word = k_toy_kind,
    .read = [](const jobs::FileSource& source,
               const std::string& job_file) { return read_toy_job(source, job_file).warnings; },
    .evaluate = evaluate_toy_job,
    .document = "toy",
    .forms = k_forms};
/// … and in that of documents.
inline constexpr reports::DocumentKind k_document{.word = k_toy_kind, .evidence = readings_section};

/// The kinds of the program, and this one.
template <class Row>
std::vector<Row> with(std::span<const Row> rows, const Row& further) {
    std::vector<Row> all(rows.begin(), rows.end());
    all.push_back(further);
    return all;
}

}  // namespace gumcert::toy
