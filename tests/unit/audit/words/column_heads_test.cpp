#include "audit/words/column_heads.h"

#include <gtest/gtest.h>

#include <optional>

namespace gumcert::audit {
namespace {

TEST(IsOfOtherLanguage, TellsHeadsOfLanguagesInWhichRowsAreNotRead) {
    for (const char* const head : {"Magnitud", "Incertidumbre típica u(x_i) (mV)", "Unité", "Loi", "Demi-étendue",
                                   "Contribution à l’incertitude", "標準不確定度", "分布", "Tolerancia"}) {
        EXPECT_TRUE(is_of_other_language(head)) << head;
    }
    for (const char* const head :
         {"Magnitude", "Component", "Komponente", "Value", "Source of uncertainty", "Divisor", "Distribution",
          "u_i(y) / mV", "Größe", "Standardunsicherheit", "Ursprung", "c_i ≡ ∂f/∂x"}) {
        EXPECT_FALSE(is_of_other_language(head)) << head;
    }
}

TEST(ColumnOfAHead, KnowsTheLayoutOfM3003) {
    EXPECT_EQ(column_of("Value ± kPa"), Column::stated);
    EXPECT_EQ(column_of("ui(P) ± kPa"), Column::contribution);
    EXPECT_EQ(column_of("u_i(y) ± µV/V"), Column::contribution);
    EXPECT_EQ(column_of("u(x) ± mm"), column_of("u(x)"));
    EXPECT_EQ(column_of("vi or veff"), Column::nu);
    EXPECT_EQ(column_of("±"), Column::stated);
    EXPECT_EQ(column_of("nothing ± kPa"), std::nullopt);
}

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

TEST(ColumnOf, TakesACutWordForTheWord) {
    for (const char* head : {"Standard-unsicherheit", "Standard-\nunsicherheit", "Standard- unsicherheit u(xi)",
                             "Std.-Unsicherheit [µV]", "Standard-Messunsicherheit"}) {
        EXPECT_EQ(column_of(head), Column::u) << head;
    }
    for (const char* head : {"Sensitivitäts-koeffizient", "Sensitivitätskoeff.", "Sens.-Koeff.", "Sens.-coeff. c_i"}) {
        EXPECT_EQ(column_of(head), Column::sensitivity) << head;
    }
    EXPECT_EQ(column_of("prob.-distribution"), Column::distribution);
    EXPECT_EQ(column_of("Unsich.-Beitrag"), Column::contribution);
    // Of any y: of an x it is u.
    EXPECT_EQ(column_of("ui(V)"), Column::contribution);
    EXPECT_EQ(column_of("ui(V) (µV)"), Column::contribution);
    EXPECT_EQ(column_of("u_i(y) / nm"), Column::contribution);
    EXPECT_NE(column_of("ui(xi)"), Column::contribution);
}

TEST(UnusedColumns, AreSquaresAndShares) {
    for (const char* head :
         {"(c·u)² (kPa²)", "u²", "(c_i u_i)^2", "u_i(y)²", "c²u²", "Anteil [%]", "Varianz [mbar²]"}) {
        EXPECT_TRUE(is_unused_column(head)) << head;
    }
    for (const char* head : {"Force²", "Area / mm²", "u / mm", "what"}) {
        EXPECT_FALSE(is_unused_column(head)) << head;
    }
}

TEST(ColumnOf, TellsASmallUFromACapitalOne) {
    EXPECT_EQ(column_of("u"), Column::u);
    EXPECT_EQ(column_of("u(xi) [µm]"), Column::u);
    EXPECT_EQ(column_of("U"), Column::stated);
    EXPECT_EQ(column_of("U or a"), Column::stated);
    EXPECT_EQ(column_of("U95 (k=2)"), Column::stated);
}

TEST(ColumnOf, KnowsShortFormsOfDistribution) {
    for (const char* head : {"prob. distribution", "probability dist.", "prob. dist."}) {
        EXPECT_EQ(column_of(head), Column::distribution) << head;
    }
}

TEST(RelativeColumnOf, KnowsTheSymbolsOfIso376) {
    for (const char* const head : {"w / %", "w (%)", "w_i [ppm]", "w(x_i) / %", "Relative standard uncertainty (%)",
                                   "Relative standard uncertainty %", "rel. u / ppm"}) {
        EXPECT_EQ(relative_column_of(head), Column::u) << head;
        EXPECT_EQ(column_of(head), std::nullopt) << head;
    }
    for (const char* const head :
         {"w", "w / mm", "W / %", "weight / %", "u_rel", "u_rel / %", "RSU (%)", "U_rel / %", "RSU", "Share %"}) {
        EXPECT_EQ(relative_column_of(head), std::nullopt) << head;
    }
}

TEST(LimitHead, KnowsBothEndsAndNoCoverageInterval) {
    for (const char* const head : {"Lower", "Lower limit / mV", "a-", "a− (mm)", "Untergrenze", "lower bound"}) {
        EXPECT_EQ(limit_head(head), LimitHead::lower) << head;
    }
    for (const char* const head : {"Upper", "Upper limit / mV", "a+", "a+ (mm)", "Obergrenze"}) {
        EXPECT_EQ(limit_head(head), LimitHead::upper) << head;
    }
    for (const char* const head : {"Lower (95 %)", "Upper 95 %", "Lower (k = 2)", "a", "±a", "Limit", "alpha-"}) {
        EXPECT_FALSE(limit_head(head)) << head;
    }
}

}  // namespace
}  // namespace gumcert::audit
