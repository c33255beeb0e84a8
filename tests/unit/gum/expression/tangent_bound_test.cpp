#include "gum/expression/tangent_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "tests/unit/gum/expression/equations.h"

namespace gumcert::gum {
namespace {

OutputBound bound_of(const std::string& equation, const std::vector<InputSymbol>& inputs, const std::vector<double>& x,
                     const std::vector<double>& reach) {
    const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(reach.data(), static_cast<Eigen::Index>(reach.size()));
    return tangent_bound(equations({equation}), inputs, 0, at, at - d, at + d);
}

TEST(TangentBound, IsTightForASquareAndAProduct) {
    const OutputBound of_square = bound_of("y = a^2", numbers({"a"}), {3.0}, {0.5});
    ASSERT_TRUE(of_square.bound);
    EXPECT_NEAR(of_square.bound->high, 0.25, 1e-12);
    EXPECT_NEAR(of_square.bound->low, 0.0, 1e-12) << "a square lies on one side of its tangent";
    EXPECT_NEAR(of_square.bound->certain, 0.25, 1e-12);
    EXPECT_NEAR(of_square.bound->largest(), 0.25, 1e-12);
    const OutputBound of_product = bound_of("y = a*b", numbers({"a", "b"}), {0.0, 0.0}, {0.5, 0.25});
    ASSERT_TRUE(of_product.bound);
    EXPECT_NEAR(of_product.bound->high, 0.125, 1e-12);
    EXPECT_NEAR(of_product.bound->low, -0.125, 1e-12);
}

TEST(TangentBound, IsNothingForALinearEquation) {
    const OutputBound bound =
        bound_of("y = 2*a - b/3 + c*7", numbers({"a", "b", "c"}), {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3});
    ASSERT_TRUE(bound.bound);
    EXPECT_LT(bound.bound->largest(), 1e-300);
    EXPECT_LT(bound.bound->certain, 1e-14);
}

TEST(TangentBound, LooksOnlyAtWhatVaries) {
    EXPECT_LT(bound_of("y = a/b", numbers({"a", "b"}), {1.0, 2.0}, {0.5, 0.0}).bound->largest(), 1e-300);
    EXPECT_GT(bound_of("y = a/b", numbers({"a", "b"}), {1.0, 2.0}, {0.0, 0.5}).bound->largest(), 0.01);
}

TEST(TangentBound, IsThatOfTheResultAloneAmongManyResults) {
    std::vector<InputSymbol> inputs = numbers({"a", "b"});
    std::vector<std::string> texts{"y = a*b + a^2"};
    for (int i = 0; i < 30; ++i) {
        inputs.push_back(input("c" + std::to_string(i)));
        texts.push_back("z" + std::to_string(i) + " = a*exp(c" + std::to_string(i) + ")");
    }
    const auto n = static_cast<Eigen::Index>(inputs.size());
    const Eigen::VectorXd at = Eigen::VectorXd::Constant(n, 1.0), reach = Eigen::VectorXd::Constant(n, 0.25);
    const OutputBound alone = tangent_bound(equations({texts.front()}), numbers({"a", "b"}), 0, at.head(2),
                                            (at - reach).head(2), (at + reach).head(2));
    const OutputBound among = tangent_bound(equations(texts), inputs, 0, at, at - reach, at + reach);
    ASSERT_TRUE(alone.bound && among.bound);
    EXPECT_EQ(among.bound->low, alone.bound->low);
    EXPECT_EQ(among.bound->high, alone.bound->high);
    EXPECT_EQ(among.bound->certain, alone.bound->certain);
}

TEST(TangentBound, SaysWhyThereIsNone) {
    const auto why = [](const std::string& equation, std::vector<double> x, std::vector<double> reach) {
        std::vector<InputSymbol> inputs = numbers({"a"});
        if (x.size() > 1) {
            inputs = numbers({"a", "b"});
        }
        const OutputBound bound = bound_of(equation, inputs, x, reach);
        EXPECT_FALSE(bound.bound) << equation;
        return bound.why_not;
    };
    EXPECT_EQ(why("y = 1/a", {1.0}, {2.0}), "\"1/a\": the divisor may be 0 there");
    EXPECT_EQ(why("y = abs(a)", {0.1}, {0.2}), "\"abs(a)\": a kink may lie there");
    EXPECT_EQ(why("y = min(a, b)", {0.1, 0.2}, {0.2, 0.0}), "\"min(a, b)\": a kink may lie there");
    EXPECT_EQ(why("y = sqrt(a)", {0.1}, {0.2}), "\"sqrt(a)\": the argument may be 0 or negative there");
    EXPECT_EQ(why("y = asin(a)/rad", {0.9}, {0.2}), "\"asin(a)\": the argument may reach 1 or -1 there");
    EXPECT_EQ(why("y = tan(a*rad)", {1.5}, {0.2}), "\"tan(a*rad)\": a point without derivative may lie there");
    EXPECT_EQ(why("y = exp(a)", {1.0}, {1e6}), "\"exp(a)\": there may be no finite value there");
}

/// A random equation of three inputs, near (1, 2, 0.5).
class RandomEquation {
public:
    explicit RandomEquation(std::uint64_t seed) : random_(seed) {}

    std::string text(int depth) {
        static const char* const k_leaves[] = {"a", "b", "c", "2", "0.3"};
        if (depth == 0) {
            return k_leaves[below(5)];
        }
        const std::string one = text(depth - 1);
        switch (below(19)) {
            case 0:
                return "sin((" + one + ")*rad)";
            case 1:
                return "cos((" + one + ")*rad)";
            case 2:
                return "exp(0.3*(" + one + "))";
            case 3:
                return "sqrt(1 + (" + one + ")^2)";
            case 4:
                return "ln(3 + (" + one + ")^2)";
            case 5:
                return "atan(" + one + ")/rad";
            case 6:
                return "tanh(" + one + ")";
            case 7:
                return "(" + one + ")^3";
            case 8:
                return "(2 + cos((" + one + ")*rad))^1.7";
            case 9:
                return "asin(0.5*sin((" + one + ")*rad))/rad";
            case 10:
                return "atan2(" + one + ", 2 + sin((" + text(depth - 1) + ")*rad))/rad";
            case 11:
                return "hypot(1 + abs(5 + " + one + "), " + text(depth - 1) + ")";
            case 12:
                return "sinh(0.2*(" + one + "))";
            case 13:
                return "(" + one + ")/(3 + sin((" + text(depth - 1) + ")*rad))";
            case 14:
            case 15:
                return "(" + one + ")*(" + text(depth - 1) + ")";
            case 16:
                return "(" + one + ") - (" + text(depth - 1) + ")";
            case 17:
                return "tan(0.2*rad*sin((" + one + ")*rad))";
            default:
                return "(" + one + ") + (" + text(depth - 1) + ")";
        }
    }
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

private:
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
    std::mt19937_64 random_;
};

/// The law: what brute force finds never exceeds the bound, and what is certain is reached.
/// GUMCERT_BOUND_SEED=… looks at other equations.
TEST(TangentBound, IsNeverExceeded) {
    const char* const text = std::getenv("GUMCERT_BOUND_SEED");
    RandomEquation random(text == nullptr ? 1 : std::strtoull(text, nullptr, 10));
    int bounded = 0;
    double tightest = 0.0;
    for (int n = 0; n < 400; ++n) {
        const std::string equation = "y = " + random.text(1 + n % 4) + " + 0*a*b*c";
        const EquationSystem system = system_of({equation}, numbers({"a", "b", "c"}));
        const std::vector<double> x{random.between(0.5, 1.5), random.between(1.5, 2.5), random.between(0.2, 0.8)};
        const double size = std::pow(10.0, random.between(-4.0, -0.5));
        const std::vector<double> reach{size * random.between(0.1, 1.0), size * random.between(0.1, 1.0),
                                        size * random.between(0.0, 1.0)};
        const OutputBound bound = bound_of(equation, numbers({"a", "b", "c"}), x, reach);
        if (!bound.bound) {
            continue;
        }
        const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(x.data(), 3);
        const double f0 = system.evaluate(at)(0);
        const Eigen::MatrixXd slope = system.jacobian(at);
        double least = 0.0, most = 0.0, rounding = 0.0;
        for (int trial = 0; trial < 300; ++trial) {
            Eigen::VectorXd there = at;
            for (Eigen::Index i = 0; i < 3; ++i) {
                const double t = random.between(-1.3, 1.3);
                there(i) += reach[static_cast<std::size_t>(i)] * std::fmax(-1.0, std::fmin(1.0, t));
            }
            const double linear = (slope * (there - at))(0), f = system.evaluate(there)(0);
            least = std::min(least, f - f0 - linear);
            most = std::max(most, f - f0 - linear);
            rounding = std::max(rounding, 1e-13 * (1.0 + std::fabs(f) + std::fabs(linear)));
        }
        ++bounded;
        ASSERT_GE(least, bound.bound->low - rounding) << equation;
        ASSERT_LE(most, bound.bound->high + rounding) << equation;
        ASSERT_LE(bound.bound->certain, bound.bound->largest() + rounding) << equation;
        if (bound.bound->largest() > 1e-9) {
            tightest = std::max(tightest, std::max(-least, most) / bound.bound->largest());
        }
    }
    EXPECT_GT(bounded, 300);
    EXPECT_GT(tightest, 0.5) << "a bound that is never approached would say nothing";
}

}  // namespace
}  // namespace gumcert::gum
