// Plants every blunder of the catalogue on campaigns with consecutive seeds and prints, as Markdown, how many were
// told; and what is silent although it is larger than what the best test of its level finds nearly always.
//
//   blunder_study [campaigns] [angles] [kind]      kind: one of the table
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/planted_blunders.h"

namespace {

using namespace gumcert::engine;
using synthetic::Blunder;

double upper_tail(double value, double degrees_of_freedom) {
    return boost::math::cdf(boost::math::complement(boost::math::chi_squared_distribution<double>(degrees_of_freedom),
                                                    std::max(value, 0.0)));
}

EvaluationOptions options() {
    EvaluationOptions result;
    result.chi_square_upper_tail = upper_tail;
    result.student_critical_value = [critical = result.critical_value](double degrees_of_freedom) {
        constexpr double k_half_alpha = 5e-5;
        return std::isfinite(degrees_of_freedom)
                   ? boost::math::quantile(boost::math::complement(
                         boost::math::students_t_distribution<double>(degrees_of_freedom), k_half_alpha))
                   : critical;
    };
    return result;
}

/// The kind of the group that the message has to name first; none where it is a refusal or no group.
std::optional<GroupKind> kind_of(Blunder blunder) {
    switch (blunder) {
        case Blunder::visit:
            return GroupKind::visit_length;
        case Blunder::jump:
        case Blunder::large_jump:
            return GroupKind::dead_path_change;
        case Blunder::drift:
        case Blunder::drift_of_all:
        case Blunder::closed_drift:
        case Blunder::closed_drift_of_all:
            return GroupKind::drift;
        case Blunder::moved_station:
            return GroupKind::station_place;
        case Blunder::pair:
            return GroupKind::pair_length;
        case Blunder::leaning_reflector:
            return GroupKind::reflector_at_angles;
        case Blunder::moved_reflector:
            return GroupKind::reflector_from_visit;
        case Blunder::angle_index:
            return GroupKind::angle_index;
        case Blunder::displaced_reflector:
            return GroupKind::reflector;
        case Blunder::hot_fixture:
            return GroupKind::fixture_scale;
        case Blunder::moved_fixture:
            return GroupKind::fixture_place;
        case Blunder::scale_of_station:
        case Blunder::scale_of_two:
            return GroupKind::station_scale;
        default:
            return std::nullopt;
    }
}

/// Standard deviation of the estimate of an error at a sound campaign, and what is found with 80 % and with 99.9 %,
/// [m].
struct Detectable {
    double u = 0.0, mostly = 0.0, nearly_always = 0.0;
};
constexpr double k_deviate_of_80 = 0.8416;
constexpr double k_deviate_of_999 = 3.0902;

bool is_drift(Blunder blunder) {
    return kind_of(blunder) == GroupKind::drift;
}

/// Of the planted error, from the campaign without it.
std::optional<Detectable> detectable(const synthetic::Planted& planted, Blunder blunder, int angles, int seed) {
    if (!is_drift(blunder) && blunder != Blunder::visit) {
        return std::nullopt;
    }
    const RotaryTableMeasurement sound =
        synthetic::sound_campaign(static_cast<std::uint64_t>(seed), angles, synthetic::is_closed(blunder)).measurement;
    const RotaryTableSolution solution = evaluate_jointly(sound, options());
    const auto at = [](double u, double limit) {
        return Detectable{u, (limit + k_deviate_of_80) * u, (limit + k_deviate_of_999) * u};
    };
    if (is_drift(blunder)) {
        const bool of_all = blunder == Blunder::drift_of_all || blunder == Blunder::closed_drift_of_all;
        for (const DriftEstimate& drift : solution.groups->drifts) {
            if (drift.station == (of_all ? GroupTest::k_none : planted.station)) {
                return at(drift.u, drift.minimal_detectable / drift.u - k_deviate_of_80);
            }
        }
        return std::nullopt;
    }
    const auto visit = std::ranges::find_if(solution.groups->visits, [&](const VisitDeviation& deviation) {
        return deviation.visit.station == planted.station && deviation.visit.angle == planted.angle;
    });
    const auto test = std::ranges::find(solution.groups->tests, GroupKind::visit_length, &GroupTest::kind);
    if (visit == solution.groups->visits.end() || test == solution.groups->tests.end()) {
        return std::nullopt;
    }
    return at(visit->u, std::sqrt(test->critical_value));
}

struct Tally {
    int named = 0, warned = 0, refused = 0, silent = 0;
    int silent_above = 0;         ///< larger than what is found nearly always
    double largest_silent = 0.0;  ///< [m], of a scale [1]
    const char* unit = "µm";      ///< of a millionth of it
    std::vector<Detectable> detectables;
};

double median(std::vector<Detectable> of, double Detectable::*member) {
    std::ranges::sort(of, {}, member);
    return of[of.size() / 2].*member;
}

void note_silent(Tally& tally, Blunder blunder, const synthetic::Planted& planted, int angles, int seed, bool silent) {
    if (silent) {
        tally.largest_silent = std::max(tally.largest_silent, std::abs(planted.size));
    }
    const std::optional<Detectable> limits = detectable(planted, blunder, angles, seed);
    if (!limits) {
        return;
    }
    tally.detectables.push_back(*limits);
    tally.silent_above += silent && std::abs(planted.size) > limits->nearly_always ? 1 : 0;
}

/// \return the message of a refusal
std::string count(Tally& tally, Blunder blunder, const RotaryTableMeasurement& measurement) {
    try {
        const RotaryTableSolution solution = evaluate_jointly(measurement, options());
        const bool warns = std::ranges::any_of(
            solution.notes, [](const auto& note) { return note.severity == gumcert::gum::Severity::warning; });
        const bool removed = blunder == Blunder::outliers && !solution.outliers.empty();
        ++(warns || removed ? tally.warned : tally.silent);
        const std::optional<GroupKind> kind = kind_of(blunder);
        tally.named +=
            removed || (warns && kind && solution.groups && !solution.groups->tests.empty() &&
                        solution.groups->tests.front().suspicious && solution.groups->tests.front().kind == *kind)
                ? 1
                : 0;
        return "";
    } catch (const gumcert::gum::NoResultError& error) {
        ++tally.refused;
        const std::string message = error.what();
        const bool cause = message.find("are interchanged") != std::string::npos ||
                           message.find("turns the other way") != std::string::npos ||
                           message.find("the beam was interrupted") != std::string::npos;
        tally.named += cause ? 1 : 0;
        return message;
    }
}

void print_detectable(const std::vector<std::pair<const char*, Tally>>& tallies) {
    std::printf(
        "\nWhat can be found. u is the standard deviation with which the other distances tell the error in the sound\n"
        "campaign, the medians of all campaigns are stated; for given weights the test is the most powerful one of\n"
        "its level that does not depend on the error motions of the table.\n\n");
    std::printf(
        "| blunder | u in µm | found with 80 %% | found with 99.9 %% | largest silent | silent above 99.9 %% |\n");
    std::printf("|---|---|---|---|---|---|\n");
    for (const auto& [name, tally] : tallies) {
        if (!tally.detectables.empty()) {
            std::printf("| %s | %.2f | %.2f µm | %.2f µm | %.2f µm | %d |\n", name,
                        1e6 * median(tally.detectables, &Detectable::u),
                        1e6 * median(tally.detectables, &Detectable::mostly),
                        1e6 * median(tally.detectables, &Detectable::nearly_always), 1e6 * tally.largest_silent,
                        tally.silent_above);
        }
    }
    for (const auto& [name, tally] : tallies) {
        if (tally.detectables.empty() && tally.largest_silent > 0.0) {
            std::printf("\nThe largest %s of which nothing is told: %.2f %s.\n", name, 1e6 * tally.largest_silent,
                        tally.unit);
        }
    }
}

/// Interchanges and the sense of rotation are found by adjusting anew what each of them would mean, which takes seconds.
constexpr int k_most_of_slow_kinds = 200;
bool is_slow(Blunder blunder) {
    return blunder == Blunder::swapped_reflectors || blunder == Blunder::swapped_reflectors_of_station ||
           blunder == Blunder::wrong_sense;
}

}  // namespace

int main(int argc, char** argv) {
    const int campaigns = argc > 1 ? std::atoi(argv[1]) : 1000;
    const int angles = argc > 2 ? std::atoi(argv[2]) : 24;
    const std::string_view only = argc > 3 ? argv[3] : "";
    std::printf("| blunder | campaigns | told | of these with the true cause first | refused | silent |\n");
    std::printf("|---|---|---|---|---|---|\n");
    std::vector<std::pair<const char*, Tally>> tallies;
    for (const auto& [blunder, name] : synthetic::k_blunders) {
        if (!only.empty() && only != name) {
            continue;
        }
        Tally tally;
        tally.unit = kind_of(blunder) == GroupKind::station_scale ? "ppm" : tally.unit;
        const int planted_campaigns = is_slow(blunder) ? std::min(campaigns, k_most_of_slow_kinds) : campaigns;
        for (int seed = 1; seed <= planted_campaigns; ++seed) {
            const synthetic::Planted planted = synthetic::plant(blunder, static_cast<std::uint64_t>(seed), angles);
            const int silent = tally.silent;
            const std::string refusal = count(tally, blunder, planted.measurement);
            if (!refusal.empty() || tally.silent > silent) {
                std::fprintf(stderr, "%s, seed %d: %s\n", name, seed, refusal.empty() ? "silent" : refusal.c_str());
            }
            note_silent(tally, blunder, planted, angles, seed, tally.silent > silent);
        }
        std::printf("| %s | %d | %d | %d | %d | %d |\n", name, planted_campaigns, tally.warned + tally.refused,
                    tally.named, tally.refused, tally.silent);
        std::fflush(stdout);
        tallies.emplace_back(name, std::move(tally));
    }
    print_detectable(tallies);
    return 0;
}
