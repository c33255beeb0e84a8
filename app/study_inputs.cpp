#include "app/study_inputs.h"

#include "jobs/rotary_table/rotary_table_job.h"

namespace gumcert::app {

std::vector<std::filesystem::path> study_inputs(const std::filesystem::path& job_file) {
    std::vector<std::filesystem::path> files;
    for (const std::string& name : jobs::read_rotary_table_job(job_file, jobs::JobUse::plan).files) {
        files.push_back(job_file.parent_path() / name);
    }
    return files;
}

}  // namespace gumcert::app
