#include "app/archive/standard_references.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "app/archive/record_parts.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

namespace {

using ReferenceKind = StandardReference::Kind;

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
        const std::string id = standard_of_file(text_of(file, "name"));
        if (id.empty()) {
            return;
        }
        take(ReferenceKind::registered, id);
        reports::InputFile held{.name = {}, .sha256 = {}, .encoding = text_of(file, "encoding")};
        if (const nlohmann::json& content = part_of(file, "content"); content.is_string()) {
            held.content = content.get<std::string>();
        }
        const nlohmann::json standard = nlohmann::json::parse(reports::bytes_of(held).value_or(""), nullptr, false);
        const nlohmann::json& calibrations = part_of(standard, "calibrations");
        for (const nlohmann::json& calibration : calibrations.is_array() ? calibrations : nlohmann::json::array()) {
            take(ReferenceKind::registered, text_of(calibration, "certificate"));
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
                take(ReferenceKind::traceability, text_of(row, "identification"));
                take(ReferenceKind::traceability, text_of(row, "certificate"));
            } else {
                take_texts(ReferenceKind::traceability, row);
            }
        }
    }
};

std::string first_stated(const nlohmann::json& dates, const std::array<const char*, 4>& keys) {
    for (const char* const key : keys) {
        if (std::string day = text_of(dates, key); !day.empty()) {
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
    const nlohmann::json value = nlohmann::json::parse(record, nullptr, false);
    if (!value.is_object()) {
        return std::nullopt;
    }
    ReferenceCollector collector;
    const nlohmann::json& files = part_of(part_of(value, "job"), "files");
    for (const nlohmann::json& file : files.is_array() ? files : nlohmann::json::array()) {
        collector.take_file(file);
    }
    collector.walk(value);
    const nlohmann::json& dates = part_of(part_of(part_of(value, "certificate"), "data"), "dates");
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

}  // namespace gumcert::app
