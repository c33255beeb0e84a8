#include "reports/view/named_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gumcert::reports {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(NamedTables, AreThoseOfTheDocumentItself) {
    EXPECT_THAT(own_tables_named("Table 9"), ElementsAre(9));
    EXPECT_THAT(own_tables_named("The results as found are in Table 3."), ElementsAre(3));
    EXPECT_THAT(own_tables_named("Tabelle\u00a03 und Tabelle 4"), ElementsAre(3, 4));
    EXPECT_THAT(own_tables_named("Tabellen 3, 4 und 6"), ElementsAre(3, 4, 6));
    EXPECT_THAT(own_tables_named("véanse las tablas 3 a 5."), ElementsAre(3, 5));
    EXPECT_THAT(own_tables_named("如表 3 及表 4"), ElementsAre(3, 4));
    EXPECT_THAT(own_tables_named("siehe Tabelle 4 (Bei Eingang)"), ElementsAre(4));
    EXPECT_THAT(own_tables_named("Véase la tabla 2."), ElementsAre(2));
    EXPECT_THAT(own_tables_named("調整前之結果列於表 2。"), ElementsAre(2));
    EXPECT_THAT(own_tables_named("Table 2 are the results as found"), ElementsAre(2));
}

TEST(NamedTables, OfAnotherDocumentAreNotLookedFor) {
    for (const char* text :
         {"Table 2 of certificate EX-7", "Kalibrierschein vom Eingang, Tabelle 9", "Table 2 of the work order 2026-11",
          "informe anterior, tabla 9", "證書之表 9", "EX-2026-0041, Table 1", "Tabla 9 del certificado anterior",
          "Vorherige Kalibrierung, Tabelle 9", "table 9 of the previous calibration", "Messprotokoll, Tabelle 9",
          "As found: table 5 of the logbook", "列於前次校正之表 9", "Acta de calibración previa, tabla 9",
          "Table 3a"}) {
        EXPECT_THAT(own_tables_named(text), IsEmpty()) << text;
    }
    for (const char* text : {"", "They are stated with those after it.", "Not measured: the item did not work.",
                             "a table of the customer", "代表"}) {
        EXPECT_THAT(own_tables_named(text), IsEmpty()) << text;
    }
}

certificate::Certificate adjusted(const certificate::LocalisedText& as_found) {
    certificate::Certificate c;
    c.data.adjustment = certificate::Adjustment{.adjusted = true, .as_found = as_found};
    return c;
}

nlohmann::json section(const char* id, const char* kind,
                       const std::vector<std::pair<std::string, std::string>>& tables) {
    nlohmann::json blocks = nlohmann::json::array();
    for (const auto& [table, number] : tables) {
        blocks.push_back({{"table", {{{"id", table}, {"number", number}}}}});
    }
    return {{"id", id}, {"kind", kind}, {"blocks", blocks}};
}

// Table 1 is of standards, 2 of conditions, 5 of the conditions of a section, 7 of the annex.
TEST(NamedTables, HaveResults) {
    const nlohmann::json view{
        {"sections",
         {section("traceability", "", {{"standards", "Table 1"}}),
          section("conditions", "", {{"conditions", "Table 2"}}),
          section("certified_results", "", {{"certified-0", "Table 3"}}),
          section("certified-section-1", "",
                  {{"certified-1", "Table 4"}, {"conditions-1", "Table 5"}, {"certified-2", "Table 6"}}),
          section("results", "annex", {{"results", "Table 7"}})}}};
    for (const int number : {3, 4, 6}) {
        const std::string text = "Table " + std::to_string(number);
        EXPECT_THAT(findings_on_named_tables(adjusted(text), view, {"en"}), IsEmpty()) << text;
    }
    for (const int number : {1, 2, 5, 7, 9}) {
        const std::string text = "Table " + std::to_string(number);
        const auto found = findings_on_named_tables(adjusted(text), view, {"en"});
        ASSERT_EQ(found.size(), 1U) << text;
        EXPECT_EQ(found[0].id, "R07-4d");
        EXPECT_EQ(found[0].severity, certificate::FindingSeverity::critical);
        EXPECT_THAT(found[0].what, testing::HasSubstr("table " + std::to_string(number) + ", and tables 3 to 6"));
    }
    // A draft has a table of its findings before them, which the certificate will not have.
    const nlohmann::json draft{
        {"sections",
         {section("findings", "", {{"findings", "Table 1"}}), section("conditions", "", {{"conditions", "Table 3"}}),
          section("certified_results", "", {{"certified-0", "Table 4"}})}}};
    EXPECT_THAT(findings_on_named_tables(adjusted("Table 3"), draft, {"en"}), IsEmpty());
    EXPECT_THAT(findings_on_named_tables(adjusted("Table 4"), draft, {"en"}), testing::SizeIs(1));
    const nlohmann::json one{{"sections", {section("certified_results", "", {{"certified-0", "Tabelle 3"}})}}};
    ASSERT_THAT(findings_on_named_tables(adjusted("Tabelle 4"), one, {"de"}), testing::SizeIs(1));
    EXPECT_THAT(findings_on_named_tables(adjusted("Tabelle 4"), one, {"de"})[0].what,
                testing::HasSubstr("table 4, and table 3 has the results"));
    certificate::LocalisedText in_two;
    in_two.by_language = {{"en", "Table 3"}, {"de", "Tabelle 9"}};
    EXPECT_THAT(findings_on_named_tables(adjusted(in_two), view, {"en"}), IsEmpty());
    EXPECT_THAT(findings_on_named_tables(adjusted(in_two), view, {"en", "de"}), testing::SizeIs(1));
    // Each number at once and only once: what is found later would be in documents, and not in the record.
    certificate::LocalisedText twice;
    twice.by_language = {{"en", "Tables 8 and 9"}, {"de", "Tabellen 8 und 9"}};
    certificate::Certificate of_two = adjusted(twice);
    of_two.findings = findings_on_named_tables(of_two, view, {"en", "de"});
    EXPECT_THAT(of_two.findings, testing::SizeIs(2));
    EXPECT_THAT(findings_on_named_tables(of_two, view, {"en", "de"}), IsEmpty());
}

TEST(NamedTables, AreAskedForOnlyAfterAnAdjustment) {
    EXPECT_TRUE(names_tables_before_adjustment(adjusted("Table 2")));
    EXPECT_FALSE(names_tables_before_adjustment(adjusted("There are none: the item did not work.")));
    certificate::Certificate c = adjusted("Table 2");
    c.data.adjustment->adjusted = false;
    EXPECT_FALSE(names_tables_before_adjustment(c));
    EXPECT_FALSE(names_tables_before_adjustment(certificate::Certificate()));
}

}  // namespace
}  // namespace gumcert::reports
