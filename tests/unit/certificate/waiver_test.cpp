#include "certificate/waiver.h"

#include <gtest/gtest.h>

namespace gumcert::certificate {
namespace {

Waiver complete() {
    return {.finding = "U10",
            .where = {},
            .by = "Head of laboratory",
            .date = "2026-11-20",
            .reason = "The maker states the specification as a standard uncertainty, in writing."};
}

TEST(Waiver, HasEffectWithPersonReasonAndDate) {
    EXPECT_TRUE(has_effect(complete(), ""));
    EXPECT_TRUE(has_effect(complete(), "2026-11-20"));
}

TEST(Waiver, HasNoneWithoutAnyOfThem) {
    Waiver nobody = complete();
    nobody.by = "N.N.";
    Waiver no_reason = complete();
    no_reason.reason = "accepted";
    Waiver undated = complete();
    undated.date.clear();
    EXPECT_FALSE(has_effect(nobody, ""));
    EXPECT_FALSE(has_effect(no_reason, ""));
    EXPECT_FALSE(has_effect(undated, ""));
    EXPECT_FALSE(has_effect(complete(), "2026-11-19")) << "the certificate is older";
}

}  // namespace
}  // namespace gumcert::certificate
