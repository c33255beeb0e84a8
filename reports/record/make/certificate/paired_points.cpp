#include "reports/record/make/certificate/paired_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iterator>
#include <string_view>

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertifiedTable;
using certificate::PointColumn;

/// What a point is, beside what was found at it.
struct PointIdentity {
    std::vector<std::string> parts;  ///< as they are printed: group, then cells
    std::string results;             ///< which the tables have at it
    std::string name;
};
using PointIdentities = std::map<std::string, PointIdentity>;  // by number

/// The first parts of a point, as many as there are up to this. Brackets are round: those of the place stand around all of it.
std::string first_parts(const PointIdentity& point, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < std::min(count, point.parts.size()); ++i) {
        text += (i == 0 ? "" : ", ") + point.parts[i];
    }
    std::replace(text.begin(), text.end(), '[', '(');
    std::replace(text.begin(), text.end(), ']', ')');
    return text;
}

bool is_running_number(const std::string& text) {
    constexpr std::size_t k_most_digits = 9;
    return !text.empty() && text.size() <= k_most_digits && text.find_first_not_of("0123456789") == std::string::npos;
}

bool has_points(const CertifiedTable& table) {
    return table.argument && table.argument->name == "point";
}

/// Whether nothing that is printed says which number a point has.
bool has_unnamed_points(const CertifiedTable& table) {
    return table.layout &&
           std::none_of(table.layout->shown.begin(), table.layout->shown.end(),
                        [](const certificate::ShownColumn& c) { return c.show == "point"; }) &&
           std::all_of(table.argument->printed.begin(), table.argument->printed.end(), is_running_number);
}

bool has_only_unnamed_points(const Certificate& certificate) {
    return std::all_of(certificate.tables.begin(), certificate.tables.end(),
                       [](const CertifiedTable& table) { return !has_points(table) || has_unnamed_points(table); });
}

/// Whether what a column has is found at a point, and does not say which point it is.
bool is_found(const PointColumn& column) {
    static constexpr std::array<std::string_view, 5> k_found = {"indication", "measured_value", "error", "deviation",
                                                                "correction"};
    return std::find(k_found.begin(), k_found.end(), column.role) != k_found.end();
}

/// Columns that say what a point is, those first that nobody measures.
std::vector<const PointColumn*> identifying_columns(const certificate::TableLayout& layout) {
    std::vector<const PointColumn*> columns;
    for (const PointColumn& column : layout.columns) {
        if (!is_found(column)) {
            columns.push_back(&column);
        }
    }
    std::stable_partition(columns.begin(), columns.end(), [](const PointColumn* column) {
        return !column->role.empty() && column->role != "reference";
    });
    return columns;
}

PointIdentities identities_of(const Certificate& certificate) {
    PointIdentities points;
    for (const CertifiedTable& table : certificate.tables) {
        if (!has_points(table) || !has_unnamed_points(table)) {
            continue;
        }
        const certificate::TableLayout& layout = *table.layout;
        const std::vector<const PointColumn*> columns = identifying_columns(layout);
        for (std::size_t row = 0; row < table.argument->printed.size(); ++row) {
            PointIdentity& point = points[table.argument->printed[row]];
            const auto add = [&](const std::string& part) {
                if (!part.empty() && std::find(point.parts.begin(), point.parts.end(), part) == point.parts.end()) {
                    point.parts.push_back(part);
                }
            };
            add(layout.group);
            for (const PointColumn* column : columns) {
                if (row < column->printed.size()) {
                    const bool is_number = row < column->values.size() && column->values[row];
                    add(column->printed[row] +
                        (is_number && !column->printed_unit.empty() ? "\u00A0" + column->printed_unit : ""));
                }
            }
            for (const certificate::CertifiedColumn& column : table.columns) {
                point.results += column.result + '\n';
            }
            // The group and what follows it: a group of one point is a range, and no point.
            point.name = first_parts(point, layout.group.empty() ? 1 : 2);
        }
    }
    return points;
}

/// Names as short as they can be while no two points of the same results have one; with the number where they have.
void tell_apart(PointIdentities& points) {
    const auto count_names = [&] {
        std::map<std::pair<std::string, std::string>, std::size_t> counts;
        for (const auto& [number, point] : points) {
            ++counts[{point.results, point.name}];
        }
        return counts;
    };
    std::size_t most = 0;
    for (const auto& [number, point] : points) {
        most = std::max(most, point.parts.size());
    }
    for (std::size_t length = 1; length <= most + 1; ++length) {
        const auto counts = count_names();
        for (auto& [number, point] : points) {
            if (counts.at({point.results, point.name}) == 1 && !point.name.empty()) {
                continue;
            }
            std::string longer = first_parts(point, length);
            if (length > most) {
                longer += (longer.empty() ? "" : ", ") + number;
            }
            point.name = longer.size() > point.name.size() ? longer : point.name;
        }
    }
}

/// The pairs of an earlier and a later point, as far as they are found.
class PairedPoints {
public:
    PairedPoints(const std::vector<ShownPoint>& before, const std::vector<ShownPoint>& later) {
        for (const ShownPoint& point : before) {
            before_.push_back(&point);
        }
        for (const ShownPoint& point : later) {
            later_.push_back(&point);
        }
    }

    /// Pairs up those for which this is the same, in their order.
    template <class Key>
    void pair_same(const Key& key_of_before, const Key& key_of_later) {
        using Value = decltype(key_of_before(*before_.front()));
        std::multimap<Value, const ShownPoint*> left;
        for (const ShownPoint* point : later_) {
            left.emplace(key_of_later(*point), point);
        }
        std::set<const ShownPoint*> paired;
        for (const ShownPoint* point : before_) {
            const Value key = key_of_before(*point);
            if (const auto same = left.find(key); same != left.end() && !key.empty()) {
                pairs_[point->number] = same->second->number;
                paired.insert({point, same->second});
                left.erase(same);
            }
        }
        const auto is_paired = [&](const ShownPoint* point) { return paired.contains(point); };
        std::erase_if(before_, is_paired);
        std::erase_if(later_, is_paired);
    }

    /// Pairs up those that have half of their texts in common, the most alike first.
    void pair_alike() {
        constexpr std::size_t k_most_compared = 64;  // each with each
        while (!before_.empty() && !later_.empty() && before_.size() <= k_most_compared &&
               later_.size() <= k_most_compared) {
            std::size_t most = 0;
            std::pair<const ShownPoint*, const ShownPoint*> best;
            for (const ShownPoint* from : before_) {
                for (const ShownPoint* to : later_) {
                    const auto common = static_cast<std::size_t>(
                        std::count_if(from->texts.begin(), from->texts.end(),
                                      [&](const auto& text) { return to->texts.contains(text); }));
                    if (common > most && 2 * common >= std::max(from->texts.size(), to->texts.size())) {
                        most = common;
                        best = {from, to};
                    }
                }
            }
            if (most == 0) {
                return;
            }
            pair_up(best.first, best.second);
        }
    }

    [[nodiscard]] const std::map<std::string, std::string>& pairs() const { return pairs_; }
    /// Earlier ones that have no counterpart.
    [[nodiscard]] const std::vector<const ShownPoint*>& gone() const { return before_; }

private:
    std::vector<const ShownPoint*> before_, later_;  // without a counterpart yet
    std::map<std::string, std::string> pairs_;

    void pair_up(const ShownPoint* from, const ShownPoint* to) {
        pairs_[from->number] = to->number;
        std::erase(before_, from);
        std::erase(later_, to);
    }
};

}  // namespace

PointsOfBoth::PointsOfBoth(const Certificate& earlier, const std::vector<ShownPoint>& shown_before,
                           const Certificate& later, const std::vector<ShownPoint>& shown_later) {
    if (!has_only_unnamed_points(earlier) || !has_only_unnamed_points(later)) {
        return;
    }
    PointIdentities before = identities_of(earlier);
    PointIdentities now = identities_of(later);
    tell_apart(before);
    tell_apart(now);
    const auto of_points = [](const std::vector<ShownPoint>& shown, const PointIdentities& points) {
        std::vector<ShownPoint> own;
        std::copy_if(shown.begin(), shown.end(), std::back_inserter(own),
                     [&](const ShownPoint& one) { return points.contains(one.number); });
        return own;
    };
    const std::vector<ShownPoint> old_points = of_points(shown_before, before);
    const std::vector<ShownPoint> new_points = of_points(shown_later, now);
    PairedPoints paired(old_points, new_points);
    using Key = std::function<std::vector<std::string>(const ShownPoint&)>;
    const auto all_texts = [](const ShownPoint& point) {
        std::vector<std::string> texts;
        for (const auto& [what, text] : point.texts) {
            texts.push_back(what + '\n' + text);
        }
        return texts;
    };
    paired.pair_same<Key>(all_texts, all_texts);
    const auto identity_in = [](const PointIdentities& points) -> Key {
        return [&points](const ShownPoint& point) {
            const PointIdentity& one = points.at(point.number);
            std::vector<std::string> key = one.parts;
            if (!key.empty()) {
                key.push_back(one.results);
            }
            return key;
        };
    };
    paired.pair_same<Key>(identity_in(before), identity_in(now));
    const auto name_in = [](const PointIdentities& points) -> Key {
        return [&points](const ShownPoint& point) {
            const PointIdentity& one = points.at(point.number);
            return one.parts.empty() ? std::vector<std::string>() : std::vector<std::string>{one.results, one.name};
        };
    };
    paired.pair_same<Key>(name_in(before), name_in(now));
    paired.pair_alike();
    later_of_ = paired.pairs();
    for (const auto& [number, point] : now) {
        names_[number] = point.name;
    }
    for (const ShownPoint* point : paired.gone()) {
        const std::string gone = "gone " + point->number;
        later_of_[point->number] = gone;
        names_[gone] = before.at(point->number).name;
    }
}

std::string PointsOfBoth::earlier_as_later(const std::string& number) const {
    const auto found = later_of_.find(number);
    return found == later_of_.end() ? number : found->second;
}

std::string PointsOfBoth::name(const std::string& number) const {
    const auto found = names_.find(number);
    return found == names_.end() || found->second.empty() ? number : found->second;
}

}  // namespace gumcert::reports
