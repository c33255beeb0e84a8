#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificate/statement_of_uncertainty.h"
#include "evaluation/evaluate_job.h"
#include "issuing/issue_documents.h"
#include "reports/forms/pdf_page_texts.h"
#include "tests/unit/reports/document_text.h"

// The law of numbers that a laboratory writes down: each document shows their digits. Read back, the printed text is what
// was written, and what is not 0 is not printed as 0 (ISO/IEC 17025:2017, 7.8.1.2 and 7.8.2.1 m).

namespace gumcert::issuing {
namespace {

using certificate::PointColumn;
using reports::EvaluationRecord;

constexpr int k_largest_exponent = 30;

/// Decimals of every size as people and programs write them.
class Writer {
public:
    /// \param exponent  of its first digit
    std::string number(int exponent) {
        std::string digits = std::to_string(1 + pick(9));
        for (int more = pick(5); more > 0; --more) {
            digits += std::to_string(pick(10));
        }
        const std::string sign = pick(3) == 0 ? "-" : "";
        constexpr int k_plain = 8;
        if (std::abs(exponent) <= k_plain && pick(2) == 0) {
            return sign + plain(digits, exponent);
        }
        // 1.25e-12, 12.5E-13, 0.00125e-9
        const int inside = std::min(pick(5) - 2, static_cast<int>(digits.size()) - 1);
        const int power = exponent - inside;
        return sign + plain(digits, inside) + (pick(2) == 0 ? "e" : "E") + (power > 0 && pick(2) == 0 ? "+" : "") +
               std::to_string(power);
    }

private:
    std::mt19937 random_{20261128};

    int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

    static std::string plain(std::string digits, int exponent) {
        if (exponent < 0) {
            return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
        }
        const auto whole = static_cast<std::size_t>(exponent + 1);
        if (digits.size() < whole) {
            return digits + std::string(whole - digits.size(), '0');
        }
        return digits.size() == whole ? digits : digits.insert(whole, ".");
    }
};

/// What was written of one point.
struct Written {
    std::string reference, noted;
    std::array<std::string, 3> readings;
};

std::vector<Written> written_points() {
    Writer write;
    std::vector<Written> all;
    for (int exponent = -k_largest_exponent; exponent <= k_largest_exponent; ++exponent) {
        Written point{.reference = write.number(exponent), .noted = write.number(-exponent), .readings = {}};
        const std::string power = "e" + std::to_string(exponent);
        point.readings = {"1.2" + power, exponent % 2 == 0 ? "1.4" + power : "1.40" + power, "1.7" + power};
        all.push_back(std::move(point));
    }
    return all;
}

const std::string k_certificate = R"({"status": "not_accredited", "number": "N-1", "languages": ["en"],
    "laboratory": {"name": "L", "address": {"city": "C", "country": "DE"}}, "customer": {"name": "K"},
    "annexes": "none",
    "item": {"description": "meter", "serial_number": "1"}, "method": {"identification": "V-1"}})";

std::string job_of_points(const std::string& points) {
    return R"({"schema": "gumcert/job/1", "kind": "budget", "model": ["E = x - r", "S = s - t"], "inputs": {
        "r": {"unit": "V", "constant": true, "role": "reference"}, "x": {"unit": "V", "role": "indication"},
        "s": {"unit": "V", "constant": true, "value": -2.50e-9, "role": "setting"},
        "t": {"unit": "V", "constant": true, "value": 3e20, "role": "setting", "description": "second setting"}},
        "outputs": {"E": {"unit": "V", "role": "error"}, "S": {"unit": "V", "role": "deviation"}},)" +
           points + R"(, "certificate": "certificate.json"})";
}

EvaluationRecord record_of(const std::map<std::string, std::string>& files) {
    return evaluation::evaluate_job(jobs::MemoryFileSource(files), "job.json", evaluation::CovarianceFile::none, 1,
                                    GUMCERT_SOURCE_DIR "/templates")
        .record;
}

EvaluationRecord record_of_list(const std::vector<Written>& points) {
    std::string list;
    for (const Written& p : points) {
        const bool is_object = list.size() % 2 == 0;
        list += (list.empty() ? "" : ", ") + std::string("{\"r\": ") +
                (is_object ? "{\"value\": " + p.reference + "}" : p.reference) + ", \"noted\": " + p.noted +
                ", \"x\": {\"observations\": [" + p.readings[0] + ", " + p.readings[1] + ", " + p.readings[2] + "]}}";
    }
    return record_of(
        {{"job.json", job_of_points(R"("points": {"list": [)" + list + R"(], "columns": {"noted": "V"}})")},
         {"certificate.json", k_certificate}});
}

EvaluationRecord record_of_table(const std::vector<Written>& points) {
    std::string table = "r,noted,x.1,x.2,x.3\n";
    for (const Written& p : points) {
        table += p.reference + "," + p.noted + "," + p.readings[0] + "," + p.readings[1] + "," + p.readings[2] + "\n";
    }
    return record_of({{"job.json", job_of_points(R"("points": {"file": "points.csv", "columns": {"noted": "V"}})")},
                      {"points.csv", table},
                      {"certificate.json", k_certificate}});
}

double number(const std::string& text) {
    return std::strtod(text.c_str(), nullptr);
}

const PointColumn& column(const EvaluationRecord& record, const std::string& name) {
    const auto& columns = record.certificate->tables.at(0).layout->columns;
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
    if (found == columns.end()) {
        throw std::out_of_range(name);
    }
    return *found;
}

/// How many places behind the point the last digit stands.
int last_place(const std::string& text) {
    const std::size_t end = std::min(text.find_first_of("eE"), text.size());
    const std::size_t point = text.substr(0, end).find('.');
    const int decimals = point == std::string::npos ? 0 : static_cast<int>(end - point - 1);
    return decimals - (end < text.size() ? std::atoi(text.c_str() + end + 1) : 0);
}

void expect_as_written(const EvaluationRecord& record, const std::vector<Written>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const auto& [name, written] : {std::pair{"r", points[i].reference}, std::pair{"noted", points[i].noted}}) {
            const std::string& printed = column(record, name).printed.at(i);
            EXPECT_EQ(number(printed), number(written)) << name << ": " << written << " is printed as " << printed;
            if (last_place(written) >= 0 && std::abs(number(written)) < 1e15) {
                EXPECT_EQ(last_place(printed), last_place(written)) << written << ", " << printed;
            }
        }
        const std::string& mean = column(record, "x").printed.at(i);
        const double of_readings =
            (number(points[i].readings[0]) + number(points[i].readings[1]) + number(points[i].readings[2])) / 3.0;
        EXPECT_NEAR(number(mean) / of_readings, 1.0, 0.004) << mean << ", the mean of " << points[i].readings[0];
        EXPECT_EQ(column(record, "s").printed.at(i), "-0.00000000250");
        EXPECT_EQ(column(record, "t").printed.at(i), "3E+20");
    }
}

/// As a page shows it: with the sign of a minus, and ten with its power.
std::string as_shown_on_a_page(const std::string& printed) {
    static constexpr std::array<const char*, 10> k_raised = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out;
    bool is_power = false;
    for (const char c : printed) {
        if (c == 'E') {
            out += " × 10";
            is_power = true;
        } else if (c == '-') {
            out += is_power ? "⁻" : "\u2212";
        } else if (c != '+') {
            out += is_power ? k_raised.at(static_cast<std::size_t>(c - '0')) : std::string(1, c);
        }
    }
    return out;
}

TEST(WrittenNumbers, KeepTheirDigitsInEveryRecord) {
    const std::vector<Written> points = written_points();
    expect_as_written(record_of_list(points), points);
    expect_as_written(record_of_table(points), points);
}

TEST(WrittenNumbers, KeepTheirDigitsInEveryDocument) {
    const std::vector<Written> points = written_points();
    const EvaluationRecord record = record_of_table(points);
    IssueOptions options;
    options.assets = reports::assets();
    const std::string html = reports::html_text(issue_document(record, "html", options));
    const std::string dcc = issue_document(record, "dcc", options);
    std::string pdf;
    std::string pdf_words;
    if (reports::pdf_is_possible()) {
        const std::string document = issue_document(record, "pdf", options);
        for (const std::string& page : reports::texts_of_pages(document)) {
            pdf += page;
        }
        pdf_words = reports::pdf_text(document);
    }
    for (const char* name : {"r", "noted", "x", "s", "t"}) {
        std::string list;
        for (const std::string& printed : column(record, name).printed) {
            EXPECT_THAT(html, testing::HasSubstr(" " + as_shown_on_a_page(printed) + " "));
            EXPECT_TRUE(pdf.empty() ||
                        pdf.find(reports::without_blanks(as_shown_on_a_page(printed))) != std::string::npos)
                << printed;
            EXPECT_TRUE(pdf_words.empty() ||
                        pdf_words.find(" " + as_shown_on_a_page(printed) + " ") != std::string::npos)
                << printed << " is broken into two lines";
            list += (list.empty() ? "" : " ") + printed;
        }
        EXPECT_THAT(dcc, testing::HasSubstr(list));
    }
}

}  // namespace
}  // namespace gumcert::issuing
