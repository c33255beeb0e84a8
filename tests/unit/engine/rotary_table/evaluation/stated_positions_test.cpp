// What is stated of the stations is compared with what is found, and where it tells nothing, that is said.
#include "engine/rotary_table/evaluation/stated_positions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "gum/quantity/units.h"
#include "tests/support/small_campaign.h"
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
    EXPECT_TRUE(notes[0].what.ends_with("; found elsewhere than stated, too: " + measurement.stations[3]))
        << notes[0].what;
    EXPECT_EQ(notes[0].action.find("it stands where " + measurement.stations[3] + " is stated"), 0U) << notes[0].action;

    std::swap(measurement.station_start[1], measurement.station_start[3]);
    (*measurement.station_start[2])[1] += 0.5;
    notes = notes_of_positions(measurement);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].where, "station " + measurement.stations[2]);
    EXPECT_EQ(notes[0].action.find("compare the position"), 0U) << notes[0].action;
}

// Two stations stand at one place, and one of them is stated elsewhere: the other one is right.
TEST(StatedPositions, AccuseNoNameThatIsRight) {
    synthetic::CampaignPlan plan = positions_plan(RotaryAxis::a, true);
    plan.stations.push_back(plan.stations[1]);
    RotaryTableMeasurement measurement = synthetic::simulate(plan).measurement;
    (*measurement.station_start[1])[1] += 1.0;
    const std::vector<gum::Diagnostic> notes = notes_of_positions(measurement);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].where, "station " + measurement.stations[1]);
    EXPECT_EQ(notes[0].action.find("compare the position"), 0U) << notes[0].action;
}

// The zero of the machine that set them up is the face of the table, perhaps.
TEST(StatedPositions, TellAnotherZeroOfAll) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        RotaryTableMeasurement measurement = synthetic::simulate(positions_plan(axis, true)).measurement;
        for (std::optional<Eigen::Vector3d>& position : measurement.station_start) {
            (*position)[axial_coordinate(axis)] += 0.35;
        }
        const std::vector<gum::Diagnostic> notes = notes_of_positions(measurement);
        ASSERT_EQ(notes.size(), 1U);
        EXPECT_EQ(notes[0].where, "stations");
        EXPECT_EQ(notes[0].what.find("all are found elsewhere than stated, by about the same ("), 0U) << notes[0].what;
        EXPECT_EQ(notes[0].action.find("see where the zero"), 0U) << notes[0].action;
    }
}

// Whatever else is wrong with the stated positions: a mirrored fixture is refused, or it is said that the sign of three motions rests on
// it. It was taken with "the result does not rest on them" where one station was 0.18 m off or two names were interchanged.
TEST(StatedPositions, NeverLetAMirroredFixturePass) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        synthetic::CampaignPlan plan = positions_plan(axis, true);
        plan.stations = synthetic::CampaignPlan{}.stations;
        RotaryTableMeasurement mirrored = synthetic::simulate(plan).measurement;
        const Eigen::Index axial = axial_coordinate(axis);
        mirrored.fixture.col(axial) *= -1.0;
        for (int fault = 0; fault < 7; ++fault) {
            RotaryTableMeasurement measurement = mirrored;
            std::vector<std::optional<Eigen::Vector3d>>& stated = measurement.station_start;
            switch (fault) {
                case 1:
                    (*stated[3])[(axial + 1) % 3] += 0.18;
                    break;
                case 2:
                    std::swap(stated[0], stated[1]);
                    break;
                case 3:
                    (*stated[2])[axial] *= -1.0;
                    break;
                case 4:
                    std::swap(stated[0], stated[4]);
                    (*stated[2])[(axial + 2) % 3] -= 1.0;
                    break;
                case 5:
                    for (std::optional<Eigen::Vector3d>& position : stated) {
                        (*position)[(axial + 1) % 3] += 0.35;
                    }
                    break;
                case 6:
                    for (std::optional<Eigen::Vector3d>& position : stated) {
                        (*position)[axial] = 0.0;
                    }
                    break;
                default:
                    break;
            }
            std::vector<gum::Diagnostic> told;
            const std::vector<gum::Diagnostic> problems =
                synthetic::problems_of([&] { told = notes_of_positions(measurement); });
            if (!problems.empty()) {
                EXPECT_EQ(problems.front().code, "GC-ADJUST-0018") << fault;
                continue;
            }
            EXPECT_GE(fault, 5);  // they do not tell it
            ASSERT_FALSE(told.empty()) << fault;
            const std::string motion = error_motion_names(axis)[static_cast<std::size_t>(axial)];
            EXPECT_TRUE(std::ranges::any_of(told, [&](const gum::Diagnostic& note) {
                return note.rule.find("the mirror image of") != std::string::npos &&
                       note.rule.find(motion) != std::string::npos;
            })) << fault;
            for (const gum::Diagnostic& note : told) {
                EXPECT_EQ(note.rule.find("does not rest on them"), std::string::npos) << fault;
            }
        }
    }
}

// All of them a little on the other side: too little to be refused, and not "no position tells the sign".
TEST(StatedPositions, TellLowStationsThatAreStatedInTheMirrorImage) {
    synthetic::CampaignPlan plan = positions_plan(RotaryAxis::a, true);
    plan.stations = {{0.12, 0.9, 0.10}, {0.13, -0.8, 0.55}, {0.14, 0.30, -0.9}, {0.12, -0.75, -0.65}, {0.1, 0.8, 0.7}};
    RotaryTableMeasurement measurement = synthetic::simulate(plan).measurement;
    EXPECT_TRUE(notes_of_positions(measurement).empty());
    measurement.fixture.col(0) *= -1.0;
    const std::vector<gum::Diagnostic> notes = notes_of_positions(measurement);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].code, "GC-GEOMETRY-0009");
    EXPECT_NE(notes[0].rule.find("the mirror image of"), std::string::npos) << notes[0].rule;
}

// A typing error beside interchanged names: the names are what may move temperatures.
TEST(StatedPositions, TellInterchangedNamesFirst) {
    RotaryTableMeasurement measurement = synthetic::simulate(positions_plan(RotaryAxis::a, true)).measurement;
    (*measurement.station_start[0])[1] += 0.5;
    std::swap(measurement.station_start[1], measurement.station_start[3]);
    const std::vector<gum::Diagnostic> notes = notes_of_positions(measurement);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0].where, "station " + measurement.stations[1]);
    EXPECT_EQ(notes[0].action.find("it stands where " + measurement.stations[3]), 0U) << notes[0].action;
    EXPECT_NE(notes[0].what.find("too: " + measurement.stations[0]), std::string::npos) << notes[0].what;
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
