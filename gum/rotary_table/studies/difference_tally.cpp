#include "gum/rotary_table/studies/difference_tally.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gumcert::gum {

namespace {

double square(double value) {
    return value * value;
}

double root_mean(double sum, std::size_t count) {
    return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
}

/// Tally of a reported quantity by its index, and of its kind.
std::pair<std::size_t, std::size_t> tallies_of(Eigen::Index index, Eigen::Index errors) {
    if (index < errors) {
        const auto component = static_cast<std::size_t>(index % 6);
        return {component, component < 3 ? k_linear_tally : k_angular_tally};
    }
    const auto set_up = static_cast<std::size_t>(index - errors);
    if (set_up < 4) {
        return {6 + set_up, set_up < 2 ? k_offset_tally : k_tilt_tally};
    }
    return {k_reversal_tally, k_reversal_tally};
}

}  // namespace

Tallies tally_of_campaign(const Eigen::VectorXd& value, const Eigen::VectorXd& assumed, const Eigen::VectorXd& in_datum,
                          const Eigen::VectorXd& u, const Eigen::VectorXd& k, Eigen::Index errors) {
    Tallies tallies;
    for (Eigen::Index i = 0; i < value.size(); ++i) {
        DifferenceTally one;
        const double difference = value[i] - assumed[i];
        const double measurement = value[i] - in_datum[i];
        one.count = 1;
        one.sum_absolute = one.maximum = std::abs(difference);
        one.sum_squares = square(difference);
        one.sum_datum_squares = square(in_datum[i] - assumed[i]);
        one.sum_measurement_squares = square(measurement);
        if (u.size() > 0 && u[i] > 0.0) {  // at home nothing is stated in the datum of the home position
            one.judged = 1;
            one.sum_stated_squares = square(u[i]);
            one.sum_normalised_squares = square(measurement / u[i]);
            one.covered = std::abs(measurement) <= k[i] * u[i] ? 1 : 0;
        }
        const auto [own, kind] = tallies_of(i, errors);
        tallies[own].add(one);
        if (kind != own) {
            tallies[kind].add(one);
        }
        tallies[k_all_tally].add(one);
    }
    for (DifferenceTally& tally : tallies) {
        if (tally.count > 0) {
            tally.campaigns = 1;
            tally.sum_largest = tally.maximum;
        }
        if (tally.judged > 0) {
            tally.runs = 1;
            tally.sum_coverage = static_cast<double>(tally.covered) / static_cast<double>(tally.judged);
            tally.sum_coverage_squares = square(tally.sum_coverage);
        }
    }
    return tallies;
}

void add(Tallies& sum, const Tallies& run) {
    for (std::size_t t = 0; t < k_tallies; ++t) {
        sum[t].add(run[t]);
    }
}

void DifferenceTally::add(const DifferenceTally& other) {
    count += other.count;
    sum_absolute += other.sum_absolute;
    sum_squares += other.sum_squares;
    maximum = std::max(maximum, other.maximum);
    campaigns += other.campaigns;
    sum_largest += other.sum_largest;
    sum_datum_squares += other.sum_datum_squares;
    sum_measurement_squares += other.sum_measurement_squares;
    sum_stated_squares += other.sum_stated_squares;
    judged += other.judged;
    sum_normalised_squares += other.sum_normalised_squares;
    covered += other.covered;
    runs += other.runs;
    sum_coverage += other.sum_coverage;
    sum_coverage_squares += other.sum_coverage_squares;
}

double DifferenceTally::mean_absolute() const {
    return count == 0 ? 0.0 : sum_absolute / static_cast<double>(count);
}

double DifferenceTally::rms() const {
    return root_mean(sum_squares, count);
}

double DifferenceTally::mean_largest() const {
    return campaigns == 0 ? 0.0 : sum_largest / static_cast<double>(campaigns);
}

double DifferenceTally::datum_rms() const {
    return root_mean(sum_datum_squares, count);
}

double DifferenceTally::measurement_rms() const {
    // Where something is stated, nothing is at home in its datum: zeros would only dilute.
    return root_mean(sum_measurement_squares, judged > 0 ? judged : count);
}

double DifferenceTally::stated_rms() const {
    return root_mean(sum_stated_squares, judged);
}

double DifferenceTally::normalised_rms() const {
    return root_mean(sum_normalised_squares, judged);
}

double DifferenceTally::coverage() const {
    return judged == 0 ? 0.0 : static_cast<double>(covered) / static_cast<double>(judged);
}

double DifferenceTally::coverage_standard_error() const {
    if (runs < 2) {
        return 0.0;
    }
    const auto n = static_cast<double>(runs);
    const double variance = std::max(0.0, (sum_coverage_squares - square(sum_coverage) / n) / (n - 1.0));
    return std::sqrt(variance / n);
}

}  // namespace gumcert::gum
