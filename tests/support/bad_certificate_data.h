#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/certificate/certificate_codes.h"

namespace gumcert::jobs::test {

/// One mistake in the complete certificate data of certificate_json.h.
struct BadData {
    std::string name;
    std::string pointer;  ///< of the value that is replaced in the complete data; the place of the refusal
    std::string value;    ///< JSON; "" removes the key
    InputCode code;
    std::string message;
    std::string place = {};  ///< where it differs from the pointer

    [[nodiscard]] nlohmann::json in(nlohmann::json data) const {
        const nlohmann::json::json_pointer at(pointer);
        if (value.empty()) {
            data.at(at.parent_pointer()).erase(at.back());
        } else {
            data[at] = nlohmann::json::parse(value);
        }
        return data;
    }
};

inline std::vector<BadData> bad_certificate_data() {
    const std::string hidden = "\"Lab\u202Eoratory\"";
    return {
        {"unknown_key", "/customer/nam", "\"x\"", k_certificate_unknown_key, "perhaps \"name\" is meant"},
        {"unknown_key_far", "/unheard_of", "1", k_certificate_unknown_key, "docs/certificate_data.md"},
        {"filled_key", "/accreditation/symbol_base64", "\"AAAA\"", k_certificate_unknown_key, "symbol_base64"},
        {"own_profile", "/own_profile", "{}", k_certificate_unknown_key, "own_profile"},
        {"no_capability", "/accreditation/scope/1/capability", "", k_certificate_missing_key,
         "the key \"capability\" is missing", "/accreditation/scope/1"},
        {"no_rule", "/specifications/0/rule", "", k_certificate_missing_key, "\"rule\"", "/specifications/0"},
        {"no_results", "/specifications/0/results", "", k_certificate_missing_key, "\"results\"", "/specifications/0"},
        {"no_unit_of_U", "/standards/0/unit", "", k_certificate_missing_key, "an uncertainty without unit",
         "/standards/0/U"},
        {"text_for_object", "/item", "\"Smith\"", k_certificate_type, "must be an object"},
        {"number_for_text", "/number", "17", k_certificate_type, "17 — must be a text"},
        {"text_for_number", "/conditions/0/minimum", "\"19.8\"", k_certificate_type, "must be a number"},
        {"null", "/amendment", "null", k_certificate_type, "leave the key out"},
        {"text_for_boolean", "/adjustment/adjusted", "\"no\"", k_certificate_type, "must be true or false"},
        {"object_for_list", "/standards", "{}", k_certificate_type, "must be an array"},
        {"number_for_localised", "/remarks/0", "3", k_certificate_type, "one text a language"},
        {"number_in_language", "/remarks/0/de", "3", k_certificate_type, "must be a text"},
        {"U_zero", "/standards/0/U", "0", k_certificate_range, "must be greater than 0"},
        {"U_negative", "/conditions/0/U", "-0.1", k_certificate_range, "-0.1"},
        {"k_small", "/standards/0/k", "0.9", k_certificate_range, "must be at least 1"},
        {"probability", "/accreditation/scope/0/capability/coverage_probability", "95", k_certificate_range,
         "not a percentage"},
        {"empty_text", "/customer/contact", "\"\"", k_certificate_text, "is empty"},
        {"line_feed", "/customer/contact", "\"a\\nb\"", k_certificate_text, "U+000A"},
        {"direction", "/laboratory/name", hidden, k_certificate_text, "U+202E"},
        {"space", "/remarks/0/en", "\" x\"", k_certificate_text, "begins with a space"},
        {"long_name", "/item/type", "\"" + std::string(257, 'x') + "\"", k_certificate_text, "257 bytes"},
        {"long_text", "/remarks/0", "\"" + std::string(4097, 'x') + "\"", k_certificate_text, "4097 bytes"},
        {"status", "/status", "\"acredited\"", k_certificate_word, "perhaps \"accredited\" is meant"},
        {"place_kind", "/place/kind", "\"home\"", k_certificate_word, "\"customer_site\""},
        {"route", "/standards/0/route", "\"4\"", k_certificate_word, "\"in_house\" or \"crm\""},
        {"condition_kind", "/conditions/0/kind", "\"temp\"", k_certificate_word, "\"temperature\""},
        {"amendment_kind", "/amendment/kind", "\"amend\"", k_certificate_word, "perhaps \"amended\" is meant"},
        {"item_key", "/item/stated_by_customer/0", "\"serial\"", k_certificate_word, "\"serial_number\""},
        {"date_form", "/dates/issued", "\"21.11.2026\"", k_certificate_date, "write it as in \"2026-11-21\""},
        {"date_day", "/dates/received", "\"2026-02-29\"", k_certificate_date, "a day of the calendar"},
        {"country", "/customer/address/country", "\"at\"", k_certificate_country, "two capital letters"},
        {"country_long", "/laboratory/address/country", "\"DEU\"", k_certificate_country, "DEU"},
        {"unit", "/conditions/0/unit", "\"gradC\"", k_certificate_unit, "the unit \"gradC\""},
        {"unit_of_scope", "/accreditation/scope/0/ranges/0/argument/unit", "\"mmm m\"", k_certificate_unit, "mmm m"},
        {"sha256", "/standards/0/sha256", "\"" + std::string(63, 'a') + "\"", k_certificate_sha256, "64 hexadecimal"},
        {"sha256_letters", "/amendment/sha256", "\"" + std::string(64, 'G') + "\"", k_certificate_sha256, "a to f"},
        {"language", "/languages/1", "\"fr\"", k_certificate_language, "\"fr\""},
        {"language_of_text", "/remarks/0/zh", "\"x\"", k_certificate_language, "\"zh-Hant\""},
        {"rule", "/specifications/0/rule/id", "\"DR-14\"", k_certificate_rule, "DR-14"},
        {"alternative", "/specifications/1/rule/alternative", "\"simple\"", k_certificate_rule, "simple"},
        {"rule_parameter", "/specifications/0/rule/guard_factor", "0.5", k_certificate_rule_incomplete, "guard_factor",
         "/specifications/0/rule"},
        {"scope_id", "/accreditation/scope/1/id", "\"L1\"", k_certificate_repeated, "\"L1\" for the second time"},
        {"specification_id", "/specifications/1/id", "\"length\"", k_certificate_repeated, "\"length\""},
        {"language_twice", "/languages/1", "\"en\"", k_certificate_repeated, "the language \"en\""},
        {"conditions", "/conditions/0/minimum", "20.4", k_certificate_limits, "20.4 degC — must not be above"},
        {"limits_of_method", "/conditions/0/lower_limit", "22", k_certificate_limits, "22 degC"},
        {"limits", "/specifications/0/lower", "50001000", k_certificate_limits, "must be below the upper limit"},
        {"limits_of_points_and_others", "/specifications/0/limits", R"({"by": "points"})", k_certificate_contradiction,
         "a limit for all points beside limits of points", "/specifications/0/lower"},
        {"accuracy_missing", "/specifications/2/limits/accuracy", "", k_certificate_missing_key,
         "\"accuracy\" is missing", "/specifications/2/limits"},
        {"accuracy_part", "/specifications/2/limits/accuracy/0/full_scale", "", k_certificate_missing_key,
         "\"percent_of_range\" without \"full_scale\"", "/specifications/2/limits/accuracy/0"},
        {"accuracy_empty", "/specifications/2/limits/accuracy/0", "{}", k_certificate_no_limit,
         "an accuracy without a part"},
        {"accuracy_unit", "/specifications/2/limits/accuracy/0/unit", "\"V\"", k_certificate_unit,
         "an accuracy and its limits are of one kind"},
        {"two_ways_of_limits", "/specifications/3/limits/expression", "\"L\"", k_certificate_contradiction,
         "limits are stated in one way"},
        {"step_without_mpe", "/specifications/3/limits/steps/0/mpe", "", k_certificate_missing_key, "\"mpe\"",
         "/specifications/3/limits/steps/0"},
        {"expression_of_limits", "/specifications/4/limits/expression", "\"0.1 + W\"", k_certificate_capability, "W"},
        {"range", "/accreditation/scope/0/ranges/0/low", "101", k_certificate_limits, "101 mm"},
        {"no_language", "/languages", "[]", k_certificate_empty_list, "one language at least"},
        {"no_result", "/accreditation/scope/0/results", "[]", k_certificate_empty_list, "names the results"},
        {"no_text", "/remarks/0", "{}", k_certificate_empty_list, "one language at least"},
        {"symbol_name", "/accreditation/symbol_file", "\"/etc/symbol.png\"", k_certificate_file, "relative to the job"},
        {"profile", "/profile", "\"../ilac\"", k_certificate_profile, "templates/profiles"},
        {"profile_file", "/profile", "\"/ilac.json\"", k_certificate_file, "beside the job"},
        {"deviations", "/method/no_deviations", "true", k_certificate_contradiction, "either there are deviations"},
        {"any_result", "/accreditation/scope/0/results/0", "\"*\"", k_certificate_any_result, "covers every result"},
        {"section", "/sections/0/section", "\"width\"", k_certificate_section, "the job has no section"},
        {"standard_of_section", "/sections/0/standards/0", "\"STD-0\"", k_certificate_section,
         "no standard has the identification"},
        {"section_twice", "/sections/1", R"({"section": "length"})", k_certificate_repeated, "for the second time",
         "/sections/1/section"},
    };
}

}  // namespace gumcert::jobs::test
