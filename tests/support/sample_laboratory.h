#pragma once

#include <map>
#include <string>
#include <string_view>

namespace gumcert::test {

inline constexpr std::string_view k_sample_standard = R"({
  "schema": "gumcert/standard/1", "id": "STD-1", "description": "Voltage standard", "role": "reference",
  "calibrations": [
    {"calibrated": "2025-01-01", "valid_to": "2025-12-31", "certificate": "C-1", "issuer": "Institute", "route": "1",
     "issuer_accreditation": "NMI",
     "results": [{"nominal": 10, "value": 10.001, "unit": "V", "U": 0.002, "k": 2, "nu": 50}]},
    {"calibrated": "2026-01-01", "valid_to": "2026-12-31", "certificate": "C-2", "issuer": "Institute", "route": "1",
     "issuer_accreditation": "NMI",
     "results": [{"nominal": 10, "value": 10.002, "unit": "V", "U": 0.002, "k": 2, "nu": 50}]}],
  "drift": {"model": "limit_per_year", "limit": 0.5, "unit": "mV", "reason": "data sheet"}
})";

inline constexpr std::string_view k_sample_laboratory = R"({
  "schema": "gumcert/laboratory/1",
  "laboratory": {"name": "Laboratory", "address": {"lines": ["Street 1"], "country": "DE"}},
  "accreditation": {"body": "Body", "number": "A-1", "valid_from": "2025-01-01", "valid_to": "2029-12-31",
    "scope": [{"id": "V1", "results": ["y"], "capability": {"form": "value", "unit": "mV", "U": 1}}]},
  "signatories": [
    {"id": "HL", "name": "Head", "function": "Head of laboratory", "from": "2024-01-01", "to": "2026-06-30",
     "methods": ["CP-1"]},
    {"id": "OP", "name": "Operator", "authorises": false}]
})";

/// The files of a laboratory folder, under names that begin with a prefix.
inline std::map<std::string, std::string> sample_laboratory_files(const std::string& prefix) {
    return {{prefix + "laboratory.json", std::string(k_sample_laboratory)},
            {prefix + "standards/STD-1.json", std::string(k_sample_standard)},
            {prefix + "customers/CUST-3.json", R"({"name": "Customer", "contact": "Quality"})"},
            {prefix + "methods/CP-1.json", R"({"identification": "CP-1", "version": "4", "title": "Comparison"})"}};
}

}  // namespace gumcert::test
