#include "certificate/gates/gates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "certificate/gates/register_gate.h"
#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

TEST(Gates, GiveTheSymbolToAPassedCertificateOnly) {
    Certificate c = passed_certificate();
    pass_gates(c);
    EXPECT_THAT(c.findings, testing::IsEmpty());
    EXPECT_FALSE(c.blocked);
    EXPECT_TRUE(c.symbol);

    c.data.status = "not_accredited";
    pass_gates(c);
    EXPECT_FALSE(c.blocked);
    EXPECT_FALSE(c.symbol);
}

TEST(Gates, AreClosedByWhatIsFoundLater) {
    Certificate c = passed_certificate();
    pass_gates(c);
    add_findings(c, {});
    EXPECT_TRUE(c.symbol);
    add_findings(
        c,
        {{.id = "audit-K02", .clause = {}, .severity = FindingSeverity::major, .where = {}, .what = {}, .action = {}}});
    EXPECT_FALSE(c.blocked);
    EXPECT_TRUE(c.symbol);
    add_findings(c, {{.id = "audit-U13",
                      .clause = {},
                      .severity = FindingSeverity::critical,
                      .where = {},
                      .what = {},
                      .action = {}}});
    EXPECT_TRUE(c.blocked);
    EXPECT_FALSE(c.symbol);
    ASSERT_EQ(c.findings.size(), 2U);
    EXPECT_EQ(c.findings.front().id, "audit-U13") << "the gravest first";
    c.data.status = "specimen";
    add_findings(c, {});
    EXPECT_FALSE(c.blocked);
}

TEST(Gates, BlockByOneCriticalFinding) {
    Certificate c = passed_certificate();
    c.data.method.no_deviations = false;  // major
    pass_gates(c);
    EXPECT_FALSE(c.blocked);
    EXPECT_TRUE(c.symbol);
    c.data.customer.name = {};  // critical
    pass_gates(c);
    EXPECT_TRUE(c.blocked);
    EXPECT_FALSE(c.symbol);
    EXPECT_THAT(ids(c.findings), testing::ElementsAre("R07-e", "R07-n"));
    c.data.status = "not_accredited";
    pass_gates(c);
    EXPECT_TRUE(c.blocked);
}

TEST(Gates, CompareNamesOfPersonsAlike) {
    // What one gate takes for the same person, no other takes for another one.
    const auto has = [](const std::vector<Finding>& findings, const char* id) {
        return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.id == id; });
    };
    const auto found = [&](const std::string& first, const std::string& second) {
        Certificate c = passed_certificate();
        c.profile.reviewer_may_be_performer = false;
        c.data.persons.performed_by->name = first;
        c.data.persons.reviewed_by->name = second;
        c.data.persons.authorised_by->name = second;
        c.data.accreditation->signatories = {first};
        c.data.customer.name = first;
        LaboratoryRegister registered;
        registered.signatories.emplace_back().name = first;
        const std::vector<Finding> plausible = plausibility_findings(c);
        CertificateData without_signatories = c.data;  // of whom P03 tells
        without_signatories.accreditation->signatories.clear();
        return std::array<bool, 5>{
            has(completeness_findings(c), "P04"), has(plausible, "P07"),
            std::count_if(plausible.begin(), plausible.end(), [](const Finding& f) { return f.id == "P13"; }) == 3,
            !has(symbol_findings(c), "P03"), !has(register_findings(without_signatories, registered), "P14")};
    };
    for (const char* spelt :
         {"A. Meier", "A.Meier", "a. meier", "A Meier", "A.  Meier", "A.\u00a0Meier", "Ａ. Meier"}) {
        EXPECT_THAT(found("A. Meier", spelt), testing::Each(true)) << spelt;
        EXPECT_THAT(found(spelt, "A. Meier"), testing::Each(true)) << spelt;
    }
    for (const char* other : {"B. Meier", "A. Meyer", "A. B. Meier"}) {
        EXPECT_THAT(found("A. Meier", other), testing::Each(false)) << other;
    }
}

// Items of sections are looked at one by one; the certificate needs none beside them.
TEST(Gates, TakeItemsMethodsAndConditionsOfSectionsForThoseOfTheWhole) {
    Certificate c = passed_certificate();
    c.tables.push_back(c.tables[0]);
    c.tables[0].section = "A";
    c.tables[0].columns.erase(c.tables[0].columns.begin() + 1);
    c.tables[1].section = "B";
    c.tables[1].columns.erase(c.tables[1].columns.begin());
    for (const char* name : {"A", "B"}) {
        SectionData& section = c.data.sections.emplace_back();
        section.section = name;
        section.item = c.data.item;
        section.item->serial_number = "SN-2" + std::string(name);
        section.method = c.data.method;
        section.conditions = c.data.conditions;
    }
    c.data.item = {};
    c.data.method = {};
    c.data.conditions.clear();
    pass_gates(c);
    EXPECT_THAT(ids(c.findings), testing::IsEmpty());
    Certificate one_without = c;
    one_without.data.sections[1].item->serial_number.clear();
    one_without.data.sections[1].item->identification.clear();
    pass_gates(one_without);
    ASSERT_THAT(ids(one_without.findings), testing::ElementsAre("R07-g"));
    EXPECT_EQ(one_without.findings[0].where, "/sections/1/item/serial_number");
    c.data.sections[1].item.reset();
    pass_gates(c);
    EXPECT_THAT(ids(c.findings), testing::Each("R07-g"));
    EXPECT_EQ(c.findings.size(), 3U) << "description, number and condition of the whole";
}

TEST(Gates, NeverBlockASpecimen) {
    Certificate c = passed_certificate();
    c.data.status = "specimen";
    c.data.customer.name = {};
    pass_gates(c);
    EXPECT_FALSE(c.blocked);
    EXPECT_FALSE(c.symbol);
    EXPECT_THAT(ids(c.findings), testing::ElementsAre("R07-e"));
}

TEST(Gates, TakeFindingsOfTheAuditToTheirs) {
    Certificate c = passed_certificate();
    c.data.method.no_deviations = false;
    pass_gates(
        c,
        {{.id = "S05", .clause = {}, .severity = FindingSeverity::information, .where = {}, .what = {}, .action = {}},
         {.id = "U13", .clause = {}, .severity = k_critical, .where = {}, .what = {}, .action = {}}});
    EXPECT_THAT(ids(c.findings), testing::ElementsAre("U13", "R07-n", "S05"));
    EXPECT_TRUE(c.blocked);
}

}  // namespace
}  // namespace gumcert::certificate
