#include "imports/foreign_certificate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "imports/import_certificate.h"
#include "tests/unit/signing/test_keys.h"

namespace gumcert::imports {
namespace {

using namespace signing::test;
using testing::Contains;
using testing::HasSubstr;

std::string certificate(const std::string& uncertainty, const std::string& statement = "",
                        const std::string& number = "EX-1") {
    const auto named = [](const std::string& name) {
        return "<dcc:name><dcc:content>" + name + "</dcc:content></dcc:name>";
    };
    const std::string location = "<dcc:location><dcc:city>Braunschweig</dcc:city></dcc:location>";
    return "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" xmlns:si=\"https://ptb.de/si\" "
           "schemaVersion=\"3.3.0\"><dcc:administrativeData><dcc:dccSoftware><dcc:software>" +
           named("s") +
           "<dcc:release>v1.0</dcc:release></dcc:software></dcc:dccSoftware><dcc:coreData>"
           "<dcc:countryCodeISO3166_1>DE</dcc:countryCodeISO3166_1>"
           "<dcc:usedLangCodeISO639_1>en</dcc:usedLangCodeISO639_1>"
           "<dcc:mandatoryLangCodeISO639_1>en</dcc:mandatoryLangCodeISO639_1><dcc:uniqueIdentifier>" +
           number +
           "</dcc:uniqueIdentifier><dcc:beginPerformanceDate>2026-03-31</dcc:beginPerformanceDate>"
           "<dcc:endPerformanceDate>2026-03-31</dcc:endPerformanceDate>"
           "<dcc:performanceLocation>laboratory</dcc:performanceLocation></dcc:coreData><dcc:items><dcc:item>" +
           named("i") +
           "<dcc:identifications><dcc:identification><dcc:issuer>manufacturer</dcc:issuer><dcc:value>7</dcc:value>"
           "</dcc:identification></dcc:identifications></dcc:item></dcc:items>"
           "<dcc:respPersons><dcc:respPerson><dcc:person>" +
           named("p") + "</dcc:person></dcc:respPerson></dcc:respPersons><dcc:customer>" + named("c") + location +
           "</dcc:customer><dcc:calibrationLaboratory><dcc:contact>" + named("Example Laboratory") + location +
           "</dcc:contact></dcc:calibrationLaboratory>" + statement +
           "</dcc:administrativeData><dcc:measurementResults><dcc:measurementResult>" + named("r") +
           "<dcc:usedMethods><dcc:usedMethod>" + named("m") +
           "</dcc:usedMethod></dcc:usedMethods><dcc:influenceConditions><dcc:influenceCondition>" + named("c") +
           "<dcc:data><dcc:text><dcc:content>in the room</dcc:content></dcc:text></dcc:data>"
           "</dcc:influenceCondition></dcc:influenceConditions><dcc:results><dcc:result>" +
           named("r") + "<dcc:data><dcc:quantity>" + named("Length") +
           "<si:real><si:value>10.0023</si:value><si:unit>\\milli\\metre</si:unit>" + uncertainty +
           "</si:real></dcc:quantity><dcc:quantity>" + named("Width") +
           "<si:real><si:value>5.0</si:value><si:unit>\\milli\\metre</si:unit><si:measurementUncertaintyUnivariate>"
           "<si:standardMU><si:valueStandardMU>0.1</si:valueStandardMU></si:standardMU>"
           "</si:measurementUncertaintyUnivariate></si:real></dcc:quantity>"
           "</dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>"
           "</dcc:digitalCalibrationCertificate>\n";
}

std::string expanded(const std::string& U, const std::string& k, const std::string& p = "0.95") {
    return "<si:measurementUncertaintyUnivariate><si:expandedMU><si:valueExpandedMU>" + U +
           "</si:valueExpandedMU><si:coverageFactor>" + k + "</si:coverageFactor>" +
           (p.empty() ? "" : "<si:coverageProbability>" + p + "</si:coverageProbability>") +
           "</si:expandedMU></si:measurementUncertaintyUnivariate>";
}

std::string old_notation(const std::string& U, const std::string& k) {
    return "<si:expandedUnc><si:uncertainty>" + U + "</si:uncertainty><si:coverageFactor>" + k +
           "</si:coverageFactor><si:coverageProbability>0.95</si:coverageProbability></si:expandedUnc>";
}

CertificateTrust trust(std::optional<std::vector<signing::Bytes>> trusted = {}) {
    return {.trusted = std::move(trusted), .now = k_now};
}

std::vector<std::string> errors_and_warnings(const std::vector<gum::Diagnostic>& all) {
    std::vector<std::string> codes;
    for (const gum::Diagnostic& d : all) {
        if (d.severity != gum::Severity::note) {
            codes.push_back(d.code);
        }
    }
    return codes;
}

using Codes = std::vector<std::string>;

TEST(ForeignCertificate, OneThatIsSoundHasNothing) {
    // The rule of the software is a warning, and everything else is there.
    EXPECT_EQ(errors_and_warnings(check_certificate(certificate(expanded("0.020", "2.0")), "a.xml", trust())),
              Codes{"GC-DCC-0101"});
    const ImportedJob job = import_certificate(certificate(expanded("0.020", "2.0")), "a.xml", trust());
    EXPECT_EQ(errors_and_warnings(job.remarks), Codes());
    EXPECT_FALSE(job.negative);
}

TEST(ForeignCertificate, DraftsAndSpecimensAreTold) {
    const std::string U = expanded("0.020", "2.0");
    const auto statement = [](const char* kind) {
        return "<dcc:statements><dcc:statement refType=\"" + std::string(kind) +
               "\"><dcc:declaration><dcc:content>x</dcc:content></dcc:declaration></dcc:statement></dcc:statements>";
    };
    for (const std::string& text :
         {certificate(U, statement("gumcert_draft")), certificate(U, statement("gumcert_specimen")),
          certificate(U, statement("gumcert_superseded")), certificate(U, "", "EX-1 DRAFT"),
          certificate(U, "", "Entwurf 7"), certificate(U, "", "MUSTER-1")}) {
        EXPECT_THAT(errors_and_warnings(check_certificate(text, "a.xml", trust())), Contains("GC-DCC-0040"));
        const ImportedJob job = import_certificate(text, "a.xml", trust());
        EXPECT_THAT(errors_and_warnings(job.remarks), Contains("GC-DCC-0040"));
        EXPECT_TRUE(job.job.find("draft of certificate") != std::string::npos ||
                    job.job.find("superseded document of certificate") != std::string::npos ||
                    job.job.find("specimen of certificate") != std::string::npos)
            << job.job;
    }
    // A name that holds the letters of such a word is none.
    EXPECT_EQ(errors_and_warnings(check_certificate(certificate(U, "", "Draftsman-1"), "a.xml", trust())),
              Codes{"GC-DCC-0101"});
}

// Every statement of uncertainty that cannot be used: told by the check, not taken by the import, and never a constant.
TEST(ForeignCertificate, UncertaintiesThatCannotBeUsed) {
    const struct {
        std::string uncertainty, says;
    } k_cases[] = {
        {expanded("NaN", "2"), "NaN"},
        {expanded("INF", "2"), "INF"},
        {expanded("0.02", "0.5", "0.9545"), "does not belong"},
        {expanded("0.02", "2.16", "0.5"), "does not belong"},
        {expanded("0.02", "0.9", ""), "below 1"},
        {expanded("0.02", "2", "95"), "coverage probability is 95"},
        {old_notation("5", "2") + expanded("0.02", "2"), "stated twice"},
        {expanded("0.02", "2") + old_notation("0.03", "2"), "stated twice"},
        {"<si:measurementUncertaintyUnivariate><si:standardMU><si:valueStandardMU>NaN</si:valueStandardMU>"
         "</si:standardMU></si:measurementUncertaintyUnivariate>",
         "NaN"},
    };
    for (const auto& one : k_cases) {
        const std::string text = certificate(one.uncertainty);
        const std::vector<gum::Diagnostic> found = check_certificate(text, "a.xml", trust());
        EXPECT_THAT(errors_and_warnings(found), Contains("GC-DCC-0046")) << one.uncertainty;
        const ImportedJob job = import_certificate(text, "a.xml", trust());
        EXPECT_THAT(job.job, testing::Not(HasSubstr("10.0023"))) << job.job;
        EXPECT_THAT(job.job, testing::Not(HasSubstr("constant"))) << job.job;
        bool told = false;
        for (const gum::Diagnostic& remark : job.remarks) {
            told = told || (remark.code == "GC-DCC-0031" && remark.what.find(one.says) != std::string::npos);
        }
        EXPECT_TRUE(told) << one.uncertainty;
    }
    // What is right in two notations, or with an unusual k, is taken.
    for (const std::string& good :
         {old_notation("0.02", "2") + expanded("0.020", "2.0"), expanded("0.02", "1.65", "0.95"),
          expanded("0.02", "4.53", "0.9545"), expanded("0.02", "1.41", "0.95"), expanded("0.02", "0.68", "0.5"),
          expanded("0.02", "1", "")}) {
        EXPECT_THAT(errors_and_warnings(check_certificate(certificate(good), "a.xml", trust())),
                    testing::Not(Contains("GC-DCC-0046")))
            << good;
        EXPECT_THAT(import_certificate(certificate(good), "a.xml", trust()).job, HasSubstr("10.0023"));
    }
}

TEST(ForeignCertificate, OfTwoSignsNoneIsLeftOut) {
    for (const char* const U : {"+-0.02", "++0.02"}) {
        const std::string text = certificate(expanded(U, "2"));
        EXPECT_GT(errors_and_warnings(check_certificate(text, "a.xml", trust())).size(), 1U) << U;
        EXPECT_THAT(import_certificate(text, "a.xml", trust()).job, testing::Not(HasSubstr("0.02"))) << U;
    }
}

TEST(ForeignCertificate, SignaturesAreToldForWhatTheyAreWorth) {
    const Laboratory laboratory(ec_key());
    const std::string good =
        signing::sign_dcc(certificate(expanded("0.020", "2.0")), *laboratory.signer, k_signing_time);
    // Nobody was named: intact, and not verified.
    ImportedJob job = import_certificate(good, "a.xml", trust());
    EXPECT_EQ(errors_and_warnings(job.remarks), Codes{"GC-DCC-0043"});
    EXPECT_FALSE(job.negative);
    EXPECT_THAT(job.remarks.front().what, HasSubstr("CN=Example Calibration Laboratory"));
    // Trusted.
    EXPECT_EQ(errors_and_warnings(import_certificate(good, "a.xml", trust(laboratory.trusted())).remarks), Codes());
    // Somebody else is trusted.
    const Laboratory other(ec_key());
    job = import_certificate(good, "a.xml", trust(other.trusted()));
    EXPECT_EQ(errors_and_warnings(job.remarks), Codes{"GC-DCC-0042"});
    EXPECT_TRUE(job.negative);
    // Changed after signing: refused, whoever is trusted.
    std::string changed = good;
    changed.replace(changed.find("10.0023"), 7, "10.0923");
    for (const CertificateTrust& whom : {trust(), trust(laboratory.trusted())}) {
        try {
            (void)import_certificate(changed, "a.xml", whom);
            ADD_FAILURE() << "imported";
        } catch (const gum::InputError& refused) {
            EXPECT_EQ(refused.diagnostics().front().code, "GC-DCC-0041");
        }
        EXPECT_THAT(errors_and_warnings(check_certificate(changed, "a.xml", whom)), Contains("GC-DCC-0041"));
    }
}

TEST(ForeignCertificate, PartsThatEveryCertificateHas) {
    for (const char* part : {"dccSoftware", "countryCodeISO3166_1", "usedLangCodeISO639_1", "uniqueIdentifier",
                             "beginPerformanceDate", "performanceLocation", "items", "respPersons", "customer"}) {
        std::string text = certificate(expanded("0.020", "2.0"));
        const std::size_t from = text.find("<dcc:" + std::string(part) + ">");
        const std::string end = "</dcc:" + std::string(part) + ">";
        text.erase(from, text.find(end) + end.size() - from);
        EXPECT_THAT(errors_and_warnings(check_certificate(text, "a.xml", trust())), Contains("GC-DCC-0112")) << part;
    }
}

TEST(ForeignCertificate, WithoutResultsIsNoCertificate) {
    std::string text = certificate(expanded("0.020", "2.0"));
    const std::size_t from = text.find("<dcc:quantity>");
    const std::string end = "</dcc:quantity>";
    text.erase(from, text.rfind(end) + end.size() - from);
    const std::vector<gum::Diagnostic> found = check_certificate(text, "a.xml", trust());
    EXPECT_THAT(errors_and_warnings(found), Contains("GC-DCC-0049"));
    EXPECT_THAT(errors_and_warnings(found), testing::Not(Contains("GC-DCC-0046")));
}

// One planted defect of every kind: the check tells it by its code, the import that there is one.
TEST(ForeignCertificate, DefectsOfSchemaAndStatementsAreTold) {
    const std::string good = certificate(expanded("0.020", "2.0"));
    const struct {
        const char* from;
        const char* to;
        const char* code;
    } k_cases[] = {
        {"<dcc:country", "<dcc:Country", "GC-DCC-0001"},
        {"<dcc:value>7</dcc:value>", "", "GC-DCC-0112"},
        {"<dcc:release>v1.0</dcc:release>", "<dcc:release>v1.0</dcc:release><dcc:release>v1.0</dcc:release>",
         "GC-DCC-0113"},
        {"<dcc:city>Braunschweig</dcc:city>", "<dcc:town>Braunschweig</dcc:town>", "GC-DCC-0113"},
        {"<dcc:items>", "<dcc:items number='1'>", "GC-DCC-0114"},
        {"<dcc:item>", "<dcc:item id='1 2'>", "GC-DCC-0114"},
        {">manufacturer<", ">maker<", "GC-DCC-0115"},
        {">laboratory<", ">Laboratory<", "GC-DCC-0115"},
        {">DE<", ">GERMANY<", "GC-DCC-0115"},
        {">2026-03-31</dcc:begin", ">31.03.2026</dcc:begin", "GC-DCC-0115"},
        {">10.0023<", ">10,0023<", "GC-DCC-0115"},
        {">0.95<", ">0.90<", ""},  // no distribution is named
        {"</si:coverageProbability>", "</si:coverageProbability><si:distribution>normal</si:distribution>", ""},
        {">0.95</si:coverageProbability>", ">0.68</si:coverageProbability><si:distribution>normal</si:distribution>",
         "GC-DCC-0117"},
        {"\\milli\\metre", "mm", "GC-DCC-0118"},
        {"<si:coverageProbability>0.95</si:coverageProbability>", "", "GC-DCC-0112"},
        {">0.020<", ">-0.020<", "GC-DCC-0115"},
        {">2.0<", ">0.9<", "GC-DCC-0115"},
    };
    for (const auto& one : k_cases) {
        std::string text = good;
        ASSERT_NE(text.find(one.from), std::string::npos) << one.from;
        text.replace(text.find(one.from), std::string(one.from).size(), one.to);
        const std::string code = one.code;
        if (code == "GC-DCC-0001") {
            EXPECT_THROW((void)check_certificate(text, "a.xml", trust()), gum::InputError);
            continue;
        }
        const Codes codes = errors_and_warnings(check_certificate(text, "a.xml", trust()));
        const Codes imported = errors_and_warnings(import_certificate(text, "a.xml", trust()).remarks);
        if (code.empty()) {
            EXPECT_EQ(codes, Codes{"GC-DCC-0101"}) << one.to;
            EXPECT_THAT(imported, testing::Not(Contains("GC-DCC-0045"))) << one.to;
        } else {
            EXPECT_THAT(codes, Contains(code)) << one.to;
            EXPECT_THAT(imported, Contains("GC-DCC-0045")) << one.to;
        }
    }
}

TEST(ForeignCertificate, BrokenRulesAreToldAtTheImport) {
    std::string text = certificate(expanded("0.020", "2.0"));
    text.replace(text.find("<dcc:content>m<"), 15, "<dcc:content> <");
    const ImportedJob job = import_certificate(text, "a.xml", trust());
    EXPECT_EQ(errors_and_warnings(job.remarks), Codes{"GC-DCC-0045"});
    EXPECT_THAT(errors_and_warnings(check_certificate(text, "a.xml", trust())), Contains("GC-DCC-0111"));
}

}  // namespace
}  // namespace gumcert::imports
