#include "reports/record/make/comparison/laboratory_record.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/make/comparison/comparison_print.h"
#include "reports/record/make/record_parts.h"

namespace gumcert::reports {

namespace {

using reports::ComparisonItemEvaluation;
using reports::ComparisonPoint;

constexpr int k_digits_of_computed_sigma = 3;
constexpr int k_digits_of_chi_square = 4;
constexpr int k_decimals_of_birge_ratio = 2;
constexpr int k_digits_of_weight = 3;

std::optional<std::int64_t> count(const std::optional<std::size_t>& number) {
    return number ? std::optional(static_cast<std::int64_t>(*number)) : std::nullopt;
}

// ---- words of the record --------------------------------------------------------------------------------------------

const char* word_of(gum::SigmaPtMethod method) {
    switch (method) {
        case gum::SigmaPtMethod::given:
            return "given";
        case gum::SigmaPtMethod::percent_of_assigned:
            return "percent";
        case gum::SigmaPtMethod::mass_fraction:
            return "mass_fraction";
        case gum::SigmaPtMethod::precision:
            return "precision";
        case gum::SigmaPtMethod::robust:
            return "robust";
        case gum::SigmaPtMethod::standard_deviation:
            break;
    }
    return "standard_deviation";
}

const char* word_of(gum::DecidingScore score) {
    switch (score) {
        case gum::DecidingScore::en:
            return "En";
        case gum::DecidingScore::z:
            return "z";
        case gum::DecidingScore::z_prime:
            return "z_prime";
        case gum::DecidingScore::difference:
            return "D";
        case gum::DecidingScore::none:
            break;
    }
    return "";
}

const char* word_of(gum::ExpandedBy what) {
    switch (what) {
        case gum::ExpandedBy::scatter:
            return "scatter";
        case gum::ExpandedBy::uncertainties:
            return "uncertainties";
        case gum::ExpandedBy::statement:
            return "statement";
        case gum::ExpandedBy::nothing:
            break;
    }
    return "";
}

const char* word_of(gum::Score score) {
    switch (score) {
        case gum::Score::z:
            return "z";
        case gum::Score::z_prime:
            return "z_prime";
        case gum::Score::en:
            return "En";
        case gum::Score::zeta:
            return "zeta";
        case gum::Score::en_audited:
            return "En_audited";
        case gum::Score::en_worst:
            return "En_worst";
        case gum::Score::difference:
            break;
    }
    return "D";
}

const char* word_of(gum::Verdict verdict) {
    switch (verdict) {
        case gum::Verdict::none:
            return "none";
        case gum::Verdict::warning:
            return "warning";
        case gum::Verdict::action:
            return "action";
        case gum::Verdict::inconclusive:
            return "inconclusive";
        case gum::Verdict::no_score:
            break;
    }
    return "";
}

const char* word_of(gum::UncertaintyRealism realism) {
    switch (realism) {
        case gum::UncertaintyRealism::small:
            return "small";
        case gum::UncertaintyRealism::plausible:
            return "plausible";
        case gum::UncertaintyRealism::large:
            return "large";
        case gum::UncertaintyRealism::not_judged:
            break;
    }
    return "";
}

// ---- items ----------------------------------------------------------------------------------------------------------

std::vector<std::string> ids(const gum::ComparisonScheme& scheme, const std::vector<std::size_t>& participants) {
    std::vector<std::string> found;
    for (const std::size_t participant : participants) {
        found.push_back(scheme.participants[participant].id);
    }
    return found;
}

reports::ConsistencySummary consistency_record(const gum::ResultConsistency& consistency) {
    const gum::ConsistencyTest& test = consistency.test;
    reports::ConsistencySummary summary;
    const std::vector<std::string> chi_square =
        gum::round_in_order({test.chi_square, test.critical_value}, k_digits_of_chi_square, &gum::round_significant);
    summary.chi_square = {test.chi_square, chi_square[0]};
    summary.critical_value = {test.critical_value, chi_square[1]};
    summary.p_value = {test.p_value, printed_probability_beside(test.p_value, consistency.alpha)};
    summary.alpha = consistency.alpha;
    summary.degrees_of_freedom = static_cast<std::int64_t>(test.degrees_of_freedom);
    summary.consistent = test.consistent;
    summary.by_chance = consistency.by_chance;
    const std::vector<std::string> birge =
        gum::round_in_order({test.birge_ratio, test.birge_limit}, k_decimals_of_birge_ratio, &gum::round_to_quantum);
    summary.birge_ratio = {test.birge_ratio, birge[0]};
    summary.birge_limit = {test.birge_limit, birge[1]};
    if (consistency.u_items > 0.0) {
        summary.u_items = shown(consistency.u_items, printed_uncertainty);
    }
    summary.chi_square_of_statements = consistency.chi_square_of_statements;
    summary.pairs = count(consistency.pairs);
    summary.incompatible_pairs = count(consistency.incompatible_pairs);
    return summary;
}

reports::ReferenceEstimate estimate_record(const gum::ReferenceEstimate& from) {
    reports::ReferenceEstimate estimate;
    estimate.method = from.method;
    estimate.value = {from.value, printed_value(from.value, from.rest, from.u ? from.u : from.scale)};
    estimate.u = shown(from.u, printed_uncertainty);
    estimate.scale = shown(from.scale, printed_uncertainty);
    estimate.between = shown(from.between, printed_uncertainty);
    estimate.U = shown(from.U, printed_uncertainty);
    estimate.nu = reports::finite_or_none(from.degrees_of_freedom);
    estimate.u_hartung_knapp = from.u_hartung_knapp;
    estimate.results = static_cast<std::int64_t>(from.results);
    estimate.used = from.used;
    return estimate;
}

/// A standard deviation or difference and the limits that it is held against, as uncertainties are printed, and in their order.
std::vector<std::string> printed_with_limits(double number, double limit, double expanded_limit) {
    return gum::round_in_order({number, limit, expanded_limit}, reports::k_digits_of_u, [](double of, int digits) {
        return of > 0.0 ? gum::round_to_uncertainty(0.0, of, digits).U : std::string("0");
    });
}

reports::HomogeneitySummary homogeneity_record(const gum::HomogeneityCheck& check) {
    reports::HomogeneitySummary summary;
    summary.items = static_cast<std::int64_t>(check.items);
    summary.replicates = static_cast<std::int64_t>(check.replicates);
    summary.mean = {check.mean, printed_value(check.mean, check.s_x > 0.0 ? check.s_x : check.s_w)};
    summary.s_x = shown(check.s_x, printed_uncertainty);
    summary.s_w = shown(check.s_w, printed_uncertainty);
    const std::vector<std::string> texts = printed_with_limits(check.s_s, check.limit, check.expanded_limit);
    summary.s_s = {check.s_s, texts[0]};
    summary.limit = {check.limit, texts[1]};
    summary.expanded_limit = {check.expanded_limit, texts[2]};
    summary.sufficient = check.sufficient;
    summary.sufficient_expanded = check.sufficient_expanded;
    return summary;
}

reports::StabilitySummary stability_record(const gum::StabilityCheck& later, const gum::HomogeneityCheck& before) {
    reports::StabilitySummary stability;
    stability.mean = {later.mean, printed_value(later.mean, before.s_x > 0.0 ? before.s_x : before.s_w)};
    const std::vector<std::string> texts = printed_with_limits(later.difference, later.limit, later.expanded_limit);
    stability.difference = {later.difference, texts[0]};
    stability.u_difference = later.u_difference;
    stability.limit = {later.limit, texts[1]};
    stability.expanded_limit = {later.expanded_limit, texts[2]};
    stability.stable = later.stable;
    stability.stable_expanded = later.stable_expanded;
    return stability;
}

reports::ConsensusCheck consensus_record(const gum::ConsensusCheck& from) {
    reports::ConsensusCheck check;
    check.reference_value = {from.reference_value, printed_value(from.reference_value, from.u_reference)};
    check.u_reference = from.u_reference;
    check.consensus = {from.consensus, printed_value(from.consensus, from.u_consensus)};
    check.u_consensus = from.u_consensus;
    check.difference = {from.difference, printed_value(from.difference, from.u_difference)};
    check.u_difference = shown(from.u_difference, printed_uncertainty);
    check.ratio = shown(from.ratio, printed_score);
    check.consistent = from.consistent;
    return check;
}

reports::PairEquivalence pair_record(const gum::ComparisonScheme& scheme, const gum::PairEquivalence& from) {
    reports::PairEquivalence pair;
    pair.first = scheme.participants[from.first].id;
    pair.second = scheme.participants[from.second].id;
    pair.d = {from.d, printed_difference(from.d, from.U, std::nullopt)};
    pair.u = from.u;
    pair.U = shown(from.U, printed_uncertainty);
    pair.En = shown(from.en, printed_en);
    return pair;
}

/// Three decimals, or as many more as it takes to see that the limit is exceeded.
std::string printed_criterion(double criterion, bool met) {
    constexpr int k_decimals = 3;
    constexpr int k_most_decimals = 12;
    int decimals = k_decimals;
    while (!met && decimals < k_most_decimals &&
           gum::round_to_quantum(criterion, decimals) ==
               gum::round_to_quantum(gum::k_assigned_value_criterion, decimals)) {
        ++decimals;
    }
    return gum::round_to_quantum(criterion, decimals);
}

/// Degrees of freedom; infinite ones are none, and have no text.
reports::Shown<std::optional<double>> shown_degrees_of_freedom(double degrees_of_freedom) {
    const std::optional<double> nu = reports::finite_or_none(degrees_of_freedom);
    return {nu, nu ? certificate::printed_degrees_of_freedom(nu) : ""};
}

/// One end of a coverage interval of the value.
reports::Shown<std::optional<double>> shown_end(const std::optional<double>& end, const std::optional<double>& U) {
    return {end, end ? printed_value(*end, U) : ""};
}

std::string printed_share(const std::optional<double>& share) {
    return share ? gum::percent(*share) + " %" : "";
}

void add_assigned_value(const gum::ItemResult& from, ComparisonItemEvaluation& item) {
    item.value = {from.value, printed_value(from.value, from.rest, from.U)};
    item.u = shown(from.u, printed_uncertainty);
    item.U = shown(from.U, printed_uncertainty);
    item.k = shown(from.k, printed_score);
    item.nu = shown_degrees_of_freedom(from.degrees_of_freedom);
    item.U_rests_on = word_of(from.expanded_by);
    item.coverage_with_scatter = shown(from.coverage_with_scatter, printed_share);
    item.U_of_scores = shown(from.U_of_scores, printed_uncertainty);
    item.low = shown_end(from.low, from.U);
    item.high = shown_end(from.high, from.U);
    item.u_characterisation = shown(from.u_characterisation, printed_uncertainty);
    item.u_homogeneity = shown(from.u_homogeneity, printed_uncertainty);
    item.u_stability = shown(from.u_stability, printed_uncertainty);
}

std::string printed_sigma(const std::optional<double>& sigma_pt) {
    return gum::round_significant(*sigma_pt, k_digits_of_computed_sigma);
}

void add_limits(const gum::ItemResult& from, ComparisonItemEvaluation& item) {
    item.score = word_of(from.score);
    item.delta_E = shown(from.delta_E, printed_as_stated);
    if (from.sigma_pt) {
        item.sigma_pt_method = word_of(*from.sigma_pt_method);
        item.sigma_pt =
            shown(from.sigma_pt, from.sigma_pt_method == gum::SigmaPtMethod::given ? printed_as_stated : printed_sigma);
    }
    if (from.criterion) {
        item.criterion_met = from.criterion_met;
        item.criterion = {from.criterion, printed_criterion(*from.criterion, from.criterion_met)};
    }
}

ComparisonItemEvaluation item_record(const gum::ComparisonScheme& scheme, const gum::ItemResult& from) {
    const gum::ComparisonItem& stated = scheme.items[from.item];
    ComparisonItemEvaluation item;
    item.id = stated.id;
    item.name = stated.name;
    item.round = scheme.rounds[from.round];
    item.unit = stated.unit.text();
    item.difference_unit = gum::unit_of_difference(stated.unit.text());
    item.method = gum::word_of(from.method);
    item.traceability = stated.assigned_value.traceability;
    if (from.reference_participant) {
        item.reference_participant = scheme.participants[*from.reference_participant].id;
    }
    add_assigned_value(from, item);
    add_limits(from, item);
    item.results = static_cast<std::int64_t>(from.results);
    item.contributing = static_cast<std::int64_t>(from.contributing);
    item.not_contributing = ids(scheme, from.not_contributing);
    item.not_consistent = ids(scheme, from.not_consistent);
    item.in_another_subset = ids(scheme, from.in_another_subset);
    item.subset_is_tied = !from.subset_unique;
    item.missing = ids(scheme, from.missing);
    for (const gum::ItemResult::Weight& weight : from.weights) {
        item.weights.push_back({scheme.participants[weight.participant].id,
                                {weight.weight, gum::round_significant(weight.weight, k_digits_of_weight)}});
    }
    if (from.consistency) {
        item.consistency = consistency_record(*from.consistency);
    }
    for (const gum::ReferenceEstimate& estimate : from.estimates) {
        item.estimates.push_back(estimate_record(estimate));
    }
    item.s_star = shown(from.s_star, printed_uncertainty);
    item.pooled_standard_deviation = shown(from.pooled_standard_deviation, printed_uncertainty);
    if (from.homogeneity) {
        item.homogeneity = homogeneity_record(*from.homogeneity);
    }
    if (from.stability) {
        item.stability = stability_record(*from.stability, *from.homogeneity);
    }
    if (from.consensus) {
        item.consensus = consensus_record(*from.consensus);
    }
    for (const gum::PairEquivalence& pair : from.pairs) {
        item.pairs.push_back(pair_record(scheme, pair));
    }
    return item;
}

// ---- points ---------------------------------------------------------------------------------------------------------

/// The difference from the assigned value, its uncertainty and the scores.
void add_scores(const gum::ScoredResult& from, const ComparisonItemEvaluation& item, ComparisonPoint& point) {
    const std::optional<double>& U_D = from.U_difference;
    const std::optional<double> scale = item.U.number && *item.U.number > 0.0 ? item.U.number : item.sigma_pt.number;
    const auto shown_difference = [&](const std::optional<double>& D) {
        return reports::Shown<std::optional<double>>{D, D ? printed_difference(*D, U_D, scale) : ""};
    };
    point.D = {from.difference, printed_difference(from.difference, U_D, scale)};
    point.u_D = from.u_difference;
    point.U_D = shown(U_D, printed_uncertainty);
    point.D_low = shown_difference(from.low);
    point.D_high = shown_difference(from.high);
    point.En = shown(from.en, printed_en);
    point.zeta = shown(from.zeta, printed_z);
    point.z = shown(from.z, printed_z);
    point.z_prime = shown(from.z_prime, printed_z);
    point.P_A = shown(from.percent_of_allowed, printed_share_of_allowed);
    point.En_worst = shown_worst_en(from.en_worst);
    point.En_audited = shown(from.en_audited, printed_en);
    if (from.percent) {
        const double to_percent = 100.0 / std::abs(from.assigned_value);
        const auto in_percent = [&](const std::optional<double>& number) {
            return number ? std::optional(*number * to_percent) : std::nullopt;
        };
        point.D_percent = {from.percent, printed_difference(*from.percent, in_percent(U_D), in_percent(scale))};
    }
}

ComparisonPoint point_record(const gum::ComparisonScheme& scheme, const gum::ParticipantResult& result,
                             const ComparisonItemEvaluation& item, const gum::ScoredResult& from) {
    ComparisonPoint point;
    point.participant = scheme.participants[from.participant].id;
    point.item = item.id;
    point.round = item.round;
    point.contributes = result.contributes;
    point.reason = result.reason;
    std::optional<double> U;
    if (from.uncertainty) {
        U = from.uncertainty->U;
        point.u = from.uncertainty->u;
        point.U = shown(U, printed_uncertainty);
        point.k = shown(from.uncertainty->k, printed_score);
        point.nu = reports::finite_or_none(from.uncertainty->degrees_of_freedom);
        point.coverage_probability = from.uncertainty->coverage_probability;
    }
    point.value = {from.value, printed_value(from.value, U)};
    if (from.of_scores) {
        point.U_of_scores = shown(from.of_scores->U, printed_uncertainty);
        point.k_of_scores = shown(from.of_scores->k, printed_score);
    }
    point.reference_value = {from.assigned_value, item.value.text};
    point.reference_u = from.u_assigned;
    point.reference_U = {from.U_assigned, item.U.text};
    point.reference_k = from.k_assigned;
    point.correlation = from.correlation;
    if (from.scatter) {
        point.u_others = from.scatter->others.u;
        point.nu_others = reports::finite_or_none(from.scatter->others.degrees_of_freedom);
        point.covariance_others = from.scatter->covariance;
        point.share = from.scatter->share;
        point.factor_D = from.scatter->factor;
        point.nu_D = reports::finite_or_none(from.scatter->degrees_of_freedom);
    }
    add_scores(from, item, point);
    point.signal = word_of(from.verdict);
    for (const gum::Score score : from.verdict_by) {
        point.signal_by.emplace_back(word_of(score));
    }
    point.realism = word_of(from.realism);
    point.U_over_CMC = from.U_over_cmc;
    point.U_over_median = from.U_over_median;
    return point;
}

// ---- summaries ------------------------------------------------------------------------------------------------------

void add_agreement(const gum::Agreement& agreement, reports::ComparisonSummary& row) {
    row.rms_En_low = shown(agreement.rms_en_low, printed_score);
    row.rms_En_high = shown(agreement.rms_en_high, printed_score);
    row.p_low = shown(agreement.p_low, printed_probability);
    row.p_high = shown(agreement.p_high, printed_probability);
    if (agreement.is_bounded) {
        row.p_low_least = shown(agreement.p_low_least, printed_probability);
        row.p_high_least = shown(agreement.p_high_least, printed_probability);
    }
    row.effective_points = shown(agreement.effective_points, printed_uncertainty);
    row.ratio_reference = shown(agreement.ratio_reference, printed_uncertainty);
}

reports::ComparisonSummary summary_record(const gum::ScoreSummary& from) {
    reports::ComparisonSummary row;
    row.direction = "all";
    row.points = static_cast<std::int64_t>(from.scores.points);
    row.count_above_1 = static_cast<std::int64_t>(from.scores.count_above_1);
    row.mean_abs_En = shown(from.scores.mean_absolute_en, printed_score);
    row.max_abs_En = shown(from.scores.largest_absolute_en, printed_en);
    row.rms_En = shown(from.scores.rms_en, printed_score);
    if (from.worst) {
        row.max_abs_En_worst = shown_worst_en(from.worst->largest_absolute_en);
        row.count_above_1_worst = static_cast<std::int64_t>(from.worst->count_above_1);
    }
    if (from.audited) {
        row.mean_abs_En_audited = shown(from.audited->mean_absolute_en, printed_score);
        row.max_abs_En_audited = shown(from.audited->largest_absolute_en, printed_en);
        row.count_above_1_audited = static_cast<std::int64_t>(from.audited->count_above_1);
    }
    row.D_fail = shown(from.d_fail_smallest, printed_uncertainty);
    row.D_fail_largest = shown(from.d_fail_largest, printed_uncertainty);
    if (from.agreement) {
        add_agreement(*from.agreement, row);
    }
    return row;
}

reports::ParticipantSummary participant_record(const gum::ComparisonParticipant& participant,
                                               const gum::ParticipantSummary& from) {
    reports::ParticipantSummary summary;
    summary.id = participant.id;
    summary.name = participant.name;
    summary.group = participant.group;
    summary.results = static_cast<std::int64_t>(from.results);
    summary.scored = static_cast<std::int64_t>(from.scored);
    summary.warnings = static_cast<std::int64_t>(from.warnings);
    summary.actions = static_cast<std::int64_t>(from.actions);
    summary.inconclusive = static_cast<std::int64_t>(from.inconclusive);
    if (from.scores) {
        summary.mean_abs_En = shown(from.scores->mean_absolute_en, printed_score);
        summary.max_abs_En = shown(from.scores->largest_absolute_en, printed_en);
        summary.rms_En = shown(from.scores->rms_en, printed_score);
    }
    return summary;
}

reports::VectorScore vector_record(const gum::ComparisonScheme& scheme, const gum::VectorScore& from) {
    reports::VectorScore score;
    score.name = scheme.vectors[from.vector].name;
    score.participant = scheme.participants[from.participant].id;
    score.round = scheme.rounds[from.round];
    score.mahalanobis_square = from.mahalanobis_square;
    score.vector_En = shown(from.vector_en, printed_en);
    score.max_abs_En = shown(from.largest_absolute_en, printed_en);
    score.quantities = static_cast<std::int64_t>(from.quantities);
    score.signal = gum::signal_of_en(from.vector_en) == gum::Signal::action ? "action" : "none";
    return score;
}

reports::YoudenDiagram youden_record(const gum::ComparisonScheme& scheme, const gum::YoudenDiagram& from) {
    const gum::ComparisonItem& first = scheme.items[from.first_item];
    const gum::ComparisonItem& second = scheme.items[from.second_item];
    reports::YoudenDiagram diagram;
    diagram.first_item = first.id;
    diagram.second_item = second.id;
    diagram.round = scheme.rounds[from.round];
    diagram.first_unit = gum::unit_of_difference(first.unit.text());
    diagram.second_unit = gum::unit_of_difference(second.unit.text());
    diagram.sigma_first = from.sigma_first;
    diagram.sigma_second = from.sigma_second;
    diagram.centre_first = from.centre_first;
    diagram.centre_second = from.centre_second;
    diagram.scale_first = from.scale_first;
    diagram.scale_second = from.scale_second;
    diagram.correlation = from.correlation;
    diagram.ellipse = from.ellipse;
    for (const gum::YoudenPoint& point : from.points) {
        diagram.points.push_back({scheme.participants[point.participant].id, point.first, point.second});
    }
    return diagram;
}

reports::SharedSource shared_record(const gum::ComparisonScheme& scheme, const gum::SharedSource& from) {
    return {.source = from.source,
            .first = scheme.participants[from.first].id,
            .second = scheme.participants[from.second].id,
            .covariance = from.covariance,
            .correlation = {from.correlation, printed_score(from.correlation)}};
}

}  // namespace

reports::Comparison laboratory_record(const jobs::ComparisonJob& job,
                                      const std::vector<gum::ParticipantResult>& results,
                                      const gum::LaboratoryComparison& comparison) {
    reports::Comparison record;
    record.score_probability = comparison.score_probability;
    std::size_t next = 0;
    for (const gum::ItemResult& item : comparison.items) {
        record.items.push_back(item_record(job, item));
        for (std::size_t i = 0; i < item.results; ++i, ++next) {
            const gum::ScoredResult& scored = comparison.results[next];
            record.points.push_back(point_record(job, results[scored.result], record.items.back(), scored));
        }
    }
    for (const gum::SharedSource& source : comparison.shared_sources) {
        record.shared_sources.push_back(shared_record(job, source));
    }
    if (comparison.summary) {
        record.summary.push_back(summary_record(*comparison.summary));
    }
    for (std::size_t p = 0; p < comparison.participants.size(); ++p) {
        record.participants.push_back(participant_record(job.participants[p], comparison.participants[p]));
    }
    for (const gum::VectorScore& score : comparison.vectors) {
        record.vectors.push_back(vector_record(job, score));
    }
    for (const gum::YoudenDiagram& diagram : comparison.youden) {
        record.youden.push_back(youden_record(job, diagram));
    }
    return record;
}

}  // namespace gumcert::reports
