#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "certificate/localised_text.h"
#include "reports/record/shown.h"

namespace gumcert::reports {

// What a record of kind "budget" holds beside the results.

/// Second-order terms of the law of propagation (JCGM 100:2008, 5.1.2 note), in the unit of the result.
struct SecondOrder {
    Shown<double> first_order_u = {};  ///< standard uncertainty with first-order terms alone
    Shown<double> u = {};              ///< with first- and second-order terms
    Shown<double> shift = {};          ///< expectation of the output minus its value at the estimates
};

/// Comparison of the law of propagation with Monte Carlo (JCGM 101:2008, clause 8), in the unit of the result.
struct GufValidation {
    Shown<double> delta = {}, d_low = {}, d_high = {};
    bool validated = false;
    bool precise_enough = false;  ///< numerical error of the ends below delta/5, or too small to turn a refusal
    std::string interval;         ///< which Monte Carlo interval was compared: "symmetric" or "shortest"
    std::int64_t digits = 2;
};

/// Monte Carlo of one result (JCGM 101:2008, clause 7), in the unit of the result.
struct MonteCarloSummary {
    Shown<std::int64_t> trials = {};
    std::int64_t seed = 1;
    Shown<std::optional<double>> mean = {}, u = {};  ///< none where the distribution has none that trials can find
    Shown<std::array<double, 2>> symmetric = {}, shortest = {};
    struct {
        double mean = 0.0, u = 0.0;
        std::array<double, 2> symmetric{}, shortest{};
    } numerical_error;  ///< standard uncertainty of each number, from the finite number of trials
    bool adaptive = false, stabilised = true;
    std::optional<GufValidation> validation;
    /// Counts of the trials in cells of equal width, for the plot; empty: none.
    double histogram_low = 0.0, histogram_high = 0.0;
    std::vector<std::int64_t> histogram;
};

/// Covariance of results, in the products of their units.
struct ResultCovariance {
    std::vector<std::string> names;
    std::vector<std::string> units;
    std::vector<std::vector<double>> matrix;
    Shown<std::vector<std::vector<double>>> correlation = {};
    std::string file;  ///< CSV beside the record, where the matrices are too large for it and left out here; else ""
    std::string method = {};  ///< "law_of_propagation", "monte_carlo"; "" in records before it was stated
};

/// Joint coverage region of all outputs (JCGM 102:2011, 6.5 and 7.7).
struct CoverageRegion {
    double coverage_probability = 0.9545;
    std::string from;                          ///< "law of propagation" or "Monte Carlo"
    std::optional<double> degrees_of_freedom;  ///< of one scale or matrix that all share; none: infinite, or no such
    Shown<std::optional<double>> k_p = {};     ///< hyper-ellipsoid
    /// Why there is no k_p: "singular", "distribution"; "" where there is one, and in records before it was stated.
    std::string no_k_p_because = {};
    Shown<std::optional<double>> k_q = {};  ///< hyper-rectangle
    struct SmallestRegion {
        double volume = 0.0, probability = 0.0;
        std::int64_t cells = 0;
        std::vector<std::int64_t> cells_per_axis;
    };
    std::optional<SmallestRegion> smallest_region;
    /// Law of propagation against Monte Carlo for all outputs together (JCGM 102:2011, clause 8); in the order of the
    /// results and in their units.
    struct Validation {
        std::vector<double> delta, d_value, d_u;
        double delta_eigenvalue = 0.0, d_eigenvalue = 0.0;  ///< largest eigenvalue of the correlation matrix
        std::optional<double> delta_k_p, d_k_p;
        bool validated = false;
    };
    std::optional<Validation> validation;
};

/// A least-squares fit whose parameters are inputs of the model, or results.
struct FitSummary {
    std::string name, equation;
    std::string method;  ///< "ordinary", "weighted", "generalised", "errors in both variables"
    struct Parameter {
        std::string name, unit;
        std::string printed_unit = {};
        Shown<double> value = {}, u = {};
        /// u that `scale_by_residuals` would give, where the test of chi-square refutes the stated uncertainties
        Shown<std::optional<double>> scaled_u = {};
    };
    std::vector<Parameter> parameters;
    std::vector<std::vector<double>> covariance, correlation;  ///< in the units of the parameters
    double degrees_of_freedom = 0.0;
    Shown<double> sum_of_squares = {};  ///< of the residuals in the unit of y, or chi-square where weighted
    Shown<double> residual_standard_deviation = {};  ///< in `y_unit`; [1] where weighted
    double condition_number = 0.0;
    Shown<std::optional<double>> r_squared = {};  ///< none where it has no agreed meaning (errors in x and y, equal y)
    Shown<std::optional<double>> p_value = {};    ///< of chi-square, where the uncertainties were stated
    /// What the test of chi-square says of the stated uncertainties: "consistent", "refuted" (the residuals are too
    /// large), "overstated" (far too small); "" where there is nothing to test
    std::string consistency;
    std::int64_t iterations = 0;
    bool covariance_scaled = false;                            ///< by the residuals
    std::string x_name, x_unit, y_name, y_unit;                ///< x_name is "" where there are several regressors
    Shown<std::vector<double>> x = {}, y = {}, residual = {};  ///< one a point, in x_unit and y_unit
    std::vector<double> fitted;
    Shown<std::vector<double>> u_x = {}, u_y = {};  ///< stated standard uncertainties, one a point; empty where none
    struct Regressor {
        std::string name, unit;
        Shown<std::vector<double>> values = {};
    };
    std::vector<Regressor> regressors;  ///< where there are several
};

/// A reading that Grubbs' test takes for an outlier among the others of its set, in the unit of the input.
struct OutlyingReading {
    std::string input, component, unit;
    std::string point;          ///< as ReadingsSummary::point
    std::string of;             ///< the set it stands in: "observations", "group" or "group_means"
    std::int64_t group = 0;     ///< number of the group, from 1; 0 where there are none
    std::int64_t position = 0;  ///< in its set, from 1
    std::int64_t n = 0;         ///< readings of the set that were tested
    Shown<double> value = {};
    Shown<double> G = {};        ///< |x - mean| / s of the set
    Shown<double> p_value = {};  ///< upper bound (Bonferroni) for any of the readings
};

/// Readings of one input, what they say of its uncertainty (JCGM 100:2008, 4.2), in the unit of the input.
struct ReadingsSummary {
    std::string input, component, unit;
    /// Name of the point of a table that states these readings; "" for those of the job, which hold wherever no point
    /// states its own
    std::string point;
    std::vector<std::string> observations;  ///< as printed, in the order read
    std::int64_t n = 0;
    Shown<double> mean = {}, standard_deviation = {}, standard_deviation_of_mean = {};
    std::optional<double> pooled_standard_deviation;
    std::optional<double> pooled_degrees_of_freedom = {};  ///< none beside a pooled one: infinite
    /// F of the scatter of these readings over the pooled one, without what the steps of a display may add; none for a
    /// single reading
    std::optional<double> pooled_F = {};
    std::vector<double> autocorrelation;       ///< coefficients of lag 0, 1, 2 …; empty where all readings are equal
    std::string printed_r1 = {};               ///< the coefficient of lag 1
    Shown<double> autocorrelation_limit = {};  ///< |r1| above it says that the readings depend on each other
    bool dependent = false;
};

/// One-way analysis of variance of grouped readings (JCGM 100:2008, H.5), in the unit of the input.
struct VarianceAnalysis {
    std::string input, component, unit;
    std::string point;  ///< as ReadingsSummary::point
    std::int64_t groups = 0, readings = 0;
    Shown<double> mean = {};
    double sum_of_squares_between = 0.0, sum_of_squares_within = 0.0;
    double degrees_of_freedom_between = 0.0, degrees_of_freedom_within = 0.0;
    double mean_square_between = 0.0, mean_square_within = 0.0;
    std::array<std::string, 2> printed_mean_square;       ///< between, within
    Shown<double> F = {}, p_value = {}, F_critical = {};  ///< critical at 5 %
    double r_squared = 0.0;
    Shown<double> standard_deviation_within = {};          ///< s_w, pooled
    Shown<double> standard_deviation_of_group_means = {};  ///< s(V̄_j)
    Shown<double> standard_deviation_between = {};  ///< component of variance s_B, 0 where its square is negative
    double u_with_between_effect = 0.0;             ///< s(V̄_j)/√J, J − 1 degrees of freedom
    double u_without_between_effect = 0.0;          ///< pooled, N − 1 degrees of freedom
    std::string conclusion;                         ///< "significant" or "not significant"
};

/// The model of a budget as the job states it; of all sections one after the other.
struct ModelSummary {
    std::vector<std::string> equations;
    std::vector<std::string> unknowns;  ///< of implicit equations
};

/// Results with equations and points of their own, among others of one budget. Equations, unknowns and points are those
/// of the record that come next after those of the sections before.
struct SectionSummary {
    std::string name;
    certificate::LocalisedText title;
    std::int64_t equations = 0, unknowns = 0;
    std::int64_t points = 0;              ///< 0: one evaluation
    std::vector<std::string> quantities;  ///< its results
};

}  // namespace gumcert::reports
