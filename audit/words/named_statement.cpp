#include "audit/words/named_statement.h"

#include <algorithm>
#include <utility>

#include "audit/words/bare_text.h"
#include "audit/words/coverage_words.h"
#include "audit/words/product_of_coverage.h"
#include "audit/words/statement_words.h"
#include "audit/words/uncertainty_in_words.h"
#include "audit/words/unit_words.h"
#include "gum/quantity/unit.h"

namespace gumcert::audit {
namespace {

/// Whether an input quantity may have the name of a statement.
bool may_be_quantity(Statement statement, std::string_view text) {
    switch (statement) {
        case Statement::u_c:
        case Statement::nu_eff:
        case Statement::U:
        case Statement::reported_U:
            return false;
        case Statement::k:
            return text.size() <= 3;
        case Statement::value:
            return !is_result_word(text);
        default:
            return true;
    }
}

/// What follows a part of a name.
std::string_view behind_of(std::string_view name, std::string_view part) {
    return name.substr(static_cast<std::size_t>(part.data() - name.data()) + part.size());
}

/// Of a name that is a statement as it stands, or before what it has in brackets.
/// \param further  what is said of coverage behind it
std::optional<NamedStatement> whole_statement(std::string_view name, std::string_view further = {}) {
    name = trimmed(name);
    const std::string_view short_name = trimmed(without_brackets(name));
    for (std::string_view text = name;; text = short_name) {
        std::optional<NamedStatement> named;
        if (text == "U" || text == "U(y)" || text == "W") {  // W is a relative U (ISO 376)
            named = NamedStatement{.statement = Statement::U, .may_be_quantity = text != "U(y)"};
        } else if (text.starts_with("U(") && text.find(')') + 1 == text.size() &&
                   is_of_expanded(coverage_in(std::string(behind_of(name, text)) + std::string(further)))) {
            named = NamedStatement{.statement = Statement::U};  // "U(f) k = 2"
        } else if (text == "k") {
            named = NamedStatement{.statement = Statement::k, .may_be_quantity = true};
        } else if (text == "u" || text == "u(y)") {
            named = NamedStatement{.statement = Statement::u_c, .may_be_quantity = text == "u"};
        } else if (text.starts_with("u_c(") || text.starts_with("uc(")) {
            named = NamedStatement{.statement = Statement::u_c};
        } else if (const std::optional<Statement> statement = statement_word(text)) {
            named = NamedStatement{.statement = *statement, .may_be_quantity = may_be_quantity(*statement, text)};
            if ((*statement == Statement::k || *statement == Statement::U) && text.ends_with("99")) {
                named->coverage = "99 %";  // "U99", "k_99": 95 % is what is taken where nothing is said
            }
        } else if (is_deviation_word(text)) {
            named = NamedStatement{.statement = Statement::value, .may_be_quantity = true, .may_be_constant = true};
        }
        if (const std::size_t at = text.rfind(' '); !named && at != std::string_view::npos && at > 0) {
            // "Error of indication E", "Result c"
            const std::string_view word = trimmed(text.substr(0, at));
            if (is_symbol(text.substr(at + 1)) && (is_deviation_word(word) || is_result_word(word))) {
                named = NamedStatement{.statement = Statement::value, .may_be_quantity = true, .may_be_constant = true};
            }
        }
        const std::string_view behind = behind_of(name, text);
        const std::string coverage = std::string(behind) + std::string(further);
        bool is_relative = false;
        if (const std::optional<Statement> by_words = uncertainty_in_words(text, coverage, is_relative);
            by_words && (!named || named->statement == Statement::u_c)) {
            named = NamedStatement{.statement = *by_words,
                                   .is_relative = is_relative,
                                   .says_of_what = is_relative && !says_coverage_alone(coverage)};
        }
        if (named) {
            if (coverage_in(behind).says_any()) {
                named->coverage = behind;
                named->may_be_quantity = false;
            }
            return named;
        }
        if (text == short_name) {
            return std::nullopt;
        }
    }
}

/// \param may_have_unit  behind the name; one is taken off, and not another one behind that
std::optional<NamedStatement> statement_named(std::string_view name, bool may_have_unit) {
    name = trimmed(name);
    // "Result: (10.0020 ± 0.0047) bar": brackets about a value and its U explain no name.
    const std::size_t plus_minus = std::min(name.find("±"), name.find("+/-"));
    if (const std::size_t sign = name.find_first_of("=:"); sign < plus_minus && plus_minus != name.npos) {
        std::optional<NamedStatement> named = whole_statement(name.substr(0, sign));
        if (named && named->statement == Statement::value) {
            named->assigned = trimmed(name.substr(sign + 1));
            return named;
        }
    }
    if (std::optional<NamedStatement> whole = whole_statement(name)) {
        return whole;
    }
    constexpr std::size_t k_longest = 200;
    if (name.size() > k_longest) {
        return std::nullopt;
    }
    // "Expanded uncertainty / dB, k = 2", "U mm (k = 2)": the unit stands behind the name.
    for (const std::string_view sign : {" / ", " in ", " "}) {
        const std::string of_name = sign == " " && may_have_unit ? unit_in_head(std::string(name)) : std::string();
        const bool is_sought = may_have_unit && (sign != " " || !of_name.empty());
        const std::size_t at = is_sought ? name.find(std::string(sign) + of_name) : std::string_view::npos;
        if (at == std::string_view::npos || at == 0) {
            continue;
        }
        const std::string_view behind = name.substr(at + sign.size());
        const std::size_t end = std::min(behind.find_first_of(" ,;:="), behind.size());
        if (known_unit(std::string(behind.substr(0, end)))) {
            const std::string without = std::string(name.substr(0, at)) + std::string(behind.substr(end));
            std::optional<NamedStatement> named = statement_named(without, false);
            // "U / V" and "Correction in µm" may be rows, as "U" and "Correction" may; "U / µg = 721 (k = 2)" is none.
            const bool may_be_row = named && (named->may_be_quantity || named->may_be_constant);
            const bool is_U = named && named->statement == Statement::U;
            if (named && (!may_be_row || (is_U && coverage_in(named->assigned).says_any()))) {
                return named;
            }
            // "U / mm" alone is no voltage: it is as much a statement as "U" beside a unit is.
            const auto is_voltage = [](const gum::Unit& unit) {
                return unit.dimension() == gum::Unit::parse("V").dimension();
            };
            if (is_U && !is_voltage(*known_unit(std::string(behind.substr(0, end)))) && named->assigned.empty()) {
                named->unit_of_U = behind.substr(0, end);
                return named;
            }
        }
    }
    if (const std::size_t sign = name.find_first_of("=:"); sign != std::string_view::npos) {
        const std::string_view behind = trimmed(name.substr(sign + 1));
        const std::string_view symbol = trimmed(name.substr(0, sign));
        // "U = k · u mit k = 2": what k is stands behind the product.
        std::size_t with = std::string_view::npos;
        for (const std::string_view word : {" mit ", " with ", ", ", "; ", " ("}) {
            const std::size_t at = behind.find(word);
            with = at != std::string_view::npos && begins_with_coverage(behind.substr(at)) ? std::min(with, at) : with;
        }
        const std::string_view product = behind.substr(0, with);
        if (const auto [factor, is_last] = factor_of_u(product.substr(0, product.find('='))); !factor.empty()) {
            const std::optional<NamedStatement> whole = whole_statement(symbol);
            if ((whole && whole->statement == Statement::U) || symbol.starts_with("U(") || symbol == "U_95") {
                const std::string said(with == std::string_view::npos ? std::string_view() : behind.substr(with));
                const bool is_symbol_of_k = factor.front() == 'k' || factor.front() == 't';
                const FactorInNumbers k =
                    is_symbol_of_k ? factor_in_numbers(product, is_last) : FactorInNumbers{.k = factor};
                // Where the product has k and nobody can tell which number it is, k is stated all the same.
                const std::string in_product(k.is_open && said.empty() ? trimmed(product) : std::string_view());
                return NamedStatement{.statement = Statement::U,
                                      .coverage = k.k.empty() ? said + in_product : "k = " + std::string(k.k) + said,
                                      .other_k = std::string(k.other),
                                      .assigned = std::string(number_at_end(product))};
            }
        }
        if (std::optional<NamedStatement> named = whole_statement(name.substr(0, sign))) {
            const bool is_of_coverage =  // "k = 2 (p = 95 %)" has its number
                named->statement == Statement::coverage_probability || named->statement == Statement::k;
            (begins_with_coverage(behind) && !is_of_coverage ? named->coverage : named->assigned) = behind;
            return named;
        }
    }
    // "Expanded uncertainty, k=2, 95 %" is a name and what is said of coverage.
    for (std::size_t at = name.find_first_of(" ,;("); at != std::string_view::npos;
         at = name.find_first_of(" ,;(", at + 1)) {
        if (!begins_with_coverage(name.substr(at))) {
            continue;
        }
        if (std::optional<NamedStatement> named = whole_statement(name.substr(0, at), name.substr(at))) {
            named->coverage = name.substr(at);
            named->may_be_quantity = false;
            return named;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<NamedStatement> named_statement(std::string_view name) {
    // "Model: y = m/V" in one cell. A model of an instrument has no sign of equality.
    if (const std::size_t colon = name.find(':'); colon != std::string_view::npos) {
        const std::string_view behind = trimmed(name.substr(colon + 1));
        const std::optional<NamedStatement> whole = statement_named(trimmed(name.substr(0, colon)), true);
        if (whole && whole->statement == Statement::equation && behind.find('=') != std::string_view::npos) {
            return NamedStatement{.statement = Statement::equation, .assigned = std::string(behind)};
        }
    }
    return statement_named(name, true);
}

std::optional<Statement> statement_of(std::string_view name) {
    const std::optional<NamedStatement> named = named_statement(name);
    return named ? std::optional(named->statement) : std::nullopt;
}

}  // namespace gumcert::audit
