#include "text/file_guess.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

namespace gumcert::text {

namespace {

/// The end of a comment that begins here, as jobs may have them; `at` itself where none does.
std::size_t end_of_comment(std::string_view json, std::size_t at) {
    const std::string_view rest = json.substr(at);
    const std::size_t end = rest.starts_with("//")   ? json.find('\n', at)
                            : rest.starts_with("/*") ? json.find("*/", at + 2)
                                                     : at;
    return std::min(end, json.size());
}

/// Keys of the outermost object, each with its value where that is a string without escapes.
std::vector<std::pair<std::string, std::string>> outermost_keys(std::string_view json) {
    std::vector<std::pair<std::string, std::string>> keys;
    int depth = 0;
    bool is_value = false;  // behind the colon of an outermost key
    for (std::size_t i = 0; i < json.size() && keys.size() < 1000; ++i) {
        const char c = json[i];
        if (c == '"') {
            std::size_t end = i + 1;
            while (end < json.size() && json[end] != '"') {
                end += json[end] == '\\' ? std::size_t{2} : std::size_t{1};
            }
            if (end >= json.size()) {
                break;
            }
            const std::string_view word = json.substr(i + 1, end - i - 1);
            if (depth == 1 && !is_value) {
                keys.emplace_back(word, "");
            } else if (depth == 1 && !keys.empty()) {
                keys.back().second = word;
            }
            i = end;
        } else if (c == '{' || c == '[') {
            ++depth;
        } else if (c == '}' || c == ']') {
            if (--depth == 0) {
                break;
            }
        } else if (depth == 1 && (c == ':' || c == ',')) {
            is_value = c == ':';
        } else if (c == '/') {
            i = end_of_comment(json, i);
        }
    }
    return keys;
}

struct KnownSchema {
    std::string_view begin;
    const char* what;
    const char* action;
};
constexpr std::array k_schemas{
    KnownSchema{"gumcert/record/", "a record of an evaluation", "use gumcert render, check or rerun for it"},
    KnownSchema{"gumcert/job/", "a job", "use gumcert run, evaluate or check for it"},
    KnownSchema{"gumcert/audit/", "an audit as JSON", "use gumcert audit for the file that it is about"},
    KnownSchema{"gumcert/standard/", "a standard of a laboratory", "name its folder with --laboratory"},
    KnownSchema{"gumcert/laboratory/", "data of a laboratory", "name its folder with --laboratory"},
    KnownSchema{"gumcert/archive-evidence/", "evidence of an archived certificate",
                "use gumcert archive verify for it"},
    KnownSchema{"gumcert/archive-head/", "a head of an archive", "use gumcert archive verify for it"},
    KnownSchema{"gumcert/set/", "the list of a set of outputs", "use gumcert check for its folder"},
    KnownSchema{"gumcert/", "JSON that gumcert has written", "name the job or the record that it is of"},
};

}  // namespace

bool begins_as_json_object(std::string_view bytes) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return first != std::string_view::npos && (bytes[first] == '{' || bytes[first] == '/');
}

std::optional<std::string> outermost_string(std::string_view json, std::string_view key) {
    if (!begins_as_json_object(json)) {
        return std::nullopt;
    }
    for (const auto& [name, value] : outermost_keys(json)) {
        if (name == key && !value.empty()) {
            return value;
        }
    }
    return std::nullopt;
}

std::optional<FileGuess> guess_file(std::string_view bytes) {
    if (bytes.starts_with("%PDF-")) {
        return FileGuess{
            FileGuess::Form::pdf, "a PDF",
            "use gumcert verify for its signatures, gumcert audit for the certificate that is attached to it, "
            "or the .xml that was issued with it"};
    }
    if (bytes.starts_with("PK\x03\x04")) {
        return FileGuess{FileGuess::Form::packed, "a packed file, as workbooks are",
                         "use gumcert audit for a workbook"};
    }
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first != std::string_view::npos && bytes[first] == '<') {
        return FileGuess{FileGuess::Form::xml, "XML",
                         "use gumcert check dcc, import dcc, verify or audit for a digital certificate"};
    }
    if (!begins_as_json_object(bytes)) {
        return std::nullopt;
    }
    const auto keys = outermost_keys(bytes);
    const auto has = [&](std::string_view key) {
        return std::any_of(keys.begin(), keys.end(), [&](const auto& one) { return one.first == key; });
    };
    for (const auto& [name, value] : keys) {
        if (name != "schema") {
            continue;
        }
        for (const KnownSchema& known : k_schemas) {
            if (value.starts_with(known.begin)) {
                return FileGuess{FileGuess::Form::json, known.what, known.action};
            }
        }
    }
    if (has("customer") && has("laboratory") && has("persons")) {
        return FileGuess{FileGuess::Form::json, "certificate data",
                         "name it in a job, as \"certificate\": \"FILE\", and use gumcert run or check for the job"};
    }
    return std::nullopt;
}

}  // namespace gumcert::text
