#include "gum/expression/enclosure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "gum/expression/operation.h"

namespace gumcert::gum {
namespace {

using enum Operation;

/// The value of a step to more digits than a double has.
long double exactly(Operation operation, long double a, long double b) {
    switch (operation) {
        case Operation::sqrt:
            return std::sqrt(a);
        case Operation::exp:
            return std::exp(a);
        case ln:
            return std::log(a);
        case Operation::log10:
            return std::log10(a);
        case Operation::sin:
            return std::sin(a);
        case Operation::cos:
            return std::cos(a);
        case Operation::tan:
            return std::tan(a);
        case Operation::asin:
            return std::asin(a);
        case Operation::acos:
            return std::acos(a);
        case Operation::atan:
            return std::atan(a);
        case Operation::sinh:
            return std::sinh(a);
        case Operation::cosh:
            return std::cosh(a);
        case Operation::tanh:
            return std::tanh(a);
        case add:
            return a + b;
        case subtract:
            return a - b;
        case multiply:
            return a * b;
        case divide:
            return a / b;
        case power:
            return std::pow(a, b);
        case Operation::atan2:
            return std::atan2(a, b);
        case Operation::hypot:
            return std::hypot(a, b);
        case absolute:
            return std::fabs(a);
        case minimum:
            return std::min(a, b);
        case maximum:
            return std::max(a, b);
        case celsius:
            return a - 273.15;
        case kelvin:
            return a + 273.15;
        default:
            return -a;
    }
}

const std::vector<Operation> k_operations{negate,
                                          absolute,
                                          Operation::sqrt,
                                          Operation::exp,
                                          ln,
                                          Operation::log10,
                                          Operation::sin,
                                          Operation::cos,
                                          Operation::tan,
                                          Operation::asin,
                                          Operation::acos,
                                          Operation::atan,
                                          Operation::sinh,
                                          Operation::cosh,
                                          Operation::tanh,
                                          add,
                                          subtract,
                                          multiply,
                                          divide,
                                          power,
                                          Operation::atan2,
                                          minimum,
                                          maximum,
                                          Operation::hypot,
                                          celsius,
                                          kelvin};

Enclosure random_enclosure(std::mt19937_64& random) {
    std::uniform_real_distribution<double> exponent(-3.0, 1.2), sign(-1.0, 1.0), width(-6.0, 0.8);
    const double centre = std::copysign(std::pow(10.0, exponent(random)), sign(random));
    const double half = std::pow(10.0, width(random));
    return {centre - half, centre + half};
}

TEST(Enclosure, HoldsEveryValueOfEveryOperation) {
    std::mt19937_64 random(20261124);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    const auto inside = [&](const Enclosure& e) {
        const double t = part(random);
        return t < 0.1 ? e.low : t > 0.9 ? e.high : std::clamp(e.low + t * (e.high - e.low), e.low, e.high);
    };
    for (const Operation operation : k_operations) {
        int enclosed = 0;
        for (int trial = 0; trial < 4000; ++trial) {
            const Enclosure a = random_enclosure(random), b = random_enclosure(random);
            const std::optional<Enclosure> values = enclose(operation, a, b);
            if (!values) {
                continue;
            }
            ++enclosed;
            for (int i = 0; i < 10; ++i) {
                const double x = inside(a), y = inside(b);
                const long double value = exactly(operation, x, y);
                ASSERT_TRUE(values->low <= value && value <= values->high)
                    << static_cast<int>(operation) << " of " << x << " and " << y;
            }
        }
        EXPECT_GT(enclosed, 100) << static_cast<int>(operation) << " is nearly never enclosed";
    }
}

TEST(Enclosure, HoldsEveryDerivative) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (const Operation operation : k_operations) {
        for (int trial = 0; trial < 1000; ++trial) {
            const Enclosure a = random_enclosure(random), b = random_enclosure(random);
            const std::optional<EnclosedStep> step = enclose_with_partials(operation, a, b);
            if (!step) {
                continue;
            }
            const long double x = a.low + part(random) * (a.high - a.low), y = b.low + part(random) * (b.high - b.low);
            // Central differences of long doubles. Where those of two steps differ the function changes too fast for them.
            const auto holds = [&](const Enclosure& e, const auto& difference) {
                const long double coarse = difference(1.0L), fine = difference(0.5L);
                const long double slack = 1e-4L * (std::fabs(fine) + e.largest()) + 1e-6L;
                const bool resolved = std::isfinite(coarse) && std::fabs(coarse - fine) < 0.5L * slack;
                return !resolved || (e.low - slack <= fine && fine <= e.high + slack);
            };
            const long double hx = std::max(1e-6L, 1e-3L * std::fabs(x)), hy = std::max(1e-6L, 1e-3L * std::fabs(y));
            const auto f = [&](long double dx, long double dy) { return exactly(operation, x + dx, y + dy); };
            const auto where = [&] {
                return std::to_string(static_cast<int>(operation)) + " at " + std::to_string(x) + ", " +
                       std::to_string(y);
            };
            ASSERT_TRUE(holds(step->da, [&](long double t) { return (f(t * hx, 0) - f(-t * hx, 0)) / (2 * t * hx); }))
                << where();
            ASSERT_TRUE(holds(step->daa, [&](long double t) {
                return (f(t * hx, 0) - 2 * f(0, 0) + f(-t * hx, 0)) / (t * t * hx * hx);
            })) << where();
            if (!is_binary(operation)) {
                continue;
            }
            ASSERT_TRUE(holds(step->db, [&](long double t) { return (f(0, t * hy) - f(0, -t * hy)) / (2 * t * hy); }))
                << where();
            ASSERT_TRUE(holds(step->dbb, [&](long double t) {
                return (f(0, t * hy) - 2 * f(0, 0) + f(0, -t * hy)) / (t * t * hy * hy);
            })) << where();
            ASSERT_TRUE(holds(step->dab, [&](long double t) {
                const long double dx = t * hx, dy = t * hy;
                return (f(dx, dy) - f(dx, -dy) - f(-dx, dy) + f(-dx, -dy)) / (4 * dx * dy);
            })) << where();
        }
    }
}

TEST(Enclosure, KnowsTheExtremesOfSineAndCosine) {
    const std::optional<Enclosure> top = enclose(Operation::sin, {1.0, 2.0}, {});
    EXPECT_EQ(top->high, 1.0);
    EXPECT_NEAR(top->low, std::sin(1.0), 1e-12);
    EXPECT_EQ(enclose(Operation::sin, {4.0, 5.0}, {})->low, -1.0);
    EXPECT_EQ(enclose(Operation::cos, {-0.5, 0.25}, {})->high, 1.0);
    EXPECT_EQ(enclose(Operation::cos, {3.0, 3.5}, {})->low, -1.0);
    EXPECT_EQ(enclose(Operation::sin, {-10.0, 10.0}, {})->low, -1.0);
    EXPECT_EQ(enclose(Operation::cos, {1e9, 1e9}, {})->low, -1.0) << "periods are not counted so far away";
    const Enclosure narrow = *enclose(Operation::sin, {0.1, 0.2}, {});
    EXPECT_LT(narrow.high - narrow.low, std::sin(0.2) - std::sin(0.1) + 1e-14);
}

TEST(Enclosure, HasNoneWhereThereIsNoValueOrDerivative) {
    const Enclosure around_0{-1.0, 1.0}, beyond{0.5, 1.5};
    EXPECT_FALSE(enclose(divide, {1.0, 1.0}, around_0));
    EXPECT_FALSE(enclose(divide, {1.0, 1.0}, {0.0, 1.0}));
    EXPECT_FALSE(enclose(ln, {0.0, 1.0}, {}));
    EXPECT_FALSE(enclose(Operation::sqrt, around_0, {}));
    EXPECT_FALSE(enclose(power, around_0, {2.5, 2.5}));
    EXPECT_FALSE(enclose(Operation::asin, beyond, {}));
    EXPECT_FALSE(enclose(Operation::acos, {-1.0, 0.0}, {}));
    EXPECT_FALSE(enclose(Operation::tan, {1.5, 1.6}, {}));
    EXPECT_TRUE(enclose(Operation::tan, {1.6, 1.7}, {}));
    EXPECT_FALSE(enclose(absolute, around_0, {}));
    EXPECT_FALSE(enclose(minimum, around_0, beyond));
    EXPECT_FALSE(enclose(maximum, around_0, {1.0, 2.0}));
    EXPECT_FALSE(enclose(Operation::atan2, around_0, around_0));
    EXPECT_FALSE(enclose(Operation::atan2, around_0, {-2.0, -1.0})) << "the cut";
    EXPECT_TRUE(enclose(Operation::atan2, around_0, {1.0, 2.0}));
    EXPECT_TRUE(enclose(Operation::atan2, {1.0, 2.0}, around_0));
    EXPECT_FALSE(enclose(Operation::hypot, around_0, around_0));
    EXPECT_FALSE(enclose(Operation::exp, {1.0, 1e6}, {})) << "overflow";
    EXPECT_FALSE(enclose(add, {1e308, 1e308}, {1e308, 1e308}));
}

TEST(Enclosure, LeavesTheRoundingModeAlone) {
    ASSERT_EQ(std::fegetround(), FE_TONEAREST);
    for (const Operation operation : k_operations) {
        (void)enclose_with_partials(operation, {0.25, 0.5}, {0.75, 0.875});
        EXPECT_EQ(std::fegetround(), FE_TONEAREST) << static_cast<int>(operation);
    }
}

TEST(Enclosure, KeepsWhatIsExact) {
    EXPECT_TRUE((Enclosure{} * Enclosure{-1e300, 1e300}).is_zero());
    const Enclosure sum = Enclosure{} + Enclosure{1.0, 2.0};
    EXPECT_EQ(sum.low, 1.0);
    EXPECT_EQ(sum.high, 2.0);
    EXPECT_GE(square({-1.0, 2.0}).low, 0.0);
    EXPECT_EQ((Enclosure{-3.0, 2.0}.largest()), 3.0);
    EXPECT_EQ((Enclosure{-3.0, 2.0}.smallest()), 0.0);
    EXPECT_EQ((Enclosure{-3.0, -2.0}.smallest()), 2.0);
}

}  // namespace
}  // namespace gumcert::gum
