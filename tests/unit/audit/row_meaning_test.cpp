#include "audit/row_meaning.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

AuditedRow row_with(const std::string& comment, const std::string& unit = "um", const std::string& quantity = "") {
    AuditedRow row;
    row.comment = comment;
    row.unit = unit;
    row.quantity = quantity;
    read_comment(row);
    return row;
}

TEST(ContributorOf, reads_words_of_both_languages) {
    struct Case {
        std::string quantity, comment;
        Contributor expected;
    };
    const std::vector<Case> cases{
        {"Repeatability", "", Contributor::repeatability},
        {"Wiederholpräzision", "", Contributor::repeatability},
        {"Empuje del aire", "", Contributor::environment},
        {"Poussée de l'air", "", Contributor::environment},
        {"空氣浮力", "", Contributor::environment},
        {"Estabilidad del patrón", "", Contributor::reference_drift},
        {"Coefficient de dilatation", "", Contributor::expansion},
        {"熱膨脹係數", "", Contributor::expansion},
        {"Estabilidad del baño", "", Contributor::environment},
        {"standard deviation of readings", "", Contributor::repeatability},
        {"Reproducibility (operators)", "", Contributor::reproducibility},
        {"Resolution of DUT", "", Contributor::item_resolution},
        {"Auflösung des Normals", "", Contributor::reference_resolution},
        {"Ziffernschritt der Anzeige", "", Contributor::item_resolution},
        {"Drift of the reference since last calibration", "", Contributor::reference_drift},
        {"long-term stability of the item", "", Contributor::item},
        {"Calibration of the reference standard", "", Contributor::reference},
        {"Parallelendmaß 10 mm", "Kalibrierschein 123", Contributor::reference},
        {"Temperature difference", "", Contributor::temperature},
        {"thermal expansion coefficient", "", Contributor::expansion},
        {"Wärmeausdehnungskoeffizient", "", Contributor::expansion},
        {"δα", "", Contributor::expansion},
        {"δθ", "", Contributor::temperature},
        {"Abbe error", "", Contributor::alignment},
        {"refractive index of air", "", Contributor::refractive_index},
        {"Dead path", "", Contributor::dead_path},
        {"form of the anvils", "", Contributor::target_form},
        {"air buoyancy", "", Contributor::environment},
        {"d_theta", "", Contributor::temperature},
        {"d_wavelength", "", Contributor::refractive_index},
        {"wavelength of the laser", "", Contributor::reference},
        {"comparator, random", "", Contributor::repeatability},
        {"comparator, systematic", "", Contributor::reference},
        {"Badhomogenität", "", Contributor::environment},
        {"interpolation between points", "", Contributor::fit},
        {"hysteresis", "", Contributor::item},
        {"l_S", "certificate of the gauge block", Contributor::reference},
        {"gauge block", "drift since 2024", Contributor::reference_drift},
        {"reference thermometer", "resolution 0.01", Contributor::reference_resolution},
        {"Deriva del patrón", "", Contributor::reference_drift},
        {"Répétabilité", "", Contributor::repeatability},
        {"Resolución", "", Contributor::item_resolution},
        {"標準器漂移", "", Contributor::reference_drift},
        {"測量重複性", "", Contributor::repeatability},
        {"标准器校准", "", Contributor::reference},
        {"x", "standard uncertainty", Contributor::other},
        {"x", "normal distribution", Contributor::other},
        {"", "", Contributor::other},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(contributor_of(c.quantity, c.comment, ""), c.expected) << c.quantity << " | " << c.comment;
    }
    EXPECT_EQ(contributor_of("d", "", "reference weight"), Contributor::reference);
}

TEST(ShapeOf, reads_words_of_both_languages) {
    const std::vector<std::pair<std::string, Shape>> cases{
        {"rect.", Shape::rectangular},
        {"Rectangular", Shape::rectangular},
        {"uniform", Shape::rectangular},
        {"Rechteck", Shape::rectangular},
        {"gleichverteilt", Shape::rectangular},
        {"normal", Shape::normal},
        {"Normal (k=2)", Shape::normal},
        {"N", Shape::normal},
        {"Gauß", Shape::normal},
        {"triangular", Shape::triangular},
        {"Dreieck", Shape::triangular},
        {"U-shaped", Shape::arcsine},
        {"arcsine", Shape::arcsine},
        {"t", Shape::student_t},
        {"Student", Shape::student_t},
        {"t-distribution", Shape::student_t},
        {"trapezoidal", Shape::trapezoidal},
        {"loi uniforme", Shape::rectangular},
        {"均匀分布", Shape::rectangular},
        {"常態 (k=2)", Shape::normal},
        {"三角形", Shape::triangular},
        {"", Shape::not_stated},
        {" – ", Shape::not_stated},
        {"A", Shape::other},
    };
    for (const auto& [text, expected] : cases) {
        EXPECT_EQ(shape_of(text), expected) << text;
    }
}

TEST(DivisorOfShape, is_the_root_that_makes_u_of_a_half_width) {
    EXPECT_EQ(divisor_of_shape(Shape::rectangular), std::sqrt(3.0));
    EXPECT_EQ(divisor_of_shape(Shape::triangular), std::sqrt(6.0));
    EXPECT_EQ(divisor_of_shape(Shape::arcsine), std::sqrt(2.0));
    for (const Shape other : {Shape::normal, Shape::student_t, Shape::not_stated, Shape::other}) {
        EXPECT_FALSE(divisor_of_shape(other));
    }
}

TEST(ReadComment, finds_origin_and_number) {
    struct Case {
        std::string comment;
        Origin origin;
        double value;
    };
    const std::vector<Case> cases{
        {"MPE 0.4 µm", Origin::specification, 0.4},
        {"MPE per DIN 863-1: 4 µm", Origin::specification, 4.0},
        {"0.4 µm MPE, rectangular", Origin::specification, 0.4},
        {"Fehlergrenze ±0,4 µm laut Herstellerangabe", Origin::specification, 0.4},
        {"accuracy class 1, 0.002 mm", Origin::specification, 2.0},
        {"maximum permissible error of the instrument is 3 µm", Origin::specification, 3.0},
        {"half-width 0.5", Origin::limits, 0.5},
        {"Halbweite 0,5 µm", Origin::limits, 0.5},
        {"±1 µm", Origin::limits, 1.0},
        {"resolution 0.1", Origin::resolution, 0.1},
        {"Auflösung 0,1 µm", Origin::resolution, 0.1},
        {"Ziffernschritt: 0,001 mm", Origin::resolution, 1.0},
        {"0.1 µm resolution, MPE see certificate", Origin::resolution, 0.1},
        {"U = 0.36 µm, k = 2", Origin::certificate, 0.36},
        {"U(k=2) = 0.36 µm", Origin::certificate, 0.36},
        {"expanded uncertainty 0.36 µm (k = 2)", Origin::certificate, 0.36},
        {"certificate 12345 of 2024, 0.36 µm", Origin::certificate, 0.36},
        {"Kalibrierschein 4711: U95 = 360 nm", Origin::certificate, 0.36},
    };
    for (const Case& c : cases) {
        const AuditedRow row = row_with(c.comment);
        EXPECT_EQ(row.origin, c.origin) << c.comment;
        ASSERT_TRUE(row.origin_value) << c.comment;
        EXPECT_NEAR(*row.origin_value, c.value, 1e-12 * c.value) << c.comment;
    }
}

TEST(ReadComment, reads_what_a_certificate_states) {
    const AuditedRow row = row_with("Kalibrierschein 4711, U = 0,36 µm, k = 2,0, 95 %");
    EXPECT_EQ(row.certificate_k, 2.0);
    EXPECT_EQ(row.certificate_probability, 0.95);
    EXPECT_EQ(row.type_a, false);
    EXPECT_EQ(row.contributor, Contributor::reference);
    const AuditedRow without = row_with("certificate 4711");
    EXPECT_EQ(without.origin, Origin::certificate);
    EXPECT_FALSE(without.origin_value);
    EXPECT_FALSE(without.certificate_k);
}

TEST(ReadComment, counts_readings) {
    for (const std::string comment : {"n = 5", "repeatability, mean of 5", "s of 5 days", "5 readings", "Mittel aus 5",
                                      "Standardabweichung, N = 5", "5 Wiederholungen"}) {
        const AuditedRow row = row_with(comment);
        EXPECT_EQ(row.origin, Origin::readings) << comment;
        EXPECT_EQ(row.n, 5U) << comment;
        EXPECT_EQ(row.type_a, true) << comment;
    }
    const AuditedRow pooled = row_with("pooled s = 0.12 µm, ν = 54, mean of 3");
    EXPECT_EQ(pooled.pooled_s, 0.12);
    ASSERT_TRUE(pooled.nu);
    EXPECT_EQ(pooled.nu->value, 54.0);
    EXPECT_EQ(pooled.n, 3U);
    for (const char* const comment : {"s de la media de 10 pesadas", "10 lecturas", "moyenne de 10 pesées",
                                      "10 mesures", "mean of 10 cycles", "mean of 10 counts", "mean of 10 mV readings",
                                      "mean of 10 V readings", "moyenne de 3: séries de 10 mesures"}) {
        EXPECT_EQ(row_with(comment).n, 10U) << comment;
    }
    for (const char* const comment :
         {"température moyenne de 3 °C", "temperatura media de 20 °C", "moyenne de 3 h", "media de 3 mV",
          "moyenne de 3 jours", "tensión media de 20 voltios", "mean of 3 °C", "Mittel von 20 °C", "mean of 3 mV",
          "average over 5 min", "mean of 20 degrees", "temperatura media de 3, humedad 50 %",
          "temperatura media de 5."}) {
        EXPECT_FALSE(row_with(comment).n) << comment;
    }
    EXPECT_EQ(row_with("mean of 3 in air").n, 3U);
    for (const char* const comment :
         {"media de 5 lecturas con 60 grados de libertad", "moyenne de 5 mesures, 60 degrés de liberté",
          "5 lecturas, grados de libertad: 60", "mean of 5 readings with 60 degrees of freedom"}) {
        ASSERT_TRUE(row_with(comment).nu) << comment;
        EXPECT_EQ(row_with(comment).nu->value, 60.0) << comment;
    }
    EXPECT_FALSE(row_with("n = 1.000271, refractive index").n);
    EXPECT_EQ(row_with("largest s of 9 points, n = 3 per direction").n, 3U);
    EXPECT_EQ(row_with("n = 4", "um", "difference of the gauges").contributor, Contributor::repeatability);
}

TEST(ReadComment, takes_no_number_of_another_kind) {
    EXPECT_FALSE(row_with("MPE of the thermometer 0.1 K").origin_value);
    EXPECT_FALSE(row_with("certificate 12345").origin_value);
    EXPECT_FALSE(row_with("accuracy class 1").origin_value);
    EXPECT_FALSE(row_with("accuracy 0.5 %").origin_value);
    EXPECT_EQ(row_with("accuracy 2 %", "%rh").origin_value, 2.0);
    EXPECT_EQ(row_with("±1 K", "degC").origin_value, 1.0);
    EXPECT_EQ(row_with("see below").origin, Origin::not_stated);
    EXPECT_EQ(row_with("manufacturer: Example").origin, Origin::not_stated);
    EXPECT_EQ(row_with("").origin, Origin::not_stated);
}

TEST(ReadComment, takes_the_kind_of_the_quantity) {
    const AuditedRow row = row_with("0.1 µm", "um", "Resolution");
    EXPECT_EQ(row.origin, Origin::resolution);
    EXPECT_EQ(row.origin_value, 0.1);
}

TEST(ReadComment, keeps_what_a_column_said) {
    AuditedRow row;
    row.unit = "um";
    row.comment = "MPE 0.4 µm, triangular";
    row.origin = Origin::limits;
    row.origin_value = 0.3;
    row.shape = Shape::rectangular;
    row.type_a = true;
    read_comment(row);
    EXPECT_EQ(row.origin, Origin::limits);
    EXPECT_EQ(row.origin_value, 0.3);
    EXPECT_EQ(row.shape, Shape::rectangular);
    EXPECT_EQ(row.type_a, true);
}

TEST(ReadComment, stands_long_and_broken_text) {
    const std::string cut_character = std::string(399, 'x') + "µ = 3";
    EXPECT_EQ(row_with(cut_character).origin, Origin::not_stated);
    EXPECT_EQ(row_with("\xff MPE 1 um").origin, Origin::not_stated);
    EXPECT_EQ(row_with("1.2.3.4 MPE").origin, Origin::specification);
}

AuditedRow with(const char* u, const char* divisor, const char* c, const char* contribution) {
    AuditedRow row;
    const auto read = [](const char* text) { return text == nullptr ? std::nullopt : read_number(text, ""); };
    row.u = read(u);
    row.divisor = read(divisor);
    row.sensitivity = read(c);
    row.contribution = read(contribution);
    return row;
}

TEST(CompleteRow, decides_by_the_contribution_whether_u_was_divided) {
    AuditedRow undivided = with("0.50", "√3", "1", "0.289");
    complete_row(undivided);
    EXPECT_NEAR(undivided.used_u, 0.5 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(undivided.u_half_step, 0.005 / std::sqrt(3.0), 1e-12);
    ASSERT_TRUE(undivided.stated);
    EXPECT_FALSE(undivided.u);

    AuditedRow divided = with("0.29", "√3", "2", "0.58");
    complete_row(divided);
    EXPECT_EQ(divided.used_u, 0.29);
    EXPECT_EQ(divided.used_sensitivity, 2.0);
    EXPECT_EQ(divided.u_half_step, 0.005);
    EXPECT_TRUE(divided.u);

    AuditedRow open = with("0.29", "√3", "1", nullptr);
    complete_row(open);
    EXPECT_EQ(open.used_u, 0.29);
}

TEST(CompleteRow, derives_what_is_missing) {
    AuditedRow from_contribution = with(nullptr, nullptr, "-2.0", "0.58");
    complete_row(from_contribution);
    EXPECT_NEAR(from_contribution.used_u, 0.29, 1e-12);
    EXPECT_EQ(from_contribution.used_sensitivity, -2.0);

    AuditedRow sensitivity = with("0.10", nullptr, nullptr, "1.15");
    complete_row(sensitivity);
    EXPECT_NEAR(sensitivity.used_sensitivity, 11.5, 1e-12);

    AuditedRow stated;
    stated.stated = read_number("0.6", "");
    stated.shape = Shape::rectangular;
    complete_row(stated);
    EXPECT_NEAR(stated.used_u, 0.6 / std::sqrt(3.0), 1e-12);

    AuditedRow certificate;
    certificate.stated = read_number("0.36", "");
    certificate.origin = Origin::certificate;
    certificate.certificate_k = 2.0;
    complete_row(certificate);
    EXPECT_NEAR(certificate.used_u, 0.18, 1e-12);

    AuditedRow nothing;
    complete_row(nothing);
    EXPECT_EQ(nothing.used_u, 0.0);
    EXPECT_TRUE(std::isinf(nothing.used_nu));
}

TEST(CompleteRow, takes_degrees_of_freedom_as_stated) {
    AuditedRow row = with("0.1", nullptr, nullptr, nullptr);
    row.nu = read_number("9", "");
    complete_row(row);
    EXPECT_EQ(row.used_nu, 9.0);
    row.nu = read_number("∞", "");
    complete_row(row);
    EXPECT_TRUE(std::isinf(row.used_nu));
    row.nu = read_number("-1", "");
    complete_row(row);
    EXPECT_TRUE(std::isinf(row.used_nu));
}

TEST(ReadComment, reads_the_deviation_of_single_readings) {
    EXPECT_EQ(row_with("standard deviation 0.12 um; mean of 5 readings").origin_value, 0.12);
    EXPECT_EQ(row_with("Standardabweichung 0,12 um, n = 5").origin_value, 0.12);
    EXPECT_EQ(row_with("s = 0.12 of 5 readings").origin_value, 0.12);
    EXPECT_FALSE(row_with("standard deviation of the mean of 5 readings 0.12 um").origin_value);
}

TEST(ReadComment, knows_a_unit_of_two_words) {
    EXPECT_EQ(row_with("resolution 0.005 N m", "N m").origin_value, 0.005);
    EXPECT_FALSE(row_with("resolution 0.005 N", "N m").origin_value);
}

TEST(SettleContributions, keeps_what_the_sum_was_made_of) {
    const auto with = [](double u, double c, double contribution) {
        AuditedRow row;
        row.u = exact_number(u, "");
        row.sensitivity = exact_number(c, "");
        row.contribution = exact_number(contribution, "");
        complete_row(row);
        return row;
    };
    AuditedBudget budget;
    budget.rows = {with(1.0, 2.0, 2.0), with(1.0, 3.0, 9.0), with(2.0, 1.0, 2.0)};
    settle_contributions(budget);
    EXPECT_DOUBLE_EQ(budget.rows[0].used_sensitivity, 2.0);
    EXPECT_DOUBLE_EQ(budget.rows[1].used_sensitivity, 9.0) << "one row is an error";
    // So it is in a table without a column of u, where what is divided says as much.
    const auto divided = [](double a, double c, double contribution) {
        AuditedRow row;
        row.stated = exact_number(a, "");
        row.divisor = exact_number(2.0, "");
        row.sensitivity = exact_number(c, "");
        row.contribution = exact_number(contribution, "");
        complete_row(row);
        return row;
    };
    budget.rows = {divided(2.0, 2.0, 2.0), divided(2.0, 3.0, 0.3), divided(4.0, 1.0, 2.0)};
    settle_contributions(budget);
    EXPECT_DOUBLE_EQ(budget.rows[0].used_sensitivity, 2.0);
    EXPECT_DOUBLE_EQ(budget.rows[1].used_sensitivity, 0.3) << "one row is an error";
    // A column of shares is none of contributions.
    budget.rows = {with(1.0, 2.0, 0.40), with(1.0, 3.0, 0.60), with(2.0, 1.0, 0.10)};
    settle_contributions(budget);
    EXPECT_DOUBLE_EQ(budget.rows[0].used_sensitivity, 2.0);
    EXPECT_FALSE(budget.rows[0].contribution);
}

}  // namespace
}  // namespace gumcert::audit
