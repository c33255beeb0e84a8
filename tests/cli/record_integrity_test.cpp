// Nothing that a record says is believed, and what somebody else wrote is looked at.
#include <algorithm>
#include <fstream>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

class RecordIntegrity : public ProgramTest {
protected:
    RecordIntegrity() {
        const Ended made =
            gumcert({"evaluate", (shipped_example().parent_path() / "certificate/end_gauge.json").string(), "-o",
                     record().string(), "--share", GUMCERT_SOURCE_DIR});
        EXPECT_EQ(made.code, 0) << made.err;
    }
    [[nodiscard]] fs::path record() const { return folder_.path() / "record.json"; }
    [[nodiscard]] fs::path document() const { return folder_.path() / "document"; }
    void write(const json& changed) const { std::ofstream(record(), std::ios::binary) << changed.dump(); }
    [[nodiscard]] Ended render(std::vector<std::string> more = {}) const {
        std::vector<std::string> words{"--json-messages",   "render",  record().string(), "--format", "html", "-o",
                                       document().string(), "--share", GUMCERT_SOURCE_DIR};
        words.insert(words.end(), more.begin(), more.end());
        return gumcert(words);
    }
    static std::vector<std::string> codes(const Ended& ended) {
        std::vector<std::string> all;
        for (const Message& message : json_messages(ended)) {
            all.push_back(message.code);
        }
        return all;
    }
    static bool has(const Ended& ended, const std::string& code) {
        const std::vector<std::string> all = codes(ended);
        return std::find(all.begin(), all.end(), code) != all.end();
    }

    TemporaryFolder folder_;
};

TEST_F(RecordIntegrity, ARecordAsItWasWrittenIsPrinted) {
    const Ended ended = render();
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(fs::exists(document()));
    const Ended checked = gumcert({"check", record().string(), "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_NE(checked.out.find("nothing found"), std::string::npos) << checked.out;
}

TEST_F(RecordIntegrity, AnEditedOneIsRefused) {
    json changed = json::parse(bytes_of(record()));
    changed["certificate"]["tables"][0]["columns"][0]["values"][0]["printed_U"] = "10";
    write(changed);
    const Ended ended = render({"--draft"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_TRUE(has(ended, "GC-RECORD-0021")) << ended.err;
    EXPECT_FALSE(fs::exists(document()));
    EXPECT_EQ(gumcert({"check", record().string(), "--share", GUMCERT_SOURCE_DIR}).code, 1);
}

TEST_F(RecordIntegrity, OneWithoutDigestGivesADraftOnly) {
    json changed = json::parse(bytes_of(record()));
    changed.erase("digest");
    changed["certificate"]["tables"][0]["columns"][0]["values"][0]["printed_U"] = "10";
    write(changed);
    const Ended ended = render();
    EXPECT_EQ(ended.code, 1);
    EXPECT_TRUE(has(ended, "GC-RECORD-0026")) << ended.err;
    EXPECT_FALSE(fs::exists(document()));
    const Ended draft = render({"--draft"});
    EXPECT_EQ(draft.code, 0) << draft.err;
    EXPECT_TRUE(has(draft, "GC-RECORD-0026")) << draft.err;
    EXPECT_NE(bytes_of(document()).find("DRAFT"), std::string::npos);
}

TEST_F(RecordIntegrity, TheRecordHoldsTheFilesOfItsJob) {
    const json files = json::parse(bytes_of(record()))["job"]["files"];
    ASSERT_GE(files.size(), 2U);
    for (const json& file : files) {
        const std::string name = file["name"];
        if (file["encoding"] == "utf-8") {
            EXPECT_EQ(file["content"], bytes_of(shipped_example().parent_path() / "certificate" / name)) << name;
        } else {
            EXPECT_EQ(file["encoding"], "base64") << name;
        }
    }
}

class CheckCommand : public ProgramTest {};

TEST_F(CheckCommand, LooksAtJobsAndDigitalCertificates) {
    TemporaryFolder folder;
    const std::string job = (shipped_example() / "job.json").string();
    EXPECT_EQ(gumcert({"check", job}).code, 0);
    const fs::path record = folder.path() / "r.json";
    ASSERT_EQ(gumcert({"evaluate", (shipped_example().parent_path() / "certificate/end_gauge.json").string(), "-o",
                       record.string(), "--share", GUMCERT_SOURCE_DIR})
                  .code,
              0);
    const fs::path dcc = folder.path() / "c.xml";
    ASSERT_EQ(
        gumcert({"render", record.string(), "--format", "dcc", "-o", dcc.string(), "--share", GUMCERT_SOURCE_DIR}).code,
        0);
    const Ended good = gumcert({"check", "dcc", dcc.string()});
    EXPECT_EQ(good.code, 0) << good.err;
    std::string text = bytes_of(dcc);
    const std::size_t U = text.find("<si:valueExpandedMU>") + 20;
    ASSERT_NE(text.find("<si:valueExpandedMU>"), std::string::npos);
    text.replace(U, text.find('<', U) - U, "NaN");
    std::ofstream(dcc, std::ios::binary) << text;
    const Ended wrong = gumcert({"check", "dcc", dcc.string()});
    EXPECT_EQ(wrong.code, 1);
    EXPECT_NE(wrong.err.find("GC-DCC-0046"), std::string::npos) << wrong.err;
    EXPECT_EQ(gumcert({"check", "dcc"}).code, 2);
    EXPECT_EQ(gumcert({"check"}).code, 2);
    EXPECT_EQ(gumcert({"check", dcc.string()}).code, 3);
    EXPECT_EQ(gumcert({"check", (folder.path() / "none.json").string()}).code, 5);
}

}  // namespace
}  // namespace gumcert::cli
