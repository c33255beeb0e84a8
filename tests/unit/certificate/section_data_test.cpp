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

TEST(SectionData, AnItemIsTheSameByWhatIdentifiesIt) {
    Item a;
    a.description = "Multimeter";
    a.serial_number = "SN-1";
    Item b = a;
    b.condition = "No damage seen";
    EXPECT_TRUE(is_same_item(a, b));
    b.serial_number = "SN-2";
    EXPECT_FALSE(is_same_item(a, b));
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

// A set of instruments has an item, a method and conditions a section, and none of the whole.
TEST(SectionData, OfEachSectionStandForThoseOfTheWhole) {
    CertificateData data = two_sections();
    const std::vector<CertifiedTable> of_ac{
        {.id = "results", .section = "AC", .argument = {}, .layout = {}, .columns = {}}};
    std::vector<CertifiedTable> of_both = of_ac;
    of_both.push_back(of_ac.front());
    of_both.back().section = "DC";
    EXPECT_FALSE(stated_by_sections(data, of_ac).method) << "the certificate states one";
    data.item.serial_number.clear();
    data.item.description = "Set of two";
    data.method = {};
    data.conditions.clear();
    EXPECT_FALSE(stated_by_sections(data, of_ac).item);
    EXPECT_FALSE(stated_by_sections(data, of_ac).conditions);
    EXPECT_TRUE(stated_by_sections(data, of_ac).method);
    EXPECT_FALSE(stated_by_sections(data, of_both).method) << "DC states none";
    EXPECT_FALSE(stated_by_sections(data, {}).method);
    data.sections[0].item.emplace().serial_number = "SN-2";
    data.sections[0].conditions.emplace_back().unit = "degC";
    EXPECT_TRUE(stated_by_sections(data, of_ac).item);
    EXPECT_TRUE(stated_by_sections(data, of_ac).conditions);
    data.sections.push_back(data.sections[0]);
    data.sections[1].section = "DC";
    EXPECT_TRUE(stated_by_sections(data, of_both).item);
    EXPECT_EQ(items_of(data).size(), 2U) << "both sections are of one item";
    data.sections[1].item->serial_number = "SN-3";
    ASSERT_EQ(items_of(data).size(), 3U);
    EXPECT_EQ(items_of(data)[1]->serial_number, "SN-2");
    data.method.title = "Of all";
    EXPECT_FALSE(stated_by_sections(data, of_ac).method) << "what is stated of the whole is printed";
    data.item.identification = "INV-1";
    EXPECT_FALSE(stated_by_sections(data, of_both).item) << "the set has a number of its own";
    data.item = {};
    EXPECT_EQ(items_of(data).size(), 2U);
}

}  // namespace
}  // namespace gumcert::certificate
