#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gum/comparison/scores.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {

// Who compares what, and what each of them reports. Values and uncertainties stay in the unit of their item, as the
// laboratories state them: nothing is combined across units, and a conversion to SI and back could change the last
// digit of a participant's result.

/// Standard and expanded uncertainty of one result.
struct ResultUncertainty {
    double u = 0.0;
    double U = 0.0;  ///< as stated, or t_p(ν) u
    double k = 2.0;
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    bool stated_as_expanded = false;
    /// What U covers, where the distribution of the result is known, as that of a budget is. k need not be t_p(ν) then.
    std::optional<double> coverage_probability = {};
    /// U as E_n takes it, where that distribution says it; none: by k and ν.
    std::optional<EnUncertainty> of_scores = {};
};
/// U of a result as E_n takes it: that of its distribution, else as en_uncertainty() of its numbers.
[[nodiscard]] EnUncertainty en_uncertainty(const ResultUncertainty& uncertainty, double coverage_probability);
/// U as a laboratory states it, u = U/k.
/// \throws InputError  GC-GUM-0001, -0003 unless both are greater than 0
[[nodiscard]] ResultUncertainty stated_expanded(double U, double k = 2.0);

/// A part of the uncertainty of a result that comes from a named source: a standard, an instrument, a certificate.
/// Results whose parts name the same source are correlated through it.
struct UncertaintySource {
    std::string source;
    std::string input;          ///< name of the input of a budget; "" where the participant states the part itself
    double contribution = 0.0;  ///< signed, sensitivity times standard uncertainty, in the unit of the item
};

/// A correction of a stated uncertainty after an audit ("MPE taken as a standard uncertainty").
struct AuditedUncertainty {
    ResultUncertainty uncertainty;
    std::string finding;
};

/// What one participant reports for one item in one round.
struct ParticipantResult {
    std::size_t participant = 0, item = 0, round = 0;  ///< positions in the lists of the scheme
    double value = 0.0;
    std::optional<ResultUncertainty> uncertainty;
    std::optional<double> standard_deviation;  ///< of single observations, for Vangel-Rukhin and algorithm S
    std::size_t observations = 0;              ///< their number; 0: not stated
    bool contributes = true;                   ///< to the assigned value
    std::string reason;                        ///< why it does not
    std::vector<UncertaintySource> sources;
    std::optional<AuditedUncertainty> audited;
};

struct ComparisonParticipant {
    std::string id;
    std::string name;             ///< for documents; the id where there is none
    std::string group;            ///< those of one group may share effects; "" without
    std::optional<double> cmc_U;  ///< expanded uncertainty of the laboratory's capability, unit of the item
};

enum class AssignedValueMethod {
    reference,  ///< the result of one participant
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
/// Their names in jobs, messages and records, in the order of the enumeration.
inline constexpr std::array<std::string_view, 12> k_assigned_value_words{
    "reference",
    "given",
    "weighted_mean",
    "arithmetic_mean",
    "median",
    "algorithm_a",
    "q_hampel",
    "largest_consistent_subset",
    "dersimonian_laird",
    "mandel_paule",
    "vangel_rukhin",
    "power_moderated_mean",
};
[[nodiscard]] std::string word_of(AssignedValueMethod method);

struct AssignedValueRequest {
    AssignedValueMethod method = AssignedValueMethod::weighted_mean;
    std::string participant;                       ///< method reference: its id
    double value = 0.0;                            ///< method given
    std::optional<ResultUncertainty> uncertainty;  ///< method given; nothing: taken as exactly known
    std::string traceability;                      ///< a sentence for the report; "" without
    std::vector<UncertaintySource> sources;        ///< method given: shared with participants
    bool exact_constants = false;                  ///< algorithm A with the exact factor instead of 1.134
    bool median_by_trials = false;                 ///< median: procedure B of Cox 2002
    std::size_t trials = 100000;
    std::uint64_t seed = 1;
    double alpha = 0.05;          ///< of the consistency test
    std::optional<double> power;  ///< power-moderated mean
    std::string where = {};       ///< the place that states it, for messages; "" where there is none
    bool by_default = true;       ///< nobody chose the method
};

enum class SigmaPtMethod { given, percent_of_assigned, mass_fraction, precision, robust, standard_deviation };
/// Standard deviation for proficiency assessment.
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
    Unit unit;
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
    Eigen::MatrixXd correlation;            ///< of one participant's results; identity where none is stated
    Eigen::MatrixXd reference_correlation;  ///< of the assigned values
};

/// Whether the zero of a unit is a convention, as that of °C, °F and of a level in dB: a percentage of such a value
/// depends on it.
[[nodiscard]] bool has_conventional_zero(const Unit& unit);

/// A comparison between laboratories without its results.
struct ComparisonScheme {
    double coverage_probability = 0.9545;
    std::vector<ComparisonParticipant> participants;
    std::vector<ComparisonItem> items;
    std::vector<std::string> rounds = {""};  ///< at least one, "" where there are none
    std::vector<ParticipantCorrelation> correlations;
    std::map<std::string, double> group_correlation;  ///< r inside a group; a group without is "unknown"
    std::vector<std::string> independent_sources;     ///< named by several results, and yet not shared
    std::vector<ComparisonVector> vectors;
    std::vector<std::pair<std::size_t, std::size_t>> youden;  ///< pairs of items to plot
};

}  // namespace gumcert::gum
