#include "app/recompute_record.h"

#include <gumcert_build_info.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "encoding/sha2.h"
#include "json/canonical_json.h"
#include "json/json_pointer.h"
#include "reports/record/make/record_parts.h"
#include "text/lists.h"
#include "text/utf8.h"

namespace gumcert::app {

namespace {

using nlohmann::json;
using reports::EvaluationRecord;
using reports::InputFile;

constexpr double k_same_number = 1e-9;
constexpr double k_nothing_beside = 1e-12;  // of the largest number of a list
constexpr std::size_t k_longest_text = 120;

/// A value as a message shows it.
std::string shown(const json& value) {
    if (value.is_structured()) {
        return value.is_array() ? "a list of " + std::to_string(value.size()) : "an object";
    }
    std::string text = gumcert::json::canonical_json(value);
    text.pop_back();
    if (text.size() > k_longest_text) {
        std::size_t end = k_longest_text;
        while (end > 0 && text::is_continuation(text[end])) {
            --end;
        }
        text = text.substr(0, end) + "…";
    }
    return text;
}

double largest_in(const json& list) {
    double largest = 0.0;
    for (const json& item : list) {
        largest = item.is_number() ? std::max(largest, std::abs(item.get<double>())) : largest;
    }
    return largest;
}

/// A square matrix with a diagonal that is not negative: of covariances, whose rows have different units.
bool is_covariance(const json& list) {
    bool is = list.size() > 1;
    for (std::size_t i = 0; is && i < list.size(); ++i) {
        is = list[i].is_array() && list[i].size() == list.size() && list[i][i].is_number() &&
             list[i][i].get<double>() >= 0.0;
    }
    return is;
}

/// Walks two JSON values side by side.
class Comparison {
public:
    explicit Comparison(std::string where) : where_(std::move(where)) {}

    /// \param scale  of the list that the values stand in; 0 outside of one
    void compare(const json& stated, const json& evaluated, const std::string& pointer, double scale = 0.0) {
        if (stated.is_number() && evaluated.is_number()) {
            const double a = stated.get<double>();
            const double b = evaluated.get<double>();
            const double allowed =
                std::max(k_same_number * std::max(std::abs(a), std::abs(b)), k_nothing_beside * scale);
            if (!(std::abs(a - b) <= allowed)) {
                differs(pointer, shown(stated), shown(evaluated));
            }
        } else if (stated.is_object() && evaluated.is_object()) {
            for (const auto& [key, item] : stated.items()) {
                const std::string at = pointer + "/" + gumcert::json::pointer_token(key);
                if (const auto other = evaluated.find(key); other != evaluated.end()) {
                    compare(item, *other, at);
                } else {
                    differs(at, shown(item), "nothing");
                }
            }
            for (const auto& [key, item] : evaluated.items()) {
                if (!stated.contains(key)) {
                    differs(pointer + "/" + gumcert::json::pointer_token(key), "nothing", shown(item));
                }
            }
        } else if (stated.is_array() && evaluated.is_array() && stated.size() == evaluated.size()) {
            if (is_covariance(evaluated)) {
                compare_covariance(stated, evaluated, pointer);
                return;
            }
            const double within = largest_in(evaluated);
            for (std::size_t i = 0; i < stated.size(); ++i) {
                compare(stated[i], evaluated[i], pointer + "/" + std::to_string(i), within);
            }
        } else if (stated != evaluated) {
            differs(pointer, shown(stated), shown(evaluated));
        }
    }

    [[nodiscard]] std::vector<gum::Diagnostic> found() && {
        if (left_out_ > 0) {
            found_.push_back({.code = "GC-RECORD-0022",
                              .where = where_,
                              .what = std::to_string(left_out_) + " more places",
                              .rule = "the first " + std::to_string(k_most_disagreements) + " are listed",
                              .action = "evaluate the job again"});
        }
        return std::move(found_);
    }

private:
    std::string where_;
    std::vector<gum::Diagnostic> found_;
    std::size_t left_out_ = 0;

    void compare_covariance(const json& stated, const json& evaluated, const std::string& pointer) {
        for (std::size_t i = 0; i < stated.size(); ++i) {
            const std::string row = pointer + "/" + std::to_string(i);
            if (!stated[i].is_array() || stated[i].size() != stated.size()) {
                differs(row, shown(stated[i]), shown(evaluated[i]));
                continue;
            }
            for (std::size_t j = 0; j < stated.size(); ++j) {
                const double u = std::sqrt(evaluated[i][i].get<double>() * evaluated[j][j].get<double>());
                compare(stated[i][j], evaluated[i][j], row + "/" + std::to_string(j), u);
            }
        }
    }

    void differs(const std::string& pointer, const std::string& stated, const std::string& evaluated) {
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

std::vector<gum::Diagnostic> disagreements(const EvaluationRecord& stated, const EvaluationRecord& evaluated,
                                           const std::string& where) {
    const std::string a = reports::to_canonical_json(stated);
    const std::string b = reports::to_canonical_json(evaluated);
    if (a == b) {
        return {};
    }
    json left = json::parse(a);
    json right = json::parse(b);
    left.erase("digest");  // it follows from the rest
    right.erase("digest");
    Comparison comparison(where);
    comparison.compare(left, right, "");
    return std::move(comparison).found();
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
    std::vector<std::string> missing;
    for (const InputFile& file : record.job_files) {
        if (!file.content) {
            missing.push_back(file.name);
        }
    }
    if (!missing.empty() || record.job_files.empty()) {
        return because("GC-RECORD-0027", "/job/files",
                       record.job_files.empty() ? "none" : "the record does not hold " + text::listed(missing),
                       "what a document says is evaluated again from the files of the job, which the record holds up "
                       "to 8 MiB each and 16 MiB together");
    }
    return std::nullopt;
}

EvaluationRecord evaluated_again(const EvaluationRecord& record, const std::string& where, unsigned threads,
                                 const std::filesystem::path& templates, const gum::Progress& progress,
                                 std::span<const Kind> kinds) {
    const jobs::MemoryFileSource files(files_of(record, where));
    std::string reason;
    try {
        return evaluate_job(files, record.job_files.front().name, covariance_of(record), threads, templates, progress,
                            kinds)
            .record;
    } catch (const gum::DiagnosedError& error) {
        const gum::Diagnostic& first = error.diagnostics().front();
        reason = first.where + ": " + first.what;
    }
    throw refusal("GC-RECORD-0024", where + "#/job", "the job cannot be evaluated: " + reason,
                  "a record comes from a job that can be evaluated");
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

}  // namespace gumcert::app
