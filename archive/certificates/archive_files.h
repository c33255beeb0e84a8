#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "archive/head.h"
#include "archive/store/store.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

/// What a file may be that somebody has of an archive.
enum class ArchiveFile { head, evidence, other };
[[nodiscard]] ArchiveFile archive_file_of(std::string_view text);

/// A name of a file in which nothing of a number of a certificate leads elsewhere: "EX-2026-0042_A1" of
/// "EX-2026-0042/A1". Several numbers may give the same name.
[[nodiscard]] std::string file_name_of_number(std::string number);

/// The certificate that a file is evidence of; "" where it is no evidence.
[[nodiscard]] std::string certificate_of_evidence(std::string_view text);

/// "the head is of …, which has not come by the clock of this machine"; "" where it has.
/// \param latest  the latest time that has come
[[nodiscard]] std::string time_to_come(const std::string& what, const std::string& at, const std::string& latest);

/// Heads from elsewhere, and the key that they must be signed with.
class TrustedHeads {
public:
    /// \param files  of heads
    /// \param trust  PEM file of the public key of the laboratory; "" without
    /// \param latest  the latest time that has come, by the clock of the reader
    TrustedHeads(const std::vector<std::string>& files, const std::string& trust, std::string latest);

    [[nodiscard]] bool has_key() const { return !key_.empty(); }
    [[nodiscard]] const std::string& key() const { return key_; }
    [[nodiscard]] const std::vector<Head>& all() const { return heads_; }
    /// These, and others that are known: proofs may lead through each of them.
    [[nodiscard]] const std::vector<Head>& known() const { return known_; }
    /// \param text  of a file; nothing where it is no head
    void know(const std::string& text, const std::string& file);
    /// GC-ARCHIVE-0050, of their signatures.
    [[nodiscard]] const std::vector<gum::Diagnostic>& findings() const { return findings_; }
    [[nodiscard]] const std::string& latest() const { return latest_; }
    /// Lines, one for each head of a time that has not come.
    [[nodiscard]] std::vector<std::string> times_to_come() const;

private:
    std::string key_, latest_;
    std::vector<Head> heads_, known_;
    std::vector<gum::Diagnostic> findings_;
};

/// A document that somebody has in hand beside the evidence that should name it.
struct DocumentInHand {
    std::string file;
    std::string sha256;
    bool is_told = false;         ///< its evidence names it
    std::string earlier_of = {};  ///< number of the certificate of which it was a draft; "" without
};
/// GC-ARCHIVE-0057 for each one that its evidence does not name.
[[nodiscard]] std::vector<gum::Diagnostic> findings_of(const std::vector<DocumentInHand>& documents);

/// What there is to say of a file, or of an archive.
struct VerifiedFile {
    std::vector<gum::Diagnostic> findings;
    std::string text;     ///< for a reader, lines
    nlohmann::json json;  ///< the same for programs, schema "gumcert/archive-verification/1"

    [[nodiscard]] bool sound() const { return findings.empty(); }
};

/// Evidence: its own proofs, signatures, heads from elsewhere, and which of the documents in hand are its own. The state of
/// the certificate is proved where the trusted key has signed head and statement of states, else it is told as what the
/// entries show.
/// \throws gum::InputError  GC-ARCHIVE-0047, -0049
[[nodiscard]] VerifiedFile verified_evidence(const std::string& text, const std::string& file,
                                             const TrustedHeads& heads, std::vector<DocumentInHand>& documents);
/// A head without its archive: its signature, and whether it extends the earlier ones among those from elsewhere, and the later
/// ones extend it (GC-ARCHIVE-0051).
/// \throws gum::InputError  GC-ARCHIVE-0049
[[nodiscard]] VerifiedFile verified_head(const std::string& text, const std::string& file, const TrustedHeads& heads);
/// An archive as a whole, by verify_store(), which heads from elsewhere must be heads of.
[[nodiscard]] VerifiedFile verified_store(Store& store, const TrustedHeads& heads,
                                          const std::function<void(const std::string&)>& progress = {});

}  // namespace gumcert::archive
