#pragma once

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

// The published cases of tests/reference/cases, for tests that give their data to one layer. Their README.md says what
// stands in them; gumcert self-test compares all of their values.
namespace gumcert::test {

inline std::filesystem::path reference_folder() {
    return std::filesystem::path(GUMCERT_SOURCE_DIR) / "tests" / "reference";
}

inline nlohmann::json reference_case(const std::string& id) {
    std::ifstream file(reference_folder() / "cases" / (id + ".json"));
    return nlohmann::json::parse(file);
}

/// The names of the cases that begin so, in the order of the alphabet.
inline std::vector<std::string> reference_ids(const std::string& prefix) {
    std::vector<std::string> ids;
    for (const auto& entry : std::filesystem::directory_iterator(reference_folder() / "cases")) {
        const std::string id = entry.path().stem().string();
        if (entry.path().extension() == ".json" && id.starts_with(prefix)) {
            ids.push_back(id);
        }
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

/// A job of a case with what it takes over from another one; its formulas are not filled in.
inline nlohmann::json reference_job(const nlohmann::json& reference, const std::string& name) {
    nlohmann::json job = reference.at("jobs").at(name);
    if (!job.contains("like")) {
        return job;
    }
    nlohmann::json whole = reference_job(reference, job["like"]);
    job.erase("like");
    whole.merge_patch(job);
    return whole;
}

/// The job whose record holds an expected value, by the first of its paths.
inline nlohmann::json job_of(const nlohmann::json& reference, const nlohmann::json& expected) {
    const nlohmann::json& found = expected.at("found");
    const std::string path = found.is_array() ? found.front() : found;
    const std::size_t begin = path.find('{') == std::string::npos ? 0 : path.find('{') + 1;
    return reference_job(reference, path.substr(begin, path.find('/') - begin));
}

/// The number that is expected, printed or computed.
inline double expected_number(const nlohmann::json& expected) {
    if (expected.contains("computed")) {
        return expected["computed"];
    }
    std::string text = expected.at("printed");
    std::erase(text, ' ');
    double value = 0.0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ptr != text.data() + text.size()) {
        throw std::invalid_argument(text + " is not a number");
    }
    return value;
}

}  // namespace gumcert::test
