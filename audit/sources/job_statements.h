#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "reports/record/evaluation_record.h"

namespace gumcert::audit {

/// What the job of a record states of its input quantities: for all points, and what a point of a table states in its
/// place (docs/budget_job.md, "points"). The reader of jobs has refused what is wrong; here nothing is refused again.
class JobStatements {
public:
    explicit JobStatements(const reports::EvaluationRecord& record);

    /// The statement of an input as it holds at a point, an object; null where the job has none.
    /// \param point  name of the point; "" without a table
    [[nodiscard]] nlohmann::json of(const std::string& input, const std::string& point) const;
    /// The statement of a part of an input, found by its name: of a component, of the readings or of the resolution that stand
    /// beside each other or beside components (docs/budget_job.md, "components"); null where the job has no such part, as of
    /// those that come from a standard of the register.
    [[nodiscard]] nlohmann::json of_part(const std::string& input, const std::string& point,
                                         const reports::BudgetRow& part) const;
    /// The statement of an input that the record shows without parts: of its only component where it is stated as one, null
    /// where it is stated as a sum of several.
    [[nodiscard]] nlohmann::json of_whole(const std::string& input, const std::string& point) const;
    /// Inputs of which the job says how any two of a set correlate: by a coefficient, 0 too, a covariance matrix, observations that
    /// were taken together, or samples of one file.
    [[nodiscard]] const std::vector<std::set<std::string>>& inputs_with_correlation() const { return together_; }

private:
    nlohmann::json inputs_;                           ///< of the job
    std::map<std::string, nlohmann::json> by_point_;  ///< inputs by name, each an object
    std::vector<std::set<std::string>> together_;     ///< inputs of which the job says how any two correlate

    std::size_t first_ = 0;  ///< points of the sections before

    /// \param part  the job, or a section of it
    void read_points(const nlohmann::json& part, const reports::EvaluationRecord& record);
    void read_array(const nlohmann::json& points);
    void read_table(const std::string& bytes);
};

}  // namespace gumcert::audit
