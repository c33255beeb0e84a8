#include "reports/record/make/comparison/compared_job_side.h"

#include <cmath>
#include <utility>

#include "gum/circle_closure/evaluate_circle_closure.h"
#include "gum/coverage.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "jobs/circle_closure/circle_closure_job.h"
#include "jobs/rotary_table/rotary_table_job.h"

namespace gumcert::reports {

namespace {

using Eigen::Index;

/// The rows of a result that are compared, in the unit of the comparison.
/// \param covariance  of these rows, in SI
MethodSide side_of_outputs(const gum::UncertaintyBudget& propagation, const Eigen::MatrixXd& covariance,
                           const std::vector<Index>& rows, const gum::Unit& unit, double coverage_probability) {
    const double scale = unit.difference_from_si(1.0);
    MethodSide side;
    for (const Index row : rows) {
        const double nu = propagation.effective_degrees_of_freedom(row);
        const double k = gum::coverage_factor(coverage_probability, nu);
        const double u = scale * propagation.standard_uncertainty(row);
        side.value.push_back(scale * propagation.value(row));
        side.uncertainty.push_back({.u = u, .U = k * u, .k = k, .degrees_of_freedom = nu});
    }
    side.covariance = scale * scale * covariance;
    return side;
}

}  // namespace

MethodSide side_of_job(const jobs::ComparisonSide& side, const gum::Unit& unit, double coverage_probability,
                       const JobJudges& judges) {
    constexpr std::size_t k_motions = 6;
    constexpr std::size_t k_first_rotation = 3;
    std::vector<Index> rows;
    MethodSide out;
    JudgedJob judged;
    if (side.circle_closure) {
        jobs::CircleClosureJob job = *side.circle_closure;
        job.monte_carlo.reset();
        for (const std::size_t angle : side.job_angles) {
            rows.push_back(static_cast<Index>(angle + (side.of_artefact ? job.measurement.steps : 0)));
        }
        const gum::CircleClosureResult result = gum::evaluate_circle_closure(job, 1);
        const gum::Propagation& propagation = result.propagation;
        judged = judges.circle_closure(job, result);
        out = side_of_outputs(propagation, propagation.covariance(rows, rows), rows, unit, coverage_probability);
    } else {
        jobs::RotaryTableJob job = *side.rotary_table;
        job.monte_carlo.reset();
        job.reference.reset();
        const auto axial = static_cast<std::size_t>(engine::axial_coordinate(job.measurement.axis));
        for (const std::size_t angle : side.job_angles) {
            rows.push_back(static_cast<Index>(k_motions * angle + k_first_rotation + axial));
        }
        const gum::RotaryTableResult result = gum::evaluate_rotary_table(job, 1);
        const gum::QuantityUncertainty& reported = result.reported;
        judged = judges.rotary_table(job, result);
        out = side_of_outputs(reported.budget, reported.covariance.of(rows), rows, unit, coverage_probability);
    }
    out.origin = "Values, uncertainties and covariance of " + side.name + " come from the job " + side.job_file +
                 ", evaluated by the law of propagation.";
    for (gum::Diagnostic& said : judged.diagnostics) {
        if (said.severity != gum::Severity::note) {
            said.where = said.where.empty() ? side.job_file : side.job_file + ", " + said.where;
            out.warnings.push_back(std::move(said));
        }
    }
    add_remarks_of_evaluation("Job of " + side.name, out.warnings, out.remarks);
    out.refuted = refuted_by(judged.findings, side.name, side.job_file);
    return out;
}

void take_off_mean(MethodSide& side, double coverage_probability) {
    const auto n = static_cast<Index>(side.value.size());
    const Eigen::MatrixXd D =
        Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd::Constant(n, n, 1.0 / static_cast<double>(n));
    const Eigen::VectorXd x = D * Eigen::Map<const Eigen::VectorXd>(side.value.data(), n);
    const Eigen::MatrixXd V = D * side.covariance * D.transpose();
    side.covariance = 0.5 * (V + V.transpose());
    for (Index i = 0; i < n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        gum::ResultUncertainty& u = side.uncertainty[at];
        side.value[at] = x(i);
        u.u = std::sqrt(std::max(side.covariance(i, i), 0.0));
        u.k = gum::coverage_factor(coverage_probability, u.degrees_of_freedom);
        u.U = u.k * u.u;
        u.stated_as_expanded = false;
        // Less the mean it is another quantity: the distribution of the value does not say its U.
        u.coverage_probability.reset();
        u.of_scores.reset();
    }
}

}  // namespace gumcert::reports
