#include "app/cli/audit_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "app/cli/terminal/interruption.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "audit/rules/registry.h"
#include "evaluation/audit_evaluation.h"
#include "evaluation/audit_files.h"
#include "evaluation/limits.h"
#include "evaluation/name_job.h"
#include "outputs/kept_files.h"
#include "outputs/output_files.h"
#include "reports/audit/audit_form.h"
#include "reports/audit/audit_view.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/pdf_worker.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

/// Which forms go where.
struct Destination {
    std::vector<std::pair<const reports::AuditForm*, fs::path>> files;
    const reports::AuditForm* to_stdout = nullptr;
};

/// A name with an ending that the form has is a file; any other is a folder, which gets the form that is asked for, or
/// all of them.
Destination destination_of(const AuditOptions& options, const fs::path& first) {
    const reports::AuditForm* const asked = options.format.empty() ? nullptr : &reports::audit_form(options.format);
    Destination to;
    if (options.output.empty() || options.output == "-") {
        if (asked != nullptr && asked->needs_file && options.output.empty()) {
            fs::path beside = first.has_filename() ? first : first.parent_path();
            beside.replace_extension();
            beside += "-audit." + options.format;
            to.files.emplace_back(asked, std::move(beside));
        } else {
            to.to_stdout = asked != nullptr ? asked : &reports::audit_form("text");
        }
        return to;
    }
    const fs::path output(options.output);
    const reports::AuditForm* const by_ending = reports::audit_form_of(output.filename().string());
    if (by_ending != nullptr || (output.has_extension() && asked != nullptr && !fs::is_directory(output))) {
        to.files.emplace_back(asked != nullptr ? asked : by_ending, output);
        return to;
    }
    for (const reports::AuditForm& form : reports::audit_forms()) {
        if (asked == nullptr || asked == &form) {
            to.files.emplace_back(&form, output / form.file);
        }
    }
    return to;
}

/// The audit for programs, which can always be made and is kept where another form cannot.
fs::path numbers_file(const Destination& to) {
    return fs::path(to.files.front().second).replace_extension(".json");
}

}  // namespace

ExitCode audit_files(const std::vector<std::string>& files, const AuditOptions& options, const CommonOptions& common) {
    const std::vector<fs::path> named(files.begin(), files.end());
    const evaluation::FilesToAudit files_to_audit = evaluation::files_to_audit(named, options.laboratory);
    std::vector<fs::path> all;
    std::vector<reports::UnauditedFile> unaudited;
    for (const evaluation::FileToAudit& one : files_to_audit.files) {
        all.push_back(one.file);
        for (const fs::path& job : one.jobs) {
            all.push_back(job);
            unaudited.push_back(
                {.kind = reports::UnauditedFile::Kind::in_record, .file = job.string(), .because = one.file.string()});
            print_message({.code = "GC-AUDIT-0013",
                           .where = job.string(),
                           .what = "has no audit of its own: " + one.file.string() + " was made of it",
                           .rule = "a record is audited with its job, which is evaluated again and held against it",
                           .action = "name the job itself to see it alone",
                           .severity = gum::Severity::note},
                          common);
        }
    }
    for (const fs::path& file : files_to_audit.of_other_kinds) {
        unaudited.push_back({.kind = reports::UnauditedFile::Kind::other_kind, .file = file.string()});
    }
    const Destination to = destination_of(options, named.front());
    std::vector<fs::path> outputs;
    for (const auto& [form, file] : to.files) {
        outputs::require_writable(file);
        outputs.push_back(file);
    }
    if (!to.files.empty()) {
        outputs.push_back(outputs::kept_place(numbers_file(to)));
    }
    outputs::require_not_inputs(outputs, all);
    const outputs::OutputsAtStart at_start = begin_outputs(outputs, common);
    if (std::ranges::any_of(to.files, [](const auto& file) { return file.first->name == "pdf"; })) {
        reports::PdfWorker(render_assets(options.share)).require_ready();  // before anything is evaluated
    }
    const fs::path templates = templates_folder(options.share);
    const std::vector<certificate::Waiver> waivers =
        options.waivers.empty() ? std::vector<certificate::Waiver>{} : evaluation::waivers_from(options.waivers);
    ExitCode code = done;
    std::vector<reports::AuditedFileView> views;
    views.reserve(files_to_audit.files.size());
    ProgressLine progress(!common.quiet);
    std::vector<evaluation::AuditAttempt> attempts = evaluation::audit_files(
        files_to_audit.files, static_cast<unsigned>(common.threads), templates,
        [&](const std::string& text) { progress(text); }, waivers, options.laboratory,
        {.of_evaluation =
             [&](const fs::path& file, const gum::Progress& told,
                 const std::function<void(const gum::Progress&)>& work) {
                 const std::string name = text::one_line(file.string());
                 // A Monte Carlo tells of its progress and ends alone, so that one file does not end the audit of all. What
                 // tells of none ends the command, later.
                 evaluation::Walls walls = evaluation::walls_of_evaluation({file});
                 walls.time *= 2;
                 work_within_walls(common, walls, "for the evaluation of " + name,
                                   [&] { work(progress_within_walls(common, name, told, {file})); });
             },
         .of_reading = [&](const std::vector<fs::path>& read,
                           const std::function<void()>& work) { work_within_walls(common, read, work); }});
    for (std::size_t i = 0; i < attempts.size(); ++i) {
        evaluation::AuditAttempt& attempt = attempts[i];
        const ExitCode one = explained(common, [&] {
            if (attempt.failure) {
                unaudited.push_back({.file = files_to_audit.files[i].file.string(), .because = attempt.reason()});
                evaluation::naming_job(files_to_audit.files[i].file, files_to_audit.files.size() > 1,
                                       [&] { std::rethrow_exception(attempt.failure); });
            }
            views.push_back(std::move(*attempt.view));
            return attempt.has_critical ? negative_answer : done;
        });
        code = std::max(code, one);
    }
    progress.clear();
    if (views.empty()) {
        return code;
    }
    const reports::AuditWriting with{.rules = audit::all_rules(),
                                     .run =
                                         [&common](std::size_t n, const std::function<void(std::size_t)>& task) {
                                             evaluation::run_in_workers(static_cast<unsigned>(common.threads), n, task);
                                         },
                                     .assets =
                                         [&options] {
                                             return render_assets(options.share, options.languages.empty()
                                                                                     ? std::vector<std::string>{"en"}
                                                                                     : options.languages);
                                         },
                                     .verbose = options.verbose};
    const reports::AuditView view = evaluation::audit_view(std::move(views), std::move(unaudited));
    if (to.to_stdout != nullptr) {
        write_to_stdout(to.to_stdout->write(view, with));
        return code;
    }
    std::vector<fs::path> inputs = all;
    if (!options.waivers.empty()) {
        inputs.emplace_back(options.waivers);
    }
    add_program_files(inputs, options.share);
    std::vector<outputs::OutputFile> written;
    outputs::make_or_keep(
        [&] {
            for (const auto& [form, file] : to.files) {
                written.push_back({.path = file, .bytes = form->write(view, with)});
            }
        },
        [&] {
            keep_files({{numbers_file(to), reports::audit_form("json").write(view, with)}}, inputs, at_start,
                       "is this audit for programs", "ask for another form: --format html or text", common);
        });
    write_outputs(written, inputs, at_start);
    report_kept(numbers_file(to), common);
    if (!common.quiet) {
        for (const outputs::OutputFile& file : written) {
            print_to_stdout("Written: {}\n", text::one_line(file.path.string()));
        }
    }
    return code;
}

}  // namespace gumcert::cli
