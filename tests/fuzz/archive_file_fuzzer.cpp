#include <cstddef>
#include <cstdint>
#include <string_view>

#include "archive/archive.h"
#include "archive/store/open_store.h"
#include "archive/verification.h"
#include "gum/quantity/diagnostic.h"
#include "tests/fuzz/bundle_folder.h"

namespace gumcert::fuzz {
namespace {

void read_archive(const BundleFolder& folder) {
    const auto store = archive::open_store(folder.file("archive.db").string(), archive::Access::read_only);
    archive::Archive read(*store);
    for (const archive::ListedCertificate& certificate : read.list()) {
        demand(!certificate.state.empty(), "a certificate without a state");
        (void)read.history(certificate.number);
    }
    (void)read.settings();
    (void)read.head();
}

}  // namespace
}  // namespace gumcert::fuzz

/// Any bytes as the file of an archive are refused, or are read to the end.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    static const fuzz::BundleFolder folder("archive_file");
    folder.fill({});
    folder.write("archive.db", {reinterpret_cast<const char*>(data), size});
    try {
        fuzz::read_archive(folder);
    } catch (const gum::DiagnosedError& error) {
        fuzz::demand(!error.diagnostics().empty(), "refused without a reason");
        jobs::fuzz::demand_honest(error.diagnostics());
    }
    return 0;
}
