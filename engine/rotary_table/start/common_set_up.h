#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/rotary_table/start/robust_descent.h"

namespace gumcert::engine {

/// All stations with the one set-up of the fixture that they share.
struct CommonFit {
    Eigen::Vector4d set_up = Eigen::Vector4d::Zero();  ///< (O, O, S, S) of ObservedStations
    std::vector<StationFit> stations;                  ///< one a station of the measurement; their `set_up` is not used
};

/// From where each station was found on its own, all by one descent. With one set-up for all, a station on the wrong side
/// stands out, and is looked for again.
/// \param alone  one a station of the measurement
[[nodiscard]] CommonFit fit_together(const ObservedStations& observed, std::vector<StationFit> alone);

/// From all sides and by the strong prior: distances that hardly tell where a station stands, as of few reflectors with a dead
/// path of each, lead one that is found on its own kilometres away, or to a false place of which there seem to be two.
[[nodiscard]] CommonFit fit_within_reach(const ObservedStations& observed);

/// Whether another set-up has the same distances, because all reflectors lie in one plane, as three always do: the mirror image of
/// the table at a plane across its axis has them, with stations on the other side, and what lies in a plane comes to its mirror
/// image by a turn. The axis is there, in the fixture, the present one turned about the normal of the plane by 180°; where it is
/// more than 10° beside its coordinate, that is no set-up that anybody has. Exact, and not looked for: no descent can miss it.
[[nodiscard]] bool has_mirrored_table(const ObservedStations& observed, const Eigen::Vector4d& set_up);

/// All stations by the strong prior from the other sides of the planes of their points.
/// \param known  from the same set-up; else from the one of which nothing is known: each may lead back
[[nodiscard]] CommonFit fit_on_other_side(const ObservedStations& observed, const CommonFit& from, bool known);

/// Whether all stations fit on the other sides of the planes of their points as well, with another set-up: then distances do
/// not tell which of both is the table.
/// \param within  of `fit_within_reach`
[[nodiscard]] bool has_other_side(const ObservedStations& observed, const CommonFit& within);

}  // namespace gumcert::engine
