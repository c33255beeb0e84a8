#include "reports/record/evaluation_record.h"

#include "certificate/certificate_fields.h"
#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "reports/record/canonical_json.h"
#include "reports/record/comparison_check.h"
#include "reports/record/comparison_fields.h"
#include "reports/record/reported_result.h"
#include "text/utf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace gumcert::reports {

namespace {

using nlohmann::json;

using Range = certificate::NumberRule;

const char* rule_of(Range range) {
    switch (range) {
        case Range::not_negative:
            return "must be 0 or greater";
        case Range::positive:
            return "must be greater than 0";
        case Range::probability:
            return "must lie between 0 and 1";
        case Range::at_least_one:
            return "must be 1 or greater";
        case Range::one_or_two:
            return "must be 1 or 2";
        case Range::any:
            break;
    }
    return "must be finite";
}

bool inside(double v, Range range) {
    switch (range) {
        case Range::not_negative:
            return v >= 0.0;
        case Range::positive:
            return v > 0.0;
        case Range::probability:
            return v >= 0.0 && v <= 1.0;
        case Range::at_least_one:
            return v >= 1.0;
        case Range::one_or_two:
            return v == 1.0 || v == 2.0;
        case Range::any:
            break;
    }
    return true;
}

std::string shortest(double v) {
    std::string text = std::isnan(v) ? "NaN" : std::isinf(v) ? "infinity" : canonical_json(json(v));
    if (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    return text;
}

template <class Type, class Whole>
concept Is = std::same_as<std::remove_const_t<Type>, Whole>;

// Each struct of the record is described once, by a function `describe(archive, value)`; the writer and the reader both
// walk that description. So the two cannot disagree on a key. Those of a certificate are in
// certificate/certificate_fields.h, those of a comparison in reports/record/comparison_fields.h.

template <class Archive, Is<Printed> Struct>
void describe(Archive& a, Struct& r) {
    a("value", r.value);
    a("U", r.U);
    a("unit", r.unit);
}

template <class Archive, Is<BudgetRow> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a("value", r.value);
    a("unit", r.unit);
    a("u", r.u, Range::not_negative);
    a("nu", r.nu, Range::positive);
    a("type", r.type, {"A", "B"});
    a("distribution", r.distribution);
    a("sensitivity", r.sensitivity);
    a("contribution", r.contribution, Range::not_negative);
    a("share", r.share, Range::not_negative);
    a("source", r.source);
    a.added("components", r.components);
    a.added("role", r.role, {"", "fit", "fit_data", "fit_parameter", "scatter"});
    a.group("printed", [&](auto& b) {
        b.added("value", r.printed.value);
        b("u", r.printed.u);
        b.added("nu", r.printed.nu);
        b.added("sensitivity", r.printed.sensitivity);
        b("contribution", r.printed.contribution);
        b("share", r.printed.share);
    });
}

template <class Archive, Is<CorrelationRow> Struct>
void describe(Archive& a, Struct& r) {
    a("variance", r.variance);
    a("share", r.share);
    a.group("printed", [&](auto& b) {
        b("contribution", r.printed.contribution);
        b("share", r.printed.share);
    });
}

template <class Archive, Is<SecondOrder> Struct>
void describe(Archive& a, Struct& r) {
    a("first_order_u", r.first_order_u, Range::not_negative);
    a("u", r.u, Range::not_negative);
    a("shift", r.shift);
    a.group("printed", [&](auto& b) {
        b("first_order_u", r.printed.first_order_u);
        b("u", r.printed.u);
        b("shift", r.printed.shift);
    });
}

template <class Archive, Is<GufValidation> Struct>
void describe(Archive& a, Struct& r) {
    a("delta", r.delta, Range::not_negative);
    a("d_low", r.d_low, Range::not_negative);
    a("d_high", r.d_high, Range::not_negative);
    a("validated", r.validated);
    a("precise_enough", r.precise_enough);
    a("interval", r.interval, {"symmetric", "shortest"});
    a("digits", r.digits, Range::positive);
    a.group("printed", [&](auto& b) {
        b("delta", r.printed.delta);
        b("d_low", r.printed.d_low);
        b("d_high", r.printed.d_high);
    });
}

template <class Archive, Is<MonteCarloSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("trials", r.trials, Range::positive);
    a("seed", r.seed);
    a("mean", r.mean);
    a("u", r.u, Range::not_negative);
    a("symmetric", r.symmetric);
    a("shortest", r.shortest);
    a.group("numerical_error", [&](auto& b) {
        b("mean", r.numerical_error.mean, Range::not_negative);
        b("u", r.numerical_error.u, Range::not_negative);
        b("symmetric", r.numerical_error.symmetric, Range::not_negative);
        b("shortest", r.numerical_error.shortest, Range::not_negative);
    });
    a("adaptive", r.adaptive);
    a("stabilised", r.stabilised);
    a("validation", r.validation);
    a.group("histogram", [&](auto& b) {
        b("low", r.histogram_low);
        b("high", r.histogram_high);
        b("counts", r.histogram, Range::not_negative);
    });
    a.group("printed", [&](auto& b) {
        b("trials", r.printed.trials);
        b("mean", r.printed.mean);
        b("u", r.printed.u);
        b("symmetric", r.printed.symmetric);
        b("shortest", r.printed.shortest);
    });
}

constexpr std::initializer_list<const char*> k_reasons = {
    "", "asked", "second_order", "vanishing", "no_derivative", "not_linear", "asymmetric", "contradicted"};

template <class Archive, Is<ReportedResult> Struct>
void describe(Archive& a, Struct& r) {
    a("method", r.method, {"law_of_propagation", "monte_carlo"});
    a("value", r.value);
    a("u", r.u, Range::not_negative);
    a("interval", r.interval);
    a("coverage_probability", r.coverage_probability, Range::probability);
    a("U", r.U, Range::not_negative);
    a("k", r.k, Range::positive);
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

template <class Archive, Is<Result> Struct>
void describe(Archive& a, Struct& r) {
    a("description", r.description);
    a.added("description_by_language", r.description_by_language);
    a("value", r.value);
    a("unit", r.unit);
    a("u", r.u, Range::not_negative);
    a("nu_eff", r.nu_eff, Range::positive);
    a("k", r.k, Range::positive);
    a.added("k_numerical_error", r.k_numerical_error, Range::not_negative);
    a("coverage_probability", r.coverage_probability, Range::probability);
    a("U", r.U, Range::not_negative);
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

template <class Archive, Is<ModelSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("equations", r.equations);
    a("unknowns", r.unknowns);
}

template <class Archive, Is<ResultCovariance> Struct>
void describe(Archive& a, Struct& r) {
    a("names", r.names);
    a("units", r.units);
    a("matrix", r.matrix);
    a("correlation", r.correlation);
    a("file", r.file);
    a.added("method", r.method);
    a.group("printed", [&](auto& b) { b("correlation", r.printed_correlation); });
}

template <class Archive, Is<CoverageRegion::SmallestRegion> Struct>
void describe(Archive& a, Struct& r) {
    a("volume", r.volume, Range::not_negative);
    a("probability", r.probability, Range::probability);
    a("cells", r.cells, Range::positive);
    a("cells_per_axis", r.cells_per_axis, Range::positive);
}

template <class Archive, Is<CoverageRegion::Validation> Struct>
void describe(Archive& a, Struct& r) {
    a("delta", r.delta, Range::not_negative);
    a("d_value", r.d_value, Range::not_negative);
    a("d_u", r.d_u, Range::not_negative);
    a("delta_eigenvalue", r.delta_eigenvalue, Range::not_negative);
    a("d_eigenvalue", r.d_eigenvalue, Range::not_negative);
    a("delta_k_p", r.delta_k_p, Range::not_negative);
    a("d_k_p", r.d_k_p, Range::not_negative);
    a("validated", r.validated);
}

template <class Archive, Is<CoverageRegion> Struct>
void describe(Archive& a, Struct& r) {
    a("coverage_probability", r.coverage_probability, Range::probability);
    a("from", r.from, {"law of propagation", "Monte Carlo"});
    a("nu", r.degrees_of_freedom, Range::positive);
    a.group("ellipsoid", [&](auto& b) {
        b("k_p", r.k_p, Range::positive);
        b("printed_k_p", r.printed.k_p);
    });
    a.group("parallelepiped", [&](auto& b) {
        b("k_q", r.k_q, Range::positive);
        b("printed_k_q", r.printed.k_q);
    });
    a("smallest_region", r.smallest_region);
    a("validation", r.validation);
}

template <class Archive, Is<FitSummary::Parameter> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("unit", r.unit);
    a("value", r.value);
    a("u", r.u, Range::not_negative);
    a.added("scaled_u", r.scaled_u, Range::not_negative);
    a.group("printed", [&](auto& b) {
        b("value", r.printed.value);
        b("u", r.printed.u);
        b("unit", r.printed.unit);
        b.added("scaled_u", r.printed.scaled_u);
    });
}

template <class Archive, Is<FitSummary::Regressor> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("unit", r.unit);
    a("values", r.values);
    a("printed", r.printed);
}

template <class Archive, Is<FitSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("equation", r.equation);
    a("method", r.method, {"ordinary", "weighted", "generalised", "errors in both variables"});
    a("parameters", r.parameters);
    a("covariance", r.covariance);
    a("correlation", r.correlation);
    a("degrees_of_freedom", r.degrees_of_freedom, Range::not_negative);
    a("sum_of_squares", r.sum_of_squares, Range::not_negative);
    a("residual_standard_deviation", r.residual_standard_deviation, Range::not_negative);
    a("r_squared", r.r_squared);
    a("condition_number", r.condition_number, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a.added("consistency", r.consistency, {"", "consistent", "refuted", "overstated"});
    a("iterations", r.iterations, Range::not_negative);
    a("covariance_scaled", r.covariance_scaled);
    a.group("data", [&](auto& b) {
        b("x_name", r.x_name);
        b("x_unit", r.x_unit);
        b("y_name", r.y_name);
        b("y_unit", r.y_unit);
        b("x", r.x);
        b("y", r.y);
        b("fitted", r.fitted);
        b("residual", r.residual);
        b.added("u_x", r.u_x);
        b.added("u_y", r.u_y);
        b.added("regressors", r.regressors);
    });
    a.group("printed", [&](auto& b) {
        b("residual_standard_deviation", r.printed.residual_standard_deviation);
        b("sum_of_squares", r.printed.sum_of_squares);
        b("p_value", r.printed.p_value);
        b("r_squared", r.printed.r_squared);
        b.added("x", r.printed.x);
        b.added("y", r.printed.y);
        b.added("u_x", r.printed.u_x);
        b.added("u_y", r.printed.u_y);
        b.added("residual", r.printed.residual);
    });
}

template <class Archive, Is<OutlyingReading> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a("component", r.component);
    a("point", r.point);
    a("unit", r.unit);
    a("of", r.of, {"observations", "group", "group_means"});
    a("group", r.group, Range::not_negative);
    a("position", r.position, Range::positive);
    a("n", r.n, Range::positive);
    a("value", r.value);
    a("G", r.G, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a.group("printed", [&](auto& b) {
        b("value", r.printed.value);
        b("G", r.printed.G);
        b("p_value", r.printed.p_value);
    });
}

template <class Archive, Is<ReadingsSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a("component", r.component);
    a("unit", r.unit);
    a.added("point", r.point);
    a.added("observations", r.observations);
    a("n", r.n, Range::positive);
    a("mean", r.mean);
    a("standard_deviation", r.standard_deviation, Range::not_negative);
    a("standard_deviation_of_mean", r.standard_deviation_of_mean, Range::not_negative);
    a("pooled_standard_deviation", r.pooled_standard_deviation, Range::not_negative);
    a.added("pooled_degrees_of_freedom", r.pooled_degrees_of_freedom, Range::positive);
    a.added("pooled_F", r.pooled_F, Range::not_negative);
    a("autocorrelation", r.autocorrelation);
    a("autocorrelation_limit", r.autocorrelation_limit, Range::not_negative);
    a("dependent", r.dependent);
    a.group("printed", [&](auto& b) {
        b("mean", r.printed.mean);
        b("standard_deviation", r.printed.standard_deviation);
        b("standard_deviation_of_mean", r.printed.standard_deviation_of_mean);
        b("r1", r.printed.r1);
        b("limit", r.printed.limit);
    });
}

template <class Archive, Is<VarianceAnalysis> Struct>
void describe(Archive& a, Struct& r) {
    a("input", r.input);
    a("component", r.component);
    a("unit", r.unit);
    a.added("point", r.point);
    a("groups", r.groups, Range::positive);
    a("readings", r.readings, Range::positive);
    a("mean", r.mean);
    a("sum_of_squares_between", r.sum_of_squares_between, Range::not_negative);
    a("sum_of_squares_within", r.sum_of_squares_within, Range::not_negative);
    a("degrees_of_freedom_between", r.degrees_of_freedom_between, Range::positive);
    a("degrees_of_freedom_within", r.degrees_of_freedom_within, Range::positive);
    a("mean_square_between", r.mean_square_between, Range::not_negative);
    a("mean_square_within", r.mean_square_within, Range::not_negative);
    a("F", r.F, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a("F_critical", r.F_critical, Range::not_negative);
    a("r_squared", r.r_squared);
    a("standard_deviation_within", r.standard_deviation_within, Range::not_negative);
    a("standard_deviation_of_group_means", r.standard_deviation_of_group_means, Range::not_negative);
    a("standard_deviation_between", r.standard_deviation_between, Range::not_negative);
    a("u_with_between_effect", r.u_with_between_effect, Range::not_negative);
    a("u_without_between_effect", r.u_without_between_effect, Range::not_negative);
    a("conclusion", r.conclusion, {"significant", "not significant"});
    a.group("printed", [&](auto& b) {
        b("mean", r.printed.mean);
        b("F", r.printed.F);
        b("F_critical", r.printed.F_critical);
        b("p_value", r.printed.p_value);
        b("within", r.printed.within);
        b("between", r.printed.between);
        b("group_means", r.printed.group_means);
        b("mean_square", r.printed.mean_square);
    });
}

template <class Archive, Is<ErrorValue> Struct>
void describe(Archive& a, Struct& r) {
    a("value", r.value);
    a("u", r.u, Range::not_negative);
    a("U", r.U, Range::not_negative);
    a("k", r.k, Range::positive);
    a("nu_eff", r.nu_eff, Range::positive);
    a("printed", r.printed);
    a.added("monte_carlo", r.monte_carlo);
    a.added("reported", r.reported);
}

template <class Archive, Is<SetUp> Struct>
void describe(Archive& a, Struct& r) {
    a("O_um", r.O_um);
    a("S_arcsec", r.S_arcsec);
    a("u_O_um", r.u_O_um, Range::not_negative);
    a("u_S_arcsec", r.u_S_arcsec, Range::not_negative);
    a("U_O_um", r.U_O_um, Range::not_negative);
    a("U_S_arcsec", r.U_S_arcsec, Range::not_negative);
    a("k", r.k, Range::positive);
    a.group("printed", [&](auto& b) {
        b("O", r.printed_O);
        b("S", r.printed_S);
    });
}

template <class Archive, Is<Reversal> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    describe(a, r.value);
}

template <class Archive, Is<Station> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("position_mm", r.position_mm);
    a("u_mm", r.u_mm, Range::not_negative);
    a("scale_deviation", r.scale_deviation);
    a("u_scale", r.u_scale, Range::not_negative);
    a.group("printed", [&](auto& b) {
        b("position", r.printed_position);
        b("U", r.printed_U);
        b("scale", r.printed_scale);
    });
    a.added("covariance_mm2", r.covariance_mm2);
}

template <class Archive, Is<DeadPath> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value_mm", r.value_mm);
    a("u_mm", r.u_mm, Range::not_negative);
    a("printed", r.printed);
}

template <class Archive, Is<Reflector> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("position_mm", r.position_mm);
    a("u_mm", r.u_mm, Range::not_negative);
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
    a.added("u_cmm_mm", r.u_cmm_mm, Range::not_negative);
}

template <class Archive, Is<BudgetSummaryRow> Struct>
void describe(Archive& a, Struct& r) {
    a("quantity", r.quantity);
    a("rms_u", r.rms_u, Range::not_negative);
    a("unit", r.unit);
    a("shares", r.shares, Range::any);
    a.group("printed", [&](auto& b) {
        b("rms_u", r.printed_rms_u);
        b("shares", r.printed_shares);
    });
}

template <class Archive, Is<GlobalTest> Struct>
void describe(Archive& a, Struct& r) {
    a("probability", r.probability, Range::probability);
    a("lower", r.lower, Range::not_negative);
    a("upper", r.upper, Range::not_negative);
    a("accepted", r.accepted);
    a("meaning", r.meaning);
    a.group("printed", [&](auto& b) {
        b("lower", r.printed_lower);
        b("upper", r.printed_upper);
    });
}

template <class Archive, Is<AdjustmentSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("method", r.method, {"joint", "sequential"});
    a("observations", r.observations);
    a("parameters", r.parameters);
    a("degrees_of_freedom", r.degrees_of_freedom);
    a("iterations", r.iterations);
    a("chi_square", r.chi_square, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a("condition_number", r.condition_number, Range::not_negative);
    a.group("variance_factor", [&](auto& b) {
        b("a_priori", r.variance_factor.a_priori, Range::not_negative);
        b("a_posteriori", r.variance_factor.a_posteriori, Range::not_negative);
        b("used", r.variance_factor.used, {"a_priori", "a_posteriori"});
        b.added("reason", r.variance_factor.reason);
    });
    a.added("global_test", r.global_test);
    a.group("printed", [&](auto& b) {
        b("chi_square", r.printed.chi_square);
        b("p_value", r.printed.p_value);
        b("variance_factor", r.printed.variance_factor);
        b("condition_number", r.printed.condition_number);
    });
}

template <class Archive, Is<VarianceComponent> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value", r.value, Range::not_negative);
    a("u", r.u, Range::not_negative);
    a("unit", r.unit);
    a("redundancy", r.redundancy);
    a("estimated", r.estimated);
    a("printed", r.printed);
    a.added("stated", r.stated, Range::not_negative);
    a.added("degrees_of_freedom", r.degrees_of_freedom, Range::not_negative);
    a.added("used", r.used);
    a.added("printed_stated", r.printed_stated);
}

template <class Archive, Is<ReliabilityRow> Struct>
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

template <class Archive, Is<FlaggedDistance> Struct>
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

template <class Archive, Is<FixtureReliabilityRow> Struct>
void describe(Archive& a, Struct& r) {
    a("reflector", r.reflector);
    a("coordinate", r.coordinate, {"x", "y", "z"});
    a("residual_um", r.residual_um);
    a("redundancy_number", r.redundancy_number);
    a("test_value", r.test_value);
    a("minimal_detectable_bias_um", r.minimal_detectable_bias_um);
}

template <class Archive, Is<ExternalReliability> Struct>
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

template <class Archive, Is<TableParameter> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("description", r.description);
    a("unit", r.unit, {"um", "arcsec"});
    a("value", r.value);
    a("u", r.u, Range::not_negative);
    a("U", r.U, Range::not_negative);
    a("k", r.k, Range::positive);
    a("nu_eff", r.nu_eff, Range::positive);
    a("printed", r.printed);
    a("monte_carlo", r.monte_carlo);
    a.added("reported", r.reported);
}

template <class Archive, Is<PositioningTarget> Struct>
void describe(Archive& a, Struct& r) {
    a("angle_deg", r.angle_deg);
    a("mean_up", r.mean_up);
    a("mean_down", r.mean_down);
    a("s_up", r.s_up, Range::not_negative);
    a("s_down", r.s_down, Range::not_negative);
    a("reversal", r.reversal);
    a.group("printed", [&](auto& b) {
        b("angle", r.printed_angle);
        b("mean_up", r.printed_mean_up);
        b("mean_down", r.printed_mean_down);
        b("s_up", r.printed_s_up);
        b("s_down", r.printed_s_down);
        b("reversal", r.printed_reversal);
    });
    a.added("runs_up", r.runs_up);
    a.added("runs_down", r.runs_down);
}

template <class Archive, Is<PositioningAccuracy> Struct>
void describe(Archive& a, Struct& r) {
    std::string unit = "arcsec";
    a("unit", unit, {"arcsec"});
    a("runs_up", r.runs_up, Range::not_negative);
    a("runs_down", r.runs_down, Range::not_negative);
    a("parameters", r.parameters);
    a.by_name(r.parameters);
    a("targets", r.targets);
    a("u_deviation", r.u_deviation, Range::not_negative);
    a("remarks", r.remarks);
    a.group("printed", [&](auto& b) { b("u_deviation", r.printed_u_deviation); });
}

template <class Archive, Is<RotaryMonteCarlo> Struct>
void describe(Archive& a, Struct& r) {
    a("trials", r.trials, Range::positive);
    a("seed", r.seed);
    a("most_steps", r.most_steps, Range::not_negative);
    a("mean_steps", r.mean_steps, Range::not_negative);
    a("compared", r.compared, Range::not_negative);
    a("validated", r.validated, Range::not_negative);
    a("not_validated", r.not_validated);
    a("statement", r.statement);
}

template <class Archive, Is<FixtureBudget> Struct>
void describe(Archive& a, Struct& r) {
    a("method", r.method, {"stated", "budget", "source_paper"});
    a("file", r.file);
    a("largest", r.largest);
    a("largest_coordinate", r.largest_coordinate);
    a("remarks", r.remarks);
}

template <class Archive, Is<RangeRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value", r.value, Range::not_negative);
    a("U", r.U, Range::not_negative);
    a("printed", r.printed);
    a.added("u", r.u, Range::not_negative);
    a.added("k", r.k, Range::positive);
    a.added("nu_eff", r.nu_eff, Range::positive);
    a.added("monte_carlo", r.monte_carlo);
    a.added("reported", r.reported);
}

template <class Archive, Is<GroupTestRow> Struct>
void describe(Archive& a, Struct& r) {
    a("kind", r.kind);
    a("tests", r.tests, Range::positive);
    a("test_value", r.test_value, Range::not_negative);
    a("degrees_of_freedom", r.degrees_of_freedom, Range::positive);
    a("critical_value", r.critical_value, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a("station", r.station);
    a("reflector", r.reflector);
    a("pass", r.pass);
    a("angle_deg", r.angle_deg);
    a("estimate", r.estimate);
    a("unit", r.unit, {"um", "ppm", "1"});
    a("minimal_detectable", r.minimal_detectable, Range::not_negative);
    a("suspicious", r.suspicious);
    a.group("printed", [&](auto& b) {
        b("test_value", r.printed.test_value);
        b("critical_value", r.printed.critical_value);
        b("p_value", r.printed.p_value);
        b("angle", r.printed.angle);
        b("estimate", r.printed.estimate);
        b("minimal_detectable", r.printed.minimal_detectable);
    });
}

template <class Archive, Is<GroupTestSummary> Struct>
void describe(Archive& a, Struct& r) {
    a("alpha", r.alpha, Range::probability);
    a("scale", r.scale, Range::not_negative);
    a("kinds", r.kinds);
    a.group("printed", [&](auto& b) { b("scale", r.printed_scale); });
}

template <class Archive, Is<ReversalTestRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("test_value", r.test_value, Range::not_negative);
    a("degrees_of_freedom", r.degrees_of_freedom, Range::positive);
    a("residual_degrees_of_freedom", r.residual_degrees_of_freedom, Range::positive);
    a("p_value", r.p_value, Range::probability);
    a("spread", r.spread, Range::not_negative);
    a("unit", r.unit, {"um", "arcsec"});
    a("depends_on_angle", r.depends_on_angle);
    a.group("printed", [&](auto& b) {
        b("test_value", r.printed.test_value);
        b("p_value", r.printed.p_value);
        b("spread", r.printed.spread);
    });
}

template <class Archive, Is<ReversalModel> Struct>
void describe(Archive& a, Struct& r) {
    a("model", r.model, {"constant", "by_angle"});
    a("alpha", r.alpha, Range::probability);
    a("tests", r.tests);
}

template <class Archive, Is<VisitRow> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a("pass", r.pass);
    a("direction", r.direction, {"+", "-"});
    a("angle_deg", r.angle_deg);
    a("deviation_um", r.deviation_um);
    a("limit_um", r.limit_um, Range::not_negative);
    a("axial_arcsec", r.axial_arcsec);
}

template <class Archive, Is<SensePoint> Struct>
void describe(Archive& a, Struct& r) {
    a("angle_deg", r.angle_deg);
    a("value", r.value);
    a("u", r.u);
    a("U", r.U);
}

template <class Archive, Is<SenseCurve> Struct>
void describe(Archive& a, Struct& r) {
    a("direction", r.direction, {"+", "-"});
    a("points", r.points);
}

template <class Archive, Is<HarmonicOrder> Struct>
void describe(Archive& a, Struct& r) {
    a("order", r.order, Range::positive);
    a("amplitude", r.amplitude, Range::not_negative);
    a("u", r.u, Range::not_negative);
    a("U", r.U, Range::not_negative);
    a("phase_deg", r.phase_deg);
    a.group("printed", [&](auto& b) {
        b("amplitude", r.printed.amplitude);
        b("U", r.printed.U);
        b("phase", r.printed.phase);
    });
}

template <class Archive, Is<HarmonicRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("unit", r.unit, {"um", "arcsec"});
    a("orders", r.orders);
    a("rms_rest", r.rms_rest, Range::not_negative);
    a.group("printed", [&](auto& b) { b("rest", r.printed_rest); });
}

template <class Archive, Is<ExcludedDistances> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a("reflector", r.reflector);
    a("pass", r.pass);
    a("direction", r.direction, {"", "+", "-"});
    a("angle", r.angle);
    a("lines", r.lines);
    a("count", r.count, Range::not_negative);
    a("reason", r.reason);
}

template <class Archive, Is<StationEnvironment> Struct>
void describe(Archive& a, Struct& r) {
    a("station", r.station);
    a("fixture_degC", r.fixture_degC);
    a("u_fixture_K", r.u_fixture_K, Range::not_negative);
    a("air_degC", r.air_degC);
    a("pressure_hPa", r.pressure_hPa);
    a("humidity_percent", r.humidity_percent);
    a("expansion_um", r.expansion_um);
    a.group("printed", [&](auto& b) {
        b("fixture", r.printed.fixture);
        b("u_fixture", r.printed.u_fixture);
        b("air", r.printed.air);
        b("pressure", r.printed.pressure);
        b("humidity", r.printed.humidity);
        b("expansion", r.printed.expansion);
    });
}

template <class Archive, Is<Environment> Struct>
void describe(Archive& a, Struct& r) {
    a("reference_degC", r.reference_degC);
    a("expansion_per_K", r.expansion_per_K);
    a("u_expansion_per_K", r.u_expansion_per_K, Range::not_negative);
    a("largest_distance_mm", r.largest_distance_mm, Range::not_negative);
    a("largest_share", r.largest_share);
    a("stations", r.stations);
    a.group("printed", [&](auto& b) {
        b("reference", r.printed.reference);
        b("expansion", r.printed.expansion);
        b("u_expansion", r.printed.u_expansion);
        b("largest_distance", r.printed.largest_distance);
        b("largest_share", r.printed.largest_share);
        b("lowest", r.printed.lowest);
        b("highest", r.printed.highest);
        b("least_expansion", r.printed.least_expansion);
        b("most_expansion", r.printed.most_expansion);
    });
}

template <class Archive, Is<InputFile> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("sha256", r.sha256);
    a.added("content", r.content);
    a.added("encoding", r.encoding, {"utf-8", "base64", "none"});
}

template <class Archive, Is<Software> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("version", r.version);
    a("commit", r.commit);
}

template <class Archive, Is<gum::Diagnostic> Struct>
void describe(Archive& a, Struct& r) {
    a("code", r.code);
    a("where", r.where);
    a("what", r.what);
    a("rule", r.rule);
    a("action", r.action);
    a.severity("severity", r.severity);
}

template <class Archive, Is<IdentifiedSentence::Argument> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("value", r.value);
}

template <class Archive, Is<IdentifiedSentence> Struct>
void describe(Archive& a, Struct& r) {
    a("id", r.id);
    a("arguments", r.arguments);
    a("text", r.text);
}

template <class Archive, Is<InputQuantity> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("description", r.description);
    a("unit", r.unit);
}

template <class Archive, Is<MachinePoint> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name);
    a("residual_um", r.residual_um);
    a("u_um", r.u_um, Range::positive);
}

template <class Archive, Is<MachineFrame> Struct>
void describe(Archive& a, Struct& r) {
    a("by", r.by);
    a("source", r.source);
    a("nominal_point_mm", r.nominal_point_mm);
    a("points", r.points);
    a("chi_square", r.chi_square, Range::not_negative);
    a("degrees_of_freedom", r.degrees_of_freedom, Range::not_negative);
    a("p_value", r.p_value, Range::probability);
    a.group("printed", [&](auto& b) {
        b("p", r.printed_p);
        b("residual", r.printed_residual);
    });
}

template <class Archive, Is<RotaryTable> Struct>
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
        b("critical_value", r.outlier_critical_value, Range::not_negative);
        b("alpha", r.outlier_alpha, Range::probability);
        b("printed_critical_value", r.printed_critical_value);
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

template <class Archive, Is<ClosureSeriesRow> Struct>
void describe(Archive& a, Struct& r) {
    a("position", r.position, Range::not_negative);
    a("repetition", r.repetition);
    a("readings", r.readings, Range::positive);
    a("zero", r.zero);
    a("drift", r.drift);
    a("residual_rms", r.residual_rms, Range::not_negative);
    a("misclosure", r.misclosure);
    a.group("printed", [&](auto& b) {
        b("zero", r.printed.zero);
        b("drift", r.printed.drift);
        b("residual_rms", r.printed.residual_rms);
        b("misclosure", r.printed.misclosure);
    });
}

template <class Archive, Is<ClosureResidualRow> Struct>
void describe(Archive& a, Struct& r) {
    a("position", r.position, Range::not_negative);
    a("step", r.step, Range::not_negative);
    a("side", r.side, Range::not_negative);
    a("repetition", r.repetition);
    a("reading", r.reading);
    a("residual", r.residual);
    a("redundancy", r.redundancy, Range::probability);
    a.group("printed", [&](auto& b) {
        b("reading", r.printed.reading);
        b("residual", r.printed.residual);
    });
}

template <class Archive, Is<ClosureTestRow> Struct>
void describe(Archive& a, Struct& r) {
    a("name", r.name, {"stated", "repetition", "reading", "misclosure"});
    a("statistic", r.statistic, Range::not_negative);
    a("nu", r.nu, Range::positive);
    a("nu_reference", r.nu_reference, Range::positive);
    a("p_value", r.p_value, Range::probability);
    a("accepted", r.accepted);
    a.group("printed", [&](auto& b) {
        b("statistic", r.printed.statistic);
        b("nu", r.printed.nu);
        b("nu_reference", r.printed.nu_reference);
        b("p_value", r.printed.p_value);
    });
}

template <class Archive, Is<CircleClosure> Struct>
void describe(Archive& a, Struct& r) {
    a("table", r.table);
    a("artefact", r.artefact);
    a("artefact_description", r.artefact_description);
    a("unit", r.unit);
    a("numbering", r.numbering, {"with", "against"});
    a("sense", r.sense, {"positive", "negative"});
    a("drift", r.drift, {"none", "linear"});
    a("steps", r.steps, Range::positive);
    a("positions", r.positions, Range::positive);
    a("step_angles_deg", r.step_angles_deg);
    a("side_angles_deg", r.side_angles_deg);
    a("full", r.full);
    a("readings", r.readings, Range::positive);
    a("unknowns", r.unknowns, Range::positive);
    a("degrees_of_freedom", r.degrees_of_freedom, Range::not_negative);
    a("residual_standard_deviation", r.residual_standard_deviation, Range::not_negative);
    a("u_reading", r.u_reading, Range::not_negative);
    a("nu_reading", r.nu_reading, Range::positive);
    a("u_reading_from", r.u_reading_from, {"residuals", "stated"});
    a("condition_number", r.condition_number, Range::positive);
    a("tests", r.tests);
    a("series", r.series);
    a("residuals", r.residuals);
    a.group("printed", [&](auto& b) {
        b("residual_standard_deviation", r.printed.residual_standard_deviation);
        b("u_reading", r.printed.u_reading);
        b("unit", r.printed.unit);
    });
}

template <class Archive, Is<EvaluationRecord> Struct>
void describe(Archive& a, Struct& r) {
    a.constant("schema", EvaluationRecord::k_schema);
    a("kind", r.kind, {"budget", "rotary_table", "circle_closure", "comparison"});
    a("title", r.title);
    a("software", r.software);
    a("coverage_probability", r.coverage_probability, Range::probability);
    a.group("printed", [&](auto& b) { b("coverage_probability", r.printed_coverage); });
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
    a("rotary", r.rotary);
    a.added("circle_closure", r.circle_closure);
    a("comparison", r.comparison);
    a.added("certificate", r.certificate);
    a("diagnostics", r.diagnostics);
    a.added("statements", r.statements);
    a.digest("digest", r.digest);
    a.null("audit");  // the record of this version holds no audit
}

/// The parameters of ISO 230-2 that a record may hold.
constexpr std::array<const char*, 12> k_positioning_names = {"M",      "E", "E_up",   "E_down", "R",    "R_up",
                                                             "R_down", "B", "B_mean", "A",      "A_up", "A_down"};

/// What must hold in a Monte Carlo evaluation of one quantity.
template <class Report>
void check_monte_carlo(const MonteCarloSummary& m, const std::string& at, const Report& report) {
    for (const auto& [name, ends] : {std::pair("symmetric", m.symmetric), std::pair("shortest", m.shortest)}) {
        if (ends[0] > ends[1]) {
            report(at + "/" + name, shortest(ends[0]) + " to " + shortest(ends[1]),
                   "the lower end of an interval is not above the upper end");
        }
    }
    std::int64_t left = m.trials;
    for (const std::int64_t count : m.histogram) {
        left = count > left ? -1 : left - count;
        if (left < 0) {
            report(at + "/histogram/counts", "more than the trials",
                   "the cells hold at most all " + std::to_string(m.trials) + " trials");
            break;
        }
    }
    if (!m.histogram.empty() && !(m.histogram_low < m.histogram_high)) {
        report(at + "/histogram/high", shortest(m.histogram_high), "must be above the low end");
    }
}

/// What must hold between the parts of a circle closure. Calls `report(pointer, what, rule)` for each breach.
template <class Report>
void check_closure(const CircleClosure& c, const Report& report) {
    const auto length = [&](const std::string& at, std::size_t found, std::int64_t expected, const char* rule) {
        if (std::cmp_not_equal(found, expected)) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
    };
    length("/step_angles_deg", c.step_angles_deg.size(), c.steps, "one a step");
    length("/side_angles_deg", c.side_angles_deg.size(), c.steps, "one a side");
    length("/residuals", c.residuals.size(), c.readings, "one a reading");
    for (std::size_t i = 0; i < c.residuals.size(); ++i) {
        if (c.residuals[i].step > c.steps || c.residuals[i].side >= c.steps || c.residuals[i].position >= c.steps) {
            report("/residuals/" + std::to_string(i), "a step, side or position beyond the circle",
                   "they are numbered from 0; the closing reading is at the step after the last one");
        }
    }
}

/// What must hold between the parts of a rotary table. Calls `report(pointer, what, rule)` for each breach.
template <class Report>
void check_rotary(const RotaryTable& r, const Report& report) {
    static constexpr std::array<const char*, 6> k_stem = {"EX", "EY", "EZ", "EA", "EB", "EC"};
    for (std::size_t i = 0; i < k_stem.size(); ++i) {
        if (const std::string expected = k_stem[i] + r.axis; r.error_names[i] != expected) {
            report(
                "/error_names/" + std::to_string(i), '"' + r.error_names[i] + '"',
                "the error motions of axis " + r.axis + " are named and ordered as in ISO 230-7: \"" + expected + '"');
        }
    }
    const auto length = [&](const std::string& at, std::size_t found, std::size_t expected, const char* rule) {
        if (found != expected) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
    };
    if (std::set<std::string>(r.budget_sources.begin(), r.budget_sources.end()).size() != r.budget_sources.size()) {
        report("/budget_sources", "a source is named twice", "every source has a name of its own");
    }
    for (std::size_t i = 0; i < r.budget.size(); ++i) {
        length("/budget/" + std::to_string(i) + "/shares", r.budget[i].shares.size(), r.budget_sources.size(),
               "one share a source");
    }
    for (std::size_t i = 0; i < r.budget_summary.size(); ++i) {
        const std::string at = "/budget_summary/" + std::to_string(i);
        length(at + "/shares", r.budget_summary[i].shares.size(), r.budget_sources.size(), "one share a source");
        length(at + "/printed/shares", r.budget_summary[i].printed_shares.size(), r.budget_sources.size(),
               "one share a source");
    }
    for (std::size_t i = 0; i < r.stations.size(); ++i) {
        const std::string at = "/stations/" + std::to_string(i) + "/printed/";
        length(at + "position", r.stations[i].printed_position.size(), 3, "one a coordinate");
        length(at + "U", r.stations[i].printed_U.size(), 3, "one a coordinate");
    }
    for (std::size_t i = 0; i < r.reflectors.size(); ++i) {
        const std::string at = "/reflectors/" + std::to_string(i) + "/printed/";
        length(at + "position", r.reflectors[i].printed_position.size(), 3, "one a coordinate");
        length(at + "U", r.reflectors[i].printed_U.size(), 3, "one a coordinate");
        length(at + "correction", r.reflectors[i].printed_correction.size(), 3, "one a coordinate");
        // Records of earlier releases do not hold what the CMM stated.
        for (const auto& [name, texts] :
             {std::pair("cmm", &r.reflectors[i].printed_cmm), std::pair("U_cmm", &r.reflectors[i].printed_U_cmm)}) {
            length(at + name, texts->size(), texts->empty() ? 0 : 3, "one a coordinate, or none");
        }
    }
    const auto symmetric = [&](const std::string& at, const std::array<std::array<double, 3>, 3>& m) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const double most = std::sqrt(std::abs(m[i][i]) * std::abs(m[j][j]));
                if (m[i][i] < 0.0 || !(std::abs(m[i][j] - m[j][i]) <= 1e-9 * most) ||
                    !(std::abs(m[i][j]) <= most * (1.0 + 1e-9))) {
                    report(at + "/" + std::to_string(i) + "/" + std::to_string(j), shortest(m[i][j]),
                           "a covariance matrix is symmetric, and no covariance exceeds what its variances allow");
                    return;
                }
            }
        }
    };
    for (std::size_t i = 0; i < r.stations.size(); ++i) {
        symmetric("/stations/" + std::to_string(i) + "/covariance_mm2", r.stations[i].covariance_mm2);
    }
    for (std::size_t i = 0; i < r.reflectors.size(); ++i) {
        symmetric("/reflectors/" + std::to_string(i) + "/covariance_mm2", r.reflectors[i].covariance_mm2);
    }
    if (const GlobalTest& test = r.adjustment.global_test; test.lower > test.upper) {
        report("/adjustment/global_test/lower", shortest(test.lower), "must not be above the upper limit");
    }
    const auto trials = [&](const std::string& at, const std::optional<MonteCarloSummary>& m) {
        if (m) {
            check_monte_carlo(*m, at + "/monte_carlo", report);
        }
    };
    for (std::size_t i = 0; i < r.errors.size(); ++i) {
        for (std::size_t m = 0; m < r.errors[i].errors.size(); ++m) {
            trials("/errors/" + std::to_string(i) + "/" + r.error_names[m], r.errors[i].errors[m].monte_carlo);
        }
    }
    for (std::size_t i = 0; i < r.ranges.size(); ++i) {
        trials("/ranges/" + std::to_string(i), r.ranges[i].monte_carlo);
    }
    for (std::size_t i = 0; i < r.reversal.size(); ++i) {
        trials("/reversal/" + std::to_string(i), r.reversal[i].value.monte_carlo);
    }
    const auto parameters = [&](const std::string& at, const std::vector<TableParameter>& all) {
        std::set<std::string> names;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string one = at + "/" + std::to_string(i);
            trials(one, all[i].monte_carlo);
            if (!names.insert(all[i].name).second) {
                report(one + "/name", '"' + all[i].name + '"', "a parameter is listed once");
            }
        }
    };
    parameters("/axis_line", r.axis_line);
    parameters("/location_errors", r.location_errors);
    if (r.iso230_2) {
        const std::vector<TableParameter>& all = r.iso230_2->parameters;
        parameters("/iso230_2/parameters", all);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (std::find(k_positioning_names.begin(), k_positioning_names.end(), all[i].name) ==
                k_positioning_names.end()) {
                report("/iso230_2/parameters/" + std::to_string(i) + "/name", '"' + all[i].name + '"',
                       "must be a parameter of ISO 230-2: M, E, R, B, A …");
            }
        }
    }
    if (r.monte_carlo && r.monte_carlo->validated > r.monte_carlo->compared) {
        report("/monte_carlo/validated", std::to_string(r.monte_carlo->validated),
               "not more than the " + std::to_string(r.monte_carlo->compared) + " that were compared");
    }
}

/// What must hold between the results of a record and what is said of them together. Calls
/// `report(pointer, what, rule)` for each breach.
template <class Report>
void check_results(const EvaluationRecord& r, const Report& report) {
    const auto length = [&](const std::string& at, std::size_t found, std::size_t expected, const char* rule) {
        if (found != expected) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
        return found == expected;
    };
    const auto square = [&](const std::string& at, const auto& matrix, std::size_t size, const char* rule) {
        bool sound = length(at, matrix.size(), size, rule);
        for (std::size_t i = 0; i < matrix.size(); ++i) {
            sound = length(at + "/" + std::to_string(i), matrix[i].size(), size, rule) && sound;
        }
        return sound;
    };
    const auto symmetric = [&](const std::string& at, const std::vector<std::vector<double>>& matrix) {
        for (std::size_t i = 0; i < matrix.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const double noise = 1e-9 * std::sqrt(std::abs(matrix[i][i]) * std::abs(matrix[j][j]));
                if (!(std::abs(matrix[i][j] - matrix[j][i]) <= noise)) {
                    report(at + "/" + std::to_string(i) + "/" + std::to_string(j), shortest(matrix[i][j]),
                           "a covariance or correlation matrix is symmetric; the other half says " +
                               shortest(matrix[j][i]));
                    return;
                }
            }
        }
    };
    std::set<std::string> names;
    for (const Result& result : r.results) {
        const std::string at = "/results/" + pointer_token(result.name);
        names.insert(result.name);
        if (result.U.has_value() != (result.coverage != "none") || (result.k && !result.U)) {
            report(at + "/U", result.U ? "stated" : "not stated",
                   "an expanded uncertainty is stated unless `coverage` is \"none\", and k only beside it; `coverage` "
                   "is \"" +
                       result.coverage + '"');
        }
        if (result.monte_carlo) {
            check_monte_carlo(*result.monte_carlo, at + "/monte_carlo", report);
        }
        if (const auto& interval = result.reported.interval; interval && (*interval)[0] > (*interval)[1]) {
            report(at + "/reported/interval", shortest((*interval)[0]) + " to " + shortest((*interval)[1]),
                   "the lower end of an interval is not above the upper end");
        }
        if (result.reported.method == "monte_carlo" && !result.monte_carlo) {
            report(at + "/reported/method", "\"monte_carlo\"", "a result of Monte Carlo needs its trials beside it");
        }
    }
    if (r.covariance) {
        const ResultCovariance& c = *r.covariance;
        const std::string at = "/covariance";
        for (std::size_t i = 0; i < c.names.size(); ++i) {
            if (!names.contains(c.names[i])) {
                report(at + "/names/" + std::to_string(i), '"' + c.names[i] + '"', "must be the name of a result");
            }
        }
        length(at + "/units", c.units.size(), c.names.size(), "one a name");
        const std::size_t size = c.file.empty() ? c.names.size() : 0;
        const char* rule = c.file.empty() ? "one a name" : "because the matrix is in a file";
        if (square(at + "/matrix", c.matrix, size, rule)) {
            symmetric(at + "/matrix", c.matrix);
        }
        if (square(at + "/correlation", c.correlation, size, rule)) {
            symmetric(at + "/correlation", c.correlation);
        }
        square(at + "/printed/correlation", c.printed_correlation, size, rule);
    }
    for (std::size_t i = 0; i < r.fits.size(); ++i) {
        const FitSummary& f = r.fits[i];
        const std::string at = "/fits/" + std::to_string(i);
        if (square(at + "/covariance", f.covariance, f.parameters.size(), "one a parameter")) {
            symmetric(at + "/covariance", f.covariance);
        }
        if (square(at + "/correlation", f.correlation, f.parameters.size(), "one a parameter")) {
            symmetric(at + "/correlation", f.correlation);
        }
        if (!f.x_name.empty() || !f.x.empty()) {
            length(at + "/data/x", f.x.size(), f.y.size(), "one a value of y");
        }
        length(at + "/data/fitted", f.fitted.size(), f.y.size(), "one a value of y");
        length(at + "/data/residual", f.residual.size(), f.y.size(), "one a value of y");
        const auto length_if_any = [&](const std::string& key, std::size_t found) {
            if (found != 0) {
                length(at + key, found, f.y.size(), "one a value of y");
            }
        };
        length_if_any("/data/u_x", f.u_x.size());
        length_if_any("/data/u_y", f.u_y.size());
        length_if_any("/printed/x", f.printed.x.size());
        length_if_any("/printed/y", f.printed.y.size());
        length_if_any("/printed/u_x", f.printed.u_x.size());
        length_if_any("/printed/u_y", f.printed.u_y.size());
        length_if_any("/printed/residual", f.printed.residual.size());
        for (std::size_t q = 0; q < f.regressors.size(); ++q) {
            length_if_any("/data/regressors/" + std::to_string(q) + "/values", f.regressors[q].values.size());
            length_if_any("/data/regressors/" + std::to_string(q) + "/printed", f.regressors[q].printed.size());
        }
    }
}

/// What must hold between the parts of a certificate, so that a document can be made of it. Calls
/// `report(pointer, what, rule)` for each breach.
template <class Report>
void check_certificate(const certificate::Certificate& c, const Report& report) {
    const auto length = [&](const std::string& at, std::size_t found, std::size_t expected, const char* rule) {
        if (found != expected) {
            report(at, std::to_string(found) + " items", "must be " + std::to_string(expected) + ", " + rule);
        }
    };
    for (std::size_t t = 0; t < c.tables.size(); ++t) {
        const certificate::CertifiedTable& table = c.tables[t];
        const std::string at = "/certificate/tables/" + std::to_string(t);
        if (table.argument) {
            length(at + "/argument/values", table.argument->values.size(), table.argument->printed.size(),
                   "one a printed value");
        }
        const std::size_t rows = table.argument ? table.argument->printed.size() : 1;
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
            const std::string column = at + "/columns/" + std::to_string(i) + "/values";
            length(column, table.columns[i].values.size(), rows, table.argument ? "one a row" : "one without argument");
            for (std::size_t row = 0; row < table.columns[i].values.size(); ++row) {
                const auto& interval = table.columns[i].values[row].interval;
                if (interval && interval->first > interval->second) {
                    report(column + "/" + std::to_string(row) + "/interval",
                           shortest(interval->first) + " to " + shortest(interval->second),
                           "the lower end of an interval is not above the upper end");
                }
            }
        }
    }
    if (c.data.languages.empty()) {
        report("/certificate/data/languages", "no language", "a certificate is in one language at least");
    }
    for (std::size_t i = 0; i < c.data.languages.size(); ++i) {
        if (std::find(certificate::k_languages.begin(), certificate::k_languages.end(), c.data.languages[i]) ==
            certificate::k_languages.end()) {
            report("/certificate/data/languages/" + std::to_string(i), '"' + c.data.languages[i] + '"',
                   "must be one of \"en\" \"de\" \"zh-Hant\" \"es\"");
        }
    }
}

constexpr std::array<const char*, 3> k_severities = {"note", "warning", "error"};
constexpr const char* k_digest_key = "digest";
constexpr const char* k_digest_algorithm = "SHA-256";

/// Where a value stands. Its JSON pointer is made where it is needed: a record has a million values, and few problems.
struct Place {
    const std::string& parent;  ///< JSON pointer of the object or array around it
    std::string_view key;

    [[nodiscard]] std::string pointer() const { return parent + "/" + pointer_token(key); }
};

class Writer {
public:
    explicit Writer(std::string pointer) : pointer_(std::move(pointer)) {}
    json object = json::object();

    template <class Type>
    void operator()(const char* key, const Type& v, Range range = Range::any) {
        object[key] = to_json(v, {pointer_, key}, range);
    }

    void operator()(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        if (std::find(allowed.begin(), allowed.end(), v) == allowed.end()) {
            refuse(pointer_ + "/" + key, '"' + v + '"', "is not one of the names that a record may hold here");
        }
        object[key] = v;
    }

    void operator()(const char* key, const std::vector<std::string>& v, std::initializer_list<const char*> allowed) {
        const std::string at = pointer_ + "/" + key;
        json all = json::array();
        for (std::size_t i = 0; i < v.size(); ++i) {
            Writer inner(at);
            inner(std::to_string(i).c_str(), v[i], allowed);
            all.push_back(v[i]);
        }
        object[key] = std::move(all);
    }

    /// What a text holds is the business of those who state it; a record keeps it as it is.
    template <class Type>
    void operator()(const char* key, const Type& v, certificate::TextForm) {
        (*this)(key, v);
    }

    // In a record every key is present, whoever it comes from.
    template <class Type, class... Rule>
    void needed(const char* key, const Type& v, const Rule&... rule) {
        (*this)(key, v, rule...);
    }
    void needed(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        (*this)(key, v, allowed);
    }
    template <class Type>
    void filled(const char* key, const Type& v) {
        (*this)(key, v);
    }

    template <class Enumerator>
    void named(const char* key, Enumerator v, std::initializer_list<const char*> words) {
        object[key] = *(words.begin() + static_cast<std::ptrdiff_t>(v));
    }

    /// A key that a later release added to the schema: always written, may be missing where it is read.
    template <class Type, class... Rule>
    void added(const char* key, const Type& v, const Rule&... rule) {
        (*this)(key, v, rule...);
    }
    void added(const char* key, const std::string& v, std::initializer_list<const char*> allowed) {
        (*this)(key, v, allowed);
    }

    template <class Describe>
    void group(const char* key, const Describe& describe_group) {
        Writer inner(pointer_ + "/" + key);
        describe_group(inner);
        object[key] = std::move(inner.object);
    }

    void constant(const char* key, const char* v) { object[key] = v; }
    void null(const char* key) { object[key] = nullptr; }
    void digest(const char*, const std::string&) {}  // with_digest() adds it to the finished record

    void severity(const char* key, gum::Severity v) { object[key] = k_severities.at(static_cast<std::size_t>(v)); }

    void document(const char* key, const std::string& text) {
        json value = text.empty() ? json() : json::parse(text, nullptr, false);
        if (value.is_discarded()) {
            refuse(pointer_ + "/" + key, "text that is not JSON", "the job and the options are JSON texts");
        }
        object[key] = std::move(value);
    }

    void results(const char* key, const std::vector<Result>& v) {
        json all = json::object();
        for (std::size_t i = 0; i < v.size(); ++i) {
            const std::string at = pointer_ + "/" + key + "/" + pointer_token(v[i].name);
            json item = structure(v[i], at);
            item["reported"] = structure(reported_result(v[i]), at + "/reported");
            item["order"] = i;
            insert(all, v[i].name, std::move(item), at);
        }
        object[key] = std::move(all);
    }

    void summary(const char* key, const std::vector<ComparisonSummary>& v) {
        json all = json::object();
        for (std::size_t i = 0; i < v.size(); ++i) {
            const std::string at = pointer_ + "/" + key + "/" + pointer_token(v[i].direction);
            json item = structure(v[i], at);
            item["order"] = i;
            insert(all, v[i].direction, std::move(item), at);
        }
        object[key] = std::move(all);
    }

    void errors(const char* key, const std::vector<ErrorsAtAngle>& v, const RotaryTable& rotary) {
        json all = json::array();
        for (std::size_t i = 0; i < v.size(); ++i) {
            Writer inner(pointer_ + "/" + key + "/" + std::to_string(i));
            inner("angle_deg", v[i].angle_deg);
            inner("printed_angle", v[i].printed_angle);
            for (std::size_t m = 0; m < v[i].errors.size(); ++m) {
                const std::string& name = rotary.error_names[m];
                const std::string at = inner.pointer_ + "/" + pointer_token(name);
                insert(inner.object, name, structure(v[i].errors[m], at), at);
            }
            all.push_back(std::move(inner.object));
        }
        object[key] = std::move(all);
    }

    void quantity_budgets(const char* key, const std::vector<QuantityBudget>& v,
                          const std::vector<std::string>& sources) {
        json all = json::array();
        for (std::size_t i = 0; i < v.size(); ++i) {
            Writer inner(pointer_ + "/" + key + "/" + std::to_string(i));
            inner("quantity", v[i].quantity);
            inner("angle_deg", v[i].angle_deg);
            inner("u", v[i].u, Range::not_negative);
            inner("unit", v[i].unit);
            json shares = json::object();
            for (std::size_t s = 0; s < std::min(sources.size(), v[i].shares.size()); ++s) {
                shares[sources[s]] = to_json(v[i].shares[s], {inner.pointer_, "shares"}, Range::any);
            }
            inner.object["shares"] = std::move(shares);
            all.push_back(std::move(inner.object));
        }
        object[key] = std::move(all);
    }

    /// The numbers of the parameters under their names, as the contract has them, beside the list with everything.
    void by_name(const std::vector<TableParameter>& v) {
        json U = json::object();
        for (const TableParameter& p : v) {
            object[p.name] = p.value;
            U[p.name] = p.U;
        }
        object["U"] = std::move(U);
    }

    /// \param action  a record that breaks its own rules is a fault of the program, unless the caller knows better
    [[noreturn]] static void refuse(const std::string& pointer, std::string what, std::string rule,
                                    std::string action = "nothing was written; report this as a defect") {
        throw gum::NoResultError(gum::Diagnostic{.code = "GC-RECORD-0028",
                                                 .where = "record#" + pointer,
                                                 .what = std::move(what),
                                                 .rule = std::move(rule),
                                                 .action = std::move(action)});
    }

private:
    std::string pointer_;

    static void insert(json& into, const std::string& name, json item, const std::string& at) {
        if (!into.emplace(name, std::move(item)).second) {
            refuse(at, "the name \"" + name + "\" is used twice", "names of one list differ");
        }
    }

    template <class Struct>
    static json structure(const Struct& v, const std::string& at) {
        Writer inner(at);
        describe(inner, v);
        return std::move(inner.object);
    }

    /// A text for all languages is a string, else an object with one text a language.
    static json text_to_json(const certificate::LocalisedText& v, const std::string& at) {
        if (v.by_language.empty()) {
            return v.plain;
        }
        if (!v.plain.empty()) {
            refuse(at, "a text for all languages beside one in " + v.by_language.front().first,
                   "a text is given once for all languages, or once in each");
        }
        json all = json::object();
        for (const auto& [language, text] : v.by_language) {
            if (std::find(certificate::k_languages.begin(), certificate::k_languages.end(), language) ==
                certificate::k_languages.end()) {
                refuse(at, "the language \"" + language + '"', "is none of those that a certificate may have");
            }
            insert(all, language, text, at);
        }
        return all;
    }

    template <class Type>
    static json to_json(const Type& v, const Place& at, Range range) {
        if constexpr (std::same_as<Type, double>) {
            if (!std::isfinite(v)) {
                throw gum::NoResultError(
                    gum::Diagnostic{.code = "GC-RECORD-0001",
                                    .where = "record#" + at.pointer(),
                                    .what = shortest(v),
                                    .rule = "every number of a record is finite",
                                    .action = "nothing was written; check the input that leads to it"});
            }
            if (!inside(v, range)) {
                refuse(at.pointer(), shortest(v), rule_of(range));
            }
            return v;
        } else if constexpr (std::same_as<Type, std::int64_t> || std::same_as<Type, int>) {
            if (!inside(static_cast<double>(v), range)) {
                refuse(at.pointer(), std::to_string(v), rule_of(range));
            }
            return v;
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            return text_to_json(v, at.pointer());
        } else if constexpr (std::same_as<Type, std::pair<double, double>>) {
            const std::string inside = at.pointer();
            return json::array({to_json(v.first, {inside, "0"}, range), to_json(v.second, {inside, "1"}, range)});
        } else if constexpr (std::same_as<Type, bool> || std::same_as<Type, std::string>) {
            return v;
        } else if constexpr (requires { v.has_value(); }) {
            return v.has_value() ? to_json(*v, at, range) : json();
        } else if constexpr (requires { v.size(); }) {
            const std::string inside = at.pointer();
            json all = json::array();
            for (std::size_t i = 0; i < v.size(); ++i) {
                all.push_back(to_json(v[i], {inside, std::to_string(i)}, range));
            }
            return all;
        } else {
            return structure(v, at.pointer());
        }
    }
};

/// Collects what is wrong with a text; the list has an upper limit, so that a hostile text cannot fill the memory.
class Problems {
public:
    explicit Problems(std::string where) : where_(std::move(where)) {}

    void add(const char* code, const std::string& pointer, std::string what, std::string rule, std::string action) {
        if (list_.size() < k_limit) {
            list_.push_back(gum::Diagnostic{.code = code,
                                            .where = where_ + "#" + pointer,
                                            .what = std::move(what),
                                            .rule = std::move(rule),
                                            .action = std::move(action)});
        } else {
            ++left_out_;
        }
    }

    void throw_if_any() {
        if (list_.empty()) {
            return;
        }
        if (left_out_ > 0) {
            list_.push_back(gum::Diagnostic{.code = "GC-RECORD-0019",
                                            .where = where_,
                                            .what = std::to_string(left_out_) + " more problems",
                                            .rule = "at most " + std::to_string(k_limit) + " are listed",
                                            .action = "correct those above first"});
        }
        throw gum::InputError(std::move(list_));
    }

private:
    static constexpr std::size_t k_limit = 200;
    std::string where_;
    std::vector<gum::Diagnostic> list_;
    std::size_t left_out_ = 0;
};

constexpr const char* k_restore = "take the record as the program wrote it";

class Reader {
public:
    Reader(const json& object, std::string pointer, Problems& problems)
        : object_(object), pointer_(std::move(pointer)), problems_(problems) {}

    template <class Type>
    void operator()(const char* key, Type& v, Range range = Range::any) {
        if (const json* item = find(key)) {
            from_json(*item, v, {pointer_, key}, range);
        }
    }

    void operator()(const char* key, std::string& v, std::initializer_list<const char*> allowed) {
        const json* item = find(key);
        if (item == nullptr) {
            return;
        }
        from_json(*item, v, {pointer_, key}, Range::any);
        if (item->is_string() && std::find(allowed.begin(), allowed.end(), v) == allowed.end()) {
            unknown_word(pointer_ + "/" + key, v, allowed);
        }
    }

    void operator()(const char* key, std::vector<std::string>& v, std::initializer_list<const char*> allowed) {
        (*this)(key, v);
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (std::find(allowed.begin(), allowed.end(), v[i]) == allowed.end()) {
                unknown_word(pointer_ + "/" + key + "/" + std::to_string(i), v[i], allowed);
            }
        }
    }

    template <class Type>
    void operator()(const char* key, Type& v, certificate::TextForm) {
        (*this)(key, v);
    }

    template <class Type, class... Rule>
    void needed(const char* key, Type& v, const Rule&... rule) {
        (*this)(key, v, rule...);
    }
    void needed(const char* key, std::string& v, std::initializer_list<const char*> allowed) {
        (*this)(key, v, allowed);
    }
    template <class Type>
    void filled(const char* key, Type& v) {
        (*this)(key, v);
    }

    template <class Enumerator>
    void named(const char* key, Enumerator& v, std::initializer_list<const char*> words) {
        std::string name;
        (*this)(key, name, words);
        const auto found = std::find(words.begin(), words.end(), name);
        if (found != words.end()) {
            v = static_cast<Enumerator>(found - words.begin());
        }
    }

    /// A key that a later release added to the schema: where it is missing, the value stays as it is.
    template <class Type>
    void added(const char* key, Type& v, Range range = Range::any) {
        if (const json* item = find_if_there(key)) {
            from_json(*item, v, {pointer_, key}, range);
        }
    }
    void added(const char* key, std::string& v, std::initializer_list<const char*> allowed) {
        if (object_.contains(key)) {
            (*this)(key, v, allowed);
        }
    }

    template <class Describe>
    void group(const char* key, const Describe& describe_group) {
        if (const json* item = find(key)) {
            const std::string at = pointer_ + "/" + key;
            if (!item->is_object()) {
                wrong_type(*item, at, "an object");
                return;
            }
            Reader inner(*item, at, problems_);
            describe_group(inner);
            inner.finish();
        }
    }

    void constant(const char* key, const char*) { static_cast<void>(find(key)); }  // the caller has looked at it

    void null(const char* key) {
        if (const json* item = find(key); item != nullptr && !item->is_null()) {
            wrong_type(*item, pointer_ + "/" + key, "null in records of this version");
        }
    }

    /// Records of earlier releases state none.
    void digest(const char* key, std::string& value) {
        const json* item = find_if_there(key);
        if (item == nullptr) {
            return;
        }
        const std::string at = pointer_ + "/" + key;
        if (!item->is_object()) {
            wrong_type(*item, at, "an object");
            return;
        }
        std::string algorithm;
        Reader inner(*item, at, problems_);
        inner("algorithm", algorithm, {k_digest_algorithm});
        inner("value", value);
        inner.finish();
        if (value.empty()) {
            problems_.add("GC-RECORD-0016", at + "/value", "\"\"", "must be 64 hexadecimal digits", k_restore);
        }
    }

    void severity(const char* key, gum::Severity& v) {
        std::string name;
        (*this)(key, name, {k_severities[0], k_severities[1], k_severities[2]});
        for (std::size_t i = 0; i < k_severities.size(); ++i) {
            if (name == k_severities[i]) {
                v = static_cast<gum::Severity>(i);
            }
        }
    }

    void document(const char* key, std::string& text) {
        if (const json* item = find(key)) {
            text = canonical_json(*item);
        }
    }

    void results(const char* key, std::vector<Result>& v) {
        const json* all = find_object(key);
        if (all == nullptr) {
            return;
        }
        std::map<std::int64_t, Result> in_order;
        for (const auto& [name, item] : all->items()) {
            const std::string at = pointer_ + "/" + key + "/" + pointer_token(name);
            if (!item.is_object()) {
                wrong_type(item, at, "an object");
                continue;
            }
            Result result;
            result.name = name;
            std::int64_t order = -1;
            Reader inner(item, at, problems_);
            describe(inner, result);
            inner("order", order);
            inner.finish();
            result.reported = reported_result(result);
            if (order < 0 || static_cast<std::uint64_t>(order) >= all->size() || in_order.contains(order)) {
                problems_.add("GC-RECORD-0016", at + "/order", std::to_string(order),
                              "the orders of all results are 0, 1, 2 …, each once", k_restore);
                continue;
            }
            in_order.emplace(order, std::move(result));
        }
        for (auto& [order, result] : in_order) {
            v.push_back(std::move(result));
        }
    }

    /// Records of earlier releases hold no order of the directions: then they come by name, "all" last.
    void summary(const char* key, std::vector<ComparisonSummary>& v) {
        const json* all = find_object(key);
        if (all == nullptr) {
            return;
        }
        std::map<std::int64_t, ComparisonSummary> in_order;
        const auto size = static_cast<std::int64_t>(all->size());
        const bool ordered =
            std::any_of(all->begin(), all->end(), [](const json& i) { return i.is_object() && i.contains("order"); });
        std::int64_t next = 0;
        for (const auto& [direction, item] : all->items()) {
            const std::string at = pointer_ + "/" + key + "/" + pointer_token(direction);
            if (!item.is_object()) {
                wrong_type(item, at, "an object");
                continue;
            }
            ComparisonSummary s;
            s.direction = direction;
            std::int64_t order = direction == "all" ? size - 1 : next++;
            Reader inner(item, at, problems_);
            describe(inner, s);
            if (ordered) {
                order = -1;
                inner("order", order);
            }
            inner.finish();
            if (order < 0 || order >= size || in_order.contains(order)) {
                problems_.add("GC-RECORD-0016", at + "/order", std::to_string(order),
                              "the orders of all directions are 0, 1, 2 …, each once", k_restore);
                continue;
            }
            in_order.emplace(order, std::move(s));
        }
        for (auto& [order, s] : in_order) {
            v.push_back(std::move(s));
        }
    }

    void errors(const char* key, std::vector<ErrorsAtAngle>& v, const RotaryTable& rotary) {
        const json* all = find_array(key);
        if (all == nullptr) {
            return;
        }
        for (std::size_t i = 0; i < all->size(); ++i) {
            const std::string at = pointer_ + "/" + key + "/" + std::to_string(i);
            if (!(*all)[i].is_object()) {
                wrong_type((*all)[i], at, "an object");
                continue;
            }
            ErrorsAtAngle row;
            Reader inner((*all)[i], at, problems_);
            inner("angle_deg", row.angle_deg);
            inner("printed_angle", row.printed_angle);
            for (std::size_t m = 0; m < row.errors.size(); ++m) {
                inner(rotary.error_names[m].c_str(), row.errors[m]);
            }
            inner.finish();
            v.push_back(std::move(row));
        }
    }

    void quantity_budgets(const char* key, std::vector<QuantityBudget>& v, const std::vector<std::string>& sources) {
        const json* all = find_array(key);
        if (all == nullptr) {
            return;
        }
        for (std::size_t i = 0; i < all->size(); ++i) {
            const std::string at = pointer_ + "/" + key + "/" + std::to_string(i);
            if (!(*all)[i].is_object()) {
                wrong_type((*all)[i], at, "an object");
                continue;
            }
            QuantityBudget row;
            Reader inner((*all)[i], at, problems_);
            inner("quantity", row.quantity);
            inner("angle_deg", row.angle_deg);
            inner("u", row.u, Range::not_negative);
            inner("unit", row.unit);
            inner.group("shares", [&](auto& shares) {
                for (const std::string& source : sources) {
                    double share = 0.0;
                    shares(source.c_str(), share);
                    row.shares.push_back(share);
                }
            });
            inner.finish();
            v.push_back(std::move(row));
        }
    }

    /// What is said twice has to be the same twice.
    void by_name(const std::vector<TableParameter>& v) {
        const json* U = find_object("U");
        const auto same = [&](const json* in, const std::string& at, const std::string& name, double expected) {
            const auto found = in == nullptr ? json::const_iterator() : in->find(name);
            const bool stated = in != nullptr && found != in->end();
            if (in != nullptr && (!stated || !found->is_number() || found->get<double>() != expected)) {
                problems_.add("GC-RECORD-0016", at + "/" + pointer_token(name), stated ? found->dump() : "missing",
                              "must be " + shortest(expected) + ", as the parameter of that name says", k_restore);
            }
        };
        std::set<std::string> names;
        for (const TableParameter& p : v) {
            names.insert(p.name);
            static_cast<void>(find_if_there(p.name));
            same(&object_, pointer_, p.name, p.value);
            same(U, pointer_ + "/U", p.name, p.U);
        }
        if (U == nullptr) {
            return;
        }
        for (const auto& [name, item] : U->items()) {
            if (!names.contains(name)) {
                problems_.add("GC-RECORD-0014", pointer_ + "/U/" + pointer_token(name), "unknown key",
                              "U holds the parameters of the list and no others", k_restore);
            }
        }
    }

    /// To be called when every known key was asked for: what is left in the object is unknown.
    void finish() {
        std::sort(known_.begin(), known_.end(), std::less<>());
        known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
        if (known_.size() == object_.size()) {
            return;
        }
        for (const auto& [key, item] : object_.items()) {
            if (!std::binary_search(known_.begin(), known_.end(), &key, std::less<>())) {
                problems_.add("GC-RECORD-0014", pointer_ + "/" + pointer_token(key), "unknown key",
                              "a record holds the keys of schema gumcert/record/1 and no others", k_restore);
            }
        }
    }

private:
    const json& object_;
    std::string pointer_;
    Problems& problems_;
    std::vector<const std::string*> known_;  ///< the keys of the object that were asked for

    const json* find_if_there(std::string_view key) {
        const auto found = object_.find(key);
        if (found == object_.end()) {
            return nullptr;
        }
        known_.push_back(&found.key());
        return &*found;
    }

    const json* find(std::string_view key) {
        const json* item = find_if_there(key);
        if (item == nullptr) {
            problems_.add("GC-RECORD-0013", pointer_ + "/" + pointer_token(key), "missing",
                          "every key of schema gumcert/record/1 is present", k_restore);
        }
        return item;
    }

    const json* find_object(const char* key) {
        const json* item = find(key);
        if (item != nullptr && !item->is_object()) {
            wrong_type(*item, pointer_ + "/" + key, "an object");
            return nullptr;
        }
        return item;
    }

    const json* find_array(const char* key) {
        const json* item = find(key);
        if (item != nullptr && !item->is_array()) {
            wrong_type(*item, pointer_ + "/" + key, "an array");
            return nullptr;
        }
        return item;
    }

    void wrong_type(const json& item, const std::string& at, const std::string& expected) {
        problems_.add("GC-RECORD-0015", at, item.type_name(), "must be " + expected, k_restore);
    }

    void unknown_word(const std::string& at, const std::string& word, std::initializer_list<const char*> allowed) {
        std::string rule = "must be one of";
        for (const char* name : allowed) {
            rule += std::string(" \"") + name + '"';
        }
        problems_.add("GC-RECORD-0016", at, '"' + word + '"', rule, k_restore);
    }

    void localised(const json& item, certificate::LocalisedText& v, const std::string& at) {
        if (item.is_string()) {
            v.plain = item.get<std::string>();
            return;
        }
        if (!item.is_object()) {
            wrong_type(item, at, "a text, or an object with one text a language");
            return;
        }
        Reader inner(item, at, problems_);
        for (const std::string_view language : certificate::k_languages) {
            if (const std::string key(language); item.contains(key)) {
                std::string text;
                inner(key.c_str(), text);
                v.by_language.emplace_back(key, std::move(text));
            }
        }
        inner.finish();
        if (item.empty()) {
            problems_.add("GC-RECORD-0016", at, "no language", "a text is stated in one language at least", k_restore);
        }
    }

    void number(const json& item, double& v, const Place& at, Range range) {
        if (!item.is_number()) {
            wrong_type(item, at.pointer(), "a number");
            return;
        }
        v = item.get<double>();
        // Whole numbers above 2^53 that a double cannot hold would lose digits in silence.
        constexpr double k_two_to_53 = 9007199254740992.0;
        if (!item.is_number_float() && std::abs(v) > k_two_to_53) {
            problems_.add("GC-RECORD-0016", at.pointer(), item.dump(), "must be a number that a double holds exactly",
                          k_restore);
        } else if (!inside(v, range)) {
            problems_.add("GC-RECORD-0016", at.pointer(), shortest(v), rule_of(range), k_restore);
        }
    }

    template <class Type>
    void from_json(const json& item, Type& v, const Place& at, Range range) {
        if constexpr (std::same_as<Type, double>) {
            number(item, v, at, range);
        } else if constexpr (std::same_as<Type, bool>) {
            if (item.is_boolean()) {
                v = item.get<bool>();
            } else {
                wrong_type(item, at.pointer(), "true or false");
            }
        } else if constexpr (std::same_as<Type, std::string>) {
            if (item.is_string()) {
                v = item.get<std::string>();
                if (v.find('\0') != std::string::npos) {
                    problems_.add("GC-RECORD-0016", at.pointer(), "a text with NUL (U+0000)",
                                  "a text that is printed has no NUL", k_restore);
                }
            } else {
                wrong_type(item, at.pointer(), "a text");
            }
        } else if constexpr (std::same_as<Type, std::int64_t>) {
            if (item.is_number_integer() && item <= std::numeric_limits<std::int64_t>::max()) {
                v = item.get<std::int64_t>();
                if (!inside(static_cast<double>(v), range)) {
                    problems_.add("GC-RECORD-0016", at.pointer(), std::to_string(v), rule_of(range), k_restore);
                }
            } else {
                wrong_type(item, at.pointer(), "a whole number");
            }
        } else if constexpr (std::same_as<Type, int>) {
            std::int64_t whole = 0;
            from_json(item, whole, at, range);
            v = static_cast<int>(
                std::clamp<std::int64_t>(whole, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            localised(item, v, at.pointer());
        } else if constexpr (std::same_as<Type, std::pair<double, double>>) {
            std::array<double, 2> ends{};
            from_json(item, ends, at, range);
            v = {ends[0], ends[1]};
        } else if constexpr (requires { v.has_value(); }) {
            if (item.is_null()) {
                v.reset();
            } else {
                // Not emplace(): for Clang a nested struct with initialisers is not constructible there.
                v = typename Type::value_type{};
                from_json(item, *v, at, range);
            }
        } else if constexpr (requires { v.size(); }) {
            list(item, v, at, range);
        } else {
            if (!item.is_object()) {
                wrong_type(item, at.pointer(), "an object");
                return;
            }
            Reader inner(item, at.pointer(), problems_);
            describe(inner, v);
            inner.finish();
        }
    }

    template <class List>
    void list(const json& item, List& v, const Place& at, Range range) {
        if (!item.is_array()) {
            wrong_type(item, at.pointer(), "an array");
            return;
        }
        if constexpr (requires { v.resize(item.size()); }) {
            v.resize(item.size());
        } else if (item.size() != v.size()) {
            problems_.add("GC-RECORD-0017", at.pointer(), std::to_string(item.size()) + " items",
                          "must be " + std::to_string(v.size()), k_restore);
            return;
        }
        const std::string inside = at.pointer();
        for (std::size_t i = 0; i < v.size(); ++i) {
            from_json(item[i], v[i], {inside, std::to_string(i)}, range);
        }
    }
};

/// Builds the JSON value while it looks for what nlohmann-json lets pass: duplicate keys and deep nesting.
class StrictParser final : public nlohmann::json_sax<json> {
public:
    explicit StrictParser(Problems& problems) : problems_(problems) {}
    json root;

    bool null() override { return put(json()); }
    bool boolean(bool v) override { return put(v); }
    bool number_integer(number_integer_t v) override { return put(v); }
    bool number_unsigned(number_unsigned_t v) override { return put(v); }
    bool number_float(number_float_t v, const string_t&) override { return put(v); }
    bool string(string_t& v) override {
        if (v.find('\0') != std::string::npos) {
            problems_.add("GC-RECORD-0016", pointer() + here(), "a text with a NUL character (\\u0000)",
                          "texts of a record have none: documents would end there", k_restore);
        }
        return put(std::move(v));
    }
    bool binary(binary_t&) override { return false; }  // JSON text has none
    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const auto [place, added] = stack_.back()->emplace(std::move(name), nullptr);
        if (!added) {
            problems_.add("GC-RECORD-0012", pointer() + "/" + pointer_token(place.key()), "the key appears twice",
                          "a key is used once in an object", k_restore);
        }
        key_ = &place.key();
        item_ = &*place;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& e) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 5: …": the part after the bracket is for
        // people
        const std::string text = e.what();
        const std::size_t bracket = text.find("] ");
        problems_.add("GC-RECORD-0011", pointer(), bracket == std::string::npos ? text : text.substr(bracket + 2),
                      "a record is one JSON value in UTF-8, byte " + std::to_string(position) + " breaks it",
                      k_restore);
        return false;
    }

private:
    Problems& problems_;
    std::vector<json*> stack_;
    std::vector<std::string> path_;
    const std::string* key_ = nullptr;  ///< of the object that is open, where the next value goes to
    json* item_ = nullptr;

    /// The key or the index that the next value goes to, behind pointer().
    [[nodiscard]] std::string here() const {
        return stack_.empty()              ? ""
               : stack_.back()->is_array() ? "/" + std::to_string(stack_.back()->size())
                                           : "/" + pointer_token(*key_);
    }

    [[nodiscard]] std::string pointer() const {
        std::string text;
        for (const std::string& token : path_) {
            text += "/" + token;
        }
        return text;
    }

    json* place(json v) {
        if (stack_.empty()) {
            root = std::move(v);
            return &root;
        }
        json& parent = *stack_.back();
        if (parent.is_array()) {
            parent.push_back(std::move(v));
            return &parent.back();
        }
        *item_ = std::move(v);
        return item_;
    }

    bool put(json v) {
        place(std::move(v));
        return true;
    }

    bool open(json v) {
        if (stack_.size() >= k_max_json_depth) {
            problems_.add("GC-RECORD-0018", pointer(),
                          "nested deeper than " + std::to_string(k_max_json_depth) + " levels",
                          "a record is at most that deep", k_restore);
            return false;
        }
        if (!stack_.empty()) {
            path_.push_back(stack_.back()->is_array() ? std::to_string(stack_.back()->size()) : pointer_token(*key_));
        }
        stack_.push_back(place(std::move(v)));
        return true;
    }

    bool close() {
        stack_.pop_back();
        if (!path_.empty()) {
            path_.pop_back();
        }
        return true;
    }
};

}  // namespace

std::string to_canonical_json(const EvaluationRecord& record) {
    if (record.rotary) {
        check_rotary(*record.rotary, [](const std::string& at, std::string what, std::string rule) {
            Writer::refuse("/rotary" + at, std::move(what), std::move(rule));
        });
    }
    const auto refuse = [](const std::string& at, std::string what, std::string rule) {
        Writer::refuse(at, std::move(what), std::move(rule));
    };
    if (record.comparison) {
        check_comparison(*record.comparison, [&](const std::string& at, std::string what, std::string rule) {
            refuse("/comparison" + at, std::move(what), std::move(rule));
        });
    }
    check_results(record, refuse);
    if (record.certificate) {
        check_certificate(*record.certificate, refuse);
    }
    Writer writer("");
    describe(writer, record);
    std::string text = with_digest(std::move(writer.object));
    if (text.size() > k_max_record_bytes) {
        Writer::refuse("", std::to_string(text.size()) + " bytes",
                       "a record has at most " + std::to_string(k_max_record_bytes) + " bytes",
                       "nothing was written; split the job into several");
    }
    return text;
}

EvaluationRecord record_from_json(const std::string& text, const std::string& where) {
    Problems problems(where);
    if (text.size() > k_max_record_bytes) {
        problems.add("GC-RECORD-0010", "", std::to_string(text.size()) + " bytes",
                     "a record has at most " + std::to_string(k_max_record_bytes) + " bytes", k_restore);
        problems.throw_if_any();
    }
    StrictParser parser(problems);
    static_cast<void>(json::sax_parse(text, &parser));
    problems.throw_if_any();

    const json& root = parser.root;
    if (!root.is_object()) {
        problems.add("GC-RECORD-0015", "", root.type_name(), "must be an object", k_restore);
        problems.throw_if_any();
    }
    const auto schema = root.find("schema");
    if (schema == root.end() || *schema != EvaluationRecord::k_schema) {
        problems.add("GC-RECORD-0020", "/schema",
                     schema == root.end()  ? "missing"
                     : schema->is_string() ? '"' + schema->get<std::string>() + '"'
                                           : schema->type_name(),
                     std::string("must be \"") + EvaluationRecord::k_schema + '"',
                     "use a release of the program that knows this schema");
        problems.throw_if_any();
    }

    EvaluationRecord record;
    Reader reader(root, "", problems);
    describe(reader, record);
    reader.finish();
    problems.throw_if_any();
    if (record.rotary && !record.rotary->machine_frame && record.rotary->axis_line.empty()) {
        // Records without a frame of the machine gave the axis in the frame of the fixture the names of location
        // errors.
        record.rotary->axis_line = std::move(record.rotary->location_errors);
        record.rotary->location_errors.clear();
    }
    const auto report = [&](const std::string& at, std::string what, std::string rule) {
        problems.add("GC-RECORD-0017", at, std::move(what), std::move(rule), k_restore);
    };
    if (record.rotary) {
        check_rotary(*record.rotary, [&](const std::string& at, std::string what, std::string rule) {
            report("/rotary" + at, std::move(what), std::move(rule));
        });
    }
    if (record.circle_closure) {
        check_closure(*record.circle_closure, [&](const std::string& at, std::string what, std::string rule) {
            report("/circle_closure" + at, std::move(what), std::move(rule));
        });
    }
    if (record.comparison) {
        check_comparison(*record.comparison, [&](const std::string& at, std::string what, std::string rule) {
            report("/comparison" + at, std::move(what), std::move(rule));
        });
    }
    if (record.kind == "comparison" && (!record.comparison || record.comparison->form == "rotary_table")) {
        report(record.comparison ? "/comparison/form" : "/comparison",
               record.comparison ? "\"rotary_table\"" : "missing",
               "a record of kind comparison holds a comparison of the form \"laboratories\" or \"methods\"");
    }
    check_results(record, report);
    if (record.certificate) {
        check_certificate(*record.certificate, report);
    }
    problems.throw_if_any();
    if (!record.digest.empty()) {
        json without = std::move(parser.root);
        without.erase(k_digest_key);
        if (const std::string own = encoding::sha256(canonical_json(without)); own != record.digest) {
            problems.add("GC-RECORD-0021", std::string("/") + k_digest_key,
                         "SHA-256 of the record is " + own + ", and it states " + record.digest,
                         "a record states the digest of its own contents: this one was changed after it was written",
                         "take the record as the program wrote it, or evaluate its job again");
            problems.throw_if_any();
        }
    }
    return record;
}

std::string with_digest(json record) {
    record.erase(k_digest_key);
    std::string text = canonical_json(record);
    const std::string member = std::string("\n \"") + k_digest_key + "\": {\n  \"algorithm\": \"" + k_digest_algorithm +
                               "\",\n  \"value\": \"" + encoding::sha256(text) + "\"\n }";
    // Put in its place among the sorted keys, for a record is large. Only a key of the outermost object stands behind
    // one blank at the beginning of a line.
    for (const auto& [key, item] : record.items()) {
        if (key > k_digest_key) {
            std::string name = canonical_json(json(key));
            name.pop_back();
            text.insert(text.find("\n " + name + ": "), member + ',');
            return text;
        }
    }
    record[k_digest_key] = {{"algorithm", k_digest_algorithm}, {"value", encoding::sha256(text)}};
    return canonical_json(record);
}

InputFile input_file(const std::string& name, const std::string& bytes, bool with_content) {
    InputFile file{.name = name, .sha256 = encoding::sha256(bytes)};
    if (with_content) {
        const bool text = text::is_utf8(bytes) && bytes.find('\0') == std::string::npos;
        file.content = text ? bytes : encoding::base64(bytes);
        file.encoding = text ? "utf-8" : "base64";
    }
    return file;
}

std::optional<std::string> bytes_of(const InputFile& file) {
    return file.encoding == "base64" && file.content ? encoding::bytes_from_base64(*file.content) : file.content;
}

}  // namespace gumcert::reports
