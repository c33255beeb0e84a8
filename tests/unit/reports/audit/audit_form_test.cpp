#include "reports/audit/audit_form.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "reports/audit/audit_json.h"
#include "reports/audit/audit_sarif.h"
#include "tests/support/sample_audit.h"

namespace gumcert::reports {
namespace {

TEST(AuditForm, IsFoundByItsNameAndByTheEndingOfAFile) {
    for (const AuditForm& form : audit_forms()) {
        EXPECT_EQ(&audit_form(form.name), &form);
        EXPECT_EQ(audit_form_of(form.file), &form) << form.file;
    }
    EXPECT_EQ(audit_form_of("budget.txt"), &audit_form("text")) << "its file ends so, whatever its name";
    EXPECT_EQ(audit_form_of("budget.text"), &audit_form("text"));
    EXPECT_EQ(audit_form_of("budget.doc"), nullptr);
    EXPECT_EQ(audit_form_of("json"), nullptr);
    EXPECT_EQ(audit_form_of(".json"), nullptr) << "a hidden file without an ending";
    EXPECT_THROW((void)audit_form("txt"), std::invalid_argument);
    EXPECT_THROW((void)audit_form(""), std::invalid_argument);
}

TEST(AuditForm, WritesWhatItsNameSaysAndAsksForTemplatesOnlyWherePeopleRead) {
    const std::vector<audit::Rule> rules = test::sample_rules();
    const std::vector<audit::AuditReport> reports = {test::sample_audit()};
    const AuditView view = make_audit_view(reports, rules, {.program = "gumcert 0.1.0"});
    const AuditWriting with{.rules = rules, .assets = []() -> RenderAssets { throw std::logic_error("asked"); }};
    EXPECT_EQ(audit_form("json").write(view, with), audit_as_json(view));
    EXPECT_EQ(audit_form("sarif").write(view, with), audit_as_sarif(view, rules));
    for (const std::string_view name : {"text", "html", "pdf"}) {
        EXPECT_THROW((void)audit_form(name).write(view, with), std::logic_error) << name;
    }
    EXPECT_FALSE(audit_form("text").needs_file);
    EXPECT_TRUE(audit_form("html").needs_file && audit_form("pdf").needs_file);
}

}  // namespace
}  // namespace gumcert::reports
