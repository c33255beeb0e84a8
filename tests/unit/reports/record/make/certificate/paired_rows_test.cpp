#include "reports/record/make/certificate/paired_rows.h"

#include <gmock/gmock.h>

namespace gumcert::reports {
namespace {

using testing::ElementsAre;

StatedLeaf leaf(const std::string& at, const std::string& text) {
    return {at, text, "text"};
}

TEST(PairedRows, FollowARowThatMoved) {
    const std::vector<StatedLeaf> before{leaf("/standards/0/name", "gauge"), leaf("/standards/0/number", "17"),
                                         leaf("/standards/1/name", "laser"), leaf("/standards/1/number", "4")};
    const std::vector<StatedLeaf> now{leaf("/standards/0/name", "laser"), leaf("/standards/0/number", "4"),
                                      leaf("/standards/1/name", "gauge"), leaf("/standards/1/number", "18")};
    EXPECT_THAT(places_of_counterparts(before, now),
                ElementsAre("/standards/1/name", "/standards/1/number", "/standards/0/name", "/standards/0/number"));
}

TEST(PairedRows, KeepTheOrderOfSingleValues) {
    const std::vector<StatedLeaf> before{leaf("/limits/0", "1"), leaf("/limits/1", "2")};
    const std::vector<StatedLeaf> now{leaf("/limits/0", "2"), leaf("/limits/1", "1")};
    EXPECT_THAT(places_of_counterparts(before, now), ElementsAre("/limits/0", "/limits/1"));
}

TEST(PairedRows, GiveARowThatHasGoneAPlaceThatNothingHas) {
    const std::vector<StatedLeaf> before{leaf("/standards/0/name", "gauge"), leaf("/standards/1/name", "laser")};
    const std::vector<StatedLeaf> now{leaf("/standards/0/name", "laser")};
    const std::vector<std::string> places = places_of_counterparts(before, now);
    ASSERT_EQ(places.size(), 2U);
    EXPECT_NE(places[0], "/standards/0/name");
    EXPECT_EQ(places[1], "/standards/0/name");
}

}  // namespace
}  // namespace gumcert::reports
