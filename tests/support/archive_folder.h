#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "gum/quantity/diagnostic.h"

namespace gumcert::archive::test {

/// A folder for the files of one test.
class StoreFolder {
public:
    StoreFolder() {
        std::string name = (std::filesystem::path(testing::TempDir()) / "gumcert-archive-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error(name + " cannot be made");
        }
        path_ = name;
    }
    ~StoreFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    StoreFolder(const StoreFolder&) = delete;
    StoreFolder& operator=(const StoreFolder&) = delete;

    [[nodiscard]] std::filesystem::path file(const char* name = "a.archive") const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// Code of the first message of what some work throws; "" where it does not.
template <class Work>
std::string code_of(const Work& work) {
    try {
        work();
    } catch (const gum::DiagnosedError& error) {
        return error.diagnostics().front().code;
    }
    return "";
}

}  // namespace gumcert::archive::test
