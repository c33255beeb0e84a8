#include "evaluation/method_library.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/input_text.h"

namespace gumcert::evaluation {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

[[noreturn]] void refuse_damaged(const fs::path& file, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{.code = "GC-STORE-0012",
                                            .where = file.string(),
                                            .what = what,
                                            .rule = "the methods of gumcert init are listed with title, folder and job",
                                            .action = "Install the program again."});
}

std::string text_of(const ordered_json& object, const char* key, const fs::path& file) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) {
        refuse_damaged(file, std::string("a method without ") + key);
    }
    return found->get<std::string>();
}

/// The files of a folder of examples, without what was written beside them.
std::vector<std::string> files_in(const fs::path& folder, const std::string& job) {
    std::vector<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (entry.is_regular_file(error) && name != job && name != "README.md" && !name.ends_with("-record.json")) {
            names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    names.insert(names.begin(), job);
    return names;
}

}  // namespace

std::vector<Method> method_library(const fs::path& examples) {
    const fs::path file = examples / "methods.json";
    const ordered_json document = ordered_json::parse(evaluation::read_file(file), nullptr, false);
    if (!document.is_object()) {
        refuse_damaged(file, "not the list of methods");
    }
    std::vector<Method> methods;
    for (const auto& [name, stated] : document.items()) {
        if (!stated.is_object()) {
            refuse_damaged(file, "a method without title, folder and job");
        }
        Method method{.name = name,
                      .title = text_of(stated, "title", file),
                      .folder = examples / text_of(stated, "folder", file),
                      .job = text_of(stated, "job", file),
                      .files = {}};
        if (const auto files = stated.find("files"); files != stated.end() && files->is_array()) {
            for (const ordered_json& one : *files) {
                method.files.push_back(one.is_string() ? one.get<std::string>() : "");
            }
        } else {
            method.files = files_in(method.folder, method.job);
        }
        methods.push_back(std::move(method));
    }
    return methods;
}

std::string nearest_method(const std::vector<Method>& methods, const std::string& word) {
    std::vector<std::string_view> names;
    for (const Method& method : methods) {
        names.emplace_back(method.name);
    }
    return std::string(jobs::nearest_word(word, names).value_or(""));
}

std::vector<fs::path> begin_with(const Method& method, const fs::path& folder) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder, error)) &&
        (!fs::is_directory(folder, error) || !fs::is_empty(folder, error))) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-STORE-0007",
                            .where = folder.string(),
                            .what = fs::is_directory(folder, error) ? "there are files in this folder"
                                                                    : "there is something else of this name",
                            .rule = "a method begins in a folder of its own, and nothing is overwritten",
                            .action = "Name a new folder: gumcert init " + method.name + " FOLDER"});
    }
    std::vector<outputs::OutputFile> files;
    std::vector<fs::path> written;
    for (const std::string& name : method.files) {
        files.push_back({.path = folder / name, .bytes = evaluation::read_file(method.folder / name)});
        written.push_back(folder / name);
    }
    outputs::write_files(files, {}, {}, false);
    return written;
}

}  // namespace gumcert::evaluation
