// Sections on what a rotary table does, and on what its distances say of the measurement.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/forms/render.h"
#include "reports/plots/certificate_plots.h"
#include "reports/plots/rotary_evidence_plots.h"
#include "reports/view/certificate_view.h"
#include "tests/support/sample_evidence.h"
#include "tests/unit/reports/document_text.h"
#include "tests/unit/reports/view_blocks.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

json evidence_wording(const std::string& language = "en") {
    std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/" + language + ".json");
    return json::parse(file);
}

using test::record_with_evidence;

std::string text_of_evidence(const EvaluationRecord& record) {
    return squeezed(render_text(record, assets()));
}

TEST(EvidenceSections, StandInARecord) {
    const std::string text = to_canonical_json(record_with_evidence());
    EXPECT_EQ(to_canonical_json(record_from_json(text, "record.json")), text);
    EXPECT_THAT(text, HasSubstr("\"minimal_detectable\""));
}

TEST(EvidenceSections, BeginWithWhatTheTableDoes) {
    const EvaluationRecord record = record_with_evidence();
    const json view = certificate_view(record, Wording(evidence_wording()));
    EXPECT_EQ(view["sections"][0]["id"], "overview");
    const auto rows = rows_of(view, "overview");
    ASSERT_EQ(rows.size(), 6U + 3U + 4U);
    const StatedValue& range = record.rotary->ranges[0].stated;
    EXPECT_THAT(rows[0],
                ElementsAre("EXA", "Range, linear, along x (axial)", range.printed.value, range.printed.U, "µm"));
    EXPECT_EQ(rows[6][0], "A");
    EXPECT_EQ(rows[7][0], "R");
    EXPECT_EQ(rows[8][0], "E");
    EXPECT_EQ(rows[9][0], "axis_y");
    const std::string text = text_of_evidence(record);
    EXPECT_THAT(text, HasSubstr("Groups of distances 1 kind was tested; none is suspicious."));
    EvaluationRecord suspicious = record;
    suspicious.rotary->group_tests->kinds.front().suspicious = true;
    suspicious.rotary->adjustment.global_test.accepted = false;
    EXPECT_THAT(text_of_evidence(suspicious), HasSubstr("1 is suspicious: see its table"));
    AdjustmentSummary& adjustment = suspicious.rotary->adjustment;
    adjustment.p_value.number = 0.004;
    EXPECT_THAT(text_of_evidence(suspicious), HasSubstr("The residuals are larger than those of 39 in 40 adjustments"));
    adjustment.p_value.number = 1e-5;
    EXPECT_THAT(text_of_evidence(suspicious), HasSubstr("The residuals refute the uncertainties"));
    adjustment.chi_square.number = 0.5 * adjustment.global_test.lower.number;
    EXPECT_THAT(text_of_evidence(suspicious), HasSubstr("smaller than the uncertainties let expect"));
}

TEST(EvidenceSections, WarnOnceForEachCodeOnTheFirstPage) {
    EvaluationRecord record = test::sample_record();
    const gum::Diagnostic doubt{.code = "GC-WARN-0004",
                                .where = "lengths.csv",
                                .what = "the angles span 90°",
                                .rule = {},
                                .action = {},
                                .severity = gum::Severity::warning};
    record.diagnostics = {doubt, doubt};
    record.diagnostics.push_back(doubt);
    record.diagnostics.back().code = "GC-NOTE-1";
    record.diagnostics.back().severity = gum::Severity::note;
    const std::string text = text_of_evidence(record);
    const std::size_t at = text.find("warning GC-WARN-0004 the angles span 90° (2 ×)");
    ASSERT_NE(at, std::string::npos);
    EXPECT_LT(at, text.find("Error motions"));
    EXPECT_EQ(text.find("GC-NOTE-1"), text.rfind("GC-NOTE-1")) << "a note stands with the remarks alone";
}

TEST(EvidenceSections, NameTheGroupWithTheLargestTestValue) {
    EvaluationRecord record = record_with_evidence();
    GroupTestRow drift = test::sample_group_test("drift", true);
    drift.station = drift.pass = drift.minimal_detectable.text = "";
    GroupTestRow point = test::sample_group_test("reflector", false);
    point.station = point.pass = "";
    point.reflector = "R3";
    GroupTestRow scatter = test::sample_group_test("station", false);
    scatter.pass = "";
    scatter.unit = "1";
    record.rotary->group_tests->kinds.insert(record.rotary->group_tests->kinds.end(), {drift, point, scatter});
    const auto rows = rows_of(certificate_view(record, Wording(evidence_wording())), "group-tests");
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_THAT(rows[0], ElementsAre("distances of a visit, one error in common", "216", "station P2, pass P2-1, 20°",
                                     "61.2", "21.2", "4.9 µm", "1.8 µm", "not suspicious"));
    record.rotary->group_tests->kinds.front().estimate = {};
    EXPECT_EQ(rows_of(certificate_view(record, Wording(evidence_wording())), "group-tests")[0][5], "not determined");
    EXPECT_EQ(rows[1][2], "all stations");
    EXPECT_EQ(rows[1][6], "–");
    EXPECT_EQ(rows[1][7], "suspicious");
    EXPECT_EQ(rows[2][2], "Reflector R3");
    EXPECT_EQ(rows[3][2], "Station P2");
    EXPECT_EQ(rows[3][5], "4.9");
}

TEST(EvidenceSections, HaveAWordForEveryKindInEveryLanguage) {
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const json words = evidence_wording(language);
        for (const char* kind :
             {"visit_length", "visit_pose", "dead_path_change", "station_place", "pair_length", "drift", "angle_index",
              "succession", "fixture_scale", "station", "reflector", "reflector_at_angles", "reflector_from_visit",
              "station_scale", "fixture_place", "expansion", "senses"}) {
            EXPECT_FALSE(words["value"]["group_kind"].value(kind, "").empty()) << language << ", " << kind;
            // The size has its power of ten beside it: "13 · 10⁻⁶" of a thing "in 10⁻⁶/K" would be a millionth of it.
            EXPECT_THAT(words["value"]["group_kind"].value(kind, ""), testing::Not(testing::HasSubstr("10⁻⁶")));
        }
    }
}

TEST(EvidenceSections, ShowVisitsInTheirOrderWithTheirLimits) {
    const EvaluationRecord record = record_with_evidence();
    const json words = evidence_wording();
    const Plot plot = visit_plot(*record.rotary, Wording(words));
    ASSERT_EQ(plot.panels.size(), 1U);
    ASSERT_EQ(plot.panels[0].marks.size(), 2U);
    EXPECT_EQ(plot.panels[0].marks[1].label, "P2");
    EXPECT_EQ(plot.panels[0].marks[1].x, 2.0);
    ASSERT_EQ(plot.panels[0].series.size(), 3U);
    EXPECT_EQ(plot.panels[0].series[0].points[1].U, 0.5);  // limits
    EXPECT_EQ(plot.panels[0].series[1].points[0].y, 0.1);
    EXPECT_EQ(plot.panels[0].series[2].points[0].y, -0.2);
    EXPECT_EQ(visit_scatter_plot(*record.rotary, Wording(words)).panels.size(), record.rotary->stations.size());
}

TEST(EvidenceSections, CloseTheCurvesOfAFullTurn) {
    EvaluationRecord record = record_with_evidence();
    const json words = evidence_wording();
    const std::size_t angles = record.rotary->errors.size();
    Plot plot = error_motion_plot(*record.rotary, Wording(words));
    ASSERT_EQ(plot.panels.size(), 6U);
    ASSERT_EQ(plot.panels[0].series.size(), 3U);  // band, both senses
    for (const PlotSeries& series : plot.panels[0].series) {
        ASSERT_EQ(series.points.size(), angles + 1);
        EXPECT_EQ(series.points.back().x, series.points.front().x + 360.0);
        EXPECT_EQ(series.points.back().y, series.points.front().y);
    }
    EXPECT_EQ(plot.panels[0].strip[0].points[3].y, record.rotary->errors[3].errors[0].U);
    EXPECT_EQ(plot.panels[0].strip[1].points[3].y, 0.2);
    record.rotary->errors.resize(angles / 2);
    record.rotary->sense_curves.clear();
    plot = error_motion_plot(*record.rotary, Wording(words));
    EXPECT_EQ(plot.panels[0].series[0].points.size(), angles / 2);
}

TEST(EvidenceSections, ShowRunsMeansAndSpreadOfThePositioning) {
    const EvaluationRecord record = record_with_evidence();
    const json words = evidence_wording();
    const Plot plot = positioning_plot(*record.rotary, Wording(words));
    const auto& series = plot.panels.at(0).series;
    ASSERT_EQ(series.size(), 6U);
    const PositioningTarget& first = record.rotary->iso230_2->targets[0];
    EXPECT_EQ(series[0].points[0].U, 2.0 * *first.s_up.number);
    EXPECT_EQ(series[0].points[0].y, *first.mean_up.number);
    ASSERT_EQ(series[1].points.size(), 2U);
    EXPECT_EQ(series[1].points[1].y, 0.7);
    EXPECT_EQ(series[2].points[0].y, *first.mean_up.number);
    EXPECT_EQ(series[4].points[0].y, -0.5);
    EXPECT_EQ(series[5].points[0].y, *first.mean_down.number);
}

TEST(EvidenceSections, StateHarmonicsWithTheirUncertainty) {
    const json view = certificate_view(record_with_evidence(), Wording(evidence_wording()));
    const auto rows = rows_of(view, "harmonics-linear");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_THAT(rows[0], ElementsAre("1", "1.234", "0.060", "271", "1.234", "0.060", "271", "1.234", "0.060", "271"));
    EXPECT_EQ(rows[1][3], "–") << "an amplitude within its uncertainty has no phase";
    EXPECT_EQ(rows[2][0], "rest, rms");
    EXPECT_EQ(rows_of(view, "harmonics-angular").size(), 3U);
}

TEST(EvidenceSections, SayWhatTheTemperaturesDid) {
    const EvaluationRecord record = record_with_evidence();
    const auto rows = rows_of(certificate_view(record, Wording(evidence_wording())), "environment");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_THAT(rows[0], ElementsAre("1", "P1", "20.100", "0.030", "0.36", "–")) << "no pressure, no humidity";
    EXPECT_THAT(rows[1], ElementsAre("2", "P2", "20.300", "0.030", "1.08", "20.26"));
    EXPECT_THAT(text_of_evidence(record), HasSubstr("at its largest distance, 312 mm, this is 0.36 µm to 1.08 µm"));
    EXPECT_THAT(text_of_evidence(record), HasSubstr("at most 1.2 % of the mean variance"));
}

TEST(EvidenceSections, ListDistancesOfASmallMeasurementInAnAnnex) {
    EvaluationRecord record = record_with_evidence();
    EXPECT_THAT(text_of_evidence(record), Not(HasSubstr("Distances as read")));
    record.rotary->reliability.resize(2);
    record.rotary->reliability[0].printed_length = "808.831212";
    record.rotary->reliability[1].printed_length = "715.346954";
    const json view = certificate_view(record, Wording(evidence_wording()));
    const auto rows = rows_of(view, "distances");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0][4], "808.831212");
    EXPECT_EQ(view["sections"].back()["id"], "distances");
    EXPECT_EQ(view["sections"].back()["kind"], "annex");
}

TEST(EvidenceSections, ThinTablesOfManyAnglesAndKeepExtremes) {
    EvaluationRecord record = record_with_evidence();
    RotaryTable& r = *record.rotary;
    const ErrorsAtAngle one = r.errors[1];
    r.errors.clear();
    for (int i = 0; i < 720; ++i) {
        r.errors.push_back(one);
        r.errors.back().angle_deg = {0.5 * i, std::to_string(i)};
    }
    r.errors[333].errors[4].value = 1e3;
    const json view = certificate_view(record, Wording(evidence_wording()));
    const auto rows = rows_of(view, "errors");
    EXPECT_LT(rows.size(), 90U);
    EXPECT_GT(rows.size(), 70U);
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row[0] == "333"; }));
    EXPECT_THAT(block(view, "table", "errors")["caption"].get<std::string>(), HasSubstr("Of 720 angles"));
}

TEST(EvidenceSections, OfRecordsWithoutEvidenceAreLeftOut) {
    const json view = certificate_view(test::sample_record(), Wording(evidence_wording()));
    for (const json& section : view["sections"]) {
        EXPECT_THAT(section["id"].get<std::string>(),
                    Not(::testing::AnyOf("group_tests", "harmonics", "environment", "distances")));
    }
}

}  // namespace
}  // namespace gumcert::reports
