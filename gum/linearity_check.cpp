#include "gum/linearity_check.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "gum/nearest_turn.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/distribution_shape.h"

namespace gumcert::gum {

namespace {

constexpr Eigen::Index k_pairs = 64;
constexpr Eigen::Index k_end_pairs = 1024;
constexpr double k_accepted_end = 0.05;         // of U
constexpr double k_accepted_mean = 0.15;        // of u
constexpr double k_accepted_rms = 0.35;         // of u
constexpr double k_accepted_dispersion = 0.08;  // of the dispersion of the tangent
constexpr double k_roundings = 256.0;

/// Groups as the probes see them: where each begins, and the root of its covariance.
struct ProbedGroup {
    Eigen::Index first = 0;
    Eigen::MatrixXd covariance;   // n×n
    Eigen::MatrixXd root;         // n×n, root rootᵀ = covariance
    bool root_is_known = false;   // better than the covariance
    std::vector<Support> limits;  // one a quantity, or none
};

std::vector<ProbedGroup> probed_groups(const MeasurementModel& model) {
    std::vector<ProbedGroup> groups;
    Eigen::Index first = 0;
    for (const InputGroup& group : model.inputs()) {
        const Eigen::Index n = group.size();
        ProbedGroup probed;
        probed.first = first;
        first += n;
        if (group.is_diagonal() || n == 1) {
            const Eigen::VectorXd variance = group.covariance.col(0);
            probed.covariance = variance.asDiagonal();
            probed.root = variance.cwiseSqrt().asDiagonal();
        } else {
            probed.covariance = group.covariance;
            probed.root_is_known = group.factor.size() > 0;
            const Eigen::VectorXd u = group.covariance.diagonal().cwiseSqrt();
            // Eigenvectors, not Cholesky: a group with r = ±1 is singular and still has to be probed. Scaled to
            // correlations first, so that quantities of very different size keep their digits.
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation_matrix(group.covariance));
            probed.root = probed.root_is_known
                              ? group.factor
                              : Eigen::MatrixXd(u.asDiagonal() * eigen.eigenvectors() *
                                                eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal());
        }
        for (const Distribution& marginal : group.marginals) {
            probed.limits.push_back(support(marginal));
        }
        groups.push_back(std::move(probed));
    }
    return groups;
}

/// A number between −1 and 1 that two others stand for: SplitMix64 (Steele, Lea, Flood 2014).
double scattered(std::uint64_t pair, std::uint64_t input) {
    std::uint64_t z = (pair * 1'000'003U + input + 1U) * 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    z ^= z >> 31U;
    return static_cast<double>(z >> 11U) * 0x1p-52 - 1.0;
}

double kept_inside(double x, const Support& limits) {
    return std::min(std::max(x, limits.low), limits.high);
}

/// Keeps the inputs of a probe inside of the limits of their distributions.
void keep_inside(Eigen::Ref<Eigen::RowVectorXd> point, const std::vector<ProbedGroup>& groups) {
    for (const ProbedGroup& group : groups) {
        for (std::size_t i = 0; i < group.limits.size(); ++i) {
            double& x = point(group.first + static_cast<Eigen::Index>(i));
            // A point outside of the limits never occurs: the model may have no value there, and curvature there says
            // nothing.
            x = kept_inside(x, group.limits[i]);
        }
    }
}

/// Points x ± δ as the inputs scatter: bounded quantities evenly, others and correlated ones as normal ones.
Eigen::MatrixXd scattered_points(const Eigen::VectorXd& x, const std::vector<ProbedGroup>& groups) {
    constexpr std::uint64_t k_other_numbers = 0x5CA7;  // than the probes have
    constexpr double k_least_number = -1.0 + 0x1p-50;  // a normal quantity has no limit
    Eigen::MatrixXd points = x.transpose().replicate(2 * k_end_pairs, 1);
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;  // ADR 0058
    for (const ProbedGroup& group : groups) {
        const Eigen::Index size = group.root.rows();
        const bool is_diagonal = group.root.isDiagonal();
        Eigen::VectorXd s(size);
        Eigen::VectorXd off(size);
        for (Eigen::Index pair = 0; pair < k_end_pairs; ++pair) {
            const std::uint64_t number = k_other_numbers + static_cast<std::uint64_t>(pair);
            for (Eigen::Index i = 0; i < size; ++i) {
                const double r =
                    std::max(scattered(number, static_cast<std::uint64_t>(group.first + i)), k_least_number);
                // Limits of correlated quantities bound a body that a product of intervals does not describe; these are
                // probed as normal ones.
                const bool is_bounded = is_diagonal && static_cast<std::size_t>(i) < group.limits.size() &&
                                        std::isfinite(group.limits[static_cast<std::size_t>(i)].low) &&
                                        std::isfinite(group.limits[static_cast<std::size_t>(i)].high);
                // r is even on −1 … 1. √3 r has the variance 1 of a uniform quantity, √2 erf⁻¹(r) is the quantile of a
                // normal one.
                s(i) = is_bounded ? std::numbers::sqrt3 * r : std::numbers::sqrt2 * boost::math::erf_inv(r, InDouble());
            }
            off.noalias() = group.root * s;
            points.row(2 * pair).segment(group.first, size) += off.transpose();
            points.row(2 * pair + 1).segment(group.first, size) -= off.transpose();
        }
        for (std::size_t i = 0; i < group.limits.size(); ++i) {
            for (double& value : points.col(group.first + static_cast<Eigen::Index>(i))) {
                value = kept_inside(value, group.limits[i]);
            }
        }
    }
    return points;
}

/// How far the ends of the interval of a model are from those of its tangent at the same points.
/// \param values, tangent  one a point
double moved_ends(const Eigen::VectorXd& values, const Eigen::VectorXd& tangent, double coverage_probability) {
    constexpr std::size_t k_least_beyond = 8;
    std::vector<double> f;
    std::vector<double> t;
    for (Eigen::Index row = 0; row < values.size(); ++row) {
        if (std::isfinite(values(row))) {
            f.push_back(values(row));
            t.push_back(tangent(row));
        }
    }
    const auto beyond = std::max(k_least_beyond, static_cast<std::size_t>(0.5 * (1.0 - coverage_probability) *
                                                                          static_cast<double>(values.size())));
    if (f.size() <= 2 * beyond) {
        return 0.0;
    }
    // Model and tangent are sorted each for itself: what is reported are the ends of an interval, and which trial
    // stands at an end is of no interest. A bend that maps points onto each other may leave the ends where they are.
    std::sort(f.begin(), f.end());
    std::sort(t.begin(), t.end());
    const std::size_t last = f.size() - 1 - beyond;
    return std::max(std::abs(f[beyond] - t[beyond]), std::abs(f[last] - t[last]));
}

/// Values in rad, each with the number of full turns that brings it nearest to another one.
Eigen::VectorXd nearest_turns(const Eigen::VectorXd& values, const Eigen::VectorXd& to) {
    return values.binaryExpr(to, [](double angle, double near) { return nearest_turn(angle, near); });
}

/// Whether values leave a tangent by a full turn at once, as atan2 does at ±180°, and not as a steep curve does, whose
/// values lie on the way as well. Only of an angle that is known to less than half a turn.
bool leaps_by_turns(const Eigen::VectorXd& values, const Eigen::VectorXd& tangent, double expanded_uncertainty) {
    constexpr double k_half_a_turn = std::numbers::pi;
    constexpr Eigen::Index k_clearly_more = 4;
    const Eigen::ArrayXd off = (values - tangent).array().abs();
    const Eigen::Index leaps = (off > 1.5 * k_half_a_turn).count();
    const Eigen::Index on_the_way = (off > 0.5 * k_half_a_turn).count() - leaps;
    return expanded_uncertainty < k_half_a_turn && leaps > 0 && k_clearly_more * on_the_way <= leaps;
}

}  // namespace

std::vector<LinearityCheck> check_linearity(const MeasurementModel& model, const Propagation& propagation,
                                            std::span<const std::optional<double>> coverage_factor) {
    const Eigen::VectorXd x = input_estimates(model);
    const Eigen::Index n = x.size();
    const Eigen::Index m = propagation.value.size();
    const std::vector<ProbedGroup> groups = probed_groups(model);
    const auto factor = [&](Eigen::Index k) {
        const auto at = static_cast<std::size_t>(k);
        return at < coverage_factor.size() ? coverage_factor[at].value_or(2.0) : 2.0;
    };

    // Model against tangent at points that come in pairs x ± δ, scattered with the covariance of the inputs, and along
    // the direction in which each output moves most. The same points every time: a verdict must not depend on luck.
    // Second derivatives at one point would see neither a kink inside of ±U nor x³ at 0.
    Eigen::MatrixXd points = x.transpose().replicate(2 * k_pairs + 4 * m, 1);
    for (Eigen::Index pair = 0; pair < k_pairs; ++pair) {
        Eigen::VectorXd s(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            s(i) = std::numbers::sqrt3 * scattered(static_cast<std::uint64_t>(pair), static_cast<std::uint64_t>(i));
        }
        for (const ProbedGroup& group : groups) {
            const Eigen::Index size = group.root.rows();
            const Eigen::RowVectorXd off = (group.root * s.segment(group.first, size)).transpose();
            points.row(2 * pair).segment(group.first, size) += off;
            points.row(2 * pair + 1).segment(group.first, size) -= off;
        }
    }
    for (Eigen::Index k = 0; k < m; ++k) {
        const double u = propagation.standard_uncertainty(k);
        if (!(u > 0.0)) {
            continue;
        }
        // Along V cᵀ/u the tangent moves by just u for one step. It is the most probable way, for normal inputs, to
        // have moved by so much.
        const std::array<double, 4> steps{-factor(k), -1.0, 1.0, factor(k)};
        for (const ProbedGroup& group : groups) {
            const Eigen::Index size = group.root.rows();
            const Eigen::VectorXd c = propagation.jacobian.row(k).segment(group.first, size).transpose();
            const Eigen::RowVectorXd off =
                (group.root_is_known ? Eigen::VectorXd(group.root * (group.root.transpose() * c))
                                     : Eigen::VectorXd(group.covariance * c))
                    .transpose() /
                u;
            for (std::size_t s = 0; s < steps.size(); ++s) {
                points.row(2 * k_pairs + 4 * k + static_cast<Eigen::Index>(s)).segment(group.first, size) +=
                    steps[s] * off;
            }
        }
    }
    for (Eigen::Index row = 0; row < points.rows(); ++row) {
        Eigen::RowVectorXd point = points.row(row);
        keep_inside(point, groups);
        points.row(row) = point;
    }
    Eigen::MatrixXd y(points.rows(), m);
    model.evaluate_trials(points, y);
    // The tangent at the points as they are after the limits: what a limit cuts off is no curvature.
    const Eigen::MatrixXd tangent = ((points.rowwise() - x.transpose()) * propagation.jacobian.transpose()).rowwise() +
                                    propagation.value.transpose();

    const Eigen::MatrixXd scatter = scattered_points(x, groups);
    Eigen::MatrixXd y_scatter(scatter.rows(), m);
    model.evaluate_trials(scatter, y_scatter);
    const Eigen::MatrixXd tangent_scatter =
        ((scatter.rowwise() - x.transpose()) * propagation.jacobian.transpose()).rowwise() +
        propagation.value.transpose();

    /// \param f, f_scatter  values of the output at the probes, and as the inputs scatter
    const auto checked = [&](Eigen::Index k, const Eigen::VectorXd& f, const Eigen::VectorXd& f_scatter) {
        LinearityCheck check;
        const double u = propagation.standard_uncertainty(k);
        double size = std::abs(propagation.value(k));
        for (Eigen::Index i = 0; i < n; ++i) {
            size = std::max(size, std::abs(propagation.jacobian(k, i) * x(i)));
        }
        // Where large terms cancel, the difference of model and tangent is rounding and no curvature.
        const double rounding = k_roundings * std::numeric_limits<double>::epsilon() * size;
        double mean = 0.0;
        double square = 0.0;
        double of_model = 0.0;
        double of_tangent = 0.0;
        double count = 0.0;
        for (Eigen::Index row = 0; row < 2 * k_pairs; row += 2) {
            // Pairs x ± δ count only with both points. In the mean of a pair all odd terms cancel, the tangent first of
            // all; a single point would leave its own.
            if (!std::isfinite(f(row)) || !std::isfinite(f(row + 1))) {
                continue;
            }
            for (Eigen::Index one = row; one < row + 2; ++one) {
                const double residual = f(one) - tangent(one, k);
                mean += residual;
                square += residual * residual;
                of_model += (f(one) - propagation.value(k)) * (f(one) - propagation.value(k));
                of_tangent += (tangent(one, k) - propagation.value(k)) * (tangent(one, k) - propagation.value(k));
                count += 1.0;
            }
        }
        if (count > 0.0) {
            mean /= count;
            const double rms = std::sqrt(square / count);
            check.spread = std::sqrt(of_model / count);
            // The dispersion of f is taken about its own mean, that of the tangent about y: a shift of the mean is
            // judged by itself, and is no dispersion.
            const double variance = std::max(0.0, of_model / count - mean * mean);
            const double ratio = of_tangent > 0.0 ? std::sqrt(variance / (of_tangent / count)) : 1.0;
            check.adequate = std::abs(mean) <= k_accepted_mean * u + rounding && rms <= k_accepted_rms * u + rounding &&
                             (std::abs(ratio - 1.0) <= k_accepted_dispersion || rms <= rounding);
        }
        if (!(u > 0.0)) {
            return check;
        }
        for (Eigen::Index s = 0; s < 4; ++s) {
            const Eigen::Index row = 2 * k_pairs + 4 * k + s;
            const double residual = f(row) - tangent(row, k);
            // An end where the model has no value lies outside of its domain: an interval ±U reaches where no measurand
            // is.
            if (!std::isfinite(residual)) {
                check.end_deviation = std::numeric_limits<double>::infinity();
            } else {
                check.end_deviation = std::max(check.end_deviation, std::abs(residual));
            }
        }
        const double accepted = k_accepted_end * factor(k) * u + rounding;
        check.adequate = check.adequate && check.end_deviation <= accepted &&
                         moved_ends(f_scatter, tangent_scatter.col(k), propagation.coverage_probability) <= accepted;
        return check;
    };
    std::vector<LinearityCheck> checks;
    for (Eigen::Index k = 0; k < m; ++k) {
        checks.push_back(checked(k, y.col(k), y_scatter.col(k)));
        if (checks.back().adequate || model.outputs()[static_cast<std::size_t>(k)].unit != "rad") {
            continue;
        }
        // An angle that leaps by a full turn, as atan2 does at ±180°, is the same angle: its values are taken as near to
        // the tangent as turns bring them. One that is bent as well leaps all the same: its trials would fill the circle.
        LinearityCheck turned = checked(k, nearest_turns(y.col(k), tangent.col(k)),
                                        nearest_turns(y_scatter.col(k), tangent_scatter.col(k)));
        if (turned.adequate ||
            leaps_by_turns(y_scatter.col(k), tangent_scatter.col(k), factor(k) * propagation.standard_uncertainty(k))) {
            turned.leaps = true;
            checks.back() = turned;
        }
    }
    return checks;
}

double linear_skewness(const MeasurementModel& model, const Propagation& propagation, Eigen::Index output) {
    const double u = propagation.standard_uncertainty(output);
    if (!(u > 0.0)) {
        return 0.0;
    }
    double sum = 0.0;
    Eigen::Index column = 0;
    for (const InputGroup& group : model.inputs()) {
        // Symmetric inputs have the skewness 0. Of correlated ones the joint third moments are not known: only inputs
        // of their own count.
        if (group.marginals.size() == 1 && !is_symmetric(group.marginals.front())) {
            // Third cumulants of independent inputs add up: γ(y) = Σ (c u/u(y))³ γ_i.
            const double part = propagation.jacobian(output, column) * std::sqrt(group.covariance(0, 0)) / u;
            if (part != 0.0) {
                sum += part * part * part * skewness(group.marginals.front());
            }
        }
        column += group.size();
    }
    return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

}  // namespace gumcert::gum
