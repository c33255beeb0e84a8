#include "app/cli/issue_commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "app/cli/summary.h"
#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/name_job.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "archive/printed_head.h"
#include "certificate/gates/day_of_issue.h"
#include "certificate/gates/gates.h"
#include "certificate/gates/printed_languages.h"
#include "evaluation/audit_evaluation.h"
#include "evaluation/check_file.h"
#include "evaluation/evaluate_job.h"
#include "evaluation/read_file.h"
#include "evaluation/recompute_record.h"
#include "evaluation/unprintable_characters.h"
#include "issuing/issue_documents.h"
#include "outputs/output_files.h"
#include "outputs/output_set.h"
#include "reports/audit/audit_html.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/record_sentences.h"
#include "reports/forms/study_document.h"
#include "reports/record/evaluation_record.h"
#include "reports/view/named_tables.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

std::optional<reports::HeadToPrint> head_to_print(const DocumentOptions& options) {
    if (options.head.empty()) {
        return std::nullopt;
    }
    const archive::Head head = archive::head_from_json(evaluation::read_file(options.head), options.head);
    return reports::HeadToPrint{.entries = std::to_string(head.size),
                                .digits = archive::short_form(head),
                                .mark = archive::mark_of(head),
                                .check_at = options.check_at};
}

/// What all documents of one command are made with. The signer is looked at first of all; templates when the first
/// document is made, or before an evaluation.
class Issuer {
public:
    explicit Issuer(DocumentOptions options)
        : asked_(std::move(options)),
          signer_(asked_.signer.empty() ? signing::DescribedSigner{} : signing::described_signer(asked_.signer)) {}

    /// What this command reads beside its jobs or records; no output may take the place of it.
    [[nodiscard]] std::vector<fs::path> inputs() const {
        std::vector<fs::path> files = signer_.files;
        if (!asked_.superseded_by.empty()) {
            files.emplace_back(asked_.superseded_by);
        }
        if (!asked_.head.empty()) {
            files.emplace_back(asked_.head);
        }
        add_program_files(files, asked_.share);
        return files;
    }
    [[nodiscard]] const std::vector<gum::Diagnostic>& warnings() const { return signer_.warnings; }

    /// \param with_templates  false: for a form of the document that needs none
    [[nodiscard]] const issuing::IssueOptions& options(bool with_templates = true) {
        options_.signer = signer_.signer.get();
        if (with_templates && !worker_) {
            options_.assets = render_assets(asked_.share, asked_.languages);
            options_.assets.head = head_to_print(asked_);
            options_.signing_time = seconds_now();
            worker_ = std::make_unique<reports::PdfWorker>(options_.assets);
            options_.worker = worker_.get();
        }
        return options_;
    }

    /// Tells what a PDF lacks before an evaluation begins that would be lost.
    /// \throws gum::StorageError
    void require_ready() {
        (void)options();
        worker_->require_ready();
    }

    /// The same of a job that was read: a page is set with its characters.
    /// \return characters that no font has
    /// \throws gum::StorageError
    [[nodiscard]] std::vector<gum::Diagnostic> look_at(const evaluation::ReadJob& job) {
        (void)options();
        return evaluation::unprintable_characters(job, [this](const std::vector<std::string>& characters) {
            return reports::characters_without_glyph(characters, options_.assets, *worker_);
        });
    }

private:
    DocumentOptions asked_;
    signing::DescribedSigner signer_;
    std::unique_ptr<reports::PdfWorker> worker_;
    issuing::IssueOptions options_;
};

/// Says of a job that it takes much memory, before it does.
/// \throws gum::StorageError  GC-STORE-0026 where it is more than the command may take
void tell_memory(const evaluation::ReadJob& job, const CommonOptions& common) {
    constexpr double k_told = 1e9;  // [byte]
    constexpr double k_megabyte = 1e6;
    const bool is_too_much =
        common.memory_limit.value_or(0) > 0 && job.memory > static_cast<double>(*common.memory_limit);
    if (!is_too_much && job.memory < k_told) {
        return;
    }
    const gum::Diagnostic needed{
        .code = "GC-STORE-0026",
        .where = job.names.front(),
        .what = fmt::format("its evaluation takes about {:.0f} MB of memory", job.memory / k_megabyte),
        .rule = "it grows as the number of results times that of inputs, or as the square of the angles",
        .action = is_too_much ? "split the job, or give it more by --memory-limit"
                              : "split the job where the machine has less",
        .severity = is_too_much ? gum::Severity::error : gum::Severity::note};
    if (is_too_much) {
        throw gum::StorageError(needed);
    }
    print_messages({&needed, 1}, common);
}

void print_warnings(const Issuer& issuer, const CommonOptions& common) {
    for (const gum::Diagnostic& warning : issuer.warnings()) {
        print_message(warning, common);
    }
}

void print_written(const std::vector<outputs::OutputFile>& files) {
    print_to_stdout("\nWritten:\n");
    for (const outputs::OutputFile& file : files) {
        print_to_stdout("  {}\n", text::one_line(file.path.string()));
    }
}

/// A certificate that is dated later than today is not issued: reported here, and not in the record, which is the
/// same on every day.
/// Judges what the record cannot know: the day, the languages that are asked for, and the numbers of tables in them.
void judge_issue(reports::EvaluationRecord& record, const std::vector<std::string>& languages,
                 const std::string& share) {
    if (!record.certificate) {
        return;
    }
    const bool too_early = certificate::block_issue_ahead_of_time(*record.certificate, today());
    const bool lacking = certificate::judge_printed_languages(*record.certificate, languages);
    std::vector<certificate::Finding> of_tables;
    if (reports::names_tables_before_adjustment(*record.certificate)) {  // their numbers are those of the document
        const reports::RenderAssets assets = render_assets(share, languages);
        of_tables =
            reports::findings_on_named_tables(*record.certificate, reports::view_of_document(record, assets),
                                              languages.empty() ? record.certificate->data.languages : languages);
        certificate::add_findings(*record.certificate, of_tables);
    }
    if (too_early || lacking || !of_tables.empty()) {  // what was found now has to be worded, too
        reports::identify_sentences(record, *reports::read_sentences(templates_folder(share)));
    }
}

bool withheld(const reports::EvaluationRecord& record, bool draft) {
    return record.certificate && record.certificate->blocked && !draft;
}

/// Says why no document is written, and which old ones must not be taken for it.
void report_withheld(const std::string& where, const std::vector<fs::path>& documents, const CommonOptions& common) {
    print_message({.code = "GC-CERT-0305",
                   .where = where,
                   .what = "no document is written: critical findings block the issue of the certificate",
                   .rule = "ISO/IEC 17025:2017, 7.8",
                   .action = "mend what the findings say, or print a draft with --draft",
                   .severity = gum::Severity::error},
                  common);
    for (const fs::path& file : documents) {
        std::error_code error;
        if (fs::exists(file, error)) {
            print_message({.code = "GC-CERT-0306",
                           .where = file.string(),
                           .what = "is a document of an earlier evaluation",
                           .rule = "the record beside it is the new one",
                           .action = "remove it, so that nobody takes it for the document of this record",
                           .severity = gum::Severity::warning},
                          common);
        }
    }
}

/// The audit as run writes it beside the record.
constexpr const char* k_audit_file = "audit.html";

/// Critical findings of the audit, where no certificate has them among its own findings; then how many there are of each
/// severity.
void report_audit(const evaluation::Evaluation& evaluation, const CommonOptions& common) {
    const audit::AuditReport& report = *evaluation.audit;
    for (const audit::AuditFinding& finding : report.findings) {
        if (evaluation.record.certificate || !audit::is_open_critical(finding, report.subject.waivers)) {
            continue;
        }
        print_message({.code = "GC-AUDIT-0020",
                       .where = "audit " + finding.rule + ", " + finding.where,
                       .what = finding.what.english(),
                       .rule = "a critical finding: an assessor would not accept this result",
                       .action = finding.correction,
                       .severity = gum::Severity::warning},
                      common);
    }
}

void print_audit(const audit::AuditReport& report, const fs::path& where_to_read) {
    std::array<int, 4> counts{};
    for (const audit::AuditFinding& finding : report.findings) {
        ++counts.at(static_cast<std::size_t>(finding.severity));
    }
    print_to_stdout("Audit: {} critical, {} major, {} minor, {} to know; {}\n", counts[3], counts[2], counts[1],
                    counts[0], text::one_line(where_to_read.string()));
}

/// Documents of a kind of records as they stand in a folder.
std::vector<fs::path> document_files(const evaluation::Kind& kind, const fs::path& folder) {
    std::vector<fs::path> files;
    for (const std::string& name : issuing::document_names(kind)) {
        files.push_back(folder / name);
    }
    return files;
}

/// \param inputs   of the command, in addition to the files of the job
/// \param several  whether the command has other jobs
/// \return true when the answer is negative
bool run_job(const fs::path& job, const fs::path& folder, std::vector<fs::path> inputs,
             const outputs::OutputsAtStart& at_start, Issuer& issuer, const DocumentOptions& options,
             const CommonOptions& common, ProgressLine& progress, bool several) {
    evaluation::Evaluation evaluation = evaluation::evaluate_job(
        job, {evaluation::CovarianceFile::own_folder, *reports::covariance_form(options.covariance)},
        static_cast<unsigned>(common.threads), templates_folder(options.share),
        [&](const std::string& text) { progress(text); }, evaluation::program_kinds(), options.laboratory,
        [&](const evaluation::ReadJob& read) {
            tell_memory(read, common);
            progress("characters of the documents");
            const std::vector<gum::Diagnostic> warnings = issuer.look_at(read);
            progress.clear();
            print_messages(several ? of_job(warnings, job) : warnings, common);
        });
    const reports::EvaluationRecord& record = evaluation.record;
    const std::vector<fs::path> documents =
        document_files(evaluation::kind_of(record, evaluation::program_kinds()), folder);
    std::vector<outputs::OutputFile> files{{folder / "record.json", reports::to_canonical_json(record)}};
    judge_issue(evaluation.record, options.languages, options.share);  // the record is written as it is on every day
    if (!evaluation.covariance.empty()) {
        files.push_back({folder / evaluation.covariance_file, evaluation.covariance});
    }
    for (const fs::path& file : evaluation::input_files(job, record, options.laboratory)) {
        inputs.push_back(file);
    }
    const bool held_back = withheld(record, options.draft);
    const auto make_documents = [&] {
        files.push_back(
            {folder / k_audit_file, reports::audit_as_html(evaluation::audit_view(std::span(evaluation.audit.get(), 1),
                                                                                  {record.job_files.front().sha256}),
                                                           issuer.options().assets)});
        if (!held_back) {
            progress("documents");
            std::vector<issuing::IssuedDocument> issued = issuing::issue_documents(record, issuer.options());
            for (std::size_t i = 0; i < issued.size(); ++i) {
                files.push_back({documents[i], std::move(issued[i].bytes)});
            }
        }
        return true;
    };
    make_or_keep([&] { (void)naming_job(job, several, make_documents); },
                 [&] {
                     progress.clear();
                     keep_files(files, inputs, at_start, "is the record of this evaluation",
                                "print the record in another form: gumcert render " +
                                    kept_place(files.front().path).string() + " --format html",
                                common);
                 });
    progress("writing");
    write_outputs(files, inputs, at_start);
    progress.clear();
    if (several) {  // the files are written: from here on the record is for the terminal only
        evaluation.record.diagnostics = of_job(std::move(evaluation.record.diagnostics), job);
    }
    report_diagnostics(record, common);
    report_findings(record, common);
    report_audit(evaluation, common);
    report_kept(folder / "record.json", common);
    if (held_back) {
        report_withheld(job.string(), documents, common);
    }
    if (!common.quiet) {
        print_summary(record);
        print_audit(*evaluation.audit, folder / k_audit_file);
        print_written(files);
    }
    return evaluation.negative || evaluation.blocked || evaluation::is_refuted_by_audit(evaluation) ||
           (record.certificate && record.certificate->blocked);
}

fs::path folder_of(const fs::path& job, const std::string& output, bool several) {
    const std::string name = job.stem().string() + "-out";
    if (output.empty()) {
        return job.parent_path() / name;
    }
    return several ? fs::path(output) / name : fs::path(output);
}

/// Two inputs of one command must not write to one place.
void require_different(const std::vector<fs::path>& places, const std::string& what) {
    std::set<fs::path> seen;
    for (const fs::path& place : places) {
        if (!seen.insert(place.lexically_normal()).second) {
            refuse_usage(place.string(), "two " + what + " would be written there", "each has a place of its own",
                         "give them different names, or run them one by one with -o");
        }
    }
}

/// What is done with a record that was not evaluated again: nothing is believed, so nothing is issued.
/// \return whether a draft is to be printed
bool print_as_unchecked(reports::EvaluationRecord& record, gum::Diagnostic why, const DocumentOptions& options,
                        const CommonOptions& common) {
    if (!options.signer.empty()) {
        throw gum::InputError(std::move(why));
    }
    why.severity = options.draft ? gum::Severity::warning : gum::Severity::error;
    print_message(why, common);
    if (options.draft && record.certificate) {
        record.certificate->blocked = true;
        record.certificate->symbol = false;
    }
    return options.draft;
}

/// \param file    empty: to standard output
/// \param inputs  of the command
ExitCode render_record(const std::string& name, const std::string& format, const fs::path& file,
                       const std::vector<fs::path>& inputs, const outputs::OutputsAtStart& at_start, Issuer& issuer,
                       const DocumentOptions& options, const CommonOptions& common) {
    const std::string bytes_read = evaluation::read_file(name);
    for (const gum::Diagnostic& doubt : outputs::doubts_about_set(name, bytes_read)) {
        print_message(doubt, common);
    }
    reports::EvaluationRecord record = reports::record_from_json(bytes_read, name);
    if (issuing::output_form(format).ending.ends_with(".pdf")) {
        issuer.require_ready();  // before the job of the record is evaluated again
    }
    ProgressLine progress(!common.quiet);
    const std::optional<gum::Diagnostic> unchecked = evaluation::recompute_record(
        record, name, static_cast<unsigned>(common.threads), templates_folder(options.share),
        [&](const std::string& text) { progress("checking the record: " + text); });
    progress.clear();
    if (unchecked && !print_as_unchecked(record, *unchecked, options, common)) {
        return negative_answer;
    }
    if (!options.superseded_by.empty()) {
        issuing::supersede(
            record, reports::record_from_json(evaluation::read_file(options.superseded_by), options.superseded_by),
            name, options.superseded_by);
    }
    judge_issue(record, options.languages, options.share);
    if (issuing::output_form(format).is_issued && withheld(record, options.draft)) {
        report_findings(record, common);
        report_withheld(name, {file}, common);
        return negative_answer;
    }
    const std::string bytes =
        issuing::issue_document(record, format, issuer.options(issuing::output_form(format).with_templates));
    if (file.empty()) {
        write_to_stdout(bytes);
        return done;
    }
    write_outputs({{file, bytes}}, inputs, at_start);
    if (!common.quiet) {
        print_to_stdout("Written: {}\n", text::one_line(file.string()));
    }
    return done;
}

}  // namespace

/// What a PDF lacks is told before an evaluation that would be lost; what is wrong with a job, before what is wrong with
/// the installation.
void require_ready(Issuer& issuer, const std::vector<std::string>& jobs, const DocumentOptions& options,
                   const CommonOptions& common) {
    try {
        issuer.require_ready();
    } catch (const gum::StorageError&) {
        for (const std::string& job : jobs) {
            std::vector<gum::Diagnostic> found =
                evaluation::check_file(job, static_cast<unsigned>(common.threads), templates_folder(options.share), {},
                                       options.laboratory)
                    .findings;
            std::erase_if(found, [](const gum::Diagnostic& d) { return d.severity != gum::Severity::error; });
            if (!found.empty()) {
                throw gum::InputError(jobs.size() > 1 ? of_job(std::move(found), job) : std::move(found));
            }
        }
        throw;
    }
}

ExitCode run_jobs(const std::vector<std::string>& jobs, const DocumentOptions& options, const CommonOptions& common) {
    refuse_stdout("-o", options.output);
    std::vector<fs::path> folders;
    for (const std::string& job : jobs) {
        folders.push_back(folder_of(job, options.output, jobs.size() > 1));
        outputs::require_writable(folders.back() / "record.json");
    }
    require_different(folders, "jobs");
    Issuer issuer(options);
    std::vector<fs::path> inputs = issuer.inputs();
    inputs.insert(inputs.end(), jobs.begin(), jobs.end());
    std::vector<fs::path> outputs;
    for (const fs::path& folder : folders) {
        for (const fs::path& file : {folder / "record.json", folder / "covariance.csv", folder / k_audit_file}) {
            outputs.insert(outputs.end(), {file, kept_place(file)});
        }
        for (const evaluation::Kind& kind : evaluation::program_kinds()) {
            const std::vector<fs::path> documents = document_files(kind, folder);
            outputs.insert(outputs.end(), documents.begin(), documents.end());
        }
    }
    outputs::require_not_inputs(outputs, inputs);
    const outputs::OutputsAtStart at_start = begin_outputs(outputs, common);
    print_warnings(issuer, common);
    require_ready(issuer, jobs, options, common);
    ExitCode code = done;
    ProgressLine progress(!common.quiet);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const ExitCode one = explained(common, [&] {
            const bool several = jobs.size() > 1;
            const bool is_negative = naming_job(jobs[i], several, [&] {
                return run_job(jobs[i], folders[i], inputs, at_start, issuer, options, common, progress, several);
            });
            return is_negative ? negative_answer : done;
        });
        code = std::max(code, one);
    }
    return code;
}

ExitCode evaluate_to_record(const fs::path& job, const DocumentOptions& options, const CommonOptions& common) {
    const std::string& output = options.output;
    const std::string& share = options.share;
    const bool to_stdout = output == "-";
    const fs::path record_file =
        output.empty() ? job.parent_path() / (job.stem().string() + "-record.json") : fs::path(output);
    std::vector<fs::path> inputs{job};
    add_program_files(inputs, share);
    if (!to_stdout) {
        outputs::require_writable(record_file);
        outputs::require_not_an_input(record_file, inputs);
    }
    const outputs::OutputsAtStart at_start =
        to_stdout ? outputs::OutputsAtStart() : begin_outputs({record_file}, common);
    ProgressLine progress(!common.quiet);
    evaluation::Evaluation evaluation = evaluation::evaluate_job(
        job,
        {to_stdout ? evaluation::CovarianceFile::none : evaluation::CovarianceFile::with_others,
         *reports::covariance_form(options.covariance)},
        static_cast<unsigned>(common.threads), templates_folder(share),
        [&](const std::string& text) { progress(text); }, evaluation::program_kinds(), options.laboratory,
        [&](const evaluation::ReadJob& read) { tell_memory(read, common); });
    const std::string text = reports::to_canonical_json(evaluation.record);
    judge_issue(evaluation.record, {}, share);
    progress.clear();
    const bool blocked =
        evaluation.blocked || (evaluation.record.certificate && evaluation.record.certificate->blocked);
    const bool negative = evaluation.negative || blocked || evaluation::is_refuted_by_audit(evaluation);
    const ExitCode code = negative ? negative_answer : done;
    if (to_stdout) {
        report_diagnostics(evaluation.record, common);
        report_findings(evaluation.record, common);
        report_audit(evaluation, common);
        write_to_stdout(text);
        return code;
    }
    std::vector<outputs::OutputFile> files{{record_file, text}};
    if (!evaluation.covariance.empty()) {
        files.push_back({record_file.parent_path() / evaluation.covariance_file, evaluation.covariance});
    }
    for (const fs::path& file : evaluation::input_files(job, evaluation.record, options.laboratory)) {
        inputs.push_back(file);
    }
    write_outputs(files, inputs, at_start);
    report_diagnostics(evaluation.record, common);
    report_findings(evaluation.record, common);
    report_audit(evaluation, common);
    if (!common.quiet) {
        print_summary(evaluation.record);
        print_audit(*evaluation.audit, "gumcert audit " + record_file.string() + " -o audit.html shows them");
        print_written(files);
        print_to_stdout("Next: gumcert render {} --format pdf{}\n", text::one_line(record_file.string()),
                        blocked ? " --draft" : "");
    }
    return code;
}

ExitCode compare_to_record(const fs::path& job, const DocumentOptions& options, const CommonOptions& common) {
    evaluation::require_comparison_job(job);
    return evaluate_to_record(job, options, common);
}

ExitCode render_records(const std::vector<std::string>& records, const std::string& format,
                        const DocumentOptions& options, const CommonOptions& common) {
    const bool several = records.size() > 1;
    const bool to_stdout = options.output == "-";
    if (options.head.empty() && !options.check_at.empty()) {
        refuse_usage("--check-at", "without --head", "it says where the head of the archive can be checked",
                     "name the head, or leave it out");
    }
    if (!options.head.empty() && format != "pdf" && format != "html" && format != "text") {
        refuse_usage("--head", "--format " + format, "certificates as HTML, PDF and text print a head of the archive",
                     "leave it out");
    }
    if (!options.signer.empty() && !issuing::output_form(format).is_signed) {
        refuse_usage("--sign", "--format " + format,
                     "signatures are put into digital certificates and PDF certificates",
                     "leave it out, or ask for --format pdf or dcc");
    }
    if (to_stdout && several) {
        refuse_usage("-o -", "several records", "standard output takes one document", "render them one by one");
    }
    std::vector<fs::path> files;
    for (const std::string& name : records) {
        const fs::path record(name);
        const fs::path beside =
            record.parent_path() / (record.stem().string() + std::string(issuing::output_form(format).ending));
        files.push_back(options.output.empty() ? beside
                        : several              ? fs::path(options.output) / beside.filename()
                                               : fs::path(options.output));
        if (!to_stdout) {
            outputs::require_writable(files.back());
        }
    }
    require_different(files, "documents");
    if (!to_stdout) {
        outputs::require_not_inputs(files, {records.begin(), records.end()});
    }
    Issuer issuer(options);
    std::vector<fs::path> inputs = issuer.inputs();
    inputs.insert(inputs.end(), records.begin(), records.end());
    if (!to_stdout) {
        outputs::require_not_inputs(files, inputs);
    }
    const outputs::OutputsAtStart at_start = to_stdout ? outputs::OutputsAtStart() : begin_outputs(files, common);
    print_warnings(issuer, common);
    ExitCode code = done;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const ExitCode one = explained(common, [&] {
            return render_record(records[i], format, to_stdout ? fs::path() : files[i], inputs, at_start, issuer,
                                 options, common);
        });
        code = std::max(code, one);
    }
    return code;
}

}  // namespace gumcert::cli
