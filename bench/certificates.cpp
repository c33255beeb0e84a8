// Time and memory of a batch of certificates from one record:
//
//   certificates RECORD SHARE NODE_MODULES NODE COUNT [SIGNER]
//
// makes COUNT certificates that differ in their title, each as HTML, digital certificate (DCC) and PDF with the digital
// certificate attached, and prints the table of medians, largest times and memory. SHARE is the folder with templates/;
// SIGNER a signer description (docs/signing.md): with it, digital certificate and PDF are signed as well. The program
// ends with 1 when a PDF breaks a PDF/A rule; it is checked again after signing.
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "reports/dcc/dcc_document.h"
#include "reports/forms/pdf_conformity.h"
#include "reports/forms/pdf_worker.h"
#include "reports/forms/render.h"
#include "signing/signer.h"

namespace {

using namespace gumcert;

std::string whole_file(const char* name) {
    std::ifstream stream(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Times of one step, in milliseconds.
class Times {
public:
    template <class Step>
    auto time(Step step) {
        const auto begin = std::chrono::steady_clock::now();
        auto made = step();
        all_.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
        return made;
    }
    /// The first document starts the process and opens the fonts: it is left out, so that the rest is warm.
    [[nodiscard]] std::vector<double> warm() const {
        std::vector<double> sorted(all_.begin() + 1, all_.end());
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    }
    [[nodiscard]] double first() const { return all_.front(); }

private:
    std::vector<double> all_;
};

void print_row(const char* work, const Times& times, const char* target) {
    const std::vector<double> sorted = times.warm();
    std::cout << "| " << work << " | " << times.first() << " ms | " << sorted[sorted.size() / 2] << " ms | "
              << sorted[sorted.size() * 95 / 100] << " ms | " << sorted.back() << " ms | " << target << " |\n";
}

double peak_mebibytes(int who) {
    rusage usage{};
    getrusage(who, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

int run(int argc, char** argv) {
    std::size_t count = 0;
    const std::string number = argc >= 6 ? argv[5] : "";
    std::from_chars(number.data(), number.data() + number.size(), count);
    if (argc < 6 || argc > 7 || count < 20) {
        std::cerr << "usage: certificates RECORD SHARE NODE_MODULES NODE COUNT [SIGNER]   with COUNT from 20\n";
        return 2;
    }
    reports::EvaluationRecord record = reports::record_from_json(whole_file(argv[1]), argv[1]);
    const std::string title = record.title;
    reports::RenderAssets assets;
    assets.templates = std::filesystem::path(argv[2]) / "templates";
    assets.node_modules = argv[3];
    assets.node_program = argv[4];
    const std::unique_ptr<signing::Signer> signer = argc == 7 ? signing::signer_from_description(argv[6]) : nullptr;
    const std::int64_t signing_time =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();

    reports::PdfWorker worker(assets);
    Times html_and_dcc;
    Times dcc_signature;
    Times pdf_setting;
    Times pdf_signature;
    Times pdf_checks;
    std::size_t bytes = 0;
    double early_peak = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        record.title = title + ", " + std::to_string(i + 1);
        std::string dcc = html_and_dcc.time([&] {
            bytes += reports::render_html(record, assets).size();
            return reports::render_dcc(record, assets);
        });
        if (signer) {
            dcc = dcc_signature.time([&] { return signing::sign_dcc(dcc, *signer, signing_time); });
        }
        std::string pdf = pdf_setting.time([&] { return reports::render_pdf(record, assets, dcc, &worker); });
        if (signer) {
            pdf = pdf_signature.time([&] { return signing::sign_pdf(pdf, *signer, signing_time); });
        }
        const std::vector<gum::Diagnostic> findings = pdf_checks.time([&] { return reports::check_pdf(pdf, dcc); });
        if (!findings.empty()) {
            std::cerr << gum::message(findings.front()) << '\n';
            return EXIT_FAILURE;
        }
        bytes += pdf.size();
        if (i + 1 == count / 10) {
            early_peak = peak_mebibytes(RUSAGE_SELF);
        }
    }

    std::cout << std::fixed << std::setprecision(1)
              << "| work, one certificate | first | median | 95 % below | largest | target |\n"
              << "|---|---|---|---|---|---|\n";
    print_row("HTML and DCC", html_and_dcc, "20 ms");
    print_row("PDF/A-3a with the DCC inside, checked", pdf_setting, "60 ms");
    print_row("of which the checks", pdf_checks, "–");
    if (signer) {
        print_row("signature of the DCC", dcc_signature, "–");
        print_row("signature of the PDF", pdf_signature, "–");
    }
    std::cout << "\n| certificates | largest memory of the program | of the process that sets PDF |\n|---|---|---|\n"
              << "| after " << count / 10 << " | " << early_peak << " MiB | – |\n"
              << "| after " << count << " | " << peak_mebibytes(RUSAGE_SELF) << " MiB | "
              << peak_mebibytes(RUSAGE_CHILDREN) << " MiB |\n\n"
              << count << " certificates, " << bytes / count / 1000 << " kB of HTML and PDF each.\n";
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& failure) {
        std::cerr << failure.what() << '\n';
        return EXIT_FAILURE;
    }
}
