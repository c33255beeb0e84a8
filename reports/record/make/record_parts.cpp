#include "reports/record/make/record_parts.h"

#include <gumcert_build_info.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "certificate/statement_of_uncertainty.h"
#include "encoding/sha2.h"
#include "gum/quantity/unit_table.h"
#include "gum/rounding.h"
#include "json/canonical_json.h"
#include "text/numbers.h"

namespace gumcert::reports {

reports::EvaluationRecord record_head(std::string_view kind, const JobHead& job, const nlohmann::json& options,
                                      const std::vector<reports::InputFile>& files) {
    reports::EvaluationRecord record;
    record.software.version = k_version;
    record.software.commit = k_commit;
    record.kind = kind;
    record.title = job.title.in("en");
    if (!job.title.by_language.empty()) {
        record.title_by_language = job.title;
    }
    record.coverage_probability = {job.coverage_probability,
                                   certificate::printed_coverage_probability(job.coverage_probability) + " %"};
    record.job_json = gumcert::json::canonical_json(job.document);
    record.job_files = files;
    // The sizes of units that the numbers were found with.
    static const std::string unit_table = encoding::sha256(gum::unit_table_text());
    nlohmann::json in_force = options;
    in_force["unit_table_sha256"] = unit_table;
    record.options_json = gumcert::json::canonical_json(in_force);
    record.diagnostics = job.warnings;
    record.diagnostics.insert(record.diagnostics.end(), job.notes.begin(), job.notes.end());
    return record;
}

Shown<double> shown_significant(double number, int digits) {
    return {number, gum::round_significant(number, digits)};
}

Shown<double> shown_plain(double number, int digits) {
    Shown<double> shown = shown_significant(number, digits);
    constexpr double k_least_plain = 1.0;
    constexpr double k_most_plain = 1e15;
    const double size = std::abs(number);
    if (size > k_least_plain && size < k_most_plain && shown.text.find('E') != std::string::npos) {
        shown.text = gum::round_to_quantum(number, 0);
    }
    return shown;
}

Shown<double> shown_to_quantum(double number, int decimals) {
    return {number, gum::round_to_quantum(number, decimals)};
}

Shown<double> shown_share(double share) {
    return {share, gum::percent(share)};
}

std::optional<double> finite_or_none(double value) {
    return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

nlohmann::json monte_carlo_json(const std::optional<gum::MonteCarloRequest>& asked) {
    if (!asked) {
        return nullptr;
    }
    nlohmann::json options{{"seed", asked->seed},
                           {"generator", "Philox 4x64-10"},
                           {"validate", asked->validate},
                           {"digits", asked->digits}};
    if (asked->trials) {
        options["trials"] = *asked->trials;
    } else {
        options["adaptive"] = {{"digits", asked->digits}, {"max_trials", asked->most_trials}};
    }
    return options;
}

reports::MonteCarloSummary monte_carlo_summary(const gum::MonteCarloOutput& from, const gum::MonteCarloRequest& asked,
                                               const TrialsDone& done, const gum::ToUnit& to_unit,
                                               const std::optional<gum::Validation>& compared) {
    const auto ends = [&](const gum::CoverageInterval& interval) -> std::array<double, 2> {
        return {to_unit.value(interval.low), to_unit.value(interval.high)};
    };
    const auto differences = [&](const gum::CoverageInterval& interval) -> std::array<double, 2> {
        return {to_unit.difference(interval.low), to_unit.difference(interval.high)};
    };
    reports::MonteCarloSummary summary;
    summary.trials = {static_cast<std::int64_t>(done.trials), std::to_string(done.trials)};
    summary.seed = static_cast<std::int64_t>(asked.seed);
    summary.mean.number = to_unit.value(from.mean);
    summary.u.number = to_unit.difference(from.standard_uncertainty);
    summary.symmetric.number = ends(from.symmetric);
    summary.shortest.number = ends(from.shortest);
    summary.numerical_error.mean = to_unit.difference(from.numerical_error.mean);
    summary.numerical_error.u = to_unit.difference(from.numerical_error.standard_uncertainty);
    summary.numerical_error.symmetric = differences(from.numerical_error.symmetric);
    summary.numerical_error.shortest = differences(from.numerical_error.shortest);
    summary.adaptive = !asked.trials;
    if (!from.histogram.counts.empty()) {
        summary.histogram_low = to_unit.value(from.histogram.low);
        summary.histogram_high = to_unit.value(from.histogram.high);
        summary.histogram.assign(from.histogram.counts.begin(), from.histogram.counts.end());
    }
    summary.stabilised = done.stabilised;
    // As many digits as the numerical error allows, and not more than four of u.
    const auto shown = [&](double value, double error) {
        const double quantum = std::max(error, 1e-4 * *summary.u.number);
        return quantum > 0.0 ? gum::round_to_uncertainty(value, quantum, 1).value
                             : text::shortest(value == 0.0 ? 0.0 : value);
    };
    summary.mean.text = shown(*summary.mean.number, summary.numerical_error.mean);
    summary.u.text = shown(*summary.u.number, summary.numerical_error.u);
    for (std::size_t i = 0; i < 2; ++i) {
        summary.symmetric.text[i] = shown(summary.symmetric.number[i], summary.numerical_error.symmetric[i]);
        summary.shortest.text[i] = shown(summary.shortest.number[i], summary.numerical_error.shortest[i]);
    }
    if (compared) {
        reports::GufValidation validation;
        validation.delta = shown_significant(compared->tolerance, 2);
        validation.d_low = shown_significant(compared->distance_low, 2);
        validation.d_high = shown_significant(compared->distance_high, 2);
        validation.validated = compared->validated;
        validation.precise_enough = compared->precise_enough;
        validation.interval = "symmetric";
        validation.digits = asked.digits;
        summary.validation = validation;
    }
    return summary;
}

const char* type_letter(gum::Evaluation evaluation) {
    return evaluation == gum::Evaluation::type_a ? "A" : "B";
}

}  // namespace gumcert::reports
