#include "engine/rotary_table/evaluation/repeatability_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

constexpr double k_level_of_all = 0.001;   // of all components together
constexpr double k_quarter_larger = 1.25;  // one digit of 2 stands for 1.5 to 2.5
constexpr double k_less_than_half = 0.5;   // the given value is on the safe side then

std::string size_of_repeatability(ComponentRow row, double value) {
    return row == table_linear ? text::significant(value / gum::k_micrometre, 2) + " µm"
                               : text::significant(value / gum::k_arcsecond, 2) + "″";
}

}  // namespace

std::vector<RefutedRepeatability> refuted_repeatability(
    const VarianceComponentStep& step, const TableRepeatability& given,
    const std::function<double(double, double)>& chi_square_upper_tail) {
    std::vector<RefutedRepeatability> refuted;
    if (given.mode == RepeatabilityMode::estimate) {
        return refuted;
    }
    const bool none = given.mode == RepeatabilityMode::none;
    const std::array<double, 3> values{none ? 0.0 : given.u_linear, none ? 0.0 : given.u_axial,
                                       none ? 0.0 : given.u_tilt};
    constexpr double k_level_of_each = k_level_of_all / static_cast<double>(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto row = static_cast<ComponentRow>(table_linear + k);
        const VarianceComponent& component = step.components[row];
        const double spread = step.expected_spread[row];
        const double nu = step.form_degrees_of_freedom[row];
        if (!component.estimated || !component.determined || !(spread > 0.0) || !(nu > 0.0)) {
            continue;
        }
        const double more = (component.value * component.value - values[k] * values[k]) / spread;
        const double above = chi_square_upper_tail(std::max(0.0, nu + more * std::sqrt(2.0 * nu)), nu);
        for (const bool larger : {true, false}) {
            const RefutedRepeatability candidate{row, values[k], larger};
            if (is_refuted_by(candidate, component.value) && (larger ? above : 1.0 - above) < k_level_of_each) {
                refuted.push_back(candidate);
            }
        }
    }
    return refuted;
}

bool is_refuted_by(const RefutedRepeatability& refuted, double distances_give) {
    return refuted.larger ? distances_give > k_quarter_larger * refuted.given
                          : distances_give < k_less_than_half * refuted.given;
}

gum::Diagnostic repeatability_note(const RefutedRepeatability& refuted, double distances_give) {
    constexpr std::array<const char*, 3> names{"table linear", "table angular, axial", "table angular, tilt"};
    const std::string where = std::string("variance components, ") + names[refuted.row - table_linear];
    const std::string estimate =
        distances_give > 0.0 ? size_of_repeatability(refuted.row, distances_give) : std::string("0");
    if (!(refuted.given > 0.0)) {
        return {k_repeatability_too_small,
                where,
                "the distances give a repeatability of the table of " + estimate +
                    ", and the job says that there is none: U is too small",
                "a table that comes back perfectly leaves a scatter of its visits that passes a one-sided chi-square "
                "test at 0.1 % for all components",
                "let the repeatability be estimated with \"mode\": \"estimate\", or give it",
                gum::Severity::warning};
    }
    const std::string given = size_of_repeatability(refuted.row, refuted.given);
    if (!refuted.larger) {
        return {
            k_repeatability_too_large,
            where,
            "the distances give a repeatability of the table of " + estimate + ", and " + given +
                " is given: U is too large, and errors of the measurement are harder to find",
            "a given repeatability is less than twice what the distances give, or passes a one-sided chi-square test "
            "at 0.1 % for all components",
            "let it be estimated with \"mode\": \"estimate\", or give what holds for this table",
            gum::Severity::warning};
    }
    return {k_repeatability_too_small,
            where,
            "the distances give a repeatability of the table of " + estimate + ", and " + given +
                " is given: U is too small, and good distances may seem outlying",
            "what the distances give is less than a quarter larger than the given repeatability, or passes a one-sided "
            "chi-square test at 0.1 % for all components",
            "let it be estimated with \"mode\": \"estimate\", or give what holds for this table, unless a loose "
            "support or a drift makes the visits scatter",
            gum::Severity::warning};
}

}  // namespace gumcert::engine
