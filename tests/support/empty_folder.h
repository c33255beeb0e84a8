#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::test {

/// A test with an empty folder of its own, which is removed at the end.
class EmptyFolder : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* const info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  (std::string(info->test_suite_name()) + "_" + info->name() + "_" + std::to_string(getpid()));
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// What stands in the folder, by name.
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const std::filesystem::directory_entry& one : std::filesystem::directory_iterator(folder_)) {
            all.push_back(one.path().filename().string());
        }
        std::sort(all.begin(), all.end());
        return all;
    }

    std::filesystem::path folder_;
};

}  // namespace gumcert::test
