#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>

#include "certificate/certificate_fields.h"
#include "reports/record/comparison_fields.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

using certificate::NumberRule;

// Each struct of the record is described once, by a function `describe(archive, value)`; the writer, the reader and the
// JSON Schema (reports/record/schema) walk that description. So they cannot disagree on a key. Those of a certificate are
// in certificate/certificate_fields.h, those of a comparison in reports/record/comparison_fields.h.

template <class Archive, certificate::Described<Printed> Struct>
void describe(Archive& a, Struct& r) {
    a("value", r.value);
    a("U", r.U);
    a("unit", r.unit);
}

template <class Archive, certificate::Described<BudgetRow> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a.text_added("value", r.value);
    a("unit", r.unit);
    a("u", r.u, NumberRule::not_negative);
    a.text_added("nu", r.nu, NumberRule::positive);
    a("type", r.type, {"A", "B"});
    a("distribution", r.distribution);
    a.text_added("sensitivity", r.sensitivity);
    a("contribution", r.contribution, NumberRule::not_negative);
    a("share", r.share, NumberRule::not_negative);
    a("source", r.source);
    a.added("components", r.components);
    a.added("role", r.role, {"", "fit", "fit_data", "fit_parameter", "scatter", "extremes"});
    a.stated("part", r.part, {"", "calibration", "interpolation", "drift", "readings", "resolution"});
    a.stated("standard", r.standard);
    a.stated("certificate", r.certificate);
    a.stated("since", r.since);
}

template <class Archive, certificate::Described<CorrelationRow> Struct>
void describe(Archive& a, Struct& r) {
    a("variance", r.variance);
    a.text("contribution", r.printed_contribution);
    a("share", r.share);
}

template <class Archive, certificate::Described<SecondOrder> Struct>
void describe(Archive& a, Struct& r) {
    a("first_order_u", r.first_order_u, NumberRule::not_negative);
    a("u", r.u, NumberRule::not_negative);
    a("shift", r.shift);
}

template <class Archive, certificate::Described<GufValidation> Struct>
void describe(Archive& a, Struct& r) {
    a("delta", r.delta, NumberRule::not_negative);
    a("d_low", r.d_low, NumberRule::not_negative);
    a("d_high", r.d_high, NumberRule::not_negative);
    a("validated", r.validated);
    a("precise_enough", r.precise_enough);
    a("interval", r.interval, {"symmetric", "shortest"});
    a("digits", r.digits, NumberRule::positive);
}

template <class Archive, certificate::Described<MonteCarloSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("trials", r.trials, NumberRule::positive);
    a("seed", r.seed);
    a("mean", r.mean);
    a("u", r.u, NumberRule::not_negative);
    a("symmetric", r.symmetric);
    a("shortest", r.shortest);
    a.group("numerical_error", [&](auto& b) {
        b("mean", r.numerical_error.mean, NumberRule::not_negative);
        b("u", r.numerical_error.u, NumberRule::not_negative);
        b("symmetric", r.numerical_error.symmetric, NumberRule::not_negative);
        b("shortest", r.numerical_error.shortest, NumberRule::not_negative);
    });
    a("adaptive", r.adaptive);
    a("stabilised", r.stabilised);
    a("validation", r.validation);
    a.group("histogram", [&](auto& b) {
        b("low", r.histogram_low);
        b("high", r.histogram_high);
        b("counts", r.histogram, NumberRule::not_negative);
    });
}

inline constexpr std::initializer_list<const char*> k_reasons = {
    "", "asked", "second_order", "vanishing", "no_derivative", "not_linear", "asymmetric", "contradicted"};

template <class Archive, certificate::Described<ReportedResult> Struct>
void describe(Archive& a, Struct& r) {
    a("method", r.method, {"law_of_propagation", "monte_carlo"});
    a("value", r.value);
    a("u", r.u, NumberRule::not_negative);
    a("interval", r.interval);
    a("coverage_probability", r.coverage_probability, NumberRule::probability);
    a("U", r.U, NumberRule::not_negative);
    a("k", r.k, NumberRule::positive);
    a("because", r.because, k_reasons);
    a("against", r.against, k_reasons);
    a.group("printed", [&](auto& b) {
        b("value", r.printed.value);
        b("U", r.printed.U);
        b("unit", r.printed.unit);
        b("u", r.printed_u);
        b("low", r.printed_low);
        b("high", r.printed_high);
    });
}

template <class Archive, certificate::Described<Result> Struct>
void describe(Archive& a, Struct& r) {
    a("description", r.description);
    a.added("description_by_language", r.description_by_language);
    a("value", r.value);
    a("unit", r.unit);
    a("u", r.u, NumberRule::not_negative);
    a("nu_eff", r.nu_eff, NumberRule::positive);
    a("k", r.k, NumberRule::positive);
    a.added("k_numerical_error", r.k_numerical_error, NumberRule::not_negative);
    a("coverage_probability", r.coverage_probability, NumberRule::probability);
    a("U", r.U, NumberRule::not_negative);
    a("distribution", r.distribution);
    a.added("coverage", r.coverage, {"student_t", "normal", "convolution", "monte_carlo", "none"});
    a.added("coverage_note", r.coverage_note);
    a("printed", r.printed);
    a.added("reported", r.reported);
    a("budget", r.budget);
    a.added("correlation", r.correlation);
    a.added("quantity", r.quantity);
    a.added("point", r.point);
    a.added("second_order", r.second_order);
    a.added("monte_carlo", r.monte_carlo);
}

template <class Archive, certificate::Described<SectionSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("title", r.title);
    a("equations", r.equations);
    a("unknowns", r.unknowns);
    a("points", r.points);
    a("quantities", r.quantities);
}

template <class Archive, certificate::Described<ModelSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("equations", r.equations);
    a("unknowns", r.unknowns);
}

template <class Archive, certificate::Described<ResultCovariance> Struct>
void describe(Archive& a, Struct& r) {
    a("names", r.names);
    a("units", r.units);
    a("matrix", r.matrix);
    a("correlation", r.correlation);
    a("file", r.file);
    a.added("method", r.method);
}

template <class Archive, certificate::Described<CoverageRegion::SmallestRegion> Struct>
void describe(Archive& a, Struct& r) {
    a("volume", r.volume, NumberRule::not_negative);
    a("probability", r.probability, NumberRule::probability);
    a("cells", r.cells, NumberRule::positive);
    a("cells_per_axis", r.cells_per_axis, NumberRule::positive);
}

template <class Archive, certificate::Described<CoverageRegion::Validation> Struct>
void describe(Archive& a, Struct& r) {
    a("delta", r.delta, NumberRule::not_negative);
    a("d_value", r.d_value, NumberRule::not_negative);
    a("d_u", r.d_u, NumberRule::not_negative);
    a("delta_eigenvalue", r.delta_eigenvalue, NumberRule::not_negative);
    a("d_eigenvalue", r.d_eigenvalue, NumberRule::not_negative);
    a("delta_k_p", r.delta_k_p, NumberRule::not_negative);
    a("d_k_p", r.d_k_p, NumberRule::not_negative);
    a("validated", r.validated);
}

template <class Archive, certificate::Described<CoverageRegion> Struct>
void describe(Archive& a, Struct& r) {
    a("coverage_probability", r.coverage_probability, NumberRule::probability);
    a("from", r.from, {"law of propagation", "Monte Carlo"});
    a("nu", r.degrees_of_freedom, NumberRule::positive);
    a.group("ellipsoid", [&](auto& b) {
        b("k_p", r.k_p.number, NumberRule::positive);
        b("printed_k_p", r.k_p.text);
        b.added("none_because", r.no_k_p_because, {"", "singular", "distribution"});
    });
    a.group("parallelepiped", [&](auto& b) {
        b("k_q", r.k_q.number, NumberRule::positive);
        b("printed_k_q", r.k_q.text);
    });
    a("smallest_region", r.smallest_region);
    a("validation", r.validation);
}

template <class Archive, certificate::Described<FitSummary::Parameter> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("unit", r.unit);
    a("value", r.value);
    a("u", r.u, NumberRule::not_negative);
    a.text("unit", r.printed_unit);
    a.added("scaled_u", r.scaled_u, NumberRule::not_negative);
}

template <class Archive, certificate::Described<FitSummary::Regressor> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("unit", r.unit);
    a("values", r.values.number);
    a("printed", r.values.text);
}

template <class Archive, certificate::Described<FitSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("equation", r.equation);
    a("method", r.method, {"ordinary", "weighted", "generalised", "errors in both variables"});
    a("parameters", r.parameters);
    a("covariance", r.covariance);
    a("correlation", r.correlation);
    a("degrees_of_freedom", r.degrees_of_freedom, NumberRule::not_negative);
    // The schema lists numbers and texts in orders of their own.
    a("sum_of_squares", r.sum_of_squares.number, NumberRule::not_negative);
    a("residual_standard_deviation", r.residual_standard_deviation, NumberRule::not_negative);
    a.text("sum_of_squares", r.sum_of_squares.text);
    a("r_squared", r.r_squared.number);
    a("condition_number", r.condition_number, NumberRule::not_negative);
    a("p_value", r.p_value, NumberRule::probability);
    a.text("r_squared", r.r_squared.text);
    a.added("consistency", r.consistency, {"", "consistent", "refuted", "overstated"});
    a("iterations", r.iterations, NumberRule::not_negative);
    a("covariance_scaled", r.covariance_scaled);
    a.group("data", [&](auto& b) {
        b("x_name", r.x_name);
        b("x_unit", r.x_unit);
        b("y_name", r.y_name);
        b("y_unit", r.y_unit);
        b("x", r.x.number);
        b("y", r.y.number);
        b("fitted", r.fitted);
        b("residual", r.residual.number);
        b.added("u_x", r.u_x.number, NumberRule::not_negative);
        b.added("u_y", r.u_y.number, NumberRule::not_negative);
        b.added("regressors", r.regressors);
    });
    a.text_added("x", r.x.text);
    a.text_added("y", r.y.text);
    a.text_added("u_x", r.u_x.text);
    a.text_added("u_y", r.u_y.text);
    a.text_added("residual", r.residual.text);
}

template <class Archive, certificate::Described<OutlyingReading> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a("component", r.component);
    a("point", r.point);
    a("unit", r.unit);
    a("of", r.of, {"observations", "group", "group_means"});
    a("group", r.group, NumberRule::not_negative);
    a("position", r.position, NumberRule::positive);
    a("n", r.n, NumberRule::positive);
    a("value", r.value);
    a("G", r.G, NumberRule::not_negative);
    a("p_value", r.p_value, NumberRule::probability);
}

template <class Archive, certificate::Described<ReadingsSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a("component", r.component);
    a("unit", r.unit);
    a.added("point", r.point);
    a.added("observations", r.observations);
    a("n", r.n, NumberRule::positive);
    a("mean", r.mean);
    a("standard_deviation", r.standard_deviation, NumberRule::not_negative);
    a("standard_deviation_of_mean", r.standard_deviation_of_mean, NumberRule::not_negative);
    a("pooled_standard_deviation", r.pooled_standard_deviation, NumberRule::not_negative);
    a.added("pooled_degrees_of_freedom", r.pooled_degrees_of_freedom, NumberRule::positive);
    a.added("pooled_F", r.pooled_F, NumberRule::not_negative);
    a("autocorrelation", r.autocorrelation);
    a.text("r1", r.printed_r1);
    a.shown("autocorrelation_limit", "limit", r.autocorrelation_limit, NumberRule::not_negative);
    a("dependent", r.dependent);
}

template <class Archive, certificate::Described<VarianceAnalysis> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a("component", r.component);
    a("unit", r.unit);
    a.added("point", r.point);
    a("groups", r.groups, NumberRule::positive);
    a("readings", r.readings, NumberRule::positive);
    a("mean", r.mean);
    a("sum_of_squares_between", r.sum_of_squares_between, NumberRule::not_negative);
    a("sum_of_squares_within", r.sum_of_squares_within, NumberRule::not_negative);
    a("degrees_of_freedom_between", r.degrees_of_freedom_between, NumberRule::positive);
    a("degrees_of_freedom_within", r.degrees_of_freedom_within, NumberRule::positive);
    a("mean_square_between", r.mean_square_between, NumberRule::not_negative);
    a("mean_square_within", r.mean_square_within, NumberRule::not_negative);
    // The schema lists numbers and texts in orders of their own.
    a("F", r.F, NumberRule::not_negative);
    a("p_value", r.p_value.number, NumberRule::probability);
    a("F_critical", r.F_critical, NumberRule::not_negative);
    a.text("p_value", r.p_value.text);
    a("r_squared", r.r_squared);
    a.shown("standard_deviation_within", "within", r.standard_deviation_within, NumberRule::not_negative);
    a("standard_deviation_of_group_means", r.standard_deviation_of_group_means.number, NumberRule::not_negative);
    a.shown("standard_deviation_between", "between", r.standard_deviation_between, NumberRule::not_negative);
    a.text("group_means", r.standard_deviation_of_group_means.text);
    a.text("mean_square", r.printed_mean_square);
    a("u_with_between_effect", r.u_with_between_effect, NumberRule::not_negative);
    a("u_without_between_effect", r.u_without_between_effect, NumberRule::not_negative);
    a("conclusion", r.conclusion, {"significant", "not significant"});
}

/// The keys of a stated value that have been in a record from the beginning.
template <class Archive, certificate::Described<StatedValue> Struct>
void describe_law(Archive& a, Struct& r) {
    a("value", r.value);
    a("u", r.u, NumberRule::not_negative);
    a("U", r.U, NumberRule::not_negative);
    a("k", r.k, NumberRule::positive);
    a("nu_eff", r.nu_eff, NumberRule::positive);
    a("printed", r.printed);
}

template <class Archive, certificate::Described<StatedValue> Struct>
void describe(Archive& a, Struct& r) {
    describe_law(a, r);
    a.added("monte_carlo", r.monte_carlo);
    a.added("reported", r.reported);
}

template <class Archive, certificate::Described<SetUp> Struct>
void describe(Archive& a, Struct& r) {
    a("O_um", r.O_um);
    a("S_arcsec", r.S_arcsec);
    a("u_O_um", r.u_O_um, NumberRule::not_negative);
    a("u_S_arcsec", r.u_S_arcsec, NumberRule::not_negative);
    a("U_O_um", r.U_O_um, NumberRule::not_negative);
    a("U_S_arcsec", r.U_S_arcsec, NumberRule::not_negative);
    a("k", r.k, NumberRule::positive);
    a.group("printed", [&](auto& b) {
        b("O", r.printed_O);
        b("S", r.printed_S);
    });
}

template <class Archive, certificate::Described<Reversal> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    describe(a, r.stated);
}

template <class Archive, certificate::Described<Station> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("position_mm", r.position_mm);
    a("u_mm", r.u_mm, NumberRule::not_negative);
    a("scale_deviation", r.scale_deviation);
    a("u_scale", r.u_scale, NumberRule::not_negative);
    a.group("printed", [&](auto& b) {
        b("position", r.printed_position);
        b("U", r.printed_U);
        b("scale", r.printed_scale);
    });
    a.added("covariance_mm2", r.covariance_mm2);
}

template <class Archive, certificate::Described<DeadPath> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value_mm", r.value_mm);
    a("u_mm", r.u_mm, NumberRule::not_negative);
    a("printed", r.printed);
}

template <class Archive, certificate::Described<Reflector> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("position_mm", r.position_mm);
    a("u_mm", r.u_mm, NumberRule::not_negative);
    a("correction_um", r.correction_um);
    a.group("printed", [&](auto& b) {
        b("position", r.printed_position);
        b("U", r.printed_U);
        b("correction", r.printed_correction);
        b.added("cmm", r.printed_cmm);
        b.added("U_cmm", r.printed_U_cmm);
    });
    a.added("home_position_mm", r.home_position_mm);
    a.added("covariance_mm2", r.covariance_mm2);
    a.added("cmm_mm", r.cmm_mm);
    a.added("u_cmm_mm", r.u_cmm_mm, NumberRule::not_negative);
}

template <class Archive, certificate::Described<BudgetSummaryRow> Struct>
void describe(Archive& a, Struct& r) {
    a("quantity", r.quantity);
    a("rms_u", r.rms_u, NumberRule::not_negative);
    a("unit", r.unit);
    a("shares", r.shares, NumberRule::any);
}

template <class Archive, certificate::Described<GlobalTest> Struct>
void describe(Archive& a, Struct& r) {
    a("probability", r.probability, NumberRule::probability);
    a("lower", r.lower, NumberRule::not_negative);
    a("upper", r.upper, NumberRule::not_negative);
    a("accepted", r.accepted);
    a("meaning", r.meaning);
}

template <class Archive, certificate::Described<AdjustmentSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("method", r.method, {"joint", "sequential"});
    a("observations", r.observations);
    a("parameters", r.parameters);
    a("degrees_of_freedom", r.degrees_of_freedom);
    a("iterations", r.iterations);
    a("chi_square", r.chi_square, NumberRule::not_negative);
    a("p_value", r.p_value, NumberRule::probability);
    a.text("variance_factor", r.variance_factor.a_posteriori.text);
    a("condition_number", r.condition_number, NumberRule::not_negative);
    a.group("variance_factor", [&](auto& b) {
        b("a_priori", r.variance_factor.a_priori, NumberRule::not_negative);
        b("a_posteriori", r.variance_factor.a_posteriori.number, NumberRule::not_negative);
        b("used", r.variance_factor.used, {"a_priori", "a_posteriori"});
        b.added("reason", r.variance_factor.reason);
    });
    a.added("global_test", r.global_test);
}

template <class Archive, certificate::Described<VarianceComponent> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value", r.value, NumberRule::not_negative);
    a("u", r.u, NumberRule::not_negative);
    a("unit", r.unit);
    a("redundancy", r.redundancy);
    a("estimated", r.estimated);
    a("printed", r.printed);
    a.added("stated", r.stated.number, NumberRule::not_negative);
    a.added("degrees_of_freedom", r.degrees_of_freedom, NumberRule::not_negative);
    a.added("used", r.used);
    a.added("printed_stated", r.stated.text);
    a.added("residuals_give", r.residuals_give, NumberRule::not_negative);
}

template <class Archive, certificate::Described<ReliabilityRow> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a("reflector", r.reflector);
    a("pass", r.pass);
    a("angle_deg", r.angle_deg);
    a("residual_um", r.residual_um);
    a("redundancy_number", r.redundancy_number);
    a("test_value", r.test_value);
    a("minimal_detectable_bias_um", r.minimal_detectable_bias_um);
    a("flagged", r.flagged);
    a("removed", r.removed);
    a.added("printed_length", r.printed_length);
}

template <class Archive, certificate::Described<FlaggedDistance> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a("reflector", r.reflector);
    a("pass", r.pass);
    a("angle", r.angle);
    a("residual_um", r.residual_um);
    a("test_value", r.test_value);
    a("removed", r.removed);
    a.added("estimated_error_um", r.estimated_error_um);
    a.added("found_with", r.found_with);
    a.added("reason", r.reason);
}

template <class Archive, certificate::Described<FixtureReliabilityRow> Struct>
void describe(Archive& a, Struct& r) {
    a("reflector", r.reflector);
    a("coordinate", r.coordinate, {"x", "y", "z"});
    a("residual_um", r.residual_um);
    a("redundancy_number", r.redundancy_number);
    a("test_value", r.test_value);
    a("minimal_detectable_bias_um", r.minimal_detectable_bias_um);
}

template <class Archive, certificate::Described<ExternalReliability> Struct>
void describe(Archive& a, Struct& r) {
    a("quantity", r.quantity);
    a("angle_deg", r.angle_deg);
    a("influence", r.influence);
    a("unit", r.unit);
    a("ratio_to_U", r.ratio_to_U);
    a("station", r.station);
    a("reflector", r.reflector);
    a("pass", r.pass);
    a("at_angle_deg", r.at_angle_deg);
    a("minimal_detectable_bias_um", r.minimal_detectable_bias_um);
}

template <class Archive, certificate::Described<TableParameter> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("description", r.description);
    a("unit", r.unit, {"um", "arcsec"});
    describe_law(a, r.stated);
    a("monte_carlo", r.stated.monte_carlo);
    a.added("reported", r.stated.reported);
}

template <class Archive, certificate::Described<PositioningTarget> Struct>
void describe(Archive& a, Struct& r) {
    a("angle_deg", r.angle_deg.number);
    a("mean_up", r.mean_up.number);
    a("mean_down", r.mean_down.number);
    a("s_up", r.s_up.number, NumberRule::not_negative);
    a("s_down", r.s_down.number, NumberRule::not_negative);
    a("reversal", r.reversal.number);
    a.group("printed", [&](auto& b) {  // the schema lists it before the runs
        b("angle", r.angle_deg.text);
        b("mean_up", r.mean_up.text);
        b("mean_down", r.mean_down.text);
        b("s_up", r.s_up.text);
        b("s_down", r.s_down.text);
        b("reversal", r.reversal.text);
    });
    a.added("runs_up", r.runs_up);
    a.added("runs_down", r.runs_down);
}

template <class Archive, certificate::Described<PositioningAccuracy> Struct>
void describe(Archive& a, Struct& r) {
    std::string unit = "arcsec";
    a("unit", unit, {"arcsec"});
    a("runs_up", r.runs_up, NumberRule::not_negative);
    a("runs_down", r.runs_down, NumberRule::not_negative);
    a("parameters", r.parameters);
    a.by_name(r.parameters);
    a("targets", r.targets);
    a("u_deviation", r.u_deviation, NumberRule::not_negative);
    a("remarks", r.remarks);
}

template <class Archive, certificate::Described<RotaryMonteCarlo> Struct>
void describe(Archive& a, Struct& r) {
    a("trials", r.trials, NumberRule::positive);
    a("seed", r.seed);
    a("most_steps", r.most_steps, NumberRule::not_negative);
    a("mean_steps", r.mean_steps, NumberRule::not_negative);
    a("compared", r.compared, NumberRule::not_negative);
    a("validated", r.validated, NumberRule::not_negative);
    a("not_validated", r.not_validated);
    a("statement", r.statement);
}

template <class Archive, certificate::Described<FixtureBudget> Struct>
void describe(Archive& a, Struct& r) {
    a("method", r.method, {"stated", "budget", "source_paper"});
    a("file", r.file);
    a("largest", r.largest);
    a("largest_coordinate", r.largest_coordinate);
    a("remarks", r.remarks);
}

template <class Archive, certificate::Described<RangeRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value", r.stated.value, NumberRule::not_negative);
    a("U", r.stated.U, NumberRule::not_negative);
    a("printed", r.stated.printed);
    a.added("u", r.stated.u, NumberRule::not_negative);
    std::optional<double> k;  // records of earlier releases hold none
    if constexpr (std::is_const_v<Struct>) {
        k = r.stated.k;
    }
    a.added("k", k, NumberRule::positive);
    if constexpr (!std::is_const_v<Struct>) {
        r.stated.k = k ? *k : r.stated.u > 0.0 && r.stated.U > 0.0 ? r.stated.U / r.stated.u : r.stated.k;
    }
    a.added("nu_eff", r.stated.nu_eff, NumberRule::positive);
    a.added("monte_carlo", r.stated.monte_carlo);
    a.added("reported", r.stated.reported);
}

template <class Archive, certificate::Described<GroupTestRow> Struct>
void describe(Archive& a, Struct& r) {
    a("kind", r.kind);
    a("tests", r.tests, NumberRule::positive);
    a("test_value", r.test_value, NumberRule::not_negative);
    a("degrees_of_freedom", r.degrees_of_freedom, NumberRule::positive);
    a("critical_value", r.critical_value, NumberRule::not_negative);
    a("p_value", r.p_value, NumberRule::probability);
    a("station", r.station);
    a("reflector", r.reflector);
    a("pass", r.pass);
    a.shown("angle_deg", "angle", r.angle_deg);
    a.stated("to_angle_deg", r.to_angle_deg);
    a("estimate", r.estimate);
    a("unit", r.unit, {"um", "ppm", "1"});
    a("minimal_detectable", r.minimal_detectable, NumberRule::not_negative);
    a("suspicious", r.suspicious);
}

template <class Archive, certificate::Described<GroupTestSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("alpha", r.alpha, NumberRule::probability);
    a("scale", r.scale, NumberRule::not_negative);
    a("kinds", r.kinds);
    a.stated("unexplained_p_value", r.unexplained_p_value);
}

template <class Archive, certificate::Described<ReversalTestRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("test_value", r.test_value, NumberRule::not_negative);
    a("degrees_of_freedom", r.degrees_of_freedom, NumberRule::positive);
    a("residual_degrees_of_freedom", r.residual_degrees_of_freedom, NumberRule::positive);
    a("p_value", r.p_value, NumberRule::probability);
    a("spread", r.spread, NumberRule::not_negative);
    a("unit", r.unit, {"um", "arcsec"});
    a("depends_on_angle", r.depends_on_angle);
}

template <class Archive, certificate::Described<ReversalModel> Struct>
void describe(Archive& a, Struct& r) {
    a("model", r.model, {"constant", "by_angle"});
    a("alpha", r.alpha, NumberRule::probability);
    a("tests", r.tests);
}

template <class Archive, certificate::Described<VisitRow> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a("pass", r.pass);
    a("direction", r.direction, {"+", "-"});
    a("angle_deg", r.angle_deg);
    a("deviation_um", r.deviation_um);
    a("limit_um", r.limit_um, NumberRule::not_negative);
    a("axial_arcsec", r.axial_arcsec);
}

template <class Archive, certificate::Described<SensePoint> Struct>
void describe(Archive& a, Struct& r) {
    a("angle_deg", r.angle_deg);
    a("value", r.value);
    a("u", r.u);
    a("U", r.U);
}

template <class Archive, certificate::Described<SenseCurve> Struct>
void describe(Archive& a, Struct& r) {
    a("direction", r.direction, {"+", "-"});
    a("points", r.points);
}

template <class Archive, certificate::Described<HarmonicOrder> Struct>
void describe(Archive& a, Struct& r) {
    a("order", r.order, NumberRule::positive);
    a("amplitude", r.amplitude, NumberRule::not_negative);
    a("u", r.u, NumberRule::not_negative);
    a("U", r.U, NumberRule::not_negative);
    a.shown("phase_deg", "phase", r.phase_deg);
}

template <class Archive, certificate::Described<HarmonicRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("unit", r.unit, {"um", "arcsec"});
    a("orders", r.orders);
    a.shown("rms_rest", "rest", r.rms_rest, NumberRule::not_negative);
}

template <class Archive, certificate::Described<ExcludedDistances> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a("reflector", r.reflector);
    a("pass", r.pass);
    a("direction", r.direction, {"", "+", "-"});
    a("angle", r.angle);
    a("lines", r.lines);
    a("count", r.count, NumberRule::not_negative);
    a("reason", r.reason);
}

template <class Archive, certificate::Described<StationEnvironment> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a.shown("fixture_degC", "fixture", r.fixture_degC);
    a.shown("u_fixture_K", "u_fixture", r.u_fixture_K, NumberRule::not_negative);
    a.shown("air_degC", "air", r.air_degC);
    a.shown("pressure_hPa", "pressure", r.pressure_hPa);
    a.shown("humidity_percent", "humidity", r.humidity_percent);
    a.shown("expansion_um", "expansion", r.expansion_um);
}

template <class Archive, certificate::Described<Environment> Struct>
void describe(Archive& a, Struct& r) {
    a.shown("reference_degC", "reference", r.reference_degC);
    a.shown("expansion_per_K", "expansion", r.expansion_per_K);
    a.shown("u_expansion_per_K", "u_expansion", r.u_expansion_per_K, NumberRule::not_negative);
    a.shown("largest_distance_mm", "largest_distance", r.largest_distance_mm, NumberRule::not_negative);
    a("largest_share", r.largest_share);
    a("stations", r.stations);
    a.text("lowest", r.printed_lowest);
    a.text("highest", r.printed_highest);
    a.text("least_expansion", r.printed_least_expansion);
    a.text("most_expansion", r.printed_most_expansion);
}

template <class Archive, certificate::Described<InputFile> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("sha256", r.sha256);
    a.added("content", r.content);
    a.added("encoding", r.encoding, {"utf-8", "base64", "none"});
}

template <class Archive, certificate::Described<Software> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("version", r.version);
    a("commit", r.commit);
}

template <class Archive, certificate::Described<gum::Diagnostic> Struct>
void describe(Archive& a, Struct& r) {
    a("code", r.code);
    a("where", r.where);
    a("what", r.what);
    a("rule", r.rule);
    a("action", r.action);
    a.severity("severity", r.severity);
}

template <class Archive, certificate::Described<IdentifiedSentence::Argument> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value", r.value);
}

template <class Archive, certificate::Described<IdentifiedSentence> Struct>
void describe(Archive& a, Struct& r) {
    a("id", r.id);
    a("arguments", r.arguments);
    a("text", r.text);
}

template <class Archive, certificate::Described<InputQuantity> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("description", r.description);
    a("unit", r.unit);
}

template <class Archive, certificate::Described<MachinePoint> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("residual_um", r.residual_um);
    a("u_um", r.u_um, NumberRule::positive);
}

template <class Archive, certificate::Described<MachineFrame> Struct>
void describe(Archive& a, Struct& r) {
    a("by", r.by, {"probing", "stations"});
    a("source", r.source);
    a("nominal_point_mm", r.nominal_point_mm);
    a("points", r.points);
    a("chi_square", r.chi_square, NumberRule::not_negative);
    a("degrees_of_freedom", r.degrees_of_freedom, NumberRule::not_negative);
    a.shown("p_value", "p", r.p_value, NumberRule::probability);
    a.text("residual", r.printed_residual);
}

template <class Archive, certificate::Described<RotaryTable> Struct>
void describe(Archive& a, Struct& r) {
    a("axis", r.axis, {"A", "B", "C"});
    a("datum", r.datum, {"axis_average_line", "home"});
    a("method", r.method, {"joint", "sequential"});
    a("home_angle_deg", r.home_angle_deg);
    a("error_names", r.error_names);
    a("error_units", r.error_units);
    a("set_up", r.set_up);
    a("axis_in_fixture", r.axis_in_fixture);
    a.errors("errors", r.errors, r);
    a("reversal", r.reversal);
    a("ranges", r.ranges);
    a.group("covariance", [&](auto& b) {
        b("file", r.covariance_file);
        b("order", r.covariance_order);
        b("unit", r.covariance_unit);
    });
    a("stations", r.stations);
    a("dead_paths", r.dead_paths);
    a("reflectors", r.reflectors);
    a("budget_sources", r.budget_sources);
    a.quantity_budgets("budget", r.budget, r.budget_sources);
    a("budget_summary", r.budget_summary);
    a("adjustment", r.adjustment);
    a("variance_components", r.variance_components);
    a("reliability", r.reliability);
    a("flagged", r.flagged);
    a.group("outlier_test", [&](auto& b) {
        b("critical_value", r.outlier_critical_value.number, NumberRule::not_negative);
        b("alpha", r.outlier_alpha, NumberRule::probability);
        b("printed_critical_value", r.outlier_critical_value.text);
    });
    a.added("fixture_reliability", r.fixture_reliability);
    a.added("external_reliability", r.external_reliability);
    a.added("axis_line", r.axis_line);
    a.added("location_errors", r.location_errors);
    a.added("machine_frame", r.machine_frame);
    a.added("iso230_2", r.iso230_2);
    a.added("monte_carlo", r.monte_carlo);
    a.added("fixture_budget", r.fixture_budget);
    a.added("group_tests", r.group_tests);
    a.added("reversal_model", r.reversal_model);
    a.added("visits", r.visits);
    a.added("sense_curves", r.sense_curves);
    a.added("harmonics", r.harmonics);
    a.added("environment", r.environment);
    a.added("exclusions", r.exclusions);
}

template <class Archive, certificate::Described<ClosureSeriesRow> Struct>
void describe(Archive& a, Struct& r) {
    a("position", r.position, NumberRule::not_negative);
    a("repetition", r.repetition);
    a("readings", r.readings, NumberRule::positive);
    a("zero", r.zero);
    a("drift", r.drift);
    a("residual_rms", r.residual_rms, NumberRule::not_negative);
    a("misclosure", r.misclosure);
}

template <class Archive, certificate::Described<ClosureResidualRow> Struct>
void describe(Archive& a, Struct& r) {
    a("position", r.position, NumberRule::not_negative);
    a("step", r.step, NumberRule::not_negative);
    a("side", r.side, NumberRule::not_negative);
    a("repetition", r.repetition);
    a("reading", r.reading);
    a("residual", r.residual);
    a("redundancy", r.redundancy, NumberRule::probability);
}

template <class Archive, certificate::Described<ClosureTestRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name, {"stated", "repetition", "reading", "misclosure"});
    a("statistic", r.statistic, NumberRule::not_negative);
    a("nu", r.nu, NumberRule::positive);
    a("nu_reference", r.nu_reference, NumberRule::positive);
    a("p_value", r.p_value, NumberRule::probability);
    a("accepted", r.accepted);
}

template <class Archive, certificate::Described<CircleClosure> Struct>
void describe(Archive& a, Struct& r) {
    a("table", r.table);
    a("artefact", r.artefact);
    a("artefact_description", r.artefact_description);
    a("unit", r.unit);
    a("numbering", r.numbering, {"with", "against"});
    a("sense", r.sense, {"positive", "negative"});
    a("drift", r.drift, {"none", "linear"});
    a("steps", r.steps, NumberRule::positive);
    a("positions", r.positions, NumberRule::positive);
    a("step_angles_deg", r.step_angles_deg);
    a("side_angles_deg", r.side_angles_deg);
    a("full", r.full);
    a("readings", r.readings, NumberRule::positive);
    a("unknowns", r.unknowns, NumberRule::positive);
    a("degrees_of_freedom", r.degrees_of_freedom, NumberRule::not_negative);
    a("residual_standard_deviation", r.residual_standard_deviation, NumberRule::not_negative);
    a("u_reading", r.u_reading, NumberRule::not_negative);
    a("nu_reading", r.nu_reading, NumberRule::positive);
    a("u_reading_from", r.u_reading_from, {"residuals", "stated"});
    a("condition_number", r.condition_number, NumberRule::positive);
    a("tests", r.tests);
    a("series", r.series);
    a("residuals", r.residuals);
    a.text("unit", r.printed_unit);
}

template <class Archive, certificate::Described<EvaluationRecord> Struct>
void describe(Archive& a, Struct& r) {
    a.constant("schema", EvaluationRecord::k_schema);
    a("kind", r.kind);  // the caller says which words it may be
    a("title", r.title);
    a.stated("title_by_language", r.title_by_language);
    a("software", r.software);
    a("coverage_probability", r.coverage_probability.number, NumberRule::probability);
    a.group("printed", [&](auto& b) { b("coverage_probability", r.coverage_probability.text); });
    a.group("job", [&](auto& b) {
        b.document("document", r.job_json);
        b("files", r.job_files);
    });
    a.document("options", r.options_json);
    a.results("results", r.results);
    a.added("inputs", r.inputs);
    a.added("model", r.model);
    a.added("covariance", r.covariance);
    a.added("region", r.region);
    a.added("fits", r.fits);
    a.added("readings", r.readings);
    a.added("variance_analyses", r.variance_analyses);
    a.added("outliers", r.outliers);
    a.stated("sections", r.sections);
    a.stated("points", r.points);
    a("rotary", r.rotary);
    a.added("circle_closure", r.circle_closure);
    a("comparison", r.comparison);
    a.added("certificate", r.certificate);
    a("diagnostics", r.diagnostics);
    a.added("statements", r.statements);
    a.digest("digest", r.digest);
    a.object_or_null("audit", r.audit_json);
}

}  // namespace gumcert::reports
