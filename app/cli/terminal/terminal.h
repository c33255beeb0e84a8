#pragma once

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"
#include "system/end_of_memory.h"

namespace gumcert::cli {

enum ExitCode : int {
    done = 0,
    negative_answer = 1,
    usage = 2,
    input_refused = 3,
    no_result = 4,
    storage_trouble = 5,
    defect = 70,
};

struct CommonOptions {
    bool quiet = false;
    bool json_messages = false;
    int threads = 0;                                 // 0: as many as the machine has
    std::optional<std::uint64_t> memory_limit = {};  // [byte], 0: none
    std::optional<std::uint64_t> time_limit = {};    // [s], 0: none
    std::string refusal_log = {};                    // "": none
    std::string command = {};                        // "run", for the log
};

/// A terminal that is gone or full must not change the exit code.
template <class... Arguments>
void print_to_stderr(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text = fmt::format(format, std::forward<Arguments>(arguments)...);
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Words for people. Whether all of them arrived, when_all_is_told() finds out at the end.
template <class... Arguments>
void print_to_stdout(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text = fmt::format(format, std::forward<Arguments>(arguments)...);
    system::require_memory();
    (void)std::fwrite(text.data(), 1, text.size(), stdout);
}

/// One line on stderr: "where — what — rule — action [code]", or JSON.
void print_message(const gum::Diagnostic& diagnostic, const CommonOptions& common);

/// Adds a line to the log of refusals, where one is asked for. A log that cannot be written is told (GC-STORE-0025), and
/// changes no exit code.
void log_refusal(const gum::Diagnostic& why, const CommonOptions& common);

/// Several of them; notes only where they are wanted.
void print_messages(std::span<const gum::Diagnostic> diagnostics, const CommonOptions& common);

/// The messages that a record holds.
void report_diagnostics(const reports::EvaluationRecord& record, const CommonOptions& common);

/// The findings of the gates before issue, one line each; informations only where they are wanted.
void report_findings(const reports::EvaluationRecord& record, const CommonOptions& common);

/// What is wrong with the command line: GC-USAGE-0001. Written here, for the program that writes the manual reads a command
/// line, too, and has nothing else of the terminal.
[[nodiscard]] inline gum::Diagnostic usage_problem(const std::string& where, const std::string& what,
                                                   const std::string& rule, const std::string& action) {
    return {"GC-USAGE-0001", where, what, rule, action, gum::Severity::error};
}

/// \throws gum::UsageError  GC-USAGE-0001
[[noreturn]] inline void refuse_usage(const std::string& where, const std::string& what, const std::string& rule,
                                      const std::string& action) {
    throw gum::UsageError(usage_problem(where, what, rule, action));
}

/// \throws gum::StorageError  if not all of it arrives
void write_to_stdout(const std::string& bytes);

/// What the program ends with: where a part of the standard output did not arrive, nobody knows what was said (GC-STORE-0003).
/// \param code  of the command
[[nodiscard]] ExitCode when_all_is_told(ExitCode code, const CommonOptions& common);

/// Says that memory has run out, and takes none for it.
/// \return storage_trouble
ExitCode tell_of_no_memory(bool json_messages);

/// Does some work; a failure is printed and becomes the exit code.
[[nodiscard]] ExitCode explained(const CommonOptions& common, const std::function<ExitCode()>& work);

/// Progress on a terminal, from the first second on.
class ProgressLine {
public:
    explicit ProgressLine(bool wanted);
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void operator()(const std::string& text);
    void clear();

private:
    bool wanted_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace gumcert::cli
