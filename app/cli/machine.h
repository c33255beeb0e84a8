#pragma once

#include <string>
#include <vector>

#include "self_test/self_test.h"

namespace gumcert::cli {

/// The processor by its name, and how many threads it runs: "Intel(R) Xeon(R), 2 threads".
[[nodiscard]] std::string processor();

/// Distribution and kernel: "Debian GNU/Linux 12 (bookworm), Linux 6.1.0 x86_64".
[[nodiscard]] std::string operating_system();

/// The libraries of this process: those that are loaded, by the names of their files, with SHA-256; then those that are
/// compiled in.
[[nodiscard]] std::vector<self_test::LibraryVersion> libraries_in_use();

}  // namespace gumcert::cli
