#include "gum/comparison/laboratory_comparison.h"

#include <optional>
#include <string>
#include <utility>

#include "gum/argument_check.h"
#include "gum/comparison/agreement.h"
#include "gum/comparison/assigned_value.h"
#include "gum/comparison/reference_estimates.h"
#include "gum/comparison/scores.h"

namespace gumcert::gum {

namespace {

constexpr std::size_t k_items_between_messages = 50;

void require_positions(const ComparisonScheme& scheme, const std::vector<ParticipantResult>& results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        const ParticipantResult& result = results[i];
        if (result.participant >= scheme.participants.size() || result.item >= scheme.items.size() ||
            result.round >= scheme.rounds.size()) {
            refuse("GC-COMPARE-0113", "result " + std::to_string(i + 1),
                   "participant " + std::to_string(result.participant) + ", item " + std::to_string(result.item) +
                       " and round " + std::to_string(result.round) + ", counted from 0",
                   "a result belongs to a participant, an item and a round of the scheme", "Correct the position.");
        }
    }
}

EvaluatedItem evaluated(const ComparisonScheme& scheme, LaboratoryData data, bool with_pairs,
                        std::vector<SharedSource>& shared) {
    EvaluatedItem item{.data = std::move(data), .assigned = {}, .result = {}, .scores = {}};
    relate_results(scheme, item.data, shared);
    item.assigned = assigned_value(scheme, item.data);
    item.result = item_result(scheme, item.data, item.assigned);
    item.scores = scored_results(scheme, item.data, item.assigned, item.result);
    if (with_pairs) {
        item.result.pairs = pair_equivalences(item.data, scheme.coverage_probability, item.result.u_of_item());
    }
    return item;
}

/// p of the test of all results that contribute.
double p_of_all(const ItemResult& item) {
    return item.consistency_of_all ? item.consistency_of_all->p_value : item.consistency->test.p_value;
}

/// Of many tests of right results some fail: which of them say no more than that.
void mark_chance(std::vector<EvaluatedItem>& items) {
    std::size_t tests = 0;
    std::size_t failed = 0;
    double alpha = 0.0;  // the mean: tests of different alpha fail as often, together, as so many of this one
    for (const EvaluatedItem& item : items) {
        if (item.result.consistency) {
            ++tests;
            failed += p_of_all(item.result) < item.result.consistency->alpha ? 1U : 0U;
            alpha += item.result.consistency->alpha;
        }
    }
    if (tests < 2 || failed == 0) {
        return;
    }
    alpha /= static_cast<double>(tests);
    if (failed > count_above_1_by_chance(tests, static_cast<double>(tests), 1.0 - alpha)) {
        return;
    }
    for (EvaluatedItem& item : items) {
        if (std::optional<ResultConsistency>& of = item.result.consistency) {
            const double p = p_of_all(item.result);
            of->by_chance = p < of->alpha && p >= chance_in_family(of->alpha, tests);
        }
    }
}

}  // namespace

LaboratoryComparison evaluate_laboratories(const ComparisonScheme& scheme,
                                           const std::vector<ParticipantResult>& results, const Progress& progress) {
    require_positions(scheme, results);
    std::vector<LaboratoryData> data = laboratory_data(scheme, results);
    if (data.empty()) {
        throw InputError(Diagnostic{.code = "GC-COMPARE-0112",
                                    .where = "comparison",
                                    .what = "no result",
                                    .rule = "results of at least two laboratories are compared",
                                    .action = "State the results of the participants."});
    }
    LaboratoryComparison comparison;
    comparison.score_probability = en_coverage_probability(scheme.coverage_probability);
    std::size_t pairs = 0;
    for (const LaboratoryData& of_item : data) {
        pairs += count_pairs(of_item);
    }
    comparison.pairs_left_out = pairs > k_most_pairs;
    std::vector<EvaluatedItem> items;
    for (LaboratoryData& of_item : data) {
        if (progress && items.size() % k_items_between_messages == 0 && data.size() > 1) {
            progress("item " + std::to_string(items.size() + 1) + " of " + std::to_string(data.size()));
        }
        ItemWithoutResult refused{.item = of_item.item_position, .round = of_item.round, .because = {}};
        try {
            items.push_back(
                evaluated(scheme, std::move(of_item), !comparison.pairs_left_out, comparison.shared_sources));
            continue;
        } catch (const InputError& error) {  // one item does not lose the others
            refused.because = error.diagnostics();
            refused.refused_input = true;
        } catch (const NoResultError& error) {
            refused.because = error.diagnostics();
        }
        comparison.without_result.push_back(std::move(refused));
    }
    mark_chance(items);
    comparison.summary = summary_of_scores(scheme, items);
    comparison.participants = participant_summaries(scheme, items);
    comparison.vectors = vector_scores(scheme, items, comparison.singular_vectors);
    comparison.youden = youden_diagrams(scheme, items);
    for (EvaluatedItem& item : items) {
        comparison.items.push_back(std::move(item.result));
        comparison.results.insert(comparison.results.end(), item.scores.begin(), item.scores.end());
    }
    return comparison;
}

}  // namespace gumcert::gum
