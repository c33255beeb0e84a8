#include "gum/convolution.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "gum/argument_check.h"
#include "gum/distribution_quantile.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {
namespace {

constexpr std::size_t k_cells = std::size_t{1} << 15U;
constexpr double k_domination = 0.3;
constexpr double k_tail_beyond_grid = 1e-9;  // probability of a term outside the grid, of those without limits
constexpr double k_negligible_cell = 1e-15;  // of a probability; what Fourier transforms leave behind is smaller
constexpr double k_widest_grid = 60.0;       // in standard deviations of the sum

/// The distribution of c (X − x), scale alone.
Distribution centred(const ConvolutionTerm& term) {
    Distribution distribution = term.distribution;
    distribution.location = 0.0;
    distribution.scale *= std::abs(term.sensitivity);
    return distribution;
}

/// A standard deviation, or for a t-distribution without one the scale: the width of the bulk.
double width(const Distribution& distribution) {
    const double deviation = standard_deviation(distribution);
    return std::isfinite(deviation) ? deviation : distribution.scale;
}

/// Probabilities of the cells (k ± ½) h of a symmetric distribution, k = 0 … n/2, then mirrored at the end of the array
/// as a Fourier transform wants it. What lies beyond the grid goes to the last cell.
std::vector<double> cell_probabilities(const Distribution& distribution, double h) {
    std::vector<double> cells(k_cells, 0.0);
    const std::size_t half = k_cells / 2;
    double outside = 0.5;  // P(X > lower edge of cell k); symmetric about 0
    double above = upper_tail_probability(distribution, 0.5 * h);
    cells[0] = 2.0 * (outside - above);
    for (std::size_t k = 1; k < half; ++k) {
        outside = above;
        above = outside > 0.0 ? upper_tail_probability(distribution, (static_cast<double>(k) + 0.5) * h) : 0.0;
        cells[k] = outside - above;
        cells[k_cells - k] = cells[k];
    }
    cells[half] = 2.0 * above;
    return cells;
}

/// The distributions of c_i (X_i − x_i), all normal ones as one.
std::vector<Distribution> centred_distributions(std::span<const ConvolutionTerm> terms) {
    std::vector<Distribution> distributions;
    double normal_variance = 0.0;
    for (const ConvolutionTerm& term : terms) {
        Distribution distribution = centred(term);
        if (distribution.kind == DistributionKind::constant || distribution.scale == 0.0) {
            continue;
        }
        if (!is_symmetric(distribution) || !distribution_problem(distribution).empty()) {
            throw InputError(Diagnostic{.code = "GC-GUM-0060",
                                        .where = "convolution of distributions",
                                        .what = "a term with a distribution that is not symmetric: " +
                                                std::string(distribution_name(distribution.kind)),
                                        .rule = "terms are symmetric about their estimates",
                                        .action = "Use the Monte Carlo method."});
        }
        if (distribution.kind == DistributionKind::beta) {  // its location is the lower limit: move the centre to 0
            distribution.location = -0.5 * distribution.scale;
        }
        if (distribution.kind == DistributionKind::normal) {
            normal_variance += distribution.scale * distribution.scale;
        } else {
            distributions.push_back(std::move(distribution));
        }
    }
    if (normal_variance > 0.0) {
        distributions.push_back(Distribution::normal(0.0, std::sqrt(normal_variance)));
    }
    if (distributions.empty()) {
        throw InputError(Diagnostic{.code = "GC-GUM-0060",
                                    .where = "convolution of distributions",
                                    .what = "no term with an uncertainty",
                                    .rule = "a sum of distributions needs at least one",
                                    .action = "State the uncertainty of at least one input."});
    }
    return distributions;
}

/// Probabilities of a sum in the cells (k ± ½) h, those with k < 0 at the end of the array.
struct CellSum {
    double h = 0.0;
    std::vector<double> cells;
};

CellSum convolve(std::span<const Distribution> distributions) {
    double variance = 0.0;
    double reach = 0.0;  // nothing lies further out, but for the tails of the terms without limits
    for (const Distribution& distribution : distributions) {
        variance += width(distribution) * width(distribution);
        reach += is_bounded(distribution) ? upper_quantile(distribution, 0.0)
                                          : upper_quantile(distribution, k_tail_beyond_grid);
    }
    const double deviation = std::sqrt(variance);
    reach = std::min(reach, k_widest_grid * deviation);
    const double h = 2.2 * reach / static_cast<double>(k_cells);  // a margin against terms that wrap around

    Eigen::FFT<double> transform;
    std::vector<std::complex<double>> product;
    for (const Distribution& distribution : distributions) {
        std::vector<std::complex<double>> spectrum;
        transform.fwd(spectrum, cell_probabilities(distribution, h));
        if (product.empty()) {
            product = std::move(spectrum);
        } else {
            for (std::size_t i = 0; i < product.size(); ++i) {
                product[i] *= spectrum[i];
            }
        }
    }
    std::vector<double> sum;
    transform.inv(sum, product);
    return {h, std::move(sum)};
}

}  // namespace

double convolution_half_width(std::span<const ConvolutionTerm> terms, double coverage_probability) {
    require_probability(coverage_probability, "coverage probability");
    const CellSum convolved = convolve(centred_distributions(terms));
    const double h = convolved.h;
    const std::vector<double>& sum = convolved.cells;

    // Probability inside ±(k + ½) h grows by two cells a step; inside a cell it is taken as linear.
    double inside = sum[0];
    double edge = 0.5 * h;
    if (inside >= coverage_probability) {
        return edge * coverage_probability / inside;
    }
    for (std::size_t k = 1; k < k_cells / 2; ++k) {
        const double next = inside + sum[k] + sum[k_cells - k];
        if (next >= coverage_probability) {
            return edge + h * (coverage_probability - inside) / (next - inside);
        }
        inside = next;
        edge += h;
    }
    return edge;
}

struct ConvolutionDistribution::Table {
    Distribution widest;
    std::vector<std::pair<double, double>> others;  // where the sum of the other terms is, and how probably
};

ConvolutionDistribution::ConvolutionDistribution(std::span<const ConvolutionTerm> terms) {
    std::vector<Distribution> distributions = centred_distributions(terms);
    const auto widest =
        std::max_element(distributions.begin(), distributions.end(),
                         [](const Distribution& a, const Distribution& b) { return width(a) < width(b); });
    Table table;
    table.widest = *widest;
    distributions.erase(widest);
    if (distributions.empty()) {
        table.others.emplace_back(0.0, 1.0);
    } else {
        const CellSum sum = convolve(distributions);
        double total = 0.0;
        for (std::size_t i = 0; i < k_cells; ++i) {
            if (sum.cells[i] > k_negligible_cell) {
                const double k = static_cast<double>(i) - (i > k_cells / 2 ? static_cast<double>(k_cells) : 0.0);
                table.others.emplace_back(k * sum.h, sum.cells[i]);
                total += sum.cells[i];
            }
        }
        for (auto& [where, probability] : table.others) {
            probability /= total;
        }
    }
    table_ = std::make_shared<const Table>(std::move(table));
}

double ConvolutionDistribution::operator()(double x) const {
    double probability = 0.0;
    if (table_->widest.kind == DistributionKind::uniform) {  // the usual case by far, so without a call for each cell
        const double a = table_->widest.scale;
        for (const auto& [where, weight] : table_->others) {
            probability += weight * std::clamp(0.5 + 0.5 * (x - where) / a, 0.0, 1.0);
        }
    } else {
        for (const auto& [where, weight] : table_->others) {
            probability += weight * lower_tail_probability(table_->widest, x - where);
        }
    }
    return std::clamp(probability, 0.0, 1.0);
}

double convolution_distribution(std::span<const ConvolutionTerm> terms, double x) {
    return ConvolutionDistribution(terms)(x);
}

std::optional<DominatedOutput> expand_dominated_output(const MeasurementModel& model, const Propagation& propagation,
                                                       Eigen::Index output) {
    const std::vector<InputGroup>& groups = model.inputs();
    const double u = propagation.standard_uncertainty(output);
    if (!(u > 0.0)) {
        return std::nullopt;
    }
    // The two largest contributions that come from one bounded input each.
    std::vector<std::size_t> bounded;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (propagation.budget[g].variance(output) > 0.0 && groups[g].size() == 1 && groups[g].marginals.size() == 1 &&
            is_bounded(groups[g].marginals.front())) {
            bounded.push_back(g);
        }
    }
    std::stable_sort(bounded.begin(), bounded.end(), [&](std::size_t a, std::size_t b) {
        return propagation.budget[a].variance(output) > propagation.budget[b].variance(output);
    });
    bounded.resize(std::min<std::size_t>(bounded.size(), 2));
    DominatedOutput result;
    double dominating = 0.0;
    for (const std::size_t g : bounded) {
        result.dominating.push_back(g);
        dominating += propagation.budget[g].variance(output);
        const double others = std::max(0.0, u * u - dominating);
        if (others <= k_domination * k_domination * dominating) {
            break;
        }
    }
    if (result.dominating.empty() || u * u - dominating > k_domination * k_domination * dominating) {
        return std::nullopt;
    }

    std::vector<ConvolutionTerm> terms;
    Eigen::Index first = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const double variance = propagation.budget[g].variance(output);
        const Eigen::Index column = first;
        first += groups[g].size();
        if (variance == 0.0) {
            continue;
        }
        if (groups[g].size() == 1 && groups[g].marginals.size() == 1) {
            if (!is_symmetric(groups[g].marginals.front())) {
                return std::nullopt;
            }
            terms.push_back({propagation.jacobian(output, column), groups[g].marginals.front()});
        } else {
            terms.push_back({1.0, Distribution::normal(0.0, std::sqrt(variance))});
        }
    }
    result.expanded_uncertainty = convolution_half_width(terms, propagation.coverage_probability);
    result.coverage_factor = result.expanded_uncertainty / u;
    result.terms = std::move(terms);
    return result;
}

}  // namespace gumcert::gum
