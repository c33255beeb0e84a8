#pragma once

#include <optional>
#include <string>
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
/// count as they are written: "u" is a standard and "U" an expanded uncertainty. A unit and a symbol behind the word are of it:
/// "Contribution / nm", "Beitrag in µm", "Quantity X_i", "Sensitivity dT/dx".
[[nodiscard]] std::optional<Column> column_of(std::string_view head);

/// Whether a head is a Spanish, French or Chinese word. The heads of such a table are known, and the words of its rows are not.
[[nodiscard]] bool is_of_other_language(std::string_view head);

/// The point that a head is of, "10 V" of "u (10 V)", "u bei 10 V" and "Contribution 10 V"; "" where it has no number with a unit.
[[nodiscard]] std::string point_in_head(std::string_view head);
/// The column of relative uncertainties that a head names, with the unit of a part: "Relative standard uncertainty (%)", "rel.
/// Standardunsicherheit in ppm". Without such a unit, a part of a value would be taken for the value's own unit.
/// \param unit_of_numbers  that the numbers below show, where the head states none
[[nodiscard]] std::optional<Column> relative_column_of(std::string_view head, std::string_view unit_of_numbers = {});
/// Whether a head is the symbol of a relative u of ISO 376, "w", "w_i / %". Weights have it as well.
[[nodiscard]] bool is_relative_symbol(std::string_view head);
/// Whether a head is one of relative uncertainties, whatever unit it states: "u(x)/x", "RSU (%)", "Relative standard uncertainty", "u_rel".
[[nodiscard]] bool is_of_relative_uncertainty(std::string_view head);

/// A column of the uncertainties of one type: "u (Type A)", "Standard uncertainty (B) %", "Type A (%)".
struct TypedHead {
    bool is_a = false;
    Column column = Column::u;  ///< or contributions
    std::string unit = {};
};
[[nodiscard]] std::optional<TypedHead> typed_head(std::string_view head);

/// A head of the limits of what is divided: "Lower limit", "a+", "Obergrenze (mm)". "Lower (95 %)" is one of a coverage interval.
enum class LimitHead { lower, upper };
[[nodiscard]] std::optional<LimitHead> limit_head(std::string_view head);

/// Whether a head that names none of these columns is known all the same: shares, squares, numbers of rows.
[[nodiscard]] bool is_unused_column(std::string_view head);

}  // namespace gumcert::audit
