#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

/// What a point is.
struct PointIdentity {
    std::vector<std::string> parts;  ///< as they are printed: the group, then cells; a no-break space before a unit
    std::set<std::string> results;   ///< which the tables have at it
    /// As few parts as tell it apart from other points with any of these results, and its number where none do:
    /// "100 mV, 50 Hz, 10.0 mV". Without square brackets.
    std::string name;
};

/// Whether points of a table are counted, and the table does not print the numbers.
[[nodiscard]] bool has_unnamed_points(const CertifiedTable& table);

/// The points of such tables by their numbers, without what was found at them: that may be another one in an amendment.
[[nodiscard]] std::map<std::string, PointIdentity> identities_of_points(const std::vector<CertifiedTable>& tables);

/// Whether a table prints no names of its points.
[[nodiscard]] bool hides_points(const CertifiedTable& table);

/// The points of such tables by their names, for sentences: with what was found at them as last parts.
[[nodiscard]] std::map<std::string, PointIdentity> identities_of_rows(const std::vector<CertifiedTable>& tables);

}  // namespace gumcert::certificate
