#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tests/fuzz/demand.h"
#include "text/angle_text.h"

namespace gumcert::fuzz {
namespace {

/// What is read as an angle is a plain decimal number, is printed in parts below 60, and is read back as the same number.
void read_and_print(std::string_view bytes, text::AnglePart last) {
    const auto decimal = text::decimal_of_angle(bytes, last);
    if (!decimal) {
        return;
    }
    demand(text::has_angle_sign(bytes), "an angle without a sign");
    demand(!decimal->empty() && decimal->find_first_not_of("-.0123456789") == std::string::npos,
           "a decimal number that is none");
    demand(decimal->front() != '-' || std::strtod(decimal->c_str(), nullptr) < 0.0, "a negative zero");
    const std::string parts = text::angle_in_parts(*decimal, last);
    demand(parts != *decimal, "a number that is not printed in parts");
    demand(text::decimal_of_angle(parts, last) == decimal, "another number is read back");
}

/// A text that is printed in parts is the number that it was.
void print_and_read(const std::string& decimal, text::AnglePart last) {
    const std::string parts = text::angle_in_parts(decimal, last);
    if (parts == decimal) {
        return;
    }
    if (const auto again = text::decimal_of_angle(parts, last)) {
        demand(std::strtod(again->c_str(), nullptr) == std::strtod(decimal.c_str(), nullptr), "another number");
    } else {
        demand(decimal.size() > 17, "parts that are no angle");  // with more digits than are read
    }
}

}  // namespace
}  // namespace gumcert::fuzz

/// Any text as an angle in degrees, minutes and seconds, and any text as a number that is printed so: no digit is lost.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const text::AnglePart last : {text::AnglePart::minutes, text::AnglePart::seconds}) {
        fuzz::read_and_print(bytes, last);
        fuzz::print_and_read(std::string(bytes), last);
    }
    return 0;
}
