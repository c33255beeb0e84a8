#include "reports/forms/render.h"
#include "reports/view/certificate_view.h"
#include "tests/support/sample_record.h"
#include "tests/unit/reports/document_text.h"
#include "tests/unit/reports/view_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

json rotary_view_of(const EvaluationRecord& record) {
    std::ifstream file(std::string(GUMCERT_SOURCE_DIR) + "/templates/wording/en.json");
    return certificate_view(record, Wording(json::parse(file)));
}

std::string rotary_text_of(const EvaluationRecord& record) {
    return squeezed(render_text(record, assets()));
}

TEST(RotaryCertificate, AxisLineSaysWhereMonteCarloAgrees) {
    const auto rows = rows_of(rotary_view_of(test::sample_record()), "axis-line");
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_THAT(rows[0], ElementsAre("axis_y", "position of the axis average line along y in the frame of the fixture",
                                     "−59.43", "0.29", "µm", "2.00", "380", "validated"));
    EXPECT_EQ(rows[2].back(), "not validated");
    EvaluationRecord without = test::sample_record();
    for (TableParameter& p : without.rotary->axis_line) {
        p.stated.monte_carlo.reset();
        p.stated.nu_eff.reset();
    }
    EXPECT_EQ(rows_of(rotary_view_of(without), "axis-line")[0].size(), 7U);
    EXPECT_EQ(rows_of(rotary_view_of(without), "axis-line")[0].back(), "∞");
}

/// The sample, with a machine whose frame is known by three probed reflectors.
EvaluationRecord in_a_machine(const std::string& by) {
    EvaluationRecord record = test::sample_record();
    RotaryTable& rotary = *record.rotary;
    rotary.location_errors = rotary.axis_line;
    const std::vector<std::string> names{"EY0A", "EZ0A", "EB0A", "EC0A"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        rotary.location_errors[i].name = names[i];
        rotary.location_errors[i].stated.monte_carlo.reset();
    }
    rotary.machine_frame = MachineFrame{.by = by,
                                        .source = "probe",
                                        .points = {{"R1", {0.1, 0.2, 0.3}, 2.0}, {"R2", {}, 2.0}, {"R3", {}, 2.0}},
                                        .p_value = {1.0, "0.41"},
                                        .printed_residual = "1.3"};
    return record;
}

TEST(RotaryCertificate, LocationErrorsAreThoseOfAMachine) {
    const auto rows = rows_of(rotary_view_of(in_a_machine("probing")), "location-errors");
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0][0], "EY0A");
    EXPECT_EQ(rows[0][1], "position of the axis along y in the frame of the machine, against the nominal point");
    EXPECT_EQ(rows[3][1], "tilt of the axis about z in the frame of the machine");
    EXPECT_THAT(
        rotary_text_of(in_a_machine("probing")),
        HasSubstr("The frame of the machine is known by 3 reflectors probed by its axes; their residuals are 1.3 µm "
                  "(rms), p = 0.41."));
    EXPECT_THAT(rotary_text_of(in_a_machine("stations")), HasSubstr("known by 3 stations of the tracer"));
    const std::string without = rotary_text_of(test::sample_record());
    EXPECT_THAT(without, Not(HasSubstr("EY0A")));
    EXPECT_THAT(without, Not(HasSubstr("frame of the machine")));
}

TEST(RotaryCertificate, PositioningHasParametersAndTargets) {
    const json view = rotary_view_of(test::sample_record());
    EXPECT_EQ(rows_of(view, "positioning").size(), 12U);
    EXPECT_THAT(rows_of(view, "positioning")[5],
                ElementsAre("R_up", "unidirectional repeatability of positioning, positive approach", "4.25", "0.22",
                            "″", "2.00", "380", "validated"));
    EXPECT_THAT(rows_of(view, "positioning-targets")[1], ElementsAre("30", "0.96", "0.35", "0.21", "0.24", "0.61"));
    const std::string text = rotary_text_of(test::sample_record());
    EXPECT_THAT(text, HasSubstr("from 5 runs in the positive (↑) and 5 runs in the negative (↓) sense of approach"));
    EXPECT_THAT(text, HasSubstr("u = 0.092″"));
    EXPECT_THAT(text, HasSubstr("Five runs in each direction: the positional deviations are corrected for nothing."));
}

// One sense was said to have been measured wherever no reversal was determined.
TEST(RotaryCertificate, WhyNoReversalIsStatedIsTrueOfTheVisits) {
    EvaluationRecord r = test::sample_record();
    r.rotary->reversal.clear();
    const std::string one = "Only one sense of approach was measured";
    const std::string all = "that takes both senses of approach at every station";
    r.rotary->visits = {{.station = "P1", .pass = "1", .direction = "+"},
                        {.station = "P2", .pass = "2", .direction = "+"}};
    EXPECT_THAT(rotary_text_of(r), AllOf(HasSubstr(one), Not(HasSubstr(all))));
    r.rotary->visits[1].direction = "-";
    EXPECT_THAT(rotary_text_of(r), AllOf(HasSubstr(all), Not(HasSubstr(one))));
    r.rotary->visits.clear();  // of the sequential method
    EXPECT_THAT(rotary_text_of(r), AllOf(HasSubstr(all), Not(HasSubstr(one))));
}

TEST(RotaryCertificate, AdjustmentShowsBothFactorsAndTheTestInWords) {
    EvaluationRecord r = test::sample_record();
    std::string text = rotary_text_of(r);
    EXPECT_THAT(text, HasSubstr("Variance factor a priori 1 "));
    EXPECT_THAT(text, HasSubstr("Variance factor a posteriori 0.987 "));
    EXPECT_THAT(text, HasSubstr("Reason The variance components were estimated"));
    EXPECT_THAT(text, HasSubstr("Limits of χ² 958.3 to 1137.5, two-sided, for a probability of 0.95"));
    EXPECT_THAT(text, HasSubstr("χ² = 1032.6 lies between the limits 958.3 and 1137.5."));
    EXPECT_THAT(text, HasSubstr("Three components were estimated from the same residuals"));
    r.rotary->adjustment.global_test.accepted = false;
    r.rotary->adjustment.chi_square = {2000.0, "2000.0"};
    EXPECT_THAT(rotary_text_of(r), HasSubstr("χ² = 2000.0 is above the upper limit 1137.5"));
    r.rotary->adjustment.chi_square = {900.0, "900.0"};
    EXPECT_THAT(rotary_text_of(r), HasSubstr("χ² = 900.0 is below the lower limit 958.3"));
    const auto rows = rows_of(rotary_view_of(r), "variance-components");
    EXPECT_THAT(rows[0], ElementsAre("length noise", "0.0512", "0.0011", "µm", "0.05", "787", "812.0", "estimated",
                                     "in the weights"));
    EXPECT_THAT(rows[3], ElementsAre("table angular, tilt", "0.290", "0.020", "″", "0.3", "–", "68.0", "as stated",
                                     "check only"));
}

TEST(RotaryCertificate, FlaggedDistancesAreListedInTheirOrderWithReasons) {
    EvaluationRecord r = test::sample_record();
    const auto rows = rows_of(rotary_view_of(r), "flagged");
    EXPECT_THAT(rows[0], ElementsAre("1", "P1", "R3", "P1-1", "20", "3.12", "61.2", "58.7 (3.89)", "3.24", "removed"));
    EXPECT_THAT(rows[1], ElementsAre("2", "P4", "R6", "P4-1", "310", "−0.24", "4.3", "4.3 (3.89)", "−0.27", "kept"));
    EXPECT_THAT(rotary_text_of(r), HasSubstr("No. 1 largest test value of the first search"));
    r.rotary->flagged.assign(4, r.rotary->flagged[0]);
    r.rotary->flagged[3].reason = "another";
    EXPECT_THAT(rotary_text_of(r), HasSubstr("No. 1–3 largest test value of the first search No. 4 another"));
}

TEST(RotaryCertificate, ReliabilityNamesTheWorstOfEveryErrorMotion) {
    const json view = rotary_view_of(test::sample_record());
    const auto rows = rows_of(view, "external-reliability");
    ASSERT_EQ(rows.size(), 10U);
    EXPECT_THAT(rows[0], ElementsAre("EXA", "350", "0.47", "µm", "0.65", "P4", "R6", "P4-1", "350", "0.33"));
    EXPECT_THAT(rows[6], ElementsAre("O_y", "–", "0.021", "µm", "0.070", "P2", "R1", "P2-1", "90", "0.35"));
    EXPECT_EQ(rows_of(view, "fixture-reliability").size(), 18U);
    const std::string text = html_text(render_html(test::sample_record(), assets()));
    EXPECT_THAT(text, HasSubstr("Least redundancy number of the fixture 0.620 (x of R1)"));
    EXPECT_THAT(text, HasSubstr("Largest minimal detectable bias of the fixture 2.1 µm (x of R1)"));
    EvaluationRecord uncontrolled = test::sample_record();
    uncontrolled.rotary->fixture_reliability[0].minimal_detectable_bias_um = 0.0;
    EXPECT_EQ(rows_of(rotary_view_of(uncontrolled), "fixture-reliability")[0].back(), "–") << "nothing controls it";
}

TEST(RotaryCertificate, FixtureHasTheFormOfThePapersTable) {
    const json view = rotary_view_of(test::sample_record());
    const auto rows = rows_of(view, "fixture");
    ASSERT_EQ(rows.size(), 6U);
    const Reflector m = test::sample_record().rotary->reflectors[1];
    EXPECT_EQ(rows[1][0], "R2");
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(rows[1][1 + 2 * c], m.printed_cmm[c]);
        EXPECT_EQ(rows[1][2 + 2 * c], "0.0008");
    }
    EXPECT_EQ(rows_of(view, "fixture-budget").size(), 2U);
    EXPECT_THAT(block(view, "table", "fixture-budget")["caption"].get<std::string>(), HasSubstr("x of R6"));
    EXPECT_THAT(rotary_text_of(test::sample_record()),
                HasSubstr("The maximum permissible error is taken as a uniform bound."));
}

TEST(RotaryCertificate, MonteCarloNamesWhatIsNotValidated) {
    EvaluationRecord r = test::sample_record();
    const json view = rotary_view_of(r);
    const auto groups = rows_of(view, "monte-carlo-groups");
    EXPECT_THAT(groups[0], ElementsAre("EXA", "36", "35", "1", "0"));
    EXPECT_THAT(groups[5], ElementsAre("ECA", "36", "35", "0", "1"));
    EXPECT_THAT(groups.back(), ElementsAre("Accuracy and repeatability of positioning", "12", "12", "0", "0"));
    const auto rows = rows_of(view, "monte-carlo-exceptions");
    ASSERT_EQ(rows.size(), 3U);
    const StatedValue& e = r.rotary->errors[3].errors[0];
    EXPECT_THAT(rows[0],
                ElementsAre("EXA (30°)", e.printed.value, e.printed.U, e.monte_carlo->mean.text, e.monte_carlo->u.text,
                            e.monte_carlo->symmetric.text[0], e.monte_carlo->symmetric.text[1],
                            e.monte_carlo->shortest.text[0], e.monte_carlo->shortest.text[1], "µm", "not validated"));
    EXPECT_EQ(rows[1].back(), "not validated") << "what cannot be said is counted, not listed";
    EXPECT_THAT(rotary_text_of(r), HasSubstr("more trials decide it"));
    EXPECT_THAT(rotary_text_of(r), HasSubstr("Steps of a trial until it converged 2.31 on average, 4 at most"));

    for (ErrorsAtAngle& at : r.rotary->errors) {
        at.errors[0].monte_carlo->validation->validated = false;
        at.errors[1].monte_carlo->validation->validated = false;
    }
    EXPECT_EQ(rows_of(rotary_view_of(r), "monte-carlo-exceptions").size(), 60U);
    EXPECT_THAT(rotary_text_of(r), HasSubstr("The record holds 14 more."));

    for (ErrorsAtAngle& at : r.rotary->errors) {
        for (StatedValue& value : at.errors) {
            value.monte_carlo = test::trials_of(value.value, value.u);
        }
    }
    r.rotary->ranges.clear();
    r.rotary->axis_line.clear();
    EXPECT_THAT(rotary_text_of(r),
                HasSubstr("The law of propagation is validated for every quantity that was compared"));
}

TEST(RotaryCertificate, HasThePlotsWithTextsForScreenReaders) {
    const json view = rotary_view_of(test::sample_record());
    for (const char* id : {"plot-errors", "plot-sources", "plot-station-residuals", "plot-redundancy", "plot-layout",
                           "plot-reflectors"}) {
        const json figure = block(view, "figure", id);
        ASSERT_FALSE(figure.is_null()) << id;
        EXPECT_GT(figure["alt"].get<std::string>().size(), 60U) << id;
        EXPECT_THAT(figure["svg"].get<std::string>(), HasSubstr("<desc id=\"" + std::string(id) + "-desc\">"));
    }
    EXPECT_THAT(block(view, "figure", "plot-layout")["caption"].get<std::string>(),
                HasSubstr("Ellipses: regions of 95 %, magnified 20000 times."));
    const std::string sources = block(view, "figure", "plot-sources")["svg"];
    EXPECT_THAT(sources, HasSubstr(">table repeatability</text>"));
    EXPECT_THAT(sources, HasSubstr(">88.0</text>"));
    EXPECT_THAT(sources, HasSubstr(">0.21 µm</text>"));
    const std::string residuals = block(view, "figure", "plot-station-residuals")["svg"];
    EXPECT_THAT(residuals, HasSubstr(">P6</text>"));
    EXPECT_THAT(residuals, Not(HasSubstr(">3</text>"))) << "the removed distance must not set the scale";
    // An id is used once in a document.
    std::multiset<std::string> ids;
    const std::string html = render_html(test::sample_record(), assets());
    for (std::size_t at = html.find(" id=\""); at != std::string::npos; at = html.find(" id=\"", at + 1)) {
        ids.insert(html.substr(at + 5, html.find('"', at + 5) - at - 5));
    }
    for (const std::string& id : ids) {
        EXPECT_EQ(ids.count(id), 1U) << id;
    }
}

TEST(RotaryCertificate, ARecordWithoutTheNewPartsHasNoEmptyPlaces) {
    EvaluationRecord old = test::sample_record();
    RotaryTable& r = *old.rotary;
    r.axis_line.clear();
    r.iso230_2.reset();
    r.monte_carlo.reset();
    r.fixture_budget.reset();
    r.fixture_reliability.clear();
    r.external_reliability.clear();
    r.adjustment.global_test = {};
    r.adjustment.variance_factor.reason.clear();
    for (VarianceComponent& v : r.variance_components) {
        v.stated.number.reset();
        v.stated.text.clear();
        v.degrees_of_freedom.reset();
        v.used = true;
    }
    for (FlaggedDistance& f : r.flagged) {
        f.estimated_error_um.clear();
        f.found_with.clear();
        f.reason.clear();
    }
    for (Reflector& m : r.reflectors) {
        m.home_position_mm = {};
        m.printed_cmm.clear();
        m.printed_U_cmm.clear();
    }
    const json view = rotary_view_of(old);
    std::vector<std::string> ids;
    for (const json& section : view["sections"]) {
        ids.push_back(section["id"]);
    }
    EXPECT_THAT(ids, ElementsAre("overview", "error_motions", "identification", "conventions", "set_up", "uncertainty",
                                 "adjustment", "geometry", "comparison", "messages", "input", "comparison_points"));
    EXPECT_TRUE(block(view, "figure", "plot-layout").is_null());
    EXPECT_THAT(rows_of(view, "variance-components")[0],
                ElementsAre("length noise", "0.0512", "0.0011", "µm", "812.0", "estimated"));
    EXPECT_THAT(rows_of(view, "flagged")[0], ElementsAre("P1", "R3", "P1-1", "20", "3.12", "61.2", "removed"));
    const std::string text = rotary_text_of(old);
    EXPECT_THAT(text, Not(HasSubstr("Global test: χ²")));
    EXPECT_THAT(text, Not(HasSubstr("Monte Carlo")));
}

}  // namespace
}  // namespace gumcert::reports
