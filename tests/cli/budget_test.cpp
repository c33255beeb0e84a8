// Budget jobs as a user meets them: the shipped examples, what is refused, and numbers that other programs get wrong.
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

fs::path example(const std::string& name) {
    return fs::path(GUMCERT_SOURCE_DIR) / "examples" / name / "job.json";
}

/// A number with as many decimals as the text has.
std::string printed_like(double value, const std::string& text) {
    const std::size_t point = text.find('.');
    const int decimals = point == std::string::npos ? 0 : static_cast<int>(text.size() - point) - 1;
    std::array<char, 64> digits{};
    return {digits.data(),
            std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals).ptr};
}

double half_width(const json& interval) {
    return 0.5 * (interval[1].get<double>() - interval[0].get<double>());
}

/// The numerical standard uncertainty that a Monte Carlo result states of half the width of its interval; the errors of
/// the two ends added up, which is never too small.
double half_width_error(const json& monte_carlo, const char* interval) {
    const json& ends = monte_carlo["numerical_error"][interval];
    return 0.5 * (ends[0].get<double>() + ends[1].get<double>());
}

class Budget : public ProgramTest {
protected:
    [[nodiscard]] fs::path job_file() const { return folder() / "job.json"; }

    /// The text of a job.
    /// \param model   "\"y = a\", …"
    /// \param inputs  "\"a\": {…}, …"
    /// \param more  ", \"key\": …"
    static std::string budget(const std::string& model, const std::string& inputs, const std::string& more = "") {
        return "{\"schema\": \"gumcert/job/1\", \"kind\": \"budget\",\n\"model\": [" + model + "],\n\"inputs\": {" +
               inputs + "}" + more + "}\n";
    }

    /// Evaluates a job.
    /// \return the record
    json record_of(const std::string& job, int code = 0) const {
        write_bytes(job_file(), job);
        const fs::path file = folder() / "record.json";
        const Ended ended = gumcert({"evaluate", job_file().string(), "-o", file.string(), "--json-messages"});
        EXPECT_EQ(ended.code, code) << ended.err;
        return fs::exists(file) ? json::parse(bytes_of(file)) : json();
    }
    /// The result y of a job.
    json y_of(const std::string& job, int code = 0) const { return record_of(job, code)["results"]["y"]; }

    static bool tells(const json& record, const std::string& code) {
        for (const json& diagnostic : record["diagnostics"]) {
            if (diagnostic["code"] == code) {
                return true;
            }
        }
        return false;
    }

    /// A job with one thing wrong is refused with one message, and nothing is written.
    /// \param fragments  each must occur in what is wrong, the rule or the advice
    void expect_refused(int exit_code, const std::string& code, const std::string& where,
                        const std::vector<std::string>& fragments, const std::string& job) const {
        SCOPED_TRACE(job.substr(0, 300));
        write_bytes(job_file(), job);
        const auto before = contents_of(folder());
        for (const char* const command : {"evaluate", "run"}) {
            std::vector<std::string> arguments{command, job_file().string(), "-o", (folder() / "out").string(),
                                               "--json-messages"};
            const Ended ended = gumcert(arguments);
            EXPECT_EQ(ended.code, exit_code) << ended.err;
            EXPECT_EQ(ended.out, "");
            EXPECT_EQ(contents_of(folder()), before) << "nothing is written";
            const std::vector<Message> messages = json_messages(ended);
            EXPECT_EQ(messages.size(), 1U) << ended.err;
            ASSERT_FALSE(messages.empty());
            const Message& message = messages.front();
            EXPECT_EQ(message.severity, "error");
            EXPECT_EQ(message.code, code) << ended.err;
            EXPECT_TRUE(message.where.starts_with(where)) << message.where;
            EXPECT_FALSE(message.rule.empty());
            for (const std::string& fragment : fragments) {
                EXPECT_NE((message.what + "\n" + message.rule + "\n" + message.action).find(fragment),
                          std::string::npos)
                    << fragment << " is not told: " << ended.err;
            }
        }
    }
};

// The shipped examples and the numbers that their READMEs state.

class BudgetExamples : public Budget {
protected:
    /// Runs and evaluates an example: exit code 0, the documents are there, and both give one record.
    json record_of_example(const std::string& name) {
        name_ = name;
        const fs::path evaluated = folder() / "evaluated.json";
        const Ended ended = gumcert({"evaluate", example(name).string(), "-o", evaluated.string()});
        EXPECT_EQ(ended.code, 0) << ended.err;
        const std::string bytes = bytes_of(evaluated);
        if (why_no_pdf().empty()) {
            const Ended whole = run(example(name), folder() / "out");
            EXPECT_EQ(whole.code, 0) << whole.err;
            const auto files = contents_of(folder() / "out");
            EXPECT_EQ(files.size(), 6U) << "with the manifest";
            EXPECT_TRUE(files.contains("audit.html"));
            EXPECT_TRUE(files.contains("certificate.xml"));
            EXPECT_TRUE(files.contains("certificate.html"));
            EXPECT_TRUE(files.contains("certificate.pdf"));
            EXPECT_TRUE(files.at("record.json") == bytes) << "run and evaluate differ";
            summary_ = whole.out;
        }
        return json::parse(bytes);
    }

    /// The number, rounded like the text, is the text, and the README says so.
    void expect_stated(const json& number, const std::string& text) const {
        EXPECT_EQ(printed_like(number.get<double>(), text), text) << name_;
        std::string readme = bytes_of(example(name_).parent_path() / "README.md");
        std::erase(readme, ' ');  // 0.002 18
        EXPECT_NE(readme.find(text), std::string::npos) << "README of " << name_ << " does not state " << text;
    }

    std::string name_;
    std::string summary_;  ///< of `gumcert run`
};

TEST_F(BudgetExamples, EndGauge) {
    const json record = record_of_example("end_gauge");
    const json& l = record["results"]["l"];
    EXPECT_EQ(l["value"], 50000838.0);
    expect_stated(l["u"], "31.7");
    expect_stated(l["nu_eff"], "16.8");
    expect_stated(l["k"], "2.78");  // t of 99 % for 16.75 degrees of freedom is 2.90
    expect_stated(l["U"], "88");
    EXPECT_EQ(l["printed"], (json{{"value", "50000838"}, {"U", "88"}, {"unit", "nm"}}));
    expect_stated(l["second_order"]["u"], "34");
    EXPECT_TRUE(tells(record, "GC-BUDGET-0025")) << "second-order terms change u by 7 %: the result says so";
    EXPECT_EQ(l["reported"]["method"], "monte_carlo");
    EXPECT_EQ(l["reported"]["because"], "second_order");
    // JCGM 100:2008, table H.1; the row of d as its three components.
    const json& budget = l["budget"];
    ASSERT_EQ(budget.size(), 6U);
    EXPECT_EQ(printed_like(budget[0]["contribution"].get<double>(), "25"), "25");
    EXPECT_EQ(printed_like(budget[1]["contribution"].get<double>(), "9.7"), "9.7");
    EXPECT_EQ(budget[1]["components"].size(), 3U);
    EXPECT_EQ(printed_like(budget[1]["nu"].get<double>(), "25.6"), "25.4");  // the GUM: 25.6 from u = 9.7
    EXPECT_EQ(printed_like(budget[4]["contribution"].get<double>(), "2.9"), "2.9");
    EXPECT_EQ(printed_like(budget[5]["contribution"].get<double>(), "16.6"), "16.6");
}

TEST_F(BudgetExamples, GaugeBlock) {
    const json record = record_of_example("gauge_block");
    const json& dL = record["results"]["dL"];
    const json& monte_carlo = dL["monte_carlo"];
    EXPECT_EQ(monte_carlo["trials"], 1000000);
    expect_stated(dL["value"], "838");
    expect_stated(monte_carlo["mean"], "838");
    expect_stated(dL["u"], "32");
    expect_stated(monte_carlo["u"], "36");
    // 745 nm and 932 nm are rounded and were found with other random numbers.
    const std::array<double, 2> stated{745.0, 932.0};
    for (std::size_t end = 0; end < stated.size(); ++end) {
        EXPECT_NEAR(monte_carlo["shortest"][end].get<double>(), stated[end],
                    0.5 + 4.0 * monte_carlo["numerical_error"]["shortest"][end].get<double>());
    }
    EXPECT_TRUE(monte_carlo["validation"].is_null());
}

TEST_F(BudgetExamples, GaugeBlockIsNotValidatedAndSaysSo) {
    std::string text = bytes_of(example("gauge_block"));
    const std::string from = "\"trials\": 1000000,";
    ASSERT_NE(text.find(from), std::string::npos);
    write_bytes(job_file(), text.replace(text.find(from), from.size(), from + " \"validate\": true,"));
    const Ended evaluated = gumcert({"evaluate", job_file().string(), "-o", (folder() / "record.json").string()});
    EXPECT_EQ(evaluated.code, 1) << evaluated.err;
    const json record = json::parse(bytes_of(folder() / "record.json"));
    const json& validation = record["results"]["dL"]["monte_carlo"]["validation"];
    EXPECT_EQ(validation["validated"], false);
    EXPECT_GT(validation["d_low"].get<double>(), validation["delta"].get<double>());
    if (!why_no_pdf().empty()) {
        GTEST_SKIP() << why_no_pdf() << ": gumcert run was not tested";
    }
    const Ended ended = run(job_file(), folder() / "out");
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_EQ(contents_of(folder() / "out").size(), 6U) << "the documents are written all the same, and the manifest";
    EXPECT_NE(ended.out.find("NOT validated"), std::string::npos) << ended.out;
    EXPECT_NE(bytes_of(folder() / "out" / "certificate.html").find("not validated"), std::string::npos);
}

TEST_F(BudgetExamples, Multimeter) {
    const json record = record_of_example("multimeter");
    const json& results = record["results"];
    ASSERT_EQ(results.size(), 4U);
    const std::array<double, 4> volts{10.0, 20.0, 50.0, 100.0};
    const std::array<double, 4> error_mV{1.0, 2.0, 4.0, 9.0};
    std::array<double, 4> u_calibrator{};
    std::array<double, 4> u{};
    for (std::size_t i = 0; i < volts.size(); ++i) {
        // 0.005 % of reading + 0.001 % of 100 V + 0.02 mV, evaluated anew at every point; and the display's 1 mV.
        u_calibrator[i] = (0.005e-2 * volts[i] * 1e3 + 0.001e-2 * 100e3 + 0.02) / std::sqrt(3.0);
        u[i] = std::hypot(u_calibrator[i], 1.0 / std::sqrt(12.0));
        const json& result = results["E[" + printed_like(volts[i], "0") + " V]"];
        EXPECT_NEAR(result["value"].get<double>(), error_mV[i], 1e-9);
        EXPECT_NEAR(result["u"].get<double>(), u[i], 1e-12 * u[i]);
        EXPECT_EQ(result["unit"], "mV");
    }
    // One calibrator: the covariance stands in the record.
    const json& covariance = record["covariance"];
    ASSERT_EQ(covariance["names"], (json{"E[10 V]", "E[20 V]", "E[50 V]", "E[100 V]"}));
    for (std::size_t i = 0; i < volts.size(); ++i) {
        EXPECT_NEAR(covariance["matrix"][i][i].get<double>(), u[i] * u[i], 1e-12);
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_GE(covariance["matrix"][i][j].get<double>(), u_calibrator[i] * u_calibrator[j] * (1.0 - 1e-12));
            EXPECT_LT(covariance["correlation"][i][j].get<double>(), 1.0);
        }
    }
}

TEST_F(BudgetExamples, ResistanceAndReactance) {
    const json record = record_of_example("resistance_and_reactance");
    const json& results = record["results"];
    expect_stated(results["R"]["value"], "127.732");
    expect_stated(results["X"]["value"], "219.847");
    expect_stated(results["Z"]["value"], "254.260");
    expect_stated(results["R"]["u"], "0.071");
    expect_stated(results["Z"]["u"], "0.236");
    // The GUM prints 0.295, the value of its second approach (0.29549); the law of propagation gives 0.29558.
    EXPECT_NEAR(results["X"]["u"].get<double>(), 0.29558, 0.000005);
    const json& correlation = record["covariance"]["correlation"];
    expect_stated(correlation[0][1], "-0.588");
    expect_stated(correlation[0][2], "-0.485");
    expect_stated(correlation[1][2], "0.993");
    for (const char* const name : {"R", "X", "Z"}) {
        EXPECT_NEAR(results[name]["nu_eff"].get<double>(), 4.0, 1e-9);
        EXPECT_EQ(printed_like(results[name]["k"].get<double>(), "2.78"), "2.78");
        EXPECT_FALSE(results[name]["correlation"].is_null()) << "the row for what the correlations take away";
    }
    EXPECT_TRUE(record["region"]["ellipsoid"]["k_p"].is_null()) << "Z follows from R and X: no ellipsoid";
}

TEST_F(BudgetExamples, Thermometer) {
    const json record = record_of_example("thermometer");
    ASSERT_EQ(record["fits"].size(), 1U);
    const json& fit = record["fits"][0];
    expect_stated(fit["parameters"][0]["value"], "-0.1712");
    expect_stated(fit["parameters"][0]["u"], "0.0029");
    expect_stated(fit["parameters"][1]["value"], "0.00218");
    expect_stated(fit["parameters"][1]["u"], "0.00067");
    expect_stated(fit["correlation"][0][1], "-0.930");
    expect_stated(fit["residual_standard_deviation"], "0.0035");
    const json& b_30 = record["results"]["b_30"];
    expect_stated(b_30["value"], "-0.1494");
    expect_stated(b_30["u"], "0.0041");
    expect_stated(b_30["nu_eff"], "9");
}

/// Monte Carlo, adaptive and not, points, several outputs with regions: no byte depends on the threads or the run.
TEST_F(Budget, ThreadsAndRunsChangeNoByte) {
    std::string reactance = bytes_of(example("resistance_and_reactance"));
    const std::string from = "\"simultaneous\"";
    ASSERT_NE(reactance.find(from), std::string::npos);
    reactance.replace(reactance.find(from), from.size(), "\"monte_carlo\": {\"trials\": 200001}, " + from);
    const std::map<std::string, std::string> jobs{
        {"gauge block", bytes_of(example("gauge_block"))},
        {"reactance", reactance},
        {"adaptive", budget("\"y = a*b\", \"z = a/b\"", R"("a": {"value": 3, "u": 0.1, "nu": 7},
            "b": {"value": 2, "half_width": 0.3})",
                            R"(, "monte_carlo": {"adaptive": {"digits": 1}, "validate": false})")},
        {"points", budget("\"y = a*b\"", R"("a": {"value": 3, "u": 0.1}, "b": {"value": 2, "relative_u": 0.01})",
                          R"(, "points": [{"b": 1}, {"b": 2}, {"b": 5}], "monte_carlo": {"trials": 300000})")}};
    for (const auto& [name, text] : jobs) {
        write_bytes(job_file(), text);
        std::string first;
        for (const std::string threads : {"1", "2", "3", "2"}) {
            const Ended ended = gumcert({"evaluate", job_file().string(), "-o", "-", "--threads", threads});
            ASSERT_EQ(ended.code, 0) << name << ": " << ended.err;
            first = first.empty() ? ended.out : first;
            EXPECT_TRUE(ended.out == first) << name << " with --threads " << threads;
        }
    }
}

TEST_F(Budget, ValidationThatHoldsEndsWithZero) {
    const std::string inputs = R"("a": {"value": 1, "u": 0.03}, "b": {"value": 2, "u": 0.04})";
    const json y =
        y_of(budget("\"y = a + b\"", inputs, R"(, "monte_carlo": {"trials": 1000000, "validate": true, "digits": 1})"));
    EXPECT_EQ(y["monte_carlo"]["validation"]["validated"], true);
    EXPECT_EQ(y["monte_carlo"]["validation"]["precise_enough"], true);
}

// Bad input.

TEST_F(Budget, NumbersThatAreNone) {
    const auto with = [](const std::string& value, const std::string& u) {
        return budget("\"y = a\"", "\"a\": {\"value\": " + value + ", \"unit\": \"mm\", \"u\": " + u + "}");
    };
    expect_refused(3, "GC-INPUT-0013", "job.json:3:", {"1e999", "/inputs/a/value"}, with("1e999", "1"));
    expect_refused(3, "GC-INPUT-0013", "job.json:3:", {"1e-999", "/inputs/a/u"}, with("1", "1e-999"));
    expect_refused(3, "GC-INPUT-0016", "job.json:3:", {"NaN"}, with("NaN", "1"));
    expect_refused(3, "GC-INPUT-0014", "job.json:3:", {"9007199254740993"}, with("9007199254740993", "1"));
    expect_refused(3, "GC-INPUT-0021", "job.json#/inputs/a/value (line 3", {"1.5"}, with("\"1.5\"", "1"));
}

TEST_F(Budget, UncertaintiesThatAreNone) {
    const auto with = [](const std::string& keys) {
        return budget("\"y = a\"", "\"a\": {\"unit\": \"mm\", \"value\": 1, " + keys + "}");
    };
    expect_refused(3, "GC-INPUT-0023", "job.json#/inputs/a/u (line 3", {"-0.1 mm", "greater than 0 mm"},
                   with("\"u\": -0.1"));
    expect_refused(3, "GC-INPUT-0023", "job.json#/inputs/a/u (line 3", {"u is 0 mm", "\"constant\": true"},
                   with("\"u\": 0"));
    expect_refused(3, "GC-INPUT-0023", "job.json#/inputs/a/half_width (line 3", {"half_width is 0 mm"},
                   with("\"half_width\": 0"));
    expect_refused(3, "GC-INPUT-0023", "job.json#/inputs/a/nu (line 3", {"nu is 0", "greater than 0"},
                   with("\"u\": 1, \"nu\": 0"));
    expect_refused(3, "GC-INPUT-0023", "job.json#/inputs/a/nu (line 3", {"nu is -3"}, with("\"u\": 1, \"nu\": -3"));
    expect_refused(3, "GC-INPUT-0301", "job.json#/inputs/a/half_width (line 3", {"\"u\" and \"half_width\""},
                   with("\"u\": 1, \"half_width\": 2"));
    expect_refused(3, "GC-INPUT-0300", "job.json#/inputs/a (line 3", {}, budget("\"y = a\"", "\"a\": {\"value\": 1}"));
}

TEST_F(Budget, CorrelationsThatCannotBe) {
    const std::string inputs = R"("a": {"value": 1, "u": 1}, "b": {"value": 1, "u": 1}, "c": {"value": 1, "u": 1})";
    const auto with = [&](const std::string& correlations) {
        return budget("\"y = a - b - c\"", inputs, ", \"correlations\": [" + correlations + "]");
    };
    expect_refused(3, "GC-INPUT-0023", "job.json#/correlations/0/2 (line 3", {"r(a, b) is 1.2", "at most 1"},
                   with(R"(["a", "b", 1.2])"));
    expect_refused(3, "GC-INPUT-0312", "job.json#/correlations/2 (line 3",
                   {"\"a\", \"b\" and \"c\"", "smallest eigenvalue", "-0.8", "positive semi-definite"},
                   with(R"(["a", "b", 0.9], ["a", "c", 0.9], ["b", "c", -0.9])"));
    expect_refused(3, "GC-INPUT-0310", "job.json#/correlations/1", {"\"a\"", "\"b\""},
                   with(R"(["a", "b", 0.9], ["b", "a", 0.8])"));
    expect_refused(3, "GC-INPUT-0309", "job.json#/correlations/0", {"\"a\""}, with(R"(["a", "a", 0.9])"));
    expect_refused(3, "GC-INPUT-0314", "job.json#/covariance/matrix", {"\"a\"", "\"b\"", "symmetric"},
                   budget("\"y = a - b - c\"", inputs,
                          R"(, "covariance": {"inputs": ["a", "b"], "matrix": [[1, 0.5], [0.4, 1]]})"));
    expect_refused(3, "GC-INPUT-0308", "job.json#/correlations/0/1", {"\"d\""}, with(R"(["a", "d", 0.9])"));
}

TEST_F(Budget, FullCorrelationWorks) {
    const std::string inputs = R"("a": {"value": 3, "u": 0.1}, "b": {"value": 1, "u": 0.1})";
    const std::string full = R"(, "correlations": [["a", "b", 1]], "monte_carlo": {"trials": 300000})";
    const json sum = y_of(budget("\"y = a + b\"", inputs, full));
    EXPECT_NEAR(sum["u"].get<double>(), 0.2, 1e-15);
    EXPECT_NEAR(sum["monte_carlo"]["u"].get<double>(), 0.2, 5 * 0.2 / std::sqrt(600000.0));
    const json difference = y_of(budget("\"y = a - b\"", inputs, full));
    EXPECT_EQ(difference["u"], 0.0);
    EXPECT_NEAR(difference["monte_carlo"]["u"].get<double>(), 0.0, 1e-15);
}

TEST_F(Budget, NamesAndOrderOfEquations) {
    const std::string a = R"("a": {"value": 1, "u": 0.1})";
    expect_refused(3, "GC-MODEL-0024", "job.json#/model/0 (line 2", {"y → x → z → y"},
                   budget(R"("y = x + a", "x = 2*z", "z = y/a")", a));
    expect_refused(3, "GC-MODEL-0025", "job.json#/model/0 (line 2", {"\"y\"", "both sides"},
                   budget("\"y = y + a\"", a));
    expect_refused(3, "GC-MODEL-0020", "job.json#/model/0 (line 2, column 11), column 9", {"\"bb\" is not known"},
                   budget("\"y = a + bb\"", a));
    expect_refused(3, "GC-MODEL-0021", "job.json#/model/1 (line 2", {"second equation for \"y\""},
                   budget(R"("y = a", "y = 2*a")", a));
    expect_refused(3, "GC-MODEL-0022", "job.json#/model/0 (line 2", {"\"a\" is an input"},
                   budget(R"("a = 2", "y = a")", a));
    const json record = record_of(budget("\"y = a\"", a + R"(, "b": {"value": 1, "u": 0.1})"));
    EXPECT_TRUE(tells(record, "GC-WARN-0008"));
    for (const json& diagnostic : record["diagnostics"]) {
        EXPECT_EQ(diagnostic["severity"], "warning");
        EXPECT_TRUE(diagnostic["where"].get<std::string>().starts_with("job.json#/inputs/b")) << diagnostic;
    }
}

TEST_F(Budget, NamesThatLookAlike) {
    const std::string u = ": {\"value\": 1, \"u\": 0.1}";
    // Cyrillic а beside Latin a: two names that nobody can tell apart on paper.
    expect_refused(3, "GC-MODEL-0029", "job.json#/inputs/", {"looks like \"a\""},
                   budget("\"y = a + а\"", "\"a\"" + u + ", \"а\"" + u));
    // One name of two scripts is told at its declaration and where it is used.
    write_bytes(job_file(), budget("\"y = U_х\"", "\"U_х\"" + u));
    const Ended ended =
        gumcert({"evaluate", job_file().string(), "-o", (folder() / "out").string(), "--json-messages"});
    EXPECT_EQ(ended.code, 3);
    const std::vector<Message> messages = json_messages(ended);
    ASSERT_FALSE(messages.empty());
    EXPECT_EQ(messages[0].code, "GC-INPUT-0303");
    EXPECT_NE(messages[0].what.find("U+0445"), std::string::npos) << messages[0].what;
    // Capital letters do tell names apart; a person is asked to look.
    EXPECT_TRUE(tells(record_of(budget("\"y = t + T\"", "\"t\"" + u + ", \"T\"" + u)), "GC-WARN-0009"));
}

TEST_F(Budget, KeysThatAreTwiceOrUnknown) {
    expect_refused(3, "GC-INPUT-0012", "job.json#/inputs/a (line 3", {"\"a\" occurs twice", "line 3"},
                   budget("\"y = a\"", R"("a": {"value": 1, "u": 1}, "a": {"value": 2, "u": 1})"));
    expect_refused(3, "GC-INPUT-0012", "job.json#/inputs/a/u (line 3", {"\"u\" occurs twice"},
                   budget("\"y = a\"", R"("a": {"value": 1, "u": 1, "u": 2})"));
    expect_refused(3, "GC-INPUT-0022", "job.json#/inputs/a/distribuiton (line 3", {"did you mean \"distribution\"?"},
                   budget("\"y = a\"", R"("a": {"value": 1, "half_width": 1, "distribuiton": "uniform"})"));
    expect_refused(3, "GC-INPUT-0022", "job.json#/montecarlo (line 3", {"did you mean \"monte_carlo\"?"},
                   budget("\"y = a\"", R"("a": {"value": 1, "u": 1})", ", \"montecarlo\": {}"));
}

TEST_F(Budget, UnitsThatDoNotBalance) {
    const auto with = [](const std::string& model, const std::string& unit, const std::string& more = "") {
        return budget(model, "\"a\": {\"value\": 1, \"u\": 0.1, \"unit\": \"" + unit + "\"}", more);
    };
    expect_refused(3, "GC-MODEL-0030", "job.json#/model/0 (line 2", {"mm + K", "dimension m", "dimension K"},
                   budget("\"y = a + b\"", R"("a": {"value": 1, "u": 1, "unit": "mm"},
                       "b": {"value": 1, "u": 1, "unit": "K"})"));
    expect_refused(3, "GC-MODEL-0031", "job.json#/model/0 (line 2", {"\"a\" is in mm", "ln takes a number"},
                   with("\"y = ln(a)\"", "mm"));
    expect_refused(3, "GC-MODEL-0032", "job.json#/model/0 (line 2", {"sin takes an angle", "rad"},
                   with("\"y = sin(a)\"", "1"));
    expect_refused(3, "GC-MODEL-0036", "job.json#/outputs/y (line", {"declared in K", "Celsius", "kelvin(t)"},
                   with("\"y = a\"", "degC", R"(, "outputs": {"y": {"unit": "K"}})"));
    expect_refused(3, "GC-MODEL-0035", "job.json#/outputs/y (line", {"dimension kg", "dimension m"},
                   with("\"y = a\"", "mm", R"(, "outputs": {"y": {"unit": "kg"}})"));
    EXPECT_EQ(y_of(with("\"y = sin(a)\"", "rad"))["unit"], "1");
    EXPECT_NEAR(y_of(with("\"y = sin(30*a)\"", "deg"))["value"].get<double>(), 0.5, 1e-15);
    EXPECT_NEAR(y_of(with("\"y = 1 + a\"", "percent"))["value"].get<double>(), 1.01, 1e-15);
    EXPECT_NEAR(y_of(with("\"y = kelvin(a)\"", "degC"))["value"].get<double>(), 274.15, 1e-12);
}

TEST_F(Budget, ModelsWithoutAValue) {
    expect_refused(4, "GC-MODEL-0060", "job.json#/model/0 (line 2", {"\"a/(b - c)\" of 1 and 0", "finite value"},
                   budget("\"y = a/(b - c)\"", R"("a": {"value": 1, "u": 0.1}, "b": {"value": 2, "u": 0.1},
                       "c": {"value": 2, "u": 0.1})"));
    expect_refused(4, "GC-MODEL-0060", "job.json#/model/0 (line 2", {"\"ln(a)\" of -1"},
                   budget("\"y = ln(a)\"", R"("a": {"value": -1, "u": 0.1})"));
    expect_refused(
        4, "GC-MODEL-0064", "job.json#/model/0 (line 2", {"sqrt(a)"},
        budget("\"y = sqrt(a)\"", R"("a": {"value": 0, "u": 0.1})", R"(, "coverage": "law_of_propagation")"));
    expect_refused(4, "GC-GUM-0120", "result y, monte carlo, trial ", {"the model has no derivative at the estimates"},
                   budget("\"y = sqrt(a)\"", R"("a": {"value": 0, "u": 0.1})"));
    // In some trials only: counted, and one of them is shown with its inputs.
    expect_refused(4, "GC-GUM-0120", "monte carlo, trial ", {" such trials among the first 4096", "a = -0."},
                   budget("\"y = ln(a)\"", R"("a": {"value": 1, "u": 0.4})", R"(, "monte_carlo": {"trials": 100000})"));
    // Correlated inputs are drawn as one group: each is shown by its own name, in its own unit.
    expect_refused(
        4, "GC-GUM-0120", "monte carlo, trial ", {"a = -0.", ", b = 0.0", " m ("},
        budget("\"y = ln(a)*b\"", R"("a": {"value": 1, "u": 0.4}, "b": {"value": 5, "u": 0.1, "unit": "mm"})",
               R"(, "correlations": [["a", "b", 0.5]], "monte_carlo": {"trials": 100000})"));
}

TEST_F(Budget, TrialsBeyondAllBounds) {
    const auto with = [](const std::string& trials) {
        return budget("\"y = a\"", R"("a": {"value": 1, "u": 0.1})",
                      ",\n\"monte_carlo\": {\"trials\": " + trials + "}");
    };
    for (const std::string trials : {"1000000000000000000", "1e18", "10000000001", "0", "-5"}) {
        expect_refused(3, "GC-INPUT-0023", "job.json#/monte_carlo/trials (line 4", {"10000000000"}, with(trials));
    }
    expect_refused(3, "GC-INPUT-0024", "job.json#/monte_carlo/trials (line 4", {"whole number"}, with("20000.5"));
    expect_refused(3, "GC-INPUT-0319", "job.json#/monte_carlo/trials (line 4", {"10 trials", "2198"}, with("10"));
    EXPECT_TRUE(tells(record_of(with("3000")), "GC-WARN-0010"));
}

TEST_F(Budget, DepthCannotExhaustTheStack) {
    const auto nested = [](std::size_t depth, const std::string& open, const std::string& close) {
        std::string text = "\"y = ";
        for (std::size_t i = 0; i < depth; ++i) {
            text += open;
        }
        text += "a";
        for (std::size_t i = 0; i < depth; ++i) {
            text += close;
        }
        return budget(text + "\"", R"("a": {"value": 1, "u": 0.1})");
    };
    EXPECT_EQ(y_of(nested(190, "(", ")"))["value"], 1.0);
    expect_refused(3, "GC-MODEL-0016", "job.json#/model/0 (line 2", {"200"}, nested(201, "(", ")"));
    expect_refused(3, "GC-MODEL-0016", "job.json#/model/0 (line 2", {"200"}, nested(30'000, "(", ")"));
    expect_refused(3, "GC-MODEL-0016", "job.json#/model/0 (line 2", {"200"}, nested(60'000, "-", ""));
    expect_refused(3, "GC-MODEL-0016", "job.json#/model/0 (line 2", {"200"}, nested(10'000, "sin(", ")"));
    expect_refused(3, "GC-INPUT-0332", "job.json#/model/0 (line 2", {"200005 bytes", "at most"},
                   nested(100'000, "(", ")"));
    expect_refused(3, "GC-INPUT-0015", "job.json:2:", {"1048576"}, nested(1'000'000, "(", ")"));
    expect_refused(3, "GC-INPUT-0011", "job.json:2:", {"64"},
                   budget(std::string(1'000'000, '['), R"("a": {"value": 1, "u": 0.1})"));
}

TEST_F(Budget, EverythingInOneRun) {
    write_bytes(job_file(), budget("\"y = a + bb\", \"z = sin(a)\"", R"("a": {"value": 1, "u": -1}, "b": {"valu": 1})",
                                   R"(, "correlations": [["a", "b", 2]], "monte_carlo": {"trials": 10})"));
    const Ended ended =
        gumcert({"evaluate", job_file().string(), "-o", (folder() / "out").string(), "--json-messages"});
    EXPECT_EQ(ended.code, 3);
    std::map<std::string, int> codes;
    for (const Message& message : json_messages(ended)) {
        ++codes[message.code];
    }
    for (const char* const code : {"GC-INPUT-0022", "GC-INPUT-0023", "GC-INPUT-0319", "GC-MODEL-0020"}) {
        EXPECT_TRUE(codes.contains(code)) << code << " is missing:\n" << ended.err;
    }
    EXPECT_EQ(codes["GC-INPUT-0023"], 2) << ended.err;
}

// Numbers that other programs give wrong.

constexpr const char* k_readings = R"("observations": [9.9, 10.0, 10.1, 10.0])";

TEST_F(Budget, ReadingsAndANormalContributionAreCountedOnce) {
    // s/√n = 0.0408 with 3 degrees of freedom beside u = 1. A program that draws the sum and then adds the normal
    // contribution again finds 1.414.
    const std::string monte_carlo = R"(, "monte_carlo": {"trials": 1000000})";
    for (const std::string& job :
         {budget("\"y = a\"",
                 std::string(R"("a": {"components": [{"name": "readings", )") + k_readings +
                     R"(}, {"name": "instrument", "u": 1}]})",
                 monte_carlo),
          budget("\"y = a + b\"", std::string("\"a\": {") + k_readings + R"(}, "b": {"value": 0, "u": 1})",
                 monte_carlo)}) {
        const json y = y_of(job);
        EXPECT_EQ(printed_like(y["u"].get<double>(), "1.001"), "1.001");
        // Monte Carlo draws the scaled and shifted t: u² = 1 + 3 · 0.0408² (JCGM 101:2008, 6.4.9.4).
        EXPECT_NEAR(y["monte_carlo"]["u"].get<double>(), std::sqrt(1.0 + 3.0 * 0.02 / 3.0 / 4.0),
                    5.0 * y["monte_carlo"]["numerical_error"]["u"].get<double>());
    }
}

TEST_F(Budget, TheConvolutionIsWhatMonteCarloFinds) {
    // Beside a contribution of 0.05 Welch–Satterthwaite gives U = 0.138; the sum of t (ν = 3) and normal has 95.45 %
    // within ±0.16501 (numerical quadrature).
    const json y = y_of(budget("\"y = a\"",
                               std::string(R"("a": {"components": [{"name": "readings", )") + k_readings +
                                   R"(}, {"name": "instrument", "u": 0.05}]})",
                               R"(, "monte_carlo": {"trials": 1000000, "validate": true, "digits": 1})"),
                        0);
    const json& monte_carlo = y["monte_carlo"];
    EXPECT_EQ(printed_like(y["U"].get<double>(), "0.16501"), "0.16501");
    EXPECT_NEAR(half_width(monte_carlo["symmetric"]), 0.16501, 4.0 * half_width_error(monte_carlo, "symmetric"));
    EXPECT_EQ(monte_carlo["validation"]["validated"], true);
}

TEST_F(Budget, FourReadingsHaveTheIntervalOfStudent) {
    const json y = y_of(budget("\"y = a\"", std::string("\"a\": {") + k_readings + "}",
                               R"(, "coverage_probability": 0.99, "monte_carlo": {"trials": 1000000})"));
    EXPECT_EQ(printed_like(y["U"].get<double>(), "0.238"), "0.238");
    EXPECT_EQ(y["nu_eff"], 3.0);
    const json& monte_carlo = y["monte_carlo"];
    EXPECT_NEAR(half_width(monte_carlo["symmetric"]), 0.238454, 4.0 * half_width_error(monte_carlo, "symmetric"));
}

TEST_F(Budget, CorrelatedInputsAreAnEnsembleOrDrawn) {
    const auto with = [](const std::string& nu) {
        return budget("\"y = a + b\"",
                      R"("a": {"value": 1, "u": 0.1, "nu": 5}, "b": {"value": 2, "u": 0.1, "nu": )" + nu + "}",
                      R"(, "correlations": [["a", "b", 0.5]])");
    };
    const json ensemble = record_of(with("5"));
    EXPECT_NEAR(ensemble["results"]["y"]["nu_eff"].get<double>(), 5.0, 1e-12);
    EXPECT_NEAR(ensemble["results"]["y"]["u"].get<double>(), std::sqrt(0.03), 1e-15);
    EXPECT_TRUE(tells(ensemble, "GC-BUDGET-0010")) << "what was assumed is told";
    const json different = record_of(with("6"));
    const json& y = different["results"]["y"];
    EXPECT_NEAR(y["nu_eff"].get<double>(), 5.0, 1e-12);
    // They are no ensemble: k is that of what Monte Carlo draws. Half-width of 95.45 % of 6 million draws of a Gaussian copula with
    // rho = 0.5, by another program: 0.4454, and 0.4469 for the correlation 0.5 that they should have.
    EXPECT_NEAR(y["U"].get<double>(), 0.4469, 0.002);
    EXPECT_LT(y["U"], ensemble["results"]["y"]["U"]);
    EXPECT_TRUE(tells(different, "GC-BUDGET-0012"));
}

TEST_F(Budget, SquareOfZeroHasNoUncertaintyOfFirstOrder) {
    const json record = record_of(budget("\"y = x^2\"", R"("x": {"value": 0, "u": 1})"));
    const json& y = record["results"]["y"];
    EXPECT_TRUE(tells(record, "GC-BUDGET-0025"));
    EXPECT_EQ(printed_like(y["second_order"]["u"].get<double>(), "1.414"), "1.414");
    EXPECT_EQ(y["second_order"]["shift"], 1.0);
    EXPECT_TRUE(y["U"].is_null() && y["k"].is_null()) << y;
    EXPECT_EQ(y["printed"]["U"], "");
    const json& reported = y["reported"];
    EXPECT_EQ(reported["because"], "vanishing");
    EXPECT_TRUE(reported["U"].is_null());
    EXPECT_EQ(reported["printed"]["value"], "1.0");
    EXPECT_EQ(reported["printed"]["u"], "1.4");
    EXPECT_EQ(reported["printed"]["low"], "0.0");
    EXPECT_EQ(reported["printed"]["high"].get<std::string>().substr(0, 2), "5.");  // χ²: 5.187
}

/// Half the width of an interval is an expanded uncertainty only about the middle of that interval: 0 ± 2.59 would hold
/// 89 % of the values of x², not 95.45 %.
TEST_F(Budget, ExpandedUncertaintyHoldsItsProbabilityAboutTheValue) {
    const json y =
        y_of(budget("\"y = x^2\"", R"("x": {"value": 0, "u": 1})", R"(, "monte_carlo": {"trials": 1000000})"));
    const json& monte_carlo = y["monte_carlo"];
    const double error = 5.0 * monte_carlo["numerical_error"]["u"].get<double>();
    EXPECT_NEAR(monte_carlo["u"].get<double>(), std::sqrt(2.0), error);
    EXPECT_NEAR(monte_carlo["mean"].get<double>(), 1.0, 5.0 * monte_carlo["numerical_error"]["mean"].get<double>());
    if (y["U"].is_number()) {
        // χ² with one degree of freedom: P(y − U ≤ x² ≤ y + U)
        const double value = y["value"].get<double>();
        const double U = y["U"].get<double>();
        const auto below = [](double q) { return q <= 0.0 ? 0.0 : std::erf(std::sqrt(0.5 * q)); };
        EXPECT_NEAR(below(value + U) - below(value - U), 0.9545, 0.002) << value << " ± " << U;
    }
}

TEST_F(Budget, DistributionsHaveTheirStandardDeviation) {
    const auto expect_u = [this](const std::string& statement, double value, double u) {
        SCOPED_TRACE(statement);
        const json y =
            y_of(budget("\"y = a\"", "\"a\": {" + statement + "}", R"(, "monte_carlo": {"trials": 300000})"));
        EXPECT_NEAR(y["value"].get<double>(), value, 1e-12);
        EXPECT_NEAR(y["u"].get<double>(), u, 1e-12);
        EXPECT_NEAR(y["monte_carlo"]["u"].get<double>(), u,
                    5.0 * y["monte_carlo"]["numerical_error"]["u"].get<double>());
    };
    expect_u(R"("value": 0, "half_width": 0.5, "distribution": "arcsine")", 0.0, 0.5 / std::sqrt(2.0));
    expect_u(R"("limits": [1, 2], "distribution": "arcsine")", 1.5, 0.5 / std::sqrt(2.0));
    expect_u(R"("limits": [-1, 1], "distribution": "curvilinear_trapezoid", "d": 0.3)", 0.0,
             std::sqrt(1.0 / 3.0 + 0.09 / 9.0));
    expect_u(R"("value": 2, "half_width": 1)", 2.0, 1.0 / std::sqrt(3.0));
    expect_u(R"("value": 2, "half_width": 1, "distribution": "triangular")", 2.0, 1.0 / std::sqrt(6.0));
    expect_u(R"("value": 2, "half_width": 1, "distribution": "trapezoidal", "beta": 0.5)", 2.0, std::sqrt(1.25 / 6.0));
    expect_u(R"("value": 2, "resolution": 1)", 2.0, 1.0 / std::sqrt(12.0));
    expect_u(R"("distribution": {"kind": "gamma", "shape": 2, "scale": 1})", 2.0, std::sqrt(2.0));
    expect_u(R"("distribution": {"kind": "exponential", "mean": 3})", 3.0, 3.0);
}

TEST_F(Budget, MonteCarloIsReportedWhereTheLawOfPropagationDoesNotHold) {
    const std::string x = R"("x": {"value": 1, "u": 0.5})";
    const std::string monte_carlo = R"(, "monte_carlo": {"trials": 300000})";
    const auto method = [this](const std::string& job) { return y_of(job)["reported"]["method"]; };
    EXPECT_EQ(method(budget("\"y = x^2\"", x, monte_carlo)), "monte_carlo");
    EXPECT_EQ(method(budget("\"y = 2*x\"", x, monte_carlo)), "law_of_propagation");
    const std::string skew = R"("a": {"distribution": {"kind": "gamma", "shape": 2, "scale": 1}})";
    EXPECT_EQ(method(budget("\"y = a\"", skew)), "monte_carlo");
    EXPECT_TRUE(tells(record_of(budget("\"y = x^2\"", x, R"(, "coverage": "law_of_propagation")")), "GC-BUDGET-0026"));
}

TEST_F(Budget, ValidationCountsDigitsInTheUnitOfTheResult) {
    // u = 10 mm to two digits: delta is half a millimetre, whatever the unit of the inputs.
    const json record = record_of(budget(
        "\"y = a + b\"", R"("a": {"value": 1, "u": 0.006, "unit": "m"}, "b": {"value": 2, "u": 0.008, "unit": "m"})",
        R"(, "outputs": {"y": {"unit": "mm"}}, "monte_carlo": {"trials": 1000000, "validate": true})"));
    const json& validation = record["results"]["y"]["monte_carlo"]["validation"];
    EXPECT_EQ(validation["delta"], 0.5);
    EXPECT_EQ(validation["validated"], true);
}

TEST_F(Budget, StudentKeepsItsDegreesOfFreedom) {
    const json y =
        y_of(budget("\"y = a\"", R"("a": {"distribution": {"kind": "t", "location": 0, "scale": 4, "nu": 5}})",
                    R"(, "monte_carlo": {"trials": 1000000})"));
    EXPECT_EQ(y["u"], 4.0);
    EXPECT_EQ(y["nu_eff"], 5.0);
    EXPECT_NEAR(y["U"].get<double>(), 10.594617, 1e-6);
    const json& monte_carlo = y["monte_carlo"];
    EXPECT_NEAR(half_width(monte_carlo["symmetric"]), 10.594617, 4.0 * half_width_error(monte_carlo, "symmetric"));
    EXPECT_NEAR(monte_carlo["u"].get<double>(), 4.0 * std::sqrt(5.0 / 3.0),
                5.0 * monte_carlo["numerical_error"]["u"].get<double>());
}

/// A value half-way between two printed ones does not depend on the rounding of the computation, or on the unit.
TEST_F(Budget, TiesPrintAsAPersonWouldRoundThem) {
    const auto printed = [this](const std::string& a, const std::string& b, const std::string& unit,
                                const std::string& u) {
        const auto input = [&](const std::string& value) {
            return "{\"value\": " + value + ", \"unit\": \"" + unit + "\", \"u\": " + u + "}";
        };
        return y_of(budget("\"y = a + b\"", "\"a\": " + input(a) + ", \"b\": " + input(b),
                           R"(, "coverage_probability": 0.95, "outputs": {"y": {"unit": "mm"}})"))["printed"];
    };
    for (const json& result :
         {printed("3139.674", "223.676", "mm", "0.36"), printed("3.139674", "0.223676", "m", "0.36e-3"),
          printed("3139674", "223676", "um", "360")}) {
        EXPECT_EQ(result, (json{{"value", "3363.4"}, {"U", "1.0"}, {"unit", "mm"}}));
    }
}

}  // namespace
}  // namespace gumcert::cli
