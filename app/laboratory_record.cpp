#include "app/laboratory_record.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/comparison_print.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/make/record_parts.h"

namespace gumcert::app {

namespace {

using reports::ComparisonItemEvaluation;
using reports::ComparisonPoint;

constexpr int k_digits_of_computed_sigma = 3;
constexpr int k_digits_of_chi_square = 4;
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

std::string printed_chi_square(double chi_square) {
    return gum::round_significant(chi_square, k_digits_of_chi_square);
}

reports::ConsistencySummary consistency_record(const gum::ResultConsistency& consistency) {
    const gum::ConsistencyTest& test = consistency.test;
    reports::ConsistencySummary summary;
    summary.chi_square = test.chi_square;
    summary.critical_value = test.critical_value;
    summary.p_value = test.p_value;
    summary.alpha = consistency.alpha;
    summary.degrees_of_freedom = static_cast<std::int64_t>(test.degrees_of_freedom);
    summary.consistent = test.consistent;
    summary.birge_ratio = test.birge_ratio;
    summary.birge_limit = test.birge_limit;
    summary.pairs = count(consistency.pairs);
    summary.incompatible_pairs = count(consistency.incompatible_pairs);
    summary.printed.chi_square = printed_chi_square(test.chi_square);
    summary.printed.critical_value = printed_chi_square(test.critical_value);
    summary.printed.p_value = printed_probability(test.p_value);
    summary.printed.birge_ratio = printed_score(test.birge_ratio);
    summary.printed.birge_limit = printed_score(test.birge_limit);
    return summary;
}

reports::ReferenceEstimate estimate_record(const gum::ReferenceEstimate& from) {
    reports::ReferenceEstimate estimate;
    estimate.method = from.method;
    estimate.value = from.value;
    estimate.u = from.u;
    estimate.scale = from.scale;
    estimate.between = from.between;
    estimate.U = from.U;
    estimate.nu = reports::finite_or_none(from.degrees_of_freedom);
    estimate.u_hartung_knapp = from.u_hartung_knapp;
    estimate.results = static_cast<std::int64_t>(from.results);
    estimate.used = from.used;
    estimate.printed.value = printed_value(estimate.value, estimate.u ? estimate.u : estimate.scale);
    estimate.printed.u = printed_uncertainty(estimate.u);
    estimate.printed.U = printed_uncertainty(estimate.U);
    estimate.printed.scale = printed_uncertainty(estimate.scale);
    estimate.printed.between = printed_uncertainty(estimate.between);
    return estimate;
}

reports::HomogeneitySummary homogeneity_record(const gum::HomogeneityCheck& check) {
    reports::HomogeneitySummary summary;
    summary.items = static_cast<std::int64_t>(check.items);
    summary.replicates = static_cast<std::int64_t>(check.replicates);
    summary.mean = check.mean;
    summary.s_x = check.s_x;
    summary.s_w = check.s_w;
    summary.s_s = check.s_s;
    summary.limit = check.limit;
    summary.expanded_limit = check.expanded_limit;
    summary.sufficient = check.sufficient;
    summary.sufficient_expanded = check.sufficient_expanded;
    summary.printed.mean = printed_value(summary.mean, summary.s_x > 0.0 ? summary.s_x : summary.s_w);
    summary.printed.s_x = printed_uncertainty(summary.s_x);
    summary.printed.s_w = printed_uncertainty(summary.s_w);
    summary.printed.s_s = printed_uncertainty(summary.s_s);
    summary.printed.limit = printed_uncertainty(summary.limit);
    summary.printed.expanded_limit = printed_uncertainty(summary.expanded_limit);
    return summary;
}

reports::StabilitySummary stability_record(const gum::StabilityCheck& later, const gum::HomogeneityCheck& before) {
    reports::StabilitySummary stability;
    stability.mean = later.mean;
    stability.difference = later.difference;
    stability.u_difference = later.u_difference;
    stability.limit = later.limit;
    stability.expanded_limit = later.expanded_limit;
    stability.stable = later.stable;
    stability.stable_expanded = later.stable_expanded;
    stability.printed.mean = printed_value(later.mean, before.s_x > 0.0 ? before.s_x : before.s_w);
    stability.printed.difference = printed_uncertainty(later.difference);
    stability.printed.limit = printed_uncertainty(later.limit);
    stability.printed.expanded_limit = printed_uncertainty(later.expanded_limit);
    return stability;
}

reports::ConsensusCheck consensus_record(const gum::ConsensusCheck& from) {
    reports::ConsensusCheck check;
    check.reference_value = from.reference_value;
    check.u_reference = from.u_reference;
    check.consensus = from.consensus;
    check.u_consensus = from.u_consensus;
    check.difference = from.difference;
    check.u_difference = from.u_difference;
    check.ratio = from.ratio;
    check.consistent = from.consistent;
    check.printed.reference_value = printed_value(check.reference_value, check.u_reference);
    check.printed.consensus = printed_value(check.consensus, check.u_consensus);
    check.printed.difference = printed_value(check.difference, check.u_difference);
    check.printed.u_difference = printed_uncertainty(check.u_difference);
    check.printed.ratio = printed_score(check.ratio);
    return check;
}

reports::PairEquivalence pair_record(const gum::ComparisonScheme& scheme, const gum::PairEquivalence& from) {
    reports::PairEquivalence pair;
    pair.first = scheme.participants[from.first].id;
    pair.second = scheme.participants[from.second].id;
    pair.d = from.d;
    pair.u = from.u;
    pair.U = from.U;
    pair.En = from.en;
    pair.printed.d = printed_difference(pair.d, pair.U, std::nullopt);
    pair.printed.U = printed_uncertainty(pair.U);
    pair.printed.En = printed_score(pair.En);
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

void add_assigned_value(const gum::ItemResult& from, ComparisonItemEvaluation& item) {
    item.value = from.value;
    item.u = from.u;
    item.U = from.U;
    item.k = from.k;
    item.nu = reports::finite_or_none(from.degrees_of_freedom);
    item.U_rests_on = word_of(from.expanded_by);
    item.coverage_with_scatter = from.coverage_with_scatter;
    item.U_of_scores = from.U_of_scores;
    item.low = from.low;
    item.high = from.high;
    item.u_characterisation = from.u_characterisation;
    item.u_homogeneity = from.u_homogeneity;
    item.u_stability = from.u_stability;
    if (item.low) {
        item.printed.low = printed_value(*item.low, item.U);
        item.printed.high = printed_value(*item.high, item.U);
    }
    item.printed.value = printed_value(item.value, item.U);
    item.printed.u = printed_uncertainty(item.u);
    item.printed.U = printed_uncertainty(item.U);
    item.printed.k = printed_score(item.k);
    item.printed.nu = item.nu ? certificate::printed_degrees_of_freedom(item.nu) : "";
    item.printed.U_of_scores = printed_uncertainty(item.U_of_scores);
    item.printed.coverage_with_scatter =
        item.coverage_with_scatter ? gum::percent(*item.coverage_with_scatter) + " %" : "";
    item.printed.u_characterisation = printed_uncertainty(item.u_characterisation);
    item.printed.u_homogeneity = printed_uncertainty(item.u_homogeneity);
    item.printed.u_stability = printed_uncertainty(item.u_stability);
}

void add_limits(const gum::ItemResult& from, ComparisonItemEvaluation& item) {
    item.score = word_of(from.score);
    item.delta_E = from.delta_E;
    item.printed.delta_E = printed_as_stated(item.delta_E);
    item.sigma_pt = from.sigma_pt;
    if (item.sigma_pt) {
        item.sigma_pt_method = word_of(*from.sigma_pt_method);
        item.printed.sigma_pt = from.sigma_pt_method == gum::SigmaPtMethod::given
                                    ? printed_as_stated(item.sigma_pt)
                                    : gum::round_significant(*item.sigma_pt, k_digits_of_computed_sigma);
    }
    item.criterion = from.criterion;
    if (item.criterion) {
        item.criterion_met = from.criterion_met;
        item.printed.criterion = printed_criterion(*item.criterion, from.criterion_met);
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
    item.missing = ids(scheme, from.missing);
    for (const gum::ItemResult::Weight& weight : from.weights) {
        item.weights.push_back({scheme.participants[weight.participant].id, weight.weight,
                                gum::round_significant(weight.weight, k_digits_of_weight)});
    }
    if (from.consistency) {
        item.consistency = consistency_record(*from.consistency);
    }
    for (const gum::ReferenceEstimate& estimate : from.estimates) {
        item.estimates.push_back(estimate_record(estimate));
    }
    item.s_star = from.s_star;
    item.printed.s_star = printed_uncertainty(item.s_star);
    item.pooled_standard_deviation = from.pooled_standard_deviation;
    item.printed.pooled_standard_deviation = printed_uncertainty(item.pooled_standard_deviation);
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

void print(const ComparisonItemEvaluation& item, ComparisonPoint& point) {
    const std::optional<double> scale = item.U && *item.U > 0.0 ? item.U : item.sigma_pt;
    point.printed.value = printed_value(point.value, point.U);
    point.printed.U = printed_uncertainty(point.U);
    point.printed.k = printed_score(point.k);
    point.printed.U_of_scores = printed_uncertainty(point.U_of_scores);
    point.printed.k_of_scores = printed_score(point.k_of_scores);
    if (point.D_low) {
        point.printed.D_low = printed_difference(*point.D_low, point.U_D, scale);
        point.printed.D_high = printed_difference(*point.D_high, point.U_D, scale);
    }
    point.printed.reference_value = item.printed.value;
    point.printed.reference_U = item.printed.U;
    point.printed.D = printed_difference(point.D, point.U_D, scale);
    point.printed.U_D = printed_uncertainty(point.U_D);
    point.printed.En = printed_score(point.En);
    point.printed.zeta = printed_score(point.zeta);
    point.printed.z = printed_score(point.z);
    point.printed.z_prime = printed_score(point.z_prime);
    point.printed.P_A = printed_score(point.P_A);
    point.printed.En_audited = printed_score(point.En_audited);
    point.printed.En_worst = printed_score(point.En_worst);
    if (point.D_percent) {
        const double to_percent = 100.0 / std::abs(point.reference_value);
        const auto in_percent = [&](const std::optional<double>& number) {
            return number ? std::optional(*number * to_percent) : std::nullopt;
        };
        point.printed.D_percent = printed_difference(*point.D_percent, in_percent(point.U_D), in_percent(scale));
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
    point.value = from.value;
    if (from.uncertainty) {
        point.u = from.uncertainty->u;
        point.U = from.uncertainty->U;
        point.k = from.uncertainty->k;
        point.nu = reports::finite_or_none(from.uncertainty->degrees_of_freedom);
    }
    if (from.of_scores) {
        point.U_of_scores = from.of_scores->U;
        point.k_of_scores = from.of_scores->k;
    }
    point.reference_value = from.assigned_value;
    point.reference_u = from.u_assigned;
    point.reference_U = from.U_assigned;
    point.reference_k = from.k_assigned;
    point.D = from.difference;
    point.u_D = from.u_difference;
    point.U_D = from.U_difference;
    point.correlation = from.correlation;
    if (from.scatter) {
        point.u_others = from.scatter->others.u;
        point.nu_others = reports::finite_or_none(from.scatter->others.degrees_of_freedom);
        point.covariance_others = from.scatter->covariance;
        point.share = from.scatter->share;
        point.factor_D = from.scatter->factor;
        point.nu_D = reports::finite_or_none(from.scatter->degrees_of_freedom);
    }
    point.D_low = from.low;
    point.D_high = from.high;
    point.En = from.en;
    point.zeta = from.zeta;
    point.z = from.z;
    point.z_prime = from.z_prime;
    point.D_percent = from.percent;
    point.P_A = from.percent_of_allowed;
    point.En_worst = from.en_worst;
    point.En_audited = from.en_audited;
    point.signal = word_of(from.verdict);
    for (const gum::Score score : from.verdict_by) {
        point.signal_by.emplace_back(word_of(score));
    }
    point.realism = word_of(from.realism);
    point.U_over_CMC = from.U_over_cmc;
    point.U_over_median = from.U_over_median;
    print(item, point);
    return point;
}

// ---- summaries ------------------------------------------------------------------------------------------------------

void add_agreement(const gum::Agreement& agreement, reports::ComparisonSummary& row) {
    row.rms_En_low = agreement.rms_en_low;
    row.rms_En_high = agreement.rms_en_high;
    row.p_low = agreement.p_low;
    row.p_high = agreement.p_high;
    row.effective_points = agreement.effective_points;
    row.ratio_reference = agreement.ratio_reference;
    row.printed.rms_En_low = printed_score(row.rms_En_low);
    row.printed.rms_En_high = printed_score(row.rms_En_high);
    row.printed.p_low = printed_probability(row.p_low);
    row.printed.p_high = printed_probability(row.p_high);
    row.printed.effective_points = printed_uncertainty(row.effective_points);
    row.printed.ratio_reference = printed_uncertainty(row.ratio_reference);
}

reports::ComparisonSummary summary_record(const gum::ScoreSummary& from) {
    reports::ComparisonSummary row;
    row.direction = "all";
    row.points = static_cast<std::int64_t>(from.scores.points);
    row.count_above_1 = static_cast<std::int64_t>(from.scores.count_above_1);
    row.mean_abs_En = from.scores.mean_absolute_en;
    row.max_abs_En = from.scores.largest_absolute_en;
    row.rms_En = from.scores.rms_en;
    row.printed.mean_abs_En = printed_score(row.mean_abs_En);
    row.printed.max_abs_En = printed_score(row.max_abs_En);
    row.printed.rms_En = printed_score(row.rms_En);
    if (from.worst) {
        row.max_abs_En_worst = from.worst->largest_absolute_en;
        row.count_above_1_worst = static_cast<std::int64_t>(from.worst->count_above_1);
        row.printed.max_abs_En_worst = printed_score(row.max_abs_En_worst);
    }
    if (from.audited) {
        row.mean_abs_En_audited = from.audited->mean_absolute_en;
        row.max_abs_En_audited = from.audited->largest_absolute_en;
        row.count_above_1_audited = static_cast<std::int64_t>(from.audited->count_above_1);
        row.printed.mean_abs_En_audited = printed_score(row.mean_abs_En_audited);
        row.printed.max_abs_En_audited = printed_score(row.max_abs_En_audited);
    }
    row.D_fail = from.d_fail_smallest;
    row.D_fail_largest = from.d_fail_largest;
    row.printed.D_fail = printed_uncertainty(row.D_fail);
    row.printed.D_fail_largest = printed_uncertainty(row.D_fail_largest);
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
        summary.mean_abs_En = from.scores->mean_absolute_en;
        summary.max_abs_En = from.scores->largest_absolute_en;
        summary.rms_En = from.scores->rms_en;
        summary.printed.mean_abs_En = printed_score(summary.mean_abs_En);
        summary.printed.max_abs_En = printed_score(summary.max_abs_En);
        summary.printed.rms_En = printed_score(summary.rms_En);
    }
    return summary;
}

reports::VectorScore vector_record(const gum::ComparisonScheme& scheme, const gum::VectorScore& from) {
    reports::VectorScore score;
    score.name = scheme.vectors[from.vector].name;
    score.participant = scheme.participants[from.participant].id;
    score.round = scheme.rounds[from.round];
    score.mahalanobis_square = from.mahalanobis_square;
    score.vector_En = from.vector_en;
    score.max_abs_En = from.largest_absolute_en;
    score.quantities = static_cast<std::int64_t>(from.quantities);
    score.printed.vector_En = printed_score(score.vector_En);
    score.printed.max_abs_En = printed_score(score.max_abs_En);
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
            .correlation = from.correlation,
            .printed_correlation = printed_score(from.correlation)};
}

}  // namespace

reports::Comparison laboratory_record(const engine::ComparisonJob& job,
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

}  // namespace gumcert::app
