// The archive as a laboratory uses it: from the record to the issued certificate, its amendment, its evidence.
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <csignal>

#include <algorithm>
#include <chrono>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

bool tells(const Ended& ended, const std::string& part) {
    return (ended.out + ended.err).find(part) != std::string::npos;
}

// As the certificate data of the example name them.
constexpr const char* k_reviewer = "Reviewer 1";
constexpr const char* k_authoriser = "Head of laboratory";

class ArchiveOfALaboratory : public ProgramTest {
protected:
    ArchiveOfALaboratory() {
        fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "certificate", folder(),
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder() / name).string(); }
    [[nodiscard]] std::string store() const { return path("lab.archive"); }

    /// `gumcert archive` on the store of the test.
    Ended archive(std::vector<std::string> words, const std::string& by = "") const {
        words.insert(words.begin(), "archive");
        words.insert(words.end(), {"--store", store(), "--share", GUMCERT_SOURCE_DIR});
        if (!by.empty()) {
            words.insert(words.end(), {"--by", by});
        }
        return gumcert(words);
    }
    void begin(std::vector<std::string> more = {}) const {
        more.insert(more.begin(), "init");
        const Ended ended = archive(more, "K. Keeper");
        ASSERT_EQ(ended.code, 0) << ended.err;
    }
    /// Record, digital certificate and HTML of the job as it stands, under a name.
    void evaluate(const std::string& name) const {
        const std::string record = path((name + ".json").c_str());
        Ended ended = gumcert({"evaluate", path("end_gauge.json"), "-o", record, "--share", GUMCERT_SOURCE_DIR, "-q"});
        ASSERT_EQ(ended.code, 0) << ended.err;
        for (const auto& [form, ending] : {std::pair("dcc", ".xml"), std::pair("html", ".html")}) {
            ended = gumcert({"render", record, "--format", form, "-o", path((name + ending).c_str()), "--share",
                             GUMCERT_SOURCE_DIR, "-q"});
            ASSERT_EQ(ended.code, 0) << ended.err;
        }
    }
    [[nodiscard]] std::vector<std::string> files(const std::string& action, const std::string& name) const {
        return {action, path((name + ".json").c_str()), path((name + ".xml").c_str()), path((name + ".html").c_str())};
    }
    void change_certificate(const std::function<void(json&)>& change) const {
        change_json(folder() / "end_gauge_certificate.json", change);
    }
    void lead_to_issue(const std::string& number) const {
        for (const auto& [action, by] :
             {std::pair("review", k_reviewer), {"authorise", k_authoriser}, {"issue", "M. Weber"}}) {
            const Ended ended = archive({action, number}, by);
            ASSERT_EQ(ended.code, 0) << ended.err;
        }
    }
    void issue_the_example() const {
        begin();
        evaluate("first");
        const Ended added = archive(files("add", "first"), "R. Lin");
        ASSERT_EQ(added.code, 0) << added.err;
        lead_to_issue("EX-2026-0042");
    }
    [[nodiscard]] json shown(std::vector<std::string> words) const {
        words.insert(words.end(), {"--format", "json"});
        const Ended ended = archive(words);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return json::parse(ended.out, nullptr, false);
    }
    /// The second verifier.
    [[nodiscard]] Ended verified_elsewhere(std::vector<std::string> words) const {
        words.insert(words.begin(), {"-B", (fs::path(GUMCERT_SOURCE_DIR) / "tools" / "verify_archive.py").string()});
        return run_process("/usr/bin/python3", words, {}, folder());
    }
};

TEST_F(ArchiveOfALaboratory, LeadsFromTheRecordToTheIssuedCertificate) {
    issue_the_example();
    const json list = shown({"list"});
    ASSERT_EQ(list["certificates"].size(), 1U);
    EXPECT_EQ(list["certificates"][0]["state"], "issued");
    EXPECT_NE(archive({"list"}).out.find("EX-2026-0042              issued"), std::string::npos);
    EXPECT_EQ(shown({"list", "ex-2026", "ISSUED"})["certificates"].size(), 1U);
    EXPECT_EQ(shown({"list", "ex-2026", "drafted"})["certificates"].size(), 0U);
    const json one = shown({"show", "EX-2026-0042"});
    EXPECT_EQ(one["documents"].size(), 2U);
    EXPECT_EQ(one["entries"].size(), 4U);
    EXPECT_EQ(one["entries"][0]["by"], "R. Lin");
    EXPECT_EQ(one["entries"][3]["body"]["old"]["state"], "authorised");
    EXPECT_TRUE(tells(archive({"show", "EX-2026-0042"}), "authorised  Head of laboratory"));
    const Ended verified = archive({"verify"});
    EXPECT_EQ(verified.code, 0) << verified.err;
    EXPECT_TRUE(tells(verified, "sound; 5 entries, 3 contents, 1 certificate,"));
    EXPECT_EQ(verified_elsewhere({store()}).code, 0);
}

TEST_F(ArchiveOfALaboratory, SaysThatThereIsNone) {
    for (const char* const action : {"list", "verify", "head", "replay"}) {
        const Ended ended = archive({action});
        EXPECT_EQ(ended.code, 5) << action;
        EXPECT_TRUE(tells(ended, "[GC-ARCHIVE-0001]")) << ended.err;
    }
    EXPECT_FALSE(fs::exists(store()));
    begin();
    EXPECT_TRUE(tells(archive({"init"}, "K. Keeper"), "[GC-ARCHIVE-0002]"));
}

TEST_F(ArchiveOfALaboratory, RefusesACommandLineThatSaysTooMuchOrTooLittle) {
    begin();
    std::vector<std::vector<std::string>> wrong = {
        {"archive"},
        {"archive", "burn", "--store", store()},
        {"archive", "list"},
        {"archive", "head", "EX-1", "--store", store()},
        {"archive", "list", "--store", store(), "--by", "R. Lin"},
        {"archive", "issue", "EX-1", "--store", store()},
        {"archive", "add", "--store", store(), "--by", "R. Lin"},
        {"archive", "withdraw", "EX-1", "--store", store(), "--by", "R. Lin"},
        {"archive", "backup", "--store", store(), "--by", "R. Lin"},
        {"archive", "verify"},
        {"archive", "verify", "evidence.json", "--store", store()},
        {"archive", "init", "--store", path("b.archive"), "--by", "K", "--person", "R. Lin"},
        {"archive", "init", "--store", path("b.archive"), "--by", "K", "--person", "R. Lin=boss"}};
    for (const char* const blank : {"", " ", "\u00A0 \u2003", "\u200B", "-", "n/a"}) {
        wrong.push_back({"archive", "withdraw", "EX-1", "--store", store(), "--by", "R. Lin", "--why", blank});
        wrong.push_back({"archive", "settings", "--store", store(), "--by", "R. Lin", "--why", blank});
    }
    for (const std::vector<std::string>& words : wrong) {
        const Ended ended = gumcert(words);
        EXPECT_EQ(ended.code, 2) << words.back() << ": " << ended.err;
    }
    EXPECT_FALSE(fs::exists(path("b.archive")));
    EXPECT_EQ(archive({"init", "--numbering", "EX"}, "K. Keeper").code, 3);
}

TEST_F(ArchiveOfALaboratory, RefusesWhatCheckWouldRefuse) {
    begin();
    evaluate("first");
    const json before = shown({"verify"});
    const std::string record = bytes_of(folder() / "first.json");
    std::string spoiled = record;
    spoiled.replace(spoiled.find("\"printed\""), 9, "\"prinfed\"");
    write_bytes(folder() / "first.json", spoiled);
    EXPECT_EQ(archive(files("add", "first"), "R. Lin").code, 3);
    write_bytes(folder() / "first.json", record);

    const std::string xml = bytes_of(folder() / "first.xml");
    std::string other = xml;
    for (std::size_t at = other.find("EX-2026-0042"); at != std::string::npos; at = other.find("EX-2026-0042", at)) {
        other.replace(at, 12, "EX-2026-0043");
    }
    write_bytes(folder() / "first.xml", other);
    const Ended ended = archive(files("add", "first"), "R. Lin");
    EXPECT_EQ(ended.code, 3);
    EXPECT_TRUE(tells(ended, "[GC-ARCHIVE-0029]")) << ended.err;
    write_bytes(folder() / "first.xml", xml.substr(0, xml.size() / 2));
    EXPECT_EQ(archive(files("add", "first"), "R. Lin").code, 3);
    write_bytes(folder() / "first.xml", "plain text");
    EXPECT_TRUE(tells(archive(files("add", "first"), "R. Lin"), "[GC-ARCHIVE-0029]"));
    EXPECT_EQ(shown({"verify"}), before) << "nothing was kept of what was refused";
}

TEST_F(ArchiveOfALaboratory, TakesARecordOfACertificateOnly) {
    begin();
    change_json(folder() / "end_gauge.json", [](json& job) { job.erase("certificate"); });
    const Ended made =
        gumcert({"evaluate", path("end_gauge.json"), "-o", path("plain.json"), "--share", GUMCERT_SOURCE_DIR, "-q"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_TRUE(tells(archive({"add", path("plain.json")}, "R. Lin"), "[GC-ARCHIVE-0028]"));
    fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "comparison" / "key_comparison.json", folder());
    const Ended compared = gumcert(
        {"evaluate", path("key_comparison.json"), "-o", path("comparison.json"), "--share", GUMCERT_SOURCE_DIR, "-q"});
    ASSERT_LE(compared.code, 1) << compared.err;
    const Ended refused = archive({"add", path("comparison.json")}, "R. Lin");
    EXPECT_TRUE(tells(refused, "[GC-ARCHIVE-0028]") && tells(refused, "comparison whose report has no number"))
        << refused.err;
}

/// A comparison of two laboratories whose report has a number.
json job_of_a_comparison() {
    return {
        {"schema", "gumcert/job/1"},
        {"kind", "comparison"},
        {"title", "Comparison of gauge blocks"},
        {"unit", "um"},
        {"assigned_value", {{"value", 12.2}, {"U", 0.1}, {"k", 2}}},
        {"artefact_stability", "no change in two years, in U(X)"},
        {"certificate",
         {{"number", "CMP-2026-3"},
          {"laboratory", {{"name", "Example Institute"}}},
          {"languages", {"en"}},
          {"dates", {{"issued", "2026-11-02"}}}}},
        {"participants", {{{"id", "A"}, {"value", 12.31}, {"u", 0.10}}, {{"id", "B"}, {"value", 12.18}, {"u", 0.12}}}}};
}

// A report of a comparison has a number, and no gates, persons or digital certificate: it is kept as certificates are.
TEST_F(ArchiveOfALaboratory, KeepsTheReportOfAComparison) {
    begin();
    const json job = job_of_a_comparison();
    write_bytes(folder() / "pt.json", job.dump());
    const std::string record = path("pt-record.json");
    const std::string page = path("pt.html");
    Ended ended = gumcert({"evaluate", path("pt.json"), "-o", record, "--share", GUMCERT_SOURCE_DIR, "-q"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    ended = gumcert({"render", record, "--format", "html", "-o", page, "--share", GUMCERT_SOURCE_DIR, "-q"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const std::string text = bytes_of(page);
    std::string changed = text;
    changed.replace(changed.find("12.31"), 5, "12.13");
    write_bytes(page, changed);
    EXPECT_TRUE(tells(archive({"add", record, page}, "R. Lin"), "[GC-ARCHIVE-0038]"));
    write_bytes(page, text);
    EXPECT_TRUE(tells(archive({"amend", record, page}, "R. Lin"), "amends no certificate"));
    ended = archive({"add", record, page}, "R. Lin");
    ASSERT_EQ(ended.code, 0) << ended.err;
    lead_to_issue("CMP-2026-3");
    const json list = shown({"list", "gauge", "blocks"});
    ASSERT_EQ(list["certificates"].size(), 1U);
    EXPECT_EQ(list["certificates"][0]["state"], "issued");
    EXPECT_EQ(shown({"show", "CMP-2026-3"})["documents"].size(), 1U);
    EXPECT_EQ(archive({"verify"}).code, 0);
    EXPECT_EQ(archive({"replay"}).code, 0);
    EXPECT_TRUE(tells(archive({"statistics"}), "  2  0  0.49")) << "pairs are no scores of their own";
    EXPECT_EQ(verified_elsewhere({store()}).code, 0);
    const std::string evidence = path("evidence.json");
    ended = archive({"export", "CMP-2026-3", "-o", evidence});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(gumcert({"archive", "verify", evidence, page, "--share", GUMCERT_SOURCE_DIR}).code, 0);
    EXPECT_EQ(verified_elsewhere({evidence, page}).code, 0);
    const Ended audited = gumcert({"audit", record, "--format", "json", "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(audited.out.find("\"N07\""), std::string::npos) << "the stability is stated";
}

// An amended report refers to the first one, which it supersedes (ISO/IEC 17025:2017, 7.8.8).
TEST_F(ArchiveOfALaboratory, AmendsTheReportOfAComparison) {
    begin();
    json job = job_of_a_comparison();
    const auto made = [&](const std::string& name) {
        write_bytes(folder() / (name + ".json"), job.dump());
        Ended ended = gumcert(
            {"evaluate", path(name + ".json"), "-o", path(name + "-record.json"), "--share", GUMCERT_SOURCE_DIR, "-q"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        ended = gumcert({"render", path(name + "-record.json"), "--format", "html", "-o", path(name + ".html"),
                         "--share", GUMCERT_SOURCE_DIR, "-q"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return std::vector<std::string>{path(name + "-record.json"), path(name + ".html")};
    };
    const auto brought_in = [&](const char* action, const std::vector<std::string>& files) {
        return archive({action, files[0], files[1]}, "R. Lin");
    };
    ASSERT_EQ(brought_in("add", made("first")).code, 0);
    lead_to_issue("CMP-2026-3");

    job["certificate"]["number"] = "CMP-2026-3/A1";
    job["certificate"]["amendment"] = {{"kind", "replaced"},
                                       {"number", "CMP-2026-3"},
                                       {"reason", "Two digits of laboratory A were exchanged."},
                                       {"changes", {"value of laboratory A"}},
                                       {"record", "first-record.json"}};
    EXPECT_TRUE(tells(brought_in("amend", made("same")), "[GC-ARCHIVE-0035]")) << "nothing has changed";
    job["participants"][0]["name"] = "Secret Ltd";
    EXPECT_TRUE(tells(brought_in("amend", made("named")), "[GC-ARCHIVE-0035]")) << "the report prints no names";
    job["participants"][0]["value"] = 12.13;
    const std::vector<std::string> files = made("second");
    const std::string page = bytes_of(files[1]);
    for (const char* const text : {"This report replaces comparison report CMP-2026-3.",
                                   "Two digits of laboratory A were exchanged.", "value of laboratory A"}) {
        EXPECT_NE(page.find(text), std::string::npos) << text;
    }
    EXPECT_TRUE(tells(brought_in("add", files), "use amend"));
    json& amendment = job["certificate"]["amendment"];
    const auto is_refused = [&](const char* key, const json& stated) {
        const json before = amendment[key];
        amendment[key] = stated;
        write_bytes(folder() / "silent.json", job.dump());
        amendment[key] = before;
        return tells(gumcert({"evaluate", path("silent.json"), "--share", GUMCERT_SOURCE_DIR}), "[GC-INPUT-0545]");
    };
    EXPECT_TRUE(is_refused("reason", "-"));
    EXPECT_TRUE(is_refused("changes", json::array()));
    EXPECT_TRUE(is_refused("number", "CMP-2026-3/A1")) << "a report that replaces itself";
    const Ended amended = brought_in("amend", files);
    ASSERT_EQ(amended.code, 0) << amended.err;
    const json entry = shown({"show", "CMP-2026-3/A1"})["entries"][0]["body"];
    EXPECT_EQ(entry["why"], "Two digits of laboratory A were exchanged.");
    bool tells_value = false;
    for (const json& change : entry["amends"]["changes"]) {
        tells_value = tells_value || (change["before"] == "12.31" && change["after"] == "12.13");
        const std::string where = change["where"];
        EXPECT_EQ(where.find("/issuer/number"), std::string::npos) << "it always differs";
    }
    EXPECT_TRUE(tells_value) << entry["amends"]["changes"].dump(1);
    EXPECT_EQ(entry.dump().find("Secret"), std::string::npos) << "evidence goes to every participant";
    lead_to_issue("CMP-2026-3/A1");
    EXPECT_EQ(shown({"show", "CMP-2026-3"})["state"], "superseded");
    EXPECT_EQ(shown({"show", "CMP-2026-3"})["amended_by"], "CMP-2026-3/A1");
    EXPECT_EQ(shown({"statistics"})["amendments"], 1);
    EXPECT_EQ(archive({"verify"}).code, 0);
    EXPECT_EQ(archive({"replay"}).code, 0);
    EXPECT_EQ(verified_elsewhere({store()}).code, 0);
    const std::string evidence = path("evidence.json");
    ASSERT_EQ(archive({"export", "CMP-2026-3", "-o", evidence}).code, 0);
    EXPECT_TRUE(tells(gumcert({"archive", "verify", evidence, "--share", GUMCERT_SOURCE_DIR}), "CMP-2026-3/A1"));
    EXPECT_EQ(verified_elsewhere({evidence}).code, 0);

    // A report is printed as superseded by the one that replaces it, and by no other; the archive takes no such page.
    const auto superseded_by = [&](const std::string& record) {
        return gumcert({"render", path("first-record.json"), "--format", "html", "-o", path("first.html"),
                        "--superseded-by", path(record), "--share", GUMCERT_SOURCE_DIR});
    };
    EXPECT_TRUE(tells(superseded_by("first-record.json"), "not the record of an amendment"));
    const Ended marked = superseded_by("second-record.json");
    ASSERT_EQ(marked.code, 0) << marked.err;
    EXPECT_TRUE(has(bytes_of(path("first.html")), "SUPERSEDED by CMP-2026-3/A1"));
    EXPECT_TRUE(tells(brought_in("add", {path("first-record.json"), path("first.html")}), "[GC-ARCHIVE-0038]"));

    // Another kind of document, and another record of the original.
    change_certificate([](json& c) {
        c["number"] = "EX-2026-0042";
        c["amendment"] = {{"kind", "amended"},
                          {"number", "CMP-2026-3/A1"},
                          {"reason", "The serial number was written wrongly."},
                          {"changes", {"serial number"}}};
    });
    evaluate("certificate");
    EXPECT_TRUE(tells(archive(this->files("amend", "certificate"), "R. Lin"), "which is the report of a comparison"));
    EXPECT_TRUE(tells(superseded_by("certificate.json"), "a certificate, and what is printed is the report"));
    job["certificate"]["number"] = "CMP-2026-3/A1/A1";
    job["certificate"]["amendment"]["number"] = "CMP-2026-3/A1";
    EXPECT_TRUE(tells(brought_in("amend", made("third")), "was compared with another record"));
}

// A report whose budget rests on a standard that was wrong gets a draft, which can be evaluated and brought in as it is.
TEST_F(ArchiveOfALaboratory, DraftsAmendmentsOfReportsOfComparisons) {
    begin();
    const fs::path lab = folder() / "lab";
    fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "laboratory", lab, fs::copy_options::recursive);
    const json job = {
        {"schema", "gumcert/job/1"},
        {"kind", "comparison"},
        {"title", "Comparison of an end gauge"},
        {"unit", "nm"},
        {"assigned_value", {{"value", 50000800}, {"U", 60}, {"k", 2}}},
        {"certificate",
         {{"number", "CMP-1"},
          {"laboratory", {{"name", "Example Institute"}}},
          {"languages", {"en"}},
          {"dates", {{"issued", "2026-11-21"}}}}},
        {"participants", {{{"id", "A"}, {"budget", "end_gauge.json"}}, {{"id", "B"}, {"value", 50000780}, {"u", 40}}}}};
    write_bytes(lab / "cmp.json", job.dump());
    const auto made = [&](const fs::path& from, const std::string& name) {
        Ended ended =
            gumcert({"evaluate", from.string(), "-o", path(name + ".json"), "--share", GUMCERT_SOURCE_DIR, "-q"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        ended = gumcert({"render", path(name + ".json"), "--format", "html", "-o", path(name + ".html"), "--share",
                         GUMCERT_SOURCE_DIR, "-q"});
        EXPECT_EQ(ended.code, 0) << ended.err;
    };
    made(lab / "cmp.json", "first");
    ASSERT_EQ(archive({"add", path("first.json"), path("first.html")}, "R. Lin").code, 0);
    lead_to_issue("CMP-1");
    fs::copy(lab / "laboratory", folder() / "corrected", fs::copy_options::recursive);
    const fs::path standard = folder() / "corrected" / "standards" / "STD-017.json";
    std::string registered = bytes_of(standard);
    registered.replace(registered.find("50.000623"), 9, "50.000673");
    write_bytes(standard, registered);
    const Ended found = archive({"affected", "--source", "STD-017", "--since", "2026-03-02", "--register",
                                 path("corrected"), "--why", "The standard was wrong.", "-o", path("drafts")});
    EXPECT_EQ(found.code, 1) << found.err;
    EXPECT_TRUE(tells(found, "draft CMP-1_A1")) << found.out;
    const fs::path draft = folder() / "drafts" / "CMP-1_A1";
    EXPECT_EQ(bytes_of(draft / "original_record.json"), bytes_of(path("first.json")));
    EXPECT_EQ(bytes_of(draft / "laboratory" / "standards" / "STD-017.json"), registered);

    made(draft / "cmp.json", "second");
    EXPECT_TRUE(has(bytes_of(path("second.html")), "Amendment to comparison report CMP-1."));
    ASSERT_EQ(archive({"amend", path("second.json"), path("second.html")}, "R. Lin").code, 0);
    lead_to_issue("CMP-1/A1");
    EXPECT_EQ(shown({"show", "CMP-1"})["state"], "amended-by");
    const json told = json::parse(bytes_of(draft / "changes.json"));
    const json entered = shown({"show", "CMP-1/A1"})["entries"][0]["body"]["amends"]["changes"];
    ASSERT_EQ(told["changes"].size(), entered.size());
    for (std::size_t i = 0; i < entered.size(); ++i) {
        EXPECT_EQ(told["changes"][i]["place"], entered[i]["where"]);
        EXPECT_EQ(told["changes"][i]["before"], entered[i]["before"]);
        EXPECT_EQ(told["changes"][i]["now"], entered[i]["after"]);
    }
    ASSERT_FALSE(entered.empty());
    EXPECT_EQ(archive({"verify"}).code, 0);
    EXPECT_EQ(verified_elsewhere({store()}).code, 0);
}

// What reading leaves out of a digital certificate is no fault of a document that says what its record says.
TEST_F(ArchiveOfALaboratory, WarnsOfNothingInItsOwnDigitalCertificates) {
    begin();
    for (const char* const name : {"torque_wrench", "pt100", "multimeter", "mass_set"}) {
        const fs::path own = folder() / name;
        fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "everyday" / name, own);
        const std::string record = (own / "record.json").string();
        const std::string xml = (own / "certificate.xml").string();
        Ended ended =
            gumcert({"evaluate", (own / "job.json").string(), "-o", record, "--share", GUMCERT_SOURCE_DIR, "-q"});
        ASSERT_LE(ended.code, 1) << ended.err;
        ended = gumcert({"render", record, "--format", "dcc", "-o", xml, "--share", GUMCERT_SOURCE_DIR, "-q"});
        ASSERT_EQ(ended.code, 0) << ended.err;
        ended = archive({"add", record, xml}, "R. Lin");
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_FALSE(tells(ended, "GC-DCC-")) << ended.err;
    }
}

TEST_F(ArchiveOfALaboratory, IssuesNoSpecimen) {
    begin();
    change_certificate([](json& c) { c["status"] = "specimen"; });
    const Ended made =
        gumcert({"evaluate", path("end_gauge.json"), "-o", path("s.json"), "--share", GUMCERT_SOURCE_DIR, "-q"});
    ASSERT_LE(made.code, 1) << made.err;
    ASSERT_EQ(archive({"add", path("s.json")}, "R. Lin").code, 0);
    EXPECT_EQ(archive({"review", "EX-2026-0042"}, k_reviewer).code, 0);
    EXPECT_EQ(archive({"authorise", "EX-2026-0042"}, k_authoriser).code, 0);
    EXPECT_TRUE(tells(archive({"issue", "EX-2026-0042"}, "M. Weber"), "[GC-ARCHIVE-0030]"));
    EXPECT_EQ(shown({"show", "EX-2026-0042"})["state"], "authorised");
}

TEST_F(ArchiveOfALaboratory, KeepsFourEyesAndRoles) {
    begin({"--person", "K. Keeper=keeper", "--person", "R. Lin=author,reviewer", "--person", "M. Weber=reviewer"});
    change_certificate([](json& c) { c["persons"].erase("reviewed_by"); });
    evaluate("first");
    EXPECT_TRUE(tells(archive(files("add", "first"), "M. Weber"), "[GC-ARCHIVE-0023]"));
    EXPECT_EQ(archive(files("add", "first"), "R. Lin").code, 0);
    EXPECT_TRUE(tells(archive({"review", "EX-2026-0042"}, "R. Lin"), "[GC-ARCHIVE-0022]"));
    EXPECT_TRUE(tells(archive({"issue", "EX-2026-0042"}, "M. Weber"), "[GC-ARCHIVE-0021]"));
    EXPECT_EQ(archive({"review", "EX-2026-0042"}, "M. Weber").code, 0);
}

TEST_F(ArchiveOfALaboratory, StatesSettingsAnew) {
    begin({"--person", "K. Keeper=keeper", "--person", "R. Lin=author"});
    EXPECT_EQ(archive({"settings", "--no-four-eyes"}, "K. Keeper").code, 2) << "without a reason";
    EXPECT_TRUE(tells(archive({"settings", "--why", "I want to"}, "R. Lin"), "[GC-ARCHIVE-0023]"));
    EXPECT_TRUE(
        tells(archive({"settings", "--why", "numbers", "--numbering", "EX"}, "K. Keeper"), "[GC-ARCHIVE-0025]"));
    ASSERT_EQ(
        archive({"settings", "--why", "numbers come from the archive now", "--numbering", "N-##"}, "K. Keeper").code,
        0);
    EXPECT_TRUE(tells(archive({"number"}, "N. Obody"), "N-01 numbered")) << "without persons anybody may do everything";
    EXPECT_EQ(archive({"verify"}).code, 0);
    EXPECT_EQ(verified_elsewhere({store()}).code, 0);
}

TEST_F(ArchiveOfALaboratory, GivesNumbersAndAnswersTheSameRequestOnce) {
    begin({"--numbering", "EX-YYYY-####"});
    const Ended first = archive({"number", "--request-key", "order 17", "--format", "json"}, "R. Lin");
    const Ended again = archive({"number", "--request-key", "order 17", "--format", "json"}, "R. Lin");
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(json::parse(first.out)["certificate"], json::parse(again.out)["certificate"]);
    EXPECT_EQ(json::parse(again.out)["repeated"], true);
    evaluate("first");
    EXPECT_TRUE(tells(archive(files("add", "first"), "R. Lin"), "[GC-ARCHIVE-0024]")) << "EX-2026-0042 was not taken";
    const std::string number = json::parse(first.out)["certificate"];
    EXPECT_EQ(number.substr(number.size() - 5), "-0001");
    EXPECT_EQ(archive({"withdraw", number, "--why", "the customer took the item back"}, "M. Weber").code, 0);
    EXPECT_EQ(shown({"show", number})["state"], "withdrawn");
}

/// The documents of an earlier evaluation, or of another certificate, are not those of the record.
TEST_F(ArchiveOfALaboratory, TakesNoDocumentThatStatesSomethingElse) {
    begin();
    evaluate("first");
    replace_in(folder() / "end_gauge.json", "\"value\": 215", "\"value\": 515");
    evaluate("later");
    const auto added = [&](const char* document) {
        return archive({"add", path("later.json"), path(document)}, "R. Lin");
    };
    for (const char* const earlier : {"first.xml", "first.html"}) {
        const Ended ended = added(earlier);
        EXPECT_EQ(ended.code, 3) << earlier;
        EXPECT_TRUE(tells(ended, "[GC-ARCHIVE-0038]")) << ended.err;
    }
    std::ofstream(folder() / "other.html")
        << "<!DOCTYPE html><html><body><h1>Certificate EX-2026-9999</h1><p>DRAFT, replaces "
           "EX-2026-0042. l = 49 mm</p></body></html>";
    EXPECT_TRUE(tells(added("other.html"), "[GC-ARCHIVE-0038]"));
    std::ofstream(folder() / "bare.html") << "<!DOCTYPE html>\nEX-2026-0042";
    EXPECT_TRUE(tells(added("bare.html"), "[GC-ARCHIVE-0038]"));
    std::ofstream(folder() / "longer.html") << "<!DOCTYPE html>\nEX-2026-00421";
    EXPECT_TRUE(tells(added("longer.html"), "[GC-ARCHIVE-0029]"));
    const std::string made = bytes_of(folder() / "later.html");
    const auto edited = [&](const std::string& from, const std::string& to) {
        std::string other = made;
        const std::size_t at = other.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        other.replace(at, from.size(), to);
        write_bytes(folder() / "edited.html", other);
        return added("edited.html");
    };
    EXPECT_TRUE(tells(edited("<main>", "<main><p hidden>x</p>"), "[GC-ARCHIVE-0070]"));
    EXPECT_TRUE(tells(edited("</style>", "h1 { display: none }</style>"), "[GC-ARCHIVE-0070]"));
    // A page that names no changed templates has the sheet of those of this program, without even a plain rule more.
    EXPECT_TRUE(tells(edited("</style>", "h1 { margin: 0 }</style>"), "names no changed ones"));
    EXPECT_TRUE(tells(edited("</head>", "<style>td,dd{color:#fff}</style></head>"), "[GC-ARCHIVE-0070]"));
    EXPECT_TRUE(tells(edited("Example Customer", "Another Customer"), "[GC-ARCHIVE-0038]"));
    EXPECT_TRUE(
        tells(edited("reproduced only in full", "reproduced in part"), "and the page that the record gives says"));
    EXPECT_TRUE(
        tells(edited("<main>", "<main><ol start=\"51\"></ol>"), "[GC-ARCHIVE-0070]"));  // a number without a text
    // What its text does not tell: drawings, lists, titles, elements and attributes of other kinds.
    for (const char* const more : {"<svg viewBox=\"0 0 90 9\"><text>l = 50 001 234 nm, PASS</text></svg>", "<ol></ol>",
                                   "<p title=\"U = 1 nm, PASS\"></p>", "<p class=\"end\"></p>", "<b></b>"}) {
        EXPECT_TRUE(tells(edited("<main>", "<main>" + std::string(more)), "[GC-ARCHIVE-0038]")) << more;
    }
    // What was written together stays together.
    const fs::path manifest = folder() / ".gumcert-set.json";
    const json set{{"name", "later.html"}, {"sha256", std::string(64, 'a')}};
    std::ofstream(manifest) << json{{"schema", "gumcert/set/1"}, {"sets", {{{"files", {set}}}}}}.dump();
    EXPECT_TRUE(tells(added("later.html"), "[GC-STORE-0014]"));
    fs::remove(manifest);
    EXPECT_EQ(shown({"list"})["certificates"].size(), 0U) << "nothing came in";
    for (const char* const language : {"de", "zh-Hant"}) {
        const std::string page = path((std::string(language) + ".html").c_str());
        const Ended ended = gumcert({"render", path("later.json"), "--format", "html", "--language", language, "-o",
                                     page, "--share", GUMCERT_SOURCE_DIR, "-q"});
        ASSERT_EQ(ended.code, 0) << ended.err;
        const Ended taken = archive({"add", path("later.json"), path("later.xml"), page}, "R. Lin");
        EXPECT_EQ(taken.code, 0) << taken.err;
    }
    const Ended of_others = edited("<main>", "<main><p>gumcert 0.1.0 changed templates 0123abcd</p>");
    EXPECT_EQ(of_others.code, 0) << of_others.err;
    EXPECT_TRUE(tells(of_others, "[GC-ARCHIVE-0071]"));
}

/// The names of stations and reflectors in its tables have digits, which a page in two languages prints twice.
TEST_F(ArchiveOfALaboratory, TakesPagesInAnyLanguagesOfTheProgram) {
    if (std::string why = why_no_pdf(); !why.empty()) {
        GTEST_SKIP() << why;
    }
    const std::string job = (fs::path(GUMCERT_SOURCE_DIR) / "examples/certificate/rotary_table.json").string();
    ASSERT_EQ(gumcert({"evaluate", job, "-o", path("table.json"), "--share", GUMCERT_SOURCE_DIR, "-q"}).code, 0);
    for (const char* const languages : {"en", "es,de", "zh-Hant,en"}) {
        const std::string pages = path((std::string(languages) + ".pdf").c_str());
        ASSERT_EQ(gumcert({"render", path("table.json"), "--format", "pdf", "--language", languages, "-o", pages,
                           "--share", GUMCERT_SOURCE_DIR, "-q"})
                      .code,
                  0);
        fs::remove(store());
        begin();
        const Ended taken = archive({"add", path("table.json"), pages}, "R. Lin");
        EXPECT_EQ(taken.code, 0) << languages << ": " << taken.err;
    }
}

/// Bytes that somebody exchanged in the store are judged by nobody, and neither is an edited table of lists.
TEST_F(ArchiveOfALaboratory, GoesByTheLogAndItsHashes) {
    begin();
    evaluate("first");
    ASSERT_EQ(archive(files("add", "first"), "R. Lin").code, 0);
    ASSERT_EQ(archive({"review", "EX-2026-0042"}, k_reviewer).code, 0);
    ASSERT_EQ(archive({"authorise", "EX-2026-0042"}, k_authoriser).code, 0);
    const auto tampered = [&](const std::string& sql) {
        const std::string script =
            "import sqlite3\n"
            "db = sqlite3.connect('" +
            store() +
            "')\n"
            "triggers = [(n, s) for n, s in db.execute(\"SELECT name, sql FROM sqlite_schema WHERE type = "
            "'trigger'\")]\n"
            "for name, _ in triggers: db.execute('DROP TRIGGER ' + name)\n"
            "db.execute(\"" +
            sql +
            "\")\n"
            "for _, sql in triggers: db.execute(sql)\n"
            "db.commit()\n";
        const Ended ended = run_process("/usr/bin/python3", {"-B", "-c", script}, {}, folder());
        ASSERT_EQ(ended.code, 0) << ended.err;
    };
    tampered("UPDATE content SET bytes = CAST(bytes || x'20' AS BLOB)");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"issue", "EX-2026-0042"}, {"add", path("first.json"), path("first.xml")}}) {
        const Ended ended = archive(words, "M. Weber");
        EXPECT_EQ(ended.code, 5) << words.front();
        EXPECT_TRUE(tells(ended, "[GC-ARCHIVE-0012]")) << ended.err;
    }
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"replay"}, {"statistics"}, {"affected", "--source", "S", "--since", "2026-01-01"}}) {
        EXPECT_TRUE(tells(archive(words), "[GC-ARCHIVE-0012]")) << words.front();
    }
    tampered("UPDATE content SET bytes = CAST(substr(bytes, 1, length(bytes) - 1) AS BLOB)");
    tampered("UPDATE listed SET state = 'withdrawn', record = ''");
    EXPECT_TRUE(tells(archive({"replay"}), "1 of 1 records give the same"));
    EXPECT_TRUE(tells(archive({"statistics"}), "authorised"));
    EXPECT_EQ(archive({"issue", "EX-2026-0042"}, "M. Weber").code, 0);
    tampered("UPDATE log SET actor = 'N. Obody' WHERE kind = 'authorised'");
    EXPECT_TRUE(tells(archive({"statistics"}), "[GC-ARCHIVE-0013]"));
    EXPECT_TRUE(
        tells(archive({"withdraw", "EX-2026-0042", "--why", "it was damaged"}, "M. Weber"), "[GC-ARCHIVE-0013]"));
}

TEST_F(ArchiveOfALaboratory, IsReviewedAndAuthorisedByWhomTheCertificateNames) {
    begin();
    evaluate("first");
    ASSERT_EQ(archive(files("add", "first"), "R. Lin").code, 0);
    const Ended other = archive({"review", "EX-2026-0042"}, "A. Nother");
    EXPECT_EQ(other.code, 3);
    EXPECT_TRUE(tells(other, "that \"Reviewer 1\" reviews it, and \"A. Nother\" does")) << other.err;
    EXPECT_TRUE(tells(other, "[GC-ARCHIVE-0039]")) << other.err;
    ASSERT_EQ(archive({"review", "EX-2026-0042"}, "reviewer 1").code, 0);
    const Ended refused = archive({"authorise", "EX-2026-0042"}, "A. Nother");
    EXPECT_EQ(refused.code, 3);
    EXPECT_TRUE(tells(refused, "[GC-ARCHIVE-0039]")) << refused.err;
    const Ended authorised = archive({"authorise", "EX-2026-0042"}, "head of laboratory");
    EXPECT_EQ(authorised.code, 0);
    EXPECT_TRUE(tells(authorised, "[GC-ARCHIVE-0072]")) << "the printed day is over: " << authorised.err;
    EXPECT_EQ(archive({"issue", "EX-2026-0042"}, "A. Nother").code, 0) << "whoever issues what was authorised";
    EXPECT_TRUE(tells(archive({"statistics"}), "head of laboratory"));
}

TEST_F(ArchiveOfALaboratory, LeavesNoCopyThatNobodyMayMake) {
    begin({"--person", "K. Keeper=keeper", "--person", "R. Lin=author"});
    const Ended ended = archive({"backup", "-o", path("copy.archive")}, "R. Lin");
    EXPECT_EQ(ended.code, 3);
    EXPECT_TRUE(tells(ended, "[GC-ARCHIVE-0023]")) << ended.err;
    EXPECT_FALSE(fs::exists(folder() / "copy.archive"));
    EXPECT_EQ(archive({"backup", "-o", path("copy.archive"), "--request-key", "k"}, "K. Keeper").code, 0);
    EXPECT_TRUE(
        tells(archive({"backup", "-o", path("more.archive"), "--request-key", "k"}, "K. Keeper"), "[GC-ARCHIVE-0027]"));
    EXPECT_FALSE(fs::exists(folder() / "more.archive"));
    const Ended nobody =
        gumcert({"archive", "init", "--store", path("n.archive"), "--by", "R. Lin", "--person", "R. Lin=author"});
    EXPECT_EQ(nobody.code, 3);
    EXPECT_TRUE(tells(nobody, "[GC-ARCHIVE-0033]")) << nobody.err;
    EXPECT_FALSE(fs::exists(folder() / "n.archive"));
}

TEST_F(ArchiveOfALaboratory, AmendsACertificate) {
    issue_the_example();
    fs::copy_file(folder() / "first.json", folder() / "original.json");
    const auto amend = [](json& c) {
        c["number"] = "EX-2026-0042/A1";
        c["amendment"] = {{"kind", "replaced"},
                          {"number", "EX-2026-0042"},
                          {"reason", "The serial number was written wrongly."},
                          {"changes", {"serial number"}},
                          {"record", "original.json"}};
        c["item"]["serial_number"] = "SN-1007";
    };
    change_certificate(amend);
    evaluate("second");
    EXPECT_EQ(archive(files("add", "second"), "R. Lin").code, 2) << "an amendment comes in by amend";
    const Ended ended = archive(files("amend", "second"), "R. Lin");
    ASSERT_EQ(ended.code, 0) << ended.err;
    const json draft = shown({"show", "EX-2026-0042/A1"})["entries"][0]["body"];
    EXPECT_EQ(draft["why"], "The serial number was written wrongly.");
    ASSERT_EQ(draft["amends"]["changes"].size(), 1U);
    EXPECT_EQ(draft["amends"]["changes"][0]["where"], "/item/serial_number");
    EXPECT_EQ(draft["amends"]["changes"][0]["after"], "SN-1007");
    EXPECT_EQ(shown({"show", "EX-2026-0042"})["state"], "issued") << "until the amendment is issued";
    lead_to_issue("EX-2026-0042/A1");
    EXPECT_EQ(shown({"show", "EX-2026-0042"})["state"], "superseded");
    EXPECT_EQ(shown({"show", "EX-2026-0042"})["amended_by"], "EX-2026-0042/A1");

    ASSERT_EQ(archive({"export", "EX-2026-0042", "-o", path("old.json")}).code, 0);
    const Ended told = gumcert({"archive", "verify", path("old.json")});
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_TRUE(tells(told, "superseded, see EX-2026-0042/A1"));
    EXPECT_TRUE(tells(verified_elsewhere({path("old.json")}), "superseded, see EX-2026-0042/A1"));
    EXPECT_TRUE(tells(archive(files("amend", "second"), "R. Lin"), "[GC-ARCHIVE-0021]")) << "it is issued already";
}

TEST_F(ArchiveOfALaboratory, ComparesAnAmendmentWithWhatWasIssued) {
    issue_the_example();
    change_certificate([](json& c) { c["item"]["serial_number"] = "SN-1003"; });
    evaluate("original");  // somebody keeps another record of the same number
    change_certificate([](json& c) {
        c["number"] = "EX-2026-0042/A1";
        c["amendment"] = {{"kind", "amended"},
                          {"number", "EX-2026-0042"},
                          {"reason", "The serial number was written wrongly."},
                          {"changes", {"serial number"}},
                          {"record", "original.json"}};
        c["item"]["serial_number"] = "SN-1007";
    });
    evaluate("second");
    EXPECT_TRUE(tells(archive(files("amend", "second"), "R. Lin"), "[GC-ARCHIVE-0035]"));
}

TEST_F(ArchiveOfALaboratory, FindsWhatAWrongStandardAffectsAndDraftsTheAmendment) {
    fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "laboratory", folder(),
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    issue_the_example();
    const std::vector<std::string> query = {"affected", "--source", "STD-017", "--since", "2026-03-02"};
    const Ended listed = archive(query);
    EXPECT_EQ(listed.code, 1) << listed.err;
    EXPECT_TRUE(tells(listed, "EX-2026-0042              issued")) << listed.out;
    EXPECT_EQ(archive({"affected", "--source", "STD-018", "--since", "2026-03-02"}).code, 0);
    EXPECT_EQ(archive({"affected", "--source", "STD-017", "--since", "2026-12-01"}).code, 0);

    fs::copy(folder() / "laboratory", folder() / "corrected", fs::copy_options::recursive);
    replace_in(folder() / "corrected" / "standards" / "STD-017.json", "50.000623", "50.000643");
    std::vector<std::string> again = query;
    again.insert(again.end(), {"--register", path("corrected")});
    EXPECT_FALSE(tells(archive(again), "draft")) << "none is written";
    again.insert(again.end(), {"-o", path("drafts"), "--format", "json", "--why",
                               "The certificate of STD-017 was withdrawn by its issuer."});
    const Ended ended = archive(again);
    EXPECT_EQ(ended.code, 1) << ended.err;
    const Ended repeated = archive(again);
    EXPECT_EQ(repeated.code, 1) << "what is there whole stays: a command that was ended is given again";
    EXPECT_EQ(repeated.out, ended.out) << repeated.err;
    const fs::path change = folder() / "drafts" / "EX-2026-0042_A1" / "changes.json";
    const std::string written = bytes_of(change);
    std::ofstream(change, std::ios::app) << " ";
    const Ended refused = archive(again);
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(tells(refused, "EX-2026-0042_A1 — is there already, with other files")) << refused.err;
    std::ofstream(change) << written;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "drafts"), {}), 1) << "nothing else is left";
    EXPECT_TRUE(tells(archive({"number", "--amend", "EX-2026-0042"}, "R. Lin"), "EX-2026-0042/A1 numbered"));
    const json found = json::parse(ended.out, nullptr, false);
    ASSERT_EQ(found["certificates"].size(), 1U) << ended.out;
    EXPECT_EQ(found["certificates"][0]["outcome"], "printed");
    EXPECT_EQ(found["certificates"][0]["draft"], "EX-2026-0042_A1");

    // The draft is a job that runs, and the archive takes its record as the amendment.
    const fs::path draft = folder() / "drafts" / "EX-2026-0042_A1";
    const std::string job = json::parse(bytes_of(draft / "changes.json"))["job"];
    const std::string record = path("amendment.json");
    const Ended evaluated =
        gumcert({"evaluate", (draft / job).string(), "-o", record, "--share", GUMCERT_SOURCE_DIR, "-q"});
    ASSERT_EQ(evaluated.code, 0) << evaluated.err;
    const Ended amended = archive({"amend", record}, "R. Lin");
    EXPECT_EQ(amended.code, 0) << amended.err;
    const json entry = shown({"show", "EX-2026-0042/A1"})["entries"][1]["body"];
    EXPECT_EQ(entry["why"], "The certificate of STD-017 was withdrawn by its issuer.");
    EXPECT_FALSE(entry["amends"]["changes"].empty());

    const Ended twice = archive(again);
    EXPECT_EQ(json::parse(twice.out, nullptr, false)["certificates"].size(), 2U) << "the amendment is a draft by now";
    EXPECT_TRUE(tells(archive(query), "EX-2026-0042/A1"));
}

TEST_F(ArchiveOfALaboratory, RefusesASearchThatSaysTooMuchOrTooLittle) {
    begin();
    std::vector<std::vector<std::string>> wrong = {
        {"affected"},
        {"affected", "--source", "STD-017"},
        {"affected", "--since", "2026-03-02"},
        {"affected", "--source", "STD-017", "--since", "March"},
        {"affected", "--source", "STD-017", "--since", "2026-03-02", "--until", "2026-02-30"},
        {"affected", "--source", "STD-017", "--since", "2026-03-02", "-o", path("drafts")},
        {"list", "--format", "csv"},
        {"list", "--source", "STD-017"}};
    for (const std::vector<std::string>& words : wrong) {
        EXPECT_EQ(archive(words).code, 2) << words.back();
    }
}

/// Whatever an action with an output reads, it does not write there.
TEST_F(ArchiveOfALaboratory, WritesOverNothingThatItReads) {
    issue_the_example();
    write_bytes(path("key.pem"),
                "-----BEGIN PRIVATE KEY-----\n"
                "MC4CAQAwBQYDK2VwBCIEINTuctv5E1hK1bbY8fdp+K06/nwoy/HU++CXqI9EdVhC\n"
                "-----END PRIVATE KEY-----\n");
    ASSERT_EQ(archive({"head", "-o", path("head.json"), "--sign", path("key.pem")}).code, 0);
    ASSERT_EQ(archive({"export", "EX-2026-0042", "-o", path("evidence.json"), "--sign", path("key.pem")}).code, 0);
    const auto state = [&] {
        std::map<std::string, std::string> files;
        for (const fs::directory_entry& one : fs::directory_iterator(folder())) {
            const std::string name = one.path().filename().string();
            if (one.is_regular_file() && name.find("-shm") == std::string::npos) {
                files[name] = bytes_of(one.path());
            }
        }
        return files;
    };
    for (const std::vector<std::string>& action :
         {std::vector<std::string>{"head"}, std::vector<std::string>{"export", "EX-2026-0042"}}) {
        for (const char* const since : {"head.json", "evidence.json"}) {
            for (const std::string place : {"head.json", "evidence.json", "key.pem", "lab.archive", "lab.archive-wal",
                                            "lab.archive-shm", "lab.archive-journal"}) {
                if (place.ends_with(".json") && place != since) {
                    continue;
                }
                std::vector<std::string> words = action;
                words.insert(words.end(), {"--since", path(since), "--sign", path("key.pem"), "-o",
                                           (folder() / "x" / ".." / place).string()});
                const auto before = state();
                const Ended ended = archive(words);
                EXPECT_EQ(ended.code, 5) << action[0] << " -o " << place;
                EXPECT_TRUE(tells(ended, "GC-STORE-0004")) << ended.err;
                EXPECT_EQ(state(), before) << action[0] << " -o " << place;
            }
        }
    }
    EXPECT_EQ(archive({"backup", "-o", path("lab.archive-journal")}, "K. Keeper").code, 5);
    for (const std::string ending : {"-wal", "-shm", "-journal"}) {
        for (const std::string place : {"", "./", "x/../"}) {
            for (const std::string action : {"backup", "head"}) {
                std::vector<std::string> words{"archive",     action, "--store",
                                               "lab.archive", "-o",   place + "lab.archive" + ending};
                if (action == "backup") {
                    words.insert(words.end(), {"--by", "K. Keeper"});
                }
                const auto before = state();
                const Ended ended = gumcert(words, {.working_folder = folder()});
                EXPECT_EQ(ended.code, 5) << action << " -o " << place << ending;
                EXPECT_TRUE(tells(ended, "GC-STORE-0004")) << ended.err;
                EXPECT_EQ(state(), before) << action << " -o " << place << ending;
            }
        }
    }
}

/// SQLite would take what stands there for a part of the new archive.
TEST_F(ArchiveOfALaboratory, BeginsNoneWhereAPartOfOneSeemsToBe) {
    write_bytes(path("lab.archive-wal"), "of somebody");
    const Ended ended = archive({"init"}, "K. Keeper");
    EXPECT_EQ(ended.code, 5);
    EXPECT_TRUE(tells(ended, "GC-ARCHIVE-0002")) << ended.err;
    EXPECT_EQ(bytes_of(path("lab.archive-wal")), "of somebody");
    EXPECT_FALSE(fs::exists(store()));
}

TEST_F(ArchiveOfALaboratory, SaysThatAFileIsEmpty) {
    write_bytes(store(), "");
    EXPECT_TRUE(tells(archive({"list"}), "is empty"));
}

TEST_F(ArchiveOfALaboratory, AnswersWithTheNumberAloneWhenQuiet) {
    begin({"--numbering", "N-###"});
    EXPECT_EQ(archive({"number", "-q"}, "K. Keeper").out, "N-001\n");
    EXPECT_EQ(json::parse(archive({"number", "-q", "--format", "json"}, "K. Keeper").out)["certificate"], "N-002");
}

/// A day by hand is compared with the clock, always; days of a search are in their order.
TEST_F(ArchiveOfALaboratory, LooksAtDaysThatAreGiven) {
    begin({"--numbering", "N-###"});
    for (const char* const day : {"xyz", "2026-02-30", "2020-01-01", "2026-2-3", "2991-01-01", " "}) {
        const Ended ended = archive({"number", "--today", day}, "K. Keeper");
        EXPECT_EQ(ended.code, 2) << day;
        EXPECT_TRUE(tells(ended, "GC-USAGE-0001")) << ended.err;
    }
    // The clock goes by UTC, the calendar of the laboratory may be a day before or behind; and midnight may pass meanwhile.
    const auto day = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    for (const int away : {0, 1, -3, 3}) {
        const std::chrono::year_month_day date(day + std::chrono::days(away));
        const auto two = [](unsigned number) { return (number < 10 ? "-0" : "-") + std::to_string(number); };
        const std::string text = std::to_string(static_cast<int>(date.year())) +
                                 two(static_cast<unsigned>(date.month())) + two(static_cast<unsigned>(date.day()));
        EXPECT_EQ(archive({"number", "--today", text}, "K. Keeper").code, away * away > 1 ? 2 : 0) << text;
    }
    const Ended ended = archive({"affected", "--source", "S", "--since", "2026-01-01", "--until", "2025-01-01"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_TRUE(tells(ended, "is before --since")) << ended.err;
    EXPECT_EQ(archive({"affected", "--source", "S", "--since", "2026-01-01", "--until", "2026-01-01"}).code, 0);
}

/// An address stands in a message where a file was wanted; its password does not.
TEST_F(ArchiveOfALaboratory, NeverShowsAPassword) {
    begin();
    const std::string address = "postgresql://u:S3cret@h/db";
    for (const std::vector<std::string>& words : {std::vector<std::string>{"archive", "verify", address},
                                                  {"archive", "add", address, "--store", store(), "--by", "K. Keeper"},
                                                  {"archive", "show", address, "--store", store()},
                                                  {"archive", "export", address, "--store", store()},
                                                  {"archive", "verify", "--store", store(), "--head", address},
                                                  {"check", address},
                                                  {"run", address, "--json-messages"}}) {
        std::vector<std::string> logged = words;
        logged.insert(logged.end(), {"--refusal-log", path("refusals.jsonl")});
        const Ended ended = gumcert(logged);
        EXPECT_NE(ended.code, 0) << words[1];
        EXPECT_FALSE(tells(ended, "S3cret")) << ended.err;
    }
    EXPECT_EQ(bytes_of(path("refusals.jsonl")).find("S3cret"), std::string::npos);
    EXPECT_EQ(verified_elsewhere({address}).err.find("S3cret"), std::string::npos);
}

// Law: whichever option is given an address, no part of the password is said, in letters of whichever size.
TEST_F(ArchiveOfALaboratory, NeverShowsAPartOfAPassword) {
    const std::string help = gumcert({"archive", "--help"}).out;
    std::vector<std::string> options;
    for (std::size_t at = help.find("--"); at != std::string::npos; at = help.find("--", at + 2)) {
        const std::size_t end = help.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at);
        options.push_back(help.substr(at, end - at));
    }
    ASSERT_GT(options.size(), 20U);
    fs::create_directories(folder() / "empty");
    const auto is_silent = [&](const std::vector<std::string>& words) {
        const Ended ended = gumcert(words, {.working_folder = folder() / "empty"});
        std::string said = ended.out + ended.err;
        std::transform(said.begin(), said.end(), said.begin(), [](unsigned char c) { return std::tolower(c); });
        for (const char* const part : {"s3c", "3cr", "etpw"}) {
            EXPECT_EQ(said.find(part), std::string::npos) << words.back() << ": " << said;
        }
        return ended;
    };
    for (const std::string& option : options) {
        for (const char* const value :
             {"host=127.0.0.1 password=S3cRetPw", "7 password='S3cRetPw'", "postgresql://u:S3cRetPw@h/db"}) {
            is_silent({"archive", "list", "--store", store(), option, value});
            is_silent({"archive", "list", "--store", store(), option + "=" + value});
        }
    }
    EXPECT_TRUE(
        tells(is_silent({"archive", "list", "--memory-limit", "host=1 password=S3cRetPw"}), "--memory-limit: "));
    is_silent({"archive", "list", "--memory-limit", "password=", "S3cRetPw"});
    is_silent({"archive", "password=S3cRetPw"});
    is_silent({"password=S3cRetPw", "list"});
}

TEST_F(ArchiveOfALaboratory, ExportsNothingOfANumberAlone) {
    begin({"--numbering", "N-###"});
    ASSERT_EQ(archive({"number"}, "K. Keeper").code, 0);
    const Ended ended = archive({"export", "N-001", "-o", path("evidence.json")});
    EXPECT_EQ(ended.code, 2);
    EXPECT_TRUE(tells(ended, "has no record")) << ended.err;
    EXPECT_FALSE(fs::exists(path("evidence.json")));
}

TEST_F(ArchiveOfALaboratory, SecondVerifierReadsFilesAlone) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    const Ended ended = verified_elsewhere({path("pipe")});
    EXPECT_EQ(ended.code, 5) << ended.out << ended.err;
}

TEST_F(ArchiveOfALaboratory, AFolderThatIsMissingIsNoDefect) {
    begin();
    const std::string nowhere = path("nofolder") + "/b.archive";
    for (const Ended& ended : {archive({"backup", "-o", nowhere}, "K. Keeper"), archive({"migrate", "--to", nowhere}),
                               gumcert({"archive", "init", "--store", nowhere, "--by", "K. Keeper"})}) {
        EXPECT_EQ(ended.code, 5) << ended.err;
        EXPECT_TRUE(tells(ended, "GC-STORE-0002")) << ended.err;
    }
}

/// "N/1" and "N_1" have one name of a file: evidence of the one does not take the place of that of the other.
TEST_F(ArchiveOfALaboratory, KeepsEvidenceOfTwoCertificatesApart) {
    begin();
    const auto exported = [&](const std::string& number) {
        return gumcert({"archive", "export", number, "--store", store(), "--share", GUMCERT_SOURCE_DIR},
                       {.working_folder = folder()});
    };

    for (const char* const number : {"N/1", "N_1", "N/2"}) {
        change_certificate([&](json& c) { c["number"] = number; });
        evaluate("one");
        ASSERT_EQ(archive(files("add", "one"), "R. Lin").code, 0);
    }
    EXPECT_EQ(exported("N/1").code, 0);
    EXPECT_EQ(exported("N/1").code, 0) << "newer evidence of the same certificate";
    const std::string first = bytes_of(folder() / "N_1-evidence.json");
    const Ended other = exported("N_1");
    EXPECT_EQ(other.code, 2);
    EXPECT_TRUE(tells(other, "is evidence of N/1, not of N_1")) << other.err;
    EXPECT_EQ(bytes_of(folder() / "N_1-evidence.json"), first);
    EXPECT_EQ(exported("N/2").code, 0);
    EXPECT_EQ(archive({"export", "N_1", "-o", path("N_1-evidence.json")}).code, 0) << "by its name it is asked for";
}

TEST_F(ArchiveOfALaboratory, ProvesByHeadsAloneThatTheLogOnlyGrew) {
    issue_the_example();
    ASSERT_EQ(archive({"head", "-o", path("early.json")}).code, 0);
    ASSERT_EQ(archive({"withdraw", "EX-2026-0042", "--why", "the standard was wrong"}, "M. Weber").code, 0);
    ASSERT_EQ(archive({"head", "-o", path("plain.json")}).code, 0);
    ASSERT_EQ(archive({"head", "--since", path("early.json"), "-o", path("late.json")}).code, 0);
    const auto verified = [&](const char* head) {
        const Ended ended = gumcert({"archive", "verify", path(head), "--head", path("early.json")});
        EXPECT_EQ(verified_elsewhere({path(head), "--head", path("early.json")}).code, ended.code) << head;
        return ended;
    };
    const Ended sound = verified("late.json");
    EXPECT_EQ(sound.code, 0) << sound.err;
    EXPECT_TRUE(tells(sound, "extends a head of 5 entries"));
    EXPECT_TRUE(tells(verified("plain.json"), "[GC-ARCHIVE-0051]"));
    change_json(folder() / "late.json", [](json& head) { head["root"] = head["chain"]; });
    EXPECT_EQ(verified("late.json").code, 1);
    // An archive that does not begin with the earlier head makes no proof.
    fs::remove(store());
    begin();
    const Ended other = archive({"head", "--since", path("early.json")});
    EXPECT_EQ(other.code, 3);
    EXPECT_TRUE(tells(other, "[GC-ARCHIVE-0036]"));
}

TEST_F(ArchiveOfALaboratory, SeesThatTheEndWasCutOff) {
    issue_the_example();
    ASSERT_EQ(archive({"backup", "-o", path("early.archive")}, "K. Keeper").code, 0);
    ASSERT_EQ(archive({"withdraw", "EX-2026-0042", "--why", "the standard was wrong"}, "M. Weber").code, 0);
    ASSERT_EQ(archive({"head", "-o", path("head.json")}).code, 0);
    EXPECT_EQ(archive({"verify", "--head", path("head.json")}).code, 0);
    fs::copy_file(path("early.archive"), store(), fs::copy_options::overwrite_existing);
    EXPECT_EQ(archive({"verify"}).code, 0) << "by itself it is sound";
    const Ended ended = archive({"verify", "--head", path("head.json")});
    EXPECT_EQ(ended.code, 1);
    EXPECT_TRUE(tells(ended, "[GC-ARCHIVE-0045]")) << ended.err;
    EXPECT_EQ(verified_elsewhere({store(), "--head", path("head.json")}).code, 1);
}

TEST_F(ArchiveOfALaboratory, TakesTwoCopiesOfOneHeadForOne) {
    issue_the_example();
    for (const char* const name : {"a.json", "b.json"}) {
        ASSERT_EQ(archive({"head", "-o", path(name)}).code, 0);
    }
    const Ended ended = gumcert({"archive", "verify", path("a.json"), "--head", path("b.json")});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(verified_elsewhere({path("a.json"), "--head", path("b.json")}).code, 0);
}

TEST_F(ArchiveOfALaboratory, SignsItsHead) {
    issue_the_example();
    write_bytes(folder() / "key.pem",
                "-----BEGIN PRIVATE KEY-----\nMC4CAQAwBQYDK2VwBCIEINTuctv5E1hK1bbY8fdp+K06/nwoy/HU++CXqI9EdVhC\n"
                "-----END PRIVATE KEY-----\n");  // RFC 8410, 10.3
    write_bytes(folder() / "public.pem",
                "-----BEGIN PUBLIC KEY-----\nMCowBQYDK2VwAyEAGb9ECWmEzf6FQbrBZ9w7lshQhqowtrbLDFw4rXAxZuE=\n"
                "-----END PUBLIC KEY-----\n");
    ASSERT_EQ(archive({"head", "--sign", path("key.pem"), "-o", path("head.json")}).code, 0);
    EXPECT_EQ(archive({"verify", "--head", path("head.json"), "--trust", path("public.pem")}).code, 0);
    const std::string key = "19bf44096984cdfe8541bac167dc3b96c85086aa30b6b6cb0c5c38ad703166e1";
    EXPECT_EQ(verified_elsewhere({store(), "--head", path("head.json"), "--public-key", key}).code, 0);
    change_json(folder() / "head.json", [](json& head) { head["at"] = "2026-01-01T00:00:00Z"; });
    EXPECT_TRUE(tells(archive({"verify", "--head", path("head.json")}), "[GC-ARCHIVE-0050]"));
    EXPECT_TRUE(
        tells(verified_elsewhere({store(), "--head", path("head.json")}), "the signature is not one of this head"));
    ASSERT_EQ(archive({"head", "-o", path("head.json")}).code, 0);
    EXPECT_TRUE(
        tells(archive({"verify", "--head", path("head.json"), "--trust", path("public.pem")}), "[GC-ARCHIVE-0050]"));
    EXPECT_EQ(verified_elsewhere({store(), "--head", path("head.json"), "--public-key", key}).code, 1);
}

TEST_F(ArchiveOfALaboratory, ProvesTheStateAndTheDocumentsOfACertificate) {
    issue_the_example();
    write_bytes(folder() / "key.pem",
                "-----BEGIN PRIVATE KEY-----\nMC4CAQAwBQYDK2VwBCIEINTuctv5E1hK1bbY8fdp+K06/nwoy/HU++CXqI9EdVhC\n"
                "-----END PRIVATE KEY-----\n");  // RFC 8410, 10.3
    write_bytes(folder() / "public.pem",
                "-----BEGIN PUBLIC KEY-----\nMCowBQYDK2VwAyEAGb9ECWmEzf6FQbrBZ9w7lshQhqowtrbLDFw4rXAxZuE=\n"
                "-----END PUBLIC KEY-----\n");
    const std::string key = "19bf44096984cdfe8541bac167dc3b96c85086aa30b6b6cb0c5c38ad703166e1";
    ASSERT_EQ(archive({"withdraw", "EX-2026-0042", "--why", "the standard was wrong"}, "M. Weber").code, 0);
    ASSERT_EQ(archive({"export", "EX-2026-0042", "--sign", path("key.pem"), "-o", path("evidence.json")}).code, 0);
    const auto verified = [&](std::vector<std::string> words) {
        std::vector<std::string> elsewhere = words;
        elsewhere.insert(elsewhere.end(), {"--public-key", key});
        words.insert(words.begin(), {"archive", "verify"});
        words.insert(words.end(), {"--trust", path("public.pem")});
        const Ended ended = gumcert(words);
        EXPECT_EQ(verified_elsewhere(elsewhere).code, ended.code) << words[2];
        return ended;
    };
    const Ended sound = verified({path("evidence.json"), path("first.html")});
    EXPECT_EQ(sound.code, 0) << sound.err;
    EXPECT_TRUE(tells(sound, "certificate EX-2026-0042, withdrawn, as the archive stood at"));
    EXPECT_TRUE(tells(sound, "first.html: is the document first.html of EX-2026-0042"));
    write_bytes(folder() / "other.pdf", "%PDF-1.7 another");
    EXPECT_TRUE(tells(verified({path("evidence.json"), path("other.pdf")}), "[GC-ARCHIVE-0057]"));
    EXPECT_TRUE(tells(gumcert({"archive", "verify", path("evidence.json")}), "that no other entry followed is not"));
    change_json(folder() / "evidence.json", [](json& evidence) { evidence["entries"].erase(5); });
    EXPECT_TRUE(tells(verified({path("evidence.json")}), "[GC-ARCHIVE-0056]")) << "the withdrawal was left out";
    EXPECT_TRUE(tells(archive({"verify", "--trust", path("public.pem")}), "--trust says nothing here"));
}

/// Whatever a person, a reason or a key says: show has one line of each entry, and no control characters.
TEST_F(ArchiveOfALaboratory, ShowsTextsOfOthersInOneLine) {
    issue_the_example();
    const std::string why = "wrong\n      99  2026-11-28T00:00:00Z  issued      M. Weber\x1B[31m\xE2\x80\xAE";
    ASSERT_EQ(archive({"withdraw", "EX-2026-0042", "--why", why}, "M. Weber").code, 0);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"show", "EX-2026-0042"}, {"list"}, {"verify"}, {"statistics"}, {"head"}}) {
        const Ended ended = archive(words);
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(ended.out.find('\x1B'), std::string::npos) << words[0];
        EXPECT_EQ(ended.out.find("\xE2\x80\xAE"), std::string::npos) << words[0];
        EXPECT_EQ(ended.out.find("\n      99  "), std::string::npos) << words[0];
    }
    EXPECT_TRUE(tells(archive({"show", "EX-2026-0042"}), "wrong\\u{000A}"));
}

TEST_F(ArchiveOfALaboratory, BacksUpAndReplays) {
    issue_the_example();
    const Ended ended = archive({"backup", "-o", path("copy.archive")}, "K. Keeper");
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(archive({"backup", "-o", path("copy.archive")}, "K. Keeper").code, 2) << "a backup is a new file";
    constexpr fs::perms k_write = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
    EXPECT_EQ(fs::status(path("copy.archive")).permissions() & k_write, fs::perms::none)
        << "two archives would give out the same numbers";
    EXPECT_NE(fs::status(store()).permissions() & k_write, fs::perms::none);
    fs::rename(path("copy.archive"), store());
    EXPECT_EQ(archive({"verify"}).code, 0);
    const json replayed = shown({"replay"});
    EXPECT_EQ(replayed["records"], 1);
    EXPECT_EQ(replayed["same"], 1);
    EXPECT_TRUE(tells(archive({"replay", "EX-2026-0042"}), "1 of 1 records give the same"));
    EXPECT_TRUE(tells(archive({"replay", "EX-1"}), "[GC-ARCHIVE-0026]"));
}

TEST_F(ArchiveOfALaboratory, AnExportBringsAnInterruptedFolderIntoOrder) {
    issue_the_example();
    const fs::path out = folder() / "exports";
    write_bytes(out / ".gumcert-unfinished.json", "torn");
    const Ended refused = archive({"export", "EX-2026-0042", "-o", (out / "evidence.json").string()});
    EXPECT_EQ(refused.code, 5);
    EXPECT_TRUE(tells(refused, "[GC-STORE-0013]")) << refused.err;
    EXPECT_FALSE(fs::exists(out / "evidence.json"));
    fs::remove(out / ".gumcert-unfinished.json");
    EXPECT_EQ(archive({"export", "EX-2026-0042", "-o", (out / "evidence.json").string()}).code, 0);
    EXPECT_EQ(archive({"head", "-o", (out / "head.json").string()}).code, 0);
    EXPECT_TRUE(fs::exists(out / "head.json"));
}

TEST_F(ArchiveOfALaboratory, ProvesEachCertificateWithoutTheArchive) {
    issue_the_example();
    ASSERT_EQ(archive({"export", "EX-2026-0042", "-o", path("evidence.json")}).code, 0);
    fs::remove(store());
    EXPECT_EQ(gumcert({"archive", "verify", path("evidence.json")}).code, 0);
    EXPECT_EQ(verified_elsewhere({path("evidence.json")}).code, 0);
    for (const std::string& document : {path("first.xml"), path("first.html")}) {
        const Ended alone = verified_elsewhere({document, path("evidence.json")});
        EXPECT_EQ(alone.code, 2) << "what stands before evidence is no document of it";
        EXPECT_FALSE(tells(alone, "NOT SOUND")) << alone.out;
        EXPECT_NE(gumcert({"archive", "verify", document}).code, 1);
    }
    const json good = json::parse(bytes_of(folder() / "evidence.json"));
    const std::vector<std::function<void(json&)>> attacks = {
        [](json& e) { e["entries"].back()["actor"] = "N. Obody"; },
        [](json& e) { e["entries"].erase(1); },
        [](json& e) { e["contents"].erase(0); },
        [](json& e) { e["contents"][0]["base64"] = "AAAA"; },
        [](json& e) { e["head"]["root"] = std::string(64, '0'); },
        [](json& e) { e["entries"][1]["proof"][0] = std::string(64, '0'); },
        [](json& e) { e["certificate"] = "EX-2026-0043"; }};
    for (std::size_t i = 0; i < attacks.size(); ++i) {
        json spoiled = good;
        attacks[i](spoiled);
        write_bytes(folder() / "evidence.json", spoiled.dump());
        EXPECT_EQ(gumcert({"archive", "verify", path("evidence.json")}).code, 1) << i;
        EXPECT_EQ(verified_elsewhere({path("evidence.json")}).code, 1) << i;
    }
    write_bytes(folder() / "evidence.json", "{}");
    EXPECT_TRUE(tells(gumcert({"archive", "verify", path("evidence.json")}), "[GC-ARCHIVE-0047]"));
}

TEST_F(ArchiveOfALaboratory, PrintsItsHeadOnTheCertificate) {
    begin();
    evaluate("first");
    const auto rendered = [&](const std::string& form, const std::string& file) {
        return gumcert({"render", path("first.json"), "--format", form, "--head", path("head.json"), "--check-at",
                        "https://lab.example/check", "-o", path(file.c_str()), "--share", GUMCERT_SOURCE_DIR});
    };
    ASSERT_EQ(archive({"head", "-o", path("head.json")}).code, 0);
    ASSERT_EQ(rendered("html", "early.html").code, 0);
    const Ended early = archive({"add", path("first.json"), path("early.html")}, "R. Lin");
    EXPECT_EQ(early.code, 3);
    EXPECT_TRUE(tells(early, "[GC-ARCHIVE-0037]")) << early.err;

    ASSERT_EQ(archive({"add", path("first.json")}, "R. Lin").code, 0);
    ASSERT_EQ(archive({"head", "-o", path("head.json")}).code, 0);
    const Ended html = rendered("html", "first.html");
    ASSERT_EQ(html.code, 0) << html.err;
    const json head = json::parse(bytes_of(path("head.json")));
    const std::string mark = "gumcert-head:2:" + head["root"].get<std::string>();
    EXPECT_NE(bytes_of(path("first.html")).find(mark), std::string::npos);
    EXPECT_NE(bytes_of(path("first.html")).find("https://lab.example/check"), std::string::npos);
    std::vector<std::string> files{"add", path("first.json"), path("first.html")};
    if (why_no_pdf().empty()) {
        const Ended pdf = rendered("pdf", "first.pdf");
        ASSERT_EQ(pdf.code, 0) << pdf.err;
        EXPECT_NE(bytes_of(path("first.pdf")).find(mark), std::string::npos);
        files.push_back(path("first.pdf"));
    }
    const Ended added = archive(files, "R. Lin");
    ASSERT_EQ(added.code, 0) << added.err;
    lead_to_issue("EX-2026-0042");
    EXPECT_EQ(archive({"verify"}).code, 0);
    EXPECT_EQ(verified_elsewhere({store()}).code, 0);

    ASSERT_EQ(archive({"export", "EX-2026-0042", "-o", path("evidence.json")}).code, 0);
    EXPECT_EQ(gumcert({"archive", "verify", path("evidence.json")}).code, 0);
    EXPECT_EQ(verified_elsewhere({path("evidence.json")}).code, 0);
    change_json(path("evidence.json"), [](json& evidence) { evidence.erase("printed_heads"); });
    EXPECT_TRUE(tells(gumcert({"archive", "verify", path("evidence.json")}), "[GC-ARCHIVE-0053]"));
    EXPECT_EQ(verified_elsewhere({path("evidence.json")}).code, 1);
}

TEST_F(ArchiveOfALaboratory, PrintsAHeadOnDocumentsForPeopleOnly) {
    EXPECT_EQ(gumcert({"render", "r.json", "--format", "dcc", "--head", "head.json"}).code, 2);
    EXPECT_EQ(gumcert({"render", "r.json", "--format", "pdf", "--check-at", "here"}).code, 2);
}

TEST_F(ArchiveOfALaboratory, KeepsThePdf) {
    if (const std::string why = why_no_pdf(); !why.empty()) {
        GTEST_SKIP() << why;
    }
    begin();
    ASSERT_EQ(run(folder() / "end_gauge.json", folder() / "out").code, 0);
    const Ended ended = archive({"add", path("out/record.json"), path("out/certificate.pdf")}, "R. Lin");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(tells(ended, "not compared: other texts")) << ended.err;
    EXPECT_FALSE(tells(ended, "beside its pages")) << ended.err;
    // What it is called among its properties is told where the pages say something else.
    std::string renamed_pdf = bytes_of(folder() / "out" / "certificate.pdf");
    const std::string title = "Calibration of an end gauge";
    const std::string other_title = "l = 49 mm; U = 1 nm; passed";
    const std::size_t at = renamed_pdf.find(title, renamed_pdf.find("<dc:title>"));
    ASSERT_NE(at, std::string::npos);
    ASSERT_EQ(title.size(), other_title.size());
    write_bytes(folder() / "renamed.pdf", renamed_pdf.replace(at, title.size(), other_title));
    const Ended retitled = archive({"add", path("out/record.json"), path("renamed.pdf")}, "R. Lin");
    EXPECT_EQ(retitled.code, 0) << retitled.err;
    EXPECT_TRUE(tells(retitled, "texts that they do not print: metadata")) << retitled.err;
    EXPECT_TRUE(tells(retitled, other_title)) << retitled.err;
    change_certificate([](json& c) { c["customer"]["name"] = "Another Customer"; });
    evaluate("renamed");
    const Ended renamed = archive({"add", path("renamed.json"), path("out/certificate.pdf")}, "R. Lin");
    EXPECT_TRUE(tells(renamed, "[GC-ARCHIVE-0038]")) << renamed.err;
    EXPECT_TRUE(tells(renamed, "Another Customer")) << renamed.err;
    change_certificate([](json& c) { c["number"] = "EX-2026-0099"; });
    evaluate("other");
    EXPECT_TRUE(
        tells(archive({"add", path("other.json"), path("out/certificate.pdf")}, "R. Lin"), "[GC-ARCHIVE-0029]"));
}

/// The log that is copied is the same: heads and evidence of the one hold for the other, and both verifiers read it.
/// A server that takes a connection and says nothing.
class SilentServer {
public:
    SilentServer() {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
        EXPECT_EQ(listen(socket_, 4), 0);
        EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
        port_ = ntohs(address.sin_port);
    }
    ~SilentServer() { close(socket_); }
    SilentServer(const SilentServer&) = delete;
    SilentServer& operator=(const SilentServer&) = delete;
    [[nodiscard]] int port() const { return port_; }
    /// Waits for a client.
    void meet() const {
        const int client = accept(socket_, nullptr, nullptr);
        EXPECT_GE(client, 0);
        // It stays open: the client waits for an answer.
    }

private:
    int socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    int port_ = 0;
};

TEST_F(ArchiveOfALaboratory, ShowsNoPasswordInTheListOfProcesses) {
    const SilentServer server;
    const std::string at = "@127.0.0.1:" + std::to_string(server.port()) + "/archive";
    std::string address = "postgresql://keeper:geheim" + at + "?sslmode=disable&sslpassword=auchgeheim";
    std::vector<std::string> words = {GUMCERT_PROGRAM, "archive", "list", "--store", address};
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    pid_t child = 0;
    ASSERT_EQ(posix_spawn(&child, GUMCERT_PROGRAM, nullptr, nullptr, argv.data(), environ), 0);
    server.meet();  // the command line was read, and the password is on its way
    const std::string shown = bytes_of("/proc/" + std::to_string(child) + "/cmdline");
    EXPECT_NE(shown.find("postgresql://keeper:xxxxxx" + at), std::string::npos) << shown;
    EXPECT_EQ(shown.find("geheim"), std::string::npos) << shown;
    kill(child, SIGKILL);
    EXPECT_EQ(waitpid(child, nullptr, 0), child);
}

TEST_F(ArchiveOfALaboratory, MigratesIntoANewArchive) {
    issue_the_example();
    ASSERT_EQ(archive({"head", "-o", path("head.json")}).code, 0);
    Ended ended = archive({"migrate", "--to", path("other.archive")});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(tells(ended, "sound")) << ended.out;
    ended = gumcert({"archive", "verify", "--store", path("other.archive"), "--head", path("head.json")});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(verified_elsewhere({path("other.archive"), "--head", path("head.json")}).code, 0);
    EXPECT_EQ(archive({"migrate", "--to", path("other.archive")}).code, 5) << "it is there already";
    EXPECT_EQ(archive({"migrate"}).code, 2) << "--to is missing";
    ended = archive({"migrate", "--to", "postgresql://keeper:secret@/x?host=/nowhere"});
    EXPECT_EQ(ended.code, 5);
    EXPECT_FALSE(tells(ended, "secret")) << ended.err;
}

TEST_F(ArchiveOfALaboratory, CountsWhatItDid) {
    issue_the_example();
    const json counted = shown({"statistics"});
    EXPECT_EQ(counted["by_state"]["issued"], 1);
    EXPECT_EQ(counted["by_month"].size(), 1U) << "the month of the entry";
    EXPECT_EQ(counted["by_authoriser"][k_authoriser], 1);
    EXPECT_EQ(counted["by_method"]["CP-01"], 1);
    EXPECT_TRUE(tells(archive({"statistics"}), "Certificates by state")) << "for people, too";
}

/// What a backup that was killed left beside its place goes with the next one.
TEST_F(ArchiveOfALaboratory, BacksUpAfterABackupThatWasKilled) {
    begin();
    const fs::path left = folder() / "gumcert-work-ABCDEF";
    fs::create_directory(left);
    chmod(left.c_str(), 0700);
    write_bytes(left / "copy.archive", "half of an archive");
    const Ended ended = archive({"backup", "-o", path("copy.archive")}, "K. Keeper");
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_FALSE(fs::exists(left));
    EXPECT_EQ(verified_elsewhere({path("copy.archive")}).code, 0);
    for (const auto& entry : fs::directory_iterator(folder())) {
        EXPECT_FALSE(entry.path().filename().string().starts_with("gumcert-work")) << "the copy has moved";
    }
}

}  // namespace
}  // namespace gumcert::cli
