#include "gum/comparison/shared_sources.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gumcert::gum {

namespace {

/// Contributions of one source to one result, by the name of their input.
using Contributions = std::map<std::string, double>;

using Sources = std::map<std::string, Contributions>;

/// By source, without those that are not shared.
Sources by_source(const std::vector<UncertaintySource>& sources, const std::vector<std::string>& independent) {
    Sources found;
    for (const UncertaintySource& source : sources) {
        if (!source.source.empty() &&
            std::find(independent.begin(), independent.end(), source.source) == independent.end()) {
            // With their signs: two contributions of one input may cancel, and one with the opposite sign makes the
            // covariance negative.
            found[source.source][source.input] += source.contribution;
        }
    }
    return found;
}

double root_sum_of_squares(const Contributions& contributions) {
    double sum = 0.0;
    for (const auto& [input, contribution] : contributions) {
        sum += contribution * contribution;
    }
    return std::sqrt(sum);
}

/// Where both sides have one contribution, these two; else by name, and the largest that the others can have.
SourceCovariance covariance_through(const std::string& source, const Contributions& first,
                                    const Contributions& second) {
    SourceCovariance result{.source = source};
    // cov = c_1 u · c_2 u: the source has one u, and each result its sensitivity.
    if (first.size() == 1 && second.size() == 1) {
        result.covariance = first.begin()->second * second.begin()->second;
        return result;
    }
    Contributions others_of_first;
    Contributions others_of_second = second;
    for (const auto& [input, contribution] : first) {
        const auto same = others_of_second.find(input);
        if (same == others_of_second.end()) {
            others_of_first.emplace(input, contribution);
        } else {
            result.covariance += contribution * same->second;
            others_of_second.erase(same);
        }
    }
    // The inequality of Cauchy and Schwarz: no pairing of these contributions has a larger covariance. The largest one
    // makes u of a difference smallest, and so never hides a failure.
    const double largest = root_sum_of_squares(others_of_first) * root_sum_of_squares(others_of_second);
    result.covariance += largest;
    result.ambiguous = largest > 0.0;
    return result;
}

std::vector<SourceCovariance> shared(const Sources& first, const Sources& second) {
    std::vector<SourceCovariance> found;
    for (const auto& [source, contributions] : first) {
        const auto other = second.find(source);
        if (other != second.end()) {
            found.push_back(covariance_through(source, contributions, other->second));
        }
    }
    return found;
}

double covariance_of(const Sources& first, const Sources& second) {
    double sum = 0.0;
    for (const SourceCovariance& of : shared(first, second)) {
        sum += of.covariance;
    }
    return sum;
}

std::vector<Sources> by_source(const std::vector<std::vector<UncertaintySource>>& points,
                               const std::vector<std::string>& independent) {
    std::vector<Sources> found;
    for (const std::vector<UncertaintySource>& point : points) {
        found.push_back(by_source(point, independent));
    }
    return found;
}

}  // namespace

std::vector<SourceCovariance> shared_covariance(const std::vector<UncertaintySource>& first,
                                                const std::vector<UncertaintySource>& second,
                                                const std::vector<std::string>& independent) {
    return shared(by_source(first, independent), by_source(second, independent));
}

Eigen::MatrixXd cross_covariance_of_sources(const PointSources& method, const PointSources& reference,
                                            const std::vector<std::string>& independent) {
    const std::vector<Sources> of_method = by_source(method.all, independent);
    const std::vector<Sources> of_reference = by_source(reference.all, independent);
    const std::vector<Sources> common_of_method = by_source(method.common, independent);
    const std::vector<Sources> common_of_reference = by_source(reference.common, independent);
    const auto m = static_cast<Eigen::Index>(of_method.size());
    Eigen::MatrixXd covariance(m, m);
    for (Eigen::Index j = 0; j < m; ++j) {
        const auto b = static_cast<std::size_t>(j);
        for (Eigen::Index i = 0; i < m; ++i) {
            const auto a = static_cast<std::size_t>(i);
            covariance(i, j) = i == j ? covariance_of(of_method[a], of_reference[a])
                                      : covariance_of(common_of_method[a], common_of_reference[b]);
        }
    }
    return covariance;
}

}  // namespace gumcert::gum
