#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "jobs/comparison/comparison_codes.h"
#include "jobs/comparison/comparison_job.h"
#include "tests/support/campaign.h"
#include "tests/support/comparison_campaign.h"

namespace gumcert::jobs {
namespace {

using test::comparison_refusals;
using test::ComparisonFiles;
using test::k_three_laboratories;
using test::k_two_methods;
using test::method_tables;
using testing::HasSubstr;

/// A job with one fault, and what is said about it.
struct BadComparison {
    std::string name;
    std::string keys;
    ComparisonFiles files;
    InputCode code;
    std::string where, what;
};

std::string ab(const std::string& a, const std::string& b = R"("value": 2, "u": 1)") {
    return R"("participants": [{"id": "A", )" + a + R"(}, {"id": "B", )" + b + "}]";
}
std::string three(const std::string& more) {
    return k_three_laboratories + ", " + more;
}
std::string amending(const std::string& amendment) {
    return three(R"("certificate": {"number": "CMP-1", "amendment": {"kind": "replaced", )" + amendment + "}}");
}
ComparisonFiles csv(const std::string& text) {
    return {{"r.csv", text}};
}
const std::string k_csv = R"("participants": {"file": "r.csv"})";
const std::string k_two_items = R"("participants": [{"id": "A"}, {"id": "B"}], "items": [{"id": "Fe"}, {"id": "Cu"}],
    "results": )";
std::string method_with(const std::string& more) {
    return k_two_methods + ", " + more;
}
ComparisonFiles tables_with(const std::string& name, const std::string& content) {
    ComparisonFiles files = method_tables();
    files[name] = content;
    return files;
}
std::string points(const std::string& first, const std::string& second = R"({"point": 1, "value": 1, "u": 1})") {
    return R"("lab": {"points": [)" + first + R"(]}, "reference": {"points": [)" + second + "]}";
}

std::vector<BadComparison> bad_of_results() {
    return {
        {"neither", R"("unit": "m")", {}, k_comparison_form, "job.json", "neither participants nor"},
        {"both", three(R"("lab": "a.csv")"), {}, k_comparison_form, "#/participants", "beside"},
        {"other_form", three(R"("tolerance": 1)"), {}, k_comparison_form, "#/tolerance", "other form"},
        {"file_and_results",
         R"("participants": {"file": "r.csv"}, "results": [])",
         {},
         k_comparison_form,
         "#/results",
         "beside a file"},
        {"bare_uncertainty",
         ab(R"("value": 1, "uncertainty": 1)") + R"(, "assigned_value": "median")",
         {},
         k_bare_uncertainty,
         "#/participants/0/uncertainty",
         "does not say which"},
        {"bare_column", k_csv, csv("participant,value,uncertainty\nA,1,1\nB,2,1\n"), k_bare_uncertainty, "r.csv:2:5",
         "does not say which"},
        {"u_and_U",
         ab(R"("value": 1, "u": 1, "U": 2, "k": 2)"),
         {},
         k_u_and_expanded_u,
         "#/participants/0/U",
         "together"},
        {"u_and_U_csv", k_csv, csv("participant,value,u,U,k\nA,1,1,2,2\nB,2,1,,\n"), k_u_and_expanded_u, "r.csv:2:7",
         "together"},
        {"u_and_k", ab(R"("value": 1, "u": 1, "k": 2)"), {}, k_u_and_expanded_u, "#/participants/0/k", "beside"},
        {"no_k", ab(R"("value": 1, "U": 2)"), {}, k_no_coverage_factor, "#/participants/0/U", "without"},
        {"only_nu",
         ab(R"("value": 1, "nu": 5)"),
         {},
         k_degrees_of_freedom_of_nothing,
         "#/participants/0/nu",
         "without"},
        {"only_nu_cell", k_csv, csv("participant,value,u,nu\nA,1,,5\nB,2,1,5\n"), k_degrees_of_freedom_of_nothing,
         "r.csv:2:6", "without"},
        {"no_U", ab(R"("value": 1, "k": 2)"), {}, k_no_coverage_factor, "#/participants/0/k", "without"},
        {"no_k_column", k_csv, csv("participant,value,U\nA,1,1\nB,2,1\n"), k_no_coverage_factor, "r.csv:2:5",
         "without a column k"},
        {"no_k_cell", k_csv, csv("participant,value,U,k\nA,1,1,\nB,2,1,2\n"), k_no_coverage_factor, "r.csv:2:5",
         "without its coverage factor"},
        {"zero_k", ab(R"("value": 1, "U": 2, "k": 0)"), {}, k_number_out_of_range, "#/participants/0/k", "0"},
        {"zero_u", ab(R"("value": 1, "u": 0)"), {}, k_number_out_of_range, "#/participants/0/u", "0"},
        {"negative_u", ab(R"("value": 1, "u": -0.1)"), {}, k_number_out_of_range, "#/participants/0/u", "-0.1"},
        {"zero_u_csv", k_csv, csv("participant,value,u\nA,1,0\nB,2,1\n"), k_csv_out_of_range, "r.csv:2:5", "0"},
        {"tiny_u", ab(R"("value": 1, "u": 1e-70)"), {}, k_not_representable, "#/participants/0/u", "beyond"},
        {"tiny_nu", ab(R"("value": 1, "u": 1, "nu": 1e-6)"), {}, k_not_representable, "#/participants/0/u", "beyond"},
        {"one",
         R"("participants": [{"id": "A", "value": 1, "u": 1}])",
         {},
         k_too_few_participants,
         "#/participants",
         "1 participant"},
        {"one_csv", k_csv, csv("participant,value,u\nA,1,1\n"), k_too_few_participants, "#/participants",
         "1 participant"},
        {"one_result",
         ab(R"("value": 1, "u": 1)", R"("name": "nothing yet")"),
         {},
         k_too_few_results,
         "#/participants",
         "1 result"},
        {"one_contributes",
         ab(R"("value": 1, "u": 1, "contributes": false, "reason": "drift")"),
         {},
         k_too_few_results,
         "#/participants",
         "1 result contributes"},
        {"repeated_participant",
         R"("participants": [{"id": "A"}, {"id": "A"}], "results": [])",
         {},
         k_repeated_id,
         "#/participants/1/id",
         "\"A\" occurs twice"},
        {"repeated_item",
         three(R"("items": [{"id": "Fe"}, {"id": "Fe"}])"),
         {},
         k_repeated_id,
         "#/items/1/id",
         "\"Fe\" occurs twice"},
        {"repeated_round", three(R"("rounds": ["1", "1"])"), {}, k_repeated_id, "#/rounds", "\"1\" occurs twice"},
        {"second_result",
         R"("participants": [{"id": "A", "value": 1, "u": 1}, {"id": "B", "value": 1, "u": 1},
            {"id": "A", "value": 2, "u": 1}])",
         {},
         k_repeated_result,
         "#/participants/2",
         "#/participants/0"},
        {"second_result_csv", k_csv, csv("participant,round,value,u\nA,1,1,1\nB,1,2,1\nA,1,3,1\n"), k_repeated_result,
         "r.csv:4:5", "r.csv:2:5"},
        {"second_result_missing", k_csv, csv("participant,value,u\nA,1,1\nB,2,1\nA,,\nC,3,1\n"), k_repeated_result,
         "r.csv:4:3", "second result"},
        {"unknown_participant",
         R"("participants": [{"id": "NMI-A"}, {"id": "NMI-B"}], "results":
            [{"participant": "NMI-AA", "value": 1, "u": 1}])",
         {},
         k_unknown_participant,
         "#/results/0/participant",
         "\"NMI-AA\" is none"},
        {"unknown_participant_csv", R"("participants": [{"id": "A"}, {"id": "B"}], "results": {"file": "r.csv"})",
         csv("participant,value,u\nA,1,1\nD,2,1\n"), k_unknown_participant, "r.csv:3:1", "\"D\" is none"},
        {"unknown_reference",
         three(R"("assigned_value": {"method": "reference", "participant": "D"})"),
         {},
         k_unknown_participant,
         "#/assigned_value",
         "\"D\" is none"},
        {"unknown_correlated",
         three(R"("correlations": [["A", "X", 0.1]])"),
         {},
         k_unknown_participant,
         "#/correlations/0/1",
         "\"X\""},
        {"unknown_item",
         k_two_items + R"([{"participant": "A", "item": "Zn", "value": 1, "u": 1}])",
         {},
         k_unknown_item,
         "#/results/0/item",
         "\"Zn\" is none"},
        {"no_item",
         k_two_items + R"([{"participant": "A", "value": 1, "u": 1}])",
         {},
         k_unknown_item,
         "#/results/0",
         "does not say of which item"},
        {"some_without_item", k_csv, csv("participant,item,value,u\nA,Fe,1,1\nB,,2,1\n"), k_unknown_item, "r.csv:3:3",
         "others do"},
        {"unknown_item_of_vector", k_csv + R"(, "vectors": [{"name": "v", "items": ["Fe", "Cu"]}])",
         csv("participant,item,value,u\nA,Cu,1,1\nB,Cu,1,1\n"), k_unknown_item, "#/vectors/0/items/0",
         "\"Fe\" is none"},
        {"unknown_item_of_youden", k_csv + R"(, "youden": [["Fe", "Cu"]])",
         csv("participant,item,value,u\nA,Cu,1,1\nB,Cu,1,1\n"), k_unknown_item, "#/youden/0/0", "\"Fe\" is none"},
        {"unknown_round",
         R"("rounds": [1, 2], "participants": [{"id": "A", "round": 3, "value": 1, "u": 1}])",
         {},
         k_unknown_round,
         "#/participants/0/round",
         "\"3\" is none"},
        {"some_without_round", k_csv, csv("participant,round,value,u\nA,1,1,1\nB,1,2,1\nB,,2,1\n"), k_unknown_round,
         "r.csv:4:3", "others do"},
        {"unknown_group", three(R"("groups": {"East": 0.2})"), {}, k_unknown_group, "#/groups/East", "\"East\""},
        {"below_limit",
         ab(R"("value": "<0.3", "u": 1)"),
         {},
         k_censored_result,
         "#/participants/0/value",
         "\"<0.3\" is a limit"},
        {"below_limit_csv", k_csv, csv("participant,value,u\nA,<0.3,0.1\nB,2,1\n"), k_censored_result, "r.csv:2:3",
         "\"<0.3\" is a limit"},
        {"above_limit_csv", k_csv, csv("participant,value,u\nA,1,0.1\nB,>5,1\n"), k_censored_result, "r.csv:3:3",
         "\">5\" is a limit"},
        {"no_reason",
         R"("participants": [{"id": "A", "value": 1, "u": 1, "contributes": false},
            {"id": "B", "value": 1, "u": 1}, {"id": "C", "value": 1, "u": 1}])",
         {},
         k_no_reason,
         "#/participants/0/contributes",
         "without a reason"},
        {"no_reason_csv", k_csv, csv("participant,value,u,contributes\nA,1,1,no\nB,2,1,\nC,2,1,yes\n"), k_no_reason,
         "r.csv:2:7", "without a reason"},
        {"reason_beside_a_value",
         R"("participants": [{"id": "A", "value": 1, "u": 1, "reason": "withdrawn"},
            {"id": "B", "value": 1, "u": 1}, {"id": "C", "value": 1, "u": 1}])",
         {},
         k_reason_of_nothing,
         "#/participants/0/reason",
         "beside a value, without \"contributes\""},
        {"reason_beside_a_value_that_is_no_part_of_a_given_value",
         R"("assigned_value": {"value": 1, "u": 1}, "participants": [
            {"id": "A", "value": 1, "u": 1, "reason": "withdrawn"}, {"id": "B", "value": 1, "u": 1}])",
         {},
         k_reason_of_nothing,
         "#/participants/0/reason",
         "beside a value, without \"contributes\""},
        {"reason_beside_a_value_csv", k_csv,
         csv("participant,value,u,contributes,reason\nA,1,1,yes,looked at\nB,2,1,,withdrawn\nC,2,1,yes,\n"),
         k_reason_of_nothing, "r.csv:3:8", "\"withdrawn\" beside a value"},
        {"another_unit", R"("unit": "mg", "participants": {"file": "r.csv"})",
         csv("participant,value,u,unit\nA,10,1,mg\nB,0.011,0.001,g\nC,9,1,\n"), k_unit_of_value, "r.csv:3:15",
         "the unit \"g\""},
        {"another_unit_of_an_item",
         R"("unit": "mg", "items": [{"id": "x", "unit": "mm"}, {"id": "y"}], "participants": {"file": "r.csv"})",
         csv("participant,item,value,u,unit\nA,x,1,1,mm\nB,x,1,1,mm\nA,y,1,1,mg\nB,y,1,1,mm\n"), k_unit_of_value,
         "r.csv:5:9", "the unit \"mm\""},
        {"no_unit_of_the_job", k_csv, csv("participant,value,u,unit\nA,10,1,\nB,11,1,mg\n"), k_unit_of_value,
         "r.csv:3:8", "the unit \"mg\""},
        {"what_is_no_unit", R"("unit": "mg", "participants": {"file": "r.csv"})",
         csv("participant,value,u,unit\nA,10,1,mg\nB,11,1,in mg\n"), k_unit_of_value, "r.csv:3:8", "\"in mg\""},
        {"celsius_for_kelvin", R"("unit": "degC", "participants": {"file": "r.csv"})",
         csv("participant,value,u,unit\nA,10,1,degC\nB,11,1,K\n"), k_unit_of_value, "r.csv:3:8", "\"K\""},
        {"unit_in_capitals", k_csv, csv("participant,value,u,Unit\nA,10,1,mg\nB,11,1,g\n"), k_column_in_capitals,
         "r.csv:1:21", "\"Unit\""},
        {"contributes_in_capitals", k_csv, csv("participant,value,u,CONTRIBUTES\nA,10,1,yes\nB,11,1,no\n"),
         k_column_in_capitals, "r.csv:1:21", "\"contributes\" is"},
        {"amends_itself",
         amending(R"("number": "CMP 1", "reason": "Two digits were exchanged.", "changes": ["value of A"])"),
         {},
         k_incomplete_amendment,
         "#/certificate/amendment",
         "has the number \"CMP 1\""},
        {"amends_nothing",
         amending(R"("number": "-", "reason": "Two digits were exchanged.", "changes": ["value of A"])"),
         {},
         k_incomplete_amendment,
         "#/certificate/amendment",
         "is not named"},
        {"amends_without_reason",
         amending(R"("number": "CMP-0", "reason": "-", "changes": ["value of A"])"),
         {},
         k_incomplete_amendment,
         "#/certificate/amendment",
         "no reason"},
        {"amends_without_changes",
         amending(R"("number": "CMP-0", "reason": "Two digits were exchanged.")"),
         {},
         k_incomplete_amendment,
         "#/certificate/amendment",
         "what has changed is not stated"},
        {"U95", k_csv, csv("participant,value,U95\nA,10,1\nB,11,1\n"), k_bare_uncertainty, "r.csv:1:19", "\"U95\""},
        {"U_with_its_factor", k_csv, csv("participant,value,U (k=2)\nA,10,1\nB,11,1\n"), k_bare_uncertainty,
         "r.csv:1:19", "which uncertainty"},
        {"uncertainty_of_others", k_csv, csv("participant,value,Unsicherheit\nA,10,1\nB,11,1\n"), k_bare_uncertainty,
         "r.csv:1:19", "which uncertainty"},
        {"two_groups", k_csv, csv("participant,item,value,u,group\nA,1,1,1,X\nB,1,1,1,X\nA,2,1,1,Y\nB,2,1,1,\n"),
         k_participant_differs, "r.csv:4:1", "before it was \"X\""},
        {"two_cmc", k_csv, csv("participant,item,value,u,cmc_U\nA,1,1,1,1\nB,1,1,1,\nA,2,1,1,2\nB,2,1,1,\n"),
         k_participant_differs, "r.csv:4:1", "before it was 1"},
    };
}

std::vector<BadComparison> bad_of_correlations() {
    return {
        {"r_above_1",
         three(R"("correlations": [["A", "B", 1.1]])"),
         {},
         k_number_out_of_range,
         "#/correlations/0/2",
         "1.1"},
        {"r_below_minus_1",
         three(R"("correlations": [["A", "B", -1.1]])"),
         {},
         k_number_out_of_range,
         "#/correlations/0/2",
         "-1.1"},
        {"with_itself",
         three(R"("correlations": [["A", "A", 0.5]])"),
         {},
         k_comparison_pair,
         "#/correlations/0",
         "with itself"},
        {"stated_twice",
         three(R"("correlations": [["A", "B", 0.5], ["B", "A", 0.4]])"),
         {},
         k_comparison_pair,
         "#/correlations/1",
         "#/correlations/0"},
        {"not_positive",
         three(R"("correlations": [["A", "B", 0.9], ["A", "C", 0.9], ["B", "C", -0.9]])"),
         {},
         k_comparison_correlations,
         "#/correlations/2",
         "\"A\", \"B\" and \"C\" cannot hold together: the smallest "
         "eigenvalue of their matrix is -0.8"},
        {"group_not_positive",
         R"("participants": [{"id": "A", "value": 1, "u": 1, "group": "G"},
            {"id": "B", "value": 1, "u": 1, "group": "G"}, {"id": "C", "value": 1, "u": 1, "group": "G"}],
            "groups": {"G": -0.6})",
         {},
         k_comparison_correlations,
         "#/groups/G",
         "smallest eigenvalue of their matrix is -0.2"},
        {"group_r",
         R"("participants": [{"id": "A", "value": 1, "u": 1, "group": "G"}, {"id": "B", "value": 1, "u": 1}],
            "groups": {"G": 2})",
         {},
         k_number_out_of_range,
         "#/groups/G",
         "2"},
        {"vector_not_positive",
         k_two_items + R"([{"participant": "A", "item": "Fe", "value": 1, "u": 1},
            {"participant": "B", "item": "Fe", "value": 1, "u": 1}, {"participant": "A", "item": "Cu", "value": 1, "u": 1},
            {"participant": "B", "item": "Cu", "value": 1, "u": 1}],
            "vectors": [{"name": "v", "items": ["Fe", "Cu"], "correlation": [[1, 2], [2, 1]]}])",
         {},
         k_correlation_matrix,
         "#/vectors/0/correlation",
         "2 in one place"},
        {"vector_covariance",
         k_two_items + R"([{"participant": "A", "item": "Fe", "value": 1, "u": 1},
            {"participant": "B", "item": "Fe", "value": 1, "u": 1}, {"participant": "A", "item": "Cu", "value": 1, "u": 1},
            {"participant": "B", "item": "Cu", "value": 1, "u": 1}],
            "vectors": [{"name": "v", "items": ["Fe", "Cu"], "reference_correlation": [[4, 0], [0, 4]]}])",
         {},
         k_correlation_matrix,
         "#/vectors/0/reference_correlation",
         "with itself is 4"},
        {"parts",
         ab(R"("value": 1, "u": 0.1, "sources": [{"source": "S", "u": 0.2}])"),
         {},
         k_parts_exceed_uncertainty,
         "#/participants/0/sources",
         "add up to 0.2"},
        {"parts_of_nothing",
         ab(R"("value": 1, "sources": [{"source": "S", "u": 0.2}])") + R"(, "assigned_value": "median")",
         {},
         k_parts_exceed_uncertainty,
         "#/participants/0/sources",
         "not stated"},
        {"source_twice",
         ab(R"("value": 1, "u": 1, "sources": [{"source": "S", "u": 0.2}, {"source": "S", "u": 0.1}])"),
         {},
         k_repeated_source,
         "#/participants/0/sources/1/source",
         "\"S\" occurs twice"},
    };
}

std::vector<BadComparison> bad_of_assigned_values() {
    return {
        {"reference_alone",
         three(R"("assigned_value": "reference")"),
         {},
         k_assigned_value_incomplete,
         "#/assigned_value",
         "without its participant"},
        {"reference_without",
         three(R"("assigned_value": {"method": "reference"})"),
         {},
         k_assigned_value_incomplete,
         "#/assigned_value",
         "without its participant"},
        {"given_alone",
         three(R"("assigned_value": "given")"),
         {},
         k_assigned_value_incomplete,
         "#/assigned_value",
         "without the value"},
        {"empty_object",
         three(R"("assigned_value": {"traceability": "none"})"),
         {},
         k_assigned_value_incomplete,
         "#/assigned_value",
         "without \"method\" or \"value\""},
        {"number", three(R"("assigned_value": 0.044)"), {}, k_wrong_type, "#/assigned_value", "0.044"},
        {"reference_has_none",
         ab(R"("value": 1)") + R"(, "assigned_value": {"method": "reference", "participant": "A"})",
         {},
         k_reference_without_result,
         "#/assigned_value",
         "\"A\" has no result with an uncertainty"},
        {"no_weights",
         ab(R"("value": 1)"),
         {},
         k_result_without_uncertainty,
         "#/participants/0",
         "no uncertainty is stated by \"A\", and the assigned value is \"mandel_paule\""},
        {"no_weights_csv", k_csv + R"(, "assigned_value": "mandel_paule")",
         csv("participant,value,u\nA,1,1\nB,1,\nC,2,\n"), k_result_without_uncertainty, "r.csv:3:3",
         "no uncertainty is stated by \"B\", \"C\""},
        {"trials_without_u",
         ab(R"("value": 1)") + R"(, "assigned_value": {"method": "median", "uncertainty": "trials"})",
         {},
         k_result_without_uncertainty,
         "#/participants/0",
         "no uncertainty is stated by \"A\""},
        {"no_replicates",
         three(R"("assigned_value": "vangel_rukhin")"),
         {},
         k_result_without_replicates,
         "#/participants/0",
         "no s above 0"},
        {"s_without_n",
         ab(R"("value": 1, "u": 1, "s": 1)"),
         {},
         k_result_without_replicates,
         "#/participants/0/s",
         "without \"n\""},
        {"n_without_s_csv", k_csv, csv("participant,value,u,n\nA,1,1,3\nB,2,1,\n"), k_result_without_replicates,
         "r.csv:2:7", "n without s"},
        {"zero_sigma", three(R"("sigma_pt": 0)"), {}, k_number_out_of_range, "#/sigma_pt", "0"},
        {"negative_sigma", three(R"("sigma_pt": -1)"), {}, k_number_out_of_range, "#/sigma_pt", "-1"},
        {"two_sigmas",
         three(R"("sigma_pt": {"percent": 5, "mass_fraction_per_unit": 1e-6})"),
         {},
         k_sigma_pt,
         "#/sigma_pt",
         "several statements"},
        {"no_sigma", three(R"("sigma_pt": {})"), {}, k_sigma_pt, "#/sigma_pt", "no statement"},
        {"r_above_R",
         three(R"("sigma_pt": {"reproducibility": 1, "repeatability": 2})"),
         {},
         k_sigma_pt,
         "#/sigma_pt/repeatability",
         "larger than the reproducibility"},
        {"zero_delta", three(R"("delta_E": 0)"), {}, k_number_out_of_range, "#/delta_E", "0"},
        {"ragged",
         three(R"("homogeneity": [[1, 2], [1, 2, 3]])"),
         {},
         k_ragged_replicates,
         "#/homogeneity/1",
         "3 numbers, and the first one has 2"},
        {"alpha_of_a_subset",
         three(R"("assigned_value": {"method": "largest_consistent_subset", "alpha": 0.31})"),
         {},
         k_number_out_of_range,
         "#/assigned_value/alpha",
         "0.31"},
        {"trials_of_a_median",
         three(R"("assigned_value": {"method": "median", "uncertainty": "trials", "trials": 10000001})"),
         {},
         k_number_out_of_range,
         "#/assigned_value/trials",
         "10000001"},
        {"percent_of_nothing",
         three(R"("sigma_pt": {"percent": 1e-300})"),
         {},
         k_number_out_of_range,
         "#/sigma_pt/percent",
         "1e-300"},
        {"mass_fraction_of_nothing",
         three(R"("sigma_pt": {"mass_fraction_per_unit": 1e-300})"),
         {},
         k_number_out_of_range,
         "#/sigma_pt/mass_fraction_per_unit",
         "1e-300"},
        {"reproducibility_of_nothing",
         three(R"("sigma_pt": {"reproducibility": 1e-300, "repeatability": 0})"),
         {},
         k_number_out_of_range,
         "#/sigma_pt/reproducibility",
         "1e-300"},
        {"homogeneity_against_nothing",
         three(R"("homogeneity": [[1, 2], [1, 3]])"),
         {},
         k_check_without_criterion,
         "#/homogeneity",
         "neither sigma_pt nor delta_E"},
        {"stability_alone",
         three(R"("sigma_pt": 1, "stability": [[1, 2], [1, 3]])"),
         {},
         k_check_without_criterion,
         "#/stability",
         "without homogeneity"},
        {"stability_alone_of_an_item",
         k_two_items + R"([{"participant": "A", "item": "Fe", "value": 1, "u": 1}, {"participant": "B", "item": "Fe",
           "value": 1, "u": 1}, {"participant": "A", "item": "Cu", "value": 1, "u": 1}, {"participant": "B",
           "item": "Cu", "value": 1, "u": 1}], "sigma_pt": 1, "stability": [[1, 2]])",
         {},
         k_check_without_criterion,
         "job.json#/stability",
         "without homogeneity"},
        {"one_item_to_check", three(R"("homogeneity": [[1, 2]])"), {}, k_wrong_size, "#/homogeneity", "1 row"},
        {"reference_value_without_u",
         three(R"("reference_value": {"value": 3})"),
         {},
         k_assigned_value_incomplete,
         "#/reference_value",
         "without uncertainty"},
    };
}

std::vector<BadComparison> bad_of_methods() {
    return {
        {"points_empty",
         R"("lab": {"points": []}, "reference": {"points": [{"point": 1, "value": 1, "u": 1}]})",
         {},
         k_wrong_size,
         "#/lab/points",
         "empty list"},
        {"direction_all",
         points(R"({"point": 1, "direction": "all", "value": 1, "u": 1})",
                R"({"point": 1, "direction": "all", "value": 1, "u": 1})"),
         {},
         k_reserved_direction,
         "#/lab/points/0",
         "direction \"all\""},
        {"variance_of_infinity",
         R"("lab": {"points": [{"point": 1, "value": 1}], "covariance": "c.csv"},
            "reference": {"points": [{"point": 1, "value": 1, "u": 1}]})",
         {{"c.csv", "1e300\n"}},
         k_number_out_of_range,
         "c.csv",
         "1e+300"},
        {"reference_only", R"("reference": "reference.csv")", method_tables(), k_missing_key, "job.json", "\"lab\""},
        {"points_differ", k_two_methods,
         tables_with("reference.csv", "point,direction,value,u\nP1,x,1,1\nP2,x,1,1\nP2,y,1,1\n"), k_points_differ,
         "lab.csv:3:1", "the point \"P1 y\" has no counterpart on the side of the reference"},
        {"position_differs",
         points(R"({"point": 1, "position": 10, "value": 1, "u": 1})",
                R"({"point": 1, "position": 11, "value": 1, "u": 1})"),
         {},
         k_points_differ,
         "#/reference/points/0",
         "is at 11"},
        {"repeated_point",
         points(R"({"point": 1, "value": 1, "u": 1}, {"point": 1, "value": 1, "u": 1})"),
         {},
         k_repeated_comparison_point,
         "#/lab/points/1",
         "#/lab/points/0"},
        {"u_common",
         points(R"({"point": 1, "value": 1, "u": 1, "u_common": 1.5})"),
         {},
         k_parts_exceed_uncertainty,
         "#/lab/points/0",
         "u_common is 1.5, and u of the point is 1"},
        {"point_without_u",
         points(R"({"point": 1, "value": 1})"),
         {},
         k_bare_uncertainty,
         "#/lab/points/0",
         "has no uncertainty"},
        {"r_of_methods", method_with(R"("correlation": 1.5)"), method_tables(), k_number_out_of_range, "#/correlation",
         "1.5"},
        {"no_budgets", method_with(R"("correlation": "shared_sources")"), method_tables(), k_no_shared_sources,
         "#/correlation", "not both sides"},
        {"no_position",
         points(R"({"point": 1, "value": 1, "u": 1})") + R"(, "bias_line": "position")",
         {},
         k_no_position,
         "#/bias_line",
         "\"1\" has no position"},
        {"asymmetric", R"("lab": {"points": "lab.csv", "covariance": "v.csv"}, "reference": "reference.csv")",
         tables_with("v.csv", "0.25,0.1,0,0\n0.2,0.25,0,0\n0,0,0.25,0\n0,0,0,0.25\n"),
         k_comparison_covariance_asymmetric, "v.csv", "\"P1 y\" and \"P1 x\" is 0.2 in one place and 0.1"},
        {"not_psd", R"("lab": {"points": "lab.csv", "covariance": "v.csv"}, "reference": "reference.csv")",
         tables_with("v.csv", "0.25,0.24,-0.24,0\n0.24,0.25,0.24,0\n-0.24,0.24,0.25,0\n0,0,0,0.25\n"),
         k_comparison_covariance, "v.csv", "\"P1 x\", \"P1 y\" and \"P2 x\" cannot hold together"},
        {"diagonal", R"("lab": {"points": "lab.csv", "covariance": "v.csv"}, "reference": "reference.csv")",
         tables_with("v.csv", "0.5,0,0,0\n0,0.5,0,0\n0,0,0.5,0\n0,0,0,0.5\n"), k_comparison_covariance_diagonal,
         "v.csv", "the variance of the point \"P1 x\" is 0.5, and u² of the point is 0.25"},
        {"covariance_and_common",
         R"("lab": "lab.csv", "reference": {"points": "reference.csv", "covariance": "v.csv"})",
         tables_with("v.csv", "0.04,0,0,0\n0,0.04,0,0\n0,0,0.04,0\n0,0,0,0.04\n"), k_stated_beside_budget,
         "reference.csv:2:16", "u_common beside a covariance"},
        {"of_without_job", R"("lab": {"points": "lab.csv", "of": "table"}, "reference": "reference.csv")",
         tables_with("v.csv", "1\n"), k_compared_job, "#/lab/of", "\"of\" without \"job\""},
        {"value_beside_budget",
         R"("participants": [{"id": "A", "value": 1, "budget": "b.json"},
            {"id": "B", "value": 1, "u": 1}], "unit": "um")",
         {{"b.json", test::point_budget("")}},
         k_stated_beside_budget,
         "#/participants/0/value",
         "beside a budget"},
        {"budget_of_points",
         R"("participants": [{"id": "A", "budget": "b.json"}, {"id": "B", "value": 1, "u": 1}],
            "unit": "um")",
         {{"b.json", test::point_budget()}},
         k_comparison_budget,
         "#/participants/0/budget",
         "2 points"},
        {"budget_of_other_unit",
         R"("participants": [{"id": "A", "budget": "b.json"}, {"id": "B", "value": 1, "u": 1}],
            "unit": "kg")",
         {{"b.json", test::point_budget("")}},
         k_comparison_budget,
         "#/participants/0/budget",
         "has the unit \"um\""},
        {"point_not_in_budget",
         R"("unit": "um", "lab": {"budget": "b.json", "points": [{"point": "P3"}]},
            "reference": {"points": [{"point": "P3", "value": 1, "u": 1}]})",
         {{"b.json", test::point_budget()}},
         k_comparison_budget,
         "#/lab",
         "has no point \"P3\""},
        {"points_of_another_unit", k_two_methods,
         tables_with("reference.csv",
                     "point,direction,value,u,unit\nP2,y,4.1,0.4,um\nP2,x,3.1,0.4,um\n"
                     "P1,y,0.0021,0.0004,mm\nP1,x,1.1,0.4,um\n"),
         k_unit_of_value, "reference.csv:4:20", "the unit \"mm\""},
        // What is wrong with a budget, or with the unit, is told once and not again with every point.
        {"points_of_unreadable_budget",
         R"("lab": {"budget": "b.json", "points": [{"point": "P1"}, {"point": "P2"}]}, "reference": "reference.csv")",
         {{"b.json", "{]"}, {"reference.csv", "point,value,u\nP1,1,1\nP2,1,1\n"}},
         k_json_syntax,
         "b.json",
         ""},
        {"table_of_unreadable_budget",
         R"("lab": {"budget": "b.json", "points": "lab.csv"}, "reference": "reference.csv")",
         {{"b.json", "{]"},
          {"lab.csv", "point,position\nP1,1\nP2,2\n"},
          {"reference.csv", "point,value,u\nP1,1,1\nP2,1,1\n"}},
         k_json_syntax,
         "b.json",
         ""},
        {"budget_and_unknown_unit",
         R"("unit": 3, "lab": {"budget": "b.json"}, "reference": "reference.csv")",
         {{"b.json", test::point_budget()}, {"reference.csv", "point,value,u\nP1,1,1\nP2,1,1\n"}},
         k_wrong_type,
         "#/unit",
         "3"},
        {"result_budget_and_unknown_unit",
         R"("unit": 3, "participants": [{"id": "A", "budget": "b.json"}, {"id": "B", "value": 1, "u": 1}])",
         {{"b.json", test::point_budget("[]")}},
         k_wrong_type,
         "#/unit",
         "3"},
        {"table_without_uncertainties", k_two_methods,
         tables_with("lab.csv", "point,direction,value\nP1,x,1\nP1,y,1\n"), k_bare_uncertainty, "lab.csv:2:1",
         "a table without uncertainties"},
        {"audited_factor_too_small",
         R"("lab": {"points": "lab.csv", "audited": {"factor": 1e-200, "finding": "f"}}, "reference": "reference.csv")",
         method_tables(), k_number_out_of_range, "#/lab/audited/factor", "1e-200"},
    };
}

std::vector<BadComparison> bad_comparisons() {
    std::vector<BadComparison> all;
    for (auto part : {bad_of_results(), bad_of_correlations(), bad_of_assigned_values(), bad_of_methods()}) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

class BadComparisonTest : public testing::TestWithParam<BadComparison> {};

TEST_P(BadComparisonTest, IsRefusedOnceWithPlaceCodeAndCure) {
    const BadComparison& bad = GetParam();
    const auto found = comparison_refusals(bad.keys, bad.files);
    const auto same = std::find_if(found.begin(), found.end(), [&](const auto& diagnostic) {
        return diagnostic.code == bad.code.code && diagnostic.where.find(bad.where) != std::string::npos &&
               diagnostic.what.find(bad.what) != std::string::npos;
    });
    ASSERT_NE(same, found.end()) << "found:\n" << test::texts(found);
    EXPECT_FALSE(same->rule.empty());
    EXPECT_FALSE(same->action.empty());
    EXPECT_THAT(gum::message(*same), testing::Not(HasSubstr("\n")));
    EXPECT_EQ(found.size(), 1U) << test::texts(found);
}

INSTANTIATE_TEST_SUITE_P(Rows, BadComparisonTest, testing::ValuesIn(bad_comparisons()),
                         [](const auto& row) { return row.param.name; });

TEST(ComparisonJob, EveryCodeHasABadInput) {
    std::set<std::string_view> covered{k_too_many_correlated.code, k_too_many_results.code};  // by tests of their own
    for (const BadComparison& bad : bad_comparisons()) {
        covered.insert(bad.code.code);
    }
    std::string_view last;
    std::set<std::string_view> of_others;
    for (const InputCode& code : k_input_codes) {
        of_others.insert(code.code);
    }
    for (const InputCode& code : k_comparison_codes) {
        EXPECT_LT(last, code.code);
        EXPECT_FALSE(of_others.contains(code.code)) << code.code;
        EXPECT_FALSE(code.meaning.empty());
        EXPECT_TRUE(code.code.starts_with("GC-WARN-00") || covered.contains(code.code))
            << code.code << " " << code.meaning;
        last = code.code;
    }
}

TEST(ComparisonJob, RefusesAMatrixThatIsTooLarge) {
    std::string participants, pairs;
    for (int i = 0; i < 2001; ++i) {
        const std::string id = std::to_string(i);
        participants += (i == 0 ? "" : ",") + (R"({"id": )" + id) + R"(, "value": 1, "u": 1})";
        pairs += i == 0 ? "" : (i == 1 ? "" : ",") + ("[0, " + id) + ", 0.001]";
    }
    const auto found =
        comparison_refusals("\"participants\": [" + participants + "], \"correlations\": [" + pairs + "]");
    ASSERT_EQ(found.size(), 1U) << test::texts(found);
    EXPECT_EQ(found[0].code, k_too_many_correlated.code);
}

// A record holds so many results; more of them were evaluated for half a minute, and then nothing could be written.
TEST(ComparisonJob, RefusesMoreResultsThanARecordHolds) {
    std::string table = "participant,value,u\n", array;
    for (int i = 0; i < 25'001; ++i) {
        const std::string id = std::to_string(i);
        table += id + ",1,1\n";
        array += (i == 0 ? "" : ",") + (R"({"id": )" + id) + R"(, "value": 1, "u": 1})";
    }
    auto found = comparison_refusals(k_csv, csv(table));
    ASSERT_EQ(found.size(), 1U) << test::texts(found);
    EXPECT_EQ(found[0].code, k_too_many_results.code);
    EXPECT_EQ(found[0].where, "r.csv");
    found = comparison_refusals("\"participants\": [" + array + "]");
    ASSERT_EQ(found.size(), 1U) << test::texts(found);
    EXPECT_EQ(found[0].code, k_too_many_results.code);
    EXPECT_THAT(found[0].where, HasSubstr("#/participants"));
}

TEST(ComparisonJob, ARecordThatIsTakenForAJobIsToldOnce) {
    const std::string record =
        R"({"schema": "gumcert/record/1", "kind": "comparison", "audit": null, "comparison": {}, "certificate": null})";
    try {
        (void)read_comparison_job(MemoryFileSource({{"job.json", record}}), "job.json");
        FAIL() << "accepted";
    } catch (const gum::InputError& error) {
        ASSERT_EQ(error.diagnostics().size(), 1U) << test::texts(error.diagnostics());
        EXPECT_EQ(error.diagnostics()[0].code, k_wrong_schema.code);
    }
}

// What people write where they have no value, and what they are told to write.
TEST(ComparisonJob, SaysHowAMissingResultIsReported) {
    for (const std::string word : {"NA", "n/a", "-", "nan", "ND", "<0.3", "> 5"}) {
        auto found = comparison_refusals(k_csv, csv("participant,value,u\nA,1,1\nB,2,1\nC," + word + ",1\n"));
        ASSERT_EQ(found.size(), 1U) << word << test::texts(found);
        EXPECT_EQ(found[0].where, "r.csv:4:3");
        EXPECT_THAT(found[0].action, HasSubstr("leave the cell empty: a missing result")) << word;
        found = comparison_refusals(ab(R"("value": ")" + word + R"(", "u": 1)"));
        ASSERT_EQ(found.size(), 1U) << word << test::texts(found);
        EXPECT_THAT(found[0].where, HasSubstr("#/participants/0/value"));
        EXPECT_THAT(found[0].action, HasSubstr("write null: a missing result")) << word;
        // A point of two methods has both values.
        found = comparison_refusals(k_two_methods,
                                    tables_with("lab.csv", "point,direction,value,u\nP1,x," + word + ",1\n"));
        ASSERT_EQ(found.size(), 1U) << word << test::texts(found);
        EXPECT_THAT(found[0].action, HasSubstr("remove the point from both sides")) << word;
    }
}

TEST(ComparisonJob, ReportsAllProblemsAtOnce) {
    const auto found = comparison_refusals(R"j("participants": {"file": "r.csv"}, "sigma_pt": 0, "delta_E": -1,
        "correlations": [["A", "B", 3]], "homogeneity": [[1, 2], [3]], "unit": "nonsense")j",
                                           {{"r.csv", "participant,value,u\nA,<3,1\nB,2,0\nB,3,1\n"}});
    std::vector<std::string> codes;
    for (const auto& diagnostic : found) {
        codes.push_back(diagnostic.code);
    }
    EXPECT_THAT(codes, testing::UnorderedElementsAre(
                           "GC-INPUT-0023", "GC-INPUT-0023", "GC-INPUT-0023", std::string(k_wrong_size.code),
                           "GC-UNIT-0001", std::string(k_censored_result.code), std::string(k_csv_out_of_range.code),
                           std::string(k_repeated_result.code)))
        << test::texts(found);
}

}  // namespace
}  // namespace gumcert::jobs
