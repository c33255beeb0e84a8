// What is wrong with a job is told with a stable code and its place, all of it in one run, and nothing is written.
#include <algorithm>
#include <set>

#include "tests/cli/job_files.h"
#include "tests/cli/program.h"

namespace gumcert::cli {
namespace {

using nlohmann::json;

class RefusedInput : public ProgramTest {
protected:
    void SetUp() override {
        job_ = copy_of_example(folder() / "job");
        lengths_ = job_.parent_path() / "lengths.csv";
        fixture_ = job_.parent_path() / "fixture.csv";
    }

    /// Runs the job.
    /// \return its messages, all of them errors
    std::vector<Message> messages(int code = 3) const {
        const auto before = contents_of(folder());
        const Ended ended = run(job_, folder() / "out", {"--json-messages"});
        EXPECT_EQ(ended.code, code) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_FALSE(fs::exists(folder() / "out"));
        EXPECT_EQ(contents_of(folder()), before);
        std::vector<Message> all = json_messages(ended);
        EXPECT_FALSE(all.empty());
        for (const Message& message : all) {
            EXPECT_EQ(message.severity, "error");
            EXPECT_FALSE(message.rule.empty());
            EXPECT_EQ(message.where.find(folder().string()), std::string::npos) << "names as the job gives them";
        }
        return all;
    }
    /// The one message of a job with one thing wrong.
    Message only_message(int code = 3) const {
        const std::vector<Message> all = messages(code);
        EXPECT_EQ(all.size(), 1U) << all.back().where << ": " << all.back().what;
        return all.empty() ? Message{} : all.front();
    }

    fs::path job_;
    fs::path lengths_;
    fs::path fixture_;
};

TEST_F(RefusedInput, MissingColumn) {
    replace_in(lengths_, "length_mm", "length");
    const std::vector<Message> all = messages();
    EXPECT_EQ(all[0].code, "GC-INPUT-0102");
    EXPECT_TRUE(all[0].where.starts_with("lengths.csv:1:")) << all[0].where;
    EXPECT_NE((all[0].what + all[0].rule + all[0].action).find("length_mm"), std::string::npos);
}

TEST_F(RefusedInput, TextInANumber) {
    replace_in(lengths_, "P1,R1,P1-1,+,0.0000,808.831212,P1", "P1,R1,P1-1,+,0.0000,808.831212 mm,P1");
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0108");
    EXPECT_EQ(message.where, "lengths.csv:2:21");
    EXPECT_NE(message.what.find("\"808.831212 mm\""), std::string::npos) << message.what;
    EXPECT_NE(message.what.find("length_mm"), std::string::npos) << message.what;
    EXPECT_NE(message.action.find("without unit"), std::string::npos) << message.action;
}

TEST_F(RefusedInput, UnknownReflector) {
    replace_in(lengths_, "P1,R2,P1-1", "P1,R7,P1-1");
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0204");
    EXPECT_EQ(message.where, "lengths.csv:3:4");
    EXPECT_NE(message.what.find("\"R7\""), std::string::npos) << message.what;
}

TEST_F(RefusedInput, TwoReflectorsOfOneName) {
    replace_in(fixture_, "\nR2,", "\nR1,");
    const std::vector<Message> all = messages();
    EXPECT_EQ(all[0].code, "GC-INPUT-0206");
    EXPECT_EQ(all[0].where, "fixture.csv:3:1");
    EXPECT_NE(all[0].what.find("\"R1\""), std::string::npos) << all[0].what;
    EXPECT_NE(all[0].what.find("line 2"), std::string::npos) << all[0].what;
}

TEST_F(RefusedInput, AnglesInRadians) {
    std::string text;
    for (const std::string& line : lines_of(bytes_of(lengths_))) {
        std::vector<std::string> cells;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) {
            cells.push_back(cell);
        }
        if (!text.empty()) {
            double degrees = 0.0;
            std::from_chars(cells[4].data(), cells[4].data() + cells[4].size(), degrees);
            cells[4] = digits(std::round(degrees / 180.0 * std::numbers::pi * 1e6) / 1e6);
        }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            text += (i == 0 ? "" : ",") + cells[i];
        }
        text += '\n';
    }
    write_bytes(lengths_, text);
    change_json(job_, [](json& job) { job.erase("reference_method"); });
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0211");
    EXPECT_TRUE(message.where.starts_with("lengths.csv:2:")) << message.where;
    EXPECT_NE(message.what.find("radians"), std::string::npos) << message.what;
    EXPECT_NE(message.rule.find("degrees"), std::string::npos) << message.rule;
}

TEST_F(RefusedInput, AngleWithTooFewDistances) {
    const std::string first = "P1,R1,P1-1,+,0.0000,";
    replace_in(lengths_, first, "P1,R1,P1-1,+,5.0000,");
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0212");
    EXPECT_EQ(message.where, "lengths.csv:2:14");
    EXPECT_NE(message.what.find("1 distance at the angle 5°"), std::string::npos) << message.what;
    EXPECT_NE(message.rule.find("6"), std::string::npos) << message.rule;
}

TEST_F(RefusedInput, NegativeUncertainty) {
    replace_in(fixture_, "33.2569,136.3070,5.2601,0.401", "33.2569,136.3070,5.2601,-0.401");
    const Message in_table = only_message();
    EXPECT_EQ(in_table.code, "GC-INPUT-0112");
    EXPECT_EQ(in_table.where, "fixture.csv:2:28");
    EXPECT_NE(in_table.what.find("-0.401"), std::string::npos) << in_table.what;
    EXPECT_NE(in_table.rule.find("greater than 0 µm"), std::string::npos) << in_table.rule;

    replace_in(fixture_, "-0.401", "0.401");
    change_json(job_, [](json& job) { job["length_uncertainty"]["u_constant_um"] = -0.05; });
    const Message in_job = only_message();
    EXPECT_EQ(in_job.code, "GC-INPUT-0023");
    EXPECT_TRUE(in_job.where.starts_with("job.json#/length_uncertainty/u_constant_um")) << in_job.where;
    EXPECT_NE(in_job.what.find("-0.05"), std::string::npos) << in_job.what;
    EXPECT_NE(in_job.what.find("µm"), std::string::npos) << "a value has its unit: " << in_job.what;
}

TEST_F(RefusedInput, NotANumber) {
    for (const char* const text : {"NaN", "nan", "inf", "-Infinity"}) {
        write_bytes(lengths_, bytes_of(shipped_example() / "lengths.csv"));
        replace_in(lengths_, "808.831212", text);
        const Message message = only_message();
        EXPECT_EQ(message.code, "GC-INPUT-0109") << text;
        EXPECT_EQ(message.where, "lengths.csv:2:21");
    }
    write_bytes(lengths_, bytes_of(shipped_example() / "lengths.csv"));
    replace_in(job_, "0.9545", "NaN");
    EXPECT_EQ(only_message().code, "GC-INPUT-0016");
}

TEST_F(RefusedInput, EmptyFiles) {
    write_bytes(lengths_, "");
    const std::vector<Message> all = messages();
    EXPECT_EQ(all[0].code, "GC-INPUT-0006");
    EXPECT_TRUE(all[0].where.starts_with("lengths.csv")) << all[0].where;
    write_bytes(lengths_, "station,reflector,pass,direction,angle_deg,length_mm,dead_path\n");
    EXPECT_EQ(messages()[0].code, "GC-INPUT-0100");
    write_bytes(job_, "");
    EXPECT_EQ(only_message().code, "GC-INPUT-0006");
}

TEST_F(RefusedInput, DecimalComma) {
    replace_in(lengths_, "0.0000,808.831212", "0.0000,808,831212");
    const Message split = only_message();
    EXPECT_EQ(split.code, "GC-INPUT-0105");
    EXPECT_TRUE(split.where.starts_with("lengths.csv:2:")) << split.where;
    EXPECT_NE(split.what.find("\"808,831212\""), std::string::npos) << split.what;
    EXPECT_NE(split.action.find("decimal point"), std::string::npos) << split.action;

    replace_in(lengths_, "808,831212", "\"808,831212\"");
    const Message quoted = only_message();
    EXPECT_EQ(quoted.code, "GC-INPUT-0105");
    EXPECT_EQ(quoted.where, "lengths.csv:2:21");
    EXPECT_NE(quoted.action.find("decimal point"), std::string::npos) << quoted.action;

    // As a spreadsheet of a country with decimal commas saves it.
    std::string text = bytes_of(shipped_example() / "lengths.csv");
    std::replace(text.begin(), text.end(), ',', ';');
    std::replace(text.begin(), text.end(), '.', ',');
    write_bytes(lengths_, text);
    const Ended read = gumcert({"evaluate", job_.string(), "-o", "-", "--quiet"});
    EXPECT_EQ(read.code, 0) << "semicolons and decimal commas have one meaning\n" << read.err;
}

TEST_F(RefusedInput, UnknownKey) {
    change_json(job_, [](json& job) { job["outliers"] = {{"test", "none"}, {"alfa", 0.001}}; });
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0022");
    EXPECT_TRUE(message.where.starts_with("job.json#/outliers/alfa")) << message.where;
    EXPECT_NE(message.action.find("\"alpha\""), std::string::npos) << message.action;
}

TEST_F(RefusedInput, DuplicateKey) {
    replace_in(job_, "\"datum\":", "\"axis\": \"B\", \"datum\":");
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0012");
    EXPECT_TRUE(message.where.starts_with("job.json")) << message.where;
    EXPECT_NE((message.where + message.what).find("axis"), std::string::npos) << message.what;
}

TEST_F(RefusedInput, BrokenJson) {
    const std::string whole = bytes_of(job_);
    write_bytes(job_, whole.substr(0, whole.size() / 2));
    EXPECT_EQ(only_message().code, "GC-INPUT-0010");
    write_bytes(job_, whole);
    replace_in(job_, "\"axis\": \"A\",", "\"axis\": \"A\"");
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0010");
    EXPECT_TRUE(message.where.starts_with("job.json:6:")) << message.where;
    write_bytes(job_, whole + "}");
    EXPECT_EQ(only_message().code, "GC-INPUT-0017");
}

TEST_F(RefusedInput, AJobOfAnotherKindThanItSays) {
    change_json(job_, [](json& job) { job["kind"] = "comparison"; });
    const auto before = contents_of(folder());
    for (const char* const command : {"run", "evaluate", "compare"}) {
        const Ended ended = gumcert({command, job_.string(), "-o", (folder() / "out").string(), "--json-messages"});
        EXPECT_EQ(ended.code, 3);
        const std::vector<Message> all = json_messages(ended);
        const bool axis = std::any_of(all.begin(), all.end(), [](const Message& m) {
            return m.code == "GC-INPUT-0022" && m.where.find("job.json#/axis") != std::string::npos;
        });
        EXPECT_TRUE(axis) << ended.err;
        EXPECT_EQ(contents_of(folder()), before);
    }
    change_json(job_, [](json& job) { job["kind"] = "rotary table"; });
    EXPECT_EQ(only_message().code, "GC-INPUT-0028");
    change_json(job_, [](json& job) { job["kind"] = "rotary_table", job["schema"] = "gumcert/job/2"; });
    EXPECT_EQ(only_message().code, "GC-INPUT-0027");
}

TEST_F(RefusedInput, ProblemsOfTheFixtureBudgetAreToldWithItsPlace) {
    change_json(job_, [](json& job) { job["fixture"]["budget"] = "fixture_budget.json"; });
    const fs::path points = job_.parent_path() / "fixture_points.csv";
    replace_in(points, "R2.y,", "R2.w,");
    const std::vector<Message> all = messages();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].code, "GC-INPUT-0225");
    EXPECT_EQ(all[0].where, "fixture_budget.json#/points");
    EXPECT_NE(all[0].what.find("\"R2.y\" has no point"), std::string::npos) << all[0].what;
    EXPECT_NE(all[1].what.find("\"R2.w\" is no coordinate"), std::string::npos) << all[1].what;

    replace_in(points, "R2.w,", "R2.y,");
    replace_in(job_.parent_path() / "fixture_budget.json", "\"u\": 0.027", "\"u\": -0.027");
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0023");
    EXPECT_TRUE(message.where.starts_with("fixture_budget.json#/inputs/d_theta/u")) << message.where;
}

TEST_F(RefusedInput, TwoSourcesOfTheUncertaintyOfTheFixture) {
    change_json(job_, [](json& job) {
        job["fixture"]["budget"] = "fixture_budget.json";
        job["fixture"]["uncertainty"] = "source_paper";
    });
    const Message message = only_message();
    EXPECT_EQ(message.code, "GC-INPUT-0224");
    EXPECT_TRUE(message.where.starts_with("job.json#/fixture/budget")) << message.where;
}

TEST_F(RefusedInput, MissingDataFileIsAFileTrouble) {
    fs::remove(fixture_);
    const Message message = only_message(5);
    EXPECT_EQ(message.code, "GC-STORAGE-0001");
    EXPECT_EQ(message.where, "fixture.csv");
    EXPECT_NE(message.what.find("no such file"), std::string::npos) << message.what;
    EXPECT_NE(message.what.find("it is named at job.json#/fixture/coordinates"), std::string::npos) << message.what;
    // Problems of the other files are told in the same run.
    replace_in(lengths_, "808.831212", "NaN");
    EXPECT_EQ(messages(5).size(), 2U);
}

TEST_F(RefusedInput, EverythingInOneRun) {
    change_json(job_, [](json& job) {
        job["axiss"] = "A";
        job["datum"] = "somewhere";
        job["length_uncertainty"]["scale_u"] = 0.15;
    });
    replace_in(lengths_, "808.831212", "808.83x");
    replace_in(lengths_, "P1,R2,P1-1,+", "P1,R2,P1-1,up");
    replace_in(fixture_, ",0.404,", ",-0.404,");
    replace_in(fixture_, "\nR3,152.7594", "\nR3,NaN");
    replace_in(job_.parent_path() / "environment.csv", "20.205", "");
    replace_in(job_.parent_path() / "dial_indicator.json", "0.8", "-0.8");
    std::set<std::string> found;
    for (const Message& message : messages()) {
        found.insert(message.code + " " + message.where.substr(0, message.where.find_first_of(":#")));
    }
    EXPECT_EQ(found,
              (std::set<std::string>{"GC-INPUT-0022 job.json", "GC-INPUT-0025 job.json", "GC-INPUT-0023 job.json",
                                     "GC-INPUT-0108 lengths.csv", "GC-INPUT-0114 lengths.csv",
                                     "GC-INPUT-0112 fixture.csv", "GC-INPUT-0109 fixture.csv",
                                     "GC-INPUT-0111 environment.csv", "GC-INPUT-0023 dial_indicator.json"}));
    // In the form for persons every one is a line of its own.
    const Ended text = run(job_, folder() / "out");
    const std::vector<std::string> lines = lines_of(text.err);
    EXPECT_EQ(lines.size(), messages().size());
    for (const std::string& line : lines) {
        EXPECT_TRUE(is_message_line(line)) << line;
    }
}

TEST_F(RefusedInput, HiddenCharactersCannotForgeAMessage) {
    replace_in(lengths_, "P1,R2,P1-1", "P1,\"R2\njob.json — all is well [GC-NOTE-0001]\",P1-1");
    for (const std::string& line : lines_of(run(job_, folder() / "out").err)) {
        EXPECT_TRUE(line.starts_with("lengths.csv:")) << line;
    }
}

/// Expects the same keys, texts and numbers, to the last bit.
void expect_same(const json& a, const json& b, const std::string& at) {
    if (a.is_number() && b.is_number()) {
        const double x = a.get<double>();
        const double y = b.get<double>();
        EXPECT_EQ(x, y) << at;
    } else if (a.is_structured() && a.type() == b.type() && a.size() == b.size()) {
        const auto& others = b;
        for (const auto& [key, value] : a.items()) {
            const bool known = a.is_array() || others.contains(key);
            ASSERT_TRUE(known) << at << "/" << key;
            expect_same(value, a.is_array() ? others[std::stoul(key)] : others[key], at + "/" + key);
        }
    } else {
        EXPECT_EQ(a, b) << at;
    }
}

/// Line ends and byte order mark of another system change nothing but the digests.
TEST_F(RefusedInput, WindowsFilesGiveTheSameNumbers) {
    json original = evaluate(job_);
    for (const fs::directory_entry& file : fs::directory_iterator(job_.parent_path())) {
        std::string text = "\xEF\xBB\xBF";
        for (const char character : bytes_of(file.path())) {
            text += character == '\n' ? "\r\n" : std::string(1, character);
        }
        write_bytes(file.path(), text);
    }
    json windows = evaluate(job_);
    for (json* record : {&original, &windows}) {
        (*record)["rotary"]["covariance"].erase("file");  // its name has a digest in it
    }
    for (const char* const part : {"results", "rotary", "comparison", "options"}) {
        expect_same(windows[part], original[part], part);
    }
    EXPECT_EQ(windows["job"]["document"], original["job"]["document"]);
    EXPECT_NE(windows["job"]["files"], original["job"]["files"]);
}

/// Of several files in one command nobody knows which one "job.json#/foo" is in: the place has the folder then, whichever
/// command reads them.
TEST_F(RefusedInput, SeveralJobsAreNamedWithTheirFolders) {
    const fs::path table = folder() / "c" / "job.json";
    for (const char* const name : {"a", "b"}) {
        write_bytes(folder() / name / "job.json",
                    R"({"schema": "gumcert/job/1", "kind": "budget", "foo": 1, "model": ["y = x"],)"
                    R"( "inputs": {"x": {"value": 1, "u": 0.1}}})");
    }
    write_bytes(table, R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["y = x"], "inputs": {"x": {}},)"
                       R"( "points": {"file": "p.csv"}})");
    write_bytes(folder() / "c" / "p.csv", "x,x.u\n1,much\n");
    const std::vector<std::string> jobs{"a/job.json", "b/job.json", "c/job.json"};
    for (const std::string command : {"run", "check", "audit"}) {
        std::vector<std::string> words{command, "--json-messages", "--share", GUMCERT_SOURCE_DIR};
        if (command == "run") {  // their folders of outputs have one name
            for (const std::string& job : jobs) {
                fs::copy_file(folder() / job, (folder() / job).parent_path() / (job.substr(0, 1) + ".json"),
                              fs::copy_options::overwrite_existing);
                words.push_back(job.substr(0, 1) + "/" + job.substr(0, 1) + ".json");
            }
        } else {
            words.insert(words.end(), jobs.begin(), jobs.end());
        }
        const std::vector<std::string> named(words.end() - 3, words.end());
        std::vector<std::string> where;
        for (const Message& message : json_messages(gumcert(words, {.working_folder = folder()}))) {
            where.push_back(message.where);
        }
        ASSERT_EQ(where.size(), 3U) << command;
        EXPECT_TRUE(where[0].starts_with(named[0] + "#/foo")) << command << ": " << where[0];
        EXPECT_TRUE(where[1].starts_with(named[1] + "#/foo")) << command << ": " << where[1];
        EXPECT_TRUE(where[2].starts_with(named[2] + ", p.csv:2:")) << command << ": " << where[2];
    }
    // One alone is named as its folder has it.
    for (const std::string command : {"run", "check", "audit", "evaluate"}) {
        const std::vector<Message> alone =
            json_messages(gumcert({command, jobs[0], "--json-messages"}, {.working_folder = folder()}));
        ASSERT_EQ(alone.size(), 1U) << command;
        EXPECT_TRUE(alone[0].where.starts_with("job.json#/foo")) << command << ": " << alone[0].where;
    }
}

}  // namespace
}  // namespace gumcert::cli
