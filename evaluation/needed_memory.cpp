#include "evaluation/needed_memory.h"

#include "text/numbers.h"

namespace gumcert::evaluation {

std::optional<gum::Diagnostic> needed_memory(const ReadJob& job, std::uint64_t most) {
    constexpr double k_told = 1e9;  // [byte]
    constexpr double k_megabyte = 1e6;
    const bool is_too_much = most > 0 && job.memory > static_cast<double>(most);
    if (!is_too_much && job.memory < k_told) {
        return std::nullopt;
    }
    return gum::Diagnostic{
        .code = "GC-STORE-0026",
        .where = job.names.front(),
        .what = "its evaluation takes about " + text::fixed(job.memory / k_megabyte, 0) + " MB of memory",
        .rule = "it grows as the number of results times that of inputs, or as the square of the angles",
        .action = is_too_much ? "split the job, or give it more by --memory-limit"
                              : "split the job where the machine has less",
        .severity = is_too_much ? gum::Severity::error : gum::Severity::note};
}

}  // namespace gumcert::evaluation
