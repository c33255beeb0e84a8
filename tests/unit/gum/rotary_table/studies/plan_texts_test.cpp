#include "gum/rotary_table/studies/plan_texts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <limits>
#include <string>

namespace gumcert::gum::plan {
namespace {

using testing::ElementsAre;

TEST(PlanTexts, AnUncertaintyIsPrintedInItsUnitAndNeverSmallerThanItIs) {
    EXPECT_EQ(U_text(1.21e-6, k_um), "1.3");
    EXPECT_EQ(U_text(0.12e-6, k_um), "0.12") << "noise of the conversion is none";
    EXPECT_EQ(U_text(0.0991e-6, k_um), "0.10");
    EXPECT_EQ(U_text(2.5 * k_arcsec.si, k_arcsec), "2.5");
    EXPECT_EQ(U_text(0.0312 * k_arcsec.si, k_arcsec), "0.032");
    EXPECT_EQ(U_text(0.0, k_um), "0");
    for (double U = 1.003e-8; U < 1e-4; U *= 1.37) {
        const std::string text = U_text(U, k_um);
        double printed = 0.0;
        std::from_chars(text.data(), text.data() + text.size(), printed);
        EXPECT_GE(printed * k_um.si, U * (1.0 - 1e-12)) << text;
        EXPECT_LE(printed * k_um.si, U * 1.1) << text;  // two digits: a step is a tenth at most
    }
}

TEST(PlanTexts, NumbersHaveNoDigitsOfTheirConversion) {
    EXPECT_EQ(plain(0.1 + 0.2), "0.3");
    EXPECT_EQ(plain(360.0 / 7.0), "51.4285714");
    EXPECT_EQ(plain(30.0), "30");
    EXPECT_EQ(plain(-0.25), "-0.25");
    EXPECT_EQ(plain(0.0), "0");
}

TEST(PlanTexts, ARatioOfWhatIsNotDeterminedIsNoNumber) {
    EXPECT_EQ(ratio_text(0.12345), "0.123");
    EXPECT_EQ(ratio_text(2.0), "2.00");
    EXPECT_EQ(ratio_text(std::numeric_limits<double>::infinity()), "not determined");
    EXPECT_EQ(ratio_text(std::numeric_limits<double>::quiet_NaN()), "not determined");
}

TEST(PlanTexts, CountsInSingularAndPlural) {
    EXPECT_EQ(counted(0, "station"), "0 stations");
    EXPECT_EQ(counted(1, "station"), "1 station");
    EXPECT_EQ(counted(6, "reflector"), "6 reflectors");
}

TEST(PlanTexts, PlacesAreInMillimetres) {
    const Eigen::Vector3d place(0.7, -0.12345, -1e-6);
    EXPECT_THAT(coordinates(place), ElementsAre("700.0", "-123.4", "0.0")) << "a tie is even, and no zero is negative";
    EXPECT_EQ(place_text(place), "700.0, -123.4, 0.0");
}

}  // namespace
}  // namespace gumcert::gum::plan
