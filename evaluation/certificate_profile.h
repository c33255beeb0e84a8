#pragma once

#include <filesystem>

#include "certificate/certificate_data.h"
#include "certificate/profile.h"

namespace gumcert::evaluation {

/// The profile that certificate data ask for: one of their own, else templates/profiles/<id>.json.
/// \throws gum::InputError    GC-CERT-0300 where there is none of that id, GC-CERT-0301 where one of their own has
///                            the id of another one of the program, GC-CERT-0302 where it has terms of its own, and those of
///                            jobs::parse_profile
/// \throws gum::StorageError  if the file cannot be read
[[nodiscard]] certificate::Profile certificate_profile(const certificate::CertificateData& data,
                                                       const std::filesystem::path& templates);

}  // namespace gumcert::evaluation
