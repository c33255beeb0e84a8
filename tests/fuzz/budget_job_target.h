#pragma once

#include <cmath>
#include <string_view>

#include "jobs/budget/budget_job.h"
#include "tests/fuzz/job_targets.h"

namespace gumcert::jobs::fuzz {

inline void demand_consistent(const gum::BudgetInput& input) {
    demand(!input.name.empty() && !input.components.empty(), "an input without a statement");
    double u2 = 0.0;
    for (const gum::StatedQuantity& quantity : input.components) {
        demand(std::isfinite(quantity.value) && std::isfinite(quantity.u) && quantity.u >= 0.0, "a quantity");
        demand(quantity.degrees_of_freedom > 0.0, "degrees of freedom");
        demand(std::isfinite(quantity.distribution.location) && std::isfinite(quantity.distribution.scale) &&
                   quantity.distribution.scale >= 0.0,
               "a distribution");
        u2 += quantity.u * quantity.u;
    }
    demand(std::isfinite(u2) && input.constant == (u2 == 0.0), "a constant with or a variable without uncertainty");
}

inline void demand_consistent(const BudgetJob& job) {
    demand(job.coverage_probability > 0.0 && job.coverage_probability < 1.0, "coverage probability");
    for (const gum::BudgetInput& input : job.inputs) {
        demand_consistent(input);
    }
    for (const gum::InputCorrelation& pair : job.correlations) {
        demand(pair.first < pair.second && pair.second < job.inputs.size() && pair.r != 0.0 && std::abs(pair.r) <= 1.0,
               "a correlation");
    }
    for (const gum::BudgetPoint& point : job.points) {
        for (const auto& [index, input] : point.inputs) {
            demand(index < job.inputs.size() && job.inputs[index].name == input.name, "an input of a point");
            demand_consistent(input);
        }
    }
    for (const gum::BudgetFit& fit : job.fits) {
        demand(fit.x.rows() == fit.y.size() && fit.x.allFinite() && fit.y.allFinite() && !fit.parameters.empty() &&
                   fit.y_uncertainty.allFinite() && fit.x_uncertainty.allFinite(),
               "a fit");
    }
    demand_honest(job.warnings);
}

/// \param bundle  the files of a job; the job itself is `job.json`
inline bool budget_job(std::string_view bundle) {
    return read_or_refused(
        bundle, [](const MemoryFileSource& files) { demand_consistent(read_budget_job(files, "job.json")); });
}

}  // namespace gumcert::jobs::fuzz
