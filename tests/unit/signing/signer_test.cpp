#include "signing/signer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/err.h>

#include "signing/verify.h"
#include "tests/unit/signing/test_keys.h"

namespace gumcert::signing {
namespace {

using testing::HasSubstr;
using namespace test;

const Bytes k_digest(32, 'd');

bool fits(const Identity& identity, const Bytes& signature) {
    EVP_PKEY_CTX* context = EVP_PKEY_CTX_new(identity.key.get(), nullptr);
    EVP_PKEY_verify_init(context);
    EVP_PKEY_CTX_set_signature_md(context, EVP_sha256());
    const int good =
        EVP_PKEY_verify(context, reinterpret_cast<const unsigned char*>(signature.data()), signature.size(),
                        reinterpret_cast<const unsigned char*>(k_digest.data()), k_digest.size());
    EVP_PKEY_CTX_free(context);
    ERR_clear_error();
    return good == 1;
}

/// The code of a refusal, "" if there is none.
template <class Action>
std::string code_of(Action action) {
    try {
        static_cast<void>(action());
    } catch (const gum::DiagnosedError& e) {
        EXPECT_FALSE(e.diagnostics().front().rule.empty());
        EXPECT_FALSE(e.diagnostics().front().action.empty());
        return e.diagnostics().front().code;
    }
    return "";
}

TEST(SignerFromFiles, SignsWithRsaAndEcdsa) {
    const Laboratory rsa(rsa_key());
    EXPECT_EQ(rsa.signer->algorithm(), "RSA");
    EXPECT_TRUE(fits(rsa.own, rsa.signer->sign_sha256(k_digest)));
    EXPECT_EQ(rsa.signer->certificates().size(), 2U);
    EXPECT_EQ(rsa.signer->certificates().front(), der(rsa.own));
    const Laboratory ec(ec_key("P-384"));
    EXPECT_EQ(ec.signer->algorithm(), "ECDSA");
    EXPECT_TRUE(fits(ec.own, ec.signer->sign_sha256(k_digest)));
}

TEST(SignerFromFiles, LeadsToTheLastCertificateOfItsFile) {
    constexpr std::int64_t k_march_2026 = 1774958400;
    const Laboratory good(ec_key());
    EXPECT_EQ(code_of([&] {
                  require_a_chain(*good.signer, k_march_2026);
                  return 0;
              }),
              "");
    const CertificateOptions authority = {.name = "Root", .key_usage = "critical,keyCertSign", .authority = true};
    const Identity root = make_identity(ec_key(), authority);
    const Identity other =
        make_identity(ec_key(), {.name = "Other", .key_usage = "critical,keyCertSign", .authority = true});
    // Issued by a certificate that is no authority, or one that may not issue.
    const Identity person = make_identity(ec_key(), {.name = "Person"}, &root);
    const Identity keyless = make_identity(
        ec_key(), {.name = "No issuer", .key_usage = "critical,digitalSignature", .authority = true}, &root);
    for (const Identity* issuer : {&person, &keyless}) {
        Identity own = make_identity(ec_key(), {}, issuer);
        const std::string all = pem(own) + pem(*issuer) + pem(root);
        const Folder folder;
        const auto signer = signer_from_files(folder.put("key.pem", key_pem(own)), folder.put("chain.pem", all));
        EXPECT_EQ(code_of([&] {
                      require_a_chain(*signer, k_march_2026);
                      return 0;
                  }),
                  "GC-SIGN-0023");
    }
    // Beside one that has nothing to do with it.
    const Identity own = make_identity(ec_key(), {}, &root);
    const Folder folder;
    const auto signer = signer_from_files(folder.put("key.pem", key_pem(own)),
                                          folder.put("chain.pem", pem(own) + pem(root) + pem(other)));
    EXPECT_EQ(code_of([&] {
                  require_a_chain(*signer, k_march_2026);
                  return 0;
              }),
              "GC-SIGN-0023");
}

TEST(SignerFromFiles, RefusesWhatDoesNotFit) {
    const Laboratory one(ec_key());
    const Laboratory other(ec_key());
    const auto folder = one.folder.path();
    EXPECT_EQ(code_of([&] { return signer_from_files(folder / "none.pem", folder / "chain.pem"); }), "GC-SIGN-0010");
    EXPECT_EQ(code_of([&] { return signer_from_files(folder / "key.pem", folder / "key.pem"); }), "GC-SIGN-0011");
    EXPECT_EQ(code_of([&] { return signer_from_files(folder / "chain.pem", folder / "chain.pem"); }), "GC-SIGN-0014");
    EXPECT_EQ(code_of([&] { return signer_from_files(other.folder.path() / "key.pem", folder / "chain.pem"); }),
              "GC-SIGN-0015");
    const Identity weak = make_identity(rsa_key(1024));
    one.folder.put("weak.pem", pem(weak));
    EXPECT_EQ(code_of([&] { return signer_from_files(folder / "key.pem", folder / "weak.pem"); }), "GC-SIGN-0012");
    one.folder.put("curve.pem", pem(make_identity(ec_key("secp256k1"))));
    EXPECT_EQ(code_of([&] { return signer_from_files(folder / "key.pem", folder / "curve.pem"); }), "GC-SIGN-0012");
    // What verification would refuse is found before anything is signed: an authority's certificate, another usage.
    const auto code_with = [&](const CertificateOptions& options) {
        const Identity unfit = make_identity(ec_key(), options);
        one.folder.put("unfit.pem", pem(unfit));
        one.folder.put("unfit.key", key_pem(unfit));
        return code_of([&] { return signer_from_files(folder / "unfit.key", folder / "unfit.pem"); });
    };
    EXPECT_EQ(code_with({.key_usage = "", .authority = true}), "GC-SIGN-0018");  // as openssl req -x509 makes it
    EXPECT_EQ(code_with({.key_usage = "critical,keyEncipherment"}), "GC-SIGN-0018");
    EXPECT_EQ(code_with({.extended_key_usage = "serverAuth"}), "GC-SIGN-0018");
}

// What it signed, nobody could verify.
TEST(SignerFromFiles, RefusesACertificateThatWasIssuedWithAWeakDigest) {
    const Folder folder;
    // RSA: there is no ECDSA with MD5.
    const Identity root =
        make_identity(rsa_key(), {.name = "Example Root", .key_usage = "critical,keyCertSign", .authority = true});
    for (const EVP_MD* digest : {EVP_md5(), EVP_sha1()}) {
        const Identity weak = make_identity(rsa_key(), {.digest = digest}, &root);
        const auto key = folder.put("key.pem", key_pem(weak));
        for (const std::string& chain : {pem(weak), pem(weak) + pem(root)}) {
            EXPECT_EQ(code_of([&] { return signer_from_files(key, folder.put("chain.pem", chain)); }), "GC-SIGN-0019");
        }
        const Identity below = make_identity(
            ec_key(), {.name = "Issuer", .key_usage = "critical,keyCertSign", .authority = true, .digest = digest},
            &root);
        const Identity own = make_identity(ec_key(), {}, &below);
        EXPECT_EQ(code_of([&] {
                      return signer_from_files(folder.put("own.pem", key_pem(own)),
                                               folder.put("chain.pem", pem(own) + pem(below) + pem(root)));
                  }),
                  "GC-SIGN-0019");
    }
    // A root is trusted or not, whatever it was signed with.
    const Identity old_root = make_identity(
        ec_key(), {.name = "Old Root", .key_usage = "critical,keyCertSign", .authority = true, .digest = EVP_sha1()});
    const Identity own = make_identity(ec_key(), {}, &old_root);
    EXPECT_EQ(code_of([&] {
                  return signer_from_files(folder.put("own.pem", key_pem(own)),
                                           folder.put("chain.pem", pem(own) + pem(old_root)));
              }),
              "");
}

TEST(SignerFromFiles, AnEncryptedKeyNeedsItsPassphraseAndNobodyIsAsked) {
    const Laboratory laboratory(ec_key());
    const auto key = laboratory.folder.put("locked.pem", key_pem(laboratory.own, "open sesame"));
    const auto chain = laboratory.folder.path() / "chain.pem";
    EXPECT_TRUE(fits(laboratory.own, signer_from_files(key, chain, "open sesame")->sign_sha256(k_digest)));
    EXPECT_EQ(code_of([&] { return signer_from_files(key, chain); }), "GC-SIGN-0014");
    EXPECT_EQ(code_of([&] { return signer_from_files(key, chain, "wrong"); }), "GC-SIGN-0014");
}

// A private key that others may read or write is told, and one that has the cure is not.
TEST(SignerFromFiles, TellsAKeyThatOthersMayReadOrWrite) {
    const Laboratory laboratory(ec_key());
    const auto key = laboratory.folder.path() / "key.pem";
    laboratory.folder.put("signer.json", R"({"certificates": "chain.pem", "key": "key.pem"})");
    const auto told = [&](unsigned mode) {
        std::filesystem::permissions(key, static_cast<std::filesystem::perms>(mode));
        const auto warnings = described_signer(laboratory.folder.path() / "signer.json").warnings;
        return warnings.empty() ? std::string() : warnings.front().code + " " + warnings.front().what;
    };
    for (const unsigned mode : {0600U, 0400U, 0700U, 0611U}) {
        EXPECT_EQ(told(mode), "") << std::oct << mode;
    }
    for (const unsigned mode : {0602U, 0620U, 0622U, 0420U}) {
        EXPECT_EQ(told(mode), "GC-SIGN-0029 others than its owner may write it") << std::oct << mode;
    }
    for (const unsigned mode : {0604U, 0640U, 0644U}) {
        EXPECT_EQ(told(mode), "GC-SIGN-0029 others than its owner may read it") << std::oct << mode;
    }
    for (const unsigned mode : {0666U, 0660U, 0642U, 0606U}) {
        EXPECT_EQ(told(mode), "GC-SIGN-0029 others than its owner may read and write it") << std::oct << mode;
    }
}

/// A signing program made of openssl pkeyutl, as a laboratory may write one for its card.
std::filesystem::path program(const Folder& folder, const std::string& name, const std::string& body) {
    const auto file = folder.put(name, "#!/bin/sh\n" + body);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
}

// In bash, for its printf writes bytes from hexadecimal.
constexpr const char* k_pkeyutl =
    "#!/bin/bash\n"
    "read -r digest\n"
    "printf \"$(sed 's/../\\\\x&/g' <<< \"$digest\")\" > \"$1/digest\"\n"
    "openssl pkeyutl -sign -inkey \"$1/key.pem\" -in \"$1/digest\" -pkeyopt digest:sha256 -out \"$1/signature\" &&\n"
    "base64 \"$1/signature\"\n";

TEST(SignerFromCommand, SignsWithAnExternalProgram) {
    if (!program_exists("openssl") || !program_exists("bash")) {
        GTEST_SKIP() << "openssl or bash is missing";
    }
    for (const bool rsa : {true, false}) {
        const Laboratory laboratory(rsa ? rsa_key() : ec_key());
        const auto file = laboratory.folder.put("sign", k_pkeyutl);
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        const std::unique_ptr<Signer> signer = signer_from_command({file.string(), laboratory.folder.path().string()},
                                                                   laboratory.folder.path() / "chain.pem");
        EXPECT_TRUE(fits(laboratory.own, signer->sign_sha256(k_digest)));

        laboratory.folder.put("signer.json", R"({"certificates": "chain.pem", "command": ["./sign", ")" +
                                                 laboratory.folder.path().string() + R"("], "time_limit_s": 30})");
        const std::unique_ptr<Signer> described = signer_from_description(laboratory.folder.path() / "signer.json");
        EXPECT_TRUE(fits(laboratory.own, described->sign_sha256(k_digest)));
    }
}

TEST(SignerFromCommand, FailuresAreToldAndNothingRunsOn) {
    const Laboratory laboratory(ec_key());
    const Folder& folder = laboratory.folder;
    const auto chain = folder.path() / "chain.pem";
    const auto refusal = [&](const std::filesystem::path& file, int limit = 20) {
        try {
            static_cast<void>(
                signer_from_command({file.string()}, chain, std::chrono::seconds(limit))->sign_sha256(k_digest));
        } catch (const gum::StorageError& e) {
            return std::string(e.what());
        }
        return std::string("signed");
    };
    EXPECT_THAT(refusal(program(folder, "three", "exit 3\n")), HasSubstr("ended with status 3"));
    EXPECT_THAT(refusal(program(folder, "killed", "kill -9 $$\n")), HasSubstr("signal 9"));
    EXPECT_THAT(refusal(program(folder, "words", "echo '*** no card ***'\n")), HasSubstr("not Base64"));
    EXPECT_THAT(refusal(program(folder, "silent", "")), HasSubstr("not Base64"));
    EXPECT_THAT(refusal(program(folder, "slow", "exec sleep 30\n"), 1), HasSubstr("no answer within 1 s"));
    EXPECT_THAT(refusal(program(folder, "closed", "exec >&-; exec sleep 30\n"), 1), HasSubstr("no answer within 1 s"));
    EXPECT_THAT(refusal(program(folder, "endless", "exec yes\n")), HasSubstr("more than a signature"));
    EXPECT_THAT(refusal(folder.path() / "absent"), HasSubstr("cannot be started"));
    // The environment of the program is not handed on.
    ::setenv("GUMCERT_SECRET", "secret", 1);
    EXPECT_THAT(refusal(program(folder, "environment", "test -z \"$GUMCERT_SECRET\" || exit 7\nexit 8\n")),
                HasSubstr("status 8"));
    ::unsetenv("GUMCERT_SECRET");
    EXPECT_EQ(code_of([&] { return signer_from_command({"openssl"}, chain); }), "GC-SIGN-0016");
    EXPECT_EQ(code_of([&] { return signer_from_command({}, chain); }), "GC-SIGN-0016");
}

TEST(SignerFromCommand, ASignatureOfAnotherKeyIsRefused) {
    const Laboratory laboratory(ec_key());
    const auto file = program(laboratory.folder, "wrong", "cat > /dev/null; echo c2lnbmF0dXJl\n");
    const auto signer = signer_from_command({file.string()}, laboratory.folder.path() / "chain.pem");
    const Bytes dcc =
        "<dcc:digitalCalibrationCertificate xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"3.3.0\">1"
        "</dcc:digitalCalibrationCertificate>";
    EXPECT_EQ(code_of([&] { return sign_dcc(dcc, *signer, k_signing_time); }), "GC-SIGN-0022");
}

TEST(SignerFromDescription, RefusesWhatItDoesNotKnow) {
    const Laboratory laboratory(ec_key());
    const auto refusal = [&](const std::string& text) {
        const auto file = laboratory.folder.put("signer.json", text);
        return code_of([&] { return signer_from_description(file); });
    };
    EXPECT_EQ(refusal(R"({"certificates": "chain.pem", "key": "key.pem"})"), "");
    for (const char* text :
         {"", "[]", "{", R"({"certificates": "chain.pem"})", R"({"key": "key.pem"})",
          R"({"certificates": "chain.pem", "key": "key.pem", "command": ["/bin/true"]})",
          R"({"certificates": "chain.pem", "keys": "key.pem"})", R"({"certificates": "chain.pem", "command": "sign"})",
          R"({"certificates": "chain.pem", "command": [1]})",
          R"({"certificates": "chain.pem", "command": ["/bin/true"], "time_limit_s": 0})",
          R"({"certificates": "", "key": "key.pem"})", R"({"certificates": "chain\u0000.pem", "key": "key.pem"})",
          R"({"certificates": "chain.pem", "key": "k\u001bey.pem"})",
          R"({"certificates": "no.pem", "key": "key.pem", "certificates": "chain.pem"})",
          R"({"certificates": "chain.pem", "key": "key.pem", "time_limit_s": 18446744073709551616})"}) {
        EXPECT_EQ(refusal(text), "GC-SIGN-0013") << text;
    }
    laboratory.folder.put("locked.pem", key_pem(laboratory.own, "open sesame"));
    laboratory.folder.put("passphrase", "open sesame\n");
    EXPECT_EQ(refusal(R"({"certificates": "chain.pem", "key": "locked.pem", "passphrase_file": "passphrase"})"), "");
}

TEST(TrustStore, IsAFileOrAFolder) {
    const Laboratory laboratory(ec_key());
    const Folder folder;
    folder.put("a.pem", pem(laboratory.root));
    folder.put("b.pem", pem(laboratory.own) + "\nsome words\n" + pem(laboratory.root));
    folder.put("notes.txt", "not a certificate");
    EXPECT_EQ(read_trust_store(folder.path()).size(), 2U);
    EXPECT_EQ(read_trust_store(folder.path() / "a.pem"), std::vector<Bytes>{der(laboratory.root)});
    EXPECT_EQ(code_of([&] { return read_trust_store(folder.path() / "notes.txt"); }), "GC-SIGN-0051");
    EXPECT_EQ(code_of([&] { return read_trust_store(folder.path() / "absent"); }), "GC-SIGN-0010");
}

}  // namespace
}  // namespace gumcert::signing
