#include "reports/forms/pdf_page_texts.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/render.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A draft: certificate data with a critical finding.
EvaluationRecord draft() {
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->blocked = true;
    record.certificate->symbol = false;
    return record;
}

TEST(PdfPageTexts, AreThoseOfEveryPageInFourLanguages) {
    SKIP_WITHOUT_PDF();
    RenderAssets a = assets();
    for (const char* language : {"en", "de", "es"}) {
        a.languages = {language};
        const EvaluationRecord record = draft();
        const std::string pdf = render_pdf(record, a);  // which checks every page itself
        const std::vector<std::string> pages = texts_of_pages(pdf);
        ASSERT_GT(pages.size(), 1U) << language;
        EXPECT_TRUE(check_pages(pages, {record.certificate->data.number}).empty()) << language;
        const std::vector<gum::Diagnostic> missing = check_pages(pages, {"no such text"});
        EXPECT_EQ(missing.size(), pages.size());
        EXPECT_THAT(missing.front().what, HasSubstr("no such text"));
    }
}

/// A template of a laboratory cannot drop number and mark, on whatever page.
TEST(PdfPageTexts, RefuseATemplateWithoutNumberOrMark) {
    SKIP_WITHOUT_PDF();
    const fs::path folder = fs::path(::testing::TempDir()) / ("gumcert-marks-" + std::to_string(getpid()));
    const std::vector<std::pair<std::string, std::string>> edits = {
        {"align(right, breakable(head-right))", "[]"},      // no number and mark from page 2 on
        {"#for mark in view.mark { set-mark(mark) }", ""},  // no mark on page 1
        {"bold(breakable(page.number))", "[]"},             // no number on page 1
        {"head-right: view.header_right", "head-right: view.header_right.slice(0, 12)"}};
    for (const auto& [what, with] : edits) {
        fs::remove_all(folder);
        fs::copy(assets().templates, folder, fs::copy_options::recursive);
        std::string text = read_asset(folder / "pdf/certificate.typ");
        const std::size_t at = text.find(what);
        ASSERT_NE(at, std::string::npos) << what;
        text.replace(at, what.size(), with);
        std::ofstream(folder / "pdf/certificate.typ", std::ios::binary) << text;
        RenderAssets own = assets();
        own.languages = {"en"};
        own.templates = folder;
        try {
            static_cast<void>(render_pdf(draft(), own));
            ADD_FAILURE() << "printed with: " << with;
        } catch (const gum::NoResultError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-REPORT-0032") << error.what();
        }
    }
    fs::remove_all(folder);
}

/// What was found in an earlier release: a template printed 50 in place of 68, and nobody was told.
TEST(PdfPageTexts, RefuseATemplateThatPrintsAnotherDigit) {
    SKIP_WITHOUT_PDF();
    const fs::path folder = fs::path(::testing::TempDir()) / ("gumcert-digits-" + std::to_string(getpid()));
    EvaluationRecord record = test::certified_budget_record();
    certificate::CertifiedValue& value = record.certificate->tables.front().columns.front().values.front();
    value.printed_U = "68.7";
    RenderAssets own = assets();
    own.languages = {"en"};
    own.templates = folder;
    const auto code_with = [&](const std::string& printed) -> std::string {
        fs::remove_all(folder);
        fs::copy(assets().templates, folder, fs::copy_options::recursive);
        std::string text = read_asset(folder / "pdf/certificate.typ");
        const std::string what = "let content = cell.text";
        EXPECT_NE(text.find(what), std::string::npos);
        text.insert(text.find(what) + what.size(), ".replace(\"68.7\", \"" + printed + "\")");
        std::ofstream(folder / "pdf/certificate.typ", std::ios::binary) << text;
        try {
            static_cast<void>(render_pdf(record, own));
        } catch (const gum::NoResultError& error) {
            return error.diagnostics().front().code;
        }
        return "";
    };
    EXPECT_EQ(code_with("68.7"), "");
    EXPECT_EQ(code_with("50.7"), "GC-REPORT-0033");
    EXPECT_EQ(code_with(""), "GC-REPORT-0033");
    fs::remove_all(folder);
}

/// A stream with its entries beside the length.
std::string stream(const std::string& data, const std::string& entries = "") {
    return "<< /Length " + std::to_string(data.size()) + " " + entries + " >> stream\n" + data + "\nendstream";
}

/// A PDF of one page; object 4 and those behind it are given.
std::string pdf_with(const std::string& contents, const std::vector<std::string>& objects) {
    std::string pdf = "%PDF-1.7\n";
    std::string table;
    std::vector<std::string> all = {"<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
                                    "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 9 9] /Contents " + contents +
                                        " /Resources << /Font << /F << /Type /Font /ToUnicode 4 0 R >> >> >> >>"};
    all.insert(all.end(), objects.begin(), objects.end());
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::string offset = std::to_string(pdf.size());
        table += offset.insert(0, 10 - offset.size(), '0') + " 00000 n \n";
        pdf += std::to_string(i + 1) + " 0 obj\n" + all[i] + "\nendobj\n";
    }
    const std::string size = std::to_string(all.size() + 1);
    return pdf + "xref\n0 " + size + "\n0000000000 65535 f \n" + table + "trailer << /Size " + size +
           " /Root 1 0 R >>\nstartxref\n" + std::to_string(pdf.size()) + "\n%%EOF\n";
}

/// A small file can unpack to any size, and a small map of a font can state any number of codes.
TEST(PdfPageTexts, EndWhereADocumentUnpacksToTooMuch) {
    const std::string map = stream("1 beginbfchar <0041> <0061> endbfchar");
    const std::string text = "BT /F 1 Tf <00410041> Tj ET";
    const auto read = [](const std::string& pdf) -> std::string {
        try {
            return texts_of_pages(pdf).at(0);
        } catch (const std::exception& refused) {
            return refused.what();
        }
    };
    EXPECT_EQ(read(pdf_with("5 0 R", {map, stream(text)})), "aa");
    EXPECT_EQ(read(pdf_with("5 0 R", {map, stream("4254", "/Filter [/ASCIIHexDecode]")})), "");
    EXPECT_THAT(read(pdf_with("5 0 R", {map, stream("4254", "/Filter [/ASCIIHexDecode /ASCIIHexDecode]")})),
                HasSubstr("packed more than once"));
    EXPECT_THAT(read(pdf_with("5 0 R", {map, stream("4254", "/Filter /NoSuch")})), HasSubstr("not known"));
    const std::string most(std::size_t{32} << 20U, ' ');
    EXPECT_EQ(read(pdf_with("5 0 R", {map, stream(most)})), "");
    EXPECT_THAT(read(pdf_with("5 0 R", {map, stream(most + " ")})), HasSubstr("32 MiB"));
    EXPECT_THAT(read(pdf_with("[5 0 R 5 0 R 5 0 R]", {map, stream(most)})), HasSubstr("64 MiB"));
    EXPECT_THAT(read(pdf_with("5 0 R", {stream(most + " "), stream(text)})), HasSubstr("32 MiB"));
    std::string ranges = "1 beginbfrange ";
    for (int i = 0; i < 17; ++i) {
        ranges += "<0000> <FFFFFFFF> <0061> ";
    }
    EXPECT_THAT(read(pdf_with("5 0 R", {stream(ranges + "endbfrange"), stream(text)})), HasSubstr("codes"));
    // Each code draws half a megabyte.
    std::string letters = "1 beginbfchar <0041> <";
    for (std::size_t i = 0; i < (std::size_t{1} << 19U); ++i) {
        letters += "0061";
    }
    std::string many = "BT /F 1 Tf <";
    for (int i = 0; i < 600; ++i) {
        many += "0041";
    }
    EXPECT_THAT(read(pdf_with("5 0 R", {stream(letters + "> endbfchar"), stream(many + "> Tj ET")})),
                HasSubstr("256 MiB"));
}

/// A map of the signs of an ASCII text, of the minus as 2212 and of a soft hyphen as 00AD.
std::string map_of_signs() {
    std::string map = "2 beginbfchar <2212> <2212> <00AD> <00AD> endbfchar 95 beginbfchar";
    const std::string_view digits = "0123456789ABCDEF";
    for (unsigned code = 0x20; code < 0x7F; ++code) {
        const std::string hex = {digits[code / 16], digits[code % 16]};
        map.append(" <00").append(hex).append("> <00").append(hex).append(">");
    }
    return map + " endbfchar";
}

/// The texts beside what a page draws.
std::string beside(const std::string& content) {
    std::string all;
    for (const TextBesideDrawn& one :
         texts_beside_drawn(pdf_with("5 0 R", {stream(map_of_signs()), stream(content)}))) {
        all += one.text + (one.replaces ? "!;" : ";");
    }
    return all;
}

/// Typst states a text in place of each hyphen at the end of a line, and of the sign before a place where a line may break.
TEST(PdfPageTexts, ATextInPlaceOfItselfIsNone) {
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText <FEFF00AD> >> BDC <002D> Tj EMC"), "");
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText <FEFF0037200B> >> BDC [<0037> -3] TJ EMC"), "");
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText (12.5 mm) >> BDC <00310032> Tj [<002E0035> 9 <006D006D>] TJ EMC"),
              "");
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText (ab) >> BDC /P << /ActualText (b) >> BDC <0062> Tj EMC EMC"),
              "ab!;");
    EXPECT_EQ(beside("/F 1 Tf /Span << /Alt (a) >> BDC <0061> Tj EMC"), "a;");
}

/// Law: whatever stands in place of something else is told, where it is a digit, a sign, a word, or nothing.
TEST(PdfPageTexts, ATextInPlaceOfAnotherIsTold) {
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText (pass) >> BDC <006600610069006C> Tj EMC"), "pass!;");
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText () >> BDC <0031> Tj EMC"), "!;");
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText (1) >> BDC EMC <0031> Tj"), "1!;");
    EXPECT_EQ(beside("/F 1 Tf <0031> Tj /Span << /ActualText (1) >> BDC EMC"), "1!;");
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText (1) >> DP <0031> Tj EMC"), "1!;");
    EXPECT_EQ(beside("/F 1 Tf /Span << /ActualText <FEFF2212> >> BDC <002B> Tj EMC"), "\u2212!;");
    const std::string_view signs = "0123456789+-.,|<>aZ";
    const auto hex = [](char sign) {
        const std::string_view digits = "0123456789ABCDEF";
        const auto code = static_cast<unsigned char>(sign);
        return std::string("<FEFF00") + digits[code / 16U] + digits[code % 16U] + '>';
    };
    for (const char drawn : signs) {
        for (const char text : signs) {
            const std::string told =
                beside("/F 1 Tf /Span << /ActualText " + hex(text) + " >> BDC <" + hex(drawn).substr(5) + " Tj EMC");
            EXPECT_EQ(told, text == drawn ? "" : std::string(1, text) + "!;") << text << " in place of " << drawn;
        }
    }
}

TEST(PdfPageTexts, NoCertificateHasATextInPlaceOfAnother) {
    SKIP_WITHOUT_PDF();
    RenderAssets a = assets();
    a.languages = {"de", "en"};  // lines break in long words
    const std::string pdf = render_pdf(test::certified_budget_record(), a);
    for (const TextBesideDrawn& one : texts_beside_drawn(pdf)) {
        EXPECT_FALSE(one.replaces) << one.text;
    }
}

}  // namespace
}  // namespace gumcert::reports
