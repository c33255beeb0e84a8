#include "app/cli/archive/lookup.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/cli/archive/action.h"
#include "app/cli/terminal/terminal.h"
#include "archive/archive.h"
#include "archive/certificates/archive_statistics.h"
#include "archive/log_texts.h"

namespace gumcert::cli {

ExitCode list_certificates(const ArchiveOptions& options, const CommonOptions& /*common*/) {
    const auto store = opened(options, archive::Access::read_only);
    const std::vector<archive::ListedCertificate> certificates =
        archive::with_words(archive::Archive(*store).list(), options.named);
    if (as_json(options)) {
        print_json(archive::list_json(certificates));
    } else {
        write_to_stdout(archive::list_text(certificates));
    }
    return done;
}

ExitCode show_certificate(const ArchiveOptions& options, const CommonOptions& /*common*/) {
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    if (as_json(options)) {
        print_json(archive::history_json(archive, options.named.front()));
    } else {
        write_to_stdout(archive::history_text(archive, options.named.front()));
    }
    return done;
}

ExitCode show_statistics(const ArchiveOptions& options, const CommonOptions&) {
    const auto store = opened(options, archive::Access::read_only);
    archive::Archive archive(*store);
    const archive::ArchiveStatistics statistics = archive::statistics_of(archive);
    write_to_stdout(as_json(options) ? archive::statistics_json(statistics) : archive::statistics_text(statistics));
    return done;
}

}  // namespace gumcert::cli
