#include "gum/comparison/laboratory_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "gum/argument_check.h"
#include "gum/comparison/laboratory_covariance.h"
#include "gum/comparison/proficiency_scheme.h"
#include "gum/comparison/refusal_place.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

namespace {

std::string place_of(const ComparisonScheme& scheme, const ComparisonItem& item, const std::string& round) {
    std::string place = scheme.items.size() > 1 || !item.id.empty() ? "item \"" + item.id + "\"" : "item";
    return round.empty() ? place : place + ", round \"" + round + "\"";
}

/// The reference laboratory apart, those that are left out aside.
/// \throws InputError  GC-COMPARE-0106
void find_contributing(const ComparisonScheme& scheme, LaboratoryData& data) {
    const AssignedValueRequest& request = data.item->assigned_value;
    const bool by_reference = request.method == AssignedValueMethod::reference;
    for (std::size_t i = 0; i < data.size(); ++i) {
        if (by_reference && scheme.participants[data.results[i]->participant].id == request.participant) {
            data.reference = i;
        } else if (data.results[i]->contributes) {
            data.contributing.push_back(i);
        }
    }
    if (by_reference && (!data.reference || !data.has_u(*data.reference))) {
        refuse("GC-COMPARE-0106", data.where,
               "participant \"" + request.participant + "\" has no result" +
                   (data.reference ? " with an uncertainty" : ""),
               "the assigned value is the result of this participant", "State it, or take another assigned value.");
    }
}

}  // namespace

bool LaboratoryData::all_have_u(const std::vector<std::size_t>& positions) const {
    return std::all_of(positions.begin(), positions.end(), [&](std::size_t i) { return has_u(i); });
}

std::vector<std::size_t> LaboratoryData::with_u() const {
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < size(); ++i) {
        if (has_u(i)) {
            positions.push_back(i);
        }
    }
    return positions;
}

ItemUncertainty LaboratoryData::between_items() const {
    if (!item->homogeneity) {
        return {};
    }
    const HomogeneityCheck check = check_homogeneity(*item->homogeneity, 1.0);  // s_s does not depend on σ_pt
    return {.between = check.s_s, .degrees_of_freedom = check.degrees_of_freedom};
}

LaboratoryResults LaboratoryData::at(const std::vector<std::size_t>& positions) const {
    LaboratoryResults chosen;
    chosen.x = x(positions);
    chosen.u = u(positions);
    const auto degrees_at = [&](std::size_t i) {
        const std::optional<ResultUncertainty>& stated = results[i]->uncertainty;
        return stated ? stated->degrees_of_freedom : std::numeric_limits<double>::infinity();
    };
    if (std::any_of(positions.begin(), positions.end(), [&](std::size_t i) { return std::isfinite(degrees_at(i)); })) {
        chosen.degrees_of_freedom.resize(chosen.x.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            chosen.degrees_of_freedom[static_cast<Eigen::Index>(i)] = degrees_at(positions[i]);
        }
    }
    if (covariance.size() > 0) {
        chosen.covariance = covariance(positions, positions);
        const Eigen::MatrixXd variances = chosen.covariance.diagonal().asDiagonal();
        // Results that correlate only with others than these are independent of each other, so that the methods for
        // independent results stay open to them.
        if (chosen.covariance == variances) {
            chosen.covariance.resize(0, 0);
        }
    }
    return chosen;
}

Eigen::VectorXd LaboratoryData::values(const std::vector<std::size_t>& positions) const {
    return x(positions);
}

std::vector<LaboratoryData> laboratory_data(const ComparisonScheme& scheme,
                                            const std::vector<ParticipantResult>& results) {
    std::vector<LaboratoryData> all(scheme.items.size() * scheme.rounds.size());
    for (const ParticipantResult& result : results) {
        all[result.item * scheme.rounds.size() + result.round].results.push_back(&result);
    }
    for (std::size_t at = 0; at < all.size(); ++at) {
        LaboratoryData& data = all[at];
        data.item = &scheme.items[at / scheme.rounds.size()];
        data.item_position = at / scheme.rounds.size();
        data.round = at % scheme.rounds.size();
        data.where = place_of(scheme, *data.item, scheme.rounds[data.round]);
        // The order of a file must not decide the last digit of a sum, nor which of two equal subsets is reported.
        std::stable_sort(data.results.begin(), data.results.end(),
                         [](const auto* a, const auto* b) { return a->participant < b->participant; });
        data.x.resize(static_cast<Eigen::Index>(data.size()));
        data.u = Eigen::VectorXd::Zero(data.x.size());
        for (std::size_t i = 0; i < data.size(); ++i) {
            data.result_positions.push_back(static_cast<std::size_t>(data.results[i] - results.data()));
            data.x[static_cast<Eigen::Index>(i)] = data.results[i]->value;
            if (data.results[i]->uncertainty) {
                data.u[static_cast<Eigen::Index>(i)] = data.results[i]->uncertainty->u;
            }
        }
    }
    std::erase_if(all, [](const LaboratoryData& data) { return data.results.empty(); });
    return all;
}

void relate_results(const ComparisonScheme& scheme, LaboratoryData& data, std::vector<SharedSource>& shared) {
    find_contributing(scheme, data);
    data.covariance = laboratory_covariance(scheme, data, shared, data.ambiguous_sources);
    if (data.covariance.size() > 0) {
        at_place(data.where, [&] { require_results(data.at(data.with_u())); });
    }
}

}  // namespace gumcert::gum
