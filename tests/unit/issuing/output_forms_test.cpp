#include "issuing/output_forms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "issuing/issue_documents.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::issuing {
namespace {

using reports::EvaluationRecord;

IssueOptions options_without_signer() {
    IssueOptions options;
    options.assets = reports::assets();
    return options;
}

EvaluationRecord record_of_kind(const std::string& kind) {
    EvaluationRecord record;
    record.kind = kind;
    return record;
}

TEST(OutputForms, HaveANameAndAnEndingOfTheirOwn) {
    std::set<std::string_view> names;
    std::set<std::string_view> endings;
    for (const OutputForm& form : output_forms()) {
        EXPECT_TRUE(names.insert(form.name).second) << form.name;
        EXPECT_TRUE(endings.insert(form.ending).second) << form.name;
        EXPECT_TRUE(form.ending.starts_with('.') || form.ending.starts_with('-'));
        EXPECT_EQ(&output_form(form.name), &form);
    }
    EXPECT_THAT(names, testing::ElementsAre("csv", "dcc", "html", "label", "label-svg", "pdf", "report", "report-html",
                                            "text"));
    EXPECT_THROW((void)output_form("odt"), std::invalid_argument);
}

TEST(OutputForms, OfEveryKindAreInTheTable) {
    for (const evaluation::Kind& kind : evaluation::program_kinds()) {
        for (const std::string_view form : kind.forms) {
            EXPECT_NO_THROW((void)output_form(form)) << kind.word;
        }
    }
}

TEST(OutputForms, OfOneIssueAreThoseOfEachAlone) {
    const EvaluationRecord record = test::certified_budget_record();
    const IssueOptions options = options_without_signer();
    Issue issue(record, options);
    for (int time = 0; time < 2; ++time) {  // what they show is put together once, and no form changes it
        EXPECT_EQ(output_form("html").render(issue), reports::render_html(record, options.assets));
        EXPECT_EQ(output_form("text").render(issue), reports::render_text(record, options.assets));
    }
}

TEST(OutputForms, RefuseWhatTheyDoNotApplyTo) {
    const IssueOptions options = options_without_signer();
    const auto code_of = [&](const EvaluationRecord& record, const char* form) -> std::string {
        try {
            (void)issue_document(record, form, options);
        } catch (const gum::InputError& refused) {
            return refused.diagnostics().front().code;
        }
        return "";
    };
    EXPECT_EQ(code_of(record_of_kind("comparison"), "dcc"), "GC-REPORT-0041");
    EXPECT_EQ(code_of(record_of_kind("budget"), "csv"), "GC-REPORT-0040");
    EvaluationRecord comparison = record_of_kind("comparison");
    comparison.comparison.emplace();
    EXPECT_EQ(code_of(comparison, "report-html"), "GC-REPORT-0042");
    EXPECT_EQ(code_of(record_of_kind("comparison"), "label-svg"), "GC-REPORT-0043");
    EXPECT_EQ(code_of(test::certified_budget_record(), "label-svg"), "");
    EXPECT_EQ(code_of(test::certified_budget_record(), "text"), "");
    EXPECT_EQ(code_of(test::certified_budget_record(), "report-html"), "");
}

}  // namespace
}  // namespace gumcert::issuing
