#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "archive/head.h"
#include "archive/log_rules.h"
#include "archive/log_times.h"
#include "archive/settings.h"
#include "archive/store/store.h"

namespace gumcert::archive {

/// Who asks for an entry, when and why.
struct Request {
    std::string actor;
    std::string at;           ///< UTC, "2026-11-24T18:52:52Z"
    std::string request_key;  ///< the same key gives the same entry: a client may ask again after a crash; "" without
    std::string why;
    /// "2026-11-24": the person has looked at a calendar, within a day of `at`. An entry more than a week after the last one, or a
    /// number more than a day after an entry of another year, needs it, because no later entry may be earlier; and one that is earlier
    /// all the same, after a clock that was ahead: it gets the time of the last entry, and says what its clock said.
    std::string confirmed_day = {};
};

/// A document that belongs to a record.
struct Document {
    std::string name;        ///< of its file
    std::string media_type;  ///< "application/pdf"
    std::string bytes;
};

/// Something that an amendment states otherwise than its original.
struct AmendedPlace {
    std::string kind, where, before, after;
};

/// A record with its documents, as it comes into the archive.
struct Draft {
    std::string number;  ///< of the certificate
    std::string item;    ///< what was calibrated, for lists
    std::string record;  ///< bytes
    std::vector<Document> documents;
    struct Amends {
        std::string number, kind;  ///< of the original; "amended" or "replaced"
        std::vector<AmendedPlace> changes;
    };
    std::optional<Amends> amends = {};
};

struct Written {
    LogEntry entry;
    bool repeated = false;  ///< the entry was there already, asked for with the same key
};

/// What lists say of a certificate with such a life.
[[nodiscard]] ListedCertificate listed_as(const std::string& number, const CertificateLife& life);
/// Makes what lists say of every certificate from the log alone; inside of write() of the store.
void list_again(Store& store);

/// First entry of an archive.
/// \param software  that makes it, with its version
/// \param nonce     some random text, by which two archives differ
/// \throws gum::InputError  GC-ARCHIVE-0020, -0025
[[nodiscard]] LogEntry first_entry(const Settings& settings, const std::string& software, const std::string& nonce,
                                   const Request& request);

/// \throws gum::InputError  GC-ARCHIVE-0026: a certificate that is not in an archive
/// \param archive  its name, for the message
[[noreturn]] void refuse_unknown(const std::string& certificate, const std::string& archive);

/// An archive of certificates on some store. Each function that writes is one transaction; several programs may write at
/// the same time.
///
/// \throws gum::InputError  where a rule of the log refuses it, GC-ARCHIVE-0020 to -0027, -0031, -0032; nothing is
///                          written then
class Archive {
public:
    using Judge = std::function<void(const std::string& record, const CertificateLife& life)>;

    explicit Archive(Store& store) : store_(store) {}

    /// Takes the next certificate number; where it is not used in the end, it is withdrawn with a reason.
    /// \return its entry names it
    Written take_number(const Request& request);
    /// Takes the next number for an amendment of an issued certificate: "EX-2026-0001/A1", A2 …
    Written take_amendment_number(const std::string& original, const Request& request);
    /// \throws gum::InputError  GC-ARCHIVE-0037 where a document prints a head that this archive never had, or that does
    ///                          not contain an earlier draft of the same record
    Written draft(const Draft& draft, const Request& request);
    /// \param kind   "reviewed", "authorised", "issued" or "withdrawn". With an amendment that is issued its original is
    ///               amended or superseded, in one transaction.
    /// \param judge  is given the bytes of the record that is reviewed, authorised or issued, and its life before, inside
    ///               of the transaction: where it throws, nothing is written
    /// \throws gum::StorageError  GC-ARCHIVE-0012 where its record or a document is missing, or has other bytes
    Written advance(const std::string& certificate, const std::string& kind, const Request& request,
                    const Judge& judge = {});
    Written change_settings(const Settings& settings, const Request& request);
    /// \param file  name of the copy
    /// \param copy  head of the copy
    Written note_backup(const std::string& file, const Head& copy, const Request& request);

    [[nodiscard]] Settings settings();
    /// \throws gum::InputError  GC-ARCHIVE-0026 where it is not in the archive
    [[nodiscard]] CertificateLife life(const std::string& certificate);
    [[nodiscard]] std::vector<LogEntry> history(const std::string& certificate);
    /// Of all entries: which of them are of clocks that were ahead.
    [[nodiscard]] LogTimes times();
    /// As the table of lists says: fast, for people. What decides something asks certificates().
    [[nodiscard]] std::vector<ListedCertificate> list();
    /// As the log says, by number.
    /// \throws gum::StorageError  GC-ARCHIVE-0013 where an entry has other fields than those that were hashed
    [[nodiscard]] std::vector<ListedCertificate> certificates();
    /// The certificates that have a record, with its bytes, all of one state of the archive, as the log says.
    /// \param begin  is given the lives of all certificates by number, before the first record
    /// \throws gum::StorageError  GC-ARCHIVE-0012, -0013 where contents or entries are not what was written
    void each_record(const std::function<void(const std::map<std::string, CertificateLife>&)>& begin,
                     const std::function<void(const ListedCertificate&, std::string bytes)>& visit);
    /// Bytes of a record or document.
    [[nodiscard]] std::optional<std::string> content(const std::string& sha256);
    /// Bytes of the record that holds.
    [[nodiscard]] std::string record_of(const std::string& certificate);
    [[nodiscard]] Head head();
    /// The same with the proof that nothing was changed since an earlier head.
    /// \throws gum::InputError  GC-ARCHIVE-0036 where the archive does not begin with what it says
    [[nodiscard]] Head head_since(const Head& earlier);

private:
    Store& store_;
    std::map<std::string, std::string> numbers_by_form_;  ///< confusable_form() → number, as of an entry
    std::int64_t numbers_as_of_ = -1;                     ///< seq of that entry

    struct Asked;

    [[nodiscard]] std::map<std::string, CertificateLife> stated_by_log();
    [[nodiscard]] LogRules rules_for(const std::vector<std::string>& certificates, const std::string& series);
    [[nodiscard]] WalkedLog walked();
    LogEntry append(LogRules& rules, LogEntry entry);
    Written write(const LogEntry& wanted, const Request& request, const Asked& asked,
                  const std::function<LogEntry(nlohmann::json)>& work);
    void require_contents(const CertificateLife& life, const Judge& judge);
    void require_sound_clock(const LogEntry& entry);
    void require_distinct(const LogEntry& entry, const LogRules& rules);
    [[nodiscard]] bool still_holds(const LogEntry& known);
    void require_heads(const Draft& draft, const std::string& record);
    void require_known(const std::string& certificate, const std::vector<LogEntry>& entries);
};

}  // namespace gumcert::archive
