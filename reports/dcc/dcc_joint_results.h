#pragma once

#include "reports/dcc/dcc_writer.h"

namespace gumcert::reports {

/// The covariance of the results, unrounded: as a matrix of D-SI for up to 50 quantities, else as a CSV file inside of
/// the document; a sentence where the record keeps it in a file of its own; nothing where there is none.
void write_joint_results(DccWriter& writer);

}  // namespace gumcert::reports
