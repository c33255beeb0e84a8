#include "archive/settings.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "text/utf8.h"

namespace gumcert::archive {

namespace {

constexpr std::string_view k_year = "YYYY";

}  // namespace

bool is_role(std::string_view word) {
    static constexpr std::array<std::string_view, 4> k_roles = {"author", "reviewer", "authoriser", "keeper"};
    return std::find(k_roles.begin(), k_roles.end(), word) != k_roles.end();
}

nlohmann::json to_json(const Settings& settings) {
    nlohmann::json persons = nlohmann::json::object();
    for (const auto& [name, roles] : settings.persons) {
        persons[name] = roles;
    }
    return {{"four_eyes", settings.four_eyes}, {"numbering", settings.numbering}, {"persons", persons}};
}

std::optional<Settings> settings_from_json(const nlohmann::json& value) {
    if (!value.is_object() || value.size() != 3 || !value.contains("four_eyes") || !value["four_eyes"].is_boolean() ||
        !value.contains("numbering") || !value["numbering"].is_string() || !value.contains("persons") ||
        !value["persons"].is_object()) {
        return std::nullopt;
    }
    Settings settings{.four_eyes = value["four_eyes"].get<bool>(), .numbering = value["numbering"].get<std::string>()};
    if (!settings.numbering.empty() && !is_numbering(settings.numbering)) {
        return std::nullopt;
    }
    for (const auto& [name, roles] : value["persons"].items()) {
        if (!roles.is_array()) {
            return std::nullopt;
        }
        std::set<std::string>& own = settings.persons[name];
        for (const nlohmann::json& role : roles) {
            if (!role.is_string() || !is_role(role.get_ref<const std::string&>())) {
                return std::nullopt;
            }
            own.insert(role.get<std::string>());
        }
    }
    return settings;
}

bool is_numbering(std::string_view pattern) {
    const std::size_t run = pattern.find('#');
    if (run == std::string_view::npos || !text::is_utf8(pattern)) {
        return false;
    }
    const std::size_t end = pattern.find_first_not_of('#', run);
    const bool one_run = end == std::string_view::npos || pattern.find('#', end) == std::string_view::npos;
    const std::size_t year = pattern.find(k_year);
    const bool one_year =
        year == std::string_view::npos || pattern.find(k_year, year + k_year.size()) == std::string_view::npos;
    bool visible = true;
    for (std::size_t at = 0; at < pattern.size();) {
        const text::Character character = text::decode_utf8(pattern, at);
        visible = visible && !text::is_hidden(character.code);
        at += character.bytes;
    }
    return one_run && one_year && visible;
}

std::string series_of(const std::string& numbering, std::string_view day) {
    std::string series = numbering;
    if (const std::size_t year = series.find(k_year); year != std::string::npos) {
        series.replace(year, k_year.size(), day.substr(0, k_year.size()));
    }
    return series;
}

std::optional<std::string> number_in(const std::string& series, long long ordinal) {
    const std::size_t run = series.find('#');
    if (run == std::string::npos || ordinal < 1) {
        return std::nullopt;
    }
    const std::size_t end = std::min(series.find_first_not_of('#', run), series.size());
    const std::string digits = std::to_string(ordinal);
    if (digits.size() > end - run) {
        return std::nullopt;
    }
    return series.substr(0, run) + std::string(end - run - digits.size(), '0') + digits + series.substr(end);
}

}  // namespace gumcert::archive
