#include "reports/record/make/certificate/paired_points.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>

#include "certificate/point_names.h"

namespace gumcert::reports {

namespace {

using certificate::Certificate;
using certificate::CertifiedTable;
using certificate::PointIdentity;
using PointIdentities = std::map<std::string, PointIdentity>;  // by number

bool has_only_unnamed_points(const Certificate& certificate) {
    return std::all_of(certificate.tables.begin(), certificate.tables.end(), [](const CertifiedTable& table) {
        return !table.argument || table.argument->name != "point" || certificate::has_unnamed_points(table);
    });
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
        using Value = std::decay_t<decltype(key_of_before(std::declval<const ShownPoint&>()))>;
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

    /// Pairs up those that have half of their texts in common, the most alike first; of too many those of equal number.
    void pair_alike() {
        constexpr std::size_t k_most_compared = 64;  // each with each
        if (before_.size() > k_most_compared || later_.size() > k_most_compared) {
            const auto number = [](const ShownPoint& point) { return point.number; };
            pair_same(number, number);
        }
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
    const PointIdentities before = certificate::identities_of_points(earlier.tables);
    const PointIdentities now = certificate::identities_of_points(later.tables);
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
                key.insert(key.end(), one.results.begin(), one.results.end());
            }
            return key;
        };
    };
    paired.pair_same<Key>(identity_in(before), identity_in(now));
    const auto name_in = [](const PointIdentities& points) -> Key {
        return [&points](const ShownPoint& point) {
            const PointIdentity& one = points.at(point.number);
            std::vector<std::string> key;
            if (!one.parts.empty()) {
                key.assign(one.results.begin(), one.results.end());
                key.push_back(one.name);
            }
            return key;
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
