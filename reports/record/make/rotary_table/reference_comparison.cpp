#include "reports/record/make/rotary_table/reference_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "gum/type_a.h"
#include "gum/type_b.h"
#include "jobs/rotary_table/reference_budget.h"
#include "reports/record/make/comparison/comparison_print.h"
#include "reports/record/make/comparison/method_correlation.h"
#include "reports/record/make/comparison/method_record.h"
#include "reports/record/make/comparison/method_side.h"
#include "reports/record/make/record_parts.h"
#include "reports/record/make/rotary_table/document_units.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using engine::ReferenceCorrelation;
using engine::ReferenceMethod;
using jobs::ReferencePoint;
using jobs::RotaryTableJob;

constexpr std::array<const char*, 3> k_directions{"x", "y", "z"};

// ---- the reference from what is known of the indicator --------------------------------------------------------------

struct IndicatorUncertainty {
    double mpe = 0.0, resolution = 0.0, repeatability = 0.0;  ///< standard uncertainties, the last of one reading, [µm]

    [[nodiscard]] double of_mean(std::size_t runs) const {
        return std::hypot(mpe, resolution, gum::u_of_mean(repeatability, runs));
    }
};

reports::BudgetRow budget_row(const std::string& input, double u, const std::string& distribution, double u_total,
                              const std::string& source) {
    reports::BudgetRow row;
    row.input = input;
    row.value.number = 0.0;
    row.unit = "um";
    row.u = shown_significant(u, 2);
    row.type = "B";
    row.distribution = distribution;
    row.sensitivity.number = 1.0;
    row.contribution = row.u;
    row.share = shown_share(std::pow(u / u_total, 2));
    row.source = source;
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

MethodSide side_of_indicator(const RotaryTableJob& job, const std::vector<ReferencePoint>& points) {
    const ReferenceMethod& reference = *job.reference;
    const IndicatorUncertainty indicator{
        .mpe = gum::u_from_half_width(reference.maximum_permissible_error) / gum::k_micrometre,
        .resolution = gum::u_from_resolution(reference.resolution) / gum::k_micrometre,
        .repeatability = reference.repeatability / gum::k_micrometre};
    const auto m = static_cast<Eigen::Index>(points.size());
    MethodSide side;
    const double k = gum::coverage_factor(job.coverage_probability, std::numeric_limits<double>::infinity());
    side.covariance = Eigen::MatrixXd::Zero(m, m);
    std::size_t runs = 0;
    for (Eigen::Index i = 0; i < m; ++i) {
        const ReferencePoint& point = points[static_cast<std::size_t>(i)];
        const double u = indicator.of_mean(point.runs);
        runs = std::max(runs, point.runs);
        side.value.push_back(point.mean / gum::k_micrometre);
        side.uncertainty.push_back({.u = u, .U = k * u, .k = k});
        side.covariance(i, i) = u * u;
        for (Eigen::Index j = 0; reference.mpe_common && j < i; ++j) {
            if (points[static_cast<std::size_t>(j)].direction == point.direction) {
                side.covariance(i, j) = side.covariance(j, i) = indicator.mpe * indicator.mpe;
            }
        }
    }

    const auto row = [&](const std::string& input, double u, const std::string& distribution) {
        side.budget.push_back(budget_row(input, u, distribution, indicator.of_mean(runs), reference.name));
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

// ---- the comparison -------------------------------------------------------------------------------------------------

MethodSide side_of_budget(const RotaryTableJob& job) {
    MethodBudget budget{*job.reference_budget, job.reference_budget_file, job.reference->name, {}, {}};
    for (const gum::BudgetPoint& point : job.reference_budget->points) {  // the reader made them of the readings
        budget.point.push_back(budget.point.size());
        budget.name.push_back(point.name);
    }
    return side_of_budget(budget, gum::Unit::parse("um"), job.coverage_probability);
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

gum::MethodComparison method_comparison(const RotaryTableJob& job, const gum::QuantityUncertainty& displacement,
                                        const std::vector<ReferencePoint>& points, const MethodSide& side) {
    gum::MethodComparison comparison;
    comparison.coverage_probability = job.coverage_probability;
    comparison.reference_covariance = side.covariance;
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ReferencePoint& at = points[i];
        const gum::ResultUncertainty& of_reference = side.uncertainty[i];
        rows.push_back(static_cast<Eigen::Index>(3 * at.angle + at.direction));
        const reports::StatedValue table = reports::stated_value(displacement.budget, rows.back(), gum::k_um);
        comparison.points.push_back({.direction = k_directions[at.direction],
                                     .angle_deg = job.measurement.angles_deg[at.angle],
                                     .position = job.measurement.angles_deg[at.angle],
                                     .value = table.value,
                                     .u = table.u,
                                     .U = table.U,
                                     .k = table.k,
                                     .nu = table.nu_eff,
                                     .reference_value = side.value[i],
                                     .reference_u = of_reference.u,
                                     .reference_U = of_reference.U,
                                     .reference_k = of_reference.k,
                                     .reference_nu = reports::finite_or_none(of_reference.degrees_of_freedom),
                                     .reference_p = of_reference.coverage_probability,
                                     .reference_of_scores = of_reference.of_scores});
    }
    comparison.covariance = displacement.covariance.of(rows) / (gum::k_micrometre * gum::k_micrometre);
    comparison.correlation_unknown = job.reference->correlation == ReferenceCorrelation::unknown;
    comparison.reference_audited_factor = job.reference->audited_factor;
    return comparison;
}

/// What each source contributes to the displacement of the contact point where |E_n| is largest.
std::vector<reports::BudgetRow> budget_of_displacement(const gum::UncertaintyBudget& budget,
                                                       const std::vector<ReferencePoint>& points,
                                                       const reports::Comparison& record) {
    const auto largest = std::max_element(record.points.begin(), record.points.end(), [](const auto& a, const auto& b) {
        return std::abs(a.En.number.value_or(0.0)) < std::abs(b.En.number.value_or(0.0));
    });
    std::vector<reports::BudgetRow> rows;
    if (largest == record.points.end()) {
        return rows;
    }
    const ReferencePoint& at = points[static_cast<std::size_t>(largest - record.points.begin())];
    const auto output = static_cast<Eigen::Index>(3 * at.angle + at.direction);
    for (const gum::BudgetContribution& source : budget.shares_by_source) {
        if (source.variance[output] > 0.0) {
            rows.push_back(budget_row(source.name, std::sqrt(source.variance[output]) / gum::k_micrometre, "normal",
                                      budget.standard_uncertainty[output] / gum::k_micrometre, ""));
        }
    }
    return rows;
}

void add_published(const ReferenceMethod& reference, reports::Comparison& record) {
    for (reports::ComparisonSummary& row : record.summary) {
        for (std::size_t d = 0; d < k_directions.size(); ++d) {
            if (row.direction == k_directions[d]) {
                row.published_mean_abs_En.number = reference.published_mean_abs_En[d];
                row.published_mean_abs_En.text = printed_as_stated(row.published_mean_abs_En.number);
            }
        }
    }
}

/// What all readings of a direction may have wrong: right is factor · reading + constant.
struct ReadingFault {
    double factor = 1.0, constant = 0.0;  ///< the constant in µm
};

/// Whether the readings of a direction are judged to agree where this is put right: what is told of them is what this
/// comparison says of readings that were right.
bool agree_without(const ReadingFault& fault, const std::string& direction, gum::MethodComparison comparison) {
    for (gum::ComparedPoint& point : comparison.points) {
        if (point.direction == direction) {
            point.reference_value = fault.factor * point.reference_value + fault.constant;
        }
    }
    for (const gum::MethodSummary& summary : gum::compare_methods(comparison).summaries) {
        if (summary.direction == direction) {
            return std::min(summary.verdict, summary.verdict_audited.value_or(summary.verdict)) >
                   gum::AgreementVerdict::correlation_unknown;
        }
    }
    return false;
}

/// What the readings of a direction that disagree may have wrong as a whole: their sign, their unit, where they count from.
/// Told where they agree without it, and where that leaves less than half of what the uncertainties allow, and a third of
/// the differences: of few readings, or small displacements, nothing is.
void add_hints_at_readings(const gum::MethodComparison& comparison, reports::Comparison& record) {
    constexpr std::size_t k_fewest = 4;
    constexpr double k_of_expanded = 0.5;
    constexpr double k_of_differences = 1.0 / 3.0;
    for (const reports::ComparisonSummary& summary : record.summary) {
        std::vector<const reports::ComparisonPoint*> points;
        for (const reports::ComparisonPoint& point : record.points) {
            if (point.direction == summary.direction && point.contributes && point.U_D.number) {
                points.push_back(&point);
            }
        }
        if (summary.verdict != "disagreement" || points.size() < k_fewest) {
            continue;
        }
        const auto root_mean_square = [&](const auto& of) {
            double squares = 0.0;
            for (const reports::ComparisonPoint* point : points) {
                squares += std::pow(of(*point), 2);
            }
            return std::sqrt(squares / static_cast<double>(points.size()));
        };
        double mean = 0.0;
        for (const reports::ComparisonPoint* point : points) {
            mean += point->D.number / static_cast<double>(points.size());
        }
        const double limit = std::min(k_of_expanded * root_mean_square([](const auto& p) { return *p.U_D.number; }),
                                      k_of_differences * root_mean_square([](const auto& p) { return p.D.number; }));
        const auto explains = [&](const ReadingFault& fault) {
            const double left = root_mean_square([&](const auto& p) {
                return p.D.number + (1.0 - fault.factor) * p.reference_value.number - fault.constant;
            });
            return left < limit && agree_without(fault, summary.direction, comparison);
        };
        if (explains({.factor = -1.0})) {
            record.remarks.push_back("In direction " + summary.direction +
                                     " the readings agree when they have the other sign: see in which sense the "
                                     "indicator counts.");
        } else if (explains({.factor = 1000.0})) {
            record.remarks.push_back("In direction " + summary.direction +
                                     " the readings agree when they are multiplied by 1000: see whether they are in "
                                     "millimetres.");
        } else if (explains({.constant = mean})) {
            record.remarks.push_back("In direction " + summary.direction +
                                     " the readings agree but for one constant, " +
                                     text::significant(std::abs(mean), 3) +
                                     " µm: they count from where the indicator was set to zero, and displacements from "
                                     "the axis average line.");
        }
    }
}

}  // namespace

reports::Comparison reference_comparison(const RotaryTableJob& job, const gum::QuantityUncertainty& displacement) {
    const ReferenceMethod& reference = *job.reference;
    const std::vector<ReferencePoint> points = jobs::reference_points(reference.readings);
    MethodSide side = job.reference_budget ? side_of_budget(job) : side_of_indicator(job, points);

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
    if (!side.origin.empty()) {
        record.remarks.push_back(side.origin);
    }
    record.remarks.insert(record.remarks.end(), side.remarks.begin(), side.remarks.end());

    gum::MethodComparison comparison = method_comparison(job, displacement, points, side);
    if (reference.correlation == ReferenceCorrelation::given) {
        record.correlation_given = reference.r;
        std::vector<std::string> directions;  // the indicator is set up anew for each
        for (const ReferencePoint& point : points) {
            directions.emplace_back(k_directions[point.direction]);
        }
        comparison.cross_covariance = covariance_of_stated_correlation(reference.r, comparison, directions,
                                                                       "reference_method/correlation", record.remarks);
    }
    add_method_comparison(comparison, "um", record);
    record.method_budget = budget_of_displacement(displacement.budget, points, record);
    add_published(reference, record);
    add_hints_at_readings(comparison, record);
    return record;
}

}  // namespace gumcert::reports
