#include "signing/external_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "system/cleanup.h"

namespace gumcert::signing {

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void refuse(const std::string& program, const std::string& what) {
    throw gum::StorageError(
        gum::Diagnostic{.code = "GC-SIGN-0020",
                        .where = program,
                        .what = what,
                        .rule = "the signing program gets the digest in hexadecimal on standard input, and answers "
                                "with the signature in Base64 and status 0",
                        .action = "run it by hand to see what it says (docs/signing.md)"});
}

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int number() const { return number_; }
    void close() {
        if (number_ >= 0) {
            ::close(std::exchange(number_, -1));
        }
    }

private:
    int number_;
};

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) {
        out.push_back(text.data());
    }
    out.push_back(nullptr);
    return out;
}

/// The text waits in the pipe, whole, before the program starts: nothing is written to a program that has ended.
std::array<int, 2> filled_pipe(const std::string& program, const std::string& text) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        refuse(program, std::string("no pipe: ") + std::strerror(errno));
    }
    constexpr std::size_t k_fits_every_pipe = 4096;
    if (text.size() > k_fits_every_pipe ||
        ::write(ends[1], text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
        ::close(ends[0]);
        ::close(ends[1]);
        refuse(program, "its input cannot be written");
    }
    ::close(ends[1]);
    return ends;
}

pid_t start(std::vector<std::string> command, int input, int output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    // Standard error stays that of the program: a card may have to ask for its PIN there.
    posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    std::vector<std::string> environment = {"PATH=/usr/local/bin:/usr/bin:/bin", "LC_ALL=C.UTF-8"};
    pid_t child = 0;
    const system::CleanupLock lock = system::hold_cleanup();
    const int failure = ::posix_spawn(&child, command[0].c_str(), &actions, nullptr, pointers(command).data(),
                                      pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        refuse(command[0], std::string("cannot be started: ") + std::strerror(failure));
    }
    system::remember_child(child);
    return child;
}

/// Ends the program, if it has not ended, when the object goes.
class Child {
public:
    explicit Child(pid_t number) : number_(number) {}
    ~Child() {
        if (number_ > 0) {
            ::kill(number_, SIGKILL);
            static_cast<void>(wait_for(0));
        }
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// \return whether it has ended; its status is then in status()
    bool wait_for(int options) {
        pid_t ended = 0;
        do {
            ended = ::waitpid(number_, &status_, options);
        } while (ended < 0 && errno == EINTR);
        if (ended != 0) {
            system::forget_child(number_);
            number_ = 0;
        }
        return number_ == 0;
    }
    [[nodiscard]] bool succeeded() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }
    [[nodiscard]] std::string status_text() const {
        return WIFEXITED(status_) ? "ended with status " + std::to_string(WEXITSTATUS(status_))
                                  : "was ended by signal " + std::to_string(WTERMSIG(status_));
    }

private:
    pid_t number_;
    int status_ = 0;
};

}  // namespace

std::string run_program(const std::vector<std::string>& command, const std::string& input,
                        std::chrono::seconds time_limit) {
    const Clock::time_point deadline = Clock::now() + time_limit;
    const std::string too_long = "no answer within " + std::to_string(time_limit.count()) + " s";
    Descriptor child_input(filled_pipe(command.at(0), input)[0]);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        refuse(command[0], std::string("no pipe: ") + std::strerror(errno));
    }
    const Descriptor answer(ends[0]);
    Descriptor child_output(ends[1]);
    Child child(start(command, child_input.number(), child_output.number()));
    child_input.close();
    child_output.close();

    std::string said;
    std::array<char, 4096> part{};
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd waiting{.fd = answer.number(), .events = POLLIN, .revents = 0};
        const int ready = left <= 0 ? 0 : ::poll(&waiting, 1, static_cast<int>(std::min<long>(left, 3'600'000)));
        if (ready == 0 && Clock::now() >= deadline) {
            refuse(command[0], too_long);
        }
        if (ready <= 0) {
            continue;  // a signal of the own program, or a limit beyond an hour
        }
        const ssize_t count = ::read(answer.number(), part.data(), part.size());
        if (count == 0) {
            break;
        }
        if (count > 0) {
            said.append(part.data(), static_cast<std::size_t>(count));
        }
        if (said.size() > 1'000'000) {
            refuse(command[0], "it says more than a signature");
        }
    }
    // Its output is closed; it may still run.
    while (!child.wait_for(WNOHANG)) {
        if (Clock::now() >= deadline) {
            refuse(command[0], too_long);
        }
        ::usleep(1000);
    }
    if (!child.succeeded()) {
        refuse(command[0], child.status_text());
    }
    return said;
}

}  // namespace gumcert::signing
