#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace gumcert::signing {

/// An algorithm of the allow-list: its identifier in XML, and its name for people and for OpenSSL.
struct Algorithm {
    std::string_view identifier;
    const char* name;
};
inline constexpr std::array<Algorithm, 3> k_canonicalisations = {
    {{"http://www.w3.org/2001/10/xml-exc-c14n#", "exclusive"},
     {"http://www.w3.org/2006/12/xml-c14n11", "1.1"},
     {"http://www.w3.org/TR/2001/REC-xml-c14n-20010315", "1.0"}}};
inline constexpr std::array<Algorithm, 3> k_digests = {{{"http://www.w3.org/2001/04/xmlenc#sha256", "SHA2-256"},
                                                        {"http://www.w3.org/2001/04/xmldsig-more#sha384", "SHA2-384"},
                                                        {"http://www.w3.org/2001/04/xmlenc#sha512", "SHA2-512"}}};
inline constexpr std::array<Algorithm, 6> k_methods = {
    {{"http://www.w3.org/2001/04/xmldsig-more#rsa-sha256", "RSA with SHA-256"},
     {"http://www.w3.org/2001/04/xmldsig-more#rsa-sha384", "RSA with SHA-384"},
     {"http://www.w3.org/2001/04/xmldsig-more#rsa-sha512", "RSA with SHA-512"},
     {"http://www.w3.org/2001/04/xmldsig-more#ecdsa-sha256", "ECDSA with SHA-256"},
     {"http://www.w3.org/2001/04/xmldsig-more#ecdsa-sha384", "ECDSA with SHA-384"},
     {"http://www.w3.org/2001/04/xmldsig-more#ecdsa-sha512", "ECDSA with SHA-512"}}};

/// Name of an algorithm of a list; nullptr where it is none of them.
template <std::size_t Count>
const char* allowed(const std::array<Algorithm, Count>& list, const std::string& identifier) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Algorithm& a) { return a.identifier == identifier; });
    return found == list.end() ? nullptr : found->name;
}

}  // namespace gumcert::signing
