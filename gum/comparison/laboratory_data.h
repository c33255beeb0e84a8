#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gum/comparison/comparison_scheme.h"
#include "gum/comparison/reference_value.h"

namespace gumcert::gum {

/// A covariance of two results that was computed from a source that both name.
struct SharedSource {
    std::string source;
    std::size_t first = 0, second = 0;  ///< positions of the participants
    double covariance = 0.0;            ///< in the square of the unit of the item
    double correlation = 0.0;
};

/// Results of one item in one round, as they are evaluated: those that have a value, in the order of the participants.
/// Positions count in `results`.
struct LaboratoryData {
    const ComparisonItem* item = nullptr;
    std::size_t item_position = 0, round = 0;       ///< in the scheme
    std::string where;                              ///< item and round, for messages
    std::vector<const ParticipantResult*> results;  ///< n
    std::vector<std::size_t> result_positions;      ///< n, of them in the list of all results
    Eigen::VectorXd x, u;                           ///< n, in the unit of the item; u is 0 where none is stated
    Eigen::MatrixXd covariance;                     ///< n×n; empty: nothing correlates
    std::set<std::string> ambiguous_sources;        ///< shared in more than one way, see SourceCovariance
    /// Results that a consensus is made of, ascending. That of a reference laboratory is not among them.
    std::vector<std::size_t> contributing;
    std::optional<std::size_t> reference;  ///< result of the reference laboratory

    [[nodiscard]] std::size_t size() const { return results.size(); }
    [[nodiscard]] bool has_u(std::size_t i) const { return u[static_cast<Eigen::Index>(i)] > 0.0; }
    [[nodiscard]] std::vector<std::size_t> with_u() const;
    [[nodiscard]] bool all_have_u(const std::vector<std::size_t>& positions) const;
    /// Those at some positions, for gum; their covariance only where something correlates.
    [[nodiscard]] LaboratoryResults at(const std::vector<std::size_t>& positions) const;
    /// What the check of homogeneity says of the items, which needs no limit; 0 without one.
    [[nodiscard]] ItemUncertainty between_items() const;
    [[nodiscard]] Eigen::VectorXd values(const std::vector<std::size_t>& positions) const;
};

/// The results item by item and round by round; rounds in which nobody measured an item are left out.
[[nodiscard]] std::vector<LaboratoryData> laboratory_data(const ComparisonScheme& scheme,
                                                          const std::vector<ParticipantResult>& results);

/// Finds who contributes to the assigned value of one item, who is its reference, and what its results have in common.
/// \param shared  receives what was found in the sources that several results name, each pair of participants once
/// \throws InputError  GC-COMPARE-0103 too many correlated results, -0106 no result of the reference laboratory; those
///                     of gum for a covariance that is none
void relate_results(const ComparisonScheme& scheme, LaboratoryData& data, std::vector<SharedSource>& shared);

}  // namespace gumcert::gum
