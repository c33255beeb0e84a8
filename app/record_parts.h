#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/measurement_model.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

// What the records of all kinds of jobs are made of alike.

/// What a job says of itself, and what was noted while it was read and evaluated.
struct JobHead {
    const std::string& title;
    double coverage_probability = 0.0;
    const nlohmann::json& document;
    const std::vector<gum::Diagnostic>& warnings;
    const std::vector<gum::Diagnostic>& notes;
};

/// A record without results: software, kind, the job and its files, options in force, warnings and then notes.
[[nodiscard]] reports::EvaluationRecord record_head(const std::string& kind, const JobHead& job,
                                                    const nlohmann::json& options,
                                                    const std::vector<reports::InputFile>& files);

/// Degrees of freedom as a record holds them: none stands for infinite, or for none that can be stated.
[[nodiscard]] std::optional<double> finite_or_none(double value);

/// Shortest decimal text that reads back as the same double.
[[nodiscard]] std::string shortest(double value);

/// "A" or "B".
[[nodiscard]] const char* type_letter(gum::Evaluation evaluation);

}  // namespace gumcert::app
