// What the program reads, what its units mean, and what it never overwrites.
#include <sys/stat.h>

#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

class ReadAndOverwritten : public ProgramTest {
protected:
    /// A budget job with one equation and inputs as JSON.
    fs::path budget(const std::string& name, const std::string& model, const std::string& inputs,
                    const std::string& outputs = "{}") const {
        const fs::path job = folder() / name;
        write_bytes(job, R"({"schema": "gumcert/job/1", "kind": "budget", "title": "t", "model": [)" + model +
                             R"(], "inputs": {)" + inputs + R"(}, "outputs": )" + outputs + "}");
        return job;
    }
    static std::vector<std::string> codes(const Ended& ended) {
        std::vector<std::string> all;
        for (const Message& message : json_messages(ended)) {
            all.push_back(message.code);
        }
        return all;
    }
    static bool has(const std::vector<std::string>& all, const std::string& code) {
        return std::find(all.begin(), all.end(), code) != all.end();
    }
};

TEST_F(ReadAndOverwritten, SquareRootsGiveUnits) {
    const std::string inputs = R"m("e": {"value": 4.2, "u": 0.1, "unit": "nV/Hz^(1/2)"},
                                  "B": {"value": 10, "u": 0.1, "unit": "kHz"})m";
    const nlohmann::json record = evaluate(
        budget("noise.json", R"m("U = e*sqrt(B)", "d = U/sqrt(B)")m", inputs, R"({"U": {"unit": "nV"}, "d": {}})"));
    ASSERT_TRUE(record.is_object());
    EXPECT_NEAR(record["results"]["U"]["value"].get<double>(), 420.0, 1e-9);
    EXPECT_NEAR(record["results"]["d"]["value"].get<double>(), 4.2, 1e-12);  // the unit of its input
    EXPECT_NE(record["results"]["d"]["unit"].get<std::string>().find("^("), std::string::npos);
    EXPECT_EQ(record["options"]["unit_table_sha256"].get<std::string>().size(), 64U);
    const fs::path again = folder() / "again.json";
    write_bytes(again, record.dump());
    const Ended text =
        gumcert({"render", again.string(), "--format", "text", "-o", "-", "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.out.find("nV/√Hz"), std::string::npos);
    const Ended dcc = gumcert({"render", again.string(), "--format", "dcc", "-o", "-", "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(dcc.code, 0) << dcc.err;
    EXPECT_NE(dcc.out.find("\\nano\\volt\\hertz\\tothe{-0.5}"), std::string::npos);
}

TEST_F(ReadAndOverwritten, UnitsWithTwoReadingsAreRefusedWithTheCure) {
    for (const std::string unit : {"nV/Hz^0.5", "m^3/2", "Hz-1/2", "1.5e3.5 m", "10^-6.5 m", "m 3/2", "Hz0.5", "J/kg K",
                                   "2m", "m2.5", "kt", "ton"}) {
        const fs::path job =
            budget("u.json", R"("y = a")", R"("a": {"value": 4.2, "u": 0.1, "unit": ")" + unit + "\"}");
        const Ended ended = gumcert({"evaluate", job.string(), "--json-messages", "-o", "-"});
        EXPECT_EQ(ended.code, 3) << unit;
        EXPECT_EQ(ended.out, "") << unit;
        const auto all = codes(ended);
        EXPECT_TRUE(!all.empty() && all.front().starts_with("GC-UNIT-")) << unit << ended.err;
    }
}

/// Units do not come from the machine.
TEST_F(ReadAndOverwritten, NoEnvironmentChangesAUnit) {
    const fs::path job =
        budget("mm.json", R"("y = a")", R"("a": {"value": 1, "u": 0.1, "unit": "mm"})", R"({"y": {"unit": "um"}})");
    write_bytes(folder() / "units" / "udunits2.xml", "<unit-system/>");
    const Ended plain = gumcert({"evaluate", job.string(), "-o", "-"});
    const Ended other = gumcert({"evaluate", job.string(), "-o", "-"},
                                {.environment = {{"UDUNITS2_XML_PATH", (folder() / "units/udunits2.xml").string()}}});
    EXPECT_EQ(plain.code, 0);
    EXPECT_EQ(plain.out, other.out);
    EXPECT_EQ(nlohmann::json::parse(plain.out)["results"]["y"]["value"], 1000.0);
}

TEST_F(ReadAndOverwritten, UncertaintyOfZeroIsSaidOnPurpose) {
    const std::string a = R"("a": {"value": 3, "u": 0.1, "unit": "m"})";
    for (const char* model : {R"("y = a - a")", R"("y = 0*a")", R"("h = a", "y = h - a")"}) {
        const Ended ended = gumcert({"evaluate", budget("z.json", model, a).string(), "--json-messages", "-o", "-"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_TRUE(has(codes(ended), "GC-BUDGET-0029")) << model << ended.err;
        const nlohmann::json result = nlohmann::json::parse(ended.out)["results"]["y"];
        EXPECT_TRUE(result["k"].is_null()) << model;
        EXPECT_TRUE(result["U"].is_null()) << model;
    }
    const std::string c = R"("c": {"value": 3, "constant": true, "unit": "m"}, )" + a;
    const Ended ended =
        gumcert({"evaluate", budget("c.json", R"("y = 2*c", "z = a")", c).string(), "--json-messages", "-o", "-"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_FALSE(has(codes(ended), "GC-BUDGET-0029")) << ended.err;
    const nlohmann::json result = nlohmann::json::parse(ended.out)["results"]["y"];
    EXPECT_TRUE(result["k"].is_null());
    EXPECT_EQ(result["U"], 0.0);
    EXPECT_NE(result["coverage_note"].get<std::string>().find("exact, by definition"), std::string::npos);
}

TEST_F(ReadAndOverwritten, ResultThatIsAnInputHasTheUnitThatIsAskedFor) {
    const fs::path job = folder() / "in.json";
    write_bytes(job, R"({"schema": "gumcert/job/1", "kind": "budget", "title": "t",
                         "inputs": {"l": {"value": 1.5, "u": 0.1, "unit": "mm"}}, "outputs": {"l": {"unit": "um"}}})");
    const nlohmann::json record = evaluate(job);
    EXPECT_EQ(record["results"]["l"]["unit"], "um");
    EXPECT_EQ(record["results"]["l"]["value"], 1500.0);
}

TEST_F(ReadAndOverwritten, AnImportLeavesItsTrustStore) {
    const std::string certificate = (folder() / "certificate.xml").string();
    const std::string trust = (folder() / "trust.pem").string();
    write_bytes(certificate, "<x/>");
    write_bytes(trust, "trusted");
    for (const std::string& output : {certificate, trust}) {
        const Ended ended = gumcert({"import", "dcc", certificate, "--trust", trust, "-o", output, "--json-messages"});
        EXPECT_EQ(ended.code, 5) << output << ended.err;
        EXPECT_EQ(codes(ended), std::vector<std::string>{"GC-STORE-0004"}) << output;
    }
    EXPECT_EQ(bytes_of(trust), "trusted");
}

/// No name of a file leads to exit 70, to a message without a place, or to waiting.
TEST_F(ReadAndOverwritten, AnyNameIsToldWithItsPlace) {
    const fs::path job = budget("j.json", R"("y = a")", R"("a": {"value": 1, "u": 0.1})");
    mkfifo((folder() / "fifo").c_str(), 0600);
    fs::create_symlink("j.json", folder() / "link.json");
    const std::string fifo = (folder() / "fifo").string();
    const std::string place = folder().string();
    const std::string longest(300, 'n');
    for (const std::string& name : {std::string(), place, place + "/", fifo, std::string("/dev/zero"), longest,
                                    place + "/" + longest, place + "/absent/", std::string(5000, 'p')}) {
        for (const std::vector<std::string>& command :
             std::vector<std::vector<std::string>>{{"evaluate", name, "-o", "-"},
                                                   {"compare", name, "-o", "-"},
                                                   {"plan", name},
                                                   {"simulate", name},
                                                   {"render", name, "--format", "text", "-o", "-"},
                                                   {"import", "dcc", name},
                                                   {"verify", name, "--trust", name},
                                                   {"verify", job.string(), "--trust", name},
                                                   {"run", job.string(), "--sign", name, "-o", place + "/signed"},
                                                   {"evaluate", job.string(), "-o", name.empty() ? place : name}}) {
            std::vector<std::string> arguments = command;
            arguments.emplace_back("--json-messages");
            if (command[0] == "run" && name.empty()) {
                continue;  // no signer
            }
            const Ended ended = gumcert(arguments);
            EXPECT_GE(ended.code, 2) << command[0] << " " << name;
            EXPECT_LE(ended.code, 5) << command[0] << " " << name << ended.err;
            EXPECT_FALSE(json_messages(ended).empty()) << command[0] << " " << name;
        }
    }
    for (const std::string& output : {fifo, (folder() / "link.json").string(), std::string("/dev/null")}) {
        const Ended ended = gumcert({"evaluate", job.string(), "-o", output, "--json-messages"});
        EXPECT_EQ(ended.code, 5) << output;
        EXPECT_EQ(codes(ended).front(), "GC-STORE-0005") << output;
    }
    EXPECT_TRUE(fs::is_symlink(folder() / "link.json"));
    EXPECT_TRUE(fs::is_fifo(folder() / "fifo"));
}

/// The name of a file in a job shows where it is; what the user names on the command line may be a link.
TEST_F(ReadAndOverwritten, NoSymbolicLinkLeadsOutOfTheFolderOfAJob) {
    write_bytes(folder() / "secret.csv", "a\n1\n");
    const auto job = [&](const std::string& points) {
        const fs::path file = folder() / "jobs" / "points.json";
        write_bytes(file, R"({"schema": "gumcert/job/1", "kind": "budget", "title": "t", "model": ["y = a"], "inputs":
                              {"a": {"value": 1, "u": 0.1}}, "points": {"file": ")" +
                              points + "\"}}");
        return file;
    };
    const auto evaluated = [&](const fs::path& file) {
        return gumcert({"evaluate", file.string(), "-o", "-", "--json-messages", "--share", GUMCERT_SOURCE_DIR});
    };
    (void)job("secret.csv");
    fs::create_symlink("../secret.csv", folder() / "jobs" / "link.csv");
    fs::create_symlink(folder() / "secret.csv", folder() / "jobs" / "absolute.csv");
    for (const char* name : {"link.csv", "absolute.csv"}) {
        const Ended ended = evaluated(job(name));
        EXPECT_EQ(ended.code, 5) << ended.err;
        EXPECT_EQ(codes(ended).front(), "GC-STORAGE-0002") << ended.err;
        EXPECT_EQ(ended.err.find("secret"), std::string::npos) << ended.err;
    }
    const Ended named = evaluated(job("../secret.csv"));
    EXPECT_EQ(named.code, 0) << "a name that says so: " << named.err;
    fs::create_symlink("jobs/points.json", folder() / "job_link.json");
    fs::copy_file(folder() / "secret.csv", folder() / "near.csv");
    (void)job("near.csv");
    const Ended linked = evaluated(folder() / "job_link.json");
    EXPECT_EQ(linked.code, 0) << "the job itself may be a link: " << linked.err;
}

/// Whatever is named on the command line is there, byte by byte, when the command has ended.
TEST_F(ReadAndOverwritten, NothingThatIsReadIsOverwritten) {
    const fs::path job = budget("job.json", R"("y = a")", R"("a": {"value": 1, "u": 0.1})");
    const Ended made = gumcert({"evaluate", job.string(), "-o", (folder() / "record.json").string()});
    ASSERT_EQ(made.code, 0) << made.err;
    for (const char* name : {"chain.pem", "key.pem", "words.txt"}) {
        write_bytes(folder() / name, name);
    }
    write_bytes(folder() / "s.json",
                R"({"certificates": "chain.pem", "key": "key.pem", "passphrase_file": "words.txt"})");
    const auto before = contents_of(folder());
    const std::string at = folder().string() + "/";
    for (const char* name : {"job.json", "new/../job.json", "./job.json", "new/deeper/../../job.json"}) {
        const Ended ended = gumcert({"evaluate", job.string(), "-o", at + name, "--json-messages"});
        EXPECT_EQ(ended.code, 5) << name;
        EXPECT_EQ(codes(ended).front(), "GC-STORE-0004") << name;
    }
    for (const char* name : {"record.json", "s.json", "key.pem", "chain.pem", "words.txt", "new/../key.pem"}) {
        const Ended ended = gumcert({"render", at + "record.json", "--format", "dcc", "--sign", at + "s.json", "-o",
                                     at + name, "--share", GUMCERT_SOURCE_DIR, "--json-messages"});
        EXPECT_GE(ended.code, 2) << name;
        EXPECT_LE(ended.code, 5) << name;
    }
    for (const char* name : {"new.html.mustache", "certificate.html.mustache"}) {
        const Ended ended = gumcert({"render", at + "record.json", "--format", "text", "-o",
                                     std::string(GUMCERT_SOURCE_DIR) + "/templates/" + name, "--share",
                                     GUMCERT_SOURCE_DIR, "--json-messages"});
        EXPECT_EQ(ended.code, 5) << name;
        EXPECT_EQ(codes(ended).front(), "GC-STORE-0004") << name;
    }
    EXPECT_EQ(contents_of(folder()), before);
}

TEST_F(ReadAndOverwritten, PermissionsOfAnOutputAreKept) {
    const fs::path job = budget("job.json", R"("y = a")", R"("a": {"value": 1, "u": 0.1})");
    const fs::path record = folder() / "record.json";
    write_bytes(record, "old");
    fs::permissions(record, fs::perms::owner_read | fs::perms::owner_write);
    const Ended ended = gumcert({"evaluate", job.string(), "-o", record.string()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(fs::status(record).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(ReadAndOverwritten, RecordWithNulInATextIsRefused) {
    const fs::path job = budget("job.json", R"("y = a")", R"("a": {"value": 1, "u": 0.1})");
    nlohmann::json record = evaluate(job);
    record["title"] = std::string("a\0b", 3);
    write_bytes(folder() / "r.json", record.dump());
    const Ended ended =
        gumcert({"render", (folder() / "r.json").string(), "--format", "text", "-o", "-", "--json-messages"});
    EXPECT_EQ(ended.code, 3) << ended.err;
    EXPECT_TRUE(has(codes(ended), "GC-RECORD-0016")) << ended.err;
}

}  // namespace
}  // namespace gumcert::cli
