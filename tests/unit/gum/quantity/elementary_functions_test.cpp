// The elementary functions that every program of the project has, whatever the processor can do (ADR 0058).

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace {

using One = double (*)(double);
using OneLong = long double (*)(long double);
using Two = double (*)(double, double);
using TwoLong = long double (*)(long double, long double);

constexpr int k_arguments = 20'000;
constexpr double k_infinity = std::numeric_limits<double>::infinity();

/// Error in units of the last place of the value, which the C library computes with 11 bits more.
double error_in_ulp(double value, long double exact) {
    const auto nearest = static_cast<double>(exact);
    const double ulp = std::nextafter(std::fabs(nearest), k_infinity) - std::fabs(nearest);
    return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) / static_cast<long double>(ulp));
}

class Draws {
public:
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
    }

private:
    std::mt19937_64 bits_{20261127};
};

struct OfOne {
    const char* name;
    One function;
    OneLong exact;
    double low, high;
    double most;  // ulp
};

struct OfTwo {
    const char* name;
    Two function;
    TwoLong exact;
    double low, high, second_low, second_high;
    double most;  // ulp
};

// Bounds a little above what a million arguments showed against 113 bits.
const OfOne k_of_one[] = {
    {"exp", ::exp, ::expl, -1.0, 1.0, 0.53},          {"exp", ::exp, ::expl, -700.0, 700.0, 0.53},
    {"expm1", ::expm1, ::expm1l, -5.0, 5.0, 0.9},     {"log", ::log, ::logl, 0.1, 10.0, 0.54},
    {"log", ::log, ::logl, 1.0, 1e300, 0.54},         {"log1p", ::log1p, ::log1pl, -0.5, 5.0, 0.9},
    {"log10", ::log10, ::log10l, 1e-3, 1e3, 0.9},     {"sin", ::sin, ::sinl, -7.0, 7.0, 0.85},
    {"sin", ::sin, ::sinl, -1e6, 1e6, 0.85},          {"cos", ::cos, ::cosl, -7.0, 7.0, 0.85},
    {"cos", ::cos, ::cosl, -1e6, 1e6, 0.85},          {"tan", ::tan, ::tanl, -7.0, 7.0, 0.95},
    {"asin", ::asin, ::asinl, -1.0, 1.0, 1.0},        {"acos", ::acos, ::acosl, -1.0, 1.0, 1.0},
    {"atan", ::atan, ::atanl, -10.0, 10.0, 0.95},     {"sinh", ::sinh, ::sinhl, -5.0, 5.0, 2.1},
    {"cosh", ::cosh, ::coshl, -5.0, 5.0, 1.2},        {"tanh", ::tanh, ::tanhl, -5.0, 5.0, 2.3},
    {"asinh", ::asinh, ::asinhl, -9.0, 9.0, 2.0},     {"acosh", ::acosh, ::acoshl, 1.0, 100.0, 2.1},
    {"atanh", ::atanh, ::atanhl, -1.0, 1.0, 2.0},     {"cbrt", ::cbrt, ::cbrtl, -100.0, 100.0, 0.8},
    {"erf", ::erf, ::erfl, -4.0, 4.0, 1.1},           {"erfc", ::erfc, ::erfcl, -4.0, 10.0, 3.0},
    {"lgamma", ::lgamma, ::lgammal, 3.0, 200.0, 2.5},
};
const OfTwo k_of_two[] = {
    {"pow", ::pow, ::powl, 0.1, 10.0, -20.0, 20.0, 0.53},
    {"pow", ::pow, ::powl, 1e-5, 1e5, -50.0, 50.0, 0.53},
    {"atan2", ::atan2, ::atan2l, -10.0, 10.0, -10.0, 10.0, 1.5},
    {"hypot", ::hypot, ::hypotl, -10.0, 10.0, -1e3, 1e3, 1.0},
};

TEST(ElementaryFunctions, ErrorsAreSmall) {
    Draws draws;
    for (const OfOne& tried : k_of_one) {
        double largest = 0.0;
        for (int i = 0; i < k_arguments; ++i) {
            const double x = draws.between(tried.low, tried.high);
            largest = std::fmax(largest, error_in_ulp(tried.function(x), tried.exact(x)));
        }
        EXPECT_LT(largest, tried.most) << tried.name << " from " << tried.low << " to " << tried.high;
    }
    for (const OfTwo& tried : k_of_two) {
        double largest = 0.0;
        for (int i = 0; i < k_arguments; ++i) {
            const double x = draws.between(tried.low, tried.high);
            const double y = draws.between(tried.second_low, tried.second_high);
            largest = std::fmax(largest, error_in_ulp(tried.function(x, y), tried.exact(x, y)));
        }
        EXPECT_LT(largest, tried.most) << tried.name << " from " << tried.low << " to " << tried.high;
    }
}

/// The file that a function of this name is in, as all of the process sees it.
template <typename Function>
std::string home_of(Function function) {
    Dl_info found{};
    void* address = nullptr;
    static_assert(sizeof function == sizeof address);
    std::memcpy(&address, &function, sizeof address);
    return dladdr(address, &found) != 0 ? found.dli_fname : "nowhere";
}

TEST(ElementaryFunctions, AreThoseOfTheProgramAndNotOfTheCLibrary) {
    const std::string here = home_of(&home_of<int (*)()>);
    for (const OfOne& tried : k_of_one) {
        EXPECT_EQ(home_of(tried.function), here) << tried.name;
    }
    for (const OfTwo& tried : k_of_two) {
        EXPECT_EQ(home_of(tried.function), here) << tried.name;
    }
    for (const OneLong extended : {::expl, ::log1pl, ::sinl, ::cosl}) {
        EXPECT_EQ(home_of(extended), here);
    }
    EXPECT_NE(home_of(&::dladdr), here);
}

/// The C library's own, which the program does not call.
OneLong of_the_c_library(const char* name) {
    static void* const library = dlopen("libm.so.6", RTLD_NOW | RTLD_LOCAL);
    void* const address = library == nullptr ? nullptr : dlsym(library, name);
    OneLong function = nullptr;
    std::memcpy(&function, &address, sizeof function);
    return function;
}

/// Of values near 1 and larger: relative, in units of 2^-63.
double largest_extended_error(const char* name, OneLong function, double low, double high) {
    const OneLong exact = of_the_c_library(name);
    Draws draws;
    double largest = 0.0;
    for (int i = 0; i < k_arguments; ++i) {
        const auto x = static_cast<long double>(draws.between(low, high)) * 1.0000000000000000123L;
        const long double expected = exact(x);
        largest = std::fmax(largest, static_cast<double>(std::fabs((function(x) - expected) / expected) * 0x1p63L));
    }
    return largest;
}

TEST(ElementaryFunctions, ThoseOfExtendedPrecisionHaveItsDigits) {
    EXPECT_LT(largest_extended_error("expl", ::expl, -1.0, 1.0), 4.0);
    EXPECT_LT(largest_extended_error("expl", ::expl, -11'000.0, 11'000.0), 4.0);
    EXPECT_LT(largest_extended_error("log1pl", ::log1pl, -1e-6, 1e-6), 8.0);
    EXPECT_LT(largest_extended_error("log1pl", ::log1pl, -0.9999, 1.0), 8.0);
    EXPECT_LT(largest_extended_error("log1pl", ::log1pl, 1.0, 1e12), 8.0);
    constexpr long double k_far = std::numeric_limits<long double>::infinity();
    EXPECT_EQ(::expl(k_far), k_far);
    EXPECT_EQ(::expl(-k_far), 0.0L);
    EXPECT_TRUE(std::isnan(::expl(std::numeric_limits<long double>::quiet_NaN())));
    EXPECT_EQ(::log1pl(-1.0L), -k_far);
    EXPECT_EQ(::log1pl(k_far), k_far);
    EXPECT_TRUE(std::isnan(::log1pl(-2.0L)));
}

TEST(ElementaryFunctions, SpecialValues) {
    const volatile double zero = 0.0;  // computed when the test runs, and not by the compiler
    const volatile double one = 1.0;
    EXPECT_EQ(std::exp(-k_infinity * one), 0.0);
    EXPECT_EQ(std::exp(710.0 * one), k_infinity);
    EXPECT_EQ(std::log(zero), -k_infinity);
    EXPECT_TRUE(std::isnan(std::log(-one)));
    EXPECT_TRUE(std::isnan(std::sin(k_infinity * one)));
    EXPECT_TRUE(std::isnan(std::asin(2.0 * one)));
    EXPECT_EQ(std::pow(zero, zero), 1.0);
    EXPECT_EQ(std::pow(-2.0 * one, 3.0 * one), -8.0);
    EXPECT_TRUE(std::isnan(std::pow(-2.0 * one, 0.5 * one)));
    EXPECT_EQ(std::exp(zero), 1.0);
    EXPECT_EQ(std::cos(zero), 1.0);
    EXPECT_TRUE(std::signbit(std::sin(-zero)));
    EXPECT_EQ(std::hypot(k_infinity * one, std::nan("")), k_infinity);
    EXPECT_EQ(std::atan2(zero, -one), std::acos(-one));
}

TEST(ElementaryFunctions, SineAndCosineTogetherAreThoseAlone) {
    Draws draws;
    for (int i = 0; i < k_arguments; ++i) {
        const double x = draws.between(-1e4, 1e4);
        double sine = 0.0;
        double cosine = 0.0;
        ::sincos(x, &sine, &cosine);
        const One sin_alone = ::sin;
        const One cos_alone = ::cos;
        EXPECT_EQ(sine, sin_alone(x));
        EXPECT_EQ(cosine, cos_alone(x));
    }
}

}  // namespace
