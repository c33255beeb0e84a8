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

/// What the name of a line states, with what the name says beside it.
struct NamedStatement {
    Statement statement = Statement::value;
    /// Some quantity may be called so as well: "U" is a voltage, "p" a pressure, "tolerance" a contribution.
    bool may_be_quantity = false;
    /// A constant of a table may be called so, as "correction"; what is the value stands last.
    bool may_be_constant = false;
    bool is_relative =
        false;  ///< "Relative expanded uncertainty": a part of the value, and none of a number in another unit
    bool says_of_what = false;  ///< a relative one, beside coverage: "(of full scale)"
    std::string coverage = {};  ///< "(k = 2.08, p = 95 %)" of "Expanded uncertainty (k = 2.08, p = 95 %)"
    std::string other_k = {};   ///< of "k·u_c = 2.65·2": what may be k as well as the number in `coverage`
    std::string assigned = {};  ///< "0.096 mg" of "U = 0.096 mg": what stands behind the name in its own cell
    /// Of "U / mm" alone, which may be another quantity in another unit (a circumference; revolutions of "U / min"): its unit.
    std::string unit_of_U = {};
};
[[nodiscard]] std::optional<NamedStatement> named_statement(std::string_view name);

/// What the name of a line says of a sum of rows.
enum class SumName {
    none,
    of_quantity,  ///< "Temperature total": a sum of some rows, if it is one
    whole,        ///< "Total", "RSS": of all rows, or of a part of them
    of_type,      ///< "Type A", "RSS of type B": of a part of the rows, or a contribution
    part,         ///< "Subtotal", "Zwischensumme"
    of_squares,   ///< "Sum of squares", "u_c²"
};
[[nodiscard]] SumName sum_name(std::string_view name);
/// Whether a name says that its row is a part of the one above it: "of which sensor", "davon Fühler".
[[nodiscard]] bool is_called_part(std::string_view name);
/// Whether two names are those of u_c and U: the same but for their first letter, as "u(f)" and "U(f) (k = 2)".
[[nodiscard]] bool are_u_and_U(std::string_view u_c, std::string_view U);

/// The certificate that a text names by its number: "certificate 91-E" of "U = 1.5 µV, k = 2; certificate 91-E; 39 µV/K"; ""
/// where it names none.
[[nodiscard]] std::string certificate_in(std::string_view text);

/// What a text says of coverage: "k = 2.08, p = 95.45 %", "Normal (k=2)", "Erweiterungsfaktor 2", "95 %".
struct CoverageText {
    std::string_view k;       ///< the number that k is, and what follows it; empty where it says none
    std::optional<double> p;  ///< between 0.5 and 1
    [[nodiscard]] bool says_any() const { return !k.empty() || p.has_value(); }
};
[[nodiscard]] CoverageText coverage_in(std::string_view text);
/// Whether a text beside a relative uncertainty says nothing but its coverage, its unit, and that it is of the value: "(%)",
/// "k = 2, p = 95 %", "of reading", and not "of full scale" or "v. E.".
[[nodiscard]] bool says_coverage_alone(std::string_view text);

/// The k that a distribution is said with: "normal (k = 2)", "Normal 2σ", "N (2 sigma)".
[[nodiscard]] std::optional<double> k_of_distribution(std::string_view text);

}  // namespace gumcert::audit
