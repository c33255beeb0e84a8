#include "jobs/certificate/certificate_archive.h"

#include <algorithm>
#include <optional>

#include "certificate/dates.h"
#include "gum/conformity/conformity.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"
#include "jobs/input_text.h"
#include "jobs/job_files.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

using certificate::NumberRule;
using certificate::TextForm;
using nlohmann::json;

constexpr std::size_t k_longest_name = 256;   // [byte]
constexpr std::size_t k_longest_text = 4096;  // [byte]

bool is_line(const std::string& text, std::size_t longest, const CertificatePlace& place) {
    const std::optional<std::string> objection = name_objection(text, longest);
    if (objection) {
        place.refuse(k_certificate_text, "the text " + text::in_quotes(text) + " " + *objection,
                     "a text is one line of 1 to " + std::to_string(longest) +
                         " bytes, without spaces around it and without hidden characters",
                     text.empty() ? "state it, or leave the key out"
                                  : "correct the text; several paragraphs are several entries");
    }
    return !objection;
}

bool is_unit(const std::string& text, const CertificatePlace& place) {
    try {
        (void)gum::Unit::parse(text);
        return true;
    } catch (const gum::InputError& error) {
        const gum::Diagnostic& why = error.diagnostics().front();
        place.refuse(k_certificate_unit, "the unit " + text::in_quotes(text) + ": " + why.what, why.rule, why.action);
        return false;
    }
}

bool is_hexadecimal(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
}

bool is_profile(const std::string& text, const CertificatePlace& place) {
    if (text.ends_with(".json")) {
        return acceptable_text(text, TextForm::file, place);
    }
    const bool good = std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    if (!good) {
        place.refuse(k_certificate_profile, "the profile " + text::in_quotes(text),
                     "a profile has a name of small letters, digits, - and _, such as \"ilac\", or is a file whose "
                     "name ends in .json",
                     "give the name of a profile in templates/profiles, or of a file beside the job");
    }
    return good;
}

/// A rule that a text keeps or breaks as a whole.
bool keeps(bool kept, const InputCode& code, const std::string& text, const std::string& rule, const char* action,
           const CertificatePlace& place) {
    if (!kept) {
        place.refuse(code, text::in_quotes(text), rule, action);
    }
    return kept;
}

bool has_form(const std::string& text, TextForm form, const CertificatePlace& place) {
    switch (form) {
        case TextForm::date:
            return keeps(certificate::calendar_date(text).has_value(), k_certificate_date, text,
                         "a date is a day of the calendar, written year-month-day (ISO 8601)",
                         "write it as in \"2026-11-21\"", place);
        case TextForm::country: {
            const auto capital = [](char c) { return c >= 'A' && c <= 'Z'; };
            return keeps(text.size() == 2 && capital(text[0]) && capital(text[1]), k_certificate_country, text,
                         "a country is a code of two capital letters (ISO 3166-1)", "write it as in \"DE\"", place);
        }
        case TextForm::sha256:
            return keeps(text.size() == 64 && std::all_of(text.begin(), text.end(), is_hexadecimal),
                         k_certificate_sha256, text,
                         "a SHA-256 digest has 64 hexadecimal digits, the letters small (a to f)",
                         "copy the digest of the file, as the command sha256sum prints it", place);
        case TextForm::language:
            return keeps(std::find(certificate::k_languages.begin(), certificate::k_languages.end(), text) !=
                             certificate::k_languages.end(),
                         k_certificate_language, text,
                         "a certificate is printed in \"en\", \"de\", \"zh-Hant\", \"es\"", "use one of these codes",
                         place);
        case TextForm::decision_rule:
            return keeps(gum::decision_rule_from_id(text).has_value(), k_certificate_rule, text,
                         "a decision rule is one of " + text::in_quotes(gum::decision_rule_ids().front()) + " to " +
                             text::in_quotes(gum::decision_rule_ids().back()),
                         "look the rule up in docs/certificate_data.md", place);
        case TextForm::file: {
            const std::optional<std::string> objection = JobFiles::file_name_objection(text);
            return keeps(!objection, k_certificate_file, text, objection ? objection->c_str() : "",
                         "put the file beside the job and give its name", place);
        }
        case TextForm::unit:
            return is_unit(text, place);
        case TextForm::profile:
            return is_profile(text, place);
        case TextForm::name:
        case TextForm::text:
        case TextForm::text_or_none:
            break;
    }
    return true;
}

NumberRange range_of(NumberRule rule) {
    switch (rule) {
        case NumberRule::not_negative:
            return not_negative("");
        case NumberRule::positive:
            return above_zero("");
        case NumberRule::at_least_one:
            return {.low = 1.0, .hint = "a coverage factor is not below 1; check that U is an expanded uncertainty"};
        case NumberRule::one_or_two:
            return between(1.0, 2.0, "");
        case NumberRule::probability:
            return {.low = 0.0,
                    .high = 1.0,
                    .low_open = true,
                    .high_open = true,
                    .hint = "state a probability, not a percentage, such as 0.95"};
        case NumberRule::any:
            break;
    }
    return {};
}

}  // namespace

bool acceptable_text(const std::string& text, TextForm form, const CertificatePlace& place) {
    const bool is_long = form == TextForm::text || form == TextForm::file || form == TextForm::profile;
    return is_line(text, is_long ? k_longest_text : k_longest_name, place) && has_form(text, form, place);
}

bool acceptable_number(double number, NumberRule rule, const CertificatePlace& place) {
    const NumberRange range = range_of(rule);
    const bool whole = rule != NumberRule::one_or_two || number == 1.0 || number == 2.0;
    const bool good = range.contains(number) && whole;
    if (!good) {
        place.refuse(k_certificate_range, range.with_unit(number), whole ? range.rule() : "must be 1 or 2",
                     range.action());
    }
    return good;
}

bool acceptable_word(const std::string& word, std::initializer_list<const char*> words, const CertificatePlace& place) {
    std::vector<std::string_view> known;
    bool good = false;
    for (const std::string_view candidate : words) {
        good = good || candidate == word;
        if (!candidate.empty()) {
            known.push_back(candidate);
        }
    }
    if (!good) {
        std::vector<std::string> quoted;
        for (const std::string_view candidate : known) {
            quoted.push_back("\"" + std::string(candidate) + "\"");
        }
        const std::vector<std::string_view> views(quoted.begin(), quoted.end());
        const auto nearest = nearest_word(word, known);
        place.refuse(k_certificate_word, text::in_quotes(word), "must be " + text::any_of(views),
                     nearest ? "perhaps \"" + std::string(*nearest) + "\" is meant" : "use one of these words");
    }
    return good;
}

void refuse_type(const json& value, std::string_view expected, const CertificatePlace& place) {
    place.refuse(k_certificate_type, described(value), "must be " + std::string(expected),
                 value.is_null()                               ? "leave the key out where there is nothing to state"
                 : value.is_string() && expected == "a number" ? advice_for_number(value.get_ref<const std::string&>())
                                                               : "correct the value");
}

void read_localised(const json& value, certificate::LocalisedText& text, bool may_be_empty,
                    const CertificatePlace& place) {
    if (value.is_string()) {
        const std::string& plain = value.get_ref<const std::string&>();
        if (plain.empty() && may_be_empty) {
            return;
        }
        if (acceptable_text(plain, TextForm::text, place)) {
            text.plain = plain;
        }
        return;
    }
    if (!value.is_object()) {
        refuse_type(value, "a text, or an object with one text a language such as { \"en\": \"…\", \"de\": \"…\" }",
                    place);
        return;
    }
    if (value.empty()) {
        place.refuse(k_certificate_empty_list, "an object without a language",
                     "a text is stated in one language at least", "state the text, or leave the key out");
    }
    for (const auto& [language, item] : value.items()) {
        (void)acceptable_text(language, TextForm::language, place.child(language));
    }
    for (const std::string_view language : certificate::k_languages) {
        const auto found = value.find(language);
        if (found == value.end() || found->is_discarded()) {
            continue;
        }
        const CertificatePlace at = place.child(language);
        if (!found->is_string()) {
            refuse_type(*found, "a text", at);
        } else if (acceptable_text(found->get_ref<const std::string&>(), TextForm::text, at)) {
            text.by_language.emplace_back(language, found->get<std::string>());
        }
    }
}

void read_title(const JsonObject& job, const CertificatePlace& place, certificate::LocalisedText& title) {
    constexpr std::size_t k_longest = 1000;
    const json* stated = job.find("title");
    if (stated != nullptr && stated->is_object()) {
        read_localised(*stated, title, false, place);
    } else {
        title = job.optional_name("title", k_longest).value_or("");
    }
}

void CertificateArchive::require(std::string_view key) const {
    if (!object_.contains(key)) {
        place_.refuse(k_certificate_missing_key, "the key " + text::in_quotes(key) + " is missing",
                      "the entry means nothing without it", "add " + text::in_quotes(key) + ", or remove the entry");
    }
}

void CertificateArchive::unknown_key(const std::string& key) const {
    const auto nearest = nearest_word(key, keys_);
    place_.child(key).refuse(k_certificate_unknown_key, "the key " + text::in_quotes(key),
                             "only keys that the program knows are accepted, so that no statement is lost",
                             nearest ? "perhaps " + text::in_quotes(*nearest) + " is meant"
                                     : "remove it, or look the keys up in docs/certificate_data.md");
}

}  // namespace gumcert::jobs
