#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "gum/comparison/comparison_scheme.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "jobs/budget/budget_job.h"
#include "jobs/file_source.h"
#include "jobs/job_fields.h"
#include "jobs/job_kind.h"

namespace gumcert::jobs {

struct RotaryTableJob;
struct CircleClosureJob;

/// What one laboratory reports for one item in one round, as the job states it.
struct ComparisonResult : gum::ParticipantResult {
    /// Where given, value and uncertainty are those of its only output; `value` is 0 and `uncertainty` empty here.
    std::shared_ptr<const BudgetJob> budget;
    std::string budget_file;
    std::string where;
};

/// A file that the job names as the budget of a participant, whether or not its result can be used.
struct ParticipantBudget {
    std::size_t participant = 0;
    std::string file;
};

/// A result that a participant was to report and did not: an empty cell, or an entry without value.
struct MissingResult {
    std::size_t participant = 0, item = 0, round = 0;
    std::string reason = {};  ///< as the job states it; "" without
};

/// One point that both methods measured.
struct MethodPoint {
    std::string name;       ///< unique together with `direction`
    std::string direction;  ///< "" without; numbers are summarised direction by direction
    std::optional<double> position;
};

/// One side of a comparison of methods.
struct ComparisonSide {
    std::string name;
    std::vector<double> value;                        ///< one a point
    std::vector<gum::ResultUncertainty> uncertainty;  ///< one a point
    Eigen::MatrixXd covariance;                       ///< of the points, u² on the diagonal
    /// Budget whose points are those of the comparison: values, uncertainties, covariance and sources come from it.
    std::shared_ptr<const BudgetJob> budget;
    std::string budget_file;
    /// One a point of the comparison: its position among the points of the budget (0 for a budget without points).
    /// With a budget `value`, `uncertainty` and `covariance` are empty: they follow from its evaluation.
    std::vector<std::size_t> budget_points = {};
    /// A job that measured the deviations of an angle over the turn: one of these two. Its points are angles; values,
    /// uncertainties and covariance follow from its evaluation, as they do with a budget.
    std::shared_ptr<const RotaryTableJob> rotary_table = {};
    std::shared_ptr<const CircleClosureJob> circle_closure = {};
    std::string job_file = {};
    bool of_artefact = false;                  ///< of a circle closure: what stands on the table, not the table
    std::vector<std::size_t> job_angles = {};  ///< one a point of the comparison: its position among the angles
    [[nodiscard]] bool has_job() const { return rotary_table || circle_closure; }

    std::optional<double> cmc_U;
    double audited_factor = 1.0;  ///< on every uncertainty, once the finding is corrected
    std::string audit_finding;
};

enum class MethodCorrelation { none, given, unknown, shared_sources };

/// Method against reference method, `lab` and `reference` of the job.
struct MethodComparisonRequest {
    ComparisonSide laboratory, reference;
    std::vector<MethodPoint> points;
    gum::Unit unit;
    std::string position_name;  ///< "angle"
    std::optional<gum::Unit> position_unit;
    MethodCorrelation correlation = MethodCorrelation::unknown;
    double r = 0.0;                      ///< correlation given: of both values at each point
    bool bias_against_position = false;  ///< else against the reference value
    std::optional<double> tolerance;     ///< D_fail is held against it
};

/// Items, or rounds of them, of several for which nothing can be computed, by their positions, and why. Without a
/// round: in none of them.
using RefusedItems = std::map<std::pair<std::size_t, std::optional<std::size_t>>, gum::Diagnostic>;

/// A job of kind `comparison`. Between laboratories it is a scheme with its results; in a comparison of methods only
/// the coverage probability of the scheme is stated, and `different_sources` and `independent_sources`.
struct ComparisonJob : gum::ComparisonScheme {
    certificate::LocalisedText title;
    std::vector<ComparisonResult> results;  ///< in the order of the files
    std::vector<MissingResult> missing = {};
    /// What is known of the stability of the artefact, and where it is in the uncertainties; "" where nothing is stated.
    std::string artefact_stability = {};
    /// Names of sources that look alike and are different ones, for sure.
    std::vector<std::string> different_sources = {};

    std::optional<MethodComparisonRequest> methods;

    bool names_released = false;  ///< names of participants may stand on documents, beside their ids
    std::vector<ParticipantBudget> participant_budgets = {};
    RefusedItems refused_items = {};
    std::string organiser;  ///< of the comparison, for the report; "" without
    nlohmann::json document;
    std::optional<certificate::CertificateData> certificate;
    std::vector<std::string> files;
    std::vector<gum::Diagnostic> warnings;
};

/// The keys of a comparison job, what they mean and what they allow.
[[nodiscard]] const JobFields& comparison_fields();
/// The same keys, object by object.
[[nodiscard]] std::span<const JobKeys> comparison_job_keys();

/// Reads a job of kind `comparison` with all its files and checks it completely.
/// \throws InputError    with every problem of every file
/// \throws StorageError  if a file cannot be read
[[nodiscard]] ComparisonJob read_comparison_job(const std::filesystem::path& job_file);
[[nodiscard]] ComparisonJob read_comparison_job(const FileSource& source, const std::string& job_file);

}  // namespace gumcert::jobs
