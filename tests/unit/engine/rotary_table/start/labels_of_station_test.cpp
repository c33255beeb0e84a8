#include "engine/rotary_table/start/labels_of_station.h"

#include <gtest/gtest.h>

#include <optional>

#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

StationFit fit_alone(const RotaryTableMeasurement& measurement, std::size_t station) {
    return PlaceSearch(measurement, lengths_of_station(measurement, station)).fit_of(station, true);
}

TEST(LabelsOfStation, AreThoseThatLeaveNextToNothing) {
    const RotaryTableMeasurement sound = simulate(synthetic::small_plan()).measurement;
    for (const LabelHypothesis& wrong : {LabelHypothesis{.first = 1, .second = 3}, LabelHypothesis{.lengths = 2.0},
                                         LabelHypothesis{.other_sense = true}}) {
        const RotaryTableMeasurement stated = relabelled(sound, 2, wrong);
        const std::optional<LabelHypothesis> found =
            labels_of_station(stated, 2, fit_alone(stated, 2).upright_misfit());
        ASSERT_TRUE(found);
        LabelHypothesis right = wrong;
        right.lengths = 1.0 / wrong.lengths;
        EXPECT_EQ(*found, right);
        // What one station has is asked of the next one first, and is it only where it leaves as little.
        const double misfit = fit_alone(stated, 2).upright_misfit();
        EXPECT_TRUE(labels_explain_station(stated, 2, misfit, right));
        EXPECT_FALSE(labels_explain_station(stated, 2, misfit, {.angles = 0.9}));
    }
}

TEST(LabelsOfStation, ThereIsNoneOfSoundDistancesNorOfTooFew) {
    const RotaryTableMeasurement sound = simulate(synthetic::small_plan()).measurement;
    EXPECT_FALSE(labels_of_station(sound, 2, fit_alone(sound, 2).upright_misfit()));
    EXPECT_FALSE(scale_of_station(sound, 2, fit_alone(sound, 2)));
    RotaryTableMeasurement few = relabelled(sound, 2, {.first = 1, .second = 3});
    std::size_t kept = 0;
    std::erase_if(few.lengths, [&](const LengthObservation& length) { return length.station == 2 && ++kept > 13; });
    EXPECT_FALSE(labels_of_station(few, 2, 0.05));
    EXPECT_FALSE(scale_of_station(few, 2, fit_alone(few, 2)));
}

TEST(LabelsOfStation, AFactorIsFoundToWhatTheDistancesTell) {
    for (const double factor : {1.1, 0.99}) {
        RotaryTableMeasurement stated = simulate(synthetic::small_plan()).measurement;
        for (LengthObservation& length : stated.lengths) {
            length.length *= length.station == 2 ? factor : 1.0;
        }
        const std::optional<LabelHypothesis> found = scale_of_station(stated, 2, fit_alone(stated, 2));
        ASSERT_TRUE(found) << factor;
        EXPECT_TRUE(found->scale);
        EXPECT_NEAR(found->lengths * factor, 1.0, 1e-3);
    }
}

// Reflectors in a plane across the axis, seen from outside of it, move along ellipses: a station at which they are half as flat
// sees half of each distance. It is not told where the stated distances have a place of their own on the way from there.
TEST(LabelsOfStation, NoFactorIsToldOfAStationThatItLeadsToItsPlace) {
    synthetic::CampaignPlan plan;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.angles_deg = synthetic::full_turn(12);
    plan.reflectors = {
        {0.0469911, 0.0962504, 0.0505884}, {0.0536030, -0.0936034, 0.0954474}, {0.0506561, -0.0134627, -0.0801464}};
    plan.stations = {{1.190529, 0.884178, -0.369733}, {0.804449, 0.724693, 0.652322},  {1.088408, 0.992358, 0.797092},
                     {0.747019, 0.768963, 1.220409},  {0.938216, 1.253520, -0.011185}, {0.350455, 0.846219, 0.148201}};
    plan.offset = Eigen::Vector2d(-0.0694095, 0.1114105);
    plan.tilt = Eigen::Vector2d(-0.00130935, 0.00174358);
    const RotaryTableMeasurement sound = simulate(plan).measurement;
    for (std::size_t j = 0; j < plan.stations.size(); ++j) {
        const StationFit fit = fit_alone(sound, j);
        EXPECT_FALSE(labels_of_station(sound, j, fit.upright_misfit())) << j << ", " << fit.upright_misfit();
    }
}

// What is left falls up to the end of the range that is looked at: 0.8, which is no factor of anything, was told as one.
TEST(LabelsOfStation, NoFactorIsToldThatIsTheEndOfWhatIsLookedAt) {
    for (const double factor : {1.2505, 0.7998}) {
        RotaryTableMeasurement stated = simulate(synthetic::small_plan()).measurement;
        for (LengthObservation& length : stated.lengths) {
            length.length *= length.station == 2 ? factor : 1.0;
        }
        EXPECT_FALSE(scale_of_station(stated, 2, fit_alone(stated, 2))) << factor;
    }
}

}  // namespace
}  // namespace gumcert::engine
