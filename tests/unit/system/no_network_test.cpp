#include "system/no_network.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace gumcert::system {
namespace {

int error_of_socket() {
    const int made = ::socket(AF_INET, SOCK_DGRAM, 0);
    const int error = made < 0 ? errno : 0;
    if (made >= 0) {
        ::close(made);
    }
    return error;
}

TEST(NoNetwork, NeitherTheWorkNorWhatItStartsOpensASocket) {
    const int before = error_of_socket();
    int in_work = -1;
    int in_child = -1;
    std::array<int, 2> pair{-1, -1};
    const bool forbidden = without_network([&] {
        in_work = error_of_socket();
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair.data()), 0) << "which reaches nobody else";
        const pid_t child = ::fork();
        if (child == 0) {
            ::_exit(error_of_socket());
        }
        int status = 0;
        EXPECT_EQ(::waitpid(child, &status, 0), child);
        in_child = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    });
    ::close(pair[0]);
    ::close(pair[1]);
    EXPECT_EQ(error_of_socket(), before) << "other threads are as they were";
    if (!forbidden) {
        GTEST_SKIP() << "the kernel does not allow it here";
    }
    EXPECT_EQ(in_work, EACCES);
    EXPECT_EQ(in_child, EACCES);
}

}  // namespace
}  // namespace gumcert::system
