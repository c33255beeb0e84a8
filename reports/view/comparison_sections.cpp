#include "reports/view/comparison_sections.h"

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "reports/view/comparison_laboratory_sections.h"
#include "reports/view/comparison_method_sections.h"
#include "reports/view/comparison_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

Facts who_and_when(const Wording& words, const EvaluationRecord& record) {
    const ComparisonIssuer issuer = record.comparison->issuer.value_or(ComparisonIssuer{});
    Facts facts = {{words("comparison", "organiser"), record.comparison->organiser}};
    add_fact(facts, words("comparison", "artefact_stability"), record.comparison->artefact_stability);
    add_fact(facts, words("comparison", "laboratory"), words.localised(issuer.laboratory));
    add_fact(facts, words("comparison", "number"), issuer.number);
    add_fact(facts, words("comparison", "issued"), issuer.issued);
    if (issuer.amendment) {
        const certificate::Amendment& amendment = *issuer.amendment;
        add_fact(facts, words("comparison", "amendment"),
                 words.filled("comparison", amendment.kind == "replaced" ? "replaces_report" : "amends_report",
                              {{"number", amendment.number}}));
        add_fact(facts, words("comparison", "amendment_reason"), words.localised(amendment.reason));
        for (const certificate::LocalisedText& change : amendment.changes) {
            add_fact(facts, words("comparison", "amendment_change"), words.localised(change));
        }
    }
    return facts;
}

/// What D is, what its sign means, and what the expanded uncertainties stand for.
Facts conventions(const Wording& words, const EvaluationRecord& record) {
    const Comparison& c = *record.comparison;
    Facts facts = {
        {words("comparison", "sign_label"),
         words.filled("comparison", c.form == "laboratories" ? "sign_of_laboratories" : "sign_of_methods",
                      {{"method", c.method_name}, {"reference", c.reference_name}})},
        {words("comparison", "expanded_label"),
         words.filled("comparison", "expanded_text", {{"p", words.number(record.coverage_probability.text)}})}};
    // U(D) stands in a table with U(x): where they are for different probabilities, that must be said beside them.
    if (certificate::printed_coverage_probability(c.score_probability) + " %" != record.coverage_probability.text) {
        add_probability_of_differences(facts, words, c);
    }
    return facts;
}

/// Weights of all results by item, round and participant.
std::map<std::tuple<std::string, std::string, std::string>, double> weights_of(const Comparison& comparison) {
    std::map<std::tuple<std::string, std::string, std::string>, double> weights;
    for (const ComparisonItemEvaluation& item : comparison.items) {
        for (const ResultWeight& w : item.weights) {
            weights[{item.id, item.round, w.participant}] = w.weight.number;
        }
    }
    return weights;
}

/// A column of numbers with all their digits: aligned at the left, for they have no common number of decimals.
Column digits(const Text& head, const std::string& unit = "") {
    return {.head = head, .unit = gum::unit_for_people(unit)};
}

/// Unit of differences of a comparison whose items share one unit; "" where they do not.
std::string difference_unit_of(const Comparison& c) {
    return c.unit.empty() || c.items.empty() ? "" : c.items.front().difference_unit;
}

void laboratory_numbers(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    const auto weights = weights_of(c);
    const auto number = [&](const std::optional<double>& v) { return words.number(unrounded(v)); };
    const bool rounds = std::any_of(c.items.begin(), c.items.end(),
                                    [&](const auto& item) { return item.round != c.items.front().round; });
    const auto item_of = [&](const std::string& id) { return c.items.size() > 1 ? name_of_item(c, id) : ""; };
    Rows rows;
    Rows ties;  // tables of their own: so many digits do not fit side by side
    Rows others;
    for (const ComparisonPoint& p : c.points) {
        const auto weight = weights.find({p.item, p.round, p.participant});
        const Text item = item_of(p.item);
        const Text round = rounds ? p.round : "";
        rows.push_back({item, round, p.participant, number(p.value.number), number(p.u), number(p.k.number),
                        number(p.nu), number(p.U_of_scores.number)});
        if (p.u_others) {
            others.push_back({item, round, p.participant, number(p.u_others), number(p.nu_others), number(p.share),
                              number(p.covariance_others), number(p.factor_D)});
        }
        if (p.correlation || weight != weights.end()) {
            ties.push_back({item, round, p.participant, number(p.correlation),
                            weight == weights.end() ? Text() : number(weight->second)});
        }
    }
    const Column item = digits(words("comparison", "item"));
    const Column round = digits(words("comparison", "round"));
    const Column laboratory = digits(words("comparison", "participant"));
    table_of_filled_columns(
        builder, "unrounded", words("comparison", "unrounded_table"),
        {item, round, laboratory, digits("x", c.unit), digits("u(x)", difference_unit_of(c)), digits("k"), digits("ν"),
         digits(words("comparison", "U_of_scores"), difference_unit_of(c))},
        rows);
    table_of_filled_columns(builder, "unrounded-others", words("comparison", "unrounded_others_table"),
                            {item, round, laboratory, digits("u_others", difference_unit_of(c)), digits("ν_others"),
                             digits("w"), digits("c"), digits("f")},
                            others);
    table_of_filled_columns(builder, "unrounded-weights", words("comparison", "unrounded_weights_table"),
                            {item, round, laboratory, digits("r"), digits(words("comparison", "weight"))}, ties);
    Rows items;
    for (const ComparisonItemEvaluation& i : c.items) {
        items.push_back({item_of(i.id), rounds ? i.round : "", gum::unit_for_people(i.unit), number(i.value.number),
                         number(i.u.number), number(i.k.number), number(i.sigma_pt.number), number(i.delta_E.number),
                         number(i.U_of_scores.number)});
    }
    table_of_filled_columns(builder, "unrounded-items", words("comparison", "unrounded_items_table"),
                            {item, round, digits(words("label", "unit")), digits("X"), digits("u(X)"), digits("k"),
                             digits("σ_pt"), digits("δ_E"), digits(words("comparison", "U_of_scores"))},
                            items);
}

void method_numbers(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    const auto number = [&](const std::optional<double>& v) { return words.number(unrounded(v)); };
    Rows method;
    Rows reference;  // a table of its own: so many digits do not fit side by side
    for (const ComparisonPoint& p : c.points) {
        method.push_back({p.name, p.direction, number(p.position), number(p.value.number), number(p.u),
                          number(p.k.number), number(p.nu), number(p.U_of_scores.number)});
        reference.push_back({p.name, p.direction, number(p.position), number(p.reference_value.number),
                             number(p.reference_u), number(p.reference_k), number(p.correlation),
                             number(p.reference_U_of_scores)});
    }
    const std::string difference_unit = c.unit.empty() ? "" : gum::unit_of_difference(c.unit);
    const Column point = digits(words("label", "point"));
    const Column direction = digits(words("label", "direction"));
    const Column position =
        digits(c.position_name.empty() ? words("comparison", "position") : Text(c.position_name), c.position_unit);
    const auto caption = [&](const std::string& name) {
        return words.filled("comparison", "unrounded_side_table", {{"name", name}});
    };
    table_of_filled_columns(builder, "unrounded", caption(c.method_name),
                            {point, direction, position, digits("x", c.unit), digits("u(x)", difference_unit),
                             digits("k"), digits("ν"), digits(words("comparison", "U_of_scores"), difference_unit)},
                            method);
    table_of_filled_columns(builder, "unrounded-reference", caption(c.reference_name),
                            {point, direction, position, digits("X", c.unit), digits("u(X)", difference_unit),
                             digits("k"), digits("r"), digits(words("comparison", "U_of_scores"), difference_unit)},
                            reference);
}

void numbers_to_recompute(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    builder.section("recompute");
    if (c.points.size() > k_most_unrounded) {
        builder.paragraph(words.filled("comparison", "unrounded_elsewhere",
                                       {{"count", plain(static_cast<std::int64_t>(c.points.size()))}}));
        return;
    }
    builder.paragraph(words("comparison", "unrounded"));
    if (c.form == "laboratories") {
        laboratory_numbers(builder, words, c);
    } else {
        method_numbers(builder, words, c);
    }
}

}  // namespace

bool agreement_is_open(const ComparisonPoint& point) {
    // "∞" without a number: no finite number bounds it.
    const bool is_above_1 =
        point.En_worst.number ? std::abs(*point.En_worst.number) > 1.0 : point.En_worst.text.ends_with("∞");
    return point.En.number && std::abs(*point.En.number) <= 1.0 && is_above_1;
}

void comparison_report_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record) {
    const Comparison& c = *record.comparison;
    if (c.form == "laboratories") {
        laboratory_answer(builder, words, c, who_and_when(words, record), conventions(words, record));
        laboratory_sections(builder, words, c);
    } else {
        method_answer(builder, words, c, who_and_when(words, record), conventions(words, record));
        method_sections_of_comparison(builder, words, c);
    }
    numbers_to_recompute(builder, words, c);
}

}  // namespace gumcert::reports
