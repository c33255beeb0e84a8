#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "audit/stated_number.h"
#include "gum/conformity/decision_rule.h"
#include "gum/conformity/tolerance_limits.h"
#include "gum/rounding.h"

namespace gumcert::audit {

/// What a table calls the distribution of a row.
enum class Shape { not_stated, normal, student_t, rectangular, triangular, arcsine, trapezoidal, other };

/// What the uncertainty of a row was made from, as far as table or job say.
enum class Origin {
    not_stated,
    readings,       ///< Type A: scatter of repeated readings
    certificate,    ///< U and k of a calibration certificate
    specification,  ///< a maximum permissible error or an accuracy class
    resolution,     ///< the step of a display or scale
    limits,         ///< a half-width
};

/// Which contributor a row stands for: the words of the checklists of methods.
enum class Contributor {
    other,
    reference,             ///< the measurement standard, by its certificate
    reference_drift,       ///< its change since the calibration
    reference_resolution,  ///< its display
    item_resolution,       ///< display or scale of the device under test
    repeatability,
    reproducibility,
    temperature,
    expansion,  ///< thermal expansion
    alignment,  ///< Abbe, cosine, mounting, datum
    refractive_index,
    dead_path,
    target_form,  ///< form of reflectors, spheres, anvils
    fit,          ///< parameters of a fit, residuals, interpolation
    environment,  ///< other conditions: humidity, pressure, buoyancy, homogeneity of a bath
    item,         ///< another contribution of the device under test: stability, hysteresis, zero
};

/// What a relative uncertainty is a part of.
enum class RelativeTo { not_stated, reading, full_scale };

/// What a correction has multiplied the standard uncertainty of a row by.
struct FactorOfU {
    double factor = 1.0;
    double tolerance = 0.01;   ///< relative: of a u that was set, what the digits of the former u leave open is in it
    bool of_rounding = false;  ///< from a printed u to the one that it was rounded from
};

/// What words leave open of U of a certificate, in the unit of the row.
struct OpenExpansion {
    std::vector<double> may_be;      ///< several are stated
    std::optional<double> part;      ///< a part of a base that has no number, beside `at_least`: "U = 0.1 % FS"
    std::optional<double> at_least;  ///< the known terms of an expression that has others: 0.12 of "0.12 µm + 0.5E-6 L"
};

/// One row of an uncertainty budget as somebody states it. Numbers of a row are in its own unit.
struct AuditedRow {
    std::string quantity, unit, source, comment;
    std::string description = {};                  ///< of a table that has a column of symbols and one of words
    std::string place;                             ///< "row 3" or "Budget!A5", for findings
    DecimalSign decimal_sign = DecimalSign::each;  ///< of the numbers in its words
    /// Of a row that is one part of a quantity that is a sum: that quantity. Its parts have one unit and one sensitivity.
    std::string part_of;
    /// Of a row of a job: its input quantity, and which component of it; "" of a table.
    std::string input = {};
    std::size_t component = 0;
    /// Of a job: the value of a standard, or a quantity with a role in the tables of results. It is measured or compared,
    /// and no condition of the work.
    bool is_measured = false;
    std::optional<StatedNumber> estimate;
    std::optional<StatedNumber> stated;   ///< what was divided: half-width, MPE, U of a certificate
    std::optional<StatedNumber> divisor;  ///< k, √3 …
    std::optional<StatedNumber> u;        ///< standard uncertainty
    std::optional<StatedNumber> sensitivity;
    std::optional<StatedNumber> contribution;  ///< |c| u, in the unit of the result
    std::optional<StatedNumber> nu;            ///< infinite where the table says so; none where it says nothing
    Shape shape = Shape::not_stated;
    std::string shape_text;                     ///< as the table has it
    std::optional<double> distribution_k = {};  ///< that the words of a normal distribution state, "normal (k = 2)"
    Origin origin = Origin::not_stated;
    Contributor contributor = Contributor::other;
    /// The number that the origin gives, read of the comment or the job, in the unit of the row: half-width, MPE, step,
    /// U of the certificate, or s of single readings.
    std::optional<double> origin_value;
    std::optional<double> certificate_k, certificate_probability;
    std::optional<OpenExpansion> open_expansion = {};  ///< words state U, and not as one number
    std::optional<bool> type_a;
    std::vector<double> readings;          ///< of a Type A row, where they are known
    std::optional<std::size_t> n;          ///< readings that the comment names
    std::optional<double> pooled_s;        ///< pooled standard deviation that is used in place of that of the readings
    std::vector<double> group_deviations;  ///< standard deviations of several series, where they are known
    std::vector<std::size_t> group_sizes;
    bool in_sum = true;  ///< false: the table has the row, and its sum leaves it out

    // What is evaluated: the numbers of the table, or what follows from them where one is missing.
    double used_u = 0.0;            ///< ≥ 0
    double used_sensitivity = 1.0;  ///< [unit of the result / unit of the row]
    double used_nu = std::numeric_limits<double>::infinity();
    double u_half_step = 0.0, sensitivity_half_step = 0.0;  ///< what the printed digits of both leave open
    /// What corrections have multiplied `used_u` by, so that one error which several rules see is corrected once.
    std::vector<FactorOfU> factors_of_u = {};

    // What only some rows say. Texts are read by audit/row_facts.h; a reader of columns or jobs may know them itself.
    std::optional<double> relative_uncertainty;  ///< "0.5 % of full scale": 0.005
    RelativeTo relative_to = RelativeTo::not_stated;
    std::optional<double> full_scale;  ///< in the unit of the row
    /// Points that the certificate was made at, in the unit of the estimate; one point: both are equal.
    std::optional<double> certificate_low, certificate_high;
    std::optional<double> lower_limit, upper_limit;  ///< deviations from the estimate where they differ: −0.1 and 0.3
    std::optional<double> reliability;               ///< relative standard uncertainty of u itself: 0.25
    bool cyclic = false;                         ///< the quantity swings: a temperature that is controlled in cycles
    std::optional<double> unapplied_correction;  ///< known from a certificate, and not applied to the estimate
    std::optional<std::size_t> averaged;         ///< readings that the estimate is the mean of
    std::optional<double> certificate_U;  ///< of a certificate that is named where a specification is used, in its unit
    std::string sensitivity_unit;         ///< as the table has it
    /// A specification that grows with the length, "0.4 + 1.2E-6 L": its two numbers as they stand there.
    std::optional<double> limit_constant, limit_per_length;
};

/// Correlation coefficient of two rows.
struct RowCorrelation {
    std::size_t first = 0, second = 0;  ///< positions of the rows
    double r = 0.0;
};

/// k for a ν_eff; nothing where nobody can tell.
using FactorOfNu = std::function<std::optional<double>(double nu_eff)>;

/// What rows that correlate are in ν_eff, of which the formula of Welch and Satterthwaite asks for independent contributions (JCGM
/// 100:2008, G.4.1).
enum class CorrelatedRows {
    whichever_has_more,  ///< of both below: only what neither allows is a fault
    one_contribution,  ///< with the fewest degrees of freedom of one of them, as the evaluation takes correlated inputs
    independent,       ///< as if they did not correlate: S12
};

/// How a budget comes from u_c to U.
struct CoverageRule {
    enum class Kind {
        fixed,        ///< k as stated, whatever ν_eff
        student_t,    ///< k = t_p(ν_eff)
        convolution,  ///< k from the distribution of the sum of the rows
    };
    Kind kind = Kind::student_t;
    double k = 2.0;               ///< of `fixed`
    double probability = 0.9545;  ///< p of the others
    /// ν_eff is cut to the next lower whole number before k is taken (JCGM 100:2008, G.4.1)
    bool truncate = false;
    CorrelatedRows correlated = CorrelatedRows::whichever_has_more;
    /// Of a budget that this program evaluated: each copy of it takes k as the evaluation would, t_p(ν_eff) or, where that
    /// of the convolution is more than 1 % away from it, the latter (ADR 0014, 0025), whichever `kind` the result has.
    bool chosen_anew = false;
    /// Of `fixed`: the cell of k computes with ν_eff, and not as t_p(ν_eff): k of a table, or 2 from some ν_eff on. `k` is
    /// what it shows; of a corrected budget k is what the cell would show.
    std::shared_ptr<const FactorOfNu> k_of_nu = {};
};

/// The value that a result is compared with, in the unit of the result.
struct ComparedReference {
    double value = 0.0, expanded_uncertainty = 0.0;
    double correlation = 0.0;
    std::string name;
    std::size_t point = 0;  ///< which one of a comparison
    /// Where another point of the comparison has a larger |E_n|: what takes the place of value − reference, so that E_n is
    /// that of the other point.
    std::optional<double> largest_difference = {};
    bool budget_is_reference = false;  ///< the budget is that of the reference: E_n is of `value` minus its value
};

/// What a budget says of the Monte Carlo trials that its uncertainty comes from.
struct StatedMonteCarlo {
    std::optional<double> trials;
    std::optional<bool> converged;          ///< of an adaptive procedure
    std::optional<double> numerical_error;  ///< standard uncertainty of U from the number of trials, unit of the result
    bool repeatable = true;                 ///< seed, generator and version are on record
    std::optional<double> low, high;        ///< ends of the coverage interval, unit of the result
};

/// Cells of a workbook in which a number should stand, and an error value does: the file claims none. Their places; "" where
/// there is none.
struct BrokenClaims {
    std::string value, u_c, nu_eff, k, U;

    [[nodiscard]] bool any() const {
        return !value.empty() || !u_c.empty() || !nu_eff.empty() || !k.empty() || !U.empty();
    }
};

/// What a budget says of its own result.
struct Claims {
    std::optional<StatedNumber> value, u_c, nu_eff, k, U;
    std::optional<double> coverage_probability;
    std::string coverage_sentence;  ///< what is written beside U: "k = 2, 95 %"
    std::string distribution;  ///< of the result, as a certificate calls it: "normal", "convolution"; "" not stated
    /// Of a workbook: the cell of k computes with ν_eff, or with the degrees of freedom of rows. It follows them then, whatever
    /// number it shows.
    bool k_follows_nu = false;
    std::string verdict;  ///< "pass", "fail" …; "" where none is stated
    std::optional<StatedNumber> en;
    BrokenClaims broken;
};

/// U of a budget that nothing has corrected: as it is stated, and as it is evaluated, from which it was rounded.
struct UncorrectedU {
    double stated = 0.0, evaluated = 0.0;  ///< > 0
    double step = 0.0;                     ///< one unit of the last digit of the former; 0: known to all digits
    std::string text;                      ///< of the former; "" without
};

/// Of a workbook that shows other results than its formulas give: what these give, and what it has beyond the rows.
struct ComputedClaims {
    Claims claims;
    CoverageRule coverage;
    double u_c_over_rows = 1.0, k_over_rows = 1.0, U_over_k_u_c = 1.0;
};

/// An uncertainty budget of one result, by whomever it was made: what the rules of the audit look at, and what their
/// corrections change.
struct AuditedBudget {
    std::string name;  ///< of the result
    std::string unit;
    std::string place;       ///< of the table
    std::string title = {};  ///< of a table: the line of words above its heads
    std::string equation;
    std::string method;  ///< id of the method's checklist; "" where none is known
    std::vector<AuditedRow> rows;
    std::vector<RowCorrelation> correlations;
    CoverageRule coverage;
    /// What correlations that are not listed add to the variance, as the evaluation of the job has it: it stays as it is.
    /// Of a result of a certificate, which has no rows, all of u_c².
    double correlation_variance = 0.0;
    /// Inputs of which the job says how any two of a set correlate, 0 too; what they add is in `correlation_variance`.
    std::vector<std::set<std::string>> inputs_with_correlation = {};
    /// What the reported u² has beyond the law of propagation: terms of second order, or what trials of the model show. It
    /// has no part in ν_eff.
    double variance_beyond_tangent = 0.0;
    bool rests_on_trials = false;  ///< of a budget evaluated here: the reported U is that of Monte Carlo trials
    /// What the sum Σ (c u)⁴/ν of Welch and Satterthwaite has beyond the rows, [unit⁴]: the degrees of freedom of u_c are known
    /// to the evaluation, and the rows do not have all of them.
    double fourth_powers_beyond_rows = 0.0;
    /// ν_eff of the evaluation over that of the formula of Welch and Satterthwaite, which is one of independent rows
    /// (JCGM 100:2008, G.4.1): correlated ones are one contribution there. It stays while findings are corrected.
    double nu_eff_over_rows = 1.0;
    /// What the claimed numbers have beyond the rows: u_c of the claim over that of the rows, k of the claim over that of
    /// ν_eff of the rows, and U of the claim over k u_c. 1 where rows and claims agree within their rounding; a finding of
    /// its own (K01) where they do not. They stay while other findings are corrected.
    double u_c_over_rows = 1.0, k_over_rows = 1.0, U_over_k_u_c = 1.0;
    /// The claimed U over that of the rows, where the digits of the rows leave it open and it is no rounding of the latter: the
    /// laboratory computed with digits that the table does not print. Set by the audit; it stays while findings are corrected.
    double within_digits = 1.0;
    /// The same where the claimed u_c is that of the rows, and the digits leave ν_eff and k open: then u_c stays, and U has the ratio.
    double U_within_digits = 1.0;
    /// Evaluated by this program from its measurement model: sensitivities, sum and k come from there and need no second
    /// look; what was stated of the inputs does.
    bool evaluated_here = false;
    /// False: the result comes from trials that are not at hand, so that no probability can be computed again.
    bool has_known_distribution = true;
    std::optional<double> value;
    /// Calibration and measurement capability at this point: U is never stated below it (ILAC-P14:09/2020, 5.4).
    std::optional<double> capability;
    bool floor_applied = true;  ///< U is raised to the capability where it is smaller
    gum::ToleranceLimits limits;
    std::optional<gum::DecisionRule> rule;
    std::string rule_not_known = {};  ///< of a table: what it states of a decision rule, where that is none of ours
    gum::DecisionRuleParameters rule_parameters;
    std::optional<ComparedReference> reference;
    int digits = 2;  ///< significant digits of a printed U
    gum::RoundingMode rounding = gum::RoundingMode::half_even;
    Claims claims;
    std::optional<ComputedClaims> computed_claims;  ///< `claims` has what is shown
    /// So that all copies of the budget print U alike: one that is not corrected as it is stated.
    std::optional<UncorrectedU> uncorrected_U = {};
    std::optional<StatedMonteCarlo> monte_carlo;
    /// Of a table: heads of columns of numbers that nobody understood. What does not follow may follow from them.
    std::vector<std::string> unread_columns = {};
    /// Of a table: its heads are of another language than English and German, in which words of rows are read. What such a row does
    /// not say in these, it may say.
    bool in_other_language = false;
    /// Of a table: words in cells of rows where a number of the sum should stand. A line may have slipped by a column.
    std::vector<std::string> unread_cells = {};
    /// Correlation coefficients that it states, and nobody knows of which rows.
    std::vector<double> unread_correlations = {};
    /// The same of an r in a line of words, of which nobody knows whether it is that of two rows: it may explain a claim.
    std::vector<double> noted_correlations = {};
    std::optional<double> physical_minimum;  ///< no value of the quantity lies below: 0 of a form error
};

}  // namespace gumcert::audit
