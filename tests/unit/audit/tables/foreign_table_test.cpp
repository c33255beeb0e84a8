#include "audit/tables/foreign_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

ForeignTables tables_of(const std::string& csv) {
    const workbook::Workbook workbook = workbook::read_csv(csv, "budget.csv", "budget");
    return budgets_in(workbook, workbook::evaluate_workbook(workbook), "budget.csv");
}

TEST(BudgetsIn, ReadsTheTableOfTheContract) {
    const ForeignTables tables = tables_of(
        "quantity,estimate,unit,u,divisor,distribution,sensitivity,contribution,nu,source,comment\n"
        "standard,100.001,mm,0.0002,2,normal,1,0.0002,60,K 123,\"U = 0.0004 mm, k = 2\"\n"
        "resolution,0,mm,0.00029,,rectangular,1,0.00029,,,resolution 0.001 mm\n"
        "u_c,,mm,0.00035\n"
        "nu_eff,,,560\n"
        "k,,,2\n"
        "U,,mm,0.0007\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    EXPECT_TRUE(tables.not_read.empty());
    const AuditedBudget& budget = tables.budgets.front();
    ASSERT_EQ(budget.rows.size(), 2U);
    EXPECT_EQ(budget.unit, "mm");
    EXPECT_EQ(budget.rows[0].quantity, "standard");
    EXPECT_DOUBLE_EQ(budget.rows[0].used_u, 0.0002);
    EXPECT_DOUBLE_EQ(budget.rows[0].used_nu, 60.0);
    EXPECT_EQ(budget.rows[0].origin, Origin::certificate);
    EXPECT_EQ(budget.rows[1].origin, Origin::resolution);
    EXPECT_EQ(budget.rows[1].shape, Shape::rectangular);
    EXPECT_TRUE(std::isinf(budget.rows[1].used_nu));
    ASSERT_TRUE(budget.claims.u_c && budget.claims.U && budget.claims.k && budget.claims.nu_eff);
    EXPECT_DOUBLE_EQ(budget.claims.U->value, 0.0007);
    EXPECT_DOUBLE_EQ(budget.claims.U->half_step, 0.00005);
    EXPECT_EQ(budget.claims.U->place, "budget!D7");
    EXPECT_EQ(budget.u_c_over_rows, 1.0) << "rounded rows give the claimed u_c within their digits";
}

TEST(BudgetsIn, ReadsGermanTablesWithDecimalCommas) {
    const ForeignTables tables = tables_of(
        "Messgröße;Länge l\n"
        "Größe;Schätzwert;Einheit;Standardunsicherheit u(xi);Verteilung;Sensitivitätskoeffizient;Beitrag\n"
        "Normal;50,0002;mm;0,00003;normal;1;0,00003\n"
        "Auflösung;0;mm;0,00029;Rechteck;1;0,00029\n"
        "Kombinierte Standardunsicherheit;;mm;0,00029\n"
        "Erweiterte Messunsicherheit;;mm;0,00058\n"
        "Erweiterungsfaktor;;;2\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    const AuditedBudget& budget = tables.budgets.front();
    EXPECT_EQ(budget.name, "Länge l");
    ASSERT_EQ(budget.rows.size(), 2U);
    EXPECT_DOUBLE_EQ(budget.rows[1].used_u, 0.00029);
    EXPECT_EQ(budget.rows[1].shape, Shape::rectangular);
    ASSERT_TRUE(budget.claims.U);
    EXPECT_DOUBLE_EQ(budget.claims.U->value, 0.00058);
    EXPECT_EQ(budget.coverage.kind, CoverageRule::Kind::fixed);
}

TEST(BudgetsIn, ReadsLimitsCapabilityAndReference) {
    const ForeignTables tables = tables_of(
        "quantity,unit,u,sensitivity\n"
        "a,um,0.3,1\n"
        "b,um,0.4,1\n"
        "value,10.2,um\n"
        "k,2\n"
        "U,1.0,um\n"
        "CMC,1.5,um\n"
        "lower limit,9\n"
        "upper limit,11\n"
        "decision rule,DR-03\n"
        "verdict,pass\n"
        "reference value,9.8\n"
        "U_ref,0.6\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    const AuditedBudget& budget = tables.budgets.front();
    EXPECT_EQ(budget.value, 10.2);
    EXPECT_EQ(budget.capability, 1.5);
    EXPECT_FALSE(budget.floor_applied) << "U is stated below the capability";
    EXPECT_EQ(budget.limits.lower, 9.0);
    EXPECT_EQ(budget.limits.upper, 11.0);
    EXPECT_EQ(budget.rule, gum::DecisionRule::guard_band_u);
    EXPECT_EQ(budget.claims.verdict, "pass");
    ASSERT_TRUE(budget.reference);
    EXPECT_EQ(budget.reference->value, 9.8);
    EXPECT_EQ(budget.reference->expanded_uncertainty, 0.6);
}

TEST(BudgetsIn, SeveralTablesOfOneSheetAreSeveralBudgets) {
    const std::string table = "quantity,unit,u,sensitivity\na,um,0.3,1\nU,0.6,um\n";
    const ForeignTables tables = tables_of(table + "\n\n\n" + table);
    ASSERT_EQ(tables.budgets.size(), 2U);
    EXPECT_TRUE(tables.budgets[0].claims.U && tables.budgets[1].claims.U);
}

TEST(BudgetsIn, SaysWhatCouldNotBeRead) {
    const ForeignTables tables = tables_of(
        "quantity,unit,u,sensitivity\n"
        "a,um,see annex,1\n"
        "b,um,0.2,1\n");
    ASSERT_EQ(tables.not_read.size(), 1U);
    EXPECT_NE(tables.not_read.front().english().find("\"see annex\""), std::string::npos)
        << tables.not_read.front().english();
    EXPECT_NE(tables.not_read.front().english().find("budget!C2"), std::string::npos)
        << tables.not_read.front().english();

    const ForeignTables none = tables_of("date,operator\n2026-01-01,A\n");
    EXPECT_TRUE(none.budgets.empty());
    ASSERT_EQ(none.not_read.size(), 1U);
}

TEST(BudgetsIn, TakesWholeUncertaintiesForRounded) {
    const ForeignTables tables = tables_of(
        "quantity,unit,u,divisor,contribution\nstandard,nm,12,2,12\nresolution,nm,5.8,,5.8\nU,,nm,27\nk,,,2\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    EXPECT_DOUBLE_EQ(tables.budgets[0].rows[0].u_half_step, 0.5);
    EXPECT_DOUBLE_EQ(tables.budgets[0].rows[1].u_half_step, 0.05);
}

TEST(BudgetsIn, KnowsOneAsAUnit) {
    const ForeignTables tables =
        tables_of("quantity,unit,u\nbuffer,1,0.005\njunction,1,0.004\nresult,,1,0.03\nU,,1,0.013\nk,,,2\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    EXPECT_EQ(tables.budgets[0].unit, "1");
    ASSERT_TRUE(tables.budgets[0].claims.U && tables.budgets[0].claims.value);
    EXPECT_DOUBLE_EQ(tables.budgets[0].claims.U->value, 0.013);
    EXPECT_DOUBLE_EQ(tables.budgets[0].claims.value->value, 0.03);
}

TEST(BudgetsIn, TakesARowNamedLikeAStatementForARow) {
    const ForeignTables tables = tables_of(
        "quantity,estimate,unit,u,sensitivity,contribution\np,1014,hPa,0.5,0.2,0.10\nk,3,1,0.1,1,0.1\nt,21,K,0.2,1,0."
        "2\n"
        "U,,K,0.49\nk,2\np,95 %\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    EXPECT_EQ(tables.budgets[0].rows.size(), 3U);
    EXPECT_EQ(tables.budgets[0].claims.coverage_probability, 0.95);
    EXPECT_EQ(tables.budgets[0].claims.k->value, 2.0);
}

TEST(BudgetsIn, AsksForACoverageProbabilityThatCannotBe) {
    const ForeignTables tables =
        tables_of("quantity,unit,u\na,mm,0.1\nb,mm,0.2\nU,,mm,0.45\ncoverage probability,950\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    EXPECT_FALSE(tables.budgets[0].claims.coverage_probability);
    ASSERT_EQ(tables.not_read.size(), 1U);
    EXPECT_NE(tables.not_read[0].english().find("coverage probability of 9.5"), std::string::npos);
}

/// A part of a table gives another u_c than the table: it is read whole, or not, and then that is said.
TEST(BudgetsIn, SaysWhereATableIsTooLong) {
    const auto table = [](int rows) {
        std::string csv = "quantity,unit,u,sensitivity\n";
        for (int i = 0; i < rows; ++i) {
            csv += "x" + std::to_string(i) + ",mm,0.001,1\n";
        }
        return csv;
    };
    const ForeignTables whole = tables_of(table(2'000));
    ASSERT_EQ(whole.budgets.size(), 1U);
    EXPECT_EQ(whole.budgets.front().rows.size(), 2'000U);
    EXPECT_TRUE(whole.not_read.empty());
    const ForeignTables too_long = tables_of(table(2'001) + "\n\n\n" + table(2));
    ASSERT_EQ(too_long.budgets.size(), 1U) << "the next table is read";
    EXPECT_EQ(too_long.budgets.front().rows.size(), 2U);
    ASSERT_EQ(too_long.not_read.size(), 1U);
    EXPECT_NE(too_long.not_read.front().english().find("2000 rows"), std::string::npos);
}

TEST(BudgetsIn, SaysWhereTablesAreTooMany) {
    std::string csv;
    for (int i = 0; i < 10'001; ++i) {
        csv += "quantity,unit,u,sensitivity\na,mm,0.001,1\n\n\n";
    }
    const ForeignTables tables = tables_of(csv);
    EXPECT_EQ(tables.budgets.size(), 10'000U);
    ASSERT_EQ(tables.not_read.size(), 1U);
    EXPECT_NE(tables.not_read.front().english().find("what follows is not looked at"), std::string::npos);
}

TEST(BudgetsIn, TakesAPercentSignForAUnit) {
    const ForeignTables tables = tables_of(
        "quantity;u;sensitivity;contribution\na;0,050 %;1;0,050 %\nb;0,035 %;1;0,035 %\nresult;0,23 %\nk;2\nU;0,12 %\n"
        "coverage probability;95 %\nupper limit;5000 ppm\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    const AuditedBudget& budget = tables.budgets[0];
    EXPECT_EQ(budget.unit, "%");
    EXPECT_EQ(budget.claims.U->value, 0.12);
    EXPECT_EQ(budget.claims.U->text, "0,12");
    EXPECT_EQ(budget.rows[0].used_u, 0.05);
    EXPECT_EQ(budget.claims.coverage_probability, 0.95);
    EXPECT_DOUBLE_EQ(budget.limits.upper.value_or(0.0), 0.5);
    EXPECT_TRUE(tables.not_read.empty());
}

/// "1,200" is 1200 beside "1,500.00", 1.2 beside "0,5", and nothing is computed with it where no number shows which.
TEST(BudgetsIn, SettlesTheDecimalSignOfAFileOnce) {
    const auto table = [](const std::string& number, const std::string& beside, char separator) {
        std::string csv;
        for (const char c : "quantity;estimate;unit;u;sensitivity;comment\nnormal;" + beside + ";mPa;" + number +
                                ";1;U = " + number + " mPa with k = 1\nb;0;mPa;500;1;\nU;" + number + "\n") {
            csv += c == ';' ? separator : c;
        }
        return tables_of(csv);
    };
    struct Case {
        std::string number, beside;
        char separator;
        double u;  ///< 0: it is asked
    };
    for (const Case& one :
         {Case{"\"1,200\"", "\"1,500.00\"", ',', 1200.0}, Case{"\"1,200\"", "1.5", ',', 1200.0},
          Case{"\"1,200\"", "\"1,5\"", ',', 1.2}, Case{"1.200", "1.000.000", ';', 1200.0},
          Case{"1.200", "2,03", ';', 1200.0}, Case{"1.200", "2.03", ';', 1.2}, Case{"1.200", "7", ',', 1.2},
          Case{"1,200", "2,03", ';', 1.2}, Case{"1,200", "2.5", '\t', 1200.0}, Case{"1.200", "7", ';', 0.0},
          Case{"1,200", "7", '\t', 0.0}, Case{"0.120", "7", ';', 0.12}, Case{"1.2000", "7", ';', 1.2},
          Case{"1.200E0", "7", ';', 1.2}}) {
        const std::string name = one.number + " beside " + one.beside;
        const ForeignTables tables = table(one.number, one.beside, one.separator);
        if (one.u == 0.0) {
            EXPECT_TRUE(tables.budgets.empty()) << name;
            ASSERT_GE(tables.not_read.size(), 2U) << name;
            EXPECT_NE(tables.not_read[0].english().find("thousands"), std::string::npos) << name;
            continue;
        }
        ASSERT_EQ(tables.budgets.size(), 1U) << name;
        EXPECT_DOUBLE_EQ(tables.budgets[0].rows[0].used_u, one.u) << name;
        EXPECT_DOUBLE_EQ(tables.budgets[0].claims.U->value, one.u) << name;
        EXPECT_EQ(tables.budgets[0].claims.U->text.find_first_of(",."), one.u > 2.0 ? std::string::npos : 1U) << name;
        EXPECT_TRUE(tables.not_read.empty()) << name;
        if (one.separator == ';') {  // the quotes around the number of the others end its words
            EXPECT_DOUBLE_EQ(tables.budgets[0].rows[0].origin_value.value_or(0.0), one.u) << name;
        }
    }
}

TEST(BudgetsIn, SaysOfATableOfOpenNumbersThatItIsNotLookedAt) {
    const ForeignTables tables = tables_of("quantity;unit;u;sensitivity\na;mm;1.200;1\nb;mm;2.500;1\nU;5.000;mm\n");
    EXPECT_TRUE(tables.budgets.empty());
    ASSERT_EQ(tables.not_read.size(), 4U) << "three numbers and the table";
    EXPECT_NE(tables.not_read[3].english().find("budget!A1: the table is not looked at"), std::string::npos)
        << tables.not_read[3].english();
}

/// Tables beside each other are as many budgets as below each other, whatever stands around them.
TEST(BudgetsIn, ReadsTablesBesideEachOther) {
    const std::vector<std::vector<std::string>> table = {{"measurand", "Weight", "", ""},
                                                         {"quantity", "unit", "u", "sensitivity"},
                                                         {"a", "mg", "0.3", "1"},
                                                         {"b", "mg", "0.4", "1"},
                                                         {"c", "mg", "1.2", "1"},
                                                         {"u_c", "1.3", "mg", ""},
                                                         {"k", "2", "", ""},
                                                         {"U", "2.6", "mg", ""}};
    for (std::size_t beside = 1; beside <= 4; ++beside) {
        for (const std::string& gap : {std::string(), std::string(",")}) {
            std::string csv = "title,of the sheet\n";
            for (const std::vector<std::string>& line : table) {
                for (std::size_t i = 0; i < beside; ++i) {
                    for (const std::string& field : line) {
                        csv += field + ",";
                    }
                    csv += gap;
                }
                csv += "\n";
            }
            csv += "\n\nquantity,unit,u,sensitivity,comment,source\nd,mg,5,1,a table,alone\ne,mg,12,1,,\nU,26,mg\n";
            const ForeignTables tables = tables_of(csv);
            ASSERT_EQ(tables.budgets.size(), beside + 1) << csv;
            EXPECT_TRUE(tables.not_read.empty()) << csv;
            for (std::size_t i = 0; i <= beside; ++i) {
                const AuditedBudget& budget = tables.budgets[i];
                EXPECT_EQ(budget.rows.size(), i == beside ? 2U : 3U) << csv;
                EXPECT_EQ(budget.claims.U ? budget.claims.U->value : 0.0, i == beside ? 26.0 : 2.6) << csv;
                EXPECT_EQ(budget.u_c_over_rows, 1.0) << csv;
            }
        }
    }
}

TEST(BudgetsIn, TakesANameForWordsThatBeginsWithANumber) {
    const ForeignTables tables =
        tables_of("measurand;1.200 mbar gauge\nquantity;unit;u\na;mbar;5\nb;mbar;12\nU;26;mbar\nequation;2 a + b\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    EXPECT_EQ(tables.budgets[0].name, "1.200 mbar gauge");
    EXPECT_EQ(tables.budgets[0].equation, "2 a + b");
    EXPECT_TRUE(tables.not_read.empty());
}

TEST(BudgetsIn, ReadsADescriptionBesideASymbol) {
    for (const char* const heads : {"symbol,description", "description,symbol"}) {
        const ForeignTables tables =
            tables_of(std::string(heads) + ",unit,u,sensitivity\n" +
                      (heads[0] == 's' ? "ev,evaporation" : "evaporation,ev") + ",ml,0.1,1\n" +
                      (heads[0] == 's' ? "dr,drift of the reference standard" : "drift of the reference standard,dr") +
                      ",ml,0.1,1\nU,,,0.3,ml\n");
        ASSERT_EQ(tables.budgets.size(), 1U) << heads;
        ASSERT_EQ(tables.budgets[0].rows.size(), 2U) << heads;
        EXPECT_EQ(tables.budgets[0].rows[1].contributor, Contributor::reference_drift) << heads;
        EXPECT_EQ(tables.budgets[0].rows[0].quantity + tables.budgets[0].rows[0].description,
                  heads[0] == 's' ? "evevaporation" : "evaporationev");
    }
}

TEST(BudgetsIn, ReadsDegreesOfFreedomThatAreALeast) {
    const ForeignTables tables = tables_of(
        "quantity,unit,type,u,sensitivity,nu\na,dB,A,0.03,1,>100\nb,dB,A,0.04,1,≥ "
        "50\nc,dB,B,0.02,1,n/a\nU,,,,0.11,dB\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    EXPECT_TRUE(tables.not_read.empty());
    EXPECT_EQ(tables.budgets[0].rows[0].used_nu, 100.0);
    EXPECT_EQ(tables.budgets[0].rows[1].used_nu, 50.0);
    EXPECT_TRUE(std::isinf(tables.budgets[0].rows[2].used_nu));
}

/// A table without a column of estimates (UKAS M3003): the value stands under what is divided.
ForeignTables table_with_value(const std::string& line) {
    return tables_of(
        "Source of uncertainty,Value ±,Unit,Probability distribution,Divisor,c_i,u_i / dB,v_i\n"
        "Reference attenuator,0.030,dB,normal,2,1,0.0150,∞\n"
        "Mismatch,0.045,dB,U-shaped,1.414,1,0.0318,∞\n"
        "Repeatability,0.012,dB,normal,1,1,0.0120,9\n" +
        line + "\nCombined standard uncertainty,,,normal,,,0.0371,>500\n" +
        "Expanded uncertainty (k = 2),,,normal,,,0.074,>500\n");
}

/// The law: whatever the value is called, and under what is divided or under u, it is no row, and it is told.
TEST(BudgetsIn, TakesALastNumberWithoutAnythingElseForNoRow) {
    for (const std::string name : {"Attenuation", "Indication", "Calibration result", "Power level", "x"}) {
        for (const std::string& line : {name + ",40.052,dB", name + ",40.052 dB", name + ",,dB,,,,40.052"}) {
            const ForeignTables tables = table_with_value(line);
            ASSERT_EQ(tables.budgets.size(), 1U) << line;
            const AuditedBudget& budget = tables.budgets.front();
            EXPECT_EQ(budget.rows.size(), 3U) << line;
            EXPECT_EQ(budget.u_c_over_rows, 1.0) << line;
            const bool is_value = budget.claims.value.has_value();
            EXPECT_EQ(tables.not_read.size(), is_value ? 0U : 1U) << line;
        }
    }
    // Rows that do not give what is stated hide behind no value either, and a row that the sum has stays one.
    EXPECT_EQ(table_with_value("Attenuation,40.052,dB\nIndication,40.1,dB").budgets.front().rows.size(), 3U);
    const ForeignTables of_four = tables_of(
        "Source of uncertainty,Value ±,Unit,Probability distribution,Divisor,c_i,u_i / dB,v_i\n"
        "Reference attenuator,0.030,dB,normal,2,1,0.0150,∞\n"
        "Mismatch,0.045,dB,U-shaped,1.414,1,0.0318,∞\n"
        "Repeatability,0.012,dB,normal,1,1,0.0120,9\n"
        "Connectors,0.020,dB\n"
        "Combined standard uncertainty,,,normal,,,0.0422,>500\n");
    ASSERT_EQ(of_four.budgets.size(), 1U);
    EXPECT_EQ(of_four.budgets.front().rows.size(), 4U);
}

TEST(BudgetsIn, TakesACertificateInTheCommentForTheSource) {
    const ForeignTables tables = tables_of(
        "quantity,unit,U or a,divisor,u,sensitivity,comment\n"
        "\"voltmeter, standard\",µV,1.5,2,0.75,1,\"U = 1.5 µV, k = 2; certificate 91-E; 10.2 µV/K\"\n"
        "\"voltmeter, device\",µV,1.5,2,0.75,1,\"U = 1.5 µV, k = 2; certificate 91-E; 39 µV/K\"\n"
        "drift,µV,0.3,√3,0.173,1,±0.3 µV\n"
        "U,µV,2.1\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    const std::vector<AuditedRow>& rows = tables.budgets[0].rows;
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].source, "certificate 91-E");
    EXPECT_EQ(rows[0].source, rows[1].source);
    EXPECT_EQ(rows[2].source, "");
}

TEST(BudgetsIn, NamesAColumnThatIsNotRead) {
    const ForeignTables tables = tables_of(
        "symbol,description,unit,u,u(xi),sensitivity\na,length,mm,0.1,0.5,1\nb,form,mm,0.2,0.5,1\nU,0.45,mm\n");
    ASSERT_EQ(tables.budgets.size(), 1U) << "a symbol and a description are of one table";
    EXPECT_DOUBLE_EQ(tables.budgets[0].rows[0].used_u, 0.1);
    ASSERT_EQ(tables.not_read.size(), 1U);
    EXPECT_NE(tables.not_read[0].english().find("budget!E1: the column \"u(xi)\""), std::string::npos)
        << tables.not_read[0].english();
}

TEST(BudgetsIn, ReadsMarksOfTypes) {
    const ForeignTables tables = tables_of(
        "Quantity,Type A,Type B,Contribution / mV\nReadings (ν = 9),x,,0.05\nReference,,x,0.10\n"
        "Drift of the reference,,x,0.05\nResolution,,x,0.20\n"
        "Combined standard uncertainty,,,0.235\nExpanded uncertainty (k = 2),,,0.47\n");
    ASSERT_EQ(tables.budgets.size(), 1U);
    const AuditedBudget& budget = tables.budgets[0];
    ASSERT_EQ(budget.rows.size(), 4U);
    EXPECT_EQ(budget.rows[0].type_a, true);
    for (std::size_t i = 1; i < budget.rows.size(); ++i) {
        EXPECT_EQ(budget.rows[i].type_a, false) << i;
    }
    ASSERT_TRUE(budget.claims.u_c);
    EXPECT_EQ(budget.claims.u_c->value, 0.235);
    EXPECT_TRUE(tables.not_read.empty()) << tables.not_read[0].english();
}

TEST(BudgetsIn, ReadsUBesideWeights) {
    for (const char* const symbol : {"w", "w_i"}) {
        const ForeignTables tables = tables_of("Quantity,Half-width / µm," + std::string(symbol) +
                                               ",u / µm\nStandard,0.6,0.5,0.30\nResolution,0.2,0.58,0.12\n"
                                               "Repeatability,0.1,1,0.10\nu_c,,,0.34\nU (k = 2),,,0.68\n");
        ASSERT_EQ(tables.budgets.size(), 1U) << symbol;
        ASSERT_EQ(tables.budgets[0].rows.size(), 3U) << symbol;
        EXPECT_DOUBLE_EQ(tables.budgets[0].rows[0].used_u, 0.3) << symbol;
        ASSERT_TRUE(tables.budgets[0].claims.u_c) << symbol;
        EXPECT_EQ(tables.budgets[0].claims.u_c->value, 0.34) << symbol;
    }
}

}  // namespace
}  // namespace gumcert::audit
