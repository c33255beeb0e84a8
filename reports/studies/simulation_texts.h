#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/rotary_table/studies/difference_tally.h"
#include "gum/rotary_table/studies/simulation_basis.h"
#include "gum/rotary_table/studies/simulation_request.h"
#include "gum/rotary_table/studies/simulation_study.h"

/// Words and numbers that documents and data files of `gumcert simulate` share.
namespace gumcert::reports::simulation {

/// What the source paper states of its simulation: largest relative differences, [1].
struct PaperFigure {
    std::size_t tally;
    const char* name;
    double largest;
};
constexpr std::array<PaperFigure, 4> k_paper{{{gum::k_offset_tally, "offset", 0.045},
                                              {gum::k_tilt_tally, "tilt", 0.0435},
                                              {gum::k_linear_tally, "linear", 0.0325},
                                              {gum::k_angular_tally, "angular", 0.0230}}};

/// What relative differences are relative to, by tally of a kind: assumed set-up, amplitudes of the error motions.
struct Scales {
    double offset, tilt, linear, angular;

    [[nodiscard]] double of(std::size_t tally) const;
    [[nodiscard]] bool complete() const { return offset > 0.0 && tilt > 0.0 && linear > 0.0 && angular > 0.0; }
};
[[nodiscard]] Scales scales_of(const gum::SimulationRequest& request);

[[nodiscard]] std::string percent_text(double share, int decimals = 2);
/// `value` in per cent of `scale`; empty without a scale.
[[nodiscard]] std::string relative(double value, double scale);
[[nodiscard]] std::string micrometres(double value);
[[nodiscard]] std::string arcseconds(double value);
/// "joint, average line".
[[nodiscard]] std::string method_text(const gum::Estimator& estimator);
[[nodiscard]] const char* method_word(const gum::Estimator& estimator);
[[nodiscard]] const char* datum_word(engine::Datum datum);
/// Tallies of single quantities with their names.
[[nodiscard]] std::vector<std::pair<std::size_t, std::string>> named_tallies(
    const engine::RotaryTableMeasurement& layout);
[[nodiscard]] bool is_linear(std::size_t tally);

}  // namespace gumcert::reports::simulation
