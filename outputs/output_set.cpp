#include "outputs/output_set.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "encoding/file_bytes.h"
#include "encoding/sha2.h"
#include "json/strict_parser.h"
#include "system/folder_lock.h"
#include "system/temporary.h"

namespace gumcert::outputs {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_set_schema = "gumcert/set/1";
constexpr std::size_t k_largest_manifest = std::size_t{16} << 20U;
constexpr std::size_t k_largest_member = std::size_t{1} << 30U;

constexpr const char* k_run_again = "run the command again that wrote them, or take all files from one copy";

fs::path or_here(const fs::path& folder) {
    return folder.empty() ? fs::path(".") : folder;
}

bool is_file_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos;
}

std::string text_at(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<SetFile> set_file_from(const nlohmann::json& object) {
    if (!object.is_object()) {
        return std::nullopt;
    }
    SetFile file{.name = text_at(object, "name"), .sha256 = text_at(object, "sha256"), .part = text_at(object, "part")};
    const bool good = is_file_name(file.name) && encoding::is_sha256(file.sha256) &&
                      object.contains("part") == !file.part.empty() &&
                      (file.part.empty() || system::TemporaryFile::is_name(file.part)) &&
                      object.size() == (file.part.empty() ? 2U : 3U);
    return good ? std::optional(std::move(file)) : std::nullopt;
}

void sort_set(FileSet& set) {
    std::sort(set.begin(), set.end(), [](const SetFile& a, const SetFile& b) { return a.name < b.name; });
}

gum::Diagnostic unfinished(const fs::path& folder, gum::Severity severity) {
    return {.code = "GC-STORE-0013",
            .where = (folder / k_set_journal).string(),
            .what = "files of this folder are being written, or the program was interrupted while it put them in place",
            .rule = "files that belong together are all old or all new",
            .action =
                "wait for the other command; where there is none, give the command again that wrote them: it "
                "completes the set first",
            .severity = severity};
}

std::string damage(const FileSet& set, const SetFile& file, const std::string& failure) {
    std::string others;
    for (const SetFile& other : set) {
        if (other.name != file.name) {
            others += (others.empty() ? "" : ", ") + other.name;
        }
    }
    return failure + (others.empty() ? "" : "; written together with " + others);
}

}  // namespace

std::string to_json(const SetManifest& manifest) {
    nlohmann::json sets = nlohmann::json::array();
    for (const FileSet& set : manifest.sets) {
        nlohmann::json files = nlohmann::json::array();
        for (const SetFile& file : set) {
            nlohmann::json object = {{"name", file.name}, {"sha256", file.sha256}};
            if (!file.part.empty()) {
                object["part"] = file.part;
            }
            files.push_back(std::move(object));
        }
        sets.push_back({{"files", std::move(files)}});
    }
    const nlohmann::json document = {{"schema", k_set_schema}, {"sets", std::move(sets)}};
    return document.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::optional<SetManifest> set_manifest_from_json(std::string_view text) {
    const std::optional<nlohmann::json> document = json::parse_faultless(text, {.depth = 8, .values = 1'000'000});
    if (!document || !document->is_object() || document->size() != 2 || text_at(*document, "schema") != k_set_schema ||
        !document->contains("sets") || !(*document)["sets"].is_array()) {
        return std::nullopt;
    }
    SetManifest manifest;
    std::set<std::string> names;
    for (const nlohmann::json& one : (*document)["sets"]) {
        if (!one.is_object() || one.size() != 1 || !one.contains("files") || !one["files"].is_array() ||
            one["files"].empty()) {
            return std::nullopt;
        }
        FileSet set;
        for (const nlohmann::json& object : one["files"]) {
            std::optional<SetFile> file = set_file_from(object);
            if (!file || !names.insert(file->name).second) {
                return std::nullopt;
            }
            set.push_back(std::move(*file));
        }
        manifest.sets.push_back(std::move(set));
    }
    return manifest;
}

SetManifest with_written(SetManifest manifest, FileSet written) {
    if (written.size() == 1) {
        for (FileSet& set : manifest.sets) {
            for (SetFile& file : set) {
                if (file.name == written.front().name) {
                    file = std::move(written.front());
                    return manifest;
                }
            }
        }
    }
    const auto had_one = [&](const FileSet& set) {
        return std::any_of(set.begin(), set.end(), [&](const SetFile& file) {
            return std::any_of(written.begin(), written.end(),
                               [&](const SetFile& now) { return now.name == file.name; });
        });
    };
    std::erase_if(manifest.sets, had_one);
    sort_set(written);
    manifest.sets.push_back(std::move(written));
    std::sort(manifest.sets.begin(), manifest.sets.end(),
              [](const FileSet& a, const FileSet& b) { return a.front().name < b.front().name; });
    return manifest;
}

bool lists(const SetManifest& manifest, std::string_view name) {
    return std::any_of(manifest.sets.begin(), manifest.sets.end(), [&](const FileSet& set) {
        return std::any_of(set.begin(), set.end(), [&](const SetFile& file) { return file.name == name; });
    });
}

SetManifest manifest_in(const fs::path& folder) {
    std::error_code error;
    const fs::path file = folder / k_set_manifest;
    if (fs::symlink_status(file, error).type() == fs::file_type::not_found) {
        return {};
    }
    const encoding::FileBytes read = encoding::read_regular_file(file, k_largest_manifest);
    std::optional<SetManifest> manifest =
        read.failure.empty() && !read.too_long ? set_manifest_from_json(read.bytes) : std::nullopt;
    if (!manifest) {
        throw gum::StorageError(gum::Diagnostic{
            .code = "GC-STORE-0015",
            .where = file.string(),
            .what = read.failure.empty() ? "is no list of files that were written together" : read.failure,
            .rule = "gumcert writes it beside files that belong together, with their SHA-256",
            .action = "remove it, and run the command again that wrote the files"});
    }
    return std::move(*manifest);
}

std::vector<gum::Diagnostic> check_sets(const fs::path& asked) {
    const fs::path folder = or_here(asked);
    constexpr std::chrono::seconds k_patience{30};  // of a writer that is at work
    const system::FolderLock lock(folder, true, k_patience);
    std::error_code error;
    if (fs::symlink_status(folder / k_set_journal, error).type() != fs::file_type::not_found) {
        return {unfinished(folder, gum::Severity::error)};
    }
    std::vector<gum::Diagnostic> findings;
    SetManifest manifest;
    try {
        manifest = manifest_in(folder);
    } catch (const gum::StorageError& damaged) {
        return damaged.diagnostics();
    }
    if (manifest.sets.empty()) {
        return {{.code = "GC-STORE-0015",
                 .where = (folder / k_set_manifest).string(),
                 .what = "there is none, so nobody can tell whether the files of this folder belong together",
                 .rule = "gumcert writes it beside files that belong together, with their SHA-256",
                 .action = "run the command again that wrote them"}};
    }
    for (const FileSet& set : manifest.sets) {
        for (const SetFile& file : set) {
            const encoding::FileBytes read = encoding::read_regular_file(folder / file.name, k_largest_member);
            const std::string failure = !read.failure.empty()                         ? read.failure
                                        : read.too_long                               ? "it is larger than 1 GiB"
                                        : encoding::sha256(read.bytes) != file.sha256 ? "has other bytes than those "
                                                                                        "that were written"
                                                                                      : "";
            if (!failure.empty()) {
                findings.push_back({.code = "GC-STORE-0014",
                                    .where = (folder / file.name).string(),
                                    .what = damage(set, file, failure),
                                    .rule = "the files of a set have the SHA-256 that its manifest states",
                                    .action = k_run_again});
            }
        }
    }
    return findings;
}

std::vector<gum::Diagnostic> doubts_about_set(const fs::path& file, std::string_view bytes) {
    const fs::path folder = or_here(file.parent_path());
    const std::string name = file.filename().string();
    const encoding::FileBytes journal = encoding::read_regular_file(folder / k_set_journal, k_largest_manifest);
    if (journal.failure.empty()) {
        const std::optional<SetManifest> set = set_manifest_from_json(journal.bytes);
        if (!set || lists(*set, name)) {
            return {unfinished(folder, gum::Severity::warning)};
        }
    }
    const encoding::FileBytes read = encoding::read_regular_file(folder / k_set_manifest, k_largest_manifest);
    const std::optional<SetManifest> manifest =
        read.failure.empty() ? set_manifest_from_json(read.bytes) : std::nullopt;
    if (!manifest || !lists(*manifest, name)) {
        return {};  // a manifest that is damaged is reported by check_sets()
    }
    for (const FileSet& set : manifest->sets) {
        for (const SetFile& member : set) {
            if (member.name == name && encoding::sha256(bytes) != member.sha256) {
                return {{.code = "GC-STORE-0014",
                         .where = file.string(),
                         .what = damage(set, member, "has other bytes than those that were written"),
                         .rule = "the files of a set have the SHA-256 that its manifest states",
                         .action = "gumcert check " + folder.string() + " looks at all of them",
                         .severity = gum::Severity::warning}};
            }
        }
    }
    return {};
}

}  // namespace gumcert::outputs
