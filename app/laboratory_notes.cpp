#include "app/laboratory_notes.h"

#include <algorithm>
#include <functional>
#include <set>

#include "app/comparison_print.h"
#include "app/laboratory_estimates.h"
#include "app/record_parts.h"
#include "gum/rounding.h"
#include "text/lists.h"
#include "text/numbers.h"

namespace gumcert::app {

namespace {

using reports::ComparisonItemEvaluation;
using reports::ComparisonPoint;

std::string place_of(const ComparisonItemEvaluation& item) {
    const std::string place = item.id.empty() ? "comparison" : "item \"" + item.id + "\"";
    return item.round.empty() ? place : place + ", round \"" + item.round + "\"";
}

constexpr std::size_t k_most_names_in_remark = 12;

/// A coverage probability: "95.45 %".
std::string in_percent(double probability) {
    return gum::round_significant(100.0 * probability, 4) + " %";
}

/// A message about those items that something holds for; nothing where it holds for none.
class ItemMessages {
public:
    explicit ItemMessages(const reports::Comparison& comparison) : comparison_(comparison) {}

    /// \param what  of the first of them; how many others there are is added
    void add(gum::Diagnostic message, const std::function<bool(const ComparisonItemEvaluation&)>& holds,
             const std::function<std::string(const ComparisonItemEvaluation&)>& what) {
        const ComparisonItemEvaluation* first = nullptr;
        std::size_t count = 0;
        for (const ComparisonItemEvaluation& item : comparison_.items) {
            if (holds(item)) {
                first = first == nullptr ? &item : first;
                ++count;
            }
        }
        if (first == nullptr) {
            return;
        }
        message.where = place_of(*first);
        message.what = what(*first);
        if (count > 1) {
            message.what += ", and " + std::to_string(count - 1) + (count > 2 ? " more like it" : " other like it") +
                            " among " + std::to_string(comparison_.items.size());
        }
        messages_.push_back(std::move(message));
    }

    [[nodiscard]] std::vector<gum::Diagnostic> take() { return std::move(messages_); }
    [[nodiscard]] const reports::Comparison& comparison() const { return comparison_; }

private:
    const reports::Comparison& comparison_;
    std::vector<gum::Diagnostic> messages_;
};

/// A number with the unit of differences behind it.
std::string with_unit(const std::string& number, const ComparisonItemEvaluation& item) {
    const std::string unit = gum::unit_for_people(item.difference_unit);
    return unit.empty() ? number : number + " " + unit;
}

bool inconsistent(const ComparisonItemEvaluation& item) {
    return item.consistency && !item.consistency->consistent;
}

std::string test_text(const ComparisonItemEvaluation& item) {
    const reports::ConsistencySummary& test = *item.consistency;
    return "the results are not consistent with their uncertainties: chi-square " + test.printed.chi_square + " on " +
           text::count_of(test.degrees_of_freedom, "degree") + " of freedom, p = " + test.printed.p_value +
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
        [](const ComparisonItemEvaluation& item) { return item.method == "weighted_mean" && inconsistent(item); },
        test_text);
    gum::Diagnostic note = warning;
    note.rule = "the assigned value does not rest on this consistency";
    note.action =
        "At least one value or one uncertainty is wrong, and small scores clear nobody: look for the cause, beginning "
        "with the results of large scores.";
    messages.add(
        note, [](const ComparisonItemEvaluation& item) { return item.method != "weighted_mean" && inconsistent(item); },
        test_text);
}

void add_checks_of_items(ItemMessages& messages) {
    messages.add(
        {.code = "GC-COMPARE-0122",
         .where = "",
         .what = "",
         .rule = "s_s must not be larger (ISO 13528:2022, annex B)",
         .action = "Its standard uncertainty is in u(X). Where that makes the scores meaningless, take items that "
                   "are more alike.",
         .severity = gum::Severity::warning},
        [](const ComparisonItemEvaluation& item) { return item.homogeneity && !item.homogeneity->sufficient_expanded; },
        [](const ComparisonItemEvaluation& item) {
            return "the items differ by s_s = " + with_unit(item.homogeneity->printed.s_s, item) +
                   ", the expanded limit is " + with_unit(item.homogeneity->printed.expanded_limit, item);
        });
    messages.add(
        {.code = "GC-COMPARE-0123",
         .where = "",
         .what = "",
         .rule = "the items must not change by more (ISO 13528:2022, annex B)",
         .action = "A drift of this size, in either direction, is in u(X) with difference/√3. Where it is known "
                   "which way it went, correct for it.",
         .severity = gum::Severity::warning},
        [](const ComparisonItemEvaluation& item) { return item.stability && !item.stability->stable_expanded; },
        [](const ComparisonItemEvaluation& item) {
            return "the items changed by " + with_unit(item.stability->printed.difference, item) +
                   ", the expanded limit is " + with_unit(item.stability->printed.expanded_limit, item);
        });
}

bool comparison_has_inconclusive(const reports::Comparison& comparison, const ComparisonItemEvaluation& item) {
    return std::any_of(comparison.points.begin(), comparison.points.end(), [&](const ComparisonPoint& point) {
        return point.item == item.id && point.round == item.round && point.signal == "inconclusive";
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
        [&](const ComparisonItemEvaluation& item) {
            return item.u && comparison_has_inconclusive(messages.comparison(), item);
        },
        [](const ComparisonItemEvaluation& item) {
            return "the assigned value, " + item.printed.value +
                   (item.printed.U.empty() ? "" : " with U = " + with_unit(item.printed.U, item)) +
                   ", is too uncertain to clear some of the results";
        });
    messages.add(
        {.code = "GC-COMPARE-0121",
         .where = "",
         .what = "",
         .rule = "z is used up to 0.3, z' above (ISO 13528:2022, clause 9)",
         .action = "",
         .severity = gum::Severity::note},
        [](const ComparisonItemEvaluation& item) { return !item.criterion_met.value_or(true); },
        [](const ComparisonItemEvaluation& item) {
            return "u(X) is " + item.printed.criterion + " sigma_pt: z' decides";
        });
    messages.add(
        {.code = "GC-COMPARE-0124",
         .where = "",
         .what = "",
         .rule = "|difference| must not be larger than 2 u of the difference",
         .action = "Find out why before scores are issued: a bias that the laboratories share, or the "
                   "reference value.",
         .severity = gum::Severity::warning},
        [](const ComparisonItemEvaluation& item) { return item.consensus && !item.consensus->consistent; },
        [](const ComparisonItemEvaluation& item) {
            return "the consensus differs from the independent reference value by " +
                   with_unit(item.consensus->printed.difference, item) + ", " + item.consensus->printed.ratio +
                   " times its standard uncertainty";
        });
    messages.add(
        {.code = "GC-COMPARE-0126",
         .where = "",
         .what = "",
         .rule = "an uncertainty of the assigned value is needed for E_n, zeta and z'",
         .action = "Ask for results with more digits, or give an assigned value.",
         .severity = gum::Severity::warning},
        [](const ComparisonItemEvaluation& item) { return !item.u; },
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
        [](const ComparisonItemEvaluation& item) {
            return std::any_of(item.weights.begin(), item.weights.end(),
                               [](const reports::ResultWeight& weight) { return weight.weight < 0.0; });
        },
        [](const ComparisonItemEvaluation& item) {
            const auto weight = std::min_element(item.weights.begin(), item.weights.end(),
                                                 [](const auto& a, const auto& b) { return a.weight < b.weight; });
            return "participant \"" + weight->participant + "\" has the negative weight " + weight->printed;
        });
}

bool any_item(const reports::Comparison& comparison,
              const std::function<bool(const ComparisonItemEvaluation&)>& holds) {
    return std::any_of(comparison.items.begin(), comparison.items.end(), holds);
}

std::size_t count_points(const reports::Comparison& comparison,
                         const std::function<bool(const ComparisonPoint&)>& holds) {
    return static_cast<std::size_t>(std::count_if(comparison.points.begin(), comparison.points.end(), holds));
}

bool is_robust(const ComparisonItemEvaluation& item) {
    return item.method == "median" || item.method == "algorithm_a" || item.method == "q_hampel";
}

/// What the test of all results said before some of them were left out.
std::string subset_remark(const EvaluatedItem& item, const ComparisonItemEvaluation& evaluation) {
    const gum::ConsistencyTest all =
        gum::consistency_test(item.data->at(item.data->contributing), item.data->item->assigned_value.alpha);
    std::string remark =
        "All " + std::to_string(item.data->contributing.size()) + " results together are not consistent: chi-square " +
        gum::round_significant(all.chi_square, 4) + " on " +
        text::count_of(static_cast<std::int64_t>(all.degrees_of_freedom), "degree") +
        " of freedom, p = " + printed_probability(all.p_value) + ". The largest consistent subset leaves out ";
    remark += text::listed(evaluation.not_consistent) +
              ". Being left out says that a result does not fit the others, not that it is wrong.";
    if (!item.assigned.subset_unique) {
        remark += " Another subset of the same size fits as well: the choice between them is arbitrary.";
    }
    return remark;
}

/// What U(X) covers, and what U of the results mean in E_n.
void add_remarks_on_coverage(const engine::ComparisonJob& job, const reports::Comparison& comparison,
                             std::vector<std::string>& remarks) {
    if (any_item(comparison, [](const ComparisonItemEvaluation& item) { return item.U_rests_on == "scatter"; })) {
        remarks.emplace_back(
            "U(X) comes from the scatter of the results, with the t-distribution for their number: it covers also "
            "where "
            "laboratories differ by more than they state.");
    }
    if (count_points(comparison, [](const ComparisonPoint& point) { return point.u_others.has_value(); }) > 0) {
        remarks.emplace_back(
            "In En of a laboratory the uncertainty of the assigned value is what the scatter of all other results "
            "says: "
            "a result that lies far away does not widen the limit that it is held against.");
    }
    for (const ComparisonItemEvaluation& item : comparison.items) {
        if (item.coverage_with_scatter) {
            remarks.emplace_back(
                "A U(X) that comes from the stated uncertainties alone covers what it claims only where these explain "
                "the whole scatter of the results. If the laboratories differed by a further standard deviation as "
                "large "
                "as the median of their u, U(X) would cover " +
                item.printed.coverage_with_scatter + " of all cases in place of " +
                in_percent(job.coverage_probability) +
                (comparison.items.size() > 1 ? " (" + place_of(item) + ")." : "."));
            break;
        }
    }
    if (any_item(comparison, [](const ComparisonItemEvaluation& item) {
            return item.U_rests_on == "uncertainties" && item.nu && !item.weights.empty();
        })) {
        remarks.emplace_back(
            "Weights that come from uncertainties with few degrees of freedom are uncertain themselves: U(X) of a "
            "weighted mean then covers less than it claims.");
    }
    const bool by_default = std::any_of(job.items.begin(), job.items.end(), [](const engine::ComparisonItem& item) {
        return item.assigned_value.by_default;
    });
    if (by_default) {
        remarks.emplace_back("The job names no way to the assigned value; the default was taken.");
    }
    std::vector<std::string> converted;
    for (const ComparisonPoint& point : comparison.points) {
        if (point.U_of_scores && std::find(converted.begin(), converted.end(), point.participant) == converted.end()) {
            converted.push_back(point.participant);
        }
    }
    if (!converted.empty()) {
        remarks.push_back("The coverage factors of " + text::listed(converted, k_most_names_in_remark) +
                          " are not those of about 95 %: En takes U = k u with the factor for " +
                          in_percent(comparison.score_probability) +
                          " and the stated degrees of freedom in place of the stated U.");
    }
    if (comparison.score_probability != job.coverage_probability) {
        remarks.push_back("En is defined for about 95 %: it takes expanded uncertainties for " +
                          in_percent(comparison.score_probability) + ", whatever the comparison states.");
    }
}

void add_remarks_on_value(const engine::ComparisonJob& job, const reports::Comparison& comparison,
                          const std::vector<EvaluatedItem>& items, std::vector<std::string>& remarks) {
    constexpr std::int64_t k_few_for_robust = 12;
    constexpr std::size_t k_most_subset_remarks = 10;
    if (std::any_of(items.begin(), items.end(),
                    [](const EvaluatedItem& item) { return !item.assigned.correlation_known; })) {
        remarks.emplace_back(
            "A robust assigned value is not linear in the results: its covariance with a result that it is made of is "
            "taken as that of their mean, which is exact for normal results of equal uncertainty.");
    }
    add_remarks_on_coverage(job, comparison, remarks);
    if (any_item(comparison, [](const ComparisonItemEvaluation& item) {
            return is_robust(item) && item.contributing < k_few_for_robust;
        })) {
        remarks.emplace_back(
            "Fewer than 12 results: the scale of a robust assigned value is rough, and its coverage factor large for "
            "it.");
    }
    std::size_t subsets = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (!items[i].assigned.not_consistent.empty() && subsets++ < k_most_subset_remarks) {
            const std::string prefix = items.size() > 1 ? place_of(comparison.items[i]) + ": " : "";
            remarks.push_back(prefix + subset_remark(items[i], comparison.items[i]));
        }
    }
    if (any_item(comparison, [](const ComparisonItemEvaluation& item) { return item.homogeneity.has_value(); })) {
        remarks.emplace_back(
            "The standard deviation between items, s_s, is in u(X): the item of a laboratory need not be the mean "
            "one.");
    }
}

void add_remarks_on_correlation(const engine::ComparisonJob& job, const reports::Comparison& comparison,
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
    if (count_points(comparison, [](const ComparisonPoint& point) { return point.En_worst.has_value(); }) > 0) {
        remarks.emplace_back(
            "Laboratories of one group may share effects, and the job states no correlation for the group. En is given "
            "for none, and beside it for the worst that is plausible: that the smaller uncertainty is shared whole.");
    }
    if (comparison.items.size() > 1) {
        remarks.emplace_back(
            "Results of one laboratory for several items or rounds share its standards and its set-up: they are not so "
            "many independent proofs, and no probability is given for them together.");
    }
}

/// What was found between the assigned value and the results, and what the budgets do not tell.
void add_remarks_on_sources(const std::vector<EvaluatedItem>& items, std::vector<std::string>& remarks) {
    std::set<std::string> ambiguous;
    bool shared_with_value = false;
    for (const EvaluatedItem& item : items) {
        ambiguous.insert(item.data->ambiguous_sources.begin(), item.data->ambiguous_sources.end());
        ambiguous.insert(item.assigned.ambiguous_sources.begin(), item.assigned.ambiguous_sources.end());
        const bool given = item.data->item->assigned_value.method == engine::AssignedValueMethod::given;
        shared_with_value = shared_with_value || (given && !item.assigned.covariance.isZero(0.0));
    }
    if (shared_with_value) {
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

void add_remarks_on_uncertainties(const reports::Comparison& comparison, std::vector<std::string>& remarks) {
    constexpr double k_suspicious_ratio = 2.0;
    const std::size_t large = count_points(comparison, [](const ComparisonPoint& point) {
        return point.U_over_median.value_or(0.0) > k_suspicious_ratio ||
               point.U_over_CMC.value_or(0.0) > k_suspicious_ratio;
    });
    if (large > 0) {
        remarks.push_back(
            std::to_string(large) + (large > 1 ? " results state" : " result states") +
            " more than twice the U of the others or of the laboratory's own capability. |En| at or below 1 "
            "says little then: an uncertainty that is stated too large always passes.");
    }
    const std::size_t small =
        count_points(comparison, [](const ComparisonPoint& point) { return point.realism == "small"; });
    if (small > 0) {
        remarks.push_back(std::to_string(small) + (small > 1 ? " results state" : " result states") +
                          " a standard uncertainty below that of the assigned value.");
    }
    const std::size_t inconclusive =
        count_points(comparison, [](const ComparisonPoint& point) { return point.signal == "inconclusive"; });
    if (inconclusive > 0) {
        remarks.push_back("The assigned value is less certain than " + std::to_string(inconclusive) +
                          (inconclusive > 1 ? " results claim to be: small scores clear none of them."
                                            : " result claims to be: a small score does not clear it."));
    }
    if (count_points(comparison, [](const ComparisonPoint& point) { return point.En_audited.has_value(); }) > 0) {
        remarks.emplace_back(
            "En with findings corrected takes the corrected uncertainty of the laboratory, and of the reference "
            "laboratory; the value assigned from other results stays as it is.");
    }
    const std::size_t without_score =
        count_points(comparison, [](const ComparisonPoint& point) { return point.U_D && !point.En; });
    if (without_score > 0) {
        remarks.push_back(std::to_string(without_score) + (without_score > 1 ? " results have" : " result has") +
                          " no En and no zeta: the uncertainty of the difference from the assigned value comes out as "
                          "0, and nothing can be divided by it.");
    }
}

void add_remarks_on_what_is_left_out(const reports::Comparison& comparison, const LeftOut& left_out,
                                     std::vector<std::string>& remarks) {
    if (left_out.pairs) {
        remarks.push_back("Bilateral degrees of equivalence are left out: more than " +
                          std::to_string(k_most_pairs_in_record) + " pairs in all items together.");
    } else if (any_item(comparison, [](const ComparisonItemEvaluation& item) {
                   return item.results > static_cast<std::int64_t>(k_most_laboratories_in_pairs) && item.pairs.empty();
               })) {
        remarks.emplace_back("Bilateral degrees of equivalence are listed for up to 40 laboratories.");
    }
    if (left_out.vectors > 0) {
        remarks.push_back(std::to_string(left_out.vectors) + (left_out.vectors > 1 ? " vectors have" : " vector has") +
                          " no En: their covariance is singular, so that a part of the difference has no uncertainty.");
    }
}

}  // namespace

std::vector<std::string> laboratory_remarks(const engine::ComparisonJob& job, const reports::Comparison& comparison,
                                            const std::vector<EvaluatedItem>& items, const LeftOut& left_out) {
    std::vector<std::string> remarks;
    add_remarks_on_value(job, comparison, items, remarks);
    add_remarks_on_correlation(job, comparison, remarks);
    add_remarks_on_sources(items, remarks);
    add_remarks_on_uncertainties(comparison, remarks);
    add_remarks_on_what_is_left_out(comparison, left_out, remarks);
    return remarks;
}

std::vector<gum::Diagnostic> laboratory_diagnostics(const reports::Comparison& comparison) {
    ItemMessages messages(comparison);
    add_consistency(messages);
    add_assigned_value(messages);
    add_checks_of_items(messages);
    return messages.take();
}

}  // namespace gumcert::app
