#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "jobs/comparison/comparison_job.h"
#include "tests/fuzz/job_targets.h"

namespace gumcert::jobs::fuzz {

inline void demand_consistent(const gum::ResultUncertainty& uncertainty) {
    demand(uncertainty.u >= 1e-60 && uncertainty.u <= 1e60 && uncertainty.U >= 1e-60 && uncertainty.U <= 1e60 &&
               uncertainty.k > 0.0 && uncertainty.degrees_of_freedom > 0.0,
           "an uncertainty");
}

inline void demand_consistent_laboratories(const ComparisonJob& job) {
    demand(job.participants.size() >= 2 && !job.items.empty() && !job.rounds.empty(), "the lists");
    std::vector<std::size_t> results(job.items.size(), 0);
    for (const ComparisonResult& result : job.results) {
        demand(result.participant < job.participants.size() && result.item < job.items.size() &&
                   result.round < job.rounds.size() && std::isfinite(result.value) && !result.where.empty(),
               "a result");
        demand(result.contributes || !result.reason.empty(), "a result without a reason");
        demand(!result.budget || !result.uncertainty, "a result with a budget and an uncertainty");
        if (result.uncertainty) {
            demand_consistent(*result.uncertainty);
        }
        ++results[result.item];
    }
    for (std::size_t item = 0; item < results.size(); ++item) {
        demand(results[item] >= 2 || job.refused_items.contains({item, std::nullopt}), "an item with one result");
    }
    for (const MissingResult& missing : job.missing) {
        demand(missing.participant < job.participants.size() && missing.item < job.items.size() &&
                   missing.round < job.rounds.size(),
               "a missing result");
    }
    for (const gum::ParticipantCorrelation& pair : job.correlations) {
        demand(pair.first < pair.second && pair.second < job.participants.size() && std::abs(pair.r) <= 1.0,
               "a correlation");
    }
    for (const gum::ComparisonVector& vector : job.vectors) {
        const auto n = static_cast<Eigen::Index>(vector.items.size());
        demand(n >= 2 && vector.correlation.rows() == n && vector.reference_correlation.cols() == n, "a vector");
    }
    for (const auto& [first, second] : job.youden) {
        demand(first != second && first < job.items.size() && second < job.items.size(), "a Youden pair");
    }
}

inline void demand_consistent(const ComparisonSide& side, std::size_t points) {
    if (side.budget) {
        demand(side.value.empty() && side.budget_points.size() == points, "points of a budget");
        for (const std::size_t point : side.budget_points) {
            demand(point < std::max<std::size_t>(side.budget->points.size(), 1), "a point of a budget");
        }
        return;
    }
    const auto n = static_cast<Eigen::Index>(points);
    demand(side.value.size() == points && side.uncertainty.size() == points && side.covariance.rows() == n &&
               side.covariance.cols() == n && side.covariance.allFinite(),
           "a side");
    for (Eigen::Index i = 0; i < n; ++i) {
        const double u = side.uncertainty[static_cast<std::size_t>(i)].u;
        demand(side.covariance(i, i) == u * u, "a diagonal");
        demand_consistent(side.uncertainty[static_cast<std::size_t>(i)]);
    }
}

inline void demand_consistent(const ComparisonJob& job) {
    demand(job.coverage_probability > 0.0 && job.coverage_probability < 1.0, "coverage probability");
    if (job.methods) {
        demand(!job.methods->points.empty() && job.participants.empty(), "a comparison of methods");
        demand_consistent(job.methods->laboratory, job.methods->points.size());
        demand_consistent(job.methods->reference, job.methods->points.size());
    } else {
        demand_consistent_laboratories(job);
    }
    demand_honest(job.warnings);
}

/// \param bundle  the files of a job; the job itself is `job.json`
inline bool comparison_job(std::string_view bundle) {
    return read_or_refused(
        bundle, [](const MemoryFileSource& files) { demand_consistent(read_comparison_job(files, "job.json")); });
}

}  // namespace gumcert::jobs::fuzz
