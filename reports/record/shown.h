#pragma once

#include <optional>
#include <string>

namespace gumcert::reports {

/// A number of a record and the text that documents print of it, which is rounded once and never again.
///
/// A record has both under the same key: the number in its object, the text in the object `printed` there.
/// \tparam Number  double, or std::optional<double> where the number may be absent
template <class Number>
struct Shown {
    Number number = {};
    std::string text = {};  ///< "" where nothing is printed

    /// A number that is there, for a place where it may be absent.
    operator Shown<std::optional<Number>>() const { return {number, text}; }
};

}  // namespace gumcert::reports
