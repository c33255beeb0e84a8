#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/common_set_up.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// What is asked of the distances of one measurement before its adjustment, and where it has no result. Every question
/// begins with the places of the stations, some go on with all labels that the file may have wrong: a question does not look
/// again for what an earlier one has found, nor for what it has not found. The answers are those of each question alone.
class StartSearch {
public:
    /// \param measurement  must outlive this
    explicit StartSearch(const RotaryTableMeasurement& measurement);
    StartSearch(const StartSearch&) = delete;
    StartSearch& operator=(const StartSearch&) = delete;
    ~StartSearch();

    /// find_gross_errors() of the measurement.
    [[nodiscard]] const std::vector<std::size_t>& gross_errors();
    /// The places of the stations of which find_start_values() makes the start values of the measurement.
    /// \param active  one flag a length: false = left out
    [[nodiscard]] CommonFit places(const std::vector<bool>& active);
    /// To be asked before a measurement is refused for its layout.
    /// \throws gum::NoResultError  GC-ADJUST-0015 where a station fits no place: no_rigid_table()
    void refuse_no_rigid_table() const;
    /// To be asked of a measurement that has no result.
    /// \throws gum::NoResultError  GC-ADJUST-0013, GC-GEOMETRY-0007: WrongLabels::refuse_all()
    void refuse_wrong_labels();
    /// refuse_interrupted_beams() of the measurement.
    void refuse_interrupted_beams();

private:
    struct Found;
    std::unique_ptr<Found> found_;
};

/// What is said of distances that agree when they are multiplied by a factor: GC-ADJUST-0013.
/// \param station  its name; "" of all distances
[[nodiscard]] gum::Diagnostic factor_on_distances(const RotaryTableMeasurement& measurement, double factor,
                                                  const std::string& station);

}  // namespace gumcert::engine
