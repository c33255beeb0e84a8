#include "archive/certificates/shared_work.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "archive/store/sqlite_store.h"
#include "evaluation/evaluate_job.h"
#include "evaluation/read_file.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

const std::filesystem::path k_shared_tree(GUMCERT_SOURCE_DIR);

/// A table without a server; archive/store/work_table_test.cpp tries the one on a server.
class TableInMemory : public WorkTable {
public:
    void add(const SharedWork& work, const std::vector<WorkTask>& tasks) override {
        if (work_.emplace(work.id, work).second) {
            tasks_[work.id] = tasks;
        }
    }
    std::optional<SharedWork> next(const std::string& program) override {
        for (const auto& [id, work] : work_) {
            if (work.program == program && open_tasks(id) > 0) {
                return work;
            }
        }
        return std::nullopt;
    }
    std::size_t do_some(const std::string& id, std::size_t most, const DoTasks& work) override {
        std::vector<WorkTask> some;
        for (const WorkTask& task : tasks_[id]) {
            if (some.size() < most && !results_[id].contains(task.name)) {
                some.push_back(task);
            }
        }
        const std::vector<std::string> results = work(some);
        for (std::size_t i = 0; i < some.size(); ++i) {
            results_[id][some[i].name] = results[i];
        }
        return some.size();
    }
    std::size_t open_tasks(const std::string& id) override { return tasks_[id].size() - results_[id].size(); }
    void each_result(const std::string& id,
                     const std::function<void(const std::string&, const std::string&)>& visit) override {
        for (const auto& [name, result] : results_[id]) {
            visit(name, result);
        }
    }
    void remove(const std::string& id) override {
        work_.erase(id);
        tasks_.erase(id);
        results_.erase(id);
    }

private:
    std::map<std::string, SharedWork> work_;
    std::map<std::string, std::vector<WorkTask>> tasks_;
    std::map<std::string, std::map<std::string, std::string>> results_;
};

class SharedWorkOfAnArchive : public testing::Test {
protected:
    SharedWorkOfAnArchive() {
        const std::string record = reports::to_canonical_json(evaluation::evaluate_job(folder_ / "end_gauge.json",
                                                                                       evaluation::CovarianceFile::none,
                                                                                       1, k_shared_tree / "templates")
                                                                  .record);
        for (const auto& [number, bytes] : {std::pair("EX-1", record), std::pair("EX-2", record + "\n"),
                                            std::pair("EX-3", std::string(R"({"source": "STD-017"})"))}) {
            Draft draft = test::sample_draft(number);
            draft.record = bytes;
            (void)archive_.draft(draft, {.actor = "A. Author", .at = clock_.next(), .request_key = "", .why = ""});
        }
    }

    const std::filesystem::path folder_ = k_shared_tree / "examples" / "laboratory";
    test::StoreFolder store_folder_;
    test::Clock clock_;
    std::unique_ptr<Store> store_ = create_sqlite_store(
        store_folder_.file(),
        first_entry({}, "gumcert", "nonce", {.actor = "K. Keeper", .at = clock_.next(), .request_key = "", .why = ""}));
    Archive archive_{*store_};
    TableInMemory table_;
    int waits_ = 0;
};

TEST_F(SharedWorkOfAnArchive, GivesWhatOneMachineGives) {
    std::string corrected = evaluation::read_file(folder_ / "laboratory" / "standards" / "STD-017.json");
    corrected.replace(corrected.find("50.000623"), 9, "50.001623");
    corrected.replace(corrected.find("NMI-2026-0117"), 13, "NMI-2026-9999");
    const Correction correction{
        .standard = "STD-017", .corrected = corrected, .reason = "r", .templates = k_shared_tree / "templates"};
    const WrongStandard wrong{"STD-017", "2026-03-02", ""};
    std::vector<AffectedCertificate> alone = find_affected(archive_, wrong, 1);
    std::vector<AffectedCertificate> shared = alone;
    recalculate(alone, archive_, correction, 2);
    ASSERT_TRUE(
        std::any_of(alone.begin(), alone.end(), [](const auto& one) { return !one.recalculated->texts.empty(); }));

    const WorkToShare work = work_of(shared, correction, "1.0 (commit x)");
    ArchiveWorker worker(archive_, table_, 2, k_shared_tree / "templates");
    table_.add(work.work, work.tasks);
    EXPECT_EQ(worker.do_some(*table_.next("1.0 (commit x)")), 3U) << "somebody else was there before";
    EXPECT_EQ(worker.not_evaluated(), 1U) << "EX-3";
    worker.finish(work, [&] { ++waits_; }, {});
    EXPECT_EQ(waits_, 0);
    take_results(shared, table_, work);
    EXPECT_EQ(affected_json(shared, wrong), affected_json(alone, wrong));
    for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_EQ(shared[i].recalculated->rerun.counts, alone[i].recalculated->rerun.counts);
        EXPECT_EQ(shared[i].recalculated->shift, alone[i].recalculated->shift);
        EXPECT_EQ(shared[i].recalculated->rerun.not_evaluated, alone[i].recalculated->rerun.not_evaluated);
        EXPECT_EQ(shared[i].recalculated->rerun.made_by.version, alone[i].recalculated->rerun.made_by.version);
        EXPECT_EQ(shared[i].recalculated->rerun.kind, alone[i].recalculated->rerun.kind);
    }
}

TEST_F(SharedWorkOfAnArchive, ReplaysWithOthers) {
    std::vector<std::pair<std::string, std::string>> records;
    for (const ListedCertificate& one : archive_.list()) {
        records.emplace_back(one.number, one.record);
    }
    const WorkToShare work = work_of_replay(records, "1.0 (commit x)");
    ArchiveWorker worker(archive_, table_, 1, k_shared_tree / "templates");
    worker.finish(work, [&] { ++waits_; }, {});
    EXPECT_EQ(worker.not_evaluated(), 1U) << "EX-3";
    const std::vector<std::pair<std::string, Replay>> replays = replays_in(table_, work);
    ASSERT_EQ(replays.size(), 3U);
    for (const auto& [number, shared] : replays) {
        const Replay alone = replay_record(archive_.record_of(number), number, 1, k_shared_tree / "templates");
        EXPECT_EQ(shared.made_by, alone.made_by);
        EXPECT_EQ(shared.evaluated, alone.evaluated);
        EXPECT_EQ(shared.differences, alone.differences);
    }
    EXPECT_TRUE(replays[0].second.differences.empty());
    table_.remove(work.work.id);
    EXPECT_EQ(test::code_of([&] { (void)replays_in(table_, work); }), "GC-ARCHIVE-0063");
    EXPECT_FALSE(replays[2].second.evaluated);
}

TEST_F(SharedWorkOfAnArchive, IsNamedByWhatItsResultsDependOn) {
    const std::vector<std::pair<std::string, std::string>> records{{"EX-1", "a"}};
    const std::string id = work_of_replay(records, "1.0").work.id;
    EXPECT_EQ(work_of_replay(records, "1.0").work.id, id);
    EXPECT_NE(work_of_replay(records, "1.1").work.id, id);
    EXPECT_NE(work_of_replay({{"EX-1", "b"}}, "1.0").work.id, id);
    const Correction correction{.standard = "S", .corrected = "{}", .reason = "r", .templates = {}};
    Correction other = correction;
    other.corrected = "{ }";
    EXPECT_NE(work_of({}, correction, "1.0").work.id, work_of({}, other, "1.0").work.id);
    EXPECT_THROW((void)ArchiveWorker(archive_, table_, 1, {}).do_some({"x", "1.0", "something else", "{}"}),
                 std::logic_error);
}

}  // namespace
}  // namespace gumcert::archive
