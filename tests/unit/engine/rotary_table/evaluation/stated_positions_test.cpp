// What is stated of the stations is compared with what is found, and where it tells nothing, that is said.
#include "engine/rotary_table/evaluation/stated_positions.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "gum/quantity/units.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

synthetic::CampaignPlan positions_plan(RotaryAxis axis, bool stated) {
    synthetic::CampaignPlan plan;
    plan.axis = axis;
    plan.angles_deg = synthetic::full_turn(8);
    plan.stations.resize(4);
    plan.start_values = stated;
    return plan;
}

std::vector<gum::Diagnostic> notes_of_positions(const RotaryTableMeasurement& measurement) {
    std::vector<gum::Diagnostic> notes = evaluate_jointly(measurement, EvaluationOptions{}).notes;
    std::erase_if(notes, [](const gum::Diagnostic& note) {
        return note.code != "GC-GEOMETRY-0009" && note.code != "GC-GEOMETRY-0010";
    });
    return notes;
}

TEST(StatedPositions, SayNothingWhereTheyAreRight) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        RotaryTableMeasurement measurement = synthetic::simulate(positions_plan(axis, true)).measurement;
        EXPECT_TRUE(notes_of_positions(measurement).empty());
        // One is enough, to some centimetres.
        for (std::size_t j = 1; j < measurement.stations.size(); ++j) {
            measurement.station_start[j].reset();
        }
        *measurement.station_start[0] += Eigen::Vector3d::Constant(0.15);
        EXPECT_TRUE(notes_of_positions(measurement).empty());
    }
}

TEST(StatedPositions, TellAStationThatIsElsewhere) {
    RotaryTableMeasurement measurement = synthetic::simulate(positions_plan(RotaryAxis::a, true)).measurement;
    std::swap(measurement.station_start[1], measurement.station_start[3]);
    std::vector<gum::Diagnostic> notes = notes_of_positions(measurement);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].code, "GC-GEOMETRY-0009");
    EXPECT_EQ(notes[0].where, "station " + measurement.stations[1]);
    EXPECT_TRUE(notes[0].what.ends_with("; the same holds for " + measurement.stations[3])) << notes[0].what;
    EXPECT_EQ(notes[0].action.find("it stands where " + measurement.stations[3] + " is stated"), 0U) << notes[0].action;

    std::swap(measurement.station_start[1], measurement.station_start[3]);
    (*measurement.station_start[2])[1] += 0.5;
    notes = notes_of_positions(measurement);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].where, "station " + measurement.stations[2]);
    EXPECT_EQ(notes[0].action.find("compare the position"), 0U) << notes[0].action;
}

// The mirror image of the fixture file has the same distances; the motions that are named have the other sign then.
TEST(StatedPositions, NameTheMotionsWhoseSignTheFixtureFileAloneTells) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        RotaryTableMeasurement measurement = synthetic::simulate(positions_plan(axis, false)).measurement;
        const RotaryTableSolution right = evaluate_jointly(measurement, EvaluationOptions{});
        const std::vector<gum::Diagnostic> notes = notes_of_positions(measurement);
        ASSERT_EQ(notes.size(), 1U);
        EXPECT_EQ(notes[0].code, "GC-GEOMETRY-0010");
        EXPECT_EQ(notes[0].severity, gum::Severity::note);
        measurement.fixture.col(axial_coordinate(axis)) *= -1.0;
        const RotaryTableSolution mirrored = evaluate_jointly(measurement, EvaluationOptions{});
        const auto names = error_motion_names(axis);
        for (Eigen::Index c = 0; c < 6; ++c) {
            const bool named = notes[0].rule.find(names[static_cast<std::size_t>(c)]) != std::string::npos;
            const Eigen::VectorXd expected = (named ? -1.0 : 1.0) * right.datum.errors.row(c).transpose();
            const double unit = c < 3 ? gum::k_micrometre : gum::k_arcsecond;
            EXPECT_LT((mirrored.datum.errors.row(c).transpose() - expected).cwiseAbs().maxCoeff(), 1e-3 * unit)
                << names[static_cast<std::size_t>(c)];
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
