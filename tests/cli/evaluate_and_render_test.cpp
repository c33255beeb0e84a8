// `gumcert evaluate` and `gumcert render`: where they write, and that they write what `gumcert run` writes.
#include <cmath>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

class Evaluate : public ProgramTest {
protected:
    void SetUp() override { job_ = ExactCampaign{}.write(folder() / "job"); }
    fs::path job_;
};

/// The name of the only covariance file among files.
std::string covariance_among(const std::map<std::string, std::string>& files) {
    std::string found;
    for (const auto& [name, bytes] : files) {
        if (name.starts_with("covariance-") && name.ends_with(".csv")) {
            EXPECT_EQ(found, "") << "a second one: " << name;
            found = name;
        }
    }
    return found;
}

TEST_F(Evaluate, WritesRecordAndCovariance) {
    const fs::path record = folder() / "made" / "for it" / "table.json";
    const Ended ended = gumcert({"evaluate", job_.string(), "-o", record.string()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const auto files = contents_of(record.parent_path());
    EXPECT_EQ(files.size(), 3U) << "with the manifest";
    EXPECT_TRUE(files.contains("table.json"));
    const std::string covariance = covariance_among(files);
    EXPECT_NE(covariance, "");
    EXPECT_EQ(json::parse(files.at("table.json"))["rotary"]["covariance"]["file"], covariance);
}

TEST_F(Evaluate, CovarianceIsWrittenInTheFormAskedFor) {
    const auto named = [&](const std::string& form) -> std::string {
        const fs::path record = folder() / "made" / (form + ".json");
        EXPECT_EQ(gumcert({"evaluate", job_.string(), "--covariance", form, "-o", record.string()}).code, 0);
        const json covariance = json::parse(bytes_of(record))["rotary"]["covariance"];
        return covariance["file"].is_string() ? covariance["file"].get<std::string>() : "";
    };
    EXPECT_EQ(named("none"), "");
    EXPECT_TRUE(named("csv").ends_with(".csv"));
    for (const std::string form : {"npy", "parts"}) {
        const std::string name = named(form);
        EXPECT_TRUE(name.ends_with(form == "npy" ? ".npy" : "-parts.npy")) << name;
        EXPECT_EQ(bytes_of(folder() / "made" / name).substr(0, 6), "\x93NUMPY") << form;
    }
    EXPECT_EQ(gumcert({"evaluate", job_.string(), "--covariance", "mtx"}).code, 2);
}

TEST_F(Evaluate, TheRecordIsTheSameWhereverItIsWritten) {
    for (const char* name : {"a.json", "b.json", "deep/er/c"}) {
        const Ended ended = gumcert({"evaluate", job_.string(), "-o", (folder() / "made" / name).string()});
        ASSERT_EQ(ended.code, 0) << ended.err;
    }
    const auto files = contents_of(folder() / "made");
    EXPECT_EQ(files.at("a.json"), files.at("b.json"));
    EXPECT_EQ(files.at("a.json"), bytes_of(folder() / "made/deep/er/c"));
    EXPECT_NE(covariance_among(files), "") << "both records name one file, which is that of both";
    EXPECT_EQ(contents_of(folder() / "made/deep/er").count(covariance_among(files)), 1U);
}

TEST_F(Evaluate, WritesBesideTheJobByDefault) {
    const auto before = contents_of(job_.parent_path());
    ASSERT_EQ(gumcert({"evaluate", "job.json"}, {.working_folder = job_.parent_path()}).code, 0);
    auto after = contents_of(job_.parent_path());
    ASSERT_TRUE(after.contains("job-record.json"));
    EXPECT_EQ(json::parse(after["job-record.json"])["schema"], "gumcert/record/1");
    EXPECT_EQ(after.erase("job-record.json"), 1U);
    EXPECT_EQ(after.erase(covariance_among(after)), 1U);
    EXPECT_EQ(after.erase(".gumcert-set.json"), 1U);
    EXPECT_EQ(after, before);
}

TEST_F(Evaluate, WritesToStandardOutputAndNothingElseThere) {
    const auto before = contents_of(folder());
    const Ended ended = gumcert({"evaluate", job_.string(), "-o", "-"}, {.working_folder = folder()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(contents_of(folder()), before);
    json piped = json::parse(ended.out);  // throws when there is anything beside the record
    EXPECT_TRUE(piped["rotary"]["covariance"]["file"].is_null()) << "no such file was written";
    json written = evaluate(job_);
    EXPECT_TRUE(written["rotary"]["covariance"]["file"].get<std::string>().starts_with("covariance-"));
    for (json* record : {&piped, &written}) {
        (*record)["rotary"]["covariance"].erase("file");
        record->erase("digest");  // it follows from the rest
    }
    EXPECT_EQ(piped, written);
    for (const std::string& line : lines_of(ended.err)) {
        EXPECT_TRUE(is_message_line(line)) << line;
    }
}

TEST_F(Evaluate, FullStandardOutputIsTold) {
    if (!fs::exists("/dev/full")) {
        GTEST_SKIP() << "this system has no /dev/full";
    }
    const Ended ended = gumcert({"evaluate", job_.string(), "-o", "-"}, {.out = "/dev/full"});
    EXPECT_EQ(ended.code, 5);
    EXPECT_NE(ended.err.find("standard output"), std::string::npos) << ended.err;
}

/// Whoever does not see what a command says must see that: a number of an archive, an answer, a list.
TEST_F(Evaluate, NoWordsAreLostInSilence) {
    if (!fs::exists("/dev/full")) {
        GTEST_SKIP() << "this system has no /dev/full";
    }
    const std::string record = (folder() / "record.json").string();
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"--version"},
             {"--help"},
             {"limits"},
             {"explain", "GC-STORE-0003", "--share", GUMCERT_SOURCE_DIR},
             {"fonts", "--share", GUMCERT_SOURCE_DIR},
             {"check", job_.string(), "--share", GUMCERT_SOURCE_DIR},
             {"evaluate", job_.string(), "-o", record, "--share", GUMCERT_SOURCE_DIR},
             {"archive", "init", "--store", (folder() / "a.archive").string(), "--by", "K. Keeper"}}) {
        const Ended ended = gumcert(words, {.out = "/dev/full"});
        EXPECT_EQ(ended.code, 5) << words.front() << ended.err;
        EXPECT_NE(ended.err.find("GC-STORE-0003"), std::string::npos) << words.front() << ended.err;
    }
    EXPECT_TRUE(fs::exists(record)) << "what was written stays, and is whole";
    EXPECT_TRUE(fs::exists((folder() / "a.archive").string()));
}

class Render : public ProgramTest {
protected:
    static void SetUpTestSuite() {
        ASSERT_EQ(ExampleRun::shared().ended().code, 0) << ExampleRun::shared().ended().err;
    }

    [[nodiscard]] static std::string record() { return (ExampleRun::shared().folder() / "record.json").string(); }
    Ended render(const std::string& record_file, const std::string& format, const std::string& output,
                 std::vector<std::string> more = {}) const {
        more.insert(more.begin(),
                    {"render", record_file, "--format", format, "-o", output, "--share", GUMCERT_SOURCE_DIR});
        return gumcert(more);
    }
    /// A record that was changed is refused.
    /// \return its messages
    std::vector<Message> refusal(const std::string& bytes) const {
        write_bytes(folder() / "damaged.json", bytes);
        const auto before = contents_of(folder());
        const Ended ended =
            render((folder() / "damaged.json").string(), "html", (folder() / "out.html").string(), {"--json-messages"});
        EXPECT_EQ(ended.code, 3) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(contents_of(folder()), before) << "nothing is written";
        std::vector<Message> messages = json_messages(ended);
        EXPECT_FALSE(messages.empty());
        for (const Message& message : messages) {
            EXPECT_TRUE(message.code.starts_with("GC-RECORD-")) << message.code;
            EXPECT_EQ(message.severity, "error");
            EXPECT_NE(message.where.find("damaged.json"), std::string::npos) << message.where;
        }
        messages.resize(std::max<std::size_t>(messages.size(), 1));
        return messages;
    }
};

TEST_F(Render, HtmlAndPdfHaveTheBytesOfRun) {
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf() << ": gumcert run was not tested";
    }
    for (const std::string format : {"html", "pdf"}) {
        const Ended ended = render(record(), format, (folder() / "document").string());
        ASSERT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(ended.err, "");
        EXPECT_TRUE(bytes_of(folder() / "document") ==
                    bytes_of(ExampleRun::shared().folder() / ("certificate." + format)))
            << format;
    }
}

TEST_F(Render, TextHoldsTheResultsAndGoesToStandardOutput) {
    const Ended ended = render(record(), "text", "-");
    ASSERT_EQ(ended.code, 0) << ended.err;
    const json document = json::parse(bytes_of(record()));
    const std::string text = with_ascii_minus(ended.out);
    for (const auto& [name, result] : document["results"].items()) {
        EXPECT_NE(text.find(result["printed"]["value"].get<std::string>()), std::string::npos) << name;
        EXPECT_NE(ended.out.find(result["printed"]["U"].get<std::string>()), std::string::npos) << name;
    }
    ASSERT_EQ(render(record(), "text", (folder() / "certificate.txt").string()).code, 0);
    EXPECT_TRUE(bytes_of(folder() / "certificate.txt") == ended.out);
}

TEST_F(Render, WritesBesideTheRecordByDefault) {
    fs::copy_file(record(), folder() / "table.json");
    for (const auto& [format, name] :
         std::map<std::string, std::string>{{"html", "table.html"}, {"text", "table.txt"}}) {
        const Ended ended = gumcert({"render", (folder() / "table.json").string(), "--format", format, "--share",
                                     GUMCERT_SOURCE_DIR, "--language", "en"});
        ASSERT_EQ(ended.code, 0) << ended.err;
        EXPECT_TRUE(fs::exists(folder() / name));
        EXPECT_NE(ended.out.find(name), std::string::npos) << ended.out;
    }
    EXPECT_EQ(contents_of(folder()).size(), 3U);
}

TEST_F(Render, MissingRecordIsAFileTrouble) {
    const Ended ended =
        render((folder() / "missing.json").string(), "html", (folder() / "out.html").string(), {"--json-messages"});
    EXPECT_EQ(ended.code, 5);
    const std::vector<Message> messages = json_messages(ended);
    ASSERT_EQ(messages.size(), 1U) << ended.err;
    EXPECT_NE(messages[0].where.find("missing.json"), std::string::npos);
    EXPECT_TRUE(contents_of(folder()).empty());
}

TEST_F(Render, DamagedRecordsAreRefused) {
    const std::string whole = bytes_of(record());
    EXPECT_EQ(refusal("")[0].severity, "error");
    EXPECT_EQ(refusal(whole.substr(0, whole.size() / 2))[0].severity, "error");
    EXPECT_EQ(refusal(whole.substr(0, whole.size() - 3))[0].severity, "error");
    EXPECT_EQ(refusal("[]")[0].code, "GC-RECORD-0015");
    EXPECT_EQ(refusal("%PDF-1.7")[0].severity, "error");

    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return at == std::string::npos ? text : text.replace(at, from.size(), to);
    };
    const Message schema = refusal(replaced("gumcert/record/1", "gumcert/record/2"))[0];
    EXPECT_EQ(schema.code, "GC-RECORD-0020");
    EXPECT_TRUE(schema.where.ends_with("#/schema")) << schema.where;
    EXPECT_NE(schema.what.find("gumcert/record/2"), std::string::npos) << schema.what;

    // Text where a number stands, as a program that prints NaN would leave it.
    json document = json::parse(whole);
    const std::string k = digits(document["rotary"]["set_up"]["k"].get<double>());
    (void)refusal(replaced("\"k\": " + k, "\"k\": NaN"));
    document["rotary"]["errors"][3]["EYA"]["U"] = "NaN";
    EXPECT_TRUE(refusal(document.dump())[0].where.ends_with("#/rotary/errors/3/EYA/U"));
}

TEST_F(Render, RecordsThatContradictThemselvesAreRefused) {
    const json whole = json::parse(bytes_of(record()));
    json document = whole;
    document["rotary"]["errors"][0]["EXA"].erase("u");
    EXPECT_NE(refusal(document.dump())[0].where.find("/rotary/errors/0/EXA"), std::string::npos);
    document = whole;
    document["rotary"]["errors"][0]["EXA"]["u"] = -1.0;
    EXPECT_TRUE(refusal(document.dump())[0].where.ends_with("/rotary/errors/0/EXA/u"));
    document = whole;
    document["rotary"]["axis"] = "B";  // the error motions are still named after A
    EXPECT_FALSE(refusal(document.dump())[0].where.empty());
    document = whole;
    document["surprise"] = 1;
    EXPECT_NE(refusal(document.dump())[0].where.find("#"), std::string::npos);
    // Several at once are told together.
    document = whole;
    document["title"] = 7;
    document["rotary"]["datum"] = "elsewhere";
    document["rotary"]["stations"][2]["u_mm"][1] = -0.5;
    EXPECT_EQ(refusal(document.dump()).size(), 3U);
}

}  // namespace
}  // namespace gumcert::cli
