#include "app/cli/issue_commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "archive/printed_head.h"
#include "evaluation/audit_evaluation.h"
#include "evaluation/check_file.h"
#include "evaluation/evaluate_job.h"
#include "evaluation/limits.h"
#include "evaluation/name_job.h"
#include "evaluation/needed_memory.h"
#include "evaluation/read_file.h"
#include "evaluation/recompute_record.h"
#include "evaluation/unprintable_characters.h"
#include "issuing/issue_documents.h"
#include "issuing/judge_issue.h"
#include "issuing/run_files.h"
#include "outputs/kept_files.h"
#include "outputs/output_files.h"
#include "outputs/output_set.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/study_document.h"
#include "reports/record/evaluation_record.h"
#include "reports/summary/record_summary.h"
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

/// \throws gum::StorageError  GC-STORE-0026 where a job takes more memory than the command may
void tell_memory(const evaluation::ReadJob& job, const CommonOptions& common) {
    const std::optional<gum::Diagnostic> needed = evaluation::needed_memory(job, common.memory_limit.value_or(0));
    if (needed && needed->severity == gum::Severity::error) {
        throw gum::StorageError(*needed);
    }
    if (needed) {
        print_messages({&*needed, 1}, common);
    }
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

/// What documents are judged by: templates and languages.
void judge_issue(reports::EvaluationRecord& record, const std::vector<std::string>& languages,
                 const std::string& share) {
    reports::RenderAssets assets;
    assets.templates = templates_folder(share);
    assets.languages = languages;
    issuing::judge_issue(record, today(), assets);
}

/// Says why no document is written, and which old ones must not be taken for it.
void report_withheld(const std::string& where, const std::vector<fs::path>& documents, const CommonOptions& common) {
    print_message(issuing::withheld(where), common);
    for (const fs::path& file : documents) {
        std::error_code error;
        if (fs::exists(file, error)) {
            print_message(issuing::document_of_earlier(file.string()), common);
        }
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
            print_messages(several ? evaluation::of_job(warnings, job) : warnings, common);
        });
    const reports::EvaluationRecord& record = evaluation.record;
    std::vector<outputs::OutputFile> files = issuing::evaluated_files(evaluation, folder / issuing::k_record_file);
    judge_issue(evaluation.record, options.languages, options.share);  // the record is written as it is on every day
    for (const fs::path& file : evaluation::input_files(job, record, options.laboratory)) {
        inputs.push_back(file);
    }
    const bool held_back = issuing::is_withheld(record, options.draft);
    const auto make_documents = [&] {
        files.push_back(issuing::audit_file(evaluation, folder, issuer.options().assets));
        if (!held_back) {
            progress("documents");
            std::vector<outputs::OutputFile> documents = issuing::document_files(record, folder, issuer.options());
            std::move(documents.begin(), documents.end(), std::back_inserter(files));
        }
        return true;
    };
    outputs::make_or_keep([&] { (void)evaluation::naming_job(job, several, make_documents); },
                          [&] {
                              progress.clear();
                              keep_files(files, inputs, at_start, "is the record of this evaluation",
                                         "print the record in another form: gumcert render " +
                                             outputs::kept_place(files.front().path).string() + " --format html",
                                         common);
                          });
    progress("writing");
    write_outputs(files, inputs, at_start);
    progress.clear();
    if (several) {  // the files are written: from here on the record is for the terminal only
        evaluation.record.diagnostics = evaluation::of_job(std::move(evaluation.record.diagnostics), job);
    }
    report_diagnostics(record, common);
    report_findings(record, common);
    print_messages(evaluation::critical_messages(evaluation), common);
    report_kept(folder / issuing::k_record_file, common);
    if (held_back) {
        report_withheld(job.string(),
                        issuing::document_places(evaluation::kind_of(record, evaluation::program_kinds()), folder),
                        common);
    }
    if (!common.quiet) {
        print_to_stdout("{}", reports::summary_text(record));
        print_audit(*evaluation.audit, folder / issuing::k_audit_file);
        print_written(files);
    }
    return issuing::is_negative(evaluation);
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
    std::optional<gum::Diagnostic> unchecked;
    work_within_walls(common, evaluation::walls_of_evaluation({name}), "for the evaluation of " + text::one_line(name),
                      [&] {  // the record may be one of others
                          unchecked = evaluation::recompute_record(
                              record, name, static_cast<unsigned>(common.threads), templates_folder(options.share),
                              [&](const std::string& text) { progress("checking the record: " + text); });
                      });
    progress.clear();
    if (unchecked && !print_as_unchecked(record, *unchecked, options, common)) {
        return negative_answer;
    }
    if (!options.superseded_by.empty()) {
        issuing::supersede(
            record, reports::record_from_json(evaluation::read_file(options.superseded_by), options.superseded_by),
            name, options.superseded_by, today());
    }
    judge_issue(record, options.languages, options.share);
    if (issuing::output_form(format).is_issued && issuing::is_withheld(record, options.draft)) {
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
                throw gum::InputError(jobs.size() > 1 ? evaluation::of_job(std::move(found), job) : std::move(found));
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
        outputs::require_writable(folders.back() / issuing::k_record_file);
    }
    require_different(folders, "jobs");
    Issuer issuer(options);
    std::vector<fs::path> inputs = issuer.inputs();
    inputs.insert(inputs.end(), jobs.begin(), jobs.end());
    std::vector<fs::path> outputs;
    for (const fs::path& folder : folders) {
        for (const fs::path& file : issuing::evaluated_places(folder)) {
            outputs.insert(outputs.end(), {file, outputs::kept_place(file)});
        }
        for (const evaluation::Kind& kind : evaluation::program_kinds()) {
            const std::vector<fs::path> documents = issuing::document_places(kind, folder);
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
            const bool is_negative = evaluation::naming_job(jobs[i], several, [&] {
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
    const std::vector<outputs::OutputFile> files = issuing::evaluated_files(evaluation, record_file);
    judge_issue(evaluation.record, {}, share);
    progress.clear();
    const bool blocked =
        evaluation.blocked || (evaluation.record.certificate && evaluation.record.certificate->blocked);
    const ExitCode code = issuing::is_negative(evaluation) ? negative_answer : done;
    if (to_stdout) {
        report_diagnostics(evaluation.record, common);
        report_findings(evaluation.record, common);
        print_messages(evaluation::critical_messages(evaluation), common);
        write_to_stdout(files.front().bytes);
        return code;
    }
    for (const fs::path& file : evaluation::input_files(job, evaluation.record, options.laboratory)) {
        inputs.push_back(file);
    }
    write_outputs(files, inputs, at_start);
    report_diagnostics(evaluation.record, common);
    report_findings(evaluation.record, common);
    print_messages(evaluation::critical_messages(evaluation), common);
    if (!common.quiet) {
        print_to_stdout("{}", reports::summary_text(evaluation.record));
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
