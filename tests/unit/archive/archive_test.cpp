#include "archive/archive.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <tuple>

#include "archive/evidence.h"
#include "archive/store/open_store.h"
#include "archive/verification.h"
#include "encoding/sha2.h"
#include "tests/support/both_stores.h"
#include "tests/support/sample_archive.h"

namespace gumcert::archive {
namespace {

using test::code_of;
using test::sample_draft;

template <class Kind>
class ArchiveLaws : public test::OnBothStores<Kind> {
protected:
    void prepare() override {
        store_ = create_store(this->kind_.new_place(), first_entry({.four_eyes = true, .numbering = "EX-YYYY-###"},
                                                                   "gumcert", "nonce", by("K. Keeper")));
        archive_ = std::make_unique<Archive>(*store_);
    }

    Request by(const std::string& who, const std::string& why = "", const std::string& key = "") {
        return {.actor = who, .at = clock_.next(), .request_key = key, .why = why};
    }
    /// A certificate with the next number.
    std::string issued() {
        const std::string number = archive_->take_number(by("A. Author")).entry.certificate;
        (void)archive_->draft(sample_draft(number), by("A. Author"));
        lead_to_issue(number);
        return number;
    }
    void lead_to_issue(const std::string& number) {
        for (const char* const kind : {"reviewed", "authorised", "issued"}) {
            (void)archive_->advance(number, kind, by("R. Reviewer"));
        }
    }

    test::Clock clock_;
    std::unique_ptr<Store> store_;
    std::unique_ptr<Archive> archive_;
};
TYPED_TEST_SUITE(ArchiveLaws, test::BothStores);

/// Entries of the archive itself (its begin, its settings, its backups) have no certificate: the number "" is none, whatever
/// is asked of it.
TYPED_TEST(ArchiveLaws, HasNoCertificateWithoutANumber) {
    (void)this->issued();
    (void)this->archive_->change_settings({.four_eyes = false, .numbering = "EX-YYYY-###"},
                                          this->by("K. Keeper", "one person"));
    const Head before = this->archive_->head();
    const std::vector<std::function<void()>> asked{
        [&] { (void)this->archive_->life(""); },
        [&] { (void)this->archive_->history(""); },
        [&] { (void)this->archive_->record_of(""); },
        [&] { (void)this->archive_->take_amendment_number("", this->by("A. Author")); },
        [&] { (void)this->archive_->advance("", "reviewed", this->by("R. Reviewer")); },
        [&] { (void)this->archive_->advance("", "authorised", this->by("R. Reviewer")); },
        [&] { (void)this->archive_->advance("", "issued", this->by("R. Reviewer")); },
        [&] { (void)this->archive_->advance("", "withdrawn", this->by("R. Reviewer", "no reason")); }};
    for (std::size_t i = 0; i < asked.size(); ++i) {
        EXPECT_EQ(code_of(asked[i]), "GC-ARCHIVE-0026") << i;
    }
    EXPECT_EQ(this->archive_->head(), before) << "nothing is written";
}

TYPED_TEST(ArchiveLaws, LeadsACertificateThroughItsLife) {
    const std::string number = this->issued();
    EXPECT_EQ(number, "EX-2026-001");
    const CertificateLife life = this->archive_->life(number);
    EXPECT_EQ(life.state, "issued");
    EXPECT_EQ(life.documents.size(), 2U);
    EXPECT_EQ(this->archive_->record_of(number), sample_draft(number).record);
    EXPECT_EQ(this->archive_->history(number).size(), 5U);
    const std::vector<ListedCertificate> list = this->archive_->list();
    ASSERT_EQ(list.size(), 1U);
    EXPECT_EQ(list[0].state, "issued");
    EXPECT_EQ(list[0].item, "End gauge, SN-1");
    (void)this->archive_->advance(number, "withdrawn", this->by("R. Reviewer", "the standard was wrong"));
    EXPECT_EQ(this->archive_->life(number).state, "withdrawn");
    EXPECT_TRUE(verify_store(*this->store_).sound());
}

TYPED_TEST(ArchiveLaws, NumbersAmendmentsWithoutGapOrDouble) {
    const std::string number = this->issued();
    const auto next = [&] {
        return this->archive_->take_amendment_number(number, this->by("A. Author")).entry.certificate;
    };
    const auto amend = [&](const std::string& amendment) {
        Draft draft = sample_draft(amendment);
        draft.amends = Draft::Amends{.number = number, .kind = "amended", .changes = {{"U", "l", "1", "2"}}};
        (void)this->archive_->draft(draft, this->by("A. Author", "a digit"));
    };
    EXPECT_EQ(next(), number + "/A1");
    amend(number + "/A2");  // by hand
    EXPECT_EQ(next(), number + "/A3");
    amend(number + "/A5");
    EXPECT_EQ(next(), number + "/A4");
    EXPECT_EQ(next(), number + "/A6");
    EXPECT_EQ(this->issued(), "EX-2026-002") << "the series of the archive goes on";
    const Request again = this->by("A. Author", "", "key");
    const Written first = this->archive_->take_amendment_number(number, again);
    EXPECT_EQ(first.entry.certificate, number + "/A7");
    EXPECT_EQ(this->archive_->take_amendment_number(number, again).entry, first.entry);
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_amendment_number("EX-2026-999", this->by("A. Author")); }),
              "GC-ARCHIVE-0026");
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_amendment_number(number + "/A1", this->by("A. Author")); }),
              "GC-ARCHIVE-0031")
        << "it is not issued";
    amend(number + "/A1");
    this->lead_to_issue(number + "/A1");
    EXPECT_EQ(code_of([&] { (void)next(); }), "GC-ARCHIVE-0031") << "it is amended already";
    EXPECT_TRUE(verify_store(*this->store_).sound());
}

TYPED_TEST(ArchiveLaws, TellsPersonsAndNumbersApart) {
    const std::string number = this->archive_->take_number(this->by("René Lin")).entry.certificate;
    (void)this->archive_->draft(sample_draft(number), this->by("René Lin"));
    const auto reviewed = [&](const std::string& who) {
        return code_of([&] { (void)this->archive_->advance(number, "reviewed", this->by(who)); });
    };
    for (const char* const hidden : {"René Lin ", "René  Lin", "Rene\u0301 Lin", "R\u0435né Lin", "René\u200BLin"}) {
        EXPECT_EQ(reviewed(hidden), "GC-ARCHIVE-0033") << hidden;
    }
    for (const char* const same : {"René Lin", "rené lin", "RENÉ LIN", "Rene Lin", "René-Lin"}) {
        EXPECT_EQ(reviewed(same), "GC-ARCHIVE-0022") << same;
    }
    const Settings free{.four_eyes = true, .numbering = ""};
    (void)this->archive_->change_settings(free, this->by("K. Keeper", "numbers come from elsewhere"));
    const auto drafted = [&](const std::string& other) {
        return code_of([&] { (void)this->archive_->draft(sample_draft(other), this->by("A. Author")); });
    };
    EXPECT_EQ(drafted("X-1"), "");
    for (const char* const alike : {"x-1", "\u0425-1", "X\u20111"}) {
        EXPECT_EQ(drafted(alike), "GC-ARCHIVE-0024") << alike;
    }
    EXPECT_EQ(drafted("X-1\u200B"), "GC-ARCHIVE-0033");
    EXPECT_EQ(drafted("X-11"), "");
    const auto settled = [&](const std::map<std::string, std::set<std::string>>& persons) {
        Settings settings = free;
        settings.persons = persons;
        return code_of([&] { (void)this->archive_->change_settings(settings, this->by("K. Keeper", "persons")); });
    };
    EXPECT_EQ(settled({{"R. Lin", {"author"}}}), "GC-ARCHIVE-0033") << "nobody is a keeper";
    EXPECT_EQ(settled({{"K. Keeper", {"keeper"}}, {"R. Lin", {"author"}}, {"r. lin", {"authoriser"}}}),
              "GC-ARCHIVE-0033");
    EXPECT_EQ(settled({{"K. Keeper", {"keeper"}}, {"R. Lin ", {"reviewer"}}}), "GC-ARCHIVE-0033");
    EXPECT_EQ(settled({{"K. Keeper", {"keeper"}}, {"R. Lin", {"author"}}}), "");
    EXPECT_TRUE(verify_store(*this->store_).sound());
}

/// An entry with a time in the future stops the archive until then: a person confirms the day.
TYPED_TEST(ArchiveLaws, AsksForTheDayAfterAWeekAndInANewYear) {
    const std::string last = this->archive_->take_number(this->by("A. Author")).entry.at;
    ASSERT_EQ(last.substr(0, 10), "2026-01-01");
    const auto taken = [&](const std::string& at, const std::string& day) {
        Request request = this->by("A. Author");
        request.at = at;
        request.confirmed_day = day;
        return code_of([&] { (void)this->archive_->take_number(request); });
    };
    EXPECT_EQ(taken("2026-01-09T00:00:00Z", ""), "GC-ARCHIVE-0065");
    EXPECT_EQ(taken("2036-01-01T00:00:00Z", ""), "GC-ARCHIVE-0065");
    EXPECT_EQ(taken("2036-01-01T00:00:00Z", "2026-01-01"), "GC-ARCHIVE-0065");
    EXPECT_EQ(taken("2026-01-08T23:59:59Z", ""), "");
    EXPECT_EQ(taken("2026-12-30T23:00:00Z", "2026-12-31"), "") << "the day of another place";
    EXPECT_EQ(taken("2027-01-02T00:00:00Z", ""), "GC-ARCHIVE-0065") << "numbers of another year";
    Request settled = this->by("K. Keeper");
    settled.at = "2027-01-02T00:00:00Z";
    EXPECT_NO_THROW((void)this->archive_->change_settings(this->archive_->settings(), settled)) << "it has no year";
    EXPECT_EQ(taken("2027-12-31T23:59:59Z", "2027-12-31"), "");
    EXPECT_EQ(taken("2028-01-01T00:00:01Z", ""), "") << "who works at night";
    EXPECT_EQ(taken("2028-03-01T00:00:00Z", "2028-03-01"), "");
    EXPECT_EQ(taken("2028-03-01T00:00:01Z", ""), "");
}

/// A clock was ahead over New Year, and is right now: nothing is lost, nothing waits, and every entry says what it knew.
TYPED_TEST(ArchiveLaws, GoesOnAfterAClockThatWasAhead) {
    const auto at = [&](const std::string& who, const std::string& when, const std::string& day = "") {
        Request request = this->by(who, "because");
        request.at = when;
        request.confirmed_day = day;
        return request;
    };
    const std::string number = this->issued();
    const std::string wrong = "2027-01-10T12:00:00Z";
    EXPECT_EQ(this->archive_->take_number(at("A. Author", wrong, "2027-01-10")).entry.certificate, "EX-2027-001");
    const std::string now = "2026-01-02T08:00:00Z";
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_number(at("A. Author", now)); }), "GC-ARCHIVE-0032");
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_number(at("A. Author", now, "2027-01-10")); }),
              "GC-ARCHIVE-0032")
        << "the day of the wrong clock";
    const LogEntry next = this->archive_->take_number(at("A. Author", now, "2026-01-02")).entry;
    EXPECT_EQ(next.certificate, "EX-2026-002") << "of the year that it is";
    EXPECT_EQ(next.at, wrong);
    EXPECT_EQ(nlohmann::json::parse(next.body)["clock"], now);
    const Head head = this->archive_->head();
    EXPECT_EQ(head.at, wrong);
    EXPECT_EQ(head.clock, now);
    EXPECT_EQ(
        code_of([&] { (void)this->archive_->take_number(at("A. Author", "2025-12-31T12:00:00Z", "2025-12-31")); }),
        "GC-ARCHIVE-0032")
        << "a number of the last year";
    (void)this->archive_->advance("EX-2027-001", "withdrawn", at("R. Reviewer", now, "2026-01-02"));
    Draft amendment = sample_draft(
        this->archive_->take_amendment_number(number, at("A. Author", now, "2026-01-02")).entry.certificate, "2");
    amendment.amends = Draft::Amends{number, "replaced", {{"U", "l", "0.1", "0.2"}}};
    (void)this->archive_->draft(amendment, at("A. Author", now, "2026-01-02"));
    for (const char* const kind : {"reviewed", "authorised", "issued"}) {
        (void)this->archive_->advance(amendment.number, kind, at("R. Reviewer", now, "2026-01-02"));
    }
    EXPECT_EQ(this->archive_->life(number).state, "superseded");
    (void)this->archive_->change_settings(this->archive_->settings(), at("K. Keeper", now, "2026-01-02"));
    EXPECT_EQ(this->archive_->take_number(at("A. Author", "2027-01-11T08:00:00Z")).entry.certificate, "EX-2027-002");
    const Verification verification = verify_store(*this->store_, {head});
    EXPECT_TRUE(verification.sound()) << verification.findings.front().what;
    EXPECT_EQ(verification.head->size, this->archive_->head().size);
    EXPECT_EQ(verification.set_back.ahead, 1);
    Head other = head;
    other.clock.clear();
    EXPECT_TRUE(verify_store(*this->store_, {other}).sound()) << "a head from before clocks were stated";
    other.clock = "2026-01-02T08:00:01Z";
    EXPECT_FALSE(verify_store(*this->store_, {other}).sound());
    for (const std::string& one : {number, amendment.number}) {
        EXPECT_TRUE(verify_evidence(evidence_of(*this->store_, one, std::nullopt), {}, {}).findings.empty()) << one;
    }
}

/// Evidence whose last entry is of a clock that was set right: its head says what that said, and the statement goes by it.
TYPED_TEST(ArchiveLaws, GivesEvidenceAfterAClockThatWasAhead) {
    Request request = this->by("R. Reviewer", "because");
    const std::string number = this->issued();
    request.at = request.confirmed_day = "2027-01-10T12:00:00Z";
    (void)this->archive_->change_settings(this->archive_->settings(), request);
    request.at = request.confirmed_day = "2026-01-02T08:00:00Z";
    (void)this->archive_->advance(number, "withdrawn", request);
    Evidence evidence = evidence_of(*this->store_, number, std::nullopt);
    EXPECT_EQ(evidence.head.clock, request.at);
    const auto is_sound = [&](const std::string& clock, const std::string& stated) {
        evidence.head.clock = clock;
        evidence.states = states_in(evidence, stated);
        return verify_evidence(evidence, {}, {}).findings.size() == 1;  // no key has signed it
    };
    EXPECT_TRUE(is_sound(request.at, request.at));
    EXPECT_FALSE(is_sound(request.at, "2026-01-02T07:59:59Z")) << "before its head";
    EXPECT_FALSE(is_sound("2026-01-02T08:00:01Z", "2026-01-03T08:00:00Z")) << "the entry says otherwise";
    EXPECT_TRUE(is_sound("", evidence.head.at)) << "as it was written before";
    EXPECT_FALSE(is_sound("", request.at));
}

/// An amendment was wrong itself, and is taken back: the next one takes its place, or the original is withdrawn as well.
TYPED_TEST(ArchiveLaws, AmendsAnOriginalWhoseAmendmentWasWithdrawn) {
    const std::string number = this->issued();
    const auto amend = [&] {
        Draft draft =
            sample_draft(this->archive_->take_amendment_number(number, this->by("A. Author")).entry.certificate, "2");
        draft.amends = Draft::Amends{number, "amended", {{"U", "l", "0.1", "0.2"}}};
        (void)this->archive_->draft(draft, this->by("A. Author", "U was too small"));
        this->lead_to_issue(draft.number);
        return draft.number;
    };
    const auto withdraw = [&](const std::string& one) {
        return code_of(
            [&] { (void)this->archive_->advance(one, "withdrawn", this->by("R. Reviewer", "of another item")); });
    };
    EXPECT_EQ(amend(), number + "/A1");
    EXPECT_EQ(withdraw(number), "GC-ARCHIVE-0021") << "its amendment holds";
    try {
        (void)this->archive_->take_amendment_number(number, this->by("A. Author"));
        ADD_FAILURE() << "its amendment holds";
    } catch (const gum::InputError& refusal) {
        EXPECT_EQ(refusal.diagnostics().front().where, number);
        EXPECT_EQ(refusal.diagnostics().front().what, "certificate " + number + " is amended by " + number + "/A1");
    }
    EXPECT_EQ(withdraw(number + "/A1"), "");
    EXPECT_EQ(amend(), number + "/A2");
    EXPECT_EQ(this->archive_->life(number).later, number + "/A2");
    EXPECT_EQ(withdraw(number + "/A2"), "");
    EXPECT_EQ(withdraw(number), "");
    EXPECT_EQ(code_of([&] { (void)amend(); }), "GC-ARCHIVE-0031");
    const Verification verification = verify_store(*this->store_);
    EXPECT_TRUE(verification.sound()) << verification.findings.front().what;
    for (const char* const one : {"", "/A1", "/A2"}) {
        const Evidence evidence = evidence_of(*this->store_, number + one, std::nullopt);
        EXPECT_TRUE(verify_evidence(evidence, {}, {}).findings.empty()) << one;
    }
}

/// Every request that writes, once with a key and once more with each of its parts changed.
TYPED_TEST(ArchiveLaws, AKeyBelongsToOneRequest) {
    const std::string number = this->issued();
    const std::string other = this->issued();
    const std::string draft = this->archive_->take_number(this->by("A. Author")).entry.certificate;
    using Ask = std::function<Written(const Request&)>;
    struct Case {
        const char* name;
        Ask ask;
        std::vector<Ask> others;
    };
    const auto with = [](Draft changed, const std::function<void(Draft&)>& change) {
        change(changed);
        return changed;
    };
    const Draft whole = sample_draft(draft);
    const auto drafted = [&](const std::function<void(Draft&)>& change) -> Ask {
        return [&, change](const Request& request) { return this->archive_->draft(with(whole, change), request); };
    };
    const auto advanced = [&](const std::string& certificate, const std::string& kind) -> Ask {
        return [&, certificate, kind](const Request& request) {
            return this->archive_->advance(certificate, kind, request);
        };
    };
    const auto numbered = [&](const std::string& original) -> Ask {
        return [&, original](const Request& request) {
            return original.empty() ? this->archive_->take_number(request)
                                    : this->archive_->take_amendment_number(original, request);
        };
    };
    const auto settled = [&](bool four_eyes) -> Ask {
        return [&, four_eyes](const Request& request) {
            return this->archive_->change_settings({.four_eyes = four_eyes, .numbering = "EX-YYYY-###"}, request);
        };
    };
    const auto backed_up = [&](const std::string& file) -> Ask {
        return [&, file, head = this->archive_->head()](const Request& request) {
            return this->archive_->note_backup(file, head, request);
        };
    };
    const std::vector<Case> cases = {
        {"number", numbered(""), {numbered(number), advanced(draft, "withdrawn")}},
        {"amendment", numbered(number), {numbered(""), numbered(other)}},
        {"draft",
         drafted([](Draft&) {}),
         {drafted([](Draft& d) {
              d.documents.push_back({"more.xml", "application/xml", "<more/>"});
          }),
          drafted([](Draft& d) { d.documents.pop_back(); }), drafted([](Draft& d) { d.item = "another"; }),
          drafted([](Draft& d) { d.record += " "; }), drafted([](Draft& d) { d.documents[0].name = "other.pdf"; }),
          drafted([&](Draft& d) {
              d.amends = Draft::Amends{.number = number, .kind = "amended", .changes = {{"U", "l", "1", "2"}}};
          })}},
        {"withdraw", advanced(other, "withdrawn"), {advanced(number, "withdrawn")}},
        {"settings", settled(false), {settled(true)}},
        {"backup", backed_up("a"), {backed_up("b")}}};
    for (const Case& one : cases) {
        const Request request = this->by("R. Reviewer", "a reason", one.name);
        const Written first = one.ask(request);
        EXPECT_FALSE(first.repeated) << one.name;
        Request again = request;
        again.at = this->clock_.next();
        const Written repeated = one.ask(again);
        EXPECT_TRUE(repeated.repeated) << one.name;
        EXPECT_EQ(repeated.entry, first.entry) << one.name;
        const Head before = this->archive_->head();
        for (const Ask& ask : one.others) {
            EXPECT_EQ(code_of([&] { (void)ask(again); }), "GC-ARCHIVE-0027")
                << one.name << ' ' << &ask - one.others.data();
        }
        again.why = "another reason";
        EXPECT_EQ(code_of([&] { (void)one.ask(again); }), "GC-ARCHIVE-0027") << one.name;
        again = request;
        again.actor = "N. Obody";
        EXPECT_EQ(code_of([&] { (void)one.ask(again); }), "GC-ARCHIVE-0027") << one.name;
        EXPECT_EQ(this->archive_->head(), before) << one.name;
    }
    EXPECT_TRUE(verify_store(*this->store_).sound());
}

TYPED_TEST(ArchiveLaws, AReviewWithAKeyIsOfOneDraft) {
    const std::string number = this->archive_->take_number(this->by("A. Author")).entry.certificate;
    (void)this->archive_->draft(sample_draft(number), this->by("A. Author"));
    const Request review = this->by("R. Reviewer", "", "key");
    (void)this->archive_->advance(number, "reviewed", review);
    EXPECT_TRUE(this->archive_->advance(number, "reviewed", review).repeated);
    (void)this->archive_->draft(sample_draft(number, "2"), this->by("A. Author"));
    EXPECT_EQ(code_of([&] { (void)this->archive_->advance(number, "reviewed", review); }), "GC-ARCHIVE-0027");
}

/// The same record with other documents, or by another author, is another draft too.
TYPED_TEST(ArchiveLaws, AJudgementWithAKeyIsOfOneDraftWhateverTheNextOneSharesWithIt) {
    const std::string number = this->archive_->take_number(this->by("A. Author")).entry.certificate;
    const Draft draft = sample_draft(number);
    const Request first = this->by("A. Author", "", "draft");
    (void)this->archive_->draft(draft, first);
    const Request review = this->by("R. Reviewer", "", "review");
    const Request authorisation = this->by("R. Reviewer", "", "authorise");
    (void)this->archive_->advance(number, "reviewed", review);
    (void)this->archive_->advance(number, "authorised", authorisation);
    EXPECT_TRUE(this->archive_->draft(draft, first).repeated) << "steps that go on from it";
    EXPECT_TRUE(this->archive_->advance(number, "reviewed", review).repeated);
    Draft other = draft;
    other.documents = {{"certificate.html", "text/html", "<html>another</html>"}};
    (void)this->archive_->draft(other, this->by("Z. Other"));
    const Head before = this->archive_->head();
    EXPECT_EQ(code_of([&] { (void)this->archive_->advance(number, "reviewed", review); }), "GC-ARCHIVE-0027");
    EXPECT_EQ(code_of([&] { (void)this->archive_->advance(number, "authorised", authorisation); }), "GC-ARCHIVE-0027");
    EXPECT_EQ(code_of([&] { (void)this->archive_->draft(draft, first); }), "GC-ARCHIVE-0027");
    EXPECT_EQ(this->archive_->head(), before);
    EXPECT_EQ(this->archive_->life(number).state, "drafted");
}

/// Law: whatever was asked for in between, a request with a key that is asked again gets its entry, or is refused and writes nothing;
/// and it gets its entry exactly where what the entry says is so still.
TYPED_TEST(ArchiveLaws, ARequestAskedAgainIsAnsweredWhileItHolds) {
    struct Asked {
        std::string kind;
        std::function<Written(const Request&)> ask;
        Request request;
        LogEntry entry;
    };
    std::mt19937 random(17);  // NOLINT(cert-msc51-cpp): the same sequences each time
    const auto chance = [&](std::size_t of) { return static_cast<std::size_t>(random() % of); };
    int held = 0;
    int refused = 0;
    std::vector<Asked> all;
    std::vector<std::string> numbers;
    bool four_eyes = true;
    for (int step = 0; step < 120; ++step) {
        Asked one;
        const std::string number = numbers.empty() ? "" : numbers[chance(numbers.size())];
        const std::size_t what = chance(12);
        std::string who = "R. Reviewer";
        if (number.empty() || what == 0) {
            one.kind = "numbered";
            one.ask = [&](const Request& r) { return this->archive_->take_number(r); };
            who = "A. Author";
        } else if (what == 1) {
            four_eyes = !four_eyes;
            one.kind = "settings";
            one.ask = [&, four_eyes](const Request& r) {
                return this->archive_->change_settings({.four_eyes = four_eyes, .numbering = "EX-YYYY-###"}, r);
            };
        } else if (what < 5) {
            Draft draft = sample_draft(number, std::to_string(chance(2)));
            draft.documents.resize(1 + chance(2));
            one.kind = "drafted";
            one.ask = [&, draft](const Request& r) { return this->archive_->draft(draft, r); };
            who = chance(2) == 0 ? "A. Author" : "Z. Other";
        } else {
            const std::string state = this->archive_->life(number).state;
            one.kind = what == 5             ? "withdrawn"
                       : state == "drafted"  ? "reviewed"
                       : state == "reviewed" ? "authorised"
                                             : "issued";
            one.ask = [&, number, kind = one.kind](const Request& r) {
                return this->archive_->advance(number, kind, r);
            };
        }
        one.request = this->by(who, "a reason", "key " + std::to_string(step));
        if (code_of([&] { one.entry = one.ask(one.request).entry; }).empty()) {
            if (one.kind == "numbered") {
                numbers.push_back(one.entry.certificate);
            }
            all.push_back(one);
        }
        for (int again = 0; again < 3 && !all.empty(); ++again) {
            const Asked& earlier = all[chance(all.size())];
            bool holds = true;  // in the words of the documentation
            for (const Asked& later : all) {
                const bool is_later = later.entry.seq > earlier.entry.seq;
                const bool is_of_it = later.entry.certificate == earlier.entry.certificate;
                holds =
                    holds && !(is_later && is_of_it &&
                               (later.kind == "withdrawn" || (later.kind == "drafted" && earlier.kind != "numbered") ||
                                (later.kind == "settings" && earlier.kind == "settings")));
            }
            const Head before = this->archive_->head();
            Request request = earlier.request;
            request.at = this->clock_.next();
            Written answer;
            const std::string code = code_of([&] { answer = earlier.ask(request); });
            EXPECT_EQ(this->archive_->head(), before);
            EXPECT_EQ(code, holds ? "" : "GC-ARCHIVE-0027") << earlier.kind << " of entry " << earlier.entry.seq;
            if (code.empty()) {
                EXPECT_TRUE(answer.repeated);
                EXPECT_EQ(answer.entry, earlier.entry);
            }
            ++(holds ? held : refused);
        }
    }
    EXPECT_GT(held, 30);
    EXPECT_GT(refused, 30);
    EXPECT_TRUE(verify_store(*this->store_).sound());
}

/// What an earlier version wrote has no digest of its request: what is there is compared.
TYPED_TEST(ArchiveLaws, AKeyOfAnEarlierVersionIsComparedAsFarAsItCanBe) {
    const std::string number = this->issued();
    LogEntry entry{.seq = 0,
                   .at = this->clock_.next(),
                   .actor = "R. Reviewer",
                   .kind = "withdrawn",
                   .certificate = number,
                   .record = this->archive_->life(number).record,
                   .request_key = "old",
                   .body = R"({"new":{"state":"withdrawn"},"old":{"state":"issued"},"why":"a reason"})",
                   .prev = {},
                   .hash = {}};
    this->store_->write([&] {
        const LogEntry last = *this->store_->last_entry();
        entry.seq = last.seq + 1;
        entry.prev = last.hash;
        entry.hash = entry_hash(entry);
        this->store_->append(entry);
    });
    const auto asked = [&](const std::string& why) {
        return this->archive_->advance(number, "withdrawn", this->by("R. Reviewer", why, "old"));
    };
    EXPECT_EQ(asked("a reason").entry, entry);
    EXPECT_EQ(code_of([&] { (void)asked("another"); }), "GC-ARCHIVE-0027");
}

/// What decides is the log: a table of lists that was edited changes nothing.
TYPED_TEST(ArchiveLaws, RecordsAreThoseOfTheLogWhateverListsSay) {
    const std::string first = this->issued();
    const std::string second = this->issued();
    const std::vector<ListedCertificate> before = this->archive_->certificates();
    EXPECT_EQ(before, this->archive_->list());
    this->store_->write([&] {
        ListedCertificate edited = before[0];
        edited.state = "withdrawn";
        edited.record = before[1].record;
        this->store_->list(edited);
        edited.number = "EX-2026-999";
        this->store_->list(edited);
    });
    EXPECT_NE(this->archive_->list(), before);
    EXPECT_EQ(this->archive_->certificates(), before);
    std::vector<std::string> records;
    this->archive_->each_record([&](const auto& certificates) { EXPECT_EQ(certificates.size(), 2U); },
                                [&](const ListedCertificate& one, const std::string& bytes) {
                                    EXPECT_EQ(one.state, "issued");
                                    records.push_back(bytes);
                                });
    EXPECT_EQ(records, (std::vector<std::string>{sample_draft(first).record, sample_draft(second).record}));
}

/// Bytes that have another hash than their name are read by nobody.
TYPED_TEST(ArchiveLaws, GoesOnWithNoBytesOfAnotherHash) {
    const std::string number = this->archive_->take_number(this->by("A. Author")).entry.certificate;
    const Draft draft = sample_draft(number);
    const std::string sha256 = encoding::sha256(draft.documents[1].bytes);
    this->store_->write([&] { this->store_->put({sha256, "something else"}); });
    EXPECT_EQ(code_of([&] { (void)this->archive_->content(sha256); }), "GC-ARCHIVE-0012");
    EXPECT_EQ(code_of([&] { (void)this->archive_->draft(draft, this->by("A. Author")); }), "GC-ARCHIVE-0012");
}

/// The judge of a record is asked inside of the transaction: what he refuses is not written.
TYPED_TEST(ArchiveLaws, AJudgeSeesTheRecordThatCounts) {
    const std::string number = this->archive_->take_number(this->by("A. Author")).entry.certificate;
    (void)this->archive_->draft(sample_draft(number), this->by("A. Author"));
    const Head before = this->archive_->head();
    const auto refuse = [&](const std::string& record, const CertificateLife& life) {
        EXPECT_EQ(record, sample_draft(number).record);
        EXPECT_EQ(life.state, "drafted");
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-ARCHIVE-0030", .where = "", .what = "", .rule = "", .action = ""});
    };
    EXPECT_EQ(code_of([&] { (void)this->archive_->advance(number, "reviewed", this->by("R. Reviewer"), refuse); }),
              "GC-ARCHIVE-0030");
    EXPECT_EQ(this->archive_->head(), before);
}

TYPED_TEST(ArchiveLaws, RefusesWithTheCodeOfTheRule) {
    const std::string number = this->archive_->take_number(this->by("A. Author")).entry.certificate;
    const Head before = this->archive_->head();
    const auto drafted = [&](const std::string& other) {
        return code_of([&] { (void)this->archive_->draft(sample_draft(other), this->by("A. Author")); });
    };
    const auto stepped = [&](const std::string& kind, const std::string& who) {
        return code_of([&] { (void)this->archive_->advance(number, kind, this->by(who)); });
    };
    EXPECT_EQ(drafted("EX-2026-007"), "GC-ARCHIVE-0024");
    EXPECT_EQ(stepped("issued", "R. Reviewer"), "GC-ARCHIVE-0021");
    EXPECT_EQ(code_of([&] { (void)this->archive_->advance("EX-2026-009", "issued", this->by("R")); }),
              "GC-ARCHIVE-0026");
    EXPECT_EQ(code_of([&] { (void)this->archive_->life("EX-2026-009"); }), "GC-ARCHIVE-0026");
    EXPECT_EQ(code_of([&] { (void)this->archive_->history("EX-2026-009"); }), "GC-ARCHIVE-0026");
    EXPECT_EQ(code_of([&] { (void)this->archive_->record_of(number); }), "GC-ARCHIVE-0026");
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_number(this->by("")); }), "GC-ARCHIVE-0020");
    EXPECT_EQ(this->archive_->head(), before) << "nothing is written, no content either";
    EXPECT_TRUE(verify_store(*this->store_).sound());
    (void)this->archive_->draft(sample_draft(number), this->by("A. Author"));
    EXPECT_EQ(stepped("reviewed", "A. Author"), "GC-ARCHIVE-0022");
    (void)this->archive_->change_settings({.four_eyes = true, .numbering = "", .persons = {{"K. Keeper", {"keeper"}}}},
                                          this->by("K. Keeper", "only the keeper is left"));
    EXPECT_EQ(stepped("reviewed", "R. Reviewer"), "GC-ARCHIVE-0023");
    EXPECT_EQ(this->archive_->settings().persons.size(), 1U);
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_number(this->by("K. Keeper")); }), "GC-ARCHIVE-0025");
}

TYPED_TEST(ArchiveLaws, RefusesAClockThatGoesBack) {
    Request request = this->by("A. Author");
    (void)this->archive_->take_number(request);
    request.at = "2025-01-01T00:00:00Z";
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_number(request); }), "GC-ARCHIVE-0032");
    Request second = this->by("A. Author");
    second.at.replace(17, 2, "30");
    (void)this->archive_->take_number(second);
    second.at.replace(17, 2, "10");  // a server set the clock right, by some seconds
    EXPECT_EQ(this->archive_->take_number(second).entry.at.substr(17, 2), "30");
}

/// Less than a minute behind is the time of the last entry, where a minute, an hour or a year begins between them as well.
TYPED_TEST(ArchiveLaws, TakesAClockThatIsLessThanAMinuteBehind) {
    Request request = this->by("A. Author");
    for (const auto& [last, behind, is_taken] : {std::tuple{"2026-03-01T10:00:10Z", "2026-03-01T09:59:11Z", true},
                                                 {"2026-03-01T10:00:10Z", "2026-03-01T09:59:10Z", false},
                                                 {"2026-05-01T00:00:05Z", "2026-04-30T23:59:30Z", true},
                                                 {"2027-01-01T00:00:20Z", "2026-12-31T23:59:55Z", true},
                                                 {"2027-01-01T00:00:20Z", "2026-12-31T23:59:20Z", false},
                                                 {"2027-01-01T00:30:20Z", "2027-01-01T00:29:50Z", true}}) {
        request.at = last;
        request.confirmed_day = std::string(last).substr(0, 10);
        const std::string first = this->archive_->take_number(request).entry.at;
        EXPECT_EQ(first, last);
        request.at = behind;
        request.confirmed_day = "";
        if (is_taken) {
            EXPECT_EQ(this->archive_->take_number(request).entry.at, last);
        } else {
            EXPECT_EQ(code_of([&] { (void)this->archive_->take_number(request); }), "GC-ARCHIVE-0032") << behind;
        }
    }
}

TYPED_TEST(ArchiveLaws, DoesNothingTwiceForOneKey) {
    const Request request = this->by("A. Author", "", "key");
    const Written first = this->archive_->take_number(request);
    EXPECT_FALSE(first.repeated);
    const Written again = this->archive_->take_number(request);
    EXPECT_TRUE(again.repeated);
    EXPECT_EQ(again.entry, first.entry);
    EXPECT_EQ(this->archive_->head().size, 2);
    EXPECT_EQ(code_of([&] {
                  (void)this->archive_->draft(sample_draft(first.entry.certificate), this->by("A. Author", "", "key"));
              }),
              "GC-ARCHIVE-0027");
    (void)this->archive_->draft(sample_draft(first.entry.certificate), this->by("A. Author", "", "draft"));
    EXPECT_EQ(code_of([&] {
                  (void)this->archive_->draft(sample_draft(first.entry.certificate, "2"),
                                              this->by("A. Author", "", "draft"));
              }),
              "GC-ARCHIVE-0027")
        << "the same key with another record";
}

TYPED_TEST(ArchiveLaws, IssuesAnAmendmentTogetherWithTheEndOfItsOriginal) {
    const std::string number = this->issued();
    Draft amendment = sample_draft(number + "/A1", "2");
    amendment.amends = Draft::Amends{number, "replaced", {{"U", "l", "0.1", "0.2"}}};
    EXPECT_EQ(code_of([&] { (void)this->archive_->draft(amendment, this->by("A. Author")); }), "GC-ARCHIVE-0031")
        << "without reason";
    (void)this->archive_->draft(amendment, this->by("A. Author", "U was too small"));
    EXPECT_EQ(this->archive_->life(number).state, "issued");
    this->lead_to_issue(amendment.number);
    EXPECT_EQ(this->archive_->life(number).state, "superseded");
    EXPECT_EQ(this->archive_->life(number).later, amendment.number);
    EXPECT_EQ(this->archive_->record_of(number), sample_draft(number).record) << "the original stays as it was issued";
    Draft second = sample_draft(amendment.number + "/A1", "3");
    second.amends = Draft::Amends{amendment.number, "amended", {{"text", "/remarks/0", "", "a remark"}}};
    (void)this->archive_->draft(second, this->by("A. Author", "a remark was missing"));
    this->lead_to_issue(second.number);
    EXPECT_EQ(this->archive_->life(amendment.number).state, "amended-by");
    EXPECT_TRUE(verify_store(*this->store_).sound());
}

TYPED_TEST(ArchiveLaws, KeepsOneContentOnce) {
    const std::string number = this->archive_->take_number(this->by("A. Author")).entry.certificate;
    (void)this->archive_->draft(sample_draft(number), this->by("A. Author"));
    (void)this->archive_->draft(sample_draft(number), this->by("A. Author", "once more"));
    EXPECT_EQ(verify_store(*this->store_).contents, 3U);
}

TYPED_TEST(ArchiveLaws, EndsASeriesOfNumbers) {
    (void)this->archive_->change_settings({.four_eyes = true, .numbering = "N#"}, this->by("K. Keeper"));
    for (int i = 0; i < 9; ++i) {
        (void)this->archive_->take_number(this->by("A. Author"));
    }
    EXPECT_EQ(code_of([&] { (void)this->archive_->take_number(this->by("A. Author")); }), "GC-ARCHIVE-0025");
}

TYPED_TEST(ArchiveLaws, NotesABackup) {
    const Head head = this->archive_->head();
    const LogEntry entry = this->archive_->note_backup("copy.archive", head, this->by("K. Keeper")).entry;
    EXPECT_EQ(text_in(*body_of(entry), "new", "root"), encoding::hexadecimal(head.root));
    EXPECT_EQ(this->archive_->head().chain, entry.hash);
    EXPECT_EQ(this->archive_->head().archive, head.archive);
}

TEST(FirstEntry, RefusesAPatternWithoutOrdinal) {
    const Request request{.actor = "K. Keeper", .at = "2026-11-24T18:52:52Z", .request_key = "", .why = ""};
    EXPECT_EQ(code_of([&] { (void)first_entry({.four_eyes = true, .numbering = "EX"}, "gumcert", "n", request); }),
              "GC-ARCHIVE-0025");
    EXPECT_NE(first_entry({}, "gumcert", "n", request).hash, first_entry({}, "gumcert", "m", request).hash);
}

}  // namespace
}  // namespace gumcert::archive
