#include "laboratory/standard_record.h"

#include <gtest/gtest.h>

#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_standard.h"

namespace gumcert::laboratory {
namespace {

TEST(StandardRecordTest, UncertaintyComesFromKOrFromTheProbability) {
    CalibrationResult line = test::line_at(10.0, 10.0, 0.3, 3.0);
    EXPECT_DOUBLE_EQ(standard_uncertainty(line), 0.1);
    line.k.reset();
    EXPECT_THROW((void)standard_uncertainty(line), gum::InputError);
    line.p = 0.95;
    EXPECT_NEAR(standard_uncertainty(line), 0.3 / 1.959964, 1e-8);  // normal distribution
    line.nu = 10.0;
    EXPECT_NEAR(standard_uncertainty(line), 0.3 / 2.2281389, 1e-8);  // Student's t, JCGM 100:2008, table G.2: 2.23
}

TEST(StandardRecordTest, TheCalibrationIsTheLastOneBeforeTheUse) {
    const StandardRecord record = test::three_calibrations();
    EXPECT_EQ(calibration_on(record, "2023-12-31"), nullptr);
    EXPECT_EQ(calibration_on(record, "2025-01-01"), &record.calibrations[1]);
    EXPECT_EQ(calibration_on(record, "2025-12-31"), &record.calibrations[1]);
    EXPECT_EQ(calibration_on(record, "2030-01-01"), &record.calibrations[2]);
    EXPECT_EQ(calibration_on(record, ""), &record.calibrations[2]);
}

}  // namespace
}  // namespace gumcert::laboratory
