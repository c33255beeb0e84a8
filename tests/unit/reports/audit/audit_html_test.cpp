#include "reports/audit/audit_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "encoding/base64.h"
#include "encoding/sha2.h"
#include "tests/support/hostile_strings.h"
#include "tests/support/sample_audit.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string page_of(std::vector<audit::AuditReport> reports, const std::string& language = "en") {
    RenderAssets in = assets();
    in.languages = {language};
    reports.front().subject.waivers = {
        {.finding = "B05", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "one operator"}};
    return audit_as_html(
        make_audit_view(reports, test::sample_rules(), {.program = "gumcert 0.1.0", .digests = {std::string(64, 'a')}}),
        in);
}

/// Elements of a page in their order: name, and "/" before that of an end. Style and script are left out.
std::vector<std::string> tags_of(const std::string& html) {
    const std::string shown =
        html.substr(0, html.find("<style>")) +
        html.substr(html.find("</style>") + 8, html.rfind("<script>") - html.find("</style>") - 8) +
        html.substr(html.rfind("</script>") + 9);
    std::vector<std::string> tags;
    for (std::size_t at = shown.find('<'); at != std::string::npos; at = shown.find('<', at + 1)) {
        std::size_t end = shown.find_first_of("<>\"", at + 1);  // which values of attributes may have
        while (end != std::string::npos && shown[end] == '"') {
            const std::size_t closing = shown.find('"', end + 1);
            end = closing == std::string::npos ? closing : shown.find_first_of("<>\"", closing + 1);
        }
        const std::size_t name = at + 1 < shown.size() && shown[at + 1] == '/' ? at + 2 : at + 1;
        const bool is_named = name < shown.size() && std::isalpha(static_cast<unsigned char>(shown[name])) != 0;
        if (is_named && end != std::string::npos && shown[end] == '>') {
            std::size_t behind = name;
            while (std::isalnum(static_cast<unsigned char>(shown[behind])) != 0) {
                ++behind;
            }
            tags.push_back(shown.substr(at + 1, behind - at - 1) + (shown[end - 1] == '/' ? "/" : ""));
            at = end;
        }
    }
    return tags;
}

/// Where the elements of a page do not lie within each other; "" where all do.
std::string nesting_problem(const std::vector<std::string>& tags) {
    static const std::set<std::string> k_void = {"meta", "br", "img", "hr", "link", "input"};
    std::vector<std::string> open;
    for (const std::string& tag : tags) {
        if (tag.ends_with("/") || k_void.contains(tag)) {
            continue;
        }
        if (!tag.starts_with("/")) {
            open.push_back(tag);
        } else if (open.empty() || open.back() != tag.substr(1)) {
            return "</" + tag.substr(1) + "> closes " + (open.empty() ? "nothing" : open.back());
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : open.back() + " stays open";
}
std::string nesting_problem(const std::string& html) {
    return nesting_problem(tags_of(html));
}

/// How often a text stands in a page.
std::size_t times_in(const std::string& html, const std::string& text) {
    std::size_t times = 0;
    for (std::size_t at = html.find(text); at != std::string::npos; at = html.find(text, at + 1)) {
        ++times;
    }
    return times;
}

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::vector<std::string> all;
    for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) {
        all.push_back((*at)[1]);
    }
    return all;
}

TEST(AuditPage, AnswersTenQuestions) {
    const std::string html = page_of({test::sample_audit()});
    const std::string text = html_text(html);
    for (const char* heading : {"1 What was audited", "2 Equation of the measurement", "3 Contributions by share",
                                "4 Contributors that every budget has", "5 Claimed against recomputed",
                                "6 Expanded uncertainty and capability", "7 Law of propagation against Monte Carlo",
                                "8 Findings with the largest effect", "9 Deviations that somebody accepted",
                                "10 Questions to the laboratory"}) {
        EXPECT_THAT(text, HasSubstr(heading));
    }
    EXPECT_THAT(text, HasSubstr("U 1.3 → 1.5 µm U understated (+13.5 %) Verdict: pass → fail"));
    EXPECT_THAT(text, HasSubstr("E = l_ind - l_gb + L α Δθ"));
    EXPECT_THAT(text, HasSubstr("parallelism of the faces maximum permissible error 0.4 µm – – 0.400 36.8 U10"));
    EXPECT_THAT(text, HasSubstr("Reproducibility no row, no reason"));
    EXPECT_THAT(text, HasSubstr("0.66 0.648 … 0.670 0.659 0.750"));
    EXPECT_THAT(text, Not(HasSubstr("outside of the interval")));
    EXPECT_THAT(text, HasSubstr("B05 all A. N. 2026-03-04 one operator"));
    EXPECT_THAT(text, HasSubstr("S05 Law of propagation not validated the file has no formulas"));
    EXPECT_THAT(text, HasSubstr(std::string(64, 'a')));
}

TEST(AuditPage, MarksAClaimThatTheRowsDoNotAllow) {
    audit::AuditSubject subject;
    subject.budgets = {test::sample_audited_budget()};
    subject.budgets[0].claims.u_c = test::printed_number("0.60", "row 9");
    EXPECT_THAT(html_text(page_of({audit::audit(std::move(subject), test::sample_rules())})),
                HasSubstr("0.648 … 0.670 outside of the interval"));
}

TEST(AuditPage, SumsWhatIsBeyondTheTenthRow) {
    audit::AuditSubject subject;
    subject.budgets = {test::sample_audited_budget()};
    for (std::size_t i = 8; i < 14; ++i) {
        subject.budgets[0].rows.push_back(test::sample_row(i, "small " + std::to_string(i), "0.001",
                                                           audit::Contributor::other,
                                                           std::numeric_limits<double>::infinity(), ""));
    }
    const std::string text = html_text(page_of({audit::audit(std::move(subject), test::sample_rules())}));
    EXPECT_THAT(text, HasSubstr("4 others"));
    EXPECT_THAT(text, HasSubstr("small 13")) << "every row is in the tree";
}

TEST(AuditPage, IsWellFormedWithOrderedHeadingsAndNamedTables) {
    for (const std::string& html :
         {page_of({test::sample_audit()}), page_of({test::sample_audit(), test::sample_audit_of_points()}, "de")}) {
        EXPECT_EQ(nesting_problem(html), "");
        int level = 0;
        for (const std::string& tag : tags_of(html)) {
            if (tag.size() == 2 && tag[0] == 'h' && tag[1] >= '1' && tag[1] <= '6') {
                EXPECT_LE(tag[1] - '0', level + 1) << tag;
                level = tag[1] - '0';
            }
        }
        EXPECT_EQ(all_matches(html, "<(h1)>").size(), 1U);
        EXPECT_EQ(all_matches(html, "<(table)[ >]").size(), all_matches(html, "<(caption)[ >]").size());
        EXPECT_EQ(all_matches(html, "<(th)[ >]").size(), all_matches(html, "<th scope=\"(row|col)\"[ >]").size());
        const std::vector<std::string> ids = all_matches(html, " id=\"([^\"]*)\"");
        const std::set<std::string> unique(ids.begin(), ids.end());
        EXPECT_EQ(unique.size(), ids.size());
        for (const std::string& target : all_matches(html, " href=\"#([^\"]*)\"")) {
            EXPECT_TRUE(unique.contains(target)) << target;
        }
    }
}

TEST(AuditPage, LoadsNothingAndRunsItsOwnScriptOnly) {
    const std::string html = page_of({test::sample_audit(), test::sample_audit_of_points()});
    ASSERT_EQ(all_matches(html, "<(script)").size(), 1U);
    const std::size_t begin = html.find("<script>") + 8;
    const std::string script = html.substr(begin, html.find("</script>") - begin);
    EXPECT_THAT(html, HasSubstr("script-src 'sha256-" + encoding::base64(encoding::sha256_bytes(script)) + "'"));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
    for (const char* loads : {" src=", "url(", "@import", "href=\"http", "href=\"//", "<link", "<iframe"}) {
        EXPECT_THAT(html, Not(HasSubstr(loads)));
    }
    EXPECT_TRUE(all_matches(html, " (on[a-z]+)=\"").empty());
}

TEST(AuditPage, ShowsHostileTextsAsTexts) {
    const std::size_t elements = tags_of(page_of({test::hostile_audit("x")})).size();
    for (const std::string& hostile : test::hostile_strings()) {
        const std::string html = page_of({test::hostile_audit(hostile)});
        const std::vector<std::string> tags = tags_of(html);
        EXPECT_EQ(nesting_problem(tags), "") << hostile;
        EXPECT_EQ(tags.size(), elements) << hostile;
        EXPECT_THAT(html, Not(HasSubstr("\u202E"))) << hostile;
        EXPECT_EQ(times_in(html, "<script>") + times_in(html, "<script "), 1U) << hostile;
    }
}

TEST(AuditPage, HasFourLanguagesAndSaysWhatStaysEnglish) {
    const std::string german = page_of({test::sample_audit(), test::sample_audit_of_points()}, "de");
    EXPECT_THAT(german, HasSubstr("<html lang=\"de\">"));
    EXPECT_THAT(html_text(german), HasSubstr("U 1,3 → 1,5 µm U zu klein angegeben (+13,5 %)"));
    EXPECT_THAT(german, HasSubstr("<span lang=\"en\">Certificate uncertainty divided by the wrong number</span>"));
    EXPECT_THAT(german, HasSubstr(">2,0</text>")) << "the plot has the decimal sign of the language";
    const std::string english = page_of({test::sample_audit()});
    EXPECT_THAT(english, Not(HasSubstr("<span lang=\"en\"")));
    for (const char* language : {"es", "zh-Hant"}) {
        const std::string html = page_of({test::sample_audit()}, language);
        EXPECT_THAT(html, HasSubstr("<html lang=\"" + std::string(language) + "\">"));
        EXPECT_THAT(html, Not(HasSubstr("{{")));
        EXPECT_THAT(html_text(html), Not(HasSubstr("understated")));
    }
}

TEST(AuditPage, ShowsAFileWithoutABudget) {
    audit::AuditSubject subject;
    subject.name = "empty.csv";
    const std::string html = page_of({audit::audit(std::move(subject), test::sample_rules())});
    EXPECT_EQ(nesting_problem(html), "");
    EXPECT_THAT(html_text(html), HasSubstr("No uncertainty budget with a result was found"));
}

TEST(AuditPage, LeavesTheTreesOfQuietResultsOut) {
    audit::AuditSubject subject;
    subject.name = "many.csv";
    for (int i = 0; i < 30; ++i) {
        subject.budgets.push_back(test::sample_audited_budget("point " + std::to_string(i)));
    }
    const std::string html = page_of({audit::audit(std::move(subject), test::sample_rules())});
    EXPECT_EQ(all_matches(html, "<details (class=\"result\")").size(), 24U);
    EXPECT_THAT(html_text(html), HasSubstr("The 6 results that change least"));
}

TEST(AuditPage, HasTheSameBytesEveryTime) {
    EXPECT_EQ(page_of({test::sample_audit_of_points()}), page_of({test::sample_audit_of_points()}));
}

}  // namespace
}  // namespace gumcert::reports
