#include "self_test/self_test.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "encoding/file_bytes.h"
#include "encoding/sha2.h"
#include "evaluation/audit_files.h"
#include "evaluation/read_file.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/unit_table.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::self_test {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json text_or_null(const std::string& text) {
    return text.empty() ? json() : json(text);
}

json value_json(const CaseValue& value) {
    if (const double* const number = std::get_if<double>(&value); number != nullptr && !std::isfinite(*number)) {
        return *number > 0.0 ? "infinity" : *number < 0.0 ? "-infinity" : "no number";
    }
    return std::visit([](const auto& found) { return json(found); }, value);
}

json compared_json(const ComparedValue& value) {
    const ExpectedValue& expected = value.expected;
    const int digits = expected.digits();
    return {{"quantity", expected.quantity},
            {"kind", expected.kind},
            {"input", text_or_null(expected.input)},
            {"unit", text_or_null(expected.unit)},
            {"expected", expected.text},
            {"expected_from", expected.is_printed ? "source" : "independent calculation"},
            {"computed", value.was_found ? value_json(value.computed) : json()},
            {"tolerance", value.tolerance ? json(*value.tolerance) : json()},
            {"digits_expected", digits > 0 ? json(digits) : json()},
            {"digits_reached", digits > 0 ? json(value.digits_reached) : json()},
            {"agrees", value.agrees},
            {"because", text_or_null(value.because)},
            {"found", expected.found},
            {"note", text_or_null(expected.note)}};
}

json case_json(const CaseOutcome& outcome) {
    const ReferenceCase& reference = outcome.reference;
    json values = json::array();
    for (const ComparedValue& value : outcome.values) {
        values.push_back(compared_json(value));
    }
    json left_out = json::array();
    for (const ExpectedValue& expected : reference.expected) {
        if (!expected.not_compared.empty()) {
            left_out.push_back(
                {{"value", expected.name()}, {"expected", expected.text}, {"because", expected.not_compared}});
        }
    }
    return {{"case", reference.id},
            {"title", text_or_null(reference.title)},
            {"topic", text_or_null(reference.topic)},
            {"document", text_or_null(reference.document)},
            {"place", text_or_null(reference.place)},
            {"place_seen", reference.is_place_seen},
            {"source_seen", text_or_null(reference.seen)},
            {"checked_by", text_or_null(reference.checked_by)},
            {"note", text_or_null(reference.note)},
            {"passes", outcome.passes()},
            {"refused", text_or_null(outcome.refused)},
            {"values", std::move(values)},
            {"not_compared", std::move(left_out)}};
}

}  // namespace

std::size_t SelfTest::passed() const {
    return static_cast<std::size_t>(
        std::count_if(cases.begin(), cases.end(), [](const CaseOutcome& outcome) { return outcome.passes(); }));
}

std::size_t SelfTest::compared() const {
    std::size_t count = 0;
    for (const CaseOutcome& outcome : cases) {
        count += outcome.values.size();
    }
    return count;
}

std::size_t SelfTest::agreed() const {
    std::size_t count = 0;
    for (const CaseOutcome& outcome : cases) {
        count += outcome.agreed();
    }
    return count;
}

std::vector<fs::path> case_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const std::string& name : encoding::json_files_in(folder)) {
        files.push_back(folder / (name + ".json"));
    }
    if (files.empty()) {
        throw gum::StorageError(
            gum::Diagnostic{.code = "GC-STORE-0016",
                            .where = folder.string(),
                            .what = "holds no reference case",
                            .rule = "gumcert self-test runs the published cases that come with the program",
                            .action = "install the program again"});
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string digest_of_cases(const std::vector<fs::path>& files) {
    std::string lines;
    for (const fs::path& file : files) {
        lines += encoding::sha256(evaluation::read_file(file)) + "  " + file.filename().string() + "\n";
    }
    return encoding::sha256(lines);
}

SelfTest run_self_test(const std::vector<fs::path>& files, unsigned threads, const fs::path& templates,
                       const std::function<void(const CaseOutcome&)>& told) {
    SelfTest test;
    test.unit_table_sha256 = encoding::sha256(gum::unit_table_text());
    test.cases_sha256 = digest_of_cases(files);
    test.cases.resize(files.size());
    std::vector<bool> done(files.size(), false);
    std::size_t next = 0;
    std::mutex lock;
    evaluation::run_in_workers(threads, files.size(), [&](std::size_t i) {
        CaseOutcome outcome = run_case_file(files[i], templates);
        const std::lock_guard<std::mutex> locked(lock);
        test.cases[i] = std::move(outcome);
        done[i] = true;
        for (; next < files.size() && done[next]; ++next) {
            if (told) {
                told(test.cases[next]);
            }
        }
    });
    return test;
}

std::string self_test_json(const SelfTest& test) {
    const TestedSystem& system = test.system;
    json libraries = json::array();
    for (const LibraryVersion& library : system.libraries) {
        libraries.push_back(
            {{"name", library.name}, {"version", library.version}, {"sha256", text_or_null(library.sha256)}});
    }
    json cases = json::array();
    for (const CaseOutcome& outcome : test.cases) {
        cases.push_back(case_json(outcome));
    }
    return reports::with_digest(
        {{"schema", "gumcert/self-test/1"},
         {"date", system.date},
         {"passes", test.passed() == test.cases.size()},
         {"software",
          {{"name", system.name},
           {"version", system.version},
           {"commit", system.commit},
           {"sha256", system.executable_sha256},
           {"compiler", system.compiler}}},
         {"machine", {{"processor", system.processor}, {"operating_system", system.operating_system}}},
         {"libraries", std::move(libraries)},
         {"unit_table", {{"path", "in the program"}, {"sha256", test.unit_table_sha256}}},
         {"templates", {{"sha256", system.templates_sha256}, {"of_this_release", system.templates_of_release}}},
         {"reference_cases", {{"sha256", test.cases_sha256}, {"of_this_release", system.cases_of_release}}},
         {"fonts", system.fonts},
         {"counts",
          {{"cases", test.cases.size()},
           {"passed", test.passed()},
           {"values", test.compared()},
           {"agreed", test.agreed()}}},
         {"cases", std::move(cases)}});
}

std::string digest_of_self_test(const std::string& text) {
    return json::parse(text).at("digest").at("value").get<std::string>();
}

}  // namespace gumcert::self_test
