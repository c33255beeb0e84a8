#include "gum/monte_carlo/worker_threads.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace gumcert::gum {
namespace {

TEST(WorkerThreads, DoesEveryTaskOnce) {
    for (const unsigned threads : {1U, 2U, 5U}) {
        WorkerThreads workers(threads);
        for (int repeat = 0; repeat < 20; ++repeat) {
            std::vector<int> done(100, 0);
            workers.run(done.size(), [&](unsigned worker, std::size_t task) {
                ASSERT_LT(worker, workers.size());
                ++done[task];
            });
            EXPECT_EQ(done, std::vector<int>(100, 1));
        }
    }
}

// The failure with the lowest number, whatever thread comes first.
TEST(WorkerThreads, ThrowsTheFailureOfTheLowestTask) {
    for (const unsigned threads : {1U, 2U, 5U}) {
        WorkerThreads workers(threads);
        for (int repeat = 0; repeat < 20; ++repeat) {
            std::vector<int> done(50, 0);
            try {
                workers.run(done.size(), [&](unsigned /*worker*/, std::size_t task) {
                    if (task % 10 == 3) {
                        throw std::runtime_error(std::to_string(task));
                    }
                    ++done[task];
                });
                FAIL() << "no failure";
            } catch (const std::runtime_error& failure) {
                EXPECT_STREQ(failure.what(), "3");
            }
            EXPECT_EQ(done[0] + done[1] + done[2], 3) << "the tasks before it are done";
        }
        // The next run knows nothing of it.
        std::vector<int> again(4, 0);
        workers.run(again.size(), [&](unsigned /*worker*/, std::size_t task) { ++again[task]; });
        EXPECT_EQ(again, std::vector<int>(4, 1));
    }
}

TEST(WorkerThreads, CallingThreadIsOneOfThem) {
    WorkerThreads alone(1);
    EXPECT_EQ(alone.size(), 1U);
    alone.run(3, [caller = std::this_thread::get_id()](unsigned worker, std::size_t /*task*/) {
        EXPECT_EQ(worker, 0U);
        EXPECT_EQ(std::this_thread::get_id(), caller);
    });
    EXPECT_GE(WorkerThreads(0).size(), 1U);
    EXPECT_EQ(WorkerThreads(3).size(), 3U);
    WorkerThreads(2).run(0, [](unsigned /*worker*/, std::size_t /*task*/) { FAIL() << "there is no task"; });
}

}  // namespace
}  // namespace gumcert::gum
