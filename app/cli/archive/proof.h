#pragma once

#include "app/cli/archive/archive_command.h"

/// Actions for those who do not rely on the keeper of an archive: export, head, verify.
namespace gumcert::cli {

ExitCode export_certificate(const ArchiveOptions& options, const CommonOptions& common);
ExitCode write_head(const ArchiveOptions& options, const CommonOptions& common);
ExitCode verify_archive(const ArchiveOptions& options, const CommonOptions& common);

}  // namespace gumcert::cli
