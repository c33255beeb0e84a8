#include "evaluation/read_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;

class ReadFile : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    const fs::path folder_ = fs::path(testing::TempDir()) / ("read-file-" + std::to_string(getpid()));
};

TEST_F(ReadFile, IsTheWholeFile) {
    const std::string bytes("a\0b\r\n", 5);
    write("a.json", bytes);
    EXPECT_EQ(read_file(folder_ / "a.json"), bytes);
}

TEST_F(ReadFile, RefusesWhatIsNoFile) {
    for (const fs::path& none : {folder_ / "absent.json", folder_, fs::path()}) {
        try {
            static_cast<void>(read_file(none));
            ADD_FAILURE() << none;
        } catch (const gum::StorageError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-STORE-0001");
            EXPECT_FALSE(error.diagnostics().front().where.empty());
        }
    }
}

}  // namespace
}  // namespace gumcert::evaluation
