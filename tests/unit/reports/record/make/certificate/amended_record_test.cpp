#include "reports/record/make/certificate/amended_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "certificate/certificate_fields.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/certified_tables.h"
#include "tests/unit/reports/certified_sample.h"

namespace gumcert::reports {
namespace {

using certificate::Change;

std::string said(const std::vector<Change>& changes) {
    std::string text;
    for (const Change& c : changes) {
        text += c.kind + " " + c.where + ": " + c.before + " -> " + c.after + "\n";
    }
    return text;
}

TEST(AmendedRecord, TellsEveryNumberVerdictAndTextThatDiffers) {
    const certificate::Certificate earlier = *test::certified_budget_record().certificate;
    certificate::Certificate later = earlier;
    EXPECT_EQ(said(changes_between(earlier, later)), "");
    later.data.number = "EX-2026-0043";
    later.data.dates.issued = "2026-12-01";
    later.data.amendment = certificate::Amendment{
        .kind = "amended", .number = earlier.data.number, .sha256 = "", .reason = "x", .changes = {}, .record = ""};
    EXPECT_EQ(said(changes_between(earlier, later)), "") << "what always differs is no change";

    certificate::CertifiedColumn& column = later.tables.front().columns.front();
    const std::string unit = column.printed_unit.empty() ? "" : "\u00A0" + column.printed_unit;
    const std::string before = column.values.front().printed_value;
    column.values.front().printed_value = "7.5";
    column.values.front().verdict.emplace();
    column.values.front().verdict->verdict = "fail";
    later.data.item.serial_number = "SN-7";
    later.data.item.owner = "";
    later.data.remarks.emplace_back("New remark");
    const std::string found = said(changes_between(earlier, later));
    EXPECT_NE(found.find("value " + column.result + ": " + before + unit + " -> 7.5" + unit), std::string::npos)
        << found;
    EXPECT_NE(found.find("verdict " + column.result + ":  -> fail"), std::string::npos) << found;
    EXPECT_NE(found.find("text /item/serial_number: " + earlier.data.item.serial_number + " -> SN-7"),
              std::string::npos)
        << found;
    EXPECT_NE(found.find(":  -> New remark"), std::string::npos) << found;
}

TEST(AmendedRecord, TellsResultsThatCameAndWent) {
    const certificate::Certificate earlier = *test::certified_budget_record().certificate;
    certificate::Certificate later = earlier;
    later.tables.front().columns.front().result = "other";
    const std::vector<Change> changes = changes_between(earlier, later);
    ASSERT_EQ(changes.size(), 2U) << said(changes);
    EXPECT_EQ(changes[0].where, "other");
    EXPECT_EQ(changes[0].before, "");
    EXPECT_EQ(changes[1].where, earlier.tables.front().columns.front().result);
    EXPECT_EQ(changes[1].after, "");
}

/// A table as a job asks for it: a column of words, one of numbers, a result with limits.
certificate::Certificate certificate_with_layout() {
    certificate::Certificate c = *test::certified_budget_record().certificate;
    certificate::CertifiedTable& table = c.tables.front();
    table.columns.resize(1);
    certificate::CertifiedColumn& column = table.columns.front();
    column.result = "E";
    column.printed_unit = "mg";
    certificate::CertifiedValue value = column.values.front();
    value.verdict.emplace();
    value.verdict->verdict = "pass";
    value.verdict->printed.lower = "\u22121.6";
    value.verdict->printed.upper = "1.6";
    column.values = {value, value};
    table.argument.emplace();
    table.argument->name = "point";
    table.argument->values = {{}, {}};
    table.argument->printed = {"1", "2"};
    certificate::TableLayout& layout = table.layout.emplace();
    layout.shown = {{.show = "column", .of = "mark", .heading = {}, .role = "", .stage = ""},
                    {.show = "value", .of = "E", .heading = {}, .role = "", .stage = ""},
                    {.show = "limit", .of = "E", .heading = {}, .role = "", .stage = ""}};
    certificate::PointColumn mark;
    mark.name = "mark";
    mark.heading = "Mark";
    mark.values = {{}, {}};
    mark.printed = {"1 mg", "500 mg"};
    certificate::PointColumn nominal = mark;
    nominal.name = "nominal";
    nominal.values = {5.1, 5.2};
    nominal.printed = {"5.1000", "5.2000"};
    nominal.printed_unit = "mm";
    layout.columns = {mark, nominal};
    return c;
}

TEST(AmendedRecord, TellsCellsLimitsAndHeadingsThatDiffer) {
    const certificate::Certificate earlier = certificate_with_layout();
    const auto changed = [&](const auto& change) {
        certificate::Certificate later = certificate_with_layout();
        change(later.tables.front());
        return said(changes_between(earlier, later));
    };
    EXPECT_EQ(changed([](auto&) {}), "");
    EXPECT_EQ(changed([](auto& t) { t.layout->columns[0].printed[0] = "1 mg **"; }),
              "words mark [1 mg **]: 1 mg -> 1 mg **\n");
    EXPECT_EQ(changed([](auto& t) { t.layout->columns[1].printed[0] = "5.1001"; }),
              "cell nominal [1 mg]: 5.1000\u00A0mm -> 5.1001\u00A0mm\n");
    EXPECT_EQ(changed([](auto& t) { t.columns[0].values[1].verdict->printed.upper = "5"; }),
              "limit_high E [500 mg]: 1.6\u00A0mg -> 5\u00A0mg\n");
    EXPECT_EQ(changed([](auto& t) { t.layout->columns[0].heading = "Marking"; }), "heading mark: Mark -> Marking\n");
    EXPECT_EQ(changed([](auto& t) { t.layout->shown[0].role = t.layout->columns[0].role = "nominal"; }),
              "role mark:  -> nominal\n");
    EXPECT_EQ(changed([](auto& t) { t.layout->title = "Weights"; }), "title E:  -> Weights\n");
    EXPECT_EQ(changed([](auto& t) { t.layout->shown.pop_back(); }), "columns E: mark, E, limit(E) -> mark, E\n");
    EXPECT_EQ(changed([](auto& t) { t.layout->group = "class F1"; }),
              "group E [class F1, 1 mg]:  -> class F1\ngroup E [class F1, 500 mg]:  -> class F1\n");
    EXPECT_EQ(changed([](auto& t) { t.argument->printed[0] = "one"; }).find("limit"), std::string::npos)
        << "a result that came is told by its value";
}

TEST(AmendedRecord, TellsOnceWhatWasAgreedForAllValues) {
    const certificate::Certificate earlier = certificate_with_layout();
    certificate::Certificate later = earlier;
    for (certificate::CertifiedValue& value : later.tables.front().columns.front().values) {
        value.verdict->printed.upper = "5";
    }
    EXPECT_EQ(said(changes_between(earlier, later)), "limit_high E: 1.6\u00A0mg -> 5\u00A0mg\n");
}

// Rows of two groups are two tables, and the result of both is one.
TEST(AmendedRecord, TellsOnceWhatIsSaidOfAResultInTheTablesOfItsGroups) {
    certificate::Certificate earlier = certificate_with_layout();
    certificate::CertifiedTable second = earlier.tables.front();
    for (std::string& point : second.argument->printed) {
        point += "b";
    }
    earlier.tables.push_back(second);
    for (certificate::CertifiedTable& table : earlier.tables) {
        table.columns.front().values.front().verdict->rule = "DR-01";
    }
    certificate::Certificate later = earlier;
    for (certificate::CertifiedTable& table : later.tables) {
        table.columns.front().name = "deviation";
        table.columns.front().values.front().verdict->rule = "DR-03";
    }
    const std::string found = said(changes_between(earlier, later));
    for (const char* once : {"heading E: ", "rule E: "}) {
        EXPECT_NE(found.find(once), std::string::npos) << found;
        EXPECT_EQ(found.find(once), found.rfind(once)) << found;
    }
}

// Two titles were exchanged: both tables say another thing now, though no title came or went.
TEST(AmendedRecord, TellsTitlesThatWereExchanged) {
    certificate::Certificate earlier = certificate_with_layout();
    certificate::CertifiedTable second = earlier.tables.front();
    for (std::string& point : second.argument->printed) {
        point += "b";
    }
    earlier.tables.push_back(second);
    earlier.tables[0].layout->title = "DC";
    earlier.tables[1].layout->title = "AC";
    certificate::Certificate later = earlier;
    EXPECT_EQ(said(changes_between(earlier, later)), "");
    std::swap(later.tables[0].layout->title, later.tables[1].layout->title);
    EXPECT_EQ(said(changes_between(earlier, later)), "title E: DC -> AC\ntitle E: AC -> DC\n");
    later = earlier;
    earlier.tables[0].layout->shown.pop_back();
    later.tables[1].layout->shown.pop_back();
    EXPECT_EQ(said(changes_between(earlier, later)),
              "columns E: mark, E -> mark, E, limit(E)\ncolumns E: mark, E, limit(E) -> mark, E\n");
}

TEST(AmendedRecord, GivesBothEndsOfAUTheirUnit) {
    certificate::Certificate earlier = certificate_with_layout();
    certificate::StandardUsed standard;
    standard.name = "Source";
    standard.U = 0.5;
    standard.U_to = 3.0;
    standard.unit = "MHz";
    earlier.data.standards = {standard};
    certificate::Certificate later = earlier;
    later.data.standards.front().U = 0.6;
    later.data.standards.front().U_to = 4.0;
    const std::string found = said(changes_between(earlier, later));
    EXPECT_NE(found.find("/U: 0.5\u00A0MHz -> 0.6\u00A0MHz"), std::string::npos) << found;
    EXPECT_NE(found.find("/U_to: 3\u00A0MHz -> 4\u00A0MHz"), std::string::npos) << found;
}

/// A number of a scope or of limits has the unit that stands around it, or that of its argument.
TEST(AmendedRecord, GivesNumbersOfScopesAndLimitsTheirUnits) {
    certificate::Certificate earlier = certificate_with_layout();
    certificate::ScopeEntry entry;
    entry.id = "S1";
    entry.results = {"E"};
    entry.ranges = {{.argument = {.name = "I", .unit = "mA", .of = "I_N"}, .low = 1.0, .high = 20.0}};
    entry.capability.form = "table";
    entry.capability.unit = "uA";
    entry.capability.arguments = {{.name = "I", .unit = "mA", .of = "I_N"}};
    entry.capability.points = {{.at = 1.0, .U = 0.1}, {.at = 20.0, .U = 2.0}};
    earlier.data.accreditation.emplace().scope = {entry};
    certificate::AgreedSpecification specification;
    specification.id = "s";
    specification.results = {"E"};
    specification.unit = "mV";
    specification.limits.emplace().by = "steps";
    specification.limits->arguments = {{.name = "I", .unit = "mA", .of = "I_N"}};
    specification.limits->steps = {{.up_to = 5.0, .mpe = 0.3}};
    specification.limits->accuracy = {{.range = "A",
                                       .unit = "",
                                       .percent_of_reading = 0.5,
                                       .percent_of_range = {},
                                       .full_scale = {},
                                       .digits = 2.0,
                                       .digit = 0.1,
                                       .constant = {}}};
    specification.rule.id = "DR-04";
    specification.rule.guard_factor = 0.5;
    earlier.data.specifications = {specification};
    certificate::Certificate later = earlier;
    later.data.accreditation->scope[0].ranges[0].high = 30.0;
    later.data.accreditation->scope[0].capability.points[1] = {.at = 30.0, .U = 3.0};
    later.data.specifications[0].limits->steps[0] = {.up_to = 6.0, .mpe = 0.4};
    later.data.specifications[0].limits->accuracy[0].percent_of_reading = 0.6;
    later.data.specifications[0].limits->accuracy[0].digits = 3.0;
    later.data.specifications[0].limits->accuracy[0].digit = 0.2;
    later.data.specifications[0].rule.guard_factor = 0.6;
    const std::string found = said(changes_between(earlier, later));
    for (const char* const change :
         {"/high: 20\u00A0mA -> 30\u00A0mA", "/points/1/at: 20\u00A0mA -> 30\u00A0mA",
          "/points/1/U: 2\u00A0µA -> 3\u00A0µA", "/up_to: 5\u00A0mA -> 6\u00A0mA", "/mpe: 0.3\u00A0mV -> 0.4\u00A0mV",
          "/percent_of_reading: 0.5\u00A0% -> 0.6\u00A0%", "/digits: 2 -> 3", "/digit: 0.1\u00A0mV -> 0.2\u00A0mV",
          "/guard_factor: 0.5 -> 0.6"}) {
        EXPECT_NE(found.find(change), std::string::npos) << change << "\n" << found;
    }
}

/// Where the table of results shows limits and verdicts the certificate has no table of them.
TEST(AmendedRecord, TellsNothingOfADecisionThatIsNotPrinted) {
    certificate::Certificate earlier = certificate_with_layout();
    certificate::ShownColumn verdict;
    verdict.show = "verdict";
    verdict.of = "E";
    earlier.tables.front().layout->shown.push_back(verdict);
    const auto changed = [&](std::string& (*text)(certificate::Verdict&)) {
        certificate::Certificate later = earlier;
        text(*later.tables.front().columns.front().values.front().verdict) += "1";
        return said(changes_between(earlier, later));
    };
    using V = certificate::Verdict;
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.acceptance_lower; }), "");
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.acceptance_upper; }), "");
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.conformance_probability; }), "");
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.specific_risk; }), "");
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.largest_specific_risk; }), "");
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.false_accept; }), "");
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.false_reject; }), "");
    EXPECT_EQ(changed([](V& v) -> std::string& { return v.printed.test_uncertainty_ratio; }), "");
    EXPECT_NE(changed([](V& v) -> std::string& { return v.printed.upper; }), "");
    EXPECT_NE(changed([](V& v) -> std::string& { return v.verdict; }), "");
    // Without the limits there is one: it stands beside the verdicts of the table of results.
    std::erase_if(earlier.tables.front().layout->shown, [](const auto& column) { return column.show == "limit"; });
    ASSERT_FALSE(shows_verdict(earlier.tables.front(), "E"));
    EXPECT_NE(changed([](V& v) -> std::string& { return v.printed.acceptance_upper; }), "");
    EXPECT_NE(changed([](V& v) -> std::string& { return v.printed.conformance_probability; }), "");
}

TEST(AmendedRecord, BeginsWithTheItemAndGivesNumbersTheirUnits) {
    certificate::Certificate earlier = certificate_with_layout();
    certificate::AgreedSpecification specification;
    specification.id = "s";
    specification.unit = "mg";
    specification.upper = 1.6;
    earlier.data.specifications = {specification};
    for (certificate::CertifiedValue& value : earlier.tables.front().columns.front().values) {
        value.verdict->specification = "s";
    }
    certificate::Certificate later = earlier;
    later.data.specifications.front().upper = 5.0;
    later.data.item.serial_number = "SN-7";
    later.data.remarks.emplace_back("New remark");
    for (certificate::CertifiedValue& value : later.tables.front().columns.front().values) {
        value.verdict->printed.upper = "5";
    }
    later.tables.front().columns.front().values.front().printed_value += "1";
    const std::vector<Change> changes = changes_between(earlier, later);
    ASSERT_EQ(changes.size(), 4U) << said(changes);
    EXPECT_EQ(changes[0].where, "/item/serial_number");
    EXPECT_EQ(changes[1].kind, "value");
    const std::string rest = said({changes[2], changes[3]});
    EXPECT_NE(rest.find("number /specifications/0/upper: 1.6\u00A0mg -> 5\u00A0mg"), std::string::npos) << rest;
    EXPECT_NE(rest.find("New remark"), std::string::npos) << rest;
}

/// Gives one text after the other of what is described another value, and counts them.
class OtherText {
public:
    explicit OtherText(int position, std::string at = "") : position_(position), at_(std::move(at)) {}

    std::string changed;  ///< where the text stands that was changed

    template <class Type, class... Rule>
    void operator()(const char* key, Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void operator()(const char* key, Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v);
    }
    template <class Type, class... Rule>
    void added(const char* key, Type& v, const Rule&...) {
        look(at_ + "/" + key, v);
    }
    template <class Type>
    void stated(const char* key, Type& v, std::initializer_list<const char*>) {
        look(at_ + "/" + key, v);
    }
    template <class Fields>
    void group(const char* key, const Fields& fields) {
        const std::string before = std::exchange(at_, at_ + "/" + key);
        fields(*this);
        at_ = before;
    }

private:
    int position_;
    std::string at_;

    template <class Type>
    void look(const std::string& at, Type& v) {
        if constexpr (std::same_as<Type, std::string>) {
            if (position_-- == 0) {
                v += "x";
                changed = at;
            }
        } else if constexpr (std::same_as<Type, certificate::LocalisedText>) {
            if (position_-- == 0) {
                v.plain += "x";
                changed = at;
            }
        } else if constexpr (std::same_as<Type, bool>) {
            if (position_-- == 0) {
                v = !v;
                changed = at;
            }
        } else if constexpr (std::same_as<Type, std::optional<certificate::Verdict>>) {
            const std::string before = std::exchange(at_, at);
            describe(*this, *v);
            at_ = before;
        }
    }
};

/// A member that somebody adds is compared, or is named here with the reason.
TEST(AmendedRecord, ComparesEveryPrintedTextOfAValue) {
    const std::set<std::string> left_out{"/outside_because",                // follows from the entry of the scope
                                         "/printed_capability",             // from the scope
                                         "/verdict/formula",                // from the rule
                                         "/verdict/printed/guard_band",     // from the limits of acceptance
                                         "/verdict/verdict_from_printed"};  // a check of the verdict, not printed
    certificate::Certificate earlier = certificate_with_layout();
    earlier.tables.front().columns.front().values.front().printed_low = "1";
    earlier.tables.front().columns.front().values.front().printed_high = "2";
    int position = 0;
    for (std::string changed = "-"; !changed.empty(); ++position) {
        certificate::Certificate later = earlier;
        OtherText other(position);
        describe(other, later.tables.front().columns.front().values.front());
        changed = other.changed;
        const std::string found = said(changes_between(earlier, later));
        EXPECT_EQ(found.empty(), changed.empty() || left_out.contains(changed)) << changed << "\n" << found;
        EXPECT_LE(std::count(found.begin(), found.end(), '\n'), 1) << found;
    }
    EXPECT_GT(position, 25);
}

/// The same of what a job says of its tables.
TEST(AmendedRecord, ComparesEveryTextOfALayout) {
    const std::set<std::string> left_out{"/unit",      // printed_unit is what a table shows
                                         "/decimals",  // the digits of the numbers show it
                                         "/form",      // the numbers themselves are printed so
                                         "/plot"};     // a drawing of numbers that are compared
    const certificate::Certificate earlier = certificate_with_layout();
    const auto look = [&](auto&& part_of) {
        int position = 0;
        for (std::string changed = "-"; !changed.empty(); ++position) {
            certificate::Certificate later = earlier;
            OtherText other(position);
            describe(other, part_of(*later.tables.front().layout));
            changed = other.changed;
            const std::string found = said(changes_between(earlier, later));
            EXPECT_EQ(found.empty(), changed.empty() || left_out.contains(changed)) << changed << "\n" << found;
        }
        EXPECT_GT(position, 3);
    };
    using Layout = certificate::TableLayout;
    look([](Layout& l) -> Layout& { return l; });
    look([](Layout& l) -> certificate::PointColumn& { return l.columns[1]; });
    look([](Layout& l) -> certificate::ShownColumn& { return l.shown[0]; });
    look([](Layout& l) -> certificate::ShownColumn& { return l.shown[1]; });
}

TEST(AmendedRecord, TellsTitlesOfTheDocumentAndItsSections) {
    EvaluationRecord earlier = test::certified_budget_record();
    earlier.sections = {{.name = "dc", .title = "DC voltage", .quantities = {}}};
    EvaluationRecord later = earlier;
    EXPECT_EQ(said(changes_between(earlier, later)), "");
    later.title = "Calibration of a ring gauge";
    later.sections.front().title = "AC voltage";
    EXPECT_EQ(said(changes_between(earlier, later)), "title : " + earlier.title +
                                                         " -> Calibration of a ring gauge\n"
                                                         "title dc: DC voltage -> AC voltage\n");
    later = earlier;
    later.coverage_probability.text = "95 %";
    EXPECT_EQ(said(changes_between(earlier, later)),
              "number /coverage_probability: " + earlier.coverage_probability.text + " -> 95 %\n");
    later = earlier;
    later.sections.front().name = "ac";
    EXPECT_EQ(said(changes_between(earlier, later)), "title ac:  -> DC voltage\ntitle dc: DC voltage -> \n");
}

/// Standards with some members in common, as those of a laboratory have.
certificate::StandardUsed standard_of(std::size_t number) {
    certificate::StandardUsed standard;
    standard.name = "Weight " + std::to_string(number);
    standard.identification = "STD-" + std::to_string(number);
    standard.certificate = "NMI-" + std::to_string(7 * number);
    standard.issuer = number % 2 == 0 ? "Institute" : "Laboratory";
    standard.calibrated = "2026-01-0" + std::to_string(1 + number % 9);
    return standard;
}

// A row that came or went, or stands elsewhere, changes nothing of the other ones.
TEST(AmendedRecord, RowsAreComparedByWhatTheyAre) {
    certificate::Certificate earlier = certificate_with_layout();
    std::mt19937 random(20);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    for (int round = 0; round < 100; ++round) {
        earlier.data.standards.clear();
        const std::size_t count = 1 + below(6);
        for (std::size_t i = 0; i < count; ++i) {
            earlier.data.standards.push_back(standard_of(i));
        }
        certificate::Certificate later = earlier;
        auto& standards = later.data.standards;
        std::shuffle(standards.begin(), standards.end(), random);
        EXPECT_EQ(said(changes_between(earlier, later)), "") << "the order says nothing";
        const std::size_t edited = below(count);
        standards[edited].certificate = "NMI-999";
        const std::vector<Change> of_edit = changes_between(earlier, later);
        ASSERT_EQ(of_edit.size(), 1U) << said(of_edit);
        EXPECT_EQ(of_edit[0].where, "/standards/" + std::to_string(edited) + "/certificate");
        EXPECT_EQ(of_edit[0].after, "NMI-999");
        EXPECT_TRUE(of_edit[0].before.starts_with("NMI-"));
        standards = earlier.data.standards;
        standards.insert(standards.begin() + static_cast<std::ptrdiff_t>(below(count + 1)), standard_of(8));
        for (const Change& change : changes_between(earlier, later)) {
            EXPECT_EQ(change.before, "") << said({change});
        }
        for (const Change& change : changes_between(later, earlier)) {
            EXPECT_EQ(change.after, "") << said({change});
        }
    }
    // Of lines the order says something.
    earlier.data.customer.address.lines = {"Street 1", "12345 Town", "County"};
    certificate::Certificate later = earlier;
    std::swap(later.data.customer.address.lines[0], later.data.customer.address.lines[1]);
    EXPECT_EQ(changes_between(earlier, later).size(), 2U);
    later = earlier;
    later.data.customer.address.lines.insert(later.data.customer.address.lines.begin(), "Building B");
    EXPECT_EQ(said(changes_between(earlier, later)), "text /customer/address/lines/0:  -> Building B\n");
}

/// A table of the points of a range, as a job with columns of points gives it.
certificate::CertifiedTable table_of_points(const std::string& group, const std::vector<std::size_t>& settings,
                                            std::size_t first_number) {
    certificate::CertifiedTable table = certificate_with_layout().tables.front();
    table.layout->group = group;
    table.layout->columns.resize(1);
    certificate::PointColumn& setting = table.layout->columns.front();
    setting.name = "V_s";
    setting.role = "reference";
    setting.printed_unit = "V";
    setting.printed.clear();
    setting.values.clear();
    certificate::PointColumn indication = setting;
    indication.name = "V_x";
    indication.role = "indication";
    const certificate::CertifiedValue value = table.columns.front().values.front();
    table.columns.front().values.clear();
    table.argument->printed.clear();
    table.argument->values.assign(settings.size(), {});
    for (std::size_t i = 0; i < settings.size(); ++i) {
        setting.printed.push_back(std::to_string(settings[i]) + ".0");
        setting.values.emplace_back(static_cast<double>(settings[i]));
        indication.printed.push_back(setting.printed.back() + std::to_string(settings[i] * 7 % 10));
        indication.values.emplace_back(static_cast<double>(settings[i]));
        table.columns.front().values.push_back(value);
        table.columns.front().values.back().printed_value = std::to_string(settings[i] * 13 % 97);
        table.argument->printed.push_back(std::to_string(first_number + i));
    }
    table.layout->columns.push_back(indication);
    return table;
}

// Numbers of points that nobody sees say nothing: a point that came, went or stands elsewhere changes none of the other ones.
TEST(AmendedRecord, PointsAreComparedByWhatTheirRowsShow) {
    std::mt19937 random(8);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    for (int round = 0; round < 60; ++round) {
        std::vector<std::size_t> low;
        std::vector<std::size_t> high;
        for (std::size_t i = 0; i < 3 + below(5); ++i) {
            low.push_back(1 + i);
            high.push_back(3 + 10 * i);
        }
        const auto certificate_of = [](const auto& first, const std::vector<std::size_t>& own, const auto& second,
                                       const std::vector<std::size_t>& other) {
            certificate::Certificate c = certificate_with_layout();
            c.tables = {table_of_points(first, own, 1), table_of_points(second, other, 1 + own.size())};
            return c;
        };
        const certificate::Certificate earlier = certificate_of("10 V", low, "100 V", high);
        const certificate::Certificate other_order = certificate_of("100 V", high, "10 V", low);
        EXPECT_EQ(said(changes_between(earlier, other_order)), "") << "the order of ranges";
        std::vector<std::size_t> shuffled = low;
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        certificate::Certificate later = certificate_of("10 V", shuffled, "100 V", high);
        EXPECT_EQ(said(changes_between(earlier, later)), "") << "the order of points";

        const std::size_t edited = below(low.size());
        const std::string point = "[10 V, " + std::to_string(shuffled[edited]) + ".0\u00A0V]";
        certificate::CertifiedValue& value = later.tables.front().columns.front().values[edited];
        const std::string before = std::exchange(value.printed_value, "98");
        EXPECT_EQ(said(changes_between(earlier, later)),
                  "value E " + point + ": " + before + "\u00A0mg -> 98\u00A0mg\n");

        std::vector<std::size_t> fewer = low;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(edited));
        later = certificate_of("10 V", fewer, "100 V", high);
        const std::string of_point = "[10 V, " + std::to_string(low[edited]) + ".0\u00A0V]";
        for (const Change& change : changes_between(earlier, later)) {
            EXPECT_TRUE(change.where.ends_with(of_point) && change.after.empty()) << said({change});
        }
        EXPECT_EQ(changes_between(earlier, later).size(), 3U) << "value, setting and indication";
        for (const Change& change : changes_between(later, earlier)) {
            EXPECT_TRUE(change.where.ends_with(of_point) && change.before.empty()) << said({change});
        }
        later = earlier;
        later.tables.pop_back();
        for (const Change& change : changes_between(earlier, later)) {
            EXPECT_TRUE(change.where.find("[100 V, ") != std::string::npos && change.after.empty()) << said({change});
        }
    }
    // Points that show the same are told apart by their numbers, and no value is lost.
    certificate::Certificate earlier = certificate_with_layout();
    earlier.tables = {table_of_points("", {5, 5, 5}, 1)};
    certificate::Certificate later = earlier;
    later.tables.front().columns.front().values[1].printed_value = "98";
    EXPECT_EQ(said(changes_between(earlier, later)), "value E [5.0\u00A0V, 2]: 65\u00A0mg -> 98\u00A0mg\n");
}

/// The code of the refusal, or "" where the changes were stated.
std::string code_of(EvaluationRecord& record) {
    try {
        state_changes(record);
    } catch (const gum::InputError& error) {
        return error.diagnostics().front().code;
    }
    return "";
}

TEST(AmendedRecord, IsReadFromTheFilesOfTheJob) {
    EvaluationRecord earlier = test::certified_budget_record();
    EvaluationRecord later = earlier;
    later.certificate->data.amendment = certificate::Amendment{.kind = "replaced",
                                                               .number = earlier.certificate->data.number,
                                                               .sha256 = "",
                                                               .reason = "x",
                                                               .changes = {},
                                                               .record = ""};
    EXPECT_EQ(code_of(later), "");
    EXPECT_TRUE(later.certificate->changes.empty()) << "no record is named";

    later.certificate->data.amendment->record = "earlier.json";
    EXPECT_EQ(code_of(later), "GC-CERT-0307") << "it is not among the files";
    later.job_files.push_back(input_file("earlier.json", to_canonical_json(earlier), true));
    EXPECT_EQ(code_of(later), "GC-CERT-0308") << "nothing differs";
    EvaluationRecord other = later;
    other.title = "Another title";
    other.coverage_probability.text = "90 %";
    other.certificate->tables.front().columns.front().values.front().printed_value = "7.5";
    EXPECT_EQ(code_of(other), "");
    EXPECT_EQ(said(record_from_json(to_canonical_json(other), "record").certificate->changes),
              said(other.certificate->changes))
        << "what is told can be written and read again";
    EXPECT_NE(said(other.certificate->changes).find("/coverage_probability"), std::string::npos)
        << said(other.certificate->changes);
    later.certificate->data.item.serial_number = "SN-7";
    EXPECT_EQ(code_of(later), "");
    ASSERT_EQ(later.certificate->changes.size(), 1U);
    EXPECT_EQ(later.certificate->amended_record_sha256, later.job_files.back().sha256);
    later.certificate->data.amendment->number = "EX-1";
    EXPECT_EQ(code_of(later), "GC-CERT-0307") << "it is the record of another certificate";

    later.certificate->data.amendment->number = earlier.certificate->data.number;
    const EvaluationRecord again = record_from_json(to_canonical_json(later), "record");
    ASSERT_EQ(again.certificate->changes.size(), 1U);
    EXPECT_EQ(again.certificate->changes.front().after, "SN-7");
}

}  // namespace
}  // namespace gumcert::reports
