#include "imports/import_standard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::imports {
namespace {

std::string certificate_with(const std::string& uncertainty) {
    return "<dcc:digitalCalibrationCertificate xmlns:dcc='https://ptb.de/dcc' xmlns:si='https://ptb.de/si' "
           "schemaVersion='3.3.0'><dcc:administrativeData><dcc:coreData><dcc:uniqueIdentifier>EX-1"
           "</dcc:uniqueIdentifier><dcc:beginPerformanceDate>2026-03-01</dcc:beginPerformanceDate>"
           "<dcc:endPerformanceDate>2026-03-02</dcc:endPerformanceDate></dcc:coreData><dcc:calibrationLaboratory>"
           "<dcc:contact><dcc:name><dcc:content>Example Institute</dcc:content></dcc:name></dcc:contact>"
           "</dcc:calibrationLaboratory></dcc:administrativeData><dcc:measurementResults><dcc:measurementResult>"
           "<dcc:usedMethods>m</dcc:usedMethods><dcc:usedSoftware>s</dcc:usedSoftware>"
           "<dcc:influenceConditions>c</dcc:influenceConditions><dcc:results><dcc:result><dcc:data><dcc:quantity>"
           "<dcc:name><dcc:content>Length</dcc:content></dcc:name><si:real><si:value>1.50</si:value>"
           "<si:unit>\\milli\\metre</si:unit>" +
           uncertainty +
           "</si:real></dcc:quantity></dcc:data></dcc:result></dcc:results></dcc:measurementResult>"
           "</dcc:measurementResults></dcc:digitalCalibrationCertificate>";
}

TEST(ImportStandard, MakesAFileOfTheRegister) {
    const ImportedJob imported =
        import_standard(certificate_with("<si:measurementUncertaintyUnivariate><si:expandedMU><si:valueExpandedMU>0.020"
                                         "</si:valueExpandedMU><si:coverageFactor>2.0</si:coverageFactor>"
                                         "<si:coverageProbability>0.95</si:coverageProbability></si:expandedMU>"
                                         "</si:measurementUncertaintyUnivariate>"),
                        "certificate.xml", "STD-2");
    const nlohmann::json standard = nlohmann::json::parse(imported.job);
    EXPECT_EQ(standard["schema"], "gumcert/standard/1");
    EXPECT_EQ(standard["id"], "STD-2");
    EXPECT_FALSE(standard.contains("drift"));  // the laboratory states it
    const nlohmann::json& calibration = standard["calibrations"][0];
    EXPECT_EQ(calibration["calibrated"], "2026-03-02");
    EXPECT_EQ(calibration["certificate"], "EX-1");
    EXPECT_EQ(calibration["issuer"], "Example Institute");
    EXPECT_EQ(calibration["sha256"].get<std::string>().size(), 64U);
    ASSERT_EQ(calibration["results"].size(), 1U);
    const nlohmann::json& line = calibration["results"][0];
    EXPECT_EQ(line["value"], 1.5);
    EXPECT_EQ(line["unit"], "mm");
    EXPECT_EQ(line["U"], 0.02);
    EXPECT_EQ(line["k"], 2.0);
    EXPECT_EQ(imported.remarks.back().code, "GC-LAB-0020");
}

TEST(ImportStandard, AStandardUncertaintyHasTheFactorOne) {
    const ImportedJob imported =
        import_standard(certificate_with("<si:measurementUncertaintyUnivariate><si:standardMU><si:valueStandardMU>0.01"
                                         "</si:valueStandardMU></si:standardMU></si:measurementUncertaintyUnivariate>"),
                        "certificate.xml", "STD-2");
    const nlohmann::json line = nlohmann::json::parse(imported.job)["calibrations"][0]["results"][0];
    EXPECT_EQ(line["U"], 0.01);
    EXPECT_EQ(line["k"], 1);
}

TEST(ImportStandard, NeedsAnUncertainty) {
    try {
        (void)import_standard(certificate_with(""), "certificate.xml", "STD-2");
        FAIL();
    } catch (const gum::InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-LAB-0021");
    }
}

}  // namespace
}  // namespace gumcert::imports
