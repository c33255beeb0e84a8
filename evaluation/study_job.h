#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/evaluation_task.h"
#include "jobs/file_source.h"
#include "jobs/rotary_table/rotary_table_job.h"

namespace gumcert::evaluation {

/// A job of kind `rotary_table` of which a study is made, a plan or a simulation. Each of its files is read once.
class StudyJob {
public:
    /// \throws gum::InputError, gum::StorageError  those of its reader
    explicit StudyJob(const std::filesystem::path& file, jobs::JobUse use = jobs::JobUse::plan);

    [[nodiscard]] const jobs::RotaryTableJob& job() const { return job_; }
    [[nodiscard]] std::string name() const { return file_.filename().string(); }  ///< for documents
    [[nodiscard]] ReadJob read() const { return {.files = files_, .names = job_.files}; }
    /// Paths of its files beside the job: none of them may be written over.
    [[nodiscard]] std::vector<std::filesystem::path> inputs() const;

private:
    std::filesystem::path file_;
    jobs::DiskFileSource disk_;
    jobs::ReadOnceSource files_;
    jobs::RotaryTableJob job_;
};

}  // namespace gumcert::evaluation
