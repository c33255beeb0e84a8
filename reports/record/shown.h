#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::reports {

/// What documents print of a number: a text, and of a list a text for each element.
template <class Number>
struct TextOf {
    using Type = std::string;
};
template <class Element>
struct TextOf<std::vector<Element>> {
    using Type = std::vector<typename TextOf<Element>::Type>;
};
template <class Element, std::size_t size>
struct TextOf<std::array<Element, size>> {
    using Type = std::array<typename TextOf<Element>::Type, size>;
};

/// A number of a record and the text that documents print of it, which is rounded once and never again.
///
/// A record has both under the same key: the number in its object, the text in the object `printed` there.
/// \tparam Number  double, std::optional<double> where the number may be absent, or a list of numbers
template <class Number>
struct Shown {
    Number number = {};
    typename TextOf<Number>::Type text = {};  ///< "" where nothing is printed

    /// A number that is there, for a place where it may be absent.
    operator Shown<std::optional<Number>>() const { return {number, text}; }
};

}  // namespace gumcert::reports
