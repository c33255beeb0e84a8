#include "archive/evidence.h"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "archive/archive.h"
#include "archive/store/sqlite_store.h"
#include "tests/support/archive_folder.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using nlohmann::json;
using test::code_of;

class EvidenceOfCertificates : public testing::Test {
protected:
    EvidenceOfCertificates() {
        test::ArchiveOfChance chance(5);
        store_ = create_sqlite_store(folder_.file(), chance.first());
        Archive archive(*store_);
        chance.fill(archive, 25);
        list_ = archive.list();
    }
    /// Codes of what a reader finds after a change of the text.
    template <class Change>
    std::string found_after(const Change& change) {
        json value = json::parse(to_json(evidence_of(*store_, drafted())));
        change(value);
        const EvidenceVerdict verdict = verify_evidence(evidence_from_json(value.dump(), "evidence.json"));
        return verdict.findings.empty() ? "" : verdict.findings.front().code;
    }
    [[nodiscard]] std::string drafted() const {
        for (const ListedCertificate& one : list_) {
            if (one.state == "issued") {
                return one.number;
            }
        }
        return "";
    }

    test::StoreFolder folder_;
    std::unique_ptr<Store> store_;
    std::vector<ListedCertificate> list_;
};

TEST_F(EvidenceOfCertificates, IsSoundForEveryCertificate) {
    Archive archive(*store_);
    std::set<std::string> states;
    for (const ListedCertificate& one : list_) {
        const Evidence read = evidence_from_json(to_json(evidence_of(*store_, one.number)), "evidence.json");
        const EvidenceVerdict verdict = verify_evidence(read, {archive.head()});
        EXPECT_TRUE(verdict.findings.empty()) << one.number << ": " << gum::message(verdict.findings.front());
        EXPECT_EQ(verdict.state, one.state);
        EXPECT_EQ(verdict.later, archive.life(one.number).later);
        states.insert(verdict.state);
    }
    EXPECT_GE(states.size(), 4U) << "the archive of chance has few kinds of certificates";
}

TEST_F(EvidenceOfCertificates, IsOneOfACertificateInTheArchive) {
    EXPECT_EQ(code_of([&] { (void)evidence_of(*store_, "nothing"); }), "GC-ARCHIVE-0026");
}

TEST_F(EvidenceOfCertificates, ShowsWhatWasChanged) {
    const auto last = [](json& value) -> json& { return value["entries"].back(); };
    EXPECT_EQ(found_after([](json&) {}), "");
    EXPECT_EQ(found_after([&](json& v) { last(v)["actor"] = "N. Obody"; }), "GC-ARCHIVE-0040");
    EXPECT_EQ(found_after([&](json& v) { last(v)["hash"] = std::string(64, '0'); }), "GC-ARCHIVE-0040");
    EXPECT_EQ(found_after([&](json& v) { last(v)["proof"].erase(0); }), "GC-ARCHIVE-0048");
    EXPECT_EQ(found_after([&](json& v) { v["head"]["root"] = std::string(64, '0'); }), "GC-ARCHIVE-0048");
    EXPECT_EQ(found_after([&](json& v) { v["head"]["size"] = 1; }), "GC-ARCHIVE-0048");
    EXPECT_EQ(found_after([&](json& v) { v["contents"][0]["base64"] = "AAAA"; }), "GC-ARCHIVE-0044");
    EXPECT_EQ(found_after([&](json& v) { v["contents"].erase(0); }), "GC-ARCHIVE-0044");
    EXPECT_EQ(found_after([&](json& v) {
                  v["contents"].push_back({{"sha256", std::string(64, '0')}, {"base64", ""}});
              }),
              "GC-ARCHIVE-0044");
    EXPECT_EQ(found_after([&](json& v) { v["entries"].erase(0); }), "GC-ARCHIVE-0043") << "the first entry";
    EXPECT_EQ(found_after([&](json& v) { v["certificate"] = "another"; }), "GC-ARCHIVE-0044");
    EXPECT_EQ(found_after([&](json& v) { std::swap(v["entries"][1], v["entries"][2]); }), "GC-ARCHIVE-0043");
}

TEST_F(EvidenceOfCertificates, IsComparedWithHeads) {
    const Evidence evidence = evidence_of(*store_, drafted());
    Head other = evidence.head;
    other.chain[0] ^= 1;
    EXPECT_EQ(verify_evidence(evidence, {other}).findings.front().code, "GC-ARCHIVE-0045");
    other = evidence.head;
    other.archive[0] ^= 1;
    EXPECT_EQ(verify_evidence(evidence, {other}).findings.front().code, "GC-ARCHIVE-0045");
    EXPECT_TRUE(verify_evidence(evidence, {evidence.head}).findings.empty());
}

TEST_F(EvidenceOfCertificates, IsRefusedWhereItHasAnotherForm) {
    const json good = json::parse(to_json(evidence_of(*store_, drafted())));
    const auto code = [](const json& value) {
        return code_of([&] { (void)evidence_from_json(value.dump(), "evidence.json"); });
    };
    EXPECT_EQ(code_of([&] { (void)evidence_from_json("", "evidence.json"); }), "GC-ARCHIVE-0047");
    EXPECT_EQ(code(json::array()), "GC-ARCHIVE-0047");
    for (const auto& [key, value] : good.items()) {
        json wrong = good;
        wrong[key] = 1;
        EXPECT_EQ(code(wrong), key == "head" ? "GC-ARCHIVE-0049" : "GC-ARCHIVE-0047") << key;
        wrong.erase(key);
        EXPECT_EQ(code(wrong), "GC-ARCHIVE-0047") << key;
    }
    for (const auto& [key, value] : good["entries"][0].items()) {
        json wrong = good;
        wrong["entries"][0][key] = json::object();
        EXPECT_EQ(code(wrong), "GC-ARCHIVE-0047") << key;
        wrong["entries"][0].erase(key);
        EXPECT_EQ(code(wrong), "GC-ARCHIVE-0047") << key;
    }
    json wrong = good;
    wrong["entries"][0]["proof"] = {"xyz"};
    EXPECT_EQ(code(wrong), "GC-ARCHIVE-0047");
    wrong = good;
    wrong["contents"][0]["base64"] = "*";
    EXPECT_EQ(code(wrong), "GC-ARCHIVE-0047");
}

}  // namespace
}  // namespace gumcert::archive
