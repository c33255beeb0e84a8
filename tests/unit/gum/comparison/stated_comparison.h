#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gum/comparison/comparison_scheme.h"
#include "gum/comparison/laboratory_data.h"

namespace gumcert::gum::test {

/// A comparison with its results, of one item until a test adds others.
struct StatedComparison {
    ComparisonScheme scheme;
    std::vector<ParticipantResult> results;

    ParticipantResult& add(const std::string& id, double value, std::optional<ResultUncertainty> uncertainty,
                           const std::string& group = "") {
        scheme.participants.push_back({.id = id, .name = id, .group = group, .cmc_U = std::nullopt});
        ParticipantResult& result = results.emplace_back();
        result.participant = scheme.participants.size() - 1;
        result.value = value;
        result.uncertainty = uncertainty;
        return result;
    }

    /// Of the first item, related. It points to what stands here.
    [[nodiscard]] LaboratoryData data() const& {
        LaboratoryData first = laboratory_data(scheme, results).front();
        std::vector<SharedSource> shared;
        relate_results(scheme, first, shared);
        return first;
    }
    LaboratoryData data() && = delete;
};

inline ResultUncertainty u_with_k_2(double u) {
    return stated_expanded(2.0 * u);
}

inline StatedComparison comparison_of(const std::vector<double>& x, const std::vector<double>& u) {
    StatedComparison comparison;
    ComparisonItem& item = comparison.scheme.items.emplace_back();
    item.id = "block";
    item.unit = Unit::parse("mm");
    for (std::size_t i = 0; i < x.size(); ++i) {
        comparison.add("L" + std::to_string(i + 1), x[i], u.empty() ? std::nullopt : std::optional(u_with_k_2(u[i])));
    }
    return comparison;
}

/// Cox 2002, Metrologia 39, 589-595: procedure A applied to five results.
inline StatedComparison five_results_of_cox() {
    return comparison_of({43772.0, 43910.0, 43947.0, 43910.0, 43900.0}, {97.0, 100.0, 104.5, 160.0, 280.0});
}

/// A key comparison with an inconsistent fifth laboratory.
inline StatedComparison key_comparison() {
    return comparison_of({12.31, 12.18, 12.42, 12.25, 12.95, 12.05}, {0.10, 0.15, 0.20, 0.12, 0.15, 0.30});
}

/// ISO 13528:2022, E.1: 18 results without uncertainties.
inline StatedComparison results_of_iso_13528_e1() {
    return comparison_of({12, 19, 20, 23, 23, 25, 25, 26, 28, 28, 28, 29, 30, 30, 31, 32, 32, 45}, {});
}

/// ISO 13528:2022, E.4: results with k = 2 against an assigned value, σ_pt and δ_E.
inline StatedComparison results_of_iso_13528_e4() {
    StatedComparison comparison = comparison_of({0.014, 0.017, 0.0424, 0.053}, {0.00025, 0.004, 0.004, 0.0035});
    ComparisonItem& item = comparison.scheme.items.front();
    item.unit = Unit::parse("1");
    item.assigned_value.method = AssignedValueMethod::given;
    item.assigned_value.value = 0.044;
    item.assigned_value.uncertainty = u_with_k_2(0.0041);
    item.sigma_pt.emplace().value = 0.0066;
    item.delta_E = 0.0198;
    return comparison;
}

}  // namespace gumcert::gum::test
