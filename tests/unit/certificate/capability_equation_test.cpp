#include "certificate/capability_equation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::certificate {
namespace {

using gum::test::code_of;

Capability capability_of(const std::string& name) {
    return {
        .form = "function",
        .unit = "um",
        .arguments = {{.name = name, .unit = "mm", .of = "value"}, {.name = "f", .unit = "kHz", .of = "frequency"}}};
}

TEST(CapabilityEquation, IsOfPlainNumbersInTheOrderOfTheArguments) {
    const gum::EquationSystem equation = compile_capability(capability_of("L"), "sqrt((0.5)^2+(0.7*L)^2)/f");
    ASSERT_EQ(equation.input_count(), 2U);
    ASSERT_EQ(equation.output_count(), 1U);
    EXPECT_TRUE(equation.output_unit(0).dimension().is_one());
    EXPECT_DOUBLE_EQ(equation.evaluate(Eigen::Vector2d(100.0, 4.0))(0), std::hypot(0.5, 70.0) / 4.0);
}

TEST(CapabilityEquation, LeavesEveryNameToTheArguments) {
    const gum::EquationSystem equation = compile_capability(capability_of("U_of_capability"), "2*U_of_capability");
    EXPECT_EQ(equation.evaluate(Eigen::Vector2d(3.0, 1.0))(0), 6.0);
    EXPECT_EQ(equation.output_name(0), "U_of_capability_");
}

TEST(CapabilityEquation, NamesItsPlaceWhereItIsNone) {
    EXPECT_EQ(code_of<gum::InputError>([] { (void)compile_capability(capability_of("L"), "0.5 + 0.7 L"); }),
              "GC-MODEL-0010");
    EXPECT_EQ(code_of<gum::InputError>([] { (void)compile_capability(capability_of("L"), "Q"); }), "GC-MODEL-0020");
    EXPECT_EQ(gum::test::message_of<gum::InputError>([] {
                  (void)compile_capability(capability_of("L"), "1 +");
              }).substr(0, 27),
              "expression of the capabilit");
}

}  // namespace
}  // namespace gumcert::certificate
