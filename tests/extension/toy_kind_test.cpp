#include "tests/extension/toy_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "evaluation/evaluate_job.h"
#include "evaluation/recompute_record.h"
#include "issuing/issue_documents.h"
#include "reports/record/record_kinds.h"
#include "tests/support/file_content.h"

// A kind is added without a change of the program: docs/extending.md.

namespace gumcert::toy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* k_job =
    R"({"schema": "gumcert/job/1", "kind": "toy", "title": "Five readings", "readings_mm": [1, 2, 3, 4, 5]})";

class ToyKind : public testing::Test {
protected:
    ToyKind() {
        std::string name = (fs::path(testing::TempDir()) / "toy-XXXXXX").string();
        templates_ = ::mkdtemp(name.data());
        fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "templates", templates_, fs::copy_options::recursive);
        // The one text that every document has of its kind.
        const fs::path wording = templates_ / "wording" / "en.json";
        nlohmann::json words = nlohmann::json::parse(test::file_content(wording));
        words["value"]["kind"]["toy"] = "mean of readings";
        std::ofstream(wording, std::ios::binary) << words.dump();
    }
    ~ToyKind() override { fs::remove_all(templates_); }

    [[nodiscard]] evaluation::Evaluation evaluated(const std::string& job) const {
        return evaluation::evaluate_job(jobs::MemoryFileSource({{"job.json", job}}), "job.json",
                                        evaluation::CovarianceFile::none, 1, templates_, {}, kinds_);
    }
    [[nodiscard]] issuing::IssueOptions options() const {
        issuing::IssueOptions options;
        options.assets.templates = templates_;
        options.assets.kinds = document_kinds_;
        options.kinds = kinds_;
        return options;
    }

    fs::path templates_;
    std::vector<evaluation::Kind> kinds_ = with(evaluation::program_kinds(), k_kind);
    std::vector<reports::DocumentKind> document_kinds_ = with(reports::document_kinds(), k_document);
};

TEST_F(ToyKind, IsEvaluated) {
    const reports::EvaluationRecord record = evaluated(k_job).record;
    EXPECT_EQ(record.kind, "toy");
    ASSERT_EQ(record.results.size(), 1U);
    // s = √2.5 mm, u = s/√5 = √0.5 mm; t with 4 degrees of freedom at 95.45 %: 2.869 (JCGM 100:2008, table G.2: 2.87)
    EXPECT_NEAR(record.results[0].u, 0.70711, 5e-6);
    EXPECT_NEAR(*record.results[0].k, 2.87, 0.005);
    EXPECT_EQ(record.results[0].reported.printed.value, "3.0");
    EXPECT_EQ(record.results[0].reported.printed.U, "2.0");
}

TEST_F(ToyKind, IsIssued) {
    const reports::EvaluationRecord record = evaluated(k_job).record;
    const std::vector<issuing::IssuedDocument> documents = issuing::issue_documents(record, options());
    ASSERT_EQ(documents.size(), 2U);
    EXPECT_EQ(issuing::document_names(k_kind), (std::vector<std::string>{"toy.html", "toy.txt"}));
    for (const issuing::IssuedDocument& document : documents) {
        EXPECT_THAT(document.bytes, HasSubstr("Five readings")) << document.form->name;
        EXPECT_THAT(document.bytes, HasSubstr("mean of readings")) << document.form->name;
        EXPECT_THAT(document.bytes, HasSubstr("Readings of the toy")) << document.form->name;
    }
    // Its row lists no digital certificate, so that there is none, and nothing that could be signed.
    EXPECT_FALSE(issuing::is_certificate(record, kinds_));
    EXPECT_THROW((void)issuing::issue_document(record, "dcc", options()), gum::InputError);
}

TEST_F(ToyKind, WhatItsReaderRefusesIsToldAllTogether) {
    try {
        (void)evaluated(R"({"schema": "gumcert/job/1", "kind": "toy", "readings_mm": [1], "more": 1})");
        FAIL() << "not refused";
    } catch (const gum::InputError& refused) {
        EXPECT_EQ(refused.diagnostics().size(), 3U);  // the title, the number of readings, a key
    }
}

TEST_F(ToyKind, ItsRecordIsReadAndEvaluatedAgain) {
    const std::string text = reports::to_canonical_json(evaluated(k_job).record);
    reports::EvaluationRecord record =
        reports::record_from_json(text, "record.json", std::vector<std::string_view>{"budget", "toy"});
    EXPECT_FALSE(evaluation::recompute_record(record, "record.json", 1, templates_, {}, kinds_));
    EXPECT_EQ(reports::to_canonical_json(record), text);
}

TEST_F(ToyKind, IsUnknownToTheProgram) {
    const jobs::MemoryFileSource source({{"job.json", std::string(k_job)}});
    EXPECT_THROW((void)evaluation::evaluate_job(source, "job.json", evaluation::CovarianceFile::none, 1, templates_),
                 gum::InputError);
    const std::string text = reports::to_canonical_json(evaluated(k_job).record);
    EXPECT_THROW((void)reports::record_from_json(text, "record.json"), gum::InputError);
}

TEST_F(ToyKind, LeavesTheKindsOfTheProgramAsTheyAre) {
    const fs::path job = fs::path(GUMCERT_SOURCE_DIR) / "examples/end_gauge/job.json";
    const auto record = [&](std::span<const evaluation::Kind> kinds) {
        return evaluation::evaluate_job(job, evaluation::CovarianceFile::none, 1, templates_, {}, kinds).record;
    };
    const reports::EvaluationRecord with_toy = record(kinds_);
    EXPECT_EQ(reports::to_canonical_json(with_toy), reports::to_canonical_json(record(evaluation::program_kinds())));
    EXPECT_THAT(issuing::issue_document(with_toy, "text", options()), Not(HasSubstr("toy")));
}

}  // namespace
}  // namespace gumcert::toy
