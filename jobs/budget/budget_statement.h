#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "jobs/budget/budget_job.h"
#include "jobs/job_files.h"
#include "jobs/statement_keys.h"

namespace gumcert::jobs {

/// The keys that a column `NAME.key` of a table of points may have: those with one number.
[[nodiscard]] std::span<const std::string_view> budget_column_keys();

/// A specification of an instrument, in the unit of the input: its half-width is known once the reading is.
struct StatedSpecification {
    double percent_of_reading = 0.0, percent_of_range = 0.0, range = 0.0, floor = 0.0;
    std::optional<std::string> of;  ///< the input that is read; else the input itself
    gum::DistributionKind kind = gum::DistributionKind::uniform;
    std::optional<double> coverage_factor = {};  ///< the specification is an expanded uncertainty then
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
};

/// What a statement is evaluated with.
struct StatementContext {
    const gum::Unit& unit;
    /// Adds to the components before it: its value is a difference, without the origin of the scale.
    bool is_later_component = false;
    bool is_component = false;
    std::string_view input;               ///< its name
    std::optional<double> variance = {};  ///< from the key `covariance` of the job, [unit²]
    /// Readings that are all equal: where their resolution stands. "": nowhere that is known; "here": beside them; else the
    /// name of another input.
    std::string resolution = {};
    JobFiles& files;
};

struct EvaluatedStatement {
    gum::StatedQuantity quantity;
    bool is_constant = false;
    std::optional<StatedSpecification> specification;  ///< u of the quantity is missing until `specify` is called
};

/// Evaluates one statement: the row of the contract that its keys make, its estimate, standard uncertainty, degrees of
/// freedom and distribution, coherent SI.
/// \return nothing when anything was refused, which is in the list of problems then
[[nodiscard]] std::optional<EvaluatedStatement> evaluate_statement(const StatementKeys& keys,
                                                                   const StatementContext& context);

/// Uncertainty of a quantity from the specification of the instrument that read it.
/// \param reading  [unit], of the input that `specification.of` names
/// \return false when it was refused
[[nodiscard]] bool specify(gum::StatedQuantity& quantity, const StatedSpecification& specification, double reading,
                           const gum::Unit& unit, const StatementKeys& keys);

}  // namespace gumcert::jobs
