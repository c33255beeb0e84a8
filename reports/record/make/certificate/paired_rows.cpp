#include "reports/record/make/certificate/paired_rows.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace gumcert::reports {

namespace {

/// What one row states: places within it, and texts.
using StatedRow = std::set<std::pair<std::string, std::string>>;
using StatedRows = std::map<std::size_t, StatedRow>;  // by position
/// Rows by the list that they stand in, "/standards".
using StatedLists = std::map<std::string, StatedRows>;
/// Position of a row → that of its counterpart.
using PairedPositions = std::map<std::size_t, std::size_t>;

bool is_position_of_row(std::string_view token) {
    constexpr std::size_t k_most_digits = 9;
    return !token.empty() && token.size() <= k_most_digits &&
           token.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The rows of the lists that stand this deep: those whose position is the token of this number.
StatedLists lists_at(const std::vector<std::string>& places, const std::vector<StatedLeaf>& leaves, std::size_t depth,
                     bool& goes_on) {
    StatedLists lists;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const std::string& at = places[i];
        std::size_t begin = 0;
        for (std::size_t k = 0; k < depth && begin != std::string::npos; ++k) {
            begin = at.find('/', begin + 1);
        }
        if (begin == std::string::npos) {
            continue;
        }
        goes_on = true;
        const std::size_t end = std::min(at.find('/', begin + 1), at.size());
        const std::string token = at.substr(begin + 1, end - begin - 1);
        if (is_position_of_row(token)) {
            std::size_t position = 0;
            std::from_chars(token.data(), token.data() + token.size(), position);
            lists[at.substr(0, begin)][position].emplace(at.substr(end), leaves[i].text);
        }
    }
    return lists;
}

/// Whether each row is one number, code or text.
bool is_of_single_values(const StatedRows& rows) {
    return std::all_of(rows.begin(), rows.end(),
                       [](const auto& row) { return row.second.size() == 1 && row.second.begin()->first.empty(); });
}

std::vector<std::size_t> positions_of(const StatedRows& rows) {
    std::vector<std::size_t> positions;
    for (const auto& [position, row] : rows) {
        positions.push_back(position);
    }
    return positions;
}

/// Of rows whose order says something: what is the same at both ends, and between them by their order.
PairedPositions paired_in_order(const StatedRows& before, const StatedRows& now) {
    std::vector<std::size_t> old = positions_of(before);
    std::vector<std::size_t> own = positions_of(now);
    PairedPositions pairs;
    while (!old.empty() && !own.empty() && before.at(old.back()) == now.at(own.back())) {
        pairs[old.back()] = own.back();
        old.pop_back();
        own.pop_back();
    }
    for (std::size_t i = 0; i < std::min(old.size(), own.size()); ++i) {
        pairs[old[i]] = own[i];
    }
    return pairs;
}

std::size_t common_statements(const StatedRow& one, const StatedRow& other) {
    return static_cast<std::size_t>(
        std::count_if(one.begin(), one.end(), [&](const auto& stated) { return other.contains(stated); }));
}

PairedPositions paired_by_content(const StatedRows& before, const StatedRows& now) {
    constexpr std::size_t k_most_compared = 64;  // each with each
    std::vector<std::size_t> old = positions_of(before);
    std::vector<std::size_t> own = positions_of(now);
    PairedPositions pairs;
    const auto pair_up = [&](std::size_t from, std::size_t to) {
        pairs[from] = to;
        std::erase(old, from);
        std::erase(own, to);
    };
    // Equal ones, the one at the same place first.
    for (const std::size_t from : positions_of(before)) {
        if (const auto here = now.find(from); here != now.end() && here->second == before.at(from)) {
            pair_up(from, from);
        }
    }
    std::multimap<StatedRow, std::size_t> left;
    for (const std::size_t to : own) {
        left.emplace(now.at(to), to);
    }
    for (const std::size_t from : std::vector<std::size_t>(old)) {
        if (const auto same = left.find(before.at(from)); same != left.end()) {
            pair_up(from, same->second);
            left.erase(same);
        }
    }
    while (!old.empty() && !own.empty() && old.size() <= k_most_compared && own.size() <= k_most_compared) {
        std::size_t most = 0;
        std::pair<std::size_t, std::size_t> best;
        for (const std::size_t from : old) {
            for (const std::size_t to : own) {
                const std::size_t common = common_statements(before.at(from), now.at(to));
                // Of equally alike ones those at one place.
                if (common > most || (common == most && common > 0 && from == to && best.first != best.second)) {
                    most = common;
                    best = {from, to};
                }
            }
        }
        if (most == 0) {
            break;
        }
        pair_up(best.first, best.second);
    }
    const std::vector<std::size_t> rest = old;
    for (std::size_t i = 0; i < rest.size() && !own.empty(); ++i) {
        pair_up(rest[i], own.front());
    }
    return pairs;
}

}  // namespace

std::vector<std::string> places_of_counterparts(const std::vector<StatedLeaf>& before,
                                                const std::vector<StatedLeaf>& now) {
    std::vector<std::string> places;
    std::vector<std::string> places_now;
    std::transform(before.begin(), before.end(), std::back_inserter(places),
                   [](const StatedLeaf& one) { return one.at; });
    std::transform(now.begin(), now.end(), std::back_inserter(places_now),
                   [](const StatedLeaf& one) { return one.at; });
    bool goes_on = true;
    for (std::size_t depth = 0; goes_on; ++depth) {
        goes_on = false;
        const StatedLists old = lists_at(places, before, depth, goes_on);
        const StatedLists own = lists_at(places_now, now, depth, goes_on);
        std::map<std::string, std::string> moved;  // "/standards/0" → "/standards/1"
        for (const auto& [list, rows] : old) {
            const auto found = own.find(list);
            const StatedRows& rows_now = found == own.end() ? StatedRows() : found->second;
            const bool is_ordered = is_of_single_values(rows) && is_of_single_values(rows_now);
            const PairedPositions pairs =
                is_ordered ? paired_in_order(rows, rows_now) : paired_by_content(rows, rows_now);
            for (const auto& [position, row] : rows) {
                const auto pair = pairs.find(position);
                const std::string from = list + '/' + std::to_string(position);
                moved[from] = pair == pairs.end() ? from + " has gone" : list + '/' + std::to_string(pair->second);
            }
        }
        for (std::string& place : places) {
            std::size_t end = 0;
            for (std::size_t k = 0; k <= depth && end != std::string::npos; ++k) {
                end = place.find('/', end + 1);
            }
            end = std::min(end, place.size());
            if (const auto to = moved.find(place.substr(0, end)); to != moved.end()) {
                place.replace(0, end, to->second);
            }
        }
    }
    return places;
}

}  // namespace gumcert::reports
