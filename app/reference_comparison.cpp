#include "app/reference_comparison.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/budget_record.h"
#include "app/document_units.h"
#include "app/evaluate_budget.h"
#include "app/method_comparison.h"
#include "app/record_parts.h"
#include "engine/job/reference_budget.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "gum/type_a.h"
#include "gum/type_b.h"

namespace gumcert::app {

namespace {

using engine::ReferenceCorrelation;
using engine::ReferenceMethod;
using engine::ReferencePoint;
using engine::RotaryTableJob;

constexpr std::array<const char*, 3> k_directions{"x", "y", "z"};
// Below it an eigenvalue of a correlation matrix of m quantities is rounding: m times this.
constexpr double k_rounding = 1e-12;

/// The reference method at its points, in micrometres.
struct ReferenceSide {
    Eigen::VectorXd value, u, U, k;
    Eigen::MatrixXd covariance;
    std::vector<reports::BudgetRow> budget;
    std::vector<std::string> remarks;
};

std::string plural(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// ---- the reference from what is known of the indicator --------------------------------------------------------------

struct IndicatorUncertainty {
    double mpe = 0.0, resolution = 0.0, repeatability = 0.0;  ///< standard uncertainties, the last of one reading, [µm]

    [[nodiscard]] double of_mean(std::size_t runs) const {
        return std::hypot(mpe, resolution, gum::u_of_mean(repeatability, runs));
    }
};

reports::BudgetRow indicator_row(const std::string& input, double u, const std::string& distribution, double u_total,
                                 const std::string& source) {
    reports::BudgetRow row;
    row.input = input;
    row.value = 0.0;
    row.unit = "um";
    row.u = u;
    row.type = "B";
    row.distribution = distribution;
    row.sensitivity = 1.0;
    row.contribution = u;
    row.share = std::pow(u / u_total, 2);
    row.source = source;
    row.printed.u = gum::round_significant(row.u, 2);
    row.printed.contribution = gum::round_significant(row.contribution, 2);
    row.printed.share = gum::percent(row.share);
    return row;
}

std::string remark_of_mpe(const ReferenceMethod& reference) {
    if (reference.mpe_common) {
        return "The maximum permissible error bounds the error of the indicator at every reading; how the error runs "
               "from point to point is not known. It is taken as one unknown error that all points of a direction have "
               "in common: of all courses that the bound allows, the one with which many points prove least.";
    }
    return "The maximum permissible error bounds the error of the indicator at every reading. It is taken as an error "
           "of its own at each point, because the description of the indicator says \"mpe_common\": false; if the "
           "points share any of it, they prove less than stated here.";
}

ReferenceSide side_of_indicator(const RotaryTableJob& job, const std::vector<ReferencePoint>& points) {
    const ReferenceMethod& reference = *job.reference;
    const IndicatorUncertainty indicator{
        .mpe = gum::u_from_half_width(reference.maximum_permissible_error) / gum::k_micrometre,
        .resolution = gum::u_from_resolution(reference.resolution) / gum::k_micrometre,
        .repeatability = reference.repeatability / gum::k_micrometre};
    const auto m = static_cast<Eigen::Index>(points.size());
    ReferenceSide side;
    side.value.resize(m);
    side.u.resize(m);
    side.k = Eigen::VectorXd::Constant(
        m, gum::coverage_factor(job.coverage_probability, std::numeric_limits<double>::infinity()));
    side.covariance = Eigen::MatrixXd::Zero(m, m);
    std::size_t runs = 0;
    for (Eigen::Index i = 0; i < m; ++i) {
        const ReferencePoint& point = points[static_cast<std::size_t>(i)];
        runs = std::max(runs, point.runs);
        side.value(i) = point.mean / gum::k_micrometre;
        side.u(i) = indicator.of_mean(point.runs);
        side.covariance(i, i) = side.u(i) * side.u(i);
        for (Eigen::Index j = 0; reference.mpe_common && j < i; ++j) {
            if (points[static_cast<std::size_t>(j)].direction == point.direction) {
                side.covariance(i, j) = side.covariance(j, i) = indicator.mpe * indicator.mpe;
            }
        }
    }
    side.U = side.k.cwiseProduct(side.u);

    const auto row = [&](const std::string& input, double u, const std::string& distribution) {
        side.budget.push_back(indicator_row(input, u, distribution, indicator.of_mean(runs), reference.name));
    };
    row("maximum permissible error of the indicator", indicator.mpe, "uniform");
    row("resolution of the indication", indicator.resolution, "uniform");
    row("repeatability, mean of " + std::to_string(runs) + " runs", gum::u_of_mean(indicator.repeatability, runs),
        "normal");
    if (indicator.mpe > 0.0) {
        side.remarks.push_back(remark_of_mpe(reference));
    }
    return side;
}

// ---- the reference from its budget ----------------------------------------------------------------------------------

[[noreturn]] void refuse_point(const RotaryTableJob& job, std::size_t point, const std::string& code,
                               const std::string& what, const std::string& rule, const std::string& action) {
    throw gum::NoResultError(
        gum::Diagnostic{.code = code,
                        .where = job.reference_budget_file + ", point " + job.reference_budget->points[point].name,
                        .what = what,
                        .rule = rule,
                        .action = action});
}

/// One remark for each kind of note; the budget says the same at many points.
std::vector<std::string> remarks_of(const std::vector<gum::Diagnostic>& notes) {
    std::vector<const gum::Diagnostic*> first;
    std::map<std::string, std::size_t> count;
    for (const gum::Diagnostic& note : notes) {
        if (++count[note.code] == 1) {
            first.push_back(&note);
        }
    }
    std::vector<std::string> remarks;
    for (const gum::Diagnostic* note : first) {
        const std::size_t more = count[note->code] - 1;
        remarks.push_back("Budget of the reference value: " + gum::message(*note) +
                          (more == 0 ? "" : " (the same at " + plural(more, "other point") + ")"));
    }
    return remarks;
}

ReferenceSide side_of_budget(const RotaryTableJob& job) {
    engine::BudgetJob budget = *job.reference_budget;
    // U of both sides for one probability; Monte Carlo of single points would not be looked at.
    budget.coverage_probability = job.coverage_probability;
    for (engine::BudgetOutput& output : budget.outputs) {
        output.coverage_probability.reset();
    }
    budget.monte_carlo.reset();
    BudgetResult result = evaluate_budget(budget, 1);
    const auto m = static_cast<Eigen::Index>(result.points.size());
    ReferenceSide side;
    side.value.resize(m);
    side.u.resize(m);
    side.U.resize(m);
    side.k.resize(m);
    side.covariance = budget_covariance(result) / (gum::k_micrometre * gum::k_micrometre);
    Eigen::Index largest = 0;
    for (Eigen::Index i = 0; i < m; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const BudgetPointResult& point = result.points[at];
        const BudgetOutputResult& output = point.outputs.front();
        if (!output.expanded_uncertainty || !output.coverage_factor) {
            refuse_point(job, at, "GC-REFERENCE-0007", "no expanded uncertainty can be stated: " + output.coverage_note,
                         "a comparison needs the expanded uncertainty of the reference value",
                         "State inputs from which a coverage factor follows.");
        }
        if (!(side.covariance(i, i) > 0.0)) {
            refuse_point(job, at, "GC-REFERENCE-0006", "the standard uncertainty of the reference value is 0 µm",
                         "a measured value has an uncertainty", "State it in the budget.");
        }
        side.value(i) = point.propagation.value(0) / gum::k_micrometre;
        side.u(i) = std::sqrt(side.covariance(i, i));
        side.k(i) = *output.coverage_factor;
        side.U(i) = *output.expanded_uncertainty / gum::k_micrometre;
        largest = side.u(i) > side.u(largest) ? i : largest;
    }
    result.output_units.front() = gum::Unit::parse("um");  // of the rows of the table, whatever the budget says
    reports::EvaluationRecord of_budget = budget_record(budget, result, {}, {}, "");
    side.budget = std::move(of_budget.results[static_cast<std::size_t>(largest)].budget);
    side.remarks.push_back("The uncertainty of the reference values comes from the budget " +
                           job.reference_budget_file + ", evaluated at every point; the table of it is that of the " +
                           "point with the largest, " + budget.points[static_cast<std::size_t>(largest)].name +
                           ". What its inputs have in common between the points is in their covariance.");
    for (std::string& remark : remarks_of(result.notes)) {
        side.remarks.push_back(std::move(remark));
    }
    return side;
}

// ---- correlation of both methods ------------------------------------------------------------------------------------

/// Whether values x and y of covariances V and W can have the covariance C with each other.
bool is_possible(const Eigen::MatrixXd& V, const Eigen::MatrixXd& W, const Eigen::MatrixXd& C) {
    const Eigen::Index m = V.rows();
    Eigen::MatrixXd joint(2 * m, 2 * m);
    joint << V, C, C.transpose(), W;
    const Eigen::VectorXd scale =
        joint.diagonal().unaryExpr([](double variance) { return variance > 0.0 ? 1.0 / std::sqrt(variance) : 0.0; });
    joint = scale.asDiagonal() * joint * scale.asDiagonal();
    joint.diagonal().array() += k_rounding * static_cast<double>(2 * m);
    return Eigen::LLT<Eigen::MatrixXd>(joint).info() == Eigen::Success;
}

/// The covariance of both methods for a stated correlation r at every point.
///
/// An effect of each point apart, C_ii = r u_i u_ref,i, counts the points least; where they share so much that this
/// cannot be, an effect that all points of a direction share, C_ij = r u_i u_ref,j.
Eigen::MatrixXd cross_covariance(const RotaryTableJob& job, const std::vector<ReferencePoint>& points,
                                 const MethodComparison& comparison, std::vector<std::string>& remarks) {
    const double r = job.reference->r;
    const auto m = static_cast<Eigen::Index>(points.size());
    const Eigen::VectorXd u = comparison.covariance.diagonal().cwiseSqrt();
    const Eigen::VectorXd u_reference = comparison.reference_covariance.diagonal().cwiseSqrt();
    Eigen::MatrixXd common = r * u * u_reference.transpose();
    for (Eigen::Index i = 0; i < m; ++i) {
        for (Eigen::Index j = 0; j < m; ++j) {
            if (points[static_cast<std::size_t>(i)].direction != points[static_cast<std::size_t>(j)].direction) {
                common(i, j) = 0.0;
            }
        }
    }
    const std::string stated =
        "The stated correlation " + shortest(r) + " of both methods is taken to come from an effect ";
    Eigen::MatrixXd apart = common.diagonal().asDiagonal();
    if (is_possible(comparison.covariance, comparison.reference_covariance, apart)) {
        remarks.push_back(stated + "of each point apart.");
        return apart;
    }
    if (is_possible(comparison.covariance, comparison.reference_covariance, common)) {
        remarks.push_back(stated + "that all points of a direction share.");
        return common;
    }
    throw gum::InputError(gum::Diagnostic{
        .code = "GC-REFERENCE-0008",
        .where = "reference_method/correlation",
        .what = "the value is " + shortest(r) +
                ", and neither an effect of each point apart nor one that they share can have that correlation",
        .rule = "the covariance matrix of both methods together is positive semi-definite",
        .action = "State a smaller correlation, or \"unknown\"."});
}

std::string word_of(ReferenceCorrelation correlation) {
    switch (correlation) {
        case ReferenceCorrelation::none:
            return "none";
        case ReferenceCorrelation::given:
            return "given";
        case ReferenceCorrelation::unknown:
            break;
    }
    return "unknown";
}

// ---- the comparison -------------------------------------------------------------------------------------------------

MethodComparison method_comparison(const RotaryTableJob& job, const gum::Propagation& displacement,
                                   const std::vector<ReferencePoint>& points, const ReferenceSide& side) {
    MethodComparison comparison;
    comparison.coverage_probability = job.coverage_probability;
    comparison.printed_unit = "um";
    comparison.reference_covariance = side.covariance;
    const auto m = static_cast<Eigen::Index>(points.size());
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < m; ++i) {
        const ReferencePoint& at = points[static_cast<std::size_t>(i)];
        rows.push_back(static_cast<Eigen::Index>(3 * at.angle + at.direction));
        const Reported table = reported(displacement, rows.back(), k_um);
        comparison.points.push_back({.direction = k_directions[at.direction],
                                     .angle_deg = job.measurement.angles_deg[at.angle],
                                     .position = job.measurement.angles_deg[at.angle],
                                     .value = table.value,
                                     .u = table.u,
                                     .U = table.U,
                                     .k = table.k,
                                     .nu = table.nu_eff,
                                     .reference_value = side.value(i),
                                     .reference_u = side.u(i),
                                     .reference_U = side.U(i),
                                     .reference_k = side.k(i)});
    }
    comparison.covariance = displacement.covariance(rows, rows) / (gum::k_micrometre * gum::k_micrometre);
    comparison.correlation_unknown = job.reference->correlation == ReferenceCorrelation::unknown;
    comparison.reference_audited_factor = job.reference->audited_factor;
    for (std::size_t d = 0; d < k_directions.size(); ++d) {
        if (job.reference->published_mean_abs_En[d]) {
            comparison.published_mean_abs_En[k_directions[d]] = *job.reference->published_mean_abs_En[d];
        }
    }
    return comparison;
}

}  // namespace

reports::Comparison reference_comparison(const RotaryTableJob& job, const gum::Propagation& displacement) {
    const ReferenceMethod& reference = *job.reference;
    const std::vector<ReferencePoint> points = engine::reference_points(reference.readings);
    ReferenceSide side = job.reference_budget ? side_of_budget(job) : side_of_indicator(job, points);

    reports::Comparison record;
    record.form = "rotary_table";
    record.unit = "um";
    record.position_name = "angle";
    record.position_unit = "deg";
    record.reference_name = reference.name;
    for (int c = 0; c < 3; ++c) {
        record.contact_point_mm.push_back(reference.contact_point[c] / gum::k_millimetre);
    }
    record.reference_budget = std::move(side.budget);
    record.correlation = word_of(reference.correlation);
    record.published_source = reference.published_source;
    record.audit_finding = reference.audit_finding;
    record.remarks.emplace_back(
        "The displacement of the contact point and its uncertainty are computed from the six error motions with "
        "respect to the axis average line; the readings are compared as they stand.");
    record.remarks.insert(record.remarks.end(), side.remarks.begin(), side.remarks.end());

    MethodComparison comparison = method_comparison(job, displacement, points, side);
    if (reference.correlation == ReferenceCorrelation::given) {
        record.correlation_given = reference.r;
        comparison.cross_covariance = cross_covariance(job, points, comparison, record.remarks);
    }
    compare_methods(record, comparison);
    return record;
}

}  // namespace gumcert::app
