#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace gumcert::gum {

/// What a node of a syntax tree is. Those from negate to hypot are steps of the compiled tape, too.
enum class Operation : std::uint8_t {
    number,
    pi,
    quantity,
    // of one argument
    negate,
    absolute,
    sqrt,
    exp,
    ln,
    log10,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    sinh,
    cosh,
    tanh,
    celsius,  ///< thermodynamic → Celsius temperature
    kelvin,   ///< Celsius → thermodynamic temperature
    // of two
    add,
    subtract,
    multiply,
    divide,
    power,
    atan2,
    minimum,
    maximum,
    hypot,
};

[[nodiscard]] constexpr bool is_binary(Operation operation) {
    return operation >= Operation::add;
}
[[nodiscard]] constexpr bool is_unary(Operation operation) {
    return operation >= Operation::negate && operation < Operation::add;
}

/// Takes one of two values, by which of them is larger: there the model has a kink.
[[nodiscard]] constexpr bool is_choice(Operation operation) {
    return operation == Operation::absolute || operation == Operation::minimum || operation == Operation::maximum;
}

inline constexpr double k_ice_point = 273.15;  ///< K: t/°C = T/K − 273.15 (SI brochure, 9th edition, 2.3.1)

/// The value of a step. One function for single evaluations and for trials, so that both agree to the last bit.
template <Operation operation>
[[nodiscard]] inline double apply([[maybe_unused]] double a, [[maybe_unused]] double b) {
    using enum Operation;
    if constexpr (operation == negate) {
        return -a;
    } else if constexpr (operation == absolute) {
        return std::fabs(a);
    } else if constexpr (operation == Operation::sqrt) {
        return std::sqrt(a);
    } else if constexpr (operation == Operation::exp) {
        return std::exp(a);
    } else if constexpr (operation == ln) {
        return std::log(a);
    } else if constexpr (operation == Operation::log10) {
        return std::log10(a);
    } else if constexpr (operation == Operation::sin) {
        return std::sin(a);
    } else if constexpr (operation == Operation::cos) {
        return std::cos(a);
    } else if constexpr (operation == Operation::tan) {
        return std::tan(a);
    } else if constexpr (operation == Operation::asin) {
        return std::asin(a);
    } else if constexpr (operation == Operation::acos) {
        return std::acos(a);
    } else if constexpr (operation == Operation::atan) {
        return std::atan(a);
    } else if constexpr (operation == Operation::sinh) {
        return std::sinh(a);
    } else if constexpr (operation == Operation::cosh) {
        return std::cosh(a);
    } else if constexpr (operation == Operation::tanh) {
        return std::tanh(a);
    } else if constexpr (operation == celsius) {
        return a - k_ice_point;
    } else if constexpr (operation == kelvin) {
        return a + k_ice_point;
    } else if constexpr (operation == add) {
        return a + b;
    } else if constexpr (operation == subtract) {
        return a - b;
    } else if constexpr (operation == multiply) {
        return a * b;
    } else if constexpr (operation == divide) {
        return a / b;
    } else if constexpr (operation == power) {
        return std::pow(a, b);
    } else if constexpr (operation == Operation::atan2) {
        return std::atan2(a, b);
    } else if constexpr (operation == minimum) {
        return a < b ? a : b;
    } else if constexpr (operation == maximum) {
        return a > b ? a : b;
    } else if constexpr (operation == Operation::hypot) {
        return std::hypot(a, b);
    } else {
        return std::numeric_limits<double>::quiet_NaN();
    }
}

/// Calls visit.template operator()<operation>() for the step that `operation` names at run time.
template <class Visitor>
decltype(auto) visit_step(Operation operation, const Visitor& visit) {
    using enum Operation;
    switch (operation) {
        case negate:
            return visit.template operator()<negate>();
        case absolute:
            return visit.template operator()<absolute>();
        case Operation::sqrt:
            return visit.template operator()<Operation::sqrt>();
        case Operation::exp:
            return visit.template operator()<Operation::exp>();
        case ln:
            return visit.template operator()<ln>();
        case Operation::log10:
            return visit.template operator()<Operation::log10>();
        case Operation::sin:
            return visit.template operator()<Operation::sin>();
        case Operation::cos:
            return visit.template operator()<Operation::cos>();
        case Operation::tan:
            return visit.template operator()<Operation::tan>();
        case Operation::asin:
            return visit.template operator()<Operation::asin>();
        case Operation::acos:
            return visit.template operator()<Operation::acos>();
        case Operation::atan:
            return visit.template operator()<Operation::atan>();
        case Operation::sinh:
            return visit.template operator()<Operation::sinh>();
        case Operation::cosh:
            return visit.template operator()<Operation::cosh>();
        case Operation::tanh:
            return visit.template operator()<Operation::tanh>();
        case celsius:
            return visit.template operator()<celsius>();
        case kelvin:
            return visit.template operator()<kelvin>();
        case add:
            return visit.template operator()<add>();
        case subtract:
            return visit.template operator()<subtract>();
        case multiply:
            return visit.template operator()<multiply>();
        case divide:
            return visit.template operator()<divide>();
        case power:
            return visit.template operator()<power>();
        case Operation::atan2:
            return visit.template operator()<Operation::atan2>();
        case minimum:
            return visit.template operator()<minimum>();
        case maximum:
            return visit.template operator()<maximum>();
        case Operation::hypot:
            return visit.template operator()<Operation::hypot>();
        case number:
        case pi:
        case quantity:
            break;
    }
    return visit.template operator()<number>();
}

[[nodiscard]] inline double apply(Operation operation, double a, double b) {
    return visit_step(operation, [&]<Operation step>() { return apply<step>(a, b); });
}

}  // namespace gumcert::gum
