#include "app/archive/standard_references.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gumcert::app {
namespace {

TEST(NameInAText, IsAWordOfItsOwn) {
    for (const char* const text : {"STD-017", "STD-017, certificate 12", "(STD-017)", "see STD-017.",
                                   "by STD-017; STD-018", "STD-0171 and STD-017"}) {
        EXPECT_TRUE(names(text, "STD-017")) << text;
    }
    for (const char* const text :
         {"", "STD-0171", "XSTD-017", "STD-017-2", "STD-017/A1", "A/STD-017", "STD-01", "std-017"}) {
        EXPECT_FALSE(names(text, "STD-017")) << text;
    }
    EXPECT_FALSE(names("anything", ""));
}

TEST(FileOfTheRegister, SaysWhichStandardItIs) {
    EXPECT_EQ(standard_of_file("laboratory/standards/STD-017.json"), "STD-017");
    EXPECT_EQ(standard_of_file("laboratory:/standards/STD-017.json"), "STD-017");
    EXPECT_EQ(standard_of_file("standards/STD-017.json"), "STD-017");
    EXPECT_EQ(standard_of_file("other_standards/STD-017.json"), "");
    EXPECT_EQ(standard_of_file("laboratory/standards/old/STD-017.json"), "");
    EXPECT_EQ(standard_of_file("laboratory/customers/CUST-3.json"), "");
}

TEST(RecordReferences, AreTakenFromEveryPlace) {
    const nlohmann::json record = {
        {"title", "STD-9 is in the title only"},
        {"certificate",
         {{"data",
           {{"dates", {{"performed_from", "2026-01-02"}, {"performed_to", "2026-01-04"}}},
            {"standards", {{{"identification", "STD-1"}, {"certificate", "NMI-1"}}, "STD-2"}},
            {"conditions", {{{"sensor", "T-04"}}}}}}}},
        {"results", {{"l", {{"budget", {{{"source", "STD-3, certificate NMI-3"}}}}}}}},
        {"job",
         {{"files",
           {{{"name", "standards/STD-4.json"},
             {"encoding", "utf-8"},
             {"content", R"({"calibrations": [{"certificate": "NMI-4"}]})"}}}},
          {"document", {{"inputs", {{"x", {{"source", {{"en", "STD-5"}, {"de", "Normal STD-5"}}}}}}}}}}}};
    const std::optional<RecordReferences> found = references_of(record.dump());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->used_from, "2026-01-02");
    EXPECT_EQ(found->used_to, "2026-01-04");
    const auto named = [&](const std::string& name) {
        return std::any_of(found->references.begin(), found->references.end(),
                           [&](const StandardReference& one) { return names(one.text, name); });
    };
    for (const char* const name : {"STD-1", "NMI-1", "STD-2", "T-04", "STD-3", "NMI-3", "STD-4", "NMI-4", "STD-5"}) {
        EXPECT_TRUE(named(name)) << name;
    }
    EXPECT_FALSE(named("STD-9"));
    EXPECT_FALSE(references_of("no record"));
}

TEST(RecordReferences, TakeTheDayOfIssueWhereTheWorkHasNone) {
    const auto found = references_of(R"({"certificate": {"data": {"dates": {"issued": "2026-05-06"}}}})");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->used_from, "2026-05-06");
    EXPECT_EQ(found->used_to, "2026-05-06");
    EXPECT_EQ(references_of("{}")->used_to, "");
}

}  // namespace
}  // namespace gumcert::app
