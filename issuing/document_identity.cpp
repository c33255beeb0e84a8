#include "issuing/document_identity.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "certificate/text_words.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/printable_text.h"

namespace gumcert::issuing {

namespace {

using gum::Diagnostic;
using signing::SignatureReport;
using signing::Verification;

constexpr std::size_t k_day = 10;  // characters of "2026-03-31"; such texts sort as the days do

std::optional<DocumentIdentity> identity_of(const signing::Bytes& xml, const std::string& name, bool attached) {
    try {
        const reports::ImportedCertificate c = reports::read_dcc(xml, name);
        return DocumentIdentity{.number = reports::printable(c.identifier),
                                .laboratory = reports::printable(c.laboratory),
                                .item = reports::printable(c.item),
                                .performed_from = reports::printable(c.performed_from),
                                .performed_to = reports::printable(c.performed_to),
                                .issued = reports::printable(c.issued),
                                .state = c.state,
                                .attached = attached};
    } catch (const gum::InputError&) {  // another kind of XML: it has no such identity
        return std::nullopt;
    }
}

/// Words that say what kind of company it is, or what the certificate is for: they make no other name of it.
constexpr std::u32string_view k_additions =
    U" ltd limited inc incorporated llc corp corporation co company plc gmbh ag kg ohg mbh ev ggmbh se sa sas sarl sl "
    U"slu srl spa bv nv oy ab as kk pte pty seal siegel sello stamp signature signing signatur signer the der die das "
    U"el la los las of and und y ";

/// The words of a name without such additions and without numbers behind it ("seal 3").
std::u32string comparable(const std::string& name) {
    std::vector<std::u32string> words = certificate::words_of(name);
    const bool sealed = std::any_of(words.begin(), words.end(), [](const std::u32string& word) {
        return word == U"seal" || word == U"siegel" || word == U"sello" || word == U"stamp";
    });
    while (sealed && !words.empty() && words.back().find_first_not_of(U"0123456789") == std::u32string::npos) {
        words.pop_back();
    }
    std::u32string text;
    for (const std::u32string& word : words) {
        const bool addition = k_additions.find(U' ' + word + U' ') != std::u32string_view::npos;
        text += addition ? std::u32string() : word;
    }
    return text;
}

/// The whole name, as CN, O or OU: "Example Laboratory" has not signed for "Another Example Laboratory", and neither
/// has somebody called "Example".
bool is_of(const SignatureReport& signature, const std::string& laboratory) {
    const std::u32string whole = comparable(laboratory);
    return !whole.empty() && std::any_of(signature.signer_names.begin(), signature.signer_names.end(),
                                         [&](const std::string& one) { return comparable(one) == whole; });
}

class Doubts {
public:
    Doubts(std::string name, const Verification& verification) : name_(std::move(name)), verification_(verification) {}

    std::vector<Diagnostic> all(const std::vector<DocumentIdentity>& identities) {
        for (const DocumentIdentity& identity : identities) {
            look_at_signers(identity);
            look_at_dates(identity);
            if (!identity.state.empty() && !signatures().empty()) {
                add("GC-SIGN-0154", "a signed " + identity.state, "issued certificates are signed",
                    "do not use it as a certificate");
            }
            if (identity.attached && !verification_.pdf_keywords.empty() &&
                reports::printable(verification_.pdf_keywords) != identity.number) {
                add("GC-SIGN-0152",
                    "the PDF has the number \"" + reports::printable(verification_.pdf_keywords) +
                        "\", and the digital certificate in it \"" + identity.number + '"',
                    "pages and digital certificate are of one calibration", "ask the laboratory which one is meant");
            }
        }
        look_at_both_signers();
        return std::move(found_);
    }

private:
    std::string name_;
    const Verification& verification_;
    std::vector<Diagnostic> found_;

    [[nodiscard]] std::vector<const SignatureReport*> signatures() const {
        std::vector<const SignatureReport*> all;
        for (const auto* reports : {&verification_.signatures, &verification_.attachment_signatures}) {
            for (const SignatureReport& report : *reports) {
                all.push_back(&report);
            }
        }
        return all;
    }

    void add(const char* code, std::string what, const char* rule, const char* action) {
        const bool known = std::any_of(found_.begin(), found_.end(),
                                       [&](const Diagnostic& d) { return d.code == code && d.what == what; });
        if (!known) {
            found_.push_back({.code = code,
                              .where = name_,
                              .what = std::move(what),
                              .rule = rule,
                              .action = action,
                              .severity = gum::Severity::warning});
        }
    }

    void look_at_signers(const DocumentIdentity& identity) {
        for (const SignatureReport* signature : signatures()) {
            if (!signature->signer.empty() && !identity.laboratory.empty() && !is_of(*signature, identity.laboratory)) {
                add("GC-SIGN-0150",
                    "signed by " + signature->signer + ", and the certificate is one of " + identity.laboratory,
                    "a laboratory signs its certificates itself", "ask the laboratory whether this signer acts for it");
            }
        }
    }

    void look_at_dates(const DocumentIdentity& identity) {
        const std::string issued = identity.issued.substr(0, k_day);
        const std::string performed = identity.performed_to.substr(0, k_day);
        if (!issued.empty() && !performed.empty() && issued < performed) {
            add("GC-SIGN-0153", "issued " + issued + ", before the work ended on " + performed,
                "a certificate is issued when the work is done", "ask the laboratory which date is right");
        }
        for (const SignatureReport* signature : signatures()) {
            const std::string signed_on = signature->signing_time.substr(0, k_day);
            for (const auto& [day, what] : {std::pair(issued, "issued"), std::pair(performed, "the work ended on")}) {
                // A day has ended elsewhere before it has in UTC.
                if (!signed_on.empty() && day.size() == k_day && next_day(signed_on) < day) {
                    add("GC-SIGN-0153", "signed on " + signed_on + ", before " + what + " " + day,
                        "a certificate is signed when it is issued", "ask the laboratory which date is right");
                }
            }
        }
    }

    /// The day after, near enough for a comparison: months of 31 days.
    static std::string next_day(const std::string& day) {
        const bool plain = day.size() == k_day && day[8] >= '0' && day[8] <= '9' && day[9] >= '0' && day[9] <= '9';
        if (!plain) {
            return day;
        }
        const int number = 10 * (day[8] - '0') + (day[9] - '0') + 1;
        return day.substr(0, k_day - 2) + static_cast<char>('0' + number / 10) + static_cast<char>('0' + number % 10);
    }

    void look_at_both_signers() {
        for (const SignatureReport& outer : verification_.signatures) {
            for (const SignatureReport& inner : verification_.attachment_signatures) {
                if (!outer.signer.empty() && !inner.signer.empty() && outer.signer != inner.signer) {
                    add("GC-SIGN-0151",
                        "the PDF was signed by " + outer.signer + ", the digital certificate in it by " + inner.signer,
                        "both forms of a certificate have one signer", "ask the laboratory why they differ");
                }
            }
        }
    }
};

}  // namespace

std::vector<DocumentIdentity> identities_in(const signing::Bytes& file, const std::string& name,
                                            const Verification& verification) {
    std::vector<DocumentIdentity> all;
    const auto add = [&](const signing::Bytes& xml, bool attached) {
        if (std::optional<DocumentIdentity> one = identity_of(xml, name, attached)) {
            all.push_back(std::move(*one));
        }
    };
    if (verification.kind == "dcc") {
        add(file, false);
    }
    for (const signing::Bytes& attachment : verification.attachments) {
        add(attachment, true);
    }
    return all;
}

std::vector<Diagnostic> doubts_about(const std::string& name, const std::vector<DocumentIdentity>& identities,
                                     const Verification& verification) {
    return Doubts(name, verification).all(identities);
}

}  // namespace gumcert::issuing
