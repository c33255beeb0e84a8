#include "certificate/localised_text.h"

#include <gtest/gtest.h>

namespace gumcert::certificate {
namespace {

TEST(LocalisedText, OnceForAllLanguages) {
    const LocalisedText text = "Gauge block";
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.in("en"), "Gauge block");
    EXPECT_EQ(text.in("de"), "Gauge block");
    EXPECT_TRUE(LocalisedText().empty());
    EXPECT_EQ(LocalisedText().in("en"), "");
}

TEST(LocalisedText, OnceInEachLanguage) {
    LocalisedText text;
    text.by_language = {{"de", "Endmaß"}, {"es", "bloque patrón"}};
    EXPECT_FALSE(text.empty());
    EXPECT_EQ(text.in("es"), "bloque patrón");
    EXPECT_EQ(text.in("en"), "Endmaß") << "the first one";
    text.plain = "gauge block";
    EXPECT_EQ(text.in("es"), "bloque patrón");
    EXPECT_EQ(text.in("en"), "gauge block") << "the plain text before another language";
}

}  // namespace
}  // namespace gumcert::certificate
