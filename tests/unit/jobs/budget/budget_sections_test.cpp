// Sections of a budget job: what the reader makes of them, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/evaluate_budget.h"
#include "jobs/budget/budget_job.h"
#include "jobs/input_codes.h"
#include "tests/support/budget_campaign.h"

namespace gumcert::jobs {
namespace {

using test::budget_refusals;
using test::read_budget;
using testing::ElementsAre;
using testing::IsEmpty;

const std::string k_inputs =
    R"j("inputs": {"V_x": {"unit": "V", "role": "indication"}, "V_s": {"unit": "V", "constant": true, "role": "reference"},
                   "R_x": {"unit": "ohm"}, "d": {"value": 0, "u": 0.001}})j";
const std::string k_voltage =
    R"j("DC": {"title": {"en": "DC voltage", "de": "Gleichspannung"}, "model": ["E = V_x*(1 + d) - V_s"],
        "outputs": {"E": {"unit": "mV", "role": "error"}},
        "points": {"columns": {"range": "text"},
                   "list": [{"V_x": {"value": 1, "u": 1e-6}, "V_s": 1, "range": "1 V"},
                            {"V_x": {"value": 2, "u": 1e-6}, "V_s": 2, "range": "10 V"}]}})j";
const std::string k_resistance =
    R"j("R": {"model": ["G = 1/(R_x*(1 + d))"],
        "points": {"columns": {"note": "text", "range": "text"},
                   "list": [{"R_x": {"value": 10, "u": 0.001}, "note": "warm"}, {"R_x": {"value": 20, "u": 0.002}, "range": "20 ohm"}]}})j";
const std::string k_constant = R"j("d alone": {"outputs": {"d": {}}})j";

std::string job_with(const std::vector<std::string>& sections) {
    std::string text = k_inputs + R"j(, "sections": {)j";
    for (std::size_t i = 0; i < sections.size(); ++i) {
        text += (i == 0 ? "" : ", ") + sections[i];
    }
    return text + "}";
}

std::vector<std::string> told(const std::string& keys) {
    std::vector<std::string> codes;
    for (const gum::Diagnostic& one : budget_refusals(keys)) {
        codes.push_back(one.code);
    }
    return codes;
}

TEST(BudgetSections, AreReadWithTheirPointsAndTables) {
    const BudgetJob job = read_budget(job_with({k_voltage, k_resistance, k_constant}));
    ASSERT_EQ(job.sections.size(), 3U);
    EXPECT_EQ(job.sections[0].points, 2U);
    EXPECT_EQ(job.sections[1].equations, 1U);
    EXPECT_EQ(job.sections[2].equations, 0U);
    EXPECT_EQ(job.sections[2].outputs, 1U);
    EXPECT_EQ(job.section_titles[0].in("de"), "Gleichspannung");
    EXPECT_TRUE(job.section_titles[1].empty());
    ASSERT_EQ(job.points.size(), 4U);
    EXPECT_EQ(job.points[2].name, "3") << "numbered through the job";
    ASSERT_EQ(job.tables.size(), 2U) << "one of each section that has points";
    EXPECT_EQ(job.tables[1].section, "R");
    std::vector<std::string> shown;
    for (const certificate::ShownColumn& column : job.tables[1].columns) {
        shown.push_back(column.show + ":" + column.of);
    }
    EXPECT_THAT(shown, ElementsAre("column:note", "value:G", "U:G")) << "nothing of the other section";
    const auto range = job.point_columns.front();
    EXPECT_THAT(range.printed, ElementsAre("1 V", "10 V", "", "20 ohm"));
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    EXPECT_THAT(gum::budget_result_names(job, result), ElementsAre("E[1]", "E[2]", "G[3]", "G[4]", "d"));
}

TEST(BudgetSections, ShareColumnsThatAreDeclaredAlike) {
    EXPECT_THAT(told(job_with({k_voltage, k_resistance})), IsEmpty());
    std::string other = k_resistance;
    other.replace(other.find(R"("range": "text")"), 15, R"("range": "ohm")");
    other.replace(other.find(R"("range": "20 ohm")"), 17, R"("range": 20)");
    EXPECT_THAT(told(job_with({k_voltage, other})), testing::Contains(k_point_column.code));
}

TEST(BudgetSections, AnInputIsStatedWhereItIsUsed) {
    const std::string silent =
        R"j("R": {"model": ["G = 1/R_x"], "points": {"list": [{"R_x": {"value": 10, "u": 0.1}}, {}]}})j";
    EXPECT_THAT(told(job_with({k_voltage, silent})), ElementsAre(k_no_statement.code));
    const std::string alone = R"j("R": {"model": ["G = 1/R_x"]})j";
    EXPECT_THAT(told(job_with({k_voltage, alone})), ElementsAre(k_no_statement.code))
        << "no points, and the job says nothing";
    EXPECT_THAT(told(job_with({k_voltage})), ElementsAre(k_no_statement.code)) << "R_x is stated nowhere";
}

/// A nominal value that no equation uses: what every point of a section states is kept, and printed there.
TEST(BudgetSections, KeepWhatTheirPointsStateForPrintOnly) {
    const std::string inputs = R"j("inputs": {"m_N": {"unit": "g", "constant": true, "role": "nominal"},
                                              "m": {"unit": "g"}, "c": {"unit": "g", "value": 1, "u": 0.1}})j";
    const std::string with = R"j(, "sections": {"load": {"model": ["E = m - c"], "points": [
        {"m_N": 50, "m": {"value": 50.1, "u": 0.1}}, {"m_N": 100, "m": {"value": 100.2, "u": 0.1}}],
        "tables": [{"columns": ["m_N", "E", "U"]}]},
        "zero": {"model": ["Z = c*2"], "outputs": {"Z": {}}}})j";
    const BudgetJob job = read_budget(inputs + with);
    const auto column = std::find_if(job.point_columns.begin(), job.point_columns.end(),
                                     [](const certificate::PointColumn& c) { return c.name == "m_N"; });
    ASSERT_NE(column, job.point_columns.end());
    EXPECT_THAT(column->values, ElementsAre(50.0, 100.0));
    // One point that leaves it open is told by its name.
    std::string half = inputs + with;
    half.replace(half.find(R"("m_N": 100, )"), 12, "");
    EXPECT_THAT(told(half), testing::Not(IsEmpty()));
}

TEST(BudgetSections, StandInPlaceOfWhatTheJobWouldHave) {
    for (const char* key : {R"("outputs": {"d": {}})", R"("points": [{"d": 1}])", R"("solve_for": {"z": {"start": 1}})",
                            R"("tables": [{}])"}) {
        EXPECT_THAT(told(job_with({k_voltage, k_resistance}) + ", " + key), testing::Contains(k_two_statements.code))
            << key;
    }
    EXPECT_THAT(told(k_inputs + R"j(, "sections": {})j"), testing::Contains(k_wrong_size.code));
    EXPECT_THAT(told(k_inputs + R"j(, "sections": [])j"), testing::Contains(k_wrong_type.code));
    EXPECT_THAT(told(job_with({k_voltage, R"("R": 1)"})), testing::Contains(k_wrong_type.code));
}

/// An equation beside the sections is as if it stood in each that rests on it.
TEST(BudgetSections, ShareEquations) {
    const std::string voltage =
        R"j("DC": {"model": ["E = V_x*(1 + c) - V_s"], "points": [{"V_x": {"value": 1, "u": 1e-6}, "V_s": 1}]})j";
    const std::string resistance =
        R"j("R": {"model": ["G = 1/(R_x*(1 + c))"], "points": [{"R_x": {"value": 10, "u": 0.001}}]})j";
    const auto with = [](const std::string& section, const std::string& equations) {
        return section.substr(0, section.find('[') + 1) + equations + section.substr(section.find('[') + 1);
    };
    const std::string equations = R"("c = 2*b", "b = d + 0")";
    const BudgetJob shared = read_budget(job_with({voltage, resistance}) + R"(, "model": [)" + equations + "]");
    const BudgetJob written =
        read_budget(job_with({with(voltage, equations + ", "), with(resistance, equations + ", ")}));
    ASSERT_EQ(shared.sections.size(), 2U);
    EXPECT_EQ(shared.sections[1].equations, 3U);
    ASSERT_EQ(shared.model.size(), written.model.size());
    for (std::size_t i = 0; i < shared.model.size(); ++i) {
        EXPECT_EQ(shared.model[i].text, written.model[i].text);
    }
    const gum::BudgetResult a = gum::evaluate_budget(shared, 1);
    const gum::BudgetResult b = gum::evaluate_budget(written, 1);
    EXPECT_THAT(gum::budget_result_names(shared, a), ElementsAre("E[1]", "G[2]"));
    EXPECT_EQ(gum::budget_result_names(written, b), gum::budget_result_names(shared, a));
    EXPECT_NE(gum::budget_covariance(a)(0, 1), 0.0) << "d is one quantity";
    EXPECT_EQ(gum::budget_covariance(a)(0, 1), gum::budget_covariance(b)(0, 1));
    // A section takes what it uses only; its results may name it.
    const BudgetJob one = read_budget(
        job_with({voltage, R"j("R": {"model": ["G = R_x"], "points": [{"R_x": {"value": 10, "u": 0.001}}]})j",
                  R"j("b alone": {"outputs": {"b": {}}})j"}) +
        R"(, "model": [)" + equations + "]");
    EXPECT_EQ(one.sections[1].equations, 1U);
    EXPECT_EQ(one.sections[2].equations, 1U);
}

TEST(BudgetSections, RefuseEquationsThatTheyCannotShare) {
    const std::string sections = job_with({k_voltage, k_resistance});
    EXPECT_THAT(told(sections + R"(, "model": ["y = d"])"), ElementsAre(k_shared_equation.code)) << "nobody uses it";
    EXPECT_THAT(told(sections + R"(, "model": ["0 = d - z"])"), ElementsAre(k_shared_equation.code));
    EXPECT_THAT(told(sections + R"(, "model": ["E = d"])"), testing::Contains(k_name_of_two.code));
    EXPECT_THAT(told(sections + R"(, "model": ["y = = d"])"), testing::SizeIs(1));
    EXPECT_THAT(told(sections + R"(, "model": 1)"), ElementsAre(k_wrong_type.code));
}

TEST(BudgetSections, AreThoseOfBudgets) {
    EXPECT_THAT(told(job_with({k_voltage, k_resistance, R"j("turn": {"kind": "rotary_table", "file": "turn.json"})j"})),
                ElementsAre(k_sections_of_other_kind.code));
}

TEST(BudgetSections, AreRefusedWhereOneSetOfResultsIsExpected) {
    const MemoryFileSource files({{"job.json", test::budget_text(job_with({k_voltage, k_resistance}))},
                                  {"one.json", test::budget_text(R"("inputs": {"d": {"value": 1, "u": 0.1}})")}});
    EXPECT_EQ(read_undivided_budget_job(files, "one.json").inputs.size(), 1U);
    try {
        (void)read_undivided_budget_job(files, "job.json");
        FAIL() << "sections are accepted";
    } catch (const gum::InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, k_sections_of_budget.code);
    }
}

TEST(BudgetSections, HaveResultsOfDifferentNamesAndNameThemWithoutAModel) {
    const std::string twin = R"j("AC": {"model": ["E = R_x"], "points": [{"R_x": {"value": 1, "u": 0.1}}]})j";
    EXPECT_THAT(told(job_with({k_voltage, twin})), ElementsAre(k_name_of_two.code));
    EXPECT_THAT(told(job_with({k_voltage, k_resistance, R"j("nothing": {})j"})),
                ElementsAre(k_nothing_to_evaluate.code));
    EXPECT_THAT(told(job_with({k_voltage, k_resistance, R"j("nothing": {"outputs": {"x": {}}})j"})),
                ElementsAre(k_output_unknown.code));
}

}  // namespace
}  // namespace gumcert::jobs
