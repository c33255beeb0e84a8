#include "evaluation/rerun_record.h"

#include <gumcert_build_info.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "evaluation/recompute_record.h"
#include "evaluation/record_differences.h"
#include "json/canonical_json.h"
#include "reports/record/record_value.h"
#include "text/csv_field.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::evaluation {

namespace {

using nlohmann::json;

constexpr std::size_t k_most_lines = 100;  // for people, of one record
constexpr const char* k_limit_reached = "GC-STORE-0024";

/// Members of a record that hold no result: what was read, how, and what is said of it.
bool holds_results(std::string_view pointer) {
    const std::string_view first = pointer.substr(0, std::min(pointer.find('/', 1), pointer.size()));
    static const std::set<std::string_view> k_others{"/audit",   "/diagnostics",      "/digest",   "/job",
                                                     "/options", "/profile",          "/software", "/statements",
                                                     "/title",   "/title_by_language"};
    return !k_others.contains(first) && !pointer.starts_with("/certificate/data") &&
           !pointer.starts_with("/certificate/profile") && !pointer.starts_with("/certificate/findings");
}

bool is_or_in(std::string_view pointer, std::string_view member) {
    return pointer.starts_with(member) && (pointer.size() == member.size() || pointer[member.size()] == '/');
}

bool is_printed(std::string_view key) {
    return key == "printed" || key.starts_with("printed_");
}

bool is_verdict(std::string_view key) {
    static const std::set<std::string_view> k_verdicts{
        "accepted", "blocked",    "consistent", "flagged", "method", "raised",    "realism", "removed",
        "signal",   "stabilised", "suspicious", "symbol",  "used",   "validated", "verdict", "verdict_from_printed"};
    return k_verdicts.contains(key);
}

/// Whether digits that documents print stand somewhere in a value.
bool holds_print(const json& value) {
    if (!value.is_structured()) {
        return false;
    }
    for (const auto& [key, item] : value.items()) {
        if ((value.is_object() && is_printed(key) && !item.empty() && item != "") || holds_print(item)) {
            return true;
        }
    }
    return false;
}

ChangeKind kind_of_change(std::string_view pointer, const json* before, const json* now) {
    if (!holds_results(pointer)) {
        return ChangeKind::other;
    }
    if (before == nullptr) {  // what this version says in addition changes nothing that was said
        return ChangeKind::other;
    }
    bool printed = false;
    std::string_view key;
    for (std::size_t at = 1; at <= pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', at), pointer.size());
        key = pointer.substr(at, end - at);
        printed = printed || is_printed(key);
        at = end + 1;
    }
    if (printed) {
        return *before == "" || before->empty() ? ChangeKind::other : ChangeKind::printed;
    }
    if (holds_print(*before)) {
        return ChangeKind::printed;
    }
    if (is_verdict(key)) {
        return now == nullptr ? ChangeKind::other : ChangeKind::verdict;
    }
    const bool numbers = before->is_number() || (now != nullptr && now->is_number()) || before->is_array();
    return numbers && now != nullptr ? ChangeKind::number : ChangeKind::other;
}

/// A text without its quotes.
std::string as_read(const json* value) {
    if (value == nullptr) {
        return "";
    }
    const std::string shown = shown_value(*value);
    return value->is_string() && shown.size() > 1 && shown.ends_with('"') ? shown.substr(1, shown.size() - 2) : shown;
}

std::string or_nothing(const std::string& text) {
    return text.empty() ? "nothing" : text::visible(text, 120);
}

void add_changes(std::string& all, const RerunRecord& record) {
    std::size_t lines = 0;
    for (const RecordChange& change : record.changes) {
        if (change.kind == ChangeKind::other) {
            continue;
        }
        if (++lines > k_most_lines) {
            break;
        }
        all += std::string("  ") + word_of(change.kind) +
               std::string(9 - std::string_view(word_of(change.kind)).size(), ' ') + text::visible(change.place, 200) +
               "  " + or_nothing(change.before) + " → " + or_nothing(change.now) + "\n";
    }
    const std::size_t told =
        record.count(ChangeKind::printed) + record.count(ChangeKind::verdict) + record.count(ChangeKind::number);
    const std::size_t shown = std::min(lines, k_most_lines);
    if (told > shown) {
        all += "  and " + text::count_of(static_cast<std::int64_t>(told - shown), "more place") +
               "; --format json lists them\n";
    }
    if (const std::size_t others = record.count(ChangeKind::other); others > 0) {
        all += "  and " + text::count_of(static_cast<std::int64_t>(others), "place") +
               " without a result of the old record (words, options, audit, what is new); --format json lists them\n";
    }
}

std::string counts_in_words(const RerunRecord& record) {
    std::vector<std::string> parts;
    const auto add = [&](ChangeKind kind, const char* noun) {
        if (record.count(kind) > 0) {
            parts.push_back(text::count_of(static_cast<std::int64_t>(record.count(kind)), noun));
        }
    };
    add(ChangeKind::printed, "printed place");
    add(ChangeKind::verdict, "verdict");
    add(ChangeKind::number, "unrounded number");
    return text::all_of(parts);
}

std::string maker(const reports::Software& software) {
    return software.name + " " + software.version + ", " + software.commit;
}

}  // namespace

const char* word_of(ChangeKind kind) {
    switch (kind) {
        case ChangeKind::printed:
            return "printed";
        case ChangeKind::verdict:
            return "verdict";
        case ChangeKind::number:
            return "number";
        case ChangeKind::other:
            break;
    }
    return "other";
}

const char* RerunRecord::outcome() const {
    return not_evaluated                                                      ? "not_evaluated"
           : count(ChangeKind::printed) > 0 || count(ChangeKind::verdict) > 0 ? "changed"
           : count(ChangeKind::number) > 0                                    ? "numbers"
                                                                              : "same";
}

bool RerunRecord::was_ended() const {
    return not_evaluated && not_evaluated->code == k_limit_reached;
}

bool RerunRecord::is_negative() const {
    return not_evaluated || count(ChangeKind::printed) > 0 || count(ChangeKind::verdict) > 0;
}

void tell_changes(const json& before, const json& now, RerunRecord& rerun) {
    tell_differences(before, now, [&rerun](const std::string& pointer, const json* stated, const json* other) {
        if (is_or_in(pointer, "/digest") ||
            is_or_in(pointer, "/software")) {  // it follows from the rest, or differs by its nature
            return;
        }
        const ChangeKind kind = kind_of_change(pointer, stated, other);
        ++rerun.counts.at(static_cast<std::size_t>(kind));
        if (rerun.changes.size() < k_most_changes) {
            rerun.changes.push_back({kind, pointer, as_read(stated), as_read(other)});
        }
    });
}

RerunRecord rerun_record(const std::string& text, const std::string& name, unsigned threads,
                         const std::filesystem::path& templates, const gum::Progress& progress,
                         std::span<const Kind> kinds) {
    const auto [record, before] = reports::read_record(text, name);
    RerunRecord rerun{.name = name, .made_by = record.software, .kind = record.kind};
    rerun.not_evaluated = files_not_held(record, name);
    if (rerun.not_evaluated) {
        return rerun;
    }
    reports::EvaluationRecord evaluated;
    try {
        evaluated = evaluated_again(record, name, threads, templates, progress, kinds);
    } catch (const gum::InputError& error) {
        if (error.diagnostics().front().code != "GC-RECORD-0024") {
            throw;
        }
        rerun.not_evaluated = error.diagnostics().front();
        return rerun;
    } catch (const gum::StorageError& error) {
        if (error.diagnostics().front().code != k_limit_reached) {
            throw;
        }
        rerun.not_evaluated = error.diagnostics().front();
        return rerun;
    }
    tell_changes(before, reports::to_json_value(evaluated), rerun);
    return rerun;
}

std::string rerun_text(std::span<const RerunRecord> records, std::size_t refused) {
    std::string all;
    std::size_t same = 0;
    std::size_t changed = 0;
    std::size_t not_evaluated = refused;
    for (const RerunRecord& record : records) {
        all += text::visible(record.name, 200) + " (" + record.kind + ", made by " +
               text::visible(maker(record.made_by), 120) + "): ";
        if (record.not_evaluated) {
            ++not_evaluated;
            all +=
                "not evaluated\n  " + gum::message(*record.not_evaluated) + " [" + record.not_evaluated->code + "]\n";
            continue;
        }
        ++(record.is_negative() ? changed : same);
        const std::string counts = counts_in_words(record);
        all += counts.empty()         ? "the same in every number, printed digit and verdict\n"
               : record.is_negative() ? "changed: " + counts + "\n"
                                      : "the same in every printed digit and verdict; changed: " + counts + "\n";
        add_changes(all, record);
    }
    return all + (all.empty() ? "" : "\n") +
           text::count_of(static_cast<std::int64_t>(records.size() + refused), "record") +
           " named; evaluated with version " + std::string(k_version) + " (commit " + std::string(k_commit) +
           "): " + std::to_string(same) + " with the same printed digits and verdicts, " + std::to_string(changed) +
           " changed, " + std::to_string(not_evaluated) + " not evaluated\n";
}

std::string rerun_json(std::span<const RerunRecord> records) {
    json list = json::array();
    for (const RerunRecord& record : records) {
        json counts = json::object();
        for (std::size_t i = 0; i < k_change_kinds; ++i) {
            counts[word_of(static_cast<ChangeKind>(i))] = record.counts[i];
        }
        json changes = json::array();
        for (const RecordChange& change : record.changes) {
            changes.push_back({{"kind", word_of(change.kind)},
                               {"place", change.place},
                               {"before", change.before},
                               {"now", change.now}});
        }
        json one{
            {"record", record.name},
            {"kind", record.kind},
            {"made_by",
             {{"name", record.made_by.name}, {"version", record.made_by.version}, {"commit", record.made_by.commit}}},
            {"outcome", record.outcome()},
            {"counts", std::move(counts)},
            {"changes", std::move(changes)},
            {"not_evaluated", nullptr}};
        if (record.not_evaluated) {
            one["not_evaluated"] = {{"code", record.not_evaluated->code},
                                    {"message", gum::message(*record.not_evaluated)}};
        }
        list.push_back(std::move(one));
    }
    return gumcert::json::canonical_json(
        {{"schema", "gumcert/rerun/1"},
         {"software", {{"name", "gumcert"}, {"version", k_version}, {"commit", k_commit}}},
         {"records", std::move(list)}});
}

std::string rerun_csv(std::span<const RerunRecord> records) {
    std::string all = "record,outcome,kind,place,before,now\n";
    for (const RerunRecord& record : records) {
        const std::string head = text::csv_field(record.name) + "," + record.outcome() + ",";
        if (record.changes.empty()) {
            const std::string why = record.not_evaluated ? gum::message(*record.not_evaluated) : "";
            all += head + ",," + "," + text::csv_field(why) + "\n";
        }
        for (const RecordChange& change : record.changes) {
            all += head + word_of(change.kind) + "," + text::csv_field(change.place) + "," +
                   text::csv_field(change.before) + "," + text::csv_field(change.now) + "\n";
        }
    }
    return all;
}

}  // namespace gumcert::evaluation
