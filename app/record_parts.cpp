#include "app/record_parts.h"

#include <gumcert_build_info.h>

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gum/rounding.h"

namespace gumcert::app {

reports::EvaluationRecord record_head(const std::string& kind, const JobHead& job, const nlohmann::json& options,
                                      const std::vector<reports::InputFile>& files) {
    reports::EvaluationRecord record;
    record.software.version = k_version;
    record.software.commit = k_commit;
    record.kind = kind;
    record.title = job.title;
    record.coverage_probability = job.coverage_probability;
    record.printed_coverage = gum::round_significant(100.0 * job.coverage_probability, 4) + " %";
    record.job_json = reports::canonical_json(job.document);
    record.job_files = files;
    record.options_json = reports::canonical_json(options);
    record.diagnostics = job.warnings;
    record.diagnostics.insert(record.diagnostics.end(), job.notes.begin(), job.notes.end());
    return record;
}

std::optional<double> finite_or_none(double value) {
    return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::string shortest(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

const char* type_letter(gum::Evaluation evaluation) {
    return evaluation == gum::Evaluation::type_a ? "A" : "B";
}

}  // namespace gumcert::app
