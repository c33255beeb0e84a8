#include "reports/view/comparison_laboratory_sections.h"

#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/plots/comparison_plots.h"
#include "reports/printed_texts.h"
#include "reports/record/comparison_scores.h"
#include "reports/view/comparison_parts.h"
#include "reports/view/comparison_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using Points = std::vector<const ComparisonPoint*>;

constexpr std::size_t k_most_side_by_side = 4;    ///< items whose scores stand in one table of the first page
constexpr std::size_t k_most_on_first_page = 24;  ///< rows of its table
constexpr std::array<const char*, 5> k_scores = {"D", "zeta", "En", "z", "z_prime"};

std::string count(std::size_t n) {
    return plain(static_cast<std::int64_t>(n));
}

bool has_signal(const ComparisonPoint& p) {
    return p.signal == "warning" || p.signal == "action";
}

std::vector<std::string> with_signal(const Points& points, const std::string& signal) {
    std::vector<std::string> ids;
    for (const ComparisonPoint* p : points) {
        if (p->signal == signal) {
            ids.push_back(p->participant);
        }
    }
    return ids;
}

Text signal_name(const Wording& words, const std::string& signal) {
    return signal.empty() ? Text() : words("comparison_signal", signal);
}

/// A result that nothing clears and nothing accuses.
bool is_open(const ComparisonPoint& p) {
    return p.signal == "inconclusive" || agreement_is_open(p);
}

/// How much the signal of a result matters: 0 without one; an action more than any warning, a warning more than an
/// open judgement.
double weight_of(const ComparisonPoint& p, const std::string& score) {
    constexpr double k_open = 0.5;
    if (!has_signal(p)) {
        return is_open(p) ? k_open : 0.0;
    }
    const double magnitude = std::abs(score_of(p, score).number.value_or(0.0));
    return (p.signal == "action" ? 2.0 : 1.0) + magnitude / (1.0 + magnitude);
}

/// All results of an item, or of many those with a signal; says so where it is not all.
Points shown_points(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared, std::size_t most) {
    std::vector<double> weights;
    for (const ComparisonPoint* p : compared.points) {
        weights.push_back(weight_of(*p, compared.item->score));
    }
    Points shown;
    for (const std::size_t i : shown_rows(weights, most)) {
        shown.push_back(compared.points[i]);
    }
    say_what_is_shown(builder, words, weights, shown.size());
    return shown;
}

bool is_refuted(const ComparisonItemEvaluation& item) {
    return item.consistency && !item.consistency->consistent && !item.consistency->by_chance;
}

/// How much an item matters: 0 where its results agree and its scores judge all of them.
double weight_of(const ComparedItem& compared) {
    double weight = is_refuted(*compared.item) ? 1.0 : 0.0;
    for (const ComparisonPoint* p : compared.points) {
        weight += p->signal == "action" ? 2.0 : p->signal == "warning" || is_open(*p) ? 1.0 : 0.0;
    }
    return weight;
}

/// The name of a score that gives a signal.
Text name_of_signal(const Wording& words, const std::string& score) {
    return score == "En_audited" ? words("comparison", "En_audited") : score_name(words, score);
}

/// "L04 (ζ, Eₙ)": results with a signal, and the scores that give it.
Text with_scores(const Wording& words, const Points& points, const std::string& signal) {
    constexpr std::size_t k_most_names = 12;
    Text names;
    std::size_t count_of_names = 0;
    for (const ComparisonPoint* p : points) {
        if (p->signal != signal) {
            continue;
        }
        if (++count_of_names > k_most_names) {
            continue;
        }
        Text scores;
        for (const std::string& score : p->signal_by) {
            scores = (scores.empty() ? scores : scores + words("document", "separator")) + name_of_signal(words, score);
        }
        names = (names.empty() ? names : names + words("document", "separator")) + p->participant;
        names += scores.empty() ? Text() : " (" + scores + ")";
    }
    return count_of_names <= k_most_names
               ? names
               : words.fill("and_more", {{"names", names}, {"count", count(count_of_names - k_most_names)}});
}

/// A signal of a score that is not the one that decides.
bool has_signal_of_another_score(const ComparedItem& compared) {
    return std::any_of(compared.points.begin(), compared.points.end(), [&](const ComparisonPoint* p) {
        return has_signal(*p) && !p->signal_by.empty() &&
               std::find(p->signal_by.begin(), p->signal_by.end(), compared.item->score) == p->signal_by.end();
    });
}

/// What the scores of one item say, in plain words; "" where no result can be judged.
Text scores_sentence(const Wording& words, const ComparedItem& compared) {
    const std::string& score = compared.item->score;
    if (score.empty()) {
        return words.filled("comparison_scores", "none", {{"item", compared.name}});
    }
    const std::size_t inconclusive = with_signal(compared.points, "inconclusive").size();
    const std::vector<std::string> action = with_signal(compared.points, "action");
    const std::vector<std::string> warning = with_signal(compared.points, "warning");
    const auto all = static_cast<std::size_t>(std::count_if(
        compared.points.begin(), compared.points.end(), [](const ComparisonPoint* p) { return !p->signal.empty(); }));
    const bool silent = action.empty() && warning.empty();
    const std::size_t scored = silent ? all - inconclusive : all;
    if (silent && scored == 0) {
        return {};
    }
    if (silent && is_refuted(*compared.item)) {
        return words.filled("comparison_scores", "none_of_inconsistent",
                            {{"item", compared.name}, {"scored", count(scored)}});
    }
    if (!silent && has_signal_of_another_score(compared)) {
        return words.filled("comparison_scores", action.empty() ? "any_warning" : "any_action",
                            {{"item", compared.name},
                             {"scored", count(scored)},
                             {"actions", count(action.size())},
                             {"warnings", count(warning.size())},
                             {"action_names", with_scores(words, compared.points, "action")},
                             {"warning_names", with_scores(words, compared.points, "warning")}});
    }
    const std::string kind = score == "En" || score == "D" ? score : "z";
    const char* outcome = !action.empty() ? "action" : !warning.empty() && kind == "z" ? "warning" : "none";
    return words.filled("comparison_scores", kind + "_" + outcome,
                        {{"item", compared.name},
                         {"score", score_name(words, score)},
                         {"scored", count(scored)},
                         {"actions", count(action.size())},
                         {"warnings", count(warning.size())},
                         {"action_names", some_of(words, action)},
                         {"warning_names", some_of(words, warning)}});
}

/// The test of a subset says nothing of those outside it: they are named with it.
Text consistency_in_brief(const Wording& words, const ComparisonItemEvaluation& item) {
    const ConsistencySummary& s = *item.consistency;
    const char* outcome = !s.consistent                 ? "not_consistent_in_brief"
                          : item.not_consistent.empty() ? "consistent_in_brief"
                                                        : "consistent_subset_in_brief";
    return words.filled("comparison", outcome,
                        {{"excluded", some_of(words, item.not_consistent)},
                         {"chi_square", words.number(s.chi_square.text)},
                         {"critical", words.number(s.critical_value.text)},
                         {"p", words.number(s.p_value.text)}});
}

/// Results whose E_n is above 1 for the worst plausible correlation only: their agreement is open.
void open_results(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared) {
    std::vector<std::string> names;
    for (const ComparisonPoint* p : compared.points) {
        if (agreement_is_open(*p)) {
            names.push_back(p->participant);
        }
    }
    if (!names.empty()) {
        builder.paragraph(
            words.filled("comparison", "worst_in_brief", {{"item", compared.name}, {"names", some_of(words, names)}}));
    }
}

/// Whether the assigned value is too uncertain to judge a result.
bool is_not_cleared(const ComparisonPoint& p) {
    return p.signal == "inconclusive" && p.signal_by.empty();
}

/// Whether an independent value contradicts the consensus that the results are scored against.
bool differs_from_reference(const ComparedItem& compared) {
    return compared.item->consensus && !compared.item->consensus->consistent;
}

/// That the results contradict each other or an independent value, and whom the scores cannot clear.
void what_scores_cannot_say(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared) {
    const ComparisonItemEvaluation& item = *compared.item;
    if (is_refuted(item)) {
        const ConsistencySummary& s = *item.consistency;
        builder.paragraph(words.filled("comparison_scores", "inconsistent",
                                       {{"item", compared.name},
                                        {"chi_square", words.number(s.chi_square.text)},
                                        {"critical", words.number(s.critical_value.text)},
                                        {"p", words.number(s.p_value.text)}}));
        if (item.U_rests_on == "uncertainties") {
            builder.paragraph(words.filled("comparison_scores", "contradicted_U", {{"item", compared.name}}));
        }
    }
    if (differs_from_reference(compared)) {
        builder.paragraph(words.filled("comparison_scores", "consensus_differs", {{"item", compared.name}}));
    }
    if (!item.in_another_subset.empty()) {
        builder.paragraph(words.filled("comparison_scores",
                                       item.subset_is_tied ? "another_subset_tied" : "another_subset",
                                       {{"item", compared.name}, {"others", some_of(words, item.in_another_subset)}}));
        return;
    }
    // A result that only the correlation leaves open is told with those whose agreement is open.
    std::vector<std::string> names;
    for (const ComparisonPoint* p : compared.points) {
        if (is_not_cleared(*p)) {
            names.push_back(p->participant);
        }
    }
    if (!names.empty()) {
        builder.paragraph(
            words.filled("comparison_scores", item.u.number ? "cannot_clear" : "cannot_clear_unknown",
                         {{"item", compared.name}, {"count", count(names.size())}, {"names", some_of(words, names)}}));
    }
}

bool any_point(const ComparedItem& compared, bool (*holds)(const ComparisonPoint&)) {
    return std::any_of(compared.points.begin(), compared.points.end(),
                       [&](const ComparisonPoint* p) { return holds(*p); });
}

/// One sentence with the names of those of many items that something holds for; false where it holds for none.
template <typename Holds>
bool sentence_of_items(CertificateBuilder& builder, const Wording& words, const std::vector<ComparedItem>& items,
                       const char* name, const Holds& holds) {
    constexpr std::size_t k_most_names = 12;
    Text names;
    std::size_t found = 0;
    for (const ComparedItem& compared : items) {
        if (holds(compared) && ++found <= k_most_names) {
            names = names.empty() ? compared.name : names + "; " + compared.name;
        }
    }
    if (found == 0) {
        return false;
    }
    if (found > k_most_names) {
        names = words.fill("and_more", {{"names", names}, {"count", count(found - k_most_names)}});
    }
    builder.paragraph(words.filled("comparison_scores", name,
                                   {{"count", count(found)}, {"items", count(items.size())}, {"names", names}}));
    return true;
}

/// What holds of items that are too many for sentences of their own: every item that contradicts itself, or that
/// leaves a judgement open, is named or counted.
void answer_of_many_items(CertificateBuilder& builder, const Wording& words, const std::vector<ComparedItem>& items) {
    sentence_of_items(builder, words, items, "inconsistent_items",
                      [](const ComparedItem& i) { return is_refuted(*i.item); });
    sentence_of_items(builder, words, items, "contradicted_U_items", [](const ComparedItem& i) {
        return is_refuted(*i.item) && i.item->U_rests_on == "uncertainties";
    });
    sentence_of_items(builder, words, items, "consensus_differs_items", differs_from_reference);
    sentence_of_items(builder, words, items, "another_subset_items",
                      [](const ComparedItem& i) { return !i.item->in_another_subset.empty(); });
    sentence_of_items(builder, words, items, "inconclusive_items", [](const ComparedItem& i) {
        return i.item->in_another_subset.empty() && any_point(i, is_not_cleared);
    });
    sentence_of_items(builder, words, items, "open_items",
                      [](const ComparedItem& i) { return any_point(i, agreement_is_open); });
    sentence_of_items(builder, words, items, "no_score_items",
                      [](const ComparedItem& i) { return i.item->score.empty(); });
    const bool scored = std::any_of(items.begin(), items.end(), [](const ComparedItem& i) {
        return any_point(i, [](const ComparisonPoint& p) { return p.signal == "none"; });
    });
    if (!sentence_of_items(builder, words, items, "signal_items",
                           [](const ComparedItem& i) { return any_point(i, has_signal); }) &&
        scored) {
        builder.paragraph(words.filled("comparison_scores", "no_signal_items", {{"items", count(items.size())}}));
    }
}

/// What the scores say, item by item where there are few.
void answer_of_items(CertificateBuilder& builder, const Wording& words, const std::vector<ComparedItem>& items) {
    sentence_of_items(builder, words, items, "by_chance_items",
                      [](const ComparedItem& i) { return i.item->consistency && i.item->consistency->by_chance; });
    if (items.size() > k_most_side_by_side) {
        answer_of_many_items(builder, words, items);
        return;
    }
    for (const ComparedItem& compared : items) {
        what_scores_cannot_say(builder, words, compared);
        if (const Text sentence = scores_sentence(words, compared); !sentence.empty()) {
            builder.paragraph(sentence);
        }
        open_results(builder, words, compared);
    }
}

/// Quantities that are judged together and lie outside their joint region, whatever the scores apart say.
void vectors_in_brief(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    std::vector<std::string> names;
    for (const VectorScore& vector : c.vectors) {
        if (vector.signal == "action" || (vector.signal.empty() && vector.vector_En.number > 1.0)) {
            names.push_back(vector.participant + " (" + vector.name +
                            (vector.round.empty() ? "" : ", " + vector.round) + ")");
        }
    }
    if (!names.empty()) {
        builder.paragraph(words.filled(
            "comparison", "vectors_in_brief",
            {{"count", count(names.size())}, {"all", count(c.vectors.size())}, {"names", some_of(words, names)}}));
    }
}

/// Whose stated factor E_n does not take.
void factors_in_brief(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    const Text probability = words.number(certificate::printed_coverage_probability(c.score_probability) + " %");
    std::vector<std::string> items;
    for (const ComparisonItemEvaluation& item : c.items) {
        // Of a reference laboratory the result is named; the factor of a scatter is that of no probability.
        if (item.U_of_scores.number && item.U_rests_on != "scatter" && item.method != "reference") {
            const std::string name = name_of_item(c, item.id);
            items.push_back(item.round.empty() ? name : name.empty() ? item.round : name + ", " + item.round);
        }
    }
    if (!items.empty()) {
        const bool only_one = c.items.size() == 1;
        builder.paragraph(words.filled("comparison",
                                       only_one ? "factor_of_value_in_brief" : "factors_of_values_in_brief",
                                       {{"names", some_of(words, items)}, {"p", probability}}));
    }
    std::vector<std::string> names;
    for (const ComparisonPoint& p : c.points) {
        if (p.U_of_scores.number && std::find(names.begin(), names.end(), p.participant) == names.end()) {
            names.push_back(p.participant);
        }
    }
    if (!names.empty()) {
        builder.paragraph(
            words.filled("comparison", "factors_in_brief", {{"names", some_of(words, names)}, {"p", probability}}));
    }
}

/// Items for which nothing could be computed, each in its place.
void items_without_result(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    constexpr std::size_t k_most_items = 10;
    for (std::size_t i = 0; i < std::min(c.items_without_result.size(), k_most_items); ++i) {
        const ItemWithoutResult& item = c.items_without_result[i];
        Text name = item.name.empty() ? item.id : item.name;
        name = name.empty() ? words("comparison", "the_item") : name;
        builder.paragraph(words.filled(
            "comparison_scores", "without_result",
            {{"item", item.round.empty()
                          ? name
                          : words.filled("comparison", "item_in_round", {{"item", name}, {"round", item.round}})},
             {"what", words.sentence(item.what, words.filled("comparison_scores", "told_in_the_record",
                                                             {{"code", item.code}}))}}));
    }
    if (c.items_without_result.size() > k_most_items) {
        builder.paragraph(words.filled("comparison_scores", "more_without_result",
                                       {{"count", count(c.items_without_result.size() - k_most_items)}}));
    }
}

/// Assigned values of a few items, one row an item.
void assigned_values_table(CertificateBuilder& builder, const Wording& words, const std::vector<ComparedItem>& items) {
    Rows rows;
    for (const ComparedItem& compared : items) {
        const ComparisonItemEvaluation& item = *compared.item;
        rows.push_back({compared.name, reference_value_method(words, item.method),
                        printed_quantity(words, item.value.text, item.unit),
                        printed_quantity(words, item.U.text, item.difference_unit), item.k.text,
                        item.k.text.empty() ? std::string() : item.nu.text,
                        printed_quantity(words, item.sigma_pt.text, item.difference_unit),
                        printed_quantity(words, item.delta_E.text, item.difference_unit),
                        some_of(words, item.missing)});
    }
    table_of_filled_columns(builder, "assigned-values", words("comparison", "assigned_values_table"),
                            {{words("comparison", "item"), ""},
                             {words("comparison", "method"), ""},
                             {"X", "", true},
                             {"U(X)", "", true},
                             {"k", "", true},
                             {"ν", "", true},
                             {words("comparison", "sigma_pt"), "", true},
                             {"δ_E", "", true},
                             {words("comparison", "missing"), ""}},
                            rows);
}

/// Assigned value, its method and what else the scores of the only item rest on.
void facts_of_only_item(Facts& facts, const Wording& words, const ComparisonItemEvaluation& item) {
    facts.emplace_back(words("comparison", "assigned_value"),
                       assigned_value_text(words, item) + " (" + reference_value_method(words, item.method) +
                           (item.reference_participant.empty() ? Text() : " " + Text(item.reference_participant)) +
                           ")");
    add_fact(facts, words("comparison", "sigma_pt"), printed_quantity(words, item.sigma_pt.text, item.difference_unit));
    add_fact(facts, words("comparison", "delta_E"), printed_quantity(words, item.delta_E.text, item.difference_unit));
    if (item.consistency) {
        facts.emplace_back(words("comparison", "consistency"), consistency_in_brief(words, item));
    }
    add_fact(facts, words("comparison", "missing"), some_of(words, item.missing));
}

void one_item_of_answer(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared) {
    const ComparisonItemEvaluation& item = *compared.item;
    const std::string unit = gum::unit_for_people(item.unit);
    const std::string difference_unit = gum::unit_for_people(item.difference_unit);
    Rows rows;
    for (const ComparisonPoint* p : shown_points(builder, words, compared, k_most_on_first_page)) {
        const bool both = item.score != "D";
        rows.push_back({p->participant, p->value.text, p->U.text, p->D.text, p->U_D.text,
                        both ? score_of(*p, item.score).text : "", signal_name(words, p->signal)});
    }
    table_of_filled_columns(builder, "scores", words("comparison", "scores_table"),
                            {{words("comparison", "participant"), ""},
                             {words("label", "value") + " x", unit, true},
                             {"U(x)", difference_unit, true},
                             {words("label", "difference"), difference_unit, true},
                             {"U(D)", difference_unit, true},
                             {score_name(words, item.score), "", true},
                             {words("comparison", "signal"), ""}},
                            rows);
}

/// Scores of a few items side by side, one row a laboratory.
void scores_side_by_side(CertificateBuilder& builder, const Wording& words, const Comparison& c,
                         const std::vector<ComparedItem>& items) {
    std::map<std::string, std::vector<const ComparisonPoint*>> by_participant;
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (const ComparisonPoint* p : items[i].points) {
            auto& row = by_participant[p->participant];
            row.resize(items.size(), nullptr);
            row[i] = p;
        }
    }
    std::vector<Column> columns = {{words("comparison", "participant"), ""}};
    std::vector<std::pair<Text, std::size_t>> groups = {{"", 1}};
    for (const ComparedItem& compared : items) {
        const ComparisonItemEvaluation& item = *compared.item;
        columns.push_back(
            {score_name(words, item.score), item.score == "D" ? gum::unit_for_people(item.difference_unit) : "", true});
        columns.push_back({words("comparison", "signal"), ""});
        groups.emplace_back(compared.name, 2);
    }
    std::vector<double> weights;
    for (const ParticipantSummary& participant : c.participants) {
        double weight = 0.0;
        auto& points = by_participant[participant.id];
        points.resize(items.size(), nullptr);
        for (std::size_t i = 0; i < items.size(); ++i) {
            weight += points[i] == nullptr ? 0.0 : weight_of(*points[i], items[i].item->score);
        }
        weights.push_back(weight);
    }
    Rows rows;
    for (const std::size_t position : shown_rows(weights, k_most_on_first_page)) {
        const std::string& id = c.participants[position].id;
        std::vector<Text> row = {id};
        for (std::size_t i = 0; i < items.size(); ++i) {
            const ComparisonPoint* p = by_participant[id][i];
            row.push_back(p == nullptr ? "" : score_of(*p, items[i].item->score).text);
            row.push_back(p == nullptr ? Text() : signal_name(words, p->signal));
        }
        rows.push_back(std::move(row));
    }
    say_what_is_shown(builder, words, weights, rows.size());
    if (!rows.empty()) {
        builder.table("scores", words("comparison", "scores_table"), columns, rows, groups);
    }
}

std::vector<double> weights_of(const std::vector<ComparedItem>& items) {
    std::vector<double> weights;
    for (const ComparedItem& compared : items) {
        weights.push_back(weight_of(compared));
    }
    return weights;
}

/// Items with the numbers of signals, where there are too many for one column each; those that matter first.
void items_table(CertificateBuilder& builder, const Wording& words, const std::vector<ComparedItem>& items) {
    const std::vector<double> weights = weights_of(items);
    std::vector<std::size_t> shown = shown_rows(weights, k_most_rows);
    std::stable_sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
    const auto open = [](const ComparedItem& compared) {
        return std::count_if(compared.points.begin(), compared.points.end(),
                             [](const ComparisonPoint* p) { return is_open(*p); });
    };
    const bool any_open = std::any_of(items.begin(), items.end(), [&](const auto& item) { return open(item) > 0; });
    Rows rows;
    for (const std::size_t i : shown) {
        const ComparisonItemEvaluation& item = *items[i].item;
        const std::vector<std::string> action = with_signal(items[i].points, "action");
        rows.push_back({items[i].name, printed_quantity(words, item.value.text, item.unit),
                        printed_quantity(words, item.U.text, item.difference_unit), score_name(words, item.score),
                        count(items[i].points.size()), count(with_signal(items[i].points, "warning").size()),
                        count(action.size()), some_of(words, action),
                        any_open ? count(static_cast<std::size_t>(open(items[i]))) : Text(),
                        is_refuted(item) ? "p = " + words.number(item.consistency->p_value.text) : Text()});
    }
    say_what_is_shown(builder, words, weights, rows.size());
    table_of_filled_columns(builder, "items", words("comparison", "items_table"),
                            {{words("comparison", "item"), ""},
                             {"X", "", true},
                             {"U(X)", "", true},
                             {words("comparison", "score"), ""},
                             {words("comparison", "results"), "", true},
                             {words("comparison", "warnings"), "", true},
                             {words("comparison", "actions"), "", true},
                             {words("comparison", "laboratories_with_action"), ""},
                             {words("comparison", "inconclusive"), "", true},
                             {words("comparison", "contradiction"), ""}},
                            rows);
}

void values_figure(CertificateBuilder& builder, const Wording& words, const Comparison& c, const ComparedItem& compared,
                   const std::string& id) {
    figure_if_any(builder, id, words.filled("comparison", "figure_values", {{"item", compared.name}}),
                  words("plot", "laboratory_values_description"), laboratory_values_plot(c, *compared.item, id, words));
}

/// Numbers of the laboratories in the figures: in ascending order of their values.
std::map<std::string, std::size_t> numbers_in_figures(const ComparedItem& compared) {
    Points ascending = compared.points;
    std::sort(ascending.begin(), ascending.end(), [](const ComparisonPoint* a, const ComparisonPoint* b) {
        return a->value.number != b->value.number ? a->value.number < b->value.number : a->participant < b->participant;
    });
    std::map<std::string, std::size_t> numbers;
    for (std::size_t i = 0; i < ascending.size(); ++i) {
        numbers[ascending[i]->participant] = i + 1;
    }
    return numbers;
}

/// Results of one item with every score that was asked for.
void results_table(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared,
                   const std::string& id) {
    const ComparisonItemEvaluation& item = *compared.item;
    const std::string unit = gum::unit_for_people(item.unit);
    const std::string difference_unit = gum::unit_for_people(item.difference_unit);
    Rows rows;
    const bool numbered = compared.points.size() > k_most_named_columns;
    const std::map<std::string, std::size_t> numbers = numbers_in_figures(compared);
    for (const ComparisonPoint* p : shown_points(builder, words, compared, k_most_rows)) {
        rows.push_back({p->participant, p->value.text, p->U.text, p->k.text, p->D.text, p->U_D.text, p->D_percent.text,
                        p->P_A.text, p->zeta.text, p->En.text, p->z.text, p->z_prime.text,
                        signal_name(words, p->signal), p->U_of_scores.text,
                        p->D_low.text.empty()
                            ? Text()
                            : "[" + words.number(p->D_low.text) + "; " + words.number(p->D_high.text) + "]",
                        numbered ? Text(plain(static_cast<std::int64_t>(numbers.at(p->participant)))) : Text()});
    }
    table_of_filled_columns(builder, "results-" + id,
                            words.filled("comparison", "results_table", {{"item", compared.name}}),
                            {{words("comparison", "participant"), ""},
                             {"x", unit, true},
                             {"U(x)", difference_unit, true},
                             {"k", "", true},
                             {"D", difference_unit, true},
                             {"U(D)", difference_unit, true},
                             {"D", "%", true},
                             {"P_A", "%", true},
                             {words("label", "zeta"), "", true},
                             {words("label", "En"), "", true},
                             {words("label", "z"), "", true},
                             {words("label", "z_prime"), "", true},
                             {words("comparison", "signal"), ""},
                             {words("comparison", "U_of_scores"), difference_unit, true},
                             {words("comparison", "interval_of_D"), difference_unit},
                             {words("comparison", "number_in_figures"), "", true}},
                            rows);
}

void realism_table(CertificateBuilder& builder, const Wording& words, const ComparedItem& compared,
                   const std::string& id) {
    const auto ratio = [](const std::optional<double>& v) { return v ? gum::round_significant(*v, 2) : ""; };
    const auto judged = [](const ComparisonPoint* p) {
        return !p->realism.empty() || p->U_over_CMC || !p->En_audited.text.empty() || !p->En_worst.text.empty();
    };
    if (std::none_of(compared.points.begin(), compared.points.end(), judged)) {
        return;
    }
    builder.paragraph(words("comparison", "realism"));
    Rows rows;
    for (const ComparisonPoint* p : shown_points(builder, words, compared, k_most_rows)) {
        rows.push_back({p->participant, p->U.text,
                        p->realism.empty() ? Text() : words("comparison_realism", p->realism), ratio(p->U_over_CMC),
                        ratio(p->U_over_median), p->En.text, p->En_worst.text, p->En_audited.text});
    }
    table_of_filled_columns(builder, "realism-" + id,
                            words.filled("comparison", "realism_table", {{"item", compared.name}}),
                            {{words("comparison", "participant"), ""},
                             {"U(x)", gum::unit_for_people(compared.item->difference_unit), true},
                             {words("comparison", "judgement"), ""},
                             {"U / CMC", "", true},
                             {words("comparison", "U_over_median"), "", true},
                             {words("label", "En"), "", true},
                             {words("comparison", "En_worst"), "", true},
                             {words("comparison", "En_audited"), "", true}},
                            rows);
}

void item_sections(CertificateBuilder& builder, const Wording& words, const Comparison& c,
                   const std::vector<ComparedItem>& items) {
    const std::vector<std::size_t> shown = shown_rows(weights_of(items), k_most_detailed);
    for (const std::size_t i : shown) {
        const ComparedItem& compared = items[i];
        const std::string id = count(i + 1);
        builder.section("item-" + id, items.size() == 1
                                          ? words("heading", "assigned_value")
                                          : words.filled("comparison", "item_heading", {{"item", compared.name}}));
        assigned_value_section(builder, words, compared, id);
        results_table(builder, words, compared, id);
        if (items.size() > 1 && i > 0) {
            values_figure(builder, words, c, compared, "plot-values-" + id);
        }
        if (compared.item->score == "En") {
            const std::string plot = "plot-differences-" + id;
            figure_if_any(builder, plot, words.filled("comparison", "figure_differences", {{"item", compared.name}}),
                          words("plot", "laboratory_differences_description"),
                          laboratory_differences_plot(c, *compared.item, plot, words));
        }
        if (!compared.item->score.empty()) {
            const std::string plot = "plot-scores-" + id;
            figure_if_any(builder, plot,
                          words.filled("comparison", "figure_scores",
                                       {{"item", compared.name}, {"score", score_name(words, compared.item->score)}}),
                          words("plot", "laboratory_scores_description"),
                          laboratory_scores_plot(c, *compared.item, plot, words));
        }
        pairs_of_item(builder, words, compared, id);
        realism_table(builder, words, compared, id);
    }
    if (shown.size() < items.size()) {
        builder.section("further_items");
        builder.paragraph(words.filled("comparison", "items_in_record",
                                       {{"shown", count(shown.size())}, {"count", count(items.size())}}));
    }
}

void shared_sources(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    if (c.shared_sources.empty()) {
        return;
    }
    builder.section("comparison_correlations");
    builder.paragraph(words("comparison", "shared_sources"));
    shared_sources_table(builder, words, c);
}

void participants_section(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    builder.section("participants");
    std::vector<double> weights;
    for (const ParticipantSummary& p : c.participants) {
        weights.push_back(2.0 * static_cast<double>(p.actions) + static_cast<double>(p.warnings + p.inconclusive));
    }
    Rows names;
    Rows rows;
    const bool any_inconclusive = std::any_of(c.participants.begin(), c.participants.end(),
                                              [](const ParticipantSummary& p) { return p.inconclusive > 0; });
    const std::vector<std::size_t> shown = shown_rows(weights, k_most_rows);
    for (const std::size_t i : shown) {
        const ParticipantSummary& p = c.participants[i];
        const std::string name = c.names_released && p.name != p.id ? p.name : "";
        if (!name.empty() || !p.group.empty()) {
            names.push_back({p.id, name, p.group});
        }
        rows.push_back({p.id, plain(p.results), plain(p.scored), plain(p.warnings), plain(p.actions),
                        any_inconclusive ? plain(p.inconclusive) : "", p.mean_abs_En.text, p.max_abs_En.text,
                        p.rms_En.text, p.p_low.text, p.p_high.text});
    }
    say_what_is_shown(builder, words, weights, shown.size());
    const Column laboratory = {words("comparison", "participant"), ""};
    table_of_filled_columns(builder, "participant-names", words("comparison", "names_table"),
                            {laboratory, {words("label", "name"), ""}, {words("comparison", "group"), ""}}, names);
    table_of_filled_columns(builder, "participants", words("comparison", "participants_table"),
                            {laboratory,
                             {words("comparison", "results"), "", true},
                             {words("comparison", "scored"), "", true},
                             {words("comparison", "warnings"), "", true},
                             {words("comparison", "actions"), "", true},
                             {words("comparison", "inconclusive"), "", true},
                             {words("label", "mean_abs_En"), "", true},
                             {words("label", "max_abs_En"), "", true},
                             {words("label", "rms_En"), "", true},
                             {"p_low", "", true},
                             {"p_high", "", true}},
                            rows);
}

void vectors_section(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    if (c.vectors.empty()) {
        return;
    }
    builder.section("vectors");
    builder.paragraph(words("comparison", "vectors"));
    std::vector<double> weights;
    for (const VectorScore& v : c.vectors) {
        weights.push_back(v.vector_En.number > 1.0 ? v.vector_En.number : 0.0);
    }
    Rows rows;
    for (const std::size_t i : shown_rows(weights, k_most_rows)) {
        const VectorScore& v = c.vectors[i];
        rows.push_back({v.name, v.participant, v.round, plain(v.quantities), v.vector_En.text, v.max_abs_En.text});
    }
    say_what_is_shown(builder, words, weights, rows.size());
    table_of_filled_columns(builder, "vectors", words("comparison", "vectors_table"),
                            {{words("comparison", "vector"), ""},
                             {words("comparison", "participant"), ""},
                             {words("comparison", "round"), ""},
                             {words("comparison", "quantities"), "", true},
                             {words("comparison", "vector_En"), "", true},
                             {words("label", "max_abs_En"), "", true}},
                            rows);
}

/// "solution 1, round 2"
Text name_in_round(const Wording& words, const Comparison& c, const std::string& item, const std::string& round) {
    const Text name = name_of_item(c, item);
    return round.empty() ? name : words.filled("comparison", "item_in_round", {{"item", name}, {"round", round}});
}

/// Deviations as z, in which laboratories that are off by equal parts of σ_pt lie on one line.
void divide_by_sigma(YoudenDiagram& diagram) {
    const double first = *diagram.sigma_first;
    const double second = *diagram.sigma_second;
    for (YoudenPoint& p : diagram.points) {
        p.first /= first;
        p.second /= second;
    }
    for (auto& [x, y] : diagram.ellipse) {
        x /= first;
        y /= second;
    }
    diagram.centre_first /= first;
    diagram.centre_second /= second;
    diagram.scale_first /= first;
    diagram.scale_second /= second;
    diagram.first_unit = diagram.second_unit = "";
}

void youden_section(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    if (c.youden.empty()) {
        return;
    }
    builder.section("youden");
    builder.paragraph(words("comparison", "youden"));
    for (std::size_t i = 0; i < std::min(c.youden.size(), k_most_detailed); ++i) {
        YoudenDiagram diagram = c.youden[i];
        const Text first = name_in_round(words, c, diagram.first_item, diagram.round);
        const Text second = name_in_round(words, c, diagram.second_item, diagram.round);
        diagram.first_item = first.first();
        diagram.second_item = second.first();
        const bool in_z = diagram.sigma_first && diagram.sigma_second;
        if (in_z) {
            divide_by_sigma(diagram);
        }
        const std::string id = "plot-youden-" + count(i + 1);
        figure_if_any(builder, id,
                      words.filled("comparison", "figure_youden",
                                   {{"first", first},
                                    {"second", second},
                                    {"r", words.number(gum::round_to_quantum(diagram.correlation, 2))}}),
                      words.filled("plot", "youden_description", {{"first", first}, {"second", second}}),
                      youden_plot(diagram, id, words));
    }
}

/// One sentence for every score that some result has.
void how_to_read(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    Facts facts;
    for (const char* score : k_scores) {
        if (std::any_of(c.points.begin(), c.points.end(),
                        [&](const ComparisonPoint& p) { return !score_of(p, score).text.empty(); })) {
            facts.emplace_back(score_name(words, score), words("comparison_score_reading", score));
        }
    }
    const auto add = [&](const char* name, const Text& label, auto has) {
        if (std::any_of(c.points.begin(), c.points.end(), has)) {
            facts.emplace_back(label, words("comparison_score_reading", name));
        }
    };
    add("P_A", "P_A", [](const ComparisonPoint& p) { return !p.P_A.text.empty(); });
    add("En_worst", words("comparison", "En_worst"), [](const ComparisonPoint& p) { return !p.En_worst.text.empty(); });
    add("En_audited", words("comparison", "En_audited"),
        [](const ComparisonPoint& p) { return p.En_audited.number.has_value(); });
    if (!facts.empty()) {
        builder.section("how_to_read");
        builder.definitions(facts);
        if (!c.audit_finding.empty()) {
            builder.paragraph(words.filled("comparison", "audit_finding", {{"finding", c.audit_finding}}));
        }
    }
}

}  // namespace

std::string name_of_item(const Comparison& comparison, const std::string& id) {
    const auto found = std::find_if(comparison.items.begin(), comparison.items.end(),
                                    [&](const ComparisonItemEvaluation& item) { return item.id == id; });
    return found == comparison.items.end() || found->name.empty() ? id : found->name;
}

std::vector<ComparedItem> compared_items(const Wording& words, const Comparison& comparison) {
    std::vector<ComparedItem> items;
    std::map<std::pair<std::string, std::string>, std::size_t> at;
    for (const ComparisonItemEvaluation& item : comparison.items) {
        at[{item.id, item.round}] = items.size();
        Text name = item.name.empty() ? Text(item.id) : Text(item.name);
        name = name.empty() ? words("comparison", "the_item") : name;
        items.push_back({.item = &item,
                         .points = {},
                         .name = item.round.empty() ? name
                                                    : words.filled("comparison", "item_in_round",
                                                                   {{"item", name}, {"round", item.round}})});
    }
    for (const ComparisonPoint& p : comparison.points) {
        if (const auto found = at.find({p.item, p.round}); found != at.end()) {
            items[found->second].points.push_back(&p);
        }
    }
    return items;
}

Text score_name(const Wording& words, const std::string& score) {
    return score.empty() ? Text() : score == "D" ? Text("D") : words("label", score);
}

void laboratory_answer(CertificateBuilder& builder, const Wording& words, const Comparison& c, Facts facts,
                       const Facts& conventions) {
    const std::vector<ComparedItem> items = compared_items(words, c);
    builder.section("answer");
    Text compared;
    answer_of_items(builder, words, items);
    for (std::size_t i = 0; i < std::min(items.size(), k_most_side_by_side); ++i) {
        compared = compared.empty() ? items[i].name : compared + "; " + items[i].name;
    }
    vectors_in_brief(builder, words, c);
    factors_in_brief(builder, words, c);
    items_without_result(builder, words, c);
    if (items.size() > k_most_side_by_side) {
        compared = words.fill("and_more", {{"names", compared}, {"count", count(items.size() - k_most_side_by_side)}});
    }
    if (compared != words("comparison", "the_item")) {
        facts.insert(facts.begin(), {words("comparison", "compared"), compared});
    }
    facts.emplace_back(words("comparison", "participants"), count(c.participants.size()));
    if (items.size() == 1) {
        facts_of_only_item(facts, words, *items[0].item);
    }
    facts.insert(facts.end(), conventions.begin(), conventions.end());
    builder.definitions(facts);
    if (!items.empty()) {
        values_figure(builder, words, c, items[0], "plot-values-1");
    }
    if (items.size() == 1) {
        one_item_of_answer(builder, words, items[0]);
    } else if (items.size() <= k_most_side_by_side) {
        scores_side_by_side(builder, words, c, items);
        assigned_values_table(builder, words, items);
    } else {
        items_table(builder, words, items);
    }
}

void laboratory_sections(CertificateBuilder& builder, const Wording& words, const Comparison& c) {
    how_to_read(builder, words, c);
    remarks_section(builder, words, c);
    item_sections(builder, words, c, compared_items(words, c));
    participants_section(builder, words, c);
    vectors_section(builder, words, c);
    youden_section(builder, words, c);
    shared_sources(builder, words, c);
}

}  // namespace gumcert::reports
