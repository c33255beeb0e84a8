#include "reports/record/stated_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

/// The sample, with location errors beside the axis line.
RotaryTable stated_table() {
    RotaryTable table = *test::sample_record().rotary;
    table.location_errors = {table.axis_line[0]};
    table.location_errors[0].name = "EY0A";
    table.location_errors[0].description.clear();
    return table;
}

TEST(StatedValues, AreAllThatTheTableHasInTheOrderOfTheRecord) {
    const RotaryTable table = stated_table();
    const ConstStatedPlaces places = stated_values(table);
    ASSERT_THAT(places, SizeIs(36 * 6 + 6 + 6 + 4 + 1 + table.iso230_2->parameters.size()));
    std::vector<std::string> groups;
    for (const auto& place : places) {
        if (groups.empty() || groups.back() != group_name(place.group)) {
            groups.emplace_back(group_name(place.group));
        }
    }
    EXPECT_THAT(groups,
                ElementsAre("error_motions", "reversal", "ranges", "axis_line", "location_errors", "positioning"));
    EXPECT_EQ(&places[7].stated, &table.errors[1].errors[1]);
    EXPECT_EQ(places[7].name, "EYA");
    EXPECT_EQ(places[7].index, 1U);
}

TEST(StatedValues, HaveTheirNameMeaningAndUnit) {
    const RotaryTable table = stated_table();
    for (const auto& place : stated_values(table)) {
        const bool angle = place.stated.printed.unit == "″";
        EXPECT_EQ(place.unit, angle ? "arcsec" : "um") << place.name;
        EXPECT_FALSE(place.meaning.empty()) << place.name;
        if (place.group == StatedGroup::axis_line) {
            EXPECT_EQ(place.meaning, table.axis_line[place.index].description);
        }
        if (place.group == StatedGroup::location_errors) {
            EXPECT_EQ(place.meaning, "EY0A");
        }
    }
}

TEST(StatedValues, OfOneMotionStandTogetherWhereThatIsAskedFor) {
    const RotaryTable table = stated_table();
    const ConstStatedPlaces places = stated_values(table, ErrorOrder::by_motion);
    EXPECT_EQ(&places[35].stated, &table.errors[35].errors[0]);
    EXPECT_EQ(&places[36].stated, &table.errors[0].errors[1]);
    EXPECT_EQ(places[36].name, "EYA");
    EXPECT_THAT(places, SizeIs(stated_values(table).size()));
}

TEST(StatedValues, ArePointedAtAsInTheRecord) {
    EvaluationRecord record = test::sample_record();
    record.rotary = stated_table();
    const nlohmann::json rotary = nlohmann::json::parse(to_canonical_json(record)).at("rotary");
    for (const auto& place : stated_values(std::as_const(*record.rotary))) {
        EXPECT_EQ(rotary.at(nlohmann::json::json_pointer(pointer_of(place))).at("value"), place.stated.value);
    }
}

TEST(StatedValues, HaveResultNamesThatDiffer) {
    const RotaryTable table = stated_table();
    std::set<std::string> names;
    for (const auto& place : stated_values(table)) {
        if (place.group != StatedGroup::error_motions || place.index == 0) {
            EXPECT_TRUE(names.insert(result_name(place.group, place.name)).second) << place.name;
        }
    }
    EXPECT_TRUE(names.contains("EXA") && names.contains("reversal_EXA") && names.contains("range_EXA"));
}

TEST(StatedValues, CanBeChangedInTheTable) {
    RotaryTable table = stated_table();
    for (const auto& place : stated_values(table)) {
        place.stated.printed.value = "changed";
    }
    EXPECT_EQ(table.errors[35].errors[5].printed.value, "changed");
    EXPECT_EQ(table.iso230_2->parameters.back().stated.printed.value, "changed");
}

}  // namespace
}  // namespace gumcert::reports
