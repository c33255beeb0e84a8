#include "gum/monte_carlo/monte_carlo.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "gum/distribution_quantile.h"
#include "gum/monte_carlo/monte_carlo_statistics.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::message_of;

using Columns = Eigen::Ref<const Eigen::MatrixXd>;

/// A model given column by column.
class TrialModel : public MeasurementModel {
public:
    std::vector<InputGroup> groups;
    std::vector<OutputQuantity> quantities;
    std::function<void(const Columns&, Eigen::Ref<Eigen::MatrixXd>)> function;

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return quantities; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        Eigen::MatrixXd y(1, static_cast<Eigen::Index>(quantities.size()));
        function(x.transpose(), y);
        return y.row(0).transpose();
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        return Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(quantities.size()), x.size());
    }
    void evaluate_trials(const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) const override { function(x, y); }
};

InputGroup input(std::string name, const Distribution& distribution) {
    InputGroup group;
    group.name = std::move(name);
    group.unit = "m";
    group.value = Eigen::VectorXd::Constant(1, distribution.location);
    group.covariance = Eigen::MatrixXd::Ones(1, 1);
    group.marginals = {distribution};
    return group;
}

InputGroup normal_pair(double x1, double x2, double u, double r) {
    InputGroup group;
    group.name = "pair";
    group.unit = "m";
    group.value = Eigen::Vector2d(x1, x2);
    group.covariance = (Eigen::Matrix2d() << u * u, r * u * u, r * u * u, u * u).finished();
    return group;
}

TrialModel model(const std::vector<Distribution>& inputs, int outputs,
                 std::function<void(const Columns&, Eigen::Ref<Eigen::MatrixXd>)> function) {
    TrialModel result;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        result.groups.push_back(input("x" + std::to_string(i + 1), inputs[i]));
    }
    for (int j = 0; j < outputs; ++j) {
        result.quantities.push_back({.name = "y" + std::to_string(j + 1), .unit = "m"});
    }
    result.function = std::move(function);
    return result;
}

TrialModel sum_model(const std::vector<Distribution>& inputs) {
    return model(inputs, 1, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) { y.col(0) = x.rowwise().sum(); });
}

/// JCGM 101:2008, 9.5: end gauge, [nm], [1/°C], [°C].
TrialModel gauge_block() {
    return model({Distribution::student_t(50000623.0, 25.0, 18.0),
                  Distribution::student_t(215.0, 6.0, 24.0),
                  Distribution::student_t(0.0, 4.0, 5.0),
                  Distribution::student_t(0.0, 7.0, 8.0),
                  Distribution::uniform(11.5e-6, 2e-6),
                  Distribution::normal(-0.1, 0.2),
                  {.kind = DistributionKind::arcsine, .scale = 0.5},
                  {.kind = DistributionKind::curvilinear_trapezoid, .scale = 1e-6, .shape = 0.1},
                  {.kind = DistributionKind::curvilinear_trapezoid, .scale = 0.05, .shape = 0.5}},
                 1, [](const Columns& columns, Eigen::Ref<Eigen::MatrixXd> y) {
                     const auto x = columns.array();
                     y.col(0) = x.col(0) + x.col(1) + x.col(2) + x.col(3) -
                                x.col(0) * (x.col(7) * (x.col(5) + x.col(6)) + x.col(4) * x.col(8)) - 50000000.0;
                 });
}

TrialModel polar(double x1, double x2, double r) {
    TrialModel result = model({}, 2, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
        for (Eigen::Index i = 0; i < x.rows(); ++i) {
            y(i, 0) = std::hypot(x(i, 0), x(i, 1));
            y(i, 1) = std::atan2(x(i, 1), x(i, 0));
        }
    });
    result.groups = {normal_pair(x1, x2, 0.01, r)};
    return result;
}

MonteCarloOptions options(std::uint64_t trials, double p = 0.95) {
    MonteCarloOptions result;
    result.trials = trials;
    result.coverage_probability = p;
    result.threads = 2;
    return result;
}

void expect_same(const MonteCarloResult& a, const MonteCarloResult& b) {
    ASSERT_EQ(a.outputs.size(), b.outputs.size());
    EXPECT_EQ(a.trials, b.trials);
    EXPECT_EQ(a.stabilised, b.stabilised);
    EXPECT_EQ(a.tolerance, b.tolerance);
    EXPECT_EQ(a.covariance, b.covariance);
    for (std::size_t j = 0; j < a.outputs.size(); ++j) {
        EXPECT_EQ(a.outputs[j].mean, b.outputs[j].mean);
        EXPECT_EQ(a.outputs[j].standard_uncertainty, b.outputs[j].standard_uncertainty);
        EXPECT_EQ(a.outputs[j].symmetric, b.outputs[j].symmetric);
        EXPECT_EQ(a.outputs[j].shortest, b.outputs[j].shortest);
        EXPECT_EQ(a.outputs[j].numerical_error.symmetric, b.outputs[j].numerical_error.symmetric);
        EXPECT_EQ(a.outputs[j].numerical_error.shortest, b.outputs[j].numerical_error.shortest);
        EXPECT_EQ(a.outputs[j].numerical_error.standard_uncertainty, b.outputs[j].numerical_error.standard_uncertainty);
    }
    ASSERT_EQ(a.regions.has_value(), b.regions.has_value());
    if (a.regions) {
        EXPECT_EQ(a.regions->ellipsoid_factor, b.regions->ellipsoid_factor);
        EXPECT_EQ(a.regions->parallelepiped_factor, b.regions->parallelepiped_factor);
        EXPECT_EQ(a.regions->smallest_volume, b.regions->smallest_volume);
        EXPECT_EQ(a.regions->smallest_probability, b.regions->smallest_probability);
    }
}

/// Within five numerical standard uncertainties, which must be of a sensible size themselves.
void expect_output(const MonteCarloOutput& output, double mean, double u, double low, double high) {
    const NumericalError& error = output.numerical_error;
    EXPECT_NEAR(output.mean, mean, 5.0 * error.mean);
    EXPECT_NEAR(output.standard_uncertainty, u, 5.0 * error.standard_uncertainty);
    EXPECT_NEAR(output.symmetric.low, low, 5.0 * error.symmetric.low);
    EXPECT_NEAR(output.symmetric.high, high, 5.0 * error.symmetric.high);
    EXPECT_GT(error.mean, 0.0);
    EXPECT_GT(error.symmetric.low, 0.0);
    EXPECT_LT(error.symmetric.low, 0.05 * u);
    EXPECT_LT(error.symmetric.high, 0.05 * u);
}

// JCGM 101:2008, 9.2.2, table 2: four standard normal inputs.
TEST(MonteCarlo, AdditiveNormal) {
    const MonteCarloResult result =
        run_monte_carlo(sum_model(std::vector(4, Distribution::normal(0.0, 1.0))), options(500'000));
    expect_output(result.outputs[0], 0.0, 2.0, -3.91992797, 3.91992797);
    const MonteCarloOutput& output = result.outputs[0];
    EXPECT_NEAR(output.numerical_error.mean, 2.0 / std::sqrt(5e5), 1e-5);
    EXPECT_NEAR(output.numerical_error.standard_uncertainty, 2.0 / std::sqrt(1e6), 2e-5);
    EXPECT_NEAR(output.shortest.low, -3.91992797, 5.0 * output.numerical_error.shortest.low);
    EXPECT_NEAR(output.shortest.high, 3.91992797, 5.0 * output.numerical_error.shortest.high);
    EXPECT_LE(output.shortest.high - output.shortest.low, output.symmetric.high - output.symmetric.low);
    EXPECT_LT(output.numerical_error.shortest.low, 0.1);
    EXPECT_FALSE(result.regions.has_value());
    EXPECT_NEAR(result.covariance(0, 0), 4.0, 0.1);
}

// JCGM 101:2008, 9.2.3, table 3: four rectangular inputs, [-3.88, 3.88]; exactly 2√3 (2 - (3/5)^(1/4)).
TEST(MonteCarlo, AdditiveRectangular) {
    const MonteCarloResult result =
        run_monte_carlo(sum_model(std::vector(4, Distribution::uniform(0.0, std::numbers::sqrt3))), options(500'000));
    expect_output(result.outputs[0], 0.0, 2.0, -3.87940674134782, 3.87940674134782);
}

// JCGM 101:2008, 9.2.4: one input much wider than the others; the output is close to it.
TEST(MonteCarlo, OneDominantRectangle) {
    std::vector<Distribution> inputs(3, Distribution::uniform(0.0, std::numbers::sqrt3));
    inputs.push_back(Distribution::uniform(0.0, 10.0 * std::numbers::sqrt3));
    const MonteCarloOutput output = run_monte_carlo(sum_model(inputs), options(500'000)).outputs[0];
    EXPECT_NEAR(output.standard_uncertainty, std::sqrt(103.0), 5.0 * output.numerical_error.standard_uncertainty);
    EXPECT_NEAR(output.symmetric.high, 17.0, 0.2);  // published [-17.0, 17.0]
    EXPECT_NEAR(output.shortest.high, 17.0, 0.2);
}

// JCGM 101:2008, 9.3: mass calibration; Monte Carlo by an independent program: u 0.07552 mg, symmetric
// [1.0844, 1.3836].
TEST(MonteCarlo, MassCalibration) {
    const TrialModel mass = model(
        {Distribution::normal(100000.0, 0.05), Distribution::normal(1.234, 0.02), Distribution::uniform(1.2, 0.1),
         Distribution::uniform(8000.0, 1000.0), Distribution::uniform(8000.0, 50.0)},
        1, [](const Columns& columns, Eigen::Ref<Eigen::MatrixXd> y) {
            const auto x = columns.array();
            y.col(0) = (x.col(0) + x.col(1)) * (1.0 + (x.col(2) - 1.2) * (1.0 / x.col(3) - 1.0 / x.col(4))) - 100000.0;
        });
    const MonteCarloOutput output = run_monte_carlo(mass, options(1'000'000)).outputs[0];
    EXPECT_NEAR(output.mean, 1.2341, 0.0004);
    EXPECT_NEAR(output.standard_uncertainty, 0.075517722497635, 0.00025);
    EXPECT_NEAR(output.symmetric.low, 1.08442052050596, 0.001);
    EXPECT_NEAR(output.symmetric.high, 1.38356846857314, 0.001);
    EXPECT_NEAR(output.shortest.low, 1.0834, 0.003);  // published [1.0834, 1.3825]
    EXPECT_NEAR(output.shortest.high, 1.3825, 0.003);

    // Table 6: the law of propagation of first order is not validated, that with terms of higher order is.
    const Validation first =
        validate(1.234, 0.0539, 1.96 * 0.0539, output.symmetric, output.numerical_error.symmetric, 1);
    EXPECT_EQ(first.tolerance, 0.005);
    EXPECT_NEAR(first.distance_low, 0.0451, 0.002);
    EXPECT_NEAR(first.distance_high, 0.0430, 0.002);
    EXPECT_FALSE(first.validated);
    EXPECT_TRUE(first.precise_enough);
    const Validation second =
        validate(1.234, 0.0750, 1.96 * 0.0750, output.symmetric, output.numerical_error.symmetric, 1);
    EXPECT_TRUE(second.validated);
}

// JCGM 101:2008, 9.4.2: X1² + X2² about 0; the law of propagation of first order gives u = 0 there. The square of a
// normal deviate pair is exponential with mean 2u²: shortest interval from 0 to -2u² ln 0.05, mean and u 2u² = 50e-6.
TEST(MonteCarlo, MicrowavePowerAtZero) {
    TrialModel power = model({}, 1, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
        y.col(0) = x.col(0).array().square() + x.col(1).array().square();
    });
    power.groups = {normal_pair(0.0, 0.0, 0.005, 0.0)};
    const MonteCarloOutput output = run_monte_carlo(power, options(500'000)).outputs[0];
    EXPECT_NEAR(output.mean, 50e-6, 5.0 * output.numerical_error.mean);
    EXPECT_NEAR(output.standard_uncertainty, 50e-6, 5.0 * output.numerical_error.standard_uncertainty);
    EXPECT_NEAR(output.shortest.low, 0.0, 1e-8);
    EXPECT_NEAR(output.shortest.high, 149.786613677699e-6, 5.0 * output.numerical_error.shortest.high);
    EXPECT_LT(output.numerical_error.shortest.high, 2e-6);
    EXPECT_NEAR(output.symmetric.low, -50e-6 * std::log(0.975), 5.0 * output.numerical_error.symmetric.low);
    EXPECT_NEAR(output.symmetric.high, -50e-6 * std::log(0.025), 5.0 * output.numerical_error.symmetric.high);
}

// JCGM 101:2008, 9.4.3: correlated inputs, u² = 4x1²u² + 4u⁴(1 + r²).
TEST(MonteCarlo, MicrowavePowerCorrelated) {
    TrialModel power = model({}, 1, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
        y.col(0) = x.col(0).array().square() + x.col(1).array().square();
    });
    power.groups = {normal_pair(0.01, 0.0, 0.005, 0.9)};
    const MonteCarloOutput output = run_monte_carlo(power, options(500'000)).outputs[0];
    EXPECT_NEAR(output.mean, 150e-6, 5.0 * output.numerical_error.mean);
    EXPECT_NEAR(output.standard_uncertainty, 120.519707931939e-6, 5.0 * output.numerical_error.standard_uncertainty);
    EXPECT_NEAR(output.shortest.low, 12.6352730694449e-6, 3.85e-6);
    EXPECT_NEAR(output.shortest.high, 397.266917539981e-6, 3.85e-6);
}

// JCGM 101:2008, 9.5, table 11: 838 nm, 36 nm, shortest 99 % interval [745, 932] nm. Programs that scale the t
// distribution to the stated u, or draw with the total uncertainty, get 34.3 nm.
TEST(MonteCarlo, GaugeBlock) {
    const MonteCarloOutput output = run_monte_carlo(gauge_block(), options(1'000'000, 0.99)).outputs[0];
    EXPECT_TRUE(test::prints_as(output.mean, "838"));
    EXPECT_TRUE(test::prints_as(output.standard_uncertainty, "36"));
    EXPECT_NEAR(output.standard_uncertainty, 35.8128932409629, 0.15);
    EXPECT_NEAR(output.shortest.low, 745.0, 1.5);
    EXPECT_NEAR(output.shortest.high, 932.0, 1.5);
}

// Readings 9.9, 10.0, 10.1, 10.0: s/√n with 3 degrees of freedom. Another program draws them as normal (99 % half-width
// 0.105 instead of 0.238), and counts the total twice when a Type B contribution u = 1 is added (1.414 instead
// of 1.00).
TEST(MonteCarlo, ReadingsAreStudentT) {
    const double s = std::sqrt(0.02 / 3.0 / 4.0);
    const Distribution readings = Distribution::student_t(10.0, s, 3.0);
    const MonteCarloOutput alone = run_monte_carlo(sum_model({readings}), options(1'000'000, 0.99)).outputs[0];
    EXPECT_NEAR(alone.symmetric.high - 10.0, 0.23845, 5.0 * alone.numerical_error.symmetric.high);
    EXPECT_NEAR(10.0 - alone.symmetric.low, 0.23845, 5.0 * alone.numerical_error.symmetric.low);
    const MonteCarloOutput both =
        run_monte_carlo(sum_model({readings, Distribution::normal(0.0, 1.0)}), options(500'000)).outputs[0];
    EXPECT_NEAR(both.standard_uncertainty, std::sqrt(1.0 + 3.0 * s * s),
                5.0 * both.numerical_error.standard_uncertainty);
}

// x² at 0: other programs report u = 0 without a word.
TEST(MonteCarlo, SquareAtZero) {
    const TrialModel square =
        model({Distribution::normal(0.0, 1.0)}, 1,
              [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) { y.col(0) = x.col(0).array().square(); });
    const MonteCarloOutput output = run_monte_carlo(square, options(500'000)).outputs[0];
    EXPECT_NEAR(output.mean, 1.0, 5.0 * output.numerical_error.mean);
    EXPECT_NEAR(output.standard_uncertainty, std::numbers::sqrt2, 5.0 * output.numerical_error.standard_uncertainty);
    const Validation validation = validate(0.0, 1.41, 0.0, output.symmetric, output.numerical_error.symmetric, 2);
    EXPECT_TRUE(std::isfinite(validation.tolerance));
    EXPECT_FALSE(validation.validated);
}

// Wübbeler, Krystek and Elster (2008): modulus of a normal pair, Rice distribution.
TEST(MonteCarlo, RiceDistribution) {
    TrialModel modulus =
        model({}, 1, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) { y.col(0) = x.rowwise().norm(); });
    modulus.groups = {normal_pair(1.0, 1.0, 1.0, 0.0)};
    const MonteCarloOutput output = run_monte_carlo(modulus, options(500'000)).outputs[0];
    EXPECT_NEAR(output.mean, 1.81290805104394, 5.0 * output.numerical_error.mean);
    EXPECT_NEAR(output.standard_uncertainty, 0.844609021062448, 5.0 * output.numerical_error.standard_uncertainty);
}

// JCGM 102:2011, 9.3: Cartesian to polar; means and u by an independent program with many trials.
TEST(MonteCarlo, PolarCoordinates) {
    struct Case {
        double x1, r, mean1, u1, u2, correlation;
    };
    for (const Case& c : {Case{0.001, 0.0, 0.0125626934, 0.0065665398, 1.7438337, 0.0},
                          Case{0.01, 0.0, 0.0154854662, 0.0077558104, 1.1173274, 0.0},
                          Case{0.1, 0.0, 0.1005019519, 0.0099712278, 0.1005195, 0.0},
                          Case{0.1, 0.9, 0.1005092576, 0.0098931360, 0.1023562, 0.8819268}}) {
        const MonteCarloResult result = run_monte_carlo(polar(c.x1, 0.0, c.r), options(300'000));
        EXPECT_NEAR(result.outputs[0].mean, c.mean1, 6e-5 + 5e-5);
        EXPECT_NEAR(result.outputs[0].standard_uncertainty, c.u1, 9e-5);
        EXPECT_NEAR(result.outputs[1].standard_uncertainty, c.u2, 0.012);
        const double r = result.covariance(0, 1) / std::sqrt(result.covariance(0, 0) * result.covariance(1, 1));
        EXPECT_NEAR(r, c.correlation, 0.01);
        EXPECT_EQ(result.covariance, result.covariance.transpose());
    }
}

// JCGM 102:2011, 9.2.2: Y1 = X1 + X3, Y2 = X2 + X3; k_p = 2.45, k_q = 2.21, ellipse of area 32.6.
TEST(MonteCarlo, RegionsOfTwoOutputs) {
    const TrialModel two =
        model(std::vector(3, Distribution::normal(0.0, 1.0)), 2, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
            y.col(0) = x.col(0) + x.col(2);
            y.col(1) = x.col(1) + x.col(2);
        });
    const MonteCarloResult result = run_monte_carlo(two, options(500'000));
    EXPECT_NEAR(result.covariance(0, 0), 2.0, 0.02);
    EXPECT_NEAR(result.covariance(1, 0), 1.0, 0.02);
    ASSERT_TRUE(result.regions.has_value());
    EXPECT_NEAR(result.regions->ellipsoid_factor.value(), 2.447747, 0.01);
    EXPECT_NEAR(result.regions->parallelepiped_factor, 2.2113, 0.01);
    EXPECT_GE(result.regions->smallest_probability, 0.95);
    EXPECT_LT(result.regions->smallest_probability, 0.9502);
    // Of a normal distribution the ellipse is the smallest region: cells cannot be much better, and not much worse.
    EXPECT_NEAR(result.regions->smallest_volume, 32.6019437591289, 1.0);
    EXPECT_EQ(result.regions->cells_per_axis.size(), 2U);
}

TEST(MonteCarlo, RegionsOfThreeOutputs) {
    const TrialModel three = model(std::vector(3, Distribution::normal(0.0, 1.0)), 3,
                                   [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) { y = x; });
    const MonteCarloResult result = run_monte_carlo(three, options(500'000));
    EXPECT_NEAR(result.regions->ellipsoid_factor.value(), 2.7955, 0.01);  // JCGM 102:2011, 6.5.2: 2.80
    EXPECT_NEAR(result.regions->parallelepiped_factor, 2.3877, 0.01);
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(2.7955, 3.0);
    EXPECT_NEAR(result.regions->smallest_volume, volume, 0.1 * volume);
}

TEST(MonteCarlo, DependentOutputsHaveNoEllipsoid) {
    const TrialModel dependent =
        model({Distribution::normal(0.0, 1.0)}, 2, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
            y.col(0) = x.col(0);
            y.col(1) = -2.0 * x.col(0);
        });
    const MonteCarloResult result = run_monte_carlo(dependent, options(20'000));
    EXPECT_FALSE(result.regions->ellipsoid_factor.has_value());
    EXPECT_NE(result.regions->no_ellipsoid_because, "");
    EXPECT_NEAR(result.regions->parallelepiped_factor, 1.96, 0.05);
    MonteCarloOptions without = options(20'000);
    without.regions = false;
    EXPECT_FALSE(run_monte_carlo(dependent, without).regions.has_value());
}

// Many outputs take the matrix product instead of loops.
TEST(MonteCarlo, CovarianceOfManyOutputs) {
    const TrialModel many =
        model(std::vector(2, Distribution::normal(0.0, 1.0)), 40, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
            for (Eigen::Index j = 0; j < 40; ++j) {
                y.col(j) = x.col(j % 2) * static_cast<double>(j + 1);
            }
        });
    MonteCarloOptions o = options(30'000);
    o.regions = false;
    const MonteCarloResult result = run_monte_carlo(many, o);
    EXPECT_NEAR(result.covariance(2, 0), 3.0 * result.covariance(0, 0), 1e-11);
    EXPECT_NEAR(result.covariance(39, 39), 40.0 * 40.0 * result.covariance(1, 1) / 4.0, 1e-8);
    EXPECT_NEAR(result.covariance(1, 0) / 2.0, 0.0, 0.05);
    o.threads = 3;
    expect_same(run_monte_carlo(many, o), result);
}

TEST(MonteCarlo, SameBytesForAnyNumberOfThreads) {
    const TrialModel gauge = gauge_block();
    const TrialModel two = polar(0.01, 0.0, 0.5);
    for (const TrialModel* tested : {&gauge, &two}) {
        MonteCarloOptions o = options(150'001);
        o.threads = 1;
        const MonteCarloResult one = run_monte_carlo(*tested, o);
        expect_same(run_monte_carlo(*tested, o), one);
        for (const unsigned threads : {2U, 3U}) {
            o.threads = threads;
            expect_same(run_monte_carlo(*tested, o), one);
        }
        o.adaptive = AdaptiveTrials{.digits = 1, .most_trials = 200'000};
        o.threads = 1;
        const MonteCarloResult adaptive = run_monte_carlo(*tested, o);
        o.threads = 3;
        expect_same(run_monte_carlo(*tested, o), adaptive);
    }
}

// Kept values, values drawn again, and bins divided once more: the same order statistics.
TEST(MonteCarlo, DrawingAgainGivesTheSameResult) {
    const TrialModel gauge = gauge_block();
    const TrialModel two = polar(0.01, 0.0, 0.5);
    const TrialModel flat = sum_model({Distribution::uniform(0.0, 1.0)});
    const TrialModel heavy = sum_model({Distribution::student_t(0.0, 1.0, 1.0)});
    for (const TrialModel* tested : {&gauge, &two, &flat, &heavy}) {
        MonteCarloOptions o = options(200'000);
        const MonteCarloResult kept = run_monte_carlo(*tested, o);
        o.memory.kept_trials = 10'000;
        expect_same(run_monte_carlo(*tested, o), kept);
    }
    for (const TrialModel* tested : {&gauge, &two, &heavy}) {
        MonteCarloOptions o = options(200'000);
        const MonteCarloResult kept = run_monte_carlo(*tested, o);
        o.memory.kept_trials = 10'000;
        o.memory.collected_values = 4'000;
        expect_same(run_monte_carlo(*tested, o), kept);
    }
}

// With too little memory for exact ends, what is not known is part of the error.
TEST(MonteCarlo, EndsToTheResolutionOfTheBins) {
    const TrialModel flat = sum_model({Distribution::uniform(0.0, 1.0)});
    MonteCarloOptions o = options(200'000);
    o.memory.kept_trials = 10'000;
    o.memory.collected_values = 100;
    const MonteCarloOutput output = run_monte_carlo(flat, o).outputs[0];
    EXPECT_NEAR(output.symmetric.low, -0.95, 5.0 * output.numerical_error.symmetric.low);
    EXPECT_NEAR(output.shortest.high - output.shortest.low, 1.9, 0.01);
}

TEST(MonteCarlo, ConstantAndDiscreteOutputs) {
    const MonteCarloOutput constant =
        run_monte_carlo(sum_model({Distribution::constant(3.0)}), options(10'000)).outputs[0];
    EXPECT_EQ(constant.mean, 3.0);
    EXPECT_EQ(constant.standard_uncertainty, 0.0);
    EXPECT_EQ(constant.symmetric, (CoverageInterval{3.0, 3.0}));
    EXPECT_EQ(constant.shortest, (CoverageInterval{3.0, 3.0}));
    EXPECT_EQ(constant.numerical_error.symmetric, (CoverageInterval{0.0, 0.0}));

    // A display that shows whole numbers only: huge numbers of equal values, kept or not.
    const TrialModel discrete =
        model({Distribution::normal(100.0, 0.4)}, 1,
              [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) { y.col(0) = x.col(0).array().round(); });
    MonteCarloOptions o = options(100'000);
    const MonteCarloOutput kept = run_monte_carlo(discrete, o).outputs[0];
    EXPECT_EQ(kept.symmetric, (CoverageInterval{99.0, 101.0}));
    o.memory.kept_trials = 1'000;
    o.memory.collected_values = 1'000;
    const MonteCarloOutput drawn_again = run_monte_carlo(discrete, o).outputs[0];
    EXPECT_NEAR(drawn_again.symmetric.low, 99.0, 1e-3);
    EXPECT_NEAR(drawn_again.symmetric.high, 101.0, 1e-3);
}

TEST(MonteCarlo, HeavyTailsGiveHonestErrors) {
    const MonteCarloOutput output =
        run_monte_carlo(sum_model({Distribution::student_t(0.0, 1.0, 1.0)}), options(300'000)).outputs[0];
    EXPECT_NEAR(output.symmetric.high, 12.7062, 5.0 * output.numerical_error.symmetric.high);
    EXPECT_LT(output.numerical_error.symmetric.high, 0.5);
    EXPECT_TRUE(std::isfinite(output.numerical_error.standard_uncertainty));
    EXPECT_GT(output.numerical_error.standard_uncertainty, 0.1 * output.standard_uncertainty);
    EXPECT_LE(output.numerical_error.standard_uncertainty, output.standard_uncertainty);
}

TEST(MonteCarlo, FewTrials) {
    for (const std::uint64_t trials : std::vector<std::uint64_t>{1, 2, 3, 10, 100}) {
        const MonteCarloOutput output =
            run_monte_carlo(sum_model({Distribution::normal(0.0, 1.0)}), options(trials)).outputs[0];
        EXPECT_LE(output.symmetric.low, output.symmetric.high);
        EXPECT_LE(output.shortest.low, output.shortest.high);
        EXPECT_TRUE(std::isfinite(output.standard_uncertainty));
    }
}

// The numerical errors describe how results scatter from seed to seed.
TEST(MonteCarlo, NumericalErrorsOverSeeds) {
    const TrialModel sum = sum_model({Distribution::normal(0.0, 1.0), Distribution::uniform(0.0, 1.0)});
    Moments mean;
    Moments u;
    Moments low;
    Moments shortest;
    MonteCarloOutput output;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        MonteCarloOptions o = options(20'000);
        o.seed = seed;
        output = run_monte_carlo(sum, o).outputs[0];
        mean.merge(moments_of(&output.mean, 1));
        u.merge(moments_of(&output.standard_uncertainty, 1));
        low.merge(moments_of(&output.symmetric.low, 1));
        shortest.merge(moments_of(&output.shortest.low, 1));
    }
    const NumericalError& error = output.numerical_error;
    EXPECT_NEAR(error.mean / mean.standard_deviation(), 1.0, 0.4);
    EXPECT_NEAR(error.standard_uncertainty / u.standard_deviation(), 1.0, 0.4);
    EXPECT_NEAR(error.symmetric.low / low.standard_deviation(), 1.0, 0.4);
    EXPECT_GT(error.shortest.low / shortest.standard_deviation(), 0.5);
    EXPECT_LT(error.shortest.low / shortest.standard_deviation(), 2.5);
}

TEST(MonteCarlo, AnyTrialCanBeDrawnAgain) {
    TrialModel gauge = gauge_block();
    gauge.groups.push_back(normal_pair(0.0, 1.0, 2.0, -0.5));
    Eigen::VectorXd seen;
    std::atomic<int> calls = 0;
    const std::uint64_t wanted = 3 * 4096 + 77;
    const Eigen::VectorXd replayed = monte_carlo_trial(gauge, 5, wanted);
    ASSERT_EQ(replayed.size(), 11);
    const auto function = gauge.function;
    gauge.function = [&](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
        for (Eigen::Index i = 0; i < x.rows(); ++i) {
            if (x.row(i).transpose() == replayed) {
                ++calls;
            }
        }
        function(x, y);
    };
    MonteCarloOptions o = options(20'000);
    o.seed = 5;
    static_cast<void>(run_monte_carlo(gauge, o));
    EXPECT_EQ(calls, 1);
}

// Two sequences may agree by chance; what a run calls stable has numerical errors that allow it.
TEST(MonteCarlo, AdaptiveDoesNotBelieveAnAgreementByChance) {
    // 97.7 % of the trials about 50, the others about 100: the upper end of the interval lies between the clusters.
    const TrialModel gap = model({Distribution::uniform(0.5, 0.5), Distribution::normal(0.0, 1.0)}, 1,
                                 [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
                                     for (Eigen::Index r = 0; r < x.rows(); ++r) {
                                         y(r, 0) = (x(r, 0) < 0.9772 ? 50.0 : 100.0) + x(r, 1);
                                     }
                                 });
    int stable = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        MonteCarloOptions o = options(1);
        o.seed = seed;
        o.adaptive = AdaptiveTrials{.digits = 2, .most_trials = 400'000};
        const MonteCarloResult result = run_monte_carlo(gap, o);
        const NumericalError& error = result.outputs[0].numerical_error;
        const double largest =
            std::max({error.mean, error.standard_uncertainty, error.symmetric.low, error.symmetric.high});
        stable += result.stabilised ? 1 : 0;
        EXPECT_TRUE(!result.stabilised || largest <= result.tolerance[0]) << seed;
    }
    EXPECT_LT(stable, 12);
}

// The adaptive run is the fixed run with the number of trials at which it stops.
TEST(MonteCarlo, AdaptiveStopsWhenStable) {
    const TrialModel sum = sum_model(std::vector(4, Distribution::normal(0.0, 1.0)));
    MonteCarloOptions o = options(1);
    o.adaptive = AdaptiveTrials{.digits = 2, .most_trials = 10'000'000};
    const MonteCarloResult adaptive = run_monte_carlo(sum, o);
    EXPECT_TRUE(adaptive.stabilised);
    ASSERT_EQ(adaptive.tolerance.size(), 1U);
    // u is near 2.0 or 1.9: δ = 0.05 either way.
    EXPECT_EQ(adaptive.tolerance[0], 0.05);
    EXPECT_EQ(adaptive.trials % 10'000, 0U);
    EXPECT_GE(adaptive.trials, 20'000U);
    EXPECT_NEAR(adaptive.outputs[0].symmetric.high, 3.92, 0.1);

    MonteCarloOptions fixed = options(adaptive.trials);
    MonteCarloResult again = run_monte_carlo(sum, fixed);
    again.tolerance = adaptive.tolerance;
    expect_same(adaptive, again);

    o.adaptive->tolerance_divisor = 5.0;
    EXPECT_GT(run_monte_carlo(sum, o).trials, adaptive.trials);
}

TEST(MonteCarlo, AdaptiveThatDoesNotSettle) {
    MonteCarloOptions o = options(1);
    o.adaptive = AdaptiveTrials{.digits = 2, .most_trials = 55'000};
    const MonteCarloResult result = run_monte_carlo(sum_model({Distribution::student_t(0.0, 1.0, 1.5)}), o);
    EXPECT_FALSE(result.stabilised);
    EXPECT_EQ(result.trials, 50'000U);
    // Several outputs, one of them constant.
    o.adaptive = AdaptiveTrials{.digits = 1, .most_trials = 1'000'000};
    const TrialModel two =
        model({Distribution::normal(0.0, 1.0)}, 2, [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
            y.col(0) = x.col(0);
            y.col(1).setConstant(2.0);
        });
    EXPECT_TRUE(run_monte_carlo(two, o).stabilised);
}

// One output stands still, the other has no variance (t, ν = 1.5): each has its own verdict, and with what is known of the
// second one the run ends when its ends do.
TEST(MonteCarlo, AdaptiveStabilisesEachOutput) {
    const TrialModel two = model({Distribution::normal(0.0, 1.0), Distribution::student_t(0.0, 1.0, 1.5)}, 2,
                                 [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) { y = x; });
    MonteCarloOptions o = options(1);
    o.adaptive = AdaptiveTrials{.digits = 2, .most_trials = 3'000'000};
    const MonteCarloResult waits = run_monte_carlo(two, o);
    EXPECT_FALSE(waits.stabilised);
    EXPECT_TRUE(waits.outputs[0].stabilised);
    EXPECT_FALSE(waits.outputs[1].stabilised);
    EXPECT_FALSE(waits.outputs[1].without_variance);

    std::vector<std::pair<Eigen::Index, std::uint64_t>> asked;
    o.has_no_variance = [&](Eigen::Index output, std::uint64_t trials) {
        asked.emplace_back(output, trials);
        return output == 1;
    };
    const MonteCarloResult ends = run_monte_carlo(two, o);
    EXPECT_TRUE(ends.stabilised);
    EXPECT_TRUE(ends.outputs[1].stabilised && ends.outputs[1].without_variance);
    EXPECT_LT(ends.trials, waits.trials);
    ASSERT_FALSE(asked.empty());
    EXPECT_EQ(asked.back(), std::make_pair(Eigen::Index{1}, std::uint64_t{1'000'000}));
    // A quarter of the width stands for u in the tolerance of the ends.
    const MonteCarloOutput& heavy = ends.outputs[1];
    const double quarter = 0.25 * (heavy.symmetric.high - heavy.symmetric.low);
    EXPECT_EQ(ends.tolerance[1], numerical_tolerance(quarter, 2));
    EXPECT_LE(heavy.numerical_error.symmetric.high, ends.tolerance[1]);
}

// Sequences are max(J, 10^4) trials long, J the smallest integer not below 100/(1 - p) (JCGM 101:2008, 7.9.4).
TEST(MonteCarlo, LengthOfTheSequences) {
    const TrialModel sum = sum_model({Distribution::uniform(0.0, 1.0)});
    MonteCarloOptions o = options(1, 0.999);
    o.adaptive = AdaptiveTrials{.digits = 1, .most_trials = 1'000'000};
    EXPECT_EQ(run_monte_carlo(sum, o).trials % 100'000, 0U);
    o.adaptive->most_trials = 150'000;
    EXPECT_EQ(code_of<InputError>([&] { static_cast<void>(run_monte_carlo(sum, o)); }), "GC-GUM-0126");
}

TEST(MonteCarlo, NonFiniteTrialsStopTheRun) {
    const TrialModel logarithm =
        model({Distribution::normal(4.0, 1.0)}, 1,
              [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) { y.col(0) = x.col(0).array().log(); });
    std::string first;
    for (const unsigned threads : {1U, 2U, 3U}) {
        MonteCarloOptions o = options(1'000'000);
        o.threads = threads;
        EXPECT_EQ(code_of<NoResultError>([&] { static_cast<void>(run_monte_carlo(logarithm, o)); }), "GC-GUM-0120");
        const std::string message =
            message_of<NoResultError>([&] { static_cast<void>(run_monte_carlo(logarithm, o)); });
        first = first.empty() ? message : first;
        EXPECT_EQ(message, first);
        EXPECT_NE(message.find("x1 = -"), std::string::npos) << message;
    }
    // The trial that the message names is one without a value.
    const std::size_t at = first.find("trial ") + 6;
    std::uint64_t trial = 0;
    std::from_chars(first.data() + at, first.data() + first.size(), trial);
    EXPECT_LT(monte_carlo_trial(logarithm, 1, trial)(0), 0.0) << first;

    MonteCarloOptions adaptive = options(1);
    adaptive.adaptive = AdaptiveTrials{};
    EXPECT_EQ(code_of<NoResultError>([&] { static_cast<void>(run_monte_carlo(logarithm, adaptive)); }), "GC-GUM-0120");
}

TEST(MonteCarlo, RefusesNumbersOfTrials) {
    const TrialModel sum = sum_model({Distribution::normal(0.0, 1.0)});
    for (const std::uint64_t trials : {std::uint64_t{0}, std::uint64_t{10'000'000'001}}) {
        EXPECT_EQ(code_of<InputError>([&] { static_cast<void>(run_monte_carlo(sum, options(trials))); }),
                  "GC-GUM-0121");
    }
    EXPECT_EQ(code_of<InputError>([&] { static_cast<void>(run_monte_carlo(sum, options(10, 1.0))); }), "GC-GUM-0004");
    MonteCarloOptions digits = options(1);
    digits.adaptive = AdaptiveTrials{.digits = 3};
    EXPECT_EQ(code_of<InputError>([&] { static_cast<void>(run_monte_carlo(sum, digits)); }), "GC-GUM-0126");
}

TEST(MonteCarlo, ExceptionsOfTheModelReachTheCaller) {
    TrialModel broken = sum_model({Distribution::normal(0.0, 1.0)});
    broken.function = [](const Columns& x, Eigen::Ref<Eigen::MatrixXd> y) {
        if (x.rows() > 100) {
            throw std::runtime_error("no");
        }
        y.setZero();
    };
    EXPECT_THROW(static_cast<void>(run_monte_carlo(broken, options(100'000))), std::runtime_error);
}

TEST(MonteCarlo, ReportsProgress) {
    std::vector<double> fractions;
    MonteCarloOptions o = options(1'000'000);
    o.progress = [&](double fraction) { fractions.push_back(fraction); };
    static_cast<void>(run_monte_carlo(sum_model({Distribution::normal(0.0, 1.0)}), o));
    ASSERT_GE(fractions.size(), 2U);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1.0);
}

// JCGM 101:2008, 7.9.2, with its examples 0.00035 and 2.
TEST(MonteCarlo, NumericalTolerance) {
    EXPECT_EQ(numerical_tolerance(0.00035, 2), 5e-6);
    EXPECT_EQ(numerical_tolerance(2.0, 1), 0.5);
    EXPECT_EQ(numerical_tolerance(0.0754, 1), 0.005);
    EXPECT_EQ(numerical_tolerance(0.0754, 2), 0.0005);
    EXPECT_EQ(numerical_tolerance(36.0, 2), 0.5);
    EXPECT_EQ(numerical_tolerance(0.000195, 2), 5e-6);
    EXPECT_EQ(numerical_tolerance(0.999, 2), 0.005);
    EXPECT_EQ(numerical_tolerance(9.999999999999998, 2), 0.5);  // 10
    EXPECT_EQ(numerical_tolerance(1000.0, 1), 500.0);
    EXPECT_EQ(numerical_tolerance(1e-7, 2), 5e-9);
    EXPECT_EQ(code_of<InputError>([] { static_cast<void>(numerical_tolerance(0.0, 2)); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { static_cast<void>(numerical_tolerance(1.0, 0)); }), "GC-GUM-0126");
}

TEST(MonteCarlo, ValidationOfTheLawOfPropagation) {
    const Validation good = validate(10.0, 1.0, 2.0, {.low = 8.04, .high = 12.05}, {.low = 0.005, .high = 0.005}, 2);
    EXPECT_EQ(good.tolerance, 0.05);
    EXPECT_NEAR(good.distance_low, 0.04, 1e-12);
    EXPECT_TRUE(good.precise_enough);
    const Validation bad = validate(10.0, 1.0, 2.0, {.low = 8.06, .high = 12.0}, {.low = 0.02, .high = 0.005}, 2);
    EXPECT_FALSE(bad.validated);
    EXPECT_FALSE(bad.precise_enough);
    EXPECT_EQ(bad.numerical_limit, 0.01);
}

}  // namespace
}  // namespace gumcert::gum
