// Law: what an audit did not look at stands where each of its forms begins, in every language.
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "reports/audit/audit_document.h"
#include "reports/audit/audit_html.h"
#include "reports/audit/audit_json.h"
#include "reports/audit/audit_sarif.h"
#include "reports/audit/audit_text.h"
#include "reports/audit/audit_words.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/text_columns.h"
#include "tests/support/json_schema.h"
#include "tests/support/sample_audit.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

constexpr std::size_t k_unread_cells = 9;

std::string unread_cell(std::size_t i) {
    return "Budget!Q" + std::to_string(70 + i) + ": not evaluated here (OFFSET)";
}

/// Everything that an audit says of its own limits: cells that were not read, more than page one names; rules that were
/// not checked; shares over random orders; files that were refused, that are part of others, and of other kinds.
AuditView limited_view() {
    std::vector<audit::AuditReport> reports = {test::sample_audit(), test::sample_audit_of_points()};
    reports.front().subject.not_read.clear();
    for (std::size_t i = 0; i < k_unread_cells; ++i) {
        reports.front().subject.not_read.push_back(unread_cell(i));
    }
    reports.front().results.front().sampled_shares = true;
    return make_audit_view(
        reports, test::sample_rules(),
        {.program = "gumcert 0.1.0",
         .digests = {},
         .unaudited = {{.file = "old.xls", .because = "old.xls: neither a job nor a table"},
                       {.kind = UnauditedFile::Kind::in_record, .file = "job77.json", .because = "record77.json"},
                       {.kind = UnauditedFile::Kind::other_kind, .file = "notes.md"}}});
}

RenderAssets assets_in(const std::string& language) {
    RenderAssets in = assets();
    in.languages = {language};
    return in;
}

/// Without blanks: lines of Chinese break between any two characters.
std::string solid(std::string text) {
    text = squeezed(std::move(text));
    std::erase(text, ' ');
    return text;
}

/// The first page of a PDF; "" where pdftotext is missing.
std::string first_page(const std::string& pdf) {
    const std::filesystem::path reader = program("pdftotext");
    const std::filesystem::path file =
        std::filesystem::path(::testing::TempDir()) / ("gumcert-audit-limits-" + std::to_string(getpid()) + ".pdf");
    std::ofstream(file, std::ios::binary) << pdf;
    std::string text;
    const std::string command = reader.string() + " -l 1 -layout '" + file.string() + "' -";
    if (std::FILE* const pipe = reader.empty() ? nullptr : ::popen(command.c_str(), "r")) {
        std::array<char, 4096> buffer{};
        for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
            text.append(buffer.data(), n);
        }
        ::pclose(pipe);
    }
    std::filesystem::remove(file);
    return text;
}

/// What page one has to say, sentence by sentence.
std::vector<std::string> sentences_of_page_one(const AuditView& view, const AuditWords& words) {
    std::vector<std::string> all;
    for (const std::vector<AuditSentence>& sentences : {words.unaudited(view), words.limits(view.files.front())}) {
        for (const AuditSentence& sentence : sentences) {
            all.push_back(sentence.text);
        }
    }
    return all;
}

TEST(AuditLimits, AreAllInTheSentencesOfPageOne) {
    const AuditView view = limited_view();
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const Wording wording = read_wording(assets_in(language));
        const AuditWords words(wording);
        std::string all;
        for (const std::string& sentence : sentences_of_page_one(view, words)) {
            all += sentence + "\n";
        }
        for (const char* said : {"old.xls", "job77.json", "record77.json", "notes.md", "Budget!Q70", "Budget!Q75"}) {
            EXPECT_NE(all.find(said), std::string::npos) << said << " " << language;
        }
        const std::size_t not_checked = view.files.front().not_checked.size();
        ASSERT_GT(not_checked, 0U);
        for (const std::string& said :
             {words.filled("more_limits", {{"count", "3"}}),
              words.filled("rules_not_checked", {{"count", std::to_string(not_checked)}}), words("sampled")}) {
            EXPECT_NE(all.find(said), std::string::npos) << said << " " << language;
        }
    }
}

TEST(AuditLimits, StandBeforeTheFindingsOnTheTerminal) {
    const AuditView view = limited_view();
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const Wording wording = read_wording(assets_in(language));
        const AuditWords words(wording);
        const std::string lines = audit_as_text(view, wording, false);
        const std::size_t findings = lines.find("\n" + words("findings") + "\n");
        ASSERT_NE(findings, std::string::npos);
        const std::string first = solid(lines.substr(0, findings)), all = solid(lines);
        for (const std::string& sentence : sentences_of_page_one(view, words)) {
            EXPECT_NE(first.find(solid(sentence)), std::string::npos) << sentence << " " << language;
        }
        for (std::size_t i = 0; i < k_unread_cells; ++i) {
            EXPECT_NE(all.find(solid(unread_cell(i))), std::string::npos);
        }
    }
}

TEST(AuditLimits, StandOnPageOneForTheAssessor) {
    const AuditView view = limited_view();
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        const Wording wording = read_wording(assets_in(language));
        const AuditWords words(wording);
        const std::string page = audit_as_html(view, assets_in(language));
        const std::size_t rows = page.find("id=\"file-1-rows\"");
        ASSERT_NE(rows, std::string::npos);
        for (const std::string& sentence : sentences_of_page_one(view, words)) {
            EXPECT_LT(page.find(">" + sentence + "</li>"), rows) << sentence << " " << language;
        }
        for (std::size_t i = 0; i < k_unread_cells; ++i) {
            EXPECT_NE(page.find(unread_cell(i)), std::string::npos);
        }
    }
}

TEST(AuditLimits, StandOnPageOneOfTheFile) {
    SKIP_WITHOUT_PDF();
    const AuditView view = limited_view();
    const std::filesystem::path noto = "/usr/share/fonts/opentype/noto";
    for (const std::string language : {"en", "de", "es", "zh-Hant"}) {
        RenderAssets in = assets_in(language);
        if (language == "zh-Hant" && !std::filesystem::exists(noto)) {
            continue;  // fonts-noto-cjk is missing
        }
        in.fonts = {noto};
        const std::string pdf = audit_as_pdf(view, in);
        const std::string first = first_page(pdf), text = pdf_text(pdf);
        if (first.empty()) {
            GTEST_SKIP() << "pdftotext is missing: the texts of the PDF were not compared";
        }
        for (const char* said : {"old.xls", "job77.json", "notes.md", "Q70", "Q75"}) {
            EXPECT_NE(first.find(said), std::string::npos) << said << " " << language;
        }
        for (std::size_t i = 0; i < k_unread_cells; ++i) {
            EXPECT_NE(text.find("Q" + std::to_string(70 + i)), std::string::npos);
        }
    }
}

TEST(AuditLimits, AreDataForPrograms) {
    const AuditView view = limited_view();
    const json report = json::parse(audit_as_json(view));
    EXPECT_EQ(test::JsonSchema("audit-1.schema.json").refusals(report), "");
    ASSERT_EQ(report["unaudited"].size(), view.unaudited.size());
    EXPECT_EQ(report["unaudited"][0]["why"], "refused");
    EXPECT_EQ(report["unaudited"][1]["because"], "record77.json");
    const json& file = report["files"][0];
    for (std::size_t i = 0; i < k_unread_cells; ++i) {
        EXPECT_NE(file["not_read"].dump().find(unread_cell(i)), std::string::npos);
    }
    EXPECT_EQ(file["not_checked"].size(), view.files.front().not_checked.size());
    EXPECT_EQ(file["results"][0]["sampled_shares"], true);
    const json log = json::parse(audit_as_sarif(view, test::sample_rules()));
    const std::string notes = log["runs"][0]["invocations"][0].dump();
    for (const char* said : {"old.xls", "job77.json", "record77.json", "notes.md", "Budget!Q78", "random orders"}) {
        EXPECT_NE(notes.find(said), std::string::npos) << said;
    }
}

TEST(AuditLimits, AreNotSaidWhereThereAreNone) {
    const json report =
        json::parse(audit_as_json(make_audit_view(std::vector{test::sample_audit()}, test::sample_rules(), {})));
    EXPECT_FALSE(report.contains("unaudited"));
    EXPECT_FALSE(report["results"][0].contains("sampled_shares"));
}

}  // namespace
}  // namespace gumcert::reports
