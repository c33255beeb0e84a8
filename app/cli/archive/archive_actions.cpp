// The names of the actions, apart from what they do: help, manual and completion need no archive.
#include "app/cli/archive/archive_command.h"

namespace gumcert::cli {

std::vector<std::string> archive_actions() {
    return {"init",   "settings", "number", "add",    "review",     "authorise", "issue",
            "amend",  "withdraw", "list",   "show",   "export",     "head",      "verify",
            "backup", "migrate",  "replay", "worker", "statistics", "affected"};
}

}  // namespace gumcert::cli
