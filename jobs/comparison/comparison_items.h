#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "jobs/comparison/comparison_reading.h"

namespace gumcert::jobs {

// The items of a comparison between laboratories: assigned value, sigma_pt, homogeneity, stability.

/// What an item states, on top of what the job states for all items.
void read_item_keys(const ComparisonReading& reading, const JsonObject& object, gum::ComparisonItem& item);

/// `assigned_value`: a word, or an object.
/// \return nothing when it is absent or was refused
[[nodiscard]] std::optional<gum::AssignedValueRequest> read_assigned_value(const ComparisonReading& reading,
                                                                           const JsonObject& object);

/// The array `items` into the job, each on top of the defaults.
/// \param labels  receives their ids
void read_items(const ComparisonReading& reading, const nlohmann::json& array, const gum::ComparisonItem& defaults,
                LabelIndex& labels);

}  // namespace gumcert::jobs
