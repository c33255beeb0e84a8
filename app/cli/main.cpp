// The program `gumcert`: reads the command line, calls a use case, turns failures into messages and exit codes.
#include <fmt/core.h>
#include <gumcert_build_info.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluate_job.h"
#include "app/file_digest.h"
#include "app/output_files.h"
#include "app/plan_job.h"
#include "app/simulate_job.h"
#include "app/study_inputs.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"
#include "reports/render.h"
#include "reports/study_document.h"

namespace {

namespace fs = std::filesystem;
using namespace gumcert;  // NOLINT(google-build-using-namespace): one program, one file

enum ExitCode : int {
    done = 0,
    negative_answer = 1,
    usage = 2,
    input_refused = 3,
    no_result = 4,
    storage_trouble = 5,
    defect = 70,
};

struct CommonOptions {
    bool quiet = false;
    bool json_messages = false;
    int threads = 0;  // 0: as many as the machine has
};

/// A terminal that is gone or full must not change the exit code.
template <class... Arguments>
void print_to_stderr(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    const std::string text = fmt::format(format, std::forward<Arguments>(arguments)...);
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

void print_message(const gum::Diagnostic& diagnostic, const CommonOptions& common) {
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
        print_to_stderr("{}{} [{}]\n", prefix, text, diagnostic.code);
    }
}

/// Progress on a terminal, from the first second on.
class ProgressLine {
public:
    explicit ProgressLine(bool wanted) : wanted_(wanted && isatty(STDERR_FILENO) == 1) {}
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void operator()(const std::string& text) {
        const auto elapsed = std::chrono::steady_clock::now() - start_;
        if (!wanted_ || elapsed < std::chrono::seconds(1)) {
            return;
        }
        print_to_stderr("\r\033[K{}: {}", command_, text);
        std::fflush(stderr);
        shown_ = true;
    }

    void clear() {
        if (shown_) {
            print_to_stderr("\r\033[K");
            shown_ = false;
        }
    }

private:
    bool wanted_;
    bool shown_ = false;
    const char* command_ = "gumcert";
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

fs::path executable() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error);
}

/// Folder with templates/: share/gumcert of the installation, or the tree that the program was built in.
fs::path share_folder(const std::string& given) {
    std::error_code error;
    if (!given.empty()) {
        if (!fs::exists(fs::path(given) / "templates" / "certificate.html.mustache", error)) {
            throw gum::StorageError(gum::Diagnostic{"GC-STORE-0010", given,
                                                    "has no folder templates with the documents",
                                                    "--share names the folder that holds templates/ and node_modules/",
                                                    "correct the folder, or leave --share out", gum::Severity::error});
        }
        return given;
    }
    fs::path folder = executable().parent_path();
    for (int level = 0; level < 6 && !folder.empty(); ++level, folder = folder.parent_path()) {
        for (const fs::path& candidate : {folder / "share" / "gumcert", folder}) {
            if (fs::exists(candidate / "templates" / "certificate.html.mustache", error)) {
                return candidate;
            }
        }
        if (folder == folder.root_path()) {
            break;
        }
    }
    throw gum::StorageError(gum::Diagnostic{"GC-STORE-0010", "templates", "the folder of templates was not found",
                                            "documents need the templates that come with the program",
                                            "name it with --share FOLDER", gum::Severity::error});
}

fs::path program_on_path(const char* name) {
    const char* const search = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): one thread
    std::error_code error;
    for (std::string rest = search == nullptr ? "" : search; !rest.empty();) {
        const std::size_t end = rest.find(':');
        const fs::path candidate = fs::path(rest.substr(0, end)) / name;
        if (access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate, error)) {
            return candidate;
        }
        rest = end == std::string::npos ? "" : rest.substr(end + 1);
    }
    return {};
}

reports::RenderAssets assets(const std::string& share, const std::string& language) {
    const fs::path folder = share_folder(share);
    reports::RenderAssets result;
    result.templates = folder / "templates";
    result.node_program = program_on_path("node");
    result.node_modules = folder / "node_modules";
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);  // only the PDF needs it, and says so when it is missing
    result.temporary_folder = error ? fs::path("/tmp") : temporary;
    result.language = language;
    return result;
}

std::string render(const reports::EvaluationRecord& record, const std::string& format,
                   const reports::RenderAssets& with) {
    if (format == "html") {
        return reports::render_html(record, with);
    }
    if (format == "pdf") {
        return reports::render_pdf(record, with);
    }
    return reports::render_text(record, with);
}

/// Headline numbers of a record, for the terminal.
/// "k = 2.92, p = 99 %": how the expanded uncertainty was found.
std::string coverage_text(const reports::Result& result) {
    std::string text = result.k ? fmt::format("k = {:.2f}, ", *result.k) : "";
    return text + fmt::format("p = {:.4g} %", 100.0 * result.coverage_probability);
}

/// Results of a budget, one a line; of a long table of points the first ones.
void print_results(const reports::EvaluationRecord& record) {
    constexpr std::size_t k_most_lines = 30;
    for (std::size_t i = 0; i < record.results.size() && i < k_most_lines; ++i) {
        const reports::Result& result = record.results[i];
        const std::string unit = result.printed.unit.empty() ? "" : " " + result.printed.unit;
        if (result.U) {
            fmt::print("  {} = {} ± {}{}", result.name, result.printed.value, result.printed.U, unit);
            fmt::print("   ({})\n", coverage_text(result));
        } else {
            fmt::print("  {} = {}{}   no expanded uncertainty can be stated\n", result.name, result.printed.value,
                       unit);
        }
        if (result.monte_carlo) {
            const reports::MonteCarloSummary& monte_carlo = *result.monte_carlo;
            fmt::print("      Monte Carlo, {} trials: u = {}, interval {} to {}", monte_carlo.printed.trials,
                       monte_carlo.printed.u, monte_carlo.printed.symmetric[0], monte_carlo.printed.symmetric[1]);
            if (monte_carlo.validation) {
                fmt::print("{}", !monte_carlo.validation->precise_enough ? "; too few trials to validate"
                                 : monte_carlo.validation->validated     ? "; law of propagation validated"
                                                                         : "; law of propagation NOT validated");
            }
            fmt::print("\n");
        }
    }
    if (record.results.size() > k_most_lines) {
        fmt::print("  … and {} more, all of them in the record\n", record.results.size() - k_most_lines);
    }
}

void print_summary(const reports::EvaluationRecord& record) {
    if (!record.title.empty()) {
        fmt::print("{}\n\n", record.title);
    }
    if (record.rotary) {
        const reports::RotaryTable& rotary = *record.rotary;
        fmt::print("Set-up of the fixture (value ± U, p = {}):\n", record.printed_coverage);
        for (const reports::Result& result : record.results) {
            fmt::print("  {:<4} {:>9} ± {} {}   {}\n", result.name, result.printed.value, result.printed.U,
                       result.printed.unit, result.description);
        }
        fmt::print("\nError motions over {} angles, datum {}:\n", rotary.errors.size(),
                   rotary.datum == "home" ? "home" : "axis average line");
        for (const reports::RangeRow& range : rotary.ranges) {
            fmt::print("  {}  range {:>7} ± {} {}\n", range.name, range.printed.value, range.printed.U,
                       range.printed.unit);
        }
        fmt::print("\nAdjustment: {} observations, {} parameters, chi-square {} on {} degrees of freedom, p = {}\n",
                   rotary.adjustment.observations, rotary.adjustment.parameters, rotary.adjustment.printed.chi_square,
                   rotary.adjustment.degrees_of_freedom, rotary.adjustment.printed.p_value);
        std::size_t removed = 0;
        for (const reports::FlaggedDistance& distance : rotary.flagged) {
            removed += distance.removed ? 1 : 0;
        }
        fmt::print("Outlying distances: {} found, {} left out (listed in the certificate)\n", rotary.flagged.size(),
                   removed);
        if (rotary.monte_carlo) {
            fmt::print("\nMonte Carlo: {}\n", rotary.monte_carlo->statement);
        }
    }
    if (record.kind == "budget") {
        print_results(record);
    }
    if (record.comparison) {
        fmt::print("\nComparison with {}:\n", record.comparison->reference_name);
        for (const reports::ComparisonSummary& row : record.comparison->summary) {
            fmt::print("  {:<3}  mean |En| {}   max |En| {}   above 1: {} of {}\n", row.direction,
                       row.printed.mean_abs_En, row.printed.max_abs_En, row.count_above_1, row.points);
        }
    }
}

void report_diagnostics(const reports::EvaluationRecord& record, const CommonOptions& common) {
    for (const gum::Diagnostic& diagnostic : record.diagnostics) {
        if (!common.quiet || diagnostic.severity != gum::Severity::note) {
            print_message(diagnostic, common);
        }
    }
}

[[noreturn]] void refuse_usage(const std::string& where, const std::string& what, const std::string& rule,
                               const std::string& action) {
    throw gum::UsageError(gum::Diagnostic{"GC-USAGE-0001", where, what, rule, action, gum::Severity::error});
}

void write_to_stdout(const std::string& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
        throw gum::StorageError(gum::Diagnostic{"GC-STORE-0003", "standard output", "cannot be written",
                                                "all of the output must arrive", "write to a file with -o FILE",
                                                gum::Severity::error});
    }
}

/// \return true when the answer is negative
bool run_job(const fs::path& job, const std::string& output, const std::string& share, const CommonOptions& common) {
    const fs::path folder = output.empty() ? job.parent_path() / (job.stem().string() + "-out") : fs::path(output);
    app::require_writable(folder / "record.json");
    ProgressLine progress(!common.quiet);
    const app::Evaluation evaluation = app::evaluate_job(job, "covariance.csv", static_cast<unsigned>(common.threads),
                                                         [&](const std::string& text) { progress(text); });
    const reports::RenderAssets with = assets(share, "en");
    progress("documents");
    std::vector<app::OutputFile> files{{folder / "record.json", reports::to_canonical_json(evaluation.record)}};
    if (!evaluation.covariance_csv.empty()) {
        files.push_back({folder / "covariance.csv", evaluation.covariance_csv});
    }
    files.push_back({folder / "certificate.html", reports::render_html(evaluation.record, with)});
    files.push_back({folder / "certificate.pdf", reports::render_pdf(evaluation.record, with)});
    for (const app::OutputFile& file : files) {
        app::require_not_an_input(file.path, app::input_files(job, evaluation.record));
    }
    app::write_files(files);
    progress.clear();
    report_diagnostics(evaluation.record, common);
    if (!common.quiet) {
        print_summary(evaluation.record);
        fmt::print("\nWritten:\n");
        for (const app::OutputFile& file : files) {
            fmt::print("  {}\n", file.path.string());
        }
    }
    return evaluation.negative;
}

bool evaluate(const fs::path& job, const std::string& output, const CommonOptions& common) {
    const bool to_stdout = output == "-";
    const fs::path record_file =
        output.empty() ? job.parent_path() / (job.stem().string() + "-record.json") : fs::path(output);
    // The covariance stands beside the record under the record's own name, so that two records do not share it.
    const std::string covariance_name = to_stdout ? "" : record_file.stem().string() + "-covariance.csv";
    if (!to_stdout) {
        app::require_writable(record_file);
    }
    ProgressLine progress(!common.quiet);
    const app::Evaluation evaluation = app::evaluate_job(job, covariance_name, static_cast<unsigned>(common.threads),
                                                         [&](const std::string& text) { progress(text); });
    const std::string text = reports::to_canonical_json(evaluation.record);
    progress.clear();
    if (to_stdout) {
        report_diagnostics(evaluation.record, common);
        write_to_stdout(text);
        return evaluation.negative;
    }
    std::vector<app::OutputFile> files{{record_file, text}};
    if (!evaluation.covariance_csv.empty()) {
        files.push_back({record_file.parent_path() / covariance_name, evaluation.covariance_csv});
    }
    for (const app::OutputFile& file : files) {
        app::require_not_an_input(file.path, app::input_files(job, evaluation.record));
    }
    app::write_files(files);
    report_diagnostics(evaluation.record, common);
    if (!common.quiet) {
        print_summary(evaluation.record);
        fmt::print("\nWritten:\n");
        for (const app::OutputFile& file : files) {
            fmt::print("  {}\n", file.path.string());
        }
        fmt::print("Next: gumcert render {} --format pdf\n", record_file.string());
    }
    return evaluation.negative;
}

void render_record(const fs::path& record_file, const std::string& format, const std::string& output,
                   const std::string& language, const std::string& share, const CommonOptions& common) {
    if (format == "dcc") {
        refuse_usage("--format dcc", "the digital calibration certificate is not part of this version",
                     "this version renders html, pdf and text", "choose one of them");
    }
    if (language != "en") {
        refuse_usage("--language " + language, "the wording of this language is not part of this version",
                     "this version writes English (en)", "leave the option out");
    }
    const reports::EvaluationRecord record =
        reports::record_from_json(app::read_file(record_file), record_file.string());
    const bool to_stdout = output == "-";
    const fs::path file =
        output.empty()
            ? record_file.parent_path() / (record_file.stem().string() + (format == "text" ? ".txt" : "." + format))
            : fs::path(output);
    if (!to_stdout) {
        app::require_writable(file);
        app::require_not_an_input(file, {record_file});
    }
    const std::string bytes = render(record, format, assets(share, language));
    if (to_stdout) {
        write_to_stdout(bytes);
        return;
    }
    app::write_files({{file, bytes}});
    if (!common.quiet) {
        fmt::print("Written: {}\n", file.string());
    }
}

/// Where the outcome of a study goes, and in which form: by the ending of the file.
struct StudyOutput {
    fs::path file;  ///< empty: text to standard output
    std::string form = ".txt";
};

StudyOutput study_output(const std::string& output, const fs::path& job) {
    if (output.empty() || output == "-") {
        return {};
    }
    StudyOutput result{output, fs::path(output).extension().string()};
    if (result.form != ".txt" && result.form != ".json" && result.form != ".html" && result.form != ".pdf") {
        refuse_usage("-o " + output, "the ending does not say which form is wanted",
                     "a study is written as .txt, .json, .html or .pdf", "give the file one of these endings");
    }
    app::require_writable(result.file);
    app::require_not_an_input(result.file, {job});
    return result;
}

void write_study(const reports::StudyDocument& study, const StudyOutput& output, const fs::path& job,
                 const std::string& share, const CommonOptions& common) {
    if (output.file.empty()) {
        write_to_stdout(reports::render_text(study));
        return;
    }
    app::require_not_an_input(output.file, app::study_inputs(job));
    const std::string bytes = output.form == ".json"   ? study.data_json
                              : output.form == ".html" ? reports::render_html(study, assets(share, "en"))
                              : output.form == ".pdf"  ? reports::render_pdf(study, assets(share, "en"))
                                                       : reports::render_text(study);
    app::write_files({{output.file, bytes}});
    if (!common.quiet) {
        fmt::print("Written: {}\n", output.file.string());
    }
}

std::string version_text() {
    std::string digest = "unknown";
    try {
        digest = app::sha256(app::read_file(executable()));
    } catch (const gum::DiagnosedError&) {
        // A system without /proc: the version is still told.
    }
    return fmt::format("gumcert {}\ncommit {}\nsha256 {}", k_version, k_commit, digest);
}

constexpr const char* k_description =
    "gumcert evaluates measurements with their uncertainty (GUM, ISO/IEC Guide 98-3) and writes the calibration\n"
    "certificate. A job file (JSON) names the measurement and its data files.";

constexpr const char* k_footer =
    "Start here:\n"
    "  gumcert run examples/rotary_table/job.json     evaluate, write record, HTML and PDF into job-out/\n"
    "  gumcert run examples/gauge_block/job.json      an uncertainty budget, with Monte Carlo; docs/budget_job.md\n"
    "  gumcert plan examples/rotary_table/plan.json   the uncertainty to expect, before anything is measured\n"
    "  gumcert simulate examples/rotary_table/simulation.json   measurements with a known truth, evaluated\n"
    "\n"
    "Exit codes: 0 done; 1 done, and the answer is negative; 2 the command line is wrong; 3 an input was refused;\n"
    "4 no result can be computed; 5 a file or disk trouble; 70 a defect in the program. Nothing is written when the\n"
    "exit code is 2, 3 or 4. Messages go to stderr: where — what is wrong — the rule — what to do [code].";

int dispatch(int argc, char** argv, CommonOptions& common) {
    CLI::App program{k_description, "gumcert"};
    program.footer(k_footer);
    program.require_subcommand(0, 1);
    program.set_version_flag("--version", version_text, "Version, commit and SHA-256 of this program");
    const auto add_common = [&common](CLI::App& command) {
        command.add_flag("-q,--quiet", common.quiet, "No progress, no summary, no notes");
        command.add_flag("--json-messages", common.json_messages, "Messages as one JSON object a line");
        command.add_option("--threads", common.threads, "Threads to use; results are the same bytes for any number")
            ->check(CLI::Range(1, 1024));
    };
    add_common(program);

    std::string job;
    std::string output;
    std::string share;
    std::string format;
    std::string language = "en";
    std::string record;

    CLI::App* run = program.add_subcommand("run", "Evaluate a job and write record, covariance and certificates");
    run->add_option("JOB", job, "Job file (JSON)")->required();
    run->add_option("-o,--output", output, "Folder for the output; default: the job's name with -out, beside the job");
    run->add_option("--share", share, "Folder that holds templates/ and node_modules/");
    run->footer(
        "Example: gumcert run examples/rotary_table/job.json -o /tmp/certificate\n"
        "Writes record.json, covariance.csv, certificate.html and certificate.pdf, all or none.");

    CLI::App* evaluate_command = program.add_subcommand("evaluate", "Evaluate a job and write its record only");
    evaluate_command->add_option("JOB", job, "Job file (JSON)")->required();
    evaluate_command->add_option("-o,--output", output,
                                 "Record file, or - for standard output; default: the job's name with -record.json");
    evaluate_command->footer("Example: gumcert evaluate job.json -o record.json");

    CLI::App* render_command = program.add_subcommand("render", "Make a document from a record, without evaluating");
    render_command->add_option("RECORD", record, "Record file (JSON)")->required();
    render_command->add_option("--format", format, "html, pdf, text (dcc: not in this version)")
        ->required()
        ->check(CLI::IsMember({"html", "pdf", "text", "dcc"}));
    render_command->add_option("-o,--output", output, "File, or - for standard output; default: beside the record");
    render_command->add_option("--language", language, "Language of the document")
        ->check(CLI::IsMember({"en", "de", "zh-Hant", "es"}));
    render_command->add_option("--share", share, "Folder that holds templates/ and node_modules/");
    render_command->footer("Example: gumcert render record.json --format pdf -o certificate.pdf");

    std::optional<std::size_t> runs;
    std::optional<std::int64_t> seed;
    CLI::App* simulate_command = program.add_subcommand(
        "simulate", "Simulate measurements of a rotary-table job with a known truth, and evaluate them");
    simulate_command->add_option("JOB", job, "Job file (JSON) of kind rotary_table")->required();
    simulate_command->add_option("--runs", runs, "Simulated campaigns; default: as the job says, else 100")
        ->check(CLI::Range(1, 1'000'000));
    simulate_command->add_option("--seed", seed, "Seed of the random numbers; default: as the job says, else 1")
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53));
    simulate_command->footer(
        "Example: gumcert simulate examples/rotary_table/simulation.json --runs 20 -o study.html\n"
        "Says how far evaluated set-up and error motions are from the simulated truth, how much of that is the choice\n"
        "of a datum and how much is measurement, and whether the stated uncertainties hold. docs/simulation.md");

    CLI::App* plan_command =
        program.add_subcommand("plan", "Uncertainty to expect of a rotary-table job before anything is measured");
    plan_command->add_option("JOB", job, "Job file (JSON) of kind rotary_table; measured lengths are not needed")
        ->required();
    plan_command->footer(
        "Example: gumcert plan examples/rotary_table/plan.json -o plan.html\n"
        "Expected expanded uncertainties, what each station and the number of angles contribute, and better station\n"
        "positions inside the region that the job allows. docs/planning.md");
    for (CLI::App* command : {simulate_command, plan_command}) {
        command->add_option(
            "-o,--output", output,
            "File; its ending says the form: .txt, .json, .html or .pdf. Default: text to the terminal");
        command->add_option("--share", share, "Folder that holds templates/ and node_modules/");
    }

    for (CLI::App* command : {run, evaluate_command, render_command, simulate_command, plan_command}) {
        add_common(*command);
    }

    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        return program.exit(asked);
    } catch (const CLI::ParseError& wrong) {
        refuse_usage("command line", wrong.what(), "see gumcert --help", "correct the command");
    }
    if (run->parsed()) {
        return run_job(job, output, share, common) ? negative_answer : done;
    } else if (evaluate_command->parsed()) {
        return evaluate(job, output, common) ? negative_answer : done;
    } else if (render_command->parsed()) {
        render_record(record, format, output, language, share, common);
    } else if (simulate_command->parsed() || plan_command->parsed()) {
        const StudyOutput to = study_output(output, job);
        ProgressLine progress(!common.quiet);
        const auto report = [&](const std::string& text) { progress(text); };
        const auto threads = static_cast<unsigned>(common.threads);
        const auto unsigned_seed =
            seed ? std::optional<std::uint64_t>(static_cast<std::uint64_t>(*seed)) : std::nullopt;
        const reports::StudyDocument study = simulate_command->parsed()
                                                 ? app::simulate_job(job, runs, unsigned_seed, threads, report)
                                                 : app::plan_job(job, threads, report);
        progress.clear();
        write_study(study, to, job, share, common);
    } else {
        fmt::print("{}", program.help());
    }
    return done;
}

template <class Error>
int explain(const Error& error, const CommonOptions& common, ExitCode code) {
    for (const gum::Diagnostic& diagnostic : error.diagnostics()) {
        print_message(diagnostic, common);
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    CommonOptions common;
    try {
        return dispatch(argc, argv, common);
    } catch (const gum::UsageError& error) {
        return explain(error, common, usage);
    } catch (const gum::InputError& error) {
        return explain(error, common, input_refused);
    } catch (const gum::NoResultError& error) {
        return explain(error, common, no_result);
    } catch (const gum::StorageError& error) {
        return explain(error, common, storage_trouble);
    } catch (const std::bad_alloc&) {
        print_to_stderr(
            "gumcert — out of memory — an evaluation needs its memory whole — close other programs, or split the job "
            "[GC-STORE-0020]\n");
        return storage_trouble;
    } catch (const std::exception& error) {
        fmt::print(stderr,
                   "gumcert — {} — this is a defect in the program — please report it with the job [GC-DEFECT-0001]\n",
                   error.what());
        return defect;
    }
}
