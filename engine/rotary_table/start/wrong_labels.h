#pragma once

#include <cstddef>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/robust_descent.h"

namespace gumcert::engine {

/// Distances of stations that no position explains are tried with other labels: the table turning the other way or about
/// another coordinate, two reflectors interchanged, lengths of the other sign or counted twice, a fixture in another unit,
/// angles that are gon or steps of another size, a scale of their own, passes from two places; in a part of the visits of a
/// station too, where the others tell its place; and all stations without one reflector, whose coordinates are wrong. What
/// makes the misfit vanish is told.
///
/// It is asked twice of one measurement, and does not try again what the first question has tried for nothing.
class WrongLabels {
public:
    /// \param measurement  must outlive this
    /// \param alone        one a station of the measurement, each on its own
    WrongLabels(const RotaryTableMeasurement& measurement, std::vector<StationFit> alone);

    /// \throws gum::NoResultError  GC-ADJUST-0013, GC-GEOMETRY-0007 for the axis; nothing is thrown where there is none
    void refuse_suspicious();

    /// To be asked before a measurement is refused for its layout: lengths of a station in another unit may fit a false
    /// place, of which the layout seems to leave a direction open. The same labels are tried for every station, and whether
    /// the angles of one are those of the others but for an offset.
    /// \throws gum::NoResultError  as refuse_suspicious()
    void refuse_all();

private:
    /// Which stations are asked. All: of a measurement that has no result, for which lengths in another unit may fit a
    /// false place.
    enum class Asked { suspicious, all };
    void refuse(Asked asked);
    void look_closer();

    const RotaryTableMeasurement& measurement_;
    std::vector<StationFit> fits_;
    std::vector<double> misfits_;     ///< of fits_, [m]
    bool looked_closer_ = false;      ///< fits_ are those of a closer search where the neighbours ask for it
    bool tried_visits_ = false;       ///< no station has wrong labels at some of its visits, and no coordinate is wrong
    std::vector<bool> tried_labels_;  ///< one a station: none of all labels explains it, and no factor
    std::vector<bool> tried_two_places_;  ///< one a station: its passes are not from two places
};

}  // namespace gumcert::engine
