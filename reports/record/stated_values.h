#pragma once

#include "reports/record/evaluation_record.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gumcert::reports {

/// The lists of stated values that a rotary table has, in the order of the record.
enum class StatedGroup { error_motions, reversal, ranges, axis_line, location_errors, positioning };

/// Name of a group in tables of a certificate and in the wording: "error_motions", "reversal" …
[[nodiscard]] const char* group_name(StatedGroup group);

/// Which quantity a stated value is.
/// \tparam Value  StatedValue, or a constant one
template <class Value>
struct StatedPlace {
    StatedGroup group;
    std::size_t index;           ///< in the list of the group; of error motions that of the angle
    const std::string& name;     ///< of the error motion, "EXA", or of the parameter, "R_up"
    const std::string& meaning;  ///< description of a parameter; the name where it has none, and of an error motion
    const std::string& unit;     ///< "um" or "arcsec"
    Value& stated;
};
using StatedPlaces = std::vector<StatedPlace<StatedValue>>;
using ConstStatedPlaces = std::vector<StatedPlace<const StatedValue>>;

/// Error motions as the record has them, all six of one angle together; or all angles of one motion together.
enum class ErrorOrder { by_angle, by_motion };

/// All stated values of a rotary table, group by group. Valid as long as the lists of the table are not changed.
[[nodiscard]] StatedPlaces stated_values(RotaryTable& table, ErrorOrder order = ErrorOrder::by_angle);
[[nodiscard]] ConstStatedPlaces stated_values(const RotaryTable& table, ErrorOrder order = ErrorOrder::by_angle);

/// Name of the result in the tables of a certificate: "EXA", "reversal_EXA", "range_EXA", "R_up".
[[nodiscard]] std::string result_name(StatedGroup group, const std::string& name);

/// JSON pointer of a place inside of the rotary table: "/errors/3/EXA", "/iso230_2/parameters/0".
[[nodiscard]] std::string pointer_of(const StatedPlace<const StatedValue>& place);

}  // namespace gumcert::reports
