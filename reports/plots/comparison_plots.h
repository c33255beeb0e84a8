#pragma once

#include <cstddef>
#include <string>

#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

namespace gumcert::reports {

// Plots of a comparison as SVG (reports/plots/svg_drawing.h): series differ by marker and filling, not by colour. The numbers
// come from the record; the only arithmetic here is that of axes: a power of ten is put into the label of an axis where
// its numbers are very large or small, and outliers many spreads away are marked at the edge. Where the record holds
// nothing to draw, the text is "". `id` is unique in a document, [a-z0-9-].
// \throws gum::NoResultError  GC-REPORT-0003 a number is not finite

// Laboratories stand in ascending order of their values: with their names up to 150, as thin bars from 60 to 400, and
// as a curve with a band beyond that. Those that do not contribute to the assigned value are open marks.

/// Values of all laboratories for one item with U, the assigned value as a line and its U as a band.
[[nodiscard]] std::string laboratory_values_plot(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                                 const std::string& id, const Wording& words);

/// Differences of all laboratories from the assigned value with U(D), for one item; "" where none has a U(D).
[[nodiscard]] std::string laboratory_differences_plot(const Comparison& comparison,
                                                      const ComparisonItemEvaluation& item, const std::string& id,
                                                      const Wording& words);

/// Up to so many laboratories stand in the figures with their names; more with their numbers, which a table gives.
inline constexpr std::size_t k_most_named_columns = 150;

/// E_n (or the score that decides) of every laboratory for one item as bars, with the limits.
[[nodiscard]] std::string laboratory_scores_plot(const Comparison& comparison, const ComparisonItemEvaluation& item,
                                                 const std::string& id, const Wording& words);

/// Square of laboratories by laboratories: |E_n| of each pair by the size of a mark, pairs above 1 marked.
[[nodiscard]] std::string pairs_plot(const ComparisonItemEvaluation& item, const std::string& id, const Wording& words);

/// Youden plot of two items, of z where it has their σ_pt: one point a laboratory, the ellipse, the medians and the
/// line of equal deviations.
[[nodiscard]] std::string youden_plot(const YoudenDiagram& diagram, const std::string& id, const Wording& words);

/// E_n of two methods against position (or the number of the point), a mark for each direction, limits at ±1.
[[nodiscard]] std::string method_scores_plot(const Comparison& comparison, const std::string& id, const Wording& words);

/// Values of both methods with U against position, a panel for each direction.
[[nodiscard]] std::string method_values_plot(const Comparison& comparison, const std::string& id, const Wording& words);

/// Differences of two methods with U against what the bias line is fitted to, and the line.
[[nodiscard]] std::string bias_plot(const Comparison& comparison, const std::string& id, const Wording& words);

}  // namespace gumcert::reports
