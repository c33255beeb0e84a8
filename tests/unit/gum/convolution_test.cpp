#include "gum/convolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::prints_as;

const double k_root_3 = std::sqrt(3.0);

TEST(ConvolutionHalfWidth, RectangularAndNormal) {
    // Factors k(95.45 %) against the ratio of normal to rectangular standard uncertainty, computed by Simpson
    // integration of the closed-form distribution function in an independent program.
    struct Case {
        double ratio;
        const char* k;
    };
    for (const Case& c : std::vector<Case>{{0.05, "1.652"},
                                           {0.1, "1.661"},
                                           {0.2, "1.700"},
                                           {0.3, "1.748"},
                                           {0.4, "1.795"},
                                           {0.5, "1.836"},
                                           {0.7, "1.899"},
                                           {1.0, "1.952"},
                                           {2.0, "1.995"}}) {
        const std::vector<ConvolutionTerm> terms{{1.0, Distribution::uniform(5.0, k_root_3)},
                                                 {-2.0, Distribution::normal(1.0, 0.5 * c.ratio)}};
        EXPECT_TRUE(prints_as(convolution_half_width(terms, 0.9545) / std::hypot(1.0, c.ratio), c.k)) << c.ratio;
    }
}

TEST(ConvolutionHalfWidth, SingleDistributions) {
    const auto k = [](const Distribution& distribution, double p) {
        return convolution_half_width(std::vector<ConvolutionTerm>{{1.0, distribution}}, p) /
               standard_deviation(distribution);
    };
    const Distribution rectangular = Distribution::uniform(0.0, 1e-9);
    EXPECT_TRUE(prints_as(k(rectangular, 0.9545), "1.6532"));
    EXPECT_TRUE(prints_as(k(rectangular, 0.95), "1.6454"));
    const Distribution triangular{.kind = DistributionKind::triangular, .location = 3.0, .scale = 2.0};
    EXPECT_TRUE(prints_as(k(triangular, 0.9545), "1.927"));
    EXPECT_TRUE(prints_as(k(triangular, 0.95), "1.902"));
    const Distribution arcsine{.kind = DistributionKind::arcsine, .location = 3.0, .scale = 2.0};
    EXPECT_TRUE(prints_as(k(arcsine, 0.9545), "1.411"));
    EXPECT_TRUE(agrees(k(Distribution::normal(0.0, 1.0), 0.95), 1.959963984540054, 1e-6));
    const Distribution student = Distribution::student_t(0.0, 1.0, 5.0);
    EXPECT_TRUE(agrees(convolution_half_width(std::vector<ConvolutionTerm>{{1.0, student}}, 0.95),
                       coverage_factor(0.95, 5.0), 2e-6));
    // Symmetric trapezoid, EA-4/02 M, S10.13: k = (1 − √((1 − p)(1 − β²))) / √((1 + β²)/6).
    for (const double beta : {0.0, 1.0 / 3.0, 0.7}) {
        const Distribution trapezoid{
            .kind = DistributionKind::trapezoidal, .location = 0.0, .scale = 1.0, .shape = beta};
        const double expected = (1.0 - std::sqrt(0.05 * (1.0 - beta * beta))) / std::sqrt((1.0 + beta * beta) / 6.0);
        EXPECT_TRUE(agrees(k(trapezoid, 0.95), expected, 2e-6)) << beta;
    }
    const Distribution beta{
        .kind = DistributionKind::beta, .location = 7.0, .scale = 2.0, .shape = 1.0, .second_shape = 1.0};
    EXPECT_TRUE(agrees(k(beta, 0.95), 0.95 * k_root_3, 2e-6));
}

TEST(ConvolutionHalfWidth, SumsOfBoundedDistributions) {
    // Two rectangular ones of equal width make a triangle; of unequal width a trapezoid.
    const std::vector<ConvolutionTerm> equal{{1.0, Distribution::uniform(0.0, 1.0)},
                                             {1.0, Distribution::uniform(0.0, 1.0)}};
    EXPECT_TRUE(agrees(convolution_half_width(equal, 0.95), 2.0 * (1.0 - std::sqrt(0.05)), 2e-6));
    const std::vector<ConvolutionTerm> unequal{{1.0, Distribution::uniform(0.0, 2.0)},
                                               {1.0, Distribution::uniform(0.0, 1.0)}};
    const double beta = 1.0 / 3.0;
    EXPECT_TRUE(
        agrees(convolution_half_width(unequal, 0.95), 3.0 * (1.0 - std::sqrt(0.05 * (1.0 - beta * beta))), 2e-6));
    // JCGM 101:2008, 9.2.3: four rectangular ones of unit standard deviation, 95 % interval ±3.88.
    const std::vector<ConvolutionTerm> four(4, {1.0, Distribution::uniform(0.0, k_root_3)});
    EXPECT_TRUE(prints_as(convolution_half_width(four, 0.95), "3.88"));
}

TEST(ConvolutionHalfWidth, RefusesWhatItCannotAdd) {
    const Distribution skewed{.kind = DistributionKind::exponential, .location = 0.0, .scale = 1.0};
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)convolution_half_width(std::vector<ConvolutionTerm>{{1.0, skewed}}, 0.95);
              }),
              "GC-GUM-0060");
    EXPECT_EQ(code_of<InputError>([] { (void)convolution_half_width({}, 0.95); }), "GC-GUM-0060");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)convolution_half_width(std::vector<ConvolutionTerm>{{1.0, Distribution::uniform(0, 1)}}, 1.5);
              }),
              "GC-GUM-0004");
}

double normal_cdf(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

TEST(ConvolutionDistribution, RectangularAndNormal) {
    // F(x) = s/(2a) [g((x + a)/s) − g((x − a)/s)], g(z) = z Φ(z) + φ(z); the ratios include ones below a cell of a
    // grid.
    const double a = 0.7;
    const auto g = [](double z) {
        return z * normal_cdf(z) + std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::acos(-1.0));
    };
    for (const double s : {1e-7, 1e-5, 1e-3, 0.05, 0.3, 0.7, 2.0, 30.0}) {
        const ConvolutionDistribution distribution(std::vector<ConvolutionTerm>{
            {-1.0, Distribution::uniform(3.0, a)}, {0.5, Distribution::normal(1.0, 2.0 * s)}});
        for (double x = -1.5 * a - 5.0 * s; x < 1.5 * a + 5.0 * s; x += (a + s) / 9.0) {
            EXPECT_NEAR(distribution(x), s / (2.0 * a) * (g((x + a) / s) - g((x - a) / s)), 1e-6) << s << ' ' << x;
        }
        EXPECT_NEAR(distribution(a), s / (2.0 * a) * (g(2.0 * a / s) - g(0.0)), 1e-6) << s;
        EXPECT_NEAR(distribution(0.0), 0.5, 1e-9) << s;
    }
}

TEST(ConvolutionDistribution, KnownSums) {
    // Two rectangular ones: a symmetric trapezoid; four of them: the cubic spline of Irwin and Hall.
    const ConvolutionDistribution two(
        std::vector<ConvolutionTerm>{{1.0, Distribution::uniform(0.0, 2.0)}, {1.0, Distribution::uniform(0.0, 1.0)}});
    EXPECT_NEAR(two(-2.0), 1.0 / 16.0, 1e-6);
    EXPECT_NEAR(two(-1.0), 0.25, 1e-6);
    EXPECT_NEAR(two(2.0), 15.0 / 16.0, 1e-6);
    EXPECT_EQ(two(-3.1), 0.0);
    EXPECT_NEAR(two(3.1), 1.0, 1e-15);
    const ConvolutionDistribution four(std::vector<ConvolutionTerm>(4, {1.0, Distribution::uniform(9.0, 0.5)}));
    EXPECT_NEAR(four(-1.0), 1.0 / 24.0, 1e-6);
    EXPECT_NEAR(four(1.5), 1.0 - 0.0625 / 24.0, 1e-6);
    // A single term, and normal ones: exactly.
    EXPECT_TRUE(agrees(convolution_distribution(std::vector<ConvolutionTerm>{{3.0, Distribution::normal(0.0, 1.0)},
                                                                             {2.0, Distribution::normal(0.0, 2.0)}},
                                                -15.0),
                       normal_cdf(-3.0), 1e-13));
    const Distribution arcsine{.kind = DistributionKind::arcsine, .location = 3.0, .scale = 2.0};
    EXPECT_NEAR(convolution_distribution(std::vector<ConvolutionTerm>{{1.0, arcsine}}, 1.0), 2.0 / 3.0, 1e-14);
}

TEST(ConvolutionDistribution, AgreesWithTheHalfWidth) {
    const Distribution triangular{.kind = DistributionKind::triangular, .location = 3.0, .scale = 2.0};
    const Distribution arcsine{.kind = DistributionKind::arcsine, .location = 0.0, .scale = 1.0};
    const std::vector<ConvolutionTerm> terms{{1.0, triangular},
                                             {2.0, arcsine},
                                             {1.0, Distribution::student_t(0.0, 0.3, 6.0)},
                                             {-0.5, Distribution::uniform(0.0, 2.0)}};
    const ConvolutionDistribution distribution(terms);
    for (const double p : {0.5, 0.9, 0.9545, 0.999}) {
        const double U = convolution_half_width(terms, p);
        EXPECT_NEAR(distribution(U) - distribution(-U), p, 2e-6) << p;
    }
    double last = 0.0;
    for (double x = -8.0; x < 8.0; x += 0.5) {
        EXPECT_GE(distribution(x), last) << x;
        EXPECT_NEAR(distribution(x) + distribution(-x), 1.0, 1e-8) << x;
        last = distribution(x);
    }
}

TEST(ConvolutionDistribution, RefusesWhatItCannotAdd) {
    EXPECT_EQ(code_of<InputError>([] { (void)convolution_distribution({}, 0.0); }), "GC-GUM-0060");
    const Distribution skewed{.kind = DistributionKind::exponential, .location = 0.0, .scale = 1.0};
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)convolution_distribution(std::vector<ConvolutionTerm>{{1.0, skewed}}, 0.0);
              }),
              "GC-GUM-0060");
}

/// y = Σ x_i with one group an input.
class SumModel final : public MeasurementModel {
public:
    explicit SumModel(const std::vector<Distribution>& distributions) {
        for (const Distribution& distribution : distributions) {
            InputGroup group;
            group.name = "x" + std::to_string(groups_.size() + 1);
            group.value = Eigen::VectorXd::Constant(1, distribution.location);
            group.covariance = Eigen::MatrixXd::Constant(1, 1, std::pow(standard_deviation(distribution), 2));
            group.marginals = {distribution};
            groups_.push_back(group);
        }
    }
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return Eigen::VectorXd::Constant(1, x.sum());
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        return Eigen::MatrixXd::Ones(1, x.size());
    }

private:
    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_{{"y", "1"}};
};

std::optional<DominatedOutput> dominated(const std::vector<Distribution>& distributions) {
    const SumModel model(distributions);
    return expand_dominated_output(model, propagate(model, 0.9545), 0);
}

TEST(DominatedOutput, FollowsTheCriterion) {
    const Distribution rectangular = Distribution::uniform(0.0, k_root_3);
    const std::optional<DominatedOutput> one = dominated({Distribution::normal(0.0, 0.3), rectangular});
    ASSERT_TRUE(one);
    EXPECT_TRUE(prints_as(one->coverage_factor, "1.748"));
    EXPECT_EQ(one->dominating, std::vector<std::size_t>{1});
    EXPECT_NEAR(convolution_distribution(one->terms, one->expanded_uncertainty), 0.5 + 0.5 * 0.9545, 1e-6);
    EXPECT_FALSE(dominated({Distribution::normal(0.0, 0.301), rectangular}));
    const std::optional<DominatedOutput> two = dominated({rectangular, Distribution::uniform(0.0, 1.0)});
    ASSERT_TRUE(two);
    EXPECT_EQ(two->dominating, (std::vector<std::size_t>{0, 1}));
    EXPECT_FALSE(dominated(std::vector<Distribution>(4, rectangular)));
    EXPECT_FALSE(dominated({Distribution::normal(0.0, 1.0)}));
    EXPECT_FALSE(dominated({Distribution::constant(3.0)}));
    const Distribution skewed{.kind = DistributionKind::exponential, .location = 0.0, .scale = 0.1};
    EXPECT_FALSE(dominated({rectangular, skewed}));
}

}  // namespace
}  // namespace gumcert::gum
