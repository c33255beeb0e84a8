#include "app/cli/certificate_commands.h"

#include <fmt/core.h>

#include <algorithm>

#include <cstdint>
#include <filesystem>
#include <utility>

#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "evaluation/check_file.h"
#include "evaluation/name_job.h"
#include "evaluation/read_file.h"
#include "imports/foreign_certificate.h"
#include "imports/import_certificate.h"
#include "imports/import_standard.h"
#include "issuing/document_identity.h"
#include "jobs/laboratory/laboratory_folder.h"
#include "outputs/output_files.h"
#include "outputs/output_set.h"
#include "signing/verify.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

void print_signature(const signing::SignatureReport& signature, const std::string& of) {
    print_to_stdout("  {}{}: {}\n", of, signature.format, signature.valid ? "valid" : "NOT VALID");
    print_to_stdout("    signer      {}\n", signature.signer.empty() ? "not stated" : signature.signer);
    print_to_stdout("    issued by   {}\n", signature.issuer.empty() ? "not stated" : signature.issuer);
    print_to_stdout("    time        {}\n", signature.signing_time.empty()
                                                ? "not stated"
                                                : signature.signing_time + " (as the signer states it)");
    print_to_stdout("    algorithm   {}\n", signature.algorithm);
    for (const std::string& part : signature.covers) {
        print_to_stdout("    covers      {}\n", part);
    }
    for (const std::string& part : signature.not_covered) {
        print_to_stdout("    not covered {}\n", part);
    }
}

void print_identity(const issuing::DocumentIdentity& identity) {
    const auto row = [](const char* name, const std::string& text) {
        if (!text.empty()) {
            print_to_stdout("  {:<12}{}\n", name, text);
        }
    };
    const bool days = !identity.performed_to.empty() && identity.performed_to != identity.performed_from;
    row("number", identity.number + (identity.attached ? " (of the digital certificate in it)" : ""));
    row("laboratory", identity.laboratory);
    row("item", identity.item);
    row("performed", identity.performed_from + (days ? " to " + identity.performed_to : ""));
    row("issued", identity.issued);
    row("state", identity.state);
}

void print_verification(const std::string& file, const signing::Verification& verification,
                        const std::vector<issuing::DocumentIdentity>& identities, const CommonOptions& common) {
    for (const auto* signatures : {&verification.signatures, &verification.attachment_signatures}) {
        for (const signing::SignatureReport& signature : *signatures) {
            print_messages(signature.findings, common);
        }
    }
    if (common.quiet) {
        return;
    }
    const bool attachment_alone = verification.signatures.empty() && !verification.attachment_signatures.empty();
    print_to_stdout("{}: {}\n", text::one_line(file),
                    verification.valid ? "valid"
                    : attachment_alone ? "NOT VALID: the pages are not signed, only what is attached to them"
                    : verification.signatures.empty() ? "not signed"
                                                      : "NOT VALID");
    for (const issuing::DocumentIdentity& identity : identities) {
        print_identity(identity);
    }
    for (const signing::SignatureReport& signature : verification.signatures) {
        print_signature(signature, "");
    }
    for (const signing::SignatureReport& signature : verification.attachment_signatures) {
        print_signature(signature, "attached certificate, ");
    }
}

imports::CertificateTrust trust_of(const std::string& trust_store) {
    imports::CertificateTrust trust{.trusted = {}, .now = seconds_now()};
    if (!trust_store.empty()) {
        trust.trusted = signing::read_trust_store(trust_store);
    }
    return trust;
}

ExitCode print_check(const std::string& file, const evaluation::FileCheck& check, const CommonOptions& common) {
    std::size_t errors = 0;
    std::size_t warnings = 0;
    for (const gum::Diagnostic& finding : check.findings) {
        errors += finding.severity == gum::Severity::error ? 1 : 0;
        warnings += finding.severity == gum::Severity::warning ? 1 : 0;
    }
    print_messages(check.findings, common);
    if (!common.quiet) {
        print_to_stdout(
            "{}: {}, {}\n", text::one_line(file), check.kind,
            errors + warnings == 0 ? "nothing found" : fmt::format("errors: {}, warnings: {}", errors, warnings));
    }
    return errors > 0 ? negative_answer : done;
}

}  // namespace

ExitCode import_certificate(const std::string& file, const std::string& asked, const std::string& standard,
                            const std::string& trust_store, const CommonOptions& common) {
    std::string output = asked;
    if (!standard.empty()) {
        if (!jobs::LaboratoryFolder::is_identification(standard)) {
            refuse_usage("--standard", "\"" + standard + "\"", "an identification is the name of a file",
                         "use letters, digits, '-', '_' and '.'");
        }
        std::error_code error;
        if (std::filesystem::is_directory(asked, error)) {
            output = (std::filesystem::path(asked) / (standard + ".json")).string();
        }
        if (!output.empty() && output != "-" && std::filesystem::exists(output, error)) {
            refuse_usage(output, "is there already", "a file of the register has the history of its standard",
                         "write to another place, and add the calibration to the file");
        }
    }
    const std::vector<std::filesystem::path> inputs{file, trust_store};
    outputs::OutputsAtStart at_start;
    if (!output.empty() && output != "-") {
        outputs::require_writable(output);
        outputs::require_not_an_input(output, inputs);
        at_start = begin_outputs({output}, common);
    }
    const imports::ImportedJob imported =
        standard.empty() ? imports::import_certificate(evaluation::read_file(file), file, trust_of(trust_store))
                         : imports::import_standard(evaluation::read_file(file), file, standard, trust_of(trust_store));
    print_messages(imported.remarks, common);
    if (output.empty() || output == "-") {
        write_to_stdout(imported.job);
        return imported.negative ? negative_answer : done;
    }
    write_outputs({{output, imported.job}}, inputs, at_start);
    if (!common.quiet) {
        print_to_stdout("Written: {}\nNext: {} {}\n", text::one_line(output),
                        standard.empty() ? "keep the inputs that you need, write the model, gumcert run"
                                         : "state drift, valid_to and route, gumcert check",
                        text::one_line(output));
    }
    return imported.negative ? negative_answer : done;
}

ExitCode check_files(const std::vector<std::string>& files, bool certificates, const std::string& trust_store,
                     const std::string& share, const std::string& laboratory, const CommonOptions& common) {
    if (!certificates && !trust_store.empty()) {
        refuse_usage("--trust", "without the word dcc", "signatures are looked at in digital certificates",
                     "gumcert check dcc FILE --trust STORE; leave it out for jobs, records and folders");
    }
    if (certificates && !laboratory.empty()) {
        refuse_usage("--laboratory", "with the word dcc", "a digital certificate is checked by itself", "leave it out");
    }
    const imports::CertificateTrust trust = certificates ? trust_of(trust_store) : imports::CertificateTrust();
    ExitCode code = done;
    const bool several = files.size() > 1;
    for (const std::string& file : files) {
        const ExitCode one = explained(common, [&] {
            evaluation::FileCheck check{.kind = "digital certificate", .findings = {}};
            if (certificates) {
                check.findings = imports::check_certificate(evaluation::read_file(file), file, trust);
            } else {
                ProgressLine progress(!common.quiet);
                check = evaluation::naming_job(file, several, [&] {
                    return evaluation::check_file(
                        file, static_cast<unsigned>(common.threads), templates_folder(share),
                        [&](const std::string& text) { progress(text); }, laboratory);
                });
            }
            if (several) {
                check.findings = evaluation::of_job(std::move(check.findings), file);
            }
            return print_check(file, check, common);
        });
        code = std::max(code, one);
    }
    return code;
}

ExitCode verify_files(const std::vector<std::string>& files, const std::string& trust_store,
                      const std::vector<std::string>& revocation_lists, const CommonOptions& common) {
    signing::TrustedMaterial trusted(signing::read_trust_store(trust_store));
    for (const std::string& file : revocation_lists) {
        const std::vector<signing::Bytes> lists = signing::read_revocation_lists(file);
        trusted.revocation_lists.insert(trusted.revocation_lists.end(), lists.begin(), lists.end());
    }
    ExitCode code = done;
    for (const std::string& file : files) {
        const ExitCode one = explained(common, [&] {
            const std::string bytes = evaluation::read_file(file);
            const signing::Verification verification = signing::verify_signatures(bytes, file, trusted, seconds_now());
            const std::vector<issuing::DocumentIdentity> identities = issuing::identities_in(bytes, file, verification);
            for (const gum::Diagnostic& doubt : issuing::doubts_about(file, identities, verification)) {
                print_message(doubt, common);
            }
            for (const gum::Diagnostic& doubt : outputs::doubts_about_set(file, bytes)) {
                print_message(doubt, common);
            }
            print_verification(file, verification, identities, common);
            return verification.valid ? done : negative_answer;
        });
        code = std::max(code, one);
    }
    return code;
}

}  // namespace gumcert::cli
