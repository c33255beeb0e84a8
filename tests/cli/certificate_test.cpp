// Certificates as a user meets them: the gates before issue, four forms with the same numbers, signatures, and the way
// of a number from one certificate into the next budget.
#include <set>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

fs::path certificate_example() {
    return fs::path(GUMCERT_SOURCE_DIR) / "examples" / "certificate";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

class Certificate : public ProgramTest {
protected:
    void SetUp() override {
        for (const fs::directory_entry& entry : fs::directory_iterator(certificate_example())) {
            if (entry.is_regular_file()) {
                write_bytes(folder() / "job" / entry.path().filename(), bytes_of(entry.path()));
            }
        }
        if (!why_no_pdf().empty()) {
            GTEST_SKIP() << why_no_pdf();
        }
    }

    [[nodiscard]] fs::path job() const { return folder() / "job" / "end_gauge.json"; }
    [[nodiscard]] fs::path data() const { return folder() / "job" / "end_gauge_certificate.json"; }
    [[nodiscard]] fs::path output() const { return folder() / "out"; }

    Ended render(const std::string& format, const fs::path& file, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"render", (output() / "record.json").string(), "--format", format, "-o",
                                   file.string(), "--share", GUMCERT_SOURCE_DIR});
        return gumcert(more);
    }
    [[nodiscard]] std::string text_of_pdf(const fs::path& pdf) const {
        return run_process(on_search_path("pdftotext"), {"-layout", pdf.string(), "-"}, {}, folder()).out;
    }
    /// Key, certificate and signer description of a laboratory, made for this test.
    [[nodiscard]] fs::path signer() const {
        const fs::path key = folder() / "signer" / "key.pem";
        const fs::path certificate = folder() / "signer" / "certificate.pem";
        fs::create_directories(key.parent_path());
        const Ended made =
            run_process(on_search_path("openssl"),
                        {"req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days",
                         "30", "-subj", "/O=Example Calibration Laboratory/CN=Seal", "-addext",
                         "keyUsage=critical,digitalSignature", "-keyout", key.string(), "-out", certificate.string()},
                        {}, folder());
        EXPECT_EQ(made.code, 0) << made.err;
        const fs::path description = folder() / "signer" / "signer.json";
        write_bytes(description, R"({"certificates": "certificate.pem", "key": "key.pem"})");
        return description;
    }
};

TEST_F(Certificate, OfTheExampleIsIssuedInAllForms) {
    const Ended ended = run(job(), output());
    ASSERT_EQ(ended.code, 0) << ended.err;
    const std::string number = json::parse(bytes_of(data()))["number"];
    for (const char* name : {"certificate.html", "certificate.xml"}) {
        const std::string document = bytes_of(output() / name);
        EXPECT_NE(document.find(number), std::string::npos) << name;
        EXPECT_EQ(document.find("SPECIMEN"), std::string::npos) << name;
        EXPECT_EQ(document.find("DRAFT"), std::string::npos) << name;
    }
    const std::string pdf = text_of_pdf(output() / "certificate.pdf");
    EXPECT_NE(pdf.find(number), std::string::npos);
    EXPECT_EQ(pdf.find("SPECIMEN"), std::string::npos);
}

TEST_F(Certificate, CarriesTheDigitalCertificateInsideOfThePdf) {
    ASSERT_EQ(run(job(), output()).code, 0);
    const fs::path attached = folder() / "attached.xml";
    const Ended detached =
        run_process(on_search_path("pdfdetach"),
                    {"-save", "1", "-o", attached.string(), (output() / "certificate.pdf").string()}, {}, folder());
    ASSERT_EQ(detached.code, 0) << detached.err;
    EXPECT_EQ(bytes_of(attached), bytes_of(output() / "certificate.xml"));
}

TEST_F(Certificate, IsNotIssuedWithACriticalFinding) {
    change_json(data(), [](json& certificate) { certificate["customer"].erase("name"); });
    const Ended ended = run(job(), output(), {"--json-messages"});
    EXPECT_EQ(ended.code, 1);
    EXPECT_TRUE(fs::exists(output() / "record.json"));
    for (const char* name : {"certificate.html", "certificate.pdf", "certificate.xml"}) {
        EXPECT_FALSE(fs::exists(output() / name)) << name;
    }
    std::set<std::string> codes;
    bool customer = false;
    for (const Message& message : json_messages(ended)) {
        codes.insert(message.code);
        customer = customer || (message.code == "GC-CERT-0313" && message.rule.find("7.8.2.1 e") != std::string::npos);
    }
    EXPECT_TRUE(codes.contains("GC-CERT-0305")) << ended.err;
    EXPECT_TRUE(customer) << ended.err;

    // Nor by the other way: from the record.
    const Ended rendered = render("html", folder() / "issued.html");
    EXPECT_EQ(rendered.code, 1);
    EXPECT_FALSE(fs::exists(folder() / "issued.html"));
}

TEST_F(Certificate, IsNotIssuedBeforeItsDateAndItsRecordDoesNotKnowTheDay) {
    change_json(data(), [](json& certificate) {
        certificate["dates"]["issued"] = "2199-01-01";
        certificate["dates"]["authorised"] = "2199-01-01";
        certificate["dates"]["performed_to"] = "2199-01-01";
        certificate["dates"]["performed_from"] = "2199-01-01";
        certificate["dates"]["received"] = "2199-01-01";
        certificate["accreditation"]["valid_from"] = "2190-01-01";
        certificate["accreditation"]["valid_to"] = "2199-12-31";
        for (json& standard : certificate["standards"]) {
            standard["calibrated"] = "2198-01-01";
            standard["valid_to"] = "2199-12-31";
        }
        for (json& specification : certificate["specifications"]) {
            specification["agreed_on"] = "2198-12-01";
        }
    });
    const Ended ended = run(job(), output());
    EXPECT_EQ(ended.code, 1);
    EXPECT_NE(ended.err.find("finding P12, /dates/issued"), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(output() / "certificate.html"));
    const json record = json::parse(bytes_of(output() / "record.json"));
    EXPECT_FALSE(record["certificate"]["blocked"]);
    EXPECT_TRUE(record["certificate"]["findings"].empty());
    // From the record neither, but as a draft.
    EXPECT_EQ(render("html", folder() / "issued.html").code, 1);
    EXPECT_FALSE(fs::exists(folder() / "issued.html"));
    ASSERT_EQ(render("html", folder() / "draft.html", {"--draft"}).code, 0);
    EXPECT_NE(bytes_of(folder() / "draft.html").find("DRAFT"), std::string::npos);
}

TEST_F(Certificate, IsPrintedAsADraftWithItsFindings) {
    change_json(data(), [](json& certificate) { certificate["customer"].erase("name"); });
    const Ended ended = run(job(), output(), {"--draft"});
    EXPECT_EQ(ended.code, 1) << "a draft is not an issued certificate";
    for (const char* name : {"certificate.html", "certificate.xml"}) {
        const std::string document = bytes_of(output() / name);
        EXPECT_NE(document.find("DRAFT"), std::string::npos) << name;
    }
    EXPECT_NE(bytes_of(output() / "certificate.html").find("7.8.2.1\u00A0e"), std::string::npos);
    EXPECT_NE(text_of_pdf(output() / "certificate.pdf").find("DRAFT"), std::string::npos);
}

TEST_F(Certificate, WarnsOfDocumentsOfAnEarlierRun) {
    ASSERT_EQ(run(job(), output()).code, 0);
    change_json(data(), [](json& certificate) { certificate["customer"].erase("name"); });
    const Ended ended = run(job(), output());
    EXPECT_EQ(ended.code, 1);
    EXPECT_NE(ended.err.find("GC-CERT-0306"), std::string::npos) << ended.err;
}

TEST_F(Certificate, ShowsTheSameNumbersInEveryFormAndLanguage) {
    ASSERT_EQ(run(job(), output()).code, 0);
    const json record = json::parse(bytes_of(output() / "record.json"));
    std::vector<std::string> numbers;
    for (const json& table : record["certificate"]["tables"]) {
        for (const json& column : table["columns"]) {
            for (const json& value : column["values"]) {
                for (const char* key : {"value", "U"}) {
                    numbers.push_back(value[std::string("printed_") + key]);
                }
            }
        }
    }
    ASSERT_GE(numbers.size(), 2U);
    for (const char* language : {"en", "de", "zh-Hant", "es"}) {
        const bool comma = std::string(language) == "de" || std::string(language) == "es";
        for (const char* format : {"html", "text", "pdf", "dcc"}) {
            const fs::path file = folder() / (std::string(language) + "." + format);
            const Ended ended = render(format, file, {"--language", language});
            ASSERT_EQ(ended.code, 0) << format << " " << language << ": " << ended.err;
            const std::string document = std::string(format) == "pdf" ? text_of_pdf(file) : bytes_of(file);
            for (const std::string& number : numbers) {
                std::string expected = replaced(number, "-", "\u2212");
                if (std::string(format) == "dcc") {
                    expected = number;  // D-SI: always a point, always ASCII
                } else if (comma) {
                    expected = replaced(expected, ".", ",");
                }
                EXPECT_NE(document.find(expected), std::string::npos)
                    << expected << " in " << format << " " << language;
            }
        }
    }
}

TEST_F(Certificate, IsSignedAndVerified) {
    const fs::path description = signer();
    const Ended ended = run(job(), output(), {"--sign", description.string()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const std::string trust = (description.parent_path() / "certificate.pem").string();
    for (const char* name : {"certificate.xml", "certificate.pdf"}) {
        const Ended verified = gumcert({"verify", (output() / name).string(), "--trust", trust});
        EXPECT_EQ(verified.code, 0) << name << verified.out << verified.err;
        EXPECT_NE(verified.out.find("Example Calibration Laboratory"), std::string::npos) << verified.out;
    }

    // A file that cannot be read does not hide the others.
    const Ended two = gumcert(
        {"verify", (folder() / "nothing.pdf").string(), (output() / "certificate.pdf").string(), "--trust", trust});
    EXPECT_EQ(two.code, 5);
    EXPECT_NE(two.out.find("certificate.pdf: valid"), std::string::npos) << two.out;

    std::string changed = bytes_of(output() / "certificate.xml");
    const std::string element = "<si:value>";
    const std::size_t at = changed.find(element);
    ASSERT_NE(at, std::string::npos);
    char& digit = changed[at + element.size()];
    digit = digit == '9' ? '8' : '9';
    write_bytes(folder() / "changed.xml", changed);
    EXPECT_EQ(gumcert({"verify", (folder() / "changed.xml").string(), "--trust", trust}).code, 1);

    // A stranger's certificate does not help.
    const fs::path other = folder() / "other";
    fs::rename(folder() / "signer", other);
    (void)signer();
    EXPECT_EQ(gumcert({"verify", (output() / "certificate.pdf").string(), "--trust", trust}).code, 1);
}

TEST_F(Certificate, SpecimensAndDraftsAreNotSigned) {
    const fs::path description = signer();
    change_json(job(), [](json& all) { all.erase("certificate"); });
    const Ended ended = run(job(), output(), {"--sign", description.string()});
    EXPECT_EQ(ended.code, 3);
    EXPECT_NE(ended.err.find("GC-SIGN-0001"), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(output())) << "nothing is written with exit code 3";
}

TEST_F(Certificate, BecomesAnInputOfTheNextBudget) {
    ASSERT_EQ(run(job(), output()).code, 0);
    const fs::path next = folder() / "next.json";
    const Ended imported = gumcert({"import", "dcc", (output() / "certificate.xml").string(), "-o", next.string()});
    ASSERT_EQ(imported.code, 0) << imported.err;
    const json inputs = json::parse(bytes_of(next))["inputs"];
    ASSERT_EQ(inputs.size(), 1U);
    const json record = json::parse(bytes_of(output() / "record.json"));
    const json& certified = record["certificate"]["tables"][0]["columns"][0]["values"][0];
    EXPECT_EQ(inputs.begin().value()["U"].dump(), certified["printed_U"].get<std::string>());
    const json again = evaluate(next);
    EXPECT_EQ(again["results"].begin().value()["value"].get<double>(),
              std::stod(certified["printed_value"].get<std::string>()));
}

TEST_F(Certificate, SeveralJobsInOneRunHaveFoldersOfTheirOwn) {
    const fs::path second = folder() / "job" / "second.json";
    fs::copy_file(job(), second);
    const Ended ended =
        gumcert({"run", job().string(), second.string(), "-o", output().string(), "--share", GUMCERT_SOURCE_DIR});
    ASSERT_EQ(ended.code, 0) << ended.err;
    for (const char* name : {"end_gauge-out", "second-out"}) {
        for (const char* file : {"record.json", "certificate.html", "certificate.pdf", "certificate.xml"}) {
            EXPECT_TRUE(fs::exists(output() / name / file)) << name << "/" << file;
        }
    }
}

}  // namespace
}  // namespace gumcert::cli
