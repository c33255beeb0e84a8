// Runs every input that lies in the tree through its fuzz target: the seeds in corpus/, and in kept/ what campaigns found.
// The targets are those of libFuzzer; here they are called in turn, in any build and with any compiler.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/replayed_targets.h"
#include "tests/support/file_content.h"

namespace {

using gumcert::fuzz::ReplayedTarget;
using Inputs = std::map<std::string, std::vector<std::filesystem::path>>;  // by target

/// The files below a folder that has one folder a target.
void add_inputs(const std::filesystem::path& folder, Inputs& inputs) {
    if (!std::filesystem::is_directory(folder)) {
        return;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            inputs[entry.path().parent_path().filename().string()].push_back(entry.path());
        }
    }
}

bool passes(const ReplayedTarget& target, const std::filesystem::path& input) {
    const std::string bytes = gumcert::test::file_content(input);
    try {
        return target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()) == 0;
    } catch (const std::exception& error) {
        std::printf("%s: %s\n", input.c_str(), error.what());
        return false;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "tests/fuzz";
    const std::map<std::string, ReplayedTarget> targets = gumcert::fuzz::replayed_targets();
    Inputs inputs;
    add_inputs(folder / "corpus", inputs);
    add_inputs(folder / "kept", inputs);
    std::size_t count = 0, failures = 0;
    for (const auto& [name, target] : targets) {
        if (argc > 1 && name != argv[1]) {
            continue;
        }
        std::vector<std::filesystem::path> own = inputs[name];
        const auto more = inputs.find(target.more_seeds);
        if (more != inputs.end()) {
            own.insert(own.end(), more->second.begin(), more->second.end());
        }
        std::ranges::sort(own);
        if (own.empty()) {
            std::printf("%s: no seed in tests/fuzz/corpus\n", name.c_str());
            ++failures;
        }
        for (const std::filesystem::path& input : own) {
            ++count;
            failures += passes(target, input) ? 0U : 1U;
        }
    }
    for (const auto& [name, files] : inputs) {
        if (!targets.contains(name)) {
            std::printf("%s: no such target, but %zu inputs\n", name.c_str(), files.size());
            ++failures;
        }
    }
    std::printf("%zu inputs of %zu targets, %zu failures\n", count, targets.size(), failures);
    return failures == 0 ? 0 : 1;
}
