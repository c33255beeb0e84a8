// Plants every blunder of the catalogue on campaigns with consecutive seeds and prints, as Markdown, how many were
// told.
//
//   blunder_study [campaigns] [angles]
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "engine/rotary_table_evaluation.h"
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
            return GroupKind::dead_path_change;
        case Blunder::drift:
        case Blunder::drift_of_all:
            return GroupKind::drift;
        case Blunder::angle_index:
            return GroupKind::angle_index;
        case Blunder::displaced_reflector:
            return GroupKind::reflector;
        default:
            return std::nullopt;
    }
}

struct Tally {
    int named = 0, warned = 0, refused = 0, silent = 0;
};

void count(Tally& tally, Blunder blunder, const RotaryTableMeasurement& measurement) {
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
    } catch (const gumcert::gum::NoResultError& error) {
        ++tally.refused;
        const std::string message = error.what();
        const bool cause = message.find("are interchanged") != std::string::npos ||
                           message.find("turns the other way") != std::string::npos ||
                           message.find("the beam was interrupted") != std::string::npos;
        tally.named += cause ? 1 : 0;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const int campaigns = argc > 1 ? std::atoi(argv[1]) : 1000;
    const int angles = argc > 2 ? std::atoi(argv[2]) : 24;
    std::printf("| blunder | campaigns | told | of these with the true cause first | refused | silent |\n");
    std::printf("|---|---|---|---|---|---|\n");
    for (const auto& [blunder, name] : synthetic::k_blunders) {
        Tally tally;
        for (int seed = 1; seed <= campaigns; ++seed) {
            count(tally, blunder, synthetic::plant(blunder, static_cast<std::uint64_t>(seed), angles).measurement);
        }
        std::printf("| %s | %d | %d | %d | %d | %d |\n", name, campaigns, tally.warned + tally.refused, tally.named,
                    tally.refused, tally.silent);
        std::fflush(stdout);
    }
    return 0;
}
