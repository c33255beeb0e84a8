#include "self_test/case_texts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::self_test {

namespace {

constexpr std::size_t k_longest_line = 300;  // characters of a text of a case

std::string source_of(const ReferenceCase& reference) {
    constexpr std::size_t k_longest = 120;
    return text::visible(reference.document + (reference.place.empty() ? "" : ", " + reference.place), k_longest) +
           (reference.is_place_seen ? "" : " (not looked up)");
}

std::string value_line(const ComparedValue& value) {
    constexpr int k_digits = 15;
    const int digits = value.expected.digits();
    const std::string computed = value.was_found ? text::visible(value_text(value.computed, k_digits)) : "nothing";
    const std::string reached =
        digits > 0 ? ", " + std::to_string(value.digits_reached) + " of " + std::to_string(digits) + " digits" : "";
    return std::string("      ") + (value.agrees ? "pass" : "FAIL") + "  " + text::visible(value.expected.name()) +
           ": " + computed + ", " + (value.expected.is_printed ? "printed" : "expected") + " " +
           text::visible(value.expected.text) + reached + "  (" +
           text::visible(value.expected.found.front(), k_longest_line) + ")\n";
}

}  // namespace

std::string case_line(const CaseOutcome& outcome) {
    return std::string(outcome.passes() ? "pass" : "FAIL") + "  " + text::visible(outcome.reference.id) + "  " +
           source_of(outcome.reference) + "  " + std::to_string(outcome.agreed()) + " of " +
           std::to_string(outcome.values.size()) + " values";
}

std::string value_lines(const CaseOutcome& outcome) {
    std::string lines;
    for (const ComparedValue& value : outcome.values) {
        lines += value_line(value);
    }
    for (const ExpectedValue& expected : outcome.reference.expected) {
        if (!expected.not_compared.empty()) {
            lines += "      not compared  " + text::visible(expected.name()) + ": " +
                     text::visible(expected.not_compared, k_longest_line) + "\n";
        }
    }
    return lines;
}

gum::Diagnostic failure_of(const CaseOutcome& outcome) {
    const auto first = std::find_if(outcome.values.begin(), outcome.values.end(),
                                    [](const ComparedValue& value) { return !value.agrees; });
    const std::size_t more = outcome.values.size() - outcome.agreed();
    return {.code = "GC-SELF-0003",
            .where = text::visible(outcome.reference.id),
            .what = first == outcome.values.end()
                        ? outcome.refused
                        : text::visible(first->expected.name() + ": " + first->because, k_longest_line) +
                              (more > 1 ? "; and " + text::count_of(static_cast<std::int64_t>(more) - 1, "more value")
                                        : ""),
            .rule = "every value of a published case is reached within its tolerance",
            .action =
                "issue no certificate with this installation before it is explained; install the program "
                "again and repeat the test",
            .severity = gum::Severity::error};
}

}  // namespace gumcert::self_test
