#include "issuing/verification_text.h"

#include <cstddef>

#include "text/visible_text.h"

namespace gumcert::issuing {

namespace {

std::string or_not_stated(const std::string& text) {
    return text.empty() ? "not stated" : text;
}

std::string row_of(const std::string& name, const std::string& text) {
    constexpr std::size_t k_width = 12;
    return "  " + name + std::string(k_width - name.size(), ' ') + text + "\n";
}

std::string signature_text(const signing::SignatureReport& signature, const std::string& of) {
    std::string text = "  " + of + signature.format + ": " + (signature.valid ? "valid" : "NOT VALID") + "\n";
    text += "  " + row_of("signer", or_not_stated(signature.signer));
    text += "  " + row_of("issued by", or_not_stated(signature.issuer));
    text +=
        "  " + row_of("time", signature.signing_time.empty() ? "not stated"
                                                             : signature.signing_time + " (as the signer states it)");
    text += "  " + row_of("algorithm", signature.algorithm);
    for (const std::string& part : signature.covers) {
        text += "  " + row_of("covers", part);
    }
    for (const std::string& part : signature.not_covered) {
        text += "  " + row_of("not covered", part);
    }
    return text;
}

std::string identity_text(const DocumentIdentity& identity) {
    std::string text;
    const auto row = [&](const std::string& name, const std::string& value) {
        text += value.empty() ? "" : row_of(name, value);
    };
    const bool days = !identity.performed_to.empty() && identity.performed_to != identity.performed_from;
    row("number", identity.number + (identity.attached ? " (of the digital certificate in it)" : ""));
    row("laboratory", identity.laboratory);
    row("item", identity.item);
    row("performed", identity.performed_from + (days ? " to " + identity.performed_to : ""));
    row("issued", identity.issued);
    row("state", identity.state);
    return text;
}

}  // namespace

std::string verification_text(const std::string& file, const signing::Verification& verification,
                              const std::vector<DocumentIdentity>& identities) {
    const bool attachment_alone = verification.signatures.empty() && !verification.attachment_signatures.empty();
    std::string text = text::one_line(file) + ": " +
                       (verification.valid ? "valid"
                        : attachment_alone ? "NOT VALID: the pages are not signed, only what is attached to them"
                        : verification.signatures.empty() ? "not signed"
                                                          : "NOT VALID") +
                       "\n";
    for (const DocumentIdentity& identity : identities) {
        text += identity_text(identity);
    }
    for (const signing::SignatureReport& signature : verification.signatures) {
        text += signature_text(signature, "");
    }
    for (const signing::SignatureReport& signature : verification.attachment_signatures) {
        text += signature_text(signature, "attached certificate, ");
    }
    return text;
}

}  // namespace gumcert::issuing
