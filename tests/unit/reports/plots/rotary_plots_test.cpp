#include "reports/plots/rotary_plots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>

#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

Wording words_of_rotary_plots() {
    std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/en.json");
    return Wording(nlohmann::json::parse(file));
}

RotaryTable sample_table() {
    return test::sample_record().rotary.value();
}

TEST(RotaryPlots, LayoutHasAllStationsAndReflectorsOrIsLeftOut) {
    RotaryTable table = sample_table();
    const std::optional<LayoutPlot> plot = layout_plot(table, words_of_rotary_plots());
    ASSERT_TRUE(plot);
    EXPECT_EQ(plot->stations.size(), table.stations.size());
    EXPECT_EQ(plot->reflectors.size(), table.reflectors.size());
    ASSERT_TRUE(reflector_plot(table, words_of_rotary_plots()));
    for (Reflector& reflector : table.reflectors) {
        reflector.home_position_mm = {};
    }
    EXPECT_FALSE(layout_plot(table, words_of_rotary_plots())) << "an old record does not say where they stood";
    EXPECT_FALSE(reflector_plot(table, words_of_rotary_plots()));
}

/// Each distance stands in one panel and one series; what was removed makes no axis longer, and is drawn at its edge.
TEST(RotaryPlots, ResidualsStandOnceEach) {
    RotaryTable table = sample_table();
    ASSERT_GT(table.reliability.size(), 2U);
    table.reliability[0].removed = true;
    table.reliability[0].residual_um = 1e6;
    const Plot plot = station_residual_plot(table, words_of_rotary_plots());
    ASSERT_EQ(plot.panels.size(), std::min(table.stations.size(), k_most_residual_panels));
    std::size_t drawn = 0;
    for (const PlotPanel& panel : plot.panels) {
        EXPECT_EQ(panel.y_most, plot.panels[0].y_most) << "one scale";
        EXPECT_LT(panel.y_most, 1e5);
        for (const PlotSeries& series : panel.series) {
            drawn += series.points.size();
        }
    }
    EXPECT_EQ(drawn, table.reliability.size());
}

TEST(RotaryPlots, RedundancyCountsWhatWasKept) {
    RotaryTable table = sample_table();
    table.reliability.resize(4);
    const double numbers[] = {0.0, 0.999, 1.0, 0.5};
    for (std::size_t i = 0; i < 4; ++i) {
        table.reliability[i].removed = false;
        table.reliability[i].redundancy_number = numbers[i];
    }
    HistogramPlot plot = redundancy_plot(table, words_of_rotary_plots());
    EXPECT_EQ(plot.counts.front(), 1.0);
    EXPECT_EQ(plot.counts.back(), 2.0) << "1 belongs to the last cell";
    EXPECT_EQ(std::accumulate(plot.counts.begin(), plot.counts.end(), 0.0), 4.0);
    table.reliability[3].removed = true;
    plot = redundancy_plot(table, words_of_rotary_plots());
    EXPECT_EQ(std::accumulate(plot.counts.begin(), plot.counts.end(), 0.0), 3.0);
}

TEST(RotaryPlots, SourcesOfAQuantityArePercentOfItsVariance) {
    const RotaryTable table = sample_table();
    const StackedPlot plot = source_plot(table, words_of_rotary_plots());
    ASSERT_EQ(plot.bars.size(), table.budget_summary.size());
    EXPECT_EQ(plot.parts.size(), table.budget_sources.size());
    for (std::size_t i = 0; i < plot.bars.size(); ++i) {
        ASSERT_EQ(plot.bars[i].shares.size(), plot.parts.size());
        for (std::size_t k = 0; k < plot.parts.size(); ++k) {
            EXPECT_DOUBLE_EQ(plot.bars[i].shares[k], 100.0 * table.budget_summary[i].shares.number[k]);
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
