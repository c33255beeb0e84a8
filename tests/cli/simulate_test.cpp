// gumcert simulate: a study as text and as data.
#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Simulate : public ProgramTest {
protected:
    /// The shipped example with a few angles and runs.
    /// \return its job file
    [[nodiscard]] fs::path small_job(const std::string& angle_counts = "[6, 8]") const {
        (void)copy_of_example(folder() / "job");
        const fs::path job = folder() / "job" / "simulation.json";
        replace_in(job, "\"angle_counts\": [12, 36, 360]", "\"angle_counts\": " + angle_counts);
        return job;
    }

    [[nodiscard]] nlohmann::json data(const std::vector<std::string>& options,
                                      const std::string& angle_counts = "[6, 8]") const {
        const fs::path output = folder() / "study.json";
        std::vector<std::string> arguments{"simulate", small_job(angle_counts).string(), "-o", output.string()};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Ended ended = gumcert(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return nlohmann::json::parse(bytes_of(output));
    }
};

TEST_F(Simulate, WritesWhatWasFoundAsData) {
    const nlohmann::json study = data({"--runs", "4", "--seed", "7"});
    EXPECT_EQ(study["schema"], "gumcert/simulation/1");
    EXPECT_EQ(study["runs"], 4);
    EXPECT_EQ(study["seed"], 7);
    EXPECT_DOUBLE_EQ(study["source_paper"]["set_up_offset"].get<double>(), 0.045);
    ASSERT_EQ(study["studies"].size(), 2U);
    const nlohmann::json& eight = study["studies"][1];
    EXPECT_EQ(eight["angles"], 8);
    EXPECT_EQ(eight["with_noise"]["estimators"].size(), 4U);
    EXPECT_EQ(eight["with_noise"]["estimators"][0]["method"], "joint");
    EXPECT_EQ(eight["with_noise"]["estimators"][0]["datum"], "axis_average_line");
    EXPECT_EQ(eight["with_noise"]["estimators"][0]["campaigns"], 4);
    EXPECT_EQ(eight["with_noise"]["estimators"][0]["quantities"][0]["name"], "EXA");
    EXPECT_EQ(eight["with_noise"]["outliers"]["planted"], 12);
    // Without noise the joint adjustment gives the assumed values in its datum: nothing is left but the datum part.
    const nlohmann::json& exact = eight["without_noise"]["estimators"][0]["quantities"][6];
    EXPECT_EQ(exact["name"], "Oy");
    EXPECT_LT(exact["measurement_part_rms"].get<double>(), 1e-11);
    EXPECT_NEAR(exact["difference"]["rms"].get<double>(), exact["datum_part_rms"].get<double>(), 1e-11);
    EXPECT_GT(exact["datum_part_rms"].get<double>(), 1e-7);
    EXPECT_EQ(eight["adjusted_campaigns"], 4);
    EXPECT_TRUE(eight["sequential_method"].get<bool>());
}

// 130 angles: ten campaigns at least are adjusted, the sequential method is left out. 730: the datum alone.
TEST_F(Simulate, LeavesOutWhatTakesTooLongAndSaysSo) {
    const nlohmann::json study = data({"--runs", "1"}, "[130, 730]");
    const nlohmann::json& many = study["studies"][0];
    EXPECT_EQ(many["adjusted_campaigns"], 1);
    EXPECT_FALSE(many["sequential_method"].get<bool>());
    const nlohmann::json& estimators = many["with_noise"]["estimators"];
    EXPECT_EQ(estimators[0]["campaigns"], 1);
    EXPECT_EQ(estimators[2]["campaigns"], 0);
    EXPECT_TRUE(estimators[2]["first_failure"].is_null());
    EXPECT_NEAR(estimators[0]["agreement"]["normalised_rms"].get<double>(), 1.0, 0.3);
    const nlohmann::json& exact = many["without_noise"]["estimators"][1]["quantities"][6];
    EXPECT_LT(exact["measurement_part_rms"].get<double>(), 1e-11);
    const nlohmann::json& too_many = study["studies"][1];
    EXPECT_EQ(too_many["adjusted_campaigns"], 0);
    EXPECT_TRUE(too_many["with_noise"].is_null());
    EXPECT_EQ(too_many["datum_only"].size(), 2U);

    const Ended ended = gumcert({"simulate", small_job("[730]").string(), "--runs", "1"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("730 angles: not adjusted"), std::string::npos);
}

TEST_F(Simulate, SameBytesForAnyNumberOfThreadsAndOthersForAnotherSeed) {
    const nlohmann::json one = data({"--runs", "3", "--threads", "1"});
    EXPECT_EQ(one.dump(), data({"--runs", "3", "--threads", "2"}).dump());
    EXPECT_EQ(one.dump(), data({"--runs", "3", "--threads", "5"}).dump());
    EXPECT_NE(one["studies"].dump(), data({"--runs", "3", "--seed", "2"})["studies"].dump());
}

TEST_F(Simulate, TellsPeopleWhatThePercentagesMeasure) {
    const Ended ended = gumcert({"simulate", small_job().string(), "--runs", "3"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    for (const char* text : {"source paper", "4.50", "4.35", "3.25", "2.30", "axis average line", "datum",
                             "What the figures of the source paper can mean", "definition of the figure"}) {
        EXPECT_NE(ended.out.find(text), std::string::npos) << text;
    }
}

// A job with measured lengths and without anything said of a simulation: its own angles, the table as it was found.
TEST_F(Simulate, TakesTheLayoutOfMeasuredLengths) {
    const fs::path job = copy_of_example(folder() / "job");
    const fs::path output = folder() / "study.json";
    const Ended ended = gumcert({"simulate", job.string(), "--runs", "2", "-o", output.string()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    const nlohmann::json study = nlohmann::json::parse(bytes_of(output));
    ASSERT_EQ(study["studies"].size(), 1U);
    EXPECT_EQ(study["studies"][0]["angles"], 36);
    EXPECT_EQ(study["studies"][0]["lengths"], 2592);
    EXPECT_GT(study["assumed"]["table_u_linear"].get<double>(), 5e-8);
    EXPECT_LT(study["assumed"]["table_u_linear"].get<double>(), 5e-7);
}

TEST_F(Simulate, RefusesAnotherKindOfJob) {
    const fs::path budget = fs::path(GUMCERT_SOURCE_DIR) / "examples" / "end_gauge" / "job.json";
    const Ended ended = gumcert({"simulate", budget.string()});
    EXPECT_EQ(ended.code, 3) << ended.err;
    EXPECT_TRUE(ended.out.empty());
}

}  // namespace
}  // namespace gumcert::cli
