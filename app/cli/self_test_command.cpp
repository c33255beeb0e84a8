#include "app/cli/self_test_command.h"

#include <fmt/core.h>
#include <gumcert_build_info.h>
#include <gumcert_made_with.h>
#include <gumcert_templates.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "app/cli/terminal/clock.h"
#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "gum/quantity/diagnostic.h"
#include "outputs/output_files.h"
#include "reports/forms/pdf_worker.h"
#include "reports/forms/template_digest.h"
#include "reports/record/evaluation_record.h"
#include "self_test/case_texts.h"
#include "self_test/self_test.h"
#include "self_test/self_test_document.h"
#include "system/machine.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

/// One line a case; a case that fails is a message as well.
void tell(const self_test::CaseOutcome& outcome, const CommonOptions& common) {
    if (!common.quiet) {
        print_to_stdout("{}\n", self_test::case_line(outcome));
        (void)std::fflush(stdout);
    }
    if (!outcome.passes()) {
        print_message(self_test::failure_of(outcome), common);
    }
}

/// The files of the cases with these names.
std::vector<fs::path> chosen(const std::vector<fs::path>& files, const std::vector<std::string>& names) {
    std::vector<fs::path> result;
    for (const std::string& name : names) {
        const auto found =
            std::find_if(files.begin(), files.end(), [&name](const fs::path& file) { return file.stem() == name; });
        if (found == files.end()) {
            refuse_usage("--case " + name, "there is no such case", "a case is named as gumcert self-test lists it",
                         "correct the name");
        }
        result.push_back(*found);
    }
    return result;
}

/// The libraries of this process with SHA-256 of their files; then those that are compiled in.
std::vector<self_test::LibraryVersion> libraries_in_use() {
    std::vector<self_test::LibraryVersion> libraries;
    for (const system::LoadedLibrary& loaded : system::loaded_libraries()) {
        libraries.push_back(
            {.name = loaded.name, .version = loaded.version, .sha256 = digest_of_program_file(loaded.file)});
    }
    for (const auto& [name, version] : k_compiled_in) {
        libraries.push_back({.name = std::string(name), .version = std::string(version), .sha256 = {}});
    }
    return libraries;
}

self_test::TestedSystem tested_system(const fs::path& templates, const std::string& cases_digest) {
    self_test::TestedSystem system{.date = time_now(),
                                   .name = reports::Software().name,
                                   .version = std::string(k_version),
                                   .commit = std::string(k_commit),
                                   .compiler = std::string(k_compiler),
                                   .executable_sha256 = executable_digest(),
                                   .processor = system::processor(),
                                   .operating_system = system::operating_system(),
                                   .libraries = libraries_in_use(),
                                   .templates_sha256 = reports::template_digest(templates)};
    system.templates_of_release = system.templates_sha256 == k_template_digest;
    system.cases_of_release = cases_digest == k_reference_case_digest;
    return system;
}

/// The families that a PDF can be set in, each once.
std::vector<std::string> font_families(const reports::RenderAssets& assets) {
    std::vector<std::string> families;
    reports::PdfWorker worker(assets);
    for (const reports::TemplateFont& font : worker.fonts()) {
        if (std::find(families.begin(), families.end(), font.family) == families.end()) {
            families.push_back(font.family);
        }
    }
    return families;
}

/// What only a machine with the PDF program has. Without it the report has its other forms, and it is told.
/// \return false where it failed
template <class Work>
bool tried(const fs::path& pdf, const CommonOptions& common, const Work& work) {
    std::vector<gum::Diagnostic> why;
    try {
        work();
        return true;
    } catch (const gum::StorageError& error) {
        why = error.diagnostics();
    } catch (const gum::NoResultError& error) {
        why = error.diagnostics();
    }
    for (gum::Diagnostic& one : why) {
        one.severity = gum::Severity::warning;
        print_message(one, common);
    }
    std::error_code error;
    print_message(
        {.code = "GC-SELF-0004",
         .where = pdf.string(),
         .what = fs::exists(pdf, error) ? "is not written; the file there is of an earlier test" : "is not written",
         .rule = "HTML and JSON say the same",
         .action = "mend what the message above says and repeat the test, or print the HTML",
         .severity = gum::Severity::warning},
        common);
    return false;
}

ExitCode run_some(const std::vector<fs::path>& files, const fs::path& templates, const CommonOptions& common) {
    const self_test::SelfTest test = self_test::run_self_test(
        files, static_cast<unsigned>(common.threads), templates, [&](const self_test::CaseOutcome& outcome) {
            tell(outcome, common);
            if (!common.quiet) {
                print_to_stdout("{}", self_test::value_lines(outcome));
            }
        });
    return test.passed() == test.cases.size() ? done : negative_answer;
}

}  // namespace

ExitCode self_test(const std::string& output, const std::vector<std::string>& cases, const std::string& language,
                   const std::string& share, const CommonOptions& common) {
    if (!cases.empty() && !(output.empty() && language.empty())) {
        refuse_usage(output.empty() ? "--language" : "--output", "beside --case",
                     "single cases are told on the terminal, and no report is written", "leave one of them out");
    }
    refuse_stdout("-o", output);
    const fs::path templates = templates_folder(share);
    const fs::path shipped = reference_cases_folder(share);
    const std::vector<fs::path> files = self_test::case_files(shipped);
    if (!cases.empty()) {
        return run_some(chosen(files, cases), templates, common);
    }
    const fs::path folder = output.empty() ? fs::path("gumcert-self-test-" + today()) : fs::path(output);
    std::vector<fs::path> inputs{shipped};
    add_program_files(inputs, share);
    const fs::path pdf = folder / "self-test.pdf";
    const std::vector<fs::path> outputs{folder / "self-test.json", folder / "self-test.html", pdf};
    for (const fs::path& file : outputs) {
        outputs::require_writable(file);
    }
    outputs::require_not_inputs(outputs, inputs);
    const outputs::OutputsAtStart at_start = begin_outputs(outputs, common);
    self_test::SelfTest test =
        self_test::run_self_test(files, static_cast<unsigned>(common.threads), templates,
                                 [&](const self_test::CaseOutcome& outcome) { tell(outcome, common); });
    ProgressLine progress(!common.quiet);
    progress("the report");
    const reports::RenderAssets assets = render_assets(share, {language.empty() ? "en" : language});
    test.system = tested_system(templates, test.cases_sha256);
    const bool has_pdf = tried(pdf, common, [&] { test.system.fonts = font_families(assets); });
    const std::string json = self_test::self_test_json(test);
    const std::string digest = self_test::digest_of_self_test(json);
    std::vector<outputs::OutputFile> written{
        {folder / "self-test.json", json},
        {folder / "self-test.html", self_test::self_test_html(test, digest, assets)}};
    if (has_pdf) {
        (void)tried(pdf, common, [&] { written.push_back({pdf, self_test::self_test_pdf(test, digest, assets)}); });
    }
    write_outputs(written, inputs, at_start);
    progress.clear();
    const bool passes = test.passed() == test.cases.size();
    if (!common.quiet) {
        print_to_stdout("\n{} of {} cases pass; {} of {} values agree.\n", test.passed(), test.cases.size(),
                        test.agreed(), test.compared());
        if (!test.system.cases_of_release || !test.system.templates_of_release) {
            print_to_stdout("The {} not those of this release; the report says so.\n",
                            test.system.cases_of_release       ? "templates are"
                            : test.system.templates_of_release ? "cases are"
                                                               : "cases and templates are");
        }
        print_to_stdout("SHA-256 of the report: {}\n\nWritten:\n", digest);
        for (const outputs::OutputFile& file : written) {
            print_to_stdout("  {}\n", text::one_line(file.path.string()));
        }
        print_to_stdout("Next: {}\n",
                        passes ? "keep the report with the validation records of the laboratory, and repeat the test "
                                 "after every change of program or machine"
                               : "issue no certificate before the report is explained; install the program again "
                                 "and repeat the test");
    }
    return passes ? done : negative_answer;
}

}  // namespace gumcert::cli
