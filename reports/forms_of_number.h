#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gumcert::reports {

/// Singular and plural in patterns of the wording: `{count} {count?result|results}` is the first form where {count} is 1, and
/// the second else. A `#` in a form is the place of the value itself: `{count?the only result|all # results}`.

/// Names of the values that a pattern has forms of, each once.
[[nodiscard]] std::vector<std::string> names_with_forms(const std::string& pattern);

/// The pattern with one form in place of both: the places of values are left, and no form.
/// \param is_one  whether the value of a name is 1
[[nodiscard]] std::string with_forms_of(const std::string& pattern,
                                        const std::function<bool(const std::string& name)>& is_one);

}  // namespace gumcert::reports
