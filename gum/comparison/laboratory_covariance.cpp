#include "gum/comparison/laboratory_covariance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "gum/comparison/shared_sources.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"

namespace gumcert::gum {

namespace {

constexpr std::size_t k_most_shared_sources = 200;

using Pair = std::pair<std::size_t, std::size_t>;  // positions, ascending

double u_at(const LaboratoryData& data, std::size_t i) {
    return data.u[static_cast<Eigen::Index>(i)];
}

const ComparisonParticipant& participant_at(const ComparisonScheme& scheme, const LaboratoryData& data, std::size_t i) {
    return scheme.participants[data.results[i]->participant];
}

void require_few_enough(std::size_t count, const LaboratoryData& data) {
    if (count > k_most_correlated_laboratories) {
        throw InputError(Diagnostic{
            .code = "GC-COMPARE-0103",
            .where = data.where,
            .what = text::count_of(count, "result") + " that are correlated with others",
            .rule =
                "the covariance of up to " + std::to_string(k_most_correlated_laboratories) + " results is computed",
            .action = "State a source as independent, leave out the correlation of the group, or split the job."});
    }
}

/// Pairs of results that name a source in common, with its covariance.
std::map<Pair, std::vector<SourceCovariance>> covariance_of_sources(const ComparisonScheme& scheme,
                                                                    const LaboratoryData& data) {
    const std::set<std::string> independent(scheme.independent_sources.begin(), scheme.independent_sources.end());
    // Sources first, then pairs: only those that name a source in common are looked at, not all n² of them.
    std::map<std::string, std::set<std::size_t>> holders;
    for (std::size_t i = 0; i < data.size(); ++i) {
        if (data.has_u(i)) {
            for (const UncertaintySource& source : data.results[i]->sources) {
                holders[source.source].insert(i);
            }
        }
    }
    std::set<Pair> pairs;
    for (const auto& [source, positions] : holders) {
        if (positions.size() < 2 || independent.contains(source)) {
            continue;
        }
        require_few_enough(positions.size(), data);
        for (auto i = positions.begin(); i != positions.end(); ++i) {
            for (auto j = std::next(i); j != positions.end(); ++j) {
                pairs.emplace(*i, *j);
            }
        }
    }
    std::map<Pair, std::vector<SourceCovariance>> found;
    for (const Pair& pair : pairs) {
        found[pair] = shared_covariance(data.results[pair.first]->sources, data.results[pair.second]->sources,
                                        scheme.independent_sources);
    }
    return found;
}

/// Correlation coefficients that are stated: of groups, then pair by pair.
std::map<Pair, double> stated_correlations(const ComparisonScheme& scheme, const LaboratoryData& data) {
    std::map<Pair, double> stated;
    if (!scheme.group_correlation.empty()) {
        std::map<std::string, std::vector<std::size_t>> members;
        for (std::size_t i = 0; i < data.size(); ++i) {
            const std::string& group = participant_at(scheme, data, i).group;
            if (data.has_u(i) && scheme.group_correlation.contains(group)) {
                members[group].push_back(i);
            }
        }
        for (const auto& [group, positions] : members) {
            require_few_enough(positions.size() < 2 ? 0 : positions.size(), data);
            for (std::size_t a = 0; a < positions.size(); ++a) {
                for (std::size_t b = a + 1; b < positions.size(); ++b) {
                    stated[{positions[a], positions[b]}] = scheme.group_correlation.at(group);
                }
            }
        }
    }
    if (!scheme.correlations.empty()) {
        std::map<std::size_t, std::size_t> position;
        for (std::size_t i = 0; i < data.size(); ++i) {
            position[data.results[i]->participant] = i;
        }
        for (const ParticipantCorrelation& correlation : scheme.correlations) {
            const auto first = position.find(correlation.first);
            const auto second = position.find(correlation.second);
            if (first != position.end() && second != position.end() && data.has_u(first->second) &&
                data.has_u(second->second)) {
                stated[std::minmax(first->second, second->second)] = correlation.r;
            }
        }
    }
    return stated;
}

void note_shared(const LaboratoryData& data, const Pair& pair, const SourceCovariance& found,
                 std::vector<SharedSource>& shared) {
    const std::size_t first = data.results[pair.first]->participant;
    const std::size_t second = data.results[pair.second]->participant;
    const bool known = std::any_of(shared.begin(), shared.end(), [&](const SharedSource& other) {
        return other.source == found.source && other.first == first && other.second == second;
    });
    if (known || shared.size() >= k_most_shared_sources) {
        return;
    }
    SharedSource entry;
    entry.source = found.source;
    entry.first = first;
    entry.second = second;
    entry.covariance = found.covariance;
    entry.correlation = found.covariance / (u_at(data, pair.first) * u_at(data, pair.second));
    shared.push_back(std::move(entry));
}

}  // namespace

Eigen::MatrixXd laboratory_covariance(const ComparisonScheme& scheme, const LaboratoryData& data,
                                      std::vector<SharedSource>& shared, std::set<std::string>& ambiguous) {
    std::map<Pair, double> covariance;
    for (const auto& [pair, r] : stated_correlations(scheme, data)) {
        covariance[pair] = r * u_at(data, pair.first) * u_at(data, pair.second);
    }
    for (const auto& [pair, sources] : covariance_of_sources(scheme, data)) {
        if (covariance.contains(pair)) {
            continue;  // what is stated for this pair holds
        }
        for (const SourceCovariance& source : sources) {
            covariance[pair] += source.covariance;
            note_shared(data, pair, source, shared);
            if (source.ambiguous) {
                ambiguous.insert(source.source);
            }
        }
    }
    // Without any covariance the results stay independent, and the cheaper formulas hold.
    std::erase_if(covariance, [](const auto& entry) { return entry.second == 0.0; });
    if (covariance.empty()) {
        return {};
    }
    require_few_enough(data.size(), data);
    Eigen::MatrixXd matrix = data.u.cwiseAbs2().asDiagonal();
    for (const auto& [pair, value] : covariance) {
        const auto i = static_cast<Eigen::Index>(pair.first);
        const auto j = static_cast<Eigen::Index>(pair.second);
        matrix(i, j) = value;
        matrix(j, i) = value;
    }
    return matrix;
}

std::vector<std::optional<double>> least_variance_of_unknown_groups(const ComparisonScheme& scheme,
                                                                    const LaboratoryData& data,
                                                                    const Eigen::VectorXd& weights) {
    std::vector<std::optional<double>> change(data.size());
    std::map<std::string, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < data.size(); ++i) {
        const std::string& group = participant_at(scheme, data, i).group;
        if (data.has_u(i) && !group.empty() && !scheme.group_correlation.contains(group)) {
            members[group].push_back(i);
        }
    }
    std::set<Pair> stated;  // participants
    for (const ParticipantCorrelation& correlation : scheme.correlations) {
        stated.insert(std::minmax(correlation.first, correlation.second));
    }
    // What is stated or follows from sources is known, a stated r = 0 as well. Else the worst plausible case is that
    // the whole of the smaller uncertainty comes from a common source: cov = min(u_i, u_j)².
    const auto is_known = [&](std::size_t i, std::size_t j) {
        return (data.covariance.size() > 0 &&
                data.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) != 0.0) ||
               (!stated.empty() &&
                stated.contains(std::minmax(data.results[i]->participant, data.results[j]->participant)));
    };
    const auto largest_covariance = [&](std::size_t i, std::size_t j) {
        const double smaller = std::min(data.u[static_cast<Eigen::Index>(i)], data.u[static_cast<Eigen::Index>(j)]);
        return is_known(i, j) ? 0.0 : smaller * smaller;
    };
    for (const auto& [group, positions] : members) {
        if (positions.size() < 2) {
            continue;
        }
        // (e_i − w)ᵀ V (e_i − w) with the covariances of the group alone, V_ii = 0: wᵀVw − 2 (Vw)_i. It is proportional
        // to how much all of them share, so that its least value stands at all or at nothing.
        Eigen::VectorXd with_weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(positions.size()));
        for (std::size_t b = 0; b < positions.size(); ++b) {
            const double weight = weights[static_cast<Eigen::Index>(positions[b])];
            for (std::size_t a = 0; weight != 0.0 && a < positions.size(); ++a) {
                if (a != b) {
                    with_weights[static_cast<Eigen::Index>(a)] +=
                        weight * largest_covariance(positions[a], positions[b]);
                }
            }
        }
        double of_weights = 0.0;
        for (std::size_t a = 0; a < positions.size(); ++a) {
            of_weights += weights[static_cast<Eigen::Index>(positions[a])] * with_weights[static_cast<Eigen::Index>(a)];
        }
        for (std::size_t a = 0; a < positions.size(); ++a) {
            const std::size_t one = positions[a];
            if (std::all_of(positions.begin(), positions.end(),
                            [&](std::size_t other) { return other == one || is_known(one, other); })) {
                continue;
            }
            // A change that makes the variance larger is left out: E_n would only become smaller, and no correlation at
            // all is among the possible cases.
            change[positions[a]] = std::min(0.0, of_weights - 2.0 * with_weights[static_cast<Eigen::Index>(a)]);
        }
    }
    return change;
}

}  // namespace gumcert::gum
