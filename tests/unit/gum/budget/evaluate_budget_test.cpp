// Published budgets, evaluated from structs. Values in coherent SI, compared in the units of the publication.
#include "gum/budget/evaluate_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/coverage.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/type_b.h"
#include "tests/unit/gum/budget/made_budgets.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::input;
using test::prints_as;
using test::rectangular;
using test::tells;

constexpr double k_nm = 1e-9;

/// Limits that are known to a part r of their half-width: u = a/√3 with ν = 1/(2 r²) (JCGM 100:2008, G.4.2), and drawn as
/// a curvilinear trapezoid (JCGM 101:2008, 6.4.3).
StatedQuantity limits(double half_width, double reliability) {
    StatedQuantity stated = test::shaped(DistributionKind::curvilinear_trapezoid, 0.0, half_width, reliability);
    stated.u = u_from_half_width(half_width);
    stated.degrees_of_freedom = degrees_of_freedom_from_reliability(reliability);
    return stated;
}

BudgetOutput wanted(const std::string& name, const std::string& unit) {
    return {.name = name, .unit = Unit::parse(unit), .coverage_probability = {}, .coverage = {}, .where = {}};
}

/// JCGM 100:2008, H.1: the difference of two end gauges has three components (H.1.3.2).
Budget end_gauge() {
    const auto nm = [](double value, double u, double nu) { return state_uncertainty(value * k_nm, u * k_nm, nu); };
    Budget of = test::budget(
        {"l = l_s + d - l_s*(d_alpha*(theta + Delta) + alpha_s*d_theta)"},
        {input("l_s", nm(50000623, 25, 18), "nm"),
         test::sum_of("d", {nm(215, 5.8, 24), nm(0, 3.9, 5), nm(0, 6.7, 8)}, "nm"),
         input("alpha_s", rectangular(11.5e-6, 2e-6), "1/K"), input("theta", state_uncertainty(-0.1, 0.2), "K"),
         input("Delta", test::shaped(DistributionKind::arcsine, 0.0, 0.5), "K"),
         input("d_alpha", limits(1e-6, 0.1), "1/K"), input("d_theta", limits(0.05, 0.5), "K")});
    of.outputs = {wanted("l", "nm")};
    of.coverage_probability = 0.99;
    of.coverage = CoverageChoice::law_of_propagation;
    return of;
}

TEST(EvaluateBudget, EndGaugeOfTheGum) {
    const BudgetResult result = evaluate_budget(end_gauge(), 1);
    const BudgetPointResult& point = result.points.front();
    const BudgetOutputResult& l = point.outputs.front();
    EXPECT_TRUE(prints_as(point.propagation.value(0) / k_nm, "50000838"));
    EXPECT_TRUE(prints_as(l.standard_uncertainty / k_nm, "31.7"));
    EXPECT_EQ(std::floor(l.degrees_of_freedom), 16.0);
    EXPECT_TRUE(prints_as(coverage_factor(0.99, 16.0), "2.92"));
    // H.1.7: the terms of second order make 34 nm of it.
    EXPECT_TRUE(l.second_order_matters);
    EXPECT_TRUE(prints_as(point.second_order->standard_uncertainty(0) / k_nm, "34"));
    EXPECT_TRUE(tells(result, "GC-BUDGET-0026")) << "the law is asked for although they matter";
    EXPECT_EQ(result.points.front().outputs.front().unit.text(), "nm");
    EXPECT_EQ(budget_result_names(end_gauge(), result), std::vector<std::string>{"l"});
    // Components are quantities of their own: nine of seven inputs.
    EXPECT_EQ(point.model->quantities().size(), 9U);
    EXPECT_NEAR(std::hypot(5.8, 3.9, 6.7) * k_nm,
                std::sqrt(point.propagation.covariance(0, 0) - std::pow(25 * k_nm, 2) - std::pow(2.88678731 * k_nm, 2) -
                          std::pow(16.59902706 * k_nm, 2)),
                1e-3 * k_nm);
}

// JCGM 101:2008, 9.5: the trials have u = 36 nm where the law has 32 nm, and 99 % between 745 nm and 932 nm.
TEST(EvaluateBudget, EndGaugeByTrials) {
    Budget of = end_gauge();
    of.coverage = CoverageChoice::as_validated;
    const BudgetResult result = evaluate_budget(of, 1);
    const BudgetOutputResult& l = result.points[0].outputs[0];
    EXPECT_TRUE(l.by_monte_carlo);
    EXPECT_EQ(l.because, "second_order");
    EXPECT_TRUE(result.automatic_monte_carlo.has_value());
    EXPECT_NEAR(l.monte_carlo->mean / k_nm, 50000838.0, 0.5);
    EXPECT_NEAR(l.monte_carlo->standard_uncertainty / k_nm, 36.0, 0.75);  // from rounded uncertainties of d
    EXPECT_NEAR(l.monte_carlo->symmetric.low / k_nm, 50000745.0, 2.0);
    EXPECT_NEAR(l.monte_carlo->symmetric.high / k_nm, 50000932.0, 2.0);
}

// JCGM 100:2008, H.2, first approach: five sets of readings that were taken together.
TEST(EvaluateBudget, ResistanceAndReactanceOfTheGum) {
    Budget of =
        test::budget({"R = V/I*cos(phi)", "X = V/I*sin(phi)", "Z = V/I"},
                     {input("V", state_observations({5.007, 4.994, 5.005, 4.990, 4.999}), "V"),
                      input("I", state_observations({19.663e-3, 19.639e-3, 19.640e-3, 19.685e-3, 19.678e-3}), "A"),
                      input("phi", state_observations({1.0456, 1.0438, 1.0468, 1.0428, 1.0433}), "rad")});
    test::take_together(of);
    const BudgetResult result = evaluate_budget(of, 1);
    const Propagation& law = result.points.front().propagation;
    EXPECT_TRUE(prints_as(law.value(0), "127.732"));
    EXPECT_TRUE(prints_as(law.value(1), "219.847"));
    EXPECT_TRUE(prints_as(law.value(2), "254.260"));
    EXPECT_TRUE(prints_as(law.standard_uncertainty(0), "0.071"));
    // From the readings as printed it is 0.2956; 0.295 is that of the second approach.
    EXPECT_NEAR(law.standard_uncertainty(1), 0.295, 0.001);
    EXPECT_TRUE(prints_as(law.standard_uncertainty(2), "0.236"));
    const Eigen::MatrixXd r = correlation_matrix(budget_covariance(result));
    EXPECT_TRUE(prints_as(r(0, 1), "-0.588"));
    EXPECT_TRUE(prints_as(r(0, 2), "-0.485"));
    EXPECT_TRUE(prints_as(r(1, 2), "0.993"));
    for (const BudgetOutputResult& output : result.points.front().outputs) {
        EXPECT_NEAR(output.degrees_of_freedom, 4.0, 1e-9) << "one ensemble of five";
        EXPECT_NEAR(*output.coverage_factor, coverage_factor(0.9545, 4.0), 1e-12);
    }
}

// JCGM 100:2008, H.3: a thermometer, its line, and the correction that it predicts at 30 °C.
TEST(EvaluateBudget, TheFitOfAThermometerIsAnInput) {
    Budget of = test::budget({"b_30 = y1 + y2*(at - 20)"}, {input("at", state_constant(30.0))});
    BudgetFit fit =
        test::line({-0.171, -0.169, -0.166, -0.159, -0.164, -0.165, -0.156, -0.157, -0.159, -0.161, -0.160});
    fit.equation.text = "b = y1 + y2*(t - 20)";
    fit.parameters[0].name = "y1";
    fit.parameters[1].name = "y2";
    fit.ordinate = "b";
    fit.regressors = {"t"};
    fit.x << 21.521, 22.012, 22.512, 23.003, 23.507, 23.999, 24.513, 25.002, 25.503, 26.010, 26.511;
    of.fits = {fit};
    const BudgetResult result = evaluate_budget(of, 1);
    const engine::CurveFit& line = result.fits.front();
    EXPECT_TRUE(prints_as(line.parameters(0), "-0.1712"));
    EXPECT_TRUE(prints_as(std::sqrt(line.covariance(0, 0)), "0.0029"));
    EXPECT_TRUE(prints_as(line.parameters(1), "0.00218"));
    EXPECT_TRUE(prints_as(std::sqrt(line.covariance(1, 1)), "0.00067"));
    EXPECT_TRUE(prints_as(correlation_matrix(line.covariance)(0, 1), "-0.930"));
    const BudgetPointResult& point = result.points.front();
    EXPECT_TRUE(prints_as(point.propagation.value(0), "-0.1494"));
    EXPECT_TRUE(prints_as(point.outputs[0].standard_uncertainty, "0.0041"));
    EXPECT_NEAR(point.outputs[0].degrees_of_freedom, 9.0, 1e-9);
    EXPECT_EQ(point.outputs[0].coverage, "student_t");
}

// JCGM 100:2008, H.5: ten daily means of a voltage standard, whose scatter between days is real.
TEST(EvaluateBudget, DailyMeansOfAVoltageStandard) {
    const BudgetOutputResult V = test::first_result(
        test::budget({}, {input("V",
                                state_observations({10.000172, 10.000116, 10.000013, 10.000144, 10.000106, 10.000031,
                                                    10.000060, 10.000125, 10.000163, 10.000041}),
                                "V")}));
    EXPECT_TRUE(prints_as(V.standard_uncertainty * 1e6, "18"));
    EXPECT_EQ(V.degrees_of_freedom, 9.0);
}

// EA-4/02, S2: a weight of 10 kg. The half-width of the drift is calculated back from the printed 8.95 mg.
TEST(EvaluateBudget, WeightOfEa) {
    Budget of =
        test::budget({"m_X = m_S + dm_D + dm + dm_C + dB"},
                     {input("m_S", state_uncertainty(10.000005, 22.5e-6), "kg"),
                      input("dm_D", rectangular(0.0, 15.501854727741455e-6), "kg"),
                      input("dm", state_uncertainty(20e-6, 14.4e-6), "kg"),
                      input("dm_C", rectangular(0.0, 10e-6), "kg"), input("dB", rectangular(0.0, 10e-6), "kg")});
    const BudgetResult result = evaluate_budget(of, 1);
    const BudgetOutputResult& m = result.points[0].outputs[0];
    EXPECT_TRUE(prints_as(result.points[0].propagation.value(0), "10.000025"));
    EXPECT_TRUE(prints_as(m.standard_uncertainty * 1e6, "29.3"));
    EXPECT_TRUE(prints_as(*m.expanded_uncertainty * 1e6, "59"));
    EXPECT_TRUE(result.notes.empty());
}

// JCGM 101:2008, 9.2.3: four rectangular quantities of u = 1. Their sum has ±3.88 where a normal one would have ±3.92.
TEST(EvaluateBudget, FourRectangularQuantities) {
    std::vector<BudgetInput> four;
    for (const char* name : {"a", "b", "c", "d"}) {
        four.push_back(input(name, rectangular(0.0, std::sqrt(3.0))));
    }
    Budget of = test::budget({"y = a + b + c + d"}, std::move(four));
    of.coverage_probability = 0.95;
    of.monte_carlo.emplace().trials = 1'000'000;
    const BudgetOutputResult y = test::first_result(of);
    EXPECT_NEAR(y.standard_uncertainty, 2.0, 1e-12);
    EXPECT_EQ(y.coverage, "convolution");
    EXPECT_TRUE(prints_as(*y.expanded_uncertainty, "3.88"));
    EXPECT_TRUE(prints_as(y.monte_carlo->symmetric.high, "3.88"));
    EXPECT_FALSE(y.by_monte_carlo) << "both say the same";
}

// JCGM 102:2011, 9.2.2: Y1 = X1 + X3, Y2 = X2 + X3 of normal quantities with u = 1.
TEST(EvaluateBudget, TwoSumsWithACommonTerm) {
    const BudgetResult result =
        evaluate_budget(test::budget({"Y1 = X1 + X3", "Y2 = X2 + X3"},
                                     {input("X1", state_uncertainty(0, 1)), input("X2", state_uncertainty(0, 1)),
                                      input("X3", state_uncertainty(0, 1))}),
                        1);
    const Eigen::MatrixXd V = budget_covariance(result);
    EXPECT_NEAR(V(0, 0), 2.0, 1e-14);
    EXPECT_NEAR(V(0, 1), 1.0, 1e-14);
}

// JCGM 100:2008, G.4.1: Welch and Satterthwaite hold for independent contributions. Of two correlated inputs the least
// number of degrees of freedom is taken for both, and that is said.
TEST(EvaluateBudget, CorrelatedInputsWithDifferentDegreesOfFreedom) {
    Budget of =
        test::budget({"y = a + b"}, {input("a", state_uncertainty(1, 3, 5)), input("b", state_uncertainty(2, 4, 50))});
    test::correlate(of, "b", "a", 0.5);  // in whichever order the pair is named
    const BudgetResult result = evaluate_budget(of, 1);
    const BudgetOutputResult& y = result.points[0].outputs[0];
    EXPECT_NEAR(y.standard_uncertainty, std::sqrt(9.0 + 16.0 + 12.0), 1e-12);
    EXPECT_NEAR(y.degrees_of_freedom, 5.0, 1e-9);
    EXPECT_TRUE(tells(result, "GC-BUDGET-0012"));
    EXPECT_FALSE(tells(result, "GC-BUDGET-0010"));
}

// Points share what is common to them: cov(e1, e2) = u²(s), and own readings have none.
TEST(EvaluateBudget, PointsOfATable) {
    Budget of = test::budget({"e = x - s"}, {input("x", state_uncertainty(0.010, 2e-6), "mm"),
                                             input("s", state_uncertainty(0.010, 3e-6), "mm")});
    of.outputs = {wanted("e", "um")};
    of.points = {test::point(of, "10 mm", {{"x", state_uncertainty(0.010001, 2e-6)}}),
                 test::point(of, "20 mm", {{"x", state_uncertainty(0.010004, 4e-6)}})};
    const BudgetResult result = evaluate_budget(of, 1);
    ASSERT_EQ(result.points.size(), 2U);
    EXPECT_NEAR(result.points[1].propagation.value(0), 4e-6, 1e-15);
    EXPECT_NEAR(result.points[1].outputs[0].standard_uncertainty, 5e-6, 1e-15);
    const Eigen::MatrixXd V = budget_covariance(result);
    EXPECT_NEAR(V(0, 1), 9e-12, 1e-20);
    EXPECT_NEAR(V(1, 1), 25e-12, 1e-20);
    EXPECT_EQ(budget_result_names(of, result), (std::vector<std::string>{"e[10 mm]", "e[20 mm]"}));
}

TEST(EvaluateBudget, TellsWhatItIsDoing) {
    Budget of = test::budget({"z = a + b*q"}, {input("q", state_uncertainty(2, 0.1))});
    of.fits = {test::line({1, 3.1, 4.9}, 0.1)};
    of.points = {test::point(of, "1", {{"q", state_uncertainty(1, 0.1)}})};
    std::vector<std::string> said;
    (void)evaluate_budget(of, 1, [&](const std::string& sentence) { said.push_back(sentence); });
    EXPECT_EQ(said, (std::vector<std::string>{"fit of f", "point 1 of 1"}));
}

TEST(EvaluateBudget, RefusesEquationsThatDoNotFit) {
    EXPECT_THROW((void)evaluate_budget(test::budget({"y = a + c"}, {input("a", state_uncertainty(1, 1))}), 1),
                 InputError);
    EXPECT_THROW((void)evaluate_budget(test::budget({"y = a + b"}, {input("a", state_uncertainty(1, 1), "m"),
                                                                    input("b", state_uncertainty(1, 1), "s")}),
                                       1),
                 InputError);
}

// The law, for any number of threads: a result with trials has the same bits.
TEST(EvaluateBudget, GivesTheSameForAnyNumberOfThreads) {
    Budget of = test::budget({"y = x^2"}, {input("x", state_uncertainty(1, 0.5))});
    const MonteCarloOutput one = *test::first_result(of).monte_carlo;
    const MonteCarloOutput three = *evaluate_budget(of, 3).points[0].outputs[0].monte_carlo;
    EXPECT_EQ(one.mean, three.mean);
    EXPECT_EQ(one.symmetric, three.symmetric);
}

}  // namespace
}  // namespace gumcert::gum
