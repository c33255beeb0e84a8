#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/shown.h"

namespace gumcert::reports {

// What a record of kind "circle_closure" holds beside the results. Angles in `unit` of the record's section.

/// One run over the steps of the table, with one position of the artefact.
struct ClosureSeriesRow {
    std::int64_t position = 0;
    std::string repetition;  ///< "" where the position was measured once
    std::int64_t readings = 0;
    Shown<double> zero = {};
    Shown<std::optional<double>> drift = {};  ///< over a full turn; none where none was removed
    Shown<double> residual_rms = {};
    Shown<std::optional<double>> misclosure = {};  ///< closing reading minus first reading, in the sense of the table
};

/// One reading and what the solution leaves of it.
struct ClosureResidualRow {
    std::int64_t position = 0, step = 0, side = 0;
    std::string repetition;
    Shown<double> reading = {}, residual = {};
    double redundancy = 0.0;  ///< part of an error of the reading that its residual shows
};

/// F test of a scatter.
struct ClosureTestRow {
    /// "stated": the residuals against the repeatability that the job states; "repetition": the misfit of the model
    /// against the scatter of repeated series; "reading": the largest residual of one reading; "misclosure": the mean
    /// closing difference
    std::string name;
    Shown<double> statistic = {}, nu = {};
    Shown<std::optional<double>> nu_reference = {};  ///< none = infinite
    Shown<double> p_value = {1.0};                   ///< of "reading": for the largest of all readings (Bonferroni)
    bool accepted = true;                            ///< p-value of 0.001 at least
};

/// Comparison of two divided circles.
struct CircleClosure {
    std::string table, artefact;  ///< names of the deviations: "EAA" or "T", and "P"
    std::string artefact_description;
    std::string unit;  ///< of all angles here and of the results
    std::string printed_unit = {};
    std::string numbering;  ///< "with" or "against" the sense of the table
    std::string sense;      ///< of the readings: "positive" or "negative"
    std::string drift;      ///< "none" or "linear"
    std::int64_t steps = 0, positions = 0;
    std::vector<double> step_angles_deg, side_angles_deg;
    bool full = false;  ///< every position was measured, every series without a gap
    std::int64_t readings = 0, unknowns = 0;
    double degrees_of_freedom = 0.0;
    Shown<double> residual_standard_deviation = {}, u_reading = {};
    std::optional<double> nu_reading;  ///< none = infinite
    std::string u_reading_from;        ///< "residuals" or "stated"
    double condition_number = 1.0;
    std::vector<ClosureTestRow> tests;
    std::vector<ClosureSeriesRow> series;
    std::vector<ClosureResidualRow> residuals;
};

}  // namespace gumcert::reports
