#include "app/cli/machine.h"

#include <fmt/core.h>
#include <gnu/libc-version.h>
#include <gumcert_made_with.h>
#include <link.h>
#include <sys/utsname.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <thread>

#include "encoding/sha2.h"
#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::cli {

namespace fs = std::filesystem;

namespace {

/// The value behind a key at the beginning of a line; "" where there is none.
std::string value_in(const char* file, std::string_view key, char sign) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t at = line.find(sign);
        if (!line.starts_with(key) || at == std::string::npos) {
            continue;
        }
        std::string value = line.substr(at + 1);
        std::erase(value, '"');
        return value.substr(std::min(value.find_first_not_of(' '), value.size()));
    }
    return "";
}

utsname kernel() {
    utsname names{};
    return uname(&names) == 0 ? names : utsname{};
}

/// "libceres.so.2.1.0" is version 2.1.0 of libceres; "libz-1.2.so" is named so.
self_test::LibraryVersion library_of(const fs::path& loaded) {
    std::error_code error;
    const fs::path file = fs::canonical(loaded, error);
    const std::string name = (error ? loaded : file).filename().string();
    const std::size_t end = name.find(".so");
    self_test::LibraryVersion library{.name = name.substr(0, end)};
    if (end != std::string::npos && end + 4 < name.size()) {
        library.version = name.substr(end + 4);
    }
    if (library.name == "libc") {
        library.version = gnu_get_libc_version();
    }
    try {
        library.sha256 = encoding::sha256(evaluation::read_file(error ? loaded : file));
    } catch (const gum::DiagnosedError&) {
        library.sha256 = "unknown";  // replaced on the disk since the program began
    }
    return library;
}

int add_loaded(dl_phdr_info* object, std::size_t /*size*/, void* list) {
    const std::string_view name = object->dlpi_name == nullptr ? "" : object->dlpi_name;
    if (name.starts_with('/')) {  // not the program itself, and not what the kernel lends it
        static_cast<std::vector<fs::path>*>(list)->emplace_back(name);
    }
    return 0;
}

}  // namespace

std::string processor() {
    const std::string name = value_in("/proc/cpuinfo", "model name", ':');
    return fmt::format("{}, {} threads", name.empty() ? std::string(kernel().machine) : name,
                       std::thread::hardware_concurrency());
}

std::string operating_system() {
    const utsname names = kernel();
    const std::string distribution = value_in("/etc/os-release", "PRETTY_NAME", '=');
    return fmt::format("{}{}{} {} {}", distribution, distribution.empty() ? "" : ", ", names.sysname, names.release,
                       names.machine);
}

std::vector<self_test::LibraryVersion> libraries_in_use() {
    std::vector<fs::path> loaded;
    (void)dl_iterate_phdr(add_loaded, &loaded);
    std::vector<self_test::LibraryVersion> libraries;
    std::transform(loaded.begin(), loaded.end(), std::back_inserter(libraries), library_of);
    std::sort(libraries.begin(), libraries.end(),
              [](const self_test::LibraryVersion& a, const self_test::LibraryVersion& b) { return a.name < b.name; });
    for (const auto& [name, version] : k_compiled_in) {
        libraries.push_back({.name = std::string(name), .version = std::string(version), .sha256 = {}});
    }
    return libraries;
}

}  // namespace gumcert::cli
