// A proficiency test of two items: a solution whose assigned value is the robust mean of the laboratories (ISO 13528:2022,
// E.1), scored by z or z', and a gauge block that a reference laboratory measured, scored by E_n.
#include <cstdio>
#include <string>
#include <vector>

#include "gum/comparison/laboratory_comparison.h"
#include "gum/comparison/scores.h"
#include "gum/quantity/diagnostic.h"

using namespace gumcert::gum;

namespace {

const char* text_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::none:
            return "no signal";
        case Verdict::warning:
            return "warning";
        case Verdict::action:
            return "action";
        case Verdict::inconclusive:
            return "inconclusive: the assigned value is too uncertain";
        case Verdict::no_score:
            break;
    }
    return "reference";
}

}  // namespace

int main() try {
    ComparisonScheme scheme;
    ComparisonItem& solution = scheme.items.emplace_back();
    solution.id = "solution";
    solution.unit = Unit::parse("mg/kg");
    solution.assigned_value.method = AssignedValueMethod::algorithm_a;
    solution.sigma_pt.emplace().value = 5.0;
    ComparisonItem& block = scheme.items.emplace_back();
    block.id = "block";
    block.unit = Unit::parse("nm");  // deviations from the nominal length
    block.assigned_value.method = AssignedValueMethod::reference;
    block.assigned_value.participant = "L1";

    const std::vector<double> solutions{12, 19, 20, 23, 23, 25, 25, 26, 28, 28, 28, 29, 30, 30, 31, 32, 32, 45};
    const std::vector<double> blocks{12, 25, 61, -8};  // of the first laboratories
    const std::vector<double> U{16, 30, 32, 48};       // k = 2
    std::vector<ParticipantResult> results;
    for (std::size_t i = 0; i < solutions.size(); ++i) {
        scheme.participants.push_back({.id = "L" + std::to_string(i + 1), .name = "", .group = "", .cmc_U = {}});
        ParticipantResult& of_solution = results.emplace_back();
        of_solution.participant = i;
        of_solution.value = solutions[i];
        if (i < blocks.size()) {
            ParticipantResult& of_block = results.emplace_back();
            of_block.participant = i;
            of_block.item = 1;
            of_block.value = blocks[i];
            of_block.uncertainty = stated_expanded(U[i], 2.0);
        }
    }

    const LaboratoryComparison comparison = evaluate_laboratories(scheme, results);
    for (const ItemWithoutResult& item : comparison.without_result) {
        std::fprintf(stderr, "%s\n", message(item.because.front()).c_str());
    }
    for (const ItemResult& item : comparison.items) {
        const ComparisonItem& stated = scheme.items[item.item];
        std::printf("%s: assigned value %.2f, U = %.2f %s (k = %.2f)\n", stated.id.c_str(), item.value,
                    item.U.value_or(0.0), stated.unit.text().c_str(), item.k.value_or(0.0));
    }
    for (const ScoredResult& score : comparison.results) {
        std::printf("%-8s %-3s", scheme.items[score.item].id.c_str(),
                    scheme.participants[score.participant].id.c_str());
        if (score.z_prime) {
            std::printf("  z = %5.2f  z' = %5.2f", *score.z, *score.z_prime);
        }
        if (score.en) {
            std::printf("  E_n = %5.2f", *score.en);
        }
        std::printf("  %s\n", text_of(score.verdict));
    }

    // One pair of values by itself: L2 against L1, as above, and where half of what is uncertain is common to both.
    const ComparedValue laboratory{.value = 25.0, .standard_uncertainty = 15.0, .expanded_uncertainty = 30.0};
    const ComparedValue reference{.value = 12.0, .standard_uncertainty = 8.0, .expanded_uncertainty = 16.0};
    for (const double correlation : {0.0, 0.5}) {
        const ComparisonScore pair = score(laboratory, reference, correlation);
        std::printf("r = %.1f: D = %.0f nm, U(D) = %.0f nm, E_n = %.2f, zeta = %.2f\n", correlation, pair.difference,
                    pair.U_difference, pair.en, pair.zeta);
    }
    return comparison.without_result.empty() ? 0 : 1;
} catch (const DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
