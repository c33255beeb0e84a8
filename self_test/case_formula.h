#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace gumcert::self_test {

/// What stands at a path of a reference case: a number, an answer, a text, or a row of numbers.
using CaseValue = std::variant<double, bool, std::string, std::vector<double>>;

/// The value of a path, or of a formula with its paths in braces: `100 * {law/results/y/u} / abs({law/results/y/value})`.
///
/// Numbers, `+ - * / ^`, one comparison, parentheses, `pi`, and the functions of tests/reference/cases/README.md. Rows of
/// numbers are computed element by element.
/// \param value_at  of a path without its braces
/// \throws gum::InputError  GC-SELF-0001, and what value_at throws
[[nodiscard]] CaseValue value_of_formula(const std::string& formula,
                                         const std::function<CaseValue(const std::string& path)>& value_at);

}  // namespace gumcert::self_test
