#include "app/cli/archive/proof.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/cli/archive/action.h"
#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/terminal.h"
#include "archive/archive.h"
#include "archive/certificates/archive_files.h"
#include "archive/evidence.h"
#include "encoding/sha2.h"
#include "evaluation/read_file.h"
#include "outputs/output_files.h"
#include "signing/ed25519.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

namespace fs = std::filesystem;

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
            outputs::require_writable(place_);
            outputs::require_not_an_input(place_, inputs_);
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
            print_to_stdout("Written: {}\n", text::one_line(place_));
        }
    }

private:
    std::string place_;
    std::vector<fs::path> inputs_;
    bool quiet_;
    outputs::OutputsAtStart at_start_;
};

archive::Head::Signature signature_of(const std::string& bytes, const std::string& key) {
    signing::Ed25519Signature signature = signing::sign_ed25519(bytes, key);
    return {std::move(signature.public_key), std::move(signature.value)};
}

void sign(archive::Head& head, const std::string& key) {
    if (!key.empty()) {
        if (archive::time_of(head) > latest_time()) {
            throw gum::StorageError(gum::Diagnostic{
                .code = "GC-ARCHIVE-0066",
                .where = "the clock of this machine",
                .what = "says " + time_now() + ", and the last entry is of " + head.at,
                .rule = "what is signed speaks of a time that has come",
                .action =
                    "look at a calendar: set the clock right; where it is, and was ahead, write an entry with --today, "
                    "such "
                    "as that of gumcert archive backup, and sign then; without --sign the head is written as it is"});
        }
        head.signature = signature_of(archive::signed_bytes(head), key);
    }
}

/// The earlier head of --since: a file of a head, or of evidence, which has one.
std::optional<archive::Head> head_since_of(const ArchiveOptions& options) {
    if (options.since.empty()) {
        return std::nullopt;
    }
    const std::string text = evaluation::read_file(options.since);
    return archive::archive_file_of(text) == archive::ArchiveFile::evidence
               ? archive::evidence_from_json(text, options.since).head
               : archive::head_from_json(text, options.since);
}

/// Several numbers, "N/1" and "N_1", have one name of a file. Whoever has not named the file does not know that it stands for
/// another certificate.
void require_own_evidence(const fs::path& file, const std::string& number) {
    std::error_code error;
    const std::string other =
        fs::exists(file, error) ? archive::certificate_of_evidence(evaluation::read_file(file)) : std::string();
    if (!other.empty() && other != number) {
        refuse_usage(file.string(), "is evidence of " + text::one_line(other) + ", not of " + text::one_line(number),
                     "evidence of two certificates stands in two files", "name another file with -o");
    }
}

/// What was found of a file or an archive.
ExitCode told(const archive::VerifiedFile& said, const ArchiveOptions& options, const CommonOptions& common) {
    print_findings(said.findings, common);
    if (as_json(options)) {
        print_json(said.json);
    } else if (!common.quiet) {
        write_to_stdout(said.text);
    }
    return said.sound() ? done : negative_answer;
}

/// A file that is verified, and the documents in hand that should be those of it.
struct GivenFile {
    std::string file;
    std::string text;  ///< read once: it may be another one a moment later
    archive::ArchiveFile kind;
    std::vector<archive::DocumentInHand> documents;
};

/// Evidence and heads, each by itself; what is neither, and stands behind evidence, should be a document of the evidence
/// before it. tools/verify_archive.py reads its files in the same way.
ExitCode verify_files(const ArchiveOptions& options, const CommonOptions& common) {
    archive::TrustedHeads heads(options.heads, options.trust, latest_time());
    std::vector<GivenFile> given;
    std::optional<std::size_t> evidence;  // the last one
    ExitCode code = done;
    for (const std::string& file : options.named) {
        code = std::max(code, explained(common, [&] {
                            std::string text = evaluation::read_file(file);
                            const archive::ArchiveFile kind = archive::archive_file_of(text);
                            if (kind == archive::ArchiveFile::other && evidence) {
                                given[*evidence].documents.push_back({file, encoding::sha256(text)});
                                return done;
                            }
                            evidence = kind == archive::ArchiveFile::evidence ? given.size() : evidence;
                            if (kind == archive::ArchiveFile::head) {
                                heads.know(text, file);
                            }
                            given.push_back({file, std::move(text), kind, {}});
                            return done;
                        }));
    }
    const std::string* compared = nullptr;  // the first document that was
    bool has_others = false;
    for (GivenFile& one : given) {
        const std::string& file = one.file;
        const std::string& text = one.text;
        std::vector<archive::DocumentInHand>& documents = one.documents;
        code = std::max(code, explained(common, [&] {
                            const archive::VerifiedFile said =
                                one.kind == archive::ArchiveFile::head
                                    ? archive::verified_head(text, file, heads)
                                    : archive::verified_evidence(text, file, heads, documents);
                            return told(said, options, common);
                        }));
        const std::vector<gum::Diagnostic> of_others = archive::findings_of(documents);
        print_findings(of_others, common);
        has_others = has_others || !of_others.empty();
        compared = compared == nullptr && !documents.empty() ? &documents.front().file : compared;
    }
    if (compared != nullptr && !has_others) {
        const std::vector<gum::Diagnostic> notes{
            {.code = "GC-ARCHIVE-0071",
             .where = *compared,
             .what = "compared with the evidence: its bytes, by their SHA-256; not compared here: what its pages say "
                     "with what "
                     "the record says",
             .rule = "documents are held against their record when they are added",
             .action = "read the document beside the record, where the laboratory is not to be relied on",
             .severity = gum::Severity::note}};
        print_messages(notes, common);
    }
    return has_others ? std::max(code, negative_answer) : code;
}

}  // namespace

ExitCode export_certificate(const ArchiveOptions& options, const CommonOptions& common) {
    const std::string output = options.output.empty()
                                   ? archive::file_name_of_number(options.named.front()) + "-evidence.json"
                                   : options.output;
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
        evidence.states = archive::states_in(evidence, std::max(time_now(), archive::time_of(evidence.head)));
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

ExitCode verify_archive(const ArchiveOptions& options, const CommonOptions& common) {
    if (!options.named.empty()) {
        return verify_files(options, common);
    }
    const archive::TrustedHeads heads(options.heads, options.trust, latest_time());
    const auto store = opened(options, archive::Access::read_only);
    ProgressLine progress(!common.quiet);
    const archive::VerifiedFile said =
        archive::verified_store(*store, heads, [&](const std::string& text) { progress(text); });
    progress.clear();
    return told(said, options, common);
}

}  // namespace gumcert::cli
