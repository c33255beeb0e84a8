#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace gumcert::fuzz {

struct ReplayedTarget {
    int (*run)(const std::uint8_t*, std::size_t);
    std::string more_seeds;  ///< name of another target whose seeds are those of this one as well; ""
};

/// The fuzz targets by their names; written when the build is configured.
[[nodiscard]] std::map<std::string, ReplayedTarget> replayed_targets();

}  // namespace gumcert::fuzz
