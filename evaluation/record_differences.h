#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gumcert::evaluation {

/// A place where two records differ.
/// \param pointer    of the place (RFC 6901)
/// \param stated     what stands there in the first record; none: nothing
/// \param evaluated  the same in the second one
using DifferenceSink =
    std::function<void(const std::string& pointer, const nlohmann::json* stated, const nlohmann::json* evaluated)>;

/// Walks two records side by side and tells every place where they differ, in the order of the first one.
///
/// The same numbers are those that agree within 1e-9 of their size, or of 1e-12 of the largest in their list, in a matrix
/// of covariances of the two standard uncertainties: mathematical functions of two computers may differ in the last digit.
/// Every text is the same to the letter.
void tell_differences(const nlohmann::json& stated, const nlohmann::json& evaluated, const DifferenceSink& tell);

/// A value as a message shows it: what is long is shortened, a list is "a list of 3".
[[nodiscard]] std::string shown_value(const nlohmann::json& value);

}  // namespace gumcert::evaluation
