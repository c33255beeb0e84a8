#pragma once

namespace gumcert::encoding {

/// Leaves out the configuration file of OpenSSL (OPENSSL_CONF, openssl.cnf): it can take digests and algorithms away, or put others
/// in their place, and what a file is said to be would depend on the machine. Before anything else is asked of OpenSSL.
void read_no_configuration_of_openssl();

}  // namespace gumcert::encoding
