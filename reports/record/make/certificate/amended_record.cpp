#include "reports/record/make/certificate/amended_record.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "certificate/certificate_fields.h"
#include "encoding/sha2.h"
#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using certificate::Change;

using Texts = std::vector<std::pair<std::string, std::string>>;

/// Walks certificate data and writes down every leaf that is stated, with its place.
class StatedTexts {
public:
    explicit StatedTexts(Texts& found, std::string at = "") : found_(found), at_(std::move(at)) {}

    template <class Type, class... Rule>
    void operator()(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void operator()(const char* key, const Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v);
    }
    template <class Type, class... Rule>
    void needed(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void needed(const char* key, const Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v);
    }
    template <class Type, class... Rule>
    void stated(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void stated(const char* key, const Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v);
    }
    template <class Type, class... Rule>
    void added(const char* key, const Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void filled(const char*, const Type&) {}
    template <class Type>
    void filled_if_any(const char*, const Type&) {}

private:
    Texts& found_;
    std::string at_;

    void note(const std::string& at, const std::string& text) {
        if (!text.empty()) {
            found_.emplace_back(at, text);
        }
    }

    template <class Type>
    void look(const std::string& at, const Type& v) {
        if constexpr (std::same_as<Type, std::string>) {
            note(at, v);
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            note(at, v.plain);
            for (const auto& [language, text] : v.by_language) {
                note(at + "/" + language, text);
            }
        } else if constexpr (std::same_as<Type, bool>) {
            note(at, v ? "true" : "false");
        } else if constexpr (std::is_arithmetic_v<Type>) {
            note(at, text::shortest_plain(static_cast<double>(v)));
        } else if constexpr (requires { v.has_value(); }) {
            if (v) {
                look(at, *v);
            }
        } else if constexpr (std::same_as<Type, std::pair<double, double>>) {
            look(at + "/0", v.first);
            look(at + "/1", v.second);
        } else if constexpr (requires { v.size(); }) {
            for (std::size_t i = 0; i < v.size(); ++i) {
                look(at + "/" + std::to_string(i), v[i]);
            }
        } else {
            StatedTexts inside(found_, at);
            describe(inside, v);
        }
    }
};

/// What differs between any two certificates, and what says nothing of the calibration.
bool is_left_out(std::string_view at) {
    static constexpr std::array<std::string_view, 4> k_left_out = {"/number", "/dates/issued", "/dates/authorised",
                                                                   "/annexes"};
    return at.starts_with("/amendment/") || std::find(k_left_out.begin(), k_left_out.end(), at) != k_left_out.end();
}

std::string text_at(const Texts& texts, const std::string& at) {
    const auto found = std::find_if(texts.begin(), texts.end(), [&](const auto& t) { return t.first == at; });
    return found == texts.end() ? "" : found->second;
}

void compare_texts(const Certificate& earlier, const Certificate& later, std::vector<Change>& changes) {
    Texts before;
    Texts after;
    StatedTexts of_earlier(before);
    describe(of_earlier, earlier.data);
    StatedTexts of_later(after);
    describe(of_later, later.data);
    for (const auto& [at, text] : after) {
        if (const std::string old = text_at(before, at); !is_left_out(at) && old != text) {
            changes.push_back({.kind = "text", .where = at, .before = old, .after = text});
        }
    }
    for (const auto& [at, text] : before) {
        if (!is_left_out(at) && text_at(after, at).empty()) {
            changes.push_back({.kind = "text", .where = at, .before = text, .after = ""});
        }
    }
}

/// One certified value with what is printed of it.
struct Place {
    std::string table, result, point;
    const CertifiedColumn* column;
    const CertifiedValue* value;

    [[nodiscard]] bool is_as(const Place& other) const {
        return table == other.table && result == other.result && point == other.point;
    }
    [[nodiscard]] std::string name() const { return point.empty() ? result : result + " [" + point + "]"; }
};

std::vector<Place> places_of(const Certificate& certificate) {
    std::vector<Place> places;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (std::size_t i = 0; i < column.values.size(); ++i) {
                const bool at_points = table.argument && i < table.argument->printed.size();
                places.push_back({.table = table.id,
                                  .result = column.result,
                                  .point = at_points ? table.argument->printed[i] : "",
                                  .column = &column,
                                  .value = &column.values[i]});
            }
        }
    }
    return places;
}

std::string with_unit_of(const std::string& number, const CertifiedColumn& column) {
    return number.empty() || column.printed_unit.empty() ? number : number + "\u00A0" + column.printed_unit;
}

std::string interval_of(const Place& place) {
    const CertifiedValue& v = *place.value;
    return v.printed_low.empty()
               ? ""
               : with_unit_of(v.printed_low, *place.column) + " … " + with_unit_of(v.printed_high, *place.column);
}

const CertifiedValue& of(const Place& place) {
    return *place.value;
}

void compare_values(const Place& earlier, const Place& later, std::vector<Change>& changes) {
    const auto compare = [&](const char* kind, const std::string& before, const std::string& after) {
        if (before != after) {
            changes.push_back({.kind = kind, .where = later.name(), .before = before, .after = after});
        }
    };
    compare("value", with_unit_of(of(earlier).printed_value, *earlier.column),
            with_unit_of(of(later).printed_value, *later.column));
    compare("U", with_unit_of(of(earlier).printed_U, *earlier.column),
            with_unit_of(of(later).printed_U, *later.column));
    compare("k", of(earlier).printed_k, of(later).printed_k);
    compare("interval", interval_of(earlier), interval_of(later));
    const auto verdict = [](const Place& p) { return of(p).verdict ? of(p).verdict->verdict : std::string(); };
    compare("verdict", verdict(earlier), verdict(later));
}

void compare_results(const Certificate& earlier, const Certificate& later, std::vector<Change>& changes) {
    const std::vector<Place> before = places_of(earlier);
    const std::vector<Place> after = places_of(later);
    const auto same_in = [](const std::vector<Place>& places, const Place& wanted) {
        const auto found = std::find_if(places.begin(), places.end(), [&](const Place& p) { return p.is_as(wanted); });
        return found == places.end() ? nullptr : &*found;
    };
    for (const Place& place : after) {
        if (const Place* const old = same_in(before, place)) {
            compare_values(*old, place, changes);
        } else {
            changes.push_back({.kind = "value",
                               .where = place.name(),
                               .before = "",
                               .after = with_unit_of(of(place).printed_value, *place.column)});
        }
    }
    for (const Place& place : before) {
        if (same_in(after, place) == nullptr) {
            changes.push_back({.kind = "value",
                               .where = place.name(),
                               .before = with_unit_of(of(place).printed_value, *place.column),
                               .after = ""});
        }
    }
}

[[noreturn]] void refuse(const char* code, const std::string& where, std::string what, std::string rule,
                         std::string action) {
    throw gum::InputError(gum::Diagnostic{
        .code = code, .where = where, .what = std::move(what), .rule = std::move(rule), .action = std::move(action)});
}

}  // namespace

std::vector<Change> changes_between(const Certificate& earlier, const Certificate& later) {
    std::vector<Change> changes;
    compare_results(earlier, later, changes);
    compare_texts(earlier, later, changes);
    return changes;
}

void state_changes(EvaluationRecord& record) {
    Certificate& certificate = *record.certificate;
    if (!certificate.data.amendment || certificate.data.amendment->record.empty()) {
        return;
    }
    const certificate::Amendment& amendment = *certificate.data.amendment;
    const auto file = std::find_if(record.job_files.begin(), record.job_files.end(),
                                   [&](const InputFile& f) { return f.name == amendment.record; });
    const std::optional<std::string> bytes = file == record.job_files.end() ? std::nullopt : bytes_of(*file);
    if (!bytes) {
        refuse("GC-CERT-0307", amendment.record, "a record that is not held", "a record of at most 8 MiB is compared",
               "leave \"record\" out of the amendment, and state the changes");
    }
    const EvaluationRecord earlier = record_from_json(*bytes, amendment.record);
    const std::string number = earlier.certificate ? earlier.certificate->data.number : "";
    if (!earlier.certificate || number != amendment.number) {
        refuse(
            "GC-CERT-0307", amendment.record,
            earlier.certificate ? "the record of certificate \"" + number + "\"" : "a record without certificate data",
            "the amendment is to certificate \"" + amendment.number + "\"",
            "name the record of that certificate, or correct the number");
    }
    certificate.changes = changes_between(*earlier.certificate, certificate);
    certificate.amended_record_sha256 = encoding::sha256(*bytes);
    if (certificate.changes.empty()) {
        refuse("GC-CERT-0308", amendment.record, "nothing that the certificate states has changed",
               "an amendment changes something (ISO/IEC 17025:2017, 7.8.8.1)",
               "change what is to be amended, or leave the amendment out");
    }
}

}  // namespace gumcert::reports
