// The program `gumcert`: reads the command line, calls a use case, turns failures into messages and exit codes.
#include <fmt/core.h>
#include <gumcert_build_info.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/certificate_commands.h"
#include "app/cli/issue_commands.h"
#include "app/cli/share_folder.h"
#include "app/cli/study_commands.h"
#include "app/cli/terminal.h"
#include "app/read_file.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"

namespace {

using namespace gumcert;       // NOLINT(google-build-using-namespace): one program, one file
using namespace gumcert::cli;  // NOLINT(google-build-using-namespace)

std::string version_text() {
    std::string digest = "unknown";
    try {
        digest = encoding::sha256(app::read_file(cli::executable()));
    } catch (const gum::DiagnosedError&) {
        // A system without /proc: the version is still told.
    }
    return fmt::format("gumcert {}\ncommit {}\nsha256 {}", k_version, k_commit, digest);
}

constexpr const char* k_description =
    "gumcert evaluates measurements with their uncertainty (GUM, ISO/IEC Guide 98-3) and writes the calibration\n"
    "certificate. A job file (JSON) names the measurement and its data files.";

constexpr const char* k_footer =
    "Start here:\n"
    "  gumcert run examples/rotary_table/job.json     evaluate, write record, HTML, PDF and DCC into job-out/\n"
    "  gumcert run examples/gauge_block/job.json      an uncertainty budget, with Monte Carlo; docs/budget_job.md\n"
    "  gumcert run examples/certificate/end_gauge.json   an accredited certificate; docs/certificate_data.md\n"
    "  gumcert run examples/comparison/key_comparison.json   do laboratories agree? docs/comparison_job.md\n"
    "  gumcert plan examples/rotary_table/plan.json   the uncertainty to expect, before anything is measured\n"
    "  gumcert simulate examples/rotary_table/simulation.json   measurements with a known truth, evaluated\n"
    "\n"
    "Exit codes: 0 done; 1 done, and the answer is negative; 2 the command line is wrong; 3 an input was refused;\n"
    "4 no result can be computed; 5 a file or disk trouble; 70 a defect in the program. Nothing is written when the\n"
    "exit code is 2, 3 or 4. An output is a new file or takes the place of a regular one, never of an input of the\n"
    "command. Units: um, nm/K, J/(kg K), V/Hz^(1/2), degC; docs/budget_job.md. Messages go to\n"
    "stderr: where — what is wrong — the rule — what to do [code].";

/// What the command line may say; CLI11 fills it.
struct Arguments {
    CommonOptions common;
    std::vector<std::string> jobs, records, files, revocation_lists;
    std::string job, file, output, format, share, trust_store;
    DocumentOptions documents;
    std::optional<std::size_t> runs;
    std::optional<std::int64_t> seed;
};

constexpr const char* k_trust_help = "Certificates that are trusted, for signatures: a PEM file, or a folder of them";
constexpr const char* k_share_help = "Folder that holds templates/ and node_modules/";

void add_common(CLI::App& command, CommonOptions& common) {
    command.add_flag("-q,--quiet", common.quiet, "No progress, no summary, no notes");
    command.add_flag("--json-messages", common.json_messages, "Messages as one JSON object a line");
    command.add_option("--threads", common.threads, "Threads to use; results are the same bytes for any number")
        ->check(CLI::Range(1, 1024));
}

void add_document_options(CLI::App& command, DocumentOptions& options) {
    command
        .add_option("--language", options.languages,
                    "Languages of the documents, the binding one first, at most two: en, de, zh-Hant, es. "
                    "Default: those of the certificate data, else en")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember({"en", "de", "zh-Hant", "es"}));
    command.add_flag("--draft", options.draft,
                     "Print a certificate that critical findings block, marked as a draft, with the findings on it");
    command.add_option(
        "--sign", options.signer,
        "Sign the digital certificate (XAdES) and the PDF (PAdES): a signer description, docs/signing.md");
    command.add_option("--share", options.share, k_share_help);
}

void add_covariance_option(CLI::App& command, DocumentOptions& options) {
    command
        .add_option("--covariance", options.covariance,
                    "Form of the covariance file of a rotary table: csv, npy (NumPy), parts (NumPy, grows with the\n"
                    "angles: docs/rotary_table_job.md), none, or auto: csv for up to 1000 quantities, else parts")
        ->check(CLI::IsMember({"auto", "none", "csv", "npy", "parts"}));
}

CLI::App& add_run(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("run", "Evaluate jobs and write record, covariance and certificates");
    command.add_option("JOB", a.jobs, "Job files (JSON)")->required();
    command.add_option("-o,--output", a.documents.output,
                       "Folder for the output; default: the job's name with -out, beside the job. "
                       "With several jobs, a folder for each in it");
    add_document_options(command, a.documents);
    add_covariance_option(command, a.documents);
    command.footer(
        "Example: gumcert run examples/rotary_table/job.json -o /tmp/certificate\n"
        "Kinds of jobs: budget, rotary_table, circle_closure and comparison, each explained in docs/KIND_job.md.\n"
        "Writes record.json, covariance.csv, certificate.html, certificate.pdf and certificate.xml (the digital\n"
        "certificate), all or none; of a comparison record.json, comparison.html, comparison.pdf and\n"
        "comparison.csv. Without certificate data in the job the documents are specimens\n"
        "(docs/certificate_data.md). Findings of severity critical block the documents of a certificate: the record "
        "is\n"
        "written, and the exit code is 1. Of several jobs each is done on its own; the exit code is the highest.");
    return command;
}

CLI::App& add_evaluate(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("evaluate", "Evaluate a job and write its record only");
    command.add_option("JOB", a.job, "Job file (JSON)")->required();
    command.add_option("-o,--output", a.documents.output,
                       "Record file, or - for standard output; default: the job's name with -record.json");
    command.add_option("--share", a.documents.share, k_share_help);
    add_covariance_option(command, a.documents);
    command.footer("Example: gumcert evaluate job.json -o record.json");
    return command;
}

CLI::App& add_compare(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "compare", "Do results agree, and what does that prove? Evaluate a comparison and write its record");
    command.add_option("JOB", a.job, "Job file (JSON) of kind comparison")->required();
    command.add_option("-o,--output", a.documents.output,
                       "Record file, or - for standard output; default: the job's name with -record.json");
    command.add_option("--share", a.documents.share, k_share_help);
    command.footer(
        "Between laboratories, the job names participants with their results (value and u, or U with k) and how the\n"
        "assigned value is found: one laboratory's result, a given value, a weighted mean, a robust mean, the largest\n"
        "consistent subset … Scores En, zeta, z, z', D with the correlation of each result with the assigned value.\n"
        "For a method against a reference method, the job names lab and reference with their points.\n"
        "  {\"schema\": \"gumcert/job/1\", \"kind\": \"comparison\", \"unit\": \"mm\",\n"
        "   \"assigned_value\": \"weighted_mean\",\n"
        "   \"participants\": [{\"id\": \"A\", \"value\": 12.31, \"u\": 0.10},\n"
        "                    {\"id\": \"B\", \"value\": 12.18, \"U\": 0.30, \"k\": 2}]}\n"
        "Example: gumcert compare job.json -o record.json\n"
        "         gumcert render record.json --format pdf      the report; also html, text and csv\n"
        "         gumcert run job.json                         both at once\n"
        "|En| at or below 1 says that a difference is not larger than its U, no more: U that is stated too large "
        "always\n"
        "passes. The numbers that show it stand beside every En. docs/comparison_job.md");
    return command;
}

CLI::App& add_render(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("render", "Make documents from records");
    command.add_option("RECORD", a.records, "Record files (JSON)")->required();
    command
        .add_option("--format", a.format,
                    "html, pdf, dcc (digital certificate, XML), text, or csv (scores of a comparison)")
        ->required()
        ->check(CLI::IsMember({"html", "pdf", "text", "dcc", "csv"}));
    command.add_option("-o,--output", a.documents.output,
                       "File, or - for standard output; with several records a folder. Default: beside the record");
    add_document_options(command, a.documents);
    command.footer(
        "Example: gumcert render record.json --format pdf -o certificate.pdf\n"
        "         gumcert render record.json --format pdf --language de,en\n"
        "The job in the record is evaluated again first: a record that says anything else than its job gives, by one\n"
        "digit or one word, is refused. docs/adr/0027-records-are-evaluated-again.md");
    return command;
}

CLI::App& add_import(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("import", "Take numbers over from a certificate into a budget");
    command.add_option("KIND", a.format, "dcc: a digital calibration certificate, version 3.1 to 3.3")
        ->required()
        ->check(CLI::IsMember({"dcc"}));
    command.add_option("FILE", a.file, "The certificate (XML)")->required();
    command.add_option("-o,--output", a.output,
                       "Job file of kind budget with the numbers as inputs; default: to the terminal");
    command.add_option("--trust", a.trust_store, k_trust_help);
    command.footer(
        "Example: gumcert import dcc certificate.xml -o standard.json --trust trusted.pem\n"
        "Every number comes with its U, k and distribution, and names the certificate as its source. Keep the inputs\n"
        "that you need, and write the model. Drafts, specimens, broken rules and uncertainties that cannot be used "
        "are\n"
        "told. A certificate that was changed after it was signed is refused; exit code 1 where a signature cannot be\n"
        "relied on. docs/digital_certificate.md");
    return command;
}

CLI::App& add_check(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("check", "Look for what is wrong with files, without writing anything");
    command.add_option("FILE", a.files, "Jobs and records (JSON); or the word dcc, and digital certificates (XML)")
        ->required();
    command.add_option("--trust", a.trust_store, k_trust_help);
    command.add_option("--share", a.share, k_share_help);
    command.footer(
        "Example: gumcert check job.json record.json\n"
        "         gumcert check dcc certificate.xml\n"
        "A job is read with all its files and not evaluated. Of a record, its own digest is compared, its job is\n"
        "evaluated again, and every number, text and verdict compared. A digital certificate is checked by the rules\n"
        "above its schema, for a draft or a specimen, for statements of uncertainty that cannot be used, and for its\n"
        "signature. Exit code 1 where an error is found. docs/digital_certificate.md");
    return command;
}

CLI::App& add_verify(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("verify", "Check the signatures of certificates (XML or PDF)");
    command.add_option("FILE", a.files, "Signed files")->required();
    command.add_option("--trust", a.trust_store, "Certificates that are trusted: a PEM file, or a folder of them")
        ->required();
    command
        .add_option("--crl", a.revocation_lists, "Lists of revoked certificates of their issuers: files, PEM or DER")
        ->allow_extra_args(false);
    command.footer(
        "Example: gumcert verify certificate.pdf --trust trusted.pem --crl revoked.crl\n"
        "Says whose certificate it is, who signed, when, and what the signature covers; warns where signer and\n"
        "laboratory differ, PDF and digital certificate, or dates. Exit code 1 when a file is not signed, or a "
        "signature\n"
        "is not valid. docs/signing.md");
    return command;
}

CLI::App& add_simulate(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "simulate", "Simulate measurements of a rotary-table job with a known truth, and evaluate them");
    command.add_option("JOB", a.job, "Job file (JSON) of kind rotary_table")->required();
    command.add_option("--runs", a.runs, "Simulated campaigns; default: as the job says, else 100")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--seed", a.seed, "Seed of the random numbers; default: as the job says, else 1")
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53));
    command.footer(
        "Example: gumcert simulate examples/rotary_table/simulation.json --runs 20 -o study.html\n"
        "Says how far evaluated set-up and error motions are from the simulated truth, how much of that is the choice\n"
        "of a datum and how much is measurement, and whether the stated uncertainties hold. docs/simulation.md");
    return command;
}

CLI::App& add_plan(CLI::App& program, Arguments& a) {
    CLI::App& command =
        *program.add_subcommand("plan", "Uncertainty to expect of a rotary-table job before anything is measured");
    command.add_option("JOB", a.job, "Job file (JSON) of kind rotary_table; measured lengths are not needed")
        ->required();
    command.footer(
        "Example: gumcert plan examples/rotary_table/plan.json -o plan.html\n"
        "Expected expanded uncertainties, what each station and the number of angles contribute, and better station\n"
        "positions inside the region that the job allows. docs/planning.md");
    return command;
}

ExitCode dispatch(int argc, char** argv, Arguments& a) {
    CLI::App program{k_description, "gumcert"};
    program.footer(k_footer);
    program.require_subcommand(0, 1);
    program.set_version_flag("--version", version_text, "Version, commit and SHA-256 of this program");
    CLI::App& run = add_run(program, a);
    CLI::App& evaluate = add_evaluate(program, a);
    CLI::App& compare = add_compare(program, a);
    CLI::App& render = add_render(program, a);
    CLI::App& import = add_import(program, a);
    CLI::App& check = add_check(program, a);
    CLI::App& verify = add_verify(program, a);
    CLI::App& simulate_command = add_simulate(program, a);
    CLI::App& plan_command = add_plan(program, a);
    for (CLI::App* command : {&simulate_command, &plan_command}) {
        command->add_option(
            "-o,--output", a.output,
            "File; its ending says the form: .txt, .json, .html or .pdf. Default: text to the terminal");
        command->add_option("--share", a.share, k_share_help);
    }
    for (CLI::App* command :
         {&program, &run, &evaluate, &compare, &render, &import, &check, &verify, &simulate_command, &plan_command}) {
        add_common(*command, a.common);
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        return static_cast<ExitCode>(program.exit(asked));
    } catch (const CLI::ParseError& wrong) {
        refuse_usage("command line", wrong.what(), "see gumcert --help", "correct the command");
    }
    if (a.documents.languages.size() > 2) {
        refuse_usage("--language", "more than two languages", "a document is printed in one language or in two",
                     "name the binding language first, and at most one more");
    }
    if (run.parsed()) {
        return run_jobs(a.jobs, a.documents, a.common);
    }
    if (evaluate.parsed()) {
        return evaluate_to_record(a.job, a.documents, a.common);
    }
    if (compare.parsed()) {
        return compare_to_record(a.job, a.documents, a.common);
    }
    if (render.parsed()) {
        return render_records(a.records, a.format, a.documents, a.common);
    }
    if (import.parsed()) {
        return import_certificate(a.file, a.output, a.trust_store, a.common);
    }
    if (check.parsed()) {
        const bool certificates = a.files.front() == "dcc";
        if (certificates) {
            a.files.erase(a.files.begin());
        }
        if (a.files.empty()) {
            refuse_usage("check dcc", "no file", "gumcert check dcc FILE", "name the digital certificates");
        }
        return check_files(a.files, certificates, a.trust_store, a.share, a.common);
    }
    if (verify.parsed()) {
        return verify_files(a.files, a.trust_store, a.revocation_lists, a.common);
    }
    if (simulate_command.parsed()) {
        return simulate(a.job, a.runs, a.seed, a.output, a.share, a.common);
    }
    if (plan_command.parsed()) {
        return plan(a.job, a.output, a.share, a.common);
    }
    fmt::print("{}", program.help());
    return done;
}

}  // namespace

int main(int argc, char** argv) {
#ifdef SIGXFSZ
    // A write beyond the limit of file sizes fails as one to a full disk does, and is told and cleaned up as that is.
    (void)std::signal(SIGXFSZ, SIG_IGN);
#endif
    Arguments arguments;
    // Also a command line that cannot be read to its end is told in the form that it asks for.
    arguments.common.json_messages = std::any_of(
        argv + 1, argv + argc, [](const char* word) { return std::string_view(word) == "--json-messages"; });
    return explained(arguments.common, [&] { return dispatch(argc, argv, arguments); });
}
