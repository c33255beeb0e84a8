#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

std::vector<Finding> after(const std::function<void(CertificateData&)>& change) {
    Certificate c = passed_certificate();
    change(c.data);
    return plausibility_findings(c);
}

std::string clause_of_iso(const std::string& clause) {
    return "ISO/IEC 17025:2017, " + clause;
}

TEST(PlausibilityGate, HasNothingToSayOfCompleteData) {
    EXPECT_THAT(ids(plausibility_findings(passed_certificate())), testing::IsEmpty());
}

TEST(PlausibilityGate, FindsOneTextForTwoThings) {
    expect_finding(only(after([](CertificateData& d) { d.number = d.item.serial_number; })), "Q01",
                   clause_of_iso("7.8.2.1"), k_major, "/item/serial_number");
    const std::vector<Finding> three = after([](CertificateData& d) {
        d.number = "A 7";
        d.item.serial_number = "a-7";
        d.customer.name = "A7";
    });
    EXPECT_THAT(ids(three), testing::ElementsAre("Q01", "Q01"));
    EXPECT_EQ(three[0].severity, k_critical);
    // Serial number and identification may be the same.
    EXPECT_THAT(ids(after([](CertificateData& d) { d.item.identification = d.item.serial_number; })),
                testing::IsEmpty());
}

TEST(PlausibilityGate, FindsTheLaboratoryAsItsCustomer) {
    expect_finding(only(after([](CertificateData& d) { d.customer.name = "Example Calibration Laboratory"; })), "Q02",
                   clause_of_iso("7.8.2.1 e"), k_minor, "/customer/name");
}

TEST(PlausibilityGate, WantsSeveralPersonsWithNames) {
    expect_finding(only(after([](CertificateData& d) { d.persons.reviewed_by.reset(); })), "P06",
                   clause_of_iso("7.8.1.1"), k_major, "/persons/reviewed_by");
    expect_finding(only(after([](CertificateData& d) { d.persons.performed_by->name = "x"; })), "P06",
                   clause_of_iso("7.8.1.1"), k_minor, "/persons/performed_by");
    expect_finding(only(after([](CertificateData& d) {
                       d.persons.performed_by = d.persons.reviewed_by = d.persons.authorised_by;
                   })),
                   "P07", clause_of_iso("7.8.1.1"), k_major, "/persons");
    expect_finding(only(after([](CertificateData& d) { d.persons.authorised_by->authorised_from.clear(); })), "P09",
                   clause_of_iso("6.2.6"), k_minor, "/persons/authorised_by/authorised_from");
}

TEST(PlausibilityGate, FindsDatesYearsApart) {
    expect_finding(only(after([](CertificateData& d) { d.dates.authorised.clear(); })), "P10", clause_of_iso("7.8.1.1"),
                   k_major, "/dates/authorised");
    expect_finding(only(after([](CertificateData& d) { d.dates.received = "2020-01-01"; })), "P11",
                   clause_of_iso("7.5.1"), k_major, "/dates/received");
    expect_finding(only(after([](CertificateData& d) { d.dates.issued = "2028-01-01"; })), "P11",
                   clause_of_iso("7.5.1"), k_major, "/dates/issued");
    EXPECT_EQ(only(after([](CertificateData& d) {
                  d.dates = {.received = "2016-11-16",
                             .performed_from = "2016-11-18",
                             .performed_to = "2016-11-19",
                             .authorised = "2016-11-20",
                             .issued = "2016-11-21"};
              })).severity,
              k_critical);
    expect_finding(only(after([](CertificateData& d) {
                       d.recalibration_date = d.dates.issued;
                       d.recalibration_agreement = "Contract 88-2026, 5";
                   })),
                   "R08", clause_of_iso("7.8.4.3"), k_critical, "/recalibration_date");
}

TEST(PlausibilityGate, FindsConditionsThatNatureDoesNotHave) {
    struct Case {
        const char *quantity, *kind, *unit;
        double minimum, maximum;
        bool possible;
    };
    for (const Case& c : std::vector<Case>{{"Air temperature", "temperature", "degC", -273.0, -200.0, true},
                                           {"Air temperature", "temperature", "degC", -274.0, 20.0, false},
                                           {"Gradient", "", "K", -0.2, 0.2, true},
                                           {"Bath", "temperature", "K", -0.2, 0.2, false},
                                           {"Bath", "temperature", "hPa", 20.0, 21.0, false},
                                           {"Humidity", "humidity", "percent", 0.0, 100.0, true},
                                           {"Humidity", "humidity", "percent", 0.0, 101.0, false},
                                           {"relative Luftfeuchte", "", "percent", -1.0, 40.0, false},
                                           {"Water vapour", "humidity", "g/m3", 5.0, 200.0, true},
                                           {"Air pressure", "pressure", "hPa", 950.0, 1050.0, true},
                                           {"Air pressure", "pressure", "hPa", 0.0, 1050.0, false},
                                           {"Air pressure", "pressure", "mm", 760.0, 761.0, false},
                                           {"Tilt", "", "arcsec", -5.0, 5.0, true}}) {
        const std::vector<Finding> found = after([&](CertificateData& d) {
            d.conditions = {{.quantity = c.quantity,
                             .kind = c.kind,
                             .minimum = c.minimum,
                             .maximum = c.maximum,
                             .unit = c.unit,
                             .U = {},
                             .sensor = {},
                             .lower_limit = {},
                             .upper_limit = {}}};
        });
        EXPECT_EQ(found.empty(), c.possible) << c.quantity << c.minimum << c.unit;
        if (!c.possible) {
            expect_finding(only(found), "E02", clause_of_iso("7.8.4.1 b"), k_critical, "/conditions/0");
        }
    }
}

TEST(PlausibilityGate, FindsConditionsMeasuredTooCoarselyToTellAnything) {
    struct Case {
        const char *kind, *unit;
        double value, U;
        bool tells;
    };
    for (const Case& c : std::vector<Case>{{"temperature", "degC", 20.0, 9.9, true},
                                           {"temperature", "degC", 20.0, 10.1, false},
                                           {"pressure", "hPa", 1000.0, 49.0, true},
                                           {"pressure", "hPa", 1000.0, 51.0, false}}) {
        const std::vector<Finding> found = after([&](CertificateData& d) {
            d.conditions = {{.quantity = "Surroundings",
                             .kind = c.kind,
                             .minimum = c.value,
                             .maximum = c.value,
                             .unit = c.unit,
                             .U = c.U,
                             .sensor = {},
                             .lower_limit = {},
                             .upper_limit = {}}};
        });
        EXPECT_EQ(found.empty(), c.tells) << c.kind << c.U;
        if (!c.tells) {
            expect_finding(only(found), "E03", clause_of_iso("7.8.4.1 b"), k_major, "/conditions/0/U");
        }
    }
}

TEST(PlausibilityGate, WantsAgreementsAndProvidersThatAreSome) {
    expect_finding(only(after([](CertificateData& d) { d.simplified_agreement = "none"; })), "R15",
                   clause_of_iso("7.8.1.3"), k_major, "/simplified_agreement");
    expect_finding(only(after([](CertificateData& d) {
                       d.external_results = {{.results = {"l"}, .provider = "Example Calibration Laboratory"}};
                   })),
                   "R09", clause_of_iso("7.8.2.1 p"), k_major, "/external_results/0/provider");
}

}  // namespace
}  // namespace gumcert::certificate
