#pragma once

#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/job_files.h"
#include "jobs/json_object.h"
#include "jobs/laboratory/register_reader.h"
#include "laboratory/standard_record.h"

namespace gumcert::jobs {

/// The folder of the laboratory that a job draws on: laboratory.json, standards/ID.json, methods/ID.json,
/// customers/ID.json. A file is read when it is asked for, once, and is one of the files of the job then. What is wrong in
/// it is in its list of problems.
class LaboratoryFolder {
public:
    /// The folder that the caller of the reader named, else the one under the key `laboratory` of the job.
    /// \return nothing where there is none
    [[nodiscard]] static std::optional<LaboratoryFolder> of_job(JobFiles& files, const JsonDocument& job,
                                                                ProblemList& problems);

    /// Whether a text can be an identification: it is the name of a file.
    [[nodiscard]] static bool is_identification(std::string_view id);

    /// Null where the file was refused.
    [[nodiscard]] const LaboratoryFile* laboratory();
    /// Null where it was refused, or where there is none and it need not be there.
    [[nodiscard]] const laboratory::StandardRecord* standard(const std::string& id, bool must_be_there = true);
    /// An object `customer` or `method` of certificate data; null where it was refused.
    [[nodiscard]] const nlohmann::json* customer(const std::string& id);
    [[nodiscard]] const nlohmann::json* method(const std::string& id);
    /// What is in a part of the folder ("standards", "customers", "methods") in place of an identification that it does not
    /// have; nothing where it has it, or where the folder itself is not there: what cannot be read is told then.
    [[nodiscard]] std::optional<std::vector<std::string>> others_than(const std::string& part,
                                                                      const std::string& id) const;
    /// The name of a file of the folder as the job would give it.
    [[nodiscard]] std::string name_of(const std::string& file) const { return prefix_ + file; }

private:
    LaboratoryFolder(JobFiles& files, std::string prefix) : files_(&files), prefix_(std::move(prefix)) {}

    template <class Struct>
    const nlohmann::json* object(const std::string& name);
    /// \return nothing where it cannot be read to the end
    std::optional<JsonDocument> document(const JobFiles::File& file);

    JobFiles* files_;
    std::string prefix_;
    std::optional<std::optional<LaboratoryFile>> laboratory_;
    std::map<std::string, std::optional<laboratory::StandardRecord>> standards_;
    std::map<std::string, nlohmann::json> objects_;  ///< by the name of the file; discarded: refused
};

}  // namespace gumcert::jobs
