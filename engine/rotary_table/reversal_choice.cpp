#include "engine/rotary_table/reversal_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Reversals of one error motion at all angles: values, and their covariance diag(own) + common commonᵀ.
struct Reversals {
    VectorXd value, own;
    MatrixXd common;  ///< N×r

    /// Sum of squares of the differences from one value of all angles in the metric of the covariance: chi-square of N
    /// - 1 degrees of freedom where there is one.
    [[nodiscard]] double chi_square_of_differences() const {
        // (D + B Bᵀ)⁻¹ = D⁻¹ − D⁻¹ B (1 + Bᵀ D⁻¹ B)⁻¹ Bᵀ D⁻¹: the N×N matrix is never formed.
        const VectorXd weight = own.cwiseInverse();
        const MatrixXd weighted = weight.asDiagonal() * common;
        const MatrixXd inner = MatrixXd::Identity(common.cols(), common.cols()) + common.transpose() * weighted;
        const Eigen::LLT<MatrixXd> factor(inner);
        const auto inverse_times = [&](const VectorXd& v) -> VectorXd {
            return weight.cwiseProduct(v) - weighted * factor.solve(weighted.transpose() * v);
        };
        // The one value of all angles is the weighted mean in the same metric; any other would leave a larger χ².
        const VectorXd ones = VectorXd::Ones(value.size());
        const VectorXd of_ones = inverse_times(ones);
        const double mean = of_ones.dot(value) / of_ones.dot(ones);
        const VectorXd difference = value.array() - mean;
        return std::max(0.0, difference.dot(inverse_times(difference)));
    }
    [[nodiscard]] double spread() const { return std::sqrt((value.array() - value.mean()).square().mean()); }
};

/// \param change  of the parameters from where they stand, p;
/// \param more  columns that add to the covariance, p×r
Reversals reversals_of(const JointAdjustment& by_angle, const NormalEquations& normal,
                       const BorderedCovariance& covariance, int motion, const VectorXd& change, const MatrixXd& more) {
    const std::size_t angles = by_angle.measurement().angles.size();
    const auto n = static_cast<Index>(angles);
    Reversals result{VectorXd(n), VectorXd(n), MatrixXd(n, covariance.border() + more.cols())};
    const int component = 6 + motion;
    for (std::size_t i = 0; i < angles; ++i) {
        const auto at = static_cast<Index>(i);
        const Index column = normal.column(by_angle.pose_block(i), component);
        const Index place = column - covariance.first_of(column);
        result.value[at] = by_angle.reversal(i)[motion] + change[column];
        result.own[at] = covariance.own(column)(place, place);
        result.common.row(at).head(covariance.border()) =
            covariance.elimination().row(column - covariance.border()) * covariance.border_root();
        result.common.row(at).tail(more.cols()) = more.row(column);
    }
    return result;
}

/// A drift of the distances of each station, linear in the time or in the order of its visits.
struct Drifts {
    VectorXd change;  ///< of the parameters, with the drifts estimated beside them, p
    MatrixXd spread;  ///< what this adds to their covariance: spread spreadᵀ, p×r
};

Drifts drifts_of(const JointAdjustment& adjustment, const NormalEquations& normal,
                 const BorderedCovariance& covariance) {
    // Linear only: a drift that is not may still be taken for a reversal, or hide one (ADR 0035).
    constexpr double k_separable = 1e-9;  // share of the weight of a drift that the parameters leave
    const RotaryTableMeasurement& measurement = adjustment.measurement();
    const std::vector<Visit>& visits = adjustment.visits();
    const auto stations = static_cast<Index>(measurement.stations.size());
    VectorXd time(static_cast<Index>(visits.size()));
    VectorXd sum = VectorXd::Zero(stations);
    VectorXd count = VectorXd::Zero(stations);
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const auto station = static_cast<Index>(visits[v].station);
        const std::size_t first = visits[v].observations.front();
        time[static_cast<Index>(v)] = measurement.times.empty() ? count[station] : measurement.times[first];
        sum[station] += time[static_cast<Index>(v)];
        count[station] += 1.0;
    }
    MatrixXd pull = MatrixXd::Zero(covariance.size(), stations);  // J'V⁻¹C
    VectorXd weight = VectorXd::Zero(stations);                   // C'V⁻¹C
    VectorXd by_residual = VectorXd::Zero(stations);              // C'V⁻¹v
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const auto station = static_cast<Index>(visits[v].station);
        const LinearisedGroup& group = normal.groups()[v];
        // About the mean of the station: a constant part is the dead path.
        const double at = time[static_cast<Index>(v)] - sum[station] / count[station];
        const VectorXd column =
            group.cholesky.triangularView<Eigen::Lower>().solve(VectorXd::Constant(group.residual.size(), at));
        const VectorXd part = group.jacobian.transpose() * column;
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            pull(group.columns[c], station) += part[static_cast<Index>(c)];
        }
        weight[station] += column.squaredNorm();
        by_residual[station] += column.dot(group.residual);
    }
    // Columns of unit length, so that what a drift has left of its own is a share.
    const VectorXd scale = (weight.array() > 0.0).select(weight.array().rsqrt(), 0.0);
    pull = (pull * scale.asDiagonal()).eval();
    MatrixXd by_drift(covariance.size(), stations);  // of the parameters
    for (Index j = 0; j < stations; ++j) {
        by_drift.col(j) = covariance.times(pull.col(j));
    }
    MatrixXd left = -(pull.transpose() * by_drift);
    left.diagonal() += weight.cwiseProduct(scale.cwiseAbs2());
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(0.5 * (left + left.transpose())));
    Drifts result{VectorXd::Zero(covariance.size()), MatrixXd::Zero(covariance.size(), 0)};
    // Of a drift that the parameters take up wholly nothing is left to be estimated.
    for (Index j = 0; j < stations; ++j) {
        if (eigen.eigenvalues()[j] > k_separable) {
            const VectorXd direction = by_drift * eigen.eigenvectors().col(j) / std::sqrt(eigen.eigenvalues()[j]);
            const double size =
                eigen.eigenvectors().col(j).dot(scale.cwiseProduct(by_residual)) / std::sqrt(eigen.eigenvalues()[j]);
            result.change -= size * direction;
            result.spread.conservativeResize(Eigen::NoChange, result.spread.cols() + 1);
            result.spread.rightCols<1>() = direction;
        }
    }
    return result;
}

/// Welch and Satterthwaite's degrees of freedom of the variance of the reversals of a motion: of what the repeatability
/// of the table adds to it by the visits of each sense, and of the rest, which is noise of the lengths.
double residual_degrees_of_freedom(const JointAdjustment& by_angle, const std::vector<VarianceComponent>& components,
                                   int motion, const VectorXd& own) {
    const int axial = 3 + axial_coordinate(by_angle.measurement().axis);
    const VarianceComponent& noise = components[length_noise];
    MatrixXd visits = MatrixXd::Zero(own.size(), 2);
    for (const Visit& visit : by_angle.visits()) {
        visits(static_cast<Index>(visit.angle), visit.approach == Approach::positive ? 0 : 1) += 1.0;
    }
    // The reversal is the difference of the means of both senses: σ² (1/n₊ + 1/n₋) of the table.
    const double by_variance = visits.cwiseInverse().rowwise().sum().cwiseQuotient(own).mean();
    // A translation of the origin across the axis holds the tilt of the table about the point that it acts at.
    const Eigen::Matrix<double, 1, 6> by_deviation = by_angle.pose_of_deviation().row(motion).cwiseAbs2();
    const std::array<std::pair<std::size_t, double>, 3> parts{
        {{table_linear, by_deviation.head<3>().sum()},
         {table_axial, by_deviation[axial]},
         {table_tilt, by_deviation.tail<3>().sum() - by_deviation[axial]}}};
    std::array<double, 3> shares{};
    double share = 0.0;  // of the table
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const double value = components[parts[k].first].value;
        shares[k] = parts[k].second * value * value * by_variance;
        share += shares[k];
    }
    const double most = std::max(1.0, share);
    double inverse = 0.0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const VarianceComponent& table = components[parts[k].first];
        if (table.estimated && shares[k] > 0.0) {
            inverse += std::pow(shares[k] / most, 2) / table.degrees_of_freedom;
        }
    }
    if (noise.estimated) {
        inverse += std::pow(1.0 - share / most, 2) / noise.degrees_of_freedom;
    }
    return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<ReversalTest> test_reversals(const JointAdjustment& by_angle, const NormalEquations& normal,
                                         const BorderedCovariance& covariance,
                                         const std::vector<VarianceComponent>& components,
                                         const std::function<double(double, double, double)>& fisher_upper_tail) {
    const RotaryTableMeasurement& measurement = by_angle.measurement();
    const Drifts drifts = drifts_of(by_angle, normal, covariance);
    std::vector<ReversalTest> tests;
    for (int motion = 0; motion < 6 && measurement.angles.size() > 1; ++motion) {
        const Reversals all = reversals_of(by_angle, normal, covariance, motion, drifts.change, drifts.spread);
        ReversalTest test;
        test.motion = static_cast<std::size_t>(motion);
        test.angles = static_cast<double>(measurement.angles.size() - 1);
        test.residual = residual_degrees_of_freedom(by_angle, components, motion, all.own);
        test.f = all.chi_square_of_differences() / test.angles;
        test.p_value = fisher_upper_tail(test.f, test.angles, test.residual);
        test.spread = all.spread();
        // Six motions are tested: the level is divided among them.
        test.depends_on_angle = test.p_value < k_reversal_test_level / 6.0;
        tests.push_back(test);
    }
    return tests;
}

bool may_depend_on_angle(const JointAdjustment& constant, const std::vector<bool>& active,
                         const StochasticModel& stochastic, double rank_tolerance,
                         const std::function<double(double, double)>& chi_square_upper_tail) {
    constexpr double k_worth_a_test = 0.01;  // probability of a sound measurement, each motion
    RotaryTableMeasurement measurement = constant.measurement();
    measurement.reversal = ReversalModel::by_angle;
    if (!constant.has_reversal() || measurement.angles.size() < 2) {
        return false;
    }
    JointAdjustment by_angle(measurement, active, constant.set_up(), constant.present_values(), stochastic);
    by_angle.adjustment().set_workers(constant.adjustment().workers());
    by_angle.copy_parameters_from(constant);
    by_angle.set_weights(stochastic);
    const NormalEquations normal = by_angle.adjustment().linearise();
    if (!by_angle.reversal_by_angle() || normal.rank(rank_tolerance).deficient) {
        return false;
    }
    const BorderedCovariance covariance = normal.bordered_covariance();
    // One Gauss-Newton step from the solution with one reversal: reversals are small, and the model is linear over
    // them.
    const VectorXd step = normal.step();
    const MatrixXd none(covariance.size(), 0);
    for (int motion = 0; motion < 6; ++motion) {
        const Reversals all = reversals_of(by_angle, normal, covariance, motion, step, none);
        if (chi_square_upper_tail(all.chi_square_of_differences(), static_cast<double>(all.value.size() - 1)) <
            k_worth_a_test) {
            return true;
        }
    }
    return false;
}

std::optional<gum::Diagnostic> reversal_note(const std::vector<ReversalTest>& tests,
                                             const RotaryTableMeasurement& measurement) {
    const ReversalTest* most = nullptr;
    for (const ReversalTest& test : tests) {
        if (test.depends_on_angle && (most == nullptr || test.p_value < most->p_value)) {
            most = &test;
        }
    }
    if (most == nullptr) {
        return std::nullopt;
    }
    const bool adopted = measurement.reversal == ReversalModel::automatic;
    const double unit = most->motion < 3 ? gum::k_micrometre : gum::k_arcsecond;
    const std::string what = "that of " + error_motion_names(measurement.axis)[most->motion] +
                             " depends on the angle: it varies by " + text::significant(most->spread / unit, 3) +
                             (most->motion < 3 ? " µm" : "″") +
                             " (root mean square) about its mean, test value F = " + text::significant(most->f, 3);
    const std::string rule =
        "one reversal holds for all angles unless the F tests of the six error motions refute it at "
        "0.1 % together";
    if (adopted) {
        return gum::Diagnostic{"GC-REVERSAL-0002",
                               "reversal",
                               what + "; every angle has its own, and the mean over the angles is reported",
                               rule,
                               "",
                               gum::Severity::note};
    }
    return gum::Diagnostic{"GC-REVERSAL-0002",
                           "reversal",
                           what +
                               "; the job asks for one of all angles, and what is left is in the repeatability of the "
                               "table",
                           rule,
                           "set \"reversal\" to \"auto\" or \"by_angle\"",
                           gum::Severity::warning};
}

}  // namespace gumcert::engine
