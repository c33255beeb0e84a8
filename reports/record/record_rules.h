#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "certificate/certificate_fields.h"

namespace gumcert::reports {

// What the writer, the reader and the checks of a record share.

inline constexpr std::array<const char*, 3> k_severities = {"note", "warning", "error"};
/// The parameters of ISO 230-2 that a record may hold.
inline constexpr std::array<const char*, 12> k_positioning_names = {
    "M", "E", "E_up", "E_down", "R", "R_up", "R_down", "B", "B_mean", "A", "A_up", "A_down"};
inline constexpr const char* k_digest_key = "digest";
inline constexpr const char* k_digest_algorithm = "SHA-256";
/// Size of a record as text, [byte]. A budget of 100 000 points and two inputs, the most that a job may have, takes 300 MB.
inline constexpr std::size_t k_max_record_bytes = std::size_t{512} << 20U;

/// "must be greater than 0", for a number that breaks the rule.
[[nodiscard]] const char* text_of_rule(certificate::NumberRule rule);
[[nodiscard]] bool is_allowed(double value, certificate::NumberRule rule);

/// A number as a record has it, and "NaN" or "infinity", which a record cannot have.
[[nodiscard]] std::string record_number(double value);

}  // namespace gumcert::reports
