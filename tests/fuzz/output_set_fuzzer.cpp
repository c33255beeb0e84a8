#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "app/output_set.h"

// A manifest or journal: what is accepted names files of its own folder only, and is the same after a round trip.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert::app;
    const std::string bytes(data, data + size);
    const std::optional<SetManifest> manifest = set_manifest_from_json(bytes);
    if (!manifest) {
        return 0;
    }
    for (const FileSet& set : manifest->sets) {
        for (const SetFile& file : set) {
            if (file.name.empty() || file.name.find('/') != std::string::npos || file.name == ".." ||
                file.name == "." || file.part.find('/') != std::string::npos) {
                std::abort();
            }
        }
    }
    const std::string text = to_json(*manifest);
    const std::optional<SetManifest> again = set_manifest_from_json(text);
    if (!again || to_json(*again) != text) {
        std::abort();
    }
    return 0;
}
