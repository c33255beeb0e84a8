#include "system/end_of_memory.h"

#include <gtest/gtest.h>
#include <libxml/xmlmemory.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <new>
#include <sstream>

namespace gumcert::system {
namespace {

/// Memory of the process is at its end: everything that malloc has left is taken, and the system gives no more.
void end_memory() {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t now = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
    const rlimit wall{.rlim_cur = now, .rlim_max = now};
    if (setrlimit(RLIMIT_AS, &wall) != 0) {
        std::_Exit(3);
    }
    for (std::size_t size = std::size_t{1} << 20U; size >= 16; size /= 2) {
        while (std::malloc(size) != nullptr) {
        }
    }
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool k_has_memory_of_sanitizer = true;
#else
constexpr bool k_has_memory_of_sanitizer = false;
#endif

/// A process of its own each: memory of this one is wanted.
class EndOfMemory : public ::testing::Test {
protected:
    void SetUp() override {
        if (k_has_memory_of_sanitizer) {
            GTEST_SKIP() << "the sanitizer has a memory of its own";
        }
    }
};

int what_libxml_gets(bool is_prepared) {
    if (is_prepared) {
        prepare_for_end_of_memory();
    }
    end_memory();
    void* const first = xmlMalloc(100'000);
    void* const other = xmlRealloc(first, 200'000);
    return other != nullptr && !memory_has_ended() ? 0 : 1;
}

TEST_F(EndOfMemory, LibrariesGetTheReserve) {
    EXPECT_EXIT(std::_Exit(what_libxml_gets(true)), ::testing::ExitedWithCode(0), "");
    EXPECT_EXIT(std::_Exit(what_libxml_gets(false)), ::testing::ExitedWithCode(1), "");
}

[[noreturn]] void take_more_than_the_reserve() {
    prepare_for_end_of_memory();
    std::set_terminate([] {
        try {
            std::rethrow_exception(std::current_exception());
        } catch (const std::bad_alloc&) {
            std::_Exit(memory_has_ended() ? 5 : 1);
        } catch (...) {
            std::_Exit(2);
        }
    });
    end_memory();
    while (xmlMalloc(100'000) != nullptr) {
    }
    std::_Exit(3);
}

TEST_F(EndOfMemory, EndsTheProcessWhereTheReserveIsUsedUp) {
    EXPECT_EXIT(take_more_than_the_reserve(), ::testing::ExitedWithCode(5), "");
}

TEST_F(EndOfMemory, IsRememberedWhereALibraryGoesOn) {
    prepare_for_end_of_memory();
    require_memory();
    EXPECT_FALSE(memory_has_ended());
    const auto what_a_stream_does = [] {
        end_memory();
        std::ostringstream text;
        text << "a text that is longer than what a string holds in itself";
        std::_Exit(text.bad() && memory_has_ended() ? 0 : 1);
    };
    EXPECT_EXIT(what_a_stream_does(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace gumcert::system
