#include "engine/rotary_table/start/no_rigid_table.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "engine/rotary_table/start/robust_descent.h"
#include "engine/rotary_table/start/start_search.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(NoRigidTable, TheStationThatFitsWorstIsNamedAboveAMillimetre) {
    const RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    std::vector<StationFit> fits(6);
    for (StationFit& fit : fits) {
        fit.misfit = 0.9e-3;
    }
    EXPECT_FALSE(no_rigid_table(measurement, fits));
    EXPECT_FALSE(no_rigid_table(measurement, {}));
    fits[1].misfit = 1.2e-3;
    fits[4].misfit = 3.44e-3;
    const std::optional<gum::Diagnostic> none = no_rigid_table(measurement, fits);
    ASSERT_TRUE(none);
    EXPECT_EQ(none->code, "GC-ADJUST-0015");
    EXPECT_EQ(none->where, "station P5");
    EXPECT_NE(none->what.find("differ by 3.4 mm"), std::string::npos) << none->what;
}

TEST(NoRigidTable, DistancesOfNoTableAreRefusedAndSoundOnesAreNot) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    EXPECT_NO_THROW(StartSearch(measurement).refuse_no_rigid_table());
    for (LengthObservation& length : measurement.lengths) {
        length.length *= length.station == 2 ? 0.3 : 1.0;
    }
    const std::vector<gum::Diagnostic> problems =
        synthetic::problems_of([&] { StartSearch(measurement).refuse_no_rigid_table(); });
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].code, "GC-ADJUST-0015");
    EXPECT_EQ(problems[0].where, "station P3");
}

}  // namespace
}  // namespace gumcert::engine
