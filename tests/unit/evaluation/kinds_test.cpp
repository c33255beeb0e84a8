#include "evaluation/kinds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluation/evaluate_job.h"
#include "issuing/issue_documents.h"
#include "jobs/job_kind.h"
#include "reports/record/record_kinds.h"
#include "reports/view/document_kinds.h"
#include "tests/support/file_content.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::UnorderedElementsAreArray;

nlohmann::json json_of(const std::string& file) {
    return nlohmann::json::parse(test::file_content(fs::path(GUMCERT_SOURCE_DIR) / file));
}

TEST(Kinds, HaveOneRowInEachLayer) {
    const std::vector<std::string_view> words = words_of(program_kinds());
    EXPECT_THAT(words, ElementsAre("budget", "rotary_table", "circle_closure", "comparison"));
    EXPECT_THAT(jobs::k_job_kinds, ElementsAreArray(words));
    EXPECT_THAT(reports::k_record_kinds, ElementsAreArray(words));
    std::vector<std::string_view> of_documents;
    for (const reports::DocumentKind& kind : reports::document_kinds()) {
        of_documents.push_back(kind.word);
    }
    EXPECT_THAT(of_documents, ElementsAreArray(words));
}

TEST(Kinds, AreThoseOfTheSchemasAndOfEveryLanguage) {
    const std::vector<std::string_view> words = words_of(program_kinds());
    for (const char* schema : {"schemas/job-1.schema.json", "schemas/record-1.schema.json"}) {
        EXPECT_THAT(json_of(schema)["properties"]["kind"]["enum"].get<std::vector<std::string>>(),
                    ElementsAreArray(words))
            << schema;
    }
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        std::vector<std::string> named;
        const nlohmann::json wording = json_of("templates/wording/" + std::string(language) + ".json");
        for (const auto& [word, name] : wording["value"]["kind"].items()) {
            named.push_back(word);
        }
        EXPECT_THAT(named, UnorderedElementsAreArray(words)) << language;
    }
}

TEST(Kinds, HaveADocumentEach) {
    for (const std::string_view word : words_of(program_kinds())) {
        EXPECT_TRUE(fs::exists(fs::path(GUMCERT_SOURCE_DIR) / "docs" / (std::string(word) + "_job.md"))) << word;
    }
}

TEST(Kinds, AreFoundByTheirWord) {
    for (const Kind& kind : program_kinds()) {
        EXPECT_EQ(find_kind(program_kinds(), kind.word), &kind);
    }
    EXPECT_EQ(find_kind(program_kinds(), "toy"), nullptr);
    EXPECT_EQ(find_kind(program_kinds(), ""), nullptr);
    reports::EvaluationRecord record;
    record.kind = "comparison";
    EXPECT_EQ(kind_of(record, program_kinds()).document, "comparison");
    record.kind = "toy";
    EXPECT_EQ(kind_of(record, program_kinds()).word, "budget");
}

TEST(Kinds, SayWhichDocumentsARunWrites) {
    EXPECT_THAT(issuing::document_names(*find_kind(program_kinds(), "budget")),
                ElementsAre("certificate.html", "certificate.pdf", "certificate.xml"));
    EXPECT_THAT(issuing::document_names(*find_kind(program_kinds(), "comparison")),
                ElementsAre("comparison.html", "comparison.pdf", "comparison.csv"));
}

TEST(Kinds, ReadTheirJobsAndRefuseThoseOfOthers) {
    const jobs::DiskFileSource folder(fs::path(GUMCERT_SOURCE_DIR) / "examples/end_gauge");
    for (const Kind& kind : program_kinds()) {
        if (kind.word == jobs::k_budget_kind) {
            EXPECT_NO_THROW((void)kind.read(folder, "job.json"));
        } else {
            EXPECT_THROW((void)kind.read(folder, "job.json"), gum::InputError) << kind.word;
        }
    }
}

TEST(Kinds, EvaluateToARecordOfTheirWord) {
    const fs::path examples = fs::path(GUMCERT_SOURCE_DIR) / "examples";
    for (const auto& [job, word] :
         {std::pair("end_gauge/job.json", "budget"), std::pair("comparison/key_comparison.json", "comparison")}) {
        EXPECT_EQ(evaluate_job(examples / job, CovarianceFile::none, 1, fs::path(GUMCERT_SOURCE_DIR) / "templates")
                      .record.kind,
                  word);
    }
}

}  // namespace
}  // namespace gumcert::evaluation
