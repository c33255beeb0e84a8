#include "audit/sentence.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(Sentence, says_its_pattern_with_what_stands_in_its_places) {
    const Sentence said = say("U = {U:number} is below the capability {capability:number}", "0.31 um", "0.4 um");
    EXPECT_EQ(said.english(), "U = 0.31 um is below the capability 0.4 um");
    EXPECT_EQ(said.pattern(), "U = {U:number} is below the capability {capability:number}");
    ASSERT_EQ(said.arguments().size(), 2U);
    EXPECT_EQ(said.arguments()[0].english(), "0.31 um");
    EXPECT_EQ(say("no places").english(), "no places");
}

TEST(Sentence, holds_sentences_in_its_places) {
    const Sentence said = say("{done}; the certificate states k = {k:number}", say("U is divided by 2"), "3");
    EXPECT_EQ(said.english(), "U is divided by 2; the certificate states k = 3");
    EXPECT_EQ(said.arguments()[0].pattern(), "U is divided by 2");
}

TEST(Sentence, reads_no_pattern_in_a_text) {
    const Sentence said = say("source {name}", "{name} 50 % {");
    EXPECT_EQ(said.english(), "source {name} 50 % {");
    EXPECT_EQ(Sentence("{name}").pattern(), "");
    EXPECT_TRUE(Sentence().empty());
}

TEST(Sentence, can_have_other_texts_in_its_places) {
    const Sentence said = say("{a} beside {b}", say("source {name}", "x"), "y");
    const Sentence marked = said.with_texts([](const std::string& text) { return "<" + text + ">"; });
    EXPECT_EQ(marked.english(), "source <x> beside <y>");
    EXPECT_EQ(marked.pattern(), said.pattern());
}

TEST(Sentence, counts_in_two_forms) {
    const auto readings = [](std::size_t n) {
        return say_count(n, "{count:number} reading", "{count:number} readings").english();
    };
    EXPECT_EQ(readings(1), "1 reading");
    EXPECT_EQ(readings(0), "0 readings");
    EXPECT_EQ(readings(5), "5 readings");
}

TEST(Sentence, lists_sentences) {
    const std::vector<Sentence> names = sentences_of({"a", "b", "c"});
    EXPECT_EQ(joined(names).english(), "a, b, c");
    EXPECT_EQ(all_of(names).english(), "a, b and c");
    EXPECT_EQ(all_of({}).english(), "");
    EXPECT_EQ(all_of({names[0]}).english(), "a");
    EXPECT_EQ(listed(names, 2).english(), "a, b and 1 more");
    EXPECT_EQ(listed(names, 3).english(), "a, b, c");
}

TEST(Sentence, says_an_equation) {
    EXPECT_EQ(equals("u", "0.4 µm").english(), "u = 0.4 µm");
    EXPECT_EQ(equals(say("estimate"), "3").english(), "estimate = 3");
    EXPECT_EQ(say_number("0.4 µm").english(), "0.4 µm");
    EXPECT_NE(say_number("0.4 µm").pattern(), "") << "its decimal sign is that of a language";
}

TEST(PatternPieces, are_literals_and_places) {
    const PatternPieces pieces = pattern_pieces("k = {k:number} of {row} because {why:sentence}");
    ASSERT_EQ(pieces.places.size(), 3U);
    EXPECT_EQ(pieces.literals, (std::vector<std::string_view>{"k = ", " of ", " because ", ""}));
    EXPECT_EQ(pieces.places[0].name, "k");
    EXPECT_TRUE(pieces.places[0].is_number);
    EXPECT_EQ(pieces.places[1].name, "row");
    EXPECT_FALSE(pieces.places[1].is_number || pieces.places[1].is_sentence);
    EXPECT_TRUE(pieces.places[2].is_sentence);
    EXPECT_EQ(pattern_pieces("").literals, (std::vector<std::string_view>{""}));
    static_assert(places_in("{a} and {b:number}") == 2);
}

}  // namespace
}  // namespace gumcert::audit
