#include "reports/forms/pdf_worker.h"

#include "gum/quantity/diagnostic.h"
#include "reports/forms/asset_files.h"
#include "reports/printable_text.h"
#include "reports/view/certificate_view.h"
#include "system/cleanup.h"
#include "system/no_network.h"
#include "system/temporary.h"
#include "text/lists.h"
#include "text/markup.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gumcert::reports {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* k_set_up =
    "install Node.js 18 or later (package nodejs), and set --share to the folder with "
    "node_modules; in the source tree scripts/setup installs both";
constexpr const char* k_make_room = "make room on the disk of this folder, or name another with TMPDIR";
constexpr const char* k_package = "@myriaddreamin/typst-ts-node-compiler";

// The pinned Typst package keeps about 1.2 MB for good for each certificate of three pages (measured over 1000), and a
// fresh process costs about 0.5 s, with what it has to set anew. So a process ends after so many documents, or sooner when
// they are large.
constexpr int k_documents_per_process = 200;
constexpr std::uint64_t k_memory_per_process = 800'000'000;  // bytes

[[noreturn]] void storage_error(const std::string& where, const std::string& what, const std::string& rule,
                                const std::string& action) {
    throw gum::StorageError(
        gum::Diagnostic{.code = "GC-REPORT-0010", .where = where, .what = what, .rule = rule, .action = action});
}

system::TemporaryFolder private_folder(const fs::path& parent) {
    try {
        return system::TemporaryFolder(parent);
    } catch (const std::system_error& error) {
        storage_error(parent.string(), "cannot make a folder in it: " + error.code().message(),
                      "the PDF step needs a folder for its files", "name a folder that can be written to with TMPDIR");
    }
}

void make_folder(const fs::path& path) {
    std::error_code failure;
    fs::create_directory(path, failure);
    if (failure) {
        storage_error(path.string(), "cannot be made: " + failure.message(),
                      "the PDF step needs a folder for its files", k_make_room);
    }
}

/// The folder with the files of one document: empty at first, gone at the end.
class DocumentFolder {
public:
    explicit DocumentFolder(fs::path path) : path_(std::move(path)) { make_folder(path_); }
    ~DocumentFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    DocumentFolder(const DocumentFolder&) = delete;
    DocumentFolder& operator=(const DocumentFolder&) = delete;

private:
    fs::path path_;
};

void write_file(const fs::path& name, std::string_view bytes) {
    std::ofstream file(name, std::ios::binary);
    file << bytes;
    if (!file.flush()) {
        storage_error(name.string(), "cannot be written", "the PDF step needs room for its files", k_make_room);
    }
}

/// Owns a file descriptor.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }
    void take(int number) {
        close();
        number_ = number;
    }
    void close() {
        if (number_ >= 0) {
            ::close(std::exchange(number_, -1));
        }
    }

private:
    int number_ = -1;
};

void open_pipe(Descriptor& reading, Descriptor& writing) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        storage_error("PDF", std::string("no pipe: ") + std::strerror(errno), "node is spoken to through pipes",
                      "end programs that hold many files open");
    }
    reading.take(ends[0]);
    writing.take(ends[1]);
}

/// Writing to a pipe whose reader ended raises SIGPIPE, which would end the program. A library must not change how the
/// program treats signals, so the signal is held back in this thread alone, and taken away if it came.
class NoPipeSignal {
public:
    NoPipeSignal() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~NoPipeSignal() {
        if (!was_pending_) {
            const timespec at_once{};
            while (::sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
            }
        }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    NoPipeSignal(const NoPipeSignal&) = delete;
    NoPipeSignal& operator=(const NoPipeSignal&) = delete;

private:
    sigset_t pipe_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

void check_installation(const RenderAssets& assets) {
    if (!fs::is_regular_file(assets.node_program)) {
        storage_error(assets.node_program.empty() ? "node" : assets.node_program.string(), "not found",
                      "PDF is set by Typst, which runs in Node.js 18 or later", k_set_up);
    }
    if (!fs::is_directory(assets.node_modules / k_package)) {
        storage_error((assets.node_modules / k_package).string(), "not found",
                      "PDF is set by the Typst package that package-lock.json names", k_set_up);
    }
}

}  // namespace

/// The child process with its pipes and its folder.
class PdfWorker::Process {
public:
    explicit Process(const RenderAssets& assets) : assets_(assets), folder_(private_folder(assets.temporary_folder)) {
        // Typst would offer the fonts of the machine; a list of folders with one empty folder keeps them away.
        make_folder(folder_.path() / "no_fonts");
        write_file(folder_.path() / "fonts.conf", "<?xml version=\"1.0\"?>\n<fontconfig><dir>" +
                                                      text::escaped_markup((folder_.path() / "no_fonts").string()) +
                                                      "</dir></fontconfig>\n");
        start();
    }
    ~Process() {
        if (child_ > 0) {
            ::kill(child_, SIGKILL);
            wait_for_end(0);
        }
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Whether it can take another document.
    [[nodiscard]] bool is_fit() {
        return documents_ < k_documents_per_process && memory_ < k_memory_per_process && !wait_for_end(WNOHANG);
    }

    std::string set(const std::string& view, const std::string& attachment, bool further_fonts,
                    const std::string& main) {
        const DocumentFolder files(workspace());
        const nlohmann::json answer = answer_to(view, attachment, further_fonts, main);
        const std::string status = answer.is_object() ? answer.value("status", std::string()) : std::string();
        if (status == "template") {
            throw gum::NoResultError(gum::Diagnostic{
                .code = "GC-REPORT-0012",
                .where = "PDF",
                .what = messages(answer),
                .rule = "the template templates/pdf/" + main + " is set by Typst with the texts of the record",
                .action = "correct the template at the place that is named, or use the one that comes "
                          "with the program (docs/templates.md)"});
        }
        if (status == "refused" && messages(answer).find("unknown font family") != std::string::npos) {
            throw gum::NoResultError(gum::Diagnostic{
                .code = "GC-REPORT-0034",
                .where = "PDF",
                .what = messages(answer) + "; there are " + text::listed(families()),
                .rule = "a template uses fonts of the program, of its installation, or of the folder fonts beside it",
                .action = "take one of them (gumcert fonts lists their styles), or put the files of the font into "
                          "templates/pdf/fonts"});
        }
        if (status == "refused") {
            throw gum::NoResultError(gum::Diagnostic{
                .code = "GC-REPORT-0011",
                .where = "PDF",
                .what = messages(answer),
                .rule = "a PDF/A-3a shows every character and carries its fonts",
                .action = "replace characters that the fonts lack, install fonts-noto-cjk for Chinese, or use HTML"});
        }
        if (status != "done") {
            storage_error("PDF",
                          "node could not set the document" + (answer.is_object() ? ": " + messages(answer) : ""),
                          "the PDF step answers with a document", is_full(answer) ? k_make_room : k_set_up);
        }
        memory_ = answer.value("memory", std::uint64_t{0});
        std::string pdf = read_asset(workspace() / "certificate.pdf");
        if (!pdf.starts_with("%PDF-")) {
            storage_error("PDF", "what node wrote is no PDF", "the PDF step ends with a document", k_set_up);
        }
        return pdf;
    }

    std::optional<std::vector<std::string>> texts_without_glyph(const std::string& view, bool further_fonts) {
        const DocumentFolder files(workspace());
        const nlohmann::json answer = answer_to(view, {}, further_fonts, k_certificate);
        if (!answer.is_object()) {
            return std::nullopt;
        }
        std::vector<std::string> texts;
        if (answer.contains("texts")) {
            for (const nlohmann::json& text : answer["texts"]) {
                texts.push_back(text.is_string() ? text.get<std::string>() : std::string());
            }
        }
        if (texts.empty() && answer.value("status", std::string()) != "done") {
            return std::nullopt;
        }
        return texts;
    }

    std::vector<TemplateFont> fonts() {
        const nlohmann::json request = {
            {"fonts", fs::absolute(assets_.templates / "pdf" / PdfWorker::k_certificate).string()}};
        const Clock::time_point deadline = Clock::now() + assets_.pdf_time_limit;
        send(request.dump() + '\n', deadline);
        const nlohmann::json answer = nlohmann::json::parse(receive_line(deadline), nullptr, false);
        if (!answer.is_object() || !answer.contains("fonts")) {
            storage_error("PDF", "node could not list the fonts" + (answer.is_object() ? ": " + messages(answer) : ""),
                          "the PDF step answers with a document", k_set_up);
        }
        std::vector<TemplateFont> all;
        for (const nlohmann::json& font : answer["fonts"]) {
            all.push_back({.family = printable(font.value("family", std::string())),
                           .style = printable(font.value("style", std::string())),
                           .from = font.value("from", std::string())});
        }
        return all;
    }

private:
    [[nodiscard]] fs::path workspace() const { return folder_.path() / "document"; }

    /// What node says of a document whose files are put into the workspace.
    nlohmann::json answer_to(const std::string& view, const std::string& attachment, bool further_fonts,
                             const std::string& main) {
        write_file(workspace() / "view.json", view);
        if (!attachment.empty()) {
            write_file(workspace() / "certificate.xml", attachment);
        }
        const nlohmann::json request = {{"template", fs::absolute(assets_.templates / "pdf" / main).string()},
                                        {"further_fonts", further_fonts}};
        const Clock::time_point deadline = Clock::now() + assets_.pdf_time_limit;
        send(request.dump() + '\n', deadline);
        ++documents_;
        return nlohmann::json::parse(receive_line(deadline), nullptr, false);
    }

    /// Names of the families that every document may use, each once: not those for other scripts.
    std::vector<std::string> families() {
        std::vector<std::string> names;
        for (const TemplateFont& font : fonts()) {
            const bool further = std::any_of(assets_.fonts.begin(), assets_.fonts.end(), [&](const fs::path& folder) {
                return fs::absolute(folder).string() == font.from;
            });
            if (!further && std::find(names.begin(), names.end(), font.family) == names.end()) {
                names.push_back(font.family);
            }
        }
        return names;
    }

    void start() {
        Descriptor child_input;
        Descriptor child_output;
        open_pipe(child_input, input_);
        open_pipe(output_, child_output);
        // Neither a full nor an empty pipe may stop the program beyond the time limit.
        ::fcntl(input_.number(), F_SETFL, O_NONBLOCK);
        ::fcntl(output_.number(), F_SETFL, O_NONBLOCK);

        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        const std::string log = log_file().string();
        posix_spawn_file_actions_adddup2(&actions, child_input.number(), STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, child_output.number(), STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t none;
        sigemptyset(&none);
        sigset_t pipe_signal;
        sigemptyset(&pipe_signal);
        sigaddset(&pipe_signal, SIGPIPE);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &pipe_signal);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

        std::vector<std::string> arguments = {assets_.node_program.string(),
                                              fs::absolute(assets_.templates / "pdf" / "render.mjs").string(),
                                              fs::absolute(assets_.node_modules).string(), workspace().string()};
        for (const fs::path& fonts : assets_.fonts) {
            arguments.push_back(fs::absolute(fonts).string());
        }
        std::vector<std::string> settings = {"HOME=" + folder_.path().string(), "LC_ALL=C.UTF-8", "TZ=UTC",
                                             "FONTCONFIG_FILE=" + (folder_.path() / "fonts.conf").string()};
        const system::CleanupLock lock = system::hold_cleanup();
        int failure = 0;
        (void)system::without_network([&] {  // where the kernel does not allow it, the PDF is set all the same
            failure = ::posix_spawn(&child_, arguments[0].c_str(), &actions, &attributes, pointers(arguments).data(),
                                    pointers(settings).data());
        });
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        if (failure != 0) {
            child_ = 0;
            storage_error(arguments[0], std::string("cannot be started: ") + std::strerror(failure),
                          "PDF is set by Typst, which runs in Node.js 18 or later", k_set_up);
        }
        system::remember_child(child_);
        confine();
    }

    /// Before the process reads anything of a template. What it reserves is not counted, what it may write to is.
    void confine() const {
        constexpr rlim_t k_largest_file = rlim_t{1} << 30U;  // [byte]
        constexpr rlim_t k_processor_time = 3600;            // [s], should nobody be there to end it
        const auto limit = [this](auto what, rlim_t most) {
            rlimit wall{};
            if (::prlimit(child_, what, nullptr, &wall) == 0) {
                wall = {std::min(wall.rlim_cur, most), std::min(wall.rlim_max, most)};
                (void)::prlimit(child_, what, &wall, nullptr);
            }
        };
        limit(RLIMIT_DATA, assets_.pdf_memory_limit);
        limit(RLIMIT_FSIZE, k_largest_file);
        limit(RLIMIT_CPU, k_processor_time);
        limit(RLIMIT_CORE, 0);
    }

    static std::vector<char*> pointers(std::vector<std::string>& texts) {
        std::vector<char*> out;
        for (std::string& text : texts) {
            out.push_back(text.data());
        }
        out.push_back(nullptr);
        return out;
    }

    [[nodiscard]] fs::path log_file() const { return folder_.path() / "log.txt"; }

    /// \return true if the child has ended
    bool wait_for_end(int options) {
        pid_t ended = 0;
        do {
            ended = child_ > 0 ? ::waitpid(child_, &status_, options) : -1;
        } while (ended < 0 && child_ > 0 && errno == EINTR);
        if (ended != 0) {
            system::forget_child(child_);
            child_ = 0;
        }
        return child_ == 0;
    }

    /// Waits until the descriptor is ready.
    /// \throws gum::StorageError at the deadline
    void wait_until_ready(int descriptor, short events, Clock::time_point deadline) const {
        for (;;) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
            pollfd waiting{.fd = descriptor, .events = events, .revents = 0};
            const int ready = left <= 0 ? 0 : ::poll(&waiting, 1, static_cast<int>(std::min<long>(left, 3'600'000)));
            if (ready > 0) {
                return;
            }
            if (ready == 0 && Clock::now() >= deadline) {
                storage_error("PDF", "not finished after " + std::to_string(assets_.pdf_time_limit.count()) + " s",
                              "the PDF step has a time limit",
                              "print fewer rows, look for a loop without end in a template of your own, or use HTML");
            }
            if (ready < 0 && errno != EINTR) {
                storage_error("PDF", std::string("waiting for node failed: ") + std::strerror(errno),
                              "the program waits for its child process", "report this as a defect");
            }
        }
    }

    void send(std::string_view text, Clock::time_point deadline) {
        const NoPipeSignal held_back;
        while (!text.empty()) {
            wait_until_ready(input_.number(), POLLOUT, deadline);
            const ssize_t written = ::write(input_.number(), text.data(), text.size());
            if (written > 0) {
                text.remove_prefix(static_cast<std::size_t>(written));
            } else if (written < 0 && errno != EINTR && errno != EAGAIN) {
                ended_early();
            }
        }
    }

    std::string receive_line(Clock::time_point deadline) {
        constexpr std::size_t k_longest_answer = 1'000'000;
        std::string line;
        std::array<char, 4096> part{};
        for (;;) {
            wait_until_ready(output_.number(), POLLIN, deadline);
            const ssize_t count = ::read(output_.number(), part.data(), part.size());
            if (count == 0 || line.size() > k_longest_answer) {
                ended_early();
            }
            if (count < 0) {
                if (errno != EINTR && errno != EAGAIN) {
                    ended_early();
                }
                continue;
            }
            line.append(part.data(), static_cast<std::size_t>(count));
            if (line.back() == '\n') {
                return line;
            }
        }
    }

    /// The signal that ended the child; 0 for none. Its output is closed, so it has ended or will at once.
    int ending_signal() {
        for (int i = 0; i < 100 && !wait_for_end(WNOHANG); ++i) {
            ::usleep(10'000);
        }
        return child_ == 0 && WIFSIGNALED(status_) ? WTERMSIG(status_) : 0;
    }

    [[noreturn]] void ended_early() {
        if (const int signal = ending_signal(); signal != 0) {
            storage_error("PDF", "node was ended by signal " + std::to_string(signal) + " before it answered",
                          "the PDF step answers with a document",
                          "somebody or the system ended it, perhaps for lack of memory: close other programs, and try "
                          "again");
        }
        std::error_code failure;
        std::string said = fs::file_size(log_file(), failure) > 0 && !failure ? read_asset(log_file()) : std::string();
        std::replace(said.begin(), said.end(), '\n', ' ');
        said = shortened(printable(said), 600);
        storage_error("PDF", "node ended before it answered" + (said.empty() ? "" : ": " + said),
                      "the PDF step answers with a document", k_set_up);
    }

    static bool is_full(const nlohmann::json& answer) {
        const std::string code = answer.is_object() ? answer.value("code", std::string()) : std::string();
        return code == "ENOSPC" || code == "EDQUOT" || code == "EROFS";
    }

    static std::string messages(const nlohmann::json& answer) {
        std::string all;
        const auto found = answer.find("messages");
        if (found != answer.end() && found->is_array()) {
            for (const nlohmann::json& text : *found) {
                all += (all.empty() ? "" : "; ") + (text.is_string() ? text.get<std::string>() : std::string());
            }
        }
        return shortened(printable(all), 600);
    }

    const RenderAssets& assets_;
    system::TemporaryFolder folder_;
    Descriptor input_;   ///< requests go in here
    Descriptor output_;  ///< answers come out here
    pid_t child_ = 0;
    int status_ = 0;  ///< of the child, once it has ended
    int documents_ = 0;
    std::uint64_t memory_ = 0;  ///< bytes that were resident after the last document
};

PdfWorker::PdfWorker(RenderAssets assets) : assets_(std::move(assets)) {}
PdfWorker::~PdfWorker() = default;

void PdfWorker::require_ready() const {
    check_installation(assets_);
    for (const char* name : {k_certificate, "render.mjs"}) {
        static_cast<void>(read_asset(assets_.templates / "pdf" / name));
    }
    const system::TemporaryFolder folder = private_folder(assets_.temporary_folder);
    write_file(folder.path() / "fonts.conf", "<fontconfig/>\n");
}

PdfWorker::Process& PdfWorker::running() {
    if (process_ != nullptr && !process_->is_fit()) {
        process_.reset();
    }
    if (process_ == nullptr) {
        check_installation(assets_);
        process_ = std::make_unique<Process>(assets_);
    }
    return *process_;
}

std::vector<TemplateFont> PdfWorker::fonts() {
    try {
        return running().fonts();
    } catch (...) {
        process_.reset();
        throw;
    }
}

std::optional<std::vector<std::string>> PdfWorker::texts_without_glyph(const std::string& view, bool further_fonts) {
    try {
        return running().texts_without_glyph(view, further_fonts);
    } catch (...) {
        process_.reset();
        throw;
    }
}

bool PdfWorker::has_shown(const std::vector<std::string>& characters, bool further_fonts) const {
    const auto shown = shown_.find(further_fonts);
    return shown != shown_.end() && std::ranges::all_of(characters, [&](const std::string& character) {
               return shown->second.contains(character);
           });
}

void PdfWorker::remember_shown(const std::vector<std::string>& characters, bool further_fonts) {
    shown_[further_fonts].insert(characters.begin(), characters.end());
}

std::string PdfWorker::set(const std::string& view, const std::string& attachment, bool further_fonts,
                           const std::string& main) {
    try {
        return running().set(view, attachment, further_fonts, main);
    } catch (const gum::NoResultError&) {
        throw;  // the document is at fault, not the process
    } catch (...) {
        process_.reset();
        throw;
    }
}

}  // namespace gumcert::reports
