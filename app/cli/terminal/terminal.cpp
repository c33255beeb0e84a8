#include "app/cli/terminal/terminal.h"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>

#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/interruption.h"
#include "archive/store/open_store.h"
#include "outputs/refusal_log.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace {

/// Words of the command line stand in messages: an address that was given in place of a file has its password in it.
gum::Diagnostic without_passwords(gum::Diagnostic diagnostic) {
    for (std::string* const text : {&diagnostic.where, &diagnostic.what, &diagnostic.action}) {
        archive::hide_passwords(*text);
    }
    return diagnostic;
}

}  // namespace

void print_message(const gum::Diagnostic& found, const CommonOptions& common) {
    const gum::Diagnostic diagnostic = without_passwords(found);
    if (common.json_messages) {
        const char* const severities[] = {"note", "warning", "error"};
        const nlohmann::json line{
            {"code", diagnostic.code},     {"where", diagnostic.where},
            {"what", diagnostic.what},     {"rule", diagnostic.rule},
            {"action", diagnostic.action}, {"severity", severities[static_cast<int>(diagnostic.severity)]}};
        print_to_stderr("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
        const char* const prefix = diagnostic.severity == gum::Severity::error     ? ""
                                   : diagnostic.severity == gum::Severity::warning ? "warning: "
                                                                                   : "note: ";
        std::string text = gum::message(diagnostic);
        for (char& character : text) {
            // A name from the command line may hold a line feed; a message is one line.
            character = static_cast<unsigned char>(character) < 0x20 ? ' ' : character;
        }
        print_to_stderr("{}{} [{}]\n", prefix, text::one_line(text), diagnostic.code);
    }
}

void log_refusal(const gum::Diagnostic& found, const CommonOptions& common) {
    if (common.refusal_log.empty()) {
        return;
    }
    const gum::Diagnostic why = without_passwords(found);
    const std::string failure =
        outputs::append_refusal(common.refusal_log, {time_now(), common.command, why.code, why.where});
    if (!failure.empty()) {
        print_message({.code = "GC-STORE-0025",
                       .where = common.refusal_log,
                       .what = "the refusal cannot be logged: " + failure,
                       .rule = "a log of refusals is a file of its own that can be written to",
                       .action = "name a new file by --refusal-log",
                       .severity = gum::Severity::warning},
                      common);
    }
}

void print_messages(std::span<const gum::Diagnostic> diagnostics, const CommonOptions& common) {
    for (const gum::Diagnostic& diagnostic : diagnostics) {
        if (!common.quiet || diagnostic.severity != gum::Severity::note) {
            print_message(diagnostic, common);
        }
    }
}

namespace {

ExitCode told(const gum::DiagnosedError& error, const CommonOptions& common, ExitCode code) {
    for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
        print_message(diagnostic, common);
        log_refusal(diagnostic, common);
    }
    return code;
}

/// Whatever is thrown after memory has ended may follow from that, and not from a file.
ExitCode with_memory(const std::function<ExitCode()>& work) {
    try {
        return work();
    } catch (const std::exception&) {
        system::require_memory();
        throw;
    }
}

}  // namespace

ExitCode tell_of_no_memory(bool json_messages) {
    std::fputs(json_messages
                   ? "{\"action\":\"close other programs, or split the job\",\"code\":\"GC-STORE-0020\",\"rule\":\"an "
                     "evaluation needs its memory whole\",\"severity\":\"error\",\"what\":\"out of memory\",\"where\":"
                     "\"gumcert\"}\n"
                   : "gumcert — out of memory — an evaluation needs its memory whole — close other programs, or split "
                     "the job [GC-STORE-0020]\n",
               stderr);
    return storage_trouble;
}

ExitCode explained(const CommonOptions& common, const std::function<ExitCode()>& work) {
    try {
        return with_memory(work);
    } catch (const gum::UsageError& error) {
        return told(error, common, usage);
    } catch (const gum::InputError& error) {
        return told(error, common, input_refused);
    } catch (const gum::NoResultError& error) {
        return told(error, common, no_result);
    } catch (const gum::StorageError& error) {
        return told(error, common, storage_trouble);
    } catch (const std::bad_alloc&) {
        return tell_of_no_memory(common.json_messages);
    } catch (const std::filesystem::filesystem_error& error) {
        // A name that the system does not take, a folder that vanished: trouble with files, wherever it arose.
        return told(gum::StorageError(gum::Diagnostic{.code = "GC-STORE-0006",
                                                      .where = error.path1().string(),
                                                      .what = error.code().message(),
                                                      .rule = "files and folders of a command can be read and written",
                                                      .action = "check the name and the access rights"}),
                    common, storage_trouble);
    } catch (const std::exception& error) {
        const gum::Diagnostic why{.code = "GC-DEFECT-0001",
                                  .where = "gumcert",
                                  .what = error.what(),
                                  .rule = "this is a defect in the program",
                                  .action = "please report it with the job"};
        print_message(why, common);
        log_refusal(why, common);
        return defect;
    }
}

ProgressLine::ProgressLine(bool wanted) : wanted_(wanted && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::operator()(const std::string& text) {
    tell_stage(text);
    const auto elapsed = std::chrono::steady_clock::now() - start_;
    if (!wanted_ || elapsed < std::chrono::seconds(1)) {
        return;
    }
    print_to_stderr("\r\033[Kgumcert: {}", text);
    std::fflush(stderr);
    shown_ = true;
}

void ProgressLine::clear() {
    if (shown_) {
        print_to_stderr("\r\033[K");
        shown_ = false;
    }
}

void report_diagnostics(const reports::EvaluationRecord& record, const CommonOptions& common) {
    print_messages(record.diagnostics, common);
}

namespace {

struct SeverityText {
    const char* code;
    const char* word;
    gum::Severity severity;
};

SeverityText text_of(certificate::FindingSeverity severity) {
    switch (severity) {
        case certificate::FindingSeverity::critical:
            return {"GC-CERT-0313", "critical", gum::Severity::error};
        case certificate::FindingSeverity::major:
            return {"GC-CERT-0312", "major", gum::Severity::warning};
        case certificate::FindingSeverity::minor:
            return {"GC-CERT-0311", "minor", gum::Severity::warning};
        case certificate::FindingSeverity::information:
            break;
    }
    return {"GC-CERT-0310", "information", gum::Severity::note};
}

}  // namespace

void report_findings(const reports::EvaluationRecord& record, const CommonOptions& common) {
    if (!record.certificate) {
        return;
    }
    for (const certificate::Finding& finding : record.certificate->findings) {
        const SeverityText text = text_of(finding.severity);
        if (text.severity != gum::Severity::note || !common.quiet) {
            print_message({.code = text.code,
                           .where = "finding " + finding.id + ", " + finding.where,
                           .what = std::string(text.word) + ": " + finding.what,
                           .rule = finding.clause,
                           .action = finding.action,
                           .severity = text.severity},
                          common);
        }
    }
}

namespace {

gum::Diagnostic lost_output(const char* action) {
    return {.code = "GC-STORE-0003",
            .where = "standard output",
            .what = "cannot be written",
            .rule = "all of the output must arrive",
            .action = action};
}

}  // namespace

void write_to_stdout(const std::string& bytes) {
    system::require_memory();
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
        throw gum::StorageError(lost_output("write to a file with -o FILE"));
    }
}

ExitCode when_all_is_told(ExitCode code, const CommonOptions& common) {
    const bool arrived = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (arrived || code >= storage_trouble) {
        return code;
    }
    const gum::Diagnostic why =
        lost_output("see where the output goes; files and entries of an archive that were written are whole");
    print_message(why, common);
    log_refusal(why, common);
    return storage_trouble;
}

}  // namespace gumcert::cli
