#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/job_kind.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"

namespace gumcert::jobs {

/// Distances that the laboratory leaves out of the adjustment: those that agree with everything that is stated.
struct Exclusion {
    std::optional<std::string> station, reflector, pass, direction;
    std::optional<double> angle_deg;
    std::optional<std::pair<std::size_t, std::size_t>> lines;  ///< of the lengths file, first and last
    std::string reason;
    std::string where;      ///< of the entry, for messages
    std::size_t count = 0;  ///< distances that it leaves out, without those of entries before it
};

/// One distance, as an exclusion looks at it.
struct ExclusionKeys {
    std::string_view station, reflector, pass, direction;
    double angle_deg = 0.0;
    std::size_t line = 0;
};

/// Angles agree within 1e-9°, as everywhere in a job.
[[nodiscard]] bool selects(const Exclusion& exclusion, const ExclusionKeys& distance);

/// The key `exclude`: an array of objects with `reason` and at least one of station, reflector, pass, direction,
/// angle_deg and lines.
[[nodiscard]] std::vector<Exclusion> read_exclusions(const JsonDocument& document, const JsonObject& root,
                                                     ProblemList& problems);

}  // namespace gumcert::jobs
