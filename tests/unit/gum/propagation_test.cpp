#include "gum/propagation.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/distribution.h"
#include "gum/quantity/distribution_shape.h"
#include "gum/quantity/special_values.h"
#include "gum/type_b.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;

class FunctionModel : public MeasurementModel {
public:
    std::function<std::vector<Eigen::MatrixXd>(const Eigen::VectorXd&)> second_derivative;
    std::vector<InputGroup> groups;
    std::vector<OutputQuantity> quantities;
    std::function<Eigen::VectorXd(const Eigen::VectorXd&)> function;
    std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> derivative;

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return quantities; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override { return function(x); }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override { return derivative(x); }
    [[nodiscard]] std::vector<Eigen::MatrixXd> hessians(const Eigen::VectorXd& x) const override {
        return second_derivative ? second_derivative(x) : std::vector<Eigen::MatrixXd>{};
    }
};

/// y = A x
FunctionModel linear_model(const Eigen::MatrixXd& A, std::vector<InputGroup> groups) {
    FunctionModel model;
    model.groups = std::move(groups);
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
        model.quantities.push_back({.name = "y" + std::to_string(i + 1), .unit = "m"});
    }
    model.function = [A](const Eigen::VectorXd& x) -> Eigen::VectorXd { return A * x; };
    model.derivative = [A](const Eigen::VectorXd&) { return A; };
    return model;
}

InputGroup group(std::string name, const Eigen::VectorXd& value, const Eigen::MatrixXd& covariance,
                 double nu = k_infinity, std::string source = "") {
    InputGroup result;
    result.name = std::move(name);
    result.source = std::move(source);
    result.unit = "m";
    result.value = value;
    result.covariance = covariance;
    result.degrees_of_freedom = nu;
    return result;
}

InputGroup single(std::string name, double value, double u, double nu = k_infinity, std::string source = "") {
    return group(std::move(name), Eigen::VectorXd::Constant(1, value), Eigen::MatrixXd::Constant(1, 1, u * u), nu,
                 std::move(source));
}

// --- JCGM 100:2008, H.1: calibration of an end gauge, lengths in metres ------------------------------------------

FunctionModel end_gauge() {
    constexpr double k_nm = 1e-9;
    FunctionModel model;
    model.groups = {single("l_s", 50000623 * k_nm, 25 * k_nm, 18),
                    single("d, repeatability", 215 * k_nm, 5.8 * k_nm, 24, "comparator"),
                    single("d, random", 0.0, 3.9 * k_nm, 5, "comparator"),
                    single("d, systematic", 0.0, 6.7 * k_nm, 8, "comparator"),
                    single("alpha_s", 11.5e-6, u_from_half_width(2e-6)),
                    single("theta, mean", -0.1, 0.2, k_infinity, "theta"),
                    single("theta, cyclic", 0.0, 0.5 / std::sqrt(2.0), k_infinity, "theta"),
                    single("d_alpha", 0.0, u_from_half_width(1e-6), 50),
                    single("d_theta", 0.0, u_from_half_width(0.05), 2)};
    model.quantities = {{.name = "l", .unit = "m"}};
    model.function = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, x(0) + x(1) + x(2) + x(3) - x(0) * (x(7) * (x(5) + x(6)) + x(4) * x(8)));
    };
    model.derivative = [](const Eigen::VectorXd& x) {
        Eigen::MatrixXd c(1, 9);
        c << 1.0 - x(7) * (x(5) + x(6)) - x(4) * x(8), 1.0, 1.0, 1.0, -x(0) * x(8), -x(0) * x(7), -x(0) * x(7),
            -x(0) * (x(5) + x(6)), -x(0) * x(4);
        return c;
    };
    return model;
}

TEST(Propagation, EndGaugeOfTheGum) {
    // JCGM 100:2008, H.1, table H.1 and H.1.6, first-order terms. The GUM cuts nu_eff = 16.75 to 16 for its table
    // (k = 2.92) and multiplies with the rounded u = 32 nm: U = 93 nm. We use nu_eff as it is.
    const Propagation result = propagate(end_gauge(), 0.99);
    EXPECT_TRUE(prints_as(result.value(0) * 1e9, "50000838"));
    const double u_nm = result.standard_uncertainty(0) * 1e9;
    EXPECT_TRUE(prints_as(u_nm, "32"));
    EXPECT_TRUE(prints_as(u_nm, "31.7"));
    EXPECT_TRUE(agrees(u_nm, 31.6638791110086, 1e-12));
    EXPECT_TRUE(agrees(result.effective_degrees_of_freedom(0), 16.7518557376272, 1e-12));
    EXPECT_TRUE(prints_as(coverage_factor(0.99, std::floor(result.effective_degrees_of_freedom(0))), "2.92"));
    EXPECT_TRUE(agrees(coverage_factor(0.99, 16.0) * u_nm, 92.4832762021239, 1e-12));
    EXPECT_EQ(result.coverage_factor(0), coverage_factor(0.99, result.effective_degrees_of_freedom(0)));
    EXPECT_LT(result.coverage_factor(0), coverage_factor(0.99, 16.0));
    EXPECT_GT(result.coverage_factor(0), coverage_factor(0.99, 17.0));
    EXPECT_DOUBLE_EQ(result.expanded_uncertainty(0), result.coverage_factor(0) * result.standard_uncertainty(0));

    const std::vector<const char*> contributions{"25", "5.8", "3.9", "6.7", "0", "0", "0", "2.9", "16.6"};
    ASSERT_EQ(result.budget.size(), contributions.size());
    for (std::size_t g = 0; g < contributions.size(); ++g) {
        EXPECT_TRUE(prints_as(std::sqrt(result.budget[g].variance(0)) * 1e9, contributions[g]))
            << result.budget[g].name;
    }
    ASSERT_EQ(result.shares_by_source.size(), 6U);
    EXPECT_EQ(result.shares_by_source[0].name, "l_s") << "a group without a source stands for itself";
    EXPECT_EQ(result.shares_by_source[1].name, "comparator");
    EXPECT_TRUE(prints_as(std::sqrt(result.shares_by_source[1].variance(0)) * 1e9, "9.7"));
    EXPECT_EQ(result.shares_by_source[3].name, "theta");
}

// --- JCGM 100:2008, H.2: resistance, reactance and impedance measured together -----------------------------------

FunctionModel impedance(bool correlated) {
    // Five sets of V, I, phi (table H.2); the covariance of the means.
    Eigen::MatrixXd readings(5, 3);
    readings << 5.007, 0.019663, 1.0456, 4.994, 0.019639, 1.0438, 5.005, 0.019640, 1.0468, 4.990, 0.019685, 1.0428,
        4.999, 0.019678, 1.0433;
    const Eigen::RowVectorXd mean = readings.colwise().mean();
    const Eigen::MatrixXd centred = readings.rowwise() - mean;
    const Eigen::MatrixXd covariance = centred.transpose() * centred / (5.0 * 4.0);
    FunctionModel model;
    if (correlated) {
        model.groups = {group("V, I, phi", mean.transpose(), covariance, 4)};
    } else {
        model.groups = {group("V, I, phi", mean.transpose(), covariance.diagonal())};
    }
    model.quantities = {{.name = "R", .unit = "ohm"}, {.name = "X", .unit = "ohm"}, {.name = "Z", .unit = "ohm"}};
    model.function = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return x(0) / x(1) * Eigen::Vector3d(std::cos(x(2)), std::sin(x(2)), 1.0);
    };
    model.derivative = [](const Eigen::VectorXd& x) {
        const double Z = x(0) / x(1);
        const double R = Z * std::cos(x(2));
        const double X = Z * std::sin(x(2));
        Eigen::MatrixXd c(3, 3);
        c << R / x(0), -R / x(1), -X, X / x(0), -X / x(1), R, Z / x(0), -Z / x(1), 0.0;
        return c;
    };
    return model;
}

TEST(Propagation, ResistanceAndReactanceOfTheGum) {
    // JCGM 100:2008, H.2, tables H.2 to H.4, first approach. The GUM prints u(X) = 0.295, which its second approach
    // gives (0.29549); the law of propagation from the printed readings gives 0.29558.
    const Propagation result = propagate(impedance(true), 0.9545);
    EXPECT_TRUE(prints_as(result.value(0), "127.732"));
    EXPECT_TRUE(prints_as(result.value(1), "219.847"));
    EXPECT_TRUE(prints_as(result.value(2), "254.260"));
    EXPECT_TRUE(prints_as(result.standard_uncertainty(0), "0.071"));
    EXPECT_TRUE(prints_as(result.standard_uncertainty(1), "0.296"));
    EXPECT_TRUE(prints_as(result.standard_uncertainty(2), "0.236"));
    EXPECT_TRUE(agrees(result.standard_uncertainty(0), 0.0710714073969955, 1e-10));
    EXPECT_TRUE(agrees(result.standard_uncertainty(1), 0.29558167735864, 1e-10));
    EXPECT_TRUE(agrees(result.standard_uncertainty(2), 0.236336130082373, 1e-10));
    const Eigen::MatrixXd r = correlation_matrix(result.covariance);
    EXPECT_TRUE(prints_as(r(0, 1), "-0.588"));
    EXPECT_TRUE(prints_as(r(0, 2), "-0.485"));
    EXPECT_TRUE(prints_as(r(1, 2), "0.993"));
    for (Eigen::Index i = 0; i < 3; ++i) {
        // Observed together, five times: one contribution with four degrees of freedom.
        EXPECT_TRUE(agrees(result.effective_degrees_of_freedom(i), 4.0, 1e-14));
        EXPECT_TRUE(prints_as(result.coverage_factor(i), "2.87"));
        EXPECT_DOUBLE_EQ(result.budget[0].share(i), 1.0);
    }
}

TEST(Propagation, ResistanceAndReactanceWithCorrelationIgnored) {
    // JCGM 100:2008, H.2.4, table H.5.
    const Propagation result = propagate(impedance(false), 0.9545);
    EXPECT_TRUE(prints_as(result.standard_uncertainty(0), "0.195"));
    EXPECT_TRUE(prints_as(result.standard_uncertainty(1), "0.201"));
    EXPECT_TRUE(prints_as(result.standard_uncertainty(2), "0.204"));
    const Eigen::MatrixXd r = correlation_matrix(result.covariance);
    EXPECT_TRUE(prints_as(r(0, 1), "0.056"));
    EXPECT_TRUE(prints_as(r(0, 2), "0.527"));
    EXPECT_TRUE(prints_as(r(1, 2), "0.878"));
    EXPECT_TRUE(prints_as(result.coverage_factor(0), "2.00"));
}

TEST(Propagation, ResistorsInSeries) {
    // JCGM 100:2008, 5.2.2, EXAMPLE: ten resistors of 1000 Ω, u = 0.1 Ω, calibrated with one standard (r = 1): 1 Ω;
    // uncorrelated: 0.32 Ω.
    const Eigen::MatrixXd sum = Eigen::MatrixXd::Ones(1, 10);
    const Eigen::VectorXd value = Eigen::VectorXd::Constant(10, 1000.0);
    const Eigen::MatrixXd full = Eigen::MatrixXd::Constant(10, 10, 0.01);
    const Propagation correlated = propagate(linear_model(sum, {group("R", value, full)}), 0.9545);
    EXPECT_TRUE(agrees(correlated.standard_uncertainty(0), 1.0, 1e-14));
    const Propagation independent =
        propagate(linear_model(sum, {group("R", value, Eigen::VectorXd::Constant(10, 0.01))}), 0.9545);
    EXPECT_TRUE(prints_as(independent.standard_uncertainty(0), "0.32"));
    EXPECT_TRUE(agrees(independent.standard_uncertainty(0), 0.316227766016838, 1e-14));
}

// --- properties ---------------------------------------------------------------------------------------------------

struct RandomCase {
    Eigen::MatrixXd A;
    std::vector<InputGroup> groups;
};

/// Groups of 1 to 6 quantities, stored dense, diagonal or singular, over twelve decades of size.
RandomCase random_case(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&random] { return 2.0 * std::ldexp(static_cast<double>(random() >> 11U), -53) - 1.0; };
    RandomCase result;
    const std::size_t count = 1 + random() % 8;
    Eigen::Index n = 0;
    for (std::size_t g = 0; g < count; ++g) {
        const auto size = static_cast<Eigen::Index>(1 + random() % 6);
        const double scale = std::pow(10.0, 6.0 * uniform());
        const Eigen::MatrixXd root =
            Eigen::MatrixXd::NullaryExpr(size, random() % 3 == 0 ? 1 : size, [&] { return scale * uniform(); });
        Eigen::MatrixXd covariance = root * root.transpose();
        if (random() % 3 == 0) {
            covariance = Eigen::MatrixXd(covariance.diagonal());
        }
        const double nu = random() % 2 == 0 ? k_infinity : 1.0 + static_cast<double>(random() % 50);
        result.groups.push_back(group("g" + std::to_string(g), Eigen::VectorXd::NullaryExpr(size, uniform), covariance,
                                      nu, "s" + std::to_string(random() % 3)));
        n += size;
    }
    const auto m = static_cast<Eigen::Index>(1 + random() % 4);
    result.A = Eigen::MatrixXd::NullaryExpr(m, n, uniform);
    return result;
}

Eigen::MatrixXd dense_covariance(const std::vector<InputGroup>& groups, Eigen::Index n) {
    Eigen::MatrixXd V = Eigen::MatrixXd::Zero(n, n);
    Eigen::Index first = 0;
    for (const InputGroup& g : groups) {
        if (g.is_diagonal()) {
            V.block(first, first, g.size(), g.size()) = g.covariance.col(0).asDiagonal();
        } else {
            V.block(first, first, g.size(), g.size()) = g.covariance;
        }
        first += g.size();
    }
    return V;
}

TEST(PropagationProperty, EqualsTheTripleProduct) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const RandomCase c = random_case(seed);
        const Propagation result = propagate(linear_model(c.A, c.groups), 0.95);
        const Eigen::MatrixXd V = dense_covariance(c.groups, c.A.cols());
        const Eigen::MatrixXd expected = c.A * V * c.A.transpose();
        // Terms of a group may cancel in the triple product, so the scale is that without cancellation.
        const Eigen::MatrixXd scale = c.A.cwiseAbs() * V.cwiseAbs() * c.A.cwiseAbs().transpose();
        EXPECT_TRUE(((result.covariance - expected).cwiseAbs().array() <= 1e-13 * scale.array()).all()) << seed;
        EXPECT_EQ(result.covariance, result.covariance.transpose()) << seed;
    }
}

TEST(PropagationProperty, ContributionsSumToTheVariance) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const RandomCase c = random_case(seed);
        const Propagation result = propagate(linear_model(c.A, c.groups), 0.95);
        for (Eigen::Index i = 0; i < c.A.rows(); ++i) {
            const double variance = std::pow(result.standard_uncertainty(i), 2);
            double groups = 0.0;
            double group_shares = 0.0;
            for (const BudgetContribution& contribution : result.budget) {
                EXPECT_GE(contribution.variance(i), 0.0);
                groups += contribution.variance(i);
                group_shares += contribution.share(i);
            }
            double sources = 0.0;
            double source_shares = 0.0;
            for (const BudgetContribution& contribution : result.shares_by_source) {
                sources += contribution.variance(i);
                source_shares += contribution.share(i);
            }
            EXPECT_TRUE(agrees(groups, variance, 1e-12)) << seed;
            EXPECT_TRUE(agrees(sources, variance, 1e-12)) << seed;
            EXPECT_TRUE(agrees(result.covariance(i, i), variance, 1e-12)) << seed;
            EXPECT_NEAR(group_shares, 1.0, 1e-12) << seed;
            EXPECT_NEAR(source_shares, 1.0, 1e-12) << seed;
        }
    }
}

TEST(PropagationProperty, PermutingGroupsChangesNothing) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const RandomCase c = random_case(seed);
        const Propagation result = propagate(linear_model(c.A, c.groups), 0.95);
        std::vector<InputGroup> reversed(c.groups.rbegin(), c.groups.rend());
        Eigen::MatrixXd A(c.A.rows(), c.A.cols());
        Eigen::Index from = 0;
        Eigen::Index to = c.A.cols();
        for (const InputGroup& g : c.groups) {
            to -= g.size();
            A.middleCols(to, g.size()) = c.A.middleCols(from, g.size());
            from += g.size();
        }
        const Propagation permuted = propagate(linear_model(A, reversed), 0.95);
        for (Eigen::Index i = 0; i < A.rows(); ++i) {
            EXPECT_TRUE(agrees(permuted.standard_uncertainty(i), result.standard_uncertainty(i), 1e-13)) << seed;
            EXPECT_TRUE(agrees(permuted.expanded_uncertainty(i), result.expanded_uncertainty(i), 1e-13)) << seed;
            for (std::size_t g = 0; g < c.groups.size(); ++g) {
                EXPECT_NEAR(permuted.budget[c.groups.size() - 1 - g].share(i), result.budget[g].share(i), 1e-13);
            }
        }
    }
}

TEST(PropagationProperty, ScalingTheUnitOfAnOutputScalesTheResult) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const RandomCase c = random_case(seed);
        const Propagation result = propagate(linear_model(c.A, c.groups), 0.95);
        const Propagation scaled = propagate(linear_model(1e6 * c.A, c.groups), 0.95);
        for (Eigen::Index i = 0; i < c.A.rows(); ++i) {
            EXPECT_TRUE(agrees(scaled.expanded_uncertainty(i), 1e6 * result.expanded_uncertainty(i), 1e-13)) << seed;
            EXPECT_TRUE(agrees(scaled.coverage_factor(i), result.coverage_factor(i), 1e-13)) << seed;
        }
    }
}

TEST(PropagationProperty, ScalingTheUnitOfAnInputChangesNothing) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const RandomCase c = random_case(seed);
        const Propagation result = propagate(linear_model(c.A, c.groups), 0.95);
        // A power of two rounds nothing. Where correlated inputs nearly cancel, the rounding of 1e9 is seen.
        for (const auto& [unit, tolerance] : {std::pair(0x1p30, 1e-15), std::pair(1e9, 1e-11)}) {
            std::vector<InputGroup> groups = c.groups;
            groups[0].value *= unit;
            groups[0].covariance *= unit * unit;
            Eigen::MatrixXd A = c.A;
            A.leftCols(groups[0].size()) /= unit;
            const Propagation scaled = propagate(linear_model(A, groups), 0.95);
            for (Eigen::Index i = 0; i < c.A.rows(); ++i) {
                EXPECT_TRUE(agrees(scaled.expanded_uncertainty(i), result.expanded_uncertainty(i), tolerance)) << seed;
            }
        }
    }
}

TEST(PropagationProperty, ZeroUncertaintyInGivesZeroOut) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        RandomCase c = random_case(seed);
        for (InputGroup& g : c.groups) {
            g.covariance.setZero();
        }
        const Propagation result = propagate(linear_model(c.A, c.groups), 0.95);
        EXPECT_TRUE((result.covariance.array() == 0.0).all());
        EXPECT_TRUE((result.standard_uncertainty.array() == 0.0).all());
        EXPECT_TRUE((result.expanded_uncertainty.array() == 0.0).all());
        EXPECT_TRUE((result.effective_degrees_of_freedom.array() == k_infinity).all());
        for (const BudgetContribution& contribution : result.budget) {
            EXPECT_TRUE((contribution.share.array() == 0.0).all());
        }
        for (const BudgetContribution& contribution : result.shares_by_source) {
            EXPECT_TRUE((contribution.share.array() == 0.0).all());
        }
    }
}

TEST(Propagation, OneOutputWithoutUncertaintyBesideOthers) {
    Eigen::MatrixXd A(2, 1);
    A << 0.0, 2.0;
    const Propagation result = propagate(linear_model(A, {single("x", 1.0, 0.1, 5)}), 0.95);
    EXPECT_EQ(result.expanded_uncertainty(0), 0.0);
    EXPECT_EQ(result.effective_degrees_of_freedom(0), k_infinity);
    EXPECT_EQ(result.budget[0].share(0), 0.0);
    EXPECT_TRUE(agrees(result.effective_degrees_of_freedom(1), 5.0, 1e-15));
    EXPECT_EQ(correlation_matrix(result.covariance), Eigen::Matrix2d::Identity());
}

TEST(Propagation, SourcesAreAddedUpInOrderOfFirstAppearance) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Ones(1, 4);
    const Propagation result =
        propagate(linear_model(A, {single("a", 0, 3, k_infinity, "table"), single("b", 0, 1, k_infinity, "tracker"),
                                   single("c", 0, 4, k_infinity, "table"), single("d", 0, 2)}),
                  0.95);
    ASSERT_EQ(result.shares_by_source.size(), 3U);
    EXPECT_EQ(result.shares_by_source[0].name, "table");
    EXPECT_DOUBLE_EQ(result.shares_by_source[0].variance(0), 25.0);
    EXPECT_DOUBLE_EQ(result.shares_by_source[0].share(0), 25.0 / 30.0);
    EXPECT_EQ(result.shares_by_source[1].name, "tracker");
    EXPECT_EQ(result.shares_by_source[2].name, "d");
}

TEST(Propagation, LargeModelWithDiagonalGroups) {
    // The size of a rotary-table job: 5000 inputs in one diagonal group, 240 outputs. No n×n matrix may appear.
    const Eigen::Index n = 5000;
    const Eigen::Index m = 240;
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(
        m, n, [](Eigen::Index i, Eigen::Index j) { return std::sin(static_cast<double>(i * 7919 + j * 104729)); });
    const Eigen::VectorXd variance = Eigen::VectorXd::Constant(n, 4e-14);
    const Propagation result =
        propagate(linear_model(A, {group("length noise", Eigen::VectorXd::Zero(n), variance, 1000)}), 0.9545);
    for (Eigen::Index i = 0; i < m; i += 37) {
        EXPECT_TRUE(agrees(result.standard_uncertainty(i), 2e-7 * A.row(i).norm(), 1e-12));
    }
    EXPECT_NEAR(result.covariance(3, 200), 4e-14 * A.row(3).dot(A.row(200)), 1e-12 * result.covariance(3, 3));
}

// --- bad input ----------------------------------------------------------------------------------------------------

FunctionModel difference_of_three(double r12, double r13, double r23) {
    Eigen::MatrixXd V(3, 3);
    V << 1.0, r12, r13, r12, 1.0, r23, r13, r23, 1.0;
    Eigen::MatrixXd A(1, 3);
    A << 1.0, -1.0, -1.0;
    return linear_model(A, {group("standards", Eigen::Vector3d(1, 2, 3), V)});
}

TEST(PropagationInput, RefusesCorrelationsThatContradictEachOther) {
    // r = 0.9, 0.9, -0.9 would give u² = -2.4 for y = a - b - c.
    const FunctionModel model = difference_of_three(0.9, 0.9, -0.9);
    const std::string message = message_of<InputError>([&] { (void)propagate(model, 0.95); });
    EXPECT_NE(message.find("input group 'standards' — correlation matrix has the eigenvalue -0.8"), std::string::npos)
        << message;
    EXPECT_NE(message.find("caused by quantity 1, quantity 2, quantity 3"), std::string::npos) << message;
    EXPECT_EQ(code_of<InputError>([&] { (void)propagate(model, 0.95); }), "GC-GUM-0054");
}

TEST(PropagationInput, TakesSingularMatrices) {
    const Propagation equal = propagate(difference_of_three(1.0, 0.0, 0.0), 0.95);
    EXPECT_TRUE(agrees(equal.standard_uncertainty(0), 1.0, 1e-14));  // a and b cancel, c stays
    const Propagation opposite = propagate(difference_of_three(-1.0, 0.0, 0.0), 0.95);
    EXPECT_TRUE(agrees(opposite.standard_uncertainty(0), std::sqrt(5.0), 1e-14));
}

TEST(PropagationInput, JudgesSmallQuantitiesBesideLargeOnes) {
    // A covariance of 1e-10 between u = 1e-15 and u = 1 is a correlation of 1e5; beside the largest eigenvalue, 1, the
    // negative one, -1e-20, would look like rounding.
    Eigen::MatrixXd V(2, 2);
    V << 1e-30, 1e-10, 1e-10, 1.0;
    const FunctionModel model =
        linear_model(Eigen::MatrixXd::Ones(1, 2), {group("mixed sizes", Eigen::Vector2d(0, 0), V)});
    EXPECT_EQ(code_of<InputError>([&] { (void)propagate(model, 0.95); }), "GC-GUM-0053");
    V << 1e-30, 0.5e-15, 0.5e-15, 1.0;
    const Propagation result = propagate(
        linear_model(Eigen::MatrixXd::Identity(2, 2), {group("mixed sizes", Eigen::Vector2d(0, 0), V)}), 0.95);
    EXPECT_TRUE(agrees(result.standard_uncertainty(0), 1e-15, 1e-14));
    EXPECT_TRUE(agrees(correlation_matrix(result.covariance)(0, 1), 0.5, 1e-14));
}

TEST(PropagationInput, RefusesEveryOtherDefectOfAGroup) {
    const auto code = [](const Eigen::MatrixXd& V, double nu = k_infinity, double value = 1.0) {
        const FunctionModel model =
            linear_model(Eigen::MatrixXd::Ones(1, 2), {group("g", Eigen::Vector2d(value, 2.0), V, nu)});
        return code_of<InputError>([&] { (void)propagate(model, 0.95); });
    };
    Eigen::MatrixXd V(2, 2);
    V << 1.0, 0.5, 0.4, 1.0;
    EXPECT_EQ(code(V), "GC-GUM-0052");
    V << 1.0, 1.1, 1.1, 1.0;
    EXPECT_EQ(code(V), "GC-GUM-0053");
    V << 0.0, 0.1, 0.1, 1.0;
    EXPECT_EQ(code(V), "GC-GUM-0053");
    V << 1.0, 0.0, 0.0, -1.0;
    EXPECT_EQ(code(V), "GC-GUM-0051");
    EXPECT_EQ(code(Eigen::Vector2d(1.0, -1e-12)), "GC-GUM-0051");
    V << 1.0, std::nan(""), std::nan(""), 1.0;
    EXPECT_EQ(code(V), "GC-GUM-0050");
    EXPECT_EQ(code(Eigen::Vector2d(1.0, k_infinity)), "GC-GUM-0050");
    EXPECT_EQ(code(Eigen::Matrix3d::Identity()), "GC-GUM-0050");
    EXPECT_EQ(code(Eigen::Vector3d::Ones()), "GC-GUM-0050");
    EXPECT_EQ(code(Eigen::Matrix2d::Identity(), 0.0), "GC-GUM-0005");
    EXPECT_EQ(code(Eigen::Matrix2d::Identity(), std::nan("")), "GC-GUM-0005");
    EXPECT_EQ(code(Eigen::Matrix2d::Identity(), 5.0, std::nan("")), "GC-GUM-0050");
}

TEST(PropagationInput, ReportsTheProblemsOfAllGroupsTogether) {
    const FunctionModel model =
        linear_model(Eigen::MatrixXd::Ones(1, 3),
                     {single("first", std::nan(""), 1.0), single("second", 1.0, 1.0), single("third", 1.0, 1.0, -3.0)});
    EXPECT_EQ(message_of<InputError>([&] { (void)propagate(model, 0.95); }),
              "input group 'first' — estimate of quantity 1 is NaN — estimates must be finite — Correct the estimate.\n"
              "input group 'third' — degrees of freedom -3 — must be greater than 0 or infinite — "
              "Correct the value, or leave it out where it is infinite.");
    EXPECT_EQ(code_of<InputError>(
                  [] { (void)propagate(linear_model(Eigen::MatrixXd::Ones(1, 1), {single("x", 1, 1)}), 95.0); }),
              "GC-GUM-0004");
}

TEST(PropagationInput, SaysSoWhenTheModelHasNoFiniteResult) {
    FunctionModel model = linear_model(Eigen::MatrixXd::Ones(1, 1), {single("x", 0.0, 1.0)});
    model.derivative = [](const Eigen::VectorXd&) { return Eigen::MatrixXd::Constant(1, 1, k_infinity); };
    EXPECT_EQ(code_of<NoResultError>([&] { (void)propagate(model, 0.95); }), "GC-GUM-0056");
    EXPECT_EQ(message_of<NoResultError>([&] { (void)propagate(model, 0.95); }),
              "output 'y1' — the sensitivity coefficient for quantity 1 of input group 'x' is inf — the law of "
              "propagation needs a finite derivative at the estimates — The model cannot be made linear there: use the "
              "Monte Carlo method.");
    model.function = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x.cwiseInverse(); };
    EXPECT_EQ(code_of<NoResultError>([&] { (void)propagate(model, 0.95); }), "GC-GUM-0055");
    const FunctionModel huge = linear_model(Eigen::MatrixXd::Constant(1, 1, 1e200), {single("x", 1.0, 1e100)});
    EXPECT_EQ(code_of<NoResultError>([&] { (void)propagate(huge, 0.95); }), "GC-GUM-0057");
    FunctionModel wrong_size = linear_model(Eigen::MatrixXd::Ones(2, 1), {single("x", 1.0, 1.0)});
    wrong_size.function = [](const Eigen::VectorXd& x) { return x; };
    EXPECT_THROW((void)propagate(wrong_size, 0.95), std::logic_error);
}

/// y = x_1² + x_2²
FunctionModel sum_of_squares(double x1, double u, double r) {
    Eigen::Matrix2d V;
    V << u * u, r * u * u, r * u * u, u * u;
    FunctionModel model = linear_model(Eigen::MatrixXd::Ones(1, 2), {group("x", Eigen::Vector2d(x1, 0.0), V)});
    model.function = [](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, x.squaredNorm()); };
    model.derivative = [](const Eigen::VectorXd& x) -> Eigen::MatrixXd { return 2.0 * x.transpose(); };
    model.second_derivative = [](const Eigen::VectorXd&) {
        return std::vector<Eigen::MatrixXd>{2.0 * Eigen::Matrix2d::Identity()};
    };
    return model;
}

TEST(SecondOrder, SeesWhatTheFirstOrderDoesNot) {
    // JCGM 101:2008, 9.4: u = 0.005; first order 0 at x_1 = 0, where the analytical values are mean 50e-6, u 50e-6.
    const FunctionModel at_zero = sum_of_squares(0.0, 0.005, 0.0);
    const Propagation first = propagate(at_zero, 0.95);
    EXPECT_EQ(first.standard_uncertainty(0), 0.0);
    const auto second = propagate_to_second_order(at_zero, first);
    ASSERT_TRUE(second);
    EXPECT_TRUE(agrees(second->standard_uncertainty(0), 50e-6, 1e-12));
    EXPECT_TRUE(agrees(second->shift(0), 50e-6, 1e-12));
    // With r = 0.9 at x_1 = 0.010: mean 150e-6, u = √(4·1e-4·25e-6 + 4·25e-6²(1 + r²)/1 …) = 121e-6 as printed there.
    const FunctionModel correlated = sum_of_squares(0.010, 0.005, 0.9);
    const auto result = propagate_to_second_order(correlated, propagate(correlated, 0.95));
    ASSERT_TRUE(result);
    EXPECT_TRUE(prints_as(1e6 * result->standard_uncertainty(0), "121"));
    EXPECT_TRUE(agrees(correlated.function(Eigen::Vector2d(0.010, 0.0))(0) + result->shift(0), 150e-6, 1e-12));
}

TEST(SecondOrder, TakesThirdDerivativesIntoAccount) {
    // y = exp(x) at 0: to this order u² = u_x² + ½ u_x⁴ + u_x⁴.
    FunctionModel model = linear_model(Eigen::MatrixXd::Ones(1, 1), {single("x", 0.0, 0.1)});
    const auto exponential = [](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, std::exp(x(0))); };
    model.function = exponential;
    model.derivative = [=](const Eigen::VectorXd& x) -> Eigen::MatrixXd { return exponential(x); };
    model.second_derivative = [=](const Eigen::VectorXd& x) { return std::vector<Eigen::MatrixXd>{exponential(x)}; };
    const auto result = propagate_to_second_order(model, propagate(model, 0.95));
    ASSERT_TRUE(result);
    EXPECT_TRUE(agrees(result->standard_uncertainty(0), std::sqrt(0.01 + 1.5e-4), 1e-11));
    EXPECT_TRUE(agrees(result->shift(0), 0.005, 1e-12));
    EXPECT_FALSE(propagate_to_second_order(linear_model(Eigen::MatrixXd::Ones(1, 1), {single("x", 0.0, 0.1)}),
                                           propagate(model, 0.95)));
}

TEST(DegreesOfFreedom, CannotBeStatedWhereAGroupHasNone) {
    Eigen::Matrix2d V;
    V << 0.01, 0.005, 0.005, 0.01;
    InputGroup correlated = group("a, b", Eigen::Vector2d(1.0, 2.0), V, std::nan(""));
    correlated.no_degrees_of_freedom_because = "a has 5 and b has 8 degrees of freedom";
    Eigen::MatrixXd A(2, 3);
    A << 1.0, 1.0, 1.0, 0.0, 0.0, 1.0;
    const Propagation result = propagate(linear_model(A, {correlated, single("c", 3.0, 0.1, 4.0)}), 0.95);
    EXPECT_TRUE(agrees(result.standard_uncertainty(0), std::sqrt(0.04), 1e-14));
    EXPECT_TRUE(std::isnan(result.effective_degrees_of_freedom(0)));
    EXPECT_TRUE(std::isnan(result.coverage_factor(0)));
    EXPECT_TRUE(std::isnan(result.expanded_uncertainty(0)));
    EXPECT_TRUE(agrees(result.effective_degrees_of_freedom(1), 4.0, 1e-14));
}

TEST(DegreesOfFreedom, OfAComplexQuantity) {
    // Willink and Hall 2002, example 1: covariance matrices of the means of S11 and of G', four degrees of freedom
    // each; the difference has 6.85.
    Eigen::Matrix2d S;
    S << 0.1530e-3, -0.0797e-3, -0.0797e-3, 2.0947e-3;
    Eigen::Matrix2d G;
    G << 1.3175e-3 - 0.1530e-3, -0.7256e-3 + 0.0797e-3, -0.7256e-3 + 0.0797e-3, 2.9425e-3 - 2.0947e-3;
    Eigen::MatrixXd difference(2, 4);
    difference << Eigen::Matrix2d::Identity(), -Eigen::Matrix2d::Identity();
    const FunctionModel model = linear_model(
        difference, {group("G'", Eigen::Vector2d::Zero(), G, 4.0), group("S11", Eigen::Vector2d::Zero(), S, 4.0)});
    EXPECT_TRUE(prints_as(joint_effective_degrees_of_freedom(model, propagate(model, 0.95)), "6.85"));
}

TEST(DegreesOfFreedom, OfSeveralOutputsTogether) {
    Eigen::Matrix2d V;
    V << 4.0, 1.0, 1.0, 9.0;
    const FunctionModel one = linear_model(Eigen::Matrix2d::Identity(), {group("x", Eigen::Vector2d::Zero(), V, 7.0)});
    EXPECT_TRUE(agrees(joint_effective_degrees_of_freedom(one, propagate(one, 0.95)), 7.0, 1e-13));
    // Two groups that contribute alike with ν each: the matrix has 2 ν, as for one output.
    Eigen::MatrixXd sum(2, 4);
    sum << Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity();
    const FunctionModel two =
        linear_model(sum, {group("x", Eigen::Vector2d::Zero(), V, 7.0), group("z", Eigen::Vector2d::Zero(), V, 7.0)});
    EXPECT_TRUE(agrees(joint_effective_degrees_of_freedom(two, propagate(two, 0.95)), 14.0, 1e-13));
    const FunctionModel known = linear_model(Eigen::Matrix2d::Identity(), {group("x", Eigen::Vector2d::Zero(), V)});
    EXPECT_EQ(joint_effective_degrees_of_freedom(known, propagate(known, 0.95)), k_infinity);
}

// --- a covariance whose factor is known ---------------------------------------------------------------------------

constexpr double k_far = 1073741824.0;  // 2^30: products and sums below are exact

/// Slope b and value a at 0 of a line that is known best far away: L = [[1, 0], [−T, 1]]. What it says at T, a + T b, has
/// u = 1; T² + 1, the variance of a, has lost it.
InputGroup line_known_far_away(double nu = k_infinity) {
    Eigen::MatrixXd L(2, 2);
    L << 1.0, 0.0, -k_far, 1.0;
    InputGroup line = group("line", Eigen::Vector2d(0.0, 3.0), L * L.transpose(), nu);
    line.factor = L;
    return line;
}

TEST(PropagationFactor, KeepsTheUncertaintyThatTheCovarianceHasLost) {
    Eigen::MatrixXd A(3, 2);
    A << k_far, 1.0, 0.5 * k_far, 1.0, 0.0, 1.0;
    const Propagation result = propagate(linear_model(A, {line_known_far_away()}), 0.95);
    EXPECT_EQ(result.standard_uncertainty(0), 1.0);
    EXPECT_TRUE(agrees(result.standard_uncertainty(1), std::hypot(0.5 * k_far, 1.0), 1e-15));
    EXPECT_TRUE(agrees(result.covariance(0, 1), 1.0, 1e-12)) << "(0, 1) · (−T/2, 1)";
    InputGroup by_covariance = line_known_far_away();
    by_covariance.factor = {};
    EXPECT_NE(propagate(linear_model(A, {by_covariance}), 0.95).standard_uncertainty(0), 1.0);
}

TEST(PropagationFactor, GivesTheDegreesOfFreedomOfAllOutputs) {
    Eigen::MatrixXd A(2, 2);
    A << k_far, 1.0, 0.5 * k_far, 1.0;
    const FunctionModel one = linear_model(A, {line_known_far_away(7.0)});
    EXPECT_TRUE(agrees(joint_effective_degrees_of_freedom(one, propagate(one, 0.95)), 7.0, 1e-12));
}

TEST(PropagationFactor, IsTakenToSecondOrder) {
    // y = w² with w = a + T b = 3 and u(w) = 1: u² = (2 w)² + ½ (2·1)² (JCGM 100:2008, 5.1.2, note), shift 1.
    FunctionModel model = linear_model(Eigen::MatrixXd::Ones(1, 2), {line_known_far_away(), single("c", 0.0, 0.0)});
    const auto w = [](const Eigen::VectorXd& x) { return x(1) + k_far * x(0); };
    const Eigen::Vector3d slope(k_far, 1.0, 0.0);
    model.function = [=](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, w(x) * w(x)); };
    model.derivative = [=](const Eigen::VectorXd& x) -> Eigen::MatrixXd { return 2.0 * w(x) * slope.transpose(); };
    model.second_derivative = [=](const Eigen::VectorXd&) {
        return std::vector<Eigen::MatrixXd>{2.0 * slope * slope.transpose()};
    };
    const auto result = propagate_to_second_order(model, propagate(model, 0.95));
    ASSERT_TRUE(result);
    EXPECT_TRUE(agrees(result->standard_uncertainty(0), std::sqrt(38.0), 1e-12));
    EXPECT_TRUE(agrees(result->shift(0), 1.0, 1e-12));
}

TEST(PropagationFactor, HasTheSizeOfItsGroupAndIsLowerTriangular) {
    for (const Eigen::MatrixXd& wrong :
         {Eigen::MatrixXd(Eigen::MatrixXd::Ones(2, 2)), Eigen::MatrixXd(Eigen::MatrixXd::Identity(3, 2)),
          Eigen::MatrixXd(Eigen::MatrixXd::Identity(2, 3))}) {
        InputGroup line = line_known_far_away();
        line.factor = wrong;
        EXPECT_THROW((void)propagate(linear_model(Eigen::MatrixXd::Ones(1, 2), {line}), 0.95), std::logic_error);
    }
    InputGroup known = group("x", Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero());
    known.factor = Eigen::Matrix2d::Zero();
    EXPECT_EQ(propagate(linear_model(Eigen::MatrixXd::Ones(1, 2), {known}), 0.95).standard_uncertainty(0), 0.0);
}

// --- second order of inputs that are not normal ---------------------------------------------------------------------

/// y = f(x) of one input with f′ and f″.
FunctionModel curve(const Distribution& x, double u, const std::function<double(double)>& f,
                    const std::function<double(double)>& slope, const std::function<double(double)>& bend) {
    FunctionModel model = linear_model(Eigen::MatrixXd::Ones(1, 1), {single("x", expectation(x), u)});
    model.groups.front().marginals = {x};
    model.function = [=](const Eigen::VectorXd& at) { return Eigen::VectorXd::Constant(1, f(at(0))); };
    model.derivative = [=](const Eigen::VectorXd& at) { return Eigen::MatrixXd::Constant(1, 1, slope(at(0))); };
    model.second_derivative = [=](const Eigen::VectorXd& at) {
        return std::vector<Eigen::MatrixXd>{Eigen::MatrixXd::Constant(1, 1, bend(at(0)))};
    };
    return model;
}

TEST(SecondOrder, TakesTheMomentsOfInputsThatAreNotNormal) {
    const auto u_of = [](const FunctionModel& model) {
        const auto result = propagate_to_second_order(model, propagate(model, 0.95));
        return result ? result->standard_uncertainty(0) : -1.0;
    };
    const auto square = [](double x) { return x * x; };
    const auto twice = [](double x) { return 2.0 * x; };
    const auto two = [](double) { return 2.0; };
    // Variances of x²: E x⁴ − (E x²)². Uniform on −1 … 1: 1/5 − 1/9. Exponential: 4! − 2!².
    const Distribution uniform = Distribution::uniform(0.0, 1.0);
    const double u = 1.0 / std::sqrt(3.0);
    EXPECT_TRUE(agrees(u_of(curve(uniform, u, square, twice, two)), std::sqrt(4.0 / 45.0), 1e-12));
    const Distribution exponential{.kind = DistributionKind::exponential, .location = 0.0, .scale = 1.0};
    EXPECT_TRUE(agrees(u_of(curve(exponential, 1.0, square, twice, two)), std::sqrt(20.0), 1e-12));
    // x + x³ at 0, uniform: to the fourth order u² + 2 E x⁴ = 1/3 + 2/5.
    EXPECT_TRUE(agrees(u_of(curve(
                           uniform, u, [](double x) { return x + x * x * x; },
                           [](double x) { return 1.0 + 3.0 * x * x; }, [](double x) { return 6.0 * x; })),
                       std::sqrt(1.0 / 3.0 + 2.0 / 5.0), 1e-9));
    // A t counts as normal with its u, also where it has no kurtosis: ½ (2 u²)² of x² at 0.
    EXPECT_TRUE(agrees(u_of(curve(Distribution::student_t(0.0, 1.0, 3.0), 0.7, square, twice, two)),
                       std::sqrt(2.0) * 0.49, 1e-12));
    // A step that leaves the domain of the model says nothing: as of a normal input.
    const auto root = [&](const Distribution& x) {
        return u_of(curve(
            x, 0.1, [](double at) { return std::sqrt(at); }, [](double at) { return 0.5 / std::sqrt(at); },
            [](double at) { return -0.25 / (at * std::sqrt(at)); }));
    };
    EXPECT_EQ(root(Distribution::uniform(0.01, std::sqrt(0.03))), root(Distribution::normal(0.01, 0.1)));
}

TEST(SecondOrder, IsNoneWhereItLeavesTheRangeOfNumbers) {
    const FunctionModel model = curve(
        Distribution::normal(0.0, 1.0), 1.0, [](double x) { return x; }, [](double) { return 1.0; },
        [](double) { return 1e200; });
    EXPECT_FALSE(propagate_to_second_order(model, propagate(model, 0.95)));
}

TEST(PropagationInput, NamesUpToSixQuantitiesThatContradictEachOther) {
    // Eight quantities with r = −0.5 in pairs: the smallest eigenvalue is 1 − 7·0.5, of all alike.
    Eigen::MatrixXd V = Eigen::MatrixXd::Constant(8, 8, -0.5);
    V.diagonal().setOnes();
    std::string message = message_of<InputError>([&] {
        (void)propagate(linear_model(Eigen::MatrixXd::Ones(1, 8), {group("all", Eigen::VectorXd::Zero(8), V)}), 0.95);
    });
    EXPECT_NE(message.find("caused by quantity 1, quantity 2, quantity 3, quantity 4, quantity "
                           "5, quantity 6 —"),
              std::string::npos)
        << message;
    // Three of five that contradict each other.
    V = Eigen::MatrixXd::Identity(5, 5);
    for (const auto& [i, j] : {std::pair{1, 2}, std::pair{1, 4}, std::pair{2, 4}}) {
        V(i, j) = V(j, i) = -0.9;
    }
    message = message_of<InputError>([&] {
        (void)propagate(linear_model(Eigen::MatrixXd::Ones(1, 5), {group("some", Eigen::VectorXd::Zero(5), V)}), 0.95);
    });
    EXPECT_NE(message.find("caused by quantity 2, quantity 3, quantity 5 —"), std::string::npos) << message;
}

TEST(PropagationInput, SaysWhichSensitivityIsNotFinite) {
    FunctionModel model =
        linear_model(Eigen::MatrixXd::Ones(2, 3),
                     {single("x", 0.0, 1.0), group("pair", Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity())});
    model.derivative = [](const Eigen::VectorXd&) {
        Eigen::MatrixXd c = Eigen::MatrixXd::Ones(2, 3);
        c(1, 2) = std::nan("");
        return c;
    };
    EXPECT_EQ(message_of<NoResultError>([&] { (void)propagate(model, 0.95); }).substr(0, 88),
              "output 'y2' — the sensitivity coefficient for quantity 2 of input group 'pair' is NaN ");
    for (const auto& [rows, columns] : {std::pair{1, 3}, std::pair{2, 2}}) {
        model.derivative = [rows = rows, columns = columns](const Eigen::VectorXd&) -> Eigen::MatrixXd {
            return Eigen::MatrixXd::Ones(rows, columns);
        };
        EXPECT_THROW((void)propagate(model, 0.95), std::logic_error);
    }
}

TEST(DegreesOfFreedom, OfOutputsAmongWhichSomeHaveNoUncertainty) {
    // An output without uncertainty in a unit of its own, a diagonal group, and one that contributes to nothing.
    Eigen::MatrixXd A(2, 4);
    A << 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
    FunctionModel model = linear_model(A, {group("diagonal", Eigen::Vector2d::Zero(), Eigen::Vector2d(1.0, 4.0), 9.0),
                                           group("idle", Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity(), 3.0)});
    model.quantities[1].unit = "s";
    EXPECT_TRUE(agrees(joint_effective_degrees_of_freedom(model, propagate(model, 0.95)), 9.0, 1e-13));
}

}  // namespace
}  // namespace gumcert::gum
