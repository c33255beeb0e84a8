#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gum/comparison/assigned_value.h"
#include "gum/comparison/item_result.h"
#include "gum/comparison/laboratory_data.h"
#include "gum/comparison/scores.h"

namespace gumcert::gum {

/// The scores of a result.
enum class Score { z, z_prime, en, zeta, en_audited, en_worst, difference };

/// What the scores of a result say together.
enum class Verdict {
    no_score,  ///< nothing decides, or it is the reference laboratory
    none,      ///< no signal
    warning,   ///< the strongest of all scores
    action,    ///< the strongest of all scores
    /// The choice between consistent subsets decides; or there is no signal, but the assigned value is too uncertain to
    /// clear anybody, or E_n is above 1 for the worst plausible correlation.
    inconclusive,
};

/// A stated u against u(X) and 1.5 s*.
enum class UncertaintyRealism { not_judged, small, plausible, large };

/// The scatter of all other results, where the assigned value is made of results that scatter.
struct ScatterOfOthers {
    SpreadUncertainty others;         ///< of the value as all other results show it
    double covariance = 0.0;          ///< of the result with the value of the others
    double share = 0.0;               ///< of the result in the value
    double factor = 1.0;              ///< of U_D of a median
    double degrees_of_freedom = 0.0;  ///< of U_D
};

/// One result against the assigned value of its item, in the unit of the item.
struct ScoredResult {
    std::size_t participant = 0, item = 0, round = 0;  ///< positions in the scheme
    std::size_t result = 0;                            ///< position in the list of results
    double value = 0.0;
    std::optional<ResultUncertainty> uncertainty = {};  ///< as stated
    /// U and k that E_n takes in place of those stated, so that both sides have about 95 %; none: as stated.
    std::optional<EnUncertainty> of_scores = {};

    double assigned_value = 0.0;
    double assigned_rest = 0.0;  ///< the assigned value is the sum of both: see SplitNumber
    std::optional<double> u_assigned = {}, U_assigned = {}, k_assigned = {};
    double difference = 0.0;                      ///< D = x − X
    std::optional<double> u_difference = {};      ///< with u on both sides
    std::optional<double> U_difference = {};      ///< also D_fail, the smallest |D| that fails
    std::optional<double> correlation = {};       ///< of x and X as used in u_D and U_D
    std::optional<ScatterOfOthers> scatter = {};  ///< U_D comes from it
    std::optional<double> low = {}, high = {};    ///< coverage interval of D by trials
    std::optional<double> en = {}, zeta = {};     ///< where u_D and U_D are greater than 0
    /// The normal quantity with the tail of ζ, which is a t where u_D has finite degrees of freedom: what its signal
    /// goes by, since the limits are those of a normal distribution. None where ζ is one itself.
    std::optional<double> zeta_as_normal = {};
    std::optional<double> z = {}, z_prime = {};     ///< where there is a σ_pt
    std::optional<double> percent = {};             ///< D%, of a quantity on a ratio scale
    std::optional<double> percent_of_allowed = {};  ///< P_A, where there is a δ_E
    bool in_unknown_group = false;                  ///< shares with others of its group what nobody knows
    /// For the worst plausible correlation in a group; infinite where no finite number bounds it.
    std::optional<double> en_worst = {};
    std::optional<double> en_audited = {};  ///< with findings on the uncertainties corrected
    Verdict verdict = Verdict::no_score;
    /// Scores that give a warning or an action; en_worst alone where it leaves a result open that no score speaks against.
    std::vector<Score> verdict_by = {};
    UncertaintyRealism realism = UncertaintyRealism::not_judged;
    std::optional<double> U_over_cmc = {};
    std::optional<double> U_over_median = {};  ///< of the U of all other laboratories

    /// U as E_n takes it. Only where an uncertainty is stated.
    [[nodiscard]] double U_of_scores() const;
};

/// ν of u(D) by Welch and Satterthwaite (JCGM 100:2008, G.4.1), 1 or more. A value that is made of results that scatter
/// has no ν here: their own uncertainties make its u, and how far they scatter is what is tested.
/// Of a result that is part of the value counts what it has in D: (1 − w)u.
/// \param position  of the result in `data`
/// \param point     with u_D > 0
[[nodiscard]] double degrees_of_freedom_of_difference(const LaboratoryData& data, std::size_t position,
                                                      const ScoredResult& point, const AssignedValue& assigned);

/// Scores of all results of one item in one round against its assigned value.
///
/// u_D and U_D take the correlation of a result with the assigned value into account where it is known (AssignedValue).
/// The reference laboratory has a difference of 0 by definition, and no score. E_n with findings corrected has U'_D² =
/// U_D² + (1 − w)² (U'² − U²), w the weight of the result: the assigned value stays as it is.
/// \param item  result of the item, complete
/// \throws InputError  GC-GUM-0031 a difference that is not 0 and has no uncertainty
/// \return one a result of `data`, in its order
[[nodiscard]] std::vector<ScoredResult> scored_results(const ComparisonScheme& scheme, const LaboratoryData& data,
                                                       const AssignedValue& assigned, const ItemResult& item);

}  // namespace gumcert::gum
