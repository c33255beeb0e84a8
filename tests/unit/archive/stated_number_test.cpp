#include "archive/stated_number.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>

#include "archive/archive.h"
#include "archive/evidence.h"
#include "archive/store/sqlite_store.h"
#include "archive/verification.h"
#include "json/canonical_json.h"
#include "json/members.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using nlohmann::json;

/// As this program writes it, and as another one might: on one line, with other blanks, with an escape.
TEST(StatedNumber, IsThatOfTheCertificateOrReport) {
    for (const std::string number : {"EX-1", "EX \"2\"", "校-3", ""}) {
        for (const auto& [outer, inner] : {std::pair("certificate", "data"), std::pair("comparison", "issuer")}) {
            json record{{"job", {{"number", "X-1"}}}, {"results", {{"data", {{"number", "X-2"}}}}}, {"title", "t"}};
            record[outer] = {
                {inner, {{"amendment", {{"number", "X-3"}}}, {"number", number}, {"z", {{"number", "X"}}}}},
                {"a", {{"data", {{"number", "X-4"}}}, {"issuer", {{"number", "X-5"}}}}}};
            record["certificate"]["language"] = "en";
            for (const std::string& text :
                 {gumcert::json::canonical_json(record), record.dump(), record.dump(4), record.dump(-1, ' ', true)}) {
                EXPECT_EQ(number_stated_in(text), number) << text;
            }
        }
    }
}

/// Objects in which keys of the number stand in all places, written in lines of which some are indented otherwise.
class WrittenOtherwise {
public:
    explicit WrittenOtherwise(unsigned seed) : random_(seed) {}

    std::string text() {
        nlohmann::ordered_json record = object(0);
        for (const auto& [outer, inner] : {std::pair("certificate", "data"), std::pair("comparison", "issuer")}) {
            if (random_() % 4 > 0) {
                record[outer] = {{inner, {{"number", value(9)}, {"z", {{"number", "N"}}}}}};
            }
        }
        return (random_() % 2 > 0 ? written(json(record), 1) : written(record, 1)) + "\n";
    }

private:
    std::mt19937 random_;

    nlohmann::ordered_json object(int depth) {
        static constexpr std::array k_keys{"certificate", "comparison", "data", "issuer", "number", "x", "y"};
        nlohmann::ordered_json made = nlohmann::ordered_json::object();
        for (auto i = random_() % 5; i > 0; --i) {
            const std::string key = k_keys[random_() % k_keys.size()];
            made[key] = key == "number" ? value(9) : value(depth + 1);
        }
        return made;
    }
    nlohmann::ordered_json value(int depth) {
        static constexpr std::array k_texts{"A", "B", "C\"\\", "\u6821", "", "\": {\n", "\u007f"};
        const auto kind = random_() % 8;
        return depth < 4 && kind < 4 ? object(depth)
               : kind == 4           ? nlohmann::ordered_json(7)
               : kind == 5           ? nlohmann::ordered_json::array({"A", nlohmann::ordered_json::object()})
                                     : nlohmann::ordered_json(k_texts[random_() % k_texts.size()]);
    }
    template <typename Json>
    std::string written(const Json& value, int depth) {
        if (!value.is_object() || value.empty() || random_() % 16 == 0) {
            return value.dump(-1, ' ', random_() % 4 == 0);
        }
        const int indent = std::max(depth + (random_() % 16 == 0 ? static_cast<int>(random_() % 3) - 1 : 0), 0);
        std::string lines;
        for (const auto& [key, item] : value.items()) {
            lines += (lines.empty() ? "{\n" : ",\n") + std::string(static_cast<std::size_t>(indent), ' ') + '"' + key +
                     "\": " + written(item, depth + 1);
        }
        return lines + "\n" + std::string(static_cast<std::size_t>(depth - 1), ' ') + "}";
    }
};

/// What is found in lines is what is read as JSON: no line stands in for another place.
TEST(StatedNumber, IsThatOfTheJsonHoweverItIsWritten) {
    WrittenOtherwise written(4);
    std::size_t stated = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::string text = written.text();
        const json record = json::parse(text);
        const auto number_at = [&](const char* outer, const char* inner) {
            return gumcert::json::text_of(gumcert::json::part_of(gumcert::json::part_of(record, outer), inner),
                                          "number");
        };
        const std::string number = number_at("certificate", "data");
        EXPECT_EQ(number_stated_in(text), number.empty() ? number_at("comparison", "issuer") : number) << text;
        stated += number.empty() ? 0U : 1U;
    }
    EXPECT_GT(stated, 4000U);
    EXPECT_EQ(number_stated_in("{\"certificate\": {\"data\": {\"number\": \"B\"}}, \"y\": {\n \"certificate\": {\n  "
                               "\"data\": {\n   \"number\": \"A\"\n}}}}\n"),
              "B");
}

TEST(StatedNumber, IsNoneWhereNoneIsStated) {
    for (const char* const text :
         {"", "no record", "{", "{\n", "{}", "[]", "{\n \"certificate\": {\n  \"data\": {\n   \"number\": \"EX-1",
          "{\n \"certificate\": {\n  \"data\": {\n   \"number\": 7\n  }\n }\n}\n",
          "{\n \"certificate\": {\n  \"data\": {\n  },\n  \"x\": {\n   \"number\": \"EX-1\"\n  }\n }\n}\n",
          "{\n \"certificate\": {\n },\n \"x\": {\n  \"data\": {\n   \"number\": \"EX-1\"\n  }\n }\n}\n",
          R"({"certificate": {"data": {"number": "EX-1", "number": "EX-2"}}})", R"({"certificate": {"data": []}})"}) {
        EXPECT_EQ(number_stated_in(text), "") << text;
    }
}

/// A record under the number of another certificate: whoever wrote it, and however well the hashes fit.
TEST(StatedNumber, IsThatOfTheEntries) {
    test::StoreFolder folder;
    test::Clock clock;
    const auto by = [&](const char* who) {
        return Request{.actor = who, .at = clock.next(), .request_key = "", .why = ""};
    };
    const auto store = create_sqlite_store(folder.file(), first_entry({}, "gumcert", "nonce", by("K. Keeper")));
    Archive archive(*store);
    (void)archive.draft(test::sample_draft("EX-1"), by("A. Author"));
    EXPECT_TRUE(verify_store(*store, {}).sound());
    Draft other = test::sample_draft("EX-2");
    other.record = test::sample_draft("EX-1").record;
    (void)archive.draft(other, by("A. Author"));
    const std::vector<gum::Diagnostic> found = verify_store(*store, {}).findings;
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "GC-ARCHIVE-0043");
    EXPECT_EQ(found[0].where, "entry 3");
    EXPECT_EQ(found[0].what, "its record states the number \"EX-1\"");
    EXPECT_TRUE(verify_evidence(evidence_of(*store, "EX-1"), {}).findings.empty());
    const std::vector<gum::Diagnostic> in_evidence = verify_evidence(evidence_of(*store, "EX-2"), {}).findings;
    ASSERT_EQ(in_evidence.size(), 1U);
    EXPECT_EQ(in_evidence[0].what, found[0].what);
}

}  // namespace
}  // namespace gumcert::archive
