#include "reports/record/make/comparison/method_correlation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gum/comparison/method_correlation.h"
#include "gum/comparison/shared_sources.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/make/comparison/comparison_print.h"
#include "text/lists.h"

namespace gumcert::reports {

namespace {

using jobs::ComparisonJob;
using jobs::MethodComparisonRequest;
using jobs::MethodCorrelation;

/// One entry a source, at the point where it ties both methods most. None where a side has no budget.
std::vector<reports::SharedSource> found_sources(const MethodComparisonRequest& request, const MethodSide& method,
                                                 const MethodSide& reference,
                                                 const std::vector<std::string>& independent,
                                                 std::vector<std::string>& ambiguous) {
    std::vector<reports::SharedSource> found;
    const std::size_t points = std::min(method.sources.all.size(), reference.sources.all.size());
    for (std::size_t i = 0; i < points; ++i) {
        for (const gum::SourceCovariance& shared :
             gum::shared_covariance(method.sources.all[i], reference.sources.all[i], independent)) {
            auto entry = std::find_if(found.begin(), found.end(), [&](const reports::SharedSource& other) {
                return other.source == shared.source;
            });
            if (entry == found.end()) {
                found.push_back({.source = shared.source,
                                 .first = request.laboratory.name,
                                 .second = request.reference.name,
                                 .covariance = 0.0});
                entry = std::prev(found.end());
            }
            if (shared.ambiguous && std::find(ambiguous.begin(), ambiguous.end(), shared.source) == ambiguous.end()) {
                ambiguous.push_back(shared.source);
            }
            if (std::abs(shared.covariance) > std::abs(entry->covariance)) {
                entry->covariance = shared.covariance;
                entry->correlation.number = shared.covariance / (method.uncertainty[i].u * reference.uncertainty[i].u);
            }
        }
    }
    for (reports::SharedSource& source : found) {
        source.correlation.text = printed_score(source.correlation.number);
    }
    return found;
}

/// Names of the sources that both budgets have, also of those that the job calls independent.
std::vector<std::string> sources_in_both(const MethodComparisonRequest& request, const MethodSide& method,
                                         const MethodSide& reference) {
    std::vector<std::string> ambiguous;
    std::vector<std::string> names;
    for (const reports::SharedSource& source : found_sources(request, method, reference, {}, ambiguous)) {
        names.push_back(source.source);
    }
    return names;
}

/// One budget calls an input the same at all points, and the other one calls it another at each.
[[noreturn]] void refuse_shared_sources(const std::vector<std::string>& names) {
    throw gum::InputError(gum::Diagnostic{
        .code = "GC-COMPARE-0207",
        .where = "correlation",
        .what = "both budgets name " + text::listed(names) + ", and what they say of it cannot hold together",
        .rule = "an input whose source both methods share is the same at all points in both budgets, or "
                "\"between_points\": \"independent\" in both",
        .action = "State it alike in both budgets, or list the source in \"independent_sources\"."});
}

/// A source of both budgets that a result of Monte Carlo is not linear in.
void refuse_unknown_covariance(const ComparisonJob& job, const MethodSide& method, const MethodSide& reference) {
    const MethodComparisonRequest& request = *job.methods;
    const auto names_it = [](const MethodSide& side, const std::string& name) {
        return std::any_of(side.sources.all.begin(), side.sources.all.end(), [&](const auto& of_point) {
            return std::any_of(of_point.begin(), of_point.end(),
                               [&](const gum::UncertaintySource& source) { return source.source == name; });
        });
    };
    const auto require = [&](const MethodSide& side, const jobs::ComparisonSide& stated, const MethodSide& other) {
        for (const std::string& name : side.not_linear_in) {
            const bool is_independent = std::find(job.independent_sources.begin(), job.independent_sources.end(),
                                                  name) != job.independent_sources.end();
            if (!is_independent && (names_it(other, name) || other.not_linear_in.contains(name))) {
                throw gum::InputError(covariance_not_known(stated.budget_file, stated.name, name));
            }
        }
    };
    require(method, request.laboratory, reference);
    require(reference, request.reference, method);
}

void add_shared_sources(const ComparisonJob& job, const MethodSide& method, const MethodSide& reference,
                        gum::MethodComparison& comparison, reports::Comparison& record) {
    const MethodComparisonRequest& request = *job.methods;
    refuse_unknown_covariance(job, method, reference);
    std::vector<std::string> ambiguous;
    record.shared_sources = found_sources(request, method, reference, job.independent_sources, ambiguous);
    std::vector<std::string> names;
    for (const reports::SharedSource& source : record.shared_sources) {
        names.push_back(source.source);
    }
    if (names.empty()) {
        record.remarks.emplace_back(
            "The budgets of both methods name no source in common that is shared; the covariance between the methods "
            "is taken as zero.");
    } else {
        comparison.cross_covariance =
            gum::cross_covariance_of_sources(method.sources, reference.sources, job.independent_sources);
        if (ambiguous.empty() && !gum::is_possible_covariance(comparison.covariance, comparison.reference_covariance,
                                                              comparison.cross_covariance)) {
            refuse_shared_sources(names);
        }
        record.remarks.push_back("Both budgets name " + text::listed(names) +
                                 ". The covariance between the methods is computed from what these sources contribute "
                                 "to each of them, with its sign.");
    }
    if (!ambiguous.empty()) {
        record.remarks.push_back("The budgets do not tell which inputs of " + text::listed(ambiguous) +
                                 " are the same quantity: the largest covariance that they can have is taken, which "
                                 "makes |Eₙ| larger.");
    }
    std::vector<std::string> set_aside;
    for (const std::string& name : sources_in_both(request, method, reference)) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            set_aside.push_back(name);
        }
    }
    if (!set_aside.empty()) {
        record.remarks.push_back("Both budgets name " + text::listed(set_aside) +
                                 "; the job states that they are independent of each other all the same.");
    }
}

}  // namespace

Eigen::MatrixXd covariance_of_stated_correlation(double r, const gum::MethodComparison& comparison,
                                                 const std::vector<std::string>& may_share, const std::string& where,
                                                 std::vector<std::string>& remarks) {
    gum::StatedCorrelation stated = gum::stated_correlation(r, comparison, may_share, where);
    const std::string begin = "The stated correlation " + printed_as_stated(r) + " of both methods ";
    if (stated.from == gum::CorrelationFrom::each_point) {
        remarks.push_back(begin +
                          "is taken to hold at equal points; different points of the two methods are taken as "
                          "not correlated with each other.");
    } else {
        remarks.push_back(begin + "is taken to come from an effect that all points " +
                          (stated.from == gum::CorrelationFrom::all_points ? "" : "of a direction ") +
                          "share: the points of the methods share so much that it cannot hold at equal points alone.");
    }
    return std::move(stated.covariance);
}

void add_correlation(const ComparisonJob& job, const MethodSide& method, const MethodSide& reference,
                     gum::MethodComparison& comparison, reports::Comparison& record) {
    const MethodComparisonRequest& request = *job.methods;
    switch (request.correlation) {
        case MethodCorrelation::none:
            record.correlation = "none";
            record.remarks.emplace_back(
                "The job states that both methods have no source of uncertainty in common; the covariance between "
                "them is taken as zero.");
            break;
        case MethodCorrelation::given:
            record.correlation = "given";
            record.correlation_given = request.r;
            comparison.cross_covariance = covariance_of_stated_correlation(
                request.r, comparison, std::vector<std::string>(request.points.size()), "correlation", record.remarks);
            break;
        case MethodCorrelation::unknown:
            record.correlation = "unknown";
            comparison.correlation_unknown = true;
            break;
        case MethodCorrelation::shared_sources:
            record.correlation = "shared_sources";
            add_shared_sources(job, method, reference, comparison, record);
            return;
    }
    const std::vector<std::string> both = sources_in_both(request, method, reference);
    if (!both.empty()) {
        record.remarks.push_back("Both budgets name " + text::listed(both) +
                                 "; the covariance that follows from it is not used, because the job states the "
                                 "correlation of the methods.");
    }
}

}  // namespace gumcert::reports
