#include "jobs/job_files.h"
#include "jobs/csv_table.h"
#include "text/csv_field.h"
#include "text/visible_text.h"

#include <algorithm>
#include <utility>

namespace gumcert::jobs {

JobFiles::JobFiles(const FileSource& source, const std::string& job_file)
    : source_(source), folder_(job_file.substr(0, job_file.rfind('/') + 1)) {
    names_.push_back(job_file);
    problems_.emplace_back(job_file);
}

JobFiles::File JobFiles::job() {
    return {source_.read(names_.front()), &problems_.front()};
}

std::optional<JobFiles::File> JobFiles::open(const std::string& name_in_job) {
    const std::string name = name_in_source(name_in_job);
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
        names_.push_back(name);
    }
    ProblemList& problems = problems_.emplace_back(name);
    try {
        return File{source_.read(name), &problems};
    } catch (const gum::StorageError& error) {
        for (gum::Diagnostic told : error.diagnostics()) {
            const std::string place = place_of(name_in_job);
            told.what += place.empty() ? "" : "; it is named at " + place;
            not_readable_.push_back(std::move(told));
        }
        return std::nullopt;
    }
}

std::string JobFiles::place_of(const std::string& name_in_job) const {
    // Only for the message: readers ask for a file by its name, and not where they have it from.
    const std::optional<std::string> bytes = peek_source(names_.front());
    ProblemList unused(names_.front());
    const std::optional<JsonDocument> document = bytes ? read_json_document(*bytes, unused) : std::nullopt;
    if (!document) {
        return "";
    }
    // A standard is named by its identification, and the file of the laboratory itself by the folder.
    const auto names_it = [&](const std::string& text) {
        return text == name_in_job || (!text.empty() && (name_in_job.ends_with("/" + text + ".json") ||
                                                         name_in_job == text + "/laboratory.json"));
    };
    std::vector<std::pair<const nlohmann::json*, std::string>> open{{&document->value, ""}};
    while (!open.empty()) {
        const auto [value, pointer] = open.back();
        open.pop_back();
        if (value->is_string() && names_it(value->get_ref<const std::string&>())) {
            return document->where(pointer);
        }
        if (value->is_object()) {
            for (const auto& [key, part] : value->items()) {
                open.emplace_back(&part, child_pointer(pointer, key));
            }
        } else if (value->is_array()) {
            for (std::size_t i = 0; i < value->size(); ++i) {
                open.emplace_back(&(*value)[i], child_pointer(pointer, i));
            }
        }
    }
    return "";
}

std::string JobFiles::name_in_source(const std::string& name_in_job) const {
    return name_in_job.starts_with(k_laboratory_prefix) && source_.has_laboratory() ? name_in_job
                                                                                    : folder_ + name_in_job;
}

std::optional<std::string> JobFiles::peek(const std::string& name_in_job) const {
    return peek_source(name_in_source(name_in_job));
}

std::optional<std::string> JobFiles::peek_source(const std::string& name_in_source) const {
    try {
        return source_.read(name_in_source);
    } catch (const gum::StorageError&) {
        return std::nullopt;
    }
}

std::optional<JobFiles::File> JobFiles::open_if_there(const std::string& name_in_job) {
    return peek(name_in_job) ? open(name_in_job) : std::nullopt;
}

std::vector<std::string> JobFiles::json_files(const std::string& folder) const {
    return source_.json_files(name_in_source(folder));
}

std::optional<std::string> JobFiles::laboratory() const {
    return source_.has_laboratory() ? std::optional<std::string>(k_laboratory_prefix) : std::nullopt;
}

std::optional<std::string> JobFiles::file_name_objection(std::string_view name) {
    const bool has_drive = name.size() > 1 && name[1] == ':';
    if (name.empty() || name.front() == '/' || has_drive || name.find('\\') != std::string_view::npos) {
        return "file names are relative to the job file and have / between folders";
    }
    return std::nullopt;
}

std::optional<std::string> JobFiles::file_name(const JsonObject& object, std::string_view key, bool required) {
    const std::optional<std::string> name =
        required ? object.required_name(key, 4096) : object.optional_name(key, 4096);
    if (!name) {
        return std::nullopt;
    }
    if (const auto objection = file_name_objection(*name)) {
        object.refuse(k_file_name, key, "the file name " + text::in_quotes(*name), *objection,
                      "put the file beside the job and give its name");
        return std::nullopt;
    }
    return name;
}

void JobFiles::add(const std::vector<std::string>& names, const std::vector<gum::Diagnostic>& warnings) {
    for (const std::string& name : names) {
        if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
            names_.push_back(name);
        }
    }
    warnings_elsewhere_.insert(warnings_elsewhere_.end(), warnings.begin(), warnings.end());
}

void JobFiles::add(const gum::InputError& error) {
    refused_elsewhere_.insert(refused_elsewhere_.end(), error.diagnostics().begin(), error.diagnostics().end());
}

void JobFiles::add(const gum::StorageError& error) {
    not_readable_.insert(not_readable_.end(), error.diagnostics().begin(), error.diagnostics().end());
}

void JobFiles::refuse_if_needed() const {
    std::vector<gum::Diagnostic> refused = not_readable_;
    for (const ProblemList& list : problems_) {
        const std::vector<gum::Diagnostic> of_file = list.refused();
        refused.insert(refused.end(), of_file.begin(), of_file.end());
    }
    refused.insert(refused.end(), refused_elsewhere_.begin(), refused_elsewhere_.end());
    if (!not_readable_.empty()) {
        throw gum::StorageError(std::move(refused));
    }
    if (!refused.empty()) {
        throw gum::InputError(std::move(refused));
    }
}

std::vector<gum::Diagnostic> JobFiles::warnings() const {
    std::vector<gum::Diagnostic> all;
    for (const ProblemList& list : problems_) {
        const std::vector<gum::Diagnostic> of_file = list.warnings();
        all.insert(all.end(), of_file.begin(), of_file.end());
    }
    all.insert(all.end(), warnings_elsewhere_.begin(), warnings_elsewhere_.end());
    return all;
}

std::vector<CsvHeaderField> csv_header(std::string_view bytes) {
    if (bytes.starts_with("\xEF\xBB\xBF")) {
        bytes.remove_prefix(3);
    }
    const std::optional<text::SeparatorLine> separator_stated = text::separator_line(bytes);
    std::size_t start = separator_stated ? separator_stated->length : 0;
    while (start < bytes.size() && (bytes[start] == '\n' || bytes[start] == '\r')) {
        ++start;
    }
    const char separator = csv_separator(bytes);
    text::PlaceFinder finder(bytes);
    std::vector<CsvHeaderField> fields;
    for (std::size_t i = start; i < bytes.size();) {
        CsvHeaderField field{{}, finder.at(i)};
        if (bytes[i] == '"') {
            for (++i; i < bytes.size() && (bytes[i] != '"' || bytes.substr(i, 2) == "\"\""); ++i) {
                field.name += bytes[i];
                i += bytes[i] == '"' ? 1U : 0U;
            }
            ++i;
        }
        for (; i < bytes.size() && bytes[i] != separator && bytes[i] != '\n' && bytes[i] != '\r'; ++i) {
            field.name += bytes[i];
        }
        fields.push_back(std::move(field));
        if (i >= bytes.size() || bytes[i] != separator) {
            break;
        }
        if (++i == bytes.size()) {
            fields.push_back({{}, finder.at(i)});
        }
    }
    // What is no text, or is separated otherwise, has no names that could be right or wrong: read_csv_table says so.
    ProblemList not_told("");
    const std::size_t end = std::min(bytes.find_first_of("\r\n", start), bytes.size());
    const bool is_text = check_text(bytes.substr(0, end), not_told).has_value();
    const bool is_separated =
        separator_stated || fields.size() != 1 || fields.front().name.find_first_of(";\t|") == std::string::npos;
    return is_text && is_separated ? fields : std::vector<CsvHeaderField>();
}

std::vector<std::string> keys_in_order(const JsonDocument& document, const std::string& pointer) {
    std::vector<std::pair<std::size_t, std::string>> keys;
    for (const auto& [key, value] : document.value.at(nlohmann::json::json_pointer(pointer)).items()) {
        const auto place = document.places.find(child_pointer(pointer, key));
        keys.emplace_back(place == document.places.end() ? 0 : place->second.offset, key);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::string> names;
    names.reserve(keys.size());
    for (auto& key : keys) {
        names.push_back(std::move(key.second));
    }
    return names;
}

}  // namespace gumcert::jobs
