#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/rotary_table/machine_frame.h"
#include "jobs/job_files.h"
#include "jobs/job_kind.h"
#include "jobs/json_object.h"

namespace gumcert::jobs {

/// The key `machine_frame` without its file.
struct MachineFrameRequest {
    engine::MachineFrame frame;  ///< without points
    std::optional<std::string> coordinates;
    std::string where;
};

/// \return nothing when the key is absent or was refused
[[nodiscard]] std::optional<MachineFrameRequest> read_machine_frame(const JsonObject& root);

/// Reads the coordinates: a row for each of at least 3 reflectors or stations of the measurement.
/// \param names  of the reflectors or stations of the measurement, in its order
/// \return nothing when anything was refused
[[nodiscard]] std::optional<engine::MachineFrame> read_machine_points(MachineFrameRequest request, JobFiles::File file,
                                                                      const std::vector<std::string>& names);

}  // namespace gumcert::jobs
