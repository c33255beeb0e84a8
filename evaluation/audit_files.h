#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "gum/quantity/progress.h"
#include "reports/audit/audit_view.h"

namespace gumcert::evaluation {

/// A file of an audit, and what was found in it.
struct AuditedFile {
    std::filesystem::path file;
    std::string digest;  ///< SHA-256 of its bytes
    audit::AuditReport report;
};

/// Waivers from a file (docs/audit.md).
/// \throws gum::InputError    what the reader refuses; GC-AUDIT-0012 a waiver that names nobody or gives no reason
/// \throws gum::StorageError
[[nodiscard]] std::vector<certificate::Waiver> waivers_from(const std::filesystem::path& file);

/// A file that an audit looks at.
struct FileToAudit {
    std::filesystem::path file;
    /// Of a record: jobs of the same folder that it was made of, byte for byte. The record is held against its own job,
    /// so that they need no audit of their own.
    std::vector<std::filesystem::path> jobs = {};
    /// What documents call it. Of a folder: with the folders that lead to it, from where the audit was asked for, or from the
    /// named folder where that is absolute. Of a file that is named: its own name, and its path where another file has that.
    std::string name = {};
};

/// What an audit looks at, and what it passes over.
struct FilesToAudit {
    std::vector<FileToAudit> files;
    std::vector<std::filesystem::path> of_other_kinds;  ///< of a folder, sorted: nothing that an audit reads
};

/// The files that are named, and all of those folders that are, before any of them is read.
[[nodiscard]] std::vector<std::filesystem::path> files_in(const std::vector<std::filesystem::path>& named);

/// The files that an audit looks at: the named ones, and of a folder all of its files and folders whose endings the audit
/// knows (.json, .csv, .xlsx, .xlsm, .xml), sorted by name; a PDF where a digital certificate is attached that does not
/// lie beside it. Of a job of a folder and a record that was made of it, by this program and of the same bytes of all
/// files, the record.
/// \param laboratory  as of evaluate_job()
/// \throws gum::InputError    GC-AUDIT-0010 a folder without such a file
/// \throws gum::StorageError  what cannot be looked at
[[nodiscard]] FilesToAudit files_to_audit(const std::vector<std::filesystem::path>& named,
                                          const std::filesystem::path& laboratory = {});

/// Audits one file, whatever it is: a job is evaluated first, a record taken as it states itself and held against its own
/// job, a table (CSV) or workbook (.xlsx) read and its formulas evaluated, a digital certificate read.
/// \param waivers     of findings of every file, beside those of a job or record itself
/// \param laboratory  as of evaluate_job()
/// \throws gum::InputError    what the readers refuse; GC-AUDIT-0011 a file of another kind
/// \throws gum::NoResultError, gum::StorageError
[[nodiscard]] AuditedFile audit_file(const std::filesystem::path& file, unsigned threads,
                                     const std::filesystem::path& templates, const gum::Progress& progress = {},
                                     std::span<const certificate::Waiver> waivers = {},
                                     const std::filesystem::path& laboratory = {});

/// What became of a file.
struct AuditAttempt {
    std::optional<reports::AuditedFileView> view;  ///< as documents of this program show it
    bool has_critical = false;                     ///< a critical finding that nobody accepts
    std::exception_ptr failure;                    ///< what audit_file() threw, where it is not audited

    /// Why it is not audited, for documents: the first refusal, and how many more there are.
    [[nodiscard]] std::string reason() const;
};

/// Who keeps the work on files of others within walls: each may do the work with walls around it, which may end the process.
/// Empty: there are none.
struct AuditWalls {
    /// Around the evaluation of a job or record, which says itself how long it takes. What it tells its progress to may end
    /// it alone, by a throw; `told` is told of the progress of all files.
    std::function<void(const std::filesystem::path& file, const gum::Progress& told,
                       const std::function<void(const gum::Progress&)>& work)>
        of_evaluation;
    /// Around the reading of all tables and workbooks, and of each certificate.
    std::function<void(const std::vector<std::filesystem::path>& files, const std::function<void()>& work)> of_reading;
};

/// audit_file() of each of them, in their order. Tables and workbooks are audited side by side, jobs and records one after
/// the other, which use all threads themselves; results are the same for any number of threads. Of thousands of files only
/// what is shown of them is kept. A waiver that fits no finding of any file is told with the first one that is audited.
[[nodiscard]] std::vector<AuditAttempt> audit_files(const std::vector<FileToAudit>& files, unsigned threads,
                                                    const std::filesystem::path& templates,
                                                    const gum::Progress& progress = {},
                                                    std::span<const certificate::Waiver> waivers = {},
                                                    const std::filesystem::path& laboratory = {},
                                                    const AuditWalls& walls = {});

/// Does tasks 0 … n − 1 on some threads (0: as many as the machine has), and throws what the first of them throws.
void run_in_workers(unsigned threads, std::size_t tasks, const std::function<void(std::size_t)>& task);

}  // namespace gumcert::evaluation
