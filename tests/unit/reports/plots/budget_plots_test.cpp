#include "reports/plots/budget_plots.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>

#include "tests/support/sample_budget_record.h"

namespace gumcert::reports {
namespace {

Wording words_of_plots() {
    std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/en.json");
    return Wording(nlohmann::json::parse(file));
}

TEST(SharePlot, IsInFallingOrderAndItsLastBarHoldsTheRest) {
    Result result = test::sample_budget_record().results.at(0);
    const BudgetRow row = result.budget.at(0);
    result.budget.clear();
    result.correlation.reset();
    double all = 0.0;
    for (int i = 1; i <= 15; ++i) {  // the smallest first
        result.budget.push_back(row);
        result.budget.back().share = {.number = i / 120.0, .text = std::to_string(i)};
        all += 100.0 * i / 120.0;
    }
    const BarPlot plot = share_plot(result, words_of_plots(), "p");
    ASSERT_EQ(plot.bars.size(), 12U);
    for (std::size_t i = 0; i + 1 < 11; ++i) {
        EXPECT_GT(plot.bars[i].share, plot.bars[i + 1].share) << i;
    }
    EXPECT_EQ(plot.bars[0].text, "15") << "as printed in the budget";
    EXPECT_NEAR(plot.bars[11].share, 100.0 * (1 + 2 + 3 + 4) / 120.0, 1e-12);
    const auto shares = std::accumulate(plot.bars.begin(), plot.bars.end(), 0.0,
                                        [](double sum, const ShareBar& bar) { return sum + bar.share; });
    EXPECT_NEAR(shares, all, 1e-9) << "nothing is lost";
    result.budget.resize(12);
    EXPECT_EQ(share_plot(result, words_of_plots(), "p").bars.size(), 12U) << "no bar of others for one";
}

/// Cells, curve and intervals are densities of one quantity: the deviation from the value.
TEST(MonteCarloPlot, CellsAndCurveHaveTheSameArea) {
    const Result result = test::sample_budget_record().results.at(0);
    ASSERT_TRUE(result.monte_carlo && result.U);
    const DensityPlot plot = monte_carlo_plot(result, words_of_plots(), "p");
    double of_cells = 0.0;
    for (const double cell : plot.cells) {
        of_cells += cell * plot.cell_width;
    }
    double of_curve = 0.0;
    for (std::size_t i = 1; i < plot.curve.size(); ++i) {
        of_curve += 0.5 * (plot.curve[i].y + plot.curve[i - 1].y) * (plot.curve[i].x - plot.curve[i - 1].x);
    }
    EXPECT_NEAR(of_cells, 1.0, 0.02);
    EXPECT_NEAR(of_curve, 1.0, 0.02);
    ASSERT_EQ(plot.intervals.size(), 3U) << "U, shortest and symmetric";
    EXPECT_DOUBLE_EQ(plot.intervals[0].low, -plot.intervals[0].high) << "about the value";
    for (const DensityInterval& interval : plot.intervals) {
        EXPECT_GT(interval.low, plot.low);
        EXPECT_LT(interval.high, plot.high);
    }
}

TEST(ResidualPlot, IsOverXOrOverTheNumberOfTheObservation) {
    FitSummary fit;
    fit.name = "f";
    fit.x_name = "t";
    fit.x_unit = "s";
    fit.x.number = {10.0, 20.0, 30.0};
    fit.residual.number = {2e-6, -1e-6, 3e-6};
    fit.y_unit = "m";
    const Plot over_x = residual_plot(fit, words_of_plots(), "p");
    const std::vector<PlotPoint>& points = over_x.panels.at(0).series.at(0).points;
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[2].x, 30.0);
    EXPECT_NEAR(points[2].y, 3.0, 1e-12);
    EXPECT_NE(over_x.panels[0].y_label.find("10⁻⁶ m"), std::string::npos) << over_x.panels[0].y_label;
    fit.x_name.clear();
    fit.x.number.clear();
    EXPECT_EQ(residual_plot(fit, words_of_plots(), "p").panels[0].series[0].points[2].x, 3.0);
}

}  // namespace
}  // namespace gumcert::reports
