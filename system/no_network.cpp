#include "system/no_network.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <thread>

namespace gumcert::system {

namespace {

#if defined(__x86_64__)
constexpr unsigned k_architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned k_architecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned k_architecture = 0;  // not tried: the filter is not set
#endif

/// Of the calling thread and of all that it starts.
bool forbid_sockets() {
    if (k_architecture == 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) {
        return false;
    }
    constexpr unsigned k_other_interface = 0x40000000U;  // numbers from here on are a second set of the same calls
    const auto statement = [](unsigned code, unsigned value) {
        return sock_filter{static_cast<unsigned short>(code), 0, 0, value};
    };
    const auto unless = [](unsigned code, unsigned value, unsigned char skipped) {
        return sock_filter{static_cast<unsigned short>(BPF_JMP | code | BPF_K), 0, skipped, value};
    };
    std::array<sock_filter, 10> filter{statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
                                       unless(BPF_JEQ, k_architecture, 6),
                                       statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                                       unless(BPF_JEQ, __NR_socket, 1),
                                       statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EACCES),
                                       unless(BPF_JEQ, __NR_io_uring_setup, 1),  // opens sockets as well
                                       statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
                                       unless(BPF_JGE, k_other_interface, 1),
                                       statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
                                       statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
}

}  // namespace

bool without_network(const std::function<void()>& work) {
    bool forbidden = false;
    try {
        std::thread([&] {
            forbidden = forbid_sockets();
            work();
        }).join();
    } catch (const std::system_error&) {
        work();
    }
    return forbidden;
}

}  // namespace gumcert::system
