#include "signing/document_verification.h"

#include <algorithm>

#include "signing/certificates.h"
#include "signing/time_texts.h"

namespace gumcert::signing {

namespace {

/// A character of UTF-8. `size` 0: the bytes are none.
struct Character {
    std::uint32_t code = 0;
    std::size_t size = 0;
};

Character character_at(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) -> std::uint32_t {
        return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
    };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80U) {
        return {.code = lead, .size = 1};
    }
    const std::size_t size = lead >= 0xF0U && lead < 0xF5U ? 4 : lead >= 0xE0U ? 3 : lead >= 0xC2U ? 2 : 0;
    if (size == 0 || lead >= 0xF5U) {
        return {};
    }
    std::uint32_t code = lead & (size == 4 ? 0x07U : size == 3 ? 0x0FU : 0x1FU);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) {
            return {};
        }
        code = (code << 6U) | (byte(i) & 0x3FU);
    }
    const bool too_long = code < (size == 4 ? 0x10000U : size == 3 ? 0x800U : 0x80U);
    const bool none = too_long || code > 0x10FFFFU || (code >= 0xD800U && code < 0xE000U);
    return none ? Character{} : Character{.code = code, .size = size};
}

/// Controls, characters without width, and those that turn the direction of a line (Unicode, categories Cc, Cf, Zl,
/// Zp).
bool is_hidden(std::uint32_t c) {
    return c < 0x20U || (c >= 0x7FU && c <= 0x9FU) || c == 0xADU || c == 0x61CU || (c >= 0x200BU && c <= 0x200FU) ||
           (c >= 0x2028U && c <= 0x202EU) || (c >= 0x2060U && c <= 0x206FU) || c == 0xFEFFU ||
           (c >= 0xFFF9U && c <= 0xFFFBU) || (c >= 0xE0000U && c <= 0xE007FU);
}

std::string hexadecimal_digits(std::uint32_t number) {
    std::string digits;
    for (; number != 0 || digits.size() < 2; number /= 16U) {
        digits.insert(digits.begin(), "0123456789ABCDEF"[number % 16U]);
    }
    return digits;
}

}  // namespace

std::string shown_text(std::string_view text) {
    constexpr int k_longest = 300;
    std::string shown;
    int characters = 0;
    for (std::size_t at = 0; at < text.size(); ++characters) {
        if (characters == k_longest) {
            return shown + "…";
        }
        const Character character = character_at(text, at);
        if (character.size == 0) {
            shown += "\\x{" + hexadecimal_digits(static_cast<unsigned char>(text[at])) + '}';
            ++at;
            continue;
        }
        shown += is_hidden(character.code) ? "\\u{" + hexadecimal_digits(character.code) + '}'
                                           : std::string(text.substr(at, character.size));
        at += character.size;
    }
    return shown;
}

void show_safely(std::vector<gum::Diagnostic>& messages) {
    for (gum::Diagnostic& message : messages) {
        message.what = shown_text(message.what);
    }
}

void show_safely(SignatureReport& report) {
    for (std::string* text :
         {&report.format, &report.signer, &report.issuer, &report.signing_time, &report.algorithm}) {
        *text = shown_text(*text);
    }
    for (std::string& name : report.signer_names) {
        name = shown_text(name);
    }
    show_safely(report.findings);
}

void add_error(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
               const char* rule, const char* action) {
    report.findings.push_back({.code = code, .where = where, .what = what, .rule = rule, .action = action});
}

void add_warning(SignatureReport& report, const char* code, const std::string& where, const std::string& what,
                 const char* rule, const char* action) {
    add_error(report, code, where, what, rule, action);
    report.findings.back().severity = gum::Severity::warning;
}

void check_signer(SignatureReport& report, const std::string& where, const std::vector<CertificateHandle>& chain,
                  const TrustedMaterial& trusted, const std::string& claimed_time, std::int64_t now) {
    X509* const signer = chain.front().get();
    report.signer = subject_of(signer);
    report.issuer = issuer_of(signer);
    report.signer_names = names_of(signer);
    std::int64_t time = now;
    if (!claimed_time.empty()) {
        const std::optional<std::int64_t> claimed = time_from_text(claimed_time);
        if (!claimed) {
            add_error(report, "GC-SIGN-0134", where, "the time of signing cannot be read: " + claimed_time,
                      "a time of signing is a date with time", "ask the laboratory for the document again");
        } else {
            time = *claimed;
            report.signing_time = time_text(time);
        }
    }
    constexpr std::int64_t k_clocks_may_differ = 300;  // seconds
    if (time > now + k_clocks_may_differ) {
        add_error(report, "GC-SIGN-0134", where,
                  "signed at " + time_text(time) + ", which is after the present time " + time_text(now),
                  "a signature is made before it is checked", "check the clock of this computer");
    }
    for (gum::Diagnostic& finding : check_chain(where, chain, trusted.certificates, time)) {
        report.findings.push_back(std::move(finding));
    }
    const std::optional<std::int64_t> end = end_of_validity(signer);
    if (end && *end < now && time <= *end) {
        report.findings.push_back({.code = "GC-SIGN-0135",
                                   .where = where,
                                   .what = "the certificate has expired at " + time_text(*end) +
                                           "; that the signature is older is the signer's own statement",
                                   .rule = "only a time stamp of a third party proves the time of a signature",
                                   .action = "ask the laboratory if the age of the signature matters",
                                   .severity = gum::Severity::warning});
    }
    const std::vector<gum::Diagnostic> revoked = check_revocation(where, chain, trusted, now);
    report.findings.insert(report.findings.end(), revoked.begin(), revoked.end());
    if (!revoked.empty()) {
        return;
    }
    report.findings.push_back({.code = "GC-SIGN-0136",
                               .where = where,
                               .what = "it was not checked whether the certificate has been revoked",
                               .rule = "nothing is asked over the network",
                               .action = "ask the issuer's service if revocation matters",
                               .severity = gum::Severity::note});
}

void conclude(SignatureReport& report) {
    report.valid = std::none_of(report.findings.begin(), report.findings.end(), [](const gum::Diagnostic& finding) {
        return finding.severity == gum::Severity::error;
    });
}

}  // namespace gumcert::signing
