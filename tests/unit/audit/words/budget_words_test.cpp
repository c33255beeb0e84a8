#include "audit/words/budget_words.h"

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
    EXPECT_TRUE(is_called_part("of which sensor"));
    EXPECT_TRUE(is_called_part("davon Fühler"));
    EXPECT_FALSE(is_called_part("Sensor"));
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

TEST(CoverageIn, KnowsKAndPHoweverTheyAreWritten) {
    for (const char* const text : {"k = 2", "(k=2)", "Normal (k = 2)", "coverage factor of 2",
                                   "Erweiterungsfaktor k = 2", "k95 = 2", "U with k = 2"}) {
        EXPECT_EQ(coverage_in(text).k.substr(0, 1), "2") << text;
    }
    for (const char* const text : {"95 %", "p = 95 %", "k = 2, 95%", "0.95 of it: p = 0.95"}) {
        ASSERT_TRUE(coverage_in(text).p) << text;
        EXPECT_NEAR(*coverage_in(text).p, 0.95, 1e-12) << text;
    }
    EXPECT_NEAR(*coverage_in("95,45 %").p, 0.9545, 1e-12);
    for (const char* const text : {"", "Normal", "0.5 % of the reading", "kPa 2", "100 %", "risk 2", "u = 2 mm"}) {
        EXPECT_FALSE(coverage_in(text).says_any()) << text;
    }
}

TEST(CoverageIn, IsAllThatStandsBesideAUOfTheValue) {
    for (const char* text : {"", "(k = 2)", "k = 2, p = 95 %", "(%)", "in %", "ppm", "µm/m", "normal, k=2",
                             "of reading", "(of the measured value)", "–", "0.044", "0.044 % (k = 2)"}) {
        EXPECT_TRUE(says_coverage_alone(text)) << text;
    }
    for (const char* text : {"(of full scale)", "FS", "% FS", "% of span", "v. E.", "bezogen auf den Messbereich",
                             "related to 10 N·m", "of 10 N·m", "(k = 2) of the nominal torque"}) {
        EXPECT_FALSE(says_coverage_alone(text)) << text;
    }
    EXPECT_FALSE(named_statement("Relative expanded uncertainty (k = 2)")->says_of_what);
    EXPECT_TRUE(named_statement("Relative expanded uncertainty (k = 2) of the nominal torque")->says_of_what);
    EXPECT_TRUE(named_statement("Relative expanded uncertainty (full scale)")->says_of_what);
}

TEST(CertificateIn, IsNamedByItsNumber) {
    EXPECT_EQ(certificate_in("U = 1.5 µV, k = 2; certificate 91-E; 39 µV/K"), "certificate 91-E");
    EXPECT_EQ(certificate_in("Kalibrierschein 4711-D-K-2025"), "Kalibrierschein 4711-D-K-2025");
    EXPECT_EQ(certificate_in("cert. No. 12, 2024"), "certificate No. 12");
    for (const char* const text : {"", "certificate", "certificate of the maker, 2024", "see the certificate"}) {
        EXPECT_EQ(certificate_in(text), "") << text;
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

TEST(SumNameOf, TellsSumsOfSquaresFromTheVarianceOfOneThing) {
    for (const char* const name : {"Sum of squares", "u_c²", "u²", "Variance", "Combined variance", "Sum of variances",
                                   "Variance of the result", "Sum of the variances of the components"}) {
        EXPECT_EQ(sum_name(name), SumName::of_squares) << name;
    }
    for (const char* const name : {"Variance of the standard", "Variance of the balance", "Varianz des Normals"}) {
        EXPECT_EQ(sum_name(name), SumName::none) << name;
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
