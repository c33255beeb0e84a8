#include "text/markup.h"

#include <gtest/gtest.h>

namespace gumcert::text {
namespace {

TEST(Markup, SignsOfMarkupAreEscaped) {
    EXPECT_EQ(escaped_markup(R"(a < b & "c" > 'd')"), "a &lt; b &amp; &quot;c&quot; &gt; 'd'");
    EXPECT_EQ(escaped_markup("&amp;"), "&amp;amp;");
    EXPECT_EQ(escaped_markup("µ″"), "µ″");
}

}  // namespace
}  // namespace gumcert::text
