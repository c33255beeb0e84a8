// The folder of a laboratory: jobs that refer to it, records that are evaluated without it, certificates that contradict it.
#include <algorithm>
#include <fstream>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

class LaboratoryFolderOfJobs : public ProgramTest {
protected:
    LaboratoryFolderOfJobs() {
        fs::copy(shipped_example().parent_path() / "laboratory", folder(), fs::copy_options::recursive);
    }
    [[nodiscard]] fs::path folder() const { return folder_.path() / "work"; }
    [[nodiscard]] fs::path job() const { return folder() / "end_gauge.json"; }
    [[nodiscard]] fs::path record() const { return folder_.path() / "record.json"; }
    [[nodiscard]] Ended evaluate(std::vector<std::string> more = {}) const {
        std::vector<std::string> words{"evaluate", job().string(),     "-o", record().string(),
                                       "--share",  GUMCERT_SOURCE_DIR, "-q"};
        words.insert(words.end(), more.begin(), more.end());
        return gumcert(words);
    }
    void change(const fs::path& file, const char* pointer, const json& value) const {
        json document = json::parse(bytes_of(file));
        document[json::json_pointer(pointer)] = value;
        std::ofstream(file, std::ios::binary) << document.dump();
    }
    [[nodiscard]] std::vector<std::string> findings() const {
        std::vector<std::string> ids;
        const json made = json::parse(bytes_of(record()));
        for (const json& finding : made["certificate"]["findings"]) {
            if (finding["severity"] == "critical") {
                ids.push_back(finding["id"]);
            }
        }
        return ids;
    }

    TemporaryFolder folder_;
};

TEST_F(LaboratoryFolderOfJobs, TheExampleIsACertificate) {
    const Ended ended = evaluate();
    EXPECT_EQ(ended.code, 0) << ended.err;
    const json made = json::parse(bytes_of(record()));
    EXPECT_EQ(made["certificate"]["data"]["laboratory"]["name"], "Example Calibration Laboratory");
    EXPECT_EQ(made["certificate"]["data"]["standards"][0]["certificate"], "NMI-2026-0117");
    EXPECT_TRUE(findings().empty());
}

TEST_F(LaboratoryFolderOfJobs, ARecordIsEvaluatedAgainWithoutTheFolder) {
    ASSERT_EQ(evaluate().code, 0);
    fs::remove_all(folder());
    const Ended checked = gumcert({"check", record().string(), "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST_F(LaboratoryFolderOfJobs, TheOptionGoesBeforeTheJob) {
    change(job(), "/laboratory", "nowhere");
    EXPECT_EQ(evaluate().code, 5);
    const Ended ended = evaluate({"--laboratory", (folder() / "laboratory").string()});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(bytes_of(record()).find("laboratory:/standards/STD-017.json"), std::string::npos);
    fs::remove_all(folder());
    const Ended checked = gumcert({"check", record().string(), "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST_F(LaboratoryFolderOfJobs, ACertificateIsHeldAgainstTheRegister) {
    const fs::path data = folder() / "end_gauge_certificate.json";
    change(data, "/standards/0", {{"name", "End gauge"}, {"identification", "STD-017"}, {"valid_to", "2030-01-01"}});
    EXPECT_EQ(evaluate().code, 1);
    EXPECT_EQ(findings(), std::vector<std::string>{"T10"});
    change(data, "/standards/0", "STD-017");
    change(data, "/persons/authorised_by", "R1");  // reviews, and does not authorise
    EXPECT_EQ(evaluate().code, 1);
    const std::vector<std::string> found = findings();
    EXPECT_NE(std::find(found.begin(), found.end(), "P03"), found.end());
    EXPECT_EQ(std::find(found.begin(), found.end(), "P14"), found.end()) << "it is told of the signatories already";
}

TEST_F(LaboratoryFolderOfJobs, AnExpiredStandardBlocks) {
    change(folder() / "laboratory/standards/STD-017.json", "/calibrations/3/valid_to", "2026-10-01");
    EXPECT_EQ(evaluate().code, 1);
    const std::vector<std::string> found = findings();
    EXPECT_NE(std::find(found.begin(), found.end(), "T01"), found.end());
    EXPECT_EQ(std::find(found.begin(), found.end(), "T11"), found.end()) << "the dates of its row tell it";
}

TEST_F(LaboratoryFolderOfJobs, FilesOfTheRegisterAreChecked) {
    const fs::path standard = folder() / "laboratory/standards/STD-017.json";
    const std::string laboratory = (folder() / "laboratory/laboratory.json").string();
    EXPECT_EQ(gumcert({"check", standard.string(), laboratory, "--share", GUMCERT_SOURCE_DIR}).code, 0);
    change(standard, "/drift", {{"model", "none"}});
    const Ended ended = gumcert({"check", standard.string(), "--share", GUMCERT_SOURCE_DIR});
    EXPECT_EQ(ended.code, 1);
    EXPECT_NE(ended.err.find("GC-LAB-0104"), std::string::npos) << ended.err;
}

TEST_F(LaboratoryFolderOfJobs, ADigitalCertificateBecomesAStandard) {
    const fs::path certificate = folder() / "certificate.xml";
    ASSERT_EQ(evaluate().code, 0);
    ASSERT_EQ(gumcert({"render", record().string(), "--format", "dcc", "-o", certificate.string(), "--share",
                       GUMCERT_SOURCE_DIR})
                  .code,
              0);
    const std::vector<std::string> words{
        "import", "dcc", certificate.string(), "--standard", "EG", "-o", (folder() / "laboratory/standards").string()};
    EXPECT_EQ(gumcert(words).code, 0);
    const json standard = json::parse(bytes_of(folder() / "laboratory/standards/EG.json"));
    EXPECT_EQ(standard["calibrations"][0]["certificate"], "EX-2026-0042");
    EXPECT_EQ(gumcert(words).code, 2);  // its history would be lost
}

TEST_F(LaboratoryFolderOfJobs, IsLookedThroughForWhatRunsOut) {
    const std::string laboratory = (folder() / "laboratory").string();
    const Ended text = gumcert({"laboratory", laboratory, "--date", "2026-11-21"});
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_TRUE(has(text.out, laboratory + " on 2026-11-21\n"));
    EXPECT_TRUE(has(text.out, "NMI-2026-0117"));
    EXPECT_TRUE(has(text.out, "control chart"));
    EXPECT_TRUE(has(text.out, "the register states no plan of recalibration"));
    EXPECT_TRUE(has(gumcert({"laboratory", laboratory}).out, " (today by UTC)\n"));

    const Ended late = gumcert({"laboratory", laboratory, "--date", "2029-01-01", "--format", "json"});
    EXPECT_EQ(late.code, 1);
    const json all = json::parse(late.out);
    EXPECT_EQ(all["day"], "2029-01-01");
    EXPECT_EQ(all["overdue"], true);
    EXPECT_EQ(all["standards"][1]["id"], "STD-017");
    EXPECT_EQ(all["standards"][1]["state"], "overdue");
    EXPECT_EQ(all["standards"][0]["next_calibration"], nullptr);
    EXPECT_EQ(all["signatories"][0]["state"], "overdue") << "to 2028-12-31";
    EXPECT_EQ(all["signatories"][1]["state"], "valid");
    EXPECT_EQ(all["accreditation"][0]["state"], "valid");

    const Ended csv = gumcert({"laboratory", laboratory, "--date", "2022-01-01", "--format", "csv"});
    EXPECT_EQ(csv.code, 0);
    EXPECT_TRUE(csv.out.starts_with("part,id,description,from,certificate,to,next_calibration,"));
    EXPECT_TRUE(has(csv.out, "signatories,OP3,Operator 3,2023-06-01,,,,,2022-01-01,not_yet,from 2023-06-01 on"));

    EXPECT_EQ(gumcert({"laboratory", laboratory, "--date", "21.11.2026"}).code, 2);
    const Ended none = gumcert({"laboratory", (folder() / "laboratory" / "standards").string()});
    EXPECT_EQ(none.code, 3);
    EXPECT_TRUE(has(none.err, "GC-LAB-0200"));
    change(folder() / "laboratory/standards/STD-017.json", "/calibrations/0/calibrated", "2025-13-01");
    const Ended wrong = gumcert({"laboratory", laboratory, "--date", "2026-11-21"});
    EXPECT_EQ(wrong.code, 3);
    EXPECT_TRUE(has(wrong.err, "standards/STD-017.json"));
}

}  // namespace
}  // namespace gumcert::cli
