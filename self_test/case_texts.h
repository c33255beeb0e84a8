#pragma once

#include <string>

#include "gum/quantity/diagnostic.h"
#include "self_test/case_run.h"

namespace gumcert::self_test {

// What became of a case, in English. Texts of a case are shown as they may stand on a terminal.

/// "pass  gum-h1-end-gauge  JCGM 100:2008, H.1  12 of 12 values"
[[nodiscard]] std::string case_line(const CaseOutcome& outcome);

/// A line for each value, with what the source states, and for each that is not compared.
[[nodiscard]] std::string value_lines(const CaseOutcome& outcome);

/// What a case that fails is told as: GC-SELF-0003, with the first value that disagrees.
[[nodiscard]] gum::Diagnostic failure_of(const CaseOutcome& outcome);

}  // namespace gumcert::self_test
