#include "app/read_file.h"

#include <array>
#include <fstream>

#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

std::string read_file(const std::filesystem::path& file) {
    std::error_code error;
    std::ifstream stream;
    if (!std::filesystem::is_directory(file, error)) {
        stream.open(file, std::ios::binary);
    }
    std::string bytes;
    if (stream.is_open()) {
        std::array<char, 65536> buffer{};
        while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
            bytes.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
        }
    }
    if (!stream.is_open() || stream.bad()) {
        throw gum::StorageError(gum::Diagnostic{"GC-STORE-0001", file.string(), "cannot be read",
                                                "a file is needed that exists and may be read",
                                                "check the name and the access rights", gum::Severity::error});
    }
    return bytes;
}

}  // namespace gumcert::app
