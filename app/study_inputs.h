#pragma once

#include <filesystem>
#include <vector>

namespace gumcert::app {

/// The files that a study of a rotary-table job reads, as paths beside the job: none of them may be written over.
[[nodiscard]] std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& job_file);

}  // namespace gumcert::app
