#include "evaluation/read_file.h"

#include <utility>

#include "encoding/file_bytes.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::evaluation {

std::string read_file(const std::filesystem::path& file) {
    encoding::FileBytes read = encoding::read_regular_file(file, k_largest_file);
    if (read.too_long) {
        read.failure = "it is larger than " + std::to_string(k_largest_file >> 20U) + " MiB";
    }
    if (!read.failure.empty()) {
        throw gum::StorageError(gum::Diagnostic{"GC-STORE-0001", file.empty() ? "the name \"\"" : file.string(),
                                                "cannot be read: " + read.failure,
                                                "a regular file is needed that exists and may be read",
                                                "check the name and the access rights", gum::Severity::error});
    }
    return std::move(read.bytes);
}

}  // namespace gumcert::evaluation
