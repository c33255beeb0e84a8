#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace gumcert::jobs {

// The keys of the objects of a comparison, each list in the order of docs/comparison_job.md.

/// Lists of keys one after the other.
template <std::size_t n, std::size_t m>
[[nodiscard]] constexpr std::array<std::string_view, n + m> joined(const std::array<std::string_view, n>& first,
                                                                   const std::array<std::string_view, m>& second) {
    std::array<std::string_view, n + m> all{};
    for (std::size_t i = 0; i < n; ++i) {
        all[i] = first[i];
    }
    for (std::size_t i = 0; i < m; ++i) {
        all[n + i] = second[i];
    }
    return all;
}

/// Keys of both forms.
inline constexpr std::array<std::string_view, 11> k_common_comparison_keys{"$schema",
                                                                           "schema",
                                                                           "kind",
                                                                           "title",
                                                                           "notes",
                                                                           "coverage_probability",
                                                                           "organiser",
                                                                           "independent_sources",
                                                                           "different_sources",
                                                                           "certificate",
                                                                           "unit"};

inline constexpr std::array<std::string_view, 7> k_item_value_keys{
    "assigned_value", "sigma_pt", "delta_E", "homogeneity", "stability", "kernel_bandwidth", "reference_value"};
inline constexpr std::array<std::string_view, 3> k_item_name_keys{"id", "name", "unit"};
inline constexpr auto k_listed_item_keys = joined(k_item_name_keys, k_item_value_keys);

inline constexpr std::array<std::string_view, 9> k_laboratories_only_keys{
    "participants", "results", "items", "rounds", "correlations", "groups", "vectors", "youden", "names"};
inline constexpr auto k_laboratories_keys = joined(k_laboratories_only_keys, k_item_value_keys);

inline constexpr std::array<std::string_view, 6> k_methods_keys{"lab",         "reference", "position",
                                                                "correlation", "bias_line", "tolerance"};
inline constexpr auto k_comparison_keys = joined(joined(k_common_comparison_keys, k_laboratories_keys), k_methods_keys);

inline constexpr std::array<std::string_view, 4> k_participant_keys{"id", "name", "group", "cmc_U"};
/// Of a result, beside the key that says whose it is.
inline constexpr std::array<std::string_view, 14> k_result_value_keys{
    "item", "round", "value", "u", "U", "k", "nu", "s", "n", "contributes", "reason", "sources", "budget", "audited"};
inline constexpr std::array<std::string_view, 1> k_whose_keys{"participant"};
inline constexpr auto k_result_keys = joined(k_whose_keys, k_result_value_keys);
inline constexpr auto k_participant_result_keys = joined(k_participant_keys, k_result_value_keys);
/// What people write who do not say whether a number is u or U.
inline constexpr std::array<std::string_view, 1> k_bare_keys{"uncertainty"};
inline constexpr auto k_result_keys_and_bare = joined(k_result_keys, k_bare_keys);
inline constexpr auto k_participant_result_keys_and_bare = joined(k_participant_result_keys, k_bare_keys);
inline constexpr std::array<std::string_view, 2> k_source_keys{"source", "u"};
inline constexpr std::array<std::string_view, 5> k_audited_uncertainty_keys{"u", "U", "k", "nu", "finding"};
inline constexpr std::array<std::string_view, 1> k_comparison_file_keys{"file"};

inline constexpr std::array<std::string_view, 15> k_assigned_value_keys{
    "method",       "participant", "value",       "u",      "U",    "k",     "nu",   "sources",
    "traceability", "constants",   "uncertainty", "trials", "seed", "alpha", "power"};
inline constexpr std::array<std::string_view, 5> k_sigma_keys{"percent", "mass_fraction_per_unit", "reproducibility",
                                                              "repeatability", "replicates"};
inline constexpr std::array<std::string_view, 5> k_reference_value_keys{"value", "u", "U", "k", "nu"};
inline constexpr std::array<std::string_view, 4> k_vector_keys{"name", "items", "correlation", "reference_correlation"};

inline constexpr std::array<std::string_view, 8> k_side_keys{"name", "points", "covariance", "budget",
                                                             "job",  "of",     "cmc_U",      "audited"};
inline constexpr std::array<std::string_view, 9> k_point_keys{"point", "direction", "position", "value",   "u",
                                                              "U",     "k",         "nu",       "u_common"};
inline constexpr auto k_point_keys_and_bare = joined(k_point_keys, k_bare_keys);
inline constexpr std::array<std::string_view, 2> k_audited_factor_keys{"factor", "finding"};
inline constexpr std::array<std::string_view, 2> k_position_keys{"name", "unit"};

}  // namespace gumcert::jobs
