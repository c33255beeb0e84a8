#include "reports/dcc/dcc_document.h"

#include <nlohmann/json.hpp>

#include "reports/asset_files.h"
#include "reports/dcc/dcc_writer.h"

namespace gumcert::reports {

namespace {

/// What the evaluation rests on, for whoever repeats it: files by their digest.
void write_comment(DccWriter& w) {
    if (w.record().job_files.empty()) {
        return;
    }
    w.xml.open("dcc:comment");
    w.xml.open("evaluation", {{"xmlns", "urn:gumcert:evaluation"}});
    for (const InputFile& file : w.record().job_files) {
        w.xml.element("inputFile", file.sha256.empty() ? "-" : file.sha256, {{"name", file.name}});
    }
    w.xml.close();
    w.xml.close();
}

std::string written(const EvaluationRecord& record, const Wording& words, const RefTypes& ref_types) {
    DccWriter w(record, words, ref_types);
    w.xml.open("dcc:digitalCalibrationCertificate",
               {{"xmlns:dcc", "https://ptb.de/dcc"},
                {"xmlns:si", "https://ptb.de/si"},
                {"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"},
                {"xsi:schemaLocation", "https://ptb.de/dcc https://ptb.de/dcc/v3.3.0/dcc.xsd"},
                {"schemaVersion", "3.3.0"}});
    write_administrative_data(w);
    w.xml.open("dcc:measurementResults");
    w.xml.open("dcc:measurementResult", {{"refId", "item_1"}});
    w.text("dcc:name", record.title.empty() ? words("dcc", "results") : Text(record.title));
    write_circumstances(w);
    write_results(w);
    w.xml.close();
    w.xml.close();
    write_comment(w);
    w.xml.close();
    return w.xml.take();
}

}  // namespace

std::string render_dcc(const EvaluationRecord& record, const RenderAssets& assets) {
    const nlohmann::json texts = read_wording(assets, record);
    const Wording words(texts);
    const RefTypes ref_types = RefTypes::read(assets);
    std::string document = written(record, words, ref_types);
    std::vector<gum::Diagnostic> breaches = check_dcc(document, "digital certificate");
    std::erase_if(breaches, [](const gum::Diagnostic& d) { return d.severity != gum::Severity::error; });
    if (!breaches.empty()) {
        throw gum::NoResultError(std::move(breaches));
    }
    return document;
}

}  // namespace gumcert::reports
