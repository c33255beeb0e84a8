#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "jobs/budget/budget_job.h"
#include "jobs/file_source.h"
#include "jobs/input_codes.h"

namespace gumcert::jobs {

// What is refused in a `reference_method` of a rotary-table job beyond the form of its keys.
inline constexpr InputCode k_reference_budget_output{"GC-REFERENCE-0001",
                                                     "the budget of the reference has not one output, a length"};
inline constexpr InputCode k_reference_budget_reading{
    "GC-REFERENCE-0002", "the budget of the reference has no input reading to be replaced"};
inline constexpr InputCode k_reference_budget_points{"GC-REFERENCE-0003", "the budget of the reference has points"};
inline constexpr InputCode k_reference_correlation{"GC-REFERENCE-0004",
                                                   "a correlation that is neither a number nor a known word"};
inline constexpr InputCode k_published_direction{"GC-REFERENCE-0005",
                                                 "a published mean |En| of a direction without readings"};
inline constexpr std::array k_reference_codes{k_reference_budget_output, k_reference_budget_reading,
                                              k_reference_budget_points, k_reference_correlation,
                                              k_published_direction};

/// One point at which the reference method was read.
struct ReferencePoint {
    std::size_t direction = 0;  ///< 0, 1, 2 for x, y, z of T
    std::size_t angle = 0;      ///< index into RotaryTableMeasurement::angles
    std::size_t runs = 0;       ///< readings there
    double mean = 0.0;          ///< of them, [m]
};

/// The points of the readings, direction by direction and angle by angle.
[[nodiscard]] std::vector<ReferencePoint> reference_points(std::span<const engine::ReferenceReading> readings);

/// Reads the budget of a reference value, and gives it a table of points: the mean reading of each stands in place of
/// the value of the input `reading`, in its unit. Everything else is as the budget states it, so an input is common to
/// all points unless it says `"between_points": "independent"`; `reading` itself is one quantity a point unless it says
/// `"common"`.
/// \param points  empty: the budget as it stands is checked and returned
/// \throws InputError    with what the budget is refused for by itself, or GC-REFERENCE-0001 to -0003
/// \throws StorageError  if a file cannot be read
[[nodiscard]] BudgetJob read_reference_budget(const FileSource& source, const std::string& file,
                                              std::span<const ReferencePoint> points,
                                              std::span<const double> angles_deg);

}  // namespace gumcert::jobs
