#include "engine/rotary_table/start/start_search.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/rotary_table/start/gross_errors.h"
#include "engine/rotary_table/start/start_values.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

void expect_same(const StartValues& a, const StartValues& b) {
    ASSERT_EQ(a.stations.size(), b.stations.size());
    for (std::size_t j = 0; j < a.stations.size(); ++j) {
        EXPECT_EQ(a.stations[j], b.stations[j]) << j;
    }
    EXPECT_EQ(a.dead_paths, b.dead_paths);
    EXPECT_EQ(a.set_up.translation, b.set_up.translation);
    EXPECT_EQ(a.set_up.rotation, b.set_up.rotation);
}

/// \param active  one flag a length: false = left out
StartValues start_values(StartSearch& search, const RotaryTableMeasurement& measurement,
                         const std::vector<bool>& active) {
    return start_values_of(ObservedStations(measurement, active), search.places(active));
}

TEST(StartSearch, AnswersAreThoseOfEachQuestionAlone) {
    RotaryTableMeasurement measurement = simulate(synthetic::small_plan()).measurement;
    const std::vector<bool> all(measurement.lengths.size(), true);
    {
        StartSearch search(measurement);
        EXPECT_TRUE(search.gross_errors().empty());
        EXPECT_NO_THROW(search.refuse_no_rigid_table());
        EXPECT_NO_THROW(search.refuse_wrong_labels());
        EXPECT_NO_THROW(search.refuse_interrupted_beams());
        expect_same(start_values(search, measurement, all), find_start_values(measurement));
        EXPECT_TRUE(search.gross_errors().empty());
    }
    measurement.lengths[100].length += 0.05;
    StartSearch search(measurement);
    EXPECT_EQ(search.gross_errors(), std::vector<std::size_t>{100});
    std::vector<bool> active = all;
    active[100] = false;
    expect_same(start_values(search, measurement, active), find_start_values(measurement, active));
    EXPECT_EQ(search.gross_errors(), find_gross_errors(measurement));
}

std::string told(const std::vector<gum::Diagnostic>& problems) {
    std::string text;
    for (const gum::Diagnostic& problem : problems) {
        text += problem.code + " " + problem.where + " " + problem.what + "\n";
    }
    return text;
}

// What the first question has tried for nothing the later ones do not try again: they say the same.
TEST(StartSearch, LaterQuestionsSayWhatTheySayAlone) {
    synthetic::CampaignPlan plan = synthetic::small_plan();
    plan.angles_deg = synthetic::full_turn(6);
    plan.stations.resize(4);
    plan.reflectors.resize(4);
    const RotaryTableMeasurement sound = simulate(plan).measurement;
    RotaryTableMeasurement no_table = sound;  // no label explains one station, which both questions ask
    RotaryTableMeasurement later = sound;     // nor one that the second question alone asks
    for (std::size_t i = 0; i < sound.lengths.size(); ++i) {
        no_table.lengths[i].length *= sound.lengths[i].station == 2 ? 0.3 : 1.0;
        const bool half = sound.lengths[i].station == 2 && sound.lengths[i].angle % 2 == 0;
        later.lengths[i].length += half ? 0.4e-3 : 0.0;
    }
    for (const RotaryTableMeasurement* const measurement : {&no_table, &later}) {
        const auto alone = [&](const auto& ask) {
            StartSearch search(*measurement);
            return told(synthetic::problems_of([&] { ask(search); }));
        };
        const auto labels = [](StartSearch& search) { search.refuse_wrong_labels(); };
        const auto table = [](const StartSearch& search) { search.refuse_no_rigid_table(); };
        StartSearch search(*measurement);
        (void)synthetic::problems_of([&] { (void)search.gross_errors(); });
        EXPECT_EQ(told(synthetic::problems_of([&] { table(search); })), alone(table));
        EXPECT_EQ(told(synthetic::problems_of([&] { labels(search); })), alone(labels));
    }
}

}  // namespace
}  // namespace gumcert::engine
