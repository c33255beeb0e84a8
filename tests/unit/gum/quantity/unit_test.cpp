#include "gum/quantity/unit.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit_table.h"

namespace gumcert::gum {
namespace {

std::string code_of(const std::string& text) {
    try {
        (void)Unit::parse(text);
    } catch (const InputError& error) {
        return error.diagnostics().front().code;
    }
    return "";
}

TEST(Unit, ConvertsToCoherentSi) {
    struct Case {
        const char* text;
        double value;
        double si;
        const char* dimension;
    };
    const std::vector<Case> cases{
        {"um", 25.0, 25e-6, "m"},
        {"nm", 50000623.0, 0.050000623, "m"},
        {"mm", 1.5, 0.0015, "m"},
        {"nm/K", 2.0, 2e-9, "m K-1"},
        {"arcsec", 3600.0, std::numbers::pi / 180.0, "rad"},
        {"deg", 180.0, std::numbers::pi, "rad"},
        {"gon", 200.0, std::numbers::pi, "rad"},
        {"1/K", 1e-6, 1e-6, "K-1"},
        {"1/degC", 1e-6, 1e-6, "K-1"},
        {"uohm", 129.0, 129e-6, "m2 kg s-3 A-2"},
        {"kohm", 1.0, 1000.0, "m2 kg s-3 A-2"},
        {"percent", 1.0, 0.01, "1"},
        {"ppm", 1.0, 1e-6, "1"},
        {"kg/m3", 1.2, 1.2, "m-3 kg"},
        {"kg m-3", 1.2, 1.2, "m-3 kg"},
        {"J/(kg K)", 287.0, 287.0, "m2 s-2 K-1"},
        {"mL", 1.0, 1e-6, "m3"},
        {"g", 1.0, 1e-3, "kg"},
        {"ug", 240.0, 240e-9, "kg"},
        {"h", 1.0, 3600.0, "s"},
        {"min", 1.0, 60.0, "s"},
        {"hPa", 1013.25, 101325.0, "m-1 kg s-2"},
        {"dB", 30.0, 30.0, "dB"},
        {"dB/m", 2.0, 2.0, "m-1 dB"},
        {"delta_degC", 0.5, 0.5, "K"},
        {"m rad", 1.0, 1.0, "m rad"},
        {"1", 7.0, 7.0, "1"},
        {"", 7.0, 7.0, "1"},
        {"µm", 1.0, 1e-6, "m"},
        {"V/Hz^(1/2)", 2.0, 2.0, "m2 kg s^(-5/2) A-1"},
        {"nV/Hz^(1/2)", 4.2, 4.2e-9, "m2 kg s^(-5/2) A-1"},
        {"nV Hz^(-1/2)", 4.2, 4.2e-9, "m2 kg s^(-5/2) A-1"},
        {"kHz^(1/2)", 1.0, 31.622776601683793, "s^(-1/2)"},
        {"(um^2/s)^(1/2)", 1.0, 1e-6, "m s^(-1/2)"},
        {"L^(1/3)", 1.0, 0.1, "m"},
        {"1e-6/K", 11.5, 11.5e-6, "K-1"},
        {"10^-6 m", 1.0, 1e-6, "m"},
        {"L/(100 km)", 8.0, 8e-8, "m2"},
        {"m·s⁻²", 9.8, 9.8, "m s-2"},
        {"J/mol/K", 8.3, 8.3, "m2 kg s-2 K-1 mol-1"},
        {"um/m", 1.0, 1e-6, "1"},
        {"psi", 1.0, 6894.757293168361, "m-1 kg s-2"},
        {"eV", 1.0, 1.602176634e-19, "m2 kg s-2"},
        {"mSv", 1.0, 1e-3, "m2 s-2"},
        {"uin", 1.0, 2.54e-8, "m"},
        {"N.m", 1.0, 1.0, "m2 kg s-2"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.text);
        const Unit unit = Unit::parse(c.text);
        EXPECT_DOUBLE_EQ(unit.to_si(c.value), c.si);
        EXPECT_DOUBLE_EQ(unit.from_si(c.si), c.value);
        EXPECT_EQ(unit.dimension().text(), c.dimension);
    }
}

TEST(Unit, DecimalNumbersKeepTheirDigits) {
    const Unit nanometre = Unit::parse("nm");
    EXPECT_EQ(nanometre.from_si(nanometre.to_si(50000623.0)), 50000623.0);
    const Unit micrometre = Unit::parse("um");
    for (int i = 1; i < 2000; ++i) {
        const double value = 0.1 * i;
        EXPECT_EQ(micrometre.to_si(value), value / 1e6);
    }
}

TEST(Unit, CelsiusTemperatureIsHeldFromTheIcePoint) {
    const Unit celsius = Unit::parse("degC");
    EXPECT_TRUE(celsius.is_celsius_temperature());
    EXPECT_EQ(celsius.to_si(20.0), 20.0);
    EXPECT_EQ(celsius.from_si(20.0), 20.0);
    const Unit fahrenheit = Unit::parse("degF");
    EXPECT_TRUE(fahrenheit.is_celsius_temperature());
    EXPECT_NEAR(fahrenheit.to_si(212.0), 100.0, 1e-12);
    EXPECT_NEAR(fahrenheit.to_si(32.0), 0.0, 1e-12);
    EXPECT_NEAR(fahrenheit.difference_to_si(9.0), 5.0, 1e-14);
    EXPECT_FALSE(Unit::parse("K").is_celsius_temperature());
    EXPECT_FALSE(Unit::parse("delta_degC").is_celsius_temperature());
    EXPECT_EQ(unit_of_difference("degC"), "K");
    EXPECT_EQ(unit_of_difference("um"), "um");
}

TEST(Unit, AngleIsADimensionOfItsOwn) {
    EXPECT_FALSE(Unit::parse("rad").dimension().is_one());
    EXPECT_EQ(Unit::parse("arcsec").dimension(), Dimension::angle());
    EXPECT_TRUE(Unit::parse("rad/rad").dimension().is_one());
    EXPECT_TRUE(Unit::parse("m/m").dimension().is_one());
}

TEST(Unit, RefusesWhatIsNotAUnit) {
    EXPECT_EQ(code_of("furlongs_per_moon"), "GC-UNIT-0001");
    EXPECT_EQ(code_of("mm +"), "GC-UNIT-0001");
    EXPECT_EQ(code_of(" mm"), "GC-UNIT-0001");
    EXPECT_EQ(code_of(std::string("m\0m", 3)), "GC-UNIT-0001");
    EXPECT_EQ(code_of(std::string(300, 'm')), "GC-UNIT-0001");
    EXPECT_EQ(code_of("lg(re 1 mW)"), "GC-UNIT-0002");
    EXPECT_EQ(code_of("dBm"), "GC-UNIT-0002");
    EXPECT_EQ(code_of("seconds since 1970-01-01"), "GC-UNIT-0003");
    EXPECT_EQ(code_of("m @ 3"), "GC-UNIT-0004");
    EXPECT_EQ(code_of("2 degC"), "GC-UNIT-0004");
    EXPECT_EQ(code_of("-1 m"), "GC-UNIT-0001");
    EXPECT_EQ(code_of("0 m"), "GC-UNIT-0006");
    EXPECT_EQ(code_of("Ym^99"), "GC-UNIT-0001") << "10^2376";
    EXPECT_EQ(code_of(std::string(100, '(') + "m" + std::string(100, ')')), "");
}

/// UDUNITS-2 reads each of these, and as something else than a metrologist means: "Hz^0.5" as 5, "m^3/2" as m³/2,
/// "10^-6.5 m" as 0.5 um, "1.5e3.5 m" as 750 m. All have in common a number that is neither the first of the unit nor a
/// whole exponent nor a fraction in parentheses.
TEST(Unit, RefusesExponentsAndNumbersWithTwoMeanings) {
    for (const char* name : {"Hz", "m", "K", "nm", "degC", "ohm", "°", "µm", "inch", "volt"}) {
        for (const char* tail :
             {"^0.5", "**0.5", "^.5",    "^1.5",     "^-0.5",   "^2.0",   "^2,5",    "^1/2",     "^-1/2",    "-1/2",
              "^3/2", "1/2",   "2/3",    "0.5",      ".5",      "2.5",    "1.5",     " 0.5",     " 3/2",     " 2",
              "*2",   "/2",    "·2",     "/0.5",     "^0",      "0",      "^00",     "01",       "^01",      "^100",
              "^1e2", "2e3",   "^(0.5)", "^(1/2",    "^(1:2)",  "^(1/0)", "^(1/10)", "^(100/3)", "^((1/2))", "^ 2",
              "^2^3", "²³⁰",   "⁰",      "²2",       "2²",      "^½",     "^+2",     "+2",       "--1",      "-",
              "^",    "^-",    "(2)",    "^(1 / 2)", "^(1/-2)", "@2",     "^2e",     "'",        "\""}) {
            EXPECT_NE(code_of(std::string(name) + tail), "") << name << tail;
            EXPECT_NE(code_of("V/" + std::string(name) + tail), "") << "V/" << name << tail;
            EXPECT_NE(code_of("kg (" + std::string(name) + tail + ")"), "") << "kg (" << name << tail << ")";
        }
    }
    for (const char* text : {"10^-6.5 m", "1.5e3.5 m", "1e6.5 m", "2m",      "1e-6m",    "1e m",
                             "1e-6 2 m",  "2 3 m",     "07 m",    "1/2 m",   "m/2",      "10^(1/2) m",
                             "10^0.5 m",  "1..5 m",    ".5 m",    "1e100 m", "0x10 m",   "1e-6K",
                             "J/kg K",    "W/m^2 K",   "J/kg*K",  "J/kg.K",  "1/K m",    "N-m",
                             "m/s^2/",    "/m",        "m//s",    "m**",     "kg m2s-2", "()",
                             "(m",        "m)",        "(m)(s)",  "m (s",    "1e9999 m", "1234567890123456 m"}) {
        EXPECT_NE(code_of(text), "") << text;
    }
    EXPECT_EQ(code_of("Hz^0.5"), "GC-UNIT-0005");
    EXPECT_EQ(code_of("m^3/2"), "GC-UNIT-0006");
    EXPECT_EQ(code_of("J/kg K"), "GC-UNIT-0007");
}

TEST(Unit, RefusesNamesWithTwoMeaningsAndSaysWhatToWrite) {
    for (const char* name : {"kt", "gal", "ton", "cal", "oz", "hp", "Btu", "year", "a", "pt"}) {
        try {
            (void)Unit::parse(name);
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-UNIT-0001");
            EXPECT_NE(error.diagnostics().front().what.find("may be"), std::string::npos);
            EXPECT_TRUE(error.diagnostics().front().action.starts_with("Write ")) << error.what();
        }
    }
}

/// What the advice for a text that is refused tells to write: all between "Write " and " where", " for", "," or the
/// end.
std::vector<std::string> told_to_write(const std::string& text) {
    std::string action;
    try {
        (void)Unit::parse(text);
        ADD_FAILURE() << text;
        return {};
    } catch (const InputError& error) {
        action = error.diagnostics().front().action;
    }
    EXPECT_TRUE(action.starts_with("Write ")) << text << ": " << action;
    action = action.substr(0, action.find(';'));
    action.erase(0, 6);
    action += action.ends_with('.') ? "" : ".";
    std::vector<std::string> cures;
    for (const char* part : {", or ", ", ", " or "}) {
        for (std::size_t at = action.find(part); at != std::string::npos; at = action.find(part)) {
            action.replace(at, std::string(part).size(), "\n");
        }
    }
    action.back() = '\n';
    while (!action.empty()) {
        std::string cure = action.substr(0, action.find('\n'));
        action.erase(0, action.find('\n') + 1);
        for (const char* end : {" where ", " for "}) {
            cure = cure.substr(0, cure.find(end));
        }
        cures.push_back(cure);
    }
    return cures;
}

// Every message that tells a cure: who follows it has the unit that was meant, without a message.
TEST(Unit, AdviceIsTheCureForThatText) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"V/Hz^1/2", {"V/Hz^(1/2)"}},
        {"V/Hz-1/2", {"V/Hz^(1/2)", "V/Hz^(-1/2)"}},
        {"V/Hz^-1/2", {"V/Hz^(1/2)", "V/Hz^(-1/2)"}},
        {"V Hz-1/2", {"V Hz^(-1/2)"}},
        {"V Hz^-1/2", {"V Hz^(-1/2)"}},
        {"V/Hz1/2", {"V/Hz^(1/2)"}},
        {"m^5/2", {"m^(5/2)"}},
        {"m5/2", {"m^(5/2)"}},
        {"m**3/2", {"m^(3/2)"}},
        {"m 3/2", {"m^(3/2)"}},
        {"m 2", {"m^2"}},
        {"kg/m 3", {"kg/m^3"}},
        {"V/Hz 1/2", {"V/Hz^(1/2)"}},
        {"V^1/2/Hz^1/2", {"V^(1/2)/Hz^(1/2)"}},
        {"m^1/2 s^1/2", {"m^(1/2) s^(1/2)"}},
        {"Hz^0.5", {"Hz^(1/2)"}},
        {"Hz^-0.5", {"Hz^(-1/2)"}},
        {"Hz^(0.5)", {"Hz^(1/2)"}},
        {"V/Hz^0,5", {"V/Hz^(1/2)"}},
        {"V/Hz^½", {"V/Hz^(1/2)"}},
        {"m^1.5", {"m^(3/2)"}},
        {"m^2.0", {"m^2"}},
        {"V/sqrt(Hz)", {"V/Hz^(1/2)"}},
        {"V/√Hz", {"V/Hz^(1/2)"}},
        {"nV/√(kHz)", {"nV/kHz^(1/2)"}},
        {"sqrt(V A)", {"(V A)^(1/2)"}},
        {"° C", {"degC", "°*C"}},
        {"deg C", {"degC", "deg*C"}},
        {"degrees F", {"degF", "degrees*F"}},
        {"m/° C", {"m/degC", "m/(°*C)"}},
        {"deg K", {"K", "deg*K"}},
        {"Gs", {"gauss", "1e9 s"}},
        {"mGs", {"mgauss"}},
        {"kGs", {"kgauss"}},
    };
    for (const auto& [text, expected] : cases) {
        const std::vector<std::string> cures = told_to_write(text);
        EXPECT_EQ(cures, expected) << text;
        for (const std::string& cure : cures) {
            EXPECT_NO_THROW((void)Unit::parse(cure)) << text << " -> " << cure;
        }
    }
    // Where there is no such cure the advice is general.
    for (const char* text : {"m/2", "m^0.123", "m^1/11", "m2 3/2", "m^x"}) {
        EXPECT_NE(code_of(text), "") << text;
    }
    EXPECT_EQ(Unit::parse("V/Hz^(1/2)").dimension(), Unit::parse("V Hz^(-1/2)").dimension());
    // Products with an angle that nobody takes for a temperature stand.
    for (const char* text : {"deg*C", "C deg", "deg/s", "N m/deg", "deg s", "° rad"}) {
        EXPECT_EQ(code_of(text), "") << text;
    }
}

// Every name with two meanings tells names that are units.
TEST(Unit, AdviceForAmbiguousNamesCanBeFollowed) {
    for (const AmbiguousUnit& name : ambiguous_units()) {
        for (const std::string& cure : told_to_write(std::string(name.name))) {
            EXPECT_NO_THROW((void)Unit::parse(cure.substr(0, cure.find(" (")))) << name.name << " -> " << cure;
        }
    }
}

// What laboratories write for something else is not taken for a multiple of a unit, also not in a product.
TEST(Unit, NamesInUseInLaboratoriesAreNoMultiples) {
    for (const char* name :
         {"pH",  "PH",  "pK",  "dH",  "fH",  "TH",  "EV",   "as",   "nt",   "mt",   "MT",   "Pt",  "PA",  "kt",
          "kts", "at",  "pt",  "PS",  "ppt", "mb",  "ct",   "Gs",   "hp",   "cal",  "gal",  "ton", "oz",  "Btu",
          "pHs", "pKa", "HV",  "HB",  "HRC", "NTU", "FNU",  "DN",   "dBm",  "dBu",  "VAC",  "VDC", "Vpp", "Vrms",
          "RH",  "%RH", "%rF", "Nm",  "KN",  "Kg",  "rH",   "IU",   "CFU",  "mpy",  "SCFM", "cfm", "bpm", "mpg",
          "dpi", "lpm", "cps", "°dH", "°fH", "°TH", "psig", "psia", "bara", "barg", "kp",   "mWS", "ata", "kVAr"}) {
        const std::string text = name;
        EXPECT_NE(code_of(text), "") << text;
        EXPECT_NE(code_of(text + "/m"), "") << text;
    }
    const std::vector<std::string> cures = told_to_write("pH");
    ASSERT_EQ(cures.size(), 2U);
    EXPECT_EQ(Unit::parse(cures[0]).dimension(), Unit::parse("1").dimension());
    EXPECT_EQ(Unit::parse(cures[1]).to_si(1.0), 1e-12);
    // Multiples that laboratories do use stand.
    for (const char* multiple : {"uH", "mH", "nH", "H",  "mK", "uK", "mT", "uT", "kV", "MV",  "mV", "pF", "ns",
                                 "ps", "fs", "mg", "ug", "kA", "pA", "dB", "mL", "uL", "hPa", "Mt", "kPa"}) {
        EXPECT_EQ(code_of(multiple), "") << multiple;
    }
}

TEST(Unit, ScaleOfATemperatureTakesPrefixes) {
    const Unit millidegree = Unit::parse("m°C");
    EXPECT_TRUE(millidegree.is_celsius_temperature());
    EXPECT_EQ(millidegree.to_si(1500.0), 1.5);
    EXPECT_EQ(unit_of_difference("mdegC"), "mK");
    EXPECT_EQ(unit_of_difference("degF"), "delta_degF");
}

TEST(Unit, CoherentUnitReadsBack) {
    for (const char* text : {"J/(kg K)", "um", "dB", "1", "ohm", "m rad", "V/Hz^(1/2)", "m^(1/3)", "Pa m^(1/2)"}) {
        const Unit unit = Unit::parse(text);
        const Unit coherent = Unit::coherent(unit.dimension());
        EXPECT_EQ(Unit::parse(coherent.text()).dimension(), unit.dimension()) << text;
        EXPECT_EQ(coherent.to_si(3.0), 3.0);
    }
    EXPECT_EQ(Unit::coherent(Dimension::temperature(), true).text(), "degC");
}

TEST(Unit, ArithmeticOfDimensions) {
    const Dimension length = Unit::parse("m").dimension();
    EXPECT_EQ(length * length, Unit::parse("m2").dimension());
    EXPECT_EQ((length * length).power(0.5), length);
    EXPECT_EQ(length.power(0.5).text(), "m^(1/2)");
    EXPECT_EQ(length.power(0.123).text(), "m^0.123");
    EXPECT_TRUE((length / length).is_one());
    EXPECT_FALSE(length.power(1.0 / 3.0) == length);
    EXPECT_EQ(length.power(1.0 / 3.0) * length.power(2.0 / 3.0), length);
}

TEST(Unit, PrintsForPeopleAndForDocuments) {
    EXPECT_EQ(unit_for_people("um"), "µm");
    EXPECT_EQ(unit_for_people("nm/K"), "nm/K");
    EXPECT_EQ(unit_for_people("nm K-1"), "nm·K⁻¹");
    EXPECT_EQ(unit_for_people("degC"), "°C");
    EXPECT_EQ(unit_for_people("uohm"), "µΩ");
    EXPECT_EQ(unit_for_people("1/K"), "1/K");
    EXPECT_EQ(unit_for_people("1"), "");
    EXPECT_EQ(unit_for_people("percent"), "%");
    EXPECT_EQ(unit_for_people("arcsec"), "″");
    EXPECT_EQ(unit_for_people("J/(kg K)"), "J/(kg·K)");
    EXPECT_EQ(unit_for_people("m2"), "m²");
    EXPECT_EQ(unit_for_people("m^2/s^2"), "m²/s²");
    EXPECT_EQ(unit_for_people("furlong"), "furlong");
    EXPECT_EQ(unit_for_people("V/Hz^(1/2)"), "V/√Hz");
    EXPECT_EQ(unit_for_people("V Hz^(-1/2)"), "V·Hz^(-1/2)");
    EXPECT_EQ(unit_for_people("s^(-5/2)"), "s^(-5/2)");
    EXPECT_EQ(unit_for_people("J/mol/K"), "J/(mol·K)");
    EXPECT_EQ(unit_for_people("1e-6/K"), "1e-6/K");
    EXPECT_EQ(unit_for_people("pC/(m/s2)"), "pC·m⁻¹·s²");
    EXPECT_EQ(unit_for_people("(m/s)^2"), "m²·s⁻²");
    EXPECT_EQ(unit_for_people("V/(um/(m K))"), "V·µm⁻¹·m·K");
    EXPECT_EQ(unit_in_d_si("V/Hz^(1/2)"), "\\volt\\hertz\\tothe{-0.5}");
    EXPECT_EQ(unit_in_d_si("m^(1/3)"), std::nullopt);
    EXPECT_EQ(unit_in_d_si("um"), "\\micro\\metre");
    EXPECT_EQ(unit_in_d_si("nm/K"), "\\nano\\metre\\kelvin\\tothe{-1}");
    EXPECT_EQ(unit_in_d_si("kg/m3"), "\\kilo\\gram\\metre\\tothe{-3}");
    EXPECT_EQ(unit_in_d_si("degC"), "\\degreecelsius");
    EXPECT_EQ(unit_in_d_si("1"), "\\one");
    EXPECT_EQ(unit_in_d_si("furlong"), std::nullopt);
}

TEST(Unit, CanBeReadFromSeveralThreads) {
    std::vector<std::thread> threads;
    std::vector<int> good(4, 0);
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&good, t] {
            for (int i = 0; i < 200; ++i) {
                good[t] += Unit::parse("nm/K").dimension().text() == "m K-1" ? 1 : 0;
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(good, std::vector<int>(4, 200));
}

}  // namespace
}  // namespace gumcert::gum
