#include "audit/words/certificate_in.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(CertificateIn, IsNamedByItsNumber) {
    EXPECT_EQ(certificate_in("U = 1.5 µV, k = 2; certificate 91-E; 39 µV/K"), "certificate 91-E");
    EXPECT_EQ(certificate_in("Kalibrierschein 4711-D-K-2025"), "Kalibrierschein 4711-D-K-2025");
    EXPECT_EQ(certificate_in("cert. No. 12, 2024"), "certificate No. 12");
    for (const char* const text : {"", "certificate", "certificate of the maker, 2024", "see the certificate"}) {
        EXPECT_EQ(certificate_in(text), "") << text;
    }
}

}  // namespace
}  // namespace gumcert::audit
