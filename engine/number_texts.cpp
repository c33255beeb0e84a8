#include "engine/number_texts.h"

#include <array>
#include <charconv>

namespace gumcert::engine {

namespace {

template <typename... Form>
std::string text_of(double value, Form... form) {
    std::array<char, 64> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, form...).ptr;
    return {buffer.data(), end};
}

}  // namespace

std::string shortest_text(double value) {
    return text_of(value);
}

std::string significant_text(double value, int digits) {
    return text_of(value, std::chars_format::general, digits);
}

std::string fixed_text(double value, int decimals) {
    return text_of(value, std::chars_format::fixed, decimals);
}

std::string degrees_text(double degrees) {
    return shortest_text(degrees) + "°";
}

}  // namespace gumcert::engine
