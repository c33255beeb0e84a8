// The same job gives the same bytes, whatever the threads, the locale, the time zone and the folder of work.
#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class Determinism : public ProgramTest {
protected:
    void SetUp() override { (void)copy_of_example(folder() / "job"); }

    /// Runs the example.
    /// \return every document with its name
    std::map<std::string, std::string> documents(const std::vector<std::string>& options,
                                                 std::map<std::string, std::string> environment) const {
        const bool all = why_no_pdf().empty();
        std::vector<std::string> arguments =
            all ? std::vector<std::string>{"run", "job.json", "-o", "out", "--share", GUMCERT_SOURCE_DIR}
                : std::vector<std::string>{"evaluate", "job.json", "-o", "out/record.json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Ended ended =
            gumcert(arguments, {.working_folder = folder() / "job", .environment = std::move(environment), .out = {}});
        EXPECT_EQ(ended.code, 0) << ended.err;
        std::map<std::string, std::string> result = contents_of(folder() / "job" / "out");
        result["(messages)"] = ended.err;
        result["(summary)"] = ended.out;
        EXPECT_EQ(result.size(), all ? 9U : 5U) << "with the manifest";
        fs::remove_all(folder() / "job" / "out");
        return result;
    }
};

TEST_F(Determinism, ThreadsLocaleAndTimeZoneChangeNoByte) {
    const auto first = documents({"--threads", "1"}, {});
    const std::map<std::string, std::map<std::string, std::string>> others{
        {"1", {}},
        {"2",
         {{"LC_ALL", "de_DE.UTF-8"},
          {"LANG", "de_DE.UTF-8"},
          {"TZ", "Pacific/Chatham"},
          {"OMP_NUM_THREADS", "2"},
          {"HOME", folder().string()}}},
        {"4", {{"LC_ALL", "C"}, {"TZ", "America/St_Johns"}, {"OMP_NUM_THREADS", "1"}, {"OPENBLAS_NUM_THREADS", "1"}}}};
    for (const auto& [threads, environment] : others) {
        const auto other = documents({"--threads", threads}, environment);
        for (const auto& [name, bytes] : first) {
            EXPECT_TRUE(other.contains(name) && other.at(name) == bytes) << name << " with --threads " << threads;
        }
    }
}

/// The lengths of paths decide where the heap puts what; no rounding may depend on that.
TEST_F(Determinism, FolderAndItsNameChangeNoByte) {
    ASSERT_EQ(ExampleRun::shared().ended().code, 0) << ExampleRun::shared().ended().err;
    const auto first = contents_of(ExampleRun::shared().folder());
    const fs::path out = folder() / "out";
    const auto expect_first = [&](const std::string& job, const fs::path& working_folder) {
        const Ended ended =
            gumcert(why_no_pdf().empty()
                        ? std::vector<std::string>{"run", job, "-o", out.string(), "--share", GUMCERT_SOURCE_DIR}
                        : std::vector<std::string>{"evaluate", job, "-o", (out / "record.json").string()},
                    {.working_folder = working_folder, .environment = {}, .out = {}});
        ASSERT_EQ(ended.code, 0) << ended.err;
        const auto other = contents_of(out);
        EXPECT_EQ(other.size(), first.size());
        for (const auto& [name, bytes] : first) {
            EXPECT_TRUE(other.contains(name) && other.at(name) == bytes) << name << ", " << job;
        }
        fs::remove_all(out);
    };
    expect_first((shipped_example() / "job.json").string(), {});
    expect_first("job.json", folder() / "job");
    const fs::path long_name = folder() / ("a folder with spaces, ü, and " + std::string(120, 'n'));
    (void)copy_of_example(long_name);
    expect_first((long_name / "job.json").string(), {});
}

/// Monte Carlo of a rotary table, and both studies: random numbers go by trial and by campaign, not by thread.
TEST_F(Determinism, TrialsAndStudiesOfARotaryTable) {
    const fs::path job = folder() / "job" / "drawn.json";
    nlohmann::json document = nlohmann::json::parse(bytes_of(folder() / "job" / "job.json"));
    document.erase("reference_method");
    document["fixture"]["budget"] = "fixture_budget.json";
    document["length_uncertainty"]["resolution_um"] = 0.01;
    document["monte_carlo"] = {{"trials", 2201}, {"seed", 5}, {"validate", true}};  // no multiple of any block
    document["simulation"] = {{"runs", 3}, {"angle_counts", {6}}};
    document["plan"] = {
        {"angles_deg", {{"first", 0}, {"step", 60}, {"count", 6}}},
        {"senses", "both"},
        {"station_region", {{"x_mm", {400, 1300}}, {"y_mm", {-800, 800}}, {"z_mm", {-600, 600}}, {"step_mm", 600}}}};
    write_bytes(job, document.dump(1));
    std::string lengths;
    for (const std::string& line : lines_of(bytes_of(folder() / "job" / "lengths.csv"))) {
        static const std::regex multiple_of_60("(?:[^,]*,){4}(0|60|120|180|240|300)\\.0+,.*");
        if (lengths.empty() || std::regex_match(line, multiple_of_60)) {
            lengths += line + "\n";
        }
    }
    write_bytes(folder() / "job" / "lengths.csv", lengths);

    const auto written = [&](const std::string& threads, const std::map<std::string, std::string>& environment) {
        for (const char* const command : {"evaluate", "simulate", "plan"}) {
            const Ended ended =
                gumcert({command, "drawn.json", "-o", std::string("out/") + command + ".json", "--threads", threads},
                        {.working_folder = folder() / "job", .environment = environment, .out = {}});
            // 2201 trials decide for few quantities: validation was demanded, and is not there.
            EXPECT_EQ(ended.code, std::string(command) == "evaluate" ? 1 : 0) << ended.err;
        }
        const std::map<std::string, std::string> result = contents_of(folder() / "job" / "out");
        fs::remove_all(folder() / "job" / "out");
        return result;
    };
    const auto first = written("1", {});
    EXPECT_EQ(first.size(), 5U) << "record, covariance, simulation, plan";
    const std::vector<std::pair<std::string, std::map<std::string, std::string>>> others{
        {"2", {{"LC_ALL", "de_DE.UTF-8"}, {"TZ", "Pacific/Chatham"}, {"OMP_NUM_THREADS", "2"}}},
        {"3", {{"LC_ALL", "C"}, {"OMP_NUM_THREADS", "1"}}},
        {"1", {}}};
    for (const auto& [threads, environment] : others) {
        const auto other = written(threads, environment);
        for (const auto& [name, bytes] : first) {
            EXPECT_TRUE(other.contains(name) && other.at(name) == bytes) << name << " with --threads " << threads;
        }
    }
}

}  // namespace
}  // namespace gumcert::cli
