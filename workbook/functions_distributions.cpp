#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <array>
#include <cmath>
#include <exception>
#include <new>

#include "workbook/operand.h"

namespace gumcert::workbook {

namespace {

using Given = std::span<const Operand>;

// In double throughout: elementary functions of long double differ between makers of processors (ADR 0058).
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using StudentT = boost::math::students_t_distribution<double, InDouble>;
using Normal = boost::math::normal_distribution<double, InDouble>;
using ChiSquare = boost::math::chi_squared_distribution<double, InDouble>;
using FisherF = boost::math::fisher_f_distribution<double, InDouble>;

/// Degrees of freedom as spreadsheets take them: the whole number below.
double whole_freedom(double nu) {
    return std::floor(nu);
}

StudentT student(double nu) {
    return StudentT(whole_freedom(nu));
}

bool is_probability(double p) {
    return p > 0.0 && p < 1.0;
}

/// A function of up to four numbers. Where it is not defined, or its value is out of reach, it is #NUM!.
template <std::size_t Count, typename Function>
Operand of_parameters(Given arguments, CellReader& reader, const Function& function) {
    std::array<double, Count> x{};
    for (std::size_t i = 0; i < Count; ++i) {
        const Operand number = as_number(arguments[i], reader);
        if (!number.is_number()) {
            return number;
        }
        x[i] = number.number;
    }
    try {
        return function(x);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // what Boost.Math refuses
        return Operand::of(CellError::number);
    }
}

Operand not_defined() {
    return Operand::of(CellError::number);
}

using boost::math::cdf;
using boost::math::complement;
using boost::math::pdf;
using boost::math::quantile;

Operand t_inverse_two_tails(Given arguments, CellReader& reader) {
    return of_parameters<2>(arguments, reader, [](const std::array<double, 2>& x) {
        if (!(x[0] > 0.0 && x[0] <= 1.0) || x[1] < 1.0) {
            return not_defined();
        }
        return Operand::of(x[0] == 1.0 ? 0.0 : quantile(complement(student(x[1]), x[0] / 2.0)));
    });
}

Operand t_inverse(Given arguments, CellReader& reader) {
    return of_parameters<2>(arguments, reader, [](const std::array<double, 2>& x) {
        return is_probability(x[0]) && x[1] >= 1.0 ? Operand::of(quantile(student(x[1]), x[0])) : not_defined();
    });
}

Operand t_tails(Given arguments, CellReader& reader) {
    return of_parameters<3>(arguments, reader, [](const std::array<double, 3>& x) {
        const double tails = std::floor(x[2]);
        if (x[0] < 0.0 || x[1] < 1.0 || (tails != 1.0 && tails != 2.0)) {
            return not_defined();
        }
        return Operand::of(tails * cdf(complement(student(x[1]), x[0])));
    });
}

Operand t_distribution(Given arguments, CellReader& reader) {
    return of_parameters<3>(arguments, reader, [](const std::array<double, 3>& x) {
        if (x[1] < 1.0) {
            return not_defined();
        }
        return Operand::of(x[2] != 0.0 ? cdf(student(x[1]), x[0]) : pdf(student(x[1]), x[0]));
    });
}

Operand t_two_tails(Given arguments, CellReader& reader) {
    return of_parameters<2>(arguments, reader, [](const std::array<double, 2>& x) {
        return x[0] >= 0.0 && x[1] >= 1.0 ? Operand::of(2.0 * cdf(complement(student(x[1]), x[0]))) : not_defined();
    });
}

Operand t_right_tail(Given arguments, CellReader& reader) {
    return of_parameters<2>(arguments, reader, [](const std::array<double, 2>& x) {
        return x[1] >= 1.0 ? Operand::of(cdf(complement(student(x[1]), x[0]))) : not_defined();
    });
}

Operand normal_inverse(Given arguments, CellReader& reader) {
    return of_parameters<1>(arguments, reader, [](const std::array<double, 1>& x) {
        return is_probability(x[0]) ? Operand::of(quantile(Normal(), x[0])) : not_defined();
    });
}

Operand normal_inverse_of(Given arguments, CellReader& reader) {
    return of_parameters<3>(arguments, reader, [](const std::array<double, 3>& x) {
        return is_probability(x[0]) && x[2] > 0.0 ? Operand::of(quantile(Normal(x[1], x[2]), x[0])) : not_defined();
    });
}

Operand normal_below(Given arguments, CellReader& reader) {
    return of_parameters<1>(arguments, reader,
                            [](const std::array<double, 1>& x) { return Operand::of(cdf(Normal(), x[0])); });
}

Operand standard_normal(Given arguments, CellReader& reader) {
    return of_parameters<2>(arguments, reader, [](const std::array<double, 2>& x) {
        return Operand::of(x[1] != 0.0 ? cdf(Normal(), x[0]) : pdf(Normal(), x[0]));
    });
}

Operand normal_of(Given arguments, CellReader& reader) {
    return of_parameters<4>(arguments, reader, [](const std::array<double, 4>& x) {
        if (x[2] <= 0.0) {
            return not_defined();
        }
        const Normal normal(x[1], x[2]);
        return Operand::of(x[3] != 0.0 ? cdf(normal, x[0]) : pdf(normal, x[0]));
    });
}

Operand chi_square_inverse_right(Given arguments, CellReader& reader) {
    return of_parameters<2>(arguments, reader, [](const std::array<double, 2>& x) {
        if (!(x[0] > 0.0 && x[0] <= 1.0) || x[1] < 1.0) {
            return not_defined();
        }
        return Operand::of(x[0] == 1.0 ? 0.0 : quantile(complement(ChiSquare(whole_freedom(x[1])), x[0])));
    });
}

Operand chi_square_inverse(Given arguments, CellReader& reader) {
    return of_parameters<2>(arguments, reader, [](const std::array<double, 2>& x) {
        return x[0] >= 0.0 && x[0] < 1.0 && x[1] >= 1.0 ? Operand::of(quantile(ChiSquare(whole_freedom(x[1])), x[0]))
                                                        : not_defined();
    });
}

Operand f_inverse_right(Given arguments, CellReader& reader) {
    return of_parameters<3>(arguments, reader, [](const std::array<double, 3>& x) {
        if (!(x[0] > 0.0 && x[0] <= 1.0) || x[1] < 1.0 || x[2] < 1.0) {
            return not_defined();
        }
        return Operand::of(x[0] == 1.0 ? 0.0
                                       : quantile(complement(FisherF(whole_freedom(x[1]), whole_freedom(x[2])), x[0])));
    });
}

constexpr SheetFunction::Takes k_values = SheetFunction::Takes::values;
constexpr SheetFunction k_distributions[] = {
    {"CHIINV", k_values, 2, 2, chi_square_inverse_right},
    {"CHISQ.INV", k_values, 2, 2, chi_square_inverse},
    {"CHISQ.INV.RT", k_values, 2, 2, chi_square_inverse_right},
    {"F.INV.RT", k_values, 3, 3, f_inverse_right},
    {"FINV", k_values, 3, 3, f_inverse_right},
    {"NORM.DIST", k_values, 4, 4, normal_of},
    {"NORM.INV", k_values, 3, 3, normal_inverse_of},
    {"NORM.S.DIST", k_values, 2, 2, standard_normal},
    {"NORM.S.INV", k_values, 1, 1, normal_inverse},
    {"NORMDIST", k_values, 4, 4, normal_of},
    {"NORMINV", k_values, 3, 3, normal_inverse_of},
    {"NORMSDIST", k_values, 1, 1, normal_below},
    {"NORMSINV", k_values, 1, 1, normal_inverse},
    {"T.DIST", k_values, 3, 3, t_distribution},
    {"T.DIST.2T", k_values, 2, 2, t_two_tails},
    {"T.DIST.RT", k_values, 2, 2, t_right_tail},
    {"T.INV", k_values, 2, 2, t_inverse},
    {"T.INV.2T", k_values, 2, 2, t_inverse_two_tails},
    {"TDIST", k_values, 3, 3, t_tails},
    {"TINV", k_values, 2, 2, t_inverse_two_tails},
};

}  // namespace

std::span<const SheetFunction> distribution_functions() {
    return k_distributions;
}

}  // namespace gumcert::workbook
