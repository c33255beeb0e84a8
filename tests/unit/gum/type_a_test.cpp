// Type A evaluations against certified and printed values.
#include "gum/type_a.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/reference_case.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using gumcert::test::expected_number;
using gumcert::test::reference_case;
using gumcert::test::reference_ids;
using nlohmann::json;
using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;

TEST(TypeA, CertifiedUnivariateSets) {
    const std::vector<std::string> ids = reference_ids("strd-uni-");
    EXPECT_GE(ids.size(), 5U);
    for (const std::string& id : ids) {
        SCOPED_TRACE(id);
        const json set = reference_case(id);
        const auto y = set["data"]["y"].get<std::vector<double>>();
        const ObservationSummary summary = evaluate_type_a(y);
        for (const json& expected : set["expected"]) {
            const std::string kind = expected["kind"];
            const double value = expected_number(expected);
            if (kind == "mean") {
                EXPECT_TRUE(agrees(summary.mean, value, 1e-14));
            } else if (kind == "std") {
                EXPECT_TRUE(agrees(summary.standard_deviation, value, 1e-13));
            } else if (kind == "autocorrelation_lag1") {
                EXPECT_TRUE(agrees(autocorrelation(y, 1)[1], value, 2e-13));
            } else {
                ASSERT_EQ(kind, "u_mean");
                EXPECT_TRUE(agrees(summary.standard_deviation_of_mean, value, 1e-13));
            }
        }
        EXPECT_EQ(summary.degrees_of_freedom, static_cast<double>(y.size() - 1));
    }
}

// NIST StRD NumAcc3 and NumAcc4: 7 and 8 digits in common. Their decimals are not doubles: at 1e6 and 1e7 the spacing
// of doubles is 1.2e-10 and 1.9e-9, which leaves about 9 and 8 digits of a standard deviation of 0.1.
TEST(TypeA, CertifiedSetsWithManyCommonDigits) {
    for (const auto& [common, digits] : {std::pair{1.0e6, 9.0}, std::pair{1.0e7, 8.0}}) {
        std::vector<double> y{common + 0.2};
        for (int k = 0; k < 500; ++k) {
            y.push_back(common + 0.1);
            y.push_back(common + 0.3);
        }
        const ObservationSummary summary = evaluate_type_a(y);
        EXPECT_TRUE(agrees(summary.mean, common + 0.2, 1e-15));
        EXPECT_TRUE(agrees(summary.standard_deviation, 0.1, std::pow(10.0, -digits)));
        // Of the doubles themselves nothing more is lost.
        std::vector<double> exact;
        for (const double value : y) {
            exact.push_back(value - common);  // without rounding
        }
        EXPECT_TRUE(agrees(summary.standard_deviation, evaluate_type_a(exact).standard_deviation, 1e-14));
        EXPECT_TRUE(agrees(autocorrelation(y, 1)[1], -0.999, 1e-8));
    }
}

TEST(TypeA, TwentyTemperatures) {
    // JCGM 100:2008, 4.4.3 and table 1.
    const std::vector<double> t{96.90,  98.18,  98.25,  98.61,  99.03,  99.49,  99.56,  99.74,  99.89,  100.07,
                                100.33, 100.42, 100.68, 100.95, 101.11, 101.20, 101.57, 101.84, 102.36, 102.72};
    const ObservationSummary summary = evaluate_type_a(t);
    EXPECT_TRUE(prints_as(summary.mean, "100.145"));
    EXPECT_TRUE(prints_as(summary.standard_deviation, "1.489"));
    EXPECT_TRUE(prints_as(summary.standard_deviation_of_mean, "0.333"));
    EXPECT_EQ(summary.observations, 20U);
}

TEST(TypeA, AutocorrelationOfLew) {
    const json set = reference_case("lew-autocorrelation");
    const auto y = set["data"]["y"].get<std::vector<double>>();
    const std::vector<double> r = autocorrelation(y, set["expected"].size() - 1);
    for (std::size_t lag = 0; lag < r.size(); ++lag) {
        ASSERT_EQ(set["expected"][lag]["quantity"], "r" + std::to_string(lag));
        EXPECT_TRUE(prints_as(r[lag], set["expected"][lag]["printed"].get<std::string>())) << "lag " << lag;
    }
    const AutocorrelationCheck check = autocorrelation_check(y);
    EXPECT_FALSE(check.independent);
    EXPECT_EQ(check.lag_one, r[1]);
    EXPECT_DOUBLE_EQ(check.limit, 2.0 / std::sqrt(200.0));
    EXPECT_TRUE(autocorrelation_check(std::vector<double>{1.0, 3.0, 2.0, 2.5, 2.6, 1.4, 1.2, 2.9}).independent);
}

TEST(TypeA, PooledStandardDeviation) {
    const std::vector<StandardDeviation> series{{3.0, 4.0}, {5.0, 12.0}};
    const StandardDeviation pooled = pooled_standard_deviation(series);
    EXPECT_DOUBLE_EQ(pooled.value, std::sqrt((4.0 * 9.0 + 12.0 * 25.0) / 16.0));
    EXPECT_EQ(pooled.degrees_of_freedom, 16.0);
    EXPECT_EQ(pooled_standard_deviation(std::vector<StandardDeviation>{{2.0e-200, 7.0}, {2.0e-200, 3.0}}).value,
              2.0e-200);
    EXPECT_EQ(pooled_standard_deviation(std::vector<StandardDeviation>{{0.0, 1.0}}).value, 0.0);
    EXPECT_EQ(code_of<InputError>([] { (void)pooled_standard_deviation({}); }), "GC-GUM-0024");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)pooled_standard_deviation(std::vector<StandardDeviation>{{-1.0, 1.0}});
              }),
              "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)pooled_standard_deviation(std::vector<StandardDeviation>{{1.0, 0.0}});
              }),
              "GC-GUM-0003");
}

TEST(TypeA, StandardDeviationOfAStandardDeviation) {
    // JCGM 100:2008, table E.1, in per cent.
    const std::vector<std::pair<std::size_t, std::string>> table{{2, "76"},  {3, "52"},  {4, "42"},  {5, "36"},
                                                                 {10, "24"}, {20, "16"}, {30, "13"}, {50, "10"}};
    for (const auto& [n, percent] : table) {
        EXPECT_TRUE(prints_as(100.0 * relative_standard_deviation_of_s(n), percent)) << n;
    }
    // √(π/2 − 1) for n = 2, √(4/π − 1) for n = 3.
    EXPECT_TRUE(agrees(relative_standard_deviation_of_s(2), 0.7555106397628671, 1e-14));
    EXPECT_TRUE(agrees(relative_standard_deviation_of_s(3), 0.5227232008770633, 1e-14));
    // The product and the series meet, and each falls as 1/√(2(n − 1)).
    const double before = relative_standard_deviation_of_s(2000);
    const double after = relative_standard_deviation_of_s(2001);
    EXPECT_TRUE(
        agrees(after / before, std::sqrt(1999.0 / 2000.0 * (1.0 + 0.25 / 2000.0) / (1.0 + 0.25 / 1999.0)), 1e-10));
    EXPECT_TRUE(agrees(relative_standard_deviation_of_s(2001), 0.015812376607, 1e-5));
    EXPECT_EQ(code_of<InputError>([] { (void)relative_standard_deviation_of_s(1); }), "GC-GUM-0021");
}

TEST(TypeA, DegreesOfFreedomFromReliability) {
    // JCGM 100:2008, G.4.2: 25 % gives 8.
    EXPECT_EQ(degrees_of_freedom_from_reliability(0.25), 8.0);
    EXPECT_TRUE(agrees(degrees_of_freedom_from_reliability(0.1), 50.0, 1e-14));
    EXPECT_EQ(code_of<InputError>([] { (void)degrees_of_freedom_from_reliability(0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)degrees_of_freedom_from_reliability(std::nan("")); }), "GC-GUM-0001");
}

TEST(TypeA, SimultaneousObservations) {
    // JCGM 100:2008, H.2, table H.2: V in volts, I in milliamperes, φ in radians.
    Eigen::MatrixXd observations(5, 3);
    observations << 5.007, 19.663, 1.0456, 4.994, 19.639, 1.0438, 5.005, 19.640, 1.0468, 4.990, 19.685, 1.0428, 4.999,
        19.678, 1.0433;
    const SimultaneousMeans result = evaluate_simultaneous(observations);
    EXPECT_TRUE(prints_as(result.means[0], "4.9990"));
    EXPECT_TRUE(prints_as(result.means[1], "19.6610"));
    EXPECT_TRUE(prints_as(result.means[2], "1.04446"));
    EXPECT_TRUE(prints_as(std::sqrt(result.covariance(0, 0)), "0.0032"));
    EXPECT_TRUE(prints_as(std::sqrt(result.covariance(1, 1)), "0.0095"));
    EXPECT_TRUE(prints_as(std::sqrt(result.covariance(2, 2)), "0.00075"));
    EXPECT_TRUE(prints_as(result.correlation(0, 1), "-0.36"));
    EXPECT_TRUE(prints_as(result.correlation(0, 2), "0.86"));
    EXPECT_TRUE(prints_as(result.correlation(1, 2), "-0.65"));
    EXPECT_EQ(result.covariance, result.covariance.transpose());
    EXPECT_EQ(result.degrees_of_freedom, 4.0);
    const std::vector<double> v{5.007, 4.994, 5.005, 4.990, 4.999};
    EXPECT_TRUE(agrees(std::sqrt(result.covariance(0, 0)), evaluate_type_a(v).standard_deviation_of_mean, 1e-14));
    Eigen::MatrixXd constant(3, 2);
    constant << 1, 2, 1, 3, 1, 4;
    EXPECT_EQ(evaluate_simultaneous(constant).correlation(0, 1), 0.0);
    EXPECT_EQ(code_of<InputError>([] { (void)evaluate_simultaneous(Eigen::MatrixXd(3, 0)); }), "GC-GUM-0025");
    EXPECT_EQ(code_of<InputError>([] { (void)evaluate_simultaneous(Eigen::MatrixXd::Ones(1, 2)); }), "GC-GUM-0021");
    constant(1, 1) = std::nan("");
    EXPECT_EQ(code_of<InputError>([&] { (void)evaluate_simultaneous(constant); }), "GC-GUM-0001");
}

TEST(TypeA, MeanOfTwentyTemperatures) {
    // JCGM 100:2008, 4.4.3: s = 1.489 °C of 20 observations, u = 0.333 °C, printed as 0.33.
    EXPECT_TRUE(prints_as(u_of_mean(1.48884448305954, 20), "0.33"));
    EXPECT_EQ(u_of_mean(0.25e-6, 1), 0.25e-6);
    EXPECT_EQ(u_of_mean(0.0, 3), 0.0);
}

TEST(TypeA, RefusesBadArguments) {
    EXPECT_EQ(code_of<InputError>([] { (void)u_of_mean(-1.0, 3); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] { (void)u_of_mean(std::nan(""), 3); }), "GC-GUM-0001");
    EXPECT_EQ(message_of<InputError>([] { (void)u_of_mean(1.0, 0); }),
              "number of observations — 0 — a mean needs at least 1 observation — "
              "Give the observations, or state the uncertainty as a Type B evaluation.");
}

TEST(TypeA, RefusesBadSeries) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(message_of<InputError>([] { (void)evaluate_type_a(std::vector<double>{1.0}); }),
              "observations — 1 — a standard deviation needs at least 2 observations — "
              "Give more observations, or state the uncertainty as a Type B evaluation.");
    EXPECT_EQ(code_of<InputError>([] { (void)evaluate_type_a({}); }), "GC-GUM-0021");
    EXPECT_EQ(message_of<InputError>([&] {
                  (void)evaluate_type_a(std::vector<double>{1.0, infinity});
              }),
              "observation 2 — inf — must be a finite number — Correct the value.");
    EXPECT_EQ(code_of<InputError>([] { (void)autocorrelation(std::vector<double>{1.0, 2.0}, 2); }), "GC-GUM-0022");
    EXPECT_EQ(code_of<InputError>([] { (void)autocorrelation(std::vector<double>{1.5, 1.5}, 1); }), "GC-GUM-0023");
    EXPECT_EQ(code_of<NoResultError>([] {
                  (void)evaluate_type_a(std::vector<double>{1.7e308, -1.7e308});
              }),
              "GC-GUM-0027");
    EXPECT_EQ(evaluate_type_a(std::vector<double>{0.1, 0.1, 0.1}).standard_deviation, 0.0);
}

}  // namespace
}  // namespace gumcert::gum
