// Lengths whose digits say less than their stated uncertainty are told; sound ones are left in peace.
#include "jobs/rotary_table/rotary_table_rounding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gumcert::jobs {
namespace {

/// Lengths in steps of some nanometres, of two dead paths.
std::vector<engine::LengthObservation> lengths_in_steps_of(std::int64_t nanometres, std::size_t count = 40) {
    std::vector<engine::LengthObservation> lengths(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double length = 0.8 + 0.1 * std::sin(static_cast<double>(i) * 1.7);
        const double steps = std::round(length * 1e9 / static_cast<double>(nanometres));
        lengths[i].length = steps * static_cast<double>(nanometres) * 1e-9;
        lengths[i].dead_path = i % 2;
    }
    return lengths;
}

TEST(Rounding, FindsTheStepOfLengths) {
    for (const std::int64_t step : {10, 250, 1000, 5000, 10'000, 100'000}) {
        std::vector<engine::LengthObservation> lengths = lengths_in_steps_of(step);
        EXPECT_NEAR(step_of_lengths(lengths).value_or(0.0), static_cast<double>(step) * 1e-9, 1e-15);
        for (engine::LengthObservation& length : lengths) {
            length.length -= length.dead_path == 0 ? 0.123456789 : 0.0;
        }
        EXPECT_NEAR(step_of_lengths(lengths).value_or(0.0), static_cast<double>(step) * 1e-9, 1e-15)
            << "a preset of a dead path has digits of its own";
        lengths[7].length += 1e-9;
        EXPECT_NEAR(step_of_lengths(lengths).value_or(0.0), 1e-9, 1e-15) << "one length that is no multiple";
        lengths[7].length += 0.3e-9;
        EXPECT_FALSE(step_of_lengths(lengths)) << "digits beyond the nanometre";
    }
    EXPECT_FALSE(step_of_lengths(lengths_in_steps_of(1000, 10))) << "so few are multiples by chance";
    EXPECT_FALSE(step_of_lengths(std::vector<engine::LengthObservation>(40))) << "all alike";
    std::vector<engine::LengthObservation> pairs = lengths_in_steps_of(1000);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].dead_path = i / 3;
    }
    EXPECT_TRUE(step_of_lengths(pairs));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].dead_path = i == 0 ? 1 : i;
    }
    EXPECT_FALSE(step_of_lengths(pairs)) << "one difference is a multiple of itself";
    std::vector<engine::LengthObservation> twice = lengths_in_steps_of(1000, 15);
    twice.insert(twice.end(), twice.begin(), twice.end());
    EXPECT_FALSE(step_of_lengths(twice)) << "what comes back says nothing new";
}

}  // namespace
}  // namespace gumcert::jobs
