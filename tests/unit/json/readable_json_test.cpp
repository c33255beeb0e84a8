#include "json/readable_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::json {
namespace {

using nlohmann::ordered_json;

TEST(ReadableJson, PutsOnOneLineWhatFits) {
    const ordered_json value = ordered_json::parse(R"({"b":[1,"x",true,null],"a":{},"c":[{"d":0.5}]})");
    EXPECT_EQ(readable_json(value), R"({ "b": [1, "x", true, null], "a": {}, "c": [{ "d": 0.5 }] })");
    EXPECT_EQ(readable_json("é"), "\"é\"");
}

TEST(ReadableJson, BreaksOnlyTheLinesThatAreTooLong) {
    const ordered_json value{{"long", std::string(110, 'x')}, {"list", {1, 2}}};
    const std::string broken = "{\n  \"long\": \"" + std::string(110, 'x') + "\",\n  \"list\": [1, 2]\n}";
    EXPECT_EQ(readable_json(value), broken);
    EXPECT_EQ(ordered_json::parse(broken), value);
}

TEST(ReadableJson, KnowsWhatStandsBeforeTheValue) {
    const ordered_json value{std::string(100, 'x'), 1};
    const std::string line = "[\"" + std::string(100, 'x') + "\", 1]";
    EXPECT_EQ(readable_json(value, 4, 119 - line.size()), line);
    EXPECT_EQ(readable_json(value, 4, 120 - line.size()),
              "[\n      \"" + std::string(100, 'x') + "\",\n      1\n    ]");
}

}  // namespace
}  // namespace gumcert::json
