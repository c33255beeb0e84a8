#include "reports/render.h"

#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_record.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// The tags of an HTML text, in order, without what stands between them. Left out are the labels of drawings, the lines
/// that lead to them and all digits: a label finds its place by its length, and a key grows with its texts.
std::string html_tags(const std::string& html) {
    std::string out;
    for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        std::string tag = html.substr(at, html.find('>', at) - at + 1);
        std::erase_if(tag, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
        if (!tag.starts_with("<text ") && tag != "</text>" && !tag.starts_with("<line ")) {
            out += tag + "\n";
        }
    }
    return out;
}

/// What every form of the document must show of the record, as rows of texts that stand side by side.
std::vector<std::string> expected_rows(const EvaluationRecord& record) {
    std::vector<std::string> rows;
    for (const ErrorsAtAngle& at : record.rotary->errors) {
        std::string row = " " + at.printed_angle + " ";
        for (const ErrorValue& e : at.errors) {
            row += e.printed.value + " " + e.printed.U + " ";
        }
        rows.push_back(row);
    }
    for (std::size_t i = 1; i < 3; ++i) {
        const RotaryTable& r = *record.rotary;
        rows.push_back(" " + r.set_up.printed_O[i].value + " " + r.axis_in_fixture.printed_O[i].value + " " +
                       r.set_up.printed_O[i].U + " µm ");
        rows.push_back(" " + r.set_up.printed_S[i].value + " " + r.axis_in_fixture.printed_S[i].value + " " +
                       r.set_up.printed_S[i].U + " ″ ");
    }
    for (const ComparisonPoint& p : record.comparison->points) {
        rows.push_back(" " + p.direction + " " + p.printed.angle + " " + p.printed.value + " " + p.printed.U + " " +
                       p.printed.reference_value + " " + p.printed.reference_U + " " + p.printed.D + " " +
                       p.printed.U_D + " " + p.printed.En + " ");
    }
    for (const RangeRow& range : record.rotary->ranges) {
        rows.push_back(" " + range.name + " " + range.printed.value + " " + range.printed.U + " ");
    }
    for (const VarianceComponent& v : record.rotary->variance_components) {
        rows.push_back(" " + v.name + " " + v.printed.value + " " + v.printed.U + " " + v.printed.unit + " ");
    }
    for (const InputFile& file : record.job_files) {
        rows.push_back(" " + file.name + " " + file.sha256 + " ");
    }
    return rows;
}

TEST(RenderHtml, ShowsTheTextsOfTheRecord) {
    const EvaluationRecord record = test::sample_record();
    const std::string text = html_text(render_html(record, assets()));
    for (const std::string& row : expected_rows(record)) {
        EXPECT_THAT(text, HasSubstr(row));
    }
    EXPECT_THAT(text, HasSubstr("SPECIMEN — not an accredited certificate"));
    EXPECT_THAT(text, HasSubstr("The results relate only to the items calibrated."));
    EXPECT_THAT(text, HasSubstr("End of calibration certificate"));
    EXPECT_THAT(text, HasSubstr("coverage factor k = 2.00, which for a t-distribution"));
    EXPECT_THAT(text, HasSubstr("ν_eff of 380 or more"));
    EXPECT_THAT(text, HasSubstr("covariance.csv"));
}

TEST(RenderHtml, LoadsNothingAndRunsNothing) {
    const std::string html = render_html(test::sample_record(), assets());
    for (const char* part : {"<script", "src=", "href=", "url(", "@import", "currentColor", "<use", "{{", "}}"}) {
        EXPECT_THAT(html, Not(HasSubstr(part)));
    }
    EXPECT_EQ(render_html(test::sample_record(), assets()), html);
}

const std::vector<std::string> k_hostile = {"<script>alert(1)</script>",
                                            "</title><img src=x onerror=alert(1)>",
                                            "\" onload=\"alert(1)",
                                            "{{title}} {{{style}}} {{#sections}}",
                                            "{{=<% %>=}}",
                                            "#let x = 1; #panic(\"x\")",
                                            "$x^2$ *b* _i_ `raw` @ref <label>",
                                            "{name} {low} {k}",
                                            "&lt;b&gt; &amp;",
                                            "]]> --> <!-- <![CDATA[",
                                            std::string(3000, 'W'),
                                            "' or 1=1 --",
                                            "\\\"\\n \\u{0}",
                                            "a\nb\tc"};

/// A record with one text in every place that a user fills.
EvaluationRecord with_text(const std::string& text) {
    EvaluationRecord r = test::sample_record();
    r.title = text;
    r.job_files[0].name = text;
    r.comparison->remarks[0] = text;
    r.comparison->reference_name = text;
    r.comparison->reference_budget[0].input = text;
    r.rotary->stations[0].name = text;
    r.rotary->reflectors[0].name = text;
    r.rotary->dead_paths[0].name = text;
    r.rotary->flagged[0].pass = text;
    r.rotary->variance_components[0].name = text;
    r.rotary->adjustment.variance_factor.reason = text;
    r.rotary->adjustment.global_test.meaning = text;
    r.rotary->flagged[0].reason = text;
    r.rotary->location_errors[0].description = text;
    r.rotary->iso230_2->remarks[0] = text;
    r.rotary->monte_carlo->statement = text;
    r.rotary->fixture_budget->remarks[0] = text;
    r.rotary->fixture_budget->largest_coordinate = text;
    r.rotary->budget_sources[0] = text;
    for (ExternalReliability& e : r.rotary->external_reliability) {
        e.pass = text;
    }
    r.rotary->covariance_file = text;
    r.diagnostics[0].what = text;
    r.software.commit = text;
    return r;
}

TEST(RenderHtml, HostileTextsDoNotAlterTheStructure) {
    const std::string plain = html_tags(render_html(with_text("Smith"), assets()));
    for (const std::string& text : k_hostile) {
        // Not EXPECT_EQ: the difference of two whole documents takes a minute to print.
        EXPECT_TRUE(html_tags(render_html(with_text(text), assets())) == plain) << text;
    }
    EXPECT_THAT(render_html(with_text(k_hostile[0]), assets()), HasSubstr("&lt;script&gt;alert(1)&lt;"));
    EXPECT_THAT(render_html(with_text("{{title}}"), assets()),
                HasSubstr("<h1>Calibration certificate</h1>\n<p class=\"title\">{{title}}</p>"));
}

TEST(RenderText, ShowsTheTextsOfTheRecordIn100Columns) {
    const EvaluationRecord record = test::sample_record();
    const std::string whole = render_text(record, assets());
    const std::string text = squeezed(whole);
    for (const std::string& row : expected_rows(record)) {
        EXPECT_THAT(text, HasSubstr(row));
    }
    for (const std::string& hostile : k_hostile) {
        std::istringstream lines(render_text(with_text(hostile), assets()));
        for (std::string line; std::getline(lines, line);) {
            std::size_t characters = 0;
            for (const char c : line) {
                characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1U : 0U;
            }
            EXPECT_LE(characters, 100U) << line;
        }
    }
    EXPECT_EQ(render_text(record, assets()), whole);
}

TEST(Render, WorksWithoutOptionalParts) {
    EvaluationRecord r = test::sample_record();
    r.rotary.reset();
    r.comparison.reset();
    r.diagnostics.clear();
    r.kind = "budget";
    r.results[0].budget = test::sample_record().comparison->reference_budget;
    const std::string text = render_text(r, assets());
    EXPECT_THAT(text, HasSubstr("offset of the fixture along y"));
    EXPECT_THAT(text, HasSubstr("Uncertainty budget of O_y."));
    EXPECT_THAT(text, Not(HasSubstr("Error motions")));

    EvaluationRecord home = test::sample_record();
    home.rotary->datum = "home";
    home.rotary->reversal.clear();
    home.rotary->flagged.clear();
    home.rotary->errors[0].errors[0].printed = {.value = "0", .U = "", .unit = "µm"};
    const std::string home_text = squeezed(render_text(home, assets()));
    EXPECT_THAT(home_text, HasSubstr("Datum: the home position."));
    EXPECT_THAT(home_text, HasSubstr("the reversal was not determined"));
    EXPECT_THAT(home_text, HasSubstr("flagged no distance"));
    EXPECT_THAT(home_text, HasSubstr(" 0 0 – "));
}

TEST(Render, NamesWhatIsMissing) {
    RenderAssets a = assets();
    a.language = "../en";
    EXPECT_THROW(static_cast<void>(render_text(test::sample_record(), a)), gum::StorageError);
    a = assets();
    a.templates = "/nowhere";
    EXPECT_THROW(static_cast<void>(render_html(test::sample_record(), a)), gum::StorageError);
    a = assets();
    a.node_program = "/nowhere/node";
    try {
        static_cast<void>(render_pdf(test::sample_record(), a));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_THAT(e.what(), HasSubstr("scripts/setup"));
    }
}

TEST(RenderPdf, ShowsTheTextsOfTheRecordAndIsRepeatable) {
    SKIP_WITHOUT_PDF();
    const EvaluationRecord record = test::sample_record();
    const std::string pdf = render_pdf(record, assets());
    EXPECT_TRUE(pdf.starts_with("%PDF-1.7"));
    EXPECT_THAT(pdf, HasSubstr("<pdfaid:part>3</pdfaid:part>"));
    EXPECT_THAT(pdf, HasSubstr("<pdfaid:conformance>A</pdfaid:conformance>"));
    EXPECT_EQ(render_pdf(record, assets()), pdf);
    const std::string text = pdf_text(pdf);
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
    }
    for (const std::string& row : expected_rows(record)) {
        EXPECT_THAT(text, HasSubstr(row));
    }
    EXPECT_THAT(text, HasSubstr("page 1 of "));
    EXPECT_THAT(text, HasSubstr("End of calibration certificate"));
}

TEST(RenderPdf, HostileTextsAreShownAsTexts) {
    SKIP_WITHOUT_PDF();
    std::string all;
    for (const std::string& text : k_hostile) {
        if (text.size() < 100) {
            all += text + " ";
        }
    }
    const std::string text = pdf_text(render_pdf(with_text(all + std::string(500, 'W')), assets()));
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
    }
    EXPECT_THAT(text, HasSubstr("#let x = 1; #panic(\"x\")"));
    EXPECT_THAT(text, HasSubstr("$x^2$ *b* _i_ `raw` @ref <label>"));
    EXPECT_THAT(text, HasSubstr("End of calibration certificate"));
}

TEST(RenderPdf, ACharacterThatTheFontLacksIsAnError) {
    SKIP_WITHOUT_PDF();
    EvaluationRecord record = test::sample_record();
    record.title = "Rotary table 校";
    try {
        static_cast<void>(render_pdf(record, assets()));
        FAIL() << "accepted";
    } catch (const gum::NoResultError& e) {
        EXPECT_EQ(e.diagnostics().front().code, "GC-REPORT-0011");
        EXPECT_THAT(e.what(), HasSubstr("校"));
    }
}

TEST(RenderPdf, StopsAChildThatTakesTooLong) {
    SKIP_WITHOUT_PDF();
    RenderAssets a = assets();
    a.pdf_time_limit = std::chrono::seconds(0);
    // A folder of its own: others write to the common one at the same time.
    a.temporary_folder = fs::path(testing::TempDir()) / ("time-limit-" + std::to_string(getpid()));
    fs::create_directories(a.temporary_folder);
    EXPECT_THROW(static_cast<void>(render_pdf(test::sample_record(), a)), gum::StorageError);
    for (const auto& entry : fs::directory_iterator(a.temporary_folder)) {
        ADD_FAILURE() << "left behind: " << entry.path();
    }
    fs::remove_all(a.temporary_folder);
}

}  // namespace
}  // namespace gumcert::reports
