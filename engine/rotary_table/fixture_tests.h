#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/rotary_table/group_judgement.h"

namespace gumcert::engine {

/// V⁻¹v and M of the coordinates of the fixture, x, y, z of one point after the other, less what is already explained.
struct FixtureMisfit {
    Eigen::VectorXd weighted;
    Eigen::MatrixXd spread;
    double least = 0.0;  ///< of the weight of a coordinate, below which nothing else controls it
};

/// The most that a displaced reflector or the scale of the fixture explains; 0 where neither is suspicious.
/// \param fixture  coordinates of the points, [m]
[[nodiscard]] double largest_fixture_misfit(const FixtureMisfit& misfit, const Eigen::MatrixX3d& fixture,
                                            const GroupJudgement& judgement);

/// The fixture as a whole and its points, one at a time: what is least probable is taken away before the next. What is not
/// suspicious is the scale, first of all, and the last point.
[[nodiscard]] std::vector<GroupTest> fixture_tests(FixtureMisfit misfit, const Eigen::MatrixX3d& fixture,
                                                   const GroupJudgement& judgement);

}  // namespace gumcert::engine
