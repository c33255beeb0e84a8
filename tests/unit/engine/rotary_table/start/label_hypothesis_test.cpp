#include "engine/rotary_table/start/label_hypothesis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(LabelHypothesis, EachIsTriedOnceAndAllPairsAreThere) {
    const RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    const std::vector<LabelHypothesis> all = label_hypotheses(measurement);
    EXPECT_EQ(all.size(), 1U + 3U + 6U + 6U + 2U + 15U);  // sense; lengths; fixture; angles; axes; pairs of six
    for (std::size_t k = 0; k < all.size(); ++k) {
        EXPECT_EQ(std::ranges::count(all, all[k]), 1) << k;
        EXPECT_NE(all[k], LabelHypothesis{}) << k;
    }
}

TEST(LabelHypothesis, AreReadIntoTheMeasurement) {
    const RotaryTableMeasurement stated = simulate(synthetic::small_plan()).measurement;
    const RotaryTableMeasurement swapped = relabelled(stated, 2, {.first = 1, .second = 4});
    for (std::size_t i = 0; i < stated.lengths.size(); ++i) {
        const std::size_t from = stated.lengths[i].reflector;
        const std::size_t to = stated.lengths[i].station != 2 ? from : from == 1 ? 4 : from == 4 ? 1 : from;
        EXPECT_EQ(swapped.lengths[i].reflector, to) << i;
    }
    RotaryTableMeasurement from_third = stated;
    from_third.home = 3;
    const RotaryTableMeasurement reversed = relabelled(from_third, 0, {.other_sense = true});
    const RotaryTableMeasurement wider = relabelled(from_third, 0, {.angles = 1.5});
    for (std::size_t a = 0; a < stated.angles.size(); ++a) {
        const double turned = stated.angles[a] - stated.angles[3];
        EXPECT_NEAR(reversed.angles[a] - stated.angles[3], -turned, 1e-14);
        EXPECT_NEAR(wider.angles[a] - stated.angles[3], 1.5 * turned, 1e-14);
    }
    EXPECT_EQ(relabelled(stated, 0, {.axis = RotaryAxis::c}).axis, RotaryAxis::c);
    const RotaryTableMeasurement other = relabelled(stated, 0, {.lengths = -1.0, .fixture = 25.4});
    EXPECT_EQ(other.lengths[7].length, -stated.lengths[7].length);
    EXPECT_EQ(other.fixture, 25.4 * stated.fixture);
}

TEST(LabelHypothesis, TheMessageSaysWhatIsWrongAndWhere) {
    const RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    const std::vector<std::pair<LabelHypothesis, std::string>> words{
        {{.other_sense = true}, "turns the other way than the angles say"},
        {{.lengths = -1.0}, "have the other sign"},
        {{.lengths = 2.0}, "multiplied by 2"},
        {{.lengths = 1.01234, .scale = true}, "multiplied by about 1.0123"},
        {{.angles = 0.9}, "turned 0.9 times as far"},
        {{.axis = RotaryAxis::c}, "turns about z of the fixture coordinates, and not about x"},
        {{.first = 1, .second = 4}, "the reflectors R2 and R5 are interchanged"},
    };
    for (const auto& [cause, what] : words) {
        const gum::Diagnostic of_all = wrong_labels(measurement, cause, "");
        const gum::Diagnostic of_one = wrong_labels(measurement, cause, "P3");
        EXPECT_NE(of_all.what.find(what), std::string::npos) << of_all.what;
        EXPECT_EQ(of_one.what, of_all.what);
        EXPECT_EQ(of_all.where.find("P3"), std::string::npos) << of_all.where;
        EXPECT_NE(of_one.where.find("station P3"), std::string::npos) << of_one.where;
        EXPECT_EQ(of_all.code, cause.axis ? "GC-GEOMETRY-0007" : "GC-ADJUST-0013");
        EXPECT_FALSE(of_all.action.empty());
    }
    // A fixture in another unit is one of all stations: of one of them it is the distances.
    const LabelHypothesis inch{.fixture = 25.4};
    EXPECT_NE(wrong_labels(measurement, inch, "").what.find("coordinates are multiplied by 25.4"), std::string::npos);
    EXPECT_NE(wrong_labels(measurement, inch, "P3").what.find("are multiplied by 0.0394"), std::string::npos);
    EXPECT_NE(wrong_labels(measurement, {.angles = 0.9}, "").action.find("gon"), std::string::npos);
    EXPECT_NE(wrong_labels(measurement, {.lengths = 0.5}, "").action.find("counted twice or halved"),
              std::string::npos);
}

}  // namespace
}  // namespace gumcert::engine
