#include "engine/rotary_table/start/place_of_reflector.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(PlaceOfReflector, IsWhereTheDistancesPutItWhateverItsCoordinatesSay) {
    const synthetic::Campaign campaign = simulate(synthetic::small_plan());
    const Eigen::Vector3d truth = campaign.truth.fixture.row(3).transpose();
    for (const Eigen::Vector3d& stated : {truth, Eigen::Vector3d(truth + Eigen::Vector3d(0.0, 0.03, 0.0)),
                                          Eigen::Vector3d(-truth[0], truth[2], truth[1]), Eigen::Vector3d(-truth)}) {
        RotaryTableMeasurement measurement = campaign.measurement;
        measurement.fixture.row(3) = stated.transpose();
        const std::vector<StationFit> fits =
            PlaceSearch(measurement, lengths_without_reflector(measurement, 3)).fit_each();
        const std::optional<Eigen::Vector3d> place = place_of_reflector(measurement, 3, {0, 1, 2, 3, 4, 5}, fits);
        ASSERT_TRUE(place);
        EXPECT_LT((*place - truth).norm(), 1e-4) << stated.transpose();
    }
}

TEST(PlaceOfReflector, ThereIsNoneOfThreeDistancesNorOfOnesThatDisagree) {
    RotaryTableMeasurement few = simulate(synthetic::small_plan()).measurement;
    std::vector<StationFit> fits = PlaceSearch(few, lengths_without_reflector(few, 3)).fit_each();
    RotaryTableMeasurement disagreeing = few;
    std::size_t kept = 0;
    std::erase_if(few.lengths, [&](const LengthObservation& length) { return length.reflector == 3 && ++kept > 3; });
    EXPECT_FALSE(place_of_reflector(few, 3, {0, 1, 2, 3, 4, 5}, fits));
    for (LengthObservation& length : disagreeing.lengths) {
        length.length += length.reflector == 3 ? 0.01 * static_cast<double>(length.angle % 3) : 0.0;
    }
    EXPECT_FALSE(place_of_reflector(disagreeing, 3, {0, 1, 2, 3, 4, 5}, fits));
    std::ranges::fill(fits, StationFit{});  // none was found
    EXPECT_FALSE(place_of_reflector(disagreeing, 3, {0, 1, 2, 3, 4, 5}, fits));
}

}  // namespace
}  // namespace gumcert::engine
