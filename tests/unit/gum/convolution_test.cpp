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
