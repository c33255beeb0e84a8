#include "evaluation/check_file.h"

#include <optional>
#include <system_error>
#include <utility>

#include "evaluation/read_file.h"
#include "evaluation/recompute_record.h"
#include "jobs/file_source.h"
#include "jobs/job_kind.h"
#include "jobs/laboratory/register_reader.h"
#include "outputs/output_set.h"
#include "text/file_guess.h"

namespace gumcert::evaluation {

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

FileCheck check_text(const std::string& text, const fs::path& file, unsigned threads, const fs::path& templates,
                     const gum::Progress& progress, const fs::path& laboratory) {
    if (!text::begins_as_json_object(text)) {
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
    // What is wrong with the text, the reader of what it begins as says.
    const std::string schema = text::outermost_string(text, "schema").value_or("");
    if (schema.starts_with("gumcert/record/")) {
        return check_record(text, file.string(), threads, templates, progress);
    }
    if (schema == jobs::k_standard_schema_word || schema == jobs::k_laboratory_schema_word) {
        return check_register_file(text, file.string(), schema == jobs::k_standard_schema_word);
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
        return {.kind = "folder of outputs", .findings = outputs::check_sets(file)};
    }
    const std::string text = read_file(file);
    FileCheck check = check_text(text, file, threads, templates, progress, laboratory);
    for (gum::Diagnostic& doubt : outputs::doubts_about_set(file, text)) {
        check.findings.push_back(std::move(doubt));
    }
    return check;
}

}  // namespace gumcert::evaluation
