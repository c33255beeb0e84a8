#include "jobs/circle_closure/circle_closure_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"
#include "tests/support/job_schema.h"

namespace gumcert::jobs {
namespace {

using nlohmann::json;

/// Readings of positions 0, 1 … at all steps of a circle.
std::string readings(std::size_t steps, std::size_t positions, bool closing = false) {
    std::string csv = "position,step,reading\n";
    for (std::size_t k = 0; k < positions; ++k) {
        for (std::size_t j = 0; j < steps + (closing ? 1 : 0); ++j) {
            csv += std::to_string(k) + "," + std::to_string(j) + "," +
                   std::to_string(0.1 * static_cast<double>((7 * j + 3 * k) % 11)) + "\n";
        }
    }
    return csv;
}

std::string job_text(const std::string& more) {
    return R"({"schema": "gumcert/job/1", "kind": "circle_closure", "readings": "r.csv")" + more + "}";
}

const std::string k_four = R"(, "steps": 4, "numbering": "with")";

CircleClosureJob read(const std::string& more, const std::string& csv) {
    return read_circle_closure_job(MemoryFileSource({{"job.json", job_text(more)}, {"r.csv", csv}}), "job.json");
}

std::vector<gum::Diagnostic> refusals(const std::string& more, const std::string& csv) {
    try {
        (void)read(more, csv);
    } catch (const gum::InputError& error) {
        return error.diagnostics();
    }
    return {};
}

std::vector<std::string> codes(const std::string& more, const std::string& csv) {
    std::vector<std::string> all;
    for (const gum::Diagnostic& diagnostic : refusals(more, csv)) {
        all.push_back(diagnostic.code);
    }
    return all;
}

TEST(CircleClosureJob, IsReadInSi) {
    const CircleClosureJob job =
        read(R"(, "steps": 4, "numbering": "against", "sense": "negative", "unit": "arcsec", "axis": "B",
                 "first_angle_deg": 10, "artefact": "polygon", "drift": "linear", "coverage_probability": 0.99,
                 "repeatability": {"u": 0.2, "nu": 30, "use": "stated", "source": "log"},
                 "effects": [{"name": "scale", "acts_on": "scale", "value": 1e-3, "U": 4e-4, "k": 2, "source": "AC"},
                             {"name": "steps", "acts_on": "step", "unit": "urad", "half_width": 3, "nu": 8}])",
             readings(4, 3, true));
    const engine::CircleClosureMeasurement& m = job.measurement;
    EXPECT_EQ(m.steps, 4U);
    EXPECT_TRUE(m.against && m.removes_drift && m.uses_stated_u);
    EXPECT_EQ(m.sense, -1.0);
    EXPECT_EQ(*job.axis, 'B');
    EXPECT_EQ(job.step_angle_deg(1), 100.0);
    EXPECT_EQ(job.side_angle_deg(1), 90.0);
    EXPECT_EQ(m.series.size(), 3U);
    ASSERT_EQ(m.readings.size(), 15U);
    EXPECT_EQ(m.readings[6].series, 1U);
    EXPECT_EQ(m.readings[6].step, 1U);
    EXPECT_NEAR(m.readings[6].value, 1.0 * gum::k_arcsecond, 1e-18);
    EXPECT_NEAR(*m.stated_u, 0.2 * gum::k_arcsecond, 1e-18);
    EXPECT_EQ(m.stated_degrees_of_freedom, 30.0);
    ASSERT_EQ(m.effects.size(), 2U);
    EXPECT_EQ(m.effects[0].value, 1e-3);
    EXPECT_NEAR(m.effects[0].u, 2e-4, 1e-18);
    EXPECT_EQ(m.effects[0].source, "AC");
    EXPECT_NEAR(m.effects[1].u, 3e-6 / std::sqrt(3.0), 1e-18);
    EXPECT_EQ(job.coverage_probability, 0.99);
    EXPECT_EQ(job.readings_as_stated.at(1), "0.700000");
    EXPECT_THAT(job.files, testing::ElementsAre("job.json", "r.csv"));
}

TEST(CircleClosureJob, RepetitionsAreSeriesOfTheirOwn) {
    const CircleClosureJob job = read(k_four,
                                      "position,step,reading,repetition\n0,0,1,a\n0,1,2,a\n0,2,3,a\n0,3,4,a\n0,0,1,b\n"
                                      "0,1,2,b\n0,2,3,b\n0,3,4,b\n1,0,1,\n1,1,2,\n1,2,3,\n1,3,9,\n");
    ASSERT_EQ(job.measurement.series.size(), 3U);
    EXPECT_EQ(job.measurement.series[1].repetition, "b");
    EXPECT_EQ(job.measurement.series[2].repetition, "");
}

TEST(CircleClosureJob, RefusesWhatDeterminesNothing) {
    const std::string good = readings(4, 2);
    EXPECT_THAT(codes(k_four, good), testing::IsEmpty());
    EXPECT_THAT(codes(k_four, good + "0,3,1\n"), testing::ElementsAre("GC-CLOSURE-0001"));
    EXPECT_THAT(codes(k_four, readings(4, 1)), testing::Contains("GC-CLOSURE-0002"));
    const std::string opposite = "position,step,reading\n0,0,1\n0,1,1\n0,2,1\n0,3,1\n2,0,1\n2,1,1\n2,2,1\n2,3,2\n";
    const auto found = refusals(k_four, opposite);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "GC-CLOSURE-0002");
    EXPECT_EQ(found[0].what, "the differences of all positions are multiples of 2, a divisor of the 4 steps");
    EXPECT_THAT(codes(R"(, "steps": 5, "numbering": "with")", good), testing::Contains("GC-CLOSURE-0003"));
    EXPECT_THAT(codes(k_four, "position,step,reading\n0,0,1\n0,1,1\n0,2,1\n0,3,1\n1,0,1\n1,1,1\n1,2,1\n1,3,1\n2,0,1\n"),
                testing::ElementsAre("GC-CLOSURE-0003"));
    EXPECT_THAT(codes(k_four + R"(, "drift": "linear")", good), testing::ElementsAre("GC-CLOSURE-0005"));
    EXPECT_THAT(codes(k_four + R"(, "drift": "linear")", readings(4, 2, true)), testing::IsEmpty());
    EXPECT_THAT(codes(k_four, "position,step,reading\n0,5,1\n"), testing::ElementsAre("GC-INPUT-0112"));
    EXPECT_THAT(codes(k_four, "position,step,reading\n4,0,1\n"), testing::ElementsAre("GC-INPUT-0112"));
    EXPECT_THAT(codes(k_four, "position,step,reading\n0,0.5,1\n"), testing::ElementsAre("GC-INPUT-0113"));
    EXPECT_THAT(codes(k_four, "position,step,reading\n0,0,nan\n"), testing::ElementsAre("GC-INPUT-0109"));
    EXPECT_THAT(codes(k_four, "position,step,reading\n0,0,3000000\n"), testing::ElementsAre("GC-INPUT-0112"));
}

TEST(CircleClosureJob, RefusesMoreReadingsThanItHolds) {
    EXPECT_THAT(codes(R"(, "steps": 360, "numbering": "with")", readings(360, 78)),
                testing::ElementsAre("GC-CLOSURE-0004"));
}

TEST(CircleClosureJob, RefusesEffectsThatMeanNothing) {
    const auto with_effect = [](const std::string& effect) {
        return codes(k_four + R"(, "effects": [)" + effect + "]", readings(4, 2));
    };
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "step", "u": 0.1})"), testing::IsEmpty());
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "step", "value": 1, "u": 0.1})"),
                testing::ElementsAre("GC-CLOSURE-0006"));
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "turn", "value": 1, "u": 0.1})"), testing::IsEmpty());
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "scale", "unit": "arcsec", "u": 0.1})"),
                testing::ElementsAre("GC-INPUT-0318"));
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "step", "unit": "mm", "u": 0.1})"),
                testing::ElementsAre("GC-INPUT-0318"));
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "scale", "value": 1, "u": 0.1})"),
                testing::ElementsAre("GC-INPUT-0023"));
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "step"})"), testing::ElementsAre("GC-INPUT-0300"));
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "steps", "u": 1})"), testing::ElementsAre("GC-INPUT-0025"));
    EXPECT_THAT(with_effect(R"({"name": "a", "acts_on": "step", "u": 1}, {"name": "a", "acts_on": "side", "u": 1})"),
                testing::ElementsAre("GC-INPUT-0304"));
}

TEST(CircleClosureJob, EveryCodeHasItsCause) {
    for (const InputCode& code : k_closure_codes) {
        EXPECT_TRUE(code.code.starts_with("GC-CLOSURE-000")) << code.code;
        EXPECT_FALSE(code.meaning.empty());
    }
}

class CircleClosureSchemaTest : public gumcert::test::JobSchema {
protected:
    CircleClosureSchemaTest() : JobSchema("circle_closure") {}
};

TEST_F(CircleClosureSchemaTest, HasTheKeysOfTheReader) {
    expect_keys(circle_closure_job_keys());
}

TEST_F(CircleClosureSchemaTest, AgreesWithTheReader) {
    const std::vector<std::pair<std::string, bool>> jobs{
        {k_four, true},
        {R"(, "numbering": "with")", false},
        {R"(, "steps": 4)", false},
        {R"(, "steps": 4.5, "numbering": "with")", false},
        {R"(, "steps": 2, "numbering": "with")", false},
        {R"(, "steps": 4, "numbering": "reverse")", false},
        {k_four + R"(, "$schema": "../schemas/job-1.schema.json")", true},
        {k_four + R"(, "$schema": 1)", false},
        {k_four + R"(, "axis": "X")", false},
        {k_four + R"(, "sense": "negative", "unit": "urad", "title": "t", "notes": "n", "artefact": "a")", true},
        {k_four + R"(, "repeatability": {"nu": 3})", false},
        {k_four + R"(, "repeatability": {"u": 0})", false},
        {k_four + R"(, "repeatability": {"u": 0.1, "use": "always"})", false},
        {k_four + R"(, "coverage": "monte_carlo", "monte_carlo": {"trials": 1000000})", true},
        {k_four + R"(, "effects": [{"name": "a", "acts_on": "reading", "resolution": 0.1, "note": "n"}])", true},
        {k_four + R"(, "effects": [{"acts_on": "reading", "resolution": 0.1}])", false},
        {k_four + R"(, "effects": [{"name": "a", "acts_on": "reading", "half_width": 0.1, "distribution": "arcsine"}])",
         true},
        {k_four + R"(, "effects": [{"name": "a", "acts_on": "reading", "u": 0.1, "half_width": 1}])", false},
        {k_four + R"(, "effects": [3])", false},
        {k_four + R"(, "effect": [])", false},
        {k_four + R"(, "first_angle_deg": 400)", false}};
    for (const auto& [keys, is_good] : jobs) {
        EXPECT_EQ(accepts(json::parse(job_text(keys))), is_good) << keys;
        EXPECT_EQ(refusals(keys, readings(4, 3)).empty(), is_good) << keys;
    }
}

TEST_F(CircleClosureSchemaTest, AcceptsTheExamples) {
    const std::filesystem::path examples = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/circle_closure";
    for (const char* const name : {"job.json", "indexing_tables.json", "comparison.json"}) {
        EXPECT_TRUE(accepts(examples / name)) << name;
    }
    EXPECT_NO_THROW((void)read_circle_closure_job(examples / "job.json"));
    EXPECT_NO_THROW((void)read_circle_closure_job(examples / "indexing_tables.json"));
}

}  // namespace
}  // namespace gumcert::jobs
