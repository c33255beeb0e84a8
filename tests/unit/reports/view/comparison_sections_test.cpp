#include "gum/quantity/diagnostic.h"
#include "reports/forms/render.h"
#include "reports/record/record_value.h"
#include "reports/view/certificate_view.h"
#include "tests/support/hostile_strings.h"
#include "tests/support/sample_comparison_record.h"
#include "tests/unit/reports/document_text.h"
#include "tests/unit/reports/view_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> k_languages = {"en", "de", "zh-Hant", "es"};
const std::vector<std::string> k_verdicts = {"disagreement",
                                             "side_refuted",
                                             "falls_with_finding",
                                             "points_above_1",
                                             "joint_test_open",
                                             "correlation_unknown",
                                             "reference_not_better",
                                             "uncertainty_too_large",
                                             "agreement_few_points",
                                             "uncertainty_not_confirmed",
                                             "agreement_reference_limited",
                                             "validated",
                                             ""};

json comparison_wording(const std::string& language) {
    std::ifstream file(assets().templates / "wording" / (language + ".json"));
    return json::parse(file);
}

RenderAssets in(const std::string& language) {
    RenderAssets a = assets();
    a.languages = {language};
    return a;
}

json view_of_comparison(const EvaluationRecord& record, const std::string& language = "en") {
    return certificate_view(record, Wording(comparison_wording(language)));
}

std::string text_of_comparison(const EvaluationRecord& record, const std::string& language = "en") {
    return squeezed(render_text(record, in(language)));
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

std::vector<std::string> sections_of_comparison(const json& view) {
    std::vector<std::string> ids;
    for (const json& section : view["sections"]) {
        ids.push_back(section["id"]);
    }
    return ids;
}

/// One item and this many laboratories.
EvaluationRecord one_item(std::size_t laboratories) {
    EvaluationRecord record = test::sample_laboratories_record(laboratories);
    Comparison& c = *record.comparison;
    c.items.resize(1);
    std::erase_if(c.points, [&](const ComparisonPoint& p) { return p.item != c.items[0].id; });
    c.youden.clear();
    c.vectors.clear();
    return record;
}

EvaluationRecord with_verdicts(const std::vector<std::string>& verdicts) {
    EvaluationRecord record = test::sample_methods_record();
    for (std::size_t i = 0; i < record.comparison->summary.size(); ++i) {
        record.comparison->summary[i].verdict = verdicts[std::min(i, verdicts.size() - 1)];
    }
    return record;
}

std::vector<EvaluationRecord> samples() {
    return {test::sample_laboratories_record(), one_item(6), test::sample_methods_record()};
}

/// Text of the first page: the section with the answer.
std::string answer_of(const EvaluationRecord& record, const std::string& language = "en") {
    const std::string text = text_of_comparison(record, language);
    const json words = comparison_wording(language);
    const std::size_t end = text.find(
        words["heading"][record.comparison->form == "laboratories" ? "how_to_read" : "companion"].get<std::string>());
    EXPECT_NE(end, std::string::npos);
    return text.substr(0, end);
}

TEST(ComparisonReport, FirstPageSaysWhatTheSignOfADifferenceMeansAndWhatUStandsFor) {
    for (const EvaluationRecord& record : samples()) {
        for (const std::string& language : k_languages) {
            const std::string answer = answer_of(record, language);
            EXPECT_THAT(answer, HasSubstr("D = x")) << language;
            EXPECT_THAT(answer, HasSubstr("U = k u")) << language;
        }
    }
    EXPECT_THAT(answer_of(one_item(6)), HasSubstr("D = x − X, result minus assigned value"));
    EvaluationRecord record = test::sample_methods_record();
    record.coverage_probability.text = "95.45 %";
    EXPECT_THAT(answer_of(record), HasSubstr(squeezed("D = x − X, " + record.comparison->method_name + " minus " +
                                                      record.comparison->reference_name)));
    EXPECT_THAT(answer_of(record), HasSubstr("coverage probability of 95.45 %"));
}

TEST(ComparisonReport, FirstPageSaysWhichProbabilityUOfADifferenceHas) {
    for (EvaluationRecord record : samples()) {
        record.coverage_probability.text = "95.45 %";
        record.comparison->score_probability = 0.9545;
        EXPECT_THAT(answer_of(record), Not(HasSubstr("Expanded uncertainties of differences")));
        record.coverage_probability.text = "99.00 %";
        EXPECT_THAT(answer_of(record), HasSubstr(squeezed("Expanded uncertainties of differences for a coverage "
                                                          "probability of 95.45 %, as Eₙ takes them")));
        for (const std::string& language : k_languages) {
            EXPECT_THAT(answer_of(record, language),
                        HasSubstr(language == "de" || language == "es" ? "95,45" : "95.45"))
                << language;
        }
    }
}

TEST(ComparisonReport, NamesTheLimitOfThePowerThatDecides) {
    // gum::k_least_power_to_confirm is 0.92.
    EvaluationRecord record = test::sample_methods_record();
    record.comparison->summary[0].power_to_confirm = {0.905, "90.5 %"};
    for (const std::string& language : k_languages) {
        EXPECT_THAT(text_of_comparison(record, language), HasSubstr(" 92 %")) << language;
    }
}

TEST(ComparisonReport, FirstPageNamesTheAssignedValueWhoseFactorIsNotTaken) {
    EvaluationRecord record = one_item(6);
    for (ComparisonPoint& point : record.comparison->points) {
        point.U_of_scores = {};
    }
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.method = "given";
    item.reference_participant = "";
    item.U_rests_on = "statement";
    item.U_of_scores = {};
    EXPECT_THAT(answer_of(record), Not(HasSubstr("in place of their U")));
    item.U_of_scores = {0.13, "0.13"};
    EXPECT_THAT(answer_of(record), HasSubstr("The coverage factor of the assigned value is that of another"));
    EXPECT_THAT(answer_of(record), Not(HasSubstr("factors of X")));
    item.U_rests_on = "scatter";
    EXPECT_THAT(answer_of(record), Not(HasSubstr("in place of their U")));
}

/// U is read with ν wherever it is finite, whatever the value rests on.
TEST(ComparisonReport, DegreesOfFreedomStandBesideTheFactorOfAnAssignedValue) {
    EvaluationRecord record = one_item(6);
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.k = {2.2, "2.20"};
    for (const std::string rests_on : {"scatter", "uncertainties", "statement"}) {
        item.U_rests_on = rests_on;
        item.nu = {11.4, "11.4"};
        EXPECT_THAT(answer_of(record), HasSubstr("k = 2.20, ν = 11.4")) << rests_on;
        item.nu = {};
        EXPECT_THAT(answer_of(record), Not(HasSubstr("ν = 11.4"))) << rests_on;
    }
}

TEST(ComparisonReport, FirstPageSaysWhatIsStatedOfTheArtefact) {
    EvaluationRecord record = one_item(6);
    record.comparison->artefact_stability = "drift below 5 nm in two years, in u(X)";
    for (const std::string& language : k_languages) {
        EXPECT_THAT(text_of_comparison(record, language), HasSubstr("drift below 5 nm in two years, in u(X)"))
            << language;
    }
}

TEST(ComparisonReport, FirstPageSaysHowTheAssignedValueWasFoundAndWhoReportedNothing) {
    EvaluationRecord record = one_item(6);
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.method = "q_hampel";
    item.reference_participant = "";
    item.missing = {"Lab 99"};
    EXPECT_THAT(answer_of(record), HasSubstr("(Q method with Hampel estimator)"));
    EXPECT_THAT(answer_of(record), HasSubstr("Without a result Lab 99"));

    EvaluationRecord several = test::sample_laboratories_record();
    const auto rows = rows_of(view_of_comparison(several), "assigned-values");
    ASSERT_EQ(rows.size(), several.comparison->items.size());
    EXPECT_THAT(rows[0], Contains(HasSubstr(several.comparison->items[0].value.text)));
}

TEST(ComparisonReport, TestOfASubsetNamesThoseOutsideIt) {
    EvaluationRecord record = one_item(6);
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.method = "largest_consistent_subset";
    item.consistency = ConsistencySummary{};
    item.consistency->consistent = true;
    item.not_consistent.clear();
    EXPECT_THAT(answer_of(record), HasSubstr("Consistency consistent: "));
    item.not_consistent = {"Lab 3"};
    EXPECT_THAT(answer_of(record), HasSubstr("consistent without Lab 3: "));
}

TEST(ComparisonReport, FirstPageSaysThatAnIndependentValueContradictsTheConsensus) {
    EvaluationRecord record = one_item(6);
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.consensus = ConsensusCheck{};
    item.consensus->consistent = true;
    EXPECT_THAT(answer_of(record), Not(HasSubstr("contradict each other: they differ")));
    item.consensus->consistent = false;
    EXPECT_THAT(answer_of(record), HasSubstr("the independent reference value contradict each other: they differ"));
    item.consensus.reset();
    EXPECT_THAT(answer_of(record), Not(HasSubstr("contradict each other: they differ")));
}

TEST(ComparisonReport, TheTestSaysThatItHoldsTheUncertaintyOfTheItems) {
    EvaluationRecord record = one_item(6);
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.consistency = ConsistencySummary{};
    EXPECT_THAT(text_of_comparison(record), Not(HasSubstr("the uncertainty of the items")));
    item.consistency->u_items = {0.25, "0.25"};
    EXPECT_THAT(text_of_comparison(record), HasSubstr("the uncertainty of the items, 0.25"));
}

TEST(ComparisonReport, FirstPageNamesResultsWhoseAgreementIsOpen) {
    EvaluationRecord record = one_item(6);
    for (ComparisonPoint& p : record.comparison->points) {
        p.En_worst.number = std::nullopt;
    }
    ComparisonPoint& p = record.comparison->points[1];
    EXPECT_THAT(answer_of(record), Not(HasSubstr("cannot be said")));
    p.En.number = 0.8;
    p.En_worst.number = -1.3;
    EXPECT_THAT(answer_of(record), HasSubstr("above 1 for " + p.participant + " as well"));
    p.En.number = 1.1;  // then it has a signal already
    EXPECT_THAT(answer_of(record), Not(HasSubstr("cannot be said")));
}

TEST(ComparisonReport, UnroundedNumbersHaveTheirUnitsAndTheFormulasThatUseThem) {
    EvaluationRecord record = one_item(6);
    record.comparison->unit = "degC";
    record.comparison->items[0].difference_unit = "K";
    const json table = block(view_of_comparison(record), "table", "unrounded");
    std::vector<std::string> heads;
    for (const json& column : table["columns"]) {
        heads.push_back(column["head"].get<std::string>() +
                        (column["unit"].empty() ? "" : "/" + column["unit"][0]["text"].get<std::string>()));
    }
    EXPECT_THAT(heads, ::testing::IsSupersetOf({"x/°C", "u(x)/K", "k"}));
    EXPECT_THAT(text_of_comparison(record), HasSubstr("U²(D) = U²(x) + U²(X) − 2 r U(x) U(X)"));
}

TEST(ComparisonReport, DifferencesOfMethodsInCelsiusAreKelvin) {
    EvaluationRecord record = test::sample_methods_record();
    record.comparison->unit = "degC";
    const json table = block(view_of_comparison(record), "table", "comparison-points");
    std::map<std::string, std::string> unit;
    for (const json& column : table["columns"]) {
        unit[column["head"]] = column["unit"].empty() ? "" : column["unit"][0]["text"].get<std::string>();
    }
    EXPECT_EQ(unit["Measured x"], "°C");
    EXPECT_EQ(unit["U(x)"], "K");
    EXPECT_EQ(unit["Reference X"], "°C");
    EXPECT_EQ(unit["U(X)"], "K");
    EXPECT_EQ(unit["U(D)"], "K");
}

TEST(ComparisonReport, ItemsHaveOneNameEverywhere) {
    EvaluationRecord record = test::sample_laboratories_record();
    Comparison& c = *record.comparison;
    for (ComparisonItemEvaluation& item : c.items) {
        item.name = "solution " + item.id;
    }
    ASSERT_FALSE(c.youden.empty());
    c.youden[0].round = "2";
    EXPECT_THAT(html_text(render_html(record, in("en"))),
                HasSubstr("Deviations for solution " + c.youden[0].first_item + ", round 2"));
    EXPECT_THAT(text_of_comparison(record),
                HasSubstr("line of equal deviations"));  // no empty section where there is no drawing
    for (const auto& row : rows_of(view_of_comparison(record), "unrounded")) {
        EXPECT_THAT(row[0], ::testing::StartsWith("solution "));
    }
}

TEST(ComparisonReport, MissingTestOfConsistencyIsNotLaidToResultsThatHaveUncertainties) {
    EvaluationRecord record = one_item(6);
    record.comparison->items[0].consistency = std::nullopt;  // one of many contributing results states no uncertainty
    EXPECT_THAT(text_of_comparison(record), HasSubstr("a stated uncertainty of each of these"));
}

TEST(ComparisonReport, SummaryOfPointsDoesNotCallChanceADisagreement) {
    for (const std::string& language : k_languages) {
        EXPECT_THAT(comparison_wording(language)["sentence"]["comparison_summary"].get<std::string>(), HasSubstr("20"))
            << language;
    }
}

TEST(ComparisonReport, IsNoCertificate) {
    for (const EvaluationRecord& record : samples()) {
        for (const std::string& language : k_languages) {
            const json words = comparison_wording(language)["document"];
            const std::string html = render_html(record, in(language));
            const std::string text = text_of_comparison(record, language);
            for (const char* key : {"type", "mark", "mark_reason", "end_mark", "only_items", "draft"}) {
                EXPECT_THAT(html, Not(HasSubstr(words[key].get<std::string>()))) << language << " " << key;
                EXPECT_THAT(text, Not(HasSubstr(words[key].get<std::string>()))) << language << " " << key;
            }
            EXPECT_THAT(html_text(html), HasSubstr(words["comparison_type"].get<std::string>()));
            EXPECT_THAT(html_text(html), HasSubstr(words["comparison_end_mark"].get<std::string>()));
        }
        const std::string english = lower(render_text(record, in("en")));
        EXPECT_THAT(english, Not(HasSubstr("certificate")));
        EXPECT_THAT(english, Not(HasSubstr("specimen")));
        const json view = view_of_comparison(record);
        EXPECT_TRUE(view["mark"].empty());
        EXPECT_TRUE(view["identity"].empty());
        EXPECT_THAT(view["header_right"].get<std::string>(), HasSubstr("Comparison report"));
        EXPECT_THAT(lower(view["footer_left"].get<std::string>()), Not(HasSubstr("certificate")));
    }
}

TEST(ComparisonReport, BeginsWithTheAnswer) {
    for (const EvaluationRecord& record : samples()) {
        const json section = view_of_comparison(record)["sections"][0];
        EXPECT_EQ(section["id"], "answer");
        EXPECT_FALSE(section["blocks"][0]["paragraph"].empty()) << "the verdict comes first";
        const auto has = [&](const char* kind) {
            return std::any_of(section["blocks"].begin(), section["blocks"].end(),
                               [&](const json& b) { return !b[kind].empty(); });
        };
        EXPECT_TRUE(has("figure"));
        EXPECT_TRUE(has("table"));
        EXPECT_THAT(section.dump(), HasSubstr(record.comparison->organiser));
    }
}

TEST(ComparisonReport, SaysWhoIssuedItAndWhen) {
    EvaluationRecord record = one_item(6);
    certificate::LocalisedText laboratory;
    laboratory.by_language = {{"de", "Beispiel-Institut"}, {"en", "Example Metrology Institute"}};
    record.comparison->issuer = ComparisonIssuer{laboratory, "KC-14", "2026-11-21"};
    const json view = view_of_comparison(record, "de");
    EXPECT_EQ(view["header_left"], "Beispiel-Institut");
    EXPECT_EQ(view["header_right"], "Vergleichsbericht KC-14");
    EXPECT_EQ(view["created"]["year"], "2026");
    EXPECT_EQ(view["created"]["month"], "11");
    EXPECT_THAT(view["sections"][0].dump(), HasSubstr("2026-11-21"));
    record.job_json = R"({"certificate": {"number": "OTHER", "dates": {"issued": "2020-01-01"}}})";
    EXPECT_THAT(view_of_comparison(record)["header_right"].get<std::string>(), HasSubstr("KC-14"))
        << "no document reads the job";
    record.comparison->issuer.reset();
    EXPECT_EQ(view_of_comparison(record)["header_right"], "Comparison report");
    EXPECT_EQ(view_of_comparison(record)["created"]["year"], "1970");
}

TEST(ComparisonReport, SaysOnEveryPageThatItIsSuperseded) {
    EvaluationRecord record = one_item(6);
    record.comparison->issuer = ComparisonIssuer{certificate::LocalisedText("Institute"), "KC-14", "2026-11-21"};
    const json issued = view_of_comparison(record);
    EXPECT_THAT(issued["mark"], testing::IsEmpty());
    record.comparison->issuer->superseded_by = "KC-14/A1";
    json superseded = view_of_comparison(record);
    EXPECT_EQ(superseded["header_right"], "Comparison report KC-14 · SUPERSEDED by KC-14/A1");
    ASSERT_EQ(superseded["mark"].size(), 1U);
    EXPECT_EQ(superseded["mark"][0]["text"], "SUPERSEDED by KC-14/A1");
    EXPECT_EQ(superseded["mark"][0]["reason"],
              "A later report amends or replaces this one. It must no longer be used.");
    superseded["mark"] = issued["mark"];
    superseded["header_right"] = issued["header_right"];
    EXPECT_EQ(superseded, issued) << "nothing else is another";
    EXPECT_EQ(to_json_value(record).dump().find("KC-14/A1"), std::string::npos) << "in no record";
}

TEST(ComparisonReport, ANameOfABudgetDoesNotTellWhoseItIs) {
    EvaluationRecord record = one_item(6);
    Comparison& c = *record.comparison;
    c.names_released = false;
    c.budget_files = {{c.participants[1].id, "smith/steel.json"}, {c.participants[2].id, "meyer.json"}};
    record.job_files = {{.name = "job.json", .sha256 = "1"},
                        {.name = "smith/steel.json", .sha256 = "2"},
                        {.name = "meyer-indicator.csv", .sha256 = "3"},
                        {.name = "meyer.json", .sha256 = "4"}};
    record.diagnostics = {{.code = "GC-COMPARE-0100",
                           .where = "smith/steel.json#/inputs/L",
                           .what = "meyer.json says otherwise than smith/steel.json",
                           .rule = "",
                           .action = "",
                           .severity = gum::Severity::warning}};
    for (const std::string& language : k_languages) {
        const std::string printed = view_of_comparison(record, language).dump();
        for (const char* name : {"smith", "meyer", "steel.json"}) {
            EXPECT_THAT(printed, Not(HasSubstr(name))) << language;
        }
    }
    const std::string printed = view_of_comparison(record).dump();
    EXPECT_THAT(printed, HasSubstr("budget of " + c.participants[1].id));
    EXPECT_THAT(printed, HasSubstr("budget of " + c.participants[2].id));
    EXPECT_THAT(printed, HasSubstr("file 3"));
    c.names_released = true;
    EXPECT_THAT(view_of_comparison(record).dump(), HasSubstr("meyer-indicator.csv"));
}

TEST(ComparisonReport, HoldsEveryPrintedNumberOfTheResults) {
    const EvaluationRecord record = test::sample_laboratories_record();
    const json view = view_of_comparison(record);
    for (std::size_t i = 0; i < record.comparison->items.size(); ++i) {
        const ComparisonItemEvaluation& item = record.comparison->items[i];
        const auto rows = rows_of(view, "results-" + std::to_string(i + 1));
        std::size_t at = 0;
        for (const ComparisonPoint& p : record.comparison->points) {
            if (p.item != item.id) {
                continue;
            }
            const auto or_absent = [](const std::string& text) { return text.empty() ? "–" : text; };
            EXPECT_THAT(rows[at],
                        ElementsAre(p.participant, p.value.text, or_absent(p.U.text), or_absent(p.k.text), p.D.text,
                                    or_absent(p.U_D.text), p.D_percent.text, p.P_A.text, or_absent(p.zeta.text),
                                    or_absent(p.En.text), p.z.text, p.z_prime.text, p.signal));
            ++at;
        }
        EXPECT_EQ(at, rows.size());
        const std::string text = text_of_comparison(record);
        for (const std::string& printed :
             {item.value.text, item.u.text, item.U.text, item.u_characterisation.text, item.u_homogeneity.text,
              item.u_stability.text, item.sigma_pt.text, item.delta_E.text, item.s_star.text,
              item.consistency->chi_square.text, item.consistency->critical_value.text,
              item.consistency->birge_ratio.text, item.homogeneity->limit.text, item.stability->limit.text}) {
            EXPECT_THAT(text, HasSubstr(" " + printed)) << printed;
        }
        for (const ReferenceEstimate& e : item.estimates) {
            EXPECT_THAT(text, HasSubstr(e.value.text + " " + e.u.text));
        }
    }
}

TEST(ComparisonReport, HoldsEveryPrintedNumberOfThePoints) {
    const EvaluationRecord record = test::sample_methods_record();
    const json view = view_of_comparison(record);
    const auto rows = rows_of(view, "comparison-points");
    ASSERT_EQ(rows.size(), record.comparison->points.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const ComparisonPoint& p = record.comparison->points[i];
        EXPECT_THAT(rows[i], ElementsAre(p.name, p.direction, p.printed_angle, p.value.text, p.U.text,
                                         p.reference_value.text, p.reference_U.text, p.D.text, p.U_D.text, p.En.text,
                                         p.En_worst.text, p.En_audited.text));
    }
    const auto companions = rows_of(view, "companion");
    const auto& s = record.comparison->summary;
    const auto row = [&](const std::string& name, auto text) {
        std::vector<std::string> cells = {name};
        for (const ComparisonSummary& one : s) {
            cells.push_back(text(one));
        }
        EXPECT_THAT(companions, Contains(cells)) << name;
    };
    row("mean |Eₙ|", [](const auto& one) { return one.mean_abs_En.text; });
    row("mean |Eₙ|, published", [](const auto& one) { return one.published_mean_abs_En.text; });
    row("95 % band of rms Eₙ", [](const auto& one) { return one.rms_En_low.text + " – " + one.rms_En_high.text; });
    row("p_low", [](const auto& one) { return one.p_low.text; });
    row("p_high", [](const auto& one) { return one.p_high.text; });
    row("D_fail, smallest / µm", [](const auto& one) { return one.D_fail.text; });
    row("Effective number of points", [](const auto& one) { return one.effective_points.text; });
    row("vector Eₙ", [](const auto& one) { return one.vector_En.text; });
    row("largest |Eₙ|, worst plausible r", [](const auto& one) { return one.max_abs_En_worst.text; });
    row("mean |Eₙ|, audited", [](const auto& one) { return one.mean_abs_En_audited.text; });
    ASSERT_TRUE(s[0].bias);
    EXPECT_THAT(rows_of(view, "bias")[0], ElementsAre(s[0].direction, s[0].bias->centre.text, s[0].bias->constant.text,
                                                      s[0].bias->U_constant.text, s[0].bias->slope.text,
                                                      s[0].bias->U_slope.text, s[0].bias->p_value.text));
}

/// A reader who looks for the word must find it only where it is meant, in any form of the word.
TEST(ComparisonReport, SaysValidatedForThatVerdictOnly) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> k_words = {
        {"en", {"validat"}},
        {"de", {"validier"}},
        {"zh-Hant", {"驗證", "確證", "確效"}},
        {"es", {"validad", "validac"}}};
    for (const auto& [language, stems] : k_words) {
        const std::string said = comparison_wording(language)["comparison_verdict_name"]["validated"];
        EXPECT_THAT(said, HasSubstr(stems[0]));
        for (const std::string& verdict : k_verdicts) {
            const EvaluationRecord record = with_verdicts({verdict});
            const std::string html = lower(html_text(render_html(record, in(language))));
            const std::string text = lower(text_of_comparison(record, language));
            if (verdict == "validated") {
                EXPECT_THAT(html, HasSubstr(said)) << language;
                EXPECT_THAT(text, HasSubstr(said)) << language;
                continue;
            }
            for (const std::string& stem : stems) {
                EXPECT_THAT(html, Not(HasSubstr(stem))) << language << " " << verdict;
                EXPECT_THAT(text, Not(HasSubstr(stem))) << language << " " << verdict;
            }
        }
        for (const EvaluationRecord& record : {test::sample_laboratories_record(), one_item(6)}) {
            EXPECT_THAT(lower(text_of_comparison(record, language)), Not(HasSubstr(stems[0]))) << language;
        }
    }
}

TEST(ComparisonReport, OneDirectionAloneValidatesNothing) {
    for (const std::string& objection : k_verdicts) {
        if (objection == "validated" || objection.empty()) {
            continue;
        }
        for (const std::vector<std::string>& verdicts :
             {std::vector<std::string>{"validated", "validated", objection},
              std::vector<std::string>{objection, "validated", "validated"}}) {
            const EvaluationRecord record = with_verdicts(verdicts);
            for (const std::string& language : k_languages) {
                const json words = comparison_wording(language);
                const std::string text = text_of_comparison(record, language);
                EXPECT_THAT(text, Not(HasSubstr(words["comparison_verdict_name"]["validated"].get<std::string>())))
                    << language << " " << objection;
                EXPECT_THAT(
                    text, HasSubstr(words["comparison_verdict_name"]["no_objection"].get<std::string>().substr(0, 9)));
            }
        }
    }
}

TEST(ComparisonReport, TheGravestObjectionIsTheVerdict) {
    const auto first = [](const EvaluationRecord& record) {
        return view_of_comparison(record)["sections"][0]["blocks"][0]["paragraph"][0]["text"].get<std::string>();
    };
    EXPECT_THAT(first(with_verdicts({"uncertainty_too_large", "reference_not_better", "validated"})),
                HasSubstr("the reference is not better than the method"));
    EXPECT_THAT(first(with_verdicts({"reference_not_better", "disagreement"})), HasSubstr("disagree"));
    EXPECT_THAT(first(with_verdicts({"correlation_unknown", "reference_not_better"})),
                HasSubstr("Whether they agree cannot be said"));
    EXPECT_THAT(first(with_verdicts({"correlation_unknown", "points_above_1"})),
                HasSubstr("Agreement at these points and that the uncertainties are right are not shown"));
    EXPECT_THAT(first(with_verdicts({"agreement_few_points", "agreement_reference_limited", "validated"})),
                HasSubstr("Whether the uncertainty of the method is right cannot be told"));
    EXPECT_THAT(first(with_verdicts({"joint_test_open", "validated"})), HasSubstr("cannot be told"));
    EvaluationRecord falls = with_verdicts({"falls_with_finding", "points_above_1"});
    falls.comparison->summary[0].verdict_audited = "disagreement";
    EXPECT_THAT(first(falls), HasSubstr("the verdict is “disagreement”"));
    for (const auto& [by, sentence] :
         {std::pair{"pattern", "do not vary together"}, {"bias", "a constant or a slope"}}) {
        EvaluationRecord record = with_verdicts({"disagreement"});
        for (ComparisonSummary& s : record.comparison->summary) {
            s.verdict_by = by;
        }
        EXPECT_THAT(first(record), HasSubstr(sentence));
    }
    EXPECT_THAT(first(with_verdicts({""})), HasSubstr("do not allow a verdict"));
    EvaluationRecord scatter = with_verdicts({"disagreement"});
    for (ComparisonSummary& s : scatter.comparison->summary) {
        s.count_above_1 = 0;
        s.p_high.text = "0.004";
    }
    EXPECT_THAT(first(scatter), HasSubstr("p_high = 0.004"));
}

TEST(ComparisonReport, AWorstEnWithoutALimitIsSaid) {
    for (const std::string& language : k_languages) {
        const json words = comparison_wording(language);
        EvaluationRecord record = with_verdicts({"correlation_unknown"});
        for (ComparisonSummary& s : record.comparison->summary) {
            s.max_abs_En_worst = {std::nullopt, "∞"};
        }
        const std::string without_limit =
            words["comparison_verdict"]["correlation_unknown_without_limit"].get<std::string>();
        const std::string said = without_limit.substr(without_limit.find("{largest}") + 9);
        // Without blanks: lines break anywhere between ideographs.
        const auto without_blanks = [](std::string text) {
            std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
            return text;
        };
        EXPECT_THAT(without_blanks(text_of_comparison(record, language)), HasSubstr(without_blanks(said))) << language;
        EXPECT_THAT(text_of_comparison(record, language), HasSubstr("∞")) << language << ": the table";
        for (ComparisonSummary& s : record.comparison->summary) {
            s.max_abs_En_worst = {3.04, "3.04"};
        }
        EXPECT_THAT(text_of_comparison(record, language), Not(HasSubstr(squeezed(said)))) << language;
    }
}

// A corrected comparison that shows no disagreement does not refute the agreement, but the proof of it.
TEST(ComparisonReport, WhatFallsWithAFindingIsNamed) {
    const auto first = [](const std::string& corrected) {
        EvaluationRecord record = with_verdicts({"falls_with_finding"});
        for (ComparisonSummary& s : record.comparison->summary) {
            s.verdict_audited = corrected;
        }
        return view_of_comparison(record)["sections"][0]["blocks"][0]["paragraph"][0]["text"].get<std::string>();
    };
    for (const std::string& verdict : k_verdicts) {
        if (verdict.empty() || verdict == "validated" || verdict == "side_refuted" || verdict == "falls_with_finding") {
            continue;
        }
        const bool objects = verdict == "disagreement" || verdict == "points_above_1" || verdict == "joint_test_open";
        EXPECT_THAT(first(verdict), HasSubstr(objects ? "The agreement does not stand" : "The confirmation does not"))
            << verdict;
        EXPECT_EQ(first(verdict).find("find the cause of the differences") != std::string::npos, objects) << verdict;
    }
}

TEST(ComparisonReport, TestsAreSaidInBothDirections) {
    EvaluationRecord record = one_item(6);
    EXPECT_THAT(text_of_comparison(record), HasSubstr("The results that went into the test are consistent"));
    EXPECT_THAT(text_of_comparison(record), HasSubstr("This is a rule of thumb"));
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.consistency->consistent = false;
    item.homogeneity->sufficient = item.homogeneity->sufficient_expanded = false;
    item.stability->stable = false;
    item.consensus->consistent = false;
    item.criterion_met = false;
    const std::string text = text_of_comparison(record);
    EXPECT_THAT(text, HasSubstr("The results that went into the test are not consistent"));
    EXPECT_THAT(text, HasSubstr("not homogeneous enough"));
    EXPECT_THAT(text, HasSubstr("sufficiently stable by the expanded criterion only"));
    EXPECT_THAT(text, HasSubstr("The cause must be found before the scores are used."));
    EXPECT_THAT(text, HasSubstr("above 0.3: the uncertainty of the assigned value is not negligible"));
    EXPECT_THAT(text, Not(HasSubstr("The results that went into the test are consistent")));
}

TEST(ComparisonReport, SaysWhatIsAbsentWhereAReaderLooksForIt) {
    EvaluationRecord record = one_item(6);
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.traceability.clear();
    item.consistency.reset();
    item.homogeneity.reset();
    item.stability.reset();
    item.consensus.reset();
    item.pairs.clear();
    item.method = "algorithm_a";
    record.comparison->organiser.clear();
    record.comparison->shared_sources.clear();
    const std::string text = text_of_comparison(record);
    EXPECT_THAT(text, HasSubstr("traceable only as far as these results are"));
    EXPECT_THAT(text, HasSubstr("The consistency of the results was not tested"));
    EXPECT_THAT(text, HasSubstr("no data on the homogeneity and stability"));
    EXPECT_THAT(text, HasSubstr("Organiser –"));
    EXPECT_THAT(text, Not(HasSubstr("Independent reference value")));
    EXPECT_THAT(text, Not(HasSubstr("Degrees of equivalence of pairs")));
    item.method = "reference";
    item.reference_participant = "L001";
    EXPECT_THAT(text_of_comparison(record), HasSubstr("that of the result of L001"));

    EvaluationRecord methods = test::sample_methods_record();
    for (ComparisonSummary& s : methods.comparison->summary) {
        s.bias.reset();
        s.p_low.number.reset();
        s.p_low.text.clear();
    }
    const std::string without = text_of_comparison(methods);
    EXPECT_THAT(without, HasSubstr("No bias line was fitted"));
    EXPECT_THAT(without, Not(HasSubstr("p_low ")));
}

TEST(ComparisonReport, ScoresDecideTheWords) {
    EvaluationRecord record = one_item(6);
    Comparison& c = *record.comparison;
    const auto first = [&] {
        return view_of_comparison(record)["sections"][0]["blocks"][0]["paragraph"][0]["text"].get<std::string>();
    };
    for (ComparisonPoint& p : c.points) {
        p.signal = "none";
    }
    EXPECT_THAT(first(), HasSubstr("none of 5 scored results differs"));
    EXPECT_THAT(first(), HasSubstr("This does not say that the uncertainties are right."));
    c.points[1].signal = "action";
    EXPECT_THAT(first(), HasSubstr("1 of 5 scored results differ"));
    EXPECT_THAT(first(), HasSubstr(": L002."));
    c.items[0].score = "z_prime";
    c.points[2].signal = "warning";
    EXPECT_THAT(first(), HasSubstr("1 of 5 scored results calls for action (|z′| ≥ 3): L002. Warnings (|z′| > 2): 1."));
    c.points[1].signal = "none";
    EXPECT_THAT(first(), HasSubstr("1 gives a warning (|z′| > 2): L003."));
    c.items[0].score = "D";
    c.points[2].signal = "action";
    EXPECT_THAT(first(), HasSubstr("largest error allowed"));
    c.items[0].score = "";
    EXPECT_THAT(first(), HasSubstr("no score can be formed"));
}

TEST(ComparisonReport, ThePairsAreListedDrawnOrBoth) {
    const auto view = [](std::size_t laboratories) { return view_of_comparison(one_item(laboratories)); };
    EXPECT_EQ(rows_of(view(6), "pairs-1")[0].size(), 5U);  // i, j, d, U, E_n
    const auto matrix = rows_of(view(12), "pairs-1");      // two of the twelve have no uncertainty or no result
    ASSERT_EQ(matrix.size(), 10U);
    EXPECT_EQ(matrix[0].size(), 11U);
    const PairEquivalence pair = one_item(12).comparison->items[0].pairs[0];
    EXPECT_EQ(matrix[0][2], pair.En.text);
    EXPECT_TRUE(block(view(20), "table", "pairs-1").is_null());
    for (const std::size_t laboratories : {6U, 12U, 20U}) {
        EXPECT_FALSE(block(view(laboratories), "figure", "plot-pairs-1").is_null());
    }
}

TEST(ComparisonReport, PairsSayThatTheyHoldTheUncertaintyOfTheItems) {
    EvaluationRecord record = one_item(6);
    ComparisonItemEvaluation& item = record.comparison->items[0];
    item.u_homogeneity.number = std::nullopt;
    item.u_stability.number = std::nullopt;
    EXPECT_THAT(text_of_comparison(record), Not(HasSubstr("of pairs hold the uncertainty of both items")));
    item.u_homogeneity.number = 0.1;
    EXPECT_THAT(text_of_comparison(record), HasSubstr("of pairs hold the uncertainty of both items"));
}

TEST(ComparisonReport, LongNamesAreNoHeadsOfColumns) {
    EvaluationRecord record = one_item(12);
    for (PairEquivalence& pair : record.comparison->items[0].pairs) {
        pair.first = "Calibration Laboratory " + pair.first;
        pair.second = "Calibration Laboratory " + pair.second;
    }
    const json view = view_of_comparison(record);
    const auto rows = rows_of(view, "pairs-1");
    EXPECT_EQ(rows[0][0], "1: Calibration Laboratory L001");
    EXPECT_EQ(rows[9][0], "10: Calibration Laboratory L012");
    EXPECT_EQ(rows[0][2], record.comparison->items[0].pairs[0].En.text);
    const json columns = block(view, "table", "pairs-1")["columns"];
    EXPECT_EQ(columns[1]["head"], "1");
    EXPECT_EQ(columns[10]["head"], "10");
}

TEST(ComparisonReport, APlotThatShowsNothingIsLeftOut) {
    EvaluationRecord record = test::sample_methods_record();
    EXPECT_FALSE(block(view_of_comparison(record), "figure", "plot-values").is_null());
    for (ComparisonPoint& p : record.comparison->points) {
        p.value.number += 1e6;  // no difference can be seen beside it
        p.reference_value.number += 1e6;
    }
    const json view = view_of_comparison(record);
    EXPECT_TRUE(block(view, "figure", "plot-values").is_null());
    EXPECT_FALSE(block(view, "table", "comparison-points").is_null());
    for (const json& section : view["sections"]) {
        for (const json& entry : section["blocks"]) {
            EXPECT_TRUE(entry["figure"].empty() || entry["figure"][0]["svg"] != "");
        }
    }
}

TEST(ComparisonReport, NumbersToRecomputeAreUnrounded) {
    const EvaluationRecord record = one_item(6);
    const auto rows = rows_of(view_of_comparison(record), "unrounded");
    ASSERT_EQ(rows.size(), record.comparison->points.size());
    EXPECT_EQ(std::stod(rows[0][1]), record.comparison->points[0].value.number);
    EXPECT_EQ(std::stod(rows[0][2]), *record.comparison->points[0].u);
    EXPECT_EQ(rows_of(view_of_comparison(record), "unrounded-weights")[0].back(), "0.1");
    const EvaluationRecord methods = test::sample_methods_record();
    const auto reference = rows_of(view_of_comparison(methods), "unrounded-reference");
    ASSERT_EQ(reference.size(), methods.comparison->points.size());
    const std::string& last = reference.back()[3];  // U+2212 is the minus sign of documents
    EXPECT_EQ(std::stod(last.starts_with("\u2212") ? "-" + last.substr(3) : last),
              methods.comparison->points.back().reference_value.number);
    const json large = view_of_comparison(one_item(150));
    EXPECT_TRUE(block(large, "table", "unrounded").is_null());
    EXPECT_THAT(text_of_comparison(one_item(150)),
                HasSubstr("of all 149 results are in the files comparison.csv and record.json"));
}

TEST(ComparisonReport, OfManyLaboratoriesItShowsThoseWithSignals) {
    EvaluationRecord record = one_item(500);
    std::vector<ComparisonPoint>& points = record.comparison->points;
    std::vector<double> magnitudes;
    for (const ComparisonPoint& p : points) {
        if (p.signal == "action") {
            magnitudes.push_back(std::abs(*p.En.number));
        }
    }
    std::sort(magnitudes.rbegin(), magnitudes.rend());
    ASSERT_EQ(magnitudes.size(), 330U);
    const json view = view_of_comparison(record);
    EXPECT_EQ(rows_of(view, "scores").size(), 24U) << "the first page stays one page";
    const auto rows = rows_of(view, "results-1");
    ASSERT_EQ(rows.size(), 200U);
    std::size_t at = 0;
    for (const ComparisonPoint& p : points) {  // the 200 largest, in the order of the record
        if (p.signal == "action" && std::abs(*p.En.number) >= magnitudes[199]) {
            EXPECT_EQ(rows.at(at++)[0], p.participant);
        }
    }
    EXPECT_THAT(text_of_comparison(record),
                HasSubstr("Of 499 rows 357 have a signal or an open judgement; the table shows the 200"));
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].signal = i == 17 || i == 230 ? "action" : "none";
        points[i].En_worst.number = std::nullopt;  // an open judgement is shown as well
    }
    EXPECT_EQ(rows_of(view_of_comparison(record), "results-1").size(), 2U);
    EXPECT_THAT(text_of_comparison(record),
                HasSubstr("Of 499 rows the table shows 2 with a signal or an open judgement."));
    points[17].signal = points[230].signal = "none";
    EXPECT_TRUE(block(view_of_comparison(record), "table", "scores").is_null());
    EXPECT_THAT(text_of_comparison(record), HasSubstr("none of them has a signal or an open judgement"));
}

TEST(ComparisonReport, ItsSizeHasALimit) {
    // 20 times as many laboratories may add a few names, but no rows.
    const std::size_t few = render_html(one_item(500), in("en")).size();
    const std::size_t many = render_html(one_item(10000), in("en")).size();
    EXPECT_LT(many, few + 400000U);
    EvaluationRecord items = one_item(3);
    const ComparisonItemEvaluation item = items.comparison->items[0];
    const std::vector<ComparisonPoint> points = items.comparison->points;
    for (int i = 0; i < 1000; ++i) {
        items.comparison->items.push_back(item);
        items.comparison->items.back().id = "X" + std::to_string(i);
        for (ComparisonPoint p : points) {
            p.item = items.comparison->items.back().id;
            items.comparison->points.push_back(std::move(p));
        }
    }
    const json view = view_of_comparison(items);
    EXPECT_THAT(text_of_comparison(items), HasSubstr("Of 1001 items the 24 that matter most"));
    EXPECT_EQ(rows_of(view, "items").size(), 200U);
}

TEST(ComparisonReport, SectionsStandInTheirOrder) {
    EXPECT_THAT(
        sections_of_comparison(view_of_comparison(test::sample_laboratories_record())),
        ElementsAre("answer", "how_to_read", "comparison_remarks", "item-1", "item-2", "participants", "vectors",
                    "youden", "comparison_correlations", "recompute", "identification", "messages", "input"));
    EXPECT_THAT(sections_of_comparison(view_of_comparison(test::sample_methods_record())),
                ElementsAre("answer", "companion", "comparison_remarks", "bias", "comparison_budgets", "points",
                            "recompute", "identification", "messages", "input"));
}

/// A record with one text in every place that a user fills.
EvaluationRecord with_text(EvaluationRecord record, const std::string& text) {
    Comparison& c = *record.comparison;
    record.title = c.organiser = c.method_name = c.reference_name = c.position_name = c.audit_finding = text;
    c.published_source = text;
    c.issuer = ComparisonIssuer{certificate::LocalisedText(text), text, text};
    c.remarks = {text};
    for (ComparisonItemEvaluation& item : c.items) {
        item.name = item.traceability = item.reference_participant = text;
        item.not_contributing = item.missing = {text};
    }
    for (ComparisonPoint& p : c.points) {
        p.reason = text;
        p.name = text;
    }
    for (ParticipantSummary& p : c.participants) {
        p.name = p.group = text;
    }
    for (SharedSource& s : c.shared_sources) {
        s.source = s.first = s.second = text;
    }
    for (VectorScore& v : c.vectors) {
        v.name = text;
    }
    return record;
}

TEST(ComparisonReport, TextsOfUsersStayTexts) {
    for (const EvaluationRecord& sample : {one_item(6), test::sample_methods_record()}) {
        const std::string plain = render_html(with_text(sample, "Smith"), in("en"));
        // U is italic in a drawing, whoever wrote it.
        const auto tags = [](const std::string& html) {
            std::ptrdiff_t spans = 0;
            for (std::size_t at = html.find("tspan"); at != std::string::npos; at = html.find("tspan", at + 1)) {
                ++spans;
            }
            return std::count(html.begin(), html.end(), '<') - spans;
        };
        for (const std::string& hostile : test::hostile::markup()) {
            EXPECT_EQ(tags(render_html(with_text(sample, hostile), in("en"))), tags(plain)) << hostile;
        }
    }
}

TEST(ComparisonReport, HoldsStringsOnlyAndIsTheSameTwice) {
    for (const EvaluationRecord& record : samples()) {
        const json view = view_of_comparison(record);
        for (const json& leaf : view.flatten()) {
            EXPECT_TRUE(leaf.is_string() || leaf.empty());
        }
        EXPECT_EQ(view_of_comparison(record).dump(), view.dump());
    }
}

TEST(ComparisonReport, ATextThatIsMissingIsAnError) {
    json words = comparison_wording("en");
    words["comparison_verdict"].erase("reference_not_better");
    EXPECT_THROW(static_cast<void>(certificate_view(with_verdicts({"reference_not_better"}), Wording(words))),
                 gum::StorageError);
}

TEST(ComparisonReport, PdfHasTheNumbersOfTheTable) {
    SKIP_WITHOUT_PDF();
    const EvaluationRecord record = one_item(6);
    const std::string text = pdf_text(render_pdf(record, in("en")));
    if (text.empty()) {
        GTEST_SKIP() << "pdftotext is missing: the numbers of the PDF were not read back";
    }
    for (const ComparisonPoint& p : record.comparison->points) {
        if (p.En.number) {
            EXPECT_THAT(text, HasSubstr(" " + p.participant + " " + p.value.text + " " + p.U.text + " " + p.D.text +
                                        " " + p.U_D.text + " " + p.En.text + " "));
        }
    }
    EXPECT_THAT(text, HasSubstr("End of comparison report"));
    EXPECT_THAT(lower(text), Not(HasSubstr("certificate")));
}

TEST(ComparisonReport, PdfHasNoPageOfAFewLines) {
    SKIP_WITHOUT_PDF();
    RenderAssets a = assets();
    a.languages = {"en", "de"};
    for (const std::size_t laboratories : {5U, 12U, 24U, 60U}) {
        const std::string text = pdf_text(render_pdf(one_item(laboratories), a));
        if (text.empty()) {
            GTEST_SKIP() << "pdftotext is missing: the pages of the PDF were not read back";
        }
        const auto page_ends = [&](std::size_t page) { return text.find("page " + std::to_string(page) + " of "); };
        const std::size_t second = page_ends(1);
        ASSERT_NE(page_ends(2), std::string::npos);
        // Where the answer needs more than its page, the report goes on behind it.
        EXPECT_THAT(text.substr(second, page_ends(2) - second), HasSubstr("How to read the scores")) << laboratories;
        // The last sentence never stands alone.
        const std::size_t last = text.find("End of comparison report");
        ASSERT_NE(last, std::string::npos);
        std::size_t pages = 1;
        while (page_ends(pages) < last) {
            ++pages;
        }
        const std::size_t from = page_ends(pages - 1);
        EXPECT_THAT(text.substr(from, last - from), HasSubstr("Input data")) << laboratories;
    }
}

TEST(ReferenceComparisonSection, HoldsVerdictAndCompanionNumbers) {
    EvaluationRecord record = test::sample_record();
    Comparison& c = *record.comparison;
    const json old =
        view_of_comparison(record);  // as an earlier release evaluated it: without verdict and companion numbers
    EXPECT_EQ(rows_of(old, "comparison-summary").size(), 5U);
    EXPECT_TRUE(block(old, "table", "bias").is_null());
    EXPECT_THAT(text_of_comparison(record), Not(HasSubstr("do not allow a verdict")));

    const std::vector<ComparisonSummary> from = test::sample_methods_record().comparison->summary;
    for (std::size_t i = 0; i < c.summary.size(); ++i) {
        const std::string direction = c.summary[i].direction;
        c.summary[i] = from[0];
        c.summary[i].direction = direction;
        c.summary[i].verdict = "reference_not_better";
    }
    const json view = view_of_comparison(record);
    const auto rows = rows_of(view, "comparison-summary");
    ASSERT_EQ(rows[0].size(), c.summary.size() + 1);
    EXPECT_GT(rows.size(), 12U);
    EXPECT_EQ(rows_of(view, "bias").size(), c.summary.size());
    EXPECT_THAT(text_of_comparison(record), HasSubstr("the reference is not better than the method"));
    EXPECT_EQ(view["type"], "Calibration certificate");
    EXPECT_THAT(text_of_comparison(record), Not(HasSubstr("Expanded uncertainties of differences")));
    ASSERT_FALSE(c.points.empty());
    c.points[0].U_of_scores = {0.12, "0.12"};
    EXPECT_THAT(text_of_comparison(record),
                HasSubstr(squeezed("Expanded uncertainties of differences for a coverage probability "
                                   "of 95.45 %, as Eₙ takes them")));
}

}  // namespace
}  // namespace gumcert::reports
