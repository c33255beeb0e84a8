#pragma once

#include "jobs/rotary_table/rotary_table_reading.h"

namespace gumcert::jobs {

/// The key `fixture`, but for its files.
/// \param fixture  with keys_of<FixtureStatement>()
void read_fixture_statement(const RotaryTableReading& reading, const JsonObject& fixture, bool has_environment);

/// The coordinates file, and the covariance that follows from it.
[[nodiscard]] FixtureNames read_fixture(const RotaryTableReading& reading, JobFiles::File&& file);

/// The covariance file, in place of the covariance from the coordinates file.
void read_fixture_covariance(const RotaryTableReading& reading, const FixtureNames& names, const JobFiles::File& file);

/// The budget job of the fixture with all its files, where there is one; its problems are told with the others.
void read_fixture_budget(const RotaryTableReading& reading, const FixtureNames& names, const FileSource& source);

}  // namespace gumcert::jobs
