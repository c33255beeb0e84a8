// What grows with the angles in proportion gives the numbers of the dense algebra that it stands for.
#include "engine/rotary_table/anglewise_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "engine/rotary_table/contact_point_model.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/studies/measurement_plan.h"
#include "engine/rotary_table/table_parameters.h"
#include "engine/rotary_table/variance_components.h"
#include "gum/quantity/dense_factors.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

constexpr double k_equal = 1e-9;
constexpr int k_angles = 12;

/// Jᵀ V⁻¹ J with all its elements, added up from the groups.
Eigen::MatrixXd dense_normal(const NormalEquations& normal) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(normal.parameter_count(), normal.parameter_count());
    for (const LinearisedGroup& group : normal.groups()) {
        sum(group.columns, group.columns) += group.jacobian.transpose() * group.jacobian;
    }
    return sum;
}

/// Inverse of a symmetric positive definite matrix, scaled to a unit diagonal and refined once.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) {
    const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
    const Eigen::Index size = matrix.rows();
    Eigen::MatrixXd inverse = Eigen::LLT<Eigen::MatrixXd>(scaled).solve(Eigen::MatrixXd::Identity(size, size));
    inverse = (inverse + inverse * (Eigen::MatrixXd::Identity(size, size) - scaled * inverse)).eval();
    return scale.asDiagonal() * inverse * scale.asDiagonal();
}

/// ∂errors/∂poses with all its (6N)² elements: I + D K, the rows of the zero angle zero.
Eigen::MatrixXd dense_error_map(const DatumSolution& datum) {
    const Eigen::Index size = datum.motion_map.rows();
    Eigen::MatrixXd map = Eigen::MatrixXd::Identity(size, size) + datum.motion_map * datum.change_map();
    if (datum.zero_angle) {
        map.middleRows<6>(6 * *datum.zero_angle).setZero();
    }
    return map;
}

/// Derivatives of the reported quantities with respect to the free parameters, from the dense error map.
Eigen::MatrixXd dense_map(const JointAdjustment& adjustment, const NormalEquations& normal,
                          const DatumSolution& datum) {
    const auto angles = static_cast<Eigen::Index>(adjustment.measurement().angles.size());
    const Eigen::MatrixXd errors = dense_error_map(datum);
    Eigen::MatrixXd map =
        Eigen::MatrixXd::Zero(6 * angles + 4 + (adjustment.has_reversal() ? 6 : 0), normal.parameter_count());
    for (Eigen::Index i = 0; i < 6 * angles; ++i) {
        const auto block = adjustment.pose_block(static_cast<std::size_t>(i / 6));
        if (const Eigen::Index column = normal.column(block, static_cast<int>(i % 6)); column >= 0) {
            map.col(column).head(6 * angles) = errors.col(i);
            map.col(column).segment<4>(6 * angles) = datum.set_up_map.col(i);
        }
    }
    for (int c = 0; c < 6 && adjustment.has_reversal(); ++c) {
        for (Eigen::Index i = 0; i < (adjustment.reversal_by_angle() ? angles : 0); ++i) {
            map(6 * angles + 4 + c, normal.column(adjustment.pose_block(static_cast<std::size_t>(i)), 6 + c)) =
                1.0 / static_cast<double>(angles);
        }
        if (!adjustment.reversal_by_angle()) {
            map(6 * angles + 4 + c, normal.column(adjustment.reversal_block(), c)) = 1.0;
        }
    }
    return map;
}

/// Largest deviation of two matrices in units of the standard uncertainties (or norms) of their rows and columns.
double deviation(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& rows,
                 const Eigen::VectorXd& columns) {
    double largest = 0.0;
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
        for (Eigen::Index i = 0; i < b.rows(); ++i) {
            const double scale = rows[i] * columns[j];
            const double difference = std::abs(a(i, j) - b(i, j));
            largest = std::max(largest, scale > 0.0 ? difference / scale : difference == 0.0 ? 0.0 : 1.0);
        }
    }
    return largest;
}

enum class Paths { per_station, per_station_and_reflector };
enum class Senses { one, both, both_by_angle };
using Case = std::tuple<RotaryAxis, Datum, Senses, Paths>;

class LinearGrowth : public testing::TestWithParam<Case> {
protected:
    void SetUp() override {
        const auto& [axis, datum, senses, paths] = GetParam();
        CampaignPlan plan;
        plan.axis = axis;
        plan.datum = datum;
        plan.home = 2;
        plan.angles_deg = synthetic::full_turn(k_angles);
        plan.both_senses = senses != Senses::one;
        plan.reversal_model = senses == Senses::both_by_angle ? ReversalModel::by_angle : ReversalModel::constant;
        plan.dead_paths = paths == Paths::per_station ? synthetic::DeadPaths::per_station
                                                      : synthetic::DeadPaths::per_station_and_reflector;
        plan.missing_share = 0.05;
        plan.scale_model = ScaleModel::prior;
        plan.u_scale = 1.5e-7;
        plan.temperature_difference = 0.2;
        plan.u_temperature = 0.027;
        plan.expansion = 11.5e-6;
        plan.u_expansion = 5e-7;
        plan.table_linear = 0.2e-6;
        plan.table_axial = 2e-6;
        plan.table_tilt = 1e-6;
        plan.start_values = true;
        campaign_ = synthetic::simulate(plan);
        campaign_.measurement.table_repeatability.mode = RepeatabilityMode::given;
        solution_ = evaluate_jointly(campaign_.measurement, EvaluationOptions{});
        model_ = std::dynamic_pointer_cast<const RotaryTableModel>(solution_.model);
    }

    /// The solved adjustment with its dead paths free, as it was evaluated.
    [[nodiscard]] JointAdjustment joint() const {
        const JointAdjustment& solved = model_->solved();
        JointAdjustment result(solved.measurement(), solved.active(), solved.set_up(), solved.present_values(),
                               solution_.stochastic);
        result.copy_parameters_from(solved);
        result.set_weights(solution_.stochastic);
        return result;
    }

    Campaign campaign_;
    RotaryTableSolution solution_;
    std::shared_ptr<const RotaryTableModel> model_;
};

TEST_P(LinearGrowth, TheBorderedCovarianceIsTheInverseOfTheNormalEquations) {
    const NormalEquations normal = joint().adjustment().linearise();
    const Eigen::MatrixXd expected = inverse_of(dense_normal(normal));
    const Eigen::VectorXd u = expected.diagonal().cwiseSqrt();
    const BorderedCovariance bordered = normal.bordered_covariance();
    const Eigen::Index p = normal.parameter_count();
    ASSERT_EQ(bordered.size(), p);
    EXPECT_LT(deviation(bordered.dense(), expected, u, u), k_equal);
    const Eigen::MatrixXd dense = bordered.dense();
    std::vector<Eigen::Index> all;
    for (Eigen::Index i = 0; i < p; ++i) {
        all.push_back(i);
    }
    EXPECT_LT(deviation(bordered(all, all), dense, u, u), 1e-10) << "only the order of the sums differs";
    EXPECT_EQ(bordered(all, all), bordered(all, all).transpose());
    EXPECT_LT(deviation(bordered.border_root() * bordered.border_root().transpose(), bordered.border_covariance(),
                        u.head(bordered.border()), u.head(bordered.border())),
              1e-12);
    synthetic::Noise noise(3);
    Eigen::MatrixXd rows(3, p);
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
        rows(i) = noise.normal() / u[i / 3];
    }
    const Eigen::MatrixXd product = rows * dense;
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(3) * std::sqrt(static_cast<double>(p));
    EXPECT_LT(deviation(bordered.times_left(rows), product, ones, u), 1e-10);
    EXPECT_LT(deviation(bordered.times(rows.row(1).transpose()), product.row(1).transpose(), u, ones.head(1)), 1e-10);
}

TEST_P(LinearGrowth, CovarianceOfTheReportedQuantitiesIsThatOfTheDenseMaps) {
    const JointAdjustment adjustment = joint();
    const NormalEquations normal = adjustment.adjustment().linearise();
    const DatumSolution& datum = solution_.datum;
    const Eigen::MatrixXd map = dense_map(adjustment, normal, datum);
    const AnglewiseMap structured = reported_map(adjustment, normal, datum);
    ASSERT_EQ(structured.rows(), map.rows());
    EXPECT_EQ(structured.per_angle(), 6);
    const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(map.rows(), map.rows());
    EXPECT_LT((structured.combined(all, adjustment, normal) - map).cwiseAbs().maxCoeff(),
              1e-13 * map.cwiseAbs().maxCoeff());
    const Eigen::MatrixXd expected = map * inverse_of(dense_normal(normal)) * map.transpose();
    const Eigen::VectorXd u = expected.diagonal().cwiseSqrt();
    const AnglewiseCovariance covariance = covariance_of(structured, adjustment, normal, normal.bordered_covariance());
    ASSERT_EQ(covariance.rows(), expected.rows());
    const Eigen::MatrixXd dense = covariance.dense();
    EXPECT_EQ(dense, dense.transpose());
    EXPECT_LT(deviation(dense, expected, u, u), k_equal);
    EXPECT_LT(deviation(solution_.covariance.dense(), expected, u, u), k_equal);
    const Eigen::VectorXd diagonal = covariance.diagonal();
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        EXPECT_NEAR(diagonal[i], expected(i, i), k_equal * expected(i, i)) << i;
        const Eigen::Index other = (7 * i + 3) % covariance.rows();
        EXPECT_NEAR(covariance(i, other), expected(i, other), k_equal * u[i] * u[other]) << i;
    }
    for (Eigen::Index i = 0; i < k_angles; ++i) {
        EXPECT_LT(deviation(covariance.of_angle(i), expected.block<6, 6>(6 * i, 6 * i), u.segment<6>(6 * i),
                            u.segment<6>(6 * i)),
                  k_equal);
    }
    if (std::get<1>(GetParam()) == Datum::home) {
        EXPECT_EQ(covariance.of_angle(2), Eigen::MatrixXd::Zero(6, 6));
        EXPECT_EQ(dense.middleRows<6>(12), Eigen::MatrixXd::Zero(6, dense.cols()));
    }
}

TEST_P(LinearGrowth, CovarianceOfBothSensesIsThatOfTheDenseMaps) {
    if (std::get<2>(GetParam()) != Senses::both_by_angle) {
        return;  // the senses have no parameters of their own
    }
    const JointAdjustment adjustment = joint();
    const NormalEquations normal = adjustment.adjustment().linearise();
    const Eigen::MatrixXd of_errors = dense_map(adjustment, normal, solution_.datum);
    Eigen::MatrixXd map(12 * k_angles, of_errors.cols());
    for (Eigen::Index i = 0; i < k_angles; ++i) {
        for (Eigen::Index c = 0; c < 12; ++c) {
            map.row(12 * i + c) = of_errors.row(6 * i + c % 6);
            map(12 * i + c, normal.column(adjustment.pose_block(static_cast<std::size_t>(i)),
                                          6 + static_cast<int>(c % 6))) += c < 6 ? 0.5 : -0.5;
        }
    }
    const Eigen::MatrixXd expected = map * inverse_of(dense_normal(normal)) * map.transpose();
    const Eigen::VectorXd u = expected.diagonal().cwiseSqrt();
    const AnglewiseMap structured = map_of_both_senses(reported_map(adjustment, normal, solution_.datum));
    const AnglewiseCovariance covariance = covariance_of(structured, adjustment, normal, normal.bordered_covariance());
    EXPECT_EQ(structured.per_angle(), 12);
    EXPECT_LT(deviation(covariance.dense(), expected, u, u), k_equal);
}

TEST_P(LinearGrowth, SensitivityOfTheReportedQuantitiesIsThatOfTheDenseMaps) {
    const JointAdjustment adjustment = joint();
    const NormalEquations normal = adjustment.adjustment().linearise();
    const BorderedCovariance bordered = normal.bordered_covariance();
    const AnglewiseMap structured = reported_map(adjustment, normal, solution_.datum);
    const AnglewiseSensitivity sensitivity(structured, adjustment, normal, bordered);
    const Eigen::MatrixXd gain = dense_map(adjustment, normal, solution_.datum) * inverse_of(dense_normal(normal));
    const auto expected_of = [&](const LinearisedGroup& group) -> Eigen::MatrixXd {
        const Eigen::MatrixXd whitened = gain(Eigen::all, group.columns) * group.jacobian.transpose();
        return group.cholesky.triangularView<Eigen::Lower>().transpose().solve(whitened.transpose()).transpose();
    };
    for (std::size_t v = 0; v < adjustment.visits().size(); ++v) {
        const AnglewiseSensitivity::OfVisit of = sensitivity.of_visit(v);
        ASSERT_EQ(of.angle, static_cast<Eigen::Index>(adjustment.visits()[v].angle));
        Eigen::MatrixXd found = sensitivity.shared() * of.shared;
        found.middleRows<6>(6 * of.angle) += of.own;
        const Eigen::MatrixXd expected = expected_of(normal.groups()[v]);
        for (Eigen::Index i = 0; i < found.rows(); ++i) {
            EXPECT_LT((found.row(i) - expected.row(i)).norm(), 1e-6 * expected.row(i).norm() + 1e-18) << v << ' ' << i;
        }
    }
    const Eigen::MatrixXd prior = sensitivity.shared() * sensitivity.of_prior(adjustment.fixture_prior());
    const Eigen::MatrixXd expected = expected_of(normal.groups()[adjustment.fixture_prior()]);
    EXPECT_LT((prior - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
}

TEST_P(LinearGrowth, TheMapsOfTheDatumAreThoseOfTheDenseMap) {
    const DatumSolution& datum = solution_.datum;
    const Eigen::MatrixXd map = dense_error_map(datum);
    const Eigen::MatrixXd right = Eigen::MatrixXd::Random(map.cols(), 5);
    EXPECT_LT((datum.carried(right) - map * right).cwiseAbs().maxCoeff(), 1e-13);
    const Eigen::MatrixXd left = Eigen::MatrixXd::Random(5, map.rows());
    EXPECT_LT((datum.pulled_back(left) - left * map).cwiseAbs().maxCoeff(), 1e-13);
    // The S-transformation is a projection: what is in the datum already stays.
    EXPECT_LT((map * map - map).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(LinearGrowth, ConditionNumberIsThatOfTheDenseEigenvalues) {
    const NormalEquations normal = joint().adjustment().linearise();
    const Eigen::MatrixXd full = dense_normal(normal);
    const Eigen::VectorXd scale = full.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        Eigen::MatrixXd(scale.asDiagonal() * full * scale.asDiagonal()), Eigen::EigenvaluesOnly);
    const double expected = std::sqrt(eigen.eigenvalues()[full.rows() - 1] / eigen.eigenvalues()[0]);
    // Dense eigenvalues know the smallest one to 1e-16 of the largest only, times the condition number squared.
    EXPECT_NEAR(normal.condition_number() / expected, 1.0, 1e-14 * expected * expected);
    EXPECT_LT(1e-14 * expected * expected, 1e-5);
}

TEST_P(LinearGrowth, VarianceComponentsAreThoseOfTheDenseTraces) {
    const JointAdjustment adjustment = joint();
    const NormalEquations normal = adjustment.adjustment().linearise();
    const BorderedCovariance bordered = normal.bordered_covariance();
    const VarianceComponentStep step =
        estimate_variance_components(adjustment, normal, bordered, solution_.stochastic, {true, true, true});

    // R = V⁻¹ - V⁻¹ J Q Jᵀ V⁻¹ over all observations, and tr(R V_k R V_l), tr(R V_k), vᵀ V⁻¹ V_k V⁻¹ v as they stand.
    Eigen::Index count = 0;
    for (const LinearisedGroup& group : normal.groups()) {
        count += group.residual.size();
    }
    const Eigen::MatrixXd covariance = bordered.dense();
    Eigen::MatrixXd whitened = Eigen::MatrixXd::Zero(count, normal.parameter_count());
    Eigen::MatrixXd inverse_root = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd residual(count);
    std::vector<Eigen::MatrixXd> derivatives(5, Eigen::MatrixXd::Zero(count, count));
    const int axial = 3 + axial_coordinate(campaign_.measurement.axis);
    Eigen::Index first = 0;
    for (std::size_t g = 0; g < normal.groups().size(); ++g) {
        const LinearisedGroup& group = normal.groups()[g];
        const Eigen::Index n = group.residual.size();
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            whitened.block(first, group.columns[c], n, 1) = group.jacobian.col(static_cast<Eigen::Index>(c));
        }
        inverse_root.block(first, first, n, n) =
            group.cholesky.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(n, n));
        residual.segment(first, n) = group.residual;
        if (g < adjustment.visits().size()) {
            derivatives[0].block(first, first, n, n) = adjustment.stated_variance(g).asDiagonal();
            const Eigen::MatrixXd pose = adjustment.repeatability_jacobian(g);
            for (int c = 0; c < 6; ++c) {
                const std::size_t k = c < 3 ? 1 : c == axial ? 2 : 3;
                derivatives[k].block(first, first, n, n) += pose.col(c) * pose.col(c).transpose();
            }
        } else if (g == adjustment.fixture_prior()) {
            derivatives[4].block(first, first, n, n) = campaign_.measurement.fixture_covariance;
        }
        first += n;
    }
    const Eigen::MatrixXd projector =
        inverse_root.transpose() *
        (Eigen::MatrixXd::Identity(count, count) - whitened * covariance * whitened.transpose()) * inverse_root;
    const Eigen::VectorXd weighted = inverse_root.transpose() * residual;
    Eigen::MatrixXd fisher(5, 5);
    Eigen::VectorXd score(5);
    Eigen::VectorXd theta(5);
    const StochasticModel& present = solution_.stochastic;
    theta << present.length_factor, present.variance_linear, present.variance_axial, present.variance_tilt,
        present.fixture_factor;
    std::vector<Eigen::MatrixXd> products;
    for (std::size_t k = 0; k < 5; ++k) {
        products.emplace_back(projector * derivatives[k]);
        score[static_cast<Eigen::Index>(k)] = weighted.dot(derivatives[k] * weighted) - products[k].trace();
    }
    for (std::size_t k = 0; k < 5; ++k) {
        for (std::size_t l = 0; l < 5; ++l) {
            fisher(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) =
                products[k].cwiseProduct(products[l].transpose()).sum();
        }
    }
    const Eigen::VectorXd scale = fisher.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::VectorXd next =
        theta + scale.asDiagonal() *
                    Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(scale.asDiagonal() * fisher * scale.asDiagonal()))
                        .solve(scale.asDiagonal() * score);
    ASSERT_GT(next.minCoeff(), 0.0) << "the case is to be free of bounds";
    const std::array<double, 5> found{step.stochastic.length_factor, step.stochastic.variance_linear,
                                      step.stochastic.variance_axial, step.stochastic.variance_tilt,
                                      step.stochastic.fixture_factor};
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(found[k] / next[static_cast<Eigen::Index>(k)], 1.0, 1e-7) << k;
    }
}

TEST_P(LinearGrowth, LawOfPropagationWithDenseAndWithStructuredAlgebraAgree) {
    // V of the reported quantities from the Jacobian over all inputs, which the gain by structure makes.
    const Eigen::VectorXd x = gum::input_estimates(*model_);
    const Eigen::MatrixXd table = model_->jacobian(x);
    Eigen::MatrixXd propagated = Eigen::MatrixXd::Zero(table.rows(), table.rows());
    Eigen::Index first = 0;
    for (const gum::InputGroup& group : model_->inputs()) {
        const auto part = table.middleCols(first, group.size());
        propagated += group.is_diagonal()
                          ? Eigen::MatrixXd(part * group.covariance.col(0).asDiagonal() * part.transpose())
                          : Eigen::MatrixXd(part * group.covariance * part.transpose());
        first += group.size();
    }
    const Eigen::VectorXd u = solution_.covariance.diagonal().cwiseSqrt();
    EXPECT_LT(deviation(propagated, solution_.covariance.dense(), u, u), 1e-7);

    // A contact point: ∂D = displacement · (∂errors on the axis average line).
    const Eigen::Vector3d point(0.02, -0.03, 0.15);
    const ContactPointModel contact(model_, campaign_.measurement, solution_.datum, point);
    const DatumSolution average = transform_to_datum(campaign_.measurement, solution_.datum.errors,
                                                     rigid_motion(solution_.datum.set_up), Datum::axis_average_line);
    const Eigen::MatrixXd errors = dense_error_map(average) * table.topRows(6 * k_angles);
    Eigen::MatrixXd expected(3 * k_angles, table.cols());
    for (Eigen::Index i = 0; i < k_angles; ++i) {
        expected.middleRows<3>(3 * i) = point_displacement(point) * errors.middleRows<6>(6 * i);
    }
    const Eigen::MatrixXd found = contact.jacobian(x);
    for (Eigen::Index j = 0; j < found.cols(); ++j) {
        EXPECT_LT((found.col(j) - expected.col(j)).norm(), k_equal * expected.col(j).norm() + 1e-18) << j;
    }
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
    const auto& [axis, datum, senses, paths] = info.param;
    return std::string(1, "ABC"[axial_coordinate(axis)]) + (datum == Datum::home ? "_home" : "_average") +
           (senses == Senses::one    ? "_one"
            : senses == Senses::both ? "_both"
                                     : "_by_angle") +
           (paths == Paths::per_station ? "_station" : "_pair");
}

INSTANTIATE_TEST_SUITE_P(AllDatums, LinearGrowth,
                         testing::Combine(testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                                          testing::Values(Datum::home, Datum::axis_average_line),
                                          testing::Values(Senses::one, Senses::both, Senses::both_by_angle),
                                          testing::Values(Paths::per_station, Paths::per_station_and_reflector)),
                         case_name);

}  // namespace
}  // namespace gumcert::engine
