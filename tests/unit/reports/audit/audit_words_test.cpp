#include "reports/audit/audit_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "audit/checklists.h"
#include "audit/rules/registry.h"
#include "reports/forms/asset_files.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

class AuditWordsIn : public ::testing::Test {
protected:
    AuditWords in(const std::string& language) {
        RenderAssets from = assets();
        from.languages = {language};
        wording_ = std::make_unique<Wording>(read_audit_wording(from));
        return AuditWords(*wording_);
    }

private:
    std::unique_ptr<Wording> wording_;
};

PrintedOutcome with_U(const std::string& U, const std::string& verdict = "", const std::string& En = "") {
    PrintedOutcome outcome;
    outcome.U = U;
    outcome.verdict = verdict;
    outcome.En = En;
    return outcome;
}

TEST_F(AuditWordsIn, SayAChangeInOneLine) {
    const Change change{.relative = 0.24, .percent = "+24.0", .direction = "understated", .verdict_turns = true};
    EXPECT_EQ(in("en").change(with_U("0.50", "pass", "0.91"), with_U("0.62", "fail", "1.10"), change, "µm"),
              "U 0.50 → 0.62\u00A0µm (+24.0 %): U understated; verdict pass → fail; Eₙ 0.91 → 1.10");
    EXPECT_EQ(in("de").change(with_U("0.50"), with_U("0.62"), {.percent = "-24.0", .direction = "overstated"}, ""),
              "U 0,50 → 0,62 (−24,0 %): U zu groß angegeben");
}

TEST_F(AuditWordsIn, HaveATitleOfTheirOwnForEveryRule) {
    for (const char* language : {"de", "es", "zh-Hant"}) {
        const AuditWords words = in(language);
        std::map<std::string, std::string> rule_of_title;
        for (const audit::Rule& rule : audit::all_rules()) {
            const std::string english(rule.title);
            const AuditSentence title = words.sentence(english);
            EXPECT_FALSE(title.english) << rule.id << " " << language << ": " << title.text;
            EXPECT_FALSE(title.text.empty()) << rule.id << " " << language;
            const auto [other, is_new] = rule_of_title.emplace(title.text, rule.id);
            EXPECT_TRUE(is_new) << rule.id << " has the title of " << other->second << " in " << language;
        }
        EXPECT_GE(rule_of_title.size(), 139U);
    }
}

/// Asks for what a rule advises or asks in each language; two rules say the same only where they do in English.
void expect_worded(const AuditWords& words, std::string_view audit::Rule::*said) {
    std::map<std::string, std::string> english_of;
    for (const audit::Rule& rule : audit::all_rules()) {
        const std::string english(rule.*said);
        const AuditSentence worded = words.sentence(english);
        EXPECT_FALSE(english.empty()) << rule.id;
        EXPECT_FALSE(worded.english) << rule.id << " " << words.language() << ": " << worded.text;
        EXPECT_FALSE(worded.text.empty()) << rule.id << " " << words.language();
        EXPECT_EQ(english_of.emplace(worded.text, english).first->second, english)
            << rule.id << " " << words.language();
    }
    EXPECT_GE(english_of.size(), 136U);
}

TEST_F(AuditWordsIn, WordWhatEveryRuleAdvisesAndAsks) {
    for (const char* language : {"de", "es", "zh-Hant"}) {
        const AuditWords words = in(language);
        expect_worded(words, &audit::Rule::correction);
        expect_worded(words, &audit::Rule::question);
    }
}

TEST_F(AuditWordsIn, WordWhatAFindingSaysInPlaceOfItsRule) {
    for (const char* language : {"de", "es", "zh-Hant"}) {
        const AuditWords words = in(language);
        for (const char* own : {"Call the row a resolution, and add the repeatability from readings, with its ν.",
                                "From how many readings does the repeatability come?",
                                "Which exponent does the data sheet of the machine state, and in which unit is L?",
                                "Is the age of the calibration meant in days, months or years?"}) {
            EXPECT_FALSE(words.sentence(own).english) << language << ": " << own;
        }
    }
}

TEST_F(AuditWordsIn, SayASentenceByItsPattern) {
    const audit::Sentence said = audit::say("{done}; the certificate states k = {k:number}",
                                            audit::say("U is divided by {divisor:number}", "1.732"), "2.5");
    EXPECT_EQ(in("en").said(said).text, "U is divided by 1.732; the certificate states k = 2.5");
    EXPECT_EQ(in("de").said(said).text, "U ist durch 1,732 geteilt; der Kalibrierschein gibt k = 2,5 an");
    EXPECT_EQ(in("es").said(said).text, "U se divide por 1,732; el certificado declara k = 2,5");
    EXPECT_EQ(in("zh-Hant").said(said).text, "U 除以 1.732；校正報告載明 k = 2.5");
    EXPECT_FALSE(in("zh-Hant").said(said).english);
}

TEST_F(AuditWordsIn, ShowNumbersOfASentenceAsTheLanguageDoes) {
    EXPECT_EQ(in("de").said(audit::equals("ν", "infinite")).text, "ν = ∞");
    EXPECT_EQ(in("de").said(audit::equals("c", "-0.5 µm/K")).text, "c = −0,5 µm/K");
    EXPECT_EQ(in("en").said(audit::equals("ν", "infinite")).text, "ν = infinite");
    EXPECT_EQ(in("de").said(audit::say("source {name}", "version 1.2")).text, "Quelle version 1.2")
        << "a name is no number";
}

TEST_F(AuditWordsIn, SayItInEnglishAsAWholeWhereAPartHasNoTranslation) {
    const audit::Sentence unknown("no such pattern {a}", {audit::Sentence("x")});
    for (const audit::Sentence& sentence :
         {unknown, audit::say("{said}, ν = {nu:number}", unknown, "4.5"),
          audit::say("{cell}: not evaluated here ({reason:sentence}); the value that the file stored is taken", "B2",
                     "for a reason of its own")}) {
        const AuditSentence german = in("de").said(sentence);
        EXPECT_TRUE(german.english);
        EXPECT_EQ(german.text, sentence.english());
        EXPECT_FALSE(in("en").said(sentence).english);
    }
    EXPECT_EQ(
        in("de")
            .said(audit::say("{cell}: not evaluated here ({reason:sentence}); the value that the file stored is taken",
                             "B2", "a circular reference"))
            .text,
        "B2: hier nicht ausgewertet (ein Zirkelbezug); es gilt der Wert, den die Datei gespeichert hat");
}

TEST_F(AuditWordsIn, SayWhatGatesFoundByTheCatalogueOfTheProgram) {
    const AuditSentence said = in("de").said(audit::say("{finding:sentence}", "Let another person review."));
    EXPECT_EQ(said.text, "Lassen Sie eine andere Person prüfen.");
    EXPECT_FALSE(said.english);
    const AuditSentence name = in("de").said(audit::Sentence("=A1/12"));
    EXPECT_EQ(name.text, "=A1/12");
    EXPECT_FALSE(name.english) << "a text without a pattern is no English sentence";
}

TEST_F(AuditWordsIn, NameEveryContributorOfTheChecklists) {
    for (const char* language : {"de", "es", "zh-Hant"}) {
        const AuditWords words = in(language);
        for (const audit::MethodChecklist& checklist : audit::method_checklists()) {
            EXPECT_FALSE(words.said(checklist.title).english) << checklist.method;
            for (const audit::RequiredContributor& required : checklist.required) {
                EXPECT_FALSE(words.said(required.name).english) << required.name.english();
            }
        }
        for (const audit::RequiredContributor& required : audit::minimum_contributors()) {
            EXPECT_FALSE(words.said(required.name).english) << required.name.english();
        }
    }
}

TEST_F(AuditWordsIn, KeepATitleOfTheEnglishWordsInEnglish) {
    for (const audit::Rule& rule : audit::all_rules()) {
        const AuditSentence title = in("en").sentence(std::string(rule.title));
        EXPECT_EQ(title.text, rule.title);
        EXPECT_FALSE(title.english) << rule.id;
    }
}

TEST_F(AuditWordsIn, PrintWhatIsAbsentAsADash) {
    const AuditWords words = in("en");
    EXPECT_EQ(words.number(""), "–");
    EXPECT_EQ(words.with_unit("", "µm"), "–");
    EXPECT_EQ(words.verdict(""), "–");
    EXPECT_EQ(words.verdict("conditional_pass"), "conditional pass");
    EXPECT_EQ(words.verdict("OK"), "OK") << "as a file states it";
    EXPECT_EQ(words.interval({.number = {}, .low = "1.2", .high = "1.2"}), "1.2");
    EXPECT_EQ(words.interval({.number = {}, .low = "1.2", .high = "∞"}), "1.2 … ∞");
}

TEST_F(AuditWordsIn, SayTheScoreAlsoWhereItStays) {
    AuditedFileView file;
    file.results.resize(2);
    file.results[1].name = "displacement";
    file.results[1].unit = "µm";
    EffectView effect;
    effect.claimed = with_U("0.26", "", "0.50");
    effect.alone = with_U("0.27", "", "0.50");
    effect.change_alone = {.percent = "+3.8", .direction = "understated"};
    effect.result = 1;
    EXPECT_EQ(in("en").effect_on_score(effect, file),
              "displacement: U 0.26 → 0.27\u00A0µm (+3.8 %): U understated; Eₙ 0.50 → 0.50");
    effect.alone.En = "0.49";
    EXPECT_EQ(in("de").effect_on_score(effect, file),
              "displacement: U 0,26 → 0,27\u00A0µm (+3,8 %): U zu klein angegeben; Eₙ 0,50 → 0,49");
}

TEST_F(AuditWordsIn, SayWhatAMissingContributionWouldHaveToBe) {
    const AuditWords words = in("en");
    EXPECT_EQ(
        words.missing_term({.number = {}, .u_for_digit = "0.13", .u_for_verdict = "", .unit = "µm"}),
        "The missing contribution changes the printed U from u = 0.13\u00A0µm on. No size of it changes a decision.");
    EXPECT_EQ(
        words.missing_term({.number = {}, .u_for_digit = "0.13", .u_for_verdict = "0.2", .unit = ""}),
        "The missing contribution changes the printed U from u = 0.13 on. It changes the decision from u = 0.2 on.");
}

TEST_F(AuditWordsIn, TellAClauseThatNobodyLookedUp) {
    const AuditWords words = in("en");
    AuditFindingView finding;
    EXPECT_EQ(words.clause(finding), "");
    finding.clause = "JCGM 100:2008, 4.3.7";
    EXPECT_EQ(words.clause(finding), "JCGM 100:2008, 4.3.7 (not held against the document)");
    finding.clause_verified = true;
    EXPECT_EQ(words.clause(finding), "JCGM 100:2008, 4.3.7");
}

TEST_F(AuditWordsIn, GiveANumberOrAReasonForAContributor) {
    const AuditWords words = in("en");
    ContributorView contributor;
    EXPECT_EQ(words.contributor_text(contributor, "µm"), "no row, no reason");
    contributor.rows = {"drift"};
    EXPECT_EQ(words.contributor_text(contributor, "µm"), "0, no reason");
    contributor.reason = "none seen";
    EXPECT_EQ(words.contributor_text(contributor, "µm"), "0: none seen");
    contributor.contribution = 0.28;
    contributor.contribution_text = "0.280";
    contributor.share_percent = "18.1";
    EXPECT_EQ(words.contributor_text(contributor, "µm"), "0.280\u00A0µm (18.1 %)");
}

TEST_F(AuditWordsIn, MarkASentenceThatStaysEnglish) {
    EXPECT_FALSE(in("en").sentence("no such sentence").english);
    const AuditSentence german = in("de").sentence("no such sentence");
    EXPECT_TRUE(german.english);
    EXPECT_EQ(german.text, "no such sentence");
    EXPECT_FALSE(in("de").sentence("").english);
}

TEST_F(AuditWordsIn, NameCoverageAndMethod) {
    const AuditWords words = in("en");
    AuditedResultView result;
    result.coverage = "fixed";
    result.stated_k = "2";
    EXPECT_EQ(words.coverage(result), "a fixed number, k = 2");
    result.coverage = "student_t";
    result.coverage_probability = "95.45";
    EXPECT_EQ(words.coverage(result), "the t-distribution with ν_eff, 95.45 %");
    AuditedFileView file;
    EXPECT_EQ(words.method(file, result), "not stated");
    result.method = "micrometer";
    EXPECT_EQ(words.method(file, result), "micrometer");
    result.method = "Digital multimeter";
    EXPECT_EQ(words.method(file, result), "Digital multimeter");
    file.method = "QM-7 (3)";
    EXPECT_EQ(words.method(file, result), "QM-7 (3)");
    EXPECT_EQ(in("de").method({}, result), "Digitalmultimeter");
}

TEST(Enumerated, SeparatesBySemicolons) {
    EXPECT_EQ(enumerated({}), "");
    EXPECT_EQ(enumerated({"a", "b"}), "a; b");
}

}  // namespace
}  // namespace gumcert::reports
