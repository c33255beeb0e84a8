#include "audit/sources/budget_words.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(ColumnOf, KnowsHeadsOfTheContractAndTheirSynonyms) {
    EXPECT_EQ(column_of("quantity"), Column::quantity);
    EXPECT_EQ(column_of("Eingangsgröße"), Column::quantity);
    EXPECT_EQ(column_of("Source of uncertainty"), Column::quantity);
    EXPECT_EQ(column_of("estimate"), Column::estimate);
    EXPECT_EQ(column_of("Schätzwert"), Column::estimate);
    EXPECT_EQ(column_of("divisor"), Column::divisor);
    EXPECT_EQ(column_of("Verteilung"), Column::distribution);
    EXPECT_EQ(column_of("Sensitivity coefficient c_i"), Column::sensitivity);
    EXPECT_EQ(column_of("contribution"), Column::contribution);
    EXPECT_EQ(column_of("Unsicherheitsbeitrag"), Column::contribution);
    EXPECT_EQ(column_of("ν"), Column::nu);
    EXPECT_EQ(column_of("Freiheitsgrade"), Column::nu);
    EXPECT_EQ(column_of("Quelle"), Column::source);
    EXPECT_EQ(column_of("Bemerkung"), Column::comment);
    EXPECT_FALSE(column_of("weather"));
    EXPECT_FALSE(column_of(""));
}

TEST(ColumnOf, TellsASmallUFromACapitalOne) {
    EXPECT_EQ(column_of("u"), Column::u);
    EXPECT_EQ(column_of("u(xi) [µm]"), Column::u);
    EXPECT_EQ(column_of("U"), Column::stated);
    EXPECT_EQ(column_of("U or a"), Column::stated);
    EXPECT_EQ(column_of("U95 (k=2)"), Column::stated);
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

TEST(ColumnOf, KnowsShortFormsOfDistribution) {
    for (const char* head : {"prob. distribution", "probability dist.", "prob. dist."}) {
        EXPECT_EQ(column_of(head), Column::distribution) << head;
    }
}

}  // namespace
}  // namespace gumcert::audit
