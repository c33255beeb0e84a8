#include "reports/dcc/dcc_certificate_data.h"

#include <gtest/gtest.h>

#include <string>

#include "reports/dcc/dcc_element.h"
#include "tests/unit/reports/dcc/dcc_samples.h"

namespace gumcert::reports {
namespace {

/// A small document with what the reader looks for.
std::string document(const std::string& statements, const std::string& circumstances) {
    return R"(<dcc:digitalCalibrationCertificate xmlns:dcc="https://ptb.de/dcc" xmlns:si="https://ptb.de/si" schemaVersion="3.3.0">
<dcc:administrativeData>
<dcc:coreData><dcc:uniqueIdentifier> K-17 </dcc:uniqueIdentifier><dcc:receiptDate>2026-01-05</dcc:receiptDate>
<dcc:beginPerformanceDate>2026-01-07</dcc:beginPerformanceDate><dcc:endPerformanceDate>2026-01-08+01:00</dcc:endPerformanceDate>
<dcc:issueDate>yesterday</dcc:issueDate></dcc:coreData>
<dcc:items><dcc:item><dcc:name><dcc:content>Fühler</dcc:content><dcc:content lang="en">Sensor</dcc:content></dcc:name>
<dcc:model>T 3</dcc:model></dcc:item></dcc:items>
<dcc:calibrationLaboratory><dcc:calibrationLaboratoryCode>LAB</dcc:calibrationLaboratoryCode>
<dcc:contact><dcc:name><dcc:content>Example Laboratory</dcc:content></dcc:name></dcc:contact></dcc:calibrationLaboratory>
<dcc:statements>)" +
           statements +
           R"(</dcc:statements></dcc:administrativeData>
<dcc:measurementResults><dcc:measurementResult>)" +
           circumstances + R"(</dcc:measurementResult></dcc:measurementResults></dcc:digitalCalibrationCertificate>)";
}

certificate::CertificateData data_of(const std::string& statements, const std::string& circumstances) {
    return certificate_data_of(read_dcc_root(document(statements, circumstances), "test.xml"));
}

TEST(DccCertificateData, TakesTheAdministrativeData) {
    const certificate::CertificateData data = data_of("", "");
    EXPECT_EQ(data.number, "K-17");
    EXPECT_EQ(data.dates.received, "2026-01-05");
    EXPECT_EQ(data.dates.performed_from, "2026-01-07");
    EXPECT_EQ(data.dates.performed_to, "2026-01-08") << "a day may have a time zone";
    EXPECT_EQ(data.dates.issued, "") << "no day at all";
    EXPECT_EQ(data.item.description.in("en"), "Sensor");
    EXPECT_EQ(data.item.type, "T 3");
    EXPECT_EQ(data.laboratory.name.in("en"), "Example Laboratory");
    EXPECT_EQ(data.laboratory.code, "LAB");
    EXPECT_FALSE(data.accreditation);
}

TEST(DccCertificateData, TakesAccreditationAndStatements) {
    const std::string statement =
        R"(<dcc:statement id="s1" refType="gumcert_accreditation"><dcc:norm>ISO/IEC 17025:2017</dcc:norm>
<dcc:reference>D-K-1</dcc:reference><dcc:declaration><dcc:content>Accredited by Body</dcc:content></dcc:declaration></dcc:statement>)";
    const certificate::CertificateData data = data_of(statement, "");
    ASSERT_TRUE(data.accreditation);
    EXPECT_EQ(data.accreditation->number, "D-K-1");
    EXPECT_EQ(data.accreditation->body.in("en"), "Accredited by Body");
    const std::vector<DccStatement> statements = statements_of(read_dcc_root(document(statement, ""), "test.xml"));
    ASSERT_EQ(statements.size(), 1U);
    EXPECT_EQ(statements[0].id, "s1");
    EXPECT_EQ(statements[0].norm, "ISO/IEC 17025:2017");
}

TEST(DccCertificateData, TakesEquipmentAndConditions) {
    const std::string circumstances =
        R"(<dcc:usedMethods><dcc:usedMethod refType="basic_uncertainty"><dcc:name><dcc:content>GUM</dcc:content></dcc:name></dcc:usedMethod>
<dcc:usedMethod><dcc:name><dcc:content>Comparison</dcc:content></dcc:name><dcc:norm>DKD-R 5-1</dcc:norm></dcc:usedMethod></dcc:usedMethods>
<dcc:measuringEquipments><dcc:measuringEquipment refType="basic_measurementStandard gumcert_referenceStandard">
<dcc:name><dcc:content>Pt100</dcc:content></dcc:name><dcc:certificate><dcc:referralID>C-1</dcc:referralID>
<dcc:inValidityRange>false</dcc:inValidityRange></dcc:certificate>
<dcc:identifications><dcc:identification><dcc:issuer>other</dcc:issuer><dcc:value>P1</dcc:value></dcc:identification></dcc:identifications>
</dcc:measuringEquipment></dcc:measuringEquipments>
<dcc:influenceConditions><dcc:influenceCondition refType="basic_temperature"><dcc:name><dcc:content>room</dcc:content></dcc:name>
<dcc:data><dcc:quantity refType="basic_temperatureMin"><si:real><si:value>292.5</si:value><si:unit>\kelvin</si:unit></si:real></dcc:quantity>
<dcc:quantity refType="basic_temperatureMax"><si:hybrid><si:real><si:value>294.5</si:value><si:unit>\kelvin</si:unit></si:real>
<si:real><si:value>21.35</si:value><si:unit>\degreecelsius</si:unit></si:real></si:hybrid></dcc:quantity></dcc:data></dcc:influenceCondition>
<dcc:influenceCondition><dcc:name><dcc:content>no number</dcc:content></dcc:name></dcc:influenceCondition></dcc:influenceConditions>)";
    const certificate::CertificateData data = data_of("", circumstances);
    EXPECT_EQ(data.method.title.in("en"), "Comparison");
    EXPECT_EQ(data.method.standard, "DKD-R 5-1");
    ASSERT_EQ(data.standards.size(), 1U);
    EXPECT_EQ(data.standards[0].identification, "P1");
    EXPECT_EQ(data.standards[0].certificate, "C-1");
    EXPECT_EQ(data.standards[0].role, "reference");
    ASSERT_EQ(data.conditions.size(), 1U);
    EXPECT_EQ(data.conditions[0].kind, "temperature");
    EXPECT_EQ(data.conditions[0].unit, "K");
    EXPECT_EQ(data.conditions[0].minimum, 292.5);
    EXPECT_EQ(data.conditions[0].maximum, 294.5);
    const XmlElement root = read_dcc_root(document("", circumstances), "test.xml");
    EXPECT_EQ(equipment_out_of_validity(root), std::vector<std::string>{"Pt100"});
}

TEST(DccCertificateData, GivesBackWhatTheProgramWrote) {
    const EvaluationRecord record = test::certified_budget();
    const XmlElement root = read_dcc_root(render_dcc(record, test::dcc_assets()), "own.xml");
    const certificate::CertificateData data = certificate_data_of(root);
    const certificate::CertificateData& own = record.certificate->data;
    EXPECT_EQ(data.number, own.number);
    EXPECT_EQ(data.dates.performed_from, own.dates.performed_from);
    ASSERT_TRUE(own.persons.authorised_by && data.persons.authorised_by);
    EXPECT_EQ(data.persons.authorised_by->name, own.persons.authorised_by->name);
    ASSERT_EQ(data.persons.performed_by.has_value(), own.persons.performed_by.has_value());
    if (own.persons.performed_by) {
        EXPECT_EQ(data.persons.performed_by->name, own.persons.performed_by->name);
    }
    EXPECT_TRUE(data.remarks.empty() && data.opinions.empty());  // free text, which nobody judges here
    ASSERT_EQ(data.standards.size(), own.standards.size());
    ASSERT_EQ(data.conditions.size(), own.conditions.size());
    for (std::size_t i = 0; i < own.conditions.size(); ++i) {
        EXPECT_EQ(data.conditions[i].kind, own.conditions[i].kind);
        EXPECT_DOUBLE_EQ(data.conditions[i].minimum, own.conditions[i].minimum);
        EXPECT_DOUBLE_EQ(data.conditions[i].maximum, own.conditions[i].maximum);
    }
}

}  // namespace
}  // namespace gumcert::reports
