#include "jobs/job_kind.h"

#include <algorithm>
#include <string>

#include "jobs/json_object.h"
#include "text/file_guess.h"
#include "text/lists.h"
#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

constexpr std::string_view k_schema = "gumcert/job/1";

/// What a file is where it is of another kind; nothing of a job, and of what nobody knows.
std::optional<text::FileGuess> other_file(std::string_view bytes) {
    const std::string schema = text::outermost_string(bytes, "schema").value_or("");
    if (schema.starts_with("gumcert/job/") || (schema.empty() && text::outermost_string(bytes, "kind"))) {
        return std::nullopt;
    }
    return text::guess_file(bytes);
}

}  // namespace

std::optional<std::string> read_kind(const JsonDocument& document, ProblemList& problems,
                                     std::span<const std::string_view> kinds) {
    if (!document.value.is_object()) {
        (void)JsonObject::root(document, {}, problems);
        return std::nullopt;
    }
    const auto text_of = [&](const char* key, std::string_view expected) -> std::optional<std::string> {
        const auto found = document.value.find(key);
        if (found == document.value.end()) {
            problems.refuse(k_missing_key, document.where(""), "the key " + text::in_quotes(key) + " is missing",
                            "the key is required", "add " + text::in_quotes(key) + ": " + std::string{expected});
            return std::nullopt;
        }
        if (found->is_discarded()) {
            return std::nullopt;
        }
        if (!found->is_string()) {
            problems.refuse(k_wrong_type, document.where(child_pointer("", key)), described(*found), "must be a string",
                            "write " + std::string{expected});
            return std::nullopt;
        }
        return found->get<std::string>();
    };
    const std::optional<std::string> schema = text_of("schema", "\"gumcert/job/1\"");
    if (schema && *schema != k_schema) {
        problems.refuse(k_wrong_schema, document.where("/schema"), text::in_quotes(*schema),
                        "must be \"gumcert/job/1\"",
                        "check that the file is a job, and which version of the program it is for");
    }
    const std::optional<std::string> kind = text_of("kind", "the kind of the job");
    if (kind && std::find(kinds.begin(), kinds.end(), *kind) == kinds.end()) {
        const std::optional<std::string_view> nearest = nearest_word(*kind, kinds);
        problems.refuse(k_wrong_kind, document.where("/kind"), text::in_quotes(*kind), "must be " + text::any_of(kinds),
                        nearest ? "did you mean \"" + std::string{*nearest} + "\"?" : "choose one of them");
        return std::nullopt;
    }
    return kind;
}

void require_job_file(const FileSource& source, const std::string& job_file) {
    if (!text::is_utf8(job_file)) {
        const std::string shown = text::visible(job_file);
        ProblemList problems(shown);
        problems.refuse(k_not_utf8, shown, "the name of the file is not UTF-8",
                        "the record holds the names of its files, and its texts are UTF-8", "rename the file");
        throw gum::InputError(problems.refused());
    }
    if (const auto other = other_file(source.read(job_file))) {
        ProblemList problems(job_file);
        problems.refuse(k_wrong_schema, job_file, "it is " + other->what + ", and no job",
                        "a job is JSON with \"schema\": \"gumcert/job/1\" and its kind", other->action);
        throw gum::InputError(problems.refused());
    }
}

std::string job_kind(const FileSource& source, const std::string& job_file, std::span<const std::string_view> kinds) {
    ProblemList problems(job_file);
    const std::string bytes = source.read(job_file);
    const std::optional<JsonDocument> document = read_json_document(bytes, problems);
    const std::optional<std::string> kind = document ? read_kind(*document, problems, kinds) : std::nullopt;
    if (problems.refusals() > 0) {
        throw gum::InputError(problems.refused());
    }
    return kind.value();
}

std::optional<std::string> probable_job_kind(const FileSource& source, const std::string& name,
                                             std::span<const std::string_view> kinds) {
    ProblemList problems(name);
    const std::string bytes = source.read(name);
    const std::optional<JsonDocument> document = read_json_document(bytes, problems);
    if (document && document->value.is_object() && document->value.contains("kind") &&
        document->value["kind"].is_string()) {
        return document->value["kind"].get<std::string>();
    }
    // The text ends before its end, or is none: the first kind that is named in it.
    const std::size_t key = bytes.find("\"kind\"");
    for (const std::string_view kind : kinds) {
        if (key != std::string::npos && bytes.find('"' + std::string(kind) + '"', key) < bytes.find(',', key)) {
            return std::string(kind);
        }
    }
    return std::nullopt;
}

std::optional<std::string> probable_job_kind(const std::filesystem::path& job_file) {
    return probable_job_kind(DiskFileSource::of_job(job_file), job_file.filename().string());
}

std::string job_kind(const std::filesystem::path& job_file) {
    return job_kind(DiskFileSource::of_job(job_file), job_file.filename().string());
}

void read_unused_texts(const JsonObject& root) {
    (void)root.optional_string("$schema");
    (void)root.optional_string("notes");
}

}  // namespace gumcert::jobs
