#include "engine/rotary_table/studies/line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

namespace {

// Part of a beam that may lie in a solid: a beam that touches a face passes.
constexpr double k_touching = 1e-9;  // [1]

/// Part of a line, from 0 at its beginning to 1 at its end.
struct Part {
    double from = 0.0, to = 1.0;

    void limit(double low, double high) {
        from = std::max(from, low);
        to = std::min(to, high);
    }
    [[nodiscard]] bool is_long() const { return to - from > k_touching; }
};

/// Where a coordinate that goes from `begin` to `end` lies between two limits.
void limit_between(Part& part, double begin, double end, double low, double high) {
    const double step = end - begin;
    // Parallel to the faces: all of the line is between them, or none of it.
    if (step == 0.0) {
        if (begin <= low || begin >= high) {
            part.to = part.from;
        }
        return;
    }
    const double first = (low - begin) / step;
    const double second = (high - begin) / step;
    part.limit(std::min(first, second), std::max(first, second));
}

/// Where the distance from the axis is below a radius.
void limit_to_cylinder(Part& part, const Eigen::Vector2d& begin, const Eigen::Vector2d& end, double radius) {
    const Eigen::Vector2d step = end - begin;
    const double a = step.squaredNorm();
    const double b = begin.dot(step);
    const double c = begin.squaredNorm() - radius * radius;
    // |begin + t step|² = r² is a t² + 2 b t + c = 0.
    const double root = b * b - a * c;
    // Along the axis (a = 0) the distance from it does not change.
    if (a == 0.0 ? c >= 0.0 : root <= 0.0) {
        part.to = part.from;
    } else if (a > 0.0) {
        part.limit((-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a);
    }
}

bool passes_through(const Obstacle& obstacle, int axial, const Eigen::Vector3d& begin, const Eigen::Vector3d& end) {
    Part part;
    limit_between(part, begin[axial], end[axial], obstacle.low[axial], obstacle.high[axial]);
    const int first = (axial + 1) % 3;
    const int second = (axial + 2) % 3;
    if (obstacle.radius > 0.0) {
        limit_to_cylinder(part, {begin[first], begin[second]}, {end[first], end[second]}, obstacle.radius);
    } else {
        limit_between(part, begin[first], end[first], obstacle.low[first], obstacle.high[first]);
        limit_between(part, begin[second], end[second], obstacle.low[second], obstacle.high[second]);
    }
    return part.is_long();
}

bool passes_sphere(const Eigen::Vector3d& centre, double radius, const Eigen::Vector3d& begin,
                   const Eigen::Vector3d& end) {
    const Eigen::Vector3d step = end - begin;
    // Of the beam and not of the whole line: a reflector behind the station or the target hides nothing.
    const double at = std::clamp((centre - begin).dot(step) / step.squaredNorm(), 0.0, 1.0);
    return (begin + at * step - centre).norm() < radius;
}

bool contains(const Obstacle& obstacle, int axial, const Eigen::Vector3d& point) {
    const Eigen::Vector3d above = point - obstacle.low;
    const Eigen::Vector3d below = obstacle.high - point;
    if (obstacle.radius > 0.0) {
        return above[axial] > 0.0 && below[axial] > 0.0 &&
               std::hypot(point[(axial + 1) % 3], point[(axial + 2) % 3]) < obstacle.radius;
    }
    return above.minCoeff() > 0.0 && below.minCoeff() > 0.0;
}

}  // namespace

LineOfSight::LineOfSight(const RotaryTableMeasurement& measurement, SightRules rules)
    : rules_(std::move(rules)), axial_(axial_coordinate(measurement.axis)) {
    for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
        reflectors_.emplace_back(measurement.fixture.row(m).transpose());
    }
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        rotations_.push_back(nominal_rotation(measurement, i));
    }
}

std::optional<Hindrance> LineOfSight::hindrance(const Eigen::Vector3d& station, std::size_t angle,
                                                std::size_t reflector) const {
    const Eigen::Vector3d& target = reflectors_[reflector];
    // Seen from the fixture the reflectors stand still and the station turns: one test serves for all that turn with
    // the table.
    const Eigen::Vector3d from = rotations_[angle].transpose() * station;  // in the turning fixture
    if (rules_.acceptance_angle && reflector < rules_.facing.size() && rules_.facing[reflector]) {
        const double cosine = rules_.facing[reflector]->dot((from - target).normalized());
        if (cosine < std::cos(*rules_.acceptance_angle) - k_touching) {
            return Hindrance{Hindrance::Kind::acceptance, reflector};
        }
    }
    for (std::size_t k = 0; k < rules_.obstacles.size(); ++k) {
        const Obstacle& obstacle = rules_.obstacles[k];
        const bool hidden = obstacle.turns ? passes_through(obstacle, axial_, from, target)
                                           : passes_through(obstacle, axial_, station, rotations_[angle] * target);
        if (hidden) {
            return Hindrance{Hindrance::Kind::obstacle, k};
        }
    }
    for (std::size_t m = 0; rules_.reflector_diameter > 0.0 && m < reflectors_.size(); ++m) {
        if (m != reflector && passes_sphere(reflectors_[m], 0.5 * rules_.reflector_diameter, from, target)) {
            return Hindrance{Hindrance::Kind::reflector, m};
        }
    }
    return std::nullopt;
}

std::optional<LineOfSight::Inside> LineOfSight::inside() const {
    for (std::size_t k = 0; k < rules_.obstacles.size(); ++k) {
        const Obstacle& obstacle = rules_.obstacles[k];
        // A solid that turns with the table has the same reflectors inside at every angle.
        for (std::size_t i = 0; i < (obstacle.turns ? std::size_t{1} : rotations_.size()); ++i) {
            for (std::size_t m = 0; m < reflectors_.size(); ++m) {
                if (contains(obstacle, axial_, obstacle.turns ? reflectors_[m] : rotations_[i] * reflectors_[m])) {
                    return Inside{m, k, i};
                }
            }
        }
    }
    return std::nullopt;
}

std::vector<bool> seen_distances(const RotaryTableMeasurement& measurement, const LineOfSight& sight) {
    std::vector<bool> seen;
    seen.reserve(measurement.lengths.size());
    for (const LengthObservation& length : measurement.lengths) {
        seen.push_back(!sight.hindrance(*measurement.station_start[length.station], length.angle, length.reflector));
    }
    return seen;
}

}  // namespace gumcert::engine
