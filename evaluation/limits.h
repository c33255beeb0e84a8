#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::evaluation {

// What commands that read files of others may take where nothing is asked for, for every step begun of a file.
inline constexpr std::uint64_t k_wall_step = 10'000'000;                 ///< [byte]
inline constexpr std::uint64_t k_wall_memory = std::uint64_t{1} << 30U;  ///< [byte], of the largest file
inline constexpr std::uint64_t k_wall_memory_of_file = 262'144;  ///< [byte], what is kept of each until all are read
inline constexpr std::uint64_t k_wall_time = 30;                 ///< [s], of all files together

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
