#include "audit/checklists.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(Checklists, have_ids_and_contributors_that_a_row_can_be) {
    std::set<std::string_view> ids;
    for (const MethodChecklist& checklist : method_checklists()) {
        EXPECT_TRUE(ids.insert(checklist.method).second) << checklist.method;
        EXPECT_FALSE(checklist.title.empty());
        EXPECT_FALSE(checklist.required.empty());
        for (const RequiredContributor& required : checklist.required) {
            EXPECT_FALSE(required.by.empty() && required.words.empty()) << required.name;
        }
        EXPECT_EQ(checklist_of(checklist.method), &checklist);
    }
    EXPECT_EQ(ids.size(), 9U);
    EXPECT_EQ(minimum_contributors().size(), 6U);
    EXPECT_EQ(checklist_of("unknown"), nullptr);
}

TEST(Checklists, know_their_method_by_its_title) {
    EXPECT_EQ(method_in_title("Uncertainty budget: rotary table"), "rotary_table_multilateration");
    EXPECT_EQ(method_in_title("Parallelendmaß im Vergleich"), "end_gauge_comparison");
    EXPECT_EQ(method_in_title("Bügelmessschraube, Messschraube 25 mm"), "caliper_micrometer");
    EXPECT_EQ(method_in_title("Messuhr"), "dial_indicator");
    EXPECT_EQ(method_in_title("weights F1"), "weights");
    EXPECT_EQ(method_in_title("viscosity"), "");
}

TEST(Checklists, accept_a_row_by_contributor_or_word) {
    const RequiredContributor buoyancy{"air buoyancy", {}, {"buoyancy", "auftrieb"}};
    AuditedRow row;
    row.contributor = Contributor::environment;
    EXPECT_FALSE(stands_for(row, buoyancy));
    row.comment = "Auftriebskorrektur";
    EXPECT_TRUE(stands_for(row, buoyancy));
    EXPECT_TRUE(stands_for(row, {"environment", {Contributor::environment}, {}}));
}

}  // namespace
}  // namespace gumcert::audit
