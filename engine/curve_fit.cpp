#include "engine/curve_fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

// Sums and factorisations keep 64 bits of mantissa on x86-64: the certified digits of ill-conditioned polynomials need
// them. Where long double is double, the results stay right to fewer digits.
using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr Real k_double_epsilon = std::numeric_limits<double>::epsilon();
constexpr Real k_offset_wanted = 1e-13L;   // polishing goes on to here
constexpr Real k_offset_accepted = 1e-9L;  // and a result is given from here
constexpr Real k_same_minimum = 1e-7L;     // sums of squares that differ by less, relatively, are one minimum
constexpr int k_descent_iterations = 5000;
constexpr int k_polish_iterations = 500;

/// The decimal number that a double was read from: its shortest digits, with the precision that sums are kept in. Data
/// are written in decimal; a polynomial of the tenth degree turns the rounding to double into lost digits of its
/// parameters.
Real decimal(double value) {
    std::array<char, 32> buffer{};
    const std::to_chars_result end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    Real result = value;
    std::from_chars(buffer.data(), end.ptr, result);
    return result;
}

Vector decimals(const Eigen::VectorXd& values) {
    Vector result(values.size());
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        result[i] = decimal(values[i]);
    }
    return result;
}

std::string size_text(Eigen::Index rows, Eigen::Index columns) {
    return std::to_string(rows) + " × " + std::to_string(columns);
}

gum::Diagnostic diagnostic(std::string code, std::string where, std::string what, std::string rule,
                           std::string action) {
    return {.code = std::move(code),
            .where = std::move(where),
            .what = std::move(what),
            .rule = std::move(rule),
            .action = std::move(action)};
}

/// Covariance of n values, diagonal or full, with its factor V = L Lᵀ.
class Spread {
public:
    explicit Spread(Vector variances) : variances_(std::move(variances)) {}
    explicit Spread(Matrix covariance) : covariance_(std::move(covariance)) { factor_.compute(covariance_); }

    [[nodiscard]] bool is_diagonal() const { return covariance_.size() == 0; }

    /// L⁻¹ M
    template <typename Rows>
    [[nodiscard]] Rows whitened(const Rows& matrix) const {
        if (is_diagonal()) {
            return variances_.cwiseSqrt().cwiseInverse().asDiagonal() * matrix;
        }
        return factor_.matrixL().solve(matrix);
    }

    /// V⁻¹ v
    [[nodiscard]] Vector weighted(const Vector& values) const {
        if (is_diagonal()) {
            return values.cwiseQuotient(variances_);
        }
        return factor_.solve(values);
    }

    /// V v
    [[nodiscard]] Vector times(const Vector& values) const {
        if (is_diagonal()) {
            return values.cwiseProduct(variances_);
        }
        return covariance_ * values;
    }

    /// Lᵀ M
    [[nodiscard]] Matrix by_root(const Matrix& matrix) const {
        if (is_diagonal()) {
            return variances_.cwiseSqrt().asDiagonal() * matrix;
        }
        return factor_.matrixU() * matrix;
    }

    /// V + F X F with F diagonal: the spread of y − f(x) when x has the spread X.
    [[nodiscard]] Spread with_slope(const Vector& slope, const Spread& x) const {
        if (is_diagonal() && x.is_diagonal()) {
            return Spread(Vector(variances_ + slope.cwiseAbs2().cwiseProduct(x.variances_)));
        }
        return Spread(Matrix(full() + slope.asDiagonal() * x.full() * slope.asDiagonal()));
    }

private:
    [[nodiscard]] Matrix full() const { return is_diagonal() ? Matrix(variances_.asDiagonal()) : covariance_; }

    Vector variances_;
    Matrix covariance_;
    // A factor of nothing where the covariance is diagonal: one that never computed is copied with what memory held.
    Eigen::LLT<Matrix> factor_{Matrix(0, 0)};
};

/// Orthogonal factorisation of a design matrix whose columns are scaled to unit length.
class Factorisation {
public:
    /// \param damping  rows that pull the step to zero are added: √damping times scale, one a parameter
    explicit Factorisation(const Matrix& design, Real damping = 0.0L, const Vector& damping_scale = {})
        : rows_(design.rows()), scale_(design.colwise().norm()) {
        // A column of zeros stays one: its parameter is named later as not determined.
        scale_ = (scale_.array() > 0.0L).select(scale_, 1.0L).eval();
        if (damping > 0.0L) {
            // A damped column has the length of its derivatives or that of its damping, whichever is larger.
            scale_ = scale_.cwiseMax(std::sqrt(damping) * damping_scale).eval();
            Matrix extended(rows_ + design.cols(), design.cols());
            extended.topRows(rows_) = design;
            extended.bottomRows(design.cols()) = (std::sqrt(damping) * damping_scale).asDiagonal();
            scaled_ = extended * scale_.cwiseInverse().asDiagonal();
        } else {
            scaled_ = design * scale_.cwiseInverse().asDiagonal();
        }
        qr_.setThreshold(std::numeric_limits<Real>::epsilon() * static_cast<Real>(scaled_.rows()));
        qr_.compute(scaled_);
    }

    /// Step that minimises ‖r − J δ‖, with one step of refinement.
    [[nodiscard]] Vector solve(const Vector& residual) const {
        Vector right = Vector::Zero(scaled_.rows());
        right.head(rows_) = residual;
        Vector step = qr_.solve(right);
        // One step of refinement makes good what the factorisation lost by rounding.
        step += qr_.solve(Vector(right - scaled_ * step));
        return step.cwiseQuotient(scale_);
    }

    /// Singular values, largest first, and the direction of the smallest, of the scaled design.
    [[nodiscard]] std::pair<Vector, Vector> singular_values() const {
        const Eigen::Index p = scaled_.cols();
        const Matrix r = qr_.matrixR().topRows(p).template triangularView<Eigen::Upper>();
        const Eigen::JacobiSVD<Matrix> svd(r, Eigen::ComputeFullV);
        return {svd.singularValues(), qr_.colsPermutation() * Vector(svd.matrixV().col(p - 1))};
    }

    /// F with F Fᵀ = (JᵀJ)⁻¹
    // From R⁻¹ of the factorisation. JᵀJ would square the condition number, and half the digits would be gone before
    // the inversion.
    [[nodiscard]] Matrix cofactor_root() const {
        const Eigen::Index p = scaled_.cols();
        Matrix inverse = Matrix::Identity(p, p);
        qr_.matrixR().topRows(p).template triangularView<Eigen::Upper>().solveInPlace(inverse);
        return scale_.cwiseInverse().asDiagonal() * (qr_.colsPermutation() * inverse);
    }

private:
    Eigen::Index rows_;
    Vector scale_;
    Matrix scaled_;
    Eigen::ColPivHouseholderQR<Matrix> qr_;
};

/// Where a search stands: parameters, and abscissae when these are uncertain (n = 0 otherwise).
struct State {
    Eigen::VectorXd parameters;
    Eigen::VectorXd abscissae;
};

/// The problem about one state.
struct Linearised {
    bool finite = false;
    Matrix by_parameter;  // n×p
    Vector slope;         // n, ∂f/∂x; uncertain x only
    Vector residual;      // n, y − f
    Vector reduced;       // n, y − f − slope (x − ξ); y − f with exact x
    Spread spread{Vector()};
    Matrix design;         // n×p, whitened by spread
    Vector right;          // n, reduced, whitened by spread
    Real sum = 0.0L;       // sum of squares of the whole problem
    Real rounding = 0.0L;  // what the rounding of f and of the parameters makes of the length of a step
};

struct Step {
    Vector parameters;
    Vector abscissae;
    Real length = 0.0L;  // of the whitened change of all observations that it predicts
};

/// How a search ended.
struct Attempt {
    State state;
    Linearised at;
    Real offset = std::numeric_limits<Real>::infinity();  // length of the next step
    bool converged = false;
    int iterations = 0;
};

class Problem {
public:
    Problem(const Curve& curve, const CurveData& data, Eigen::Index parameters, Spread y_spread,
            std::optional<Spread> x_spread)
        : curve_(curve),
          data_(data),
          n_(data.y.size()),
          p_(parameters),
          y_(decimals(data.y)),
          y_spread_(std::move(y_spread)),
          x_spread_(std::move(x_spread)) {}

    [[nodiscard]] Eigen::Index n() const { return n_; }
    [[nodiscard]] Eigen::Index p() const { return p_; }
    [[nodiscard]] bool uncertain_x() const { return x_spread_.has_value(); }
    [[nodiscard]] const Spread& y_spread() const { return y_spread_; }
    [[nodiscard]] const Vector& y() const { return y_; }

    [[nodiscard]] State begin(Eigen::VectorXd parameters) const {
        return {std::move(parameters), uncertain_x() ? Eigen::VectorXd(data_.x.col(0)) : Eigen::VectorXd()};
    }

    /// Residual standard deviation that belongs to a sum of squares; 0 where no degree of freedom is left.
    [[nodiscard]] Real spread_of(Real sum) const {
        return n_ > p_ ? std::sqrt(sum / static_cast<Real>(n_ - p_)) : 0.0L;
    }

    [[nodiscard]] Linearised linearise(const State& state) const {
        Linearised result;
        result.by_parameter.resize(n_, p_);
        result.residual.resize(n_);
        result.slope = Vector::Zero(uncertain_x() ? n_ : 0);
        Eigen::VectorXd x(data_.x.cols());
        Eigen::VectorXd by_parameter(p_);
        Eigen::VectorXd by_x(data_.x.cols());
        for (Eigen::Index i = 0; i < n_; ++i) {
            x = data_.x.row(i).transpose();
            if (uncertain_x()) {
                x[0] = state.abscissae[i];
            }
            const double value = curve_.evaluate(x, state.parameters, by_parameter, by_x);
            // A search meets such a point as a wall: the step is refused and shortened.
            if (!std::isfinite(value) || !by_parameter.allFinite() || (uncertain_x() && !by_x.allFinite())) {
                return result;
            }
            result.residual[i] = y_[i] - static_cast<Real>(value);
            result.by_parameter.row(i) = by_parameter.transpose().cast<Real>();
            if (uncertain_x()) {
                result.slope[i] = by_x[0];
            }
        }
        const Vector white = y_spread_.whitened(result.residual);
        result.sum = white.squaredNorm();
        result.reduced = result.residual;
        result.spread = y_spread_;
        // Errors in both variables: linearised about ξ, y − f(ξ) − F (x − ξ) has the covariance V_y + F V_x Fᵀ. So n
        // further unknowns are eliminated, and the system stays of the size of p.
        if (uncertain_x()) {
            const Vector shift = data_.x.col(0).cast<Real>() - state.abscissae.cast<Real>();
            result.sum += x_spread_->whitened(shift).squaredNorm();
            result.reduced -= result.slope.cwiseProduct(shift);
            result.spread = y_spread_.with_slope(result.slope, *x_spread_);
        }
        result.design = result.spread.whitened(result.by_parameter);
        result.right = result.spread.whitened(result.reduced);
        // What a computation in double can tell at all: 4 ε of the terms that the residuals are differences of. A step
        // that is shorter means nothing.
        const Vector magnitude =
            y_.cwiseAbs() + result.by_parameter.cwiseAbs() * state.parameters.cast<Real>().cwiseAbs();
        result.rounding = result.spread.whitened(magnitude).norm();
        if (uncertain_x()) {
            result.rounding += x_spread_->whitened(Vector(state.abscissae.cast<Real>().cwiseAbs())).norm();
        }
        result.rounding *= 4.0L * k_double_epsilon;
        result.finite = std::isfinite(result.sum) && result.design.allFinite() && result.right.allFinite() &&
                        std::isfinite(result.rounding);
        return result;
    }

    /// Columns of the design that are powers of the only regressor, again from its decimal digits.
    /// \pre exact x
    // With powers of the doubles 7.6 digits of the NIST set Filip are left, because its data are decimal numbers
    // (docs/accuracy.md#fits-of-curves).
    void sharpen_powers(Linearised& at) const {
        if (data_.x.cols() != 1) {
            return;
        }
        constexpr int k_highest_power = 30;
        const Vector x = decimals(data_.x.col(0));
        for (Eigen::Index j = 0; j < p_; ++j) {
            Vector power = Vector::Ones(n_);
            for (int k = 0; k <= k_highest_power; ++k) {
                // A column counts as a power of x where it is one within its rounding to double. So no curve has to say
                // what it is made of.
                const Vector difference = (at.by_parameter.col(j) - power).cwiseAbs();
                const Real rounding = 2.0L * static_cast<Real>(k + 1) * k_double_epsilon;
                if ((difference.array() <= rounding * power.cwiseAbs().array()).all()) {
                    at.by_parameter.col(j) = power;
                    break;
                }
                power = power.cwiseProduct(x);
            }
        }
        at.design = at.spread.whitened(at.by_parameter);
    }

    /// Gauss–Newton step, damped in the parameters.
    [[nodiscard]] Step step(const State& state, const Linearised& at, Real damping, const Vector& scale) const {
        Step step;
        step.parameters = Factorisation(at.design, damping, scale).solve(at.right);
        const Vector change = at.by_parameter * step.parameters;
        if (!uncertain_x()) {
            step.length = y_spread_.whitened(change).norm();
            return step;
        }
        // The abscissae are eliminated: given the step of the parameters, theirs is η = X F V⁻¹ ê beside x − ξ.
        const Vector left = at.reduced - change;
        step.abscissae = data_.x.col(0).cast<Real>() - state.abscissae.cast<Real>() +
                         x_spread_->times(at.slope.cwiseProduct(at.spread.weighted(left)));
        const Real in_x = x_spread_->whitened(step.abscissae).norm();
        const Real in_y = y_spread_.whitened(Vector(change + at.slope.cwiseProduct(step.abscissae))).norm();
        step.length = std::hypot(in_x, in_y);
        return step;
    }

    [[nodiscard]] State moved(const State& state, const Step& step) const {
        State result;
        result.parameters = (state.parameters.cast<Real>() + step.parameters).cast<double>();
        if (uncertain_x()) {
            result.abscissae = (state.abscissae.cast<Real>() + step.abscissae).cast<double>();
        }
        return result;
    }

    /// Damped Gauss–Newton (Levenberg–Marquardt) down to where sums of squares no longer tell one state from the next.
    /// \param damping   to begin with
    /// \param longest   scale the damping by the longest column met (after Moré), not by the present one
    /// \param curvature follow the curvature along the step (geodesic acceleration, after Transtrum and Sethna) and
    ///                  refuse a step that bends too much; exact x only
    int descend(State& state, Real damping, bool longest, bool curvature) const {
        Linearised at = linearise(state);
        Vector scale = Vector::Zero(p_);
        int iterations = 0;
        while (at.finite && iterations < k_descent_iterations && damping < 1e24L) {
            ++iterations;
            const Vector length = at.design.colwise().norm().transpose();
            // Scaled by the longest column met, a parameter whose derivative fades away far from the minimum gets no
            // long steps.
            scale = longest ? Vector(scale.cwiseMax(length)) : length;
            const Vector safe = (scale.array() > 0.0L).select(scale, 1.0L);
            Step trial = step(state, at, damping, safe);
            if (trial.length <= 1e-7L * std::sqrt(at.sum) && damping <= 1e-3L) {
                break;
            }
            if (curvature && !uncertain_x() && !accelerate(state, at, damping, safe, trial)) {
                damping *= 10.0L;
                continue;
            }
            const State next = moved(state, trial);
            if (!next.parameters.allFinite()) {
                break;
            }
            Linearised there = linearise(next);
            if (there.finite && there.sum < at.sum) {
                const bool settled = at.sum - there.sum <= 1e-15L * at.sum;
                state = next;
                at = std::move(there);
                damping = std::max(damping / 10.0L, 1e-15L);
                if (settled) {
                    break;
                }
            } else {
                damping *= 10.0L;
            }
        }
        return iterations;
    }

    /// Gauss–Newton steps, damped only where they do not shorten the next one. The sum of squares is flat to rounding
    /// about a minimum and cannot tell the last half of the digits; the length of the next step can.
    [[nodiscard]] Attempt polish(State start) const {
        Attempt attempt;
        attempt.state = std::move(start);
        attempt.at = linearise(attempt.state);
        if (!attempt.at.finite) {
            return attempt;
        }
        Vector scale = attempt.at.design.colwise().norm().transpose();
        scale = (scale.array() > 0.0L).select(scale, 1.0L).eval();
        attempt.offset = step(attempt.state, attempt.at, 0.0L, scale).length;
        // Converged is what moves no parameter by more than a part of its standard uncertainty, or what rounding hides.
        const auto reached = [&](Real wanted) {
            return attempt.offset <= std::max(wanted * spread_of(attempt.at.sum), attempt.at.rounding);
        };
        const std::array<Real, 7> dampings{0.0L, 1e-4L, 1e-2L, 1e-1L, 1.0L, 10.0L, 100.0L};
        bool moving = true;
        // One step is always tried after the wanted offset is reached: it costs nothing and gives the last digits.
        for (int extra = 0; moving && extra < 2 && attempt.iterations < k_polish_iterations;) {
            if (reached(k_offset_wanted)) {
                ++extra;
            }
            moving = false;
            for (const Real damping : dampings) {
                const State next = moved(attempt.state, step(attempt.state, attempt.at, damping, scale));
                if (!next.parameters.allFinite()) {
                    continue;
                }
                Linearised there = linearise(next);
                // Near the minimum the sum may grow by its rounding although the step is right.
                if (!there.finite || there.sum > attempt.at.sum * (1.0L + 1e-9L) + there.rounding * there.rounding) {
                    continue;
                }
                const Real offset = step(next, there, 0.0L, scale).length;
                // An undamped step has to gain a tenth: near the minimum it gains much more. A smaller gain is no
                // convergence.
                if (offset < (damping == 0.0L ? 0.9L : 0.999L) * attempt.offset) {
                    attempt.state = next;
                    attempt.at = std::move(there);
                    attempt.offset = offset;
                    moving = true;
                    break;
                }
            }
            ++attempt.iterations;
        }
        attempt.converged = reached(k_offset_accepted);
        return attempt;
    }

private:
    /// Adds the second-order part of a step. False where that is not small beside the first-order part.
    [[nodiscard]] bool accelerate(const State& state, const Linearised& at, Real damping, const Vector& scale,
                                  Step& step) const {
        constexpr Real k_part = 0.1L;  // of the step, over which the second derivative is taken
        constexpr Real k_most = 0.75L;
        Step small;
        small.parameters = k_part * step.parameters;
        const Linearised near = linearise(moved(state, small));
        if (!near.finite) {
            return false;
        }
        // y − f is at hand, so signs are those of −f: f″ along the step, from f at both ends and f′ at one.
        const Vector second = (2.0L / k_part) * ((at.right - near.right) / k_part - at.design * step.parameters);
        const Vector correction = Factorisation(at.design, damping, scale).solve(Vector(-0.5L * second));
        if (!correction.allFinite() ||
            2.0L * correction.cwiseProduct(scale).norm() > k_most * step.parameters.cwiseProduct(scale).norm()) {
            return false;
        }
        step.parameters += correction;
        return true;
    }

    const Curve& curve_;
    const CurveData& data_;
    Eigen::Index n_;
    Eigen::Index p_;
    Vector y_;
    Spread y_spread_;
    std::optional<Spread> x_spread_;
};

/// The whitened residuals for Ceres, in parameters that are scaled so that every column has unit length at the start:
/// its thresholds then mean the same in every unit.
class ScaledCost final : public ceres::CostFunction {
public:
    ScaledCost(const Problem& problem, Eigen::VectorXd scale, Real divisor)
        : problem_(problem), scale_(std::move(scale)), divisor_(divisor) {
        set_num_residuals(static_cast<int>(problem.n()));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.p()));
    }

    bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
        const Eigen::Map<const Eigen::VectorXd> scaled(parameters[0], problem_.p());
        const Linearised at = problem_.linearise(State{scaled.cwiseProduct(scale_), {}});
        if (!at.finite) {
            return false;
        }
        Eigen::Map<Eigen::VectorXd>(residuals, problem_.n()) = (-at.right / divisor_).cast<double>();
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
                jacobians[0], problem_.n(), problem_.p());
            jacobian = (at.design / divisor_).cast<double>() * scale_.asDiagonal();
            return jacobian.allFinite();
        }
        return true;
    }

private:
    const Problem& problem_;
    Eigen::VectorXd scale_;
    Real divisor_;
};

/// One search by Ceres, x exact. The state is moved to where it ended, converged or not.
int search(const Problem& problem, State& state, ceres::TrustRegionStrategyType strategy, double radius) {
    // A library does not print: its failures are in the outcome. Once, as fits may run in several threads.
    [[maybe_unused]] static const bool is_quiet = (FLAGS_minloglevel = google::GLOG_FATAL, true);
    const Linearised at = problem.linearise(state);
    const Real length = std::sqrt(at.sum);
    const Real divisor = length > 0.0L ? length : 1.0L;
    Eigen::VectorXd scale(problem.p());
    for (Eigen::Index k = 0; k < scale.size(); ++k) {
        const Real norm = at.design.col(k).norm() / divisor;
        // A parameter without an effect at the start has no length of its own: its size stands in.
        scale[k] = norm > 0.0L ? static_cast<double>(1.0L / norm) : std::max(1.0, std::abs(state.parameters[k]));
    }
    if (!scale.allFinite() || !(scale.minCoeff() > 0.0)) {
        return 0;
    }
    Eigen::VectorXd values = state.parameters.cwiseQuotient(scale);

    ceres::Problem ceres_problem;
    ceres_problem.AddResidualBlock(new ScaledCost(problem, scale, divisor), nullptr, values.data());
    // Every tolerance is set. The search ends by the sum of squares alone; convergence is judged by the polish.
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.dense_linear_algebra_library_type = ceres::EIGEN;
    options.trust_region_strategy_type = strategy;
    options.dogleg_type = ceres::TRADITIONAL_DOGLEG;
    options.initial_trust_region_radius = radius;
    options.max_trust_region_radius = 1e16;
    options.min_trust_region_radius = 1e-32;
    options.min_relative_decrease = 1e-3;
    options.min_lm_diagonal = 1e-20;
    options.max_lm_diagonal = 1e32;
    options.max_num_iterations = k_descent_iterations;
    options.max_num_consecutive_invalid_steps = 50;
    options.function_tolerance = 1e-15;
    options.gradient_tolerance = 1e-300;
    options.parameter_tolerance = 1e-300;
    options.jacobi_scaling = true;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.minimizer_progress_to_stdout = false;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_problem, &summary);
    if (values.allFinite()) {
        state.parameters = values.cwiseProduct(scale);
    }
    return static_cast<int>(summary.iterations.size());
}

/// Every way from the start values; the first entries are those by Ceres.
std::vector<Attempt> search_all(const Problem& problem, const Eigen::VectorXd& start) {
    std::vector<Attempt> attempts;
    const auto add = [&](const State& state, int iterations) {
        // Whether a search has converged is judged by the next step of the polish, not by the solver, whose tolerances
        // look at the sum of squares.
        Attempt attempt = problem.polish(state);
        attempt.iterations += iterations;
        if (attempt.at.finite) {
            attempts.push_back(std::move(attempt));
        }
    };
    if (!problem.uncertain_x()) {
        State state = problem.begin(start);
        int iterations = search(problem, state, ceres::LEVENBERG_MARQUARDT, 1e4);
        add(state, iterations);
        state = problem.begin(start);
        iterations = search(problem, state, ceres::DOGLEG, 1.0);
        add(state, iterations);
    }
    // The cautious ones: a long first step may carry parameters to where the curve no longer depends on them, and a
    // bent valley is followed faster along its bend. Each finds what the others miss.
    const auto descend = [&](Real damping, bool longest, bool curvature) {
        State state = problem.begin(start);
        const int iterations = problem.descend(state, damping, longest, curvature);
        add(state, iterations);
    };
    descend(1e-3L, false, false);
    descend(1e2L, true, true);
    if (!problem.uncertain_x()) {
        descend(1e2L, false, true);
    }
    return attempts;
}

/// The names of the parameters that the points do not determine, or nothing where the rank is full.
std::vector<std::string> not_determined(const Linearised& at, const std::vector<std::string>& names) {
    std::vector<std::string> result;
    for (Eigen::Index k = 0; k < at.design.cols(); ++k) {
        if (!(at.design.col(k).norm() > 0.0L)) {
            result.push_back(names[static_cast<std::size_t>(k)]);
        }
    }
    if (!result.empty()) {
        return result;
    }
    const auto [values, direction] = Factorisation(at.design).singular_values();
    if (values[values.size() - 1] > static_cast<Real>(k_curve_rank_tolerance) * values[0]) {
        return result;
    }
    const Real largest = direction.cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < direction.size(); ++k) {
        if (std::abs(direction[k]) > 0.05L * largest) {
            result.push_back(names[static_cast<std::size_t>(k)]);
        }
    }
    return result;
}

void require_rank(const Linearised& at, const std::vector<std::string>& names) {
    const std::vector<std::string> lost = not_determined(at, names);
    if (lost.empty()) {
        return;
    }
    std::string list;
    for (const std::string& name : lost) {
        list += (list.empty() ? "" : ", ") + name;
    }
    throw gum::NoResultError(diagnostic(
        "GC-FIT-0010", "curve fit",
        lost.size() == 1 ? "the points do not determine the parameter " + list
                         : "the points do not determine the parameters " + list + " apart from each other",
        "the smallest singular value of the weighted design matrix, its columns scaled to unit length, must be more "
        "than " +
            text::shortest(k_curve_rank_tolerance) + " of the largest",
        "Measure at more different abscissae, refer x to the middle of its range, or leave out a parameter."));
}

/// The lowest minimum of the attempts.
Attempt best_of(std::vector<Attempt> attempts, const std::vector<std::string>& names, bool& several_minima) {
    // Two answers are looked for: the lowest minimum that was reached, and the lowest sum that was met at all.
    const Attempt* lowest = nullptr;
    const Attempt* best = nullptr;
    int iterations = 0;
    for (const Attempt& attempt : attempts) {
        iterations += attempt.iterations;
        // Also of searches that did not converge: one that went below all minima shows that none of them is the lowest.
        if (lowest == nullptr || attempt.at.sum < lowest->at.sum) {
            lowest = &attempt;
        }
        // Of attempts at one minimum the best polished one is taken: sums there differ by rounding only.
        const auto same = [&] {
            return std::abs(attempt.at.sum - best->at.sum) <=
                   k_same_minimum * best->at.sum + best->at.rounding * best->at.rounding;
        };
        if (attempt.converged &&
            (best == nullptr || (same() ? attempt.offset < best->offset : attempt.at.sum < best->at.sum))) {
            best = &attempt;
        }
    }
    const auto above = [](const Attempt& attempt, const Attempt& other) {
        return attempt.at.sum - other.at.sum >
               k_same_minimum * other.at.sum + attempt.at.rounding * attempt.at.rounding;
    };
    if (best == nullptr) {
        require_rank(lowest->at, names);
        throw gum::NoResultError(diagnostic(
            "GC-FIT-0011", "curve fit",
            "not converged after " + text::count_of(iterations, "iteration") + ": sum of squares " +
                text::shortest(static_cast<double>(lowest->at.sum)) + ", length of the next step " +
                text::shortest(static_cast<double>(lowest->offset)),
            "a result is given only where the next step is shorter than " +
                text::shortest(static_cast<double>(k_offset_accepted)) + " of the residual standard deviation",
            "Give start values nearer to the solution, or a curve with fewer parameters."));
    }
    if (above(*best, *lowest)) {
        throw gum::NoResultError(
            diagnostic("GC-FIT-0012", "curve fit",
                       "a minimum with sum of squares " + text::shortest(static_cast<double>(best->at.sum)) +
                           " was found, but a search that did not converge met the lower sum " +
                           text::shortest(static_cast<double>(lowest->at.sum)),
                       "the estimate is the lowest minimum of the sum of squares",
                       "Give start values nearer to the solution, or a curve with fewer parameters."));
    }
    several_minima = false;
    // A valley in which the curve no longer depends on a parameter is no minimum of its own.
    for (const Attempt& attempt : attempts) {
        several_minima =
            several_minima || (attempt.converged && above(attempt, *best) && not_determined(attempt.at, names).empty());
    }
    Attempt result = *best;
    result.iterations = iterations;
    return result;
}

class InputCheck {
public:
    InputCheck(const CurveData& data, const Eigen::VectorXd& start, const std::vector<std::string>& names, bool linear)
        : n_(data.y.size()) {
        const auto p = static_cast<Eigen::Index>(names.size());
        if (p == 0) {
            add("GC-FIT-0001", "parameters", "none", "a curve to be fitted has at least 1 parameter",
                "Name the parameters of the curve.");
        }
        if (data.x.rows() != n_ || data.x.cols() < 1) {
            add("GC-FIT-0001", "x", size_text(data.x.rows(), data.x.cols()) + " values",
                "x needs a row for each value of y (" + std::to_string(n_) + ") and at least 1 column",
                "Give x and y in pairs.");
        }
        check_finite(data.x, "x");
        check_finite(data.y, "y");
        check_uncertainty(data.y_uncertainty, "uncertainty of y");
        check_uncertainty(data.x_uncertainty, "uncertainty of x");
        if (data.x_uncertainty.size() > 0 && data.x.cols() > 1) {
            add("GC-FIT-0007", "uncertainty of x", "stated for " + text::count_of(data.x.cols(), "regressor"),
                "uncertain abscissae are possible for a curve of one variable only",
                "Leave the uncertainty of x out where it is small, or fit each variable by itself.");
        }
        if (data.x_uncertainty.size() > 0 && data.y_uncertainty.size() == 0) {
            add("GC-FIT-0007", "uncertainty of x", "stated, but the uncertainty of y is not",
                "errors in both variables are weighed against each other", "State the uncertainty of y too.");
        }
        // s² is a sum over n − p: with n = p nothing scatters.
        const bool scaled = data.scale_by_residuals || data.y_uncertainty.size() == 0;
        if (p > 0 && n_ < p + (scaled ? 1 : 0)) {
            add("GC-FIT-0003", "curve fit", text::count_of(n_, "point") + " for " + text::count_of(p, "parameter"),
                scaled ? "an uncertainty taken from residuals needs more points than parameters"
                       : "a fit needs at least as many points as parameters",
                "Measure at more points, or leave out a parameter.");
        }
        if (!linear) {
            if (start.size() != p) {
                add("GC-FIT-0006", "start values",
                    std::to_string(start.size()) + " for " + text::count_of(p, "parameter"),
                    "a curve that is not linear needs a start value for each parameter",
                    "Give a rough value of each parameter.");
            } else {
                for (Eigen::Index k = 0; k < p; ++k) {
                    if (!std::isfinite(start[k])) {
                        add("GC-FIT-0006", "start value of " + names[static_cast<std::size_t>(k)],
                            text::shortest(start[k]), "must be a finite number", "Correct the value.");
                    }
                }
            }
        }
        if (!problems_.empty()) {
            throw gum::InputError(problems_);
        }
    }

private:
    void add(std::string code, std::string where, std::string what, std::string rule, std::string action) {
        problems_.push_back(
            diagnostic(std::move(code), std::move(where), std::move(what), std::move(rule), std::move(action)));
    }

    void check_finite(const Eigen::MatrixXd& values, const std::string& name) {
        for (Eigen::Index i = 0; i < values.rows(); ++i) {
            for (Eigen::Index k = 0; k < values.cols(); ++k) {
                if (!std::isfinite(values(i, k))) {
                    add("GC-FIT-0002", "point " + std::to_string(i + 1) + ", " + name, text::shortest(values(i, k)),
                        "must be a finite number", "Correct the value or leave out the point.");
                }
            }
        }
    }

    void check_uncertainty(const Eigen::MatrixXd& values, const std::string& name) {
        if (values.size() == 0) {
            return;
        }
        if (values.rows() != n_ || (values.cols() != 1 && values.cols() != n_)) {
            add("GC-FIT-0001", name, size_text(values.rows(), values.cols()) + " values",
                "needs " + std::to_string(n_) + " standard uncertainties or a covariance matrix of " +
                    size_text(n_, n_),
                "Give one standard uncertainty for each point.");
            return;
        }
        bool good = true;
        for (Eigen::Index i = 0; i < n_; ++i) {
            const double value = values.cols() == 1 ? values(i, 0) : values(i, i);
            if (!std::isfinite(value) || value <= 0.0) {
                add("GC-FIT-0004", "point " + std::to_string(i + 1) + ", " + name,
                    (values.cols() == 1 ? "" : "variance ") + text::shortest(value),
                    "must be finite and greater than 0: it is a weight",
                    "State a standard uncertainty greater than 0.");
                good = false;
            }
        }
        if (!good || values.cols() == 1) {
            return;
        }
        if (!values.allFinite()) {
            add("GC-FIT-0005", name, "a covariance is not a finite number", "must be finite", "Correct the matrix.");
            return;
        }
        // As correlations, so that points of very different uncertainty are judged alike.
        const Eigen::VectorXd scale = values.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::MatrixXd correlation = scale.asDiagonal() * values * scale.asDiagonal();
        if ((correlation - correlation.transpose()).cwiseAbs().maxCoeff() > 1e-10) {
            add("GC-FIT-0005", name, "the covariance matrix is not symmetric",
                "the covariance of two values does not depend on their order", "Correct the matrix.");
            return;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation, Eigen::EigenvaluesOnly);
        const double smallest = eigen.eigenvalues()[0];
        // With r = ±1 the difference of two points would be known exactly and have an infinite weight.
        if (!(smallest > 1e-13 * static_cast<double>(n_))) {
            add("GC-FIT-0005", name,
                "the covariance matrix is not positive definite: smallest eigenvalue of its correlations " +
                    text::shortest(smallest),
                "weights are the inverse of the covariance",
                "State correlation coefficients that belong together and are not exactly 1 or −1.");
        }
    }

    Eigen::Index n_;
    std::vector<gum::Diagnostic> problems_;
};

Spread spread_of(const Eigen::MatrixXd& uncertainty, Eigen::Index n) {
    if (uncertainty.size() == 0) {
        return Spread(Vector(Vector::Ones(n)));
    }
    if (uncertainty.cols() == 1) {
        return Spread(Vector(uncertainty.col(0).cast<Real>().cwiseAbs2()));
    }
    return Spread(Matrix(0.5L * (uncertainty + uncertainty.transpose()).cast<Real>()));
}

/// Sum of squares of y about its weighted mean, or about 0.
Real total_sum(const Problem& problem, bool about_mean) {
    Vector white = problem.y_spread().whitened(problem.y());
    if (about_mean) {
        const Vector one = problem.y_spread().whitened(Vector(Vector::Ones(problem.n())));
        white -= one * (one.dot(white) / one.squaredNorm());
        // The mean is rounded: once more, so that a large common value of y leaves no trace.
        white -= one * (one.dot(white) / one.squaredNorm());
    }
    return white.squaredNorm();
}

[[noreturn]] void refuse_not_finite(const std::string& place) {
    throw gum::NoResultError(
        diagnostic("GC-FIT-0013", "curve fit", "the curve or a derivative has no finite value at " + place,
                   "a fit needs the curve at every point", "Correct the equation, the start values or the points."));
}

/// Direct solution of a linear curve with exact x.
struct LinearSolution {
    Vector parameters;
    Linearised at;  // residuals and sum of the solution in long double
};

LinearSolution solve_linear(const Problem& problem, const std::vector<std::string>& names) {
    LinearSolution solution;
    const State zero = problem.begin(Eigen::VectorXd::Zero(problem.p()));
    solution.at = problem.linearise(zero);
    if (!solution.at.finite) {
        refuse_not_finite("parameters that are all 0");
    }
    problem.sharpen_powers(solution.at);
    require_rank(solution.at, names);
    solution.parameters = Factorisation(solution.at.design).solve(solution.at.right);
    const Linearised there = problem.linearise(problem.begin(solution.parameters.cast<double>()));
    if (!there.finite) {
        refuse_not_finite("the solution");
    }
    // Residuals with the parameters in long double: rounded to double, those of an ill-conditioned polynomial would
    // show the rounding of the parameters.
    solution.at.residual -= solution.at.by_parameter * solution.parameters;
    solution.at.right -= solution.at.design * solution.parameters;
    solution.at.sum = solution.at.right.squaredNorm();
    // A curve that is linear has the residuals that its derivatives at 0 predict, but for rounding; a factor of 10⁶ of
    // that is no rounding any more.
    if ((there.right - solution.at.right).norm() > 1e6L * (there.rounding + solution.at.rounding)) {
        throw gum::NoResultError(diagnostic("GC-FIT-0014", "curve fit",
                                            "the curve was said to be linear in its parameters, but is not",
                                            "only a linear curve is solved without start values",
                                            "Give start values and let it be solved as a curve that is not linear."));
    }
    return solution;
}

/// L, lower triangular with a diagonal that is not negative, with L Lᵀ = F Fᵀ.
/// \param factor  F, p×k, k ≥ p
Matrix lower_factor(const Matrix& factor) {
    const Eigen::Index p = factor.rows();
    const Eigen::HouseholderQR<Matrix> qr(factor.transpose());
    const Matrix upper = qr.matrixQR().topRows(p).template triangularView<Eigen::Upper>();
    Matrix lower = upper.transpose();
    for (Eigen::Index i = 0; i < p; ++i) {
        if (lower(i, i) < 0.0L) {
            lower.col(i) = -lower.col(i);  // as a Cholesky factor: that of a covariance is the only one of its kind
        }
    }
    return lower;
}

/// Factor G of what uncertain x make of the covariance of the parameters, G Gᵀ = Q Jᵀ V⁻¹ D V_x Dᵀ V⁻¹ J Q with
/// D = diag ∂f/∂x and Q = (JᵀV⁻¹J)⁻¹ = F Fᵀ: G = F (V⁻¹ J F)ᵀ D L_x. With V_y in the middle it is the part of y; the two
/// add up to Q, because V = V_y + D V_x Dᵀ. Through F, because Q times a vector would lose what F keeps.
/// \param root  F, p×p
Matrix root_by_x(const Linearised& at, const Matrix& root, const Spread& x) {
    const Eigen::Index p = root.rows();
    Matrix weighted(at.by_parameter.rows(), p);  // V⁻¹ J F
    for (Eigen::Index i = 0; i < p; ++i) {
        weighted.col(i) = at.spread.weighted(at.by_parameter * root.col(i));
    }
    weighted = (at.slope.asDiagonal() * weighted).eval();
    return root * x.by_root(weighted).transpose();
}

}  // namespace

CurveFit fit_curve(const Curve& curve, const CurveData& data, const Eigen::VectorXd& start,
                   const std::vector<std::string>& names, bool has_intercept) {
    const bool linear = curve.is_linear();
    const InputCheck check(data, start, names, linear);
    const Eigen::Index n = data.y.size();
    const auto p = static_cast<Eigen::Index>(names.size());
    const Spread y_spread = spread_of(data.y_uncertainty, n);
    const Problem exact(curve, data, p, y_spread, std::nullopt);

    CurveFit fit;
    fit.degrees_of_freedom = static_cast<double>(n - p);
    fit.covariance_scaled = data.scale_by_residuals || data.y_uncertainty.size() == 0;
    fit.adjusted_x = data.x;
    Linearised at;
    if (data.x_uncertainty.size() == 0 && linear) {
        LinearSolution solution = solve_linear(exact, names);
        fit.parameters = solution.parameters.cast<double>();
        at = std::move(solution.at);
    } else {
        if (!linear && !exact.linearise(exact.begin(start)).finite) {
            refuse_not_finite("the start values");
        }
        Attempt best;
        if (data.x_uncertainty.size() == 0) {
            best = best_of(search_all(exact, start), names, fit.several_minima);
        } else {
            // From the fit with exact x, and from the values given: the first is near, the second is what was asked
            // for.
            const Problem both(curve, data, p, y_spread, spread_of(data.x_uncertainty, n));
            std::vector<Eigen::VectorXd> starts;
            if (linear) {
                starts.push_back(solve_linear(exact, names).parameters.cast<double>());
            } else {
                for (const Attempt& attempt : search_all(exact, start)) {
                    starts.push_back(attempt.state.parameters);
                }
                starts.push_back(start);
            }
            std::vector<Attempt> attempts;
            for (const Eigen::VectorXd& from : starts) {
                for (Attempt& attempt : search_all(both, from)) {
                    attempts.push_back(std::move(attempt));
                }
            }
            if (attempts.empty()) {
                refuse_not_finite("the start values");
            }
            best = best_of(std::move(attempts), names, fit.several_minima);
            fit.adjusted_x = best.state.abscissae;
        }
        require_rank(best.at, names);
        fit.parameters = best.state.parameters;
        fit.iterations = best.iterations;
        const Real spread = exact.spread_of(best.at.sum);
        fit.relative_offset = spread > 0.0L ? static_cast<double>(best.offset / spread) : 0.0;
        at = std::move(best.at);
    }

    const Factorisation factorisation(at.design);
    const Vector singular = factorisation.singular_values().first;
    fit.condition_number = static_cast<double>(singular[0] / singular[p - 1]);
    fit.residuals = at.residual.cast<double>();
    fit.sum_of_squares = static_cast<double>(at.sum);
    fit.residual_standard_deviation = static_cast<double>(exact.spread_of(at.sum));
    const Matrix root = factorisation.cofactor_root();
    // The stated uncertainties are weights only, known up to a factor: s² of the residuals is its estimate.
    const Real factor = fit.covariance_scaled ? std::sqrt(at.sum / static_cast<Real>(n - p)) : 1.0L;
    fit.covariance = Matrix((factor * factor) * (root * root.transpose())).cast<double>();
    fit.factor = Matrix(factor * lower_factor(root)).cast<double>();
    if (data.x_uncertainty.size() != 0) {
        fit.factor_by_x =
            Matrix(factor * lower_factor(root_by_x(at, root, spread_of(data.x_uncertainty, n)))).cast<double>();
    }
    if (data.x_uncertainty.size() == 0) {
        // TSS about the mean only where the curve has an intercept; else R² would compare with a curve that it does not
        // hold.
        const Real total = total_sum(exact, has_intercept);
        if (total > 0.0L) {
            fit.r_squared = static_cast<double>(1.0L - at.sum / total);
        }
    }
    if (!fit.parameters.allFinite() || !fit.covariance.allFinite() || !fit.factor.allFinite() ||
        !std::isfinite(fit.sum_of_squares)) {
        throw gum::NoResultError(diagnostic("GC-FIT-0013", "curve fit", "the result is not finite",
                                            "an estimate and its uncertainty are finite numbers",
                                            "State the quantities in units nearer to their size."));
    }
    return fit;
}

}  // namespace gumcert::engine
