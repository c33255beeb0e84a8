#include "reports/record/stated_values.h"

#include <algorithm>
#include <array>

namespace gumcert::reports {

namespace {

struct GroupNames {
    const char* name;
    const char* pointer;  // of the list in the rotary table
    const char* prefix;   // of the names of results
};
constexpr std::array<GroupNames, 6> k_groups = {{{"error_motions", "/errors/", ""},
                                                 {"reversal", "/reversal/", "reversal_"},
                                                 {"ranges", "/ranges/", "range_"},
                                                 {"axis_line", "/axis_line/", ""},
                                                 {"location_errors", "/location_errors/", ""},
                                                 {"positioning", "/iso230_2/parameters/", ""}}};

const GroupNames& names_of(StatedGroup group) {
    return k_groups.at(static_cast<std::size_t>(group));
}

const std::string& unit_of_motion(const RotaryTable& table, const std::string& name) {
    static const std::string one = "1";
    const auto found = std::find(table.error_names.begin(), table.error_names.end(), name);
    return found == table.error_names.end()
               ? one
               : table.error_units[static_cast<std::size_t>(found - table.error_names.begin())];
}

template <class Value, class Table>
std::vector<StatedPlace<Value>> places_of(Table& table, ErrorOrder order) {
    std::vector<StatedPlace<Value>> all;
    const std::size_t motions = table.error_names.size();
    const std::size_t angles = table.errors.size();
    for (std::size_t i = 0; i < motions * angles; ++i) {
        const std::size_t angle = order == ErrorOrder::by_angle ? i / motions : i % angles;
        const std::size_t motion = order == ErrorOrder::by_angle ? i % motions : i / angles;
        const std::string& name = table.error_names[motion];
        all.push_back({.group = StatedGroup::error_motions,
                       .index = angle,
                       .name = name,
                       .meaning = name,
                       .unit = table.error_units[motion],
                       .stated = table.errors[angle].errors[motion]});
    }
    const auto add_motions = [&](StatedGroup group, auto& list) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::string& name = list[i].name;
            all.push_back({.group = group,
                           .index = i,
                           .name = name,
                           .meaning = name,
                           .unit = unit_of_motion(table, name),
                           .stated = list[i].stated});
        }
    };
    const auto add_parameters = [&](StatedGroup group, auto& list) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            all.push_back({.group = group,
                           .index = i,
                           .name = list[i].name,
                           .meaning = list[i].description.empty() ? list[i].name : list[i].description,
                           .unit = list[i].unit,
                           .stated = list[i].stated});
        }
    };
    add_motions(StatedGroup::reversal, table.reversal);
    add_motions(StatedGroup::ranges, table.ranges);
    add_parameters(StatedGroup::axis_line, table.axis_line);
    add_parameters(StatedGroup::location_errors, table.location_errors);
    if (table.iso230_2) {
        add_parameters(StatedGroup::positioning, table.iso230_2->parameters);
    }
    return all;
}

}  // namespace

const char* group_name(StatedGroup group) {
    return names_of(group).name;
}

StatedPlaces stated_values(RotaryTable& table, ErrorOrder order) {
    return places_of<StatedValue>(table, order);
}

ConstStatedPlaces stated_values(const RotaryTable& table, ErrorOrder order) {
    return places_of<const StatedValue>(table, order);
}

std::string result_name(StatedGroup group, const std::string& name) {
    return names_of(group).prefix + name;
}

std::string pointer_of(const StatedPlace<const StatedValue>& place) {
    const std::string at = names_of(place.group).pointer + std::to_string(place.index);
    return place.group == StatedGroup::error_motions ? at + "/" + place.name : at;
}

}  // namespace gumcert::reports
