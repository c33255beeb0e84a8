#pragma once

#include "app/cli/archive/archive_command.h"

/// Actions that write an entry in the life of a certificate: number, add, amend, review, authorise, issue, withdraw.
namespace gumcert::cli {

ExitCode take_number(const ArchiveOptions& options, const CommonOptions& common);
ExitCode add_certificate(const ArchiveOptions& options, const CommonOptions& common);
ExitCode amend_certificate(const ArchiveOptions& options, const CommonOptions& common);
ExitCode review_certificate(const ArchiveOptions& options, const CommonOptions& common);
ExitCode authorise_certificate(const ArchiveOptions& options, const CommonOptions& common);
ExitCode issue_certificate(const ArchiveOptions& options, const CommonOptions& common);
ExitCode withdraw_certificate(const ArchiveOptions& options, const CommonOptions& common);

}  // namespace gumcert::cli
