#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "gum/comparison/comparison_scheme.h"

namespace gumcert::gum {

/// Covariance of two results through the sources that both name (JCGM 100:2008, F.1.2.3), source by source.
///
/// Contributions of one source are paired by the name of their input; where the names differ and each side has one
/// contribution of that source, these two are paired. Anything else cannot be told from the budgets: the product of the
/// root sums of squares is taken, which is the largest it can be, and `ambiguous` is set.
struct SourceCovariance {
    std::string source;
    double covariance = 0.0;
    bool ambiguous = false;
};
/// \param independent  names of sources that are not shared although both sides name them
[[nodiscard]] std::vector<SourceCovariance> shared_covariance(const std::vector<UncertaintySource>& first,
                                                              const std::vector<UncertaintySource>& second,
                                                              const std::vector<std::string>& independent);

/// The sources of all points of one method.
struct PointSources {
    std::vector<std::vector<UncertaintySource>> all = {};     ///< one list a point
    std::vector<std::vector<UncertaintySource>> common = {};  ///< of them, those that all points share
};

/// Covariance of the values of two methods through the sources that both name: cov(method i, reference j), m×m.
/// An input that all points share ties every point of one method to every point of the other; an input that each point
/// has of its own ties equal points only.
[[nodiscard]] Eigen::MatrixXd cross_covariance_of_sources(const PointSources& method, const PointSources& reference,
                                                          const std::vector<std::string>& independent);

}  // namespace gumcert::gum
