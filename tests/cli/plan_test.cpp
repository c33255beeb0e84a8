// `gumcert plan`: what it expects, in which forms it says so, what it refuses.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

const fs::path k_example = fs::path(GUMCERT_SOURCE_DIR) / "examples" / "rotary_table";

/// Of the reflectors of the example, along its axis: where a repeatability acts that was estimated, [mm].
double centroid_along_x() {
    std::istringstream fixture(bytes_of(k_example / "fixture.csv"));
    double sum = 0.0;
    int reflectors = 0;
    for (std::string line; std::getline(fixture, line);) {
        if (line.starts_with('R')) {
            sum += std::stod(line.substr(line.find(',') + 1));
            ++reflectors;
        }
    }
    return sum / reflectors;
}

/// A small copy of the shipped plan: eight angles, a coarse grid.
class Plan : public ProgramTest {
protected:
    void SetUp() override {
        fs::create_directory(folder() / "job");
        for (const char* name : {"stations.csv", "fixture.csv"}) {
            fs::copy_file(k_example / name, folder() / "job" / name);
        }
        job_ = json::parse(bytes_of(k_example / "plan.json"), nullptr, true, true);
        job_["plan"]["angles_deg"] = {{"first", 0}, {"step", 45}, {"count", 8}};
        job_["plan"]["station_region"]["step_mm"] = 800;
    }

    [[nodiscard]] fs::path file() const { return folder() / "job" / "plan.json"; }
    /// `gumcert plan` of `job_`, written as JSON and read again.
    json planned(std::vector<std::string> more = {}) const {
        write_bytes(file(), job_.dump());
        const fs::path output = folder() / "out.json";
        more.insert(more.begin(), {"plan", file().string(), "-o", output.string()});
        const Ended ended = gumcert(more);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return ended.code == 0 ? json::parse(bytes_of(output)) : json();
    }
    Ended refused() const {
        write_bytes(file(), job_.dump());
        const Ended ended = gumcert({"plan", file().string(), "-o", (folder() / "out.json").string()});
        EXPECT_FALSE(fs::exists(folder() / "out.json"));
        return ended;
    }

    json job_;
};

TEST_F(Plan, TheShippedExampleSaysWhatToExpect) {
    const Ended ended = gumcert({"plan", (k_example / "plan.json").string(), "-o", "-"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    for (const char* text : {"EXA", "ECA", "What to expect", "Proposed stations", "without station P1",
                             "twice the angles", "half the table repeatability", "length noise"}) {
        EXPECT_NE(ended.out.find(text), std::string::npos) << text << " is missing in\n" << ended.out;
    }
    EXPECT_EQ(ended.out.find("nan"), std::string::npos);
}

TEST_F(Plan, TextIsTheDefaultAndFilesGoByTheirEnding) {
    write_bytes(file(), job_.dump());
    const Ended to_terminal = gumcert({"plan", file().string()});
    ASSERT_EQ(to_terminal.code, 0) << to_terminal.err;
    const fs::path text = folder() / "out.txt";
    const fs::path html = folder() / "out.html";
    ASSERT_EQ(gumcert({"plan", file().string(), "-o", text.string()}).code, 0);
    EXPECT_EQ(bytes_of(text), to_terminal.out);
    const Ended page = gumcert({"plan", file().string(), "-o", html.string(), "--share", GUMCERT_SOURCE_DIR});
    ASSERT_EQ(page.code, 0) << page.err;
    EXPECT_NE(bytes_of(html).find("<svg"), std::string::npos);
    EXPECT_EQ(gumcert({"plan", file().string(), "-o", (folder() / "out.odt").string()}).code, 2);
    if (const std::string reason = why_no_pdf(); reason.empty()) {
        const fs::path pdf = folder() / "out.pdf";
        const Ended made = gumcert({"plan", file().string(), "-o", pdf.string(), "--share", GUMCERT_SOURCE_DIR});
        ASSERT_EQ(made.code, 0) << made.err;
        EXPECT_TRUE(bytes_of(pdf).starts_with("%PDF-"));
    }
}

/// What a page lacks is told before the study; what is found when it is set loses nothing.
TEST_F(Plan, AStudyIsKeptWhenItsPdfCannotBeMade) {
    if (const std::string reason = why_no_pdf(); !reason.empty()) {
        GTEST_SKIP() << reason;
    }
    const fs::path pdf = folder() / "out" / "plan.pdf";
    const std::vector<std::string> command = {"plan",       file().string(), "-o",
                                              pdf.string(), "--share",       GUMCERT_SOURCE_DIR};
    write_bytes(file(), job_.dump());
    for (const std::map<std::string, std::string>& lacking :
         {std::map<std::string, std::string>{{"TMPDIR", "/proc"}}, {{"PATH", (folder() / "empty").string()}}}) {
        const Ended before = gumcert(command, {.environment = lacking});
        EXPECT_EQ(before.code, 5) << before.err;
        EXPECT_NE(before.err.find("[GC-REPORT-0010]"), std::string::npos) << before.err;
        EXPECT_FALSE(fs::exists(folder() / "out")) << "nothing was computed, nothing is kept";
    }
    const json good = job_;
    job_["title"] = "Table \U0001F600";
    write_bytes(file(), job_.dump());
    const Ended failed = gumcert(command);
    EXPECT_EQ(failed.code, 5) << failed.err;
    EXPECT_LT(failed.err.find("[GC-STORE-0022]"), failed.err.find("[GC-REPORT-0011]")) << failed.err;
    EXPECT_LT(failed.err.find("[GC-REPORT-0045]"), failed.err.find("[GC-STORE-0022]")) << "told before: " << failed.err;
    EXPECT_FALSE(fs::exists(pdf));
    const fs::path kept = folder() / "out" / "record-kept";
    EXPECT_EQ(json::parse(bytes_of(kept / "plan.json"))["schema"], "gumcert/plan/1");
    EXPECT_NE(bytes_of(kept / "plan.txt").find("What to expect"), std::string::npos);
    EXPECT_EQ(gumcert({"check", kept.string()}).code, 0) << "a set of its own";
    write_bytes(file(), good.dump());
    const Ended done = gumcert(command);
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_NE(done.err.find("[GC-STORE-0023]"), std::string::npos) << "what was kept is older: " << done.err;
}

TEST_F(Plan, DataSayTheSameAsEachOther) {
    const json data = planned();
    EXPECT_EQ(data["schema"], "gumcert/plan/1");
    EXPECT_EQ(data["distances"], 6 * 6 * 8);
    const json& expected = data["expected"];
    ASSERT_EQ(expected["angles"].size(), 8U);
    EXPECT_NEAR(data["coverage_factor"].get<double>(), 2.0, 1e-4);
    double ratio = 0.0;
    for (const auto& [name, motion] : expected["error_motions"].items()) {
        double largest = 0.0;
        double squares = 0.0;
        for (const json& angle : expected["angles"]) {
            const double U = angle[name]["U"].get<double>();
            EXPECT_GT(U, 0.0);
            largest = std::max(largest, U);
            squares += U * U;
        }
        EXPECT_NEAR(motion["U_largest"].get<double>(), largest, 1e-8 * largest) << name;
        EXPECT_NEAR(motion["U_rms"].get<double>(), std::sqrt(squares / 8.0), 1e-9 * largest) << name;
        EXPECT_EQ(motion["target_met"].get<bool>(), largest <= motion["target"].get<double>()) << name;
        ratio = std::max(ratio, largest / motion["target"].get<double>());
        double share = 0.0;
        for (const auto& [source, value] : data["budget"][name]["shares"].items()) {
            share += value.get<double>();
        }
        EXPECT_NEAR(share, 1.0, 1e-6) << name;
    }
    EXPECT_NEAR(expected["largest_ratio"].get<double>(), ratio, 1e-8 * ratio);
    // 288 distances, 18 coordinates, 6 scales, 1 expansion are observed; 6·4 + 6 + 18 + 1 + 6·7 parameters.
    EXPECT_EQ(expected["parameters"], 91);
    EXPECT_EQ(expected["degrees_of_freedom"], 288 + 18 + 6 + 1 - 91);
}

TEST_F(Plan, WhatIsTakenAwayCostsAndWhatIsImprovedHelps) {
    const json data = planned();
    const double planned_ratio = data["expected"]["largest_ratio"].get<double>();
    std::map<std::string, int> changes;
    for (const json& row : data["sensitivity"]) {
        const std::string change = row["change"].get<std::string>();
        ++changes[change];
        ASSERT_TRUE(row["determined"].get<bool>()) << row;
        const double ratio = row["largest_ratio"].get<double>();
        if (change == "as_planned") {
            EXPECT_NEAR(ratio, planned_ratio, 1e-7 * ratio);
        } else if (change.starts_with("without")) {
            EXPECT_GT(ratio, planned_ratio) << row;
        } else if (change == "half_the_length_noise" || change == "half_the_table_repeatability") {
            EXPECT_LT(ratio, planned_ratio) << row;
            EXPECT_GT(ratio, 0.5 * planned_ratio) << row;
        }
    }
    EXPECT_EQ(changes["without_station"], 6);
    EXPECT_EQ(changes["without_reflector"], 6);
    EXPECT_EQ(changes["half_the_angles"], 1);
    EXPECT_EQ(changes["twice_the_angles"], 1);
}

TEST_F(Plan, WhatCannotBeLeftOutIsNamedWithItsCure) {
    // Of three reflectors none can be spared: about the line through two the table could turn unseen.
    const std::vector<std::string> lines = lines_of(bytes_of(k_example / "fixture.csv"));
    write_bytes(folder() / "job" / "fixture.csv",
                lines[0] + "\n" + lines[1] + "\n" + lines[2] + "\n" + lines[4] + "\n");
    job_["plan"].erase("station_region");
    job_["plan"].erase("least_distance_mm");
    const json data = planned();
    int reflectors = 0;
    for (const json& row : data["sensitivity"]) {
        const bool is_reflector = row["change"] == "without_reflector";
        reflectors += is_reflector ? 1 : 0;
        EXPECT_EQ(row["determined"].get<bool>(), !is_reflector) << row;
        EXPECT_EQ(row["message"].is_null(), !is_reflector) << row;
        EXPECT_EQ(row["U_largest"].is_null(), is_reflector) << row;
    }
    EXPECT_EQ(reflectors, 3);
    const Ended text = gumcert({"plan", file().string()});
    EXPECT_NE(text.out.find("not determined"), std::string::npos) << text.out;
}

TEST_F(Plan, StationsAmongTheReflectorsAreNamed) {
    job_["plan"].erase("station_region");
    const std::vector<std::string> lines = lines_of(bytes_of(k_example / "stations.csv"));
    std::string stations = lines[0] + "\n" + lines[1].substr(0, lines[1].find(',')) + ",100,20,10,20\n";
    for (std::size_t i = 2; i < lines.size(); ++i) {
        stations += lines[i] + "\n";
    }
    write_bytes(folder() / "job" / "stations.csv", stations);
    ASSERT_FALSE(planned().is_null());  // writes the job
    Ended text = gumcert({"plan", file().string()});
    ASSERT_EQ(text.code, 0) << text.err;
    std::replace(text.out.begin(), text.out.end(), '\n', ' ');  // sentences go on in the next line
    EXPECT_NE(text.out.find("station P1 — stands "), std::string::npos) << text.out;
    EXPECT_EQ(text.out.find("station P2 — stands "), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("a table whose E is at least "), std::string::npos) << text.out;
}

TEST_F(Plan, ProposedStationsStandInTheRegionAndAreBetter) {
    // A bad layout: all stations close together.
    std::string stations = "station,x_mm,y_mm,z_mm\n";
    for (int j = 0; j < 6; ++j) {
        stations += "P" + std::to_string(j + 1) + "," + std::to_string(900 + 40 * j) + "," +
                    std::to_string(60 - 45 * (j % 3)) + "," + std::to_string(-80 + 50 * (j % 4)) + "\n";
    }
    write_bytes(folder() / "job" / "stations.csv", stations);
    const json data = planned();
    const json& proposal = data["proposal"];
    ASSERT_FALSE(proposal["exchanges"].empty());
    EXPECT_GT(proposal["improvement_factor"].get<double>(), 2.0);
    double last = data["expected"]["largest_ratio"].get<double>();
    for (const json& exchange : proposal["exchanges"]) {
        EXPECT_LT(exchange["largest_ratio"].get<double>(), last);
        last = exchange["largest_ratio"].get<double>();
    }
    EXPECT_NEAR(proposal["expected"]["largest_ratio"].get<double>(), last, 1e-6 * last);
    const json& region = job_["plan"]["station_region"];
    for (const json& station : proposal["expected"]["stations"]) {
        bool moved = false;
        for (const json& exchange : proposal["exchanges"]) {
            moved = moved || exchange["station"] == station["station"];
        }
        for (std::size_t c = 0; moved && c < 3; ++c) {
            const json& limits = region[std::array{"x_mm", "y_mm", "z_mm"}[c]];
            EXPECT_GE(station["position_mm"][c].get<double>(), limits[0].get<double>() - 1e-9);
            EXPECT_LE(station["position_mm"][c].get<double>(), limits[1].get<double>() + 1e-9);
        }
    }
}

TEST_F(Plan, ProposedStationsAreLinesOfAStationsFileWhateverTheirNames) {
    std::string stations = bytes_of(folder() / "job" / "stations.csv");
    stations.replace(stations.find("P1,"), 2, "\"=P1,b\"");
    write_bytes(folder() / "job" / "stations.csv", stations);
    write_bytes(file(), job_.dump());
    const fs::path output = folder() / "out.html";
    ASSERT_EQ(gumcert({"plan", file().string(), "-o", output.string()}).code, 0);
    EXPECT_NE(bytes_of(output).find("&quot;&apos;=P1,b&quot;,"), std::string::npos) << "quoted, and no formula";
}

TEST_F(Plan, SameBytesForAnyNumberOfThreads) {
    const json one = planned({"--threads", "1"});
    const std::string bytes = bytes_of(folder() / "out.json");
    const json three = planned({"--threads", "3"});
    EXPECT_EQ(bytes_of(folder() / "out.json"), bytes);
}

/// Targets that one layout of the data meets, by name.
std::map<std::string, bool> targets_of(const json& expected) {
    std::map<std::string, bool> met;
    for (const auto& [name, motion] : expected["error_motions"].items()) {
        met[name] = motion["target_met"].get<bool>();
    }
    for (const json& parameter : expected["table_parameters"]) {
        if (!parameter["target"].is_null()) {
            met[parameter["quantity"].get<std::string>()] = parameter["target_met"].get<bool>();
        }
    }
    return met;
}

TEST_F(Plan, EveryTargetThatAProposalBreaksIsNamed) {
    // Targets about as large as the uncertainties, so that some are met and some not, in many ways.
    std::uint32_t state = 7;
    const auto any = [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 8U) / 16777216.0;
    };
    std::size_t broken_ones = 0;
    std::size_t kept_ones = 0;
    for (int trial = 0; trial < 6; ++trial) {
        job_["plan"]["senses"] = trial % 2 == 0 ? "one" : "both";
        job_["datum"] = trial % 3 == 0 ? "home" : "axis_average_line";
        job_["plan"]["angles_deg"] = {{"first", 0}, {"step", 60}, {"count", 6}};
        job_["plan"]["targets"] = {{"linear_um", 0.2 + 0.6 * any()},
                                   {"angular_arcsec", 0.3 + 0.5 * any()},
                                   {"range_linear_um", 0.3 + 0.7 * any()},
                                   {"range_angular_arcsec", 0.4 + 0.6 * any()},
                                   {"location_um", 0.2 + 0.8 * any()},
                                   {"location_arcsec", 0.3 + 1.2 * any()},
                                   {"E_arcsec", 0.3 + 0.7 * any()},
                                   {"R_arcsec", 0.5 + any()},
                                   {"A_arcsec", 0.5 + any()}};
        std::string stations = "station,x_mm,y_mm,z_mm\n";
        for (int j = 0; j < 6; ++j) {
            stations += "P" + std::to_string(j + 1) + "," + std::to_string(450.0 + 800.0 * any()) + "," +
                        std::to_string(1400.0 * (any() - 0.5)) + "," + std::to_string(1000.0 * (any() - 0.5)) + "\n";
        }
        write_bytes(folder() / "job" / "stations.csv", stations);
        for (const bool keep : {false, true}) {
            job_["plan"]["keep_met_targets"] = keep;
            const json data = planned();
            ASSERT_FALSE(data.is_null()) << trial;
            const auto before = targets_of(data["expected"]);
            const auto after = targets_of(data["proposal"]["expected"]);
            ASSERT_EQ(before.size(), after.size());
            std::set<std::string> broken;
            for (const auto& [name, met] : before) {
                if (met && !after.at(name)) {
                    broken.insert(name);
                }
            }
            const json& named = data["proposal"]["targets_broken"];
            EXPECT_EQ(broken, std::set<std::string>(named.begin(), named.end())) << trial;
            broken_ones += keep ? 0 : broken.size();
            if (keep) {
                EXPECT_TRUE(broken.empty()) << trial;
                kept_ones += data["proposal"]["exchanges"].size();
            }
            if (!broken.empty()) {
                const Ended text = gumcert({"plan", file().string()});
                EXPECT_NE(text.out.find("break what the planned ones meet"), std::string::npos) << text.out;
                for (const std::string& name : broken) {
                    EXPECT_NE(text.out.find(name), std::string::npos);
                }
            }
        }
    }
    EXPECT_GT(broken_ones, 0U) << "nothing that had to be named";
    EXPECT_GT(kept_ones, 0U) << "nothing was exchanged where targets are kept";
}

TEST_F(Plan, ParametersHaveTheUncertaintyThatAnEvaluationStates) {
    // One simulated campaign would do for the location; ranges, E, R and A depend on its extremes, within bounds.
    const json record = evaluate(k_example / "job.json");
    ASSERT_FALSE(record.is_null());
    const json& rotary = record["rotary"];
    for (const fs::directory_entry& entry : fs::directory_iterator(k_example)) {
        if (entry.path().extension() == ".csv" || entry.path().filename() == "dial_indicator.json") {
            fs::copy_file(entry.path(), folder() / "job" / entry.path().filename(),
                          fs::copy_options::overwrite_existing);
        }
    }
    job_ = json::parse(bytes_of(k_example / "job.json"), nullptr, true, true);
    const auto component = [&](const std::string& part) {
        for (const json& one : rotary["variance_components"]) {
            if (one["name"].get<std::string>().find(part) != std::string::npos) {
                return one["value"].get<double>();
            }
        }
        ADD_FAILURE() << "no variance component of " << part;
        return 0.0;
    };
    job_["length_uncertainty"]["u_constant_um"] = component("length");
    job_["table_repeatability"] = {{"mode", "given"},
                                   {"u_linear_um", component("linear")},
                                   {"u_axial_arcsec", component("axial")},
                                   {"u_tilt_arcsec", component("tilt")},
                                   {"at_mm", centroid_along_x()}};
    const json data = planned();
    std::map<std::string, double> u;
    for (const json& parameter : data["expected"]["table_parameters"]) {
        ASSERT_FALSE(parameter["u"].is_null()) << parameter;
        u[parameter["quantity"].get<std::string>()] = parameter["u"].get<double>();
        EXPECT_TRUE(parameter["target"].is_null());
    }
    for (const json& range : rotary["ranges"]) {
        const std::string name = "range of " + range["name"].get<std::string>();
        // Of EXA and ECA it is as clear which angles are extreme as of the drawn tables; of the others an evaluation states more.
        EXPECT_LT(u.at(name) / range["u"].get<double>(), 1.05) << name;
        if (name == "range of EXA" || name == "range of ECA") {
            EXPECT_NEAR(u.at(name) / range["u"].get<double>(), 1.0, 0.05) << name;
        }
    }
    for (const json& error : rotary["axis_line"]) {
        const std::string name = error["name"].get<std::string>();
        EXPECT_NEAR(u.at(name) / error["u"].get<double>(), 1.0, 0.02) << name;
    }
    std::size_t compared = 0;
    for (const json& parameter : rotary["iso230_2"]["parameters"]) {
        const std::string name = parameter["name"].get<std::string>();
        if (u.contains(name)) {
            EXPECT_LT(u.at(name) / parameter["u"].get<double>(), 1.05) << name;
            EXPECT_GT(u.at(name) / parameter["u"].get<double>(), 0.3) << name;
            ++compared;
        }
    }
    EXPECT_EQ(compared, 3U);
}

TEST_F(Plan, WhatIsNotLookedAtIsSaid) {
    write_bytes(file(), job_.dump());
    const Ended text = gumcert({"plan", file().string()});
    std::string words = text.out;
    std::replace(words.begin(), words.end(), '\n', ' ');
    for (const char* said : {"The job states no obstacle", "whether one hides another was not looked at",
                             "which beams the reflectors accept"}) {
        EXPECT_NE(words.find(said), std::string::npos) << said;
    }
    EXPECT_TRUE(planned()["sight"].is_null());
}

TEST_F(Plan, DistancesThatAreNotSeenAreLeftOut) {
    job_["plan"]["sight"] = {
        {"boxes", {{{"name", "post"}, {"x_mm", {250, 320}}, {"y_mm", {-60, 60}}, {"z_mm", {-400, 400}}}}},
        {"reflector_diameter_mm", 38.1},
        {"acceptance_angle_deg", 60},
        {"facing", {{{"reflector", "R1"}, {"direction", {1, 0, 0}}}}}};
    const json data = planned();
    ASSERT_FALSE(data.is_null());
    std::map<std::string, std::size_t> sums;
    for (const json& station : data["sight"]) {
        for (const auto& [key, value] : station.items()) {
            sums[key] += value.is_number() ? value.get<std::size_t>() : 0;
        }
    }
    EXPECT_EQ(sums["distances"], 288U);
    EXPECT_GT(sums["behind_obstacles"], 0U);
    EXPECT_EQ(sums["seen"], data["distances"].get<std::size_t>());
    EXPECT_LT(sums["seen"], 288U);
    EXPECT_EQ(data["expected"]["degrees_of_freedom"].get<std::size_t>(), sums["seen"] + 18 + 6 + 1 - 91);
    std::size_t proposed = 0;
    for (const json& station : data["proposal"]["sight"]) {
        proposed += station["seen"].get<std::size_t>();
    }
    EXPECT_EQ(data["proposal"]["expected"]["degrees_of_freedom"].get<std::size_t>(), proposed + 18 + 6 + 1 - 91);
    // What the search claims of its last exchange is what its layout gives, with what is seen from there.
    if (!data["proposal"]["exchanges"].empty()) {
        const double claimed = data["proposal"]["exchanges"].back()["largest_ratio"].get<double>();
        EXPECT_NEAR(data["proposal"]["expected"]["largest_ratio"].get<double>(), claimed, 1e-6 * claimed);
    }
    const Ended text = gumcert({"plan", file().string()});
    EXPECT_NE(text.out.find("Obstacles: post"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("that are not seen"), std::string::npos) << text.out;
}

TEST_F(Plan, AReflectorInsideAnObstacleAndABlindStationAreRefused) {
    job_["plan"]["sight"] = {
        {"cylinders", {{{"name", "table"}, {"radius_mm", 2000}, {"along_axis_mm", {-2000, 2000}}}}}};
    Ended ended = refused();
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("GC-PLAN-0003"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("/plan/sight/cylinders/0"), std::string::npos) << ended.err;
    job_["plan"]["sight"] = {{"boxes",
                              {{{"name", "wall"},
                                {"x_mm", {380, 390}},
                                {"y_mm", {-5000, 5000}},
                                {"z_mm", {-5000, 5000}},
                                {"turns", false}}}}};
    ended = refused();
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("GC-PLAN-0004"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("station P1"), std::string::npos) << ended.err;
}

TEST_F(Plan, WithoutRegionNoStationMoves) {
    job_["plan"].erase("station_region");
    job_["plan"].erase("least_distance_mm");
    EXPECT_TRUE(planned()["proposal"].is_null());
}

TEST_F(Plan, BothSensesPlanTheReversals) {
    job_["plan"]["senses"] = "both";
    job_["plan"].erase("station_region");
    job_["plan"].erase("least_distance_mm");
    const json data = planned();
    EXPECT_EQ(data["distances"], 2 * 6 * 6 * 8);
    EXPECT_EQ(data["expected"]["others"].size(), 10U);
    EXPECT_NE(data["expected"]["others"][4]["quantity"].get<std::string>().find("reversal of EXA"), std::string::npos);
}

TEST_F(Plan, MeasuredLengthsGiveTheLayoutButNotTheResult) {
    // The shipped campaign: its plan with the variances that its evaluation finds is what its evaluation states.
    const json record = evaluate(k_example / "job.json");
    ASSERT_FALSE(record.is_null());
    const json& rotary = record["rotary"];
    for (const fs::directory_entry& entry : fs::directory_iterator(k_example)) {
        if (entry.path().extension() == ".csv" || entry.path().filename() == "dial_indicator.json") {
            fs::copy_file(entry.path(), folder() / "job" / entry.path().filename(),
                          fs::copy_options::overwrite_existing);
        }
    }
    job_ = json::parse(bytes_of(k_example / "job.json"), nullptr, true, true);
    std::map<std::string, double> components;
    for (const json& component : rotary["variance_components"]) {
        components[component["name"].get<std::string>()] = component["value"].get<double>();
    }
    ASSERT_FALSE(components.empty());
    const auto component = [&](const std::string& part) {
        for (const auto& [name, value] : components) {
            if (name.find(part) != std::string::npos) {
                return value;
            }
        }
        ADD_FAILURE() << "no variance component of " << part;
        return 0.0;
    };
    job_["length_uncertainty"]["u_constant_um"] = component("length");
    // The stations file of the example is good to 20 mm, which is 1 % in some of the uncertainties.
    std::string stations = "station,x_mm,y_mm,z_mm\n";
    for (const json& station : rotary["stations"]) {
        stations += station["name"].get<std::string>();
        for (const json& coordinate : station["position_mm"]) {
            stations += "," + coordinate.dump();
        }
        stations += "\n";
    }
    write_bytes(folder() / "job" / "stations.csv", stations);
    job_["table_repeatability"] = {{"mode", "given"},
                                   {"u_linear_um", component("linear")},
                                   {"u_axial_arcsec", component("axial")},
                                   {"u_tilt_arcsec", component("tilt")},
                                   {"at_mm", centroid_along_x()}};
    const json data = planned();
    EXPECT_EQ(data["expected"]["observations"], rotary["adjustment"]["observations"]);
    ASSERT_EQ(data["expected"]["angles"].size(), rotary["errors"].size());
    for (std::size_t i = 0; i < rotary["errors"].size(); ++i) {
        for (const char* name : {"EXA", "EYA", "EZA", "EAA", "EBA", "ECA"}) {
            const double stated = rotary["errors"][i][name]["u"].get<double>();
            EXPECT_NEAR(data["expected"]["angles"][i][name]["u"].get<double>() / stated, 1.0, 1e-3) << name << " " << i;
        }
    }
}

TEST_F(Plan, ARegionWithoutAFreePositionIsRefused) {
    job_["plan"]["least_distance_mm"] = 90000;
    const Ended ended = refused();
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("GC-PLAN-0002"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("station_region"), std::string::npos) << ended.err;
}

TEST_F(Plan, ALayoutThatDeterminesTooLittleHasNoResult) {
    job_["plan"]["angles_deg"] = {0, 180};
    const Ended ended = refused();
    EXPECT_EQ(ended.code, 4) << ended.err;
    EXPECT_NE(ended.err.find("GC-RANK-"), std::string::npos) << ended.err;
}

TEST_F(Plan, OtherKindsOfJobsAreRefused) {
    const Ended ended = gumcert({"plan", (fs::path(GUMCERT_SOURCE_DIR) / "examples/end_gauge/job.json").string()});
    EXPECT_EQ(ended.code, 3) << ended.err;
    EXPECT_NE(ended.err.find("rotary_table"), std::string::npos) << ended.err;
    EXPECT_TRUE(ended.out.empty());
}

}  // namespace
}  // namespace gumcert::cli
