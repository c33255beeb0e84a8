// A size that is told of a scale error is the size that it has, or none is told.
#include "engine/rotary_table/evaluation/settled_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/planted_blunders.h"

namespace gumcert::engine {
namespace {

EvaluationOptions options_of_scales() {
    EvaluationOptions options;
    options.chi_square_upper_tail = [](double value, double nu) {
        return boost::math::cdf(
            boost::math::complement(boost::math::chi_squared_distribution<double>(nu), std::max(value, 0.0)));
    };
    return options;
}

/// Sound campaigns of several geometries, with repeatabilities that are estimated or given.
synthetic::CampaignPlan plan_for_size(std::uint64_t seed) {
    synthetic::CampaignPlan plan;
    plan.axis = seed % 3 == 0 ? RotaryAxis::a : seed % 3 == 1 ? RotaryAxis::b : RotaryAxis::c;
    plan.angles_deg = synthetic::full_turn(seed % 2 == 0 ? 12 : 8);
    plan.both_senses = seed % 4 == 0;
    plan.stations.resize(seed % 3 == 0 ? 6 : 5);
    plan.table_linear = 0.15e-6;
    plan.table_axial = 2e-6;
    plan.table_tilt = 1.5e-6;
    plan.temperature_difference = 0.5;
    plan.u_temperature = 0.03;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 0.5e-6;
    plan.start_values = true;
    plan.seed = seed;
    return plan;
}

RotaryTableMeasurement measured_for_size(const synthetic::CampaignPlan& plan) {
    RotaryTableMeasurement m = synthetic::simulate(plan).measurement;
    const std::uint64_t seed = plan.seed;
    m.table_repeatability = seed % 2 == 0 ? TableRepeatability{RepeatabilityMode::estimate, 0.0, 0.0, 0.0}
                                          : TableRepeatability{RepeatabilityMode::given, 0.15e-6, 2e-6, 1.5e-6};
    m.estimate_length_noise = seed % 2 == 0;
    m.outliers.test = OutlierTest::data_snooping;
    return m;
}

/// Every number that is told agrees with the scale that all distances, or those of one station, are too long by.
/// \param station  of all: the number of stations
void expect_true_size(RotaryTableMeasurement m, double scale, std::size_t station) {
    for (LengthObservation& length : m.lengths) {
        if (station >= m.stations.size() || length.station == station) {
            length.length *= 1.0 + scale;
        }
    }
    const bool of_all = station >= m.stations.size();
    try {
        const RotaryTableSolution solution = evaluate_jointly(m, options_of_scales());
        const GroupTest& first = solution.groups->tests.front();
        ASSERT_TRUE(first.suspicious);
        ASSERT_EQ(first.kind, of_all ? GroupKind::fixture_scale : GroupKind::station_scale);
        // Distances that are too long put the fixture larger than its coordinates, which are too small then.
        EXPECT_NEAR(first.estimate / (of_all ? -scale : scale), 1.0, 0.05);
        EXPECT_TRUE(first.is_settled);
        for (const GroupTest& test : solution.groups->tests) {
            EXPECT_TRUE(!test.suspicious || test.kind == first.kind || std::abs(test.estimate) < 3e-6)
                << static_cast<int>(test.kind) << ", " << test.estimate;
        }
    } catch (const gum::NoResultError& error) {
        const std::string told = error.what();
        const std::string words = "multiplied by about ";
        const std::size_t at = told.find(words);
        ASSERT_NE(at, std::string::npos) << told;
        EXPECT_NEAR(std::stod(told.substr(at + words.size())) * (1.0 + scale), 1.0, 0.1 * std::abs(scale) + 5e-6)
            << told;
    }
}

TEST(SettledErrors, AScaleIsToldWithItsSize) {
    std::uint64_t seed = 0;
    for (const double size : {50e-6, 150e-6, 300e-6, 500e-6, 700e-6, 1000e-6, 1700e-6, 3000e-6}) {
        for (const bool of_all : {true, false}) {
            const double scale = ++seed % 3 == 0 ? -size : size;
            SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(1e6 * scale) + " ppm");
            const RotaryTableMeasurement m = measured_for_size(plan_for_size(seed));
            expect_true_size(m, scale, of_all ? m.stations.size() : 3);
        }
    }
}

/// The size of a kind that is told; 0 where it is not.
double told_size(const RotaryTableSolution& solution, GroupKind kind) {
    const auto found = std::ranges::find_if(
        solution.groups->tests, [kind](const GroupTest& test) { return test.suspicious && test.kind == kind; });
    return found == solution.groups->tests.end() ? 0.0 : found->estimate;
}

/// Distances that are outlying beside a scale are not left out of the tests of groups where they come together.
TEST(SettledErrors, ADisturbedVisitIsToldBesideAScale) {
    constexpr double k_scale = 200e-6, k_size = 10e-6;
    for (const bool of_all : {true, false}) {
        synthetic::CampaignPlan plan = plan_for_size(3);
        plan.angles_deg = synthetic::full_turn(12);
        plan.stations.resize(4);
        plan.reflectors.resize(5);
        plan.both_senses = true;
        RotaryTableMeasurement m = measured_for_size(plan);
        for (LengthObservation& length : m.lengths) {
            if (length.station == 1 && length.angle == 5 && length.approach == Approach::positive) {
                length.length += k_size;
            }
            if (of_all || length.station == 0) {
                length.length *= 1.0 + k_scale;
            }
        }
        const RotaryTableSolution solution = evaluate_jointly(m, options_of_scales());
        const double scale =
            of_all ? -told_size(solution, GroupKind::fixture_scale) : told_size(solution, GroupKind::station_scale);
        EXPECT_NEAR(scale, k_scale, 0.05 * k_scale);
        EXPECT_NEAR(told_size(solution, GroupKind::visit_length), k_size, 0.1 * k_size);
    }
}

}  // namespace
}  // namespace gumcert::engine
