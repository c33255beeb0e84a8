#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/certificate_data.h"
#include "certificate/point_tables.h"

namespace gumcert::certificate {

/// Where the numbers and words of one point are found.
struct PointLookup {
    /// A number of a column in a unit of its kind; nothing where the point has none.
    /// \param difference  true: without the origin of a temperature scale; false: nothing where only one of the two units
    ///                    has such an origin
    std::function<std::optional<double>(const std::string& name, const std::string& unit, bool difference)> number;
    /// A word of a column; "" where the point has none.
    std::function<std::string(const std::string& name)> word;
};

/// The column of points with a name; nullptr where there is none.
[[nodiscard]] const PointColumn* column_named(const std::vector<PointColumn>& columns, std::string_view name);

/// \param table  must outlive what is returned
/// \param point  position in it
[[nodiscard]] PointLookup lookup_at(const PointTable& table, std::size_t point);

/// Limits of one point, in the unit of the specification.
struct LimitsAt {
    std::optional<double> lower, upper;
    std::string problem = {};  ///< why there are none, in English; "" else
    /// End of a step that the argument passes by less than a hundredth of it, in the unit of the argument: a measured value
    /// of the nominal value that the step ends with lies there half of the time.
    std::optional<double> passed = {};
};

/// Limits of a specification at one point: its own, where they are the same for all, else as AgreedSpecification::limits
/// states them.
///
/// points: mpe about 0 or `about`, else limit_low and limit_high; both only where they say the same.
/// accuracy: half-width = |reading|·a/100 + full scale·b/100 + digits·digit + constant, about 0 or `about`.
/// steps: the first step that the argument does not exceed. expression: plain numbers, as a capability is written.
[[nodiscard]] LimitsAt limits_at(const AgreedSpecification& specification, const PointLookup& point);

/// Names of columns, inputs among them, that the limits of a specification need.
[[nodiscard]] std::vector<std::string> columns_of_limits(const PointLimits& limits);

}  // namespace gumcert::certificate
