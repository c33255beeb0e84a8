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
