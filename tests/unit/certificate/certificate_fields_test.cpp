#include "certificate/certificate_fields.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/certificate_keys.h"

namespace gumcert::certificate {
namespace {

using test::described_objects;
using test::DescribedKey;

const DescribedKey& described_key(const test::DescribedObjects& objects, const std::string& object,
                                  const std::string& name) {
    for (const DescribedKey& key : objects.at(object)) {
        if (key.name == name) {
            return key;
        }
    }
    throw std::out_of_range(object + "/" + name);
}

TEST(CertificateFields, NameEachKeyOfAnObjectOnce) {
    for (const auto& [pointer, keys] : described_objects<Certificate>()) {
        std::set<std::string> names;
        for (const DescribedKey& key : keys) {
            EXPECT_TRUE(names.insert(key.name).second) << pointer << "/" << key.name;
        }
        EXPECT_FALSE(keys.empty()) << pointer;
    }
}

TEST(CertificateFields, SayTheFormOfWhatTheyHold) {
    const test::DescribedObjects objects = described_objects<CertificateData>();
    EXPECT_EQ(described_key(objects, "/dates", "issued").form, TextForm::date);
    EXPECT_EQ(described_key(objects, "/customer/address", "country").form, TextForm::country);
    EXPECT_EQ(described_key(objects, "/accreditation/scope/*/capability", "coverage_probability").number,
              NumberRule::probability);
    EXPECT_EQ(described_key(objects, "/accreditation/scope/*/capability", "form").words,
              (std::vector<std::string>{"value", "range", "function", "table", "matrix"}));
    EXPECT_TRUE(described_key(objects, "", "accreditation").optional);
    EXPECT_EQ(described_key(objects, "/accreditation/scope/*/capability", "matrix").lists, 2);
    EXPECT_TRUE(described_key(objects, "/accreditation", "symbol_sha256").filled) << "by the program";
    EXPECT_TRUE(described_key(objects, "/laboratory", "logo_base64").filled) << "by the program";
}

TEST(CertificateFields, NameSeveritiesInTheirOrder) {
    EXPECT_EQ(described_key(described_objects<Certificate>(), "/findings/*", "severity").words,
              (std::vector<std::string>{"information", "minor", "major", "critical"}));
}

}  // namespace
}  // namespace gumcert::certificate
