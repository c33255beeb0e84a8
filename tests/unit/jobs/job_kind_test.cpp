#include "jobs/job_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "jobs/file_source.h"
#include "tests/support/file_content.h"

namespace gumcert::jobs {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

MemoryFileSource job_of_kind(const std::string& kind) {
    return MemoryFileSource({{"job.json", R"({"schema": "gumcert/job/1", "kind": ")" + kind + "\"}"}});
}

TEST(JobKinds, IsOneOfTheWordsThatTheSchemaAllows) {
    const auto schema = nlohmann::json::parse(
        gumcert::test::file_content(std::filesystem::path(GUMCERT_SOURCE_DIR) / "schemas/job-1.schema.json"));
    EXPECT_THAT(schema["properties"]["kind"]["enum"].get<std::vector<std::string>>(), ElementsAreArray(k_job_kinds));
    for (const std::string_view kind : k_job_kinds) {
        EXPECT_EQ(job_kind(job_of_kind(std::string(kind)), "job.json"), kind);
    }
}

TEST(JobKinds, OfAnotherWordIsRefusedWithTheWordsThatThereAre) {
    try {
        (void)job_kind(job_of_kind("budgets"), "job.json");
        FAIL() << "not refused";
    } catch (const gum::InputError& refused) {
        const gum::Diagnostic& told = refused.diagnostics().front();
        EXPECT_EQ(told.code, "GC-INPUT-0028");
        EXPECT_EQ(told.rule, "must be budget, rotary_table, circle_closure or comparison");
        EXPECT_THAT(told.action, HasSubstr("\"budget\""));
    }
}

TEST(JobKinds, MayBeAWordOfWhoAsks) {
    constexpr std::array<std::string_view, 2> k_words{"toy", "budget"};
    EXPECT_EQ(job_kind(job_of_kind("toy"), "job.json", k_words), "toy");
    EXPECT_THROW((void)job_kind(job_of_kind("comparison"), "job.json", k_words), gum::InputError);
    // The text has faults, and the word is seen all the same.
    const std::string half = R"({"schema": "gumcert/job/1", "kind": "toy", )";
    const MemoryFileSource broken({{"job.json", half}});
    EXPECT_EQ(probable_job_kind(broken, "job.json", k_words), "toy");
}

/// Other files of the program are told by what they are and by the command that reads them: no list of their keys.
TEST(JobKinds, OfAFileThatIsNoJobSaysWhatItIs) {
    const std::vector<std::pair<std::string, std::string>> files{
        {R"({"schema": "gumcert/record/1", "kind": "budget"})", "use gumcert render, check or rerun"},
        {R"({"laboratory": {"name": "L"}, "customer": {}, "persons": {}})", "name it in a job"},
        {R"({"schema": "gumcert/standard/1"})", "--laboratory"},
        {"%PDF-1.7", "gumcert verify"},
        {"<dcc:digitalCalibrationCertificate/>", "gumcert check dcc"}};
    for (const auto& [bytes, action] : files) {
        try {
            require_job_file(MemoryFileSource(std::map<std::string, std::string>{{"file", bytes}}), "file");
            FAIL() << "not refused: " << bytes;
        } catch (const gum::InputError& refused) {
            ASSERT_EQ(refused.diagnostics().size(), 1U) << bytes;
            EXPECT_EQ(refused.diagnostics().front().code, "GC-INPUT-0027") << bytes;
            EXPECT_THAT(refused.diagnostics().front().action, HasSubstr(action)) << bytes;
        }
    }
    for (const char* job : {R"({"kind": "budget"})", R"({"schema": "gumcert/job/2"})", "{}"}) {
        EXPECT_NO_THROW(require_job_file(MemoryFileSource(std::map<std::string, std::string>{{"file", job}}), "file"))
            << job;
    }
}

/// The record holds the names of its files, and its texts are UTF-8: told before anything is evaluated.
TEST(JobKinds, OfAFileWhoseNameIsNotUtf8IsRefused) {
    const std::string job = R"({"schema": "gumcert/job/1", "kind": "budget"})";
    for (const std::string name : {"x\xff.json", "\xe4.json", "\xc3"}) {
        try {
            require_job_file(MemoryFileSource(std::map<std::string, std::string>{{name, job}}), name);
            FAIL() << "not refused";
        } catch (const gum::InputError& refused) {
            ASSERT_EQ(refused.diagnostics().size(), 1U);
            EXPECT_EQ(refused.diagnostics().front().code, "GC-INPUT-0002");
            EXPECT_THAT(refused.diagnostics().front().where, HasSubstr("\\x{"));
        }
    }
    for (const std::string name : {"\u00e4.json", "\u8f49\u53f0.json", "a b.json"}) {
        EXPECT_NO_THROW(require_job_file(MemoryFileSource(std::map<std::string, std::string>{{name, job}}), name));
    }
}

}  // namespace
}  // namespace gumcert::jobs
