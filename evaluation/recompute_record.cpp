#include "evaluation/recompute_record.h"

#include <gumcert_build_info.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "encoding/sha2.h"
#include "evaluation/record_differences.h"
#include "reports/record/make/record_parts.h"
#include "text/lists.h"

namespace gumcert::evaluation {

namespace {

using nlohmann::json;
using reports::EvaluationRecord;
using reports::InputFile;

std::string shown_or_nothing(const json* value) {
    return value == nullptr ? "nothing" : shown_value(*value);
}

/// The places where two records differ as messages, of the first ones.
class Disagreements {
public:
    explicit Disagreements(std::string where) : where_(std::move(where)) {}

    void add(const std::string& pointer, const std::string& stated, const std::string& evaluated) {
        if (found_.size() >= k_most_disagreements) {
            ++left_out_;
            return;
        }
        found_.push_back({.code = "GC-RECORD-0022",
                          .where = where_ + "#" + pointer,
                          .what = stated,
                          .rule = "the job that the record holds gives " + evaluated,
                          .action = "the record was changed after it was written; evaluate the job again"});
    }

    [[nodiscard]] std::vector<gum::Diagnostic> found() && {
        if (left_out_ > 0) {
            found_.push_back({.code = "GC-RECORD-0022",
                              .where = where_,
                              .what = text::count_of(static_cast<std::int64_t>(left_out_), "more place"),
                              .rule = "the first " + std::to_string(k_most_disagreements) + " are listed",
                              .action = "evaluate the job again"});
        }
        return std::move(found_);
    }

private:
    std::string where_;
    std::vector<gum::Diagnostic> found_;
    std::size_t left_out_ = 0;
};

std::string made_by(const reports::Software& software) {
    return software.name + " " + software.version + " (commit " + software.commit + ")";
}

/// As the record was made; where the file has another name, the comparison of the two records finds that.
CovarianceOutput covariance_of(const EvaluationRecord& record) {
    const std::string name = record.rotary       ? record.rotary->covariance_file.value_or("")
                             : record.covariance ? record.covariance->file
                                                 : "";
    const reports::CovarianceForm form = reports::form_of_file(name);
    return {name.empty()                                              ? CovarianceFile::none
            : name == "covariance" + reports::covariance_ending(form) ? CovarianceFile::own_folder
                                                                      : CovarianceFile::with_others,
            form};
}

gum::InputError refusal(const char* code, const std::string& where, std::string what, std::string rule) {
    return gum::InputError(
        gum::Diagnostic{.code = code,
                        .where = where,
                        .what = std::move(what),
                        .rule = std::move(rule),
                        .action = "take the record as the program wrote it, or evaluate its job again"});
}

/// The files of the job, each checked against its digest.
std::map<std::string, std::string> files_of(const EvaluationRecord& record, const std::string& where) {
    std::map<std::string, std::string> files;
    for (std::size_t i = 0; i < record.job_files.size(); ++i) {
        const InputFile& file = record.job_files[i];
        const std::string at = where + "#/job/files/" + std::to_string(i);
        const std::optional<std::string> bytes = reports::bytes_of(file);
        if (!bytes) {
            throw refusal("GC-RECORD-0023", at + "/content", "no Base64", "`encoding` says how the bytes are written");
        }
        if (const std::string own = encoding::sha256(*bytes); own != file.sha256) {
            throw refusal("GC-RECORD-0023", at + "/sha256", file.sha256, "the bytes beside it have the digest " + own);
        }
        if (!files.emplace(file.name, *bytes).second) {
            throw refusal("GC-RECORD-0023", at + "/name", file.name, "a file is listed once");
        }
    }
    return files;
}

}  // namespace

void tell_disagreements(const EvaluationRecord& stated, const EvaluationRecord& evaluated,
                        const DisagreementSink& tell) {
    const std::string a = reports::to_canonical_json(stated);
    const std::string b = reports::to_canonical_json(evaluated);
    if (a == b) {
        return;
    }
    json left = json::parse(a);
    json right = json::parse(b);
    left.erase("digest");  // it follows from the rest
    right.erase("digest");
    tell_differences(left, right, [&tell](const std::string& pointer, const json* one, const json* other) {
        tell(pointer, shown_or_nothing(one), shown_or_nothing(other));
    });
}

std::vector<gum::Diagnostic> disagreements(const EvaluationRecord& stated, const EvaluationRecord& evaluated,
                                           const std::string& where) {
    Disagreements found(where);
    tell_disagreements(stated, evaluated,
                       [&found](const std::string& pointer, const std::string& one, const std::string& other) {
                           found.add(pointer, one, other);
                       });
    return std::move(found).found();
}

std::optional<gum::Diagnostic> not_recomputable(const EvaluationRecord& record, const std::string& where) {
    const auto because = [&](const char* code, const std::string& at, std::string what, std::string rule) {
        return gum::Diagnostic{.code = code,
                               .where = where + "#" + at,
                               .what = std::move(what),
                               .rule = std::move(rule),
                               .action = "evaluate the job again; a draft can be printed with --draft"};
    };
    if (record.software.name != reports::Software().name || record.software.version != k_version ||
        record.software.commit != k_commit) {
        reports::Software own;
        own.version = k_version;
        own.commit = k_commit;
        return because("GC-RECORD-0025", "/software", "the record says that " + made_by(record.software) + " made it",
                       "documents are issued from records that this program, " + made_by(own) + ", evaluates again");
    }
    if (record.digest.empty()) {
        return because("GC-RECORD-0026", "/digest", "missing", "a record of this version states its own digest");
    }
    return files_not_held(record, where);
}

std::optional<gum::Diagnostic> files_not_held(const EvaluationRecord& record, const std::string& where) {
    std::vector<std::string> missing;
    for (const InputFile& file : record.job_files) {
        if (!file.content) {
            missing.push_back(file.name);
        }
    }
    if (missing.empty() && !record.job_files.empty()) {
        return std::nullopt;
    }
    return gum::Diagnostic{
        .code = "GC-RECORD-0027",
        .where = where + "#/job/files",
        .what = record.job_files.empty() ? "none" : "the record does not hold " + text::listed(missing),
        .rule =
            "what a document says is evaluated again from the files of the job, which the record holds up "
            "to 8 MiB each and 16 MiB together",
        .action = "evaluate the job again; a draft can be printed with --draft"};
}

Evaluation evaluation_of(const EvaluationRecord& record, const std::string& where, unsigned threads,
                         const std::filesystem::path& templates, const gum::Progress& progress,
                         std::span<const Kind> kinds) {
    const jobs::MemoryFileSource files(files_of(record, where));
    std::string reason;
    try {
        return evaluate_job(files, record.job_files.front().name, covariance_of(record), threads, templates, progress,
                            kinds);
    } catch (const gum::DiagnosedError& error) {
        const gum::Diagnostic& first = error.diagnostics().front();
        if (first.code == "GC-STORE-0024") {
            throw;  // a limit of time says nothing of the record
        }
        reason = first.where + ": " + first.what;
    }
    throw refusal("GC-RECORD-0024", where + "#/job", "the job cannot be evaluated: " + reason,
                  "a record comes from a job that can be evaluated");
}

EvaluationRecord evaluated_again(const EvaluationRecord& record, const std::string& where, unsigned threads,
                                 const std::filesystem::path& templates, const gum::Progress& progress,
                                 std::span<const Kind> kinds) {
    return evaluation_of(record, where, threads, templates, progress, kinds).record;
}

std::optional<gum::Diagnostic> recompute_record(EvaluationRecord& record, const std::string& where, unsigned threads,
                                                const std::filesystem::path& templates, const gum::Progress& progress,
                                                std::span<const Kind> kinds) {
    if (std::optional<gum::Diagnostic> why = not_recomputable(record, where)) {
        return why;
    }
    EvaluationRecord evaluated = evaluated_again(record, where, threads, templates, progress, kinds);
    std::vector<gum::Diagnostic> found = disagreements(record, evaluated, where);
    if (!found.empty()) {
        throw gum::InputError(std::move(found));
    }
    evaluated.digest = record.digest;
    record = std::move(evaluated);
    return std::nullopt;
}

}  // namespace gumcert::evaluation
