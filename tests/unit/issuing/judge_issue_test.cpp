#include "issuing/judge_issue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/reports/certified_sample.h"

namespace gumcert::issuing {
namespace {

using reports::EvaluationRecord;

reports::RenderAssets in_languages(const std::vector<std::string>& languages) {
    reports::RenderAssets assets;
    assets.templates = std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates";
    assets.languages = languages;
    return assets;
}

bool has_finding(const EvaluationRecord& record, const std::string& id) {
    return std::ranges::any_of(record.certificate->findings, [&](const auto& one) { return one.id == id; });
}

TEST(JudgeIssue, WithholdsACertificateThatIsDatedAhead) {
    EvaluationRecord record = test::certified_budget_record();
    const std::string issued = record.certificate->data.dates.issued;
    judge_issue(record, issued, in_languages({}));
    EXPECT_TRUE(record.certificate->findings.empty());
    EXPECT_FALSE(is_withheld(record, false));
    judge_issue(record, "2000-01-01", in_languages({}));
    EXPECT_TRUE(has_finding(record, "P12"));
    EXPECT_FALSE(record.statements.empty()) << "what was found now is worded in all languages";
    EXPECT_TRUE(is_withheld(record, false));
    EXPECT_FALSE(is_withheld(record, true)) << "a draft may be printed";
}

TEST(JudgeIssue, FindsTextsThatALanguageLacks) {
    EvaluationRecord record = test::certified_budget_record();
    const std::string issued = record.certificate->data.dates.issued;
    judge_issue(record, issued, in_languages({"es"}));
    EXPECT_TRUE(has_finding(record, "R17"));
}

TEST(JudgeIssue, LeavesARecordThatIsNoCertificate) {
    EvaluationRecord record = test::sample_budget_record();
    judge_issue(record, "2000-01-01", in_languages({"es"}));
    EXPECT_FALSE(record.certificate);
    EXPECT_FALSE(is_withheld(record, false));
}

TEST(JudgeIssue, AnswersNoWhereAnyOfThemDoes) {
    evaluation::Evaluation evaluation;
    EXPECT_FALSE(is_negative(evaluation));
    evaluation.negative = true;
    EXPECT_TRUE(is_negative(evaluation)) << "the job asked for a validation that failed";
    evaluation.negative = false;
    evaluation.blocked = true;
    EXPECT_TRUE(is_negative(evaluation));
    evaluation.blocked = false;
    evaluation.record = test::certified_budget_record();
    EXPECT_FALSE(is_negative(evaluation));
    judge_issue(evaluation.record, "2000-01-01", in_languages({}));
    EXPECT_TRUE(is_negative(evaluation)) << "found on the day of issue";
}

TEST(JudgeIssue, SaysWhyNoDocumentIsThere) {
    EXPECT_EQ(withheld("job.json").code, "GC-CERT-0305");
    EXPECT_EQ(withheld("job.json").where, "job.json");
    EXPECT_EQ(withheld("job.json").severity, gum::Severity::error);
    EXPECT_EQ(document_of_earlier("out/certificate.pdf").code, "GC-CERT-0306");
    EXPECT_EQ(document_of_earlier("out/certificate.pdf").severity, gum::Severity::warning);
}

}  // namespace
}  // namespace gumcert::issuing
