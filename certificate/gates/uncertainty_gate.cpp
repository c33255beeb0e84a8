#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "certificate/gates/cited_documents.h"
#include "certificate/gates/finding_list.h"
#include "certificate/gates/gates.h"
#include "certificate/gates/worded_verdicts.h"
#include "certificate/statement_of_uncertainty.h"
#include "gum/quantity/decimal_rounding.h"

namespace gumcert::certificate {

namespace {

// What is found of one value has no place: FindingList::add_by_cause() names the points.

bool is_negative_zero(const std::string& printed) {
    return printed.starts_with('-') && printed.find_first_of("123456789") == std::string::npos;
}

void digits(FindingList& found, const CertifiedValue& value, int most) {
    if (is_negative_zero(value.printed_value)) {
        found.add(FindingSeverity::minor, "R06", k_p14, "", "the value is printed as " + value.printed_value,
                  "Zero has no sign.");
    }
    if (value.printed_U.empty() || value.printed_U == "0") {
        return;
    }
    if (significant_digits(value.printed_U) > most) {
        found.major(
            "R01", k_p14, "",
            "U is printed as " + value.printed_U + ", with more than " + std::to_string(most) + " significant digits",
            "State U with two significant digits at most.");
    }
    if (decimals_of(value.printed_value) != decimals_of(value.printed_U)) {
        found.major("R02", k_p14, "",
                    "value " + value.printed_value + " and U " + value.printed_U + " end at different decimal places",
                    "Round the value to the last place of U.");
    }
    // An interval of Monte Carlo has no k that anything was multiplied by.
    if (value.printed_k.empty() && value.coverage != "monte_carlo") {
        found.critical("R04", k_p14, "", "U is stated without its coverage factor", "State k.");
    }
}

/// Whether a value lies outside of the limits, and the rule does not publish that it may accept such ones (DR-10 of
/// ASME B89.7.3.1 and DR-11 do). A value on a limit is judged as gum::decide_conformity() judges it.
bool is_outside(const CertifiedValue& value, const Verdict& v) {
    const double scale =
        std::max({std::abs(value.value), std::abs(v.lower.value_or(0.0)), std::abs(v.upper.value_or(0.0))});
    const bool outside = (v.lower && !gum::is_at_most(*v.lower, value.value, scale)) ||
                         (v.upper && !gum::is_at_most(value.value, *v.upper, scale));
    return outside && v.rule != "DR-10" && v.rule != "DR-11";
}

/// Judged by the numbers, whatever the rule is called: its parameters may leave nothing of its guard band.
void poor_measurement(FindingList& found, const CertifiedValue& value, const Verdict& v) {
    constexpr double k_even = 0.495;          // two digits are printed: above it "50 %" would be told as less than even
    constexpr double k_proven = 0.05 + 1e-9;  // a smaller specific risk need not be reported
    const bool passes = v.verdict == "pass" || v.verdict == "conditional_pass";
    const bool unguarded = passes && (v.rule == "DR-01" || v.rule == "DR-12" || v.specific_risk > k_proven);
    if (passes && is_outside(value, v)) {
        found.critical("D08", iso_17025("7.8.6.1"), "",
                       "the value lies outside of the limits of \"" + v.specification + "\", and " + v.rule +
                           " passes it with a probability of conformity of " + v.printed.conformance_probability + " %",
                       "Tell the customer; agree on a rule with a guard band, or measure with a smaller uncertainty.");
    } else if (passes && v.conformance_probability < k_even) {
        found.major("D08", iso_17025("7.8.6.1"), "",
                    "the value passes \"" + v.specification + "\" by " + v.rule +
                        " with a probability of conformity of " + v.printed.conformance_probability +
                        " %: it is more probable that the item does not conform",
                    "Tell the customer; agree on a rule with a guard band, or measure with a smaller uncertainty.");
    } else if (unguarded && v.test_uncertainty_ratio && *v.test_uncertainty_ratio < 1.0) {
        found.major("D08", iso_17025("7.8.6.1"), "",
                    "U is larger than half of the tolerance of \"" + v.specification + "\" (test uncertainty ratio " +
                        v.printed.test_uncertainty_ratio + "), and " + v.rule + " accepts the value all the same",
                    "Tell the customer; agree on a rule with a guard band, or measure with a smaller uncertainty.");
    }
}

void verdict(FindingList& found, const CertifiedValue& value) {
    const Verdict& v = *value.verdict;
    if (v.verdict == "not_applicable") {
        const bool defined = !value.external && !value.U && !value.interval && value.u == 0.0;
        found.add(defined ? FindingSeverity::information : FindingSeverity::major, "D05", iso_17025("7.8.6.1"), "",
                  "conformity with \"" + v.specification + "\" by " + v.rule + " cannot be decided: " + v.note,
                  // Another rule does not mend a slip of the pen.
                  v.note.starts_with("the specification has the unit")
                      ? "Correct the unit of the specification, or the results that it names."
                      : "Agree with the customer on another rule, or leave the statement out.");
    }
    poor_measurement(found, value, v);
    // A reader can decide with the printed numbers only, and must come to the same verdict.
    if (v.verdict != v.verdict_from_printed) {
        found.critical("D04", iso_17025("7.8.6.1"), "",
                       "the verdict is \"" + v.verdict + "\" with the unrounded numbers and \"" +
                           v.verdict_from_printed + "\" with the printed ones",
                       "The value lies at the acceptance limit within rounding. Agree with the customer how such a "
                       "value is decided, or leave the statement of conformity out.");
    }
}

/// U beside what it is to decide on, the tolerance: values of one cause may have other units. Beside the one limit that
/// there is, else beside the value.
double uncertainty_ratio(const CertifiedValue& value) {
    const Verdict& v = *value.verdict;
    const double beside =
        std::abs(v.lower && v.upper ? *v.upper - *v.lower : v.upper.value_or(v.lower.value_or(value.value)));
    return beside > 0.0 ? value.U.value_or(0.0) / beside : 0.0;
}

/// How bad a finding is among those of its cause at other values.
double badness_of(const Finding& finding, const CertifiedValue& value) {
    if (finding.id == "R01") {
        return significant_digits(value.printed_U);
    }
    if (finding.id == "D05") {
        return uncertainty_ratio(value);
    }
    if (finding.id != "D08") {
        return 0.0;
    }
    // Of causes that tell the probability, and of the one that tells the ratio, which is below 1 there.
    const Verdict& v = *value.verdict;
    return finding.what.find("test uncertainty ratio") != std::string::npos ? -v.test_uncertainty_ratio.value_or(0.0)
                                                                            : -v.conformance_probability;
}

}  // namespace

std::vector<Finding> uncertainty_findings(const Certificate& certificate) {
    FindingList found(certificate.data);
    std::vector<FoundInRow> of_values;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const CertifiedValue& value = column.values[row];
                FindingList of_row(certificate.data);
                // A capability that replaces U keeps the two digits of the scope.
                digits(of_row, value, value.raised ? 2 : std::min(2, certificate.profile.digits));
                if (value.verdict) {
                    verdict(of_row, value);
                }
                for (Finding& finding : of_row.take()) {
                    const double badness = badness_of(finding, value);
                    of_values.push_back({.table = &table,
                                         .column = &column,
                                         .row = row,
                                         .finding = std::move(finding),
                                         .badness = badness});
                }
            }
        }
    }
    found.add_by_cause(of_values);
    worded_verdicts(found, certificate);
    return found.take();
}

}  // namespace gumcert::certificate
