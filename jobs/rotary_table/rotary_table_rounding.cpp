#include "jobs/rotary_table/rotary_table_rounding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "gum/quantity/units.h"
#include "jobs/input_codes.h"
#include "text/numbers.h"

namespace gumcert::jobs {

namespace {

constexpr std::size_t k_fewest = 20;  // differences of lengths: one in ten ends in a zero by chance
constexpr double k_told = 1.2;        // of the stated u: who states 0.28 µm of a step of 1 µm has it in
constexpr double k_refused = 3.0;
// The part of u in proportion is that of the whole distance, of which a displayed length lacks the dead path. That is not
// known yet: where a station stands farther away, less is told.
constexpr double k_dead_path = 3.0;  // [m]
// Returns whose noise is above a third of step/√12, a tenth of a step, are rounded differently often enough.
constexpr double k_alike = 3.0;
constexpr double k_repeated = 0.1;  // of the lengths
// Of returns of one place: with a scatter of 0.3 steps, of the table too, it is less, and hardly any rounding is left in the mean.
constexpr double k_same = 2.0 / 3.0;
constexpr double k_nanometre = 1e-9;

std::string micrometres(double length, int digits) {
    return text::significant(length / gum::k_micrometre, digits) + " µm";
}

/// How many lengths another pass shows to the last digit, at the same reflector and angle and on the same dead path. Nothing where
/// returns are scattered over steps: what the table does then rounds each of them differently.
std::size_t lengths_shown_again(const std::vector<engine::LengthObservation>& lengths) {
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::map<std::int64_t, std::size_t>> places;
    for (const engine::LengthObservation& length : lengths) {
        ++places[{length.dead_path, length.reflector, length.angle}][std::llround(length.length / k_nanometre)];
    }
    std::size_t again = 0;
    double pairs = 0.0;
    double same = 0.0;
    for (const auto& [place, shown] : places) {
        double all = 0.0;
        for (const auto& [number, times] : shown) {
            const auto count = static_cast<double>(times);
            again += times > 1 ? times : 0;
            same += count * (count - 1.0);
            all += count;
        }
        pairs += all * (all - 1.0);
    }
    return same > k_same * pairs ? again : 0;
}

}  // namespace

std::optional<double> step_of_lengths(const std::vector<engine::LengthObservation>& lengths) {
    constexpr double k_whole = 1e-3;  // of a nanometre: what a double has of 100 m is a hundredth of it
    std::vector<std::pair<std::size_t, std::int64_t>> shown;  // by dead path
    for (const engine::LengthObservation& length : lengths) {
        const double nanometres = length.length / k_nanometre;
        const double whole = std::round(nanometres);
        if (!(std::abs(nanometres - whole) < k_whole)) {
            return std::nullopt;
        }
        shown.emplace_back(length.dead_path, static_cast<std::int64_t>(whole));
    }
    std::ranges::sort(shown);
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    std::size_t differences =
        0;  // only they tell of a step: two lengths of a dead path are multiples of theirs, whatever it is
    std::int64_t step = 0;
    for (std::size_t i = 1; i < shown.size(); ++i) {
        if (shown[i].first == shown[i - 1].first) {
            step = std::gcd(step, shown[i].second - shown[i - 1].second);
            ++differences;
        }
    }
    return differences < k_fewest ? std::nullopt : std::optional(static_cast<double>(step) * k_nanometre);
}

void check_rounding(const RotaryTableReading& reading) {
    const engine::RotaryTableMeasurement& measurement = reading.job().measurement;
    const engine::LengthUncertainty& stated = measurement.length_uncertainty;
    const std::optional<double> step = step_of_lengths(measurement.lengths);
    if (!step || !(stated.u_constant > 0.0 || stated.u_proportional > 0.0)) {
        return;
    }
    double longest = 0.0;
    for (const engine::LengthObservation& length : measurement.lengths) {
        longest = std::max(longest, std::abs(length.length));
    }
    const double of_rounding = *step / std::sqrt(12.0);
    longest += k_dead_path;
    const double noise = std::hypot(stated.u_constant, stated.u_proportional * longest);
    const std::string at = stated.u_proportional > 0.0 ? " at " + text::significant(longest, 2) + " m" : "";
    const double u = std::hypot(noise, stated.resolution / std::sqrt(12.0));
    const std::string where = reading.root.where("length_uncertainty");
    const std::string rounded = "all lengths are rounded to multiples of " + micrometres(*step, 6);
    const std::string alone = ", and rounding alone has a standard uncertainty of " + micrometres(of_rounding, 2);
    if (of_rounding > k_told * u) {
        const std::string what = rounded + alone + ", while " + micrometres(u, 2) + " is stated" + at;
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
    const std::size_t again = of_rounding > k_alike * noise ? lengths_shown_again(measurement.lengths) : 0;
    if (static_cast<double>(again) > k_repeated * static_cast<double>(measurement.lengths.size())) {
        reading.problems.warn(
            k_warn_rounded_alike, where,
            rounded + ", many times their noise of " + micrometres(noise, 2) + at + ", and " + std::to_string(again) +
                " of " + std::to_string(measurement.lengths.size()) + " come back in another pass to the last digit",
            "what rounding does to a length is independent from reading to reading where their noise is not small "
            "beside the step; else it is in the mean as in each of them, and the stated uncertainties are too small",
            "state the lengths with all digits that the instrument shows, or evaluate one pass of each station");
    }
}

}  // namespace gumcert::jobs
