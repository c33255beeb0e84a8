#pragma once

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"

namespace gumcert::engine {

/// The sequential method of the source paper, for comparison with the joint adjustment and as a check of it.
///
/// Stations and dead paths from the home position with the CMM coordinates taken as they are, reflector positions of
/// every angle from the stations, set-up errors by eqs. (2)-(6), six errors of each angle by eqs. (7)-(9) of the paper
/// (rotary-table method with LaserTRACER and reflectors). Each stage takes the result of the one before as exact; the
/// uncertainties do not: they are propagated from the inputs through all stages, with the correlations between points.
///
/// Variance components, outlying distances and reliability are those of the joint adjustment of the same distances:
/// the stages have no residuals of their own to tell them from.
///
/// \throws gum::NoResultError  when a stage is not determined, naming it
[[nodiscard]] RotaryTableSolution evaluate_sequentially(const RotaryTableMeasurement& measurement,
                                                        const EvaluationOptions& options,
                                                        const Progress& progress = {});

}  // namespace gumcert::engine
