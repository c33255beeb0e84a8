#include "reports/dcc/dcc_statements.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reports/dcc/d_si_unit.h"
#include "tests/unit/reports/dcc/dcc_samples.h"

namespace gumcert::reports {
namespace {

struct Stated {
    std::string values = "0.072 0.089", unit = "\\kelvin", conformity = "pass pass", limit_unit = "\\kelvin";
    std::string lower = "-0.10", upper = "0.10", lower_kind = "basic_acceptanceLimitLower",
                upper_kind = "basic_acceptanceLimitUpper";
    std::string k = "2", p = "0.95", distribution = "normal";
};

std::string limit(const std::string& kind, const std::string& value, const std::string& unit) {
    return "<dcc:quantity refType='" + kind + "'><si:realListXMLList><si:valueXMLList>" + value +
           "</si:valueXMLList><si:unitXMLList>" + unit + "</si:unitXMLList></si:realListXMLList></dcc:quantity>";
}

std::vector<std::string> found_in(const Stated& s) {
    const std::string text =
        "<dcc:quantity xmlns:dcc='https://ptb.de/dcc' xmlns:si='https://ptb.de/si'><dcc:quantity><si:realListXMLList>"
        "<si:valueXMLList>" +
        s.values + "</si:valueXMLList><si:unitXMLList>" + s.unit +
        "</si:unitXMLList><si:expandedUncXMLList><si:uncertaintyXMLList>0.061</si:uncertaintyXMLList>"
        "<si:coverageFactorXMLList>" +
        s.k + "</si:coverageFactorXMLList><si:coverageProbabilityXMLList>" + s.p +
        "</si:coverageProbabilityXMLList><si:distributionXMLList>" + s.distribution +
        "</si:distributionXMLList></si:expandedUncXMLList></si:realListXMLList><dcc:measurementMetaData><dcc:metaData>"
        "<dcc:conformityXMLList>" +
        s.conformity + "</dcc:conformityXMLList><dcc:data>" + limit(s.lower_kind, s.lower, s.limit_unit) +
        limit(s.upper_kind, s.upper, s.limit_unit) +
        "</dcc:data></dcc:metaData></dcc:measurementMetaData></dcc:quantity></dcc:quantity>";
    std::vector<std::string> codes;
    for (const gum::Diagnostic& d : contradicting_statements(read_xml(text, "a.xml"), "a.xml")) {
        codes.push_back(d.code + (d.severity == gum::Severity::error ? " error" : " warning"));
        EXPECT_TRUE(d.where.starts_with("a.xml:1:")) << d.where;
        EXPECT_FALSE(d.what.empty() || d.rule.empty() || d.action.empty());
    }
    return codes;
}

using Codes = std::vector<std::string>;

TEST(DccStatements, AConformityThatItsLimitsRefuteIsTold) {
    const std::vector<std::pair<Stated, Codes>> cases = {
        {{}, {}},
        {{.upper = "0.08"}, {"GC-DCC-0116 error"}},
        {{.upper = "0.10 0.08"}, {"GC-DCC-0116 error"}},
        {{.upper = "0.08 0.10"}, {}},
        {{.lower = "0.08"}, {"GC-DCC-0116 error"}},
        {{.conformity = "pass", .upper = "0.08"}, {"GC-DCC-0116 error"}},
        {{.conformity = "pass fail", .upper = "0.08"}, {}},
        {{.conformity = "pass fail"}, {"GC-DCC-0116 warning"}},
        {{.conformity = "pass conditionalPass", .upper = "0.08"}, {}},
        // On the limit, and as near to it as the printed digits can hide.
        {{.upper = "0.089"}, {}},
        {{.upper = "0.0888"}, {}},
        {{.upper = "0.0880"}, {"GC-DCC-0116 error"}},
        // Other units, other names.
        {{.limit_unit = "\\milli\\kelvin", .lower = "-80", .upper = "80"}, {"GC-DCC-0116 error"}},
        {{.limit_unit = "\\milli\\kelvin", .lower = "-100", .upper = "100"}, {}},
        {{.limit_unit = "\\degreecelsius", .lower = "-0.08", .upper = "0.08"}, {}},  // another scale: not compared
        {{.upper = "0.08", .lower_kind = "a_limitMin", .upper_kind = "a_limitMax"}, {"GC-DCC-0116 error"}},
        {{.upper = "0.08", .lower_kind = "gp_minimum", .upper_kind = "gp_maximum"}, {}},  // not called limits
        // Acceptance limits decide, and may lie outside of the tolerance.
        {{.lower = "-0.08", .lower_kind = "basic_toleranceLimitUpper"}, {}},
    };
    for (const auto& [stated, expected] : cases) {
        EXPECT_EQ(found_in(stated), expected) << stated.conformity << " " << stated.lower << " " << stated.upper;
    }
}

TEST(DccStatements, AFactorThatDistributionAndProbabilityDoNotGiveIsTold) {
    const std::vector<std::pair<Stated, Codes>> cases = {
        {{.k = "2", .p = "0.9545"}, {}},
        {{.k = "1.96"}, {}},
        {{.k = "2.0", .p = "0.95"}, {}},
        {{.k = "3", .p = "0.9973"}, {}},
        {{.k = "1.65", .p = "0.90"}, {}},
        {{.k = "2.58", .p = "0.99"}, {}},
        {{.k = "1", .p = "0.68"}, {}},
        {{.k = "2", .p = "0.68"}, {"GC-DCC-0117 error"}},
        {{.k = "2", .p = "0.99"}, {"GC-DCC-0117 error"}},
        {{.k = "3", .p = "0.95"}, {"GC-DCC-0117 error"}},
        {{.k = "2.13", .p = "0.95"}, {"GC-DCC-0117 warning"}},
        {{.k = "2.13", .p = "0.95", .distribution = "student_t"}, {}},
        {{.k = "1.65", .p = "0.95", .distribution = "rectangular"}, {}},
        {{.k = "2", .p = "0.95", .distribution = "uniform"}, {"GC-DCC-0117 error"}},
        {{.k = "2 2", .p = "0.95 0.68"}, {"GC-DCC-0117 error"}},
        {{.k = "2", .p = "0.95 0.68", .distribution = "normal Gaussian"}, {"GC-DCC-0117 error"}},
    };
    for (const auto& [stated, expected] : cases) {
        EXPECT_EQ(found_in(stated), expected) << stated.k << " " << stated.p << " " << stated.distribution;
    }
}

TEST(DccStatements, UnitsThatDsiDoesNotKnowAreTold) {
    for (const char* good : {"\\metre", "\\milli\\metre", "\\metre\\per\\second", "\\metre\\second\\tothe{-1}", "\\one",
                             "\\volt\\hertz\\tothe{-0.5}", "\\kibi\\byte", "\\neper", "|inch", "\\percent"}) {
        EXPECT_EQ(found_in({.unit = good, .limit_unit = good}), Codes()) << good;
        EXPECT_TRUE(is_d_si(good)) << good;
    }
    for (const char* bad :
         {"mm", "\\meter", "\\milli", "\\metre\\per", "\\per\\second", "\\metre\\per\\second\\per\\second", "1", "|",
          "\\tothe{2}", "\\metre\\tothe{}", "\\metre\\tothe{two}", "\\metre\\tothe{2", "\\Metre", "°C", "metre"}) {
        EXPECT_EQ(found_in({.unit = bad}).front(), "GC-DCC-0118 error") << bad;
        EXPECT_FALSE(is_d_si(bad)) << bad;
    }
    // What this program reads is D-SI.
    for (const char* unit : {"\\joule\\per\\kilogram\\kelvin", "\\degreecelsius", "\\micro\\metre\\tothe{2}"}) {
        EXPECT_TRUE(unit_from_d_si(unit) && is_d_si(unit)) << unit;
    }
}

// The published examples contradict themselves nowhere.
TEST(DccStatements, AreConsistentInThePublishedExamples) {
    if (!std::filesystem::exists(test::shared_dcc())) {
        GTEST_SKIP() << "the folder of examples is not there";
    }
    for (const auto& entry : std::filesystem::directory_iterator(test::shared_dcc() / "examples")) {
        if (entry.path().extension() == ".xml") {
            const auto found = contradicting_statements(read_xml(test::content_of(entry.path()), "a.xml"), "a.xml");
            EXPECT_TRUE(found.empty()) << entry.path() << " " << gum::message(found.front());
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
