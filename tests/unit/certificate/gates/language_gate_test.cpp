#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "certificate/gates/gates.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

std::vector<std::string> places(const Certificate& c) {
    std::vector<std::string> all;
    for (const Finding& f : language_findings(c)) {
        EXPECT_EQ(f.id, "R17");
        EXPECT_EQ(f.severity, FindingSeverity::minor);
        all.push_back(f.where);
    }
    return all;
}

TEST(LanguageGate, FindsATextThatALanguageOfTheCertificateLacks) {
    Certificate c = passed_certificate();
    c.data.languages = {"en", "de"};
    ASSERT_THAT(places(c), testing::IsEmpty());
    c.data.item.description = LocalisedText();
    c.data.item.description.by_language = {{"en", "Gauge"}};
    c.data.remarks = {LocalisedText("for all languages")};
    c.data.remarks.emplace_back();
    c.data.remarks.back().by_language = {{"es", "Palabras"}};
    c.data.persons.authorised_by->function.by_language = {{"de", "Leitung"}};
    c.data.persons.authorised_by->function.plain.clear();
    EXPECT_THAT(places(c), testing::UnorderedElementsAre("/item/description", "/remarks/1", "/remarks/1",
                                                         "/persons/authorised_by/function"));
    c.data.languages = {"en"};
    EXPECT_THAT(places(c), testing::UnorderedElementsAre("/remarks/1", "/persons/authorised_by/function"));
}

/// Descriptions of results come from the job and are texts of the certificate, too.
TEST(LanguageGate, FindsANameOfAResult) {
    Certificate c = passed_certificate();
    c.data.languages = {"en", "de"};
    c.tables.front().columns.front().name = LocalisedText();
    c.tables.front().columns.front().name.by_language = {{"en", "length"}};
    EXPECT_THAT(places(c), testing::ElementsAre(c.tables.front().columns.front().result));
}

}  // namespace
}  // namespace gumcert::certificate
