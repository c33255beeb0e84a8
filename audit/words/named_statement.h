#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gumcert::audit {

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

}  // namespace gumcert::audit
