#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reports/record/shown.h"

namespace gumcert::reports {

// What a record holds of a rotary table beside its results: what the distances say of the measurement itself, and the
// curves in the forms in which a machine builder reads them. Printed texts are made by the application.

/// The largest of the tests of one kind of groups of distances.
struct GroupTestRow {
    std::string kind;               ///< "visit_length", "visit_pose", "dead_path_change", "drift" …
    std::int64_t tests = 1;         ///< of the kind, among which its level is divided
    Shown<double> test_value = {};  ///< chi-square
    std::int64_t degrees_of_freedom = 1;
    Shown<double> critical_value = {};  ///< of chi-square
    Shown<double> p_value = {1.0};
    std::string station = {}, reflector = {}, pass = {};  ///< "" where the kind has none
    Shown<std::optional<double>> angle_deg = {};
    std::optional<double> to_angle_deg = {};               ///< of a part of the turn, which begins at angle_deg
    Shown<std::optional<double>> estimate = {};            ///< none: not determined beside the other suspicious groups
    std::string unit = "um";                               ///< of the estimate: "um", "ppm", or "1" for a ratio
    Shown<std::optional<double>> minimal_detectable = {};  ///< in `unit`; none: not stated
    bool suspicious = false;
};

struct GroupTestSummary {
    double alpha = 0.001;             ///< probability that a sound measurement makes any group of any kind suspicious
    Shown<double> scale = {1.0};      ///< robust standard deviation of the test values of the visits
    std::vector<GroupTestRow> kinds;  ///< suspicious ones first, the least probable one first of all
    std::optional<double> unexplained_p_value = {};  ///< of what refutes the measurement without what is suspicious
};

/// Whether the reversal of one error motion is the same at all angles.
struct ReversalTestRow {
    std::string name;                                        ///< "EXA"
    Shown<double> test_value = {};                           ///< F
    double degrees_of_freedom = 1.0;                         ///< of the numerator: angles less one
    std::optional<double> residual_degrees_of_freedom = {};  ///< of the denominator; none: variances are stated
    Shown<double> p_value = {1.0};
    Shown<double> spread = {};  ///< root mean square about the mean, in `unit`
    std::string unit;           ///< "um" or "arcsec"
    bool depends_on_angle = false;
};

/// How the two senses of approach were adjusted.
struct ReversalModel {
    std::string model;                   ///< "constant": one reversal of all angles; "by_angle"
    double alpha = 0.0;                  ///< probability that any of the tests refutes reversals that are constant
    std::vector<ReversalTestRow> tests;  ///< of the six error motions; empty where nothing asked for them
};

/// One visit of the table to an angle: what its distances deviate by from what all other visits say.
struct VisitRow {
    std::string station, pass, direction;  ///< direction "+" or "-"
    double angle_deg = 0.0;
    std::optional<double> deviation_um = {};  ///< observed minus predicted, mean of its distances; none: not controlled
    std::optional<double> limit_um = {};      ///< of its magnitude: the largest of all visits exceeds it with alpha
    std::optional<double> axial_arcsec = {};  ///< rotation of the table about its axis beyond the adjusted curve
};

/// The six error motions of one sense of approach at one angle, [µm] and [arcsec].
struct SensePoint {
    double angle_deg = 0.0;
    std::array<double, 6> value{}, u{}, U{};
};

struct SenseCurve {
    std::string direction;  ///< "+" or "-"
    std::vector<SensePoint> points;
};

struct HarmonicOrder {
    std::int64_t order = 1;
    Shown<double> amplitude = {}, U = {};  ///< in the unit of the error motion
    double u = 0.0;
    Shown<double> phase_deg = {};  ///< 0 to 360: A cos(k θ - phase)
};

/// One error motion as a sum of harmonics.
struct HarmonicRow {
    std::string name, unit;  ///< "EXA", "um"
    std::vector<HarmonicOrder> orders;
    Shown<double> rms_rest = {};  ///< of the curve without these orders and without its mean
};

/// Temperatures and air about one station, and what the thermal expansion of the fixture did there.
struct StationEnvironment {
    std::string station;
    Shown<double> fixture_degC = {20.0}, u_fixture_K = {};
    Shown<std::optional<double>> air_degC = {}, pressure_hPa = {}, humidity_percent = {};
    Shown<double> expansion_um = {};  ///< of the largest distance in the fixture, corrected
};

struct Environment {
    Shown<double> reference_degC = {20.0}, expansion_per_K = {}, u_expansion_per_K = {};
    Shown<double> largest_distance_mm = {};  ///< between two points of the fixture
    Shown<double> largest_share = {};  ///< of the expansion in the variance of an error motion, mean over the angles
    std::vector<StationEnvironment> stations;
    std::string printed_lowest = {}, printed_highest = {};                  ///< temperatures of the fixture
    std::string printed_least_expansion = {}, printed_most_expansion = {};  ///< over the stations
};

}  // namespace gumcert::reports
