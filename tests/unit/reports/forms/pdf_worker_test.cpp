#include "reports/forms/pdf_worker.h"
#include "system/no_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "reports/forms/pdf_conformity.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A template of one line: these tests are about the process, not about the certificate.
constexpr const char* k_template = R"(#let view = json("view.json")
#set document(title: "Test", date: datetime(year: 1970, month: 1, day: 1, hour: 0, minute: 0, second: 0))
#set text(font: ("Libertinus Serif",) + view.at("fonts", default: ()), fallback: false, lang: "en")
#if view.at("attach", default: false) { pdf.attach("certificate.xml", relationship: "source", mime-type: "application/xml", description: "DCC") }
#if "read" in view { read(view.read) }
#for page in view.at("identity", default: ()) { for symbol in page.symbol { image(symbol.file, alt: "symbol") } }
#view.text
)";

/// Folders of one test: templates with the worker's script, and the place of its files.
class PdfWorkerTest : public testing::Test {
protected:
    void SetUp() override {
        std::string name = (fs::path(testing::TempDir()) / "pdf-worker-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        fs::create_directories(folder_ / "templates" / "pdf");
        fs::create_directory(folder_ / "work");
        fs::copy_file(assets_.templates / "pdf" / "render.mjs", folder_ / "templates" / "pdf" / "render.mjs");
        put("templates/pdf/certificate.typ", k_template);
        assets_.templates = folder_ / "templates";
        assets_.temporary_folder = folder_ / "work";
    }
    void TearDown() override { fs::remove_all(folder_); }

    void put(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    void expect_nothing_left() const { EXPECT_TRUE(fs::is_empty(folder_ / "work")); }

    RenderAssets assets_ = assets();
    fs::path folder_;
};

std::string view(const std::string& text) {
    return R"({"text": ")" + text + R"("})";
}

TEST_F(PdfWorkerTest, ListsTheFontsThatTemplatesMayUse) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets_);
    std::string last;
    for (const TemplateFont& font : worker.fonts()) {
        if (!font.from.empty() || font.family == last) {
            continue;
        }
        last = font.family;
        const std::string text =
            std::string("#set document(title: \"T\", date: datetime(year: 1970, month: 1, day: 1))\n") +
            "#set text(font: \"" + font.family + "\", fallback: false)\n" +
            (font.family.ends_with("Math") ? "#set page(width: 50mm)\n" : "text");
        put("templates/pdf/certificate.typ", text);
        EXPECT_NO_THROW(static_cast<void>(worker.set(view(""), ""))) << font.family;
    }
    EXPECT_EQ(last, "New Computer Modern Math");
}

TEST_F(PdfWorkerTest, SaysWhichFontsThereAreForOneThatIsNot) {
    SKIP_WITHOUT_PDF();
    put("templates/pdf/certificate.typ", "#set text(font: \"Nowhere Sans\")\ntext");
    PdfWorker worker(assets_);
    try {
        static_cast<void>(worker.set(view(""), ""));
        FAIL() << "a font that is not there was accepted";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-REPORT-0034");
        EXPECT_THAT(error.what(), HasSubstr("nowhere sans; there are DejaVu Sans Mono, Libertinus Serif"));
    }
}

TEST_F(PdfWorkerTest, SetsDocumentsOneAfterTheOtherWithTheSameBytes) {
    SKIP_WITHOUT_PDF();
    {
        PdfWorker worker(assets_);
        const std::string first = worker.set(view("first"), "");
        const std::string second = worker.set(view("second"), "");
        EXPECT_NE(first, second);
        EXPECT_EQ(worker.set(view("first"), ""), first);
        PdfWorker other(assets_);
        EXPECT_EQ(other.set(view("second"), ""), second);
        EXPECT_TRUE(check_pdf(first, "").empty());
        if (const std::string text = pdf_text(second); !text.empty()) {
            EXPECT_THAT(text, HasSubstr("second"));
        }
    }
    expect_nothing_left();
}

TEST_F(PdfWorkerTest, StartsAFreshProcessAfterManyDocuments) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets_);
    const std::string first = worker.set(view("again"), "");
    for (int i = 0; i < 210; ++i) {
        ASSERT_EQ(worker.set(view("again"), ""), first) << i;
    }
}

TEST_F(PdfWorkerTest, AttachesTheFileItIsGiven) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets_);
    const std::string one = worker.set(R"({"text": "x", "attach": true})", "<one/>");
    const std::string two = worker.set(R"({"text": "x", "attach": true})", "<two/>");
    EXPECT_TRUE(check_pdf(one, "<one/>").empty());
    EXPECT_TRUE(check_pdf(two, "<two/>").empty());
    EXPECT_FALSE(check_pdf(two, "<one/>").empty());
    // The file of the document before is gone.
    EXPECT_THROW(static_cast<void>(worker.set(R"({"text": "x", "attach": true})", "")), gum::NoResultError);
}

TEST_F(PdfWorkerTest, WritesTheSymbolOfTheLaboratory) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets_);
    // A PNG of one grey pixel.
    const std::string png =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";
    const auto with_symbol = [&](const std::string& file) {
        return R"({"text": "x", "identity": [{"symbol": [{"file": ")" + file + R"(", "base64": ")" + png + R"("}]}]})";
    };
    EXPECT_THAT(worker.set(with_symbol("symbol.png"), ""), HasSubstr("/Image"));
    EXPECT_THROW(static_cast<void>(worker.set(with_symbol("../symbol.png"), "")), gum::StorageError);
    EXPECT_THROW(static_cast<void>(worker.set(with_symbol("certificate.typ"), "")), gum::StorageError);
}

TEST_F(PdfWorkerTest, ARefusedDocumentDoesNotStopTheNext) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets_);
    const std::string good = worker.set(view("good"), "");
    try {
        static_cast<void>(worker.set(view("校正"), ""));
        FAIL() << "accepted";
    } catch (const gum::NoResultError& e) {
        EXPECT_EQ(e.diagnostics().front().code, "GC-REPORT-0011");
        EXPECT_THAT(e.what(), HasSubstr("校"));
    }
    EXPECT_EQ(worker.set(view("good"), ""), good);
}

TEST_F(PdfWorkerTest, TheTemplateSeesTheFilesOfItsDocumentOnly) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets_);
    for (const char* file : {"/etc/passwd", "../fonts.conf", "../log.txt"}) {
        EXPECT_THROW(static_cast<void>(worker.set(R"({"text": "x", "read": ")" + std::string(file) + R"("})", "")),
                     gum::NoResultError)
            << file;
    }
}

TEST_F(PdfWorkerTest, FurtherFontsAreOpenedWhenAskedFor) {
    SKIP_WITHOUT_PDF();
    const fs::path noto = "/usr/share/fonts/opentype/noto";
    if (!fs::exists(noto / "NotoSerifCJK-Regular.ttc")) {
        GTEST_SKIP() << "fonts-noto-cjk is missing";
    }
    assets_.fonts = {noto};
    PdfWorker worker(assets_);
    const std::string chinese = R"({"text": "校正報告 Certificate", "fonts": ["Noto Serif CJK TC"]})";
    // Typst finds no fonts of the machine by itself.
    EXPECT_THROW(static_cast<void>(worker.set(chinese, "", false)), gum::NoResultError);
    const std::string pdf = worker.set(chinese, "", true);
    EXPECT_TRUE(check_pdf(pdf, "").empty());
    if (const std::string text = pdf_text(pdf); !text.empty()) {
        EXPECT_THAT(text, HasSubstr("校正報告"));
    }
    // Other documents do not change by it.
    PdfWorker plain(assets_);
    EXPECT_EQ(worker.set(view("plain"), "", false), plain.set(view("plain"), "", false));
}

/// Scripts in the place of render.mjs play a process that fails.
TEST_F(PdfWorkerTest, AProcessThatDiesIsReportedAndStartedAgain) {
    SKIP_WITHOUT_PDF();
    put("templates/pdf/render.mjs", "console.error('no library'); process.exit(1);");
    PdfWorker worker(assets_);
    try {
        static_cast<void>(worker.set(view("x"), ""));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_EQ(e.diagnostics().front().code, "GC-REPORT-0010");
        EXPECT_THAT(e.what(), HasSubstr("no library"));
        EXPECT_THAT(e.what(), HasSubstr("scripts/setup"));
    }
    expect_nothing_left();
    fs::remove(folder_ / "templates" / "pdf" / "render.mjs");
    fs::copy_file(assets().templates / "pdf" / "render.mjs", folder_ / "templates" / "pdf" / "render.mjs");
    EXPECT_TRUE(worker.set(view("x"), "").starts_with("%PDF-"));
}

TEST_F(PdfWorkerTest, AProcessThatEndedBetweenDocumentsIsReplaced) {
    SKIP_WITHOUT_PDF();
    // Answers one document and ends, without waiting for the end of its input.
    put("templates/pdf/render.mjs",
        "import fs from 'node:fs';\nconst w = process.argv[3];\nprocess.stdin.once('data', () => {\n"
        "  fs.writeFileSync(w + '/certificate.pdf', '%PDF-1.7 ' + process.pid);\n"
        "  fs.writeSync(1, '{\"status\": \"done\", \"memory\": 1}\\n');\n  process.exit(0);\n});\n");
    PdfWorker worker(assets_);
    const std::string first = worker.set(view("x"), "");
    ::usleep(200'000);
    const std::string second = worker.set(view("x"), "");
    EXPECT_NE(first, second);
}

TEST_F(PdfWorkerTest, AProcessThatTakesTooLongIsStopped) {
    SKIP_WITHOUT_PDF();
    assets_.pdf_time_limit = std::chrono::seconds(1);
    put("templates/pdf/render.mjs", "setInterval(() => {}, 1000);");
    const auto begin = std::chrono::steady_clock::now();
    PdfWorker worker(assets_);
    try {
        static_cast<void>(worker.set(view("x"), ""));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_THAT(e.what(), HasSubstr("not finished after 1 s"));
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
    expect_nothing_left();
}

TEST_F(PdfWorkerTest, AFaultOfTheTemplateIsToldWithItsPlace) {
    SKIP_WITHOUT_PDF();
    PdfWorker worker(assets_);
    const std::pair<const char*, const char*> faults[] = {
        {"#let x = (\n", "certificate.typ:1:10: unclosed delimiter"},
        {"text\n #let = 1\n", "certificate.typ: expected pattern"},
        {"#while true { }\n", "certificate.typ"},
        {"#nothing\n", "unknown variable: nothing"},
        {"#image(\"symbol.png\")\n", "file not found"},
    };
    for (const auto& [text, said] : faults) {
        put("templates/pdf/certificate.typ", text);
        try {
            static_cast<void>(worker.set(view("x"), ""));
            ADD_FAILURE() << "accepted: " << text;
        } catch (const gum::NoResultError& e) {
            EXPECT_EQ(e.diagnostics().front().code, "GC-REPORT-0012");
            EXPECT_THAT(e.what(), HasSubstr(said));
            EXPECT_THAT(e.what(), HasSubstr("correct the template"));
            EXPECT_THAT(e.what(), testing::Not(HasSubstr("fonts")));
        }
    }
    put("templates/pdf/certificate.typ", k_template);
    EXPECT_TRUE(worker.set(view("x"), "").starts_with("%PDF-"));
}

constexpr const char* k_endless = "#for i in range(100000) { for j in range(100000) { let k = i * j } }\n";

TEST_F(PdfWorkerTest, ATemplateWithoutEndIsStopped) {
    SKIP_WITHOUT_PDF();
    assets_.pdf_time_limit = std::chrono::seconds(2);
    put("templates/pdf/certificate.typ", k_endless);
    PdfWorker worker(assets_);
    try {
        static_cast<void>(worker.set(view("x"), ""));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_THAT(e.what(), HasSubstr("not finished after 2 s"));
    }
    expect_nothing_left();
}

TEST_F(PdfWorkerTest, AProcessThatIsKilledAtWorkIsReportedAsSuch) {
    SKIP_WITHOUT_PDF();
    put("templates/pdf/render.mjs", "process.stdin.once('data', () => process.kill(process.pid, 'SIGKILL'));");
    PdfWorker worker(assets_);
    try {
        static_cast<void>(worker.set(view("x"), ""));
        FAIL() << "no message";
    } catch (const gum::StorageError& e) {
        EXPECT_THAT(e.what(), HasSubstr("ended by signal 9"));
        EXPECT_THAT(e.what(), HasSubstr("try again"));
    }
    expect_nothing_left();
}

TEST_F(PdfWorkerTest, ATemplateThatTakesAllMemoryIsEnded) {
    SKIP_WITHOUT_PDF();
    put("templates/pdf/certificate.typ", "#let a = (1,)\n#for i in range(60) { a = a + a }\n");
    RenderAssets narrow = assets_;
    narrow.pdf_memory_limit = std::uint64_t{1} << 30U;
    PdfWorker worker(narrow);
    EXPECT_THROW(static_cast<void>(worker.set(view("x"), "")), gum::StorageError);
    expect_nothing_left();
    // What a page needs fits in.
    put("templates/pdf/certificate.typ", "#set document(title: \"x\")\nshort\n");
    EXPECT_TRUE(worker.set(view("x"), "").starts_with("%PDF-"));
}

TEST_F(PdfWorkerTest, WhatIsMissingIsToldBeforeAPageIsSet) {
    SKIP_WITHOUT_PDF();
    EXPECT_NO_THROW(PdfWorker(assets_).require_ready());
    expect_nothing_left();
    RenderAssets without = assets_;
    without.node_program.clear();
    EXPECT_THROW(PdfWorker(without).require_ready(), gum::StorageError);
    without = assets_;
    without.temporary_folder = folder_ / "nowhere";
    EXPECT_THROW(PdfWorker(without).require_ready(), gum::StorageError);
    fs::remove(folder_ / "templates/pdf/certificate.typ");
    EXPECT_THROW(PdfWorker(assets_).require_ready(), gum::StorageError);
}

TEST_F(PdfWorkerTest, NothingStaysBehindWhenTheProgramIsKilled) {
    SKIP_WITHOUT_PDF();
    put("templates/pdf/certificate.typ", k_endless);
    const pid_t program = ::fork();
    ASSERT_GE(program, 0);
    if (program == 0) {
        try {
            PdfWorker worker(assets_);
            static_cast<void>(worker.set(view("the customer's data"), ""));
        } catch (...) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    const auto wait_for = [&](auto condition) {
        for (int i = 0; i < 300 && !condition(); ++i) {
            ::usleep(100'000);
        }
        return condition();
    };
    const auto at_work = [&] {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "work")) {
            if (fs::exists(entry.path() / "document" / "certificate.typ")) {
                return true;
            }
        }
        return false;
    };
    EXPECT_TRUE(wait_for(at_work));
    ::kill(program, SIGKILL);
    ::waitpid(program, nullptr, 0);
    EXPECT_TRUE(wait_for([&] { return fs::is_empty(folder_ / "work"); }));
}

TEST_F(PdfWorkerTest, WhatIsMissingIsNamed) {
    SKIP_WITHOUT_PDF();
    const auto told = [&](const RenderAssets& with) {
        PdfWorker worker(with);
        try {
            static_cast<void>(worker.set(view("x"), ""));
        } catch (const gum::StorageError& e) {
            return std::string(e.what());
        }
        return std::string("set");
    };
    RenderAssets without = assets_;
    without.node_program.clear();
    EXPECT_THAT(told(without), testing::AllOf(HasSubstr("node"), HasSubstr("not found"), HasSubstr("scripts/setup")));
    without = assets_;
    without.node_modules = folder_ / "nowhere";
    EXPECT_THAT(told(without), testing::AllOf(HasSubstr("typst"), HasSubstr("not found"), HasSubstr("scripts/setup")));
    without = assets_;
    without.temporary_folder = folder_ / "nowhere";
    EXPECT_THAT(told(without), testing::AllOf(HasSubstr("nowhere"), HasSubstr("cannot make"), HasSubstr("TMPDIR")));
    without = assets_;
    without.node_program = folder_ / "templates" / "pdf" / "render.mjs";  // no program
    EXPECT_THAT(told(without), HasSubstr("cannot be started"));
    expect_nothing_left();
}

TEST_F(PdfWorkerTest, ItReachesNoNetwork) {
    SKIP_WITHOUT_PDF();
    if (!system::without_network([] {})) {
        GTEST_SKIP() << "the kernel does not allow it here";
    }
    put("templates/pdf/render.mjs",
        "import net from 'node:net';\n"
        "process.stdin.once('data', () => net.connect(9, '127.0.0.1').on('error', (e) =>\n"
        "  console.log(JSON.stringify({status: 'template', messages: ['tried: ' + e.code]}))));\n");
    PdfWorker worker(assets_);
    try {
        static_cast<void>(worker.set(view("x"), ""));
        ADD_FAILURE() << "nothing was tried";
    } catch (const gum::NoResultError& e) {
        EXPECT_THAT(e.what(), HasSubstr("tried: EACCES"));
    }
}

TEST_F(PdfWorkerTest, AnswersThatAreNoneAreRefused) {
    SKIP_WITHOUT_PDF();
    for (const char* answer : {"nonsense", "[]", "{}", "{\"status\": \"done\"}", "{\"status\": \"failed\"}",
                               "{\"status\": \"failed\", \"messages\": [\"no room\"], \"code\": \"ENOSPC\"}"}) {
        put("templates/pdf/render.mjs",
            "process.stdin.once('data', () => console.log('" + std::string(answer) + "'));");
        PdfWorker worker(assets_);
        EXPECT_THROW(static_cast<void>(worker.set(view("x"), "")), gum::StorageError) << answer;
    }
    expect_nothing_left();
}

}  // namespace
}  // namespace gumcert::reports
