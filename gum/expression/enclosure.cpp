#include "gum/expression/enclosure.h"

#include <algorithm>
#include <boost/numeric/interval/arith.hpp>
#include <boost/numeric/interval/arith2.hpp>
#include <boost/numeric/interval/checking.hpp>
#include <boost/numeric/interval/interval.hpp>
#include <boost/numeric/interval/policies.hpp>
#include <boost/numeric/interval/rounded_arith.hpp>
#include <boost/numeric/interval/utility.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace gumcert::gum {

// What holds at both ends of an interval holds between them where a function rises or falls. So each function is
// evaluated at ends only, and what is not monotonic is led back to that: cosine and sine by asking whether an extreme
// lies within, cosh and the square by the smallest and largest size. Where no statement is possible (a pole, a cut, a
// tie) there is none, rather than a wide one.

namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();
constexpr double k_half_pi = 0.5 * std::numbers::pi;

double one_down(double x) {
    return std::nextafter(x, -k_infinite);
}
double one_up(double x) {
    return std::nextafter(x, k_infinite);
}

/// Rounds outward without a change of the rounding mode: the result of an operation is at most half a unit in the last
/// place away. What is exact stays as it is where that is seen at once.
struct Outward : boost::numeric::interval_lib::rounded_arith_exact<double> {
    using unprotected_rounding = Outward;

    static double add_down(double x, double y) { return x == 0.0 ? y : y == 0.0 ? x : one_down(x + y); }
    static double add_up(double x, double y) { return x == 0.0 ? y : y == 0.0 ? x : one_up(x + y); }
    static double sub_down(double x, double y) { return y == 0.0 ? x : x == 0.0 ? -y : one_down(x - y); }
    static double sub_up(double x, double y) { return y == 0.0 ? x : x == 0.0 ? -y : one_up(x - y); }
    // 0·∞ is 0 here and not NaN: a derivative that is 0 stays harmless, whatever it is multiplied with.
    static double mul_down(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : one_down(x * y); }
    static double mul_up(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : one_up(x * y); }
    static double div_down(double x, double y) { return x == 0.0 ? 0.0 : one_down(x / y); }
    static double div_up(double x, double y) { return x == 0.0 ? 0.0 : one_up(x / y); }
    static double sqrt_down(double x) { return x == 0.0 ? 0.0 : one_down(std::sqrt(x)); }
    static double sqrt_up(double x) { return x == 0.0 ? 0.0 : one_up(std::sqrt(x)); }
};

using Boosted = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<Outward, boost::numeric::interval_lib::checking_base<double>>>;

constexpr Enclosure k_nowhere{-k_infinite, k_infinite};

bool is_ordered(const Enclosure& a) {
    return a.low <= a.high;  // false for NaN
}
Boosted boosted(const Enclosure& a) {
    return {a.low, a.high};
}
Enclosure plain(const Boosted& a) {
    return is_ordered({a.lower(), a.upper()}) ? Enclosure{a.lower(), a.upper()} : k_nowhere;
}

/// What a function of the library returned, made as wide as it may be off.
double down_by_library(double x) {
    for (int i = 0; i < k_library_ulps; ++i) {
        x = one_down(x);
    }
    return x;
}
double up_by_library(double x) {
    for (int i = 0; i < k_library_ulps; ++i) {
        x = one_up(x);
    }
    return x;
}

template <typename Function>
Enclosure rising(const Function& function, const Enclosure& a) {
    return {down_by_library(function(a.low)), up_by_library(function(a.high))};
}

Enclosure within(const Enclosure& a, double least, double most) {
    return {std::max(a.low, least), std::min(a.high, most)};
}

/// Whether x0 + n·period may lie within for a whole number n: rounding decides for yes.
bool meets_grid(const Enclosure& a, double x0, double period) {
    // Up to 1e5 there are 3e4 periods of tan, and the rounding of π, of the difference and of the quotient is 3e-16 of
    // the count: 1e-11. A grid point that is met by mistake only widens the result.
    constexpr double k_slack = 1e-9;
    const double from = (a.low - x0) / period, to = (a.high - x0) / period;
    return std::floor(to + k_slack) >= std::ceil(from - k_slack);
}

Enclosure enclosed_cos(const Enclosure& a) {
    constexpr double k_far = 1e5;  // periods are counted with a slack of 1e-9
    if (a.largest() > k_far || a.high - a.low >= 2.0 * std::numbers::pi) {
        return {-1.0, 1.0};
    }
    const double first = std::cos(a.low), second = std::cos(a.high);
    // Without an extreme within, the largest and the smallest value lie at the ends.
    Enclosure result{down_by_library(std::min(first, second)), up_by_library(std::max(first, second))};
    if (meets_grid(a, 0.0, 2.0 * std::numbers::pi)) {
        result.high = 1.0;
    }
    if (meets_grid(a, std::numbers::pi, 2.0 * std::numbers::pi)) {
        result.low = -1.0;
    }
    return within(result, -1.0, 1.0);
}

Enclosure enclosed_sin(const Enclosure& a) {
    constexpr double k_far = 1e5;
    if (a.largest() > k_far || a.high - a.low >= 2.0 * std::numbers::pi) {
        return {-1.0, 1.0};
    }
    const double first = std::sin(a.low), second = std::sin(a.high);
    Enclosure result{down_by_library(std::min(first, second)), up_by_library(std::max(first, second))};
    if (meets_grid(a, k_half_pi, 2.0 * std::numbers::pi)) {
        result.high = 1.0;
    }
    if (meets_grid(a, -k_half_pi, 2.0 * std::numbers::pi)) {
        result.low = -1.0;
    }
    return within(result, -1.0, 1.0);
}

Enclosure enclosed_exp(const Enclosure& a) {
    return within(rising([](double x) { return std::exp(x); }, a), 0.0, k_infinite);
}
Enclosure enclosed_ln(const Enclosure& a) {
    return rising([](double x) { return std::log(x); }, a);
}
Enclosure enclosed_sinh(const Enclosure& a) {
    return rising([](double x) { return std::sinh(x); }, a);
}
Enclosure enclosed_cosh(const Enclosure& a) {
    // cosh falls up to 0 and rises from there, so it is evaluated at the smallest and the largest |x|.
    const Enclosure beyond = rising([](double x) { return std::cosh(x); }, Enclosure{a.smallest(), a.largest()});
    return within(beyond, 1.0, k_infinite);
}
Enclosure enclosed_sqrt(const Enclosure& a) {
    return plain(boost::numeric::sqrt(boosted(a)));
}

/// a^b = exp(b ln a) for a > 0.
Enclosure enclosed_power(const Enclosure& a, const Enclosure& b) {
    return enclosed_exp(b * enclosed_ln(a));
}

/// The angle of (b, a): harmonic, and monotonic along every edge of a box without the origin and the cut, so that its
/// ends lie in the corners.
Enclosure enclosed_atan2(const Enclosure& a, const Enclosure& b) {
    double low = k_infinite, high = -k_infinite;
    for (const double y : {a.low, a.high}) {
        for (const double x : {b.low, b.high}) {
            const double angle = std::atan2(y, x);
            low = std::min(low, angle);
            high = std::max(high, angle);
        }
    }
    return {down_by_library(low), up_by_library(high)};
}

Enclosure enclosed_hypot(const Enclosure& a, const Enclosure& b) {
    return enclosed_sqrt(square(a) + square(b));
}

/// ln 10, of which no double is exact.
Enclosure ln_10() {
    return {one_down(std::numbers::ln10), one_up(std::numbers::ln10)};
}

std::optional<Enclosure> finite(const Enclosure& a) {
    return a.is_finite() ? std::optional(a) : std::nullopt;
}

}  // namespace

bool Enclosure::is_finite() const {
    return std::isfinite(low) && std::isfinite(high) && low <= high;
}

double Enclosure::largest() const {
    return std::max(std::fabs(low), std::fabs(high));
}

double Enclosure::smallest() const {
    return contains(0.0) ? 0.0 : std::min(std::fabs(low), std::fabs(high));
}

Enclosure operator-(const Enclosure& a) {
    return {-a.high, -a.low};
}

Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    return is_ordered(a) && is_ordered(b) ? plain(boosted(a) + boosted(b)) : k_nowhere;
}

Enclosure operator-(const Enclosure& a, const Enclosure& b) {
    return is_ordered(a) && is_ordered(b) ? plain(boosted(a) - boosted(b)) : k_nowhere;
}

Enclosure operator*(const Enclosure& a, const Enclosure& b) {
    if (a.is_zero() || b.is_zero()) {
        return {};
    }
    return is_ordered(a) && is_ordered(b) ? plain(boosted(a) * boosted(b)) : k_nowhere;
}

Enclosure operator/(const Enclosure& a, const Enclosure& b) {
    if (!is_ordered(a) || !is_ordered(b) || b.contains(0.0)) {
        return k_nowhere;
    }
    return plain(boosted(a) / boosted(b));
}

Enclosure square(const Enclosure& a) {
    return is_ordered(a) ? plain(boost::numeric::square(boosted(a))) : k_nowhere;
}

std::optional<Enclosure> enclose(Operation operation, const Enclosure& a, const Enclosure& b) {
    using enum Operation;
    if (!a.is_finite() || !b.is_finite()) {
        return std::nullopt;
    }
    switch (operation) {
        case negate:
            return -a;
        case absolute:
            return a.low > 0.0 ? std::optional(a) : a.high < 0.0 ? std::optional(-a) : std::nullopt;
        case Operation::sqrt:
            // At 0 the root has a value, and no derivative.
            return a.low > 0.0 ? finite(enclosed_sqrt(a)) : std::nullopt;
        case Operation::exp:
            return finite(enclosed_exp(a));
        case ln:
            return a.low > 0.0 ? finite(enclosed_ln(a)) : std::nullopt;
        case Operation::log10:
            return a.low > 0.0 ? finite(rising([](double x) { return std::log10(x); }, a)) : std::nullopt;
        case Operation::sin:
            return enclosed_sin(a);
        case Operation::cos:
            return enclosed_cos(a);
        case Operation::tan:
            if (a.largest() > 1e5 || a.high - a.low >= std::numbers::pi || meets_grid(a, k_half_pi, std::numbers::pi)) {
                return std::nullopt;
            }
            return finite(rising([](double x) { return std::tan(x); }, a));
        case Operation::asin:
            return a.low > -1.0 && a.high < 1.0 ? finite(rising([](double x) { return std::asin(x); }, a))
                                                : std::nullopt;
        case Operation::acos:
            return a.low > -1.0 && a.high < 1.0 ? finite(-rising([](double x) { return -std::acos(x); }, a))
                                                : std::nullopt;
        case Operation::atan:
            return finite(rising([](double x) { return std::atan(x); }, a));
        case Operation::sinh:
            return finite(enclosed_sinh(a));
        case Operation::cosh:
            return finite(enclosed_cosh(a));
        case Operation::tanh:
            return within(rising([](double x) { return std::tanh(x); }, a), -1.0, 1.0);
        case celsius:
            return finite(a - enclosure_of(k_ice_point));
        case kelvin:
            return finite(a + enclosure_of(k_ice_point));
        case add:
            return finite(a + b);
        case subtract:
            return finite(a - b);
        case multiply:
            return finite(a * b);
        case divide:
            return finite(a / b);
        case power:
            // A power with a whole constant exponent is a chain of products on the tape, so that it is enclosed for
            // negative bases as well.
            return a.low > 0.0 ? finite(enclosed_power(a, b)) : std::nullopt;
        case Operation::atan2:
            return b.low > 0.0 || !a.contains(0.0) ? finite(enclosed_atan2(a, b)) : std::nullopt;
        case minimum:
            return a.high < b.low ? std::optional(a) : b.high < a.low ? std::optional(b) : std::nullopt;
        case maximum:
            return a.low > b.high ? std::optional(a) : b.low > a.high ? std::optional(b) : std::nullopt;
        case Operation::hypot:
            return a.contains(0.0) && b.contains(0.0) ? std::nullopt : finite(enclosed_hypot(a, b));
        default:
            return std::nullopt;
    }
}

std::optional<EnclosedStep> enclose_with_partials(Operation operation, const Enclosure& a, const Enclosure& b) {
    using enum Operation;
    const std::optional<Enclosure> value = enclose(operation, a, b);
    if (!value) {
        return std::nullopt;
    }
    const Enclosure one = enclosure_of(1.0), two = enclosure_of(2.0);
    EnclosedStep s{.value = *value, .da = {}, .db = {}, .daa = {}, .dab = {}, .dbb = {}};
    const Enclosure& v = s.value;
    switch (operation) {
        case negate:
            s.da = -one;
            break;
        case absolute:
            s.da = a.low > 0.0 ? one : -one;
            break;
        case Operation::sqrt:
            s.da = enclosure_of(0.5) / v;
            s.daa = enclosure_of(-0.25) / (a * v);
            break;
        case Operation::exp:
            s.da = s.daa = v;
            break;
        case ln:
            s.da = one / a;
            s.daa = -one / square(a);
            break;
        case Operation::log10:
            s.da = one / (a * ln_10());
            s.daa = -one / (square(a) * ln_10());
            break;
        case Operation::sin:
            s.da = enclosed_cos(a);
            s.daa = -v;
            break;
        case Operation::cos:
            s.da = -enclosed_sin(a);
            s.daa = -v;
            break;
        case Operation::tan:
            s.da = one + square(v);
            s.daa = two * v * s.da;
            break;
        case Operation::asin:
        case Operation::acos: {
            const Enclosure slope = one / enclosed_sqrt((one - a) * (one + a));
            s.da = operation == Operation::asin ? slope : -slope;
            s.daa = a * s.da * square(s.da);
            break;
        }
        case Operation::atan:
            s.da = one / (one + square(a));
            s.daa = -two * a * square(s.da);
            break;
        case Operation::sinh:
            s.da = enclosed_cosh(a);
            s.daa = v;
            break;
        case Operation::cosh:
            s.da = enclosed_sinh(a);
            s.daa = v;
            break;
        case Operation::tanh:
            // 1 − v² would be wide, and contain 0, where tanh is close to ±1.
            s.da = one / square(enclosed_cosh(a));
            s.daa = -two * v * s.da;
            break;
        case celsius:
        case kelvin:
            s.da = one;
            break;
        case add:
            s.da = s.db = one;
            break;
        case subtract:
            s.da = one;
            s.db = -one;
            break;
        case multiply:
            s.da = b;
            s.db = a;
            s.dab = one;
            break;
        case divide:
            s.da = one / b;
            s.db = -v / b;
            s.dab = -one / square(b);
            s.dbb = two * v / square(b);
            break;
        case power: {
            const Enclosure log = enclosed_ln(a);
            // From the value at hand: a^(b−1) = v/a. That a stands twice in it makes the enclosure wider, never wrong.
            s.da = b * v / a;
            s.db = v * log;
            s.daa = b * (b - one) * v / square(a);
            s.dab = v / a * (one + b * log);
            s.dbb = s.db * log;
            break;
        }
        case Operation::atan2: {
            const Enclosure h2 = square(a) + square(b);
            s.da = b / h2;
            s.db = -a / h2;
            s.daa = two * s.da * s.db;
            s.dab = square(s.db) - square(s.da);
            s.dbb = -two * s.da * s.db;
            break;
        }
        case minimum:
            (a.high < b.low ? s.da : s.db) = one;
            break;
        case maximum:
            (a.low > b.high ? s.da : s.db) = one;
            break;
        case Operation::hypot:
            s.da = a / v;
            s.db = b / v;
            s.daa = square(s.db) / v;
            s.dab = -(s.da * s.db) / v;
            s.dbb = square(s.da) / v;
            break;
        default:
            return std::nullopt;
    }
    for (const Enclosure* part : {&s.da, &s.db, &s.daa, &s.dab, &s.dbb}) {
        if (!part->is_finite()) {
            return std::nullopt;
        }
    }
    return s;
}

}  // namespace gumcert::gum
