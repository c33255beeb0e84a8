// A law: a sound budget is not accused because of its words. To a table in which all is as it should be, one row is added
// that words or rounded numbers may let appear wrong, while the table itself shows that it is right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

struct Row {
    std::string quantity;
    double stated = 0.0, divisor = 1.0;
    std::string distribution, nu, comment;
    std::string divisor_text = "";
};

std::string written(const Row& row) {
    const double u = row.stated / row.divisor;
    return row.quantity + ",V," + text::shortest(row.stated) + "," +
           (row.divisor_text.empty() ? text::significant(row.divisor, 4) : row.divisor_text) + "," + row.distribution +
           "," + text::significant(u, 3) + ",1," + text::significant(u, 3) + "," + row.nu + ",\"" + row.comment +
           "\"\n";
}

const std::vector<Row> k_sound = {
    {"Reference standard", 0.020, 2.0, "normal", "", "U = 0.020 V, k = 2, certificate E-1"},
    {"Drift of the standard", 0.010, std::sqrt(3.0), "rectangular", "", ""},
    {"Temperature", 0.008, std::sqrt(3.0), "rectangular", "", ""},
    {"Resolution of the item", 0.005, std::sqrt(3.0), "rectangular", "", "resolution 0.01 V"},
    {"Reproducibility", 0.006, 1.0, "normal", "12", ""},
    {"Repeatability", 0.004, 1.0, "normal", "19", ""},
};

AuditReport audited(const std::vector<Row>& rows, const std::string& lines = "") {
    std::string table = "quantity,unit,U or a,divisor,distribution,u,sensitivity,contribution,nu,comment\n";
    double variance = 0.0;
    for (const Row& row : rows) {
        table += written(row);
        variance += row.stated * row.stated / (row.divisor * row.divisor);
    }
    const double u_c = std::sqrt(variance);
    table += "value,V,10.012\nu_c,V," + text::significant(u_c, 3) + "\nk,,2\nU,V," + text::significant(2.0 * u_c, 2) +
             "\ncoverage probability,,95.45 %\n" + lines;
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}

AuditReport audited_text(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}

/// What is critical or major, in a line.
std::string accusations(const AuditReport& report) {
    std::string all;
    for (const AuditFinding& finding : report.findings) {
        if (finding.severity == FindingSeverity::critical || finding.severity == FindingSeverity::major) {
            all += finding.rule + " " + finding.where + ": " + finding.what.english() + "\n";
        }
    }
    return all;
}
bool has(const AuditReport& report, std::string_view rule) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [rule](const AuditFinding& finding) { return finding.rule == rule; });
}

TEST(SoundTables, AreNotAccused) {
    EXPECT_EQ(accusations(audited(k_sound)), "");
}

TEST(SoundTables, AreNotAccusedOfOneRowByItsWords) {
    const double root_3 = std::sqrt(3.0), root_2 = std::sqrt(2.0), root_12 = std::sqrt(12.0);
    const std::vector<Row> rows = {
        // a range is no standard deviation
        {"Repeatability of the item", 0.012, root_12, "rectangular", "", "span of 0.012 V of 3 readings"},
        {"Repeatability of the item", 0.012, root_12, "rectangular", "", "largest less smallest of 4 readings"},
        {"Repeatability of the item", 0.012, root_12, "rectangular", "", "range of 6 readings as full width (b')"},
        {"Wiederholpräzision b'", 0.012, root_12, "Rechteck", "", "b' aus 3 Messreihen, n = 3"},
        {"Repeatability of the item", 0.012, 2.0 * root_3, "rectangular", "", "max - min of 5 readings"},
        {"Spannweite", 0.012, root_12, "Rechteck", "", "Spannweite aus 5 Messungen"},
        {"Repeatability of the item", 0.006, root_3, "rectangular", "", "half of the range of 6 readings"},
        // a standard deviation of the mean is divided already
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9", "standard deviation of the mean of 10 readings"},
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9",
         "experimental standard deviation of the mean, mean of 10"},
        {"Wiederholbarkeit", 0.0038, 1.0, "Normal", "9", "Standardabweichung des Mittelwerts, Mittel aus 10"},
        {"Mean of 10 readings", 0.0038, 1.0, "normal", "9", "Type A, s(mean)"},
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9", "standard error, mean of 10"},
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9", "mean of 10, 0.0120/√10"},
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9", "s/sqrt(n), mean of 10"},
        {"Wiederholbarkeit", 0.0038, 1.0, "Normal", "9", "Standardfehler, Mittel aus 10"},
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9", "ESDM, 10 readings, mean of 10"},
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9", "already divided by √10, mean of 10"},
        {"Repeatability of the item", 0.0038, 1.0, "normal", "9", "mean of 10, s = 0.0120 V"},
        {"Wiederholbarkeit", 0.012, std::sqrt(10.0), "t", "9", "10 Einzelmessungen"},
        // a certificate that is evidence of conformity
        {"Instrument", 0.006, root_3, "rectangular", "",
         "specification of the manufacturer, verified by certificate E-8 (U = 0.001 V, k = 2)"},
        // s of a study, and a mean of fewer
        {"Repeatability of the item", 0.012, root_3, "normal", "9",
         "s from a study of 10 readings, three of them averaged"},
        // what was divided by the divisor of its distribution
        {"Ripple", 0.010 / root_3, 1.0, "rectangular", "", "±0.010 V"},
        {"Resolution of the reference", 0.01 / root_12, 1.0, "rectangular", "", "resolution 0.01 V"},
        {"Mismatch", 0.010 / root_2, 1.0, "U-shaped", "", "±0.010 V"},
        {"Loading", 0.010 / std::sqrt(6.0), 1.0, "triangular", "", "±0.010 V"},
        // words that begin like others
        {"Spectral mismatch", 0.006, root_3, "rectangular", "", ""},
        {"Specific gravity", 0.006, root_3, "rectangular", "", ""},
        {"Specimen thickness", 0.006, root_3, "rectangular", "", ""},
        {"Speckle", 0.006, root_3, "rectangular", "", ""},
        {"Special fixture", 0.006, root_3, "rectangular", "", ""},
        {"Limit of detection", 0.006, root_3, "rectangular", "", ""},
        {"Limit of quantification", 0.006, root_3, "rectangular", "", ""},
        {"Scattered light", 0.006, root_3, "rectangular", "", ""},
        {"Scattering", 0.004, 1.0, "normal", "", ""},
        {"Certainty of the setting", 0.006, root_3, "rectangular", "", ""},
        {"Digital filter", 0.006, root_3, "rectangular", "", "digital voltmeter, ±0.006 V"},
        // half of a step stands in the words, and the step nowhere
        {"Resolution of the item", 0.005, root_3, "rectangular", "", "resolution, half of the digit: 0.005 V"},
        {"Half of the resolution 0.005 V", 0.005, root_3, "rectangular", "", ""},
        {"Half of the resolution", 0.005, root_3, "rectangular", "",
         "half of the smallest step of the resolution, 0.01 V"},
        {"Resolution (half a digit = 0.005 V)", 0.005, root_3, "rectangular", "", ""},
        {"Resolution ±0.005 V", 0.005, root_3, "rectangular", "", ""},
        {"Indication", 0.005, root_3, "rectangular", "", "±1 digit, digit 0.005 V"},
        {"Noise", 0.005, root_3, "rectangular", "", "noise, 2 digits of resolution 0.005 V"},
        {"Resolution/2 = 0.005 V", 0.005, root_3, "rectangular", "", ""},
        {"Resolution: 0.005 V (half of 0.01 V)", 0.005, root_3, "rectangular", "", ""},
        {"Auflösung (halber Ziffernschritt 0.005 V)", 0.005, root_3, "Rechteck", "", ""},
        {"Readability", 0.005, root_3, "rectangular", "", "0.5 digit = 0.005 V, readability of the display"},
        // a band and its half, a drift between certificates, a temperature that is no voltage
        {"Loading", 0.005, root_3, "rectangular", "", "tolerance band 0.010 V (±0.005 V), conformity verified"},
        {"Drift of the standard", 0.005, root_3, "rectangular", "",
         "difference between two certificates 0.010 V, half of it"},
        {"Temperature", 0.005, root_3, "rectangular", "", "(23 ± 2) °C, coefficient 0.0025 V/K"},
        // the digits of u do not say what its columns say
        {"Reference gauge", 0.0173, root_3, "rectangular", "", "within class limits ±0.0173 V, conformity verified"},
    };
    for (const Row& row : rows) {
        std::vector<Row> all = k_sound;
        all.push_back(row);
        EXPECT_EQ(accusations(audited(all)), "") << written(row);
        // And where it is the only one of its kind.
        if (row.nu == "9" || row.divisor > 3.0) {
            all.erase(all.begin() + 5);
            EXPECT_EQ(accusations(audited(all)), "") << written(row);
        }
    }
}

/// U of a budget in which only u stands beside the words, and what of it is major.
TEST(SoundTables, AreNotAccusedOfUAloneByTheWordsOfItsRow) {
    const auto with = [](const std::string& words, const std::string& distribution, double u) {
        return audit(
            subject_of(workbook::read_csv("Quantity,Distribution,u / mV\n\"" + words + "\"," + distribution + "," +
                                              text::significant(u, 4) +
                                              "\nRepeatability (mean of 10; s/√10),normal,0.15\nLoading,rectangular,"
                                              "0.046\nu_c,," +
                                              text::significant(std::hypot(u, 0.15, 0.046), 4) + "\n",
                                          "b.csv", "b"),
                       "b.csv"),
            all_rules());
    };
    const double root_3 = std::sqrt(3.0);
    for (const auto& [words, distribution, u] : std::vector<std::tuple<std::string, std::string, double>>{
             {"Standard uncertainty from the certificate, 0.2 mV", "normal", 0.2},
             {"Standardunsicherheit des Kalibrierscheins 0.2 mV", "normal", 0.2},
             {"Drift: difference between two certificates 0.20 mV, half of it", "normal", 0.1},
             {"Temperature (23 ± 2) °C, coefficient 0.05 mV/K", "rectangular", 0.1 / root_3},
             {"Power supply (230 ± 5) V", "rectangular", 0.01 / root_3},
             {"Half of the resolution 0.1 mV", "rectangular", 0.1 / root_3},
             {"Half of the resolution 0.1 mV", "rectangular", 0.05 / root_3},
             {"標準器漂移 0.2 mV", "矩形", 0.1}}) {
        const AuditReport report = with(words, distribution, u);
        for (const char* const rule : {"U08", "U09", "U14"}) {
            EXPECT_FALSE(has(report, rule)) << rule << ": " << words;
        }
    }
    // And the same with their errors.
    EXPECT_TRUE(has(with("Certificate U = 0.4 mV", "normal", 0.2), "U14"));
    EXPECT_TRUE(has(with("Loading ±0.1 mV", "rectangular", 0.0577 / 10.0), "U08"));
    EXPECT_TRUE(has(with("Half of the resolution 0.1234 mV", "rectangular", 0.1234), "U09"));
    EXPECT_TRUE(has(with("Resolution 0.1 mV", "rectangular", 0.1 / root_3), "U09"));
}

/// Of a table without a column of u: 1 mV over √12, times c = 2. What stands before the number is no half of it.
TEST(SoundTables, AreNotAccusedOfAStepByTheirContributions) {
    const auto with = [](const std::string& words, double divisor) {
        const double part = 2.0 / divisor;
        return audited_text("Quantity;Unit;U or a;Distribution;Divisor;c_i;Contribution\n" + words +
                            ";mV;1;rectangular;" + text::significant(divisor, 4) + ";2;" + text::significant(part, 4) +
                            "\nRepeatability;mV;0.5;normal;1;1;0.5\nu_c;mV;;;;;" +
                            text::significant(std::hypot(part, 0.5), 4) + "\n");
    };
    const auto with_contribution = [](const std::string& words, double divisor) {
        const double part = 2.0 / divisor;
        return audited_text("Quantity;Unit;Distribution;c_i;Contribution\n" + words + ";mV;rectangular;2;" +
                            text::significant(part, 4) + "\nRepeatability;mV;normal;1;0.5\nu_c;mV;;;" +
                            text::significant(std::hypot(part, 0.5), 4) + "\n");
    };
    for (const char* const words :
         {"Resolution, 6 digits: 1 mV", "Resolution, 4 1/2 digit: 1 mV", "Resolution 3½ digit display, 1 mV",
          "Half scale, resolution 1 mV", "Resolution at half load, 1 mV", "Auflösung im Halblastpunkt 1 mV",
          "Resolution of DVM range 0.5 V: 1 mV", "Resolution 0.5 ppm, 1 mV", "Resolution of two readings 1/2, 1 mV",
          "Resolution ±1 mV"}) {
        for (const AuditReport& report : {with(words, std::sqrt(12.0)), with_contribution(words, std::sqrt(12.0))}) {
            EXPECT_FALSE(has(report, "U09")) << words;
            EXPECT_FALSE(has(report, "W02")) << words;
        }
    }
    // What is half of a step is so beside c, too; and a step over √3 is found by what it is.
    EXPECT_FALSE(has(with_contribution("Half of the digit: 1 mV", std::sqrt(3.0)), "U09"));
    for (const char* const words : {"Resolution, 6 digits: 1 mV", "Resolution of DVM range 0.5 V: 1 mV",
                                    "Resolution at half load, 1 mV", "Semiconductor sensor, resolution 1 mV"}) {
        const AuditReport report = with_contribution(words, std::sqrt(3.0));
        EXPECT_TRUE(has(report, "U09")) << words;
        EXPECT_NEAR(report.results.at(0).audited.u_c, std::hypot(2.0 / std::sqrt(12.0), 0.5), 0.002) << words;
    }
}

/// k of a certificate stands in the name of the row, U and the divisor in its columns.
TEST(SoundTables, AreDividedByTheKInTheNameOfARow) {
    const auto with = [](const std::string& name, const std::string& divisor) {
        const double u = 0.53 / std::stod(divisor), u_c = std::hypot(u, 0.173, 0.11);
        return audited_text("Quantity,Unit,Value ±,Divisor,u\n\"" + name + "\",mV,0.53," + divisor + "," +
                            text::significant(u, 3) + "\nDrift,mV,0.30,1.732,0.173\nLoading,mV,0.11,1,0.11\nu_c,mV,,," +
                            text::significant(u_c, 3) + "\nU (k = 2),mV,,," + text::significant(2.0 * u_c, 2) + "\n");
    };
    for (const auto& [name, divisor] :
         std::vector<std::pair<std::string, std::string>>{{"Standard certificate (k = 2.65)", "2.65"},
                                                          {"Standard certificate (k = 2)", "1.96"},
                                                          {"Standard certificate (k = 2)", "1.7321"},
                                                          {"Standard certificate (k = 2)", "1"},
                                                          {"Certificate (k = 3), U converted to k = 2", "2"},
                                                          {"Certificate k = 3, here U for k = 2", "2"},
                                                          {"Two weights, certificate (k = 3)", "2"},
                                                          {"Certificate (k = 2.65), U recalculated to 95 %", "2"},
                                                          {"Weights, 5 pieces, certificate k = 2", "4.472"},
                                                          {"Certificate of gauge block pair (k = 2)", "2.828"},
                                                          {"Certificate (k = 2), share of 1/2", "4"},
                                                          {"Certificate EX-17 (k = 2)", "2000"},
                                                          {"Certificate (k = 2), 99 % limits", "2.576"},
                                                          {"Certificate with k = 2, tolerance limits", "3"},
                                                          {"Standard", "3"}}) {
        EXPECT_FALSE(has(with(name, divisor), "U13")) << name << divisor;
    }
    EXPECT_TRUE(has(with("Standard certificate (k = 2)", "3"), "U13"));
    const AuditReport report = with("Standard certificate (k = 2.65)", "2");
    EXPECT_TRUE(has(report, "U13"));
    EXPECT_NEAR(report.results.at(0).audited.U, 2.0 * std::hypot(0.2, 0.173, 0.11), 0.01);
}

/// The distribution says by what the column is divided; that the column of a resolution holds the step, nobody says. The finding
/// expected √3, and its effect was that of √12.
TEST(SoundTables, AResolutionIsCorrectedAsItsDistributionSays) {
    for (const char* const divisor : {"1", "2"}) {
        const double u = 50.0 / std::stod(divisor), u_c = std::hypot(u, 6.35, 1.0);
        const AuditReport report =
            audit(subject_of(workbook::read_csv(
                                 "Source of uncertainty,Value ± (mV),Distribution,Divisor,Standard uncertainty (mV)\n"
                                 "Calibrator,2.0,normal,2,1.0\nDrift,11,rectangular,√3,6.35\n"
                                 "Resolution of the DVM (half of the digit),50.0,rectangular," +
                                     std::string(divisor) + "," + text::shortest(u) +
                                     "\nCombined standard uncertainty,,,," + text::significant(u_c, 4) +
                                     "\nExpanded uncertainty (k = 1.65),,,," + text::significant(1.65 * u_c, 3) + "\n",
                                 "b.csv", "b"),
                             "b.csv"),
                  all_rules());
        EXPECT_TRUE(has(report, "W02")) << divisor;
        EXPECT_NEAR(report.results.at(0).audited.U, 1.65 * std::hypot(50.0 / std::sqrt(3.0), 6.35, 1.0), 0.05)
            << divisor;
    }
}

TEST(SoundTables, KeepTheErrorsThatWordsMayHide) {
    // Beside what is sound: the same rows with an error are found.
    const auto with = [](Row row) {
        std::vector<Row> all = k_sound;
        all.push_back(std::move(row));
        return audited(all);
    };
    EXPECT_TRUE(
        has(with({"Repeatability of the item", 0.012, 2.0, "normal", "9", "standard deviation, mean of 10"}), "U03"));
    EXPECT_TRUE(has(with({"Repeatability of the item", 0.012, std::sqrt(3.0), "rectangular", "9",
                          "standard deviation, mean of 10"}),
                    "U03"))
        << "whatever distribution stands beside it";
    EXPECT_TRUE(has(with({"Ripple", 0.010, 1.0, "rectangular", "", "±0.010 V"}), "W02"));
    EXPECT_TRUE(has(with({"Meter", 0.010, std::sqrt(3.0), "rectangular", "", "specification"}), "U12"));
    EXPECT_TRUE(has(with({"Meter", 0.010, std::sqrt(3.0), "rectangular", "", "limits of error 0.010 V"}), "U12"));
    EXPECT_TRUE(has(with({"Meter", 0.010, 2.0, "rectangular", "", "MPE 0.010 V"}), "U24"));
}

TEST(SoundTables, AreNotCorrectedWhereTheyAgreeWithAnotherRule) {
    const auto with = [](Row row) {
        std::vector<Row> all = k_sound;
        all.push_back(std::move(row));
        return audited(all);
    };
    EXPECT_FALSE(
        has(with({"Display", 0.01, std::sqrt(6.0), "rectangular", "", "resolution 0.01 V, two readings"}), "W02"))
        << "U09 calls √2 d/√12 right";
    EXPECT_TRUE(has(with({"Display", 0.03, std::sqrt(6.0), "rectangular", "", "±0.03 V"}), "W02"));
    EXPECT_FALSE(
        has(with({"Repeatability of the item", 0.006, std::sqrt(10.0), "normal", "9", "up and down, 5 readings each"}),
            "U03"));
    EXPECT_TRUE(has(with({"Repeatability of the item", 0.006, std::sqrt(10.0), "normal", "9", "5 readings"}), "U03"));
    EXPECT_FALSE(has(with({"Repeatability of the item", 0.007, 2.0, "normal", "60",
                           "pooled standard deviation of 20 earlier calibrations, mean of 4"}),
                     "U02"));
    EXPECT_TRUE(has(with({"Repeatability of the item", 0.007, 2.0, "normal", "3", "mean of 4"}), "U02"));
    EXPECT_FALSE(has(with({"Lead", 0.006, std::sqrt(3.0), "rectangular", "", "cyclic part is negligible"}), "U20"));
    EXPECT_TRUE(has(with({"Lead", 0.006, std::sqrt(3.0), "rectangular", "", "cyclic"}), "U20"));
}

TEST(SoundTables, StateTheirDecisionRuleInWords) {
    const std::string limits = "lower limit,V,9.9\nupper limit,V,10.1\n";
    for (const char* const rule : {"simple acceptance", "guard band w = U", "ILAC-G8 DR-03", "Rule DR-03", "dr-03",
                                   "DR03", "ILAC-G8:09/2019 4.2.1 simple acceptance"}) {
        const AuditReport report = audited(k_sound, limits + "decision rule," + std::string(rule) + "\nverdict,pass\n");
        EXPECT_EQ(accusations(report), "") << rule;
        EXPECT_TRUE(report.subject.budgets.at(0).rule) << rule;
        EXPECT_TRUE(report.subject.not_read.empty()) << rule;
    }
    // What is stated and not understood is told, and is not nothing.
    const AuditReport words = audited(k_sound, limits + "decision rule,as agreed in the order\nverdict,pass\n");
    EXPECT_FALSE(has(words, "D01"));
    ASSERT_EQ(words.subject.not_read.size(), 1U);
    EXPECT_NE(words.subject.not_read[0].english().find("as agreed in the order"), std::string::npos);
    EXPECT_TRUE(has(audited(k_sound, limits + "verdict,pass\n"), "D01"));
}

TEST(SoundTables, ContributionsAloneAreInTheUnitOfTheirHead) {
    // The law: whatever the unit of the quantity, its contribution in percent is one.
    for (const char* const unit : {"1", "cd", "m", "V", "K", "°C", "mm", "%"}) {
        const AuditReport report = audited_text(
            "Quantity,Estimate,Unit,Sensitivity,Contribution / %,nu,Comment\n"
            "Reference lamp,285.4,cd,1,0.60,,\"U = 1.2 %, k = 2, certificate L-9\"\n"
            "Correction factor,1.002," +
            std::string(unit) +
            ",1,0.25,,\nRepeatability,1001.2,lx,1,0.10,9,\n"
            "u_c,,,,0.66,,\nk,2\nU,1.3,%\np,95 %\n");
        EXPECT_FALSE(has(report, "S01")) << unit;
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_NEAR(report.results[0].audited.U, 1.3, 0.05) << unit;
    }
}

TEST(SoundTables, ACertifiedRowIsTheReferenceOfABudgetWithoutChecklist) {
    const auto table = [](const std::string& comment) {
        return audited_text(
            "quantity,estimate,unit,u,sensitivity,contribution,nu,comment\nDew point "
            "t_d,10.02,°C,0.050,3.35,0.168,,\"" +
            comment +
            "\"\nChamber temperature t,21.03,°C,0.040,-3.05,0.122,,\nDrift of the mirror,0,°C,0.020,3.35,0.067,,\n"
            "Resolution of the hygrometer,0,%rh,0.029,1,0.029,,resolution 0.1 %rh\n"
            "Repeatability,0,%rh,0.080,1,0.080,9,\nReproducibility,0,%rh,0.060,1,0.060,12,\n"
            "value,49.6,%rh\nu_c,0.244,%rh\nk,2\nU,0.5,%rh\np,95 %\n");
    };
    EXPECT_FALSE(has(table("certificate D-1, U = 0.10 °C, k = 2"), "B01"));
    EXPECT_TRUE(has(table(""), "B01"));
}

TEST(SoundTables, AskOfACorrelationThatANoteStates) {
    const std::string heads = "Quantity,Estimate,Unit,u,nu,Sensitivity,Contribution\n",
                      rows =
                          "Standard gauge A,0,um,0.02,50,1,0.02\nStandard gauge B,0,um,0.02,50,-1,-0.02\n"
                          "Indication,0,um,0.01,9,1,0.01\nResolution,0,um,0.003,inf,1,0.003\n",
                      note = "\"Note: A and B were calibrated together, r = 0.9\"\n";
    for (const std::string& claims :
         {std::string("u_c,,um,0.0137\nk,,,2\nU,,um,0.027\n"), std::string("k,,,2\nU,,um,0.027\n")}) {
        for (const std::string& table : {heads + rows + note + claims, heads + rows + claims + note}) {
            const AuditReport report = audited_text(table);
            EXPECT_FALSE(report.has_critical()) << table;
            EXPECT_TRUE(has(report, "K01")) << "it is asked";
        }
        EXPECT_TRUE(audited_text(heads + rows + claims).has_critical());
        // Of a regression, it explains nothing; and a note is no row.
        EXPECT_TRUE(audited_text(heads + rows + "\"Note: the regression has r = 0.3\"\n" + claims).has_critical());
    }
    const AuditReport sound =
        audited_text(heads + rows + "\"Note: the regression has r = 0.999\"\nu_c,,um,0.0301\nk,,,2\nU,,um,0.060\n");
    EXPECT_FALSE(has(sound, "K01"));
}

TEST(SoundTables, StateDegreesOfFreedomInTheDistributionAndReadingsWithAnAdjective) {
    const auto table = [](const std::string& distribution, const std::string& name) {
        return audited_text(
            "quantity,unit,U or a,divisor,distribution,u,sensitivity,contribution\n"
            "Reference standard,V,0.020,2,normal,0.010,1,0.010\n" +
            name + ",V,0.006,1,\"" + distribution +
            "\",0.006,1,0.006\nResolution,V,0.005,1.732,rectangular,0.00289,1,0.00289\nu_c,V,0.0120\nk,,2\nU,V,0."
            "024\n");
    };
    for (const char* const distribution :
         {"t (9)", "t(9)", "t, ν = 9", "Student's t (9)", "t-distribution (9)", "t, 9 degrees of freedom"}) {
        EXPECT_EQ(table(distribution, "Repeatability").subject.budgets.at(0).rows.at(1).used_nu, 9.0) << distribution;
    }
    for (const char* const distribution : {"t", "t (2)", "t (95 %)", "normal (9)", "t (k = 3)"}) {
        EXPECT_TRUE(std::isinf(table(distribution, "Repeatability").subject.budgets.at(0).rows.at(1).used_nu))
            << distribution;
    }
    for (const char* const distribution : {"t (90)", "t (95)", "t, 95", "Student's t (99)"}) {
        EXPECT_TRUE(std::isinf(table(distribution, "Repeatability").subject.budgets.at(0).rows.at(1).used_nu))
            << distribution;
    }
    EXPECT_EQ(table("t (4)", "Repeatability").subject.budgets.at(0).rows.at(1).used_nu, 4.0);
    EXPECT_TRUE(std::isinf(table("t (4)", "Reference B").subject.budgets.at(0).rows.at(1).used_nu));
    for (const char* const name : {"Repeatability (5 equal readings)", "Wiederholbarkeit (5 gleiche Ablesungen)",
                                   "Repeatability of 5 independent measurements"}) {
        EXPECT_EQ(table("normal", name).subject.budgets.at(0).rows.at(1).n, 5U) << name;
    }
    EXPECT_EQ(table("normal", "Repeatability (3 single measurements of 5 readings)").subject.budgets.at(0).rows.at(1).n,
              5U);
    EXPECT_FALSE(table("normal", "Repeatability (5 kg load)").subject.budgets.at(0).rows.at(1).n);
}

TEST(SoundTables, AreHeadedBySourceAndStateUInTheUnitOfALength) {
    for (const char* const head : {"Source", "No.,Source"}) {
        const std::string before = std::string_view(head) == "Source" ? "" : "1,";
        const AuditReport report = audited_text(
            std::string(head) + ",Standard uncertainty (mm)\n" + before + "Reference certificate,0.015\n" + before +
            "Resolution,0.0029\n" + before + "Repeatability,0.004\n" + before +
            "Temperature,0.0115\nExpanded uncertainty U (k = 2) in mm," + (before.empty() ? "" : ",") + "0.039\n");
        ASSERT_EQ(report.results.size(), 1U) << head;
        EXPECT_NEAR(report.results[0].recomputed.U, 0.0391, 1e-4) << head;
    }
    // Results of laboratories, and a list of standards, are no budget.
    for (const char* const list :
         {"Source,Value,Standard uncertainty (mm),U (k = 2) (mm)\nNIST,10.001,0.0005,0.001\nPTB,10.002,0.0008,0.0016\n",
          "Quelle,Wert (mm),Standardunsicherheit "
          "(mm)\nPTB,10.001,0.0005\nNPL,10.002,0.0006\nMittelwert,10.0015,0.0004\n",
          "Certificate,Valid to,Standard uncertainty (mm),U (mm),k\n77-A,2027-01-01,0.0005,0.001,2\n"
          "78-B,2027-02-01,0.0008,0.0016,2\n"}) {
        EXPECT_TRUE(subject_of(workbook::read_csv(list, "b.csv", "b"), "b.csv").budgets.empty()) << list;
    }
    const auto stated = [](const std::string& unit) {
        return audited_text("Quantity,u / " + unit + ",c,Contribution / " + unit +
                            "\nReference,0.010,1,0.010\nDrift,0.006,1,0.006\n"
                            "Repeatability,0.005,1,0.005\nu_c / " +
                            unit + ",,,0.0127\nk,,,2\nU / " + unit + ",,,0.025\n");
    };
    for (const char* const unit : {"mm", "K", "mg", "N·m", "dB"}) {
        ASSERT_TRUE(stated(unit).subject.budgets.at(0).claims.U) << unit;
        EXPECT_EQ(stated(unit).subject.budgets[0].claims.U->value, 0.025) << unit;
    }
    EXPECT_FALSE(stated("mV").subject.budgets.at(0).claims.U) << "it may be a voltage";
    // A "U" in the unit of something else is no U of the table, nor is one above it.
    const std::string rows =
                          "Quantity,Unit,u,Sensitivity,Contribution\nA,mm,0.02,1,0.02\nB,mm,0.01,1,0.01\n"
                          "u_c,mm,,,0.0224\nk,,,,2\n",
                      U = "Expanded uncertainty,mm,,,0.045\n";
    for (const char* const other : {"U / min,,,,1500\n", "U / J,,,,120\n"}) {
        const AuditReport report = audited_text(rows + other + U);
        EXPECT_FALSE(has(report, "K01")) << other << accusations(report);
        EXPECT_EQ(report.subject.budgets.at(0).claims.U->value, 0.045) << other;
    }
    for (const char* const above :
         {"U / min,1500\n\n", "U / mm,314.2\n\n", "U / W/(m2*K),1.20\n\n", "U / J,5000\n\n"}) {
        const AuditReport report = audited_text(above + rows + U);
        EXPECT_FALSE(has(report, "K01")) << above << accusations(report);
        EXPECT_EQ(report.subject.budgets.at(0).claims.U->value, 0.045) << above;
    }
    // Readings to the left of a table, and numbers of its rows, are none of its results.
    for (const char* const head : {"Readings", "No.", "Datum"}) {
        const AuditReport right = audited_text(
            std::string(head) +
            ",,Quantity,u / mm,c,Contribution / mm\n10.01,,Reference,0.010,1,0.010\n"
            "10.02,,Drift,0.006,1,0.006\n10.03,,Repeatability,0.005,1,0.005\n10.01,,u_c,,,0.0127\n10.02,,k,,,2\n"
            "10.03,,Expanded uncertainty,,,0.025\n");
        ASSERT_EQ(right.results.size(), 1U) << head;
        EXPECT_FALSE(has(right, "K01")) << head;
        EXPECT_EQ(right.results[0].claimed.U, 0.025) << head;
        EXPECT_EQ(right.results[0].claimed.u_c, 0.0127) << head;
    }
    // A column "±" without a number is none, and the values are what is divided.
    const AuditReport blank = audited_text(
        "Source,Value,±,Unit,Distribution,Divisor,ui,ci,ci·ui\nReference calibration,0.02,,K,normal,2,0.01,1,0.01\n"
        "Drift,0.01,,K,rectangular,1.732,0.00577,1,0.00577\nStability,0.015,,K,rectangular,1.732,0.00866,1,0.00866\n"
        "Combined standard uncertainty,,,K,,,,,0.0144\nk,,,,,,,,2\nExpanded uncertainty,,,K,,,,,0.029\n");
    EXPECT_FALSE(has(blank, "U23"));
    EXPECT_EQ(blank.subject.budgets.at(0).rows.at(0).stated->value, 0.02);
}

/// What the digits leave open here is ν_eff and k: nobody claims another u_c than the rows give, and none is told.
TEST(SoundTables, KeepTheirUcWhereTheDigitsLeaveKOpen) {
    for (const char* const table :
         {"quantity,unit,U or a,divisor,distribution,u,sensitivity,contribution\n"
          "Reference standard,V,0.0278,2.776,t(5),0.010,1,0.010\nRepeatability,V,0.002,1,normal,0.002,1,0.002\n"
          "Resolution,V,0.005,1.732,rectangular,0.00289,1,0.00289\nu_c,V,0.0106\nnu_eff,,5\nk,,2.65\nU,V,0.028\n",
          "Quantity,Unit,u,nu,Sensitivity,Contribution\nInfluence 1,um,0.004,19,1,0.004\n"
          "Influence 2,um,0.005,3,1,0.005\nInfluence 3,um,0.02,5,1,0.02\nInfluence 4,um,0.02,inf,1,0.02\n"
          "u_c,um,0.029\nnu_eff,,19\nk,,2.14\nU,um,0.063\ncoverage probability,,95.45 %\n"}) {
        const AuditReport report = audited_text(table);
        ASSERT_EQ(report.results.size(), 1U) << table;
        EXPECT_DOUBLE_EQ(report.results[0].audited.u_c, report.results[0].recomputed.u_c) << table;
        EXPECT_EQ(report.results[0].audited.printed_U, report.results[0].claimed.printed_U) << table;
    }
}

/// U was divided by the number behind "t": it is a factor, and no ν, with which K02 would be critical.
TEST(SoundTables, DivideByTheNumberBehindT) {
    struct Case {
        std::string divisor, number, name;
    };
    const std::vector<Case> cases = {{"3", "3", "Reference standard"}, {"4", "4", "Reference standard"},
                                     {"5", "5", "Reference standard"}, {"2.87", "3", "Reference standard"},
                                     {"3", "3", "Repeatability"},      {"4.30", "4", "Repeatability"}};
    for (const Case& one : cases) {
        for (const std::string& words : {"t (" + one.number + ")", "t(" + one.number + ")", "t, " + one.number}) {
            for (const bool has_divisors : {true, false}) {
                const auto cell = [&](const std::string& divisor) { return has_divisors ? divisor + "," : ""; };
                const std::string stated = text::significant(0.01 * std::stod(one.divisor), 3);
                std::string table =
                    "quantity,unit,U or a," + cell("divisor") + "distribution,u,sensitivity,contribution\n";
                table += one.name + ",V," + stated + "," + cell(one.divisor) + "\"" + words + "\",0.0100,1,0.0100\n";
                table += "Seating,V,0.002," + cell("1") + "normal,0.002,1,0.002\n";
                table += "Resolution,V,0.005," + cell("1.732") + "rectangular,0.00289,1,0.00289\n";
                table += "u_c,V,0.0106\nk,,2\nU,V,0.021\n";
                const AuditReport report = audited_text(table);
                EXPECT_FALSE(report.has_critical()) << table << accusations(report);
                EXPECT_FALSE(has(report, "K02")) << table;
                EXPECT_TRUE(std::isinf(report.subject.budgets.at(0).rows.at(0).used_nu)) << table;
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::audit
