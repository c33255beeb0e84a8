#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "gum/comparison/agreement.h"
#include "gum/comparison/scores.h"

namespace gumcert::gum {

/// One point that both methods measured, in the unit of the comparison.
struct ComparedPoint {
    std::string name = {}, direction = {};
    std::optional<double> angle_deg = {}, position = {};
    double value = 0.0, u = 0.0, U = 0.0, k = 2.0;
    std::optional<double> nu = {};
    double reference_value = 0.0, reference_u = 0.0, reference_U = 0.0, reference_k = 2.0;
    std::optional<double> reference_nu = {};
    std::optional<double> p = {}, reference_p = {};  ///< that U covers, where the distribution of the value is known
    /// U as E_n takes it, where the distribution of the value says it; none: by k and ν.
    std::optional<EnUncertainty> of_scores = {}, reference_of_scores = {};
};

/// A method against a reference method.
struct MethodComparison {
    std::vector<ComparedPoint> points;
    Eigen::MatrixXd covariance;            ///< m×m, of the values of the method
    Eigen::MatrixXd reference_covariance;  ///< m×m
    Eigen::MatrixXd cross_covariance;      ///< m×m, cov(method i, reference j); empty: nothing is shared
    bool correlation_unknown = false;      ///< both methods may share a standard: E_n for the worst plausible r too
    double coverage_probability = 0.9545;
    bool bias_against_position = false;  ///< else against the reference value
    bool mean_taken_off = false;         ///< of both sides: their covariance says nothing of what all points share
    double audited_factor = 1.0, reference_audited_factor = 1.0;

    [[nodiscard]] bool is_audited() const { return audited_factor != 1.0 || reference_audited_factor != 1.0; }
};

/// Scores of one point.
struct MethodScore {
    double difference = 0.0;  ///< D = method − reference
    double u_difference = 0.0, U_difference = 0.0;
    double en = 0.0, zeta = 0.0;
    double correlation = 0.0;  ///< of both values
    /// U and k that E_n takes in place of those stated; none: as stated.
    std::optional<EnUncertainty> of_scores = {}, reference_of_scores = {};
    std::optional<double> en_worst = {};    ///< where r is not known; infinite where no finite number bounds it
    std::optional<double> en_audited = {};  ///< with findings on the uncertainties corrected
};

/// Straight line through the differences, with expanded uncertainties for the probability of the comparison.
struct MethodBias {
    BiasLine line;
    double U_constant = 0.0, U_slope = 0.0;
    bool against_position = false;  ///< else against the reference value
    double span = 0.0;              ///< of the positions, or of the reference values
    /// The reference values spread by less than five times their standard uncertainty: the slope against them contains
    /// their own errors, and is no evidence of anything.
    bool slope_is_noise = false;
    std::optional<BiasTest> test = {};  ///< that chance explains the line, of what of it can be evidence
};

/// What the points of one direction say together, or those of all directions.
struct MethodSummary {
    std::string direction;             ///< "all" for all of them
    std::vector<Eigen::Index> points;  ///< positions
    Agreement agreement;
    std::optional<EnVariant> worst = {};  ///< where r is not known; the largest is infinite where nothing bounds it
    std::optional<EnVariant> audited = {};
    AgreementVerdict verdict = AgreementVerdict::disagreement;  ///< of the uncertainties as stated
    bool for_any_correlation = false;  ///< where r is not known: judged for every plausible one, with chance
    /// With findings on the uncertainties corrected, where there are such: the method stands only where both do.
    std::optional<AgreementVerdict> verdict_audited = {};
    std::optional<MethodBias> bias = {};
    /// Slope of the bias line that the uncertainty of the reference values alone makes: their errors stand in t, and
    /// with the other sign in D. To first order, for equal weights; 0 against positions.
    double slope_of_noise = 0.0;
};

struct MethodResult {
    double score_probability = 0.0;   ///< coverage probability of E_n
    std::vector<MethodScore> scores;  ///< one a point
    /// Directions in the order of the points, then "all" where there is more than one direction, or one without name.
    std::vector<MethodSummary> summaries;
};

/// Compares a method with a reference method.
///
/// Differences are judged with their full covariance, V + V_ref − C − Cᵀ (gum/comparison/agreement.h), and with the
/// degrees of freedom of their uncertainties by Welch and Satterthwaite (JCGM 100:2008, G.4.1). Equal finite ν and equal
/// u of several points of a side are one estimate. Where it is not known what both methods share, the verdict is one that
/// holds for nothing, for half and for the whole of the smaller uncertainty, as long as points do not share anything with
/// each other and ν is infinite; else |E_n| of every point for the whole of it must not be above 1 besides, and what both
/// can share, at each point apart or at all of them, must not object.
/// \throws InputError, NoResultError  GC-COMPARE-0201 sizes that do not fit, -0202 a correlation beyond 1, -0203 a
///                     direction that is called "all"; those of score() and agreement() with the point in `where`
[[nodiscard]] MethodResult compare_methods(const MethodComparison& comparison);

}  // namespace gumcert::gum
