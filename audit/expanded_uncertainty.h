#pragma once

#include <optional>

#include "audit/audited_budget.h"
#include "audit/comment_pieces.h"

namespace gumcert::audit {

/// What a text says of U of a certificate: one number, or what is left open.
struct ExpandedInWords {
    std::optional<double> value;  ///< in the unit of the row, > 0
    OpenExpansion open;           ///< where there is no value
};

/// Reads the expression directly behind "U =", "U95:", "U(k = 2) =", "U at 100 bar is", "expanded uncertainty".
///
/// Sums and products are evaluated: "0.002 × 100 bar", "0.12 µm + 0.5e-6 L, L = 400 mm". A percentage, ppm or µm/m is a part
/// of its base: "0.1 % of 200 bar", "0.1 % FS, FS = 200 bar", "0.1 % of span (200 bar)". What U is a function of is never U:
/// "U(100 bar)", "at 100 bar". Where a part has no number, or several U are stated, all that is left open is handed back.
/// \return nothing where the text states no U, or one of another kind than the row
[[nodiscard]] std::optional<ExpandedInWords> expanded_uncertainty_in(const Pieces& pieces, const AuditedRow& row);

/// Settles U of a certificate that words leave open by the columns of the row, where these have a number that the words allow:
/// the one of several that was divided, the part of the estimate, or what an expression is that grows with a length.
/// Sets origin_value, or leaves it.
void settle_expanded_uncertainty(AuditedRow& row);

}  // namespace gumcert::audit
