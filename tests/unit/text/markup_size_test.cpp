#include "text/markup_size.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::text {
namespace {

TEST(MarkupSize, CountsTagsAndAttributes) {
    const MarkupSize size = markup_size("<?xml version=\"1.0\"?>\n<a x=\"1\" y='2'><b z = \"<>'\"/>text</a>");
    EXPECT_EQ(size.tags, 3U);
    EXPECT_EQ(size.attributes, 3U);
    EXPECT_EQ(size.most_in_tag, 2U);
}

TEST(MarkupSize, PassesOverWhatIsNoTag) {
    const MarkupSize size = markup_size("<a><!-- <b c='1' d='2'> ' --><![CDATA[<e f=\"1\">\"]]><?g h='1'?></a>");
    EXPECT_EQ(size.tags, 2U);
    EXPECT_EQ(size.attributes, 0U);
}

TEST(MarkupSize, EndsWhereTheTextIsTorn) {
    for (const char* const torn : {"", "<", "<a", "<a b=\"", "<!--", "<![CDATA[", "<?", "a > b", "<a b='1\""}) {
        EXPECT_LE(markup_size(torn).tags, 1U) << torn;
    }
}

TEST(MarkupSize, FindsACrowdedTagWhereverItStands) {
    std::string crowded = "<t";
    for (int i = 0; i < 1000; ++i) {
        crowded += " a" + std::to_string(i) + "=''";
    }
    const std::string text = "<r a='1'>'\"<!-- ' -->" + crowded + "/>\"</r>";
    EXPECT_EQ(markup_size(text).most_in_tag, 1000U);
}

}  // namespace
}  // namespace gumcert::text
