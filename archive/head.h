#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "archive/store/entry.h"
#include "archive/store/merkle.h"

namespace gumcert::archive {

/// What an archive is at one moment, in a few lines: kept elsewhere, it proves later that nothing before it was changed
/// or cut off.
struct Head {
    std::string archive;    ///< hash of the first entry: which archive it is; 32 bytes, as all hashes here
    std::int64_t size = 0;  ///< entries
    std::string root;       ///< of the Merkle tree over the hashes of the entries (archive/store/merkle.h)
    std::string chain;      ///< hash of the last entry
    std::string at;         ///< time of the last entry
    /// What the clock of the last entry said, where that entry states it; "" else. By it goes what is signed, and when.
    std::string clock = {};
    struct Signature {
        std::string public_key;  ///< Ed25519, 32 bytes
        std::string value;       ///< 64 bytes, over signed_bytes()
        friend bool operator==(const Signature&, const Signature&) = default;
    };
    std::optional<Signature> signature = {};
    /// Shows that the archive begins with all that an earlier head speaks of. It is not signed: it proves itself.
    struct Extension {
        std::int64_t size = 0;           ///< of the earlier head
        std::string root;                ///< of the earlier head
        std::vector<std::string> proof;  ///< archive/store/merkle.h
        friend bool operator==(const Extension&, const Extension&) = default;
    };
    std::optional<Extension> extends = {};

    friend bool operator==(const Head&, const Head&) = default;
};

/// A log that is walked through from its first entry, and the head that it has so far.
class WalkedLog {
public:
    void add(const LogEntry& entry);
    /// All of it but the root, which takes time.
    [[nodiscard]] const Head& without_root() const { return head_; }
    [[nodiscard]] Head head() const;
    /// The same with the proof that it extends an earlier one.
    /// \return none where it does not
    [[nodiscard]] std::optional<Head> head_since(const Head& earlier) const;
    [[nodiscard]] const MerkleTree& tree() const { return tree_; }

private:
    Head head_;
    MerkleTree tree_;
};

/// Whether the proof in a head shows that its log begins with that of an earlier one, without the archive; two of one size
/// need none, and say the same.
[[nodiscard]] bool proves_extension(const Head& later, const Head& earlier);
/// Whether proofs lead from a later head to an earlier one, directly or through others: each proof is of roots, so that none of
/// the heads between them has to be trusted.
/// \param known   heads that may stand between the two
/// \param proves  whether the one head proves that it extends the other
[[nodiscard]] bool leads_to(const Head& later, const Head& earlier, const std::vector<Head>& known,
                            const std::function<bool(const Head&, const Head&)>& proves = proves_extension);
/// Whether a head says this of the last entry that it speaks of; one from before clocks were stated says nothing of its clock.
[[nodiscard]] bool ends_with(const Head& head, std::string_view chain, std::string_view at, std::string_view clock);
/// Whether two heads of one size say the same of it.
[[nodiscard]] bool is_same_log(const Head& one, const Head& other);
/// When the last entry was written, as far as it says: by its clock, or by the log.
[[nodiscard]] const std::string& time_of(const Head& head);
/// The same for a reader, with both where they differ.
[[nodiscard]] std::string time_in_words(const Head& head);
/// Whether the proof in a head leads from the root that it names to its own.
[[nodiscard]] bool proves_its_extension(const Head& head);

/// Canonical JSON with hashes in hexadecimal, schema "gumcert/archive-head/1".
[[nodiscard]] std::string to_json(const Head& head);
/// \param name  of the file, for messages
/// \throws gum::InputError  GC-ARCHIVE-0049 where it is no head
[[nodiscard]] Head head_from_json(std::string_view text, const std::string& name);
/// The same of JSON that was read before.
[[nodiscard]] Head head_in(const nlohmann::json& value, const std::string& name);
/// The first member of an object that is none of those that are known, "" where there is none: nothing stands in a head or in evidence
/// of which nothing would be proved.
[[nodiscard]] std::string member_beside(const nlohmann::json& object, std::initializer_list<std::string_view> known);
/// A signature as files have it, with algorithm, key and value.
[[nodiscard]] nlohmann::json to_json(const Head::Signature& signature);
/// \return none where it is of another form
[[nodiscard]] std::optional<Head::Signature> signature_in(const nlohmann::json& value);

/// What a signature of a head is over: its canonical JSON without the signature.
[[nodiscard]] std::string signed_bytes(const Head& head);

}  // namespace gumcert::archive
