#include "gum/quantity/unit_meant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {
namespace {

std::string advice(const std::string& text) {
    try {
        (void)Unit::parse(text);
    } catch (const InputError& error) {
        return error.diagnostics().front().action;
    }
    return "";
}

TEST(UnitMeant, SaysWhatToWriteForWhatStandsOnDisplays) {
    EXPECT_EQ(unit_meant("RPM"), "Write rpm: capital letters tell units apart.");
    EXPECT_EQ(unit_meant("Kg"), "Write kg: capital letters tell units apart.");
    EXPECT_EQ(unit_meant("KV"), "Write kV: capital letters tell units apart.");
    EXPECT_EQ(unit_meant("HZ"), "Write Hz: capital letters tell units apart.");
    EXPECT_EQ(unit_meant("MHZ"), "Write MHz or mHz: capital letters tell units apart.");
    EXPECT_EQ(unit_meant("Nm"), "Write N m.");
    EXPECT_EQ(unit_meant("ºC"), "Write degC.") << "the ordinal sign of a keyboard";
    EXPECT_EQ(unit_meant("HRC"), "Write 1, and name the scale in the description.");
    EXPECT_EQ(unit_meant("xyzzy"), "");
    EXPECT_EQ(advice("Nm/K"), "Write N m.") << "in a quotient as well";
    EXPECT_EQ(advice("1/Nm"), "Write (N m).");
    EXPECT_EQ(advice("mV / mNm"), "Write (mN m).");
    EXPECT_EQ(advice("V/NM"), "Write (N m), or nm.");
    EXPECT_EQ(advice("1/ccm"), "Write cm3.");
    EXPECT_NO_THROW((void)Unit::parse("1/(N m)"));
    EXPECT_THAT(advice("U/min"), testing::StartsWith("Write rpm"));
    EXPECT_THAT(advice("%rh"), testing::StartsWith("Write percent"));
    EXPECT_THAT(advice("% rh"), testing::StartsWith("Write percent"));
    EXPECT_THAT(advice("dB(A)"), testing::StartsWith("Write dB"));
    EXPECT_THAT(advice("dB (A)"), testing::StartsWith("Write dB")) << "a weighting, and no ampere";
    EXPECT_NO_THROW((void)Unit::parse("dB/(m)"));
    EXPECT_THAT(advice("dB re 20 uPa"), testing::StartsWith("Write dB"));
    EXPECT_THAT(advice("xyzzy"), testing::StartsWith("Write for example")) << "as before";
}

/// Letters that stand behind a unit, and capitals that mean more than one thing.
TEST(UnitMeant, SaysNothingFarFetched) {
    for (const char* text : {"V AC", "A AC", "V DC", "mA DC", "mV pp", "V rms", "mA RMS", "V ac", "V dc"}) {
        EXPECT_THAT(advice(text), testing::StartsWith("Write the unit alone")) << text;
    }
    EXPECT_EQ(unit_meant("NM"), "Write N m, or nm.");
    EXPECT_EQ(unit_meant("kn"), "Write knot.");
    EXPECT_EQ(unit_meant("CC"), "Write cm3.");
    EXPECT_EQ(unit_meant("KP"), "Write kPa or kgf.");
    EXPECT_EQ(unit_meant("AT"), "") << "aT is in no data sheet";
    EXPECT_EQ(unit_meant("AV"), "");
    EXPECT_EQ(unit_meant("CV"), "");
    EXPECT_EQ(unit_meant("CM"), "Write cm: capital letters tell units apart.");
    EXPECT_EQ(unit_meant("HPA"), "Write hPa: capital letters tell units apart.");
}

/// A law: whatever is advised can be written, and what it is advised for cannot.
TEST(UnitMeant, AdvisesUnitsForNamesThatAreNone) {
    for (const char* name :
         {"kNm", "mNm", "cNm",  "dNm",   "MNm",  "Ncm",   "Nmm",   "mPas", "Pas",     "Vs",         "As",
          "mAs", "Ws",  "ccm",  "cbm",   "kp",   "pct",   "%RH",   "RH",   "FS",      "rdg",        "digit",
          "cnt", "dBA", "dBC",  "HV",    "HBW",  "Shore", "NTU",   "Brix", "Vrms",    "mVrms",      "Vpp",
          "VAC", "ADC", "barg", "bara",  "psig", "psia",  "mmH2O", "mH2O", "%r.F.",   "NM",         "kn",
          "CC",  "Kp",  "cps",  "cpm",   "mho",  "r",     "U",     "upm",  "Celsius", "Fahrenheit", "º",
          "KHZ", "OHM", "MOHM", "Gauss", "RPM",  "KG"}) {
        const std::string told = unit_meant(name);
        ASSERT_THAT(told, testing::StartsWith("Write ")) << name;
        EXPECT_EQ(advice(name), told) << name << " is refused with it";
        const std::size_t end = told.find_first_of(",.:", 6);
        const std::string cure = told.substr(6, told.find(" or ") < end ? told.find(" or ") - 6 : end - 6);
        if (!cure.starts_with("the unit") && !cure.starts_with("rpm for")) {
            EXPECT_NO_THROW((void)Unit::parse(cure)) << name << " -> " << cure;
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
