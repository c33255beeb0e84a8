#include "system/machine.h"

#include <gnu/libc-version.h>
#include <link.h>
#include <sys/utsname.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <thread>

namespace gumcert::system {

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
LoadedLibrary library_of(const fs::path& loaded) {
    std::error_code error;
    const fs::path file = fs::canonical(loaded, error);
    const std::string name = (error ? loaded : file).filename().string();
    const std::size_t end = name.find(".so");
    LoadedLibrary library{.name = name.substr(0, end), .file = error ? loaded : file};
    if (end != std::string::npos && end + 4 < name.size()) {
        library.version = name.substr(end + 4);
    }
    if (library.name == "libc") {
        library.version = gnu_get_libc_version();
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
    return (name.empty() ? std::string(kernel().machine) : name) + ", " +
           std::to_string(std::thread::hardware_concurrency()) + " threads";
}

std::string operating_system() {
    const utsname names = kernel();
    const std::string distribution = value_in("/etc/os-release", "PRETTY_NAME", '=');
    return distribution + (distribution.empty() ? "" : ", ") + names.sysname + " " + names.release + " " +
           names.machine;
}

std::vector<LoadedLibrary> loaded_libraries() {
    std::vector<fs::path> loaded;
    (void)dl_iterate_phdr(add_loaded, &loaded);
    std::vector<LoadedLibrary> libraries;
    std::transform(loaded.begin(), loaded.end(), std::back_inserter(libraries), library_of);
    std::sort(libraries.begin(), libraries.end(),
              [](const LoadedLibrary& a, const LoadedLibrary& b) { return a.name < b.name; });
    return libraries;
}

}  // namespace gumcert::system
