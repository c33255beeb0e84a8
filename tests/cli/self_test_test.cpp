// gumcert self-test and gumcert rerun: evidence that the laboratory makes with the program as it is installed.
#include <algorithm>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

constexpr const char* k_case = "gum-522-series-resistors-uncorrelated";

class Evidence : public ProgramTest {
protected:
    [[nodiscard]] fs::path share() const { return folder() / "share"; }

    /// A share folder with these cases, and no program that sets PDF.
    void make_share(const std::vector<std::string>& cases) const {
        fs::create_directories(share() / "reference_cases");
        fs::create_directory_symlink(fs::path(GUMCERT_SOURCE_DIR) / "templates", share() / "templates");
        for (const std::string& name : cases) {
            fs::copy_file(fs::path(GUMCERT_SOURCE_DIR) / "tests" / "reference" / "cases" / (name + ".json"),
                          share() / "reference_cases" / (name + ".json"));
        }
    }
    [[nodiscard]] Ended self_test(std::vector<std::string> more = {}) const {
        std::vector<std::string> words{"self-test", "--share", share().string(), "-o", (folder() / "out").string()};
        words.insert(words.end(), more.begin(), more.end());
        return gumcert(words);
    }
    [[nodiscard]] json report() const { return json::parse(bytes_of(folder() / "out" / "self-test.json")); }
};

TEST_F(Evidence, TwoTestsDifferInTheDateAlone) {
    make_share({k_case, "iso11929-4-ex6"});
    ASSERT_EQ(self_test().code, 0);
    json first = report();
    EXPECT_EQ(first["passes"], true);
    EXPECT_EQ(first["software"]["version"], "0.1.0");
    EXPECT_EQ(first["reference_cases"]["of_this_release"], false);
    EXPECT_EQ(first["templates"]["of_this_release"], true);
    EXPECT_GT(first["libraries"].size(), 10U);
    ASSERT_EQ(self_test({"--threads", "1"}).code, 0);
    json second = report();
    for (json* one : {&first, &second}) {
        EXPECT_TRUE(std::regex_match((*one)["date"].get<std::string>(),
                                     std::regex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z")));
        one->erase("date");
        one->erase("digest");
    }
    EXPECT_EQ(first, second);
}

TEST_F(Evidence, TheDigestStandsOnThePage) {
    make_share({k_case});
    const Ended ended = self_test({"--language", "de"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const std::string digest = report()["digest"]["value"];
    EXPECT_NE(ended.out.find("SHA-256 of the report: " + digest), std::string::npos) << ended.out;
    const std::string page = bytes_of(folder() / "out" / "self-test.html");
    EXPECT_NE(page.find(digest), std::string::npos);
    EXPECT_NE(page.find("Bericht über den Selbsttest"), std::string::npos);
}

TEST_F(Evidence, WithoutThePdfProgramTheOtherFormsAreWrittenAndItIsSaid) {
    make_share({k_case});
    fs::create_directory(folder() / "share" / "node_modules");  // without any, that of the program is used
    const Ended ended = self_test();
    EXPECT_EQ(ended.code, 0);
    EXPECT_NE(ended.err.find("[GC-SELF-0004]"), std::string::npos) << ended.err;
    EXPECT_TRUE(fs::exists(folder() / "out" / "self-test.html"));
    EXPECT_FALSE(fs::exists(folder() / "out" / "self-test.pdf"));
}

TEST_F(Evidence, AChangedDigitFailsAndNamesTheCase) {
    make_share({k_case, "iso11929-4-ex6"});
    const fs::path file = share() / "reference_cases" / (std::string(k_case) + ".json");
    json reference = json::parse(bytes_of(file));
    json& value = reference["expected"][0];
    const char* const key = value.contains("printed") ? "printed" : "computed";
    value[key] = "7" + (value[key].is_string() ? value[key].get<std::string>() : value[key].dump());
    write_bytes(file, reference.dump());
    const Ended ended = self_test({"--json-messages"});
    EXPECT_EQ(ended.code, 1);
    EXPECT_NE(ended.out.find(std::string("FAIL  ") + k_case), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("1 of 2 cases pass"), std::string::npos) << ended.out;
    const std::vector<Message> messages = json_messages(ended);
    EXPECT_TRUE(std::any_of(messages.begin(), messages.end(), [](const Message& message) {
        return message.code == "GC-SELF-0003" && message.where == k_case;
    }));
    EXPECT_EQ(report()["passes"], false);
    EXPECT_NE(bytes_of(folder() / "out" / "self-test.html").find("FAILED – 1 of 2"), std::string::npos);
}

TEST_F(Evidence, ACaseThatIsRefusedIsAFailureAndNoCrash) {
    make_share({k_case});
    const fs::path file = share() / "reference_cases" / (std::string(k_case) + ".json");
    json reference = json::parse(bytes_of(file));
    reference["jobs"]["law"]["model"] = json::array({"Rref ="});
    write_bytes(file, reference.dump());
    write_bytes(share() / "reference_cases" / "torn.json", bytes_of(file).substr(0, 99));
    const Ended ended = self_test();
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_NE(ended.out.find("0 of 2 cases pass"), std::string::npos) << ended.out;
}

TEST_F(Evidence, OneCaseIsShownWithItsValuesAndWritesNothing) {
    const Ended ended = gumcert({"self-test", "--share", GUMCERT_SOURCE_DIR, "--case", "gum-h1-end-gauge"},
                                {.working_folder = folder()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("l contribution [ls]: 25, printed 25, 2 of 2 digits"), std::string::npos) << ended.out;
    EXPECT_TRUE(fs::is_empty(folder()));
    EXPECT_EQ(gumcert({"self-test", "--share", GUMCERT_SOURCE_DIR, "--case", "none"}).code, 2);
}

TEST_F(Evidence, AFolderWithoutCasesAndAnOutputAmongThemAreRefused) {
    make_share({});
    EXPECT_EQ(self_test().code, 5);
    write_bytes(share() / "reference_cases" / "case.json", "{}");
    const std::string into = (share() / "reference_cases").string();
    const Ended ended = gumcert({"self-test", "--share", share().string(), "-o", into});
    EXPECT_EQ(ended.code, 5) << ended.err;
    EXPECT_FALSE(fs::exists(share() / "reference_cases" / "self-test.json"));
}

TEST_F(Evidence, TheReportIsASetAndAnInterruptedOneIsSeenBeforeTheTest) {
    make_share({k_case});
    ASSERT_EQ(self_test().code, 0);
    const fs::path out = folder() / "out";
    EXPECT_EQ(gumcert({"check", out.string()}).code, 0);
    const std::string manifest = bytes_of(out / ".gumcert-set.json");
    EXPECT_NE(manifest.find("self-test.html"), std::string::npos) << manifest;
    write_bytes(out / ".gumcert-unfinished.json", "torn");
    const std::map<std::string, std::string> before = contents_of(out);
    const Ended refused = self_test();
    EXPECT_EQ(refused.code, 5);
    EXPECT_NE(refused.err.find("[GC-STORE-0013]"), std::string::npos) << refused.err;
    EXPECT_EQ(refused.out, "") << "no case is computed for nothing";
    EXPECT_EQ(contents_of(out), before);
}

TEST_F(Evidence, RerunOfRecordsEndsWithTheGravestAnswer) {
    const fs::path record = folder() / "record.json";
    const fs::path job = fs::path(GUMCERT_SOURCE_DIR) / "examples" / "certificate" / "end_gauge.json";
    ASSERT_EQ(gumcert({"evaluate", job.string(), "-o", record.string(), "--share", GUMCERT_SOURCE_DIR, "-q"}).code, 0);
    const auto rerun = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"rerun", "--share", GUMCERT_SOURCE_DIR});
        return gumcert(words);
    };
    const Ended same = rerun({record.string()});
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_NE(same.out.find("the same in every number, printed digit and verdict"), std::string::npos) << same.out;

    json old = json::parse(bytes_of(record));
    old.erase("digest");
    old["software"]["version"] = "0.0.7";
    old["results"]["l"]["printed"]["U"] = "66";
    const fs::path changed = folder() / "changed.json";
    write_bytes(changed, old.dump());
    const Ended told = rerun({record.string(), changed.string()});
    EXPECT_EQ(told.code, 1) << told.err;
    EXPECT_NE(told.out.find("printed  /results/l/printed/U  66 → 67"), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("made by gumcert 0.0.7"), std::string::npos) << told.out;

    const fs::path damaged = folder() / "damaged.json";
    write_bytes(damaged, bytes_of(record).substr(0, 2000));
    const Ended refused = rerun({damaged.string(), changed.string(), "--format", "json"});
    EXPECT_EQ(refused.code, 3);
    EXPECT_EQ(json::parse(refused.out)["records"].size(), 1U);
    const Ended none = rerun({(folder() / "none.json").string()});
    EXPECT_EQ(none.code, 5);
    EXPECT_NE(none.out.find("1 record named; evaluated with version"), std::string::npos) << none.out;
}

}  // namespace
}  // namespace gumcert::cli
