#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

TEST(CompletenessGate, HasNothingToSayOfCompleteData) {
    EXPECT_THAT(ids(completeness_findings(passed_certificate())), testing::IsEmpty());
}

/// One thing that is taken away or spoilt, and the one finding that must follow.
struct Spoilt {
    std::string name;
    std::function<void(Certificate&)> spoil;
    std::string id, clause;
    FindingSeverity severity;
    std::string where;
};

std::string iso(const std::string& clause) {
    return "ISO/IEC 17025:2017, " + clause;
}

std::vector<Spoilt> missing_items() {
    return {
        {"laboratory name", [](Certificate& c) { c.data.laboratory.name = {}; }, "R07-b", iso("7.8.2.1 b"), k_critical,
         "/laboratory/name"},
        {"laboratory address", [](Certificate& c) { c.data.laboratory.address = {}; }, "R07-b", iso("7.8.2.1 b"),
         k_critical, "/laboratory/address"},
        {"place", [](Certificate& c) { c.data.place.kind = "customer_site"; }, "R07-c", iso("7.8.2.1 c"), k_critical,
         "/place/address"},
        {"number", [](Certificate& c) { c.data.number.clear(); }, "R07-d", iso("7.8.2.1 d"), k_critical, "/number"},
        {"customer", [](Certificate& c) { c.data.customer.name = {}; }, "R07-e", iso("7.8.2.1 e"), k_critical,
         "/customer/name"},
        {"contact",
         [](Certificate& c) {
             c.data.customer.address = {};
             c.data.customer.contact.clear();
             c.data.customer.email.clear();
         },
         "R07-e", iso("7.8.2.1 e"), k_critical, "/customer/address"},
        {"method", [](Certificate& c) { c.data.method.identification.clear(); }, "R07-f", iso("7.8.2.1 f"), k_critical,
         "/method/identification"},
        {"method version", [](Certificate& c) { c.data.method.version.clear(); }, "R07-f", iso("7.8.2.1 f"), k_major,
         "/method/version"},
        {"item", [](Certificate& c) { c.data.item.description = {}; }, "R07-g", iso("7.8.2.1 g"), k_critical,
         "/item/description"},
        {"item identification",
         [](Certificate& c) {
             c.data.item.serial_number.clear();
             c.data.item.identification.clear();
         },
         "R07-g", iso("7.8.2.1 g"), k_critical, "/item/serial_number"},
        {"condition of the item", [](Certificate& c) { c.data.item.condition = {}; }, "R07-g", iso("7.8.2.1 g"),
         k_critical, "/item/condition"},
        {"date of receipt",
         [](Certificate& c) {
             c.profile.receipt_date_mandatory = true;
             c.data.dates.received.clear();
         },
         "R07-h", iso("7.8.2.1 h"), k_major, "/dates/received"},
        {"date of performance", [](Certificate& c) { c.data.dates.performed_from = c.data.dates.performed_to = ""; },
         "R07-i", iso("7.8.2.1 i"), k_critical, "/dates/performed_from"},
        {"date of issue", [](Certificate& c) { c.data.dates.issued.clear(); }, "R07-j", iso("7.8.2.1 j"), k_critical,
         "/dates/issued"},
        {"unit", [](Certificate& c) { c.tables[0].columns[0].unit.clear(); }, "R07-m", iso("7.8.2.1 m"), k_critical,
         "l"},
        {"deviations", [](Certificate& c) { c.data.method.no_deviations = false; }, "R07-n", iso("7.8.2.1 n"), k_major,
         "/method/deviations"},
        {"authorisation", [](Certificate& c) { c.data.persons.authorised_by.reset(); }, "R07-o", iso("7.8.2.1 o"),
         k_critical, "/persons/authorised_by"},
        {"function", [](Certificate& c) { c.data.persons.authorised_by->function = {}; }, "R07-o", iso("7.8.2.1 o"),
         k_minor, "/persons/authorised_by/function"},
        {"provider", [](Certificate& c) { c.data.external_results = {{.results = {"EAA"}, .provider = {}}}; }, "R07-p",
         iso("7.8.2.1 p"), k_critical, "/external_results/0/provider"},
        {"external result",
         [](Certificate& c) { c.data.external_results = {{.results = {"EXC"}, .provider = "Other"}}; }, "R09",
         iso("7.8.2.1 p"), k_major, "/external_results/0/results"},
        {"U", [](Certificate& c) { c.tables[0].columns[1].values[0].printed_U.clear(); }, "R07-4a", iso("7.8.4.1 a"),
         k_critical, "EAA"},
        {"conditions", [](Certificate& c) { c.data.conditions.clear(); }, "R07-4b", iso("7.8.4.1 b"), k_critical,
         "/conditions"},
        {"standards", [](Certificate& c) { c.data.standards.clear(); }, "R07-4c", iso("7.8.4.1 c"), k_critical,
         "/standards"},
        {"certificate of a standard", [](Certificate& c) { c.data.standards[0].certificate.clear(); }, "R07-4c",
         iso("7.8.4.1 c"), k_critical, "/standards/0/certificate"},
        {"adjustment", [](Certificate& c) { c.data.adjustment.reset(); }, "R07-4d", iso("7.8.4.1 d"), k_critical,
         "/adjustment"},
        {"as found", [](Certificate& c) { c.data.adjustment->adjusted = true; }, "R07-4d", iso("7.8.4.1 d"), k_critical,
         "/adjustment/as_found"},
        {"as left",
         [](Certificate& c) {
             c.tables[0].layout.emplace().shown = {
                 {.show = "value", .of = "l", .heading = {}, .role = "", .stage = "as_found"},
                 {.show = "value", .of = "EAA", .heading = {}, .role = "", .stage = "as_left"}};
         },
         "R07-4d", iso("7.8.4.1 d"), k_critical, "/adjustment/adjusted"},
        {"as found without an adjustment",
         [](Certificate& c) {
             c.tables[0].layout.emplace().shown = {
                 {.show = "value", .of = "l", .heading = {}, .role = "", .stage = "as_found"},
                 {.show = "value", .of = "EAA", .heading = {}, .role = "", .stage = ""}};
         },
         "R07-4d", iso("7.8.4.1 d"), k_major, "/adjustment/adjusted"},
        {"U of a standard", [](Certificate& c) { c.data.standards[0].U.reset(); }, "T04", iso("6.5"), k_critical,
         "/standards/0/U"},
        {"k of a standard", [](Certificate& c) { c.data.standards[0].k.reset(); }, "T04", iso("6.5"), k_major,
         "/standards/0/k"},
        {"decision rule", [](Certificate& c) { c.data.specifications[0].rule.id.clear(); }, "D01", iso("7.8.6.2 c"),
         k_critical, "/specifications/0/rule/id"},
        {"date of agreement", [](Certificate& c) { c.data.specifications[1].agreed_on.clear(); }, "D02", iso("7.1.3"),
         k_major, "/specifications/1/agreed_on"},
        {"edition", [](Certificate& c) { c.data.specifications[0].edition.clear(); }, "D03", iso("7.8.6.2 b"), k_major,
         "/specifications/0/edition"},
        {"limits",
         [](Certificate& c) {
             c.data.specifications[0].lower.reset();
             c.data.specifications[0].upper.reset();
         },
         "D03", iso("7.8.6.2 b"), k_major, "/specifications/0/upper"},
        {"specified result", [](Certificate& c) { c.data.specifications[0].results = {"m"}; }, "D07", iso("7.8.6.2 a"),
         k_major, "/specifications/0/results"},
        {"language", [](Certificate& c) { c.profile.required_languages = {"es"}; }, "R13", "profile ilac", k_major,
         "/languages"},
        {"agreement on recalibration", [](Certificate& c) { c.data.recalibration_date = "2027-11-21"; }, "R08",
         iso("7.8.4.3"), k_critical, "/recalibration_date"},
    };
}

TEST(CompletenessGate, HasNothingToSayOfStagesOfAnItemThatWasAdjusted) {
    Certificate c = passed_certificate();
    c.data.adjustment = {.adjusted = true, .as_found = "Table 3"};
    c.tables[0].layout.emplace().shown = {
        {.show = "value", .of = "l", .heading = {}, .role = "", .stage = "as_found"},
        {.show = "value", .of = "EAA", .heading = {}, .role = "", .stage = "as_left"}};
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
    c.data.adjustment = {.adjusted = false, .as_found = {}};
    c.tables[0].layout->shown = {{.show = "value", .of = "l", .heading = {}, .role = "", .stage = ""}};
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
}

TEST(CompletenessGate, FindsEachItemThatIsMissing) {
    for (const Spoilt& spoilt : missing_items()) {
        SCOPED_TRACE(spoilt.name);
        Certificate c = passed_certificate();
        spoilt.spoil(c);
        expect_finding(only(completeness_findings(c)), spoilt.id, spoilt.clause, spoilt.severity, spoilt.where);
    }
}

/// A section that states of its own what data state for the certificate.
SectionData section_with(const CertificateData& data) {
    SectionData section;
    section.section = "part";
    section.item = data.item;
    section.method = data.method;
    section.conditions = data.conditions;
    return section;
}

// The law of sections: what is a finding of item, method or conditions of a certificate is one where a section states them.
TEST(CompletenessGate, FindsTheSameInWhatASectionStates) {
    std::size_t looked_at = 0;
    for (const Spoilt& spoilt : missing_items()) {
        const auto begins = [&](const char* key) { return spoilt.where.rfind(key, 0) == 0; };
        if (!begins("/item") && !begins("/method") && !begins("/conditions/")) {
            continue;
        }
        SCOPED_TRACE(spoilt.name);
        ++looked_at;
        Certificate spoiled = passed_certificate();
        spoilt.spoil(spoiled);
        Certificate c = passed_certificate();
        c.tables.front().section = "part";
        c.data.sections = {section_with(spoiled.data)};
        pass_gates(c);
        expect_finding(only(c.findings), spoilt.id, spoilt.clause, spoilt.severity, "/sections/0" + spoilt.where);
    }
    EXPECT_GE(looked_at, 5U);
    Certificate sound = passed_certificate();
    sound.data.sections = {section_with(sound.data)};
    pass_gates(sound);
    EXPECT_THAT(ids(sound.findings), testing::IsEmpty());
}

TEST(CompletenessGate, FindsThatThereAreNoResults) {
    Certificate c = passed_certificate();
    c.tables.clear();
    expect_finding(only(completeness_findings(c)), "R07-m", iso("7.8.2.1 m"), k_critical, "results");
}

TEST(CompletenessGate, FindsDatesThatCannotStandInThisOrder) {
    const std::vector<Spoilt> orders = {
        {"received", [](Certificate& c) { c.data.dates.received = "2026-11-19"; }, "P05", iso("7.5.1"), k_critical,
         "/dates/received"},
        {"performed", [](Certificate& c) { c.data.dates.performed_to = "2026-11-17"; }, "P05", iso("7.5.1"), k_critical,
         "/dates/performed_to"},
        {"authorised", [](Certificate& c) { c.data.dates.authorised = "2026-11-18"; }, "P05", iso("7.5.1"), k_critical,
         "/dates/authorised"},
        {"issued", [](Certificate& c) { c.data.dates.issued = "2026-11-19"; }, "P05", iso("7.5.1"), k_critical,
         "/dates/issued"},
        {"standard expired", [](Certificate& c) { c.data.standards[0].valid_to = "2026-11-18"; }, "T01", iso("6.4"),
         k_critical, "/standards/0/valid_to"},
        {"standard too young", [](Certificate& c) { c.data.standards[0].calibrated = "2026-11-19"; }, "T02", iso("6.5"),
         k_critical, "/standards/0/calibrated"},
        {"rule agreed late", [](Certificate& c) { c.data.specifications[0].agreed_on = "2026-11-19"; }, "D02",
         iso("7.1.3"), k_critical, "/specifications/0/agreed_on"},
        {"method not yet valid", [](Certificate& c) { c.data.method.valid_from = "2026-11-19"; }, "P08", iso("7.2.1"),
         k_critical, "/method/valid_from"},
        {"method no longer valid", [](Certificate& c) { c.data.method.valid_to = "2026-11-18"; }, "P08", iso("7.2.1"),
         k_critical, "/method/valid_from"},
        {"operator", [](Certificate& c) { c.data.persons.performed_by->authorised_to = "2026-11-17"; }, "P03",
         iso("6.2.6"), k_critical, "/persons/performed_by"},
        {"signatory", [](Certificate& c) { c.data.persons.authorised_by->authorised_from = "2026-11-21"; }, "P03",
         iso("6.2.6"), k_critical, "/persons/authorised_by"},
    };
    for (const Spoilt& spoilt : orders) {
        SCOPED_TRACE(spoilt.name);
        Certificate c = passed_certificate();
        spoilt.spoil(c);
        expect_finding(only(completeness_findings(c)), spoilt.id, spoilt.clause, spoilt.severity, spoilt.where);
    }
}

TEST(CompletenessGate, AcceptsTheLimitsOfEveryPeriod) {
    Certificate c = passed_certificate();
    c.data.dates = {.received = "2026-11-18",
                    .performed_from = "2026-11-18",
                    .performed_to = "2026-11-18",
                    .authorised = "2026-11-18",
                    .issued = "2026-11-18"};
    c.data.standards[0].valid_to = c.data.standards[0].calibrated = "2026-11-18";
    c.data.method.valid_from = c.data.method.valid_to = "2026-11-18";
    c.data.specifications[0].agreed_on = "2026-11-18";
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
    c.data.dates.performed_to.clear();  // one day
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
}

TEST(CompletenessGate, TakesAStoredReasonForAnItemOf7_8_2_1) {
    Certificate c = passed_certificate();
    c.profile.receipt_date_mandatory = true;
    c.data.dates.received.clear();
    c.data.omissions = {{.clause = "7.8.2.1 h", .reason = "The item stays installed."}};
    const Finding found = only(completeness_findings(c));
    expect_finding(found, "R07-h", iso("7.8.2.1 h"), FindingSeverity::information, "/dates/received");
    EXPECT_THAT(found.what, testing::HasSubstr("The item stays installed."));
    // A reason that says nothing is none.
    for (const char* reason : {"x", "none", "see above", "Not needed.", "because", "無"}) {
        c.data.omissions[0].reason = reason;
        EXPECT_THAT(ids(completeness_findings(c)), testing::ElementsAre("R07-h", "R16")) << reason;
    }
}

TEST(CompletenessGate, LeavesAFindingWhereCustomerOrDeviationsAreLeftOutForAReason) {
    Certificate c = passed_certificate();
    c.data.customer.name = {};
    c.data.omissions = {{.clause = "7.8.2.1 e", .reason = "The owner wishes not to be named on paper."}};
    expect_finding(only(completeness_findings(c)), "R07-e", iso("7.8.2.1 e"), k_major, "/customer/name");
    c = passed_certificate();
    c.data.method.no_deviations = false;
    c.data.omissions = {{.clause = "7.8.2.1 n", .reason = "The notes of that day were lost."}};
    expect_finding(only(completeness_findings(c)), "R07-n", iso("7.8.2.1 n"), k_minor, "/method/deviations");
}

TEST(CompletenessGate, TakesNoReasonForAnotherItem) {
    Certificate c = passed_certificate();
    c.data.conditions.clear();
    c.data.omissions = {{.clause = "7.8.4.1 b", .reason = "not recorded"}};
    EXPECT_THAT(ids(completeness_findings(c)), testing::ElementsAre("R07-4b", "R16"));
    c = passed_certificate();
    c.data.number.clear();
    c.data.omissions = {{.clause = "7.8.2.1 d", .reason = {}}};
    EXPECT_THAT(ids(completeness_findings(c)), testing::ElementsAre("R07-d", "R16"));
}

TEST(CompletenessGate, TakesNoReasonForWhatMakesACertificate) {
    const auto found = [](const std::string& letter, auto remove) {
        Certificate c = passed_certificate();
        remove(c);
        c.data.omissions = {{.clause = "7.8.2.1 " + letter, .reason = "The customer asked for it in writing."}};
        return ids(completeness_findings(c));
    };
    using testing::ElementsAre;
    EXPECT_THAT(found("b", [](Certificate& c) { c.data.laboratory.name = {}; }), ElementsAre("R07-b", "R16"));
    EXPECT_THAT(found("d", [](Certificate& c) { c.data.number.clear(); }), ElementsAre("R07-d", "R16"));
    EXPECT_THAT(found("i", [](Certificate& c) { c.data.dates.performed_from.clear(); }),
                testing::IsSupersetOf({"R07-i", "R16"}));
    EXPECT_THAT(found("j", [](Certificate& c) { c.data.dates.issued.clear(); }), ElementsAre("R07-j", "R16"));
    EXPECT_THAT(found("m", [](Certificate& c) { c.tables.clear(); }), testing::IsSupersetOf({"R07-m", "R16"}));
    EXPECT_THAT(found("o", [](Certificate& c) { c.data.persons.authorised_by.reset(); }), ElementsAre("R07-o", "R16"));
    EXPECT_THAT(found("f", [](Certificate& c) { c.data.method.identification.clear(); }), ElementsAre("R07-f", "R16"));
    EXPECT_THAT(found("g", [](Certificate& c) { c.data.item.condition = {}; }), ElementsAre("R07-g", "R16"));
    EXPECT_THAT(found("z", [](Certificate&) {}), ElementsAre("R16"));
    EXPECT_THAT(found("k", [](Certificate&) {}), testing::IsEmpty());
}

TEST(CompletenessGate, TakesADashForNothing) {
    const auto found = [](auto change) {
        Certificate c = passed_certificate();
        change(c.data);
        return ids(completeness_findings(c));
    };
    using testing::ElementsAre;
    EXPECT_THAT(found([](CertificateData& d) { d.laboratory.name = "-"; }), ElementsAre("R07-b"));
    EXPECT_THAT(found([](CertificateData& d) { d.laboratory.name.by_language[1].second = "–"; }), ElementsAre("R07-b"));
    EXPECT_THAT(found([](CertificateData& d) { d.laboratory.address.lines = {"-", "."}; }), ElementsAre("R07-b"));
    EXPECT_THAT(found([](CertificateData& d) {
                    d.laboratory.address.lines.clear();
                    d.laboratory.address.street = "Example Street";
                    d.laboratory.address.street_no = "1";
                    d.laboratory.address.postcode = "12345";
                    d.laboratory.address.city = "Example Town";
                }),
                ElementsAre())
        << "an address by its parts";
    EXPECT_THAT(found([](CertificateData& d) { d.number = "---"; }), ElementsAre("R07-d"));
    EXPECT_THAT(found([](CertificateData& d) { d.customer.name = "?"; }), ElementsAre("R07-e"));
    EXPECT_THAT(found([](CertificateData& d) { d.item.serial_number = d.item.identification = "N/A"; }),
                ElementsAre("R07-g"));
    EXPECT_THAT(found([](CertificateData& d) { d.item.condition = "-"; }), ElementsAre("R07-g"));
    EXPECT_THAT(found([](CertificateData& d) { d.persons.authorised_by->name = "-"; }), ElementsAre("R07-o"));
    EXPECT_THAT(found([](CertificateData& d) {
                    d.conditions[0].maximum = 99.0;
                    d.method.deviations = {"-"};
                    d.method.no_deviations = false;
                }),
                testing::UnorderedElementsAre("R07-n", "E01"));
    EXPECT_THAT(found([](CertificateData& d) {
                    d.item.condition = {};
                    d.omissions = {{.clause = "7.8.2.1 g", .reason = "-"}};
                }),
                ElementsAre("R07-g", "R16"));
}

TEST(CompletenessGate, WantsTheDateOfTheCalibrationOfAStandard) {
    Certificate c = passed_certificate();
    c.data.standards[0].calibrated.clear();
    expect_finding(only(completeness_findings(c)), "R07-4c", iso("7.8.4.1 c"), FindingSeverity::critical,
                   "/standards/0/calibrated");
}

TEST(CompletenessGate, WantsADeviationWhereConditionsLeftTheLimits) {
    Certificate c = passed_certificate();
    c.data.conditions[0].maximum = 21.2;
    expect_finding(only(completeness_findings(c)), "E01", iso("7.8.2.1 n"), k_critical, "/conditions/0");
    c.data.method.deviations = {"The air was up to 21.2 °C; u of the temperature is enlarged."};
    c.data.method.no_deviations = false;
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
    c.data.conditions[0].maximum = 21.0;
    c.data.method.deviations.clear();
    c.data.method.no_deviations = true;
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
}

TEST(CompletenessGate, WantsAReviewerWhoDidNotDoTheWorkWhereTheProfileDoes) {
    Certificate c = passed_certificate();
    c.data.persons.reviewed_by->name = c.data.persons.performed_by->name;
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
    c.profile.reviewer_may_be_performer = false;
    expect_finding(only(completeness_findings(c)), "P04", iso("7.8.1.1"), k_major, "/persons/reviewed_by");
    c.data.persons.reviewed_by.reset();
    expect_finding(only(completeness_findings(c)), "P04", iso("7.8.1.1"), k_major, "/persons/reviewed_by");
}

TEST(CompletenessGate, TakesARuleThatIsPrescribedWithoutADate) {
    Certificate c = passed_certificate();
    c.data.specifications[0].agreed_on.clear();
    c.data.specifications[0].rule.prescribed_by = "ISO 3650";
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
}

TEST(CompletenessGate, TakesAStandardThatOnlyHasAStatementOfConformity) {
    Certificate c = passed_certificate();
    c.data.standards[0].U.reset();
    c.data.standards[0].conformity_statement_only = true;
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
}

TEST(CompletenessGate, TakesAnIntervalInPlaceOfU) {
    Certificate c = passed_certificate();
    CertifiedValue& v = c.tables[0].columns[1].values[0];
    v.printed_U.clear();
    v.U.reset();
    v.interval = {0.6, 2.1};
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
}

TEST(CompletenessGate, WantsAuthorAndBasisOfAnOpinion) {
    Certificate c = passed_certificate();
    c.data.opinions = {test::sample_opinion()};
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
    c.data.opinions[0].basis = {};
    expect_finding(only(completeness_findings(c)), "R14", iso("7.8.7.1"), k_major, "/opinions/0/basis");
    c.data.opinions = {test::sample_opinion()};
    c.data.opinions[0].author.name.clear();
    expect_finding(only(completeness_findings(c)), "R14", iso("7.8.7.1"), k_critical, "/opinions/0/author");
    c.data.opinions = {test::sample_opinion()};
    c.data.opinions[0].author.authorised_to = "2026-11-20";
    expect_finding(only(completeness_findings(c)), "R14", iso("7.8.7.1"), k_critical, "/opinions/0/author");
}

TEST(CompletenessGate, WantsNumberReasonAndChangesOfAnAmendment) {
    Certificate c = passed_certificate();
    const Amendment amendment{.kind = "replaced",
                              .number = "EX-2026-0041",
                              .sha256 = {},
                              .reason = "Wrong serial number",
                              .changes = {"Serial number"}};
    c.data.amendment = amendment;
    EXPECT_THAT(ids(completeness_findings(c)), testing::IsEmpty());
    c.data.amendment->number.clear();
    expect_finding(only(completeness_findings(c)), "R12", iso("7.8.8.3"), k_critical, "/amendment/number");
    c.data.amendment->kind = "amended";
    expect_finding(only(completeness_findings(c)), "R12", iso("7.8.8.2"), k_critical, "/amendment/number");
    c.data.amendment = amendment;
    c.data.amendment->number = c.data.number;
    expect_finding(only(completeness_findings(c)), "R12", iso("7.8.8.3"), k_critical, "/amendment/number");
    c.data.amendment = amendment;
    c.data.amendment->changes.clear();
    expect_finding(only(completeness_findings(c)), "R12", iso("7.8.8.1"), k_critical, "/amendment/changes");
    c.data.amendment = amendment;
    c.data.amendment->reason = {};
    expect_finding(only(completeness_findings(c)), "R12", iso("7.8.8.1"), k_major, "/amendment/reason");
    c.data.amendment->reason = "n/a";
    expect_finding(only(completeness_findings(c)), "R12", iso("7.8.8.1"), k_major, "/amendment/reason");
    c.data.amendment->reason = "error in the serial number";
    EXPECT_TRUE(completeness_findings(c).empty());
}

TEST(CompletenessGate, WantsPersonReasonAndDateOfAWaiver) {
    Certificate c = passed_certificate();
    c.data.waivers = {{.finding = "U10",
                       .where = {},
                       .by = "Head of laboratory",
                       .date = c.data.dates.issued,
                       .reason = "The maker states it so, in writing."}};
    EXPECT_THAT(completeness_findings(c), testing::IsEmpty());
    c.data.waivers.front().by = "-";
    c.data.waivers.front().reason = "ok";
    c.data.waivers.front().date = "2999-01-01";
    const std::vector<Finding> found = completeness_findings(c);
    ASSERT_EQ(found.size(), 3U);
    for (const Finding& finding : found) {
        EXPECT_EQ(finding.id, "R18");
        EXPECT_EQ(finding.severity, FindingSeverity::major);
    }
}

}  // namespace
}  // namespace gumcert::certificate
