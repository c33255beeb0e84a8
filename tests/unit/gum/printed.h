#pragma once

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace gumcert::gum::test {

/// A published number: its value and half a unit of its last printed digit, both from the text, because trailing zeros
/// are digits too ("254.260").
struct Printed {
    double value = 0.0;
    double half_unit = 0.0;
};

inline double number(std::string_view text) {
    double value = 0.0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    EXPECT_TRUE(result.ec == std::errc() && result.ptr == text.data() + text.size()) << "not a number: " << text;
    return value;
}

inline Printed printed(std::string_view text) {
    const std::size_t exponent_sign = text.find_first_of("eE");
    const std::string_view mantissa = text.substr(0, exponent_sign);
    int exponent = 0;
    if (exponent_sign != std::string_view::npos) {
        std::string_view digits = text.substr(exponent_sign + 1);
        if (digits.front() == '+') {
            digits.remove_prefix(1);
        }
        std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    }
    const std::size_t point = mantissa.find('.');
    if (point != std::string_view::npos) {
        exponent -= static_cast<int>(mantissa.size() - point) - 1;
    }
    return {.value = number(text), .half_unit = number("5e" + std::to_string(exponent - 1))};
}

/// The value, rounded, would print these digits (a tie may go either way).
inline ::testing::AssertionResult prints_as(double value, std::string_view text) {
    const Printed expected = printed(text);
    if (std::abs(value - expected.value) <= expected.half_unit * (1.0 + 1e-9)) {
        return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << value << " does not print as " << text;
}

/// Relative difference not above the tolerance.
inline ::testing::AssertionResult agrees(double value, double expected, double relative_tolerance) {
    if (std::abs(value - expected) <= relative_tolerance * std::abs(expected)) {
        return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << value << " differs from " << expected << " by "
                                         << (value - expected) / expected << " relative, allowed "
                                         << relative_tolerance;
}

/// The message of the failure of type Failure that the call ends with; "" and a test failure when there is none.
template <class Failure, class Call>
std::string message_of(Call&& call) {
    try {
        call();
    } catch (const Failure& failure) {
        return failure.what();
    } catch (const std::exception& failure) {
        ADD_FAILURE() << "another failure: " << failure.what();
        return "";
    }
    ADD_FAILURE() << "no failure";
    return "";
}

/// The stable code of the first diagnostic of the failure that the call ends with.
template <class Failure, class Call>
std::string code_of(Call&& call) {
    try {
        call();
    } catch (const Failure& failure) {
        return failure.diagnostics().front().code;
    } catch (const std::exception& failure) {
        ADD_FAILURE() << "another failure: " << failure.what();
        return "";
    }
    ADD_FAILURE() << "no failure";
    return "";
}

}  // namespace gumcert::gum::test
