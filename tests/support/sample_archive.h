#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "archive/archive.h"
#include "archive/printed_head.h"

namespace gumcert::archive::test {

/// Times that follow each other, one minute apart.
class Clock {
public:
    std::string next() { return at(minutes_++); }
    /// Of a clock that is two days ahead.
    [[nodiscard]] std::string ahead() const { return at(minutes_ + 2880); }

private:
    int minutes_ = 0;

    static std::string at(int minute) {
        char text[32];
        (void)std::snprintf(text, sizeof text, "2026-%02d-%02dT%02d:%02d:00Z", 1 + minute / 40320 % 12,
                            1 + minute / 1440 % 28, minute / 60 % 24, minute % 60);
        return text;
    }
};

inline Draft sample_draft(const std::string& number, const std::string& content = "1") {
    return {.number = number,
            .item = "End gauge, SN-" + content,
            .record = "{\n \"certificate\": {\n  \"data\": {\n   \"number\": \"" + number +
                      "\"\n  }\n },\n \"record\": \"" + content + "\"\n}\n",
            .documents = {{"certificate.pdf", "application/pdf", "%PDF-1.7 " + number + " " + content},
                          {"certificate.xml", "application/xml", "<dcc>" + number + " " + content + "</dcc>"}}};
}

/// A valid archive of chance: certificates on all ways of their life, amendments, changes of settings, and now and then an entry
/// by a clock that was ahead.
class ArchiveOfChance {
public:
    ArchiveOfChance(std::uint64_t seed) : random_(seed), other_(seed + 1) {  // NOLINT(google-explicit-constructor)
        settings_.four_eyes = chance(2) == 0;
        settings_.numbering = chance(2) == 0 ? "EX-YYYY-####" : "";
        if (chance(2) == 0) {
            settings_.persons = {{"A. Author", {"author"}},
                                 {"B. Author", {"author"}},
                                 {"R. Reviewer", {"reviewer", "authoriser"}},
                                 {"K. Keeper", {"keeper"}}};
        }
    }

    [[nodiscard]] LogEntry first() {
        return first_entry(settings_, "gumcert of the tests", std::to_string(random_()), by("K. Keeper"));
    }

    void fill(Archive& archive, int certificates) {
        for (int i = 0; i < certificates; ++i) {
            if (chance(8) == 0) {
                settings_.four_eyes = !settings_.four_eyes;
                (void)archive.change_settings(settings_, by("K. Keeper", "agreed in the review"));
            }
            if (chance(8) == 0) {
                (void)archive.note_backup("backup.archive", archive.head(), by("K. Keeper"));
            }
            std::string number = "L-" + std::to_string(i);
            if (!settings_.numbering.empty() || chance(3) == 0) {
                if (settings_.numbering.empty()) {
                    number = "O-" + std::to_string(i);
                } else {
                    number = archive.take_number(by("A. Author")).entry.certificate;
                }
            }
            live(archive, sample_draft(number, std::to_string(chance(1000))));
        }
    }

private:
    std::mt19937_64 random_, other_;
    Settings settings_;
    Clock clock_;
    int keys_ = 0;

    [[nodiscard]] int chance(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }

    [[nodiscard]] bool happens(int one_of) { return other_() % static_cast<std::uint64_t>(one_of) == 0; }

    [[nodiscard]] Request by(const std::string& who, const std::string& why = "") {
        const std::string now = clock_.next();
        const std::string at = happens(100) ? clock_.ahead() : now;
        return {.actor = who,
                .at = at,
                .request_key = chance(2) == 0 ? "key-" + std::to_string(keys_++) : "",
                .why = why,
                .confirmed_day = at.substr(0, 10)};
    }

    /// What a laboratory does with an original whose amendment was withdrawn.
    void go_on_with(Archive& archive, const std::string& original) {
        if (happens(3)) {
            (void)archive.advance(original, "withdrawn", by("R. Reviewer", "nothing of it holds"));
        } else if (happens(2)) {
            amend(archive, original, archive.take_amendment_number(original, by("A. Author")).entry.certificate);
        }
    }

    void amend(Archive& archive, const std::string& original, const std::string& number) {
        Draft amendment = sample_draft(number, std::to_string(chance(1000)));
        amendment.amends = Draft::Amends{
            .number = original, .kind = chance(2) == 0 ? "amended" : "replaced", .changes = {{"U", "l", "0.1", "0.2"}}};
        live(archive, amendment, true);
        if (archive.life(number).state == "withdrawn") {
            go_on_with(archive, original);
        }
    }

    void live(Archive& archive, const Draft& draft, bool is_amendment = false) {
        (void)archive.draft(draft, by("A. Author", is_amendment ? "a digit was wrong" : ""));
        if (chance(6) == 0) {
            Draft again = draft;
            again.record += " ";
            (void)archive.draft(again, by("B. Author", "typing error"));
        }
        if (chance(6) == 0) {
            Draft with_head = draft;
            with_head.documents.push_back({"printed.html", "text/html", "<p>" + mark_of(archive.head()) + "</p>"});
            (void)archive.draft(with_head, by("A. Author", "with the head of the archive"));
        }
        const int steps = is_amendment ? 3 : chance(6);
        const std::vector<std::string> kinds = {"reviewed", "authorised", "issued"};
        for (int i = 0; i < std::min(steps, 3); ++i) {
            (void)archive.advance(draft.number, kinds[static_cast<std::size_t>(i)], by("R. Reviewer"));
        }
        if (chance(5) == 0) {
            (void)archive.advance(draft.number, "withdrawn", by("R. Reviewer", "the item was damaged"));
        } else if (steps >= 3 && !is_amendment && chance(3) == 0) {
            const std::string number =
                chance(2) == 0 ? draft.number + "/A1"
                               : archive.take_amendment_number(draft.number, by("A. Author")).entry.certificate;
            amend(archive, draft.number, number);
        }
    }
};

}  // namespace gumcert::archive::test
