#include "gum/rotary_table/studies/stated_sight.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "engine/rotary_table/studies/measurement_plan.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rotary_table/studies/plan_texts.h"
#include "text/counts.h"

namespace gumcert::gum::plan {

using engine::RotaryTableMeasurement;

std::optional<engine::LineOfSight> sight_of(const SightStatement& stated, const RotaryTableMeasurement& layout) {
    engine::SightRules rules;
    rules.obstacles = stated.obstacles;
    rules.reflector_diameter = stated.reflector_diameter;
    if (!stated.facing.empty()) {
        rules.acceptance_angle = stated.acceptance_angle;
    }
    if (!rules.any()) {
        return std::nullopt;
    }
    const std::vector<std::string>& reflectors = layout.reflectors;
    rules.facing.resize(reflectors.size());
    for (const SightStatement::Facing& facing : stated.facing) {
        const auto found = std::find(reflectors.begin(), reflectors.end(), facing.reflector);
        if (found != reflectors.end()) {
            rules.facing[static_cast<std::size_t>(found - reflectors.begin())] = facing.direction;
        }
    }
    engine::LineOfSight sight(layout, std::move(rules));
    if (const auto inside = sight.inside()) {
        throw InputError(Diagnostic{"GC-PLAN-0003", stated.obstacles_where[inside->obstacle],
                                    "reflector " + reflectors[inside->reflector] + " lies inside " +
                                        stated.obstacles[inside->obstacle].name + " at " +
                                        plain(layout.angles_deg[inside->angle]) + "°",
                                    "what lies inside an obstacle is seen from nowhere",
                                    "correct the obstacle, or the coordinates", Severity::error});
    }
    return sight;
}

RotaryTableMeasurement seen_layout(const RotaryTableMeasurement& whole, const engine::LineOfSight& sight) {
    const std::vector<bool> seen = engine::seen_distances(whole, sight);
    std::vector<std::size_t> distances(whole.stations.size(), 0);
    std::vector<bool> blind(whole.stations.size(), true);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::size_t station = whole.lengths[i].station;
        ++distances[station];
        blind[station] = blind[station] && !seen[i];
    }
    std::vector<Diagnostic> problems;
    for (std::size_t j = 0; j < blind.size(); ++j) {
        if (blind[j]) {
            problems.push_back({"GC-PLAN-0004", "station " + whole.stations[j],
                                "sees none of its " + text::count_of(distances[j], "distance"),
                                "a station measures what it sees past the obstacles of plan.sight",
                                "move the station, or correct plan.sight", Severity::error});
        }
    }
    if (!problems.empty()) {
        throw InputError(std::move(problems));
    }
    return engine::with_distances(whole, seen);
}

}  // namespace gumcert::gum::plan
