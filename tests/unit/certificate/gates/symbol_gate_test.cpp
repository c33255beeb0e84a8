#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

constexpr FindingSeverity k_information = FindingSeverity::information;

CertifiedValue& axial(Certificate& c) {
    return c.tables[0].columns[1].values[0];
}

void put_outside(CertifiedValue& value) {
    value.scope_entry.clear();
    value.outside_because = "angle = 400 is not in 0 to 360";
}

TEST(SymbolGate, HasNothingToSayOfACertificateInScope) {
    EXPECT_THAT(ids(symbol_findings(passed_certificate())), testing::IsEmpty());
}

TEST(SymbolGate, FindsWhatForbidsTheSymbol) {
    struct Case {
        const char* name;
        std::function<void(Certificate&)> spoil;
        const char* id;
        const char* clause;
        FindingSeverity severity;
        const char* where;
    };
    const std::vector<Case> cases = {
        {"no accreditation", [](Certificate& c) { c.data.accreditation.reset(); }, "X08", "ILAC-P8", k_critical,
         "/accreditation"},
        {"a dash", [](Certificate& c) { c.data.accreditation->number = "–"; }, "X08", "ILAC-P8", k_critical,
         "/accreditation/number"},
        {"no number", [](Certificate& c) { c.data.accreditation->number.clear(); }, "X08", "ILAC-P8", k_critical,
         "/accreditation/number"},
        {"not yet valid", [](Certificate& c) { c.data.accreditation->valid_from = "2026-11-19"; }, "X04", "ILAC-P8",
         k_critical, "/accreditation/valid_to"},
        {"expired before the work", [](Certificate& c) { c.data.accreditation->valid_to = "2026-01-20"; }, "X04",
         "ILAC-P8", k_critical, "/accreditation/valid_to"},
        {"expired before the issue", [](Certificate& c) { c.data.accreditation->valid_to = "2026-11-20"; }, "X04",
         "ILAC-P8", k_critical, "/accreditation/valid_to"},
        {"other signatory", [](Certificate& c) { c.data.accreditation->signatories = {"Deputy"}; }, "P03",
         "ISO/IEC 17025:2017, 6.2.6", k_critical, "/persons/authorised_by"},
        {"no route", [](Certificate& c) { c.data.standards[0].route.clear(); }, "T03", "ILAC-P10:07/2020", k_critical,
         "/standards/0/route"},
        {"no evidence", [](Certificate& c) { c.data.standards[0].route = "3b"; }, "T03", "ILAC-P10:07/2020", k_critical,
         "/standards/0/evidence"},
        {"issuer not accredited",
         [](Certificate& c) {
             c.data.standards[0].route = "2";
             c.data.standards[0].issuer_accreditation.clear();
         },
         "T03", "ILAC-P10:07/2020", k_critical, "/standards/0/issuer_accreditation"},
        {"U below the capability",
         [](Certificate& c) {
             axial(c).printed_value = "1.230";
             axial(c).printed_U = "0.199";
         },
         "X01", "ILAC-P14:09/2020", k_critical, "EAA"},
        {"opinions", [](Certificate& c) { c.data.opinions = {test::sample_opinion()}; }, "X07", "ILAC-P8", k_critical,
         "/opinions"},
        {"outside", [](Certificate& c) { put_outside(axial(c)); }, "X06", "ILAC-P8", k_information, "EAA"},
        {"outside, refused",
         [](Certificate& c) {
             put_outside(axial(c));
             c.profile.mixed_results = "refuse";
         },
         "X06", "ILAC-P8", k_critical, "EAA"},
        {"outside, separate columns",
         [](Certificate& c) {
             put_outside(axial(c));
             c.profile.mixed_results = "separate";
         },
         "X06", "ILAC-P8", k_information, "EAA"},
        {"outside, mixed in one column",
         [](Certificate& c) {
             c.tables[0].columns[1].values.push_back(axial(c));
             put_outside(axial(c));
             c.profile.mixed_results = "separate";
         },
         "X06", "ILAC-P8", k_critical, "EAA"},
        {"U is the capability everywhere",
         [](Certificate& c) {
             axial(c).printed_U = "0.20";
             c.tables[0].columns[0].values[0].raised = true;
         },
         "X03", "ILAC-P14:09/2020", k_major, "results"},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        Certificate c = passed_certificate();
        one.spoil(c);
        expect_finding(only(symbol_findings(c)), one.id, one.clause, one.severity, one.where);
    }
}

TEST(SymbolGate, FindsThatNothingIsInScope) {
    Certificate c = passed_certificate();
    for (CertifiedColumn& column : c.tables[0].columns) {
        put_outside(column.values[0]);
    }
    EXPECT_THAT(ids(symbol_findings(c)), testing::ElementsAre("X06", "X02"));
    pass_gates(c);
    EXPECT_TRUE(c.blocked);
    EXPECT_FALSE(c.symbol);
    EXPECT_EQ(c.findings.front().id, "X02");
}

// What is outside for one reason is one finding, with the numbers of the value that is farthest outside.
TEST(SymbolGate, TellsWhatIsOutsideOnceWithTheWorst) {
    Certificate c = passed_certificate();
    CertifiedTable& table = c.tables[0];
    table.argument = CertifiedTable::Argument{
        .name = "point", .unit = "", .printed_unit = "", .values = {{}, {}, {}}, .printed = {"1", "2", "3"}};
    const auto put = [&](std::size_t column, const std::vector<double>& angles) {
        std::vector<CertifiedValue>& values = table.columns[column].values;
        values.resize(angles.size(), values[0]);
        for (std::size_t row = 0; row < angles.size(); ++row) {
            put_outside(values[row]);
            values[row].outside_because =
                "angle = " + std::to_string(static_cast<int>(angles[row])) + " is not in 0 to 360";
            values[row].outside_by = angles[row] / 360.0 - 1.0;
        }
    };
    put(0, {380.0, 400.0, 390.0});
    put(1, {370.0, 450.0, 370.0});
    const std::vector<Finding> findings = symbol_findings(c);
    ASSERT_THAT(ids(findings), testing::ElementsAre("X06", "X02"));
    EXPECT_EQ(findings[0].where, "l, EAA, points 1, 2, 3");
    EXPECT_EQ(findings[0].what,
              "6 values are outside of the accreditation: angle = 450 is not in 0 to 360; the numbers are those of "
              "\"EAA\" at point 2, the worst of 6");
    table.columns[1].values[1].outside_because = "the scope entry does not name the method";
    EXPECT_THAT(ids(symbol_findings(c)), testing::ElementsAre("X06", "X06", "X02")) << "two causes";
}

TEST(SymbolGate, FindsACapabilityThatCannotBeUsed) {
    Certificate c = passed_certificate();
    c.data.accreditation->scope[1].capability.U = -0.2;
    const Finding found = only(symbol_findings(c));
    EXPECT_EQ(found.id, "X05");
    EXPECT_EQ(found.severity, k_major);
    EXPECT_THAT(found.where, testing::StartsWith("/accreditation/scope/1/capability"));
}

TEST(SymbolGate, ComparesWithTheCapabilityAsTheScopeStatesIt) {
    Certificate c = passed_certificate();
    axial(c).capability = 0.1 + 0.2;  // 0.30000000000000004, from a conversion of units
    axial(c).printed_U = "0.30";
    EXPECT_THAT(ids(symbol_findings(c)), testing::IsEmpty());
}

TEST(SymbolGate, LetsOpinionsStandWhereTheProfileDoes) {
    Certificate c = passed_certificate();
    c.data.opinions = {test::sample_opinion()};
    c.profile.opinions_with_symbol = true;
    EXPECT_THAT(ids(symbol_findings(c)), testing::IsEmpty());
}

TEST(SymbolGate, LeavesValuesWithoutUncertaintyByDefinitionAlone) {
    Certificate c = passed_certificate();
    CertifiedValue home;
    home.printed_value = "0";
    c.tables[0].columns[1].values.push_back(home);
    c.profile.mixed_results = "refuse";
    EXPECT_THAT(ids(symbol_findings(c)), testing::IsEmpty());
}

TEST(SymbolGate, DoesNotApplyWithoutAccreditation) {
    Certificate c = passed_certificate();
    c.data.accreditation.reset();
    for (const char* status : {"not_accredited", "specimen"}) {
        c.data.status = status;
        EXPECT_THAT(ids(symbol_findings(c)), testing::IsEmpty());
    }
}

}  // namespace
}  // namespace gumcert::certificate
