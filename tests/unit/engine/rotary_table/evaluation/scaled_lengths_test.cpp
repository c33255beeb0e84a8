// A refractive index that was left out is told, and not what the tests of an adjustment make of it.
#include "engine/rotary_table/evaluation/scaled_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/start/start_search.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

constexpr double k_index_of_air = 2.7e-4;

RotaryTableMeasurement measured_for_scale(std::uint64_t seed) {
    synthetic::CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    plan.stations.resize(4);
    plan.table_linear = 0.2e-6;
    plan.table_axial = plan.table_tilt = 1.5e-6;
    plan.start_values = true;
    plan.seed = seed;
    return synthetic::simulate(plan).measurement;
}

/// \param station  whose distances are too long; of all: none
RotaryTableMeasurement with_scale(RotaryTableMeasurement measurement, double scale, std::size_t station) {
    for (LengthObservation& length : measurement.lengths) {
        if (station >= measurement.stations.size() || length.station == station) {
            length.length *= 1.0 + scale;
        }
    }
    return measurement;
}

std::vector<gum::Diagnostic> causes_of(const RotaryTableMeasurement& measurement) {
    StartSearch search(measurement);
    const std::vector<bool> all(measurement.lengths.size(), true);
    return scaled_lengths(measurement, search.places(all), all, SolverOptions{}, {});
}

TEST(ScaledLengths, AreToldOfAllDistancesAndOfOneStation) {
    constexpr std::size_t k_all = 99;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const RotaryTableMeasurement sound = measured_for_scale(seed);
        EXPECT_TRUE(causes_of(sound).empty());
        const auto all = causes_of(with_scale(sound, k_index_of_air, k_all));
        ASSERT_EQ(all.size(), 1U);
        EXPECT_EQ(all[0].where, "lengths");
        EXPECT_EQ(all[0].what.find("the distances agree when they are multiplied by about 0.9997"), 0U) << all[0].what;
        const auto one = causes_of(with_scale(sound, -k_index_of_air, 2));
        ASSERT_EQ(one.size(), 1U);
        EXPECT_EQ(one[0].where, "lengths, station " + sound.stations[2]);
        EXPECT_EQ(one[0].what.find("the distances agree when they are multiplied by about 1.0002"), 0U) << one[0].what;
    }
}

TEST(ScaledLengths, AreNotWhatABlunderIsTakenFor) {
    RotaryTableMeasurement measurement = measured_for_scale(4);
    for (LengthObservation& length : measurement.lengths) {
        if (length.station == 1 && length.angle > 3) {
            length.length += 40e-6;
        }
    }
    EXPECT_TRUE(causes_of(measurement).empty());
    measurement = measured_for_scale(5);
    measurement.fixture(0, 1) += 60e-6;
    EXPECT_TRUE(causes_of(measurement).empty());
}

// Too many outlying distances, or a drift, was what was told of it.
TEST(ScaledLengths, AreToldByTheEvaluation) {
    EvaluationOptions options;
    options.chi_square_upper_tail = [](double value, double nu) {
        return boost::math::cdf(
            boost::math::complement(boost::math::chi_squared_distribution<double>(nu), std::max(value, 0.0)));
    };
    RotaryTableMeasurement measurement = with_scale(measured_for_scale(6), k_index_of_air, 99);
    measurement.outliers.test = OutlierTest::data_snooping;
    measurement.outliers.action = OutlierAction::remove;
    std::string told;
    try {
        for (const gum::Diagnostic& note : evaluate_jointly(measurement, options).notes) {
            told += note.where + " — " + note.what + "\n";
        }
    } catch (const gum::NoResultError& error) {
        told = error.what();
    }
    EXPECT_TRUE(told.find("multiplied by about 0.9997") != std::string::npos ||
                told.find("ppm larger") != std::string::npos)
        << told;
}

}  // namespace
}  // namespace gumcert::engine
