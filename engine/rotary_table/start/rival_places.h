#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "engine/rotary_table/start/common_set_up.h"

namespace gumcert::engine {

/// The mirror image of a table at a plane across its axis: with the fixture turned so that its reflectors come to their own mirror
/// images, all stations stand on the other side. Where the reflectors lie in one plane it has the same distances exactly, near one
/// it has them nearly; whether the difference is noise is left to the adjustment, in which the table errs as it likes. It is
/// the very image: no search can miss it, nor slide from it along what distances leave open.
/// \return nothing where the reflectors are that far from one plane that it fits no distances
[[nodiscard]] std::optional<CommonFit> mirrored_table(const ObservedStations& observed, const CommonFit& found);

/// One station after the other is taken to the other side of the plane of the points that it saw, with the set-up that then fits
/// all, as long as less is left: a station on the false side draws the set-up with it, so that at the false set-up each of them
/// looks right.
[[nodiscard]] CommonFit fit_by_turns(const ObservedStations& observed, CommonFit from);

/// Whether a station stands in another place, with whatever set-up.
[[nodiscard]] bool stands_elsewhere(const std::vector<Eigen::Vector3d>& one, const std::vector<Eigen::Vector3d>& other);

}  // namespace gumcert::engine
