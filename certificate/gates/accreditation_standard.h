#pragma once

#include <string>

namespace gumcert::certificate {

/// ISO/IEC 17025 of 2005 or 2017, or the edition of a national body: "DIN EN ISO/IEC 17025:2018-03". As a whole, so
/// that "in the spirit of ISO/IEC 17025" is none.
[[nodiscard]] bool is_of_calibration_laboratories(const std::string& text);

}  // namespace gumcert::certificate
