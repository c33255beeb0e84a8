#include "text/rounded_number.h"

#include <charconv>
#include <string>

#include "text/numbers.h"

namespace gumcert::text {

double rounded_number(double value, int digits) {
    const std::string text = significant(value, digits);
    double rounded = value;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded;
}

}  // namespace gumcert::text
