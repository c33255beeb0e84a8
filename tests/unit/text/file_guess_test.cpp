// What a file is, told by its first bytes and its key "schema".
#include "text/file_guess.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::text {
namespace {

std::string what_of(std::string_view bytes) {
    const auto guess = guess_file(bytes);
    return guess ? guess->what : "";
}

TEST(FileGuess, TellsTheFilesOfTheProgram) {
    EXPECT_EQ(what_of(R"({"schema": "gumcert/record/1", "job": {"text": "{\"schema\": \"gumcert/job/1\"}"}})"),
              "a record of an evaluation");
    EXPECT_EQ(what_of("\xEF\xBB\xBF {\"schema\": \"gumcert/job/1\"}"), "a job");
    EXPECT_EQ(what_of(R"({"inputs": {"schema": "gumcert/record/1"}, "schema": "gumcert/job/1"})"), "a job");
    EXPECT_EQ(what_of(R"({"schema": "gumcert/plan/1"})"), "JSON that gumcert has written");
    EXPECT_EQ(what_of(R"({"laboratory": {}, "customer": {"name": "x"}, "persons": {}})"), "certificate data");
    EXPECT_EQ(what_of("<?xml version=\"1.0\"?><a/>"), "XML");
    EXPECT_EQ(what_of("%PDF-1.7\n"), "a PDF");
    EXPECT_EQ(what_of("PK\x03\x04"), "a packed file, as workbooks are");
}

TEST(FileGuess, SaysNothingOfWhatItDoesNotKnow) {
    for (const char* bytes :
         {"", "  ", "a;b\n1;2\n", "{}", "{\"a\"", "{\"schema\": 3}", "[1, 2]", "{\"schema\": \"other/1\"}",
          "{\"inputs\": {\"schema\": \"gumcert/job/1\"}}", "\"schema\": \"gumcert/job/1\""}) {
        EXPECT_EQ(what_of(bytes), "") << bytes;
    }
}

/// A text that is cut anywhere is read without harm, and is still what it begins as once its schema is there.
TEST(FileGuess, ReadsTextsThatAreCut) {
    const std::string whole = R"({"a": "\\\"", "schema": "gumcert/record/1", "b": [{"c": "d"}]})";
    const std::size_t known = whole.find("/1\"") + 3;
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        EXPECT_EQ(what_of(whole.substr(0, size)), size >= known ? "a record of an evaluation" : "") << size;
    }
}

TEST(OutermostString, FindsOnlyWhatStandsOutermost) {
    EXPECT_EQ(outermost_string(R"({"a": {"k": "x"}, "k": "y"})", "k").value_or(""), "y");
    EXPECT_FALSE(outermost_string(R"({"a": "k", "b": {"k": "x"}})", "k").has_value());
    EXPECT_FALSE(outermost_string(R"({"k": 1})", "k").has_value());
    EXPECT_FALSE(outermost_string("k", "k").has_value());
}

/// Jobs may have comments, and what stands in them is no key and ends no text.
TEST(OutermostString, PassesOverComments) {
    for (const char* const comment : {"// it's \"k\": \"x\"\n", "/* a \" } */", "/**/", "// {\n"}) {
        const std::string text = "{" + std::string(comment) + R"("a": "//", )" + comment + R"("k": "y"})";
        EXPECT_EQ(outermost_string(text, "k").value_or(""), "y") << text;
        EXPECT_EQ(outermost_string(comment + text, "k").value_or(""), "y") << text;
    }
    for (const char* const cut : {"{/", "{//", "{/*", "{/* \"k\": \"x\"}", "{/*/"}) {
        EXPECT_FALSE(outermost_string(cut, "k").has_value()) << cut;
    }
}

}  // namespace
}  // namespace gumcert::text
