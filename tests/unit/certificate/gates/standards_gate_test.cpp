#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

Finding after(const std::function<void(CertificateData&, StandardUsed&)>& change) {
    Certificate c = passed_certificate();
    change(c.data, c.data.standards[0]);
    return only(standard_findings(c));
}

std::string clause_of_standard(const std::string& clause) {
    return "ISO/IEC 17025:2017, " + clause;
}

TEST(StandardsGate, HasNothingToSayOfCompleteData) {
    EXPECT_THAT(ids(standard_findings(passed_certificate())), testing::IsEmpty());
}

TEST(StandardsGate, WantsAnEndOfTheValidity) {
    expect_finding(after([](CertificateData&, StandardUsed& s) { s.valid_to.clear(); }), "T05",
                   clause_of_standard("6.4"), k_major, "/standards/0/valid_to");
    const Finding old = after([](CertificateData&, StandardUsed& s) {
        s.valid_to.clear();
        s.calibrated = "1990-03-02";
    });
    expect_finding(old, "T05", clause_of_standard("6.4"), k_critical, "/standards/0/valid_to");
    EXPECT_THAT(old.what, testing::HasSubstr("1990-03-02"));
    expect_finding(after([](CertificateData&, StandardUsed& s) { s.valid_to = "2126-03-02"; }), "T05",
                   clause_of_standard("6.4"), k_major, "/standards/0/valid_to");
}

TEST(StandardsGate, FindsStandardsThatRestOnTheCertificateItself) {
    expect_finding(after([](CertificateData& d, StandardUsed& s) { s.certificate = d.number; }), "T08",
                   clause_of_standard("6.5"), k_critical, "/standards/0/certificate");
    expect_finding(after([](CertificateData&, StandardUsed& s) { s.identification = "sn1001"; }), "T08",
                   clause_of_standard("6.5"), k_critical, "/standards/0/identification");
    const auto own = [](CertificateData& d, StandardUsed& s) { s.issuer = d.laboratory.name; };
    expect_finding(after(own), "T08", clause_of_standard("6.5"), k_major, "/standards/0/issuer");
    Certificate c = passed_certificate();
    own(c.data, c.data.standards[0]);
    c.data.standards[0].route = "in_house";
    EXPECT_THAT(ids(standard_findings(c)), testing::IsEmpty());
}

// Items of sections may be of one kind: that a standard is called as they are is told once.
TEST(StandardsGate, ComparesAStandardWithTheItemsOfSections) {
    expect_finding(after([](CertificateData& d, StandardUsed& s) {
                       for (const char* number : {"SN-21", "SN-22"}) {
                           SectionData& section = d.sections.emplace_back();
                           section.item = d.item;
                           section.item->description = "Pressure gauge";
                           section.item->serial_number = number;
                       }
                       s.name = "Pressure gauge";
                   }),
                   "T08", clause_of_standard("6.5"), k_minor, "/standards/0/name");
}

TEST(StandardsGate, FindsAStandardThatStandsTwice) {
    expect_finding(after([](CertificateData& d, StandardUsed&) {
                       d.standards.push_back(d.standards[0]);
                       d.standards[1].identification = "STD-018";
                   }),
                   "T08", clause_of_standard("6.5"), k_major, "/standards/1/certificate");
}

TEST(StandardsGate, FindsAStandardThatIsWorseThanTheResults) {
    // The results of its kind have u = 31.7 nm at most.
    expect_finding(after([](CertificateData&, StandardUsed& s) { s.U = 0.0635; }), "T07", clause_of_standard("7.6.1"),
                   k_major, "/standards/0/U");
    Certificate c = passed_certificate();
    c.data.standards[0].U = 0.0633;
    EXPECT_THAT(ids(standard_findings(c)), testing::IsEmpty());
    c.data.standards[0].U = 0.064;  // 0.0635 at least
    EXPECT_THAT(ids(standard_findings(c)), testing::ElementsAre("T07"));
    c.tables[0].columns[0].values[0].u = 31.8;
    EXPECT_THAT(ids(standard_findings(c)), testing::IsEmpty()) << "0.0636 is 0.064 in two digits";
    c.tables[0].columns[0].values[0].u = 31.7;
    c.data.standards[0].unit = "V";  // of another kind
    c.data.standards[0].U = 1e6;
    EXPECT_THAT(ids(standard_findings(c)), testing::IsEmpty());
    c.data.standards[0] = test::sample_standard();
    c.data.standards[0].U = 0.15;
    c.tables[0].id = "error_motions";  // differences
    EXPECT_THAT(ids(standard_findings(c)), testing::IsEmpty());
    c.data.standards[0].U = 0.20;
    EXPECT_THAT(ids(standard_findings(c)), testing::ElementsAre("T07"));
}

/// Each of the three is told at its own place, with what was given: nobody looks for what is there.
TEST(StandardsGate, TellsWhichMemberOfAStandardSaysNothing) {
    using Member = std::string StandardUsed::*;
    for (const auto& [key, member] : {std::pair<const char*, Member>{"identification", &StandardUsed::identification},
                                      std::pair<const char*, Member>{"certificate", &StandardUsed::certificate}}) {
        for (const std::string given : {"", "n/a", "0000"}) {
            const Finding found = after([&](CertificateData&, StandardUsed& s) { s.*member = given; });
            expect_finding(found, "R07-4c", clause_of_standard("7.8.4.1 c"), FindingSeverity::critical,
                           std::string("/standards/0/") + key);
            EXPECT_EQ(found.what.find('"' + given + "\" does not count") == 0, !given.empty()) << found.what;
        }
    }
    const Finding of_issuer = after([](CertificateData&, StandardUsed& s) { s.issuer = "Lab Z"; });
    expect_finding(of_issuer, "R07-4c", clause_of_standard("7.8.4.1 c"), FindingSeverity::critical,
                   "/standards/0/issuer");
    EXPECT_TRUE(of_issuer.what.starts_with("\"Lab Z\" does not count as")) << of_issuer.what;
    Certificate nothing = passed_certificate();
    nothing.data.standards[0].identification.clear();
    nothing.data.standards[0].certificate.clear();
    nothing.data.standards[0].issuer = "";
    EXPECT_THAT(ids(standard_findings(nothing)), testing::ElementsAre("R07-4c", "R07-4c", "R07-4c"));
}

TEST(StandardsGate, WantsANameOfTheStandard) {
    expect_finding(after([](CertificateData&, StandardUsed& s) { s.name = "standard"; }), "R07-4c",
                   clause_of_standard("7.8.4.1 c"), k_major, "/standards/0/name");
}

}  // namespace
}  // namespace gumcert::certificate
