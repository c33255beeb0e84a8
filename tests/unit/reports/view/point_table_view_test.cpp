#include "reports/view/point_table_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "reports/forms/asset_files.h"
#include "reports/plots/certified_plots.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::ShownColumn;
using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

ShownColumn shown(const std::string& show, const std::string& of, const std::string& role = "",
                  const std::string& stage = "") {
    return {.show = show, .of = of, .heading = {}, .role = role, .stage = stage};
}

CertifiedValue value(const std::string& printed, const std::string& U, const std::string& k, double limit) {
    CertifiedValue v;
    v.value = std::stod(printed);
    v.U = std::stod(U);
    v.u = *v.U / 2.0;
    v.k = std::stod(k);
    v.printed_value = printed;
    v.printed_U = U;
    v.printed_k = k;
    v.coverage = "normal";
    v.verdict.emplace();
    v.verdict->specification = "s";
    v.verdict->lower = -limit;
    v.verdict->upper = limit;
    v.verdict->verdict = "pass";
    v.verdict->printed.lower = "\u2212" + text::shortest(limit);
    v.verdict->printed.upper = text::shortest(limit);
    return v;
}

/// Three points of a range with nominal value, error, U, limit and verdict.
certificate::Certificate table_of_points() {
    certificate::Certificate certificate;
    CertifiedTable& table = certificate.tables.emplace_back();
    table.id = "results";
    table.argument.emplace();
    table.argument->name = "point";
    table.argument->printed = {"1", "2", "3"};
    table.argument->values = {{}, {}, {}};
    table.columns.push_back({.result = "E",
                             .name = "error",
                             .unit = "mV",
                             .printed_unit = "mV",
                             .values = {value("0.10", "0.20", "2.00", 0.5), value("-0.20", "0.20", "2.00", 0.7),
                                        value("0.30", "0.20", "2.00", 0.9)}});
    certificate::TableLayout& layout = table.layout.emplace();
    layout.title = "DC voltage";
    layout.group = "10 V";
    layout.group_role = "range";
    layout.columns = {{.name = "nominal",
                       .heading = {},
                       .role = "nominal",
                       .stage = "",
                       .unit = "V",
                       .printed_unit = "V",
                       .values = {1.0, 5.0, 10.0},
                       .printed = {"1.0", "5.0", "10.0"}}};
    layout.shown = {shown("column", "nominal", "nominal"), shown("value", "E", "error"), shown("U", "E"),
                    shown("limit", "E"), shown("verdict", "E")};
    certificate.profile.plus_minus_in_tables = true;
    return certificate;
}

json table_in(const certificate::Certificate& certificate, const std::string& language = "en") {
    const json texts = json::parse(read_asset(assets().templates / "wording" / (language + ".json")));
    const Wording words(texts);
    const CertifiedOverview overview(certificate);
    CertificateBuilder builder(words);
    builder.section("certified_results");
    layout_table(
        builder, words, certificate.tables.front(), "t", [](const CertifiedValue&) { return true; }, overview);
    return builder.take().at(0).at("blocks").at(0).at("table").at(0);
}

std::vector<std::string> heads_with_units(const json& table) {
    std::vector<std::string> all;
    for (const json& column : table.at("columns")) {
        all.push_back(column.at("head").get<std::string>() +
                      (column.at("unit").empty() ? "" : " / " + column.at("unit").at(0).at("text").get<std::string>()));
    }
    return all;
}

std::vector<std::string> row(const json& table, std::size_t index) {
    std::vector<std::string> all;
    for (const json& cell : table.at("rows").at(index).at("cells")) {
        all.push_back(cell.at("text").get<std::string>());
    }
    return all;
}

// The wording of tables has patterns beside its words: a column called "group" was headed "{heading}: {group}.".
TEST(PointTableView, NoNameOfAColumnIsTakenForAPattern) {
    for (const std::string language : {"en", "de", "es", "zh-Hant"}) {
        const json texts = json::parse(read_asset(assets().templates / "wording" / (language + ".json")));
        for (const auto& [name, text] : texts.at("point_table").items()) {
            certificate::Certificate certificate = table_of_points();
            certificate::TableLayout& layout = *certificate.tables.front().layout;
            layout.group_role = name;
            layout.columns.front().name = name;
            layout.columns.front().role = "";
            layout.shown.front() = shown("column", name);
            EXPECT_THAT(table_in(certificate, language).dump(), Not(HasSubstr("{heading}"))) << name;
            EXPECT_THAT(table_in(certificate, language).at("caption").get<std::string>(), Not(HasSubstr("{"))) << name;
            for (const std::string& head : heads_with_units(table_in(certificate, language))) {
                EXPECT_THAT(head, Not(HasSubstr("{"))) << name;
            }
        }
    }
}

TEST(PointTableView, ShowsWhatTheLayoutSays) {
    const json table = table_in(table_of_points());
    EXPECT_EQ(table.at("caption"), "DC voltage. Range: 10 V.");
    EXPECT_THAT(heads_with_units(table),
                ElementsAre("Nominal value / V", "Error / mV", "U / mV", "Limits ± / mV", "Verdict"));
    EXPECT_THAT(row(table, 1), ElementsAre("5.0", "−0.20", "0.20", "0.7", "pass"));
    EXPECT_THAT(heads_with_units(table_in(table_of_points(), "de")),
                ElementsAre("Nennwert / V", "Messabweichung / mV", "U / mV", "Grenzen ± / mV", "Aussage"));
}

/// Where an interval stands in place of U, u stands beside it (docs/budget_job.md).
TEST(PointTableView, ShowsUOfAnInterval) {
    certificate::Certificate certificate = table_of_points();
    CertifiedValue& value = certificate.tables[0].columns[0].values[1];
    value.U.reset();
    value.printed_U.clear();
    value.printed_k.clear();
    value.coverage = "monte_carlo";
    value.interval = {-0.3, 0.0};
    value.printed_low = "-0.30";
    value.printed_high = "0.00";
    value.printed_u = "0.077";
    const json table = table_in(certificate);
    const auto at = std::find_if(table.at("columns").begin(), table.at("columns").end(),
                                 [](const json& column) { return column.at("head") == "u"; });
    ASSERT_NE(at, table.at("columns").end());
    EXPECT_EQ(row(table, 1).at(static_cast<std::size_t>(at - table.at("columns").begin())), "0.077");
    value.printed_u.clear();  // a distribution without variance
    EXPECT_THAT(heads_with_units(table_in(certificate)), testing::Not(testing::Contains(testing::StartsWith("u / "))));
}

TEST(PointTableView, TakesTwoColumnsForLimitsThatAreNotSymmetrical) {
    certificate::Certificate certificate = table_of_points();
    certificate.tables[0].columns[0].values[0].verdict->printed.lower = "−0.4";
    EXPECT_THAT(
        heads_with_units(table_in(certificate)),
        ElementsAre("Nominal value / V", "Error / mV", "U / mV", "Lower limit / mV", "Upper limit / mV", "Verdict"));
    certificate = table_of_points();
    certificate.profile.plus_minus_in_tables = false;
    EXPECT_EQ(heads_with_units(table_in(certificate)).size(), 6U);
    for (CertifiedValue& v : certificate.tables[0].columns[0].values) {
        v.verdict->printed.lower.clear();
    }
    EXPECT_THAT(heads_with_units(table_in(certificate)),
                ElementsAre("Nominal value / V", "Error / mV", "U / mV", "Upper limit / mV", "Verdict"));
}

TEST(PointTableView, AddsKWhereItIsNotTheSameForAll) {
    certificate::Certificate certificate = table_of_points();
    certificate.tables[0].columns[0].values[2].printed_k = "2.20";
    EXPECT_THAT(heads_with_units(table_in(certificate)),
                ElementsAre("Nominal value / V", "Error / mV", "U / mV", "k", "Limits ± / mV", "Verdict"));
    EXPECT_EQ(row(table_in(certificate), 2).at(3), "2.20");
}

TEST(PointTableView, PutsStagesUnderOneHead) {
    certificate::Certificate certificate = table_of_points();
    certificate.tables[0].layout->shown = {shown("column", "nominal", "nominal"),
                                           shown("value", "E", "error", "as_found"), shown("U", "E", "", "as_found")};
    const json table = table_in(certificate);
    ASSERT_EQ(table.at("groups").size(), 1U);
    const json& cells = table.at("groups").at(0).at("cells");
    ASSERT_EQ(cells.size(), 2U);
    EXPECT_EQ(cells.at(1).at("text"), "As found");
    EXPECT_EQ(cells.at(1).at("span"), "2");
}

TEST(PointTableView, PutsNumbersBelowEachOtherWhereThatIsNotTooWide) {
    EXPECT_THAT(pads_of({"1.5", "10", "–", "2.25"}, "."), ElementsAre("0", ".00", "", ""));
    EXPECT_THAT(pads_of({"1,5", "10"}, ","), ElementsAre("", ",0"));
    EXPECT_THAT(pads_of({"100000000.6008", "1.0000009906"}, "."), ElementsAre("000000", ""));
    EXPECT_THAT(pads_of({"1000000", "0.000000000002010"}, "."), ElementsAre("", "")) << "decimals of all sizes";
}

/// Numbers of seventeen characters in eight columns do not fit side by side, though the heads do.
TEST(PointTableView, DividesATableBeforeANumberBreaks) {
    certificate::Certificate certificate = table_of_points();
    certificate::CertifiedTable& table = certificate.tables[0];
    for (const char* role : {"reference", "indication"}) {
        certificate::PointColumn column = table.layout->columns[0];
        column.name = role;
        column.role = role;
        column.printed = {"0.000000000002000", "0.000000000004", "0.000000000006"};
        table.layout->columns.push_back(column);
        table.layout->shown.insert(table.layout->shown.begin() + 1, shown("column", role, role));
    }
    const auto tables = [&] {
        const json texts = json::parse(read_asset(assets().templates / "wording" / "en.json"));
        const Wording words(texts);
        const CertifiedOverview overview(certificate);
        CertificateBuilder builder(words);
        builder.section("certified_results");
        layout_table(
            builder, words, table, "t", [](const CertifiedValue&) { return true; }, overview);
        return builder.take().at(0).at("blocks");
    };
    EXPECT_EQ(tables().size(), 1U);
    for (CertifiedValue& v : table.columns[0].values) {
        v.printed_value = "0.000000000000010";
        v.printed_U = "0.000000000000028";
        v.verdict->printed.upper = "0.000000000000050";
        v.verdict->printed.lower = "\u22120.000000000000050";
    }
    const auto head_of_second = [&] { return heads_with_units(tables().at(1).at("table").at(0)).front(); };
    EXPECT_EQ(tables().size(), 2U);
    EXPECT_EQ(head_of_second(), "Nominal value / V");
    table.layout->columns[0].printed = {"1.0", "1.0", "1.0"};
    EXPECT_EQ(head_of_second(), "Indication / V") << "the nominal value does not say which row it is";
}

TEST(PointTableView, ResultsAreDrawnAgainstTheNominalValue) {
    const json texts = json::parse(read_asset(assets().templates / "wording" / "en.json"));
    const Wording words(texts);
    const certificate::Certificate certificate = table_of_points();
    const auto plot = certified_plot(certificate.tables[0], "DC voltage.", words, "p");
    ASSERT_TRUE(plot);
    EXPECT_EQ(plot->x_label, "Nominal value / V");
    ASSERT_EQ(plot->panels.size(), 1U);
    ASSERT_EQ(plot->panels[0].series.size(), 3U) << "the error and both limits, which differ from point to point";
    EXPECT_EQ(plot->panels[0].series[0].points[2].x, 10.0);
    // One nominal value for all says nothing of a point: what was set does.
    certificate::Certificate at_one = table_of_points();
    std::vector<certificate::PointColumn>& columns = at_one.tables[0].layout->columns;
    columns[0].values = {1.0, 1.0, 1.0};
    EXPECT_EQ(certified_plot(at_one.tables[0], "T.", words, "p")->x_label, "Nominal value / V") << "there is no other";
    columns.push_back(columns[0]);
    columns[1].role = columns[1].name = "setting";
    columns[1].unit = columns[1].printed_unit = "Hz";
    columns[1].values = {10.0, 40.0, 160.0};
    EXPECT_EQ(certified_plot(at_one.tables[0], "T.", words, "p")->x_label, "Setting / Hz");
    for (const std::size_t limit : {std::size_t{1}, std::size_t{2}}) {
        EXPECT_EQ(plot->panels[0].series[limit].marker, PlotMarker::bar);
        EXPECT_FALSE(plot->panels[0].series[limit].joined) << "between the points other limits hold";
    }
}

// A power sensor: the reference is 1 mW at all frequencies, and scatters by what the source does.
TEST(PointTableView, ResultsAreNotDrawnAgainstAScatter) {
    const json texts = json::parse(read_asset(assets().templates / "wording" / "en.json"));
    const Wording words(texts);
    certificate::Certificate certificate = table_of_points();
    std::vector<certificate::PointColumn>& columns = certificate.tables[0].layout->columns;
    columns = {columns[0], columns[0]};
    columns[0].role = columns[0].name = "reference";
    columns[1].role = columns[1].name = "setting";
    columns[1].unit = columns[1].printed_unit = "Hz";
    columns[1].values = {10.0, 40.0, 160.0};
    const auto label = [&] { return certified_plot(certificate.tables[0], "T.", words, "p")->x_label; };
    columns[0].values = {1.001, 1.0024, 0.9996};
    EXPECT_EQ(label(), "Setting / Hz");
    columns[0].values = {1.0, 5.0, 10.0};
    EXPECT_EQ(label(), "Reference value / V");
    columns[0].values = {1.001, 1.0024, 0.9996};
    columns[1].values = {10.0, 10.0, 10.0};
    EXPECT_EQ(label(), "Reference value / V") << "there is nothing better";
}

// 3″ of an error are 0.0008°: nobody reads that beside U in seconds.
TEST(PointTableView, AnglesAreDrawnInDegreesWhereOneHasADegree) {
    const json texts = json::parse(read_asset(assets().templates / "wording" / "en.json"));
    const Wording words(texts);
    certificate::Certificate certificate = table_of_points();
    certificate::CertifiedTable& table = certificate.tables[0];
    table.columns[0].unit = "arcsec";
    table.columns[0].printed_unit = "″";
    for (certificate::ShownColumn& shown : table.layout->shown) {
        shown.form = shown.show == "value" ? "sexagesimal" : "";
    }
    const auto panel = [&] { return certified_plot(table, "T.", words, "p")->panels.at(0); };
    EXPECT_THAT(panel().y_label, testing::EndsWith(" / ″"));
    EXPECT_EQ(panel().series[0].points[0].y, std::stod(table.columns[0].values[0].printed_value));
    table.columns[0].values[2].printed_value = "7200.0";
    EXPECT_THAT(panel().y_label, testing::EndsWith(" / °"));
    EXPECT_EQ(panel().series[0].points[2].y, 2.0);
}

/// A limit is drawn where it holds, and nowhere else: as a line where all values have the same, else at each point.
TEST(PointTableView, NoPlotStatesALimitThatDoesNotHold) {
    const json texts = json::parse(read_asset(assets().templates / "wording" / "en.json"));
    const Wording words(texts);
    for (const double second : {0.5, 0.7}) {
        for (const double third : {0.5, 0.9}) {
            for (const bool all_decided : {true, false}) {
                certificate::Certificate certificate = table_of_points();
                std::vector<CertifiedValue>& values = certificate.tables[0].columns[0].values;
                values = {value("0.10", "0.20", "2.00", 0.5), value("-0.20", "0.20", "2.00", second),
                          value("0.30", "0.20", "2.00", third)};
                if (!all_decided) {
                    values[0].verdict.reset();
                }
                const auto plot = certified_plot(certificate.tables[0], "T.", words, "p");
                ASSERT_TRUE(plot);
                const PlotPanel& panel = plot->panels[0];
                for (const PlotLimit& line : panel.limits) {
                    for (const CertifiedValue& v : values) {
                        ASSERT_TRUE(v.verdict) << "a line says that all values have this limit";
                        EXPECT_TRUE(line.y == *v.verdict->lower || line.y == *v.verdict->upper);
                    }
                }
                for (std::size_t i = 1; i < panel.series.size(); ++i) {
                    EXPECT_FALSE(panel.series[i].joined || panel.series[i].dashed);
                    for (const PlotPoint& point : panel.series[i].points) {
                        const std::size_t at = point.x == 1.0 ? 0 : point.x == 5.0 ? 1 : 2;
                        ASSERT_TRUE(values[at].verdict);
                        EXPECT_TRUE(point.y == *values[at].verdict->lower || point.y == *values[at].verdict->upper);
                    }
                }
                EXPECT_EQ(panel.limits.size() + panel.series.size() - 1, 2U);
            }
        }
    }
}

TEST(PointTableView, AddsNuBesideKWhereTheSentenceSpeaksOfIt) {
    certificate::Certificate certificate = table_of_points();
    for (CertifiedValue& v : certificate.tables[0].columns[0].values) {
        v.coverage = "student_t";
        v.nu_eff = 9.4;
        v.printed_nu_eff = "9.4";
    }
    EXPECT_THAT(heads_with_units(table_in(certificate)), Not(Contains("ν_eff")))
        << "one k: the sentence states ν_eff itself";
    certificate.tables[0].columns[0].values[2].printed_k = "2.31";
    EXPECT_THAT(heads_with_units(table_in(certificate)),
                ElementsAre("Nominal value / V", "Error / mV", "U / mV", "k", "ν_eff", "Limits ± / mV", "Verdict"));
    EXPECT_EQ(row(table_in(certificate), 2).at(4), "9.4");
    std::vector<ShownColumn>& layout = certificate.tables[0].layout->shown;
    layout = {shown("column", "nominal", "nominal"), shown("value", "E", "error"), shown("U", "E"),
              shown("nu_eff", "E"), shown("k", "E")};
    EXPECT_EQ(heads_with_units(table_in(certificate)).size(), 5U) << "what the layout has is not added";
}

/// A table of so many results, each with an indication of its own, U, limits and verdict, and its parts.
/// \param scatter  the standard deviation of the readings stands behind each indication: a column without a role
certificate::Certificate table_of_results(std::size_t results, const std::string& number, bool scatter = false) {
    certificate::Certificate certificate = table_of_points();
    CertifiedTable& table = certificate.tables[0];
    const certificate::PointColumn nominal = table.layout->columns.front();
    const certificate::CertifiedColumn column = table.columns.front();
    table.columns.clear();
    table.layout->shown = {shown("column", "nominal", "nominal")};
    for (std::size_t i = 1; i <= results; ++i) {
        const std::string name = "E_" + std::to_string(i);
        certificate::PointColumn indication = nominal;
        indication.name = "x_" + std::to_string(i);
        indication.role = "indication";
        indication.printed = {number, number, number};
        table.layout->columns.push_back(indication);
        certificate::CertifiedColumn of = column;
        of.result = name;
        of.name = "error of channel " + std::to_string(i);
        for (CertifiedValue& v : of.values) {
            v.printed_value = number;
        }
        table.columns.push_back(of);
        std::vector<ShownColumn> columns = {shown("column", indication.name, "indication"),
                                            shown("value", name, "error"), shown("U", name), shown("limit", name),
                                            shown("verdict", name)};
        if (scatter) {
            certificate::PointColumn deviation = indication;
            deviation.name = "s(" + indication.name + ")";
            deviation.role = "";
            table.layout->columns.push_back(deviation);
            columns.insert(columns.begin() + 1, shown("column", deviation.name));
        }
        table.layout->shown.insert(table.layout->shown.end(), columns.begin(), columns.end());
    }
    return certificate;
}

json tables_in(const certificate::Certificate& certificate, const std::string& language) {
    const json texts = json::parse(read_asset(assets().templates / "wording" / (language + ".json")));
    const Wording words(texts);
    const CertifiedOverview overview(certificate);
    CertificateBuilder builder(words);
    builder.section("certified_results");
    layout_table(
        builder, words, certificate.tables.front(), "t", [](const CertifiedValue&) { return true; }, overview);
    json all = json::array();
    const json sections = builder.take();
    for (const json& block : sections.at(0).at("blocks")) {
        all.push_back(block.at("table").at(0));
    }
    return all;
}

TEST(PointTableView, ManyResultsBecomeSeveralTablesWithTheSamePoints) {
    for (const char* language : {"en", "de", "es", "zh-Hant"}) {
        for (std::size_t results = 1; results <= 6; ++results) {
            for (const std::string number : {"1.0", "10000.0045", "1000000.00045"}) {
                SCOPED_TRACE(std::string(language) + " " + std::to_string(results) + " " + number);
                const json tables = tables_in(table_of_results(results, number), language);
                for (const bool scatter : {false, true}) {
                    const std::size_t of_each = scatter ? 6 : 5;
                    std::size_t columns = 0;
                    for (const json& table : tables_in(table_of_results(results, number, scatter), language)) {
                        const std::vector<std::string> all = heads_with_units(table);
                        EXPECT_EQ(all.front(), heads_with_units(tables.at(0)).front()) << "which row it is";
                        EXPECT_LE(all.size(), 16U);
                        EXPECT_EQ((all.size() - 1) % of_each, 0U) << "the columns of a result stay together";
                        EXPECT_EQ(table.at("rows").size(), 3U);
                        columns += all.size() - 1;
                    }
                    EXPECT_EQ(columns, of_each * results) << "none stands twice";
                }
                const std::string caption = tables.at(0).at("caption");
                EXPECT_EQ(tables.size() > 1, caption.find("error of channel 1") != std::string::npos) << caption;
                if (results == 1) {
                    EXPECT_EQ(tables.size(), 1U);
                }
            }
        }
    }
    EXPECT_GE(tables_in(table_of_results(3, "10000.0045"), "de").size(), 2U);
}

// What a mark means stands with the rows that have it, and not with those of other results.
TEST(PointTableView, EachPartOfATableExplainsItsOwnMarks) {
    std::size_t without = 0;
    for (std::size_t results = 1; results <= 6; ++results) {
        for (std::size_t marked = 0; marked < results; ++marked) {
            certificate::Certificate certificate = table_of_results(results, "10000.0045");
            certificate.tables.front().columns.at(marked).values.front().raised = true;
            std::size_t with = 0;
            for (const json& table : tables_in(certificate, "en")) {
                const bool has_mark = table.at("rows").dump().find('#') != std::string::npos;
                const std::string caption = table.at("caption");
                EXPECT_EQ(caption.find('#') != std::string::npos, has_mark) << caption;
                (has_mark ? with : without) += 1;
            }
            EXPECT_EQ(with, 1U);
        }
    }
    EXPECT_GE(without, 10U);
}

}  // namespace
}  // namespace gumcert::reports
