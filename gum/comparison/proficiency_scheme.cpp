#include "gum/comparison/proficiency_scheme.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "gum/argument_check.h"
#include "text/numbers.h"

namespace gumcert::gum {
namespace {

// 64 bits of mantissa on x86-64: results that agree in many digits keep their standard deviation.
using Real = long double;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

void require_items(std::size_t items, std::size_t replicates, std::size_t least) {
    if (items < least || replicates < least) {
        refuse("GC-GUM-0111", "items and replicates", std::to_string(items) + " × " + std::to_string(replicates),
               "at least " + std::to_string(least) + " items in " + std::to_string(least) + " replicates each",
               "Give more items or replicates, or leave out the check.");
    }
}

void require_results(const Eigen::MatrixXd& results, std::size_t least) {
    require_items(static_cast<std::size_t>(results.rows()), static_cast<std::size_t>(results.cols()), least);
    for (Eigen::Index i = 0; i < results.rows(); ++i) {
        for (Eigen::Index j = 0; j < results.cols(); ++j) {
            require_finite(results(i, j), "item " + std::to_string(i + 1) + ", replicate " + std::to_string(j + 1));
        }
    }
}

/// Means of the items and their mean, both about the first result, and the standard deviations between and within.
struct ItemStatistics {
    Real origin = 0.0L;
    RealVector means;
    Real mean = 0.0L;
    Real s_means = 0.0L;   ///< 0 with one item
    Real s_within = 0.0L;  ///< 0 with one replicate
};

ItemStatistics item_statistics(const Eigen::MatrixXd& results) {
    // About the first result: a large common value is taken off without rounding.
    ItemStatistics statistics{.origin = results(0, 0), .means = {}};
    const RealMatrix values = results.cast<Real>().array() - statistics.origin;
    statistics.means = values.rowwise().mean();
    statistics.mean = statistics.means.mean();
    if (values.rows() > 1) {
        // Two passes: Σ x² − n x̄² would cancel for items that agree well, which is what the check is made for.
        const Real squares = (statistics.means.array() - statistics.mean).square().sum();
        statistics.s_means = std::sqrt(squares / static_cast<Real>(values.rows() - 1));
    }
    if (values.cols() > 1) {
        const Real squares = (values.colwise() - statistics.means).squaredNorm();
        statistics.s_within = std::sqrt(squares / static_cast<Real>(values.rows() * (values.cols() - 1)));
    }
    return statistics;
}

}  // namespace

double sigma_pt_of_mass_fraction(double mass_fraction) {
    require_positive(mass_fraction, "mass fraction");
    if (mass_fraction > 1.0) {
        refuse("GC-GUM-0112", "mass fraction", text::shortest(mass_fraction), "must not be greater than 1",
               "State the mass fraction as a share of the whole: 1 mg/kg is 1e-6.");
    }
    if (mass_fraction < 1.2e-7) {
        return 0.22 * mass_fraction;
    }
    return mass_fraction <= 0.138 ? 0.02 * std::pow(mass_fraction, 0.8495) : 0.01 * std::sqrt(mass_fraction);
}

double sigma_pt_of_precision(double reproducibility, double repeatability, std::size_t replicates) {
    require_positive(reproducibility, "reproducibility standard deviation");
    require_not_negative(repeatability, "repeatability standard deviation");
    require_items(1, replicates, 1);
    if (repeatability > reproducibility) {
        refuse("GC-GUM-0110", "repeatability standard deviation",
               text::shortest(repeatability) + " with a reproducibility standard deviation of " +
                   text::shortest(reproducibility),
               "repeatability is a part of reproducibility and cannot be greater",
               "Check whether the two numbers were exchanged.");
    }
    const Real ratio = static_cast<Real>(repeatability) / static_cast<Real>(reproducibility);
    // (1 − ρ)(1 + ρ) + ρ²/m: nothing cancels where ρ is close to 1.
    const Real share = (1.0L - ratio) * (1.0L + ratio) + ratio * ratio / static_cast<Real>(replicates);
    const auto sigma_pt = static_cast<double>(static_cast<Real>(reproducibility) * std::sqrt(share));
    require_positive(sigma_pt, "standard deviation for proficiency assessment");
    return sigma_pt;
}

HomogeneityFactors homogeneity_factors(std::size_t items, std::size_t replicates) {
    require_items(items, replicates, 2);
    constexpr double p = 0.05;
    const auto g = static_cast<double>(items);
    const auto m = static_cast<double>(replicates);
    using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;  // ADR 0058
    const boost::math::chi_squared_distribution<double, InDouble> chi_square(g - 1.0);
    const boost::math::fisher_f_distribution<double, InDouble> f(g - 1.0, g * (m - 1.0));
    return {.f1 = boost::math::quantile(boost::math::complement(chi_square, p)) / (g - 1.0),
            .f2 = (boost::math::quantile(boost::math::complement(f, p)) - 1.0) / m};
}

HomogeneityCheck check_homogeneity(const Eigen::MatrixXd& results, double sigma_pt) {
    require_results(results, 2);
    require_positive(sigma_pt, "standard deviation for proficiency assessment");
    const ItemStatistics statistics = item_statistics(results);
    HomogeneityCheck check;
    check.items = static_cast<std::size_t>(results.rows());
    check.replicates = static_cast<std::size_t>(results.cols());
    check.mean = static_cast<double>(statistics.origin + statistics.mean);
    check.mean_remainder = static_cast<double>(statistics.origin - static_cast<Real>(check.mean) + statistics.mean);
    check.s_x = static_cast<double>(statistics.s_means);
    check.s_w = static_cast<double>(statistics.s_within);
    // s_x² has the variance between items and 1/m of that within: what is left is s_s². A negative rest says that
    // repeatability explains all of the scatter.
    const Real between = statistics.s_means * statistics.s_means -
                         statistics.s_within * statistics.s_within / static_cast<Real>(results.cols());
    check.s_s = between > 0.0L ? static_cast<double>(std::sqrt(between)) : 0.0;
    if (check.s_s > 0.0) {
        const double of_means = std::pow(check.s_x / check.s_s, 4.0) / static_cast<double>(check.items - 1);
        const auto within_degrees = static_cast<double>(check.items * (check.replicates - 1));
        const double of_within = std::pow(check.s_w / check.s_s, 4.0) /
                                 (within_degrees * static_cast<double>(check.replicates * check.replicates));
        check.degrees_of_freedom = std::max(1.0, 1.0 / (of_means + of_within));
    }
    check.limit = k_assigned_value_criterion * sigma_pt;
    const HomogeneityFactors factors = homogeneity_factors(check.items, check.replicates);
    // 0.3 σ_pt is allowed between items; F1 and F2 add what the scatter of g items in m replicates may show by chance,
    // with quantiles for 95 %.
    check.expanded_limit = std::hypot(std::sqrt(factors.f1) * check.limit, std::sqrt(factors.f2) * check.s_w);
    for (const double number : {check.mean, check.s_x, check.s_w, check.expanded_limit}) {
        require_finite(number, "check of homogeneity");
    }
    check.sufficient = check.s_s <= check.limit;
    check.sufficient_expanded = check.s_s <= check.expanded_limit;
    return check;
}

StabilityCheck check_stability(const HomogeneityCheck& before, const Eigen::MatrixXd& results, double sigma_pt) {
    require_results(results, 1);
    require_items(before.items, before.replicates, 1);
    require_positive(sigma_pt, "standard deviation for proficiency assessment");
    const ItemStatistics statistics = item_statistics(results);
    StabilityCheck check;
    check.mean = static_cast<double>(statistics.origin + statistics.mean);
    // The rounded means, and then what their rounding has cut off: a difference in the last digits of a large common
    // value would be lost in ȳ1 − ȳ2.
    check.difference = static_cast<double>(std::abs((statistics.origin - static_cast<Real>(before.mean)) +
                                                    (statistics.mean - static_cast<Real>(before.mean_remainder))));
    const double u_before = before.s_x / std::sqrt(static_cast<double>(before.items));
    const double u_after = static_cast<double>(statistics.s_means) / std::sqrt(static_cast<double>(results.rows()));
    check.u_difference = std::hypot(u_before, u_after);
    check.limit = k_assigned_value_criterion * sigma_pt;
    check.expanded_limit = check.limit + 2.0 * check.u_difference;
    for (const double number : {check.mean, check.difference, check.expanded_limit}) {
        require_finite(number, "check of stability");
    }
    // 10.3 − 10 is 0.3, which binary numbers make a little more.
    const double rounding =
        2.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(check.mean), std::abs(before.mean));
    check.stable = check.difference - rounding <= check.limit;
    check.stable_expanded = check.difference - rounding <= check.expanded_limit;
    return check;
}

}  // namespace gumcert::gum
