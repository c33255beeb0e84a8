#include "gum/quantity/distribution.h"

#include <cmath>

namespace gumcert::gum {

std::string_view distribution_name(DistributionKind kind) {
    switch (kind) {
        case DistributionKind::constant:
            return "constant";
        case DistributionKind::normal:
            return "normal";
        case DistributionKind::uniform:
            return "uniform";
        case DistributionKind::triangular:
            return "triangular";
        case DistributionKind::arcsine:
            return "arcsine";
        case DistributionKind::trapezoidal:
            return "trapezoidal";
        case DistributionKind::curvilinear_trapezoid:
            return "curvilinear_trapezoid";
        case DistributionKind::student_t:
            return "student_t";
        case DistributionKind::gamma:
            return "gamma";
        case DistributionKind::exponential:
            return "exponential";
        case DistributionKind::lognormal:
            return "lognormal";
        case DistributionKind::beta:
            return "beta";
        case DistributionKind::empirical:
            return "empirical";
    }
    return "";
}

Distribution Distribution::constant(double value) {
    return {.kind = DistributionKind::constant, .location = value};
}

Distribution Distribution::normal(double mean, double standard_deviation) {
    return {.kind = DistributionKind::normal, .location = mean, .scale = standard_deviation};
}

Distribution Distribution::uniform(double centre, double half_width) {
    return {.kind = DistributionKind::uniform, .location = centre, .scale = half_width};
}

Distribution Distribution::student_t(double location, double scale, double degrees_of_freedom) {
    if (std::isinf(degrees_of_freedom)) {
        return normal(location, scale);
    }
    return {.kind = DistributionKind::student_t, .location = location, .scale = scale, .shape = degrees_of_freedom};
}

namespace {

/// Mean and variance of the values of an empirical distribution, each with probability 1/n.
struct SampleMoments {
    double mean = 0.0, variance = 0.0;
};

SampleMoments sample_moments(const Distribution& distribution) {
    if (!distribution.samples || distribution.samples->empty()) {
        return {};
    }
    const std::vector<double>& samples = *distribution.samples;
    const double n = static_cast<double>(samples.size());
    double mean = 0.0;
    for (const double x : samples) {
        mean += x / n;
    }
    double squares = 0.0;
    double sum = 0.0;  // of deviations: takes the rounding of the mean out of the squares
    for (const double x : samples) {
        squares += (x - mean) * (x - mean);
        sum += x - mean;
    }
    return {.mean = mean + sum / n, .variance = (squares - sum * sum / n) / n};
}

}  // namespace

double expectation(const Distribution& distribution) {
    const double shape = distribution.shape;
    double standard = 0.0;
    switch (distribution.kind) {
        case DistributionKind::student_t:
            standard = shape > 1.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
            break;
        case DistributionKind::gamma:
            standard = shape;
            break;
        case DistributionKind::exponential:
            standard = 1.0;
            break;
        case DistributionKind::lognormal:
            standard = std::exp(0.5 * shape * shape);
            break;
        case DistributionKind::beta:
            standard = shape / (shape + distribution.second_shape);
            break;
        case DistributionKind::empirical:
            standard = sample_moments(distribution).mean;
            break;
        default:
            break;
    }
    return distribution.location + distribution.scale * standard;
}

double standard_deviation(const Distribution& distribution) {
    const double shape = distribution.shape;
    double variance = 0.0;
    switch (distribution.kind) {
        case DistributionKind::constant:
            break;
        case DistributionKind::normal:
        case DistributionKind::exponential:
            variance = 1.0;
            break;
        case DistributionKind::uniform:
            variance = 1.0 / 3.0;
            break;
        case DistributionKind::triangular:
            variance = 1.0 / 6.0;
            break;
        case DistributionKind::arcsine:
            variance = 1.0 / 2.0;
            break;
        case DistributionKind::trapezoidal:
            variance = (1.0 + shape * shape) / 6.0;
            break;
        case DistributionKind::curvilinear_trapezoid:
            // Half-width uniform on 1 ± d: E[w²]/3 (JCGM 101:2008, 6.4.3).
            variance = 1.0 / 3.0 + shape * shape / 9.0;
            break;
        case DistributionKind::student_t:
            // Of the t-distribution itself, not u²: its variance is larger than its scale squared, and there is none up
            // to ν = 2.
            variance = shape > 2.0 ? shape / (shape - 2.0) : std::numeric_limits<double>::infinity();
            break;
        case DistributionKind::gamma:
            variance = shape;
            break;
        case DistributionKind::lognormal: {
            // expm1: for small shapes exp(s²) − 1 would lose its digits.
            const double s2 = shape * shape;
            variance = std::expm1(s2) * std::exp(s2);
            break;
        }
        case DistributionKind::beta: {
            const double sum = shape + distribution.second_shape;
            variance = shape * distribution.second_shape / (sum * sum * (sum + 1.0));
            break;
        }
        case DistributionKind::empirical:
            variance = sample_moments(distribution).variance;
            break;
    }
    return distribution.scale * std::sqrt(variance);
}

bool is_symmetric(const Distribution& distribution) {
    switch (distribution.kind) {
        case DistributionKind::gamma:
        case DistributionKind::exponential:
        case DistributionKind::lognormal:
        case DistributionKind::empirical:
            return false;
        case DistributionKind::beta:
            return distribution.shape == distribution.second_shape;
        default:
            return true;
    }
}

bool is_bounded(const Distribution& distribution) {
    switch (distribution.kind) {
        case DistributionKind::normal:
        case DistributionKind::student_t:
        case DistributionKind::gamma:
        case DistributionKind::exponential:
        case DistributionKind::lognormal:
            return false;
        default:
            return true;
    }
}

}  // namespace gumcert::gum
