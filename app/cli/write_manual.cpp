// Writes what belongs to the program and is made from its command line: pages of the manual, completion for shells.
// Run by the build: write_manual FOLDER
#include <fmt/core.h>
#include <gumcert_build_info.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <fstream>

#include "app/cli/command_line.h"
#include "manual/command_description.h"
#include "manual/manual_pages.h"
#include "manual/shell_completion.h"

namespace {

namespace fs = std::filesystem;
using namespace gumcert;  // NOLINT(google-build-using-namespace): one program, one file

void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    stream << text;
    stream.close();
}

void write_manual(const fs::path& folder) {
    cli::Arguments none;
    const manual::ProgramDescription program =
        manual::described(*cli::command_line(none, [] { return std::string(k_version); }));
    const manual::ManualImprint imprint{std::string(k_version), std::string(k_day_of_commit), GUMCERT_DESCRIPTION};
    for (const auto& [name, page] : manual::manual_pages(program, imprint)) {
        write(folder / "man1" / name, page);
    }
    write(folder / "completion" / "gumcert", manual::bash_completion(program));
    write(folder / "completion" / "_gumcert", manual::zsh_completion(program));
    write(folder / "completion" / "gumcert.fish", manual::fish_completion(program));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 2) {
            fmt::print(stderr, "usage: write_manual FOLDER\n");
            return 2;
        }
        write_manual(argv[1]);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "write_manual: {}\n", error.what());
        return 1;
    }
}
