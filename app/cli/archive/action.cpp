#include "app/cli/archive/action.h"

#include <gumcert_build_info.h>

#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/terminal.h"
#include "archive/store/open_store.h"
#include "encoding/sha2.h"

namespace gumcert::cli {

using nlohmann::json;

archive::Request request_of(const ArchiveOptions& options) {
    return {.actor = options.by,
            .at = time_now(),
            .request_key = options.request_key,
            .why = options.why,
            .confirmed_day = options.today};
}

std::unique_ptr<archive::Store> opened(const ArchiveOptions& options, archive::Access access) {
    return archive::open_store(options.store, access);
}

bool as_json(const ArchiveOptions& options) {
    return options.format == "json";
}

void print_json(const json& value) {
    write_to_stdout(value.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

std::string program_name() {
    return fmt::format("{} (commit {})", k_version, k_commit);
}

ExitCode told(const archive::Written& written, const ArchiveOptions& options, const CommonOptions& common) {
    const archive::LogEntry& entry = written.entry;
    if (as_json(options)) {
        print_json({{"seq", entry.seq},
                    {"at", entry.at},
                    {"kind", entry.kind},
                    {"certificate", entry.certificate},
                    {"hash", encoding::hexadecimal(entry.hash)},
                    {"repeated", written.repeated}});
    } else if (!common.quiet) {
        print_to_stdout("{}{}{}: entry {}, {}{}\n", text::one_line(entry.certificate),
                        entry.certificate.empty() ? "" : " ", entry.kind, entry.seq, entry.at,
                        written.repeated ? " (asked for before, with the same key)" : "");
    }
    return done;
}

void print_findings(const std::vector<gum::Diagnostic>& findings, const CommonOptions& common) {
    for (const gum::Diagnostic& one : findings) {
        print_message(one, common);
    }
}

}  // namespace gumcert::cli
