#include "reports/record/make/comparison/laboratory_notes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "certificate/statement_of_uncertainty.h"
#include "gum/rounding.h"
#include "reports/record/make/comparison/comparison_print.h"
#include "reports/record/make/record_parts.h"
#include "text/degrees_of_freedom.h"
#include "text/lists.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using reports::ComparisonItemEvaluation;

std::string place_of(const ComparisonItemEvaluation& item) {
    const std::string place = item.id.empty() ? "comparison" : "item \"" + item.id + "\"";
    return item.round.empty() ? place : place + ", round \"" + item.round + "\"";
}

constexpr std::size_t k_most_names_in_remark = 12;

/// A coverage probability: "95.45 %".
std::string in_percent(double probability) {
    return certificate::printed_coverage_probability(probability) + " %";
}

/// The numbers of a comparison, and their texts in its record.
struct Evaluated {
    const jobs::ComparisonJob& job;
    const gum::LaboratoryComparison& comparison;
    const reports::Comparison& record;
};

/// A message about those items that something holds for; nothing where it holds for none.
class ItemMessages {
public:
    explicit ItemMessages(const Evaluated& evaluated) : evaluated_(evaluated) {}

    /// \param what  of the first of them; how many others there are is added
    void add(gum::Diagnostic message, const std::function<bool(const gum::ItemResult&)>& holds,
             const std::function<std::string(const ComparisonItemEvaluation&)>& what) {
        const std::vector<gum::ItemResult>& items = evaluated_.comparison.items;
        const auto first = std::find_if(items.begin(), items.end(), holds);
        if (first == items.end()) {
            return;
        }
        const ComparisonItemEvaluation& recorded =
            evaluated_.record.items[static_cast<std::size_t>(first - items.begin())];
        message.where = place_of(recorded);
        message.what = what(recorded);
        if (const auto count = std::count_if(first, items.end(), holds); count > 1) {
            message.what += ", and " + std::to_string(count - 1) + (count > 2 ? " more like it" : " other like it") +
                            " among " + std::to_string(items.size());
        }
        messages_.push_back(std::move(message));
    }

    [[nodiscard]] std::vector<gum::Diagnostic> take() { return std::move(messages_); }
    [[nodiscard]] const gum::LaboratoryComparison& comparison() const { return evaluated_.comparison; }
    [[nodiscard]] const jobs::ComparisonJob& job() const { return evaluated_.job; }
    [[nodiscard]] const ComparisonItemEvaluation* first_recorded() const { return evaluated_.record.items.data(); }

private:
    const Evaluated& evaluated_;
    std::vector<gum::Diagnostic> messages_;
};

/// A number with the unit of differences behind it.
std::string with_unit(const std::string& number, const ComparisonItemEvaluation& item) {
    const std::string unit = gum::unit_for_people(item.difference_unit);
    return unit.empty() ? number : number + " " + unit;
}

bool inconsistent(const gum::ItemResult& item) {
    return item.consistency && !item.consistency->test.consistent && !item.consistency->by_chance;
}

std::string test_text(const ComparisonItemEvaluation& item) {
    const reports::ConsistencySummary& test = *item.consistency;
    return "the results are not consistent with their uncertainties: chi-square " + test.chi_square.text + " on " +
           text::degrees_of_freedom(std::to_string(test.degrees_of_freedom)) + ", p = " + test.p_value.text +
           ", below alpha = " + text::shortest(test.alpha);
}

void add_consistency(ItemMessages& messages) {
    const gum::Diagnostic warning{
        .code = "GC-COMPARE-0120",
        .where = "",
        .what = "",
        .rule = "the uncertainty of a weighted mean holds for results that are",
        .action =
            "Take largest_consistent_subset, or a mean with a variance between laboratories (mandel_paule), unless "
            "a laboratory corrects its result.",
        .severity = gum::Severity::warning};
    messages.add(
        warning,
        [](const gum::ItemResult& item) {
            return item.method == gum::AssignedValueMethod::weighted_mean && inconsistent(item);
        },
        test_text);
    gum::Diagnostic note = warning;
    note.rule = "the assigned value does not rest on this consistency";
    note.action =
        "At least one value or one uncertainty is wrong, and small scores clear nobody: look for the cause, beginning "
        "with the results of large scores.";
    messages.add(
        note,
        [](const gum::ItemResult& item) {
            return item.method != gum::AssignedValueMethod::weighted_mean && inconsistent(item);
        },
        test_text);
}

/// Whether the checks of the items and the results speak of different sizes, as they do where one of them is in another
/// unit: s_s would then be held against the wrong limit, and be much too small or too large in u(X).
bool checks_are_of_another_size(const gum::ItemResult& item) {
    constexpr double k_many_sigma = 10.0;
    constexpr double k_factor = 3.0;
    if (!item.homogeneity) {
        return false;
    }
    const double sigma = item.homogeneity->limit / gum::k_assigned_value_criterion;
    const double mean = item.homogeneity->mean;
    const double smaller = std::min(std::abs(mean), std::abs(item.value));
    const double larger = std::max(std::abs(mean), std::abs(item.value));
    // Differences from a standard scatter as the items do about a small mean. In another unit the mean would be as many
    // times too small as the scatter is.
    const bool are_differences =
        smaller == std::abs(mean) && item.homogeneity->s_x * larger > k_factor * sigma * smaller;
    return !are_differences && std::abs(mean - item.value) > k_many_sigma * sigma &&
           (larger > k_factor * smaller || mean * item.value < 0.0);
}

void add_checks_of_items(ItemMessages& messages) {
    messages.add({.code = "GC-COMPARE-0132",
                  .where = "",
                  .what = "",
                  .rule = "the checks of the items are stated in the unit of the results",
                  .action = "Convert them, for s_s is part of u(X); or look for an error in the assigned value.",
                  .severity = gum::Severity::warning},
                 checks_are_of_another_size, [](const ComparisonItemEvaluation& item) {
                     const std::string unit = gum::unit_for_people(item.unit);
                     const auto in_unit = [&](const std::string& number) {
                         return unit.empty() ? number : number + " " + unit;
                     };
                     return "the measurements of homogeneity lie about " + in_unit(item.homogeneity->mean.text) +
                            ", and the assigned value is " + in_unit(item.value.text);
                 });
    messages.add(
        {.code = "GC-COMPARE-0122",
         .where = "",
         .what = "",
         .rule = "s_s must not be larger (ISO 13528:2022, annex B)",
         .action = "Its standard uncertainty is in u(X). Where that makes the scores meaningless, take items that "
                   "are more alike.",
         .severity = gum::Severity::warning},
        [](const gum::ItemResult& item) { return item.homogeneity && !item.homogeneity->sufficient_expanded; },
        [](const ComparisonItemEvaluation& item) {
            return "the items differ by s_s = " + with_unit(item.homogeneity->s_s.text, item) +
                   ", the expanded limit is " + with_unit(item.homogeneity->expanded_limit.text, item);
        });
    messages.add(
        {.code = "GC-COMPARE-0123",
         .where = "",
         .what = "",
         .rule = "the items must not change by more (ISO 13528:2022, annex B)",
         .action = "A drift of this size, in either direction, is in u(X) with difference/√3. Where it is known "
                   "which way it went, correct for it.",
         .severity = gum::Severity::warning},
        [](const gum::ItemResult& item) { return item.stability && !item.stability->stable_expanded; },
        [](const ComparisonItemEvaluation& item) {
            return "the items changed by " + with_unit(item.stability->difference.text, item) +
                   ", the expanded limit is " + with_unit(item.stability->expanded_limit.text, item);
        });
}

bool has_inconclusive(const gum::LaboratoryComparison& comparison, const gum::ItemResult& item) {
    return std::any_of(comparison.results.begin(), comparison.results.end(), [&](const gum::ScoredResult& result) {
        return result.item == item.item && result.round == item.round && result.verdict == gum::Verdict::inconclusive &&
               result.verdict_by.empty();
    });
}

/// Whether the value that a result is held against is one of several: its subset is.
bool is_of_one_of_several_subsets(const gum::LaboratoryComparison& comparison, const gum::ScoredResult& point) {
    return std::any_of(comparison.items.begin(), comparison.items.end(), [&](const gum::ItemResult& item) {
        return item.item == point.item && item.round == point.round && !item.in_another_subset.empty();
    });
}

bool is_judged_by_en(const gum::LaboratoryComparison& comparison, const gum::ScoredResult& point) {
    return std::any_of(comparison.items.begin(), comparison.items.end(), [&](const gum::ItemResult& item) {
        return item.item == point.item && item.round == point.round && item.score == gum::DecidingScore::en;
    });
}

void add_assigned_value(ItemMessages& messages) {
    messages.add(
        {.code = "GC-COMPARE-0128",
         .where = "",
         .what = "",
         .rule = "a score can clear a result only against a value that is more certain",
         .action =
             "Take an assigned value with a smaller uncertainty: a reference laboratory, a reference material, or "
             "more results.",
         .severity = gum::Severity::warning},
        [&](const gum::ItemResult& item) {
            return item.u && item.in_another_subset.empty() && has_inconclusive(messages.comparison(), item);
        },
        [](const ComparisonItemEvaluation& item) {
            return "the assigned value, " + item.value.text +
                   (item.U.text.empty() ? "" : " with U = " + with_unit(item.U.text, item)) +
                   ", is too uncertain to clear some of the results";
        });
    messages.add(
        {.code = "GC-COMPARE-0121",
         .where = "",
         .what = "",
         .rule = "z is used up to 0.3, z' above (ISO 13528:2022, clause 9)",
         .action = "",
         .severity = gum::Severity::note},
        [](const gum::ItemResult& item) { return !item.criterion_met; },
        [](const ComparisonItemEvaluation& item) {
            return "u(X) is " + item.criterion.text + " sigma_pt: z' decides";
        });
    messages.add(
        {.code = "GC-COMPARE-0124",
         .where = "",
         .what = "",
         .rule = "|difference| must not be larger than 2 u of the difference",
         .action = "Find out why before scores are issued: a bias that the laboratories share, or the "
                   "reference value.",
         .severity = gum::Severity::warning},
        [](const gum::ItemResult& item) { return item.consensus && !item.consensus->consistent; },
        [](const ComparisonItemEvaluation& item) {
            return "the consensus differs from the independent reference value by " +
                   with_unit(item.consensus->difference.text, item) + ", " + item.consensus->ratio.text +
                   " times its standard uncertainty";
        });
    messages.add(
        {.code = "GC-COMPARE-0126",
         .where = "",
         .what = "",
         .rule = "an uncertainty of the assigned value is needed for Eₙ, zeta and z'",
         .action = "Ask for results with more digits, or give an assigned value.",
         .severity = gum::Severity::warning},
        [](const gum::ItemResult& item) { return !item.u; },
        [](const ComparisonItemEvaluation&) {
            return std::string(
                "more than half of the results are equal: no uncertainty of the assigned value "
                "can be stated");
        });
    messages.add(
        {.code = "GC-COMPARE-0127",
         .where = "",
         .what = "",
         .rule = "correlations that are strong against the ratio of two uncertainties lead to it",
         .action = "Make sure of the correlations: the assigned value depends on them strongly.",
         .severity = gum::Severity::warning},
        [](const gum::ItemResult& item) {
            return std::any_of(item.weights.begin(), item.weights.end(),
                               [](const gum::ItemResult::Weight& weight) { return weight.weight < 0.0; });
        },
        [](const ComparisonItemEvaluation& item) {
            const auto weight =
                std::min_element(item.weights.begin(), item.weights.end(),
                                 [](const auto& a, const auto& b) { return a.weight.number < b.weight.number; });
            return "participant \"" + weight->participant + "\" has the negative weight " + weight->weight.text;
        });
}

/// The smallest and the largest of an assigned value and the results of its item.
std::pair<double, double> range_of(const gum::LaboratoryComparison& comparison, const gum::ItemResult& item) {
    std::pair<double, double> range(item.value, item.value);
    for (const gum::ScoredResult& result : comparison.results) {
        if (result.item == item.item && result.round == item.round) {
            range = {std::min(range.first, result.value), std::max(range.second, result.value)};
        }
    }
    return range;
}

/// Angles on both sides of a full turn: 359.9999° and 0.0002° may be one direction.
void add_turns(ItemMessages& messages) {
    const gum::LaboratoryComparison& comparison = messages.comparison();
    messages.add(
        {.code = k_turn_apart,
         .where = "",
         .what = "",
         .rule = k_turn_rule,
         .action = k_turn_action,
         .severity = gum::Severity::warning},
        [&](const gum::ItemResult& item) {
            const auto [low, high] = range_of(comparison, item);
            return is_turn_apart(low, high, messages.job().items[item.item].unit);
        },
        [&](const ComparisonItemEvaluation& recorded) {
            const auto at = static_cast<std::size_t>(&recorded - messages.first_recorded());
            const auto [low, high] = range_of(comparison, comparison.items[at]);
            return "angles from " + text::shortest(low) + " to " + with_unit(text::shortest(high), recorded) +
                   " lie a full turn apart, or nearly";
        });
}

bool any_item(const gum::LaboratoryComparison& comparison, const std::function<bool(const gum::ItemResult&)>& holds) {
    return std::any_of(comparison.items.begin(), comparison.items.end(), holds);
}

std::size_t count_results(const gum::LaboratoryComparison& comparison,
                          const std::function<bool(const gum::ScoredResult&)>& holds) {
    return static_cast<std::size_t>(std::count_if(comparison.results.begin(), comparison.results.end(), holds));
}

bool is_robust(const gum::ItemResult& item) {
    return item.method == gum::AssignedValueMethod::median || item.method == gum::AssignedValueMethod::algorithm_a ||
           item.method == gum::AssignedValueMethod::q_hampel;
}

/// What the test of all results said before some of them were left out.
std::string subset_remark(const gum::ItemResult& item, const ComparisonItemEvaluation& recorded) {
    const gum::ConsistencyTest& all = *item.consistency_of_all;
    std::string remark = "All " + std::to_string(item.contributing + item.not_consistent.size()) +
                         " results together are not consistent: chi-square " +
                         gum::round_significant(all.chi_square, 4) + " on " +
                         text::degrees_of_freedom(std::to_string(all.degrees_of_freedom)) +
                         ", p = " + printed_probability(all.p_value) + ". The largest consistent subset leaves out ";
    remark += text::listed(recorded.not_consistent) +
              ". Being left out says that a result does not fit the others, not that it is wrong.";
    if (item.contributing == item.not_consistent.size()) {
        remark += " As many results stand against the value as for it.";
    }
    if (!recorded.in_another_subset.empty()) {
        const std::string names = text::listed(recorded.in_another_subset);
        remark += item.subset_unique ? " Another subset of the same size, with " + names +
                                           ", is consistent as well; the one with the smallest chi-square was taken."
                                     : " Another subset of the same size, with " + names +
                                           ", has the same chi-square: the choice between them is arbitrary, though "
                                           "it does not depend on the order of the laboratories.";
        remark += " No result that either of them holds is judged.";
    }
    return remark;
}

/// That E_n takes another U(X) than the one that is stated with a given value, or computed for the probability of the job.
/// Of a reference laboratory the result is named with the others.
void add_remark_on_factor_of_value(const gum::LaboratoryComparison& comparison, std::vector<std::string>& remarks) {
    const auto is_converted = [](const gum::ItemResult& item) {
        return item.U_of_scores && item.expanded_by != gum::ExpandedBy::scatter && !item.reference_participant;
    };
    const std::string taken = " is not that of about 95 %: Eₙ takes U(X) = k u(X) with the factor for " +
                              in_percent(comparison.score_probability) + " and the degrees of freedom of u(X)";
    if (any_item(comparison, [&](const gum::ItemResult& item) {
            return is_converted(item) && item.expanded_by == gum::ExpandedBy::statement;
        })) {
        remarks.push_back("The coverage factor of a given assigned value" + taken + " in place of the given U(X).");
    }
    if (any_item(comparison, [&](const gum::ItemResult& item) {
            return is_converted(item) && item.expanded_by != gum::ExpandedBy::statement;
        })) {
        remarks.push_back("The coverage factor of a computed assigned value" + taken +
                          " in place of the U(X) that is printed.");
    }
}

/// What U(X) covers, and what U of the results mean in E_n.
void add_remarks_on_coverage(const Evaluated& evaluated, std::vector<std::string>& remarks) {
    const auto& [job, comparison, record] = evaluated;
    if (any_item(comparison,
                 [](const gum::ItemResult& item) { return item.expanded_by == gum::ExpandedBy::scatter; })) {
        remarks.emplace_back(
            "U(X) comes from the scatter of the results, with the t-distribution for their number: it covers also "
            "where "
            "laboratories differ by more than they state.");
    }
    if (count_results(comparison, [](const gum::ScoredResult& result) { return result.scatter.has_value(); }) > 0) {
        remarks.emplace_back(
            "In Eₙ of a laboratory the uncertainty of the assigned value is what the scatter of all other results "
            "says: "
            "a result that lies far away does not widen the limit that it is held against.");
    }
    for (const ComparisonItemEvaluation& item : record.items) {
        if (item.coverage_with_scatter.number) {
            remarks.emplace_back(
                "A U(X) that comes from the stated uncertainties alone covers what it claims only where these explain "
                "the whole scatter of the results. If the laboratories differed by a further standard deviation as "
                "large "
                "as the median of their u, U(X) would cover " +
                item.coverage_with_scatter.text + " of all cases in place of " + in_percent(job.coverage_probability) +
                (comparison.items.size() > 1 ? " (" + place_of(item) + ")." : "."));
            break;
        }
    }
    if (any_item(comparison, [](const gum::ItemResult& item) {
            return item.expanded_by == gum::ExpandedBy::uncertainties && std::isfinite(item.degrees_of_freedom) &&
                   !item.weights.empty();
        })) {
        remarks.emplace_back(
            "Weights that come from uncertainties with few degrees of freedom are uncertain themselves: U(X) of a "
            "weighted mean then covers less than it claims.");
    }
    if (any_item(comparison, [](const gum::ItemResult& item) { return item.leaves_out_degrees; })) {
        remarks.emplace_back(
            "The trials of a median draw results that correlate from normal distributions, whatever their degrees of "
            "freedom: U(X) then covers less than it claims.");
    }
    if (any_item(comparison, [](const gum::ItemResult& item) {
            return item.consistency && item.consistency->test.of_finite_degrees;
        })) {
        remarks.emplace_back(
            "The test of consistency takes degrees of freedom into account: for a result with few of them the normal "
            "quantity with the same probability stands in chi-square, and where results correlate the critical value "
            "is that of one estimate behind all of them.");
    }
    const bool by_default = std::any_of(job.items.begin(), job.items.end(),
                                        [](const gum::ComparisonItem& item) { return item.assigned_value.by_default; });
    if (by_default) {
        remarks.emplace_back("The job names no way to the assigned value; the default was taken.");
    }
    add_remark_on_factor_of_value(comparison, remarks);
    std::vector<std::string> converted;
    for (const gum::ScoredResult& result : comparison.results) {
        const std::string& id = job.participants[result.participant].id;
        if (result.of_scores && std::find(converted.begin(), converted.end(), id) == converted.end()) {
            converted.push_back(id);
        }
    }
    if (!converted.empty()) {
        remarks.push_back("The coverage factors of " + text::listed(converted, k_most_names_in_remark) +
                          " are not those of about 95 %: Eₙ takes U = k u with the factor for " +
                          in_percent(comparison.score_probability) + " and the degrees of freedom of u in place of U.");
        const bool of_budget = std::any_of(
            comparison.results.begin(), comparison.results.end(),
            [](const gum::ScoredResult& result) { return result.of_scores && result.uncertainty->of_scores; });
        if (of_budget) {
            remarks.emplace_back("Of a budget, Eₙ takes U for this probability from its distribution.");
        }
    }
    if (comparison.score_probability != job.coverage_probability) {
        remarks.push_back("Eₙ is defined for about 95 %: it takes expanded uncertainties for " +
                          in_percent(comparison.score_probability) + ", whatever the comparison states.");
    }
}

/// That u(X) is not that of the scatter.
void add_remark_on_statements(const gum::LaboratoryComparison& comparison, std::vector<std::string>& remarks) {
    if (any_item(comparison, [](const gum::ItemResult& item) { return item.u_by_statements; })) {
        remarks.emplace_back(
            "u(X) is the larger one of what the scatter of the results and of what their stated uncertainties and "
            "correlations give the value: here the latter, because scatter does not show what results share, or "
            "because "
            "they agree by chance.");
    }
}

void add_remarks_on_value(const Evaluated& evaluated, std::vector<std::string>& remarks) {
    const auto& [job, comparison, record] = evaluated;
    constexpr std::size_t k_few_for_robust = 12;
    constexpr std::size_t k_most_subset_remarks = 10;
    if (any_item(comparison, [](const gum::ItemResult& item) { return !item.correlation_known; })) {
        remarks.emplace_back(
            "A robust assigned value is not linear in the results: its covariance with a result that it is made of is "
            "taken as that of their mean, which is exact for normal results of equal uncertainty.");
    }
    add_remarks_on_coverage(evaluated, remarks);
    add_remark_on_statements(evaluated.comparison, remarks);
    if (any_item(comparison,
                 // A median by trials rests on no scale.
                 [](const gum::ItemResult& item) {
                     return is_robust(item) && item.expanded_by == gum::ExpandedBy::scatter &&
                            item.contributing < k_few_for_robust;
                 })) {
        remarks.emplace_back(
            "Fewer than 12 results: the scale of a robust assigned value is rough, and its coverage factor large for "
            "it.");
    }
    std::size_t subsets = 0;
    for (std::size_t i = 0; i < record.items.size(); ++i) {
        if (!comparison.items[i].not_consistent.empty() && subsets++ < k_most_subset_remarks) {
            const std::string prefix = record.items.size() > 1 ? place_of(record.items[i]) + ": " : "";
            remarks.push_back(prefix + subset_remark(comparison.items[i], record.items[i]));
        }
    }
    if (any_item(comparison, [](const gum::ItemResult& item) { return item.homogeneity.has_value(); })) {
        remarks.emplace_back(
            "The standard deviation between items, s_s, is in u(X): the item of a laboratory need not be the mean "
            "one.");
    }
}

void add_remarks_on_correlation(const jobs::ComparisonJob& job, const gum::LaboratoryComparison& comparison,
                                std::vector<std::string>& remarks) {
    if (!comparison.shared_sources.empty()) {
        remarks.emplace_back(
            "Results that name the same source of uncertainty are taken as correlated through it; the covariance is "
            "computed from what each of them states for the source.");
    }
    if (!job.independent_sources.empty()) {
        remarks.push_back(
            "Taken as not shared although several results may name it: " + text::listed(job.independent_sources) + ".");
    }
    if (count_results(comparison, [](const gum::ScoredResult& result) { return result.en_worst.has_value(); }) > 0) {
        remarks.emplace_back(
            "Laboratories of one group may share effects, and the job states no correlation for the group. Eₙ is given "
            "for none, and beside it for the worst that is plausible: that the smaller uncertainty is shared whole.");
    }
    if (count_results(comparison, [](const gum::ScoredResult& result) {
            return result.en_worst && !std::isfinite(*result.en_worst);
        }) > 0) {
        remarks.emplace_back(
            "Where all of the uncertainty of a difference may be common to both sides, no finite Eₙ bounds what that "
            "would do.");
    }
    if (comparison.summary && comparison.summary->agreement && comparison.summary->agreement->is_bounded) {
        remarks.emplace_back(
            "Uncertainties have finite degrees of freedom, and the differences from the assigned value correlate: no "
            "exact joint distribution is known.");
        remarks.emplace_back(
            "p_low and p_high are the largest of those for normal scores, for "
            "uncertainties that were estimated each by itself, and for one estimate behind all of them, and the band "
            "of "
            "the rms Eₙ is the widest.");
    }
    if (comparison.items.size() > 1) {
        remarks.emplace_back(
            "Results of one laboratory for several items or rounds share its standards and its set-up: they are not so "
            "many independent proofs, and no probability is given for them together.");
    }
}

/// What was found between the assigned value and the results, and what the budgets do not tell.
void add_remarks_on_sources(const gum::LaboratoryComparison& comparison, std::vector<std::string>& remarks) {
    std::set<std::string> ambiguous;
    for (const gum::ItemResult& item : comparison.items) {
        ambiguous.insert(item.ambiguous_sources.begin(), item.ambiguous_sources.end());
    }
    if (any_item(comparison, [](const gum::ItemResult& item) { return item.shares_sources; })) {
        remarks.emplace_back(
            "The assigned value and some results name the same source of uncertainty: they are taken as correlated "
            "through it, with the covariance of what both state for the source.");
    }
    if (!ambiguous.empty()) {
        remarks.push_back(
            "Budgets name a source for several inputs, and not for the same ones: how their results share it cannot be "
            "told, and the largest covariance that it can give was taken (" +
            text::listed({ambiguous.begin(), ambiguous.end()}) + ").");
    }
}

void add_remarks_on_uncertainties(const gum::LaboratoryComparison& comparison, std::vector<std::string>& remarks) {
    constexpr double k_suspicious_ratio = 2.0;
    const std::size_t large = count_results(comparison, [](const gum::ScoredResult& point) {
        return point.U_over_median.value_or(0.0) > k_suspicious_ratio ||
               point.U_over_cmc.value_or(0.0) > k_suspicious_ratio;
    });
    if (large > 0) {
        remarks.push_back(
            std::to_string(large) + (large > 1 ? " results state" : " result states") +
            " more than twice the U of the others or of the laboratory's own capability. |Eₙ| at or below 1 "
            "says little then: an uncertainty that is stated too large always passes.");
    }
    const std::size_t small = count_results(
        comparison, [](const gum::ScoredResult& point) { return point.realism == gum::UncertaintyRealism::small; });
    if (small > 0) {
        remarks.push_back(std::to_string(small) + (small > 1 ? " results state" : " result states") +
                          " a standard uncertainty below that of the assigned value.");
    }
    const auto is_not_cleared = [&](const gum::ScoredResult& point) {
        return point.verdict == gum::Verdict::inconclusive && point.verdict_by.empty() &&
               !is_of_one_of_several_subsets(comparison, point);
    };
    const std::size_t inconclusive = count_results(comparison, [&](const gum::ScoredResult& point) {
        return is_not_cleared(point) && is_judged_by_en(comparison, point);
    });
    if (inconclusive > 0) {
        remarks.push_back("The assigned value is less certain than " + std::to_string(inconclusive) +
                          (inconclusive > 1 ? " results claim to be: small scores clear none of them."
                                            : " result claims to be: a small score does not clear it."));
    }
    // sigma_pt or delta_E decides: what a laboratory claims for itself has no say in it.
    const std::size_t unjudged = count_results(comparison, [&](const gum::ScoredResult& point) {
        return is_not_cleared(point) && !is_judged_by_en(comparison, point);
    });
    if (unjudged > 0) {
        remarks.push_back(
            "For " + std::to_string(unjudged) + (unjudged > 1 ? " results" : " result") +
            " the assigned value is less certain than sigma_pt or delta_E asks, or its uncertainty is not "
            "known: small scores clear nobody.");
    }
    if (count_results(comparison, [](const gum::ScoredResult& point) { return point.en_audited.has_value(); }) > 0) {
        remarks.emplace_back(
            "Eₙ with findings corrected takes the corrected uncertainty of the laboratory, and of the reference "
            "laboratory; the value assigned from other results stays as it is.");
    }
    if (count_results(comparison, [](const gum::ScoredResult& point) {
            return point.zeta_as_normal && gum::signal_of_z(*point.zeta) != gum::signal_of_z(*point.zeta_as_normal);
        }) > 0) {
        remarks.emplace_back(
            "The limits 2 and 3 of zeta are those of a normal distribution: with few degrees of freedom zeta calls for "
            "what the normal quantity with the same probability calls for.");
    }
    const std::size_t without_score =
        count_results(comparison, [](const gum::ScoredResult& point) { return point.U_difference && !point.en; });
    if (without_score > 0) {
        remarks.push_back(std::to_string(without_score) + (without_score > 1 ? " results have" : " result has") +
                          " no Eₙ and no zeta: the uncertainty of the difference from the assigned value comes out as "
                          "0, and nothing can be divided by it.");
    }
}

void add_remarks_on_what_is_left_out(const gum::LaboratoryComparison& comparison, std::vector<std::string>& remarks) {
    if (comparison.pairs_left_out) {
        remarks.push_back("Bilateral degrees of equivalence are left out: more than " +
                          std::to_string(gum::k_most_pairs) + " pairs in all items together.");
    } else if (any_item(comparison, [](const gum::ItemResult& item) {
                   return item.results > gum::k_most_laboratories_in_pairs && item.pairs.empty();
               })) {
        remarks.emplace_back("Bilateral degrees of equivalence are listed for up to 40 laboratories.");
    }
    if (comparison.singular_vectors > 0) {
        remarks.push_back(std::to_string(comparison.singular_vectors) +
                          (comparison.singular_vectors > 1 ? " vectors have" : " vector has") +
                          " no Eₙ: their covariance is singular, so that a part of the difference has no uncertainty.");
    }
}

}  // namespace

std::vector<std::string> laboratory_remarks(const jobs::ComparisonJob& job, const gum::LaboratoryComparison& comparison,
                                            const reports::Comparison& record) {
    std::vector<std::string> remarks;
    add_remarks_on_value({job, comparison, record}, remarks);
    add_remarks_on_correlation(job, comparison, remarks);
    add_remarks_on_sources(comparison, remarks);
    add_remarks_on_uncertainties(comparison, remarks);
    add_remarks_on_what_is_left_out(comparison, remarks);
    return remarks;
}

std::vector<gum::Diagnostic> laboratory_diagnostics(const jobs::ComparisonJob& job,
                                                    const gum::LaboratoryComparison& comparison,
                                                    const reports::Comparison& record) {
    const Evaluated evaluated{job, comparison, record};
    ItemMessages messages(evaluated);
    add_consistency(messages);
    add_assigned_value(messages);
    add_checks_of_items(messages);
    add_turns(messages);
    return messages.take();
}

}  // namespace gumcert::reports
