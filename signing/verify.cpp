#include "signing/verify.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "signing/certificates.h"
#include "signing/document_verification.h"
#include "signing/signing_files.h"
#include "text/small_letters.h"

namespace gumcert::signing {

namespace fs = std::filesystem;

namespace {

bool all_valid(const std::vector<SignatureReport>& reports) {
    return std::all_of(reports.begin(), reports.end(), [](const SignatureReport& report) { return report.valid; });
}

/// An XML document begins with "<", perhaps behind a byte-order mark and blanks.
bool looks_like_xml(const Bytes& file) {
    const std::size_t from = file.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    const std::size_t first = file.find_first_not_of(" \t\r\n", from);
    return first != Bytes::npos && file[first] == '<';
}

[[noreturn]] void refuse_file(const std::string& name, const char* what, const char* action) {
    throw gum::InputError(gum::Diagnostic{.code = "GC-SIGN-0050",
                                          .where = name,
                                          .what = what,
                                          .rule = "signatures are checked in digital certificates (XML) and PDF",
                                          .action = action});
}

bool looks_like_html(const Bytes& file) {
    const std::string start = text::in_small_letters(std::string_view(file).substr(0, 200));
    return start.find("<!doctype html") != std::string::npos || start.find("<html") != std::string::npos;
}

}  // namespace

Verification verify_signatures(const Bytes& file, const std::string& name, const TrustedMaterial& trusted,
                               std::int64_t now) {
    Verification verification;
    if (file.starts_with("%PDF-")) {
        verification = verify_pdf(file, name, trusted, now);
        verification.kind = "pdf";
    } else if (looks_like_html(file)) {
        refuse_file(name, "an HTML page, which carries no signature", "name the PDF or the XML beside it");
    } else if (looks_like_xml(file)) {
        verification.kind = "dcc";
        verification.signatures = verify_xml(file, name, trusted, now);
    } else {
        refuse_file(name, "neither an XML document nor a PDF", "name the certificate itself");
    }
    for (auto* reports : {&verification.signatures, &verification.attachment_signatures}) {
        for (SignatureReport& report : *reports) {
            show_safely(report);
        }
    }
    // Each signature must be valid, for nobody knows which of two a reader relies upon. A file of which the attachment
    // alone is signed is not valid: the pages that people read are then signed by nobody.
    verification.valid = !verification.signatures.empty() && all_valid(verification.signatures) &&
                         all_valid(verification.attachment_signatures);
    return verification;
}

std::vector<Bytes> read_revocation_lists(const fs::path& file) {
    std::vector<Bytes> lists = revocation_lists_from(read_signing_file(file));
    if (lists.empty()) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-SIGN-0053",
                                              .where = file.string(),
                                              .what = "no list of revoked certificates in it",
                                              .rule = "such a list is a file in PEM (-----BEGIN X509 CRL-----) or DER",
                                              .action = "get it from the issuer of the signer's certificate"});
    }
    return lists;
}

std::vector<Bytes> read_trust_store(const fs::path& store) {
    std::vector<fs::path> files;
    std::error_code failure;
    if (fs::is_directory(store, failure)) {
        for (const fs::directory_entry& entry : fs::directory_iterator(store, failure)) {
            if (entry.is_regular_file(failure)) {
                files.push_back(entry.path());
            }
        }
        std::sort(files.begin(), files.end());
    } else {
        files.push_back(store);
    }
    std::vector<Bytes> all;
    std::set<Bytes> seen;
    for (const fs::path& file : files) {
        for (Bytes& certificate : certificates_from_pem(read_signing_file(file))) {
            if (seen.insert(certificate).second) {
                all.push_back(std::move(certificate));
            }
        }
    }
    if (all.empty()) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-SIGN-0051",
                            .where = store.string(),
                            .what = "no certificate in it",
                            .rule = "a trust store is a PEM file with certificates, or a folder of such",
                            .action = "put the root certificates that you trust into it"});
    }
    return all;
}

}  // namespace gumcert::signing
