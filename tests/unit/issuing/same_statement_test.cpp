// A law over generated budgets: every form of a document states the result that the record reports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "evaluation/evaluate_job.h"
#include "issuing/issue_documents.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::issuing {
namespace {

using reports::Result;

constexpr int k_jobs = 7;
constexpr int k_points = 7;

std::string file(const std::string& name) {
    std::ifstream in(std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/certificate" / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A table of points of one model, at some of which the law of propagation holds and at others not: y of any size, U
/// from far below to far above it, derivatives that vanish, skewness.
std::map<std::string, std::string> random_job(std::mt19937_64& random, bool certified) {
    static constexpr std::array k_models{"y = a*b",        "y = a + b",      "y = a^2 + b",   "y = abs(a - b)",
                                         "y = a/(b + 10)", "y = exp(a) + b", "y = max(a, b)", "y = sqrt(a^2 + b^2)"};
    static constexpr std::array k_coverages{"as_validated", "as_validated", "law_of_propagation", "monte_carlo"};
    const auto one_of = [&](const auto& all) {
        return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random)];
    };
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto spread = [&] { return std::pow(10.0, -2.5 + 3.0 * unit(random)); };
    std::ostringstream points;
    points << "point,a,a.u,b,b.u\n";
    for (int i = 0; i < k_points; ++i) {
        const bool at_zero = unit(random) < 0.3;
        const double a = at_zero ? 0.0 : -2.0 + 4.0 * unit(random);
        const double b = at_zero && unit(random) < 0.5 ? 0.0 : -2.0 + 4.0 * unit(random);
        points << "P" << i + 1 << "," << a << "," << spread() << "," << b << "," << spread() << "\n";
    }
    nlohmann::json job{
        {"schema", "gumcert/job/1"},
        {"kind", "budget"},
        {"title", "generated"},
        {"model", {one_of(k_models)}},
        {"inputs", {{"a", {{"between_points", "independent"}}}, {"b", {{"between_points", "independent"}}}}},
        {"coverage", one_of(k_coverages)},
        {"points", {{"file", "points.csv"}}}};
    std::map<std::string, std::string> files{{"points.csv", points.str()}};
    if (certified) {
        nlohmann::json data = nlohmann::json::parse(file("end_gauge_certificate.json"));
        data.erase("specifications");
        files["certificate.json"] = data.dump();
        files["symbol.png"] = file("symbol.png");
        job["certificate"] = "certificate.json";
    }
    files["job.json"] = job.dump();
    return files;
}

/// A number as pages print it.
std::string on_a_page(std::string text) {
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

/// The texts of one result in the order in which a row of a table has them.
std::vector<std::string> stated(const Result& result) {
    const reports::ReportedResult& r = result.reported;
    std::vector<std::string> texts{on_a_page(r.printed.value)};
    for (const std::string& text : {r.printed.U, r.printed_low, r.printed_high}) {
        if (!text.empty()) {
            texts.push_back(on_a_page(text));
        }
    }
    return texts;
}

/// Whether the texts stand in a document as words one after the other, with no more than some words between them.
bool stands(const std::string& document, const std::vector<std::string>& texts) {
    for (std::size_t at = document.find(' ' + texts[0]); at != std::string::npos;
         at = document.find(' ' + texts[0], at + 1)) {
        std::size_t next = at + texts[0].size() + 1;
        const bool all = std::all_of(texts.begin() + 1, texts.end(), [&](const std::string& text) {
            const std::size_t found = document.find(text, next);
            next = found == std::string::npos ? found : found + text.size();
            return found != std::string::npos && found < at + 120;
        });
        if (all) {
            return true;
        }
    }
    return false;
}

/// The numbers of the lists of one name in a digital certificate, NaN where no list has one for a row: a list for each
/// kind of statement has the rows of its own. None without such a list.
std::vector<double> list_of(const std::string& dcc, const std::string& name) {
    std::vector<double> numbers;
    for (std::size_t from = dcc.find("<si:" + name + ">"); from != std::string::npos;
         from = dcc.find("<si:" + name + ">", from + 1)) {
        const std::size_t start = from + name.size() + 5;
        std::istringstream words(dcc.substr(start, dcc.find('<', start) - start));
        std::vector<double> list;
        for (std::string word; words >> word;) {
            list.push_back(std::stod(word));
        }
        if (list.size() == 1) {
            list.resize(k_points, list.front());  // one for all
        }
        numbers.resize(list.size(), std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i < list.size(); ++i) {
            numbers[i] = std::isfinite(numbers[i]) ? numbers[i] : list[i];
        }
    }
    return numbers;
}

void expect_in_digital_certificate(const std::string& dcc, const std::vector<Result>& results) {
    const std::vector<double> values = list_of(dcc, "valueXMLList");
    const std::vector<double> U = list_of(dcc, "valueExpandedMUXMLList");
    const std::vector<double> low = list_of(dcc, "intervalMinXMLList");
    const std::vector<double> high = list_of(dcc, "intervalMaxXMLList");
    ASSERT_EQ(values.size(), results.size());
    for (std::size_t i = 0; i < results.size(); ++i) {
        const reports::ReportedResult& r = results[i].reported;
        SCOPED_TRACE(results[i].name);
        EXPECT_EQ(values[i], std::stod(r.printed.value));
        EXPECT_EQ(!U.empty() && std::isfinite(U[i]), !r.printed.U.empty());
        EXPECT_EQ(!low.empty() && std::isfinite(low[i]), !r.printed_low.empty());
        if (!r.printed.U.empty()) {
            EXPECT_EQ(U.at(i), std::stod(r.printed.U));
        }
        if (!r.printed_low.empty()) {
            EXPECT_EQ(low.at(i), std::stod(r.printed_low));
            EXPECT_EQ(high.at(i), std::stod(r.printed_high));
        }
    }
}

class SameStatement : public testing::TestWithParam<bool> {};

TEST_P(SameStatement, StandsInEveryForm) {
    std::mt19937_64 random(GetParam() ? 20261122 : 4711);
    reports::PdfWorker worker(reports::assets());
    const IssueOptions options{.assets = reports::assets(), .worker = &worker};
    const bool with_pdf = reports::pdf_is_possible() && !reports::program("pdftotext").empty();
    int intervals = 0;
    int symmetric = 0;
    for (int job = 0; job < k_jobs; ++job) {
        const std::map<std::string, std::string> files = random_job(random, GetParam());
        SCOPED_TRACE(files.at("job.json") + "\n" + files.at("points.csv"));
        std::optional<evaluation::Evaluation> evaluation;
        try {
            evaluation = evaluation::evaluate_job(jobs::MemoryFileSource(files), "job.json",
                                                  evaluation::CovarianceFile::none, 1, options.assets.templates);
        } catch (const gum::NoResultError& none) {
            continue;  // a derivative that does not exist, and the law of propagation asked for
        }
        const reports::EvaluationRecord& record = evaluation->record;
        std::map<std::string, std::string> forms{{"HTML", reports::html_text(issue_document(record, "html", options))},
                                                 {"text", reports::squeezed(issue_document(record, "text", options))}};
        if (with_pdf) {
            forms["PDF"] = reports::pdf_text(issue_document(record, "pdf", options));
        }
        for (const Result& result : record.results) {
            const std::vector<std::string> texts = stated(result);
            intervals += !result.reported.printed_low.empty() ? 1 : 0;
            symmetric += !result.reported.printed.U.empty() ? 1 : 0;
            for (const auto& [form, document] : forms) {
                EXPECT_TRUE(stands(document, texts))
                    << form << " " << result.name << ": " << testing::PrintToString(texts);
            }
        }
        expect_in_digital_certificate(issue_document(record, "dcc", options), record.results);
    }
    EXPECT_GT(intervals, k_jobs);
    EXPECT_GT(symmetric, k_jobs);
}

INSTANTIATE_TEST_SUITE_P(Budgets, SameStatement, testing::Values(false, true),
                         [](const auto& suite) { return suite.param ? "AsACertificate" : "AsASpecimen"; });

}  // namespace
}  // namespace gumcert::issuing
