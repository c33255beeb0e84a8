#include "audit/tables/result_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/foreign_table.h"
#include "audit/tables/workbook_subject.h"
#include "audit/words/coverage_words.h"
#include "tests/support/workbook_of.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

ForeignTables tables_with(const std::string& csv) {
    const workbook::Workbook workbook = workbook::read_csv(csv, "budget.csv", "budget");
    return budgets_in(workbook, workbook::evaluate_workbook(workbook), "budget.csv");
}

std::string told(const std::vector<Sentence>& sentences) {
    std::string all;
    for (const Sentence& sentence : sentences) {
        all += sentence.english() + "\n";
    }
    return all;
}

const std::string k_pressure =
    "Source of uncertainty,Uncertainty [kPa],Probability distribution,Divisor,ci,Uncertainty contribution [kPa],vi\n"
    "Calibration of standard,1.2,Normal,2.0,1.0,0.600,∞\n"
    "Drift since last calibration,0.5,Rectangular,√3,1.0,0.289,∞\n"
    "Temperature effects,0.35,Rectangular,√3,1.0,0.202,∞\n"
    "Repeatability,0.2,Normal,1.0,1.0,0.200,9\n"
    "Combined standard uncertainty,,Normal,,,0.725,>500\n";

TEST(ResultLines, NumbersAreWhatTheHeadsAboveThemSay) {
    for (const char* const line :
         {"Expanded uncertainty,,Normal,2,,1.45,>500\n", "Expanded uncertainty,,Normal (k = 2),,,1.45,>500\n",
          "Expanded uncertainty (k = 2),,Normal,,,1.45,\n", "\"Expanded uncertainty, k=2\",,N,,,1.45\n",
          "Expanded uncertainty,,k=2,,,1.45\n", "U,,Normal,2,,1.45,\n", "Expanded uncertainty,1.45,Normal,2,,,\n"}) {
        const ForeignTables tables = tables_with(k_pressure + line);
        ASSERT_EQ(tables.budgets.size(), 1U) << line;
        const AuditedBudget& budget = tables.budgets[0];
        EXPECT_EQ(budget.rows.size(), 4U) << line;
        ASSERT_TRUE(budget.claims.u_c && budget.claims.U && budget.claims.k) << line;
        EXPECT_EQ(budget.claims.u_c->value, 0.725) << line;
        EXPECT_EQ(budget.claims.U->value, 1.45) << line;
        EXPECT_EQ(budget.claims.k->value, 2.0) << line;
        EXPECT_EQ(budget.unit, "kPa") << line;
        EXPECT_FALSE(budget.claims.nu_eff) << "\">500\" is no number that could be held against another one";
        EXPECT_EQ(told(tables.not_read), "") << line;
    }
    const ForeignTables wrong = tables_with(k_pressure + "Expanded uncertainty,,Normal,2,,1.04,>500\n");
    ASSERT_EQ(wrong.budgets.size(), 1U);
    EXPECT_EQ(wrong.budgets[0].claims.U->value, 1.04);
}

const std::string k_balance =
    "Quantity,Estimate,Standard uncertainty,Probability distribution,Sensitivity coefficient,Uncertainty contribution\n"
    "mS,10000.005 g,22.5 mg,Normal,1,22.5 mg\n"
    "δmD,0.000 g,8.66 mg,Rectangular,1,8.66 mg\n"
    "Δm,0.020 g,14.4 mg,Normal,1,14.4 mg\n"
    "δmC,0.000 g,5.77 mg,Rectangular,1,5.77 mg\n"
    "δB,0.000 g,5.77 mg,Rectangular,1,5.77 mg\n";

TEST(ResultLines, TheLastRowMayBeTheResult) {
    for (const char* const name : {"mX", "Result", "y", "Ergebnis", "conventional mass"}) {
        const ForeignTables tables =
            tables_with(k_balance + name + ",10000.025 g,,,,29.3 mg\nU,,,,,59 mg\nk,2\np,95 %\n");
        ASSERT_EQ(tables.budgets.size(), 1U) << name << told(tables.not_read);
        const AuditedBudget& budget = tables.budgets[0];
        EXPECT_EQ(budget.rows.size(), 5U) << name;
        ASSERT_TRUE(budget.claims.u_c && budget.claims.U && budget.claims.value) << name;
        EXPECT_EQ(budget.unit, "mg") << name;
        EXPECT_DOUBLE_EQ(budget.claims.u_c->value, 29.3) << name;
        EXPECT_DOUBLE_EQ(budget.claims.U->value, 59.0) << name;
        EXPECT_DOUBLE_EQ(budget.claims.value->value, 10'000'025.0) << name;
        EXPECT_EQ(budget.u_c_over_rows, 1.0) << name;
    }
}

TEST(ResultLines, AskWhereTheLastRowMayBeEither) {
    // Neither u_c of the rows, nor said to be anything: a result with an error, or a contribution without its columns.
    const ForeignTables open = tables_with(k_balance + "mX,10000.025 g,,,,40.1 mg\n");
    EXPECT_TRUE(open.budgets.empty());
    EXPECT_NE(told(open.not_read).find("\"mX\" may be the result"), std::string::npos) << told(open.not_read);
    // The stated u_c decides.
    const ForeignTables row = tables_with(k_balance + "δA,0.000 g,,,,40.1 mg\nu_c,,,,,49.6 mg\n");
    ASSERT_EQ(row.budgets.size(), 1U);
    EXPECT_EQ(row.budgets[0].rows.size(), 6U);
    // Rows without any other column, of which the last one is as large as the others together.
    const ForeignTables alike = tables_with("quantity,unit,u\na,mm,0.3\nb,mm,0.4\nc,mm,0.5\n");
    EXPECT_TRUE(alike.budgets.empty());
    const ForeignTables summed = tables_with("quantity,unit,u\na,mm,0.3\nb,mm,0.4\nc,mm,0.5\nu_c,,mm,0.71\n");
    ASSERT_EQ(summed.budgets.size(), 1U);
    EXPECT_EQ(summed.budgets[0].rows.size(), 3U);
}

TEST(ResultLines, TheResultOfGumWorkbenchHasUAndK) {
    const std::string rows =
        "Größe;Wert;Standardmessunsicherheit;Freiheitsgrad;Verteilung;Sensitivitätskoeffizient;Unsicherheitsbeitrag;"
        "Index\n"
        "mS;10000,00500 g;0,0225 g;50;Normal;1,0;0,0225 g;64,0 %\n"
        "dmD;0,0 g;0,00866 g;unendlich;Rechteck;1,0;0,00866 g;9,5 %\n"
        "dm;0,0200 g;0,0144 g;2;Normal;1,0;0,0144 g;26,2 %\n"
        "mX;10000,0250 g;0,0281 g;24;;;;\n";
    for (const std::string& result : {std::string(), std::string("Ergebnis;10000,025 g;0,059 g;2,1\n")}) {
        const ForeignTables tables = tables_with(rows + result);
        ASSERT_EQ(tables.budgets.size(), 1U) << told(tables.not_read);
        const Claims& claims = tables.budgets[0].claims;
        EXPECT_EQ(tables.budgets[0].rows.size(), 3U);
        ASSERT_TRUE(claims.u_c && claims.nu_eff);
        EXPECT_EQ(claims.u_c->value, 0.0281);
        EXPECT_EQ(claims.nu_eff->value, 24.0);
        EXPECT_EQ(claims.U.has_value(), !result.empty());
        if (claims.U && claims.k) {
            EXPECT_EQ(claims.U->value, 0.059);
            EXPECT_EQ(claims.k->value, 2.1);
        }
    }
}

TEST(ResultLines, SayCoverageInTheirNamesAndWords) {
    const std::string rows = "quantity,unit,u,sensitivity,comment\na,mg,0.03,1,\nb,mg,0.04,1,\n\nu_c,,0.05,mg\n";
    for (const char* const line :
         {"\"Expanded uncertainty (k = 2.08, p = 95.45 %)\",,0.104,mg",
          "\"Expanded uncertainty (k=2.08, 95.45 %)\",,0.104,mg",
          "\"Erweiterte Messunsicherheit U (k=2,08; 95,45 %)\",,0.104,mg",
          "\"Expanded uncertainty, k=2.08, 95.45 %\",,0.104,mg",
          "U,,0.104,mg,\"k = 2.08, coverage probability 95.45 %\"", "U,0.104 mg (k = 2.08; p = 95.45 %)",
          "U = 0.104 mg\nk = 2.08\np = 95.45 %", "U95,,0.104,mg\nk95,,2.08\np,95.45 %",
          "U,,0.104,mg\nk,k = 2.08\np,95.45 %", "U (k = 2.08),,0.104,mg\np,95.45 %",
          "\"U mg (k = 2.08, p = 95.45 %)\",,0.104", "\"Expanded uncertainty mg (k = 2.08; 95.45 %)\",,0.104"}) {
        const ForeignTables tables = tables_with(rows + line + "\n");
        ASSERT_EQ(tables.budgets.size(), 1U) << line;
        const Claims& claims = tables.budgets[0].claims;
        ASSERT_TRUE(claims.U && claims.k && claims.coverage_probability) << line;
        EXPECT_EQ(claims.U->value, 0.104) << line;
        EXPECT_EQ(claims.k->value, 2.08) << line;
        EXPECT_EQ(claims.k->half_step, 0.005) << line;
        EXPECT_NEAR(*claims.coverage_probability, 0.9545, 1e-12) << line;
        EXPECT_EQ(tables.budgets[0].unit, "mg") << line;
        EXPECT_EQ(told(tables.not_read), "") << line;
    }
    // A k under a head that is not known is no U beside one under u.
    const ForeignTables beside = tables_with(
        "quantity,unit,reduced by,u,sensitivity\na,mg,2,0.03,1\nb,mg,1,0.04,1\nu_c,mg,,0.05\nExpanded,mg,2,0.100\n");
    ASSERT_EQ(beside.budgets.size(), 1U) << told(beside.not_read);
    EXPECT_EQ(beside.budgets[0].claims.U->value, 0.100);
    // What is no k is U, and what stands under u then is k.
    const ForeignTables under_result = tables_with(
        "Quantity,Result / mm,u / "
        "mm,c\nReference,100.002,0.012,1\nDrift,0.000,0.0115,1\nCombined,0.0166,,\nExpanded,0.033,2,\n");
    ASSERT_EQ(under_result.budgets.size(), 1U) << told(under_result.not_read);
    EXPECT_NE(under_result.budgets[0].claims.U->value, 2.0);
    const ForeignTables two = tables_with(rows + "U (k = 2),,0.104,mg\nk,,2.08\n");
    EXPECT_NE(told(two.not_read).find("which one holds?"), std::string::npos) << told(two.not_read);
    const ForeignTables words = tables_with(rows + "U,,0.104,mg\nk,,two\n");
    EXPECT_NE(told(words.not_read).find("\"two\" is no number"), std::string::npos) << told(words.not_read);
}

TEST(ResultLines, TakeNoLongerWhereManyRowsAreNamedLikeResults) {
    std::string csv = "quantity,unit,u,sensitivity,contribution\n";
    for (int i = 0; i < 1500; ++i) {
        csv += "Combined standard uncertainty,mm,0.100,1,0.100\n";
    }
    const ForeignTables tables = tables_with(csv + "u_c,,3.873,mm\n");
    ASSERT_EQ(tables.budgets.size(), 1U) << told(tables.not_read);
    EXPECT_GT(tables.budgets[0].rows.size(), 1000U);
    EXPECT_FALSE(coverage_in(std::string(100'000, 'k')).says_any());
}

TEST(ResultLines, NameWhatIsNotRead) {
    const std::string rows = "quantity,unit,u,sensitivity\na,mg,0.03,1\nb,mg,0.04,1\n";
    const ForeignTables tables = tables_with(rows + "U,,0.1,mg\nUncertainty as printed,,0.2,mg\nof the day,,0.3,mg\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    ASSERT_EQ(tables.not_read.size(), 1U) << "lines one below the other are named once";
    EXPECT_NE(told(tables.not_read).find("\"Uncertainty as printed\" has a number"), std::string::npos)
        << told(tables.not_read);
    const ForeignTables below = tables_with(rows + "U,,0.1,mg\nc,mg,0.05,1\n");
    EXPECT_TRUE(below.budgets.empty()) << "a contribution below the result may count or not";
    EXPECT_EQ(below.not_read.size(), 1U);
}

TEST(ResultLines, KnowADashAsTheUnitOfADimensionlessQuantity) {
    for (const char* const dash : {"-", "–"}) {
        for (const std::string& line : {"U,0.013," + std::string(dash), "U,," + std::string(dash) + ",0.013"}) {
            const ForeignTables tables =
                tables_with("quantity,estimate,unit,u\nbuffer,0,1,0.005\njunction,0,1,0.004\n" + line + "\nk,2\n");
            ASSERT_EQ(tables.budgets.size(), 1U) << line;
            EXPECT_EQ(tables.budgets[0].unit, dash) << line;
            EXPECT_EQ(told(tables.not_read), "") << line;
        }
    }
}

TEST(ResultLines, KnowOneAsAUnitOnEitherSide) {
    const std::string rows = "quantity,estimate,unit,u,sensitivity\nbuffer,0,1,0.005,1\njunction,0,1,0.004,1\n";
    for (const char* const line :
         {"U,0.013,1", "U,,1,0.013", "U,0.013", "Expanded uncertainty,0.013,1", "Expanded uncertainty,,,0.013,1"}) {
        const ForeignTables tables = tables_with(rows + line + "\nk,2\n");
        ASSERT_EQ(tables.budgets.size(), 1U) << line;
        EXPECT_EQ(tables.budgets[0].unit, "1") << line;
        EXPECT_EQ(tables.budgets[0].rows.size(), 2U) << line;
        ASSERT_TRUE(tables.budgets[0].claims.U) << line;
        EXPECT_EQ(tables.budgets[0].claims.U->value, 0.013) << line;
    }
}

/// A budget of 0.10, 0.15 and 0.05 mV, to which results are put.
const std::string k_voltage =
    "Quantity,u / mV,c,Contribution / mV\nReference,0.10,1,0.10\nResolution,0.15,1,0.15\nRepeatability,0.05,1,0.05\n";

TEST(ResultLines, StandBehindEachOtherInALineOfAnyLength) {
    // A sheet may have 16384 columns: what is stated again is no more than that.
    std::string line = "U,0.37";
    for (int i = 0; i < 8190; ++i) {
        line += ",U,0.37";
    }
    const ForeignTables longest = tables_with(k_voltage + "\n\n" + line + "\n");
    ASSERT_EQ(longest.budgets.size(), 1U);
    ASSERT_TRUE(longest.budgets[0].claims.U);
    EXPECT_EQ(longest.budgets[0].claims.U->value, 0.37);
    for (const char* const few : {"u_c,0.187,mV,k,2,U,0.37,mV", "u_c,0.187,U,0.37,k,2", "u_c,0.187,k,2,U,0.37"}) {
        const ForeignTables tables = tables_with(k_voltage + "\n\n" + few + "\n");
        ASSERT_EQ(tables.budgets.size(), 1U) << few;
        const Claims& claims = tables.budgets[0].claims;
        ASSERT_TRUE(claims.u_c && claims.k && claims.U) << few;
        EXPECT_EQ(claims.u_c->value, 0.187) << few;
        EXPECT_EQ(claims.k->value, 2.0) << few;
        EXPECT_EQ(claims.U->value, 0.37) << few;
        EXPECT_EQ(tables.budgets[0].unit, "mV") << few;
        EXPECT_EQ(told(tables.not_read), "") << few;
    }
}

TEST(ResultLines, BesideEachOtherEndWhereALineStatesSomethingElse) {
    for (const char* const heads : {",u_c,k,U", ",u_c / mV,k,U / mV", ",u_c (mV),k,U (mV)", ",u_c [mV],k,U [mV]"}) {
        for (const char* const between : {"", "\n"}) {
            const ForeignTables tables =
                tables_with(k_voltage + "\n" + heads + "\nResult,0.19,2,0.37\n" + between +
                            "Lower limit,,,,-1,mV\nUpper limit,,,,1,mV\nError,,,,1.9,mV\nVerdict,pass\n");
            SCOPED_TRACE(std::string(heads) + between);
            ASSERT_EQ(tables.budgets.size(), 1U);
            const AuditedBudget& budget = tables.budgets[0];
            EXPECT_EQ(budget.rows.size(), 3U);
            ASSERT_TRUE(budget.claims.u_c && budget.claims.k && budget.claims.U && budget.claims.value);
            EXPECT_EQ(budget.claims.u_c->value, 0.19);
            EXPECT_EQ(budget.claims.k->value, 2.0);
            EXPECT_EQ(budget.claims.U->value, 0.37);
            EXPECT_EQ(budget.claims.value->value, 1.9);
            EXPECT_EQ(budget.limits.lower, -1.0);
            EXPECT_EQ(budget.limits.upper, 1.0);
            EXPECT_EQ(budget.claims.verdict, "pass");
            EXPECT_EQ(told(tables.not_read), "");
        }
    }
    const ForeignTables nameless = tables_with(k_voltage + "\nu_c,k,U\n0.19,2,0.37\nTolerance,1.0,mV\nError,0.8,mV\n");
    ASSERT_EQ(nameless.budgets.size(), 1U);
    ASSERT_TRUE(nameless.budgets[0].claims.U && nameless.budgets[0].claims.value);
    EXPECT_EQ(nameless.budgets[0].claims.U->value, 0.37);
    EXPECT_EQ(nameless.budgets[0].claims.value->value, 0.8);
    EXPECT_EQ(nameless.budgets[0].limits.upper, 1.0);
}

TEST(ResultLines, OfSeveralPointsAreToldAndNotUsed) {
    const ForeignTables tables =
        tables_with(k_voltage +
                    "Combined standard uncertainty,,,0.187\nExpanded uncertainty (k = 2),,,0.37\n\n"
                    "Point,Value,U,k\n1 V,1.0001,0.37,2\n10 V,10.0003,0.45,2\nLower limit,-1,mV\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    const AuditedBudget& budget = tables.budgets[0];
    ASSERT_TRUE(budget.claims.U);
    EXPECT_EQ(budget.claims.U->value, 0.37);
    EXPECT_FALSE(budget.claims.value);
    EXPECT_EQ(budget.limits.lower, -1.0);
    EXPECT_NE(told(tables.not_read).find("results of several points"), std::string::npos) << told(tables.not_read);
}

TEST(ResultLines, MayBeRelativeBesideOnesUnderAHead) {
    const std::string table =
        "Quantity,Value,u / mV,c,Contribution / mV\nReference,10,0.30,1,0.30\nResolution,0,0.20,1,0.20\n"
        "Drift,0,0.10,1,0.10\nCombined standard uncertainty,,,,0.374\nExpanded uncertainty (k = 2),,,,0.75\n";
    const ForeignTables relative = tables_with(table + "Relative expanded uncertainty (k = 2),0.0075,%\n");
    ASSERT_EQ(relative.budgets.size(), 1U);
    ASSERT_TRUE(relative.budgets[0].claims.U);
    EXPECT_EQ(relative.budgets[0].claims.U->value, 0.75);
    EXPECT_EQ(told(relative.not_read), "");
    const ForeignTables same = tables_with(table + "Expanded uncertainty (k = 2),750,µV\n");
    EXPECT_EQ(told(same.not_read), "");
    for (const char* const line : {"Expanded uncertainty (k = 2),0.85,mV\n", "Expanded uncertainty (k = 2),850,µV\n"}) {
        EXPECT_NE(told(tables_with(table + line).not_read).find("has another number than"), std::string::npos) << line;
    }
}

// The law: whatever the layout, the claims that are read are those that were written, and a sound budget has no critical
// finding. Layouts of EA-4/02, M3003 and GUM Workbench, in English and German, columns in any order, as CSV and as a sheet.

class LayoutDraw {
public:
    explicit LayoutDraw(std::uint64_t seed) : state_(seed * 2'862'933'555'777'941'757U + 3'037'000'493U) {}
    std::uint64_t below(std::uint64_t end) {
        state_ = state_ * 6'364'136'223'846'793'005U + 1'442'695'040'888'963'407U;
        return (state_ >> 33U) % end;
    }
    bool yes() { return below(2) == 1; }

private:
    std::uint64_t state_;
};

enum class Style { ea, m3003, workbench };

struct DrawnRow {
    std::string name, german, shape;
    double divisor = 1.0, u = 0.0, c = 1.0, nu = 0.0;  ///< nu 0: infinite
};

/// What a table states, as it was written.
struct Written {
    std::string value, u_c, nu_eff, k, U;
};

struct DrawnTable {
    std::vector<std::vector<std::string>> lines;
    Written written;
    std::size_t rows = 0;
    char separator = ',';
    bool german = false;
};

std::string digits(double value, int decimals, bool german) {
    std::string text = text::fixed(value, decimals);
    if (german) {
        std::replace(text.begin(), text.end(), '.', ',');
    }
    return text;
}

class LayoutWriter {
public:
    LayoutWriter(Style style, std::uint64_t seed, bool wrong) : style_(style), draw_(seed), wrong_(wrong) {}

    DrawnTable table() {
        table_.german = draw_.yes();
        table_.separator = table_.german || draw_.yes() ? ';' : ',';
        draw_rows();
        write_numbers();
        write_heads();
        for (const DrawnRow& row : rows_) {
            write_row(row);
        }
        write_results();
        table_.rows = rows_.size();
        return table_;
    }

private:
    static constexpr int k_decimals = 4;

    void draw_rows() {
        const std::vector<DrawnRow> all = {
            {"calibration of the reference standard", "Kalibrierung des Normals", "normal", 2.0},
            {"drift of the reference standard", "Drift des Normals", "rectangular", std::sqrt(3.0)},
            {"repeatability", "Wiederholbarkeit", "normal", 1.0},
            {"resolution of the item", "Auflösung des Prüflings", "rectangular", std::sqrt(3.0)},
            {"temperature", "Temperatur", "rectangular", std::sqrt(3.0)},
            {"reproducibility", "Vergleichbarkeit", "rectangular", std::sqrt(3.0)},
        };
        const std::size_t count = 4 + draw_.below(3);
        for (std::size_t i = 0; i < count; ++i) {
            DrawnRow row = all[i];
            row.u = (100.0 + static_cast<double>(draw_.below(900))) * 1e-3;
            row.c = draw_.yes() ? 1.0 : 0.5;
            row.nu = row.name == "repeatability" ? 60.0 : 0.0;
            rows_.push_back(row);
        }
    }
    [[nodiscard]] std::string number(double value, int decimals = k_decimals) const {
        return digits(value, decimals, table_.german);
    }
    void write_numbers() {
        double variance = 0.0, least = 0.0;
        for (const DrawnRow& row : rows_) {
            const double part = row.c * row.u;
            variance += part * part;
            least += row.nu > 0.0 ? std::pow(part, 4) / row.nu : 0.0;
        }
        const double u_c = std::sqrt(variance), k = 2.0;
        table_.written = {.value = number(100.0 + static_cast<double>(draw_.below(100)) / 8.0, 3),
                          .u_c = number(u_c),
                          .nu_eff = number(variance * variance / least, 0),
                          .k = "2",
                          .U = number((wrong_ ? 0.7 : 1.0) * k * u_c)};
    }
    void write_heads() {
        // Letters: q quantity, x estimate, i unit, a what is divided, d divisor, s distribution, u, c, b contribution, n ν.
        columns_ = style_ == Style::ea ? "xiuscb" : (style_ == Style::m3003 ? "iasdcbn" : "xiunscb");
        for (std::size_t i = columns_.size(); i > 1; --i) {
            std::swap(columns_[i - 1], columns_[draw_.below(i)]);
        }
        columns_.insert(draw_.below(3) == 0 ? draw_.below(columns_.size()) : 0, "q");
        std::vector<std::string> heads;
        for (const char column : columns_) {
            heads.push_back(head_of(column));
        }
        table_.lines.push_back(heads);
    }
    [[nodiscard]] std::string head_of(char column) const {
        const bool de = table_.german;
        switch (column) {
            case 'q':
                return de ? "Größe" : (style_ == Style::m3003 ? "Source of uncertainty" : "Quantity");
            case 'x':
                return de ? "Schätzwert" : "Estimate";
            case 'i':
                return de ? "Einheit" : "Unit";
            case 'a':
                return de ? "Unsicherheit" : "Uncertainty";
            case 'd':
                return de ? "Teiler" : "Divisor";
            case 's':
                return de ? "Verteilung" : "Probability distribution";
            case 'u':
                return de ? "Standardmessunsicherheit" : "Standard uncertainty";
            case 'c':
                return de ? "Sensitivitätskoeffizient" : "Sensitivity coefficient";
            case 'b':
                return de ? "Unsicherheitsbeitrag" : "Uncertainty contribution";
            default:
                return de ? "Freiheitsgrad" : "Degrees of freedom";
        }
    }
    [[nodiscard]] std::string shape_in(const std::string& shape) const {
        return !table_.german ? shape : (shape == "normal" ? "Normal" : "Rechteck");
    }
    void write_row(const DrawnRow& row) {
        std::vector<std::string> line;
        for (const char column : columns_) {
            switch (column) {
                case 'q':
                    line.push_back(table_.german ? row.german : row.name);
                    break;
                case 'x':
                    line.emplace_back("0");
                    break;
                case 'i':
                    line.emplace_back("mm");
                    break;
                case 'a':
                    line.push_back(number(row.u * row.divisor, 6));
                    break;
                case 'd':
                    line.push_back(row.divisor == std::sqrt(3.0) ? "√3" : number(row.divisor, 0));
                    break;
                case 's':
                    line.push_back(shape_in(row.shape));
                    break;
                case 'u':
                    line.push_back(number(row.u));
                    break;
                case 'c':
                    line.push_back(number(row.c, 1));
                    break;
                case 'b':
                    line.push_back(number(row.c * row.u));
                    break;
                default:
                    line.push_back(row.nu > 0.0 ? number(row.nu, 0) : "∞");
            }
        }
        table_.lines.push_back(line);
    }
    /// A line with some cells under their heads.
    void write_line(const std::string& name, const std::vector<std::pair<char, std::string>>& cells) {
        std::vector<std::string> line(columns_.size());
        line[columns_.find('q')] = name;
        for (const auto& [column, text] : cells) {
            if (const std::size_t at = columns_.find(column); at != std::string::npos) {
                line[at] = text;
            }
        }
        table_.lines.push_back(line);
    }
    [[nodiscard]] std::string in_words(const char* english, const char* german) const {
        return table_.german ? german : english;
    }
    void write_results() {
        const Written& w = table_.written;
        const std::string expanded = in_words("Expanded uncertainty", "Erweiterte Messunsicherheit");
        if (style_ == Style::ea) {
            write_line(draw_.yes() ? "lX" : in_words("Result", "Ergebnis"),
                       {{'x', w.value}, {'i', "mm"}, {draw_.yes() ? 'b' : 'u', w.u_c}});
            table_.written.nu_eff = "";
        } else if (style_ == Style::workbench) {
            write_line(draw_.yes() ? "lX" : in_words("Result", "Ergebnis"),
                       {{'x', w.value}, {'i', "mm"}, {'u', w.u_c}, {'n', w.nu_eff}});
        } else {
            write_line(in_words("Combined standard uncertainty", "Kombinierte Standardunsicherheit"),
                       {{'i', "mm"}, {'s', shape_in("normal")}, {'b', w.u_c}, {'n', w.nu_eff}});
            table_.written.value = "";
        }
        const bool has_columns = style_ == Style::m3003;
        const char amount = style_ == Style::workbench ? 'u' : 'b';
        switch (draw_.below(has_columns ? 4 : 3)) {
            case 0:
                write_line(expanded + " (k = 2)", {{'i', "mm"}, {'s', shape_in("normal")}, {amount, w.U}});
                break;
            case 1:
                write_line(expanded, {{'i', "mm"}, {'s', "Normal (k = 2)"}, {amount, w.U}});
                break;
            case 2:
                write_line(expanded, {{'i', "mm"}, {amount, w.U}});
                table_.lines.push_back({in_words("Coverage factor", "Erweiterungsfaktor"), "2"});
                break;
            default:
                write_line(expanded, {{'i', "mm"}, {'s', shape_in("normal")}, {'d', "2"}, {amount, w.U}});
        }
        table_.lines.push_back({in_words("Coverage probability", "Überdeckungswahrscheinlichkeit"), "95 %"});
    }

    Style style_;
    LayoutDraw draw_;
    bool wrong_;
    std::vector<DrawnRow> rows_;
    std::string columns_;
    DrawnTable table_;
};

std::string text_of(const DrawnTable& table) {
    std::string csv;
    for (const std::vector<std::string>& line : table.lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            csv += (i == 0 ? std::string() : std::string(1, table.separator)) + line[i];
        }
        csv += '\n';
    }
    return csv;
}

/// The same in a sheet, where whole cells of numbers are numbers.
workbook::Workbook sheet_with(const DrawnTable& table) {
    test::Contents contents;
    for (std::size_t r = 0; r < table.lines.size(); ++r) {
        for (std::size_t c = 0; c < table.lines[r].size(); ++c) {
            std::string text = table.lines[r][c];
            if (text.find_first_not_of("0123456789,.") == std::string::npos) {
                std::replace(text.begin(), text.end(), ',', '.');
            }
            if (!text.empty()) {
                contents.emplace_back(
                    workbook::column_letters(static_cast<std::uint32_t>(c + 1)) + std::to_string(r + 1), text);
            }
        }
    }
    workbook::Workbook made;
    made.sheets.push_back(test::sheet_of("Budget", contents));
    return made;
}

void expect_claim(const std::optional<StatedNumber>& claim, const std::string& written, const char* what,
                  const std::string& table) {
    EXPECT_EQ(claim.has_value(), !written.empty()) << what << "\n" << table;
    if (claim && !written.empty()) {
        const std::optional<StatedNumber> number = read_number(written, "");
        EXPECT_DOUBLE_EQ(claim->value, number->value) << what << "\n" << table;
    }
}

class LayoutsOfTables : public testing::TestWithParam<std::pair<Style, bool>> {};

TEST_P(LayoutsOfTables, StateWhatWasWritten) {
    const auto [style, wrong] = GetParam();
    constexpr std::uint64_t k_tables = 150;
    for (std::uint64_t seed = 1; seed <= k_tables && !HasFailure(); ++seed) {
        const DrawnTable drawn = LayoutWriter(style, seed, wrong).table();
        const std::string csv = text_of(drawn);
        for (const bool as_sheet : {false, true}) {
            const AuditReport report = audit(
                subject_of(as_sheet ? sheet_with(drawn) : workbook::read_csv(csv, "budget.csv", "budget"), "budget"),
                all_rules());
            ASSERT_EQ(report.subject.budgets.size(), 1U) << csv << told(report.subject.not_read);
            const AuditedBudget& budget = report.subject.budgets[0];
            EXPECT_EQ(budget.rows.size(), drawn.rows) << csv;
            EXPECT_EQ(budget.unit, "mm") << csv;
            expect_claim(budget.claims.value, drawn.written.value, "value", csv);
            expect_claim(budget.claims.u_c, drawn.written.u_c, "u_c", csv);
            expect_claim(budget.claims.nu_eff, drawn.written.nu_eff, "nu_eff", csv);
            expect_claim(budget.claims.k, drawn.written.k, "k", csv);
            expect_claim(budget.claims.U, drawn.written.U, "U", csv);
            EXPECT_EQ(told(report.subject.not_read), "") << csv;
            std::string critical;
            for (const AuditFinding& finding : report.findings) {
                critical += finding.severity == FindingSeverity::critical ? finding.rule + " " : "";
            }
            EXPECT_EQ(critical.empty(), !wrong) << critical << "\n" << csv;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Styles, LayoutsOfTables,
                         testing::Values(std::pair(Style::ea, false), std::pair(Style::m3003, false),
                                         std::pair(Style::workbench, false), std::pair(Style::ea, true),
                                         std::pair(Style::m3003, true), std::pair(Style::workbench, true)));

}  // namespace
}  // namespace gumcert::audit
