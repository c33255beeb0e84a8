#pragma once

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/cli/archive/archive_command.h"
#include "app/cli/terminal/interruption.h"
#include "archive/archive.h"
#include "archive/store/store.h"
#include "gum/quantity/diagnostic.h"
#include "text/visible_text.h"

/// What the actions of `gumcert archive` have in common: asking for an entry, and telling what came of it.
namespace gumcert::cli {

/// Who asks for an entry, when and why.
[[nodiscard]] archive::Request request_of(const ArchiveOptions& options);

/// The archive of --store.
[[nodiscard]] std::unique_ptr<archive::Store> opened(const ArchiveOptions& options, archive::Access access);

/// --format json
[[nodiscard]] bool as_json(const ArchiveOptions& options);
void print_json(const nlohmann::json& value);

/// "0.1.0 (commit …)", as archives and workers note it.
[[nodiscard]] std::string program_name();

/// Carries out a request for an entry: a signal that comes meanwhile says whether it is in the log.
template <class Work>
archive::Written carried_out(const Work& work) {
    EntryUnderWay under_way;
    archive::Written written = work();
    under_way.is_in_the_log(fmt::format("{}{}{}, entry {}", text::one_line(written.entry.certificate),
                                        written.entry.certificate.empty() ? "" : " ", written.entry.kind,
                                        written.entry.seq));
    return written;
}

/// The outcome of an action that writes an entry.
ExitCode told(const archive::Written& written, const ArchiveOptions& options, const CommonOptions& common);

void print_findings(const std::vector<gum::Diagnostic>& findings, const CommonOptions& common);

}  // namespace gumcert::cli
