#pragma once

#include <string>
#include <vector>

#include "app/cli/terminal/terminal.h"

namespace gumcert::cli {

/// What `gumcert archive` may be told beside its action.
struct ArchiveOptions {
    std::string action;              ///< "init", "add" …
    std::vector<std::string> named;  ///< numbers of certificates, or files
    std::string store, to, by, why, request_key, format, output, numbering, sign, trust, share;
    std::string today;                                  ///< the day, by who asks for an entry
    std::string amend;                                  ///< of number: the certificate that is amended
    std::string source, since, until, register_folder;  ///< of affected
    std::vector<std::string> heads, persons;
    bool one_pair_of_eyes = false;
    bool shared = false;  ///< of affected and replay: with all workers of the archive
    bool wait = false;    ///< of worker: for work that is not there yet
};

/// The actions, in the order of --help.
[[nodiscard]] std::vector<std::string> archive_actions();

/// `gumcert archive ACTION …`: certificates and their evidence, in a store that only grows.
[[nodiscard]] ExitCode use_archive(const ArchiveOptions& options, const CommonOptions& common);

}  // namespace gumcert::cli
