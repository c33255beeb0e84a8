#pragma once

#include "gum/rounding.h"
#include "reports/record/evaluation_record.h"

#include <array>
#include <string>

namespace gumcert::reports {

// From the numbers of a reported result to its printed texts: no state, no other input, so that the texts can be
// made again from a record and compared.

/// How documents round.
struct ReportedRounding {
    int digits = 2;  ///< significant digits of U, or of half the width of the interval
    gum::RoundingMode rounding = gum::RoundingMode::half_even;  ///< of U
    int digits_of_u = 2;
    double value_error = 0.0;  ///< numerical error of the value, where it has one that may exceed the last digit
};

/// Whether value ± half the width says the same as the interval: its middle differs from the value by half a unit of
/// the last printed digit at most. Without a width: the interval is the value.
[[nodiscard]] bool is_symmetric_as_printed(double value, const std::array<double, 2>& interval, int digits = 2);

/// A result of Monte Carlo with its interval; U and k where the interval is symmetric as printed and u exists. U = 0 only
/// where u = 0: an interval without a width, where more than p of the trials are equal, is stated as such.
/// \param u  none: the distribution has no variance
[[nodiscard]] ReportedResult monte_carlo_result(double value, std::optional<double> u,
                                                const std::array<double, 2>& interval, double coverage_probability,
                                                const std::string& because, int digits = 2);

/// The result of the law of propagation: value ± U.
[[nodiscard]] ReportedResult law_of_propagation_result(double value, double u, std::optional<double> U,
                                                       std::optional<double> k, double coverage_probability);

/// Makes every printed text of a result from its numbers.
///
/// With U (greater than 0) value and U end at the same place (JCGM 100:2008, 7.2.6). Where the interval alone holds,
/// value, low and high end where half its width has `digits` digits, the value before that where its own numerical error
/// or its 15th digit ends. Without either the value has the digits that u leaves it.
/// \param unit  of the result, as UDUNITS-2 writes it
void print_reported(ReportedResult& result, const std::string& unit, const ReportedRounding& rounding = {});

/// The significant digits, 1 or 2, that a result of Monte Carlo is printed with; 2 of any other. Certificates have no more.
[[nodiscard]] int printed_digits(const ReportedResult& result);

/// A printed number with the other sign: the same quantity seen from the other side. Zero stays without one.
[[nodiscard]] std::string negated(const std::string& printed);

/// What is reported of a result. Records of releases that knew no `reported` state that of the law of propagation, or
/// the interval of Monte Carlo where the law gave no U.
[[nodiscard]] ReportedResult reported_result(const Result& result);

}  // namespace gumcert::reports
