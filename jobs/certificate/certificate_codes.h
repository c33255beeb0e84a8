#pragma once

#include <array>

#include "jobs/input_codes.h"

namespace gumcert::jobs {

// What is refused in certificate data and in profiles. What makes a text no JSON at all has the codes of input_codes.h.
inline constexpr InputCode k_certificate_unknown_key{"GC-CERT-0101", "a key that certificate data do not have"};
inline constexpr InputCode k_certificate_missing_key{"GC-CERT-0102", "an entry lacks what gives it a meaning"};
inline constexpr InputCode k_certificate_type{"GC-CERT-0103", "a value has another JSON type than its key demands"};
inline constexpr InputCode k_certificate_range{"GC-CERT-0104", "a number is outside the range that its key allows"};
inline constexpr InputCode k_certificate_text{"GC-CERT-0105", "a text is empty, too long or has hidden characters"};
inline constexpr InputCode k_certificate_word{"GC-CERT-0106", "a word that is none of the choices of its key"};
inline constexpr InputCode k_certificate_date{"GC-CERT-0107", "not a date such as 2026-11-21"};
inline constexpr InputCode k_certificate_country{"GC-CERT-0108", "not a country code of two capital letters"};
inline constexpr InputCode k_certificate_unit{"GC-CERT-0109", "not a unit of measurement"};
inline constexpr InputCode k_certificate_sha256{"GC-CERT-0110", "not a SHA-256 digest"};
inline constexpr InputCode k_certificate_language{"GC-CERT-0111", "a language that certificates are not printed in"};
inline constexpr InputCode k_certificate_rule{"GC-CERT-0112", "a decision rule that the program does not know"};
inline constexpr InputCode k_certificate_rule_incomplete{"GC-CERT-0113", "a decision rule that cannot be applied"};
inline constexpr InputCode k_certificate_repeated{"GC-CERT-0114", "an identification is used twice"};
inline constexpr InputCode k_certificate_limits{"GC-CERT-0115", "a lower limit is above its upper limit"};
inline constexpr InputCode k_certificate_no_limit{"GC-CERT-0116", "a specification without a limit"};
inline constexpr InputCode k_certificate_empty_list{"GC-CERT-0117", "a list is empty that must not be"};
inline constexpr InputCode k_certificate_capability{"GC-CERT-0118", "a capability that cannot be used"};
inline constexpr InputCode k_certificate_file{"GC-CERT-0119", "a file name is not a path relative to the job file"};
inline constexpr InputCode k_certificate_symbol{"GC-CERT-0120", "a symbol or logo that is no picture"};
inline constexpr InputCode k_certificate_profile{"GC-CERT-0121", "not the name of a profile"};
inline constexpr InputCode k_certificate_placeholder{
    "GC-CERT-0122", "a sentence has a placeholder that is not known, lacks one, or has a number"};
inline constexpr InputCode k_certificate_contradiction{"GC-CERT-0123", "two statements exclude each other"};
inline constexpr InputCode k_certificate_any_result{"GC-CERT-0124", "a line of the scope that covers any result"};
inline constexpr InputCode k_certificate_section{"GC-CERT-0125", "a section names what job or certificate do not have"};

inline constexpr std::array k_certificate_codes{k_certificate_unknown_key,
                                                k_certificate_missing_key,
                                                k_certificate_type,
                                                k_certificate_range,
                                                k_certificate_text,
                                                k_certificate_word,
                                                k_certificate_date,
                                                k_certificate_country,
                                                k_certificate_unit,
                                                k_certificate_sha256,
                                                k_certificate_language,
                                                k_certificate_rule,
                                                k_certificate_rule_incomplete,
                                                k_certificate_repeated,
                                                k_certificate_limits,
                                                k_certificate_no_limit,
                                                k_certificate_empty_list,
                                                k_certificate_capability,
                                                k_certificate_file,
                                                k_certificate_symbol,
                                                k_certificate_profile,
                                                k_certificate_placeholder,
                                                k_certificate_contradiction,
                                                k_certificate_any_result,
                                                k_certificate_section};

}  // namespace gumcert::jobs
