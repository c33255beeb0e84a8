#pragma once

#include "certificate/certificate_fields.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

// Every struct of a comparison is described once, by a function `describe(archive, value)` as in
// certificate/certificate_fields.h; reader, writer and schema of a record walk it. What an archive has in addition:
//   a.added(key, member, R)             a key that a later release added: written always, may be missing where it is read
//   a.summary(key, member)              an object keyed by direction
//   a(key, Shown member, R)             the number, and its text under the same key of the object `printed`
//   a.shown(key, text key, member, R)   the same, and the text has another key
//   a.text(key, member)                 a text of that object, or several, that has no number of its key
//   a.text_added(key, …)                the same, and a number whose text may be missing where it is read

template <class Archive, certificate::Described<BiasLineSummary> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("against", r.against, {"reference_value", "position"});
    a("centre", r.centre);
    a("constant", r.constant);
    a("u_constant", r.u_constant, Range::not_negative);
    a("U_constant", r.U_constant, Range::not_negative);
    a("slope", r.slope);
    a("u_slope", r.u_slope, Range::not_negative);
    a("U_slope", r.U_slope, Range::not_negative);
    a("chi_square", r.chi_square, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a.added("p_no_bias", r.p_no_bias, Range::probability);
    a.added("p_no_bias_least", r.p_no_bias_least, Range::probability);
}

template <class Archive, certificate::Described<ReferenceEstimate> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    // The methods of a job that rest on the results of the laboratories, and two that are computed beside them.
    a("method", r.method,
      {"weighted_mean", "arithmetic_mean", "median", "algorithm_a", "q_hampel", "largest_consistent_subset",
       "dersimonian_laird", "mandel_paule", "vangel_rukhin", "power_moderated_mean", "niqr", "kernel_mode"});
    a("value", r.value);
    a("u", r.u, Range::not_negative);
    a("scale", r.scale, Range::not_negative);
    a("between", r.between, Range::not_negative);
    a.added("U", r.U, Range::not_negative);
    a.added("nu", r.nu, Range::positive);
    a.added("u_hartung_knapp", r.u_hartung_knapp, Range::not_negative);
    a("results", r.results, Range::not_negative);
    a("used", r.used);
}

template <class Archive, certificate::Described<ConsistencySummary> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("chi_square", r.chi_square, Range::not_negative);
    a("critical_value", r.critical_value, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a("alpha", r.alpha, Range::probability);
    a("degrees_of_freedom", r.degrees_of_freedom, Range::not_negative);
    a("consistent", r.consistent);
    a.added("by_chance", r.by_chance);
    a("birge_ratio", r.birge_ratio, Range::not_negative);
    a("birge_limit", r.birge_limit, Range::not_negative);
    a.added("u_items", r.u_items, Range::not_negative);
    a.added("chi_square_of_statements", r.chi_square_of_statements, Range::not_negative);
    a("pairs", r.pairs, Range::not_negative);
    a("incompatible_pairs", r.incompatible_pairs, Range::not_negative);
}

template <class Archive, certificate::Described<HomogeneitySummary> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("items", r.items, Range::not_negative);
    a("replicates", r.replicates, Range::not_negative);
    a("mean", r.mean);
    a("s_x", r.s_x, Range::not_negative);
    a("s_w", r.s_w, Range::not_negative);
    a("s_s", r.s_s, Range::not_negative);
    a("limit", r.limit, Range::not_negative);
    a("expanded_limit", r.expanded_limit, Range::not_negative);
    a("sufficient", r.sufficient);
    a("sufficient_expanded", r.sufficient_expanded);
}

template <class Archive, certificate::Described<StabilitySummary> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("mean", r.mean);
    a("difference", r.difference);
    a("u_difference", r.u_difference, Range::not_negative);
    a("limit", r.limit, Range::not_negative);
    a("expanded_limit", r.expanded_limit, Range::not_negative);
    a("stable", r.stable);
    a("stable_expanded", r.stable_expanded);
}

template <class Archive, certificate::Described<ConsensusCheck> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("reference_value", r.reference_value);
    a("u_reference", r.u_reference, Range::not_negative);
    a("consensus", r.consensus);
    a("u_consensus", r.u_consensus, Range::not_negative);
    a("difference", r.difference);
    a("u_difference", r.u_difference, Range::not_negative);
    a("ratio", r.ratio);
    a("consistent", r.consistent);
}

template <class Archive, certificate::Described<PairEquivalence> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("first", r.first);
    a("second", r.second);
    a("d", r.d);
    a("u", r.u, Range::not_negative);
    a("U", r.U, Range::not_negative);
    a("En", r.En);
}

template <class Archive, certificate::Described<ResultWeight> Struct>
void describe(Archive& a, Struct& r) {
    a("participant", r.participant);
    a("weight", r.weight.number);
    a("printed", r.weight.text);
}

template <class Archive, certificate::Described<ComparisonItemEvaluation> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("id", r.id);
    a("name", r.name);
    a("round", r.round);
    a("unit", r.unit);
    a("difference_unit", r.difference_unit);
    a("method", r.method,
      {"reference", "given", "weighted_mean", "arithmetic_mean", "median", "algorithm_a", "q_hampel",
       "largest_consistent_subset", "dersimonian_laird", "mandel_paule", "vangel_rukhin", "power_moderated_mean"});
    a("reference_participant", r.reference_participant);
    a("traceability", r.traceability);
    a("value", r.value);
    a("u", r.u, Range::not_negative);
    a("U", r.U, Range::not_negative);
    a("k", r.k, Range::positive);
    a.added("nu", r.nu, Range::positive);
    a.added("U_rests_on", r.U_rests_on, {"", "scatter", "uncertainties", "statement"});
    a.added("coverage_with_scatter", r.coverage_with_scatter, Range::probability);
    a.added("U_of_scores", r.U_of_scores, Range::not_negative);
    a.added("low", r.low);
    a.added("high", r.high);
    a("u_characterisation", r.u_characterisation, Range::not_negative);
    a("u_homogeneity", r.u_homogeneity, Range::not_negative);
    a("u_stability", r.u_stability, Range::not_negative);
    a("results", r.results, Range::not_negative);
    a("contributing", r.contributing, Range::not_negative);
    a("not_contributing", r.not_contributing);
    a("not_consistent", r.not_consistent);
    a.added("in_another_subset", r.in_another_subset);
    a.added("subset_is_tied", r.subset_is_tied);
    a("missing", r.missing);
    a("weights", r.weights);
    a("consistency", r.consistency);
    a("estimates", r.estimates);
    a("s_star", r.s_star, Range::not_negative);
    a("pooled_standard_deviation", r.pooled_standard_deviation, Range::not_negative);
    a("sigma_pt", r.sigma_pt, Range::not_negative);
    a("delta_E", r.delta_E, Range::not_negative);
    a("sigma_pt_method", r.sigma_pt_method,
      {"", "given", "percent", "mass_fraction", "precision", "robust", "standard_deviation"});
    a("criterion", r.criterion, Range::not_negative);
    a("criterion_met", r.criterion_met);
    a("score", r.score, {"", "En", "zeta", "z", "z_prime", "D"});
    a("homogeneity", r.homogeneity);
    a("stability", r.stability);
    a("consensus", r.consensus);
    a("pairs", r.pairs);
}

template <class Archive, certificate::Described<ItemWithoutResult> Struct>
void describe(Archive& a, Struct& r) {
    a("id", r.id);
    a("name", r.name);
    a("round", r.round);
    a("code", r.code);
    a("what", r.what);
    a("rule", r.rule);
    a("action", r.action);
}

template <class Archive, certificate::Described<VectorScore> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("name", r.name);
    a("participant", r.participant);
    a("round", r.round);
    a("mahalanobis_square", r.mahalanobis_square, Range::not_negative);
    a("vector_En", r.vector_En, Range::not_negative);
    a("max_abs_En", r.max_abs_En, Range::not_negative);
    a("quantities", r.quantities, Range::not_negative);
    a.added("signal", r.signal, {"", "none", "action"});
}

template <class Archive, certificate::Described<ParticipantSummary> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("id", r.id);
    a("name", r.name);
    a("group", r.group);
    a("results", r.results, Range::not_negative);
    a("scored", r.scored, Range::not_negative);
    a("warnings", r.warnings, Range::not_negative);
    a("actions", r.actions, Range::not_negative);
    a.added("inconclusive", r.inconclusive, Range::not_negative);
    a("mean_abs_En", r.mean_abs_En, Range::not_negative);
    a("max_abs_En", r.max_abs_En, Range::not_negative);
    a("rms_En", r.rms_En, Range::not_negative);
    a("p_low", r.p_low, Range::probability);
    a("p_high", r.p_high, Range::probability);
}

template <class Archive, certificate::Described<YoudenPoint> Struct>
void describe(Archive& a, Struct& r) {
    a("participant", r.participant);
    a("first", r.first);
    a("second", r.second);
}

template <class Archive, certificate::Described<YoudenDiagram> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("first_item", r.first_item);
    a("second_item", r.second_item);
    a("round", r.round);
    a("first_unit", r.first_unit);
    a("second_unit", r.second_unit);
    a.added("sigma_first", r.sigma_first, Range::positive);
    a.added("sigma_second", r.sigma_second, Range::positive);
    a("centre_first", r.centre_first);
    a("centre_second", r.centre_second);
    a("scale_first", r.scale_first, Range::not_negative);
    a("scale_second", r.scale_second, Range::not_negative);
    a("correlation", r.correlation);
    a("ellipse", r.ellipse);
    a("points", r.points);
}

template <class Archive, certificate::Described<SharedSource> Struct>
void describe(Archive& a, Struct& r) {
    a("source", r.source);
    a("first", r.first);
    a("second", r.second);
    a("covariance", r.covariance);
    a("correlation", r.correlation.number);
    a("printed_correlation", r.correlation.text);
}

template <class Archive, certificate::Described<ComparisonPoint> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("direction", r.direction);
    a("angle_deg", r.angle_deg);
    a("value", r.value);
    a("u", r.u, Range::not_negative);
    a("U", r.U, Range::not_negative);
    a("reference_value", r.reference_value);
    a("reference_u", r.reference_u, Range::not_negative);
    a("reference_U", r.reference_U, Range::not_negative);
    a("D", r.D);
    a("u_D", r.u_D, Range::not_negative);
    a("U_D", r.U_D, Range::not_negative);
    a("En", r.En);
    a.text_added("zeta", r.zeta);
    a.added("name", r.name);
    a.added("position", r.position);
    a.added("participant", r.participant);
    a.added("item", r.item);
    a.added("round", r.round);
    a.added("contributes", r.contributes);
    a.added("reason", r.reason);
    a.added("k", r.k, Range::positive);
    a.added("nu", r.nu, Range::positive);
    a.added("reference_k", r.reference_k, Range::positive);
    a.added("correlation", r.correlation);
    a.added("z", r.z);
    a.added("z_prime", r.z_prime);
    a.added("D_percent", r.D_percent);
    a.added("P_A", r.P_A);
    a.added("En_worst", r.En_worst);
    a.added("En_audited", r.En_audited);
    a.added("signal", r.signal, {"", "none", "inconclusive", "warning", "action"});
    a.added("signal_by", r.signal_by);
    a.added("U_of_scores", r.U_of_scores, Range::not_negative);
    a.added("k_of_scores", r.k_of_scores, Range::positive);
    a.added("reference_U_of_scores", r.reference_U_of_scores, Range::not_negative);
    a.added("coverage_probability", r.coverage_probability, Range::positive);
    a.added("reference_coverage_probability", r.reference_coverage_probability, Range::positive);
    a.added("u_others", r.u_others, Range::not_negative);
    a.added("nu_others", r.nu_others, Range::positive);
    a.added("covariance_others", r.covariance_others);
    a.added("share", r.share);
    a.added("factor_D", r.factor_D, Range::positive);
    a.added("nu_D", r.nu_D, Range::positive);
    a.added("D_low", r.D_low);
    a.added("D_high", r.D_high);
    a.added("realism", r.realism, {"", "plausible", "small", "large"});
    a.added("U_over_CMC", r.U_over_CMC, Range::not_negative);
    a.added("U_over_median", r.U_over_median, Range::not_negative);
    a.text("angle", r.printed_angle);
}

template <class Archive, certificate::Described<ComparisonSummary> Struct>
void describe(Archive& a, Struct& r) {
    using Range = certificate::NumberRule;
    a("points", r.points);
    a("count_above_1", r.count_above_1);
    a("mean_abs_En", r.mean_abs_En, Range::not_negative);
    a("max_abs_En", r.max_abs_En, Range::not_negative);
    a("rms_En", r.rms_En, Range::not_negative);
    a.added("rms_En_low", r.rms_En_low, Range::not_negative);
    a.added("rms_En_high", r.rms_En_high, Range::not_negative);
    a.added("p_low", r.p_low, Range::probability);
    a.added("p_high", r.p_high, Range::probability);
    a.added("p_low_least", r.p_low_least, Range::probability);
    a.added("p_high_least", r.p_high_least, Range::probability);
    a.added("D_fail", r.D_fail, Range::not_negative);
    a.added("D_fail_largest", r.D_fail_largest, Range::not_negative);
    a.added("effective_points", r.effective_points, Range::not_negative);
    a.added("mahalanobis_square", r.mahalanobis_square, Range::not_negative);
    a.added("p_mahalanobis", r.p_mahalanobis, Range::probability);
    a.added("p_mahalanobis_least", r.p_mahalanobis_least, Range::probability);
    a.added("p_pattern", r.p_pattern, Range::probability);
    a.added("vector_En", r.vector_En, Range::not_negative);
    a.added("rank", r.rank, Range::not_negative);
    a.added("ratio_reference", r.ratio_reference, Range::not_negative);
    a.added("p_if_too_small", r.p_if_too_small, Range::probability);
    a.added("p_if_too_large", r.p_if_too_large, Range::probability);
    a.added("power_to_confirm", r.power_to_confirm, Range::probability);
    a.added("power_lacks_degrees", r.power_lacks_degrees);
    a.added("count_by_chance", r.count_by_chance, Range::not_negative);
    a.added("found_with_80_percent", r.found_with_80_percent, Range::not_negative);
    a.added("found_with_95_percent", r.found_with_95_percent, Range::not_negative);
    a.added("max_abs_En_worst", r.max_abs_En_worst, Range::not_negative);
    a.added("count_above_1_worst", r.count_above_1_worst, Range::not_negative);
    a.added("mean_abs_En_audited", r.mean_abs_En_audited, Range::not_negative);
    a.added("max_abs_En_audited", r.max_abs_En_audited, Range::not_negative);
    a.added("count_above_1_audited", r.count_above_1_audited, Range::not_negative);
    a.added("published_mean_abs_En", r.published_mean_abs_En, Range::not_negative);
    static constexpr std::initializer_list<const char*> k_words = {"",
                                                                   "validated",
                                                                   "agreement_reference_limited",
                                                                   "agreement_few_points",
                                                                   "uncertainty_not_confirmed",
                                                                   "uncertainty_too_large",
                                                                   "reference_not_better",
                                                                   "correlation_unknown",
                                                                   "joint_test_open",
                                                                   "points_above_1",
                                                                   "falls_with_finding",
                                                                   "side_refuted",
                                                                   "disagreement"};
    a.added("verdict", r.verdict, k_words);
    a.added("verdict_by", r.verdict_by, {"", "size", "pattern", "bias"});
    a.added("verdict_audited", r.verdict_audited, k_words);
    a.added("bias", r.bias);
}

template <class Archive, certificate::Described<ComparisonIssuer> Struct>
void describe(Archive& a, Struct& r) {
    a("laboratory", r.laboratory);
    a("number", r.number);
    a("issued", r.issued);
    a.stated("amendment", r.amendment);
}

template <class Archive, certificate::Described<BudgetFile> Struct>
void describe(Archive& a, Struct& r) {
    a("participant", r.participant);
    a("file", r.file);
}

template <class Archive, certificate::Described<RefutedSide> Struct>
void describe(Archive& a, Struct& r) {
    a("side", r.side);
    a("file", r.file);
    a("id", r.id);
    a("message", r.message);
    a("what", r.what);
}

template <class Archive, certificate::Described<Comparison> Struct>
void describe(Archive& a, Struct& r) {
    a("reference_name", r.reference_name);
    a("contact_point_mm", r.contact_point_mm);
    a("reference_budget", r.reference_budget);
    a("points", r.points);
    a.summary("summary", r.summary);
    a("remarks", r.remarks);
    a.added("form", r.form, {"rotary_table", "methods", "laboratories"});
    a.added("method_name", r.method_name);
    a.added("unit", r.unit);
    a.added("position_name", r.position_name);
    a.added("position_unit", r.position_unit);
    a.added("organiser", r.organiser);
    a.added("method_budget", r.method_budget);
    a.added("correlation", r.correlation, {"", "none", "given", "unknown", "shared_sources"});
    a.added("correlation_given", r.correlation_given);
    a.added("shared_sources", r.shared_sources);
    a.added("audit_finding", r.audit_finding);
    a.added("published_source", r.published_source);
    a.added("tolerance", r.tolerance.number, certificate::NumberRule::not_negative);
    a.added("printed_tolerance", r.tolerance.text);
    a.added("items", r.items);
    a.added("items_without_result", r.items_without_result);
    a.added("languages", r.languages);
    a.added("names_released", r.names_released);
    a.added("budget_files", r.budget_files);
    a.added("score_probability", r.score_probability, certificate::NumberRule::probability);
    a.added("participants", r.participants);
    a.added("vectors", r.vectors);
    a.added("youden", r.youden);
    a.added("issuer", r.issuer);
    a.added("refuted", r.refuted);
    a.added("artefact_stability", r.artefact_stability);
}

}  // namespace gumcert::reports
