#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/unit/reports/dcc/dcc_samples.h"

namespace gumcert::reports {
namespace {

/// A certificate that breaks no rule, in two languages.
const std::string k_good =
    "<dcc:digitalCalibrationCertificate xmlns:dcc='https://ptb.de/dcc' xmlns:si='https://ptb.de/si' "
    "schemaVersion='3.3.0'>\n"
    "<dcc:administrativeData><dcc:dccSoftware><dcc:software><dcc:release>v1.2.3</dcc:release></dcc:software>"
    "</dcc:dccSoftware><dcc:coreData><dcc:usedLangCodeISO639_1>en</dcc:usedLangCodeISO639_1>"
    "<dcc:usedLangCodeISO639_1>de</dcc:usedLangCodeISO639_1>"
    "<dcc:mandatoryLangCodeISO639_1>en</dcc:mandatoryLangCodeISO639_1>"
    "<dcc:beginPerformanceDate>2026-11-18</dcc:beginPerformanceDate>"
    "<dcc:endPerformanceDate>2026-11-18</dcc:endPerformanceDate></dcc:coreData>"
    "<dcc:items><dcc:item id='item_1'><dcc:name><dcc:content lang='en'>Gauge</dcc:content>"
    "<dcc:content lang='de'>Endmaß</dcc:content></dcc:name></dcc:item></dcc:items></dcc:administrativeData>\n"
    "<dcc:measurementResults><dcc:measurementResult refId='item_1'><dcc:name><dcc:content>R</dcc:content></dcc:name>"
    "<dcc:usedMethods>m</dcc:usedMethods><dcc:usedSoftware>s</dcc:usedSoftware>"
    "<dcc:influenceConditions>c</dcc:influenceConditions>"
    "<dcc:quantity><si:realListXMLList><si:valueXMLList>1.0 2.0</si:valueXMLList>"
    "<si:unitXMLList>\\metre</si:unitXMLList><si:measurementUncertaintyUnivariateXMLList><si:expandedMUXMLList>"
    "<si:valueExpandedMUXMLList>0.10 "
    "0.20</si:valueExpandedMUXMLList><si:coverageFactorXMLList>2</si:coverageFactorXMLList>"
    "</si:expandedMUXMLList></si:measurementUncertaintyUnivariateXMLList></si:realListXMLList>"
    "<dcc:relativeUncertainty><dcc:relativeUncertaintyXmlList><si:valueXMLList>0.10</si:valueXMLList>"
    "<si:unitXMLList>\\one</si:unitXMLList></dcc:relativeUncertaintyXmlList></dcc:relativeUncertainty>"
    "<dcc:measurementMetaData><dcc:metaData><dcc:conformityXMLList>pass fail</dcc:conformityXMLList></dcc:metaData>"
    "</dcc:measurementMetaData></dcc:quantity></dcc:measurementResult></dcc:measurementResults>\n"
    "</dcc:digitalCalibrationCertificate>\n";

TEST(DccStructure, MissingPartsAreToldWithTheirPlace) {
    std::vector<std::string> missing;
    for (const gum::Diagnostic& d : check_dcc_structure(k_good, "a.xml")) {
        if (d.code == "GC-DCC-0112") {
            missing.push_back(d.what);
        }
    }
    EXPECT_EQ(
        missing,
        (std::vector<std::string>{
            "no name in software before release", "no countryCodeISO3166_1 in coreData before usedLangCodeISO639_1",
            "no uniqueIdentifier in coreData before beginPerformanceDate", "no performanceLocation in coreData",
            "no identifications in item", "no calibrationLaboratory in administrativeData",
            "no customer in administrativeData", "no respPersons in administrativeData", "no usedMethod in usedMethods",
            "no software in usedSoftware", "no influenceCondition in influenceConditions",
            "no results in measurementResult"}));
}

std::string with(const std::string& from, const std::string& to) {
    std::string text = k_good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

/// "GC-DCC-0101 error" for every breach.
std::vector<std::string> breaches(const std::string& document) {
    std::vector<std::string> codes;
    for (const gum::Diagnostic& d : check_dcc(document, "file.xml")) {
        codes.push_back(d.code + (d.severity == gum::Severity::error ? " error" : " warning"));
        EXPECT_EQ(d.where.substr(0, 9), "file.xml:");
        EXPECT_FALSE(d.what.empty() || d.rule.empty() || d.action.empty());
    }
    return codes;
}

using Codes = std::vector<std::string>;

TEST(DccRules, AcceptTheGoodOne) {
    EXPECT_EQ(breaches(k_good), Codes());
}

TEST(DccRules, FindWhatBreaksEachOfThem) {
    const std::vector<std::pair<std::pair<std::string, std::string>, Codes>> cases = {
        {{"<dcc:usedMethods>m</dcc:usedMethods>", ""}, {"GC-DCC-0101 error"}},
        {{"<dcc:influenceConditions>c</dcc:influenceConditions>", ""}, {"GC-DCC-0101 error"}},
        {{"<dcc:usedSoftware>s</dcc:usedSoftware>", ""}, {"GC-DCC-0101 warning"}},
        {{"schemaVersion='3.3.0'", "schemaVersion='3.2.1'"}, {"GC-DCC-0102 warning"}},
        {{"refId='item_1'", "refId='item_1 item_2'"}, {"GC-DCC-0103 error"}},
        {{"refId='item_1'", ""}, {"GC-DCC-0103 warning"}},
        {{"<dcc:items>", "<dcc:items><dcc:item id='item_1'>x</dcc:item>"}, {"GC-DCC-0103 error"}},
        {{">en</dcc:usedLang", ">xx</dcc:usedLang"}, {"GC-DCC-0104 error", "GC-DCC-0104 error", "GC-DCC-0104 error"}},
        {{">de</dcc:usedLang", ">en</dcc:usedLang"}, {"GC-DCC-0104 error", "GC-DCC-0104 error"}},
        {{">en</dcc:mandatoryLang", ">es</dcc:mandatoryLang"}, {"GC-DCC-0104 error"}},
        {{"<dcc:content lang='de'>Endmaß</dcc:content>", ""}, {"GC-DCC-0104 error"}},
        {{"<dcc:content lang='de'>", "<dcc:content lang='en'>"}, {"GC-DCC-0104 error"}},
        {{"<dcc:content lang='de'>", "<dcc:content>"}, {"GC-DCC-0104 error"}},
        {{"<dcc:content>R</dcc:content>", "<dcc:content>R</dcc:content><dcc:content>S</dcc:content>"},
         {"GC-DCC-0104 error"}},
        {{">2026-11-18</dcc:beginP", ">2026-11-19</dcc:beginP"}, {"GC-DCC-0105 error"}},
        {{"v1.2.3", "0.1.0"}, {"GC-DCC-0106 error"}},
        {{"v1.2.3", "v1.2.3.4.5"}, {"GC-DCC-0106 error"}},
        {{"v1.2.3", "v1."}, {"GC-DCC-0106 error"}},
        {{"v1.2.3", "v1.2.3.4"}, {}},
        {{"1.0 2.0", "1.0  2.0"}, {"GC-DCC-0107 error"}},
        {{"1.0 2.0", "1.0 2.0 "}, {"GC-DCC-0107 error"}},
        {{"0.10 0.20</si:valueExp", "0.10 0.20 0.30</si:valueExp"}, {"GC-DCC-0107 error"}},
        {{"pass fail", "pass fail fail"}, {"GC-DCC-0107 error"}},
        {{"pass fail", "pass"}, {}},
        {{"\\metre</si:unitXMLList>", "\\metre \\volt</si:unitXMLList>"}, {"GC-DCC-0108 warning"}},
        {{"\\metre</si:unitXMLList>", "|inch</si:unitXMLList>"}, {"GC-DCC-0109 error"}},
        {{">0.10</si:valueXMLList>", ">0.12</si:valueXMLList>"}, {"GC-DCC-0110 error"}},
        {{">0.10</si:valueXMLList>", ">0.10 0.12</si:valueXMLList>"}, {"GC-DCC-0110 error"}},
        {{"<dcc:items>", "<dcc:items><dcc:owner> </dcc:owner>"}, {"GC-DCC-0111 error"}},
    };
    for (const auto& [change, expected] : cases) {
        EXPECT_EQ(breaches(with(change.first, change.second)), expected) << change.first << " -> " << change.second;
    }
}

/// 0.10 of 1.0 in other units of dimension one, and units that are no ratio.
TEST(DccRules, ReadRelativeUncertaintiesInTheirUnit) {
    const auto relative = [](const std::string& value, const std::string& unit) {
        std::string text = with(">0.10</si:valueXMLList>", ">" + value + "</si:valueXMLList>");
        const std::string one = "\\one</si:unitXMLList></dcc:relative";
        return text.replace(text.find(one), one.size(), unit + "</si:unitXMLList></dcc:relative");
    };
    EXPECT_EQ(breaches(relative("10", "\\percent")), Codes());
    EXPECT_EQ(breaches(relative("1.0e5", "\\ppm")), Codes());
    EXPECT_EQ(breaches(relative("100", "\\milli\\metre\\per\\metre")), Codes());
    EXPECT_EQ(breaches(relative("13", "\\percent")), Codes{"GC-DCC-0110 error"});
    EXPECT_EQ(breaches(relative("1.2e5", "\\ppm")), Codes{"GC-DCC-0110 error"});
    EXPECT_EQ(breaches(relative("3", "\\nano\\metre\\per\\kelvin")), Codes());  // no ratio: nothing to compare
}

/// In si:hybrid every unit has numbers of its own; a Celsius temperature has no ratio to its uncertainty.
TEST(DccRules, CompareRelativeUncertaintiesInOneUnit) {
    const std::string list =
        k_good.substr(k_good.find("<si:realListXMLList>"),
                      k_good.find("<dcc:relativeUncertainty>") - k_good.find("<si:realListXMLList>"));
    std::string other = list;
    other.replace(other.find("1.0 2.0"), 7, "20.0 30.0");
    other.replace(other.find("\\metre"), 6, "\\degreecelsius");
    EXPECT_EQ(breaches(with(list, "<si:hybrid>" + other + list + "</si:hybrid>")), Codes());
    EXPECT_EQ(breaches(with(list, "<si:hybrid>" + list + other + "</si:hybrid>")), Codes());
}

TEST(DccRules, AcceptADefinedUnitOutsideOfTheSi) {
    std::string text = with("\\metre</si:unitXMLList>", "|inch</si:unitXMLList>");
    text.replace(text.find("<dcc:metaData>"), std::string("<dcc:metaData>").size(),
                 "<dcc:metaData><dcc:nonSIDefinition>1 inch = 0.0254 m</dcc:nonSIDefinition>"
                 "<dcc:nonSIUnit>|inch</dcc:nonSIUnit></dcc:metaData><dcc:metaData>");
    EXPECT_EQ(breaches(text), Codes());
}

TEST(DccRules, AgreeWithTheWorkedExample) {
    const std::filesystem::path file = test::shared_dcc() / "worked-example-3.3.0.xml";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "the folder of examples is not there";
    }
    // Its one remark is the vector of two units, unavoidable for parameters with a covariance.
    EXPECT_EQ(breaches(test::content_of(file)), Codes{"GC-DCC-0108 warning"});
    EXPECT_EQ(breaches(test::content_of(test::shared_dcc() / "examples" / "dcclib_valid_3.3.0.xml")),
              Codes{"GC-DCC-0101 warning"});
}

}  // namespace
}  // namespace gumcert::reports
