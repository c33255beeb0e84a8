#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/budget/budget_job.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/job_common_fields.h"
#include "jobs/job_fields.h"
#include "jobs/monte_carlo_request.h"

namespace gumcert::jobs {

inline constexpr std::size_t k_most_sections = 50;

// What the file of a budget job says, and its description (jobs/job_fields.h).

/// An unknown of an implicit equation.
struct UnknownStatement {
    double start = 0.0;  ///< in its unit
    std::string description;
};

/// Of the plots of a table.
inline constexpr Words<std::string_view, 2> k_plot_words{{{"each", ""}, {"none", "none"}}};

struct OutputStatement {
    std::optional<double> coverage_probability;
    std::optional<gum::CoverageChoice> coverage;
    std::string_view role, stage, form;
};

/// One table of results as the job wants it; read by jobs/budget/budget_tables.h.
struct TableStatement {};

/// A part of a certificate with equations and points of its own.
struct SectionStatement {
    std::vector<UnknownStatement> solve_for;
    std::vector<OutputStatement> outputs;
    std::vector<TableStatement> tables;
};

struct BudgetStatement {
    BudgetJob job;
    std::vector<InputStatement> inputs;
    CovarianceStatement covariance;
    std::vector<FitStatement> fits;
    std::vector<UnknownStatement> solve_for;
    std::vector<OutputStatement> outputs;
    std::vector<TableStatement> tables;
    std::vector<SectionStatement> sections;
    MonteCarloStatement monte_carlo;
};

template <class Archive>
void describe(Archive& a, UnknownStatement& r) {
    a.needed("start", r.start, In{}, "Where the solution is looked for, in the unit.");
    describe_unit(a);
    a("description", r.description, AnyText{}, "What the quantity is.");
}

template <class Archive>
void describe(Archive& a, OutputStatement& r) {
    describe_unit(a);
    a("coverage_probability", r.coverage_probability, In{k_probability_of_results}, "Of this result.");
    a("coverage", r.coverage, gum::k_coverage_choices, "Which evaluation of this result is reported.");
    a.by_hand("description", R"({"$ref": "#/definitions/description"})", "a text, or one in each language",
              "What the quantity is.");
    a("role", r.role, k_role_words, "What tables of results call it.");
    a("stage", r.stage, k_stage_words, "Of an item that was adjusted.");
    a("form", r.form, k_form_words, "In arcsec or arcmin: documents print degrees, minutes and seconds.");
}

template <class Archive>
void describe(Archive& a, TableStatement&) {
    a.by_hand("title", R"({"$ref": "#/definitions/description"})", "a text, or one in each language",
              "Of the table; Results when left out.");
    a.by_hand("columns", R"({"type": "array", "minItems": 1, "maxItems": 40, "items": {"anyOf": [
        {"$ref": "#/definitions/name"},
        {"type": "object", "required": ["column"], "additionalProperties": false, "properties": {
            "column": {"$ref": "#/definitions/name"}, "heading": {"$ref": "#/definitions/description"}}}]}})",
              "1 to 40 names, or objects of a `column` and its `heading`",
              "Columns of points, inputs, s(INPUT) for the standard deviation of its readings, results, roles, and "
              "point, U, k, nu_eff, limit, limit_low, limit_high, verdict "
              "of the result before them; when left out: what has a role, and what belongs to the results.");
    a.by_code("group_by", Line{}, "A column with words: a group of rows with a heading for each; range when left out.");
    a.by_code("where", ByName{Line{}}, "Rows of the table: those that have these words in these columns.");
    a.by_hand("units", R"({"type": "object", "additionalProperties": {"anyOf": [{"$ref": "#/definitions/name"},
        {"type": "object", "additionalProperties": {"$ref": "#/definitions/name"}}]}})",
              "a unit for each group, or an object of columns and their units",
              "Units of the numbers of a group of rows.");
    a.by_code("plot", k_plot_words, "Whether each group of rows has a plot of its results; each when left out.");
}

template <class Archive>
void describe_model(Archive& a) {
    a.by_code("model", Either{k_equation, Several{k_equation}},
              "name = expression, or 0 = expression; left out: the inputs and the parameters of fits are the results.");
}

/// What results there are, and where.
template <class Archive, class Struct>
void describe_results(Archive& a, Struct& r) {
    a.named("solve_for", r.solve_for, "Unknowns of implicit equations, by name.");
    a.named("outputs", r.outputs, "Results that are asked for, by name.");
    a.by_hand(
        "points", R"({"anyOf": [
        {"type": "array", "minItems": 1, "maxItems": 100000, "items": {
            "type": "object", "properties": {"point": {"type": ["string", "number"]}},
            "additionalProperties": {"anyOf": [{"type": "number"},
                {"type": "string", "maxLength": 64, "pattern": "°|º|'|’|′|\"|”|″"},
                {"$ref": "#/definitions/budget_override"}]}}},
        {"type": "object", "additionalProperties": false, "properties": {
            "file": {"$ref": "#/definitions/file_name"},
            "list": {"type": "array", "minItems": 1, "maxItems": 100000, "items": {"type": "object"}},
            "columns": {"type": "object", "additionalProperties": {"anyOf": [{"$ref": "#/definitions/name"},
                {"type": "object", "additionalProperties": false, "properties": {
                    "unit": {"$ref": "#/definitions/name"},
                    "heading": {"$ref": "#/definitions/description"},
                    "role": {"enum": ["nominal", "setting", "reference", "indication", "measured_value", "error",
                                      "deviation", "correction", "serial_number", "identification"]},
                    "stage": {"enum": ["as_found", "as_left"]},
                    "form": {"enum": ["sexagesimal"]}}}]}}}}]})",
        "1 to 100000 objects of numbers and of [budget_override](#budget_override); or an object with the name of "
        "a `file` or such a `list`, and `columns` of points that are no inputs",
        "A table of test points: under the names of inputs their values, or whatever differs; point is the name "
        "of the point.");
    a.list("tables", r.tables, "Tables of results; one with all points when left out.", {.least = 1, .most = 100});
}

template <class Archive>
void describe(Archive& a, SectionStatement& r) {
    a.by_hand("title", R"({"$ref": "#/definitions/description"})", "a text, or one in each language",
              "What certificates call it; the name of the section when left out.");
    describe_model(a);
    describe_results(a, r);
}

template <class Archive>
void describe(Archive& a, BudgetStatement& r) {
    describe_head(a, k_budget_kind);
    describe_title(a);
    a("coverage_probability", r.job.coverage_probability, In{k_probability_of_results},
      "Of all results that do not state their own; 0.9545 when left out.");
    describe_certificate(a);
    a.part("monte_carlo", r.monte_carlo,
           "Monte Carlo beside the law of propagation; left out: only where the law of propagation does not hold.");
    describe_notes(a);
    describe_model(a);
    a.named("inputs", r.inputs, "What is known of each input quantity, under its name.", {.most = k_most_inputs});
    a.by_code("correlations", Several{Row{AnyText{}, AnyText{}, In{between(-1.0, 1.0, "")}}},
              "Two names of inputs and their correlation coefficient.");
    a.part("covariance", r.covariance, "Inputs and their covariance matrix.");
    a.by_code("simultaneous", Several{Several{AnyText{}, 2}, 0}, "Names of inputs that were observed together.");
    describe_results(a, r);
    a.named("sections", r.sections,
            "In place of solve_for, outputs, points and tables: several such parts, by name, that share inputs, "
            "correlations, fits and the equations of model beside them. Names of results differ between them.",
            {.least = 1, .most = k_most_sections});
    a.named("fits", r.fits, "Least-squares fits whose parameters are used like inputs.");
    a.part("reporting", r.job, "How numbers are reported.", [](auto& in, BudgetJob& job) {
        constexpr Words<bool, 2> k_degrees{{{"exact", false}, {"truncated", true}}};
        constexpr Words<gum::RoundingMode, 2> k_rounding{
            {{"half_even", gum::RoundingMode::half_even}, {"up", gum::RoundingMode::up}}};
        in("degrees_of_freedom", job.truncate_degrees_of_freedom, k_degrees,
           "Whether k is taken for the effective degrees of freedom as they are (exact, when left out).");
        in("rounding", job.rounding, k_rounding, "Of printed expanded uncertainties; half_even when left out.");
    });
    a("coverage", r.job.coverage, gum::k_coverage_choices,
      "Which evaluation is reported of results that do not state their own; as_validated when left out: the law of "
      "propagation where it is adequate, Monte Carlo elsewhere.");
}

/// The keys of a budget job, what they mean and what they allow.
[[nodiscard]] const JobFields& budget_fields();

}  // namespace gumcert::jobs
