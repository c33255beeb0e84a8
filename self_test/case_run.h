#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "self_test/reference_case.h"

namespace gumcert::self_test {

/// What became of an expected value.
struct ComparedValue {
    ExpectedValue expected = {};
    CaseValue computed = {};  ///< by this program; of several places the first that disagrees, else the first
    bool was_found = false;   ///< false: `computed` holds nothing
    std::optional<double> tolerance = {};  ///< in the unit of the value; none: equal, or the same text
    int digits_reached = 0;                ///< of expected.digits(); 0 where that is 0
    bool agrees = false;
    std::string because = {};  ///< why it does not agree; English
};

/// What became of a case.
struct CaseOutcome {
    ReferenceCase reference = {};            ///< with nothing but its id where it could not be read
    std::vector<ComparedValue> values = {};  ///< those that are compared, in the order of the case
    std::string refused = {};                ///< why the case as a whole is no success; "": it is not known to fail

    [[nodiscard]] std::size_t agreed() const;
    /// Every value agrees, and there is one.
    [[nodiscard]] bool passes() const;
};

/// Evaluates the jobs of a case with this program, and compares what its records hold with what the source states. A job
/// that is refused, and a value that is not there, are disagreements: nothing is thrown for them.
/// \param templates  as of evaluate_job()
[[nodiscard]] CaseOutcome run_case(const ReferenceCase& reference, const std::filesystem::path& templates);

/// The same of a file.
/// \throws gum::StorageError  GC-STORE-0001 if it cannot be read; what is in it is never a reason to throw
[[nodiscard]] CaseOutcome run_case_file(const std::filesystem::path& file, const std::filesystem::path& templates);

/// As people read it: "31.66", "yes", "0.10139(18)"; at most `digits` significant digits.
[[nodiscard]] std::string value_text(const CaseValue& value, int digits = 17);

}  // namespace gumcert::self_test
