// Rows whose values make up that of the result as a product: c = y/x is taken where units and numbers show it, and nothing else is.
#include "audit/tables/product_of_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport report_of_product(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}
bool finds_in_product(const AuditReport& report, std::string_view rule) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [rule](const AuditFinding& finding) { return finding.rule == rule; });
}
/// What is found of the sum of the rows.
std::string accused_sums(const AuditReport& report) {
    std::string all;
    for (const AuditFinding& finding : report.findings) {
        if (finding.rule.front() == 'S' || finding.rule == "K01" || finding.rule == "K09") {
            all += finding.rule + " " + finding.where + ": " + finding.what.english() + "\n";
        }
    }
    return all;
}
bool says_of_product(const AuditReport& report, const std::string& text) {
    return std::any_of(report.subject.not_read.begin(), report.subject.not_read.end(),
                       [&text](const Sentence& said) { return said.english().find(text) != std::string::npos; });
}

TEST(ProductOfRows, FindsTheExponentsThatFitUnitsAndNumbers) {
    const std::vector<Factor> rows = {
        {.value = 100.28, .unit = "mg"}, {.value = 0.93, .unit = ""}, {.value = 100.0, .unit = "mL"}};
    const auto product = product_of_rows(rows, {.value = 932.604, .relative_half_step = 5e-5, .unit = "mg/L"});
    ASSERT_TRUE(product);
    EXPECT_EQ(product->choices, (std::vector<std::vector<double>>{{1.0, 1.0, -1.0}}));
    EXPECT_TRUE(product->has_all_choices);
    EXPECT_FALSE(product->has_equal_factors);
    // Whatever exponent 1.000 has, the product is the same.
    const auto open = product_of_rows({rows[0], {.value = 1.0, .unit = "1"}, rows[2]},
                                      {.value = 1002.8, .relative_half_step = 5e-5, .unit = "mg/L"});
    ASSERT_TRUE(open);
    EXPECT_EQ(open->choices.size(), 6U);
    EXPECT_EQ(open->choices[0], (std::vector<double>{1.0, 1.0, -1.0}));
    // Rows of one dimension may be those of a sum.
    EXPECT_FALSE(
        product_of_rows({{.value = 100.0, .unit = "V"}, {.value = 100.0, .unit = "V"}, {.value = 0.1, .unit = "kV"}},
                        {.value = 100.0, .unit = "V"}));
    EXPECT_FALSE(
        product_of_rows({{.value = 2.0, .unit = "1"}, {.value = 2.0, .unit = ""}}, {.value = 4.0, .unit = "1"}));
    // Another number, another unit, a unit that nobody knows, a value of 0, and a temperature on a scale.
    EXPECT_FALSE(product_of_rows(rows, {.value = 942.7, .relative_half_step = 5e-5, .unit = "mg/L"}));
    EXPECT_FALSE(product_of_rows(rows, {.value = 932.604, .relative_half_step = 5e-5, .unit = "mg"}));
    EXPECT_FALSE(product_of_rows(rows, {.value = 932.604, .relative_half_step = 5e-5, .unit = "HRC"}));
    EXPECT_FALSE(product_of_rows({{.value = 0.0, .unit = "mg"}, rows[2]}, {.value = 0.0, .unit = "mg/L"}));
    EXPECT_FALSE(
        product_of_rows({{.value = 20.0, .unit = "°C"}, {.value = 2.0, .unit = "m"}}, {.value = 40.0, .unit = "m·K"}));
    EXPECT_FALSE(product_of_rows({rows[0]}, {.value = 100.28, .unit = "mg"}));
    EXPECT_TRUE(product_of_rows({rows[0], rows[0], rows[2], {.value = 100.28, .unit = "mg"}},
                                {.value = 1.0028e6 * 1e-6 * 100.28 / 100.28, .relative_half_step = 1e-4, .unit = "g/L"})
                    .value_or(ProductOfRows{.choices = {}, .has_all_choices = true, .has_equal_factors = true})
                    .has_equal_factors);
}

struct ModelOfProduct {
    std::vector<std::string> units;
    std::vector<int> exponents;
    double scale;  ///< of the units to that of the result
    std::string unit;
};
const std::vector<ModelOfProduct> k_models_of_products = {{{"mg", "1", "mL"}, {1, 1, -1}, 1000.0, "mg/L"},
                                                          {{"mg/L", "mL", "g"}, {1, 1, -1}, 1.0, "mg/kg"},
                                                          {{"V", "Ω"}, {1, -1}, 1.0, "A"},
                                                          {{"mg/L", "mL", "mL", "1"}, {1, 1, -1, -1}, 1.0, "mg/L"},
                                                          {{"kg", "m/s2", "m2"}, {1, 1, -1}, 1.0, "Pa"},
                                                          {{"g", "%", "g/mol", "L"}, {1, 1, -1, -1}, 0.01, "mol/L"},
                                                          {{"mL", "mol/L", "g/mol", "g"}, {1, 1, 1, -1}, 1e-3, "1"}};

struct MadeProduct {
    std::string rows;
    double value = 1.0, u_c = 0.0, without_largest = 0.0;
};
MadeProduct made_product(const ModelOfProduct& model, std::mt19937& random) {
    MadeProduct made{.rows = "Quantity,Value,Unit,Standard uncertainty\n"};
    double largest = 0.0, squares = 0.0, value = model.scale;
    for (std::size_t i = 0; i < model.units.size(); ++i) {
        // No value near to 1 without a dimension, and no two alike: their exponents are known.
        const double x =
            std::stod(text::significant((model.units[i] == "%" ? 60.0 : 2.0) + 9.0 * static_cast<double>(i) +
                                            static_cast<double>(random() % 1000) * 0.007,
                                        5));
        const double u = std::stod(text::significant(x * (0.002 + static_cast<double>(random() % 100) * 1e-4), 4));
        value *= std::pow(x, model.exponents[i]);
        squares += u / x * u / x;
        largest = std::max(largest, u / x);
        made.rows += "Factor " + std::string(1, static_cast<char>('A' + i)) + "," + text::significant(x, 5) + "," +
                     model.units[i] + "," + text::significant(u, 4) + "\n";
    }
    made.value = value;
    made.u_c = value * std::sqrt(squares);
    made.without_largest = value * std::sqrt(squares - largest * largest);
    return made;
}

/// The law: a product of any quantities accuses nobody, however its result stands, and one whose u_c leaves out its largest row is found.
TEST(ProductOfRows, AccusesNoSoundProductAndFindsARowThatIsLeftOut) {
    std::mt19937 random(20261130);
    for (int trial = 0; trial < 140; ++trial) {
        const ModelOfProduct& model =
            k_models_of_products[static_cast<std::size_t>(trial) % k_models_of_products.size()];
        const MadeProduct made = made_product(model, random);
        const auto with = [&](double u_c) {
            const std::string value = text::significant(made.value, 6), u = text::significant(u_c, 4),
                              U = text::significant(2.0 * u_c, 4);
            const std::string last = "Expanded uncertainty (k = 2),," + model.unit + "," + U + "\n";
            switch (trial % 3) {
                case 0:
                    return made.rows + "Result," + value + "," + model.unit + "," + u + "\n" + last;
                case 1:
                    return made.rows + "Combined standard uncertainty,," + model.unit + "," + u + "\n" + last +
                           "Result," + value + "," + model.unit + ",\n";
                default:
                    return made.rows + "Concentration of all," + value + "," + model.unit + "," + u + "\n" + last;
            }
        };
        const AuditReport sound = report_of_product(with(made.u_c));
        ASSERT_EQ(sound.results.size(), 1U) << with(made.u_c);
        EXPECT_EQ(accused_sums(sound), "") << with(made.u_c);
        EXPECT_TRUE(says_of_product(sound, "c = y/x is taken for each")) << with(made.u_c);
        EXPECT_NEAR(sound.results[0].audited.u_c, made.u_c, 1e-3 * made.u_c) << with(made.u_c);
        const AuditReport planted = report_of_product(with(made.without_largest));
        // A last row may be one of a sum as well, where it is nearly all of it.
        EXPECT_TRUE(finds_in_product(planted, "K01") || (trial % 3 == 2 && planted.results.empty()))
            << with(made.without_largest);
        EXPECT_FALSE(finds_in_product(planted, "S01")) << with(made.without_largest);
    }
}

/// The law: several rows of one unit and one value are a sum, whatever their values make up; a row that was left out of u_c is found.
TEST(ProductOfRows, RowsOfOneUnitAndOneValueAreASum) {
    const std::vector<std::string> values = {"100,V", "1.000,1", "20,N", "100,%", "5.0000,mV", "1,dB"};
    for (std::size_t count = 3; count <= 14; ++count) {
        for (const std::string& value : values) {
            for (const bool has_line : {true, false}) {
                const std::string unit = value.substr(value.find(',') + 1);
                std::string rows = "Quantity,Value,Unit,Standard uncertainty\n";
                double squares = 0.0, last = 0.0;
                for (std::size_t i = 0; i < count; ++i) {
                    last = 0.03123 + 0.00717 * static_cast<double>((i * 5) % 14);
                    squares += last * last;
                    rows +=
                        "Contributor " + std::to_string(i + 1) + "," + value + "," + text::significant(last, 5) + "\n";
                }
                const auto with = [&](double u_c) {
                    const std::string line =
                        has_line ? "Combined standard uncertainty,," + unit + "," + text::significant(u_c, 4) + "\n"
                                 : "";
                    return report_of_product(rows + line + "Expanded uncertainty (k = 2),," + unit + "," +
                                             text::significant(2.0 * u_c, 4) + "\n");
                };
                const AuditReport sound = with(std::sqrt(squares));
                ASSERT_EQ(sound.results.size(), 1U) << rows;
                EXPECT_EQ(accused_sums(sound), "") << rows;
                EXPECT_TRUE(finds_in_product(with(std::sqrt(squares - last * last)), "K01")) << rows;
            }
        }
    }
}

TEST(ProductOfRows, IsNotLookedAtWhereItsCoefficientsAreOpen) {
    // A factor of 1.000 above the line or below it, with a correlation.
    const std::string of_mass = "Quantity,Value,Unit,Standard uncertainty\nMass of sample,10.00,mg,0.10\n";
    const AuditReport correlated =
        report_of_product(of_mass +
                          "Recovery,1.000,1,0.010\nVolume,10.00,mL,0.01\nResult,1000.0,mg/L,6.4\n"
                          "r(Mass of sample; Recovery) = 0.8\nExpanded uncertainty (k = 2),,mg/L,12.8\n");
    EXPECT_TRUE(correlated.results.empty()) << accused_sums(correlated);
    EXPECT_TRUE(says_of_product(correlated, "nothing shows with which coefficients"));
    // A purity that counts twice.
    const AuditReport squared =
        report_of_product(of_mass +
                          "Recovery,1.000,1,0.010\nVolume,10.00,mL,0.01\nCombined standard uncertainty,,mg/L,22.4\n"
                          "Expanded uncertainty (k = 2),,mg/L,44.8\nResult,1000.0,mg/L,\n");
    EXPECT_TRUE(squared.results.empty()) << accused_sums(squared);
    // Its values without a result: their u are no sum.
    const AuditReport without_value = report_of_product(
        of_mass + "Purity,0.950,1,0.010\nVolume,10.00,mL,0.01\nu_c,,mg/L,13.8\nU (k = 2),,mg/L,27.6\n");
    EXPECT_EQ(accused_sums(without_value), "");
    EXPECT_TRUE(says_of_product(without_value, "as a sum or as a product of their values"));
    // u that are parts of their values under a head that does not say so.
    for (const std::vector<std::string>& u :
         {std::vector<std::string>{"0.0100", "0.0200", "0.0050"}, std::vector<std::string>{"1.00", "2.00", "0.50"}}) {
        const AuditReport relative = report_of_product("Quantity,Value,Unit,Standard uncertainty\nMass,25.00,mg," +
                                                       u[0] + "\nPurity,0.950,1," + u[1] + "\nVolume,10.00,mL," + u[2] +
                                                       "\nu_c,,mg/L,54.4\nU (k = 2),,mg/L,108.8\nResult,2375,mg/L,\n");
        EXPECT_EQ(accused_sums(relative), "") << u[0];
    }
    // A contributor behind a product is no result of it.
    EXPECT_EQ(accused_sums(report_of_product("Quantity,Value,Unit,Standard uncertainty\nCurrent,10.0,A,0.10\n"
                                             "Resistance,10.0,Ω,0.10\nVoltmeter,100.0,V,0.50\n"
                                             "Expanded uncertainty (k = 2),,V,3.0\n")),
              "");
}

/// The law: a product whose U is a part of the result is none of sums, whatever stands beside the value.
TEST(ProductOfRows, WithUInPercentIsNoSum) {
    std::mt19937 random(20261201);
    for (int trial = 0; trial < 60; ++trial) {
        const ModelOfProduct& model = k_models_of_products[static_cast<std::size_t>(trial) % 5];
        const MadeProduct made = made_product(model, random);
        const std::string u = trial % 2 == 0 ? text::significant(made.u_c, 4) : "";
        const AuditReport report = report_of_product(made.rows + "Result," + text::significant(made.value, 6) + "," +
                                                     model.unit + "," + u + "\nExpanded uncertainty (k = 2),,%," +
                                                     text::significant(200.0 * made.u_c / made.value, 4) + "\n");
        EXPECT_EQ(accused_sums(report), "") << made.rows << u;
    }
}

TEST(ProductOfRows, OfOneDimensionOrInOtherUnitsIsNoSum) {
    for (const char* const rows :
         {"Flask,9.32359,mL,0.0027\nPipette,4.03054,mL,0.0016\nResult,2.31323,1,0.0011\nU (k = 2),,1,0.0023\n",
          "Power out,951.0,W,1.1\nPower in,1002.0,W,1.2\nu_c,,1,0.0016\nU (k = 2),,1,0.0032\n",
          "Diameter,10.000,mm,0.010\nu_c,,mm2,0.157\nU (k = 2),,mm2,0.314\n",
          "Titrant,0.100201,mol/L,0.000068\nVolume,20.792,mL,0.040\nAliquot,25.027,mL,0.010\nu_c,,mmol/L,0.17\n"
          "U (k = 2),,mmol/L,0.34\n"}) {
        const AuditReport report = report_of_product("Quantity,Value,Unit,Standard uncertainty\n" + std::string(rows));
        EXPECT_EQ(accused_sums(report), "") << rows;
        EXPECT_TRUE(says_of_product(report, "as a sum or as a product of their values")) << rows;
    }
    // No power of volts is a temperature.
    EXPECT_TRUE(finds_in_product(report_of_product("Quantity,Unit,Standard uncertainty\nReference,V,0.0010\n"
                                                   "Drift,V,0.0010\nu_c,°C,0.050\nU (k = 2),°C,0.10\n"),
                                 "S01"));
    // A result in another language is one.
    for (const char* const name : {"Resultado", "Résultat", "結果", "结果"}) {
        EXPECT_TRUE(says_of_product(report_of_product("Quantity,Value,Unit,Standard uncertainty\n"
                                                      "Voltage,20.00,V,0.10\nResistance,5.000,Ω,0.010\n" +
                                                      std::string(name) + ",4.000,A,0.0215\nU (k = 2),,A,0.043\n"),
                                    "c = y/x is taken for each"))
            << name;
    }
}

/// A content in mg/g beside factors is a product of numbers, and no sum of them.
TEST(ProductOfRows, MayBeOfContentsAndFactors) {
    const auto with = [](const std::string& last) {
        return report_of_product(
            "Quantity,Value,Unit,Standard uncertainty\nContent as received,10.023,mg/g,0.021\n"
            "Moisture,0.500,1,0.010\nFactor,1.000,1,0.002\n" +
            last);
    };
    for (const char* const sound :
         {"Result,20.05,mg/g,\nCombined standard uncertainty,,mg/g,0.41\nU (k = 2),,mg/g,0.81\n",
          "Result,20.05,mg/g,\nU (k = 2),,mg/g,0.81\n", "Result,20.05,mg/g,0.41\nU (k = 2),,mg/g,0.81\n"}) {
        const AuditReport report = with(sound);
        EXPECT_EQ(accused_sums(report), "") << sound;
        EXPECT_TRUE(says_of_product(report, "c = y/x is taken for each")) << sound;
    }
    // The moisture is left out.
    EXPECT_TRUE(finds_in_product(
        with("Result,20.05,mg/g,\nCombined standard uncertainty,,mg/g,0.058\nU (k = 2),,mg/g,0.12\n"), "K01"));
    // Numbers of one unit may be those of a sum.
    EXPECT_FALSE(
        product_of_rows({{.value = 0.5, .unit = "1"}, {.value = 0.2, .unit = "1"}}, {.value = 0.1, .unit = "1"}));
}

TEST(ProductOfRows, OfOnesIsTheSameAsASumOfNumbers) {
    const AuditReport ones = report_of_product(
        "Quantity,Value,Unit,Standard uncertainty\nMass,1.000,g,0.010\nVolume,1.000,L,0.020\nResult,1.000,g/L,0.0224\n"
        "Expanded uncertainty (k = 2),,g/L,0.0447\n");
    EXPECT_EQ(accused_sums(ones), "");
}

TEST(ProductOfRows, LeavesUnitsThatNoProductBringsTogether) {
    EXPECT_TRUE(finds_in_product(
        report_of_product("Quantity,Unit,Standard uncertainty\nStandard,µm,0.10\nTemperature difference,°C,0.30\n"
                          "Expansion,1/K,0.000001\nRepeatability,µm,0.05\nAir temperature,°C,0.20\nu_c,µm,0.25\n"
                          "U (k = 2),µm,0.50\n"),
        "S01"));
}

}  // namespace
}  // namespace gumcert::audit
