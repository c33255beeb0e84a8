#include "reports/record/make/comparison/evaluate_comparison.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "gum/comparison/laboratory_covariance.h"
#include "gum/comparison/proficiency_scheme.h"
#include "gum/comparison/reference_estimates.h"
#include "gum/quantity/progress.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/record_kinds.h"

namespace gumcert::reports {

namespace {

/// Limits and constants in force that the job does not state.
nlohmann::json options_of(const jobs::ComparisonJob& job) {
    if (job.methods) {
        return {{"form", "methods"}};
    }
    return {{"form", "laboratories"},
            {"assigned_value_criterion", gum::k_assigned_value_criterion},
            {"metrological_compatibility_kappa", 2.0},
            {"most_laboratories_in_pairs", gum::k_most_laboratories_in_pairs},
            {"most_results_of_pair_count", gum::k_most_results_of_pair_count},
            {"most_correlated_laboratories", gum::k_most_correlated_laboratories},
            {"youden_ellipse_probability", 0.95}};
}

/// A job of this kind may carry certificate data by mistake.
std::vector<gum::Diagnostic> notes_on(const jobs::ComparisonJob& job, std::vector<gum::Diagnostic> notes) {
    if (job.certificate) {
        notes.push_back({.code = "GC-COMPARE-0125",
                         .where = "job, certificate",
                         .what = "a comparison report is no calibration certificate",
                         .rule = "no accreditation symbol is put on it, and the checks before issue are not made",
                         .action =
                             "Number, laboratory and day of issue stand on the report; put other certificate data into "
                             "the job of the calibration.",
                         .severity = gum::Severity::note});
    }
    return notes;
}

}  // namespace

reports::EvaluationRecord evaluate_comparison(const jobs::ComparisonJob& job,
                                              const std::vector<reports::InputFile>& files,
                                              const gum::Progress& progress, const JobJudges& judges) {
    std::vector<gum::Diagnostic> found;
    reports::Comparison comparison =
        job.methods ? evaluate_methods(job, &found, judges) : evaluate_laboratories(job, progress, &found);
    comparison.artefact_stability = job.artefact_stability;
    if (job.certificate) {
        const certificate::CertificateData& data = *job.certificate;
        comparison.languages = data.languages;
        comparison.issuer = reports::ComparisonIssuer{.laboratory = data.laboratory.name,
                                                      .number = data.number,
                                                      .issued = data.dates.issued,
                                                      .amendment = data.amendment};
    }
    const std::vector<gum::Diagnostic> notes = notes_on(job, std::move(found));
    reports::EvaluationRecord record = reports::record_head(
        reports::k_comparison_kind, {job.title, job.coverage_probability, job.document, job.warnings, notes},
        options_of(job), files);
    record.comparison = std::move(comparison);
    return record;
}

}  // namespace gumcert::reports
