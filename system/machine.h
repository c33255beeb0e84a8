#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gumcert::system {

/// The processor by its name, and how many threads it runs: "Intel(R) Xeon(R), 2 threads".
[[nodiscard]] std::string processor();

/// Distribution and kernel: "Debian GNU/Linux 12 (bookworm), Linux 6.1.0 x86_64".
[[nodiscard]] std::string operating_system();

/// A library that was loaded into this process.
struct LoadedLibrary {
    std::string name = {};     ///< "libceres"
    std::string version = {};  ///< as the name of its file says, "2.1.0"; "" where it says none
    std::filesystem::path file = {};
};

/// Those of this process, by their names.
[[nodiscard]] std::vector<LoadedLibrary> loaded_libraries();

}  // namespace gumcert::system
