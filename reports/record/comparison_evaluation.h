#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

// What a record holds of a comparison beyond its points and their summary (evaluation_record.h). All numbers are in
// the unit of the item or of the comparison; every printed text was rounded once, by gum/rounding.

/// Straight line through the differences of two methods: D = constant + slope (t − centre).
struct BiasLineSummary {
    std::string against;  ///< "reference_value" or "position"
    double centre = 0.0, constant = 0.0, u_constant = 0.0, U_constant = 0.0;
    double slope = 0.0, u_slope = 0.0, U_slope = 0.0;
    double chi_square = 0.0, p_value = 0.0;
    struct {
        std::string centre = {}, constant = {}, U_constant = {}, slope = {}, U_slope = {}, p_value = {};
    } printed = {};
};

/// One way to get a reference value from the results of an item.
struct ReferenceEstimate {
    std::string method;  ///< word of the job: "weighted_mean" …, also "niqr", "kernel_mode"
    double value = 0.0;
    std::optional<double> u = {};
    std::optional<double> scale = {};    ///< s*, s, MADe … of the results
    std::optional<double> between = {};  ///< τ
    /// Expanded uncertainty from the scatter of the results with t of `nu` degrees of freedom; none where the method
    /// has no such one.
    std::optional<double> U = {}, nu = {};
    std::optional<double> u_hartung_knapp = {};  ///< of a mean with τ
    std::int64_t results = 0;                    ///< that it rests on
    bool used = false;                           ///< it is the assigned value
    struct {
        std::string value = {}, u = {}, scale = {}, between = {}, U = {};
    } printed = {};
};

struct ConsistencySummary {
    double chi_square = 0.0, critical_value = 0.0, p_value = 0.0, alpha = 0.05;
    std::int64_t degrees_of_freedom = 0;
    bool consistent = true;
    double birge_ratio = 0.0, birge_limit = 0.0;
    std::optional<std::int64_t> pairs = {}, incompatible_pairs = {};  ///< metrological compatibility, κ = 2
    struct {
        std::string chi_square = {}, critical_value = {}, p_value = {}, birge_ratio = {}, birge_limit = {};
    } printed = {};
};

struct HomogeneitySummary {
    std::int64_t items = 0, replicates = 0;
    double mean = 0.0, s_x = 0.0, s_w = 0.0, s_s = 0.0, limit = 0.0, expanded_limit = 0.0;
    bool sufficient = false, sufficient_expanded = false;
    struct {
        std::string mean = {}, s_x = {}, s_w = {}, s_s = {}, limit = {}, expanded_limit = {};
    } printed = {};
};

struct StabilitySummary {
    double mean = 0.0, difference = 0.0, u_difference = 0.0, limit = 0.0, expanded_limit = 0.0;
    bool stable = false, stable_expanded = false;
    struct {
        std::string mean = {}, difference = {}, limit = {}, expanded_limit = {};
    } printed = {};
};

/// Independent reference value against the consensus of the laboratories.
struct ConsensusCheck {
    double reference_value = 0.0, u_reference = 0.0, consensus = 0.0, u_consensus = 0.0;
    double difference = 0.0, u_difference = 0.0, ratio = 0.0;
    bool consistent = true;  ///< |difference| ≤ 2 u
    struct {
        std::string reference_value = {}, consensus = {}, difference = {}, u_difference = {}, ratio = {};
    } printed = {};
};

/// Bilateral degree of equivalence of two laboratories for one item.
struct PairEquivalence {
    std::string first, second;  ///< ids
    double d = 0.0, u = 0.0, U = 0.0;
    std::optional<double> En = {};
    struct {
        std::string d = {}, U = {}, En = {};
    } printed = {};
};

/// Weight of a result in the assigned value.
struct ResultWeight {
    std::string participant;
    double weight = 0.0;
    std::string printed = {};
};

/// One item in one round: assigned value, its uncertainty, the spread of the results and the checks.
struct ComparisonItemEvaluation {
    std::string id, name, round;
    std::string unit;             ///< as the job writes it
    std::string difference_unit;  ///< of D, u and U
    std::string method;           ///< word of the job
    std::string reference_participant = {};
    std::string traceability = {};
    double value = 0.0;
    std::optional<double> u = {}, U = {}, k = {};
    std::optional<double> nu = {};  ///< degrees of freedom of U; none: infinite
    /// What U covers: "scatter", the scatter of the results, also where they differ by more than they state;
    /// "uncertainties", only results whose stated uncertainties explain their scatter; "statement", as stated; "" none.
    std::string U_rests_on = {};
    /// Of "uncertainties": share of all y ± U that would cover the value if laboratories differed by a further standard
    /// deviation as large as the median of their u.
    std::optional<double> coverage_with_scatter = {};
    std::optional<double> U_of_scores = {};     ///< that En takes in place of U: another factor k; none: U itself
    std::optional<double> low = {}, high = {};  ///< coverage interval of the value by trials
    struct {
        std::string value = {}, u = {}, U = {}, k = {}, u_characterisation = {}, u_homogeneity = {};
        std::string nu = {}, U_of_scores = {}, low = {}, high = {}, coverage_with_scatter = {};
        std::string u_stability = {}, sigma_pt = {}, delta_E = {}, criterion = {}, s_star = {};
        std::string pooled_standard_deviation = {};
    } printed = {};
    std::optional<double> u_characterisation = {}, u_homogeneity = {}, u_stability = {};
    std::int64_t results = 0, contributing = 0;
    std::vector<std::string> not_contributing = {};  ///< ids, stated in the job
    std::vector<std::string> not_consistent = {};    ///< ids outside the largest consistent subset
    std::vector<std::string> missing = {};           ///< ids without a result
    std::vector<ResultWeight> weights = {};          ///< where the assigned value is linear in the results
    std::optional<ConsistencySummary> consistency = {};
    std::vector<ReferenceEstimate> estimates = {};         ///< of all methods that the data allow, side by side
    std::optional<double> s_star = {};                     ///< robust standard deviation of the results (algorithm A)
    std::optional<double> pooled_standard_deviation = {};  ///< of replicates, algorithm S
    std::optional<double> sigma_pt = {}, delta_E = {};
    std::string sigma_pt_method = {};        ///< "given", "percent" …; "" where there is no sigma_pt
    std::optional<double> criterion = {};    ///< u(X) / σ_pt
    std::optional<bool> criterion_met = {};  ///< ≤ 0.3: z is used, else z'; stands together with `criterion`
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
    double mahalanobis_square = 0.0, vector_En = 0.0, max_abs_En = 0.0;
    std::int64_t quantities = 0;
    struct {
        std::string vector_En = {}, max_abs_En = {};
    } printed = {};
};

/// One laboratory over all items and rounds.
struct ParticipantSummary {
    std::string id, name, group;
    std::int64_t results = 0, scored = 0, warnings = 0, actions = 0, inconclusive = 0;
    std::optional<double> mean_abs_En = {}, max_abs_En = {}, rms_En = {}, p_low = {}, p_high = {};
    struct {
        std::string mean_abs_En = {}, max_abs_En = {}, rms_En = {}, p_low = {}, p_high = {};
    } printed = {};
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
    double correlation = 0.0;
    std::string printed_correlation = {};
};

}  // namespace gumcert::reports
