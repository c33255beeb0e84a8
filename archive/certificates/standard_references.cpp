#include "archive/certificates/standard_references.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "json/members.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::archive {

namespace {

using ReferenceKind = StandardReference::Kind;

/// Whether everything below a key is looked at: what names standards, files of the job, days of the work.
bool is_looked_at(std::string_view key) {
    static constexpr std::array<std::string_view, 6> k_keys{"dates",  "files",    "sensor",
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
        const nlohmann::json standard = nlohmann::json::parse(reports::bytes_of(held).value_or(""), nullptr, false);
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

std::string first_stated(const nlohmann::json& dates, const std::array<const char*, 4>& keys) {
    for (const char* const key : keys) {
        if (std::string day = gumcert::json::text_of(dates, key); !day.empty()) {
            return day;
        }
    }
    return "";
}

bool is_letter_or_digit(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           static_cast<unsigned char>(c) >= 0x80U;
}

bool joins(char c) {
    return c == '-' || c == '/' || c == '_' || c == '.';
}

/// Whether a name ends at a place of a text: what follows is no part of it. "STD-017." ends a sentence.
bool ends_at(std::string_view text, std::size_t at) {
    return at >= text.size() || (!is_letter_or_digit(text[at]) &&
                                 !(joins(text[at]) && at + 1 < text.size() && is_letter_or_digit(text[at + 1])));
}

bool begins_at(std::string_view text, std::size_t at) {
    return at == 0 ||
           (!is_letter_or_digit(text[at - 1]) && !(joins(text[at - 1]) && at >= 2 && is_letter_or_digit(text[at - 2])));
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
    return RecordReferences{
        .references = std::move(collector).references(),
        .used_from = first_stated(dates, {"performed_from", "performed_to", "authorised", "issued"}),
        .used_to = first_stated(dates, {"performed_to", "performed_from", "authorised", "issued"})};
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
