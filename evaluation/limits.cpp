#include "evaluation/limits.h"

#include <algorithm>
#include <cstddef>
#include <system_error>

#include "evaluation/read_file.h"
#include "jobs/budget/budget_job_statement.h"
#include "jobs/budget/budget_statement_fields.h"
#include "jobs/budget/budget_statement_reader.h"
#include "jobs/comparison/comparison_side.h"
#include "jobs/file_source.h"
#include "jobs/job_limits.h"
#include "jobs/matrix_limits.h"
#include "jobs/monte_carlo_request.h"
#include "jobs/rotary_table/rotary_table_limits.h"
#include "json/strict_parser.h"
#include "reports/dcc/document_limits.h"
#include "reports/forms/render.h"
#include "reports/record/record_rules.h"
#include "signing/document_limits.h"
#include "workbook/limits.h"

namespace gumcert::evaluation {

namespace {

constexpr std::uint64_t k_wall_step = 10'000'000;                 // [byte] of a file
constexpr std::uint64_t k_wall_memory = std::uint64_t{1} << 30U;  // [byte], of the largest file
constexpr std::uint64_t k_wall_memory_of_file = 262'144;          // [byte], what is kept of each until all are read
constexpr std::uint64_t k_wall_time = 30;                         // [s], of all files together
constexpr std::uint64_t k_evaluation_memory = std::uint64_t{4} << 30U;  // [byte]
constexpr std::uint64_t k_evaluation_time = 600;                        // [s], of one record

/// "100 000"
std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t i = digits.size(); i > 3; i -= 3) {
        digits.insert(i - 3, " ");
    }
    return digits;
}

}  // namespace

Walls walls_of(const std::vector<std::filesystem::path>& files) {
    std::uint64_t steps = 0;
    std::uint64_t most = 1;
    for (const std::filesystem::path& file : files) {
        std::error_code error;
        const std::uint64_t size = std::filesystem::file_size(file, error);
        const std::uint64_t own = error ? 1 : 1 + size / k_wall_step;
        steps += own;
        most = std::max(most, own);
    }
    return {.memory = most * k_wall_memory + files.size() * k_wall_memory_of_file,
            .time = std::max<std::uint64_t>(steps, 1) * k_wall_time};
}

Walls walls_of_evaluation(const std::vector<std::filesystem::path>& records) {
    const Walls reading = walls_of(records);
    return {.memory = std::max(k_evaluation_memory, reading.memory), .time = std::max(k_evaluation_time, reading.time)};
}

std::string Limit::value() const {
    constexpr std::uint64_t k_kibi = 1024;
    if (unit != "byte") {
        return grouped(most) + (unit.empty() ? "" : " " + std::string(unit));
    }
    for (const auto& [size, name] :
         {std::pair(k_kibi * k_kibi * k_kibi, " GiB"), std::pair(k_kibi * k_kibi, " MiB"), std::pair(k_kibi, " KiB")}) {
        if (most >= size && most % size == 0) {
            return grouped(most / size) + name;
        }
    }
    return grouped(most) + " bytes";
}

std::vector<Limit> limits() {
    constexpr json::ParserOptions k_json;
    const reports::RenderAssets page;
    constexpr std::string_view k_byte = "byte";
    constexpr std::string_view k_job = "files of a job";
    constexpr std::string_view k_budget = "jobs of kind budget";
    constexpr std::string_view k_rotary_table = "jobs of kind rotary_table";
    constexpr std::string_view k_comparison = "jobs of kind comparison";
    constexpr std::string_view k_record = "records";
    constexpr std::string_view k_table = "workbooks and tables of an audit";
    constexpr std::string_view k_certificate = "digital certificates that are read";
    constexpr std::string_view k_signed = "documents whose signatures are checked";
    constexpr std::string_view k_page = "the process that sets pages of a PDF";
    constexpr std::string_view k_foreign =
        "verify, import, check dcc, archive verify FILE, archive add and amend but for the evaluation, and audit of "
        "files of "
        "others, for every 10 MB of a file";
    constexpr std::string_view k_evaluation =
        "the evaluation of the job in a record: archive add and amend, render, check and rerun, and audit, also of a "
        "job; the time also "
        "archive replay, affected and worker; but for these at least what is given for reading the record";
    return {
        {k_job, "a file", jobs::k_file_limit, k_byte},
        {k_job, "logo or symbol", jobs::k_largest_picture, k_byte},
        {k_job, "JSON: objects and arrays within each other", k_json.depth},
        {k_job, "JSON: a text", k_json.string_bytes, k_byte},
        {k_job, "JSON: values", k_json.values},
        {k_job, "rows of a covariance or correlation matrix", jobs::k_most_in_matrix},
        {k_job, "trials of Monte Carlo", static_cast<std::uint64_t>(jobs::k_trials.high)},
        {k_budget, "inputs", jobs::k_most_inputs},
        {k_budget, "components of an input", jobs::k_most_components},
        {k_budget, "observations or samples of an input", jobs::StatementReader::k_most_values},
        {k_budget, "sections", jobs::k_most_sections},
        {k_budget, "points of a section, or of a job without sections", jobs::k_most_points},
        {k_budget, "columns of points that are no inputs", jobs::k_most_point_columns},
        {k_budget, "points of a fit", jobs::k_most_fit_points},
        {k_budget, "tables of a certificate", jobs::k_most_tables},
        {k_rotary_table, "distances", jobs::k_most_distances},
        {k_rotary_table, "reflectors", jobs::k_most_reflectors},
        {k_rotary_table, "angles of a plan", static_cast<std::uint64_t>(jobs::k_most_planned_angles)},
        {k_comparison, "results", jobs::k_most_compared_results},
        {k_comparison, "points of a side", jobs::k_most_side_points},
        {k_record, "a record as text", reports::k_max_record_bytes, k_byte},
        {k_record, "a file that is read beside a job", evaluation::k_largest_file, k_byte},
        {k_table, "a file", workbook::k_largest_file, k_byte},
        {k_table, "all parts of a workbook, unpacked", workbook::k_largest_unpacked, k_byte},
        {k_table, "sheets", workbook::k_most_sheets},
        {k_table, "cells", workbook::k_most_cells},
        {k_table, "characters of a formula", workbook::k_longest_formula},
        {k_certificate, "a file", reports::k_largest_document, k_byte},
        {k_certificate, "elements within each other", reports::k_largest_depth},
        {k_certificate, "elements", reports::k_most_elements},
        {k_certificate, "attributes of a tag", reports::k_most_attributes},
        {k_certificate, "numbers", reports::k_most_numbers},
        {k_signed, "signatures, and attachments of a PDF", signing::k_most_signatures},
        {k_signed, "certificates that come with a signature", signing::k_most_certificates},
        {k_signed, "all attachments of a PDF, unpacked", signing::k_largest_attachments, k_byte},
        {k_signed, "XML: attributes of a tag", signing::k_most_in_tag},
        {k_signed, "XML: tags and attributes", signing::k_most_parts},
        {k_foreign, "memory, unless --memory-limit says otherwise", k_wall_memory, k_byte},
        {k_foreign, "time, unless --time-limit says otherwise", k_wall_time, "s"},
        {k_evaluation, "memory, unless --memory-limit says otherwise", k_evaluation_memory, k_byte},
        {k_evaluation, "time, unless --time-limit says otherwise", k_evaluation_time, "s"},
        {k_page, "memory", page.pdf_memory_limit, k_byte},
        {k_page, "time for a document", static_cast<std::uint64_t>(page.pdf_time_limit.count()), "s"},
    };
}

std::string limits_text() {
    const std::vector<Limit> all = limits();
    std::size_t width = 0;
    for (const Limit& limit : all) {
        width = std::max(width, limit.value().size());
    }
    std::string text;
    std::string_view last;
    for (const Limit& limit : all) {
        if (limit.applies_to != last) {
            text += (last.empty() ? "" : "\n") + std::string(limit.applies_to) + ":\n";
            last = limit.applies_to;
        }
        const std::string value = limit.value();
        text += std::string(width + 2 - value.size(), ' ') + value + "  " + std::string(limit.what) + "\n";
    }
    return text;
}

}  // namespace gumcert::evaluation
