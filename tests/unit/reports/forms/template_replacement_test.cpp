#include "reports/forms/render.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// A copy of the templates, as a laboratory makes one (docs/templates.md); removed again at the end.
class TemplateReplacement : public ::testing::Test {
protected:
    void SetUp() override {
        own_ = assets();
        own_.languages = {"en"};
        folder_ = fs::path(::testing::TempDir()) / ("gumcert-own-templates-" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::copy(own_.templates, folder_, fs::copy_options::recursive);
        own_.templates = folder_;
    }
    void TearDown() override { fs::remove_all(folder_); }

    void replace(const std::string& file, const std::string& what, const std::string& with) {
        std::string text = read_asset(folder_ / file);
        const std::size_t at = text.find(what);
        ASSERT_NE(at, std::string::npos) << file << " does not hold " << what;
        text.replace(at, what.size(), with);
        write(file, text);
    }
    /// The next document is one of another command: it reads the files anew.
    void write(const std::string& file, const std::string& text) {
        std::ofstream(folder_ / file, std::ios::binary) << text;
        own_.wordings = std::make_shared<ReadWordings>();
    }

    RenderAssets own_;
    fs::path folder_;
};

TEST_F(TemplateReplacement, ChangesTheHtmlWithoutChangingTheTexts) {
    const EvaluationRecord record = test::certified_budget_record();
    const std::string before = render_html(record, own_);
    replace("certificate.html.mustache", "<footer>", "<footer class=\"own\"><p>Form QM-17, revision 3</p>");
    replace("certificate.css", "h1 {", ".own { border: 1px dotted #000; }\nh1 {");
    const std::string after = render_html(record, own_);
    EXPECT_THAT(after, HasSubstr("<footer class=\"own\"><p>Form QM-17, revision 3</p>"));
    EXPECT_THAT(after, HasSubstr(".own { border: 1px dotted #000; }"));
    std::string text = html_text(after);
    const std::string added = "Form QM-17, revision 3 ";
    ASSERT_NE(text.find(added), std::string::npos);
    text.erase(text.find(added), added.size());
    EXPECT_EQ(text, html_text(before));
}

TEST_F(TemplateReplacement, IsSaidOnEveryPage) {
    const EvaluationRecord record = test::certified_budget_record();
    own_.changed_templates = "9e7c1a5b2d3f";
    EXPECT_THAT(html_text(render_html(record, own_)), HasSubstr("changed templates 9e7c1a5b2d3f"));
    EXPECT_THAT(render_text(record, own_), HasSubstr("\nchanged templates 9e7c1a5b2d3f\n"));
    replace("certificate.html.mustache", "{{footer_left}}", "Form QM-17");
    EXPECT_THROW(static_cast<void>(render_html(record, own_)), gum::NoResultError);
    SKIP_WITHOUT_PDF();
    EXPECT_FALSE(render_pdf(record, own_).empty());
    replace("pdf/certificate.typ", "breakable(foot)", "[Form QM-17]");
    EXPECT_THROW(static_cast<void>(render_pdf(record, own_)), gum::NoResultError);
}

/// The mark stands in plain bytes, where archives look for it; a template that leaves it out gives no document.
TEST_F(TemplateReplacement, CannotLeaveOutTheHeadOfTheArchive) {
    const EvaluationRecord record = test::certified_budget_record();
    const std::string without = render_html(record, own_);
    own_.head = HeadToPrint{.entries = "12",
                            .digits = "5dc9 da79 4604 328a",
                            .mark = "gumcert-head:12:5dc9da794604328a",
                            .check_at = "https://lab.example"};
    const std::string html = render_html(record, own_);
    EXPECT_THAT(html, HasSubstr("gumcert-head:12:5dc9da794604328a"));
    EXPECT_THAT(html_text(html), HasSubstr("12 entries, 5dc9 da79 4604 328a"));
    EXPECT_THAT(html_text(html), HasSubstr("https://lab.example"));
    EXPECT_THAT(render_text(record, own_), HasSubstr("https://lab.example"));
    EXPECT_EQ(without.find("gumcert-head"), std::string::npos);
    replace("certificate.html.mustache", "{{#head_code}}<p title=\"{{text}}\">", "{{#head_code}}<p>");
    EXPECT_THROW(static_cast<void>(render_html(record, own_)), gum::NoResultError);
    SKIP_WITHOUT_PDF();
    EXPECT_THAT(render_pdf(record, own_), HasSubstr("gumcert-head:12:5dc9da794604328a"));
    replace("pdf/certificate.typ", "alt: item.text)", "alt: \"code\")");
    EXPECT_THROW(static_cast<void>(render_pdf(record, own_)), gum::NoResultError);
}

TEST_F(TemplateReplacement, CannotLeaveOutTheNumberOrTheMark) {
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->blocked = true;
    EXPECT_THAT(html_text(render_html(record, own_)), HasSubstr("DRAFT"));
    replace("certificate.html.mustache", "{{header_right}}", "");
    replace("certificate.html.mustache", "{{header_right}}", "");
    replace("certificate.html.mustache", "<p class=\"mark-text\">{{text}}", "<p class=\"mark-text\">");
    try {
        static_cast<void>(render_html(record, own_));
        FAIL() << "a draft without its mark";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-REPORT-0032");
        EXPECT_THAT(error.what(), HasSubstr("DRAFT"));
    }
}

TEST_F(TemplateReplacement, ChangesThePdf) {
    SKIP_WITHOUT_PDF();
    if (program("pdftotext").empty()) {
        GTEST_SKIP() << "pdftotext is missing";
    }
    replace("pdf/certificate.typ", "breakable(foot)", "[Form QM-17]");
    const std::string text = pdf_text(render_pdf(test::certified_budget_record(), own_));
    EXPECT_THAT(text, HasSubstr("Form QM-17"));
    EXPECT_THAT(text, HasSubstr("50000838"));
    EXPECT_THAT(text, HasSubstr("End of calibration certificate"));
}

TEST_F(TemplateReplacement, ChangesTheWording) {
    replace("wording/en.json", "\"Statement of uncertainty\"", "\"Measurement uncertainty\"");
    EXPECT_THAT(html_text(render_html(test::certified_budget_record(), own_)), HasSubstr(" Measurement uncertainty "));
}

TEST_F(TemplateReplacement, SaysWhatIsWrongWithATemplate) {
    replace("certificate.html.mustache", "{{/blocks}}", "{{/blokcs}}");
    try {
        static_cast<void>(render_html(test::certified_budget_record(), own_));
        FAIL() << "a template that does not close its sections was accepted";
    } catch (const gum::StorageError& error) {
        EXPECT_THAT(std::string(error.what()), HasSubstr("certificate.html.mustache"));
    }
}

/// Every profile has all keys, and texts in every language that documents can have.
TEST(Profiles, AreComplete) {
    const std::vector<std::string> keys = {"id",
                                           "name",
                                           "sources",
                                           "digits",
                                           "rounding",
                                           "below_capability",
                                           "mixed_results",
                                           "plus_minus_in_tables",
                                           "k_position",
                                           "opinions_with_symbol",
                                           "reproduction_sentence_mandatory",
                                           "receipt_date_mandatory",
                                           "reviewer_may_be_performer",
                                           "required_languages",
                                           "first_page_sentences",
                                           "uncertainty_sentence"};
    for (const char* id : {"ilac", "ukas", "dakks", "a2la", "nvlap", "taf", "cgcre", "enac"}) {
        const auto profile =
            nlohmann::json::parse(read_asset(assets().templates / "profiles" / (std::string(id) + ".json")));
        EXPECT_EQ(profile.size(), keys.size() + profile.count("terms")) << id;
        for (const std::string& key : keys) {
            EXPECT_TRUE(profile.contains(key)) << id << ": " << key;
        }
        EXPECT_EQ(profile.at("id"), id);
        EXPECT_FALSE(profile.at("sources").empty()) << id;
        EXPECT_THAT(profile.at("sources").dump(), Not(HasSubstr("[check]")));
        for (const auto& sentence : profile.at("first_page_sentences")) {
            for (const char* language : {"en", "de", "zh-Hant", "es"}) {
                EXPECT_TRUE(sentence.contains(language)) << id << ": " << language;
            }
        }
    }
}

TEST_F(TemplateReplacement, TakesSingleTextsOfALaboratory) {
    const EvaluationRecord record = test::certified_budget_record();
    const auto put = [&](const std::string& text) { write("wording/en.own.json", text); };
    put(R"({"certificate": {"order": "Your order"}})");
    EXPECT_THAT(render_html(record, own_), HasSubstr("Your order"));
    EXPECT_THAT(render_html(record, own_), Not(HasSubstr("Order number")));
    for (const char* wrong : {R"({"certificate": {"oder": "Your order"}})", R"({"certificate": "text"})"}) {
        put(wrong);
        try {
            static_cast<void>(render_html(record, own_));
            ADD_FAILURE() << wrong;
        } catch (const gum::StorageError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-REPORT-0007");
        }
    }
}

TEST_F(TemplateReplacement, TakesPicturesBesideTheTemplate) {
    const EvaluationRecord record = test::certified_budget_record();
    std::ofstream(folder_ / "logo.png", std::ios::binary) << "bytes";
    replace("certificate.html.mustache", "<main>", "<main><img src=\"logo.png\" alt=\"Logo\">");
    EXPECT_THAT(render_html(record, own_), HasSubstr("src=\"data:image/png;base64,Ynl0ZXM=\""));
    fs::remove(folder_ / "logo.png");
    EXPECT_THROW(static_cast<void>(render_html(record, own_)), gum::StorageError);
}

}  // namespace
}  // namespace gumcert::reports
