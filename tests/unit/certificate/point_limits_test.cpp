#include "certificate/point_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace gumcert::certificate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two points in different ranges.
PointTable points() {
    PointTable table;
    table.points = {"a", "b"};
    table.columns = {{.name = "range",
                      .heading = {},
                      .role = "",
                      .stage = "",
                      .unit = "",
                      .printed_unit = "",
                      .values = {{}, {}},
                      .printed = {"100 mV", "10 V"}},
                     {.name = "V",
                      .heading = {},
                      .role = "",
                      .stage = "",
                      .unit = "V",
                      .printed_unit = "V",
                      .values = {0.05, -10.0},
                      .printed = {"0.05", "-10"}},
                     {.name = "mpe",
                      .heading = {},
                      .role = "",
                      .stage = "",
                      .unit = "",
                      .printed_unit = "",
                      .values = {0.2, {}},
                      .printed = {"0.2", ""}},
                     {.name = "limit_low",
                      .heading = {},
                      .role = "",
                      .stage = "",
                      .unit = "uV",
                      .printed_unit = "µV",
                      .values = {{}, -300.0},
                      .printed = {"", "-300"}}};
    return table;
}

AgreedSpecification specification(const std::string& by) {
    AgreedSpecification s;
    s.id = "s";
    s.unit = "mV";
    s.limits.emplace();
    s.limits->by = by;
    return s;
}

TEST(PointLimits, AreThoseOfTheSpecificationWithoutLimitsOfPoints) {
    AgreedSpecification s;
    s.lower = -1.0;
    const PointTable table = points();
    const LimitsAt limits = limits_at(s, lookup_at(table, 0));
    EXPECT_EQ(limits.lower, -1.0);
    EXPECT_FALSE(limits.upper);
    EXPECT_EQ(limits.problem, "");
}

TEST(PointLimits, StandInColumns) {
    const PointTable table = points();
    AgreedSpecification s = specification("points");
    const LimitsAt first = limits_at(s, lookup_at(table, 0));  // mpe in the unit of the specification
    EXPECT_EQ(first.lower, -0.2);
    EXPECT_EQ(first.upper, 0.2);
    const LimitsAt second = limits_at(s, lookup_at(table, 1));  // -300 µV, one-sided
    ASSERT_TRUE(second.lower);
    EXPECT_NEAR(*second.lower, -0.3, 1e-15);
    EXPECT_FALSE(second.upper);
    s.limits->about = "V";
    const LimitsAt about = limits_at(s, lookup_at(table, 0));
    EXPECT_NEAR(*about.lower, 49.8, 1e-12);
    EXPECT_NEAR(*about.upper, 50.2, 1e-12);
}

/// Which of two statements was agreed nobody can tell; one that only says the same again changes nothing.
TEST(PointLimits, OfTwoKindsSayTheSame) {
    PointTable table = points();
    const AgreedSpecification s = specification("points");
    const auto limits = [&](std::optional<double> low_uV) {
        table.columns.back().values[0] = low_uV;
        return limits_at(s, lookup_at(table, 0));
    };
    EXPECT_EQ(limits(-200.0).lower, -0.2);
    EXPECT_EQ(limits(-200.0).upper, 0.2);
    EXPECT_EQ(limits(-200.0).problem, "");
    for (const double other : {-100.0, -300.0, -200.001, 200.0}) {
        EXPECT_THAT(limits(other).problem, HasSubstr("states mpe, and other limits")) << other;
    }
}

/// A table with a reading or nominal value of a temperature.
PointTable temperature(double value, const std::string& unit) {
    return {.points = {"1"},
            .columns = {{.name = "t",
                         .heading = {},
                         .role = "",
                         .stage = "",
                         .unit = unit,
                         .printed_unit = unit,
                         .values = {value},
                         .printed = {"t"}}},
            .tables = {}};
}

/// 0.5 % of a reading is 0.5 % of what the thermometer shows, whatever unit the error is stated in.
TEST(PointLimits, AreAPercentageOfWhatAThermometerShows) {
    struct Shown {
        const char* unit;
        double value, step;  ///< of the scale [K]
    };
    for (const Shown& shown : {Shown{"degC", 20.0, 1.0}, Shown{"degC", -40.0, 1.0}, Shown{"degF", 68.0, 5.0 / 9.0},
                               Shown{"degF", -40.1, 5.0 / 9.0}, Shown{"K", 293.15, 1.0}, Shown{"mK", 4200.0, 1e-3}}) {
        for (const auto& [unit, kelvin] : {std::pair{"K", 1.0}, {"mK", 1e-3}, {"delta_degF", 5.0 / 9.0}}) {
            AgreedSpecification s = specification("accuracy");
            s.unit = unit;
            s.limits->of = "t";
            s.limits->accuracy = {{.range = "",
                                   .unit = "",
                                   .percent_of_reading = 0.5,
                                   .percent_of_range = {},
                                   .full_scale = {},
                                   .digits = {},
                                   .digit = {},
                                   .constant = {}}};
            const PointTable table = temperature(shown.value, shown.unit);
            const double expected = 0.005 * std::abs(shown.value) * shown.step / kelvin;
            EXPECT_NEAR(limits_at(s, lookup_at(table, 0)).upper.value_or(0.0), expected, 1e-13 * expected)
                << shown.value << " " << shown.unit << " in " << unit;
        }
    }
}

/// 20 °C is not 20 K: neither as the argument of a step, nor as the value that limits lie about.
TEST(PointLimits, TakeNoNumberOverTheOriginOfAScale) {
    AgreedSpecification s = specification("steps");
    s.unit = "K";
    s.limits->arguments = {{.name = "t", .unit = "K", .of = "t"}};
    s.limits->steps = {{.up_to = 300.0, .mpe = 0.2}};
    EXPECT_THAT(limits_at(s, lookup_at(temperature(20.0, "degC"), 0)).problem, HasSubstr("no value of \"t\" in K"));
    EXPECT_EQ(limits_at(s, lookup_at(temperature(20.0, "K"), 0)).upper, 0.2);
    s.limits->arguments.front().unit = "degF";
    EXPECT_EQ(limits_at(s, lookup_at(temperature(20.0, "degC"), 0)).upper, 0.2);
    s.limits->about = "t";
    EXPECT_THAT(limits_at(s, lookup_at(temperature(20.0, "degC"), 0)).problem, HasSubstr("no value of \"t\" in K"));
}

TEST(PointLimits, AreAnAccuracyByRange) {
    const PointTable table = points();
    AgreedSpecification s = specification("accuracy");
    s.limits->of = "V";
    s.limits->accuracy = {{.range = "100 mV",
                           .unit = "mV",
                           .percent_of_reading = 0.005,
                           .percent_of_range = 0.0035,
                           .full_scale = 100.0,
                           .digits = {},
                           .digit = {},
                           .constant = {}},
                          {.range = "10 V",
                           .unit = "V",
                           .percent_of_reading = 0.0035,
                           .percent_of_range = {},
                           .full_scale = {},
                           .digits = 2.0,
                           .digit = 1e-5,
                           .constant = 1e-4}};
    // 50 mV · 0.005 % + 100 mV · 0.0035 % = 0.0025 mV + 0.0035 mV
    EXPECT_NEAR(*limits_at(s, lookup_at(table, 0)).upper, 0.006, 1e-15);
    // 10 V · 0.0035 % + 2 · 10 µV + 100 µV = 0.35 mV + 0.02 mV + 0.1 mV
    EXPECT_NEAR(*limits_at(s, lookup_at(table, 1)).upper, 0.47, 1e-14);
    EXPECT_NEAR(*limits_at(s, lookup_at(table, 1)).lower, -0.47, 1e-14);
    s.limits->accuracy.pop_back();
    EXPECT_THAT(limits_at(s, lookup_at(table, 1)).problem, HasSubstr("not stated for the range \"10 V\""));
    s.limits->accuracy.front().range.clear();
    EXPECT_EQ(limits_at(s, lookup_at(table, 1)).problem, "");
}

TEST(PointLimits, AreStepsOfANominalValue) {
    const PointTable table = points();
    AgreedSpecification s = specification("steps");
    s.limits->arguments = {{.name = "U", .unit = "V", .of = "V"}};
    s.limits->steps = {{.up_to = 0.05, .mpe = 0.1}, {.up_to = 5.0, .mpe = 0.2}};
    EXPECT_EQ(limits_at(s, lookup_at(table, 0)).upper, 0.1) << "the end of a step belongs to it";
    EXPECT_THAT(limits_at(s, lookup_at(table, 1)).problem, HasSubstr("10 V is beyond the last step"));
}

TEST(PointLimits, AreAnExpression) {
    const PointTable table = points();
    AgreedSpecification s = specification("expression");
    s.limits->arguments = {{.name = "U", .unit = "V", .of = "V"}};
    s.limits->expression = "0.1 + 0.02*abs(U)";
    EXPECT_NEAR(*limits_at(s, lookup_at(table, 1)).upper, 0.3, 1e-15);
    s.limits->expression = "-1*abs(U)";
    EXPECT_THAT(limits_at(s, lookup_at(table, 1)).problem, HasSubstr("no value above 0"));
    s.limits->arguments.front().of = "W";
    EXPECT_THAT(limits_at(s, lookup_at(table, 1)).problem, HasSubstr("\"W\""));
}

/// Limits that follow the nominal value, to both sides as far as was agreed: -1 % and +3 % of it.
TEST(PointLimits, AreTwoExpressionsOfANominalValue) {
    const PointTable table = points();
    AgreedSpecification s = specification("expression");
    s.limits->arguments = {{.name = "N", .unit = "V", .of = "V"}};
    s.limits->limit_low = "0.99*N";
    s.limits->limit_high = "1.03*N";
    const LimitsAt both = limits_at(s, lookup_at(table, 0));
    ASSERT_EQ(both.problem, "");
    EXPECT_NEAR(*both.lower, 0.99 * 0.05, 1e-15);
    EXPECT_NEAR(*both.upper, 1.03 * 0.05, 1e-15);
    EXPECT_THAT(limits_at(s, lookup_at(table, 1)).problem, HasSubstr("is not below the upper one")) << "of -10 V";
    s.limits->limit_low = "N - 0.01*abs(N)";
    s.limits->limit_high = "N + 0.03*abs(N)";
    EXPECT_NEAR(*limits_at(s, lookup_at(table, 1)).lower, -10.1, 1e-12);
    EXPECT_NEAR(*limits_at(s, lookup_at(table, 1)).upper, -9.7, 1e-12);
    s.limits->limit_low = "-0.1";
    s.limits->limit_high = "0";
    EXPECT_EQ(limits_at(s, lookup_at(table, 0)).lower, -0.1);
    EXPECT_EQ(limits_at(s, lookup_at(table, 0)).upper, 0.0) << "0 is a limit";
    s.limits->limit_low.clear();
    EXPECT_FALSE(limits_at(s, lookup_at(table, 0)).lower);
    EXPECT_EQ(limits_at(s, lookup_at(table, 0)).upper, 0.0);
    s.limits->limit_low = "0";
    EXPECT_THAT(limits_at(s, lookup_at(table, 0)).problem, HasSubstr("is not below the upper one"));
    s.limits->limit_low = "ln(-1)";
    EXPECT_THAT(limits_at(s, lookup_at(table, 0)).problem, HasSubstr("has no value here"));
}

TEST(PointLimits, SayWhichColumnsTheyNeed) {
    PointLimits limits;
    limits.by = "accuracy";
    limits.of = "V";
    limits.about = "N";
    limits.accuracy.emplace_back();
    EXPECT_THAT(columns_of_limits(limits), ElementsAre("N", "V"));
    limits.accuracy.front().range = "1 V";
    EXPECT_THAT(columns_of_limits(limits), ElementsAre("N", "V", "range"));
}

TEST(PointLimits, FindNoNumberOfAnotherKind) {
    const PointTable table = points();
    const PointLookup lookup = lookup_at(table, 0);
    EXPECT_FALSE(lookup.number("V", "mm", false));
    EXPECT_FALSE(lookup.number("range", "V", false));
    EXPECT_EQ(lookup.word("range"), "100 mV");
    EXPECT_EQ(lookup.word("none"), "");
}

}  // namespace
}  // namespace gumcert::certificate
