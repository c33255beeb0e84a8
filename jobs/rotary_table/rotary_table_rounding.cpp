#include "jobs/rotary_table/rotary_table_rounding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include "gum/quantity/units.h"
#include "jobs/input_codes.h"
#include "text/numbers.h"

namespace gumcert::jobs {

namespace {

constexpr std::size_t k_fewest = 20;  // lengths: one in ten ends in a zero by chance
constexpr double k_told = 1.2;        // of the stated u: who states 0.28 µm of a step of 1 µm has it in
constexpr double k_refused = 3.0;
// Returns whose noise is above a third of step/√12, a tenth of a step, are rounded differently often enough.
constexpr double k_alike = 3.0;
constexpr double k_repeated = 0.1;  // of the lengths

std::string micrometres(double length, int digits) {
    return text::significant(length / gum::k_micrometre, digits) + " µm";
}

/// How many lengths are of a station, reflector and angle that another pass has as well.
std::size_t repeated_lengths(const std::vector<engine::LengthObservation>& lengths) {
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::size_t> places;
    for (const engine::LengthObservation& length : lengths) {
        ++places[{length.station, length.reflector, length.angle}];
    }
    std::size_t repeated = 0;
    for (const auto& [place, count] : places) {
        repeated += count > 1 ? count : 0;
    }
    return repeated;
}

}  // namespace

std::optional<double> step_of_lengths(const std::vector<engine::LengthObservation>& lengths) {
    constexpr double k_nanometre = 1e-9;
    constexpr double k_whole = 1e-3;  // of a nanometre: what a double has of 100 m is a hundredth of it
    if (lengths.size() < k_fewest) {
        return std::nullopt;
    }
    std::vector<std::optional<std::int64_t>> first;
    std::int64_t step = 0;
    for (const engine::LengthObservation& length : lengths) {
        const double nanometres = length.length / k_nanometre;
        const double whole = std::round(nanometres);
        if (!(std::abs(nanometres - whole) < k_whole)) {
            return std::nullopt;
        }
        const auto number = static_cast<std::int64_t>(whole);
        first.resize(std::max(first.size(), length.dead_path + 1));
        if (!first[length.dead_path]) {
            first[length.dead_path] = number;
        }
        step = std::gcd(step, number - *first[length.dead_path]);
    }
    return step > 0 ? std::optional(static_cast<double>(step) * k_nanometre) : std::nullopt;
}

void check_rounding(const RotaryTableReading& reading) {
    const engine::RotaryTableMeasurement& measurement = reading.job().measurement;
    const engine::LengthUncertainty& stated = measurement.length_uncertainty;
    const std::optional<double> step = step_of_lengths(measurement.lengths);
    if (!step || !(stated.u_constant > 0.0)) {
        return;
    }
    double longest = 0.0;
    for (const engine::LengthObservation& length : measurement.lengths) {
        longest = std::max(longest, std::abs(length.length));
    }
    const double of_rounding = *step / std::sqrt(12.0);
    const double noise = std::hypot(stated.u_constant, stated.u_proportional * longest);
    const double u = std::hypot(noise, stated.resolution / std::sqrt(12.0));
    const std::string where = reading.root.where("length_uncertainty");
    const std::string rounded = "all lengths are rounded to multiples of " + micrometres(*step, 6);
    const std::string alone = ", and rounding alone has a standard uncertainty of " + micrometres(of_rounding, 2);
    if (of_rounding > k_told * u) {
        const std::string what = rounded + alone + ", while " + micrometres(u, 2) + " is stated";
        const std::string rule =
            "a length that is shown in steps lies anywhere within one: u = step/√12 (JCGM 100:2008, F.2.2.1), and the "
            "uncertainty of a length has that in it";
        const std::string action =
            "state the lengths with all digits that the instrument shows; where it shows no more, "
            "state \"resolution_um\": " +
            text::significant(*step / gum::k_micrometre, 6);
        if (of_rounding > k_refused * u) {
            reading.problems.refuse(k_rounded_lengths, where, what, rule, action);
        } else {
            reading.problems.warn(k_warn_rounded_lengths, where, what, rule, action);
        }
        return;
    }
    const std::size_t repeated = repeated_lengths(measurement.lengths);
    if (of_rounding > k_alike * noise &&
        static_cast<double>(repeated) > k_repeated * static_cast<double>(measurement.lengths.size())) {
        reading.problems.warn(
            k_warn_rounded_alike, where,
            rounded + ", many times their noise of " + micrometres(noise, 2) + ", and " + std::to_string(repeated) +
                " of " + std::to_string(measurement.lengths.size()) + " come back in another pass, rounded alike",
            "what rounding does to a length is independent from reading to reading where their noise is not small "
            "beside the step; else it is in the mean as in each of them, and the stated uncertainties are too small",
            "state the lengths with all digits that the instrument shows, or evaluate one pass of each station");
    }
}

}  // namespace gumcert::jobs
