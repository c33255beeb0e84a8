#pragma once

#include "reports/record/evaluation_record.h"
#include "tests/support/sample_record.h"

#include <cstddef>
#include <string>

namespace gumcert::test {

/// "L007": laboratories of the samples are numbered so that their names are in order.
std::string laboratory_id(std::size_t i);

/// What a record of a comparison holds beside the comparison itself.
reports::EvaluationRecord comparison_frame(const std::string& title, const std::string& job);

/// Results of `laboratories` laboratories for one item. Every number is made up by a formula.
/// The fourth does not contribute, the fifth states no uncertainty, the sixth reports nothing.
void add_sample_item(reports::Comparison& c, const std::string& id, const std::string& round, std::size_t laboratories,
                     double value, double spread);

/// A comparison between laboratories with two items, so many laboratories, and every optional part somewhere.
reports::EvaluationRecord sample_laboratories_record(std::size_t laboratories = 9);

/// A method against a reference method: two directions named by the job and a bias line, every optional part somewhere.
reports::EvaluationRecord sample_methods_record(std::size_t points_of_direction = 12);

}  // namespace gumcert::test
