#include "archive/certificates/affected_certificates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "archive/certificates/archive_files.h"
#include "archive/certificates/report_changes.h"
#include "archive/certificates/texts_of_records.h"
#include "certificate/text_words.h"
#include "evaluation/recompute_record.h"
#include "gum/monte_carlo/worker_threads.h"
#include "jobs/file_source.h"
#include "json/canonical_json.h"
#include "json/members.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/render.h"
#include "reports/record/make/certificate/amended_record.h"
#include "reports/record/record_value.h"
#include "reports/wording.h"
#include "text/csv_field.h"
#include "text/lists.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

// Bounds the memory: so many are worked at, and as many are read meanwhile.
constexpr std::size_t k_records_at_once = 256;

constexpr const char* k_withdrawn = "withdrawn";
constexpr const char* k_text = "text";  // kind of a change, as reports::changes_between() has it

/// How something is done beside the work of some threads: where one alone is wanted, afterwards.
std::launch beside(const gum::WorkerThreads& threads) {
    return threads.size() > 1 ? std::launch::async : std::launch::deferred;
}

bool is_before_issue(const std::string& state) {
    return state == "drafted" || state == "reviewed" || state == "authorised";
}

/// A record that was read, without its bytes.
struct SearchedRecord {
    ListedCertificate certificate;
    std::optional<RecordReferences> references;  ///< none: it cannot be read
};

/// Reads all records of an archive, and what they rest on.
class RecordSearch {
public:
    RecordSearch(unsigned threads, const gum::Progress& progress) : threads_(threads), progress_(progress) {}

    std::vector<SearchedRecord> read(Archive& archive) {
        archive.each_record(
            [&](const std::map<std::string, CertificateLife>& lives) {
                for (const auto& [number, life] : lives) {
                    numbers_.insert(number);
                    const auto later = lives.find(life.later);
                    if (later != lives.end() && later->second.state == k_withdrawn) {
                        withdrawn_amendments_[number] = {life.later, later->second.record};
                    }
                    if (!life.amends.empty() && is_before_issue(life.state)) {
                        under_way_[life.amends] = number;
                    }
                    if (!life.number_amends.empty() && life.state == "numbered") {
                        taken_[life.number_amends].push_back(number);
                    }
                }
            },
            [&](const ListedCertificate& certificate, std::string bytes) {
                found_.push_back({certificate, std::nullopt});
                waiting_.push_back(std::move(bytes));
                if (waiting_.size() == k_records_at_once) {
                    begin_to_look();
                    if (progress_) {
                        progress_(std::to_string(found_.size()) + " of " + std::to_string(numbers_.size()) +
                                  " certificates searched");
                    }
                }
            });
        begin_to_look();
        end_to_look();
        return std::move(found_);
    }
    /// Of an amendment, when all records are read.
    [[nodiscard]] std::string free_number(const std::string& original) const {
        int ordinal = 1;
        while (numbers_.contains(original + "/A" + std::to_string(ordinal))) {
            ++ordinal;
        }
        return original + "/A" + std::to_string(ordinal);
    }

    struct Amendment {
        std::string number, record;
    };
    /// What took the place of a certificate and was withdrawn; without a number where nothing did.
    [[nodiscard]] Amendment withdrawn_amendment(const std::string& number) const {
        const auto found = withdrawn_amendments_.find(number);
        return found == withdrawn_amendments_.end() ? Amendment() : found->second;
    }

    /// The last one that amends or replaces a certificate and is not issued yet; "" where there is none.
    [[nodiscard]] std::string amendment_under_way(const std::string& number) const {
        const auto found = under_way_.find(number);
        return found == under_way_.end() ? "" : found->second;
    }

    /// Numbers that were taken for amendments of a certificate, and under which nothing is drafted yet.
    [[nodiscard]] std::vector<std::string> taken_numbers(const std::string& number) const {
        const auto found = taken_.find(number);
        return found == taken_.end() ? std::vector<std::string>() : found->second;
    }

private:
    std::set<std::string> numbers_;                          // of all certificates, with a record or without
    std::map<std::string, Amendment> withdrawn_amendments_;  // by the number of what they took the place of
    std::map<std::string, std::string> under_way_;           // by the number of what they amend
    std::map<std::string, std::vector<std::string>> taken_;  // by the number of what they would amend
    gum::WorkerThreads threads_;
    const gum::Progress& progress_;
    std::vector<SearchedRecord> found_;
    std::size_t done_ = 0;  // so many of them have been looked at
    std::vector<std::string> waiting_, looked_at_;
    std::vector<std::optional<RecordReferences>> references_;
    std::future<void> looking_;  // the last member: it ends before the others are gone

    /// While the next records are read from the archive.
    void begin_to_look() {
        end_to_look();
        looked_at_ = std::move(waiting_);
        waiting_.clear();
        references_.assign(looked_at_.size(), std::nullopt);
        looking_ = std::async(beside(threads_), [this] {
            threads_.run(looked_at_.size(), [this](unsigned /*worker*/, std::size_t task) {
                references_[task] = references_of(looked_at_[task]);
            });
        });
    }
    void end_to_look() {
        if (looking_.valid()) {
            looking_.get();
            for (std::optional<RecordReferences>& one : references_) {
                found_[done_++].references = std::move(one);
            }
        }
    }
};

bool is_in_period(const RecordReferences& references, const std::string& since, const std::string& until) {
    const bool is_before = !references.used_to.empty() && references.used_to < since;
    const bool is_after = !until.empty() && !references.used_from.empty() && references.used_from > until;
    return !is_before && !is_after;
}

std::vector<StandardReference> references_that_name(const std::string& name, const RecordReferences& references) {
    std::vector<StandardReference> found;
    std::copy_if(references.references.begin(), references.references.end(), std::back_inserter(found),
                 [&](const StandardReference& one) { return names(one.text, name); });
    return found;
}

gum::Diagnostic cannot_say(const std::string& number, std::string what) {
    return {.code = "GC-ARCHIVE-0062",
            .where = number,
            .what = std::move(what),
            .rule =
                "a certificate is calculated again where its record holds the job, and the job takes the standard "
                "from the register",
            .action = "correct the job by hand, and evaluate it"};
}

/// Puts the corrected file of the register into the job of a record.
bool correct_files(reports::EvaluationRecord& record, const Correction& correction) {
    bool found = false;
    for (reports::InputFile& file : record.job_files) {
        if (standard_of_file(file.name) == correction.standard) {
            file = reports::input_file(file.name, correction.corrected, true);
            found = true;
        }
    }
    return found;
}

/// A standard is found by its name alone: what a person should know of the name.
std::vector<gum::Diagnostic> remarks_on_name(const std::string& name, const TextsOfRecords& texts) {
    std::vector<gum::Diagnostic> remarks;
    const auto add = [&](std::string what, const char* action) {
        remarks.push_back({.code = "GC-ARCHIVE-0064",
                           .where = "--source " + text::visible(name, 80),
                           .what = std::move(what),
                           .rule = "a record rests on a standard where it names it by these letters",
                           .action = action,
                           .severity = gum::Severity::warning});
    };
    for (const std::string& text : texts.that_may_mean(name)) {
        add("records name " + text::in_quotes(text) + ", and are not among those that are listed for it",
            "search for this name as well, where it is the same standard");
    }
    if (texts.that_name(name).empty()) {
        add("no record names it",
            "look at the spelling: it is the identification in the register, or the number of a "
            "certificate of the standard");
    }
    return remarks;
}

double number_or(const nlohmann::json& object, const char* key, double otherwise) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : otherwise;
}

/// The change of a value, or of its U, relative to the U of before: of one object that has both.
double shift_of(const nlohmann::json& before, const nlohmann::json& now) {
    const double U = number_or(before, "U", 0.0);
    if (!(U > 0.0) || !before.contains("value") || !now.is_object()) {
        return 0.0;
    }
    const double value = number_or(before, "value", 0.0);
    return std::max(std::abs(number_or(now, "value", value) - value), std::abs(number_or(now, "U", U) - U)) / U;
}

/// Value and U as a certified value has them issued: of an interval U is half of its width.
nlohmann::json certified_value(const nlohmann::json& value) {
    nlohmann::json stated = value;
    const nlohmann::json& interval = gumcert::json::part_of(value, "interval");
    if (interval.is_array() && interval.size() == 2 && interval[0].is_number() && interval[1].is_number()) {
        stated["U"] = 0.5 * (interval[1].get<double>() - interval[0].get<double>());
    }
    return stated;
}

/// What certificates state, by its place: table, result and row.
std::map<std::string, nlohmann::json> certified_values(const nlohmann::json& record) {
    std::map<std::string, nlohmann::json> values;
    for (const nlohmann::json& table :
         gumcert::json::part_of(gumcert::json::part_of(record, "certificate"), "tables")) {
        for (const nlohmann::json& column : gumcert::json::part_of(table, "columns")) {
            std::size_t row = 0;
            for (const nlohmann::json& value : gumcert::json::part_of(column, "values")) {
                values[gumcert::json::text_of(table, "section") + '\n' + gumcert::json::text_of(table, "id") + '\n' +
                       gumcert::json::text_of(column, "result") + '\n' + std::to_string(row++)] =
                    certified_value(value);
            }
        }
    }
    return values;
}

/// Of all objects with value and U in a part of two records that is stated as a whole.
double shift_in(const nlohmann::json& before, const nlohmann::json& now) {
    double largest = shift_of(before, now);
    if (before.is_object() && now.is_object()) {
        for (const auto& [key, item] : before.items()) {
            if (const auto other = item.is_structured() ? now.find(key) : now.end(); other != now.end()) {
                largest = std::max(largest, shift_in(item, *other));
            }
        }
    } else if (before.is_array() && now.is_array()) {
        for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i) {
            largest = std::max(largest, shift_in(before[i], now[i]));
        }
    }
    return largest;
}

/// The largest change of a value, or of its U, relative to the U that was issued, of what the certificate states: its
/// tables, or the report of a comparison. Inputs, the budget and the job that the record holds as well are none of it: a
/// standard that changes by its own U moves a result by much less where other contributions are larger.
double largest_shift(const nlohmann::json& before, const nlohmann::json& now) {
    const std::map<std::string, nlohmann::json> stated = certified_values(before);
    const std::map<std::string, nlohmann::json> again = certified_values(now);
    double largest = stated.empty() ? shift_in(gumcert::json::part_of(before, "comparison"),
                                               gumcert::json::part_of(now, "comparison"))
                                    : 0.0;
    for (const auto& [place, value] : stated) {
        if (const auto found = again.find(place); found != again.end()) {
            largest = std::max(largest, shift_of(value, found->second));
        }
    }
    return largest;
}

constexpr const char* k_changes_file = "changes.json";  // of a draft, beside its job

/// Places for the files of a job in a folder of its own. Names that lead out of the folder of the job ("../laboratory")
/// stay as they are: the job lies so much deeper.
class DraftPlaces {
public:
    explicit DraftPlaces(const std::vector<reports::InputFile>& files) {
        for (const reports::InputFile& file : files) {
            std::size_t depth = 0;
            for (const auto& part : std::filesystem::path(file.name)) {
                depth += part == ".." ? std::size_t{1} : 0;
            }
            const bool is_of_draft = std::filesystem::path(file.name).lexically_normal() == k_changes_file;
            depth_ = std::max(depth_, is_of_draft ? std::size_t{1} : depth);
        }
    }
    [[nodiscard]] std::filesystem::path of(const std::string& name) const {
        std::filesystem::path place;
        for (std::size_t i = 0; i < depth_; ++i) {
            place /= "job";
        }
        if (name.starts_with(jobs::k_laboratory_prefix)) {
            return place / "laboratory" / name.substr(jobs::k_laboratory_prefix.size());
        }
        return (place / name).lexically_normal();
    }

private:
    std::size_t depth_ = 0;
};

std::string written(const nlohmann::ordered_json& value) {
    return value.dump(2) + "\n";
}

bool is_shown(const evaluation::RecordChange& change) {
    return change.kind == evaluation::ChangeKind::printed || change.kind == evaluation::ChangeKind::verdict;
}

nlohmann::json shown_change_list(const Recalculation& recalculation) {
    nlohmann::json list = nlohmann::json::array();
    const auto add = [&](const char* kind, const evaluation::RecordChange& change) {
        list.push_back({{"kind", kind}, {"place", change.place}, {"before", change.before}, {"now", change.now}});
    };
    for (const evaluation::RecordChange& change : recalculation.rerun.changes) {
        if (is_shown(change)) {
            add(word_of(change.kind), change);
        }
    }
    for (const evaluation::RecordChange& change : recalculation.texts) {
        add(k_text, change);
    }
    return list;
}

/// Whether a change is one of results, which tell_changes() tells; else it is one of the certificate data, its numbers (U of a
/// standard) and codes among them, or of what stands around results.
bool is_of_results(const certificate::Change& change, bool is_of_report) {
    static constexpr std::array<std::string_view, 12> k_others{"text",    "flag",          "code",  "words",
                                                               "heading", "role",          "stage", "title",
                                                               "columns", "specification", "rule",  "group"};
    const bool is_of_data = !is_of_report && change.where.starts_with('/');
    return !is_of_data && std::ranges::find(k_others, change.kind) == k_others.end();
}

/// What a certificate or report states otherwise, as the list of an amendment has it.
std::vector<certificate::Change> stated_changes(const reports::EvaluationRecord& before,
                                                const reports::EvaluationRecord& now) {
    return before.certificate && now.certificate ? reports::changes_between(before, now)
           : before.comparison && now.comparison ? changes_of_report(before, now)
                                                 : std::vector<certificate::Change>();
}

auto content_of(const certificate::Change& change) {
    return std::tie(change.kind, change.where, change.before, change.after);
}

auto content_of(const evaluation::RecordChange& change) {
    return std::tie(change.kind, change.place, change.before, change.now);
}

/// Takes those changes out that stand among others, too, and gives them.
template <typename Change>
std::vector<Change> taken_out(std::vector<Change>& changes, const std::vector<Change>& others) {
    std::set<decltype(content_of(others.front()))> known;
    for (const Change& other : others) {
        known.insert(content_of(other));
    }
    const auto first = std::stable_partition(changes.begin(), changes.end(),
                                             [&](const Change& one) { return !known.contains(content_of(one)); });
    std::vector<Change> taken(std::make_move_iterator(first), std::make_move_iterator(changes.end()));
    changes.erase(first, changes.end());
    return taken;
}

/// Tells what changes in the words around results, and whether results do.
void tell_what_is_stated(const reports::EvaluationRecord& before, const std::vector<certificate::Change>& changes,
                         Recalculation& result) {
    for (const certificate::Change& change : changes) {
        if (result.stated.size() < evaluation::k_most_changes) {
            result.stated.push_back(change);
        }
        if (is_of_results(change, !before.certificate)) {
            result.results_change = result.rerun.is_negative();  // beyond the last digits of unrounded numbers
        } else if (result.texts.size() < evaluation::k_most_changes) {
            result.texts.push_back({evaluation::ChangeKind::other, change.where, change.before, change.after});
        }
    }
}

/// What the program says of the changes, in all languages of the document, which prints it.
nlohmann::ordered_json changes_in_words(const reports::EvaluationRecord& record, const Correction& correction,
                                        bool is_of_results) {
    const std::vector<std::string> languages = record.certificate  ? record.certificate->data.languages
                                               : record.comparison ? record.comparison->languages
                                                                   : std::vector<std::string>();
    const auto worded = [&](const std::vector<std::string>& of_document) {
        reports::RenderAssets assets;
        assets.templates = correction.templates;
        assets.wordings = correction.wordings;
        assets.languages = of_document;
        const reports::Wording words = reports::read_wording(assets);
        const reports::Wording::Values values{{"standard", correction.standard}};
        const reports::Text text = is_of_results ? words.filled("drafted_amendment", "results", values)
                                                 : words.filled("drafted_amendment", "statements", values);
        return text.first();
    };
    if (languages.size() < 2) {
        return worded(languages);
    }
    nlohmann::ordered_json all;
    for (const std::string& language : languages) {
        all[language] = worded({language});
    }
    return all;
}

/// The file with the record of what a record amends itself, which is no part of its job; "" where there is none.
std::string amended_record(const reports::EvaluationRecord& record) {
    if (record.certificate && record.certificate->data.amendment) {
        return record.certificate->data.amendment->record;
    }
    const bool is_report = record.comparison && record.comparison->issuer && record.comparison->issuer->amendment;
    return is_report ? record.comparison->issuer->amendment->record : "";
}

/// As the log will have them.
nlohmann::json change_list(const std::vector<certificate::Change>& changes) {
    nlohmann::json list = nlohmann::json::array();
    for (const certificate::Change& change : changes) {
        list.push_back(
            {{"kind", change.kind}, {"place", change.where}, {"before", change.before}, {"now", change.after}});
    }
    return list;
}

nlohmann::json numbers_of(const std::vector<FoundBefore>& others) {
    nlohmann::json list = nlohmann::json::array();
    for (const FoundBefore& other : others) {
        list.push_back(other.number);
    }
    return list;
}

/// Job, certificate data and all files of an amendment.
/// \return none where the job cannot be written beside each other again
std::vector<outputs::OutputFile> drafted_amendment(const AffectedCertificate& one, const std::string& original,
                                                   const reports::EvaluationRecord& corrected,
                                                   const Correction& correction) {
    const DraftPlaces places(corrected.job_files);
    const std::filesystem::path folder = one.draft_name;
    std::map<std::string, std::string> files;
    for (const reports::InputFile& file : corrected.job_files) {
        if (std::filesystem::path(file.name).is_absolute()) {
            return {};
        }
        files[file.name] = reports::bytes_of(file).value_or("");
    }
    const std::string& job_name = corrected.job_files.front().name;
    nlohmann::ordered_json job = nlohmann::ordered_json::parse(files[job_name], nullptr, false, true);
    if (!job.is_object() || !job.contains("certificate")) {
        return {};
    }
    const bool inside = job["certificate"].is_object();
    const std::string certificate_name =
        inside || !job["certificate"].is_string() ? "" : job["certificate"].get<std::string>();
    if (!inside && !files.contains(certificate_name)) {
        return {};
    }
    nlohmann::ordered_json certificate =
        inside ? job["certificate"] : nlohmann::ordered_json::parse(files[certificate_name], nullptr, false, true);
    if (!certificate.is_object()) {
        return {};
    }
    // The record of what it amends itself is no part of its job, and may have the name that a draft gave it.
    files.erase(amended_record(corrected));
    std::string record_name = "original_record.json";
    for (int ordinal = 2; files.contains(record_name); ++ordinal) {
        record_name = "original_record-" + std::to_string(ordinal) + ".json";
    }
    certificate["number"] = one.draft_number;
    certificate["amendment"] = {
        {"kind", "amended"},
        {"number", one.certificate.number},
        {"reason", correction.reason},
        {"changes",
         nlohmann::ordered_json::array({changes_in_words(corrected, correction, one.recalculated->results_change)})},
        {"record", record_name}};
    if (inside) {
        job["certificate"] = certificate;
    } else {
        files[certificate_name] = written(certificate);
    }
    if (std::any_of(files.begin(), files.end(),
                    [](const auto& file) { return file.first.starts_with(jobs::k_laboratory_prefix); })) {
        job["laboratory"] = "laboratory";
    }
    files[job_name] = written(job);
    files[record_name] = original;
    std::map<std::filesystem::path, std::string> placed;
    for (const auto& [name, bytes] : files) {
        const auto [at, is_new] = placed.emplace(folder / places.of(name), bytes);
        if (!is_new && at->second != bytes) {  // a folder that is named as that of the laboratory
            return {};
        }
    }
    std::vector<outputs::OutputFile> draft;
    for (const auto& [place, bytes] : placed) {
        draft.push_back({place, bytes});
    }
    draft.push_back({folder / k_changes_file,
                     gumcert::json::canonical_json({{"schema", "gumcert/archive-amendment-draft/1"},
                                                    {"number", one.draft_number},
                                                    {"amends", one.certificate.number},
                                                    {"reason", correction.reason},
                                                    {"job", places.of(job_name).generic_string()},
                                                    {"changes", change_list(one.recalculated->stated)},
                                                    {"changes_of_version", change_list(one.recalculated->of_version)},
                                                    {"not_corrected", one.recalculated->not_corrected},
                                                    {"rests_on", numbers_of(one.rests_on)}})});
    return draft;
}

/// Names of a standard in a file of the register: its serial number, where it is no short one that other things have as well, and its
/// certificates.
void add_names(const std::string& registered, std::vector<std::string>& names_of_standard) {
    constexpr std::size_t k_least_letters = 4;
    const nlohmann::json standard = nlohmann::json::parse(registered, nullptr, false, true);
    if (std::string serial = gumcert::json::text_of(standard, "serial_number");
        certificate::letters_of(serial).size() >= k_least_letters) {
        names_of_standard.push_back(std::move(serial));
    }
    for (const nlohmann::json& calibration : gumcert::json::part_of(standard, "calibrations")) {
        if (std::string certificate = gumcert::json::text_of(calibration, "certificate"); !certificate.empty()) {
            names_of_standard.push_back(std::move(certificate));
        }
    }
}

/// Where the job of a record states something of a standard itself, by names of its file as it was and as it is corrected.
/// \param record  as it was issued
std::vector<std::string> own_statements(const reports::EvaluationRecord& record, const Correction& correction) {
    const std::string& standard = correction.standard;
    std::vector<std::string> names_of_standard{standard};
    add_names(correction.corrected, names_of_standard);
    for (const reports::InputFile& file : record.job_files) {
        if (standard_of_file(file.name) == standard) {
            add_names(reports::bytes_of(file).value_or(""), names_of_standard);
        }
    }
    const std::string amended = amended_record(record);
    std::vector<std::string> places;
    for (const reports::InputFile& file : record.job_files) {
        if (standard_of_file(file.name).empty() && (amended.empty() || file.name != amended)) {
            const nlohmann::json content =
                nlohmann::json::parse(reports::bytes_of(file).value_or(""), nullptr, false, true);
            for (const std::string& place : stated_by_hand(content, names_of_standard)) {
                places.push_back(file.name + "#" + place);
            }
        }
    }
    return places;
}

/// What a record that does not read the file of the standard names as sources, in its files and in its results, but things whose files
/// of the register it holds.
std::vector<std::string> other_sources(const reports::EvaluationRecord& record, const std::string& original,
                                       const Correction& correction) {
    std::vector<StandardReference> all;
    const auto take = [&](std::string_view text) {
        if (std::optional<RecordReferences> found = references_of(text)) {
            std::ranges::move(found->references, std::back_inserter(all));
        }
    };
    take(original);
    const std::string amended = amended_record(record);
    for (const reports::InputFile& file : record.job_files) {
        const nlohmann::json content =
            nlohmann::json::parse(reports::bytes_of(file).value_or(""), nullptr, false, true);
        if (content.is_object() && standard_of_file(file.name).empty() && (amended.empty() || file.name != amended)) {
            take(content.dump());
        }
    }
    std::vector<std::string> names_of_standard{correction.standard};
    add_names(correction.corrected, names_of_standard);
    std::set<std::string> held;
    for (const StandardReference& one : all) {
        const bool is_of_standard = std::ranges::any_of(names_of_standard, [&](const std::string& name) {
            return certificate::letters_of(one.text) == certificate::letters_of(name);
        });
        if (one.kind == StandardReference::Kind::registered && !is_of_standard) {
            held.insert(one.text);
        }
    }
    std::set<std::string> sources;
    for (StandardReference& one : all) {
        if (!held.contains(one.text)) {
            sources.insert(std::move(one.text));
        }
    }
    return {sources.begin(), sources.end()};
}

/// Some places in words.
std::string in_words(const std::vector<std::string>& places) {
    constexpr std::size_t k_most = 3;
    std::string words;
    for (std::size_t i = 0; i < std::min(places.size(), k_most); ++i) {
        words += (i > 0 ? ", " : "") + text::visible(places[i], 120);
    }
    return words + (places.size() > k_most ? " and " + std::to_string(places.size() - k_most) + " more" : "");
}

std::string states_it_itself(const Recalculation& one) {
    return "its job states something of the standard itself: " + in_words(one.not_corrected);
}

/// Why nothing can be said of a certificate that comes out the same: not all that rests on the standard was corrected. "" where
/// it comes out otherwise, or all was.
std::string why_it_is_not_the_same(const Recalculation& one, const std::string& waits_for) {
    const bool decides_otherwise = one.rerun.count(evaluation::ChangeKind::verdict) > 0;
    return one.states_otherwise() || decides_otherwise ? ""
           : !one.not_corrected.empty() ? "with the corrected file it comes out the same, and " + states_it_itself(one)
           : !waits_for.empty()         ? "with the corrected file it comes out the same, and it rests on " + waits_for
                                        : "";
}

/// A record with the corrected standard among the files of its job, and what comes of it.
struct Recalculated {
    Recalculation result;
    reports::EvaluationRecord corrected;
};

/// What this version makes of a record with its own files; none where it makes nothing of them.
std::optional<reports::EvaluationRecord> with_own_files(const std::string& number, const std::string& original,
                                                        const Correction& correction) {
    try {
        return evaluation::evaluated_again(reports::record_from_json(original, number), number, 1, correction.templates,
                                           correction.watch ? correction.watch() : gum::Progress());
    } catch (const gum::InputError&) {
        return std::nullopt;
    }
}

/// What the corrected standard changes in a record. What this version of the program states otherwise than the one that made the
/// record, also with the files that the record holds, is no effect of the correction.
/// \param record  as it was issued
/// \param issued, now  values of it, and of what comes of it
void tell_effect(const reports::EvaluationRecord& record, const nlohmann::json& issued,
                 const reports::EvaluationRecord& again, const nlohmann::json& now, const std::string& original,
                 const Correction& correction, Recalculation& result) {
    evaluation::RerunRecord rerun = result.rerun;  // which stays as it is where a limit ends the second evaluation
    evaluation::tell_changes(issued, now, rerun);
    std::vector<certificate::Change> stated = stated_changes(record, again);
    result.shift = largest_shift(issued, now);
    const bool is_of_other_version = std::tie(record.software.version, record.software.commit) !=
                                     std::tie(again.software.version, again.software.commit);
    if (is_of_other_version && (rerun.is_negative() || !stated.empty())) {
        if (const std::optional<reports::EvaluationRecord> own = with_own_files(rerun.name, original, correction)) {
            const nlohmann::json own_value = reports::to_json_value(*own);
            evaluation::RerunRecord of_version;
            evaluation::tell_changes(issued, own_value, of_version);
            std::size_t shown = 0;
            for (const evaluation::RecordChange& change : taken_out(rerun.changes, of_version.changes)) {
                --rerun.counts.at(static_cast<std::size_t>(change.kind));
                shown += is_shown(change) ? std::size_t{1} : 0;
            }
            result.of_version = taken_out(stated, stated_changes(record, *own));
            result.shift = largest_shift(own_value, now);
            if (shown > 0 || !result.of_version.empty()) {
                result.version_in_words =
                    "another version of gumcert made it, and this one states some of it otherwise whatever the "
                    "standard: see gumcert rerun";
            }
            result.of_version.resize(std::min(result.of_version.size(), evaluation::k_most_changes));
        } else {
            result.version_in_words =
                "another version of gumcert made it, and this one makes nothing of its own files: what the version "
                "changes is among it";
        }
    }
    std::erase_if(rerun.changes, [](const evaluation::RecordChange& change) { return !is_shown(change); });
    result.rerun = std::move(rerun);
    tell_what_is_stated(record, stated, result);
}

Recalculated recalculated(const std::string& number, const std::string& original, const Correction& correction) {
    Recalculated done{.result = {.rerun = {.name = number}}, .corrected = {}};
    evaluation::RerunRecord& rerun = done.result.rerun;
    reports::EvaluationRecord& record = done.corrected;
    try {
        reports::ReadRecord read = reports::read_record(original, number);
        record = std::move(read.record);
        rerun.made_by = record.software;
        rerun.kind = record.kind;
        done.result.not_corrected = own_statements(record, correction);
        const std::optional<gum::Diagnostic> missing = evaluation::files_not_held(record, number);
        done.result.not_read = missing ? missing->what : "";
        done.result.takes_standard = correct_files(record, correction);
        if (!done.result.takes_standard) {
            done.result.sources = other_sources(record, original, correction);
        }
        if (missing || !done.result.takes_standard) {
            rerun.not_evaluated =
                cannot_say(number, missing ? missing->what : "its job does not take the standard from the register");
        } else {
            const reports::EvaluationRecord again = evaluation::evaluated_again(
                record, number, 1, correction.templates, correction.watch ? correction.watch() : gum::Progress());
            tell_effect(record, read.value, again, reports::to_json_value(again), original, correction, done.result);
        }
    } catch (const gum::DiagnosedError& error) {
        rerun.not_evaluated = cannot_say(number, error.diagnostics().front().what);
    }
    return done;
}

/// Of what changes in a record and not in what an amendment would state; "" where nothing does.
std::string why_nothing_is_stated(const Recalculation& one) {
    return one.rerun.not_evaluated || !one.rerun.is_negative() ? ""
           : one.rerun.count(evaluation::ChangeKind::verdict) > 0
               ? "it states the same outside of its annexes, and the program decides otherwise: evaluate its job with "
                 "the "
                 "corrected standard, and look at the findings"
               : "it states the same outside of its annexes: digits of its budget alone change";
}

bool needs_amendment(const AffectedCertificate& one) {
    return one.recalculated && one.recalculated->states_otherwise() &&
           (one.certificate.state == "issued" || !one.withdrawn_amendment.empty());
}

std::string in_words(const std::vector<certificate::Change>& changes) {
    std::vector<std::string> words;
    for (const certificate::Change& change : changes) {
        words.push_back(change.where + " " + text::in_quotes(change.before) + " -> " + text::in_quotes(change.after));
    }
    return in_words(words);
}

/// Records of a certificate; "" where nothing is to be done with them.
struct RecordsToRead {
    std::string original, withdrawn;  ///< and of its amendment that was withdrawn
};

/// Why a draft of the original would state less than is known: it takes back what a withdrawn amendment had corrected, and whether that
/// still holds only the laboratory knows. "" where nothing is lost.
std::string why_it_would_take_back(const AffectedCertificate& one, const RecordsToRead& records) {
    std::vector<certificate::Change> lost;
    try {
        const reports::EvaluationRecord withdrawn =
            reports::record_from_json(records.withdrawn, one.withdrawn_amendment);
        const reports::EvaluationRecord original = reports::record_from_json(records.original, one.certificate.number);
        if ((withdrawn.certificate && original.certificate) || (withdrawn.comparison && original.comparison)) {
            lost = stated_changes(original, withdrawn);
            (void)taken_out(lost, one.recalculated->stated);
            (void)taken_out(lost, one.recalculated->of_version);
            return lost.empty() ? ""
                                : "it would take back what " + one.withdrawn_amendment +
                                      ", which was withdrawn, had stated otherwise: " + in_words(lost) +
                                      "; decide what holds, and amend it by hand";
        }
    } catch (const gum::DiagnosedError&) {  // told below
    }
    return "what " + one.withdrawn_amendment +
           ", which was withdrawn, had stated otherwise cannot be read from its record: amend it by hand";
}

/// Calculates a certificate again where that is not done, and drafts its amendment where one is needed.
void work_out(AffectedCertificate& one, const RecordsToRead& records, const Correction& correction,
              const DraftSink& drafts) {
    const std::string& original = records.original;
    std::optional<reports::EvaluationRecord> corrected;
    if (!one.recalculated) {
        Recalculated done = recalculated(one.certificate.number, original, correction);
        one.recalculated = std::move(done.result);
        corrected = std::move(done.corrected);
    }
    if (!drafts.write) {
        return;
    }
    if (!needs_amendment(one)) {
        one.no_draft =
            !one.recalculated->states_otherwise() ? why_nothing_is_stated(*one.recalculated)
            : is_before_issue(one.certificate.state)
                ? "it is " + one.certificate.state +
                      ", and not issued: evaluate its job with the corrected "
                      "standard, and add the record"
                : "it is " + one.certificate.state + ": where what took its place changes, too, that is amended";
        return;
    }
    if (!one.amendment_under_way.empty()) {
        one.no_draft = one.amendment_under_way + ", which amends it, is not issued yet: state there what changes";
        return;
    }
    if (!one.withdrawn_amendment.empty()) {
        one.no_draft = why_it_would_take_back(one, records);
        if (!one.no_draft.empty()) {
            return;
        }
    }
    if (!corrected) {  // another machine has calculated it
        corrected = reports::record_from_json(original, one.certificate.number);
        (void)correct_files(*corrected, correction);
    }
    const std::vector<outputs::OutputFile> draft = drafted_amendment(one, original, *corrected, correction);
    if (!draft.empty()) {
        drafts.write(draft);
        one.draft_folder = one.draft_name;
    } else {
        one.no_draft = "its job cannot be written with its files beside it: amend it by hand";
    }
}

/// Records of some certificates.
std::vector<RecordsToRead> records_of(const std::vector<AffectedCertificate>& affected, std::size_t from,
                                      std::size_t to, Archive& archive) {
    std::vector<RecordsToRead> records(to - from);
    for (std::size_t i = from; i < to; ++i) {
        const AffectedCertificate& one = affected[i];
        if (!one.recalculated || needs_amendment(one)) {
            records[i - from].original = archive.content(one.certificate.record).value_or("");
            records[i - from].withdrawn =
                one.withdrawn_record.empty() ? "" : archive.content(one.withdrawn_record).value_or("");
        }
    }
    return records;
}

constexpr std::array<const char*, 6> k_outcomes = {"verdict", "printed", k_text, "cannot_say", "budget", "same"};

/// Index of k_outcomes: what a person reads first comes first.
std::size_t index_of_outcome(const Recalculation& one) {
    return one.rerun.not_evaluated                                ? 3
           : one.rerun.count(evaluation::ChangeKind::verdict) > 0 ? 0
           : one.results_change                                   ? 1
           : !one.texts.empty()                                   ? 2
           : one.rerun.count(evaluation::ChangeKind::printed) > 0 ? 4
                                                                  : 5;
}

auto rank_of(const AffectedCertificate& one) {
    return std::tuple(one.recalculated ? index_of_outcome(*one.recalculated) : k_outcomes.size(),
                      one.recalculated ? -one.recalculated->shift : 0.0, one.certificate.number);
}

/// Not where nothing can be said, nor of one that is the same because others are.
bool is_calculated(const AffectedCertificate& one) {
    return one.recalculated && !one.recalculated->rerun.not_evaluated && one.recalculated->takes_standard;
}

std::string outcome_of(const AffectedCertificate& one) {
    return one.recalculated ? k_outcomes.at(index_of_outcome(*one.recalculated)) : "not_recalculated";
}

/// Whether a certificate takes nothing of the standard but through others: it is not evaluated then.
bool rests_on_others_alone(const AffectedCertificate& one) {
    return !one.recalculated->takes_standard && !one.through.empty();
}

/// Why nothing can be said of a certificate that rests on others alone, whatever becomes of these: of the standard itself it may take
/// something that nobody sees. "" where they settle it.
std::string why_others_do_not_settle(const AffectedCertificate& one) {
    const Recalculation& result = *one.recalculated;
    if (!result.not_read.empty()) {
        return result.not_read;
    }
    if (!result.not_corrected.empty()) {
        return states_it_itself(result);
    }
    const auto unknown = std::ranges::find_if(result.sources, [&](const std::string& source) {
        return std::ranges::none_of(one.rests_on,
                                    [&](const FoundBefore& other) { return names(source, other.number); });
    });
    return unknown == result.sources.end()
               ? ""
               : "it names " + text::in_quotes(*unknown) + ", which may rest on the standard as well";
}

/// Whether nothing of a certificate changes, as far as that is of itself: what it takes of others on which it rests is another
/// question.
bool is_same_by_itself(const AffectedCertificate& one) {
    const Recalculation& result = *one.recalculated;
    return rests_on_others_alone(one) ? why_others_do_not_settle(one).empty()
                                      : result.not_corrected.empty() && !result.rerun.not_evaluated &&
                                            !result.states_otherwise() && !result.rerun.is_negative();
}

/// Those of the others that come out the same, with all on which they rest: from certificates that rest on the standard alone to
/// those that rest on them. None of a circle does.
std::set<std::string> come_out_the_same(const std::vector<AffectedCertificate>& affected) {
    std::map<std::string, std::vector<const AffectedCertificate*>> resting;  // by what they rest on
    std::map<std::string, std::size_t> open;                                 // how many of these have not come out
    std::deque<std::string> next;
    for (const AffectedCertificate& one : affected) {
        if (!is_same_by_itself(one)) {
            continue;
        }
        open[one.certificate.number] = one.rests_on.size();
        for (const FoundBefore& other : one.rests_on) {
            resting[other.number].push_back(&one);
        }
        if (one.rests_on.empty()) {
            next.push_back(one.certificate.number);
        }
    }
    std::set<std::string> same;
    for (; !next.empty(); next.pop_front()) {
        same.insert(next.front());
        for (const AffectedCertificate* const one : resting[next.front()]) {
            if (--open[one->certificate.number] == 0) {
                next.push_back(one->certificate.number);
            }
        }
    }
    return same;
}

/// When all are calculated: what is said of those that rest on others, and of those that are not corrected as a whole.
void settle(std::vector<AffectedCertificate>& affected) {
    const std::set<std::string> same = come_out_the_same(affected);
    for (AffectedCertificate& one : affected) {
        for (FoundBefore& other : one.rests_on) {
            other.is_same = same.contains(other.number);
        }
        evaluation::RerunRecord& rerun = one.recalculated->rerun;
        const std::string& number = one.certificate.number;
        const std::string waits = waits_for(one);
        if (rests_on_others_alone(one)) {
            std::string why = why_others_do_not_settle(one);
            rerun.not_evaluated =
                same.contains(number)
                    ? std::nullopt
                    : std::optional(cannot_say(number, why.empty() ? "it rests on " + waits : std::move(why)));
        } else if (!rerun.not_evaluated) {
            if (std::string what = why_it_is_not_the_same(*one.recalculated, waits); !what.empty()) {
                rerun.not_evaluated = cannot_say(number, std::move(what));
                one.no_draft.clear();
            }
        }
    }
}

/// Numbers that differ in characters that no file name has, such as "N/1" and "N_1", do not share a folder.
void name_drafts(std::vector<AffectedCertificate>& affected) {
    std::set<std::string> taken;
    for (AffectedCertificate& one : affected) {
        const std::string name = file_name_of_number(one.draft_number);
        one.draft_name = name;
        for (int ordinal = 2; !taken.insert(one.draft_name).second; ++ordinal) {
            one.draft_name = name + "-" + std::to_string(ordinal);
        }
    }
}

std::string period_of(const AffectedCertificate& one) {
    return one.used_to.empty()            ? "unknown"
           : one.used_from.empty()        ? "until " + one.used_to
           : one.used_from == one.used_to ? one.used_to
                                          : one.used_from + "/" + one.used_to;
}

std::string through_text(const AffectedCertificate& one) {
    return one.through.empty() ? ""
                               : "through " + text::visible(one.through, 80) +
                                     (one.through_state == k_withdrawn ? ", withdrawn: " : ": ");
}

std::string filled(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text + "  ";
}

}  // namespace

std::vector<AffectedCertificate> find_affected(Archive& archive, const WrongStandard& standard, unsigned threads,
                                               const gum::Progress& progress, std::vector<gum::Diagnostic>* remarks) {
    RecordSearch search(threads, progress);
    const std::vector<SearchedRecord> records = search.read(archive);
    TextsOfRecords texts;
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (records[i].references) {
            texts.add(i, *records[i].references);
        }
    }
    std::vector<AffectedCertificate> affected;
    std::set<std::size_t> known;
    std::map<std::size_t, std::size_t> places;  // in the answer, of records
    struct Wanted {
        std::string name, through, through_state;
    };
    std::deque<Wanted> wanted{{standard.name, "", ""}};
    if (remarks != nullptr) {
        *remarks = remarks_on_name(standard.name, texts);
    }
    // What rests on a certificate is followed whether that one still holds or not: a withdrawal says nothing to those who
    // have used it. Only the answer leaves it out.
    const auto find = [&](std::size_t i, const Wanted& by, std::vector<StandardReference> because) {
        const ListedCertificate& certificate = records[i].certificate;
        const bool is_read = records[i].references.has_value();
        if (certificate.state != k_withdrawn) {
            places[i] = affected.size();
            const RecordSearch::Amendment withdrawn = search.withdrawn_amendment(certificate.number);
            affected.push_back({.certificate = certificate,
                                .used_from = is_read ? records[i].references->used_from : "",
                                .used_to = is_read ? records[i].references->used_to : "",
                                .because = std::move(because),
                                .through = by.through,
                                .through_state = by.through_state,
                                .withdrawn_amendment = withdrawn.number,
                                .withdrawn_record = withdrawn.record,
                                .amendment_under_way = search.amendment_under_way(certificate.number),
                                .taken_numbers = search.taken_numbers(certificate.number),
                                .draft_number = search.free_number(certificate.number)});
        }
        wanted.push_back({certificate.number, certificate.number, certificate.state});
    };
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (!records[i].references) {  // it may rest on anything
            known.insert(i);
            find(i, {}, {{StandardReference::Kind::source, "the record cannot be read"}});
        }
    }
    while (!wanted.empty()) {
        const Wanted next = std::move(wanted.front());
        wanted.pop_front();
        for (const std::size_t i : texts.that_name(next.name)) {
            const SearchedRecord& record = records[i];
            // A standard that was calibrated with a wrong one stays wrong: only the first step has a last day.
            if (record.certificate.number == next.name ||
                !is_in_period(*record.references, standard.since, next.through.empty() ? standard.until : "")) {
                continue;
            }
            if (known.insert(i).second) {
                find(i, next, references_that_name(next.name, *record.references));
            }
            if (const auto found = places.find(i); found != places.end() && !next.through.empty()) {
                affected[found->second].rests_on.push_back({next.through, next.through_state});
            }
        }
    }
    std::sort(affected.begin(), affected.end(), [](const AffectedCertificate& a, const AffectedCertificate& b) {
        return a.certificate.number < b.certificate.number;
    });
    name_drafts(affected);
    return affected;
}

std::string waits_for(const AffectedCertificate& certificate) {
    const auto open = std::ranges::find(certificate.rests_on, false, &FoundBefore::is_same);
    return open == certificate.rests_on.end()
               ? ""
               : open->number + (open->state == k_withdrawn ? ", which was withdrawn" : ", which is listed, too");
}

Recalculation recalculation_of(const std::string& number, const std::string& original, const Correction& correction) {
    return recalculated(number, original, correction).result;
}

void recalculate(std::vector<AffectedCertificate>& affected, Archive& archive, const Correction& correction,
                 unsigned threads, const DraftSink& drafts, const gum::Progress& progress) {
    gum::WorkerThreads workers(threads);
    const auto finish = drafts.finish ? drafts.finish : [] {};
    const auto end_of = [&](std::size_t first) { return std::min(first + k_records_at_once, affected.size()); };
    std::vector<RecordsToRead> records = records_of(affected, 0, end_of(0), archive);
    for (std::size_t first = 0; first < affected.size(); first = end_of(first)) {
        // Beside the calculation: the drafts before come to the disk, and the records after are read.
        std::vector<RecordsToRead> next;
        std::future<void> disk = std::async(beside(workers), [&, after = end_of(first)] {
            finish();
            next = records_of(affected, after, end_of(after), archive);
        });
        workers.run(records.size(), [&](unsigned /*worker*/, std::size_t task) {
            work_out(affected[first + task], records[task], correction, drafts);
        });
        disk.get();
        records = std::move(next);
        if (progress) {
            progress(std::to_string(end_of(first)) + " of " + std::to_string(affected.size()) + " calculated");
        }
    }
    finish();
    settle(affected);
    rank(affected);
}

void rank(std::vector<AffectedCertificate>& affected) {
    std::sort(affected.begin(), affected.end(),
              [](const AffectedCertificate& a, const AffectedCertificate& b) { return rank_of(a) < rank_of(b); });
}

std::string affected_text(const std::vector<AffectedCertificate>& affected) {
    std::string text;
    for (const AffectedCertificate& one : affected) {
        text += filled(text::visible(one.certificate.number, 80), 24) + filled(one.certificate.state, 10) +
                filled(text::visible(period_of(one), 40), 21) + outcome_of(one);
        if (is_calculated(one)) {
            text += "  " + text::significant(one.recalculated->shift, 3) + " U";
        }
        text += one.draft_folder.empty() ? "" : "  draft " + one.draft_folder;
        text += "\n    " + through_text(one) + word_of(one.because.front().kind) + " \"" +
                text::visible(one.because.front().text, 120) + "\"\n";
        if (!one.withdrawn_amendment.empty()) {
            text += "    " + text::visible(one.withdrawn_amendment, 80) + ", which took its place, was withdrawn" +
                    (one.amendment_under_way.empty() ? ": amend it once more, or withdraw it\n" : "\n");
        }
        if (!one.amendment_under_way.empty() && one.no_draft.empty()) {
            text += "    " + text::visible(one.amendment_under_way, 80) + ", which amends it, is not issued yet\n";
        }
        if (!one.taken_numbers.empty()) {
            text += "    taken for an amendment of it, and not drafted: " + in_words(one.taken_numbers) +
                    "; use or withdraw it\n";
        }
        if (one.recalculated && one.recalculated->rerun.not_evaluated) {
            text += "    " + text::visible(one.recalculated->rerun.not_evaluated->what, 200) + "\n";
        }
        const std::string nothing_stated = one.recalculated && !one.recalculated->states_otherwise()
                                               ? why_nothing_is_stated(*one.recalculated)
                                               : std::string();
        text += !nothing_stated.empty() ? "    " + nothing_stated + "\n"
                : one.no_draft.empty()  ? ""
                                        : "    no draft: " + one.no_draft + "\n";
        if (one.recalculated && !one.recalculated->rerun.not_evaluated) {
            const std::string waits = waits_for(one);
            text += one.recalculated->not_corrected.empty() ? ""
                                                            : "    not corrected, because its job states it itself: " +
                                                                  in_words(one.recalculated->not_corrected) + "\n";
            text += !waits.empty() ? "    it rests on " + text::visible(waits, 120) + "\n"
                    : one.rests_on.empty()
                        ? ""
                        : "    it rests on " + text::visible(one.rests_on.front().number, 80) +
                              (one.rests_on.size() > 1 ? " and others, which come" : ", which comes") +
                              " out the same" +
                              (one.recalculated->takes_standard ? "\n" : ", and on nothing else of the standard\n");
            const std::string& of_version = one.recalculated->version_in_words;
            text += of_version.empty() ? "" : "    " + of_version + "\n";
        }
        constexpr std::size_t k_most_texts = 3;
        for (std::size_t i = 0; one.recalculated && i < std::min(one.recalculated->texts.size(), k_most_texts); ++i) {
            const evaluation::RecordChange& change = one.recalculated->texts[i];
            text += "    " + text::visible(change.place, 80) + ": " + text::in_quotes(change.before) + " -> " +
                    text::in_quotes(change.now) + "\n";
        }
    }
    const auto unknown = std::count_if(affected.begin(), affected.end(), [](const AffectedCertificate& one) {
        return one.recalculated && one.recalculated->rerun.not_evaluated;
    });
    return text + text::count_of(static_cast<std::int64_t>(affected.size()), "certificate") + " affected" +
           (unknown > 0 ? ", " + std::to_string(unknown) + " of which could not be calculated again" : "") + "\n";
}

std::string affected_json(const std::vector<AffectedCertificate>& affected, const WrongStandard& standard) {
    nlohmann::json list = nlohmann::json::array();
    for (const AffectedCertificate& one : affected) {
        nlohmann::json because = nlohmann::json::array();
        for (const StandardReference& reference : one.because) {
            because.push_back({{"kind", word_of(reference.kind)}, {"text", reference.text}});
        }
        nlohmann::json rests_on = nlohmann::json::array();
        for (const FoundBefore& other : one.rests_on) {
            rests_on.push_back({{"number", other.number}, {"state", other.state}, {"same", other.is_same}});
        }
        nlohmann::json shown{
            {"number", one.certificate.number},
            {"state", one.certificate.state},
            {"item", one.certificate.item},
            {"record", one.certificate.record},
            {"used_from", one.used_from},
            {"used_to", one.used_to},
            {"because", std::move(because)},
            {"through", one.through},
            {"through_state", one.through_state},
            {"also_through", one.through.empty() && !one.rests_on.empty() ? one.rests_on.front().number : ""},
            {"rests_on", std::move(rests_on)},
            {"withdrawn_amendment", one.withdrawn_amendment},
            {"amendment_under_way", one.amendment_under_way},
            {"taken_numbers", one.taken_numbers},
            {"version_in_words", ""},
            {"not_corrected", nlohmann::json::array()},
            {"outcome", outcome_of(one)},
            {"shift", nullptr},
            {"changes", nlohmann::json::array()},
            {"draft", one.draft_folder},
            {"no_draft", one.no_draft},
            {"cannot_say", ""}};
        if (one.recalculated) {
            const evaluation::RerunRecord& rerun = one.recalculated->rerun;
            shown["changes"] = shown_change_list(*one.recalculated);
            shown["not_corrected"] = one.recalculated->not_corrected;
            shown["version_in_words"] = one.recalculated->version_in_words;
            if (rerun.not_evaluated) {
                shown["cannot_say"] = rerun.not_evaluated->what;
            } else if (is_calculated(one)) {
                shown["shift"] = one.recalculated->shift;
            }
        }
        list.push_back(std::move(shown));
    }
    return gumcert::json::canonical_json({{"schema", "gumcert/archive-affected/1"},
                                          {"standard", standard.name},
                                          {"since", standard.since},
                                          {"until", standard.until},
                                          {"certificates", std::move(list)}});
}

std::string affected_csv(const std::vector<AffectedCertificate>& affected) {
    std::string all = "number,state,used_from,used_to,through,because,outcome,shift,draft,through_state\n";
    for (const AffectedCertificate& one : affected) {
        all += text::csv_field(one.certificate.number) + "," + one.certificate.state + "," +
               text::csv_field(one.used_from) + "," + text::csv_field(one.used_to) + "," +
               text::csv_field(one.through) + "," + text::csv_field(one.because.front().text) + "," + outcome_of(one) +
               "," + (is_calculated(one) ? nlohmann::json(one.recalculated->shift).dump() : "") + "," +
               text::csv_field(one.draft_folder) + "," + one.through_state + "\n";
    }
    return all;
}

}  // namespace gumcert::archive
