#include "certificate/gates/register_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

/// What is found where the register is what `change` makes of it.
std::vector<Finding> with_register(const std::function<void(CertificateData&, LaboratoryRegister&)>& change) {
    CertificateData data = passed_certificate().data;
    LaboratoryRegister registered;
    LaboratoryRegister::Signatory one;
    one.name = data.persons.authorised_by->name;
    registered.signatories = {one};
    change(data, registered);
    return register_findings(data, registered);
}

TEST(RegisterGate, IsSilentWhereAllFits) {
    EXPECT_TRUE(with_register([](CertificateData&, LaboratoryRegister& r) {
                    r.uses = {{"STD-1", "V", "yes", ""}};
                }).empty());
}

TEST(RegisterGate, ContradictionsAreCritical) {
    const auto contradiction = [](const char* where) {
        return only(with_register([&](CertificateData&, LaboratoryRegister& r) {
            r.contradictions = {{where, "the standard \"STD-1\"", "\"2027-12-31\"", "\"2026-12-31\""}};
        }));
    };
    expect_finding(contradiction("/standards/0/valid_to"), "T10", "ISO/IEC 17025:2017, 6.5", k_critical,
                   "/standards/0/valid_to");
    expect_finding(contradiction("/accreditation/number"), "L01", "ISO/IEC 17025:2017, 7.8.2.1", k_critical,
                   "/accreditation/number");
}

TEST(RegisterGate, StandardsAreApplicableOrNotOrNobodyKnows) {
    const auto use = [](const char* answer) {
        return only(with_register([&](CertificateData&, LaboratoryRegister& r) {
            r.uses = {{"STD-1", "V", answer, "it lies outside"}};
        }));
    };
    expect_finding(use("no"), "T11", "ISO/IEC 17025:2017, 6.4", k_critical, "V");
    expect_finding(use("unknown"), "T11", "ISO/IEC 17025:2017, 6.4", k_major, "V");
    EXPECT_THAT(use("unknown").what, testing::HasSubstr("it is not known"));
}

TEST(RegisterGate, TellsOneReasonOnce) {
    const std::vector<Finding> found = with_register([](CertificateData&, LaboratoryRegister& r) {
        r.uses = {{"STD-1", "V", "unknown", "no day"}, {"STD-1", "V", "unknown", "no day"},
                  {"STD-1", "W", "unknown", "no day"}, {"STD-1", "V", "no", "101 V lies outside"},
                  {"STD-2", "V", "unknown", "no day"}, {"STD-3", "V", "yes", ""}};
    });
    std::vector<std::string> told;
    for (const Finding& one : found) {
        told.push_back(one.where + ": " + one.what);
    }
    EXPECT_THAT(told,
                testing::ElementsAre(testing::AllOf(testing::StartsWith("inputs V, W: "), testing::HasSubstr("STD-1")),
                                     testing::AllOf(testing::StartsWith("V: "), testing::HasSubstr("101 V")),
                                     testing::AllOf(testing::StartsWith("V: "), testing::HasSubstr("STD-2"))));
}

/// What the dates of the row of a standard show is told by the gate on standards (T01, T05): the register does not repeat it.
TEST(RegisterGate, DoesNotRepeatWhatTheDatesOfARowSay) {
    const auto ids_with = [](const std::string& valid_to, const char* answer, bool is_of_validity,
                             bool overdue = false) {
        std::vector<std::string> ids;
        for (
            const Finding& one : with_register([&](CertificateData&data, LaboratoryRegister&r) {
                data.standards[0].valid_to = valid_to;
                r.uses = {{data.standards[0].identification, "V", answer, "its calibration was valid", is_of_validity}};
                if (overdue) {
                    r.overdue = {{data.standards[0].identification, "2026-11-19", "2020-01-01"}};
                }
            })) {
            ids.push_back(one.id);
        }
        return ids;
    };
    using testing::ElementsAre;
    using testing::IsEmpty;
    EXPECT_THAT(ids_with("2020-01-01", "no", true), IsEmpty()) << "T01";
    EXPECT_THAT(ids_with("2020-01-01", "no", true, true), IsEmpty()) << "T01 tells the day of the plan";
    EXPECT_THAT(ids_with("2020-01-02", "no", true, true), ElementsAre("T14")) << "another day";
    EXPECT_THAT(ids_with("", "unknown", true), IsEmpty()) << "T05";
    EXPECT_THAT(ids_with("", "no", true), ElementsAre("T11")) << "T05 is less grave";
    EXPECT_THAT(ids_with("2020-01-01", "no", false), ElementsAre("T11")) << "another reason";
    EXPECT_THAT(ids_with("2029-01-01", "no", true), ElementsAre("T11")) << "the row says nothing against it";
    const Finding told = only(with_register([](CertificateData& data, LaboratoryRegister& r) {
        data.standards[0].valid_to = "2029-01-01";
        data.standards[0].calibrated.clear();
        r.uses = {{data.standards[0].identification, "V", "no", "its calibration was valid", true}};
    }));
    EXPECT_EQ(told.id, "T11") << "a day that is missing (R07-4c) is another cause";
}

TEST(RegisterGate, DoesNotRepeatWhatIsToldOfTheSignatory) {
    const auto found = [](const auto& change) {
        return with_register([&](CertificateData& data, LaboratoryRegister& r) {
            data.status = "accredited";
            data.accreditation.emplace().signatories = {data.persons.authorised_by->name};
            change(data, r);
        });
    };
    const auto no_signatory = [](CertificateData& data, LaboratoryRegister& r) {
        data.accreditation->signatories = {"Another person"};
        r.signatories[0].name = "Another person";
    };
    EXPECT_TRUE(found(no_signatory).empty()) << "P03 of the accreditation";
    EXPECT_TRUE(found([&](CertificateData& data, LaboratoryRegister& r) {
                    data.accreditation->signatories = {"Another person"};
                    r.signatories[0].authorises = false;
                }).empty());
    EXPECT_EQ(found([&](CertificateData&, LaboratoryRegister& r) { r.signatories[0].authorises = false; }).size(), 1U);
    EXPECT_EQ(found([&](CertificateData& data, LaboratoryRegister& r) {
                  no_signatory(data, r);
                  data.status = "not_accredited";
              }).size(),
              1U);
    const auto run_out = [](CertificateData& data, LaboratoryRegister& r) {
        r.signatories[0].to = "2020-01-01";
        data.persons.authorised_by->authorised_to = "2020-01-01";
    };
    EXPECT_TRUE(found(run_out).empty()) << "P03 of the day";
    EXPECT_EQ(found([&](CertificateData& data, LaboratoryRegister& r) {
                  run_out(data, r);
                  data.persons.authorised_by->authorised_to.clear();
              }).size(),
              1U);
}

TEST(RegisterGate, StandardsStandInRegisterAndList) {
    expect_finding(only(with_register([](CertificateData&, LaboratoryRegister& r) { r.not_registered = {"STD-9"}; })),
                   "T12", "ISO/IEC 17025:2017, 6.4", k_major, "/standards");
    expect_finding(only(with_register([](CertificateData&, LaboratoryRegister& r) { r.not_listed = {"STD-1"}; })),
                   "T13", "ISO/IEC 17025:2017, 7.8.4.1 c", k_minor, "/standards");
}

TEST(RegisterGate, APlanOfTheLaboratoryBindsIt) {
    const Finding finding = only(with_register([](CertificateData&, LaboratoryRegister& r) {
        r.overdue = {{"STD-1", "2026-11-19", "2026-02-03"}};
    }));
    expect_finding(finding, "T14", "ISO/IEC 17025:2017, 6.4", k_critical, "/standards");
    EXPECT_THAT(finding.what, testing::HasSubstr("used on 2026-11-19"));
    EXPECT_THAT(finding.what, testing::HasSubstr("due on 2026-02-03"));
}

TEST(RegisterGate, OnlyARegisteredSignatoryAuthorises) {
    const auto signatory = [](const std::function<void(LaboratoryRegister::Signatory&)>& change) {
        return only(with_register([&](CertificateData&, LaboratoryRegister& r) { change(r.signatories.front()); }));
    };
    const std::string place = "/persons/authorised_by";
    const std::string clause = "ISO/IEC 17025:2017, 6.2.6";
    expect_finding(signatory([](auto& s) { s.name = "Another person"; }), "P14", clause, k_critical, place);
    expect_finding(signatory([](auto& s) { s.authorises = false; }), "P14", clause, k_critical, place);
    expect_finding(signatory([](auto& s) { s.to = "2020-01-01"; }), "P14", clause, k_critical, place);
    expect_finding(signatory([](auto& s) { s.methods = {"another method"}; }), "P14", clause, k_critical, place);
    EXPECT_TRUE(with_register([](CertificateData&, LaboratoryRegister& r) { r.signatories.clear(); }).empty());
}

TEST(RegisterGate, AsksForTheMethodsOfSectionsWhereTheWholeHasNone) {
    const auto found = [](const std::string& method) {
        return with_register([&](CertificateData& data, LaboratoryRegister& r) {
            SectionData& section = data.sections.emplace_back();
            section.section = "A";
            section.method = data.method;
            r.signatories.front().methods = {method.empty() ? data.method.identification : method};
            data.method = {};
        });
    };
    EXPECT_TRUE(found("").empty());
    EXPECT_EQ(found("another method").size(), 1U);
}

}  // namespace
}  // namespace gumcert::certificate
