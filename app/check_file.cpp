#include "app/check_file.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "app/read_file.h"
#include "app/recompute_record.h"
#include "engine/job/budget_job.h"
#include "engine/job/comparison_job.h"
#include "engine/job/job_kind.h"
#include "engine/job/rotary_table_job.h"

namespace gumcert::app {

namespace {

namespace fs = std::filesystem;

std::vector<gum::Diagnostic> warnings_of_job(const std::string& kind, const fs::path& file) {
    if (kind == "budget") {
        return engine::read_budget_job(file).warnings;
    }
    return kind == "comparison" ? engine::read_comparison_job(file).warnings
                                : engine::read_rotary_table_job(file).warnings;
}

FileCheck check_job(const fs::path& file) {
    const std::string kind = engine::probable_job_kind(file).value_or("rotary_table");
    FileCheck check{.kind = "job of kind " + kind, .findings = {}};
    try {
        check.findings = warnings_of_job(kind, file);
    } catch (const gum::InputError& refused) {
        check.findings = refused.diagnostics();
    }
    return check;
}

FileCheck check_record(const std::string& text, const std::string& name, unsigned threads, const fs::path& templates,
                       const Progress& progress) {
    FileCheck check{.kind = "record", .findings = {}};
    try {
        const reports::EvaluationRecord record = reports::record_from_json(text, name);
        check.kind = "record of kind " + record.kind;
        if (const std::optional<gum::Diagnostic> why = recompute_record(record, name, threads, templates, progress)) {
            check.findings.push_back(*why);
        }
    } catch (const gum::InputError& refused) {
        check.findings = refused.diagnostics();
    }
    return check;
}

}  // namespace

FileCheck check_file(const fs::path& file, unsigned threads, const fs::path& templates, const Progress& progress) {
    const std::string text = read_file(file);
    const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    const bool is_json = first != std::string::npos && (text[first] == '{' || text[first] == '/');
    if (!is_json) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-CHECK-0001",
                                              .where = file.string(),
                                              .what = "neither a job nor a record",
                                              .rule = "gumcert check reads jobs and records, which are JSON",
                                              .action = "for a digital certificate use gumcert check dcc, for the "
                                                        "signature of a PDF gumcert verify"});
    }
    const bool is_record =
        text.find("\"gumcert/record/") != std::string::npos && text.find("\"gumcert/job/1\"") == std::string::npos;
    const nlohmann::json document = nlohmann::json::parse(text, nullptr, false, /*ignore_comments=*/true);
    const bool says_record = document.is_object() && document.contains("schema") && document["schema"].is_string() &&
                             document["schema"].get<std::string>().starts_with("gumcert/record/");
    return says_record || (document.is_discarded() && is_record)
               ? check_record(text, file.string(), threads, templates, progress)
               : check_job(file);
}

}  // namespace gumcert::app
