#pragma once

#include <libxml/tree.h>

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "signing/signer.h"
#include "signing/signer_chain.h"

namespace gumcert::signing {

// An enveloped signature leaves itself out of what it covers, so anything could have been put there later. What may stand there is a
// list of elements and attributes, and each value is what its element says.

/// The parts within a signature that it covers nevertheless: SignedInfo and the signed properties, nullptr without.
using CoveredParts = std::array<const xmlNode*, 2>;

/// The declarations of namespaces that an element or an attribute bears. Exclusive canonical XML leaves the others out, so that they
/// are covered by no signature that is made with it.
using UsedNamespaces = std::set<const xmlNs*>;
[[nodiscard]] UsedNamespaces used_namespaces(const std::vector<xmlNode*>& elements);

/// The first element, attribute, namespace, text, comment or processing instruction that is none of a signature's, in words. Comments
/// and processing instructions canonical XML may leave out of what is covered, too.
/// \param element  the signature
/// \return "" if there is none
[[nodiscard]] std::string foreign_part(const xmlNode* element, const CoveredParts& covered, const UsedNamespaces& used);

/// The first value that is not what its element says, in words: Base64 that does not decode, or to something else than a certificate,
/// a list of revoked certificates by an issuer of the signer, a time stamp, the signer's key; a name of none of the certificates.
/// \return "" if there is none
[[nodiscard]] std::string foreign_value(const xmlNode* signature, const CoveredParts& covered,
                                        const SignerChain& chain);

/// Names, numbers and digests of certificates for whose content nobody vouches, each once: they are told as not covered.
[[nodiscard]] std::vector<std::string> unproven_values(const xmlNode* signature, const CoveredParts& covered,
                                                       const SignerChain& chain);

/// How many lists of revoked certificates stand in a signature: nobody asks them, and what they say is not covered.
[[nodiscard]] std::size_t revocation_lists_in(const xmlNode* signature, const CoveredParts& covered);

/// Certificates of the elements of one name within a signature; those that are none are told by foreign_value().
/// \param bytes  DER, as they stand in the document
void certificates_in(const xmlNode* signature, const CoveredParts& covered, const char* name_space, const char* name,
                     std::vector<CertificateHandle>& certificates, std::vector<Bytes>& bytes);

/// Identifiers within a signature that it does not cover, each once.
[[nodiscard]] std::vector<std::string> identifiers_in(const xmlNode* signature, const CoveredParts& covered);

/// Whether a value is an identifier or an address, and not a sentence.
[[nodiscard]] bool is_plain_value(std::string_view value);

/// Whether an element is another one, or stands in it.
[[nodiscard]] bool is_inside(const xmlNode* element, const xmlNode* of);

/// "xmlns:si=https://ptb.de/si".
[[nodiscard]] std::string shown_namespace(const xmlNs* declared);

}  // namespace gumcert::signing
