#include "reports/view/certificate_statement_sections.h"

#include "reports/forms/asset_files.h"
#include "reports/plots/certified_plots.h"
#include "reports/view/certificate_view.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using certificate::CertifiedValue;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using SectionMaker = std::function<void(CertificateBuilder&, const Wording&, const EvaluationRecord&)>;

json sections_of(const EvaluationRecord& record, const SectionMaker& make, const std::string& language = "en") {
    const json texts = json::parse(read_asset(assets().templates / "wording" / (language + ".json")));
    const Wording words(texts);
    CertificateBuilder builder(words);
    make(builder, words, record);
    return builder.take();
}

std::vector<std::string> ids_of(const json& sections) {
    std::vector<std::string> ids;
    for (const json& section : sections) {
        ids.push_back(section.at("id").get<std::string>());
    }
    return ids;
}

/// All texts of a section: paragraphs, definitions "label=value", tables with their heads.
std::string text_of(const json& sections, const std::string& id) {
    std::string text;
    for (const json& section : sections) {
        if (section.at("id") != id) {
            continue;
        }
        for (const json& block : section.at("blocks")) {
            for (const json& p : block.at("paragraph")) {
                text += p.at("text").get<std::string>() + "\n";
            }
            for (const json& d : block.at("definitions")) {
                for (const json& row : d.at("rows")) {
                    text += row.at("label").get<std::string>() + "=" + row.at("value").get<std::string>() + "\n";
                }
            }
            for (const json& table : block.at("table")) {
                std::string heads = table.at("caption").get<std::string>() + "\n";
                for (const json& column : table.at("columns")) {
                    heads += column.at("head").get<std::string>();
                    for (const json& unit : column.at("unit")) {
                        heads += "/" + unit.at("text").get<std::string>();
                    }
                    heads += "|";
                }
                text += heads + "\n";
                for (const json& row : table.at("rows")) {
                    for (const json& cell : row.at("cells")) {
                        text += cell.at("text").get<std::string>() + "|";
                    }
                    text += "\n";
                }
            }
        }
    }
    return text;
}

/// A certificate of values of one quantity at points, by hand.
EvaluationRecord of_values(const std::vector<CertifiedValue>& values) {
    EvaluationRecord record = test::certified_budget_record();
    record.coverage_probability.text = "95.45 %";
    certificate::CertifiedTable& table = record.certificate->tables.front();
    certificate::CertifiedColumn& column = table.columns.front();
    column.values = values;
    table.argument = {.name = "point", .unit = "", .printed_unit = "", .values = {}, .printed = {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
        table.argument->values.emplace_back(std::nullopt);
        table.argument->printed.push_back("P" + std::to_string(i + 1));
    }
    return record;
}

CertifiedValue value(const std::string& coverage, const std::string& k, std::optional<double> nu_eff) {
    CertifiedValue v = test::certified_value(1.0, 0.1, 2.0, nu_eff, {.value = "1.00", .U = "0.20", .unit = "nm"}, "L1");
    v.coverage = coverage;
    v.printed_k = k;
    return v;
}

std::string statement(const EvaluationRecord& record) {
    return text_of(sections_of(record, closing_sections), "statement_of_uncertainty");
}

std::string results(const EvaluationRecord& record) {
    return text_of(sections_of(record, result_sections), "certified_results");
}

TEST(CertificateStatement, HasTheSectionsInOrder) {
    EvaluationRecord record = test::certified_rotary_record();
    EXPECT_THAT(ids_of(sections_of(record, method_sections)), ElementsAre("method_used", "traceability", "conditions"));
    record.certificate->data.opinions = {test::sample_opinion()};
    record.certificate->data.external_results = {{.results = {"EXA"}, .provider = "Example Partner Laboratory"}};
    record.certificate->data.amendment =
        certificate::Amendment{.kind = "replaced",
                               .number = "EX-2026-0041",
                               .sha256 = "",
                               .reason = "typing error",
                               .changes = {certificate::LocalisedText("serial number corrected")}};
    const json closing = sections_of(record, closing_sections);
    EXPECT_THAT(ids_of(closing),
                ElementsAre("statement_of_uncertainty", "conformity", "remarks", "opinions", "external", "amendment"));
    EXPECT_THAT(text_of(closing, "opinions"), HasSubstr("They are not within the scope of accreditation."));
    EXPECT_THAT(text_of(closing, "opinions"), HasSubstr("Author=Head of laboratory, Head of laboratory"));
    EXPECT_THAT(text_of(closing, "external"), HasSubstr("provided by Example Partner Laboratory: EXA."));
    EXPECT_THAT(text_of(closing, "amendment"),
                HasSubstr("This certificate replaces calibration certificate EX-2026-0041.\nReason=typing error\n"
                          "Changes=serial number corrected"));
}

// By what the table prints, as all sentences do: "E[2]" is the point of a job.
TEST(CertificateStatement, NamesWhatAnotherLaboratoryProvidedByTheRows) {
    EvaluationRecord record = test::certified_rotary_record();
    certificate::CertifiedTable table;
    table.id = "results";
    table.argument.emplace().name = "point";
    table.argument->printed = {"1", "2"};
    table.argument->values.resize(2);
    certificate::PointColumn setting;
    setting.name = setting.role = "setting";
    setting.printed_unit = "V";
    setting.printed = {"10", "20"};
    setting.values = {10.0, 20.0};
    table.layout.emplace().columns = {setting};
    certificate::CertifiedColumn column;
    column.result = "E";
    column.values.resize(2);
    for (CertifiedValue& one : column.values) {
        one.printed_value = "1";
    }
    table.columns = {column};
    record.certificate->tables = {table};
    const auto sentence = [&](const std::vector<std::string>& results) {
        record.certificate->data.external_results = {{.results = results, .provider = "Example Partner Laboratory"}};
        return text_of(sections_of(record, closing_sections), "external");
    };
    EXPECT_THAT(sentence({"E[2]"}), HasSubstr("Laboratory: E[20\u00A0V]."));
    EXPECT_THAT(sentence({"E[1]", "E[2]"}), HasSubstr("Laboratory: E."));
    EXPECT_THAT(sentence({"E"}), HasSubstr("Laboratory: E."));
    EXPECT_THAT(sentence({"E[7]"}), HasSubstr("Laboratory: E[7].")) << "what no table has is a finding";
    record.certificate->tables[0].layout->shown.push_back(
        {.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
    EXPECT_THAT(sentence({"E[2]"}), HasSubstr("Laboratory: E[2]."));
}

TEST(CertificateStatement, StatesMethodTraceabilityAndConditions) {
    const json sections = sections_of(test::certified_rotary_record(), method_sections);
    EXPECT_THAT(text_of(sections, "method_used"), HasSubstr("Method=CP-01\nVersion=4\n"));
    EXPECT_THAT(text_of(sections, "method_used"), HasSubstr("Deviations, additions, exclusions=none"));
    EXPECT_THAT(text_of(sections, "method_used"), HasSubstr("Sampling=not applicable"));
    EXPECT_THAT(text_of(sections, "traceability"),
                HasSubstr("Laser interferometer|STD-017|NMI-2026-0117|Example National Metrology Institute (NMI)|"
                          "2026-03-02|2028-03-01|0.025\u00A0µm (k\u00A0=\u00A02)|R|"));
    EXPECT_THAT(text_of(sections, "conditions"), HasSubstr("Air temperature|19.8|20.3|0.1|°C|T-04|19|21|"));
}

/// A certificate of two sections, each of an item of its own.
EvaluationRecord of_two_items() {
    EvaluationRecord record = test::certified_budget_record();
    certificate::CertificateData& data = record.certificate->data;
    certificate::CertifiedTable& table = record.certificate->tables.front();
    table.section = "first";
    record.certificate->tables.push_back(table);
    record.certificate->tables.back().section = "second";
    record.sections = {{.name = "first", .title = {}, .quantities = {}},
                       {.name = "second", .title = {}, .quantities = {}}};
    certificate::Item item = data.item;
    item.stated_by_customer = {"identification"};
    data.item = {};
    certificate::SectionData own;
    own.section = "first";
    own.item = item;
    data.sections = {own, own};
    data.sections[1].section = "second";
    data.sections[1].item->serial_number = "SN-2";
    data.sections[1].item->stated_by_customer.clear();
    return record;
}

/// What a mark means stands below it, and nowhere else.
TEST(CertificateStatement, ExplainsAMarkWhereItStands) {
    const json sections = sections_of(of_two_items(), result_sections);
    const std::string legend = "† Stated by the customer. The laboratory does not answer for it.";
    EXPECT_THAT(text_of(sections, "certified-section-0"), testing::AllOf(HasSubstr("INV-55 †"), HasSubstr(legend)));
    EXPECT_THAT(text_of(sections, "certified-section-1"), testing::AllOf(HasSubstr("=INV-55\n"), Not(HasSubstr("†"))));
    EXPECT_THAT(text_of(sections, "certified_results"), Not(HasSubstr("†")));
}

TEST(CertificateStatement, SpeaksOfTheItemsWhereThereAreSeveral) {
    struct Words {
        const char *language, *one, *several;
    };
    for (const Words& w : {Words{"en", "The item was not adjusted", "The items were not adjusted"},
                           Words{"de", "Der Gegenstand wurde nicht justiert", "Die Gegenstände wurden nicht justiert"},
                           Words{"es", "El objeto no se ajustó", "Los objetos no se ajustaron"},
                           Words{"zh-Hant", "校正件未經調整", "各校正件均未經調整"}}) {
        EvaluationRecord several = of_two_items();
        several.certificate->data.adjustment = certificate::Adjustment{.adjusted = false, .as_found = {}};
        EvaluationRecord one = test::certified_budget_record();
        one.certificate->data.adjustment = several.certificate->data.adjustment;
        EXPECT_THAT(text_of(sections_of(several, result_sections, w.language), "certified_results"),
                    HasSubstr(w.several));
        EXPECT_THAT(text_of(sections_of(one, result_sections, w.language), "certified_results"),
                    testing::AllOf(HasSubstr(w.one), Not(HasSubstr(w.several))));
    }
    EvaluationRecord several = of_two_items();
    several.certificate->data.opinions.emplace_back();
    const json closing = sections_of(several, closing_sections);
    EXPECT_THAT(text_of(closing, "statement_of_uncertainty"), HasSubstr("long-term behaviour of the items"));
    EXPECT_THAT(text_of(closing, "opinions"), HasSubstr("the results of these items"));
}

TEST(CertificateStatement, StatesTheRangeOfUOfAStandard) {
    EvaluationRecord record = test::certified_rotary_record();
    certificate::StandardUsed& standard = record.certificate->data.standards.front();
    standard.U_to = 0.1;
    EXPECT_THAT(text_of(sections_of(record, method_sections), "traceability"),
                HasSubstr("|0.025\u00A0µm to 0.1\u00A0µm (k\u00A0=\u00A02)|"));
    standard.U = 2e-11;
    standard.U_to.reset();
    EXPECT_THAT(text_of(sections_of(record, method_sections), "traceability"),
                HasSubstr("|2\u00A0×\u00A010⁻¹¹\u00A0µm (k\u00A0=\u00A02)|"));
    standard.further = {{.U = 5.0, .U_to = 8.0, .k = 2.0, .unit = "uA"},
                        {.U = 0.1, .U_to = {}, .k = {}, .unit = "ohm"}};
    EXPECT_THAT(text_of(sections_of(record, method_sections), "traceability"),
                HasSubstr("; 5\u00A0µA to 8\u00A0µA (k\u00A0=\u00A02); 0.1\u00A0Ω|"));
}

TEST(CertificateStatement, PrintsTheCertifiedTextsUntouched) {
    EvaluationRecord record = test::certified_rotary_record();
    CertifiedValue& v = record.certificate->tables[0].columns[0].values[0];
    v.printed_value = "1.0E+2";  // what no other part of the record holds
    v.printed_U = "9.9E+1";
    const std::string text = results(record);
    EXPECT_THAT(text, HasSubstr("\n0|1.0\u00A0×\u00A010²|9.9\u00A0×\u00A010¹|4.17|"));
    EXPECT_THAT(text, HasSubstr("\nEXA|2.99|0.59|*|µm|"));
    EXPECT_THAT(text, HasSubstr("* Outside of the accreditation of the laboratory."));
    EXPECT_THAT(text, HasSubstr("The item was not adjusted"));
    EXPECT_THAT(text, Not(HasSubstr("–: not applicable."))) << "no cell is empty";
    record.certificate->tables[1].columns[0].values[0].printed_U.clear();
    EXPECT_THAT(results(record), HasSubstr("–: not applicable."));
}

TEST(CertificateStatement, PrintsTheMinusSignOfAHyphen) {
    EvaluationRecord record = test::certified_rotary_record();
    record.certificate->tables[0].columns[0].values[0].printed_value = "-0.12";
    EXPECT_THAT(results(record), HasSubstr("\n0|−0.12|"));
}

TEST(CertificateStatement, PrintsTheEndsOfAConditionWithEqualDecimals) {
    EvaluationRecord record = test::certified_rotary_record();
    record.certificate->data.conditions[0].maximum = 20.0;
    const std::string text = text_of(sections_of(record, method_sections), "conditions");
    EXPECT_THAT(text, HasSubstr("Quantity|Least value|Greatest value|U|Unit|Sensor|"));
    EXPECT_THAT(text, HasSubstr("Air temperature|19.8|20.0|"));
}

TEST(CertificateStatement, NormalDistributionWithOneFactor) {
    const EvaluationRecord record = of_values({value("normal", "2", {}), value("student_t", "2", {})});
    EXPECT_THAT(statement(record), HasSubstr("coverage factor k = 2, which for a normal distribution corresponds to a "
                                             "coverage probability of approximately 95.45 %."));
    EXPECT_THAT(results(record), HasSubstr("Point|Value/nm|Expanded uncertainty U/nm|\nP1|1.00|0.20|\n"));
}

TEST(CertificateStatement, StudentDistribution) {
    EvaluationRecord record = of_values({value("student_t", "2.13", 20.0), value("student_t", "2.13", 20.0)});
    EXPECT_THAT(statement(record), HasSubstr("coverage factor k = 2.13, which for a t-distribution with effective "
                                             "degrees of freedom ν_eff = 20"));
    record = of_values({value("student_t", "2.13", 20.0), value("student_t", "2.28", 10.0)});
    EXPECT_THAT(statement(record), HasSubstr("coverage factor k stated beside it, which for a t-distribution with the "
                                             "effective degrees of freedom ν_eff stated with it"));
    EXPECT_THAT(results(record), HasSubstr("k|ν_eff|\nP1|1.00|0.20|2.13|20|\nP2|1.00|0.20|2.28|10|\n"));
}

TEST(CertificateStatement, SaysWhichValuesEachSentenceHoldsFor) {
    CertifiedValue interval = value("monte_carlo", "", {});
    interval.interval = {0.7, 1.4};
    interval.printed_low = "0.70";
    interval.printed_high = "1.40";
    EvaluationRecord record = of_values(
        {value("normal", "2.00", {}), value("convolution", "1.65", {}), interval, value("student_t", "2.13", 20.0)});
    MonteCarloSummary trials;
    trials.trials.number = 1000000;
    trials.symmetric.number = {0.6, 1.3};
    trials.shortest.number = {0.7, 1.4};
    record.results.front().monte_carlo = trials;
    const std::string text = statement(record);
    EXPECT_THAT(text, HasSubstr("(a) The reported expanded uncertainty"));
    EXPECT_THAT(text, HasSubstr("(b) The reported expanded uncertainty"));
    EXPECT_THAT(text, HasSubstr("(c) The reported expanded uncertainty"));
    EXPECT_THAT(text, HasSubstr("(d) The distribution of the measurand was determined by a Monte Carlo method (1000000 "
                                "trials; JCGM 101:2008). The interval from the lower to the upper end is the shortest "
                                "coverage interval for a probability of 95.45 %"));
    EXPECT_THAT(text, HasSubstr("The factor was calculated from the distribution of the result itself"));
    EXPECT_THAT(results(record), HasSubstr("P1|1.00|0.20|–|–|2.00|–|(a)|\nP2|1.00|0.20|–|–|1.65|–|(c)|\n"
                                           "P3|1.00|–|0.70|1.40|–|–|(d)|\nP4|1.00|0.20|–|–|2.13|20|(b)|\n"));
}

TEST(CertificateStatement, FollowsTheProfile) {
    EvaluationRecord record = of_values({value("normal", "2.00", {})});
    record.certificate->profile.k_position = "column";
    EXPECT_THAT(results(record), HasSubstr("|k|\nP1|1.00|0.20|2.00|"));
    record.certificate->profile.uncertainty_sentence = "Own sentence: k = {k}, p = {coverage}, {other}.";
    EXPECT_THAT(statement(record), HasSubstr("Own sentence: k = 2.00, p = 95.45 %, {other}."));

    record = of_values({value("normal", "2.00", {}), value("normal", "2.00", {})});
    record.certificate->tables[0].columns[0].values[1].scope_entry = "";
    EXPECT_THAT(results(record), HasSubstr("P1|1.00|0.20|\u00A0|\nP2|1.00|0.20|*|\n"));
    record.certificate->profile.mixed_results = "separate";
    EXPECT_THAT(results(record), HasSubstr("P1|1.00|0.20|"));
    EXPECT_THAT(results(record), Not(HasSubstr("P2|")));
    EXPECT_THAT(text_of(sections_of(record, closing_sections), "outside"), HasSubstr("P2|1.00|0.20|*|"));
    record.certificate->data.status = "not_accredited";
    EXPECT_THAT(results(record), HasSubstr("P2|1.00|0.20|\n"));
}

TEST(CertificateStatement, SaysWhereTheCapabilityStands) {
    EvaluationRecord record = of_values({value("normal", "2.00", {})});
    EXPECT_THAT(statement(record), Not(HasSubstr("calibration and measurement capability")));
    record.certificate->tables[0].columns[0].values[0].raised = true;
    EXPECT_THAT(statement(record), HasSubstr("calibration and measurement capability of the scope of accreditation"));
}

TEST(CertificateStatement, MakesTwoTablesOfWhatDoesNotFitOnAPage) {
    EvaluationRecord record = test::certified_rotary_record();
    record.certificate->profile.k_position = "column";
    const json sections = sections_of(record, result_sections);
    std::vector<std::string> ids;
    for (const json& block : sections.at(0).at("blocks")) {
        for (const json& table : block.at("table")) {
            EXPECT_LE(table.at("columns").size(), 13U);
            ids.push_back(table.at("id").get<std::string>());
        }
    }
    EXPECT_THAT(ids, ElementsAre("certified-1", "certified-0", "certified-0-1"))
        << "what the table does as a whole first";
}

TEST(CertificateStatement, StatesTheDecisionWithItsInputs) {
    const json sections = sections_of(test::certified_rotary_record(), closing_sections);
    const std::string text = text_of(sections, "conformity");
    EXPECT_THAT(text, HasSubstr("Specification=Drawing 1234, B, 3.2\n"));
    EXPECT_THAT(text, HasSubstr("Tolerance limits=T_L = \u221210\u00A0″; T_U = 10\u00A0″\n"));
    EXPECT_THAT(text, HasSubstr("Decision rule=DR-03: guarded acceptance, w = U (ILAC-G8:09/2019, 4.2.2)\n"));
    EXPECT_THAT(text, HasSubstr("Agreed=Example Customer, purchasing, 2026-11-02, Contract 88-2026\n"));
    EXPECT_THAT(text, HasSubstr("Conformity was decided by rule DR-03: A_U = T_U − U, A_L = T_L + U."));
    EXPECT_THAT(text,
                HasSubstr("Largest specific probability of false acceptance that the rule allows for a pass: 2.3"));
    EXPECT_THAT(text, HasSubstr("Result|θ/°|Value/″|U/″|T_L/″|T_U/″|A_L/″|A_U/″|TUR|p_c/%|Specific risk/%|Verdict|\n"));
    EXPECT_THAT(text, HasSubstr("EAA|0|3.70|0.76|\u221210.00|10.00|\u22129.24|9.24|21|100.0|0.0|pass|\n"));
    EXPECT_THAT(text, HasSubstr("nothing is claimed between the points"));
    EXPECT_THAT(text_of(sections_of(test::certified_budget_record(), closing_sections), "conformity"),
                HasSubstr("No statement of conformity was requested."));
}

/// Limits that were computed from the nominal value are no percentage of a reading, whatever a data sheet calls them.
TEST(CertificateStatement, SaysWhatAPercentageOfLimitsIsOf) {
    const auto limits = [](const std::string& role, const std::string& about, const std::string& language) {
        EvaluationRecord record = of_values({value("normal", "2.00", std::nullopt)});
        certificate::Certificate& c = *record.certificate;
        c.data.specifications = {test::sample_specification("axial", "l", -1.0, 1.0, "nm")};
        certificate::AgreedSpecification& s = c.data.specifications.front();
        s.lower.reset();
        s.upper.reset();
        s.limits = certificate::PointLimits();
        s.limits->by = "accuracy";
        s.limits->of = "x";
        s.limits->about = about;
        s.limits->accuracy.resize(1);
        s.limits->accuracy.front().percent_of_reading = 0.5;
        s.limits->accuracy.front().constant = 2.0;
        certificate::CertifiedTable& table = c.tables.front();
        table.columns.front().values.front().verdict = test::sample_verdict(table.columns.front().values.front());
        table.layout.emplace();
        table.layout->columns = {{.name = "x",
                                  .heading = {},
                                  .role = role,
                                  .stage = "",
                                  .unit = "nm",
                                  .printed_unit = "nm",
                                  .values = {1.0},
                                  .printed = {"1"}}};
        table.layout->shown = {
            {.show = "value", .of = table.columns.front().result, .heading = {}, .role = "", .stage = ""}};
        return text_of(sections_of(record, closing_sections, language), "conformity");
    };
    EXPECT_THAT(limits("nominal", "", "en"), HasSubstr("=±(0.5 % of the nominal value + 2\u00A0nm)\n"));
    EXPECT_THAT(limits("setting", "", "de"), HasSubstr("=±(0,5 % von der Einstellung + 2\u00A0nm)\n"));
    EXPECT_THAT(limits("reference", "", "es"), HasSubstr("=±(0,5 % del valor de referencia + 2\u00A0nm)\n"));
    EXPECT_THAT(limits("nominal", "", "zh-Hant"), HasSubstr("標稱值的 0.5 %"));
    EXPECT_THAT(limits("indication", "", "en"), HasSubstr("=±(0.5 % of the reading + 2\u00A0nm)\n"));
    EXPECT_THAT(limits("", "", "en"), HasSubstr("of the reading"));
    EXPECT_THAT(limits("nominal", "x", "en"), HasSubstr("+ 2\u00A0nm), about: Nominal value\n"));
    EXPECT_THAT(limits("nominal", "y", "en"), HasSubstr("+ 2\u00A0nm), about: y\n"));
}

TEST(CertificateStatement, ListsFindingsOnDraftsOnly) {
    EvaluationRecord record = test::certified_rotary_record();
    const SectionMaker findings = [](CertificateBuilder& builder, const Wording& words, const EvaluationRecord& r) {
        findings_section(builder, words, *r.certificate);
    };
    record.certificate->findings = test::drafted(record).certificate->findings;
    EXPECT_THAT(sections_of(record, findings), IsEmpty());
    EXPECT_THAT(
        text_of(sections_of(test::drafted(record), findings), "findings"),
        HasSubstr("R07-g|ISO/IEC 17025:2017, 7.8.2.1\u00A0g|critical|/item/serial_number|neither a serial number"));
}

TEST(CertifiedPlot, ShowsValuesBarsAndLimits) {
    const json texts = json::parse(read_asset(assets().templates / "wording" / "en.json"));
    const Wording words(texts);
    const EvaluationRecord record = test::certified_rotary_record();
    const auto& tables = record.certificate->tables;
    const auto plot = certified_plot(tables[0], "Error motions.", words, "p");
    ASSERT_TRUE(plot);
    ASSERT_EQ(plot->panels.size(), 6U);
    const PlotPanel& panel = plot->panels[3];
    EXPECT_EQ(panel.heading, "EAA");
    ASSERT_EQ(panel.limits.size(), 2U) << "tolerance limits are the same for all values";
    EXPECT_EQ(panel.limits[1].y, 10.0);
    ASSERT_EQ(panel.series.size(), 3U) << "acceptance limits differ with U";
    EXPECT_EQ(panel.series[0].points[0].y, 3.70) << "the printed value, not the unrounded one";
    EXPECT_EQ(panel.series[0].points[0].U, 0.76);
    EXPECT_THAT(panel.series[0].bars, PlotBars::bars);
    EXPECT_TRUE(plot->panels[0].limits.empty());
    EXPECT_FALSE(certified_plot(tables[1], "Ranges.", words, "p")) << "no argument";
}

}  // namespace
}  // namespace gumcert::reports
