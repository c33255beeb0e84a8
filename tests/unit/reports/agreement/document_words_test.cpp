#include "reports/agreement/document_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {
namespace {

using ::testing::ElementsAre;

TEST(DocumentWords, AreThoseOfTheProgramAndOfTheLaboratory) {
    const nlohmann::json of_program = {{"language", "en"}, {"verdict_name", {{"pass", "pass"}, {"fail", "not pass"}}}};
    nlohmann::json own = of_program;
    own["verdict_name"]["pass"] = "within limits";
    own["audit"]["mark"] = "no certificate of {laboratory}";
    const DocumentWords words = document_words({of_program, own, {{"language", "de"}}});
    EXPECT_THAT(words.languages, ElementsAre("en", "de"));
    ASSERT_EQ(words.verdicts.size(), 4U);
    EXPECT_EQ(words.verdicts.front(), std::pair(std::string("withinlimits"), std::string("pass")))
        << "the longest first";
    ASSERT_EQ(words.marks.size(), 1U);
    EXPECT_EQ(words.marks.front().before, "nocertificateof");
    EXPECT_EQ(words.marks.front().behind, "");
}

TEST(DocumentWords, AreRefusedWithoutVerdicts) {
    EXPECT_THROW(static_cast<void>(document_words({})), gum::StorageError);
    EXPECT_THROW(static_cast<void>(document_words({{{"language", "en"}}})), gum::StorageError);
}

}  // namespace
}  // namespace gumcert::reports
