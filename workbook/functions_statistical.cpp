#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "workbook/operand.h"

namespace gumcert::workbook {

namespace {

using Values = std::span<const Operand>;
using Taking = SheetFunction::Takes;

/// Numbers of the arguments of a function, or why there are none.
struct Gathered {
    std::vector<double> numbers;
    std::optional<Operand> stop;

    /// An error is kept while the rest is looked through: a value that is not known makes the result unknown.
    void add_stop(const Operand& one) {
        if (!stop || (stop->kind == OperandKind::error && one.kind != OperandKind::error)) {
            stop = one;
        }
    }
};

/// ranges: text and truth values in areas and arrays are left out. everything: they count as 0, and TRUE as 1.
enum class Counting : std::uint8_t { ranges, everything };

Gathered gather(Values arguments, CellReader& reader, Counting counting = Counting::ranges) {
    Gathered found;
    const auto add = [&](const Operand& one) {
        if (one.stops()) {
            found.add_stop(one);
        } else if (one.kind == OperandKind::number ||
                   (counting == Counting::everything && one.kind != OperandKind::blank)) {
            found.numbers.push_back(one.kind == OperandKind::text ? 0.0 : one.number);
        }
        return true;
    };
    for (const Operand& argument : arguments) {
        if (argument.kind == OperandKind::area) {
            reader.each_cell(argument.area, add);
        } else if (argument.kind == OperandKind::array) {
            reader.spend(argument.array->items.size());
            std::for_each(argument.array->items.begin(), argument.array->items.end(), add);
        } else {
            const Operand number = as_number(argument, reader);
            add(number);
        }
    }
    return found;
}

template <Operand (*Function)(const std::vector<double>&), Counting Counts = Counting::ranges>
Operand of_numbers(Values arguments, CellReader& reader) {
    const Gathered found = gather(arguments, reader, Counts);
    return found.stop ? *found.stop : Function(found.numbers);
}

double sum_of(const std::vector<double>& x) {
    double sum = 0.0;
    for (const double one : x) {
        sum += one;
    }
    return sum;
}

double mean_of(const std::vector<double>& x) {
    return sum_of(x) / static_cast<double>(x.size());
}

double squared_deviations(const std::vector<double>& x) {
    const double mean = mean_of(x);
    double sum = 0.0;
    for (const double one : x) {
        sum += (one - mean) * (one - mean);
    }
    return sum;
}

Operand sum(const std::vector<double>& x) {
    return Operand::of(sum_of(x));
}

Operand sum_of_squares(const std::vector<double>& x) {
    double total = 0.0;
    for (const double one : x) {
        total += one * one;
    }
    return Operand::of(total);
}

Operand product(const std::vector<double>& x) {
    double total = x.empty() ? 0.0 : 1.0;
    for (const double one : x) {
        total *= one;
    }
    return Operand::of(total);
}

Operand average(const std::vector<double>& x) {
    return x.empty() ? Operand::of(CellError::division_by_zero) : Operand::of(mean_of(x));
}

Operand median(const std::vector<double>& x) {
    if (x.empty()) {
        return Operand::of(CellError::number);
    }
    std::vector<double> sorted = x;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t middle = sorted.size() / 2;
    return Operand::of(sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2.0);
}

Operand sample_variance(const std::vector<double>& x) {
    return x.size() < 2 ? Operand::of(CellError::division_by_zero)
                        : Operand::of(squared_deviations(x) / static_cast<double>(x.size() - 1));
}

Operand population_variance(const std::vector<double>& x) {
    return x.empty() ? Operand::of(CellError::division_by_zero)
                     : Operand::of(squared_deviations(x) / static_cast<double>(x.size()));
}

Operand root_of(const Operand& variance) {
    return variance.is_number() ? Operand::of(std::sqrt(variance.number)) : variance;
}

Operand sample_deviation(const std::vector<double>& x) {
    return root_of(sample_variance(x));
}

Operand population_deviation(const std::vector<double>& x) {
    return root_of(population_variance(x));
}

Operand sum_of_squared_deviations(const std::vector<double>& x) {
    return x.empty() ? Operand::of(CellError::number) : Operand::of(squared_deviations(x));
}

Operand smallest(const std::vector<double>& x) {
    return Operand::of(x.empty() ? 0.0 : *std::min_element(x.begin(), x.end()));
}

Operand largest(const std::vector<double>& x) {
    return Operand::of(x.empty() ? 0.0 : *std::max_element(x.begin(), x.end()));
}

/// Counts what `counts` answers 1 for; an operand of its answer is the result where nothing can be told.
template <typename Counts>
Operand counted(Values arguments, CellReader& reader, const Counts& counts) {
    double count = 0.0;
    std::optional<Operand> stop;
    const auto add = [&](const Operand& one) {
        if (one.kind == OperandKind::not_evaluated || one.kind == OperandKind::stands_for_all) {
            stop = one;
        } else {
            count += counts(one) ? 1.0 : 0.0;
        }
        return true;
    };
    for (const Operand& argument : arguments) {
        if (argument.kind == OperandKind::area) {
            reader.each_cell(argument.area, add);
        } else if (argument.kind == OperandKind::array) {
            reader.spend(argument.array->items.size());
            std::for_each(argument.array->items.begin(), argument.array->items.end(), add);
        } else {
            // Values that are written as arguments: a truth value, and a text that is a number, count as numbers.
            const Operand number = as_number(argument, reader);
            add(number.kind == OperandKind::error ? argument : number);
        }
    }
    return stop ? *stop : Operand::of(count);
}

Operand count_of_numbers(Values arguments, CellReader& reader) {
    return counted(arguments, reader, [](const Operand& one) { return one.kind == OperandKind::number; });
}

Operand count_of_all(Values arguments, CellReader& reader) {
    return counted(arguments, reader, [](const Operand& one) { return one.kind != OperandKind::blank; });
}

/// Two arguments as arrays of one size.
struct Pair {
    Operand first, second;
    std::optional<Operand> stop;
};

Pair pair_of(Values arguments, CellReader& reader, CellError when_sizes_differ) {
    Pair pair{reader.values(arguments[0]), reader.values(arguments[1]), {}};
    for (const Operand* one : {&pair.first, &pair.second}) {
        if (one->kind != OperandKind::array) {
            pair.stop = *one;
            return pair;
        }
    }
    if (pair.first.array->size() != pair.second.array->size()) {
        pair.stop = Operand::of(when_sizes_differ);
    }
    reader.spend(pair.first.array->items.size() + pair.second.array->items.size());
    return pair;
}

/// The pairs of which both are numbers.
struct PairedNumbers {
    std::vector<double> x, y;
    std::optional<Operand> stop;
};

PairedNumbers paired(Values arguments, CellReader& reader) {
    const Pair pair = pair_of(arguments, reader, CellError::not_available);
    PairedNumbers found;
    found.stop = pair.stop;
    if (found.stop) {
        return found;
    }
    const OperandArray& a = *pair.first.array;
    const OperandArray& b = *pair.second.array;
    Gathered stops;
    const std::size_t most = std::max(a.stored_rows * a.columns, b.stored_rows * b.columns);
    for (std::size_t i = 0; i < std::min(most, a.size()); ++i) {
        const Operand& x = a.at(i / a.columns, i % a.columns);
        const Operand& y = b.at(i / b.columns, i % b.columns);
        for (const Operand* one : {&x, &y}) {
            if (one->stops()) {
                stops.add_stop(*one);
            }
        }
        if (x.is_number() && y.is_number()) {
            found.x.push_back(x.number);
            found.y.push_back(y.number);
        }
    }
    found.stop = stops.stop;
    return found;
}

struct Moments {
    double n = 0.0, mean_x = 0.0, mean_y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
};

Moments moments_of(const PairedNumbers& pairs) {
    Moments m{.n = static_cast<double>(pairs.x.size()), .mean_x = mean_of(pairs.x), .mean_y = mean_of(pairs.y)};
    for (std::size_t i = 0; i < pairs.x.size(); ++i) {
        const double dx = pairs.x[i] - m.mean_x;
        const double dy = pairs.y[i] - m.mean_y;
        m.xx += dx * dx;
        m.yy += dy * dy;
        m.xy += dx * dy;
    }
    return m;
}

/// \param least  pairs that it takes
template <double (*Function)(const Moments&), std::size_t Least>
Operand of_pairs(Values arguments, CellReader& reader) {
    const PairedNumbers pairs = paired(arguments, reader);
    if (pairs.stop) {
        return *pairs.stop;
    }
    if (pairs.x.size() < Least) {
        return Operand::of(CellError::division_by_zero);
    }
    const double value = Function(moments_of(pairs));
    return std::isfinite(value) ? Operand::of(value) : Operand::of(CellError::division_by_zero);
}

// The first argument of the functions of a line holds y, the second x.
double slope(const Moments& m) {
    return m.xy / m.yy;
}
double intercept(const Moments& m) {
    return m.mean_x - slope(m) * m.mean_y;
}
double correlation(const Moments& m) {
    return m.xy / std::sqrt(m.xx * m.yy);
}
double squared_correlation(const Moments& m) {
    return m.xy * m.xy / (m.xx * m.yy);
}
double standard_error_of_line(const Moments& m) {
    return std::sqrt(std::max(0.0, m.xx - m.xy * m.xy / m.yy) / (m.n - 2.0));
}
double population_covariance(const Moments& m) {
    return m.xy / m.n;
}
double sample_covariance(const Moments& m) {
    return m.xy / (m.n - 1.0);
}

Operand forecast(Values arguments, CellReader& reader) {
    const Operand x = as_number(reader.single(arguments[0]), reader);
    if (!x.is_number()) {
        return x;
    }
    const PairedNumbers pairs = paired(arguments.subspan(1), reader);
    if (pairs.stop) {
        return *pairs.stop;
    }
    if (pairs.x.empty()) {
        return Operand::of(CellError::division_by_zero);
    }
    const Moments m = moments_of(pairs);
    return m.yy == 0.0 ? Operand::of(CellError::division_by_zero) : Operand::of(intercept(m) + slope(m) * x.number);
}

Operand sum_of_squared_differences(Values arguments, CellReader& reader) {
    const PairedNumbers pairs = paired(arguments, reader);
    if (pairs.stop) {
        return *pairs.stop;
    }
    double total = 0.0;
    for (std::size_t i = 0; i < pairs.x.size(); ++i) {
        total += (pairs.x[i] - pairs.y[i]) * (pairs.x[i] - pairs.y[i]);
    }
    return Operand::of(total);
}

Operand sum_of_products(Values arguments, CellReader& reader) {
    std::vector<Operand> arrays;
    std::size_t rows = 0, columns = 0;
    for (const Operand& argument : arguments) {
        arrays.push_back(reader.values(argument));
        if (arrays.back().kind != OperandKind::array) {
            return arrays.back();
        }
        const OperandArray& one = *arrays.back().array;
        if (one.rows != arrays.front().array->rows || one.columns != arrays.front().array->columns) {
            return Operand::of(CellError::value);
        }
        reader.spend(one.items.size());
        rows = std::max(rows, one.stored_rows);
        columns = std::max(columns, one.stored_columns);
    }
    Gathered stops;
    double total = 0.0;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            double term = 1.0;
            for (const Operand& array : arrays) {
                const Operand& one = array.array->at(row, column);
                if (one.stops()) {
                    stops.add_stop(one);
                }
                term *= one.is_number() ? one.number : 0.0;  // text, blank cells and truth values count as 0
            }
            total += term;
        }
    }
    return stops.stop ? *stops.stop : Operand::of(total);
}

constexpr SheetFunction k_statistical[] = {
    {"AVERAGE", Taking::whole, 1, k_any_number, of_numbers<average>},
    {"AVERAGEA", Taking::whole, 1, k_any_number, of_numbers<average, Counting::everything>},
    {"CORREL", Taking::arrays, 2, 2, of_pairs<correlation, 1>},
    {"COUNT", Taking::whole, 1, k_any_number, count_of_numbers},
    {"COUNTA", Taking::whole, 1, k_any_number, count_of_all},
    {"COVAR", Taking::arrays, 2, 2, of_pairs<population_covariance, 1>},
    {"COVARIANCE.P", Taking::arrays, 2, 2, of_pairs<population_covariance, 1>},
    {"COVARIANCE.S", Taking::arrays, 2, 2, of_pairs<sample_covariance, 2>},
    {"DEVSQ", Taking::whole, 1, k_any_number, of_numbers<sum_of_squared_deviations>},
    {"FORECAST", Taking::arrays, 3, 3, forecast},
    {"FORECAST.LINEAR", Taking::arrays, 3, 3, forecast},
    {"INTERCEPT", Taking::arrays, 2, 2, of_pairs<intercept, 1>},
    {"MAX", Taking::whole, 1, k_any_number, of_numbers<largest>},
    {"MEDIAN", Taking::whole, 1, k_any_number, of_numbers<median>},
    {"MIN", Taking::whole, 1, k_any_number, of_numbers<smallest>},
    {"PEARSON", Taking::arrays, 2, 2, of_pairs<correlation, 1>},
    {"PRODUCT", Taking::whole, 1, k_any_number, of_numbers<product>},
    {"RSQ", Taking::arrays, 2, 2, of_pairs<squared_correlation, 1>},
    {"SLOPE", Taking::arrays, 2, 2, of_pairs<slope, 1>},
    {"STDEV", Taking::whole, 1, k_any_number, of_numbers<sample_deviation>},
    {"STDEV.P", Taking::whole, 1, k_any_number, of_numbers<population_deviation>},
    {"STDEV.S", Taking::whole, 1, k_any_number, of_numbers<sample_deviation>},
    {"STDEVA", Taking::whole, 1, k_any_number, of_numbers<sample_deviation, Counting::everything>},
    {"STDEVP", Taking::whole, 1, k_any_number, of_numbers<population_deviation>},
    {"STEYX", Taking::arrays, 2, 2, of_pairs<standard_error_of_line, 3>},
    {"SUM", Taking::whole, 1, k_any_number, of_numbers<sum>},
    {"SUMPRODUCT", Taking::arrays, 1, k_any_number, sum_of_products},
    {"SUMSQ", Taking::whole, 1, k_any_number, of_numbers<sum_of_squares>},
    {"SUMXMY2", Taking::arrays, 2, 2, sum_of_squared_differences},
    {"VAR", Taking::whole, 1, k_any_number, of_numbers<sample_variance>},
    {"VAR.P", Taking::whole, 1, k_any_number, of_numbers<population_variance>},
    {"VAR.S", Taking::whole, 1, k_any_number, of_numbers<sample_variance>},
    {"VARP", Taking::whole, 1, k_any_number, of_numbers<population_variance>},
};

}  // namespace

std::span<const SheetFunction> statistical_functions() {
    return k_statistical;
}

}  // namespace gumcert::workbook
