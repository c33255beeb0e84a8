#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/comparison/random_effects.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int k_most_steps_to_maximum = 1000;
constexpr double k_still = 1e-13;  // relative: steps that change nothing any more

/// One laboratory, in the unit of the problem: mean x of ν + 1 observations, v = s²/(ν + 1).
struct Laboratory {
    double x = 0.0, v = 0.0, nu = 0.0;
};

/// What depends on t = σ²/(ν + 1) in −2 log L, for a variance a between laboratories and the square q of x − μ:
/// log(a + t) + q/(a + t) + ν (log t + v/t).
double term(double t, double v, double nu, double a, double q) {
    return std::log(a + t) + q / (a + t) + nu * (std::log(t) + v / t);
}

/// Its derivative with respect to z = t/v, times a positive factor, for a and q in units of v.
double slope(double z, double nu, double a, double q) {
    // Divided through by the square of the larger of v and a: the cubic alone would overflow for laboratories whose
    // variances differ by many powers of ten.
    const double scale = std::max(1.0, a);
    const double s = (z + a) / scale;
    return z * z * (z + a - q) / (scale * scale) + nu * (z - 1.0) * s * s;
}

/// Root of the slope between two points where it has different signs, by bisection with secant steps (Illinois).
double root_between(double low, double high, double nu, double a, double q) {
    double at_low = slope(low, nu, a, q);
    double at_high = slope(high, nu, a, q);
    constexpr int k_most = 200;
    int side = 0;
    for (int step = 0; step < k_most && high - low > 1e-15 * high && at_low != at_high; ++step) {
        double z = (low * at_high - high * at_low) / (at_high - at_low);
        if (!(z > low && z < high)) {
            z = 0.5 * (low + high);
        }
        const double at = slope(z, nu, a, q);
        if (at == 0.0) {
            return z;
        }
        if ((at < 0.0) == (at_low < 0.0)) {
            if (z - low <= 1e-15 * high && side == 1) {
                return z;
            }
            low = z;
            at_low = at;
            // Illinois: plain regula falsi keeps one end for ever where the function is bent, and then creeps.
            at_high *= side == 1 ? 0.5 : 1.0;
            side = 1;
        } else {
            if (high - z <= 1e-15 * high && side == -1) {
                return z;
            }
            high = z;
            at_high = at;
            at_low *= side == -1 ? 0.5 : 1.0;
            side = -1;
        }
    }
    return 0.5 * (low + high);
}

/// The t that makes the likelihood of one laboratory largest.
///
/// All zeros of the slope lie between 1 and q − a in units of v; a cubic polynomial, it has one or three there. The
/// zeros of its derivative cut the range into pieces with one zero at most.
double most_likely_t(const Laboratory& laboratory, double between_variance, double q) {
    const double v = laboratory.v;
    const double nu = laboratory.nu;
    const double a = between_variance / v;
    q /= v;
    // Without a variance between laboratories the slope is linear in z: t = (q + ν v)/(1 + ν).
    if (a == 0.0) {
        return v * (q + nu) / (1.0 + nu);
    }
    const double low = std::min(1.0, std::max(q - a, 0.0));
    const double high = std::max(1.0, q - a);
    // (1+ν) z³ + c2 z² + c1 z − ν a² with derivative 3(1+ν) z² + 2 c2 z + c1
    const double c2 = a * (1.0 + 2.0 * nu) - q - nu;
    const double c1 = nu * a * (a - 2.0);
    std::array<double, 4> ends{low};
    std::size_t count = 1;
    const double discriminant = c2 * c2 - 3.0 * (1.0 + nu) * c1;
    if (discriminant > 0.0) {
        // The root that does not cancel, and the other one by the product of the two.
        const double larger = -(c2 + std::copysign(std::sqrt(discriminant), c2));
        std::array<double, 2> turns{larger / (3.0 * (1.0 + nu)), c1 / larger};
        std::sort(turns.begin(), turns.end());
        for (const double z : turns) {
            if (z > low && z < high) {
                ends[count++] = z;
            }
        }
    }
    ends[count++] = high;
    double best = high;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t piece = 1; piece < count; ++piece) {
        const double at_low = slope(ends[piece - 1], nu, a, q);
        const double at_high = slope(ends[piece], nu, a, q);
        if (at_low > 0.0 || at_high < 0.0) {
            continue;  // no minimum inside: there the slope turns from negative to positive
        }
        const double z = root_between(ends[piece - 1], ends[piece], nu, a, q);
        // Two minima are possible: the laboratory is either imprecise, or off by an effect of its own.
        const double here = z > 0.0 ? term(z, 1.0, nu, a, q) : std::numeric_limits<double>::infinity();
        if (here < least) {
            least = here;
            best = z;
        }
    }
    return v * best;
}

/// A point of the search: the mean, the variance between laboratories, the variances of the means, and −2 log L.
struct Point {
    double mu = 0.0, between = 0.0;
    ArrayXd t;
    double deviance = std::numeric_limits<double>::infinity();
};

class Likelihood {
public:
    explicit Likelihood(std::vector<Laboratory> laboratories) : laboratories_(std::move(laboratories)) {}

    [[nodiscard]] Index size() const { return static_cast<Index>(laboratories_.size()); }

    /// The most likely variances of the means for this mean and this variance between laboratories.
    [[nodiscard]] Point at(double mu, double between) const {
        Point point{.mu = mu, .between = between, .t = ArrayXd(size()), .deviance = 0.0};
        for (Index i = 0; i < size(); ++i) {
            const Laboratory& laboratory = laboratories_[static_cast<std::size_t>(i)];
            const double q = (laboratory.x - mu) * (laboratory.x - mu);
            point.t(i) = most_likely_t(laboratory, between, q);
            point.deviance += term(point.t(i), laboratory.v, laboratory.nu, between, q);
        }
        return point;
    }

    /// Slopes of −2 log L in the mean and the variance between laboratories, and its second derivatives, the other
    /// variances following as they must (Schur complement of the matrix of all second derivatives).
    struct Derivatives {
        double mu = 0.0, between = 0.0;
        double mu_mu = 0.0, mu_between = 0.0, between_between = 0.0;
        double expected_mu_mu = 0.0, expected_between_between = 0.0;  // Fisher information, always positive
        bool regular = true;
    };
    [[nodiscard]] Derivatives derivatives(const Point& point) const {
        Derivatives sum;
        for (Index i = 0; i < size(); ++i) {
            const Laboratory& laboratory = laboratories_[static_cast<std::size_t>(i)];
            const double t = point.t(i);
            const double w = 1.0 / (point.between + t);
            const double rw = (laboratory.x - point.mu) * w;
            const double mixed = 2.0 * rw * w;  // of μ with τ² and of μ with t
            const double curved = (2.0 * rw * rw - w) * w;
            const double t_t = curved + laboratory.nu * (2.0 * laboratory.v / t - 1.0) / (t * t);
            sum.mu -= 2.0 * rw;
            sum.between += w - rw * rw;
            sum.mu_mu += 2.0 * w - mixed * mixed / t_t;
            sum.mu_between += mixed - mixed * curved / t_t;
            sum.between_between += curved - curved * curved / t_t;
            sum.expected_mu_mu += 2.0 * w;
            sum.expected_between_between += w * w;
            sum.regular = sum.regular && t_t > 0.0;
        }
        return sum;
    }

    /// Newton step; nothing (infinite deviance) where the second derivatives are not those of a minimum.
    [[nodiscard]] Point newton_step(const Point& point, const Derivatives& of) const {
        if (!of.regular || !(of.mu_mu > 0.0)) {
            return {};
        }
        // On the limit τ = 0 and the likelihood falls from it: τ stays, and only the mean moves.
        if (point.between == 0.0 && of.between >= 0.0) {
            return at(point.mu - of.mu / of.mu_mu, 0.0);
        }
        const double determinant = of.mu_mu * of.between_between - of.mu_between * of.mu_between;
        if (!(determinant > 0.0)) {
            return {};
        }
        const double step = (of.mu_mu * of.between - of.mu_between * of.mu) / determinant;
        if (step >= point.between) {  // over the limit τ = 0: stay on it, with the mean that belongs to it
            return at(point.mu - (of.mu - of.mu_between * point.between) / of.mu_mu, 0.0);
        }
        return at(point.mu - (of.between_between * of.mu - of.mu_between * of.between) / determinant,
                  point.between - step);
    }

    /// Scoring step with the expected second derivatives, as short as it must be for the likelihood to grow.
    [[nodiscard]] Point scoring_step(const Point& point, const Derivatives& of) const {
        constexpr int k_most_halvings = 60;
        double part = 1.0;
        for (int halving = 0; halving < k_most_halvings; ++halving, part *= 0.5) {
            Point next = at(point.mu - part * of.mu / of.expected_mu_mu,
                            std::max(0.0, point.between - part * of.between / of.expected_between_between));
            if (next.deviance < point.deviance) {
                return next;
            }
        }
        return point;
    }

private:
    std::vector<Laboratory> laboratories_;
};

bool stands_still(const Point& before, const Point& after) {
    // In units of the standard deviation of the laboratory that has the largest weight in the mean.
    const double scale = std::sqrt(after.between + after.t.minCoeff());
    return std::abs(after.mu - before.mu) <= k_still * scale * 10.0 &&
           std::abs(after.between - before.between) <= k_still * (after.between + after.t.minCoeff()) * 10.0;
}

/// From one starting point to the maximum that belongs to it.
struct Maximum {
    Point point;
    int steps = 0;
    bool converged = false;
};
Maximum climb(const Likelihood& likelihood, Point start) {
    Maximum maximum{.point = std::move(start)};
    while (!maximum.converged && maximum.steps < k_most_steps_to_maximum) {
        ++maximum.steps;
        const Point& here = maximum.point;
        const Likelihood::Derivatives derivatives = likelihood.derivatives(here);
        const double rounding = 1e-14 * static_cast<double>(likelihood.size()) * (1.0 + std::abs(here.deviance));
        // Newton is quick near a maximum; away from it the second derivatives may be those of a saddle. The expected
        // ones are always positive, so that a scoring step that is short enough goes up.
        Point next = likelihood.newton_step(here, derivatives);
        if (!(next.deviance <= here.deviance + rounding)) {
            next = likelihood.scoring_step(here, derivatives);
        }
        maximum.converged = stands_still(here, next);
        maximum.point = std::move(next);
    }
    return maximum;
}

void require_replicates(const ReplicatedResults& results) {
    const Index n = results.x.size();
    if (results.s.size() != n || results.observations.size() != static_cast<std::size_t>(n)) {
        refuse("GC-GUM-0135", "replicated results",
               text::count_of(n, "mean") + ", " + std::to_string(results.s.size()) + " standard deviations and " +
                   text::count_of(results.observations.size(), "number") + " of observations",
               "every laboratory has one of each", "Give all three for every laboratory.");
    }
    if (n < 2) {
        refuse("GC-GUM-0131", "replicated results", "only " + std::to_string(n), "a comparison needs at least 2",
               "Give the results of more laboratories.");
    }
    for (Index i = 0; i < n; ++i) {
        const std::string name = "laboratory " + std::to_string(i + 1);
        require_finite(results.x(i), "mean of " + name);
        require_positive(results.s(i), "standard deviation of " + name);
        const std::size_t observations = results.observations[static_cast<std::size_t>(i)];
        if (observations < 2) {
            refuse("GC-GUM-0138", name, text::count_of(observations, "observation"),
                   "a standard deviation comes from at least 2",
                   "Give the number of observations behind s, or use a mean that takes u instead.");
        }
    }
    const double largest = std::max(results.x.maxCoeff() - results.x.minCoeff(), results.s.maxCoeff());
    constexpr double k_most = 1e100;
    if (!(largest / results.s.minCoeff() <= k_most)) {
        refuse(
            "GC-GUM-0142", "replicated results",
            "range " + text::shortest(largest) + " with a standard deviation " + text::shortest(results.s.minCoeff()),
            "magnitudes up to 1e+100 times the smallest standard deviation can be handled",
            "Correct the standard deviation.");
    }
}

std::vector<double> starting_means(const std::vector<Laboratory>& laboratories) {
    std::vector<double> x;
    double mean = 0.0, weighted = 0.0, weight = 0.0;
    for (const Laboratory& laboratory : laboratories) {
        x.push_back(laboratory.x);
        mean += laboratory.x / static_cast<double>(laboratories.size());
        weighted += laboratory.x / laboratory.v;
        weight += 1.0 / laboratory.v;
    }
    std::sort(x.begin(), x.end());
    std::vector<double> starts{mean, x[x.size() / 2], weighted / weight};
    constexpr std::size_t k_few = 30;
    if (x.size() <= k_few) {
        starts.insert(starts.end(), x.begin(), x.end());  // a maximum may sit on every laboratory
    }
    return starts;
}

}  // namespace

ReferenceValue vangel_rukhin(const ReplicatedResults& results) {
    require_replicates(results);
    const Index n = results.x.size();
    const double centre = results.x(0);
    // About one of the results and in a unit of their own size: limits of steps and rounding are relative then.
    const double unit = std::max((results.x.array() - centre).abs().maxCoeff(), results.s.maxCoeff());
    std::vector<Laboratory> laboratories;
    double spread = 0.0;
    for (Index i = 0; i < n; ++i) {
        const auto observations = static_cast<double>(results.observations[static_cast<std::size_t>(i)]);
        const double s = results.s(i) / unit;
        laboratories.push_back(
            {.x = (results.x(i) - centre) / unit, .v = s * s / observations, .nu = observations - 1.0});
    }
    const std::vector<double> means = starting_means(laboratories);
    for (const Laboratory& laboratory : laboratories) {
        spread += (laboratory.x - means.front()) * (laboratory.x - means.front()) / static_cast<double>(n - 1);
    }
    const Likelihood likelihood(std::move(laboratories));
    Maximum best;
    for (const double mean : means) {
        // The likelihood can have several maxima: a climb from each start, and the highest one counts.
        for (const double part : {1.0, 0.01, 0.0}) {
            Maximum found = climb(likelihood, likelihood.at(mean, part * spread));
            if (found.point.deviance < best.point.deviance) {
                best = std::move(found);
            }
        }
    }
    if (!best.converged) {
        throw NoResultError(
            Diagnostic{.code = "GC-GUM-0130",
                       .where = "Vangel-Rukhin mean",
                       .what = "not converged after " + std::to_string(k_most_steps_to_maximum) + " steps",
                       .rule = "the likelihood must reach a maximum",
                       .action = "Review the standard deviations, or take the Mandel-Paule mean."});
    }
    const ArrayXd weights = (best.point.between + best.point.t).inverse();
    const double total = weights.sum();
    const SplitNumber value = split_sum(centre, unit * best.point.mu);
    return {.value = value.value,
            .u = unit / std::sqrt(total),
            .weights = (weights / total).matrix(),
            .between_standard_deviation = unit * std::sqrt(best.point.between),
            .rest = value.rest};
}

}  // namespace gumcert::gum
