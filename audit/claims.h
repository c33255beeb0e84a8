#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "audit/audited_budget.h"
#include "audit/budget_outcome.h"
#include "audit/stated_number.h"

namespace gumcert::audit {

/// What a claimed number may have been before it was printed: its rounding, and for a whole number "120" the half unit of
/// its last digit that is not 0. A number without text is known to all digits, but for a relative 1e-6 of arithmetic.
[[nodiscard]] Interval printed_interval(const StatedNumber& number);

/// A number of somebody's table in the form that documents have: its digits, with the decimal point and without signs that
/// group them. "" where it has no text.
[[nodiscard]] std::string text_of_claim(const StatedNumber& number);

/// The claimed u_c, ν_eff and U against the rows.
struct ClaimCheck {
    std::optional<OutcomeIntervals> allowed;  ///< by the rule of coverage of the budget; none where it gives no outcome
    Interval u_c, nu_eff, U;                  ///< what the rows allow of the claims
    bool u_c_outside = false, U_outside = false;
    bool k_outside =
        false;  ///< no rule of coverage that explains the claims gives the claimed k with ν_eff of the rows
    bool nu_eff_apart = false;  ///< the claimed ν_eff, rounded or cut, is not that of the rows, whatever k is
    /// The claimed k is t_p of the claimed ν_eff, and ν_eff of the rows is another one that gives another k.
    bool nu_eff_outside = false;
    bool linear_sum = false;  ///< u_c is Σ |c| u of the rows, not the root of the sum of squares
    CoverageRule coverage;  ///< the rule of coverage that gives the claimed k and U; that of the budget where none does
};

/// Whether the name of a distribution is that of Gauss or of Student, by its letters: "normal", "student_t".
[[nodiscard]] bool is_normal_or_student(std::string_view name);

/// Holds claims against what the printed digits of the rows allow (outcome_intervals()). U follows from the claimed u_c
/// where there is one, and by any rule of coverage that the claims leave open: the stated k, or t_p(ν_eff) with p
/// as stated, ν_eff as it is or cut. A k with decimals that is t_p(ν_eff) within its digits was taken from ν_eff; "2" is
/// what laboratories take whatever ν_eff. U and u_c may be rounded up (JCGM 100:2008, 7.2.6). Nothing is outside where a budget gives no outcome.
[[nodiscard]] ClaimCheck check_claims(const AuditedBudget& budget);

/// The part of it that u_c alone decides: `allowed`, `u_c`, `nu_eff`, `u_c_outside` and `linear_sum`.
[[nodiscard]] ClaimCheck check_u_c(const AuditedBudget& budget);

/// Gives the claimed u_c and U that have no text, of a sheet with formulas, the half step of their own last digit, where they are
/// what the rows give, rounded to it or up to it (JCGM 100:2008, 7.2.6): of "0.021" that is typed, or the result of ROUND or
/// ROUNDUP. Two digits are taken to be meant at least, six at most: what has more was not rounded.
void settle_rounded_claims(AuditedBudget& budget);

/// For readers, after rows, claims and coverage are filled: takes over the rule of coverage that the claims show, and
/// sets what they have beyond the rows, so that the budget evaluates to what it claims: u_c_over_rows where the
/// claimed u_c lies outside of what the rows allow, k_over_rows where k follows a ν_eff that the rows do not give,
/// U_over_k_u_c where the claimed U is not k u_c. They are 1 where rows and claims agree within their rounding, and where
/// the budget gives no outcome. Rows whose printed u is not what they divide, and was not summed, are evaluated with the
/// quotient (use_quotient_of_columns()).
void note_unexplained(AuditedBudget& budget);

/// The same of claims alone: rows stay what they are, as those that formulas compute with.
void note_claims_beyond_rows(AuditedBudget& budget);

/// The budget with what its formulas give of its claims, where the file shows other numbers; else the budget itself.
[[nodiscard]] AuditedBudget with_computed_claims(const AuditedBudget& budget);

}  // namespace gumcert::audit
