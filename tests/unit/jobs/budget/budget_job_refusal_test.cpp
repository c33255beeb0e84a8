#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "jobs/budget/budget_job.h"
#include "jobs/input_codes.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/campaign.h"

namespace gumcert::jobs {
namespace {

using test::budget_refusals;
using testing::HasSubstr;

/// A job with one mistake, and the one refusal that must follow.
struct BadBudget {
    std::string name;
    std::string keys;
    std::string code;
    std::string where;    ///< its beginning
    std::string message;  ///< part of it
    test::BudgetFiles files = {};
};

std::ostream& operator<<(std::ostream& stream, const BadBudget& bad) {
    return stream << bad.name;
}

std::string code(const InputCode& input_code) {
    return std::string{input_code.code};
}

/// One input X without a model.
std::string x(const std::string& statement) {
    return R"j("inputs": {"X": )j" + statement + "}";
}

/// Inputs a, b, c of 1 ± 0.1 and more keys.
std::string abc(const std::string& keys) {
    const std::string one = R"j({"value": 1, "u": 0.1})j";
    return R"j("inputs": {"a": )j" + one + R"j(, "b": )j" + one + R"j(, "c": )j" + one +
           R"j(, "K": {"value": 1, "constant": true}}, )j" + keys;
}

/// A straight line through three points with some keys in place of others.
std::string line(const std::string& keys) {
    return R"j("fits": {"f": {)j" + keys + "}}";
}

const std::vector<BadBudget>& bad_budgets() {
    const std::string at_x = "job.json#/inputs/X";
    const std::string ab = R"j("parameters": {"a": {}, "b": {}}, )j";
    const std::string straight = R"j("equation": "y = a + b*t", )j";
    const std::string three = R"j("data": {"t": [0, 1, 2], "y": [0, 1, 2]})j";
    static const std::vector<BadBudget> list{
        // ---- points and tables of results
        {"declared_column_of_an_input",
         x(R"j({"unit": "V", "u": 1})j") + R"j(, "points": {"columns": {"X": "V"}, "list": [{"X": 1}]})j",
         code(k_point_column), "job.json#/points/columns/X", "is an input and a column of points"},
        {"table_column",
         x(R"j({"unit": "V", "u": 1})j") + R"j(, "points": [{"X": 1}], "tables": [{"columns": ["X", "U", "W"]}])j",
         code(k_table_column), "job.json#/tables/0/columns/2", "is nothing that the points of this job have"},
        {"table_without_U",
         x(R"j({"unit": "V", "u": 1})j") + R"j(, "points": [{"X": 1}], "tables": [{"columns": ["X"]}])j",
         code(k_table_incomplete), "job.json#/tables/0", "shows \"X\" without U"},
        {"point_without_limit",
         x(R"j({"unit": "V", "u": 1})j") + R"j(, "points": [{"X": 1}], "certificate": {"specifications": [
             {"id": "s", "results": ["X"], "unit": "V", "rule": {"id": "DR-01"}, "limits": {"by": "points"}}]})j",
         code(k_point_without_limit), "job.json#/certificate", "the point states no limit"},
        {"angle_in_parts_in_another_unit", x(R"j({"unit": "deg", "value": "12° 30'", "u": 1})j"),
         code(k_angle_in_parts), "job.json#/inputs/X/value", "where the unit is deg"},
        {"accuracy_behind_the_open_one",
         x(R"j({"unit": "V", "u": 1})j") + R"j(, "points": {"columns": {"range": "text"}, "list": [
             {"X": 1, "range": "A"}]}, "certificate": {"specifications": [{"id": "s", "results": ["X"], "unit": "V",
             "rule": {"id": "DR-01"}, "limits": {"by": "accuracy", "accuracy": [{"constant": 1}, {"range": "A",
             "constant": 2}]}}]})j",
         code(k_limits_not_meant), "job.json#/certificate", "behind the one without a range"},
        // ---- numbers
        {"overflow", x(R"j({"value": 1e999, "u": 1})j"), code(k_json_number_range), "job.json:1:", "1e999"},
        {"underflow", x(R"j({"value": 1, "u": 1e-999})j"), code(k_json_number_range), "job.json:1:", "1e-999"},
        {"nan", x(R"j({"value": NaN, "u": 1})j"), code(k_json_not_finite), "job.json:1:", "NaN"},
        {"inexact_integer", x(R"j({"value": 9007199254740993, "u": 1})j"), code(k_json_inexact_integer),
         "job.json:1:", "9007199254740993"},
        {"value_is_text", x(R"j({"value": "1", "u": 1})j"), code(k_wrong_type), at_x + "/value (line 1, column",
         "\"1\" — must be a number — write the number without quotes"},
        {"u_negative", x(R"j({"value": 1, "unit": "mm", "u": -2})j"), code(k_number_out_of_range),
         at_x + "/u (line 1, column", "u is -2 mm — must be greater than 0 mm"},
        {"u_zero", x(R"j({"value": 1, "u": 0})j"), code(k_number_out_of_range), at_x + "/u", "\"constant\": true"},
        {"half_width_zero", x(R"j({"value": 1, "half_width": 0})j"), code(k_number_out_of_range), at_x + "/half_width",
         "must be greater than 0"},
        {"half_width_negative", x(R"j({"value": 1, "unit": "degC", "half_width": -1})j"), code(k_number_out_of_range),
         at_x + "/half_width", "-1 K"},
        {"nu_zero", x(R"j({"value": 1, "u": 1, "nu": 0})j"), code(k_number_out_of_range), at_x + "/nu",
         "must be greater than 0 — state the degrees of freedom, or \"inf\""},
        {"nu_word", x(R"j({"value": 1, "u": 1, "nu": "many"})j"), code(k_wrong_type), at_x + "/nu", "\"inf\""},
        {"k_zero", x(R"j({"value": 1, "U": 1, "k": 0})j"), code(k_number_out_of_range), at_x + "/k", "greater than 0"},
        {"p_percent", x(R"j({"value": 1, "U": 1, "p": 95})j"), code(k_number_out_of_range), at_x + "/p",
         "not a percentage"},
        {"reliability_percent", x(R"j({"value": 1, "u": 1, "reliability": 25})j"), code(k_number_out_of_range),
         at_x + "/reliability", "25 % is 0.25"},
        {"reliability_of_triangular",
         x(R"j({"value": 1, "half_width": 1, "distribution": "triangular", "reliability": 0.2})j"),
         code(k_two_statements), at_x + "/reliability", "curvilinear_trapezoid with \"d\""},
        {"nu_beside_d",
         x(R"j({"value": 1, "half_width": 1, "distribution": "curvilinear_trapezoid", "d": 0.1, "nu": 9})j"),
         code(k_two_statements), at_x + "/nu", "\"d\" says already"},
        {"nu_of_limits_too_small", x(R"j({"value": 1, "half_width": 1, "nu": 0.4})j"), code(k_number_out_of_range),
         at_x + "/nu", "are no limits"},
        {"few_samples", x(R"j({"samples": [1, 2, 3]})j"), code(k_too_few_values), at_x + "/samples",
         "are stated as \"observations\""},
        {"too_small", x(R"j({"value": 1, "u": 1e-200})j"), code(k_not_representable), at_x, "1e-200"},
        // ---- statements
        {"no_statement", x(R"j({"value": 1})j"), code(k_no_statement), at_x + " (line 1, column",
         "only \"value\" is given"},
        {"nothing", x("{}"), code(k_no_statement), at_x, "nothing is stated of it"},
        {"bare_number", x("3"), code(k_wrong_type), at_x, "{\"value\": 3, \"constant\": true}"},
        {"two_statements", x(R"j({"value": 1, "u": 1, "half_width": 2})j"), code(k_two_statements),
         at_x + "/half_width", "\"u\" and \"half_width\" are given together"},
        {"stray_key", x(R"j({"value": 1, "u": 1, "k": 2})j"), code(k_two_statements), at_x + "/k",
         "\"k\" does not belong to a statement by \"u\""},
        {"constant_with_u", x(R"j({"value": 1, "u": 1, "constant": true})j"), code(k_two_statements), at_x + "/u",
         "\"constant\" and \"u\" are given together"},
        {"bare_expanded", x(R"j({"value": 1, "U": 1})j"), code(k_incomplete_statement), at_x,
         "an expanded uncertainty without \"k\" or \"p\""},
        {"k_and_p", x(R"j({"value": 1, "U": 1, "k": 2, "p": 0.95})j"), code(k_two_statements), at_x + "/p",
         "\"k\" and \"p\""},
        {"value_missing", x(R"j({"u": 1})j"), code(k_incomplete_statement), at_x, "\"value\" is missing"},
        {"nu_and_reliability", x(R"j({"value": 1, "u": 1, "nu": 3, "reliability": 0.1})j"), code(k_two_statements),
         at_x + "/reliability", "1/(2 r²)"},
        {"unknown_key", x(R"j({"value": 1, "u": 1, "halfwidth": 2})j"), code(k_unknown_key), at_x + "/halfwidth",
         "did you mean \"half_width\"?"},
        {"duplicate_key", x(R"j({"value": 1, "u": 1, "u": 2})j"), code(k_json_duplicate_key), at_x + "/u",
         "first in line 1"},
        {"normal_half_width", x(R"j({"value": 1, "half_width": 1, "distribution": "normal"})j"),
         code(k_distribution_does_not_fit), at_x + "/distribution", "state \"u\", or \"U\""},
        {"uniform_u", x(R"j({"value": 1, "u": 1, "distribution": "uniform"})j"), code(k_distribution_does_not_fit),
         at_x + "/distribution", "state \"half_width\""},
        {"beta_missing", x(R"j({"value": 1, "half_width": 1, "distribution": "trapezoidal"})j"),
         code(k_incomplete_statement), at_x + "/distribution", "without \"beta\""},
        {"d_too_large", x(R"j({"value": 1, "half_width": 1, "distribution": "curvilinear_trapezoid", "d": 2})j"),
         code(k_number_out_of_range), at_x + "/d", "at most 1"},
        {"limits_reversed", x(R"j({"limits": [2, 1]})j"), code(k_empty_interval), at_x + "/limits", "from 2 to 1"},
        {"limits_three", x(R"j({"limits": [1, 2, 3]})j"), code(k_wrong_size), at_x + "/limits", "2 numbers"},
        {"one_observation", x(R"j({"observations": [1]})j"), code(k_too_few_values), at_x + "/observations", "1 value"},
        {"large_observations", x(R"j({"observations": [1.7e308, -1.7e308]})j"), code(k_number_out_of_range),
         at_x + "/observations", "mean or standard deviation is not finite"},
        {"large_groups", x(R"j({"groups": [[1.7e308, -1.7e308], [1, 2]]})j"), code(k_number_out_of_range),
         at_x + "/groups", "mean or standard deviation is not finite"},
        {"equal_observations", x(R"j({"observations": [1, 1, 1]})j"), code(k_no_uncertainty), at_x + "/observations",
         "all values are equal"},
        {"observation_text", x(R"j({"observations": [1, "2"]})j"), code(k_wrong_type), at_x + "/observations/1",
         "\"2\" — must be a number"},
        {"type_b_observations", x(R"j({"observations": [1, 2], "type": "B"})j"), code(k_two_statements), at_x + "/type",
         "Type A"},
        {"distribution_kind", x(R"j({"distribution": {"kind": "gaus", "mean": 0, "sd": 1}})j"), code(k_unknown_choice),
         at_x + "/distribution/kind", "must be normal, uniform"},
        {"distribution_key", x(R"j({"distribution": {"kind": "gamma", "shape": 1, "scale": 1, "sd": 2}})j"),
         code(k_unknown_key), at_x + "/distribution/sd", "kind, shape, scale or location"},
        {"relative_of_celsius", x(R"j({"value": 20, "unit": "degC", "relative_u": 0.01})j"),
         code(k_no_relative_uncertainty), at_x + "/relative_u", "state \"u\" or \"U\" in K"},
        {"relative_of_zero", x(R"j({"value": 0, "relative_u": 0.01})j"), code(k_no_uncertainty), at_x + "/relative_u",
         "value other than 0"},
        {"relative_percent", x(R"j({"value": 2, "relative_u": 5})j"), code(k_number_out_of_range), at_x + "/relative_u",
         "0.5 % is 0.005"},
        {"specification_of_unknown", x(R"j({"specification": {"percent_of_reading": 1, "of": "Y"}})j"),
         code(k_unknown_quantity), at_x + "/specification", "\"Y\", which is none of the inputs"},
        {"specification_zero", x(R"j({"value": 0, "specification": {"percent_of_reading": 1}})j"),
         code(k_no_uncertainty), at_x + "/specification", "gives 0"},
        {"specification_units",
         R"j("inputs": {"X": {"unit": "V", "specification": {"percent_of_reading": 1, "of": "Y"}},
             "Y": {"value": 1, "unit": "A", "u": 1}})j",
         code(k_unit_does_not_fit), at_x + "/specification", "\"Y\" in A"},
        {"components_and_u", x(R"j({"u": 1, "components": [{"name": "a", "u": 1}]})j"), code(k_two_statements),
         at_x + "/u", "beside \"components\""},
        {"components_and_value", x(R"j({"value": 1, "components": [{"name": "a", "u": 1}]})j"), code(k_two_statements),
         at_x + "/value", "give the components an input of their own, and add the two in the model"},
        {"component_twice", x(R"j({"components": [{"name": "a", "u": 1}, {"name": "a", "u": 1}]})j"),
         code(k_name_of_two), at_x + "/components/1/name", "a second component \"a\""},
        {"component_nested", x(R"j({"components": [{"name": "a", "u": 1, "components": []}]})j"), code(k_unknown_key),
         at_x + "/components/0/components", "not known here"},
        {"unit", x(R"j({"value": 1, "unit": "furlongs!", "u": 1})j"), "GC-UNIT-0001", at_x + "/unit (line 1, column",
         "furlongs!"},
        // ---- names
        {"name", R"j("inputs": {"a b": {"value": 1, "u": 1}})j", code(k_quantity_name), "job.json#/inputs/a b",
         "\"a b\""},
        {"function_name", R"j("inputs": {"sin": {"value": 1, "u": 1}})j", code(k_quantity_name), "job.json#/inputs/sin",
         "equation language"},
        // ---- correlations
        {"unknown_pair", abc(R"j("correlations": [["a", "bb", 0.5]])j"), code(k_unknown_quantity),
         "job.json#/correlations/0/1 (line 1", "\"bb\" is none of the inputs"},
        {"with_itself", abc(R"j("correlations": [["a", "a", 1]])j"), code(k_correlation_with_itself),
         "job.json#/correlations/0", "\"a\" with itself"},
        {"above_one", abc(R"j("correlations": [["a", "b", 1.2]])j"), code(k_number_out_of_range),
         "job.json#/correlations/0/2", "r(a, b) is 1.2"},
        {"pair_twice", abc(R"j("correlations": [["a", "b", 0.5], ["b", "a", 0.5]])j"), code(k_repeated_correlation),
         "job.json#/correlations/1", "a second time"},
        {"with_constant", abc(R"j("correlations": [["a", "K", 0.5]])j"), code(k_correlation_of_constant),
         "job.json#/correlations/0/1", "\"K\" is a constant"},
        {"not_positive", abc(R"j("correlations": [["a", "b", 0.9], ["a", "c", 0.9], ["b", "c", -0.9]])j"),
         code(k_correlation_not_positive), "job.json#/correlations/2",
         "\"a\", \"b\" and \"c\" cannot hold together: "
         "the smallest eigenvalue of their matrix is -0.8"},
        {"diagonal", abc(R"j("covariance": {"inputs": ["a", "b"], "matrix": [[0.01, 0], [0, 0.02]]})j"),
         code(k_covariance_diagonal), "job.json#/covariance/inputs/1", "0.02 in the matrix"},
        {"not_symmetric", abc(R"j("covariance": {"inputs": ["a", "b"], "matrix": [[0.01, 0.001], [0, 0.01]]})j"),
         code(k_matrix_not_symmetric), "job.json#/covariance/matrix", "0.001"},
        {"not_square", abc(R"j("covariance": {"inputs": ["a", "b"], "matrix": [[0.01, 0.001]]})j"), code(k_wrong_size),
         "job.json#/covariance/matrix", "2 rows and columns"},
        {"not_simultaneous",
         R"j("inputs": {"a": {"observations": [1, 2]}, "b": {"value": 1, "u": 1}}, "simultaneous": [["a", "b"]])j",
         code(k_not_simultaneous), "job.json#/simultaneous/0/1",
         "\"b\" is not one statement of at least 2 observations"},
        {"unequal_lengths",
         R"j("inputs": {"a": {"observations": [1, 2]}, "b": {"observations": [1, 2, 3]}}, "simultaneous": [["a", "b"]])j",
         code(k_not_simultaneous), "job.json#/simultaneous/0/1", "3 observations, and \"a\" has 2"},
        // ---- model
        {"nothing_to_evaluate", R"j("title": "t")j", code(k_nothing_to_evaluate), "job.json#", "quantity to evaluate"},
        {"equation_type", abc(R"j("model": [3])j"), code(k_wrong_type), "job.json#/model/0", "must be a string"},
        {"equation_control", abc(R"j("model": ["y = a\n+ b"])j"), code(k_equation_text), "job.json#/model/0", "U+000A"},
        {"equation_syntax", abc(R"j("model": ["y = a +"])j"), "GC-MODEL-", "job.json#/model/0", ""},
        {"unknown_symbol", abc(R"j("model": ["y = a + z"])j"), "GC-MODEL-", "job.json#/model/0", "z"},
        {"cycle", abc(R"j("model": ["y = a + z", "z = y"])j"), "GC-MODEL-", "job.json#/model/", "→"},
        {"units", R"j("model": ["y = a + b"], "inputs": {"a": {"value": 1, "unit": "mm", "u": 1},
                     "b": {"value": 1, "unit": "K", "u": 1}})j",
         "GC-MODEL-", "job.json#/model/0", "K"},
        {"output_unknown", abc(R"j("outputs": {"y": {}})j"), code(k_output_unknown), "job.json#/outputs/y", "\"y\""},
        {"output_unit", abc(R"j("outputs": {"a": {"unit": "V"}})j"), code(k_unit_does_not_fit), "job.json#/outputs/a",
         "asked for in V"},
        // ---- Monte Carlo
        {"few_trials", abc(R"j("monte_carlo": {"trials": 10})j"), code(k_too_few_trials),
         "job.json#/monte_carlo/trials", "10 trials"},
        {"gigantic_trials", abc(R"j("monte_carlo": {"trials": 1e18})j"), code(k_number_out_of_range),
         "job.json#/monte_carlo/trials", "at most 10000000000"},
        {"many_trials", abc(R"j("monte_carlo": {"trials": 2e10})j"), code(k_number_out_of_range),
         "job.json#/monte_carlo/trials", "at most 10000000000"},
        {"fraction_of_trial", abc(R"j("monte_carlo": {"trials": 10000.5})j"), code(k_not_an_integer),
         "job.json#/monte_carlo/trials", "whole number"},
        {"negative_seed", abc(R"j("monte_carlo": {"trials": 1e6, "seed": -1})j"), code(k_number_out_of_range),
         "job.json#/monte_carlo/seed", "at least 0"},
        {"trials_and_adaptive", abc(R"j("monte_carlo": {"trials": 1e6, "adaptive": {}})j"), code(k_trials_and_adaptive),
         "job.json#/monte_carlo/adaptive", "given together"},
        // ---- points
        {"point_unknown", abc(R"j("points": [{"d": 1}])j"), code(k_unknown_quantity), "job.json#/points/0/d",
         "\"d\" is none of the inputs"},
        {"point_readings_bare", abc(R"j("points": [{"a": [11.9, 12.1]}])j"), code(k_wrong_type), "job.json#/points/0/a",
         "state readings as {\"observations\": [...]}"},
        {"point_repeated", abc(R"j("points": [{"point": "P", "a": 1}, {"point": "P", "a": 2}])j"),
         code(k_repeated_point), "job.json#/points/1", "a second point \"P\""},
        {"point_negative_u", abc(R"j("points": [{"a": {"u": -1}}])j"), code(k_number_out_of_range),
         "job.json#/points/0/a/u", "u is -1"},
        {"point_of_fit",
         line(straight + ab + three) + R"j(, "inputs": {"z": {"value": 1, "u": 1}}, "points": [{"a": 1}])j",
         code(k_point_of_fit), "job.json#/points/0/a", "all points share the fits"},
        {"point_column",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_key),
         "p.csv:1:3",
         "\"uu\"",
         {{"p.csv", "a,a.uu\n1,2\n"}}},
        {"point_column_for_people",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_quantity),
         "p.csv:1:3",
         R"j("columns": {"remark": "text"})j",
         {{"p.csv", "a,remark\n1,good\n"}}},
        {"point_column_without_name",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_quantity),
         "p.csv:1:3",
         "give the column a name, or remove it",
         {{"p.csv", "a,\n1,\n"}}},
        {"point_column_with_unit",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_key),
         "p.csv:1:1",
         R"j(write "a.1", and state the unit in the job)j",
         {{"p.csv", "a.1 [V],a.2\n1,2\n"}}},
        {"point_column_of_a_quantity_with_unit",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_key),
         "p.csv:1:3",
         R"j(write "b.u", and state the unit in the job)j",
         {{"p.csv", "a,b.u (V)\n1,2\n"}}},
        {"point_column_for_people_with_brackets",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_quantity),
         "p.csv:1:3",
         R"j("columns": {"Remark (e.g. free)": "text"})j",
         {{"p.csv", "a,Remark (e.g. free)\n1,good\n"}}},
        {"point_column_of_numbers",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_quantity),
         "p.csv:1:3",
         R"j("columns": {"point [No]": "text"})j",
         {{"p.csv", "a,point [No]\n1,1\n"}}},
        {"point_column_for_people_with_dot",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_unknown_quantity),
         "p.csv:1:3",
         R"j("columns": {"Ser.no": "text"})j",
         {{"p.csv", "a,Ser.no\n1,7\n"}}},
        {"point_key_of_a_column", abc(R"j("points": [{"a.u": 1}])j"), code(k_unknown_quantity),
         "job.json#/points/0/a.u", R"j(write "a": {"u": …})j"},
        {"point_key_without_name", abc(R"j("points": [{"a": 1, "": 3}])j"), code(k_unknown_quantity),
         "job.json#/points/0/", "remove it, or name the input"},
        {"point_cell",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_csv_out_of_range),
         "p.csv:3:3",
         "u is -1",
         {{"p.csv", "a,a.u\n1,2\n1,-1\n"}}},
        {"point_cell_empty",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_empty_cell),
         "p.csv:3:3",
         "row 2 has no value in the column \"b\"",
         {{"p.csv", "a,b\n1,2\n1,\n"}}},
        {"point_cells_empty",
         R"j("inputs": {"a": {"unit": "V", "u": 0.1}}, "points": {"file": "p.csv"})j",
         code(k_empty_cell),
         "p.csv:2:3",
         "; the same in 2 more places, the last is p.csv:4:3",
         {{"p.csv", "point,a\nA,\nB,\nC,\n"}}},
        {"column_of_wrong_values",
         abc(R"j("points": {"file": "p.csv"})j"),
         code(k_two_statements),
         "p.csv:2:3",
         "; the same in 2 more places, the last is p.csv:4:3",
         {{"p.csv", "a,a.half_width\n1,2\n1,3\n1,4\n"}}},
        {"points_state_it_half",
         R"j("inputs": {"a": {"unit": "V"}}, "points": [{"a": {"value": 1, "u": 1}}, {}, {"point": "C"}])j",
         code(k_no_statement), "job.json#/inputs/a", "the points \"2\", \"C\" do not state it either"},
        {"points_complete_it_half",
         R"j("inputs": {"a": {"unit": "V", "half_width": 0.1}}, "points": [{"a": 1}, {"point": "B"}])j",
         code(k_incomplete_statement), "job.json#/inputs/a", "the points \"B\" do not state it either"},
        {"points_do_not_state_it",
         R"j("inputs": {"a": {"unit": "V"}, "b": {"value": 1, "u": 1}}, "points": [{"b": 1}])j", code(k_no_statement),
         "job.json#/inputs/a", "nothing is stated of it"},
        {"point_misses_a_reading",
         R"j("inputs": {"a": {"unit": "V"}}, "points": [{"a": {"observations": [1, null, 3]}}])j", code(k_wrong_type),
         "job.json#/points/0/a/observations/1", "must be a number"},
        // ---- digits
        {"digits_lost", x(R"j({"value": 1000000000.1, "u": 1e-9})j"), code(k_digits_lost), at_x + "/value",
         "are held to"},
        {"digits_of_readings_lost", x(R"j({"observations": [1e9, 1000000000.000001, 999999999.999999]})j"),
         code(k_digits_lost), at_x + "/observations", "are held to"},
        {"digits_in_a_table",
         R"j("inputs": {"a": {"u": 1e-9}}, "points": {"file": "p.csv"})j",
         code(k_digits_lost),
         "p.csv:3:1",
         "are held to",
         {{"p.csv", "a\n1\n1000000000.1\n"}}},
        // ---- fits
        {"fit_name", line(R"j("equation": "y = a + b*tt", )j" + ab + R"j("data": {"y": [0, 1, 2]})j"), code(k_fit_name),
         "job.json#/fits/f/equation", "\"tt\" is neither a parameter nor a column"},
        {"fit_collision", line(straight + ab + three) + R"j(, "inputs": {"a": {"value": 1, "u": 1}})j",
         code(k_name_of_two), "job.json#/fits/f/parameters/a", "\"a\" is also an input"},
        {"fit_lengths", line(straight + ab + R"j("data": {"t": [0, 1, 2], "y": [0, 1]})j"), code(k_fit_data),
         "job.json#/fits/f/data", "\"t\" has 3 values, and \"y\" has 2"},
        {"fit_few", line(straight + ab + R"j("data": {"t": [0, 1], "y": [0, 1]})j"), code(k_fit_data),
         "job.json#/fits/f/data", "2 points for 2 parameters"},
        {"fit_u_negative", line(straight + ab + R"j("data": {"t": [0, 1, 2], "y": [0, 1, 2], "u_y": [1, 1, -1]})j"),
         code(k_number_out_of_range), "job.json#/fits/f/data/u_y", "greater than 0"},
        {"fit_start", line(R"j("equation": "y = exp(a*t)", "parameters": {"a": {}}, )j" + three), code(k_fit_start),
         "job.json#/fits/f/parameters/a", "add \"start\""},
        {"fit_x_without_y", line(straight + ab + R"j("data": {"t": [0, 1, 2], "y": [0, 1, 2], "u_t": 1})j"),
         code(k_fit_uncertainty), "job.json#/fits/f/data", "\"u_y\""},
        {"fit_covariance",
         line(straight + ab + three + R"j(, "covariance": {"y": [[1, 2, 0], [2, 1, 0], [0, 0, 1]]})j"),
         code(k_covariance_not_definite), "job.json#/fits/f/covariance/y", "not positive definite"},
        {"fit_units", line(straight + ab + three + R"j(, "units": {"y": "V"})j"), "GC-MODEL-",
         "job.json#/fits/f/equation", "V"},
    };
    return list;
}

class BadBudgetTest : public testing::TestWithParam<BadBudget> {};

TEST_P(BadBudgetTest, IsRefusedWithCodePlaceAndMessage) {
    const BadBudget& bad = GetParam();
    const auto found = budget_refusals(bad.keys, bad.files);
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const auto& d) { return d.code.starts_with(bad.code); });
    ASSERT_NE(same, found.end()) << "expected " << bad.code << ", found\n" << test::texts(found);
    EXPECT_THAT(same->where, testing::StartsWith(bad.where));
    EXPECT_THAT(gum::message(*same), HasSubstr(bad.message));
    EXPECT_FALSE(same->rule.empty());
    EXPECT_FALSE(same->action.empty());
    EXPECT_THAT(gum::message(*same), testing::Not(HasSubstr("\n")));
    EXPECT_EQ(found.size(), 1U) << test::texts(found);
}

INSTANTIATE_TEST_SUITE_P(Rows, BadBudgetTest, testing::ValuesIn(bad_budgets()),
                         [](const auto& row) { return row.param.name; });

TEST(BudgetJob, EveryCodeOfBudgetJobsHasABadInput) {
    std::set<std::string> covered;
    for (const BadBudget& bad : bad_budgets()) {
        covered.insert(bad.code);
    }
    covered.insert(code(k_too_many_quantities));  // by a test of its own
    for (const InputCode& of_sections : {k_sections_of_budget, k_sections_of_other_kind, k_shared_equation}) {
        covered.insert(code(of_sections));  // budget_sections_test.cpp
    }
    for (const InputCode& input_code : k_input_codes) {
        if (input_code.code.starts_with("GC-INPUT-03")) {
            EXPECT_TRUE(covered.contains(code(input_code))) << input_code.code << " " << input_code.meaning;
        }
    }
}

TEST(BudgetJob, RefusesTooManyInputs) {
    std::string inputs;
    for (int i = 0; i < 10'001; ++i) {
        inputs += (i == 0 ? "\"x" : ",\"x") + std::to_string(i) + "\": {}";
    }
    const auto found = budget_refusals("\"inputs\": {" + inputs + "}");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, k_too_many_quantities.code);
}

TEST(BudgetJob, ReportsAllProblemsAtOnce) {
    const auto found = budget_refusals(R"j("model": ["y = a +"], "inputs": {"a": {"value": 1, "u": -1},
        "b": {"value": 1, "half_width": 0, "unit": "nonsense"}}, "correlations": [["a", "c", 2]], "coverage_probability": 95)j");
    std::multiset<std::string> codes;
    for (const auto& diagnostic : found) {
        codes.insert(diagnostic.code);
    }
    EXPECT_EQ(codes.count("GC-INPUT-0023"), 4U) << test::texts(found);
    EXPECT_EQ(codes.count("GC-UNIT-0001"), 1U);
    EXPECT_TRUE(std::any_of(codes.begin(), codes.end(), [](const auto& c) { return c.starts_with("GC-MODEL-"); }));
}

TEST(BudgetJob, AcceptsASingularMatrixOfCorrelations) {
    EXPECT_EQ(test::texts(budget_refusals(abc(R"j("correlations": [["a", "b", 1], ["a", "c", -1], ["b", "c", -1]])j"))),
              "");
}

TEST(BudgetJob, NamesFilesThatCannotBeRead) {
    EXPECT_THROW((void)test::read_budget(abc(R"j("points": {"file": "none.csv"})j")), gum::StorageError);
}

}  // namespace
}  // namespace gumcert::jobs
