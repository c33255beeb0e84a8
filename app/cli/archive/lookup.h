#pragma once

#include "app/cli/archive/archive_command.h"

/// Actions that show what is in an archive: list, show, statistics.
namespace gumcert::cli {

ExitCode list_certificates(const ArchiveOptions& options, const CommonOptions& common);
ExitCode show_certificate(const ArchiveOptions& options, const CommonOptions& common);
ExitCode show_statistics(const ArchiveOptions& options, const CommonOptions& common);

}  // namespace gumcert::cli
