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

}  // namespace gumcert::engine
