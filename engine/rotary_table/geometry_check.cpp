#include "engine/rotary_table/geometry_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include "engine/degrees_text.h"
#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

// Above this condition of its position and dead paths a station is close to the cone that leaves it open. Stations of
// the design note (rotary-table.md, 4c, 4e) have up to 1300 over a single angle and 2400 with a dead path of each
// reflector; a ring of reflectors seen from its axis with alternate holders raised by 50 mm has 4000.
constexpr double k_condition_limit = 3000.0;
// Spread of the directions to the stations. Computed for the layout of the design note drawn together about one
// direction (geometry_check_test.cpp): against the wide layout the standard deviation of the rotation about the axis
// is 4.5 times as large at 20° and 11 times at 8°, those of the translations across the line of sight 3.6 and 8 times.
constexpr double k_station_spread = 20.0 * gum::k_degree;
// Distance of a station against the size of the fixture: what a station tells of the pose falls with the square.
constexpr double k_distance_ratio = 8.0;
constexpr double k_usual_ratio = 3.0;
// Thickness of the reflectors along the axis against their extent across it.
constexpr double k_flatness = 0.05;
constexpr double k_same_angle = 0.01 * gum::k_degree;

/// Rounded to `digits` significant digits, without exponent for everyday sizes.
std::string rounded(double value, int digits) {
    if (value == 0.0 || !std::isfinite(value)) {
        return value == 0.0 ? "0" : "∞";
    }
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
    const double unit = std::pow(10.0, exponent - digits + 1);
    const double nearest = std::round(value / unit) * unit;
    return text::fixed(nearest, std::clamp(digits - 1 - exponent, 0, 12));
}

std::string in_mm(double metres) {
    const double mm = metres / gum::k_millimetre;
    // Below a micrometre a position is as good as exact.
    return (std::abs(mm) < 1e-3 ? "0" : rounded(mm, std::abs(mm) < 1000.0 ? 2 : 4)) + " mm";
}

std::string in_degrees(double radians) {
    return text::fixed(std::round(radians / gum::k_degree * 10.0) / 10.0, 1) + "°";
}

/// How the reflectors look from a station over all angles at which it saw them, set-up errors and motions left out.
class StationView {
public:
    StationView(const RotaryTableMeasurement& measurement, std::size_t station)
        : across_(across_axis(measurement.axis)), axial_(axial_coordinate(measurement.axis)) {
        for (const LengthObservation& length : measurement.lengths) {
            if (length.station != station) {
                continue;
            }
            auto found = std::find(paths_.begin(), paths_.end(), length.dead_path);
            if (found == paths_.end()) {
                found = paths_.insert(found, length.dead_path);
            }
            path_.push_back(static_cast<Eigen::Index>(found - paths_.begin()));
            reflector_.push_back(length.reflector);
            turn_.push_back(nominal_rotation(measurement, length.angle));
            fixture_.emplace_back(measurement.fixture.row(static_cast<Eigen::Index>(length.reflector)));
        }
        // Alternate holders: every other one in the order of their direction about the axis.
        std::vector<std::pair<double, std::size_t>> order;
        for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
            order.emplace_back(std::atan2(measurement.fixture(m, across_[1]), measurement.fixture(m, across_[0])),
                               static_cast<std::size_t>(m));
        }
        std::sort(order.begin(), order.end());
        alternate_.resize(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            alternate_[order[k].second] = k % 2 == 0;
        }
    }

    /// Condition number of the derivatives with respect to position and dead paths (columns of 1 and direction
    /// cosines); infinite where they are singular. `raised`: alternate holders moved along the axis, [m].
    [[nodiscard]] double condition(const Eigen::Vector3d& position, double raised = 0.0) const {
        const auto columns = static_cast<Eigen::Index>(3 + paths_.size());
        const auto n = static_cast<Eigen::Index>(path_.size());
        if (n < columns) {
            return std::numeric_limits<double>::infinity();
        }
        Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, columns);
        for (Eigen::Index i = 0; i < n; ++i) {
            rows.row(i).head<3>() = direction(static_cast<std::size_t>(i), position, raised).transpose();
            rows(i, 3 + path_[static_cast<std::size_t>(i)]) = 1.0;
        }
        // R has the singular values of the whole matrix, and is as small as the number of columns.
        const Eigen::HouseholderQR<Eigen::MatrixXd> factor(rows);
        const Eigen::MatrixXd upper = factor.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
        const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(upper).singularValues();
        return values[columns - 1] > 1e-14 * values[0] ? values[0] / values[columns - 1]
                                                       : std::numeric_limits<double>::infinity();
    }

    /// The line about which the reflectors are most nearly on a cone, away from the station, and the angles to it.
    struct Cone {
        Eigen::Vector3d line = Eigen::Vector3d::UnitX();
        double smallest = std::numbers::pi;  ///< [rad]
        double largest = 0.0;                ///< [rad]
    };

    [[nodiscard]] Cone cone(const Eigen::Vector3d& position) const {
        std::vector<Eigen::Vector3d> mean(paths_.size(), Eigen::Vector3d::Zero());
        std::vector<double> count(paths_.size(), 0.0);
        Eigen::Vector3d middle = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < path_.size(); ++i) {
            const Eigen::Vector3d u = direction(i, position, 0.0);
            mean[static_cast<std::size_t>(path_[i])] += u;
            count[static_cast<std::size_t>(path_[i])] += 1.0;
            middle += u;
        }
        Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
        for (std::size_t i = 0; i < path_.size(); ++i) {
            const auto d = static_cast<std::size_t>(path_[i]);
            // About the mean of each dead path: a constant angle to a line is just what its constant takes up.
            const Eigen::Vector3d centred = direction(i, position, 0.0) - mean[d] / count[d];
            scatter += centred * centred.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
        Cone result;
        result.line = eigen.eigenvectors().col(0);
        if (result.line.dot(middle) < 0.0) {
            result.line = -result.line;
        }
        for (std::size_t i = 0; i < path_.size(); ++i) {
            // An arc cosine is good enough here: these angles are told in tenths of a degree.
            const double angle = std::acos(std::clamp(result.line.dot(direction(i, position, 0.0)), -1.0, 1.0));
            result.smallest = std::min(result.smallest, angle);
            result.largest = std::max(result.largest, angle);
        }
        return result;
    }

    /// What brings the condition below the limit: the least of some everyday moves that does.
    [[nodiscard]] std::string cure(const Eigen::Vector3d& position) const {
        Eigen::Vector3d outwards = position;
        outwards[axial_] = 0.0;
        outwards = outwards.norm() > gum::k_millimetre ? outwards.normalized()
                                                       : Eigen::Vector3d(Eigen::Vector3d::Unit(across_[0]));
        const std::string axis(1, "xyz"[axial_]);
        std::string text;
        // The least everyday move below the limit; failing that the best one, if it makes a difference.
        const auto add = [&](const std::string& verb, const std::string& rest, std::initializer_list<double> sizes,
                             const auto& condition_of) {
            double best = 0.2 * condition(position);
            double chosen = 0.0;
            for (const double size : sizes) {
                const double value = condition_of(size);
                if (value < k_condition_limit || value < best) {
                    best = value;
                    chosen = size;
                }
                if (value < k_condition_limit) {
                    break;
                }
            }
            if (chosen > 0.0) {
                text += (text.empty() ? "" : ", or ") + verb + in_mm(chosen) + rest + " (condition number then " +
                        rounded(best, 2) + ")";
            }
        };
        add("move the station off the rotary axis by ", off_axis(position) > gum::k_millimetre ? " more" : "",
            {0.05, 0.1, 0.2, 0.3, 0.5, 0.8}, [&](double move) { return condition(position + move * outwards); });
        add("raise alternate holders by ", " along " + axis, {0.02, 0.05, 0.1, 0.15, 0.2},
            [&](double raise) { return condition(position, raise); });
        return text.empty() ? "move the station to another place or nearer to the fixture, and place reflectors at "
                              "different heights along " +
                                  axis
                            : text;
    }

    [[nodiscard]] double off_axis(const Eigen::Vector3d& position) const {
        return std::hypot(position[across_[0]], position[across_[1]]);
    }
    [[nodiscard]] int axial() const { return axial_; }
    [[nodiscard]] bool empty() const { return path_.empty(); }
    [[nodiscard]] std::size_t paths() const { return paths_.size(); }

    /// Mean position of the reflectors and root mean square diameter about it.
    [[nodiscard]] std::pair<Eigen::Vector3d, double> cloud() const {
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < path_.size(); ++i) {
            centre += turn_[i] * fixture_[i] / static_cast<double>(path_.size());
        }
        double squares = 0.0;
        for (std::size_t i = 0; i < path_.size(); ++i) {
            squares += (turn_[i] * fixture_[i] - centre).squaredNorm();
        }
        return {centre, 2.0 * std::sqrt(squares / static_cast<double>(path_.size()))};
    }

    [[nodiscard]] std::string how_it_stands(const Eigen::Vector3d& position) const {
        const Cone seen = cone(position);
        const bool one = in_degrees(seen.smallest) == in_degrees(seen.largest);
        const std::string axis = std::abs(seen.line[axial_]) > std::cos(5.0 * gum::k_degree) ? "the axis" : "one line";
        return "stands " + in_mm(off_axis(position)) + " off the rotary axis and sees all reflectors under " +
               (one ? in_degrees(seen.smallest) : in_degrees(seen.smallest) + " to " + in_degrees(seen.largest)) +
               " to " + axis;
    }

private:
    [[nodiscard]] Eigen::Vector3d direction(std::size_t i, const Eigen::Vector3d& position, double raised) const {
        Eigen::Vector3d point = fixture_[i];
        if (alternate_[reflector_[i]]) {
            point[axial_] += raised;
        }
        return (turn_[i] * point - position).normalized();
    }

    std::array<int, 2> across_;
    int axial_;
    std::vector<std::size_t> paths_;  // names of the dead paths
    std::vector<Eigen::Index> path_;
    std::vector<std::size_t> reflector_;
    std::vector<Eigen::Matrix3d> turn_;
    std::vector<Eigen::Vector3d> fixture_;
    std::vector<bool> alternate_;
};

/// What takes part in an undetermined combination, by kind.
struct Involved {
    std::set<std::size_t> stations;
    std::set<std::size_t> dead_paths;
    std::set<std::size_t> scales;        // of stations
    std::set<std::size_t> temperatures;  // of stations
    std::set<std::size_t> angles;        // numbered from 0
    bool fixture = false;
    bool reversal = false;
    bool expansion = false;
    std::string names;
};

std::size_t index_of(const std::vector<std::string>& names, std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Involved involved_in(const RotaryTableMeasurement& measurement, const RankReport& rank) {
    constexpr std::string_view k_station = "station ";
    constexpr std::string_view k_dead_path = "dead path ";
    constexpr std::string_view k_angle = " at angle number ";
    constexpr std::size_t k_most_groups = 8;
    Involved result;
    std::vector<std::string> groups;  // "station P1, x, y", "EXA, EYA at angle number 3"
    std::string last;                 // what the members of the last group share
    // A rank report knows parameters by their names only: what they stand for is read back from these.
    for (const std::string& full : rank.parameters) {
        const std::string_view name = full;
        const auto comma = name.rfind(", ");
        const auto at_angle = name.find(k_angle);
        const std::string shared(at_angle != std::string_view::npos ? name.substr(at_angle) : name.substr(0, comma));
        if (shared == last && at_angle != std::string_view::npos) {
            groups.back().insert(groups.back().size() - shared.size(),
                                 std::string(", ").append(name.substr(0, at_angle)));
        } else if (shared == last && comma != std::string_view::npos) {
            groups.back().append(name.substr(comma));
        } else {
            groups.push_back(full);
            last = shared;
        }
        if (name.starts_with(k_station)) {
            const std::size_t station =
                index_of(measurement.stations, name.substr(k_station.size(), comma - k_station.size()));
            const std::string_view component = name.substr(std::min(comma, name.size() - 2) + 2);
            (component == "scale"                 ? result.scales
             : component == "fixture temperature" ? result.temperatures
                                                  : result.stations)
                .insert(station);
        } else if (name.starts_with(k_dead_path)) {
            result.dead_paths.insert(index_of(measurement.dead_paths, name.substr(k_dead_path.size())));
        } else if (const auto at = name.find(k_angle); at != std::string_view::npos) {
            std::size_t number = 1;
            const std::string_view digits = name.substr(at + k_angle.size());
            std::from_chars(digits.data(), digits.data() + digits.size(), number);
            result.angles.insert(number - 1);
        } else {
            result.fixture = result.fixture || name.starts_with("reflector ");
            result.reversal = result.reversal || name.starts_with("reversal ");
            result.expansion = result.expansion || name.starts_with("expansion ");
        }
    }
    for (std::size_t k = 0; k < std::min(groups.size(), k_most_groups); ++k) {
        result.names += (k == 0 ? "" : "; ") + groups[k];
    }
    if (groups.size() > k_most_groups) {
        result.names += "; and " + std::to_string(groups.size() - k_most_groups) + " more";
    }
    return result;
}

std::string angle_in_words(const RotaryTableMeasurement& measurement, std::size_t angle) {
    return degrees_text(angle < measurement.angles_deg.size() ? measurement.angles_deg[angle]
                                                              : measurement.angles[angle] / gum::k_degree);
}

struct AngleCoverage {
    std::size_t distances = 0;
    std::set<std::size_t> stations;
    std::set<std::size_t> reflectors;
};

AngleCoverage coverage_of(const RotaryTableMeasurement& measurement, std::size_t angle) {
    AngleCoverage coverage;
    for (const LengthObservation& length : measurement.lengths) {
        if (length.angle == angle) {
            ++coverage.distances;
            coverage.stations.insert(length.station);
            coverage.reflectors.insert(length.reflector);
        }
    }
    return coverage;
}

/// Reflectors so close to one line that the fixture does not tell a turn about it.
bool on_one_line(const RotaryTableMeasurement& measurement, const AngleCoverage& coverage) {
    constexpr double k_straight = 1e-3;
    // Two reflectors are on one line wherever they stand, and about a single one the fixture turns freely.
    if (coverage.reflectors.size() < 3) {
        return !coverage.reflectors.empty();
    }
    Eigen::MatrixX3d points(static_cast<Eigen::Index>(coverage.reflectors.size()), 3);
    Eigen::Index row = 0;
    for (const std::size_t reflector : coverage.reflectors) {
        points.row(row++) = measurement.fixture.row(static_cast<Eigen::Index>(reflector));
    }
    const Eigen::RowVector3d mean = points.colwise().mean();
    points.rowwise() -= mean;
    // The second singular value is the width of the points across their longest direction.
    const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(points).singularValues();
    return values[1] < k_straight * values[0];
}

std::string plural(std::size_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string coverage_in_words(const AngleCoverage& coverage) {
    return plural(coverage.distances, "distance") + " from " + plural(coverage.stations.size(), "station") + " to " +
           plural(coverage.reflectors.size(), "reflector");
}

/// Angles that are different modulo a full turn.
std::size_t distinct_angles(const RotaryTableMeasurement& measurement) {
    std::vector<double> kept;
    for (const double angle : measurement.angles) {
        const bool known = std::any_of(kept.begin(), kept.end(), [&](double other) {
            // The nearest multiple of a turn is taken off, so that 359.999° and 0° are neighbours. A remainder of one
            // sign would put a full turn between them.
            return std::abs(std::remainder(angle - other, 2.0 * std::numbers::pi)) < k_same_angle;
        });
        if (!known) {
            kept.push_back(angle);
        }
    }
    return kept.size();
}

gum::Diagnostic refusal(std::string where, std::string what, std::string rule, std::string action) {
    return {"GC-RANK-0001",  std::move(where),  std::move(what),
            std::move(rule), std::move(action), gum::Severity::error};
}

/// Whether three stations or more stand on one line, within a thousandth of its length.
bool stand_on_one_line(const std::vector<Eigen::Vector3d>& stations) {
    constexpr double k_flat = 1e-3;
    if (stations.size() < 3) {
        return false;
    }
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& station : stations) {
        mean += station / static_cast<double>(stations.size());
    }
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& station : stations) {
        scatter += (station - mean) * (station - mean).transpose();
    }
    const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
    // Eigenvalues of the scatter are squares of lengths, in ascending order: the second is the width across the line.
    // The first is zero where all stand in a plane, which does no harm of this kind.
    return spread[1] < k_flat * k_flat * spread[2];
}

gum::Diagnostic undetermined_poses(const RotaryTableMeasurement& measurement, const Involved& involved) {
    const std::size_t angle = *involved.angles.begin();
    const AngleCoverage coverage = coverage_of(measurement, angle);
    std::string rule = "the six error motions of an angle need at least six distances in independent directions";
    std::string action = "measure that angle from more stations or to more reflectors, or leave it out";
    // Below six distances their number alone is the cause. From six on it is their directions: more distances of the
    // same kind would be no cure.
    if (coverage.distances >= 6 && coverage.stations.size() < 3) {
        rule += ": a turn about the line that joins two stations changes no distance";
        action = "measure that angle from at least 3 stations that are not on one line";
    } else if (coverage.distances >= 6 && on_one_line(measurement, coverage)) {
        rule += ": a turn about the line that joins the reflectors changes no distance";
        action = "measure that angle to at least 3 reflectors that are not on one line";
    }
    return refusal("adjustment",
                   "not determined: " + involved.names + " (" + angle_in_words(measurement, angle) + " has " +
                       coverage_in_words(coverage) + ")",
                   rule, action);
}

gum::Diagnostic undetermined_station(const RotaryTableMeasurement& measurement, const Involved& involved,
                                     std::size_t station, const std::vector<Eigen::Vector3d>& positions) {
    const std::string name = "station " + measurement.stations[station];
    std::string what = "not determined: " + involved.names;
    std::string action =
        "move the station off the rotary axis, or place reflectors at different distances from the axis";
    if (station < positions.size()) {
        const StationView view(measurement, station);
        if (!view.empty()) {
            what = view.how_it_stands(positions[station]) + "; " + what;
            action = view.cure(positions[station]);
            if (action.find("off the rotary axis") == std::string::npos) {
                action = "move the station off the rotary axis, or " + action;
            }
        }
    }
    return refusal(
        name, what,
        "a station that sees all reflectors of a dead path on a cone about one line cannot tell a move along "
        "that line from a longer dead path: a ring of reflectors seen from its axis is such a cone",
        action);
}

}  // namespace

std::optional<gum::Diagnostic> stations_on_one_line(const std::vector<Eigen::Vector3d>& stations) {
    if (!stand_on_one_line(stations)) {
        return std::nullopt;
    }
    return refusal("stations", "all " + std::to_string(stations.size()) + " stations stand on one line",
                   "a turn of the table about the line that joins the stations changes no distance",
                   "move one station away from the line, by about the distance of the others from each other");
}

gum::Diagnostic undetermined(const RotaryTableMeasurement& measurement, const RankReport& rank,
                             const std::vector<Eigen::Vector3d>& stations) {
    const Involved involved = involved_in(measurement, rank);
    const std::string what = "not determined: " + involved.names;
    // First the causes of many at once: stations on a line leave poses, stations and dead paths open, and naming all of
    // these would help nobody.
    if (const std::optional<gum::Diagnostic> line = stations_on_one_line(stations)) {
        return *line;
    }
    // Then single angles: a pose that is open makes whatever is seen through it open.
    if (!involved.angles.empty()) {
        return undetermined_poses(measurement, involved);
    }
    if (involved.reversal) {
        return refusal("reversal", what,
                       "the reversal is the difference of the two senses of approach at the same angles",
                       "measure the angles in both senses from the same station, or in one sense only");
    }
    if (involved.scales.size() > 1 || (!involved.scales.empty() && involved.fixture)) {
        return refusal(
            "scale of the stations", what,
            "with a free scale at every station only the coordinates of the fixture give the metre: a larger "
            "table with longer dead paths sees the same lengths",
            "state the scale as fixed or with a prior (0.1 ppm from the wavelength), or smaller standard "
            "uncertainties of the fixture coordinates");
    }
    const AngleCoverage home = coverage_of(measurement, measurement.home);
    // Several stations at once have one cause in common: the home angle, which alone ties all of them to the fixture.
    if (involved.stations.size() > 1) {
        if (home.distances >= 6 && home.reflectors.size() > 2 && on_one_line(measurement, home)) {
            return refusal("fixture", what + " (all reflectors of the home angle lie on one line)",
                           "a turn of the fixture about the line that joins the reflectors changes no distance",
                           "place at least one reflector 50 mm or more off that line");
        }
        return refusal(
            "home angle " + angle_in_words(measurement, measurement.home),
            what + " (the home angle has " + coverage_in_words(home) + ")",
            "the stations stand in the frame of the fixture at the home angle: at least six distances there, "
            "in independent directions, hold the stations and all other angles to it",
            "measure the home angle from all stations to all reflectors, or choose a home angle that is "
            "measured completely");
    }
    if (involved.stations.size() == 1) {
        const std::size_t station = *involved.stations.begin();
        if (involved.dead_paths.empty() && involved.scales.empty()) {
            return refusal("station " + measurement.stations[station], what,
                           "a position needs distances in directions that are not in one plane",
                           "measure more reflectors or angles from this station, or leave it out");
        }
        if (!involved.scales.empty()) {
            return refusal("station " + measurement.stations[station], what,
                           "seen from far away a small fixture does not tell scale, distance and dead path apart",
                           "state the scale as fixed or with a prior (0.1 ppm from the wavelength)");
        }
        return undetermined_station(measurement, involved, station, stations);
    }
    if (!involved.dead_paths.empty()) {
        const std::string& name =
            measurement.dead_paths[std::min(*involved.dead_paths.begin(), measurement.dead_paths.size() - 1)];
        return refusal("dead path " + name, what, "a dead path needs a distance that determines nothing else",
                       "keep one dead path for more distances, or measure more reflectors and angles with it");
    }
    if (!involved.temperatures.empty() || involved.expansion) {
        return refusal("adjustment", what, "temperature and expansion of the fixture act as one factor on its size",
                       "state the standard uncertainty of the temperature or that of the expansion coefficient");
    }
    return refusal("adjustment", what, "a result needs observations that determine every parameter",
                   "add stations, reflectors or angles in other directions");
}

void refuse_undetermined(const RotaryTableMeasurement& measurement, const RankReport& rank,
                         const std::vector<Eigen::Vector3d>& stations) {
    throw gum::NoResultError(undetermined(measurement, rank, stations));
}

void require_enough_angles(const RotaryTableMeasurement& measurement) {
    const std::size_t count = distinct_angles(measurement);
    if (count >= 3) {
        return;
    }
    throw gum::NoResultError(gum::Diagnostic{
        "GC-RANK-0002", "angles", plural(count, "angle") + " (modulo 360°)",
        "an eccentricity and a tilt of the fixture explain any error motions across the axis at two angles: nothing of "
        "these motions themselves would be left, nor of their uncertainty",
        "measure at least 3 different angles, better 12 or more over a full turn", gum::Severity::error});
}

std::vector<gum::Diagnostic> geometry_notes(const RotaryTableMeasurement& measurement,
                                            const std::vector<Eigen::Vector3d>& stations,
                                            const std::function<bool(std::size_t)>& harms) {
    std::vector<gum::Diagnostic> notes;
    const auto warn = [&notes](const char* code, std::string where, std::string what, std::string rule,
                               std::string action) {
        notes.push_back(
            {code, std::move(where), std::move(what), std::move(rule), std::move(action), gum::Severity::warning});
    };
    const auto across = across_axis(measurement.axis);
    const int axial = axial_coordinate(measurement.axis);
    const std::string axis(1, "xyz"[axial]);

    // Fixture at home.
    const Eigen::Vector3d centre = measurement.fixture.colwise().mean();
    const Eigen::MatrixX3d centred = measurement.fixture.rowwise() - centre.transpose();
    const double extent = std::sqrt((centred.col(across[0]).squaredNorm() + centred.col(across[1]).squaredNorm()) /
                                    static_cast<double>(centred.rows()));
    const double thickness = std::sqrt(centred.col(axial).squaredNorm() / static_cast<double>(centred.rows()));

    double spread = 0.0;
    for (std::size_t j = 0; j < stations.size(); ++j) {
        for (std::size_t k = 0; k < j; ++k) {
            const Eigen::Vector3d a = (stations[j] - centre).normalized();
            const Eigen::Vector3d b = (stations[k] - centre).normalized();
            // By sine and cosine together: the arc cosine alone loses its digits at small angles.
            spread = std::max(spread, std::atan2(a.cross(b).norm(), a.dot(b)));
        }
    }
    if (stations.size() > 1 && spread < k_station_spread) {
        warn("GC-GEOMETRY-0001", "stations",
             "all stand within " + in_degrees(spread) + " as seen from the middle of the fixture",
             "below 20° the motions across the lines of sight are lost: the worst error motion has 4.5 times the "
             "standard "
             "uncertainty of widely spread stations at 20°, 11 times at 8°",
             "spread the stations over at least 60°; a wide spread is worth more than further stations");
    }

    for (std::size_t j = 0; j < stations.size(); ++j) {
        const StationView view(measurement, j);
        if (view.empty()) {
            continue;
        }
        const double condition = view.condition(stations[j]);
        // Against the size of what this station saw over all its angles, not of the fixture: a station that saw one
        // side of the fixture only knows its own place less well.
        const auto [middle, size] = view.cloud();
        const double ratio = (stations[j] - middle).norm() / size;
        const std::string where = "station " + measurement.stations[j];
        if (ratio > k_distance_ratio) {
            warn("GC-GEOMETRY-0003", where,
                 "stands " + in_mm((stations[j] - middle).norm()) + " from reflectors that span " + in_mm(size) +
                     " (ratio " + rounded(ratio, 2) + ", condition number of its position and dead path " +
                     rounded(condition, 2) + ")",
                 "the uncertainty of position and dead path grows with the square of the ratio: here " +
                     rounded(std::pow(ratio / k_usual_ratio, 2), 2) + " times that at a ratio of 3",
                 "bring the station nearer, or use a larger fixture");
        }
        // Of a distant station a large condition is no sign of a cone, unless it is far larger than the distance makes.
        if (condition > k_condition_limit && (ratio <= k_distance_ratio || condition > 150.0 * ratio * ratio) &&
            (!harms || harms(j))) {
            warn("GC-GEOMETRY-0002", where,
                 view.how_it_stands(stations[j]) + "; condition number of its position and dead path " +
                     rounded(condition, 2),
                 "a station that sees all reflectors near a cone about one line hardly tells a move along that line "
                 "from a "
                 "longer dead path (a ring of reflectors seen from its axis); the limit is 3000",
                 view.cure(stations[j]));
        }
    }

    if (thickness < k_flatness * extent) {
        warn("GC-GEOMETRY-0004", "fixture",
             "the reflectors lie within " + in_mm(thickness) + " (standard deviation) of a plane across the axis and " +
                 in_mm(extent) + " across it",
             "from a plane that turns in itself the mirror image of a station fits almost as well; stations near the "
             "axis "
             "are close to a cone",
             "raise alternate holders by 50 mm along " + axis);
    }

    if (distinct_angles(measurement) == 3) {
        warn("GC-GEOMETRY-0005", "angles", "3 angles (modulo 360°)",
             "of the error motions across the axis three angles leave one combination of each pair: the rest is "
             "eccentricity and tilt of the fixture by the convention of the datum, and the values of the angles are "
             "fully "
             "correlated",
             "measure more angles, 12 or more over a full turn");
    }
    return notes;
}

}  // namespace gumcert::engine
