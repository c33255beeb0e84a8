#include "jobs/job_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/jobs/described_sample.h"

namespace gumcert::jobs {
namespace {

using test::Sample;
using testing::ElementsAre;

TEST(JobFields, AreTheKeysInTheOrderOfTheDescription) {
    EXPECT_THAT(keys_of<Sample>(),
                ElementsAre("kind", "length_um", "count", "shape", "name", "file", "point_mm", "turns", "inner",
                            "outer", "entries", "by_name", "angles", "either", "shared", "all_shared", "pair", "rows",
                            "numbers", "computed", "label", "special"));
    EXPECT_THAT(keys_of<test::SampleEntry>(), ElementsAre("name"));
}

TEST(JobFields, GiveAnObjectForEachPart) {
    const JobKeyTable table(fields_of<Sample>());
    std::vector<std::string> pointers;
    for (const JobKeys& object : table.objects()) {
        pointers.emplace_back(object.pointer);
    }
    EXPECT_THAT(pointers,
                ElementsAre("", "/inner", "/outer", "/entries/*", "/by_name/*", "/either", "/shared", "/all_shared/*"));
    EXPECT_THAT(table.objects()[1].keys, ElementsAre("u", "v"));
}

TEST(JobFields, SayWhatAValueMayBe) {
    const JobFields& fields = fields_of<Sample>();
    const auto value = [&](std::string_view key) {
        for (const JobFields::Field& field : fields.fields) {
            if (field.key == key) {
                return field.value;
            }
        }
        return std::string("no such key");
    };
    EXPECT_EQ(value("kind"), "`sample`");
    EXPECT_EQ(value("length_um"), "a number greater than 0 µm and at most 5 µm");
    EXPECT_EQ(value("count"), "a whole number, at least 1 and at most 10");
    EXPECT_EQ(value("shape"), "`round` or `square`");
    EXPECT_EQ(value("name"), "one line of at most 256 bytes");
    EXPECT_EQ(value("file"), "the name of a file");
    EXPECT_EQ(value("point_mm"), "an array, 3 of them: each a number of mm");
    EXPECT_EQ(value("turns"), "`true` or `false`");
    EXPECT_EQ(value("inner"), "an object");
    EXPECT_EQ(value("entries"), "at most 3 objects");
    EXPECT_EQ(value("by_name"), "an object of objects");
    EXPECT_EQ(value("angles"), "an array, 1 to 4: each a number");
    EXPECT_EQ(value("either"), "an array, 1 to 4: each a number; or an object");
    EXPECT_EQ(value("shared"), "a number; or `round` or `square`; or an object");
    EXPECT_EQ(value("all_shared"), "an object with the name of a `file`; or an array of objects, at least 1");
    EXPECT_EQ(value("pair"), "an array: one line of at most 256 bytes, or a number; `null`");
    EXPECT_EQ(value("rows"), "an array, any number of them: each an array, at least 2: each a number");
    EXPECT_EQ(value("numbers"), "an object, under each name a number greater than 0; or `inf`");
    EXPECT_EQ(value("computed"), "a number greater than 0 and at most 1000");
    EXPECT_EQ(value("special"), "anything");
}

TEST(JobFields, HaveOneTableOfWordsForReadingAndRepeating) {
    EXPECT_EQ(word_of(test::k_sample_shapes, test::SampleShape::square), "square");
    constexpr Words<int, 1> k_one{{{"one", 1}}};
    EXPECT_EQ(word_of(k_one, 2), "");
    EXPECT_THAT(words_of(test::k_sample_shapes), ElementsAre("round", "square"));
}

}  // namespace
}  // namespace gumcert::jobs
