#pragma once

#include "certificate/certified_results.h"
#include "certificate/point_tables.h"
#include "reports/document_text.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// The word for a role, a stage or a usual name of a column (range, function, remark, limits); the name itself for any other.
[[nodiscard]] Text word_of_column(const std::string& name, const Wording& words);

/// Heading of a column of words or numbers of points: its own, else that of its role, else its name.
[[nodiscard]] Text heading_of(const certificate::PointColumn& column, const Wording& words);

/// Heading of a column that shows a value of a result, or of the points, in a table with a layout: its own, else that of
/// its role. Where another column of the same stage has the same role, the description or the name tells them apart:
/// two errors are "error, rising" and "error, falling", not "error" twice. Tables, plots and the captions of parts of a
/// table take it from here.
[[nodiscard]] Text heading_of_shown(const certificate::CertifiedTable& table, const certificate::ShownColumn& shown,
                                    const Wording& words);

/// What a point is called by (certificate/point_names.h), with the decimal sign of the language in numbers that have a unit.
[[nodiscard]] Text point_in_words(const std::string& name, const Wording& words);

}  // namespace gumcert::reports
