#include "imports/import_standard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

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

std::string list_of(const std::string& ref_type, const std::string& values, const std::string& unit,
                    const std::string& U, const std::string& status = "") {
    return "<dcc:quantity refType='" + ref_type + "'><dcc:name><dcc:content>" + ref_type +
           "</dcc:content></dcc:name><si:realListXMLList><si:valueXMLList>" + values +
           "</si:valueXMLList><si:unitXMLList>" + unit + "</si:unitXMLList>" +
           (U.empty()
                ? ""
                : "<si:measurementUncertaintyUnivariateXMLList><si:expandedMUXMLList><si:valueExpandedMUXMLList>" + U +
                      "</si:valueExpandedMUXMLList><si:coverageFactorXMLList>2</si:coverageFactorXMLList>"
                      "<si:coverageProbabilityXMLList>0.95</si:coverageProbabilityXMLList></si:expandedMUXMLList>"
                      "</si:measurementUncertaintyUnivariateXMLList>") +
           "</si:realListXMLList>" +
           (status.empty()
                ? ""
                : "<dcc:influenceConditions><dcc:influenceCondition><dcc:name><dcc:content>stage</dcc:content>"
                  "</dcc:name><dcc:status>" +
                      status +
                      "</dcc:status><dcc:data><dcc:text><dcc:content>stage</dcc:content></dcc:text></dcc:data>"
                      "</dcc:influenceCondition></dcc:influenceConditions>") +
           "</dcc:quantity>";
}

ImportedJob import_list(const std::string& quantities) {
    std::string bytes = certificate_with("");
    const std::string begin = "<dcc:data>";
    const std::string end = "</dcc:data></dcc:result>";
    const std::size_t from = bytes.find(begin) + begin.size();
    bytes.replace(from, bytes.find(end) - from, "<dcc:list>" + quantities + "</dcc:list>");
    return import_standard(bytes, "certificate.xml", "STD-2");
}

// Without nominal values nothing can be used "at" a value, nor interpolated.
TEST(ImportStandard, RowsOfATableAreLinesOfOneQuantity) {
    for (const std::string type : {"basic_nominalValue", "basic_nominalValue gumcert_p_n", "basic_referenceValue"}) {
        for (const bool is_celsius : {true, false}) {
            const std::string unit = is_celsius ? "\\degreecelsius" : "\\kelvin";
            const ImportedJob imported =
                import_list(list_of(type, "0 50 100", unit, "") +
                            list_of("basic_measurementError", "0.1 0.2 0.3", "\\kelvin", "0.01 0.02 0.03"));
            const nlohmann::json lines = nlohmann::json::parse(imported.job)["calibrations"][0]["results"];
            ASSERT_EQ(lines.size(), 3U) << type;
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_EQ(lines[i]["quantity"], lines[0]["quantity"]);
                EXPECT_EQ(lines[i]["nominal"], 50.0 * static_cast<double>(i));
                EXPECT_EQ(lines[i].value("nominal_unit", ""), is_celsius ? "degC" : "");
                EXPECT_NEAR(lines[i]["U"].get<double>(), 0.01 * static_cast<double>(i + 1), 1e-12);
            }
        }
    }
    const ImportedJob twice =
        import_list(list_of("basic_nominalValue", "0 50 50", "\\kelvin", "") +
                    list_of("basic_measurementError", "0.1 0.2 0.3", "\\kelvin", "0.01 0.02 0.03"));
    const nlohmann::json lines = nlohmann::json::parse(twice.job)["calibrations"][0]["results"];
    EXPECT_NE(lines[1]["quantity"], lines[2]["quantity"]) << "nominal values do not tell the rows apart";
}

// A use at 5 V finds the line at 5 V, and none at 5.00005 V: that these are references is told. Remarks on the inputs of a job
// are not made beside a file of the register.
TEST(ImportStandard, NominalValuesGoBeforeReferences) {
    const std::string reference = list_of("basic_referenceValue", "5.00005 10.0003", "\\volt", "");
    const std::string error = list_of("basic_measurementError", "0.1 0.2", "\\volt", "0.01 0.02");
    const auto codes = [](const ImportedJob& imported) {
        std::vector<std::string> all;
        for (const gum::Diagnostic& remark : imported.remarks) {
            all.push_back(remark.code);
        }
        return all;
    };
    const auto nominal = [](const ImportedJob& imported) {
        return nlohmann::json::parse(imported.job)["calibrations"][0]["results"][0]["nominal"].get<double>();
    };
    const ImportedJob both = import_list(reference + error + list_of("basic_nominalValue", "5 10", "\\volt", ""));
    EXPECT_EQ(nominal(both), 5.0);
    EXPECT_THAT(codes(both), testing::Not(testing::Contains("GC-LAB-0023")));
    EXPECT_THAT(codes(both), testing::Not(testing::Contains("GC-DCC-0032")));
    const ImportedJob alone = import_list(reference + error);
    EXPECT_EQ(nominal(alone), 5.00005);
    const auto told = std::find_if(alone.remarks.begin(), alone.remarks.end(),
                                   [](const gum::Diagnostic& remark) { return remark.code == "GC-LAB-0023"; });
    ASSERT_NE(told, alone.remarks.end());
    EXPECT_THAT(told->what, testing::HasSubstr("5.00005 V, 10.0003 V"));
    EXPECT_EQ(alone.remarks.back().code, "GC-LAB-0020");
}

// Ten frequencies at one acceleration: the nominal value says nothing of a row, the frequency does.
TEST(ImportStandard, WhatWasSetTellsRowsOfOneNominalValueApart) {
    const auto lines = [](const std::string& stated, const std::string& set, const std::string& before = "") {
        return nlohmann::json::parse(
            import_list((stated.empty() ? "" : list_of("basic_referenceValue", stated, "\\metre", "")) + before +
                        list_of("gumcert_setting gumcert_f", set, "\\hertz", "") +
                        list_of("basic_measuredValue", "1.1 1.2 1.3", "\\volt", "0.01 0.02 0.03"))
                .job)["calibrations"][0]["results"];
    };
    for (const std::string stated : {"", "100 100 100"}) {
        const nlohmann::json by_frequency = lines(stated, "10 40 160");
        ASSERT_EQ(by_frequency.size(), 3U);
        EXPECT_EQ(by_frequency[1]["nominal"], 40);
        EXPECT_EQ(by_frequency[1]["nominal_unit"], "Hz");
        EXPECT_EQ(by_frequency[0]["quantity"], by_frequency[2]["quantity"]);
    }
    const std::string warm = list_of("gumcert_setting gumcert_T", "296.15 296.15 296.15", "\\kelvin", "");
    EXPECT_EQ(lines("100 100 100", "10 40 160", warm)[1]["nominal"], 40) << "a setting that never changes says nothing";
    EXPECT_EQ(lines("1 2 3", "10 40 160")[1]["nominal"], 2) << "the reference tells them apart";
    EXPECT_EQ(lines("1 1 3", "10 40 160")[1]["nominal"], 1) << "a table of two quantities";
    EXPECT_EQ(lines("100 100 100", "10 40 40")[1]["nominal"], 100) << "nothing tells them apart";
}

/// A result with one table of errors at nominal values.
std::string result_of(const std::string& heading, const std::string& quantities) {
    return "<dcc:result><dcc:name><dcc:content lang='en'>" + heading + "</dcc:content></dcc:name><dcc:data><dcc:list>" +
           quantities + "</dcc:list></dcc:data></dcc:result>";
}

nlohmann::json lines_of_results(const std::string& results) {
    std::string bytes = certificate_with("");
    const std::string begin = "<dcc:results>";
    const std::size_t from = bytes.find(begin) + begin.size();
    bytes.replace(from, bytes.find("</dcc:results>") - from, results);
    return nlohmann::json::parse(import_standard(bytes, "certificate.xml", "STD-2").job)["calibrations"][0]["results"];
}

// A table of one row has no number in the names of its quantities, and fell together with a table of several rows.
TEST(ImportStandard, RangesAreQuantitiesOfTheirOwn) {
    const std::string type = "basic_measurementError";
    const auto range = [&](const std::string& name, const std::string& nominal, const std::string& U) {
        return result_of("Voltage. Range: " + name,
                         list_of("basic_nominalValue", nominal, "\\volt", "") + list_of(type, nominal, "\\volt", U));
    };
    const nlohmann::json lines = lines_of_results(range("10 V", "1 5 10", "0.1 0.1 0.1") +
                                                  range("100 V", "10 50", "0.2 0.2") + range("1000 V", "700", "0.3"));
    ASSERT_EQ(lines.size(), 6U);
    for (const std::size_t i : {0U, 1U, 2U}) {
        EXPECT_EQ(lines[i]["quantity"], "voltage_range_10_v_basic_measurementerror");
        EXPECT_EQ(lines[i]["range"], "Voltage. Range: 10 V");
    }
    EXPECT_EQ(lines[3]["quantity"], lines[4]["quantity"]);
    EXPECT_EQ(lines[3]["range"], "Voltage. Range: 100 V");
    EXPECT_EQ(lines[5]["quantity"], "voltage_range_1000_v_basic_measurementerror");
    EXPECT_EQ(lines[5]["range"], "Voltage. Range: 1000 V");
}

TEST(ImportStandard, NoQuantityHoldsRowsOfTwoResults) {
    const std::vector<std::string> nominal{"7", "1 2", "1 2 3", "5 5"};  // the last does not tell its rows apart
    const std::vector<std::string> headings{"Range 1", "Range 2", "", "basic_e"};
    std::size_t value = 0;  // tells every line where it came from
    for (std::size_t made = 0; made < 256; ++made) {
        std::string results;
        std::vector<std::size_t> first;  // value of each result
        for (std::size_t r = 0, digits = made; r < 4; ++r, digits /= 4) {
            const std::string& at = nominal[digits % 4];
            std::string values, U;
            first.push_back(value);
            for (std::size_t row = 0; row < (at.size() + 1) / 2; ++row) {
                values += std::to_string(value++) + " ";
                U += "0.1 ";
            }
            const std::string symbol = r == 3 && made % 3 == 0 ? "basic_e_1" : "basic_e";
            results += result_of(
                headings[(r + made / 7) % 4 == 1 ? 0 : r],
                list_of("basic_nominalValue", at, "\\volt", "") +
                    list_of(symbol, values.substr(0, values.size() - 1), "\\volt", U.substr(0, U.size() - 1)));
        }
        std::map<std::string, std::set<std::size_t>> results_of_quantity;
        for (const nlohmann::json& line : lines_of_results(results)) {
            const auto from = std::upper_bound(first.begin(), first.end(), line["value"].get<std::size_t>());
            results_of_quantity[line["quantity"]].insert(static_cast<std::size_t>(from - first.begin()));
        }
        for (const auto& [quantity, of] : results_of_quantity) {
            EXPECT_EQ(of.size(), 1U) << quantity << " of " << results;
        }
    }
}

/// Who relies on the accreditation of an issuer has to know what it does not cover.
TEST(ImportStandard, ValuesOutsideOfTheAccreditationAreTold) {
    const auto told = [](const std::string& type, const std::string& flags) {
        std::string list = list_of("e", "0.1 0.2", "\\kelvin", "0.01 0.02");
        list.insert(list.find("</dcc:quantity>"), "<dcc:measurementMetaData><dcc:metaData refType='" + type + "'>" +
                                                      flags + "</dcc:metaData></dcc:measurementMetaData>");
        std::string what;
        for (const gum::Diagnostic& remark : import_list(list).remarks) {
            what += remark.code == "GC-DCC-0035" ? remark.what : "";
        }
        return what;
    };
    const auto flags = [](const std::string& words) { return "<dcc:validXMLList>" + words + "</dcc:validXMLList>"; };
    EXPECT_THAT(told("basic_isInCMC", flags("true false")),
                testing::AllOf(testing::StartsWith("1 input is outside"), testing::EndsWith("_2")));
    EXPECT_THAT(told("other basic_isInCMC", flags("0")), testing::StartsWith("2 inputs are outside"));
    EXPECT_THAT(told("basic_isInCMC", "<dcc:valid>false</dcc:valid>"), testing::StartsWith("2 inputs are outside"));
    EXPECT_EQ(told("basic_isInCMC", flags("true")), "");
    EXPECT_EQ(told("other", flags("false")), "");
}

TEST(ImportStandard, ResultsBeforeAnAdjustmentAreNoValuesOfTheStandard) {
    const std::string nominal = list_of("basic_nominalValue", "0 50", "\\kelvin", "");
    const ImportedJob imported =
        import_list(nominal + list_of("e_f", "0.5 0.6", "\\kelvin", "0.01 0.02", "beforeAdjustment") +
                    list_of("e_l", "0.1 0.2", "\\kelvin", "0.01 0.02", "afterAdjustment"));
    const nlohmann::json lines = nlohmann::json::parse(imported.job)["calibrations"][0]["results"];
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0]["value"], 0.1);
    EXPECT_THAT(imported.remarks, testing::Contains(testing::Field(&gum::Diagnostic::code, "GC-LAB-0022")));
    // Where there is no nominal value, that of the reference is taken: the one beside the result.
    const std::string type = "basic_referenceValue";
    const ImportedJob by_reference =
        import_list(list_of(type + " gumcert_f", "1 51", "\\kelvin", "", "beforeAdjustment") +
                    list_of(type + " gumcert_l", "2 52", "\\kelvin", "", "afterAdjustment") +
                    list_of("e_l", "0.1 0.2", "\\kelvin", "0.01 0.02", "afterAdjustment"));
    EXPECT_EQ(nlohmann::json::parse(by_reference.job)["calibrations"][0]["results"][0]["nominal"], 2);
    EXPECT_THROW((void)import_list(nominal + list_of("e_f", "0.5 0.6", "\\kelvin", "0.01 0.02", "beforeAdjustment")),
                 gum::InputError);
}

// A torque wrench that was set to 10 N m: what the reference showed before the adjustment is not where it was measured after it.
TEST(ImportStandard, AReferenceOfBeforeAnAdjustmentIsNoPlaceOfAValueAfterIt) {
    const std::string found = list_of("basic_referenceValue", "10.31 51.4", "\\newton\\metre", "", "beforeAdjustment");
    const std::string left = list_of("basic_referenceValue", "10.02 50.07", "\\newton\\metre", "", "afterAdjustment");
    const std::string set = list_of("gumcert_setting", "10 50", "\\newton\\metre", "");
    const std::string errors = list_of("e_f", "-3.0 -2.7", "\\percent", "0.5 0.5", "beforeAdjustment") +
                               list_of("e_l", "-0.2 -0.1", "\\percent", "0.5 0.3", "afterAdjustment");
    const auto nominal_values = [&](const std::string& columns) {
        std::vector<double> values;
        const nlohmann::json job = nlohmann::json::parse(import_list(columns + errors).job);
        for (const nlohmann::json& line : job["calibrations"][0]["results"]) {
            values.push_back(line.value("nominal", 0.0));
        }
        return values;
    };
    EXPECT_THAT(nominal_values(set + found + left), testing::ElementsAre(10.02, 50.07));
    EXPECT_THAT(nominal_values(set + left + found), testing::ElementsAre(10.02, 50.07));
    EXPECT_THAT(nominal_values(found + set), testing::ElementsAre(10.0, 50.0))
        << "what was set, where nothing else is its own";
    EXPECT_THAT(nominal_values(list_of("basic_referenceValue", "9 49", "\\newton\\metre", "") + found),
                testing::ElementsAre(9.0, 49.0))
        << "one that has no stage is that of both";
}

}  // namespace
}  // namespace gumcert::imports
