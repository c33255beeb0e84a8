// Checks of the items and the standard deviation of proficiency tests against published numbers.
#include "gum/comparison/proficiency_scheme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;

// ISO 13528:2022, table E.2: duplicates on ten items.
Eigen::MatrixXd table_e2() {
    Eigen::MatrixXd results(10, 2);
    results << 0.185, 0.194, 0.187, 0.189, 0.182, 0.186, 0.188, 0.196, 0.191, 0.181,  //
        0.188, 0.180, 0.187, 0.196, 0.177, 0.186, 0.179, 0.187, 0.188, 0.196;
    return results;
}

// ISO 13528:2022, table E.3: two items measured again.
Eigen::MatrixXd table_e3() {
    Eigen::MatrixXd results(2, 2);
    results << 0.191, 0.198, 0.190, 0.196;
    return results;
}

TEST(ProficiencyScheme, CurveOfHorwitzAndThompson) {
    // ISO 13528:2022, clause E.9, in mg/kg.
    EXPECT_TRUE(prints_as(1e6 * sigma_pt_of_mass_fraction(1.195e-6), "0.186"));
    EXPECT_TRUE(prints_as(1e6 * sigma_pt_of_mass_fraction(2.565e-6), "0.356"));
    EXPECT_TRUE(prints_as(100.0 * sigma_pt_of_mass_fraction(1.195e-6) / 1.195e-6, "15.6"));
    EXPECT_TRUE(prints_as(100.0 * sigma_pt_of_mass_fraction(2.565e-6) / 2.565e-6, "13.9"));
    EXPECT_TRUE(agrees(sigma_pt_of_mass_fraction(1.195e-6), 0.186103281597726e-6, 1e-12));
    EXPECT_TRUE(agrees(sigma_pt_of_mass_fraction(5e-8), 1.1e-8, 1e-14));
    EXPECT_TRUE(agrees(sigma_pt_of_mass_fraction(0.2), 0.00447213595499958, 1e-14));
    // The pieces nearly meet.
    EXPECT_TRUE(agrees(sigma_pt_of_mass_fraction(1.2e-7), sigma_pt_of_mass_fraction(0.99999e-7 * 1.2), 6e-3));
    EXPECT_TRUE(agrees(sigma_pt_of_mass_fraction(0.138), sigma_pt_of_mass_fraction(0.13801), 6e-3));
    EXPECT_EQ(code_of<InputError>([] { return sigma_pt_of_mass_fraction(0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { return sigma_pt_of_mass_fraction(1.5); }), "GC-GUM-0112");
    EXPECT_EQ(code_of<InputError>([] { return sigma_pt_of_mass_fraction(std::nan("")); }), "GC-GUM-0001");
}

TEST(ProficiencyScheme, SigmaFromPrecision) {
    // ISO 13528:2022, clause E.10.
    EXPECT_TRUE(prints_as(sigma_pt_of_precision(23.2, 14.3, 2), "20.9"));
    EXPECT_TRUE(agrees(sigma_pt_of_precision(23.2, 14.3, 2), 20.8804932891922, 1e-13));
    EXPECT_EQ(sigma_pt_of_precision(23.2, 14.3, 1), 23.2);
    // Repeatability alone: σ_r/√m.
    EXPECT_TRUE(agrees(sigma_pt_of_precision(1.0, 1.0, 1'000'000'000'000), 1e-6, 1e-14));
    // With many replicates what is between laboratories remains.
    EXPECT_TRUE(prints_as(sigma_pt_of_precision(23.2, 14.3, 1000000), "18.3"));
    EXPECT_EQ(code_of<InputError>([] { return sigma_pt_of_precision(14.3, 23.2, 2); }), "GC-GUM-0110");
    EXPECT_EQ(code_of<InputError>([] { return sigma_pt_of_precision(23.2, 14.3, 0); }), "GC-GUM-0111");
    EXPECT_EQ(code_of<InputError>([] { return sigma_pt_of_precision(0.0, 0.0, 2); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { return sigma_pt_of_precision(1.0, -0.1, 2); }), "GC-GUM-0002");
}

TEST(ProficiencyScheme, FactorsOfTableB1) {
    // ISO 13528:2022, table B.1, for duplicates.
    const struct {
        std::size_t items;
        const char* f1;
        const char* f2;
    } table[] = {{7, "2.10", "1.43"},  {8, "2.01", "1.25"},  {9, "1.94", "1.11"},  {10, "1.88", "1.01"},
                 {11, "1.83", "0.93"}, {12, "1.79", "0.86"}, {13, "1.75", "0.80"}, {14, "1.72", "0.75"},
                 {15, "1.69", "0.71"}, {16, "1.67", "0.68"}, {17, "1.64", "0.64"}, {18, "1.62", "0.62"},
                 {19, "1.60", "0.59"}, {20, "1.59", "0.57"}};
    for (const auto& line : table) {
        const HomogeneityFactors factors = homogeneity_factors(line.items, 2);
        EXPECT_TRUE(prints_as(factors.f1, line.f1)) << line.items;
        EXPECT_TRUE(prints_as(factors.f2, line.f2)) << line.items;
    }
    EXPECT_EQ(code_of<InputError>([] { return homogeneity_factors(1, 2); }), "GC-GUM-0111");
    EXPECT_EQ(code_of<InputError>([] { return homogeneity_factors(10, 1); }), "GC-GUM-0111");
}

TEST(ProficiencyScheme, HomogeneityAndStabilityOfTableE2) {
    const double sigma_pt = 0.15 * table_e2().mean();
    const HomogeneityCheck homogeneity = check_homogeneity(table_e2(), sigma_pt);
    EXPECT_EQ(homogeneity.items, 10u);
    EXPECT_EQ(homogeneity.replicates, 2u);
    EXPECT_TRUE(prints_as(homogeneity.mean, "0.18715"));
    EXPECT_TRUE(prints_as(homogeneity.s_x, "0.00398"));
    EXPECT_TRUE(prints_as(homogeneity.s_w, "0.00556"));
    EXPECT_TRUE(prints_as(homogeneity.s_s, "0.00060"));
    EXPECT_TRUE(agrees(homogeneity.s_x, 0.00397946115838704, 1e-12));
    EXPECT_TRUE(agrees(homogeneity.s_w, 0.00556327241828045, 1e-12));
    EXPECT_TRUE(agrees(homogeneity.s_s, 0.000600925212577326, 1e-10));
    EXPECT_TRUE(prints_as(sigma_pt, "0.02807"));
    EXPECT_TRUE(prints_as(homogeneity.limit, "0.00842"));
    EXPECT_TRUE(homogeneity.sufficient);
    EXPECT_TRUE(homogeneity.sufficient_expanded);
    const HomogeneityFactors factors = homogeneity_factors(10, 2);
    EXPECT_TRUE(
        agrees(homogeneity.expanded_limit,
               std::sqrt(factors.f1 * 0.00842175 * 0.00842175 + factors.f2 * 0.00556327241828045 * 0.00556327241828045),
               1e-12));

    const StabilityCheck stability = check_stability(homogeneity, table_e3(), sigma_pt);
    EXPECT_TRUE(prints_as(stability.mean, "0.19375"));
    EXPECT_TRUE(prints_as(stability.difference, "0.00660"));
    EXPECT_TRUE(stability.stable);
    EXPECT_TRUE(stability.stable_expanded);
    // u of the two means of item means: 0.00397946/√10 and |0.1945 − 0.193|/√2/√2.
    EXPECT_TRUE(agrees(stability.u_difference, std::hypot(0.00397946115838704 / std::sqrt(10.0), 0.00075), 1e-10));
    EXPECT_TRUE(agrees(stability.expanded_limit, 0.00842175 + 2.0 * stability.u_difference, 1e-12));
}

TEST(ProficiencyScheme, ChecksThatFail) {
    // Limits just below what was found.
    const HomogeneityCheck tight = check_homogeneity(table_e2(), 0.0006 / 0.3);
    EXPECT_FALSE(tight.sufficient);
    EXPECT_TRUE(tight.sufficient_expanded);  // s_w alone explains an s_s of this size
    EXPECT_FALSE(check_stability(tight, table_e3(), 0.0065 / 0.3).stable);
    EXPECT_TRUE(check_stability(tight, table_e3(), 0.0065 / 0.3).stable_expanded);
    EXPECT_FALSE(check_stability(tight, table_e3(), 0.0030 / 0.3).stable_expanded);
    Eigen::MatrixXd apart(3, 2);
    apart << 1.0, 1.01, 2.0, 2.01, 3.0, 3.01;
    const HomogeneityCheck different = check_homogeneity(apart, 0.1);
    EXPECT_FALSE(different.sufficient_expanded);
    EXPECT_TRUE(agrees(different.s_x, 1.0, 1e-14));
    EXPECT_TRUE(agrees(different.s_w, 0.01 / std::sqrt(2.0), 1e-12));
}

TEST(ProficiencyScheme, ReplicatesThatScatterMoreThanTheItemsLeaveNothingBetweenThem) {
    Eigen::MatrixXd results(2, 3);
    results << 1.0, 2.0, 3.0, 3.0, 2.0, 1.0;
    const HomogeneityCheck check = check_homogeneity(results, 1.0);
    EXPECT_EQ(check.s_x, 0.0);
    EXPECT_EQ(check.s_w, 1.0);
    EXPECT_EQ(check.s_s, 0.0);
}

TEST(ProficiencyScheme, LargeCommonValuesAndUnitsChangeNothing) {
    const HomogeneityCheck plain = check_homogeneity(table_e2(), 0.028);
    const HomogeneityCheck scaled = check_homogeneity(1000.0 * table_e2(), 28.0);
    EXPECT_TRUE(agrees(scaled.s_s, 1000.0 * plain.s_s, 1e-11));
    EXPECT_TRUE(agrees(scaled.expanded_limit, 1000.0 * plain.expanded_limit, 1e-13));
    const HomogeneityCheck moved = check_homogeneity(table_e2().array() + 1024.0, 0.028);
    EXPECT_NEAR(moved.s_x, plain.s_x, 1e-13);
    EXPECT_NEAR(moved.s_w, plain.s_w, 1e-13);
}

TEST(ProficiencyScheme, OneItemMeasuredAgain) {
    const HomogeneityCheck before = check_homogeneity(table_e2(), 0.028);
    Eigen::MatrixXd again(1, 1);
    again << 0.19;
    const StabilityCheck check = check_stability(before, again, 0.028);
    EXPECT_TRUE(agrees(check.u_difference, before.s_x / std::sqrt(10.0), 1e-14));
}

TEST(ProficiencyScheme, StabilityDifferenceKeepsItsDigitsAtALargeOffset) {
    // Around 2^20 doubles are 2^-32 apart. In this unit: means 1/3 (three items, one of them 1) and 7/4.
    const double unit = std::exp2(-32.0), offset = std::exp2(20.0);
    Eigen::MatrixXd before(3, 2), later(2, 2);
    before << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0;
    later << 1.0, 2.0, 2.0, 2.0;
    before = (before * unit).array() + offset;
    later = (later * unit).array() + offset;
    const StabilityCheck check = check_stability(check_homogeneity(before, unit), later, unit);
    EXPECT_TRUE(agrees(check.difference, (7.0 / 4.0 - 1.0 / 3.0) * unit, 1e-12));
    EXPECT_TRUE(agrees(check.u_difference, unit * std::sqrt(1.0 / 9.0 + 1.0 / 16.0), 1e-12));
    // Decimal numbers: 10 + 1e-6 (0, 1, 2, 3)/4 and the same 1e-6 up; 16 digits leave 1e-9 of the difference.
    const Eigen::MatrixXd ten = (Eigen::MatrixXd(2, 2) << 10.0, 10.00000025, 10.0000005, 10.00000075).finished();
    const Eigen::MatrixXd more = (Eigen::MatrixXd(2, 2) << 10.000001, 10.00000125, 10.0000015, 10.00000175).finished();
    EXPECT_TRUE(agrees(check_stability(check_homogeneity(ten, 1.0), more, 1.0).difference, 1e-6, 2e-9));
}

TEST(ProficiencyScheme, DifferenceAtTheLimitIsStable) {
    // 10.3 − 10 is 0.30000000000000071 in binary numbers.
    const HomogeneityCheck before = check_homogeneity(Eigen::MatrixXd::Constant(3, 2, 10.0), 1.0);
    const StabilityCheck at_limit = check_stability(before, Eigen::MatrixXd::Constant(2, 2, 10.3), 1.0);
    EXPECT_GT(at_limit.difference, at_limit.limit);
    EXPECT_TRUE(at_limit.stable);
    EXPECT_TRUE(at_limit.stable_expanded);
    EXPECT_FALSE(check_stability(before, Eigen::MatrixXd::Constant(2, 2, 10.3 + 1e-13), 1.0).stable);
}

TEST(ProficiencyScheme, NumbersWhoseSquaresAreNone) {
    const HomogeneityCheck plain = check_homogeneity(table_e2(), 0.028);
    for (const double factor : {1e300, 1e-300}) {
        const HomogeneityCheck check = check_homogeneity(factor * table_e2(), factor * 0.028);
        EXPECT_TRUE(agrees(check.expanded_limit, factor * plain.expanded_limit, 1e-13));
        EXPECT_TRUE(agrees(check.s_w, factor * plain.s_w, 1e-11));
        EXPECT_TRUE(check.sufficient_expanded);
    }
}

TEST(ProficiencyScheme, RefusesWhatIsNoCheck) {
    const HomogeneityCheck before = check_homogeneity(table_e2(), 0.028);
    EXPECT_EQ(code_of<InputError>([] { return check_homogeneity(Eigen::MatrixXd::Ones(1, 2), 1.0); }), "GC-GUM-0111");
    EXPECT_EQ(code_of<InputError>([] { return check_homogeneity(Eigen::MatrixXd::Ones(2, 1), 1.0); }), "GC-GUM-0111");
    EXPECT_EQ(code_of<InputError>([] { return check_homogeneity(table_e2(), 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([&] { return check_stability(before, Eigen::MatrixXd(0, 2), 1.0); }), "GC-GUM-0111");
    Eigen::MatrixXd missing = table_e2();
    missing(3, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(code_of<InputError>([&] { return check_homogeneity(missing, 1.0); }), "GC-GUM-0001");
    EXPECT_NE(message_of<InputError>([&] { return check_homogeneity(missing, 1.0); }).find("item 4, replicate 2"),
              std::string::npos);
}

}  // namespace
}  // namespace gumcert::gum
