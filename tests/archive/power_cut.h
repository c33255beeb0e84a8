#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/archive/observed_disk.h"

namespace gumcert::archive::test {

/// Files of a folder: name → bytes.
using DiskImage = std::map<std::string, std::string>;

/// What is on the disk when the power ends behind some calls. What was synchronised is there. Of everything else any part
/// may be: each sector of 512 bytes of each write is the new one, the old one, a piece of both, or rubbish; a file may have
/// any of the sizes that it had since; a name may belong to any file that it belonged to since, or to none. Bytes beside
/// those that were written stay as they are.
/// \param before  durable
/// \param number  of calls that came before the end
DiskImage image_after_power_cut(const DiskImage& before, const std::vector<DiskCall>& calls, std::size_t number,
                                std::mt19937_64& random);

/// Files of a folder but for "-shm", which is memory: of it something is left, or nothing, and that means nothing.
DiskImage read_image(const std::filesystem::path& folder);
void write_image(const DiskImage& image, const std::filesystem::path& folder, std::mt19937_64& random);

}  // namespace gumcert::archive::test
