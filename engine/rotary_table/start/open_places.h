#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/start/common_set_up.h"

namespace gumcert::engine {

/// Places that the distances leave open, where no stated position decides.
///
/// A direction n with n·u the same for every reflector and angle of a dead path: nothing tells how far along n the station
/// stands. All reflectors in one plane across the axis: every station has a mirror image that sees the same distances;
/// stated positions tell the sides apart, and a tilt of the fixture holds the stations together on one side.
///
/// \param found  stations and set-up are those of the other side where stated positions are nearer to it
/// \throws gum::NoResultError  GC-RANK-0001
void settle_open_places(const ObservedStations& observed, CommonFit& found);

/// All stations with the set-up that they share, the places that are open settled. What seems to be open at a false place is
/// looked for once more within reach of the table.
/// \param alone  one a station of the measurement, each on its own
/// \throws gum::NoResultError  as settle_open_places()
[[nodiscard]] CommonFit settled_places(const ObservedStations& observed, const std::vector<StationFit>& alone);

/// How much nearer to the stated positions all of them together stand in another place, [m]; nothing where no station is
/// stated whose two places are so far from each other that a position to some centimetres tells them apart.
/// \param found, other  one a station, in the frame of the stated positions, [m]
[[nodiscard]] std::optional<double> nearer_to_stated(const RotaryTableMeasurement& measurement,
                                                     const std::vector<Eigen::Vector3d>& found,
                                                     const std::vector<Eigen::Vector3d>& other);

/// "; the same holds for P2, P3": what a message says of the first of some stations, of the others; "" of one alone.
[[nodiscard]] std::string others_alike(const RotaryTableMeasurement& measurement,
                                       const std::vector<std::size_t>& stations);

/// What a table is to one that fits as well.
enum class RivalTable {
    same_distances,     ///< its mirror image, of reflectors in one plane
    nearly_mirrored,    ///< of reflectors nearly in one plane
    with_other_places,  ///< any other
    fitting_badly       ///< any, where neither fits as a table does
};

/// Of two tables that fit alike none is the result.
/// \param found, other  one a station, [m]
/// \throws gum::NoResultError  always, GC-RANK-0001 with the first station that stands elsewhere, both its places, and the others
[[noreturn]] void refuse_either(const RotaryTableMeasurement& measurement, const std::vector<Eigen::Vector3d>& found,
                                const std::vector<Eigen::Vector3d>& other, RivalTable rival);

}  // namespace gumcert::engine
