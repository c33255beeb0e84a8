#pragma once

#include "reports/forms/render.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

namespace gumcert::reports {

/// A program on the PATH of the test, or an empty path.
inline std::filesystem::path program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (std::filesystem::is_regular_file(std::filesystem::path(folder) / name)) {
            return std::filesystem::path(folder) / name;
        }
    }
    return {};
}

/// Those of the tree; one program of tests reads each wording once.
inline RenderAssets assets() {
    static const RenderAssets of_the_tree = [] {
        RenderAssets a;
        a.templates = std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates";
        a.node_program = program("node");
        a.node_modules = std::filesystem::path(GUMCERT_SOURCE_DIR) / "node_modules";
        a.temporary_folder = ::testing::TempDir();
        return a;
    }();
    return of_the_tree;
}

inline bool pdf_is_possible() {
    return !assets().node_program.empty() &&
           std::filesystem::is_directory(assets().node_modules / "@myriaddreamin" / "typst-ts-node-compiler");
}

#define SKIP_WITHOUT_PDF()                                                                         \
    if (!pdf_is_possible()) {                                                                      \
        GTEST_SKIP() << "node or node_modules is missing: run npm ci in the folder of the source"; \
    }

/// Blanks of every kind become one blank.
inline std::string squeezed(std::string text) {
    for (std::size_t at = text.find("\u00A0"); at != std::string::npos; at = text.find("\u00A0", at)) {
        text.replace(at, 2, " ");
    }
    std::istringstream words(text);
    std::string out = " ";
    for (std::string word; words >> word;) {
        out += word + " ";
    }
    return out;
}

/// HTML without tags and styles. What is drawn in another style inside of a word takes no blank.
inline std::string html_text(const std::string& html) {
    std::string out;
    bool inside = false;
    const std::string body = html.substr(html.find("<body>"));
    const auto is_inside_a_word = [&](std::size_t at) {
        for (const char* tag : {"<i>", "</i>", "<sub>", "</sub>", "<span class=\"g\">"}) {
            if (body.compare(at, std::string(tag).size(), tag) == 0) {
                return true;
            }
        }
        return false;
    };
    bool in_group = false;
    for (std::size_t at = 0; at < body.size(); ++at) {
        const char c = body[at];
        if (c == '<') {
            inside = true;
            const bool ends_group = in_group && body.compare(at, 7, "</span>") == 0;
            out += is_inside_a_word(at) || ends_group ? "" : " ";
            in_group = body.compare(at, 16, "<span class=\"g\">") == 0 || (in_group && !ends_group);
        } else if (c == '>') {
            inside = false;
        } else if (!inside) {
            out += c;
        }
    }
    return squeezed(out);
}

/// Text of a PDF by pdftotext, or nothing when that program is missing.
inline std::string pdf_text(const std::string& pdf) {
    const std::filesystem::path reader = program("pdftotext");
    if (reader.empty()) {
        return "";
    }
    const std::filesystem::path file =
        std::filesystem::path(::testing::TempDir()) / ("gumcert-render-test-" + std::to_string(getpid()) + ".pdf");
    std::ofstream(file, std::ios::binary) << pdf;
    const std::string command = reader.string() + " -layout '" + file.string() + "' -";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    std::array<char, 4096> buffer{};
    for (std::size_t n = 0; pipe != nullptr && (n = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0;) {
        text.append(buffer.data(), n);
    }
    std::filesystem::remove(file);
    return squeezed(text);
}

}  // namespace gumcert::reports
