#include "archive/certificates/archive_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "archive/store/sqlite_store.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using nlohmann::json;

json record(const std::string& method, const std::string& issued, const std::string& person) {
    return {{"kind", "budget"},
            {"certificate",
             {{"data",
               {{"method", {{"identification", method}}},
                {"dates", {{"issued", issued}, {"performed_to", issued}}},
                {"persons", {{"authorised_by", {{"name", person}}}}}}}}}};
}

json readings(double mean, double s, int n) {
    return {{"input", "x"}, {"component", ""}, {"unit", "V"}, {"mean", mean}, {"standard_deviation", s}, {"n", n}};
}

class StatisticsOfAnArchive : public testing::Test {
protected:
    void add(const std::string& number, const json& content, int steps = 3) {
        Draft draft = test::sample_draft(number);
        draft.record = content.is_string() ? content.get<std::string>() : content.dump();
        (void)archive_.draft(draft, by("A. Author"));
        for (int i = 0; i < steps; ++i) {
            constexpr std::array<const char*, 3> kinds = {"reviewed", "authorised", "issued"};
            (void)archive_.advance(number, kinds.at(static_cast<std::size_t>(i)), by("R. Reviewer"));
        }
    }
    Request by(const std::string& who) {
        return {.actor = who, .at = clock_.next(), .request_key = "", .why = "a reason"};
    }

    test::StoreFolder folder_;
    test::Clock clock_;
    std::unique_ptr<Store> store_ = create_sqlite_store(
        folder_.file(),
        first_entry({.four_eyes = true, .numbering = "", .persons = {}}, "gumcert", "nonce", by("K. Keeper")));
    Archive archive_{*store_};
};

TEST_F(StatisticsOfAnArchive, CountsCertificates) {
    add("C-1", record("CP-01", "2026-10-05", "M. Weber"));
    add("C-2", record("CP-01", "2026-11-05", "M. Weber"));
    add("C-3", record("CP-02", "2026-11-06", "R. Lin"), 1);
    add("C-4", record("CP-02", "2026-11-07", "R. Lin"), 0);
    (void)archive_.advance("C-4", "withdrawn", by("A. Author"));
    add("C-5", "no record at all", 0);
    const ArchiveStatistics found = statistics_of(archive_);
    using Counts = std::map<std::string, std::size_t>;
    EXPECT_EQ(found.by_state, (Counts{{"issued", 2}, {"reviewed", 1}, {"withdrawn", 1}, {"drafted", 1}}));
    EXPECT_EQ(found.by_month, (Counts{{"2026-01", 2}})) << "of the entry, whatever the record says";
    EXPECT_EQ(found.by_authoriser, (Counts{{"R. Reviewer", 2}})) << "of the log";
    EXPECT_EQ(found.by_method, (Counts{{"CP-01", 2}})) << "that were issued";
    EXPECT_EQ(found.by_kind, (Counts{{"budget", 2}})) << "that were issued";
    EXPECT_EQ(found.not_read, std::vector<std::string>{"C-5"});
    EXPECT_NE(statistics_text(found).find("Not read: the record of C-5"), std::string::npos);
    EXPECT_EQ(json::parse(statistics_json(found))["by_month"]["2026-01"], 2);
}

TEST_F(StatisticsOfAnArchive, TellsOfClocksThatWereAhead) {
    add("C-1", record("CP-01", "2026-10-05", "M. Weber"));
    EXPECT_EQ(statistics_text(statistics_of(archive_)).find("Clocks"), std::string::npos);
    const auto withdraw = [&](const std::string& number, const std::string& at) {
        (void)archive_.advance(
            number, "withdrawn",
            {.actor = "R. Reviewer", .at = at, .request_key = "", .why = "w", .confirmed_day = at.substr(0, 10)});
    };
    add("C-2", record("CP-01", "2026-10-05", "M. Weber"));
    withdraw("C-2", "2026-03-01T00:00:00Z");
    withdraw("C-1", "2026-01-03T00:00:00Z");
    const ArchiveStatistics found = statistics_of(archive_);
    EXPECT_NE(statistics_text(found).find("Clocks that were ahead: 1 entry of a clock that was set back"),
              std::string::npos);
    const json told = json::parse(statistics_json(found))["clocks_set_back"];
    EXPECT_EQ(told,
              (json{{"entries", 1}, {"entries_ahead", 1}, {"certificates", 2}, {"earliest", "2026-01-03T00:00:00Z"}}));
}

TEST_F(StatisticsOfAnArchive, ListsScoresOfComparisons) {
    json compared = record("CP-01", "2026-11-05", "M. Weber");
    compared["kind"] = "comparison";
    compared["comparison"] = {{"points", {{{"En", -1.2}}, {{"En", 0.4}}, {{"En", nullptr}}}}, {"items", json::array()}};
    add("C-1", compared);
    const ArchiveStatistics found = statistics_of(archive_);
    ASSERT_EQ(found.scores.size(), 1U);
    EXPECT_EQ(found.scores[0].scores, 2U);
    EXPECT_EQ(found.scores[0].above_one, 1U);
    EXPECT_DOUBLE_EQ(found.scores[0].largest, 1.2);
}

/// Sets of readings near one value are one chart; one that scatters too much is told, and its limit is that of the others: F
/// has a closed form for two degrees of freedom, F(2, ν; 1 − q) = ν/2 (q^(−2/ν) − 1).
TEST_F(StatisticsOfAnArchive, ChartsStandardDeviations) {
    for (int i = 0; i < 20; ++i) {
        json one = record("CP-01", "2026-11-" + std::to_string(10 + i), "M. Weber");
        one["readings"] = {readings(10.0 + 0.01 * i, i == 7 ? 0.01 : 0.001, 3), readings(100.0, 0.02, 5),
                           readings(i % 2 == 0 ? 1e-5 : -1e-5, 1e-4, 3)};
        add("C-" + std::to_string(100 + i), one);
    }
    const ArchiveStatistics found = statistics_of(archive_);
    ASSERT_EQ(found.charts.size(), 3U);
    EXPECT_EQ(found.charts[0].near, 0.0);
    EXPECT_DOUBLE_EQ(found.charts[1].near, 10.0);
    EXPECT_DOUBLE_EQ(found.charts[2].near, 100.0);
    const RepeatabilityChart& chart = found.charts[1];
    EXPECT_EQ(chart.scatters.size(), 20U);
    EXPECT_EQ(chart.degrees_of_freedom, 40);
    EXPECT_NEAR(chart.pooled_standard_deviation, std::sqrt((19 * 1e-6 + 1e-4) / 20), 1e-12);
    const double F = 38.0 / 2.0 * (std::pow(0.00135, -2.0 / 38.0) - 1.0);
    EXPECT_NEAR(chart.scatters[0].limit.value(), std::sqrt((18 * 1e-6 + 1e-4) / 19 * F), 1e-9);
    EXPECT_NEAR(chart.scatters[7].limit.value(), 1e-3 * std::sqrt(F), 1e-9);
    for (const ArchivedScatter& one : chart.scatters) {
        EXPECT_EQ(one.is_above(), one.number == "C-107");
    }
    EXPECT_NE(statistics_text(found).find("ABOVE THE LIMIT: C-107"), std::string::npos);
}

/// A certificate has the methods of its sections, and readings that of the section whose point they are of.
TEST_F(StatisticsOfAnArchive, TakeTheMethodsOfSections) {
    for (int i = 0; i < 3; ++i) {
        json one = record("CP-11", "2026-11-0" + std::to_string(1 + i), "M. Weber");
        one["sections"] = {{{"name", "DC"}}, {{"name", "AC"}}, {{"name", "DC, four wires"}}};
        json& certificate = one["certificate"];
        certificate["data"]["sections"] = {{{"section", "AC"}, {"method", {{"identification", "CP-12"}}}},
                                           {{"section", "DC, four wires"}, {"method", nullptr}}};
        certificate["tables"] = {{{"section", "DC"}, {"argument", {{"printed", {"1"}}}}},
                                 {{"section", "AC"}, {"argument", {{"printed", {"2"}}}}},
                                 {{"section", "DC, four wires"}, {"argument", nullptr}}};
        const auto at = [](const char* point, double s) {
            json set = readings(10.0, s, 3);
            set["point"] = point;
            return set;
        };
        one["readings"] = {at("1", 0.001), at("2", 0.01), readings(20.0, 0.001, 3)};
        add("C-" + std::to_string(i), one);
    }
    const ArchiveStatistics found = statistics_of(archive_);
    EXPECT_EQ(found.by_method, (std::map<std::string, std::size_t>{{"CP-11", 3}, {"CP-12", 3}}));
    ASSERT_EQ(found.charts.size(), 3U);
    const auto said = [&](std::size_t i) {
        return found.charts[i].method + " " + std::to_string(found.charts[i].scatters.size());
    };
    EXPECT_EQ(said(0) + ", " + said(1) + ", " + said(2), "CP-11 3, CP-11 3, CP-12 3");
    EXPECT_NEAR(found.charts[0].pooled_standard_deviation, 0.001, 1e-12);
    EXPECT_NEAR(found.charts[2].pooled_standard_deviation, 0.01, 1e-12);
}

/// A set that is out of control has a mean that is less than ten of its own standard deviations away from 0: it stays beside
/// those with its mean. s_p² = (7.6² + 8.36² + 6.84² + 7.6² + 22.8²)/5, s_o² the same without the last one, F(9, 36; 0.99865) = 3.9815.
TEST_F(StatisticsOfAnArchive, ChartASetBesideThoseOfItsMeanWhateverItsScatter) {
    const std::array<double, 5> s = {7.6, 8.36, 6.84, 7.6, 22.8};
    for (std::size_t i = 0; i < s.size(); ++i) {
        json one = record("CP-01", "2026-11-1" + std::to_string(i), "M. Weber");
        one["readings"] = {readings(215.0, s.at(i), 10)};
        add("C-" + std::to_string(i), one);
    }
    const ArchiveStatistics found = statistics_of(archive_);
    ASSERT_EQ(found.charts.size(), 1U);
    EXPECT_EQ(found.charts[0].scatters.size(), 5U);
    EXPECT_EQ(found.charts[0].degrees_of_freedom, 45);
    EXPECT_NEAR(found.charts[0].pooled_standard_deviation, 12.264, 0.0005);
    EXPECT_NEAR(found.charts[0].scatters[4].limit.value(), 15.20, 0.005);
    EXPECT_TRUE(found.charts[0].scatters[4].is_above());
    EXPECT_NE(statistics_text(found).find("ABOVE THE LIMIT: C-4"), std::string::npos);
    EXPECT_TRUE(found.uncharted.empty());
}

/// Of few sets each is held against the others: in a limit that it is in itself, none of four sets of five readings could be above.
TEST_F(StatisticsOfAnArchive, TellASetAmongFew) {
    for (int i = 0; i < 3; ++i) {
        json one = record("CP-01", "2026-11-1" + std::to_string(i), "M. Weber");
        one["readings"] = {readings(1000.0, i == 1 ? 50.0 : 1.0, 5)};
        add("C-" + std::to_string(i), one);
    }
    const ArchiveStatistics found = statistics_of(archive_);
    ASSERT_EQ(found.charts.size(), 1U);
    EXPECT_TRUE(found.charts[0].scatters[1].is_above());
    EXPECT_NEAR(found.charts[0].scatters[1].limit.value(), std::sqrt(13.17367), 1e-5) << "F(4, 8; 0.99865) of a table";
    EXPECT_FALSE(found.charts[0].scatters[0].is_above());
}

/// A mean that a set out of control has moved away from the others does not hide it; a set of another value stays alone.
TEST_F(StatisticsOfAnArchive, TellASetWhoseMeanHasLeftTheOthers) {
    const std::array<std::pair<double, double>, 6> sets = {
        {{215.0, 6.0}, {214.0, 5.0}, {216.0, 6.5}, {193.0, 44.6}, {900.0, 9.3}, {240.0, 8.0}}};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        json one = record("CP-01", "2026-11-1" + std::to_string(i), "M. Weber");
        one["readings"] = {readings(sets.at(i).first, sets.at(i).second, 5)};
        add("C-" + std::to_string(i), one);
    }
    const ArchiveStatistics found = statistics_of(archive_);
    ASSERT_EQ(found.charts.size(), 1U);
    EXPECT_NEAR(found.charts[0].near, 214.0, 1e-9);
    ASSERT_EQ(found.charts[0].scatters.size(), 4U);
    EXPECT_EQ(found.charts[0].scatters[3].number, "C-3");
    EXPECT_TRUE(found.charts[0].scatters[3].is_above());
    ASSERT_EQ(found.uncharted.size(), 2U);
    EXPECT_EQ(found.uncharted[0].scatter.number + found.uncharted[1].scatter.number, "C-5C-4");
}

/// What a display does with steady readings says nothing of the method.
TEST_F(StatisticsOfAnArchive, AccuseNoSetOfOneStep) {
    const auto set = [](const std::vector<std::string>& observations, double s) {
        json one = readings(100.0, s, static_cast<int>(observations.size()));
        one["observations"] = observations;
        return one;
    };
    for (int i = 0; i < 12; ++i) {
        json one = record("CP-01", "2026-11-" + std::to_string(10 + i), "M. Weber");
        one["readings"] = {i < 2    ? set({"100.0", "100.0", "100.1", "100.0"}, 0.05)
                           : i == 2 ? set({"100.0", "100.0", "100.2", "100.0"}, 0.1)
                                    : set({"100.0", "100.0", "100.0", "100.0"}, 0.0)};
        add("C-" + std::to_string(100 + i), one);
    }
    const ArchiveStatistics found = statistics_of(archive_);
    ASSERT_EQ(found.charts.size(), 1U);
    EXPECT_FALSE(found.charts[0].scatters[0].limit);
    EXPECT_FALSE(found.charts[0].scatters[1].is_above());
    EXPECT_TRUE(found.charts[0].scatters[2].is_above());
    EXPECT_TRUE(json::parse(statistics_json(found))["charts"][0]["values"][0]["limit"].is_null());
}

/// Where all others are equal nobody knows how readings scatter.
TEST_F(StatisticsOfAnArchive, HaveNoLimitWhereAllOthersAreEqual) {
    for (int i = 0; i < 12; ++i) {
        json one = record("CP-01", "2026-11-" + std::to_string(10 + i), "M. Weber");
        one["readings"] = {readings(100.0, i == 4 ? 0.3 : 0.0, 5)};
        add("C-" + std::to_string(100 + i), one);
    }
    const RepeatabilityChart chart = statistics_of(archive_).charts.at(0);
    EXPECT_TRUE(
        std::none_of(chart.scatters.begin(), chart.scatters.end(), [](const auto& one) { return one.is_above(); }));
    EXPECT_FALSE(chart.scatters[4].limit);
    EXPECT_TRUE(chart.scatters[0].limit);
}

/// An amendment has the readings of its original: they were taken once, and count once, whichever of the two holds.
TEST_F(StatisticsOfAnArchive, CountReadingsOfAnAmendmentOnce) {
    json one = record("CP-01", "2026-11-05", "M. Weber");
    one["readings"] = {readings(10.0, 0.1, 5)};
    one["comparison"] = {{"points", {{{"En", 0.4}}}}, {"items", json::array()}};
    add("C-1", one);
    add("C-2", one);
    const auto counted = [&] {
        const ArchiveStatistics found = statistics_of(archive_);
        std::string said = std::to_string(found.scores.size()) + " scores";
        for (const RepeatabilityChart& chart : found.charts) {
            for (const ArchivedScatter& scatter : chart.scatters) {
                said += " " + scatter.number;
            }
        }
        for (const UnchartedScatter& alone : found.uncharted) {
            said += " " + alone.scatter.number;
        }
        return said;
    };
    EXPECT_EQ(counted(), "2 scores C-1 C-2");
    for (const std::string original : {"C-1", "C-1/A1"}) {
        const std::string number = original + "/A1";
        Draft draft = test::sample_draft(number);
        draft.record = one.dump(static_cast<int>(number.size()));
        draft.amends = Draft::Amends{.number = original, .kind = "amended", .changes = {{"text", "/item", "a", "b"}}};
        (void)archive_.draft(draft, by("A. Author"));
        EXPECT_EQ(counted(), "2 scores " + (original == "C-1" ? std::string("C-1 C-2") : "C-1/A1 C-2"))
            << "not issued yet";
        const std::size_t before = statistics_of(archive_).amendments;
        EXPECT_EQ(before, original == "C-1" ? 0U : 1U) << "no draft is among them";
        for (const char* const kind : {"reviewed", "authorised", "issued"}) {
            (void)archive_.advance(number, kind, by("R. Reviewer"));
        }
        EXPECT_EQ(statistics_of(archive_).amendments, before + 1);
        EXPECT_EQ(counted(), "2 scores " + number + " C-2");
    }
    (void)archive_.advance("C-1/A1/A1", "withdrawn", by("R. Reviewer"));
    EXPECT_EQ(counted(), "1 scores C-2");
    EXPECT_EQ(statistics_of(archive_).by_method.at("CP-01"), 3U) << "certificates are counted one by one";
}

/// Law: whatever scatters how much, sets with one mean are in one chart, and every set is in a chart or told to be in none.
TEST_F(StatisticsOfAnArchive, LoseNoSet) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> exponent(-3.0, 3.0);
    json one = record("CP-01", "2026-11-05", "M. Weber");
    one["readings"] = json::array();
    constexpr std::size_t k_sets = 60;
    for (std::size_t i = 0; i < k_sets; ++i) {
        one["readings"].push_back(
            readings(i % 2 == 0 ? 3.0 : std::pow(10.0, 2.0 * exponent(random)), std::pow(10.0, exponent(random)), 4));
    }
    add("C-1", one);
    const ArchiveStatistics found = statistics_of(archive_);
    std::size_t sets = found.uncharted.size();
    std::size_t charts_of_three = 0;
    for (const RepeatabilityChart& chart : found.charts) {
        sets += chart.scatters.size();
        const auto threes = std::count_if(chart.scatters.begin(), chart.scatters.end(),
                                          [](const ArchivedScatter& scatter) { return scatter.mean == 3.0; });
        charts_of_three += threes > 0 ? 1U : 0U;
    }
    EXPECT_EQ(sets, k_sets);
    EXPECT_EQ(charts_of_three, 1U);
    EXPECT_FALSE(found.uncharted.empty());
    EXPECT_NE(statistics_text(found).find("In no chart, because no other readings are near them"), std::string::npos);
    EXPECT_EQ(json::parse(statistics_json(found))["uncharted"].size(), found.uncharted.size());
}

/// Of readings that are in control about one in 740 is above its limit.
TEST_F(StatisticsOfAnArchive, RarelyAccusesWhatIsInControl) {
    std::mt19937_64 random(20261127);
    std::normal_distribution<double> normal;
    json one = record("CP-01", "2026-11-05", "M. Weber");
    one["readings"] = json::array();
    constexpr int k_sets = 20'000;
    for (int i = 0; i < k_sets; ++i) {
        std::array<double, 5> x{};
        std::generate(x.begin(), x.end(), [&] { return normal(random); });
        const double mean = std::accumulate(x.begin(), x.end(), 0.0) / 5.0;
        double squares = 0.0;
        for (const double v : x) {
            squares += (v - mean) * (v - mean);
        }
        one["readings"].push_back(readings(1000.0, std::sqrt(squares / 4.0), 5));
    }
    add("C-1", one);
    const ArchiveStatistics found = statistics_of(archive_);
    const auto above = std::count_if(found.charts.at(0).scatters.begin(), found.charts.at(0).scatters.end(),
                                     [](const ArchivedScatter& scatter) { return scatter.is_above(); });
    EXPECT_THAT(static_cast<double>(above), testing::AllOf(testing::Gt(10.0), testing::Lt(50.0)));  // 27 ± 4.5 √27
}

}  // namespace
}  // namespace gumcert::archive
