#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/fuzz/unit_target.h"
#include "tests/support/case_count.h"
#include "tests/support/fuzz_corpus.h"

namespace gumcert::gum {
namespace {

/// Texts made of words of units and of damage, read by the program and by a reader written apart from it.
TEST(UnitReaders, AgreeOnRandomTexts) {
    const test::UnitOracle oracle;
    std::mt19937_64 random(14);
    std::size_t units = 0;
    const int texts = gumcert::test::cases(30'000, 100'000);
    for (int i = 0; i < texts; ++i) {
        std::string bytes(1, static_cast<char>(i % 50 == 0 ? 0x20 : 0x80));
        const std::size_t size = 1 + random() % 12;
        for (std::size_t k = 0; k < size; ++k) {
            bytes += static_cast<char>(random());
        }
        const std::string text = test::unit_text(bytes);
        ASSERT_EQ(test::difference_of_readers(oracle, text), "") << '"' << text << '"';
        units += oracle.read(text) ? 1U : 0U;
    }
    EXPECT_GT(units, static_cast<std::size_t>(texts / 20)) << "the texts must be units often enough";
}

/// Units as people write them, with every kind of exponent and sign: all are read, and alike.
TEST(UnitReaders, AgreeOnRandomUnits) {
    const test::UnitOracle oracle;
    std::mt19937_64 random(41);
    const std::vector<std::string> names{"m",   "um", "kg",   "V",   "nV", "Hz", "kHz",       "K", "degC", "arcsec",
                                         "psi", "ft", "mmHg", "ohm", "µm", "%",  "kilometre", "L", "min",  "dB"};
    const std::vector<std::string> exponents{"",    "",  "",   "2",      "-1",      "-2",     "^3",   "^-2",
                                             "**2", "²", "⁻¹", "^(1/2)", "^(-3/2)", "^(2/3)", "^(2)", "^(4/6)"};
    const std::vector<std::string> signs{" ", "*", ".", "·", " * ", "⋅"};
    const auto any = [&](const std::vector<std::string>& of) { return of[random() % of.size()]; };
    for (int i = 0; i < 20'000; ++i) {
        const auto factors = [&](std::size_t most) {
            std::string text = any(names) + any(exponents);
            for (std::size_t k = random() % most; k > 0; --k) {
                text += any(signs) + any(names) + any(exponents);
            }
            return text;
        };
        std::string text = (random() % 4 == 0 ? "1e-6 " : random() % 9 == 0 ? "10^3*" : "") + factors(4);
        if (random() % 2 == 0) {
            text += "/(" + factors(3) + ")" + (random() % 3 == 0 ? "^(1/2)" : "");
        } else if (random() % 2 == 0) {
            text += "/" + any(names) + any(exponents) + "/" + any(names);
        }
        ASSERT_EQ(test::difference_of_readers(oracle, text), "") << '"' << text << '"';
    }
}

TEST(UnitReaders, AgreeOnTheSeedsOfTheFuzzTarget) {
    const test::UnitOracle oracle;
    for (const std::string& seed : test::fuzz_corpus("unit")) {
        EXPECT_EQ(test::difference_of_readers(oracle, test::unit_text(seed)), "") << seed;
    }
}

}  // namespace
}  // namespace gumcert::gum
