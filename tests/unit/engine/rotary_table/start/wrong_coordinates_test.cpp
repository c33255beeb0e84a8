#include "engine/rotary_table/start/wrong_coordinates.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/rotary_table/start/place_search.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(WrongCoordinates, TheReflectorWithoutWhichAllStationsFitIsNamedWithItsPlace) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    const std::vector<std::size_t> all{0, 1, 2, 3, 4, 5};
    const auto ask = [&] {
        std::vector<double> misfits;
        for (const StationFit& fit : PlaceSearch(measurement).fit_each()) {
            misfits.push_back(fit.upright_misfit());
        }
        refuse_wrong_coordinates(measurement, all, misfits);
    };
    EXPECT_NO_THROW(ask());
    measurement.fixture(2, 1) += 0.3;
    const std::vector<gum::Diagnostic> problems = synthetic::problems_of(ask);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].code, "GC-ADJUST-0013");
    EXPECT_EQ(problems[0].where, "fixture, reflector R3");
    EXPECT_NE(problems[0].what.find("near (60.0, -85.0, 90.0) mm"), std::string::npos) << problems[0].what;
    EXPECT_NE(problems[0].what.find("300.0 mm away"), std::string::npos) << problems[0].what;
}

TEST(WrongCoordinates, AStrayReflectorIsNamedFromHalfAMillimetreOn) {
    for (const double off : {0.0, 0.3e-3, 3e-3}) {
        RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
        measurement.fixture(4, 2) += off;
        const std::vector<StationFit> fits = PlaceSearch(measurement).fit_each();
        const std::vector<gum::Diagnostic> problems =
            synthetic::problems_of([&] { refuse_stray_reflector(measurement, fits, false); });
        ASSERT_EQ(problems.size(), off > 0.5e-3 ? 1U : 0U) << off;
        if (!problems.empty()) {
            EXPECT_EQ(problems[0].where, "fixture, reflector R5");
            EXPECT_NE(problems[0].what.find("3.0 mm away"), std::string::npos) << problems[0].what;
        }
    }
}

// A reflector that moves has no place: where there is a result the tests of groups name it.
TEST(WrongCoordinates, AReflectorThatMovesIsNamedOnlyWhereThereIsNoResult) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    for (LengthObservation& length : measurement.lengths) {
        length.length += length.reflector == 4 ? 1e-3 * static_cast<double>(length.angle % 5) : 0.0;
    }
    const std::vector<StationFit> fits = PlaceSearch(measurement).fit_each();
    EXPECT_NO_THROW(refuse_stray_reflector(measurement, fits, false));
    const std::vector<gum::Diagnostic> problems =
        synthetic::problems_of([&] { refuse_stray_reflector(measurement, fits, true); });
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].where, "fixture, reflector R5");
    EXPECT_EQ(problems[0].what, "the distances of the stations agree when this reflector is left out");
}

}  // namespace
}  // namespace gumcert::engine
