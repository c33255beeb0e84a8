#include "engine/adjustment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// y = a + b x at some x, of one block (a, b).
class LineModel final : public ObservationModel {
public:
    explicit LineModel(Eigen::VectorXd x) : x_(std::move(x)) {}
    void predict(const double* const* parameters, double* predicted, double* const* jacobians) const override {
        for (Eigen::Index i = 0; i < x_.size(); ++i) {
            predicted[i] = parameters[0][0] + parameters[0][1] * x_[i];
            if (jacobians != nullptr && jacobians[0] != nullptr) {
                jacobians[0][2 * i] = 1.0;
                jacobians[0][2 * i + 1] = x_[i];
            }
        }
    }

private:
    Eigen::VectorXd x_;
};

/// Slope times x plus the offset of a run, two blocks.
class RunModel final : public ObservationModel {
public:
    explicit RunModel(Eigen::VectorXd x) : x_(std::move(x)) {}
    void predict(const double* const* parameters, double* predicted, double* const* jacobians) const override {
        for (Eigen::Index i = 0; i < x_.size(); ++i) {
            predicted[i] = parameters[0][0] * x_[i] + parameters[0][1] * x_[i] * x_[i] + parameters[1][0];
            if (jacobians != nullptr && jacobians[0] != nullptr) {
                jacobians[0][2 * i] = x_[i];
                jacobians[0][2 * i + 1] = x_[i] * x_[i];
            }
            if (jacobians != nullptr && jacobians[1] != nullptr) {
                jacobians[1][i] = 1.0;
            }
        }
    }

private:
    Eigen::VectorXd x_;
};

/// Distances of a point of the plane from others.
class PointModel final : public ObservationModel {
public:
    explicit PointModel(Eigen::MatrixX2d from) : from_(std::move(from)) {}
    void predict(const double* const* parameters, double* predicted, double* const* jacobians) const override {
        const Eigen::Map<const Eigen::RowVector2d> point(parameters[0]);
        for (Eigen::Index i = 0; i < from_.rows(); ++i) {
            const Eigen::RowVector2d difference = point - from_.row(i);
            predicted[i] = difference.norm();
            if (jacobians != nullptr && jacobians[0] != nullptr) {
                Eigen::Map<Eigen::RowVector2d>(jacobians[0] + 2 * i) = difference / predicted[i];
            }
        }
    }

private:
    Eigen::MatrixX2d from_;
};

const Eigen::VectorXd k_line_x = (Eigen::VectorXd(5) << 0.0, 1.0, 2.0, 3.0, 4.0).finished();
const Eigen::VectorXd k_line_y = (Eigen::VectorXd(5) << 1.1, 2.9, 5.2, 6.8, 9.0).finished();

Adjustment::BlockId add_line(Adjustment& adjustment, const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                             const Eigen::MatrixXd& covariance) {
    const auto block = adjustment.add_parameters({"intercept", "slope"}, Eigen::Vector2d(0.0, 0.0));
    adjustment.add_observations(std::make_shared<LineModel>(x), {block}, y, covariance);
    return block;
}

// By hand, σ = 0.1: x̄ = 2, Sxx = 10, Sxy = 19.7, ȳ = 5; u²(b) = σ²/Sxx, u²(a) = σ²(1/5 + x̄²/Sxx).
TEST(LeastSquares, LineIsThatOfTheClosedForm) {
    Adjustment adjustment;
    const auto line = add_line(adjustment, k_line_x, k_line_y, 0.01 * Eigen::MatrixXd::Identity(5, 5));
    const SolveSummary summary = adjustment.solve({});
    EXPECT_TRUE(summary.converged) << summary.message;
    EXPECT_NEAR(adjustment.parameters(line)[1], 1.97, 1e-14);
    EXPECT_NEAR(adjustment.parameters(line)[0], 1.06, 1e-14);
    const Eigen::VectorXd residual = adjustment.residual(0);
    EXPECT_NEAR(residual[0], 1.1 - 1.06, 1e-14) << "observed minus predicted";
    EXPECT_NEAR(summary.chi_square, residual.squaredNorm() / 0.01, 1e-10);
    const NormalEquations normal = adjustment.linearise();
    const Eigen::MatrixXd covariance = normal.covariance();
    EXPECT_NEAR(covariance(1, 1), 0.01 / 10.0, 1e-16);
    EXPECT_NEAR(covariance(0, 0), 0.01 * (0.2 + 4.0 / 10.0), 1e-16);
    EXPECT_NEAR(covariance(0, 1), -0.01 * 2.0 / 10.0, 1e-16);
    EXPECT_EQ(normal.observation_count(), 5);
    EXPECT_EQ(normal.parameters()[1].name, "slope");
    EXPECT_NEAR(normal.chi_square(), summary.chi_square, 1e-10);
    EXPECT_LT(normal.step().cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_TRUE(adjustment.jacobian(0, line).col(1).isApprox(k_line_x));
}

TEST(LeastSquares, WeightsCorrelatedObservationsByTheirCovariance) {
    Eigen::MatrixXd V = 0.01 * Eigen::MatrixXd::Identity(5, 5) + 0.02 * Eigen::MatrixXd::Ones(5, 5);
    V(2, 2) += 0.05;
    V(0, 1) = V(1, 0) = 0.015;
    Adjustment adjustment;
    const auto line = add_line(adjustment, k_line_x, k_line_y, V);
    ASSERT_TRUE(adjustment.solve({}).converged);
    Eigen::MatrixXd design(5, 2);
    design << Eigen::VectorXd::Ones(5), k_line_x;
    const Eigen::MatrixXd weights = V.inverse();
    const Eigen::Matrix2d expected = (design.transpose() * weights * design).inverse();
    EXPECT_TRUE(adjustment.linearise().covariance().isApprox(expected, 1e-12));
    EXPECT_TRUE(adjustment.parameters(line).isApprox(expected * design.transpose() * weights * k_line_y, 1e-12));
    // The same observations with other weights, from where it is.
    adjustment.set_covariance(0, 0.01 * Eigen::MatrixXd::Identity(5, 5));
    ASSERT_TRUE(adjustment.refine({}).converged);
    EXPECT_NEAR(adjustment.parameters(line)[1], 1.97, 1e-14);
}

TEST(LeastSquares, PriorsAreObservationsAndHeldComponentsStay) {
    Adjustment adjustment;
    const auto line = add_line(adjustment, k_line_x, k_line_y, 0.01 * Eigen::MatrixXd::Identity(5, 5));
    // A prior slope as precise as that of the points: the mean of both, with half the variance.
    const auto prior =
        adjustment.add_prior(line, {1}, Eigen::VectorXd::Constant(1, 2.01), Eigen::MatrixXd::Constant(1, 1, 0.001));
    ASSERT_TRUE(adjustment.solve({}).converged);
    EXPECT_NEAR(adjustment.parameters(line)[1], 1.99, 1e-13);
    EXPECT_NEAR(adjustment.linearise().covariance()(1, 1), 0.0005, 1e-15);
    EXPECT_NEAR(adjustment.residual(prior)[0], 0.02, 1e-13);
    adjustment.set_parameters(line, Eigen::Vector2d(0.0, 2.0));
    adjustment.hold(line, 1);
    ASSERT_TRUE(adjustment.solve({}).converged);
    EXPECT_EQ(adjustment.parameters(line)[1], 2.0);
    EXPECT_NEAR(adjustment.parameters(line)[0], 5.0 - 2.0 * 2.0, 1e-13);
    const NormalEquations normal = adjustment.linearise();
    EXPECT_EQ(normal.parameter_count(), 1);
    EXPECT_EQ(normal.column(line, 1), -1);
    EXPECT_EQ(normal.first_column(line), 0);
}

TEST(LeastSquares, FindsAPointByItsDistances) {
    Eigen::MatrixX2d from(4, 2);
    from << 0.0, 0.0, 3.0, 0.0, 0.0, 4.0, 5.0, 5.0;
    const Eigen::Vector2d truth(1.0, 2.0);
    Adjustment adjustment;
    const auto point = adjustment.add_parameters({"x", "y"}, Eigen::Vector2d(2.5, 0.5));
    const Eigen::VectorXd distances = (from.rowwise() - truth.transpose()).rowwise().norm();
    adjustment.add_observations(std::make_shared<PointModel>(from), {point}, distances,
                                1e-8 * Eigen::MatrixXd::Identity(4, 4));
    const SolveSummary summary = adjustment.solve({});
    EXPECT_TRUE(summary.converged) << summary.message;
    EXPECT_LT((adjustment.parameters(point) - truth).norm(), 1e-14);
    EXPECT_LT(summary.chi_square, 1e-18);
    adjustment.set_observed(0, distances + Eigen::Vector4d(1e-3, 0.0, -1e-3, 0.0));
    NormalEquations last;
    ASSERT_TRUE(adjustment.refine({}, last).converged);
    EXPECT_GT((adjustment.parameters(point) - truth).norm(), 1e-4);
    EXPECT_LT(adjustment.linearise().step().norm(), 1e-10) << "no step is left";
    EXPECT_NEAR(last.chi_square(), adjustment.linearise().chi_square(), 1e-6 * last.chi_square());
}

/// Three runs with an offset each, eliminated, and a slope and a curvature of all.
struct RunsOfOneCurve {
    RunsOfOneCurve() {
        curve = adjustment.add_parameters({"slope", "curvature"}, Eigen::Vector2d::Zero());
        for (int run = 0; run < 3; ++run) {
            const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(4 + run, -1.0 + 0.3 * run, 2.0);
            const auto offset =
                adjustment.add_parameters({"offset " + std::to_string(run + 1)}, Eigen::VectorXd::Zero(1), true);
            const Eigen::VectorXd y = (3.0 * x.array() - 0.5 * x.array().square() + 10.0 * run + 0.1 * x.array().sin());
            const Eigen::MatrixXd covariance =
                0.04 * Eigen::MatrixXd::Identity(x.size(), x.size()) + 0.01 * Eigen::MatrixXd::Ones(x.size(), x.size());
            adjustment.add_observations(std::make_shared<RunModel>(x), {curve, offset}, y, covariance);
        }
    }
    Adjustment adjustment;
    Adjustment::BlockId curve = 0;
};

/// Jᵀ V⁻¹ J of all parameters, from the groups.
Eigen::MatrixXd normal_matrix_of(const NormalEquations& normal) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(normal.parameter_count(), normal.parameter_count());
    for (const LinearisedGroup& group : normal.groups()) {
        sum(group.columns, group.columns) += group.jacobian.transpose() * group.jacobian;
    }
    return sum;
}

TEST(NormalEquations, EliminationIsTheInverseOfTheWhole) {
    RunsOfOneCurve runs;
    ASSERT_TRUE(runs.adjustment.solve({}).converged);
    const NormalEquations normal = runs.adjustment.linearise();
    ASSERT_EQ(normal.parameter_count(), 5);
    ASSERT_EQ(normal.border_count(), 2);
    const Eigen::MatrixXd expected = normal_matrix_of(normal).inverse();
    const BorderedCovariance covariance = normal.bordered_covariance();
    EXPECT_EQ(covariance.size(), 5);
    EXPECT_EQ(covariance.border(), 2);
    EXPECT_TRUE(covariance.dense().isApprox(expected, 1e-12));
    EXPECT_TRUE(covariance.border_covariance().isApprox(expected.topLeftCorner(2, 2), 1e-12));
    EXPECT_TRUE((covariance.border_root() * covariance.border_root().transpose())
                    .isApprox(expected.topLeftCorner(2, 2), 1e-12));
    EXPECT_NEAR(covariance(4, 1), expected(4, 1), 1e-14);
    EXPECT_NEAR(covariance(4, 3), expected(4, 3), 1e-14) << "offsets of two runs, through the border";
    EXPECT_TRUE(covariance({3, 0}, {1, 4, 2}).isApprox(expected({3, 0}, {1, 4, 2}), 1e-12));
    const Eigen::MatrixXd rows = Eigen::MatrixXd::Random(2, 5);
    EXPECT_TRUE(covariance.times_left(rows).isApprox(rows * expected, 1e-12));
    const Eigen::VectorXd vector = Eigen::VectorXd::LinSpaced(5, -1.0, 3.0);
    EXPECT_TRUE(covariance.times(vector).isApprox(expected * vector, 1e-12));
    // C, F and W: covariance of an offset is F C Fᵀ + W.
    EXPECT_EQ(covariance.first_of(3), 3);
    const double offset = (covariance.elimination().row(1) * covariance.border_covariance() *
                           covariance.elimination().row(1).transpose())(0, 0) +
                          covariance.own(3)(0, 0);
    EXPECT_NEAR(offset, expected(3, 3), 1e-14);
}

TEST(NormalEquations, StepAndConditionAreThoseOfDenseAlgebra) {
    const RunsOfOneCurve runs;
    const NormalEquations normal = runs.adjustment.linearise();
    Eigen::Index rows = 0;
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(normal.observation_count(), normal.parameter_count());
    Eigen::VectorXd residual(normal.observation_count());
    for (const LinearisedGroup& group : normal.groups()) {
        const auto height = group.residual.size();
        jacobian.middleRows(rows, height)(Eigen::all, group.columns) = group.jacobian;
        residual.segment(rows, height) = group.residual;
        rows += height;
    }
    EXPECT_TRUE(
        normal.step().isApprox(jacobian.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(residual), 1e-10));
    const Eigen::VectorXd singular =
        (jacobian * jacobian.colwise().norm().cwiseInverse().asDiagonal()).jacobiSvd().singularValues();
    EXPECT_NEAR(normal.condition_number() * singular[4] / singular[0], 1.0, 1e-10);
    Adjustment moved = runs.adjustment;
    moved.apply(normal, normal.step());
    EXPECT_LT(moved.linearise().step().norm(), 1e-12) << "the model is linear: one step is all";
}

TEST(NormalEquations, NameWhatIsNotDetermined) {
    Adjustment adjustment;
    add_line(adjustment, Eigen::Vector3d::Constant(2.0), Eigen::Vector3d(1.0, 1.1, 0.9), Eigen::Matrix3d::Identity());
    const RankReport report = adjustment.linearise().rank(1e-12);
    EXPECT_TRUE(report.deficient);
    EXPECT_LT(report.smallest_to_largest, 1e-15);
    EXPECT_THAT(report.parameters, testing::ElementsAre("intercept", "slope"));
    EXPECT_TRUE(std::isinf(adjustment.linearise().condition_number()) ||
                adjustment.linearise().condition_number() > 1e7);

    try {
        (void)adjustment.linearise().covariance();
        FAIL() << "no failure";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-ADJUST-0002");
    }

    // A third parameter that no observation touches.
    Adjustment untouched;
    add_line(untouched, k_line_x, k_line_y, Eigen::MatrixXd::Identity(5, 5));
    untouched.add_parameters({"lost"}, Eigen::VectorXd::Zero(1));
    const RankReport lost = untouched.linearise().rank(1e-12);
    EXPECT_TRUE(lost.deficient);
    EXPECT_THAT(lost.parameters, testing::ElementsAre("lost"));
    EXPECT_FALSE(untouched.refine({}).converged);

    Adjustment whole;
    add_line(whole, k_line_x, k_line_y, Eigen::MatrixXd::Identity(5, 5));
    const RankReport determined = whole.linearise().rank(1e-12);
    EXPECT_FALSE(determined.deficient);
    EXPECT_TRUE(determined.parameters.empty());
    // Columns of unit length have the correlation r = 10/√(5·30): eigenvalues 1 ± r.
    const double r = 10.0 / std::sqrt(150.0);
    EXPECT_NEAR(determined.smallest_to_largest, (1.0 - r) / (1.0 + r), 1e-14);
}

// Its diagonal element is exactly zero: scaled, the equations are not a number, which a factor does not refuse.
TEST(NormalEquations, RefuseAParameterThatNothingObserves) {
    Adjustment adjustment;
    add_line(adjustment, Eigen::Vector3d::Zero(), Eigen::Vector3d(1.0, 1.1, 0.9), Eigen::Matrix3d::Identity());
    EXPECT_TRUE(adjustment.linearise().rank(1e-12).deficient);
    try {
        (void)adjustment.linearise().covariance();
        FAIL() << "no failure";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-ADJUST-0002");
    }
}

TEST(LeastSquares, RefusesACovarianceThatIsNone) {
    Adjustment adjustment;
    const auto line = adjustment.add_parameters({"intercept", "slope"}, Eigen::Vector2d::Zero());
    try {
        adjustment.add_observations(std::make_shared<LineModel>(Eigen::Vector2d(0.0, 1.0)), {line},
                                    Eigen::Vector2d::Zero(), Eigen::Matrix2d::Ones());
        FAIL() << "no failure";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-ADJUST-0001");
        EXPECT_EQ(error.diagnostics().front().action, "state standard uncertainties greater than 0");
    }
}

}  // namespace
}  // namespace gumcert::engine
