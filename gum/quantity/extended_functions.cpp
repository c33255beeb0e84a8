// Two elementary functions of extended precision under the names of the C library, in the place of its own: those are
// instructions of x86 processors, whose last bits differ between makers (ADR 0058). Boost.Math asks for them even where it
// is told to compute in double. Made of additions, products and quotients, which IEEE 754 rounds the same everywhere.

#include <cmath>
#include <limits>

namespace gumcert::gum {
namespace {

using Extended = long double;

constexpr Extended k_ln_2_high = 0x1.62e42fefa39ep-1L;            // 49 bits: exact when multiplied by an exponent
constexpr Extended k_ln_2_low = 0xf.35793c7673007e5edp-53L;       // the rest of ln 2
constexpr Extended k_log_2_e = 0x1.71547652b82fe1777d0ffda0dp0L;  // 1/ln 2
constexpr Extended k_beyond = 11'600.0L;                          // e to this is beyond the range, up and down
constexpr int k_terms = 24;                                       // 0.7^25/25! is below the rounding of 0.7

/// e^r − 1 for |r| ≤ 0.7, by its series.
Extended series_of_expm1(Extended r) {
    Extended sum = 1.0L;
    for (int n = k_terms; n > 1; --n) {
        sum = 1.0L + r * sum / n;
    }
    return r * sum;
}

}  // namespace

extern "C" long double expl(long double x) noexcept {
    if (!(std::fabs(x) < k_beyond)) {
        return std::isnan(x) ? x : x > 0.0L ? std::numeric_limits<Extended>::infinity() : 0.0L;
    }
    const Extended k = std::floor(x * k_log_2_e + 0.5L);
    const Extended r = (x - k * k_ln_2_high) - k * k_ln_2_low;
    return std::ldexp(1.0L + series_of_expm1(r), static_cast<int>(k));
}

extern "C" long double log1pl(long double x) noexcept {
    if (!(x > -1.0L) || x > std::numeric_limits<Extended>::max()) {
        return x == -1.0L ? -std::numeric_limits<Extended>::infinity()
                          : (x < -1.0L ? std::numeric_limits<Extended>::quiet_NaN() : x);
    }
    // In double, and one step of Newton's method for e^y = 1 + x.
    if (std::fabs(x) < 0.5L) {
        const Extended y = std::log1p(static_cast<double>(x));
        const Extended there = series_of_expm1(y);
        return y + (x - there) / (1.0L + there);
    }
    int exponent = 0;
    const Extended fraction = std::frexp(1.0L + x, &exponent);
    const Extended y = std::log(static_cast<double>(fraction)) + exponent * k_ln_2_high;
    const Extended off = fraction * expl(exponent * k_ln_2_high - y) * (1.0L + exponent * k_ln_2_low) - 1.0L;
    return y + off;
}

}  // namespace gumcert::gum
