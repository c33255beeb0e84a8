#include "engine/rotary_table/fixture_tests.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "engine/rotary_table/visit_effects.h"

namespace gumcert::engine {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void take_away(FixtureMisfit& misfit, const MatrixXd& effect) {
    const MatrixXd across = misfit.spread * effect;
    const MatrixXd inverse =
        pseudo_inverse(effect.transpose() * across, misfit.least * effect.colwise().squaredNorm().maxCoeff()).inverse;
    misfit.weighted -= across * (inverse * (effect.transpose() * misfit.weighted).eval());
    misfit.spread -= across * inverse * across.transpose();
}

MatrixXd effect_of_point(std::size_t point, Index coordinates) {
    MatrixXd effect = MatrixXd::Zero(coordinates, 3);
    effect.block<3, 3>(static_cast<Index>(3 * point), 0).setIdentity();
    return effect;
}

/// What a relative change of the size of the fixture does to its coordinates.
MatrixXd effect_of_fixture_scale(const Eigen::MatrixX3d& fixture) {
    return fixture.transpose().reshaped(fixture.size(), 1);
}

std::optional<GroupTest> reflector_test(const FixtureMisfit& misfit, const GroupJudgement& judgement, std::size_t point,
                                        std::size_t points) {
    const auto at = static_cast<Index>(3 * point);
    const Inverted inverted = pseudo_inverse(misfit.spread.block<3, 3>(at, at), misfit.least);
    if (inverted.rank == 0) {
        return std::nullopt;
    }
    const Eigen::Vector3d pull = misfit.weighted.segment<3>(at);
    const Eigen::Vector3d error = inverted.inverse * pull;
    GroupTest test = judgement.judged(GroupKind::reflector, pull.dot(error), inverted.rank, points);
    test.reflector = point;
    test.estimate = error.norm();
    test.minimal_detectable =
        (std::sqrt(test.critical_value) + k_deviate_of_power) * std::sqrt(inverted.inverse.trace() / inverted.rank);
    return test;
}

/// The scale of the fixture is controlled where the distances know theirs.
std::optional<GroupTest> fixture_scale_test(const FixtureMisfit& misfit, const Eigen::MatrixX3d& fixture,
                                            const GroupJudgement& judgement) {
    const VectorXd effect = effect_of_fixture_scale(fixture);
    const double spread = effect.dot(misfit.spread * effect);
    if (!(spread > misfit.least * effect.squaredNorm())) {
        return std::nullopt;
    }
    const double pull = effect.dot(misfit.weighted);
    GroupTest test = judgement.judged(GroupKind::fixture_scale, pull * pull / spread, 1, 1);
    test.estimate = pull / spread;
    test.minimal_detectable = (std::sqrt(test.critical_value) + k_deviate_of_power) / std::sqrt(spread);
    return test;
}

}  // namespace

double largest_fixture_misfit(const FixtureMisfit& misfit, const Eigen::MatrixX3d& fixture,
                              const GroupJudgement& judgement) {
    const auto points = static_cast<std::size_t>(misfit.weighted.size() / 3);
    double largest = 0.0;
    const auto consider = [&largest](const std::optional<GroupTest>& test) {
        if (test && test->suspicious) {
            largest = std::max(largest, test->chi_square);
        }
    };
    consider(fixture_scale_test(misfit, fixture, judgement));
    for (std::size_t m = 0; m < points && points > 3; ++m) {
        consider(reflector_test(misfit, judgement, m, points));
    }
    return largest;
}

std::vector<GroupTest> fixture_tests(FixtureMisfit misfit, const Eigen::MatrixX3d& fixture,
                                     const GroupJudgement& judgement) {
    std::vector<GroupTest> tests;
    const auto points = static_cast<std::size_t>(misfit.weighted.size() / 3);
    std::vector<bool> out(points, false);
    bool is_scaled = false;
    // Three points make a frame: of as many nothing controls the others.
    for (std::size_t round = 0; round + 3 < points; ++round) {
        std::optional<GroupTest> worst;
        for (std::size_t m = 0; m < points; ++m) {
            const std::optional<GroupTest> test = out[m] ? std::nullopt : reflector_test(misfit, judgement, m, points);
            if (test && (!worst || is_less_probable(*test, *worst))) {
                worst = test;
            }
        }
        const std::optional<GroupTest> scale =
            is_scaled ? std::nullopt : fixture_scale_test(misfit, fixture, judgement);
        if (scale && round == 0 && !scale->suspicious) {
            tests.push_back(*scale);
        }
        const bool is_scale = scale && scale->suspicious && (!worst || is_less_probable(*scale, *worst));
        if (is_scale) {
            tests.push_back(*scale);
            take_away(misfit, effect_of_fixture_scale(fixture));
            is_scaled = true;
            continue;
        }
        if (!worst || (!worst->suspicious && round > 0)) {
            return tests;
        }
        tests.push_back(*worst);
        if (!worst->suspicious) {
            return tests;
        }
        take_away(misfit, effect_of_point(worst->reflector, misfit.weighted.size()));
        out[worst->reflector] = true;
    }
    return tests;
}

}  // namespace gumcert::engine
