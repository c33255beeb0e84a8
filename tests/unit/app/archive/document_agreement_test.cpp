#include "app/archive/document_agreement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/evaluate_job.h"
#include "reports/dcc/dcc_document.h"
#include "reports/forms/html_texts.h"
#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/render.h"

namespace gumcert::app {
namespace {

using certificate::CertifiedValue;
using reports::EvaluationRecord;
using ::testing::HasSubstr;

const std::filesystem::path k_agreement_tree(GUMCERT_SOURCE_DIR);
const std::filesystem::path k_agreement_templates = k_agreement_tree / "templates";

const std::vector<std::pair<std::string, EvaluationRecord>>& example_certificates() {
    static const std::vector<std::pair<std::string, EvaluationRecord>> k_records = [] {
        std::vector<std::pair<std::string, EvaluationRecord>> records;
        for (const char* const job :
             {"examples/certificate/end_gauge.json", "examples/everyday/pt100/job.json",
              "examples/everyday/mass_set/job.json", "examples/everyday/multimeter/job.json",
              "examples/everyday/gauge_blocks/job.json", "examples/everyday/torque_wrench/job.json"}) {
            records.emplace_back(
                job, evaluate_job(k_agreement_tree / job, CovarianceFile::none, 1, k_agreement_templates).record);
        }
        return records;
    }();
    return k_records;
}

reports::RenderAssets agreement_assets(const std::vector<std::string>& languages = {}) {
    reports::RenderAssets assets;
    assets.templates = k_agreement_templates;
    assets.languages = languages;
    return assets;
}

std::string page_of(const EvaluationRecord& record, const std::vector<std::string>& languages = {}) {
    return reports::render_html(record, agreement_assets(languages));
}

std::string disagreement(const std::string& html, const EvaluationRecord& record) {
    static const DocumentWords k_words = document_words(k_agreement_templates);
    return PrintedDocument({reports::text_of_html(html)}).disagreement_with(*record.certificate, k_words);
}

/// Every value with its column.
template <class Work>
void for_each_value(EvaluationRecord& record, const Work& work) {
    for (certificate::CertifiedTable& table : record.certificate->tables) {
        for (certificate::CertifiedColumn& column : table.columns) {
            for (CertifiedValue& value : column.values) {
                work(value);
            }
        }
    }
}

/// Another value, of which every digit is another one.
void change_digits(std::string& printed) {
    for (char& c : printed) {
        if (c >= '0' && c <= '9') {
            c = c == '9' ? '0' : static_cast<char>(c + 1);
        }
    }
}

TEST(DocumentsAndRecords, AgreeInEveryLanguageAndForm) {
    for (const auto& [name, record] : example_certificates()) {
        for (const std::vector<std::string>& languages :
             std::vector<std::vector<std::string>>{{}, {"en"}, {"de"}, {"es"}, {"zh-Hant"}, {"de", "en"}}) {
            const std::string html = page_of(record, languages);
            EXPECT_EQ(disagreement(html, record), "") << name << " " << testing::PrintToString(languages);
            EXPECT_TRUE(says_number(html, record.certificate->data.number)) << name;
            EXPECT_FALSE(says_number(html, record.certificate->data.number + "1")) << name;
        }
        const std::string dcc = reports::render_dcc(record, agreement_assets());
        EXPECT_EQ(disagreement_of_dcc(dcc, name, dcc), "") << name;
    }
}

// Law: what no certificate is, is told by its mark, in every language and with every pair of languages.
TEST(DocumentsAndRecords, DisagreeWhereAMarkSaysThatItIsNone) {
    const std::vector<std::pair<const char*, void (*)(EvaluationRecord&)>> states = {
        {"draft", [](EvaluationRecord& record) { record.certificate->blocked = true; }},
        {"specimen", [](EvaluationRecord& record) { record.certificate->data.status = "specimen"; }},
        {"superseded", [](EvaluationRecord& record) { record.certificate->superseded_by = "EX-2026-0099/A1"; }}};
    const EvaluationRecord& record = example_certificates().front().second;
    for (const std::vector<std::string>& languages :
         std::vector<std::vector<std::string>>{{"en"}, {"de"}, {"es"}, {"zh-Hant"}, {"de", "en"}, {"en", "zh-Hant"}}) {
        const std::string named = testing::PrintToString(languages);
        for (const auto& [state, change] : states) {
            EvaluationRecord other = record;
            change(other);
            EXPECT_THAT(disagreement(page_of(other, languages), record), HasSubstr("is marked")) << state << named;
        }
        const std::string report = reports::render_budget_report_html(record, agreement_assets(languages));
        EXPECT_THAT(disagreement(report, record), HasSubstr("is marked")) << named;
    }
}

// Every mark that the wording has is one: a kind of document that is new is not forgotten.
TEST(DocumentsAndRecords, KnowTheMarksOfAllKindsOfDocuments) {
    const DocumentWords words = document_words(k_agreement_templates);
    std::vector<std::string> marks;
    for (const DocumentWords::Mark& mark : words.marks) {
        marks.push_back(mark.text);
    }
    for (const char* const mark :
         {"DRAFT \u2014 not issued", "SPECIMEN \u2014 not an accredited certificate", "SUPERSEDED by {number}",
          "INTERNAL \u2014 no calibration certificate", "Audit \u2013 not a calibration certificate",
          "ERSETZT durch {number}", "\u5DF2\u88AB {number} \u53D6\u4EE3"}) {
        EXPECT_THAT(marks, testing::Contains(mark));
    }
    for (const DocumentWords::Mark& mark : words.marks) {
        EXPECT_NE(PrintedDocument({"x " + mark.before + "EX-1" + mark.behind + " y"})
                      .disagreement_with(*example_certificates().front().second.certificate, words)
                      .find("is marked"),
                  std::string::npos)
            << mark.text;
    }
}

// A document of a record in which one printed value or one verdict is another one.
TEST(DocumentsAndRecords, DisagreeWhereOneValueOrVerdictIsAnother) {
    for (const auto& [name, record] : example_certificates()) {
        const std::string html = page_of(record);
        const std::string dcc = reports::render_dcc(record, agreement_assets());
        std::size_t values = 0;
        std::size_t verdicts = 0;
        EvaluationRecord counted = record;
        for_each_value(counted, [&](const CertifiedValue& v) {
            values += v.printed_value.size() > 2 && !v.printed_U.empty() ? 1U : 0U;
            verdicts += v.verdict ? 1U : 0U;
        });
        ASSERT_GT(values, 0U) << name;
        for (const std::size_t chosen : {std::size_t{0}, values / 2, values - 1}) {
            EvaluationRecord other = record;
            std::size_t i = 0;
            for_each_value(other, [&](CertifiedValue& v) {
                if (v.printed_value.size() > 2 && !v.printed_U.empty() && i++ == chosen) {
                    change_digits(v.printed_value);
                }
            });
            const std::string page = page_of(other);
            if (page != html) {
                EXPECT_NE(disagreement(html, other), "") << name << ", value " << chosen;
                EXPECT_NE(disagreement_of_dcc(reports::render_dcc(other, agreement_assets()), name, dcc), "")
                    << name << ", value " << chosen;
            }
        }
        if (verdicts == 1) {
            EvaluationRecord other = record;
            for_each_value(other, [](CertifiedValue& v) { v.verdict->verdict = "fail"; });
            EXPECT_THAT(disagreement(html, other), HasSubstr("fail")) << name;
        }
    }
}

TEST(DocumentsAndRecords, AgreeAsPages) {
    const EvaluationRecord& record = example_certificates().front().second;
    const DocumentWords words = document_words(k_agreement_templates);
    const std::vector<std::string> pages = {"EX-1 l 50000838 67 pass of 2", "EX-1"};
    EXPECT_EQ(PrintedDocument(pages).disagreement_with(*record.certificate, words), "");
    for (const char* const other :
         {"EX-1 l 50001138 67 pass of 2", "EX-1 l 50000838 66 pass", "EX-1 l 50000838 67 fail", "EX-1",
          "EX-1 l 50000838 67 pass DRAFT \u2014 not issued", "EX-1 l 50000838 67 conditional pass",
          "EX-1 l 67 50000838 pass"}) {
        EXPECT_NE(PrintedDocument({other}).disagreement_with(*record.certificate, words), "") << other;
    }
}

TEST(DocumentsAndRecords, SayTheirNumberAsAWordOfItsOwn) {
    EXPECT_TRUE(says_number("<p>Certificate EX-1.</p>", "EX-1"));
    EXPECT_TRUE(says_number("<style>EX-2</style><p>a &amp; b EX-1</p>", "EX-1"));
    for (const char* const html :
         {"<p>EX-11</p>", "<p>EX-1/A1</p>", "<p>AEX-1</p>", "<style>EX-1</style>", "<!-- EX-1 -->",
          "<head><title>EX-1</title></head>", "<b data-text=\"Certificate EX-2\"></b><p>replaces EX-1</p>"}) {
        EXPECT_FALSE(says_number(html, "EX-1")) << html;
    }
}

}  // namespace
}  // namespace gumcert::app
