// Campaigns whose answer is known, or of which it is known that there is none.
#include <cmath>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

class CampaignRun : public ProgramTest {
protected:
    /// Six reflectors at one height on a ring about the rotary axis, alternate ones raised; station P3 on the axis.
    static ExactCampaign ring(double raised_mm) {
        ExactCampaign campaign;
        for (std::size_t m = 0; m < campaign.reflectors.size(); ++m) {
            const double angle = std::numbers::pi / 3.0 * static_cast<double>(m);
            campaign.reflectors[m] = {100.0 + (m % 2 == 0 ? raised_mm : 0.0), 120.0 * std::cos(angle),
                                      120.0 * std::sin(angle)};
        }
        campaign.stations[2] = {1000.0, 0.0, 0.0};
        campaign.start_values = true;
        return campaign;
    }
};

TEST_F(CampaignRun, ExactDistancesGiveBackWhatTheyWereMadeFrom) {
    ExactCampaign campaign;
    campaign.offset_y_um = 31.0;
    campaign.offset_z_um = -22.0;
    campaign.tilt_y_arcsec = 14.0;
    campaign.tilt_z_arcsec = -25.0;
    campaign.exa_um = 2.0;
    campaign.eaa_arcsec = 4.0;
    const fs::path job = campaign.write(folder() / "job");
    for (const char* const datum : {"axis_average_line", "home"}) {
        for (const char* const method : {"joint", "sequential"}) {
            SCOPED_TRACE(std::string(datum) + ", " + method);
            change_json(job, [&](json& document) { document["datum"] = datum, document["method"] = method; });
            const json record = evaluate(job);
            ASSERT_TRUE(record.is_object());
            const json& set_up = record["rotary"]["set_up"];
            const json& axis = record["rotary"]["axis_in_fixture"];
            const double um = 1e-3;
            const double arcsec = 1e-3;
            EXPECT_NEAR(set_up["O_um"][1].get<double>(), 31.0, um);
            EXPECT_NEAR(set_up["O_um"][2].get<double>(), -22.0, um);
            EXPECT_NEAR(set_up["S_arcsec"][1].get<double>(), 14.0, arcsec);
            EXPECT_NEAR(set_up["S_arcsec"][2].get<double>(), -25.0, arcsec);
            EXPECT_NEAR(axis["O_um"][1].get<double>(), -31.0, um);
            EXPECT_NEAR(axis["S_arcsec"][2].get<double>(), 25.0, arcsec);
            for (const json& row : record["rotary"]["errors"]) {
                const double wave = std::sin(2.0 * row["angle_deg"].get<double>() * std::numbers::pi / 180.0);
                for (const std::string& name : k_error_motions) {
                    const double expected = name == "EXA" ? 2.0 * wave : name == "EAA" ? 4.0 * wave : 0.0;
                    EXPECT_NEAR(row[name]["value"].get<double>(), expected, 2e-3) << name << row["angle_deg"];
                }
            }
            for (std::size_t j = 0; j < campaign.stations.size(); ++j) {
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(record["rotary"]["stations"][j]["position_mm"][c].get<double>(),
                                campaign.stations[j][c], 1e-4);
                }
                EXPECT_NEAR(record["rotary"]["dead_paths"][j]["value_mm"].get<double>(), campaign.dead_path_mm, 1e-4);
            }
        }
    }
}

TEST_F(CampaignRun, ReflectorsOnAConeSeenFromTheAxisHaveNoResult) {
    const fs::path job = ring(0.0).write(folder() / "job");
    const auto before = contents_of(folder());
    const Ended ended = run(job, folder() / "out", {"--json-messages"});
    EXPECT_EQ(ended.code, 4) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(contents_of(folder()), before) << "nothing is written";
    const std::vector<Message> messages = json_messages(ended);
    ASSERT_EQ(messages.size(), 1U) << ended.err;
    EXPECT_EQ(messages[0].code, "GC-RANK-0001");
    EXPECT_NE((messages[0].where + messages[0].what).find("station P3"), std::string::npos) << ended.err;
    EXPECT_EQ((messages[0].where + messages[0].what).find("station P1"), std::string::npos) << ended.err;
    EXPECT_NE(messages[0].rule.find("cone"), std::string::npos) << ended.err;
    EXPECT_NE(messages[0].action.find("move the station off the rotary axis"), std::string::npos) << ended.err;
    EXPECT_EQ(messages[0].severity, "error");
}

TEST_F(CampaignRun, WithoutStartValuesTheRingIsRefusedAlike) {
    // A stations file would not cure it: the station cannot be told from its dead path.
    ExactCampaign campaign = ring(0.0);
    campaign.start_values = false;
    const Ended ended = run(campaign.write(folder() / "job"), folder() / "out", {"--json-messages"});
    EXPECT_EQ(ended.code, 4) << ended.err;
    EXPECT_FALSE(fs::exists(folder() / "out"));
    const std::vector<Message> messages = json_messages(ended);
    ASSERT_EQ(messages.size(), 1U) << ended.err;
    EXPECT_EQ(messages[0].code, "GC-RANK-0001");
    EXPECT_TRUE(messages[0].where.starts_with("station P")) << messages[0].where;
    EXPECT_NE(messages[0].action.find("move the station off the rotary axis"), std::string::npos) << messages[0].action;
}

TEST_F(CampaignRun, RaisedReflectorsCureTheCone) {
    const json record = evaluate(ring(50.0).write(folder() / "job"));
    ASSERT_TRUE(record.is_object());
    EXPECT_NEAR(record["rotary"]["stations"][2]["position_mm"][0].get<double>(), 1000.0, 1e-4);
}

TEST_F(CampaignRun, HomeDatumHasNoErrorAtTheHomeAngle) {
    const fs::path job = copy_of_example(folder() / "job");
    change_json(job, [](json& document) { document["datum"] = "home"; });
    const std::string output = (folder() / "out").string();
    const bool with_documents = why_no_pdf().empty();
    const Ended ended =
        with_documents ? run(job, output) : gumcert({"evaluate", job.string(), "-o", output + "/record.json"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const json record = json::parse(bytes_of(folder() / "out" / "record.json"));
    EXPECT_EQ(record["rotary"]["datum"], "home");
    EXPECT_EQ(record["rotary"]["home_angle_deg"], 0);
    for (const json& row : record["rotary"]["errors"]) {
        for (const std::string& name : k_error_motions) {
            const json& motion = row[name];
            if (row["angle_deg"] == 0) {
                EXPECT_EQ(motion["value"].get<double>(), 0.0) << name;
                EXPECT_EQ(motion["u"].get<double>(), 0.0) << name;
                EXPECT_EQ(motion["U"].get<double>(), 0.0) << name;
                EXPECT_EQ(motion["printed"]["value"], "0") << name;
                EXPECT_EQ(motion["printed"]["U"], "") << name;
            } else {
                EXPECT_GT(motion["U"].get<double>(), 0.0) << name << row["angle_deg"];
                EXPECT_NE(motion["printed"]["U"], "") << name << row["angle_deg"];
            }
        }
    }
    if (!with_documents) {
        GTEST_SKIP() << why_no_pdf() << ": the certificate was not made";
    }
}

TEST_F(CampaignRun, SequentialMethodEvaluatesTheExample) {
    const fs::path job = copy_of_example(folder() / "job");
    change_json(job, [](json& document) { document["method"] = "sequential"; });
    const std::string output = (folder() / "out").string();
    const bool with_documents = why_no_pdf().empty();
    const Ended ended =
        with_documents ? run(job, output) : gumcert({"evaluate", job.string(), "-o", output + "/record.json"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const json record = json::parse(bytes_of(folder() / "out" / "record.json"));
    const json& rotary = record["rotary"];
    EXPECT_EQ(rotary["method"], "sequential");
    EXPECT_EQ(rotary["adjustment"]["method"], "sequential");
    EXPECT_EQ(rotary["errors"].size(), 36U);
    EXPECT_EQ(rotary["adjustment"]["degrees_of_freedom"].get<int>(),
              rotary["adjustment"]["observations"].get<int>() - rotary["adjustment"]["parameters"].get<int>());
    // Two ways to one table: they agree within their uncertainties.
    const json joint = evaluate(copy_of_example(folder() / "joint"));
    ASSERT_TRUE(joint.is_object());
    for (const auto& [name, result] : record["results"].items()) {
        const json& other = joint["results"][name];
        EXPECT_NEAR(result["value"].get<double>(), other["value"].get<double>(),
                    result["U"].get<double>() + other["U"].get<double>())
            << name;
    }
    for (const json& row : rotary["budget"]) {
        double total = 0.0;
        for (const json& share : row["shares"]) {
            total += share.get<double>();
        }
        EXPECT_NEAR(total, 1.0, 1e-9) << row["quantity"];
    }
    if (!with_documents) {
        GTEST_SKIP() << why_no_pdf() << ": the certificate was not made";
    }
}

}  // namespace
}  // namespace gumcert::cli
