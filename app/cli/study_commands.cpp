#include "app/cli/study_commands.h"

#include <fmt/core.h>

#include <memory>
#include <vector>

#include "app/cli/terminal/output_places.h"
#include "app/cli/terminal/share_folder.h"
#include "evaluation/plan_job.h"
#include "evaluation/simulate_job.h"
#include "evaluation/study_job.h"
#include "evaluation/unprintable_characters.h"
#include "outputs/kept_files.h"
#include "outputs/output_files.h"
#include "reports/forms/pdf_worker.h"
#include "reports/forms/study_document.h"
#include "text/visible_text.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

/// Where the outcome of a study goes, and in which form: by the ending of the file.
struct StudyOutput {
    fs::path file;  ///< empty: text to standard output
    std::string form = ".txt";
    reports::RenderAssets assets = {};
    std::unique_ptr<reports::PdfWorker> worker = {};  ///< of a PDF
    std::vector<fs::path> inputs = {};
    outputs::OutputsAtStart at_start = {};
};

/// The outcome in the forms that need nothing but itself: numbers for programs, and text. They are kept where the
/// document that is asked for cannot be made.
fs::path numbers_file(fs::path document) {
    return document.replace_extension(".json");
}
fs::path text_file(fs::path document) {
    return document.replace_extension(".txt");
}

bool is_document(const StudyOutput& output) {
    return output.form == ".html" || output.form == ".pdf";
}

StudyOutput study_output(const std::string& output, const fs::path& job, const CommonOptions& common) {
    if (output.empty() || output == "-") {
        return {};
    }
    StudyOutput result{.file = output, .form = fs::path(output).extension().string()};
    if (result.form != ".txt" && result.form != ".json" && result.form != ".html" && result.form != ".pdf") {
        refuse_usage("-o " + output, "the ending does not say which form is wanted",
                     "a study is written as .txt, .json, .html or .pdf", "give the file one of these endings");
    }
    std::vector<fs::path> outputs{result.file};
    if (is_document(result)) {
        outputs.push_back(outputs::kept_place(numbers_file(result.file)));
        outputs.push_back(outputs::kept_place(text_file(result.file)));
    }
    outputs::require_writable(result.file);
    outputs::require_not_inputs(outputs, {job});
    result.at_start = begin_outputs(outputs, common);
    return result;
}

/// Looks at what the document of a study is made with, before the study begins, which would be lost.
void prepare_output(StudyOutput& output, const evaluation::StudyJob& study, const fs::path& job,
                    const std::string& share, const CommonOptions& common) {
    if (output.file.empty()) {
        return;
    }
    output.inputs = study.inputs();
    output.inputs.push_back(job);
    add_program_files(output.inputs, share);
    if (is_document(output)) {
        output.assets = render_assets(share, {"en"});
    }
    if (output.form == ".pdf") {
        output.worker = std::make_unique<reports::PdfWorker>(output.assets);
        output.worker->require_ready();
        print_messages(evaluation::unprintable_characters(study.read(),
                                                          [&](const std::vector<std::string>& characters) {
                                                              return reports::characters_without_glyph(
                                                                  characters, output.assets, *output.worker);
                                                          }),
                       common);
    }
}

void write_study(const reports::StudyDocument& study, const StudyOutput& output, const CommonOptions& common) {
    if (output.file.empty()) {
        write_to_stdout(reports::render_text(study));
        return;
    }
    std::string bytes;
    outputs::make_or_keep(
        [&] {
            bytes = output.form == ".json"   ? study.data_json
                    : output.form == ".html" ? reports::render_html(study, output.assets)
                    : output.form == ".pdf"  ? reports::render_pdf(study, output.assets, output.worker.get())
                                             : reports::render_text(study);
        },
        [&] {
            keep_files(
                {{numbers_file(output.file), study.data_json}, {text_file(output.file), reports::render_text(study)}},
                output.inputs, output.at_start, "has the numbers of this study, and the file .txt beside it the text",
                "write it in another form, .html or .txt", common);
        });
    write_outputs({{output.file, bytes}}, output.inputs, output.at_start);
    report_kept(numbers_file(output.file), common);
    if (!common.quiet) {
        print_to_stdout("Written: {}\n", text::one_line(output.file.string()));
    }
}

}  // namespace

ExitCode simulate(const fs::path& job, std::optional<std::size_t> runs, std::optional<std::int64_t> seed,
                  const std::string& output, const std::string& share, const CommonOptions& common) {
    StudyOutput to = study_output(output, job, common);
    const evaluation::StudyJob read(job, jobs::JobUse::simulate);  // before what is wrong with the machine
    prepare_output(to, read, job, share, common);
    ProgressLine progress(!common.quiet);
    const auto unsigned_seed = seed ? std::optional<std::uint64_t>(static_cast<std::uint64_t>(*seed)) : std::nullopt;
    const reports::StudyDocument study =
        evaluation::simulate_job(read.job(), read.name(), runs, unsigned_seed, static_cast<unsigned>(common.threads),
                                 [&](const std::string& text) { progress(text); });
    progress.clear();
    write_study(study, to, common);
    return done;
}

ExitCode plan(const fs::path& job, const std::string& output, const std::string& share, const CommonOptions& common) {
    StudyOutput to = study_output(output, job, common);
    const evaluation::StudyJob read(job);
    prepare_output(to, read, job, share, common);
    ProgressLine progress(!common.quiet);
    const reports::StudyDocument study =
        evaluation::plan_job(read.job(), read.name(), static_cast<unsigned>(common.threads),
                             [&](const std::string& text) { progress(text); });
    progress.clear();
    write_study(study, to, common);
    return done;
}

}  // namespace gumcert::cli
