#include "app/cli/summary.h"

#include <fmt/core.h>

#include <cstddef>
#include <string>

namespace gumcert::cli {

namespace {

/// "k = 2.92, p = 99 %": how the expanded uncertainty was found.
std::string coverage_text(const reports::Result& result) {
    std::string text = result.k ? fmt::format("k = {:.2f}, ", *result.k) : "";
    return text + fmt::format("p = {:.4g} %", 100.0 * result.coverage_probability);
}

/// Results of a budget, one a line; of a long table of points the first ones.
void print_results(const reports::EvaluationRecord& record) {
    constexpr std::size_t k_most_lines = 30;
    for (std::size_t i = 0; i < record.results.size() && i < k_most_lines; ++i) {
        const reports::Result& result = record.results[i];
        const std::string unit = result.printed.unit.empty() ? "" : " " + result.printed.unit;
        if (result.U) {
            fmt::print("  {} = {} ± {}{}", result.name, result.printed.value, result.printed.U, unit);
            fmt::print("   ({})\n", coverage_text(result));
        } else {
            fmt::print("  {} = {}{}   no expanded uncertainty can be stated\n", result.name, result.printed.value,
                       unit);
        }
        if (result.monte_carlo) {
            const reports::MonteCarloSummary& monte_carlo = *result.monte_carlo;
            fmt::print("      Monte Carlo, {} trials: u = {}, interval {} to {}", monte_carlo.printed.trials,
                       monte_carlo.printed.u, monte_carlo.printed.symmetric[0], monte_carlo.printed.symmetric[1]);
            if (monte_carlo.validation) {
                fmt::print("{}", !monte_carlo.validation->precise_enough ? "; too few trials to validate"
                                 : monte_carlo.validation->validated     ? "; law of propagation validated"
                                                                         : "; law of propagation NOT validated");
            }
            fmt::print("\n");
        }
    }
    if (record.results.size() > k_most_lines) {
        fmt::print("  … and {} more, all of them in the record\n", record.results.size() - k_most_lines);
    }
}

}  // namespace

void print_summary(const reports::EvaluationRecord& record) {
    if (!record.title.empty()) {
        fmt::print("{}\n\n", record.title);
    }
    if (record.rotary) {
        const reports::RotaryTable& rotary = *record.rotary;
        fmt::print("Set-up of the fixture (value ± U, p = {}):\n", record.printed_coverage);
        for (const reports::Result& result : record.results) {
            fmt::print("  {:<4} {:>9} ± {} {}   {}\n", result.name, result.printed.value, result.printed.U,
                       result.printed.unit, result.description);
        }
        fmt::print("\nError motions over {} angles, datum {}:\n", rotary.errors.size(),
                   rotary.datum == "home" ? "home" : "axis average line");
        for (const reports::RangeRow& range : rotary.ranges) {
            fmt::print("  {}  range {:>7} ± {} {}\n", range.name, range.printed.value, range.printed.U,
                       range.printed.unit);
        }
        fmt::print("\nAdjustment: {} observations, {} parameters, chi-square {} on {} degrees of freedom, p = {}\n",
                   rotary.adjustment.observations, rotary.adjustment.parameters, rotary.adjustment.printed.chi_square,
                   rotary.adjustment.degrees_of_freedom, rotary.adjustment.printed.p_value);
        std::size_t removed = 0;
        for (const reports::FlaggedDistance& distance : rotary.flagged) {
            removed += distance.removed ? 1 : 0;
        }
        fmt::print("Outlying distances: {} found, {} left out (listed in the certificate)\n", rotary.flagged.size(),
                   removed);
        if (rotary.monte_carlo) {
            fmt::print("\nMonte Carlo: {}\n", rotary.monte_carlo->statement);
        }
    }
    if (record.kind == "budget") {
        print_results(record);
    }
    if (record.comparison) {
        fmt::print("\nComparison with {}:\n", record.comparison->reference_name);
        for (const reports::ComparisonSummary& row : record.comparison->summary) {
            fmt::print("  {:<3}  mean |En| {}   max |En| {}   above 1: {} of {}\n", row.direction,
                       row.printed.mean_abs_En, row.printed.max_abs_En, row.count_above_1, row.points);
        }
    }
}

}  // namespace gumcert::cli
