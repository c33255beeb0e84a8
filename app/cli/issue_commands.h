#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// Options of the commands that make documents.
struct DocumentOptions {
    std::string output;                  ///< -o
    std::string share;                   ///< --share
    std::vector<std::string> languages;  ///< --language
    bool draft = false;                  ///< --draft
    std::string laboratory;              ///< --laboratory
    std::string signer;                  ///< --sign: signer description; "" = not signed
    std::string superseded_by;           ///< --superseded-by: record of the later certificate; "" = none
    std::string head;                    ///< --head: head of an archive that documents print; "" = none
    std::string check_at;                ///< --check-at: where it can be checked, for the reader
    std::string covariance = "auto";     ///< --covariance: a word of reports::covariance_form()
};

/// `gumcert run`: evaluates jobs and writes record, covariance and documents of each.
[[nodiscard]] ExitCode run_jobs(const std::vector<std::string>& jobs, const DocumentOptions& options,
                                const CommonOptions& common);

/// `gumcert evaluate`: the record only.
[[nodiscard]] ExitCode evaluate_to_record(const std::filesystem::path& job, const DocumentOptions& options,
                                          const CommonOptions& common);

/// `gumcert compare`: the same for a job of kind comparison, and for no other.
[[nodiscard]] ExitCode compare_to_record(const std::filesystem::path& job, const DocumentOptions& options,
                                         const CommonOptions& common);

/// `gumcert render`: one form of the document of each record.
[[nodiscard]] ExitCode render_records(const std::vector<std::string>& records, const std::string& format,
                                      const DocumentOptions& options, const CommonOptions& common);

}  // namespace gumcert::cli
