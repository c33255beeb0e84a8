#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "encoding/file_bytes.h"
#include "outputs/refusal_log.h"
#include "tests/fuzz/bundle_folder.h"

/// A line with any words behind any text: what is no log stays as it is, and a log has one more line, which is JSON.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    static const fuzz::BundleFolder folder("refusal_log");
    const std::string bytes(data, data + size);
    const std::string before = bytes.substr(0, bytes.find('\n') + 1);
    const std::string words = bytes.substr(before.size());
    folder.fill({});
    folder.write("log", before);
    const std::string failure = outputs::append_refusal(
        folder.file("log"), {.at = "2026-11-24T18:55:00Z", .command = "run", .code = "GC-INPUT-0023", .where = words});
    const std::string after = encoding::read_regular_file(folder.file("log"), size + 10000).bytes;
    if (!failure.empty()) {
        fuzz::demand(after == before, "a file that is no log was changed");
        return 0;
    }
    fuzz::demand(after.starts_with(before) && after.ends_with('\n'), "lines of before were changed");
    const std::string line = after.substr(before.size());
    fuzz::demand(line.find('\n') == line.size() - 1, "more than one line");
    const nlohmann::json read = nlohmann::json::parse(line, nullptr, false);
    fuzz::demand(read.is_object() && read.value("code", "") == "GC-INPUT-0023", "a line that is no JSON");
    return 0;
}
