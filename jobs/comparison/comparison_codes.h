#pragma once

#include <array>

#include "jobs/input_codes.h"

namespace gumcert::jobs {

// What is refused in jobs of kind `comparison` only. What is wrong with their text, their types and their numbers has
// the codes of input_codes.h.
inline constexpr InputCode k_comparison_form{"GC-INPUT-0501", "a comparison of neither form, or of both"};
inline constexpr InputCode k_bare_uncertainty{"GC-INPUT-0502", "an uncertainty that is neither u nor U with k"};
inline constexpr InputCode k_u_and_expanded_u{"GC-INPUT-0503", "u and U in one result"};
inline constexpr InputCode k_no_coverage_factor{"GC-INPUT-0504",
                                                "an expanded uncertainty without its coverage factor, or the reverse"};
inline constexpr InputCode k_too_few_participants{"GC-INPUT-0505", "fewer than 2 participants"};
inline constexpr InputCode k_too_few_results{"GC-INPUT-0506", "fewer than 2 results for an item"};
inline constexpr InputCode k_repeated_id{"GC-INPUT-0507", "an identification is used twice"};
inline constexpr InputCode k_repeated_result{"GC-INPUT-0508", "a participant has two results for one item and round"};
inline constexpr InputCode k_unknown_participant{"GC-INPUT-0509", "a participant that the job does not have"};
inline constexpr InputCode k_unknown_item{"GC-INPUT-0510", "an item that the job does not have"};
inline constexpr InputCode k_unknown_round{"GC-INPUT-0511", "a round that the job does not have"};
inline constexpr InputCode k_unknown_group{"GC-INPUT-0512", "a group that no participant belongs to"};
inline constexpr InputCode k_censored_result{"GC-INPUT-0513", "a result such as \"<0.3\", which is no value"};
inline constexpr InputCode k_no_reason{"GC-INPUT-0514", "a result that does not contribute, without a reason"};
inline constexpr InputCode k_participant_differs{"GC-INPUT-0515", "two statements about one participant differ"};
inline constexpr InputCode k_comparison_pair{"GC-INPUT-0516",
                                             "a correlation of a participant with itself, or stated twice"};
inline constexpr InputCode k_comparison_correlations{"GC-INPUT-0517", "correlations that cannot hold together"};
inline constexpr InputCode k_too_many_correlated{"GC-INPUT-0518",
                                                 "more correlated participants than one matrix may have"};
inline constexpr InputCode k_assigned_value_incomplete{"GC-INPUT-0519",
                                                       "an assigned value that lacks what its method needs"};
inline constexpr InputCode k_reference_without_result{
    "GC-INPUT-0520", "a reference participant without the result that is the assigned value"};
inline constexpr InputCode k_result_without_uncertainty{
    "GC-INPUT-0521", "a result without the uncertainty that the assigned value needs"};
inline constexpr InputCode k_result_without_replicates{"GC-INPUT-0522",
                                                       "a result without the s and n that the assigned value needs"};
inline constexpr InputCode k_sigma_pt{"GC-INPUT-0523", "a sigma_pt that is not stated in exactly one way"};
inline constexpr InputCode k_ragged_replicates{"GC-INPUT-0524", "rows of replicates that differ in length"};
inline constexpr InputCode k_correlation_matrix{"GC-INPUT-0525",
                                                "a correlation matrix that is not symmetric with ones on its diagonal"};
inline constexpr InputCode k_parts_exceed_uncertainty{"GC-INPUT-0526",
                                                      "parts of an uncertainty that are larger than the whole"};
inline constexpr InputCode k_repeated_source{"GC-INPUT-0527", "a source that occurs twice in one result"};
inline constexpr InputCode k_points_differ{"GC-INPUT-0528", "points that only one of the two methods has"};
inline constexpr InputCode k_repeated_comparison_point{"GC-INPUT-0529", "a point that occurs twice in one direction"};
inline constexpr InputCode k_comparison_budget{"GC-INPUT-0530",
                                               "a budget that does not give the results that are asked of it"};
inline constexpr InputCode k_stated_beside_budget{"GC-INPUT-0531",
                                                  "two statements of one uncertainty, or of one value"};
inline constexpr InputCode k_comparison_covariance_asymmetric{"GC-INPUT-0532",
                                                              "a covariance matrix of points that is not symmetric"};
inline constexpr InputCode k_comparison_covariance{"GC-INPUT-0533",
                                                   "a covariance matrix of points that is not positive semi-definite"};
inline constexpr InputCode k_comparison_covariance_diagonal{
    "GC-INPUT-0534", "a variance of a point that differs from the square of its u"};
inline constexpr InputCode k_no_position{"GC-INPUT-0535", "points without the position that the bias line needs"};
inline constexpr InputCode k_no_shared_sources{"GC-INPUT-0536", "shared sources of results without budgets"};
inline constexpr InputCode k_too_many_results{"GC-INPUT-0537", "more results than one record holds"};
inline constexpr InputCode k_check_without_criterion{
    "GC-INPUT-0538", "a check of homogeneity or stability without what it is held against"};
inline constexpr InputCode k_reserved_direction{"GC-INPUT-0539", "a direction with the name that all together have"};
inline constexpr InputCode k_degrees_of_freedom_of_nothing{"GC-INPUT-0540",
                                                           "degrees of freedom without an uncertainty"};
inline constexpr InputCode k_compared_job{"GC-INPUT-0541", "a job that cannot be one side of a comparison"};
inline constexpr InputCode k_unit_of_value{"GC-INPUT-0542", "a value in another unit than the comparison takes it in"};
inline constexpr InputCode k_reason_of_nothing{"GC-INPUT-0543", "a reason beside a value that is scored"};
inline constexpr InputCode k_column_in_capitals{"GC-INPUT-0544", "a column that is known in other letters"};
inline constexpr InputCode k_incomplete_amendment{
    "GC-INPUT-0545", "an amended report that does not say of what, why, or what has changed"};

// Warnings: the input is accepted, and a person should look at it.
inline constexpr InputCode k_warn_no_result{"GC-WARN-0020", "a participant without a single result"};
inline constexpr InputCode k_warn_exact_assigned_value{"GC-WARN-0022",
                                                       "an assigned value that is taken as exactly known"};
inline constexpr InputCode k_warn_uncertainty_without_value{"GC-WARN-0023",
                                                            "an uncertainty of a result that is missing"};
inline constexpr InputCode k_warn_few_to_check{"GC-WARN-0024", "fewer than 10 items in a check of homogeneity"};
inline constexpr InputCode k_warn_similar_participants{"GC-WARN-0025",
                                                       "participants whose ids differ in spelling only"};

/// The whole table, in the order of the codes.
inline constexpr std::array k_comparison_codes{k_comparison_form,
                                               k_bare_uncertainty,
                                               k_u_and_expanded_u,
                                               k_no_coverage_factor,
                                               k_too_few_participants,
                                               k_too_few_results,
                                               k_repeated_id,
                                               k_repeated_result,
                                               k_unknown_participant,
                                               k_unknown_item,
                                               k_unknown_round,
                                               k_unknown_group,
                                               k_censored_result,
                                               k_no_reason,
                                               k_participant_differs,
                                               k_comparison_pair,
                                               k_comparison_correlations,
                                               k_too_many_correlated,
                                               k_assigned_value_incomplete,
                                               k_reference_without_result,
                                               k_result_without_uncertainty,
                                               k_result_without_replicates,
                                               k_sigma_pt,
                                               k_ragged_replicates,
                                               k_correlation_matrix,
                                               k_parts_exceed_uncertainty,
                                               k_repeated_source,
                                               k_points_differ,
                                               k_repeated_comparison_point,
                                               k_comparison_budget,
                                               k_stated_beside_budget,
                                               k_comparison_covariance_asymmetric,
                                               k_comparison_covariance,
                                               k_comparison_covariance_diagonal,
                                               k_no_position,
                                               k_no_shared_sources,
                                               k_too_many_results,
                                               k_check_without_criterion,
                                               k_reserved_direction,
                                               k_degrees_of_freedom_of_nothing,
                                               k_compared_job,
                                               k_unit_of_value,
                                               k_reason_of_nothing,
                                               k_column_in_capitals,
                                               k_incomplete_amendment,
                                               k_warn_no_result,
                                               k_warn_unusual_coverage_factor,
                                               k_warn_exact_assigned_value,
                                               k_warn_uncertainty_without_value,
                                               k_warn_few_to_check,
                                               k_warn_similar_participants};

}  // namespace gumcert::jobs
