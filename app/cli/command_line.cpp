// What may be said to the program `gumcert`: its commands and options, in the words of --help.
#include "app/cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "archive/store/open_store.h"
#include "certificate/localised_text.h"
#include "evaluation/kinds.h"
#include "issuing/output_forms.h"
#include "reports/audit/audit_form.h"
#include "text/lists.h"

namespace gumcert::cli {

namespace {

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
    "stderr: where — what is wrong — the rule — what to do [code]; gumcert explain CODE says more.";

constexpr const char* k_trust_help = "Certificates that are trusted, for signatures: a PEM file, or a folder of them";
constexpr const char* k_record_help =
    "Record file, or - for standard output; default: the job's name with -record.json";

/// The values of --format.
std::vector<std::string> names_of(const auto& forms) {
    std::vector<std::string> names;
    for (const auto& form : forms) {
        names.emplace_back(form.name);
    }
    return names;
}

/// "html, pdf, text, dcc (digital certificate, XML), or csv (scores of a comparison)".
std::string words_of(const auto& forms) {
    std::string words;
    for (const auto& form : forms) {
        words += words.empty() ? "" : &form == &forms.back() ? ", or " : ", ";
        words += form.name;
        words += form.description.empty() ? "" : " (" + std::string(form.description) + ")";
    }
    return words;
}

/// "budget, rotary_table, circle_closure and comparison".
std::string kinds_in_words() {
    const std::vector<std::string_view> words = evaluation::words_of(evaluation::program_kinds());
    return text::all_of({words.begin(), words.end()});
}

/// The languages that documents are printed in.
struct Languages {
    std::vector<std::string> codes{certificate::k_languages.begin(), certificate::k_languages.end()};
    /// "en, de, zh-Hant, es".
    [[nodiscard]] std::string in_words() const { return fmt::format("{}", fmt::join(codes, ", ")); }
    [[nodiscard]] CLI::IsMember check() const { return CLI::IsMember(codes); }
};

/// --format of what people and programs read on the terminal.
void add_form_of_answer(CLI::App& command, std::string& format) {
    command.add_option("--format", format, "text (for people), json or csv (for programs). Default: text")
        ->type_name("FORM")
        ->check(CLI::IsMember({"text", "json", "csv"}));
}

CLI::Option& add_file(CLI::App& command, const std::string& names, std::string& file, const std::string& help) {
    return *command.add_option(names, file, help)->type_name("FILE");
}

void add_share(CLI::App& command, std::string& share) {
    command.add_option("--share", share, "Folder that holds templates/")->type_name("FOLDER");
}

void add_laboratory(CLI::App& command, std::string& laboratory) {
    command
        .add_option("--laboratory", laboratory,
                    "Folder with the data of the laboratory and its standards, docs/laboratory.md; before the one that "
                    "the\njob names")
        ->type_name("FOLDER")
        ->check(CLI::ExistingDirectory);
}

/// "500MB" becomes a number of bytes. A number below 0 or beyond what a machine has would wrap to one that is no limit.
/// \return what is wrong; "": nothing
std::string bytes_of_size(std::string& text) {
    constexpr std::size_t k_most_digits = 15;
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    if (digits == 0 || digits > k_most_digits) {
        return "is no size: a whole number with or without a unit, such as 500MB, 4GiB or 0";
    }
    return CLI::AsSizeValue(true)(text);
}

void add_common(CLI::App& command, CommonOptions& common) {
    command.add_flag("-q,--quiet", common.quiet, "No progress, no summary, no notes");
    command.add_flag("--json-messages", common.json_messages, "Messages as one JSON object a line");
    command.add_option("--threads", common.threads, "Threads to use; results are the same bytes for any number")
        ->check(CLI::Range(1, 1024));
    command
        .add_option("--memory-limit", common.memory_limit,
                    "Memory that the command may use, such as 500MB or 4GiB; 0 is no limit. Default: none; of commands "
                    "that read files of others 1 GiB for every 10 MB")
        ->transform(CLI::Validator(bytes_of_size, "SIZE"))
        ->type_name("SIZE");
    command
        .add_option(
            "--time-limit", common.time_limit,
            "Seconds after which the command ends; 0 is no limit. Default: none; of commands that read files of "
            "others 30 for every 10 MB, and 600 for the evaluation of a record, or of a job that is audited (gumcert "
            "limits)")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{100'000'000}))
        ->type_name("SECONDS");
    add_file(command, "--refusal-log", common.refusal_log,
             "Adds a line for each refusal to this file: time, command, code, place. Also: GUMCERT_REFUSAL_LOG");
}

void add_document_options(CLI::App& command, DocumentOptions& options) {
    command
        .add_option("--language", options.languages,
                    "Languages of the documents, the binding one first, at most two: " + Languages().in_words() +
                        ". Default: those of the certificate data, else en")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("LANGUAGE")
        ->check(Languages().check());
    command.add_flag("--draft", options.draft,
                     "Print a certificate that critical findings block, marked as a draft, with the findings on it");
    add_file(command, "--sign", options.signer,
             "Sign the digital certificate (XAdES) and the PDF (PAdES): a signer description, docs/signing.md");
    add_share(command, options.share);
}

void add_covariance_option(CLI::App& command, DocumentOptions& options) {
    command
        .add_option("--covariance", options.covariance,
                    "Form of the covariance file of a rotary table: csv, npy (NumPy), parts (NumPy, grows with the\n"
                    "angles: docs/rotary_table_job.md), none, or auto: csv for up to 1000 quantities, else parts")
        ->type_name("FORM")
        ->check(CLI::IsMember({"auto", "none", "csv", "npy", "parts"}));
}

void add_study_options(CLI::App& command, Arguments& a) {
    add_file(command, "-o,--output", a.output,
             "File; its ending says the form: .txt, .json, .html or .pdf. Default: text to the terminal");
    add_share(command, a.share);
}

void add_run(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("run", "Evaluate jobs and write record, covariance and certificates");
    command.add_option("JOB", a.jobs, "Job files (JSON)")->required();
    command
        .add_option("-o,--output", a.documents.output,
                    "Folder for the output; default: the job's name with -out, beside the job. "
                    "With several jobs, a folder for each in it")
        ->type_name("FOLDER");
    add_laboratory(command, a.documents.laboratory);
    add_document_options(command, a.documents);
    add_covariance_option(command, a.documents);
    command.footer(
        "Example: gumcert run examples/rotary_table/job.json -o /tmp/certificate\n"
        "Kinds of jobs: " +
        kinds_in_words() +
        ", each explained in docs/KIND_job.md.\n"
        "Writes record.json, covariance.csv, certificate.html, certificate.pdf and certificate.xml (the digital\n"
        "certificate), and audit.html, what the audit finds, for the laboratory only: all or none; of a comparison\n"
        "record.json, comparison.html, comparison.pdf, comparison.csv and audit.html. Without certificate data in the "
        "job the documents are specimens\n"
        "(docs/certificate_data.md). Findings of severity critical block the documents of a certificate: the record "
        "is\n"
        "written, and the exit code is 1. Of several jobs each is done on its own; the exit code is the highest.");
}

void add_evaluate(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("evaluate", "Evaluate a job and write its record only");
    command.add_option("JOB", a.job, "Job file (JSON)")->required();
    add_file(command, "-o,--output", a.documents.output, k_record_help);
    add_laboratory(command, a.documents.laboratory);
    add_share(command, a.documents.share);
    add_covariance_option(command, a.documents);
    command.footer("Example: gumcert evaluate job.json -o record.json");
}

void add_compare(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "compare", "Do results agree, and what does that prove? Evaluate a comparison and write its record");
    command.add_option("JOB", a.job, "Job file (JSON) of kind comparison")->required();
    add_file(command, "-o,--output", a.documents.output, k_record_help);
    add_laboratory(command, a.documents.laboratory);
    add_share(command, a.documents.share);
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
}

void add_render(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("render", "Make documents from records");
    command.add_option("RECORD", a.records, "Record files (JSON)")->required();
    command.add_option("--format", a.format, words_of(issuing::output_forms()))
        ->required()
        ->type_name("FORM")
        ->check(CLI::IsMember(names_of(issuing::output_forms())));
    add_file(command, "-o,--output", a.documents.output,
             "File, or - for standard output; with several records a folder. Default: beside the record");
    add_document_options(command, a.documents);
    add_file(
        command, "--superseded-by", a.documents.superseded_by,
        "Record of the certificate or report that amends or replaces this one: every page is marked as superseded");
    add_file(command, "--head", a.documents.head,
             "Head of the archive that holds the record, as gumcert archive head writes it: certificates as HTML, PDF\n"
             "and text print it at their end, with a QR code");
    command.add_option("--check-at", a.documents.check_at, "Where readers can have that head checked, as an address")
        ->type_name("TEXT");
    command.footer(
        "Example: gumcert render record.json --format pdf -o certificate.pdf\n"
        "         gumcert render record.json --format report   the internal budget report; no certificate\n"
        "         gumcert render record.json --format label    a label with a QR code\n"
        "         gumcert render record.json --format pdf --language de,en\n"
        "         gumcert render record.json --format pdf --head head.json   docs/archive.md\n"
        "The job in the record is evaluated again first: a record that says anything else than its job gives, by one\n"
        "digit or one word, is refused. docs/adr/0027-records-are-evaluated-again.md");
}

void add_import(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("import", "Take numbers over from a certificate into a budget");
    command.add_option("KIND", a.format, "dcc: a digital calibration certificate, version 3.0 to 3.3")
        ->required()
        ->check(CLI::IsMember({"dcc"}));
    command.add_option("FILE", a.file, "The certificate (XML)")->required();
    add_file(command, "-o,--output", a.output,
             "Job file of kind budget with the numbers as inputs; default: to the terminal");
    command
        .add_option(
            "--standard", a.standard,
            "Identification: the certificate becomes a file of the register, docs/laboratory.md; -o may be the\n"
            "folder standards/ then")
        ->type_name("ID");
    add_file(command, "--trust", a.trust_store, k_trust_help);
    command.footer(
        "Example: gumcert import dcc certificate.xml -o standard.json --trust trusted.pem\n"
        "Every number comes with its U, k and distribution, and names the certificate as its source. Keep the inputs\n"
        "that you need, and write the model. Drafts, specimens, broken rules and uncertainties that cannot be used "
        "are\n"
        "told. A certificate that was changed after it was signed is refused; exit code 1 where a signature cannot be\n"
        "relied on. docs/digital_certificate.md");
}

void add_check(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("check", "Look for what is wrong with files, without writing anything");
    command
        .add_option("FILE", a.files,
                    "Jobs and records (JSON), folders of outputs; or the word dcc, and digital certificates (XML)")
        ->required();
    add_file(command, "--trust", a.trust_store, k_trust_help);
    add_laboratory(command, a.documents.laboratory);
    add_share(command, a.share);
    command.footer(
        "Example: gumcert check job.json record.json\n"
        "         gumcert check dcc certificate.xml\n"
        "A job is read with all its files and not evaluated. Of a record, its own digest is compared, its job is\n"
        "evaluated again, and every number, text and verdict compared. A digital certificate is checked by the rules\n"
        "above its schema, for a draft or a specimen, for statements of uncertainty that cannot be used, and for its\n"
        "signature. Of a folder, the files that were written together are held against their manifest. Exit code 1\n"
        "where an error is found. docs/digital_certificate.md, docs/reliability.md");
}

void add_audit(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "audit", "What an assessor would remark on an uncertainty budget, and what each remark does to the result");
    command
        .add_option("FILE", a.files,
                    "Jobs and records (JSON), budgets as tables (CSV) or workbooks (.xlsx), folders of them")
        ->required();
    command
        .add_option("-o,--output", a.audit.output,
                    "File, whose ending says the form, or folder: audit.txt, audit.json, audit.sarif, audit.html and "
                    "audit.pdf, or the one that --format names. Default: text to the terminal")
        ->type_name("PLACE");
    command.add_option("--format", a.audit.format, words_of(reports::audit_forms()))
        ->type_name("FORM")
        ->check(CLI::IsMember(names_of(reports::audit_forms())));
    command
        .add_option("--language", a.audit.languages,
                    "Language of text, HTML and PDF: " + Languages().in_words() + ". Default: en")
        ->expected(1)
        ->type_name("LANGUAGE")
        ->check(Languages().check());
    add_file(
        command, "--waivers", a.audit.waivers,
        "Findings that somebody accepts, with name, date and reason (JSON): they are shown as accepted, and do not "
        "decide on the exit code");
    command.add_flag("--verbose", a.audit.verbose, "Name every rule that was not checked, and why");
    add_laboratory(command, a.audit.laboratory);
    add_share(command, a.audit.share);
    command.footer(
        "Example: gumcert audit examples/audit/paper_fixture_budget/budget.csv\n"
        "         gumcert audit budget.xlsx -o audit.html\n"
        "         gumcert audit budgets/ --format json -o -\n"
        "A table begins with a row of heads: quantity, estimate, unit, u, divisor, distribution, sensitivity,\n"
        "contribution, nu, source, comment, in any order, in English or German; rows named u_c, nu_eff, k and U state\n"
        "the claimed result. Formulas of workbooks are evaluated. Each finding is corrected in a copy, and everything\n"
        "is evaluated again: its effect on U, on the verdict and on En, alone and together. Exit code 1 where a "
        "finding\n"
        "is critical. docs/audit.md, docs/audit_rules.md");
}

void add_verify(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("verify", "Check the signatures of certificates (XML or PDF)");
    command.add_option("FILE", a.files, "Signed files")->required();
    add_file(command, "--trust", a.trust_store, "Certificates that are trusted: a PEM file, or a folder of them")
        .required();
    command
        .add_option("--crl", a.revocation_lists, "Lists of revoked certificates of their issuers: files, PEM or DER")
        ->allow_extra_args(false)
        ->type_name("FILE");
    command.footer(
        "Example: gumcert verify certificate.pdf --trust trusted.pem --crl revoked.crl\n"
        "Says whose certificate it is, who signed, when, and what the signature covers; warns where signer and\n"
        "laboratory differ, PDF and digital certificate, or dates. Exit code 1 when a file is not signed, or a "
        "signature\n"
        "is not valid. docs/signing.md");
}

void add_archive(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "archive", "Certificates and their evidence: kept so that nothing is lost, and no change goes unseen");
    ArchiveOptions& o = a.archive;
    command.add_option("ACTION", o.action, "What to do, below")->required()->check(CLI::IsMember(archive_actions()));
    command.add_option("NAME", o.named,
                       "Numbers of certificates; of add and amend a record and its documents; of verify heads "
                       "and evidence, behind each evidence documents that should be its own; of list words that "
                       "number, state, time or item contain");
    add_file(command, "--store", o.store,
             "The archive: one file on a disk of this machine, or a database of PostgreSQL as\n"
             "postgresql://USER@HOST/DATABASE, with the password in ~/.pgpass");
    add_file(command, "--to", o.to, "For migrate: the new archive, as --store");
    command.add_option("--by", o.by, "Who does this: a name, as it will stand in the log")->type_name("PERSON");
    command.add_option("--why", o.why, "The reason, for the log; withdraw and settings need it")->type_name("TEXT");
    command
        .add_option("--request-key", o.request_key,
                    "A text of your own that makes the request one: asked again with it, nothing happens twice")
        ->type_name("KEY");
    command
        .add_option(
            "--today", o.today,
            "The day by the calendar, 2026-11-24: needed where the last entry is more than a week old, or of another "
            "year and a number is taken, because of a clock that may be ahead; and after a clock that was")
        ->type_name("DAY");
    command
        .add_option("--format", o.format,
                    "text (for people), json (for programs) or, of affected, csv (for tables). Default: text")
        ->type_name("FORM")
        ->check(CLI::IsMember({"text", "json", "csv"}));
    add_file(command, "-o,--output", o.output,
             "File of export (default: the number with -evidence.json), head (default: the terminal) or backup; of\n"
             "affected a folder for drafts of amendments");
    command
        .add_option("--numbering", o.numbering,
                    "Pattern of certificate numbers for init and settings, such as EX-YYYY-####; default: the archive "
                    "gives none")
        ->type_name("PATTERN");
    command
        .add_option("--person", o.persons,
                    "A person with roles for init and settings, as NAME=author,reviewer,authoriser,keeper; once for "
                    "each. Default: "
                    "anybody may do everything")
        ->allow_extra_args(false)
        ->type_name("PERSON");
    command.add_flag("--no-four-eyes", o.one_pair_of_eyes,
                     "For init and settings: who drafted a certificate may review and authorise it");
    command.add_option("--head", o.heads, "For verify: an earlier head, which the archive must still begin with")
        ->allow_extra_args(false)
        ->type_name("FILE");
    add_file(command, "--sign", o.sign,
             "For head and export: private key of kind Ed25519 (PEM) that signs the head, and the states in evidence");
    add_file(command, "--trust", o.trust,
             "For add and amend: certificates that are trusted, as of gumcert verify. For verify: the public key\n"
             "(PEM, Ed25519) that heads and evidence must be signed with");
    command
        .add_option("--amend", o.amend,
                    "For number: the certificate that is amended; taken is its next number, as EX-2026-0042/A1")
        ->type_name("NUMBER");
    command
        .add_option(
            "--source", o.source,
            "For affected: the standard, by its identification in the register or the number of its certificate")
        ->type_name("ID");
    command
        .add_option("--since", o.since,
                    "For affected: the first day of use that counts, as 2026-11-21. For head and export: an earlier "
                    "head, or evidence, which the new one proves to extend")
        ->type_name("DATE");
    command.add_option("--until", o.until, "For affected: the last day of use that counts. Default: there is none")
        ->type_name("DATE");
    command
        .add_option(
            "--register", o.register_folder,
            "For affected: folder of the laboratory with the corrected standard; the certificates are calculated "
            "again")
        ->type_name("DIR");
    command.add_flag("--shared", o.shared,
                     "For affected and replay of an archive on a server: all machines that run gumcert archive worker "
                     "help");
    command.add_flag("--wait-for-work", o.wait, "For worker: wait for work, and do not end");
    add_share(command, o.share);
    command.footer(
        "Example: gumcert archive init --store lab.archive --by \"A. Keeper\" --numbering EX-YYYY-####\n"
        "         gumcert archive number --store lab.archive --by \"R. Lin\"       the next certificate number\n"
        "         gumcert archive add record.json certificate.pdf certificate.xml --store lab.archive --by \"R. Lin\"\n"
        "         gumcert archive issue EX-2026-0042 --store lab.archive --by \"M. Weber\"\n"
        "         gumcert archive verify --store lab.archive --head head.json\n"
        "init begins an archive, and settings states all of its settings anew; number takes the next number; add "
        "brings a record with its documents in as a draft, "
        "or\n"
        "in place of one; review, authorise and issue lead it on, and nobody reviews or authorises what he drafted.\n"
        "amend brings in an amendment: when it is issued, its original is amended or superseded. withdraw ends a\n"
        "certificate, a draft or a number. list and show read; export writes the evidence of one certificate, which\n"
        "verify reads without the archive; head writes what proves later that nothing was changed: keep it elsewhere.\n"
        "verify computes every hash again, backup copies while others write, and verifies the copy; migrate copies "
        "into\n"
        "an archive of either kind, with the same entries, hashes and heads; replay evaluates archived records with\n"
        "this program, and reports what differs; worker does on any machine what affected and replay share;\n"
        "statistics counts certificates by month, method and person, and "
        "charts\n"
        "E_n and repeatability; affected finds the certificates that rest on a standard, calculates\n"
        "them again, and drafts amendments. Exit code 1 where verify, replay or affected finds\n"
        "something. docs/archive.md");
}

void add_simulate(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "simulate", "Simulate measurements of a rotary-table job with a known truth, and evaluate them");
    command.add_option("JOB", a.job, "Job file (JSON) of kind rotary_table")->required();
    command.add_option("--runs", a.runs, "Simulated campaigns; default: as the job says, else 100")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--seed", a.seed, "Seed of the random numbers; default: as the job says, else 1")
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53));
    add_study_options(command, a);
    command.footer(
        "Example: gumcert simulate examples/rotary_table/simulation.json --runs 20 -o study.html\n"
        "Says how far evaluated set-up and error motions are from the simulated truth, how much of that is the choice\n"
        "of a datum and how much is measurement, and whether the stated uncertainties hold. docs/simulation.md");
}

void add_plan(CLI::App& program, Arguments& a) {
    CLI::App& command =
        *program.add_subcommand("plan", "Uncertainty to expect of a rotary-table job before anything is measured");
    command.add_option("JOB", a.job, "Job file (JSON) of kind rotary_table; measured lengths are not needed")
        ->required();
    add_study_options(command, a);
    command.footer(
        "Example: gumcert plan examples/rotary_table/plan.json -o plan.html\n"
        "Expected expanded uncertainties, what each station and the number of angles contribute, and better station\n"
        "positions inside the region that the job allows. docs/planning.md");
}

void add_laboratory_command(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "laboratory", "What runs out in the folder of a laboratory: standards, signatories, accreditation");
    command.add_option("FOLDER", a.file, "Folder of the laboratory, docs/laboratory.md")
        ->required()
        ->check(CLI::ExistingDirectory);
    command.add_option("--date", a.date, "Day of the overview, such as 2026-11-21; default: today by UTC")
        ->type_name("DAY");
    add_form_of_answer(command, a.format);
    command.footer(
        "Example: gumcert laboratory examples/laboratory/laboratory --date 2026-11-21\n"
        "Of every standard: last calibration and certificate up to that day, the last day of use, the next "
        "calibration\n"
        "by the plan in its file and what it follows from, and whether it is overdue. What the register does not say "
        "is\n"
        "unknown, and not valid. Exit code 1 where a standard is overdue, or a signatory or the accreditation has run\n"
        "out. docs/laboratory.md");
}

void add_self_test(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand(
        "self-test", "Published cases on this machine, with a validation report for ISO/IEC 17025:2017, 7.11.2");
    command
        .add_option("-o,--output", a.output,
                    "Folder for self-test.json, self-test.html and self-test.pdf; default: gumcert-self-test- with the "
                    "date")
        ->type_name("FOLDER");
    command
        .add_option("--case", a.cases, "Only this case, with all of its values on the terminal; no report is written")
        ->allow_extra_args(false)
        ->type_name("NAME");
    command
        .add_option("--language", a.language, "Language of HTML and PDF: " + Languages().in_words() + ". Default: en")
        ->type_name("LANGUAGE")
        ->check(Languages().check());
    add_share(command, a.share);
    command.footer(
        "Example: gumcert self-test\n"
        "         gumcert self-test --case gum-h1-end-gauge\n"
        "Evaluates the published cases that come with the program (GUM, its supplements, EA-4/02, NIST StRD …) and "
        "holds\n"
        "every value against the number that its source prints. The report says what was computed on which program,\n"
        "machine and libraries, how many digits agree, and its own SHA-256. Exit code 1 where a case fails. Without\n"
        "Node.js there is no PDF. docs/self_test.md");
}

void add_rerun(CLI::App& program, Arguments& a) {
    CLI::App& command =
        *program.add_subcommand("rerun", "Evaluate the jobs in old records with this version, and list what changed");
    command.add_option("RECORD", a.records, "Record files (JSON) of any version")->required();
    add_form_of_answer(command, a.format);
    add_share(command, a.share);
    command.footer(
        "Example: gumcert rerun archive/*/record.json\n"
        "Of every record: the same in every number, or each place where a number, a printed digit or a verdict "
        "differs,\n"
        "with the old and the new value; or why it cannot be evaluated. Nothing is written. Exit code 0 where no "
        "printed\n"
        "digit and no verdict changed, 1 where one did or a record cannot be evaluated, 3 where a file is no record.\n"
        "docs/self_test.md");
}

void add_init(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("init", "Begin with a method that comes with the program");
    command.add_option("METHOD", a.method, "Name of the method; left out: all of them are listed");
    command.add_option("DIR", a.folder,
                       "New folder for its job, data and certificate; default: the name of the method");
    add_share(command, a.share);
    command.footer(
        "Example: gumcert init multimeter my-multimeter && gumcert run my-multimeter/job.json\n"
        "         gumcert init                        the methods\n"
        "Writes a job that runs, with made-up data: put yours in their place. Nothing is overwritten.");
}

void add_explain(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("explain", "What the code of a message means, and what to do about it");
    command.add_option("CODE", a.codes,
                       "Codes, as in brackets at the end of messages, or their families, such as GC-RANK");
    add_share(command, a.share);
    command.footer(
        "Example: gumcert explain GC-OUTLIER-0001     one code\n"
        "         gumcert explain GC-OUTLIER          the codes of a family\n"
        "         gumcert explain                     all families\n"
        "A message says where, what is wrong, the rule and what to do. Its code stays the same from version to "
        "version;\n"
        "here stands what it means, what usually causes it, what to do where the message is not enough, and whether a\n"
        "certificate can be issued all the same. Small letters, brackets and a missing GC- are understood. Texts are "
        "in\n"
        "English only. A finding such as R07-e is no code: docs/findings.md. All codes: docs/messages.md");
}

void add_limits(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("limits", "Sizes, numbers, time and memory beyond which is refused");
    command.footer(
        "Example: gumcert limits\n"
        "Prints each limit of this program and where it applies. What is beyond one is refused with its place, or "
        "ended.\n"
        "The numbers that single keys of a job allow stand in docs/job_keys.md.");
}

void add_fonts(CLI::App& program, Arguments& a) {
    CLI::App& command = *program.add_subcommand("fonts", "The fonts that a template of a PDF may use");
    add_share(command, a.share);
    command.footer(
        "Example: gumcert fonts --share laboratory-share\n"
        "Prints the families with their styles and where they come from: those that the program has inside, those in\n"
        "templates/pdf/fonts, where a laboratory puts its own (.otf, .ttf), and those for other scripts, which are "
        "opened\n"
        "for documents that need them. Fonts of the machine are never used. docs/templates.md");
}

}  // namespace

std::unique_ptr<CLI::App> command_line(Arguments& a, std::string (*version)()) {
    auto program = std::make_unique<CLI::App>(k_description, "gumcert");
    program->footer(k_footer);
    program->require_subcommand(0, 1);
    program->set_version_flag("--version", version, "Version, commit and SHA-256 of this program");
    add_run(*program, a);
    add_evaluate(*program, a);
    add_compare(*program, a);
    add_render(*program, a);
    add_import(*program, a);
    add_check(*program, a);
    add_audit(*program, a);
    add_verify(*program, a);
    add_archive(*program, a);
    add_simulate(*program, a);
    add_plan(*program, a);
    add_laboratory_command(*program, a);
    add_self_test(*program, a);
    add_rerun(*program, a);
    add_init(*program, a);
    add_explain(*program, a);
    add_fonts(*program, a);
    add_limits(*program);
    add_common(*program, a.common);
    for (CLI::App* command : program->get_subcommands({})) {
        add_common(*command, a.common);
    }
    return program;
}

namespace {

/// What the parser says. It says words of the command line in small letters, and in parts: where one holds a password, which
/// would not be known again in them, it says no more than the name of the option.
std::string said_by_parser(const CLI::ParseError& wrong, std::span<char* const> words) {
    std::string all;
    for (const char* const word : words) {
        all += std::string(word) + ' ';
    }
    std::string without = all;
    archive::hide_passwords(without);
    std::string said = wrong.what();
    if (without == all) {
        return said;
    }
    const std::string option = said.substr(0, said.find(':'));
    const bool is_option = option.starts_with("--") && std::any_of(words.begin(), words.end(), [&](const char* word) {
                               return option == word || std::string_view(word).starts_with(option + '=');
                           });
    return (is_option ? option + ": its value" : std::string("a word")) +
           " has another form than it may have, or is not taken here; words are not shown, because one has a password";
}

/// Most empty words come of a variable of the shell that is not set. Taken for an option that is not there, such a word would
/// leave out what was asked for: a signature, a mark, a head to hold the archive against.
/// \throws gum::UsageError
void refuse_empty_words(const CLI::App& of_one) {
    for (const CLI::Option* const option : of_one.get_options()) {
        for (const std::string& word : option->results()) {
            if (word.empty()) {
                refuse_usage(option->get_name(), "is empty",
                             "an empty word says nothing; many come of a variable of the shell that is not set",
                             "give what belongs there, or leave it out");
            }
        }
    }
}

}  // namespace

std::optional<ExitCode> read_command_line(int argc, char** argv, std::string (*version)(), Arguments& arguments) {
    const std::unique_ptr<CLI::App> program = command_line(arguments, version);
    try {
        program->parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        return static_cast<ExitCode>(program->exit(asked));
    } catch (const CLI::ParseError& wrong) {
        throw std::invalid_argument(said_by_parser(wrong, std::span(argv, static_cast<std::size_t>(argc))));
    }
    if (program->get_subcommands().empty()) {
        print_to_stdout("{}", program->help());
        return done;
    }
    refuse_empty_words(*program);
    refuse_empty_words(*program->get_subcommands().front());
    arguments.command = program->get_subcommands().front()->get_name();
    arguments.common.command = arguments.command;
    return std::nullopt;
}

}  // namespace gumcert::cli
