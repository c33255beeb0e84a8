#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "engine/rotary_table/evaluation/settled_errors.h"
#include "engine/rotary_table/group_tests.h"

namespace gumcert::engine {

/// Groups that are told together. What one of them is off by is biased by the others where it is estimated alone: a reflector that
/// was moved makes the fixture seem larger. Their sizes are therefore those of one adjustment with the unknowns of all of them.
///
/// \param told  suspicious, with columns
[[nodiscard]] ErrorModel errors_of_groups(const std::vector<GroupTest>& told);

/// Sizes of groups that are told together, from the adjustment without them. A group whose error is less than three of its standard
/// uncertainties beside the others is taken from the list, the least one first: the others explain what it was told for. Of errors
/// that the others take up wholly no size is known.
/// \param visits     of the adjustment that the groups are of
/// \param taken_off  unknowns of errors_of_groups()
/// \param without    solved, at the weights that the sizes are judged with
/// \param scale      of test values at these weights
/// \param upper_tail  probability above a value of chi-square, by value and degrees of freedom
/// \return whether all of them are there still; else the sizes are to be asked anew
[[nodiscard]] bool take_joint_sizes(std::vector<GroupTest>& told, const std::vector<Visit>& visits,
                                    const Eigen::VectorXd& taken_off, const JointAdjustment& without, double scale,
                                    const std::function<double(double, double)>& upper_tail);

}  // namespace gumcert::engine
