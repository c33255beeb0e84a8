#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "audit/audited_budget.h"

namespace gumcert::audit {

// What the words of an uncertainty budget mean, in English and German. A row keeps what its reader has set already:
// words fill in what no column says.

/// The contributor that a row stands for. Words of the quantity count more than those of the comment, and these more
/// than those of the source; `other` where none is known.
[[nodiscard]] Contributor contributor_of(std::string_view quantity, std::string_view comment, std::string_view source);

/// What a row is called: its quantity, and what describes it.
[[nodiscard]] std::string name_in_words(const AuditedRow& row);

/// What a column of distributions says: "rect.", "Rechteck", "N (k = 2)", "U-shaped", "t". `not_stated` of an empty text
/// or a dash, `other` of words that name no distribution known here.
[[nodiscard]] Shape shape_of(std::string_view text);

/// What the half-width of a distribution with bounds is divided by: √3, √6, √2 (JCGM 100:2008, 4.3.7 and 4.3.9);
/// nothing of other shapes.
[[nodiscard]] std::optional<double> divisor_of_shape(Shape shape);

/// Reads origin and numbers of a row out of its comment, and where that says nothing out of quantity and source:
/// "MPE 0.4 µm", "resolution 0.1", "U = 0.36 µm, k = 2", "±1 K", "mean of 10".
///
/// Sets origin, origin_value, certificate_k, certificate_probability, n, pooled_s, nu, type_a, shape and contributor, each
/// only where it is not set. A number with a unit is converted into the unit of the row; one of another dimension
/// belongs to something else and is not taken. A percentage is taken in a row of percent only: its base is not known.
/// Texts are read up to 400 bytes.
void read_comment(AuditedRow& row);

/// Fills in what is evaluated (used_u, used_sensitivity, used_nu and the half steps) from the columns that are there.
///
/// Whether a column of uncertainties was divided already is decided by the contribution: |c| u or |c| u/divisor, which
/// one agrees within the printed digits. Where it was not, its number is what was divided, and moves to `stated`.
/// Without a contribution u counts as divided, and a row with `stated` alone is divided by its divisor, by that of its
/// certificate, or by that of its shape. Degrees of freedom that no column states are infinite.
void complete_row(AuditedRow& row);

/// What a row divides over its divisor, with what the digits of both leave open; nothing where a column is missing or
/// impossible, where the row is a relative number of something else, or has two limits.
[[nodiscard]] std::optional<StatedNumber> quotient_of_columns(const AuditedRow& row);
/// Whether the u that a row prints is another number than its quotient of columns, beyond the digits of both and 1 %.
[[nodiscard]] bool u_is_not_the_quotient(const AuditedRow& row);
/// Evaluates a row with its quotient of columns and its own sensitivity, in place of the u that it prints.
void use_quotient_of_columns(AuditedRow& row);

/// Settles, once all rows are read, what a column of contributions is where it is not |c| u of the row's own columns. In
/// a few rows it is an error that the sum was made of: such a row is evaluated with the sensitivity that its contribution
/// has, or with its quotient of columns, where the contribution is |c| times that: the printed u is the error then. In most rows it is a column of something else (shares, variances), and is taken away.
void settle_contributions(AuditedBudget& budget);

}  // namespace gumcert::audit
