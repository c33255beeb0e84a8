#include "engine/fixed_parts.h"

#include <gtest/gtest.h>

#include <exception>
#include <functional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

/// Every task on a thread of its own, the last one first.
void all_at_once(std::size_t tasks, const std::function<void(std::size_t)>& task) {
    std::vector<std::thread> threads;
    std::vector<std::exception_ptr> failures(tasks);
    for (std::size_t i = tasks; i-- > 0;) {
        threads.emplace_back([&, i] {
            try {
                task(i);
            } catch (...) {
                failures[i] = std::current_exception();
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const std::exception_ptr& failure : failures) {
        if (failure) {
            std::rethrow_exception(failure);
        }
    }
}

using Part = std::pair<std::size_t, std::size_t>;

std::vector<Part> ranges(const FixedParts& parts, const Workers& workers) {
    std::vector<Part> result(parts.parts());
    parts.run(workers, [&](std::size_t part, std::size_t begin, std::size_t end) { result[part] = {begin, end}; });
    return result;
}

TEST(FixedParts, AreTheSameForAnyNumberOfThreads) {
    for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 64U, 65U}) {
        const FixedParts parts(count, 8);
        const std::vector<Part> alone = ranges(parts, nullptr);
        EXPECT_EQ(alone, ranges(parts, all_at_once));
        std::size_t next = 0;
        for (const auto& [begin, end] : alone) {
            EXPECT_EQ(begin, next);
            EXPECT_GT(end, begin);
            next = end;
        }
        EXPECT_EQ(next, count);
    }
}

TEST(FixedParts, ThrowWhatAPartThrows) {
    const auto fails = [](std::size_t part, std::size_t, std::size_t) {
        if (part == 2) {
            throw std::runtime_error("third");
        }
    };
    EXPECT_THROW(FixedParts(40, 8).run(nullptr, fails), std::runtime_error);
    EXPECT_THROW(FixedParts(40, 8).run(all_at_once, fails), std::runtime_error);
}

TEST(FixedParts, AnEvaluationHasTheSameBitsForAnyNumberOfThreads) {
    synthetic::CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(150);
    const synthetic::Campaign campaign = synthetic::simulate(plan);
    const auto evaluated = [&](const Workers& workers) {
        EvaluationOptions options;
        options.chi_square_upper_tail = [](double chi_square, double) { return 1.0 / (1.0 + chi_square); };
        options.workers = workers;
        return evaluate_jointly(campaign.measurement, options);
    };
    const RotaryTableSolution alone = evaluated(nullptr);
    const RotaryTableSolution shared = evaluated(all_at_once);
    EXPECT_EQ(alone.values, shared.values);
    EXPECT_EQ(alone.covariance.dense(), shared.covariance.dense());
    EXPECT_EQ(alone.chi_square, shared.chi_square);
    EXPECT_EQ(alone.stochastic.variance_axial, shared.stochastic.variance_axial);
    ASSERT_EQ(alone.reliability.size(), shared.reliability.size());
    for (std::size_t i = 0; i < alone.reliability.size(); ++i) {
        EXPECT_EQ(alone.reliability[i].test_value, shared.reliability[i].test_value);
    }
    ASSERT_EQ(alone.groups->tests.size(), shared.groups->tests.size());
    for (std::size_t i = 0; i < alone.groups->tests.size(); ++i) {
        EXPECT_EQ(alone.groups->tests[i].chi_square, shared.groups->tests[i].chi_square);
    }
}

}  // namespace
}  // namespace gumcert::engine
