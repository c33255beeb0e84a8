#include "reports/dcc/dcc_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "reports/dcc/dcc_element.h"
#include "tests/unit/reports/dcc/dcc_samples.h"

namespace gumcert::reports {
namespace {

using test::content_of;
using test::shared_dcc;

/// A certificate of version 3.3.0 with these quantities in its one result.
std::string with_quantities(const std::string& quantities) {
    return "<dcc:digitalCalibrationCertificate xmlns:dcc='https://ptb.de/dcc' xmlns:si='https://ptb.de/si' "
           "schemaVersion='3.3.0'><dcc:administrativeData><dcc:coreData><dcc:uniqueIdentifier>EX-1</"
           "dcc:uniqueIdentifier>"
           "</dcc:coreData></dcc:administrativeData><dcc:measurementResults><dcc:measurementResult><dcc:results>"
           "<dcc:result><dcc:name><dcc:content lang='de'>Länge</dcc:content><dcc:content lang='en'>Length</dcc:content>"
           "</dcc:name><dcc:data><dcc:list>" +
           quantities +
           "</dcc:list></dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>"
           "</dcc:digitalCalibrationCertificate>";
}

std::string quantity(const std::string& content) {
    return "<dcc:quantity refType='basic_measuredValue'>" + content + "</dcc:quantity>";
}

ImportedQuantity only_quantity(const std::string& content) {
    const ImportedCertificate c = read_dcc(with_quantities(quantity(content)), "file.xml");
    EXPECT_EQ(c.quantities.size(), 1U);
    return c.quantities.empty() ? ImportedQuantity() : c.quantities.front();
}

/// Kind, numbers and distribution on one line.
std::string summary(const ImportedNumber& n) {
    std::string text = n.value + " " + n.unit + " " + n.kind;
    for (const auto& [name, value] :
         {std::pair{"U", n.U}, {"k", n.k}, {"p", n.p}, {"u", n.u}, {"low", n.low}, {"high", n.high}}) {
        text += value.empty() ? "" : std::string(" ") + name + "=" + value;
    }
    return text + (n.distribution.empty() ? "" : " " + n.distribution);
}

TEST(DccReader, ReadsUncertaintiesInEverySpelling) {
    const std::string real = "<si:value>1.50</si:value><si:unit>\\milli\\metre</si:unit>";
    EXPECT_EQ(summary(only_quantity("<si:real>" + real + "</si:real>")), "1.50 mm none");
    EXPECT_EQ(
        summary(only_quantity("<si:real>" + real +
                              "<si:measurementUncertaintyUnivariate><si:expandedMU>"
                              "<si:valueExpandedMU>0.020</si:valueExpandedMU><si:coverageFactor>2.0</si:coverageFactor>"
                              "<si:coverageProbability>0.95</si:coverageProbability>"
                              "<si:distribution>normal</si:distribution></si:expandedMU>"
                              "</si:measurementUncertaintyUnivariate></si:real>")),
        "1.50 mm expanded U=0.020 k=2.0 p=0.95 normal");
    EXPECT_EQ(
        summary(only_quantity("<si:real>" + real +
                              "<si:expandedUnc><si:uncertainty>0.020</si:uncertainty>"
                              "<si:coverageFactor>2.0</si:coverageFactor>"
                              "<si:coverageProbability>0.95</si:coverageProbability></si:expandedUnc></si:real>")),
        "1.50 mm expanded U=0.020 k=2.0 p=0.95");
    EXPECT_EQ(
        summary(only_quantity("<si:real>" + real +
                              "<si:measurementUncertaintyUnivariate><si:standardMU><si:valueStandardMU>0.010"
                              "</si:valueStandardMU></si:standardMU></si:measurementUncertaintyUnivariate></si:real>")),
        "1.50 mm standard u=0.010");
    EXPECT_EQ(
        summary(only_quantity("<si:real>" + real +
                              "<si:measurementUncertaintyUnivariate><si:coverageIntervalMU>"
                              "<si:valueStandardMU>0.010</si:valueStandardMU><si:intervalMin>1.47</si:intervalMin>"
                              "<si:intervalMax>1.51</si:intervalMax><si:coverageProbability>0.95"
                              "</si:coverageProbability></si:coverageIntervalMU>"
                              "</si:measurementUncertaintyUnivariate></si:real>")),
        "1.50 mm coverage_interval p=0.95 u=0.010 low=1.47 high=1.51");
    EXPECT_EQ(summary(only_quantity("<si:real>" + real +
                                    "<si:coverageInterval><si:standardUnc>0.010</si:standardUnc><si:intervalMin>1.47"
                                    "</si:intervalMin><si:intervalMax>1.51</si:intervalMax><si:coverageProbability>0.95"
                                    "</si:coverageProbability></si:coverageInterval></si:real>")),
              "1.50 mm coverage_interval p=0.95 u=0.010 low=1.47 high=1.51");
    EXPECT_EQ(summary(only_quantity("<si:constant>" + real + "<si:uncertainty>0.010</si:uncertainty></si:constant>")),
              "1.50 mm standard u=0.010");
    EXPECT_EQ(
        summary(only_quantity("<si:constant>" + real + "<si:valueStandardMU>0.010</si:valueStandardMU></si:constant>")),
        "1.50 mm standard u=0.010");
    // D-SI 2.2 misspells the element inside of si:realList.
    EXPECT_EQ(summary(only_quantity("<si:list><si:realList><si:listUnit>\\metre</si:listUnit><si:real>"
                                    "<si:value>1</si:value><si:measurementUncertaintyUnivaraite><si:standardMU>"
                                    "<si:valueStandardMU>0.1</si:valueStandardMU></si:standardMU>"
                                    "</si:measurementUncertaintyUnivaraite></si:real></si:realList></si:list>")),
              "1 m standard u=0.1");
}

TEST(DccReader, ReadsListsWithOneEntryForAllRowsOrOneForEach) {
    const ImportedCertificate c =
        read_dcc(with_quantities(quantity(
                     "<si:realListXMLList><si:valueXMLList>1.0 2.0 3.0</si:valueXMLList>"
                     "<si:unitXMLList>\\volt</si:unitXMLList><si:measurementUncertaintyUnivariateXMLList>"
                     "<si:expandedMUXMLList><si:valueExpandedMUXMLList>0.1 0.2 NaN</si:valueExpandedMUXMLList>"
                     "<si:coverageFactorXMLList>2 2 NaN</si:coverageFactorXMLList><si:coverageProbabilityXMLList>0.95"
                     "</si:coverageProbabilityXMLList></si:expandedMUXMLList>"
                     "</si:measurementUncertaintyUnivariateXMLList></si:realListXMLList>")),
                 "file.xml");
    ASSERT_EQ(c.quantities.size(), 3U);
    EXPECT_EQ(summary(c.quantities[0]), "1.0 V expanded U=0.1 k=2 p=0.95");
    EXPECT_EQ(summary(c.quantities[1]), "2.0 V expanded U=0.2 k=2 p=0.95");
    EXPECT_EQ(summary(c.quantities[2]), "3.0 V none p=0.95");
    EXPECT_EQ(c.quantities[1].name, "measured_value_2");
    EXPECT_EQ(c.quantities[1].row, 1U);
    EXPECT_EQ(c.quantities[1].result, "Länge");
    EXPECT_EQ(c.quantities[1].ref_type, "basic_measuredValue");
    EXPECT_TRUE(c.remarks.empty());
}

TEST(DccReader, RemarksWhatItCannotCarryOver) {
    const ImportedCertificate c =
        read_dcc(with_quantities(quantity("<si:realListXMLList><si:valueXMLList>1 2 3</si:valueXMLList>"
                                          "<si:unitXMLList>|quux</si:unitXMLList><si:expandedUncXMLList>"
                                          "<si:uncertaintyXMLList>0.1 0.2</si:uncertaintyXMLList>"
                                          "<si:coverageFactorXMLList>2</si:coverageFactorXMLList>"
                                          "</si:expandedUncXMLList></si:realListXMLList>") +
                                 quantity("<si:complex><si:valueReal>1</si:valueReal><si:valueImag>2</si:valueImag>"
                                          "<si:unit>\\ohm</si:unit></si:complex>")),
                 "file.xml");
    std::set<std::string> codes;
    for (const gum::Diagnostic& d : c.remarks) {
        codes.insert(d.code);
    }
    EXPECT_EQ(codes, (std::set<std::string>{"GC-DCC-0020", "GC-DCC-0021", "GC-DCC-0022"}));
    ASSERT_EQ(c.quantities.size(), 5U);
    EXPECT_EQ(c.quantities[0].unit, "");
    EXPECT_EQ(c.quantities[0].kind, "none");
    EXPECT_EQ(c.quantities[4].value, "2");
}

TEST(DccReader, NamesEveryQuantityDifferently) {
    const std::string real = "<si:real><si:value>1</si:value><si:unit>\\one</si:unit></si:real>";
    const ImportedCertificate c = read_dcc(with_quantities(quantity(real) + quantity(real) + quantity(real)), "f");
    std::set<std::string> names;
    for (const ImportedQuantity& q : c.quantities) {
        names.insert(q.name);
    }
    EXPECT_EQ(names, (std::set<std::string>{"measured_value", "length_measured_value", "length_measured_value_v2"}));
}

/// U whose factors cannot be told apart is no uncertainty, not one with a factor taken from p.
TEST(DccReader, LeavesOutAnUncertaintyWhoseListsDoNotFit) {
    const auto read = [](const std::string& U, const std::string& k, const std::string& p, const std::string& unit) {
        return read_dcc(with_quantities(quantity(
                            "<si:realListXMLList><si:valueXMLList>1 2 3</si:valueXMLList><si:unitXMLList>" + unit +
                            "</si:unitXMLList><si:measurementUncertaintyUnivariateXMLList>"
                            "<si:expandedMUXMLList><si:valueExpandedMUXMLList>" +
                            U + "</si:valueExpandedMUXMLList><si:coverageFactorXMLList>" + k +
                            "</si:coverageFactorXMLList><si:coverageProbabilityXMLList>" + p +
                            "</si:coverageProbabilityXMLList></si:expandedMUXMLList>"
                            "</si:measurementUncertaintyUnivariateXMLList></si:realListXMLList>")),
                        "file.xml");
    };
    for (const ImportedCertificate& c :
         {read("0.1 0.2", "2", "0.95", "\\metre"), read("0.1", "2 3", "0.95", "\\metre")}) {
        ASSERT_EQ(c.quantities.size(), 3U);
        EXPECT_EQ(summary(c.quantities[1]), "2 m none");
        ASSERT_EQ(c.remarks.size(), 1U);
        EXPECT_EQ(c.remarks[0].code, "GC-DCC-0022");
    }
    // Without the probabilities U and k are still whole; without the units the numbers have none.
    EXPECT_EQ(summary(read("0.1", "2", "0.95 0.9", "\\metre").quantities.at(1)), "2 m expanded U=0.1 k=2");
    const ImportedCertificate units = read("0.1", "2", "0.95", "\\metre \\volt");
    EXPECT_EQ(units.quantities.at(1).unit, "");
    ASSERT_EQ(units.remarks.size(), 1U);
    EXPECT_EQ(units.remarks[0].code, "GC-DCC-0022");
}

TEST(DccReader, NamesResultsByTheirSymbol) {
    const auto list = [](const std::string& label) {
        return quantity("<si:realListXMLList><si:labelXMLList>" + label +
                        "</si:labelXMLList><si:valueXMLList>1 2</si:valueXMLList><si:unitXMLList>\\metre"
                        "</si:unitXMLList><si:measurementUncertaintyUnivariateXMLList><si:standardMUXMLList>"
                        "<si:valueStandardMUXMLList>0.1</si:valueStandardMUXMLList></si:standardMUXMLList>"
                        "</si:measurementUncertaintyUnivariateXMLList></si:realListXMLList>");
    };
    const ImportedCertificate c = read_dcc(
        with_quantities(list("E_A,1") + list("1st") +
                        "<dcc:quantity><dcc:name><dcc:content>Point</dcc:content></dcc:name><dcc:charsXMLList>low "
                        "high</dcc:charsXMLList></dcc:quantity>"),
        "f");
    ASSERT_EQ(c.quantities.size(), 4U);
    EXPECT_EQ(c.quantities[1].name, "E_A_1_2");
    EXPECT_EQ(c.quantities[1].label, "E_A,1");
    EXPECT_EQ(c.quantities[3].name, "measured_value_2");  // no name begins with a digit
    EXPECT_EQ(c.quantities[3].table, c.quantities[1].table);
    EXPECT_GT(c.quantities[1].table, 0U);
    ASSERT_EQ(c.words.size(), 1U);
    EXPECT_EQ(c.words[0].table, c.quantities[1].table);
    EXPECT_EQ(c.words[0].quantity, "Point");
    EXPECT_EQ(c.words[0].words, (std::vector<std::string>{"low", "high"}));
}

TEST(DccReader, RefusesOtherDocumentsAndVersions) {
    const auto code = [](const std::string& xml) {
        try {
            (void)read_dcc(xml, "file.xml");
        } catch (const gum::InputError& error) {
            return error.diagnostics().front().code;
        }
        return std::string("accepted");
    };
    EXPECT_EQ(code("<a/>"), "GC-DCC-0005");
    EXPECT_EQ(code("<digitalCalibrationCertificate schemaVersion='3.3.0'/>"), "GC-DCC-0005");  // without its namespace
    const std::string root = "<digitalCalibrationCertificate xmlns='https://ptb.de/dcc' schemaVersion='";
    EXPECT_EQ(code(root + "2.4.0'/>"), "GC-DCC-0006");
    EXPECT_EQ(code(root + "4.0.0'/>"), "GC-DCC-0006");
    EXPECT_EQ(code(root + "3.1.2'/>"), "accepted");
    EXPECT_EQ(code("<!DOCTYPE x>" + root + "3.3.0'/>"), "GC-DCC-0002");
}

TEST(DccReader, LosesNoNumberOfThePublishedExamples) {
    if (!std::filesystem::exists(shared_dcc())) {
        GTEST_SKIP() << "the folder of examples is not there";
    }
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shared_dcc() / "examples")) {
        if (entry.path().extension() != ".xml") {
            continue;
        }
        ++files;
        const std::string file = entry.path().filename().string();
        const std::string bytes = content_of(entry.path());
        const ParsedDcc document = parse_dcc(bytes, file);
        const ImportedCertificate& c = document.certificate;
        EXPECT_EQ(document.bytes, bytes);
        EXPECT_EQ(read_dcc(bytes, file).sha256, c.sha256);
        std::multiset<std::string> imported;
        std::set<std::string> names;
        for (const ImportedQuantity& q : c.quantities) {
            EXPECT_TRUE(names.insert(q.name).second) << file << " " << q.name;
            EXPECT_NE(q.unit, "") << file << " " << q.name << " " << q.d_si_unit;
            imported.insert(q.value);
            for (const ImportedNumber& other : q.also) {
                imported.insert(other.value);
            }
        }
        std::multiset<std::string> values;
        for_each_element(document.root, [&](const XmlElement& e) {
            if (e.name.starts_with("si:value")) {
                for (const std::string& word : xml_list(e.text)) {
                    values.insert(word);
                }
            }
        });
        EXPECT_EQ(imported, values) << file;
        EXPECT_GT(values.size(), 20U) << file;
        EXPECT_TRUE(c.remarks.empty()) << file << " " << message(c.remarks.front());
    }
    EXPECT_EQ(files, 5);
}

TEST(DccReader, ReadsTheTemperatureExampleOfVersion330) {
    const std::filesystem::path file = shared_dcc() / "examples" / "dcclib_valid_3.3.0.xml";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "the folder of examples is not there";
    }
    const ImportedCertificate c = read_dcc(content_of(file), "file.xml");
    EXPECT_EQ(c.schema_version, "3.3.0");
    EXPECT_EQ(c.laboratory, "Kalibrierfirma GmbH");
    std::map<std::string, std::string> found;
    for (const ImportedQuantity& q : c.quantities) {
        found[q.name] = q.role + ": " + summary(q);
    }
    EXPECT_EQ(found["measurement_error_1"], "result: 0.072 K expanded U=0.061 k=2 p=0.95 normal");
    EXPECT_EQ(found["measurement_error_5"], "result: -0.084 K expanded U=0.061 k=2 p=0.95 normal");
    EXPECT_EQ(found["reference_value_3"], "result: 448.253 K none");
    const auto reference = std::find_if(c.quantities.begin(), c.quantities.end(),
                                        [](const ImportedQuantity& q) { return q.name == "reference_value_3"; });
    ASSERT_NE(reference, c.quantities.end());
    ASSERT_EQ(reference->also.size(), 1U);
    EXPECT_EQ(summary(reference->also[0]), "175.103 degC none");
    EXPECT_EQ(found["upper_acceptance_limit_4"], "meta_data: 0.30 K none");
    EXPECT_EQ(found["temperature_min"], "influence_condition: 293 K none");
}

TEST(DccReader, ReadsTheHumidityExampleOfVersion312) {
    const std::filesystem::path file = shared_dcc() / "examples" / "dcc_gp_humidity_v1.0.xml";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "the folder of examples is not there";
    }
    const ImportedCertificate c = read_dcc(content_of(file), "file.xml");
    EXPECT_EQ(c.schema_version, "3.1.2");
    EXPECT_EQ(c.identifier, "Id 123456789 HtW");
    EXPECT_EQ(c.sha256, "5d7211baa2e2215c2a0638bcf7391b90e645cf4d758273982343de153bebcec4");  // by sha256sum
    const std::array expected = {"-0.004 1 expanded U=0.006 k=2 p=0.95", "-0.001 1 expanded U=0.008 k=2 p=0.95",
                                 "0.003 1 expanded U=0.010 k=2 p=0.95",  "0.011 1 expanded U=0.011 k=2 p=0.95",
                                 "0.012 1 expanded U=0.010 k=2 p=0.95",  "0.006 1 expanded U=0.008 k=2 p=0.95",
                                 "-0.003 1 expanded U=0.006 k=2 p=0.95"};
    std::size_t row = 0;
    for (const ImportedQuantity& q : c.quantities) {
        if (q.kind == "expanded") {
            ASSERT_LT(row, expected.size());
            EXPECT_EQ(summary(q), expected.at(row));
            EXPECT_EQ(q.name, "measurement_error_" + std::to_string(row + 1));
            ++row;
        }
    }
    EXPECT_EQ(row, expected.size());
}

}  // namespace
}  // namespace gumcert::reports
