#include "signing/external_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

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
constexpr std::size_t k_longest_answer = 1'000'000;  // [byte]

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
    // A process group of its own: what the program starts ends with it.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    // The environment of the caller is not passed on: it could choose other libraries for the program that holds the
    // key.
    std::vector<std::string> environment = {"PATH=/usr/local/bin:/usr/bin:/bin", "LC_ALL=C.UTF-8"};
    pid_t child = 0;
    // A cleanup between the start and the note of its number would miss the child.
    const system::CleanupLock lock = system::hold_cleanup();
    const int failure = ::posix_spawn(&child, command[0].c_str(), &actions, &attributes, pointers(command).data(),
                                      pointers(environment).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        refuse(command[0], std::string("cannot be started: ") + std::strerror(failure));
    }
    system::remember_child(child);
    return child;
}

/// Lends the terminal to a process group, as a shell does: a program that asks for a PIN is stopped without it.
class LentTerminal {
public:
    explicit LentTerminal(pid_t group) : terminal_(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
        lent_ = terminal_.number() >= 0 && ::tcgetpgrp(terminal_.number()) == ::getpgrp() &&
                ::tcsetpgrp(terminal_.number(), group) == 0;
        if (lent_) {
            ::kill(-group, SIGCONT);  // it may have been stopped already
        }
    }
    ~LentTerminal() {
        if (!lent_) {
            return;
        }
        sigset_t output_stop;
        sigset_t before;
        sigemptyset(&output_stop);
        sigaddset(&output_stop, SIGTTOU);  // sent to whoever takes the terminal from behind
        pthread_sigmask(SIG_BLOCK, &output_stop, &before);
        (void)::tcsetpgrp(terminal_.number(), ::getpgrp());
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
    LentTerminal(const LentTerminal&) = delete;
    LentTerminal& operator=(const LentTerminal&) = delete;

private:
    Descriptor terminal_;
    bool lent_ = false;
};

/// The program with what it has started. All of them end when the object goes.
class Child {
public:
    explicit Child(pid_t number) : number_(number), terminal_(number) {}
    ~Child() { end(); }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Whether the program itself has ended; what it has started may go on.
    [[nodiscard]] bool has_ended() const {
        siginfo_t information{};
        return number_ == 0 ||
               ::waitid(P_PID, static_cast<id_t>(number_), &information, WEXITED | WNOHANG | WNOWAIT) != 0 ||
               information.si_pid == number_;
    }
    /// The group first: until the program is waited for, no other group can have its number.
    void end() {
        if (number_ == 0) {
            return;
        }
        ::kill(-number_, SIGKILL);
        while (::waitpid(number_, &status_, 0) < 0 && errno == EINTR) {
        }
        system::forget_child(number_);
        number_ = 0;
    }
    [[nodiscard]] bool succeeded() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }
    [[nodiscard]] std::string status_text() const {
        return WIFEXITED(status_) ? "ended with status " + std::to_string(WEXITSTATUS(status_))
                                  : "was ended by signal " + std::to_string(WTERMSIG(status_));
    }

private:
    pid_t number_;
    LentTerminal terminal_;
    int status_ = 0;
};

/// What has arrived in a pipe that does not block.
/// \return false where its other end is closed
bool take_what_is_there(int pipe, std::string& said) {
    std::array<char, 4096> part{};
    for (;;) {
        const ssize_t count = ::read(pipe, part.data(), part.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return count < 0;
        }
        said.append(part.data(), static_cast<std::size_t>(count));
        if (said.size() > k_longest_answer) {
            return true;
        }
    }
}

void require_short(const std::string& program, const std::string& said) {
    if (said.size() > k_longest_answer) {
        refuse(program, "it says more than a signature");
    }
}

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

    ::fcntl(answer.number(), F_SETFL, O_NONBLOCK);

    // The answer is whole when the program has ended: a process that it left behind may keep the pipe open for ever.
    std::string said;
    bool is_open = true;
    while (!child.has_ended()) {
        if (Clock::now() >= deadline) {
            refuse(command[0], too_long);
        }
        // The end of the program does not wake up poll where another process holds the pipe open, so it is looked at
        // again and again.
        constexpr int k_look_again = 10;  // [ms]
        pollfd waiting{.fd = is_open ? answer.number() : -1, .events = POLLIN, .revents = 0};
        if (::poll(&waiting, 1, k_look_again) > 0) {
            is_open = take_what_is_there(answer.number(), said);
        }
        require_short(command[0], said);
    }
    (void)take_what_is_there(answer.number(), said);
    require_short(command[0], said);
    child.end();
    if (!child.succeeded()) {
        refuse(command[0], child.status_text());
    }
    return said;
}

}  // namespace gumcert::signing
