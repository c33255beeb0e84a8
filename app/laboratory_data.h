#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/job/comparison_job.h"
#include "gum/comparison/reference_value.h"
#include "gum/quantity/progress.h"
#include "reports/record/comparison_evaluation.h"

namespace gumcert::app {

/// Results of one item in one round, as they are evaluated: those that have a value, in the order of the participants.
/// Positions count in `results`.
struct LaboratoryData {
    const engine::ComparisonItem* item = nullptr;
    std::string round;
    std::string where;                                     ///< item and round, for messages
    std::vector<const engine::ComparisonResult*> results;  ///< n
    Eigen::VectorXd x, u;                                  ///< n, in the unit of the item; u is 0 where none is stated
    Eigen::MatrixXd covariance;                            ///< n×n; empty: nothing correlates
    std::set<std::string> ambiguous_sources;               ///< shared in more than one way, see SourceCovariance
    /// Results that a consensus is made of, ascending. That of a reference laboratory is not among them.
    std::vector<std::size_t> contributing;
    std::optional<std::size_t> reference;  ///< result of the reference laboratory

    [[nodiscard]] std::size_t size() const { return results.size(); }
    [[nodiscard]] bool has_u(std::size_t i) const { return u[static_cast<Eigen::Index>(i)] > 0.0; }
    [[nodiscard]] std::vector<std::size_t> with_u() const;
    [[nodiscard]] bool all_have_u(const std::vector<std::size_t>& positions) const;
    /// Those at some positions, for gum; their covariance only where something correlates.
    [[nodiscard]] gum::LaboratoryResults at(const std::vector<std::size_t>& positions) const;
    [[nodiscard]] Eigen::VectorXd values(const std::vector<std::size_t>& positions) const;
};

/// The results of a job; where a budget stands for a result, the budget is evaluated for its value, its uncertainty and
/// the sources of it.
/// \param refused  receives the items with a budget that gives no result
/// \throws InputError, NoResultError  those of side_of_budget(), where the job has no other item
[[nodiscard]] std::vector<engine::ComparisonResult> results_with_budgets(const engine::ComparisonJob& job,
                                                                         const gum::Progress& progress,
                                                                         engine::RefusedItems& refused);

/// The results item by item and round by round; rounds in which nobody measured an item are left out.
[[nodiscard]] std::vector<LaboratoryData> laboratory_data(const engine::ComparisonJob& job,
                                                          const std::vector<engine::ComparisonResult>& results);

/// Finds who contributes to the assigned value of one item, who is its reference, and what its results have in common.
/// \param shared  receives what was found in the sources that several results name, each pair of participants once
/// \throws InputError  GC-COMPARE-0103 too many correlated results, -0106 no result of the reference laboratory; those
///                     of gum for a covariance that is none
void relate_results(const engine::ComparisonJob& job, LaboratoryData& data, std::vector<reports::SharedSource>& shared);

}  // namespace gumcert::app
