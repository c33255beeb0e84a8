#include "engine/rotary_table/start/shifted_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/degrees_text.h"
#include "engine/rotary_table/rotation.h"
#include "engine/rotary_table/start/fit_limits.h"
#include "engine/rotary_table/start/place_search.h"
#include "engine/rotary_table/start/selected_lengths.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

namespace {

using AngleReading = std::map<std::size_t, std::size_t>;  ///< an angle that is stated, and the one that is read

/// What a station says without the others.
struct PassAlone {
    std::size_t pass = 0;
    std::vector<bool> lengths;
    StationFit fit;
    bool fits = false;
};

/// Of all angles when they are shifted by one offset; those that are none of the measurement become new ones of it.
AngleReading shifted(RotaryTableMeasurement& measurement, const std::vector<bool>& lengths, double shift) {
    constexpr double k_alike = 1e-6 * gum::k_degree;
    AngleReading reading;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const std::size_t stated = measurement.lengths[i].angle;
        if (!lengths[i] || reading.contains(stated)) {
            continue;
        }
        const double angle = measurement.angles[stated] + shift;
        const auto known = std::ranges::find_if(measurement.angles, [&](double one) {
            return std::abs(std::remainder(one - angle, 2.0 * std::numbers::pi)) < k_alike;
        });
        reading[stated] = static_cast<std::size_t>(known - measurement.angles.begin());
        if (known == measurement.angles.end()) {
            measurement.angles.push_back(angle);
        }
    }
    return reading;
}

AngleReading in_reverse_order(const RotaryTableMeasurement& measurement, const std::vector<bool>& lengths) {
    std::map<double, std::size_t> by_size;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (lengths[i]) {
            by_size[measurement.angles[measurement.lengths[i].angle]] = measurement.lengths[i].angle;
        }
    }
    AngleReading reading;
    auto other = by_size.rbegin();
    for (const auto& [angle, stated] : by_size) {
        reading[stated] = (other++)->second;
    }
    return reading;
}

/// Whether two passes fit one place when the angles of the second are read otherwise.
bool agree_when_read(RotaryTableMeasurement measurement, std::size_t station, const PassAlone& first,
                     const PassAlone& second, const AngleReading& reading, double limit) {
    std::vector<bool> both = first.lengths;
    for (std::size_t i = 0; i < both.size(); ++i) {
        if (second.lengths[i]) {
            both[i] = true;
            measurement.lengths[i].angle = reading.at(measurement.lengths[i].angle);
        }
    }
    return PlaceSearch(measurement, both).fit_near(station, first.fit).upright_misfit() < limit;
}

[[noreturn]] void refuse_pass(const RotaryTableMeasurement& measurement, std::size_t station, std::size_t pass,
                              const std::string& what, const std::string& action) {
    throw gum::NoResultError(gum::Diagnostic{
        "GC-ADJUST-0013", "lengths, station " + measurement.stations[station] + ", pass " + measurement.passes[pass],
        what, "an angle that several passes measure is stated alike in all of them", action, gum::Severity::error});
}

}  // namespace

void refuse_angles_of_pass(const RotaryTableMeasurement& measurement, std::size_t station, double misfit) {
    constexpr double k_same_place = 0.02;                   // [m]
    constexpr double k_least_shift = 0.01 * gum::k_degree;  // what is less is a motion of the table
    const double limit = k_share_with_right_labels * misfit;
    std::vector<PassAlone> passes;
    for (std::size_t pass = 0; pass < measurement.passes.size(); ++pass) {
        std::vector<bool> lengths = lengths_of_station(measurement, station, pass);
        const PlaceSearch search(measurement, lengths);
        if (!search.tells_causes(station)) {
            continue;
        }
        StationFit fit = search.fit_of(station, true);
        const bool fits = fit.upright_misfit() < limit;
        passes.push_back({pass, std::move(lengths), std::move(fit), fits});
    }
    // The place of most passes: of two that differ the first.
    const PassAlone* reference = nullptr;
    std::size_t most = 0;
    const auto is_there = [&](const PassAlone& one, const PassAlone& other) {
        return one.fits && other.fits && (one.fit.position - other.fit.position).norm() < k_same_place;
    };
    for (const PassAlone& one : passes) {
        const auto there = static_cast<std::size_t>(
            std::ranges::count_if(passes, [&](const PassAlone& other) { return is_there(one, other); }));
        if (there > most) {
            most = there;
            reference = &one;
        }
    }
    if (reference == nullptr) {
        return;
    }
    for (const PassAlone& other : passes) {
        if (is_there(*reference, other)) {
            continue;
        }
        const std::string& name = measurement.passes[reference->pass];
        if (!other.fits) {
            if (agree_when_read(measurement, station, *reference, other, in_reverse_order(measurement, other.lengths),
                                limit)) {
                refuse_pass(measurement, station, other.pass,
                            "its distances agree with those of pass " + name +
                                " when its angles are stated in the reverse order",
                            "see in which order the table was driven to its angles, and correct them in this pass");
            }
            continue;
        }
        // Angles that are too large by an offset turn the place that is found by it.
        for (const double angle : measurement.angles) {
            const double shift = std::remainder(angle - measurement.angles.front(), 2.0 * std::numbers::pi);
            const Eigen::Vector3d turned =
                axis_rotation(axial_coordinate(measurement.axis), -shift) * other.fit.position;
            if (std::abs(shift) < k_least_shift || (turned - reference->fit.position).norm() > k_same_place) {
                continue;
            }
            RotaryTableMeasurement read = measurement;
            const AngleReading reading = shifted(read, other.lengths, -shift);
            if (agree_when_read(std::move(read), station, *reference, other, reading, limit)) {
                const double degrees = std::round(std::abs(shift) / gum::k_degree * 1e6) / 1e6;
                refuse_pass(
                    measurement, station, other.pass,
                    "its distances agree with those of pass " + name + " when its angles are " + degrees_text(degrees) +
                        (shift > 0.0 ? " lower" : " higher"),
                    "see at which angle each of the two passes began, and correct the angles of the one that "
                    "is wrong; or, where the station was moved or stations are interchanged in one of them, "
                    "give each place its own station name: these are " +
                        std::to_string(std::lround(1e3 * (other.fit.position - reference->fit.position).norm())) +
                        " mm apart");
            }
        }
    }
}

void refuse_shifted_angles(const RotaryTableMeasurement& measurement) {
    constexpr double k_alike = 1e-6 * gum::k_degree;
    constexpr double k_most_shared = 0.5;
    constexpr double k_explained = 0.8;
    const auto turns = [](double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); };
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        std::vector<bool> own(measurement.angles.size(), false);
        std::vector<bool> others = own;
        for (const LengthObservation& length : measurement.lengths) {
            (length.station == j ? own : others)[length.angle] = true;
        }
        // How many of its angles are those of the others when they are shifted.
        const auto shared = [&](double shift) {
            double count = 0.0;
            double all = 0.0;
            for (std::size_t a = 0; a < own.size(); ++a) {
                if (own[a]) {
                    all += 1.0;
                    for (std::size_t b = 0; b < own.size(); ++b) {
                        if (others[b] &&
                            std::abs(turns(measurement.angles[a] + shift - measurement.angles[b])) < k_alike) {
                            count += 1.0;
                            break;
                        }
                    }
                }
            }
            return all > 2.0 ? count / all : 1.0;
        };
        if (shared(0.0) > k_most_shared) {
            continue;
        }
        const auto first = static_cast<std::size_t>(std::ranges::find(own, true) - own.begin());
        std::optional<double> best;
        for (std::size_t b = 0; b < own.size(); ++b) {
            const double shift = turns(measurement.angles[b] - measurement.angles[first]);
            if (others[b] && (!best || std::abs(shift) < std::abs(*best)) && shared(shift) > k_explained) {
                best = shift;
            }
        }
        if (best) {
            const double degrees = std::round(std::abs(*best) / gum::k_degree * 1e6) / 1e6;
            throw gum::NoResultError(gum::Diagnostic{
                "GC-ADJUST-0013", "lengths, station " + measurement.stations[j],
                "its angles are those of the other stations when they are " + degrees_text(degrees) +
                    (*best > 0.0 ? " higher" : " lower"),
                "an angle that several stations measure is stated alike for all of them",
                "state the angles to which the table was driven, from the same origin and rounded alike",
                gum::Severity::error});
        }
    }
}

}  // namespace gumcert::engine
