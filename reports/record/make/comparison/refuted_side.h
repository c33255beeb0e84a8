#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/certified_results.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::gum {
struct RotaryTableResult;
struct CircleClosureResult;
}  // namespace gumcert::gum
namespace gumcert::jobs {
struct RotaryTableJob;
struct CircleClosureJob;
}  // namespace gumcert::jobs

namespace gumcert::reports {

/// What the evaluation of a compared job says of itself.
struct JudgedJob {
    std::vector<gum::Diagnostic> diagnostics;    ///< of its record
    std::vector<certificate::Finding> findings;  ///< on its adjustment or its closure, G01 … and C01 …
};

/// Who makes the record of a compared job and finds what speaks against it. The makers of these records use this layer
/// themselves, so they are handed over; a comparison with a job is not evaluated without them.
struct JobJudges {
    std::function<JudgedJob(const jobs::RotaryTableJob&, const gum::RotaryTableResult&)> rotary_table;
    std::function<JudgedJob(const jobs::CircleClosureJob&, const gum::CircleClosureResult&)> circle_closure;
};

inline constexpr std::string_view k_side_refuted = "side_refuted";  ///< the verdict

/// The findings that refute: those that are major or critical. What its own evaluation refutes agrees with nothing, and
/// a difference from it tells nothing of the other side.
[[nodiscard]] std::vector<RefutedSide> refuted_by(const std::vector<certificate::Finding>& findings,
                                                  const std::string& side, const std::string& file);

/// Puts what refutes a side into a comparison, and takes back every verdict that says agreement, or that only single
/// points object: the verdict is "side_refuted". A disagreement stays one.
void withhold_agreement(std::vector<RefutedSide> refuted, Comparison& comparison);

}  // namespace gumcert::reports
