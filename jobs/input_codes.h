#pragma once

#include <array>
#include <string_view>

namespace gumcert::jobs {

/// A kind of trouble with an input: a code that stays the same across releases, and what it means, in one line.
struct InputCode {
    std::string_view code;
    std::string_view meaning;
};

// Text of any file.
inline constexpr InputCode k_file_too_large{"GC-INPUT-0001", "the file is larger than 64 MiB"};
inline constexpr InputCode k_not_utf8{"GC-INPUT-0002", "a byte sequence is not UTF-8"};
inline constexpr InputCode k_utf16{"GC-INPUT-0003", "the file is UTF-16 or UTF-32"};
inline constexpr InputCode k_nul_character{"GC-INPUT-0004", "a NUL character in the text"};
inline constexpr InputCode k_lone_carriage_return{"GC-INPUT-0005", "a carriage return without a line feed"};
inline constexpr InputCode k_empty_file{"GC-INPUT-0006", "the file has no content"};

// JSON documents.
inline constexpr InputCode k_json_syntax{"GC-INPUT-0010", "the text is not JSON"};
inline constexpr InputCode k_json_depth{"GC-INPUT-0011", "objects and arrays are nested too deep"};
inline constexpr InputCode k_json_duplicate_key{"GC-INPUT-0012", "a key occurs twice in one object"};
inline constexpr InputCode k_json_number_range{"GC-INPUT-0013", "a number is outside the range of double precision"};
inline constexpr InputCode k_json_inexact_integer{"GC-INPUT-0014", "an integer has no exact double precision value"};
inline constexpr InputCode k_json_string_too_long{"GC-INPUT-0015", "a string is longer than 1 MiB"};
inline constexpr InputCode k_json_not_finite{"GC-INPUT-0016", "NaN or Infinity where a number is expected"};
inline constexpr InputCode k_json_trailing_text{"GC-INPUT-0017", "text after the end of the document"};
inline constexpr InputCode k_json_too_many_values{"GC-INPUT-0018", "the document has too many values"};
inline constexpr InputCode k_json_comment{"GC-INPUT-0019", "a comment that does not begin with //"};
inline constexpr InputCode k_missing_key{"GC-INPUT-0020", "a required key is missing"};
inline constexpr InputCode k_wrong_type{"GC-INPUT-0021", "a value has another JSON type than its key demands"};
inline constexpr InputCode k_unknown_key{"GC-INPUT-0022", "a key that the program does not know"};
inline constexpr InputCode k_number_out_of_range{"GC-INPUT-0023", "a number is outside the range that its key allows"};
inline constexpr InputCode k_not_an_integer{"GC-INPUT-0024", "a number with a fraction where an integer is expected"};
inline constexpr InputCode k_unknown_choice{"GC-INPUT-0025", "a word that is none of the choices of its key"};
inline constexpr InputCode k_text_not_allowed{"GC-INPUT-0026", "a text is empty, too long or has hidden characters"};
inline constexpr InputCode k_wrong_schema{"GC-INPUT-0027", "the schema is not gumcert/job/1"};
inline constexpr InputCode k_wrong_kind{"GC-INPUT-0028", "the kind of the job is not the one expected"};
inline constexpr InputCode k_file_name{"GC-INPUT-0029", "a file name is not a path relative to the job file"};
inline constexpr InputCode k_wrong_size{"GC-INPUT-0030", "an array has another number of elements than demanded"};

// CSV tables.
inline constexpr InputCode k_csv_no_rows{"GC-INPUT-0100", "a table has a header and no rows"};
inline constexpr InputCode k_csv_separator{"GC-INPUT-0101", "the columns are not separated by commas"};
inline constexpr InputCode k_csv_missing_column{"GC-INPUT-0102", "a required column is missing"};
inline constexpr InputCode k_csv_repeated_column{"GC-INPUT-0103", "a column occurs twice"};
inline constexpr InputCode k_csv_ragged_row{"GC-INPUT-0104", "a row has another number of fields than the header"};
inline constexpr InputCode k_csv_decimal_comma{"GC-INPUT-0105", "a number seems to be written with a decimal comma"};
inline constexpr InputCode k_csv_quote{"GC-INPUT-0106", "double quotes are not used as RFC 4180 demands"};
inline constexpr InputCode k_csv_too_many_rows{"GC-INPUT-0107", "a table has too many rows"};
inline constexpr InputCode k_csv_not_a_number{"GC-INPUT-0108", "text where a number is expected"};
inline constexpr InputCode k_csv_not_finite{"GC-INPUT-0109", "NaN or infinity where a number is expected"};
inline constexpr InputCode k_csv_number_range{"GC-INPUT-0110", "a number is outside the range of double precision"};
inline constexpr InputCode k_csv_missing_value{"GC-INPUT-0111", "an empty cell where a value is required"};
inline constexpr InputCode k_csv_out_of_range{"GC-INPUT-0112", "a number is outside the range that its column allows"};
inline constexpr InputCode k_csv_not_an_integer{"GC-INPUT-0113",
                                                "a number with a fraction where an integer is expected"};
inline constexpr InputCode k_csv_unknown_choice{"GC-INPUT-0114", "a word that is none of the choices of its column"};
inline constexpr InputCode k_csv_name{"GC-INPUT-0115",
                                      "a name is too long or has spaces around it or hidden characters"};
inline constexpr InputCode k_csv_matrix_size{"GC-INPUT-0116", "a matrix has another number of rows than demanded"};
inline constexpr InputCode k_csv_too_many_columns{"GC-INPUT-0117", "a row has more than 10000 fields"};

// Rotary-table jobs. GC-INPUT-0200 is retired and not given again: it refused Monte Carlo of a rotary_table job.
inline constexpr InputCode k_scale_without_u{"GC-INPUT-0201", "scale_model prior without scale_u"};
inline constexpr InputCode k_no_length_uncertainty{"GC-INPUT-0202", "both parts of the length uncertainty are zero"};
inline constexpr InputCode k_no_repeatability{"GC-INPUT-0203", "table_repeatability given without a value above zero"};
inline constexpr InputCode k_unknown_reflector{"GC-INPUT-0204",
                                               "a reflector of the lengths is not in the fixture file"};
inline constexpr InputCode k_unknown_station{"GC-INPUT-0205",
                                             "a station of the lengths is not in the environment file"};
inline constexpr InputCode k_repeated_name{"GC-INPUT-0206", "a reflector or station has two rows in one file"};
inline constexpr InputCode k_repeated_length{"GC-INPUT-0207", "a distance occurs twice"};
inline constexpr InputCode k_pass_of_two_stations{"GC-INPUT-0208", "one pass with two stations"};
inline constexpr InputCode k_pass_of_two_directions{"GC-INPUT-0209", "one pass with two directions"};
inline constexpr InputCode k_dead_path_of_two_stations{"GC-INPUT-0210", "one dead path with two stations"};
inline constexpr InputCode k_angles_in_radians{"GC-INPUT-0211", "the angles seem to be radians"};
inline constexpr InputCode k_too_few_at_angle{"GC-INPUT-0212", "fewer than 6 distances at an angle"};
inline constexpr InputCode k_too_few_of_station{"GC-INPUT-0213", "fewer than 4 distances of a station"};
inline constexpr InputCode k_too_few_reflectors{"GC-INPUT-0214", "fewer than 3 reflectors"};
inline constexpr InputCode k_lengths_in_metres{"GC-INPUT-0215", "the lengths seem to be metres"};
inline constexpr InputCode k_coordinates_in_metres{"GC-INPUT-0216", "the coordinates seem to be metres"};
inline constexpr InputCode k_home_not_measured{"GC-INPUT-0217", "the home angle is not among the measured angles"};
inline constexpr InputCode k_covariance_not_symmetric{"GC-INPUT-0218", "the fixture covariance is not symmetric"};
inline constexpr InputCode k_covariance_not_positive{"GC-INPUT-0219",
                                                     "the fixture covariance is not positive semi-definite"};
inline constexpr InputCode k_reading_at_unknown_angle{"GC-INPUT-0220", "a dial indicator angle that was not measured"};
inline constexpr InputCode k_repeated_reading{"GC-INPUT-0221", "a dial indicator reading occurs twice"};
inline constexpr InputCode k_no_indicator_uncertainty{"GC-INPUT-0222", "nothing is known of the dial indicator"};
inline constexpr InputCode k_too_many_reflectors{"GC-INPUT-0223", "more than 500 reflectors"};
inline constexpr InputCode k_fixture_keys_exclude{"GC-INPUT-0224", "keys of the fixture that exclude each other"};
inline constexpr InputCode k_fixture_budget_points{"GC-INPUT-0225",
                                                   "points of the fixture budget that are not the coordinates"};
inline constexpr InputCode k_layout_incomplete{"GC-INPUT-0226", "neither measured lengths nor a complete layout"};
inline constexpr InputCode k_repeated_angle{"GC-INPUT-0227", "a planned angle occurs twice"};
inline constexpr InputCode k_limits_reversed{"GC-INPUT-0228", "a lower limit above the upper one"};
inline constexpr InputCode k_layout_too_large{"GC-INPUT-0229", "a layout or a study that is larger than allowed"};
inline constexpr InputCode k_bad_exclusion{"GC-INPUT-0232", "an exclusion that names no distance, or has no reason"};
inline constexpr InputCode k_rounded_lengths{"GC-INPUT-0233",
                                             "lengths rounded by far more than their stated uncertainty"};
inline constexpr InputCode k_bad_machine_frame{"GC-INPUT-0236", "points that do not tell the frame of the machine"};
inline constexpr InputCode k_bad_reversal{"GC-INPUT-0237", "a reversal that the measurement cannot tell"};

// Budget jobs.
inline constexpr InputCode k_no_statement{"GC-INPUT-0300", "an input without a statement of what is known of it"};
inline constexpr InputCode k_two_statements{"GC-INPUT-0301", "keys that do not belong to one statement"};
inline constexpr InputCode k_incomplete_statement{"GC-INPUT-0302", "a statement that lacks a key"};
inline constexpr InputCode k_quantity_name{"GC-INPUT-0303", "a name that cannot stand in an equation"};
inline constexpr InputCode k_name_of_two{"GC-INPUT-0304", "one name for two quantities"};
inline constexpr InputCode k_no_uncertainty{"GC-INPUT-0305", "an uncertainty of 0 that nobody stated on purpose"};
inline constexpr InputCode k_not_representable{"GC-INPUT-0306",
                                               "a quantity beyond what the program computes with, in SI"};
inline constexpr InputCode k_too_few_values{"GC-INPUT-0307", "too few observations, samples or groups"};
inline constexpr InputCode k_unknown_quantity{"GC-INPUT-0308", "a name that is none of the inputs"};
inline constexpr InputCode k_correlation_with_itself{"GC-INPUT-0309", "a correlation of an input with itself"};
inline constexpr InputCode k_repeated_correlation{"GC-INPUT-0310", "two correlations of one pair"};
inline constexpr InputCode k_correlation_of_constant{"GC-INPUT-0311", "a correlation of a constant"};
inline constexpr InputCode k_correlation_not_positive{"GC-INPUT-0312", "correlations that cannot hold together"};
inline constexpr InputCode k_covariance_diagonal{"GC-INPUT-0313",
                                                 "a variance that differs from the square of the stated uncertainty"};
inline constexpr InputCode k_matrix_not_symmetric{"GC-INPUT-0314", "a covariance matrix that is not symmetric"};
inline constexpr InputCode k_not_simultaneous{"GC-INPUT-0315", "inputs that cannot have been observed together"};
inline constexpr InputCode k_distribution_does_not_fit{"GC-INPUT-0316",
                                                       "a distribution that does not belong to its statement"};
inline constexpr InputCode k_empty_interval{"GC-INPUT-0317", "two limits without a distance between them"};
inline constexpr InputCode k_unit_does_not_fit{"GC-INPUT-0318", "a unit of another kind than needed"};
inline constexpr InputCode k_too_few_trials{"GC-INPUT-0319",
                                            "fewer Monte Carlo trials than the coverage interval needs"};
inline constexpr InputCode k_trials_and_adaptive{"GC-INPUT-0320", "Monte Carlo options that exclude each other"};
inline constexpr InputCode k_nothing_to_evaluate{"GC-INPUT-0321", "a job without a quantity to evaluate"};
inline constexpr InputCode k_point_of_fit{"GC-INPUT-0322", "a point of the table that states a parameter of a fit"};
inline constexpr InputCode k_repeated_point{"GC-INPUT-0323", "two points of one name"};
inline constexpr InputCode k_too_many_quantities{"GC-INPUT-0324", "more inputs, points or correlations than allowed"};
inline constexpr InputCode k_fit_name{"GC-INPUT-0325",
                                      "a name in the equation of a fit that is no parameter and no column"};
inline constexpr InputCode k_fit_data{"GC-INPUT-0326", "data of a fit that are too few or differ in length"};
inline constexpr InputCode k_fit_start{"GC-INPUT-0327", "a parameter of a fit without the start value that it needs"};
inline constexpr InputCode k_fit_uncertainty{"GC-INPUT-0328", "uncertainties of a fit that cannot be used together"};
inline constexpr InputCode k_no_relative_uncertainty{"GC-INPUT-0329",
                                                     "a relative uncertainty where the scale has an origin of its own"};
inline constexpr InputCode k_covariance_not_definite{"GC-INPUT-0330",
                                                     "a covariance of data that is not positive definite"};
inline constexpr InputCode k_output_unknown{"GC-INPUT-0331", "an output that neither the model nor the inputs have"};
inline constexpr InputCode k_equation_text{"GC-INPUT-0332", "an equation that is not one line of text"};
inline constexpr InputCode k_empty_cell{"GC-INPUT-0340", "an empty cell in a table of points"};
inline constexpr InputCode k_digits_lost{"GC-INPUT-0341",
                                         "a number with more digits than can be held beside its uncertainty"};
inline constexpr InputCode k_point_column{"GC-INPUT-0360", "a column of points that cannot be declared so"};
inline constexpr InputCode k_table_column{"GC-INPUT-0361", "a column that a table cannot show"};
inline constexpr InputCode k_table_incomplete{"GC-INPUT-0362",
                                              "tables that leave out points, or what belongs to a result"};
inline constexpr InputCode k_point_without_limit{"GC-INPUT-0363", "a point without the limits of its specification"};
inline constexpr InputCode k_sections_of_budget{"GC-INPUT-0364",
                                                "a budget with sections where one with one set of results is expected"};
inline constexpr InputCode k_sections_of_other_kind{"GC-INPUT-0365", "sections of another kind than budgets"};
inline constexpr InputCode k_shared_equation{"GC-INPUT-0366", "an equation that the sections of a job cannot share"};
inline constexpr InputCode k_limits_not_meant{"GC-INPUT-0367", "limits that cannot be meant for the points of a job"};
inline constexpr InputCode k_angle_in_parts{"GC-INPUT-0368", "degrees, minutes and seconds where they cannot stand"};

// Files, disks and stores.
inline constexpr InputCode k_file_not_readable{"GC-STORAGE-0001", "a file cannot be opened or read"};
inline constexpr InputCode k_file_leads_out{"GC-STORAGE-0002", "a symbolic link leads out of the folder of a name"};

// Warnings: the input is accepted, and a person should look at it.
inline constexpr InputCode k_warn_extra_column{"GC-WARN-0001", "a column that the program does not use"};
inline constexpr InputCode k_warn_unused_station{"GC-WARN-0002", "a station without a single distance"};
inline constexpr InputCode k_warn_unused_reflector{"GC-WARN-0003", "a reflector without a single distance"};
inline constexpr InputCode k_warn_angle_span{"GC-WARN-0004", "the angles span less than half a turn"};
inline constexpr InputCode k_warn_no_environment{
    "GC-WARN-0005", "no environment file: the fixture is taken to be at its reference temperature"};
inline constexpr InputCode k_warn_unused_value{"GC-WARN-0006", "a value that the chosen option does not use"};
inline constexpr InputCode k_warn_covariance_differs{"GC-WARN-0007", "covariance and u columns of the fixture differ"};
inline constexpr InputCode k_warn_unused_input{"GC-WARN-0008", "an input that no result depends on"};
inline constexpr InputCode k_warn_same_but_case{"GC-WARN-0009", "names that differ by capital letters only"};
inline constexpr InputCode k_warn_few_trials{"GC-WARN-0010", "fewer Monte Carlo trials than recommended"};
inline constexpr InputCode k_warn_equal_observations{"GC-WARN-0011", "observations that are all equal"};
inline constexpr InputCode k_warn_same_position{"GC-WARN-0013", "two angles that are one position of the table"};
inline constexpr InputCode k_warn_correlations_repaired{"GC-WARN-0014",
                                                        "correlations that hold together within their digits only"};
inline constexpr InputCode k_warn_beyond_range{"GC-WARN-0015", "a reading beyond the range of its specification"};
inline constexpr InputCode k_warn_step_passed{"GC-WARN-0016",
                                              "a measured value that passes the end of a step of limits"};
inline constexpr InputCode k_warn_range_of_no_point{"GC-WARN-0017", "the accuracy of a range that no point has"};
inline constexpr InputCode k_warn_point_not_shown{"GC-WARN-0018", "a specified point whose row a table does not name"};
inline constexpr InputCode k_warn_roles_without_points{"GC-WARN-0019", "roles of quantities in a job without points"};
inline constexpr InputCode k_warn_rounded_lengths{"GC-WARN-0026",
                                                  "lengths rounded by more than their stated uncertainty"};
inline constexpr InputCode k_warn_rounded_alike{"GC-WARN-0027", "repeated lengths that are rounded alike"};
inline constexpr InputCode k_warn_unlikely_uncertainty{"GC-WARN-0028",
                                                       "an uncertainty that looks like one in another unit"};
inline constexpr InputCode k_warn_far_temperatures{"GC-WARN-0029", "temperatures far from that of the reference"};
inline constexpr InputCode k_warn_unusual_coverage_factor{"GC-WARN-0021",
                                                          "a coverage factor that is perhaps a coverage probability"};

/// The whole table, in the order of the codes.
inline constexpr std::array k_input_codes{k_file_too_large,
                                          k_not_utf8,
                                          k_utf16,
                                          k_nul_character,
                                          k_lone_carriage_return,
                                          k_empty_file,
                                          k_json_syntax,
                                          k_json_depth,
                                          k_json_duplicate_key,
                                          k_json_number_range,
                                          k_json_inexact_integer,
                                          k_json_string_too_long,
                                          k_json_not_finite,
                                          k_json_trailing_text,
                                          k_json_too_many_values,
                                          k_json_comment,
                                          k_missing_key,
                                          k_wrong_type,
                                          k_unknown_key,
                                          k_number_out_of_range,
                                          k_not_an_integer,
                                          k_unknown_choice,
                                          k_text_not_allowed,
                                          k_wrong_schema,
                                          k_wrong_kind,
                                          k_file_name,
                                          k_wrong_size,
                                          k_csv_no_rows,
                                          k_csv_separator,
                                          k_csv_missing_column,
                                          k_csv_repeated_column,
                                          k_csv_ragged_row,
                                          k_csv_decimal_comma,
                                          k_csv_quote,
                                          k_csv_too_many_rows,
                                          k_csv_not_a_number,
                                          k_csv_not_finite,
                                          k_csv_number_range,
                                          k_csv_missing_value,
                                          k_csv_out_of_range,
                                          k_csv_not_an_integer,
                                          k_csv_unknown_choice,
                                          k_csv_name,
                                          k_csv_matrix_size,
                                          k_csv_too_many_columns,
                                          k_scale_without_u,
                                          k_no_length_uncertainty,
                                          k_no_repeatability,
                                          k_unknown_reflector,
                                          k_unknown_station,
                                          k_repeated_name,
                                          k_repeated_length,
                                          k_pass_of_two_stations,
                                          k_pass_of_two_directions,
                                          k_dead_path_of_two_stations,
                                          k_angles_in_radians,
                                          k_too_few_at_angle,
                                          k_too_few_of_station,
                                          k_too_few_reflectors,
                                          k_lengths_in_metres,
                                          k_coordinates_in_metres,
                                          k_home_not_measured,
                                          k_covariance_not_symmetric,
                                          k_covariance_not_positive,
                                          k_reading_at_unknown_angle,
                                          k_repeated_reading,
                                          k_no_indicator_uncertainty,
                                          k_too_many_reflectors,
                                          k_fixture_keys_exclude,
                                          k_fixture_budget_points,
                                          k_layout_incomplete,
                                          k_repeated_angle,
                                          k_limits_reversed,
                                          k_layout_too_large,
                                          k_bad_exclusion,
                                          k_rounded_lengths,
                                          k_bad_machine_frame,
                                          k_bad_reversal,
                                          k_no_statement,
                                          k_two_statements,
                                          k_incomplete_statement,
                                          k_quantity_name,
                                          k_name_of_two,
                                          k_no_uncertainty,
                                          k_not_representable,
                                          k_too_few_values,
                                          k_unknown_quantity,
                                          k_correlation_with_itself,
                                          k_repeated_correlation,
                                          k_correlation_of_constant,
                                          k_correlation_not_positive,
                                          k_covariance_diagonal,
                                          k_matrix_not_symmetric,
                                          k_not_simultaneous,
                                          k_distribution_does_not_fit,
                                          k_empty_interval,
                                          k_unit_does_not_fit,
                                          k_too_few_trials,
                                          k_trials_and_adaptive,
                                          k_nothing_to_evaluate,
                                          k_point_of_fit,
                                          k_repeated_point,
                                          k_too_many_quantities,
                                          k_fit_name,
                                          k_fit_data,
                                          k_fit_start,
                                          k_fit_uncertainty,
                                          k_no_relative_uncertainty,
                                          k_covariance_not_definite,
                                          k_output_unknown,
                                          k_equation_text,
                                          k_empty_cell,
                                          k_digits_lost,
                                          k_point_column,
                                          k_table_column,
                                          k_table_incomplete,
                                          k_point_without_limit,
                                          k_sections_of_budget,
                                          k_sections_of_other_kind,
                                          k_shared_equation,
                                          k_limits_not_meant,
                                          k_angle_in_parts,
                                          k_file_not_readable,
                                          k_file_leads_out,
                                          k_warn_extra_column,
                                          k_warn_unused_station,
                                          k_warn_unused_reflector,
                                          k_warn_angle_span,
                                          k_warn_no_environment,
                                          k_warn_unused_value,
                                          k_warn_covariance_differs,
                                          k_warn_unused_input,
                                          k_warn_same_but_case,
                                          k_warn_few_trials,
                                          k_warn_equal_observations,
                                          k_warn_same_position,
                                          k_warn_correlations_repaired,
                                          k_warn_beyond_range,
                                          k_warn_step_passed,
                                          k_warn_range_of_no_point,
                                          k_warn_point_not_shown,
                                          k_warn_rounded_lengths,
                                          k_warn_rounded_alike,
                                          k_warn_unlikely_uncertainty,
                                          k_warn_far_temperatures};

}  // namespace gumcert::jobs
