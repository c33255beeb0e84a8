#include "evaluation/unprintable_characters.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "jobs/json_object.h"
#include "text/place.h"
#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::evaluation {

namespace {

constexpr char32_t k_first_looked_at = 0x100;  // what stands below, every font of a document in these languages has

/// Characters with the places where they stand first, in the order of the files.
class PlacedCharacters {
public:
    /// \param where  the place of an offset
    void add(std::string_view text, const std::function<std::string(std::size_t)>& where) {
        for (std::size_t i = 0; i < text.size();) {
            const text::Character character = text::decode_utf8(text, i);
            if (character.code >= k_first_looked_at && !places_.contains(character.code)) {
                places_.emplace(character.code, where(i));
                characters_.push_back(text::encode_utf8(character.code));
            }
            i += std::max<std::size_t>(character.bytes, 1);
        }
    }
    [[nodiscard]] const std::vector<std::string>& characters() const { return characters_; }
    [[nodiscard]] const std::string& place_of(const std::string& character) const {
        return places_.at(text::decode_utf8(character, 0).code);
    }

private:
    std::map<char32_t, std::string> places_;
    std::vector<std::string> characters_;
};

/// Keys are names of quantities, which are printed, too.
void add_json(const jobs::JsonDocument& document, const nlohmann::json& value, const std::string& pointer,
              PlacedCharacters& found) {
    const auto here = [&](std::size_t) { return document.where(pointer); };
    if (value.is_string()) {
        found.add(value.get_ref<const std::string&>(), here);
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            add_json(document, value[i], pointer + '/' + std::to_string(i), found);
        }
    } else if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            if (!pointer.empty() || (key != "notes" && key != "$schema")) {
                const std::string below = jobs::child_pointer(pointer, key);
                found.add(key, [&](std::size_t) { return document.where(below); });
                add_json(document, member, below, found);
            }
        }
    }
}

/// Whether there can be a character to look at: from U+0100 upwards the first byte of UTF-8 is C4 or more.
bool may_have_any(std::string_view bytes) {
    return bytes.find("\\u") != std::string_view::npos ||
           std::ranges::any_of(bytes, [](char byte) { return static_cast<unsigned char>(byte) >= 0xC4U; });
}

void add_file(const std::string& name, const std::string& bytes, PlacedCharacters& found) {
    if (!may_have_any(bytes)) {
        return;
    }
    if (name.ends_with(".csv")) {
        text::PlaceFinder finder(bytes);
        found.add(bytes.starts_with("\xEF\xBB\xBF") ? std::string_view(bytes).substr(3) : std::string_view(bytes),
                  [&](std::size_t offset) { return text::where_in_text(name, finder.at(offset)); });
    } else if (name.ends_with(".json")) {
        jobs::ProblemList problems(name);
        if (const std::optional<jobs::JsonDocument> document = jobs::read_json_document(bytes, problems)) {
            add_json(*document, document->value, {}, found);
        }
    }
}

}  // namespace

std::vector<gum::Diagnostic> unprintable_characters(const ReadJob& job, const WithoutGlyph& without_glyph) {
    PlacedCharacters found;
    for (const std::string& name : job.names) {
        add_file(name, job.files.read(name), found);
    }
    std::vector<gum::Diagnostic> warnings;
    for (const std::string& character : without_glyph(found.characters())) {
        warnings.push_back(
            {.code = "GC-REPORT-0045",
             .where = found.place_of(character),
             .what = "the character " + text::in_quotes(character) + " (U+" +
                     text::hexadecimal(text::decode_utf8(character, 0).code) + ") is in no font of the PDF",
             .rule = "a document whose characters cannot all be shown is not made; its record is kept",
             .action = "replace the character, put a font that has it into templates/pdf/fonts, or go on "
                       "where this text is not printed",
             .severity = gum::Severity::warning});
    }
    return warnings;
}

}  // namespace gumcert::evaluation
