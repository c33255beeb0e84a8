#include "text/plus_sign.h"

namespace gumcert::text {

std::string_view without_plus(std::string_view number) {
    const bool begins =
        number.size() > 1 && number[0] == '+' && ((number[1] >= '0' && number[1] <= '9') || number[1] == '.');
    return number.substr(begins ? 1 : 0);
}

}  // namespace gumcert::text
