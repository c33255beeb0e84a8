#pragma once

#include <cstddef>
#include <string>

#include "tests/support/sample_record.h"

namespace gumcert::test {

using reports::Environment;
using reports::GroupTestRow;
using reports::GroupTestSummary;
using reports::HarmonicOrder;
using reports::HarmonicRow;
using reports::StationEnvironment;

GroupTestRow sample_group_test(const std::string& kind, bool suspicious);

HarmonicRow harmonics_of(const std::string& name, const std::string& unit);

Environment two_stations();

/// A sample record with everything that a rotary table has beside its results.
reports::EvaluationRecord record_with_evidence();

}  // namespace gumcert::test
