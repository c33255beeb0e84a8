#include "audit/tables/row_units.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "audit/words/unit_words.h"
#include "gum/quantity/unit.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

double size_of_unit(const gum::Unit& unit) {
    return unit.difference_to_si(1.0);
}

/// What a number is meant to be used in, and whether it could be brought there.
class Conversions {
public:
    explicit Conversions(std::vector<Sentence>& not_read) : not_read_(not_read) {}

    void bring(std::optional<StatedNumber>& number, const std::string& from, const std::string& to) {
        if (!number) {
            return;
        }
        if (const std::optional<double> factor = factor_between(from, to)) {
            convert(*number, *factor);
            return;
        }
        not_read_.push_back(
            say("{cell}: a number in {from} beside others in {to}; it is not used, as one unit cannot "
                "be turned into the other",
                number->place, text::in_quotes(from), text::in_quotes(to)));
        number.reset();
    }

private:
    std::vector<Sentence>& not_read_;
};

bool is_one(const std::optional<StatedNumber>& c) {
    return !c || std::abs(c->value) == 1.0;
}

/// u as the row has it, or what it was divided from.
double u_of(const AuditedRow& row) {
    if (row.u) {
        return std::abs(row.u->value);
    }
    const bool divided = row.stated && row.divisor && row.divisor->value > 0.0;
    return divided ? std::abs(row.stated->value / row.divisor->value) : 0.0;
}

/// Whether a contribution is nearer to u times one factor than to u times another. Units of one kind differ by factors of ten
/// at least, and errors of a row by less.
bool is_nearer(double factor, double other, const StatedNumber& contribution, double u) {
    const double size = std::abs(contribution.value);
    const auto distance = [&](double by) { return std::abs(std::log(u * by / size)); };
    return size > 0.0 && u > 0.0 && distance(factor) < distance(other);
}

/// The unit of the contributions that state none.
std::string unit_of_contributions(const std::vector<AuditedRow>& rows, const std::vector<RowUnits>& units,
                                  const std::string& result_unit) {
    std::vector<std::pair<double, std::size_t>> counts;  // factor to the result, rows
    std::vector<std::string> names;
    std::size_t all = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::optional<double> factor = factor_between(rows[i].unit, result_unit);
        if (rows[i].unit.empty() || !factor || !is_one(rows[i].sensitivity) || !units[i].sensitivity.empty()) {
            continue;
        }
        ++all;
        const bool is_in_result = rows[i].contribution && is_nearer(*factor, 1.0, *rows[i].contribution, u_of(rows[i]));
        factor = is_in_result ? 1.0 : *factor;
        const auto known =
            std::find_if(counts.begin(), counts.end(), [&factor](const auto& count) { return count.first == *factor; });
        if (known == counts.end()) {
            counts.emplace_back(*factor, 1);
            names.push_back(is_in_result ? result_unit : rows[i].unit);
        } else {
            ++known->second;
        }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (2 * counts[i].second > all) {
            return names[i];
        }
    }
    return result_unit;
}

/// The unit that contributions state, more of them than state none; "" where no unit is stated by as many.
std::string unit_of_most(const std::vector<AuditedRow>& rows, const std::vector<RowUnits>& units) {
    std::map<std::string, std::size_t> counts;
    std::size_t bare = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!units[i].contribution.empty()) {
            ++counts[units[i].contribution];
        } else if (rows[i].contribution) {
            ++bare;
        }
    }
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() || most->second <= bare ? "" : most->first;
}

/// The unit of a contribution that states none beside others that do: theirs, unless |c| u is nearer to it in that of the others
/// without one.
const std::string& unit_beside_others(const AuditedRow& row, const RowUnits& own, const std::string& of_others,
                                      const std::string& of_bare, const std::string& result_unit) {
    const std::optional<double> in_others = factor_between(of_others, result_unit),
                                in_bare = factor_between(of_bare, result_unit),
                                of_row = factor_between(row.unit, result_unit);
    const bool is_bare = own.sensitivity.empty() && of_row && in_others && in_bare && row.contribution;
    const double c = row.sensitivity ? std::abs(row.sensitivity->value) : 1.0;
    return is_bare && is_nearer(*of_row / *in_bare, *of_row / *in_others, *row.contribution, c * u_of(row)) ? of_bare
                                                                                                            : of_others;
}

/// The factor of a coefficient whose unit is stated; nothing where the unit is of another kind, which is a matter of S01.
std::optional<double> factor_of_stated(const gum::Unit& c, const gum::Unit& row, const gum::Unit& result) {
    if (c.dimension() == result.dimension() / row.dimension()) {
        return size_of_unit(c) * size_of_unit(row) / size_of_unit(result);
    }
    return std::nullopt;
}

/// The factor of a coefficient without a unit.
/// \param of_number  where it is a number of the unit of the contribution per the unit of the row
double factor_of_bare(const AuditedRow& row, const std::string& result_unit, double of_number) {
    std::optional<double> of_quantity = factor_between(row.unit, result_unit);
    if (!of_quantity && is_unit_of_part(row.unit)) {
        of_quantity =
            size_of_unit(*known_unit(row.unit));  // 2.3 mg of a row in percent, as it is multiplied with 0.005
    }
    const double c = row.sensitivity ? std::abs(row.sensitivity->value) : 1.0;
    const double u = u_of(row);
    if (!of_quantity || row.unit.empty() || *of_quantity == of_number || !row.contribution || !(c * u > 0.0)) {
        return of_number;
    }
    return is_nearer(*of_quantity, of_number, *row.contribution, c * u) ? *of_quantity : of_number;
}

void settle_coefficient(AuditedRow& row, const std::string& own, const std::string& result_unit, double of_number,
                        std::vector<Sentence>& not_read) {
    std::optional<double> factor;
    const std::optional<gum::Unit> c = own.empty() ? std::nullopt : known_unit(own);
    if (row.sensitivity && !own.empty() && !c) {
        not_read.push_back(
            say("{cell}: the unit {unit} of the sensitivity coefficient is not read; the number is taken as "
                "it stands",
                row.sensitivity->place, text::in_quotes(own)));
    }
    const bool is_bare = own == "1" || own == "-" || own == "–";
    if (row.sensitivity && c && !is_bare) {
        const std::optional<gum::Unit> of_row = known_unit(row.unit), of_result = known_unit(result_unit);
        if (!of_row && of_result && c->dimension() == of_result->dimension()) {
            factor = size_of_unit(*c) / size_of_unit(*of_result);
        } else if ((!of_row || !of_result) && own == "%") {
            factor = 0.01;
        } else if (of_row && of_result) {
            row.sensitivity_unit = own;
            factor = factor_of_stated(*c, *of_row, *of_result);
            if (!factor && c->dimension() == of_result->dimension()) {  // "0.021 %" of a coefficient per kelvin
                row.sensitivity_unit.clear();
                factor = size_of_unit(*c) / size_of_unit(*of_result);
            } else if (!factor) {
                factor = 1.0;  // S01 tells of it
            }
        }
    }
    const double used = factor ? *factor : factor_of_bare(row, result_unit, of_number);
    if (used == 1.0) {
        return;
    }
    if (!row.sensitivity && row.contribution && u_of(row) > 0.0) {
        return;  // what the contribution is of u says it
    }
    if (!row.sensitivity) {
        row.sensitivity = exact_number(1.0, row.place);
    }
    convert(*row.sensitivity, used);
}

}  // namespace

bool settle_units(std::vector<AuditedRow>& rows, const std::vector<RowUnits>& units, const std::string& result_unit,
                  std::vector<Sentence>& not_read) {
    bool is_usable = true;
    const auto has_uncertainty = [](const AuditedRow& row) { return row.u || row.stated || row.contribution; };
    Conversions conversions(not_read);
    const std::string of_contributions = unit_of_contributions(rows, units, result_unit),
                      of_others = unit_of_most(rows, units);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        AuditedRow& row = rows[i];
        const RowUnits& own = units[i];
        const bool had_uncertainty = has_uncertainty(row);
        conversions.bring(row.estimate, own.estimate, row.unit);
        conversions.bring(row.stated, own.stated, row.unit);
        conversions.bring(row.u, own.u, row.unit);
        const std::string& of_contribution =
            !own.contribution.empty() ? own.contribution
            : of_others.empty()       ? of_contributions
                                      : unit_beside_others(row, own, of_others, of_contributions, result_unit);
        conversions.bring(row.contribution, of_contribution, result_unit);
        settle_coefficient(row, own.sensitivity, result_unit,
                           factor_between(of_contribution, result_unit).value_or(1.0), not_read);
        is_usable = is_usable && (has_uncertainty(row) || !had_uncertainty);
    }
    return is_usable;
}

}  // namespace gumcert::audit
