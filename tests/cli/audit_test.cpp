// The audit as a user meets it: tables, workbooks, jobs, records and folders; forms and places; exit codes.
#include <functional>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"
#include "tests/support/json_schema.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

fs::path audited_example(const std::string& file) {
    return fs::path(GUMCERT_SOURCE_DIR) / "examples" / "audit" / file;
}

/// A sound budget: nothing in it is critical.
constexpr const char* k_sound =
    "quantity,estimate,unit,u,distribution,sensitivity,contribution,nu,source\n"
    "length of the standard,100.0002,mm,0.00020,normal,1,0.00020,60,certificate K 123\n"
    "drift of the standard,0,mm,0.00010,rectangular,1,0.00010,inf,history\n"
    "resolution of the item,0,mm,0.00029,rectangular,1,0.00029,inf,\n"
    "u_c,,mm,0.00037\nnu_eff,,,700\nk,,,2\nU,,mm,0.00073\ncoverage probability,95.45 %\n";

class AuditProgram : public ProgramTest {
protected:
    [[nodiscard]] Ended audit(std::vector<std::string> words) const {
        words.insert(words.begin(), "audit");
        words.insert(words.end(), {"--share", GUMCERT_SOURCE_DIR});
        return gumcert(words);
    }
    [[nodiscard]] json audit_json(const fs::path& file) const {
        return json::parse(audit({file.string(), "--format", "json"}).out);
    }
    static const json* finding(const json& report, const std::string& id) {
        for (const json& one : report["findings"]) {
            if (one["id"] == id) {
                return &one;
            }
        }
        return nullptr;
    }
};

TEST_F(AuditProgram, FindsWhatIsWrongWithTheBudgetOfThePaper) {
    for (const char* const name : {"budget.csv", "budget.xlsx", "budget.json"}) {
        const fs::path file = audited_example("paper_fixture_budget") / name;
        const json report = audit_json(file);
        const json* mpe = finding(report, "U10");
        ASSERT_NE(mpe, nullptr) << name;
        EXPECT_LT((*mpe)["effect"]["alone"]["U"].get<double>(), report["claimed"]["U"].get<double>()) << name;
        const json* exponent = finding(report, "S15");
        ASSERT_NE(exponent, nullptr) << name;
        EXPECT_EQ((*exponent)["severity"], "critical") << name;
        for (const char* const missing : {"B01", "B02", "U09"}) {
            EXPECT_NE(finding(report, missing), nullptr) << name << " " << missing;
        }
    }
    // The program adds up its own rows; the table of the paper drops a term.
    const json table = audit_json(audited_example("paper_fixture_budget") / "budget.csv");
    ASSERT_NE(finding(table, "K01"), nullptr);
    EXPECT_NEAR(table["recomputed"]["u_c"].get<double>(), 0.4459, 1e-4);
    EXPECT_EQ(table["claimed"]["u_c"], 0.413);
}

TEST_F(AuditProgram, ExitCodeSaysWhetherAFindingIsCritical) {
    write_bytes(folder() / "sound.csv", k_sound);
    const Ended sound = audit({(folder() / "sound.csv").string()});
    EXPECT_EQ(sound.code, 0) << sound.out << sound.err;
    EXPECT_EQ(audit({audited_example("paper_fixture_budget/budget.csv").string()}).code, 1);
    write_bytes(folder() / "picture.pdf", "%PDF-1.7\n");
    const Ended refused = audit({(folder() / "picture.pdf").string()});
    EXPECT_EQ(refused.code, 3);
    EXPECT_NE(refused.err.find("GC-AUDIT-0011"), std::string::npos) << refused.err;
}

TEST_F(AuditProgram, WritesAllFormsIntoAFolder) {
    const Ended ended =
        audit({audited_example("paper_fixture_budget/budget.csv").string(), "-o", (folder() / "out").string()});
    EXPECT_EQ(ended.code, 1) << ended.err;
    for (const char* const name : {"audit.txt", "audit.json", "audit.sarif", "audit.html", "audit.pdf"}) {
        EXPECT_TRUE(fs::exists(folder() / "out" / name)) << name;
    }
    const json report = json::parse(bytes_of(folder() / "out" / "audit.json"));
    EXPECT_EQ(test::JsonSchema("audit-1.schema.json").refusals(report), "");
    EXPECT_EQ(report["schema"], "gumcert/audit/1");
    EXPECT_EQ(json::parse(bytes_of(folder() / "out" / "audit.sarif"))["version"], "2.1.0");
    EXPECT_TRUE(bytes_of(folder() / "out" / "audit.pdf").starts_with("%PDF-"));
}

TEST_F(AuditProgram, TheEndingOfAFileSaysItsForm) {
    const fs::path page = folder() / "page.html";
    (void)audit({audited_example("paper_fixture_budget/budget.csv").string(), "-o", page.string(), "--language", "de"});
    EXPECT_NE(bytes_of(page).find("lang=\"de\""), std::string::npos);
    EXPECT_NE(bytes_of(page).find("Größte zulässige Messabweichung als Standardunsicherheit verwendet"),
              std::string::npos)
        << "titles of rules are in the language of the page";
}

TEST_F(AuditProgram, AFolderIsAuditedFileByFile) {
    write_bytes(folder() / "budgets" / "a.csv", k_sound);
    write_bytes(folder() / "budgets" / "b" / "c.csv", k_sound);
    const Ended ended = audit({(folder() / "budgets").string(), "--format", "json"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(json::parse(ended.out)["files"].size(), 2U);
    fs::create_directory(folder() / "empty");
    EXPECT_EQ(audit({(folder() / "empty").string()}).code, 3);
}

TEST_F(AuditProgram, EveryFormBeginsWithTheFilesThatHaveNoAudit) {
    write_bytes(folder() / "budgets" / "a.csv", k_sound);
    write_bytes(folder() / "budgets" / "b.csv", k_sound);
    write_bytes(folder() / "budgets" / "broken.xlsx", "PK\x03\x04 nothing");
    write_bytes(folder() / "budgets" / "letter.docx", "words");
    const Ended ended = audit({(folder() / "budgets").string(), "-o", (folder() / "out").string()});
    EXPECT_EQ(ended.code, 3) << ended.err;
    for (const char* const name : {"audit.txt", "audit.json", "audit.sarif", "audit.html"}) {
        const std::string form = bytes_of(folder() / "out" / name);
        for (const char* const file : {"broken.xlsx", "letter.docx"}) {
            EXPECT_NE(form.find(file), std::string::npos) << name << " " << file;
        }
    }
    const std::string page = bytes_of(folder() / "out" / "audit.html");
    EXPECT_LT(page.find("broken.xlsx"), page.find("a.csv"));
    const json report = json::parse(bytes_of(folder() / "out" / "audit.json"));
    EXPECT_EQ(test::JsonSchema("audit-1.schema.json").refusals(report), "");
    EXPECT_EQ(report["unaudited"].size(), 2U);
}

TEST_F(AuditProgram, ARecordIsHeldAgainstItsOwnJob) {
    const fs::path record = folder() / "record.json";
    ASSERT_EQ(gumcert({"evaluate", (fs::path(GUMCERT_SOURCE_DIR) / "examples/gauge_block/job.json").string(), "-o",
                       record.string(), "--share", GUMCERT_SOURCE_DIR})
                  .code,
              0);
    const json whole = audit_json(record);
    EXPECT_EQ(finding(whole, "P01"), nullptr);
    EXPECT_TRUE(whole["not_read"].empty()) << whole["not_read"];
    json changed = json::parse(bytes_of(record));
    json& result = changed["results"].begin().value();
    result["u"] = result["u"].get<double>() * 0.5;
    write_bytes(record, changed.dump());
    EXPECT_EQ(audit({record.string()}).code, 3) << "its digest is that of other contents";
    changed.erase("digest");
    write_bytes(record, changed.dump());
    EXPECT_NE(audit_json(record)["not_read"].dump().find("was not held against its own job"), std::string::npos);
}

TEST_F(AuditProgram, OfAJobAndItsRecordInAFolderTheRecordIsAudited) {
    const fs::path budgets = folder() / "budgets", job = budgets / "job.json";
    fs::create_directories(budgets / "out");
    fs::copy_file(fs::path(GUMCERT_SOURCE_DIR) / "examples/gauge_block/job.json", job);
    const auto audited_files = [&] {
        const Ended ended = audit({budgets.string(), "--format", "json"});
        const json report = json::parse(ended.out);
        std::string names = ended.err.find("GC-AUDIT-0013") == std::string::npos ? "" : "told: ";
        for (const json& file : report.contains("files") ? report["files"] : json::array({report})) {
            names += file["file"].get<std::string>() + " ";
        }
        return names;
    };
    EXPECT_EQ(audited_files(), "budgets/job.json ");
    ASSERT_EQ(gumcert({"evaluate", job.string(), "-o", (budgets / "out" / "record.json").string(), "--share",
                       GUMCERT_SOURCE_DIR})
                  .code,
              0);
    EXPECT_EQ(audited_files(), "told: budgets/out/record.json ");
    const json named =
        json::parse(audit({job.string(), (budgets / "out" / "record.json").string(), "--format", "json"}).out);
    EXPECT_EQ(named["files"].size(), 2U) << "both are named";
    // A job that was changed since is another job.
    write_bytes(job, bytes_of(job) + "\n");
    EXPECT_EQ(audited_files(), "budgets/job.json budgets/out/record.json ");
}

TEST_F(AuditProgram, AnErrorIsHeldAgainstTheScopeWhereItWasMeasured) {
    const fs::path everyday = fs::path(GUMCERT_SOURCE_DIR) / "examples" / "everyday";
    for (const char* const name : {"gauge_blocks", "mass_set", "multimeter", "torque_wrench"}) {
        EXPECT_EQ(finding(audit_json(everyday / name / "job.json"), "X02"), nullptr) << name;
    }
    // The scope of the multimeter, whose errors of some microvolts were measured from 10 mV to 100 V.
    const auto found_with = [&](const std::function<void(json&)>& change) {
        fs::copy(everyday / "multimeter", folder() / "multimeter",
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        const fs::path file = folder() / "multimeter" / "certificate.json";
        json data = json::parse(bytes_of(file));
        data["accreditation"].erase("symbol_file");  // it lies elsewhere
        change(data);
        write_bytes(file, data.dump());
        const json report = audit_json(folder() / "multimeter" / "job.json");
        std::string scope;
        for (const json& one : report["findings"]) {
            const auto text = one["what"].get<std::string>();
            if (one["id"] == "X02" || text.find("outside of the accreditation") != std::string::npos) {
                scope += one["severity"].get<std::string>() + ": " + text;
            }
        }
        return scope;
    };
    const auto of_value = [](double high) {
        return [high](json& data) {
            json& entry = data["accreditation"]["scope"][0];
            entry["ranges"][0] = {
                {"argument", {{"name", "V"}, {"unit", "V"}, {"of", "value"}}}, {"low", -high}, {"high", high}};
            entry["capability"]["arguments"][0]["of"] = "value";
        };
    };
    EXPECT_EQ(found_with([](json&) {}), "");
    EXPECT_EQ(found_with(of_value(1000.0)), "") << "the value of an error is that of its point";
    EXPECT_NE(found_with(of_value(50.0)).find("V = 100 V is not in -50 V to 50 V"), std::string::npos);
    const std::string elsewhere = found_with([](json& data) {
        data["parameters"] = json::array({{{"name", "nominal"}, {"unit", "V"}, {"value", 0.5}}});
        data["accreditation"]["scope"][0]["ranges"][0]["argument"]["of"] = "nominal";
        data["accreditation"]["scope"][0]["ranges"][0]["high"] = 1;
        data["accreditation"]["scope"][0]["ranges"][0]["low"] = -1;
    });
    EXPECT_TRUE(elsewhere.starts_with("critical")) << elsewhere;
    EXPECT_NE(elsewhere.find("was measured at \"V_s\""), std::string::npos) << elsewhere;
}

TEST_F(AuditProgram, WaiversAreShownAndDecideOnTheExitCode) {
    const fs::path table = audited_example("paper_fixture_budget/budget.csv");
    json waivers = json::array();
    const json report = audit_json(table);
    for (const json& one : report["findings"]) {
        if (one["severity"] == "critical") {
            waivers.push_back({{"finding", one["id"]},
                               {"by", "Head of laboratory"},
                               {"date", "2026-11-20"},
                               {"reason", "The table is that of a published paper, and is not used."}});
        }
    }
    ASSERT_FALSE(waivers.empty());
    const fs::path file = folder() / "waivers.json";
    write_bytes(file, waivers.dump());
    const Ended accepted = audit({table.string(), "--waivers", file.string()});
    EXPECT_EQ(accepted.code, 0) << accepted.err;
    EXPECT_NE(accepted.out.find("Head of laboratory"), std::string::npos);
    waivers[0]["by"] = "-";
    write_bytes(file, waivers.dump());
    const Ended refused = audit({table.string(), "--waivers", file.string()});
    EXPECT_EQ(refused.code, 3);
    EXPECT_NE(refused.err.find("GC-AUDIT-0012"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("names nobody"), std::string::npos) << refused.err;
    waivers[0]["by"] = "Head of laboratory";
    waivers[0]["reason"] = "OK";
    write_bytes(file, waivers.dump());
    EXPECT_NE(audit({table.string(), "--waivers", file.string()}).err.find("a reason that tells nothing: \"OK\""),
              std::string::npos);
    write_bytes(file, "{}");
    EXPECT_EQ(audit({table.string(), "--waivers", file.string()}).code, 3);
}

TEST_F(AuditProgram, RunAuditsTheJobAndWritesThePage) {
    const fs::path job = audited_example("paper_fixture_budget/budget.json");
    const Ended ended =
        gumcert({"evaluate", job.string(), "-o", (folder() / "record.json").string(), "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(ended.code, 1) << "S15 is critical";
    EXPECT_NE(ended.err.find("GC-AUDIT-0020"), std::string::npos) << ended.err;
    const json record = json::parse(bytes_of(folder() / "record.json"));
    EXPECT_NE(finding(record["audit"], "S15"), nullptr);
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf();
    }
    EXPECT_EQ(run(job, folder() / "out").code, 1);
    EXPECT_NE(bytes_of(folder() / "out" / "audit.html").find("S15"), std::string::npos);
    EXPECT_EQ(json::parse(bytes_of(folder() / "out" / "record.json"))["audit"], record["audit"]);
}

TEST_F(AuditProgram, ReadsACertificateAndTheOneInItsPdf) {
    const fs::path out = folder() / "certificate";
    ASSERT_EQ(gumcert({"run", (fs::path(GUMCERT_SOURCE_DIR) / "examples/certificate/end_gauge.json").string(), "-o",
                       out.string(), "--share", GUMCERT_SOURCE_DIR, "-q"})
                  .code,
              0);
    const json of_xml = audit_json(out / "certificate.xml"), of_pdf = audit_json(out / "certificate.pdf");
    EXPECT_EQ(of_xml["kind"], "certificate");
    EXPECT_EQ(of_xml["findings"], json::array()) << of_xml["findings"].dump(1);
    EXPECT_EQ(of_xml["claimed"]["k"], 2.13);
    EXPECT_EQ(of_pdf["results"], of_xml["results"]);
    // In a folder the PDF is the same certificate again.
    fs::remove(out / "record.json");
    const json folder_of_both = json::parse(audit({out.string(), "--format", "json"}).out);
    EXPECT_EQ(folder_of_both["file"], "certificate/certificate.xml");
    EXPECT_FALSE(folder_of_both.contains("files")) << "one file";
    std::string planted = bytes_of(out / "certificate.xml");
    const std::string k = "<si:coverageFactor>2.13</si:coverageFactor>";
    ASSERT_NE(planted.find(k), std::string::npos);
    planted.replace(planted.find(k), k.size(), "<si:coverageFactor>1.80</si:coverageFactor>");
    write_bytes(out / "planted.xml", planted);
    EXPECT_EQ(finding(audit_json(out / "planted.xml"), "K03"), nullptr) << "its distribution has a k of its own";
    const std::string begin = "<si:distribution>";
    const std::size_t name = planted.find(begin) + begin.size();
    ASSERT_LT(begin.size(), name);
    planted.replace(name, planted.find('<', name) - name, "normal");
    write_bytes(out / "planted.xml", planted);
    EXPECT_NE(finding(audit_json(out / "planted.xml"), "K03"), nullptr);
}

TEST_F(AuditProgram, SameFileSameBytes) {
    const std::vector<std::string> words = {audited_example("planted_workbook/planted.xlsx").string(), "--format",
                                            "json"};
    EXPECT_EQ(audit(words).out, audit(words).out);
}

TEST_F(AuditProgram, HelpNamesTheColumns) {
    const Ended help = gumcert({"audit", "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("quantity, estimate, unit, u, divisor"), std::string::npos);
}

/// The audit for programs needs no templates and no page: it is there whatever else fails.
TEST_F(AuditProgram, IsKeptForProgramsWhenAnotherFormCannotBeMade) {
    if (const std::string reason = why_no_pdf(); !reason.empty()) {
        GTEST_SKIP() << reason;
    }
    const fs::path table = folder() / "budget.csv";
    std::string text = k_sound;
    text.replace(text.find("drift of the standard"), 5, "\U0001F600");
    write_bytes(table, text);
    const fs::path out = folder() / "out";
    const Ended before = gumcert({"audit", table.string(), "-o", out.string(), "--share", GUMCERT_SOURCE_DIR},
                                 {.environment = {{"TMPDIR", "/proc"}}});
    EXPECT_EQ(before.code, 5) << before.err;
    EXPECT_FALSE(fs::exists(out));
    const Ended failed = audit({table.string(), "-o", out.string()});
    EXPECT_EQ(failed.code, 5) << failed.err;
    EXPECT_LT(failed.err.find("[GC-STORE-0022]"), failed.err.find("[GC-REPORT-0011]")) << failed.err;
    EXPECT_EQ(json::parse(bytes_of(out / "record-kept" / "audit.json"))["schema"], "gumcert/audit/1");
    EXPECT_FALSE(fs::exists(out / "audit.html")) << "all forms or none";
}

}  // namespace
}  // namespace gumcert::cli
