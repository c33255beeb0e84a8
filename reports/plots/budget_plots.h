#pragma once

#include "reports/plots/svg_plot.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

#include <string>

namespace gumcert::reports {

/// Shares of the inputs in the variance of a result, largest first; what is beyond the twelfth is one bar.
/// \param id  unique in the document
[[nodiscard]] BarPlot share_plot(const Result& result, const Wording& words, const std::string& id);

/// Histogram of the trials, density of the law of propagation, and the intervals of both.
/// \param result  with a `monte_carlo` that has a histogram
[[nodiscard]] DensityPlot monte_carlo_plot(const Result& result, const Wording& words, const std::string& id);

/// Residuals of a fit against x, or against the number of the observation where there are several regressors.
[[nodiscard]] Plot residual_plot(const FitSummary& fit, const Wording& words, const std::string& id);

}  // namespace gumcert::reports
