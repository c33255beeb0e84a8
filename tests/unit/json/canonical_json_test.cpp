#include "json/canonical_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "json/strict_parser.h"

namespace gumcert::json {
namespace {

TEST(CanonicalJson, HasOneFormOnly) {
    const nlohmann::json value = nlohmann::json::parse(
        R"({"b": [1, "x", true, null], "a": {"é": 36.0, "z": [[], {}]}, "c": 1e5, "d": 0.1, "e": -0.0, "f": 1e22})");
    EXPECT_EQ(canonical_json(value),
              "{\n \"a\": {\n  \"z\": [\n   [],\n   {}\n  ],\n  \"é\": 36\n },\n \"b\": [1, \"x\", true, null],\n"
              " \"c\": 1e+05,\n \"d\": 0.1,\n \"e\": -0.0,\n \"f\": 1e+22\n}\n");
    EXPECT_EQ(canonical_json(nlohmann::json::parse(canonical_json(value))), canonical_json(value));
    EXPECT_EQ(canonical_json(nlohmann::json("a\"\\\n\x01\x7F/")), "\"a\\\"\\\\\\n\\u0001\\u007f/\"\n");
}

TEST(CanonicalJson, NumbersReadBackTheSame) {
    for (const double v : {5e-324, 1.7976931348623157e308, 0.1, 1.0 / 3.0, 9007199254740993.0, 1152921504606846976.0,
                           123456789012345678.0, -2.5e-7, 100000.0, 4503599627370497.5}) {
        const std::string text = canonical_json(v);
        EXPECT_EQ(nlohmann::json::parse(text).get<double>(), v) << text;
        EXPECT_EQ(canonical_json(nlohmann::json::parse(text)), text);
    }
}

TEST(CanonicalJson, RefusesNestingThatTheReaderWouldRefuse) {
    nlohmann::json deep = 1;
    for (int i = 0; i < 70; ++i) {
        deep = nlohmann::json::array({deep});
    }
    EXPECT_THROW(static_cast<void>(canonical_json(deep)), gum::NoResultError);
}

TEST(CanonicalJson, WritesWhatTheParserReads) {
    nlohmann::json deep = 1;
    for (int i = 0; i < 64; ++i) {
        deep = nlohmann::json{{"a", deep}};
    }
    EXPECT_EQ(parse_faultless(canonical_json(deep), {}), deep);
}

TEST(CanonicalJson, SaysWhereAValueIsThatItRefuses) {
    const auto refusal = [](const nlohmann::json& value) -> std::string {
        try {
            return canonical_json(value);
        } catch (const gum::NoResultError& error) {
            return error.diagnostics().front().code + " " + gum::message(error.diagnostics().front());
        }
    };
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_THAT(refusal({{"a/b", {1.0, infinite}}}), testing::HasSubstr("GC-RECORD-0001 record#/a~1b/1 — infinite"));
    EXPECT_THAT(refusal({{"a", "\xFF"}}), testing::HasSubstr("GC-RECORD-0002 record#/a"));
}

}  // namespace
}  // namespace gumcert::json
