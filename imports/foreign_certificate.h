#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/dcc_reader.h"
#include "signing/signer.h"

namespace gumcert::imports {

/// Whom a reader of a certificate trusts, and what time it is.
struct CertificateTrust {
    std::optional<std::vector<signing::Bytes>> trusted;  ///< DER; none: nobody was named, a signer is only named
    /// Seconds since 1970-01-01 UTC. Without a clock no signature is one of the future.
    std::int64_t now = std::numeric_limits<std::int64_t>::max() / 2;
};

/// What somebody has to know of a digital certificate from elsewhere before its numbers are used: whether it is a draft
/// or a specimen (GC-DCC-0040), what its signature is worth (GC-DCC-0041 changed after signing, -0042 not to be relied
/// on, -0043 intact, but nobody said whom to trust, -0044 valid), how many rules it breaks (GC-DCC-0045).
[[nodiscard]] std::vector<gum::Diagnostic> reservations_on(const reports::ParsedDcc& document, const std::string& file,
                                                           const CertificateTrust& trust);

/// Use case of `gumcert check dcc FILE`: everything that is wrong with a digital certificate, or doubtful: what the
/// reader remarks, statements of uncertainty that cannot be used, the rules above the schema, draft, signature.
[[nodiscard]] std::vector<gum::Diagnostic> check_certificate(const reports::ParsedDcc& document,
                                                             const std::string& file, const CertificateTrust& trust);
/// \throws gum::InputError  as reports::read_dcc()
[[nodiscard]] std::vector<gum::Diagnostic> check_certificate(std::string_view bytes, const std::string& file,
                                                             const CertificateTrust& trust);

}  // namespace gumcert::imports
