#include "reports/forms/study_document.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms/pdf_worker.h"
#include "reports/plots/layout_plot.h"
#include "tests/unit/reports/document_text.h"
#include "text/utf8.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

StudyDocument study(const std::string& kind) {
    LayoutPlot layout;
    layout.stations = {{.name = "P1", .position_mm = {900.0, 100.0, -40.0}}};
    StudyDocument document;
    document.kind = kind;
    document.title = "Study <1> of a rotary table";
    document.subtitle = "One hundred campaigns with six stations.";
    document.facts = {{"Job", "job.json"}, {"Seed", "17"}};
    document.sections = {
        {.heading = "Tables of the paper",
         .paragraphs = {"With noise & without."},
         .tables = {{.caption = "Mean relative deviation.",
                     .columns = {{"Angles", "", true}, {"here", "%", true}, {"paper", "%", true}},
                     .rows = {{"36", "0.12", "4.5"}, {"72", "0.081"}}}},
         .figures = {{.caption = "The layout.", .alternative_text = "one station", .drawing = svg(layout)}}},
        {.heading = "Coverage", .paragraphs = {}, .tables = {}, .figures = {}}};
    document.data_json = "{}";
    return document;
}

/// Whether a character can be printed is known before a study is made.
TEST(StudyDocument, CharactersWithoutGlyphAreNamed) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets());
    const std::vector<std::string> good{"\u03A9", "\u2212", "\u2264", "\u0159", "\u2013"};
    EXPECT_THAT(characters_without_glyph(good, assets(), worker), ::testing::IsEmpty());
    EXPECT_THAT(characters_without_glyph({}, assets(), worker), ::testing::IsEmpty());
    std::vector<std::string> mixed = good;
    mixed.insert(mixed.begin() + 2, {"\U0001F600", "\uA66E"});
    EXPECT_THAT(characters_without_glyph(mixed, assets(), worker), ::testing::ElementsAre("\U0001F600", "\uA66E"));
    EXPECT_TRUE(render_pdf(study("plan"), assets(), &worker).starts_with("%PDF-")) << "the process goes on";
}

/// Jobs of one command have most characters in common: a page is set for those that are new.
TEST(StudyDocument, CharactersThatWereShownAreNotLookedAtAgain) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets());
    EXPECT_FALSE(worker.has_shown({}, false)) << "node and Typst are not known to work";
    EXPECT_THAT(characters_without_glyph({"\u03A9", "\u2212"}, assets(), worker), ::testing::IsEmpty());
    EXPECT_TRUE(worker.has_shown({"\u2212"}, false));
    EXPECT_FALSE(worker.has_shown({"\u2212", "\u2264"}, false));
    EXPECT_FALSE(worker.has_shown({"\u2212"}, true)) << "of other fonts nothing is known";
    EXPECT_THAT(characters_without_glyph({"\u2212", "\uA66E"}, assets(), worker), ::testing::ElementsAre("\uA66E"));
    EXPECT_THAT(characters_without_glyph({"\uA66E"}, assets(), worker), ::testing::ElementsAre("\uA66E"));
    EXPECT_FALSE(worker.has_shown({"\uA66E"}, false));
    EXPECT_THAT(characters_without_glyph({"\u03A9", "\u2264"}, assets(), worker), ::testing::IsEmpty());
    EXPECT_TRUE(worker.has_shown({"\u2212", "\u2264"}, false));
}

TEST(StudyDocument, EveryFormSaysThatNothingWasMeasured) {
    for (const auto& [kind, mark] : {std::pair("simulation", "Simulation study – not a calibration certificate"),
                                     std::pair("plan", "Plan – nothing was measured")}) {
        const std::string html = render_html(study(kind), assets());
        for (const std::string& text : {squeezed(render_text(study(kind))), html_text(html)}) {
            EXPECT_THAT(text, HasSubstr(mark));
            EXPECT_THAT(text, HasSubstr("Job job.json"));
            EXPECT_THAT(text, HasSubstr(" 36 0.12 4.5 "));
            EXPECT_THAT(text, HasSubstr("–")) << "what a row lacks";
            EXPECT_THAT(text, Not(HasSubstr("Calibration certificate")));
            EXPECT_THAT(text, Not(HasSubstr("items calibrated")));
        }
        EXPECT_THAT(html, HasSubstr("Study &lt;1&gt; of a rotary table"));
        EXPECT_THAT(html, HasSubstr("With noise &amp; without."));
        EXPECT_THAT(html, HasSubstr("<figure id=\"figure-1\">"));
        EXPECT_THAT(html, HasSubstr(">P1</text>"));
        EXPECT_EQ(render_html(study(kind), assets()), html);
    }
}

TEST(StudyDocument, TextHasAtMost100Columns) {
    StudyDocument wide = study("simulation");
    wide.title = std::string(300, 'W');
    wide.sections[0].paragraphs = {std::string(150, 'x') + " y"};
    for (int c = 0; c < 8; ++c) {
        wide.sections[0].tables[0].columns.push_back({"a long head", "unit", false});
        wide.sections[0].tables[0].rows[0].push_back("some longer text in this cell");
    }
    std::istringstream lines(render_text(wide));
    for (std::string line; std::getline(lines, line);) {
        std::size_t characters = 0;
        for (const char c : line) {
            characters += !text::is_continuation(c) ? 1U : 0U;
        }
        EXPECT_LE(characters, 100U) << line;
    }
}

TEST(StudyDocument, OtherKindsAreRefused) {
    EXPECT_THROW(static_cast<void>(render_text(study("certificate"))), gum::InputError);
}

TEST(StudyDocument, PdfHasTheSameTexts) {
    SKIP_WITHOUT_PDF();
    const std::string pdf = render_pdf(study("plan"), assets());
    EXPECT_TRUE(pdf.starts_with("%PDF-1.7"));
    EXPECT_EQ(render_pdf(study("plan"), assets()), pdf);
    const std::string text = pdf_text(pdf);
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
    }
    EXPECT_THAT(text, HasSubstr("Plan – nothing was measured"));
    EXPECT_THAT(text, HasSubstr("End of plan"));
}

}  // namespace
}  // namespace gumcert::reports
