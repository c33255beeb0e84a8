#pragma once

#include "app/cli/archive/archive_command.h"

/// Actions that make, settle and copy a whole archive: init, settings, backup, migrate.
namespace gumcert::cli {

ExitCode init_archive(const ArchiveOptions& options, const CommonOptions& common);
ExitCode change_settings(const ArchiveOptions& options, const CommonOptions& common);
ExitCode back_up(const ArchiveOptions& options, const CommonOptions& common);
ExitCode migrate(const ArchiveOptions& options, const CommonOptions& common);

}  // namespace gumcert::cli
