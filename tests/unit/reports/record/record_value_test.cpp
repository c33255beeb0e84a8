#include "reports/record/record_value.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/record_refusal.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_comparison_record.h"
#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

json without_digest(const std::string& text) {
    json value = json::parse(text);
    value.erase("digest");
    return value;
}

TEST(RecordValue, IsThatOfTheCanonicalText) {
    for (const EvaluationRecord& record :
         {test::sample_record(), test::sample_budget_record(), test::sample_two_results_record(),
          test::sample_points_record(3), test::sample_laboratories_record(), test::sample_methods_record()}) {
        const std::string text = to_canonical_json(record);
        const ReadRecord read = read_record(text, "record.json");
        EXPECT_EQ(read.value, without_digest(text));
        EXPECT_EQ(to_json_value(record), without_digest(text));
        EXPECT_EQ(to_canonical_json(read.record), text);
        EXPECT_EQ(read.record.digest, record_from_json(text, "record.json").digest);
    }
}

TEST(RecordValue, RefusesWhatTheCanonicalTextRefuses) {
    EvaluationRecord record = test::sample_budget_record();
    record.results[0].value = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)to_json_value(record), gum::NoResultError);
    record = test::sample_budget_record();
    record.title = "\xff";
    EXPECT_THROW((void)to_json_value(record), gum::NoResultError);
    EXPECT_THROW((void)read_record("{}", "record.json"), gum::InputError);
}

}  // namespace
}  // namespace gumcert::reports
