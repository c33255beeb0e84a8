#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "certificate/certified_results.h"

namespace gumcert::reports {

/// What the tables show of one point that has a running number only.
struct ShownPoint {
    std::string number;
    std::set<std::pair<std::string, std::string>> texts;  ///< what → as it is printed
};

/// Points of an earlier and a later certificate whose tables do not print the numbers of the points: they are what their rows show,
/// wherever they stand. A point that somebody left out, added or moved is no change of those beside it.
class PointsOfBoth {
public:
    /// \param shown_before, shown_later  all that the tables show, point by point
    PointsOfBoth(const certificate::Certificate& earlier, const std::vector<ShownPoint>& shown_before,
                 const certificate::Certificate& later, const std::vector<ShownPoint>& shown_later);

    /// The number of the later certificate; of a point that has gone, what no other point is called. All else stays.
    [[nodiscard]] std::string earlier_as_later(const std::string& number) const;
    /// What the row shows: "100 mV, 50 Hz, 10.0 mV".
    /// \param number  as earlier_as_later() has it
    [[nodiscard]] std::string name(const std::string& number) const;

private:
    std::map<std::string, std::string> later_of_, names_;
};

}  // namespace gumcert::reports
