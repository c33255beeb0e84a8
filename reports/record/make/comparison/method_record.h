#pragma once

#include <string>

#include "gum/comparison/method_comparison.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Compares a method with a reference method, and fills `points`, `summary` and the remarks that follow from the numbers;
/// the rest of the record is the caller's.
/// \param unit  as the record writes it; D and U are printed in it
/// \throws InputError, NoResultError  those of gum::compare_methods()
void add_method_comparison(const gum::MethodComparison& comparison, const std::string& unit,
                           reports::Comparison& record);

}  // namespace gumcert::reports
