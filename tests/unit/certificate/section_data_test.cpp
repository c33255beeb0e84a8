#include "certificate/section_data.h"

#include <gtest/gtest.h>

namespace gumcert::certificate {
namespace {

CertificateData two_sections() {
    CertificateData data;
    data.item.serial_number = "SN-1";
    data.method.identification = "CP-1";
    for (const char* identification : {"STD-1", "STD-2"}) {
        data.standards.emplace_back().identification = identification;
    }
    data.conditions.emplace_back().unit = "degC";
    SectionData own;
    own.section = "AC";
    own.method.emplace();
    own.method->identification = "CP-2";
    own.standards = {"STD-2"};
    data.sections = {own};
    return data;
}

TEST(SectionData, StandInPlaceOfThoseOfTheCertificate) {
    const CertificateData of = data_of_section(two_sections(), "AC");
    EXPECT_EQ(of.method.identification, "CP-2");
    EXPECT_EQ(of.item.serial_number, "SN-1") << "what it leaves out is that of the certificate";
    ASSERT_EQ(of.standards.size(), 1U);
    EXPECT_EQ(of.standards[0].identification, "STD-2");
    EXPECT_EQ(of.conditions.size(), 1U);
}

TEST(SectionData, OfASectionThatStatesNothingAreThoseOfTheCertificate) {
    for (const char* section : {"", "DC"}) {
        const CertificateData of = data_of_section(two_sections(), section);
        EXPECT_EQ(of.method.identification, "CP-1");
        EXPECT_EQ(of.standards.size(), 2U);
    }
}

}  // namespace
}  // namespace gumcert::certificate
