#include "evaluation/method_library.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;

fs::path new_folder(const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / ("methods_" + name);
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

void write(const fs::path& file, const std::string& bytes) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << bytes;
}

TEST(MethodLibrary, HasTheFilesOfAFolderOrThoseThatAreNamed) {
    const fs::path examples = new_folder("library");
    write(examples / "methods.json", R"({"b": {"title": "B", "folder": "b", "job": "job.json"},
        "a": {"title": "A", "folder": "b", "job": "job.json", "files": ["job.json"]}})");
    for (const char* name : {"job.json", "data.csv", "README.md", "job-record.json"}) {
        write(examples / "b" / name, name);
    }
    const std::vector<Method> methods = method_library(examples);
    ASSERT_EQ(methods.size(), 2U);
    EXPECT_EQ(methods[0].name, "b") << "in the order of the file";
    EXPECT_EQ(methods[0].files, (std::vector<std::string>{"job.json", "data.csv"}));
    EXPECT_EQ(methods[1].files, (std::vector<std::string>{"job.json"}));
    EXPECT_EQ(nearest_method(methods, "nothing like it"), "");
    const fs::path folder = examples / "new";
    EXPECT_EQ(begin_with(methods[0], folder).front(), folder / "job.json");
    EXPECT_TRUE(fs::exists(folder / "data.csv"));
    EXPECT_THROW(begin_with(methods[1], folder), gum::StorageError) << "there is something in it";
}

TEST(MethodLibrary, OfADamagedListIsRefused) {
    const fs::path examples = new_folder("damaged");
    for (const char* text : {"[]", "{", R"({"a": 1})", R"({"a": {"title": "A", "folder": "b"}})"}) {
        write(examples / "methods.json", text);
        EXPECT_THROW((void)method_library(examples), gum::StorageError) << text;
    }
}

}  // namespace
}  // namespace gumcert::evaluation
