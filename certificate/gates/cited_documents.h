#pragma once

namespace gumcert::certificate {

// Documents that findings cite, by the names under which they are published.
inline constexpr const char* k_p8 = "ILAC-P8";
inline constexpr const char* k_p14 = "ILAC-P14:09/2020";

}  // namespace gumcert::certificate
