#include "jobs/laboratory/laboratory_folder.h"

#include <algorithm>
#include <utility>

#include "jobs/certificate/certificate_archive.h"
#include "jobs/laboratory/laboratory_codes.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

constexpr std::size_t k_longest_identification = 100;  // [byte]

}  // namespace

std::optional<LaboratoryFolder> LaboratoryFolder::of_job(JobFiles& files, const JsonDocument& job,
                                                         ProblemList& problems) {
    if (std::optional<std::string> prefix = files.laboratory()) {
        return LaboratoryFolder(files, std::move(*prefix));
    }
    if (!job.value.is_object()) {
        return std::nullopt;
    }
    const auto found = job.value.find("laboratory");
    if (found == job.value.end() || found->is_discarded()) {
        return std::nullopt;
    }
    const CertificatePlace place{&job, "/laboratory", &problems};
    if (!found->is_string()) {
        refuse_type(*found, "the name of a folder", place);
        return std::nullopt;
    }
    const auto& name = found->get_ref<const std::string&>();
    if (!acceptable_text(name, certificate::TextForm::file, place)) {
        return std::nullopt;
    }
    return LaboratoryFolder(files, name.ends_with('/') ? name : name + "/");
}

bool LaboratoryFolder::is_identification(std::string_view id) {
    return !id.empty() && id.size() <= k_longest_identification && id.front() != '.' &&
           std::all_of(id.begin(), id.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
                      c == '_' || c == '.';
           });
}

std::optional<JsonDocument> LaboratoryFolder::document(const JobFiles::File& file) {
    std::optional<JsonDocument> document = read_json_document(file.bytes, *file.problems);
    return document && !document->value.is_discarded() ? std::move(document) : std::nullopt;
}

const LaboratoryFile* LaboratoryFolder::laboratory() {
    if (!laboratory_) {
        laboratory_.emplace();
        if (const std::optional<JobFiles::File> file = files_->open(name_of("laboratory.json"))) {
            if (const std::optional<JsonDocument> read = document(*file)) {
                *laboratory_ = read_laboratory(*read, *file->problems);
            }
        }
    }
    return *laboratory_ ? &**laboratory_ : nullptr;
}

const laboratory::StandardRecord* LaboratoryFolder::standard(const std::string& id, bool must_be_there) {
    const auto known = standards_.find(id);
    if (known != standards_.end()) {
        return known->second ? &*known->second : nullptr;
    }
    const std::string name = name_of("standards/" + id + ".json");
    const std::optional<JobFiles::File> file = must_be_there ? files_->open(name) : files_->open_if_there(name);
    if (!file && !must_be_there) {
        return nullptr;
    }
    std::optional<laboratory::StandardRecord>& record = standards_[id];
    const std::optional<JsonDocument> read = file ? document(*file) : std::nullopt;
    if (read) {
        record = read_standard(*read, *file->problems);
        if (record && record->id != id) {
            file->problems->refuse(
                k_laboratory_id, read->where("/id"), text::in_quotes(record->id),
                "the file of a standard has its identification as name, and this one is " + text::in_quotes(id),
                "rename the file, or correct the identification");
            record.reset();
        }
    }
    return record ? &*record : nullptr;
}

std::optional<std::vector<std::string>> LaboratoryFolder::others_than(const std::string& part,
                                                                      const std::string& id) const {
    std::vector<std::string> names = files_->json_files(name_of(part + "/"));
    const bool is_there = std::find(names.begin(), names.end(), id) != names.end() ||
                          files_->peek(name_of(part + "/" + id + ".json")).has_value();
    const bool has_folder = !names.empty() || files_->peek(name_of("laboratory.json")).has_value();
    return is_there || !has_folder ? std::nullopt : std::optional(std::move(names));
}

template <class Struct>
const nlohmann::json* LaboratoryFolder::object(const std::string& name) {
    const auto [entry, is_new] = objects_.try_emplace(name, nlohmann::json::value_t::discarded);
    if (is_new) {
        const std::optional<JobFiles::File> file = files_->open(name_of(name));
        const std::optional<JsonDocument> read = file ? document(*file) : std::nullopt;
        if (read) {
            const std::size_t before = file->problems->refusals();
            Struct checked;
            CertificateArchive::read_struct_at(checked, {&*read, "", file->problems});
            if (file->problems->refusals() == before) {
                entry->second = read->value;
            }
        }
    }
    return entry->second.is_discarded() ? nullptr : &entry->second;
}

const nlohmann::json* LaboratoryFolder::customer(const std::string& id) {
    return object<certificate::Customer>("customers/" + id + ".json");
}

const nlohmann::json* LaboratoryFolder::method(const std::string& id) {
    return object<certificate::Method>("methods/" + id + ".json");
}

}  // namespace gumcert::jobs
