#include "app/cli/study_commands.h"

#include <fmt/core.h>

#include "app/cli/output_places.h"
#include "app/cli/share_folder.h"
#include "app/output_files.h"
#include "app/plan_job.h"
#include "app/simulate_job.h"
#include "app/study_inputs.h"
#include "reports/forms/study_document.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

/// Where the outcome of a study goes, and in which form: by the ending of the file.
struct StudyOutput {
    fs::path file;  ///< empty: text to standard output
    std::string form = ".txt";
    app::OutputsAtStart at_start = {};
};

StudyOutput study_output(const std::string& output, const fs::path& job, const CommonOptions& common) {
    if (output.empty() || output == "-") {
        return {};
    }
    StudyOutput result{.file = output, .form = fs::path(output).extension().string()};
    if (result.form != ".txt" && result.form != ".json" && result.form != ".html" && result.form != ".pdf") {
        refuse_usage("-o " + output, "the ending does not say which form is wanted",
                     "a study is written as .txt, .json, .html or .pdf", "give the file one of these endings");
    }
    app::require_writable(result.file);
    app::require_not_an_input(result.file, {job});
    result.at_start = begin_outputs({result.file}, common);
    return result;
}

void write_study(const reports::StudyDocument& study, const StudyOutput& output, const fs::path& job,
                 const std::string& share, const CommonOptions& common) {
    if (output.file.empty()) {
        write_to_stdout(reports::render_text(study));
        return;
    }
    const std::string bytes = output.form == ".json"   ? study.data_json
                              : output.form == ".html" ? reports::render_html(study, render_assets(share, {"en"}))
                              : output.form == ".pdf"  ? reports::render_pdf(study, render_assets(share, {"en"}))
                                                       : reports::render_text(study);
    std::vector<fs::path> inputs = app::study_inputs(job);
    inputs.push_back(job);
    add_program_files(inputs, share);
    write_outputs({{output.file, bytes}}, inputs, output.at_start);
    if (!common.quiet) {
        fmt::print("Written: {}\n", output.file.string());
    }
}

}  // namespace

ExitCode simulate(const fs::path& job, std::optional<std::size_t> runs, std::optional<std::int64_t> seed,
                  const std::string& output, const std::string& share, const CommonOptions& common) {
    const StudyOutput to = study_output(output, job, common);
    ProgressLine progress(!common.quiet);
    const auto unsigned_seed = seed ? std::optional<std::uint64_t>(static_cast<std::uint64_t>(*seed)) : std::nullopt;
    const reports::StudyDocument study =
        app::simulate_job(job, runs, unsigned_seed, static_cast<unsigned>(common.threads),
                          [&](const std::string& text) { progress(text); });
    progress.clear();
    write_study(study, to, job, share, common);
    return done;
}

ExitCode plan(const fs::path& job, const std::string& output, const std::string& share, const CommonOptions& common) {
    const StudyOutput to = study_output(output, job, common);
    ProgressLine progress(!common.quiet);
    const reports::StudyDocument study =
        app::plan_job(job, static_cast<unsigned>(common.threads), [&](const std::string& text) { progress(text); });
    progress.clear();
    write_study(study, to, job, share, common);
    return done;
}

}  // namespace gumcert::cli
