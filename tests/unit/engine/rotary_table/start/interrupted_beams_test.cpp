#include "engine/rotary_table/start/interrupted_beams.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

double size_in_micrometres(const gum::Diagnostic& problem) {
    const std::string before = "from this visit on all distances of the station are off by about ";
    EXPECT_EQ(problem.what.find(before), 0U) << problem.what;
    return std::stod(problem.what.substr(before.size()));
}

TEST(InterruptedBeams, AreToldWithThePlaceAndSizeOfEach) {
    for (const synthetic::DeadPaths paths :
         {synthetic::DeadPaths::per_station, synthetic::DeadPaths::per_station_and_reflector}) {
        synthetic::CampaignPlan plan = synthetic::small_plan();
        plan.dead_paths = paths;
        RotaryTableMeasurement measurement = simulate(plan).measurement;
        EXPECT_NO_THROW(refuse_interrupted_beams(measurement));
        for (LengthObservation& length : measurement.lengths) {
            const bool down = length.approach == Approach::negative;
            length.length += length.station == 1 && down && length.angle <= 7 ? 0.004 : 0.0;
            length.length -= length.station == 4 && (down || length.angle >= 3) ? 0.002 : 0.0;
        }
        const std::vector<gum::Diagnostic> problems =
            synthetic::problems_of([&] { refuse_interrupted_beams(measurement); });
        ASSERT_EQ(problems.size(), 2U);
        EXPECT_EQ(problems[0].code, "GC-ADJUST-0014");
        EXPECT_EQ(problems[0].where, "station P2, pass P2/2, 210°");
        EXPECT_EQ(problems[1].where, "station P5, pass P5/1, 90°");
        EXPECT_NEAR(size_in_micrometres(problems[0]), 4000.0, 3.0);
        EXPECT_NEAR(size_in_micrometres(problems[1]), 2000.0, 3.0);
    }
}

TEST(InterruptedBeams, AJumpBelowATenthOfAMillimetreIsLeftToTheTestsOfGroups) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    for (LengthObservation& length : measurement.lengths) {
        length.length += length.station == 1 && length.approach == Approach::negative ? 0.08e-3 : 0.0;
    }
    EXPECT_NO_THROW(refuse_interrupted_beams(measurement));
}

}  // namespace
}  // namespace gumcert::engine
