#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include "engine/rotary_table/datum.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/register_widths.h"

// Inside a function with clones everything must be inlined, or it would be compiled for the narrow registers alone.
#define GUMCERT_INLINE __attribute__((always_inline)) inline

namespace gumcert::engine {

constexpr int k_lanes = 16;  ///< trials computed side by side

/// One number of each of 16 trials. All arithmetic is lane by lane, so that no trial depends on its neighbours.
struct alignas(64) Lanes {
    std::array<double, k_lanes> at;

    GUMCERT_INLINE double& operator[](int lane) { return at[static_cast<std::size_t>(lane)]; }
    GUMCERT_INLINE const double& operator[](int lane) const { return at[static_cast<std::size_t>(lane)]; }
};

GUMCERT_INLINE void fill(Lanes& lanes, double value) {
    for (int t = 0; t < k_lanes; ++t) {
        lanes[t] = value;
    }
}

/// sum += Σ c_i x_i, N terms.
template <std::size_t... I>
GUMCERT_INLINE void add_terms(const double* coefficients, const Lanes* x, Lanes& sum,
                              std::index_sequence<I...> /*terms*/) {
    const std::array<double, sizeof...(I)> c{coefficients[I]...};
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        sum[t] += (... + (c[I] * x[I][t]));
    }
}

/// sum += Σ c_i x_i
GUMCERT_INLINE void add_combination(const double* coefficients, Eigen::Index count, const Lanes* x, Lanes& sum) {
    constexpr Eigen::Index k_terms = 6;
    for (; count >= k_terms; count -= k_terms, coefficients += k_terms, x += k_terms) {
        add_terms(coefficients, x, sum, std::make_index_sequence<6>());
    }
    switch (count) {
        case 5:
            add_terms(coefficients, x, sum, std::make_index_sequence<5>());
            break;
        case 4:
            add_terms(coefficients, x, sum, std::make_index_sequence<4>());
            break;
        case 3:
            add_terms(coefficients, x, sum, std::make_index_sequence<3>());
            break;
        case 2:
            add_terms(coefficients, x, sum, std::make_index_sequence<2>());
            break;
        case 1:
            add_terms(coefficients, x, sum, std::make_index_sequence<1>());
            break;
        default:
            break;
    }
}

/// y += A x, A rows×columns, row-major.
GUMCERT_INLINE void multiply_add(const double* matrix, Eigen::Index rows, Eigen::Index columns, const Lanes* x,
                                 Lanes* y) {
    for (Eigen::Index row = 0; row < rows; ++row, matrix += columns) {
        add_combination(matrix, columns, x, y[row]);
    }
}

[[nodiscard]] inline bool any(const Lanes& lanes) {
    return std::any_of(lanes.at.begin(), lanes.at.end(), [](double lane) { return lane != 0.0; });
}

/// sin x and 1 - cos x. Power series up to 1/16, where the first term left out is below 2⁻⁶⁰ of the sum.
GUMCERT_INLINE void sine_and_versine(const Lanes& x, Lanes& sine, Lanes& versine) {
    constexpr double k_small = 0.0625;
    std::int64_t large = 0;
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        const double a = x[t];
        const double q = a * a;
        sine[t] = a + a * (q * (-1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * (1.0 / 362880.0)))));
        versine[t] = q * (0.5 + q * (-1.0 / 24.0 + q * (1.0 / 720.0 + q * (-1.0 / 40320.0 + q * (1.0 / 3628800.0)))));
    }
    for (int t = 0; t < k_lanes; ++t) {
        large |= x[t] > k_small || x[t] < -k_small ? 1 : 0;
    }
    for (int t = 0; t < k_lanes && large != 0; ++t) {
        if (std::abs(x[t]) > k_small) {
            const double half = std::sin(0.5 * x[t]);
            sine[t] = std::sin(x[t]);
            versine[t] = 2.0 * half * half;
        }
    }
}

/// Elements of Rz(c) Ry(b) Rx(a) - I, row by row, without loss of digits at small angles.
GUMCERT_INLINE void rotation_from_identity(const Lanes* angles, Lanes* rotation) {
    Lanes sa;
    Lanes va;
    Lanes sb;
    Lanes vb;
    Lanes sc;
    Lanes vc;
    sine_and_versine(angles[0], sa, va);
    sine_and_versine(angles[1], sb, vb);
    sine_and_versine(angles[2], sc, vc);
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        const double ca = 1.0 - va[t];
        const double cb = 1.0 - vb[t];
        const double cc = 1.0 - vc[t];
        rotation[0][t] = vc[t] * vb[t] - vc[t] - vb[t];
        rotation[1][t] = cc * sb[t] * sa[t] - sc[t] * ca;
        rotation[2][t] = cc * sb[t] * ca + sc[t] * sa[t];
        rotation[3][t] = sc[t] * cb;
        rotation[4][t] = sc[t] * sb[t] * sa[t] + (vc[t] * va[t] - vc[t] - va[t]);
        rotation[5][t] = sc[t] * sb[t] * ca - cc * sa[t];
        rotation[6][t] = -sb[t];
        rotation[7][t] = cb * sa[t];
        rotation[8][t] = vb[t] * va[t] - vb[t] - va[t];
    }
}

GUMCERT_INLINE double small_arc_tangent(double z) {
    const double q = z * z;
    return z +
           z * (q * (-1.0 / 3.0 +
                     q * (1.0 / 5.0 + q * (-1.0 / 7.0 + q * (1.0 / 9.0 + q * (-1.0 / 11.0 +
                                                                              q * (1.0 / 13.0 - q * (1.0 / 15.0))))))));
}

GUMCERT_INLINE double small_arc_sine(double z) {
    const double q = z * z;
    return z +
           z * (q * (1.0 / 6.0 +
                     q * (3.0 / 40.0 + q * (15.0 / 336.0 +
                                            q * (105.0 / 3456.0 + q * (945.0 / 42240.0 + q * (10395.0 / 599040.0)))))));
}

/// Angles a, b, c of a rotation given by its difference from the identity: power series of arc tangent and arc sine up
/// to 1/16, where the first term left out is below 2⁻⁶⁰ of the sum.
GUMCERT_INLINE void angles_from_rotation(const Lanes* rotation, Lanes* angles) {
    constexpr double k_small = 0.0625;
    std::int64_t large = 0;
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        angles[0][t] = small_arc_tangent(rotation[7][t] / (1.0 + rotation[8][t]));
        angles[1][t] = small_arc_sine(-rotation[6][t]);
        angles[2][t] = small_arc_tangent(rotation[3][t] / (1.0 + rotation[0][t]));
    }
    for (int t = 0; t < k_lanes; ++t) {
        const bool is_large =
            std::abs(angles[0][t]) > k_small || std::abs(angles[1][t]) > k_small || std::abs(angles[2][t]) > k_small;
        large |= is_large ? 1 : 0;
    }
    for (int t = 0; t < k_lanes && large != 0; ++t) {
        if (std::abs(angles[0][t]) > k_small || std::abs(angles[1][t]) > k_small || std::abs(angles[2][t]) > k_small) {
            const double r22 = 1.0 + rotation[8][t];
            angles[0][t] = std::atan2(rotation[7][t], r22);
            angles[1][t] = std::atan2(-rotation[6][t], std::hypot(rotation[7][t], r22));
            angles[2][t] = std::atan2(rotation[3][t], 1.0 + rotation[0][t]);
        }
    }
}

}  // namespace gumcert::engine
