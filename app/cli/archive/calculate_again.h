#pragma once

#include "app/cli/archive/archive_command.h"

/// Actions that calculate archived records again: replay, affected, and worker, which does it for others.
namespace gumcert::cli {

ExitCode replay(const ArchiveOptions& options, const CommonOptions& common);
ExitCode find_affected(const ArchiveOptions& options, const CommonOptions& common);
ExitCode work_for_others(const ArchiveOptions& options, const CommonOptions& common);

}  // namespace gumcert::cli
