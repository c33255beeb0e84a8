#include "evaluation/audit_files.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "audit/row_facts.h"
#include "audit/rules/registry.h"
#include "audit/sources/certificate_subject.h"
#include "audit/sources/record_subject.h"
#include "audit/tables/workbook_subject.h"
#include "certificate/stated_text.h"
#include "certificate/waiver.h"
#include "encoding/sha2.h"
#include "evaluation/evaluate_job.h"
#include "evaluation/read_file.h"
#include "evaluation/recompute_record.h"
#include "gum/monte_carlo/worker_threads.h"
#include "imports/foreign_certificate.h"
#include "jobs/certificate/certificate_statement.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/printable_text.h"
#include "reports/record/make/certificate/evaluation_findings.h"
#include "signing/verify.h"
#include "text/file_guess.h"
#include "text/small_letters.h"
#include "workbook/read_csv.h"
#include "workbook/read_xlsx.h"

namespace gumcert::evaluation {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> k_endings = {".json", ".csv", ".xlsx", ".xlsm", ".xml"};

enum class Contents { job, record, workbook, table, certificate, pdf, other };

Contents contents_of(const std::string& bytes) {
    if (bytes.starts_with("PK\x03\x04")) {
        return Contents::workbook;
    }
    if (bytes.starts_with("%PDF")) {
        return Contents::pdf;
    }
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string::npos || bytes.starts_with("\xD0\xCF\x11\xE0")) {
        return Contents::other;
    }
    if (bytes[first] == '<') {
        return Contents::certificate;
    }
    if (bytes[first] == '{' || bytes[first] == '/') {
        return bytes.find("\"gumcert/record/") != std::string::npos ? Contents::record : Contents::job;
    }
    return Contents::table;
}

std::vector<std::string> places_of(const std::vector<gum::Diagnostic>& problems) {
    std::vector<std::string> places;
    for (const gum::Diagnostic& problem : problems) {
        places.push_back(problem.where + ": " + problem.what);
    }
    return places;
}

/// Puts to the subject of a record where it says something else than its own job gives, and, where it does not, the
/// budgets that its results rest on.
void hold_against_job(const reports::EvaluationRecord& record, unsigned threads, const fs::path& templates,
                      const gum::Progress& progress, audit::AuditSubject& subject) {
    if (const std::optional<gum::Diagnostic> why = not_recomputable(record, subject.name)) {
        subject.not_read.push_back(
            audit::say("{record}: was not held against its own job: {reason:sentence}", subject.name, why->what));
        if (record.rotary && record.rotary->fixture_budget && !record.rotary->fixture_budget->largest.empty()) {
            subject.not_read.push_back(audit::say(
                "{record}: the budget of the fixture was not looked at, because the record was not evaluated again",
                subject.name));
        }
        return;
    }
    try {
        const Evaluation evaluation = evaluation_of(record, subject.name, threads, templates, progress);
        subject.disagreements = places_of(disagreements(record, evaluation.record, subject.name));
        if (subject.disagreements->empty() && evaluation.add_nested_budgets) {
            evaluation.add_nested_budgets(subject);
        }
    } catch (const gum::InputError& refused) {
        subject.disagreements = places_of(refused.diagnostics());
    }
}

/// The digital certificate that is attached to a PDF; "" without one.
std::string certificate_in_pdf(const std::string& bytes, const std::string& name) {
    try {
        const std::vector<signing::Bytes> attachments =
            signing::verify_signatures(bytes, name, signing::TrustedMaterial(), 0).attachments;
        return attachments.empty() ? "" : attachments.front();
    } catch (const gum::InputError&) {  // no PDF that can be read
        return "";
    }
}

audit::AuditSubject subject_of_certificate(std::string bytes, const std::string& name) {
    const reports::ParsedDcc document = reports::parse_dcc(std::move(bytes), name);
    return audit::subject_of(document, imports::check_certificate(document, name, {}), name);
}

bool has_digest(const fs::path& file, const std::string& sha256) {
    try {
        return encoding::sha256(read_file(file)) == sha256;
    } catch (const gum::StorageError&) {  // not there
        return false;
    }
}

/// The record in a file, where it can be held against its own job here.
std::optional<reports::EvaluationRecord> recomputable_record(const fs::path& file) {
    try {
        const std::string bytes = read_file(file);
        if (contents_of(bytes) != Contents::record) {
            return std::nullopt;
        }
        reports::EvaluationRecord record = reports::record_from_json(bytes, file.string());
        return not_recomputable(record, file.string()) ? std::nullopt : std::optional(std::move(record));
    } catch (const gum::DiagnosedError&) {  // its audit says what is wrong
        return std::nullopt;
    }
}

/// How many folders two files have in common.
std::ptrdiff_t common_folders(const fs::path& a, const fs::path& b) {
    return std::distance(a.begin(), std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first);
}

/// Puts jobs to the records that were made of them.
void put_jobs_to_records(std::vector<FileToAudit>& files, const fs::path& laboratory) {
    std::vector<std::size_t> jobs;
    std::vector<std::pair<std::size_t, reports::EvaluationRecord>> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (text::in_small_letters(files[i].file.extension().string()) != ".json") {
            continue;
        }
        if (std::optional<reports::EvaluationRecord> record = recomputable_record(files[i].file)) {
            records.emplace_back(i, std::move(*record));
        } else {
            jobs.push_back(i);
        }
    }
    std::vector<bool> is_told(files.size(), false);
    for (const std::size_t job : jobs) {
        const fs::path& file = files[job].file;
        const auto is_of_job = [&](const reports::EvaluationRecord& record) {
            const std::vector<fs::path> inputs = input_files(file, record, laboratory);
            return file.filename() == record.job_files.front().name &&
                   std::equal(inputs.begin(), inputs.end(), record.job_files.begin(), record.job_files.end(),
                              [](const fs::path& input, const reports::InputFile& held) {
                                  return has_digest(input, held.sha256);
                              });
        };
        std::optional<std::size_t> nearest;
        for (const auto& [position, record] : records) {
            if (is_of_job(record) &&
                (!nearest || common_folders(files[position].file, file) > common_folders(files[*nearest].file, file))) {
                nearest = position;
            }
        }
        if (nearest) {
            files[*nearest].jobs.push_back(file);
            is_told[job] = true;
        }
    }
    std::size_t position = 0;
    std::erase_if(files, [&](const FileToAudit&) { return is_told[position++]; });
}

bool is_hidden(const fs::path& file) {
    return file.filename().string().starts_with('.');
}

/// Whether a file is a PDF beside which the digital certificate lies that is audited in its place.
bool has_certificate_beside(const fs::path& file) {
    std::error_code error;
    return text::in_small_letters(file.extension().string()) == ".pdf" &&
           fs::exists(fs::path(file).replace_extension(".xml"), error);
}

/// Whether JSON is that of another part of the program: certificate data, a laboratory's register, an audit, the list of a set of outputs.
/// What is damaged, or says that it is a job, is looked at, and refused with what is wrong.
bool is_other_json(const std::string& bytes) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), last = bytes.find_last_not_of(" \t\r\n");
    if (first != std::string::npos && bytes[first] == '[') {
        return bytes[last] == ']';  // waivers
    }
    const std::string schema = text::outermost_string(bytes, "schema").value_or("");
    if (!schema.empty()) {
        return !schema.starts_with("gumcert/job/") && !schema.starts_with("gumcert/record/");
    }
    return last != std::string::npos && bytes[last] == '}' && !text::outermost_string(bytes, "kind");
}

/// Whether a file of a folder is one that an audit looks at. A PDF is one where a digital certificate is attached that
/// does not lie beside it.
bool is_audited(const fs::path& file) {
    const std::string ending = text::in_small_letters(file.extension().string());
    if (ending == ".json") {
        return !is_hidden(file) && !is_other_json(read_file(file));
    }
    if (ending != ".pdf") {
        return std::find(k_endings.begin(), k_endings.end(), ending) != k_endings.end();
    }
    return !has_certificate_beside(file) && !certificate_in_pdf(read_file(file), file.string()).empty();
}

/// What documents call a file of a folder that was named.
std::string name_in_folder(const fs::path& file, const fs::path& folder) {
    if (folder.is_relative()) {
        return file.lexically_normal().generic_string();
    }
    const fs::path plain = folder.lexically_normal();
    const fs::path& last = plain.has_filename() ? plain : plain.parent_path();
    return (last.filename() / file.lexically_normal().lexically_relative(plain)).generic_string();
}

/// Files that are named have their own names, and their paths where these are not distinct.
void name_named_files(std::vector<FileToAudit>& files) {
    std::map<std::string, std::size_t> count;
    for (const FileToAudit& one : files) {
        ++count[one.name.empty() ? one.file.filename().string() : one.name];
    }
    for (FileToAudit& one : files) {
        if (one.name.empty()) {
            const std::string own = one.file.filename().string();
            one.name = count[own] > 1 ? one.file.lexically_normal().generic_string() : own;
        }
    }
}

}  // namespace

std::vector<fs::path> files_in(const std::vector<fs::path>& named) {
    std::vector<fs::path> files;
    for (const fs::path& name : named) {
        std::error_code error;
        if (!fs::is_directory(name, error)) {
            files.push_back(name);
            continue;
        }
        fs::recursive_directory_iterator at(name, fs::directory_options::skip_permission_denied, error);
        for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
            files.push_back(at->path());
        }
    }
    return files;
}

FilesToAudit files_to_audit(const std::vector<fs::path>& named, const fs::path& laboratory) {
    FilesToAudit all;
    for (const fs::path& name : named) {
        std::error_code error;
        if (!fs::is_directory(name, error)) {
            all.files.push_back({.file = name});
            continue;
        }
        std::vector<FileToAudit> found;
        for (const fs::directory_entry& entry :
             fs::recursive_directory_iterator(name, fs::directory_options::skip_permission_denied)) {
            if (!entry.is_regular_file()) {
                continue;
            }
            if (is_audited(entry.path())) {
                found.push_back({.file = entry.path(), .name = name_in_folder(entry.path(), name)});
            } else if (!is_hidden(entry.path()) && !has_certificate_beside(entry.path())) {
                all.of_other_kinds.push_back(entry.path());
            }
        }
        if (found.empty()) {
            throw gum::InputError(gum::Diagnostic{.code = "GC-AUDIT-0010",
                                                  .where = name.string(),
                                                  .what = "no file in this folder can be audited",
                                                  .rule = "gumcert audit reads jobs and records (JSON), tables (CSV), "
                                                          "workbooks (.xlsx) and digital certificates (XML)",
                                                  .action = "name the files themselves"});
        }
        std::sort(found.begin(), found.end(),
                  [](const FileToAudit& a, const FileToAudit& b) { return a.file < b.file; });
        put_jobs_to_records(found, laboratory);
        all.files.insert(all.files.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
    }
    std::sort(all.of_other_kinds.begin(), all.of_other_kinds.end());
    name_named_files(all.files);
    return all;
}

std::vector<certificate::Waiver> waivers_from(const fs::path& file) {
    const std::string bytes = read_file(file);
    std::vector<certificate::Waiver> waivers = jobs::parse_waivers(bytes, file.string());
    std::vector<gum::Diagnostic> problems;
    for (std::size_t i = 0; i < waivers.size(); ++i) {
        if (!certificate::has_effect(waivers[i], "")) {
            const bool is_named = certificate::is_name(waivers[i].by);
            const bool has_reason = certificate::is_statement(waivers[i].reason);
            problems.push_back(
                {.code = "GC-AUDIT-0012",
                 .where = file.string() + "#/" + std::to_string(i),
                 .what = "the waiver of " + waivers[i].finding +
                         (!is_named     ? " names nobody"
                          : !has_reason ? " has a reason that tells nothing: \"" + waivers[i].reason.in("en") + "\""
                                        : " has no date"),
                 .rule = "a finding is accepted by a person, with a reason that is a sentence",
                 .action = !is_named     ? "state \"by\""
                           : !has_reason ? "state in \"reason\" why the result holds all the same"
                                         : "state \"date\""});
        }
    }
    if (!problems.empty()) {
        throw gum::InputError(std::move(problems));
    }
    return waivers;
}

namespace {

/// What a record says, held against its own job.
audit::AuditSubject subject_of_record(const std::string& bytes, const fs::path& file, unsigned threads,
                                      const fs::path& templates, const gum::Progress& progress) {
    const reports::EvaluationRecord record = reports::record_from_json(bytes, file.string());
    audit::AuditSubject subject = audit::subject_of(record, file.filename().string());
    if (!record.certificate) {
        subject.of_evaluation = reports::evaluation_findings(record);
    }
    hold_against_job(record, threads, templates, progress, subject);
    return subject;
}

void evaluate_within(const AuditWalls& walls, const fs::path& file, const gum::Progress& told,
                     const std::function<void(const gum::Progress&)>& work) {
    if (walls.of_evaluation) {
        walls.of_evaluation(file, told, work);
    } else {
        work(told);
    }
}

void read_within(const AuditWalls& walls, const std::vector<fs::path>& files, const std::function<void()>& work) {
    if (walls.of_reading && !files.empty()) {
        walls.of_reading(files, work);
    } else {
        work();
    }
}

/// The audit of a file before anything in it is accepted by others than itself.
AuditedFile audited_as_it_is(const fs::path& file, unsigned threads, const fs::path& templates,
                             const gum::Progress& progress, const fs::path& laboratory, const AuditWalls& walls) {
    const std::string bytes = read_file(file);
    const std::string name = file.filename().string();
    AuditedFile audited{.file = file, .digest = encoding::sha256(bytes), .report = {}};
    audit::AuditSubject subject;
    switch (contents_of(bytes)) {
        case Contents::job:
            evaluate_within(walls, file, progress, [&](const gum::Progress& told) {
                audited.report =
                    *evaluate_job(file, CovarianceFile::none, threads, templates, told, program_kinds(), laboratory)
                         .audit;
            });
            return audited;
        case Contents::record:
            evaluate_within(walls, file, progress, [&](const gum::Progress& told) {
                subject = subject_of_record(bytes, file, threads, templates, told);
            });
            break;
        case Contents::workbook:
            subject = audit::subject_of(workbook::read_xlsx(bytes, file.string()), name);
            break;
        case Contents::table:
            subject = audit::subject_of(workbook::read_csv(bytes, file.string(), file.stem().string()), name);
            break;
        case Contents::certificate:
            read_within(walls, {file}, [&] { subject = subject_of_certificate(bytes, name); });
            break;
        case Contents::pdf: {
            std::string attached;
            read_within(walls, {file}, [&] {
                attached = certificate_in_pdf(bytes, name);
                subject = attached.empty() ? audit::AuditSubject{} : subject_of_certificate(attached, name);
            });
            if (!attached.empty()) {
                break;
            }
            [[fallthrough]];
        }
        case Contents::other:
            throw gum::InputError(gum::Diagnostic{
                .code = "GC-AUDIT-0011",
                .where = file.string(),
                .what = "neither a job, a record, a table, a workbook nor a digital certificate",
                .rule = "gumcert audit reads jobs and records (JSON), tables (CSV), workbooks (.xlsx) and digital "
                        "certificates (XML)",
                .action = "store an old workbook (.xls) as .xlsx, copy the table of a PDF into a CSV file"});
    }
    audited.report = audit::audit(std::move(subject), audit::all_rules());
    return audited;
}

}  // namespace

AuditedFile audit_file(const fs::path& file, unsigned threads, const fs::path& templates, const gum::Progress& progress,
                       std::span<const certificate::Waiver> waivers, const fs::path& laboratory) {
    AuditedFile audited = audited_as_it_is(file, threads, templates, progress, laboratory, {});
    audit::accept_findings(audited.report, waivers, audit::all_rules());
    return audited;
}

std::string AuditAttempt::reason() const {
    try {
        std::rethrow_exception(failure);
    } catch (const gum::DiagnosedError& error) {
        const std::size_t more = error.diagnostics().size() - 1;
        return gum::message(error.diagnostics().front()) +
               (more == 0 ? "" : " (and " + std::to_string(more) + " more)");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        return error.what();
    }
}

std::vector<AuditAttempt> audit_files(const std::vector<FileToAudit>& files, unsigned threads,
                                      const fs::path& templates, const gum::Progress& progress,
                                      std::span<const certificate::Waiver> waivers, const fs::path& laboratory,
                                      const AuditWalls& walls) {
    std::vector<AuditAttempt> attempts(files.size());
    std::vector<std::vector<bool>> taken(files.size());  // waivers, of each file
    std::vector<std::size_t> tables, others;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string ending = text::in_small_letters(files[i].file.extension().string());
        (ending == ".csv" || ending == ".xlsx" || ending == ".xlsm" ? tables : others).push_back(i);
    }
    const auto attempt = [&](std::size_t file, const gum::Progress& told) {
        try {
            AuditedFile audited = audited_as_it_is(files[file].file, threads, templates, told, laboratory, walls);
            taken[file] = audit::take_waivers(audited.report, waivers, audit::all_rules());
            attempts[file].has_critical = audited.report.has_critical();
            attempts[file].view = reports::make_file_view(audited.report, audit::all_rules(), audited.digest);
            if (!files[file].name.empty()) {
                attempts[file].view->name = reports::printable(files[file].name);
            }
        } catch (...) {
            attempts[file].failure = std::current_exception();
        }
    };
    std::vector<fs::path> read;
    for (const std::size_t table : tables) {
        read.push_back(files[table].file);
    }
    read_within(walls, read,
                [&] { run_in_workers(threads, tables.size(), [&](std::size_t task) { attempt(tables[task], {}); }); });
    for (const std::size_t file : others) {
        attempt(file, progress);
    }
    std::vector<bool> taken_by_any(waivers.size(), false);
    for (const std::vector<bool>& of_file : taken) {
        for (std::size_t i = 0; i < of_file.size(); ++i) {
            taken_by_any[i] = taken_by_any[i] || of_file[i];
        }
    }
    const auto first =
        std::find_if(attempts.begin(), attempts.end(), [](const AuditAttempt& one) { return one.view.has_value(); });
    if (first != attempts.end()) {
        for (const audit::Sentence& sentence : audit::unused_waivers(waivers, taken_by_any)) {
            reports::add_not_read(*first->view, sentence);
        }
    }
    return attempts;
}

void run_in_workers(unsigned threads, std::size_t tasks, const std::function<void(std::size_t)>& task) {
    gum::WorkerThreads workers(threads);
    workers.run(tasks, [&task](unsigned, std::size_t one) { task(one); });
}

}  // namespace gumcert::evaluation
