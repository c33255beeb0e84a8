#include "gum/comparison/laboratory_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using testing::ElementsAre;

TEST(LaboratoryData, ResultsOfEachItemAndRoundInTheOrderOfTheParticipants) {
    test::StatedComparison stated = test::comparison_of({1.1, 1.2, 1.3}, {0.1, 0.2, 0.3});
    stated.scheme.rounds = {"spring", "autumn"};
    stated.results[0].round = 1;
    std::swap(stated.results[1], stated.results[2]);
    const std::vector<LaboratoryData> all = laboratory_data(stated.scheme, stated.results);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].where, "item \"block\", round \"spring\"");
    EXPECT_THAT(all[0].result_positions, ElementsAre(2, 1));
    EXPECT_EQ(all[0].x[0], 1.2);
    EXPECT_EQ(all[0].u[1], 0.3);
    EXPECT_EQ(all[1].round, 1U);
    EXPECT_EQ(all[1].size(), 1U);
}

TEST(LaboratoryData, AResultWithoutUncertaintyHasNone) {
    test::StatedComparison stated = test::comparison_of({1.1, 1.2, 1.3}, {0.1, 0.2, 0.3});
    stated.results[1].uncertainty.reset();
    const LaboratoryData data = stated.data();
    EXPECT_THAT(data.with_u(), ElementsAre(0, 2));
    EXPECT_FALSE(data.all_have_u({0, 1}));
    EXPECT_TRUE(data.all_have_u({0, 2}));
    EXPECT_EQ(data.at({0, 2}).covariance.size(), 0) << "nothing correlates";
}

TEST(RelateResults, TheReferenceLaboratoryDoesNotContribute) {
    test::StatedComparison stated = test::comparison_of({1.1, 1.2, 1.3}, {0.1, 0.2, 0.3});
    stated.results[2].contributes = false;
    stated.scheme.items[0].assigned_value.method = AssignedValueMethod::reference;
    stated.scheme.items[0].assigned_value.participant = "L2";
    const LaboratoryData data = stated.data();
    EXPECT_EQ(data.reference, 1U);
    EXPECT_THAT(data.contributing, ElementsAre(0));
    stated.results[1].uncertainty.reset();
    EXPECT_EQ(code_of<InputError>([&] { (void)stated.data(); }), "GC-COMPARE-0106");
}

}  // namespace
}  // namespace gumcert::gum
