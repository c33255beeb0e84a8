#pragma once

#include <optional>
#include <string_view>

namespace gumcert::audit {

/// Columns of an uncertainty budget as laboratories head them.
enum class Column {
    quantity,
    estimate,
    unit,
    stated,  ///< what is divided: half-width, limit, expanded uncertainty of a certificate
    divisor,
    distribution,
    type,
    u,
    sensitivity,
    contribution,
    nu,
    source,
    comment,
};
inline constexpr int k_columns = 13;

/// The column that a head names, English or German, with its synonyms: "Std. uncertainty u(xi)" is u. Single letters
/// count as they are written: "u" is a standard and "U" an expanded uncertainty.
[[nodiscard]] std::optional<Column> column_of(std::string_view head);

/// What a row beside or below the table says of the result, of its limits, or of how it is compared.
enum class Statement {
    value,
    u_c,
    nu_eff,
    k,
    U,
    reported_U,  ///< after the capability was looked at
    coverage_probability,
    capability,
    lower_limit,
    upper_limit,
    tolerance,  ///< ± about the nominal value, or an MPE of the item
    nominal,
    verdict,
    decision_rule,
    reference_value,
    reference_U,
    en,
    method,
    measurand,
    equation,
};
[[nodiscard]] std::optional<Statement> statement_of(std::string_view name);

}  // namespace gumcert::audit
