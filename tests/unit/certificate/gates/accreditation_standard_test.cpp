#include "certificate/gates/accreditation_standard.h"

#include <gtest/gtest.h>

namespace gumcert::certificate {
namespace {

TEST(AccreditationStandard, IsThatOfCalibrationLaboratories) {
    for (const char* text :
         {"ISO/IEC 17025", "ISO/IEC 17025:2017", "ISO/IEC 17025:2005", "DIN EN ISO/IEC 17025:2018-03",
          "GB/T 27025-2019", "iso 17025", "JIS Q 17025:2018", "NF EN ISO/IEC 17025", "BS EN ISO/IEC 17025:2017",
          "UNI CEI EN ISO/IEC 17025:2018", "ISO/CEI 17025:2017"}) {
        EXPECT_TRUE(is_of_calibration_laboratories(text)) << text;
    }
}

TEST(AccreditationStandard, IsNoOther) {
    for (const char* text : {"", "ISO/IEC", "ISO 9001:2015", "ISO/IEC 17020:2012", "in the spirit of ISO/IEC 17025",
                             "not ISO/IEC 17025:2017", "ISO/IEC 17025:1999", "ISO/IEC 17025:2016", "ISO/IEC 17025:2030",
                             "ISO/IEC 17025:2017-13", "ISO/IEC 17025 17025", "2017:ISO/IEC 17025"}) {
        EXPECT_FALSE(is_of_calibration_laboratories(text)) << text;
    }
}

}  // namespace
}  // namespace gumcert::certificate
