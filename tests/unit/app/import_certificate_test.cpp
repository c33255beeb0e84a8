#include "app/import_certificate.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/job/budget_job.h"
#include "engine/job/file_source.h"

namespace gumcert::app {
namespace {

std::string with_quantities(const std::string& quantities) {
    return "<dcc:digitalCalibrationCertificate xmlns:dcc='https://ptb.de/dcc' xmlns:si='https://ptb.de/si' "
           "schemaVersion='3.3.0'><dcc:administrativeData><dcc:coreData><dcc:uniqueIdentifier>EX-1 \"a\""
           "</dcc:uniqueIdentifier><dcc:issueDate>2026-11-21</dcc:issueDate></dcc:coreData><dcc:calibrationLaboratory>"
           "<dcc:contact><dcc:name><dcc:content>Example Laboratory</dcc:content></dcc:name></dcc:contact>"
           "</dcc:calibrationLaboratory></dcc:administrativeData><dcc:measurementResults><dcc:measurementResult>"
           "<dcc:results><dcc:result><dcc:data>" +
           quantities +
           "</dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>"
           "</dcc:digitalCalibrationCertificate>";
}

std::string quantity(const std::string& name, const std::string& value, const std::string& uncertainty,
                     const std::string& unit = "\\milli\\metre") {
    return "<dcc:quantity><dcc:name><dcc:content>" + name + "</dcc:content></dcc:name><si:real><si:value>" + value +
           "</si:value><si:unit>" + unit + "</si:unit>" + uncertainty + "</si:real></dcc:quantity>";
}

std::string expanded(const std::string& U, const std::string& k) {
    return "<si:measurementUncertaintyUnivariate><si:expandedMU><si:valueExpandedMU>" + U +
           "</si:valueExpandedMU><si:coverageFactor>" + k +
           "</si:coverageFactor><si:coverageProbability>0.95</si:coverageProbability></si:expandedMU>"
           "</si:measurementUncertaintyUnivariate>";
}

std::string standard(const std::string& u) {
    return "<si:measurementUncertaintyUnivariate><si:standardMU><si:valueStandardMU>" + u +
           "</si:valueStandardMU></si:standardMU></si:measurementUncertaintyUnivariate>";
}

std::vector<std::string> codes(const std::vector<gum::Diagnostic>& remarks) {
    std::vector<std::string> all;
    for (const gum::Diagnostic& d : remarks) {
        all.push_back(d.code);
    }
    return all;
}

TEST(ImportCertificate, MakesAJobOfWhatHasAnUncertainty) {
    const ImportedJob imported = import_certificate(
        with_quantities(quantity("Length", "1.50", expanded("0.020", "2.0")) + quantity("Nominal", "1.5", "") +
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
    EXPECT_EQ(codes(imported.remarks), std::vector<std::string>{"GC-DCC-0032"});
}

TEST(ImportCertificate, LeavesOutWhatCannotBeAnInput) {
    const ImportedJob imported = import_certificate(
        with_quantities(quantity("a", "NaN", expanded("0.1", "2")) + quantity("b", "1", expanded("0.1", "2"), "|inch") +
                        quantity("c", "1", expanded("0", "2")) + quantity("d", "1", standard("NaN"))),
        "a.xml");
    const nlohmann::json job = nlohmann::json::parse(imported.job);
    ASSERT_EQ(job["inputs"].size(), 1U);
    EXPECT_EQ(job["inputs"]["c"]["constant"], true);
    EXPECT_EQ(codes(imported.remarks),
              (std::vector<std::string>{"GC-DCC-0021", "GC-DCC-0031", "GC-DCC-0031", "GC-DCC-0031"}));
}

TEST(ImportCertificate, RefusesACertificateWithoutNumbers) {
    EXPECT_THROW((void)import_certificate(with_quantities(""), "a.xml"), gum::InputError);
    EXPECT_THROW((void)import_certificate("<!DOCTYPE a><a/>", "a.xml"), gum::InputError);
}

/// The job reader accepts what the import writes, for a certificate without uncertainties too.
TEST(ImportCertificate, WritesJobsThatCanBeRead) {
    std::vector<std::string> certificates = {
        with_quantities(quantity("Length", "1.50", expanded("0.020", "2.0"))),
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
            const engine::BudgetJob read =
                engine::read_budget_job(engine::MemoryFileSource({{"job.json", imported.job}}), "job.json");
            EXPECT_EQ(read.inputs.size(), job["inputs"].size());
        } catch (const gum::DiagnosedError& error) {
            ADD_FAILURE() << error.what() << "\n" << imported.job;
        }
    }
}

}  // namespace
}  // namespace gumcert::app
