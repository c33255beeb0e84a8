#include "jobs/rotary_table/rotary_table_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <set>
#include <sstream>

#include "jobs/budget/budget_job.h"
#include "jobs/input_codes.h"
#include "tests/support/campaign.h"
#include "text/numbers.h"

namespace gumcert::jobs {
namespace {

using test::Files;
using test::lengths_line;
using test::read;
using test::refusals;
using test::replace;
using test::replace_all;
using test::replace_line;
using test::small_campaign;
using test::small_layout;
using test::texts;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// One kind of bad input: how to spoil the small campaign, and the one refusal that must follow.
struct BadInput {
    std::string name;
    std::function<void(Files&)> spoil;
    InputCode code;
    std::string where;
    std::string message;  ///< part of it, across "what — rule — action"
};

std::ostream& operator<<(std::ostream& stream, const BadInput& bad) {
    return stream << bad.name;
}

/// Replaces text in one file.
std::function<void(Files&)> with(const std::string& file, const std::string& old_text, const std::string& new_text) {
    return [=](Files& files) { replace(files.at(file), old_text, new_text); };
}

std::function<void(Files&)> with_line(const std::string& file, std::size_t line, const std::string& new_text) {
    return [=](Files& files) { replace_line(files.at(file), line, new_text); };
}

std::function<void(Files&)> with_content(const std::string& file, const std::string& content) {
    return [=](Files& files) { files[file] = content; };
}

/// The lengths of the small campaign with fewer decimals.
std::string rounded_lengths(const std::string& lengths, std::size_t decimals) {
    std::istringstream lines(lengths);
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        if (!text.empty()) {
            const std::size_t point = line.find('.', line.find(".0,") + 1);
            line.erase(point + 1 + decimals, line.find(',', point) - point - 1 - decimals);
        }
        text += line + "\n";
    }
    return text;
}

/// A frame of the machine by its points, and other keys beside it.
std::function<void(Files&)> with_machine(const std::string& points, const std::string& keys = {},
                                         const std::string& by = "probing") {
    return [=](Files& files) {
        files["machine.csv"] = points;
        replace(files.at("job.json"), "{",
                "{ \"machine_frame\": {\"by\": \"" + by +
                    "\", \"coordinates\": \"machine.csv\", \"nominal_point_mm\": [0, 0, 0]}, " + keys);
    };
}

/// Adds keys at the top of the job; they stand in line 1.
std::function<void(Files&)> with_key(const std::string& keys) {
    return [=](Files& files) { replace(files.at("job.json"), "{", "{ " + keys + ","); };
}

std::string covariance(std::size_t order, const std::function<double(std::size_t, std::size_t)>& element) {
    std::ostringstream text;
    for (std::size_t i = 0; i < order; ++i) {
        for (std::size_t j = 0; j < order; ++j) {
            text << (j == 0 ? "" : ",") << element(i, j);
        }
        text << '\n';
    }
    return text.str();
}

/// The small campaign with a covariance file.
std::function<void(Files&)> with_covariance(const std::function<double(std::size_t, std::size_t)>& element) {
    return [=](Files& files) {
        replace(files.at("job.json"), "\"coordinates\": \"fixture.csv\",",
                "\"coordinates\": \"fixture.csv\", \"covariance\": \"covariance.csv\",");
        files["covariance.csv"] = covariance(12, element);
    };
}

/// Writes every angle of the lengths as f(angle); the dial indicator follows.
void change_angles(Files& files, const std::function<std::string(int)>& f) {
    for (int angle = 0; angle < 360; angle += 45) {
        replace_all(files.at("lengths.csv"), "," + std::to_string(angle) + ".0,", ",@" + std::to_string(angle) + ",");
    }
    for (int angle = 0; angle < 360; angle += 45) {
        replace_all(files.at("lengths.csv"), ",@" + std::to_string(angle) + ",", "," + f(angle) + ",");
    }
    files["dial_indicator.csv"] = "direction,angle_deg,run,reading_um\nx," + f(0) + ",1,3.2\n";
}

std::string row_text(const std::string& station, const std::string& reflector, const std::string& pass,
                     const std::string& direction, const std::string& angle, const std::string& length,
                     const std::string& dead_path) {
    return station + "," + reflector + "," + pass + "," + direction + "," + angle + "," + length + "," + dead_path;
}

void with_fixture_budget(Files& files) {
    replace(files.at("job.json"), "\"coordinates\"", "\"budget\": \"fixture_budget.json\", \"coordinates\"");
    files["fixture_budget.json"] = test::small_fixture_budget();
    files["fixture_points.csv"] = test::small_fixture_points();
}

const std::vector<BadInput>& bad_inputs() {
    static const std::vector<BadInput> list{
        // ---- the job file
        {"schema", with("job.json", "gumcert/job/1", "gumcert/job/2"), k_wrong_schema,
         "job.json#/schema (line 2, column 13)", "\"gumcert/job/2\" — must be \"gumcert/job/1\""},
        {"schema_missing", with("job.json", "\"schema\": \"gumcert/job/1\",", ""), k_missing_key,
         "job.json# (line 1, column 1)", "\"schema\" is missing"},
        {"kind_unknown", with("job.json", "rotary_table", "rotary-table"), k_wrong_kind,
         "job.json#/kind (line 3, column 11)", "did you mean \"rotary_table\"?"},
        {"kind_budget", with("job.json", "rotary_table", "budget"), k_wrong_kind, "job.json#/kind (line 3, column 11)",
         "a job of kind \"rotary_table\" is expected here"},
        {"kind_comparison", with("job.json", "rotary_table", "comparison"), k_wrong_kind,
         "job.json#/kind (line 3, column 11)", "a job of kind \"rotary_table\" is expected here"},
        {"job_truncated", [](Files& files) { files["job.json"].resize(100); }, k_json_syntax, "job.json:5:15",
         "the file ends"},
        {"unknown_key", with("job.json", "\"title\"", "\"titel\""), k_unknown_key,
         "job.json#/titel (line 4, column 12)", "did you mean \"title\"?"},
        {"duplicate_key", with_key("\"title\": \"a\""), k_json_duplicate_key, "job.json#/title (line 4, column 3)",
         "first in line 1"},
        {"title_bidi", with("job.json", "Small", "Small\\u202e"), k_text_not_allowed,
         "job.json#/title (line 4, column 12)", "U+202E"},
        {"axis_missing", with("job.json", "\"axis\": \"A\",", ""), k_missing_key, "job.json# (line 1, column 1)",
         "\"axis\" is missing"},
        {"axis_unknown", with("job.json", "\"axis\": \"A\"", "\"axis\": \"X\""), k_unknown_choice,
         "job.json#/axis (line 5, column 11)", "\"X\" — must be A, B or C"},
        {"datum", with_key("\"datum\": \"axis\""), k_unknown_choice, "job.json#/datum (line 1, column 12)",
         "must be axis_average_line or home"},
        {"method", with_key("\"method\": \"both\""), k_unknown_choice, "job.json#/method (line 1, column 13)",
         "must be joint or sequential"},
        {"coverage_percent", with_key("\"coverage_probability\": 95.45"), k_number_out_of_range,
         "job.json#/coverage_probability (line 1, column 27)",
         "must be at least 0.1 and at most 0.999999999 — state a probability, not a percentage"},
        {"coverage_one", with_key("\"coverage_probability\": 1"), k_number_out_of_range,
         "job.json#/coverage_probability (line 1, column 27)", "at most 0.999999999"},
        {"coverage_zero", with_key("\"coverage_probability\": 0"), k_number_out_of_range,
         "job.json#/coverage_probability (line 1, column 27)", "at least 0.1"},
        {"few_trials", with_key("\"monte_carlo\": {\"trials\": 10}"), k_too_few_trials,
         "job.json#/monte_carlo/trials (line 1, column 29)", "needs at least 100/(1 - p) = 2198 trials"},
        {"monte_carlo_key", with_key("\"monte_carlo\": {\"trails\": 10}"), k_unknown_key,
         "job.json#/monte_carlo/trails (line 1, column 29)", "did you mean \"trials\"?"},
        {"resolution", with("job.json", "0.05", "0.05, \"resolution_um\": -0.1"), k_number_out_of_range,
         "job.json#/length_uncertainty/resolution_um (line 7, column 67)", "-0.1 µm"},
        {"shape_of_temperature",
         with("job.json", "\"lengths\":", "\"temperature_distribution\": \"flat\", \"lengths\":"), k_unknown_choice,
         "job.json#/observations/temperature_distribution (line 6, column 49)", "must be normal or uniform"},
        {"fixture_budget_and_covariance",
         [](Files& files) {
             with_covariance([](std::size_t i, std::size_t j) { return i != j ? 0.0 : i == 1 ? 0.25 : 0.16; })(files);
             with_fixture_budget(files);
         },
         k_fixture_keys_exclude, "job.json#/fixture/budget (line 9, column 15)",
         "\"budget\" is given beside \"covariance\""},
        {"source_paper_and_uniform",
         with("job.json", "\"coordinates\"",
              "\"uncertainty\": \"source_paper\", \"distribution\": \"uniform\", \"coordinates\""),
         k_fixture_keys_exclude, "job.json#/fixture/distribution (line 9, column 52)",
         "uniform distribution belongs to"},
        {"fixture_budget_without_point",
         [](Files& files) {
             with_fixture_budget(files);
             replace(files.at("fixture_points.csv"), "R2.y,28.25\n", "");
         },
         k_fixture_budget_points, "fixture_budget.json#/points", "the coordinate \"R2.y\" has no point"},
        {"fixture_budget_with_unknown_point",
         [](Files& files) {
             with_fixture_budget(files);
             files.at("fixture_points.csv") += "R5.x,3\n";
         },
         k_fixture_budget_points, "fixture_budget.json#/points", "the point \"R5.x\" is no coordinate"},
        {"fixture_budget_without_points",
         [](Files& files) {
             with_fixture_budget(files);
             replace(files.at("fixture_budget.json"), ",\n  \"points\": {\"file\": \"fixture_points.csv\"}", "");
         },
         k_fixture_budget_points, "fixture_budget.json#/points", "has no points"},
        {"fixture_budget_of_another_kind",
         [](Files& files) {
             with_fixture_budget(files);
             replace(files.at("fixture_budget.json"), "\"kind\": \"budget\"", "\"kind\": \"rotary_table\"");
         },
         k_wrong_kind, "fixture_budget.json#/kind (line 1, column 38)", "a job of kind \"budget\" is expected here"},
        {"fixture_budget_refused",
         [](Files& files) {
             with_fixture_budget(files);
             replace(files.at("fixture_budget.json"), "\"u\": 0.3", "\"u\": -0.3");
         },
         k_number_out_of_range, "fixture_budget.json#/inputs/d_cmm/u (line 3, column 42)", "must be greater than 0"},
        {"simulation_outliers", with_key("\"simulation\": {\"outliers\": {\"size_um\": 3}}"), k_missing_key,
         "job.json#/simulation/outliers (line 1, column 30)", "\"count\" is missing"},
        {"simulation_angle_counts", with_key("\"simulation\": {\"angle_counts\": [12.5]}"), k_not_an_integer,
         "job.json#/simulation/angle_counts (line 1, column 34)", "12.5 — must be whole numbers"},
        {"plan_too_large", with_key("\"plan\": {\"angles_deg\": {\"first\": 0, \"step\": 0.01, \"count\": 100000}}"),
         k_layout_too_large, "job.json#/plan (line 1, column 11)", "1200000 distances"},
        {"planned_angle_twice", with_key("\"plan\": {\"angles_deg\": [0, 90, 0, 180]}"), k_repeated_angle,
         "job.json#/plan/angles_deg (line 1, column 26)", "the angle 0° occurs twice"},
        {"plan_without_home", with_key("\"plan\": {\"angles_deg\": [1, 90, 180]}"), k_home_not_measured,
         "job.json#/plan (line 1, column 11)", "the home angle 0° (the default) is not among the angles of plan"},
        {"plan_beyond_the_last_angle",
         with_key("\"plan\": {\"angles_deg\": {\"first\": 0, \"step\": 90, \"count\": 1000}}"), k_number_out_of_range,
         "job.json#/plan/angles_deg/count (line 1, column 60)", "the last angle is 89910°"},
        {"region_reversed",
         with_key("\"plan\": {\"station_region\": {\"x_mm\": [1, 0], \"y_mm\": [0, 1], \"z_mm\": [0, 1]}}"),
         k_limits_reversed, "job.json#/plan/station_region/x_mm (line 1, column 39)", "from 1 mm to 0 mm"},
        {"region_too_fine",
         with_key("\"plan\": {\"station_region\": {\"x_mm\": [0, 1000], \"y_mm\": [0, 1000], \"z_mm\": [0, 1000], "
                  "\"step_mm\": 10}}"),
         k_layout_too_large, "job.json#/plan/station_region/step_mm (line 1, column 99)", "1030301 positions"},
        {"obstacle_reversed",
         with_key(R"("plan": {"sight": {"cylinders": [{"name": "t", "radius_mm": 1, "along_axis_mm": [3, 3]}]}})"),
         k_limits_reversed, "job.json#/plan/sight/cylinders/0/along_axis_mm (line 1, column 83)",
         "from 3 mm to 3 mm — an obstacle has an extent"},
        {"obstacle_without_a_name",
         with_key(R"("plan": {"sight": {"boxes": [{"x_mm": [0, 1], "y_mm": [0, 1], "z_mm": [0, 1]}]}})"), k_missing_key,
         "job.json#/plan/sight/boxes/0 (line 1, column 32)", "\"name\" is missing"},
        {"obstacle_no_object", with_key(R"("plan": {"sight": {"boxes": [3]}})"), k_wrong_type,
         "job.json#/plan/sight/boxes/0 (line 1, column 32)", "3 — must be an object"},
        {"facing_of_no_reflector",
         with_key(R"("plan": {"sight": {"acceptance_angle_deg": 30, "facing": [{"reflector": "R9",
         "direction": [0, 0, 1]}]}})"),
         k_unknown_reflector, "job.json#/plan/sight/facing/0/reflector (line 1, column 75)",
         "the reflector \"R9\" — is not in the coordinates file"},
        {"facing_twice", with_key(R"("plan": {"sight": {"acceptance_angle_deg": 30, "facing": [{"reflector": "R1",
         "direction": [0, 0, 1]}, {"reflector": "R1", "direction": [0, 1, 1]}]}})"),
         k_repeated_name, "job.json#/plan/sight/facing/1/reflector (line 2, column 49)", "looks in one direction"},
        {"facing_nowhere", with_key(R"("plan": {"sight": {"acceptance_angle_deg": 30, "facing": [{"reflector": "R1",
         "direction": [0, 0, 0]}]}})"),
         k_number_out_of_range, "job.json#/plan/sight/facing/0/direction (line 2, column 23)",
         "a direction has a length"},
        {"notes_type", with_key("\"notes\": 1"), k_wrong_type, "job.json#/notes (line 1, column 12)",
         "must be a string"},
        {"certificate_type", with_key("\"certificate\": 1"), k_wrong_type, "job.json#/certificate (line 1, column 18)",
         "must be an object or the name of a file"},
        {"home_not_a_number", with_key("\"home_angle_deg\": \"0\""), k_wrong_type,
         "job.json#/home_angle_deg (line 1, column 21)", "write the number without quotes"},
        {"home_not_measured", with_key("\"home_angle_deg\": 10"), k_home_not_measured,
         "job.json#/home_angle_deg (line 1, column 21)", "the home angle 10° has no distance"},
        {"nan_in_job", with("job.json", "0.05", "NaN"), k_json_not_finite, "job.json:7:44", "NaN"},
        {"overflow_in_job", with("job.json", "0.05", "1e999"), k_json_number_range, "job.json:7:44", "1e999"},
        {"observations_missing", [](Files& files) { replace_line(files.at("job.json"), 6, ""); }, k_missing_key,
         "job.json# (line 1, column 1)", "\"observations\" is missing"},
        {"lengths_missing", with("job.json", "\"lengths\": \"lengths.csv\", ", ""), k_missing_key,
         "job.json#/observations (line 6, column 19)", "\"lengths\" is missing"},
        {"absolute_file_name", with("job.json", "\"lengths.csv\"", "\"/tmp/lengths.csv\""), k_file_name,
         "job.json#/observations/lengths (line 6, column 32)", "relative to the job file"},
        {"windows_file_name", with("job.json", "\"lengths.csv\"", R"("data\\lengths.csv")"), k_file_name,
         "job.json#/observations/lengths (line 6, column 32)", "have / between folders"},
        {"u_constant_negative", with("job.json", "0.05", "-0.05"), k_number_out_of_range,
         "job.json#/length_uncertainty/u_constant_um (line 7, column 44)", "-0.05 µm — must be at least 0 µm"},
        {"u_constant_zero", with("job.json", "0.05", "0"), k_no_length_uncertainty,
         "job.json#/length_uncertainty/u_constant_um (line 7, column 44)", "must be greater than 0"},
        {"u_proportional_negative", with("job.json", "0.05", "0.05, \"u_proportional_um_per_m\": -1"),
         k_number_out_of_range, "job.json#/length_uncertainty/u_proportional_um_per_m (line 7, column 77)",
         "-1 µm/m — must be at least 0 µm/m"},
        {"scale_prior_without_u", with("job.json", "0.05", "0.05, \"scale_model\": \"prior\""), k_scale_without_u,
         "job.json#/length_uncertainty/scale_model (line 7, column 65)", "add \"scale_u\""},
        {"scale_u_zero", with("job.json", "0.05", "0.05, \"scale_u\": 0"), k_number_out_of_range,
         "job.json#/length_uncertainty/scale_u (line 7, column 61)", "must be greater than 0"},
        {"scale_u_in_ppm", with("job.json", "0.05", "0.05, \"scale_u\": 0.15"), k_number_out_of_range,
         "job.json#/length_uncertainty/scale_u (line 7, column 61)", "0.15 ppm is 1.5e-7"},
        {"scale_model", with("job.json", "0.05", "0.05, \"scale_model\": \"known\""), k_unknown_choice,
         "job.json#/length_uncertainty/scale_model (line 7, column 65)", "must be fixed, prior or free"},
        {"reference_temperature",
         with("job.json", "\"coordinates\"", "\"reference_temperature_degC\": 293.15, \"coordinates\""),
         k_number_out_of_range, "job.json#/fixture/reference_temperature_degC (line 9, column 35)",
         "293.15 °C — must be at least -50 °C and at most 100 °C"},
        {"expansion_too_large", with("job.json", "1.15e-5", "11.5"), k_number_out_of_range,
         "job.json#/fixture/thermal_expansion_per_K/value (line 10, column 43)",
         "11.5 1/K — must be at least 0 1/K and at most 0.001 1/K"},
        {"expansion_negative", with("job.json", "1.15e-5", "-1e-6"), k_number_out_of_range,
         "job.json#/fixture/thermal_expansion_per_K/value (line 10, column 43)", "-1e-06 1/K"},
        {"expansion_u_negative", with("job.json", "5e-7", "-5e-7"), k_number_out_of_range,
         "job.json#/fixture/thermal_expansion_per_K/u (line 10, column 57)", "-5e-07 1/K"},
        {"expansion_missing",
         with("job.json",
              "\"coordinates\": \"fixture.csv\",\n    \"thermal_expansion_per_K\": { \"value\": 1.15e-5, \"u\": 5e-7 }",
              "\"coordinates\": \"fixture.csv\""),
         k_missing_key, "job.json#/fixture (line 8, column 14)", "\"thermal_expansion_per_K\" is missing"},
        {"repeatability_mode", with_key("\"table_repeatability\": {\"mode\": \"known\"}"), k_unknown_choice,
         "job.json#/table_repeatability/mode (line 1, column 35)", "must be estimate, given or none"},
        {"repeatability_negative", with_key("\"table_repeatability\": {\"u_tilt_arcsec\": -1}"), k_number_out_of_range,
         "job.json#/table_repeatability/u_tilt_arcsec (line 1, column 44)", "-1 ″ — must be at least 0 ″"},
        {"repeatability_given_in_part",
         with_key("\"table_repeatability\": {\"mode\": \"given\", \"u_linear_um\": 0.3, \"u_axial_arcsec\": 0.2}"),
         k_missing_key, "job.json#/table_repeatability (line 1, column 26)", "\"u_tilt_arcsec\" is missing"},
        {"repeatability_given_zero",
         with_key("\"table_repeatability\": {\"mode\": \"given\", \"u_linear_um\": 0, \"u_axial_arcsec\": 0, "
                  "\"u_tilt_arcsec\": 0}"),
         k_no_repeatability, "job.json#/table_repeatability/mode (line 1, column 35)", "choose mode \"none\""},
        {"variance_components", with_key("\"variance_components\": true"), k_wrong_type,
         "job.json#/variance_components (line 1, column 26)", "true — must be a string"},
        {"outlier_test", with_key("\"outliers\": {\"test\": \"grubbs\"}"), k_unknown_choice,
         "job.json#/outliers/test (line 1, column 24)", "must be data_snooping or none"},
        {"outlier_action", with_key("\"outliers\": {\"action\": \"delete\"}"), k_unknown_choice,
         "job.json#/outliers/action (line 1, column 26)", "must be report or remove"},
        {"alpha_zero", with_key("\"outliers\": {\"alpha\": 0}"), k_number_out_of_range,
         "job.json#/outliers/alpha (line 1, column 25)", "must be greater than 0 and less than 0.5"},
        {"alpha_half", with_key("\"outliers\": {\"alpha\": 0.5}"), k_number_out_of_range,
         "job.json#/outliers/alpha (line 1, column 25)", "less than 0.5"},
        {"reference_without_description",
         with("job.json", "\"dial_indicator.csv\",\n    \"description\": \"dial_indicator.json\"",
              "\"dial_indicator.csv\""),
         k_missing_key, "job.json#/reference_method (line 12, column 23)", "\"description\" is missing"},

        // ---- lengths
        {"lengths_empty", with_content("lengths.csv", ""), k_empty_file, "lengths.csv", "the file is empty"},
        {"lengths_no_rows", [](Files& files) { files["lengths.csv"].resize(files["lengths.csv"].find('\n') + 1); },
         k_csv_no_rows, "lengths.csv", "a header and no rows"},
        {"lengths_column_missing", with("lengths.csv", "dead_path", "deadpath"), k_csv_missing_column,
         "lengths.csv:1:1", "is it the column \"deadpath\"?"},
        {"lengths_text", with_line("lengths.csv", 3, row_text("P1", "R2", "P1+", "+", "0.0", "long", "P1")),
         k_csv_not_a_number, "lengths.csv:3:17", "\"long\" in column length_mm"},
        {"lengths_nan", with_line("lengths.csv", 3, row_text("P1", "R2", "P1+", "+", "nan", "500", "P1")),
         k_csv_not_finite, "lengths.csv:3:13", "\"nan\" in column angle_deg"},
        {"lengths_ragged", with_line("lengths.csv", 3, "P1,R2,P1+,+,0.0,500.12"), k_csv_ragged_row, "lengths.csv:3:17",
         "6 fields where the header has 7"},
        {"lengths_decimal_comma", with_line("lengths.csv", 3, "P1,R2,P1+,+,0.0,500,12,P1"), k_csv_decimal_comma,
         "lengths.csv:3:24", "\"500,12\" looks like a number with a decimal comma"},
        {"lengths_quoted_decimal_comma", with_line("lengths.csv", 3, "P1,R2,P1+,+,0.0,\"500,12\",P1"),
         k_csv_decimal_comma, "lengths.csv:3:17", "\"500,12\" in column length_mm"},
        {"lengths_rounded", [](Files& files) { files["lengths.csv"] = rounded_lengths(files["lengths.csv"], 2); },
         k_rounded_lengths, "job.json#/length_uncertainty (line 7, column 25)",
         "all lengths are rounded to multiples of 10 µm"},
        {"lengths_bars", [](Files& files) { replace_all(files.at("lengths.csv"), ",", "|"); }, k_csv_separator,
         "lengths.csv:1:1", "separated by bars"},
        {"lengths_tabs", [](Files& files) { replace_all(files.at("lengths.csv"), ",", "\t"); }, k_csv_separator,
         "lengths.csv:1:1", "separated by tabs"},
        {"length_below_100_m", with_line("lengths.csv", 3, row_text("P1", "R2", "P1+", "+", "0.0", "-100000.1", "P1")),
         k_csv_out_of_range, "lengths.csv:3:17",
         "-100000.1 mm in column length_mm — must be at least -100000 mm and at most 100000 mm"},
        {"length_over_100_m", with_line("lengths.csv", 3, row_text("P1", "R2", "P1+", "+", "0.0", "100000.1", "P1")),
         k_csv_out_of_range, "lengths.csv:3:17", "check the unit: lengths are in millimetres"},
        {"lengths_in_metres",
         [](Files& files) {
             for (int hundreds = 5; hundreds <= 10; ++hundreds) {
                 for (int angle = 0; angle < 360; angle += 45) {
                     const std::string whole = std::to_string(100 * hundreds + angle) + ".";
                     std::string& lengths = files.at("lengths.csv");
                     if (lengths.find("," + whole) != std::string::npos) {
                         replace_all(lengths, "," + whole, ",0." + std::to_string(100 * hundreds + angle));
                     }
                 }
             }
         },
         k_lengths_in_metres, "lengths.csv:157:19", "no length reaches 10 mm; the longest is"},
        {"direction", with_line("lengths.csv", 3, row_text("P1", "R2", "P1+", "up", "0.0", "500.12", "P1")),
         k_csv_unknown_choice, "lengths.csv:3:11", "\"up\" in column direction — must be + or -"},
        {"station_empty", with_line("lengths.csv", 3, row_text("", "R2", "P1+", "+", "0.0", "500.12", "P1")),
         k_csv_missing_value, "lengths.csv:3:1", "an empty cell in column station"},
        {"name_too_long",
         with_line("lengths.csv", 3, row_text("P1", "R2", std::string(257, 'p'), "+", "0.0", "500.12", "P1")),
         k_csv_name, "lengths.csv:3:7", "has 257 bytes"},
        {"name_bidi", with_line("lengths.csv", 3, row_text("P1", "R2", "P1\xE2\x80\xAE+", "+", "0.0", "500.12", "P1")),
         k_csv_name, "lengths.csv:3:7", "U+202E"},
        {"unknown_reflector", with_line("lengths.csv", 3, row_text("P1", "R9", "P1+", "+", "0.0", "500.12", "P1")),
         k_unknown_reflector, "lengths.csv:3:4", "the reflector \"R9\" (1 row) is not in the fixture file"},
        {"repeated_distance", with_line("lengths.csv", 3, row_text("P1", "R1", "P1+", "+", "0.0", "500.12", "P1")),
         k_repeated_length, "lengths.csv:3:1", "occurs a second time, the first is line 2"},
        {"pass_of_two_stations", with_line("lengths.csv", 3, row_text("P2", "R2", "P1+", "+", "0.0", "500.12", "P2")),
         k_pass_of_two_stations, "lengths.csv:3:7", "the pass \"P1+\" has station \"P2\" here and \"P1\" in line 2"},
        {"pass_of_two_directions", with_line("lengths.csv", 3, row_text("P1", "R2", "P1+", "-", "0.0", "500.12", "P1")),
         k_pass_of_two_directions, "lengths.csv:3:7", "the pass \"P1+\" has direction - here and + in line 2"},
        {"dead_path_of_two_stations",
         with_line("lengths.csv", lengths_line(2, 0, 0), row_text("P2", "R1", "P2+", "+", "0.0", "600.11", "P1")),
         k_dead_path_of_two_stations, "lengths.csv:66:24",
         "the dead path \"P1\" has station \"P2\" here and \"P1\" in line 2"},
        {"too_few_at_angle",
         [](Files& files) {
             for (std::size_t i = 0; i < 5; ++i) {
                 replace_line(files.at("lengths.csv"), 2 + i,
                              row_text("P1", i < 4 ? "R" + std::to_string(i + 1) : "R1", "P1+", "+",
                                       i < 4 ? "7.5" : "9.5", "500.12", "P1"));
             }
             replace_line(files.at("lengths.csv"), 6, row_text("P1", "R1", "P1+", "+", "0.0", "500.12", "P1"));
         },
         k_too_few_at_angle, "lengths.csv:2:13", "4 distances at the angle 7.5° — a pose has six unknowns"},
        {"too_few_of_station",
         [](Files& files) {
             for (std::size_t i = 0; i < 3; ++i) {
                 replace_line(files.at("lengths.csv"), 2 + i,
                              row_text("P4", "R" + std::to_string(i + 1), "P4+", "+", "0.0", "500.12", "P4"));
             }
             files.at("environment.csv") += "P4,20,0.03,20,1011,50\n";
         },
         k_too_few_of_station, "lengths.csv:2:1", "3 distances of the station \"P4\""},
        {"too_few_reflectors",
         [](Files& files) {
             std::string kept;
             std::istringstream lines(files.at("lengths.csv"));
             for (std::string line; std::getline(lines, line);) {
                 if (line.find(",R3,") == std::string::npos && line.find(",R4,") == std::string::npos) {
                     kept += line + "\n";
                 }
             }
             files["lengths.csv"] = kept;
         },
         k_too_few_reflectors, "lengths.csv:2:4", "2 reflectors — the pose of the table needs at least 3 reflectors"},
        {"angles_in_radians",
         [](Files& files) {
             change_angles(files, [](int angle) { return std::to_string(angle * std::numbers::pi / 180.0); });
         },
         k_angles_in_radians, "lengths.csv:2:13",
         "8 angles from 0 to 5.497787 are multiples of half a degree when they are taken as radians"},
        {"angles_in_rounded_radians",
         [](Files& files) {
             change_angles(files, [](int angle) { return text::fixed(angle * std::numbers::pi / 180.0, 3); });
         },
         k_angles_in_radians, "lengths.csv:2:13", "8 angles from 0 to 5.498 are multiples of half a degree"},
        {"angles_in_radians_to_two_digits",
         [](Files& files) {
             change_angles(files, [](int angle) { return text::fixed(angle * std::numbers::pi / 180.0, 2); });
         },
         k_angles_in_radians, "lengths.csv:2:13",
         "8 angles from 0 to 5.5 are multiples of 5° when they are taken as radians"},
        {"angle_beyond_ten_turns",
         with_line("lengths.csv", 3, row_text("P1", "R2", "P1+", "+", "3600.5", "500.12", "P1")), k_csv_out_of_range,
         "lengths.csv:3:13", "3600.5 °"},

        // ---- fixture
        {"fixture_column_missing", with("fixture.csv", ",u_z_um", ",uz"), k_csv_missing_column, "fixture.csv:1:1",
         "the column \"u_z_um\" is missing"},
        {"fixture_twice", with("fixture.csv", "\nR2,", "\nR1,"), k_repeated_name, "fixture.csv:3:1",
         "the reflector \"R1\" has a second row, the first is line 2"},
        {"fixture_u_zero", with("fixture.csv", "0.4,0.5,0.4", "0.4,0,0.4"), k_csv_out_of_range, "fixture.csv:2:25",
         "0 µm in column u_y_um — must be greater than 0 µm"},
        {"fixture_u_negative", with("fixture.csv", "0.4,0.5,0.4", "-0.4,0.5,0.4"), k_csv_out_of_range,
         "fixture.csv:2:21", "-0.4 µm in column u_x_um"},
        {"fixture_over_10_m", with("fixture.csv", "136.5", "10000.5"), k_csv_out_of_range, "fixture.csv:2:10",
         "10000.5 mm in column y_mm — must be at least -10000 mm and at most 10000 mm — check the unit"},
        {"fixture_in_metres",
         with_content("fixture.csv",
                      "reflector,x_mm,y_mm,z_mm,u_x_um,u_y_um,u_z_um\nR1,0.03,0.1,0,1,1,1\nR2,0.1,0,0.7,1,1,1\nR3,-0.2,"
                      "0.1,0,1,1,1\nR4,0,0,0.1,1,1,1\n"),
         k_coordinates_in_metres, "fixture.csv:2:4", "the largest is 0.7 mm"},
        {"stations_in_metres",
         with_content("stations.csv", "station,x_mm,y_mm,z_mm\nP1,0.5,-0.8,-0.3\nP2,0.6,0.7,1.9\n"),
         k_coordinates_in_metres, "stations.csv:2:4",
         "no coordinate of a station reaches 10 mm; the largest is 1.9 mm"},

        // ---- covariance of the fixture
        {"covariance_not_symmetric", with_covariance([](std::size_t i, std::size_t j) {
             return i == j ? 0.16 : i == 1 && j == 0 ? 0.01 : 0.0;
         }),
         k_covariance_not_symmetric, "covariance.csv (row 2)", "element (2, 1) is 0.01 µm², element (1, 2) is 0 µm²"},
        {"covariance_not_positive", with_covariance([](std::size_t i, std::size_t j) {
             return i == j ? 0.16 : i + j == 1 ? 0.17 : 0.0;
         }),
         k_covariance_not_positive, "covariance.csv", "the smallest eigenvalue is -0.01"},
        {"covariance_zero_variance",
         with_covariance([](std::size_t i, std::size_t j) { return i == j && i != 4 ? 0.16 : 0.0; }),
         k_covariance_not_positive, "covariance.csv (row 5)",
         "element (5, 5) is 0 µm² — a variance must be greater than 0"},
        {"covariance_size",
         [](Files& files) {
             with_covariance([](std::size_t i, std::size_t j) { return i == j ? 0.16 : 0.0; })(files);
             std::string& text = files.at("covariance.csv");
             text.resize(text.rfind('\n', text.size() - 2) + 1);
         },
         k_csv_matrix_size, "covariance.csv", "11 rows — the matrix has 12 rows and columns"},

        // ---- stations and environment
        {"station_coordinate", with("stations.csv", "500,-800", "500,-100001"), k_csv_out_of_range, "stations.csv:2:8",
         "-100001 mm in column y_mm"},
        {"station_twice", with("stations.csv", "\nP2", "\nP1"), k_repeated_name, "stations.csv:3:1",
         "the station \"P1\" has a second row, the first is line 2"},
        {"station_u_zero", with("stations.csv", "-300,20", "-300,0"), k_csv_out_of_range, "stations.csv:2:18",
         "0 mm in column u_mm — must be greater than 0 mm"},
        {"environment_station_missing", with("environment.csv", "P3,19.75,0.04,20.1,1010.0,51\n", ""),
         k_unknown_station, "lengths.csv:130:1", "the station \"P3\" has no row in environment.csv"},
        {"environment_twice", [](Files& files) { files.at("environment.csv") += "P3,20,0.03,20,1011,50\n"; },
         k_repeated_name, "environment.csv:5:1", "the station \"P3\" has a second row, the first is line 4"},
        {"temperature_kelvin", with("environment.csv", "20.25", "293.4"), k_csv_out_of_range, "environment.csv:2:4",
         "293.4 °C in column fixture_temperature_degC — must be at least -50 °C and at most 100 °C — check the unit"},
        {"temperature_cold", with("environment.csv", "20.25", "-50.5"), k_csv_out_of_range, "environment.csv:2:4",
         "-50.5 °C"},
        {"u_temperature_negative", with("environment.csv", "0.03", "-0.03"), k_csv_out_of_range, "environment.csv:2:10",
         "-0.03 K in column u_temperature_K — must be at least 0 K"},
        {"pressure_in_pascal", with("environment.csv", "1011.6", "101160"), k_csv_out_of_range, "environment.csv:2:20",
         "101160 hPa"},
        {"humidity", with("environment.csv", "1011.6,50", "1011.6,150"), k_csv_out_of_range, "environment.csv:2:27",
         "150 % in column humidity_percent"},

        // ---- reversal
        {"reversal_unknown", with_key(R"("reversal": "some")"), k_unknown_choice,
         "job.json#/reversal (line 1, column 15)", "\"some\""},
        {"reversal_by_angle_sequential", with_key(R"("reversal": "by_angle", "method": "sequential")"), k_bad_reversal,
         "job.json#/reversal (line 1, column 15)", "method is \"sequential\""},
        {"reversal_by_angle_of_one_sense",
         [](Files& files) {
             with_key(R"("reversal": "by_angle")")(files);
             std::string& lengths = files.at("lengths.csv");
             for (auto at = lengths.find(",-,"); at != std::string::npos; at = lengths.find(",-,")) {
                 lengths.replace(at, 3, ",+,");
             }
         },
         k_bad_reversal, "job.json#/reversal (line 1, column 15)", "was measured in one sense of approach only"},

        // ---- the frame of the machine
        {"machine_frame_without_by",
         with_key(R"("machine_frame": {"coordinates": "m.csv", "nominal_point_mm": [0,0,0]})"), k_missing_key,
         "job.json#/machine_frame (line 1, column 20)", "the key \"by\" is missing"},
        {"machine_frame_nominal",
         [](Files& files) {
             with_machine(test::small_machine_points())(files);
             replace(files.at("job.json"), "[0, 0, 0]", "[0, 0]");
         },
         k_wrong_size, "job.json#/machine_frame/nominal_point_mm (line 1, column 88)", "must have 3 numbers"},
        {"machine_frame_of_the_home_datum", with_machine(test::small_machine_points(), "\"datum\": \"home\", "),
         k_bad_machine_frame, "job.json#/machine_frame (line 1, column 20)", "the datum is that of the home angle"},
        {"machine_frame_of_stations_sequential",
         with_machine("station,x_mm,y_mm,z_mm,u_um\n", "\"method\": \"sequential\", ", "stations"), k_bad_machine_frame,
         "job.json#/machine_frame (line 1, column 20)", "the machine is known by its stations"},
        {"machine_point_unknown", with_machine(test::small_machine_points() + "R9,1,2,3,2\n"), k_bad_machine_frame,
         "machine.csv:5:1", "the reflector \"R9\" is not in the measurement"},
        {"machine_point_twice", with_machine(test::small_machine_points() + "R1,1,2,3,2\n"), k_repeated_name,
         "machine.csv:5:1", "the reflector \"R1\" has another row"},
        {"machine_points_too_few", with_machine("reflector,x_mm,y_mm,z_mm,u_um\nR1,1,2,3,2\nR2,4,5,9,2\n"),
         k_bad_machine_frame, "job.json#/machine_frame (line 1, column 20)", "2 reflectors"},
        {"machine_point_u_zero", with_machine("reflector,x_mm,y_mm,z_mm,u_um\nR1,1,2,3,0\nR2,4,5,9,2\nR3,7,1,2,2\n"),
         k_csv_out_of_range, "machine.csv:2:10", "0 µm in column u_um"},

        // ---- exclusions
        {"exclusion_without_reason", with_key(R"("exclude": [{"station": "P1"}])"), k_missing_key,
         "job.json#/exclude/0 (line 1, column 15)", "the key \"reason\" is missing"},
        {"exclusion_with_a_dash", with_key(R"("exclude": [{"station": "P1", "reason": "-"}])"), k_bad_exclusion,
         "job.json#/exclude/0/reason (line 1, column 43)", "the reason \"-\" says nothing"},
        {"exclusion_of_nothing_named", with_key(R"("exclude": [{"reason": "Beam was broken"}])"), k_bad_exclusion,
         "job.json#/exclude/0 (line 1, column 15)", "no distance is named"},
        {"exclusion_that_matches_nothing",
         with_key(R"("exclude": [{"station": "P1", "angle_deg": 46, "reason": "Beam was broken"}])"), k_bad_exclusion,
         "job.json#/exclude/0 (line 1, column 15)", "no distance of the lengths file agrees"},
        {"exclusion_said_twice", with_key(R"("exclude": [{"pass": "P1+", "angle_deg": 45, "reason": "Beam was broken"},
            {"station": "P1", "pass": "P1+", "angle_deg": 45, "reason": "Beam was broken"}])"),
         k_bad_exclusion, "job.json#/exclude/1 (line 2, column 13)", "that an entry before it does not leave out"},
        {"exclusion_of_lines_in_disorder", with_key(R"("exclude": [{"lines": [9, 8], "reason": "Beam was broken"}])"),
         k_bad_exclusion, "job.json#/exclude/0/lines (line 1, column 25)", "lines 9 to 8"},
        {"exclusion_of_everything", with_key(R"("exclude": [{"lines": [2, 1000], "reason": "Beam was broken"}])"),
         k_bad_exclusion, "job.json#/exclude (line 1, column 14)", "every distance is left out"},
        {"exclusion_is_no_object", with_key(R"("exclude": ["P1"])"), k_wrong_type,
         "job.json#/exclude/0 (line 1, column 15)", "an entry of \"exclude\" is an object"},

        // ---- reference method
        {"reading_direction", with("dial_indicator.csv", "x,0.0", "a,0.0"), k_csv_unknown_choice,
         "dial_indicator.csv:2:1", "must be x, y or z"},
        {"reading_angle", with("dial_indicator.csv", "x,45.0", "x,46.0"), k_reading_at_unknown_angle,
         "dial_indicator.csv:3:3", "the angle 46° has no distance"},
        {"reading_repeated", with("dial_indicator.csv", "x,45.0", "x,0"), k_repeated_reading, "dial_indicator.csv:3:1",
         "occurs twice, before in line 2"},
        {"reading_run", with("dial_indicator.csv", "0.0,1,3.2", "0.0,1.5,3.2"), k_csv_not_an_integer,
         "dial_indicator.csv:2:7", "must be a whole number"},
        {"indicator_key", with("dial_indicator.json", "mpe_um", "mpe_mm"), k_unknown_key,
         "dial_indicator.json#/mpe_mm (line 1, column 73)", "did you mean \"mpe_um\"?"},
        {"indicator_mpe_negative", with("dial_indicator.json", "0.8", "-0.8"), k_number_out_of_range,
         "dial_indicator.json#/mpe_um (line 1, column 73)", "-0.8 µm — must be at least 0 µm"},
        {"indicator_resolution_negative",
         with("dial_indicator.json", "\"resolution_um\": 0.1", "\"resolution_um\": -0.1"), k_number_out_of_range,
         "dial_indicator.json#/resolution_um (line 1, column 58)", "-0.1 µm"},
        {"indicator_repeatability_negative", with("dial_indicator.json", "0.25", "-0.25"), k_number_out_of_range,
         "dial_indicator.json#/repeatability_um (line 2, column 22)", "-0.25 µm"},
        {"indicator_knows_nothing",
         with_content("dial_indicator.json",
                      R"({"contact_point_mm": [1, 2, 3], "resolution_um": 0, "mpe_um": 0, "repeatability_um": 0})"),
         k_no_indicator_uncertainty, "dial_indicator.json# (line 1, column 1)",
         "are all 0 µm — at least one must be greater than 0"},
        {"contact_point_size", with("dial_indicator.json", "4.0, 0.0", "4.0"), k_wrong_size,
         "dial_indicator.json#/contact_point_mm (line 1, column 22)", "must have 3 numbers"},
        {"contact_point_far", with("dial_indicator.json", "100.0", "10001"), k_number_out_of_range,
         "dial_indicator.json#/contact_point_mm/0 (line 1, column 23)", "10001 mm"},
    };
    return list;
}

class BadInputTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, IsRefusedWithCodePlaceAndMessage) {
    const BadInput& bad = GetParam();
    Files files = small_campaign();
    bad.spoil(files);
    const auto found = refusals(files);
    const auto same_code =
        std::find_if(found.begin(), found.end(), [&](const auto& d) { return d.code == bad.code.code; });
    ASSERT_NE(same_code, found.end()) << "expected " << bad.code.code << ", found\n" << texts(found);
    EXPECT_EQ(same_code->where, bad.where);
    EXPECT_THAT(gum::message(*same_code), HasSubstr(bad.message));
    EXPECT_FALSE(same_code->rule.empty());
    EXPECT_FALSE(same_code->action.empty());
    EXPECT_EQ(same_code->severity, gum::Severity::error);
    EXPECT_THAT(gum::message(*same_code), testing::Not(HasSubstr("\n")));
    // One mistake is one message. An unknown key also leaves the right one out, one row can break two rules of a pass.
    if (bad.code.code != k_unknown_key.code) {
        EXPECT_EQ(found.size(), 1U) << texts(found);
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, BadInputTest, testing::ValuesIn(bad_inputs()),
                         [](const auto& row) { return row.param.name; });

TEST(RotaryTableJob, EveryCodeOfRotaryJobsHasABadInput) {
    std::set<std::string_view> covered;
    for (const BadInput& bad : bad_inputs()) {
        covered.insert(bad.code.code);
    }
    covered.insert(k_too_many_reflectors.code);  // by a test of its own
    covered.insert(k_layout_incomplete.code);    // by a test of its own
    for (const InputCode& code : k_input_codes) {
        if (code.code.starts_with("GC-INPUT-02")) {
            EXPECT_TRUE(covered.contains(code.code)) << code.code << " " << code.meaning;
        }
    }
}

TEST(RotaryTableJob, ReadsTheSmallCampaignInSi) {
    const RotaryTableJob job = read(small_campaign());
    EXPECT_EQ(job.title, "Small campaign");
    EXPECT_EQ(job.coverage_probability, 0.9545);
    EXPECT_THAT(job.files, ElementsAre("job.json", "lengths.csv", "stations.csv", "environment.csv", "fixture.csv",
                                       "dial_indicator.csv", "dial_indicator.json"));
    EXPECT_EQ(texts(job.warnings), "");
    EXPECT_FALSE(job.certificate.has_value());
    EXPECT_EQ(job.document.at("axis"), "A");

    const engine::RotaryTableMeasurement& m = job.measurement;
    EXPECT_EQ(m.axis, engine::RotaryAxis::a);
    EXPECT_THAT(m.stations, ElementsAre("P1", "P2", "P3"));
    EXPECT_THAT(m.reflectors, ElementsAre("R1", "R2", "R3", "R4"));
    EXPECT_THAT(m.passes, ElementsAre("P1+", "P1-", "P2+", "P2-", "P3+", "P3-"));
    EXPECT_THAT(m.dead_paths, ElementsAre("P1", "P2", "P3"));
    EXPECT_THAT(m.angles_deg, ElementsAre(0, 45, 90, 135, 180, 225, 270, 315));
    ASSERT_EQ(m.angles.size(), 8U);
    EXPECT_DOUBLE_EQ(m.angles[4], std::numbers::pi);
    EXPECT_EQ(m.home, 0U);
    ASSERT_EQ(m.lengths.size(), 192U);
    const engine::LengthObservation& length = m.lengths[lengths_line(3, 2, 1) - 2];
    EXPECT_EQ(length.station, 1U);
    EXPECT_EQ(length.reflector, 1U);
    EXPECT_EQ(length.pass, 3U);
    EXPECT_EQ(length.angle, 2U);
    EXPECT_EQ(length.dead_path, 1U);
    EXPECT_EQ(length.approach, engine::Approach::negative);
    EXPECT_DOUBLE_EQ(length.length, 0.69012002);
    EXPECT_EQ(length.line, lengths_line(3, 2, 1));
    EXPECT_DOUBLE_EQ(m.fixture(2, 1), -0.0995);
    ASSERT_EQ(m.fixture_covariance.rows(), 12);
    ASSERT_EQ(m.fixture_covariance.cols(), 12);
    EXPECT_DOUBLE_EQ(m.fixture_covariance(1, 1), 0.25e-12);
    EXPECT_EQ(m.fixture_covariance(0, 1), 0.0);
    ASSERT_EQ(m.station_start.size(), 3U);
    ASSERT_TRUE(m.station_start[2].has_value());
    EXPECT_DOUBLE_EQ(m.station_start[2]->x(), 1.2);
    EXPECT_DOUBLE_EQ(m.temperature_difference(2), -0.25);
    EXPECT_DOUBLE_EQ(m.u_temperature(2), 0.04);
    EXPECT_DOUBLE_EQ(m.expansion, 1.15e-5);
    EXPECT_DOUBLE_EQ(m.u_expansion, 5e-7);
    EXPECT_DOUBLE_EQ(m.length_uncertainty.u_constant, 5e-8);
    ASSERT_EQ(job.air.size(), 3U);
    EXPECT_EQ(job.air[1].pressure_hPa, 1014.9);

    ASSERT_TRUE(job.reference);
    EXPECT_EQ(job.reference->name, "dial indicator");
    ASSERT_EQ(job.reference->readings.size(), 3U);
    EXPECT_EQ(job.reference->readings[2].direction, 1U);
    EXPECT_DOUBLE_EQ(job.reference->readings[2].reading, -1.5e-6);
    EXPECT_EQ(job.reference->readings[1].angle, 1U);
    EXPECT_DOUBLE_EQ(job.reference->contact_point.x(), 0.1);
    EXPECT_DOUBLE_EQ(job.reference->resolution, 1e-7);
    EXPECT_DOUBLE_EQ(job.reference->maximum_permissible_error, 8e-7);
    EXPECT_DOUBLE_EQ(job.reference->repeatability, 2.5e-7);
}

TEST(RotaryTableJob, HasTheDocumentedDefaults) {
    const engine::RotaryTableMeasurement m = read(small_campaign()).measurement;
    EXPECT_EQ(m.datum, engine::Datum::axis_average_line);
    EXPECT_EQ(m.method, engine::AdjustmentMethod::joint);
    EXPECT_EQ(m.table_repeatability.mode, engine::RepeatabilityMode::estimate);
    EXPECT_TRUE(m.estimate_length_noise);
    EXPECT_EQ(m.outliers.test, engine::OutlierTest::data_snooping);
    EXPECT_EQ(m.outliers.alpha, 0.0001);
    EXPECT_EQ(m.outliers.action, engine::OutlierAction::remove);
    EXPECT_EQ(m.length_uncertainty.scale_model, engine::ScaleModel::fixed);
    EXPECT_EQ(m.length_uncertainty.u_proportional, 0.0);

    Files files = small_campaign();
    replace(files["job.json"], "0.05", "0.05, \"scale_u\": 1.5e-7");
    EXPECT_EQ(read(files).measurement.length_uncertainty.scale_model, engine::ScaleModel::prior);
    EXPECT_EQ(read(files).measurement.length_uncertainty.u_scale, 1.5e-7);

    for (const std::string mode :
         {R"({"mode": "none"})",
          R"({"mode": "given", "u_linear_um": 0.3, "u_axial_arcsec": 0.2, "u_tilt_arcsec": 0})"}) {
        files = small_campaign();
        with_key("\"table_repeatability\": " + mode)(files);
        EXPECT_FALSE(read(files).measurement.estimate_length_noise) << mode;
        with_key("\"variance_components\": \"estimate\"")(files);
        EXPECT_TRUE(read(files).measurement.estimate_length_noise) << mode;
    }
    files = small_campaign();
    with_key("\"variance_components\": \"fixed\"")(files);
    EXPECT_FALSE(read(files).measurement.estimate_length_noise);
}

TEST(RotaryTableJob, ReadsEveryOption) {
    Files files = small_campaign();
    replace(files["job.json"], "\"axis\": \"A\"", "\"axis\": \"C\"");
    replace(files["job.json"], "0.05", "0.05, \"u_proportional_um_per_m\": 0.5, \"scale_model\": \"free\"");
    replace(files["job.json"], "\"coordinates\"", "\"reference_temperature_degC\": 20.5, \"coordinates\"");
    with_key(R"("home_angle_deg": 90, "datum": "home", "method": "sequential", "coverage_probability": 0.99,
        "notes": "free text\nof two lines", "certificate": {"customer": {"name": "A"}},
        "table_repeatability": {"mode": "given", "u_linear_um": 0.3, "u_axial_arcsec": 0.2, "u_tilt_arcsec": 0.1,
            "at_mm": -120},
        "variance_components": "fixed", "outliers": {"test": "none", "alpha": 0.001, "action": "report"})")(files);
    const RotaryTableJob job = read(files);
    const engine::RotaryTableMeasurement& m = job.measurement;
    EXPECT_EQ(m.axis, engine::RotaryAxis::c);
    EXPECT_EQ(m.home, 2U);
    EXPECT_EQ(m.datum, engine::Datum::home);
    EXPECT_EQ(m.method, engine::AdjustmentMethod::sequential);
    EXPECT_EQ(job.coverage_probability, 0.99);
    ASSERT_TRUE(job.certificate.has_value());
    EXPECT_EQ(job.certificate->customer.name.plain, "A");
    EXPECT_EQ(m.table_repeatability.mode, engine::RepeatabilityMode::given);
    EXPECT_DOUBLE_EQ(m.table_repeatability.u_linear, 3e-7);
    EXPECT_DOUBLE_EQ(m.table_repeatability.u_axial, 0.2 * std::numbers::pi / 648000.0);
    EXPECT_DOUBLE_EQ(m.table_repeatability.u_tilt, 0.1 * std::numbers::pi / 648000.0);
    ASSERT_TRUE(m.table_repeatability.axial_position.has_value());
    EXPECT_DOUBLE_EQ(*m.table_repeatability.axial_position, -0.12);
    EXPECT_EQ(m.outliers.test, engine::OutlierTest::none);
    EXPECT_EQ(m.outliers.alpha, 0.001);
    EXPECT_EQ(m.outliers.action, engine::OutlierAction::report);
    EXPECT_EQ(m.length_uncertainty.scale_model, engine::ScaleModel::free);
    EXPECT_DOUBLE_EQ(m.length_uncertainty.u_proportional, 5e-7);
    EXPECT_DOUBLE_EQ(m.temperature_difference(0), -0.25);
    EXPECT_EQ(job.reference_temperature_degC, 20.5);
}

TEST(RotaryTableJob, LeavesOutWhatTheLaboratoryExcludes) {
    Files files = small_campaign();
    with_key(R"("exclude": [{"station": "P1", "direction": "+", "angle_deg": 45, "reason": "Beam was broken"},
        {"reflector": "R2", "pass": "P1+", "reason": "Reflector was loose"},
        {"lines": [190, 193], "reason": "Table was moving"}])")(files);
    const RotaryTableJob job = read(files);
    ASSERT_EQ(job.exclusions.size(), 3U);
    EXPECT_EQ(job.exclusions[0].count, 4U);
    EXPECT_EQ(job.exclusions[1].count, 7U) << "eight angles, one of them is left out by the first entry";
    EXPECT_EQ(job.exclusions[2].count, 4U);
    EXPECT_EQ(job.exclusions[1].reason, "Reflector was loose");
    EXPECT_EQ(job.measurement.lengths.size(), 192U - 15U);
    for (const engine::LengthObservation& length : job.measurement.lengths) {
        EXPECT_FALSE(length.station == 0 && length.angle == 1 && length.approach == engine::Approach::positive);
        EXPECT_FALSE(length.reflector == 1 && length.pass == 0);
        EXPECT_LT(length.line, 190U);
    }

    // A station of which nothing is left is no station of the measurement.
    files = small_campaign();
    replace(files["environment.csv"], "P1,20.25,0.03,20.3,1011.6,50\n", "");
    replace(files["stations.csv"], "P1,500,-800,-300,20\n", "");
    replace(files["lengths.csv"], "P3,R1", "P2,R1");
    with_key(R"("exclude": [{"station": "P1", "reason": "Moved during the work"},
        {"lines": [130, 130], "reason": "Written wrongly"}])")(files);
    EXPECT_THAT(read(files).measurement.stations, ElementsAre("P2", "P3"));

    // What is left must still be a measurement.
    files = small_campaign();
    with_key(R"("exclude": [{"angle_deg": 45, "direction": "+", "reason": "Beam was broken"},
        {"angle_deg": 45, "station": "P1", "reason": "Beam was broken"},
        {"angle_deg": 45, "station": "P2", "reason": "Beam was broken"}])")(files);
    const auto found = refusals(files);
    ASSERT_EQ(found.size(), 1U) << texts(found);
    EXPECT_EQ(found.front().code, k_too_few_at_angle.code);
}

TEST(RotaryTableJob, AcceptsBomCrlfAndOtherColumnOrders) {
    Files files = small_campaign();
    const RotaryTableJob plain = read(files);
    for (auto& [name, content] : files) {
        replace_all(content, "\n", "\r\n");
        content.insert(0, "\xEF\xBB\xBF");
    }
    const RotaryTableJob job = read(files);
    EXPECT_EQ(job.document, plain.document);
    ASSERT_EQ(job.measurement.lengths.size(), plain.measurement.lengths.size());
    EXPECT_EQ(job.measurement.lengths.back().length, plain.measurement.lengths.back().length);
    EXPECT_EQ(job.measurement.lengths.back().line, plain.measurement.lengths.back().line);

    files = small_campaign();
    files["fixture.csv"] =
        "u_x_um,u_y_um,u_z_um,z_mm,y_mm,x_mm,reflector\n0.4,0.5,0.6,3,2,1,R1\n1,1,1,5,6,7,R2\n1,1,1,5,60,7,R3\n1,1,1,5,"
        "6,70,R4\n";
    const RotaryTableJob reordered = read(files);
    EXPECT_EQ(reordered.measurement.fixture(0, 0), 0.001);
    EXPECT_EQ(reordered.measurement.fixture(0, 2), 0.003);
    EXPECT_DOUBLE_EQ(reordered.measurement.fixture_covariance(2, 2), 0.36e-12);
}

TEST(RotaryTableJob, ReadsTheTimesOfTheDistancesWhereTheFileHasThem) {
    Files files = small_campaign();
    EXPECT_TRUE(read(files).measurement.times.empty());
    std::string& lengths = files["lengths.csv"];
    std::string timed;
    std::size_t row = 0;
    for (std::size_t at = 0; at < lengths.size(); ++row) {
        const std::size_t end = lengths.find('\n', at);
        timed += lengths.substr(at, end - at) + (row == 0 ? ",time_s" : "," + std::to_string(30 * row) + ".5") + "\n";
        at = end + 1;
    }
    lengths = timed;
    const engine::RotaryTableMeasurement m = read(files).measurement;
    ASSERT_EQ(m.times.size(), m.lengths.size());
    EXPECT_EQ(m.times.front(), 30.5);
    EXPECT_EQ(m.times.back(), 30.0 * static_cast<double>(m.lengths.size()) + 0.5);
    replace(lengths, ",30.5\n", ",morning\n");  // a time of every distance, or of none
    EXPECT_ANY_THROW(read(files));
}

TEST(RotaryTableJob, ReadsTheFixtureCovariance) {
    Files files = small_campaign();
    // Fully correlated coordinates: singular, and allowed.
    with_covariance([](std::size_t i, std::size_t j) { return (i == 1 ? 0.5 : 0.4) * (j == 1 ? 0.5 : 0.4); })(files);
    const RotaryTableJob job = read(files);
    EXPECT_EQ(texts(job.warnings), "");
    EXPECT_NEAR(job.measurement.fixture_covariance(1, 11), 0.2e-12, 1e-27);
    EXPECT_EQ(job.measurement.fixture_covariance(11, 1), job.measurement.fixture_covariance(1, 11));
    EXPECT_THAT(job.files, ElementsAre("job.json", "lengths.csv", "stations.csv", "environment.csv", "fixture.csv",
                                       "covariance.csv", "dial_indicator.csv", "dial_indicator.json"));

    files = small_campaign();
    with_covariance([](std::size_t i, std::size_t j) { return i == j ? 0.16 : 0.0; })(files);
    const auto warnings = read(files).warnings;
    ASSERT_EQ(warnings.size(), 1U) << texts(warnings);
    EXPECT_EQ(warnings[0].code, k_warn_covariance_differs.code);
    EXPECT_THAT(
        gum::message(warnings[0]),
        HasSubstr("covariance.csv (row 2) — u from the covariance is 0.4 µm, from the column of the fixture file 0.5"));

    // One cause is one warning, at the coordinate that differs most.
    files = small_campaign();
    with_covariance([](std::size_t i, std::size_t j) { return i == j ? (i == 4 ? 9.0 : 4.0) : 0.0; })(files);
    const auto of_all = read(files).warnings;
    ASSERT_EQ(of_all.size(), 1U) << texts(of_all);
    EXPECT_THAT(gum::message(of_all[0]), HasSubstr("covariance.csv (row 5) — u from the covariance is 3 µm"));
    EXPECT_THAT(gum::message(of_all[0]), HasSubstr("12 of 12 coordinates differ, this one most"));
}

TEST(RotaryTableJob, ReadsTheCertificateFromAFile) {
    Files files = small_campaign();
    with_key("\"certificate\": \"certificate.json\"")(files);
    files["certificate.json"] = "// persons\n{\"laboratory\": {\"name\": \"Lab\"}}";
    const RotaryTableJob job = read(files);
    ASSERT_TRUE(job.certificate.has_value());
    EXPECT_EQ(job.certificate->laboratory.name.plain, "Lab");
    EXPECT_EQ(job.document.at("certificate"), "certificate.json");
    EXPECT_EQ(job.files.back(), "certificate.json");
    files["certificate.json"] = "[]";
    const auto found = refusals(files);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, k_wrong_type.code);
    EXPECT_EQ(found[0].where, "certificate.json# (line 1, column 1)");
}

TEST(RotaryTableJob, TakesAlmostEqualAnglesForOne) {
    Files files = small_campaign();
    replace_line(files["lengths.csv"], lengths_line(0, 1, 0),
                 row_text("P1", "R1", "P1+", "+", "45.0000000005", "545.11", "P1"));
    EXPECT_EQ(read(files).measurement.angles_deg.size(), 8U);
    replace_line(files["lengths.csv"], lengths_line(0, 1, 1), row_text("P1", "R1", "P1+", "+", "45", "545.12", "P1"));
    const auto found = refusals(files);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, k_repeated_length.code);
    EXPECT_THAT(found[0].what, HasSubstr("line 6"));
}

// A displayed length counts from where the interferometer was set to zero, so it may be zero or negative: l + l0 > 0.
TEST(RotaryTableJob, AcceptsDisplayedLengthsThatAreNegative) {
    Files files = small_campaign();
    replace_line(files["lengths.csv"], 3, row_text("P1", "R2", "P1+", "+", "0.0", "-500.12", "P1"));
    replace_line(files["lengths.csv"], 4, row_text("P1", "R3", "P1+", "+", "0.0", "0", "P1"));
    const RotaryTableJob job = read(files);
    EXPECT_DOUBLE_EQ(job.measurement.lengths[1].length, -0.50012);
    EXPECT_EQ(job.measurement.lengths[2].length, 0.0);
}

/// The last digits of passes in negative direction otherwise than those of the passes before them, four of five.
std::string scattered_returns(const std::string& lengths) {
    std::istringstream lines(lengths);
    std::string text;
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.find(",-,") != std::string::npos) {
            char& last = line[line.rfind(',') - 1];
            last = static_cast<char>('0' + (static_cast<std::size_t>(last - '0') + count++ % 5) % 10);
        }
        text += line + "\n";
    }
    return text;
}

/// The small campaign with fewer decimals of its lengths, and what is stated of them.
Files rounded_campaign(std::size_t decimals, const std::string& stated) {
    Files files = small_campaign();
    files.at("lengths.csv") = rounded_lengths(files.at("lengths.csv"), decimals);
    replace(files.at("job.json"), "\"u_constant_um\": 0.05", stated);
    return files;
}

// Digits that say less than the stated uncertainty: the weights would rest on it, and U with them.
TEST(RotaryTableJob, LengthsThatAreRoundedByFarMoreThanTheirUncertaintyAreRefused) {
    const auto refused = refusals(rounded_campaign(2, "\"u_constant_um\": 0.25"));
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_EQ(refused[0].code, k_rounded_lengths.code);
    EXPECT_EQ(refused[0].where, "job.json#/length_uncertainty (line 7, column 25)");
    EXPECT_THAT(
        gum::message(refused[0]),
        HasSubstr("all lengths are rounded to multiples of 10 µm, and rounding alone has a standard uncertainty of "
                  "2.9 µm, while 0.25 µm is stated"));
    EXPECT_THAT(gum::message(refused[0]), HasSubstr("step/√12 (JCGM 100:2008, F.2.2.1)"));
    EXPECT_THAT(gum::message(refused[0]), HasSubstr("\"resolution_um\": 10"));
    EXPECT_EQ(refusals(rounded_campaign(2, "\"u_constant_um\": 0.25, \"resolution_um\": 1")).size(), 1U);
}

TEST(RotaryTableJob, LengthsThatAreRoundedByMoreThanTheirUncertaintyAreWarnedOf) {
    const auto codes_of = [](const Files& files) {
        std::vector<std::string> codes;
        for (const gum::Diagnostic& warning : read(files).warnings) {
            codes.push_back(warning.code);
        }
        return codes;
    };
    EXPECT_THAT(codes_of(rounded_campaign(2, "\"u_constant_um\": 1.5")), ElementsAre(k_warn_rounded_lengths.code));
    // What has the rounding in it, or states it beside it, is sound.
    EXPECT_THAT(codes_of(rounded_campaign(2, "\"u_constant_um\": 2.9")), IsEmpty());
    EXPECT_THAT(codes_of(rounded_campaign(2, "\"u_constant_um\": 1.5, \"resolution_um\": 10")), IsEmpty());
    EXPECT_THAT(codes_of(small_campaign()), IsEmpty());
    // Both passes of each station come back to the same readings.
    EXPECT_THAT(codes_of(rounded_campaign(2, "\"u_constant_um\": 0.25, \"resolution_um\": 10")),
                ElementsAre(k_warn_rounded_alike.code));
    // A table that scatters over steps comes back to other readings, and so is each rounded.
    Files scattered = rounded_campaign(2, "\"u_constant_um\": 0.25, \"resolution_um\": 10");
    scattered.at("lengths.csv") = scattered_returns(scattered.at("lengths.csv"));
    EXPECT_THAT(codes_of(scattered), IsEmpty());
    // The displayed lengths are below 1.1 m, and how much longer the distances are is not known.
    EXPECT_THAT(codes_of(rounded_campaign(2, "\"u_constant_um\": 0.25, \"u_proportional_um_per_m\": 1")), IsEmpty());
    const auto refused = refusals(rounded_campaign(2, "\"u_constant_um\": 0.25, \"u_proportional_um_per_m\": 0.1"));
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_THAT(gum::message(refused[0]), HasSubstr("while 0.47 µm is stated at 4 m"));
    const std::string in_proportion_only = "\"u_constant_um\": 0, \"u_proportional_um_per_m\": 0.1";
    EXPECT_EQ(refusals(rounded_campaign(2, in_proportion_only)).size(), 1U);
}

TEST(RotaryTableJob, LeavesFullTurnsInDegreesAlone) {
    // Small angles in degrees that span less than 2π are not radians: they are multiples of 0.1.
    Files files = small_campaign();
    change_angles(files, [](int angle) { return std::to_string(angle / 60) + "." + std::to_string(angle / 6 % 10); });
    const auto warnings = read(files).warnings;
    ASSERT_EQ(warnings.size(), 1U) << texts(warnings);
    EXPECT_EQ(warnings[0].code, k_warn_angle_span.code);
}

TEST(RotaryTableJob, Warns) {
    Files files = small_campaign();
    replace(files["job.json"], ", \"environment\": \"environment.csv\"", "");
    replace(files["job.json"], "0.05", "0.05, \"scale_u\": 1e-7, \"scale_model\": \"fixed\"");
    with_key("\"table_repeatability\": {\"mode\": \"none\", \"u_linear_um\": 0.3}")(files);
    files["stations.csv"] += "P9,1,2,3,20\n";
    files["fixture.csv"] += "R9,1,2,3,1,1,1\n";
    replace(files["dial_indicator.csv"], "reading_um", "reading_um,remark");
    replace_all(files["dial_indicator.csv"], "3.2", "3.2,");
    replace_all(files["dial_indicator.csv"], "2.7", "2.7,");
    replace_all(files["dial_indicator.csv"], "-1.5", "-1.5,");
    const RotaryTableJob job = read(files);
    std::vector<std::string> codes;
    for (const auto& warning : job.warnings) {
        codes.push_back(warning.code);
        EXPECT_EQ(warning.severity, gum::Severity::warning);
    }
    EXPECT_THAT(codes, ElementsAre(k_warn_unused_value.code, k_warn_unused_value.code, k_warn_no_environment.code,
                                   k_warn_unused_reflector.code, k_warn_unused_station.code, k_warn_extra_column.code))
        << texts(job.warnings);
    EXPECT_TRUE(job.measurement.temperature_difference.isZero());
    EXPECT_EQ(job.measurement.temperature_difference.size(), 3);
    EXPECT_TRUE(job.measurement.u_temperature.isZero());
    EXPECT_TRUE(job.air.empty());
    EXPECT_EQ(job.measurement.reflectors.size(), 5U);

    files = small_campaign();
    change_angles(files, [](int angle) { return std::to_string(angle / 3); });
    const auto warnings = read(files).warnings;
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(gum::message(warnings[0]),
              "lengths.csv — the angles span 105°, from 0° to 105° — below half a turn, set-up errors and the first "
              "harmonics of the error motions are poorly separated — measure over a full turn if the table allows it");
}

TEST(RotaryTableJob, LeavesStationsWithoutStartValuesOpen) {
    Files files = small_campaign();
    replace(files["stations.csv"], "P2,800,-700,550,20\n", "");
    const RotaryTableJob job = read(files);
    EXPECT_TRUE(job.measurement.station_start[0]);
    EXPECT_FALSE(job.measurement.station_start[1]);
    replace(files["job.json"], "\"stations\": \"stations.csv\", ", "");
    files.erase("stations.csv");
    const RotaryTableJob without = read(files);
    ASSERT_EQ(without.measurement.station_start.size(), 3U);
    EXPECT_FALSE(without.measurement.station_start[0]);
}

TEST(RotaryTableJob, ReportsTheProblemsOfAllFilesTogether) {
    Files files = small_campaign();
    replace(files["dial_indicator.json"], "0.8", "-0.8");
    replace(files["environment.csv"], "20.25", "293");
    replace(files["job.json"], "0.05", "-0.05");
    replace(files["fixture.csv"], "0.5", "0");
    replace_line(files["lengths.csv"], 3, row_text("P1", "R2", "P1+", "+", "0.0", "x", "P1"));
    replace_line(files["lengths.csv"], 4, row_text("P1", "R3", "P1+", "*", "0.0", "1e6", "P1"));
    replace(files["dial_indicator.csv"], "x,45.0", "w,45.0");
    std::vector<std::string> places;
    for (const auto& diagnostic : refusals(files)) {
        places.push_back(diagnostic.where);
    }
    EXPECT_THAT(places,
                ElementsAre("job.json#/length_uncertainty/u_constant_um (line 7, column 44)", "lengths.csv:3:17",
                            "lengths.csv:4:11", "lengths.csv:4:17", "environment.csv:2:4", "fixture.csv:2:25",
                            "dial_indicator.csv:3:1", "dial_indicator.json#/mpe_um (line 1, column 73)"));
}

// Pins: a file with nothing but ragged rows was taken for a fixture without reflectors, and one mistake led to others.
TEST(RotaryTableJob, DrawsNoConclusionsFromRowsThatItCouldNotRead) {
    Files files = small_campaign();
    files["fixture.csv"] = "reflector,x_mm,y_mm,z_mm,u_x_um,u_y_um,u_z_um\nR1,1\n";
    replace(files["environment.csv"], "P2,20.5,0.03,", "P2,20.5,");
    replace(files["environment.csv"], "P3,", "P3 ,");
    replace_line(files["lengths.csv"], 3, "P1,R2,P1+,+,0.0");
    replace(files["dial_indicator.csv"], "x,45.0", "x,46.0");
    std::vector<std::string> places;
    for (const auto& diagnostic : refusals(files)) {
        places.push_back(diagnostic.where);
    }
    EXPECT_THAT(places,
                ElementsAre("lengths.csv:3:13", "environment.csv:3:21", "environment.csv:4:1", "fixture.csv:2:4"));
}

TEST(RotaryTableJob, ClosesTheListOfAFileAfter200Problems) {
    Files files = small_campaign();
    std::string lengths = "station,reflector,pass,direction,angle_deg,length_mm,dead_path\n";
    for (int i = 0; i < 300; ++i) {
        lengths += "P1,R1,P1+,+,0,x,P1\n";
    }
    files["lengths.csv"] = lengths;
    replace(files["dial_indicator.json"], "0.8", "-0.8");
    const auto found = refusals(files);
    ASSERT_GT(found.size(), 201U);
    EXPECT_EQ(found[200].what, "and 100 more");
    EXPECT_EQ(found[200].where, "lengths.csv");
    EXPECT_THAT(found.back().where, HasSubstr("dial_indicator.json"));
}

TEST(RotaryTableJob, TellsFilesThatCannotBeRead) {
    Files files = small_campaign();
    files.erase("fixture.csv");
    files.erase("environment.csv");
    replace(files["dial_indicator.json"], "0.8", "-0.8");
    try {
        (void)read(files);
        FAIL() << "accepted";
    } catch (const gum::StorageError& error) {
        const auto& found = error.diagnostics();
        ASSERT_GE(found.size(), 3U);
        EXPECT_EQ(found[0].code, k_file_not_readable.code);
        EXPECT_EQ(found[0].where, "environment.csv");
        EXPECT_EQ(found[1].where, "fixture.csv");
        EXPECT_THAT(texts(found), HasSubstr("dial_indicator.json#/mpe_um"));
        // A fixture that is not there is no reason to call its reflectors unknown.
        EXPECT_THAT(texts(found), testing::Not(HasSubstr("reflector")));
    }
    EXPECT_THROW((void)read({}), gum::StorageError);
}

TEST(RotaryTableJob, LimitsTheNumberOfReflectors) {
    Files files = small_campaign();
    for (int i = 5; i <= 501; ++i) {
        files["fixture.csv"] += "R" + std::to_string(i) + ",1,2,3,1,1,1\n";
    }
    const auto found = refusals(files);
    ASSERT_EQ(found.size(), 1U) << texts(found);
    EXPECT_EQ(found[0].code, k_too_many_reflectors.code);
    EXPECT_EQ(found[0].where, "fixture.csv:502:1");
}

TEST(RotaryTableJob, KeepsMessagesOnOneLine) {
    Files files = small_campaign();
    with_key("\"a\\nb\\u001b[31m\": 1")(files);
    const auto found = refusals(files);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(gum::message(found[0]), HasSubstr("job.json#/a\\u{000A}b\\u{001B}[31m (line 1, column 21)"));
}

TEST(JobKind, TellsTheKind) {
    const auto kind_of = [](const std::string& text) {
        return job_kind(MemoryFileSource({{"job.json", text}}), "job.json");
    };
    EXPECT_EQ(kind_of(R"({"schema": "gumcert/job/1", "kind": "budget", "model": []})"), "budget");
    EXPECT_EQ(kind_of(R"({"schema": "gumcert/job/1", "kind": "rotary_table"})"), "rotary_table");
    EXPECT_EQ(kind_of(R"({"schema": "gumcert/job/1", "kind": "comparison"})"), "comparison");
    for (const std::string text : {R"({"schema": "gumcert/job/1", "kind": "table"})", R"({"kind": "budget"})",
                                   R"({"schema": 1, "kind": "budget"})", R"({"schema": "gumcert/job/1"})", "[]", "",
                                   R"({"schema": "gumcert/job/1", "kind": "budget", "kind": "budget"})"}) {
        EXPECT_THROW((void)kind_of(text), gum::InputError) << text;
    }
}

// ---- files on the disk ----------------------------------------------------------------------------------------------

class DiskJobTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(testing::TempDir()) / (std::string("gumcert_job_") + info->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        for (const auto& [name, content] : small_campaign()) {
            std::ofstream(folder_ / name, std::ios::binary) << content;
        }
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_;
};

TEST_F(DiskJobTest, ReadsFilesBesideTheJob) {
    EXPECT_EQ(read_rotary_table_job(folder_ / "job.json").measurement.lengths.size(), 192U);
    EXPECT_EQ(job_kind(folder_ / "job.json"), "rotary_table");
}

TEST_F(DiskJobTest, TellsWhatCannotBeRead) {
    EXPECT_THROW((void)read_rotary_table_job(folder_ / "other.json"), gum::StorageError);
    EXPECT_THROW((void)job_kind(folder_), gum::StorageError);
    std::filesystem::remove(folder_ / "lengths.csv");
    std::filesystem::create_directory(folder_ / "lengths.csv");
    try {
        (void)read_rotary_table_job(folder_ / "job.json");
        FAIL() << "accepted";
    } catch (const gum::StorageError& error) {
        EXPECT_EQ(
            gum::message(error.diagnostics().at(0)),
            "lengths.csv — cannot be read: it is a folder; it is named at job.json#/observations/lengths (line 6, "
            "column 32) — every file of a job must be a readable file — check the name and the rights of the file");
    }
}

// ---- whole campaigns ------------------------------------------------------------------------------------------------

struct Campaign {
    std::string name;
    engine::RotaryAxis axis;
    std::size_t lengths, stations, reflectors, angles, passes, dead_paths, readings;
};

class CampaignTest : public testing::TestWithParam<Campaign> {};

TEST_P(CampaignTest, IsReadWithoutAWarning) {
    const Campaign& expected = GetParam();
    const std::filesystem::path file =
        std::filesystem::path(GUMCERT_SOURCE_DIR) / "tests/reference/campaigns" / expected.name / "job.json";
    const RotaryTableJob job = read_rotary_table_job(file);
    const engine::RotaryTableMeasurement& m = job.measurement;
    EXPECT_EQ(texts(job.warnings), "");
    EXPECT_EQ(m.axis, expected.axis);
    EXPECT_EQ(m.lengths.size(), expected.lengths);
    EXPECT_EQ(m.stations.size(), expected.stations);
    EXPECT_EQ(m.reflectors.size(), expected.reflectors);
    EXPECT_EQ(m.angles.size(), expected.angles);
    EXPECT_EQ(m.passes.size(), expected.passes);
    EXPECT_EQ(m.dead_paths.size(), expected.dead_paths);
    ASSERT_TRUE(job.reference);
    EXPECT_EQ(job.reference->readings.size(), expected.readings);
    EXPECT_EQ(m.length_uncertainty.scale_model, engine::ScaleModel::prior);
    EXPECT_EQ(m.length_uncertainty.u_scale, 1.5e-7);
    EXPECT_EQ(job.files.size(), 7U);
    EXPECT_EQ(job_kind(file), "rotary_table");
}

INSTANTIATE_TEST_SUITE_P(
    Simulated, CampaignTest,
    testing::Values(Campaign{"a_axis", engine::RotaryAxis::a, 2592, 6, 6, 36, 12, 6, 216},
                    Campaign{"a_axis_outliers", engine::RotaryAxis::a, 2394, 6, 6, 36, 12, 6, 216},
                    Campaign{"b_axis_perfect_table", engine::RotaryAxis::b, 1536, 8, 8, 12, 16, 8, 72},
                    Campaign{"c_axis_single_target", engine::RotaryAxis::c, 1728, 6, 6, 24, 72, 12, 144}),
    [](const auto& row) { return row.param.name; });

// ---- the keys of simulation, plan and the fixture budget
// --------------------------------------------------------------

TEST(RotaryTableJob, ReadsMonteCarloResolutionAndShapes) {
    Files files = small_campaign();
    std::string& job = files.at("job.json");
    with_key("\"monte_carlo\": {\"trials\": 300000, \"seed\": 5, \"validate\": true}")(files);
    replace(job, "0.05", "0.05, \"resolution_um\": 0.02");
    replace(job, "\"lengths\":", "\"temperature_distribution\": \"uniform\", \"lengths\":");
    replace(job, "\"u\": 5e-7", "\"u\": 5e-7, \"distribution\": \"uniform\"");
    replace(job, "\"coordinates\"",
            "\"distribution\": \"uniform\", \"variance_component\": \"given\", \"coordinates\"");
    const RotaryTableJob read_job = read(files);
    ASSERT_TRUE(read_job.monte_carlo);
    EXPECT_EQ(read_job.monte_carlo->trials, 300'000U);
    EXPECT_EQ(read_job.monte_carlo->seed, 5U);
    EXPECT_TRUE(read_job.monte_carlo->validate);
    EXPECT_THAT(read_job.monte_carlo->where, HasSubstr("job.json#/monte_carlo"));
    const engine::RotaryTableMeasurement& m = read_job.measurement;
    EXPECT_DOUBLE_EQ(m.length_uncertainty.resolution, 0.02e-6);
    EXPECT_EQ(m.temperature_shape, engine::InputShape::uniform);
    EXPECT_EQ(m.expansion_shape, engine::InputShape::uniform);
    EXPECT_EQ(m.fixture_shape, engine::InputShape::uniform);
    EXPECT_EQ(m.fixture_component, engine::FixtureComponent::given);
    EXPECT_EQ(texts(read_job.warnings), "");

    const engine::RotaryTableMeasurement without = read(small_campaign()).measurement;
    EXPECT_EQ(without.length_uncertainty.resolution, 0.0);
    EXPECT_EQ(without.temperature_shape, engine::InputShape::normal);
    EXPECT_EQ(without.expansion_shape, engine::InputShape::normal);
    EXPECT_EQ(without.fixture_shape, engine::InputShape::normal);
    EXPECT_EQ(without.fixture_component, engine::FixtureComponent::check);
    EXPECT_FALSE(read(small_campaign()).monte_carlo);
}

TEST(RotaryTableJob, ReadsWhichEvaluationIsReported) {
    EXPECT_EQ(read(small_campaign()).coverage, gum::CoverageChoice::as_validated);
    Files files = small_campaign();
    with_key("\"coverage\": \"law_of_propagation\"")(files);
    EXPECT_EQ(read(files).coverage, gum::CoverageChoice::law_of_propagation);
    EXPECT_FALSE(read(files).monte_carlo);
    files = small_campaign();
    with_key("\"coverage\": \"monte_carlo\"")(files);
    EXPECT_EQ(read(files).coverage, gum::CoverageChoice::monte_carlo);
    ASSERT_TRUE(read(files).monte_carlo) << "nothing else asks for trials";
    EXPECT_EQ(read(files).monte_carlo->most_trials, 1'000'000U);
    with_key("\"monte_carlo\": {\"trials\": 300000}")(files);
    EXPECT_EQ(read(files).monte_carlo->trials, 300'000U);
}

TEST(RotaryTableJob, ReadsTheFixtureBudgetWithItsFiles) {
    Files files = small_campaign();
    with_fixture_budget(files);
    const RotaryTableJob job = read(files);
    ASSERT_TRUE(job.fixture_budget);
    EXPECT_EQ(job.fixture_budget_file, "fixture_budget.json");
    EXPECT_EQ(job.fixture_budget->points.size(), 12U);
    EXPECT_THAT(job.files,
                ElementsAre("job.json", "lengths.csv", "stations.csv", "environment.csv", "fixture.csv",
                            "dial_indicator.csv", "dial_indicator.json", "fixture_budget.json", "fixture_points.csv"));
    // The columns of the coordinates file have no part in the covariance, which the application fills in.
    EXPECT_EQ(job.measurement.fixture_covariance.rows(), 12);
    EXPECT_EQ(job.measurement.fixture_covariance.cwiseAbs().maxCoeff(), 0.0);
    ASSERT_EQ(job.stated_fixture_u.size(), 12);
    EXPECT_DOUBLE_EQ(job.stated_fixture_u(1), 0.5e-6);
}

TEST(RotaryTableJob, ReadsAFixtureBudgetOfAnotherFolder) {
    Files files = small_campaign();
    with_fixture_budget(files);
    replace(files.at("job.json"), "fixture_budget.json", "fixture/budget.json");
    files["fixture/budget.json"] = files.extract("fixture_budget.json").mapped();
    files["fixture/fixture_points.csv"] = files.extract("fixture_points.csv").mapped();
    const RotaryTableJob job = read(files);
    EXPECT_THAT(job.files, testing::IsSupersetOf({"fixture/budget.json", "fixture/fixture_points.csv"}));
    // Places of its problems have the folder, too.
    replace(files.at("fixture/fixture_points.csv"), "28.25", "28,25");
    const auto found = refusals(files);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].where, HasSubstr("fixture/fixture_points.csv"));
}

TEST(RotaryTableJob, TellsProblemsOfTheFixtureBudgetWithTheOthers) {
    Files files = small_campaign();
    with_fixture_budget(files);
    replace(files.at("fixture_budget.json"), "\"u\": 0.3", "\"u\": -0.3");
    replace(files.at("job.json"), "\"axis\": \"A\"", "\"axis\": \"X\"");
    const auto found = refusals(files);
    ASSERT_EQ(found.size(), 2U) << texts(found);
    EXPECT_THAT(found[0].where, HasSubstr("job.json#/axis"));
    EXPECT_THAT(found[1].where, HasSubstr("fixture_budget.json#/inputs/d_cmm/u"));
    files.erase("fixture_points.csv");
    EXPECT_THROW((void)read(files), gum::StorageError);
    files.erase("fixture_budget.json");
    EXPECT_THROW((void)read(files), gum::StorageError);
}

TEST(RotaryTableJob, NeedsNoColumnsOfUncertaintyBesideABudgetOrTheSourcePaper) {
    Files files = small_campaign();
    files.at("fixture.csv") =
        "reflector,x_mm,y_mm,z_mm\nR1,33.25,136.5,5.25\nR2,85.5,28.25,72.0\n"
        "R3,152.75,-99.5,117.25\nR4,35.75,-87.5,-0.75\n";
    EXPECT_EQ(refusals(files).front().code, k_csv_missing_column.code);
    Files budget = files;
    with_fixture_budget(budget);
    EXPECT_EQ(read(budget).stated_fixture_u.size(), 0);
    replace(files.at("job.json"), "\"coordinates\"", "\"uncertainty\": \"source_paper\", \"coordinates\"");
    const RotaryTableJob job = read(files);
    EXPECT_TRUE(job.source_paper_fixture);
    const Eigen::MatrixXd& V = job.measurement.fixture_covariance;
    // Eq. (11) at L = 136 500 µm: sqrt(0.401² + 0.045318²) µm; computed with Python's decimal module.
    EXPECT_NEAR(std::sqrt(V(1, 1)), 0.40355262e-6, 1e-14);
    EXPECT_EQ(V(1, 0), 0.0);
}

TEST(RotaryTableJob, ReadsSimulationAndPlan) {
    Files files = small_campaign();
    with_key(R"("simulation": {"runs": 20, "seed": 7, "set_up_offset_um": 5, "set_up_tilt_arcsec": 10,
        "error_linear_um": 3, "error_angular_arcsec": 4, "outliers": {"count": 2, "size_um": 5},
        "angle_counts": [12, 36], "table_repeatability": {"u_linear_um": 0.1, "u_axial_arcsec": 0, "u_tilt_arcsec": 0.3}},
        "plan": {"angles_deg": [180, 0, 90], "senses": "both", "dead_paths": "reflector",
        "targets": {"linear_um": 0.5, "angular_arcsec": 0.7, "range_linear_um": 1, "range_angular_arcsec": 2,
                "location_um": 3, "location_arcsec": 4, "E_arcsec": 5, "R_arcsec": 6, "A_arcsec": 7},
        "keep_met_targets": true, "sight": {"cylinders": [{"name": "table", "radius_mm": 50,
                "along_axis_mm": [-900, -500]}], "boxes": [{"name": "bed", "x_mm": [-900, -800], "y_mm": [0, 10],
                "z_mm": [-5, 5], "turns": false}], "reflector_diameter_mm": 12, "acceptance_angle_deg": 170,
                "facing": [{"reflector": "R1", "direction": [0, 0, 1]}]}, "least_distance_mm": 300,
        "station_region": {"x_mm": [0, 1000], "y_mm": [-500, 500], "z_mm": [0, 0], "step_mm": 100}})")(files);
    const RotaryTableJob job = read(files);
    ASSERT_TRUE(job.simulation);
    const gum::SimulationRequest& s = *job.simulation;
    constexpr double k_arcsecond = std::numbers::pi / 180.0 / 3600.0;
    EXPECT_EQ(s.runs, 20U);
    EXPECT_EQ(s.seed, 7U);
    EXPECT_DOUBLE_EQ(s.set_up_offset, 5e-6);
    EXPECT_DOUBLE_EQ(s.set_up_tilt, 10.0 * k_arcsecond);
    EXPECT_DOUBLE_EQ(s.error_linear, 3e-6);
    EXPECT_DOUBLE_EQ(s.error_angular, 4.0 * k_arcsecond);
    EXPECT_EQ(s.outliers, 2U);
    EXPECT_DOUBLE_EQ(s.outlier_size, 5e-6);
    EXPECT_THAT(s.angle_counts, ElementsAre(12, 36));
    ASSERT_TRUE(s.table_repeatability);
    EXPECT_EQ(s.table_repeatability->mode, engine::RepeatabilityMode::given);
    EXPECT_DOUBLE_EQ(s.table_repeatability->u_linear, 0.1e-6);
    EXPECT_DOUBLE_EQ(s.table_repeatability->u_tilt, 0.3 * k_arcsecond);

    ASSERT_TRUE(job.plan);
    const gum::PlanRequest& p = *job.plan;
    EXPECT_THAT(p.angles_deg, ElementsAre(0, 90, 180));
    EXPECT_TRUE(p.both_senses);
    EXPECT_TRUE(p.dead_path_per_reflector);
    EXPECT_DOUBLE_EQ(p.target_linear, 0.5e-6);
    EXPECT_DOUBLE_EQ(p.target_angular, 0.7 * k_arcsecond);
    EXPECT_DOUBLE_EQ(p.least_distance, 0.3);
    EXPECT_TRUE(p.keep_met_targets);
    EXPECT_DOUBLE_EQ(p.parameter_targets.range_linear.value(), 1e-6);
    EXPECT_DOUBLE_EQ(p.parameter_targets.range_angular.value(), 2.0 * k_arcsecond);
    EXPECT_DOUBLE_EQ(p.parameter_targets.location_linear.value(), 3e-6);
    EXPECT_DOUBLE_EQ(p.parameter_targets.location_angular.value(), 4.0 * k_arcsecond);
    EXPECT_DOUBLE_EQ(p.parameter_targets.systematic.value(), 5.0 * k_arcsecond);
    EXPECT_DOUBLE_EQ(p.parameter_targets.repeatability.value(), 6.0 * k_arcsecond);
    EXPECT_DOUBLE_EQ(p.parameter_targets.accuracy.value(), 7.0 * k_arcsecond);
    ASSERT_EQ(p.sight.obstacles.size(), 2U);
    EXPECT_EQ(p.sight.obstacles[0].name, "table");
    EXPECT_DOUBLE_EQ(p.sight.obstacles[0].radius, 0.05);
    EXPECT_DOUBLE_EQ(p.sight.obstacles[0].low[0], -0.9);
    EXPECT_DOUBLE_EQ(p.sight.obstacles[0].high[2], -0.5);
    EXPECT_TRUE(p.sight.obstacles[0].turns);
    EXPECT_FALSE(p.sight.obstacles[1].turns);
    EXPECT_EQ(p.sight.obstacles[1].radius, 0.0);
    EXPECT_EQ(p.sight.obstacles[1].low, Eigen::Vector3d(-0.9, 0.0, -0.005));
    EXPECT_EQ(p.sight.obstacles[1].high, Eigen::Vector3d(-0.8, 0.01, 0.005));
    EXPECT_DOUBLE_EQ(p.sight.reflector_diameter, 0.012);
    EXPECT_DOUBLE_EQ(p.sight.acceptance_angle.value(), 170.0 * std::numbers::pi / 180.0);
    ASSERT_EQ(p.sight.facing.size(), 1U);
    EXPECT_EQ(p.sight.facing[0].reflector, "R1");
    EXPECT_EQ(p.sight.facing[0].direction, Eigen::Vector3d::UnitZ());
    EXPECT_DOUBLE_EQ(p.station_step, 0.1);
    ASSERT_TRUE(p.station_region);
    EXPECT_EQ((*p.station_region)[0], Eigen::Vector3d(0.0, -0.5, 0.0));
    EXPECT_EQ((*p.station_region)[1], Eigen::Vector3d(1.0, 0.5, 0.0));
    // A plan beside lengths changes nothing of the measurement.
    EXPECT_EQ(job.measurement.angles.size(), 8U);
    EXPECT_EQ(texts(job.warnings), "");
}

TEST(RotaryTableJob, TakesTheDefaultsOfSimulationAndPlan) {
    Files files = small_campaign();
    with_key(R"("simulation": {}, "plan": {})")(files);
    const RotaryTableJob job = read(files);
    EXPECT_EQ(job.simulation->runs, 100U);
    EXPECT_DOUBLE_EQ(job.simulation->set_up_offset, 10e-6);
    EXPECT_EQ(job.simulation->outliers, 0U);
    EXPECT_FALSE(job.simulation->table_repeatability);
    EXPECT_THAT(job.plan->angles_deg, IsEmpty());
    EXPECT_FALSE(job.plan->both_senses);
    EXPECT_FALSE(job.plan->station_region);
}

TEST(RotaryTableJob, ReadsALayoutWithoutLengths) {
    for (const JobUse use : {JobUse::plan, JobUse::simulate}) {
        const RotaryTableJob job = read(small_layout(), use);
        EXPECT_FALSE(job.has_lengths);
        EXPECT_EQ(texts(job.warnings), "");
        const engine::RotaryTableMeasurement& m = job.measurement;
        EXPECT_THAT(m.stations, ElementsAre("P1", "P2", "P3"));
        EXPECT_THAT(m.reflectors, ElementsAre("R1", "R2", "R3", "R4"));
        ASSERT_EQ(m.angles.size(), 12U);
        EXPECT_DOUBLE_EQ(m.angles_deg.front(), -90.0);
        EXPECT_DOUBLE_EQ(m.angles_deg.back(), 240.0);
        EXPECT_DOUBLE_EQ(m.angles.front(), -0.5 * std::numbers::pi);
        EXPECT_EQ(m.home, 3U);
        EXPECT_THAT(m.lengths, IsEmpty());
        EXPECT_THAT(m.passes, IsEmpty());
        EXPECT_THAT(m.dead_paths, IsEmpty());
        ASSERT_EQ(m.station_start.size(), 3U);
        EXPECT_TRUE(m.station_start[1].value().isApprox(Eigen::Vector3d(0.8, -0.7, 0.55), 1e-15));
        EXPECT_DOUBLE_EQ(m.temperature_difference(2), -0.25);
        EXPECT_EQ(job.air.size(), 3U);
    }
    // To evaluate it, lengths are needed.
    const auto found = refusals(small_layout());
    ASSERT_EQ(found.size(), 1U) << texts(found);
    EXPECT_EQ(found[0].code, k_missing_key.code);
    EXPECT_THAT(found[0].what, HasSubstr("\"lengths\""));
    // With lengths, plan and simulate read what evaluate reads.
    const RotaryTableJob measured = read(small_campaign(), JobUse::plan);
    EXPECT_TRUE(measured.has_lengths);
    EXPECT_EQ(measured.measurement.lengths.size(), 192U);
}

TEST(RotaryTableJob, ReadsALayoutWithoutEnvironment) {
    Files files = small_layout();
    replace(files.at("job.json"), ", \"environment\": \"environment.csv\"", "");
    const RotaryTableJob job = read(files, JobUse::plan);
    EXPECT_EQ(job.measurement.temperature_difference, Eigen::VectorXd::Zero(3));
    EXPECT_EQ(job.measurement.u_temperature, Eigen::VectorXd::Zero(3));
}

TEST(RotaryTableJob, RefusesALayoutThatIsNotComplete) {
    const auto one = [](const std::function<void(Files&)>& spoil, const InputCode& code, const std::string& message) {
        Files files = small_layout();
        spoil(files);
        const auto found = refusals(files, JobUse::plan);
        ASSERT_EQ(found.size(), 1U) << message << "\n" << texts(found);
        EXPECT_EQ(found[0].code, code.code);
        EXPECT_THAT(gum::message(found[0]), HasSubstr(message));
    };
    one(with("job.json", "\"stations\": \"stations.csv\", ", ""), k_layout_incomplete,
        "neither lengths nor stations are given");
    one(with("job.json", "\"plan\": { \"angles_deg\": {\"first\": -90, \"step\": 30, \"count\": 12} }",
             "\"notes\": \"\""),
        k_layout_incomplete, "neither lengths nor planned angles are given");
    one(with("job.json", "\"angles_deg\": {\"first\": -90, \"step\": 30, \"count\": 12}", ""), k_layout_incomplete,
        "neither lengths nor planned angles are given");
    one(with("job.json", "\"count\": 12", "\"count\": 1.5"), k_not_an_integer, "must be a whole number");
    one(with("job.json", "-90", "-80"), k_home_not_measured, "the home angle 0° (the default) is not planned");
    one(with("job.json", "{\"first\": -90, \"step\": 30, \"count\": 12}",
             "[0, 0.5235987756, 1.0471975512, 1.5707963268, 2.0943951024, 2.6179938780, 3.1415926536]"),
        k_angles_in_radians, "taken as radians");
    one(with("job.json", "\"count\": 12", "\"count\": 120000"), k_number_out_of_range, "100000");
    one(with("job.json", "\"step\": 30, \"count\": 12", "\"step\": 0.001, \"count\": 100000"), k_layout_too_large,
        "1200000 distances");
    one(
        [](Files& files) {
            with_key("\"simulation\": {\"angle_counts\": [12, 36000]}")(files);
            files.at("stations.csv") += "P4,1300,200,100,20\n";
            files.at("environment.csv") += "P4,20,0.04,20.1,1010.0,51\n";
        },
        k_layout_too_large, "1152000 distances");
    one(with_content("stations.csv", "station,x_mm,y_mm,z_mm\nP1,500,-800,-300\n"), k_too_few_at_angle,
        "1 station and 4 reflectors");
    one(with("environment.csv", "P3,", "P4,"), k_unknown_station, "the station \"P3\" has no row in environment.csv");
}

TEST(RotaryTableJob, WarnsOfUncertaintiesThatLookLikeThoseInAnotherUnit) {
    const auto warned = [](Files files, const std::string& file, const std::string& old_text,
                           const std::string& new_text, JobUse use = JobUse::evaluate) {
        replace_all(files.at(file), old_text, new_text);
        std::vector<std::string> messages;
        for (const gum::Diagnostic& warning : read(files, use).warnings) {
            messages.push_back(warning.code + " " + gum::message(warning));
        }
        return messages;
    };
    const auto one = [&](const std::string& part) {
        return ElementsAre(testing::AllOf(HasSubstr(k_warn_unlikely_uncertainty.code), HasSubstr(part)));
    };
    EXPECT_THAT(warned(small_campaign(), "fixture.csv", "0.4,0.5,0.4", "0.4,0.5,0.4"), IsEmpty());
    EXPECT_THAT(warned(small_campaign(), "fixture.csv", ",0.", ",0.000"),
                one("the columns u_x_um, u_y_um and u_z_um are in micrometres"));
    EXPECT_THAT(warned(small_campaign(), "environment.csv", ",0.0", ",4"),
                one("the column u_temperature_K is in kelvin"));
    // Lengths that were measured have a step, which says more.
    EXPECT_THAT(warned(small_layout(), "job.json", "\"u_constant_um\": 0.", "\"u_constant_um\": 0.000", JobUse::plan),
                one("u_constant_um is in micrometres"));
}

TEST(RotaryTableJob, WarnsOfTemperaturesThatAreAllFarFromTheReference) {
    const auto warned = [](const std::string& reference, double temperature) {
        Files files = small_campaign();
        std::string rows = "station,fixture_temperature_degC,u_temperature_K\n";
        for (const char* station : {"P1", "P2", "P3"}) {
            rows += std::string(station) + "," + std::to_string(temperature) + ",0.04\n";
        }
        files.at("environment.csv") = rows;
        if (!reference.empty()) {
            replace(files.at("job.json"), "\"coordinates\": \"fixture.csv\"",
                    "\"coordinates\": \"fixture.csv\", \"reference_temperature_degC\": " + reference);
        }
        return read(files).warnings;
    };
    EXPECT_THAT(warned("", 38.0), IsEmpty());
    EXPECT_THAT(warned("68", 68.5), IsEmpty()) << "a laboratory may refer its fixture to another temperature";
    for (const auto& warnings : {warned("", 68.5), warned("68", 20.2)}) {
        ASSERT_EQ(warnings.size(), 1U) << texts(warnings);
        EXPECT_EQ(warnings[0].code, k_warn_far_temperatures.code);
        EXPECT_THAT(gum::message(warnings[0]), HasSubstr("68 °F are 20 °C"));
    }
    // The least distance, rounded towards the reference: no temperature is nearer than is said.
    EXPECT_THAT(gum::message(warned("", 68.5)[0]), HasSubstr("is 48 K and more"));
    EXPECT_THAT(gum::message(warned("", 40.6)[0]), HasSubstr("is 20 K and more"));
    EXPECT_THAT(gum::message(warned("", -0.6)[0]), HasSubstr("is 20 K and more"));
}

TEST(RotaryTableJob, WarnsOfKeysThatAreNotUsed) {
    const auto only_warning = [](const std::function<void(Files&)>& change, const std::string& message) {
        Files files = small_campaign();
        change(files);
        const RotaryTableJob job = read(files);
        ASSERT_EQ(job.warnings.size(), 1U) << message << "\n" << texts(job.warnings);
        EXPECT_EQ(job.warnings[0].code, k_warn_unused_value.code);
        EXPECT_THAT(gum::message(job.warnings[0]), HasSubstr(message));
    };
    only_warning(with_key("\"plan\": {\"keep_met_targets\": true}"), "keep_met_targets is not used");
    only_warning(with_key("\"plan\": {\"sight\": {\"acceptance_angle_deg\": 30}}"), "acceptance_angle_deg is not used");
    only_warning(with_key("\"plan\": {\"sight\": {\"facing\": [{\"reflector\": \"R1\", \"direction\": [1, 0, 0]}]}}"),
                 "facing is not used");
    only_warning(with_key("\"simulation\": {\"outliers\": {\"count\": 0, \"size_um\": 5}}"),
                 "size_um 5 µm is not used");
    Files files = small_campaign();
    replace(files.at("job.json"), "\"environment\": \"environment.csv\"", "\"temperature_distribution\": \"uniform\"");
    EXPECT_THAT(texts(read(files).warnings), HasSubstr("temperature_distribution is not used"));
}

// With a lengths file keys of a plan may be without use: which ones depends on what is made of the job.
TEST(RotaryTableJob, WarnsOfKeysOfAPlanThatMeasuredLengthsLeaveWithoutUse) {
    const auto warned = [](const char* plan, JobUse use) {
        Files files = small_campaign();
        with_key(std::string("\"plan\": ") + plan)(files);
        return texts(read(files, use).warnings);
    };
    const char* without_angles = R"({"senses": "both", "dead_paths": "reflector"})";
    for (const char* key : {"senses", "dead_paths"}) {
        const std::string unused = std::string("job.json#/plan/") + key;
        for (const JobUse use : {JobUse::plan, JobUse::simulate}) {
            EXPECT_THAT(warned(without_angles, use), HasSubstr(unused));
        }
        EXPECT_THAT(
            warned(R"({"angles_deg": [0, 90, 180], "senses": "both", "dead_paths": "reflector"})", JobUse::plan),
            Not(HasSubstr(unused)));
    }
    EXPECT_THAT(warned(R"({"angles_deg": [0, 90, 180]})", JobUse::simulate), HasSubstr("angles_deg is not used"));
    // A plan leaves out what is hidden, of the distances of a file, too.
    const char* with_sight = R"({"sight": {"reflector_diameter_mm": 12.7}})";
    EXPECT_THAT(warned(with_sight, JobUse::simulate), HasSubstr("sight is not used"));
    EXPECT_THAT(warned(with_sight, JobUse::plan), Not(HasSubstr("sight is not used")));
    Files full_turns = small_campaign();
    with_key(std::string("\"simulation\": {\"angle_counts\": [12]}, \"plan\": ") + with_sight)(full_turns);
    EXPECT_THAT(texts(read(full_turns, JobUse::simulate).warnings), Not(HasSubstr("sight is not used")));
    EXPECT_EQ(warned(without_angles, JobUse::evaluate), "") << "a plan beside what is evaluated";
}

TEST(RotaryTableJob, TakesAReversalByAngleOfAPlanInBothSenses) {
    Files files = small_layout();
    with_key(R"("reversal": "by_angle")")(files);
    const auto found = refusals(files, JobUse::plan);
    ASSERT_EQ(found.size(), 1U) << texts(found);
    EXPECT_EQ(found[0].what, "one sense of approach is planned");
    replace(files.at("job.json"), "\"count\": 12}", "\"count\": 12}, \"senses\": \"both\"");
    EXPECT_NO_THROW((void)read(files, JobUse::plan));
}

TEST(RotaryTableJob, WarnsOfAPlanBelowHalfATurn) {
    Files files = small_layout();
    replace(files.at("job.json"), "\"count\": 12", "\"count\": 5");
    const RotaryTableJob job = read(files, JobUse::plan);
    ASSERT_EQ(job.warnings.size(), 1U);
    EXPECT_EQ(job.warnings[0].code, k_warn_angle_span.code);
}

}  // namespace
}  // namespace gumcert::jobs
