#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gum/comparison/assigned_value.h"
#include "gum/comparison/laboratory_data.h"
#include "gum/comparison/proficiency_scheme.h"
#include "gum/comparison/reference_estimates.h"

namespace gumcert::gum {

/// The score that decides: z where the scheme has a σ_pt, z' where the assigned value is too uncertain for it; E_n of
/// stated uncertainties else; D where there is only a limit.
enum class DecidingScore { none, en, z, z_prime, difference };

/// What U(X) covers.
enum class ExpandedBy {
    nothing,        ///< there is no U, or the value is taken as exactly known
    scatter,        ///< the scatter of the results, also where they differ by more than they state
    uncertainties,  ///< only results whose stated uncertainties explain their scatter
    statement,      ///< as stated by the reference laboratory or with the given value
};

/// Independent reference value against the consensus of the laboratories.
struct ConsensusCheck {
    double reference_value = 0.0, u_reference = 0.0, consensus = 0.0, u_consensus = 0.0;
    double difference = 0.0, u_difference = 0.0, ratio = 0.0;
    bool consistent = true;  ///< |difference| ≤ 2 u
};

/// One item in one round: assigned value, its uncertainty, the spread of the results and the checks. All numbers are in
/// the unit of the item, participants are positions in the scheme.
struct ItemResult {
    std::size_t item = 0, round = 0;  ///< positions in the scheme
    AssignedValueMethod method = AssignedValueMethod::weighted_mean;
    std::optional<std::size_t> reference_participant = {};
    double value = 0.0;
    double rest = 0.0;                             ///< the value is value + rest: see SplitNumber
    std::optional<double> u = {}, U = {}, k = {};  ///< of X; no u: it cannot be stated
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  ///< of U
    ExpandedBy expanded_by = ExpandedBy::nothing;
    /// Of ExpandedBy::uncertainties: share of all y ± U that would cover the value if laboratories differed by a further
    /// standard deviation as large as the median of their u.
    std::optional<double> coverage_with_scatter = {};
    std::optional<double> U_of_scores = {};     ///< that E_n takes in place of U: another factor k; none: U itself
    std::optional<double> low = {}, high = {};  ///< coverage interval of the value by trials
    std::optional<double> u_characterisation = {}, u_homogeneity = {}, u_stability = {};

    std::size_t results = 0, contributing = 0;
    std::vector<std::size_t> not_contributing = {};  ///< as stated
    std::vector<std::size_t> not_consistent = {};    ///< outside the largest consistent subset
    std::vector<std::size_t> missing = {};           ///< without a result
    struct Weight {
        std::size_t participant = 0;
        double weight = 0.0;
    };
    std::vector<Weight> weights = {};  ///< where the assigned value is linear in the results
    std::optional<ResultConsistency> consistency = {};
    std::vector<ReferenceEstimate> estimates = {};         ///< of all methods that the data allow, side by side
    std::optional<double> s_star = {};                     ///< robust standard deviation of the results (algorithm A)
    std::optional<double> pooled_standard_deviation = {};  ///< of replicates, algorithm S

    std::optional<double> sigma_pt = {}, delta_E = {};
    std::optional<SigmaPtMethod> sigma_pt_method = {};
    std::optional<double> criterion = {};  ///< u(X) / σ_pt
    bool criterion_met = true;             ///< ≤ 0.3, or there is none: z is used, else z'
    DecidingScore score = DecidingScore::none;
    std::optional<HomogeneityCheck> homogeneity = {};
    std::optional<StabilityCheck> stability = {};
    std::optional<ConsensusCheck> consensus = {};
    std::vector<PairEquivalence> pairs = {};  ///< filled by evaluate_laboratories()

    /// Test of all contributing results where the largest consistent subset leaves some of them out.
    std::optional<ConsistencyTest> consistency_of_all = {};
    bool u_by_statements = false;     ///< see AssignedValue
    bool leaves_out_degrees = false;  ///< see MedianTrials
    bool subset_unique = true;
    std::vector<std::size_t> in_another_subset = {};  ///< of `not_consistent`, see ConsistentSubset::in_another
    bool correlation_known = true;                    ///< of the value with the results, see AssignedValue
    bool shares_sources = false;                      ///< a given value, with results
    std::set<std::string> ambiguous_sources = {};     ///< shared in more than one way, see SourceCovariance

    /// Standard uncertainty of what homogeneity and stability of the item add.
    [[nodiscard]] double u_of_item() const;
};

/// Everything that is said of one item in one round, except the scores of its results and their pairs.
///
/// u²(X) = u² of the characterisation + s_s² between items + u² of instability           (after ISO 13528:2022, clause
/// 7 and annex B). s_s is always in it: every laboratory has an item of its own, or s_s is 0. Instability is in it only
/// where the check of stability fails by its expanded criterion, for else the difference is one that the repeatability
/// of the check explains; then an uncorrected drift of up to the difference in either direction is taken, u =
/// difference/√3.
/// U(X) = k u(X), k = t_p(ν_eff); as stated where one result, or the scheme, states it and nothing is added.
/// \throws InputError  GC-COMPARE-0104 a check of items without σ_pt and δ_E, -0107 σ_pt is 0, -0108 stability without
///                     homogeneity, -0109 nothing can be scored; those of gum with the item in `where`
[[nodiscard]] ItemResult item_result(const ComparisonScheme& scheme, const LaboratoryData& data,
                                     const AssignedValue& assigned);

}  // namespace gumcert::gum
