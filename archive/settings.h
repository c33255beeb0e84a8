#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace gumcert::archive {

/// How a laboratory runs its archive. Settings stand in the log: who changed them, when and why is known.
struct Settings {
    /// Nobody reviews or authorises what he has written (ISO/IEC 17025:2017 leaves it to the laboratory).
    bool four_eyes = true;
    /// Pattern of certificate numbers, "EX-YYYY-####": YYYY is the year by UTC, the run of # an ordinal that begins anew
    /// with each year; "": numbers are given elsewhere.
    std::string numbering;
    /// Name → what the person may do: "author", "reviewer", "authoriser", "keeper". Empty: anybody may do everything.
    std::map<std::string, std::set<std::string>> persons = {};

    friend bool operator==(const Settings&, const Settings&) = default;
};

[[nodiscard]] nlohmann::json to_json(const Settings& settings);
/// \return none where the value has another form
[[nodiscard]] std::optional<Settings> settings_from_json(const nlohmann::json& value);

/// "author", "reviewer", "authoriser", "keeper".
[[nodiscard]] bool is_role(std::string_view word);

/// Whether a pattern has one run of #, at most one YYYY, and no other letter that a reader cannot see.
[[nodiscard]] bool is_numbering(std::string_view pattern);
/// The numbers of one year: "EX-2026-####".
/// \param day  of the number, "2026-11-24…"
[[nodiscard]] std::string series_of(const std::string& numbering, std::string_view day);
/// "EX-2026-0042".
/// \param ordinal  from 1
/// \return none where the ordinal has more digits than the series
[[nodiscard]] std::optional<std::string> number_in(const std::string& series, long long ordinal);

}  // namespace gumcert::archive
