#include "reports/view/certified_overview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/forms/asset_files.h"
#include "reports/reported_results.h"
#include "reports/view/certificate_conformity_section.h"
#include "tests/unit/reports/document_text.h"
#include "tests/unit/reports/view_blocks.h"

namespace gumcert::reports {
namespace {

using certificate::Certificate;
using certificate::CertifiedTable;
using ::testing::ElementsAre;

/// A table of settings in V with values of E, of which the program counts the points.
CertifiedTable table_of(const std::string& group, std::size_t first, const std::vector<std::string>& settings) {
    CertifiedTable table;
    table.id = "results";
    table.argument.emplace().name = "point";
    certificate::TableLayout& layout = table.layout.emplace();
    layout.group = group;
    certificate::PointColumn setting;
    setting.name = "V_s";
    setting.role = "setting";
    setting.printed_unit = "V";
    setting.printed = settings;
    certificate::CertifiedColumn column;
    column.result = "E";
    for (std::size_t i = 0; i < settings.size(); ++i) {
        setting.values.emplace_back(1.0);
        table.argument->printed.push_back(std::to_string(first + i));
        table.argument->values.emplace_back();
        column.values.emplace_back().printed_value = "1";
    }
    layout.columns = {setting};
    table.columns = {column};
    return table;
}

std::vector<std::string> names_in(const std::string& language, const Certificate& certificate) {
    const nlohmann::json texts =
        nlohmann::json::parse(read_asset(assets().templates / "wording" / (language + ".json")));
    const std::vector<Text> names = names_of_values(
        certificate, [](const certificate::CertifiedValue& v) { return v.raised; }, Wording(texts));
    std::vector<std::string> plain;
    std::transform(names.begin(), names.end(), std::back_inserter(plain), [](const Text& t) { return t.first(); });
    return plain;
}

// A sentence says which values it is about (ISO/IEC 17025:2017, 7.8.6.2 a): by what the table prints, and not by a number that
// only the program knows.
TEST(NamesOfValues, AreThoseThatTheTablesPrint) {
    Certificate certificate;
    certificate.tables = {table_of("1 kV", 1, {"0.5", "1.5"}), table_of("10 kV", 3, {"1", "2", "3", "4", "5"})};
    certificate.tables[0].columns[0].values[1].raised = true;
    for (std::size_t i = 1; i < 5; ++i) {
        certificate.tables[1].columns[0].values[i].raised = true;
    }
    EXPECT_THAT(names_in("en", certificate),
                ElementsAre("E[1 kV, 1.5\u00A0V]", "E[10 kV, 2\u00A0V] to E[10 kV, 5\u00A0V]"));
    EXPECT_THAT(names_in("de", certificate),
                ElementsAre("E[1 kV, 1,5\u00A0V]", "E[10 kV, 2\u00A0V] bis E[10 kV, 5\u00A0V]"));
    for (CertifiedTable& table : certificate.tables) {
        table.layout->shown.push_back({.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
    }
    EXPECT_THAT(names_in("en", certificate), ElementsAre("E[2]", "E[4] to E[7]"));
    certificate.tables[0].columns[0].values[0].raised = true;
    certificate.tables[1].columns[0].values[0].raised = true;
    EXPECT_THAT(names_in("en", certificate), ElementsAre("E")) << "all of them";
}

TEST(NamesOfValues, AreNotTheNamesOfPointsThatNoTablePrints) {
    Certificate certificate;
    certificate.tables = {table_of("", 1, {"1", "2", "3"})};
    CertifiedTable& table = certificate.tables.front();
    table.argument->printed = {"low", "mid", "high"};
    table.columns[0].values[2].raised = true;
    EXPECT_THAT(names_in("en", certificate), ElementsAre("E[3\u00A0V]"));
    table.layout->shown.push_back({.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
    EXPECT_THAT(names_in("en", certificate), ElementsAre("E[high]"));
}

// So say the other places where a value is called by its point.
TEST(NamesOfValues, StandInTheTableOfVerdicts) {
    Certificate certificate;
    certificate.tables = {table_of("", 1, {"1.5", "2"})};
    certificate::AgreedSpecification& agreed = certificate.data.specifications.emplace_back();
    agreed.id = "s";
    agreed.rule.id = "DR-01";
    for (certificate::CertifiedValue& value : certificate.tables[0].columns[0].values) {
        certificate::Verdict& verdict = value.verdict.emplace();
        verdict.specification = "s";
        verdict.rule = "DR-01";
        verdict.verdict = "pass";
        verdict.printed.lower = "0";
    }
    const Wording words(nlohmann::json::parse(read_asset(assets().templates / "wording/de.json")));
    const auto points = [&] {
        CertificateBuilder builder(words);
        conformity_section(builder, words, certificate);
        std::vector<std::string> cells;
        for (const auto& row : rows_of({{"sections", builder.take()}}, "conformity-0")) {
            cells.push_back(row.at(1));
        }
        return cells;
    };
    EXPECT_THAT(points(), ElementsAre("1,5\u00A0V", "2\u00A0V"));
    certificate.tables[0].layout->shown.push_back({.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
    EXPECT_THAT(points(), ElementsAre("1", "2"));
}

/// What the section on conformity says of 24 values: verdict and note of each by its number.
std::string conformity_of(const std::string& language,
                          const std::function<std::pair<std::string, std::string>(std::size_t)>& of) {
    Certificate certificate;
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < 24; ++i) {
        settings.push_back(std::to_string(i));
    }
    certificate.tables = {table_of("", 0, settings)};
    certificate.tables[0].layout->shown.push_back(
        {.show = "verdict", .of = "E", .heading = {}, .role = "", .stage = ""});
    certificate::AgreedSpecification& agreed = certificate.data.specifications.emplace_back();
    agreed.id = "s";
    agreed.rule.id = "DR-01";
    for (std::size_t i = 0; i < settings.size(); ++i) {
        certificate::Verdict& verdict = certificate.tables[0].columns[0].values[i].verdict.emplace();
        verdict.specification = "s";
        verdict.rule = "DR-01";
        std::tie(verdict.verdict, verdict.note) = of(i);
    }
    const Wording words(nlohmann::json::parse(read_asset(assets().templates / "wording" / (language + ".json"))));
    CertificateBuilder builder(words);
    conformity_section(builder, words, certificate);
    return builder.take().dump();
}

// Names of a hundred values tell nobody what the column of verdicts shows.
TEST(ConformitySentences, NameFewValuesAndTellManyByTheirVerdict) {
    using testing::AllOf;
    using testing::HasSubstr;
    using testing::Not;
    const std::string a = "Note one.", b = "Note two.";
    const auto by_verdict = [&](std::size_t i) {
        return i % 2 == 0 ? std::pair(std::string(i % 4 == 0 ? "pass" : "fail"), a)
                          : std::pair(std::string("undetermined"), b);
    };
    EXPECT_THAT(conformity_of("en", by_verdict),
                AllOf(HasSubstr("For values with the verdict “pass”, “fail”: Note one."),
                      HasSubstr("For values with the verdict “undetermined”: Note two.")));
    EXPECT_THAT(conformity_of("de", by_verdict),
                HasSubstr("Für Werte mit der Aussage „bestanden“, „nicht bestanden“: Note one."));
    const auto few = [&](std::size_t i) { return std::pair(std::string("pass"), i % 4 == 1 ? b : a); };
    EXPECT_THAT(conformity_of("en", few), HasSubstr("For all other values that have a verdict: Note one."));
    const auto first_ones = [&](std::size_t i) { return std::pair(std::string("pass"), i < 9 ? a : b); };
    EXPECT_THAT(conformity_of("en", first_ones), AllOf(HasSubstr("to E["), Not(HasSubstr("all other"))))
        << "few names of many";
    // What is told of some only is not told of others.
    const auto some = [&](std::size_t i) { return std::pair(std::string("pass"), i % 2 == 0 ? a : std::string()); };
    EXPECT_THAT(conformity_of("en", some), AllOf(Not(HasSubstr("all other")), Not(HasSubstr("with the verdict"))));
    const auto one_without = [&](std::size_t i) {
        return std::pair(std::string("pass"), i == 3 ? std::string() : i % 2 == 0 ? a : b);
    };
    EXPECT_THAT(conformity_of("en", one_without), Not(HasSubstr("all other")));
}

TEST(NamesOfValues, StandInTheReasonsForMonteCarlo) {
    EvaluationRecord record;
    record.certificate.emplace().tables = {table_of("", 1, {"1.5", "2"})};
    for (const char* const point : {"1", "2"}) {
        Result& result = record.results.emplace_back();
        result.quantity = "E";
        result.point = point;
        result.name = std::string("E[") + point + "]";
    }
    const Wording words(nlohmann::json::parse(read_asset(assets().templates / "wording/en.json")));
    record.results[1].reported.because = "asymmetric";
    EXPECT_THAT(reasons_for_monte_carlo(record, words).at(0).first(), testing::HasSubstr("E[2\u00A0V]"));
    record.results[0].reported.because = "asymmetric";
    EXPECT_THAT(reasons_for_monte_carlo(record, words).at(0).first(), testing::HasSubstr("reported for E, because"))
        << "all of them";
    record.results[0].reported.because = "";
    record.certificate.reset();
    EXPECT_THAT(reasons_for_monte_carlo(record, words).at(0).first(), testing::HasSubstr("E[2]"));
}

}  // namespace
}  // namespace gumcert::reports
