#include "jobs/rotary_table/rotary_table_exclusion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "certificate/stated_text.h"
#include "jobs/job_reader.h"
#include "jobs/rotary_table/rotary_table_fields.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

namespace {

std::optional<std::pair<std::size_t, std::size_t>> lines_of(const JsonObject& object,
                                                            const std::array<double, 2>& lines) {
    const bool whole = std::ranges::all_of(lines, [](double line) { return line == std::floor(line); });
    if (!whole || lines.front() > lines.back()) {
        object.refuse(k_bad_exclusion, "lines",
                      "lines " + text::shortest_plain(lines.front()) + " to " + text::shortest_plain(lines.back()),
                      "lines are two whole numbers, the first and the last line", "correct the numbers");
        return std::nullopt;
    }
    return std::pair{static_cast<std::size_t>(lines.front()), static_cast<std::size_t>(lines.back())};
}

std::optional<Exclusion> read_exclusion(const JsonObject& object) {
    ExclusionStatement stated;
    Exclusion& exclusion = stated.exclusion;
    exclusion.where = object.where();
    JobReader reader(object);
    reader.read(stated, {"station", "reflector", "pass", "direction", "angle_deg", "lines"});
    if (reader.accepted("lines")) {
        exclusion.lines = lines_of(object, stated.lines);
    }
    // What could not be read would select more than was meant.
    const bool is_whole = exclusion.station.has_value() == object.has("station") &&
                          exclusion.reflector.has_value() == object.has("reflector") &&
                          exclusion.pass.has_value() == object.has("pass") &&
                          exclusion.direction.has_value() == object.has("direction") &&
                          exclusion.angle_deg.has_value() == object.has("angle_deg") &&
                          exclusion.lines.has_value() == object.has("lines");
    reader.read(stated, {"reason"});
    if (!reader.accepted("reason") || !is_whole) {
        return std::nullopt;
    }
    if (!certificate::states_a_reason(exclusion.reason)) {
        object.refuse(k_bad_exclusion, "reason", "the reason " + text::in_quotes(exclusion.reason) + " says nothing",
                      "what is left out is left out for a reason, which the documents print", "state the reason");
    }
    const bool selects_something = std::ranges::any_of(
        keys_of<ExclusionStatement>(), [&](std::string_view key) { return key != "reason" && object.has(key); });
    if (!selects_something) {
        object.refuse(k_bad_exclusion, "", "no distance is named",
                      "an entry of \"exclude\" has a station, reflector, pass, direction, angle_deg or lines",
                      "name the distances, or remove the entry");
        return std::nullopt;
    }
    return exclusion;
}

}  // namespace

bool selects(const Exclusion& exclusion, const ExclusionKeys& distance) {
    const auto agrees = [](const std::optional<std::string>& wanted, std::string_view is) {
        return !wanted || *wanted == is;
    };
    return agrees(exclusion.station, distance.station) && agrees(exclusion.reflector, distance.reflector) &&
           agrees(exclusion.pass, distance.pass) && agrees(exclusion.direction, distance.direction) &&
           (!exclusion.angle_deg || std::abs(*exclusion.angle_deg - distance.angle_deg) <= k_same_angle_deg) &&
           (!exclusion.lines || (exclusion.lines->first <= distance.line && distance.line <= exclusion.lines->second));
}

std::vector<Exclusion> read_exclusions(const JsonDocument& document, const JsonObject& root, ProblemList& problems) {
    std::vector<Exclusion> exclusions;
    const nlohmann::json* entries = root.optional_array("exclude");
    for (std::size_t i = 0; entries != nullptr && i < entries->size(); ++i) {
        const std::string pointer = child_pointer(root.pointer("exclude"), i);
        if (!(*entries)[i].is_object()) {
            problems.refuse(k_wrong_type, document.where(pointer), described((*entries)[i]),
                            "an entry of \"exclude\" is an object", "write { … } with the distances and the reason");
            continue;
        }
        if (std::optional<Exclusion> exclusion =
                read_exclusion(JsonObject(document, pointer, keys_of<ExclusionStatement>(), problems))) {
            exclusions.push_back(std::move(*exclusion));
        }
    }
    return exclusions;
}

}  // namespace gumcert::jobs
