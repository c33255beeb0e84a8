#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "equations.h"

namespace gumcert::gum {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Structure, EquationsAreTakenInAnyOrder) {
    const EquationSystem system = system_of({"y = u + v", "u = 2*w", "v = w^2", "w = a + 1"}, numbers({"a"}));
    ASSERT_EQ(system.output_count(), 1U);
    EXPECT_EQ(system.output_name(0), "y");
    EXPECT_EQ(system.evaluate(vector({2.0}))(0), 15.0);
}

TEST(Structure, OutputsAreThoseThatNobodyUsesOrThoseAskedFor) {
    const std::vector<std::string> texts{"p = a + b", "q = a - b", "r = 2*p"};
    const EquationSystem all = system_of(texts, numbers({"a", "b"}));
    ASSERT_EQ(all.output_count(), 2U);
    EXPECT_EQ(all.output_name(0), "q");
    EXPECT_EQ(all.output_name(1), "r");
    const EquationSystem asked = system_of(texts, numbers({"a", "b"}), {}, {output("r", "1"), output("p", "1")});
    EXPECT_EQ(asked.output_name(0), "r");
    EXPECT_EQ(asked.evaluate(vector({1.0, 2.0})), vector({6.0, 3.0}));
    EXPECT_EQ(codes(problems_of(texts, numbers({"a", "b"}), {},
                                {output("rr", "1"), output("a", "1"), output("q", "1"), output("q", "1")})),
              "0028 output rr; 0028 output a; 0044 output q");
}

TEST(Structure, CyclesArePrinted) {
    EXPECT_EQ(messages(problems_of({"a = b + 1", "b = 2*c", "c = a"}, {})),
              "m/0, column 1 — a → b → c → a is a cycle — equations can be put in an order — Break the cycle, or write "
              "its equations as \"0 = …\" with \"solve_for\".\n");
    EXPECT_EQ(codes(problems_of({"y = y + x"}, numbers({"x"}))), "0025 m/0, column 1");
    // A problem elsewhere is told in the same breath.
    EXPECT_EQ(codes(problems_of({"a = b", "b = a", "y = x + k + a"}, {input("x", "m"), input("k", "K")})),
              "0024 m/0, column 1; 0030 m/2, column 7");
}

TEST(Structure, LargeNonsenseIsRefusedQuickly) {
    std::vector<InputSymbol> inputs;
    std::string equation = "y = 0";
    std::vector<std::string> ring;
    for (int i = 0; i < 5000; ++i) {
        const std::string n = std::to_string(i);
        inputs.push_back({.name = "quantity_" + n, .unit = {}, .constant = {}});
        equation += " + quantum" + n;
        ring.push_back("r" + n + " = r" + std::to_string((i + 1) % 5000));
    }
    EXPECT_EQ(problems_of({equation.substr(0, 60'000)}, inputs).size(), 101U);
    const std::vector<Diagnostic> cycle = problems_of(ring, {});
    ASSERT_EQ(cycle.size(), 1U);
    EXPECT_LT(cycle.front().what.size(), 300U);
}

TEST(Structure, NamesAreDefinedOnce) {
    EXPECT_EQ(codes(problems_of({"y = x", "y = 2*x"}, numbers({"x"}))), "0021 m/1, column 1");
    EXPECT_EQ(codes(problems_of({"x = 2"}, numbers({"x"}))), "0022 m/0, column 1");
    EXPECT_EQ(codes(problems_of({"t = x", "0 = t - x"}, numbers({"x"}), {unknown("t", 1)})), "0022 m/0, column 1");
    EXPECT_EQ(codes(problems_of({"y = x"}, numbers({"x", "x"}))), "0029 input x");
    EXPECT_EQ(codes(problems_of({}, numbers({"x"}))), "0019 model");
}

TEST(Structure, ImplicitEquationsAndUnknownsAreCounted) {
    EXPECT_EQ(codes(problems_of({"0 = x - 1"}, numbers({"x"}))), "0026 m/0, column 1");
    EXPECT_EQ(codes(problems_of({"y = t"}, {}, {unknown("t", 1)})), "0026 model; 0027 unknown t");
    EXPECT_EQ(codes(problems_of({"0 = x - s", "0 = x + s"}, numbers({"x"}), {unknown("s", 1), unknown("t", 1)})),
              "0027 unknown t");
}

TEST(Structure, UnusedInputs) {
    const EquationSystem system = system_of(
        {"y = a^n", "z = b"}, {input("a"), input("n", "1", 2.0), input("b"), input("c")}, {}, {output("y", "1")});
    EXPECT_THAT(system.unused_inputs(), ElementsAre(2, 3));
}

TEST(Structure, RadianIsAConstantUnlessAnInputHasTheName) {
    EXPECT_EQ(system_of({"y = a*rad"}, numbers({"a"})).output_unit(0).text(), "rad");
    EXPECT_EQ(system_of({"y = rad*2"}, {input("rad", "m")}).output_unit(0).text(), "m");
}

TEST(Structure, AffineInWhat) {
    const EquationSystem gauge = system_of({"l = l_s + d - l_s*(d_alpha*theta + alpha_s*d_theta)"},
                                           numbers({"l_s", "d", "d_alpha", "theta", "alpha_s", "d_theta"}));
    const auto affine = [](const EquationSystem& system, std::vector<std::size_t> inputs) {
        return system.is_affine_in(inputs);
    };
    EXPECT_TRUE(affine(gauge, {0, 1}));
    EXPECT_TRUE(affine(gauge, {1, 3, 5}));
    EXPECT_FALSE(affine(gauge, {0, 3}));
    EXPECT_FALSE(affine(gauge, {2, 3}));
    const EquationSystem quotient = system_of({"y = a/b"}, numbers({"a", "b"}));
    EXPECT_TRUE(affine(quotient, {0}));
    EXPECT_FALSE(affine(quotient, {1}));
    const EquationSystem implicit = system_of({"0 = a*t - b", "y = 2*t"}, numbers({"a", "b"}), {unknown("t", 1)});
    EXPECT_TRUE(affine(implicit, {1}));
    EXPECT_FALSE(affine(implicit, {0}));
}

// Of one output each: of what all use together nothing follows for two of them. Dependence is of the equations, not of
// a derivative that may vanish.
TEST(Structure, InputsOfAnOutput) {
    const EquationSystem system =
        system_of({"s = a + b", "y = s^2", "z = c*0 + b", "w = 3"}, numbers({"a", "b", "c", "d"}), {},
                  {output("y", "1"), output("z", "1"), output("w", "1")});
    EXPECT_THAT(system.inputs_of(0), ElementsAre(true, true, false, false));
    EXPECT_THAT(system.inputs_of(1), ElementsAre(false, true, true, false));
    EXPECT_THAT(system.inputs_of(2), ElementsAre(false, false, false, false));
    const EquationSystem implicit =
        system_of({"0 = a*t - b", "0 = s - c", "y = 2*t", "x = d"}, numbers({"a", "b", "c", "d"}),
                  {unknown("t", 1), unknown("s", 1)}, {output("y", "1"), output("x", "1")});
    EXPECT_THAT(implicit.inputs_of(0), ElementsAre(true, true, true, false));
    EXPECT_THAT(implicit.inputs_of(1), ElementsAre(false, false, false, true));
}

}  // namespace
}  // namespace gumcert::gum
