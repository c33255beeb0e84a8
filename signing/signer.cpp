#include "signing/signer.h"
#include "encoding/base64.h"
#include "encoding/file_bytes.h"
#include "encoding/sha2.h"

#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/rsa.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "json/strict_parser.h"
#include "signing/certificates.h"
#include "signing/checked_signature.h"
#include "signing/external_program.h"
#include "signing/signing_files.h"
#include "signing/time_texts.h"
#include "text/place.h"
#include "text/visible_text.h"

namespace gumcert::signing {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const char* code, const std::string& where, std::string what, const char* rule,
                         const char* action) {
    throw gum::InputError(
        gum::Diagnostic{.code = code, .where = where, .what = std::move(what), .rule = rule, .action = action});
}

std::vector<Bytes> chain_from(const fs::path& file) {
    std::vector<Bytes> chain = certificates_from_pem(read_signing_file(file));
    if (chain.empty()) {
        refuse("GC-SIGN-0011", file.string(), "no certificate in it",
               "the signer's certificate and those of its issuers stand in a PEM file, the signer's first",
               "name the file with -----BEGIN CERTIFICATE-----");
    }
    const CertificateHandle own = certificate_from_der(chain.front());
    if (const std::string weakness = weakness_of_key(own.get()); !weakness.empty()) {
        refuse("GC-SIGN-0012", file.string(), weakness,
               "signatures are made with RSA of 2048 bits or more, or ECDSA with P-256, P-384 or P-521",
               "use a certificate with such a key");
    }
    if (const std::string unfitness = unfitness_for_documents(own.get()); !unfitness.empty()) {
        refuse("GC-SIGN-0018", file.string(),
               "the first certificate, " + subject_of(own.get()) + ", is not for signing documents: " + unfitness,
               "the signer's own certificate stands first, and has CA:FALSE and key usage digitalSignature",
               "put it first, or have one made for signing documents (docs/signing.md)");
    }
    for (const Bytes& der : chain) {
        const CertificateHandle certificate = certificate_from_der(der);
        if (const std::string weakness = weakness_of_issue(certificate.get()); !weakness.empty()) {
            refuse("GC-SIGN-0019", file.string(),
                   "the certificate of " + subject_of(certificate.get()) + " was issued with " + weakness,
                   "certificates issued with less than 112 bits of security, SHA-1 or MD5 for instance, verify nowhere",
                   "have the certificate issued anew with SHA-256");
        }
    }
    return chain;
}

class SignerBase : public Signer {
public:
    explicit SignerBase(std::vector<Bytes> chain)
        : chain_(std::move(chain)), algorithm_(kind_of_key(certificate_from_der(chain_.front()).get())) {}
    [[nodiscard]] const std::vector<Bytes>& certificates() const override { return chain_; }
    [[nodiscard]] std::string algorithm() const override { return algorithm_; }

private:
    std::vector<Bytes> chain_;
    std::string algorithm_;
};

class FileSigner : public SignerBase {
public:
    FileSigner(std::vector<Bytes> chain, KeyHandle key) : SignerBase(std::move(chain)), key_(std::move(key)) {}

    [[nodiscard]] Bytes sign_sha256(const Bytes& digest) const override {
        const Handle<EVP_PKEY_CTX> context(EVP_PKEY_CTX_new_from_pkey(nullptr, key_.get(), nullptr));
        bool good = context != nullptr && EVP_PKEY_sign_init(context.get()) == 1;
        if (good && algorithm() == "RSA") {
            good = EVP_PKEY_CTX_set_rsa_padding(context.get(), RSA_PKCS1_PADDING) == 1;
        }
        const auto* data = reinterpret_cast<const unsigned char*>(digest.data());
        std::size_t size = 0;
        good = good && EVP_PKEY_CTX_set_signature_md(context.get(), EVP_sha256()) == 1 &&
               EVP_PKEY_sign(context.get(), nullptr, &size, data, digest.size()) == 1;
        // The first call asks for the most bytes; an ECDSA signature in DER is often shorter, so the length is set
        // again below.
        Bytes signature(size, '\0');
        good = good && EVP_PKEY_sign(context.get(), reinterpret_cast<unsigned char*>(signature.data()), &size, data,
                                     digest.size()) == 1;
        ERR_clear_error();
        if (!good) {
            throw gum::StorageError(gum::Diagnostic{.code = "GC-SIGN-0021",
                                                    .where = "key",
                                                    .what = "OpenSSL could not sign with it",
                                                    .rule = "the key signs a SHA-256 digest",
                                                    .action = "try the key with openssl pkeyutl -sign"});
        }
        signature.resize(size);
        return signature;
    }

private:
    KeyHandle key_;
};

class CommandSigner : public SignerBase {
public:
    CommandSigner(std::vector<Bytes> chain, std::vector<std::string> command, std::chrono::seconds limit)
        : SignerBase(std::move(chain)), command_(std::move(command)), limit_(limit) {}

    [[nodiscard]] Bytes sign_sha256(const Bytes& digest) const override {
        const std::string said = run_program(command_, encoding::hexadecimal(digest) + '\n', limit_);
        const std::optional<Bytes> signature = encoding::bytes_from_base64(said);
        if (!signature || signature->empty()) {
            throw gum::StorageError(gum::Diagnostic{.code = "GC-SIGN-0020",
                                                    .where = command_[0],
                                                    .what = "its answer is not Base64",
                                                    .rule = "the signing program answers with the signature in Base64",
                                                    .action = "run it by hand to see what it says (docs/signing.md)"});
        }
        return *signature;
    }

private:
    std::vector<std::string> command_;
    std::chrono::seconds limit_;
};

/// A text that is wiped from the memory when the object goes.
class Secret {
public:
    explicit Secret(std::string&& text) : text_(std::move(text)) { wipe(text); }
    ~Secret() { wipe(text_); }
    Secret(const Secret&) = delete;
    Secret& operator=(const Secret&) = delete;

    [[nodiscard]] std::string& text() { return text_; }

private:
    /// A short text lies in the string itself, and stays there when it is moved away.
    static void wipe(std::string& text) {
        // The length alone is not enough: what was longer before lies behind the end of the text.
        text.resize(text.capacity());
        OPENSSL_cleanse(text.data(), text.size());
        text.clear();
    }
    std::string text_;
};

/// Without a passphrase OpenSSL would ask at the terminal.
int give_passphrase(char* buffer, int size, int /*for_writing*/, void* passphrase) {
    const auto& text = *static_cast<const std::string*>(passphrase);
    if (text.empty() || text.size() > static_cast<std::size_t>(size)) {
        return -1;
    }
    std::memcpy(buffer, text.data(), text.size());
    return static_cast<int>(text.size());
}

/// A signer description as it stands in the file.
struct Description {
    std::string certificates, key, passphrase_file;
    std::vector<std::string> command;
    std::int64_t time_limit = 60;
};

constexpr const char* k_description_rule =
    R"(a signer is {"certificates": "chain.pem", "key": "key.pem"}, or with "command": ["/path/program", "word"])";

/// A secret that more people than its owner may read is none; where they may write, they can put another in its place.
void warn_of_access(const fs::path& file, std::vector<gum::Diagnostic>& warnings) {
    constexpr unsigned k_read_by_others = 0044;
    constexpr unsigned k_written_by_others = 0022;
    const encoding::FileBytes secret = encoding::read_regular_file(file, 0);
    const bool read = secret.failure.empty() && (secret.mode & k_read_by_others) != 0;
    const bool written = secret.failure.empty() && (secret.mode & k_written_by_others) != 0;
    if (read || written) {
        const std::string revoked = "; have the certificate revoked where others may have read it";
        warnings.push_back({.code = "GC-SIGN-0029",
                            .where = file.string(),
                            .what = std::string("others than its owner may ") +
                                    (read && written ? "read and write"
                                     : read          ? "read"
                                                     : "write") +
                                    " it",
                            .rule = read ? "whoever has the private key can sign in its owner's name"
                                         : "whoever can put another key in its place can sign with that",
                            .action = "chmod 600 " + file.string() + (read ? revoked : ""),
                            .severity = gum::Severity::warning});
    }
}

void read_description_key(Description& description, const std::string& file, const std::string& name,
                          const nlohmann::json& value) {
    const auto refuse_value = [&](const char* what) {
        refuse("GC-SIGN-0013", file + "#/" + text::visible(name), what, k_description_rule,
               "correct the value (docs/signing.md)");
    };
    std::string* text = name == "certificates"      ? &description.certificates
                        : name == "key"             ? &description.key
                        : name == "passphrase_file" ? &description.passphrase_file
                                                    : nullptr;
    if (text != nullptr) {
        // Names stand in messages: what a terminal would act on is no name.
        const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; };
        if (!value.is_string() || value.get_ref<const std::string&>().empty() ||
            std::ranges::any_of(value.get_ref<const std::string&>(), is_control)) {
            refuse_value("not the name of a file");
        }
        *text = value.get<std::string>();
    } else if (name == "command") {
        const auto is_word = [](const nlohmann::json& word) { return word.is_string(); };
        if (!value.is_array() || value.empty() || !std::all_of(value.begin(), value.end(), is_word)) {
            refuse_value("not a list of words");
        }
        description.command = value.get<std::vector<std::string>>();
    } else if (name == "time_limit_s") {
        if (!value.is_number_integer() || value < 1 || value > 9999) {
            refuse_value("not a whole number of seconds from 1 to 9999");
        }
        description.time_limit = value.get<std::int64_t>();
    } else {
        refuse_value("not a known key");
    }
}

Description read_description(const fs::path& file) {
    const auto refuse_text = [&](const gumcert::json::ParsingProblem& problem) {
        if (problem.fault == gumcert::json::Fault::duplicate_key) {
            refuse("GC-SIGN-0013", file.string() + "#" + text::visible(problem.pointer), "the key stands there twice",
                   k_description_rule, "keep one of them: nobody can know which one is meant");
        }
        refuse("GC-SIGN-0013", file.string() + " (" + text::line_and_column(problem.place) + ")", problem.what,
               k_description_rule, "correct the file");
    };
    const std::optional<nlohmann::json> read =
        json::parse(read_signing_file(file), {.byte_order_mark = true, .long_integers = true}, refuse_text);
    if (!read || !read->is_object()) {
        refuse("GC-SIGN-0013", file.string(), "not a JSON object", k_description_rule, "correct the file");
    }
    Description description;
    for (const auto& [name, value] : read->items()) {
        read_description_key(description, file.string(), name, value);
    }
    if (description.certificates.empty() || description.key.empty() == description.command.empty()) {
        refuse("GC-SIGN-0013", file.string(), "certificates and exactly one of key and command are needed",
               k_description_rule, "correct the file (docs/signing.md)");
    }
    return description;
}

}  // namespace

namespace {

encoding::FileBytes read_whole(const fs::path& file) {
    constexpr std::size_t k_largest = std::size_t{16} << 20U;
    encoding::FileBytes read = encoding::read_regular_file(file, k_largest);
    if (read.too_long) {
        read.failure = "it is larger than 16 MiB";
    }
    if (!read.failure.empty()) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-SIGN-0010",
                                                .where = file.empty() ? "the name \"\"" : file.string(),
                                                .what = "cannot be read: " + read.failure,
                                                .rule = "keys, certificates and signer descriptions are regular files",
                                                .action = "name a file that you may read"});
    }
    return read;
}

}  // namespace

std::string read_signing_file(const fs::path& file) {
    return read_whole(file).bytes;
}

std::unique_ptr<Signer> signer_from_files(const fs::path& key, const fs::path& certificates,
                                          const std::string& passphrase) {
    std::vector<Bytes> chain = chain_from(certificates);
    encoding::FileBytes key_file = read_whole(key);
    Secret secret(std::move(key_file.bytes));
    const std::string& pem = secret.text();
    const Handle<BIO> in(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
    Secret phrase{std::string(passphrase)};
    KeyHandle own(PEM_read_bio_PrivateKey(in.get(), nullptr, give_passphrase, &phrase.text()));
    ERR_clear_error();
    if (own == nullptr) {
        const bool encrypted = pem.find("ENCRYPTED") != std::string::npos;
        refuse("GC-SIGN-0014", key.string(),
               !encrypted           ? "no private key in it"
               : passphrase.empty() ? "the private key is encrypted, and no passphrase is stated"
                                    : "the private key is encrypted, and this passphrase does not open it",
               "the key stands in a PEM file, encrypted or not",
               encrypted ? "name with passphrase_file the file with its passphrase"
                         : "name the file with the private key");
    }
    const CertificateHandle certificate = certificate_from_der(chain.front());
    const bool belongs = X509_check_private_key(certificate.get(), own.get()) == 1;
    ERR_clear_error();
    if (!belongs) {
        refuse("GC-SIGN-0015", key.string(),
               "the key does not belong to the first certificate of " + certificates.string(),
               "the signer's own certificate stands first", "name key and certificates of the same signer");
    }
    return std::make_unique<FileSigner>(std::move(chain), std::move(own));
}

std::unique_ptr<Signer> signer_from_command(const std::vector<std::string>& command, const fs::path& certificates,
                                            std::chrono::seconds time_limit) {
    if (command.empty() || command[0].find('/') == std::string::npos) {
        refuse("GC-SIGN-0016", command.empty() ? "command" : text::visible(command[0]), "not the path of a program",
               "the signing program is started without a shell and without looking it up", "state its path");
    }
    return std::make_unique<CommandSigner>(chain_from(certificates), command, time_limit);
}

std::unique_ptr<Signer> signer_from_description(const fs::path& file) {
    return described_signer(file).signer;
}

DescribedSigner described_signer(const fs::path& file) {
    Description description = read_description(file);
    const fs::path folder = file.parent_path();
    const fs::path certificates = folder / description.certificates;
    DescribedSigner result;
    result.files = {file, certificates};
    if (!description.command.empty()) {
        std::string& program = description.command[0];
        if (program.find('/') != std::string::npos) {
            std::error_code error;
            const fs::path absolute = fs::absolute(folder / program, error);
            program = error ? (folder / program).string() : absolute.string();
            result.files.emplace_back(program);
        }
        result.signer =
            signer_from_command(description.command, certificates, std::chrono::seconds(description.time_limit));
        return result;
    }
    encoding::FileBytes passphrase_file;
    const fs::path secret = folder / description.passphrase_file;
    if (!description.passphrase_file.empty()) {
        passphrase_file = read_whole(secret);
    }
    Secret passphrase(std::move(passphrase_file.bytes));
    if (!description.passphrase_file.empty()) {
        // Editors end a file with a new line, which is no part of the passphrase. Blanks may be one, and stay.
        passphrase.text().erase(passphrase.text().find_last_not_of("\r\n") + 1);
        result.files.push_back(secret);
        warn_of_access(secret, result.warnings);
    }
    const fs::path key = folder / description.key;
    result.files.push_back(key);
    result.signer = signer_from_files(key, certificates, passphrase.text());
    warn_of_access(key, result.warnings);
    return result;
}

Bytes checked_signature(const Signer& signer, const Bytes& digest) {
    // A card may hold several keys, and a program may use another padding. It is better to learn this now than from the
    // customer who checks the certificate.
    Bytes signature = signer.sign_sha256(digest);
    const CertificateHandle certificate = certificate_from_der(signer.certificates().front());
    if (certificate == nullptr || !verifies(certificate.get(), "SHA2-256", digest, signature)) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-SIGN-0022",
                            .where = "signer",
                            .what = "the signature that it made does not fit its certificate",
                            .rule = "the signer signs the SHA-256 digest with the key of the first certificate "
                                    "(RSA: PKCS #1 v1.5; ECDSA: DER)",
                            .action = "check which key the card, program or file uses"});
    }
    return signature;
}

namespace {

/// The certificates of a chain from the signer's upwards: each has issued the one before. Where two have, an
/// intermediate and its renewal, the first of the file.
std::vector<std::size_t> path_of(const std::vector<CertificateHandle>& chain) {
    std::vector<std::size_t> path = {0};
    for (bool longer = true; longer;) {
        longer = false;
        for (std::size_t i = 1; i < chain.size() && !longer; ++i) {
            const bool passed = std::find(path.begin(), path.end(), i) != path.end();
            if (!passed && X509_check_issued(chain[i].get(), chain[path.back()].get()) == X509_V_OK) {
                path.push_back(i);
                longer = true;
            }
        }
    }
    return path;
}

}  // namespace

void require_a_chain(const Signer& signer, std::int64_t signing_time) {
    std::vector<CertificateHandle> chain;
    for (const Bytes& der : signer.certificates()) {
        chain.push_back(certificate_from_der(der));
    }
    const std::vector<std::size_t> path = path_of(chain);
    for (std::size_t i = 0; i < chain.size(); ++i) {
        if (std::find(path.begin(), path.end(), i) == path.end()) {
            refuse("GC-SIGN-0023", "signer",
                   "the certificate of " + subject_of(chain[i].get()) + " has not issued that of " +
                       subject_of(chain[path.back()].get()) + ", nor any below it",
                   "the file holds the signer's certificate and those of its issuers, and no others",
                   "take it out, or put in the one that has issued it");
        }
    }
    // The last certificate of the path stands for the trust store of the reader, which is not known here: what fails
    // even then cannot be accepted anywhere.
    const std::vector<gum::Diagnostic> problems =
        check_chain("signer", chain, {signer.certificates().at(path.back())}, signing_time);
    if (!problems.empty()) {
        refuse("GC-SIGN-0023", "signer", "no verification will accept it: " + problems.front().what,
               "a signature is made with a certificate that leads to the last one of its file",
               "have a certificate made for signing documents, by an authority that may issue it (docs/signing.md)");
    }
}

void require_in_force(const Signer& signer, std::int64_t signing_time) {
    const CertificateHandle certificate = certificate_from_der(signer.certificates().at(0));
    const std::optional<std::int64_t> from = certificate ? start_of_validity(certificate.get()) : std::nullopt;
    const std::optional<std::int64_t> to = certificate ? end_of_validity(certificate.get()) : std::nullopt;
    if (!from || !to) {
        refuse("GC-SIGN-0011", "signer", "its certificate cannot be read", "the signer has a certificate",
               "check the certificate file");
    }
    if (signing_time < *from || signing_time > *to) {
        refuse("GC-SIGN-0017", "signer",
               "the certificate of " + subject_of(certificate.get()) + " is in force from " + time_text(*from) +
                   " to " + time_text(*to) + ", not at " + time_text(signing_time),
               "a signature is made while the certificate is in force", "renew the certificate, or correct the clock");
    }
}

}  // namespace gumcert::signing
