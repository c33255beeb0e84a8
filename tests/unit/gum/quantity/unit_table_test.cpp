#include "gum/quantity/unit_table.h"

#include <gtest/gtest.h>
#include <udunits2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "gum/quantity/unit.h"

namespace gumcert::gum {
namespace {

std::vector<std::string> words(std::string_view text) {
    std::istringstream stream{std::string(text)};
    std::vector<std::string> all;
    for (std::string word; stream >> word;) {
        all.push_back(word);
    }
    return all;
}

TEST(UnitTable, EachNameIsThereOnce) {
    std::set<std::string> seen;
    for (const UnitDefinition& unit : unit_definitions()) {
        for (const std::string& word : words(std::string(unit.symbols) + " " + std::string(unit.names))) {
            EXPECT_TRUE(seen.insert(word).second) << word;
            EXPECT_EQ(find_unit(word).unit, &unit) << word;
            EXPECT_EQ(find_unit(word).prefix, nullptr) << word;
        }
    }
    for (const AmbiguousUnit& unit : ambiguous_units()) {
        EXPECT_TRUE(seen.insert(std::string(unit.name)).second) << unit.name;
        EXPECT_EQ(find_unit(unit.name).unit, nullptr) << unit.name;
        EXPECT_NE(unit.meanings.find(": write "), std::string_view::npos) << unit.name;
    }
}

/// A prefix and a name spell one unit only: no other prefix with another name makes the same text, unless the text is a
/// name itself.
TEST(UnitTable, NoMultipleHasTwoMeanings) {
    std::map<std::string, std::pair<const UnitDefinition*, const PrefixDefinition*>> seen;
    for (const UnitDefinition& unit : unit_definitions()) {
        if (!unit.multiples) {
            continue;
        }
        for (const PrefixDefinition& prefix : prefix_definitions()) {
            std::vector<std::string> multiples;
            for (const std::string& symbol : words(unit.symbols)) {
                for (const std::string& spelling : words(prefix.symbols)) {
                    multiples.push_back(spelling + symbol);
                }
            }
            for (const std::string& name : words(unit.names)) {
                multiples.push_back(std::string(prefix.name) + name);
            }
            for (const std::string& multiple : multiples) {
                const auto [place, fresh] = seen.emplace(multiple, std::pair{&unit, &prefix});
                EXPECT_TRUE(fresh || place->second == std::pair(&unit, &prefix)) << multiple;
                const NamedUnit found = find_unit(multiple);
                EXPECT_TRUE(found.unit == nullptr || found.prefix == nullptr ||
                            (found.unit == &unit && found.prefix == &prefix))
                    << multiple;
            }
        }
    }
}

/// UDUNITS-2 as a second opinion, with its own files. Where the two differ, the reason stands here.
TEST(UnitTable, AgreesWithUdunits) {
    ut_set_error_message_handler(ut_ignore);
    ut_system* const system = ut_read_xml(nullptr);
    ASSERT_NE(system, nullptr);
    const std::map<std::string, const char*> other{
        {"eV", "CODATA 1986 there, exact since 2019"},
        {"electronvolt", "the same"},
        {"Sv", "the sverdrup there"},
        {"dpt", "the deci-pint there"},
        {"nmi", "a thousand-millionth of a mile there"},
        {"mph", "the milliphot there"},
        {"footcandle", "1.076391e-1 lx there; 1 lm/ft2 is 10.76391 lx"},
        {"footcandles", "the same"},
    };
    std::size_t compared = 0;
    for (const UnitDefinition& unit : unit_definitions()) {
        for (const std::string& word : words(std::string(unit.symbols) + " " + std::string(unit.names))) {
            ut_unit* const theirs = ut_parse(system, word.c_str(), UT_UTF8);
            ut_unit* const ours = ut_parse(system, Unit::parse(word).dimension().text().c_str(), UT_UTF8);
            if (theirs != nullptr && ours != nullptr && other.find(word) == other.end()) {
                if (cv_converter* const convert = ut_get_converter(theirs, ours); convert != nullptr) {
                    const double size = cv_convert_double(convert, 1.0) - cv_convert_double(convert, 0.0);
                    // Seven digits are what UDUNITS-2 states of units such as the ounce.
                    EXPECT_NEAR(Unit::parse(word).difference_to_si(1.0) / size, 1.0, 5e-7) << word;
                    ++compared;
                    cv_free(convert);
                } else {
                    ADD_FAILURE() << word << " is of another dimension";
                }
            }
            ut_free(theirs);
            ut_free(ours);
        }
    }
    ut_free_system(system);
    EXPECT_GT(compared, 150U);
}

TEST(UnitTable, TextNamesEverySizeOnce) {
    const std::string text = unit_table_text();
    EXPECT_NE(text.find("in|inch inches international_inch||1 0 0 0 0 0 0 0 0 |254e-4/1 pi^0|0\n"), std::string::npos);
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')),
              unit_definitions().size() + prefix_definitions().size());
}

}  // namespace
}  // namespace gumcert::gum
