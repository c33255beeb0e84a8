// The program `gumcert`: reads the command line, calls a use case, turns failures into messages and exit codes.
#include <fmt/core.h>
#include <gumcert_build_info.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/archive/archive_command.h"
#include "app/cli/audit_command.h"
#include "app/cli/certificate_commands.h"
#include "app/cli/command_line.h"
#include "app/cli/explain_command.h"
#include "app/cli/fonts_command.h"
#include "app/cli/init_command.h"
#include "app/cli/issue_commands.h"
#include "app/cli/laboratory_command.h"
#include "app/cli/rerun_command.h"
#include "app/cli/self_test_command.h"
#include "app/cli/study_commands.h"
#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/share_folder.h"
#include "app/cli/terminal/terminal.h"
#include "archive/store/open_store.h"
#include "encoding/openssl_configuration.h"
#include "evaluation/audit_files.h"
#include "evaluation/limits.h"
#include "system/end_of_memory.h"

namespace {

using namespace gumcert;       // NOLINT(google-build-using-namespace): one program, one file
using namespace gumcert::cli;  // NOLINT(google-build-using-namespace)

std::string version_text() {
    return fmt::format("gumcert {}\ncommit {}\nsha256 {}", k_version, k_commit, executable_digest());
}

/// Commands that read files of others, and nothing else that takes long, have walls of their own.
CommonOptions with_walls_of_command(const Arguments& a) {
    if (a.command == "import") {
        return with_walls(a.common, {a.file});
    }
    const bool reads_certificates = a.command == "check" && !a.files.empty() && a.files.front() == "dcc";
    if (a.command == "audit") {
        const std::vector<std::filesystem::path> files = evaluation::files_in({a.files.begin(), a.files.end()});
        const bool evaluates = std::any_of(files.begin(), files.end(), [](const std::filesystem::path& file) {
            return file.extension() == ".json";  // a job or record, whose evaluation may take long
        });
        return evaluates ? a.common : with_walls(a.common, files);
    }
    if (a.command == "archive" && a.archive.action == "verify" && !a.archive.named.empty()) {  // of a customer
        std::vector<std::filesystem::path> files(a.archive.named.begin(), a.archive.named.end());
        files.insert(files.end(), a.archive.heads.begin(), a.archive.heads.end());
        return with_walls(a.common, files);
    }
    if (a.command == "rerun" ||
        (a.command == "check" && !reads_certificates)) {  // records, each with a time of its own
        CommonOptions common = a.common;
        const std::vector<std::string>& read = a.command == "rerun" ? a.records : a.files;
        common.memory_limit =
            common.memory_limit.value_or(evaluation::walls_of_evaluation({read.begin(), read.end()}).memory);
        return common;
    }
    return a.command == "verify" || reads_certificates ? with_walls(a.common, {a.files.begin(), a.files.end()})
                                                       : a.common;
}

ExitCode dispatch(int argc, char** argv, Arguments& a) {
    try {
        const std::optional<ExitCode> ended = read_command_line(argc, argv, version_text, a);
        for (char* const word : std::span(argv, static_cast<std::size_t>(argc))) {
            archive::hide_passwords({word, std::strlen(word)});
        }
        if (ended) {
            return *ended;
        }
    } catch (const std::invalid_argument& wrong) {
        std::string said = wrong.what();  // with words of the command line
        archive::hide_passwords(said);
        refuse_usage("command line", said, "see gumcert --help", "correct the command");
    }
    keep_ceilings(with_walls_of_command(a));
    if (a.documents.languages.size() > 2) {
        refuse_usage("--language", "more than two languages", "a document is printed in one language or in two",
                     "name the binding language first, and at most one more");
    }
    if (a.command == "run") {
        return run_jobs(a.jobs, a.documents, a.common);
    }
    if (a.command == "evaluate") {
        return evaluate_to_record(a.job, a.documents, a.common);
    }
    if (a.command == "compare") {
        return compare_to_record(a.job, a.documents, a.common);
    }
    if (a.command == "render") {
        return render_records(a.records, a.format, a.documents, a.common);
    }
    if (a.command == "import") {
        return import_certificate(a.file, a.output, a.standard, a.trust_store, a.common);
    }
    if (a.command == "check") {
        const bool certificates = a.files.front() == "dcc";
        a.files.erase(a.files.begin(), a.files.begin() + (certificates ? 1 : 0));
        if (a.files.empty()) {
            refuse_usage("check dcc", "no file", "gumcert check dcc FILE", "name the digital certificates");
        }
        return check_files(a.files, certificates, a.trust_store, a.share, a.documents.laboratory, a.common);
    }
    if (a.command == "audit") {
        return audit_files(a.files, a.audit, a.common);
    }
    if (a.command == "verify") {
        return verify_files(a.files, a.trust_store, a.revocation_lists, a.common);
    }
    if (a.command == "archive") {
        return use_archive(a.archive, a.common);
    }
    if (a.command == "simulate") {
        return simulate(a.job, a.runs, a.seed, a.output, a.share, a.common);
    }
    if (a.command == "plan") {
        return plan(a.job, a.output, a.share, a.common);
    }
    if (a.command == "laboratory") {
        return show_laboratory(a.file, a.date, a.format);
    }
    if (a.command == "self-test") {
        return gumcert::cli::self_test(a.output, a.cases, a.language, a.share, a.common);
    }
    if (a.command == "rerun") {
        return rerun_records(a.records, a.format, a.share, a.common);
    }
    if (a.command == "init") {
        return init(a.method, a.folder, a.share, a.common);
    }
    if (a.command == "explain") {
        return explain(a.codes, a.share);
    }
    if (a.command == "limits") {
        return list_limits();
    }
    if (a.command == "fonts") {
        return list_fonts(a.share);
    }
    throw std::logic_error("a command that nothing does: " + a.command);
}

}  // namespace

int main(int argc, char** argv) {
#ifdef SIGXFSZ
    // Without the signal a write beyond the limit of file sizes fails like one to a full disk: reported and cleaned up.
    (void)std::signal(SIGXFSZ, SIG_IGN);
#endif
    system::prepare_for_end_of_memory();
    encoding::read_no_configuration_of_openssl();
    Arguments arguments;
    // Looked for before parsing: messages about a faulty command line, too, have the form that it asks for.
    arguments.common.json_messages = std::any_of(
        argv + 1, argv + argc, [](const char* word) { return std::string_view(word) == "--json-messages"; });
    if (const char* const log = std::getenv("GUMCERT_REFUSAL_LOG")) {
        arguments.common.refusal_log = log;
    }
    const ExitCode code = explained(arguments.common, [&] {
        clean_up_at_signals(arguments.common.json_messages);
        return dispatch(argc, argv, arguments);
    });
    return when_all_is_told(code, arguments.common);
}
