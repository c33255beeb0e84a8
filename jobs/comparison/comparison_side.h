#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "jobs/comparison/comparison_reading.h"

namespace gumcert::jobs {

inline constexpr std::size_t k_most_side_points = 2000;  // their covariance is dense

/// A point in a message.
[[nodiscard]] inline std::string description(const MethodPoint& point) {
    return point.direction.empty() ? point.name : point.name + " " + point.direction;
}

/// What a side of a comparison of methods states of one point.
struct SidePoint {
    MethodPoint point;
    double value = 0.0;
    std::optional<gum::ResultUncertainty> uncertainty;
    std::optional<double> u_common;
    std::string where;
};

/// One side while it is read: its points in its own order.
struct SideReading {
    std::string key;  ///< "lab" or "reference"
    ComparisonSide side;
    std::vector<SidePoint> points;
    ProblemList* problems = nullptr;  ///< of the file with the points
    std::optional<std::string> covariance_name;
    bool has_points = false;  ///< it lists them, whether with values or as names of those of a budget
    bool has_budget = false;  ///< it names one, which perhaps could not be read
    bool has_job = false;     ///< it names one, which perhaps could not be read; its points are the angles of the job
    bool is_whole = true;     ///< nothing was refused that may have hidden a point or a number
};

/// Reads the key `lab` or `reference` with its table of points and its budget.
/// \param default_name  of the method, where the job has none
/// \param unit          of the comparison; nothing: it was refused, and no unit is held against it
[[nodiscard]] SideReading read_side(const ComparisonReading& reading, const JsonObject& root, const std::string& key,
                                    const std::string& default_name, const std::optional<gum::Unit>& unit);

}  // namespace gumcert::jobs
