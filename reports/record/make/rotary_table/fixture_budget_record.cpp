#include "reports/record/make/rotary_table/fixture_budget_record.h"

#include <utility>

#include "jobs/budget/budget_job.h"
#include "reports/record/make/budget/budget_record.h"

namespace gumcert::reports {

reports::EvaluationRecord record_of_fixture_budget(const jobs::RotaryTableJob& job,
                                                   const gum::FixtureUncertainty& fixture,
                                                   const std::vector<reports::InputFile>& files) {
    jobs::BudgetJob budget = *job.fixture_budget_job;
    budget.points =
        gum::in_order_of_coordinates(std::move(budget.points), job.measurement.reflectors, job.fixture_budget_file);
    budget.monte_carlo.reset();
    return budget_record(budget, *fixture.budget, files, {}, "");
}

reports::FixtureBudget fixture_budget_record(const jobs::RotaryTableJob& job, const gum::FixtureUncertainty& fixture) {
    reports::FixtureBudget record;
    record.method = "stated";
    if (job.source_paper_fixture) {
        record.method = "source_paper";
        record.remarks = {
            "Standard uncertainty of each coordinate L by equation (11) of the source paper, "
            "sqrt(0.401² + (3.32·10⁻⁷ L)²) µm with L in µm, uncorrelated; U = 2 u_c by its equation (12). It is used "
            "on request, to reproduce the paper.",
            "The terms 3.12·10⁻⁷ L and 1.176·10⁻⁷ L that the paper states combine to 3.334·10⁻⁷ L, not to 3.32·10⁻⁷ L.",
            "The maximum permissible error of the coordinate measuring machine is used as a standard uncertainty; as a "
            "bound of a uniform distribution it would be divided by the square root of 3.",
            "The square of 0.4 + 1.176·10⁻⁷ L is taken without its cross term."};
    } else if (fixture.budget) {
        const std::vector<std::string>& reflectors = job.measurement.reflectors;
        record.method = "budget";
        record.file = job.fixture_budget_file;
        record.largest_coordinate = gum::fixture_coordinate_name(reflectors[fixture.largest / 3], fixture.largest % 3);
        reports::EvaluationRecord of_budget = record_of_fixture_budget(job, fixture, {});
        record.largest = std::move(of_budget.results[fixture.largest].budget);
        record.remarks.emplace_back(
            "The coordinates are correlated through the input quantities that their budgets have in common; the "
            "adjustment uses the full covariance.");
    }
    return record;
}

}  // namespace gumcert::reports
