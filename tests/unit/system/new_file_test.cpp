#include "system/new_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "tests/support/empty_folder.h"
#include "tests/support/file_content.h"

namespace gumcert::system {
namespace {

namespace fs = std::filesystem;

using test::file_content;

class NewFileTest : public test::EmptyFolder {};

TEST_F(NewFileTest, IsThereWholeOrNotAtAll) {
    {
        NewFile file(folder_ / "a");
        std::ofstream(file.part()) << "half";
        EXPECT_FALSE(fs::exists(folder_ / "a"));
    }
    EXPECT_EQ(names(), std::vector<std::string>());
    bool told = false;
    {
        NewFile file(folder_ / "a");
        std::ofstream(file.part()) << "whole";
        file.put_in_place([&] { told = file_content(folder_ / "a") == "whole"; });
    }
    EXPECT_TRUE(told);
    EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(NewFileTest, ReplacesNothing) {
    NewFile file(folder_ / "a");
    std::ofstream(file.part()) << "new";
    std::ofstream(folder_ / "a") << "of another";
    try {
        file.put_in_place();
        FAIL();
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code(), std::errc::file_exists);
    }
    EXPECT_EQ(file_content(folder_ / "a"), "of another");
}

TEST_F(NewFileTest, NeedsItsFolder) {
    EXPECT_THROW(NewFile(folder_ / "no" / "a"), std::system_error);
    EXPECT_EQ(names(), std::vector<std::string>());
}

}  // namespace
}  // namespace gumcert::system
