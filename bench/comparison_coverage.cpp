// How often the statements of a comparison are true, measured with the functions that make them.
//
//   comparison_coverage coverage RUNS SEED    share of X ± U that cover the true value, by method, number of results
//   and τ comparison_coverage false_alarms RUNS SEED   share of results with |E_n| > 1 where all uncertainties are
//   right comparison_coverage verdicts RUNS SEED    share of comparisons of methods that are validated, by points and
//   true scale comparison_coverage factors RUNS SEED     the factors of gum/comparison/consensus_spread.cpp
//
// Writes CSV to stdout; same arguments, same bytes. scripts/comparison_coverage runs it and draws the figures.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "gum/comparison/agreement.h"
#include "gum/comparison/consensus_spread.h"
#include "gum/comparison/random_effects.h"
#include "gum/comparison/reference_value.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"

namespace {

using namespace gumcert::gum;

constexpr double k_probability = 0.9545;
const std::vector<int> k_numbers = {3, 4, 5, 7, 10, 20};
const std::vector<double> k_taus = {0.0, 0.5, 1.0, 2.0, 3.0};
// s ≥ 1: u from 1/s to s, evenly in its logarithm; s < 1: one laboratory with u = s beside others with u = 1.
const std::vector<double> k_spreads_of_u = {1.0, 2.0, 0.1};
const std::vector<std::string> k_methods = {
    "arithmetic_mean",   "median",       "algorithm_a",          "q_hampel",
    "dersimonian_laird", "mandel_paule", "power_moderated_mean", "weighted_mean"};

double factor(double nu) {
    static std::map<double, double> known;
    const double rounded = std::isfinite(nu) ? std::round(nu * 100.0) / 100.0 : nu;
    const auto found = known.find(rounded);
    return found != known.end() ? found->second : known[rounded] = coverage_factor(k_probability, rounded);
}

/// Standard normal numbers that do not depend on the standard library.
class Normal {
public:
    explicit Normal(std::uint64_t seed) : engine_(seed) {}
    double uniform() { return (static_cast<double>(engine_() >> 11U) + 0.5) * 0x1p-53; }
    double operator()() { return standard_normal_quantile(uniform()); }

private:
    std::mt19937_64 engine_;
};

LaboratoryResults drawn(Normal& normal, int n, double tau, double spread_of_u) {
    LaboratoryResults results{.x = Eigen::VectorXd(n), .u = Eigen::VectorXd(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        const bool one_is_better = spread_of_u < 1.0;
        results.u(i) =
            one_is_better ? (i == 0 ? spread_of_u : 1.0) : std::pow(spread_of_u, 2.0 * normal.uniform() - 1.0);
        results.x(i) = results.u(i) * normal() + tau * normal();
    }
    return results;
}

/// What a method says of the value, and of each result if asked for.
struct Statement {
    double value = 0.0, U = 0.0;
    std::vector<double> En;
};

Statement robust(RobustMean kind, const LaboratoryResults& results, bool scores) {
    const std::vector<double> x(results.x.data(), results.x.data() + results.x.size());
    Statement statement;
    statement.value = kind == RobustMean::median        ? median(x)
                      : kind == RobustMean::algorithm_a ? algorithm_a(x).location
                                                        : q_hampel(x).location;
    const SpreadUncertainty spread = robust_spread(kind, x);
    statement.U = factor(spread.degrees_of_freedom) * spread.u;
    if (scores) {
        const std::vector<SpreadUncertainty> others = robust_spread_of_others(kind, x);
        const double f = kind == RobustMean::median ? median_difference_factor(x.size()) : 1.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const SpreadDifference d = spread_difference({.u = results.u(static_cast<Eigen::Index>(i))}, others[i], 0.0,
                                                         0.0, 1.0 / static_cast<double>(x.size()), f, k_probability);
            statement.En.push_back((x[i] - statement.value) / d.U);
        }
    }
    return statement;
}

Statement scattered(const ReferenceValue& mean, const LaboratoryResults& results, bool scores) {
    Statement statement{.value = mean.value, .U = 0.0, .En = {}};
    const SpreadUncertainty spread = weighted_spread(results.x, mean, k_probability);
    statement.U = factor(spread.degrees_of_freedom) * spread.u;
    if (scores) {
        const std::vector<SpreadUncertainty> others = spread_of_others(results.x, mean.weights);
        const double total = mean.weights.sum();
        for (Eigen::Index i = 0; i < results.x.size(); ++i) {
            const SpreadDifference d = spread_difference({.u = results.u(i)}, others[static_cast<std::size_t>(i)], 0.0,
                                                         0.0, mean.weights(i) / total, 1.0, k_probability);
            statement.En.push_back((results.x(i) - mean.value) / d.U);
        }
    }
    return statement;
}

/// Degrees of equivalence with the stated uncertainties.
Statement stated(const ReferenceValue& mean, const LaboratoryResults& results, double U) {
    Statement statement{.value = mean.value, .U = U, .En = {}};
    const DegreesOfEquivalence degrees = degrees_of_equivalence(results, mean);
    for (Eigen::Index i = 0; i < results.x.size(); ++i) {
        statement.En.push_back(degrees.d(i) / (factor(std::numeric_limits<double>::infinity()) * degrees.u(i)));
    }
    return statement;
}

Statement statement_of(const std::string& method, const LaboratoryResults& results, bool scores) {
    if (method == "median") {
        return robust(RobustMean::median, results, scores);
    }
    if (method == "algorithm_a") {
        return robust(RobustMean::algorithm_a, results, scores);
    }
    if (method == "q_hampel") {
        return robust(RobustMean::q_hampel, results, scores);
    }
    if (method == "weighted_mean") {
        const ReferenceValue mean = weighted_mean(results);
        return stated(mean, results, factor(std::numeric_limits<double>::infinity()) * mean.u);
    }
    if (method == "power_moderated_mean") {
        const ReferenceValue mean = power_moderated_mean(results);
        return stated(mean, results, scattered(mean, results, false).U);
    }
    const ReferenceValue mean = method == "arithmetic_mean"     ? arithmetic_mean(results.x)
                                : method == "dersimonian_laird" ? dersimonian_laird(results)
                                                                : mandel_paule(results);
    return scattered(mean, results, scores);
}

void coverage(int runs, std::uint64_t seed) {
    fmt::print("method,results,tau,spread_of_u,coverage_percent\n");
    for (const std::string& method : k_methods) {
        for (const double spread_of_u : k_spreads_of_u) {
            for (const int n : k_numbers) {
                for (const double tau : k_taus) {
                    Normal normal(seed + static_cast<std::uint64_t>(n));
                    int covered = 0;
                    for (int run = 0; run < runs; ++run) {
                        const Statement s = statement_of(method, drawn(normal, n, tau, spread_of_u), false);
                        covered += std::abs(s.value) <= s.U ? 1 : 0;
                    }
                    fmt::print("{},{},{},{},{:.2f}\n", method, n, tau, spread_of_u, 100.0 * covered / runs);
                }
            }
        }
    }
}

void false_alarms(int runs, std::uint64_t seed) {
    fmt::print("method,results,spread_of_u,above_1_percent\n");
    for (const std::string& method : k_methods) {
        for (const double spread_of_u : k_spreads_of_u) {
            for (const int n : k_numbers) {
                Normal normal(seed + static_cast<std::uint64_t>(n));
                int above = 0;
                for (int run = 0; run < runs; ++run) {
                    for (const double En : statement_of(method, drawn(normal, n, 0.0, spread_of_u), true).En) {
                        above += std::abs(En) > 1.0 ? 1 : 0;
                    }
                }
                fmt::print("{},{},{},{:.2f}\n", method, n, spread_of_u, 100.0 * above / runs / n);
            }
        }
    }
}

/// Independent points; the method's true standard deviation is `scale` times the stated one.
MethodDifferences differences(Normal& normal, int points, double scale, double ratio_of_reference) {
    MethodDifferences d;
    const Eigen::Index m = points;
    const double reference = ratio_of_reference * ratio_of_reference;
    d.d = Eigen::VectorXd(m);
    for (Eigen::Index i = 0; i < m; ++i) {
        d.d(i) = scale * normal() + ratio_of_reference * normal();
    }
    d.covariance = (1.0 + reference) * Eigen::MatrixXd::Identity(m, m);
    d.method_covariance = Eigen::MatrixXd::Identity(m, m);
    d.reference_covariance = reference * Eigen::MatrixXd::Identity(m, m);
    const double k = factor(std::numeric_limits<double>::infinity());
    d.U = Eigen::VectorXd::Constant(m, k * std::sqrt(1.0 + reference));
    d.U_method = Eigen::VectorXd::Constant(m, k);
    d.U_reference = Eigen::VectorXd::Constant(m, k * ratio_of_reference);
    return d;
}

void verdicts(int runs, std::uint64_t seed) {
    fmt::print("points,true_over_stated,validated_percent,cannot_tell_percent,contradicted_percent\n");
    for (const int points : {5, 8, 10, 12, 13, 14, 16, 20, 30, 36, 50, 100}) {
        for (const double scale : {1.0 / 3.0, 0.5, 1.0 / 1.5, 1.0, 1.5, 2.0, 3.0}) {
            Normal normal(seed + static_cast<std::uint64_t>(points));
            int validated = 0;
            int cannot_tell = 0;
            for (int run = 0; run < runs; ++run) {
                const Agreement found = agreement(differences(normal, points, scale, 0.2), k_probability);
                const AgreementVerdict verdict = agreement_verdict(found, std::nullopt);
                validated += verdict == AgreementVerdict::validated ? 1 : 0;
                cannot_tell += verdict == AgreementVerdict::agreement_few_points ||
                                       verdict == AgreementVerdict::uncertainty_not_confirmed
                                   ? 1
                                   : 0;
            }
            fmt::print("{},{:.2f},{:.1f},{:.1f},{:.1f}\n", points, scale, 100.0 * validated / runs,
                       100.0 * cannot_tell / runs, 100.0 * (runs - validated - cannot_tell) / runs);
        }
    }
}

/// Factors a_n by which 1.25 s*/√n becomes the u of a t-distributed deviation, and that of the difference from a
/// median.
void factors(int runs, std::uint64_t seed) {
    fmt::print("results,median,algorithm_a,q_hampel,median_difference\n");
    for (int n = 2; n <= 30; ++n) {
        std::vector<double> of[4];
        Normal normal(seed + static_cast<std::uint64_t>(n));
        std::vector<double> x(static_cast<std::size_t>(n));
        for (int run = 0; run < runs; ++run) {
            for (double& value : x) {
                value = normal();
            }
            const double per_root = 1.25 / std::sqrt(static_cast<double>(n));
            const RobustEstimate a = algorithm_a(x);
            const RobustEstimate q = q_hampel(x);
            of[0].push_back(std::abs(median(x)) / (per_root * a.scale));
            of[1].push_back(std::abs(a.location) / (per_root * a.scale));
            of[2].push_back(std::abs(q.location) / (per_root * q.scale));
            if (n > 2) {
                const SpreadUncertainty others =
                    robust_spread(RobustMean::median, std::span<const double>(x).subspan(1));
                const SpreadDifference d = spread_difference({.u = 1.0}, others, 0.0, 0.0, 1.0 / n, 1.0, k_probability);
                of[3].push_back(std::abs(x[0] - median(x)) / d.U);
            }
        }
        fmt::print("{}", n);
        for (int i = 0; i < 4; ++i) {
            if (of[i].empty()) {
                fmt::print(",");
                continue;
            }
            const auto at = of[i].begin() + static_cast<std::ptrdiff_t>(k_probability * static_cast<double>(runs));
            std::nth_element(of[i].begin(), at, of[i].end());
            fmt::print(",{:.4f}", i < 3 ? *at / factor(n - 1) : *at);
        }
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    const int runs = argc > 2 ? std::atoi(argv[2]) : 0;
    const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 0;
    if (runs < 1 || argc != 4) {
        fmt::print(stderr, "comparison_coverage coverage|false_alarms|verdicts|factors RUNS SEED\n");
        return 2;
    }
    if (what == "coverage") {
        coverage(runs, seed);
    } else if (what == "false_alarms") {
        false_alarms(runs, seed);
    } else if (what == "verdicts") {
        verdicts(runs, seed);
    } else if (what == "factors") {
        factors(runs, seed);
    } else {
        fmt::print(stderr, "\"{}\" is none of coverage, false_alarms, verdicts, factors\n", what);
        return 2;
    }
    return 0;
}
