#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace gumcert::test {

/// The bytes of a file; "" where there is none.
inline std::string file_content(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace gumcert::test
