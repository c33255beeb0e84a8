#include "reports/record/make/comparison/method_side.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "certificate/statement_of_uncertainty.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/budget/expanded_about_value.h"
#include "gum/budget/other_choice.h"
#include "gum/budget/reported_covariance.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"
#include "jobs/budget/budget_results.h"
#include "reports/record/make/budget/budget_record.h"
#include "reports/record/make/budget/budget_reported_result.h"
#include "reports/record/make/comparison/budget_sources.h"
#include "reports/record/make/comparison/comparison_print.h"

namespace gumcert::reports {

namespace {

constexpr const char* k_law_against_evidence = "GC-BUDGET-0026";
constexpr const char* k_other_choice = "GC-BUDGET-0044";
constexpr const char* k_value_outside = "GC-BUDGET-0045";

std::string place_of(const MethodBudget& budget, std::size_t i) {
    return budget.name[i].empty() ? budget.file : budget.file + ", point " + budget.name[i];
}

[[noreturn]] void refuse_point(const MethodBudget& budget, std::size_t i, const std::string& code,
                               const std::string& what, const std::string& rule, const std::string& action) {
    throw gum::NoResultError(
        gum::Diagnostic{.code = code, .where = place_of(budget, i), .what = what, .rule = rule, .action = action});
}

/// A budget as it evaluates for itself, and what a comparison asks of it beside that.
class EvaluatedBudget {
public:
    EvaluatedBudget(const MethodBudget& budget, double coverage_probability)
        : budget_(budget),
          p_of_scores_(gum::en_coverage_probability(coverage_probability)),
          result_(gum::evaluate_budget(budget.job, 1)) {
        if (gum::budget_result_count(result_) > 1) {
            covariance_ = gum::reported_covariance(budget.job, result_);
            gum::note_covariance(budget.job, covariance_, result_);
        }
    }

    [[nodiscard]] const gum::BudgetResult& result() const { return result_; }
    [[nodiscard]] const gum::BudgetPointResult& point(std::size_t i) const { return result_.points[budget_.point[i]]; }

    /// What is reported of a point of the comparison, in the unit of the comparison.
    [[nodiscard]] reports::ReportedResult reported(std::size_t i, const gum::Unit& unit) const {
        const gum::BudgetPointResult& at = point(i);
        const double y = at.propagation.value(0);
        const double rounding = at.model->rounding(gum::input_estimates(*at.model))(0);
        const auto in = [&](const gum::Unit& of) {
            return reported_of(at.outputs.front(), recorded_value(y, rounding, of), of, budget_.job);
        };
        reports::ReportedResult taken = in(unit);
        // Whether an interval prints as symmetric is decided in the unit that the budget reports in.
        const reports::ReportedResult own = in(jobs::result_unit(budget_.job, at, 0));
        if (!own.U) {
            taken.U.reset();
        } else if (!taken.U && taken.interval) {
            taken.U = 0.5 * ((*taken.interval)[1] - (*taken.interval)[0]);
        }
        return taken;
    }

    [[nodiscard]] gum::ResultUncertainty uncertainty(std::size_t i, const gum::Unit& unit) {
        const reports::ReportedResult stated = reported(i, unit);
        require_uncertainty(i, stated);
        const gum::BudgetOutputResult& output = point(i).outputs.front();
        const double u = *stated.u;
        const double p = stated.coverage_probability;
        const double U = stated.U ? *stated.U : about_value(i, p, unit);
        gum::ResultUncertainty taken{.u = u,
                                     .U = U,
                                     // The k that the budget states: U/u has another last digit.
                                     .k = !output.by_monte_carlo && stated.k ? *stated.k : U / u,
                                     .degrees_of_freedom = output.by_monte_carlo
                                                               ? std::numeric_limits<double>::infinity()
                                                               : output.degrees_of_freedom};
        taken.coverage_probability = p;
        const bool is_about_95 = gum::en_coverage_probability(p) == p;
        if (is_about_95) {
            taken.of_scores = gum::EnUncertainty{.U = U, .k = taken.k, .converted = false};
        } else {
            const double of_scores =
                output.by_monte_carlo ? about_value(i, p_of_scores_, unit) : by_law_of_scores(i, unit);
            taken.of_scores = gum::EnUncertainty{.U = of_scores, .k = of_scores / u, .converted = true};
        }
        return taken;
    }

    /// Covariance of the points of the comparison as they are reported, coherent SI.
    [[nodiscard]] Eigen::MatrixXd covariance() const {
        const auto m = static_cast<Eigen::Index>(budget_.point.size());
        if (gum::budget_result_count(result_) == 1) {
            return Eigen::MatrixXd::Constant(m, m, std::pow(reported_u(0), 2));
        }
        const bool is_known = std::none_of(budget_.point.begin(), budget_.point.end(), [&](std::size_t at) {
            return std::isnan(covariance_(static_cast<Eigen::Index>(at), static_cast<Eigen::Index>(at)));
        });
        if (!is_known) {
            throw gum::NoResultError(gum::Diagnostic{
                .code = "GC-COMPARE-0209",
                .where = budget_.file,
                .what = "results of Monte Carlo at " + std::to_string(gum::budget_result_count(result_)) +
                        " points, whose covariance is not stated",
                .rule = "points are compared with the covariance that they have with each other",
                .action = "Split the budget and the comparison: the covariance is drawn for up to " +
                          std::to_string(gum::k_most_drawn_together) + " points."});
        }
        Eigen::MatrixXd taken(m, m);
        for (Eigen::Index a = 0; a < m; ++a) {
            for (Eigen::Index b = 0; b < m; ++b) {
                taken(a, b) = covariance_(static_cast<Eigen::Index>(budget_.point[static_cast<std::size_t>(a)]),
                                          static_cast<Eigen::Index>(budget_.point[static_cast<std::size_t>(b)]));
            }
        }
        return taken;
    }

private:
    [[nodiscard]] double reported_u(std::size_t i) const {
        const gum::BudgetOutputResult& output = point(i).outputs.front();
        return output.by_monte_carlo ? output.monte_carlo->standard_uncertainty : output.standard_uncertainty;
    }

    void require_uncertainty(std::size_t i, const reports::ReportedResult& stated) const {
        const gum::BudgetOutputResult& output = point(i).outputs.front();
        if (!stated.u) {
            refuse_point(budget_, i, "GC-COMPARE-0208",
                         "a coverage interval alone is reported: the distribution has no standard uncertainty",
                         "a comparison needs the standard uncertainty of both values (JCGM 101:2008, 6.4.9.4)",
                         "Take more readings (ν above 2), or keep a divisor away from 0.");
        }
        if (!output.by_monte_carlo && (!stated.U || !output.coverage_factor)) {
            refuse_point(budget_, i, "GC-COMPARE-0205",
                         "no expanded uncertainty can be stated: " + output.coverage_note,
                         "a comparison needs the expanded uncertainty of both values",
                         "State inputs from which a coverage factor follows.");
        }
        if (!(*stated.u > 0.0)) {
            refuse_point(budget_, i, "GC-COMPARE-0206", "the standard uncertainty is 0",
                         "a measured value has an uncertainty", "State it in the budget.");
        }
    }

    [[nodiscard]] double about_value(std::size_t i, double p, const gum::Unit& unit) const {
        return unit.difference_from_si(gum::expanded_about_value(point(i), 0, p));
    }

    /// U of the law for the probability of the scores, from the distributions that gave U for another one.
    [[nodiscard]] double by_law_of_scores(std::size_t i, const gum::Unit& unit) {
        if (!for_scores_) {
            jobs::BudgetJob job = budget_.job;
            job.coverage_probability = p_of_scores_;
            for (gum::BudgetOutput& output : job.outputs) {
                output.coverage_probability.reset();
            }
            job.monte_carlo.reset();
            for_scores_ = gum::evaluate_budget(job, 1);
        }
        return unit.difference_from_si(*for_scores_->points[budget_.point[i]].outputs.front().expanded_uncertainty);
    }

    const MethodBudget& budget_;
    double p_of_scores_;
    gum::BudgetResult result_;
    std::optional<gum::BudgetResult> for_scores_;
    Eigen::MatrixXd covariance_;  ///< of all results; empty of one
};

/// How U of a budget is to be read where its k is not that of a normal or t-distribution, or only an interval is stated.
void add_remarks_on_U(const MethodBudget& budget, EvaluatedBudget& evaluated, const gum::Unit& unit, MethodSide& side) {
    const std::string in_unit = gum::unit_for_people(unit.text());
    std::size_t of_interval = 0;
    std::size_t of_distribution = 0;
    std::string interval;
    std::string distribution;
    for (std::size_t i = 0; i < budget.point.size(); ++i) {
        const gum::ResultUncertainty& u = side.uncertainty[i];
        const reports::ReportedResult reported = evaluated.reported(i, unit);
        const std::string at = budget.name[i].empty() ? "" : " at point " + budget.name[i];
        const std::string percent = certificate::printed_coverage_probability(reported.coverage_probability) + " %";
        if (!reported.U) {
            if (of_interval++ == 0) {
                const gum::RoundedPair pair = gum::round_to_uncertainty(reported.value, u.U, 2);
                interval = "the interval " + reported.printed_low + " … " + reported.printed_high + " " + in_unit + at +
                           " does not lie symmetric about " + pair.value + " " + in_unit +
                           ". A score takes U alone: U = " + pair.U + " " + in_unit +
                           " is the one with which value ± U " + "holds " + percent + " of the trials";
            }
        } else if (!evaluated.point(i).outputs.front().by_monte_carlo &&
                   evaluated.point(i).outputs.front().coverage == "convolution" && of_distribution++ == 0) {
            distribution = "U = " + printed_uncertainty(u.U) + " " + in_unit + at + " covers " + percent +
                           " with k = " + printed_score(u.k) + ": " + evaluated.point(i).outputs.front().coverage_note;
        }
    }
    const auto say = [&](std::size_t count, const std::string& what) {
        if (count > 0) {
            side.remarks.push_back("Budget of " + budget.method + ": " + what +
                                   (count == 1 ? "." : " (and alike at " + std::to_string(count - 1) + " more)."));
        }
    };
    say(of_interval, interval);
    say(of_distribution, distribution);
}

}  // namespace

MethodSide side_of_budget(const MethodBudget& budget, const gum::Unit& unit, double coverage_probability) {
    EvaluatedBudget evaluated(budget, coverage_probability);
    MethodSide side;
    std::size_t largest = 0;
    for (std::size_t i = 0; i < budget.point.size(); ++i) {
        const std::size_t at = budget.point[i];
        side.uncertainty.push_back(evaluated.uncertainty(i, unit));
        side.value.push_back(evaluated.reported(i, unit).value);
        side.sources.all.push_back(uncertainty_sources(budget.job, evaluated.result(), at, 0, unit));
        side.sources.common.push_back(uncertainty_sources(budget.job, evaluated.result(), at, 0, unit, true));
        if (evaluated.point(i).outputs.front().by_monte_carlo) {
            side.not_linear_in.merge(sources_beyond_first_order(budget.job, evaluated.result(), at, 0));
        }
        largest = side.uncertainty[i].u > side.uncertainty[largest].u ? i : largest;
    }
    const double scale = unit.difference_from_si(1.0);
    side.covariance = evaluated.covariance() * scale * scale;
    gum::BudgetResult result = evaluated.result();
    for (gum::BudgetPointResult& point : result.points) {
        point.outputs.front().unit = unit;  // the rows of its table as well are in the unit of the comparison
    }
    jobs::BudgetJob job = budget.job;
    job.point_units.clear();
    job.warnings.clear();  // the comparison has them from its reader
    reports::EvaluationRecord of_budget = budget_record(job, result, {}, {}, "");
    side.budget = std::move(of_budget.results[budget.point[largest]].budget);
    side.origin =
        "Values and uncertainties of " + budget.method + " come from the budget " + budget.file +
        (budget.point.size() == 1 ? "."
                                  : ", evaluated at every point; the table of it is that of the point with the largest "
                                    "uncertainty, " +
                                        budget.name[largest] +
                                        ". What its inputs have in common between the points is in their covariance.");
    add_remarks_of_evaluation("Budget of " + budget.method, of_budget.diagnostics, side.remarks);
    add_remarks_on_U(budget, evaluated, unit, side);
    bool is_refuted = false;
    bool is_in_doubt = false;
    for (std::size_t i = 0; i < budget.point.size(); ++i) {
        is_refuted = is_refuted || !evaluated.point(i).outputs.front().against.empty();
        is_in_doubt = is_in_doubt || gum::is_mean_in_doubt(evaluated.point(i), 0);
    }
    for (const gum::Diagnostic& said : of_budget.diagnostics) {
        const bool doubts = said.code == k_other_choice || said.code == k_value_outside;
        if ((is_refuted && said.code == k_law_against_evidence) || (is_in_doubt && doubts)) {
            side.refuted.push_back(
                {.side = budget.method, .file = budget.file, .id = {}, .message = said.code, .what = said.what});
        }
    }
    return side;
}

void add_remarks_of_evaluation(const std::string& whose, const std::vector<gum::Diagnostic>& notes,
                               std::vector<std::string>& remarks) {
    std::map<std::string, std::size_t> count;
    for (const gum::Diagnostic& note : notes) {
        ++count[note.code];
    }
    for (const gum::Diagnostic& note : notes) {
        const std::size_t of_kind = std::exchange(count[note.code], 0);
        if (of_kind > 0) {
            remarks.push_back(whose + ": " + gum::message(note) +
                              (of_kind == 1 ? "" : " (and " + std::to_string(of_kind - 1) + " more of this kind)"));
        }
    }
}

gum::Diagnostic covariance_not_known(const std::string& where, const std::string& whose, const std::string& source) {
    return {.code = "GC-COMPARE-0210",
            .where = where,
            .what = "the result of " + whose + " is one of Monte Carlo, is not linear in what comes from " + source +
                    ", and is compared with a result that depends on " + source + " too",
            .rule =
                "what two results have in common through a source is the product of their first-order terms "
                "(JCGM 100:2008, F.1.2.3), which hold where both are nearly linear in it",
            .action = "State the correlation of both results, or list the source in \"independent_sources\"."};
}

}  // namespace gumcert::reports
