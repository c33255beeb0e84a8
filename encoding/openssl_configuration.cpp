#include "encoding/openssl_configuration.h"

#include <openssl/crypto.h>

namespace gumcert::encoding {

void read_no_configuration_of_openssl() {
    (void)OPENSSL_init_crypto(OPENSSL_INIT_NO_LOAD_CONFIG, nullptr);
}

}  // namespace gumcert::encoding
