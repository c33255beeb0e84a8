#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/record/shown.h"

namespace gumcert::reports {

// What a record holds of a comparison beyond its points and their summary (evaluation_record.h). All numbers are in
// the unit of the item or of the comparison; every text was rounded once, by gum/rounding.

/// Straight line through the differences of two methods: D = constant + slope (t − centre).
struct BiasLineSummary {
    std::string against;  ///< "reference_value" or "position"
    Shown<double> centre = {}, constant = {}, U_constant = {};
    double u_constant = 0.0;
    Shown<double> slope = {}, U_slope = {};
    double u_slope = 0.0, chi_square = 0.0;
    Shown<double> p_value = {};
    /// P(a constant and slope as far from 0 or farther), of what of both can be evidence; where no exact distribution
    /// exists the largest of its bounds, and the smallest one. None: nothing of the line is evidence.
    Shown<std::optional<double>> p_no_bias = {};
    std::optional<double> p_no_bias_least = {};
};

/// One way to get a reference value from the results of an item.
struct ReferenceEstimate {
    std::string method;  ///< word of the job: "weighted_mean" …, also "niqr", "kernel_mode"
    Shown<double> value = {};
    Shown<std::optional<double>> u = {};
    Shown<std::optional<double>> scale = {};    ///< s*, s, MADe … of the results
    Shown<std::optional<double>> between = {};  ///< τ
    /// Expanded uncertainty from the scatter of the results with t of `nu` degrees of freedom; none where the method
    /// has no such one.
    Shown<std::optional<double>> U = {};
    std::optional<double> nu = {};
    std::optional<double> u_hartung_knapp = {};  ///< of a mean with τ
    std::int64_t results = 0;                    ///< that it rests on
    bool used = false;                           ///< it is the assigned value
};

struct ConsistencySummary {
    Shown<double> chi_square = {}, critical_value = {}, p_value = {};
    double alpha = 0.05;
    std::int64_t degrees_of_freedom = 0;
    bool consistent = true;
    bool by_chance = false;  ///< it fails, no clearer and in no more of several items than chance makes
    Shown<double> birge_ratio = {}, birge_limit = {};
    Shown<double> u_items = {};  ///< in the test beside the uncertainty of each result; 0: none
    std::optional<double> chi_square_of_statements = {};  ///< of the stated uncertainties alone, where u_items is not 0
    std::optional<std::int64_t> pairs = {}, incompatible_pairs = {};  ///< metrological compatibility, κ = 2
};

struct HomogeneitySummary {
    std::int64_t items = 0, replicates = 0;
    Shown<double> mean = {}, s_x = {}, s_w = {}, s_s = {}, limit = {}, expanded_limit = {};
    bool sufficient = false, sufficient_expanded = false;
};

struct StabilitySummary {
    Shown<double> mean = {}, difference = {};
    double u_difference = 0.0;
    Shown<double> limit = {}, expanded_limit = {};
    bool stable = false, stable_expanded = false;
};

/// Independent reference value against the consensus of the laboratories.
struct ConsensusCheck {
    Shown<double> reference_value = {}, consensus = {};
    double u_reference = 0.0, u_consensus = 0.0;
    Shown<double> difference = {}, u_difference = {}, ratio = {};
    bool consistent = true;  ///< |difference| ≤ 2 u
};

/// Bilateral degree of equivalence of two laboratories for one item.
struct PairEquivalence {
    std::string first, second;  ///< ids
    Shown<double> d = {}, U = {};
    double u = 0.0;
    Shown<std::optional<double>> En = {};
};

/// Weight of a result in the assigned value.
struct ResultWeight {
    std::string participant;
    Shown<double> weight = {};
};

/// One item in one round: assigned value, its uncertainty, the spread of the results and the checks.
struct ComparisonItemEvaluation {
    std::string id, name, round;
    std::string unit;             ///< as the job writes it
    std::string difference_unit;  ///< of D, u and U
    std::string method;           ///< word of the job
    std::string reference_participant = {};
    std::string traceability = {};
    Shown<double> value = {};
    Shown<std::optional<double>> u = {}, U = {}, k = {};
    Shown<std::optional<double>> nu = {};  ///< degrees of freedom of U; none: infinite
    /// What U covers: "scatter", the scatter of the results, also where they differ by more than they state;
    /// "uncertainties", only results whose stated uncertainties explain their scatter; "statement", as stated; "" none.
    std::string U_rests_on = {};
    /// Of "uncertainties": share of all y ± U that would cover the value if laboratories differed by a further standard
    /// deviation as large as the median of their u.
    Shown<std::optional<double>> coverage_with_scatter = {};
    Shown<std::optional<double>> U_of_scores = {};  ///< that En takes in place of U: another factor k; none: U itself
    Shown<std::optional<double>> low = {}, high = {};  ///< coverage interval of the value by trials
    Shown<std::optional<double>> u_characterisation = {}, u_homogeneity = {}, u_stability = {};
    std::int64_t results = 0, contributing = 0;
    std::vector<std::string> not_contributing = {};   ///< ids, stated in the job
    std::vector<std::string> not_consistent = {};     ///< ids outside the largest consistent subset
    std::vector<std::string> in_another_subset = {};  ///< of them, those that another consistent one of this size holds
    bool subset_is_tied = false;                      ///< another one has the same chi-square: the choice is arbitrary
    std::vector<std::string> missing = {};            ///< ids without a result
    std::vector<ResultWeight> weights = {};           ///< where the assigned value is linear in the results
    std::optional<ConsistencySummary> consistency = {};
    std::vector<ReferenceEstimate> estimates = {};  ///< of all methods that the data allow, side by side
    Shown<std::optional<double>> s_star = {};       ///< robust standard deviation of the results (algorithm A)
    Shown<std::optional<double>> pooled_standard_deviation = {};  ///< of replicates, algorithm S
    Shown<std::optional<double>> sigma_pt = {}, delta_E = {};
    std::string sigma_pt_method = {};             ///< "given", "percent" …; "" where there is no sigma_pt
    Shown<std::optional<double>> criterion = {};  ///< u(X) / σ_pt
    std::optional<bool> criterion_met = {};       ///< ≤ 0.3: z is used, else z'; stands together with `criterion`
    std::string score = {};  ///< that decides: "En", "zeta", "z", "z_prime", "D"; "" where none can be formed
    std::optional<HomogeneitySummary> homogeneity = {};
    std::optional<StabilitySummary> stability = {};
    std::optional<ConsensusCheck> consensus = {};
    std::vector<PairEquivalence> pairs = {};  ///< up to 40 laboratories with uncertainties; else empty
};

/// An item, in one round, for which nothing could be computed; the others are not lost by it.
struct ItemWithoutResult {
    std::string id, name, round;
    std::string code, what, rule, action;  ///< of the refusal
};

/// E_n of several quantities of one participant together.
struct VectorScore {
    std::string name, participant, round;
    double mahalanobis_square = 0.0;
    Shown<double> vector_En = {}, max_abs_En = {};
    std::int64_t quantities = 0;
    std::string signal =
        {};  ///< "action" where vector_En is above 1, else "none"; "" in a record of an earlier release
};

/// One laboratory over all items and rounds.
struct ParticipantSummary {
    std::string id, name, group;
    std::int64_t results = 0, scored = 0, warnings = 0, actions = 0, inconclusive = 0;
    Shown<std::optional<double>> mean_abs_En = {}, max_abs_En = {}, rms_En = {}, p_low = {}, p_high = {};
};

/// Scores of all laboratories for two items, with the ellipse that holds 95 % of them if only chance is at work.
struct YoudenPoint {
    std::string participant;
    double first = 0.0, second = 0.0;  ///< D of the two items, in their units
};
struct YoudenDiagram {
    std::string first_item, second_item, round, first_unit, second_unit;
    std::optional<double> sigma_first = {}, sigma_second = {};  ///< σ_pt, of √(σ_pt² + u²(X)) for z'; both or none
    double centre_first = 0.0, centre_second = 0.0;             ///< medians
    double scale_first = 0.0, scale_second = 0.0;               ///< robust standard deviations
    double correlation = 0.0;                                   ///< of the two, by ranks
    std::vector<std::pair<double, double>> ellipse = {};        ///< closed curve, in the units of the points
    std::vector<YoudenPoint> points = {};
};

/// A covariance that was computed from sources named by both sides.
struct SharedSource {
    std::string source, first, second;  ///< the two participants, or the two methods
    double covariance = 0.0;            ///< of one typical pair of values, in the square of the unit
    Shown<double> correlation = {};
};

}  // namespace gumcert::reports
