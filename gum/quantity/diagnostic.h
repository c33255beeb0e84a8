#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace gumcert::gum {

enum class Severity { note, warning, error };

/// One message to a person, in the fixed form "where — what — rule — action".
///
/// `code` is stable across releases (`GC-INPUT-0012`); scripts may rely on it. `where` is a file with line and column
/// (`lengths.csv:17:5`), a file with a JSON pointer (`job.json#/fixture/coordinates`) or the name of a quantity.
struct Diagnostic {
    std::string code;
    std::string where;
    std::string what;    ///< what is wrong, with value and unit
    std::string rule;    ///< the rule that it breaks
    std::string action;  ///< what to do
    Severity severity = Severity::error;

    friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

/// "where — what — rule — action", on one line; parts that are empty are left out.
[[nodiscard]] std::string message(const Diagnostic& diagnostic);

/// Base of every failure that the product explains to its user.
class DiagnosedError : public std::runtime_error {
public:
    explicit DiagnosedError(std::vector<Diagnostic> diagnostics);
    explicit DiagnosedError(Diagnostic diagnostic) : DiagnosedError(std::vector{std::move(diagnostic)}) {}
    [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const noexcept { return diagnostics_; }

private:
    std::vector<Diagnostic> diagnostics_;
};

/// The command line is wrong (exit code 2).
class UsageError : public DiagnosedError {
    using DiagnosedError::DiagnosedError;
};

/// An input was refused (exit code 3). Carries every problem that was found, not only the first.
class InputError : public DiagnosedError {
    using DiagnosedError::DiagnosedError;
};

/// No result can be computed from accepted input: rank deficient, not converged, not finite (exit code 4).
class NoResultError : public DiagnosedError {
    using DiagnosedError::DiagnosedError;
};

/// A file, disk or store trouble (exit code 5).
class StorageError : public DiagnosedError {
    using DiagnosedError::DiagnosedError;
};

}  // namespace gumcert::gum
