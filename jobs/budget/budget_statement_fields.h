#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/piece_roles.h"
#include "certificate/point_tables.h"
#include "gum/quantity/distribution.h"
#include "jobs/job_common_fields.h"
#include "jobs/job_fields.h"

// The descriptions of what a budget job states of inputs and fits (jobs/job_fields.h), in the unit of the input. The keys
// exclude each other; which statement they make is decided by code (jobs/budget/budget_statement.h), which reads them.

namespace gumcert::jobs {

// Objects that code reads without a struct.
struct PooledStatement {};
struct GroupsStatement {};
struct SamplesStatement {};
struct DistributionStatement {};
struct SpecificationStatement {};
struct ComponentStatement {};
/// What differs at one point of a table.
struct OverrideStatement {};
struct InputStatement {};
struct ParameterStatement {};
struct FitStatement {};
struct CovarianceStatement {};

/// Distributions between two limits.
inline constexpr Words<gum::DistributionKind, 7> k_bounded_words{
    {{"uniform", gum::DistributionKind::uniform},
     {"rectangular", gum::DistributionKind::uniform},
     {"triangular", gum::DistributionKind::triangular},
     {"arcsine", gum::DistributionKind::arcsine},
     {"u_shaped", gum::DistributionKind::arcsine},
     {"trapezoidal", gum::DistributionKind::trapezoidal},
     {"curvilinear_trapezoid", gum::DistributionKind::curvilinear_trapezoid}}};
/// Of them, those without a parameter more.
inline constexpr auto k_plain_bounded_words = [] {
    Words<gum::DistributionKind, 5> words{};
    for (std::size_t i = 0; i < words.size(); ++i) {
        words[i] = k_bounded_words[i];
    }
    return words;
}();

/// The keys of one kind of distribution object.
struct DistributionForm {
    std::string_view kind;
    std::array<std::string_view, 6> keys;  ///< required ones first
    std::size_t required;
};
inline constexpr std::array<DistributionForm, 16> k_distribution_forms{
    {{"normal", {"mean", "sd"}, 2},
     {"uniform", {"lower", "upper"}, 2},
     {"rectangular", {"lower", "upper"}, 2},
     {"triangular", {"lower", "upper"}, 2},
     {"arcsine", {"lower", "upper"}, 2},
     {"u_shaped", {"lower", "upper"}, 2},
     {"trapezoidal", {"lower", "upper", "beta"}, 3},
     {"curvilinear_trapezoid", {"lower", "upper", "d"}, 3},
     {"student_t", {"location", "scale", "nu"}, 3},
     {"t", {"location", "scale", "nu"}, 3},
     {"gamma", {"shape", "scale", "location"}, 2},
     {"exponential", {"mean"}, 1},
     {"lognormal", {"mu", "sigma"}, 2},
     {"beta", {"alpha", "beta", "lower", "upper"}, 2},
     {"poisson_counts", {"counts"}, 1},
     {"constant", {"value"}, 1}}};

inline constexpr std::size_t k_most_inputs = 10'000;
inline constexpr std::size_t k_most_components = 1000;
inline constexpr std::size_t k_least_samples = 100;
inline constexpr In k_number{};
inline constexpr std::size_t k_longest_angle = 64;  ///< bytes of "12° 30' 05.0\""
inline constexpr In k_above_zero{above_zero("")};
inline constexpr In k_not_negative{not_negative("")};
inline constexpr In k_ratio{{.low = 0.0, .high = 1.0, .low_open = true}};
inline constexpr Line k_equation{65'536};
inline constexpr Several k_matrix{Several{k_number}, 0};

template <class Archive>
void describe_unit(Archive& a) {
    a.by_hand("unit", R"({"$ref": "#/definitions/name"})", "a unit",
              "A unit (docs/budget_job.md), e.g. um, nm/K, degC; 1 when left out.");
}

template <class Archive>
void describe(Archive& a, PooledStatement&) {
    a.definition("budget_pooled");
    a.needed_by_code("s", k_above_zero, "Standard deviation of one observation.");
    a.needed_by_code("nu", k_degrees_of_freedom, "Its degrees of freedom.");
}

template <class Archive>
void describe(Archive& a, GroupsStatement&) {
    a.definition("budget_groups");
    a.needed_by_code("means", Several{k_number}, "Of each group.");
    a.needed_by_code("standard_deviations", Several{k_number}, "Of one reading of each group.");
    a.needed_by_code("sizes", Several{k_number}, "Readings of each group, at least 2.");
}

template <class Archive>
void describe(Archive& a, SamplesStatement&) {
    a.definition("budget_samples");
    a.needed_by_code("file", FileName{}, "CSV.");
    a.by_code("column", Line{}, "The name of the input when left out.");
}

template <class Archive>
void describe(Archive& a, DistributionStatement&) {
    constexpr auto k_kinds = [] {
        Words<char, k_distribution_forms.size()> words{};
        for (std::size_t i = 0; i < words.size(); ++i) {
            words[i].first = k_distribution_forms[i].kind;
        }
        return words;
    }();
    a.definition("budget_distribution", "The keys that each kind has are in docs/budget_job.md.");
    a.needed_by_code("kind", k_kinds, "Of the distribution.");
    a.by_code("mean", k_number, "Of normal and exponential.");
    a.by_code("sd", k_above_zero, "Standard deviation of normal.");
    a.by_code("lower", k_number, "Lower limit.");
    a.by_code("upper", k_number, "Upper limit.");
    a.by_code("beta", k_not_negative,
              "Of trapezoidal: width of the top over width of the base; of beta: its second shape.");
    a.by_code("d", k_above_zero, "Of curvilinear_trapezoid: half-range of the inexact limits.");
    a.by_code("location", k_number, "Of student_t and gamma.");
    a.by_code("scale", k_above_zero, "Of student_t and gamma.");
    a.by_code("nu", k_degrees_of_freedom, "Of student_t.");
    a.by_code("shape", k_above_zero, "Of gamma.");
    a.by_code("mu", k_number, "Of lognormal.");
    a.by_code("sigma", k_above_zero, "Of lognormal.");
    a.by_code("alpha", k_above_zero, "First shape of beta.");
    a.by_code("counts", k_not_negative, "Of poisson_counts.");
    a.by_code("value", k_number, "Of constant.");
}

template <class Archive>
void describe(Archive& a, SpecificationStatement&) {
    a.definition("budget_specification", "Of the instrument that read the input: a sum of its parts.");
    a.by_code("percent_of_reading", k_above_zero, "A part.");
    a.by_code("percent_of_range", k_above_zero, "A part, with range.");
    a.by_code("range", k_above_zero, "That was set.");
    a.by_code("floor", k_not_negative, "A part.");
    a.by_code("of", Line{}, "The input that is read; the input itself when left out.");
    a.by_code("distribution", k_plain_bounded_words, "uniform when left out.");
    a.by_code("k", k_above_zero, "Where the specification is an expanded uncertainty.");
    a.by_code("p", In{k_coverage_probability}, "In place of k.");
}

/// What is known of a quantity.
template <class Archive>
void describe_statement(Archive& a) {
    constexpr auto k_distribution_words = [] {
        constexpr std::array<std::string_view, 3> k_without_limits{"normal", "student_t", "t"};
        Words<char, k_bounded_words.size() + k_without_limits.size()> words{};
        for (std::size_t i = 0; i < words.size(); ++i) {
            words[i].first =
                i < k_bounded_words.size() ? k_bounded_words[i].first : k_without_limits[i - k_bounded_words.size()];
        }
        return words;
    }();
    constexpr Words<char, 2> k_types{{{"A", 'A'}, {"B", 'B'}}};
    PooledStatement pooled;
    GroupsStatement groups;
    SamplesStatement samples;
    DistributionStatement distribution;
    SpecificationStatement specification;
    a.by_code("value", Either{k_number, Line{k_longest_angle}},
              "The estimate; an angle in arcsec or arcmin also as 12° 30' 05\".");
    a.by_code("u", k_not_negative, "Standard uncertainty.");
    a.by_code("U", k_above_zero, "Expanded uncertainty, with k or p.");
    a.by_code("k", k_above_zero, "Its coverage factor.");
    a.by_code("p", In{k_coverage_probability}, "Its coverage probability.");
    a.by_code("nu", k_degrees_of_freedom, "Degrees of freedom of the uncertainty; inf when left out.");
    a.by_code("reliability", k_ratio, "Relative uncertainty r of u, in place of nu: nu = 1/(2 r^2).");
    a.by_code("half_width", k_above_zero, "Of the distribution.");
    a.part_or("distribution", k_distribution_words, distribution,
              "A word beside half_width, limits, resolution, u or U; an object as a statement of its own.");
    a.by_code("beta", In{between(0.0, 1.0, "")}, "Trapezoid: width of the top over width of the base.");
    a.by_code("d", k_above_zero, "Curvilinear trapezoid: half-range of the inexact limits.");
    a.by_code("limits", Several{Either{k_number, Line{k_longest_angle}}, 2, 2},
              "The lower one, then the upper one; angles as for value.");
    a.by_code("resolution", k_above_zero, "Full step of the indication.");
    a.by_code("mpe", k_above_zero, "Maximum permissible error of a conforming instrument.");
    a.by_code("observations", Several{Either{k_number, Line{k_longest_angle}}, 1},
              "At least 2, or 1 with pooled; angles as for value.");
    a.part("pooled", pooled, "A standard deviation from earlier observations.");
    a.part_or("groups", Several{Several{k_number, 2}, 2}, groups, "Readings by group, or a summary of them.");
    a.part_or("samples", Either{Several{k_number, k_least_samples}, FileName{}}, samples, "Values, or a CSV file.");
    a.by_code("relative_u", k_ratio, "u over the value.");
    a.by_code("relative_U", k_ratio, "U over the value, with k or p.");
    a.part("specification", specification, "Of the instrument that read the input.");
    a.by_code("constant", Truth{}, "true: exactly known.");
    a.by_code("type", k_types, "Of the evaluation.");
    a.by_code("source", Line{}, "Where it is from; compared results that name the same source share it.");
    a.by_code("significance", AnyText{}, "For people.");
    a.by_code("note", AnyText{}, "For people.");
}

/// A standard of the register (docs/laboratory.md), which takes the place of a statement. Jobs are read after it was filled
/// in (jobs/laboratory/laboratory_use.h).
template <class Archive>
void describe_reference(Archive& a) {
    constexpr Words<char, 2> k_taken{{{"value", 'v'}, {"deviation", 'd'}}};
    a.by_code("standard", Line{}, "Identification of a standard in the register of the laboratory.");
    a.by_code("quantity", Line{}, "With standard: of its certificate, where that has several.");
    a.by_code("range", Line{}, "With standard: as in the register.");
    a.by_code("mode", Line{}, "With standard: as in the register.");
    a.by_code("at", k_number, "With standard: where it is used, in the unit of its nominal values.");
    a.by_code("date", Line{}, "With standard: day of use; that of the work when left out.");
    a.by_code("take", k_taken, "With standard: its value, when left out, or its deviation from the nominal value.");
}

template <class Archive>
void describe(Archive& a, ComponentStatement&) {
    a.definition("budget_component", "Its value, where it has one, adds to that of the component before it.");
    describe_statement(a);
    a.needed_by_code("name", Line{}, "Of the row of the budget.");
}

template <class Archive>
void describe(Archive& a, OverrideStatement&) {
    constexpr Words<bool, 2> k_between_points{{{"common", true}, {"independent", false}}};
    std::vector<ComponentStatement> components;
    a.definition("budget_override", "What differs at one point of a table.");
    describe_statement(a);
    describe_reference(a);
    a.by_code("between_points", k_between_points, "Whether the points share one value of the input.");
    a.list("components", components, "Statements whose sum the input is.", {.least = 1, .most = k_most_components});
}

/// Words of certificate/point_tables.h as a choice.
template <std::size_t n>
constexpr Words<std::string_view, n> words_of_quantities(const std::array<std::string_view, n>& all) {
    Words<std::string_view, n> words{};
    for (std::size_t i = 0; i < n; ++i) {
        words[i] = {all[i], all[i]};
    }
    return words;
}
inline constexpr auto k_role_words = words_of_quantities(certificate::k_quantity_roles);
/// Of a column of points with words: what quantities are, and pieces of a set.
inline constexpr auto k_word_roles = [] {
    constexpr auto k_pieces = words_of_quantities(certificate::k_piece_roles);
    Words<std::string_view, k_role_words.size() + k_pieces.size()> all{};
    std::copy(k_pieces.begin(), k_pieces.end(), std::copy(k_role_words.begin(), k_role_words.end(), all.begin()));
    return all;
}();
inline constexpr auto k_stage_words = words_of_quantities(certificate::k_quantity_stages);
/// How documents print the numbers.
inline constexpr Words<std::string_view, 1> k_form_words{{{certificate::k_sexagesimal, certificate::k_sexagesimal}}};

template <class Archive>
void describe(Archive& a, InputStatement&) {
    OverrideStatement statement;
    describe(a, statement);
    a.definition("budget_input", "Exactly one statement of what is known, or components (docs/budget_job.md).");
    describe_unit(a);
    a.by_hand("description", R"({"$ref": "#/definitions/description"})", "a text, or one in each language",
              "What the quantity is.");
    a.by_code("role", k_role_words, "What tables of results call it.");
    a.by_code("stage", k_stage_words, "Of an item that was adjusted.");
    a.by_code("form", k_form_words, "In arcsec or arcmin: documents print degrees, minutes and seconds.");
}

template <class Archive>
void describe(Archive& a, CovarianceStatement&) {
    a.needed_by_code("inputs", Several{AnyText{}, 1}, "Names, in the order of rows and columns.");
    a.needed_by_code("matrix", Either{k_matrix, FileObject{}},
                     "In products of their units; a file is CSV without header.");
}

template <class Archive>
void describe(Archive& a, ParameterStatement&) {
    describe_unit(a);
    a.by_code("start", k_number, "Where the fit begins, in the unit.");
}

template <class Archive>
void describe(Archive& a, FitStatement&) {
    std::vector<ParameterStatement> parameters;
    a.needed_by_code("equation", k_equation, "name = expression: what was observed, of parameters and columns.");
    a.needed_named("parameters", parameters, "By name.", {.least = 1});
    a.by_code("units", ByName{Line{}}, "Of each column; 1 when left out.");
    a.needed_by_code("data", ByName{Either{k_number, Several{k_number}, FileName{}}},
                     "An array for every column, or a file; u_NAME holds standard uncertainties.");
    a.by_code("covariance", ByName{Either{k_matrix, FileObject{}}}, "Of each column that has one.");
    a.by_code("scale_by_residuals", Truth{}, "Whether the residuals scale the uncertainties; false when left out.");
}

}  // namespace gumcert::jobs
