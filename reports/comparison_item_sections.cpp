#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/comparison_laboratory_sections.h"
#include "reports/comparison_parts.h"
#include "reports/printed_texts.h"

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
    add("u_characterisation", item.printed.u_characterisation);
    add("u_homogeneity", item.printed.u_homogeneity);
    add("u_stability", item.printed.u_stability);
    return all;
}

Text criterion_text(const Wording& words, const ComparisonItemEvaluation& item) {
    return item.printed.criterion.empty()
               ? Text()
               : sentence(words, item.criterion_met.value_or(true) ? "criterion_met" : "criterion_not_met",
                          {{"criterion", words.number(item.printed.criterion)}});
}

Text sigma_pt_text(const Wording& words, const ComparisonItemEvaluation& item) {
    const Text value = printed_quantity(words, item.printed.sigma_pt, item.difference_unit);
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
    facts.emplace_back("u(X)", printed_quantity(words, item.printed.u, item.difference_unit));
    if (!item.U_rests_on.empty()) {
        facts.emplace_back(words("comparison", "U_rests_on"), words("comparison_U_rests_on", item.U_rests_on));
    }
    if (!item.printed.low.empty()) {
        facts.emplace_back(words("comparison", "interval"), with_unit("[" + words.number(item.printed.low) + "; " +
                                                                          words.number(item.printed.high) + "]",
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
    add_fact(facts, words("comparison", "s_star"), printed_quantity(words, item.printed.s_star, item.difference_unit));
    add_fact(facts, words("comparison", "pooled_standard_deviation"),
             printed_quantity(words, item.printed.pooled_standard_deviation, item.difference_unit));
    add_fact(facts, words("comparison", "sigma_pt"), sigma_pt_text(words, item));
    add_fact(facts, words("comparison", "criterion"), criterion_text(words, item));
    add_fact(facts, words("comparison", "delta_E"),
             printed_quantity(words, item.printed.delta_E, item.difference_unit));
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
    builder.paragraph(sentence(words, s.consistent ? "consistent" : "not_consistent_sentence",
                               {{"chi_square", words.number(s.printed.chi_square)},
                                {"nu", plain(s.degrees_of_freedom)},
                                {"critical", words.number(s.printed.critical_value)},
                                {"alpha", percent_of(words, s.alpha)},
                                {"p", words.number(s.printed.p_value)}}));
    if (!s.printed.birge_ratio.empty()) {
        builder.paragraph(
            sentence(words, "birge",
                     {{"ratio", words.number(s.printed.birge_ratio)}, {"limit", words.number(s.printed.birge_limit)}}));
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
        rows.push_back({reference_value_method(words, e.method), e.printed.value, e.printed.u, e.printed.U,
                        e.printed.scale, e.printed.between, plain(e.results),
                        e.used ? words("comparison", "used") : Text("\u00A0")});
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
                                    {"s_s", quantity(h.printed.s_s)},
                                    {"s_w", quantity(h.printed.s_w)},
                                    {"limit", quantity(h.printed.limit)},
                                    {"expanded", quantity(h.printed.expanded_limit)},
                                    {"outcome", words("comparison", outcome)}}));
    }
    if (item.stability) {
        const StabilitySummary& s = *item.stability;
        const char* outcome = s.stable ? "stable" : s.stable_expanded ? "stable_expanded" : "not_stable";
        builder.paragraph(sentence(words, "stability",
                                   {{"difference", quantity(s.printed.difference)},
                                    {"limit", quantity(s.printed.limit)},
                                    {"expanded", quantity(s.printed.expanded_limit)},
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
                               {{"consensus", printed_quantity(words, c.printed.consensus, item.unit)},
                                {"reference", printed_quantity(words, c.printed.reference_value, item.unit)},
                                {"difference", printed_quantity(words, c.printed.difference, item.difference_unit)},
                                {"u", printed_quantity(words, c.printed.u_difference, item.difference_unit)}}));
}

}  // namespace

Text reference_value_method(const Wording& words, const std::string& method) {
    return words.has("comparison_method", method) ? words("comparison_method", method) : Text(method);
}

Text assigned_value_text(const Wording& words, const ComparisonItemEvaluation& item) {
    Text text = "X = " + printed_quantity(words, item.printed.value, item.unit);
    const Text separator = words("document", "separator");
    if (!item.printed.U.empty()) {
        text += separator + "U = " + printed_quantity(words, item.printed.U, item.difference_unit);
    }
    if (!item.printed.k.empty()) {
        text += separator + "k = " + words.number(item.printed.k);
    }
    if (item.U_rests_on == "scatter" && !item.printed.nu.empty()) {
        text += separator + "ν = " + words.number(item.printed.nu);
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
