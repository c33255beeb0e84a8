#include "gum/budget/stated_quantity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::prints_as;

TEST(StatedQuantity, OfAnUncertaintyIsNormalOrT) {
    const StatedQuantity normal = state_uncertainty(10.0, 0.5);
    EXPECT_EQ(normal.value, 10.0);
    EXPECT_EQ(normal.u, 0.5);
    EXPECT_TRUE(std::isinf(normal.degrees_of_freedom));
    EXPECT_EQ(normal.distribution.kind, DistributionKind::normal);
    const StatedQuantity t = state_uncertainty(10.0, 0.5, 18.0);
    EXPECT_EQ(t.distribution.kind, DistributionKind::student_t);
    EXPECT_EQ(t.distribution.shape, 18.0);
    EXPECT_EQ(t.evaluation, Evaluation::type_b);
    EXPECT_EQ(code_of<InputError>([] { (void)state_uncertainty(1.0, 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)state_uncertainty(NAN, 1.0); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] { (void)state_uncertainty(1.0, 1.0, 0.0); }), "GC-GUM-0005");
}

// JCGM 100:2008, F.2.2.1: a step of 1 has u = 0.29.
TEST(StatedQuantity, OfADistributionHasItsMoments) {
    const StatedQuantity step = state_distribution(Distribution::uniform(7.0, 0.5));
    EXPECT_EQ(step.value, 7.0);
    EXPECT_TRUE(prints_as(step.u, "0.29"));
    EXPECT_EQ(code_of<InputError>([] { (void)state_distribution(Distribution::student_t(0.0, 1.0, 2.0)); }),
              "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] { (void)state_distribution(Distribution::constant(1.0)); }), "GC-GUM-0003");
}

// Current of JCGM 100:2008, table H.2, in mA.
TEST(StatedQuantity, OfObservationsIsTheirMean) {
    const StatedQuantity current = state_observations({19.663, 19.639, 19.640, 19.685, 19.678});
    EXPECT_TRUE(prints_as(current.value, "19.6610"));
    EXPECT_TRUE(prints_as(current.u, "0.0095"));
    EXPECT_EQ(current.degrees_of_freedom, 4.0);
    EXPECT_EQ(current.evaluation, Evaluation::type_a);
    EXPECT_EQ(current.distribution.kind, DistributionKind::student_t);
    EXPECT_EQ(current.observations.size(), 5U);
    EXPECT_EQ(code_of<InputError>([] { (void)state_observations({1.0, 1.0}); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)state_observations({1.0}); }), "GC-GUM-0021");
}

TEST(StatedQuantity, IsScaledAboutItsEstimate) {
    for (const Distribution& distribution :
         {Distribution::normal(3.0, 0.4), Distribution::uniform(-2.0, 0.5),
          Distribution{.kind = DistributionKind::gamma, .location = 1.0, .scale = 0.2, .shape = 3.0},
          Distribution{.kind = DistributionKind::lognormal, .location = -1.0, .scale = 2.0, .shape = 0.3}}) {
        const StatedQuantity stated = state_distribution(distribution);
        for (const double factor : {0.25, 1.0, 3.0}) {
            const StatedQuantity scaled = with_scaled_uncertainty(stated, factor);
            EXPECT_EQ(scaled.value, stated.value);
            EXPECT_NEAR(scaled.u, factor * stated.u, 1e-15);
            EXPECT_NEAR(expectation(scaled.distribution), stated.value, 1e-12);
            EXPECT_NEAR(standard_deviation(scaled.distribution), factor * stated.u, 1e-12);
        }
        const StatedQuantity exact = with_scaled_uncertainty(stated, 0.0);
        EXPECT_EQ(exact.u, 0.0);
        EXPECT_EQ(exact.distribution.kind, DistributionKind::constant);
        EXPECT_EQ(exact.distribution.location, stated.value);
    }
}

TEST(StatedQuantity, OfAConstantHasNoUncertainty) {
    const StatedQuantity constant = state_constant(299792458.0);
    EXPECT_EQ(constant.u, 0.0);
    EXPECT_EQ(constant.distribution.kind, DistributionKind::constant);
    EXPECT_EQ(code_of<InputError>([] { (void)state_constant(INFINITY); }), "GC-GUM-0001");
}

}  // namespace
}  // namespace gumcert::gum
