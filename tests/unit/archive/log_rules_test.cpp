#include "archive/log_rules.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gumcert::archive {
namespace {

using nlohmann::json;

const std::string k_record(64, 'a');

/// A log that is told entry by entry; hashes are nothing that these rules look at.
class ToldLog {
public:
    explicit ToldLog(const Settings& settings = {}) {
        EXPECT_EQ(tell("created", "", {{"schema", "gumcert/archive/1"}, {"settings", to_json(settings)}}, "K. Keeper"),
                  "");
    }
    /// \return the rule that is broken; "" where none is
    std::string tell(const std::string& kind, const std::string& certificate, const json& body,
                     const std::string& actor = "A. Author", const std::string& record = "") {
        const std::optional<Breach> breach = rules.accept({.seq = 0,
                                                           .at = at,
                                                           .actor = actor,
                                                           .kind = kind,
                                                           .certificate = certificate,
                                                           .record = record,
                                                           .request_key = "",
                                                           .body = body.dump(),
                                                           .prev = "",
                                                           .hash = ""});
        return breach ? breach->rule : "";
    }
    std::string draft(const std::string& number, const json& more = json::object(),
                      const std::string& actor = "A. Author") {
        const CertificateLife* const life = rules.life(number);
        json body{
            {"old", {{"state", life == nullptr ? "" : life->state}, {"record", life == nullptr ? "" : life->record}}},
            {"new",
             {{"state", "drafted"},
              {"record", k_record},
              {"documents", {{{"name", "a.pdf"}, {"sha256", std::string(64, 'b')}}}}}},
            {"why", "because"}};
        body.update(more);
        return tell("drafted", number, body, actor, k_record);
    }
    std::string step(const std::string& number, const std::string& kind, const std::string& actor = "R. Reviewer",
                     const json& more = json::object()) {
        const CertificateLife* const life = rules.life(number);
        json body{
            {"old", {{"state", life == nullptr ? "" : life->state}}}, {"new", {{"state", kind}}}, {"why", "because"}};
        body["new"].update(more);
        return tell(kind, number, body, actor, life == nullptr ? "" : life->record);
    }
    void issue(const std::string& number) {
        EXPECT_EQ(draft(number), "");
        for (const char* const kind : {"reviewed", "authorised", "issued"}) {
            EXPECT_EQ(step(number, kind), "");
        }
    }
    json amends(const std::string& number, const std::string& kind = "amended") const {
        return {
            {"amends",
             {{"number", number}, {"kind", kind}, {"changes", {{{"where", "l"}, {"before", "1"}, {"after", "2"}}}}}}};
    }

    LogRules rules;
    std::string at = "2026-11-24T18:52:52Z";
};

constexpr const char* k_life_rule =
    "a certificate is drafted, reviewed, authorised, issued; then amended, superseded or withdrawn";

TEST(LifeOfACertificate, GoesStepByStep) {
    ToldLog log;
    EXPECT_EQ(log.step("C", "issued"), k_life_rule);
    EXPECT_EQ(log.draft("C"), "");
    EXPECT_EQ(log.step("C", "authorised"), k_life_rule);
    EXPECT_EQ(log.step("C", "reviewed"), "");
    EXPECT_EQ(log.step("C", "issued"), k_life_rule);
    EXPECT_EQ(log.step("C", "authorised"), "");
    EXPECT_EQ(log.draft("C"), "") << "a draft may take the place of one that is authorised";
    EXPECT_EQ(log.step("C", "issued"), k_life_rule) << "and then everything is done again";
    EXPECT_EQ(log.step("C", "reviewed"), "");
    EXPECT_EQ(log.step("C", "authorised"), "");
    EXPECT_EQ(log.step("C", "issued"), "");
    EXPECT_EQ(log.draft("C"), k_life_rule) << "what is issued is not drafted again";
    EXPECT_EQ(log.step("C", "withdrawn"), "");
    EXPECT_EQ(log.step("C", "issued"), k_life_rule);
    EXPECT_EQ(log.rules.life("C")->state, "withdrawn");
    EXPECT_EQ(log.rules.life("D"), nullptr);
}

TEST(LifeOfACertificate, IsAboutOneRecord) {
    ToldLog log;
    EXPECT_EQ(log.draft("C"), "");
    EXPECT_EQ(log.tell("reviewed", "C", {{"old", {{"state", "drafted"}}}, {"new", {{"state", "reviewed"}}}}, "R",
                       std::string(64, 'c')),
              "what is reviewed, authorised and issued is what was drafted");
    EXPECT_EQ(
        log.tell("reviewed", "C", {{"old", {{"state", "issued"}}}, {"new", {{"state", "reviewed"}}}}, "R", k_record),
        "an entry states the old and the new state");
}

TEST(LifeOfACertificate, HasDocumentsAndReasons) {
    ToldLog log;
    EXPECT_EQ(log.draft("C", {{"new", {{"state", "drafted"}, {"record", k_record}, {"documents", json::array()}}}}),
              "");
    EXPECT_EQ(log.step("C", "reviewed"), "");
    EXPECT_EQ(log.step("C", "authorised"), "");
    EXPECT_EQ(log.step("C", "issued"), "a certificate is issued with its documents");
    EXPECT_EQ(log.tell("withdrawn", "C", {{"old", {{"state", "authorised"}}}, {"new", {{"state", "withdrawn"}}}}, "R",
                       k_record),
              "a certificate or number is withdrawn with a reason");
}

TEST(FourEyes, AreThoseOfAnother) {
    constexpr const char* rule = "nobody reviews or authorises what he has drafted (four eyes)";
    ToldLog log;
    EXPECT_EQ(log.draft("C"), "");
    EXPECT_EQ(log.draft("C", json::object(), "B. Author"), "");
    EXPECT_EQ(log.step("C", "reviewed", "A. Author"), rule) << "who has drafted once is an author for ever";
    EXPECT_EQ(log.step("C", "reviewed", "B. Author"), rule);
    EXPECT_EQ(log.step("C", "reviewed"), "");
    EXPECT_EQ(log.step("C", "authorised", "A. Author"), rule);
    EXPECT_EQ(log.step("C", "authorised"), "");
    EXPECT_EQ(log.step("C", "issued", "A. Author"), "");
    EXPECT_EQ(log.draft("D"), "");
    for (const char* const spelled : {"a. author", "A.  AUTHOR", " A. Author", "A. Author ", "A.\u00A0Author"}) {
        EXPECT_EQ(log.step("D", "reviewed", spelled), rule) << spelled;
    }
    ToldLog alone(Settings{.four_eyes = false, .numbering = ""});
    EXPECT_EQ(alone.draft("C"), "");
    EXPECT_EQ(alone.step("C", "reviewed", "A. Author"), "");
}

TEST(RolesOfPersons, AreNeededWhereTheyAreStated) {
    ToldLog log(
        Settings{.four_eyes = true,
                 .numbering = "",
                 .persons = {{"K. Keeper", {"keeper"}}, {"A. Author", {"author"}}, {"R. Reviewer", {"reviewer"}}}});
    constexpr const char* rule = "whoever does something has the role for it";
    EXPECT_EQ(log.draft("C", json::object(), "N. Obody"), rule);
    EXPECT_EQ(log.draft("C"), "");
    EXPECT_EQ(log.step("C", "reviewed"), "");
    EXPECT_EQ(log.step("C", "authorised"), rule);
    EXPECT_EQ(role_of("numbered"), "author");
    EXPECT_EQ(role_of("issued"), "authoriser");
    EXPECT_EQ(role_of("settings"), "keeper");
}

TEST(CertificateNumbers, FollowWithoutGaps) {
    ToldLog log(Settings{.four_eyes = true, .numbering = "EX-YYYY-##"});
    constexpr const char* rule = "certificate numbers follow each other without gaps";
    const auto take = [&](const std::string& number, int ordinal, const std::string& series = "EX-2026-##") {
        return log.tell(
            "numbered", number,
            {{"old", {{"state", ""}}}, {"new", {{"state", "numbered"}, {"ordinal", ordinal}, {"series", series}}}});
    };
    EXPECT_EQ(take("EX-2026-02", 2), rule);
    EXPECT_EQ(take("EX-2026-01", 1), "");
    EXPECT_EQ(take("EX-2026-01", 1), k_life_rule) << "no number twice";
    EXPECT_EQ(take("EX-2026-03", 3), rule);
    EXPECT_EQ(take("EX-2026-02", 3), rule);
    EXPECT_EQ(take("EX-2027-02", 2, "EX-2027-##"), rule) << "of another year";
    EXPECT_EQ(take("EX-2026-02", 2), "");
    EXPECT_EQ(log.rules.last_ordinal("EX-2026-##"), 2);
    log.at = "2027-01-01T00:00:00Z";
    EXPECT_EQ(take("EX-2027-01", 1, "EX-2027-##"), "");
    EXPECT_NE(log.draft("EX-2026-07"), "") << "a number that was not taken";
    EXPECT_EQ(log.draft("EX-2026-01"), "");
}

TEST(Amendments, EndTheirOriginal) {
    ToldLog log;
    log.issue("C");
    EXPECT_EQ(log.draft("C/A1", log.amends("D")), k_amendable_rule);
    EXPECT_EQ(log.draft("C/A1", log.amends("C")), "");
    EXPECT_EQ(log.step("C", "amended-by", "R. Reviewer", {{"by", "C/A1"}}),
              "an original is amended or superseded when its amendment is issued");
    EXPECT_EQ(log.step("C/A1", "reviewed"), "");
    EXPECT_EQ(log.step("C/A1", "authorised"), "");
    EXPECT_EQ(log.step("C/A1", "issued"), "");
    EXPECT_EQ(log.rules.due(), "amended-by C");
    EXPECT_EQ(log.draft("E"), "an amendment is issued together with the entry of its original");
    EXPECT_EQ(log.step("C", "amended-by", "R. Reviewer", {{"by", "D"}}),
              "an original is amended or superseded when its amendment is issued");
    EXPECT_EQ(log.step("C", "amended-by", "R. Reviewer", {{"by", "C/A1"}}), "");
    EXPECT_EQ(log.rules.due(), "");
    EXPECT_EQ(log.rules.life("C")->later, "C/A1");
    EXPECT_EQ(log.rules.life("C/A1")->amends, "C");
    EXPECT_EQ(log.draft("C/A2", log.amends("C")), k_amendable_rule);
}

/// Where the amendment was withdrawn, neither of the two holds: the original is amended anew, or withdrawn too.
TEST(Amendments, OfWhichOneWasWithdrawnLeaveTheirOriginalOpen) {
    for (const char* const kind : {"amended", "replaced"}) {
        const std::string ended = kind == std::string("amended") ? "amended-by" : "superseded";
        ToldLog log;
        const auto amend = [&](const std::string& original, const std::string& number) {
            EXPECT_EQ(log.draft(number, log.amends(original, kind)), "");
            for (const char* const step : {"reviewed", "authorised", "issued"}) {
                EXPECT_EQ(log.step(number, step), "");
            }
            EXPECT_EQ(log.step(original, ended, "R. Reviewer", {{"by", number}}), "");
        };
        log.issue("C");
        amend("C", "C/A1");
        EXPECT_FALSE(log.rules.may_be_amended("C"));
        EXPECT_EQ(log.step("C", "withdrawn"), k_life_rule) << "its amendment holds";
        EXPECT_EQ(log.draft("C/A2", log.amends("C")), k_amendable_rule);
        EXPECT_EQ(log.step("C/A1", "withdrawn"), "");
        EXPECT_TRUE(log.rules.may_be_amended("C"));
        EXPECT_FALSE(log.rules.may_be_amended("C/A1"));
        EXPECT_EQ(log.draft("C/A2", log.amends("C/A1")), k_amendable_rule);
        EXPECT_EQ(log.step("C", ended, "R. Reviewer", {{"by", "C/A1"}}),
                  "an original is amended or superseded when its amendment is issued");
        EXPECT_EQ(log.draft("C/A3", log.amends("C", kind)), "");
        EXPECT_EQ(log.step("C/A3", "reviewed"), "");
        EXPECT_EQ(log.step("C/A3", "authorised"), "");
        amend("C", "C/A2");
        EXPECT_EQ(log.rules.life("C")->later, "C/A2");
        EXPECT_EQ(log.step("C/A3", "issued"), k_amendable_rule) << "C/A2 has taken the place";
        amend("C/A2", "C/A2/A1");
        EXPECT_EQ(log.step("C/A2/A1", "withdrawn"), "");
        EXPECT_FALSE(log.rules.may_be_amended("C")) << "C/A2 is open, and C is not";
        EXPECT_EQ(log.step("C/A2", "withdrawn"), "");
        EXPECT_EQ(log.step("C", "withdrawn"), "");
        EXPECT_EQ(log.draft("C/A4", log.amends("C")), k_amendable_rule);
    }
}

/// After a clock that was ahead entries have the time of the last one, and say what their own clock said.
TEST(EntriesAfterAWrongClock, HaveTheTimeOfTheEntryBefore) {
    ToldLog log(Settings{.four_eyes = true, .numbering = "EX-YYYY-##"});
    const auto take = [&](const std::string& number, int ordinal, const std::string& series, const json& clock) {
        json body{{"old", {{"state", ""}}}, {"new", {{"state", "numbered"}, {"ordinal", ordinal}, {"series", series}}}};
        body["clock"] = clock;
        return log.tell("numbered", number, body);
    };
    const char* const form = "an entry after a clock that was ahead states the time of its own clock";
    const char* const order = "an entry after a clock that was ahead has the time of the entry before";
    log.at = "2027-01-10T12:00:00Z";
    EXPECT_EQ(take("EX-2027-01", 1, "EX-2027-##", json()), "") << "by the wrong clock";
    for (const json& clock : {json(1), json("2026-11-29"), json("2027-01-10T12:00:00Z"), json("2027-02-01T00:00:00Z"),
                              json("2026-02-30T00:00:00Z"), json("2026-11-29T25:00:00Z")}) {
        EXPECT_EQ(take("EX-2026-01", 1, "EX-2026-##", clock), form) << clock;
    }
    EXPECT_EQ(take("EX-2027-02", 2, "EX-2027-##", "2026-11-29T20:00:00Z"),
              "certificate numbers follow each other without gaps")
        << "the year is that of its clock";
    log.at = "2027-01-10T12:00:01Z";
    EXPECT_EQ(take("EX-2026-01", 1, "EX-2026-##", "2026-11-29T20:00:00Z"), order);
    log.at = "2027-01-10T12:00:00Z";
    EXPECT_EQ(take("EX-2026-01", 1, "EX-2026-##", "2026-11-29T20:00:00Z"), "");
    log.at = "2027-01-11T08:00:00Z";
    EXPECT_EQ(take("EX-2027-02", 2, "EX-2027-##", json()), "") << "its time has come";
    log.rules.go_on_after("2027-01-12T08:00:00Z");
    EXPECT_EQ(take("EX-2027-03", 3, "EX-2027-##", json()), "no entry is earlier than the one before");
}

/// What was issued after a clock that was ahead was issued when its own clock says, not in a month that has not come.
TEST(EntriesAfterAWrongClock, AreIssuedWhenTheirClockSays) {
    ToldLog log;
    log.issue("B");
    EXPECT_EQ(log.rules.life("B")->issued_at, log.at);
    log.at = "2027-01-10T12:00:00Z";
    EXPECT_EQ(log.draft("C"), "");
    for (const char* const kind : {"reviewed", "authorised", "issued"}) {
        const json body{{"old", {{"state", log.rules.life("C")->state}}},
                        {"new", {{"state", kind}}},
                        {"clock", "2026-11-29T20:00:00Z"}};
        EXPECT_EQ(log.tell(kind, "C", body, "R. Reviewer", k_record), "");
    }
    EXPECT_EQ(log.rules.life("C")->issued_at, "2026-11-29T20:00:00Z");
    EXPECT_EQ(log.rules.life("C")->since, log.at) << "no time of the log goes back";
}

/// A number that was taken for an amendment of one certificate is that of no other one, and of no ordinary certificate.
TEST(Amendments, HaveTheNumberOfTheirOriginal) {
    constexpr const char* rule = "a number that was taken for an amendment is one of its original";
    ToldLog log;
    log.issue("C");
    log.issue("D");
    for (int ordinal = 1; ordinal <= 3; ++ordinal) {
        const json now = {{"state", "numbered"}, {"amends", "C"}, {"ordinal", ordinal}, {"series", "C/A"}};
        EXPECT_EQ(log.tell("numbered", "C/A" + std::to_string(ordinal), {{"old", {{"state", ""}}}, {"new", now}}), "");
    }
    EXPECT_EQ(log.draft("C/A1", log.amends("D")), rule);
    EXPECT_EQ(log.draft("C/A1"), rule);
    EXPECT_EQ(log.draft("C/A1", log.amends("C")), "");
    EXPECT_EQ(log.draft("C/A1", log.amends("D")), rule) << "in a later draft neither";
    EXPECT_EQ(log.draft("C/A9", log.amends("C")), "") << "one that was chosen by hand";
}

TEST(Amendments, StateKindReasonAndChanges) {
    constexpr const char* rule = "an amendment states its kind, the reason and what has changed";
    ToldLog log;
    log.issue("C");
    json more = log.amends("C");
    more["amends"]["changes"] = json::array();
    EXPECT_EQ(log.draft("C/A1", more), rule);
    more = log.amends("C", "corrected");
    EXPECT_EQ(log.draft("C/A1", more), rule);
    more = log.amends("C");
    more["why"] = "";
    EXPECT_EQ(log.draft("C/A1", more), rule);
}

TEST(EntriesOfALog, HaveTheirForm) {
    ToldLog log;
    EXPECT_EQ(log.tell("created", "", json::object()), "the first entry, and no other one, is \"created\"");
    EXPECT_EQ(log.tell("numbred", "C", json::object()), "an entry of the archive itself concerns no certificate");
    EXPECT_EQ(log.tell("paid", "", json::object()), "kinds of entries are those of docs/archive.md");
    EXPECT_EQ(log.tell("drafted", "", json::object()), "an entry of a certificate names it");
    EXPECT_EQ(log.draft("C", json::object(), ""), "an entry says who");
    EXPECT_EQ(log.draft("C", json::object(), "A\nB"), "names and keys are plain text");
    EXPECT_EQ(log.draft("C", {{"new", {{"state", "drafted"}, {"record", k_record}}}}),
              "a draft names the record and the documents by their SHA-256");
    log.at = "2026-11-24 18:52:52";
    EXPECT_EQ(log.draft("C"), "an entry says when, such as 2026-11-24T18:52:52Z");
    log.at = "2026-11-24T18:52:51Z";
    EXPECT_EQ(log.draft("C"), "no entry is earlier than the one before");
    EXPECT_TRUE(log.rules.lives().empty());
    LogRules empty;
    const std::optional<Breach> breach = empty.accept({.seq = 1,
                                                       .at = "2026-11-24T18:52:52Z",
                                                       .actor = "A",
                                                       .kind = "created",
                                                       .certificate = "",
                                                       .record = "",
                                                       .request_key = "",
                                                       .body = "[]",
                                                       .prev = "",
                                                       .hash = ""});
    ASSERT_TRUE(breach.has_value());
    EXPECT_EQ(breach->rule, "an entry says what happened");
}

TEST(EntriesOfALog, ChangeSettingsFromTheOldOnes) {
    ToldLog log;
    const Settings changed{.four_eyes = false, .numbering = ""};
    EXPECT_EQ(log.tell("settings", "", {{"old", to_json(changed)}, {"new", to_json(changed)}}),
              "a change of settings states the old and the new ones");
    EXPECT_EQ(log.tell("settings", "", {{"old", to_json(Settings{})}, {"new", to_json(changed)}}), "");
    EXPECT_EQ(log.rules.settings(), changed);
}

TEST(BodyOfAnEntry, IsReadWithoutTrust) {
    LogEntry entry;
    entry.body = "[1]";
    EXPECT_EQ(body_of(entry), std::nullopt);
    entry.body = R"({"new":{"state":1,"documents":{"a":"b"}}})";
    const json body = *body_of(entry);
    EXPECT_EQ(text_in(body, "new", "state"), "");
    EXPECT_EQ(text_in(body, "old", "state"), "");
    EXPECT_TRUE(documents_in(body).empty()) << "documents are a list";
    entry.body = R"({"new":{"documents":[1,{"sha256":"a"}]}})";
    EXPECT_EQ(documents_in(*body_of(entry)), (std::vector<std::string>{"", "a"}));
    EXPECT_TRUE(is_of_life("issued"));
    EXPECT_FALSE(is_of_life("backed-up"));
    EXPECT_EQ(kinds_of_life().size(), 8U);
    LogRules rules;
    rules.take(entry);
    EXPECT_TRUE(rules.lives().empty());
}

TEST(WordedState, IsAPartOfASentence) {
    EXPECT_EQ(worded_state(nullptr), "not in the archive");
    CertificateLife life;
    EXPECT_EQ(worded_state(&life), "not in the archive");
    life.state = "issued";
    EXPECT_EQ(worded_state(&life), "issued");
    life.state = "amended-by";
    EXPECT_EQ(worded_state(&life), "amended");
    life.later = "EX-1/A1";
    EXPECT_EQ(worded_state(&life), "amended by EX-1/A1");
    life.state = "superseded";
    EXPECT_EQ(worded_state(&life), "superseded by EX-1/A1");
    life.state = "withdrawn";
    EXPECT_EQ(worded_state(&life), "withdrawn");
}

}  // namespace
}  // namespace gumcert::archive
