#include "reports/document_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

TEST(DocumentText, WithoutLanguageIsTheSameInAll) {
    const Text text = "U = 5 µm";
    EXPECT_EQ(text.in(0), "U = 5 µm");
    EXPECT_EQ(text.in(1), "U = 5 µm");
    EXPECT_FALSE(text.differs());
    EXPECT_EQ(text.languages(), 1U);
    EXPECT_TRUE(Text().empty());
    EXPECT_TRUE(Text(std::vector<std::string>{}).empty()) << "none is the empty text";
    EXPECT_EQ(Text(std::vector<std::string>{}).first(), "");
}

TEST(DocumentText, OfTwoLanguagesShowsBothWhereTheyDiffer) {
    const Text text(std::vector<std::string>{"length", "Länge"});
    EXPECT_EQ(text.first(), "length");
    EXPECT_EQ(text.in(1), "Länge");
    EXPECT_EQ(text.in(7), "Länge") << "the last one";
    EXPECT_TRUE(text.differs());
    EXPECT_FALSE(Text(std::vector<std::string>{"l", "l"}).differs());
    EXPECT_FALSE(Text(std::vector<std::string>{"", "Länge"}).empty());
    EXPECT_TRUE(Text(std::vector<std::string>{"", ""}).empty());
}

TEST(DocumentText, IsPutTogetherLanguageByLanguage) {
    const Text name(std::vector<std::string>{"length", "Länge"});
    EXPECT_EQ(Text("l: ") + name, Text(std::vector<std::string>{"l: length", "l: Länge"}));
    EXPECT_EQ(name + " l", Text(std::vector<std::string>{"length l", "Länge l"}));
    Text twice = name;
    twice += twice;
    EXPECT_EQ(twice, Text(std::vector<std::string>{"lengthlength", "LängeLänge"}));
}

}  // namespace
}  // namespace gumcert::reports
