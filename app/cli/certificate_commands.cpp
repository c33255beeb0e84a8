#include "app/cli/certificate_commands.h"

#include <fmt/core.h>

#include <algorithm>

#include <cstdint>
#include <filesystem>

#include "app/cli/clock.h"
#include "app/import_certificate.h"
#include "app/output_files.h"
#include "app/read_file.h"
#include "signing/verify.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

void print_signature(const signing::SignatureReport& signature, const std::string& of) {
    fmt::print("  {}{}: {}\n", of, signature.format, signature.valid ? "valid" : "NOT VALID");
    fmt::print("    signer      {}\n", signature.signer.empty() ? "not stated" : signature.signer);
    fmt::print("    issued by   {}\n", signature.issuer.empty() ? "not stated" : signature.issuer);
    fmt::print("    time        {}\n",
               signature.signing_time.empty() ? "not stated" : signature.signing_time + " (as the signer states it)");
    fmt::print("    algorithm   {}\n", signature.algorithm);
    for (const std::string& part : signature.covers) {
        fmt::print("    covers      {}\n", part);
    }
    for (const std::string& part : signature.not_covered) {
        fmt::print("    not covered {}\n", part);
    }
}

void print_verification(const std::string& file, const signing::Verification& verification,
                        const CommonOptions& common) {
    for (const auto* signatures : {&verification.signatures, &verification.attachment_signatures}) {
        for (const signing::SignatureReport& signature : *signatures) {
            for (const gum::Diagnostic& finding : signature.findings) {
                if (!common.quiet || finding.severity != gum::Severity::note) {
                    print_message(finding, common);
                }
            }
        }
    }
    if (common.quiet) {
        return;
    }
    const bool attachment_alone = verification.signatures.empty() && !verification.attachment_signatures.empty();
    fmt::print("{}: {}\n", file,
               verification.valid                ? "valid"
               : attachment_alone                ? "NOT VALID: the pages are not signed, only what is attached to them"
               : verification.signatures.empty() ? "not signed"
                                                 : "NOT VALID");
    for (const signing::SignatureReport& signature : verification.signatures) {
        print_signature(signature, "");
    }
    for (const signing::SignatureReport& signature : verification.attachment_signatures) {
        print_signature(signature, "attached certificate, ");
    }
}

}  // namespace

ExitCode import_certificate(const std::string& file, const std::string& output, const CommonOptions& common) {
    if (!output.empty() && output != "-") {
        app::require_writable(output);
        app::require_not_an_input(output, {file});
    }
    const app::ImportedJob imported = app::import_certificate(app::read_file(file), file);
    for (const gum::Diagnostic& remark : imported.remarks) {
        if (!common.quiet || remark.severity != gum::Severity::note) {
            print_message(remark, common);
        }
    }
    if (output.empty() || output == "-") {
        write_to_stdout(imported.job);
        return done;
    }
    app::write_files({{output, imported.job}});
    if (!common.quiet) {
        fmt::print("Written: {}\nNext: keep the inputs that you need, write the model, gumcert run {}\n", output,
                   output);
    }
    return done;
}

ExitCode verify_files(const std::vector<std::string>& files, const std::string& trust_store,
                      const CommonOptions& common) {
    const std::vector<signing::Bytes> trusted = signing::read_trust_store(trust_store);
    ExitCode code = done;
    for (const std::string& file : files) {
        const ExitCode one = explained(common, [&] {
            const signing::Verification verification =
                signing::verify_signatures(app::read_file(file), file, trusted, seconds_now());
            print_verification(file, verification, common);
            return verification.valid ? done : negative_answer;
        });
        code = std::max(code, one);
    }
    return code;
}

}  // namespace gumcert::cli
