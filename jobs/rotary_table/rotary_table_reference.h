#pragma once

#include <optional>

#include "jobs/rotary_table/rotary_table_reading.h"

namespace gumcert::jobs {

/// Files of a reference method; nothing where one could not be read.
struct ReferenceFiles {
    std::optional<JobFiles::File> readings, description;
};

/// The key `reference_method` with its files, into the job.
/// \param reference  with keys_of<ReferenceStatement>(); the names of its files and of the method are read already
void read_reference(const RotaryTableReading& reading, const JsonObject& reference, ReferenceFiles&& files,
                    const MeasuredPlaces& places, const FileSource& source);

}  // namespace gumcert::jobs
