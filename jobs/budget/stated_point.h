#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gum/budget/budget.h"
#include "jobs/budget/budget_inputs.h"
#include "jobs/problem_list.h"
#include "jobs/statement_keys.h"

namespace gumcert::jobs {

/// The key or column that names a point.
inline constexpr std::string_view k_point_name = "point";

/// What a point states of the inputs in place of the job, while it is read. Inputs are known by their places in
/// BudgetInputs::stated().
struct StatedPoint {
    std::optional<std::string> name;
    std::map<std::size_t, StatementKeys> statements;                 ///< those of the job, with what stands here
    std::vector<std::pair<std::size_t, std::string_view>> replaced;  ///< inputs, and their keys that stand here
    std::map<std::size_t, int> decimals;                             ///< with which values are written
    std::set<std::size_t> refused;                                   ///< what is wrong with them is said already

    /// What holds of an input so far.
    [[nodiscard]] const StatementKeys& keys_of_input(std::size_t input, const BudgetInputs& inputs) const {
        const auto found = statements.find(input);
        return found == statements.end() ? *inputs.stated()[input].keys : found->second;
    }
    /// Takes over what the point says of a key of an input.
    void replace(std::size_t input, std::string_view key, StatementKeys keys) {
        statements.insert_or_assign(input, std::move(keys));
        replaced.emplace_back(input, key);
    }
};

/// The input that a point states under a name.
/// \param column  the head of the column of a file, for the advice; null for a point in the job
/// \return nothing where it was refused, or the input of that name was
[[nodiscard]] std::optional<std::size_t> input_of_point(const std::string& name, const std::string& where,
                                                        const BudgetInputs& inputs,
                                                        const std::vector<gum::BudgetFit>& fits, ProblemList& problems,
                                                        const std::string* column = nullptr);

}  // namespace gumcert::jobs
