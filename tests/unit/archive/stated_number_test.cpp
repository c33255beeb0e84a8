#include "archive/stated_number.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "archive/archive.h"
#include "archive/evidence.h"
#include "archive/store/sqlite_store.h"
#include "archive/verification.h"
#include "json/canonical_json.h"
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
