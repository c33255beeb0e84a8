#include "jobs/laboratory/registered_differences.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "jobs/json_object.h"
#include "text/numbers.h"

namespace gumcert::jobs {

using nlohmann::json;

std::string in_words(const json& value) {
    constexpr double k_least_plain = 1e-9;
    return value.is_number_float() ? text::shortest_plain(value.get<double>(), k_least_plain) : described(value);
}

namespace {

/// What tells an entry of a list: a text or number, else its id or name, else the beginning of its JSON.
std::string described_entry(const json& entry) {
    if (!entry.is_structured()) {
        return in_words(entry);
    }
    for (const char* key : {"id", "name", "measurand"}) {
        if (const auto found = entry.find(key); entry.is_object() && found != entry.end() && found->is_string()) {
            return described(*found);
        }
    }
    constexpr std::size_t k_longest = 60;
    const std::string text = entry.dump(-1, ' ', true);
    return text.size() > k_longest ? text.substr(0, k_longest) + "…" : text;
}

}  // namespace

void note_differences(const json& stated, const json& registered, const std::string& subject, const std::string& where,
                      std::vector<certificate::LaboratoryRegister::Contradiction>& found) {
    if (stated.is_discarded()) {
        return;  // refused where it was read
    }
    const auto note = [&](const std::string& place, const json* a, const json* b) {
        found.push_back({.where = place,
                         .subject = subject,
                         .stated = a == nullptr ? "nothing" : described_entry(*a),
                         .registered = b == nullptr ? "nothing" : described_entry(*b)});
    };
    if (stated.is_object() && registered.is_object()) {
        for (const auto& [key, value] : stated.items()) {
            const auto other = registered.find(key);
            if (other == registered.end()) {
                note(child_pointer(where, key), &value, nullptr);
            } else if (*other != value) {
                note_differences(value, *other, subject, child_pointer(where, key), found);
            }
        }
        for (const auto& [key, value] : registered.items()) {
            if (!stated.contains(key)) {
                note(child_pointer(where, key), nullptr, &value);
            }
        }
        return;
    }
    if (!stated.is_array() || !registered.is_array()) {
        note(where, &stated, &registered);
        return;
    }
    const auto is_in = [](const json& list, const json& entry) {
        return std::find(list.begin(), list.end(), entry) != list.end();
    };
    const auto is_called_alike = [](const json& a, const json& b) {
        return a.is_object() && b.is_object() && a.contains("id") && b.contains("id") && a["id"] == b["id"];
    };
    const std::size_t before = found.size();
    for (std::size_t i = 0; i < stated.size(); ++i) {
        if (is_in(registered, stated[i])) {
            continue;
        }
        const auto alike = std::find_if(registered.begin(), registered.end(),
                                        [&](const json& other) { return is_called_alike(stated[i], other); });
        if (alike != registered.end()) {
            note_differences(stated[i], *alike, subject, child_pointer(where, i), found);
        } else {
            note(child_pointer(where, i), &stated[i], nullptr);
        }
    }
    for (const json& other : registered) {
        const bool is_known = is_in(stated, other) || std::any_of(stated.begin(), stated.end(), [&](const json& entry) {
                                  return is_called_alike(entry, other);
                              });
        if (!is_known) {
            note(where, nullptr, &other);
        }
    }
    if (found.size() == before) {  // the same entries in another order, or one of them twice
        note(where, &stated, &registered);
    }
}

}  // namespace gumcert::jobs
