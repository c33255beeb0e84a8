#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "archive/certificates/standard_references.h"
#include "archive/settings.h"
#include "archive/store/open_store.h"
#include "tests/fuzz/demand.h"

namespace gumcert::fuzz {
namespace {

void read_settings(std::string_view text) {
    const nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
    if (value.is_discarded()) {
        return;
    }
    if (const std::optional<archive::Settings> settings = archive::settings_from_json(value)) {
        demand(archive::settings_from_json(archive::to_json(*settings)) == settings, "other settings come back");
    }
}

void count_up(const std::string& pattern) {
    if (!archive::is_numbering(pattern)) {
        return;
    }
    const std::string series = archive::series_of(pattern, "2026-11-24T10:00:00Z");
    const auto first = archive::number_in(series, 1), second = archive::number_in(series, 2);
    demand(first && second && *first != *second && first->size() == second->size(), "numbers of a series");
}

void read_references(std::string_view record) {
    if (const auto references = archive::references_of(record)) {
        for (const archive::StandardReference& reference : references->references) {
            demand(archive::word_of(reference.kind) != nullptr, "a kind of reference");
            demand(reference.text.empty() || archive::names(reference.text, reference.text),
                   "a text that is not its name");
        }
    }
}

}  // namespace
}  // namespace gumcert::fuzz

/// Any text as settings of an archive, as a pattern of numbers, as a record that names standards, as a store's address.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const std::string text(data, data + size);
    fuzz::read_settings(text);
    fuzz::count_up(text);
    fuzz::read_references(text);
    const std::string standard = archive::standard_of_file(text);
    fuzz::demand(standard.find('/') == std::string::npos, "a standard with a folder");
    const std::size_t half = text.find('\n');
    if (half != std::string::npos) {
        (void)archive::names(text.substr(0, half), text.substr(half + 1));
    }
    fuzz::demand(!archive::is_postgresql(text) || text.starts_with("postgres"), "an address of a server");
    return 0;
}
