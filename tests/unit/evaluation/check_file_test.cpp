#include "evaluation/check_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "reports/record/evaluation_record.h"

namespace gumcert::evaluation {
namespace {

namespace fs = std::filesystem;

const fs::path k_examples = fs::path(GUMCERT_SOURCE_DIR) / "examples";
const fs::path k_templates = fs::path(GUMCERT_SOURCE_DIR) / "templates";

class CheckFile : public testing::Test {
protected:
    CheckFile() {
        std::string name = (fs::path(testing::TempDir()) / "check-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~CheckFile() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path put(const std::string& text) const {
        std::ofstream(folder_ / "file.json", std::ios::binary) << text;
        return folder_ / "file.json";
    }
    static std::vector<std::string> errors(const FileCheck& check) {
        std::vector<std::string> codes;
        for (const gum::Diagnostic& finding : check.findings) {
            if (finding.severity == gum::Severity::error) {
                codes.push_back(finding.code);
            }
        }
        return codes;
    }

private:
    fs::path folder_;
};

using Codes = std::vector<std::string>;

TEST_F(CheckFile, JobsOfEveryKindAreReadWithTheirFiles) {
    for (const auto& [job, kind] :
         {std::pair("end_gauge/job.json", "job of kind budget"), std::pair("multimeter/job.json", "job of kind budget"),
          std::pair("rotary_table/job.json", "job of kind rotary_table"),
          std::pair("comparison/key_comparison.json", "job of kind comparison")}) {
        const FileCheck check = check_file(k_examples / job, 1, k_templates);
        EXPECT_EQ(check.kind, kind);
        EXPECT_EQ(errors(check), Codes()) << job;
    }
}

TEST_F(CheckFile, WhatTheReaderRefusesIsToldAllTogether) {
    const FileCheck check = check_file(put(R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["y = a"],
                           "inputs": {"a": {"value": 1, "u": -1}}, "more": 1})"),
                                       1, k_templates);
    EXPECT_EQ(check.kind, "job of kind budget");
    EXPECT_GE(errors(check).size(), 2U);
}

TEST_F(CheckFile, RecordsAreEvaluatedAgain) {
    const std::string text = reports::to_canonical_json(
        evaluate_job(k_examples / "end_gauge/job.json", CovarianceFile::none, 1, k_templates).record);
    EXPECT_EQ(check_file(put(text), 1, k_templates).kind, "record of kind budget");
    EXPECT_EQ(errors(check_file(put(text), 1, k_templates)), Codes());
    nlohmann::json changed = nlohmann::json::parse(text);
    changed["title"] = "Another";
    EXPECT_EQ(errors(check_file(put(changed.dump()), 1, k_templates)), Codes{"GC-RECORD-0021"});
    EXPECT_EQ(errors(check_file(put(reports::with_digest(changed)), 1, k_templates)), Codes{"GC-RECORD-0022"});
    changed["software"]["version"] = "9.9";
    EXPECT_EQ(errors(check_file(put(reports::with_digest(changed)), 1, k_templates)), Codes{"GC-RECORD-0025"});
    changed.erase("kind");
    EXPECT_EQ(errors(check_file(put(changed.dump()), 1, k_templates)), Codes{"GC-RECORD-0013"});
}

TEST_F(CheckFile, OtherFilesAreRefused) {
    for (const char* text : {"", "<a/>", "%PDF-1.7", "a,b\n"}) {
        try {
            (void)check_file(put(text), 1, k_templates);
            ADD_FAILURE() << text;
        } catch (const gum::InputError& refused) {
            EXPECT_EQ(refused.diagnostics().front().code, "GC-CHECK-0001");
        }
    }
    EXPECT_THROW((void)check_file("missing.json", 1, k_templates), gum::StorageError);
}

}  // namespace
}  // namespace gumcert::evaluation
