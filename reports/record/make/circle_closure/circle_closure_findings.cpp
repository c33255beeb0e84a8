#include "reports/record/make/circle_closure/circle_closure_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "reports/record/make/remark.h"

namespace gumcert::reports {

namespace {

using certificate::FindingSeverity;
using reports::CircleClosure;
using reports::ClosureResidualRow;
using reports::ClosureTestRow;
using reports::EvaluationRecord;

/// "F = 3.1 with 30 and 12 degrees of freedom, p-value 0.0002"
std::string figures_of(const ClosureTestRow& test) {
    return "F = " + test.statistic.text + " with " + test.nu.text + " and " +
           (test.nu_reference.number ? test.nu_reference.text : std::string("∞")) + " degrees of freedom, p-value " +
           test.p_value.text;
}

/// The reading with the largest residual for what its redundancy shows.
const ClosureResidualRow& largest_residual(const CircleClosure& closure) {
    const auto size = [](const ClosureResidualRow& row) {
        constexpr double k_least_redundancy = 1e-6;
        return row.redundancy > k_least_redundancy ? row.residual.number * row.residual.number / row.redundancy : 0.0;
    };
    return *std::max_element(closure.residuals.begin(), closure.residuals.end(),
                             [&](const auto& a, const auto& b) { return size(a) < size(b); });
}

gum::Diagnostic refuted(const ClosureTestRow& test) {
    return {.code = "GC-CLOSURE-0020",
            .where = "readings",
            .what = "the residuals refute the stated repeatability: " + figures_of(test),
            .rule = "readings of the stated repeatability scatter so much less than once in a thousand measurements",
            .action =
                "Look for what is not repeatable: the seating of the table, air, a drift. Leave \"use\": "
                "\"stated\" out, so that the uncertainty comes from the residuals.",
            .severity = gum::Severity::warning};
}

gum::Diagnostic misfit(const ClosureTestRow& test) {
    return {.code = "GC-CLOSURE-0021",
            .where = "readings",
            .what = "the readings of different positions contradict each other more than repetitions do: " +
                    figures_of(test),
            .rule =
                "two divided circles give every reading as a sum of their deviations and a zero; a misfit like "
                "this one happens less than once in a thousand measurements by chance",
            .action =
                "Check \"numbering\", the positions, and whether the artefact moved on the table; "
                "the uncertainty from the residuals holds it only as scatter.",
            .severity = gum::Severity::warning};
}

gum::Diagnostic outlier(const CircleClosure& closure, const ClosureTestRow& test) {
    const ClosureResidualRow& row = largest_residual(closure);
    return {.code = "GC-CLOSURE-0022",
            .where = "readings",
            .what = "the reading at step " + std::to_string(row.step) + " in position " + std::to_string(row.position) +
                    (row.repetition.empty() ? "" : ", repetition " + row.repetition) + ", " + row.reading.text + " " +
                    closure.printed_unit + ", is an outlier: its residual is " + row.residual.text + " " +
                    closure.printed_unit + ", p-value " + test.p_value.text,
            .rule =
                "the largest residual of so many readings is as large as this one less than once in a thousand "
                "measurements",
            .action = "Look for the cause. Leave the reading out of the file only for a cause that is on record.",
            .severity = gum::Severity::warning};
}

gum::Diagnostic not_closed(const ClosureTestRow& test) {
    return {
        .code = "GC-CLOSURE-0023",
        .where = "readings",
        .what =
            "the series do not close: the mean of the closing readings differs from that of the first "
            "readings: " +
            figures_of(test),
        .rule =
            "a full turn brings the table back: what differs by more than the scatter and the stated effects on the "
            "turn is a drift",
        .action = "Set \"drift\": \"linear\", or wait until the set-up has settled and measure again.",
        .severity = gum::Severity::warning};
}

gum::Diagnostic unknown_drift() {
    return {.code = "GC-CLOSURE-0024",
            .where = "effects",
            .what = "no closing reading was taken, and no effect acts on the turn: nothing is known of a drift",
            .rule = "a drift that all series have in common looks like deviations of the table",
            .action = "Read step 0 again after the full turn, or state the drift as an effect that acts on \"turn\".",
            .severity = gum::Severity::warning};
}

const ClosureTestRow* test_of(const CircleClosure& closure, std::string_view name) {
    const auto found = std::find_if(closure.tests.begin(), closure.tests.end(),
                                    [&](const ClosureTestRow& test) { return test.name == name; });
    return found == closure.tests.end() ? nullptr : &*found;
}

/// What a message is as a finding.
struct Grave {
    std::string_view code, id;
    FindingSeverity severity, accredited;
};
constexpr std::array<Grave, 5> k_findings{
    {{"GC-CLOSURE-0020", "C01", FindingSeverity::major, FindingSeverity::critical},
     {"GC-CLOSURE-0021", "C02", FindingSeverity::major, FindingSeverity::critical},
     {"GC-CLOSURE-0022", "C03", FindingSeverity::major, FindingSeverity::major},
     {"GC-CLOSURE-0023", "C04", FindingSeverity::major, FindingSeverity::critical},
     {"GC-CLOSURE-0024", "C05", FindingSeverity::minor, FindingSeverity::major}}};

}  // namespace

std::vector<gum::Diagnostic> circle_closure_remarks(const EvaluationRecord& record, bool states_drift) {
    std::vector<gum::Diagnostic> remarks;
    if (!record.circle_closure) {
        return remarks;
    }
    const CircleClosure& closure = *record.circle_closure;
    const auto failed = [&](std::string_view name) {
        const ClosureTestRow* const test = test_of(closure, name);
        return test != nullptr && !test->accepted ? test : nullptr;
    };
    if (const ClosureTestRow* const test = failed("stated")) {
        remarks.push_back(refuted(*test));
    }
    if (const ClosureTestRow* const test = failed("repetition")) {
        remarks.push_back(misfit(*test));
    }
    if (const ClosureTestRow* const test = failed("reading")) {
        remarks.push_back(outlier(closure, *test));
    }
    if (const ClosureTestRow* const test = failed("misclosure")) {
        remarks.push_back(not_closed(*test));
    }
    const bool closes = std::any_of(closure.residuals.begin(), closure.residuals.end(),
                                    [&](const ClosureResidualRow& row) { return row.step == closure.steps; });
    if (!closes && !states_drift) {
        remarks.push_back(unknown_drift());
    }
    return remarks;
}

std::vector<certificate::Finding> circle_closure_findings(const EvaluationRecord& record) {
    std::vector<Remark> remarks;
    for (const gum::Diagnostic& message : record.diagnostics) {
        for (const Grave& grave : k_findings) {
            if (record.circle_closure && message.code == grave.code) {
                remarks.push_back({.message = message,
                                   .id = std::string(grave.id),
                                   .clause = "ISO/IEC 17025:2017, 7.7.1",
                                   .severity = grave.severity,
                                   .accredited = grave.accredited});
            }
        }
    }
    return findings_of(std::move(remarks), record);
}

}  // namespace gumcert::reports
