#include "app/cli/archive_command.h"

#include <fmt/core.h>
#include <gumcert_build_info.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "app/archive/affected_certificates.h"
#include "app/archive/archive_draft.h"
#include "app/archive/archive_files.h"
#include "app/archive/archive_replay.h"
#include "app/archive/archive_statistics.h"
#include "app/archive/record_parts.h"
#include "app/archive/shared_work.h"
#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "app/laboratory_overview.h"
#include "app/output_files.h"
#include "app/read_file.h"
#include "archive/archive.h"
#include "archive/evidence.h"
#include "archive/store/open_store.h"
#include "archive/store/sqlite_store.h"
#include "archive/store/work_table.h"
#include "archive/verification.h"
#include "encoding/sha2.h"
#include "signing/ed25519.h"
#include "signing/verify.h"
#include "system/cleanup.h"
#include "system/new_file.h"
#include "system/whole_folders.h"
#include "text/small_letters.h"
#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Which options an action takes, and how many names.
struct Action {
    const char* name;
    std::size_t least, most;  ///< of what is named
    const char* what;         ///< for the message where the count is another one
    std::string_view takes;   ///< options beside --share and the common ones, with blanks around
    ExitCode (*work)(const ArchiveOptions&, const CommonOptions&);
};

constexpr std::size_t k_any = 100'000;

archive::Request request_of(const ArchiveOptions& options) {
    return {.actor = options.by,
            .at = time_now(),
            .request_key = options.request_key,
            .why = options.why,
            .confirmed_day = options.today};
}

std::unique_ptr<archive::Store> opened(const ArchiveOptions& options, archive::Access access) {
    return archive::open_store(options.store, access);
}

bool as_json(const ArchiveOptions& options) {
    return options.format == "json";
}

void print_json(const json& value) {
    write_to_stdout(value.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

/// Carries out a request for an entry: a signal that comes meanwhile says whether it is in the log.
template <class Work>
archive::Written carried_out(const Work& work) {
    EntryUnderWay under_way;
    archive::Written written = work();
    under_way.is_in_the_log(fmt::format("{}{}{}, entry {}", text::one_line(written.entry.certificate),
                                        written.entry.certificate.empty() ? "" : " ", written.entry.kind,
                                        written.entry.seq));
    return written;
}

/// A new archive: a file under a temporary name until it is whole, or a database, which does so by itself.
class NewArchive {
public:
    /// \throws gum::StorageError  GC-ARCHIVE-0002, -0010, GC-STORE-0002
    explicit NewArchive(const std::string& address) : address_(address) {
        if (!archive::is_postgresql(address)) {
            archive::require_place_of_archive(address);
            told_as_storage([&] { file_.emplace(address); });
        }
    }
    /// Where it is made.
    [[nodiscard]] std::string address() const { return file_ ? file_->part().string() : address_; }
    /// As people know it.
    [[nodiscard]] std::string name_of(const archive::Store& store) const { return file_ ? address_ : store.name(); }
    /// Nobody has it open.
    void put_in_place() {
        if (file_) {
            told_as_storage([&] { file_->put_in_place([&] { tell_written(file_->place()); }); });
            app::synchronise_folder(file_->place().has_parent_path() ? file_->place().parent_path() : ".");
        }
    }

private:
    std::string address_;
    std::optional<system::NewFile> file_;

    void told_as_storage(const std::function<void()>& work) const {
        try {
            work();
        } catch (const std::system_error& error) {
            throw gum::StorageError(gum::Diagnostic{
                "GC-STORE-0002", address_, "cannot be made: " + error.code().message(),
                "output files appear whole or not at all", "choose another folder with -o, or free the disk"});
        }
    }
};

/// The outcome of an action that writes an entry.
ExitCode told(const archive::Written& written, const ArchiveOptions& options, const CommonOptions& common) {
    const archive::LogEntry& entry = written.entry;
    if (as_json(options)) {
        print_json({{"seq", entry.seq},
                    {"at", entry.at},
                    {"kind", entry.kind},
                    {"certificate", entry.certificate},
                    {"hash", encoding::hexadecimal(entry.hash)},
                    {"repeated", written.repeated}});
    } else if (!common.quiet) {
        fmt::print("{}{}{}: entry {}, {}{}\n", text::one_line(entry.certificate), entry.certificate.empty() ? "" : " ",
                   entry.kind, entry.seq, entry.at, written.repeated ? " (asked for before, with the same key)" : "");
    }
    return done;
}

std::string random_nonce() {
    std::random_device source;
    std::string bytes;
    for (int i = 0; i < 16; ++i) {
        bytes += static_cast<char>(source() & 0xFFU);
    }
    return encoding::hexadecimal(bytes);
}

/// "R. Lin=author,reviewer" of each --person.
std::map<std::string, std::set<std::string>> persons_of(const ArchiveOptions& options) {
    std::map<std::string, std::set<std::string>> persons;
    for (const std::string& word : options.persons) {
        const std::size_t equals = word.find('=');
        std::set<std::string>& roles = persons[word.substr(0, equals)];
        std::size_t start = equals == std::string::npos ? word.size() : equals + 1;
        while (start < word.size()) {
            const std::size_t end = std::min(word.find(',', start), word.size());
            roles.insert(word.substr(start, end - start));
            start = end + 1;
        }
        if (equals == 0 || roles.empty() ||
            !std::all_of(roles.begin(), roles.end(), [](const std::string& role) { return archive::is_role(role); })) {
            refuse_usage("--person " + word, "is no name with roles",
                         "NAME=ROLE,ROLE with the roles author, reviewer, authoriser, keeper", "correct it");
        }
    }
    return persons;
}

archive::Settings settings_of(const ArchiveOptions& options) {
    return {.four_eyes = !options.one_pair_of_eyes, .numbering = options.numbering, .persons = persons_of(options)};
}

ExitCode init_archive(const ArchiveOptions& options, const CommonOptions& common) {
    const archive::LogEntry first =
        archive::first_entry(settings_of(options), fmt::format("gumcert {} (commit {})", k_version, k_commit),
                             random_nonce(), request_of(options));
    NewArchive made(options.store);
    std::string name;
    const archive::Written written = carried_out([&] {
        name = made.name_of(*archive::create_store(made.address(), first));
        made.put_in_place();
        return archive::Written{first, false};
    });
    if (!common.quiet && !as_json(options)) {
        fmt::print("Begun: {}\n", text::one_line(name));
    }
    return told(written, options, common);
}

ExitCode change_settings(const ArchiveOptions& options, const CommonOptions& common) {
    const auto store = opened(options, archive::Access::read_and_write);
    return told(carried_out([&] {
                    return archive::Archive(*store).change_settings(settings_of(options), request_of(options));
                }),
                options, common);
}

ExitCode take_number(const ArchiveOptions& options, const CommonOptions& common) {
    const auto store = opened(options, archive::Access::read_and_write);
    archive::Archive archive(*store);
    const archive::Written written = carried_out([&] {
        return options.amend.empty() ? archive.take_number(request_of(options))
                                     : archive.take_amendment_number(options.amend, request_of(options));
    });
    if (common.quiet && !as_json(options)) {  // the number is the answer
        write_to_stdout(written.entry.certificate + "\n");
    }
    return told(written, options, common);
}

ExitCode add_draft(const ArchiveOptions& options, const CommonOptions& common, bool is_amendment) {
    const auto store = opened(options, archive::Access::read_and_write);
    archive::Archive archive(*store);
    ProgressLine progress(!common.quiet);
    app::ArchiveChecks checks{.threads = static_cast<unsigned>(common.threads),
                              .templates = templates_folder(options.share),
                              .trusted = {},
                              .now = seconds_now(),
                              .progress = [&](const std::string& text) { progress(text); }};
    if (!options.trust.empty()) {
        checks.trusted = signing::read_trust_store(options.trust);
    }
    app::CheckedDraft checked =
        app::checked_draft(options.named.front(), {options.named.begin() + 1, options.named.end()}, checks);
    progress.clear();
    archive::Request request = request_of(options);
    const certificate::CertificateData& data = checked.record.certificate->data;
    if (data.amendment.has_value() != is_amendment) {
        refuse_usage(options.named.front(), is_amendment ? "amends no certificate" : "amends another certificate",
                     "an amendment comes in by gumcert archive amend, every other certificate by add",
                     is_amendment ? "state the amendment in the certificate data, or use add" : "use amend");
    }
    if (is_amendment) {
        app::state_amendment(checked, archive.record_of(data.amendment->number));
        if (request.why.empty()) {
            request.why = data.amendment->reason.in(data.languages.empty() ? "en" : data.languages.front());
        }
    }
    print_messages(checked.remarks, common);
    return told(carried_out([&] { return archive.draft(checked.draft, request); }), options, common);
}

ExitCode add_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return add_draft(options, common, false);
}

ExitCode amend_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return add_draft(options, common, true);
}

ExitCode advance(const ArchiveOptions& options, const CommonOptions& common, const std::string& kind) {
    const auto store = opened(options, archive::Access::read_and_write);
    archive::Archive archive(*store);
    const std::string& number = options.named.front();
    std::vector<gum::Diagnostic> doubts;
    const auto judge = [&](const std::string& record, const archive::CertificateLife& life) {
        if (kind == "reviewed" || kind == "authorised") {
            app::require_named_person(record, number, kind, options.by);
        } else if (kind == "issued") {
            app::require_issuable(record, number, today());
            if (!life.authorised_by.empty()) {
                app::require_named_person(record, number, "authorised", life.authorised_by);
            }
        }
        doubts = app::doubts_about_days(record, number, kind, today());
    };
    const archive::Written written =
        carried_out([&] { return archive.advance(number, kind, request_of(options), judge); });
    print_messages(doubts, common);
    return told(written, options, common);
}

ExitCode review_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "reviewed");
}

ExitCode authorise_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "authorised");
}

ExitCode issue_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "issued");
}

ExitCode withdraw_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    return advance(options, common, "withdrawn");
}

ExitCode list_certificates(const ArchiveOptions& options, const CommonOptions& /*common*/) {
    const auto store = opened(options, archive::Access::read_only);
    std::vector<archive::ListedCertificate> certificates = archive::Archive(*store).list();
    for (const std::string& word : options.named) {
        std::erase_if(certificates, [wanted = text::in_small_letters(word)](const archive::ListedCertificate& one) {
            return text::in_small_letters(one.number + '\n' + one.state + '\n' + one.since + '\n' + one.item)
                       .find(wanted) == std::string::npos;
        });
    }
    if (as_json(options)) {
        json list = json::array();
        for (const archive::ListedCertificate& one : certificates) {
            list.push_back({{"number", one.number},
                            {"state", one.state},
                            {"since", one.since},
                            {"item", one.item},
                            {"record", one.record}});
        }
        print_json({{"schema", "gumcert/archive-list/1"}, {"certificates", list}});
        return done;
    }
    std::string text;
    for (const archive::ListedCertificate& one : certificates) {
        text += fmt::format("{:<24}  {:<10}  {}  {}\n", text::one_line(one.number), text::one_line(one.state),
                            text::one_line(one.since), text::one_line(one.item));
    }
    write_to_stdout(text.empty() ? "No certificates.\n" : text);
    return done;
}

json shown_entry(const archive::LogEntry& entry) {
    return {{"seq", entry.seq},
            {"at", entry.at},
            {"by", entry.actor},
            {"kind", entry.kind},
            {"record", entry.record},
            {"request_key", entry.request_key},
            {"body", archive::body_of(entry).value_or(json())},
            {"hash", encoding::hexadecimal(entry.hash)}};
}

std::string shown_changes(const json& body) {
    std::string text;
    const auto amends = body.find("amends");
    if (amends == body.end() || !amends->is_object() || !amends->contains("changes")) {
        return text;
    }
    for (const json& change : (*amends)["changes"]) {
        const auto part = [&](const char* key) {
            const auto found = change.find(key);
            const std::string value = found != change.end() && found->is_string() ? found->get<std::string>() : "";
            return value.empty() ? std::string("nothing") : text::one_line(value);
        };
        text += fmt::format("        {} {}: {} -> {}\n", part("where"), part("kind"), part("before"), part("after"));
    }
    return text;
}

ExitCode show_certificate(const ArchiveOptions& options, const CommonOptions& /*common*/) {
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    const std::string& number = options.named.front();
    const std::vector<archive::LogEntry> entries = archive.history(number);
    const archive::CertificateLife life = archive.life(number);
    if (as_json(options)) {
        json list = json::array();
        for (const archive::LogEntry& entry : entries) {
            list.push_back(shown_entry(entry));
        }
        print_json({{"schema", "gumcert/archive-certificate/1"},
                    {"number", number},
                    {"state", life.state},
                    {"since", life.since},
                    {"record", life.record},
                    {"documents", life.documents},
                    {"amends", life.amends},
                    {"amended_by", life.later},
                    {"entries", list}});
        return done;
    }
    // Every text here is one that somebody wrote: none of them may bring a line of its own.
    std::string text = fmt::format("{}: {} since {}\n", text::one_line(number), text::one_line(life.state),
                                   text::one_line(life.since));
    if (!life.amends.empty()) {
        text += fmt::format("  {} {}\n", life.amendment_kind == "replaced" ? "replaces" : "amends",
                            text::one_line(life.amends));
    }
    std::set<std::string> seen{number};
    for (std::string later = life.later; !later.empty() && seen.insert(later).second;) {
        const archive::CertificateLife of_later = archive.life(later);
        text += fmt::format("  see {}, which is {} since {}\n", text::one_line(later), text::one_line(of_later.state),
                            text::one_line(of_later.since));
        later = of_later.later;
    }
    for (const archive::LogEntry& entry : entries) {
        const json body = archive::body_of(entry).value_or(json::object());
        text += fmt::format("  {:>6}  {}  {:<10}  {}", entry.seq, text::one_line(entry.at), text::one_line(entry.kind),
                            text::one_line(entry.actor));
        const auto why = body.find("why");
        text += why != body.end() && why->is_string() && !why->get_ref<const std::string&>().empty()
                    ? ": " + text::one_line(why->get_ref<const std::string&>()) + "\n"
                    : "\n";
        if (entry.kind == "drafted") {
            text += fmt::format("        record {}\n", text::one_line(entry.record));
            const json documents = body.value("new", json::object()).value("documents", json::array());
            for (const json& document : documents) {
                text += fmt::format("        {} {}\n", text::one_line(document.value("name", "")),
                                    text::one_line(document.value("sha256", "")));
            }
            text += shown_changes(body);
        }
    }
    write_to_stdout(text);
    return done;
}

/// The files that an action with an output reads: no output takes the place of one.
std::vector<fs::path> inputs_of(const ArchiveOptions& options) {
    return {options.store, options.sign, options.since};
}

/// Output of a reading action: a file, or the terminal.
class Output {
public:
    /// Before anything of the archive is read.
    Output(std::string place, const ArchiveOptions& options, const CommonOptions& common)
        : place_(place == "-" ? "" : std::move(place)), inputs_(inputs_of(options)), quiet_(common.quiet) {
        if (!place_.empty()) {
            app::require_writable(place_);
            app::require_not_an_input(place_, inputs_);
            at_start_ = begin_outputs({place_}, common);
        }
    }
    void write(const std::string& text) const {
        if (place_.empty()) {
            write_to_stdout(text);
            return;
        }
        write_outputs({{place_, text}}, inputs_, at_start_);
        if (!quiet_) {
            fmt::print("Written: {}\n", text::one_line(place_));
        }
    }

private:
    std::string place_;
    std::vector<fs::path> inputs_;
    bool quiet_;
    app::OutputsAtStart at_start_;
};

archive::Head::Signature signature_of(const std::string& bytes, const std::string& key) {
    signing::Ed25519Signature signature = signing::sign_ed25519(bytes, key);
    return {std::move(signature.public_key), std::move(signature.value)};
}

void sign(archive::Head& head, const std::string& key) {
    if (!key.empty()) {
        if (head.at > latest_time()) {
            throw gum::StorageError(gum::Diagnostic{
                .code = "GC-ARCHIVE-0066",
                .where = "the clock of this machine",
                .what = "says " + time_now() + ", and the last entry is of " + head.at,
                .rule = "what is signed speaks of a time that has come",
                .action =
                    "look at a calendar: set the clock right, or wait; without --sign the head is written as it is"});
        }
        head.signature = signature_of(archive::signed_bytes(head), key);
    }
}

/// The earlier head of --since: a file of a head, or of evidence, which has one.
std::optional<archive::Head> head_since_of(const ArchiveOptions& options) {
    if (options.since.empty()) {
        return std::nullopt;
    }
    const std::string text = app::read_file(options.since);
    return app::archive_file_of(text) == app::ArchiveFile::evidence
               ? archive::evidence_from_json(text, options.since).head
               : archive::head_from_json(text, options.since);
}

/// Several numbers, "N/1" and "N_1", have one name of a file. Whoever has not named the file does not know that it stands for
/// another certificate.
void require_own_evidence(const fs::path& file, const std::string& number) {
    std::error_code error;
    const std::string other =
        fs::exists(file, error) ? app::certificate_of_evidence(app::read_file(file)) : std::string();
    if (!other.empty() && other != number) {
        refuse_usage(file.string(), "is evidence of " + text::one_line(other) + ", not of " + text::one_line(number),
                     "evidence of two certificates stands in two files", "name another file with -o");
    }
}

ExitCode export_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    const std::string output =
        options.output.empty() ? app::file_name_of_number(options.named.front()) + "-evidence.json" : options.output;
    const auto store = opened(options, archive::Access::read_only);
    const Output file(output, options, common);
    if (options.output.empty()) {
        require_own_evidence(output, options.named.front());
    }
    archive::Evidence evidence = archive::evidence_of(*store, options.named.front(), head_since_of(options));
    if (std::ranges::none_of(evidence.entries, [&](const archive::Evidence::ProvenEntry& one) {
            return one.entry.kind == "drafted" && one.entry.certificate == options.named.front();
        })) {
        refuse_usage(options.named.front(), "has no record: its number was taken and nothing was added",
                     "evidence shows a record and what became of it", "add the certificate first: gumcert archive add");
    }
    sign(evidence.head, options.sign);
    if (!options.sign.empty()) {
        evidence.states = archive::states_in(evidence, std::max(time_now(), evidence.head.at));
        evidence.states->signature =
            signature_of(archive::signed_bytes(*evidence.states, evidence.head, evidence.certificate), options.sign);
    }
    file.write(archive::to_json(evidence));
    return done;
}

ExitCode write_head(const ArchiveOptions& options, const CommonOptions& common) {
    const auto store = opened(options, archive::Access::read_only);
    const Output file(options.output, options, common);
    archive::Archive archive(*store);
    const std::optional<archive::Head> since = head_since_of(options);
    archive::Head head = since ? archive.head_since(*since) : archive.head();
    sign(head, options.sign);
    file.write(archive::to_json(head));
    return done;
}

json shown_findings(const std::vector<gum::Diagnostic>& findings) {
    json list = json::array();
    for (const gum::Diagnostic& one : findings) {
        list.push_back(app::as_json(one));
    }
    return list;
}

void print_findings(const std::vector<gum::Diagnostic>& findings, const CommonOptions& common) {
    for (const gum::Diagnostic& one : findings) {
        print_message(one, common);
    }
}

/// Evidence and heads, each by itself; behind the first evidence also documents that should be of one of them.
ExitCode verify_files(const ArchiveOptions& options, const CommonOptions& common) {
    const app::TrustedHeads heads(options.heads, options.trust, latest_time());
    std::vector<app::DocumentInHand> documents;
    std::vector<std::string> evidence;
    bool has_evidence = false;
    ExitCode code = done;
    for (const std::string& file : options.named) {
        code = std::max(code, explained(common, [&] {
                            const std::string text = app::read_file(file);
                            const app::ArchiveFile kind = app::archive_file_of(text);
                            if (kind == app::ArchiveFile::other && has_evidence) {
                                documents.push_back({file, encoding::sha256(text)});
                            } else {
                                evidence.push_back(file);
                                has_evidence = has_evidence || kind == app::ArchiveFile::evidence;
                            }
                            return done;
                        }));
    }
    for (const std::string& file : evidence) {
        code = std::max(code, explained(common, [&] {
                            const std::string text = app::read_file(file);
                            const app::VerifiedFile said = app::archive_file_of(text) == app::ArchiveFile::head
                                                               ? app::verified_head(text, file, heads)
                                                               : app::verified_evidence(text, file, heads, documents);
                            print_findings(said.findings, common);
                            if (as_json(options)) {
                                print_json(said.json);
                            } else if (!common.quiet) {
                                write_to_stdout(said.text);
                            }
                            return said.sound() ? done : negative_answer;
                        }));
    }
    const std::vector<gum::Diagnostic> of_others = app::findings_of(documents);
    print_findings(of_others, common);
    if (!documents.empty() && of_others.empty()) {
        const std::vector<gum::Diagnostic> notes{
            {.code = "GC-ARCHIVE-0071",
             .where = documents.front().file,
             .what = "compared with the evidence: its bytes, by their SHA-256; not compared here: what its pages say "
                     "with what "
                     "the record says",
             .rule = "documents are held against their record when they are added",
             .action = "read the document beside the record, where the laboratory is not to be relied on",
             .severity = gum::Severity::note}};
        print_messages(notes, common);
    }
    return of_others.empty() ? code : std::max(code, negative_answer);
}

ExitCode verify_archive(const ArchiveOptions& options, const CommonOptions& common) {
    if (!options.named.empty()) {
        return verify_files(options, common);
    }
    const app::TrustedHeads heads(options.heads, options.trust, latest_time());
    const auto store = opened(options, archive::Access::read_only);
    ProgressLine progress(!common.quiet);
    archive::Verification verification =
        archive::verify_store(*store, heads.all(), [&](const std::string& text) { progress(text); });
    progress.clear();
    verification.findings.insert(verification.findings.end(), heads.findings().begin(), heads.findings().end());
    print_findings(verification.findings, common);
    const bool trust_is_idle = heads.has_key() && heads.all().empty();
    std::vector<std::string> to_come = heads.times_to_come();
    if (verification.head) {
        if (std::string line = app::time_to_come("the last entry", verification.head->at, heads.latest());
            !line.empty()) {
            to_come.insert(to_come.begin(), std::move(line));
        }
    }
    if (as_json(options)) {
        json head;
        if (verification.head) {
            head = json::parse(archive::to_json(*verification.head));
        }
        print_json({{"schema", "gumcert/archive-verification/1"},
                    {"sound", verification.sound()},
                    {"entries", verification.entries},
                    {"contents", verification.contents},
                    {"certificates", verification.certificates},
                    {"heads", heads.all().size()},
                    {"trusted", heads.has_key() && !heads.all().empty() && heads.findings().empty()},
                    {"head", head},
                    {"times_to_come", to_come},
                    {"findings", shown_findings(verification.findings)}});
    } else if (!common.quiet) {
        std::string said =
            fmt::format("{}: {}; {} entries, {} contents, {} certificates, {} earlier heads\n",
                        text::one_line(store->name()), verification.sound() ? "sound" : "NOT SOUND",
                        verification.entries, verification.contents, verification.certificates, heads.all().size());
        if (verification.head) {
            said += fmt::format("  head {} of {}\n", encoding::hexadecimal(verification.head->root),
                                text::one_line(verification.head->at));
        }
        if (heads.all().empty()) {
            said += "  Without --head nobody can see whether the end of the log was cut off, or all of it rewritten.\n";
        }
        for (const std::string& line : to_come) {
            said += "  " + line + "\n";
        }
        if (trust_is_idle) {
            said += "  --trust says nothing here: an archive is not signed, heads are, and none is given.\n";
        }
        write_to_stdout(said);
    }
    return verification.sound() ? done : negative_answer;
}

/// The copy is looked at before it gets its name, and noted in the log before anybody relies on it.
ExitCode back_up(const ArchiveOptions& options, const CommonOptions& common) {
    const fs::path file = options.output;
    app::require_writable(file);
    const auto store = opened(options, archive::Access::read_and_write);
    std::error_code error;
    if (fs::exists(file, error) || error) {
        refuse_usage(file.string(), "is there already", "a backup is a new file", "choose another name");
    }
    NewArchive made(options.output);
    store->copy_to(made.address());
    ProgressLine progress(!common.quiet);
    archive::Verification verification;
    {
        const auto copy = archive::open_store(made.address(), archive::Access::read_only);
        verification =
            archive::verify_store(*copy, {}, [&](const std::string& text) { progress("verifying: " + text); });
    }
    progress.clear();
    if (!verification.sound() || !verification.head) {
        print_findings(verification.findings, common);
        throw gum::StorageError(gum::Diagnostic{.code = "GC-ARCHIVE-0011",
                                                .where = file.string(),
                                                .what = "the copy cannot be verified, and was removed",
                                                .rule = "a backup is verified before it counts as one",
                                                .action = "see what gumcert archive verify says of the archive"});
    }
    // Where the entry is refused, the copy goes; a signal finds both or none of them.
    const auto both = system::hold_cleanup();
    const archive::Written written = carried_out([&] {
        return archive::Archive(*store).note_backup(file.filename().string(), *verification.head, request_of(options));
    });
    made.put_in_place();
    return told(written, options, common);
}

ExitCode migrate(const ArchiveOptions& options, const CommonOptions& common) {
    const auto from = opened(options, archive::Access::read_only);
    const archive::Head head = archive::Archive(*from).head();
    ProgressLine progress(!common.quiet);
    progress("copying " + std::to_string(head.size) + " entries");
    NewArchive made(options.to);
    std::unique_ptr<archive::Store> to;
    std::string name;
    {
        std::optional<EntryUnderWay> under_way;  // a file is not there before it is in its place
        if (archive::is_postgresql(options.to)) {
            under_way.emplace();
        }
        to = archive::replay_into(*from, made.address(), archive::list_again);
        name = made.name_of(*to);
        if (under_way) {
            under_way->is_in_the_log(fmt::format("{} entries in {}", head.size, text::one_line(name)));
        }
    }
    const archive::Verification verification =
        archive::verify_store(*to, {head}, [&](const std::string& text) { progress("verifying: " + text); });
    progress.clear();
    print_findings(verification.findings, common);
    if (!verification.sound()) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-ARCHIVE-0011",
                            .where = name,
                            .what = archive::is_postgresql(options.to) ? "the copy cannot be verified"
                                                                       : "the copy cannot be verified, and was removed",
                            .rule = "a copy is verified before it counts as one",
                            .action = archive::is_postgresql(options.to)
                                          ? "remove it, and see what gumcert archive verify says of the archive"
                                          : "see what gumcert archive verify says of the archive"});
    }
    to.reset();
    made.put_in_place();
    if (as_json(options)) {
        print_json({{"schema", "gumcert/archive-migration/1"},
                    {"from", from->name()},
                    {"to", name},
                    {"entries", verification.entries},
                    {"contents", verification.contents},
                    {"head", json::parse(archive::to_json(*verification.head))}});
    } else if (!common.quiet) {
        fmt::print("{}: sound; {} entries, {} contents, {} certificates, as in {}\n  head {} of {}\n",
                   text::one_line(name), verification.entries, verification.contents, verification.certificates,
                   text::one_line(from->name()), encoding::hexadecimal(verification.head->root), verification.head->at);
    }
    return done;
}

std::string program_name() {
    return fmt::format("{} (commit {})", k_version, k_commit);
}

/// The table of work that the machines of an archive share.
std::unique_ptr<archive::WorkTable> opened_work(const ArchiveOptions& options) {
    if (!archive::is_postgresql(options.store)) {
        refuse_usage(
            "archive " + options.action, "an archive in a file has no workers",
            "machines share work through the server that has the archive; of a file one command uses all cores",
            "leave out --shared, or migrate the archive to a server");
    }
    return archive::open_work_table(options.store);
}

void wait_for_others() {
    constexpr auto k_pause = std::chrono::milliseconds(200);
    std::this_thread::sleep_for(k_pause);
}

/// Does what others share, until there is nothing more; with --wait-for-work it goes on waiting.
ExitCode work_for_others(const ArchiveOptions& options, const CommonOptions& common) {
    const auto table = opened_work(options);
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    app::ArchiveWorker worker(archive, *table, static_cast<unsigned>(common.threads), templates_folder(options.share));
    ProgressLine progress(!common.quiet);
    std::size_t done_tasks = 0;
    for (std::optional<archive::SharedWork> work = table->next(program_name()); work || options.wait;
         work = table->next(program_name())) {
        const std::size_t some = work ? worker.do_some(*work) : 0;
        done_tasks += some;
        progress(fmt::format("{} tasks done", done_tasks));
        if (some == 0) {
            wait_for_others();
        }
    }
    progress.clear();
    if (!common.quiet) {
        fmt::print("{} tasks done\n", done_tasks);
    }
    return done;
}

/// Numbers of certificates and SHA-256 of their records: those that are named, or all.
std::vector<std::pair<std::string, std::string>> records_to_replay(archive::Archive& archive,
                                                                   const ArchiveOptions& options) {
    std::vector<std::pair<std::string, std::string>> records;
    for (const std::string& number : options.named) {
        records.emplace_back(number, archive.life(number).record);
    }
    if (options.named.empty()) {
        for (const archive::ListedCertificate& one : archive.certificates()) {
            if (!one.record.empty()) {
                records.emplace_back(one.number, one.record);
            }
        }
    }
    return records;
}

ExitCode replay(const ArchiveOptions& options, const CommonOptions& common) {
    const std::unique_ptr<archive::WorkTable> table = options.shared ? opened_work(options) : nullptr;
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    const std::vector<std::pair<std::string, std::string>> records = records_to_replay(archive, options);
    const fs::path templates = templates_folder(options.share);
    const auto threads = static_cast<unsigned>(common.threads);
    ProgressLine progress(!common.quiet);
    json list = json::array();
    std::size_t same = 0;
    const auto take = [&](const std::string& number, const app::Replay& one) {
        progress.clear();
        print_findings(one.differences, common);
        same += one.differences.empty() ? std::size_t{1} : 0;
        list.push_back({{"number", number},
                        {"made_by", one.made_by},
                        {"evaluated", one.evaluated},
                        {"same", one.differences.empty()},
                        {"differences", shown_findings(one.differences)}});
    };
    if (table) {
        const app::WorkToShare shared = app::work_of_replay(records, program_name());
        app::ArchiveWorker(archive, *table, threads, templates)
            .finish(shared, wait_for_others, [&](const std::string& text) { progress(text); });
        for (const auto& [number, one] : app::replays_in(*table, shared)) {
            take(number, one);
        }
        table->remove(shared.work.id);
    } else {
        for (std::size_t i = 0; i < records.size(); ++i) {
            const auto& [number, record] = records[i];
            progress(fmt::format("{} of {}: {}", i + 1, records.size(), text::one_line(number)));
            take(number, app::replay_record(archive.content(record).value_or(""), number, threads, templates));
        }
    }
    if (as_json(options)) {
        print_json({{"schema", "gumcert/archive-replay/1"},
                    {"program", program_name()},
                    {"records", records.size()},
                    {"same", same},
                    {"certificates", list}});
    } else if (!common.quiet) {
        for (const json& one : list) {
            fmt::print("{:<24}  {}  made by gumcert {}\n", text::one_line(one["number"].get<std::string>()),
                       one["same"].get<bool>()        ? "same     "
                       : one["evaluated"].get<bool>() ? "DIFFERENT"
                                                      : "NOT DONE ",
                       text::one_line(one["made_by"].get<std::string>()));
        }
        fmt::print("{} of {} records give the same with gumcert {}\n", same, records.size(), program_name());
    }
    return same == records.size() ? done : negative_answer;
}

/// Drafts of amendments on the disk, each in a folder of its own. One that a command that was ended has left there is whole,
/// and stays.
class DraftFolders {
public:
    explicit DraftFolders(const fs::path& output) : output_(output), folders_(output) {
        if (!output.empty()) {
            app::require_writable(output / "draft");
        }
    }

    [[nodiscard]] app::DraftSink sink() {
        if (output_.empty()) {
            return {};
        }
        return {.write = [this](const std::vector<app::OutputFile>& draft) { told([&] { write(draft); }); },
                .finish =
                    [this] {
                        told([&] {
                            folders_.put_in_place([&](const std::string& name) { tell_written(output_ / name); });
                        });
                    }};
    }

private:
    fs::path output_;
    system::WholeFolders folders_;

    void write(const std::vector<app::OutputFile>& draft) {
        const fs::path name = *draft.front().path.begin();
        std::error_code error;
        if (fs::exists(output_ / name, error) || error) {
            if (std::all_of(draft.begin(), draft.end(), [&](const auto& file) { return is_there(file); })) {
                return;
            }
            refuse_usage((output_ / name).string(), "is there already, with other files than those of the draft",
                         "a draft is written into a new folder", "choose another folder with -o");
        }
        std::vector<system::WholeFolders::File> files;
        for (const app::OutputFile& file : draft) {
            files.emplace_back(file.path.lexically_relative(name), file.bytes);
        }
        folders_.fill(name.string(), files);
    }

    [[nodiscard]] bool is_there(const app::OutputFile& file) const {
        std::error_code error;
        return fs::is_regular_file(output_ / file.path, error) && app::read_file(output_ / file.path) == file.bytes;
    }

    void told(const std::function<void()>& work) const {
        try {
            work();
        } catch (const std::system_error& error) {
            throw gum::StorageError(gum::Diagnostic{
                "GC-STORE-0002", output_.string(), "drafts cannot be written: " + error.code().message(),
                "output files appear whole or not at all", "choose another folder with -o, or free the disk"});
        }
    }
};

void require_query(const ArchiveOptions& options) {
    for (const auto& [name, value] : {std::pair("--source", &options.source), std::pair("--since", &options.since)}) {
        if (value->empty()) {
            refuse_usage("archive affected", std::string(name) + " is missing",
                         "the search is for a standard and the days since it was wrong", "name both");
        }
    }
    for (const std::string* const day : {&options.since, &options.until}) {
        if (!day->empty() && !app::is_day(*day)) {
            refuse_usage("archive affected", *day + " is no day", "a day is written as 2026-11-21", "correct it");
        }
    }
    if (!options.until.empty() && options.until < options.since) {
        refuse_usage("archive affected", "--until " + options.until + " is before --since " + options.since,
                     "the search is for work from the first of the days to the last", "correct them");
    }
    if ((!options.output.empty() || options.shared) && options.register_folder.empty()) {
        refuse_usage("archive affected", options.shared ? "--shared without --register" : "-o without --register",
                     "amendments are drafted of certificates that are calculated again",
                     "name the folder of the laboratory with the corrected standard");
    }
}

ExitCode find_affected(const ArchiveOptions& options, const CommonOptions& common) {
    require_query(options);
    std::string corrected;
    if (!options.register_folder.empty()) {
        corrected = app::read_file(fs::path(options.register_folder) / "standards" / (options.source + ".json"));
    }
    const std::unique_ptr<archive::WorkTable> table = options.shared ? opened_work(options) : nullptr;
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    ProgressLine progress(!common.quiet);
    const auto tell = [&](const std::string& text) { progress(text); };
    const app::WrongStandard standard{.name = options.source, .since = options.since, .until = options.until};
    const auto threads = static_cast<unsigned>(common.threads);
    std::vector<gum::Diagnostic> remarks;
    std::vector<app::AffectedCertificate> affected = app::find_affected(archive, standard, threads, tell, &remarks);
    progress.clear();
    print_messages(remarks, common);
    std::string work;
    if (!options.register_folder.empty()) {
        const app::Correction correction{
            .standard = options.source,
            .corrected = corrected,
            .reason = options.why.empty() ? "The standard " + options.source + " was corrected." : options.why,
            .templates = templates_folder(options.share)};
        if (table) {
            const app::WorkToShare shared = app::work_of(affected, correction, program_name());
            app::ArchiveWorker(archive, *table, threads, correction.templates).finish(shared, wait_for_others, tell);
            app::take_results(affected, *table, shared);
            work = shared.work.id;
        }
        DraftFolders drafts(options.output);
        app::recalculate(affected, archive, correction, threads, drafts.sink(), tell);
    }
    progress.clear();
    write_to_stdout(options.format == "json"  ? app::affected_json(affected, standard)
                    : options.format == "csv" ? app::affected_csv(affected)
                                              : app::affected_text(affected));
    if (!work.empty()) {
        table->remove(work);  // what is told need not be kept
    }
    return affected.empty() ? done : negative_answer;
}

ExitCode show_statistics(const ArchiveOptions& options, const CommonOptions&) {
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    const app::ArchiveStatistics statistics = app::statistics_of(archive);
    write_to_stdout(as_json(options) ? app::statistics_json(statistics) : app::statistics_text(statistics));
    return done;
}

constexpr std::array<Action, 20> k_actions = {{
    {"init", 0, 0, "nothing more", " store by why format numbering person four ", init_archive},
    {"settings", 0, 0, "nothing more", " store by why today key format numbering person four ", change_settings},
    {"number", 0, 0, "nothing more", " store by why today key format amend ", take_number},
    {"add", 1, k_any, "a record and its documents", " store by why today key format trust ", add_certificate},
    {"review", 1, 1, "the number of a certificate", " store by why today key format ", review_certificate},
    {"authorise", 1, 1, "the number of a certificate", " store by why today key format ", authorise_certificate},
    {"issue", 1, 1, "the number of a certificate", " store by why today key format ", issue_certificate},
    {"amend", 1, k_any, "the record of the amendment and its documents", " store by why today key format trust ",
     amend_certificate},
    {"withdraw", 1, 1, "the number of a certificate", " store by why today key format ", withdraw_certificate},
    {"list", 0, k_any, "words to search for, or nothing for all", " store format ", list_certificates},
    {"show", 1, 1, "the number of a certificate", " store format ", show_certificate},
    {"export", 1, 1, "the number of a certificate", " store output sign since ", export_certificate},
    {"head", 0, 0, "nothing more", " store output sign since ", write_head},
    {"verify", 0, k_any, "files of evidence, or --store", " store format head trust ", verify_archive},
    {"backup", 0, 0, "nothing more", " store by why today key format output ", back_up},
    {"migrate", 0, 0, "nothing more", " store to format ", migrate},
    {"replay", 0, k_any, "numbers of certificates, or nothing for all", " store format shared ", replay},
    {"worker", 0, 0, "nothing more", " store wait ", work_for_others},
    {"statistics", 0, 0, "nothing more", " store format ", show_statistics},
    {"affected", 0, 0, "nothing more", " store why format csv output source since until register shared ",
     find_affected},
}};

struct GivenOption {
    const char* word;  ///< in Action::takes
    const char* name;  ///< as it is typed
    bool given;
};

void require_options(const Action& action, const ArchiveOptions& o) {
    const std::array<GivenOption, 22> given = {{{"store", "--store", !o.store.empty()},
                                                {"to", "--to", !o.to.empty()},
                                                {"by", "--by", !o.by.empty()},
                                                {"why", "--why", !o.why.empty()},
                                                {"key", "--request-key", !o.request_key.empty()},
                                                {"format", "--format", !o.format.empty()},
                                                {"output", "--output", !o.output.empty()},
                                                {"numbering", "--numbering", !o.numbering.empty()},
                                                {"person", "--person", !o.persons.empty()},
                                                {"four", "--no-four-eyes", o.one_pair_of_eyes},
                                                {"head", "--head", !o.heads.empty()},
                                                {"sign", "--sign", !o.sign.empty()},
                                                {"trust", "--trust", !o.trust.empty()},
                                                {"csv", "--format csv", o.format == "csv"},
                                                {"amend", "--amend", !o.amend.empty()},
                                                {"source", "--source", !o.source.empty()},
                                                {"since", "--since", !o.since.empty()},
                                                {"until", "--until", !o.until.empty()},
                                                {"register", "--register", !o.register_folder.empty()},
                                                {"shared", "--shared", o.shared},
                                                {"today", "--today", !o.today.empty()},
                                                {"wait", "--wait-for-work", o.wait}}};
    const auto takes = [&](const char* word) {
        return action.takes.find(" " + std::string(word) + " ") != std::string_view::npos;
    };
    const std::string command = std::string("archive ") + action.name;
    for (const GivenOption& option : given) {
        if (option.given && !takes(option.word)) {
            refuse_usage(command, std::string(option.name) + " says nothing here", "see gumcert archive --help",
                         "leave it out");
        }
    }
    if (o.named.size() < action.least || o.named.size() > action.most) {
        refuse_usage(command, std::to_string(o.named.size()) + " names", std::string("takes ") + action.what,
                     "see gumcert archive --help");
    }
    const bool of_files = std::string_view(action.name) == "verify" && !o.named.empty();
    if (o.store.empty() != of_files) {
        refuse_usage(command, o.store.empty() ? "--store is missing" : "--store and files of evidence",
                     "an action has one archive; evidence is verified without any",
                     o.store.empty() ? "name the file of the archive" : "leave one of them out");
    }
    if (!o.today.empty() && (!app::is_day(o.today) || o.today != time_now().substr(0, o.today.size()))) {
        refuse_usage(command, "--today " + o.today + (app::is_day(o.today) ? "" : " is no day"),
                     "it is the day of the calendar, and the clock of this machine says " + time_now(),
                     "look at a calendar: set the clock right, or correct the day");
    }
    if (takes("by") && o.by.empty()) {
        refuse_usage(command, "--by is missing", "every entry of the log says who", "name the person who does this");
    }
    if (std::string_view(action.name) == "backup" && o.output.empty()) {
        refuse_usage(command, "--output is missing", "a backup is a new file", "name it with -o");
    }
    if (takes("to") && o.to.empty()) {
        refuse_usage(command, "--to is missing", "an archive is copied into a new one",
                     "name a new file, or an empty database as postgresql://…");
    }
    const std::string_view name = action.name;
    // A blank is no reason, of whatever width it is.
    bool says_nothing = true;
    for (std::size_t at = 0; at < o.why.size() && says_nothing;) {
        const text::Character one = text::decode_utf8(o.why, at);
        says_nothing = one.bytes > 0 && (text::is_blank(one.code) || text::is_hidden(one.code));
        at += one.bytes;
    }
    if ((name == "withdraw" || name == "settings" || !o.why.empty()) && says_nothing) {
        refuse_usage(command, o.why.empty() ? "--why is missing" : "--why has no word",
                     "what is withdrawn, or settled otherwise, has a reason", "say why");
    }
}

}  // namespace

ExitCode use_archive(const ArchiveOptions& options, const CommonOptions& common) {
    const auto* const action =
        std::find_if(k_actions.begin(), k_actions.end(), [&](const Action& a) { return options.action == a.name; });
    if (action == k_actions.end()) {
        throw std::logic_error("an action that nothing does: " + options.action);
    }
    require_options(*action, options);
    return action->work(options, common);
}

}  // namespace gumcert::cli
