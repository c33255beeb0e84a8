#include "app/cli/terminal/interruption.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "app/cli/terminal/terminal.h"
#include "evaluation/limits.h"
#include "system/ceilings.h"
#include "system/cleanup.h"
#include "system/end_of_memory.h"

namespace gumcert::cli {

namespace {

struct Progress {
    std::mutex mutex;
    std::condition_variable settled;
    std::string stage;
    std::string last_written;
    std::size_t written = 0;
    std::string last_entry;
    int entries_under_way = 0;
};

/// Never destroyed: a signal may come while the program is ending.
Progress& progress_until_now() {
    static auto* const progress = new Progress;
    return *progress;
}

std::array<int, 2> signal_pipe{-1, -1};

/// Only what POSIX allows in a handler.
void pass_on(int signal) {
    const int error = errno;
    const auto number = static_cast<unsigned char>(signal);
    (void)!::write(signal_pipe[1], &number, 1);
    while (signal == SIGPIPE) {
        ::pause();  // what was to be written is not needed any more; the other thread ends the program
    }
    errno = error;
}

const char* name_of(int signal) {
    switch (signal) {
        case SIGINT:
            return "SIGINT (Ctrl-C)";
        case SIGTERM:
            return "SIGTERM";
        case SIGHUP:
            return "SIGHUP (the terminal was closed)";
        case SIGXCPU:
            return "SIGXCPU (the limit of processor time)";
        default:
            return "a signal";
    }
}

/// What was written until now, in words.
struct Written {
    std::string what = {};
    bool has_entry = false;
    bool is_known = false;
};

/// \param lock  on the mutex of the progress
Written written_until_now(Progress& progress, std::unique_lock<std::mutex>& lock) {
    constexpr std::chrono::seconds k_patience{2};  // for an entry that is being written
    Written written;
    written.is_known =
        progress.settled.wait_for(lock, k_patience, [&progress] { return progress.entries_under_way == 0; });
    written.has_entry = !progress.last_entry.empty();
    std::vector<std::string> parts;
    if (!written.is_known) {
        parts.emplace_back("whether the entry that was asked for is in the archive is not known");
    } else if (written.has_entry) {
        parts.push_back("in the archive: " + progress.last_entry);
    }
    if (progress.written > 0) {
        parts.push_back("files in their places: " + std::to_string(progress.written) + ", the last one " +
                        progress.last_written);
    }
    written.what = parts.empty() ? "nothing was written" : parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
        written.what += "; " + parts[i];
    }
    return written;
}

void say(int signal, bool cleaned, const CommonOptions& common) {
    Progress& progress = progress_until_now();
    std::unique_lock lock(progress.mutex);  // held for moments
    const Written written = written_until_now(progress, lock);
    const std::string stage = progress.stage.empty() ? "" : ", at: " + progress.stage;
    lock.unlock();
    print_message({.code = "GC-STORE-0021",
                   .where = "gumcert",
                   .what = std::string("ended by ") + name_of(signal) + stage + "; " + written.what,
                   .rule = "outputs of a job appear whole or not at all, and nothing else stays behind",
                   .action = !written.is_known ? "ask again with the same --request-key, or look with gumcert archive "
                                                 "list and show: without a key it would be another request"
                             : written.has_entry ? "look with gumcert archive show, and do not ask for it again"
                             : cleaned           ? "give the command again for the rest"
                                                 : "give the command again; it completes what was being written"},
                  common);
}

void end_by(int signal) {
    const rlimit no_dump{0, 0};
    (void)::setrlimit(RLIMIT_CORE, &no_dump);  // SIGXCPU would leave one
    (void)std::signal(signal, SIG_DFL);
    ::kill(::getpid(), signal);
    for (;;) {
        ::pause();
    }
}

void wait_for_signal(int descriptor, bool json_messages) {
    unsigned char number = 0;
    while (::read(descriptor, &number, 1) != 1) {
        if (errno != EINTR) {
            return;
        }
    }
    const int signal = number;
    constexpr std::chrono::seconds k_patience{20};  // for a set of files that is being put in place
    const system::CleanupLock lock = system::clean_up(k_patience);
    if (signal != SIGPIPE) {  // nobody listens
        say(signal, lock.owns_lock(), {.quiet = false, .json_messages = json_messages, .threads = 0});
    }
    end_by(signal);
}

constexpr const char* k_command = "of this command";

/// \param whose  "of this command"
gum::Diagnostic reached(system::Ceiling which, const CommonOptions& common, const std::string& whose) {
    const bool memory = which == system::Ceiling::memory;
    return {.code = "GC-STORE-0024",
            .where = memory ? "--memory-limit" : "--time-limit",
            .what = memory ? fmt::format("the memory {}, {} MB, is used up", whose, *common.memory_limit / 1'000'000)
                           : fmt::format("the time {}, {} s, is used up", whose, *common.time_limit),
            .rule = "a command keeps its limits, and leaves nothing behind where it cannot",
            .action = memory ? "give it more by --memory-limit, or split the work; 0 is no limit"
                             : "give it more by --time-limit, or split the work; 0 is no limit"};
}

[[noreturn]] void end_at_ceiling(system::Ceiling which, const CommonOptions& common, const std::string& whose) {
    constexpr std::chrono::seconds k_patience{20};  // for a set of files that is being put in place
    const system::CleanupLock lock = system::clean_up(k_patience);
    const gum::Diagnostic why = reached(which, common, whose);
    print_message(why, common);
    log_refusal(why, common);
    std::_Exit(storage_trouble);
}

bool messages_as_json = false;

/// Memory can run out where no exception may leave: in a thread, in a destructor, before main(). What everywhere else
/// becomes an exit code ends the program here; a defect ends it as the language says.
[[noreturn]] void end_at_once() {
    try {
        if (const std::exception_ptr why = std::current_exception()) {
            std::rethrow_exception(why);
        }
    } catch (const std::bad_alloc&) {
        const ExitCode code = tell_of_no_memory(messages_as_json);
        try {
            const system::CleanupLock lock = system::clean_up(std::chrono::seconds(1));
            std::_Exit(code);
        } catch (...) {
            std::_Exit(code);  // what is left is removed by the next command
        }
    } catch (...) {
        std::abort();
    }
    std::abort();
}

/// Before the constants of the program are made, which takes memory.
[[gnu::constructor(101)]] void watch_from_the_beginning() {
    std::set_terminate(end_at_once);
}

}  // namespace

void clean_up_at_signals(bool json_messages) {
    messages_as_json = json_messages;
    (void)progress_until_now();
    (void)system::hold_cleanup();
    if (::pipe2(signal_pipe.data(), O_CLOEXEC) != 0) {
        return;  // signals end the program as they do; the next one removes what it leaves
    }
    try {
        std::thread(wait_for_signal, signal_pipe[0], json_messages).detach();
    } catch (const std::system_error&) {
        return;
    }
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE}) {
        struct sigaction now = {};
        if (::sigaction(signal, nullptr, &now) != 0 || now.sa_handler == SIG_IGN) {
            continue;
        }
        struct sigaction handler = {};
        handler.sa_handler = pass_on;
        handler.sa_flags = SA_RESTART;
        sigemptyset(&handler.sa_mask);
        (void)::sigaction(signal, &handler, nullptr);
    }
}

CommonOptions with_walls(CommonOptions common, const std::vector<std::filesystem::path>& files) {
    const evaluation::Walls walls = evaluation::walls_of(files);
    common.memory_limit = common.memory_limit.value_or(walls.memory);
    common.time_limit = common.time_limit.value_or(walls.time);
    return common;
}

void keep_ceilings(const CommonOptions& common) {
    const system::Ceilings ceilings{.memory = common.memory_limit.value_or(0),
                                    .time = std::chrono::seconds(common.time_limit.value_or(0))};
    system::watch_ceilings(ceilings, [common](system::Ceiling which) { end_at_ceiling(which, common, k_command); });
}

void work_within_walls(const CommonOptions& common, const evaluation::Walls& walls, const std::string& whose,
                       const std::function<void()>& work) {
    const system::Ceilings ceilings{.memory = common.memory_limit ? 0 : walls.memory,
                                    .time = std::chrono::seconds(common.time_limit ? 0 : walls.time)};
    CommonOptions told = common;
    told.memory_limit = walls.memory;
    told.time_limit = walls.time;
    const system::CeilingsOfWork watch(ceilings,
                                       [told, whose](system::Ceiling which) { end_at_ceiling(which, told, whose); });
    work();
}

void work_within_walls(const CommonOptions& common, const std::vector<std::filesystem::path>& files,
                       const std::function<void()>& work) {
    work_within_walls(common, evaluation::walls_of(files), k_command, work);
}

gum::Progress progress_within_walls(const CommonOptions& common, const std::string& record, gum::Progress progress,
                                    const std::vector<std::filesystem::path>& files) {
    if (common.time_limit) {
        return progress;
    }
    CommonOptions told = common;
    told.time_limit = evaluation::walls_of_evaluation(files).time;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(*told.time_limit);
    return [told, end, record, progress = std::move(progress)](const std::string& text) {
        if (std::chrono::steady_clock::now() > end) {
            throw gum::StorageError(reached(system::Ceiling::time, told, "for the evaluation of " + record));
        }
        if (progress) {
            progress(text);
        }
    };
}

void tell_stage(const std::string& text) {
    Progress& progress = progress_until_now();
    const std::lock_guard lock(progress.mutex);
    progress.stage = text;
}

EntryUnderWay::EntryUnderWay() {
    system::require_memory();
    const system::CleanupLock none_after_a_signal = system::hold_cleanup();
    Progress& progress = progress_until_now();
    const std::lock_guard lock(progress.mutex);
    ++progress.entries_under_way;
}

EntryUnderWay::~EntryUnderWay() {
    Progress& progress = progress_until_now();
    const std::lock_guard lock(progress.mutex);
    --progress.entries_under_way;
    progress.settled.notify_all();
}

void EntryUnderWay::is_in_the_log(const std::string& entry) {
    Progress& progress = progress_until_now();
    const std::lock_guard lock(progress.mutex);
    progress.last_entry = entry;
}

void tell_written(const std::filesystem::path& file) {
    Progress& progress = progress_until_now();
    const std::lock_guard lock(progress.mutex);
    progress.last_written = file.string();
    ++progress.written;
}

}  // namespace gumcert::cli
