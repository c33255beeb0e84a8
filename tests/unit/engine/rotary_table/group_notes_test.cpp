#include "engine/rotary_table/group_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::engine {
namespace {

using testing::HasSubstr;

RotaryTableMeasurement two_stations() {
    RotaryTableMeasurement measurement;
    measurement.stations = {"P1", "P2"};
    measurement.passes = {"up"};
    measurement.reflectors = {"R1", "R2", "R3"};
    measurement.angles_deg = {0.0, 15.0};
    return measurement;
}

GroupTest suspicious(GroupKind kind) {
    GroupTest test;
    test.kind = kind;
    test.station = 1;
    test.pass = 0;
    test.angle = 1;
    test.last_angle = 1;
    test.reflector = 2;
    test.chi_square = 123.4;
    test.critical_value = 20.2;
    test.estimate = 5.04e-6;
    test.suspicious = true;
    return test;
}

// Interchanged senses move the distances of a pass by the reversal of the table, as a place of its own would.
TEST(GroupNotes, AStationThatMovedWithTheSenseMayHaveItsSensesInterchanged) {
    RotaryTableMeasurement measurement = two_stations();
    measurement.passes = {"down", "up"};
    const auto action = [&] {
        return group_notes({.tests = {suspicious(GroupKind::station_place)}, .visits = {}}, measurement)[0].action;
    };
    measurement.lengths = {{.station = 1, .pass = 1}, {.station = 1, .pass = 0}};
    EXPECT_THAT(action(), testing::Not(HasSubstr("senses")));
    measurement.lengths[1].approach = Approach::negative;
    // What it does later says nothing of this pass.
    measurement.passes.emplace_back("down again");
    measurement.lengths.push_back({.station = 1, .pass = 2, .approach = Approach::negative});
    EXPECT_THAT(action(), HasSubstr("whether the senses of its passes are interchanged"));
    EXPECT_THAT(action(), HasSubstr("Look at the support of the station"));
}

TEST(GroupNotes, SayWhatIsStatedOfTheExpansionAndWhatTheDistancesGive) {
    RotaryTableMeasurement measurement = two_stations();
    measurement.expansion = 23.5e-6;
    measurement.u_expansion = 0.5e-6;
    GroupTest test = suspicious(GroupKind::expansion);
    test.estimate = 12.1e-6;
    const gum::Diagnostic note = group_notes({.tests = {test}, .visits = {}}, measurement)[0];
    EXPECT_EQ(note.where, "fixture");
    EXPECT_THAT(note.what, HasSubstr("give an expansion coefficient of 11.4 · 10⁻⁶/K for the fixture, while 23.5 · "
                                     "10⁻⁶/K is stated, with u = 0.5 · 10⁻⁶/K"));
    EXPECT_THAT(note.action, testing::Not(HasSubstr("exclude")));
}

TEST(GroupNotes, SayWhichGroupByHowMuchAndWhatToDo) {
    for (const GroupKind kind :
         {GroupKind::visit_length, GroupKind::visit_pose, GroupKind::dead_path_change, GroupKind::station_place,
          GroupKind::pair_length, GroupKind::drift, GroupKind::angle_index, GroupKind::succession, GroupKind::station,
          GroupKind::reflector, GroupKind::reflector_at_angles, GroupKind::reflector_from_visit,
          GroupKind::fixture_scale, GroupKind::station_scale, GroupKind::fixture_place, GroupKind::expansion,
          GroupKind::senses}) {
        const auto notes = group_notes({.tests = {suspicious(kind)}, .visits = {}}, two_stations());
        ASSERT_EQ(notes.size(), 1U);
        EXPECT_EQ(notes[0].code, k_suspicious_group);
        EXPECT_EQ(notes[0].severity, gum::Severity::warning);
        EXPECT_THAT(notes[0].what, HasSubstr("chi-square 123, limit 20.2"));
        EXPECT_FALSE(notes[0].action.empty());
    }
    const auto visit = group_notes({.tests = {suspicious(GroupKind::visit_length)}, .visits = {}}, two_stations());
    EXPECT_EQ(visit[0].where, "station P2, pass up, 15°");
    EXPECT_THAT(visit[0].what, HasSubstr("off by 5.04 µm alike"));
    EXPECT_THAT(visit[0].action,
                HasSubstr(R"("exclude": [{ "station": "P2", "pass": "up", "angle_deg": 15, "reason": "why" }].)"));
    EXPECT_THAT(group_notes({.tests = {suspicious(GroupKind::reflector)}, .visits = {}}, two_stations())[0].action,
                HasSubstr(R"("exclude": [{ "reflector": "R3", "reason": "why" }].)"));
    EXPECT_THAT(group_notes({.tests = {suspicious(GroupKind::drift)}, .visits = {}}, two_stations())[0].action,
                testing::Not(HasSubstr("exclude")));
    EXPECT_EQ(group_notes({.tests = {suspicious(GroupKind::reflector)}, .visits = {}}, two_stations())[0].where,
              "fixture, reflector R3");
    const auto pair = group_notes({.tests = {suspicious(GroupKind::pair_length)}, .visits = {}}, two_stations());
    EXPECT_EQ(pair[0].where, "station P2, reflector R3");
    EXPECT_THAT(pair[0].action, HasSubstr(R"("exclude": [{ "station": "P2", "reflector": "R3", "reason": "why" }].)"));
    const auto moved = group_notes({.tests = {suspicious(GroupKind::station_place)}, .visits = {}}, two_stations());
    EXPECT_EQ(moved[0].where, "station P2, pass up");
    const auto leaning =
        group_notes({.tests = {suspicious(GroupKind::reflector_at_angles)}, .visits = {}}, two_stations());
    EXPECT_EQ(leaning[0].where, "fixture, reflector R3, 15°–15°");
    EXPECT_THAT(leaning[0].what, HasSubstr("at these angles the reflector stands 5.04 µm away from"));
    EXPECT_THAT(leaning[0].action, HasSubstr(R"("exclude": [{ "reflector": "R3", "reason": "why" }].)"));
    const auto touched =
        group_notes({.tests = {suspicious(GroupKind::reflector_from_visit)}, .visits = {}}, two_stations());
    EXPECT_EQ(touched[0].where, "fixture, reflector R3, station P2, pass up, 15°");
    EXPECT_THAT(moved[0].what, HasSubstr("stood 5.04 µm away from where it was before"));
}

/// Only where the change begins with a pass that is not the first of its station, in the order of time.
TEST(GroupNotes, SayThatAMovedStationLooksLikeAnInterruptedBeam) {
    RotaryTableMeasurement m = two_stations();
    m.passes = {"up", "down"};
    const auto add = [&](std::size_t station, std::size_t pass, std::size_t angle) {
        m.lengths.push_back({.station = station, .reflector = 0, .pass = pass, .angle = angle});
    };
    const auto names_the_support = [&](std::size_t pass, std::size_t angle) {
        GroupTest test = suspicious(GroupKind::dead_path_change);
        test.pass = pass;
        test.angle = angle;
        const std::string action = group_notes({.tests = {test}, .visits = {}}, m)[0].action;
        EXPECT_THAT(action, HasSubstr("a dead path of their own"));
        const bool names =
            action.find("a station that was moved looks alike. Look at its support") != std::string::npos;
        EXPECT_EQ(names, action.find("a station name of their own") != std::string::npos) << action;
        return names;
    };
    add(1, 0, 0);
    add(1, 0, 1);
    EXPECT_FALSE(names_the_support(0, 0)) << "the only pass";
    add(1, 1, 1);
    add(1, 1, 0);
    EXPECT_TRUE(names_the_support(1, 1));
    EXPECT_FALSE(names_the_support(1, 0)) << "within a pass";
    m.times = {0.0, 10.0, 30.0, 20.0};
    EXPECT_TRUE(names_the_support(1, 0)) << "the earlier one of the pass";
    EXPECT_FALSE(names_the_support(1, 1));
}

TEST(GroupNotes, SayTheTemperatureThatAScaledFixtureMeans) {
    RotaryTableMeasurement measurement = two_stations();
    GroupTest scaled = suspicious(GroupKind::fixture_scale);
    scaled.estimate = 46e-6;  // of the stated coordinates: the fixture itself is smaller
    const auto without = group_notes({.tests = {scaled}, .visits = {}}, measurement);
    EXPECT_EQ(without[0].where, "fixture");
    EXPECT_THAT(without[0].what, testing::StartsWith("the distances put the whole fixture 46 ppm smaller than its "
                                                     "coordinates at its temperature (chi-square"));
    measurement.expansion = 11.5e-6;
    EXPECT_THAT(group_notes({.tests = {scaled}, .visits = {}}, measurement)[0].what,
                HasSubstr("as if it were 4 K colder than stated"));
    scaled.estimate = -46e-6;
    const auto warmer = group_notes({.tests = {scaled}, .visits = {}}, measurement);
    EXPECT_THAT(warmer[0].what, HasSubstr("46 ppm larger"));
    EXPECT_THAT(warmer[0].what, HasSubstr("4 K warmer"));
    EXPECT_THAT(warmer[0].action, HasSubstr("temperature of the fixture"));
    scaled.estimate = -1154e-6;
    const auto hot = group_notes({.tests = {scaled}, .visits = {}}, measurement);
    EXPECT_THAT(hot[0].what, HasSubstr("1150 ppm larger"));
    EXPECT_THAT(hot[0].what, HasSubstr("100 K warmer"));
    scaled.estimate = -996.5 * measurement.expansion;  // just below a power of ten, and no 1e+03
    EXPECT_THAT(group_notes({.tests = {scaled}, .visits = {}}, measurement)[0].what, HasSubstr("as if it were 1000 K"));
}

/// A linearised size may be half as large again as the true one.
TEST(GroupNotes, TellNoSizeThatTheAdjustmentWithoutTheErrorDoesNotConfirm) {
    for (const GroupKind kind : {GroupKind::fixture_scale, GroupKind::station_scale}) {
        GroupTest test = suspicious(kind);
        test.estimate = 776e-6;
        test.is_settled = false;
        const std::string what = group_notes({.tests = {test}, .visits = {}}, two_stations())[0].what;
        EXPECT_THAT(what, HasSubstr("by how much is not known"));
        EXPECT_THAT(what, testing::Not(HasSubstr("776")));
        EXPECT_THAT(what, testing::Not(HasSubstr("ppm")));
    }
}

/// A size that the other suspicious groups do not let determine is none, of any kind that has one.
TEST(GroupNotes, TellNoSizeThatIsNotDeterminedBesideTheOthers) {
    for (const GroupKind kind :
         {GroupKind::visit_length, GroupKind::visit_pose, GroupKind::dead_path_change, GroupKind::station_place,
          GroupKind::pair_length, GroupKind::drift, GroupKind::reflector, GroupKind::reflector_at_angles,
          GroupKind::reflector_from_visit, GroupKind::fixture_scale, GroupKind::station_scale, GroupKind::fixture_place,
          GroupKind::expansion}) {
        GroupTest test = suspicious(kind);
        test.station = test.reflector = test.pass = test.angle = test.last_angle = 0;
        test.estimate = 776e-6;
        test.is_determined = false;
        const std::string what = group_notes({.tests = {test}, .visits = {}}, two_stations())[0].what;
        EXPECT_THAT(what, HasSubstr("by how much could not be determined beside the other suspected errors"));
        EXPECT_THAT(what, testing::Not(HasSubstr("776")));
        EXPECT_THAT(what, testing::Not(HasSubstr("µm")));
    }
}

/// What is told must not stand as the cause where the program knows that it explains too little.
TEST(GroupNotes, SayWhereWhatIsToldDoesNotExplainTheDistances) {
    GroupTests groups{.tests = {suspicious(GroupKind::fixture_place)}, .visits = {}};
    EXPECT_EQ(group_notes(groups, two_stations()).size(), 1U);
    groups.left = ContradictionLeft{.p_value = 0.00089};
    const std::vector<gum::Diagnostic> notes = group_notes(groups, two_stations());
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_EQ(notes[1].code, k_unexplained_rest);
    EXPECT_THAT(notes[1].what, HasSubstr("still contradict the stated uncertainties (p = 0.0009)"));
    groups.left = ContradictionLeft{.p_value = 1e-9, .is_of_a_group = true};
    EXPECT_THAT(group_notes(groups, two_stations())[1].what,
                HasSubstr("a group of distances still deviates from the others (p < 0.0001)"));
    groups.tests[0].suspicious = false;  // nothing was taken off
    EXPECT_TRUE(group_notes(groups, two_stations()).empty());
}

TEST(GroupNotes, SayNothingOfGroupsThatAreNotSuspicious) {
    GroupTest sound = suspicious(GroupKind::drift);
    sound.suspicious = false;
    EXPECT_TRUE(group_notes({.tests = {sound}, .visits = {}}, two_stations()).empty());
    EXPECT_EQ(
        group_notes({.tests = std::vector<GroupTest>(9, suspicious(GroupKind::station)), .visits = {}}, two_stations())
            .size(),
        5U);
}

}  // namespace
}  // namespace gumcert::engine
