#pragma once

#include <filesystem>

#include "app/certify.h"
#include "certificate/certificate_data.h"
#include "certificate/profile.h"
#include "gum/budget/evaluate_budget.h"
#include "jobs/budget/budget_job.h"

namespace gumcert::app {

/// The profile that certificate data ask for: one of their own, else templates/profiles/<id>.json.
/// \throws gum::InputError    GC-CERT-0300 where there is none of that id, GC-CERT-0301 where one of their own has
///                            the id of another one of the program, and those of jobs::parse_profile
/// \throws gum::StorageError  if the file cannot be read
[[nodiscard]] certificate::Profile certificate_profile(const certificate::CertificateData& data,
                                                       const std::filesystem::path& templates);

/// What the evaluation of a budget knows for its certificate: values of the inputs at every point, the distribution of
/// results whose k comes from a convolution, and the trials of those whose U comes from Monte Carlo.
/// \param threads  to draw trials again; 0: as many as the machine has
[[nodiscard]] CapabilityInputs capability_inputs(const jobs::BudgetJob& job, const gum::BudgetResult& result,
                                                 unsigned threads = 1);

}  // namespace gumcert::app
