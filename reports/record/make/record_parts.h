#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/monte_carlo/monte_carlo.h"
#include "gum/monte_carlo/monte_carlo_request.h"
#include "gum/monte_carlo/validation_in_unit.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/measurement_model.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

// What the records of all kinds of jobs are made of alike.

/// What a job says of itself, and what was noted while it was read and evaluated.
struct JobHead {
    const certificate::LocalisedText& title;
    double coverage_probability = 0.0;
    const nlohmann::json& document;
    const std::vector<gum::Diagnostic>& warnings;
    const std::vector<gum::Diagnostic>& notes;
};

/// A record without results: software, kind, the job and its files, options in force, warnings and then notes.
[[nodiscard]] reports::EvaluationRecord record_head(std::string_view kind, const JobHead& job,
                                                    const nlohmann::json& options,
                                                    const std::vector<reports::InputFile>& files);

/// Significant digits of a printed uncertainty (JCGM 100:2008, 7.2.6).
inline constexpr int k_digits_of_u = 2;

/// A number and its text with so many significant digits.
[[nodiscard]] Shown<double> shown_significant(double number, int digits);
/// The same, and from the hundreds on all digits before the decimal sign: 0.35, 12, 113 where shown_significant() has 1.1E+2.
/// For sizes that people compare with what they know of their set-up.
[[nodiscard]] Shown<double> shown_plain(double number, int digits);
/// A number and its text with so many decimals.
[[nodiscard]] Shown<double> shown_to_quantum(double number, int decimals);
/// A share, [1], and its text in percent.
[[nodiscard]] Shown<double> shown_share(double share);

/// Degrees of freedom as a record holds them: none stands for infinite, or for none that can be stated.
[[nodiscard]] std::optional<double> finite_or_none(double value);

/// How many trials a result of Monte Carlo rests on.
struct TrialsDone {
    std::uint64_t trials = 0;
    bool stabilised = true;
};

/// Monte Carlo as a job asks for it, for the options of a record; null without.
[[nodiscard]] nlohmann::json monte_carlo_json(const std::optional<gum::MonteCarloRequest>& asked);

/// \param validation  in the unit of the document
[[nodiscard]] reports::MonteCarloSummary monte_carlo_summary(const gum::MonteCarloOutput& output,
                                                             const gum::MonteCarloRequest& asked,
                                                             const TrialsDone& done, const gum::ToUnit& to_unit,
                                                             const std::optional<gum::Validation>& validation);

/// "A" or "B".
[[nodiscard]] const char* type_letter(gum::Evaluation evaluation);

}  // namespace gumcert::reports
