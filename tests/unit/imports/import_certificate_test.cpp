#include "imports/import_certificate.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "jobs/budget/budget_job.h"
#include "jobs/file_source.h"

namespace gumcert::imports {
namespace {

std::string with_quantities(const std::string& quantities) {
    return "<dcc:digitalCalibrationCertificate xmlns:dcc='https://ptb.de/dcc' xmlns:si='https://ptb.de/si' "
           "schemaVersion='3.3.0'><dcc:administrativeData><dcc:coreData><dcc:uniqueIdentifier>EX-1 \"a\""
           "</dcc:uniqueIdentifier><dcc:issueDate>2026-11-21</dcc:issueDate></dcc:coreData><dcc:calibrationLaboratory>"
           "<dcc:contact><dcc:name><dcc:content>Example Laboratory</dcc:content></dcc:name></dcc:contact>"
           "</dcc:calibrationLaboratory></dcc:administrativeData><dcc:measurementResults><dcc:measurementResult>"
           "<dcc:usedMethods>m</dcc:usedMethods><dcc:usedSoftware>s</dcc:usedSoftware>"
           "<dcc:influenceConditions>c</dcc:influenceConditions><dcc:results><dcc:result><dcc:data>" +
           quantities +
           "</dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>"
           "</dcc:digitalCalibrationCertificate>";
}

std::string quantity(const std::string& name, const std::string& value, const std::string& uncertainty,
                     const std::string& unit = "\\milli\\metre") {
    return "<dcc:quantity><dcc:name><dcc:content>" + name + "</dcc:content></dcc:name><si:real><si:value>" + value +
           "</si:value><si:unit>" + unit + "</si:unit>" + uncertainty + "</si:real></dcc:quantity>";
}

std::string expanded_value(const std::string& U, const std::string& k) {
    return "<si:measurementUncertaintyUnivariate><si:expandedMU><si:valueExpandedMU>" + U +
           "</si:valueExpandedMU><si:coverageFactor>" + k +
           "</si:coverageFactor><si:coverageProbability>0.95</si:coverageProbability></si:expandedMU>"
           "</si:measurementUncertaintyUnivariate>";
}

std::string standard(const std::string& u) {
    return "<si:measurementUncertaintyUnivariate><si:standardMU><si:valueStandardMU>" + u +
           "</si:valueStandardMU></si:standardMU></si:measurementUncertaintyUnivariate>";
}

/// Codes of what is said of the numbers; that a document breaks rules of its form is told once beside them.
std::vector<std::string> of_numbers(const std::vector<gum::Diagnostic>& remarks) {
    std::vector<std::string> all;
    for (const gum::Diagnostic& d : remarks) {
        all.push_back(d.code);
    }
    std::erase(all, "GC-DCC-0045");
    return all;
}

TEST(ImportCertificate, KnowsUnitsOutsideOfTheSiByTheirNames) {
    const ImportedJob imported =
        import_certificate(with_quantities(quantity("Speed", "1500.2", expanded_value("0.4", "2.0"), "|rpm") +
                                           quantity("Pressure", "10.01", expanded_value("0.02", "2.0"), "|psi")),
                           "certificate.xml");
    const nlohmann::json inputs = nlohmann::json::parse(imported.job)["inputs"];
    EXPECT_EQ(inputs["speed"]["unit"], "rpm");
    EXPECT_EQ(inputs["pressure"]["unit"], "psi");
}

TEST(ImportCertificate, MakesAJobOfWhatHasAnUncertainty) {
    const ImportedJob imported = import_certificate(
        with_quantities(quantity("Length", "1.50", expanded_value("0.020", "2.0")) + quantity("Nominal", "1.5", "") +
                        quantity("max", "+.250E1", standard("0.010"))),
        "a.xml");
    const nlohmann::json job = nlohmann::json::parse(imported.job);
    EXPECT_EQ(job["schema"], "gumcert/job/1");
    EXPECT_EQ(job["kind"], "budget");
    EXPECT_EQ(job["model"], nlohmann::json::array({"y = length"}));
    ASSERT_EQ(job["inputs"].size(), 2U);
    EXPECT_EQ(job["inputs"]["length"]["U"], 0.02);
    EXPECT_EQ(job["inputs"]["length"]["k"], 2.0);
    EXPECT_EQ(job["inputs"]["length"]["unit"], "mm");
    EXPECT_EQ(job["inputs"]["max_value"]["value"], 2.5);  // max is a function
    EXPECT_EQ(job["inputs"]["max_value"]["u"], 0.01);
    const std::string source = job["inputs"]["length"]["source"];
    EXPECT_TRUE(source.starts_with("certificate EX-1 \"a\", Example Laboratory, SHA-256 ")) << source;
    EXPECT_NE(imported.job.find("\"value\": 1.50, \"U\": 0.020, \"k\": 2.0"), std::string::npos);  // its own digits
    EXPECT_EQ(of_numbers(imported.remarks),
              (std::vector<std::string>{"GC-DCC-0034", "GC-DCC-0032"}));  // without Nominal
}

TEST(ImportCertificate, MakesAJobThatIsReadWhateverTheCertificateIsCalled) {
    const std::string document = with_quantities(quantity("Length", "1.50", expanded_value("0.020", "2.0")));
    const std::string identifier = "EX-1 \"a\"";
    const std::string laboratory = "Example Laboratory";
    for (const std::string& other :
         {std::string(), std::string("EX-1\u00A0"), std::string(5000, 'x'), std::string("EX\u202E1 \u3000"),
          std::string("\U0001F600") + std::string(400, 'y')}) {
        std::string named = document;
        named.replace(named.find(identifier), identifier.size(), other);
        named.replace(named.find(laboratory), laboratory.size(), other);
        const jobs::MemoryFileSource files({{"job.json", import_certificate(named, "a.xml").job}});
        EXPECT_NO_THROW((void)jobs::read_budget_job(files, "job.json")) << other;
    }
}

TEST(ImportCertificate, LeavesOutWhatABudgetCannotHold) {
    const ImportedJob imported = import_certificate(
        with_quantities(quantity("a", "1", standard("1e200")) + quantity("b", "1", expanded_value("1e-139", "1e9")) +
                        quantity("c", "1", standard("0.1"))),
        "a.xml");
    EXPECT_EQ(nlohmann::json::parse(imported.job)["inputs"].size(), 1U);
    EXPECT_EQ(of_numbers(imported.remarks), (std::vector<std::string>{"GC-DCC-0031", "GC-DCC-0031"}));
    const jobs::MemoryFileSource files({{"job.json", imported.job}});
    EXPECT_NO_THROW((void)jobs::read_budget_job(files, "job.json"));
}

TEST(ImportCertificate, LeavesOutWhatCannotBeAnInput) {
    const ImportedJob imported = import_certificate(
        with_quantities(quantity("a", "NaN", expanded_value("0.1", "2")) +
                        quantity("b", "1", expanded_value("0.1", "2"), "|quux") +
                        quantity("c", "1", expanded_value("0", "2")) + quantity("d", "1", standard("NaN"))),
        "a.xml");
    const nlohmann::json job = nlohmann::json::parse(imported.job);
    ASSERT_EQ(job["inputs"].size(), 1U);
    EXPECT_EQ(job["inputs"]["c"]["constant"], true);
    EXPECT_EQ(of_numbers(imported.remarks),
              (std::vector<std::string>{"GC-DCC-0021", "GC-DCC-0031", "GC-DCC-0031", "GC-DCC-0031", "GC-DCC-0031"}));
}

/// What the reader of jobs would refuse is left out at the import, with the reason.
TEST(ImportCertificate, LeavesOutFactorsAndProbabilitiesThatAreNone) {
    const auto without_k = [](const std::string& p) {
        return "<si:measurementUncertaintyUnivariate><si:expandedMU><si:valueExpandedMU>0.1</si:valueExpandedMU>"
               "<si:coverageFactor>NaN</si:coverageFactor><si:coverageProbability>" +
               p + "</si:coverageProbability></si:expandedMU></si:measurementUncertaintyUnivariate>";
    };
    for (const std::string& uncertainty :
         {expanded_value("0.1", "0"), expanded_value("0.1", "-2"), expanded_value("-0.1", "2"),
          expanded_value("1e400", "2"), without_k("95"), without_k("0"), without_k("1"), without_k("NaN"),
          standard("-1"), standard("1e-400")}) {
        const ImportedJob imported = import_certificate(
            with_quantities(quantity("good", "1", expanded_value("0.1", "2")) + quantity("bad", "1", uncertainty)),
            "a.xml");
        const nlohmann::json job = nlohmann::json::parse(imported.job);
        EXPECT_EQ(job["inputs"].size(), 1U) << uncertainty;
        EXPECT_EQ(of_numbers(imported.remarks), std::vector<std::string>{"GC-DCC-0031"}) << uncertainty;
    }
    // U without k is taken, with the factor of a normal distribution, and told.
    const ImportedJob imported = import_certificate(with_quantities(quantity("a", "1", without_k("0.95"))), "a.xml");
    EXPECT_EQ(nlohmann::json::parse(imported.job)["inputs"]["a"]["p"], 0.95);
    EXPECT_EQ(of_numbers(imported.remarks), std::vector<std::string>{"GC-DCC-0031"});
    EXPECT_THROW((void)import_certificate(with_quantities(quantity("a", "1e-400", standard("1"))), "a.xml"),
                 gum::InputError);
}

std::string column(const std::string& name, const std::string& values, const std::string& unit, const std::string& U,
                   const std::string& ref_type = "basic_measuredValue", const std::string& label = "") {
    return "<dcc:quantity refType='" + ref_type + "'><dcc:name><dcc:content>" + name +
           "</dcc:content></dcc:name><si:realListXMLList>" +
           (label.empty() ? "" : "<si:labelXMLList>" + label + "</si:labelXMLList>") + "<si:valueXMLList>" + values +
           "</si:valueXMLList><si:unitXMLList>" + unit + "</si:unitXMLList>" +
           (U.empty() ? ""
                      : "<si:expandedUncXMLList><si:uncertaintyXMLList>" + U +
                            "</si:uncertaintyXMLList><si:coverageFactorXMLList>2</si:coverageFactorXMLList>"
                            "<si:coverageProbabilityXMLList>0.95</si:coverageProbabilityXMLList>"
                            "<si:distributionXMLList>student_t</si:distributionXMLList></si:expandedUncXMLList>") +
           "</si:realListXMLList></dcc:quantity>";
}

/// A number says what it is about where the certificate has several items, such as the pieces of a set.
TEST(ImportCertificate, NamesTheItemOfANumber) {
    const auto item = [](const std::string& id, const std::string& name, const std::string& number) {
        return "<dcc:item id='" + id + "'><dcc:name><dcc:content>" + name +
               "</dcc:content></dcc:name><dcc:identifications><dcc:identification><dcc:issuer>manufacturer</dcc:issuer>"
               "<dcc:value>" +
               number + "</dcc:value></dcc:identification></dcc:identifications></dcc:item>";
    };
    const auto descriptions = [&](const std::string& items, const std::string& refs) {
        std::string document = with_quantities("<dcc:list refId='" + refs + "'>" +
                                               column("Length", "0.5 1.0", "\\metre", "0.02") + "</dcc:list>");
        document.insert(document.find("</dcc:administrativeData>"), "<dcc:items>" + items + "</dcc:items>");
        const nlohmann::json inputs = nlohmann::json::parse(import_certificate(document, "a.xml").job)["inputs"];
        std::vector<std::string> all;
        for (const auto& input : inputs) {
            all.push_back(input["description"]);
        }
        return all;
    };
    const std::string block = item("a", "Block", "40210");
    const std::string other = item("b", "Weight", "7");
    EXPECT_EQ(descriptions(block + other, "a b"),
              (std::vector<std::string>{"Length, row 1 (Block, 40210)", "Length, row 2 (Weight, 7)"}));
    EXPECT_EQ(descriptions(block + other, "b"),
              (std::vector<std::string>{"Length, row 1 (Weight, 7)", "Length, row 2 (Weight, 7)"}));
    const std::vector<std::string> nothing{"Length, row 1", "Length, row 2"};
    EXPECT_EQ(descriptions(block + other, "a b a"), nothing) << "neither one nor one a row";
    EXPECT_EQ(descriptions(block + other, "a c"), nothing) << "no item of that id";
    EXPECT_EQ(descriptions(block, "a"), nothing) << "everything is about the one item";
}

/// A row of a table says where it was measured; degrees of freedom of our own certificates belong to U.
TEST(ImportCertificate, CarriesTheRowOfATable) {
    ImportedJob imported = import_certificate(
        with_quantities("<dcc:list>" + column("Reference value", "33.098 99.971", "\\degreecelsius", "") +
                        "<dcc:quantity><dcc:name><dcc:content>Point</dcc:content></dcc:name><dcc:charsXMLList>low high"
                        "</dcc:charsXMLList></dcc:quantity>" +
                        column("Error", "0.072 0.089", "\\kelvin", "0.061", "basic_measurementError", "E") +
                        column("nu", "NaN 12.5", "\\one", "", "gumcert_effectiveDegreesOfFreedom", "E") +
                        "</dcc:list><dcc:list>" + column("Elsewhere", "7 8", "\\metre", "") + "</dcc:list>"),
        "a.xml");
    const nlohmann::json inputs = nlohmann::json::parse(imported.job)["inputs"];
    ASSERT_EQ(inputs.size(), 2U) << imported.job;
    EXPECT_EQ(inputs["E_2"]["description"], "Error, row 2 (Point high, Reference value 99.971 degC)");
    EXPECT_EQ(inputs["E_2"]["nu"], 12.5);
    EXPECT_FALSE(inputs["E_1"].contains("nu"));
    // The sample has no more of a certificate than its results.
    std::erase_if(imported.remarks, [](const gum::Diagnostic& d) { return d.code == "GC-DCC-0045"; });
    // One of them has a t-distribution without degrees of freedom; two numbers stand beside no input.
    EXPECT_EQ(of_numbers(imported.remarks), (std::vector<std::string>{"GC-DCC-0033", "GC-DCC-0034", "GC-DCC-0032"}));
    EXPECT_NE(imported.remarks[0].what.find("of 1 input"), std::string::npos);
    EXPECT_EQ(imported.remarks[1].what, "2 results without uncertainty are left out");
}

/// A reading before an adjustment stands in the same row as the result after it, and says nothing of it.
TEST(ImportCertificate, TellsAResultByWhatIsOfItsStage) {
    const auto of_stage = [](std::string quantity, const std::string& status) {
        quantity.insert(quantity.rfind("</dcc:quantity>"),
                        "<dcc:influenceConditions><dcc:influenceCondition><dcc:name><dcc:content>stage</dcc:content>"
                        "</dcc:name><dcc:status>" +
                            status +
                            "</dcc:status><dcc:data><dcc:text><dcc:content>stage</dcc:content></dcc:text></dcc:data>"
                            "</dcc:influenceCondition></dcc:influenceConditions>");
        return quantity;
    };
    const auto words = [](const std::string& name, const std::string& all) {
        return "<dcc:quantity><dcc:name><dcc:content>" + name + "</dcc:content></dcc:name><dcc:charsXMLList>" + all +
               "</dcc:charsXMLList></dcc:quantity>";
    };
    const ImportedJob imported = import_certificate(
        with_quantities("<dcc:list>" + column("Setting", "20 40", "\\metre", "") +
                        of_stage(column("Reference", "20.4 40.3", "\\metre", ""), "beforeAdjustment") +
                        of_stage(words("Remark", "worn worn"), "beforeAdjustment") +
                        of_stage(column("Error", "0.4 0.3", "\\metre", "0.1", "basic_measurementError", "e_f"),
                                 "beforeAdjustment") +
                        of_stage(column("Measured", "20.1 40.0", "\\metre", ""), "afterAdjustment") +
                        of_stage(column("Deviation", "0.1 0.0", "\\metre", "0.1", "basic_measurementError", "e_l"),
                                 "afterAdjustment") +
                        "</dcc:list>"),
        "a.xml");
    const nlohmann::json inputs = nlohmann::json::parse(imported.job)["inputs"];
    ASSERT_EQ(inputs.size(), 4U) << imported.job;
    EXPECT_EQ(inputs["e_f_1"]["description"], "Error, row 1, as found (Remark worn, Setting 20 m, Reference 20.4 m)");
    EXPECT_EQ(inputs["e_l_2"]["description"], "Deviation, row 2, as left (Setting 40 m, Measured 40.0 m)");
}

TEST(ImportCertificate, RemarksTheSameOfAColumnOnce) {
    const ImportedJob imported =
        import_certificate(with_quantities("<dcc:list>" + column("A", "1 2 3", "|quux", "0.1") +
                                           column("B", "1 2 3", "\\metre", "0.1") + "</dcc:list>"),
                           "a.xml");
    ASSERT_EQ(of_numbers(imported.remarks),
              (std::vector<std::string>{"GC-DCC-0021", "GC-DCC-0031", "GC-DCC-0033", "GC-DCC-0032"}));
    EXPECT_EQ(imported.remarks[2].where, "a.xml: a_1 to a_3");
}

TEST(ImportCertificate, RefusesACertificateWithoutNumbers) {
    EXPECT_THROW((void)import_certificate(with_quantities(""), "a.xml"), gum::InputError);
    EXPECT_THROW((void)import_certificate("<!DOCTYPE a><a/>", "a.xml"), gum::InputError);
}

/// The job reader accepts what the import writes, for a certificate without uncertainties too.
TEST(ImportCertificate, WritesJobsThatCanBeRead) {
    std::vector<std::string> certificates = {
        with_quantities(quantity("Length", "1.50", expanded_value("0.020", "2.0"))),
        with_quantities(quantity("Length", "1.50", "") + quantity("y", "-0", standard("1e-3"), "\\one")),
        with_quantities(quantity("y", "1.", ""))};
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SHARED_DIR) / "dcc" / "examples";
    if (std::filesystem::exists(folder)) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() == ".xml") {
                std::ostringstream bytes;
                bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
                certificates.push_back(bytes.str());
            }
        }
    }
    for (const std::string& certificate : certificates) {
        const ImportedJob imported = import_certificate(certificate, "a.xml");
        const nlohmann::json job = nlohmann::json::parse(imported.job);
        try {
            const jobs::BudgetJob read =
                jobs::read_budget_job(jobs::MemoryFileSource({{"job.json", imported.job}}), "job.json");
            EXPECT_EQ(read.inputs.size(), job["inputs"].size());
        } catch (const gum::DiagnosedError& error) {
            ADD_FAILURE() << error.what() << "\n" << imported.job;
        }
    }
}

}  // namespace
}  // namespace gumcert::imports
