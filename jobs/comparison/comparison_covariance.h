#pragma once

#include <cstddef>
#include <span>

#include "jobs/comparison/comparison_side.h"

namespace gumcert::jobs {

/// Uncertainties and covariance of the points of a side, from what the points state: what several share through
/// `u_common` is their covariance.
/// \param points  in the order of the comparison
void covariance_of_points(std::span<const SidePoint> points, ComparisonSide& side);

/// The same from the covariance file of a side. Refuses what is no covariance matrix, or differs from the points.
/// \param order  place in the order of the comparison of each row of the file
void read_point_covariance(const ComparisonReading& reading, const SideReading& read,
                           std::span<const std::size_t> order, ComparisonSide& side);

}  // namespace gumcert::jobs
