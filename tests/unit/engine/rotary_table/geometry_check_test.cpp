// A weak layout is warned of with its figures, one that determines nothing is refused with names and a cure that fits.
#include "engine/rotary_table/geometry_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/joint_adjustment.h"
#include "gum/quantity/dense_factors.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

CampaignPlan twelve_angles() {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    return plan;
}

/// Six reflectors on a ring about the axis, alternate ones raised; station P3 on the axis, 1 m out.
CampaignPlan ring(double raised) {
    CampaignPlan plan = twelve_angles();
    for (std::size_t m = 0; m < 6; ++m) {
        const double angle = std::numbers::pi / 3.0 * static_cast<double>(m);
        plan.reflectors[m] = {0.1 + (m % 2 == 0 ? raised : 0.0), 0.12 * std::cos(angle), 0.12 * std::sin(angle)};
    }
    plan.stations[2] = {1.0, 0.0, 0.0};
    return plan;
}

std::vector<gum::Diagnostic> notes_of(const Campaign& campaign) {
    return geometry_notes(campaign.measurement, campaign.truth.stations);
}

const gum::Diagnostic* find(const std::vector<gum::Diagnostic>& notes, const std::string& code,
                            const std::string& where) {
    const auto found = std::find_if(notes.begin(), notes.end(), [&](const gum::Diagnostic& note) {
        return note.code == code && note.where == where;
    });
    return found == notes.end() ? nullptr : &*found;
}

/// The number after `words`.
double figure(const std::string& text, const std::string& words) {
    const auto at = text.find(words);
    double value = std::nan("");
    if (at != std::string::npos) {
        const char* const first = text.data() + at + words.size();
        std::from_chars(first, text.data() + text.size(), value);
    }
    return value;
}

TEST(GeometryNotes, GoodLayoutsHaveNone) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        for (const auto paths : {synthetic::DeadPaths::per_station, synthetic::DeadPaths::per_station_and_reflector}) {
            CampaignPlan plan;
            plan.axis = axis;
            plan.dead_paths = paths;
            for (const gum::Diagnostic& note : notes_of(simulate(plan))) {
                ADD_FAILURE() << gum::message(note);
            }
        }
    }
}

TEST(GeometryNotes, RaisedHoldersHaveTheConditionOfTheNote) {
    // rotary-table.md, 4c: 1, 10 and 50 mm give 2e5, 2e4 and 4e3.
    for (const auto& [raised, condition] : {std::pair{1e-3, 2e5}, {10e-3, 2e4}, {50e-3, 4e3}}) {
        for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
            CampaignPlan plan = ring(raised);
            plan.axis = axis;
            plan.noise = 0.0;
            const auto notes = notes_of(simulate(plan));
            const gum::Diagnostic* const note = find(notes, "GC-GEOMETRY-0002", "station P3");
            ASSERT_NE(note, nullptr) << raised;
            EXPECT_EQ(note->severity, gum::Severity::warning);
            EXPECT_NEAR(figure(note->what, "condition number of its position and dead path ") / condition, 1.0, 0.1)
                << note->what;
            EXPECT_NE(note->what.find("stands 0 mm off the rotary axis and sees all reflectors under 7.6°"),
                      std::string::npos)
                << note->what;
            EXPECT_NE(note->action.find("move the station off the rotary axis by"), std::string::npos) << note->action;
            EXPECT_NE(note->action.find("raise alternate holders by"), std::string::npos) << note->action;
            EXPECT_EQ(find(notes, "GC-GEOMETRY-0004", "fixture") != nullptr, raised < 0.02) << raised;
        }
    }
    const auto cured = notes_of(simulate(ring(0.1)));
    EXPECT_EQ(find(cured, "GC-GEOMETRY-0002", "station P3"), nullptr);
}

TEST(GeometryNotes, TheCureCures) {
    // What the warning at 10 mm says: the station moved, or the holders raised, so far.
    const auto warned = notes_of(simulate(ring(0.01)));
    const std::string action = find(warned, "GC-GEOMETRY-0002", "station P3")->action;
    CampaignPlan moved = ring(0.01);
    moved.stations[2][1] = 1e-3 * figure(action, "off the rotary axis by ");
    EXPECT_EQ(find(notes_of(simulate(moved)), "GC-GEOMETRY-0002", "station P3"), nullptr) << action;
    const CampaignPlan raised = ring(0.01 + 1e-3 * figure(action, "raise alternate holders by "));
    EXPECT_EQ(find(notes_of(simulate(raised)), "GC-GEOMETRY-0002", "station P3"), nullptr) << action;
}

TEST(GeometryNotes, NarrowStationsAreWarnedOfFromFourfoldLossOn) {
    // Derives the limit: the layout of the note drawn together about one direction.
    CampaignPlan wide;
    wide.noise = 0.0;
    const auto u = [](const Campaign& campaign) {
        return synthetic::rms_over_angles(
            evaluate_jointly(campaign.measurement, EvaluationOptions{}).covariance.diagonal().cwiseSqrt(), 36);
    };
    const synthetic::Vector6 reference = u(simulate(wide));
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& reflector : wide.reflectors) {
        centre += reflector / 6.0;
    }
    struct Row {
        double factor, spread_deg, translation, rotation;
        bool warned;
    };
    for (const Row& row : {Row{0.1, 8.2, 8.0, 10.9, true}, Row{0.15, 11.9, 5.7, 7.5, true},
                           Row{0.25, 18.8, 3.7, 4.8, true}, Row{0.3, 22.0, 3.2, 4.1, false}}) {
        CampaignPlan plan = wide;
        for (Eigen::Vector3d& station : plan.stations) {
            const double distance = (station - centre).norm();
            const Eigen::Vector3d direction = Eigen::Vector3d::UnitX() + row.factor / distance * (station - centre);
            station = centre + distance * direction.normalized();
        }
        const Campaign campaign = simulate(plan);
        const synthetic::Vector6 loss = u(campaign).cwiseQuotient(reference);
        EXPECT_NEAR(loss[1], row.translation, 0.15) << row.spread_deg;
        EXPECT_NEAR(loss[2], row.translation, 0.15) << row.spread_deg;
        EXPECT_NEAR(loss[3], row.rotation, 0.15) << row.spread_deg;
        const auto notes = notes_of(campaign);
        const gum::Diagnostic* const note = find(notes, "GC-GEOMETRY-0001", "stations");
        EXPECT_EQ(note != nullptr, row.warned) << row.spread_deg;
        if (note != nullptr) {
            EXPECT_NEAR(figure(note->what, "within "), row.spread_deg, 0.06) << note->what;
        }
    }
}

TEST(GeometryNotes, DistantStationsAreWarnedOfWithTheirRatio) {
    CampaignPlan plan = twelve_angles();
    plan.stations[3] *= 4.0;
    const auto notes = notes_of(simulate(plan));
    const gum::Diagnostic* const note = find(notes, "GC-GEOMETRY-0003", "station P4");
    ASSERT_NE(note, nullptr);
    EXPECT_NEAR(figure(note->what, "(ratio "), 22.0, 1.5) << note->what;
    EXPECT_EQ(notes.size(), 1U) << gum::message(notes.back());
}

TEST(GeometryNotes, LeastNumberOfAnglesIsThreeForBothData) {
    // Rank of what is left of the error motions: 2(N - 1) along and about the axis, and beyond these 4(N - 2) across
    // it.
    for (const Datum datum : {Datum::home, Datum::axis_average_line}) {
        for (int count = 2; count <= 6; ++count) {
            CampaignPlan plan;
            plan.datum = datum;
            plan.angles_deg = synthetic::full_turn(count);
            const Campaign campaign = simulate(plan);
            const DatumSolution solution =
                transform_to_datum(campaign.measurement, Eigen::MatrixXd::Zero(6, count), RigidMotion{}, datum);
            Eigen::MatrixXd across(4 * count, 6 * count);
            Eigen::MatrixXd along(2 * count, 6 * count);
            const Eigen::MatrixXd error_map = solution.carried(Eigen::MatrixXd::Identity(6 * count, 6 * count));
            for (Eigen::Index i = 0; i < count; ++i) {
                across.row(4 * i) = error_map.row(6 * i + 1);
                across.row(4 * i + 1) = error_map.row(6 * i + 2);
                across.row(4 * i + 2) = error_map.row(6 * i + 4);
                across.row(4 * i + 3) = error_map.row(6 * i + 5);
                along.row(2 * i) = error_map.row(6 * i);
                along.row(2 * i + 1) = error_map.row(6 * i + 3);
            }
            const auto rank = [](const Eigen::MatrixXd& map) {
                const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(map).singularValues();
                return (values.array() > 1e-9).count();
            };
            EXPECT_EQ(rank(error_map), 6 * count - 10) << count;
            // About home the motions across also carry a shadow of the other two, through the reflectors off the axis.
            EXPECT_EQ(rank(error_map) - rank(along), 4 * (count - 2)) << count;
            if (datum == Datum::axis_average_line) {
                EXPECT_EQ(rank(across), 4 * (count - 2)) << count;
            }
            EXPECT_EQ(rank(along), 2 * (count - 1)) << count;
            const auto notes = notes_of(campaign);
            EXPECT_EQ(find(notes, "GC-GEOMETRY-0005", "angles") != nullptr, count == 3) << count;
            if (count < 3) {
                EXPECT_THROW(require_enough_angles(campaign.measurement), gum::NoResultError);
            } else {
                EXPECT_NO_THROW(require_enough_angles(campaign.measurement));
            }
        }
    }
}

TEST(GeometryNotes, AngleAndTheSameAfterAFullTurnAreOne) {
    CampaignPlan plan;
    plan.angles_deg = {0.0, 180.0, 360.0};
    try {
        require_enough_angles(simulate(plan).measurement);
        FAIL();
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-RANK-0002");
        EXPECT_NE(error.diagnostics().front().what.find("2 angles"), std::string::npos);
    }
}

/// What the rank check and its diagnosis say of a measurement, from the true stations.
gum::Diagnostic diagnosis(const Campaign& campaign) {
    const RotaryTableMeasurement& measurement = campaign.measurement;
    const JointAdjustment adjustment(measurement, std::vector<bool>(measurement.lengths.size(), true), RigidMotion{},
                                     {campaign.truth.stations, campaign.truth.dead_paths}, StochasticModel{});
    const RankReport rank = adjustment.adjustment().linearise().rank(SolverOptions{}.rank_tolerance);
    EXPECT_TRUE(rank.deficient);
    EXPECT_THROW(refuse_undetermined(measurement, rank, campaign.truth.stations), gum::NoResultError);
    return undetermined(measurement, rank, campaign.truth.stations);
}

void expect_words(const gum::Diagnostic& diagnostic, const std::vector<std::string>& words) {
    EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
    for (const std::string& word : words) {
        EXPECT_NE(gum::message(diagnostic).find(word), std::string::npos) << word << " in " << gum::message(diagnostic);
    }
}

TEST(Undetermined, ConeNamesStationDeadPathAndHowItStands) {
    CampaignPlan plan = ring(0.0);
    plan.noise = 0.0;
    plan.error_factor = 0.0;
    plan.offset.setZero();
    plan.tilt.setZero();
    const gum::Diagnostic diagnostic = diagnosis(simulate(plan));
    EXPECT_EQ(diagnostic.where, "station P3");
    expect_words(diagnostic, {"stands 0 mm off the rotary axis and sees all reflectors under 7.6° to the axis",
                              "station P3, x", "dead path P3", "cone", "move the station off the rotary axis by 800 mm",
                              "raise alternate holders by 100 mm along x"});
    EXPECT_EQ(gum::message(diagnostic).find("P1"), std::string::npos) << gum::message(diagnostic);
}

TEST(Undetermined, HomeAngleThatHoldsNothingIsNamed) {
    for (const std::size_t kept : {0U, 5U}) {
        Campaign campaign = simulate(twelve_angles());
        std::size_t seen = 0;
        std::erase_if(campaign.measurement.lengths, [&](const LengthObservation& length) {
            return length.angle == campaign.measurement.home && ++seen > kept;
        });
        const gum::Diagnostic diagnostic = diagnosis(campaign);
        EXPECT_EQ(diagnostic.where, "home angle 0°");
        expect_words(diagnostic, {"station P4, x, y, z", std::to_string(kept) + " distances", "at least six",
                                  "measure the home angle from all stations"});
    }
}

TEST(Undetermined, ReflectorsOnOneLine) {
    CampaignPlan plan = twelve_angles();
    for (std::size_t m = 0; m < 6; ++m) {
        const auto k = static_cast<double>(m);
        plan.reflectors[m] = {0.03 * k, 0.02 * k + 0.05, 0.01 * k};
    }
    expect_words(diagnosis(simulate(plan)),
                 {"all reflectors of the home angle lie on one line", "off that line", "changes no distance"});
}

TEST(Undetermined, TooFewStationsOrReflectors) {
    CampaignPlan plan = twelve_angles();
    plan.stations.resize(2);
    expect_words(diagnosis(simulate(plan)), {"EXA", "at angle number 2", "12 distances from 2 stations to 6 reflectors",
                                             "joins two stations", "at least 3 stations"});
    plan = twelve_angles();
    plan.reflectors.resize(2);
    expect_words(diagnosis(simulate(plan)), {"12 distances from 6 stations to 2 reflectors", "at least 3 reflectors"});
}

TEST(Undetermined, FreeScalesWithoutTheScaleOfTheFixture) {
    CampaignPlan plan = twelve_angles();
    plan.scale_model = ScaleModel::free;
    plan.cmm_factor = 1e4;
    plan.noise = 0.0;
    expect_words(diagnosis(simulate(plan)),
                 {"scale of the stations", "station P1, x, y, scale", "state the scale as fixed or with a prior"});
}

TEST(Undetermined, SensesAtDifferentAngles) {
    CampaignPlan plan = twelve_angles();
    plan.both_senses = true;
    Campaign campaign = simulate(plan);
    std::erase_if(campaign.measurement.lengths, [](const LengthObservation& length) {
        return (length.approach == Approach::negative) == (length.angle >= 6);
    });
    expect_words(diagnosis(campaign), {"reversal of E", "two senses of approach at the same angles"});
}

TEST(Undetermined, DeadPathWithoutADistance) {
    Campaign campaign = simulate(twelve_angles());
    campaign.measurement.dead_paths.emplace_back("P7");
    campaign.truth.dead_paths.conservativeResize(7);
    campaign.truth.dead_paths[6] = 0.2;
    const gum::Diagnostic diagnostic = diagnosis(campaign);
    EXPECT_EQ(diagnostic.where, "dead path P7");
    expect_words(diagnostic, {"needs a distance"});
}

}  // namespace
}  // namespace gumcert::engine
