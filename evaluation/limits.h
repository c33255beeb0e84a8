#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::evaluation {

/// What a command that reads files of others may take, where nothing else is asked for.
struct Walls {
    std::uint64_t memory = 0;  ///< [byte]
    std::uint64_t time = 0;    ///< [s]
};
/// For every 10 MB begun of a file 1 GiB, the largest of them counting, and 256 KiB for each of them; and 30 s, all of them
/// together. A file that cannot be looked at counts as a small one.
[[nodiscard]] Walls walls_of(const std::vector<std::filesystem::path>& files);
/// For the evaluation of a job that a record of others holds: wide, for sound jobs may take minutes, and an end all the same. A
/// large record has many results, and may take at least what reading it may.
[[nodiscard]] Walls walls_of_evaluation(const std::vector<std::filesystem::path>& records = {});

/// Something that is refused, or ended, beyond a size.
struct Limit {
    std::string_view applies_to;  ///< "jobs of kind budget"; limits of one thing follow each other
    std::string_view what;        ///< "points"
    std::uint64_t most = 0;
    std::string_view unit = {};  ///< "byte", "s"; "" for a number of something

    /// "64 MiB", "100 000", "60 s".
    [[nodiscard]] std::string value() const;
};

/// The limits of this program, from the constants that refuse what is beyond. Numbers that single keys allow stand in
/// docs/job_keys.md.
[[nodiscard]] std::vector<Limit> limits();

/// The same in lines, by what they apply to.
[[nodiscard]] std::string limits_text();

}  // namespace gumcert::evaluation
