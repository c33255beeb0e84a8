#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "imports/foreign_certificate.h"

namespace gumcert::imports {

/// A digital certificate as the beginning of a budget.
struct ImportedJob {
    std::string job;                       ///< JSON text: a job of kind "budget" that can be evaluated at once
    std::vector<gum::Diagnostic> remarks;  ///< what could not be carried over, and what a person has to decide
    std::vector<std::size_t>
        quantities;         ///< of its inputs, in their order: in reports::ImportedCertificate::quantities
    bool negative = false;  ///< imported, and the answer is no: its signature cannot be relied on
};

/// Use case of `gumcert import dcc FILE`: every result of the certificate that has an uncertainty becomes an input
/// quantity, with value, U and k (or p), or u, as the certificate prints them, and with the certificate (number,
/// laboratory, SHA-256 of the file) as its source. Where no result has one, all results become constants. The model is
/// an example, y = the first input: the user writes his own.
/// \param bytes  content of the file
/// \param file   its name, for messages
///
/// A draft or a specimen, a signature and what it is worth, broken rules, and statements of uncertainty that cannot be
/// used (NaN, two that contradict each other, a k that its p cannot have) are remarked; the source of each input says
/// that it comes from a draft.
/// \throws gum::InputError  as reports::read_dcc(); GC-DCC-0030 if the certificate has no result that can be an input;
///                          GC-DCC-0041 if it was changed after it was signed
[[nodiscard]] ImportedJob import_certificate(std::string_view bytes, const std::string& file,
                                             const CertificateTrust& trust = {});

}  // namespace gumcert::imports
