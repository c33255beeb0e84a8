#include "system/new_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace gumcert::system {
namespace {

namespace fs = std::filesystem;

class NewFileTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) / ("new_file_" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const fs::directory_entry& one : fs::directory_iterator(folder_)) {
            all.push_back(one.path().filename().string());
        }
        std::sort(all.begin(), all.end());
        return all;
    }
    static std::string bytes_of(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }

    fs::path folder_;
};

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
        file.put_in_place([&] { told = bytes_of(folder_ / "a") == "whole"; });
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
    EXPECT_EQ(bytes_of(folder_ / "a"), "of another");
}

TEST_F(NewFileTest, NeedsItsFolder) {
    EXPECT_THROW(NewFile(folder_ / "no" / "a"), std::system_error);
    EXPECT_EQ(names(), std::vector<std::string>());
}

}  // namespace
}  // namespace gumcert::system
