#include "archive/certificates/standard_references.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "certificate/text_words.h"
#include "gum/expression/name.h"
#include "json/members.h"
#include "reports/record/evaluation_record.h"
#include "text/utf8.h"

namespace gumcert::archive {

namespace {

using ReferenceKind = StandardReference::Kind;

/// Whether everything below a key is looked at: what names standards, files of the job, days of the work.
bool is_looked_at(std::string_view key) {
    static constexpr std::array<std::string_view, 7> k_keys{"dates",  "files",    "issuer",   "sensor",
                                                            "source", "standard", "standards"};
    return std::find(k_keys.begin(), k_keys.end(), key) != k_keys.end();
}

/// Makes the value of a text without what nobody looks at: it has the texts below such keys, in their places, and nothing
/// else. Most of a record is numbers and names of members, and to make values of them takes five times as long as to read
/// over them. Callbacks of nlohmann::json::sax_parse().
class TextsOfRecord {
public:
    using number_integer_t = nlohmann::json::number_integer_t;
    using number_unsigned_t = nlohmann::json::number_unsigned_t;
    using number_float_t = nlohmann::json::number_float_t;
    using string_t = nlohmann::json::string_t;
    using binary_t = nlohmann::json::binary_t;

    [[nodiscard]] bool is_object() const { return is_object_; }
    [[nodiscard]] const nlohmann::json& value() const { return value_; }

    bool null() { return true; }
    bool boolean(bool) { return true; }
    bool number_integer(number_integer_t) { return true; }
    bool number_unsigned(number_unsigned_t) { return true; }
    bool number_float(number_float_t, const string_t&) { return true; }
    bool binary(binary_t&) { return true; }
    bool string(string_t& text) {
        if (!open_.empty() && (open_.back().is_kept || is_looked_at(open_.back().key))) {
            add(std::move(text));
        }
        return true;
    }
    bool key(string_t& key) {
        open_.back().key = std::move(key);
        return true;
    }
    bool start_object(std::size_t) { return start(true); }
    bool start_array(std::size_t) { return start(false); }
    bool end_object() { return end(); }
    bool end_array() { return end(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) { return false; }

private:
    /// An object or array that is being read.
    struct Open {
        bool is_object = false;
        bool is_kept = false;       ///< it stands below a key that is looked at
        string_t key = {};          ///< of an object, the last one
        nlohmann::json value = {};  ///< null while nothing of it is kept
    };
    std::vector<Open> open_;
    nlohmann::json value_;
    bool is_object_ = false;

    bool start(bool is_object) {
        is_object_ = open_.empty() ? is_object : is_object_;
        const bool is_kept = !open_.empty() && (open_.back().is_kept || is_looked_at(open_.back().key));
        open_.push_back({.is_object = is_object, .is_kept = is_kept});
        return true;
    }
    bool end() {
        nlohmann::json whole = std::move(open_.back().value);
        open_.pop_back();
        if (open_.empty()) {
            value_ = std::move(whole);
        } else if (!whole.is_null()) {
            add(std::move(whole));
        }
        return true;
    }
    void add(nlohmann::json part) {
        Open& to = open_.back();
        if (to.is_object) {
            to.value[to.key] = std::move(part);
        } else {
            to.value.push_back(std::move(part));
        }
    }
};

class ReferenceCollector {
public:
    void walk(const nlohmann::json& value) {
        if (value.is_array()) {
            for (const nlohmann::json& item : value) {
                walk(item);
            }
        }
        if (!value.is_object()) {
            return;
        }
        for (const auto& [key, item] : value.items()) {
            if (key == "standards") {
                take_rows(item);
            } else if (key == "source" || key == "sensor" || key == "standard") {
                take_texts(ReferenceKind::source, item);
            } else {
                walk(item);
            }
        }
    }

    void take_file(const nlohmann::json& file) {
        const std::string id = standard_of_file(gumcert::json::text_of(file, "name"));
        if (id.empty()) {
            return;
        }
        take(ReferenceKind::registered, id);
        reports::InputFile held{.name = {}, .sha256 = {}, .encoding = gumcert::json::text_of(file, "encoding")};
        if (const nlohmann::json& content = gumcert::json::part_of(file, "content"); content.is_string()) {
            held.content = content.get<std::string>();
        }
        const nlohmann::json standard =
            nlohmann::json::parse(reports::bytes_of(held).value_or(""), nullptr, false, true);
        const nlohmann::json& calibrations = gumcert::json::part_of(standard, "calibrations");
        for (const nlohmann::json& calibration : calibrations.is_array() ? calibrations : nlohmann::json::array()) {
            take(ReferenceKind::registered, gumcert::json::text_of(calibration, "certificate"));
        }
    }

    [[nodiscard]] std::vector<StandardReference> references() && { return std::move(references_); }

private:
    std::vector<StandardReference> references_;
    std::set<std::pair<ReferenceKind, std::string>> known_;

    void take(ReferenceKind kind, const std::string& text) {
        if (!text.empty() && known_.emplace(kind, text).second) {
            references_.push_back({kind, text});
        }
    }
    /// A text, or texts in several languages.
    void take_texts(ReferenceKind kind, const nlohmann::json& value) {
        if (value.is_string()) {
            take(kind, value.get_ref<const std::string&>());
        } else if (value.is_structured()) {
            for (const nlohmann::json& item : value) {
                take_texts(kind, item);
            }
        }
    }
    void take_rows(const nlohmann::json& rows) {
        for (const nlohmann::json& row : rows.is_array() ? rows : nlohmann::json::array({rows})) {
            if (row.is_object()) {
                take(ReferenceKind::traceability, gumcert::json::text_of(row, "identification"));
                take(ReferenceKind::traceability, gumcert::json::text_of(row, "certificate"));
            } else {
                take_texts(ReferenceKind::traceability, row);
            }
        }
    }
};

/// Whether the letters and digits of a name stand in those of a text: "NMI 2026 0117" is NMI-2026-0117 in other words, and
/// NMI-2026-01171 is not.
bool has_letters_of(const std::string& text, const std::string& name) {
    const std::u32string all = certificate::letters_of(text);
    const std::u32string sought = certificate::letters_of(name);
    const std::size_t at = sought.empty() ? std::u32string::npos : all.find(sought);
    const auto is_digit_at = [&](std::size_t i) { return i < all.size() && certificate::is_digit(all[i]); };
    return at != std::u32string::npos && !(certificate::is_digit(sought.back()) && is_digit_at(at + sought.size())) &&
           !(certificate::is_digit(sought.front()) && at > 0 && is_digit_at(at - 1));
}

/// Looks for what a file of a job states of a standard itself.
class OwnStatements {
public:
    explicit OwnStatements(const std::vector<std::string>& standard) : standard_(standard) {}

    void walk(const nlohmann::json& value, const nlohmann::json::json_pointer& at) {
        if (!value.is_structured()) {
            return;
        }
        const bool is_registered = value.is_object() && names_it(gumcert::json::part_of(value, "standard"));
        std::size_t row = 0;
        for (const auto& item : value.items()) {
            const nlohmann::json::json_pointer place = value.is_array() ? at / row++ : at / item.key();
            const bool is_source = value.is_object() && (item.key() == "source" || item.key() == "sensor");
            if (is_source && !is_registered && names_it(item.value())) {
                places_.push_back(place.to_string());
            } else if (value.is_object() && item.key() == "standards" && item.value().is_array()) {
                look_at_rows(item.value(), place);
            } else {
                walk(item.value(), place);
            }
        }
    }
    [[nodiscard]] std::vector<std::string> places() && { return std::move(places_); }

private:
    const std::vector<std::string>& standard_;
    std::vector<std::string> places_;

    /// Of a text, or of texts in several languages.
    [[nodiscard]] bool names_it(const nlohmann::json& value) const {
        if (value.is_string()) {
            const std::string& text = value.get_ref<const std::string&>();
            return std::ranges::any_of(
                standard_, [&](const std::string& name) { return names(text, name) || has_letters_of(text, name); });
        }
        return value.is_structured() &&
               std::any_of(value.begin(), value.end(), [&](const nlohmann::json& item) { return names_it(item); });
    }
    void look_at_rows(const nlohmann::json& rows, const nlohmann::json::json_pointer& at) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (rows[i].is_object() && (names_it(gumcert::json::part_of(rows[i], "identification")) ||
                                        names_it(gumcert::json::part_of(rows[i], "certificate")))) {
                places_.push_back((at / i).to_string());
            }
        }
    }
};

std::string first_stated(const nlohmann::json& dates, const std::array<const char*, 4>& keys) {
    for (const char* const key : keys) {
        if (std::string day = gumcert::json::text_of(dates, key); !day.empty()) {
            return day;
        }
    }
    return "";
}

/// A character that may go on with a name.
struct Neighbour {
    char32_t code = 0;      ///< 0: there is none
    std::size_t bytes = 0;  ///< of it
};

Neighbour character_at(std::string_view text, std::size_t at) {
    if (at >= text.size()) {
        return {};
    }
    const text::Character found = text::decode_utf8(text, at);
    return found.bytes == 0 ? Neighbour{0xFFFD, 1} : Neighbour{found.code, found.bytes};
}

/// \param at  behind it
Neighbour character_before(std::string_view text, std::size_t at) {
    std::size_t first = at;
    while (first > 0 && text::is_continuation(text[first - 1])) {
        --first;
    }
    first -= first > 0 ? std::size_t{1} : std::size_t{0};
    return at == 0 ? Neighbour{} : character_at(text, first);
}

bool is_joined(char32_t code) {
    return code == U'-' || code == U'/' || code == U'_' || code == U'.' || (code >= 0x2010 && code <= 0x2012);
}

/// Letters that follow each other in one word; letters of another script beside a name are another word.
enum class Letters : std::uint8_t { none, western, other, digits };

Letters letters_of(char32_t code) {
    constexpr char32_t k_full_width = 0xFEE0;  // from U+0021 to U+FF01
    const char32_t plain = code >= 0xFF01 && code <= 0xFF5E ? code - k_full_width : code;
    if (plain >= U'0' && plain <= U'9') {
        return Letters::digits;
    }
    const bool is_rare_ideograph = (code >= 0xF900 && code <= 0xFAFF) || (code >= 0x20000 && code <= 0x3FFFF);
    const gum::CharacterClass kind = gum::character_class(plain);
    const bool is_letter = kind == gum::CharacterClass::name_start && plain != U'_';
    constexpr char32_t k_first_of_others = 0x530;
    const bool is_western = plain < k_first_of_others || (plain >= 0x1E00 && plain < 0x2E80);
    return is_rare_ideograph                                          ? Letters::other
           : is_letter || kind == gum::CharacterClass::combining_mark ? (is_western ? Letters::western : Letters::other)
                                                                      : Letters::none;
}

/// Of a script that has no blanks between words, or, as Korean, puts particles behind a name without one: from a letter of it
/// beside another one nobody can tell where a name ends.
bool is_without_blanks(char32_t code) {
    static constexpr std::array<std::pair<char32_t, char32_t>, 14> k_blocks{{
        {0x0E00, 0x0FFF},    // Thai, Lao, Tibetan
        {0x1000, 0x109F},    // Myanmar
        {0x1100, 0x11FF},    // Hangul
        {0x1780, 0x17FF},    // Khmer
        {0x1A20, 0x1AAF},    // Tai Tham
        {0x2E80, 0x2FDF},    // radicals of ideographs
        {0x3005, 0x3007},    // 々〆〇
        {0x3021, 0x31FF},    // kana, bopomofo, Hangul
        {0x3400, 0x4DBF},    // ideographs
        {0x4E00, 0x9FFF},    // ideographs
        {0xA960, 0xD7FF},    // Hangul, Javanese, Myanmar, Tai Viet
        {0xF900, 0xFAFF},    // ideographs
        {0xFF66, 0xFFDC},    // narrow kana and Hangul
        {0x20000, 0x3FFFF},  // ideographs
    }};
    return std::any_of(k_blocks.begin(), k_blocks.end(),
                       [code](const auto& block) { return code >= block.first && code <= block.second; });
}

/// Whether a letter or digit beside a name makes it another name; punctuation of whatever script and blanks of whatever
/// width do not. Where that cannot be told the name is a word of its own: one standard that is missed is worse than one
/// that is looked at in vain.
/// \param edge  the character of the name beside it
bool goes_on(char32_t code, char32_t edge) {
    const Letters beside = letters_of(code);
    if (letters_of(edge) != Letters::other) {
        return beside == Letters::digits || beside == Letters::western;
    }
    return beside == Letters::digits ||
           (beside == Letters::other && !(is_without_blanks(code) && is_without_blanks(edge)));
}

/// Points of Hebrew and Arabic, which are written or not: the word is the same one.
bool is_point_of_a_letter(char32_t code) {
    return (code >= 0x0591 && code <= 0x05BD) || (code >= 0x064B && code <= 0x0652);
}

/// Whether a name ends at a place of a text: what follows is no part of it. "STD-017." ends a sentence.
bool ends_at(std::string_view text, std::size_t at) {
    const char32_t edge = character_before(text, at).code;
    Neighbour next = character_at(text, at);
    while (is_point_of_a_letter(next.code)) {
        at += next.bytes;
        next = character_at(text, at);
    }
    if (gum::character_class(next.code) == gum::CharacterClass::combining_mark) {
        return false;  // it makes another letter of the last one
    }
    const Neighbour behind = is_joined(next.code) ? character_at(text, at + next.bytes) : Neighbour{};
    return !goes_on(next.code, edge) && !goes_on(behind.code, edge);
}

bool begins_at(std::string_view text, std::size_t at) {
    const char32_t edge = character_at(text, at).code;
    const Neighbour before = character_before(text, at);
    const Neighbour behind = is_joined(before.code) ? character_before(text, at - before.bytes) : Neighbour{};
    return !goes_on(before.code, edge) && !goes_on(behind.code, edge);
}

}  // namespace

const char* word_of(StandardReference::Kind kind) {
    return kind == ReferenceKind::registered     ? "register"
           : kind == ReferenceKind::traceability ? "traceability"
                                                 : "source";
}

std::optional<RecordReferences> references_of(std::string_view record) {
    TextsOfRecord texts;
    if (!nlohmann::json::sax_parse(record, &texts) || !texts.is_object()) {
        return std::nullopt;
    }
    const nlohmann::json& value = texts.value();
    ReferenceCollector collector;
    const nlohmann::json& files = gumcert::json::part_of(gumcert::json::part_of(value, "job"), "files");
    for (const nlohmann::json& file : files.is_array() ? files : nlohmann::json::array()) {
        collector.take_file(file);
    }
    collector.walk(value);
    const nlohmann::json& dates =
        gumcert::json::part_of(gumcert::json::part_of(gumcert::json::part_of(value, "certificate"), "data"), "dates");
    std::string used_to = first_stated(dates, {"performed_to", "performed_from", "authorised", "issued"});
    if (used_to.empty()) {  // of the report of a comparison
        used_to = gumcert::json::text_of(gumcert::json::part_of(gumcert::json::part_of(value, "comparison"), "issuer"),
                                         "issued");
    }
    return RecordReferences{.references = std::move(collector).references(),
                            .used_from = gumcert::json::text_of(dates, "performed_from"),
                            .used_to = std::move(used_to)};
}

std::vector<std::string> stated_by_hand(const nlohmann::json& file, const std::vector<std::string>& standard) {
    OwnStatements own(standard);
    own.walk(file, nlohmann::json::json_pointer());
    return std::move(own).places();
}

bool names(std::string_view text, std::string_view name) {
    if (name.empty()) {
        return false;
    }
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
        if (begins_at(text, at) && ends_at(text, at + name.size())) {
            return true;
        }
    }
    return false;
}

std::vector<std::string_view> plain_words_of(std::string_view text) {
    std::vector<std::string_view> words;
    const auto is_plain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    };
    for (auto first = text.begin(); first != text.end();) {
        first = std::find_if(first, text.end(), is_plain);
        const auto last = std::find_if_not(first, text.end(), is_plain);
        if (first != last) {
            words.push_back(
                text.substr(static_cast<std::size_t>(first - text.begin()), static_cast<std::size_t>(last - first)));
        }
        first = last;
    }
    return words;
}

std::string standard_of_file(std::string_view name) {
    constexpr std::string_view folder = "standards/";
    constexpr std::string_view ending = ".json";
    const std::size_t at = name.rfind(folder);
    if (at == std::string_view::npos || (at > 0 && name[at - 1] != '/') || !name.ends_with(ending)) {
        return "";
    }
    const std::string_view file = name.substr(at + folder.size());
    const std::string_view id = file.substr(0, file.size() - ending.size());
    return id.find('/') == std::string_view::npos ? std::string(id) : "";  // a file of a folder below is none
}

}  // namespace gumcert::archive
