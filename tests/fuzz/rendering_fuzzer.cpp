#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "issuing/issue_documents.h"
#include "reports/dcc/dcc_document.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/dcc/xml_document.h"
#include "tests/fuzz/record_bytes.h"
#include "tests/fuzz/well_formed.h"

namespace gumcert::fuzz {
namespace {

const issuing::IssueOptions& options_of_rendering() {
    static const issuing::IssueOptions options = [] {
        issuing::IssueOptions of_the_tree;
        of_the_tree.assets.templates = GUMCERT_SOURCE_DIR "/templates";
        return of_the_tree;
    }();
    return options;
}

/// A document of a record, or nothing where it is refused with a reason.
std::optional<std::string> rendered(const reports::EvaluationRecord& record, std::string_view form) {
    try {
        std::string document = issuing::issue_document(record, form, options_of_rendering());
        demand(document == issuing::issue_document(record, form, options_of_rendering()),
               "other bytes the second time");
        return document;
    } catch (const gum::InputError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
    } catch (const gum::NoResultError& error) {
        demand(!error.diagnostics().empty(), "refused without a reason");
    }
    return std::nullopt;
}

/// A printed number as pages show it.
std::string on_page(std::string text) {
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

/// Value and uncertainty of every result stand in a page as they are printed.
void demand_results(const reports::EvaluationRecord& record, const std::string& page) {
    for (const reports::Result& result : record.results) {
        const reports::ReportedResult& reported = result.reported;
        for (const std::string& text : {reported.printed.value, reported.printed.U, reported.printed_low}) {
            demand(text.empty() || page.find(on_page(text)) != std::string::npos, "a result that a page does not show");
        }
    }
}

/// Every number of a digital certificate is the printed one of a result.
void demand_same_numbers(const reports::EvaluationRecord& record, const std::string& dcc) {
    (void)reports::check_dcc(dcc, "dcc");
    demand(reports::check_dcc_structure(dcc, "dcc").empty(), "a digital certificate that its schema refuses");
    const reports::ImportedCertificate read = reports::read_dcc(dcc, "dcc");
    const auto is_printed = [&](const std::string& number) {
        return number.empty() || std::ranges::any_of(record.results, [&](const reports::Result& result) {
                   const reports::ReportedResult& r = result.reported;
                   return number == r.printed.value || number == r.printed.U || number == r.printed_low ||
                          number == r.printed_high;
               });
    };
    for (const reports::ImportedQuantity& quantity : read.quantities) {
        if (quantity.role == "result" && record.kind == "budget" && quantity.ref_type == "basic_measuredValue") {
            demand(is_printed(quantity.value) && (quantity.U == "NaN" || is_printed(quantity.U)),
                   "a number that is not that of the record");
        }
    }
}

void render_record(const reports::EvaluationRecord& record) {
    for (const std::string_view form : {"html", "report-html"}) {
        if (const auto page = rendered(record, form)) {
            demand_well_formed_html(*page);
            if (form == "html" && record.results.size() < 100) {
                demand_results(record, *page);
            }
        }
    }
    if (const auto text = rendered(record, "text")) {
        demand(is_plain_text(*text), "a control character in a text");
        if (record.results.size() < 100) {
            demand_results(record, *text);
        }
    }
    if (const auto drawing = rendered(record, "label-svg")) {
        (void)reports::read_xml(*drawing, "label.svg");
    }
    if (const auto dcc = rendered(record, "dcc")) {
        demand_same_numbers(record, *dcc);
    }
    (void)rendered(record, "csv");
}

}  // namespace
}  // namespace gumcert::fuzz

/// Any record that is accepted becomes documents that are well-formed and show its numbers, or is refused with a reason.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert;
    if (const auto record = fuzz::record_from_bytes({reinterpret_cast<const char*>(data), size})) {
        fuzz::render_record(*record);
    }
    return 0;
}
