#include "reports/record/make/certificate/paired_points.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <initializer_list>

namespace gumcert::reports {
namespace {

using certificate::Certificate;
using certificate::CertifiedTable;

/// A table of settings in V, with the readings that they gave.
Certificate certificate_of(const std::vector<std::string>& settings) {
    CertifiedTable table;
    table.id = "results";
    table.argument.emplace().name = "point";
    certificate::TableLayout& layout = table.layout.emplace();
    certificate::PointColumn reading;
    reading.name = "V_x";
    reading.role = "indication";
    certificate::PointColumn setting;
    setting.name = "V_s";
    setting.role = "setting";
    setting.printed_unit = "V";
    for (std::size_t i = 0; i < settings.size(); ++i) {
        table.argument->printed.push_back(std::to_string(i + 1));
        table.argument->values.emplace_back();
        reading.printed.push_back("1." + std::to_string(i));
        reading.values.emplace_back(1.0);
        setting.printed.push_back(settings[i]);
        setting.values.emplace_back(2.0);
    }
    layout.columns = {reading, setting};
    layout.shown = {{.show = "column", .of = "V_s", .heading = {}, .role = "", .stage = ""}};
    Certificate certificate;
    certificate.tables.push_back(table);
    return certificate;
}

/// What the tables show: the setting, and what was found there.
std::vector<ShownPoint> shown(const Certificate& certificate, const std::vector<std::string>& found) {
    std::vector<ShownPoint> points;
    const CertifiedTable& table = certificate.tables.front();
    for (std::size_t i = 0; i < found.size(); ++i) {
        points.push_back({.number = table.argument->printed[i],
                          .texts = {{"cell V_s", table.layout->columns.back().printed[i]}, {"value E", found[i]}}});
    }
    return points;
}

TEST(PointsOfBoth, AreCalledByWhatTheirRowsShow) {
    const Certificate earlier = certificate_of({"10", "20", "30"});
    const Certificate later = certificate_of({"30", "10", "40 [new]"});
    const PointsOfBoth points(earlier, shown(earlier, {"a", "b", "c"}), later, shown(later, {"c", "d", "e"}));
    EXPECT_EQ(points.earlier_as_later("1"), "2") << "the same setting, with another value";
    EXPECT_EQ(points.earlier_as_later("3"), "1");
    const std::string gone = points.earlier_as_later("2");
    for (const char* number : {"1", "2", "3"}) {
        EXPECT_NE(gone, number);
    }
    EXPECT_EQ(points.name(gone), "20\u00A0V");
    EXPECT_EQ(points.name("1"), "30\u00A0V");
    EXPECT_EQ(points.name("3"), "40 (new)\u00A0V");
    EXPECT_EQ(points.name("10 bar"), "10 bar") << "a name that is printed stays";
}

TEST(PointsOfBoth, OfOneSettingKeepTheirNumbers) {
    const Certificate both = certificate_of({"10", "10", "20"});
    const PointsOfBoth points(both, shown(both, {"a", "b", "c"}), both, shown(both, {"a", "b", "c"}));
    EXPECT_EQ(points.name("1"), "10\u00A0V, 1");
    EXPECT_EQ(points.name("2"), "10\u00A0V, 2");
    EXPECT_EQ(points.name("3"), "20\u00A0V");
}

TEST(PointsOfBoth, AreOnesWhoseSettingWasCorrected) {
    const Certificate earlier = certificate_of({"10", "20"});
    const Certificate later = certificate_of({"15", "10", "21"});
    const PointsOfBoth points(earlier, shown(earlier, {"a", "b"}), later, shown(later, {"x", "a", "b"}));
    EXPECT_EQ(points.earlier_as_later("1"), "2");
    EXPECT_EQ(points.earlier_as_later("2"), "3") << "what was found is the same";
}

// A word of all rows was corrected: however many they are, none of them has gone.
TEST(PointsOfBoth, OfManyRowsAreThoseOfTheirNumbers) {
    for (const std::size_t count : {std::size_t{3}, std::size_t{70}}) {
        std::vector<std::string> before, after, found;
        for (std::size_t i = 0; i < count; ++i) {
            before.push_back(std::to_string(i) + "0");
            after.push_back(std::to_string(i) + "5");
            found.push_back("found " + std::to_string(i));
        }
        const Certificate earlier = certificate_of(before);
        const Certificate later = certificate_of(after);
        const PointsOfBoth points(earlier, shown(earlier, found), later, shown(later, found));
        for (std::size_t i = 1; i <= count; ++i) {
            EXPECT_EQ(points.earlier_as_later(std::to_string(i)), std::to_string(i));
        }
    }
}

TEST(PointsOfBoth, WithPrintedNumbersAreTheirNumbers) {
    const Certificate earlier = certificate_of({"10", "20"});
    const auto stays = [&](const Certificate& later) {
        const std::vector<ShownPoint> rows = shown(certificate_of({"20", "10"}), {"b", "a"});
        const PointsOfBoth points(earlier, shown(earlier, {"a", "b"}), later, rows);
        return points.earlier_as_later("1") == "1" && points.name("1") == "1";
    };
    Certificate later = certificate_of({"20", "10"});
    EXPECT_FALSE(stays(later));
    later.tables.front().layout->shown.push_back({.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
    EXPECT_TRUE(stays(later));
    later = certificate_of({"20", "10"});
    later.tables.front().argument->printed = {"low", "high"};
    EXPECT_TRUE(stays(later));
    later = certificate_of({"20", "10"});
    later.tables.front().layout.reset();
    EXPECT_TRUE(stays(later));
}

}  // namespace
}  // namespace gumcert::reports
