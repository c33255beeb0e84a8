#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/job/monte_carlo_request.h"
#include "gum/monte_carlo.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/measurement_model.h"
#include "gum/quantity/progress.h"
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

/// Does some work on a part of a job; what gum refuses is told with its place.
void at_place(const std::string& where, const std::function<void()>& work);

/// Carries a value, and a difference of values, from SI to the unit of a document.
struct ToUnit {
    std::function<double(double)> value, difference;
};

/// How many trials a result of Monte Carlo rests on.
struct TrialsDone {
    std::uint64_t trials = 0;
    bool stabilised = true;
};

/// Trials, seed and threads as a job asks for them, and who is told how far they are; nothing else is set.
[[nodiscard]] gum::MonteCarloOptions monte_carlo_options(const engine::MonteCarloRequest& asked, unsigned threads,
                                                         const gum::Progress& progress);
/// The same for the options of a record; null without Monte Carlo.
[[nodiscard]] nlohmann::json monte_carlo_json(const std::optional<engine::MonteCarloRequest>& asked);

/// \param validation  in the unit of the document
[[nodiscard]] reports::MonteCarloSummary monte_carlo_summary(const gum::MonteCarloOutput& output,
                                                             const engine::MonteCarloRequest& asked,
                                                             const TrialsDone& done, const ToUnit& to_unit,
                                                             const std::optional<gum::Validation>& validation);

/// Comparison of the law of propagation with Monte Carlo in the unit of the document, where the tolerance is half a
/// unit of a decimal digit (JCGM 101:2008, clause 8).
/// \param value, u, U  of the law of propagation, SI
[[nodiscard]] gum::Validation validation_in_unit(double value, double u, double U, const gum::MonteCarloOutput& output,
                                                 const ToUnit& to_unit, int digits);

/// "A" or "B".
[[nodiscard]] const char* type_letter(gum::Evaluation evaluation);

}  // namespace gumcert::app
