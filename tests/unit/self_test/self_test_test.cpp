#include "self_test/self_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "self_test/self_test_document.h"

namespace gumcert::self_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path k_root(GUMCERT_SOURCE_DIR);

std::vector<fs::path> some_files() {
    std::vector<fs::path> files;
    for (const char* name :
         {"gum-522-series-resistors-uncorrelated", "iso11929-4-ex6", "jcgm106-oil", "strd-uni-numacc1"}) {
        files.push_back(k_root / "tests" / "reference" / "cases" / (std::string(name) + ".json"));
    }
    return files;
}

SelfTest some_test(unsigned threads, std::vector<std::string>* told = nullptr) {
    SelfTest test = run_self_test(some_files(), threads, k_root / "templates", [told](const CaseOutcome& outcome) {
        if (told != nullptr) {
            told->push_back(outcome.reference.id);
        }
    });
    test.system = {.date = "2026-11-24T18:55:00Z",
                   .name = "gumcert",
                   .version = "0.1.0",
                   .commit = "0123456789ab",
                   .compiler = "GNU",
                   .executable_sha256 = std::string(64, 'a'),
                   .processor = "a processor",
                   .operating_system = "a system",
                   .libraries = {{"libc", "2.36", std::string(64, 'b')}, {"Eigen3", "3.4.0", ""}},
                   .templates_sha256 = std::string(64, 'c')};
    return test;
}

TEST(SelfTestRun, ToldInOrderWithTheSameBytesForAnyNumberOfThreads) {
    std::vector<std::string> told;
    const SelfTest two = some_test(2, &told);
    EXPECT_EQ(told, (std::vector<std::string>{"gum-522-series-resistors-uncorrelated", "iso11929-4-ex6", "jcgm106-oil",
                                              "strd-uni-numacc1"}));
    EXPECT_EQ(two.passed(), 4U);
    EXPECT_EQ(two.agreed(), two.compared());
    EXPECT_EQ(self_test_json(two), self_test_json(some_test(1)));
}

TEST(SelfTestRun, TheReportStatesTheDigestOfItself) {
    const std::string text = self_test_json(some_test(2));
    json report = json::parse(text);
    EXPECT_EQ(report["schema"], "gumcert/self-test/1");
    EXPECT_EQ(report["passes"], true);
    EXPECT_EQ(report["cases"].size(), 4U);
    EXPECT_EQ(report["cases"][0]["values"][0]["agrees"], true);
    EXPECT_EQ(report["cases"][2]["place_seen"], false);
    const std::string digest = digest_of_self_test(text);
    const std::size_t begin = text.find("\n \"digest\": {");
    const std::string member = text.substr(begin, text.find("},", begin) + 2 - begin);
    EXPECT_EQ(encoding::sha256(std::string(text).erase(begin, member.size())), digest);
}

TEST(SelfTestRun, ASpoiledCaseIsCountedAndACaseThatIsNoneAsWell) {
    const fs::path folder = fs::path(testing::TempDir()) / "gumcert_self_test_cases";
    fs::create_directories(folder);
    std::ofstream(folder / "broken.json") << "{";
    std::ofstream(folder / "notes.txt") << "no case";
    const std::vector<fs::path> files = case_files(folder);
    ASSERT_EQ(files.size(), 1U);
    const SelfTest test = run_self_test(files, 1, k_root / "templates");
    EXPECT_EQ(test.passed(), 0U);
    EXPECT_EQ(test.cases[0].reference.id, "broken");
    EXPECT_NE(test.cases[0].refused.find("GC-SELF-0002"), std::string::npos);
    const json report = json::parse(self_test_json(test));
    EXPECT_EQ(report["passes"], false);
    fs::remove_all(folder);
    EXPECT_THROW((void)case_files(folder), gum::StorageError);
}

TEST(SelfTestPage, SaysInEveryLanguageWhatTheJsonSays) {
    const SelfTest test = some_test(2);
    const std::string digest = digest_of_self_test(self_test_json(test));
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        reports::RenderAssets assets;
        assets.templates = k_root / "templates";
        assets.languages = {language};
        const std::string page = self_test_html(test, digest, assets);
        for (const CaseOutcome& outcome : test.cases) {
            EXPECT_NE(page.find(outcome.reference.id), std::string::npos) << language;
            EXPECT_NE(page.find(outcome.reference.document), std::string::npos) << language;
        }
        for (const std::string& wanted :
             {digest, test.cases_sha256, test.system.executable_sha256, std::string("2.36")}) {
            EXPECT_NE(page.find(wanted), std::string::npos) << language << ": " << wanted;
        }
    }
}

TEST(SelfTestPage, AFailureStandsAtTheTop) {
    SelfTest test = some_test(2);
    test.cases[1].values[0].agrees = false;
    test.cases[1].values[0].because = "12, expected 13";
    reports::RenderAssets assets;
    assets.templates = k_root / "templates";
    assets.languages = {"en"};
    const std::string page = self_test_html(test, "0", assets);
    EXPECT_NE(page.find("FAILED – 1 of 4 published cases"), std::string::npos);
    EXPECT_NE(page.find("12, expected 13"), std::string::npos);
    EXPECT_EQ(self_test_html(some_test(1), "0", assets).find("12, expected 13"), std::string::npos);
}

}  // namespace
}  // namespace gumcert::self_test
