#include "evaluation/study_job.h"

namespace gumcert::evaluation {

StudyJob::StudyJob(const std::filesystem::path& file, jobs::JobUse use)
    : file_(file),
      disk_(jobs::DiskFileSource::of_job(file)),
      files_(disk_),
      job_(jobs::read_rotary_table_job(files_, name(), use)) {}

std::vector<std::filesystem::path> StudyJob::inputs() const {
    std::vector<std::filesystem::path> paths;
    for (const std::string& name : job_.files) {
        paths.push_back(file_.parent_path() / name);
    }
    return paths;
}

}  // namespace gumcert::evaluation
