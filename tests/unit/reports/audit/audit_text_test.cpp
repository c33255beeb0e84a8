#include "reports/audit/audit_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "reports/forms/asset_files.h"
#include "reports/forms/text_columns.h"
#include "tests/support/hostile_strings.h"
#include "tests/support/sample_audit.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string terminal_text(const std::vector<audit::AuditReport>& reports, const std::string& language = "en",
                          bool verbose = false) {
    RenderAssets in = assets();
    in.languages = {language};
    const Wording wording = read_audit_wording(in);
    return audit_as_text(make_audit_view(reports, test::sample_rules(), {.program = "gumcert 0.1.0"}), wording,
                         verbose);
}

TEST(AuditText, SaysWhatTheCorrectionsDoAndInWhichDirection) {
    const std::string text = squeezed(terminal_text({test::sample_audit()}));
    EXPECT_THAT(text, HasSubstr("critical 1, major 1, minor 1, information 0"));
    EXPECT_THAT(text, HasSubstr("U 1.3 → 1.5 µm (+13.5 %): U understated; verdict pass → fail; Eₙ 1.06 → 0.95"));
    EXPECT_THAT(text, HasSubstr("critical: U13 Certificate uncertainty divided by the wrong number"));
    EXPECT_THAT(text, HasSubstr("U 1.3 → 1.2 µm (−12.7 %): U overstated"));
    EXPECT_THAT(text, HasSubstr("JCGM 100:2008, 4.3.3 (not held against the document)"));
    EXPECT_THAT(text, HasSubstr("changes the printed U from u = 0.13 µm on"));
    EXPECT_LT(text.find("U13"), text.find("U10")) << "the gravest first";
    EXPECT_LT(text.find("U10"), text.find("Questions to the laboratory"));
}

TEST(AuditText, MarksWhatSomebodyAccepts) {
    audit::AuditReport report = test::sample_audit();
    EXPECT_THAT(squeezed(terminal_text({report})), Not(HasSubstr("Accepted by")));
    report.subject.waivers = {
        {.finding = "U10", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "The maker states it so."}};
    const std::string text = squeezed(terminal_text({report}));
    const std::size_t accepted = text.find("Accepted by A. N., 2026-03-04: The maker states it so.");
    ASSERT_NE(accepted, std::string::npos) << text;
    EXPECT_LT(text.find(": U10"), accepted);
    EXPECT_EQ(text.find("Accepted by", accepted + 1), std::string::npos) << "no other finding";
}

TEST(AuditText, CountsWhatWasNotCheckedAndNamesItWhereAsked) {
    EXPECT_THAT(squeezed(terminal_text({test::sample_audit()})),
                HasSubstr("Rules not checked: 2. --verbose lists them."));
    EXPECT_THAT(terminal_text({test::sample_audit()}), Not(HasSubstr("T01")));
    EXPECT_THAT(squeezed(terminal_text({test::sample_audit()}, "en", true)),
                HasSubstr("T01 Calibration of a standard expired: no certificate data are stated"));
}

TEST(AuditText, HasWordsAndDecimalSignsOfItsLanguage) {
    const std::string german = squeezed(terminal_text({test::sample_audit()}, "de"));
    EXPECT_THAT(german,
                HasSubstr("U 1,3 → 1,5 µm (+13,5 %): U zu klein angegeben; Urteil bestanden → nicht bestanden"));
    for (const char* language : {"es", "zh-Hant"}) {
        EXPECT_THAT(terminal_text({test::sample_audit()}, language), Not(HasSubstr("understated")));
    }
}

TEST(AuditText, NamesTheResultOfAnEffectWhereThereAreSeveral) {
    EXPECT_THAT(squeezed(terminal_text({test::sample_audit_of_points()})),
                HasSubstr("Alone deviation at 10 mm: U 1.1 → 1.5 µm"));
}

TEST(AuditText, FitsAPageWhateverAFileHolds) {
    std::vector<audit::AuditReport> reports = {test::sample_audit(), test::sample_audit_of_points()};
    for (const std::string& hostile : test::hostile_strings()) {
        reports.push_back(test::hostile_audit(hostile));
    }
    for (const char* language : {"en", "zh-Hant"}) {
        std::istringstream lines(terminal_text(reports, language, true));
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(width(line), 100U) << line;
            for (const char c : line) {
                EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 || c == '\x7F') << line;
            }
        }
    }
}

TEST(AuditText, ABudgetWithoutFindingsIsNotPraised) {
    audit::AuditSubject subject;
    subject.name = "quiet.csv";
    subject.budgets = {test::sample_audited_budget()};
    const std::string text = squeezed(terminal_text({audit::audit(std::move(subject), {})}));
    EXPECT_THAT(text, HasSubstr("No finding. That does not say that the budget is right"));
    EXPECT_THAT(text, HasSubstr("U unchanged as printed"));
}

}  // namespace
}  // namespace gumcert::reports
