#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/evaluate_job.h"

// The law of differences of decimal numbers: what a laboratory subtracts by hand is printed, and decided on its limits, as
// exact decimal arithmetic says it (ISO/IEC 17025:2017, 7.8.6.1; docs/accuracy.md, "ties").

namespace gumcert::evaluation {
namespace {

using certificate::CertifiedValue;

/// A scale of an instrument: units, and how many decimals its numbers have. The difference, in the unit of the result, has
/// `decimals` decimals as well, of which the last one is not printed.
struct Scale {
    const char* unit;
    const char* result_unit;
    int decimals;          ///< of the numbers in `unit`
    int result_decimals;   ///< of the difference in `result_unit`
    std::int64_t largest;  ///< reference, in steps
    const char* U;         ///< in `unit`; its second digit stands one place above the last step
};

constexpr std::array<Scale, 6> k_scales = {{{"mm", "um", 5, 2, 10000000, "0.0024"},
                                            {"V", "V", 4, 4, 10000000, "0.024"},
                                            {"degC", "K", 2, 2, 60000, "2.4"},
                                            {"mm", "mm", 4, 4, 5000000, "0.024"},
                                            {"kPa", "Pa", 6, 3, 110000000, "0.00024"},
                                            {"ohm", "mohm", 4, 1, 1000000000, "0.024"}}};

/// "−12.0345" of −120345 steps with four decimals.
std::string decimal(std::int64_t steps, int decimals) {
    std::string digits = std::to_string(std::abs(steps));
    const auto places = static_cast<std::size_t>(decimals);
    if (digits.size() <= places) {
        digits.insert(0, places + 1 - digits.size(), '0');
    }
    digits.insert(digits.size() - places, decimals > 0 ? "." : "");
    return (steps < 0 ? "-" : "") + digits;
}

/// The last digit rounded off, a tie to the even digit.
std::string printed_without_last(std::int64_t steps, int decimals) {
    const std::int64_t size = std::abs(steps);
    const std::int64_t rest = size % 10;
    std::int64_t kept = size / 10;
    kept += rest > 5 || (rest == 5 && kept % 2 != 0) ? 1 : 0;
    return decimal(steps < 0 ? -kept : kept, decimals - 1);
}

struct Difference {
    std::int64_t reference, error;  ///< in steps
};

std::string job_of(const Scale& scale, const std::string& model) {
    return std::string(R"({"schema": "gumcert/job/1", "kind": "budget", "model": [")") + model + R"("], "inputs": {
        "s": {"unit": ")" +
           scale.unit + R"(", "U": )" + scale.U + R"(, "k": 2, "role": "reference"},
        "x": {"unit": ")" +
           scale.unit + R"(", "role": "indication", "constant": true}},
        "outputs": {"e": {"unit": ")" +
           scale.result_unit + R"(", "role": "error"}},
        "points": {"file": "points.csv"}, "certificate": "certificate.json"})";
}

std::string certificate_of(const Scale& scale, std::int64_t limit) {
    const std::string T = decimal(limit, scale.result_decimals);
    return std::string(R"({"status": "not_accredited", "number": "N-1", "languages": ["en"],
        "laboratory": {"name": "L", "address": {"city": "C", "country": "DE"}}, "customer": {"name": "K"},
        "annexes": "none", "item": {"description": "meter", "serial_number": "1"}, "method": {"identification": "V-1"},
        "specifications": [{"id": "a", "results": ["e"], "unit": ")") +
           scale.result_unit + R"(", "document": "D", "rule": {"id": "DR-01"}, "lower": -)" + T + R"(, "upper": )" + T +
           R"(}]})";
}

std::vector<CertifiedValue> evaluated(const Scale& scale, const std::vector<Difference>& differences,
                                      std::int64_t limit, const std::string& model = "e = x - s") {
    std::string table = "s,x\n";
    for (const Difference& d : differences) {
        table += decimal(d.reference, scale.decimals) + "," + decimal(d.reference + d.error, scale.decimals) + "\n";
    }
    const std::map<std::string, std::string> files = {
        {"job.json", job_of(scale, model)}, {"points.csv", table}, {"certificate.json", certificate_of(scale, limit)}};
    const reports::EvaluationRecord record = evaluate_job(jobs::MemoryFileSource(files), "job.json",
                                                          CovarianceFile::none, 1, GUMCERT_SOURCE_DIR "/templates")
                                                 .record;
    return record.certificate->tables.at(0).columns.at(0).values;
}

TEST(DecimalDifferences, ArePrintedAndDecidedAsExactArithmeticSays) {
    std::mt19937_64 random(20261129);
    const auto pick = [&](std::int64_t n) {
        return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
    };
    for (const Scale& scale : k_scales) {
        const std::int64_t limit = 10 * (3 + pick(60)) + 5;
        std::vector<Difference> differences;
        for (int i = 0; i < 150; ++i) {
            // Ties of printing, values on the limits and one step beside them, and any.
            const std::array<std::int64_t, 4> sizes = {10 * pick(100) + 5, limit, limit + pick(3) - 1, pick(2000)};
            const std::int64_t size = sizes.at(static_cast<std::size_t>(i % 4));
            differences.push_back({.reference = pick(scale.largest), .error = pick(2) == 0 ? size : -size});
        }
        const std::vector<CertifiedValue> values = evaluated(scale, differences, limit);
        ASSERT_EQ(values.size(), differences.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::string what = std::string(scale.unit) + ": " +
                                     decimal(differences[i].reference + differences[i].error, scale.decimals) + " − " +
                                     decimal(differences[i].reference, scale.decimals);
            std::string expected = printed_without_last(differences[i].error, scale.result_decimals);
            if (expected.find_first_of("123456789") == std::string::npos && expected.starts_with('-')) {
                expected.erase(0, 1);
            }
            EXPECT_EQ(values[i].value,
                      std::strtod(decimal(differences[i].error, scale.result_decimals).c_str(), nullptr))
                << what;
            EXPECT_EQ(values[i].printed_value, expected) << what;
            ASSERT_TRUE(values[i].verdict) << what;
            EXPECT_EQ(values[i].verdict->verdict, std::abs(differences[i].error) <= limit ? "pass" : "fail") << what;
        }
    }
}

TEST(DecimalDifferences, OfThreeMicrometresAreThreeMicrometres) {
    std::vector<Difference> differences;
    for (std::int64_t mm = 1; mm <= 10; ++mm) {
        differences.push_back({.reference = mm * 100000, .error = 300});
    }
    for (const CertifiedValue& value : evaluated(k_scales.front(), differences, 300)) {
        EXPECT_EQ(value.value, 3.0);
        EXPECT_EQ(value.verdict->verdict, "pass");
        EXPECT_EQ(value.verdict->verdict_from_printed, "pass");
    }
}

TEST(DecimalDifferences, KeepDigitsThatAreNoRounding) {
    // A third of a difference has no end in decimal numbers: nothing is cut off.
    const std::vector<CertifiedValue> values =
        evaluated(k_scales.at(1), {{.reference = 100000, .error = 100}}, 1000, "e = (x - s)/3");
    EXPECT_NEAR(values.at(0).value, 0.01 / 3.0, 1e-15);
    EXPECT_NE(values.at(0).value, 0.0033333);
}

}  // namespace
}  // namespace gumcert::evaluation
