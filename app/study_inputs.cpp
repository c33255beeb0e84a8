#include "app/study_inputs.h"

#include "engine/job/rotary_table_job.h"

namespace gumcert::app {

std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& job_file) {
    std::vector<std::filesystem::path> files;
    for (const std::string& name : engine::read_rotary_table_job(job_file, engine::JobUse::plan).files) {
        files.push_back(job_file.parent_path() / name);
    }
    return files;
}

}  // namespace gumcert::app
