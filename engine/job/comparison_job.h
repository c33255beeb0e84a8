#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificate/certificate_data.h"
#include "engine/job/budget_job.h"
#include "engine/job/file_source.h"
#include "engine/job/job_kind.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::engine {

struct RotaryTableJob;
struct CircleClosureJob;

// Values and uncertainties of a comparison stay in the unit of its item, as the laboratories state them: nothing is
// combined across units, and a conversion to SI and back could change the last digit of a participant's result.

/// Standard and expanded uncertainty of one result, from `u` or from `U` with `k`; a bare number is refused.
struct ResultUncertainty {
    double u = 0.0;
    double U = 0.0;  ///< as stated, or t_p(ν) u
    double k = 2.0;
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    bool stated_as_expanded = false;
};

/// A part of the uncertainty of a result that comes from a named source: a standard, an instrument, a certificate.
/// Results whose parts name the same source are correlated through it.
struct UncertaintySource {
    std::string source;
    std::string input;          ///< name of the input of a budget; "" where the job states the part itself
    double contribution = 0.0;  ///< signed, sensitivity times standard uncertainty, in the unit of the item
};

/// A correction of a stated uncertainty after an audit ("MPE taken as a standard uncertainty").
struct AuditedUncertainty {
    ResultUncertainty uncertainty;
    std::string finding;
};

/// What one laboratory reports for one item in one round.
struct ComparisonResult {
    std::size_t participant = 0, item = 0, round = 0;  ///< positions in the lists of the job
    double value = 0.0;
    std::optional<ResultUncertainty> uncertainty;
    std::optional<double> standard_deviation;  ///< of single observations, for Vangel-Rukhin and algorithm S
    std::size_t observations = 0;              ///< their number; 0: not stated
    bool contributes = true;                   ///< to the assigned value
    std::string reason;                        ///< why it does not
    std::vector<UncertaintySource> sources;
    /// Where given, value and uncertainty are those of its only output; `value` is 0 and `uncertainty` empty here.
    std::shared_ptr<const BudgetJob> budget;
    std::string budget_file;
    std::optional<AuditedUncertainty> audited;
    std::string where;
};

/// A result that a participant was to report and did not: an empty cell, or an entry without value.
struct MissingResult {
    std::size_t participant = 0, item = 0, round = 0;
    std::string reason = {};  ///< as the job states it; "" without
};

struct ComparisonParticipant {
    std::string id;
    std::string name;             ///< for documents; the id where the job has none
    std::string group;            ///< those of one group may share effects; "" without
    std::optional<double> cmc_U;  ///< expanded uncertainty of the laboratory's capability, unit of the item
};

enum class AssignedValueMethod {
    reference,  ///< the result of one participant, or of the side `reference`
    given,
    weighted_mean,
    arithmetic_mean,
    median,
    algorithm_a,
    q_hampel,
    largest_consistent_subset,
    dersimonian_laird,
    mandel_paule,
    vangel_rukhin,
    power_moderated_mean,
};
/// The words of the job, in the order of the enumeration.
[[nodiscard]] std::span<const std::string_view> assigned_value_words();

struct AssignedValueRequest {
    AssignedValueMethod method = AssignedValueMethod::weighted_mean;
    std::string participant;                       ///< method reference: its id
    double value = 0.0;                            ///< method given
    std::optional<ResultUncertainty> uncertainty;  ///< method given; nothing: taken as exactly known, a warning says so
    std::string traceability;                      ///< a sentence for the report; "" without
    std::vector<UncertaintySource> sources;        ///< method given: shared with participants
    bool exact_constants = false;                  ///< algorithm A with the exact factor instead of 1.134
    bool median_by_trials = false;                 ///< median: procedure B of Cox 2002
    std::size_t trials = 100000;
    std::uint64_t seed = 1;
    double alpha = 0.05;          ///< of the consistency test
    std::optional<double> power;  ///< power-moderated mean
    std::string where = {};       ///< place in the job; "" where the job has none
    bool by_default = true;       ///< the job says nothing: mandel_paule, of results that correlate weighted_mean
};

enum class SigmaPtMethod { given, percent_of_assigned, mass_fraction, precision, robust, standard_deviation };
struct SigmaPtRequest {
    SigmaPtMethod method = SigmaPtMethod::given;
    double value = 0.0;                   ///< given: σ_pt; percent_of_assigned: percent
    double mass_fraction_per_unit = 0.0;  ///< mass_fraction: the mass fraction that 1 of the item's unit stands for
    double reproducibility = 0.0, repeatability = 0.0;
    std::size_t replicates = 1;
};

struct ComparisonItem {
    std::string id;
    std::string name;
    gum::Unit unit;
    AssignedValueRequest assigned_value;
    std::optional<SigmaPtRequest> sigma_pt;
    std::optional<double> delta_E;                             ///< largest error allowed, > 0
    std::optional<Eigen::MatrixXd> homogeneity;                ///< items × replicates
    std::optional<Eigen::MatrixXd> stability;                  ///< items × replicates, measured later
    std::optional<double> kernel_bandwidth;                    ///< ask for the mode of the kernel density
    std::optional<double> reference_value, u_reference_value;  ///< independent value to hold against a consensus
};

/// Correlation of two participants' results for every item and round.
struct ParticipantCorrelation {
    std::size_t first = 0, second = 0;
    double r = 0.0;
};

/// Quantities that participants measure as one vector (x, y and z of one point): E_n of all of them together.
struct ComparisonVector {
    std::string name;
    std::vector<std::size_t> items;
    Eigen::MatrixXd correlation;            ///< of one participant's results; identity where the job states none
    Eigen::MatrixXd reference_correlation;  ///< of the assigned values
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
    std::vector<double> value;                   ///< one a point
    std::vector<ResultUncertainty> uncertainty;  ///< one a point
    Eigen::MatrixXd covariance;                  ///< of the points, u² on the diagonal
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

/// A job of kind `comparison`.
struct ComparisonJob {
    std::string title;
    double coverage_probability = 0.9545;
    // Between laboratories; empty in a comparison of methods.
    std::vector<ComparisonParticipant> participants;
    std::vector<ComparisonItem> items;
    std::vector<std::string> rounds;        ///< at least one, "" where the job has none
    std::vector<ComparisonResult> results;  ///< in the order of the files
    std::vector<MissingResult> missing = {};
    std::vector<ParticipantCorrelation> correlations;
    std::map<std::string, double> group_correlation;  ///< r inside a group; a group without is "unknown"
    /// Names of sources that look alike and are different ones, for sure.
    std::vector<std::string> different_sources = {};
    std::vector<std::string> independent_sources;  ///< named by several budgets, and yet not shared
    std::vector<ComparisonVector> vectors;
    std::vector<std::pair<std::size_t, std::size_t>> youden;  ///< pairs of items to plot

    std::optional<MethodComparisonRequest> methods;

    bool names_released = false;  ///< names of participants may stand on documents, beside their ids
    RefusedItems refused_items = {};
    std::string organiser;  ///< of the comparison, for the report; "" without
    nlohmann::json document;
    std::optional<certificate::CertificateData> certificate;
    std::vector<std::string> files;
    std::vector<gum::Diagnostic> warnings;
};

/// The keys of a job of kind `comparison`, object by object. schemas/job-1.schema.json states the same ones.
[[nodiscard]] std::span<const JobKeys> comparison_job_keys();

/// Reads a job of kind `comparison` with all its files and checks it completely.
/// \throws InputError    with every problem of every file
/// \throws StorageError  if a file cannot be read
[[nodiscard]] ComparisonJob read_comparison_job(const std::filesystem::path& job_file);
[[nodiscard]] ComparisonJob read_comparison_job(const FileSource& source, const std::string& job_file);

}  // namespace gumcert::engine
