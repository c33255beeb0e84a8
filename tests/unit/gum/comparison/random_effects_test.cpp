// Means of results that differ more than their uncertainties explain: published figures, limits, refusals.
#include "gum/comparison/random_effects.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::prints_as;

Eigen::VectorXd vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

LaboratoryResults results_of(const std::vector<double>& x, const std::vector<double>& u) {
    return {.x = vector(x), .u = vector(u)};
}

LaboratoryResults kacker() {
    const Eigen::VectorXd variances = vector({0.2025, 1.21, 0.09, 0.2025, 0.3844, 0.5625, 0.0676, 0.0225, 1.8225});
    return {.x = vector({61.0, 61.4, 62.21, 62.3, 62.34, 62.6, 62.7, 62.84, 65.9}), .u = variances.cwiseSqrt()};
}

// Kacker 2004, Metrologia 41, 132-136, example 1, table 1 (tau of Paule-Mandel and of Cochran's analysis of variance).
TEST(RandomEffects, PauleMandelAndCochranOfKacker) {
    const LaboratoryResults labs = kacker();
    const ReferenceValue mean = mandel_paule(labs);
    EXPECT_TRUE(prints_as(mean.between_standard_deviation, "0.8399"));
    EXPECT_TRUE(prints_as(cochran_between_standard_deviation(labs), "1.1837"));
    // Recomputed with NumPy and SciPy to full precision. R metafor, whose iteration ends at 1e-5 of the sum, prints
    // tau² 0.705395309224248, mean 62.4076199113286, u 0.338030602684471, interval 61.7450921043947 … 63.0701477182625:
    // equal to 1e-11.
    EXPECT_TRUE(agrees(mean.between_standard_deviation * mean.between_standard_deviation, 0.705395309219239, 1e-13));
    EXPECT_TRUE(agrees(mean.value, 62.4076199113283, 1e-14));
    EXPECT_TRUE(agrees(mean.u, 0.338030602683556, 1e-13));
    const double k = coverage_factor(0.95, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(agrees(mean.value - k * mean.u, 61.7450921043961, 1e-14));
    EXPECT_TRUE(agrees(mean.value + k * mean.u, 63.0701477182604, 1e-14));
    // The mean without a variance between laboratories, and its chi-square.
    const ReferenceValue fixed = weighted_mean(labs);
    EXPECT_TRUE(prints_as(fixed.value, "62.5833970939982"));
    EXPECT_TRUE(prints_as(fixed.u, "0.107845705498231"));
    const ConsistencyTest consistency = consistency_test(labs);
    EXPECT_TRUE(agrees(consistency.chi_square, 24.8018977417483, 1e-13));
    EXPECT_TRUE(agrees(consistency.p_value, 0.0016793514637841, 1e-12));
}

// Reference run of the R package meta (fixed effect; DerSimonian-Laird with Hartung-Knapp), stored in the tests of
// statsmodels. The last digits of what R prints are rounding of its own; NumPy gives tau² 0.00167839819127394.
TEST(RandomEffects, DerSimonianLairdWithHartungKnapp) {
    const LaboratoryResults labs =
        results_of({2.70805020110221, 1.25672336971146, 0.374938517449009, 1.65822807660353, 0.784954729813068,
                    0.361663949151077, 0.575364144903562, 0.250542525502324, 0.650587566141149, 0.0918075492531229,
                    0.273865253802803, 0.485755524477543, 0.182321556793955, 0.980829253011726, 1.31218638896617,
                    -0.259511195485085, 0.138402322859119},
                   {1.1130538571376, 0.505568465186247, 0.390847133738078, 0.680511012471685, 0.434831536798166,
                    0.26249802054503, 0.490562645746402, 0.376864733063505, 0.529771411128472, 0.458411099840008,
                    0.193159187510219, 0.206827050443269, 0.441477021807833, 0.713624032148063, 1.18251919576455,
                    0.604874380241894, 0.329592099997789});
    const double k = coverage_factor(0.95, std::numeric_limits<double>::infinity());
    const ReferenceValue fixed = weighted_mean(labs);
    EXPECT_TRUE(prints_as(fixed.value, "0.428036725396544"));
    EXPECT_TRUE(agrees(fixed.u, 0.0902874968199669, 1e-14));
    EXPECT_TRUE(prints_as(fixed.value - k * fixed.u, "0.251076483375135"));
    EXPECT_TRUE(prints_as(fixed.value + k * fixed.u, "0.604996967417954"));
    EXPECT_TRUE(agrees(consistency_test(labs).chi_square, 16.181374262823, 1e-13));

    const ReferenceValue mean = dersimonian_laird(labs);
    EXPECT_TRUE(agrees(mean.between_standard_deviation * mean.between_standard_deviation, 0.00167839819127394, 1e-11));
    EXPECT_TRUE(prints_as(mean.value, "0.429520368698268"));
    const double u = hartung_knapp_u(labs, mean);
    EXPECT_TRUE(agrees(u, 0.091595275239769, 1e-13));  // R: 0.0915952752397692
    const double t = coverage_factor(0.95, 16.0);
    EXPECT_TRUE(agrees(mean.value - t * u, 0.235347059333874, 1e-12));  // R: 0.235347059333852
    EXPECT_TRUE(agrees(mean.value + t * u, 0.623693678062661, 1e-12));  // R: 0.623693678062684
}

// Vangel and Rukhin 1999, Biometrics 55, 129-136: dietary fibre in apples, nine laboratories with two observations each
// (data and figures as in the documentation of the R package metRology).
TEST(RandomEffects, VangelRukhinDietaryFibreInApples) {
    const ReplicatedResults labs{.x = vector({12.46, 13.035, 12.44, 12.87, 13.42, 12.08, 13.18, 14.335, 12.23}),
                                 .s = vector({0.028, 0.233, 0.325, 0.071, 0.339, 0.325, 0.099, 0.064, 0.212}),
                                 .observations = std::vector<std::size_t>(9, 2)};
    const ReferenceValue mean = vangel_rukhin(labs);
    EXPECT_TRUE(prints_as(mean.value, "12.90585"));
    EXPECT_TRUE(prints_as(mean.between_standard_deviation * mean.between_standard_deviation, "0.4262122"));
    EXPECT_TRUE(prints_as(mean.u, "0.2234490"));
    const double k = coverage_factor(0.95, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(prints_as(mean.value - k * mean.u, "12.46790"));
    EXPECT_TRUE(prints_as(mean.value + k * mean.u, "13.34380"));
    EXPECT_NEAR(mean.weights.sum(), 1.0, 1e-14);
    // Recomputed with SciPy to more digits than are printed.
    EXPECT_TRUE(agrees(mean.value, 12.9058475076914, 1e-10));
    EXPECT_TRUE(agrees(mean.between_standard_deviation * mean.between_standard_deviation, 0.426212240474027, 1e-7));
}

// Found with SciPy (minimize of −2 log L from 60 starting points, all variances free).
TEST(RandomEffects, VangelRukhinWithUnequalNumbersOfObservations) {
    const ReferenceValue mean = vangel_rukhin({.x = vector({10.1, 10.3, 9.9, 10.2, 11.0}),
                                               .s = vector({0.2, 0.3, 0.1, 0.25, 0.4}),
                                               .observations = {5, 8, 3, 10, 4}});
    EXPECT_TRUE(agrees(mean.value, 10.1404756927, 1e-8));
    EXPECT_TRUE(agrees(mean.between_standard_deviation * mean.between_standard_deviation, 0.0199816222358, 1e-5));
    EXPECT_TRUE(agrees(mean.u, 0.08063140485, 1e-6));
    const ReferenceValue two =
        vangel_rukhin({.x = vector({1.0, 5.0}), .s = vector({0.01, 1.0}), .observations = {2, 30}});
    EXPECT_TRUE(agrees(two.value, 2.99167955916, 1e-6));
    EXPECT_TRUE(agrees(two.u, 1.41418880669, 1e-6));
}

// At τ = 0 the likelihood depends on μ alone once every variance is (r² + ν v)/(1 + ν); its maximum by SciPy (brentq).
TEST(RandomEffects, VangelRukhinWithoutVarianceBetweenLaboratories) {
    const ReferenceValue mean = vangel_rukhin(
        {.x = vector({10.1, 10.12, 9.98, 10.05}), .s = vector({0.2, 0.3, 0.1, 0.25}), .observations = {5, 8, 3, 10}});
    EXPECT_EQ(mean.between_standard_deviation, 0.0);
    EXPECT_TRUE(agrees(mean.value, 10.0404069478411, 1e-13));
    EXPECT_TRUE(agrees(mean.u, 0.0377164525325541, 1e-13));
    // Two laboratories agree closely and the third does not: the likelihood gives the third a large variance of its
    // own.
    const ReferenceValue outlier =
        vangel_rukhin({.x = vector({1.0, 1.001, 3.0}), .s = vector({0.01, 0.01, 0.01}), .observations = {3, 3, 3}});
    EXPECT_EQ(outlier.between_standard_deviation, 0.0);
    EXPECT_TRUE(agrees(outlier.value, 1.00051685925355, 1e-13));
    EXPECT_TRUE(agrees(outlier.u, 0.00333957049741972, 1e-13));
    const ReferenceValue equal =
        vangel_rukhin({.x = vector({7.0, 7.0, 7.0}), .s = vector({0.1, 0.2, 0.3}), .observations = {2, 5, 9}});
    EXPECT_EQ(equal.value, 7.0);
    EXPECT_EQ(equal.between_standard_deviation, 0.0);
}

/// −2 log L of results with n observations each, profiled by brute force over the variance of every laboratory.
double profiled_deviance(const ReplicatedResults& results, double mu, double between, double ratio) {
    double total = 0.0;
    for (Eigen::Index i = 0; i < results.x.size(); ++i) {
        const double q = (results.x(i) - mu) * (results.x(i) - mu);
        const auto observations = static_cast<double>(results.observations[static_cast<std::size_t>(i)]);
        const double nu = observations - 1.0;
        const double v = results.s(i) * results.s(i) / observations;
        double least = 1e300;
        // All minima lie between v and q, and below both where a variance between laboratories explains q.
        for (double t = 1e-3 * v; t < std::max(1.1 * q, 1e3 * v); t *= ratio) {
            least = std::min(least, std::log(between + t) + q / (between + t) + nu * (std::log(t) + v / t));
        }
        total += least;
    }
    return total;
}

TEST(RandomEffects, VangelRukhinIsAtAMaximumOfTheLikelihood) {
    const ReplicatedResults results{.x = vector({3.0, 3.4, 2.5, 4.4, 3.1, 3.2}),
                                    .s = vector({0.3, 0.2, 0.7, 0.1, 0.2, 0.4}),
                                    .observations = {3, 2, 12, 4, 6, 2}};
    const ReferenceValue mean = vangel_rukhin(results);
    constexpr double k_ratio = 1.0005;
    const double tau2 = mean.between_standard_deviation * mean.between_standard_deviation;
    const double best = profiled_deviance(results, mean.value, tau2, k_ratio);
    for (double mu = 2.4; mu < 4.5; mu += 0.1) {
        for (const double between : {0.0, 1e-4, 1e-2, 0.05, 0.2, 0.5, 1.0, 4.0}) {
            EXPECT_GT(profiled_deviance(results, mu, between, k_ratio), best - 1e-5) << mu << " " << between;
        }
    }
}

/// No mean and variance between laboratories of a grid is more likely than the result.
void expect_highest_maximum(const ReplicatedResults& results) {
    constexpr double k_ratio = 1.02;
    constexpr double k_of_the_grid = 1e-3;
    const ReferenceValue mean = vangel_rukhin(results);
    const double tau = mean.between_standard_deviation;
    const double best = profiled_deviance(results, mean.value, tau * tau, k_ratio);
    const double low = results.x.minCoeff();
    const double range = results.x.maxCoeff() - low;
    for (int step = 0; step <= 40; ++step) {
        const double mu = low + range * step / 40.0;
        for (const double part : {0.0, 0.01, 0.03, 0.1, 0.2, 0.4, 0.7, 1.0}) {
            EXPECT_GT(profiled_deviance(results, mu, part * part * range * range, k_ratio), best - k_of_the_grid)
                << "mean " << mu << ", tau " << part * range << " instead of " << mean.value << ", " << tau;
        }
    }
}

TEST(RandomEffects, VangelRukhinIsAtTheHighestOfSeveralMaxima) {
    // A laboratory far from the others is imprecise, or has an effect of its own, or the others have: which of them is
    // the most likely changes with its distance, so that the likelihood has several maxima of like height.
    std::mt19937_64 random(20261130);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 40; ++k) {
        SCOPED_TRACE("comparison " + std::to_string(k));
        const Eigen::Index n = 3 + k % 4;
        ReplicatedResults results{.x = Eigen::VectorXd(n), .s = Eigen::VectorXd(n), .observations = {}};
        const double spread = std::pow(10.0, 0.4 * (k % 5));
        for (Eigen::Index i = 0; i < n; ++i) {
            results.x(i) = spread * normal(random) + (i == 0 ? 3.0 * (1 + k % 12) * spread : 0.0);
            results.s(i) = std::exp(0.5 * normal(random));
            results.observations.push_back(2 + static_cast<std::size_t>(k + 3 * i) % 4);
        }
        expect_highest_maximum(results);
    }
}

TEST(RandomEffects, VangelRukhinKnowsBothLikelyVariancesOfAFarLaboratory) {
    // At the τ of the highest maximum the first laboratory may be as precise as it says, t = 0.031, or imprecise, t about 5. With
    // the latter alone μ = −0.053 and τ = 0.356 would be the answer, less likely by a factor of 5. All parameters
    // free, from 400 starts (BFGS of SciPy): μ = 0.85218, τ = 1.89294.
    const ReferenceValue mean = vangel_rukhin({.x = vector({4.5874, -0.10455, -0.62446, 0.48046, -0.081595}),
                                               .s = vector({0.34975, 0.42939, 0.33184, 0.36948, 0.36689}),
                                               .observations = {4, 4, 4, 4, 4}});
    EXPECT_TRUE(agrees(mean.value, 0.85218, 1e-5));
    EXPECT_TRUE(agrees(mean.between_standard_deviation, 1.89294, 1e-5));
}

TEST(RandomEffects, VangelRukhinKeepsItsDigitsFarFromZero) {
    const ReplicatedResults near{
        .x = vector({0.25, 0.5, 0.3125, 0.75}), .s = vector({0.01, 0.02, 0.015, 0.01}), .observations = {4, 4, 5, 6}};
    ReplicatedResults far = near;
    far.x.array() += 1073741824.0;
    EXPECT_EQ(vangel_rukhin(near).u, vangel_rukhin(far).u);
    EXPECT_EQ(vangel_rukhin(near).between_standard_deviation, vangel_rukhin(far).between_standard_deviation);
}

TEST(RandomEffects, VangelRukhinRefusesWhatHasNoStandardDeviation) {
    const ReplicatedResults good{.x = vector({1.0, 2.0}), .s = vector({0.1, 0.1}), .observations = {2, 2}};
    ReplicatedResults wrong = good;
    wrong.observations[1] = 1;
    EXPECT_EQ(code_of<InputError>([&] { (void)vangel_rukhin(wrong); }), "GC-GUM-0138");
    wrong = good;
    wrong.s(0) = 0.0;
    EXPECT_EQ(code_of<InputError>([&] { (void)vangel_rukhin(wrong); }), "GC-GUM-0003");
    wrong = good;
    wrong.x(0) = std::nan("");
    EXPECT_EQ(code_of<InputError>([&] { (void)vangel_rukhin(wrong); }), "GC-GUM-0001");
    wrong = good;
    wrong.observations.pop_back();
    EXPECT_EQ(code_of<InputError>([&] { (void)vangel_rukhin(wrong); }), "GC-GUM-0135");
    wrong = good;
    wrong.x(0) = 1e150;
    EXPECT_EQ(code_of<InputError>([&] { (void)vangel_rukhin(wrong); }), "GC-GUM-0142");
    EXPECT_EQ(
        code_of<InputError>([] { (void)vangel_rukhin({.x = vector({1.0}), .s = vector({0.1}), .observations = {3}}); }),
        "GC-GUM-0131");
}

struct CcriParticipant {
    std::string_view name;
    double x = 0.0, u = 0.0;
    bool in_kcrv = true;
};
struct CcriDegree {
    std::string_view name;
    std::string_view d, U;  // as published; empty: the published digits are not those of its own data (see below)
    double en = 0.0;        // computed with NumPy
};
struct CcriCase {
    std::string_view document;
    std::vector<CcriParticipant> participants;
    std::string_view kcrv, u;                                  // as published, without zeros that only fill up
    double full_kcrv = 0.0, full_u = 0.0, mandel_paule = 0.0;  // computed with NumPy
    double weighted_mean = 0.0, u_weighted_mean = 0.0, chi_square = 0.0, birge = 0.0;
    std::vector<double> weights;
    double unit_of_degrees = 1.0;  // in the unit of x
    std::vector<CcriDegree> degrees = {};
};

// Key comparisons BIPM.RI(II)-K1 as the public database of CCRI(II) has them. Values of several ampoules are averaged.
// Left out because the data that are published beside them do not give them: D of LNE-LNHB 2022 for Ce-139 (published
// -0.03, from the data -0.036), U of ENEA-INMRI (8.5; 8.43) and of NMISA (4.8; 4.73) for Lu-177.
const std::vector<CcriCase>& ccri_cases() {
    static const std::vector<CcriCase> cases = {
        {.document = "BIPM.RI(II)-K1.Ac-225, release 2022",
         .participants =
             {
                 {"POLATOM 2021", 75081.0, 210.0, true},
                 {"PTB 2019", 74519.0, 200.0, true},
             },
         .kcrv = "7.480e4",
         .u = "2.8e2",
         .full_kcrv = 74799.0880302663,
         .full_u = 280.996300399552,
         .mandel_paule = 340.399764982293,
         .weighted_mean = 74786.3008323424,
         .u_weighted_mean = 144.827586206897,
         .chi_square = 3.75557669441142,
         .birge = 1.93793103448276,
         .weights = {0.498377278053899, 0.501622721946101},
         .unit_of_degrees = 1.0,
         .degrees = {}},
        {.document = "BIPM.RI(II)-K1.Ag-110m, release 2020",
         .participants =
             {
                 {"BKFH 2000", 5973.0, 17.0, true},
                 {"LNE-LNHB 2001", 5985.0, 7.0, true},
                 {"NIST 1988", 5971.0, 22.0, true},
                 {"NPL 1993", 6005.0, 48.0, true},
                 {"PTB 2015", 5974.0, 19.0, true},
             },
         .kcrv = "5980.8",
         .u = "6.4",
         .full_kcrv = 5980.76069439641,
         .full_u = 6.43859029475667,
         .mandel_paule = 0.0,
         .weighted_mean = 5981.83449178084,
         .u_weighted_mean = 5.85822001197132,
         .chi_square = 1.12003810625691,
         .birge = 0.529159263893421,
         .weights = {0.160001472226608, 0.554134529116789, 0.111522042682888, 0.0374123282709071, 0.136929627702808},
         .unit_of_degrees = 1.0,
         .degrees = {}},
        {.document = "BIPM.RI(II)-K1.Ce-139, release 2022",
         .participants =
             {
                 {"BEV 2008", 131.6, 1.2, false},
                 {"BIPM 1976", 132.33, 1.58, true},
                 {"BKFH 1984", 132.02, 0.48, true},
                 {"CMI 1985", 132.77, 0.34, true},
                 {"INER 2004", 132.88, 0.48, false},
                 {"IRA 2000", 132.93, 0.8, true},
                 {"KRISS 2004", 131.89, 0.53, false},
                 {"LNE-LNHB 2022", 132.735, 0.51, true},
                 {"LNMRI-IRD 1997", 132.69, 0.48, true},
                 {"NIM 2004", 134.74, 0.74, false},
                 {"NIST 1988", 133.38, 0.44, true},
                 {"NMIJ 2004", 132.74, 0.35, true},
                 {"NMISA 2019", 133.81, 0.73, true},
                 {"NPL 1981", 132.76, 0.59, true},
                 {"PTB 2008", 132.61, 0.34, true},
                 {"VNIIM 2004", 133.06, 0.28, false},
             },
         .kcrv = "132.77",
         .u = "0.14",
         .full_kcrv = 132.771121073513,
         .full_u = 0.143608936025091,
         .mandel_paule = 0.0,
         .weighted_mean = 132.765617471477,
         .u_weighted_mean = 0.141609591941896,
         .chi_square = 6.77122837461622,
         .birge = 0.822874739836885,
         .weights = {0.0114623450841562, 0.0897411777350111, 0.162806648559288, 0.0371362861883684, 0.0808191925156198,
                     0.0897411777350111, 0.104294862386718, 0.154855730060769, 0.043499788329142, 0.0628361428466284,
                     0.162806648559288},
         .unit_of_degrees = 1.0,
         .degrees =
             {
                 {"NMIJ 2004", "-0.03", "0.65", 0.0479788678214043},
                 {"PTB 2008", "-0.16", "0.63", 0.25657961698945},
                 {"BEV 2008", "-1.2", "2.4", 0.48450989886118},
                 {"NMISA 2019", "1.0", "1.4", 0.729393389147054},
                 {"LNE-LNHB 2022", "", "0.98", 0.0369676106047101},
                 {"INER 2004", "0.1", "1.0", 0.108656727599155},
                 {"KRISS 2004", "-0.9", "1.1", 0.802315145729323},
                 {"NIM 2004", "2.0", "1.5", 1.3059585992148},
                 {"VNIIM 2004", "0.29", "0.63", 0.459004212730824},
             }},
        {.document = "BIPM.RI(II)-K1.Cs-137, release 2024",
         .participants =
             {
                 {"AECL 1977", 27589.5, 66.0, true},           {"ANSTO 1994", 27470.0, 370.0, true},
                 {"ASMW 1978", 27922.0, 76.0, true},           {"BARC 1997", 27380.0, 220.0, true},
                 {"BelGIM 2007", 27220.0, 270.0, false},       {"BEV 2011", 27400.0, 190.0, false},
                 {"BIPM 1982", 27609.6666666667, 123.0, true}, {"BKFH 1997", 27628.0, 99.0, true},
                 {"IFIN-HH 2009", 27610.0, 220.0, false},      {"JRC 2004", 27340.0, 160.0, true},
                 {"LNE-LNHB 1998", 27514.0, 84.0, true},       {"NIM 1999", 27262.5, 170.0, true},
                 {"NIST 1983", 27577.0, 93.0, true},           {"NMIJ 2005", 27720.0, 140.0, true},
                 {"NMISA 2010", 27710.0, 90.0, true},          {"NPL 1977", 27288.0, 530.0, true},
                 {"NRC 2014", 27908.0, 169.0, true},           {"PTB 1997", 27600.0, 100.0, true},
                 {"SMU 2007", 27770.0, 310.0, false},          {"VNIIM 2007", 27450.0, 120.0, false},
             },
         .kcrv = "27613",
         .u = "47",
         .full_kcrv = 27613.0013014927,
         .full_u = 46.7208910235934,
         .mandel_paule = 121.134917024053,
         .weighted_mean = 27635.4283704253,
         .u_weighted_mean = 28.365499377062,
         .chi_square = 31.2136516794408,
         .birge = 1.49316661780643,
         .weights = {0.106444178849271, 0.0164455583936282, 0.0997682538005515, 0.0362031807903952, 0.0710853943284699,
                     0.0848720864005768, 0.0542114396456506, 0.0944631067540733, 0.0505019676858721, 0.0886358879268888,
                     0.0626823803676154, 0.0905566441678348, 0.00901593644583545, 0.0508582125142582,
                     0.0842557719290783},
         .unit_of_degrees = 1000.0,
         .degrees =
             {
                 {"NMIJ 2005", "0.11", "0.28", 0.384840675842588},
                 {"VNIIM 2007", "-0.16", "0.26", 0.632894904969706},
                 {"IFIN-HH 2009", "-0.0", "0.45", 0.00667233767050114},
                 {"NMISA 2010", "0.1", "0.19", 0.516540591161951},
                 {"BEV 2011", "-0.21", "0.39", 0.544314843707424},
                 {"NRC 2014", "0.29", "0.33", 0.8840269030656},
                 {"BelGIM 2007", "-0.39", "0.55", 0.717122984779022},
                 {"SMU 2007", "0.16", "0.63", 0.250395894647898},
             }},
        {.document = "BIPM.RI(II)-K1.Lu-177, release 2024",
         .participants =
             {
                 {"ANSTO 2009", 555.8, 1.4, false},
                 {"CMI 2023", 559.4, 2.5, false},
                 {"ENEA-INMRI 2009", 564.1, 3.8, false},
                 {"IRA 2022", 539.708, 2.5, false},
                 {"JRC 2009", 565.2, 9.3, true},
                 {"LNMRI-IRD 2009", 557.8, 3.4, false},
                 {"NIST 2009", 559.4, 1.9, false},
                 {"NMISA 2009", 560.6, 1.5, false},
                 {"NPL 2009", 559.5, 1.8, true},
                 {"POLATOM 2009", 558.2, 3.1, false},
                 {"PTB 2000", 559.0, 2.7, true},
                 {"PTB 2009", 558.6, 1.2, false},
             },
         .kcrv = "559.9",
         .u = "1.8",
         .full_kcrv = 559.91387283237,
         .full_u = 1.8256030749823,
         .mandel_paule = 0.0,
         .weighted_mean = 559.494132792385,
         .u_weighted_mean = 1.47863935649331,
         .chi_square = 0.409928172171033,
         .birge = 0.452729594885862,
         .weights = {0.104046242774566, 0.53757225433526, 0.358381502890173},
         .unit_of_degrees = 1.0,
         .degrees =
             {
                 {"JRC 2009", "5", "17", 0.311867467267525},
                 {"NPL 2009", "-0.4", "3.5", 0.11773423814998},
                 {"IRA 2022", "-20.2", "6.2", 3.26362916243897},
                 {"CMI 2023", "-0.5", "6.2", 0.0830001443353203},
                 {"ENEA-INMRI 2009", "4.2", "", 0.496482757076112},
                 {"NIST 2009", "-0.5", "5.3", 0.0975118740796272},
                 {"NMISA 2009", "0.7", "", 0.145193625953059},
                 {"POLATOM 2009", "-1.7", "7.2", 0.238195763375463},
                 {"PTB 2009", "-1.3", "4.4", 0.300701440989241},
             }},
        {.document = "BIPM.RI(II)-K1.Sm-153, release 2024",
         .participants =
             {
                 {"ANSTO 2004", 565450.0, 8000.0, false},
                 {"CMI 2023", 569510.0, 2600.0, false},
                 {"LNE-LNHB 2003", 571723.333333333, 1100.0, true},
                 {"NIST 1998", 576800.0, 4700.0, true},
                 {"NPL 1999", 574700.0, 2900.0, true},
                 {"PTB 1999", 571700.0, 3100.0, true},
             },
         .kcrv = "5.727e5",
         .u = "1.1e3",
         .full_kcrv = 572707.059323261,
         .full_u = 1133.70011975252,
         .mandel_paule = 0.0,
         .weighted_mean = 572254.386354053,
         .u_weighted_mean = 955.776645085489,
         .chi_square = 1.9116168222081,
         .birge = 0.798251594049584,
         .weights = {0.57659199222856, 0.0938614244008451, 0.171637415221475, 0.15790916814912},
         .unit_of_degrees = 1000.0,
         .degrees =
             {
                 {"ANSTO 2004", "-7", "16", 0.449079319096719},
                 {"CMI 2023", "-3.2", "5.7", 0.563573062350376},
             }},
    };
    return cases;
}

std::size_t participant(const CcriCase& ccri, std::string_view name) {
    for (std::size_t i = 0; i < ccri.participants.size(); ++i) {
        if (ccri.participants[i].name == name) {
            return i;
        }
    }
    ADD_FAILURE() << "no participant " << name;
    return 0;
}

TEST(RandomEffects, PowerModeratedMeanOfCcri) {
    for (const CcriCase& ccri : ccri_cases()) {
        SCOPED_TRACE(ccri.document);
        std::vector<double> x, u;
        std::vector<std::size_t> members;
        for (std::size_t i = 0; i < ccri.participants.size(); ++i) {
            x.push_back(ccri.participants[i].x);
            u.push_back(ccri.participants[i].u);
            if (ccri.participants[i].in_kcrv) {
                members.push_back(i);
            }
        }
        const LaboratoryResults all = results_of(x, u);
        const LaboratoryResults inside = selected_results(all, members);
        const ReferenceValue mean = power_moderated_mean(inside);
        EXPECT_TRUE(prints_as(mean.value, ccri.kcrv));
        EXPECT_TRUE(prints_as(mean.u, ccri.u));
        EXPECT_TRUE(agrees(mean.value, ccri.full_kcrv, 1e-13));
        EXPECT_TRUE(agrees(mean.u, ccri.full_u, 1e-12));
        EXPECT_TRUE(agrees(mean.between_standard_deviation, ccri.mandel_paule, 1e-11));
        ASSERT_EQ(static_cast<std::size_t>(mean.weights.size()), ccri.weights.size());
        for (std::size_t i = 0; i < ccri.weights.size(); ++i) {
            EXPECT_TRUE(agrees(mean.weights(static_cast<Eigen::Index>(i)), ccri.weights[i], 1e-12)) << i;
        }
        EXPECT_TRUE(agrees(weighted_mean(inside).value, ccri.weighted_mean, 1e-13));
        EXPECT_TRUE(agrees(weighted_mean(inside).u, ccri.u_weighted_mean, 1e-13));
        EXPECT_TRUE(agrees(consistency_test(inside).chi_square, ccri.chi_square, 1e-12));
        EXPECT_TRUE(agrees(consistency_test(inside).birge_ratio, ccri.birge, 1e-12));
        const DegreesOfEquivalence degrees =
            degrees_of_equivalence(all, spread_weights(mean, members, ccri.participants.size()));
        for (const CcriDegree& degree : ccri.degrees) {
            SCOPED_TRACE(degree.name);
            const auto i = static_cast<Eigen::Index>(participant(ccri, degree.name));
            const double d = degrees.d(i) / ccri.unit_of_degrees;
            const double U = 2.0 * degrees.u(i) / ccri.unit_of_degrees;
            EXPECT_TRUE(degree.d.empty() || prints_as(d, degree.d));
            EXPECT_TRUE(degree.U.empty() || prints_as(U, degree.U));
            EXPECT_TRUE(agrees(std::abs(d) / U, degree.en, 1e-9));
            EXPECT_LE(std::abs(degrees.correlation(i)), 1.0);
        }
    }
}

TEST(RandomEffects, PowersOfThePowerModeratedMeanBetweenTheTwoMeans) {
    const LaboratoryResults labs = kacker();
    const ReferenceValue all = power_moderated_mean(labs, 2.0);
    EXPECT_TRUE(agrees(all.value, mandel_paule(labs).value, 1e-14));
    EXPECT_TRUE(agrees(all.u, mandel_paule(labs).u, 1e-13));
    const ReferenceValue none = power_moderated_mean(labs, 0.0);
    EXPECT_TRUE(agrees(none.value, arithmetic_mean(labs.x).value, 1e-14));
    EXPECT_TRUE(agrees(none.u, arithmetic_mean(labs.x).u, 1e-13));  // the larger of the two here
    EXPECT_EQ(code_of<InputError>([&] { (void)power_moderated_mean(labs, 2.1); }), "GC-GUM-0137");
    EXPECT_EQ(code_of<InputError>([&] { (void)power_moderated_mean(labs, std::nan("")); }), "GC-GUM-0137");
}

TEST(RandomEffects, ConsistentResultsHaveNoVarianceBetweenLaboratories) {
    const LaboratoryResults labs = results_of({1.0, 1.1, 0.95, 1.02}, {0.1, 0.1, 0.2, 0.1});
    const ReferenceValue weighted = weighted_mean(labs);
    for (const ReferenceValue& mean : {mandel_paule(labs), dersimonian_laird(labs)}) {
        EXPECT_EQ(mean.between_standard_deviation, 0.0);
        EXPECT_TRUE(agrees(mean.value, weighted.value, 1e-15));
        EXPECT_TRUE(agrees(mean.u, weighted.u, 1e-14));
    }
    EXPECT_EQ(cochran_between_standard_deviation(labs), 0.0);
    // Equal values: nothing is left, by any of them.
    const LaboratoryResults equal = results_of({5.0, 5.0, 5.0}, {0.1, 0.2, 0.3});
    EXPECT_EQ(mandel_paule(equal).between_standard_deviation, 0.0);
    EXPECT_EQ(power_moderated_mean(equal).value, 5.0);
    EXPECT_EQ(hartung_knapp_u(equal, mandel_paule(equal)), 0.0);
}

TEST(RandomEffects, MandelPauleWithUncertaintiesOverTwelveDecades) {
    const LaboratoryResults labs = results_of({1.0, 2.0, 3.0, 10.0}, {1e-6, 1e-3, 1.0, 1e6});
    const ReferenceValue mean = mandel_paule(labs);
    const double tau2 = mean.between_standard_deviation * mean.between_standard_deviation;
    double chi_square = 0.0;
    for (Eigen::Index i = 0; i < 4; ++i) {
        const double z = labs.x(i) - mean.value;
        chi_square += z * z / (labs.u(i) * labs.u(i) + tau2);
    }
    EXPECT_TRUE(agrees(chi_square, 3.0, 1e-12));
    // Barely above the limit: chi-square 2.000002 of two equal u for n − 1 = 1 leaves τ² = 1e-6 u².
    const ReferenceValue barely = mandel_paule(results_of({0.0, std::sqrt(2.0 * (1.0 + 1e-6))}, {1.0, 1.0}));
    EXPECT_NEAR(barely.between_standard_deviation, 1e-3, 1e-9);
}

TEST(RandomEffects, CommonOffsetCostsNoDigits) {
    LaboratoryResults near = results_of({0.25, 0.5, 0.3125, 0.75, 0.4375}, {0.01, 0.02, 0.015, 0.01, 0.03});
    LaboratoryResults far = near;
    far.x.array() += 1073741824.0;
    EXPECT_TRUE(
        agrees(mandel_paule(far).between_standard_deviation, mandel_paule(near).between_standard_deviation, 1e-14));
    EXPECT_TRUE(agrees(dersimonian_laird(far).u, dersimonian_laird(near).u, 1e-14));
    EXPECT_TRUE(agrees(power_moderated_mean(far).u, power_moderated_mean(near).u, 1e-13));
    EXPECT_TRUE(agrees(hartung_knapp_u(far, mandel_paule(far)), hartung_knapp_u(near, mandel_paule(near)), 1e-13));
}

TEST(RandomEffects, RefusesWhatItCannotTake) {
    LaboratoryResults correlated = results_of({1.0, 2.0}, {0.1, 0.1});
    correlated.covariance = Eigen::Matrix2d{{0.01, 0.005}, {0.005, 0.01}};
    EXPECT_EQ(code_of<InputError>([&] { (void)mandel_paule(correlated); }), "GC-GUM-0139");
    EXPECT_EQ(code_of<InputError>([&] { (void)dersimonian_laird(correlated); }), "GC-GUM-0139");
    EXPECT_EQ(code_of<InputError>([&] { (void)power_moderated_mean(correlated); }), "GC-GUM-0139");
    EXPECT_EQ(code_of<InputError>([] { (void)mandel_paule(results_of({1.0}, {0.1})); }), "GC-GUM-0131");
    EXPECT_EQ(code_of<InputError>([] { (void)dersimonian_laird(results_of({1.0, 2.0}, {0.1, 0.0})); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)power_moderated_mean(results_of({1.0, 2.0}, {0.1, 0.0}));
              }),
              "GC-GUM-0003");
}

}  // namespace
}  // namespace gumcert::gum
