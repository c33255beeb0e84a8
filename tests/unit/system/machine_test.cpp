#include "system/machine.h"

#include <gmock/gmock.h>
#include <gnu/libc-version.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gumcert::system {
namespace {

TEST(Machine, NamesItsProcessorAndItsSystem) {
    EXPECT_THAT(processor(), testing::MatchesRegex(".+, [0-9]+ threads"));
    EXPECT_THAT(operating_system(), testing::HasSubstr("Linux "));
}

TEST(Machine, HasTheLibrariesOfThisProcessInOrder) {
    const std::vector<LoadedLibrary> libraries = loaded_libraries();
    EXPECT_TRUE(std::is_sorted(libraries.begin(), libraries.end(),
                               [](const LoadedLibrary& a, const LoadedLibrary& b) { return a.name < b.name; }));
    const auto libc =
        std::find_if(libraries.begin(), libraries.end(), [](const LoadedLibrary& one) { return one.name == "libc"; });
    ASSERT_NE(libc, libraries.end());
    EXPECT_EQ(libc->version, gnu_get_libc_version()) << "the name of its file says less";
    for (const LoadedLibrary& one : libraries) {
        EXPECT_TRUE(std::filesystem::is_regular_file(one.file)) << one.file;
        EXPECT_THAT(one.file.filename().string(), testing::StartsWith(one.name));
    }
}

}  // namespace
}  // namespace gumcert::system
