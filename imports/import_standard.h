#pragma once

#include <string>
#include <string_view>

#include "imports/foreign_certificate.h"
#include "imports/import_certificate.h"

namespace gumcert::imports {

/// Use case of `gumcert import dcc FILE --standard ID`: a digital certificate as a file of the register of a laboratory
/// (docs/laboratory.md), with one calibration and a line for every result that has an uncertainty. Its quantities have the
/// names that import_certificate() gives to inputs; the rows of a table are lines of one quantity with the nominal value of the row
/// (else the value of the reference), where these differ. No quantity has lines of two tables: where several tables have a
/// quantity, it is called by its table in each of them, and `range` is the heading of the table. Results before an adjustment are left out, and told (GC-LAB-0022).
/// Values of the reference in place of nominal values are told (GC-LAB-0023).
///
/// The file has no `drift`: that is not on a certificate, and the reader of the register refuses it until the laboratory
/// has stated one.
/// \param id  of the standard
/// \return `job` is the text of the file
/// \throws gum::InputError  as import_certificate()
[[nodiscard]] ImportedJob import_standard(std::string_view bytes, const std::string& file, const std::string& id,
                                          const CertificateTrust& trust = {});

}  // namespace gumcert::imports
