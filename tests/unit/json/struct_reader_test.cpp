#include "json/struct_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "json/step.h"

namespace gumcert::json {
namespace {

struct Standard {
    std::string name;
    double U = 0.0;
};
struct Balance {
    bool calibrated = false;
    std::optional<double> u;
    std::array<double, 2> range{};
    std::vector<Standard> standards = {{.name = "default"}};
    std::string kind = "none";
    std::optional<Standard> spare;  ///< of a later release
};

template <class Archive>
void describe(Archive& a, Standard& v) {
    a.needed("name", v.name);
    a("U", v.U);
}
template <class Archive>
void describe(Archive& a, Balance& v) {
    a("calibrated", v.calibrated);
    a("u", v.u);
    a("range", v.range);
    a("standards", v.standards);
    a("kind", v.kind, {"mechanical", "electronic"});
    a.stated("spare", v.spare);
}

using Told = std::vector<std::string>;

/// Numbers are not negative; a missing key is told only where it is needed.
template <bool null_is_none>
class TestReader : public StructReader<TestReader<null_is_none>, Step> {
public:
    using Base = StructReader<TestReader<null_is_none>, Step>;
    TestReader(const nlohmann::json& object, const Step& place, Told& told) : Base(object, place), told_(told) {}

private:
    friend Base;
    static constexpr bool k_null_is_none = null_is_none;
    Told& told_;

    const nlohmann::json* find(std::string_view key) { return this->find_if_there(key); }
    void require(std::string_view key) {
        if (!this->object_.contains(key)) {
            told_.push_back(this->place_.child(key).pointer() + " missing");
        }
    }
    void unknown_key(const std::string& key) { told_.push_back(this->place_.child(key).pointer() + " unknown"); }
    void wrong_type(const nlohmann::json&, const std::string& expected, const Step& at) {
        told_.push_back(at.pointer() + " not " + expected);
    }
    void wrong_size(const nlohmann::json&, std::size_t size, const Step& at) {
        told_.push_back(at.pointer() + " not " + std::to_string(size));
    }
    template <class Rule>
    void read_value(const nlohmann::json& value, double& v, const Step& at, const Rule&) {
        if (!value.is_number()) {
            wrong_type(value, "a number", at);
        } else if (value < 0.0) {
            told_.push_back(at.pointer() + " negative");
        } else {
            v = value.get<double>();
        }
    }
    template <class Rule>
    void read_value(const nlohmann::json& value, std::string& v, const Step& at, const Rule& rule) {
        if (!value.is_string()) {
            wrong_type(value, "a text", at);
            return;
        }
        v = value.get<std::string>();
        if constexpr (std::same_as<Rule, std::initializer_list<const char*>>) {
            if (std::find(rule.begin(), rule.end(), v) == rule.end()) {
                told_.push_back(at.pointer() + " unknown word");
            }
        }
    }
    template <class Struct>
    void read_struct(const nlohmann::json& object, Struct& v, const Step& at) {
        TestReader inner(object, at, told_);
        describe(inner, v);
        inner.finish();
    }
};

template <bool null_is_none = true>
Balance balance_of(const char* text, Told& told) {
    const nlohmann::json object = nlohmann::json::parse(text);
    Balance balance;
    TestReader<null_is_none> reader(object, {}, told);
    describe(reader, balance);
    reader.finish();
    return balance;
}

TEST(StructReader, ReadsMembersListsAndStructs) {
    Told told;
    const Balance read = balance_of(
        R"({"calibrated": true, "u": 0.5, "range": [1, 2], "kind": "electronic", "standards": [{"name": "E2", "U": 3}, {"name": "F1"}]})",
        told);
    EXPECT_TRUE(told.empty());
    EXPECT_TRUE(read.calibrated);
    EXPECT_EQ(read.u, 0.5);
    EXPECT_EQ(read.range, (std::array<double, 2>{1.0, 2.0}));
    EXPECT_EQ(read.kind, "electronic");
    ASSERT_EQ(read.standards.size(), 2U);
    EXPECT_EQ(read.standards[0].U, 3.0);
    EXPECT_EQ(read.standards[1].name, "F1");
}

TEST(StructReader, LeavesWhatIsMissingAsItIs) {
    Told told;
    const Balance read = balance_of("{}", told);
    EXPECT_TRUE(told.empty());
    EXPECT_EQ(read.kind, "none");
    EXPECT_EQ(read.standards.size(), 1U);
}

/// One that tells every missing member, as the reader of records does.
class Demanding : public StructReader<Demanding, Step> {
public:
    Demanding(const nlohmann::json& object, Told& told) : StructReader(object, {}), told_(told) {}

private:
    friend StructReader<Demanding, Step>;
    static constexpr bool k_null_is_none = true;
    Told& told_;

    const nlohmann::json* find(std::string_view key) {
        if (!object_.contains(key)) {
            told_.push_back(std::string(key) + " missing");
        }
        return find_if_there(key);
    }
    void require(std::string_view) {}
    void unknown_key(const std::string& key) { told_.push_back(key + " unknown"); }
    void wrong_type(const nlohmann::json&, const std::string& expected, const Step&) { told_.push_back(expected); }
    void wrong_size(const nlohmann::json&, std::size_t, const Step&) {}
    template <class Rule>
    void read_value(const nlohmann::json& value, double& v, const Step&, const Rule&) {
        v = value.get<double>();
    }
    template <class Rule>
    void read_value(const nlohmann::json& value, std::string& v, const Step&, const Rule&) {
        v = value.get<std::string>();
    }
    template <class Struct>
    void read_struct(const nlohmann::json& object, Struct& v, const Step&) {
        Demanding inner(object, told_);
        describe(inner, v);
        inner.finish();
    }
};

TEST(StructReader, AStatedMemberMayBeMissingWithoutAWord) {
    const auto read = [](const char* text, Told& told) {
        const nlohmann::json object = nlohmann::json::parse(text);
        Balance balance;
        Demanding reader(object, told);
        describe(reader, balance);
        reader.finish();
        return balance.spare;
    };
    Told told;
    const std::string others = R"("calibrated": true, "u": 1, "range": [1, 2], "standards": [], "kind": "none")";
    EXPECT_FALSE(read(("{" + others + "}").c_str(), told));
    EXPECT_EQ(told, Told{});
    const std::optional<Standard> spare = read(("{" + others + R"(, "spare": {"name": "E2", "U": 3}})").c_str(), told);
    ASSERT_TRUE(spare);
    EXPECT_EQ(spare->name, "E2");
    EXPECT_EQ(told, Told{});
    (void)read("{}", told);
    EXPECT_EQ(told.size(), 5U) << "every other one is told";
}

TEST(StructReader, TellsEveryBreachWithItsPlace) {
    Told told;
    (void)balance_of(
        R"({"calibrated": 1, "u": -1, "range": [1], "kind": "x", "standards": [{"U": "3"}, 7, {"name": "", "a/b": 1}], "more": 0})",
        told);
    EXPECT_THAT(told, testing::ElementsAre("/calibrated not true or false", "/u negative", "/range not 2",
                                           "/standards/0/name missing", "/standards/0/U not a number",
                                           "/standards/1 not an object", "/standards/2/a~1b unknown",
                                           "/kind unknown word", "/more unknown"));
}

TEST(StructReader, LeavesNullToTheReader) {
    Told told;
    EXPECT_FALSE(balance_of<true>(R"({"u": null})", told).u);
    EXPECT_TRUE(told.empty());
    (void)balance_of<false>(R"({"u": null})", told);
    EXPECT_THAT(told, testing::ElementsAre("/u not a number"));
}

// A number that was refused while the text was read is not told of again.
TEST(StructReader, PassesOverDiscardedValues) {
    nlohmann::json object = {{"kind", 1}};
    object["kind"] = nlohmann::json(nlohmann::json::value_t::discarded);
    Told told;
    Balance balance;
    TestReader<true> reader(object, {}, told);
    describe(reader, balance);
    reader.finish();
    EXPECT_TRUE(told.empty());
    EXPECT_EQ(balance.kind, "none");
}

}  // namespace
}  // namespace gumcert::json
