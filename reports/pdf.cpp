#include "gum/quantity/diagnostic.h"
#include "reports/asset_files.h"
#include "reports/certificate_view.h"
#include "reports/document_forms.h"
#include "reports/render.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gumcert::reports {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_set_up = "run scripts/setup, which installs it";
constexpr const char* k_package = "@myriaddreamin/typst-ts-node-compiler";

[[noreturn]] void storage_error(const std::string& where, const std::string& what, const std::string& rule,
                                const std::string& action) {
    throw gum::StorageError(
        gum::Diagnostic{.code = "GC-REPORT-0010", .where = where, .what = what, .rule = rule, .action = action});
}

/// A folder that only this user can enter; removed with everything in it at the end.
class PrivateFolder {
public:
    explicit PrivateFolder(const fs::path& parent) {
        std::string name = (parent / "gumcert-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) {
            storage_error(parent.string(), std::string("cannot make a folder in it: ") + std::strerror(errno),
                          "the PDF step needs a folder for its files", "name a folder that can be written to");
        }
        path_ = name;
    }
    ~PrivateFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// Runs node without a shell, with an empty environment of its own; its output goes to `log`.
/// \return exit status, or none when it did not end within the limit and was stopped
std::optional<int> run_node(const RenderAssets& assets, const fs::path& folder, const fs::path& log) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string log_name = log.string();
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);

    std::array<std::string, 5> arguments = {assets.node_program.string(),
                                            (assets.templates / "pdf" / "render.mjs").string(),
                                            fs::absolute(assets.node_modules).string(), folder.string(),
                                            fs::absolute(assets.templates / "pdf" / "certificate.typ").string()};
    std::array<char*, 6> argv{};
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        argv[i] = arguments[i].data();
    }
    std::string home = "HOME=" + folder.string();
    std::string language = "LC_ALL=C.UTF-8";
    std::string zone = "TZ=UTC";
    std::array<char*, 4> environment = {home.data(), language.data(), zone.data(), nullptr};

    pid_t child = 0;
    const int failure = ::posix_spawn(&child, arguments[0].c_str(), &actions, nullptr, argv.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        storage_error(arguments[0], std::string("cannot be started: ") + std::strerror(failure),
                      "PDF is set by Typst, which runs in Node.js 18 or later", k_set_up);
    }
    const auto deadline = std::chrono::steady_clock::now() + assets.pdf_time_limit;
    int status = 0;
    for (;;) {
        const pid_t ended = ::waitpid(child, &status, WNOHANG);
        if (ended == child) {
            return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        }
        if (ended < 0 && errno != EINTR) {
            storage_error(arguments[0], std::string("waiting for it failed: ") + std::strerror(errno),
                          "the program waits for its child process", "report this as a defect");
        }
        if (std::chrono::steady_clock::now() >= deadline) {
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            return std::nullopt;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

std::string whole_file(const fs::path& file) {
    return fs::exists(file) ? read_asset(file) : std::string();
}

}  // namespace

std::string view_as_pdf(const nlohmann::json& view, const RenderAssets& assets) {
    if (!fs::is_regular_file(assets.node_program)) {
        storage_error(assets.node_program.empty() ? "node" : assets.node_program.string(), "not found",
                      "PDF is set by Typst, which runs in Node.js 18 or later", k_set_up);
    }
    if (!fs::is_directory(assets.node_modules / k_package)) {
        storage_error((assets.node_modules / k_package).string(), "not found",
                      "PDF is set by the Typst package that package-lock.json names", k_set_up);
    }
    const PrivateFolder folder(assets.temporary_folder);
    {
        std::ofstream file(folder.path() / "view.json", std::ios::binary);
        file << view.dump();
        if (!file.flush()) {
            storage_error((folder.path() / "view.json").string(), "cannot be written",
                          "the PDF step needs room for its files", "make room on the disk");
        }
    }
    const fs::path log = folder.path() / "log.txt";
    const std::optional<int> status = run_node(assets, folder.path(), log);
    if (!status) {
        storage_error("PDF", "not finished after " + std::to_string(assets.pdf_time_limit.count()) + " s",
                      "the PDF step has a time limit", "print fewer rows, or use HTML");
    }
    std::string said = log.empty() || !fs::exists(log) || fs::file_size(log) == 0 ? "" : read_asset(log);
    while (!said.empty() && said.back() == '\n') {
        said.pop_back();
    }
    said = shortened(printable(said), 600);
    constexpr int k_refused_by_typst = 3;
    if (*status == k_refused_by_typst) {
        throw gum::NoResultError(gum::Diagnostic{.code = "GC-REPORT-0011",
                                                 .where = "PDF",
                                                 .what = said,
                                                 .rule = "a PDF/A-3a shows every character and carries its fonts",
                                                 .action = "replace characters that the font lacks, or use HTML"});
    }
    const std::string pdf = *status == 0 ? whole_file(folder.path() / "certificate.pdf") : std::string();
    if (!pdf.starts_with("%PDF-")) {
        storage_error("PDF", "node ended with status " + std::to_string(*status) + (said.empty() ? "" : ": " + said),
                      "the PDF step ends with status 0", k_set_up);
    }
    return pdf;
}

std::string render_pdf(const EvaluationRecord& record, const RenderAssets& assets) {
    return view_as_pdf(certificate_view(record, read_wording(assets)), assets);
}

}  // namespace gumcert::reports
