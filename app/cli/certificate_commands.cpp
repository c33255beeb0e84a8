#include "app/cli/certificate_commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "evaluation/check_file.h"
#include "evaluation/name_job.h"
#include "evaluation/read_file.h"
#include "imports/foreign_certificate.h"
#include "imports/import_certificate.h"
#include "imports/import_standard.h"
#include "issuing/document_identity.h"
#include "issuing/verification_text.h"
#include "jobs/laboratory/laboratory_folder.h"
#include "outputs/output_files.h"
#include "outputs/output_set.h"
#include "signing/verify.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

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
                        progress_within_walls(common, text::one_line(file),
                                              [&](const std::string& text) { progress(text); }, {file}),
                        laboratory);
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
            for (const auto* signatures : {&verification.signatures, &verification.attachment_signatures}) {
                for (const signing::SignatureReport& signature : *signatures) {
                    print_messages(signature.findings, common);
                }
            }
            if (!common.quiet) {
                print_to_stdout("{}", issuing::verification_text(file, verification, identities));
            }
            return verification.valid ? done : negative_answer;
        });
        code = std::max(code, one);
    }
    return code;
}

}  // namespace gumcert::cli
