#include "reports/record/make/certificate/amended_record.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
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
