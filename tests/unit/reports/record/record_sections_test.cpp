#include "reports/record/record_sections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

using testing::ElementsAre;

EvaluationRecord two_sections() {
    EvaluationRecord record;
    record.model = ModelSummary{.equations = {"a = x", "y = a + 1", "z = x^2"}, .unknowns = {}};
    record.sections = {{.name = "first", .title = {}, .equations = 2, .quantities = {"y"}},
                       {.name = "constants", .title = {}, .quantities = {"x"}},
                       {.name = "second", .title = {}, .equations = 1, .quantities = {"z"}}};
    return record;
}

TEST(RecordSections, HaveTheirEquations) {
    const EvaluationRecord record = two_sections();
    EXPECT_THAT(equations_of(record, "y"), ElementsAre("a = x", "y = a + 1"));
    EXPECT_THAT(equations_of(record, "x"), testing::IsEmpty());
    EXPECT_THAT(equations_of(record, "z"), ElementsAre("z = x^2"));
    EXPECT_EQ(section_of(record, "z")->name, "second");
}

TEST(RecordSections, AreCalledByTheirTitlesOrTheirNames) {
    SectionSummary section;
    section.name = "dc";
    EXPECT_EQ(title_of(section).in("de"), "dc");
    section.title = "Direct voltage";
    EXPECT_EQ(title_of(section).in("de"), "Direct voltage");
}

TEST(RecordSections, TheTitleIsInTheLanguagesOfTheJob) {
    EvaluationRecord record;
    record.title = "Multimeter";
    EXPECT_EQ(title_of(record), certificate::LocalisedText("Multimeter"));
    record.title_by_language.by_language = {{"en", "Multimeter"}, {"es", "Multímetro"}};
    EXPECT_EQ(title_of(record).in("es"), "Multímetro");
}

TEST(RecordSections, ARecordWithoutThemIsOne) {
    EvaluationRecord record = two_sections();
    record.sections.clear();
    EXPECT_EQ(equations_of(record, "z").size(), 3U);
    EXPECT_EQ(section_of(record, "z"), nullptr);
    record.model.reset();
    EXPECT_THAT(equations_of(record, "z"), testing::IsEmpty());
}

}  // namespace
}  // namespace gumcert::reports
