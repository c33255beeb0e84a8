#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/file_content.h"

namespace gumcert::test {

/// The seeds of a fuzz target, in the order of their names.
inline std::vector<std::string> fuzz_corpus(const std::string& target) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(GUMCERT_SOURCE_DIR) /
                                                                 "tests/fuzz/corpus" / target)) {
        paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> seeds;
    for (const auto& path : paths) {
        seeds.push_back(file_content(path));
    }
    return seeds;
}

}  // namespace gumcert::test
