#include "jobs/job_limits.h"

#include <gtest/gtest.h>

#include <limits>

namespace gumcert::jobs {
namespace {

TEST(JobLimits, ACoverageFactorIsUnusualWhereItMayBeAProbability) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double k : {1.0, 1.65, 2.0, 3.0, 13.97, 14.0}) {
        EXPECT_FALSE(is_unusual_coverage_factor(k, infinite)) << k;
    }
    for (const double k : {0.95, 0.1, 95.0, 95.45}) {
        EXPECT_TRUE(is_unusual_coverage_factor(k, infinite)) << k;
    }
    EXPECT_FALSE(is_unusual_coverage_factor(63.7, 1.0)) << "99 % with one degree of freedom";
    EXPECT_TRUE(is_unusual_coverage_factor(0.95, 1.0));
}

}  // namespace
}  // namespace gumcert::jobs
