#include "archive/certificates/shared_work.h"

#include <atomic>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "archive/certificates/message_json.h"
#include "encoding/sha2.h"
#include "json/canonical_json.h"
#include "json/members.h"

namespace gumcert::archive {

namespace {

using nlohmann::json;

constexpr const char* k_recalculation = "affected";
constexpr const char* k_replay = "replay";
constexpr std::size_t k_tasks_of_a_thread = 8;  // what a worker that is killed loses, at most

std::string dumped(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

gum::Diagnostic diagnostic_in(const json& value) {
    return {.code = gumcert::json::text_of(value, "code"),
            .where = gumcert::json::text_of(value, "where"),
            .what = gumcert::json::text_of(value, "what"),
            .rule = gumcert::json::text_of(value, "rule"),
            .action = gumcert::json::text_of(value, "action")};
}

json as_list(const std::vector<certificate::Change>& changes) {
    json list = json::array();
    for (const certificate::Change& change : changes) {
        list.push_back({change.kind, change.where, change.before, change.after});
    }
    return list;
}

std::vector<certificate::Change> changes_in(const json& list) {
    std::vector<certificate::Change> changes;
    for (const json& change : list) {
        changes.push_back({.kind = change.at(0).get<std::string>(),
                           .where = change.at(1).get<std::string>(),
                           .before = change.at(2).get<std::string>(),
                           .after = change.at(3).get<std::string>()});
    }
    return changes;
}

std::string as_text(const Recalculation& one) {
    json changes = json::array();
    for (const evaluation::RecordChange& change : one.rerun.changes) {
        changes.push_back({static_cast<int>(change.kind), change.place, change.before, change.now});
    }
    json texts = json::array();
    for (const evaluation::RecordChange& change : one.texts) {
        texts.push_back({change.place, change.before, change.now});
    }
    return dumped({{"changes", std::move(changes)},
                   {"stated", as_list(one.stated)},
                   {"of_version", as_list(one.of_version)},
                   {"version_in_words", one.version_in_words},
                   {"texts", std::move(texts)},
                   {"results_change", one.results_change},
                   {"not_corrected", one.not_corrected},
                   {"takes_standard", one.takes_standard},
                   {"not_read", one.not_read},
                   {"sources", one.sources},
                   {"counts", one.rerun.counts},
                   {"made_by", {one.rerun.made_by.version, one.rerun.made_by.commit}},
                   {"kind", one.rerun.kind},
                   {"cannot_say", one.rerun.not_evaluated ? as_json(*one.rerun.not_evaluated) : json()},
                   {"shift", one.shift}});
}

Recalculation recalculation_in(const std::string& number, const std::string& text) {
    const json value = json::parse(text);
    Recalculation one{.rerun = {.name = number}, .shift = value.at("shift").get<double>()};
    one.rerun.made_by.version = value.at("made_by").at(0).get<std::string>();
    one.rerun.made_by.commit = value.at("made_by").at(1).get<std::string>();
    one.rerun.kind = gumcert::json::text_of(value, "kind");
    one.results_change = value.at("results_change").get<bool>();
    one.not_corrected = value.at("not_corrected").get<std::vector<std::string>>();
    one.takes_standard = value.at("takes_standard").get<bool>();
    one.not_read = value.at("not_read").get<std::string>();
    one.sources = value.at("sources").get<std::vector<std::string>>();
    value.at("counts").get_to(one.rerun.counts);
    for (const json& change : value.at("changes")) {
        one.rerun.changes.push_back({static_cast<evaluation::ChangeKind>(change.at(0).get<int>()),
                                     change.at(1).get<std::string>(), change.at(2).get<std::string>(),
                                     change.at(3).get<std::string>()});
    }
    one.stated = changes_in(value.at("stated"));
    one.of_version = changes_in(value.at("of_version"));
    one.version_in_words = value.at("version_in_words").get<std::string>();
    for (const json& change : value.at("texts")) {
        one.texts.push_back({evaluation::ChangeKind::other, change.at(0).get<std::string>(),
                             change.at(1).get<std::string>(), change.at(2).get<std::string>()});
    }
    if (!value.at("cannot_say").is_null()) {
        one.rerun.not_evaluated = diagnostic_in(value.at("cannot_say"));
    }
    return one;
}

std::string as_text(const Replay& one) {
    json differences = json::array();
    for (const gum::Diagnostic& difference : one.differences) {
        differences.push_back(as_json(difference));
    }
    return dumped({{"made_by", one.made_by}, {"evaluated", one.evaluated}, {"differences", std::move(differences)}});
}

Replay replay_in(const std::string& text) {
    const json value = json::parse(text);
    Replay one{.made_by = gumcert::json::text_of(value, "made_by"),
               .evaluated = value.at("evaluated").get<bool>(),
               .differences = {}};
    for (const json& difference : value.at("differences")) {
        one.differences.push_back(diagnostic_in(difference));
    }
    return one;
}

/// Two who ask the same share one work; the first who has told its results removes it.
void require_all(std::size_t results, const WorkToShare& shared) {
    if (results != shared.tasks.size()) {
        throw gum::StorageError(gum::Diagnostic{
            .code = "GC-ARCHIVE-0063",
            .where = "work " + shared.work.id,
            .what = std::to_string(results) + " of " + std::to_string(shared.tasks.size()) + " results are there",
            .rule = "shared work is told when all of its results are there",
            .action = "somebody else has asked the same, and was told before; ask again"});
    }
}

/// With an identification that says all that the results depend on.
WorkToShare identified(WorkToShare shared) {
    json all{{"program", shared.work.program}, {"kind", shared.work.kind}, {"input", shared.work.input}};
    for (const WorkTask& task : shared.tasks) {
        all["tasks"].push_back({task.name, task.input});
    }
    shared.work.id = encoding::sha256(gumcert::json::canonical_json(all));
    return shared;
}

}  // namespace

WorkToShare work_of(const std::vector<AffectedCertificate>& affected, const Correction& correction,
                    const std::string& program) {
    WorkToShare shared{
        .work = {.id = {},
                 .program = program,
                 .kind = k_recalculation,
                 .input = dumped({{"standard", correction.standard}, {"corrected", correction.corrected}})},
        .tasks = {}};
    for (const AffectedCertificate& one : affected) {
        shared.tasks.push_back({one.certificate.number, dumped({{"record", one.certificate.record}})});
    }
    return identified(std::move(shared));
}

WorkToShare work_of_replay(const std::vector<std::pair<std::string, std::string>>& records,
                           const std::string& program) {
    WorkToShare shared{.work = {.id = {}, .program = program, .kind = k_replay, .input = "{}"}, .tasks = {}};
    for (const auto& [number, record] : records) {
        shared.tasks.push_back({number, dumped({{"record", record}})});
    }
    return identified(std::move(shared));
}

std::size_t ArchiveWorker::do_some(const SharedWork& work) {
    const json input = json::parse(work.input);
    const Correction correction{.standard = gumcert::json::text_of(input, "standard"),
                                .corrected = gumcert::json::text_of(input, "corrected"),
                                .reason = {},
                                .templates = templates_,
                                .watch = watch_};
    if (work.kind != k_recalculation && work.kind != k_replay) {
        throw std::logic_error("work of a kind that this version does not know: " + work.kind);
    }
    std::atomic<std::size_t> not_evaluated = 0;
    const auto work_at = [&](const std::vector<WorkTask>& tasks) {
        std::vector<std::string> records;  // the archive is asked by one thread
        for (const WorkTask& task : tasks) {
            records.push_back(archive_.content(gumcert::json::text_of(json::parse(task.input), "record")).value_or(""));
        }
        std::vector<std::string> results(tasks.size());
        not_evaluated = 0;  // the table may ask again
        threads_.run(tasks.size(), [&](unsigned /*worker*/, std::size_t i) {
            bool is_evaluated = false;
            if (work.kind == k_replay) {
                const Replay replay =
                    replay_record(records[i], tasks[i].name, 1, templates_, watch_ ? watch_() : gum::Progress());
                is_evaluated = replay.evaluated;
                results[i] = as_text(replay);
            } else {
                const Recalculation again = recalculation_of(tasks[i].name, records[i], correction);
                is_evaluated = !again.rerun.not_evaluated;
                results[i] = as_text(again);
            }
            not_evaluated += is_evaluated ? 0 : 1;
        });
        return results;
    };
    const std::size_t done = table_.do_some(work.id, k_tasks_of_a_thread * threads_.size(), work_at);
    not_evaluated_ += not_evaluated;
    return done;
}

void ArchiveWorker::finish(const WorkToShare& shared, const std::function<void()>& wait,
                           const gum::Progress& progress) {
    table_.add(shared.work, shared.tasks);
    while (const std::size_t open = table_.open_tasks(shared.work.id)) {
        if (progress) {
            progress(std::to_string(shared.tasks.size() - open) + " of " + std::to_string(shared.tasks.size()) +
                     " done by all workers");
        }
        if (do_some(shared.work) == 0) {
            wait();
        }
    }
}

void take_results(std::vector<AffectedCertificate>& affected, WorkTable& table, const WorkToShare& shared) {
    std::map<std::string, AffectedCertificate*> by_number;
    for (AffectedCertificate& one : affected) {
        by_number[one.certificate.number] = &one;
    }
    std::size_t found = 0;
    table.each_result(shared.work.id, [&](const std::string& number, const std::string& result) {
        by_number.at(number)->recalculated = recalculation_in(number, result);
        ++found;
    });
    require_all(found, shared);
    rank(affected);
}

std::vector<std::pair<std::string, Replay>> replays_in(WorkTable& table, const WorkToShare& shared) {
    std::vector<std::pair<std::string, Replay>> replays;
    table.each_result(shared.work.id, [&](const std::string& number, const std::string& result) {
        replays.emplace_back(number, replay_in(result));
    });
    require_all(replays.size(), shared);
    return replays;
}

}  // namespace gumcert::archive
