// A thermometer that is read at three temperatures and corrected by its calibration line (JCGM 100:2008, H.3). The
// parameters of the line are a correlated pair, and all corrected temperatures have them in common.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"

using namespace gumcert::gum;

namespace {

BudgetInput input(const char* name, const char* unit, const StatedQuantity& stated) {
    BudgetInput made;
    made.name = name;
    made.unit = Unit::parse(unit);
    made.components = {stated};  // several are added up
    return made;
}

/// A reading above 20 °C with a last digit of 1 mK.
StatedQuantity reading(double kelvins) {
    return state_distribution(Distribution::uniform(kelvins, 0.0005));
}

}  // namespace

int main() try {
    Budget budget;  // everything in coherent SI units
    budget.model = {{.text = "t = d + y1 + y2*d", .where = "model"}};
    budget.inputs = {input("y1", "K", state_uncertainty(-0.1712, 0.0029, 9)),
                     input("y2", "1", state_uncertainty(0.00218, 0.00067, 9)), input("d", "K", reading(2.0))};
    budget.correlations = {{.first = 0, .second = 1, .r = -0.930}};
    for (const double d : {2.0, 6.0, 10.0}) {
        BudgetInput own = input("d", "K", reading(d));
        own.common = false;  // each point has a reading of its own
        budget.points.push_back({.name = std::to_string(20 + std::lround(d)) + " degC", .inputs = {{2, own}}});
    }
    const BudgetResult result = evaluate_budget(budget, 1);

    const std::vector<std::string> names = budget_result_names(budget, result);
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const BudgetOutputResult& t = result.points[p].outputs.front();
        const RoundedPair printed =
            round_to_uncertainty(20.0 + result.points[p].propagation.value(0), *t.expanded_uncertainty);
        std::printf("%s = %s degC, U = %s K (u = %.4f K, k = %.2f, %s)\n", names[p].c_str(), printed.value.c_str(),
                    printed.U.c_str(), t.standard_uncertainty, *t.coverage_factor, t.coverage.c_str());
    }
    const Eigen::MatrixXd r = correlation_matrix(budget_covariance(result));
    std::printf("r(22 degC, 30 degC) = %.2f, r(26 degC, 30 degC) = %.2f\n", r(0, 2), r(1, 2));
    for (const Diagnostic& note : result.notes) {  // choices that a person should know of
        std::printf("%s: %s\n", note.where.c_str(), note.what.c_str());
    }
    return 0;
} catch (const DiagnosedError& error) {  // carries every problem: where, what is wrong, the rule, what to do
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
