#pragma once

#include <string>
#include <vector>

namespace gumcert::reports {

/// Something that certificate data state, with its place.
struct StatedLeaf {
    std::string at;    ///< JSON pointer
    std::string text;  ///< never empty
    const char* kind;  ///< of certificate::Change
};

/// Places that what was stated has among what is stated now, one for each. Rows of a list are paired by what they are: equal ones
/// wherever they stand, then those that are most alike, then by their order; one that has gone gets a place that nothing has.
/// Lists of single numbers, codes or texts keep their order, which says something: there what came or went in the middle is found.
[[nodiscard]] std::vector<std::string> places_of_counterparts(const std::vector<StatedLeaf>& before,
                                                              const std::vector<StatedLeaf>& now);

}  // namespace gumcert::reports
