#include "audit/tables/row_units.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "audit/words/unit_words.h"
#include "tests/support/workbook_of.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport report_of(const std::string& csv) {
    return audit(subject_of(workbook::read_csv(csv, "budget.csv", "budget"), "budget.csv"), all_rules());
}

std::set<std::string> critical_in(const AuditReport& report) {
    std::set<std::string> rules;
    for (const AuditFinding& finding : report.findings) {
        if (finding.severity == FindingSeverity::critical) {
            rules.insert(finding.rule);
        }
    }
    return rules;
}

TEST(RowUnits, WhatWordsOfARowGiveIsNoWrongContribution) {
    const auto table = [](const std::string& row) {
        return report_of(
            "Source,Half-width or U,Unit,Distribution,Divisor,c,Contribution / "
            "mm\nReference,0.024,mm,normal,2,1,0.012\n" +
            row + "\nDrift,0.02,mm,rectangular,1.732,1,0.01155\nu_c,,,,,,0.0230\nU (k = 2),,,,,,0.046\n");
    };
    EXPECT_TRUE(critical_in(table("Repeatability (s of 10 readings),0.05,mm,normal,1,1,0.0158")).empty());
    EXPECT_TRUE(critical_in(table("\"Repeatability, n = 10\",0.05,mm,normal,1,1,0.0158")).empty());
    EXPECT_TRUE(critical_in(table("Mittel aus 10 Messungen,0.05,mm,normal,1,1,0.0158")).empty());
    EXPECT_FALSE(critical_in(table("Temperature,0.27,mm,rectangular,1.732,1,0.0158")).empty()) << "a tenth of it";
}

TEST(RowUnits, OfACoefficientOfARowInPercentMayBeThatOfTheResult) {
    const auto table = [](const std::string& heads, const std::string& u, const std::string& contribution) {
        return report_of("Quantity," + heads +
                         ",unit,Divisor,c,Contribution / mg\nReference,0.050,mg,2,1,0.0250\nScatter,0.016,mg,2,1,"
                         "0.0080\nBuoyancy," +
                         u + ",2.3," + contribution + "\nu_c,,,,,0.0271\nU (k = 2),,,,,0.054\n");
    };
    EXPECT_TRUE(critical_in(table("U or a", "0.5,%,1.732", "0.0066")).empty());
    EXPECT_TRUE(critical_in(table("U or a", "5000,ppm,1.732", "0.0066")).empty());
    EXPECT_FALSE(critical_in(table("U or a", "0.5,%,1.732", "0.664")).empty()) << "1 % is 2.3 mg, which u_c has not";
}

TEST(RowUnits, OfAContributionWithoutOneAreThoseOfTheOthers) {
    // The law: one contribution that lost its unit changes nothing, in whatever units u and the result are.
    const std::vector<std::pair<std::string, double>> rows = {{"Reference (certificate; U = 3.0 µV; k = 2)", 1.5},
                                                              {"Drift of the reference", 1.27},
                                                              {"Thermal EMF", 0.64},
                                                              {"Repeatability", 0.8}};
    for (const auto& [of_u, in_u] : std::map<std::string, double>{{"µV", 1.0}, {"mV", 1e-3}, {"nV", 1e3}}) {
        for (const auto& [of_u_c, in_u_c] :
             std::map<std::string, double>{{"µV", 1.0}, {"mV", 1e-3}, {"V", 1e-6}, {"", 1.0}}) {
            for (std::size_t without = 0; without < rows.size(); ++without) {
                std::string table = "Voltage 1 V\nQuantity,u,c,Contribution\n";
                for (std::size_t i = 0; i < rows.size(); ++i) {
                    const auto& [name, u] = rows[i];
                    table += name + "," + text::significant(u * in_u, 3) + " " + of_u + ",1," +
                             text::significant(u, 3) + (i == without ? "" : " µV") + "\n";
                }
                table += "u_c,,," + text::significant(2.22 * in_u_c, 3) + " " + of_u_c + "\nU (k = 2),,," +
                         text::significant(4.44 * in_u_c, 3) + " " + of_u_c + "\n";
                const AuditReport report = report_of(table);
                SCOPED_TRACE(table);
                ASSERT_EQ(report.results.size(), 1U);
                for (const AuditFinding& finding : report.findings) {
                    EXPECT_TRUE(finding.rule != "K01" && finding.rule != "S01") << finding.what.english();
                }
            }
        }
    }
}

TEST(RowUnits, OfAFewContributionsAreNotThoseOfTheOthers) {
    // The law: a unit that some contributions state is that of others only where more state it than state none.
    const AuditReport one = report_of(
        "Length\nComponent,Unit,Contribution\nStandard,µm,1.50\nDrift,µm,1.20\nResolution,µm,0.0005 mm\n"
        "Repeatability,µm,0.80\nu_c,µm,2.14\nk,,2\nU,µm,4.28\n");
    ASSERT_EQ(one.results.size(), 1U);
    EXPECT_NEAR(one.results[0].recomputed.U, 4.29, 0.01);
    EXPECT_TRUE(critical_in(one).empty());
    const AuditReport part = report_of(
        "Voltage\nComponent,c,u,Contribution\nStandard,1,1.50 mV,1.50\nDrift,1,1.20 mV,1.20\n"
        "Noise,1,0.80 mV,0.08 %\nU (k = 2),,,4.16 mV\n");
    for (const Sentence& said : part.subject.not_read) {
        EXPECT_EQ(said.english().find("D3"), std::string::npos) << said.english();
        EXPECT_EQ(said.english().find("D4"), std::string::npos) << said.english();
    }
}

TEST(RowUnits, OfAStatementMayStandInItsCell) {
    // The law: a result is the same in whatever unit it is stated, and wherever that stands.
    const std::string rows = "Mass\nComponent,u (mg),c,Contribution (mg)\nHandling,0.30,1,0.30\nReadings,0.20,1,0.20\n";
    for (const char* u_c : {"Combined standard uncertainty in µg = 361\n", "u_c in µg,,,361\n", "u_c / µg = 361\n"}) {
        for (const char* U :
             {"Expanded uncertainty / g = 0.00072 (k = 2)\n", "Expanded uncertainty in µg (k = 2),,,721\n",
              "Expanded uncertainty in µg; k = 2,,,721\n", "\"U in µg, k = 2\",,,721\n", "U / µg = 721 (k = 2)\n"}) {
            for (const char* value : {"Result in g = 10.00012\n", "Result in g,,,10.00012\n"}) {
                const AuditReport report = report_of(rows + value + u_c + U);
                SCOPED_TRACE(std::string(value) + u_c + U);
                ASSERT_EQ(report.results.size(), 1U);
                EXPECT_TRUE(critical_in(report).empty());
                const AuditedBudget& budget = report.subject.budgets[0];
                ASSERT_TRUE(budget.claims.u_c && budget.claims.U && budget.claims.value);
                const double in_mg = factor_between(budget.unit, "mg").value_or(0.0);
                EXPECT_NEAR(budget.claims.u_c->value * in_mg, 0.361, 1e-9);
                EXPECT_NEAR(budget.claims.U->value * in_mg, 0.7205, 6e-4);
                EXPECT_NEAR(budget.claims.value->value * in_mg, 10000.12, 1e-6);
                for (const AuditFinding& finding : report.findings) {
                    EXPECT_TRUE(finding.rule != "K01" && finding.rule != "S01") << finding.what.english();
                }
            }
        }
    }
}

TEST(RowUnits, ANumberKeepsItsDigitsInAnotherUnit) {
    const auto converted = [](const char* text, double factor) {
        StatedNumber number = read_number(text, "").value_or(StatedNumber{});
        convert(number, factor);
        return number;
    };
    EXPECT_EQ(converted("0.120", 1e-3).text, "0.000120");
    EXPECT_DOUBLE_EQ(converted("0.120", 1e-3).half_step, 5e-7);
    EXPECT_EQ(converted("99,99987", 1e3).text, "99999,87");
    EXPECT_EQ(converted("99.99987", 1e3).value, 99999.87);
    EXPECT_EQ(converted("1.299,5", 1e-3).text, "1,2995");
    EXPECT_EQ(converted("120", 1e-3).text, "0.120");
    EXPECT_EQ(converted("0", 1e-3).text, "0");
    EXPECT_EQ(converted("1.50", 1e3).text, "1500");
    EXPECT_EQ(converted("1.50", 25.4).text, "");
    EXPECT_DOUBLE_EQ(converted("1.50", 25.4).value, 38.1);
    EXPECT_DOUBLE_EQ(converted("1.50", 25.4).half_step, 0.127);
}

TEST(RowUnits, ValueAndUncertaintyMayHaveDifferentOnes) {
    const AuditReport report = report_of(
        "method,gauge block by comparison\nresult,99.99987,mm\nU,0.11,µm\nk,2\nu_c,0.0548,µm\nnominal,100,mm\n"
        "tolerance,0.3,µm\ndecision rule,DR-01\nverdict,pass\nCMC,0.10,µm\n"
        "quantity,unit,U or a,divisor,distribution,u,sensitivity,contribution,nu\n"
        "reference gauge block,µm,0.06,2,normal,0.0300,1,0.0300,∞\n"
        "drift of the reference gauge block,µm,0.05,√3,rectangular,0.0289,1,0.0289,∞\n"
        "repeatability,nm,35,√5,normal,15.7,0.001,0.0157,30\n"
        "temperature difference of the blocks,K,0.02,√3,rectangular,0.0115,1.15,0.0133,∞\n"
        "reproducibility between operators,µm,0.05,√3,rectangular,0.0289,1,0.0289,∞\n"
        "resolution of the comparator,µm,0.005,√3,rectangular,0.00289,1,0.00289,∞\n");
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_EQ(report.results[0].unit, "µm");
    EXPECT_EQ(report.results[0].claimed.printed_value, "99999.87");
    EXPECT_EQ(report.results[0].recomputed.printed_U, "0.11");
    EXPECT_EQ(report.results[0].recomputed.verdict, "pass");
    EXPECT_EQ(critical_in(report), std::set<std::string>{});
    ASSERT_TRUE(report.subject.budgets[0].capability);
    EXPECT_DOUBLE_EQ(*report.subject.budgets[0].capability, 0.10);
}

/// Contributions that state no unit are in that of the result or of the rows: their numbers say which.
TEST(RowUnits, ContributionsMayBeInTheUnitOfTheResultOrOfTheRows) {
    for (const char* rows : {"a,nm,12,1,0.012\nb,nm,16,1,0.016\n", "a,nm,12,1,12\nb,nm,16,1,16\n",
                             "a,nm,12,0.001,0.012\nb,nm,16,0.001,0.016\n"}) {
        const AuditReport report = report_of(std::string("quantity,unit,u,sensitivity,contribution\n") + rows +
                                             "u_c,0.0200,µm\nk,2\nU,0.040,µm\n");
        ASSERT_EQ(report.results.size(), 1U) << rows;
        EXPECT_EQ(report.results[0].recomputed.printed_U, "0.040") << rows;
        EXPECT_EQ(critical_in(report), std::set<std::string>{}) << rows;
    }
}

TEST(RowUnits, WhatCannotBeConvertedIsSaidAndNotUsed) {
    const AuditReport report = report_of(
        "quantity,unit,u,sensitivity\na,µm,0.3,1\nb,µm,0.4,1\nresult,10,mg\nU,1.0,µm\nk,2\nCMC,1.5,N\nlower "
        "limit,9,µm\n");
    ASSERT_EQ(report.subject.budgets.size(), 1U);
    const AuditedBudget& budget = report.subject.budgets[0];
    EXPECT_EQ(budget.unit, "µm");
    EXPECT_FALSE(budget.value);
    EXPECT_FALSE(budget.capability);
    EXPECT_EQ(budget.limits.lower, 9.0);
    ASSERT_EQ(report.subject.not_read.size(), 2U);
    EXPECT_NE(report.subject.not_read[0].english().find("\"mg\""), std::string::npos);
    EXPECT_NE(report.subject.not_read[1].english().find("\"N\""), std::string::npos);

    const AuditReport open =
        report_of("quantity,unit,u\na,µm,0.3\nb,µm,0.4\nresult,10.0000,mm\nU,1.0,µm\nk,2\nupper limit,11\n");
    ASSERT_EQ(open.subject.not_read.size(), 1U) << "millimetres or micrometres?";
    EXPECT_FALSE(open.subject.budgets[0].limits.upper);
}

TEST(RowUnits, ANumberThatASheetShowsInPercentIsInPercent) {
    workbook::Workbook workbook = test::workbook_of({{"A1", "quantity"},
                                                     {"B1", "u"},
                                                     {"C1", "sensitivity"},
                                                     {"A2", "a"},
                                                     {"B2", "0.0003"},
                                                     {"C2", "1"},
                                                     {"A3", "b"},
                                                     {"B3", "0.0004"},
                                                     {"C3", "1"},
                                                     {"A4", "U"},
                                                     {"B4", "0.001"},
                                                     {"A5", "k"},
                                                     {"B5", "2"}});
    workbook.number_formats.push_back("0.000%");
    for (const char* const head :
         {"u", "w_i",
          "Relative standard uncertainty"}) {  // the symbol of a relative u, and its unit is that of the format
        workbook::Workbook shown = workbook;
        for (workbook::Cell& cell : shown.sheets[0].cells) {
            cell.number_format = cell.value.kind == workbook::CellKind::number && cell.value.number < 1.0 ? 1 : 0;
            cell.value.text = cell.value.text == "u" ? head : cell.value.text;
        }
        const AuditSubject subject = subject_of(std::move(shown), "budget.xlsx");
        ASSERT_EQ(subject.budgets.size(), 1U);
        EXPECT_EQ(subject.budgets[0].unit, "%");
        EXPECT_DOUBLE_EQ(subject.budgets[0].claims.U->value, 0.1);
        EXPECT_DOUBLE_EQ(subject.budgets[0].rows[1].used_u, 0.04);
        EXPECT_EQ(subject.budgets[0].U_over_k_u_c, 1.0);
        EXPECT_TRUE(subject.budgets[0].unread_columns.empty());
    }
}

TEST(RowUnits, RelativeUncertaintiesStandBesideContributionsInPercent) {
    for (const std::string& heads :
         {std::string("Quantity,Estimate,Relative standard uncertainty,Sensitivity,Contribution\n"),
          std::string("Quantity,Estimate,Relative standard uncertainty,Sensitivity,Contribution (%)\n")}) {
        const AuditReport report = report_of(heads +
                                             "Activity,5.02 kBq,0.8 %,1,0.8 %\nCounts,10000,1.0 %,1,1.0 %\n"
                                             "Volume,12.0 mL,0.9 %,2,1.8 %\nu_c,,,,2.21 %\nU (k=2),,,,4.4 %\n");
        ASSERT_EQ(report.subject.budgets.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].unit, "%");
        ASSERT_TRUE(report.subject.budgets[0].rows[2].u) << heads;
        EXPECT_DOUBLE_EQ(report.subject.budgets[0].rows[2].used_u, 0.9);
        EXPECT_TRUE(report.subject.budgets[0].unread_columns.empty());
        EXPECT_FALSE(report.has_critical());
    }
}

// ---- the law: units, layout and language change nothing

/// A decimal number, so that a change of unit by a power of ten keeps its digits.
struct Decimal {
    std::int64_t digits = 0;
    int exponent = 0;  ///< of ten, of the last digit
};

Decimal decimal_of(double number, int significant) {
    if (number == 0.0) {
        return {};
    }
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(number)))) + 1 - significant;
    return {.digits = std::llround(number * std::pow(10.0, -exponent)), .exponent = exponent};
}
double number_of(const Decimal& decimal) {
    return decimal.exponent < 0 ? static_cast<double>(decimal.digits) / std::pow(10.0, -decimal.exponent)
                                : static_cast<double>(decimal.digits) * std::pow(10.0, decimal.exponent);
}
std::string printed(const Decimal& decimal, int power, char sign) {
    const int exponent = decimal.exponent - power;
    std::string text =
        text::fixed(static_cast<double>(decimal.digits) * std::pow(10.0, exponent), std::max(0, -exponent));
    for (char& c : text) {
        c = c == '.' ? sign : c;
    }
    return decimal.digits == 0 ? "0" : text;
}

/// Units of one kind, with their powers of ten.
using Kind = std::vector<std::pair<std::string, int>>;
const std::array<Kind, 6> k_kinds{{
    {{"nm", -3}, {"\u00B5m", 0}, {"\u03BCm", 0}, {"um", 0}, {"mm", 3}},
    {{"\u00B5g", -3}, {"mg", 0}, {"g", 3}},
    {{"m\u03A9", -3}, {"\u03A9", 0}, {"\u2126", 0}, {"k\u03A9", 3}},
    {{"µV", -3}, {"mV", 0}, {"V", 3}},
    {{"ppm", -4}, {"%", 0}},
    {{"Pa", -2}, {"hPa", 0}, {"mbar", 0}, {"kPa", 1}, {"bar", 3}},
}};

enum class Planted { none, undivided_limit, certificate_as_u, other_verdict, other_score, half_U };

struct SourceRow {
    std::string english, german;
    Decimal stated;
    std::string divisor;
    double divided_by = 1.0;
    std::string distribution_en, distribution_de;
    bool of_temperature = false;  ///< with c in the unit of the result per kelvin
    std::string nu;
};

/// A budget of weights, whatever its unit is called, in which everything is consistent but for what is planted.
struct Drawn {
    std::vector<SourceRow> rows;
    std::vector<Decimal> u, contributions;
    Decimal c, u_c, U, value, lower, upper, capability, reference, reference_U, en;
    std::string verdict;
};

Drawn drawn(Planted planted) {
    Drawn all;
    const double r3 = std::sqrt(3.0);
    all.rows = {
        {"reference standard", "Bezugsnormal", {50, -3}, "2", 2.0, "normal", "normal", false, "∞"},
        {"drift of the reference standard",
         "Drift des Bezugsnormals",
         {25, -3},
         "√3",
         r3,
         "rectangular",
         "Rechteck",
         false,
         "∞"},
        {"repeatability", "Wiederholbarkeit", {30, -3}, "√10", std::sqrt(10.0), "normal", "normal", false, "90"},
        {"resolution", "Auflösung", {20, -3}, "√3", r3, "rectangular", "Rechteck", false, "∞"},
        {"temperature", "Temperatur", {15, -2}, "√3", r3, "rectangular", "Rechteck", true, "∞"},
        {"reproducibility", "Reproduzierbarkeit", {10, -3}, "√3", r3, "rectangular", "Rechteck", false, "∞"},
    };
    if (planted == Planted::undivided_limit) {
        all.rows[3].divisor = "1";
        all.rows[3].divided_by = 1.0;
    } else if (planted == Planted::certificate_as_u) {
        all.rows[0].divisor = "1";
        all.rows[0].divided_by = 1.0;
    }
    all.c = {100, -3};
    double variance = 0.0;
    for (const SourceRow& row : all.rows) {
        const double u = number_of(row.stated) / row.divided_by;
        all.u.push_back(decimal_of(u, 3));
        all.contributions.push_back(decimal_of(u * (row.of_temperature ? number_of(all.c) : 1.0), 3));
        variance += std::pow(number_of(all.contributions.back()), 2);
    }
    all.u_c = decimal_of(std::sqrt(variance), 3);
    all.U = decimal_of((planted == Planted::half_U ? 1.0 : 2.0) * number_of(all.u_c), 2);
    all.value = {52, -3};
    all.lower = {-200, -3};
    all.upper = {200, -3};
    all.capability = {50, -3};
    all.reference = {20, -3};
    all.reference_U = {50, -3};
    const double both = std::hypot(number_of(all.U), number_of(all.reference_U));
    all.en = decimal_of((planted == Planted::other_score ? 1.3 : 1.0) * 0.032 / both, 2);
    all.verdict = planted == Planted::other_verdict ? "fail" : "pass";
    return all;
}

/// Random numbers that are the same everywhere.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : state_(seed) {}
    std::size_t below(std::size_t n) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::size_t>((state_ >> 33U) % n);
    }
    bool yes() { return below(2) == 1; }

private:
    std::uint64_t state_;
};

enum class UnitLayout { one_unit_column, units_in_cells, units_in_heads, unit_columns };

/// A table, line by line. Numbers are texts in the language of the table.
class TableWriter {
public:
    TableWriter(const Drawn& drawn, const Kind& kind, Draw* draw) : drawn_(drawn), kind_(kind), draw_(draw) {
        german_ = draw_ != nullptr && draw_->yes();
        sign_ = german_ ? ',' : '.';
        layout_ = draw_ == nullptr ? UnitLayout::one_unit_column : static_cast<UnitLayout>(draw_->below(4));
    }

    std::vector<std::vector<std::string>> lines() {
        std::vector<std::vector<std::string>> all;
        const bool above = draw_ != nullptr && draw_->yes();
        if (!above) {
            add_rows(all);
        }
        add_statements(all);
        if (above) {
            add_rows(all);
        }
        return all;
    }
    [[nodiscard]] bool is_german() const { return german_; }

private:
    using Unit = std::pair<std::string, int>;

    Unit any_unit() {
        for (const Unit& unit : kind_) {
            if (draw_ == nullptr && unit.second == 0) {
                return unit;
            }
        }
        return kind_[draw_->below(kind_.size())];
    }
    std::string number(const Decimal& decimal, const Unit& unit) const { return printed(decimal, unit.second, sign_); }
    std::string with_unit(const Decimal& decimal, const Unit& unit) const {
        return number(decimal, unit) + " " + unit.first;
    }

    void add_rows(std::vector<std::vector<std::string>>& all) {
        const Unit of_rows = any_unit(), of_u = any_unit(), of_contributions = any_unit();
        const auto say = [this](const char* english, const char* german) { return german_ ? german : english; };
        const std::string quantity = say("quantity", "Größe"), stated = say("half-width", "Halbweite"),
                          divisor = say("divisor", "Teiler"), shape = say("distribution", "Verteilung"),
                          u = say("standard uncertainty", "Standardunsicherheit"),
                          c = say("sensitivity", "Empfindlichkeit"), contribution = say("contribution", "Beitrag"),
                          nu = say("nu", "Freiheitsgrade"), unit = say("unit", "Einheit");
        switch (layout_) {
            case UnitLayout::one_unit_column:
                all.push_back({quantity, unit, stated, divisor, shape, u, c, contribution, nu});
                break;
            case UnitLayout::units_in_cells:
                all.push_back({quantity, stated, divisor, shape, u, c, contribution, nu});
                break;
            case UnitLayout::units_in_heads:
                all.push_back({quantity, stated + " [" + of_rows.first + "]", divisor, shape,
                               u + " [" + of_u.first + "]", c, contribution + " [" + of_contributions.first + "]", nu});
                break;
            case UnitLayout::unit_columns:
                all.push_back({quantity, stated, unit, divisor, shape, u, unit, c, contribution, unit, nu});
                break;
        }
        for (std::size_t i = 0; i < drawn_.rows.size(); ++i) {
            const SourceRow& row = drawn_.rows[i];
            const std::string name = german_ ? row.german : row.english;
            const std::string form = german_ ? row.distribution_de : row.distribution_en;
            const std::string one = "1";
            const Decimal& contributed = drawn_.contributions[i];
            const Unit kelvin{"K", 0}, millikelvin{"mK", -3};
            switch (layout_) {
                case UnitLayout::one_unit_column: {
                    // Rows and contributions in one unit; a coefficient per kelvin is one of that unit.
                    const Unit own = row.of_temperature ? kelvin : of_rows;
                    all.push_back({name, own.first, number(row.stated, own), row.divisor, form,
                                   number(drawn_.u[i], own), row.of_temperature ? number(drawn_.c, of_rows) : one,
                                   number(contributed, of_rows), row.nu});
                    break;
                }
                case UnitLayout::units_in_cells: {
                    const Unit a = row.of_temperature ? (draw_->yes() ? kelvin : millikelvin) : any_unit();
                    const Unit b = row.of_temperature ? (draw_->yes() ? kelvin : millikelvin) : any_unit();
                    const Unit of_c = any_unit();
                    all.push_back({name, with_unit(row.stated, a), row.divisor, form, with_unit(drawn_.u[i], b),
                                   row.of_temperature ? number(drawn_.c, of_c) + " " + of_c.first + "/K" : one,
                                   with_unit(contributed, any_unit()), row.nu});
                    break;
                }
                case UnitLayout::units_in_heads:
                    // A row of another kind has its unit in its cells.
                    all.push_back({name,
                                   row.of_temperature ? with_unit(row.stated, kelvin) : number(row.stated, of_rows),
                                   row.divisor, form,
                                   row.of_temperature ? with_unit(drawn_.u[i], kelvin) : number(drawn_.u[i], of_u),
                                   row.of_temperature ? number(drawn_.c, of_contributions) : one,
                                   number(contributed, of_contributions), row.nu});
                    break;
                case UnitLayout::unit_columns: {
                    const Unit a = row.of_temperature ? kelvin : any_unit(),
                               b = row.of_temperature ? kelvin : any_unit();
                    const Unit of_y = any_unit();
                    all.push_back({name, number(row.stated, a), a.first, row.divisor, form, number(drawn_.u[i], b),
                                   b.first, row.of_temperature ? number(drawn_.c, of_y) : one,
                                   number(contributed, of_y), of_y.first, row.nu});
                    break;
                }
            }
        }
    }

    void add_statement(std::vector<std::vector<std::string>>& all, const std::string& name, const Decimal& decimal) {
        const Unit unit = any_unit();
        switch (draw_ == nullptr ? 0U : draw_->below(3)) {
            case 0:
                all.push_back({name, number(decimal, unit), unit.first});
                break;
            case 1:
                all.push_back({name, with_unit(decimal, unit)});
                break;
            default:
                all.push_back({name + " [" + unit.first + "]", number(decimal, unit)});
        }
    }
    void add_statements(std::vector<std::vector<std::string>>& all) {
        const auto say = [this](const char* english, const char* german) { return german_ ? german : english; };
        add_statement(all, say("result", "Ergebnis"), drawn_.value);
        add_statement(all, say("combined standard uncertainty", "Kombinierte Standardunsicherheit"), drawn_.u_c);
        all.push_back({say("coverage factor", "Erweiterungsfaktor"), "2"});
        add_statement(all, say("expanded uncertainty", "Erweiterte Messunsicherheit"), drawn_.U);
        all.push_back({say("coverage probability", "Überdeckungswahrscheinlichkeit"), "95 %"});
        add_statement(all, say("lower limit", "untere Grenze"), drawn_.lower);
        add_statement(all, say("upper limit", "obere Grenze"), drawn_.upper);
        all.push_back({say("decision rule", "Entscheidungsregel"), "DR-01"});
        all.push_back({say("verdict", "Bewertung"), drawn_.verdict});
        add_statement(all, "CMC", drawn_.capability);
        add_statement(all, say("reference value", "Referenzwert"), drawn_.reference);
        add_statement(all, "U_ref", drawn_.reference_U);
        all.push_back({"E_n", printed(drawn_.en, 0, sign_)});
    }

    const Drawn& drawn_;
    const Kind& kind_;
    Draw* draw_;  ///< none: everything in one unit, in English
    bool german_ = false;
    char sign_ = '.';
    UnitLayout layout_ = UnitLayout::one_unit_column;
};

std::string csv_of(const std::vector<std::vector<std::string>>& lines, char separator) {
    std::string csv;
    for (const std::vector<std::string>& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            csv += (i == 0 ? std::string() : std::string(1, separator)) + line[i];
        }
        csv += '\n';
    }
    return csv;
}

/// The same in a sheet: whole cells of numbers are numbers there, everything else is text.
workbook::Workbook sheet_of_lines(const std::vector<std::vector<std::string>>& lines) {
    test::Contents contents;
    for (std::size_t r = 0; r < lines.size(); ++r) {
        for (std::size_t c = 0; c < lines[r].size(); ++c) {
            std::string text = lines[r][c];
            if (text.find_first_not_of("0123456789,-") == std::string::npos) {
                for (char& sign : text) {
                    sign = sign == ',' ? '.' : sign;
                }
            }
            contents.emplace_back(workbook::column_letters(static_cast<std::uint32_t>(c + 1)) + std::to_string(r + 1),
                                  text);
        }
    }
    workbook::Workbook workbook;
    workbook.sheets.push_back(test::sheet_of("Budget", contents));
    return workbook;
}

/// What must not depend on units: numbers in the unit in which the kind has the power 0, and the findings that matter.
struct Seen {
    double U = 0.0, u_c = 0.0, recomputed = 0.0, audited = 0.0;
    std::string verdict;
    double en = 0.0;
    std::map<std::string, double> findings;  ///< U with the correction of each critical or major one
};

Seen seen_in(const AuditReport& report, const Kind& kind) {
    Seen seen;
    if (report.results.size() != 1) {
        return seen;
    }
    const AuditedResult& result = report.results[0];
    double unit = 0.0;
    for (const auto& [name, power] : kind) {
        unit = name == result.unit ? std::pow(10.0, power) : unit;
    }
    seen.U = result.claimed.U * unit;
    seen.u_c = result.claimed.u_c * unit;
    seen.recomputed = result.recomputed.U * unit;
    seen.audited = result.audited.U * unit;
    seen.verdict = result.recomputed.verdict;
    seen.en = result.recomputed.en.value_or(0.0);
    for (const AuditFinding& finding : report.findings) {
        if (finding.severity >= FindingSeverity::major) {
            seen.findings[finding.rule] = finding.effect ? finding.effect->alone.U * unit : 0.0;
        }
    }
    return seen;
}

/// Numbers agree within what the printed digits of an uncertainty leave open.
void expect_same(const Seen& seen, const Seen& right, const std::string& table) {
    constexpr double k_near = 1e-6;
    EXPECT_NEAR(seen.U, right.U, k_near * right.U) << table;
    EXPECT_NEAR(seen.u_c, right.u_c, k_near * right.u_c) << table;
    EXPECT_NEAR(seen.recomputed, right.recomputed, k_near * right.recomputed) << table;
    EXPECT_NEAR(seen.audited, right.audited, k_near * right.audited) << table;
    EXPECT_EQ(seen.verdict, right.verdict) << table;
    EXPECT_NEAR(seen.en, right.en, k_near * std::abs(right.en)) << table;
    std::vector<std::string> found, wanted;
    for (const auto& [rule, U] : seen.findings) {
        found.push_back(rule);
    }
    for (const auto& [rule, U] : right.findings) {
        wanted.push_back(rule);
        const auto there = seen.findings.find(rule);
        EXPECT_NEAR(there == seen.findings.end() ? 0.0 : there->second, U, k_near * U) << rule << "\n" << table;
    }
    EXPECT_EQ(found, wanted) << table;
}

class UnitsOfTables : public testing::TestWithParam<Planted> {};

TEST_P(UnitsOfTables, ChangeNothingOfWhatIsFound) {
    const Drawn budget = drawn(GetParam());
    constexpr std::size_t k_tables = 24;
    for (std::size_t k = 0; k < k_kinds.size(); ++k) {
        const Kind& kind = k_kinds[k];
        const Seen right = seen_in(report_of(csv_of(TableWriter(budget, kind, nullptr).lines(), ',')), kind);
        EXPECT_EQ(right.findings.empty(), GetParam() == Planted::none);
        EXPECT_GT(right.U, 0.0);
        for (std::size_t i = 0; i < k_tables; ++i) {
            Draw draw(1000 * k + i);
            TableWriter writer(budget, kind, &draw);
            const std::vector<std::vector<std::string>> lines = writer.lines();
            const char separator = writer.is_german() ? ';' : (draw.yes() ? ',' : '\t');
            const std::string table = csv_of(lines, separator);
            expect_same(seen_in(report_of(table), kind), right, table);
            const AuditReport sheet = audit(subject_of(sheet_of_lines(lines), "budget.xlsx"), all_rules());
            expect_same(seen_in(sheet, kind), right, "as a sheet:\n" + table);
            if (HasFailure()) {
                return;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(SoundAndPlanted, UnitsOfTables,
                         testing::Values(Planted::none, Planted::undivided_limit, Planted::certificate_as_u,
                                         Planted::other_verdict, Planted::other_score, Planted::half_U));

/// Rows of several units of one kind, without coefficients: where what is stated follows from them in one unit, they were converted, in
/// whatever units they stand. Where their numbers were added as they are, S01 is told.
TEST(UnitsOfTables, OfRowsWithoutCoefficientsAreConvertedWhereTheSumSaysSo) {
    const auto with = [](const std::vector<std::pair<std::string, std::string>>& rows, const std::string& u_c,
                         const std::string& U) {
        std::string table = "Quantity,Unit,Standard uncertainty\n";
        for (std::size_t i = 0; i < rows.size(); ++i) {
            table += "Block " + std::to_string(i + 1) + "," + rows[i].second + "," + rows[i].first + "\n";
        }
        table += u_c.empty() ? "" : "Combined standard uncertainty,mm," + u_c + "\n";
        return audit(subject_of(workbook::read_csv(table + "Expanded uncertainty (k = 2),mm," + U + "\n", "b.csv", "b"),
                                "b.csv"),
                     all_rules());
    };
    const auto accused = [](const AuditReport& report) {
        std::string rules;
        for (const AuditFinding& finding : report.findings) {
            rules += finding.rule == "K01" || finding.rule == "S01" ? finding.rule + " " : "";
        }
        return rules;
    };
    // u = 30, 20 and 8 nm: u_c = 37 nm.
    const std::vector<std::vector<std::string>> units = {
        {"mm", "µm", "nm"}, {"0.000030", "0.030", "30"}, {"0.000020", "0.020", "20"}, {"0.0000080", "0.0080", "8.0"}};
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::vector<std::pair<std::string, std::string>> rows = {
                    {units[1][a], units[0][a]}, {units[2][b], units[0][b]}, {units[3][c], units[0][c]}};
                EXPECT_EQ(accused(with(rows, "0.000037", "0.000074")), "") << a << b << c;
                EXPECT_EQ(accused(with(rows, "", "0.000074")), "") << a << b << c;
                EXPECT_NE(accused(with(rows, "0.000022", "0.000043")), "") << "the first row left out: " << a << b << c;
            }
        }
    }
    const std::string as_they_stand =
        accused(with({{"0.000030", "mm"}, {"0.020", "µm"}, {"0.000008", "mm"}}, "0.0200", "0.0400"));
    EXPECT_NE(as_they_stand.find("S01"), std::string::npos);
    EXPECT_EQ(as_they_stand.find("K01"), std::string::npos);
}

}  // namespace
}  // namespace gumcert::audit
