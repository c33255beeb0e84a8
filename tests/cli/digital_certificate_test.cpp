// Digital certificates as a user meets them: numbers come back from a certificate of this program and from those that
// the PTB publishes, and a hostile one is refused before anything is written.
#include <set>

#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

fs::path examples() {
    return fs::path(GUMCERT_SOURCE_DIR) / "examples";
}

class DigitalCertificate : public ProgramTest {
protected:
    /// Record and digital certificate of a job of the examples, without the other documents.
    void make(const fs::path& job, const std::vector<std::string>& languages = {}) const {
        const Ended evaluated = evaluate_into_record(examples() / job);
        ASSERT_EQ(evaluated.code, 0) << evaluated.err;
        std::vector<std::string> arguments = {"render", record().string(),      "--format", "dcc",
                                              "-o",     certificate().string(), "--share",  GUMCERT_SOURCE_DIR};
        if (!languages.empty()) {
            arguments.emplace_back("--language");
            arguments.insert(arguments.end(), languages.begin(), languages.end());
        }
        const Ended rendered = gumcert(arguments);
        ASSERT_EQ(rendered.code, 0) << rendered.err;
    }
    [[nodiscard]] Ended evaluate_into_record(const fs::path& from) const {
        return gumcert({"evaluate", from.string(), "-o", record().string(), "--share", GUMCERT_SOURCE_DIR});
    }
    [[nodiscard]] Ended import_certificate(const fs::path& file) const {
        return gumcert({"import", "dcc", file.string(), "-o", job().string(), "--json-messages"});
    }
    [[nodiscard]] fs::path record() const { return folder() / "record.json"; }
    [[nodiscard]] fs::path certificate() const { return folder() / "certificate.xml"; }
    [[nodiscard]] fs::path job() const { return folder() / "imported.json"; }
};

/// Whether a line of the job states an input with these digits, as texts: 2.00 is not 2.
bool states(const std::string& job, const std::string& input, const std::string& value, const std::string& U,
            const std::string& k) {
    const std::string begin = '"' + input + "\": {";
    const std::size_t at = job.find("  " + begin);
    const std::string line = at == std::string::npos ? "" : job.substr(at, job.find('\n', at) - at);
    return line.find("\"value\": " + value + ", \"U\": " + U + ", \"k\": " + k + ",") != std::string::npos;
}

TEST_F(DigitalCertificate, OfARotaryTableComesBackWithEveryDigit) {
    make(fs::path("certificate") / "rotary_table.json", {"de,en"});
    const Ended imported = import_certificate(certificate());
    ASSERT_EQ(imported.code, 0) << imported.err;
    const std::string text = bytes_of(job());
    std::size_t expected = 0;
    std::size_t angles = 0;
    const json tables = json::parse(bytes_of(record()))["certificate"]["tables"];
    for (const json& table : tables) {
        for (const json& column : table["columns"]) {
            const json& values = column["values"];
            for (std::size_t row = 0; row < values.size(); ++row) {
                if (values[row]["printed_U"] == "") {
                    continue;
                }
                ++expected;
                const std::string name =
                    column["result"].get<std::string>() + (values.size() > 1 ? "_" + std::to_string(row + 1) : "");
                EXPECT_TRUE(states(text, name, with_ascii_minus(values[row]["printed_value"]), values[row]["printed_U"],
                                   values[row]["printed_k"]))
                    << name;
            }
            angles = std::max(angles, values.size());
        }
    }
    EXPECT_EQ(angles, 36U);
    const json inputs = json::parse(text)["inputs"];
    EXPECT_EQ(inputs.size(), expected);
    EXPECT_GT(expected, 200U);
    // A row says at which angle it was measured.
    EXPECT_NE(inputs["EXA_3"]["description"].get<std::string>().find("(Winkel 20 deg)"), std::string::npos);
    // The job can be evaluated as it is.
    EXPECT_EQ(evaluate_into_record(job()).code, 0);
}

/// The number and the digest of a certificate stand in the certificate of whoever uses it.
TEST_F(DigitalCertificate, NamesTheCertificateThatItsInputsComeFrom) {
    make(fs::path("certificate") / "end_gauge.json");
    ASSERT_EQ(import_certificate(certificate()).code, 0);
    const std::string source = json::parse(bytes_of(job()))["inputs"]["l"]["source"];
    const std::string sha256 =
        run_process(on_search_path("sha256sum"), {certificate().string()}, {}, folder()).out.substr(0, 64);
    EXPECT_EQ(source, "certificate EX-2026-0042, Example Calibration Laboratory, SHA-256 " + sha256);
    const Ended evaluated = evaluate_into_record(job());
    ASSERT_EQ(evaluated.code, 0) << evaluated.err;
    const Ended rendered = gumcert(
        {"render", record().string(), "--format", "dcc", "-o", certificate().string(), "--share", GUMCERT_SOURCE_DIR});
    ASSERT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_NE(bytes_of(certificate()).find("<inputSource input=\"l\">" + source + "</inputSource>"), std::string::npos);
}

TEST_F(DigitalCertificate, WithADoctypeIsRefusedAndNothingIsWritten) {
    make(fs::path("end_gauge") / "job.json");
    std::string document = bytes_of(certificate());
    const std::size_t end = document.find("?>") + 2;
    write_bytes(certificate(), document.insert(end, "<!DOCTYPE a [<!ENTITY x SYSTEM \"file:///etc/hostname\">]>"));
    const auto before = contents_of(folder());
    const Ended imported = import_certificate(certificate());
    EXPECT_EQ(imported.code, 3);
    const std::vector<Message> messages = json_messages(imported);
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].code, "GC-DCC-0002");
    EXPECT_EQ(contents_of(folder()), before);
    EXPECT_EQ(imported.out, "");
}

/// What a published example states with its uncertainty, in the order of the document.
struct PublishedExample {
    std::string file, unit;
    std::vector<std::pair<std::string, std::string>> values_and_U;
    std::string first_row;  ///< where the first of them was measured
};

TEST_F(DigitalCertificate, OfOthersBecomesABudget) {
    const fs::path published = fs::path(GUMCERT_SOURCE_DIR) / ".." / "shared" / "dcc" / "examples";
    if (!fs::exists(published)) {
        GTEST_SKIP() << "the folder of published certificates is not there";
    }
    // Read off the files by eye: measurement errors of a temperature probe and of a hygrometer.
    const std::vector<std::pair<std::string, std::string>> probe = {
        {"0.072", "0.061"}, {"0.089", "0.061"}, {"0.107", "0.061"}, {"-0.009", "0.061"}, {"-0.084", "0.061"}};
    const std::vector<std::pair<std::string, std::string>> hygrometer = {
        {"-0.004", "0.006"}, {"-0.001", "0.008"}, {"0.003", "0.010"}, {"0.011", "0.011"},
        {"0.012", "0.010"},  {"0.006", "0.008"},  {"-0.003", "0.006"}};
    for (const PublishedExample& example : std::vector<PublishedExample>{
             {"dcc_gp_humidity_v1.0.xml", "1", hygrometer, "Referenzwert relative Feuchte 0.201"},
             {"dcc_gp_temperature_typical_v12.xml", "K", probe, "Bezugswert 306.248 K"},
             {"dcc_gp_temperature_typical_v12_v3.2.0_signed.xml", "K", probe, "Bezugswert 306.248 K"},
             {"dcclib_valid_3.3.0.xml", "K", probe, "Bezugswert 306.248 K"},
             {"dcclib_valid_signature_3.3.0.xml", "K", probe, "Bezugswert 306.248 K"}}) {
        const Ended imported = import_certificate(published / example.file);
        ASSERT_EQ(imported.code, 0) << example.file << " " << imported.err;
        const std::string text = bytes_of(job());
        const json inputs = json::parse(text)["inputs"];
        EXPECT_EQ(inputs.size(), example.values_and_U.size()) << example.file;
        for (std::size_t row = 0; row < example.values_and_U.size(); ++row) {
            const std::string name = "measurement_error_" + std::to_string(row + 1);
            const auto& [value, U] = example.values_and_U[row];
            EXPECT_TRUE(states(text, name, value, U, "2")) << example.file << " " << name;
            EXPECT_EQ(inputs[name].value("unit", ""), example.unit) << example.file;
        }
        EXPECT_NE(inputs["measurement_error_1"].value("description", "").find(example.first_row), std::string::npos)
            << example.file;
        const Ended evaluated = evaluate_into_record(job());
        EXPECT_EQ(evaluated.code, 0) << example.file << " " << evaluated.err;
    }
}

}  // namespace
}  // namespace gumcert::cli
