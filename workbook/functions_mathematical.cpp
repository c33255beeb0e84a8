#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "text/numbers.h"
#include "workbook/letters.h"
#include "workbook/operand.h"

namespace gumcert::workbook {

namespace {

using Arguments = std::span<const Operand>;
using Takes = SheetFunction::Takes;

/// A function of one number. What it is not defined for gives no finite number, which is #NUM!.
template <double (*Function)(double)>
Operand of_one(Arguments arguments, CellReader& reader) {
    const Operand x = as_number(arguments[0], reader);
    return x.is_number() ? Operand::of(Function(x.number)) : x;
}

/// A function of two numbers; the second one may be left out.
template <Operand (*Function)(double, double), int WithoutSecond = 0>
Operand of_two(Arguments arguments, CellReader& reader) {
    const Operand x = as_number(arguments[0], reader);
    if (!x.is_number()) {
        return x;
    }
    const Operand y = arguments.size() > 1 ? as_number(arguments[1], reader) : Operand::of(double{WithoutSecond});
    return y.is_number() ? Function(x.number, y.number) : y;
}

double square_root(double x) {
    return std::sqrt(x);
}
double square_root_of_pi(double x) {
    return std::sqrt(x * std::numbers::pi);
}
double absolute(double x) {
    return std::abs(x);
}
double sign(double x) {
    return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}
double whole_below(double x) {
    return std::floor(x);
}
double exponential(double x) {
    return std::exp(x);
}
double natural_logarithm(double x) {
    return std::log(x);
}
double common_logarithm(double x) {
    return std::log10(x);
}

/// Spreadsheets refuse angles that have lost their digits.
double angle(double x) {
    return std::abs(x) < 134217728.0 ? x : std::numeric_limits<double>::quiet_NaN();
}
double sine(double x) {
    return std::sin(angle(x));
}
double cosine(double x) {
    return std::cos(angle(x));
}
double tangent(double x) {
    return std::tan(angle(x));
}
double arc_sine(double x) {
    return std::asin(x);
}
double arc_cosine(double x) {
    return std::acos(x);
}
double arc_tangent(double x) {
    return std::atan(x);
}
double hyperbolic_sine(double x) {
    return std::sinh(x);
}
double hyperbolic_cosine(double x) {
    return std::cosh(x);
}
double hyperbolic_tangent(double x) {
    return std::tanh(x);
}
double inverse_hyperbolic_sine(double x) {
    return std::asinh(x);
}
double inverse_hyperbolic_cosine(double x) {
    return std::acosh(x);
}
double inverse_hyperbolic_tangent(double x) {
    return std::atanh(x);
}
double in_degrees(double x) {
    return x * (180.0 / std::numbers::pi);
}
double in_radians(double x) {
    return x * (std::numbers::pi / 180.0);
}

enum class Rounding : std::uint8_t { nearest, away_from_zero, toward_zero };

/// Rounds the number that is printed with 15 digits, as spreadsheets do: 2.15 to one decimal is 2.2, though the double
/// next to it lies below.
Operand rounded(double x, double decimals, Rounding how) {
    const double places = std::trunc(decimals);
    if (x == 0.0 || places > 400.0) {
        return Operand::of(x);
    }
    if (places < -400.0) {
        return how == Rounding::away_from_zero ? Operand::of(CellError::number) : Operand::of(0.0);
    }
    std::array<char, 40> buffer{};
    const auto printed =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(x), std::chars_format::scientific, 14);
    const std::string_view text(buffer.data(), static_cast<std::size_t>(printed.ptr - buffer.data()));
    const std::size_t mark = text.find('e');
    std::string digits(1, text[0]);
    digits += text.substr(2, mark - 2);
    int exponent = 0;
    const std::string_view exponent_text = text.substr(mark + (text[mark + 1] == '+' ? 2 : 1));
    std::from_chars(exponent_text.data(), exponent_text.data() + exponent_text.size(), exponent);
    // digits are d.ddd × 10^exponent; kept of them are those up to the place asked for.
    const double kept = static_cast<double>(exponent) + 1.0 + places;
    if (kept >= static_cast<double>(digits.size())) {
        return Operand::of(x);
    }
    bool up = how == Rounding::away_from_zero;
    if (kept < 0.0) {
        digits = "";
    } else {
        const auto count = static_cast<std::size_t>(kept);
        const bool is_rest_nothing = std::all_of(digits.begin() + static_cast<std::ptrdiff_t>(count), digits.end(),
                                                 [](char c) { return c == '0'; });
        up = how == Rounding::nearest ? digits[count] >= '5' : up && !is_rest_nothing;
        digits.resize(count);
    }
    // One more digit before them takes what is carried.
    digits.insert(0, "0");
    for (std::size_t i = digits.size(); up && i-- > 0;) {
        up = digits[i] == '9';
        digits[i] = up ? '0' : static_cast<char>(digits[i] + 1);
    }
    digits += "e" + text::shortest(-places);
    double value = 0.0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return Operand::of(std::copysign(value, x));
}

Operand round_to_nearest(double x, double decimals) {
    return rounded(x, decimals, Rounding::nearest);
}
Operand round_up(double x, double decimals) {
    return rounded(x, decimals, Rounding::away_from_zero);
}
Operand round_down(double x, double decimals) {
    return std::trunc(decimals) == 0.0 ? Operand::of(std::trunc(x)) : rounded(x, decimals, Rounding::toward_zero);
}

/// A quotient that is a whole number but for its last digits.
double near_whole(double quotient) {
    const double whole = std::round(quotient);
    return std::abs(quotient - whole) <= 4.0 * std::numeric_limits<double>::epsilon() * std::abs(quotient) ? whole
                                                                                                           : quotient;
}

Operand ceiling(double x, double step) {
    if (x == 0.0 || step == 0.0) {
        return Operand::of(0.0);
    }
    if (x > 0.0 && step < 0.0) {
        return Operand::of(CellError::number);
    }
    return Operand::of(std::ceil(near_whole(x / step)) * step);
}

Operand floor_of(double x, double step) {
    if (x == 0.0) {
        return Operand::of(0.0);
    }
    if (step == 0.0) {
        return Operand::of(CellError::division_by_zero);
    }
    if (x > 0.0 && step < 0.0) {
        return Operand::of(CellError::number);
    }
    return Operand::of(std::floor(near_whole(x / step)) * step);
}

Operand rounded_to_multiple(double x, double step) {
    if (x == 0.0 || step == 0.0) {
        return Operand::of(0.0);
    }
    if ((x < 0.0) != (step < 0.0)) {
        return Operand::of(CellError::number);
    }
    const double quotient = x / step;
    const double below = std::floor(quotient);
    const double rest = near_whole((quotient - below) * 2.0);
    return Operand::of((rest >= 1.0 ? below + 1.0 : below) * step);
}

Operand modulo(double x, double divisor) {
    if (divisor == 0.0) {
        return Operand::of(CellError::division_by_zero);
    }
    return Operand::of(x - divisor * std::floor(x / divisor));
}

Operand logarithm(double x, double base) {
    if (x <= 0.0 || base <= 0.0) {
        return Operand::of(CellError::number);
    }
    if (base == 1.0) {
        return Operand::of(CellError::division_by_zero);
    }
    return Operand::of(base == 10.0 ? std::log10(x) : std::log(x) / std::log(base));
}

Operand angle_of_point(double x, double y) {
    return x == 0.0 && y == 0.0 ? Operand::of(CellError::division_by_zero) : Operand::of(std::atan2(y, x));
}

Operand pi_number(Arguments, CellReader&) {
    return Operand::of(std::numbers::pi);
}

Operand value_of_text(Arguments arguments, CellReader& reader) {
    return arguments[0].kind == OperandKind::boolean ? Operand::of(CellError::value) : as_number(arguments[0], reader);
}

/// Days from the day 0 of the workbook; what would be 1900-02-29 is counted, as the first spreadsheets did.
double serial_of(std::chrono::sys_days day, bool from_1904) {
    using namespace std::chrono;
    if (from_1904) {
        return static_cast<double>((day - sys_days(January / 1 / 1904)).count());
    }
    const auto days = (day - sys_days(December / 30 / 1899)).count();
    return static_cast<double>(days < 61 ? days - 1 : days);
}

Operand date(Arguments arguments, CellReader& reader) {
    std::array<double, 3> parts{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Operand part = as_number(arguments[i], reader);
        if (!part.is_number()) {
            return part;
        }
        parts[i] = std::floor(part.number);
    }
    if (parts[0] < 0.0 || parts[0] > 9999.0 || std::abs(parts[1]) > 1e5 || std::abs(parts[2]) > 1e7) {
        return Operand::of(CellError::number);
    }
    using namespace std::chrono;
    const int year_number = static_cast<int>(parts[0]) + (parts[0] < 1900.0 ? 1900 : 0);
    const year_month first = year(year_number) / January + months(static_cast<int>(parts[1]) - 1);
    const double serial =
        serial_of(sys_days(first / 1) + days(static_cast<int>(parts[2]) - 1), reader.dates_from_1904());
    return serial < 0.0 || year_number > 9999 || serial > 2958465.0 ? Operand::of(CellError::number)
                                                                    : Operand::of(serial);
}

template <typename Part>
Operand part_of_date(Arguments arguments, CellReader& reader, const Part& part) {
    const Operand serial = as_number(arguments[0], reader);
    if (!serial.is_number()) {
        return serial;
    }
    if (serial.number < 0.0 || serial.number >= 2958466.0) {
        return Operand::of(CellError::number);
    }
    using namespace std::chrono;
    const int days_of = static_cast<int>(serial.number);
    if (!reader.dates_from_1904() && (days_of == 60 || days_of == 0)) {
        return reader.not_evaluated("a day that there was not");
    }
    const sys_days day = reader.dates_from_1904()
                             ? sys_days(January / 1 / 1904) + days(days_of)
                             : sys_days(December / 30 / 1899) + days(days_of < 60 ? days_of + 1 : days_of);
    return Operand::of(part(year_month_day(day)));
}

Operand year_of(Arguments arguments, CellReader& reader) {
    return part_of_date(arguments, reader, [](const std::chrono::year_month_day& day) {
        return static_cast<double>(static_cast<int>(day.year()));
    });
}
Operand month_of(Arguments arguments, CellReader& reader) {
    return part_of_date(arguments, reader, [](const std::chrono::year_month_day& day) {
        return static_cast<double>(static_cast<unsigned>(day.month()));
    });
}
Operand day_of(Arguments arguments, CellReader& reader) {
    return part_of_date(arguments, reader, [](const std::chrono::year_month_day& day) {
        return static_cast<double>(static_cast<unsigned>(day.day()));
    });
}

/// Of ISO 8601 only, which all languages read alike.
Operand date_of_text(Arguments arguments, CellReader& reader) {
    const std::string_view text = arguments[0].text;
    if (arguments[0].kind != OperandKind::text) {
        return Operand::of(CellError::value);
    }
    const bool is_iso = text.size() == 10 && text[4] == '-' && text[7] == '-';
    std::array<int, 3> parts{};
    for (std::size_t i = 0; is_iso && i < parts.size(); ++i) {
        const std::string_view part = i == 0 ? text.substr(0, 4) : text.substr(2 + 3 * i, 2);
        if (!std::all_of(part.begin(), part.end(), is_digit)) {
            return reader.not_evaluated("a date as text");
        }
        std::from_chars(part.data(), part.data() + part.size(), parts[i]);
    }
    using namespace std::chrono;
    const year_month_day day = year(parts[0]) / parts[1] / parts[2];
    if (!is_iso || !day.ok() || parts[0] < 1905) {
        return reader.not_evaluated("a date as text");
    }
    return Operand::of(serial_of(sys_days(day), reader.dates_from_1904()));
}

constexpr SheetFunction k_mathematical[] = {
    {"ABS", Takes::values, 1, 1, of_one<absolute>},
    {"ACOS", Takes::values, 1, 1, of_one<arc_cosine>},
    {"ACOSH", Takes::values, 1, 1, of_one<inverse_hyperbolic_cosine>},
    {"ASIN", Takes::values, 1, 1, of_one<arc_sine>},
    {"ASINH", Takes::values, 1, 1, of_one<inverse_hyperbolic_sine>},
    {"ATAN", Takes::values, 1, 1, of_one<arc_tangent>},
    {"ATAN2", Takes::values, 2, 2, of_two<angle_of_point>},
    {"ATANH", Takes::values, 1, 1, of_one<inverse_hyperbolic_tangent>},
    {"CEILING", Takes::values, 2, 2, of_two<ceiling>},
    {"COS", Takes::values, 1, 1, of_one<cosine>},
    {"COSH", Takes::values, 1, 1, of_one<hyperbolic_cosine>},
    {"DATE", Takes::values, 3, 3, date},
    {"DATEVALUE", Takes::values, 1, 1, date_of_text},
    {"DAY", Takes::values, 1, 1, day_of},
    {"DEGREES", Takes::values, 1, 1, of_one<in_degrees>},
    {"EXP", Takes::values, 1, 1, of_one<exponential>},
    {"FLOOR", Takes::values, 2, 2, of_two<floor_of>},
    {"INT", Takes::values, 1, 1, of_one<whole_below>},
    {"LN", Takes::values, 1, 1, of_one<natural_logarithm>},
    {"LOG", Takes::values, 1, 2, of_two<logarithm, 10>},
    {"LOG10", Takes::values, 1, 1, of_one<common_logarithm>},
    {"MOD", Takes::values, 2, 2, of_two<modulo>},
    {"MONTH", Takes::values, 1, 1, month_of},
    {"MROUND", Takes::values, 2, 2, of_two<rounded_to_multiple>},
    {"PI", Takes::values, 0, 0, pi_number},
    {"POWER", Takes::values, 2, 2, of_two<power_of>},
    {"RADIANS", Takes::values, 1, 1, of_one<in_radians>},
    {"ROUND", Takes::values, 2, 2, of_two<round_to_nearest>},
    {"ROUNDDOWN", Takes::values, 2, 2, of_two<round_down>},
    {"ROUNDUP", Takes::values, 2, 2, of_two<round_up>},
    {"SIGN", Takes::values, 1, 1, of_one<sign>},
    {"SIN", Takes::values, 1, 1, of_one<sine>},
    {"SINH", Takes::values, 1, 1, of_one<hyperbolic_sine>},
    {"SQRT", Takes::values, 1, 1, of_one<square_root>},
    {"SQRTPI", Takes::values, 1, 1, of_one<square_root_of_pi>},
    {"TAN", Takes::values, 1, 1, of_one<tangent>},
    {"TANH", Takes::values, 1, 1, of_one<hyperbolic_tangent>},
    {"TRUNC", Takes::values, 1, 2, of_two<round_down>},
    {"VALUE", Takes::values, 1, 1, value_of_text},
    {"YEAR", Takes::values, 1, 1, year_of},
};

}  // namespace

std::span<const SheetFunction> mathematical_functions() {
    return k_mathematical;
}

}  // namespace gumcert::workbook
