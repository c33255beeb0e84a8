#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/printed_texts.h"
#include "reports/view/comparison_laboratory_sections.h"
#include "reports/view/comparison_parts.h"

#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

/// The value was not computed from the results of the participants.
bool is_independent(const std::string& method) {
    return method == "reference" || method == "given";
}

Text sentence(const Wording& words, const char* name, const Wording::Values& values = {}) {
    return words.filled("comparison", name, values);
}

Text percent_of(const Wording& words, double share) {
    const std::string text = gum::percent(share);
    return words.number((text.ends_with(".0") ? text.substr(0, text.size() - 2) : text) + " %");
}

/// "characterisation 0.010 µm, homogeneity 0.003 µm"
Text components_of(const Wording& words, const ComparisonItemEvaluation& item) {
    Text all;
    const auto add = [&](const char* name, const std::string& printed) {
        if (!printed.empty()) {
            all = (all.empty() ? all : all + words("document", "separator")) + words("comparison", name) + " " +
                  printed_quantity(words, printed, item.difference_unit);
        }
    };
    add("u_characterisation", item.u_characterisation.text);
    add("u_homogeneity", item.u_homogeneity.text);
    add("u_stability", item.u_stability.text);
    return all;
}

Text criterion_text(const Wording& words, const ComparisonItemEvaluation& item) {
    return item.criterion.text.empty()
               ? Text()
               : sentence(words, item.criterion_met.value_or(true) ? "criterion_met" : "criterion_not_met",
                          {{"criterion", words.number(item.criterion.text)}});
}

Text sigma_pt_text(const Wording& words, const ComparisonItemEvaluation& item) {
    const Text value = printed_quantity(words, item.sigma_pt.text, item.difference_unit);
    if (value.empty() || item.sigma_pt_method.empty()) {
        return value;
    }
    return value + " (" +
           (words.has("comparison_sigma_pt", item.sigma_pt_method) ? words("comparison_sigma_pt", item.sigma_pt_method)
                                                                   : Text(item.sigma_pt_method)) +
           ")";
}

void facts_of_value(CertificateBuilder& builder, const Wording& words, const ComparisonItemEvaluation& item) {
    Facts facts = {{words("comparison", "assigned_value"), assigned_value_text(words, item)}};
    Text method = reference_value_method(words, item.method);
    if (!item.reference_participant.empty()) {
        method += " (" + Text(item.reference_participant) + ")";
    }
    facts.emplace_back(words("comparison", "method"), method);
    facts.emplace_back("u(X)", printed_quantity(words, item.u.text, item.difference_unit));
    if (!item.U_rests_on.empty()) {
        facts.emplace_back(words("comparison", "U_rests_on"), words("comparison_U_rests_on", item.U_rests_on));
    }
    if (!item.low.text.empty()) {
        facts.emplace_back(words("comparison", "interval"),
                           with_unit("[" + words.number(item.low.text) + "; " + words.number(item.high.text) + "]",
                                     gum::unit_for_people(item.unit)));
    }
    add_fact(facts, words("comparison", "components"), components_of(words, item));
    facts.emplace_back(words("comparison", "results"),
                       is_independent(item.method)
                           ? Text(plain(item.results))
                           : sentence(words, "results_contributing",
                                      {{"results", plain(item.results)}, {"contributing", plain(item.contributing)}}));
    add_fact(facts, words("comparison", "not_contributing"), some_of(words, item.not_contributing));
    add_fact(facts, words("comparison", "not_consistent"), some_of(words, item.not_consistent));
    add_fact(facts, words("comparison", "missing"), some_of(words, item.missing));
    add_fact(facts, words("comparison", "s_star"), printed_quantity(words, item.s_star.text, item.difference_unit));
    add_fact(facts, words("comparison", "pooled_standard_deviation"),
             printed_quantity(words, item.pooled_standard_deviation.text, item.difference_unit));
    add_fact(facts, words("comparison", "sigma_pt"), sigma_pt_text(words, item));
    add_fact(facts, words("comparison", "criterion"), criterion_text(words, item));
    add_fact(facts, words("comparison", "delta_E"), printed_quantity(words, item.delta_E.text, item.difference_unit));
    builder.definitions(facts);
}

void reasons(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared) {
    Facts facts;
    for (const ComparisonPoint* p : compared.points) {
        if (!p->contributes && !p->reason.empty() && facts.size() < k_most_rows) {
            facts.emplace_back(p->participant, p->reason);
        }
    }
    if (!facts.empty()) {
        builder.paragraph(words("comparison", "reasons"));
        builder.definitions(facts);
    }
}

void traceability(CertificateBuilder& builder, const Wording& words, const ComparisonItemEvaluation& item) {
    const Text stated = item.traceability;
    const char* name = item.method == "reference" ? "traceability_reference"
                       : item.method == "given"   ? "traceability_not_stated"
                                                  : "traceability_consensus";
    builder.paragraph(
        sentence(words, "traceability",
                 {{"statement",
                   stated.empty() ? sentence(words, name, {{"participant", item.reference_participant}}) : stated}}));
}

void consistency(CertificateBuilder& builder, const Wording& words, const ComparisonItemEvaluation& item) {
    if (!item.consistency) {
        builder.paragraph(words("comparison", "no_consistency_test"));
        return;
    }
    const ConsistencySummary& s = *item.consistency;
    builder.paragraph(sentence(words,
                               s.consistent  ? "consistent"
                               : s.by_chance ? "not_consistent_by_chance"
                                             : "not_consistent_sentence",
                               {{"chi_square", words.number(s.chi_square.text)},
                                {"nu", plain(s.degrees_of_freedom)},
                                {"critical", words.number(s.critical_value.text)},
                                {"alpha", percent_of(words, s.alpha)},
                                {"p", words.number(s.p_value.text)}}));
    if (!s.u_items.text.empty()) {
        builder.paragraph(sentence(words, "consistency_of_items",
                                   {{"u", printed_quantity(words, s.u_items.text, item.difference_unit)}}));
    }
    if (!s.birge_ratio.text.empty()) {
        builder.paragraph(
            sentence(words, "birge",
                     {{"ratio", words.number(s.birge_ratio.text)}, {"limit", words.number(s.birge_limit.text)}}));
    }
    if (s.pairs && s.incompatible_pairs) {
        builder.paragraph(sentence(words, "compatibility",
                                   {{"pairs", plain(*s.pairs)}, {"incompatible", plain(*s.incompatible_pairs)}}));
    }
}

void estimates(CertificateBuilder& builder, const Wording& words, const ComparisonItemEvaluation& item,
               const std::string& id) {
    Rows rows;
    for (const ReferenceEstimate& e : item.estimates) {
        rows.push_back({reference_value_method(words, e.method), e.value.text, e.u.text, e.U.text, e.scale.text,
                        e.between.text, plain(e.results), e.used ? words("comparison", "used") : Text("\u00A0")});
    }
    const std::string unit = gum::unit_for_people(item.difference_unit);
    table_of_filled_columns(builder, "estimates-" + id, words("comparison", "estimates_table"),
                            {{words("comparison", "method"), ""},
                             {words("label", "value"), gum::unit_for_people(item.unit), true},
                             {"u", unit, true},
                             {words("comparison", "U_by_scatter"), unit, true},
                             {words("comparison", "scale"), unit, true},
                             {words("comparison", "between"), unit, true},
                             {words("comparison", "results"), "", true},
                             {words("comparison", "used_head"), ""}},
                            rows);
}

void homogeneity_and_stability(CertificateBuilder& builder, const Wording& words,
                               const ComparisonItemEvaluation& item) {
    const auto quantity = [&](const std::string& printed) {
        return printed_quantity(words, printed, item.difference_unit);
    };
    if (item.homogeneity) {
        const HomogeneitySummary& h = *item.homogeneity;
        const char* outcome = h.sufficient            ? "homogeneous"
                              : h.sufficient_expanded ? "homogeneous_expanded"
                                                      : "not_homogeneous";
        builder.paragraph(sentence(words, "homogeneity",
                                   {{"items", plain(h.items)},
                                    {"replicates", plain(h.replicates)},
                                    {"s_s", quantity(h.s_s.text)},
                                    {"s_w", quantity(h.s_w.text)},
                                    {"limit", quantity(h.limit.text)},
                                    {"expanded", quantity(h.expanded_limit.text)},
                                    {"outcome", words("comparison", outcome)}}));
    }
    if (item.stability) {
        const StabilitySummary& s = *item.stability;
        const char* outcome = s.stable ? "stable" : s.stable_expanded ? "stable_expanded" : "not_stable";
        builder.paragraph(sentence(words, "stability",
                                   {{"difference", quantity(s.difference.text)},
                                    {"limit", quantity(s.limit.text)},
                                    {"expanded", quantity(s.expanded_limit.text)},
                                    {"outcome", words("comparison", outcome)}}));
    }
    if (!item.homogeneity || !item.stability) {
        builder.paragraph(words("comparison", item.homogeneity ? "no_stability"
                                              : item.stability ? "no_homogeneity"
                                                               : "no_homogeneity_no_stability"));
    }
}

void consensus_check(CertificateBuilder& builder, const Wording& words, const ComparisonItemEvaluation& item) {
    if (!item.consensus) {
        return;
    }
    const ConsensusCheck& c = *item.consensus;
    builder.paragraph(sentence(words, c.consistent ? "consensus_agrees" : "consensus_differs",
                               {{"consensus", printed_quantity(words, c.consensus.text, item.unit)},
                                {"reference", printed_quantity(words, c.reference_value.text, item.unit)},
                                {"difference", printed_quantity(words, c.difference.text, item.difference_unit)},
                                {"u", printed_quantity(words, c.u_difference.text, item.difference_unit)}}));
}

}  // namespace

Text reference_value_method(const Wording& words, const std::string& method) {
    return words.has("comparison_method", method) ? words("comparison_method", method) : Text(method);
}

Text assigned_value_text(const Wording& words, const ComparisonItemEvaluation& item) {
    Text text = "X = " + printed_quantity(words, item.value.text, item.unit);
    const Text separator = words("document", "separator");
    if (!item.U.text.empty()) {
        text += separator + "U = " + printed_quantity(words, item.U.text, item.difference_unit);
    }
    if (!item.k.text.empty()) {
        text += separator + "k = " + words.number(item.k.text);
    }
    if (!item.k.text.empty() && !item.nu.text.empty()) {
        text += separator + "ν = " + words.number(item.nu.text);
    }
    return text;
}

void assigned_value_section(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared,
                            const std::string& id) {
    const ComparisonItemEvaluation& item = *compared.item;
    facts_of_value(builder, words, item);
    traceability(builder, words, item);
    reasons(builder, words, compared);
    consistency(builder, words, item);
    estimates(builder, words, item, id);
    consensus_check(builder, words, item);
    homogeneity_and_stability(builder, words, item);
}

}  // namespace gumcert::reports
