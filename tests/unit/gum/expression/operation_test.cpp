#include "gum/expression/operation.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gumcert::gum {
namespace {

TEST(Operation, HasTheNumberOfItsArguments) {
    int leaves = 0;
    int unary = 0;
    int binary = 0;
    for (int i = 0; i <= static_cast<int>(Operation::hypot); ++i) {
        const auto operation = static_cast<Operation>(i);
        EXPECT_FALSE(is_unary(operation) && is_binary(operation)) << i;
        unary += is_unary(operation) ? 1 : 0;
        binary += is_binary(operation) ? 1 : 0;
        leaves += is_unary(operation) || is_binary(operation) ? 0 : 1;
    }
    EXPECT_EQ(leaves, 3);
    EXPECT_EQ(unary, 17);
    EXPECT_EQ(binary, 9);
    EXPECT_TRUE(is_unary(Operation::negate) && is_unary(Operation::kelvin));
    EXPECT_TRUE(is_binary(Operation::add) && is_binary(Operation::hypot));
}

TEST(Operation, OfOneArgument) {
    using enum Operation;
    EXPECT_EQ(apply(negate, 0.25, 9.0), -0.25);
    EXPECT_EQ(apply(absolute, -0.25, 9.0), 0.25);
    EXPECT_EQ(apply(Operation::sqrt, 6.25, 9.0), 2.5);
    EXPECT_DOUBLE_EQ(apply(Operation::exp, 1.0, 9.0), 2.718281828459045);
    EXPECT_DOUBLE_EQ(apply(ln, 10.0, 9.0), 2.302585092994046);
    EXPECT_EQ(apply(Operation::log10, 1000.0, 9.0), 3.0);
    EXPECT_DOUBLE_EQ(apply(Operation::sin, 0.5, 9.0), 0.479425538604203);
    EXPECT_DOUBLE_EQ(apply(Operation::cos, 0.5, 9.0), 0.8775825618903728);
    EXPECT_DOUBLE_EQ(apply(Operation::tan, 0.5, 9.0), 0.5463024898437905);
    EXPECT_DOUBLE_EQ(apply(Operation::asin, 0.5, 9.0), 0.5235987755982989);
    EXPECT_DOUBLE_EQ(apply(Operation::acos, 0.5, 9.0), 1.0471975511965979);
    EXPECT_DOUBLE_EQ(apply(Operation::atan, 0.5, 9.0), 0.4636476090008061);
    EXPECT_DOUBLE_EQ(apply(Operation::sinh, 0.5, 9.0), 0.5210953054937474);
    EXPECT_DOUBLE_EQ(apply(Operation::cosh, 0.5, 9.0), 1.1276259652063807);
    EXPECT_DOUBLE_EQ(apply(Operation::tanh, 0.5, 9.0), 0.46211715726000973);
    EXPECT_EQ(apply(celsius, 273.15, 9.0), 0.0);
    EXPECT_EQ(apply(kelvin, -273.15, 9.0), 0.0);
}

TEST(Operation, OfTwoArguments) {
    using enum Operation;
    EXPECT_EQ(apply(add, 3.0, -4.0), -1.0);
    EXPECT_EQ(apply(subtract, 3.0, -4.0), 7.0);
    EXPECT_EQ(apply(multiply, 3.0, -4.0), -12.0);
    EXPECT_EQ(apply(divide, 3.0, -4.0), -0.75);
    EXPECT_EQ(apply(power, 3.0, -2.0), 1.0 / 9.0);
    EXPECT_DOUBLE_EQ(apply(Operation::atan2, 1.0, -1.0), 2.356194490192345);
    EXPECT_EQ(apply(minimum, 3.0, -4.0), -4.0);
    EXPECT_EQ(apply(maximum, 3.0, -4.0), 3.0);
    EXPECT_EQ(apply(Operation::hypot, 3.0, -4.0), 5.0);
}

/// What is no step has no value, and a signed zero keeps its sign.
TEST(Operation, LeavesHaveNoValueOfTheirOwn) {
    for (const Operation leaf : {Operation::number, Operation::pi, Operation::quantity}) {
        EXPECT_TRUE(std::isnan(apply(leaf, 1.0, 2.0)));
    }
    EXPECT_TRUE(std::signbit(apply(Operation::negate, 0.0, 0.0)));
    EXPECT_TRUE(std::isinf(apply(Operation::divide, 1.0, 0.0)));
}

TEST(Operation, VisitorSeesTheSameStep) {
    for (int i = static_cast<int>(Operation::negate); i <= static_cast<int>(Operation::hypot); ++i) {
        const auto operation = static_cast<Operation>(i);
        EXPECT_EQ(visit_step(operation, []<Operation step>() { return step; }), operation) << i;
    }
    EXPECT_EQ(visit_step(Operation::pi, []<Operation step>() { return step; }), Operation::number);
}

TEST(Operation, ThreeChooseOneOfTwoValues) {
    for (int i = 0; i <= static_cast<int>(Operation::hypot); ++i) {
        const auto operation = static_cast<Operation>(i);
        EXPECT_EQ(is_choice(operation), operation == Operation::absolute || operation == Operation::minimum ||
                                            operation == Operation::maximum)
            << i;
    }
}

}  // namespace
}  // namespace gumcert::gum
