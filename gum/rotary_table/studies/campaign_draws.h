#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/rotary_table/studies/campaign_simulation.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/rotary_table/studies/simulation_request.h"

namespace gumcert::gum {

/// Draws truth and noise of the campaigns of one layout. Run `r` is the same whoever asks for it, and when.
///
/// Truth: error motions uniform within ± their amplitudes, independent at every angle and zero at home; the set-up as
/// requested; stations within ±10 mm of their start values; dead paths 0.15 m … 0.25 m. With noise also: fixture,
/// scales, temperatures and expansion by their stated uncertainties about their stated values; the table of every
/// visit by its repeatability; length noise, resolution and outliers.
class CampaignDraws {
public:
    /// \param layout    with lengths and a position of every station, as its start value
    /// \param table     repeatability of the simulated table
    /// \param stream    number of the study: different numbers give independent campaigns
    CampaignDraws(const engine::RotaryTableMeasurement& layout, const SimulationRequest& request,
                  const engine::TableRepeatability& table, std::uint64_t seed, std::uint64_t stream);

    struct Campaign {
        engine::RotaryTableMeasurement measurement;
        engine::CampaignTruth truth;
        std::vector<std::size_t> planted;  ///< indices of lengths with an outlier, ascending
    };
    /// The truth without what noise adds to it.
    [[nodiscard]] engine::CampaignTruth exact_truth(std::uint64_t run) const;
    [[nodiscard]] Campaign campaign(std::uint64_t run, bool with_noise) const;

private:
    [[nodiscard]] Eigen::VectorXd draw(std::size_t group, std::uint64_t run) const;

    engine::RotaryTableMeasurement layout_;
    SimulationRequest request_;
    engine::TableRepeatability table_;
    std::vector<InputDraws> draws_;  ///< one a group, so that a group can be drawn alone
    std::size_t visits_ = 0;
};

}  // namespace gumcert::gum
