#pragma once

#include <string_view>

namespace gumcert::reports {

// What the schema says of values of a record beside their descriptions. Places as add_to_schema() takes them: a place that
// the descriptions no longer have stops the program that writes the schema, and its test.

struct SentenceOfValue {
    std::string_view place;
    std::string_view sentence;
};

inline constexpr SentenceOfValue k_sentences_of_values[] = {
    {"/job/document", "the job as read"},
    {"/options", "every tolerance and option in force"},
    {"/digest", "of the canonical text of the record without this member; records of earlier releases have none"},
    {"/audit", "what the audit of the job found: schemas/audit-1.schema.json; null in records of earlier releases"},
    {"input_file/content", "the bytes of the file, as `encoding` says; null where the record does not hold them"},

    {"printed/U", "empty where the value has no uncertainty by definition"},
    {"budget_row/nu", "degrees of freedom; null: infinite"},
    {"budget_row/role",
     "fit: all parameters of a fit together; its components fit_data add up to it, fit_parameter do not; scatter: the "
     "readings of a circle closure; extremes: of a range, what is not known of which values are extreme"},
    {"budget_row/printed/share", "percent"},
    {"result/nu_eff", "null: infinite"},
    {"result/k_numerical_error", "standard uncertainty of a k that was found by draws"},
    {"result/U", "null: none can be stated, coverage is none"},
    {"reported/u", "null: the distribution has no variance"},
    {"reported/interval", "low, high; null: none can be stated"},
    {"reported/U", "where the interval is symmetric as printed"},
    {"reported/k", "U/u"},
    {"reported/against", "what speaks against the law of propagation that the job asks for all the same"},
    {"reported/printed/low", "empty where U is printed"},
    {"monte_carlo/mean", "null: the distribution has none that trials can find"},
    {"monte_carlo/u", "null: as of mean"},
    {"covariance/file", "CSV beside the record, where the matrices are left out here; else empty"},
    {"covariance/method",
     "law_of_propagation; monte_carlo where a result is reported by it: correlations of the trials beside the reported "
     "standard uncertainties"},
    {"region/nu", "null: infinite"},
    {"fit/r_squared", "null: it has no agreed meaning"},
    {"fit/consistency", "chi-square test of the stated uncertainties; empty: nothing to test"},
    {"fit_parameter/scaled_u", "u with scale_by_residuals, where the stated uncertainties are refuted"},
    {"readings/point", "empty: stated by the job itself"},
    {"readings/pooled_degrees_of_freedom", "null beside a pooled standard deviation: infinite"},
    {"readings/pooled_F",
     "F of the scatter of the readings over the pooled one, without what the steps of a display may add"},
    {"variance_analysis/point", "empty: stated by the job itself"},
    {"outlying_reading/group", "from 1; 0: no groups"},
    {"outlying_reading/position", "in its set"},

    {"station/covariance_mm2", "of the position: covariance matrix, three rows of three"},
    {"reflector/home_position_mm", "in the frame of the table, at the home angle"},
    {"reflector/covariance_mm2", "of the position: covariance matrix, three rows of three"},
    {"variance_component/stated", "what the job states, in the unit"},
    {"variance_component/degrees_of_freedom", "of the estimate"},
    {"variance_component/used", "in the weights; false: a check of the stated value only"},
    {"reliability/printed_length", "mm, as read; only of small measurements, whose annex lists the distances"},
    {"flagged_distance/found_with", "test value when it was found, and the critical value"},
    {"positioning_target/runs_up", "deviations of the single runs, in the unit of iso230_2"},
    {"iso230_2/U", "expanded uncertainties, by the same names"},
    {"group_test/tests", "of the kind, among which its level is divided"},
    {"group_test/to_angle_deg",
     "of a reflector that stands elsewhere in a part of the turn: the last angle of the part that begins "
     "at angle_deg"},
    {"group_test/estimate", "null: not determined beside the other suspicious groups"},
    {"group_test/minimal_detectable", "found with a probability of 80 %"},
    {"group_tests/alpha",
     "probability that a sound measurement makes any group of any kind suspicious, or is warned of its fixture"},
    {"group_tests/scale", "robust standard deviation of the test values of the visits"},
    {"group_tests/unexplained_p_value",
     "of the global test, or of the least probable group where variances are estimated, without the errors that are "
     "told; absent: it is 0.001 or more, or nothing is told"},
    {"reversal_model/model",
     "constant: one reversal of all angles; by_angle: one of each, and `reversal` holds their means"},
    {"reversal_model/alpha", "probability that any of the tests refutes reversals that are constant"},
    {"reversal_model/tests", "of the six error motions; empty where the distances gave no reason to test"},
    {"reversal_test/test_value", "F"},
    {"reversal_test/residual_degrees_of_freedom", "null: the variances are stated"},
    {"reversal_test/spread", "root mean square about the mean, in unit"},
    {"visit/deviation_um", "mean of the distances, observed minus predicted"},
    {"visit/limit_um", "of its magnitude"},
    {"visit/axial_arcsec", "rotation of the table beyond the adjusted curve"},
    {"environment/largest_share", "of the expansion in the variance of an error motion"},
    {"station_environment/expansion_um", "of the largest distance in the fixture, corrected"},

    {"circle_closure/full", "every position was measured, every series without a gap"},

    {"comparison/summary", "keyed by direction; `order` says in which order they are printed, \"all\" last"},

    {"certificate_certified_value/printed_u", "beside an interval; empty where no variance exists"},
};

struct RuleOfValue {
    std::string_view place;
    std::string_view keywords;  ///< JSON
};

/// What holds of one value by itself beside its description: record_check.cpp demands it, and Grubbs' test of three readings at
/// least.
inline constexpr RuleOfValue k_rules_of_values[] = {
    {"outlying_reading/n", R"({"minimum": 3})"},
    {"rotary/error_names/*", R"({"pattern": "^E[XYZABC][ABC]$"})"},
    {"station/printed/position", R"({"minItems": 3, "maxItems": 3})"},
    {"station/printed/U", R"({"minItems": 3, "maxItems": 3})"},
    {"reflector/printed/position", R"({"minItems": 3, "maxItems": 3})"},
    {"reflector/printed/U", R"({"minItems": 3, "maxItems": 3})"},
    {"reflector/printed/correction", R"({"minItems": 3, "maxItems": 3})"},
    {"reflector/printed/cmm", R"({"maxItems": 3})"},
    {"reflector/printed/U_cmm", R"({"maxItems": 3})"},
    {"comparison/correlation_given", R"({"minimum": -1.000000001, "maximum": 1.000000001})"},
    {"comparison_point/correlation", R"({"minimum": -1.000000001, "maximum": 1.000000001})"},
    {"comparison_shared_source/correlation", R"({"minimum": -1.000000001, "maximum": 1.000000001})"},
    {"comparison_youden/correlation", R"({"minimum": -1.000000001, "maximum": 1.000000001})"},
};

}  // namespace gumcert::reports
