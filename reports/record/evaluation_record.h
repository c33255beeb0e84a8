#pragma once

#include "certificate/certified_results.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/budget_evaluation.h"
#include "reports/record/circle_closure_evaluation.h"
#include "reports/record/comparison_evaluation.h"
#include "reports/record/identified_sentence.h"
#include "reports/record/rotary_evidence.h"
#include "reports/record/shown.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::reports {

/// A value and its expanded uncertainty as a document prints them: rounded once, by gum/rounding, and never again.
struct Printed {
    std::string value;
    std::string U;     ///< "" where a value has no uncertainty by definition (home angle of the home datum)
    std::string unit;  ///< as printed: "µm", "″", "mm"
};

/// What every document prints of a result: the result that holds (`results.NAME.reported`). The numbers of the law of
/// propagation stay beside it in Result. Texts are made of the numbers by reports/record/reported_result.h alone.
struct ReportedResult {
    std::string method = "law_of_propagation";      ///< or "monte_carlo"
    double value = 0.0;                             ///< estimate, in the unit of the result
    std::optional<double> u;                        ///< none: no variance exists (Monte Carlo)
    std::optional<std::array<double, 2>> interval;  ///< [low, high]; none: no interval can be stated
    double coverage_probability = 0.9545;
    /// Only where the interval is symmetric about the value to the printed digit; k = U/u
    std::optional<double> U, k;
    /// Why Monte Carlo is reported: "asked", "second_order", "vanishing", "no_derivative", "not_linear", "asymmetric",
    /// "contradicted"; "" for the law of propagation
    std::string because;
    /// The same ids: what speaks against the law of propagation where the job asks for it all the same; "" else
    std::string against;
    Printed printed;                                   ///< value, U ("" where only the interval holds), unit
    std::string printed_u, printed_low, printed_high;  ///< low and high: "" where U is printed
};

/// One row of an uncertainty budget (JCGM 100:2008, 7.2.7; layout of table H.1).
struct BudgetRow {
    std::string input;
    /// Estimate, in `unit`, and its text without it; none where the row stands for many input quantities
    Shown<std::optional<double>> value = {};
    std::string unit;
    Shown<double> u = {};                  ///< standard uncertainty (of one typical quantity of the row), in `unit`
    Shown<std::optional<double>> nu = {};  ///< degrees of freedom; none = infinite
    std::string type;                      ///< "A" or "B"
    std::string distribution;
    Shown<std::optional<double>> sensitivity = {};  ///< none where the row stands for many input quantities
    Shown<double> contribution = {};                ///< |c| u, in the unit of the result
    Shown<double> share = {};                       ///< contribution² / u²; its text in percent
    std::string source;
    std::vector<BudgetRow> components;  ///< the parts of an input that is a sum, as table H.1 of the GUM shows them
    /// "" for an input. "fit" for all parameters of a fit together, their covariances included; its components are
    /// "fit_data", what comes from each column of the data (their squares add up to that of the row), and
    /// "fit_parameter", each parameter alone, which do not add up. "scatter" for the readings of a circle closure; "extremes" of a
    /// range for what is not known of which values are extreme
    std::string role = {};
    /// Of a component that the program named, in English, so that documents name it in theirs: "calibration", "interpolation"
    /// and "drift" are those of a standard of the register, by a certificate, since its day; "readings", "resolution". "" else
    std::string part = {};
    std::string standard = {}, certificate = {}, since = {};
};

/// What the correlations of the inputs add to the variance of a result: 2 Σ c_i c_j u_i u_j r_ij, often negative.
struct CorrelationRow {
    double variance = 0.0;                  ///< in the square of the unit of the result
    std::string printed_contribution = {};  ///< root of |variance| with its sign
    Shown<double> share = {};               ///< variance / u²; its text in percent
};

/// `results.NAME`
struct Result {
    std::string name;
    std::string description;  ///< "offset of the fixture along y"; English where it is stated in several languages
    certificate::LocalisedText description_by_language = {};  ///< empty where `description` is for all languages
    double value = 0.0;
    std::string unit;  ///< "um", "arcsec", … as UDUNITS-2 writes it
    double u = 0.0;
    std::optional<double> nu_eff;                  ///< none = infinite, or none can be stated: see `coverage`
    std::optional<double> k;                       ///< none: no expanded uncertainty can be stated
    std::optional<double> k_numerical_error = {};  ///< standard uncertainty of a k that was found by draws
    double coverage_probability = 0.9545;
    std::optional<double> U;
    std::string distribution;  ///< of the result: "normal", "student_t", "convolution", "numerical", "not stated"
    /// Where k comes from: "student_t", "normal", "convolution" (exact, a bounded input dominates), "monte_carlo" (half
    /// the width of the symmetric interval), "none"
    std::string coverage = "student_t";
    std::string coverage_note;  ///< a sentence where `coverage` is not what a person expects; "" else
    Printed printed;            ///< of the law of propagation; documents print `reported`
    ReportedResult reported;    ///< what holds, is printed, certified and compared with limits
    std::vector<BudgetRow> budget;
    std::optional<CorrelationRow> correlation;  ///< where inputs of the budget are correlated
    std::string quantity;                       ///< the output; differs from the name where there is a table of points
    std::string point;                          ///< name of the point of a table; "" without one
    std::optional<SecondOrder> second_order;    ///< where the second-order terms matter
    std::optional<MonteCarloSummary> monte_carlo;
};

/// A number of a rotary table that is stated with its uncertainty, and the texts that every document prints of it: an
/// error motion at one angle, its reversal, its range, where the axis is, a parameter of ISO 230-2.
/// reports/record/stated_values.h lists all of a table.
struct StatedValue {
    double value = 0.0, u = 0.0, U = 0.0, k = 2.0;  ///< of the law of propagation, [µm] or [arcsec]
    std::optional<double> nu_eff;                   ///< none = infinite
    Printed printed;
    std::optional<MonteCarloSummary> monte_carlo = {};  ///< without histogram
    std::optional<ReportedResult> reported = {};        ///< none: the law of propagation, nothing speaks against it
};

struct ErrorsAtAngle {
    Shown<double> angle_deg = {};
    std::array<StatedValue, 6> errors;  ///< in the order of RotaryTable::error_names
};

struct SetUp {
    std::array<double, 3> O_um{}, S_arcsec{}, u_O_um{}, u_S_arcsec{}, U_O_um{}, U_S_arcsec{};
    double k = 2.0;
    std::array<Printed, 3> printed_O, printed_S;  ///< along the axis: value "0", U ""
};

/// Mean difference between the two senses of approach, positive minus negative, of one error motion.
struct Reversal {
    std::string name;  ///< "EXA" …
    StatedValue stated;
};

struct Station {
    std::string name;
    std::array<double, 3> position_mm{}, u_mm{};
    double scale_deviation = 0.0, u_scale = 0.0;            ///< s - 1, [1]
    std::vector<std::string> printed_position;              ///< three
    std::vector<std::string> printed_U;                     ///< three, expanded, k of the record
    Printed printed_scale;                                  ///< s - 1 and its U, unit "1e-6"; empty texts: not printed
    std::array<std::array<double, 3>, 3> covariance_mm2{};  ///< of the position, for confidence ellipses
};

struct DeadPath {
    std::string name;
    double value_mm = 0.0, u_mm = 0.0;
    Printed printed;
};

struct Reflector {
    std::string name;
    std::array<double, 3> position_mm{}, u_mm{};            ///< adjusted, fixture frame, at reference temperature
    std::array<double, 3> correction_um{};                  ///< adjusted minus CMM
    std::vector<std::string> printed_position, printed_U;   ///< three each
    std::vector<std::string> printed_correction;            ///< three, [µm]
    std::array<double, 3> home_position_mm{};               ///< in T of the datum at the home angle
    std::array<std::array<double, 3>, 3> covariance_mm2{};  ///< of `position_mm`
    std::array<double, 3> cmm_mm{}, u_cmm_mm{};             ///< as the CMM (or the budget of the fixture) states them
    std::vector<std::string> printed_cmm, printed_U_cmm;    ///< three each
};

/// Variance shares of one reported quantity. `shares` is parallel to RotaryTable::budget_sources and sums to 1.
struct QuantityBudget {
    std::string quantity;             ///< "EXA" … or "O_y"
    std::optional<double> angle_deg;  ///< none: not a function of the angle
    double u = 0.0;
    std::string unit;
    std::vector<double> shares;
};

/// Means over all angles, for people: one row an error motion.
struct BudgetSummaryRow {
    std::string quantity;
    Shown<double> rms_u = {};
    std::string unit;
    Shown<std::vector<double>> shares = {};  ///< texts in percent
};

struct VarianceFactor {
    double a_priori = 1.0;
    Shown<double> a_posteriori = {1.0};
    std::string used;         ///< "a_priori" or "a_posteriori"
    std::string reason = {};  ///< a sentence: why this one
};

/// Two-sided test of chi-square of the adjustment against its distribution.
/// p-value of a global test below which nobody takes the residuals for chance: they refute the uncertainties.
inline constexpr double k_refuting_probability = 0.001;

struct GlobalTest {
    double probability = 0.95;             ///< of the region of acceptance
    Shown<double> lower = {}, upper = {};  ///< limits of chi-square
    bool accepted = true;
    std::string meaning;  ///< what the answer says here, where components are estimated from it too
};

struct AdjustmentSummary {
    std::string method;  ///< "joint" or "sequential"
    std::int64_t observations = 0, parameters = 0, degrees_of_freedom = 0, iterations = 0;
    Shown<double> chi_square = {}, p_value = {}, condition_number = {};
    VarianceFactor variance_factor;
    GlobalTest global_test;
};

struct VarianceComponent {
    std::string name;             ///< "length noise", "table linear", "table angular, axial", "table angular, tilt"
    double value = 0.0, u = 0.0;  ///< a standard deviation and its standard uncertainty, in `unit`
    std::string unit;             ///< "um" or "arcsec"
    double redundancy = 0.0;
    bool estimated = false;
    Printed printed;                                ///< U holds the standard uncertainty of the component (k = 1)
    Shown<std::optional<double>> stated = {};       ///< what the job states, in `unit`; for the fixture 1 (a factor)
    std::optional<double> degrees_of_freedom = {};  ///< of the estimate; none where it is given
    bool used = true;  ///< in the weights; false: estimated as a check of the stated value only
    /// What the residuals give, in `unit`, where they hardly determine it: `value` is then what they leave plausible.
    std::optional<double> residuals_give = {};
};

struct ReliabilityRow {
    std::string station, reflector, pass;
    double angle_deg = 0.0;
    double residual_um = 0.0, redundancy_number = 0.0, test_value = 0.0, minimal_detectable_bias_um = 0.0;
    bool flagged = false, removed = false;
    std::string printed_length = {};  ///< [mm], as read; of small measurements only, whose annex lists the distances
};

/// A flagged distance, as a document lists it, in the order in which they were found.
struct FlaggedDistance {
    std::string station, reflector, pass, angle, residual_um, test_value;  ///< printed
    bool removed = false;
    std::string estimated_error_um = {};  ///< printed: what the distance is off by, from the others
    std::string found_with = {};          ///< printed: test value when it was found, and the critical value then
    std::string reason = {};              ///< a sentence
};

/// One coordinate of the fixture as an observation.
struct FixtureReliabilityRow {
    std::string reflector, coordinate;
    double residual_um = 0.0, redundancy_number = 0.0, test_value = 0.0, minimal_detectable_bias_um = 0.0;
};

/// The largest change that an error of one distance, just too small to be found, makes in one reported quantity.
struct ExternalReliability {
    std::string quantity;
    std::optional<double> angle_deg;  ///< of the quantity
    double influence = 0.0;           ///< in `unit`
    std::string unit;
    double ratio_to_U = 0.0;               ///< influence / U of the quantity
    std::string station, reflector, pass;  ///< the distance that has it
    double at_angle_deg = 0.0, minimal_detectable_bias_um = 0.0;
};

/// One number derived from the error motions: where the axis is, a parameter of ISO 230-2.
struct TableParameter {
    std::string name;  ///< "axis_y", "R_up"
    std::string description;
    std::string unit;  ///< "um" or "arcsec"
    StatedValue stated;
};

/// A point that is known in the frame of the machine.
struct MachinePoint {
    std::string name;
    std::array<double, 3> residual_um{};  ///< machine - measurement carried to it
    double u_um = 0.0;                    ///< of each coordinate in the machine
};

/// The reference frame of the machine, in which location errors are stated.
struct MachineFrame {
    std::string by;  ///< "probing" of reflectors, "stations"
    std::string source;
    std::array<double, 3> nominal_point_mm{};
    std::vector<MachinePoint> points;
    double chi_square = 0.0, degrees_of_freedom = 0.0;
    Shown<double> p_value = {1.0};
    std::string printed_residual;  ///< rms, [µm]
};

/// Deviations of the axial rotation at one target position (ISO 230-2), [arcsec].
struct PositioningTarget {
    Shown<double> angle_deg = {};
    Shown<std::optional<double>> mean_up = {}, mean_down = {}, s_up = {}, s_down = {}, reversal = {};
    std::vector<double> runs_up = {}, runs_down = {};  ///< deviations of the single runs
};

/// Accuracy and repeatability of positioning about the axis (ISO 230-2), [arcsec].
struct PositioningAccuracy {
    std::int64_t runs_up = 0, runs_down = 0;
    std::vector<TableParameter> parameters;  ///< M, E, E_up … A_down, those that the runs allow
    std::vector<PositioningTarget> targets;
    Shown<double> u_deviation = {};  ///< rms standard uncertainty of one deviation of one run
    std::vector<std::string> remarks;
};

/// Monte Carlo of the whole measurement.
struct RotaryMonteCarlo {
    std::int64_t trials = 0, seed = 1;
    std::int64_t most_steps = 0;  ///< of one trial until it converged
    double mean_steps = 0.0;
    std::int64_t compared = 0, validated = 0;  ///< reported quantities; those where both methods agree (clause 8)
    std::vector<std::string> not_validated;    ///< their names
    std::string statement;                     ///< a sentence for people
};

/// Uncertainty of one coordinate of the fixture, from its budget.
struct FixtureBudget {
    std::string method;              ///< "stated", "budget" or "source_paper"
    std::string file;                ///< of the budget
    std::vector<BudgetRow> largest;  ///< the budget of the coordinate with the largest uncertainty
    std::string largest_coordinate;  ///< its name
    std::vector<std::string> remarks;
};

/// ISO 230-7 range of one error motion over the angles.
struct RangeRow {
    std::string name;
    StatedValue stated;
};

/// Distances that the laboratory left out by the job: those that agree with everything that is named. "" and none: all.
struct ExcludedDistances {
    std::string station, reflector, pass;
    std::string direction;  ///< "+", "-" or ""
    std::string angle;      ///< printed, in degrees
    std::string lines;      ///< "14" or "14–20" of the lengths file
    std::int64_t count = 0;
    std::string reason;  ///< as the laboratory states it
};

struct RotaryTable {
    std::string axis;   ///< "A", "B" or "C"
    std::string datum;  ///< "axis_average_line" or "home"
    std::string method;
    double home_angle_deg = 0.0;
    std::array<std::string, 6> error_names;
    std::array<std::string, 6> error_units;  ///< "um", "um", "um", "arcsec", "arcsec", "arcsec"
    SetUp set_up, axis_in_fixture;
    std::vector<ErrorsAtAngle> errors;
    std::vector<Reversal> reversal;  ///< empty when only one sense of approach was measured
    std::vector<RangeRow> ranges;
    std::optional<std::string> covariance_file;  ///< name of the CSV beside the record
    std::vector<std::string> covariance_order;   ///< names of its rows and columns
    std::string covariance_unit;                 ///< "um and arcsec, products"
    std::vector<Station> stations;
    std::vector<DeadPath> dead_paths;
    std::vector<Reflector> reflectors;
    std::vector<std::string> budget_sources;
    std::vector<QuantityBudget> budget;
    std::vector<BudgetSummaryRow> budget_summary;
    AdjustmentSummary adjustment;
    std::vector<VarianceComponent> variance_components;
    std::vector<ReliabilityRow> reliability;
    std::vector<FlaggedDistance> flagged;
    Shown<double> outlier_critical_value = {};
    double outlier_alpha = 0.0;
    std::vector<FixtureReliabilityRow> fixture_reliability;
    std::vector<ExternalReliability> external_reliability;  ///< one a reported quantity
    std::vector<TableParameter> axis_line;                  ///< of the axis average line in the frame of the fixture
    /// Of the axis in the frame of the machine (ISO 230-7); empty without such a frame, or where it is refuted.
    std::vector<TableParameter> location_errors = {};
    std::optional<MachineFrame> machine_frame = {};
    std::optional<PositioningAccuracy> iso230_2;
    std::optional<RotaryMonteCarlo> monte_carlo;
    std::optional<FixtureBudget> fixture_budget;
    std::optional<GroupTestSummary> group_tests = {};
    std::optional<ReversalModel> reversal_model = {};  ///< none where only one sense of approach was measured
    std::vector<VisitRow> visits = {};                 ///< in the order of the measurement
    std::vector<SenseCurve> sense_curves = {};         ///< positive approach first; empty where one sense was measured
    std::vector<HarmonicRow> harmonics = {};           ///< empty where the angles do not cover the circle
    std::optional<Environment> environment = {};       ///< with an environment file
    std::vector<ExcludedDistances> exclusions = {};    ///< in the order of the job
};

/// One compared value: of a method against a reference method at one point, or of a laboratory for one item. Units are
/// that of the comparison or of the item. What cannot be said is absent.
struct ComparisonPoint {
    std::string direction = {};            ///< "x", "y", "z" of a rotary table, or what the job calls it; "" without
    std::optional<double> angle_deg = {};  ///< rotary tables
    std::string printed_angle = {};        ///< or position
    Shown<double> value = {};
    std::optional<double> u = {};  ///< none: the laboratory states no uncertainty
    Shown<std::optional<double>> U = {};
    Shown<double> reference_value = {};  ///< or the assigned value
    std::optional<double> reference_u = {};
    Shown<std::optional<double>> reference_U = {};
    Shown<double> D = {};
    std::optional<double> u_D = {};
    Shown<std::optional<double>> U_D = {}, En = {}, zeta = {};
    std::string name = {};                                ///< of the point of a comparison of methods
    std::optional<double> position = {};                  ///< of it, in Comparison::position_unit
    std::string participant = {}, item = {}, round = {};  ///< between laboratories: ids
    bool contributes = true;                              ///< to the assigned value
    std::string reason = {};                              ///< why not
    Shown<std::optional<double>> k = {};
    std::optional<double> nu = {}, reference_k = {};
    /// That U covers, where a budget says it: k is that of the distribution of its result then, and need not be t_p(nu).
    std::optional<double> coverage_probability = {}, reference_coverage_probability = {};
    std::optional<double> correlation = {};  ///< r of value and reference value, as used in u_D and U_D
    Shown<std::optional<double>> z = {}, z_prime = {}, D_percent = {}, P_A = {};
    /// For the worst plausible correlation, where r is not known; text "∞" without a number: no finite number bounds it.
    Shown<std::optional<double>> En_worst = {};
    Shown<std::optional<double>> En_audited = {};  ///< with findings on the uncertainties corrected
    /// "none", "warning" or "action", the strongest of all scores; "inconclusive" where the reference or assigned value
    /// is too uncertain to clear anybody; "" without score.
    std::string signal = {};
    std::vector<std::string> signal_by = {};  ///< scores that give it: "z", "En", "En_audited" …
    /// U and k that E_n takes in place of those stated, so that both sides have about 95 %; none: as stated.
    Shown<std::optional<double>> U_of_scores = {}, k_of_scores = {};
    std::optional<double> reference_U_of_scores = {};  ///< the same of the reference, between methods
    /// Where the assigned value is made of results that scatter: its standard uncertainty as all other results show it,
    /// their degrees of freedom, their covariance with this result, the share of this result in the value, and the
    /// factor of U_D of a median. U_D = factor t_p(nu_D) (1 − share) √(u² + u_others² + u_item² − 2 cov), with u_item
    /// of homogeneity and stability; with coverage_probability, U as E_n takes it over t_p(nu) in place of u.
    std::optional<double> u_others = {}, nu_others = {}, covariance_others = {}, share = {}, factor_D = {}, nu_D = {};
    Shown<std::optional<double>> D_low = {}, D_high = {};  ///< coverage interval of D by trials
    std::string realism = {};  ///< of u: "plausible", "small", "large" against u(X) and 1.5 s*; "" where not judged
    std::optional<double> U_over_CMC = {};
    std::optional<double> U_over_median = {};  ///< of the U of all other laboratories
};

/// Companion numbers of several scores.
struct ComparisonSummary {
    std::string direction;  ///< "x", "y", "z", "all" …; the key in the record
    std::int64_t points = 0, count_above_1 = 0;
    Shown<double> mean_abs_En = {}, max_abs_En = {}, rms_En = {};
    Shown<std::optional<double>> rms_En_low = {}, rms_En_high = {};  ///< 95 % band where uncertainties are right
    Shown<std::optional<double>> p_low = {}, p_high = {};            ///< given the correlations of the points
    /// Where finite degrees of freedom and correlations leave the joint distribution open: the smallest of its bounds,
    /// p_low and so on being the largest; none where it is known.
    Shown<std::optional<double>> p_low_least = {}, p_high_least = {};
    std::optional<double> p_mahalanobis_least = {};
    Shown<std::optional<double>> p_pattern = {};  ///< p_mahalanobis where 5 % of u of each point may be rounding
    /// Smallest U_D of the points: the smallest deviation that would have failed; and the largest one
    Shown<std::optional<double>> D_fail = {}, D_fail_largest = {};
    Shown<std::optional<double>> effective_points = {};
    std::optional<double> mahalanobis_square = {};
    Shown<std::optional<double>> p_mahalanobis = {}, vector_En = {};
    std::optional<std::int64_t> rank = {};
    Shown<std::optional<double>> ratio_reference = {};               ///< rms U of the reference / rms U of the method
    std::optional<double> p_if_too_small = {}, p_if_too_large = {};  ///< of Σζ² if U should be twice, or half, as large
    Shown<std::optional<double>> power_to_confirm = {};              ///< share of right U that the points would confirm
    bool power_lacks_degrees = false;                  ///< it would be enough if all degrees of freedom were infinite
    std::optional<std::int64_t> count_by_chance = {};  ///< limit of count_above_1
    /// Constant deviation that is found at every single point with a probability of 80 % and 95 %.
    Shown<std::optional<double>> found_with_80_percent = {}, found_with_95_percent = {};
    Shown<std::optional<double>> max_abs_En_worst = {};
    std::optional<std::int64_t> count_above_1_worst = {};
    Shown<std::optional<double>> mean_abs_En_audited = {}, max_abs_En_audited = {};
    std::optional<std::int64_t> count_above_1_audited = {};
    Shown<std::optional<double>> published_mean_abs_En = {};  ///< of a publication that the job names
    /// Word of gum::AgreementVerdict, e.g. "validated"; "falls_with_finding" where what is stated would stand, but not
    /// what it is with the findings on the uncertainties corrected; "" where not judged.
    std::string verdict = {};
    std::string verdict_by = {};       ///< of "disagreement": "size", "pattern" or "bias"
    std::string verdict_audited = {};  ///< with the findings corrected; "" where there is none
    std::optional<BiasLineSummary> bias = {};
};

/// Who issues a comparison report, and under which number and date; "" where the job does not say it.
struct ComparisonIssuer {
    certificate::LocalisedText laboratory;
    std::string number;
    std::string issued;  ///< "2026-11-21"
    /// Of a report that amends or replaces another one (ISO/IEC 17025:2017, 7.8.8).
    std::optional<certificate::Amendment> amendment = {};
    /// As of certificates, certificate::Certificate::superseded_by: in no record.
    std::string superseded_by = {};
};

/// The file that is the budget of a laboratory. Its name tells whose it is, so documents that must not name laboratories
/// print the code in its place.
struct BudgetFile {
    std::string participant;  ///< code of the laboratory
    std::string file;         ///< as the job names it
};

/// A side of a comparison of methods, or the measurement that is compared, whose own evaluation refutes what it states.
struct RefutedSide {
    std::string side, file;  ///< name, and the job of it; "" for the job of the record itself
    std::string id;          ///< of the finding, "G01"; "" where it is none
    std::string message;     ///< code of the message where it is no finding
    std::string what;
};

struct Comparison {
    std::string reference_name;
    std::vector<double> contact_point_mm;
    std::vector<BudgetRow> reference_budget;  ///< of one reference value
    std::vector<ComparisonPoint> points;
    std::vector<ComparisonSummary> summary;  ///< one a direction, then "all"
    std::vector<std::string> remarks;        ///< what the numbers can and cannot tell

    std::string form = "rotary_table";  ///< "rotary_table", "methods" or "laboratories"
    std::string method_name = {};       ///< of the laboratory's side in a comparison of methods
    std::string unit = "um";            ///< of a comparison of methods
    std::string position_name = {}, position_unit = {};
    std::string organiser = {};
    std::string artefact_stability = {};        ///< as stated; "" where nothing is
    std::vector<BudgetRow> method_budget = {};  ///< of one value of the laboratory's side, from its budget or sources
    std::string correlation = {};               ///< of the two methods: "none", "given", "unknown", "shared_sources"
    std::optional<double> correlation_given = {};
    std::vector<SharedSource> shared_sources = {};
    std::string audit_finding = {};  ///< what En_audited corrects; findings of both sides one after the other
    std::string published_source = {};
    Shown<std::optional<double>> tolerance = {};

    std::vector<ComparisonItemEvaluation> items = {};  ///< form "laboratories"
    std::vector<ItemWithoutResult> items_without_result = {};
    std::vector<std::string> languages = {};  ///< that the job asks for, the binding one first
    bool names_released = false;              ///< documents may show names beside the codes of the laboratories
    std::vector<BudgetFile> budget_files = {};
    double score_probability = 0.9545;  ///< coverage probability of the U that E_n takes
    std::vector<ParticipantSummary> participants = {};
    std::vector<VectorScore> vectors = {};
    std::vector<YoudenDiagram> youden = {};
    /// What refutes a side: agreement is not said while one of these holds.
    std::vector<RefutedSide> refuted = {};
    std::optional<ComparisonIssuer> issuer = {};  ///< none where the job has no certificate data
};

struct Software {
    std::string name = "gumcert";
    std::string version, commit;
};

struct InputFile {
    std::string name;    ///< as the job names it
    std::string sha256;  ///< hexadecimal, lower case
    /// The bytes as text in UTF-8, or in Base64 as `encoding` says; none where the record does not hold them, because
    /// they are too many, or because it was written by an earlier release.
    std::optional<std::string> content = {};
    std::string encoding = "none";  ///< "utf-8", "base64", "none"
};

/// Bytes of a file of a job as a record holds them: as text where they are UTF-8 without NUL, else in Base64.
[[nodiscard]] InputFile input_file(const std::string& name, const std::string& bytes, bool with_content);
/// The bytes that a record holds of a file; none without, or where its Base64 is none.
[[nodiscard]] std::optional<std::string> bytes_of(const InputFile& file);

/// Everything that a document prints and a third party needs to recompute it (contract, section 6).
///
/// Documents are made from a record and from nothing else. Numbers are held unrounded beside the text that is printed,
/// so that every form of a document shows the same digits.
struct EvaluationRecord {
    static constexpr const char* k_schema = "gumcert/record/1";

    Software software;
    std::string kind;                                   ///< "budget", "rotary_table", "circle_closure" or "comparison"
    std::string title;                                  ///< English where it is stated in several languages
    certificate::LocalisedText title_by_language = {};  ///< empty where `title` is for all languages
    Shown<double> coverage_probability = {0.9545};      ///< text "95.45 %"
    std::string job_json;                               ///< the job as read, canonical JSON text
    std::vector<InputFile> job_files;
    std::string options_json;                    ///< every tolerance and option in force, canonical JSON text
    std::vector<Result> results;                 ///< in the order of documents; an object keyed by name in JSON
    std::vector<InputQuantity> inputs;           ///< kind "budget", in the order of the job
    std::optional<ModelSummary> model;           ///< kind "budget"
    std::optional<ResultCovariance> covariance;  ///< kind "budget", two or more results
    std::optional<CoverageRegion> region;        ///< kind "budget", two or more outputs, one point
    std::vector<FitSummary> fits;
    std::vector<ReadingsSummary> readings;
    std::vector<VarianceAnalysis> variance_analyses;
    std::vector<OutlyingReading> outliers;
    std::vector<SectionSummary> sections;           ///< kind "budget", where the job has several parts
    std::optional<certificate::PointTable> points;  ///< kind "budget", where points have more than their results
    std::optional<RotaryTable> rotary;
    std::optional<CircleClosure> circle_closure;
    std::optional<Comparison> comparison;
    std::optional<certificate::Certificate> certificate;  ///< where the job states certificate data
    std::vector<gum::Diagnostic> diagnostics;
    /// What the audit of the job found, canonical JSON text of schema gumcert/audit/1; "" in records of earlier releases
    std::string audit_json;
    /// Every sentence that the program put into this record, each once, sorted by its text
    std::vector<IdentifiedSentence> statements;
    /// SHA-256 that the record stated of itself when it was read; "" for one that states none, or was not read.
    std::string digest;
};

/// Canonical JSON of a record: keys sorted by code point, shortest numbers that read back the same, LF, UTF-8, no NaN.
/// Its member `digest` is the SHA-256 of the same text without that member.
/// \throws gum::NoResultError if a number is not finite: it must never reach a document
/// Accuracy: numbers read back as the same double (docs/accuracy.md#rounding-and-printing).
/// Example: examples/api/records.cpp
[[nodiscard]] std::string to_canonical_json(const EvaluationRecord& record);

/// \param where  name of the text for messages
/// \throws gum::InputError  if the text is not a record of schema gumcert/record/1, with every problem found; and
///                          GC-RECORD-0021 if it states another digest than that of its own contents
/// Example: examples/api/records.cpp
[[nodiscard]] EvaluationRecord record_from_json(const std::string& text, const std::string& where);

/// A record as JSON with the digest that fits it, whatever digest it had, in canonical text: what a record becomes that
/// somebody edits and closes again. A digest says that a record is whole, not who made it.
[[nodiscard]] std::string with_digest(nlohmann::json record);

}  // namespace gumcert::reports
