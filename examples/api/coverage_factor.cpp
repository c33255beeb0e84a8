// Coverage factors: of Student's t by the effective degrees of freedom, and of the distribution of a sum where bounded
// contributions dominate. Each line can be checked in the document that it names.
#include <cmath>
#include <cstdio>
#include <vector>

#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/quantity/diagnostic.h"
#include "gum/weighted_chi_square.h"

using namespace gumcert::gum;

int main() try {
    // JCGM 100:2008, G.4.1: relative contributions of 0.25 %, 0.57 % and 0.82 % with 9, 4 and 14 degrees of freedom.
    const std::vector<UncertaintyContribution> contributions{{0.25, 9.0}, {0.57, 4.0}, {0.82, 14.0}};
    const double nu = effective_degrees_of_freedom(contributions);
    std::printf("nu_eff = %.1f, k = %.2f for 95 %%\n", nu, coverage_factor(0.95, nu));
    std::printf("k = %.2f for 95.45 %% and 5 degrees of freedom\n", coverage_factor(0.9545, 5.0));  // table G.2

    // JCGM 101:2008, 9.2.3: the sum of four rectangular quantities of unit standard uncertainty.
    const std::vector<ConvolutionTerm> four(4, {1.0, Distribution::uniform(0.0, std::sqrt(3.0))});
    std::printf("four rectangular: 95 %% within %.2f\n", convolution_half_width(four, 0.95));

    // EA-4/02, S10.13: a rectangular contribution and one of a third of its width make a trapezoid with beta = 1/2.
    const std::vector<ConvolutionTerm> two{{1.0, Distribution::uniform(0.0, 3.0)},
                                           {1.0, Distribution::uniform(0.0, 1.0)}};
    const double u = std::sqrt((9.0 + 1.0) / 3.0);
    std::printf("trapezoid: k = %.2f for 95 %%\n", convolution_half_width(two, 0.95) / u);

    // Quantile and tail of one distribution, and of a sum of squares with unequal weights.
    std::printf("95 %% of an arcsine distribution lie below %.4f of its half-width\n",
                quantile({.kind = DistributionKind::arcsine, .scale = 1.0}, 0.95));
    std::printf("P(Z1^2 + 0.2 Z2^2 >= 5) = %.6f\n", weighted_chi_square_upper_tail(std::vector<double>{1.0, 0.2}, 5.0));
    return 0;
} catch (const DiagnosedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
