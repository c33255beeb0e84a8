// What the tests of the archive need beside the program: stores of chance, many verdicts, and writers that can be killed.
//
//   archive_driver make FILE SEED CERTIFICATES [HEAD]   a valid archive of chance, and its head
//   archive_driver judge                                reads lines "STORE [HEAD]" or "EVIDENCE [HEAD]", answers "sound" or
//                                                       "not sound: CODE …"
//   archive_driver write FILE WHO COUNT                 drafts COUNT certificates, and says of each one when it is kept
//   archive_driver number FILE WHO COUNT                takes COUNT numbers, and prints them
//   archive_driver migrate FROM TO                      a new archive with the same log
//   archive_driver fill FILE COUNT RECORD [issued]      a new archive with COUNT drafts, each durable by itself: of RECORD, with
//                                                       its number in place of "EX-2026-0042" where that stands in it, else
//                                                       with blanks behind it by which records differ; or issued ones
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "archive/archive.h"
#include "archive/evidence.h"
#include "archive/store/open_store.h"
#include "archive/verification.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_archive.h"

namespace {

using namespace gumcert::archive;  // NOLINT(google-build-using-namespace): one program, one file

std::string content_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

int make(const std::vector<std::string>& words) {
    test::ArchiveOfChance chance(std::stoull(words.at(2)));
    const auto store = create_store(words.at(1), chance.first());
    Archive archive(*store);
    chance.fill(archive, std::stoi(words.at(3)));
    if (words.size() > 4) {
        std::ofstream(words[4], std::ios::binary) << to_json(archive.head());
    }
    return 0;
}

std::vector<gumcert::gum::Diagnostic> findings_of(const std::string& file, const std::vector<Head>& heads) {
    if (file.ends_with(".json")) {
        return verify_evidence(evidence_from_json(content_of(file), file), heads).findings;
    }
    const auto store = open_store(file, Access::read_only);
    return verify_store(*store, heads).findings;
}

std::string verdict(const std::string& file, const std::string& head_file) {
    try {
        std::vector<Head> heads;
        if (!head_file.empty()) {
            heads.push_back(head_from_json(content_of(head_file), head_file));
        }
        std::set<std::string> codes;
        for (const gumcert::gum::Diagnostic& one : findings_of(file, heads)) {
            codes.insert(one.code);
        }
        std::string text = codes.empty() ? "sound" : "not sound:";
        for (const std::string& code : codes) {
            text += " " + code;
        }
        return text;
    } catch (const gumcert::gum::DiagnosedError& error) {
        return "not sound: " + error.diagnostics().front().code;
    }
}

int judge() {
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream words(line);
        std::string file;
        std::string head;
        words >> file >> head;
        std::cout << verdict(file, head) << std::endl;  // NOLINT(performance-avoid-endl): the other side waits for it
    }
    return 0;
}

int write(const std::vector<std::string>& words) {
    const auto store = open_store(words.at(1), Access::read_and_write);
    Archive archive(*store);
    for (int i = 0; i < std::stoi(words.at(3)); ++i) {
        const std::string number = words[2] + "-" + std::to_string(i);
        const Written written =
            archive.draft(test::sample_draft(number, std::to_string(i)), {.actor = words[2],
                                                                          .at = "2026-11-24T12:00:00Z",
                                                                          .request_key = number,
                                                                          .why = "",
                                                                          .confirmed_day = "2026-11-24"});
        std::cout << number << ' ' << written.entry.seq << ' ' << written.entry.record << std::endl;  // NOLINT
    }
    return 0;
}

int migrate(const std::vector<std::string>& words) {
    const auto from = open_store(words.at(1), Access::read_only);
    (void)replay_into(*from, words.at(2), list_again);
    return 0;
}

int number(const std::vector<std::string>& words) {
    const auto store = open_store(words.at(1), Access::read_and_write);
    Archive archive(*store);
    for (int i = 0; i < std::stoi(words.at(3)); ++i) {
        const Written written = archive.take_number({.actor = words[2],
                                                     .at = "2026-11-24T12:00:00Z",
                                                     .request_key = words[2] + "-" + std::to_string(i),
                                                     .why = "",
                                                     .confirmed_day = "2026-11-24"});
        std::cout << written.entry.certificate << std::endl;  // NOLINT(performance-avoid-endl)
    }
    return 0;
}

int fill(const std::vector<std::string>& words) {
    const std::string record = content_of(words.at(3));
    const std::string number = "EX-2026-0042";
    test::Clock clock;
    const Request request{.actor = "A. Author", .at = clock.next(), .request_key = "", .why = ""};
    Request reader = request;
    reader.actor = "R. Reviewer";
    const auto store = create_store(words.at(1), first_entry({}, "gumcert of the tests", "nonce", request));
    Archive archive(*store);
    const bool is_issued = words.size() > 4;
    const bool has_number = record.find(number) != std::string::npos;
    for (int i = 0; i < std::stoi(words.at(2)); ++i) {
        Draft draft{.number = "L-" + std::to_string(i), .item = "gauge", .record = record, .documents = {}};
        for (std::size_t at = draft.record.find(number); at != std::string::npos; at = draft.record.find(number, at)) {
            draft.record.replace(at, number.size(), draft.number);
        }
        for (int bits = i; !has_number && bits > 0; bits /= 2) {
            draft.record += bits % 2 == 0 ? ' ' : '\n';
        }
        if (is_issued) {
            draft.documents.push_back({"certificate.pdf", "application/pdf", "%PDF-1.7 " + draft.number});
        }
        (void)archive.draft(draft, request);
        for (const char* const kind : {"reviewed", "authorised", "issued"}) {
            if (is_issued) {
                (void)archive.advance(draft.number, kind, reader);
            }
        }
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    try {
        const std::string what = words.empty() ? "" : words[0];
        return what == "make"      ? make(words)
               : what == "judge"   ? judge()
               : what == "write"   ? write(words)
               : what == "number"  ? number(words)
               : what == "migrate" ? migrate(words)
               : what == "fill"    ? fill(words)
                                   : 2;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
