#pragma once

#include <span>
#include <string>
#include <vector>

#include "jobs/budget/budget_job.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"

namespace gumcert::jobs {

/// Reads the key `fits`: equations, parameters, data and their uncertainties, coherent SI. Every equation is compiled
/// once to check its names and units, and whether it needs start values.
///
/// \param inputs  names of the inputs of the job, which no parameter may have
[[nodiscard]] std::vector<gum::BudgetFit> read_fits(const JsonObject& root, const JsonDocument& document,
                                                    const std::vector<std::string>& inputs, JobFiles& files,
                                                    ProblemList& problems);

/// Why a text cannot be the name of a quantity of an equation; refuses it then.
[[nodiscard]] bool is_quantity_name(const std::string& name, const std::string& where, ProblemList& problems);

/// The unit under a key, one without it.
/// \return nothing when it was refused
[[nodiscard]] std::optional<gum::Unit> read_unit(const JsonObject& object, std::string_view key, ProblemList& problems);

/// Puts what a lower layer refused into a list.
/// \param where  the place, instead of what the layer names; else empty
void refuse_as(const gum::DiagnosedError& error, const std::string& where, ProblemList& problems);

/// An equation as one line of text.
/// \return nothing when it was refused
[[nodiscard]] std::optional<gum::EquationText> equation_text_of(const nlohmann::json& value, const std::string& where,
                                                                ProblemList& problems);

}  // namespace gumcert::jobs
