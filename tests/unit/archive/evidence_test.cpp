#include "archive/evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
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
        ASSERT_FALSE(verdict.chain.empty());
        EXPECT_EQ(verdict.chain.front().state, one.state);
        std::string number = one.number;
        for (const EvidenceVerdict::Certificate& of_chain : verdict.chain) {
            EXPECT_EQ(of_chain.number, number);
            EXPECT_EQ(of_chain.state, archive.life(number).state);
            number = archive.life(number).later;
        }
        EXPECT_EQ(number, "") << "the end of the chain is not told";
        for (const std::string& sha256 : archive.life(one.number).documents) {
            EXPECT_TRUE(std::any_of(verdict.parts.begin(), verdict.parts.end(),
                                    [&](const auto& part) { return part.sha256 == sha256 && part.holds; }));
        }
        states.insert(verdict.chain.front().state);
    }
    EXPECT_GE(states.size(), 4U) << "the archive of chance has few kinds of certificates";
}

TEST_F(EvidenceOfCertificates, IsOneOfACertificateInTheArchive) {
    EXPECT_EQ(code_of([&] { (void)evidence_of(*store_, "nothing"); }), "GC-ARCHIVE-0026");
    EXPECT_EQ(code_of([&] { (void)evidence_of(*store_, ""); }), "GC-ARCHIVE-0026") << "entries of the archive itself";
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

/// Every entry but the first one, of every certificate, left out: with the statement each one shows, whatever state is left.
TEST_F(EvidenceOfCertificates, ShowsEveryEntryThatWasLeftOutOfAStatement) {
    std::size_t silent_without = 0;
    for (const ListedCertificate& one : list_) {
        Evidence evidence = evidence_of(*store_, one.number);
        evidence.states = states_in(evidence, evidence.head.at);
        evidence.states->signature = {std::string(32, 'k'), std::string(64, 's')};
        evidence.head.signature = evidence.states->signature;
        EXPECT_TRUE(verify_evidence(evidence_from_json(to_json(evidence), "evidence.json")).findings.empty());
        for (std::size_t i = 1; i < evidence.entries.size(); ++i) {
            if (evidence.entries[i].entry.certificate.empty()) {
                continue;  // changes of settings are no entries of a certificate
            }
            Evidence less = evidence;
            less.entries.erase(less.entries.begin() + static_cast<std::ptrdiff_t>(i));
            const EvidenceVerdict verdict = verify_evidence(less);
            EXPECT_TRUE(std::any_of(verdict.findings.begin(), verdict.findings.end(),
                                    [](const gum::Diagnostic& found) {
                                        return found.code == "GC-ARCHIVE-0056" || found.code == "GC-ARCHIVE-0048";
                                    }))
                << one.number << " without entry " << evidence.entries[i].entry.seq;
            less.states.reset();
            silent_without += verify_evidence(less).findings.empty() ? 1U : 0U;
        }
    }
    EXPECT_GT(silent_without, 0U) << "an entry at the end is seen by its statement alone";
}

TEST_F(EvidenceOfCertificates, HasAStatementOfTheSameStates) {
    Evidence evidence = evidence_of(*store_, drafted());
    const auto code = [&](const auto& change) {
        Evidence other = evidence;
        other.states = states_in(evidence, evidence.head.at);
        other.head.signature = other.states->signature;
        const std::string before = signed_bytes(*other.states, other.head, other.certificate);
        change(*other.states);
        EXPECT_NE(signed_bytes(*other.states, other.head, other.certificate), before);
        const EvidenceVerdict verdict = verify_evidence(other);
        return verdict.findings.empty() ? std::string() : verdict.findings.front().code;
    };
    EXPECT_EQ(code([](StateStatement& s) { s.at = "2026-01-01T00:00:00Z"; }), "GC-ARCHIVE-0056");
    EXPECT_EQ(code([](StateStatement& s) { s.at = "soon"; }), "GC-ARCHIVE-0056");
    EXPECT_EQ(code([](StateStatement& s) { s.certificates[0].state = "withdrawn"; }), "GC-ARCHIVE-0056");
    EXPECT_EQ(code([](StateStatement& s) { s.certificates[0].later = "another"; }), "GC-ARCHIVE-0056");
    EXPECT_EQ(code([](StateStatement& s) { s.certificates[0].number = "another"; }), "GC-ARCHIVE-0056");
    EXPECT_EQ(code([](StateStatement& s) { s.certificates[0].entries.pop_back(); }), "GC-ARCHIVE-0056");
    EXPECT_EQ(code([](StateStatement& s) { s.certificates.clear(); }), "GC-ARCHIVE-0056");
    EXPECT_EQ(code([](StateStatement& s) { s.certificates.push_back(s.certificates[0]); }), "GC-ARCHIVE-0056");
}

TEST_F(EvidenceOfCertificates, ProvesThatItExtendsOtherHeads) {
    Archive archive(*store_);
    const Head early = archive.head();
    (void)archive.change_settings({}, {.actor = "K. Keeper",
                                       .at = "2026-06-01T00:00:00Z",
                                       .request_key = "",
                                       .why = "x",
                                       .confirmed_day = "2026-06-01"});
    const Evidence plain = evidence_of(*store_, drafted());
    EXPECT_EQ(verify_evidence(plain, {early}).findings.front().code, "GC-ARCHIVE-0051");
    const Evidence since = evidence_from_json(to_json(evidence_of(*store_, drafted(), early)), "evidence.json");
    EXPECT_TRUE(verify_evidence(since, {early}).findings.empty());
    (void)archive.change_settings({},
                                  {.actor = "K. Keeper", .at = "2026-06-02T00:00:00Z", .request_key = "", .why = "x"});
    EXPECT_EQ(verify_evidence(plain, {archive.head()}).findings.front().code, "GC-ARCHIVE-0051");
    EXPECT_TRUE(verify_evidence(plain, {archive.head_since(plain.head)}).findings.empty());
    Head other = early;
    other.root[0] ^= 1;
    EXPECT_EQ(code_of([&] { (void)evidence_of(*store_, drafted(), other); }), "GC-ARCHIVE-0036");
    other = plain.head;
    other.at = "2026-06-01T00:00:01Z";
    EXPECT_EQ(verify_evidence(plain, {other}).findings.front().code, "GC-ARCHIVE-0045") << "a time that nobody signed";
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
    const std::string digits = good["contents"][0]["base64"].get<std::string>();
    for (const std::string& other : {std::string("*"), digits + "\n", " " + digits, digits + "=", digits + "===="}) {
        wrong = good;
        wrong["contents"][0]["base64"] = other;
        EXPECT_EQ(code(wrong), "GC-ARCHIVE-0047") << other;
    }
    for (const json& other : {json(), json(""), json::object()}) {
        wrong = good;
        wrong["printed_heads"] = other;
        EXPECT_EQ(code(wrong), "GC-ARCHIVE-0047") << other;
    }
}

/// A remark that somebody adds would be read as a part of what was found to be sound.
TEST_F(EvidenceOfCertificates, HoldsNothingThatIsNotProved) {
    Evidence evidence = evidence_of(*store_, drafted());
    evidence.states = states_in(evidence, evidence.head.at);
    evidence.states->signature = {std::string(32, '\3'), std::string(64, '\4')};
    evidence.printed_heads = {{1, evidence.head.archive, {}}};
    const json good = json::parse(to_json(evidence));
    ASSERT_EQ(code_of([&] { (void)evidence_from_json(good.dump(), "evidence.json"); }), "");
    for (const char* const place : {"", "/entries/0", "/contents/0", "/printed_heads/0", "/states", "/states/signature",
                                    "/states/certificates/0", "/head"}) {
        json more = good;
        more[json::json_pointer(place)]["remark"] = "valid until 2031";
        EXPECT_EQ(code_of([&] { (void)evidence_from_json(more.dump(), "evidence.json"); }),
                  std::string_view(place) == "/head" ? "GC-ARCHIVE-0049" : "GC-ARCHIVE-0047")
            << place;
    }
}

}  // namespace
}  // namespace gumcert::archive
