#include "reports/summary/record_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/unit.h"
#include "reports/printed_texts.h"
#include "reports/record/comparison_scores.h"
#include "reports/record/record_kinds.h"
#include "reports/view/comparison_sections.h"
#include "reports/wording.h"
#include "text/degrees_of_freedom.h"
#include "text/lists.h"

namespace gumcert::reports {

namespace {

/// "k = 2.92, p = 99 %": how the expanded uncertainty was found.
std::string coverage_text(const ReportedResult& result) {
    std::string text = result.k ? fmt::format("k = {:.2f}, ", *result.k) : "";
    text += "p = " + percent_text(result.coverage_probability);
    return result.method == "monte_carlo" ? text + ", Monte Carlo" : text;
}

/// "l = 50000203 nm ± 57 nm", or the interval where that alone holds.
void add_reported(std::string& text, const Result& result) {
    const ReportedResult& reported = result.reported;
    const std::string unit = reported.printed.unit.empty() ? "" : " " + reported.printed.unit;
    if (!reported.printed.U.empty()) {
        text += fmt::format("  {} = {} ± {}{}   ({})\n", result.name, reported.printed.value, reported.printed.U, unit,
                            coverage_text(reported));
    } else if (!reported.printed_low.empty()) {
        const std::string u = reported.printed_u.empty() ? "no u exists" : "u = " + reported.printed_u + unit;
        text += fmt::format("  {} = {}{}, {}, interval {} to {}{}   ({})\n", result.name, reported.printed.value, unit,
                            u, reported.printed_low, reported.printed_high, unit, coverage_text(reported));
    } else {
        text += fmt::format("  {} = {}{}   no expanded uncertainty can be stated\n", result.name,
                            reported.printed.value, unit);
    }
}

/// Results of a budget, one a line; of a long table of points the first ones.
void add_results(std::string& text, const EvaluationRecord& record) {
    constexpr std::size_t k_most_lines = 30;
    for (std::size_t i = 0; i < record.results.size() && i < k_most_lines; ++i) {
        const Result& result = record.results[i];
        add_reported(text, result);
        if (result.monte_carlo) {
            const MonteCarloSummary& monte_carlo = *result.monte_carlo;
            text += fmt::format("      Monte Carlo, {} trials: u = {}, interval {} to {}", monte_carlo.trials.text,
                                monte_carlo.u.number ? monte_carlo.u.text : "does not exist",
                                monte_carlo.symmetric.text[0], monte_carlo.symmetric.text[1]);
            if (monte_carlo.validation) {
                text += !monte_carlo.validation->precise_enough ? "; too few trials to validate"
                        : monte_carlo.validation->validated     ? "; law of propagation validated"
                                                                : "; law of propagation NOT validated";
            }
            text += "\n";
        }
    }
    if (record.results.size() > k_most_lines) {
        text += fmt::format("  … and {} more, all of them in the record\n", record.results.size() - k_most_lines);
    }
}

/// "10.05 ± 0.12 mm"; without ± where there is no uncertainty; "20.1 °C ± 0.3 K" where the units differ.
std::string with_uncertainty(const std::string& value, const std::string& U, const std::string& unit,
                             const std::string& difference_unit) {
    const auto in = [](const std::string& of) {
        const std::string shown = gum::unit_for_people(of);
        return shown.empty() ? "" : " " + shown;
    };
    return U.empty()                 ? value + in(unit)
           : unit == difference_unit ? value + " ± " + U + in(unit)
                                     : value + in(unit) + " ± " + U + in(difference_unit);
}

/// "largest consistent subset"; the name of a method of ComparisonItemEvaluation::method for people.
std::string method_in_words(const std::string& method) {
    if (method == "algorithm_a") {
        return "algorithm A";
    }
    if (method == "q_hampel") {
        return "Q method with Hampel's mean";
    }
    if (method == "dersimonian_laird" || method == "mandel_paule" || method == "vangel_rukhin") {
        return method == "dersimonian_laird" ? "DerSimonian-Laird"
               : method == "mandel_paule"    ? "Mandel-Paule"
                                             : "Vangel-Rukhin";
    }
    if (method == "reference") {
        return "reference laboratory";
    }
    if (method == "given") {
        return "given value";
    }
    std::string words = method;
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

/// The score of a result that decides. A deviation stands in the line already: P_A says what share of its limit it is.
std::string deciding_score(const ComparisonPoint& point, const std::string& score) {
    const std::string text = score == "D" ? point.P_A.text : score_of(point, score).text;
    return text.empty() ? "–" : text;
}

const char* score_symbol(const std::string& score) {
    return score == "z_prime" ? "z'" : score == "D" ? "P_A %" : score.c_str();
}

/// "action (D)": a signal, and who gives it where that is not the score beside it.
std::string signal_in_words(const ComparisonPoint& point, const std::string& score) {
    const std::vector<std::string>& by = point.signal_by;
    if (by.empty() || std::find(by.begin(), by.end(), score) != by.end()) {
        return point.signal;
    }
    std::string names;
    for (const std::string& name : by) {
        names += (names.empty() ? "" : ", ") + std::string(name == "En_audited" ? "En with findings corrected"
                                                           : name == "En_worst" ? "En for the worst correlation"
                                                                                : score_symbol(name));
    }
    return point.signal + " (" + names + ")";
}

/// "= 0.03", and "< 1E-300" of a p below what can be stated.
std::string equal_to(const std::string& printed) {
    std::string text = "= ";
    append_value(text, printed);
    return text;
}

void add_names(std::string& text, const char* what, const std::vector<std::string>& names) {
    constexpr std::size_t k_most_names = 30;
    if (!names.empty()) {
        text += fmt::format("  {}: {}\n", what, text::listed(names, k_most_names));
    }
}

void add_item(std::string& text, const Comparison& comparison, const ComparisonItemEvaluation& item,
              const std::string& coverage) {
    constexpr std::size_t k_most_lines = 30;
    const std::string name = item.name.empty() ? item.id : item.name;
    const std::string round = item.round.empty() ? "" : "round " + item.round;
    if (!name.empty() || !round.empty()) {
        text += fmt::format("\n{}{}{}\n", name, name.empty() || round.empty() ? "" : ", ", round);
    }
    text += fmt::format("  assigned value ({}) {}{}\n", method_in_words(item.method),
                        with_uncertainty(item.value.text, item.U.text, item.unit, item.difference_unit),
                        item.k.text.empty()
                            ? ""
                            : "   (k = " + item.k.text + (item.nu.text.empty() ? "" : ", nu = " + item.nu.text) +
                                  ", p = " + coverage + ")");
    if (item.consistency) {
        text += fmt::format("  consistency: chi-square {} on {}, p {}{}\n", item.consistency->chi_square.text,
                            text::degrees_of_freedom(std::to_string(item.consistency->degrees_of_freedom)),
                            equal_to(item.consistency->p_value.text),
                            item.consistency->consistent  ? ""
                            : item.consistency->by_chance ? "   not consistent, as one of several items is by chance"
                                                          : "   NOT consistent");
    }
    add_names(text, "without a result", item.missing);
    add_names(text, "not in the largest consistent subset", item.not_consistent);
    std::size_t lines = 0;
    std::size_t left_out = 0;
    for (const ComparisonPoint& point : comparison.points) {
        if (point.item != item.id || point.round != item.round) {
            continue;
        }
        if (++lines > k_most_lines) {
            ++left_out;
            continue;
        }
        text += fmt::format("  {:<12} {:<26} D {:>10}", point.participant,
                            with_uncertainty(point.value.text, point.U.text, item.unit, item.difference_unit),
                            point.D.text);
        if (!item.score.empty()) {
            text += fmt::format("   {} {:>6}", score_symbol(item.score), deciding_score(point, item.score));
        }
        text += fmt::format(
            "{}{}\n", point.signal == "none" || point.signal.empty() ? "" : "   " + signal_in_words(point, item.score),
            agreement_is_open(point) ? "   " + point.En_worst.text + " for the worst correlation" : "");
    }
    if (left_out > 0) {
        text += fmt::format("  … and {} more, all of them in the record\n", left_out);
    }
}

void add_laboratories(std::string& text, const Comparison& comparison, const std::string& coverage) {
    constexpr std::size_t k_most_items = 5;
    for (std::size_t i = 0; i < comparison.items.size() && i < k_most_items; ++i) {
        add_item(text, comparison, comparison.items[i], coverage);
    }
    if (comparison.items.size() > k_most_items) {
        text += fmt::format("\n… and {} more, all of them in the record\n", comparison.items.size() - k_most_items);
    }
    std::size_t warnings = 0;
    std::size_t actions = 0;
    for (const ComparisonPoint& point : comparison.points) {
        warnings += point.signal == "warning" ? 1U : 0U;
        actions += point.signal == "action" ? 1U : 0U;
    }
    std::size_t inconclusive = 0;
    for (const ComparisonPoint& point : comparison.points) {
        inconclusive += point.signal == "inconclusive" ? 1U : 0U;
    }
    text +=
        fmt::format("\n{}: {} with an action signal, {} with a warning signal\n",
                    text::count_of(static_cast<std::int64_t>(comparison.points.size()), "result"), actions, warnings);
    if (inconclusive > 0) {
        text += fmt::format(
            "{} cannot be judged: the assigned value is too uncertain for them, of unknown uncertainty, or one of "
            "several, or nobody knows what they share\n",
            inconclusive);
    }
    for (const VectorScore& vector : comparison.vectors) {
        if (vector.signal == "action") {
            text += fmt::format("{}, {}{}: the quantities lie outside their joint region (vector En {})\n",
                                vector.participant, vector.name, vector.round.empty() ? "" : ", " + vector.round,
                                vector.vector_En.text);
        }
    }
    const auto inconsistent =
        std::count_if(comparison.items.begin(), comparison.items.end(), [](const ComparisonItemEvaluation& i) {
            return i.consistency && !i.consistency->consistent && !i.consistency->by_chance;
        });
    if (inconsistent > 0 && comparison.items.size() > k_most_items) {
        text +=
            fmt::format("{} of {} items: the results contradict each other\n", inconsistent, comparison.items.size());
    }
    for (const ItemWithoutResult& item : comparison.items_without_result) {
        const std::string name = item.name.empty() ? item.id : item.name;
        const std::string round = item.round.empty() ? "" : (name.empty() ? "round " : ", round ") + item.round;
        text += fmt::format("{}{}: no result: {} [{}]\n", name, round, item.what, item.code);
    }
}

/// What a comparison of methods shows, for people.
const char* verdict_text(const std::string& verdict, bool lacks_degrees) {
    return verdict == "agreement_few_points" && lacks_degrees
               ? "agreement; too few degrees of freedom to tell whether the uncertainties are right"
           : verdict == "validated"                   ? "validated"
           : verdict == "agreement_reference_limited" ? "agreement, limited by the uncertainty of the reference"
           : verdict == "uncertainty_too_large" ? "agreement, but the uncertainties are larger than the differences"
           : verdict == "reference_not_better"  ? "no contradiction; the reference is not better than the method"
           : verdict == "correlation_unknown"
               ? "no contradiction if both methods share nothing; with what they may share it cannot be said"
           : verdict == "agreement_few_points" ? "agreement; too few points to tell whether the uncertainties are right"
           : verdict == "uncertainty_not_confirmed" ? "agreement; whether the uncertainties are right cannot be told"
           : verdict == "joint_test_open"           ? "no verdict: whether chance explains all differences is open"
           : verdict == "falls_with_finding" ? "does not stand once the finding on the uncertainties is corrected"
           : verdict == "points_above_1"     ? "more points above 1 than chance explains"
           : verdict == "side_refuted"       ? "no verdict: the evaluation of a side refutes what it states"
           : verdict == "disagreement"       ? "disagreement"
                                             : "";
}

void add_methods(std::string& text, const Comparison& comparison) {
    text += fmt::format("\n{}{} with {}:\n", comparison.method_name, comparison.method_name.empty() ? "Comparison" : "",
                        comparison.reference_name);
    for (const ComparisonSummary& row : comparison.summary) {
        text += fmt::format("  {:<6}  mean |En| {}   max |En| {}   above 1: {} of {}", row.direction,
                            row.mean_abs_En.text, row.max_abs_En.text, row.count_above_1, row.points);
        if (!row.p_low.text.empty()) {
            text += fmt::format("   p_low {}", row.p_low.text);
        }
        if (!row.verdict.empty()) {
            text += fmt::format("\n          {}", verdict_text(row.verdict, row.power_lacks_degrees));
        }
        text += "\n";
    }
}

void add_comparison(std::string& text, const EvaluationRecord& record) {
    if (!record.comparison) {
        return;
    }
    if (record.comparison->form == "laboratories") {
        add_laboratories(text, *record.comparison, record.coverage_probability.text);
    } else {
        add_methods(text, *record.comparison);
    }
}

void add_rotary_table(std::string& text, const EvaluationRecord& record) {
    const RotaryTable& rotary = *record.rotary;
    text += fmt::format("Set-up of the fixture (value ± U, p = {}):\n", record.coverage_probability.text);
    for (const Result& result : record.results) {
        text += fmt::format("  {:<4} {:>9} ± {} {}   {}\n", result.name, result.printed.value, result.printed.U,
                            result.printed.unit, result.description);
    }
    text += fmt::format("\nError motions over {}, datum {}:\n",
                        text::count_of(static_cast<std::int64_t>(rotary.errors.size()), "angle"),
                        rotary.datum == "home" ? "home" : "axis average line");
    for (const RangeRow& range : rotary.ranges) {
        const Printed& printed = range.stated.printed;
        text += fmt::format("  {}  range {:>7} ± {} {}\n", range.name, printed.value, printed.U, printed.unit);
    }
    text += fmt::format("\nAdjustment: {}, {}, chi-square {} on {}, p {}\n",
                        text::count_of(static_cast<std::int64_t>(rotary.adjustment.observations), "observation"),
                        text::count_of(static_cast<std::int64_t>(rotary.adjustment.parameters), "parameter"),
                        rotary.adjustment.chi_square.text,
                        text::degrees_of_freedom(std::to_string(rotary.adjustment.degrees_of_freedom)),
                        equal_to(rotary.adjustment.p_value.text));
    std::size_t removed = 0;
    for (const FlaggedDistance& distance : rotary.flagged) {
        removed += distance.removed ? 1 : 0;
    }
    text += fmt::format("Outlying distances: {} found, {} left out (listed in the certificate)\n",
                        rotary.flagged.size(), removed);
    if (rotary.monte_carlo) {
        text += fmt::format("\nMonte Carlo: {}\n", rotary.monte_carlo->statement);
    }
    add_comparison(text, record);  // with its reference method, where there is one
}

/// What is shown of a record of one kind; of others, their results.
struct Summary {
    std::string_view kind;
    void (*add)(std::string& text, const EvaluationRecord& record);
};
constexpr std::array<Summary, 2> k_summaries{
    {{k_rotary_table_kind, add_rotary_table}, {k_comparison_kind, add_comparison}}};

}  // namespace

std::string summary_text(const EvaluationRecord& record) {
    std::string text;
    if (!record.title.empty()) {
        text += fmt::format("{}\n\n", record.title);
    }
    const auto own = std::ranges::find(k_summaries, record.kind, &Summary::kind);
    (own != k_summaries.end() ? own->add : add_results)(text, record);
    return text;
}

}  // namespace gumcert::reports
