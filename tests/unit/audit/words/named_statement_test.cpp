#include "audit/words/named_statement.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace gumcert::audit {
namespace {

TEST(Statements, MayHaveTheirUnitBehindTheName) {
    for (const char* name : {"Expanded uncertainty / dB", "Expanded uncertainty / dB, k = 2", "U / mV, k = 2",
                             "U95 in mV", "U / µg = 721 (k = 2)", "Erweiterte Messunsicherheit in µm (k = 2)"}) {
        EXPECT_EQ(statement_of(name), Statement::U) << name;
    }
    EXPECT_EQ(statement_of("Combined std. uncertainty / dB"), Statement::u_c);
    EXPECT_EQ(named_statement("Expanded uncertainty / dB, k = 2")->coverage, ", k = 2");
    EXPECT_FALSE(statement_of("Temperature in °C"));
    // What is a quantity without its unit may be one with it.
    for (const char* name : {"U / V", "U / kV", "I / A", "k / N", "Correction in µm", "Error in mm", "Tolerance in µm",
                             "CMC / µm", "U / V = 230"}) {
        EXPECT_FALSE(statement_of(name)) << name;
    }
    // One unit is taken off a name, however many stand in it: each of them twice as long to read was a minute at 18.
    std::string many = "A";
    for (int i = 0; i < 30; ++i) {
        many = many + " / m";
    }
    for (int i = 0; i < 15; ++i) {
        many = many + " in m";
    }
    EXPECT_LT(many.size(), 200U);
    EXPECT_FALSE(statement_of(many));
}

TEST(StatementOf, KnowsTheRowsOfTheContractAndTheirSynonyms) {
    EXPECT_EQ(statement_of("u_c"), Statement::u_c);
    EXPECT_EQ(statement_of("nu_eff"), Statement::nu_eff);
    EXPECT_EQ(statement_of("ν_eff"), Statement::nu_eff);
    EXPECT_EQ(statement_of("k"), Statement::k);
    EXPECT_EQ(statement_of("U"), Statement::U);
    EXPECT_EQ(statement_of("U:"), Statement::U);
    EXPECT_EQ(statement_of("u"), Statement::u_c);
    EXPECT_EQ(statement_of("Erweiterte Messunsicherheit"), Statement::U);
    EXPECT_EQ(statement_of("Combined standard uncertainty"), Statement::u_c);
    EXPECT_EQ(statement_of("CMC"), Statement::capability);
    EXPECT_EQ(statement_of("E_n"), Statement::en);
    EXPECT_FALSE(statement_of("resolution"));
}

TEST(NamedStatement, HasWhatItsNameSaysBesideIt) {
    const std::optional<NamedStatement> covered = named_statement("Expanded uncertainty (k = 2.08, p = 95.45 %)");
    ASSERT_TRUE(covered);
    EXPECT_EQ(covered->statement, Statement::U);
    EXPECT_FALSE(covered->may_be_quantity);
    EXPECT_EQ(coverage_in(covered->coverage).k.substr(0, 4), "2.08");
    const std::optional<NamedStatement> assigned = named_statement("U = 0.096 mg");
    ASSERT_TRUE(assigned);
    EXPECT_EQ(assigned->statement, Statement::U);
    EXPECT_EQ(assigned->assigned, "0.096 mg");
    EXPECT_TRUE(named_statement("U")->may_be_quantity);
    EXPECT_TRUE(named_statement("measured value")->may_be_quantity);
    EXPECT_FALSE(named_statement("Messergebnis")->may_be_quantity);
    EXPECT_FALSE(named_statement("U (k = 2)")->may_be_quantity);
    EXPECT_EQ(named_statement("Kombinierte Standardunsicherheit")->statement, Statement::u_c);
    EXPECT_EQ(coverage_in("EXPANDED UNCERTAINTY (K = 2)").k, "2)");
    EXPECT_EQ(coverage_in("U (K=2.13)").k, "2.13)");
    EXPECT_TRUE(coverage_in("T / K 2").k.empty());
    EXPECT_EQ(named_statement("Total (k = 1)")->statement, Statement::u_c);
    EXPECT_EQ(named_statement("Total (k = 2)")->statement, Statement::U);
    for (const char* const row : {"Total", "Total (dry)", "Temperature total (k = 1)", "Total pressure (k = 2)"}) {
        EXPECT_FALSE(named_statement(row)) << row;
    }
    EXPECT_FALSE(named_statement("calibration of the standard (k = 2)"));
    EXPECT_FALSE(named_statement("uncertainty of the weighing, 95 %"));
}

TEST(NamedStatement, SaysOfWhatItIsAPartBesideItsCoverage) {
    EXPECT_FALSE(named_statement("Relative expanded uncertainty (k = 2)")->says_of_what);
    EXPECT_TRUE(named_statement("Relative expanded uncertainty (k = 2) of the nominal torque")->says_of_what);
    EXPECT_TRUE(named_statement("Relative expanded uncertainty (full scale)")->says_of_what);
}

}  // namespace
}  // namespace gumcert::audit
