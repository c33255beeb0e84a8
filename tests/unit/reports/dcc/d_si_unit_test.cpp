#include "reports/dcc/d_si_unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/unit.h"
#include "gum/quantity/unit_table.h"
#include "reports/dcc/dcc_writer.h"

namespace gumcert::reports {
namespace {

TEST(DSiUnit, ReadsUnitsOfTheNotation) {
    const std::vector<std::pair<std::string, std::string>> units = {
        {"\\metre", "m"},
        {"\\micro\\metre", "um"},
        {"\\kilogram", "kg"},
        {"\\kilo\\gram", "kg"},
        {"\\one", "1"},
        {"\\percent", "percent"},
        {"\\degreecelsius", "degC"},
        {"\\metre\\per\\second", "m s-1"},
        {"\\metre\\second\\tothe{-1}", "m s-1"},
        {"\\metre\\per\\second\\tothe{2}", "m s-2"},
        {"\\kilo\\gram\\metre\\tothe{-3}", "kg m-3"},
        {"\\one\\per\\kelvin", "K-1"},
        {"\\arcsecond", "arcsec"},
        {"\\nano\\metre\\per\\kelvin", "nm K-1"},
        // Everything behind \per is in the denominator: J/(kg K), as the PTB's own parser reads it.
        {"\\joule\\per\\kilogram\\kelvin", "J kg-1 K-1"},
        {"\\watt\\per\\metre\\tothe{2}\\kelvin", "W m-2 K-1"},
        {"\\volt\\hertz\\tothe{-0.5}", "V Hz^(-1/2)"},
        {"\\nano\\volt\\per\\hertz\\tothe{0.5}", "nV Hz^(-1/2)"},
        {"\\metre\\tothe{1.5}", "m^(3/2)"},
        {"\\metre\\tothe{0.2}", "m^(1/5)"},
    };
    for (const auto& [d_si, udunits] : units) {
        EXPECT_EQ(unit_from_d_si(d_si), udunits) << d_si;
        EXPECT_NO_THROW((void)gum::Unit::parse(udunits)) << udunits;
    }
}

TEST(DSiUnit, SaysNothingOfWhatItDoesNotKnow) {
    for (const char* text : {"",
                             "|",
                             "|quux",
                             "|F",
                             "|kt",
                             "|psi rpm|",
                             "metre",
                             "\\",
                             "\\furlong",
                             "\\micro",
                             "\\metre\\per",
                             "\\per\\per\\second",
                             "\\metre\\tothe{0.333333}",
                             "\\metre\\tothe{0}",
                             "\\metre\\tothe{0.55}",
                             "\\metre\\tothe{1/2}",
                             "\\metre\\tothe{5e-1}",
                             "\\metre\\tothe{2",
                             "\\metre\\tothe{}",
                             "\\metre ",
                             "\\metre2",
                             "\\Metre",
                             "\\metre\\tothe{1000}",
                             "\\metre\\per\\second\\per\\second",
                             "\\metre\\per"}) {
        EXPECT_FALSE(unit_from_d_si(text)) << text;
    }
}

/// A prefix and a symbol side by side can spell another unit: ft, yd, cd, m1 (metre), u1 (atomic mass unit).
TEST(DSiUnit, TakesNoMultipleForAnotherUnit) {
    for (const char* text :
         {"\\femto\\tonne", "\\yocto\\day", "\\centi\\day", "\\pico\\tonne", "\\atto\\tonne", "\\kilo\\tonne",
          "\\milli\\one", "\\micro\\one", "\\deci\\one", "\\kilo\\one", "\\milli\\minute"}) {
        EXPECT_FALSE(unit_from_d_si(text)) << text << " " << unit_from_d_si(text).value_or("");
    }
    EXPECT_EQ(unit_from_d_si("\\mega\\gram"), "Mg");
}

TEST(DSiUnit, IsTheInverseOfTheUnitsThatWeWrite) {
    for (const std::string unit : {"um",     "mm",     "nm",           "arcsec",     "deg", "rad", "degC",    "K",
                                   "V",      "mV",     "ohm",          "uohm",       "A",   "mA",  "kg",      "g",
                                   "mg",     "Pa",     "kPa",          "bar",        "N",   "J",   "percent", "ppm",
                                   "1",      "s",      "ms",           "min",        "h",   "d",   "Hz",      "MHz",
                                   "W",      "mol",    "cd",           "lx",         "dB",  "L",   "t",       "eV",
                                   "nm K-1", "kg m-3", "J kg-1 K-1",   "um m-1",     "K-1", "Gy",  "Sv",      "Bq",
                                   "kat",    "lm",     "nV Hz^(-1/2)", "V Hz^(3/2)", "T",   "H",   "F",       "S",
                                   "Wb",     "C"}) {
        const auto d_si = gum::unit_in_d_si(unit);
        ASSERT_TRUE(d_si) << unit;
        const auto back = unit_from_d_si(*d_si);
        ASSERT_TRUE(back) << *d_si;
        const gum::Unit a = gum::Unit::parse(unit);
        const gum::Unit b = gum::Unit::parse(*back);
        EXPECT_EQ(a.dimension(), b.dimension()) << unit << " " << *back;
        EXPECT_EQ(a.to_si(3.0), b.to_si(3.0)) << unit << " " << *back;
    }
}

/// Names behind "|" were never read back: a certificate in psi lost its results on the way into a job.
TEST(DSiUnit, EveryUnitOfTheTableSurvives) {
    const auto survives = [](const std::string& unit) {
        const std::optional<std::string> back = unit_from_d_si(d_si_unit(unit));
        ASSERT_TRUE(back) << unit << " as " << d_si_unit(unit);
        const gum::Unit a = gum::Unit::parse(unit);
        const gum::Unit b = gum::Unit::parse(*back);
        EXPECT_EQ(a.dimension(), b.dimension()) << unit << " " << *back;
        EXPECT_EQ(a.is_celsius_temperature(), b.is_celsius_temperature()) << unit;
        EXPECT_NEAR(a.to_si(3.0), b.to_si(3.0), 1e-12 * std::abs(a.to_si(3.0))) << unit << " " << *back;
    };
    for (const gum::UnitDefinition& definition : gum::unit_definitions()) {
        std::istringstream all(std::string(definition.symbols) + " " + std::string(definition.names));
        for (std::string unit; all >> unit;) {
            survives(unit);
            if (!gum::Unit::parse(unit).is_celsius_temperature()) {
                survives("m-1 " + unit);
                survives(unit + "2 s-1");
            }
        }
    }
    EXPECT_EQ(unit_from_d_si("|rpm"), "rpm");
    EXPECT_EQ(unit_from_d_si("|psi"), "psi");
}

}  // namespace
}  // namespace gumcert::reports
