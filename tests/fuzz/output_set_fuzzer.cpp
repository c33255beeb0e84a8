#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "outputs/output_set.h"

// A manifest or journal: what is accepted names files of its own folder only, and is the same after a round trip.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    namespace outputs = gumcert::outputs;
    const std::string bytes(data, data + size);
    const std::optional<outputs::SetManifest> manifest = outputs::set_manifest_from_json(bytes);
    if (!manifest) {
        return 0;
    }
    for (const outputs::FileSet& set : manifest->sets) {
        for (const outputs::SetFile& file : set) {
            if (file.name.empty() || file.name.find('/') != std::string::npos || file.name == ".." ||
                file.name == "." || file.part.find('/') != std::string::npos) {
                std::abort();
            }
        }
    }
    const std::string text = outputs::to_json(*manifest);
    const std::optional<outputs::SetManifest> again = outputs::set_manifest_from_json(text);
    if (!again || outputs::to_json(*again) != text) {
        std::abort();
    }
    return 0;
}
