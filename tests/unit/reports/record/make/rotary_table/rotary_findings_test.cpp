#include "reports/record/make/rotary_table/rotary_findings.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/rotary_table/group_notes.h"
#include "tests/support/sample_certificate.h"
#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

using certificate::Finding;
using certificate::FindingSeverity;
using reports::EvaluationRecord;

EvaluationRecord record_with(double chi_square, double p_value, std::size_t removed = 0) {
    EvaluationRecord record = test::sample_record();
    reports::RotaryTable& rotary = *record.rotary;
    rotary.adjustment.chi_square.number = chi_square;
    rotary.adjustment.p_value.number = p_value;
    rotary.adjustment.degrees_of_freedom = 100;
    rotary.reliability.resize(100);
    rotary.flagged.assign(removed, {});
    for (reports::FlaggedDistance& distance : rotary.flagged) {
        distance.removed = true;
    }
    record.certificate.emplace();
    record.certificate->data.status = "accredited";
    return record;
}

std::vector<std::string> ids(const EvaluationRecord& record) {
    std::vector<std::string> all;
    for (const Finding& finding : rotary_findings(record)) {
        all.push_back(finding.id);
    }
    return all;
}

using Ids = std::vector<std::string>;

TEST(RotaryFindings, ResidualsThatRefuteTheUncertaintiesBlockTheCertificate) {
    EXPECT_EQ(ids(record_with(100.0, 0.48)), Ids());
    EXPECT_EQ(ids(record_with(145.0, 0.0022)), Ids());
    EXPECT_EQ(ids(record_with(160.0, 1.3e-4)), Ids{"G01"});
    EvaluationRecord record = record_with(160.0, 1.3e-4);
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::critical);
    record.certificate->data.status = "not_accredited";
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::major);
    record.certificate.reset();
    ASSERT_EQ(rotary_remarks(record).size(), 1U) << "the message stands without a certificate, too";
    EXPECT_EQ(rotary_remarks(record).front().code, "GC-ADJUST-0010");
}

TEST(RotaryFindings, ANoiseThatIsFarFromWhatIsStatedIsTold) {
    const auto record_of = [](double value, double stated, bool used, const char* name = "length noise") {
        EvaluationRecord record = record_with(100.0, 0.48);
        reports::VarianceComponent noise;
        noise.name = name;
        noise.unit = "um";
        noise.value = value;
        noise.estimated = true;
        noise.used = used;
        noise.stated.number = stated;
        noise.stated.text = "x";
        noise.degrees_of_freedom = 200.0;
        record.rotary->variance_components = {noise};
        return record;
    };
    const auto with_noise = [&](double value, double stated, bool used) { return ids(record_of(value, stated, used)); };
    EXPECT_EQ(with_noise(0.104, 0.1, true), Ids()) << "no more than the digits of what is stated";
    EXPECT_EQ(with_noise(0.11, 0.1, true), Ids()) << "what chance explains at 200 degrees of freedom";
    EXPECT_EQ(with_noise(0.07, 0.1, true), Ids());
    EXPECT_EQ(ids(record_of(0.15, 0.1, true, "table linear")), Ids());
    // A noise that is larger may be a reflector that moves: told at any factor, and from two on it blocks.
    EXPECT_EQ(with_noise(0.15, 0.1, true), Ids{"G06"});
    EXPECT_EQ(rotary_findings(record_of(0.15, 0.1, true)).front().severity, FindingSeverity::major);
    EXPECT_EQ(rotary_findings(record_of(0.25, 0.1, true)).front().severity, FindingSeverity::critical);
    EXPECT_EQ(rotary_remarks(record_of(0.15, 0.1, true)).front().severity, gum::Severity::warning)
        << "so the first page of a certificate has it";
    EXPECT_EQ(with_noise(1.04, 0.1, true), Ids{"G06"});
    EXPECT_EQ(with_noise(0.1, 100.0, true), Ids{"G06"});
    EXPECT_EQ(with_noise(1.04, 0.1, false), Ids()) << "a check of the fixture has its own finding";
}

// What is estimated as 0 has no degrees of freedom, and is far from what is stated where its uncertainty says so, or where the
// residuals are too small for what is known beside it.
TEST(RotaryFindings, ANoiseThatIsEstimatedAsNothingIsTold) {
    const auto record_of = [](double u, bool resolution_is_refuted) {
        EvaluationRecord record = record_with(100.0, 0.48);
        reports::VarianceComponent noise;
        noise.name = "length noise";
        noise.unit = "um";
        noise.u = u;
        noise.printed.value = "0.000";
        noise.estimated = true;
        noise.stated.number = 0.1;
        noise.stated.text = "0.10";
        record.rotary->variance_components = {noise};
        if (resolution_is_refuted) {
            record.diagnostics.push_back(
                {.code = "GC-VARIANCE-0009", .where = "w", .what = "w", .rule = "r", .action = "a"});
        }
        return record;
    };
    EXPECT_EQ(ids(record_of(0.09, false)), Ids()) << "0.1 may well be estimated as 0";
    EXPECT_EQ(ids(record_of(0.05, false)), Ids{"G06"});
    EXPECT_EQ(ids(record_of(0.09, true)), Ids{"G06"});
    const std::vector<gum::Diagnostic> remarks = rotary_remarks(record_of(0.09, true));
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_NE(remarks[0].what.find("the distances give 0 µm, and 0.10 µm is stated"), std::string::npos)
        << remarks[0].what;
}

// What is told depends on the ratio of what is stated and its uncertainty, and on no unit.
TEST(RotaryFindings, NothingIsFarFromWhatItsUncertaintyExcludes) {
    for (const double stated : {0.02, 0.1, 1.0, 50.0}) {
        for (const double u : {0.1, 0.3, 0.55, 0.6, 1.0, 3.0}) {
            EvaluationRecord record = record_with(100.0, 0.48);
            reports::VarianceComponent noise;
            noise.name = "length noise";
            noise.unit = "um";
            noise.estimated = true;
            noise.stated.number = stated;
            noise.u = u * stated;
            record.rotary->variance_components = {noise};
            EXPECT_EQ(ids(record), u < 0.57 ? Ids{"G06"} : Ids()) << stated << ", " << u;
        }
    }
}

TEST(RotaryFindings, ResidualsThatAreFarTooSmallAreTold) {
    EXPECT_EQ(ids(record_with(70.0, 0.99)), Ids());
    EXPECT_EQ(ids(record_with(10.0, 1.0)), Ids{"G02"});
    EXPECT_EQ(rotary_findings(record_with(10.0, 1.0)).front().severity, FindingSeverity::information);
}

TEST(RotaryFindings, ManyDistancesLeftOutAreNoGrossErrors) {
    EXPECT_EQ(ids(record_with(100.0, 0.48, 5)), Ids());
    EXPECT_EQ(ids(record_with(100.0, 0.48, 6)), Ids{"G03"});
    EvaluationRecord reported_only = record_with(100.0, 0.48, 6);
    for (reports::FlaggedDistance& distance : reported_only.rotary->flagged) {
        distance.removed = false;
    }
    EXPECT_EQ(ids(reported_only), Ids());
}

TEST(RotaryFindings, SuspiciousGroupsBlockAnAccreditedCertificate) {
    EvaluationRecord record = record_with(100.0, 0.48);
    record.diagnostics.push_back(
        {.code = engine::k_suspicious_group, .where = "station P1", .what = "drift", .rule = "r", .action = "a"});
    for (const char* const code : {"GC-ANGLE-0001", "GC-ANGLE-0002"}) {
        EvaluationRecord other = record_with(100.0, 0.48);
        other.diagnostics.push_back({.code = code, .where = "angles", .what = "w", .rule = "r", .action = "a"});
        EXPECT_EQ(ids(other), Ids{"G04"}) << code;
    }
    EXPECT_EQ(ids(record), Ids{"G04"});
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::critical);
    EXPECT_EQ(rotary_findings(record).front().where, "station P1");
    record.certificate->data.status = "not_accredited";
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::major);
}

TEST(RotaryFindings, ARefutedFixtureBlocksAnAccreditedCertificate) {
    EvaluationRecord record = record_with(100.0, 0.48);
    reports::VarianceComponent fixture;
    fixture.name = "fixture CMM";
    fixture.value = 1.9;
    fixture.stated.number = 1.0;
    fixture.estimated = true;
    fixture.used = false;
    fixture.degrees_of_freedom = 12.0;  // 12 · 1.9² = 43.3: p = 2e-5
    record.rotary->variance_components = {fixture};
    EXPECT_EQ(ids(record), Ids{"G05"});
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::critical);

    record.rotary->variance_components.front().value = 1.6;  // 30.7: p = 2e-3
    EXPECT_EQ(ids(record), Ids());
    record.rotary->variance_components.front().value = 0.3;  // stated on the safe side
    EXPECT_EQ(ids(record), Ids());
    record.rotary->variance_components.front() = fixture;
    record.rotary->variance_components.front().used = true;  // estimated, and in the weights
    EXPECT_EQ(ids(record), Ids());
}

TEST(RotaryFindings, OfOtherRecordsAreNone) {
    EXPECT_TRUE(rotary_findings(EvaluationRecord()).empty());
    EXPECT_TRUE(rotary_remarks(EvaluationRecord()).empty());
}

TEST(RotaryFindings, ARefutedRepeatabilityBlocksWhereItIsTooSmall) {
    const auto record_of = [](const char* code) {
        EvaluationRecord record = record_with(100.0, 0.48);
        record.diagnostics.push_back({.code = code, .where = "w", .what = "w", .rule = "r", .action = "a"});
        return record;
    };
    EvaluationRecord record = record_of("GC-VARIANCE-0010");
    EXPECT_EQ(ids(record), Ids{"G07"});
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::critical);
    record.certificate->data.status = "not_accredited";
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::major);
    record = record_of("GC-VARIANCE-0011");
    EXPECT_EQ(ids(record), Ids{"G07"});
    EXPECT_EQ(rotary_findings(record).front().severity, FindingSeverity::major);
}

}  // namespace
}  // namespace gumcert::reports
