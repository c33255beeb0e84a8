#include "reports/audit/audit_plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "reports/forms/asset_files.h"
#include "tests/support/sample_audit.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

AuditView plotted(const audit::AuditReport& report) {
    return make_audit_view(std::vector{report}, test::sample_rules(), {});
}

TEST(AuditPlots, AnArrowPointsFromBeforeToAfter) {
    const std::string grows = change_arrow(1.0, 2.0, 4.0);
    EXPECT_THAT(grows, HasSubstr("class=\"arrow grows\""));
    EXPECT_THAT(grows, HasSubstr("<circle class=\"start\" cx=\"62\""));
    EXPECT_THAT(grows, HasSubstr("d=\"M120 10L112 5"));
    EXPECT_THAT(grows, HasSubstr("aria-hidden=\"true\""));
    EXPECT_THAT(change_arrow(2.0, 1.0, 4.0), HasSubstr("d=\"M62 10L70 5"));
    EXPECT_THAT(change_arrow(1.0, 1.0, 4.0), Not(HasSubstr("path")));
    EXPECT_THAT(change_arrow(1.0, std::numeric_limits<double>::infinity(), 4.0), Not(HasSubstr("nan")));
    EXPECT_THAT(change_arrow(1.0, 2.0, 0.0), Not(HasSubstr("nan")));
}

TEST(AuditPlots, ABarIsAsLongAsItsShare) {
    EXPECT_THAT(share_bar(0.25), HasSubstr("class=\"filled\" width=\"25\""));
    EXPECT_THAT(share_bar(2.0), HasSubstr("class=\"filled\" width=\"100\""));
    EXPECT_THAT(share_bar(std::numeric_limits<double>::quiet_NaN()), HasSubstr("class=\"filled\" width=\"0\""));
}

TEST(AuditPlots, TheRangeIsDrawnWhereAllResultsHaveOneUnit) {
    const Wording wording = read_wording(assets());
    const AuditWords words(wording);
    EXPECT_FALSE(has_range_plot(plotted(test::sample_audit()).files[0]));
    AuditedFileView file = plotted(test::sample_audit_of_points()).files[0];
    ASSERT_TRUE(has_range_plot(file));
    const Plot plot = range_plot(file, words, "range");
    ASSERT_EQ(plot.panels.at(0).series.size(), 3U) << "budget, audited, capability";
    EXPECT_EQ(plot.panels[0].series[0].points.size(), 4U);
    EXPECT_EQ(plot.panels[0].series[1].points[2].y, file.results[2].audited.number.U);
    EXPECT_THAT(svg(plot), HasSubstr("U / µm"));
    file.results[1].unit = "mm";
    EXPECT_FALSE(has_range_plot(file));
}

TEST(AuditPlots, SharesBeyondTheTenthAreOneBar) {
    const Wording wording = read_wording(assets());
    const AuditWords words(wording);
    AuditedResultView result = plotted(test::sample_audit()).files[0].results[0];
    EXPECT_EQ(audited_share_plot(result, words, "shares").bars.size(), 7U);
    for (int i = 0; i < 6; ++i) {
        result.rows.push_back(result.rows.back());
    }
    const BarPlot plot = audited_share_plot(result, words, "shares");
    ASSERT_EQ(plot.bars.size(), 10U);
    EXPECT_EQ(plot.bars.back().label, "4 others");
}

}  // namespace
}  // namespace gumcert::reports
