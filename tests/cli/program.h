#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::cli {

namespace fs = std::filesystem;

inline std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw std::runtime_error(file.string() + " cannot be read");
    }
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const fs::path& file, const std::string& bytes) {
    fs::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    if (!stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
        throw std::runtime_error(file.string() + " cannot be written");
    }
}

/// A document with the ASCII sign in place of U+2212, the minus that documents print.
inline std::string with_ascii_minus(std::string text) {
    const std::string minus = "\u2212";
    for (std::size_t at = text.find(minus); at != std::string::npos; at = text.find(minus, at)) {
        text.replace(at, minus.size(), "-");
    }
    return text;
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Every file and folder below a folder, with the content of the files: equal before and after when nothing was
/// written, changed or removed.
inline std::map<std::string, std::string> contents_of(const fs::path& folder) {
    std::map<std::string, std::string> contents;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        contents[entry.path().lexically_relative(folder).string()] =
            entry.is_regular_file() ? bytes_of(entry.path()) : "(not a file)";
    }
    return contents;
}

/// The program that a name stands for on the search path; empty when there is none.
inline fs::path on_search_path(const std::string& name) {
    const char* const search = std::getenv("PATH");
    std::istringstream folders(search == nullptr ? "" : search);
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (access((fs::path(folder) / name).c_str(), X_OK) == 0) {
            return fs::path(folder) / name;
        }
    }
    return {};
}

/// What a process left behind.
struct Ended {
    int code = -1;  ///< exit code; 128 + the number of the signal that ended it
    std::string out;
    std::string err;
};

/// Where a process runs.
struct Surroundings {
    fs::path working_folder = {};                         ///< the folder of the test program when empty
    std::map<std::string, std::string> environment = {};  ///< added to, or instead of, that of the test program
    fs::path out = {};                                    ///< goes to this file instead of `Ended::out`
};

/// Runs a program without a shell and waits for it.
/// \param scratch  folder for its two outputs, not seen by it
inline Ended run_process(const fs::path& program, const std::vector<std::string>& arguments, const Surroundings& where,
                         const fs::path& scratch) {
    const fs::path out = where.out.empty() ? scratch / "stdout" : where.out;
    const fs::path err = scratch / "stderr";
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (!where.working_folder.empty()) {
        posix_spawn_file_actions_addchdir_np(&actions, where.working_folder.c_str());
    }

    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<std::string> settings;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string setting = *entry;
        if (!where.environment.contains(setting.substr(0, setting.find('=')))) {
            settings.push_back(setting);
        }
    }
    for (const auto& [name, value] : where.environment) {
        settings.push_back(name + "=" + value);
    }
    const auto pointers = [](std::vector<std::string>& texts) {
        std::vector<char*> result;
        std::transform(texts.begin(), texts.end(), std::back_inserter(result), [](std::string& t) { return t.data(); });
        result.push_back(nullptr);
        return result;
    };
    std::vector<char*> argv = pointers(words);
    std::vector<char*> envp = pointers(settings);
    pid_t child = 0;
    const int failure = posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), envp.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        throw std::runtime_error(program.string() + " cannot be started: " + std::strerror(failure));
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            throw std::runtime_error("waiting for " + program.string() + " failed");
        }
    }
    Ended ended;
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ended.out = where.out.empty() ? bytes_of(out) : "";
    ended.err = bytes_of(err);
    return ended;
}

/// A folder of its own below testing::TempDir(), removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::path(testing::TempDir()) / "gumcert-cli-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error(name + " cannot be made");
        }
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// One message of the program.
struct Message {
    std::string code;
    std::string where;
    std::string what;
    std::string rule;
    std::string action;
    std::string severity;
};

/// The messages of a run with --json-messages: one object a line, six texts each, nothing else.
inline std::vector<Message> json_messages(const Ended& ended) {
    std::vector<Message> messages;
    for (const std::string& line : lines_of(ended.err)) {
        const nlohmann::json object = nlohmann::json::parse(line, nullptr, false);
        if (!object.is_object() || object.size() != 6) {
            ADD_FAILURE() << "not a message: " << line;
            continue;
        }
        const auto text = [&](const char* key) {
            const auto found = object.find(key);
            EXPECT_TRUE(found != object.end() && found->is_string()) << key << " is missing in " << line;
            return found != object.end() && found->is_string() ? found->get<std::string>() : "";
        };
        messages.push_back({text("code"), text("where"), text("what"), text("rule"), text("action"), text("severity")});
        EXPECT_TRUE(std::regex_match(messages.back().code, std::regex("GC-[A-Z]+-[0-9]{4}"))) << line;
        EXPECT_FALSE(messages.back().where.empty()) << line;
        EXPECT_FALSE(messages.back().what.empty()) << line;
        EXPECT_FALSE(messages.back().action.empty()) << line;
    }
    return messages;
}

/// True when a line has the form for persons: where — what is wrong — the rule — what to do [code]. A note may have
/// nothing to do.
inline bool is_message_line(const std::string& line) {
    static const std::regex problem("(warning: )?.+ — .+ — .+ — .+ \\[GC-[A-Z]+-[0-9]{4}\\]");
    static const std::regex note("note: .+ — .+ — .+ \\[GC-[A-Z]+-[0-9]{4}\\]");
    return std::regex_match(line, line.starts_with("note: ") ? note : problem);
}

/// A test with a folder of its own. Whatever it does, the program leaves no half-written file and no temporary folder.
class ProgramTest : public testing::Test {
protected:
    /// \throws nothing; the folders exist when the test begins
    ProgramTest() {
        fs::create_directory(folder());
        fs::create_directory(temporary());
    }
    void TearDown() override {
        for (const auto& [name, bytes] : contents_of(root_.path())) {
            EXPECT_FALSE(name.ends_with(".part")) << name << " was left behind";
        }
        EXPECT_TRUE(fs::is_empty(temporary())) << "the program left something in its temporary folder";
    }

    /// The test's own folder.
    [[nodiscard]] fs::path folder() const { return root_.path() / "test"; }

    Ended gumcert(const std::vector<std::string>& arguments, Surroundings where = {}) const {
        where.environment.try_emplace("TMPDIR", temporary().string());
        return run_process(GUMCERT_PROGRAM, arguments, where, root_.path());
    }
    /// `gumcert run` with the templates of the source tree.
    Ended run(const fs::path& job, const fs::path& output, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"run", job.string(), "-o", output.string(), "--share", GUMCERT_SOURCE_DIR});
        return gumcert(more);
    }
    /// The record that `gumcert evaluate` writes; fails the test when it does not.
    nlohmann::json evaluate(const fs::path& job) const {
        const fs::path record = root_.path() / "evaluated" / "record.json";
        const Ended ended = gumcert({"evaluate", job.string(), "-o", record.string()});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return ended.code == 0 ? nlohmann::json::parse(bytes_of(record)) : nlohmann::json();
    }

private:
    [[nodiscard]] fs::path temporary() const { return root_.path() / "temporary"; }

    TemporaryFolder root_;
};

/// Why a PDF cannot be made on this machine; empty when it can.
inline std::string why_no_pdf() {
    if (on_search_path("node").empty()) {
        return "node is not installed";
    }
    if (!fs::is_directory(fs::path(GUMCERT_SOURCE_DIR) / "node_modules" / "@myriaddreamin")) {
        return "node_modules is missing: run scripts/setup";
    }
    return "";
}

}  // namespace gumcert::cli
