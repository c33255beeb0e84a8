#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "engine/job/budget_job.h"
#include "engine/job/comparison_job.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

/// What every named source contributes to one result of a budget: c_i u(x_i) with its sign, in the unit given.
/// Components of an input count one by one; those without a source are left out.
/// \param point, output  positions in the result
/// \param common_only    only inputs that all points of the table share
[[nodiscard]] std::vector<engine::UncertaintySource> uncertainty_sources(const engine::BudgetJob& job,
                                                                         const gum::BudgetResult& result,
                                                                         std::size_t point, std::size_t output,
                                                                         const gum::Unit& unit,
                                                                         bool common_only = false);

/// Covariance of two results through the sources that both name (JCGM 100:2008, F.1.2.3), source by source.
///
/// Contributions of one source are paired by the name of their input; where the names differ and each side has one
/// contribution of that source, these two are paired. Anything else cannot be told from the budgets: the product of the
/// root sums of squares is taken, which is the largest it can be, and `ambiguous` is set.
struct SourceCovariance {
    std::string source;
    double covariance = 0.0;
    bool ambiguous = false;
};
/// \param independent  names of sources that are not shared although both sides name them
[[nodiscard]] std::vector<SourceCovariance> shared_covariance(const std::vector<engine::UncertaintySource>& first,
                                                              const std::vector<engine::UncertaintySource>& second,
                                                              const std::vector<std::string>& independent);

/// A question for every group of names that differ in nothing but capitals, blanks, hyphens and the like: sources that
/// several results share are found by their names, and taken for independent where these differ.
/// \param different  names that are known to be different sources
/// \return GC-COMPARE-0129, warnings, in the order of the names
[[nodiscard]] std::vector<gum::Diagnostic> similar_source_names(const std::set<std::string>& names,
                                                                const std::vector<std::string>& different);

/// The sources of all points of one method.
struct PointSources {
    std::vector<std::vector<engine::UncertaintySource>> all = {};     ///< one list a point
    std::vector<std::vector<engine::UncertaintySource>> common = {};  ///< of them, those that all points share
};

/// Covariance of the values of two methods through the sources that both name: cov(method i, reference j), m×m.
/// An input that all points share ties every point of one method to every point of the other; an input that each point
/// has of its own ties equal points only.
[[nodiscard]] Eigen::MatrixXd cross_covariance_of_sources(const PointSources& method, const PointSources& reference,
                                                          const std::vector<std::string>& independent);

}  // namespace gumcert::app
