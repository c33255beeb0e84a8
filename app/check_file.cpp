#include "app/check_file.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "app/output_set.h"
#include "app/read_file.h"
#include "app/recompute_record.h"
#include "jobs/file_source.h"
#include "jobs/job_kind.h"
#include "jobs/laboratory/register_reader.h"
#include "json/strict_parser.h"
#include "text/file_guess.h"

namespace gumcert::app {

namespace {

namespace fs = std::filesystem;

FileCheck check_job(const jobs::FileSource& files, const std::string& name) {
    const std::optional<std::string> stated = jobs::probable_job_kind(files, name);
    const std::string word = stated.value_or("");
    FileCheck check{.kind = stated ? "job of kind " + word : "job without a kind", .findings = {}};
    try {
        if (const Kind* const kind = find_kind(program_kinds(), word)) {
            check.findings = kind->read(files, name);
        } else {
            (void)jobs::job_kind(files, name);  // its message lists the kinds there are
        }
    } catch (const gum::InputError& refused) {
        check.findings = refused.diagnostics();
    }
    return check;
}

FileCheck check_record(const std::string& text, const std::string& name, unsigned threads, const fs::path& templates,
                       const gum::Progress& progress) {
    FileCheck check{.kind = "record", .findings = {}};
    try {
        reports::EvaluationRecord record = reports::record_from_json(text, name);
        check.kind = "record of kind " + record.kind;
        if (const std::optional<gum::Diagnostic> why = recompute_record(record, name, threads, templates, progress)) {
            check.findings.push_back(*why);
        }
    } catch (const gum::InputError& refused) {
        check.findings = refused.diagnostics();
    }
    return check;
}

FileCheck check_register_file(const std::string& text, const std::string& name, bool is_standard) {
    FileCheck check{.kind = is_standard ? "standard of a laboratory" : "data of a laboratory", .findings = {}};
    jobs::ProblemList problems(name);
    if (const auto document = jobs::read_json_document(text, problems); document && is_standard) {
        (void)jobs::read_standard(*document, problems);
    } else if (document) {
        (void)jobs::read_laboratory(*document, problems);
    }
    check.findings = problems.refused();
    return check;
}

}  // namespace

namespace {

FileCheck check_text(const std::string& text, const fs::path& file, unsigned threads, const fs::path& templates,
                     const gum::Progress& progress, const fs::path& laboratory) {
    const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    const bool is_json = first != std::string::npos && (text[first] == '{' || text[first] == '/');
    if (!is_json) {
        const std::optional<text::FileGuess> guess = text::guess_file(text);
        throw gum::InputError(gum::Diagnostic{.code = "GC-CHECK-0001",
                                              .where = file.string(),
                                              .what = guess ? "it is " + guess->what + ", neither a job nor a record"
                                                            : std::string("neither a job nor a record"),
                                              .rule = "gumcert check reads jobs and records, which are JSON",
                                              .action = guess ? guess->action
                                                              : "for a digital certificate use gumcert check dcc, for "
                                                                "the signature of a PDF gumcert verify"});
    }
    const bool is_record =
        text.find("\"gumcert/record/") != std::string::npos && text.find("\"gumcert/job/1\"") == std::string::npos;
    // What is wrong with the text, the reader of the record or the job says.
    const std::optional<nlohmann::json> document = json::parse(text,
                                                               {.string_bytes = text.size(),
                                                                .values = text.size(),
                                                                .comments = true,
                                                                .byte_order_mark = true,
                                                                .long_integers = true},
                                                               [](const gumcert::json::ParsingProblem&) {});
    const bool says_record = document && document->is_object() && document->contains("schema") &&
                             (*document)["schema"].is_string() &&
                             (*document)["schema"].get<std::string>().starts_with("gumcert/record/");
    if (says_record || (!document && is_record)) {
        return check_record(text, file.string(), threads, templates, progress);
    }
    if (document && document->is_object() && document->contains("schema")) {
        const nlohmann::json& schema = (*document)["schema"];
        if (schema == jobs::k_standard_schema_word || schema == jobs::k_laboratory_schema_word) {
            return check_register_file(text, file.string(), schema == jobs::k_standard_schema_word);
        }
    }
    const jobs::DiskFileSource disk = jobs::DiskFileSource::of_job(file, laboratory);
    const jobs::ReadOnceSource files(disk);
    const std::string name = file.filename().string();
    jobs::require_job_file(files, name);
    return check_job(files, name);
}

}  // namespace

FileCheck check_file(const fs::path& file, unsigned threads, const fs::path& templates, const gum::Progress& progress,
                     const fs::path& laboratory) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
        return {.kind = "folder of outputs", .findings = check_sets(file)};
    }
    const std::string text = read_file(file);
    FileCheck check = check_text(text, file, threads, templates, progress, laboratory);
    for (gum::Diagnostic& doubt : doubts_about_set(file, text)) {
        check.findings.push_back(std::move(doubt));
    }
    return check;
}

}  // namespace gumcert::app
