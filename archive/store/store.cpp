#include "archive/store/store.h"

#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::archive {

std::optional<std::string> Store::content(const std::string& sha256) {
    std::optional<std::string> bytes = stored_bytes(sha256);
    if (bytes && encoding::sha256(*bytes) != sha256) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-ARCHIVE-0012",
                                                .where = name() + ", content " + sha256,
                                                .what = "its bytes have another hash",
                                                .rule = "a record or document is what was archived under its SHA-256",
                                                .action = "see what gumcert archive verify says, and restore the "
                                                          "newest backup that can be verified"});
    }
    return bytes;
}

}  // namespace gumcert::archive
