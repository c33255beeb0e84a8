#include "reports/forms/template_digest.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "encoding/sha2.h"

namespace gumcert::reports {
namespace {

namespace fs = std::filesystem;

void put_file(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

TEST(TemplateDigest, IsOfTheFilesThatDocumentsAreMadeWith) {
    const fs::path folder = fs::path(testing::TempDir()) / "template-digest";
    fs::remove_all(folder);
    put_file(folder / "certificate.css", "css");
    put_file(folder / "pdf" / "certificate.typ", "typ");
    const std::string lines =
        encoding::sha256("css") + "  certificate.css\n" + encoding::sha256("typ") + "  pdf/certificate.typ\n";
    EXPECT_EQ(template_digest(folder), encoding::sha256(lines));

    put_file(folder / "messages.json", "no part of a document");
    put_file(folder / "profiles" / "own.json", "in the record");
    EXPECT_EQ(template_digest(folder), encoding::sha256(lines));

    std::string last = template_digest(folder);
    for (const char* name : {"logo.png", "pdf/fonts/own.otf", "wording/en.own.json", "pdf/certificate.typ"}) {
        put_file(folder / name, "changed");
        EXPECT_NE(template_digest(folder), last) << name;
        last = template_digest(folder);
    }
    fs::remove_all(folder);
}

}  // namespace
}  // namespace gumcert::reports
