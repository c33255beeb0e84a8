#include "engine/rotary_table/start/gross_errors.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "engine/rotary_table/start/interrupted_beams.h"
#include "engine/rotary_table/start/start_search.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/small_campaign.h"
#include "tests/support/weak_layout.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

// Of a sound campaign no cause is told, whatever its layout: with few distances or a station that sees all reflectors near a
// cone wrong labels, or a dead path more, leave next to nothing.
TEST(GrossErrors, NoCauseIsToldOfSoundCampaigns) {
    constexpr std::uint64_t k_campaigns = 500;
    constexpr std::uint64_t k_with_all_labels = 20;  // they take longer
    std::size_t evaluated = 0;
    for (std::uint64_t seed = 1; seed <= k_campaigns; ++seed) {
        const Campaign campaign = simulate(synthetic::weak_layout(seed));
        SCOPED_TRACE("seed " + std::to_string(seed));
        try {
            EXPECT_TRUE(find_gross_errors(campaign.measurement).empty());
            ++evaluated;
        } catch (const gum::NoResultError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-RANK-0001") << error.what();
        }
        EXPECT_NO_THROW(refuse_interrupted_beams(campaign.measurement));
        if (seed <= k_with_all_labels) {
            EXPECT_NO_THROW(StartSearch(campaign.measurement).refuse_wrong_labels());
        }
    }
    EXPECT_GT(evaluated, k_campaigns * 3 / 4);
}

TEST(GrossErrors, ComeLargestFirstAndSoundDistancesStay) {
    Campaign campaign = simulate(CampaignPlan{});
    campaign.measurement.lengths[100].length += 0.05;
    campaign.measurement.lengths[700].length -= 0.4;
    campaign.measurement.lengths[701].length += 0.005;  // left to the test of the adjustment
    EXPECT_EQ(find_gross_errors(campaign.measurement), (std::vector<std::size_t>{700, 100}));
    EXPECT_TRUE(find_gross_errors(simulate(CampaignPlan{}).measurement).empty());
}

TEST(GrossErrors, NoneIsFoundOnAPathOfTwoDistancesNorMoreThanOneInTwenty) {
    RotaryTableMeasurement pair = simulate(synthetic::small_plan()).measurement;
    const std::size_t path = pair.dead_paths.size();
    pair.dead_paths.emplace_back("P1/2");
    pair.lengths[0].dead_path = path;
    pair.lengths[1].dead_path = path;
    pair.lengths[1].length += 0.1;
    EXPECT_TRUE(find_gross_errors(pair).empty());
    RotaryTableMeasurement many = simulate(synthetic::small_plan()).measurement;
    for (std::size_t i = 0; i < many.lengths.size(); i += 15) {
        many.lengths[i].length += 0.05 + 1e-4 * static_cast<double>(i);
    }
    EXPECT_EQ(find_gross_errors(many).size(), many.lengths.size() / 20 + 1);
}

// A place that fits badly seems to be open: that is no property of the layout.
TEST(GrossErrors, DistancesOfNoRigidTableAreToldAsSuch) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    for (LengthObservation& length : measurement.lengths) {
        length.length *= 0.3;
    }
    for (const gum::Diagnostic& problem : synthetic::problems_of([&] { (void)find_gross_errors(measurement); })) {
        EXPECT_NE(problem.code, "GC-RANK-0001") << problem.what;
    }
}

}  // namespace
}  // namespace gumcert::engine
