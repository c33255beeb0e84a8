#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "archive/log_times.h"
#include "archive/settings.h"
#include "archive/store/entry.h"

namespace gumcert::archive {

/// A certificate as its entries tell it so far.
struct CertificateLife {
    std::string state;                   ///< kind of the newest entry that changed it: "issued"; "" before the first
    std::string since;                   ///< time of that entry
    std::string record;                  ///< SHA-256 of the record that holds; "" before one is there
    std::string item;                    ///< what was calibrated
    std::vector<std::string> documents;  ///< SHA-256 of those that hold
    std::set<std::string> authors;       ///< of all its drafts
    std::string authorised_by;           ///< who authorised the draft that holds; "" before
    std::string issued_at;               ///< time of its issue, by its own clock; "" before
    std::string number_amends;           ///< original for which the number was taken; "" else
    std::string amends;                  ///< number of the certificate that it amends or replaces; "" else
    std::string amendment_kind;          ///< "amended" or "replaced"; "" else
    std::string later;                   ///< number of the certificate that amends or replaces it; "" else
};

/// A rule of the log that an entry breaks.
struct Breach {
    /// Of `number` and `clock` a part of the log says nothing.
    enum class Kind { form, order, clock, life, four_eyes, role, number, amendment, settings };
    Kind kind = Kind::form;
    std::string what;  ///< what the entry has, in words
    std::string rule;
};

/// The rules that one entry after the other obeys, whoever wrote it and however: life of a certificate, four eyes,
/// roles, numbers, amendments, times. The writer asks them before it writes, and the verifier of every entry again.
/// They know nothing of hashes. (docs/adr/0053-the-archive.md has all of them in words)
class LogRules {
public:
    /// Takes an entry, where it breaks no rule.
    [[nodiscard]] std::optional<Breach> accept(const LogEntry& entry);
    /// Takes an entry that was accepted before: of a part of the log that is enough for the next one.
    void take(const LogEntry& entry);
    /// Where entries that were taken are a part of the log: the time of its last entry.
    void go_on_after(const std::string& last_at);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    /// \return none where no entry named it
    [[nodiscard]] const CertificateLife* life(const std::string& certificate) const;
    [[nodiscard]] const std::map<std::string, CertificateLife>& lives() const { return lives_; }
    /// Whether an amendment may take its place: it is issued and holds, or what took its place was withdrawn.
    [[nodiscard]] bool may_be_amended(const std::string& certificate) const;
    /// The highest ordinal of a series that is taken; 0 where none is.
    [[nodiscard]] long long last_ordinal(const std::string& series) const;
    /// The next ordinal of the amendments of a certificate: of all that are known, the first one behind those taken that
    /// nobody has chosen by hand.
    [[nodiscard]] long long next_amendment(const std::string& original) const;
    /// What must come next: "amended-by EX-1": an amendment that is issued, and the entry of the original is missing. ""
    /// where anything may come.
    [[nodiscard]] std::string due() const;

private:
    Settings settings_;
    bool created_ = false;
    std::string last_at_;
    std::map<std::string, CertificateLife> lives_;
    std::map<std::string, long long> ordinals_;
    std::string due_kind_, due_certificate_, due_by_;

    std::optional<Breach> breach_of(const LogEntry& entry, const nlohmann::json& body) const;
    std::optional<Breach> breach_of_archive(const LogEntry& entry, const nlohmann::json& body) const;
    std::optional<Breach> breach_of_life(const LogEntry& entry, const nlohmann::json& body) const;
    [[nodiscard]] bool is_next_number(const LogEntry& entry, const nlohmann::json& body) const;
    std::optional<Breach> breach_of_draft(const LogEntry& entry, const nlohmann::json& body) const;
    std::optional<Breach> breach_of_person(const LogEntry& entry) const;
    void apply(const LogEntry& entry, const nlohmann::json& body);
};

/// The state of a certificate in a sentence that begins "certificate EX-1 is": "amended by EX-1/A1".
/// \param life  none where the archive knows nothing of it
[[nodiscard]] std::string worded_state(const CertificateLife* life);

/// The rule for originals of amendments.
inline constexpr const char* k_amendable_rule =
    "an amendment amends or replaces a certificate that is issued and holds, or whose amendment was withdrawn";

/// Series of the amendments of a certificate: "EX-2026-0001/A", before the ordinal.
[[nodiscard]] std::string series_of_amendments(const std::string& original);
/// Body of an entry as JSON; none where it is none, or not an object.
[[nodiscard]] std::optional<nlohmann::json> body_of(const LogEntry& entry);
/// A text of the body, such as "state" in its part "new"; "" where there is none.
[[nodiscard]] std::string text_in(const nlohmann::json& body, const char* part, const char* key);
/// SHA-256 of the documents that the body of a draft names.
[[nodiscard]] std::vector<std::string> documents_in(const nlohmann::json& body);
/// Kinds of entries that change the state of a certificate, in the order of its life.
[[nodiscard]] const std::vector<std::string>& kinds_of_life();
[[nodiscard]] bool is_of_life(std::string_view kind);
/// What a person needs to be for an entry of a kind: "author" of "drafted".
[[nodiscard]] std::string role_of(std::string_view kind);

}  // namespace gumcert::archive
