#include "archive/archive.h"

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

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
