#include "gum/quantity/distribution_shape.h"

#include <cmath>

namespace gumcert::gum {

namespace {

struct SampleShape {
    double skewness = 0.0, kurtosis = 3.0;
};

/// Of the values of an empirical distribution, each with probability 1/n.
SampleShape sample_shape(const Distribution& distribution) {
    const double deviation = standard_deviation(distribution);
    if (!(deviation > 0.0)) {
        return {};
    }
    const double mean = (expectation(distribution) - distribution.location) / distribution.scale;
    const double n = static_cast<double>(distribution.samples->size());
    SampleShape shape{.skewness = 0.0, .kurtosis = 0.0};
    for (const double x : *distribution.samples) {
        const double z = distribution.scale * (x - mean) / deviation;
        shape.skewness += z * z * z / n;
        shape.kurtosis += z * z * z * z / n;
    }
    return shape;
}

}  // namespace

double skewness(const Distribution& distribution) {
    const double shape = distribution.shape;
    switch (distribution.kind) {
        case DistributionKind::student_t:
            return shape > 3.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
        case DistributionKind::gamma:
            return 2.0 / std::sqrt(shape);
        case DistributionKind::exponential:
            return 2.0;
        case DistributionKind::lognormal: {
            const double w = std::exp(shape * shape);
            return (w + 2.0) * std::sqrt(std::expm1(shape * shape));
        }
        case DistributionKind::beta: {
            const double b = distribution.second_shape;
            return 2.0 * (b - shape) * std::sqrt(shape + b + 1.0) / ((shape + b + 2.0) * std::sqrt(shape * b));
        }
        case DistributionKind::empirical:
            return sample_shape(distribution).skewness;
        default:
            return 0.0;
    }
}

double kurtosis(const Distribution& distribution) {
    const double shape = distribution.shape;
    switch (distribution.kind) {
        case DistributionKind::constant:
        case DistributionKind::normal:
            return 3.0;
        case DistributionKind::uniform:
            return 9.0 / 5.0;
        case DistributionKind::triangular:
            return 12.0 / 5.0;
        case DistributionKind::arcsine:
            return 3.0 / 2.0;
        case DistributionKind::trapezoidal: {
            // The sum of two uniform quantities of half-widths (1 ± β)/2.
            const double a2 = 0.25 * (1.0 + shape) * (1.0 + shape);
            const double b2 = 0.25 * (1.0 - shape) * (1.0 - shape);
            const double variance = (a2 + b2) / 3.0;
            return ((a2 * a2 + b2 * b2) / 5.0 + 2.0 * a2 * b2 / 3.0) / (variance * variance);
        }
        case DistributionKind::curvilinear_trapezoid: {
            // The product of a uniform quantity on −1 … 1 and one on 1 − d … 1 + d.
            const double d2 = shape * shape;
            const double variance = (1.0 + d2 / 3.0) / 3.0;
            return (1.0 + 2.0 * d2 + d2 * d2 / 5.0) / 5.0 / (variance * variance);
        }
        case DistributionKind::student_t:
            return shape > 4.0 ? 3.0 + 6.0 / (shape - 4.0) : std::numeric_limits<double>::infinity();
        case DistributionKind::gamma:
            return 3.0 + 6.0 / shape;
        case DistributionKind::exponential:
            return 9.0;
        case DistributionKind::lognormal: {
            const double w = std::exp(shape * shape);
            return w * w * (w * w + 2.0 * w + 3.0) - 3.0;
        }
        case DistributionKind::beta: {
            const double b = distribution.second_shape;
            const double sum = shape + b;
            const double excess = 6.0 * ((shape - b) * (shape - b) * (sum + 1.0) - shape * b * (sum + 2.0)) /
                                  (shape * b * (sum + 2.0) * (sum + 3.0));
            return 3.0 + excess;
        }
        case DistributionKind::empirical:
            return sample_shape(distribution).kurtosis;
    }
    return 3.0;
}

Support support(const Distribution& distribution) {
    const auto from_standard = [&](double low, double high) {
        return Support{.low = distribution.location + distribution.scale * low,
                       .high = distribution.location + distribution.scale * high};
    };
    switch (distribution.kind) {
        case DistributionKind::normal:
        case DistributionKind::student_t:
            return {};
        case DistributionKind::constant:
            return from_standard(0.0, 0.0);
        case DistributionKind::curvilinear_trapezoid:
            return from_standard(-1.0 - distribution.shape, 1.0 + distribution.shape);
        case DistributionKind::gamma:
        case DistributionKind::exponential:
        case DistributionKind::lognormal:
            return {.low = distribution.location, .high = std::numeric_limits<double>::infinity()};
        case DistributionKind::beta:
            return from_standard(0.0, 1.0);
        case DistributionKind::empirical:
            return !distribution.samples || distribution.samples->empty()
                       ? from_standard(0.0, 0.0)
                       : from_standard(distribution.samples->front(), distribution.samples->back());
        default:
            return from_standard(-1.0, 1.0);
    }
}

}  // namespace gumcert::gum
