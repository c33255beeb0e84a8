#pragma once

#include <string>

namespace gumcert::gum {

/// Throws InputError with one Diagnostic "where — what — rule — action".
[[noreturn]] void refuse(std::string code, std::string where, std::string what, std::string rule, std::string action);

/// \throws InputError GC-GUM-0001 if the value is NaN or infinite
void require_finite(double value, const std::string& name);

/// \throws InputError GC-GUM-0001 if not finite, GC-GUM-0002 if negative
void require_not_negative(double value, const std::string& name);

/// \throws InputError GC-GUM-0001 if not finite, GC-GUM-0003 if zero or negative
void require_positive(double value, const std::string& name);

/// \throws InputError GC-GUM-0004 unless 0 < value < 1
void require_probability(double value, const std::string& name);

/// \throws InputError GC-GUM-0005 unless value > 0; infinity is allowed
void require_degrees_of_freedom(double value, const std::string& name);

}  // namespace gumcert::gum
