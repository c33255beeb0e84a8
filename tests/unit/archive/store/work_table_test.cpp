#include "archive/store/work_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "tests/support/postgresql_server.h"

namespace gumcert::archive {
namespace {

using test::PostgresqlServer;

class WorkTableTest : public testing::Test {
protected:
    void SetUp() override {
        SKIP_WITHOUT_POSTGRESQL();
        address_ = PostgresqlServer::get()->new_database();
    }
    static std::vector<WorkTask> tasks(int count) {
        std::vector<WorkTask> all;
        for (int i = 0; i < count; ++i) {
            all.push_back({"EX-" + std::to_string(i), R"({"a": "\\ \" {,} ä"})"});
        }
        return all;
    }
    static std::vector<std::string> echo(const std::vector<WorkTask>& some) {
        std::vector<std::string> results;
        for (const WorkTask& task : some) {
            results.push_back(task.name + task.input);
        }
        return results;
    }
    [[nodiscard]] std::map<std::string, std::string> results(WorkTable& table) const {
        std::map<std::string, std::string> found;
        table.each_result("one", [&](const std::string& name, const std::string& result) {
            EXPECT_TRUE(found.emplace(name, result).second);
        });
        return found;
    }

    const SharedWork work_{"one", "1.0 (commit x)", "echo", "{}"};
    std::string address_;
};

TEST_F(WorkTableTest, HasNothingBeforeSomebodyAsks) {
    EXPECT_FALSE(open_work_table(address_)->next("1.0 (commit x)").has_value());
}

TEST_F(WorkTableTest, IsDoneOnceByManyWorkers) {
    constexpr int k_tasks = 2500;
    const auto table = open_work_table(address_);
    table->add(work_, tasks(k_tasks));
    table->add(work_, tasks(k_tasks));  // asked for again
    EXPECT_FALSE(table->next("2.0 (commit y)").has_value()) << "another program leaves it alone";
    std::mutex mutex;
    std::map<std::string, int> times;
    std::vector<std::thread> workers;
    for (int worker = 0; worker < 4; ++worker) {
        workers.emplace_back([&] {
            const auto own = open_work_table(address_);
            while (const std::optional<SharedWork> next = own->next(work_.program)) {
                EXPECT_EQ(next->input, "{}");
                (void)own->do_some(next->id, 20, [&](const std::vector<WorkTask>& some) {
                    const std::scoped_lock lock(mutex);
                    for (const WorkTask& task : some) {
                        ++times[task.name];
                    }
                    return echo(some);
                });
            }
        });
    }
    for (std::thread& worker : workers) {
        worker.join();
    }
    EXPECT_EQ(table->open_tasks("one"), 0U);
    EXPECT_EQ(times.size(), static_cast<std::size_t>(k_tasks));
    EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](const auto& one) { return one.second == 1; }));
    const std::map<std::string, std::string> found = results(*table);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(k_tasks));
    EXPECT_EQ(found.at("EX-7"), "EX-7" + tasks(1)[0].input);
    table->remove("one");
    EXPECT_TRUE(results(*table).empty());
}

TEST_F(WorkTableTest, GivesBackWhatAWorkerDidNotFinish) {
    const auto table = open_work_table(address_);
    table->add(work_, tasks(30));
    EXPECT_THROW((void)table->do_some("one", 20,
                                      [](const std::vector<WorkTask>&) -> std::vector<std::string> {
                                          throw std::runtime_error("on the way");
                                      }),
                 std::runtime_error);
    EXPECT_EQ(table->open_tasks("one"), 30U);
    // While one worker has its tasks, others take what is left and do not wait.
    EXPECT_EQ(table->do_some("one", 20,
                             [&](const std::vector<WorkTask>& some) {
                                 const auto other = open_work_table(address_);
                                 EXPECT_EQ(other->do_some("one", 20, echo), 10U);
                                 EXPECT_EQ(other->do_some("one", 20, echo), 0U);
                                 return echo(some);
                             }),
              20U);
    EXPECT_EQ(results(*table).size(), 30U);
}

}  // namespace
}  // namespace gumcert::archive
